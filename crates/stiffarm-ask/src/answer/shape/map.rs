//! Which fields does a map have?

use super::groups::{OF_FORCE, OF_ROBOT, OF_TOOL_BODY};
use super::place::PLACEMENT;
use super::{Slot, shapes, slots};

shapes! {
    MAP: "MapDict", "What `map` answers.", &[
        OF_ROBOT, slots![MODEL], OF_FORCE, OF_VIEW, OF_TOOL_BODY, OF_ZONE,
        slots![
            X_OF_COLUMNS, Z_OF_ROWS, WORST_OF_CELLS | null, DEFLECTION_OF_CELLS | null, LIMIT_MARGIN_OF_CELLS | null,
            SINGULAR_MARGIN_OF_CELLS | null, POSTURE_OF_CELLS | null, ROLL_OF_CELLS | null, FREQUENCY_OF_CELLS | null,
        ],
    ];
    MAP_HEAD: "MapHead", "What a map has besides its cells.",
        &[OF_ROBOT, slots![MODEL], OF_FORCE, OF_VIEW, OF_TOOL_BODY, OF_ZONE];
}

const OF_VIEW: &[Slot] =
    slots![DIRECTION | null, ELBOW_MAPPED | null, TOOL | null, TOOL_DIRECTION | null, ROLL_TOLERANCE | null];

const OF_ZONE: &[Slot] = slots![SLOWEST_P05 | null, ZONE | null => PLACEMENT];
