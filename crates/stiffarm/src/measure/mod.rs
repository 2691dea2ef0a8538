//! Verb: in which postures, and under which loads, should a robot be measured? And in which to calibrate it ([`geometry_plan`])?
//!
//! A run `i` (a posture and a load) tells `M_i = Phi_i^T Phi_i / sigma^2` of the compliances, many runs their sum. A design is as good as
//! it lets the deflection over the work be predicted: `phi(M) = tr(W M^-1)`, the mean variance of what a unit force moves there, with `W` the mean of
//! `A^T A` over the work and three forces (the test poses of Klimchik and others, averaged).
//!
//! Two others: the mean variance of the drives in parts of their compliance (A), and the volume of the ellipsoid of those errors (D).
//!
//! Shares of many candidates first, `w_i <- w_i sqrt(d_i / phi)` with `d_i = tr(M^-1 W M^-1 M_i)`. As `phi` is convex and of degree -1, every
//! design `M*` of the candidates has `phi(M*) >= phi^2 / max d`: what is reached is certified. Then whole runs, by exchange, compared with
//! the same bound.
//!
//! Two more things decide what a plan is worth. What the model misses in a posture it misses however often it is run: `sigma` is that of a reading
//! and of a posture together, and runs of one posture share the latter (`Repeats`). And a drive that no load shows is as unknown after the runs as it was
//! before: it adds `tr(W_uu S_uu)` to the variance of the prediction, with `S` the prior of the compliances.

mod candidates;
mod design;
mod geometry;
mod route;
mod sight;
mod zone;

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::catalogue::measurements::Measurements;
use crate::clearance::{Surroundings, ThickArm};
use crate::compliance::{PostureError, check_tool};
use crate::drive::JointCompliance;
use crate::identify::columns_at;
use crate::interval::Interval;
use crate::prior::covariance;
use crate::robot::{Arm, Robot};
use crate::spatial::{Pose, Wrench};
use crate::watch::{Parts, Stopped, Watch};

use candidates::Candidates;
use design::{Aim, Chosen, Repeats, Shares};
pub use geometry::{GeometryPlan, geometry_plan};
pub use sight::{Cone, Instrument};
pub use zone::over;

/// A direction in which the user can load.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadWay {
    /// As people call it.
    pub name: String,
    /// Along base axes, length one.
    pub along: Vector3<f64>,
}

/// By what a plan is judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Criterion {
    /// How well the deflection over the work is predicted.
    #[default]
    Prediction,
    /// The mean variance of the compliances, each in parts of its own.
    A,
    /// The volume of the ellipsoid of their errors, as the variance of a drive that had its mean radius.
    D,
}

impl Criterion {
    /// As it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Prediction => "prediction",
            Self::A => "a",
            Self::D => "d",
        }
    }
}

/// What is asked of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// By what it is judged.
    pub criterion: Criterion,
    /// In which directions the user can load.
    pub ways: Vec<LoadWay>,
    /// By how much, N.
    pub newtons: f64,
    /// Where, in the flange frame, m.
    pub load_at: Vector3<f64>,
    /// What is looked at, in the flange frame, m.
    pub markers: Vec<Vector3<f64>>,
    /// Noise of a coordinate, m.
    pub sigma: f64,
    /// What the model misses of a coordinate in a posture, alike for all markers and the same in every run of it, m.
    pub posture_sigma: f64,
    /// How many runs.
    pub runs: usize,
    /// How often a posture is run at most.
    pub repeats: usize,
    /// Among how many candidates.
    pub candidates: usize,
    /// Where the markers must be seen, from the base, m.
    pub window: Option<[Interval; 3]>,
    /// From where they are looked at; `None` from everywhere.
    pub instrument: Option<Instrument>,
    /// Postures of the work, as reported, rad; where there are none, anywhere within the limits.
    pub work: Vec<[f64; 6]>,
    /// The tool point of the work, in the flange frame, m.
    pub tool: Vector3<f64>,
}

