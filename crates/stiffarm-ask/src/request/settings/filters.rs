//! Which robots of the catalogue are meant.

use super::super::kind::Kind;
use super::super::opt;
use super::super::setting::Setting;
use super::shared::{FILTER, SEVERAL};

pub(super) const ROWS: &[Setting] = &[
    opt::VENDOR.row(Setting {
        count: SEVERAL,
        help: "Only robots of these makers, separated by commas",
        example: "KUKA,ABB",
        ..FILTER
    }),
    opt::PAYLOAD_KG.row(Setting {
        kind: Kind::Range { is_bounded: false },
        unit: "kg",
        value: "RANGE",
        help: "Only robots with a payload in this range: A..B; either end may be left open",
        example: "200..",
        ..FILTER
    }),
    opt::REACH_M.row(Setting {
        kind: Kind::Range { is_bounded: false },
        unit: "m",
        value: "RANGE",
        help: "Only robots with a reach in this range: A..B; either end may be left open",
        example: "..2.8",
        ..FILTER
    }),
    opt::ARCHITECTURE.row(Setting {
        help: "Only robots of this architecture: serial or quasi-serial",
        example: "serial",
        ..FILTER
    }),
    opt::STATUS.row(Setting {
        count: SEVERAL,
        help: "Only robots of these statuses: identified, data-sheet, derived, estimated; separated by commas",
        example: "data-sheet,derived",
        ..FILTER
    }),
];
