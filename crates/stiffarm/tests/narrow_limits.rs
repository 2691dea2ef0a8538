//! Are places found, or proved to be none, where joint limits leave no more than a sliver?

use std::f64::consts::PI;

use stiffarm::catalogue::paper_robots;
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::place::{Orientation, PlaceOptions, Placed, Within};
use stiffarm::plane::PlanarArm;
use stiffarm::task::Zone;

use crate::links::place;

/// Between two arcs of one radius about two ends of a link, `2 l sin(width/2)` apart, no circle is larger than that
/// distance (triangle inequality), and where the other link points along the line through both, that one fits.
#[test]
fn the_largest_circle_in_a_sliver_is_as_wide_as_the_elbow_travels() {
    let window = Within { x: Interval::spanning(-9.0, 9.0), z: Interval::spanning(-9.0, 9.0) };
    for width in [0.05_f64].map(f64::to_radians) {
        let cut = Interval::spanning(1.0, 1.0 + width);
        let arm = PlanarArm::free(1.1, 0.9, 1e-6, 2e-6, Architecture::Serial);
        let slivers =
            [(1.1, PlanarArm { shoulder: cut, ..arm.clone() }), (0.9, PlanarArm { forearm: cut, ..arm.clone() })];
        for (link, arm) in slivers {
            let largest = 2.0 * link * (width / 2.0_f64).sin();
            for within in [Within::ANYWHERE, window] {
                let options =
                    PlaceOptions { within: Some(within), gap: Some(1e-3), ..PlaceOptions::under(Load::PAPER) };
                let at = |scale: f64| place(&arm, Zone::Circle { diameter: largest * scale }, &options).unwrap();
                assert!(at(0.999).feasible().is_some(), "{arm:?} {within:?}");
                let Placed::Infeasible { largest_scale, .. } = at(1.001) else { panic!("{arm:?} {within:?}") };
                let largest_scale = largest_scale.expect("the planar model looks for it");
                assert!((largest_scale * 1.001 - 1.0).abs() < 3e-4, "{largest_scale} {arm:?} {within:?}");
            }
        }
    }
}

struct Question {
    arm: PlanarArm,
    zone: Zone,
    options: PlaceOptions,
}

/// One or two joints of a robot of the paper left 0.01 to 0.5 deg about a posture, a zone about as wide, a window or none.
fn question(rng: &mut fastrand::Rng) -> Question {
    let robots = paper_robots();
    let mut arm = robots[rng.usize(0..robots.len())].arm_plane().unwrap().arm;
    let (shoulder, elbow) = (0.6 + rng.f64(), -0.5 - 1.5 * rng.f64());
    let width = (0.01 * 50_f64.powf(rng.f64())).to_radians();
    let (before, which) = (width * rng.f64(), rng.u8(0..4));
    let about = |angle: f64| Interval::spanning(angle - before, angle - before + width);
    arm.elbow = if which == 0 { about(elbow) } else { Interval::spanning(elbow - 0.5, elbow + 0.4) };
    arm.shoulder = if which % 2 == 1 { about(shoulder) } else { Interval::spanning(0.2, 2.2) };
    arm.forearm = if 2 <= which { about(shoulder + elbow) } else { Interval::spanning(-2.0, 1.5) };
    let size = width * (arm.l2 + arm.l3) / 2.0 * (0.2 + 1.3 * rng.f64());
    let zone = match rng.u8(0..2) {
        0 => Zone::Circle { diameter: size },
        _ => Zone::Rectangle { width: size, height: size * (0.3 + 2.0 * rng.f64()) },
    };
    let p = arm.forward(shoulder, elbow);
    let mut window = |middle: f64| {
        let half = size * (0.5 + 1.5 * rng.f64());
        if rng.bool() { Interval::ALL } else { Interval::spanning(middle - half, middle + half) }
    };
    let within = Within { x: window(p.x), z: window(p.y) };
    let orientation = Orientation::Fixed(PI * rng.f64());
    Question {
        arm,
        zone,
        options: PlaceOptions {
            orientation,
            within: Some(within),
            gap: Some(1e-3),
            ..PlaceOptions::under(Load::PAPER)
        },
    }
}

