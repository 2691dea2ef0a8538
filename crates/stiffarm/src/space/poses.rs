//! Many poses of the tool: every posture that reaches them within the limits, and how far each gives way.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Matrix3, Vector3};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::lanes::Lanes;
use super::sector::Sector;
use super::{At, Coupling, SpatialArm, Triple};
use crate::interval::Interval;
use crate::inverse::{CLEARANCE, Configuration, Shoulder, Wrist, postures};
use crate::plane::Elbow;
use crate::spatial::Pose;

/// Postures that may reach one pose.
pub const CLASSES: usize = 8;
/// Poses that one thread takes at a time.
const BLOCK: usize = 1024;
/// More numbers than any register holds.
const WIDEST: usize = 8;

/// The class at a place of the answers of this module: shoulder, then elbow, then wrist.
pub fn class(place: usize) -> Configuration {
    Configuration {
        shoulder: if place & 4 == 0 { Shoulder::Front } else { Shoulder::Back },
        elbow: if place & 2 == 0 { Elbow::Up } else { Elbow::Down },
        wrist: if place & 1 == 0 { Wrist::NoFlip } else { Wrist::Flip },
    }
}

/// The stiffest way to hold a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Best {
    /// The largest translation per force in any direction, m/N.
    pub worst: f64,
    /// The posture.
    pub configuration: Configuration,
}

/// The place of a class.
fn place(class: Configuration) -> usize {
    4 * usize::from(class.shoulder == Shoulder::Back)
        + 2 * usize::from(class.elbow == Elbow::Down)
        + usize::from(class.wrist == Wrist::Flip)
}

/// Where joints 1, 4 and 6 must stay, and how clear of singular postures all; anywhere by default. See [`SpatialArm::near`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Near {
    first: [Sector; 2],
    fourth: [Sector; CLASSES],
    sixth: [Sector; CLASSES],
    /// See [`CLEARANCE`]; zero by default.
    clearance: f64,
}

/// What the poses of one orientation of the tool share.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Orientation {
    spin: Vector3<f64>,
    side: Vector3<f64>,
    beyond: Vector3<f64>,
}

/// The poses of a tool that turns about its own axis: what changes with the cosine of the roll, with its sine, and not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turning {
    still: Orientation,
    cos: Orientation,
    sin: Orientation,
}

/// All classes of one pose, at their places.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AtRoll {
    pub(crate) roll: f64,
    /// The largest translation per force, m/N, whatever the limits; NaN where nothing holds joint 2.
    pub(crate) worst: [f64; CLASSES],
    /// Negative where a limit or a length forbids the posture.
    pub(crate) slack: [f64; CLASSES],
    /// The same of lengths, joints 2 and 3 alone, which no singular posture of shoulder or wrist turns fast.
    pub(crate) links: [f64; CLASSES],
    /// Where the wrist centre stands from the joint-1 axis, m: its direction is that of the arm.
    pub(crate) wrist: [f64; 2],
    /// Axis 6 across the forearm: its direction is the angle of joint 4.
    pub(crate) bent: [[f64; 2]; CLASSES],
}

/// One class of every pose.
#[derive(Clone, Copy)]
struct Way<S: Simd> {
    worst: Lanes<S>,
    slack: Lanes<S>,
    links: Lanes<S>,
    bent: [Lanes<S>; 2],
}

impl<S: Simd> Way<S> {
    /// Infinite where it is forbidden, or nothing holds joint 2.
    #[inline(always)]
    fn allowed(self) -> Lanes<S> {
        let is_held = self.worst.at_least(0.0);
        (self.slack.at_least(0.0) & is_held).select(self.worst, self.worst.all(f64::INFINITY))
    }
}

impl SpatialArm {
    /// What a rotation of the tool (base axes) says about flange and wrist.
    pub(crate) fn orientation(&self, tool: &Matrix3<f64>) -> Orientation {
        let flange = tool * self.flange_from_tool.rotation.inverse().to_rotation_matrix();
        let point = self.flange_from_tool.translation.vector + Vector3::z() * self.geometry.c4;
        Orientation { spin: flange * Vector3::z(), side: flange * Vector3::x(), beyond: flange * point }
    }

