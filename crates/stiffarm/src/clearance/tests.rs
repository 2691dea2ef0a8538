//! Hand calculations of single postures, and what holds in all.

use std::f64::consts::FRAC_PI_2;

use super::links::{Piece, links};
use super::*;
use crate::body::{Body, Capsule, Enclosing};
use crate::catalogue::find;
use crate::cell::{Block, Mount};
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::robot::{Arm, Robot};
use crate::task::Zone;

/// A robot with round lengths and radii.
fn robot() -> Robot {
    let mut robot = find("KR 210 R2700 extra").unwrap().robot();
    let Arm::SixAxis { geometry, .. } = &mut robot.arm else { unreachable!("it has six axes") };
    *geometry = Geometry { a1: 0.3, a2: 0.0, b: 0.0, c1: 0.7, c2: 1.0, c3: 1.0, c4: 0.2, ..geometry.clone() };
    robot.body = Some(Body::from([0.3, 0.2, 0.15, 0.1]));
    robot
}

fn nearest(robot: &Robot, tool: Option<f64>, theta: [f64; 6], about: &Surroundings) -> (f64, Link, Obstacle) {
    let flange_from_tool = tool.map_or(Pose::identity(), |length| Pose::translation(0.0, 0.0, length));
    let thick = ThickArm::new(robot, &flange_from_tool, Some(0.05)).unwrap();
    let found = thick.clearance(&[theta], about).unwrap();
    assert!(!found.is_estimated && found.knows_tool && found.poses == 1);
    ((found.distance * 1e6).round() / 1e6, found.link, found.to)
}

/// Capsules enclose the links of this arm, and nobody knows its tool.
#[test]
fn what_is_estimated_is_told_of_the_bodies_that_are_nearest() {
    let robot = find("KR 240 R2900-2").unwrap().robot();
    let thick = ThickArm::new(&robot, &Pose::translation(0.0, 0.0, 0.2), None).unwrap();
    let is_estimated = |link: Link, to: Obstacle| {
        let near = Near { distance: 0.1, link, to };
        thick.clearance_of(near, None, 1).is_estimated
    };
    assert!(robot.enclosing.is_some());
    assert!(is_estimated(Link::Tool, Obstacle::Floor));
    assert!(is_estimated(Link::Column, Obstacle::Link(Link::Tool)));
    for link in [Link::Column, Link::UpperArm, Link::Forearm, Link::Wrist, Link::Cutter] {
        assert!(!is_estimated(link, Obstacle::KeepOut(1)), "{link:?}");
    }
}

/// Upper arm up, forearm level at 1.7 m, the wrist centre 1.3 m ahead.
const LEVEL: [f64; 6] = [0.0, 0.0, FRAC_PI_2, 0.0, 0.0, 0.0];
/// The same, the tool down.
const DOWN: [f64; 6] = [0.0, 0.0, FRAC_PI_2, 0.0, FRAC_PI_2, 0.0];

#[test]
fn the_nearest_of_all_links_is_that_of_a_hand_calculation() {
    let (robot, floor) = (robot(), Surroundings::above(Some(0.0)));
    // The joint-2 axis stands 0.7 m high, and the upper arm is 0.2 m thick there.
    assert_eq!(nearest(&robot, None, LEVEL, &floor), (0.5, Link::UpperArm, Obstacle::Floor));
    let far = Solid::Box { pose: Pose::translation(9.0, 0.0, 0.0), half: [0.1; 3] };
    let post = Solid::Box { pose: Pose::translation(1.1, 0.0, 0.7), half: [0.1, 0.1, 0.7] };
    let fenced = Surroundings { keep_out: vec![far, post], ..floor.clone() };
    // 1.7 m - 1.4 m - 0.15 m.
    assert_eq!(nearest(&robot, None, LEVEL, &fenced), (0.15, Link::Forearm, Obstacle::KeepOut(2)));
    // The flange stands 1.5 m high, and the tool point touches the work.
    let disc = Solid::sheet(Zone::Circle { diameter: 0.6 }, Vector3::new(1.3, 0.0, 1.25), Vector3::x(), -Vector3::z());
    let work = Surroundings { work: Some(disc), ..floor };
    assert_eq!(nearest(&robot, Some(0.25), DOWN, &work), (0.25, Link::Wrist, Obstacle::Work));
    // A table 0.1 m under the tool point: the tool counts up to its point.
    let table = Solid::Box { pose: Pose::translation(1.3, 0.0, 1.1), half: [0.2, 0.2, 0.05] };
    let on_a_table = Surroundings { keep_out: vec![table], ..work };
    assert_eq!(nearest(&robot, Some(0.25), DOWN, &on_a_table), (0.1, Link::Tool, Obstacle::KeepOut(1)));
}

