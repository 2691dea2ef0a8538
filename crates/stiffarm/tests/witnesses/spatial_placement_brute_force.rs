//! Is a place in space what it is said to be, and does any other place, found by brute force, beat it?
//!
//! The witness walks through a zone pose by pose: it sets the zone up from words, asks [`reached`] for the postures of one
//! pose at a time, follows the joints, and takes the eigenvalue of one [`compliance`] at a time. It shares no code with
//! the search, which judges many poses at once by sines and cosines.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use stiffarm::catalogue::{Entry, entries};
use stiffarm::compliance::{beyond_limits, compliance};
use stiffarm::drive::JointCompliance;
use stiffarm::geometry::Geometry;
use stiffarm::interval::Interval;
use stiffarm::inverse::{Configuration, reached};
use stiffarm::limits::Limits;
use stiffarm::load::Load;
use stiffarm::model::Model;
use stiffarm::place::{Column, Orientation, PlaceOptions, Placed, Placement, SpaceHold, Within, place};
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;
use stiffarm::task::Zone;
use stiffarm::watch::Watch;

use crate::cases;
use crate::questions::{Asked, Question, random_question, random_robot};

/// Places along each side of what the arm might reach, and places about the answer, nearer and farther.
const COLUMNS: usize = 16;
const NUDGES: usize = 400;
/// What another place may be better by. The search ends at steps of 0.05 mm and 0.05 mrad; it stops earlier on a ridge
/// between two worst points, and its coarse places are a sixtieth of the reach apart: one part in a hundred in all.
const GAIN: f64 = 0.01;
/// What a limit may be overstepped by, twice what the library allows itself.
const SLACK: f64 = 2e-9;
/// Where a zone stands and how the tool is turned.
#[derive(Clone, Copy, Debug)]
struct Stand {
    centre: [f64; 2],
    bearing: f64,
    yaw: f64,
    angle: f64,
    roll: f64,
}

/// A zone that one class of postures holds.
#[derive(Clone, Copy, Debug)]
struct Held {
    /// The largest translation per force, m/N.
    worst: f64,
    /// The least and the largest angle of every joint, followed without a jump.
    joints: [Interval; 6],
    singular_margin: f64,
    /// How far the angle between the links stays from its limits, rad.
    elbow_room: f64,
    /// The largest change of a joint from one sample to the next, rad.
    pace: f64,
}

fn six_axis(robot: &Robot) -> (&Geometry, &Limits) {
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { panic!("{} has six axes", robot.name) };
    (geometry, limits)
}

impl Stand {
    fn of(placement: &Placement) -> Self {
        let SpaceHold { bearing, yaw, roll, .. } = *placement.space().expect("a place in space");
        Self { centre: placement.centre, bearing, yaw, angle: placement.angle, roll }
    }

    /// The tool at `u` along the first side and `v` along the second.
    ///
    /// On a table the tool hangs down with its x axis ahead and its y axis to the right; the first side points ahead and
    /// turns to the left. The table is then tilted up by `elevation` from straight down, turned by `yaw` to the left about the
    /// vertical through its centre, and by `bearing` about the joint-1 axis.
    fn pose(&self, elevation: f64, [u, v]: [f64; 2]) -> Pose {
        let (s, c) = self.angle.sin_cos();
        let (ahead, left) = (u * c - v * s, u * s + v * c);
        Pose::rotation(Vector3::z() * self.bearing)
            * Pose::translation(self.centre[0], 0.0, self.centre[1])
            * Pose::rotation(Vector3::z() * self.yaw)
            * Pose::rotation(-Vector3::y() * (elevation + FRAC_PI_2))
            * Pose::translation(ahead, left, 0.0)
            * Pose::rotation(Vector3::x() * PI)
            * Pose::rotation(Vector3::z() * self.roll)
    }
}