    /// For every pose of the tool (base axes) the stiffest posture that all limits allow and in which drive 2 holds the gravity
    /// compensator; absent where there is none.
    ///
    /// All eight postures of each are judged. Where the wrist is singular, it is reached if some split between joints 4
    /// and 6 is allowed for certain. Accuracy as [`Self::worst`]. On all cores.
    pub fn best(&self, poses: &[Pose]) -> Vec<Option<Best>> {
        let mut found = vec![None; poses.len()];
        let blocks = found.par_chunks_mut(BLOCK).zip(poses.par_chunks(BLOCK));
        blocks.for_each(|(found, poses)| Arch::new().dispatch(BestOf { arm: self, poses, found }));
        found
    }

    /// What holds all postures within a quarter turn, joint by joint, of those at a pose of the tool (base axes).
    ///
    /// Joints 2, 3 and 5 of one class never span more; joints 1, 4 and 6 turn fast near singular postures and by half a
    /// turn across them. [`CLEARANCE`] is kept. Where a range is wider than a turn, and an angle near both ends, the joint
    /// stands at either: each is a case of its own.
    pub(crate) fn near(&self, tool: &Pose) -> Vec<Near> {
        let postures = postures(&self.geometry, &(tool * self.flange_from_tool.inverse())).found;
        let turns = |joint: usize| {
            1 + usize::from(postures.iter().any(|(_, theta)| self.about(joint, theta[joint]).1.is_some()))
        };
        let mut cases = Vec::new();
        for (fourth, sixth) in (0..turns(3)).flat_map(|fourth| (0..turns(5)).map(move |sixth| (fourth, sixth))) {
            let mut near = Near { clearance: CLEARANCE + self.reserve, ..Near::default() };
            for (class, theta) in &postures {
                let place = place(*class);
                let about = |joint: usize, turn: usize| {
                    let (roomiest, other) = self.about(joint, theta[joint]);
                    if turn == 0 { roomiest } else { other.unwrap_or(roomiest) }
                };
                near.first[place / 4] = about(0, 0);
                near.fourth[place] = about(3, fourth);
                near.sixth[place] = about(5, sixth);
            }
            cases.push(near);
        }
        cases
    }

    /// Within a quarter turn of a model angle, and in the range of its joint without coming round from the other end: from
    /// the turn of the angle with most room to both ends, and from the next where that leaves other room.
    fn about(&self, joint: usize, theta: f64) -> (Sector, Option<Sector>) {
        let range = self.geometry.theta(joint, self.limits.joints[joint]);
        let most = FRAC_PI_2 - self.reserve;
        let quarter = Interval::spanning(theta - most, theta + most);
        if !range.is_bounded() {
            return (Sector::of(quarter), None);
        }
        let room = |turned: f64| range.affine(1.0, theta - turned).intersect(quarter).unwrap_or(quarter);
        let roomiest = theta + ((range.middle() - theta) / TAU).round() * TAU;
        let other = if roomiest < range.middle() { roomiest + TAU } else { roomiest - TAU };
        let has_other = range.contains(other, 0.0) && room(roomiest) != quarter;
        (Sector::of(room(roomiest)), has_other.then(|| Sector::of(room(other))))
    }

    /// The largest translation per force, m/N, of every class at points of one orientation; infinite where a limit, or
    /// what is `near`, forbids it. `classes[place]` as [`class`] counts.
    pub(crate) fn classes_at(
        &self,
        orientation: &Orientation,
        near: &Near,
        points: [&[f64]; 3],
        classes: [&mut [f64]; CLASSES],
    ) {
        Arch::new().dispatch(ClassesAt { arm: self, orientation, near, points, classes });
    }

    /// What the poses share that the tool (base axes) takes at its rolls, given those at no roll, a quarter and half a turn.
    pub(crate) fn turning(&self, tools: [&Matrix3<f64>; 3]) -> Turning {
        let [none, quarter, half] = tools.map(|tool| self.orientation(tool));
        let of = |part: fn(&Orientation) -> Vector3<f64>| {
            let (none, quarter, half) = (part(&none), part(&quarter), part(&half));
            let still = (none + half) / 2.0;
            [still, (none - half) / 2.0, quarter - still]
        };
        let [spin, side, beyond] = [of(|it| it.spin), of(|it| it.side), of(|it| it.beyond)];
        let [still, cos, sin] = [0, 1, 2].map(|i| Orientation { spin: spin[i], side: side[i], beyond: beyond[i] });
        Turning { still, cos, sin }
    }