/// The joint-2 axis goes round 0.3 m beside that of joint 1 and 0.7 m high, in a ball of 0.2 m: 0.1 m under a slab at 1 m, and 0.3 m deep in one at
/// 0.6 m. A slab on one side leaves a way.
#[test]
fn a_box_in_the_way_of_every_posture_is_known_at_once() {
    let robot = robot();
    let thick = ThickArm::new(&robot, &Pose::identity(), None).unwrap();
    let slab = |from: f64, to: f64, x: f64| {
        let pose = Pose::translation(x, 0.0, f64::midpoint(from, to));
        let half = [5.0, 5.0, (to - from) / 2.0];
        Surroundings { keep_out: vec![Solid::Box { pose, half }], ..Surroundings::default() }
    };
    let (over, about, aside) = (slab(1.0, 2.0, 0.0), slab(0.6, 2.0, 0.0), slab(0.6, 2.0, 5.6));
    // What the arc between two angles adds.
    let arc = 0.01;
    let near = thick.always_nearer(&over, 0.15).unwrap();
    assert!((0.1..0.1 + arc).contains(&near.distance) && near.to == Obstacle::KeepOut(1), "{near:?}");
    let near_about = thick.always_nearer(&about, 0.0).unwrap();
    assert!((-0.3..-0.3 + arc).contains(&near_about.distance), "{near_about:?}");
    assert_eq!([thick.always_nearer(&over, 0.05), thick.always_nearer(&aside, 0.0)], [None, None]);
    // No posture by chance keeps more.
    let mut rng = fastrand::Rng::with_seed(4);
    for _ in 0..500 {
        let theta = [0; 6].map(|_| 6.0 * rng.f64() - 3.0);
        for (surroundings, most) in [(&over, near), (&about, near_about)] {
            let found = thick.nearest(&theta, (surroundings, 0), Looked::ALL).unwrap();
            assert!(found.distance <= most.distance, "{theta:?} {found:?} {most:?}");
        }
    }
}

/// Between the angles that are compared, too: of a box that ends 0.2 m from the joint-1 axis on one side the ball of 0.2 m about the joint-2 axis, 0.3 m
/// from it, is 0.1 m deep where it stands out farthest, which is halfway between two of them.
#[test]
fn a_box_in_the_way_is_so_between_the_angles_that_are_compared() {
    let mut robot = robot();
    let mut enclosing = Enclosing::default();
    let [shoulder, elbow] = [0.7, 1.7].map(|z| Vector3::new(0.3, 0.0, z));
    enclosing.links[2].push(Capsule { ends: [shoulder, elbow], radius: 0.2 });
    robot.enclosing = Some(enclosing);
    let thick = ThickArm::new(&robot, &Pose::identity(), None).unwrap();
    let halfway = 1.0_f64.to_radians();
    let pose = Pose::rotation(Vector3::z() * halfway) * Pose::translation(-4.8, 0.0, 0.0);
    let about = Surroundings { keep_out: vec![Solid::Box { pose, half: [5.0; 3] }], ..Surroundings::default() };
    let near = thick.always_nearer(&about, 0.0).unwrap();
    assert!((-0.1..-0.09).contains(&near.distance) && near.link == Link::UpperArm, "{near:?}");
    assert_eq!(thick.always_nearer(&about, -0.1), None);
}

