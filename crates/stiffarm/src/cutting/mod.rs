//! With what force does a process push on its tool: mean, extremes, moment and power?
//!
//! Axes of the cut, on the tool: the feed, across it (left of the feed, seen from the spindle), and axial (away from the work). A robot,
//! whose first modes lie at 5 to 25 Hz, follows the mean over a revolution; the teeth pass far above, so that mean and range
//! are distinguished.

mod dynamic;
mod edge;
mod measured;
mod milling;
mod quadrature;

use nalgebra::Vector3;

pub use edge::Edge;
pub use measured::{Along, Measured, MeasuredAxes, MeasuredForce};
pub use milling::{CutArc, Engagement, Milling, Side};

/// The largest force that is taken, N.
const MOST: f64 = 1e6;

/// What cuts, or presses, and how: everything in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Process {
    /// Of the spindle, rad/s; nothing needs it but power and what is reported of time.
    pub spindle: Option<f64>,
    /// Turns clockwise, seen from the spindle, as right-hand tools do.
    pub is_clockwise: bool,
    /// The law of the force.
    pub law: Law,
}

/// What of a mill holds its teeth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shank {
    /// It begins so far above the tip, where the flutes end, m.
    pub flute: f64,
    /// m.
    pub diameter: f64,
}

/// Where a force comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// So many N in any direction.
    Worst(f64),
    /// N along feed, across and axial, as given: measured, or computed elsewhere.
    Constant([f64; 3]),
    /// A mill, tooth by tooth.
    Milling(Milling),
    /// A drill: N against its feed, N m against its turning.
    Drilling {
        /// N.
        thrust: f64,
        /// N m.
        torque: f64,
    },
    /// A tool that is pressed and stirs: N into the axis, against the feed, and to the left.
    FrictionStir {
        /// N.
        axial: f64,
        /// N.
        traverse: f64,
        /// N.
        side: f64,
        /// N m against its turning.
        torque: f64,
    },
    /// As it was measured along the path.
    Measured(Measured),
}

/// What a process does to its tool.
#[derive(Clone, Debug, PartialEq)]
pub struct CuttingForce {
    /// Over a revolution, N along feed, across and axial; of a measured force over all of it, in its own axes; `None` of a force that may point
    /// anywhere.
    pub mean: Option<[f64; 3]>,
    /// The smallest and the largest of each over a revolution, N.
    pub range: Option<[[f64; 3]; 2]>,
    /// The largest size over a revolution, N.
    pub largest: f64,
    /// The mean moment about the tool axis, N m, positive about the axis away from the work.
    pub moment: f64,
    /// The mean power of the spindle, W; `None` where its speed is not known.
    pub power: Option<f64>,
    /// The force at each of so many angles of the spindle, evenly over a revolution, N: a figure; one where it does not turn with
    /// the spindle, none where it may point anywhere or was measured.
    pub revolution: Vec<[f64; 3]>,
}

/// A process with which nothing can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CuttingError {
    /// Not finite, or beyond all machines.
    #[error("a force of {0} N; expected at most 1e6 N")]
    Force(f64),
    /// A tool or an engagement that is none.
    #[error("{what} of {value}; expected {expected}")]
    Value {
        /// Which.
        what: &'static str,
        /// As it was given.
        value: f64,
        /// What was expected.
        expected: &'static str,
    },
}

/// Angles of the spindle in a figure.
pub const ANGLES: usize = 720;

impl Process {
    /// The mean force along feed, across and axial, N, and the mean moment about the axis, N m, as [`Self::force`] has them, without the rest;
    /// `None` of a force that may point anywhere.
    ///
    /// # Errors
    /// As [`Self::force`].
    pub fn mean(&self) -> Result<Option<([f64; 3], f64)>, CuttingError> {
        let Law::Milling(milling) = &self.law else {
            let CuttingForce { mean, moment, .. } = self.force()?;
            return Ok(mean.map(|mean| (mean, moment)));
        };
        let (force, moment) = milling.checked_mean(self.sense())?;
        let worst = force.into_iter().chain([moment]).find(|part| !(part.abs() <= MOST));
        worst.map_or(Ok(Some((force, moment))), |part| Err(CuttingError::Force(part)))
    }

    /// By how much the mean force, along feed, across and axial, changes where the tool is moved across (to its left) and axially (away from
    /// the work), N/m; `None` where no cut is known.
    ///
    /// # Errors
    /// As [`Self::force`].
    pub fn changes(&self) -> Result<Option<[[f64; 3]; 2]>, CuttingError> {
        if let Law::Milling(milling) = &self.law { milling.changes(self.sense()).map(Some) } else { Ok(None) }
    }

    /// A moment against the turning of the tool points up where it turns clockwise from above.
    fn sense(&self) -> f64 {
        if self.is_clockwise { 1.0 } else { -1.0 }
    }

    /// The force on the tool.
    ///
    /// # Errors
    /// A tool or an engagement that is none, a force of more than 1 MN.
    pub fn force(&self) -> Result<CuttingForce, CuttingError> {
        let same = |force: [f64; 3], moment: f64| CuttingForce {
            mean: Some(force),
            range: Some([force; 2]),
            largest: Vector3::from(force).norm(),
            moment,
            power: None,
            revolution: vec![force],
        };
        let sense = self.sense();
        let mut found = match &self.law {
            Law::Worst(newtons) => CuttingForce {
                mean: None,
                range: None,
                largest: *newtons,
                moment: 0.0,
                power: None,
                revolution: Vec::new(),
            },
            Law::Constant(force) => same(*force, 0.0),
            Law::Drilling { thrust, torque } => same([0.0, 0.0, *thrust], sense * torque),
            Law::FrictionStir { axial, traverse, side, torque } => same([-traverse, *side, *axial], sense * torque),
            Law::Milling(milling) => milling.force(sense)?,
            Law::Measured(measured) => measured.force(),
        };
        found.power = self.spindle.map(|spindle| found.moment.abs() * spindle);
        if matches!(self.law, Law::Worst(_) | Law::Constant(_) | Law::Measured(_)) {
            found.power = None;
        }
        let parts = found.mean.into_iter().chain(found.range.into_iter().flatten()).flatten();
        let worst = parts.chain([found.largest, found.moment]).find(|part| !(part.abs() <= MOST));
        worst.map_or(Ok(found), |part| Err(CuttingError::Force(part)))
    }
}
