//! Which fields do plans of measurements have?

use super::groups::OF_ROBOT;
use super::{shapes, slots};

shapes! {
    CALIBRATION_LEAVES: "CalibrationLeaves", "What so many postures leave.", &[slots![POSTURE_COUNT, EXPECTED_AT_WORK]];
    CALIBRATION_PLAN: "CalibrationPlanDict", "What `measure --geometry` answers.", &[slots![
        ROBOT, VENDOR, PENDANT, POINTS_SEEN, AT_WORK => PLANNED_AT_WORK, EFFICIENCY, RANDOM_EFFICIENCY, CANDIDATES,
        BY_COUNT => CALIBRATION_LEAVES, RUNS => PLANNED_POSTURE,
    ]];
    COMPARED_TABLE: "ComparedTable", "What a table of one's own is worth.",
        &[slots![COMPARED_FILE, RUN_COUNT, CRITERION_VALUE, EFFICIENCY]];
    EXPECTED_DRIVE: "ExpectedDrive", "How well a drive will be known.", &[slots![SPRING, ESTIMATE, STANDARD_ERROR | null]];
    MEASUREMENT_PLAN: "MeasurementPlanDict", "What `measure` answers.", &[
        OF_ROBOT,
        slots![
            PENDANT, CRITERION, CRITERION_VALUE, CRITERION_BOUND, EFFICIENCY, RANDOM_EFFICIENCY | null, CANDIDATES,
            DRIVES => EXPECTED_DRIVE, UNSEEN, UNSEEN_SHARE, ADVISED_LOADS, RUNS => MEASUREMENT_RUN, COMPARED | null => COMPARED_TABLE,
        ],
    ];
    MEASUREMENT_RUN: "MeasurementRun", "A posture and a load.", &[slots![RUN, JOINTS, OF_LOAD, FORCE_VECTOR, EXPECTED]];
    PLANNED_AT_WORK: "PlannedAtWork", "The error that a calibration leaves at the work.",
        &[slots![EXPECTED_AT_WORK, LEAST_AT_WORK, RANDOM_AT_WORK, AS_DRAWN, UNEXPLAINED, WORK_POSTURES]];
    PLANNED_POSTURE: "PlannedPosture", "A posture in which points are measured.", &[slots![RUN, JOINTS]];
}
