//! Verb: how stiff are the drives of a robot of which deflections were measured?
//!
//! A load `w` turns each spring j by `kappa_j (g_j(load) . w)`, and that moves a marker by `g_j(marker)` times as much, where the columns
//! `g_j(point) = (J A)_j` are those of the drive Jacobian at the point (\[theory\], section 1):
//!
//! ```text
//! y_im = sum_j kappa_j g_j(marker) (g_j(load) . w_i) + noise
//! ```
//!
//! linear in the compliances. Beside a gravity compensator drive 2 has `kappa_2 / (1 + kappa_2 dK(theta_2))` in place of `kappa_2`, which is
//! solved by Gauss and Newton's steps. Left out, as everywhere: what bends between the drives, and the robot's own weight.

mod choice;
mod compensated;
mod diagnostics;
mod model;
mod outlying;
mod posterior;
mod regression;
mod robust;
mod springs;
mod work;
mod written;

use nalgebra::DMatrix;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::robot::Robot;
use crate::watch::Stopped;

pub use choice::{Fit, Tried, identify};
pub use diagnostics::{Combination, Outlier, Residual};
pub use model::Springs;
pub use posterior::{Posterior, Updated};
pub use springs::Spring;
pub(crate) use springs::columns_at;

/// A drive whose standard error is more than this share of its compliance is not identified.
pub const MOST_RELATIVE_ERROR: f64 = 0.5;
/// From so many standard deviations on a remainder counts less in Huber's estimate; a tenth of normal ones reach it.
const HUBER_BOUND: f64 = 2.5;

/// Along which axes vectors of a table point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axes {
    /// Those of the base.
    #[default]
    Base,
    /// Those of the flange at the posture of the row.
    Flange,
}

/// How the compliances are estimated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Estimator {
    /// Every reading counts by its noise alone.
    #[default]
    LeastSquares,
    /// Huber's: readings that fit badly count less.
    Huber,
}

impl Estimator {
    /// As it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::LeastSquares => "least-squares",
            Self::Huber => "huber",
        }
    }
}

/// What is asked of an identification.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Of the loads.
    pub load_axes: Axes,
    /// Of the displacements.
    pub moved_axes: Axes,
    /// How.
    pub estimator: Estimator,
    /// What springs.
    pub model: Springs,
    /// How many ranges of joint 2 have a compliance of drive 2 of their own, where such a model is tried.
    pub regions: usize,
    /// What is known of drives of robots of this size is updated by the measurements, rather than left aside.
    pub with_prior: bool,
    /// When was measured, as year-month-day.
    pub date: Option<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            load_axes: Axes::default(),
            moved_axes: Axes::default(),
            estimator: Estimator::default(),
            model: Springs::default(),
            regions: 2,
            with_prior: false,
            date: None,
        }
    }
}

