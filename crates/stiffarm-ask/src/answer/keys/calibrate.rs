//! What can be reported of a calibrated arm.

use super::identify::shape::UPDATED_DRIVE;
use super::kinds::{Kind, Unit, fields, numbers};
use super::slots::{shapes, slots};

fields! {
    BASE_SEEN: "base_mm_deg", Kind::List(&Kind::List(&Kind::Number(Unit::Described))), "The base of the robot file in the frame of the readings: x, y, z mm and turns about fixed x, y, z deg; one for each stand.";
    POINTS_SEEN: "points_mm", Kind::List(&Kind::List(&Kind::Number(Unit::Millimetre))), "The points that were looked at, in the flange frame, mm.";
    MEASURED_POINTS: "measured", Kind::Truth, "Points were measured by an instrument; else the controller computed them.";
    LEVEL: "level", Kind::Text, "How much of the arm may differ from its drawing: zeros, geometry, weight, gears; of a list also as drawn.";
    OWN_WEIGHT: "own_weight", Kind::Text, "How the own weight is computed: `terms` of the joint angles, or `masses` of the robot file, with the compliance of each drive (`drives`) as all that is unknown; null of levels without it.";
    LEVELS: "levels", Kind::Objects, "Every level: what it leaves.";
    NOMINAL_RMS: "nominal_rms_mm", Kind::Number(Unit::Millimetre), "Root mean square of the distances of the arm as drawn.";
    NOISE_FOUND: "sigma_mm", Kind::Number(Unit::Millimetre), "Standard deviation of a coordinate of a reading about the level taken; of single points with how the arm repeats a posture.";
    POSTURE_NOISE_FOUND: "posture_sigma_mm", Kind::Number(Unit::Millimetre), "The same of where the arm stands at a posture, which all of its points share; null of single points, of which nothing tells it from `sigma_mm`.";
    MEDIAN_OFF: "median_mm", Kind::Number(Unit::Millimetre), "Median of the distances.";
    P95_OFF: "p95_mm", Kind::Number(Unit::Millimetre), "95th percentile of the distances.";
    LEFT_OUT_RMS: "left_out_rms_mm", Kind::Number(Unit::Millimetre), "Root mean square of the distances that are predicted where a third of a joint's range is left out; null where none can be.";
    EVIDENCE: "log_evidence", Kind::Number(Unit::One), "Logarithm of the marginal likelihood, up to what all levels share.";
    SHOWN: "shown", Kind::Number(Unit::One), "How many parameters the rows show: the trace of one less posterior over prior.";
    WRONG_ROWS: "wrong_rows", Kind::Objects, "Points that were left out: line of the file, point (0: all of the row) and distance, mm.";
    WRONG_NUMBER: "point", Kind::Count, "Which point of the row, from 1; 0 is all of it.";
    DISTANCE_OFF: "distance_mm", Kind::Number(Unit::Millimetre), "How far it is off.";
    TRACKER_IN_BASE: "tracker_in_base", Kind::List(&Kind::List(&Kind::Number(Unit::Described))), "Each stand of the tracker in the base: x, y, z mm and turns about fixed x, y, z deg.";
    NARROW: "narrow", Kind::Objects, "Joints that moved over less than a third of their range, with that share.";
    NARROW_NUMBER: "joint", Kind::Count, "Which joint, from 1.";
    NARROW_SHARE: "share", Kind::Number(Unit::One), "Over which part of its range it moved.";
    EXPECTED_AT_WORK: "expected_mm", Kind::Number(Unit::Millimetre), "Root mean square of the error that remains at the work, where it is found by the tracker; in a plan that of its first point.";
    LEAST_AT_WORK: "lower_bound_mm", Kind::Number(Unit::Millimetre), "No choice of as many of the candidates leaves less.";
    RANDOM_AT_WORK: "random_mm", Kind::Number(Unit::Millimetre), "What the median random choice leaves.";
    AS_DRAWN: "as_drawn_mm", Kind::Number(Unit::Millimetre), "Without a calibration.";
    UNEXPLAINED: "unexplained_mm", Kind::Number(Unit::Millimetre), "The part of all of these that no error of the arm explains, and no calibration takes away.";
    BY_COUNT: "by_count", Kind::Objects, "What so many postures leave, each chosen after those before.";
    POSTURE_COUNT: "postures", Kind::Count, "So many.";
    WORK_INTERVAL: "ci95_mm", numbers(Unit::Millimetre, &["ci95_low_mm", "ci95_high_mm"]), "Where that root mean square lies with 95 %.";
    WORK_P95: "work_p95_mm", Kind::Number(Unit::Millimetre), "95th percentile of the error at the work.";
    AT_WORK: "at_work", Kind::Object, "The error that remains at the work: expected, with its interval, and over how many postures; null where the arm does not reach it.";
    WORK_POSTURES: "postures", Kind::Count, "Postures over which it is computed.";
    ZERO_FOUND: "zero_deg", numbers(Unit::Degree, &["zero_1_deg", "zero_2_deg", "zero_3_deg", "zero_4_deg", "zero_5_deg", "zero_6_deg"]), "What is to be added to each reported angle.";
    FRAMES_FOUND: "frames_mm_mrad", Kind::List(&Kind::List(&Kind::Number(Unit::Described))), "Of each joint's frame three shifts, mm, and three turns, mrad, in the base's axes at model zero; the zeros are left out.";
    WEIGHT_FOUND: "weight_mrad", Kind::List(&Kind::Number(Unit::Milliradian)), "How drives yield under the arm's own weight, null where it is that of masses: of drive 2 on sin t2, cos t2, sin t23, cos t23, of drive 3 on sin t23, cos t23, of drive 5 on two arms of the tool.";
    WEIGHT_INTERVALS: "weight_ci95_mrad", Kind::List(&Kind::List(&Kind::Number(Unit::Milliradian))), "Where each lies with 95 %.";
    GEARS_FOUND: "gears_mrad", Kind::List(&Kind::List(&Kind::Number(Unit::Milliradian))), "Once per turn of each joint: sine, cosine.";
    BEFORE: "before_mm", Kind::Number(Unit::Millimetre), "The largest distance of the row's points as drawn.";
    AFTER: "after_mm", Kind::Number(Unit::Millimetre), "The same calibrated.";
}

