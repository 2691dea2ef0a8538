//! Verb: how does this very arm differ from its drawing, by points on its flange that were measured?
//!
//! Errors of the joints' frames, of drives under the arm's own weight and of gears have normal priors; their modes are found
//! by least squares with Student's weights, the scale of the frames' errors and the noise by their evidence. What the postures do not show keeps
//! its prior. Rows that are wrong are named and left out, judged by the level that explains the table best. The own weight, of a base that stands on a floor, has terms of its own, of which nothing is
//! a stiffness; where the arm's masses are known, it is also tried with the compliances of the drives as all that is unknown, and the
//! evidence decides which of the two explains what was measured.

mod at_work;
mod drives;
mod fit;
mod judged;
mod left_out;
mod level;
mod moved;
mod robust;
mod suspects;

use nalgebra::Vector3;

use crate::calibration::{Calibration, ControllerModel, Errors};
use crate::catalogue::readings::Readings;
use crate::chain::{self, Frames};
use crate::identify::Updated;
use crate::limits::Limits;
use crate::registration::Sight;
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;
use crate::watch::{Stopped, Watch};
pub use at_work::AtWork;
use drives::DrivesPrior;
use fit::{Fitted, Rows};
use judged::Question;
use left_out::left_out;
pub use level::{GEARS_PRIOR, Level, WEIGHT_PRIOR};
use robust::Sound;
pub use robust::WrongRow;

/// So few postures fit any frames.
pub const LEAST_ROWS: usize = 6;
/// m: half of the points of an arm that nobody has calibrated are within this.
const MOST_OFF: f64 = 10e-3;

/// What is asked beside the table.
#[derive(Clone, Debug, Default)]
pub struct CalibrateOptions {
    /// How much may differ; the level with the largest evidence where `None`.
    pub level: Option<Level>,
    /// Where the error that remains is reported.
    pub work: Work,
    /// With which arm the controller computed while it was measured, for the robot file.
    pub controller: Option<ControllerModel>,
}

/// Where is asked for the error that remains?
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Work {
    /// Over all the arm reaches.
    #[default]
    Anywhere,
    /// Within 0.25 m of a point of the base frame, m.
    Near([f64; 3]),
    /// In these very postures, rad as reported, measured on another day: instrument and point stand elsewhere, and are found anew in them.
    OtherDay(Vec<[f64; 6]>),
}

/// One level against the table.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelFit {
    /// `None` is the arm as drawn, with only tracker and points fitted.
    pub level: Option<Level>,
    /// The own weight is that of the arm's masses, rather than by terms.
    pub by_masses: bool,
    /// Root mean square of the distances, m.
    pub rms: f64,
    /// Half of them are less, m.
    pub median: f64,
    /// 95th percentile, m.
    pub p95: f64,
    /// The largest, m.
    pub largest: f64,
    /// Root mean square of those that are predicted by other thirds of joints' ranges, m.
    pub left_out: Option<f64>,
    /// Logarithm of the marginal likelihood, up to what all levels share.
    pub evidence: f64,
    /// How many parameters the rows show.
    pub shown: f64,
}

/// A row of the table, as drawn and calibrated.
#[derive(Clone, Debug, PartialEq)]
pub struct Off {
    /// Its line in the file.
    pub line: usize,
    /// The largest distance of its points as drawn, m.
    pub before: f64,
    /// The same calibrated, m.
    pub after: f64,
}

/// Standard deviations of a coordinate, m: what a plan of the next measurement asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundNoise {
    /// Of a reading; of single points of how the arm repeats a posture, too.
    pub reading: f64,
    /// Of where the arm stands at a posture, the same for all of its points; `None` of single points, of which nothing tells it from the first.
    pub posture: Option<f64>,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Calibrated {
    /// The level taken.
    pub level: Level,
    /// The arm as drawn first, then all levels.
    pub levels: Vec<LevelFit>,
    /// How far readings and postures scatter about the level taken.
    pub noise: FoundNoise,
    /// How the arm differs.
    pub errors: Errors,
    /// What the own weight tells of the compliance of each drive; `None` where it has terms, or is not looked for.
    pub drives: Option<[Updated; 6]>,
    /// The masses of the arm are known, and were tried.
    pub has_masses: bool,
    /// Standard deviations of the errors' posterior; zero of what was not looked for, and of drives (`drives`).
    pub deviations: Errors,
    /// What the rows show of each, 0 to 1.
    pub shown: Errors,
    /// Points and rows that were left out.
    pub wrong_rows: Vec<WrongRow>,
    /// The line of the file from which on all points stand elsewhere, as where the instrument moved, and how far, m.
    pub moved: Option<(usize, f64)>,
    /// The tracker in the base, of each of its stands.
    pub tracker_in_base: Vec<Pose>,
    /// The points in the flange, m.
    pub points: Vec<Vector3<f64>>,
    /// Each row that was kept.
    pub rows: Vec<Off>,
    /// Joints that moved over less than a third of their range, from 1, with that share.
    pub narrow: Vec<(usize, f64)>,
    /// The error that remains; `None` where the arm does not reach the work.
    pub at_work: Option<AtWork>,
    /// With which arm the controller computed, as it was said.
    pub controller: Option<ControllerModel>,
}