/// Points around a zone, `4 cells` of them, with the corners and the middles of the sides where `cells` is even.
fn rim(zone: Zone, cells: usize) -> Vec<[f64; 2]> {
    match zone {
        Zone::Circle { diameter } => (0..4 * cells)
            .map(|i| (FRAC_PI_2 * i as f64 / cells as f64).sin_cos())
            .map(|(s, c)| [c * diameter / 2.0, s * diameter / 2.0])
            .collect(),
        Zone::Rectangle { width, height } => {
            let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]];
            let sides = corners.windows(2).flat_map(|side| {
                let along = move |i: usize| i as f64 / cells as f64;
                (0..cells).map(move |i| [0, 1].map(|axis| side[0][axis] + (side[1][axis] - side[0][axis]) * along(i)))
            });
            sides.map(|[a, b]| [a * width / 2.0, b * height / 2.0]).collect()
        }
    }
}

/// The same robot with limits `by` rad farther out, or farther in where that is negative.
fn widened(robot: &Robot, by: f64) -> Robot {
    let mut robot = robot.clone();
    if let Arm::SixAxis { limits, .. } = &mut robot.arm {
        for range in limits.joints.iter_mut().chain([&mut limits.elbow]) {
            *range = Interval::new(range.min() - by, range.max() + by).expect("room between the limits");
        }
    }
    robot
}

/// The largest room to the ends of `range`, some whole turns added; negative where nothing fits.
fn room(range: Interval, taken: Interval) -> f64 {
    let room = |turns: f64| (taken.min() + turns - range.min()).min(range.max() - taken.max() - turns);
    (-4..=4).map(|turns| room(TAU * f64::from(turns))).fold(f64::NEG_INFINITY, f64::max)
}

/// The angle that equals `angle` but for whole turns and is nearest to `other`.
fn next_to(angle: f64, other: f64) -> f64 {
    angle - ((angle - other) / TAU).round() * TAU
}

impl Question {
    /// Turning the tool about its axis turns joint 6 and nothing else, and any turn will do.
    fn roll_is_free(&self) -> bool {
        let tool = &self.options.flange_from_tool;
        let axis = tool.rotation * Vector3::z();
        self.options.roll.is_none() && (axis - Vector3::z()).norm() < 1e-9 && tool.translation.vector.xy().norm() == 0.0
    }

    /// What the zone keeps from the joint-1 axis, m.
    fn column(&self) -> f64 {
        match self.options.margins.column {
            Column::Radius(radius) => radius,
            Column::Own => unreachable!("the questions give a radius"),
        }
    }

    /// The robot with its limits narrower by the margin.
    fn narrowed(&self) -> Robot {
        widened(&self.robot, -self.options.margins.limit)
    }

    /// The same without a limit on the joints that may be turned into their ranges as a whole.
    fn with_zone_and_roll_to_turn(&self) -> Robot {
        let mut robot = self.narrowed();
        if let Arm::SixAxis { limits, .. } = &mut robot.arm {
            limits.joints[0] = Interval::ALL;
            if self.roll_is_free() {
                limits.joints[5] = Interval::ALL;
            }
        }
        robot
    }

    fn posture(&self, robot: &Robot, stand: &Stand, class: Configuration, at: [f64; 2]) -> Option<[f64; 6]> {
        let flange = stand.pose(self.options.elevation, at) * self.options.flange_from_tool.inverse();
        reached(robot, &flange).into_iter().find(|(found, _)| *found == class).map(|(_, q)| q)
    }

