//! What do poses of one orientation of the tool have in common?

use nalgebra::{Matrix3, Vector3};

use pulp::Simd;

use super::SpatialArm;
use super::lanes::Lanes;
use super::vectors::Triple;
use crate::load::Forces;

/// The vectors that poses of the tool with one orientation share, base axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToolVectors {
    /// Axis of joint 6: the flange's z.
    pub(super) axis_6: Vector3<f64>,
    /// The flange's x.
    pub(super) flange_x: Vector3<f64>,
    /// From the wrist centre to the tool point, m.
    pub(super) wrist_to_tool: Vector3<f64>,
    /// The forces that may act; any where `None`.
    pub(super) forces: Option<Forces>,
}

/// The same vectors for every roll of the tool about its axis: each is `still + cos * cos(roll) + sin * sin(roll)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RolledTool {
    pub(super) still: ToolVectors,
    pub(super) cos: ToolVectors,
    pub(super) sin: ToolVectors,
    /// The forces that may act, whatever the roll; any where `None`.
    pub(super) forces: Option<Forces>,
}

impl ToolVectors {
    /// The same under some forces only.
    #[must_use]
    pub(crate) fn under(self, forces: Option<Forces>) -> Self {
        Self { forces, ..self }
    }
}

impl RolledTool {
    /// Axis of joint 6, the flange's x, and the vector from the wrist centre to the tool point at rolls of these sines and cosines.
    #[inline(always)]
    pub(super) fn at<S: Simd>(&self, simd: S, s: Lanes<S>, c: Lanes<S>) -> [Triple<S>; 3] {
        let Self { still, cos, sin, .. } = self;
        let parts = [
            [&still.axis_6, &cos.axis_6, &sin.axis_6],
            [&still.flange_x, &cos.flange_x, &sin.flange_x],
            [&still.wrist_to_tool, &cos.wrist_to_tool, &sin.wrist_to_tool],
        ];
        let mut vectors = [Triple::splat(simd, &still.axis_6); 3];
        for i in 0..3 {
            let [still, cos, sin] = parts[i];
            vectors[i] = Triple::splat(simd, still) + Triple::splat(simd, cos) * c + Triple::splat(simd, sin) * s;
        }
        vectors
    }

    /// The same under some forces only.
    #[must_use]
    pub(crate) fn under(self, forces: Option<Forces>) -> Self {
        Self { forces, ..self }
    }
}

impl SpatialArm {
    /// The vectors that follow from the rotation of the tool (base axes).
    pub(crate) fn orientation(&self, tool: &Matrix3<f64>) -> ToolVectors {
        let flange = tool * self.flange_from_tool.rotation.inverse().to_rotation_matrix();
        let point = self.flange_from_tool.translation.vector + Vector3::z() * self.geometry.c4;
        ToolVectors {
            axis_6: flange * Vector3::z(),
            flange_x: flange * Vector3::x(),
            wrist_to_tool: flange * point,
            forces: None,
        }
    }

    /// The vectors at every roll, from the rotations of the tool (base axes) at no roll, a quarter turn and half a turn.
    pub(crate) fn rolled_tool(&self, tools: [&Matrix3<f64>; 3]) -> RolledTool {
        let [none, quarter, half] = tools.map(|tool| self.orientation(tool));
        let of = |part: fn(&ToolVectors) -> Vector3<f64>| {
            let (none, quarter, half) = (part(&none), part(&quarter), part(&half));
            let still = (none + half) / 2.0;
            [still, (none - half) / 2.0, quarter - still]
        };
        let [axis_6, flange_x, wrist_to_tool] = [of(|it| it.axis_6), of(|it| it.flange_x), of(|it| it.wrist_to_tool)];
        let [still, cos, sin] = [0, 1, 2].map(|i| ToolVectors {
            axis_6: axis_6[i],
            flange_x: flange_x[i],
            wrist_to_tool: wrist_to_tool[i],
            forces: None,
        });
        RolledTool { still, cos, sin, forces: None }
    }
}