shapes! {
    CALIBRATED_AT_WORK: "CalibratedAtWork", "The error that remains at the work.",
        &[slots![EXPECTED_AT_WORK, WORK_INTERVAL, WORK_P95, WORK_POSTURES]];
    CALIBRATED_POSTURE: "CalibratedPosture", "A posture before and after.", &[slots![LINE, BEFORE, AFTER]];
    CALIBRATION: "CalibrationDict", "What `calibrate` answers.", &[slots![
        ROBOT, LEVEL, OWN_WEIGHT | null, READ_ROWS, NOMINAL_RMS, NOISE_FOUND, POSTURE_NOISE_FOUND | null, LEVELS => LEVEL_FIT, WRONG_ROWS => WRONG_POINT, TRACKER_IN_BASE,
        POINTS_SEEN, ZERO_FOUND, FRAMES_FOUND, WEIGHT_FOUND | null, WEIGHT_INTERVALS | null, DRIVES | null => UPDATED_DRIVE,
        GEARS_FOUND, NARROW => NARROW_JOINT, AT_WORK | null => CALIBRATED_AT_WORK,
    ]];
    LEVEL_FIT: "LevelFit", "What a level leaves.", &[slots![
        LEVEL, OWN_WEIGHT | null, OFF, MEDIAN_OFF, P95_OFF, LARGEST_OFF, LEFT_OUT_RMS | null, SHOWN, EVIDENCE,
    ]];
    NARROW_JOINT: "NarrowJoint", "A joint that moved over less than a third of its range.", &[slots![NARROW_NUMBER, NARROW_SHARE]];
    WRONG_POINT: "WrongRow", "A point that was left out.", &[slots![LINE, WRONG_NUMBER, DISTANCE_OFF]];
}