    /// Adds every class at a point at these rolls, rad.
    pub(crate) fn at_rolls(&self, turning: &Turning, point: &Vector3<f64>, rolls: &[f64], found: &mut Vec<AtRoll>) {
        Arch::new().dispatch(AtRolls { arm: self, turning, point, rolls, found });
    }

    /// Every class of a pose.
    #[inline(always)]
    fn classes<S: Simd>(&self, flange: &Flange<S>, near: &Near) -> [Way<S>; CLASSES] {
        let (px, py, pz) = flange.point.parts();
        let (ux, uy, uz) = flange.beyond.parts();
        let (wx, wy, wz) = (px - ux, py - uy, pz - uz);
        let b = self.geometry.b;
        let square = wx * wx + wy * wy;
        let across = square - b * b;
        let ahead = across.max(0.0).sqrt();
        let reached = across + 1e-9 * self.geometry.c2 * self.geometry.c2;
        let reached = (square - (near.clearance * self.geometry.c2).powi(2)).or_less(reached);
        // Above its own axis joint 1 is free: straight ahead stands for all.
        let free = square.at_most(1e-18 * self.geometry.c2 * self.geometry.c2);
        let inverse = free.select(px.all(0.0), px.all(1.0) / square);
        let one = px.all(1.0);
        let mut found = [Way { worst: one, slack: one, links: one, bent: [one; 2] }; CLASSES];
        for shoulder in 0..2 {
            let forwards = [ahead, -ahead][shoulder];
            let c1 = free.select(one, (wx * forwards + wy * b) * inverse);
            let s1 = free.select(px.all(0.0), (wy * forwards - wx * b) * inverse);
            let turned = self.sectors.joints[0].slack(c1, s1, one).or_less(near.first[shoulder].slack(c1, s1, one));
            let seen = Seen {
                spin: flange.spin.seen_turned(s1, c1),
                side: flange.side.seen_turned(s1, c1),
                beyond: flange.beyond.seen_turned(s1, c1),
                x: forwards - self.geometry.a1,
                z: wz - self.geometry.c1,
            };
            let ways = self.elbows(&seen, [reached, turned], near, 4 * shoulder);
            for way in 0..4 {
                found[4 * shoulder + way] = ways[way];
            }
        }
        found
    }

    /// Elbow up and down, each with both wrists, of one shoulder.
    #[inline(always)]
    fn elbows<S: Simd>(
        &self,
        seen: &Seen<S>,
        [reached, turned]: [Lanes<S>; 2],
        near: &Near,
        first: usize,
    ) -> [Way<S>; 4] {
        let (l2, l3) = (self.geometry.c2, self.geometry.l3());
        let (lean_c, lean_s) = (self.geometry.c3 / l3, self.geometry.a2 / l3);
        let (x, z) = (seen.x, seen.z);
        let square = x * x + z * z;
        let c = (square - (l2 * l2 + l3 * l3)) * (1.0 / (2.0 * l2 * l3));
        let straight = if near.clearance == 0.0 { 1.0 + 1e-12 } else { near.clearance.cos() };
        let reached = (c.all(straight) - c).or_less(c + straight).or_less(reached);
        let reached = (square - 1e-18 * l2 * l2).or_less(reached);
        let c = c.max(-1.0).min(1.0);
        let s = (c.all(1.0) - c * c).max(0.0).sqrt();
        let inverse = c.all(1.0) / square.max(1e-18 * l2 * l2);
        let one = c.all(1.0);
        let along = c * l3 + l2;
        let mut found = [Way { worst: one, slack: one, links: one, bent: [one; 2] }; 4];
        for elbow in 0..2 {
            let s = [s, -s][elbow];
            let aside = s * l3;
            let (s2, c2) = ((x * along - z * aside) * inverse, (z * along + x * aside) * inverse);
            let (s3, c3) = (s * lean_c - c * lean_s, c * lean_c + s * lean_s);
            let (s23, c23) = (s2 * c3 + c2 * s3, c2 * c3 - s2 * s3);
            let [_, second, third, ..] = self.sectors.joints;
            let forearm = self.sectors.third_is_forearm;
            let third_allowed = match &self.sectors.winding {
                Some(winding) => winding.slack(if forearm { [s2, c2] } else { [one.all(0.0), one] }, [s3, c3]),
                None if forearm => third.slack(c23, s23, one),
                None => third.slack(c3, s3, one),
            };
            let links = third_allowed.or_less(self.sectors.elbow.slack(c3, s3, one));
            let links = second.slack(c2, s2, one).or_less(links).or_less(reached);
            let [no_flip, flip] = self.wrists(seen, [s2, c2, s23, c23], [links, turned], near, first + 2 * elbow);
            found[2 * elbow] = no_flip;
            found[2 * elbow + 1] = flip;
        }
        found
    }