/// The column is 0.3 m thick about the joint-1 axis: a plinth and a slab carry it, a post 0.31 m beside that axis does not. Whatever joints move
/// keeps out of all: the joint-2 axis stands 0.7 m high, 0.2 m thick, over a plinth of 0.4 m.
#[test]
fn a_box_in_which_the_base_stands_carries_it() {
    let block = |x: [f64; 2], y: [f64; 2], z: [f64; 2]| {
        let [x, y, z] = [x, y, z].map(|[from, to]| Interval::spanning(from, to));
        Some(Block { x, y, z })
    };
    let mut cell = Cell::of(Mount::pedestal(0.0));
    cell.keep_out[0] = block([0.31, 0.5], [-0.1, 0.1], [0.0, 0.3]);
    cell.keep_out[1] = block([-0.4, 0.4], [-0.4, 0.4], [0.0, 0.4]);
    cell.keep_out[2] = block([-2.0, 2.0], [-2.0, 2.0], [-0.3, 0.0]);
    assert_eq!(carrying(&robot(), &cell), [2, 3]);
    let found = nearest(&robot(), None, LEVEL, &Surroundings::of(Some(&cell), None));
    assert_eq!(found, (0.1, Link::UpperArm, Obstacle::KeepOut(2)));
}

#[test]
fn an_arm_that_folds_back_meets_its_own_column() {
    let robot = robot();
    // Upper arm forwards and level at 0.7 m, the forearm back over it: the wrist centre at 0.3 m, 0.7 m high.
    let theta = [0.4, FRAC_PI_2, std::f64::consts::PI, 0.0, 0.0, 0.0];
    let (distance, link, to) = nearest(&robot, None, theta, &Surroundings::default());
    // The flange lies 0.1 m before the joint-1 axis; the lines of both run into each other.
    assert_eq!((distance, link, to), (-0.35, Link::Forearm, Obstacle::Link(Link::Column)));
}

/// A tool across the flange, 0.6 m long, that the wrist bends back over the forearm: the nearer the straighter it lies there. Its root, nearer to the
/// wrist centre than both are thick, is carried by the forearm and meets nothing.
#[test]
fn a_tool_that_is_folded_back_meets_the_forearm() {
    let robot = robot();
    let across = Pose::translation(0.6, 0.0, 0.0);
    let thick = ThickArm::new(&robot, &across, Some(0.05)).unwrap();
    let at = |bend: f64| {
        let theta = [0.0, 0.0, FRAC_PI_2, 0.0, bend, 0.0];
        let near = thick.clearance(&[theta], &Surroundings::default()).unwrap();
        (near.distance, near.link, near.to)
    };
    // The tool's line from W: 0.2 m along the flange axis, then across. At a bend b a point s of it lies |0.2 cos b - s sin b| ahead of W or behind it and
    // 0.2 sin b + s cos b off the forearm's line. Compared from s^2 = (0.15 + 0.05)^2 - 0.2^2 = 0 on to 0.55.
    for bend in [1.2_f64, 1.5, 1.8, 2.2, 2.5] {
        let (s, c) = bend.sin_cos();
        let nearest = (0..=5500).map(|i| f64::from(i) * 1e-4).map(|at| {
            let (ahead, off) = (0.2 * c - at * s, 0.2 * s + at * c);
            off.hypot(ahead.max(0.0)) - 0.2
        });
        let by_hand = nearest.fold(f64::INFINITY, f64::min);
        let (distance, link, to) = at(bend);
        if by_hand < -1e-3 {
            assert!((distance - by_hand).abs() < 1e-4, "{bend}: {distance} is not {by_hand}");
            assert_eq!((link, to), (Link::Tool, Obstacle::Link(Link::Forearm)));
        } else {
            assert_ne!(to, Obstacle::Link(Link::Forearm), "{bend}: {distance}, {by_hand}");
        }
    }
}

