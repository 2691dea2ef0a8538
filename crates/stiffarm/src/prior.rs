//! How stiff are the drives of a robot that nobody has measured, and how far may that be wrong?
//!
//! ```text
//! ln K_i = ln K0_i + b_i ln(X / X0) + g_i + u + e_i        X = payload g reach
//! ```
//!
//! `g` is the error that all robots share (it cancels where robots are compared), `u` that of a robot, `e` that of a drive. Numbers and
//! sources: `stiffness/` beside the sources of this library.

use std::sync::LazyLock;

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::drive::{Drives, Identified, JointCompliance, Knowledge, Scatter};
use crate::mass::GRAVITY;
use crate::robot::{Arm, COMPLIANCE_SOURCE, Robot};

/// Of an identification that is published: one careful static set, and modal tests; sd of ln K.
const STATIC: f64 = 0.3;
const MODAL: f64 = 0.5;
/// Sets that differ by more than this factor disagree.
const DISAGREE: f64 = 1.5;

/// A row of `prior.csv`.
#[derive(Clone, Copy, Debug, Default)]
struct Axis {
    /// N m/rad at `x_0`.
    stiffness: f64,
    /// N m.
    x_0: f64,
    exponent: f64,
    global: f64,
    common: f64,
    own: f64,
}

/// A row of `published.csv`.
#[derive(Clone, Debug)]
struct Published {
    robot: String,
    /// kg and m.
    size: [f64; 2],
    /// N m/rad.
    stiffness: [Option<f64>; 6],
    is_modal: bool,
    source: String,
}

static PRIOR: LazyLock<[Axis; 6]> = LazyLock::new(|| {
    let rows = table(include_str!("../stiffness/prior.csv"));
    std::array::from_fn(|i| {
        let number = |column: usize| rows[i][column].parse().expect("compiled in, and a test reads it");
        Axis {
            stiffness: number(1),
            x_0: number(2),
            exponent: number(3),
            global: number(4),
            common: number(5),
            own: number(6),
        }
    })
});

static PUBLISHED: LazyLock<Vec<Published>> = LazyLock::new(|| {
    let number = |cell: &String| cell.parse().expect("compiled in, and a test reads it");
    let row = |row: Vec<String>| Published {
        robot: row[0].clone(),
        size: [number(&row[1]), number(&row[2])],
        stiffness: std::array::from_fn(|i| (!row[i + 4].is_empty()).then(|| number(&row[i + 4]))),
        is_modal: row[10] == "modal",
        source: row[11].clone(),
    };
    table(include_str!("../stiffness/published.csv")).into_iter().map(row).collect()
});

impl Published {
    /// Of a robot of this name that is as large, kg and m: a name alone may be anybody's.
    fn is_of(&self, name: &str, size: [f64; 2]) -> bool {
        /// The reach of a robot file that states none is that of its links.
        const ALIKE: f64 = 0.1;
        self.robot == name && self.size.iter().zip(size).all(|(own, of)| (of / own - 1.0).abs() <= ALIKE)
    }
}

fn table(text: &str) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows = reader.records().map(|row| row.expect("compiled in, and a test reads it"));
    rows.map(|row| row.iter().map(str::to_owned).collect()).collect()
}

/// Of which robots nothing can be said.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoPrior {
    /// Its size is not known.
    #[error(
        "{0}: payload_kg is needed for a prior, which goes by size; give it in the robot file, or the stiffness itself"
    )]
    Size(String),
    /// It has two links.
    #[error("{0} is a planar robot; the prior is of six drives")]
    Planar(String),
}

