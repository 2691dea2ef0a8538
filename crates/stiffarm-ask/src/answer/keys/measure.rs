//! What can be reported of planned measurements.

use super::groups::OF_ROBOT;
use super::kinds::{Kind, Unit, fields};
use super::slots::{shapes, slots};

fields! {
    RUNS: "runs", Kind::Objects, "One entry per run, in the order in which they are made.";
    RUN: "run", Kind::Count, "Its number, from 1.";
    OF_LOAD: "load", Kind::Text, "In which direction is loaded.";
    EXPECTED: "expected_mm", Kind::Number(Unit::Millimetre), "How far the marker is expected to move.";
    CRITERION: "criterion", Kind::Text, "What a plan is judged by.";
    CRITERION_VALUE: "value", Kind::Number(Unit::One), "By the criterion: mean variance of the displacement under 1 N over the work, (um/N)^2, or a variance in parts of the compliances.";
    CRITERION_BOUND: "lower_bound", Kind::Number(Unit::One), "No plan of so many runs of the candidates has less.";
    EFFICIENCY: "efficiency", Kind::Number(Unit::One), "The bound over the value: 1 is proved best. Of a plan with --geometry both are squared, less the square of what no measurement takes away.";
    RANDOM_EFFICIENCY: "random_efficiency", Kind::Number(Unit::One), "The same of the median random choice; null where that leaves some drive unseen.";
    CANDIDATES: "candidates", Kind::Count, "Among so many was chosen.";
    UNSEEN: "unseen_drives", Kind::List(&Kind::Count), "Drives that no candidate shows.";
    UNSEEN_SHARE: "unseen_share", Kind::Number(Unit::One), "What part of the variance of the prediction is the prior of these drives.";
    ADVISED_LOADS: "advised_loads", Kind::List(&Kind::Text), "Directions of loads that show them, where some do.";
    COMPARED: "compared", Kind::Object, "What the table that was given is worth.";
    COMPARED_FILE: "file", Kind::Text, "The table.";
    RUN_COUNT: "runs", Kind::Count, "How many runs it has.";
}

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
