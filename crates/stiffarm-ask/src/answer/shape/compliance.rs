//! Which fields does the compliance in a posture have, and which a cutting force?

use super::groups::{OF_ROBOT, OF_SPREAD};
use super::{shapes, slots};

shapes! {
    COMPLIANCE: "ComplianceDict", "What `compliance` answers.", &[
        OF_ROBOT,
        slots![
            MODEL, JOINTS, PENDANT, TCP, COMPLIANCE, COMPLIANCE_6X6, PRINCIPAL, WORST_DIRECTION, WORST_SHARES,
            FORCE_VECTOR | null, MOVED | null, TURNED | null, COUNTED | null,
        ],
        OF_SPREAD,
        slots![FORCE_AXES | null, FORCE_DIRECTION | null, FORCE_CONE | null, FEED | null, COMPONENT | null],
    ];
    FORCE: "ForceDict", "What `force` answers.", &[slots![
        PROCESS, LAW, MATERIAL | null, MATERIAL_STATUS | null, MATERIAL_SOURCE | null, MEAN_FORCE | null, MAX_FORCE | null,
        MIN_FORCE | null, PEAK_FORCE, MOMENT, POWER | null, SPINDLE_SPEED | null, ENTRY_ANGLE | null, EXIT_ANGLE | null, ASSUMED,
    ]];
}