/// Why nothing can be said.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CalibrateError {
    /// Two links have no frames.
    #[error("{0} is known by two links only; expected a robot with [geometry] and [limits]")]
    Planar(String),
    /// The controller computes with the arm as drawn.
    #[error(
        "x_mm, y_mm, z_mm are what a controller computes of its own arm, and tell nothing of how the arm differs; expected measured points x1_mm, y1_mm, z1_mm (--columns x1_mm=x_mm,y1_mm=y_mm,z1_mm=z_mm where these were measured)"
    )]
    Computed,
    /// Six unknowns of the tracker and three of each point.
    #[error("{0} rows; expected at least {LEAST_ROWS}, and better forty that move every joint through its range")]
    TooFew(usize),
    /// A frame can turn about a line.
    #[error(
        "all points lie within {spread_mm:.2} mm of one line, so the tracker's frame is not known; expected postures over the workspace"
    )]
    OneLine {
        /// How far, mm.
        spread_mm: f64,
    },
    /// A point that nobody saw.
    #[error("point {0} was seen in no row; expected points that are numbered from 1")]
    Unseen(usize),
    /// One of two points tells nothing.
    #[error("points {0} and {1} are at the same place in every row; expected each point once")]
    Twice(usize, usize),
    /// Every row would have a frame of its own.
    #[error(
        "{stands} stands of the tracker for {rows} rows; expected two rows or more of each stand, and better twenty"
    )]
    TooManyStands {
        /// How many.
        stands: usize,
        /// For how many rows.
        rows: usize,
    },
    /// The arm explains nothing.
    #[error("half of the points are {median_mm:.1} mm or more off{}", because(suspect.as_deref()))]
    NotThisArm {
        /// The median, mm.
        median_mm: f64,
        /// What may be the matter.
        suspect: Option<String>,
    },
    /// More than a third.
    #[error("{wrong} of {of} points are beyond five robust standard deviations, more than a third{}", because(suspect.as_deref()))]
    TooManyWrong {
        /// How many.
        wrong: usize,
        /// Of how many.
        of: usize,
        /// What may be the matter.
        suspect: Option<String>,
    },
    /// Numbers that cannot be solved.
    #[error(
        "these postures do not determine the tracker's frame and the points; expected postures that move every joint"
    )]
    Undetermined,
    /// Nobody waits any longer.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

fn because(suspect: Option<&str>) -> String {
    match suspect {
        Some(what) => format!(": {what}"),
        None => {
            "; is it this robot, and does its file count the joints as the table does? `stiffarm robots verify` tells"
                .into()
        }
    }
}

/// The scale of the frames' errors, m and rad, of which a share of arms have less: alike on a logarithmic scale.
pub(crate) fn scale_of_errors(share: f64) -> f64 {
    let [least, most] = fit::SCALES;
    least * (most / least).powf(share)
}

/// Standard deviations of all errors of an arm that nobody has measured, m and rad, where its frames are off by `scale`.
pub(crate) fn prior_of_errors(scale: f64) -> Vec<f64> {
    Level::Gears.prior(scale, None)
}

