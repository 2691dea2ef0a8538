//! What a manager would read of a ranking, and why there is no advice where there is none.

use super::super::advice;
use super::super::stiffness;
use super::super::uncertainty;
use super::super::verdict::{Verdict, percent};
use super::super::words::{self, fixed};
use super::RankAnswer;
use super::notes::MOST_NAMED;
use stiffarm::drive::Architecture;
use stiffarm::model::ModelKind;
use stiffarm::rank::Row;
use stiffarm::robot::{Robot, Status};

/// So many of those that keep a tolerance are named.
const MOST_ADVISED: usize = 10;

impl RankAnswer {
    /// What a manager would read.
    pub fn sentences(&self) -> Vec<String> {
        let mut sentences = vec![self.winning()];
        sentences.extend(self.passed_over());
        sentences.extend(self.elsewhere());
        sentences.extend(self.by_architecture());
        sentences.extend(self.estimated_rivals());
        sentences.extend(self.tolerance_mm.map(|tolerance| self.within_tolerance(tolerance)));
        sentences.extend(self.advice_of_the_best());
        sentences.extend(uncertainty::sentences(&self.ranking, &self.chances));
        sentences
    }

    /// Why the answer is no, where it is: no robot of published geometry has a place for every task and holds the tolerance there.
    pub fn shortfall(&self) -> Option<String> {
        let holds =
            |deflection: f64| self.tolerance_mm.is_none_or(|tolerance| Verdict::of(deflection, tolerance).passes);
        let holds_all = |row: &Row| (0..row.cells.len()).all(|task| row.deflection(task).is_some_and(holds));
        let does = |row: &&Row| row.rank.is_some() && holds_all(row) && !self.is_barred(row);
        if self.ranking.rows.iter().any(|row| does(&row)) {
            return None;
        }
        Some(match self.tolerance_mm {
            Some(tolerance) => {
                format!("no robot of published geometry holds {tolerance} mm on every task{}", self.clearly())
            }
            None => format!("no robot of published geometry has a place for every task{}", self.clearly()),
        })
    }

    /// A robot is not to be taken, whatever its deflections: its arm collides, or it carries more than it may.
    pub(in crate::answer) fn is_barred(&self, row: &Row) -> bool {
        self.collides_somewhere(row) || self.carried(&row.robot).is_exceeded()
    }

    /// A robot that is not to be taken, and why.
    fn barred(&self, row: &Row) -> String {
        let why =
            [self.carried(&row.robot).exceeded(), self.collides_somewhere(row).then(|| "its arm collides".to_owned())];
        format!("{} ({})", row.robot.name, why.into_iter().flatten().collect::<Vec<_>>().join("; "))
    }

