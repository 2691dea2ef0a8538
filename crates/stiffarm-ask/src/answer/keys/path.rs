//! What can be reported of a toolpath as it is read.

use super::kinds::{Kind, Unit, fields, numbers};
use super::slots::{shapes, slots};

fields! {
    REMARKS: "remarks", Kind::List(&Kind::Text), "What is odd.";
    ENTRY: "row", Kind::Text, "Which row of a matrix.";
    PATH: "path", Kind::Text, "The toolpath as it was asked for.";
    PATH_FORMAT: "format", Kind::Text, "How it is written: gcode, apt, csv or built-in.";
    LINES: "lines", Kind::Count, "Lines that were read.";
    FEED_LENGTH: "feed_length_m", Kind::Number(Unit::Metre), "Length of all moves at a feed rate.";
    RAPID_LENGTH: "rapid_length_m", Kind::Number(Unit::Metre), "Length of all rapid moves whose beginning is known.";
    FEED_MOVES: "feed_moves", Kind::Count, "Moves at a feed rate.";
    TOOLS: "tools", Kind::List(&Kind::Maybe(&Kind::Count)), "Numbers of the tools that feed, in the order in which they come; null where none is named.";
    RAPID_MOVES: "rapid_moves", Kind::Count, "Rapid moves whose beginning is known.";
    APART: "machine_moves", Kind::Count, "Moves that are no part of the path: from where the file does not tell, or by coordinates of the machine.";
    ARCS: "arcs", Kind::Count, "Feed moves that are arcs or helices.";
    FULL_CIRCLES: "full_circles", Kind::Count, "Of these, those of a whole turn or more.";
    ARC_LENGTH: "arc_length_m", Kind::Number(Unit::Metre), "Length of the arcs.";
    BOX: "box_m", Kind::Numbers { unit: Unit::Metre, columns: &["box_x0_m", "box_y0_m", "box_z0_m", "box_x1_m", "box_y1_m", "box_z1_m"], nested: 3, open: false },
        "Two corners of the box about all feed moves, in the axes of the path.";
    RAPID_BOX: "rapid_box_m", Kind::Numbers { unit: Unit::Metre, columns: &["rapid_box_x0_m", "rapid_box_y0_m", "rapid_box_z0_m", "rapid_box_x1_m", "rapid_box_y1_m", "rapid_box_z1_m"], nested: 3, open: false },
        "Two corners of the box about the ends of all rapid moves whose beginning is known, in the axes of the path; null where there is none.";
    FEEDS: "feed_mm_per_min", numbers(Unit::MillimetrePerMinute, &["feed_min_mm_per_min", "feed_max_mm_per_min"]), "The smallest and the largest feed rate; null where none is said.";
    FEED_TIME: "time_s", Kind::Number(Unit::Second), "Time of all feed moves; null where a feed rate is missing.";
    SPINDLE_SPEEDS: "spindle_speeds_rpm", numbers(Unit::Given("rpm"), &["spindle_min_rpm", "spindle_max_rpm"]), "The slowest and the fastest that the spindle turns while it feeds; null where it is not said.";
    TILT: "tilt_deg", Kind::Number(Unit::Degree), "The largest angle between tool axis and z while it feeds.";
    AXIS_TURN: "turn_deg", Kind::Number(Unit::Degree), "The largest angle of the tool axis to where it first feeds.";
    CHORD_ERROR: "chord_error_mm", Kind::Number(Unit::Millimetre), "By how much chords between samples are off the arcs at most.";
    ARC_MISS: "arc_miss_mm", Kind::Number(Unit::Millimetre), "By how much the ends of an arc miss one radius at most.";
    ASSUMED: "assumed", Kind::List(&Kind::Text), "What the file leaves open and how it was taken, with the line that came first.";
    IGNORED: "ignored", Kind::List(&Kind::Text), "Words of the file that move nothing, each kind once.";
}

shapes! {
    TOOLPATH: "ToolpathDict", "What `mill --dry` answers.", &[slots![
        PATH, PATH_FORMAT, LINES | null, FEED_LENGTH, RAPID_LENGTH, FEED_MOVES, RAPID_MOVES, TOOLS, APART, ARCS, FULL_CIRCLES, ARC_LENGTH,
        BOX | null, RAPID_BOX | null, FEEDS | null, FEED_TIME | null, SPINDLE_SPEEDS | null, TILT, AXIS_TURN, SAMPLES_OF_PATH, CHORD_ERROR, ARC_MISS, ASSUMED, IGNORED,
    ]];
}
