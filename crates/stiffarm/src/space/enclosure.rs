//! What holds for a class of postures at every stand of a box: what it cannot avoid, and how far it gives way at least.
//!
//! The formulas are those of `poses`, one after the other, with affine numbers in place of registers.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::affine::{Affine, Vector, cross, dot};
use super::patch::{Patch, Stand};
use super::sector::Sector;
use super::stands::{StandBox, Stands};
use super::{Coupling, SpatialArm};
use crate::interval::Interval;
use crate::inverse::{CLEARANCE, Configuration, Shoulder, Wrist};
use crate::limits::{Limits, ThirdAxis};
use crate::plane::Elbow;

/// How far a limit must be overstepped for certain before a posture counts as impossible: more than a place is granted.
const SLACK: f64 = 2e-9;
/// How near to a singular posture none is given up: nearer than a place may be.
const CLEAR: f64 = CLEARANCE * (1.0 - 1e-5);
/// The second direction is looked at as well where it gives way by this part of the first.
const SECOND: f64 = 0.6;

/// A shoulder and an elbow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Way {
    /// The arm bent over backwards.
    pub(crate) back: bool,
    /// Elbow down.
    pub(crate) down: bool,
}

impl Way {
    /// All four, in the order in which classes count.
    pub(crate) const ALL: [Self; 4] = [
        Self { back: false, down: false },
        Self { back: false, down: true },
        Self { back: true, down: false },
        Self { back: true, down: true },
    ];
}

/// What is known of one point of the zone, held in one way, at the stands of a box.
#[derive(Clone, Debug)]
pub(crate) struct Known<const N: usize> {
    /// No more than the largest translation per force, m/N, of every stand of the box at which the pose is held.
    pub(crate) values: Vec<Affine<N>>,
    /// Not negative at every such stand.
    pub(crate) limits: Vec<Affine<N>>,
}

impl<const N: usize> Default for Known<N> {
    fn default() -> Self {
        Self { values: Vec::new(), limits: Vec::new() }
    }
}

impl<const N: usize> Known<N> {
    /// `x` is not negative. `None` where it is for certain.
    pub(crate) fn require(&mut self, x: Affine<N>) -> Option<()> {
        if x.max() < -SLACK {
            return None;
        }
        if x.min() < 0.0 {
            self.limits.push(x + SLACK);
        }
        Some(())
    }

    /// The angle of a vector of that length lies in the sector.
    fn require_in(&mut self, sector: &Sector, cos: Affine<N>, sin: Affine<N>, length: Affine<N>) -> Option<()> {
        sector.room(cos, sin, length).map_or(Some(()), |room| self.require(room))
    }
}

/// The stands of a box and what the tool is like there: from the wrist centre to its point, the flange's z and x; base axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim<const N: usize> {
    pub(crate) stands: Stands<N>,
    beyond: Vector<N>,
    spin: Vector<N>,
    side: Vector<N>,
}

/// Where joints 1, 4 and 6 point at a pose: cosine and sine of each, the last two times a length; the wrist not flipped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facing<const N: usize>([[Affine<N>; 2]; 3]);

/// How far joints 1, 4 and 6 turn for certain from where they point at the centre of a zone, as the poses of the zone are
/// learnt: the least that is passed on the positive side, and the most on the negative one, rad.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Spread([[f64; 2]; 3]);

/// Ranges of theta 1 to 6 and of the forearm's angle, `theta 2 + theta 3`.
pub(crate) type Angles = [Interval; 7];

/// The joints of [`Facing`], from 0.
const FACING: [usize; 3] = [0, 3, 5];

/// A vector in the arm plane: forwards, up.
type Flat<const N: usize> = [Affine<N>; 2];

/// Where the wrist centre stands, joint 1 turned, and what the tool is seen like from there.
struct Turned<const N: usize> {
    /// The tool point, base axes.
    point: Vector<N>,
    /// From the joint-2 axis.
    wrist: Flat<N>,
    /// Cosine and sine of theta 1.
    first: [Affine<N>; 2],
    spin: Vector<N>,
    side: Vector<N>,
    beyond: Vector<N>,
}

/// Directions of the links: each a vector of length one.
struct Links<const N: usize> {
    upper: Flat<N>,
    forearm: Flat<N>,
}

