//! Verb 5: which architecture suits which link ratio and task size, and where does the better one change?

mod best;

use best::SymmetricPlace;

use crate::drive::Architecture;
use crate::interval::Interval;
use crate::parallel;
use crate::plane::PlanarArm;
use crate::robot::{NoArmPlane, Robot};
use crate::root::root;
use crate::task::{Task, Zone};
use crate::watch::{Parts, Stopped, Watch};

/// An architecture with its joint compliances, in units of a reference compliance `k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contender {
    /// Serial or quasi-serial.
    pub architecture: Architecture,
    /// Of drive 2, over `k`; 0 where it is rigid, which not both are.
    pub k2: f64,
    /// Of drive 3, over `k`; 0 where it is rigid.
    pub k3: f64,
}

impl Contender {
    /// Both springs equal, as in the paper.
    pub const fn equal(architecture: Architecture) -> Self {
        Self { architecture, k2: 1.0, k3: 1.0 }
    }

    /// The worst deflection at the best place over `k F (l2 + l3)^2` for `mu = l3/l2`; `None` where the zone does not fit.
    ///
    /// Zone in units of `l2 + l3`; no joint limits (\[paper\], Table I).
    ///
    /// # Errors
    /// Where the ratio, a compliance or a side of the zone is out of range.
    pub fn accuracy(&self, zone: Zone, mu: f64) -> Result<Option<f64>, StudyError> {
        self.check(zone, [mu; 2])?;
        Ok(self.accuracy_at(zone, mu))
    }

    /// The ratio in `ratios` with the best accuracy, and that accuracy; `None` where the zone fits with none of them.
    ///
    /// Proved: no ratio of the range has an accuracy that is better by more than 1e-9 of it.
    ///
    /// # Errors
    /// As [`Self::accuracy`].
    pub fn best_ratio(&self, zone: Zone, ratios: Interval) -> Result<Option<(f64, f64)>, StudyError> {
        self.check(zone, [ratios.min(), ratios.max()])?;
        Ok(self.best_among(zone, ratios))
    }

    fn accuracy_at(&self, zone: Zone, mu: f64) -> Option<f64> {
        SymmetricPlace::all(self, zone).filter_map(|place| place.accuracy(share(mu))).reduce(f64::min)
    }

    fn best_among(&self, zone: Zone, ratios: Interval) -> Option<(f64, f64)> {
        let shares = Interval::spanning(share(ratios.min()), share(ratios.max()));
        best::best(self, zone, shares).map(|(x, accuracy)| (ratios.clamp(x / (1.0 - x)), accuracy))
    }

    fn check(&self, zone: Zone, ratios: [f64; 2]) -> Result<(), StudyError> {
        within("a link ratio", LINK_RATIO, ratios)?;
        within("a side of a zone over l2 + l3", [1e-9, 1e6], zone.sides())?;
        for value in [self.k2, self.k3] {
            if value != 0.0 {
                within("a joint compliance other than 0, which is rigid,", [1e-3, 1e3], [value])?;
            }
        }
        if self.k2 == 0.0 && self.k3 == 0.0 { Err(StudyError::Rigid) } else { Ok(()) }
    }
}

/// `l3/(l2 + l3)` of a ratio `l3/l2`.
fn share(mu: f64) -> f64 {
    mu / (1.0 + mu)
}

/// The ratio of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    /// `l3/l2`.
    pub mu: f64,
    /// It is the best in the range studied.
    pub is_best: bool,
}

/// One accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Which of the tasks.
    pub task: usize,
    /// Its size over `l2 + l3`.
    pub size: f64,
    /// Which of the two contenders.
    pub contender: usize,
    /// `l3/l2`; absent where even the best is not one (nothing fits).
    pub ratio: Option<Ratio>,
    /// Over `k F (l2 + l3)^2`; absent where the zone does not fit.
    pub accuracy: Option<f64>,
}

/// A size at which the better of the two contenders changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// Which of the tasks.
    pub task: usize,
    /// `l3/l2` of both; `None`: each at its best ratio.
    pub mu: Option<f64>,
    /// The size over `l2 + l3`.
    pub size: f64,
    /// The contender that is better just below.
    pub below: usize,
}

