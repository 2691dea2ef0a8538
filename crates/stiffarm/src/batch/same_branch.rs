//! Which postures does an arm reach from another without leaving its branch?

use std::f64::consts::{FRAC_PI_2, TAU};

use super::{AngularInterval, SpatialArm};
use crate::interval::Interval;
use crate::inverse::{Configuration, Shoulder, postures};
use crate::spatial::Pose;
use crate::tolerances::CLEARANCE;

/// Which postures lie on the same branch as one at the centre of a zone: intervals of theta 1 by shoulder, of theta 4 and 6 by
/// configuration, and the distance from singular postures. By default every posture does. See [`SpatialArm::same_branches`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SameBranch {
    pub(super) first: [AngularInterval; Shoulder::ALL.len()],
    pub(super) fourth: [AngularInterval; Configuration::COUNT],
    pub(super) sixth: [AngularInterval; Configuration::COUNT],
    /// Least angle of joint 5 and of the elbow to a straight wrist or arm, rad, below a quarter turn.
    pub(super) clearance: f64,
    /// Least distance of the wrist centre from the joint-1 axis, as part of the upper arm; see [`CLEARANCE`].
    pub(super) beside_axis_1: f64,
}

impl SpatialArm {
    /// The postures within a quarter turn, joint by joint, of those at a pose of the tool (base axes), and clear of singular ones
    /// by the arm's margin, at least [`CLEARANCE`].
    ///
    /// Joints 2, 3 and 5 of one configuration never span more; joints 1, 4 and 6 turn fast near singular postures and by half a
    /// turn across them. Where the range of joint 4 or 6 is wider than a turn and the angle fits near both ends, each choice
    /// is an answer of its own.
    pub(crate) fn same_branches(&self, tool: &Pose) -> Vec<SameBranch> {
        let postures = postures(&self.geometry, &(tool * self.flange_from_tool.inverse())).found;
        // Of every joint the angles at each posture, by whole turns where there are two choices.
        let about = |joint: usize| {
            let ranges: Vec<_> =
                postures.iter().map(|(_, theta)| self.within_a_quarter_turn(joint, theta[joint])).collect();
            let roomiest: Vec<_> = ranges.iter().map(|(range, _)| AngularInterval::of(*range)).collect();
            let has_other = ranges.iter().any(|(_, other)| other.is_some());
            let other = has_other.then(|| {
                let each = ranges.iter().zip(&roomiest);
                each.map(|((_, other), roomiest)| other.map_or(*roomiest, AngularInterval::of)).collect()
            });
            [Some(roomiest), other].into_iter().flatten().collect::<Vec<Vec<AngularInterval>>>()
        };
        let [first, fourths, sixths] = [0, 3, 5].map(about);
        let mut cases = Vec::new();
        for (fourth, sixth) in fourths.iter().flat_map(|fourth| sixths.iter().map(move |sixth| (fourth, sixth))) {
            let mut same_branch = SameBranch {
                clearance: self.clearance + self.reserve,
                beside_axis_1: CLEARANCE + self.reserve,
                ..SameBranch::default()
            };
            for (i, (configuration, _)) in postures.iter().enumerate() {
                same_branch.first[configuration.shoulder as usize] = first[0][i];
                same_branch.fourth[configuration.index()] = fourth[i];
                same_branch.sixth[configuration.index()] = sixth[i];
            }
            cases.push(same_branch);
        }
        cases
    }

    /// The model angles within a quarter turn of `theta` that the joint reaches from there without leaving its range: first with
    /// the number of whole turns that leaves most room to both ends; second with the next number, where the range allows
    /// that too and it makes a difference.
    fn within_a_quarter_turn(&self, joint: usize, theta: f64) -> (Interval, Option<Interval>) {
        let range = self.geometry.theta(joint, self.limits.joints[joint]);
        let most = FRAC_PI_2 - self.reserve;
        let quarter = Interval::spanning(theta - most, theta + most);
        if !range.is_bounded() {
            return (quarter, None);
        }
        let room = |turned: f64| range.affine(1.0, theta - turned).intersect(quarter).unwrap_or(quarter);
        let roomiest = theta + ((range.middle() - theta) / TAU).round() * TAU;
        let other = if roomiest < range.middle() { roomiest + TAU } else { roomiest - TAU };
        let has_other = range.contains(other, 0.0) && room(roomiest) != quarter;
        (room(roomiest), has_other.then(|| room(other)))
    }
}
