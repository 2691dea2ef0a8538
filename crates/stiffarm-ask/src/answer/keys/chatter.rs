//! What can be reported of how a cut swings.

use super::groups::{OF_ROBOT, OF_TOOL_BODY};
use super::kinds::{Kind, Unit, fields};
use super::slots::{shapes, slots};

fields! {
    CUT_DEPTH: "cut_depth_mm", Kind::Number(Unit::Millimetre), "Axial depth of the cut, as the process has it.";
    CRITICAL_DEPTH: "critical_depth_mm", Kind::Number(Unit::Millimetre), "The least axial depth that swings with the robot at the speed of the spindle; null where none up to 300 mm does.";
    CRITICAL_DEPTH_P05: "critical_depth_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile over draws of drive stiffness and damping; null beyond 300 mm.";
    CRITICAL_DEPTH_P95: "critical_depth_mm_p95", Kind::Number(Unit::Millimetre), "95th percentile; null beyond 300 mm.";
    CHATTER_FREQUENCY: "chatter_hz", Kind::Number(Unit::Given("hz")), "The frequency of the swing at that depth.";
    TOOTH_PHASE: "tooth_phase_rad", Kind::Number(Unit::Given("rad")), "By how much the swing turns from tooth to tooth; far below 1 the cut is a damper, which calms or drives.";
    ANY_SPEED_DEPTH: "any_speed_depth_mm", Kind::Number(Unit::Millimetre), "Less deep no speed swings, by the mean of the teeth, and never deeper than at the speed of the cut; null where none up to 300 mm does.";
    ANY_SPEED_DEPTH_P05: "any_speed_depth_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile over the same draws.";
    ANY_SPEED_DEPTH_P95: "any_speed_depth_mm_p95", Kind::Number(Unit::Millimetre), "95th percentile.";
    ANY_SPEED_FREQUENCY: "any_speed_hz", Kind::Number(Unit::Given("hz")), "The frequency of the swing at that depth.";
    OTHER_WAY_DEPTH: "other_way_depth_mm", Kind::Number(Unit::Millimetre), "The least axial depth that swings at the speed of the spindle where the cut is fed the other way, up for down; null where none up to 300 mm does.";
    OTHER_WAY_FREQUENCY: "other_way_hz", Kind::Number(Unit::Given("hz")), "The frequency of the swing at that depth.";
    CALM_SPEEDS: "calm_rpm", Kind::List(&Kind::List(&Kind::Number(Unit::Given("rpm")))), "Speeds of the spindle within 0.5 to 1.5 of its own at which the cut swings neither at the nominal stiffness and damping nor in more than 5 of 100 draws: pairs of from and to; null where teeth are counted one by one, of drives that are nobody's, and where a measured table decides nothing.";
    PAN_DEPTH: "pan_depth_mm", Kind::Number(Unit::Millimetre), "The least depth at which modes couple without the delay (Pan); beside the others, never instead of them.";
    PAN_FREQUENCY: "pan_hz", Kind::Number(Unit::Given("hz")), "Its frequency; 0 where the arm gives way.";
    MODES_LOOKED_AT: "modes_looked_at", Kind::List(&Kind::Number(Unit::Described)), "Frequencies of the robot's modes that were looked at, Hz; none where the robot is in what was measured. Nothing is known above the last of these and of what was measured.";
    ROBOT_MODES: "robot_modes", Kind::Text, "Of the robot with what was measured at its tip: calm where the cut swings neither at the nominal stiffness and damping nor in more than 5 of 100 draws, limit where it swings at the nominal and in 95 of 100 or more, else not decided; not covered of a path without a cut of which anything is known.";
    SPINDLE_MODES: "spindle_modes", Kind::Text, "unknown where nothing was measured at the tip, else measured; those of the work are never looked at.";
    FRF: "frf", Kind::Text, "The table of what was measured at the tip; null where there is none.";
    FRF_ON: "frf_on", Kind::Text, "What held the tip while it was measured: rigid (spindle, holder and cutter alone) or robot (it takes the place of the model); null without a table.";
    MEASURED_MODES: "measured_modes", Kind::List(&Kind::Number(Unit::Described)), "Frequencies of the modes of the table, Hz; null without a table of modes.";
    MEASURED_BETWEEN: "measured_between", Kind::List(&Kind::Number(Unit::Described)), "From where to where the table tells frequency by frequency, Hz; null without one.";
    CHATTER_VERDICT: "verdict", Kind::Text, "What is reported of robot modes and of what was measured at the tip, in words.";
    CHATTER_METHOD: "method", Kind::Text, "How teeth are counted: mean (over a revolution) or teeth (one by one).";
    CHATTER_DRAWN: "drawn", Kind::List(&Kind::Text), "What the intervals are over: drives, damping, both or neither.";
    DEPTH_RESERVE: "depth_reserve", Kind::Number(Unit::One), "The least depth that swings at the speed of the spindle, in parts of that of the cut; null where none up to 300 mm does.";
    LOBES: "lobes", Kind::Objects, "By the speed of the spindle: the least depth that swings.";
    LOBE_DEPTH: "depth_mm", Kind::Number(Unit::Millimetre), "The least axial depth that swings at a speed; null where none up to 300 mm does.";
    LOBE_DEPTH_P05: "depth_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile over draws of drive stiffness and damping; null beyond 300 mm, and where teeth are counted one by one.";
    LOBE_DEPTH_P95: "depth_mm_p95", Kind::Number(Unit::Millimetre), "95th percentile.";
}

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
