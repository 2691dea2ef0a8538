//! What is asked of the figure alone.

use super::super::kind::{Kind, number_of};
use super::super::opt;
use super::super::setting::{Absent, Setting};
use super::super::verb::Verb;
use super::shared::FIGURE;

pub(super) const ROWS: &[Setting] = &[
    opt::SCALE.row(Setting {
        kind: Kind::Range { is_bounded: true },
        unit: "mm, deg of margins, Hz of frequencies",
        value: "RANGE",
        absent: Absent::Means("what is found"),
        help: "From where to where the figure goes: A..B; the same for figures that are to be compared",
        example: "0..5",
        ..FIGURE
    }),
    opt::WIDTH_MM.row(Setting {
        verbs: &[
            Verb::Rank,
            Verb::Place,
            Verb::Map,
            Verb::Study,
            Verb::Compare,
            Verb::Identify,
            Verb::Measure,
            Verb::Calibrate,
            Verb::Force,
            Verb::Modes,
            Verb::Chatter,
            Verb::Mill,
        ],
        kind: number_of(40.0, 2000.0, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Means("1000 px"),
        help: "Width of the figure on paper, for svg, pdf and png at 300 dpi",
        example: "170",
        ..FIGURE
    }),
];
