//! Which fields has a cut that may swing?

use super::groups::{OF_ROBOT, OF_TOOL_BODY};
use super::{shapes, slots};

/// The cut, and how deep it may be; with `| null` where there may be none.
macro_rules! of_cut {
    ($(| $null:ident)?) => {
        slots![
            SPINDLE_SPEED $(| $null)?,
            CUT_DEPTH $(| $null)?,
            ENTRY_ANGLE $(| $null)?,
            EXIT_ANGLE $(| $null)?,
            CHATTER_METHOD $(| $null)?,
            CRITICAL_DEPTH | null,
            CRITICAL_DEPTH_P05 | null,
            CRITICAL_DEPTH_P95 | null,
            DEPTH_RESERVE | null,
            CHATTER_FREQUENCY | null,
            TOOTH_PHASE | null,
            ANY_SPEED_DEPTH | null,
            ANY_SPEED_DEPTH_P05 | null,
            ANY_SPEED_DEPTH_P95 | null,
            ANY_SPEED_FREQUENCY | null,
            OTHER_WAY_DEPTH | null,
            OTHER_WAY_FREQUENCY | null,
            CALM_SPEEDS | null,
            PAN_DEPTH | null,
            PAN_FREQUENCY | null,
            CHATTER_DRAWN $(| $null)?,
            MODES_LOOKED_AT $(| $null)?,
            ROBOT_MODES,
            SPINDLE_MODES,
            FRF | null,
            FRF_ON | null,
            MEASURED_MODES | null,
            MEASURED_BETWEEN | null,
        ]
    };
}
pub(super) use of_cut;

shapes! {
    CHATTER: "ChatterDict", "What `chatter` answers.", &[
        OF_ROBOT, slots![MODEL, JOINTS, PENDANT, TCP], OF_TOOL_BODY, slots![PROCESS], of_cut!(),
        slots![CHATTER_VERDICT, ASSUMED, LOBES => LOBE],
    ];
    LOBE: "Lobe", "From which depth a cut swings at a speed of the spindle.", &[slots![
        SPINDLE_SPEED, LOBE_DEPTH | null, LOBE_DEPTH_P05 | null, LOBE_DEPTH_P95 | null, CHATTER_FREQUENCY | null,
    ]];
}