    /// Both wrists of one shoulder and elbow.
    #[inline(always)]
    fn wrists<S: Simd>(
        &self,
        seen: &Seen<S>,
        [s2, c2, s23, c23]: [Lanes<S>; 4],
        [links, turned]: [Lanes<S>; 2],
        near: &Near,
        first: usize,
    ) -> [Way<S>; 2] {
        const SINGULAR: f64 = 1e-9;
        let zero = s2.all(0.0);
        let along = Triple([s23, zero, c23]);
        let (spin_x, spin_y, spin_z) = seen.spin.parts();
        // The axis of joint 6 seen from the forearm: forwards, across, along.
        let (fore, across, c5) = (c23 * spin_x - s23 * spin_z, spin_y, s23 * spin_x + c23 * spin_z);
        let s5 = (fore * fore + across * across).sqrt();
        let singular = s5.at_most(SINGULAR);
        let inverse = s2.all(1.0) / s5.max(SINGULAR);
        let (bend_x, bend_y) = (-across * inverse, singular.select(s2.all(1.0), fore * inverse));
        let bend = Triple([c23 * bend_x, bend_y, -(s23 * bend_x)]);
        let (cos_6, sin_6) = (-along.dot(seen.side), along.dot(seen.spin.cross(seen.side)));
        let [.., fourth, fifth, sixth] = self.sectors.joints;
        let compliance = self.translation(&At { s2, c2, s23, c23, bend, spin: seen.spin, beyond: seen.beyond });
        let worst = compliance.largest();
        let any_split = s2.all(if self.sectors.any_wrist_split { 1.0 } else { -1.0 });
        let flipped = match self.coupling {
            // The other wrist turns joint 5 the other way, which a drive of its own does not feel.
            Coupling::Serial | Coupling::QuasiSerial => worst,
            Coupling::Any(_) => {
                let bend = bend * -1.0;
                self.translation(&At { s2, c2, s23, c23, bend, spin: seen.spin, beyond: seen.beyond }).largest()
            }
        };
        let worst = [worst, flipped];
        let mut found = [Way { worst: zero, slack: zero, links, bent: [fore, across] }; 2];
        for wrist in 0..2 {
            let sign = [1.0, -1.0][wrist];
            let (turn_4, turn_6) = ([fore * sign, across * sign], [cos_6 * sign, sin_6 * sign]);
            let turns = fourth.slack(turn_4[0], turn_4[1], s5).or_less(sixth.slack(turn_6[0], turn_6[1], s5));
            let turns = singular.select(any_split, turns);
            let turns = near.fourth[first + wrist].slack(turn_4[0], turn_4[1], s5).or_less(turns);
            let turns = near.sixth[first + wrist].slack(turn_6[0], turn_6[1], s5).or_less(turns);
            let bent = fifth.slack(c5, s5 * sign, s2.all(1.0));
            found[wrist].worst = worst[wrist];
            let bent = (s5 - near.clearance).or_less(bent);
            found[wrist].slack = turns.or_less(bent).or_less(turned).or_less(links);
        }
        found
    }
}

/// Poses of the flange, base axes.
struct Flange<S: Simd> {
    /// The tool point.
    point: Triple<S>,
    /// Axis of joint 6, the flange's z.
    spin: Triple<S>,
    /// The flange's x.
    side: Triple<S>,
    /// From the wrist centre to the tool point.
    beyond: Triple<S>,
}

/// The same in the axes of an arm that has turned joint 1; the wrist centre at `x`, `z` from the joint-2 axis.
struct Seen<S: Simd> {
    spin: Triple<S>,
    side: Triple<S>,
    beyond: Triple<S>,
    x: Lanes<S>,
    z: Lanes<S>,
}

