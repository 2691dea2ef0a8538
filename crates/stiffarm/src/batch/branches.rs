//! Which configurations hold a pose within the limits, and how compliant is each? Inverse kinematics in registers.

use pulp::Simd;

use super::counted::Counted;
use super::lanes::{Lanes, Mask};
use super::posture::PostureLanes;
use super::vectors::Triple;
use super::{Coupling, SameBranch, SpatialArm};
use crate::inverse::{ArmBranch, Configuration, ELBOWS, Shoulder, Wrist};
use crate::tolerances::{RIM, SINGULAR, SINGULAR_SQUARE};

/// Takes what it needs of the configurations of poses, one pose a lane.
pub(super) trait Collector<S: Simd> {
    /// What all postures of one shoulder share.
    type Seen: Copy;

    /// Joint 1 is turned by the angle of sine `s1` and cosine `c1`.
    fn seen(&self, s1: Lanes<S>, c1: Lanes<S>) -> Self::Seen;

    /// Both wrists of one shoulder and elbow.
    fn take(&mut self, arm: &SpatialArm, seen: &Self::Seen, branch: ArmBranch, held: &HeldLanes<S>);
}

/// Both wrists of one shoulder and elbow, in the axes of the arm.
pub(super) struct HeldLanes<S: Simd> {
    /// Sine and cosine of the upper arm's lean, theta 2, and of the forearm's.
    pub(super) upper: [Lanes<S>; 2],
    pub(super) forearm: [Lanes<S>; 2],
    pub(super) axis_6: Triple<S>,
    pub(super) wrist_to_tool: Triple<S>,
    /// Axis 6 seen from the forearm: forwards, across, along. The first two are in the direction of theta 4, as long as the sine of theta 5.
    pub(super) bent: [Lanes<S>; 3],
    /// The sine of theta 5 of the wrist that is not flipped.
    pub(super) s5: Lanes<S>,
    /// Cosine and sine of theta 6 of that wrist, times the sine of theta 5.
    pub(super) sixth: [Lanes<S>; 2],
    /// Joints 4 and 6 turn about one line.
    pub(super) is_singular: Mask<S>,
    /// Of either wrist: negative where a limit or a length forbids the posture.
    pub(super) slacks: [Lanes<S>; 2],
    /// The same for lengths and joints 2 and 3 alone.
    pub(super) links: Lanes<S>,
}

/// One configuration at every pose, one pose a lane.
#[derive(Clone, Copy)]
pub(super) struct BranchLanes<S: Simd> {
    /// What counts of the translation per force, m/N, whatever the limits; NaN where nothing holds joint 2.
    pub(super) worst: Lanes<S>,
    /// Negative where a limit or a length forbids the posture.
    pub(super) slack: Lanes<S>,
    /// The same for lengths and joints 2 and 3 alone.
    pub(super) links: Lanes<S>,
    /// Axis 6 forwards of the forearm and across it: a vector in the direction of theta 4, as long as the sine of theta 5.
    pub(super) bent: [Lanes<S>; 2],
}

/// How compliant every configuration is.
struct Compliances<S: Simd, C> {
    counted: C,
    found: [BranchLanes<S>; Configuration::COUNT],
}

impl<S: Simd, C: Counted> Collector<S> for Compliances<S, C> {
    type Seen = C::Seen<S>;

    #[inline(always)]
    fn seen(&self, s1: Lanes<S>, c1: Lanes<S>) -> C::Seen<S> {
        self.counted.seen(s1, c1)
    }