/// An arm whose limits are ready for enclosures.
#[derive(Clone, Debug)]
pub(crate) struct Enclosing {
    arm: SpatialArm,
    /// From the wrist centre to the tool point, the flange's z and x: in the axes of the tool.
    beyond: [f64; 3],
    spin: [f64; 3],
    side: [f64; 3],
    /// Squared distances of the wrist centre from the joint-2 axis, elbow up and down, that the links and the limits on
    /// the angle between them allow.
    rings: [Option<Interval>; 2],
    /// What joints 1, 4 and 6 may turn by within a zone, rad, and their ranges of model angles.
    turns: [f64; 3],
    ranges: [Interval; 3],
}

impl Enclosing {
    /// For an arm as it is asked about, but for the limits that turning the zone or the tool as a whole meets: `free`.
    pub(crate) fn new(asked: &SpatialArm, free: [bool; 6]) -> Self {
        let arm = (0..6).fold(asked.clone(), |arm, joint| arm.without_limit_on(joint, free[joint]));
        let turns = FACING.map(|joint| asked.limits.joints[joint].width());
        let ranges = FACING.map(|joint| arm.geometry.theta(joint, arm.limits.joints[joint]));
        let tool_from_flange = arm.flange_from_tool.rotation.inverse();
        let point = arm.flange_from_tool.translation.vector + Vector3::z() * arm.geometry.c4;
        let seen = |v: Vector3<f64>| (tool_from_flange * v).into();
        let (beyond, spin, side) = (seen(point), seen(Vector3::z()), seen(Vector3::x()));
        let rings = [1.0, -1.0].map(|sign| ring(&arm, sign));
        Self { arm, beyond, spin, side, rings, turns, ranges }
    }

    /// How far the wrist centre lies from the axis of the tool, m.
    pub(crate) fn beside_the_tool_axis(&self) -> f64 {
        self.beyond[0].hypot(self.beyond[1])
    }

    /// What the tool is like at the stands of a box.
    pub(crate) fn aim<const N: usize>(&self, elevation: f64, stands: &StandBox) -> Aim<N> {
        let stands = Stands::of(elevation, stands);
        let [beyond, spin, side] = [self.beyond, self.spin, self.side].map(|v| stands.carried(v));
        Aim { stands, beyond, spin, side }
    }

    /// Squared distance of the wrist centre from the joint-2 axis, the tool at a point of a patch.
    pub(crate) fn distance(&self, patch: &Patch, point: &Vector3<f64>, way: Way) -> f64 {
        let geometry = &self.arm.geometry;
        let wrist = point - patch.tool() * Vector3::from(self.beyond);
        let ahead = (wrist.xy().norm_squared() - geometry.b * geometry.b).max(0.0).sqrt();
        let forwards = if way.back { -ahead } else { ahead };
        (forwards - geometry.a1).powi(2) + (wrist.z - geometry.c1).powi(2)
    }

    /// Learns what holds where the pose at a point of the zone is held in a way with one of the `wrists`, and which of
    /// these remain; `None` where no stand of the box allows it.
    ///
    /// Joints 1, 4 and 6 stay within a quarter turn of where they point at the `centre` of the zone; the answer is where
    /// they point here (inner `None`: not known). Where the wrists are not alike, one at most may be asked for.
    pub(crate) fn learn<const N: usize>(
        &self,
        aim: &Aim<N>,
        at: [f64; 2],
        way: Way,
        centre: Option<(&Facing<N>, &mut Spread)>,
        wrists: &mut [bool; 2],
        known: &mut Known<N>,
    ) -> Option<Option<Facing<N>>> {
        let turned = self.turned(aim, at, way)?;
        self.by_distance(&turned, way, known);
        let Some(links) = self.links(&turned.wrist, way, known)? else { return Some(None) };
        let [(s2, c2), (s23, c23)] = [links.upper, links.forearm].map(|[x, z]| (x, z));
        let one = Affine::point(1.0);
        let sectors = &self.arm.sectors;
        known.require_in(&sectors.joints[1], c2, s2, one)?;
        // Of theta 3.
        let (c3, s3) = (unit(c2 * c23 + s2 * s23), unit(c2 * s23 - s2 * c23));
        known.require_in(&sectors.elbow, c3, s3, one)?;
        match &sectors.winding {
            Some(_) => self.third_is_within([c2, s2], [c3, s3])?,
            None if sectors.third_is_forearm => known.require_in(&sectors.joints[2], c23, s23, one)?,
            None => known.require_in(&sectors.joints[2], c3, s3, one)?,
        }
        let (fourth, sixth, c5) = seen_from_forearm(&turned, &links);
        let [fore, across] = fourth;
        let clear = Interval::spanning(CLEAR * CLEAR, 1.0);
        let s5 = (fore.square() + across.square()).concave(clear, |x| (x.sqrt(), 0.5 / x.sqrt()))?;
        let facing = Facing([turned.first, fourth, sixth]);
        if let Some((centre, spread)) = centre {
            self.turn_on(&facing, centre, spread, wrists, known)?;
        }
        self.wrists(&facing, s5, c5, wrists);
        if *wrists == [false; 2] {
            return None;
        }
        let inverse = s5.inverse(Interval::spanning(CLEAR, 1.0)).filter(|_| CLEAR < s5.min());
        let sign = if wrists[0] { 1.0 } else { -1.0 };
        let bend = inverse.map(|inverse| {
            let (x, y) = (unit(-across * inverse * sign), unit(fore * inverse * sign));
            [c23 * x, y, -(s23 * x)]
        });
        self.values(&turned, &links, bend, known);
        Some(Some(facing))
    }

