//! An arm made ready for enclosures: what is the same at every node.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;

use super::affine::Vector;
use super::node::{Node, WorkPlaneEnclosure};
use crate::batch::SpatialArm;
use crate::interval::Interval;
use crate::inverse::{ArmBranch, Shoulder};
use crate::limits::{Limits, ThirdAxis};
use crate::load::Load;
use crate::tolerances;
use crate::work::WorkPlane;

/// The joints that turn with a zone, from 0.
pub(super) const TURNED_BY_ZONE: [usize; 3] = [0, 3, 5];

/// The work plane and the tool at the placements of a node: from the wrist centre to the tool point, the flange's z and x; base
/// axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToolFrameEnclosure<const N: usize> {
    pub(crate) plane: WorkPlaneEnclosure<N>,
    pub(super) wrist_to_tool: Vector<N>,
    pub(super) axis_6: Vector<N>,
    pub(super) flange_x: Vector<N>,
    /// What pushes on the tool, where all of it is known.
    pub(super) push: Option<PushEnclosure<N>>,
}

/// A force, N, a moment, N m, and the direction along which the displacement counts (all of it where `None`), in one and the same axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PushEnclosure<const N: usize> {
    pub(crate) force: Vector<N>,
    pub(crate) moment: Vector<N>,
    pub(crate) counted: Option<Vector<N>>,
    /// The size of force and moment, whatever their directions.
    pub(crate) sizes: [f64; 2],
}

impl<const N: usize> PushEnclosure<N> {
    /// Each vector changed alike.
    pub(super) fn map(self, change: impl Fn(Vector<N>) -> Vector<N>) -> Self {
        Self {
            force: change(self.force),
            moment: change(self.moment),
            counted: self.counted.map(change),
            sizes: self.sizes,
        }
    }
}

/// An arm whose kinematics and limits are evaluated for all placements of a node at once.
#[derive(Clone, Debug)]
pub(crate) struct ArmEnclosure {
    pub(super) arm: SpatialArm,
    /// Under which it gives way.
    pub(super) load: Load,
    /// From the wrist centre to the tool point (m), the flange's z and its x, in the axes of the tool.
    pub(super) wrist_to_tool: [f64; 3],
    pub(super) axis_6: [f64; 3],
    pub(super) flange_x: [f64; 3],
    /// Squared distances of the wrist centre from the joint-2 axis, elbow up and down, that the links and the limits on
    /// the angle between them allow.
    pub(super) distance_rings: [Option<Interval>; 2],
    /// By how much joints 1, 4 and 6 may turn within a zone, rad, and their ranges of model angles.
    pub(super) turns: [f64; 3],
    pub(super) ranges: [Interval; 3],
}

impl ArmEnclosure {
    /// For an arm without the limits of the joints that are `free`: those that turn with the zone or the tool as a whole.
    pub(crate) fn new(asked: &SpatialArm, free: [bool; 6]) -> Self {
        let arm = (0..6).fold(asked.clone(), |arm, joint| arm.without_limit_on(joint, free[joint]));
        let turns = TURNED_BY_ZONE.map(|joint| asked.limits.joints[joint].width());
        let ranges = TURNED_BY_ZONE.map(|joint| arm.geometry.theta(joint, arm.limits.joints[joint]));
        let tool_from_flange = arm.flange_from_tool.rotation.inverse();
        let point = arm.flange_from_tool.translation.vector + Vector3::z() * arm.geometry.c4;
        let seen = |v: Vector3<f64>| (tool_from_flange * v).into();
        let (wrist_to_tool, axis_6, flange_x) = (seen(point), seen(Vector3::z()), seen(Vector3::x()));
        let distance_rings = [1.0, -1.0].map(|sign| distance_ring(&arm, sign));
        Self { arm, load: Load::UNIT, wrist_to_tool, axis_6, flange_x, distance_rings, turns, ranges }
    }

    /// The same arm under a load, instead of one in its worst direction.
    #[must_use]
    pub(crate) fn under(self, load: Load) -> Self {
        Self { load, ..self }
    }

