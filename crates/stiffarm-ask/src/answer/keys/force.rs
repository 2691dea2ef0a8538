//! What can be reported of the force of a process.

use super::kinds::{Kind, Unit, fields, numbers};

fields! {
    PROCESS: "process", Kind::Text, "The process file.";
    LAW: "law", Kind::Text, "Where the force comes from.";
    MATERIAL: "material", Kind::Text, "The material whose numbers come with the program; null where they are given.";
    MATERIAL_STATUS: "material_status", Kind::Text, "How well its numbers are known: published or unverified.";
    MATERIAL_SOURCE: "material_source", Kind::Text, "Who says so.";
    MEAN_FORCE: "mean_n", numbers(Unit::Newton, &["mean_feed_n", "mean_across_n", "mean_axial_n"]), "Mean force over a revolution, on the tool: along the feed, across (left of it), axial (away from the work); null where it may point anywhere.";
    MAX_FORCE: "max_n", numbers(Unit::Newton, &["max_feed_n", "max_across_n", "max_axial_n"]), "The largest of each over a revolution.";
    MIN_FORCE: "min_n", numbers(Unit::Newton, &["min_feed_n", "min_across_n", "min_axial_n"]), "The smallest of each over a revolution.";
    PEAK_FORCE: "largest_n", Kind::Number(Unit::Newton), "The largest size of the force over a revolution.";
    MOMENT: "moment_nm", Kind::Number(Unit::NewtonMetre), "Mean moment on the tool about its axis, positive about the axis away from the work.";
    POWER: "power_w", Kind::Number(Unit::Watt), "Mean power of the spindle; null where its speed or the moment is not known.";
    SPINDLE_SPEED: "spindle_rpm", Kind::Number(Unit::Given("rpm")), "Speed of the spindle.";
    ENTRY_ANGLE: "entry_deg", Kind::Number(Unit::Degree), "Where a tooth enters, in the sense of the rotation from the left of the feed, of a spindle that turns counter-clockwise from its right.";
    EXIT_ANGLE: "exit_deg", Kind::Number(Unit::Degree), "Where a tooth leaves.";
    CUTTING_FORCE: "force", Kind::Text, "Where the force on the tool comes from.";
}