/// Why nothing can be identified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IdentifyError {
    /// Only two links of this robot are known.
    #[error("{0} is a planar robot: it has no six joints; a robot file with [geometry] is needed")]
    Planar(String),
    /// Less readings than unknowns.
    #[error("{readings} rows hold {numbers} displacements; {unknowns} compliances are unknown, expected at least {least} rows, and better twenty postures", numbers = 3 * readings)]
    TooFew {
        /// How many rows.
        readings: usize,
        /// How many springs.
        unknowns: usize,
        /// The fewest rows.
        least: usize,
    },
    /// Nothing was seen.
    #[error("no load of any row turns a drive so that a marker moves; are load point, markers and frames right?")]
    NothingSeen,
    /// Only sums were seen.
    #[error(
        "only sums of drives show, none alone: the postures differ too little; turn the joints 2 to 6 as well as joint 1, or load along other axes"
    )]
    OnlySums,
    /// The best fit has no spring.
    #[error(
        "the displacements go against the forces: no compliance of any drive explains them; are the signs of forces and displacements, their \
         axes and the joint angles those of this robot?"
    )]
    Against,
    /// The compensator pushes harder than drive 2 holds.
    #[error(
        "row {row}: the gravity compensator of {robot} would push harder than drive 2 holds; its numbers must be wrong"
    )]
    Unstable {
        /// Which row.
        row: usize,
        /// Which robot.
        robot: String,
    },
    /// The model has a compensator that the robot file does not have.
    #[error(
        "{0} has no gravity compensator in its robot file; give [compensator] base_mm, arm_mm, stiffness_n_per_mm and free_length_mm: the ends stay, \
         the spring is found"
    )]
    NoCompensator(String),
    /// Joint 2 is turned too little.
    #[error("joint 2 stands at {angles} angles; expected at least {least}, two for each of the {regions} regions")]
    TooFewAngles {
        /// How many.
        angles: usize,
        /// The fewest.
        least: usize,
        /// How many regions.
        regions: usize,
    },
    /// A prior is of drives.
    #[error("the prior is of the six drives: it goes with the model \"drives\", not with \"{0}\"")]
    PriorOfDrives(&'static str),
    /// Nothing is known of drives of such a robot.
    #[error(transparent)]
    NoPrior(#[from] crate::prior::NoPrior),
    /// The search did not end.
    #[error("no compliance was found: the numbers leave the range of a computer; look for a wrong unit")]
    NotFound,
    /// The work is no longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Why a drive is not identified.
#[derive(Clone, Debug, PartialEq)]
pub enum Unknown {
    /// No load turns it.
    NotTurned,
    /// It is turned, and no marker moves.
    NotMoved,
    /// Only a sum with these others (springs from 0) is shown.
    OnlyWith(Vec<usize>),
    /// The best fit leaves it rigid: zero is the least that a compliance may be.
    Rigid,
    /// One posture alone shows it.
    OnePosture,
    /// Its standard error is this share of it.
    Uncertain(f64),
}

/// What is found of one spring; rad/(N m), of a compensator N/m and N.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Which.
    pub spring: Spring,
    /// Not negative; `None` where it is not seen.
    pub compliance: Option<f64>,
    /// The larger of that from the scatter of all remainders and that from leaving out each posture in turn.
    pub standard_error: Option<f64>,
    /// Where it lies with 95 %, by Student's t; cut at zero.
    pub interval: Option<[f64; 2]>,
    /// By Huber's estimate.
    pub robust: Option<f64>,
    /// Why it is not identified; `None` where it is.
    pub unknown: Option<Unknown>,
    /// What it has from now on: what was found with all that is not identified held, or, of such a one, what was assumed before.
    pub used: f64,
}

/// What an identification has found.
#[derive(Clone, Debug)]
pub struct Identification {
    /// The robot with the compliances that were identified, and the others as they were before.
    pub robot: Robot,
    /// The robot with what was known of its drives: as its file says, else by the prior.
    pub known: Robot,
    /// How was estimated.
    pub estimator: Estimator,
    /// What springs.
    pub model: Springs,
    /// The models that were tried, where one was to be chosen.
    pub tried: Vec<Tried>,
    /// From where to where joint 2 stood in each region, as reported, rad; empty where drive 2 has one compliance.
    pub regions: Vec<[f64; 2]>,
    /// What the measurements make of the prior, where that was asked for.
    pub posterior: Option<Posterior>,
    /// Of every spring.
    pub estimates: Vec<Estimate>,
    /// How far a coordinate moved, root mean square, m.
    pub before: f64,
    /// What the compliances found leave of that, m.
    pub after: f64,
    /// What those leave that are used, m.
    pub after_used: f64,
    /// What is left of every coordinate where its posture is left out, m; `None` where a posture alone shows some spring.
    pub left_out: Option<f64>,
    /// How many times the noise that the table tells the remainders are.
    pub noise_ratio: Option<f64>,
    /// Singular values of the system, m per rad/(N m), descending.
    pub singular_values: Vec<f64>,
    /// The combination of springs that is seen worst.
    pub least_seen: Combination,
    /// Correlation of the estimates, in their order; 0 where one is not estimated, 1 with itself.
    pub correlation: DMatrix<f64>,
    /// Of every reading.
    pub residuals: Vec<Residual>,
    /// Readings that fit so badly that something was wrong with them, or with the model there; the worst first.
    pub outliers: Vec<Outlier>,
    /// How many postures.
    pub postures: usize,
    /// What is odd, each a sentence.
    pub remarks: Vec<String>,
}

impl Identification {
    /// What of the displacements is explained: 1 - after / before.
    pub fn explained(&self) -> f64 {
        1.0 - self.after / self.before
    }

    /// The same of each posture by the others.
    pub fn explained_left_out(&self) -> Option<f64> {
        self.left_out.map(|left_out| 1.0 - left_out / self.before)
    }

    /// The largest singular value over the smallest; infinite where something is not seen.
    pub fn condition(&self) -> f64 {
        let values = &self.singular_values;
        match (values.first(), values.last()) {
            (Some(most), Some(least)) if 0.0 < *least => most / least,
            _ => f64::INFINITY,
        }
    }
}

/// Root mean square.
fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|x| x * x).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

/// Student's t that 95 % stay within, either way.
fn student(freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom).map_or(f64::INFINITY, |t| t.inverse_cdf(0.975))
}