struct ClassesAt<'a> {
    arm: &'a SpatialArm,
    orientation: &'a Orientation,
    near: &'a Near,
    points: [&'a [f64]; 3],
    classes: [&'a mut [f64]; CLASSES],
}

impl WithSimd for ClassesAt<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Orientation { spin, side, beyond } = self.orientation;
        let count = self.points[0].len();
        for from in (0..count).step_by(S::F64_LANES) {
            let to = count.min(from + S::F64_LANES);
            let flange = Flange {
                point: Triple::load(simd, self.points.map(|part| &part[from..to])),
                spin: Triple::splat(simd, spin),
                side: Triple::splat(simd, side),
                beyond: Triple::splat(simd, beyond),
            };
            let classes = self.arm.classes(&flange, self.near);
            for place in 0..CLASSES {
                classes[place].allowed().store(&mut self.classes[place][from..to]);
            }
        }
    }
}

struct AtRolls<'a> {
    arm: &'a SpatialArm,
    turning: &'a Turning,
    point: &'a Vector3<f64>,
    rolls: &'a [f64],
    found: &'a mut Vec<AtRoll>,
}

impl WithSimd for AtRolls<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Turning { still, cos, sin } = self.turning;
        for rolls in self.rolls.chunks(S::F64_LANES) {
            let (s, c) = Lanes::load(simd, rolls).sin_cos();
            let turned = [
                [&still.spin, &cos.spin, &sin.spin],
                [&still.side, &cos.side, &sin.side],
                [&still.beyond, &cos.beyond, &sin.beyond],
            ];
            let mut vectors = [Triple::splat(simd, self.point); 3];
            for i in 0..3 {
                let [still, cos, sin] = turned[i];
                vectors[i] = Triple::splat(simd, still) + Triple::splat(simd, cos) * c + Triple::splat(simd, sin) * s;
            }
            let [spin, side, beyond] = vectors;
            let flange = Flange { point: Triple::splat(simd, self.point), spin, side, beyond };
            let ways = self.arm.classes(&flange, &Near::default());
            let mut parts = [[[0.0; WIDEST]; CLASSES]; 5];
            for place in 0..CLASSES {
                let Way { worst, slack, links, bent: [fore, across] } = ways[place];
                worst.store(&mut parts[0][place][..S::F64_LANES]);
                slack.store(&mut parts[1][place][..S::F64_LANES]);
                fore.store(&mut parts[2][place][..S::F64_LANES]);
                across.store(&mut parts[3][place][..S::F64_LANES]);
                links.store(&mut parts[4][place][..S::F64_LANES]);
            }
            let mut wrist = [[0.0; WIDEST]; 2];
            for axis in 0..2 {
                (flange.point.0[axis] - flange.beyond.0[axis]).store(&mut wrist[axis][..S::F64_LANES]);
            }
            for lane in 0..rolls.len() {
                let of = |part: usize| std::array::from_fn(|place| parts[part][place][lane]);
                self.found.push(AtRoll {
                    roll: rolls[lane],
                    worst: of(0),
                    slack: of(1),
                    links: of(4),
                    wrist: wrist.map(|axis| axis[lane]),
                    bent: std::array::from_fn(|place| [parts[2][place][lane], parts[3][place][lane]]),
                });
            }
        }
    }
}

struct BestOf<'a> {
    arm: &'a SpatialArm,
    poses: &'a [Pose],
    found: &'a mut [Option<Best>],
}