/// Capsules that stand where those along the lines of the arm do are as near to everything, in every posture.
#[test]
fn enclosing_capsules_move_with_their_links() {
    let coarse = robot();
    let Arm::SixAxis { geometry, .. } = &coarse.arm else { unreachable!("it has six axes") };
    let mut enclosing = Enclosing::default();
    for piece in links(geometry, &coarse.thickness().0, 0.0, &[0.0; 6], None) {
        enclosing.links[piece.number].push(piece.capsule);
    }
    let enclosed = Robot { enclosing: Some(enclosing), ..coarse.clone() };
    let post = Solid::Box { pose: Pose::translation(1.1, 0.2, 0.7), half: [0.1, 0.1, 0.7] };
    let about = Surroundings { keep_out: vec![post], ..Surroundings::above(Some(0.0)) };
    let mut rng = fastrand::Rng::with_seed(4);
    let mut met = Vec::new();
    for _ in 0..300 {
        let theta: [f64; 6] = std::array::from_fn(|_| 4.0 * (rng.f64() - 0.5));
        let [a, b] = [&coarse, &enclosed].map(|robot| nearest(robot, Some(0.3), theta, &about));
        assert!((a.0 - b.0).abs() < 2e-6 && a.1 == b.1 && a.2 == b.2, "{a:?} {b:?}");
        met.push(a.2);
    }
    for to in [Obstacle::Floor, Obstacle::KeepOut(1), Obstacle::Link(Link::Column)] {
        assert!(met.contains(&to), "{to:?}");
    }
    // A pair that is not compared is not.
    let folded = [0.4, FRAC_PI_2, std::f64::consts::PI, 0.0, 0.0, 0.0];
    let near = |robot: &Robot| nearest(robot, None, folded, &Surroundings::default());
    assert_eq!(near(&enclosed).0, -0.35);
    let mut left_out = enclosed;
    left_out.enclosing.as_mut().unwrap().not_compared = vec![[1, 3]];
    assert!(-0.35 < near(&left_out).0);
}

#[test]
fn no_point_of_a_capsule_is_farther_from_an_axis_than_it_is_said_to_be() {
    let mut robot = robot();
    let mut rng = fastrand::Rng::with_seed(6);
    let mut any = |at: Vector3<f64>| at + Vector3::from_fn(|_, _| 0.6 * (rng.f64() - 0.5));
    let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("it has six axes") };
    let [foot, shoulder, elbow, wrist, flange] = geometry.points(&[0.0; 6]).map(Vector3::from);
    let links = [foot, shoulder, elbow, elbow, wrist, wrist, flange].map(|at| {
        vec![Capsule { ends: [any(at), any(at)], radius: 0.1 }, Capsule { ends: [any(at), any(at)], radius: 0.2 }]
    });
    robot.enclosing = Some(Enclosing { links, not_compared: Vec::new() });
    let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("it has six axes") };
    let thick = ThickArm::new(&robot, &Pose::translation(0.1, 0.0, 0.3), None).unwrap();
    let (said, mut seen) = (thick.farthest(0.0), [0.0_f64; 6]);
    for _ in 0..2000 {
        let theta: [f64; 6] = std::array::from_fn(|_| 6.0 * (rng.f64() - 0.5));
        let axes = geometry.axes(&theta);
        for Piece { number, capsule, .. } in thick.pieces(&theta, 0.0) {
            for (joint, (along, through)) in axes.iter().enumerate().take(number.min(6)) {
                let off = |end: &Vector3<f64>| (end - through).cross(along).norm() + capsule.radius;
                seen[joint] = seen[joint].max(capsule.ends.iter().map(off).fold(0.0, f64::max));
            }
        }
    }
    for (seen, said) in seen.iter().zip(said) {
        assert!(*seen <= said && said < 2.0 * seen, "{seen} {said}");
    }
}

#[test]
fn of_two_links_the_wrist_touches_the_work() {
    let robot = robot();
    let thick = ThickArm::to_wrist(&robot).unwrap();
    // Upper arm level forwards at 0.7 m, forearm straight down to -0.3 m, and 0.15 m of it are left out.
    let theta = [0.0, FRAC_PI_2, FRAC_PI_2, 0.0, 0.0, 0.0];
    let found = thick.clearance(&[theta], &Surroundings::above(Some(0.0))).unwrap();
    assert!((found.distance + 0.3).abs() < 1e-12 && found.link == Link::Forearm && !found.knows_tool, "{found:?}");
}
