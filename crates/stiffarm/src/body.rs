//! How thick is a robot? Radii of capsules along the lines of its links, or capsules that enclose its links.

use nalgebra::{Point3, Vector3};

use crate::geometry::Geometry;
use crate::limits::Limits;

/// An estimated column is so many times the fourth root of payload, kg, times reach, m.
const COLUMN_BY_BOTH: f64 = 0.085;
/// Or so many times the reach, where no payload is known.
const COLUMN_BY_REACH: f64 = 0.15;

/// Of the capsules along the links, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// About the joint-1 axis, up to the height of the joint-2 axis.
    pub column: f64,
    /// Joint-2 axis to elbow.
    pub upper_arm: f64,
    /// Elbow to wrist centre.
    pub forearm: f64,
    /// Wrist centre to flange.
    pub wrist: f64,
}

/// All points within a radius of a straight line from end to end: a piece of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Of the line, m, in the axes of the base.
    pub ends: [Vector3<f64>; 2],
    /// m.
    pub radius: f64,
}

/// Capsules that enclose every point of the links. What is fixed to them later (cables, hoses) is in none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Enclosing {
    /// Of the base, and of the links that the joints 1 to 6 turn, at model zero: all model angles zero, upper arm and forearm upright; none of a link
    /// without a body.
    pub links: [Vec<Capsule>; 7],
    /// Pairs of links, the lower one first, whose bodies touch in every posture, as nested ones do: they are not compared.
    pub not_compared: Vec<[usize; 2]>,
}

/// The pair of bodies, the lower one first, may meet: between them others stand. The base is 0, what the joints turn 1 to 6, the tool 7. Neighbours
/// are joined, and what limits keep apart is not compared.
pub const fn may_meet([low, high]: [usize; 2]) -> bool {
    matches!((low, high), (0 | 1, 3..) | (2, 5..))
}

impl Enclosing {
    /// Bodies inside of which nine arms in ten lie, where nobody says what encloses the links: about a foot that is longer behind, a shoulder, an upper
    /// arm that may lie to either side of its joints' line, an elbow with the drives about it, a forearm and a wrist. Thick by `t = m^(1/8) L^(1/2)`, with the payload `m` in kg and the
    /// reach `L` in m; the forearm by `m^(1/8)`, the wrist by `m^(1/4)`, as wrists are of one size at any reach.
    ///
    /// Nine in ten of those whose meshes are published (115 of five makers); the others stand out by up to 0.04 `t`. Not for links against each other:
    /// the limits keep column and elbow apart, which are so thick that they would touch in a third of all postures.
    pub fn estimated(geometry: &Geometry, payload_kg: Option<f64>, reach: f64) -> Self {
        // Where both guesses of the column are equal.
        let kg = payload_kg.unwrap_or_else(|| (COLUMN_BY_REACH / COLUMN_BY_BOTH).powi(4) * reach.powi(3));
        let by_payload = kg.sqrt().sqrt().sqrt();
        let (t, w) = (by_payload * reach.sqrt(), by_payload * by_payload);
        let Geometry { a1, b, c1, c4, .. } = *geometry;
        let [_, shoulder, elbow, wrist, _] = geometry.points(&[0.0; 6]).map(Vector3::from);
        let (up, aside) = (Vector3::z(), Vector3::y());
        let capsule = |from: Vector3<f64>, to: Vector3<f64>, radius: f64| Capsule { ends: [from, to], radius };
        let foot = up * 0.06 * t;
        let (lower, shoulder_height) = (up * (c1 - 0.2 * t).max(0.06 * t), up * (c1 - 0.04 * t));
        // An arm that stands on its foot swings over the floor.
        let arm = if 0.0 < c1 { (0.165 * t).min(0.9 * c1) } else { 0.165 * t };
        let housing = (elbow + Vector3::new(wrist.x, wrist.y, elbow.z)) / 2.0 - Vector3::x() * 0.02 * t;
        let links = [
            vec![capsule(foot, foot - Vector3::x() * 0.16 * t, 0.22 * t), capsule(foot, lower, 0.24 * t)],
            vec![capsule(shoulder_height, Vector3::new(a1, b, shoulder_height.z), 0.27 * t)],
            [0.1, -0.1].map(|side| aside * side * t).map(|to| capsule(shoulder + to, elbow + to, arm)).to_vec(),
            vec![
                capsule(housing - up * 0.05 * t, housing + up * 0.05 * t, 0.26 * t),
                capsule(Vector3::new(wrist.x, wrist.y, elbow.z), wrist, 0.15 * by_payload),
            ],
            vec![],
            vec![capsule(wrist, wrist, 0.08 * w), capsule(wrist, wrist + up * (c4 - 0.035 * w).max(0.0), 0.068 * w)],
            vec![],
        ];
        Self { links, not_compared: Vec::new() }
    }

