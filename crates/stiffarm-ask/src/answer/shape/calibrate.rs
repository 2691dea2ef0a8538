//! Which fields does a calibration have?

use super::identify::UPDATED_DRIVE;
use super::{shapes, slots};

shapes! {
    CALIBRATED_AT_WORK: "CalibratedAtWork", "The error that remains at the work.",
        &[slots![EXPECTED_AT_WORK, WORK_INTERVAL, WORK_P95, WORK_POSTURES]];
    CALIBRATED_POSTURE: "CalibratedPosture", "A posture before and after.", &[slots![LINE, BEFORE, AFTER]];
    CALIBRATION: "CalibrationDict", "What `calibrate` answers.", &[slots![
        ROBOT, LEVEL, OWN_WEIGHT | null, READ_ROWS, NOMINAL_RMS, LEVELS => LEVEL_FIT, WRONG_ROWS => WRONG_POINT, TRACKER_IN_BASE,
        POINTS_SEEN, ZERO_FOUND, FRAMES_FOUND, WEIGHT_FOUND | null, WEIGHT_INTERVALS | null, DRIVES | null => UPDATED_DRIVE,
        GEARS_FOUND, NARROW => NARROW_JOINT, AT_WORK | null => CALIBRATED_AT_WORK,
    ]];
    LEVEL_FIT: "LevelFit", "What a level leaves.", &[slots![
        LEVEL, OWN_WEIGHT | null, OFF, MEDIAN_OFF, P95_OFF, LARGEST_OFF, LEFT_OUT_RMS | null, SHOWN, EVIDENCE,
    ]];
    NARROW_JOINT: "NarrowJoint", "A joint that moved over less than a third of its range.", &[slots![NARROW_NUMBER, NARROW_SHARE]];
    WRONG_POINT: "WrongRow", "A point that was left out.", &[slots![LINE, WRONG_NUMBER, DISTANCE_OFF]];
}
