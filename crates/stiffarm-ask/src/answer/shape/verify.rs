//! Which fields has a way of counting the joints?

use super::{shapes, slots};

shapes! {
    FITTING_ROBOTS: "FittingRobotsDict", "What `robots verify` answers without a robot.",
        &[slots![VERIFIED, READ_ROWS, FITS => WAY_OF_COUNTING]];
    VERIFICATION: "VerificationDict", "What `robots verify` answers of a robot.", &[slots![
        ROBOT, VERIFIED, READ_ROWS, MEASURED_POINTS, LARGEST_OFF, OFF, LARGEST_TURN | null, BASE_SEEN, POINTS_SEEN,
        FITS => WAY_OF_COUNTING, ALIKE, POSTURES_TO_READ, WRONG_ROW | null => WRONG_READING,
    ]];
    WAY_OF_COUNTING: "WayOfCounting", "A way of counting the joints.", &[slots![
        ROBOT, VENDOR, THIRD_AXIS, SIGN, ZERO, CARRIED, OFF, LARGEST_OFF, LARGEST_TURN | null, DIFFERS, DIFFERENCES,
    ]];
    WRONG_READING: "WrongReading", "The row that does not agree.", &[slots![LINE, DISTANCE_OFF]];
}
