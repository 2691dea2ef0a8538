//! What must a program know to read an answer?

use super::{shapes, slots};

shapes! {
    SCHEMA: "Schema", "What a program must know to read an answer.",
        &[slots![SCHEMA_VERSION, SCHEMA_VERB, SCHEMA_ORIGIN, SCHEMA_AXES, SCHEMA_UNITS]];
}