/// A robot with its work, to be found among what is studied.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Its name.
    pub robot: String,
    /// Which of the tasks its work is, at another size.
    pub task: usize,
    /// Its link ratio, `l3/l2`.
    pub mu: f64,
    /// The size of its work over `l2 + l3`.
    pub size: f64,
}

impl Mark {
    /// A robot with a zone whose shape, its first side (or its diameter) being 1, is the first task that is studied.
    ///
    /// # Errors
    /// Where the limits of the robot contradict each other.
    pub fn of(robot: &Robot, zone: Zone) -> Result<Self, NoArmPlane> {
        let PlanarArm { l2, l3, .. } = robot.two_links()?.arm;
        let [side, _] = zone.sides();
        Ok(Self { robot: robot.name.clone(), task: 0, mu: l3 / l2, size: side / (l2 + l3) })
    }
}

/// What is studied.
#[derive(Clone, Debug)]
pub struct StudyOptions {
    /// The two that are compared.
    pub contenders: [Contender; 2],
    /// Shapes at size 1; sizes scale them.
    pub tasks: Vec<Task<Zone>>,
    /// Sizes over `l2 + l3`.
    pub sizes: Vec<f64>,
    /// Ratios `l3/l2` that are tabulated.
    pub ratios: Vec<f64>,
    /// Ratios among which the best is searched for.
    pub range: Interval,
    /// What is to be found among all this.
    pub mark: Option<Mark>,
}

impl StudyOptions {
    /// The paper's Table I.
    ///
    /// # Panics
    /// Never: its notation is fixed.
    pub fn paper() -> Self {
        let task = |letter: &str| Task {
            label: letter.into(),
            work: format!("{letter}:1").parse().expect("a zone of the paper"),
        };
        Self {
            contenders: Architecture::ALL.map(Contender::equal),
            tasks: ["A", "B", "C"].map(task).to_vec(),
            sizes: vec![0.1, 0.3, 0.5, 0.8],
            ratios: vec![0.8, 1.0, 1.2],
            range: Interval::spanning(0.5, 1.5),
            mark: None,
        }
    }

    /// The architecture of one of the two, with its compliances where they are not the reference.
    pub fn name(&self, contender: usize) -> String {
        let Contender { architecture, k2, k3 } = self.contenders[contender];
        if (k2, k3) == (1.0, 1.0) { architecture.to_string() } else { format!("{architecture} (k2 {k2}, k3 {k3})") }
    }
}

/// What a study found.
#[derive(Clone, Debug)]
pub struct Study {
    /// What was asked.
    pub options: StudyOptions,
    /// Per task, ratio (the best last), size and contender.
    pub rows: Vec<Row>,
    /// Per task and ratio, in order of size.
    pub boundaries: Vec<Boundary>,
    /// What each contender would have where the mark is; absent where the zone does not fit.
    pub marked: [Option<f64>; 2],
}

/// A study that makes no sense.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StudyError {
    /// A quantity outside what is meant.
    #[error("{quantity} is {value}; expected a number from {min} to {max}")]
    Quantity {
        /// Which.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Smallest accepted.
        min: f64,
        /// Largest accepted.
        max: f64,
    },
    /// Nothing gives way.
    #[error("k2 and k3 are both 0, so nothing gives way; give drive 2 or 3 a compliance from 0.001 to 1000")]
    Rigid,
    /// Too many rows.
    #[error("{0} rows; expected at most 1000000")]
    Size(usize),
    /// No longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Compares two architectures over link ratio and task size (\[paper\], Fig. 4-9 and Table I), without joint limits.
///
/// ```
/// use stiffarm::study::{StudyOptions, study};
///
/// let study = study(&StudyOptions::paper())?;
/// let best = study.boundaries.iter().find(|boundary| boundary.mu.is_none()).ok_or("the order changes")?;
/// assert!((best.size - 0.549).abs() < 1e-3); // of a circle over l2 + l3: below it a serial arm is stiffer
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Where a ratio, size or compliance is out of range.
pub fn study(options: &StudyOptions) -> Result<Study, StudyError> {
    study_watched(options, Watch::nobody())
}

