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
        let turns = |joint: usize| {
            1 + usize::from(
                postures.iter().any(|(_, theta)| self.within_a_quarter_turn(joint, theta[joint]).1.is_some()),
            )
        };
        let mut cases = Vec::new();
        for (fourth, sixth) in (0..turns(3)).flat_map(|fourth| (0..turns(5)).map(move |sixth| (fourth, sixth))) {
            let mut same_branch = SameBranch {
                clearance: self.clearance + self.reserve,
                beside_axis_1: CLEARANCE + self.reserve,
                ..SameBranch::default()
            };
            for (configuration, theta) in &postures {
                let index = configuration.index();
                let about = |joint: usize, turn: usize| {
                    let (roomiest, other) = self.within_a_quarter_turn(joint, theta[joint]);
                    if turn == 0 { roomiest } else { other.unwrap_or(roomiest) }
                };
                same_branch.first[configuration.shoulder as usize] = about(0, 0);
                same_branch.fourth[index] = about(3, fourth);
                same_branch.sixth[index] = about(5, sixth);
            }
            cases.push(same_branch);
        }
        cases
    }

    /// The model angles within a quarter turn of `theta` that the joint reaches from there without leaving its range: first with
    /// the number of whole turns that leaves most room to both ends; second with the next number, where the range allows
    /// that too and it makes a difference.
    fn within_a_quarter_turn(&self, joint: usize, theta: f64) -> (AngularInterval, Option<AngularInterval>) {
        let range = self.geometry.theta(joint, self.limits.joints[joint]);
        let most = FRAC_PI_2 - self.reserve;
        let quarter = Interval::spanning(theta - most, theta + most);
        if !range.is_bounded() {
            return (AngularInterval::of(quarter), None);
        }
        let room = |turned: f64| range.affine(1.0, theta - turned).intersect(quarter).unwrap_or(quarter);
        let roomiest = theta + ((range.middle() - theta) / TAU).round() * TAU;
        let other = if roomiest < range.middle() { roomiest + TAU } else { roomiest - TAU };
        let has_other = range.contains(other, 0.0) && room(roomiest) != quarter;
        (AngularInterval::of(room(roomiest)), has_other.then(|| AngularInterval::of(room(other))))
    }
}