/// Finds how an arm differs from its drawing.
///
/// # Errors
/// Of a robot without six axes, of tables that tell nothing or are wrong as a whole, and where nobody waits any longer.
pub fn calibrate(
    robot: &Robot,
    readings: &Readings,
    options: &CalibrateOptions,
    watch: Watch,
) -> Result<Calibrated, CalibrateError> {
    let Arm::SixAxis { limits, .. } = &robot.arm else { return Err(CalibrateError::Planar(robot.full_name())) };
    let arm = Frames::of(robot).ok_or_else(|| CalibrateError::Planar(robot.full_name()))?;
    if !readings.is_measured {
        return Err(CalibrateError::Computed);
    }
    let sights = sights(readings)?;
    let shape = (readings.stands.len(), readings.points);
    let lines: Vec<usize> = readings.rows.iter().map(|row| row.line).collect();
    let start = robust::start(&arm, &sights, shape, robust::SUBSETS).ok_or(CalibrateError::Undetermined)?;
    watch.go_on()?;
    if MOST_OFF < start.1 {
        let suspect = suspects::suspect(&arm, &sights, shape, (start.1, &lines));
        return Err(CalibrateError::NotThisArm { median_mm: start.1 * 1e3, suspect });
    }
    let (start, as_drawn) = start;
    let weighed = DrivesPrior::of(robot).and_then(|prior| prior.weighed(robot, &arm));
    let question = Question {
        arm: &arm,
        weighed: weighed.as_ref().map(|(weighed, prior)| (weighed, prior.sd)),
        sights: &sights,
        shape,
        watch,
    };
    let sound = question.sound(start, as_drawn)?;
    watch.go_on()?;
    let moved = question.moved(&sound)?.map(|(row, far)| (lines[row], far));
    let of: usize = sights.iter().map(|sight| sight.points.iter().flatten().count()).sum();
    let is_too_much = |sound: &Sound| {
        if sound.wrong.len() as f64 <= robust::MOST_WRONG * of as f64 {
            return Ok(());
        }
        let suspect = suspects::suspect(&arm, &sights, shape, (as_drawn, &lines));
        let suspect = suspect.or_else(|| moved.map(|(line, _)| suspects::moved_near(line)));
        Err(CalibrateError::TooManyWrong { wrong: sound.wrong.len(), of, suspect })
    };
    let judged = question.judged(sound, &is_too_much)?;
    let taken = judged.best(options.level).ok_or(CalibrateError::Undetermined)?;
    let (rows, best) = (judged.rows(taken), &judged.fits[taken]);
    let out = left_out(rows, best);
    let at_work = at_work::at_work(rows, best, out.as_ref(), (limits, &options.work))?;
    let deviation: Vec<f64> = (0..chain::ALL).map(|i| best.prior[i] * (1.0 - best.share[i]).max(0.0).sqrt()).collect();
    let drives = weighed
        .as_ref()
        .filter(|_| rows.drives.is_some())
        .map(|(_, prior)| prior.updated(&best.state.parameters, &deviation));
    let errors_of = |parameters: &[f64]| match drives {
        // The parameters of weight are those of the drives.
        Some(_) => Errors { weight: Errors::NONE.weight, ..Errors::of(parameters) },
        None => Errors::of(parameters),
    };
    let compliance = drives.map(|drives| drives.map(|drive| drive.posterior));
    Ok(Calibrated {
        level: best.level.ok_or(CalibrateError::Undetermined)?,
        levels: (0..judged.fits.len())
            .map(|i| {
                let (rows, fitted) = (judged.rows(i), &judged.fits[i]);
                let of_taken = out.as_ref().filter(|_| i == taken).map(|out| out.rms);
                level_fit(rows, fitted, of_taken.or_else(|| left_out::rms(rows, fitted)))
            })
            .collect(),
        noise: FoundNoise { reading: best.noise, posture: rows.together.then(|| best.noise * best.common.sqrt()) },
        errors: Errors { drives: compliance, ..errors_of(&best.state.parameters) },
        drives,
        has_masses: question.weighed.is_some(),
        deviations: errors_of(&deviation),
        shown: errors_of(&best.share),
        wrong_rows: robust::wrong_rows(&judged.left_out(taken, &sights), &sights, &lines),
        moved,
        tracker_in_base: best.state.bases.iter().map(Pose::inverse).collect(),
        points: best.state.points.clone(),
        rows: offs((&judged.fits[0], best), &judged.sound.index, &lines),
        narrow: narrow(&sights, limits),
        at_work,
        controller: options.controller,
    })
}