/// [`study`] that somebody waits for. Its parts are the rows, and what is looked at in search of boundaries.
///
/// # Errors
/// As [`study`], and [`StudyError::Stopped`] where the work is no longer wanted.
pub fn study_watched(options: &StudyOptions, watch: Watch) -> Result<Study, StudyError> {
    check(options)?;
    let ratios: Vec<Option<f64>> = options.ratios.iter().copied().map(Some).chain([None]).collect();
    let mut keys = Vec::new();
    for task in 0..options.tasks.len() {
        for &mu in &ratios {
            for &size in &options.sizes {
                keys.extend([0, 1].map(|contender| (task, mu, size, contender)));
            }
        }
    }
    let pairs: Vec<(usize, Option<f64>)> =
        (0..options.tasks.len()).flat_map(|task| ratios.iter().map(move |&mu| (task, mu))).collect();
    let parts = watch.parts(Some(keys.len() + SCAN * pairs.len()));
    let row = |&(task, mu, size, contender): &(usize, Option<f64>, f64, usize)| {
        parts.one_more()?;
        let zone = options.tasks[task].work.scaled(size);
        let found = value(options, contender, zone, mu);
        let ratio = found.map(|(mu, _)| mu).or(mu).map(|chosen| Ratio { mu: chosen, is_best: mu.is_none() });
        Ok::<_, Stopped>(Row { task, size, contender, ratio, accuracy: found.map(|(_, accuracy)| accuracy) })
    };
    let rows = parallel::try_each(&keys, row)?;
    let boundaries: Vec<Vec<Boundary>> =
        parallel::try_each(&pairs, |(task, mu)| boundaries(options, *task, *mu, &parts))?;
    let at_mark = |contender| {
        let Mark { task, mu, size, .. } = options.mark.as_ref()?;
        value(options, contender, options.tasks[*task].work.scaled(*size), Some(*mu)).map(|(_, accuracy)| accuracy)
    };
    let boundaries = boundaries.into_iter().flatten().collect();
    Ok(Study { options: options.clone(), rows, boundaries, marked: [0, 1].map(at_mark) })
}

/// Sizes at which boundaries are looked for, up to the largest that fits.
const SCAN: usize = 50;

/// `(mu, accuracy)` at a ratio, or at the best one.
fn value(options: &StudyOptions, contender: usize, zone: Zone, mu: Option<f64>) -> Option<(f64, f64)> {
    let contender = &options.contenders[contender];
    match mu {
        Some(mu) => contender.accuracy_at(zone, mu).map(|accuracy| (mu, accuracy)),
        None => contender.best_among(zone, options.range),
    }
}

/// The sizes at which the order changes, by root finding between the steps of a scan, as long as both fit.
fn boundaries(options: &StudyOptions, task: usize, mu: Option<f64>, parts: &Parts) -> Result<Vec<Boundary>, Stopped> {
    // Nothing larger than the circle that the stretched arm sweeps has a place.
    let shape = options.tasks[task].work;
    let largest = shape.largest_size();
    let difference = |size: f64| {
        let accuracy = |contender| value(options, contender, shape.scaled(size), mu).map(|(_, accuracy)| accuracy);
        Some(accuracy(0)? - accuracy(1)?)
    };
    let size = |i: usize| largest * i as f64 / SCAN as f64;
    let seen = |i: usize| parts.one_more().map(|()| difference(size(i)));
    let scan: Vec<Option<f64>> = (1..=SCAN).map(seen).collect::<Result<_, _>>()?;
    let mut found = Vec::new();
    for (i, pair) in scan.windows(2).enumerate() {
        let (Some(before), Some(after)) = (pair[0], pair[1]) else {
            continue;
        };
        if before.signum() * after.signum() < 0.0 {
            let sign = -before.signum();
            let between = |size| sign * difference(size).expect("a zone fits where a larger one of its shape does");
            let size = root(size(i + 1), size(i + 2), between);
            found.push(Boundary { task, mu, size, below: usize::from(0.0 < before) });
        }
    }
    Ok(found)
}

