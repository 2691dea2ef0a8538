//! Which fields does a placement have?

use super::groups::{OF_FORCE, OF_LOAD, OF_ROBOT, OF_SPREAD, OF_VERDICT};
use super::{Slot, shapes, slots};

shapes! {
    ADVICE: "AdviceDict", "What a tolerance says of force, stiffness and size.", &[slots![
        FORCE_FACTOR | null, FORCE_FACTOR_BOUND | null, LARGEST_FORCE | null, STIFFNESS_FACTOR | null, STIFFNESS_NEEDED | null,
        DRIVE_SHARES | null, SOFTEST_DRIVE | null, SOFTEST_SHARE | null, COMPENSATION | null, COMPENSATED | null,
        COMPENSATED_PASS | null, LARGEST_ZONE | null => LARGEST_ZONE,
    ]];
    CELL: "CellDict", "A cell as it was asked for.", &[slots![
        MOUNT, BASE_IN_CELL, BASE_TURNED, WINDOWS, KEPT_FREE, CARRIES_BASE, CLEARANCE_KEPT | null,
    ]];
    FACE: "FaceDict", "One face of a part.", &[slots![
        FACE, FACE_CENTRE, TOOL_DIRECTION, YAW, ROLL, DEFLECTION, LOWER_BOUND, SHOULDER, ELBOW, WRIST, WORST_POINT, WORST_JOINTS,
        WORST_SHARES, LIMIT_MARGIN, LIMIT_MARGIN_JOINT, SINGULAR_MARGIN,
    ]];
    LARGEST_ZONE: "LargestZone", "The largest zone that passes.", &[slots![
        SCALE | null, SIZE_IN_WORDS | null, SIDES | null, DEFLECTION | null, FAILS_AT | null, FAILS_PROVED, TRIED,
    ]];
    PLACEMENT: "Placed", "One placement; `pass` says whether the tolerance is kept.",
        &[OF_ROBOT, OF_TASK, OF_FORCE, OF_LOAD, OF_QUESTION, OF_PLACE, OF_SPREAD, OF_VERDICT, slots![ADVICE | null => ADVICE]];
    PLACEMENT_IN_RANKING: "PlacedInRanking", "One placement of a ranking, with its rank for this task.", &[
        OF_ROBOT, OF_TASK, OF_FORCE, OF_LOAD, OF_QUESTION, OF_PLACE, OF_SPREAD, OF_VERDICT,
        slots![TASK_RANK | null, TASK_RANK_TIED | null, ADVICE | null => ADVICE],
    ];
    RESOLUTION: "Resolution", "How finely a place was looked for.",
        &[slots![COARSE_STEP, COARSE | null, FINE_STEP, FINE_TURN, SAMPLE_STEP, SAMPLES, HALVING, BOXES]];
    SETUP: "PlacedSetup", "One placement of two that are compared.", &[
        slots![SETUP], OF_ROBOT, OF_TASK, OF_FORCE, OF_LOAD, OF_QUESTION, OF_PLACE, OF_SPREAD, OF_VERDICT,
        slots![ADVICE | null => ADVICE],
    ];
}

const OF_TASK: &[Slot] = slots![TASK, MODEL];

const OF_QUESTION: &[Slot] = slots![
    TOOL | null,
    TOOL_DIRECTION | null,
    WITHIN | null,
    ROBOT_CELL | null => CELL,
    ASKED_LIMIT_MARGIN,
    ASKED_SINGULAR_MARGIN,
    CLEAR_OF_BASE | null,
    FLOOR_HEIGHT | null,
];

const OF_PLACE: &[Slot] = slots![
    FEASIBLE | null,
    REASON | null,
    PROVED | null,
    LARGEST_SCALE | null,
    DEFLECTION | null,
    LOWER_BOUND | null,
    X | null,
    Z | null,
    BEARING | null,
    YAW | null,
    ANGLE | null,
    ROLL | null,
    SHOULDER | null,
    ELBOW | null,
    WRIST | null,
    WORST_POINT | null,
    FROM_AXIS_1 | null,
    BELOW_BASE | null,
    BEHIND_AXIS_1 | null,
    WORST_JOINTS | null,
    PENDANT | null,
    WORST_SHARES | null,
    LIMIT_MARGIN | null,
    LIMIT_MARGIN_JOINT | null,
    SINGULAR_MARGIN | null,
    SMALLEST_MARGIN | null,
    SMALLEST_MARGIN_OF | null,
    CLEARANCE | null,
    CLEARANCE_OF | null,
    CLEARANCE_ESTIMATED | null,
    CLEARANCE_OUTSIDE | null,
    CLEARANCE_WIDE | null,
    CLEARANCE_WIDE_OF | null,
    CELL_CENTRE | null,
    RESOLUTION | null => RESOLUTION,
    FACES | null => FACE,
];