/// One run of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// As the robot reports them, rad.
    pub q: [f64; 6],
    /// Which of the ways to load.
    pub way: usize,
    /// On the load point, base axes.
    pub load: Wrench,
    /// How far each marker is expected to move, m, by the compliances that the robot has now.
    pub expected: Vec<Vector3<f64>>,
}

/// A plan with what it is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// In the order in which they are run.
    pub runs: Vec<Run>,
    /// By the criterion: mean variance of the displacement under a unit force over the work, (m/N)^2, or that of the drives, in parts of their
    /// compliances.
    pub value: f64,
    /// No plan of so many of the candidates has less.
    pub lower_bound: f64,
    /// The same of the best shares, at least: their bound over their value.
    pub shares_efficiency: f64,
    /// The median of random choices of so many of the candidates.
    pub random: f64,
    /// Drives that no candidate shows.
    pub unseen: Vec<Unseen>,
    /// What these add to the value: of a prediction what the prior leaves open of them, else nothing.
    pub unseen_value: f64,
    /// Standard error that is expected of each compliance, rad/(N m); `None` of those that are not shown.
    pub errors: [Option<f64>; 6],
    /// How many candidates there were.
    pub candidates: usize,
    /// How many postures the work had.
    pub work: usize,
}

/// A drive that no candidate shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Unseen {
    /// From 0.
    pub drive: usize,
    /// What part of the variance of the prediction over the work its prior gives, together with those of the other unseen drives; zero where none is
    /// predicted.
    pub share: f64,
    /// In which direction to load so that it shows, as it is asked for; `None` where no direction does.
    pub shown_by: Option<&'static str>,
}

impl Plan {
    /// The drives that no load shows decide how well the work is predicted.
    pub fn is_decided_by_unseen(&self) -> bool {
        0.5 * self.value < self.unseen_value
    }

    /// How near it is to the best, at least: 1 is the best.
    pub fn efficiency(&self) -> f64 {
        self.lower_bound / self.value
    }
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeasureError {
    /// A robot without six joints, or a tool that no arm carries.
    #[error(transparent)]
    Posture(#[from] PostureError),
    /// No posture is left.
    #[error(
        "none of {looked_at} postures that were looked at has the arm clear of itself and all markers above the floor, in the window and in sight of the instrument: look at more candidates, widen the window, move the instrument, or look at other points"
    )]
    NoCandidate {
        /// How many, spread evenly within the limits.
        looked_at: usize,
    },
    /// The work has no place.
    #[error("{0}")]
    NoPlace(String),
    /// Nothing is shown.
    #[error("none of the loads turns a drive in any posture so that a marker moves")]
    NothingSeen,
    /// Too few runs.
    #[error("{runs} runs; to tell {drives} drives apart takes at least {least}")]
    TooFew {
        /// How many were asked for.
        runs: usize,
        /// How many drives are to be distinguished.
        drives: usize,
        /// The fewest.
        least: usize,
    },
    /// Too few postures to calibrate an arm.
    #[error("{rows} postures calibrate no arm; expected at least {least}, and better forty")]
    TooFewRows {
        /// How many were asked for.
        rows: usize,
        /// The fewest.
        least: usize,
    },
    /// Too few postures for runs that repeat none too often.
    #[error(
        "{runs} runs, each posture at most {repeats} times, need {} postures; {postures} were found where they can be measured: look at more candidates, widen the window, or repeat more often",
        runs.div_ceil(*repeats)
    )]
    TooFewPostures {
        /// How many were asked for.
        runs: usize,
        /// How often each may be run.
        repeats: usize,
        /// How many there are.
        postures: usize,
    },
    /// A run that is compared is no posture of the robot.
    #[error("the runs that are compared do not show every drive that the candidates show: drive {0} is missing")]
    Blind(usize),
    /// Runs that are compared show more than the candidates do.
    #[error(
        "the runs that are compared show drive {drive}, which the loads of the plan do not: give loads that do{}, so that both are judged by the same drives",
        by.map_or_else(String::new, |by| format!(" ({by})"))
    )]
    Beyond {
        /// Which, from 1.
        drive: usize,
        /// In which direction to load so that the candidates show it, too.
        by: Option<&'static str>,
    },
    /// The work is no longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Plans measurements.