/// The robot with what is published of its drives, else with what drives of robots of its size have, and how far that may be off.
///
/// # Errors
/// Where its size is not known.
pub fn with_prior(robot: &Robot) -> Result<Robot, NoPrior> {
    let (payload, reach) = size(robot)?;
    let (median, scatter) = known(&robot.name, payload, reach);
    let mut changed = robot.clone();
    let source = match &scatter.knowledge {
        Knowledge::Prior => "prior: drives of robots of this payload and reach".to_owned(),
        Knowledge::Published { sources, .. } => format!("published: {}", sources.join("; ")),
    };
    changed.source.insert(COMPLIANCE_SOURCE.into(), source);
    changed.stiffness_is_assumed = false;
    if let Arm::SixAxis { drives, .. } = &mut changed.arm {
        *drives =
            Drives { compliance: JointCompliance(median), identified: None, scatter: Some(scatter), ..drives.clone() };
    }
    Ok(changed)
}

/// What drives of robots of this size have, whatever is published of this one: median compliances, rad/(N m), and their scatter.
///
/// Measurements update this; publications may rest on the same measurements, which would then count twice.
///
/// # Errors
/// Where its size is not known.
pub fn by_size(robot: &Robot) -> Result<([f64; 6], Scatter), NoPrior> {
    let (payload, reach) = size(robot)?;
    Ok(of_size(payload, reach))
}

