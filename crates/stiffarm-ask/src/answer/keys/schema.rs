//! What a program must know to read an answer.

use super::kinds::{Kind, fields};
use super::slots::{shapes, slots};

fields! {
    SCHEMA_VERSION: "version", Kind::Count, "The version of what keys mean.";
    SCHEMA_VERB: "verb", Kind::Text, "What was asked.";
    SCHEMA_ORIGIN: "origin", Kind::Text, "What positions count from.";
    SCHEMA_AXES: "axes", Kind::Text, "Which way axes point.";
    SCHEMA_UNITS: "units", Kind::Text, "Where the unit of a number stands.";
}

shapes! {
    SCHEMA: "Schema", "What a program must know to read an answer.",
        &[slots![SCHEMA_VERSION, SCHEMA_VERB, SCHEMA_ORIGIN, SCHEMA_AXES, SCHEMA_UNITS]];
}