    /// What a robot must do besides, where some robot does not.
    fn clearly(&self) -> &'static str {
        let rows = &self.ranking.rows;
        match (
            rows.iter().any(|row| self.collides_somewhere(row)),
            rows.iter().any(|row| self.carried(&row.robot).is_exceeded()),
        ) {
            (false, false) => "",
            (true, false) => " and keeps clear",
            (false, true) => " and carries tool and force",
            (true, true) => ", keeps clear and carries tool and force",
        }
    }

    /// The tasks of each robot that `pick` names for a task, in the order in which robots are named first.
    fn tasks_by_robot<'a>(&self, pick: impl Fn(usize) -> Option<&'a Row>) -> Vec<(&'a Row, Vec<usize>)> {
        let mut found: Vec<(&Row, Vec<usize>)> = Vec::new();
        for task in 0..self.ranking.tasks.len() {
            let Some(picked) = pick(task) else { continue };
            match found.iter_mut().find(|(row, _)| row.robot == picked.robot) {
                Some((_, tasks)) => tasks.push(task),
                None => found.push((picked, vec![task])),
            }
        }
        found
    }

    fn labels(&self, tasks: &[usize]) -> String {
        tasks.iter().map(|&task| self.ranking.tasks[task].label.as_str()).collect::<Vec<_>>().join(", ")
    }

    fn winning(&self) -> String {
        let ranking = &self.ranking;
        let winners = self.tasks_by_robot(|task| self.best_published(task));
        if winners.is_empty() {
            return "No robot whose geometry is published can do any of these tasks.".into();
        }
        let list = |winners: &[(&Row, Vec<usize>)]| {
            let of = |(row, tasks): &(&Row, Vec<usize>)| {
                let value = |&task: &usize| format!("{} ({} mm)", ranking.tasks[task].label, millimetres(row, task, 2));
                let tasks = tasks.iter().map(value).collect::<Vec<_>>().join(", ");
                format!("{} for {tasks}", with_payload(&row.robot))
            };
            winners.iter().map(of).collect::<Vec<_>>().join("; ")
        };
        let under = self.under();
        let collisions = self.collisions(&winners);
        if !collisions.is_empty() {
            return format!(
                "{under} the least deflection is that of {}; but an arm collides there, so no robot is advised ({}). --clearance-mm 0 asks for places that keep clear.",
                list(&winners),
                collisions.join("; ")
            );
        }
        let fails = |row: &Row, task: usize| {
            let compared = self.tolerance_mm.zip(row.deflection(task));
            compared.is_some_and(|(tolerance, deflection)| !Verdict::of(deflection, tolerance).passes)
        };
        if winners.iter().any(|(row, tasks)| tasks.iter().any(|&task| fails(row, task))) {
            return format!(
                "{under} the least deflection is that of {}; it does not keep the tolerance everywhere, so no robot is advised.",
                list(&winners)
            );
        }
        let is_rather_missed =
            |row: &Row, task: usize| self.verdict_of(row, task).is_some_and(Verdict::is_rather_missed);
        if winners.iter().any(|(row, tasks)| tasks.iter().any(|&task| is_rather_missed(row, task))) {
            return format!(
                "{under} the least deflection is that of {}; by what is known of its drives it more likely misses the tolerance than keeps it, so no robot is advised.",
                list(&winners)
            );
        }
        let exceeded = winners
            .iter()
            .filter_map(|(row, _)| Some(format!("{}: {}", row.robot.name, self.carried(&row.robot).exceeded()?)));
        let exceeded: Vec<String> = exceeded.collect();
        if !exceeded.is_empty() {
            return format!(
                "{under} the least deflection is that of {}; but tool and force are more than a robot may carry, so no robot is advised ({}). --payload-kg leaves robots for less out.",
                list(&winners),
                exceeded.join("; ")
            );
        }
        let ties = |task: usize| uncertainty::ties(&self.chances, task);
        let is_alone = |task: usize| self.rivals(task).is_empty() && ties(task) < 2;
        let decided = self.tasks_by_robot(|task| self.best_published(task).filter(|_| is_alone(task)));
        let undecided = |task: usize| self.undistinguished(task).or_else(|| self.tied_by_drives(task, ties(task)));
        let open: Vec<String> = (0..ranking.tasks.len()).filter_map(undecided).collect();
        match (decided.as_slice(), open.is_empty()) {
            (decided, true) => format!("{under} take {}.", list(decided)),
            ([], false) => format!("{under} no robot is advised: {}.", open.join("; ")),
            (decided, false) => {
                format!("{under} take {}; no robot is advised where {}.", list(decided), open.join("; "))
            }
        }
    }

    /// Stiffer robots that are not to be taken.
    fn passed_over(&self) -> Option<String> {
        let stiffer = |task: usize| {
            let best = self.best_published(task)?;
            let stiffest = self.ranking.best_published(task)?;
            (stiffest.robot != best.robot).then_some(stiffest)
        };
        let named: Vec<String> = self
            .tasks_by_robot(stiffer)
            .iter()
            .map(|(row, tasks)| format!("{} on {}", self.barred(row), self.labels(tasks)))
            .collect();
        (!named.is_empty()).then(|| format!("Stiffer, but not to be taken: {}.", named.join("; ")))
    }

    /// Under what the robots are compared: the force, how stiff the drives are taken to be, and in the arm plane how zones stand.
    fn under(&self) -> String {
        let robots = self.ranking.rows.iter().map(|row| &row.robot);
        let (acting, drives) = (words::acting(self.ranking.load), stiffness::sources(robots));
        let upright = match self.ranking.model {
            ModelKind::Planar => format!(", zones {}", words::UPRIGHT),
            ModelKind::Spatial(_) => String::new(),
        };
        format!("Under {acting}, {drives}{upright}:")
    }

    /// The best of a task with all that may be as good, where there are some.
    fn undistinguished(&self, task: usize) -> Option<String> {
        let (best, rivals) = (self.best_published(task)?, self.rivals(task));
        let (first, others) = rivals.split_first()?;
        let named = |row: &Row| {
            let bound = row.placement(task).map_or_else(|| "-".into(), |best| fixed(best.lower_bound * 1e3, 3));
            let value = row.deflection(task).map_or_else(|| "-".into(), |value| fixed(value * 1e3, 3));
            format!("{} ({bound} to {value} mm)", row.robot.full_name())
        };
        let mut names = vec![named(first)];
        names.extend(others.iter().take(MOST_NAMED - 1).map(|row| named(row)));
        let more = others.len().saturating_sub(MOST_NAMED - 1);
        let more = if more == 0 { String::new() } else { format!(" and {more} more") };
        let label = &self.ranking.tasks[task].label;
        Some(format!("{} and {}{more} cannot be distinguished on {label}", named(best), names.join(", ")))
    }

    /// The best of a task that is none by what is known of the drives: so many tie.
    fn tied_by_drives(&self, task: usize, ties: usize) -> Option<String> {
        let best = self.best_published(task).filter(|_| 1 < ties)?;
        let (name, label) = (best.robot.full_name(), &self.ranking.tasks[task].label);
        Some(format!("{name} gives way least on {label}, but by what is known of the drives {ties} robots tie"))
    }

    /// Where the planar model alone would have chosen another robot.
    fn elsewhere(&self) -> Option<String> {
        let planar = self.ranking.in_plane.as_ref()?;
        let other = |task: usize| {
            let best = planar.best_published(task)?;
            let same = self.best_published(task).is_some_and(|row| row.robot == best.robot);
            let is_open = !(self.rivals(task).is_empty() && planar.rivals(task).is_empty());
            (!same && !is_open).then_some(best)
        };
        let others: Vec<String> = self
            .tasks_by_robot(other)
            .iter()
            .map(|(row, tasks)| format!("{} for {}", row.robot.full_name(), self.labels(tasks)))
            .collect();
        (!others.is_empty())
            .then(|| format!("The planar model alone, anywhere and without margins, would take {}.", others.join("; ")))
    }

    fn by_architecture(&self) -> Option<String> {
        let ranking = &self.ranking;
        let best = |task, architecture| self.best(task, |robot: &Robot| robot.architecture == architecture);
        let compared = |task: usize| {
            let (serial, quasi) = (best(task, Architecture::Serial)?, best(task, Architecture::QuasiSerial)?);
            let show = |row: &Row| {
                let mark = if row.robot.status == Status::Estimated { "~" } else { "" };
                // Two that are distinguished look so.
                let [two, four] = [2, 4].map(|digits| millimetres(row, task, digits));
                let others = [serial, quasi].map(|row| millimetres(row, task, 2));
                format!("{}{mark}", if others[0] == others[1] { four } else { two })
            };
            let is_less = serial.deflection(task) <= quasi.deflection(task);
            let (better, worse) = if is_less { (serial, quasi) } else { (quasi, serial) };
            let label = &ranking.tasks[task].label;
            // The bound of the worse lies below the value of the better.
            if worse.placement(task)?.lower_bound <= better.deflection(task)? {
                return Some(format!("{label} {} and {}, not distinguished", show(serial), show(quasi)));
            }
            let sign = if is_less { "<" } else { ">" };
            Some(format!("{label} {} {sign} {}", show(serial), show(quasi)))
        };
        let cells: Vec<String> = (0..ranking.tasks.len()).filter_map(compared).collect();
        let assumed = |task| best(task, Architecture::Serial).is_some_and(|row| row.robot.architecture_is_assumed);
        let serial = if (0..ranking.tasks.len()).any(assumed) { "serial?" } else { "serial" };
        (!cells.is_empty()).then(|| format!("Best {serial} against best quasi-serial, mm: {}.", cells.join("; ")))
    }

    fn estimated_rivals(&self) -> Option<String> {
        let rivals = self.tasks_by_robot(|task| {
            let best = self.best(task, |_| true)?;
            let rivals = best.robot.status == Status::Estimated && self.best_published(task).is_some();
            rivals.then_some(best)
        });
        let rivals: Vec<String> =
            rivals.iter().map(|(row, tasks)| format!("{} on {}", row.robot.name, self.labels(tasks))).collect();
        (!rivals.is_empty()).then(|| {
            format!(
                "By estimated numbers {} would be stiffer: find its data sheet before you decide.",
                rivals.join("; ")
            )
        })
    }

    /// Of every robot that got advice: what it says of the task that it does worst.
    fn advice_of_the_best(&self) -> Vec<String> {
        let of = |(at, row): (usize, &Row)| {
            let value = |task: usize| row.deflection(task).unwrap_or(f64::INFINITY);
            let advised = (0..row.cells.len()).filter_map(|task| Some((task, self.advised(at, task)?)));
            let (task, found) = advised.max_by(|a, b| value(a.0).total_cmp(&value(b.0)))?;
            if self.is_barred(row) {
                return None;
            }
            let asked = &self.ranking.tasks[task];
            let text = advice::sentence(found, (asked, self.ranking.load));
            Some(format!("{} on {}: {text}.", row.robot.full_name(), asked.label))
        };
        self.ranking.rows.iter().enumerate().filter_map(of).collect()
    }

    fn within_tolerance(&self, tolerance: f64) -> String {
        let keeps = |row: &&Row| {
            (0..row.cells.len())
                .all(|task| row.deflection(task).is_some_and(|deflection| Verdict::of(deflection, tolerance).passes))
        };
        let keeping: Vec<&Row> = self.ranking.rows.iter().filter(keeps).collect();
        let passing: Vec<&Row> = keeping.iter().copied().filter(|row| !self.is_barred(row)).collect();
        let odd: Vec<String> = keeping.iter().filter(|row| self.is_barred(row)).map(|row| self.barred(row)).collect();
        let named_odd = odd.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join("; ");
        let odd = match odd.len() {
            0 => String::new(),
            1 => format!(" One more keeps it and is not to be taken: {named_odd}."),
            count => {
                let more = if MOST_NAMED < count { format!(" and {} more", count - MOST_NAMED) } else { String::new() };
                format!(" {count} more keep it and are not to be taken: {named_odd}{more}.")
            }
        };
        if passing.is_empty() {
            return format!("No robot keeps {tolerance} mm on every task{}.{odd}", self.clearly());
        }
        let is_sure =
            |row: &&&Row| (0..row.cells.len()).all(|task| self.verdict_of(row, task).is_some_and(Verdict::is_sure));
        let sure: Vec<String> = passing.iter().filter(is_sure).map(|row| words::marked(&row.robot)).collect();
        let surely = if sure.is_empty() || sure.len() == passing.len() {
            String::new()
        } else {
            format!(" With a probability of 95 % or more it is held by {} alone.", sure.join(", "))
        };
        let odd = format!("{surely}{odd}");
        let named = |row: &&Row| {
            let least = (0..row.cells.len()).map(|task| self.verdict_of(row, task)?.probability);
            let least = least.reduce(|a, b| Some(a?.min(b?))).flatten();
            let sure = least.map(|probability| format!("P {}", percent(probability)));
            let sure = sure.map_or_else(String::new, |sure| format!(" ({sure})"));
            format!("{}{sure}", words::marked(&row.robot))
        };
        let named: Vec<String> = passing.iter().take(MOST_ADVISED).map(named).collect();
        let more = match passing.len().saturating_sub(named.len()) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let sure =
            if self.known_of_any() { "" } else { "; how likely is not known, as nothing is known of the drives" };
        format!("{tolerance} mm on every task, at the nominal stiffness: {}{more}{sure}.{odd}", named.join(", "))
    }
}

/// The name, and the payload where it is known.
fn with_payload(robot: &Robot) -> String {
    let payload = robot.payload_kg.map_or_else(String::new, |kg| format!(" (payload {kg} kg)"));
    format!("{}{payload}", robot.full_name())
}

/// Of a row that has a place for the task.
fn millimetres(row: &Row, task: usize, digits: usize) -> String {
    row.deflection(task).map_or_else(|| "-".to_owned(), |deflection| fixed(deflection * 1e3, digits))
}