/// How many times as compliant as those of robots of this payload and reach the drives are, in the geometric mean over those that give way; `None`
/// where the size is not known, or every drive is rigid.
pub fn against_size(robot: &Robot) -> Option<f64> {
    let (payload, reach) = size(robot).ok()?;
    let (usual, _) = of_size(payload, reach);
    let ratios = robot.drive_compliance().into_iter().flatten().zip(usual).map(|(own, usual)| own / usual);
    let logarithms: Vec<f64> = ratios.filter(|ratio| *ratio != 0.0).map(f64::ln).collect();
    (!logarithms.is_empty()).then(|| (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp())
}

/// Payload, kg, and reach, m.
fn size(robot: &Robot) -> Result<(f64, f64), NoPrior> {
    if matches!(robot.arm, Arm::Planar(_)) {
        return Err(NoPrior::Planar(robot.name.clone()));
    }
    let payload = robot.payload_kg.ok_or_else(|| NoPrior::Size(robot.name.clone()))?;
    // Makers state the reach of the wrist centre, which is about the stretch of both links.
    Ok((payload, robot.reach.unwrap_or_else(|| robot.stretch())))
}

fn of_size(payload_kg: f64, reach: f64) -> ([f64; 6], Scatter) {
    let size = payload_kg * GRAVITY * reach;
    let axes = *PRIOR;
    let median = axes.map(|axis| 1.0 / (axis.stiffness * (size / axis.x_0).powf(axis.exponent)));
    let scatter = Scatter {
        global: axes.map(|axis| axis.global),
        common: axes.map(|axis| axis.common),
        own: axes.map(|axis| axis.own),
        knowledge: Knowledge::Prior,
    };
    (median, scatter)
}

/// Median compliances, rad/(N m), and their scatter.
fn known(name: &str, payload_kg: f64, reach: f64) -> ([f64; 6], Scatter) {
    let (mut median, mut scatter) = of_size(payload_kg, reach);
    let sets: Vec<&Published> = PUBLISHED.iter().filter(|set| set.is_of(name, [payload_kg, reach])).collect();
    if sets.is_empty() {
        return (median, scatter);
    }
    let mut disagreement: Option<(usize, f64)> = None;
    for (drive, median) in median.iter_mut().enumerate() {
        let of_drive = sets.iter().filter_map(|set| Some((set.stiffness[drive]?.ln(), set.is_modal)));
        let values: Vec<(f64, bool)> = of_drive.collect();
        if values.is_empty() {
            continue;
        }
        let count = values.len() as f64;
        let mean = values.iter().map(|(value, _)| value).sum::<f64>() / count;
        let spread =
            (values.iter().map(|(value, _)| (value - mean).powi(2)).sum::<f64>() / (count - 1.0).max(1.0)).sqrt();
        let least = if values.iter().any(|(_, is_modal)| *is_modal) { MODAL } else { STATIC };
        *median = (-mean).exp();
        (scatter.global[drive], scatter.common[drive], scatter.own[drive]) = (0.0, 0.0, spread.max(least));
        let ends = |pick: fn(f64, f64) -> f64, start: f64| values.iter().map(|(value, _)| *value).fold(start, pick);
        let ratio = (ends(f64::max, f64::NEG_INFINITY) - ends(f64::min, f64::INFINITY)).exp();
        if DISAGREE < ratio && disagreement.is_none_or(|(_, most)| most < ratio) {
            disagreement = Some((drive, ratio));
        }
    }
    let sources = sets.iter().map(|set| set.source.clone()).collect();
    let drives = std::array::from_fn(|drive| sets.iter().any(|set| set.stiffness[drive].is_some()));
    scatter.knowledge = Knowledge::Published { drives, sources, disagreement };
    (median, scatter)
}

/// Factors on the compliances of a robot's drives, draw by draw; `None` where nothing says how far they may be wrong.
///
/// Deterministic: the errors that all robots share are the same in the same draw of any robot, its own go by its name.
pub fn factors(robot: &Robot, draws: usize) -> Option<Vec<[f64; 6]>> {
    let Arm::SixAxis { drives, .. } = &robot.arm else { return None };
    let mut shared = fastrand::Rng::with_seed(SHARED_SEED);
    let mut own = fastrand::Rng::with_seed(seed(&robot.full_name()));
    if let Some(identified) = &drives.identified {
        // Of a posterior the covariance tells of drives that the measurements did not show, too.
        let known: [bool; 6] = std::array::from_fn(|i| identified.drives[i] || 0.0 < identified.covariance[(i, i)]);
        let scatter = match with_prior(robot) {
            _ if known.iter().all(|known| *known) => None,
            Ok(prior) => Some(prior.scatter()?.clone()),
            // Nothing says how far those may be off that were not identified.
            Err(NoPrior::Size(_) | NoPrior::Planar(_)) => return None,
        };
        let k = drives.compliance.0;
        // Relative: of ln k.
        let relative =
            Matrix6::from_fn(
                |i, j| if 0.0 < k[i] * k[j] { identified.covariance[(i, j)] / (k[i] * k[j]) } else { 0.0 },
            );
        // A root that is there where the matrix is singular, too.
        let eigen = relative.symmetric_eigen();
        let root = eigen.eigenvectors * Matrix6::from_diagonal(&eigen.eigenvalues.map(|value| value.max(0.0).sqrt()));
        return Some(
            (0..draws)
                .map(|_| {
                    let seen = root * Vector6::from_fn(|_, _| normal(&mut own));
                    let others = scatter.as_ref().map_or([0.0; 6], |scatter| scatter.draw(&mut shared, &mut own));
                    std::array::from_fn(|i| if known[i] { seen[i] } else { others[i] }.exp())
                })
                .collect(),
        );
    }
    let scatter = drives.scatter.as_ref()?;
    Some((0..draws).map(|_| scatter.draw(&mut shared, &mut own).map(f64::exp)).collect())
}

/// How a robot may differ from what is stated of it, draw by draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Factors on the compliances of its drives.
    pub factors: Vec<[f64; 6]>,
    /// What its identification did not explain; `None` of a robot that was not measured.
    pub unexplained: Option<Unexplained>,
}

/// What an identification did not explain, draw by draw: a part of every displacement that no compliance of the drives gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Unexplained {
    identified: Identified,
    /// Of variance 1 in each of three directions that nothing distinguishes.
    errors: Vec<Vector3<f64>>,
}

impl Drawn {
    /// As far as it is known of a robot; `None` where nothing says how far its drives may be wrong.
    pub fn of(robot: &Robot, draws: usize) -> Option<Self> {
        Some(Self { factors: factors(robot, draws)?, unexplained: Unexplained::of(robot, draws) })
    }

    /// The logarithms of the compliances off by so much, as [`factors_of`] has it.
    pub fn within(robot: &Robot, deviation: f64, draws: usize) -> Self {
        Self { factors: factors_of(deviation, draws), unexplained: Unexplained::of(robot, draws) }
    }
}