///
/// # Errors
/// Where no posture can be measured, or the loads show nothing, and [`MeasureError::Stopped`] where the work is no longer wanted.
pub fn plan(robot: &Robot, options: &Options, watch: Watch) -> Result<Plan, MeasureError> {
    let parts = watch.parts(None);
    let found = Search::of(robot, options, &parts)?;
    let shares = found.shares(&parts)?;
    let chosen = found.exact(&shares, options.runs, &parts)?;
    found.plan(&shares, &chosen, &parts)
}

/// A posture, as reported, rad, and the load on the load point, base axes.
pub type OwnRun = ([f64; 6], Wrench);

/// The runs of a table of one's own: each posture and load once, whatever number of markers.
pub fn own(planned: &Measurements) -> Vec<OwnRun> {
    let mut runs: Vec<(OwnRun, Vector3<f64>)> = Vec::new();
    for reading in &planned.readings {
        let run = (reading.q, reading.load);
        // The same again with the same marker is another run.
        if !runs.iter().any(|(known, marker)| *known == run && *marker != reading.marker_at) {
            runs.push((run, reading.marker_at));
        }
    }
    runs.into_iter().map(|(run, _)| run).collect()
}

/// What a plan of one's own is worth among the same candidates: its value and efficiency.
///
/// # Errors
/// As [`plan`], and where it shows other drives than the candidates do.
pub fn compare(robot: &Robot, options: &Options, runs: &[OwnRun], watch: Watch) -> Result<(f64, f64), MeasureError> {
    /// Of what the drive that is shown best is told: less is a load that stands a little askew.
    const SHOWN: f64 = 1e-6;
    let parts = watch.parts(None);
    let found = Search::of(robot, options, &parts)?;
    let shares = found.shares(&parts)?;
    let mut postures: Vec<([f64; 6], Matrix6<f64>, usize)> = Vec::new();
    for (q, load) in runs {
        let of_run = information(robot, q, load, options)?;
        match postures.iter_mut().find(|(known, ..)| known == q) {
            Some((_, sum, count)) => (*sum, *count) = (*sum + of_run, *count + 1),
            None => postures.push((*q, of_run, 1)),
        }
    }
    let most = postures.iter().map(|(_, sum, _)| sum).sum::<Matrix6<f64>>().diagonal();
    let is_shown = |drive: usize| SHOWN * most.max() < most[drive];
    if let Some(beyond) = found.unseen.iter().find(|unseen| is_shown(unseen.drive)) {
        return Err(MeasureError::Beyond { drive: beyond.drive + 1, by: beyond.shown_by });
    }
    let repeats = options.repeats();
    let matrix: Matrix6<f64> = postures.iter().map(|(_, sum, count)| sum * repeats.shrunk(*count)).sum();
    let shown = found.kept.value(&matrix).ok_or_else(|| MeasureError::Blind(found.weakest(&matrix)))?;
    let value = shown + found.unseen_value;
    Ok((value, (shares.bound / runs.len() as f64 + found.unseen_value) / value))
}

impl Options {
    /// How high the floor is, from the base, m: a window that goes deeper says that it is as deep; of one that is all below the base and open
    /// there nobody knows.
    fn floor(&self) -> Option<f64> {
        match self.window.as_ref().map(|[_, _, z]| *z) {
            Some(z) if z.min().is_finite() => Some(z.min().min(0.0)),
            Some(z) if z.max() <= 0.0 => None,
            _ => Some(0.0),
        }
    }

