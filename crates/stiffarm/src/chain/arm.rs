//! Where does the flange of a calibrated arm stand, and how do its joints move it?

use nalgebra::{Matrix6, Vector3, Vector6};

use super::frames::{FRAMES, Frames, Joint, Links, Placement, pose};
use super::weighing::Held;
use crate::calibration::{Errors, WEIGHT};
use crate::mass::ToolWeight;
use crate::robot::Robot;
use crate::spatial::Pose;

/// The arm that stands there: as drawn, with the errors of its calibration.
///
/// A *link angle* is what a joint's link is turned by, rad, as a model angle is: the model angle of the joint as reported, and by how much
/// drive and gear yield there.
#[derive(Clone, Debug)]
pub struct TrueArm {
    pub(super) frames: Frames,
    links: Links,
    /// Parameters of weight and gears; empty where all are zero.
    yielding: Vec<f64>,
    /// What hangs on the flange.
    held: Option<Held>,
}

/// Flange and joint axes at some link angles, base frame.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    pub(super) flange: Placement,
    /// Unit direction of each axis, and a point of it, m.
    axes: [(Vector3<f64>, Vector3<f64>); 6],
}

impl Placed {
    /// The flange in the base.
    pub(crate) fn flange(&self) -> Pose {
        pose(self.flange)
    }

    /// How angles at the links move a point, m, that the flange carries: 6 x 6, base axes, translation first.
    pub(crate) fn jacobian(&self, tip: &Vector3<f64>) -> Matrix6<f64> {
        Matrix6::from_columns(&self.axes.map(|(axis, through)| {
            let moved = axis.cross(&(tip - through));
            Vector6::new(moved.x, moved.y, moved.z, axis.x, axis.y, axis.z)
        }))
    }
}

/// A base stands upright: drive 1 has less than a hundredth of what weighs.
pub fn is_upright(cell_from_base: &Pose) -> bool {
    /// rad.
    const LEVEL: f64 = 0.01;
    (cell_from_base.rotation * Vector3::z()).angle(&Vector3::z()) <= LEVEL
}

impl TrueArm {
    /// Of a robot that was calibrated; `None` of one that stands as drawn, and of two links.
    pub fn of(robot: &Robot) -> Option<Self> {
        Self::with(robot, &robot.calibration.as_ref()?.errors)
    }

    /// A robot with some errors; `None` of two links, and where the drives yield under masses that the robot does not have.
    pub fn with(robot: &Robot, errors: &Errors) -> Option<Self> {
        let frames = Frames::with(robot, errors)?;
        let parameters = errors.parameters();
        let yielding = &parameters[FRAMES..];
        let is_rigid = !frames.is_weighed() && yielding.iter().all(|parameter| *parameter == 0.0);
        let yielding = if is_rigid { Vec::new() } else { yielding.to_vec() };
        let links = frames.links(&parameters);
        Some(Self { frames, links, yielding, held: None })
    }

    /// The same arm on an upright base with a tool that was not there when it was calibrated: its weight bends the drives of the robot. As it is where
    /// nobody knows the centre of the tool.
    #[must_use]
    pub fn holding(self, robot: &Robot, tool: Option<&ToolWeight>) -> Self {
        Self { held: tool.and_then(|tool| Held::of(robot, tool)), ..self }
    }

    /// The own weight was found on a base that stands so: upright, or nothing yields under it.
    pub fn stands_as_measured(&self, cell_from_base: &Pose) -> bool {
        let has_terms = self.yielding.iter().take(WEIGHT).any(|parameter| *parameter != 0.0);
        !has_terms && !self.frames.is_weighed() || is_upright(cell_from_base)
    }

    /// The flange in the base frame at the joint angles `q` that the robot reports, rad.
    pub fn flange(&self, q: &[f64; 6]) -> Pose {
        let theta = self.frames.geometry.model_angles(q, self.frames.third_axis);
        pose(self.frames.walk(&self.links, &self.link_angles(&theta), |_, _| ()))
    }

    /// How turning each link alone moves a point `tip`, m, base frame, at the joint angles `q` that the robot reports, rad: 6 x 6, base axes,
    /// translation first, per rad of the link angles.
    pub fn jacobian(&self, q: &[f64; 6], tip: &Vector3<f64>) -> Matrix6<f64> {
        let theta = self.frames.geometry.model_angles(q, self.frames.third_axis);
        self.placed(&self.link_angles(&theta)).jacobian(tip)
    }

    /// The link angles at model angles.
    pub(crate) fn link_angles(&self, theta: &[f64; 6]) -> [f64; 6] {
        let mut psi = *theta;
        if !self.yielding.is_empty() {
            let more = self.frames.yielded(theta, &self.yielding);
            psi = std::array::from_fn(|i| psi[i] + more[i]);
        }
        if let Some(held) = &self.held {
            let more = held.yields(&self.frames.geometry, theta);
            psi = std::array::from_fn(|i| psi[i] + more[i]);
        }
        psi
    }

    /// The model angles at link angles: `theta = psi - d(theta)`, round by round, since `d` changes by some thousandths of what `theta` does;
    /// `None` where the errors are so large that they do not settle.
    pub(crate) fn model_angles(&self, psi: &[f64; 6]) -> Option<[f64; 6]> {
        const ROUNDS: usize = 60;
        /// rad: rounding.
        const SETTLED: f64 = 1e-15;
        let mut theta = *psi;
        for _ in 0..ROUNDS {
            let found = self.link_angles(&theta);
            let off: [f64; 6] = std::array::from_fn(|i| psi[i] - found[i]);
            theta = std::array::from_fn(|i| theta[i] + off[i]);
            let scale = |i: usize| psi[i].abs().max(1.0);
            if (0..6).all(|i| off[i].abs() <= SETTLED * scale(i)) {
                return Some(theta);
            }
        }
        None
    }

    /// Flange and axes at link angles.
    pub(crate) fn placed(&self, psi: &[f64; 6]) -> Placed {
        let mut axes = [(Vector3::zeros(), Vector3::zeros()); 6];
        let each = |i: usize, Joint { centre, axis, .. }: Joint| axes[i] = (axis, centre);
        let flange = self.frames.walk(&self.links, psi, each);
        Placed { flange, axes }
    }
}
