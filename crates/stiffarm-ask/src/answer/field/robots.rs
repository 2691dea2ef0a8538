//! What can be reported of robots, their files, and what is printed of them.

use super::kinds::{Kind, Unit, fields};

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