    /// How far the wrist centre lies from the axis of the tool, m.
    pub(crate) fn beside_the_tool_axis(&self) -> f64 {
        self.wrist_to_tool[0].hypot(self.wrist_to_tool[1])
    }

    /// The work plane and the tool at the placements of a node.
    pub(crate) fn tool_frame<const N: usize>(&self, elevation: f64, node: &Node) -> ToolFrameEnclosure<N> {
        let plane = WorkPlaneEnclosure::of(elevation, node);
        let [wrist_to_tool, axis_6, flange_x] =
            [self.wrist_to_tool, self.axis_6, self.flange_x].map(|v| plane.carried(v));
        ToolFrameEnclosure { plane, wrist_to_tool, axis_6, flange_x, push: None }
    }

    /// The tool with its tip at a point and along these axes, under what pushes on it; base axes.
    pub(crate) fn tool_at<const N: usize>(
        &self,
        point: Vector<N>,
        tool: [Vector<N>; 3],
        push: Option<PushEnclosure<N>>,
    ) -> ToolFrameEnclosure<N> {
        let plane = WorkPlaneEnclosure::of_tool(point, tool);
        let [wrist_to_tool, axis_6, flange_x] =
            [self.wrist_to_tool, self.axis_6, self.flange_x].map(|v| plane.carried(v));
        ToolFrameEnclosure { plane, wrist_to_tool, axis_6, flange_x, push }
    }

    /// Squared distance, m^2, of the wrist centre from the joint-2 axis, the tool at a point of the work plane.
    pub(crate) fn distance(&self, plane: &WorkPlane, point: &Vector3<f64>, branch: ArmBranch) -> f64 {
        let geometry = &self.arm.geometry;
        let wrist = point - plane.tool() * Vector3::from(self.wrist_to_tool);
        let ahead = (wrist.xy().norm_squared() - geometry.b * geometry.b).max(0.0).sqrt();
        let forwards = if branch.shoulder == Shoulder::Back { -ahead } else { ahead };
        (forwards - geometry.a1).powi(2) + (wrist.z - geometry.c1).powi(2)
    }
}

/// The squared distances at which the limits allow the angle between the links, elbow up (`sign` 1) or down (-1).
pub(super) fn distance_ring(arm: &SpatialArm, sign: f64) -> Option<Interval> {
    let Limits { elbow, third_axis, joints, .. } = &arm.limits;
    let (l2, l3, lean) = (arm.geometry.c2, arm.geometry.l3(), arm.geometry.lean());
    // The elbow's angle from a stretched arm, 0 to pi, is theta3 + lean, or its negative.
    let bends = |theta_3: Interval| bends(theta_3.affine(sign, sign * lean));
    let mut allowed =
        bends(elbow.affine(-1.0, PI))?.intersect(Interval::new(arm.proof_clearance(), PI - arm.proof_clearance())?)?;
    if *third_axis == ThirdAxis::Elbow {
        allowed = allowed.intersect(bends(arm.geometry.theta(2, joints[2]))?)?;
    }
    let square = |axis_5: f64| l2 * l2 + l3 * l3 + 2.0 * l2 * l3 * axis_5.cos();
    let hair = 1e-11 * (l2 + l3) * (l2 + l3);
    Some(Interval::spanning((square(allowed.max()) - hair).max(0.0), square(allowed.min()) + hair))
}

/// The smallest range that holds what a range of angles shares with `0..pi`, up to whole turns.
fn bends(angles: Interval) -> Option<Interval> {
    let all = Interval::spanning(0.0, PI);
    if !angles.is_bounded() || TAU <= angles.width() {
        return Some(all);
    }
    let wide = Interval::spanning(angles.min() - tolerances::PROOF, angles.max() + tolerances::PROOF);
    let first = (-wide.max() / TAU).ceil();
    [0.0, 1.0, 2.0]
        .into_iter()
        .filter_map(|turn| wide.affine(1.0, (first + turn) * TAU).intersect(all))
        .reduce(|a, b| Interval::spanning(a.min().min(b.min()), a.max().max(b.max())))
}
