//! What can be reported of several robots or setups.

use super::groups::{OF_CHANCES, OF_FORCE, OF_ROBOT};
use super::kinds::{Kind, Unit, fields};
use super::place::shape::PLACEMENT_IN_RANKING;
use super::slots::{Slot, shapes, slots};

fields! {
    RANK: "rank", Kind::Count, "One more than the robots that are certainly better, their values below its bound; none for a robot that is estimated, or of which nothing is known.";
    RANK_TIED: "rank_tied", Kind::Truth, "Some other robot cannot be distinguished from it by the proof, at the nominal stiffness.";
    TASK_RANK: "task_rank", Kind::Count, "The same for this task alone.";
    TASK_RANK_TIED: "task_rank_tied", Kind::Truth, "Some other robot cannot be distinguished from it by the proof in this task.";
    PLANAR_RANK: "planar_rank", Kind::Count, "The rank in the planar ranking of the same robots and tasks.";
    BOUND: "bound_mm", Kind::Number(Unit::Millimetre), "Deflection at the stiffest posture of the links.";
    MEAN_RATIO: "mean_ratio", Kind::Number(Unit::One), "How much worse than the best of each task, geometric mean.";
    MEAN_RATIO_BOUND: "mean_ratio_bound", Kind::Number(Unit::One), "The same of the proved lower bounds.";
    TASKS: "tasks", Kind::List(&Kind::Text), "The tasks as they were asked for.";
    CELLS: "cells", Kind::Objects, "One placement per task.";
    ROWS: "rows", Kind::Objects, "One entry per row.";
    WINNERS: "winners", Kind::Objects, "Who is best at each task.";
    BEST: "best", Kind::Text, "The best robot whose geometry and limits are published: of those that may be taken (clear, and strong enough for the tool), or where none may, of all.";
    BEST_WITH_ESTIMATED: "best_with_estimated", Kind::Text, "The best robot of all.";
    BEST_SERIAL: "best_serial", Kind::Text, "The best serial robot.";
    BEST_QUASI_SERIAL: "best_quasi_serial", Kind::Text, "The best quasi-serial robot.";
    DISTINGUISHED: "told_apart", Kind::Truth, "It is proved that no other is as good, at the nominal stiffness.";
    RIVALS: "rivals", Kind::List(&Kind::Text), "Robots of published geometry that may be as good as the best.";
    SETUP: "setup", Kind::Text, "a or b, of two that are compared.";
    SETUP_A: "a", Kind::Object, "The first setup, as place tells it.";
    SETUP_B: "b", Kind::Object, "The second setup.";
    SETUP_RATIO: "ratio", Kind::Number(Unit::One), "The deflection of the second over that of the first; null where one has no place.";
    BETTER_SETUP: "better", Kind::Text, "Which of the two is better, a or b, which is proved at the nominal stiffness; null where they cannot be distinguished.";
    DIFFERENT: "differ_in", Kind::List(&Kind::Text), "What is not the same of both besides the answer: robot, stiffness, model, tool, tool mass, tool direction, force, component, task, tolerance, margins, mount, allowed place, angle, gap.";
    SUMMARY: "summary", Kind::List(&Kind::Text), "What a manager would read.";
}

shapes! {
    RANKING: "RankingDict", "What `rank` answers.", &[
        slots![TASKS], OF_FORCE, slots![MODEL, ROWS => RANKING_ROW, WINNERS => WINNER, SUMMARY],
    ];
    RANKING_ROW: "RankingRow", "One robot of a ranking.",
        &[OF_ROBOT, OF_STANDING, OF_CHANCES, slots![CELLS => PLACEMENT_IN_RANKING]];
    STANDING: "Standing", "Where a robot stands among others.", &[OF_STANDING];
    WINNER: "Winner", "Who is best at a task.", &[slots![
        TASK, BEST | null, DISTINGUISHED | null, RIVALS, BEST_WITH_ESTIMATED | null, BEST_SERIAL | null, BEST_QUASI_SERIAL | null,
    ]];
}

const OF_STANDING: &[Slot] = slots![
    RANK | null,
    RANK_TIED | null,
    PLANAR_RANK | null,
    BOUND | null,
    MEAN_RATIO | null,
    MEAN_RATIO_BOUND | null,
];
