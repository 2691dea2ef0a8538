//! Where do the links of a robot stand in a posture?

use nalgebra::Vector3;

use super::{Link, Solid};
use crate::body::{Body, Capsule, Enclosing};
use crate::geometry::Geometry;
use crate::spatial::Pose;

/// What is nearer to the joint-1 axis, m, is not moved by it.
const ON_AXIS: f64 = 1e-9;

/// The tool as a link: its point in the flange frame, m, and the radius of what stands between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tool {
    pub(super) point: Vector3<f64>,
    pub(super) radius: f64,
}

/// A piece of the arm in one posture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// As answers name it.
    pub(super) link: Link,
    /// The base is 0, what joint 1 turns 1, and so on; the tool is 7.
    pub(super) number: usize,
    pub(super) capsule: Capsule,
}

impl Piece {
    /// No joint moves it: the base, and what of the column stands about the joint-1 axis.
    pub(super) fn stands_still(&self) -> bool {
        let is_on_axis = |end: &Vector3<f64>| end.xy().norm() < ON_AXIS;
        self.number == 0 || self.number == 1 && self.capsule.ends.iter().all(is_on_axis)
    }

    /// What no joint moves stands where it is put, and the column above what carries it.
    pub(super) fn is_carried_by(&self, solid: &Solid) -> bool {
        self.stands_still() || self.link == Link::Column && solid.is_below_base()
    }
}

impl Link {
    /// Of which link of an answer a body is a part, by its number.
    const fn of(number: usize) -> Self {
        match number {
            0 | 1 => Self::Column,
            2 => Self::UpperArm,
            3 | 4 => Self::Forearm,
            5 | 6 => Self::Wrist,
            _ => Self::Tool,
        }
    }
}

/// What the tool is.
pub(super) const TOOL: usize = 7;
/// The base, six links and the tool.
pub(super) const LINKS: usize = 8;

fn tool_of(geometry: &Geometry, theta: &[f64; 6], tool: Option<Tool>) -> Option<Piece> {
    let tool = tool?;
    let flange: Pose = geometry.forward(theta);
    Some(piece_of_tool([flange.translation.vector, flange.transform_point(&tool.point.into()).coords], tool))
}

/// From the flange to the tool point, m from the base.
pub(super) fn piece_of_tool(ends: [Vector3<f64>; 2], tool: Tool) -> Piece {
    Piece { link: Link::Tool, number: TOOL, capsule: Capsule { ends, radius: tool.radius } }
}

/// Capsules that enclose the links at model angles, m from the base, on a pedestal of this height about the joint-1 axis.
pub(super) fn enclosed(
    geometry: &Geometry,
    enclosing: &Enclosing,
    (pedestal, column): (f64, f64),
    theta: &[f64; 6],
    tool: Option<Tool>,
) -> Vec<Piece> {
    let moved = geometry.links(theta);
    let mut pieces = Vec::with_capacity(2 + enclosing.links.iter().map(Vec::len).sum::<usize>());
    if 0.0 < pedestal {
        let ends = [Vector3::new(0.0, 0.0, -pedestal), Vector3::zeros()];
        pieces.push(Piece { link: Link::Column, number: 0, capsule: Capsule { ends, radius: column } });
    }
    for (number, capsules) in enclosing.links.iter().enumerate() {
        pieces.extend(capsules.iter().map(|Capsule { ends, radius }| {
            let stands = |end: &Vector3<f64>| match number.checked_sub(1) {
                None => *end,
                Some(i) => moved[i].transform_point(&(*end).into()).coords,
            };
            let capsule = Capsule { ends: ends.each_ref().map(stands), radius: *radius };
            Piece { link: Link::of(number), number, capsule }
        }));
    }
    pieces.extend(tool_of(geometry, theta, tool));
    pieces
}