fn check(options: &StudyOptions) -> Result<(), StudyError> {
    within("a link ratio", LINK_RATIO, options.ratios.iter().copied())?;
    let marked = options.mark.iter();
    within("the link ratio of the robot", LINK_RATIO, marked.clone().map(|mark| mark.mu))?;
    within("a size over l2 + l3", [1e-4, 10.0], options.sizes.iter().copied().chain(marked.map(|mark| mark.size)))?;
    for task in &options.tasks {
        within("a side of a shape", [1e-3, 1e3], task.work.sides())?;
        for contender in &options.contenders {
            contender.check(task.work, [options.range.min(), options.range.max()])?;
        }
    }
    let rows = [options.tasks.len(), options.sizes.len(), options.ratios.len() + 1, 2]
        .into_iter()
        .fold(1, usize::saturating_mul);
    if rows <= 1_000_000 { Ok(()) } else { Err(StudyError::Size(rows)) }
}

/// Smallest and largest `l3/l2`.
const LINK_RATIO: [f64; 2] = [0.05, 20.0];

fn within(
    quantity: &'static str,
    [min, max]: [f64; 2],
    values: impl IntoIterator<Item = f64>,
) -> Result<(), StudyError> {
    match values.into_iter().find(|value| !(min <= *value && *value <= max)) {
        Some(value) => Err(StudyError::Quantity { quantity, value, min, max }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_boundary_of_task_a_is_where_the_paper_puts_it() {
        let study = study(&StudyOptions::paper()).unwrap();
        let best: Vec<&Boundary> = study.boundaries.iter().filter(|b| b.task == 0 && b.mu.is_none()).collect();
        assert_eq!(best.len(), 1);
        assert!((best[0].size - 0.549).abs() < 0.0005, "{best:?}");
        assert_eq!(best[0].below, 0);
    }

    /// Over its links by hand: 1.15 m, and 1.2 m with an offset of 41 mm.
    #[test]
    fn a_robot_stands_where_its_links_and_its_task_put_it() {
        let robot = crate::catalogue::find("KR 210 R2700 extra").unwrap().robot();
        let zone = Zone::Rectangle { width: 0.6, height: 0.4 };
        let mark = Mark::of(&robot, zone).unwrap();
        let (l2, l3) = (1.15_f64, 1.2_f64.hypot(0.041));
        assert!((mark.mu - l3 / l2).abs() < 1e-12 && (mark.size - 0.6 / (l2 + l3)).abs() < 1e-12, "{mark:?}");
        let tasks = vec![Task { label: "x".into(), work: Zone::Rectangle { width: 1.0, height: 0.4 / 0.6 } }];
        let found = study(&StudyOptions { tasks, mark: Some(mark), ..StudyOptions::paper() }).unwrap();
        for (contender, marked) in found.options.contenders.iter().zip(found.marked) {
            let expected = contender.accuracy(zone.scaled(1.0 / (l2 + l3)), l3 / l2).unwrap().unwrap();
            assert!((marked.unwrap() / expected - 1.0).abs() < 1e-9, "{marked:?} {expected}");
        }
        assert_eq!(study(&StudyOptions::paper()).unwrap().marked, [None; 2]);
    }

    #[test]
    fn at_a_boundary_both_are_equal() {
        let study = study(&StudyOptions::paper()).unwrap();
        for Boundary { task, mu, size, .. } in &study.boundaries {
            let zone = study.options.tasks[*task].work.scaled(*size);
            let [a, b] = [0, 1].map(|contender| value(&study.options, contender, zone, *mu).unwrap().1);
            assert!((a - b).abs() <= 1e-9 * a, "{a} {b}");
        }
    }

    #[test]
    fn a_quasi_serial_circle_stands_where_the_hand_calculation_puts_it() {
        // sigma depends on |t - l2^2 - l3^2| alone, so both ends are equal at R^2 = l2^2 + l3^2 - d^2/4.
        let (mu, d) = (0.8_f64, 0.3_f64);
        let (l2, l3) = (1.0 / (1.0 + mu), mu / (1.0 + mu));
        let centre = (l2 * l2 + l3 * l3 - d * d / 4.0).sqrt();
        let c = ((centre + d / 2.0).powi(2) - l2 * l2 - l3 * l3) / (2.0 * l2 * l3);
        let (trace, determinant) = (l2 * l2 + l3 * l3, (l2 * l3).powi(2) * (1.0 - c * c));
        let expected = f64::midpoint(trace, (trace * trace - 4.0 * determinant).sqrt());
        let found = Contender::equal(Architecture::QuasiSerial).accuracy(Zone::Circle { diameter: d }, mu);
        let found = found.unwrap().unwrap();
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}
