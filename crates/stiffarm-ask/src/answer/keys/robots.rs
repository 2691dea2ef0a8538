//! What can be reported of robots, their files, and what is printed of them.

use super::kinds::{Kind, Unit, fields};
use super::slots::{shapes, slots};

fields! {
    MASS: "mass_kg", Kind::Number(Unit::Kilogram), "Mass of the arm.";
    REPEATABILITY: "repeatability_mm", Kind::Number(Unit::Millimetre), "Repeatability by the data sheet.";
    SOURCE: "source", Kind::Text, "Where it is published.";
    SOURCES: "source", Kind::ByName(&Kind::Text), "Where it is published, by what of the robot's file: geometry, limits, mass, ...";
    ITEM: "item", Kind::Text, "What it is of.";
    CELL: "cell", Kind::Text, "Which number.";
    PRINTED: "printed", Kind::Text, "As it is printed.";
    COMPUTED: "computed", Kind::Number(Unit::One), "As it is computed.";
    AGREES: "agrees", Kind::Truth, "The two agree to the digits that are printed.";
    NOTE: "note", Kind::Text, "Why they do not.";
    FILE: "file", Kind::Text, "The robot file.";
    USABLE: "usable", Kind::Truth, "It can be used.";
    LINE: "line", Kind::Count, "From 1.";
    KEY: "key", Kind::Text, "What it is called.";
    MESSAGE: "message", Kind::Text, "What is wrong or odd.";
    VALUE: "value", Kind::Text, "As people read it.";
}

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