fn sights(readings: &Readings) -> Result<Vec<Sight>, CalibrateError> {
    /// Of the widest spread: below it points are on a line.
    const FLAT: f64 = 1e-3;
    let rows = &readings.rows;
    if rows.len() < LEAST_ROWS {
        return Err(CalibrateError::TooFew(rows.len()));
    }
    if let Some(j) = (0..readings.points).find(|&j| rows.iter().all(|row| row.points[j].is_none())) {
        return Err(CalibrateError::Unseen(j + 1));
    }
    let pairs = (0..readings.points).flat_map(|j| (0..j).map(move |i| (i, j)));
    if let Some((i, j)) = pairs.into_iter().find(|&(i, j)| rows.iter().all(|row| row.points[i] == row.points[j])) {
        return Err(CalibrateError::Twice(i + 1, j + 1));
    }
    let stands = readings.stands.len();
    if rows.len() < 2 * stands {
        return Err(CalibrateError::TooManyStands { stands, rows: rows.len() });
    }
    let is_oriented = rows.iter().any(|row| row.orientation.is_some());
    for stand in (0..readings.stands.len()).filter(|_| !is_oriented) {
        let seen: Vec<Vector3<f64>> =
            rows.iter().filter(|row| row.stand == stand).flat_map(|row| row.points.iter().flatten().copied()).collect();
        let centre = seen.iter().sum::<Vector3<f64>>() / seen.len() as f64;
        let spread =
            seen.iter().fold(nalgebra::Matrix3::zeros(), |sum, at| sum + (at - centre) * (at - centre).transpose());
        let mut along = spread.symmetric_eigenvalues().map(|x| (x.max(0.0) / seen.len() as f64).sqrt());
        along.as_mut_slice().sort_by(f64::total_cmp);
        if along[1] <= FLAT * along[2] {
            return Err(CalibrateError::OneLine { spread_mm: along[1] * 1e3 });
        }
    }
    Ok(rows
        .iter()
        .map(|row| Sight {
            q: row.q,
            points: row.points.iter().map(|point| point.map(|at| (at, 1.0))).collect(),
            orientation: row.orientation,
            stand: row.stand,
        })
        .collect())
}

fn level_fit(rows: &Rows, fitted: &Fitted, left_out: Option<f64>) -> LevelFit {
    let mut off: Vec<f64> = robust::distances(&fitted.rows).into_iter().map(|(_, _, off)| off).collect();
    off.sort_by(f64::total_cmp);
    let at = |share: f64| off[((off.len() as f64 * share) as usize).min(off.len() - 1)];
    LevelFit {
        level: fitted.level,
        by_masses: rows.drives.is_some(),
        rms: (off.iter().map(|x| x * x).sum::<f64>() / off.len() as f64).sqrt(),
        median: at(0.5),
        p95: at(0.95),
        largest: off.last().copied().unwrap_or(0.0),
        left_out,
        evidence: fitted.evidence,
        shown: fitted.shown,
    }
}

fn offs((before, after): (&Fitted, &Fitted), index: &[usize], lines: &[usize]) -> Vec<Off> {
    let largest = |fitted: &Fitted| {
        let mut of = vec![0.0_f64; index.len()];
        for (row, _, off) in robust::distances(&fitted.rows) {
            of[row] = of[row].max(off);
        }
        of
    };
    let (before, after) = (largest(before), largest(after));
    index.iter().enumerate().map(|(i, &row)| Off { line: lines[row], before: before[i], after: after[i] }).collect()
}

/// Joints that moved little, with the share of their range.
fn narrow(sights: &[Sight], limits: &Limits) -> Vec<(usize, f64)> {
    const LITTLE: f64 = 1.0 / 3.0;
    let share = |i: usize| {
        let angles = sights.iter().map(|sight| sight.q[i]);
        let moved = angles.clone().fold(f64::NEG_INFINITY, f64::max) - angles.fold(f64::INFINITY, f64::min);
        // More than a turn shows nothing that a turn does not.
        moved / limits.joints[i].width().min(std::f64::consts::TAU)
    };
    (0..6).map(|i| (i + 1, share(i))).filter(|(_, share)| *share < LITTLE).collect()
}

impl Calibrated {
    /// The fit of the level taken.
    pub fn taken(&self) -> &LevelFit {
        let by_masses = self.drives.is_some();
        let taken = self.levels.iter().find(|fit| fit.level == Some(self.level) && fit.by_masses == by_masses);
        taken.unwrap_or(&self.levels[0])
    }

    /// The robot that has what was found.
    #[must_use]
    pub fn written(&self, robot: &Robot, date: &str, source: &str) -> Robot {
        let mut changed = robot.clone();
        let taken = self.taken();
        changed.calibration = Some(Box::new(Calibration {
            errors: self.errors.clone(),
            residual: taken.rms,
            left_out: taken.left_out.unwrap_or(taken.rms),
            controller: self.controller,
            rows: self.rows.len(),
            date: date.into(),
            source: source.into(),
        }));
        changed
    }
}