    #[inline(always)]
    fn take(&mut self, arm: &SpatialArm, seen: &C::Seen<S>, branch: ArmBranch, held: &HeldLanes<S>) {
        let ([s2, c2], [s23, c23], [forwards, across, _]) = (held.upper, held.forearm, held.bent);
        let inverse = s2.all(1.0) / held.s5.max(SINGULAR);
        let (axis_5_x, axis_5_y) = (-across * inverse, held.is_singular.select(s2.all(1.0), forwards * inverse));
        let axis_5 = Triple([c23 * axis_5_x, axis_5_y, -(s23 * axis_5_x)]);
        let (axis_6, wrist_to_tool) = (held.axis_6, held.wrist_to_tool);
        let posture = PostureLanes { s2, c2, s23, c23, axis_5, axis_6, wrist_to_tool };
        let worst = self.counted.of(seen, arm, &posture);
        let flipped = match arm.coupling {
            // The other wrist turns joint 5 the other way, which a drive of its own does not feel.
            Coupling::Serial | Coupling::QuasiSerial => worst,
            Coupling::Any(_) => self.counted.of(seen, arm, &PostureLanes { axis_5: axis_5 * -1.0, ..posture }),
        };
        let worst = [worst, flipped];
        for wrist in 0..2 {
            let index = branch.with(Wrist::ALL[wrist]).index();
            let (slack, links) = (held.slacks[wrist], held.links);
            self.found[index] = BranchLanes { worst: worst[wrist], slack, links, bent: [forwards, across] };
        }
    }
}

/// The slack of what was not looked at, as no lane allows it.
const FORBIDDEN: f64 = -1.0;

/// Some lane is worth going on with.
#[inline(always)]
fn goes_on<S: Simd, const ALL: bool>(slack: Lanes<S>) -> bool {
    ALL || slack.at_least(0.0).any()
}

impl<S: Simd> BranchLanes<S> {
    /// The largest translation per force; infinite where the posture is forbidden or nothing holds joint 2.
    #[inline(always)]
    fn allowed(self) -> Lanes<S> {
        let is_held = self.worst.at_least(0.0);
        (self.slack.at_least(0.0) & is_held).select(self.worst, self.worst.all(f64::INFINITY))
    }
}

impl SpatialArm {
    /// What counts of the translation per force, m/N, of every configuration of a pose, at its index; infinite where the posture is
    /// forbidden or nothing holds joint 2.
    #[inline(always)]
    pub(super) fn allowed<S: Simd, C: Counted>(
        &self,
        flange: &FlangePoses<S>,
        same_branch: &SameBranch,
        counted: C,
    ) -> [Lanes<S>; Configuration::COUNT] {
        let branches = self.configurations::<S, C, false>(flange, same_branch, counted);
        let mut found = [branches[0].worst; Configuration::COUNT];
        for index in 0..Configuration::COUNT {
            found[index] = branches[index].allowed();
        }
        found
    }

    /// Every configuration of a pose, at its index. Unless `ALL`, what is forbidden in every lane is left as soon as that is known, and only its slack
    /// is given.
    #[inline(always)]
    pub(super) fn configurations<S: Simd, C: Counted, const ALL: bool>(
        &self,
        flange: &FlangePoses<S>,
        same_branch: &SameBranch,
        counted: C,
    ) -> [BranchLanes<S>; Configuration::COUNT] {
        let (one, forbidden) = (flange.point.0[0].all(1.0), flange.point.0[0].all(FORBIDDEN));
        let none = BranchLanes { worst: one, slack: forbidden, links: forbidden, bent: [one; 2] };
        let mut collector = Compliances { counted, found: [none; Configuration::COUNT] };
        self.branches::<S, _, ALL>(flange, same_branch, &mut collector);
        collector.found
    }