/// Capsules along the links at model angles, m from the base, the column from so far below it; some links have two.
///
/// The wrist ends at the flange, or, where it is thicker than long, is a ball about its centre. The column stands on the joint-1 axis and reaches out to the joint-2 axis as thick as the upper arm; the forearm keeps its
/// offset from the elbow.
pub(super) fn links(
    geometry: &Geometry,
    body: &Body,
    pedestal: f64,
    theta: &[f64; 6],
    tool: Option<Tool>,
) -> Vec<Piece> {
    let [t1, t2, t3, ..] = *theta;
    let [_, shoulder, elbow, wrist, flange] = geometry.points(theta).map(Vector3::from);
    let (s1, c1) = t1.sin_cos();
    let (s23, c23) = (t2 + t3).sin_cos();
    let bend = elbow + geometry.a2 * Vector3::new(c1 * c23, s1 * c23, -s23);
    let foot = Vector3::new(0.0, 0.0, -pedestal);
    let top = Vector3::new(0.0, 0.0, geometry.c1);
    // Its round end does not reach beyond the flange.
    let shown = (1.0 - body.wrist / geometry.c4.abs().max(body.wrist)).max(0.0);
    let piece = |number, ends: [Vector3<f64>; 2], radius| Piece {
        link: Link::of(number),
        number,
        capsule: Capsule { ends, radius },
    };
    let mut pieces = vec![
        piece(1, [foot, top], body.column),
        piece(1, [top, shoulder], body.upper_arm),
        piece(2, [shoulder, elbow], body.upper_arm),
        piece(3, [elbow, bend], body.forearm),
        piece(3, [bend, wrist], body.forearm),
        piece(5, [wrist, wrist + (flange - wrist) * shown], body.wrist),
    ];
    pieces.extend(tool_of(geometry, theta, tool));
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{find, robots};
    use crate::clearance::{Looked, Surroundings, ThickArm};
    use crate::robot::{Arm, Robot};

    /// Kinematics and distances of `MuJoCo` (`scripts/distances.py`).
    #[test]
    fn links_are_as_near_as_another_program_has_them() {
        /// So many rows have bodies, and after them so many radii; of the rest neither is known.
        const ENCLOSED: usize = 30;
        let recorded = include_str!("../../../../validation/link_distances.csv").lines().skip(2);
        let mut overlaps = 0;
        for (i, case) in recorded.map(|line| line.split(',').collect::<Vec<_>>()).enumerate() {
            let &[name, angles, links, floor] = case.as_slice() else { panic!("{case:?}") };
            let theta: Vec<f64> = angles.split(' ').map(|deg| deg.parse::<f64>().unwrap().to_radians()).collect();
            let [links, floor] = [links, floor].map(|mm| mm.parse::<f64>().unwrap() / 1e3);
            let robot = find(name).unwrap().robot();
            let radii = Robot { body: Some(robot.thickness().0), enclosing: None, ..robot.clone() };
            let robot = if (ENCLOSED..2 * ENCLOSED).contains(&i) { radii } else { robot };
            assert_eq!(robot.enclosing.is_some(), i < ENCLOSED);
            let arm = ThickArm::new(&robot, &Pose::identity(), None).unwrap();
            let theta: [f64; 6] = theta.try_into().unwrap();
            let floored = Surroundings::above(Some(-0.25));
            let nearest = |about| arm.nearest(&theta, (about, 0), Looked::ALL).unwrap().distance;
            let wide = arm.nearest_wide(&theta, (&floored, 0), Looked::ALL).map(|near| near.distance);
            let found = [nearest(&Surroundings::default()), wide.unwrap_or_else(|| nearest(&floored))];
            let expected = [links, if wide.is_some() { floor } else { links.min(floor) }];
            assert_eq!(wide.is_some(), 2 * ENCLOSED <= i);
            // As many digits as are written.
            assert!(
                found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9),
                "{name} {angles}: {found:?} {expected:?}"
            );
            overlaps += usize::from(links < 0.0);
        }
        assert_eq!(overlaps, 3);
    }

    /// Of the arms whose links capsules enclose: their geometry, those capsules, and what is known of them otherwise.
    fn known() -> impl Iterator<Item = Robot> {
        robots().into_iter().filter(|robot| robot.enclosing.is_some())
    }

    /// Nine arms in ten lie inside of what such an arm is estimated to be, wherever joints 4 and 6 stand; not as many of every maker.
    #[test]
    fn nine_known_arms_in_ten_lie_inside_of_their_estimate() {
        const TURNS: usize = 4;
        const GROUPS: [&[usize]; 5] = [&[0], &[1], &[2], &[3, 4], &[5, 6]];
        let directions: Vec<Vector3<f64>> = (0..40)
            .map(|i| {
                let (z, turn) = (f64::from(2 * i + 1) / 40.0 - 1.0, 2.4 * f64::from(i));
                Vector3::new(turn.cos(), turn.sin(), 0.0) * (1.0 - z * z).sqrt() + Vector3::z() * z
            })
            .collect();
        let (mut arms, mut inside, mut farthest) = (0, std::collections::BTreeMap::new(), 0.0_f64);
        for robot in known() {
            let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("it has six axes") };
            let estimate = robot.estimated_bodies(geometry);
            let out = (0..TURNS).fold(f64::NEG_INFINITY, |most, turn| {
                let turn = std::f64::consts::TAU * turn as f64 / TURNS as f64;
                let theta = [0.0, 0.0, 0.0, turn, 0.0, -turn];
                let stand = |bodies: &Enclosing| enclosed(geometry, bodies, (0.0, 0.0), &theta, None);
                let (real, estimated) = (stand(robot.enclosing.as_ref().unwrap()), stand(&estimate));
                let out_of = |group: &[usize], point: Vector3<f64>| {
                    let of_group = estimated.iter().filter(|piece| group.contains(&piece.number));
                    let ball = Capsule { ends: [point; 2], radius: 0.0 };
                    of_group.map(|piece| ball.apart_from(&piece.capsule)).fold(f64::INFINITY, f64::min)
                };
                GROUPS.iter().fold(most, |most, group| {
                    let pieces = real.iter().filter(|piece| group.contains(&piece.number));
                    let points = pieces.flat_map(|Piece { capsule: Capsule { ends: [from, to], radius }, .. }| {
                        let along = (0..=8).map(move |k| from.lerp(to, f64::from(k) / 8.0));
                        along.flat_map(|at| directions.iter().map(move |way| at + way * *radius)).collect::<Vec<_>>()
                    });
                    points.map(|point| out_of(group, point)).fold(most, f64::max)
                })
            });
            let t = robot.payload_kg.unwrap_or(10.0).powf(0.125) * robot.reach.unwrap().sqrt();
            (arms, farthest) = (arms + 1, farthest.max(out / t));
            let of_maker = inside.entry(robot.vendor.clone()).or_insert((0, 0));
            *of_maker = (of_maker.0 + usize::from(out <= 0.0), of_maker.1 + 1);
        }
        assert!(arms == 115 && (0.035..=0.04).contains(&farthest), "{arms} {farthest}");
        let by_maker: Vec<_> = inside.iter().map(|(maker, counts)| (maker.as_str(), *counts)).collect();
        let expected =
            [("ABB", (14, 19)), ("Fanuc", (19, 19)), ("KUKA", (35, 36)), ("Staubli", (11, 12)), ("Yaskawa", (26, 29))];
        assert_eq!(by_maker, expected);
    }

    /// By the capsules that enclose them, at model zero, against the slim ones of arms of their payload and reach.
    #[test]
    fn nine_known_arms_in_ten_stand_out_of_slim_links_by_no_more_than_is_stated() {
        const NAMES: [Link; 4] = [Link::Column, Link::UpperArm, Link::Forearm, Link::Wrist];
        let mut parts: [Vec<f64>; 4] = Default::default();
        for robot in known() {
            let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("it has six axes") };
            let body = Body::estimated(robot.payload_kg, robot.reach.unwrap());
            let slim = links(geometry, &body, 0.0, &[0.0; 6], None);
            let out_of = |link: Link, Capsule { ends, radius }: &Capsule| {
                let pieces = || slim.iter().filter(move |piece| piece.link == link);
                let of = |end: &Vector3<f64>| {
                    let ball = Capsule { ends: [*end; 2], radius: 0.0 };
                    pieces().map(|piece| ball.apart_from(&piece.capsule)).fold(f64::INFINITY, f64::min) + radius
                };
                (0..=100).map(|k| of(&ends[0].lerp(&ends[1], f64::from(k) / 100.0))).fold(0.0, f64::max)
            };
            for (i, link) in NAMES.into_iter().enumerate() {
                // Of the column what turns.
                let capsules =
                    (1..7).filter(|&n| Link::of(n) == link).flat_map(|n| &robot.enclosing.as_ref().unwrap().links[n]);
                let out = capsules.map(|capsule| out_of(link, capsule)).fold(0.0, f64::max);
                parts[i].push(out / body.outside()[i]);
            }
        }
        for parts in &mut parts {
            parts.sort_by(f64::total_cmp);
            // Each factor is that of the 104th, with two digits.
            assert!(parts.len() == 115 && (0.985..=1.0).contains(&parts[103]), "{:?}", &parts[100..]);
        }
    }
}