impl Unexplained {
    /// Of a robot; `None` where it was not measured. Deterministic, by its name.
    pub fn of(robot: &Robot, draws: usize) -> Option<Self> {
        Self::at(robot, draws, &[])
    }

    /// Of a robot in a posture, rad: in another one it misses something else. Deterministic, by its name and the posture.
    pub(crate) fn at(robot: &Robot, draws: usize, posture: &[f64]) -> Option<Self> {
        /// rad: what rounding changes is the same posture.
        const SAME: f64 = 1e-6;
        let identified = robot.identified()?.clone();
        let mixed = |seed: u64, angle: &f64| {
            (seed ^ ((angle / SAME).round() as i64).cast_unsigned()).wrapping_mul(0x0100_0000_01b3)
        };
        let seed = posture.iter().fold(seed(&robot.full_name()) ^ UNEXPLAINED_SEED, mixed);
        let mut own = fastrand::Rng::with_seed(seed);
        let errors = (0..draws).map(|_| Vector3::from_fn(|_, _| normal(&mut own))).collect();
        Some(Self { identified, errors })
    }

    /// What a draw adds to a displacement of this length, m, in space.
    pub fn in_space(&self, draw: usize, length: f64) -> Vector3<f64> {
        self.errors[draw] * self.identified.unexplained(length, 3)
    }

    /// What counts of a displacement, m, of which a draw of the drives tells `drawn`.
    pub(crate) fn added(&self, draw: usize, drawn: f64, moved: &Moved) -> f64 {
        let error = self.errors[draw] * self.identified.unexplained(moved.length, moved.coordinates);
        let across: f64 = error.iter().skip(1).take(moved.counted - 1).map(|part| part * part).sum();
        (drawn + error.x).hypot(across.sqrt())
    }
}

/// A displacement, of which all or a part counts: what an identification did not explain may point any way, whatever counts.
pub(crate) struct Moved {
    /// All of it, m.
    pub length: f64,
    /// How many coordinates it has: three in space, two in the arm plane.
    pub coordinates: usize,
    /// How many of them count: one of a part along a direction, else all.
    pub counted: usize,
}

/// Of what an identification did not explain: other draws than those of the drives.
const UNEXPLAINED_SEED: u64 = 0x6e6f_7468_696e_6721;

/// Of the errors that all robots share.
const SHARED_SEED: u64 = 0x5717_ffa1;

impl Scatter {
    /// ln k over its median.
    fn draw(&self, shared: &mut fastrand::Rng, own: &mut fastrand::Rng) -> [f64; 6] {
        let all: [f64; 6] = std::array::from_fn(|_| normal(shared));
        let common = normal(own);
        let each: [f64; 6] = std::array::from_fn(|_| normal(own));
        std::array::from_fn(|i| self.global[i] * all[i] + self.common[i] * common + self.own[i] * each[i])
    }

    /// Of ln k of the drives of one robot.
    pub(crate) fn covariance(&self) -> Matrix6<f64> {
        Matrix6::from_fn(|i, j| {
            let own = if i == j { self.global[i].powi(2) + self.own[i].powi(2) } else { 0.0 };
            own + self.common[i] * self.common[j]
        })
    }

    /// Standard deviation of ln k of each drive.
    pub fn total(&self) -> [f64; 6] {
        std::array::from_fn(|i| (self.global[i].powi(2) + self.common[i].powi(2) + self.own[i].powi(2)).sqrt())
    }
}