    /// The model angles with which a class holds all of a part of a patch, up to whole turns: of joints 1 to 6, and of the forearm
    /// from upright. `None` where they are not known, or some may be singular.
    pub(crate) fn angles(
        &self,
        patch: &Patch,
        stand: &Stand,
        part: [Affine<2>; 2],
        class: Configuration,
    ) -> Option<Angles> {
        let [beyond, spin, side] =
            [self.beyond, self.spin, self.side].map(|v| <[f64; 3]>::from(patch.tool() * Vector3::from(v)));
        let fixed = |v: [f64; 3]| v.map(Affine::point);
        let stands = Stands::at(patch.part(stand, part), patch.tool());
        let aim = Aim { stands, beyond: fixed(beyond), spin: fixed(spin), side: fixed(side) };
        let way = Way { back: class.shoulder == Shoulder::Back, down: class.elbow == Elbow::Down };
        let turned = self.turned(&aim, [0.0; 2], way)?;
        let square = turned.wrist[0].square() + turned.wrist[1].square();
        let ring = self.rings[usize::from(way.down)]?;
        if !(ring.min() < square.min() && square.max() < ring.max()) {
            return None;
        }
        let links = self.links(&turned.wrist, way, &mut Known::default()).flatten()?;
        let [(s2, c2), (s23, c23)] = [links.upper, links.forearm].map(|[x, z]| (x, z));
        let (fourth, sixth, c5) = seen_from_forearm(&turned, &links);
        let square = fourth[0].square() + fourth[1].square();
        if !(CLEAR * CLEAR < square.min()) {
            return None;
        }
        let sign = if class.wrist == Wrist::Flip { -1.0 } else { 1.0 };
        let s5 = square.sqrt()? * sign;
        let (fourth, sixth) = (fourth.map(|x| x * sign), sixth.map(|x| x * sign));
        Some([
            angle(turned.first[0], turned.first[1])?,
            angle(c2, s2)?,
            angle(c2 * c23 + s2 * s23, c2 * s23 - s2 * c23)?,
            angle(fourth[0], fourth[1])?,
            angle(c5, s5)?,
            angle(sixth[0], sixth[1])?,
            angle(c23, s23)?,
        ])
    }

    /// Joint 1 turned towards the wrist centre, or away from it.
    fn turned<const N: usize>(&self, aim: &Aim<N>, at: [f64; 2], way: Way) -> Option<Turned<N>> {
        let geometry = &self.arm.geometry;
        let point = aim.stands.point(at);
        let [wx, wy, wz]: Vector<N> = std::array::from_fn(|i| point[i] - aim.beyond[i]);
        let square = wx.square() + wy.square();
        let b2 = geometry.b * geometry.b;
        let least = b2.max((CLEAR * geometry.c2).powi(2));
        if square.max() < least - SLACK * geometry.c2 * geometry.c2 {
            return None;
        }
        let sign = if way.back { -1.0 } else { 1.0 };
        let wrist = [(square + -b2).sqrt()? * sign + -geometry.a1, wz + -geometry.c1];
        if !(least < square.min()) {
            // It may stand over the axis, and joint 1 face anywhere: heights and lengths are known.
            let any = |length: f64| Affine { rest: length, ..Affine::point(0.0) };
            let most = |x: Affine<N>| x.min().abs().max(x.max().abs());
            let seen = |[x, y, z]: Vector<N>| [any(most(x).hypot(most(y))), any(most(x).hypot(most(y))), z];
            let (spin, side, beyond) = (seen(aim.spin), seen(aim.side), seen(aim.beyond));
            return Some(Turned { point, wrist, first: [any(1.0); 2], spin, side, beyond });
        }
        let inverse = square.inverse(Interval::spanning(least, f64::INFINITY))?;
        // sqrt(square - b^2)/square, concave in 1/square.
        let part = inverse.concave(Interval::spanning(0.0, 1.0 / least), |i| {
            let root = (i - b2 * i * i).max(0.0).sqrt();
            (root, (0.5 - b2 * i) / root)
        })?;
        let (part, aside) = (part * sign, inverse * geometry.b);
        let (c1, s1) = (unit(wx * part + wy * aside), unit(wy * part - wx * aside));
        let seen = |[x, y, z]: Vector<N>| [c1 * x + s1 * y, c1 * y - s1 * x, z];
        let (spin, side, beyond) = (seen(aim.spin), seen(aim.side), seen(aim.beyond));
        Some(Turned { point, wrist, first: [c1, s1], spin, side, beyond })
    }

