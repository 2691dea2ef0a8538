//! What can be reported of what an arm carries, and how far it reaches.

use super::kinds::{Kind, Unit, fields, numbers};

fields! {
    PAYLOAD: "payload_kg", Kind::Number(Unit::Kilogram), "Nominal payload.";
    TOOL_MASS: "tool_mass_kg", Kind::Number(Unit::Kilogram), "Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers frequencies.";
    OVERLOADED: "overloaded", Kind::Truth, "The tool and a mass that weighs as much as the force are more than the payload together; null where no payload is known.";
    WRIST_MOMENT: "wrist_moment_nm", numbers(Unit::Given("nm"), &["wrist_moment_4_nm", "wrist_moment_5_nm", "wrist_moment_6_nm"]),
        "Moments about axes 4, 5 and 6 at worst over the angles of these joints and the directions: of the tool's weight where its mass centre was given, and in the spatial model of the force at the tool tip.";
    WRIST_LIMIT: "wrist_limit_nm", numbers(Unit::Given("nm"), &["wrist_limit_4_nm", "wrist_limit_5_nm", "wrist_limit_6_nm"]), "The largest that are allowed; null where the robot file has none.";
    WRIST_LIMIT_BY: "wrist_limit_by", Kind::Text, "What says so: `allowed by the maker`, or `torque limits of the drives`, above which they do not hold the load even at rest.";
    WRIST_EXCEEDED: "wrist_exceeded", Kind::Truth, "A moment about axis 4, 5 or 6 is above its limit; null where no limit is known.";
    REACH: "reach_m", Kind::Number(Unit::Metre), "Reach by the data sheet, from the joint-1 axis.";
    L2: "l2_m", Kind::Number(Unit::Metre), "Upper arm.";
    L3: "l3_m", Kind::Number(Unit::Metre), "Elbow to wrist centre.";
    FLOOR: "bound_um_per_n", Kind::Number(Unit::MicrometrePerNewton), "Compliance at the stiffest posture of the links; null where the planar model does not hold.";
}
