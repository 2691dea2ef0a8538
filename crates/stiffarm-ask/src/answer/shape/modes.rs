//! Which fields has a swinging arm?

use super::groups::{OF_ROBOT, OF_TOOL_BODY};
use super::{shapes, slots};

shapes! {
    MODES: "ModesDict", "What `modes` answers of a posture.", &[
        OF_ROBOT, slots![MODEL, JOINTS, PENDANT, TCP], OF_TOOL_BODY, slots![DAMPING_SOURCE, MASSES_LEFT_OUT, MODES => SWING_MODE],
    ];
    MODES_OVER_ZONE: "ModesOverZoneDict", "What `modes --task` answers of a zone.", &[
        OF_ROBOT,
        slots![
            MODEL, TASK, TOOL, TOOL_DIRECTION, X, Z, BEARING | null, YAW | null, ANGLE, ROLL | null, SHOULDER | null, ELBOW,
            WRIST | null, PENDANT,
        ],
        OF_TOOL_BODY,
        slots![
            MASSES_LEFT_OUT, FIRST_AT_LEAST | null, FIRST_AT_LEAST_P05 | null, ZONE_PARTS, SAMPLES, SAMPLE_STEP,
            MODES => MODE_OVER_ZONE,
        ],
    ];
    MODE_OVER_ZONE: "ModeOverZone", "One mode over a zone; modes are counted by their frequencies at each point.", &[slots![
        MODE, FREQUENCY_LEAST, FREQUENCY_P05 | null, FREQUENCY_P95 | null, LEAST_AT, FREQUENCY_LARGEST, LARGEST_AT,
    ]];
    SWING_MODE: "SwingMode", "One way in which an arm swings.", &[slots![
        MODE, FREQUENCY, FREQUENCY_P05 | null, FREQUENCY_P95 | null, FREQUENCY_FREE | null, DAMPING_RATIO, TIP_SHAPE, ENERGY_SHARES,
    ]];
}