    /// Adds what drives 1, 2 and 3 give way by at least, each alone, by the distances of the tool point from the axes of
    /// their joints: what is left to say of boxes in which the links could point anywhere.
    fn by_distance<const N: usize>(&self, turned: &Turned<N>, way: Way, known: &mut Known<N>) {
        let (geometry, k) = (&self.arm.geometry, self.arm.k);
        if matches!(self.arm.coupling, Coupling::Any(_)) {
            return;
        }
        let [x, y, z] = turned.point;
        known.values.push(squares(&[(Affine::point(k[0]), x), (Affine::point(k[0]), y)], |x| x.middle));
        // How far the tool point is from the wrist centre, forwards, across and up, and how far forwards from the joint-1 axis.
        let [ux, uy, uz] = turned.beyond;
        let most = |x: Affine<N>| x.min().abs().max(x.max().abs());
        let (far, aside) = (most(ux).hypot(most(uz)), most(uy) + geometry.b.abs());
        let across = Affine { rest: aside * aside / 2.0, ..Affine::point(aside * aside / 2.0) };
        let Some(ahead) = (x.square() + y.square() - across).sqrt() else { return };
        let sign = if way.back { -1.0 } else { 1.0 };
        if ((turned.wrist[0] + geometry.a1) * sign).min() <= most(ux) {
            return; // it could be on either side of the axis
        }
        let (px, pz) = (ahead * sign + -geometry.a1, z + -geometry.c1);
        // From the elbow: as far as the links leave it.
        let from_elbow = geometry.l3() - far;
        let Some(from_2) = (px.square() + pz.square()).sqrt() else { return };
        let (near_2, far_2) = (from_2.min(), from_2.max());
        let from_elbow = from_elbow.max(near_2 - geometry.c2).max(geometry.c2 - far_2).max(0.0);
        known.values.push(Affine::point(k[2] * from_elbow * from_elbow));
        match self.arm.coupling {
            Coupling::Serial if self.arm.compensator.is_none() => {
                known.values.push(squares(&[(Affine::point(k[1]), px), (Affine::point(k[1]), pz)], |x| x.middle));
            }
            Coupling::QuasiSerial if self.arm.compensator.is_none() => {
                known.values.push(Affine::point(k[1] * geometry.c2 * geometry.c2));
            }
            _ => {}
        }
    }

    /// The links that put the wrist centre there. Inner `None`: they could be anywhere.
    fn links<const N: usize>(&self, [x, z]: &Flat<N>, way: Way, known: &mut Known<N>) -> Option<Option<Links<N>>> {
        let (l2, l3) = (self.arm.geometry.c2, self.arm.geometry.l3());
        let ring = self.rings[usize::from(way.down)]?;
        let square = x.square() + z.square();
        known.require((square + -ring.min()) * (1.0 / (l2 * l2)))?;
        known.require((-square + ring.max()) * (1.0 / (l2 * l2)))?;
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
        let aside = if way.down { -aside } else { aside };
        let elbow = [*x * along - *z * aside, *z * along + *x * aside];
        let [gx, gz] = [*x - elbow[0], *z - elbow[1]];
        let (c3, a2) = (self.arm.geometry.c3 / (l3 * l3), self.arm.geometry.a2 / (l3 * l3));
        Some(Some(Links {
            upper: elbow.map(|part| unit(part * (1.0 / l2))),
            forearm: [unit(gx * c3 - gz * a2), unit(gz * c3 + gx * a2)],
        }))
    }

