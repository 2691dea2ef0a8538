//! Which fields does a path have before it is milled?

use super::{shapes, slots};

shapes! {
    TOOLPATH: "ToolpathDict", "What `mill --dry` answers.", &[slots![
        PATH, PATH_FORMAT, LINES | null, FEED_LENGTH, RAPID_LENGTH, FEED_MOVES, RAPID_MOVES, TOOLS, APART, ARCS, FULL_CIRCLES, ARC_LENGTH,
        BOX | null, RAPID_BOX | null, FEEDS | null, FEED_TIME | null, TILT, AXIS_TURN, SAMPLES_OF_PATH, CHORD_ERROR, ARC_MISS, ASSUMED, IGNORED,
    ]];
}
