//! What of a process tells whether it swings: teeth, their engagement and how hard a chip is to make thicker.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Matrix3x2, Vector3};

use crate::cutting::{CuttingError, Law, Milling, Process};
use crate::modes::ModesError;

/// Within which angle of the tool axis a feed is a plunge: 60 deg.
const PLUNGE: f64 = 0.5;
/// A tooth that cuts for no larger a share of a pitch hits rather than presses.
const SHORT: f64 = 0.5 + 1e-9;
/// The depth beyond which no edge is searched for, m: end mills have no longer ones.
pub const LONGEST: f64 = 0.3;

/// A flat mill, turning right, in its cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// Tool and engagement.
    pub milling: Milling,
    /// Of the spindle, rad/s.
    pub spindle: f64,
}

/// Why it cannot be computed whether a cut swings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChatterError {
    /// The robot, its posture, tool or damping.
    #[error(transparent)]
    Modes(#[from] ModesError),
    /// The process.
    #[error("the process: {0}")]
    Cutting(#[from] CuttingError),
    /// No cut of which anything is known.
    #[error("chatter of {0} is not covered; expected a flat end mill with a material, its engagement and its spindle")]
    Covered(&'static str),
    /// It turns left.
    #[error("chatter of a spindle that turns counter-clockwise is not covered; expected rotation = \"clockwise\"")]
    LeftHand,
    /// Nobody says how fast it turns.
    #[error("the process: spindle_rpm is missing; whether a cut swings depends on when its teeth pass")]
    Spindle,
    /// No direction.
    #[error("a feed along {0:?}; expected three finite numbers, not all 0")]
    Feed([f64; 3]),
    /// Along the axis of the tool.
    #[error(
        "chatter of a plunge is not covered: the feed is within 60 deg of the tool axis; expected a feed across it"
    )]
    Plunge,
    /// A mode that swings for ever.
    #[error("the mode at {0} Hz has no damping: any cut would swing; expected a damping ratio of more than 0")]
    Undamped(f64),
    /// Teeth are counted one by one in modes.
    #[error(
        "a tip that was measured frequency by frequency is not counted tooth by tooth: that needs modes; expected a table of modes, or the mean"
    )]
    NoModes,
    /// Another posture swings otherwise.
    #[error(
        "a tip that was measured on the robot tells of the posture at which it was measured, and nothing of a path; expected spindle, holder and cutter held by something rigid"
    )]
    OnePosture,
    /// What it weighs is missing where it springs.
    #[error(
        "{0} % of the tip's compliance is of drives that move no inertia; expected the inertia of the tool, or of link 6"
    )]
    Massless(f64),
}

impl Cut {
    /// Of a process.
    ///
    /// # Errors
    /// What is not covered, by its name.
    pub fn of(process: &Process) -> Result<Self, ChatterError> {
        let name = match &process.law {
            Law::Milling(milling) => return Self::of_mill(milling.clone(), process),
            Law::Worst(_) => "a force in any direction",
            Law::Constant(_) => "a constant force",
            Law::Drilling { .. } => "drilling",
            Law::FrictionStir { .. } => "friction stir welding",
            Law::Measured(_) => "a measured force",
        };
        Err(ChatterError::Covered(name))
    }

    fn of_mill(milling: Milling, process: &Process) -> Result<Self, ChatterError> {
        process.force()?;
        if !process.is_clockwise {
            return Err(ChatterError::LeftHand);
        }
        let spindle = process.spindle.filter(|spindle| 0.0 < *spindle && spindle.is_finite());
        spindle.map(|spindle| Self { milling, spindle }).ok_or(ChatterError::Spindle)
    }

    /// From one tooth to the next, s, at a speed of the spindle, rad/s.
    pub fn period_at(&self, spindle: f64) -> f64 {
        TAU / (self.milling.teeth as f64 * spindle)
    }

    /// The mean of the directional factors, N/m^2.
    pub fn mean(&self) -> Matrix3x2<f64> {
        self.milling.mean_directional()
    }

    /// For which share of a pitch a tooth cuts; more than 1 where several cut at once.
    pub fn duty(&self) -> f64 {
        let engagement = &self.milling.engagement;
        (engagement.exit() - engagement.entry()) * self.milling.teeth as f64 / TAU
    }

    /// Does each tooth cut for half of the time or less?
    pub fn is_short(&self) -> bool {
        self.duty() <= SHORT
    }
}

/// Feed, left and away as columns, of a feed that is made perpendicular to the axis `away` from the work, of length one; the axes of both are one frame's.
///
/// # Errors
/// No direction, and a plunge.
pub fn axes(feed: [f64; 3], away: &Vector3<f64>) -> Result<Matrix3<f64>, ChatterError> {
    let given = Vector3::from(feed);
    let length = given.norm();
    if !(0.0 < length && length.is_finite()) {
        return Err(ChatterError::Feed(feed));
    }
    let along = given.dot(away) / length;
    if PLUNGE < along.abs() {
        return Err(ChatterError::Plunge);
    }
    let feed = (given / length - away * along).normalize();
    Ok(Matrix3::from_columns(&[feed, away.cross(&feed), *away]))
}