    /// How often a posture may be run, and what it then tells.
    fn repeats(&self) -> Repeats {
        Repeats { ways: self.ways.len().max(1), most: self.repeats, share: self.missed() / self.variance() }
    }

    /// What the markers of a run miss together, m^2: of m that err alike the mean errs as each of them does.
    fn missed(&self) -> f64 {
        self.markers.len().max(1) as f64 * self.posture_sigma.powi(2)
    }

    /// By which the readings of a run are weighed, m^2. No covariance of m markers that err by `sigma` each for itself and by `posture_sigma`
    /// together is larger than `sigma^2 + m posture_sigma^2`, however alike the markers err.
    fn variance(&self) -> f64 {
        self.sigma.powi(2) + self.missed()
    }
}

/// What one run of a posture tells of the compliances where it is the only one, 1/(rad/(N m))^2.
fn information(robot: &Robot, q: &[f64; 6], load: &Wrench, options: &Options) -> Result<Matrix6<f64>, MeasureError> {
    let columns = columns(robot, q, load, (options.load_at, &options.markers))?;
    let sum = columns.iter().flatten().map(|row| row * row.transpose()).sum::<Matrix6<f64>>();
    Ok(sum / options.variance())
}

/// Of every marker three rows: by how much each coordinate grows with the compliance of each drive, m per rad/(N m).
fn columns(
    robot: &Robot,
    q: &[f64; 6],
    load: &Wrench,
    (at, markers): (Vector3<f64>, &[Vector3<f64>]),
) -> Result<Vec<[Vector6<f64>; 3]>, MeasureError> {
    let (each, share) =
        columns_at(robot, q, &load.0, &at, markers).map_err(|_| PostureError::Planar(robot.name.clone()))?;
    // Beside a compensator the slope of kappa / (1 + kappa dK).
    let slope = |j: usize| if j == 1 { share * share } else { 1.0 };
    Ok(each
        .into_iter()
        .map(|columns| std::array::from_fn(|c| Vector6::from_fn(|j, _| slope(j) * columns[j][c])))
        .collect())
}

/// `W`: the mean of `A^T A` over postures of the work and three forces on its tool point.
fn predicted(robot: &Robot, work: &[[f64; 6]], tool: &Vector3<f64>) -> Result<Matrix6<f64>, MeasureError> {
    let mut weight = Matrix6::zeros();
    for q in work {
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            for rows in columns(robot, q, &Wrench::force(axis), (*tool, &[*tool]))? {
                weight += rows.iter().map(|row| row * row.transpose()).sum::<Matrix6<f64>>();
            }
        }
    }
    Ok(weight / (3 * work.len()) as f64)
}

/// What the prior leaves open of the drives that are not among these: `W_ij S_ij`, whose sum is the variance of the prediction, (m/N)^2; zero for the others.
fn left_open(robot: &Robot, weight: &Matrix6<f64>, shown: &[usize]) -> Matrix6<f64> {
    let (covariance, k) = (covariance(robot), robot.drive_compliance().map(|k| k.unwrap_or(0.0)));
    let is_open = |drive: usize| !shown.contains(&drive);
    Matrix6::from_fn(
        |i, j| if is_open(i) && is_open(j) { weight[(i, j)] * k[i] * k[j] * covariance[(i, j)] } else { 0.0 },
    )
}

/// In which direction a load turns a drive most so that a marker moves, over some of the postures; `None` where none does.
fn shown_by(
    robot: &Robot,
    postures: &[[f64; 6]],
    options: &Options,
    drive: usize,
) -> Result<Option<&'static str>, MeasureError> {
    const SOME: usize = 60;
    /// Of what the drive shows least that is no rounding, as a part of what the drive that is shown best does.
    const NOTHING: f64 = 1e-9;
    /// The second direction must show it so much better to be taken for the first.
    const BETTER: f64 = 2.0;
    let mut best = (0.0, None);
    for (name, along) in [("left", Vector3::y()), ("ahead", Vector3::x()), ("down", -Vector3::z())] {
        let load = Wrench::force(along * options.newtons);
        let mut sum = Matrix6::zeros();
        for q in postures.iter().take(SOME) {
            sum += information(robot, q, &load, options)?;
        }
        let of_drive = sum[(drive, drive)];
        if NOTHING * sum.diagonal().max() < of_drive && BETTER * best.0 < of_drive {
            best = (of_drive, Some(name));
        }
    }
    Ok(best.1)
}

