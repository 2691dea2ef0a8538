//! How does one arm differ from its drawing?

use nalgebra::Vector6;

use crate::geometry::Geometry;
use crate::limits::ThirdAxis;

/// By which axis of the base a joint turns at model zero, as an index of x, y, z.
pub const JOINT_AXES: [usize; 6] = [2, 1, 1, 2, 1, 2];

/// Of drive 2 on sine and cosine of the upper arm's and the forearm's angle from the vertical, of drive 3 on those of the forearm's, of
/// drive 5 on two arms of the tool.
pub const WEIGHT: usize = 8;

/// How one arm differs from its drawing; SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Of each joint's frame: shifts, m, and turns, rad, in the base's axes at model zero. The turn about the joint's own axis is its zero.
    pub frames: [[f64; 6]; 6],
    /// How drives yield under the arm's own weight, rad: of drive 2 times `sin t2, cos t2, sin t23, cos t23`, of drive 3 times
    /// `sin t23, cos t23`, of drive 5 times the level arm of the tool axis and of the line across it; the base stands on a floor.
    pub weight: [f64; WEIGHT],
    /// Once per turn of each joint, rad: times sine and cosine of its model angle.
    pub gears: [[f64; 2]; 6],
    /// How compliant the drives are under the weight of the arm's masses, rad/(N m), instead of the terms of `weight`; `None` where masses are not
    /// known, or do not explain what was measured.
    pub drives: Option<[f64; 6]>,
}

impl Errors {
    /// As drawn.
    pub const NONE: Self = Self { frames: [[0.0; 6]; 6], weight: [0.0; WEIGHT], gears: [[0.0; 2]; 6], drives: None };
}

/// With which arm the controller of a measured robot computes, while it is measured and later.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControllerModel {
    /// The one that was drawn.
    Nominal,
    /// One of its own that was measured (absolute accuracy, an option of most makers).
    Calibrated,
}

impl ControllerModel {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Nominal, Self::Calibrated];

    /// The name that robot files and options use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nominal => "nominal",
            Self::Calibrated => "calibrated",
        }
    }
}

/// What measured postures have shown of one arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// How it differs from its drawing.
    pub errors: Errors,
    /// Root mean square of the distances that are left, m.
    pub residual: f64,
    /// The same where a third of a joint's range is predicted by the rest, m.
    pub left_out: f64,
    /// With which arm its controller computes; `None` where nobody has said it: then no program is written.
    pub controller: Option<ControllerModel>,
    /// How many postures were measured.
    pub rows: usize,
    /// When, as year-month-day.
    pub date: String,
    /// By what.
    pub source: String,
}

/// The zeros of the joints as their pendant would count them, rad: what must be added to each reported angle.
pub fn zeros(geometry: &Geometry, third_axis: ThirdAxis, frames: &[[f64; 6]; 6]) -> [f64; 6] {
    let own: [f64; 6] = std::array::from_fn(|i| frames[i][3 + JOINT_AXES[i]]);
    let mut counted = Vector6::from(own);
    if third_axis == ThirdAxis::Forearm {
        counted[2] += own[1];
    }
    std::array::from_fn(|i| geometry.sign[i] * counted[i])
}

/// The turns about the joints' own axes that these zeros are; the reverse of [`zeros`].
pub(crate) fn own_turns(geometry: &Geometry, third_axis: ThirdAxis, zeros: &[f64; 6]) -> [f64; 6] {
    let mut own: [f64; 6] = std::array::from_fn(|i| geometry.sign[i] * zeros[i]);
    if third_axis == ThirdAxis::Forearm {
        own[2] -= own[1];
    }
    own
}