impl WithSimd for BestOf<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (poses, found) in self.poses.chunks(S::F64_LANES).zip(self.found.chunks_mut(S::F64_LANES)) {
            let mut parts = [[[0.0; WIDEST]; 3]; 4];
            for (lane, pose) in poses.iter().enumerate() {
                let rotation = pose.rotation.to_rotation_matrix();
                let Orientation { spin, side, beyond } = self.arm.orientation(rotation.matrix());
                for (triple, vector) in [pose.translation.vector, spin, side, beyond].iter().enumerate() {
                    for axis in 0..3 {
                        parts[triple][axis][lane] = vector[axis];
                    }
                }
            }
            let [point, spin, side, beyond] = &parts;
            let flange = Flange {
                point: Triple::load(simd, point.each_ref().map(|part| &part[..S::F64_LANES])),
                spin: Triple::load(simd, spin.each_ref().map(|part| &part[..S::F64_LANES])),
                side: Triple::load(simd, side.each_ref().map(|part| &part[..S::F64_LANES])),
                beyond: Triple::load(simd, beyond.each_ref().map(|part| &part[..S::F64_LANES])),
            };
            let lanes = self.arm.classes(&flange, &Near::default());
            let mut classes = [[0.0; WIDEST]; CLASSES];
            for place in 0..CLASSES {
                lanes[place].allowed().store(&mut classes[place][..S::F64_LANES]);
            }
            for (lane, found) in found.iter_mut().enumerate() {
                let ways = (0..CLASSES).map(|place| (classes[place][lane], place)).filter(|way| way.0.is_finite());
                let best = ways.min_by(|a, b| a.0.total_cmp(&b.0));
                *found = best.map(|(worst, place)| Best { worst, configuration: class(place) });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::drive::GravityCompensator;
    use crate::inverse::reached;
    use crate::robot::Arm;

    #[test]
    fn the_best_posture_in_bulk_is_the_best_of_all_single_ones() {
        let mut rng = fastrand::Rng::with_seed(14);
        for (n, robot) in paper_robots().iter().enumerate() {
            let tool = if n % 2 == 0 { Pose::translation(0.05, 0.1, 0.2) } else { Pose::identity() };
            let arm = SpatialArm::new(robot, &tool).unwrap();
            let poses: Vec<Pose> = (0..400)
                .map(|_| {
                    let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
                    let at = Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-1.0, 3.0));
                    Pose::new(at, Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-3.0, 3.0)))
                })
                .collect();
            let mut several = 0;
            for (pose, best) in poses.iter().zip(arm.best(&poses)) {
                let ways: Vec<(f64, Configuration)> = reached(robot, &(pose * tool.inverse()))
                    .into_iter()
                    .map(|(class, q)| (compliance(robot, &q, &tool).unwrap().compliance.worst().0, class))
                    .collect();
                several += usize::from(1 < ways.len());
                let expected = ways.iter().map(|way| way.0).fold(f64::INFINITY, f64::min);
                match best {
                    None => assert!(ways.is_empty(), "{}: {pose} is reached by {ways:?}", robot.name),
                    Some(best) => {
                        assert!((best.worst - expected).abs() <= 1e-7 * expected, "{}: {best:?} {ways:?}", robot.name);
                        assert!(
                            ways.iter().any(|way| way.1 == best.configuration),
                            "{}: {best:?} {ways:?}",
                            robot.name
                        );
                    }
                }
            }
            assert!(10 < several, "{}: {several} poses are reached in several ways", robot.name);
        }
    }

    #[test]
    fn a_pose_at_which_nothing_holds_joint_2_is_not_reached() {
        let mut robot = paper_robots().swap_remove(4);
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!("six axes") };
        // By hand: 1e6 - 1.5e6 cos(theta2) N m/rad, negative within 48 degrees of upright.
        let (base, arm) = ([0.0, -0.3], [0.0, 0.5]);
        drives.compensator = Some(GravityCompensator { base, arm, stiffness: 1e7, free_length: 0.0 });
        let tool = Pose::translation(0.05, 0.1, 0.2);
        let arm = SpatialArm::new(&robot, &tool).unwrap();
        let mut rng = fastrand::Rng::with_seed(15);
        let poses: Vec<Pose> = (0..1500)
            .map(|_| {
                let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
                let at = Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-1.0, 3.0));
                Pose::new(at, Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-3.0, 3.0)))
            })
            .collect();
        let (mut some_unheld, mut all_unheld) = (0, 0);
        for (pose, best) in poses.iter().zip(arm.best(&poses)) {
            let ways = reached(&robot, &(pose * tool.inverse()));
            let held: Vec<f64> = ways
                .iter()
                .filter_map(|(_, q)| compliance(&robot, q, &tool).ok())
                .map(|posture| posture.compliance.worst().0)
                .collect();
            some_unheld += usize::from(!held.is_empty() && held.len() < ways.len());
            all_unheld += usize::from(held.is_empty() && !ways.is_empty());
            let least = held.into_iter().reduce(f64::min);
            assert_eq!(best.is_some(), least.is_some(), "{pose}: {best:?}");
            if let (Some(best), Some(least)) = (best, least) {
                assert!((best.worst - least).abs() <= 1e-7 * least, "{pose}: {best:?} {least}");
            }
        }
        assert!(5 < some_unheld && 20 < all_unheld, "{some_unheld} {all_unheld}");
    }
}