/// What errors of the drives are parts of: their compliances, rad/(N m), and of a rigid drive the paper's.
fn sizes(robot: &Robot) -> Result<[f64; 6], MeasureError> {
    let Arm::SixAxis { drives, .. } = &robot.arm else { return Err(PostureError::Planar(robot.name.clone()).into()) };
    let JointCompliance(usual) = JointCompliance::PAPER;
    let JointCompliance(k) = drives.compliance;
    Ok(std::array::from_fn(|drive| if 0.0 < k[drive] { k[drive] } else { usual[drive] }))
}

/// How far markers move, m, with the compliances that the robot has.
fn expected(robot: &Robot, q: &[f64; 6], load: &Wrench, options: &Options) -> Result<Vec<Vector3<f64>>, MeasureError> {
    let Arm::SixAxis { drives, .. } = &robot.arm else { return Err(PostureError::Planar(robot.name.clone()).into()) };
    let found = columns_at(robot, q, &load.0, &options.load_at, &options.markers);
    let (each, share) = found.map_err(|_| PostureError::Planar(robot.name.clone()))?;
    let k = |j: usize| drives.compliance.0[j] * if j == 1 { share } else { 1.0 };
    Ok(each.into_iter().map(|columns| (0..6).map(|j| columns[j] * k(j)).sum()).collect())
}

/// Candidates, and the criterion.
struct Search<'a> {
    robot: &'a Robot,
    options: &'a Options,
    candidates: Candidates,
    kept: design::Kept,
    unseen_value: f64,
    unseen: Vec<Unseen>,
    work: usize,
}

impl<'a> Search<'a> {
    fn of(robot: &'a Robot, options: &'a Options, parts: &Parts) -> Result<Self, MeasureError> {
        for point in options.markers.iter().chain([&options.load_at, &options.tool]) {
            check_tool(&Pose::translation(point.x, point.y, point.z))?;
        }
        let candidates = Candidates::of(robot, options, parts)?;
        let kept = design::Kept::of(&candidates.information).ok_or(MeasureError::NothingSeen)?;
        let least = kept.drives.len().div_ceil(3 * options.markers.len().max(1)).max(2);
        if options.runs < least {
            return Err(MeasureError::TooFew { runs: options.runs, drives: kept.drives.len(), least });
        }
        let (runs, repeats, postures) = (options.runs, options.repeats, candidates.postures.len());
        if postures * repeats < runs {
            return Err(MeasureError::TooFewPostures { runs, repeats, postures });
        }
        let work: Vec<[f64; 6]> = if options.work.is_empty() {
            candidates.postures.iter().copied().take(500).collect()
        } else {
            options.work.clone()
        };
        let aim = match options.criterion {
            Criterion::Prediction => Aim::Trace(predicted(robot, &work, &options.tool)?),
            Criterion::A => {
                let count = kept.drives.len() as f64;
                Aim::Trace(Matrix6::from_diagonal(&Vector6::from(sizes(robot)?.map(|k| k.powi(-2) / count))))
            }
            Criterion::D => Aim::Determinant(sizes(robot)?),
        };
        let kept = kept.aiming(&aim);
        let open = match &aim {
            Aim::Trace(weight) if options.criterion == Criterion::Prediction => left_open(robot, weight, &kept.drives),
            Aim::Trace(_) | Aim::Determinant(_) => Matrix6::zeros(),
        };
        let unseen_value = open.sum();
        let unseen = (0..6).filter(|drive| !kept.drives.contains(drive)).map(|drive| {
            let share = if 0.0 < unseen_value { open.row(drive).sum() / unseen_value } else { 0.0 };
            Ok(Unseen { drive, share, shown_by: shown_by(robot, &candidates.postures, options, drive)? })
        });
        let unseen = unseen.collect::<Result<_, MeasureError>>()?;
        Ok(Self { robot, options, candidates, kept, unseen_value, unseen, work: work.len() })
    }

