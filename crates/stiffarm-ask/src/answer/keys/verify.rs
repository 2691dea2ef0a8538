//! What can be reported of how joints are counted.

use super::kinds::{Kind, Unit, fields, numbers};
use super::slots::{shapes, slots};

fields! {
    VERIFIED: "verified", Kind::Truth, "The readings agree with the robot file, and with no other way of counting the joints.";
    READ_ROWS: "rows", Kind::Count, "Postures that were read.";
    LARGEST_OFF: "largest_mm", Kind::Number(Unit::Millimetre), "The largest distance between what was read and what the file says.";
    OFF: "rms_mm", Kind::Number(Unit::Millimetre), "The root mean square of these distances.";
    LARGEST_TURN: "largest_deg", Kind::Number(Unit::Degree), "The largest turn between orientations; null where none was read.";
    FITS: "fits", Kind::Objects, "Robots and ways of counting the joints, the best first.";
    THIRD_AXIS: "third_axis", Kind::Text, "What joint 3 counts from: elbow, the upper arm; forearm, the horizontal.";
    SIGN: "sign", numbers(Unit::One, &["sign_1", "sign_2", "sign_3", "sign_4", "sign_5", "sign_6"]), "Of each joint, as in a robot file.";
    ZERO: "zero_deg", numbers(Unit::Degree, &["zero_1_deg", "zero_2_deg", "zero_3_deg", "zero_4_deg", "zero_5_deg", "zero_6_deg"]), "Zero offset of each joint, as a robot file has it.";
    CARRIED: "carried", numbers(Unit::One, &["4_in_5", "4_in_6", "5_in_6"]), "By how much joints of the wrist carry others along: 4 turns 5, 4 turns 6, 5 turns 6.";
    DIFFERENCES: "differences", Kind::List(&Kind::Text), "In what it differs from its robot file, in words.";
    DIFFERS: "differs", Kind::Text, "The same in a line.";
    ALIKE: "alike", Kind::List(&Kind::Text), "What the readings do not tell apart, in words.";
    ZEROS_NOT_SEEN: "zeros_not_seen", Kind::List(&Kind::Count), "Joints whose zeros were not looked at, as a base or a tool that is fitted takes them up.";
    POSTURES_TO_READ: "postures_deg", Kind::List(&Kind::List(&Kind::Number(Unit::Given("deg")))), "Postures that would tell it apart: joint angles.";
    WRONG_ROW: "wrong_row", Kind::Object, "The row that is off where all others agree: its line in the file and its distance, mm; null where there is none.";
}

shapes! {
    FITTING_ROBOTS: "FittingRobotsDict", "What `robots verify` answers without a robot.",
        &[slots![VERIFIED, READ_ROWS, FITS => WAY_OF_COUNTING]];
    VERIFICATION: "VerificationDict", "What `robots verify` answers of a robot.", &[slots![
        ROBOT, VERIFIED, READ_ROWS, MEASURED_POINTS, LARGEST_OFF, OFF, LARGEST_TURN | null, BASE_SEEN, POINTS_SEEN,
        FITS => WAY_OF_COUNTING, ALIKE, ZEROS_NOT_SEEN, POSTURES_TO_READ, WRONG_ROW | null => WRONG_READING,
    ]];
    WAY_OF_COUNTING: "WayOfCounting", "A way of counting the joints.", &[slots![
        ROBOT, VENDOR, THIRD_AXIS, SIGN, ZERO, CARRIED, OFF, LARGEST_OFF, LARGEST_TURN | null, DIFFERS, DIFFERENCES,
    ]];
    WRONG_READING: "WrongReading", "The row that does not agree.", &[slots![LINE, DISTANCE_OFF]];
}
