//! How sure are deflections and ranks?

use super::numbers::fixed;
use super::{Line, Record, Unit, field, line};
use stiffarm::drive::Knowledge;
use stiffarm::load::Load;
use stiffarm::place::Placement;
use stiffarm::rank::Ranking;
use stiffarm::robot::{Arm, Robot};
use stiffarm::task::Task;
use stiffarm::uncertainty::{Chances, DRAWS, Spread, drawn, share_within};

/// So many robots are named.
const MOST_NAMED: usize = 10;

/// What is known of a deflection as far as the drives, and the model of a robot that was measured, may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Known {
    /// Where it lies with 90 %.
    pub(super) spread: Spread,
    /// How likely it keeps the tolerance that was given.
    pub(super) holds: Option<f64>,
}

impl Known {
    /// By draws of a deflection, m, at least one, against a tolerance, mm.
    pub(super) fn of(draws: Vec<f64>, tolerance_mm: Option<f64>) -> Self {
        // As a deflection is compared.
        let holds = |mm: f64| share_within(&draws, mm / Unit::Millimetre.of_si(1.0));
        Self { holds: tolerance_mm.map(holds), spread: Spread::of(draws) }
    }

    /// Of a placement; `None` where the drive stiffness has no stated uncertainty.
    pub(super) fn at(robot: &Robot, load: Load, best: Option<&Placement>, tolerance_mm: Option<f64>) -> Option<Self> {
        Some(Self::of(drawn(robot, load, best?)?, tolerance_mm))
    }
}

/// As fields; null where the drive stiffness has no stated uncertainty.
pub(super) fn put(record: &mut Record, spread: Option<Spread>) {
    record
        .put(field::DEFLECTION_P05, spread.map(|spread| spread.p05))
        .put(field::DEFLECTION_P50, spread.map(|spread| spread.median))
        .put(field::DEFLECTION_P95, spread.map(|spread| spread.p95));
}

/// For people.
pub(super) fn row(robot: &Robot, spread: Option<Spread>) -> Option<Line> {
    let mm = |metres: f64| fixed(Unit::Millimetre.of_si(metres), 3);
    let Spread { p05, median, p95 } = spread?;
    Some(line(
        format!("90 % interval ({})", of_what(robot)),
        format!("{} .. {} mm, median {} mm", mm(p05), mm(p95), mm(median)),
    ))
}

/// What an interval is about.
pub(super) fn of_what(robot: &Robot) -> &'static str {
    if robot.identified().is_some() { "drive stiffness and identification residual" } else { "drive stiffness" }
}

/// Every robot's chances at every task, as fields of a row of the ranking.
pub(super) fn put_chances(record: &mut Record, of_row: &[Option<Chances>]) {
    let each =
        |pick: fn(&Chances) -> f64| -> serde_json::Value { of_row.iter().map(|one| one.as_ref().map(pick)).collect() };
    let ties: serde_json::Value = of_row.iter().map(|one| one.as_ref().map(|one| one.ties)).collect();
    record
        .put(field::WIN_PROBABILITY, each(|one| one.win))
        .put(field::EXPECTED_REGRET, each(|one| one.regret))
        .put(field::TIES_WITH_BEST, ties);
}

/// How many robots tie at a task by what is known of the drives; none where no two say how far these may be off.
pub(super) fn ties(chances: &[Vec<Option<Chances>>], task: usize) -> usize {
    chances.iter().filter(|row| row[task].is_some_and(|one| one.ties)).count()
}

/// How sure the order is, task by task; nothing where no robot states the uncertainty of its drive stiffness.
pub(super) fn sentences(ranking: &Ranking, chances: &[Vec<Option<Chances>>]) -> Vec<String> {
    let of_task = |task: usize| {
        let of_rows = ranking.rows.iter().zip(chances);
        of_rows.filter_map(move |(row, chances)| Some((row.robot.name.as_str(), chances[task]?))).collect()
    };
    let sentence_of = |(task, asked): (usize, &Task)| sentence(&asked.label, of_task(task));
    ranking.tasks.iter().enumerate().filter_map(sentence_of).collect()
}

/// A share of the draws, to a tenth of a percent: so finely they tell it.
pub(super) fn share_of_draws(share: f64) -> String {
    format!("{} %", fixed(100.0 * share, 1))
}

/// The same of one task and the robots of which their chances are known.
pub(super) fn sentence(label: &str, mut known: Vec<(&str, Chances)>) -> Option<String> {
    known.sort_by(|a, b| b.1.win.total_cmp(&a.1.win));
    let (_, first) = known.first()?;
    let percent = |share: f64| format!("{} %", fixed(100.0 * share, 0));
    let named = known.iter().take(MOST_NAMED).filter(|(_, one)| 0.005 <= one.win);
    let named: Vec<String> = named.map(|(name, one)| format!("{name} {}", percent(one.win))).collect();
    let ties: Vec<&str> = known.iter().filter(|(_, one)| one.ties).map(|(name, _)| *name).collect();
    let tied = match ties.len() {
        0 | 1 if first.win < 0.95 => "the stiffness of no two overlaps".to_owned(),
        0 | 1 => "no other comes near".into(),
        count if count <= MOST_NAMED => {
            format!("the intervals of the stiffness overlap, so these tie: {}", ties.join(", "))
        }
        count => {
            format!(
                "the intervals of the stiffness overlap: a group of {count} robots ties, as no other beats any of them in 95 % of the draws"
            )
        }
    };
    Some(format!("{label}: stiffest in so many of {DRAWS} draws of the drives: {}; {tied}.", named.join(", ")))
}

/// Where publications of a robot's drives disagree.
pub(super) fn disagreement(robot: &Robot) -> Option<String> {
    let Arm::SixAxis { drives, .. } = &robot.arm else { return None };
    match &drives.scatter.as_ref()?.knowledge {
        Knowledge::Published { disagreement: Some((drive, ratio)), sources, .. } => {
            Some(format!("{} publications differ by a factor of {ratio:.1} in drive {}", sources.len(), drive + 1))
        }
        Knowledge::Published { .. } | Knowledge::Prior => None,
    }
}