    /// What joint 3 reports lies within its limit, as do theta 2 and the angle between the links with the same whole turns;
    /// cosine and sine of theta 2 and theta 3.
    fn third_is_within<const N: usize>(&self, [c2, s2]: [Affine<N>; 2], [c3, s3]: [Affine<N>; 2]) -> Option<()> {
        let Limits { joints, elbow, third_axis, .. } = &self.arm.limits;
        let geometry = &self.arm.geometry;
        let (Some(second), Some(third)) = (angle(c2, s2), angle(c3, s3)) else { return Some(()) };
        let seconds = match third_axis {
            ThirdAxis::Elbow => vec![Interval::point(0.0)],
            ThirdAxis::Forearm => turned_into(geometry.theta(1, joints[1]), second).collect(),
        };
        let reported = geometry.theta(2, joints[2]);
        let allowed = Interval::spanning(reported.min() - SLACK, reported.max() + SLACK);
        turned_into(elbow.affine(-1.0, PI), third)
            .any(|third| seconds.iter().any(|second| allowed.intersect(second.plus(third)).is_some()))
            .then_some(())
    }

    /// Joints 1, 4 and 6 turn by less than a quarter turn from the centre on, by no more than their ranges are wide, and
    /// without coming round from the other end.
    fn turn_on<const N: usize>(
        &self,
        facing: &Facing<N>,
        centre: &Facing<N>,
        spread: &mut Spread,
        wrists: &mut [bool; 2],
        known: &mut Known<N>,
    ) -> Option<()> {
        for part in 0..3 {
            let ([c, s], [from_c, from_s]) = (facing.0[part], centre.0[part]);
            let ahead = c * from_c + s * from_s;
            known.require(ahead)?;
            let Some(turned) = angle(ahead, s * from_c - c * from_s) else { continue };
            let [most, least] = &mut spread.0[part];
            (*most, *least) = (most.max(turned.min()), least.min(turned.max()));
            if self.turns[part] + SLACK < *most - *least {
                return None;
            }
            let Some(from) = angle(from_c, from_s).filter(|_| self.ranges[part].is_bounded()) else { continue };
            for (flip, wrist) in [0.0, PI].into_iter().zip(wrists.iter_mut()) {
                let flip = if part == 0 { 0.0 } else { flip };
                *wrist &= stays_within(self.ranges[part], from.affine(1.0, flip), turned);
            }
        }
        Some(())
    }

    /// Takes away the wrists that no stand of the box allows; sine and cosine of joint 5, the sine not negative.
    fn wrists<const N: usize>(&self, facing: &Facing<N>, s5: Affine<N>, c5: Affine<N>, wrists: &mut [bool; 2]) {
        let [.., fourth, fifth, sixth] = &self.arm.sectors.joints;
        let Facing([_, [fore, across], [cos_6, sin_6]]) = *facing;
        let forbidden = |sector: &Sector, cos: Affine<N>, sin: Affine<N>, length: Affine<N>| {
            sector.room(cos, sin, length).is_some_and(|room| room.max() < -SLACK)
        };
        for (wrist, sign) in wrists.iter_mut().zip([1.0, -1.0]) {
            // A straight wrist, of which joints 4 and 6 may be split in many ways, has vectors of length zero: no room less.
            *wrist &= !forbidden(fifth, c5, s5 * sign, Affine::point(1.0))
                && !forbidden(fourth, fore * sign, across * sign, s5)
                && !forbidden(sixth, cos_6 * sign, sin_6 * sign, s5);
        }
    }