    /// Hands every configuration of a pose to a collector. Unless `ALL`, what is forbidden in every lane is left as soon as that is known.
    #[inline(always)]
    pub(super) fn branches<S: Simd, T: Collector<S>, const ALL: bool>(
        &self,
        flange: &FlangePoses<S>,
        same_branch: &SameBranch,
        collector: &mut T,
    ) {
        let (px, py, pz) = flange.point.parts();
        let (ux, uy, uz) = flange.wrist_to_tool.parts();
        let (wx, wy, wz) = (px - ux, py - uy, pz - uz);
        let b = self.geometry.b;
        let square = wx * wx + wy * wy;
        let across = square - b * b;
        let ahead = across.max(0.0).sqrt();
        let reached = across + SINGULAR * self.geometry.c2 * self.geometry.c2;
        let reached = (square - (same_branch.beside_axis_1 * self.geometry.c2).powi(2)).or_less(reached);
        // Above its own axis joint 1 is free: straight ahead stands for all.
        let free = square.at_most(SINGULAR_SQUARE * self.geometry.c2 * self.geometry.c2);
        let inverse = free.select(px.all(0.0), px.all(1.0) / square);
        let one = px.all(1.0);
        for shoulder in 0..2 {
            let forwards = [ahead, -ahead][shoulder];
            let c1 = free.select(one, (wx * forwards + wy * b) * inverse);
            let s1 = free.select(px.all(0.0), (wy * forwards - wx * b) * inverse);
            let turned = self.angular_limits.joints[0]
                .slack(c1, s1, one)
                .or_less(same_branch.first[shoulder].slack(c1, s1, one));
            if !goes_on::<S, ALL>(turned.or_less(reached)) {
                continue;
            }
            let seen = FlangeInArmAxes {
                axis_6: flange.axis_6.seen_turned(s1, c1),
                flange_x: flange.flange_x.seen_turned(s1, c1),
                wrist_to_tool: flange.wrist_to_tool.seen_turned(s1, c1),
                x: forwards - self.geometry.a1,
                z: wz - self.geometry.c1,
                seen: collector.seen(s1, c1),
            };
            self.elbows::<S, T, ALL>(&seen, [reached, turned], same_branch, Shoulder::ALL[shoulder], collector);
        }
    }

    /// Elbow up and down, each with both wrists, of one shoulder.
    #[inline(always)]
    fn elbows<S: Simd, T: Collector<S>, const ALL: bool>(
        &self,
        seen: &FlangeInArmAxes<S, T::Seen>,
        [reached, turned]: [Lanes<S>; 2],
        same_branch: &SameBranch,
        shoulder: Shoulder,
        collector: &mut T,
    ) {
        let (l2, l3) = (self.geometry.c2, self.geometry.l3());
        let (lean_c, lean_s) = (self.geometry.c3 / l3, self.geometry.a2 / l3);
        let (x, z) = (seen.x, seen.z);
        let square = x * x + z * z;
        let c = (square - (l2 * l2 + l3 * l3)) * (1.0 / (2.0 * l2 * l3));
        let straight = if same_branch.clearance == 0.0 { 1.0 + RIM } else { same_branch.clearance.cos() };
        let reached = (c.all(straight) - c).or_less(c + straight).or_less(reached);
        let reached = (square - SINGULAR_SQUARE * l2 * l2).or_less(reached);
        let c = c.max(-1.0).min(1.0);
        let s = (c.all(1.0) - c * c).max(0.0).sqrt();
        let inverse = c.all(1.0) / square.max(SINGULAR_SQUARE * l2 * l2);
        let one = c.all(1.0);
        let along = c * l3 + l2;
        for elbow in 0..2 {
            let s = [s, -s][elbow];
            let aside = s * l3;
            let (s2, c2) = ((x * along - z * aside) * inverse, (z * along + x * aside) * inverse);
            let (s3, c3) = (s * lean_c - c * lean_s, c * lean_c + s * lean_s);
            let (s23, c23) = (s2 * c3 + c2 * s3, c2 * c3 - s2 * s3);
            let [_, second, third, ..] = self.angular_limits.joints;
            let forearm = self.angular_limits.third_is_forearm;
            let third_allowed = match &self.angular_limits.multi_turn {
                Some(multi_turn) => multi_turn.slack(if forearm { [s2, c2] } else { [one.all(0.0), one] }, [s3, c3]),
                None if forearm => third.slack(c23, s23, one),
                None => third.slack(c3, s3, one),
            };
            let links = third_allowed.or_less(self.angular_limits.elbow.slack(c3, s3, one));
            let links = second.slack(c2, s2, one).or_less(links).or_less(reached);
            if !goes_on::<S, ALL>(links.or_less(turned)) {
                continue;
            }
            let arm = ArmBranch { shoulder, elbow: ELBOWS[elbow] };
            self.wrists::<S, T, ALL>(seen, [s2, c2, s23, c23], [links, turned], same_branch, arm, collector);
        }
    }

