//! What is known of the drives before their sag under the arm's own weight is measured, and after.

use crate::chain::{FRAMES, Frames, Weighing};
use crate::identify::Updated;
use crate::prior::{by_size, covariance};
use crate::robot::{Arm, Robot};

/// A normal law of the logarithm of each drive's compliance.
#[derive(Clone, Copy, Debug)]
pub(super) struct DrivesPrior {
    /// Medians, rad/(N m).
    median: [f64; 6],
    /// Standard deviations.
    pub(super) sd: [f64; 6],
}

impl DrivesPrior {
    /// Of a robot: as it was measured or as its file says, else as drives of robots of its payload and reach have it. `None` where neither is known.
    pub(super) fn of(robot: &Robot) -> Option<Self> {
        let Arm::SixAxis { drives, .. } = &robot.arm else { return None };
        if robot.stiffness_is_assumed || drives.scatter.is_some() {
            // Of what no size is known nothing is: the own weight has terms, as without masses.
            let Ok((median, scatter)) = by_size(robot) else { return None };
            return Some(Self { median, sd: scatter.total() });
        }
        let covariance = covariance(robot);
        Some(Self { median: drives.compliance.0, sd: std::array::from_fn(|i| covariance[(i, i)].ln_1p().sqrt()) })
    }

    /// The arm with its masses, where they are known.
    pub(super) fn weighed(self, robot: &Robot, arm: &Frames) -> Option<(Frames, Self)> {
        let weighing = Weighing::of(robot, self.median)?;
        Some((arm.clone().weighed(weighing), self))
    }

    /// What a posterior says of each drive: modes and standard deviations of all parameters.
    pub(super) fn updated(self, parameters: &[f64], deviations: &[f64]) -> [Updated; 6] {
        std::array::from_fn(|i| Updated {
            prior: self.median[i],
            prior_sd: self.sd[i],
            posterior: self.median[i] * parameters[FRAMES + i].exp(),
            sd: deviations[FRAMES + i],
        })
    }
}