    /// Adds what the drives give way by along the worst directions of the middle.
    fn values<const N: usize>(
        &self,
        turned: &Turned<N>,
        links: &Links<N>,
        bend: Option<Vector<N>>,
        known: &mut Known<N>,
    ) {
        let geometry = &self.arm.geometry;
        let zero = Affine::point(0.0);
        let [ux, uy, uz] = turned.beyond;
        let [ex, ez] = links.upper.map(|part| part * geometry.c2);
        let (px, pz) = (turned.wrist[0] + ux, turned.wrist[1] + uz);
        let along = [links.forearm[0], zero, links.forearm[1]];
        let unknown = Affine { rest: f64::NAN, ..zero };
        let mut columns = [
            [-(uy + geometry.b), px + geometry.a1, zero],
            [pz, zero, -px],
            [pz - ez, zero, ex - px],
            cross(&along, &turned.beyond),
            bend.map_or([unknown; 3], |bend| cross(&bend, &turned.beyond)),
            if self.arm.tool_is_on_axis_6() { [zero; 3] } else { cross(&turned.spin, &turned.beyond) },
        ];
        match &self.arm.coupling {
            Coupling::Serial => {}
            Coupling::QuasiSerial => columns[1] = [ez, zero, -ex],
            Coupling::Any(a) => {
                let joints = columns;
                columns = std::array::from_fn(|drive| {
                    (0..6).filter(|&joint| a[(joint, drive)] != 0.0).fold([zero; 3], |sum, joint| {
                        std::array::from_fn(|i| sum[i] + joints[joint][i] * a[(joint, drive)])
                    })
                });
            }
        }
        let k = self.drives(links);
        // What is not known may give way by nothing.
        let parts: Vec<(Affine<N>, &Vector<N>)> = k
            .into_iter()
            .zip(&columns)
            .filter(|(k, column)| !k.is_unknown() && !column.iter().any(Affine::is_unknown))
            .collect();
        let mut sum = Matrix3::zeros();
        for (k, column) in &parts {
            let v = Vector3::from(column.map(|part| part.middle));
            sum += v * v.transpose() * k.middle;
        }
        let eigen = SymmetricEigen::new(sum);
        let largest = eigen.eigenvalues.max();
        for (value, direction) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            if *value < SECOND * largest {
                continue;
            }
            let moved = parts.iter().map(|(k, column)| {
                (*k, column[0] * direction[0] + column[1] * direction[1] + column[2] * direction[2])
            });
            let moved: Vec<(Affine<N>, Affine<N>)> = moved.collect();
            // A square lies above its tangents: that in the middle, and the one that is greatest at the worse end.
            known.values.push(squares(&moved, |x| x.middle));
            known
                .values
                .push(squares(&moved, |x: &Affine<N>| (x.middle.abs() - x.radius()).max(0.0).copysign(x.middle)));
        }
    }

    /// The compliance of each drive, with the compensator's part.
    fn drives<const N: usize>(&self, links: &Links<N>) -> [Affine<N>; 6] {
        let mut k = self.arm.k.map(Affine::point);
        if let Some(compensator) = &self.arm.compensator {
            let [s2, c2] = links.upper;
            let [bx, bz] = compensator.base;
            let [ax, az] = compensator.arm;
            let (x, z) = (c2 * ax + s2 * az, c2 * az - s2 * ax);
            let (u, v) = (x * bx + z * bz, z * bx - x * bz);
            let square = u * -2.0 + (bx * bx + bz * bz + ax * ax + az * az);
            let held = (|| {
                let inverse = square.inverse(Interval::POSITIVE).filter(|_| 0.0 < square.min())?;
                // free / s, and with it the stiffness as in `GravityCompensator::stiffness`.
                let part = inverse.sqrt()? * compensator.free_length;
                let added = (u - part * u + part * inverse * v.square()) * compensator.stiffness;
                let held = added * k[1].middle + 1.0;
                held.inverse(Interval::POSITIVE).filter(|_| 0.0 < held.min())
            })();
            let unknown = Affine { rest: f64::NAN, ..Affine::point(0.0) };
            k[1] = held.map_or(unknown, |held| held * k[1].middle);
        }
        k
    }
}

/// Where joints 4 and 6 of a wrist that is not flipped point, cosine and sine of each times that of joint 5, and its cosine.
fn seen_from_forearm<const N: usize>(
    turned: &Turned<N>,
    links: &Links<N>,
) -> ([Affine<N>; 2], [Affine<N>; 2], Affine<N>) {
    let [s23, c23] = links.forearm;
    // The axis of joint 6 seen from the forearm: forwards, across, along.
    let [spin_x, across, spin_z] = turned.spin.map(unit);
    let (fore, c5) = (unit(c23 * spin_x - s23 * spin_z), unit(s23 * spin_x + c23 * spin_z));
    let along = [s23, Affine::point(0.0), c23];
    let sixth = [-dot(&along, &turned.side), dot(&along, &cross(&turned.spin, &turned.side))].map(unit);
    ([fore, across], sixth, c5)
}

/// A part of a vector of length one.
fn unit<const N: usize>(x: Affine<N>) -> Affine<N> {
    x.clipped(Interval::spanning(-1.0, 1.0))
}

/// What drives give way by at least: of each its compliance times the square of what it moves, above its tangent there.
fn squares<const N: usize>(moved: &[(Affine<N>, Affine<N>)], tangent: impl Fn(&Affine<N>) -> f64) -> Affine<N> {
    moved.iter().fold(Affine::point(0.0), |sum, (k, x)| {
        let at = tangent(x);
        let square = *x * (2.0 * at) + -(at * at);
        sum + if k.radius() == 0.0 { square * k.middle } else { square * *k }
    })
}