    /// Of the pairs that may meet, those whose capsules touch in all of a thousand postures within the limits.
    pub fn always_touching(&self, geometry: &Geometry, limits: &Limits) -> Vec<[usize; 2]> {
        const POSTURES: usize = 1000;
        let mut rng = fastrand::Rng::with_seed(2);
        let mut pairs: Vec<[usize; 2]> = (0..7).flat_map(|high| (0..high).map(move |low| [low, high])).collect();
        pairs.retain(|pair| may_meet(*pair));
        for _ in 0..POSTURES {
            let q = limits.joints.map(|range| range.min() + rng.f64() * range.width());
            let moved = geometry.links(&geometry.model_angles(&q, limits.third_axis));
            let stands = |link: usize, capsule: &Capsule| {
                let end = |end: Vector3<f64>| match link.checked_sub(1) {
                    None => end,
                    Some(i) => (moved[i] * Point3::from(end)).coords,
                };
                Capsule { ends: capsule.ends.map(end), ..*capsule }
            };
            let of = |link: usize| self.links[link].iter().map(move |capsule| (link, capsule));
            let touch = |[low, high]: &[usize; 2]| {
                of(*high).any(|(link, one)| {
                    let one = stands(link, one);
                    of(*low).any(|(link, other)| one.touches(&stands(link, other)))
                })
            };
            pairs.retain(touch);
        }
        pairs
    }
}

impl Capsule {
    /// They share a point: their lines come nearer than both radii. The nearest points of two lines from end to end, by parts s and t of them, by
    /// turns: each step can only come nearer, and of two convex sets it ends at the nearest.
    pub fn touches(&self, other: &Self) -> bool {
        let reach = self.radius + other.radius;
        let [along, across] = [self, other].map(|one| one.ends[1] - one.ends[0]);
        let between = other.ends[0] - self.ends[0];
        let (aa, bb, ab) = (along.norm_squared(), across.norm_squared(), along.dot(&across));
        let part = |dot: f64, of: f64| if 0.0 < of { (dot / of).clamp(0.0, 1.0) } else { 0.0 };
        let apart = aa * bb - ab * ab;
        // Where both lines go on without ends; parallel ones begin anywhere.
        let s = part(along.dot(&between) * bb - ab * across.dot(&between), apart.max(0.0));
        let t = part((along * s - between).dot(&across), bb);
        let s = part((across * t + between).dot(&along), aa);
        let t = part((along * s - between).dot(&across), bb);
        (along * s - across * t - between).norm() < reach
    }

    /// No point of it is farther from a point, m.
    pub fn farthest_from(&self, point: &Vector3<f64>) -> f64 {
        self.ends.iter().map(|end| (end - point).norm()).fold(0.0, f64::max) + self.radius
    }
}

impl Body {
    /// A guess where no radius is known: a column of `0.085 (m L)^(1/4)`, m, with the payload `m` in kg and the reach `L` in m, or of
    /// `0.15 L` where no payload is known; upper arm, forearm and wrist of 0.55, 0.45 and 0.33 of that.
    ///
    /// Coarse: half the width of the base plates of common robots lies within a third of it, from 90 mm (3 kg, 0.6 m) to 400 mm (500 kg,
    /// 2.6 m).
    pub fn estimated(payload_kg: Option<f64>, reach: f64) -> Self {
        let column = payload_kg.map_or(COLUMN_BY_REACH * reach, |kg| COLUMN_BY_BOTH * (kg * reach).sqrt().sqrt());
        Self { column, upper_arm: 0.55 * column, forearm: 0.45 * column, wrist: 0.33 * column }
    }

    /// By how much real links stand out of estimated ones, m, at most in nine arms of ten: column, upper arm, forearm and wrist.
    ///
    /// 1.08, 1.54, 1.29 and 0.31 of the estimated column's radius, by the 115 arms whose links capsules enclose. Columns carry motors, upper arms lie to
    /// one side of their joints' line, drives stand behind the elbow. The foot is not in it: plugs on its back stand out by up to twice that radius.
    pub fn outside(&self) -> [f64; 4] {
        [1.08, 1.54, 1.29, 0.31].map(|part| part * self.column)
    }