    fn shares(&self, parts: &Parts) -> Result<Shares, Stopped> {
        self.kept.shares(&self.candidates.information, parts)
    }

    fn exact(&self, shares: &Shares, runs: usize, parts: &Parts) -> Result<Chosen, Stopped> {
        self.kept.exact(&self.candidates.information, shares, (runs, self.options.repeats()), parts)
    }

    /// The drive of which a matrix tells least.
    fn weakest(&self, matrix: &Matrix6<f64>) -> usize {
        let known = |drive: &usize| matrix[(*drive, *drive)];
        self.kept.drives.iter().copied().min_by(|a, b| known(a).total_cmp(&known(b))).map_or(1, |drive| drive + 1)
    }

    fn plan(&self, shares: &Shares, chosen: &Chosen, parts: &Parts) -> Result<Plan, MeasureError> {
        let Self { robot, options, candidates, kept, work, unseen, unseen_value } = self;
        let Arm::SixAxis { limits, .. } = &robot.arm else {
            return Err(PostureError::Planar(robot.name.clone()).into());
        };
        let run = |&index: &usize| {
            let (q, way) = candidates.run(index, options.ways.len());
            let load = Wrench::force(options.ways[way].along * options.newtons);
            let expected = expected(robot, &q, &load, options)?;
            Ok(Run { q, way, load, expected })
        };
        let mut runs: Vec<Run> = chosen.runs.iter().map(run).collect::<Result<_, MeasureError>>()?;
        route::order(&mut runs, limits.speeds, |run| run.q);
        parts.one_more()?;
        let count = options.runs as f64;
        Ok(Plan {
            runs,
            value: chosen.value + unseen_value,
            lower_bound: shares.bound / count + unseen_value,
            shares_efficiency: shares.bound / shares.value,
            random: kept.random(&candidates.information, (options.runs, options.repeats())) + unseen_value,
            unseen: unseen.clone(),
            unseen_value: *unseen_value,
            errors: kept.errors(&chosen.matrix),
            candidates: candidates.information.len(),
            work: *work,
        })
    }
}

/// A posture is judged: markers and load point in the window and above the floor, the arm clear of the floor and of itself, in sight.
fn stands_free(robot: &Robot, q: &[f64; 6], options: &Options) -> Result<bool, MeasureError> {
    let planar = || PostureError::Planar(robot.name.clone());
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return Err(planar().into()) };
    let theta = geometry.model_angles(q, limits.third_axis);
    let flange = geometry.forward(&theta);
    let floor = options.floor();
    let at_hand = |at: &Vector3<f64>| {
        let point = flange * nalgebra::Point3::from(*at);
        let inside = |window: &[Interval; 3]| (0..3).all(|axis| window[axis].contains(point[axis], 0.0));
        floor.is_none_or(|floor| floor <= point.z) && options.window.as_ref().is_none_or(inside)
    };
    // Where nothing is loaded, nothing has a load point.
    let loaded = (!options.ways.is_empty()).then_some(&options.load_at);
    if !options.markers.iter().chain(loaded).all(at_hand) {
        return Ok(false);
    }
    let thick = ThickArm::new(robot, &Pose::identity(), None).ok_or_else(planar)?;
    let touches = thick.clearance(&[theta], &Surroundings::above(floor)).is_some_and(|found| found.distance < 0.0);
    let sees = |instrument: &Instrument| instrument.sees(&thick, (&theta, &flange), &options.markers);
    Ok(!touches && options.instrument.as_ref().is_none_or(sees))
}
