//! A cell as it was asked for.

use super::kinds::{Kind, Unit, fields, numbers};

fields! {
    MOUNT: "mount", Kind::Text, "How the base is mounted: pedestal, wall, ceiling, or pose where it was given as one.";
    BASE_IN_CELL: "base_m", numbers(Unit::Metre, &[]), "The base in the axes of the cell, its floor at 0.";
    BASE_TURNED: "base_deg", numbers(Unit::Degree, &[]), "How it is turned, about fixed x, y and z.";
    WINDOWS: "within_m", Kind::List(&Kind::List(&Kind::List(&Kind::Maybe(&Kind::Number(Unit::Metre))))),
        "Where the work may stand: each window as ranges of x, y and z, or of the distance from the joint-1 axis and z; null where a range is open; empty where none was asked, and where one of two ranges counts from the base, straight ahead.";
    KEPT_FREE: "keep_out_m", Kind::List(&Kind::List(&Kind::List(&Kind::Maybe(&Kind::Number(Unit::Metre))))),
        "What is kept free: each box as ranges of x, y and z; null where a range is open.";
    CARRIES_BASE: "keep_out_carries_base", Kind::List(&Kind::Count), "Which of these boxes, from 1, the base stands in or on.";
    CLEARANCE_KEPT: "clearance_mm", Kind::Number(Unit::Millimetre), "What the arm was to keep from everything; null where it may touch.";
}
