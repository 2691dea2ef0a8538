//! What is asked of a study of two architectures.

use super::super::kind::{Count, Kind, count, count_of, number_of};
use super::super::opt;
use super::super::setting::{Absent, Setting};
use super::super::verb::Verb;
use super::shared::{ROW, SEVERAL};

const EACH: Count = count_of(1, 2, "values", "one for both architectures, or two");
const STUDY: &[Verb] = &[Verb::Study];
/// Of the drives' compliances in a study.
const RELATIVE: Setting = Setting {
    verbs: STUDY,
    kind: Kind::Number { min: 1e-3, max: 1e3, of: "times the reference, or 0 for a rigid drive", or_zero: true },
    count: EACH,
    value: "K",
    absent: Absent::Default("1"),
    example: "0.5",
    ..ROW
};

pub(super) const ROWS: &[Setting] = &[
    opt::TASKS.row(Setting {
        verbs: STUDY,
        kind: Kind::Shape,
        count: SEVERAL,
        value: "SHAPES",
        absent: Absent::Default("A,B,C"),
        help: "Shapes at size 1: A, B, C, or such as rect:1x3; the shape of the task is studied besides, and instead where nothing is said here",
        example: "A,rect:1x3",
        ..ROW
    }),
    opt::ROBOT.row(Setting {
        verbs: STUDY,
        kind: Kind::Robot,
        value: "ROBOT",
        needs: &[(Verb::Study, "task")],
        help: "A robot that is to be found among all this with its task: a name, or the path of a robot file",
        example: "KR 210 R2700 extra",
        ..ROW
    }),
    opt::FLAT_TASK.row(Setting {
        verbs: STUDY,
        kind: Kind::Zone,
        value: "TASK",
        help: "A flat zone at its size, whose shape is studied: where it stands with a robot is marked, with the architecture that is stiffer there",
        example: "rect:0.6x0.4",
        ..ROW
    }),
    opt::SIZES.row(Setting {
        verbs: STUDY,
        kind: number_of(1e-4, 10.0, "times l2 + l3"),
        count: SEVERAL,
        value: "SIZES",
        absent: Absent::Default("0.1,0.3,0.5,0.8"),
        help: "Sizes over l2 + l3",
        example: "0.1,0.5",
        ..ROW
    }),
    opt::RATIOS.row(Setting {
        verbs: STUDY,
        kind: number_of(0.05, 20.0, "(l3 over l2)"),
        count: SEVERAL,
        value: "RATIOS",
        absent: Absent::Default("0.8,1,1.2"),
        help: "Link ratios mu = l3/l2",
        example: "0.9",
        ..ROW
    }),
    opt::RANGE.row(Setting {
        verbs: STUDY,
        kind: Kind::Range { is_bounded: true },
        value: "RANGE",
        absent: Absent::Default("0.5..1.5"),
        help: "Link ratios among which the best is searched for",
        example: "0.6..1.4",
        ..ROW
    }),
    opt::COMPARE.row(Setting {
        verbs: STUDY,
        count: count(2, "architectures", "two, e.g. serial,quasi-serial"),
        value: "TWO",
        absent: Absent::Default("serial,quasi-serial"),
        help: "The two architectures that are compared",
        example: "serial,serial",
        ..ROW
    }),
    opt::K2.row(Setting {
        help: "Compliance of drive 2 over the reference k, for both or one each; 0: rigid",
        ..RELATIVE
    }),
    opt::K3.row(Setting {
        help: "Compliance of drive 3 over the reference k, for both or one each; 0: rigid",
        ..RELATIVE
    }),
];
