//! Where do the joints point, at all poses of a node at once?
//!
//! The formulas are those of `batch::branches`, one after the other, with affine forms in place of registers.

use std::f64::consts::{PI, TAU};

use super::affine::{Affine, Vector};

use super::bounds::NodeBounds;
use super::prepared::{ArmEnclosure, PushEnclosure, ToolFrameEnclosure};
use crate::interval::Interval;
use crate::inverse::{ArmBranch, Shoulder};
use crate::limits::{Limits, ThirdAxis};
use crate::plane::Elbow;
use crate::real::{cross, dot, seen_turned};
use crate::tolerances;

/// A vector in the arm plane: forwards, up.
pub(super) type PlaneVector<const N: usize> = [Affine<N>; 2];

/// A pose of the tool in the axes of the arm, joint 1 turned: x forwards in the arm plane, y across, z up.
pub(super) struct ArmView<const N: usize> {
    /// The tool point, base axes.
    pub(super) point: Vector<N>,
    /// From the joint-2 axis to the wrist centre: forwards, up.
    pub(super) wrist: PlaneVector<N>,
    /// Cosine and sine of theta 1.
    pub(super) first: [Affine<N>; 2],
    pub(super) axis_6: Vector<N>,
    pub(super) flange_x: Vector<N>,
    pub(super) wrist_to_tool: Vector<N>,
    /// The axes of the work; see [`WorkPlaneEnclosure::work`](super::node::WorkPlaneEnclosure::work). Under a force in its worst
    /// direction nobody asks for them.
    pub(super) work: Option<[Vector<N>; 3]>,
    /// What pushes, where all of it is known.
    pub(super) push: Option<PushEnclosure<N>>,
}

/// Directions of the links, unit vectors in the arm plane: sine and cosine of the angle from upright.
pub(super) struct Links<const N: usize> {
    pub(super) upper: PlaneVector<N>,
    pub(super) forearm: PlaneVector<N>,
}

impl ArmEnclosure {
    /// The pose at a point of the zone, joint 1 turned towards the wrist centre or away from it; `None` where the wrist centre is too
    /// near to the joint-1 axis for certain.
    pub(super) fn view<const N: usize>(
        &self,
        tool_frame: &ToolFrameEnclosure<N>,
        at: [f64; 2],
        branch: ArmBranch,
    ) -> Option<ArmView<N>> {
        let geometry = &self.arm.geometry;
        let point = tool_frame.plane.point(at);
        let work = (!self.load.is_worst()).then(|| tool_frame.plane.work());
        let [wx, wy, wz]: Vector<N> = std::array::from_fn(|i| point[i] - tool_frame.wrist_to_tool[i]);
        let square = wx.square() + wy.square();
        let b2 = geometry.b * geometry.b;
        let least = b2.max((tolerances::PROOF_CLEARANCE * geometry.c2).powi(2));
        if square.max() < least - tolerances::PROOF * geometry.c2 * geometry.c2 {
            return None;
        }
        let sign = if branch.shoulder == Shoulder::Back { -1.0 } else { 1.0 };
        let wrist = [(square + -b2).sqrt()? * sign + -geometry.a1, wz + -geometry.c1];
        if !(least < square.min()) {
            // It may lie on the axis, and joint 1 face anywhere: only heights and lengths are known.
            let any = |length: f64| Affine { remainder: length, ..Affine::point(0.0) };
            let most = |x: Affine<N>| x.min().abs().max(x.max().abs());
            let seen = |[x, y, z]: Vector<N>| [any(most(x).hypot(most(y))), any(most(x).hypot(most(y))), z];
            let (axis_6, flange_x, wrist_to_tool) =
                (seen(tool_frame.axis_6), seen(tool_frame.flange_x), seen(tool_frame.wrist_to_tool));
            let work = work.map(|axes| axes.map(|axis| seen(axis).map(unit)));
            let push = tool_frame.push.map(|push| push.map(seen));
            return Some(ArmView { point, wrist, first: [any(1.0); 2], axis_6, flange_x, wrist_to_tool, work, push });
        }
        let inverse = square.inverse(Interval::spanning(least, f64::INFINITY))?;
        // sqrt(square - b^2)/square, concave in 1/square.
        let part = inverse.concave(Interval::spanning(0.0, 1.0 / least), |i| {
            let root = (i - b2 * i * i).max(0.0).sqrt();
            (root, (0.5 - b2 * i) / root)
        })?;
        let (part, aside) = (part * sign, inverse * geometry.b);
        let (c1, s1) = (unit(wx * part + wy * aside), unit(wy * part - wx * aside));
        let [axis_6, flange_x, wrist_to_tool] =
            [tool_frame.axis_6, tool_frame.flange_x, tool_frame.wrist_to_tool].map(|v| seen_turned(v, s1, c1));
        let work = work.map(|axes| axes.map(|axis| seen_turned(axis, s1, c1).map(unit)));
        let push = tool_frame.push.map(|push| push.map(|v| seen_turned(v, s1, c1)));
        Some(ArmView { point, wrist, first: [c1, s1], axis_6, flange_x, wrist_to_tool, work, push })
    }

