//! What can be reported of a map.

use super::groups::{OF_FORCE, OF_ROBOT, OF_TOOL_BODY};
use super::kinds::{Kind, Unit, fields};
use super::place::shape::PLACEMENT;
use super::slots::{Slot, shapes, slots};

fields! {
    WORST: "worst_mm", Kind::Number(Unit::Millimetre), "Deflection under the force in its worst direction.";
    DIRECTED: "deflection_mm", Kind::Number(Unit::Millimetre), "Deflection under the force in the direction asked for.";
    DIRECTION: "direction_deg", Kind::Number(Unit::Given("deg")), "Of the force in the arm plane, from straight ahead.";
    ELBOW_MAPPED: "elbow", Kind::Text, "The one side of the elbow that was asked for, up or down; null where the stiffer of each point is mapped.";
    ROLL_TOLERANCE: "roll_tolerance", Kind::Number(Unit::One), "How much more than at the best roll a point may tell, relative.";
    POSTURE: "posture", Kind::Text, "The configuration that holds a point.";
    X_OF_COLUMNS: "x_m", Kind::List(&Kind::Number(Unit::Metre)), "Ahead, from the base: of each column of cells.";
    Z_OF_ROWS: "z_m", Kind::List(&Kind::Number(Unit::Metre)), "Up, from the base: of each row of cells.";
    WORST_OF_CELLS: "worst_mm", GRID_MM, "Deflection under the force in its worst direction, row by row; null where a cell is not reached, and without rows where the force has a direction.";
    DEFLECTION_OF_CELLS: "deflection_mm", GRID_MM, "Deflection under the force in the direction asked for, row by row; null without rows where none was.";
    LIMIT_MARGIN_OF_CELLS: "limit_margin_deg", GRID_DEG, "The distance to the nearest joint limit, row by row; in space.";
    SINGULAR_MARGIN_OF_CELLS: "singular_margin_deg", GRID_DEG, "The angle to the nearest singular posture, row by row; in space.";
    POSTURE_OF_CELLS: "posture", Kind::List(&Kind::List(&Kind::Maybe(&Kind::Text))), "The configuration that holds each cell, row by row; in space.";
    ROLL_OF_CELLS: "roll_deg", GRID_DEG, "The roll about the tool axis, row by row; in space.";
    FREQUENCY_OF_CELLS: "first_frequency_hz", Kind::List(&Kind::List(&Kind::Maybe(&Kind::Number(Unit::Given("hz"))))), "The first natural frequency, row by row, where that was asked.";
    ZONE: "zone", Kind::Object, "The best placement of the task that was given.";
}

const GRID_MM: Kind = Kind::List(&Kind::List(&Kind::Maybe(&Kind::Number(Unit::Millimetre))));
const GRID_DEG: Kind = Kind::List(&Kind::List(&Kind::Maybe(&Kind::Number(Unit::Degree))));

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