/// The largest compliance at the outline of a zone that stands about the wrist of a posture, and all of it in the limits.
///
/// Law of cosines and eigenvalue written anew; the zone is so small that no angle comes near to another turn.
fn judged(q: &Question, shoulder: f64, elbow: f64) -> Option<f64> {
    // A hundredth larger, for what the edges bulge between the samples.
    const GROWN: f64 = 1.01;
    let Question { arm, zone, options } = q;
    let Orientation::Fixed(angle) = options.orientation else { unreachable!("all are fixed") };
    let centre = arm.forward(shoulder, elbow);
    let outline: Vec<[f64; 2]> = match *zone {
        Zone::Circle { diameter } => (0..48)
            .map(|i| f64::from(i) * PI / 24.0)
            .map(|a| [diameter / 2.0 * a.cos(), diameter / 2.0 * a.sin()])
            .collect(),
        Zone::Rectangle { width, height } => {
            [-0.5, 0.0, 0.5].iter().flat_map(|i| [-0.5, 0.0, 0.5].map(|j| [i * width, j * height])).collect()
        }
    };
    let mut worst = 0.0_f64;
    for [u, v] in outline {
        let (u, v) = (GROWN * u, GROWN * v);
        let x = centre.x + u * angle.cos() - v * angle.sin();
        let z = centre.y + u * angle.sin() + v * angle.cos();
        let r = x.hypot(z);
        let (l2, l3) = (arm.l2, arm.l3);
        let bent = -((r * r - l2 * l2 - l3 * l3) / (2.0 * l2 * l3)).acos();
        let raised = z.atan2(x) + ((r * r + l2 * l2 - l3 * l3) / (2.0 * r * l2)).acos();
        let keeps = arm.shoulder.contains(raised, 0.0)
            && arm.elbow.contains(bent, 0.0)
            && arm.forearm.contains(raised + bent, 0.0)
            && options.within.unwrap().x.contains(x, 0.0)
            && options.within.unwrap().z.contains(z, 0.0);
        if !keeps {
            return None;
        }
        let c = arm.compliance(raised, bent);
        worst = worst.max(f64::midpoint(c.m11, c.m22) + ((c.m11 - c.m22) / 2.0).hypot(c.m12));
    }
    Some(worst * options.load.newtons())
}

#[test]
fn no_posture_in_a_sliver_beats_the_answer_or_stands_where_there_is_no_place() {
    let mut rng = fastrand::Rng::with_seed(9);
    let (mut found, mut none, mut compared) = (0, 0, 0);
    for case in 0..10 {
        let q = question(&mut rng);
        let text = format!("case {case}: {:?} {:?} {:?}", q.arm, q.zone, q.options);
        let answer = place(&q.arm, q.zone, &q.options).unwrap_or_else(|error| panic!("{text}: {error}"));
        let floor = answer.feasible().map_or(f64::INFINITY, |best| best.lower_bound);
        if answer.feasible().is_some() {
            found += 1;
        } else {
            none += 1;
        }
        for _ in 0..2_000 {
            let within = |range: Interval, t: f64| range.min() + t * range.width();
            let elbow = within(q.arm.elbow, rng.f64());
            let shoulder = if q.arm.shoulder.width() < q.arm.forearm.width() {
                within(q.arm.shoulder, rng.f64())
            } else {
                within(q.arm.forearm, rng.f64()) - elbow
            };
            if let Some(value) = judged(&q, shoulder, elbow) {
                compared += 1;
                assert!(floor <= value * (1.0 + 1e-9), "{text}: {value} at {shoulder} {elbow}, floor {floor}");
            }
        }
    }
    assert!(2 <= found && 2 <= none && 20 <= compared, "{found} found, {none} without a place, {compared} compared");
}

/// Needed more than a million boxes: "between 0.1420 and inf mm; ask for a larger gap".
#[test]
fn a_free_angle_in_a_window_as_thin_as_the_zone_is_answered() {
    let arm = PlanarArm::free(0.36, 0.36, 1e-6, 1e-6, Architecture::Serial);
    let (shoulder, elbow) = (1.2, -1.3);
    let cut = 0.033_f64.to_radians();
    let arm = PlanarArm { forearm: Interval::spanning(shoulder + elbow, shoulder + elbow + cut), ..arm };
    let z = arm.forward(shoulder, elbow).y;
    let zone = Zone::Rectangle { width: 0.2129e-3, height: 0.2169e-3 };
    let within = Within { x: Interval::ALL, z: Interval::spanning(z - 1.2e-4, z + 1.2e-4) };
    let options =
        PlaceOptions { orientation: Orientation::Free, within: Some(within), ..PlaceOptions::under(Load::PAPER) };
    // Its shorter side is longer than the 0.2073 mm that the sliver is wide.
    assert!(matches!(place(&arm, zone, &options), Ok(Placed::Infeasible { .. })));
}
