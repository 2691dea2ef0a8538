//! Which fields do lists of robots and of published numbers have?

use super::{shapes, slots};

shapes! {
    LEDGER: "LedgerDict", "What `validate` answers.", &[slots![ROWS => PUBLISHED_NUMBER]];
    LISTED_ROBOT: "ListedRobot", "A robot in a list.", &[slots![
        VENDOR, ROBOT, ARCHITECTURE, STATUS, PAYLOAD | null, REACH | null, L2 | null, L3 | null, FLOOR | null, ARCHITECTURE_ASSUMED,
        MASS | null, REPEATABILITY | null, STIFFNESS_SOURCE, DRIVE_COMPLIANCE,
    ]];
    ROBOT_SHEET: "RobotSheet", "What is known of a robot, besides the keys of its file.", &[slots![
        ROBOT, VENDOR, ARCHITECTURE, STATUS, ARCHITECTURE_ASSUMED, STIFFNESS_SOURCE, DRIVE_COMPLIANCE, PAYLOAD | null, REACH | null,
        MASS | null, REPEATABILITY | null, SOURCES,
    ]];
    PUBLISHED_NUMBER: "PublishedNumber", "A published number.",
        &[slots![SOURCE, ITEM, CELL, PRINTED, COMPUTED | null, AGREES, NOTE | null]];
}