    /// Both wrists of one shoulder and elbow.
    #[inline(always)]
    fn wrists<S: Simd, T: Collector<S>, const ALL: bool>(
        &self,
        seen: &FlangeInArmAxes<S, T::Seen>,
        [s2, c2, s23, c23]: [Lanes<S>; 4],
        [links, turned]: [Lanes<S>; 2],
        same_branch: &SameBranch,
        arm: ArmBranch,
        collector: &mut T,
    ) {
        let zero = s2.all(0.0);
        let along = Triple([s23, zero, c23]);
        let (axis_6_x, axis_6_y, axis_6_z) = seen.axis_6.parts();
        // The axis of joint 6 seen from the forearm: forwards, across, along.
        let (forwards, across, c5) = (c23 * axis_6_x - s23 * axis_6_z, axis_6_y, s23 * axis_6_x + c23 * axis_6_z);
        let s5 = (forwards * forwards + across * across).sqrt();
        let singular = s5.at_most(SINGULAR);
        let (cos_6, sin_6) = (-along.dot(seen.flange_x), along.dot(seen.axis_6.cross(seen.flange_x)));
        let [.., fourth, fifth, sixth] = self.angular_limits.joints;
        let straight = same_branch.clearance.sin();
        let any_split = s2.all(if self.angular_limits.any_wrist_split { 1.0 } else { -1.0 });
        let mut slacks = [s5; 2];
        for wrist in 0..2 {
            let index = arm.with(Wrist::ALL[wrist]).index();
            let sign = [1.0, -1.0][wrist];
            let (turn_4, turn_6) = ([forwards * sign, across * sign], [cos_6 * sign, sin_6 * sign]);
            let turns = fourth.slack(turn_4[0], turn_4[1], s5).or_less(sixth.slack(turn_6[0], turn_6[1], s5));
            let turns = singular.select(any_split, turns);
            let turns = same_branch.fourth[index].slack(turn_4[0], turn_4[1], s5).or_less(turns);
            let turns = same_branch.sixth[index].slack(turn_6[0], turn_6[1], s5).or_less(turns);
            let bent = fifth.slack(c5, s5 * sign, s2.all(1.0));
            let bent = (s5 - straight).or_less(bent);
            slacks[wrist] = turns.or_less(bent).or_less(turned).or_less(links);
        }
        if !goes_on::<S, ALL>(slacks[0]) && !goes_on::<S, ALL>(slacks[1]) {
            return;
        }
        let (axis_6, wrist_to_tool) = (seen.axis_6, seen.wrist_to_tool);
        let held = HeldLanes {
            upper: [s2, c2],
            forearm: [s23, c23],
            axis_6,
            wrist_to_tool,
            bent: [forwards, across, c5],
            s5,
            sixth: [cos_6, sin_6],
            is_singular: singular,
            slacks,
            links,
        };
        collector.take(self, &seen.seen, arm, &held);
    }
}

/// Poses of the flange, base axes.
pub(super) struct FlangePoses<S: Simd> {
    /// The tool point.
    pub(super) point: Triple<S>,
    /// Axis of joint 6, the flange's z.
    pub(super) axis_6: Triple<S>,
    /// The flange's x.
    pub(super) flange_x: Triple<S>,
    /// From the wrist centre to the tool point.
    pub(super) wrist_to_tool: Triple<S>,
}

/// The same in the axes of the arm, joint 1 turned; the wrist centre `x` forwards and `z` above the joint-2 axis.
struct FlangeInArmAxes<S: Simd, T> {
    pub(super) axis_6: Triple<S>,
    pub(super) flange_x: Triple<S>,
    pub(super) wrist_to_tool: Triple<S>,
    x: Lanes<S>,
    z: Lanes<S>,
    /// What a collector needs once of all postures of this shoulder.
    seen: T,
}