/// By how much the compliances of two drives may be off together, in parts of them: means of `(f_i - 1) (f_j - 1)` over the factors f. Of drives that
/// were identified by their covariance; of others by what scatters, and where nothing is known of that as drives of any robot do.
pub(crate) fn covariance(robot: &Robot) -> Matrix6<f64> {
    let (_, of_any) = of_size(1.0, 1.0);
    let ln = robot.scatter().unwrap_or(&of_any).covariance();
    // Of log-normal factors about their median.
    let mut covariance = Matrix6::from_fn(|i, j| {
        let [a, b] = [ln[(i, i)] / 2.0, ln[(j, j)] / 2.0];
        (a + b + ln[(i, j)]).exp() - a.exp() - b.exp() + 1.0
    });
    if let Some(identified) = robot.identified() {
        let k = robot.drive_compliance().map(|k| k.unwrap_or(0.0));
        let is_known = |i: usize| identified.drives[i] || 0.0 < identified.covariance[(i, i)];
        for i in 0..6 {
            for j in 0..6 {
                covariance[(i, j)] = match (is_known(i), is_known(j)) {
                    (true, true) if 0.0 < k[i] * k[j] => identified.covariance[(i, j)] / (k[i] * k[j]),
                    (false, false) => covariance[(i, j)],
                    _ => 0.0,
                };
            }
        }
    }
    covariance
}

/// Factors on compliances of which is only said that their logarithms are off by so much, as a standard deviation, each drive on its own.
pub fn factors_of(deviation: f64, draws: usize) -> Vec<[f64; 6]> {
    let mut rng = fastrand::Rng::with_seed(SHARED_SEED);
    (0..draws).map(|_| std::array::from_fn(|_| (deviation * normal(&mut rng)).exp())).collect()
}

