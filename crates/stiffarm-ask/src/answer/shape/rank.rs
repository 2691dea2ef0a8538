//! Which fields does a ranking have?

use super::groups::{OF_CHANCES, OF_FORCE, OF_ROBOT};
use super::place::PLACEMENT_IN_RANKING;
use super::{Slot, shapes, slots};

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