    /// The links that put the wrist centre at `[x, z]`. `None` where they cannot; inner `None` where they could point anywhere.
    pub(super) fn links<const N: usize>(
        &self,
        [x, z]: &PlaneVector<N>,
        branch: ArmBranch,
        bounds: &mut NodeBounds<N>,
    ) -> Option<Option<Links<N>>> {
        let (l2, l3) = (self.arm.geometry.c2, self.arm.geometry.l3());
        let ring = self.distance_rings[usize::from(branch.elbow == Elbow::Down)]?;
        let square = x.square() + z.square();
        bounds.require((square + -ring.min()) * (1.0 / (l2 * l2)))?;
        bounds.require((-square + ring.max()) * (1.0 / (l2 * l2)))?;
        // Not zero even with links of one length: a folded arm is not allowed.
        let least = ring.min();
        let Some(inverse) = square.inverse(Interval::new(least, ring.max())?) else { return Some(None) };
        // The upper arm is a part `along` of the wrist vector, and a part `aside` of that turned by a right angle: the height
        // of a triangle with known sides, whose square is quadratic in 1/square.
        let kappa = (l2 * l2 - l3 * l3) / 2.0;
        let along = inverse * kappa + 0.5;
        let aside = inverse.concave(Interval::spanning(1.0 / ring.max(), 1.0 / least), |i| {
            let height = (l2 * l2 * i - (0.5 + kappa * i).powi(2)).max(0.0).sqrt();
            (height, (0.5 * l2 * l2 - kappa * (0.5 + kappa * i)) / height)
        });
        let Some(aside) = aside else { return Some(None) };
        let aside = if branch.elbow == Elbow::Down { -aside } else { aside };
        let elbow = [*x * along - *z * aside, *z * along + *x * aside];
        let [gx, gz] = [*x - elbow[0], *z - elbow[1]];
        let (c3, a2) = (self.arm.geometry.c3 / (l3 * l3), self.arm.geometry.a2 / (l3 * l3));
        Some(Some(Links {
            upper: elbow.map(|part| unit(part * (1.0 / l2))),
            forearm: [unit(gx * c3 - gz * a2), unit(gz * c3 + gx * a2)],
        }))
    }

    /// `None` where no choice of whole turns brings theta 2, the angle between the links and what joint 3 reports within their limits
    /// together. Takes cosine and sine of theta 2 and theta 3.
    pub(super) fn check_third<const N: usize>(&self, [c2, s2]: [Affine<N>; 2], [c3, s3]: [Affine<N>; 2]) -> Option<()> {
        let Limits { joints, elbow, third_axis, .. } = &self.arm.limits;
        let geometry = &self.arm.geometry;
        let (Some(second), Some(third)) = (angle(c2, s2), angle(c3, s3)) else { return Some(()) };
        let seconds = match third_axis {
            ThirdAxis::Elbow => vec![Interval::point(0.0)],
            ThirdAxis::Forearm => turned_into(geometry.theta(1, joints[1]), second).collect(),
        };
        let reported = geometry.theta(2, joints[2]);
        let allowed = Interval::spanning(reported.min() - tolerances::PROOF, reported.max() + tolerances::PROOF);
        turned_into(elbow.affine(-1.0, PI), third)
            .any(|third| seconds.iter().any(|second| allowed.intersect(second.plus(third)).is_some()))
            .then_some(())
    }
}

/// For a wrist that is not flipped: cosine and sine of theta 4 and of theta 6, each times the sine of theta 5; and the cosine of
/// theta 5.
pub(super) fn seen_from_forearm<const N: usize>(
    view: &ArmView<N>,
    links: &Links<N>,
) -> ([Affine<N>; 2], [Affine<N>; 2], Affine<N>) {
    let [s23, c23] = links.forearm;
    // The axis of joint 6 seen from the forearm: forwards, across, along.
    let [axis_6_x, across, axis_6_z] = view.axis_6.map(unit);
    let (forwards, c5) = (unit(c23 * axis_6_x - s23 * axis_6_z), unit(s23 * axis_6_x + c23 * axis_6_z));
    let along = [s23, Affine::point(0.0), c23];
    let sixth = [-dot(along, view.flange_x), dot(along, cross(view.axis_6, view.flange_x))].map(unit);
    ([forwards, across], sixth, c5)
}

/// The same number, known to be a component of a unit vector.
pub(super) fn unit<const N: usize>(x: Affine<N>) -> Affine<N> {
    x.clipped(Interval::spanning(-1.0, 1.0))
}

/// The angles of vectors with these cosines and sines, up to a common length; `None` where they point more than a quarter
/// turn apart.
pub(super) fn angle<const N: usize>(cos: Affine<N>, sin: Affine<N>) -> Option<Interval> {
    let (from_s, from_c) = (sin.centre, cos.centre);
    let length = from_s.hypot(from_c);
    if !(0.0 < length) {
        return None;
    }
    let (s, c) = (from_s / length, from_c / length);
    let (ahead, aside) = (cos * c + sin * s, sin * c - cos * s);
    if !(0.0 < ahead.min()) {
        return None;
    }
    let turned = |aside: f64| (aside / if aside < 0.0 { ahead.min() } else { ahead.max() }).atan();
    let (low, high) = (turned(aside.min()), -turned(-aside.max()));
    Interval::new(low, high).map(|range| range.affine(1.0, s.atan2(c)))
}

/// The angles with all whole turns added with which some of them lie in the range; as they are where it has no ends.
pub(super) fn turned_into(range: Interval, angles: Interval) -> impl Iterator<Item = Interval> {
    let wide = Interval::spanning(range.min() - tolerances::PROOF, range.max() + tolerances::PROOF);
    let (first, turns) = if wide.is_bounded() {
        (((wide.min() - angles.max()) / TAU).ceil(), (wide.width() / TAU) as usize + 2)
    } else {
        (0.0, 1)
    };
    (0..turns)
        .map(move |turn| angles.affine(1.0, (first + turn as f64) * TAU))
        .filter(move |turned| wide.intersect(*turned).is_some())
}