/// By Fowler, Noll and Vo: the same on every machine.
fn seed(name: &str) -> u64 {
    name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Normal, of variance 1 (Box and Muller).
pub(crate) fn normal(rng: &mut fastrand::Rng) -> f64 {
    (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (std::f64::consts::TAU * rng.f64()).cos()
}

/// The robot with the paper's 1 urad/(N m) on every drive.
pub fn as_in_the_paper(robot: &Robot) -> Robot {
    let mut changed = robot.clone();
    changed.stiffness_is_assumed = true;
    changed.source.remove(COMPLIANCE_SOURCE);
    match &mut changed.arm {
        Arm::SixAxis { drives, .. } => {
            *drives = Drives { compliance: JointCompliance::PAPER, identified: None, scatter: None, ..drives.clone() };
        }
        Arm::Planar(arm) => (arm.k2, arm.k3) = (JointCompliance::PAPER.0[1], JointCompliance::PAPER.0[2]),
    }
    changed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::find;

    fn robot(name: &str) -> Robot {
        find(name).unwrap_or_else(|| panic!("{name} is in the catalogue")).robot()
    }

    #[test]
    fn a_robot_of_the_reference_size_has_the_numbers_of_the_table() {
        let (median, scatter) = known("nobody's", 5000.0 / GRAVITY / 2.5, 2.5);
        for (k, stiffness) in median.iter().zip([2.2e6, 3.4e6, 2.0e6, 3.7e5, 3.1e5, 3.8e5]) {
            assert!((k * stiffness - 1.0).abs() < 1e-12);
        }
        for (sd, table) in scatter.total().iter().zip([0.66, 0.66, 0.66, 0.80, 0.80, 0.88]) {
            assert!((sd - table).abs() < 0.01, "{sd}");
        }
        // By hand: half the size has 2^-0.8 = 0.574 of the stiffness.
        let (half, _) = known("nobody's", 2500.0 / GRAVITY / 2.5, 2.5);
        assert!((median[0] / half[0] - 0.5743).abs() < 1e-4);
    }

    #[test]
    fn the_page_of_the_theory_has_the_numbers_of_the_table() {
        let theory = include_str!("../../../docs/theory.md");
        let row = |heading: &str| -> Vec<f64> {
            let line = theory.lines().find(|line| line.starts_with(&format!("| {heading} |")));
            let cells = line.unwrap_or_else(|| panic!("{heading}")).trim_matches('|').split('|').skip(1);
            cells.map(|cell| cell.trim().parse().unwrap()).collect()
        };
        let of = |number: fn(&Axis) -> f64| PRIOR.iter().map(number).collect::<Vec<f64>>();
        assert_eq!(row("`K0`, MN m/rad"), of(|axis| (axis.stiffness / 1e4).round() / 100.0));
        assert_eq!(row("`b`"), of(|axis| axis.exponent));
        assert_eq!(row("standard deviation of `g`"), of(|axis| axis.global));
        assert_eq!(row("of `u`"), of(|axis| axis.common));
        assert_eq!(row("of `e`"), of(|axis| axis.own));
        let all = |axis: &Axis| (100.0 * axis.global.hypot(axis.common).hypot(axis.own)).round() / 100.0;
        assert_eq!(row("of all"), of(all));
    }

    #[test]
    fn every_published_set_is_of_a_robot_of_the_catalogue_and_disagreement_is_reported() {
        for set in PUBLISHED.iter() {
            let robot = robot(&set.robot);
            assert_eq!((robot.name.as_str(), super::size(&robot).unwrap()), (&*set.robot, set.size.into()));
            assert!(set.stiffness.iter().flatten().all(|k| (1e4..1e8).contains(k)), "{set:?}");
        }
        let found = with_prior(&robot("KR 500-2")).unwrap();
        let Arm::SixAxis { drives, .. } = &found.arm else { unreachable!("six axes") };
        let scatter = drives.scatter.as_ref().unwrap();
        let Knowledge::Published { disagreement: Some((drive, ratio)), .. } = scatter.knowledge else {
            panic!("{scatter:?}")
        };
        // By hand: 15.8 over 6.5; geometric mean 10.13 MN m/rad; sd ln(2.43) / sqrt 2 = 0.63.
        assert!(drive == 0 && (ratio - 2.431).abs() < 1e-3);
        // Drives that no publication shows are those of the prior, and are named.
        let shown = robot("KR 210 R2700 extra");
        let [published, by_size] =
            [with_prior(&shown).unwrap().drive_compliance(), by_size(&shown).unwrap().0.map(Some)];
        let kr210 = with_prior(&shown).unwrap();
        let Some(Knowledge::Published { drives: which, .. }) = kr210.scatter().map(|of| &of.knowledge) else {
            panic!("{kr210:?}")
        };
        assert_eq!(*which, [true, true, true, false, false, true]);
        assert_eq!(std::array::from_fn(|i| published[i] != by_size[i]), *which);
        // Another robot of that name is not that robot.
        let small = Robot { payload_kg: Some(20.0), ..shown };
        let found = with_prior(&small).unwrap();
        assert_eq!(found.scatter().unwrap().knowledge, Knowledge::Prior);
        assert!((drives.compliance.0[0] * 10.134e6 - 1.0).abs() < 1e-3 && (scatter.own[0] - 0.628).abs() < 1e-3);
    }

    /// Of 4000 draws the sd of a mean is 0.016 of that of a draw, that of an sd 0.011 of it.
    #[test]
    fn draws_have_the_scatter_they_are_drawn_from_and_what_is_shared_is_shared() {
        let robots = ["KR 210 R2700-2", "IRB 6700-235/2.65"].map(|name| with_prior(&robot(name)).unwrap());
        let drawn = robots.each_ref().map(|robot| factors(robot, 4000).unwrap());
        assert_eq!(drawn[0], factors(&robots[0], 4000).unwrap());
        let ln = |robot: usize, drive: usize| drawn[robot].iter().map(move |factors| factors[drive].ln());
        for (drive, sd) in [(0, 0.66), (5, 0.88)] {
            let mean = ln(0, drive).sum::<f64>() / 4000.0;
            let found = (ln(0, drive).map(|x| (x - mean).powi(2)).sum::<f64>() / 4000.0).sqrt();
            assert!(mean.abs() < 0.08 * sd && (found / sd - 1.0).abs() < 0.06, "{drive}: {mean} +- {found}");
        }
        // Of two robots drive 1 shares 0.25^2 of 0.66^2.
        let together = ln(0, 0).zip(ln(1, 0)).map(|(a, b)| a * b).sum::<f64>() / 4000.0;
        assert!((together - 0.0625).abs() < 0.03, "{together}");
    }
}