    /// Of a spindle that fits the wrist: six tenths of its radius, m.
    pub fn spindle(&self) -> f64 {
        0.6 * self.wrist
    }
}

impl From<[f64; 4]> for Body {
    fn from([column, upper_arm, forearm, wrist]: [f64; 4]) -> Self {
        Self { column, upper_arm, forearm, wrist }
    }
}

impl From<Body> for [f64; 4] {
    fn from(body: Body) -> Self {
        [body.column, body.upper_arm, body.forearm, body.wrist]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::find;
    use crate::robot::Arm;

    /// Against the least over many points of both.
    #[test]
    fn capsules_touch_where_their_lines_come_near() {
        let mut rng = fastrand::Rng::with_seed(1);
        let mut any = || Vector3::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
        let (mut near, mut far) = (0, 0);
        for i in 0..400 {
            let [a, b, c, d] = [any(), any(), any(), any()];
            // Some are parallel, some are points.
            let d = if i % 5 == 0 {
                c + (b - a) * 0.7
            } else if i % 7 == 0 {
                c
            } else {
                d
            };
            let at = |from: Vector3<f64>, to: Vector3<f64>, k: usize| from.lerp(&to, k as f64 / 200.0);
            let distances = (0..=200).flat_map(|j| (0..=200).map(move |k| (j, k)));
            let least = distances.map(|(j, k)| (at(a, b, j) - at(c, d, k)).norm()).fold(f64::INFINITY, f64::min);
            let touch = |reach: f64| {
                let [one, other] = [(a, b), (c, d)].map(|(from, to)| Capsule { ends: [from, to], radius: reach / 2.0 });
                one.touches(&other)
            };
            // Points lie up to a two-hundredth of 3.5 m apart.
            assert!(touch(least + 1e-9) && (least < 0.03 || !touch(least - 0.02)), "{i}: {least}");
            (near, far) = (near + usize::from(least < 0.1), far + usize::from(0.3 < least));
        }
        assert!(20 < near && 100 < far, "{near} {far}");
    }

    #[test]
    fn links_that_touch_wherever_the_arm_stands_are_found() {
        let robot = find("KR 210 R2700 extra").unwrap().robot();
        let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!("it has six axes") };
        let [foot, shoulder, elbow, wrist, _] = geometry.points(&[0.0; 6]).map(Vector3::from);
        let ball = |at: Vector3<f64>, radius: f64| vec![Capsule { ends: [at, at], radius }];
        let touching = |fore: f64| {
            let links = [
                ball(foot, 0.1),
                ball(shoulder, 0.2),
                ball(elbow, 0.1),
                ball(elbow, fore),
                ball(wrist, 0.1),
                ball(wrist, 0.1),
                vec![],
            ];
            Enclosing { links, not_compared: Vec::new() }.always_touching(geometry, limits)
        };
        // Elbow and shoulder stay 1.15 m apart: 1 m about the elbow always touches 0.2 m about the shoulder, 0.9 m never does.
        assert_eq!(touching(1.0), [[1, 3]]);
        assert_eq!(touching(0.9), Vec::<[usize; 2]>::new());
    }

    /// Half the width of the base plate, m, by payload, kg, and reach, m, of robots from the smallest to the largest.
    #[test]
    fn an_estimated_column_is_about_as_thick_as_base_plates_are() {
        for (kg, reach, half_width) in
            [(3.0, 0.58, 0.09), (20.0, 1.65, 0.256), (185.0, 2.8, 0.36), (500.0, 2.55, 0.395)]
        {
            for body in [Body::estimated(Some(kg), reach), Body::estimated(None, reach)] {
                assert!((body.column / half_width - 1.0).abs() < 0.35, "{kg} kg: {body:?}");
            }
        }
        // 0.085 x (81 x 1)^(1/4) = 0.255.
        let body = Body::estimated(Some(81.0), 1.0);
        let by_hand = [0.255, 0.14025, 0.11475, 0.08415];
        assert!(<[f64; 4]>::from(body).iter().zip(by_hand).all(|(a, b)| (a - b).abs() < 1e-12), "{body:?}");
        assert!((body.spindle() - 0.05049).abs() < 1e-12);
    }
}
