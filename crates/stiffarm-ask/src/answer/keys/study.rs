//! What can be reported of architectures.

use super::kinds::{Kind, Unit, fields};
use super::slots::{shapes, slots};

fields! {
    SIZE: "d", Kind::Number(Unit::One), "The size over l2 + l3.";
    MU: "mu_l3_over_l2", Kind::Number(Unit::One), "The link ratio; null where every contender has its best.";
    IS_BEST: "best", Kind::Truth, "The link ratio is the best.";
    K2: "k2", Kind::Number(Unit::One), "Compliance of drive 2 over the reference.";
    K3: "k3", Kind::Number(Unit::One), "Compliance of drive 3 over the reference.";
    ACCURACY: "accuracy", Kind::Number(Unit::One), "The worst deflection over k F (l2 + l3)^2; null where the zone does not fit.";
    MARK: "mark", Kind::Object, "Where the robot with its task stands among what was studied.";
    ACCURACIES: "accuracies", Kind::List(&Kind::Maybe(&Kind::Number(Unit::One))), "What either contender would have there; null where the task does not fit.";
    STIFFER: "stiffer", Kind::Text, "The contender that has less.";
    BOUNDARIES: "boundaries", Kind::Objects, "Sizes at which the better architecture changes.";
    BETTER_BELOW: "better_below", Kind::Text, "The better contender for smaller tasks.";
    BETTER_ABOVE: "better_above", Kind::Text, "The better contender for larger tasks.";
}

shapes! {
    BOUNDARY: "Boundary", "A size at which the better one changes.", &[slots![TASK, MU | null, SIZE, BETTER_BELOW, BETTER_ABOVE]];
    STUDY: "StudyDict", "What `study` answers.",
        &[slots![ROWS => STUDY_ROW, BOUNDARIES => BOUNDARY, MARK | null => STUDY_MARK]];
    STUDY_MARK: "StudyMark", "A robot with its task among what was studied.",
        &[slots![ROBOT, TASK, MU, SIZE, ACCURACIES, STIFFER | null]];
    STUDY_ROW: "StudyRow", "One contender at one size.",
        &[slots![TASK, SIZE, MU | null, IS_BEST, ARCHITECTURE, K2, K3, ACCURACY | null]];
}
