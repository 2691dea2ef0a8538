//! What can be told of a map.

use super::kinds::{Kind, Unit, fields};

fields! {
    WORST: "worst_mm", Kind::Number(Unit::Millimetre), "Deflection under the force in its worst direction.";
    DIRECTED: "deflection_mm", Kind::Number(Unit::Millimetre), "Deflection under the force in the direction asked for.";
    DIRECTION: "direction_deg", Kind::Number(Unit::Given("deg")), "Of the force in the arm plane, from straight ahead.";
    ROLL_TOLERANCE: "roll_tolerance", Kind::Number(Unit::One), "How much more than at the best roll a point may tell, relative.";
    POSTURE: "posture", Kind::Text, "The configuration that holds a point.";
    ZONE: "zone", Kind::Nested, "The best placement of the task that was given.";
}