/// The angles of vectors with these cosines and sines, up to a common length; `None` where they point more than a quarter
/// turn apart.
fn angle<const N: usize>(cos: Affine<N>, sin: Affine<N>) -> Option<Interval> {
    let (from_s, from_c) = (sin.middle, cos.middle);
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

/// Some angle `from` lies in the range, and still does, whole turns left as they are, when it has `turned` on.
fn stays_within(range: Interval, from: Interval, turned: Interval) -> bool {
    let wide = Interval::spanning(range.min() - SLACK, range.max() + SLACK);
    turned_into(range, from).any(|from| wide.intersect(from.plus(turned)).is_some())
}

/// The angles with all whole turns added with which some of them lie in the range; as they are where it has no ends.
fn turned_into(range: Interval, angles: Interval) -> impl Iterator<Item = Interval> {
    let wide = Interval::spanning(range.min() - SLACK, range.max() + SLACK);
    let (first, turns) = if wide.is_bounded() {
        (((wide.min() - angles.max()) / TAU).ceil(), (wide.width() / TAU) as usize + 2)
    } else {
        (0.0, 1)
    };
    (0..turns)
        .map(move |turn| angles.affine(1.0, (first + turn as f64) * TAU))
        .filter(move |turned| wide.intersect(*turned).is_some())
}

/// The squared distances at which the limits allow the angle between the links, elbow up (`sign` 1) or down (-1).
fn ring(arm: &SpatialArm, sign: f64) -> Option<Interval> {
    let Limits { elbow, third_axis, joints, .. } = &arm.limits;
    let (l2, l3, lean) = (arm.geometry.c2, arm.geometry.l3(), arm.geometry.lean());
    // The bend from a stretched arm, 0 to pi, is theta3 + lean, or its negative.
    let bends = |theta_3: Interval| bends(theta_3.affine(sign, sign * lean));
    let mut allowed = bends(elbow.affine(-1.0, PI))?.intersect(Interval::spanning(CLEAR, PI - CLEAR))?;
    if *third_axis == ThirdAxis::Elbow {
        allowed = allowed.intersect(bends(arm.geometry.theta(2, joints[2]))?)?;
    }
    let square = |bend: f64| l2 * l2 + l3 * l3 + 2.0 * l2 * l3 * bend.cos();
    let hair = 1e-11 * (l2 + l3) * (l2 + l3);
    Some(Interval::spanning((square(allowed.max()) - hair).max(0.0), square(allowed.min()) + hair))
}

/// The smallest range that holds what a range of angles shares with `0..pi`, up to whole turns.
fn bends(angles: Interval) -> Option<Interval> {
    let all = Interval::spanning(0.0, PI);
    if !angles.is_bounded() || TAU <= angles.width() {
        return Some(all);
    }
    let wide = Interval::spanning(angles.min() - SLACK, angles.max() + SLACK);
    let first = (-wide.max() / TAU).ceil();
    [0.0, 1.0, 2.0]
        .into_iter()
        .filter_map(|turn| wide.affine(1.0, (first + turn) * TAU).intersect(all))
        .reduce(|a, b| Interval::spanning(a.min().min(b.min()), a.max().max(b.max())))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::drive::{GravityCompensator, JointCompliance, Transmission};
    use crate::inverse::{postures, within_limits};
    use crate::robot::{Arm, Robot};
    use crate::space::middle;
    use crate::spatial::Pose;

    /// A robot of the paper with other drives and an offset; every other one with a geared wrist and a compensator.
    fn robot(n: usize, rng: &mut fastrand::Rng) -> Robot {
        let mut robot = paper_robots().swap_remove(n % 10);
        let Arm::SixAxis { geometry, drives, .. } = &mut robot.arm else { unreachable!("six axes") };
        drives.compliance = JointCompliance(std::array::from_fn(|_| 1e-6 * (0.3 + 3.0 * rng.f64())));
        if n.is_multiple_of(3) {
            geometry.b = 0.2 * (rng.f64() - 0.5);
        }
        if n.is_multiple_of(2) {
            let coupled = |i: usize, j: usize| if i >= 3 && j >= 3 && j < i { 0.1 * (i + j) as f64 } else { 0.0 };
            drives.transmission = Transmission(drives.transmission.0 + nalgebra::Matrix6::from_fn(coupled));
        }
        if n % 4 < 2 {
            let (base, arm) = ([-0.5, -0.1], [0.05, 0.4]);
            drives.compensator = Some(GravityCompensator { base, arm, stiffness: 2e5, free_length: 0.3 });
        }
        robot
    }

    #[test]
    fn no_stand_of_a_box_is_stiffer_than_it_says_or_held_where_it_says_none_is() {
        let mut rng = fastrand::Rng::with_seed(33);
        let (mut held, mut useful, mut refused) = (0, 0, 0);
        for n in 0..6000 {
            let robot = robot(n, &mut rng);
            let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
            let tool = Pose::new(
                Vector3::new(part(-0.2, 0.2), part(-0.2, 0.2), part(0.0, 0.4)),
                Vector3::new(part(-0.3, 0.3), part(-0.3, 0.3), part(-3.0, 3.0)),
            );
            let tool = if n % 5 < 2 { Pose::translation(0.0, 0.0, 0.3) } else { tool };
            let arm = SpatialArm::new(&robot, &tool).unwrap();
            let elevation = [-FRAC_PI_2, 0.0, part(-1.5, 1.5)][n % 3];
            let width = [0.4, 0.1, 0.02][n / 3 % 3];
            let from = [part(-2.3, 2.3), part(0.0, 2.2), part(-1.5, 1.5), part(0.0, 3.0), part(0.0, 6.0)];
            let stands: StandBox = from.map(|from| Interval::spanning(from, from + width * part(0.1, 1.0)));
            let enclosing = Enclosing::new(&arm, [false; 6]);
            let aim = enclosing.aim::<5>(elevation, &stands);
            let at = [part(-0.3, 0.3), part(-0.3, 0.3)];
            let variables: [f64; 5] = std::array::from_fn(|_| part(-1.0, 1.0));
            let place: [f64; 5] = std::array::from_fn(|i| stands[i].middle() + variables[i] * stands[i].width() / 2.0);
            let [x, z, yaw, angle, roll] = place;
            let stand = Stand { x, z, yaw, angle, roll };
            let patch = Patch::of(elevation, &stand);
            let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!("six axes") };
            let flange = |at| patch.pose(&stand, at) * tool.inverse();
            let (here, centre) = (postures(geometry, &flange(at)), postures(geometry, &flange([0.0; 2])));
            for (class, theta) in here.found {
                let back = class.shoulder == Shoulder::Back;
                let way = Way { back, down: class.elbow == Elbow::Down };
                let mut wrists = [class.wrist == Wrist::NoFlip, class.wrist == Wrist::Flip];
                let asked = wrists;
                let mut at_centre = Known::default();
                let facing = enclosing.learn(&aim, [0.0; 2], way, None, &mut asked.clone(), &mut at_centre).flatten();
                // A posture that turned too far since the centre is none that the facing there speaks of.
                let begun = centre.found.iter().find(|(other, _)| *other == class).map(|found| found.1);
                let near = begun.is_some_and(|begun| {
                    FACING.iter().all(|&i| {
                        let turned = theta[i] - begun[i] - ((theta[i] - begun[i]) / TAU).round() * TAU;
                        let range = geometry.theta(i, limits.joints[i]);
                        let goes_on = |turns: i32| {
                            let from = begun[i] + f64::from(turns) * TAU;
                            range.contains(from, 0.0) && range.contains(from + turned, 0.0)
                        };
                        turned.abs() < FRAC_PI_2 && (-4..=4).any(goes_on)
                    })
                });
                let facing = if near { facing } else { None };
                let mut known = Known::default();
                let mut spread = Spread::default();
                let from = facing.as_ref().map(|facing| (facing, &mut spread));
                let learnt = enclosing.learn(&aim, at, way, from, &mut wrists, &mut known);
                let Some(q) = within_limits(geometry, limits, &theta) else {
                    refused += usize::from(learnt.is_none());
                    continue;
                };
                held += 1;
                let what = || format!("{n} {}: {class} at {stand:?} in {stands:?}", robot.name);
                assert!(learnt.is_some() && wrists == asked, "{}", what());
                let Ok(posture) = compliance(&robot, &q, &tool) else { continue };
                let (value, _) = posture.compliance.worst();
                let linear = |x: &Affine<5>| x.middle + (0..5).map(|i| x.slope[i] * variables[i]).sum::<f64>();
                for found in &known.values {
                    assert!(linear(found) - found.rest <= value * (1.0 + 1e-9), "{} {found:?} {value}", what());
                    useful += usize::from(0.5 * value < found.min());
                }
                for limit in &known.limits {
                    assert!(-1e-9 <= linear(limit) + limit.rest, "{} {limit:?}", what());
                }
            }
            assert!(stands[0].contains(middle(&stands).x, 0.0));
        }
        assert!(4000 < held && 2000 < useful && 4000 < refused, "{held} held, {useful} useful, {refused} refused");
    }
}