    /// Walks from the centre to every point of the rim in one class; `None` where a pose is out of reach, a joint turns by a
    /// quarter turn from the centre, no whole turns put its way into its range, or the compliance reaches `limit`.
    fn hold(&self, robot: &Robot, stand: &Stand, class: Configuration, cells: usize, limit: f64) -> Option<Held> {
        let (geometry, limits) = six_axis(robot);
        let model = |q: &[f64; 6]| geometry.model_angles(q, limits.third_axis);
        let centre = self.posture(robot, stand, class, [0.0; 2])?;
        let mut held = Held {
            worst: 0.0,
            joints: centre.map(Interval::point),
            singular_margin: f64::INFINITY,
            elbow_room: f64::INFINITY,
            pace: 0.0,
        };
        for [u, v] in rim(self.zone, cells) {
            let mut last = centre;
            for step in 0..=cells {
                let part = step as f64 / cells as f64;
                let found = self.posture(robot, stand, class, [u * part, v * part])?;
                let q: [f64; 6] = std::array::from_fn(|joint| next_to(found[joint], last[joint]));
                let turned = model(&q).iter().zip(model(&centre)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                let posture = compliance(robot, &q, &self.options.flange_from_tool).unwrap();
                let worst = posture.compliance.worst().0;
                if FRAC_PI_2 <= turned || limit <= worst {
                    return None;
                }
                held.worst = held.worst.max(worst);
                held.singular_margin = held.singular_margin.min(geometry.singular_margin(&model(&q)));
                if limits.elbow.is_bounded() {
                    let enclosed = PI - model(&q)[2];
                    let whole = ((limits.elbow.middle() - enclosed) / TAU).round() * TAU;
                    held.elbow_room = held.elbow_room.min(room(limits.elbow, Interval::point(enclosed + whole)));
                }
                for joint in 0..6 {
                    held.pace = held.pace.max((q[joint] - last[joint]).abs());
                    let taken = held.joints[joint];
                    held.joints[joint] = Interval::spanning(taken.min().min(q[joint]), taken.max().max(q[joint]));
                }
                last = q;
            }
        }
        let fits = limits.joints.iter().zip(held.joints).all(|(range, taken)| -SLACK <= room(*range, taken));
        fits.then_some(held)
    }

    /// The joints that are turned as a whole have room for what they turn by within the zone.
    fn turns_fit(&self, held: &Held) -> bool {
        let narrowed = self.narrowed();
        let (_, limits) = six_axis(&narrowed);
        let fits = |joint: usize| held.joints[joint].width() <= limits.joints[joint].width() + SLACK;
        fits(0) && (fits(5) || !self.roll_is_free())
    }

    /// All of the zone stands where it may.
    fn stands_within(&self, stand: &Stand) -> bool {
        let Within { x, z } = self.options.within;
        let ahead = Stand { bearing: 0.0, ..*stand };
        rim(self.zone, 16)
            .into_iter()
            .map(|at| ahead.pose(self.options.elevation, at).translation)
            .all(|at| x.contains(at.x, SLACK) && z.contains(at.z, SLACK))
    }

    /// The nearest of many points of the zone to the joint-1 axis, m, and how far from one of them another may lie.
    fn distance_from_axis_1(&self, stand: &Stand) -> (f64, f64) {
        let side = |i: i32| f64::from(i) / 20.0 - 1.0;
        let points = (0..=40).flat_map(|i| (0..=40).map(move |j| self.zone.at([side(i), side(j)])));
        let distance = |at| stand.pose(self.options.elevation, at).translation.vector.xy().norm();
        let [first, second] = self.zone.sides();
        // The cells of a disc are longer than those of a square, by half a turn over a side at most.
        (points.map(distance).fold(f64::INFINITY, f64::min), FRAC_PI_2 * first.hypot(second) / 80.0)
    }

    /// The compliance at a stand, m/N, if it is less than `limit`: in the stiffest class, with coarse samples first.
    fn value_below(&self, freed: &Robot, stand: &Stand, limit: f64) -> Option<f64> {
        if !self.stands_within(stand) {
            return None;
        }
        let tool = &self.options.flange_from_tool;
        let flange = stand.pose(self.options.elevation, [0.0; 2]) * tool.inverse();
        // No zone is stiffer than its centre.
        let centres = reached(freed, &flange);
        let classes = centres
            .into_iter()
            .filter(|(_, q)| compliance(freed, q, tool).unwrap().compliance.worst().0 < limit)
            .map(|(class, _)| class);
        let values = classes.filter_map(|class| {
            let held = [1, 4, 16].iter().try_fold(None, |_, cells| {
                let clear = |held: &Held| self.options.margins.singular <= held.singular_margin + SLACK;
                let held = self.hold(freed, stand, class, *cells, limit);
                held.filter(|held| self.turns_fit(held) && clear(held)).map(Some)
            });
            held.flatten().map(|held| held.worst)
        });
        values.min_by(f64::total_cmp).filter(|_| self.is_clear_of_column(stand))
    }

    /// For certain.
    fn is_clear_of_column(&self, stand: &Stand) -> bool {
        if self.column() == 0.0 {
            return true;
        }
        let (nearest, spacing) = self.distance_from_axis_1(stand);
        self.column() <= nearest - spacing
    }

    /// Every place that is tried: a grid over all the arm might reach, and places about a stand at all scales.
    fn trials(&self, rng: &mut fastrand::Rng, around: Option<Stand>, columns: usize, nudges: usize) -> Vec<Stand> {
        let options = &self.options;
        let (geometry, _) = six_axis(&self.robot);
        let far = geometry.c2 + geometry.l3() + geometry.c4.abs() + options.flange_from_tool.translation.vector.norm();
        let long = geometry.a1.hypot(geometry.b) + far;
        let ahead = options.within.x.intersect(Interval::spanning(-long, long));
        let up = options.within.z.intersect(Interval::spanning(geometry.c1 - far, geometry.c1 + far));
        let spread = |range: Interval, count: usize| -> Vec<f64> {
            (0..count).map(|i| range.min() + range.width() * (i as f64 + 0.5) / count as f64).collect()
        };
        let is_vertical = FRAC_PI_2 - options.elevation.abs() < 1e-9;
        let yaws = if is_vertical { vec![0.0] } else { spread(options.yaw, 7) };
        let angles = match options.orientation {
            _ if matches!(self.zone, Zone::Circle { .. }) => vec![0.0],
            Orientation::Axes => vec![0.0, FRAC_PI_2],
            Orientation::Fixed(angle) => vec![angle],
            Orientation::Free => spread(Interval::spanning(0.0, PI), 6),
        };
        let rolls = match options.roll {
            Some(roll) => vec![roll],
            None if self.roll_is_free() => vec![0.0],
            None => spread(Interval::spanning(0.0, TAU), 8),
        };
        let mut trials = Vec::new();
        let (Some(ahead), Some(up)) = (ahead, up) else { return trials };
        for x in spread(ahead, columns) {
            for z in spread(up, columns) {
                for &yaw in &yaws {
                    for &angle in &angles {
                        let stand = |roll: &f64| Stand { centre: [x, z], bearing: 0.0, yaw, angle, roll: *roll };
                        trials.extend(rolls.iter().map(stand));
                    }
                }
            }
        }
        for best in around.into_iter().cycle().take(nudges) {
            let scale = 0.3 * 10_f64.powf(-3.5 * rng.f64());
            let mut nudge = |really: bool| if really { scale * (2.0 * rng.f64() - 1.0) } else { 0.0 };
            trials.push(Stand {
                centre: [best.centre[0] + far * nudge(true), best.centre[1] + far * nudge(true)],
                bearing: 0.0,
                yaw: options.yaw.clamp(best.yaw + nudge(!is_vertical)),
                angle: best.angle + nudge(options.orientation == Orientation::Free),
                roll: best.roll + nudge(rolls.len() > 1),
            });
        }
        trials
    }

    /// The best trial below `limit`, m/N.
    fn best_below(&self, trials: &[Stand], limit: f64) -> Option<(f64, Stand)> {
        let freed = self.with_zone_and_roll_to_turn();
        let mut best: Option<(f64, Stand)> = None;
        for stand in trials {
            let limit = best.map_or(limit, |(value, _)| value);
            best = self.value_below(&freed, stand, limit).map(|value| (value, *stand)).or(best);
        }
        best
    }

    /// Every word of an answer, pose by pose.
    fn check(&self, found: &Placement) {
        let hold = found.space().expect("a place in space");
        let (geometry, limits) = six_axis(&self.robot);
        let (options, stand) = (&self.options, Stand::of(found));
        let case = || format!("{self:#?}\n{found:#?}");
        // Limits are kept everywhere in the zone, not just where the library took its samples.
        let held = self
            .hold(&widened(&self.robot, SLACK), &stand, hold.configuration, 24, f64::INFINITY)
            .unwrap_or_else(|| panic!("the zone is not held in one go: {}", case()));
        assert!(held.pace < FRAC_PI_4, "a joint jumps by {} rad: {}", held.pace, case());

        // The place is one that was asked for.
        let asked = options.margins;
        assert!(asked.limit <= hold.limit_margin.0 + SLACK, "{}", case());
        assert!(asked.singular <= hold.singular_margin + SLACK, "{}", case());
        assert!(self.stands_within(&stand), "{}", case());
        assert!(self.column() <= self.distance_from_axis_1(&stand).0 + SLACK, "{}", case());
        let same = |a: f64, b: f64, period: f64| (a - b - ((a - b) / period).round() * period).abs() < 1e-9;
        let is_vertical = FRAC_PI_2 - options.elevation.abs() < 1e-9;
        let yaw = room(options.yaw, Interval::point(stand.yaw));
        assert!(if is_vertical { stand.yaw == 0.0 } else { -SLACK <= yaw }, "{}", case());
        assert!(options.roll.is_none_or(|roll| same(roll, stand.roll, TAU)), "{}", case());
        let angle_is_allowed = match options.orientation {
            _ if matches!(self.zone, Zone::Circle { .. }) => stand.angle == 0.0,
            Orientation::Axes => same(stand.angle, 0.0, FRAC_PI_2),
            Orientation::Fixed(angle) => same(stand.angle, angle, PI),
            Orientation::Free => true,
        };
        assert!(angle_is_allowed, "{}", case());

        // The value is that of the worst point, which lies in the zone, and no sample is worse.
        let worst = compliance(&self.robot, &hold.joints, &options.flange_from_tool).unwrap();
        let (value, direction) = worst.compliance.worst();
        let apart = |value: f64| (value * options.force - found.deflection) / found.deflection;
        assert!(apart(value).abs() < 1e-9, "{value} at the worst point: {}", case());
        assert_eq!(beyond_limits(&self.robot, &hold.joints), [0; 0], "{}", case());
        let turned = Point3::from(found.worst_point);
        assert!((worst.tool.translation.vector - turned.coords).norm() < 1e-9, "{}: {}", worst.tool, case());
        let centre = stand.pose(options.elevation, [0.0; 2]);
        assert!(worst.tool.rotation.angle_to(&centre.rotation) < 1e-9, "{}: {}", worst.tool, case());
        let unrolled = Stand { roll: 0.0, angle: 0.0, ..stand }.pose(options.elevation, [0.0; 2]);
        let in_plane = unrolled.inverse() * turned;
        let (s, c) = stand.angle.sin_cos();
        let (ahead, left) = (in_plane.x, -in_plane.y);
        let (u, v) = (ahead * c + left * s, left * c - ahead * s);
        let is_in_the_zone = match self.zone {
            Zone::Circle { diameter } => u.hypot(v) <= diameter / 2.0 + 1e-9,
            Zone::Rectangle { width, height } => u.abs() <= width / 2.0 + 1e-9 && v.abs() <= height / 2.0 + 1e-9,
        };
        assert!(is_in_the_zone && in_plane.z.abs() < 1e-9, "{in_plane}: {}", case());
        // The nearest point is on the rim, or the axis goes through the zone; samples stand a part of the rim apart.
        let at = |point| stand.pose(options.elevation, point).translation.vector.xy().norm();
        let nearest = self::rim(self.zone, 24).into_iter().map(at).fold(f64::INFINITY, f64::min);
        let part = self.zone.sides().into_iter().fold(0.0, f64::max) / 24.0;
        let from_axis_1 = found.from_axis_1.expect("in space");
        let off = from_axis_1 - nearest;
        assert!(-part <= off && off <= 1e-2 * part, "{nearest} {from_axis_1}: {}", case());
        let shares = worst.shares(&direction).into_iter().zip(hold.shares).map(|(a, b)| (a - b).abs());
        assert!(shares.fold(0.0, f64::max) < 1e-9, "{}", case());
        // The library halves its steps until that gains less than a thousandth.
        assert!(apart(held.worst) <= 1e-3, "{} in the zone: {}", held.worst, case());
        assert!(-1e-2 <= apart(held.worst), "{} in the zone: {}", held.worst, case());

        // The margins hold everywhere in the zone, and a sample comes near to them: an extreme of an angle lies on the rim,
        // between two samples of either side at most.
        let rooms: Vec<f64> = (0..6).map(|joint| room(limits.joints[joint], held.joints[joint])).collect();
        let rooms: Vec<f64> = [held.elbow_room].into_iter().chain(rooms).collect();
        let least = rooms.iter().copied().fold(f64::INFINITY, f64::min);
        let (margin, joint) = hold.limit_margin;
        assert!(margin <= least.max(0.0) + SLACK, "{margin} {rooms:?}: {}", case());
        assert!(least - margin <= held.pace / 2.0 || margin == least, "{margin} {rooms:?}: {}", case());
        assert!((rooms[joint] - least).abs() <= held.pace / 2.0 || margin == least, "{rooms:?}: {}", case());
        let singular = held.singular_margin - hold.singular_margin;
        assert!((-SLACK..=held.pace / 2.0).contains(&singular), "{} {}", held.singular_margin, case());
        let centre = self.posture(&self.robot, &stand, hold.configuration, [0.0; 2]).unwrap();
        assert!(geometry.singular_margin(&geometry.model_angles(&centre, limits.third_axis)) >= hold.singular_margin);
    }
}

#[test]
fn an_answer_in_space_holds_pose_by_pose_and_no_place_beats_it() {
    let judge = |seed: u64| {
        let question = random_question(seed);
        let answer = question.options.place(&question.robot, question.zone).unwrap();
        let best = answer.feasible();
        if let Some(best) = best {
            question.check(best);
        }
        let value = best.map_or(f64::INFINITY, |best| best.deflection / question.options.force);
        let mut rng = fastrand::Rng::with_seed(seed);
        let trials = question.trials(&mut rng, best.map(Stand::of), COLUMNS, NUDGES);
        let better = question.best_below(&trials, (1.0 - GAIN) * value);
        assert!(better.is_none(), "seed {seed}: {better:?} beats {value}: {question:#?}\n{answer:#?}");
        [usize::from(best.is_some()), usize::from(best.is_none()), trials.len()]
    };
    let cases = cases(16);
    let counts = (0..cases).into_par_iter().map(judge);
    let [feasible, infeasible, trials] =
        counts.reduce(|| [0; 3], |sum, part| std::array::from_fn(|i| sum[i] + part[i]));
    let count = cases as usize;
    println!("{feasible} feasible, {infeasible} infeasible, {trials} places tried");
    assert!(
        5 * count <= 8 * feasible && 2 <= infeasible && 3_125 * count <= 2 * trials,
        "the cases do not exercise the search"
    );
}

/// Its best place has one edge over the joint-1 axis, where no samples stand: it must move on, and not be called none.
#[test]
fn a_wide_zone_that_would_touch_the_joint_1_axis_has_its_place_beside_it() {
    let robot = entries().iter().map(Entry::robot).find(|robot| robot.name == "GP20HL").expect("of the catalogue");
    let zone = Zone::Rectangle { width: 0.44, height: 1.435 };
    let options = Asked { orientation: Orientation::Fixed(89.8_f64.to_radians()), ..Asked::tool_down(1000.0) };
    let question = Question { robot, zone, options };
    let answer = options.place(&question.robot, zone).unwrap();
    let best = answer.feasible().expect("a place 0.05 m farther out was found by hand");
    question.check(best);
    // Found with a window that begins 0.05 m from the axis.
    assert!(best.deflection <= 6.4087e-3 && best.deflection * (1.0 - GAIN) <= best.lower_bound, "{best:?}");
}

/// With drive 1 alone the compliance is its own times the square of the distance from its axis: the nearest place is best.
#[test]
fn with_drive_1_alone_the_best_place_is_the_nearest() {
    let judge = |seed: u64| {
        let mut rng = fastrand::Rng::with_seed(seed);
        let mut robot = random_robot(&mut rng);
        let k = 1e-6 * (0.5 + rng.f64());
        let Arm::SixAxis { geometry, limits, drives } = &mut robot.arm else { panic!("made of six axes") };
        *limits = Limits { joints: [Interval::ALL; 6], elbow: Interval::ALL, ..limits.clone() };
        geometry.b = 0.0;
        drives.compliance = JointCompliance([k, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let reach = robot.stretch();
        let (near, width, height) = (reach * (0.3 + 0.2 * rng.f64()), 0.15 * reach, reach * (0.05 + 0.2 * rng.f64()));
        let zone =
            if seed.is_multiple_of(2) { Zone::Circle { diameter: width } } else { Zone::Rectangle { width, height } };
        let mut options = Asked::tool_down(1000.0);
        options.within.x = Interval::new(near, f64::INFINITY).unwrap();
        let found = options.place(&robot, zone).unwrap();
        let found = found.feasible().unwrap_or_else(|| panic!("seed {seed}: {found:?}"));
        let [x, y, _] = found.worst_point;
        let there = 1000.0 * k * (x * x + y * y);
        assert!((found.deflection - there).abs() <= 1e-9 * there, "seed {seed}: {there} {found:?}");
        let farthest = match zone {
            Zone::Circle { diameter } => near + diameter,
            Zone::Rectangle { .. } => (near + width).hypot(height / 2.0).min((near + height).hypot(width / 2.0)),
        };
        let best = 1000.0 * k * farthest * farthest;
        // The search ends at steps of 0.05 mm of some 500 mm, and the deflection goes with the square.
        assert!((found.deflection - best).abs() <= 5e-4 * best, "seed {seed}: {best} {found:?}");
    };
    (0..12).into_par_iter().for_each(judge);
}

/// With drives 2 and 3 alone, the tool point at the wrist centre and the tool pointing sideways, a zone in the arm plane is
/// that of the planar model, whose answer is proved.
#[test]
fn a_zone_in_the_arm_plane_has_the_place_that_the_planar_model_proves() {
    let judge = |seed: u64| {
        let mut rng = fastrand::Rng::with_seed(seed);
        let mut robot = random_robot(&mut rng);
        let Arm::SixAxis { geometry, limits, drives } = &mut robot.arm else { panic!("made of six axes") };
        geometry.b = 0.0;
        for joint in [0, 3, 4, 5] {
            limits.joints[joint] = Interval::ALL;
            drives.compliance.0[joint] = 0.0;
        }
        let to_the_wrist = Pose::translation(0.0, 0.0, -geometry.c4);
        let size = robot.stretch() * (0.03 + 0.2 * rng.f64());
        let zone = match seed % 3 {
            0 => Zone::Circle { diameter: size },
            1 => Zone::Rectangle { width: size, height: size / 2.0 },
            _ => Zone::Rectangle { width: size / 3.0, height: size },
        };
        let anywhere = Within { x: Interval::POSITIVE, z: Interval::ALL };
        let options = Asked {
            flange_from_tool: to_the_wrist,
            elevation: 0.0,
            yaw: Interval::point(FRAC_PI_2),
            within: anywhere,
            ..Asked::tool_down(1000.0)
        };
        let found = options.place(&robot, zone).unwrap();
        // Joint 1 may face away: the arm then stands over a place behind it.
        let plane = Model::planar(&robot).unwrap();
        let behind = Within { x: anywhere.x.affine(-1.0, 0.0), ..anywhere };
        let proved = [anywhere, behind].map(|within| {
            let options = PlaceOptions { within: Some(within), ..PlaceOptions::under(Load::PAPER) };
            place(&plane, &zone.into(), &options, Watch::nobody()).unwrap()
        });
        let best = proved.iter().filter_map(Placed::feasible);
        let least = |of: fn(&Placement) -> f64| best.clone().map(of).fold(f64::INFINITY, f64::min);
        let (bound, value) = (least(|placed| placed.lower_bound), least(|placed| placed.deflection));
        let case = || format!("seed {seed}: {bound} {value}, {found:?} {zone:?} {robot:?}");
        let Some(found) = found.feasible() else {
            assert!(value.is_infinite(), "{}", case());
            return 0;
        };
        // Samples lie at the corners; between them, on a rim or an edge, the zone may be worse by their halving.
        assert!((1.0 - 1e-3) * bound <= found.deflection, "{}", case());
        assert!(found.deflection <= (1.0 + GAIN) * value, "{}", case());
        1
    };
    let feasible: usize = (0..30).into_par_iter().map(judge).sum();
    assert!(15 <= feasible, "{feasible} zones have a place");
}
