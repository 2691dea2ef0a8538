//! Does a cut swing: numbers worked out apart, formulas of textbooks, another program's method in print, and a simulation in time that shares no code.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Complex, DMatrix, Matrix3, Matrix3x2, Vector3};
use stiffarm::catalogue::{find, with_compliance};
use stiffarm::chatter::{Curve, Cut, Teeth, axes};
use stiffarm::cutting::{Edge, Engagement, Milling};
use stiffarm::mass::RigidBody;
use stiffarm::modes::{Damping, HeldTool, Motion, modes};
use stiffarm::spatial::Pose;

use crate::modes::{START_DEG, kr210, tx200, tx200_spindle};

const RIGID: f64 = f64::INFINITY;

pub(crate) fn mill(teeth: usize, diameter: f64, [entry, exit]: [f64; 2], chip: [f64; 3]) -> Milling {
    let engagement = Engagement::at_depth(1e-3, [entry, exit], 1e-4);
    Milling { diameter, teeth, helix: 0.0, engagement, edge: Edge::Linear { chip, rubbing: [0.0; 3] } }
}

fn cut(milling: &Milling, rpm: f64) -> Cut {
    Cut { milling: milling.clone(), spindle: rpm * TAU / 60.0 }
}

/// Half immersion down of the TX200's milling task, worked out apart with an axial force that pushes the tool off the work.
fn task() -> Milling {
    mill(4, 0.02, [FRAC_PI_2, PI], [1930.4e6, 1159.6e6, -200.6e6])
}

/// Its arm in the frame of the work, feed along x, which is Rz(-90 deg) of the base.
fn tx200_motion() -> Motion {
    let robot = tx200([1.15e6, 3.76e6, 1.29e6, RIGID, RIGID, RIGID]);
    let damping = Damping::OfDrives([2820.0, 610.0, 1870.0, 0.0, 0.0, 0.0]);
    let swing = modes(&robot, &START_DEG.map(f64::to_radians), &tx200_spindle(), Some(damping)).unwrap();
    let work = axes([0.0, -1.0, 0.0], &Vector3::z()).unwrap();
    swing.motion(&[1.0; 6], None).seen_along(&work)
}

pub(crate) fn close(found: f64, expected: f64, within: f64) {
    assert!((found / expected - 1.0).abs() < within, "{found} is not {expected}");
}

#[test]
fn depths_and_frequencies_of_a_tx200_are_as_worked_out_apart() {
    let curve = Curve::of(&tx200_motion(), &task().mean_directional());
    for (rpm, depth_mm, hertz) in [(300.0, 0.101_987, 11.203_35), (3333.0, 3.152_071, 29.020_69)] {
        let edge = curve.edge_at(cut(&task(), rpm).period_at(rpm * TAU / 60.0)).unwrap();
        // Frequencies of the arm agree to 2e-6, so that depths at a resonance do to some 1e-5.
        close(edge.depth * 1e3, depth_mm, 5e-5);
        close(edge.frequency, hertz, 5e-6);
    }
    let any = curve.any_speed().unwrap();
    close(any.depth * 1e3, 0.0488, 1e-3);
    close(any.frequency, 9.34, 1e-3);
    let pan = curve.without_delay().unwrap();
    close(pan.depth * 1e3, 0.301_927, 5e-5);
    close(pan.frequency, 13.2019, 1e-5);
}

/// The case with which semi-discretisation is introduced: one mode along the feed.
fn one_mode() -> (Motion, Milling, f64) {
    let (own, ratio, mass) = (TAU * 922.0, 0.011, 0.03993_f64);
    let motion = Motion::uncoupled(&[(own, ratio, [1.0 / mass.sqrt(), 0.0, 0.0])]);
    (motion, mill(2, 0.01, [0.0, PI], [6e8, 2e8, 0.0]), mass * own * own)
}

#[test]
fn the_bottom_of_the_lobes_of_one_mode_is_that_of_the_textbook() {
    let (motion, milling, k) = one_mode();
    let curve = Curve::of(&motion, &milling.mean_directional());
    let bottom = curve.any_speed().unwrap().depth;
    // 2 k zeta (1 + zeta) / (N K_n / 4).
    close(bottom, 2.0 * k * 0.011 * 1.011 / (2.0 * 2e8 / 4.0), 1e-9);
    close(bottom * 1e3, 0.29805, 2e-5);
    // The formula of one mode in closed form: a = -1 / (2 A Re G), w T = pi + 2 arg(A G) + 2 pi j.
    for hertz in [923.0, 950.0, 1100.0, 2000.0] {
        let (own, w) = (TAU * 922.0, TAU * hertz);
        let g = Complex::new(own * own - w * w, 2.0 * 0.011 * own * w).inv() / 0.03993;
        let a = -1e8 * g;
        let period = (PI + 2.0 * a.arg() + 4.0 * PI) / w;
        let edge = curve.edge_at(period).unwrap();
        // Another lobe may lie below at this speed: no depth is more than that of this one.
        assert!(edge.depth <= 0.5 / a.re * (1.0 + 1e-9), "{hertz} Hz: {edge:?}");
        if (edge.frequency - hertz).abs() < 1.0 {
            close(edge.depth, 0.5 / a.re, 1e-8);
        }
    }
}

/// Depths in print of the method in its own program, mm, by the number of steps.
#[test]
fn semi_discretisation_of_one_mode_gives_the_depths_of_its_authors() {
    let (motion, milling, _) = one_mode();
    let cut = cut(&milling, 10_000.0);
    let teeth = Teeth::of(&motion, &cut);
    for (steps, depth_mm) in [(20, 0.3783), (40, 0.3350), (60, 0.3279), (80, 0.3255), (160, 0.3231)] {
        let edge = teeth.edge_at(cut.spindle, steps, 1e-4).unwrap();
        close(edge.depth * 1e3, depth_mm, 3e-4);
    }
}

/// Two modes each way, as in the literature on lobes: Hz, damping, N/m.
fn two_modes() -> (Motion, Milling) {
    let mode = |hertz: f64, ratio: f64, k: f64, axis: usize| {
        let own = TAU * hertz;
        let mut tip = [0.0; 3];
        tip[axis] = own / k.sqrt();
        (own, ratio, tip)
    };
    let motion = Motion::uncoupled(&[
        mode(456.78, 0.1117, 7.933e6, 0),
        mode(516.52, 0.0246, 9.375e6, 1),
        mode(1408.45, 0.0314, 12.406e6, 1),
        mode(1448.89, 0.0170, 14.692e6, 0),
    ]);
    (motion, mill(2, 0.03175, [FRAC_PI_2, PI], [1319.4e6, 788.8e6, 0.0]))
}

/// The most modes of a simulation; those that are not there stay at rest.
const MOST: usize = 6;
/// Positions and speeds of modes.
type State = [f64; 2 * MOST];

/// The delayed equation in time, Runge and Kutta over whole steps with the past from a table: by how much the largest displacement has grown from
/// one third of the time to the next, of a cut after a blow. Nothing here is of the library but the numbers of the modes.
fn growth_in_time(motion: &Motion, milling: &Milling, rpm: f64, depth: f64) -> f64 {
    growth_in_steps::<200>(motion, milling, rpm, depth)
}

/// The same in so many steps a tooth.
fn growth_in_steps<const STEPS: usize>(motion: &Motion, milling: &Milling, rpm: f64, depth: f64) -> f64 {
    const TEETH: usize = 180;
    let [kt, kr, ka] = match milling.edge {
        Edge::Linear { chip, .. } => chip,
        Edge::Power { .. } => panic!("linear"),
    };
    let n = motion.own.len();
    let shape: [[f64; MOST]; 3] =
        [0, 1, 2].map(|axis| std::array::from_fn(|i| if i < n { motion.tip[(axis, i)] } else { 0.0 }));
    let stiff: [f64; MOST] = std::array::from_fn(|i| if i < n { motion.own[i].powi(2) } else { 1.0 });
    let damped: [f64; MOST] = std::array::from_fn(|i| if i < n { motion.friction[(i, i)] } else { 1.0 });
    let period = 60.0 / (rpm * milling.teeth as f64);
    let dt = period / STEPS as f64;
    let tip = |z: &[f64]| [0, 1].map(|axis: usize| (0..MOST).map(|i| shape[axis][i] * z[i]).sum::<f64>());
    // Middles of steps are of the table, too.
    let mut past: Vec<[f64; 2]> = Vec::new();
    let rate = |z: &State, time: f64, before: [f64; 2]| -> State {
        let now = tip(&z[..MOST]);
        let off = [now[0] - before[0], now[1] - before[1]];
        let mut force = [0.0; 3];
        for tooth in 0..milling.teeth {
            let phi = (TAU * (time / period + tooth as f64) / milling.teeth as f64).rem_euclid(TAU);
            if milling.engagement.entry() < phi && phi < milling.engagement.exit() {
                let (s, c) = phi.sin_cos();
                let chip = depth * (s * off[0] + c * off[1]);
                force[0] += chip * (-kt * c - kr * s);
                force[1] += chip * (kt * s - kr * c);
                force[2] -= chip * ka;
            }
        }
        std::array::from_fn(|i| match i.checked_sub(MOST) {
            None => z[MOST + i],
            Some(i) => {
                (0..3).map(|axis| shape[axis][i] * force[axis]).sum::<f64>() - stiff[i] * z[i] - damped[i] * z[MOST + i]
            }
        })
    };
    let ahead = |z: &State, k: &State, by: f64| -> State { std::array::from_fn(|i| z[i] + by * k[i]) };
    let mut z: State = std::array::from_fn(|i| i.checked_sub(MOST).map_or(0.0, |i| shape[0][i] + shape[1][i]));
    let mut largest = [0.0_f64; TEETH];
    for step in 0..TEETH * STEPS {
        // A hair inside of the step, so that no rounding decides whether a tooth cuts.
        let time = (step as f64 + 1e-6) * dt;
        let before = |halves: usize| (2 * step + halves).checked_sub(2 * STEPS).map_or([0.0; 2], |at| past[at]);
        let k1 = rate(&z, time, before(0));
        let k2 = rate(&ahead(&z, &k1, dt / 2.0), time + dt / 2.0, before(1));
        let k3 = rate(&ahead(&z, &k2, dt / 2.0), time + dt / 2.0, before(1));
        let k4 = rate(&ahead(&z, &k3, dt), time + dt * (1.0 - 2e-6), before(2));
        let slope: State = std::array::from_fn(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
        let next = ahead(&z, &slope, dt);
        // In the middle of a step by Hermite: position and speed at both ends are known.
        let [here, there] = [tip(&z[..MOST]), tip(&next[..MOST])];
        let [here_rate, there_rate] = [tip(&z[MOST..]), tip(&next[MOST..])];
        let middle = [0, 1].map(|i| f64::midpoint(here[i], there[i]) + dt * (here_rate[i] - there_rate[i]) / 8.0);
        past.extend([here, middle]);
        largest[step / STEPS] = largest[step / STEPS].max(there[0].hypot(there[1]));
        z = next;
    }
    let most = |teeth: std::ops::Range<usize>| largest[teeth].iter().copied().fold(0.0, f64::max);
    most(2 * TEETH / 3..TEETH) / most(TEETH / 3..2 * TEETH / 3)
}

/// The mean leaves out that a tooth cuts for half of the time only: some per cent of the depth, and much where teeth pass fast. Tooth by tooth nothing is
/// left out.
#[test]
fn a_cut_above_its_edge_grows_in_time_and_one_below_it_dies() {
    let (motion, milling) = two_modes();
    let curve = Curve::of(&motion, &milling.mean_directional());
    for rpm in [5800.0, 6500.0, 8000.0, 9500.0, 11_000.0, 12_500.0, 14_000.0, 16_000.0, 18_500.0, 22_000.0] {
        let cut = cut(&milling, rpm);
        let mean = curve.edge_at(cut.period_at(cut.spindle)).unwrap();
        let teeth = Teeth::of(&motion, &cut);
        assert!(teeth.are_needed());
        let teeth = teeth.edge_at(cut.spindle, teeth.steps(cut.spindle), mean.depth / 2.0).unwrap();
        let grown = [0.97, 1.03].map(|share| growth_in_time(&motion, &milling, rpm, share * teeth.depth));
        assert!(grown[0] < 1.0 && 1.0 < grown[1], "{rpm} rpm, {teeth:?}: {grown:?}");
        if rpm < 20_000.0 {
            assert!((mean.depth / teeth.depth).ln().abs() < 0.12, "{rpm} rpm: {mean:?} {teeth:?}");
        }
    }
}

/// Teeth that pass eight times as fast as the one mode that gives 99 % of the compliance: what limits the cut are modes of a few thousandths, which
/// must not be left out.
#[test]
fn modes_that_give_little_of_the_compliance_decide_where_teeth_pass_fast() {
    let drives = [
        15.277_923_905_786_396,
        9.885_715_468_450_02,
        16.805_716_296_365_034,
        46.996_875_158_918_58,
        56.093_044_544_515_72,
        45.760_115_286_315_454,
    ];
    let robot = with_compliance(&find("KR 7 R900-3").unwrap().robot(), drives).unwrap();
    let q = [6.64, -62.07, 15.2, -16.33, 66.25, 66.97_f64].map(f64::to_radians);
    let tool = HeldTool {
        flange_from_tool: Pose::translation(0.0, 0.0, 0.2),
        body: Some(RigidBody::point(40.0, Vector3::new(0.03, 0.0, 0.15))),
    };
    let swing = modes(&robot, &q, &tool, Some(Damping::Ratio(0.03))).unwrap();
    let tool_axis = swing.tool.rotation * Vector3::z();
    let motion = swing.motion(&[1.0; 6], None).seen_along(&axes([0.09, -0.375, -0.366], &tool_axis).unwrap());
    let entry = PI - (1.0 - 2.0 * 13.98 / 50.0_f64).acos();
    let milling = mill(2, 0.05, [entry, PI], [1800e6, 900e6, 0.0]);
    let cut = cut(&milling, 4000.0);
    let teeth = Teeth::of(&motion, &cut);
    let edge = teeth.edge_at(cut.spindle, teeth.steps(cut.spindle), 1e-4).unwrap();
    let grown = [0.85, 1.1].map(|share| growth_in_time(&motion, &milling, 4000.0, share * edge.depth));
    assert!(grown[0] < 1.0 && 1.0 < grown[1], "{edge:?}: {grown:?}");
}

/// A short cut at a low speed, teeth passing at 20 Hz between the modes of an arm: the mean misleads, and the tooth knows.
#[test]
fn tooth_by_tooth_a_short_cut_of_an_arm_grows_above_its_edge_and_dies_below() {
    let robot = tx200([1.15e6, 3.76e6, 1.29e6, RIGID, RIGID, RIGID]);
    let swing = modes(&robot, &START_DEG.map(f64::to_radians), &tx200_spindle(), Some(Damping::Ratio(0.05))).unwrap();
    let motion = swing.motion(&[1.0; 6], None).seen_along(&axes([0.0, -1.0, 0.0], &Vector3::z()).unwrap());
    let milling = mill(2, 0.02, [PI - 0.45, PI], [1930.4e6, 1159.6e6, 200.6e6]);
    let mut apart = 0.0_f64;
    for rpm in [300.0, 620.0, 900.0] {
        let cut = cut(&milling, rpm);
        let teeth = Teeth::of(&motion, &cut);
        assert!(teeth.are_needed());
        let edge = teeth.edge_at(cut.spindle, teeth.steps(cut.spindle), 1e-5).unwrap();
        let grown = [0.97, 1.03].map(|share| growth_in_time(&motion, &milling, rpm, share * edge.depth));
        assert!(grown[0] < 1.0 && 1.0 < grown[1], "{rpm} rpm, {edge:?}: {grown:?}");
        let mean = Curve::of(&motion, &milling.mean_directional()).edge_at(cut.period_at(cut.spindle)).unwrap();
        apart = apart.max((mean.depth / edge.depth).ln().abs());
    }
    assert!(0.05 < apart, "{apart}");
    // Far above all modes a tooth tells what the mean does.
    let fast = cut(&milling, 6000.0);
    let teeth = Teeth::of(&motion, &fast);
    assert!(!teeth.are_needed());
    let edge = teeth.edge_at(fast.spindle, 60, 1e-4).unwrap();
    let mean = Curve::of(&motion, &milling.mean_directional()).edge_at(fast.period_at(fast.spindle)).unwrap();
    assert!((edge.depth / mean.depth - 1.0).abs() < 0.03, "{edge:?} {mean:?}");
}

/// A slow cut of an arm with a spindle: more steps than are taken would be needed to follow the spindle's mode, the mean over a revolution allows
/// 1.7 times the depth at 500 rpm, and the tooth knows.
#[test]
fn a_slow_cut_is_counted_tooth_by_tooth_where_a_fast_mode_is_followed_coarsely() {
    let mode = |hertz: f64, k: f64, [x, y]: [f64; 2]| {
        let own = TAU * hertz;
        (own, 0.03, [x, y, 0.0].map(|part| part * own / k.sqrt()))
    };
    let motion = Motion::uncoupled(&[
        mode(12.0, 1.2e6, [0.6, 0.8]),
        mode(21.0, 3.0e6, [0.8, -0.6]),
        mode(640.0, 1.5e7, [0.0, 1.0]),
        mode(980.0, 2.4e7, [1.0, 0.0]),
    ]);
    let milling = mill(4, 0.016, [PI - 0.7, PI], [796e6, 169e6, 222e6]);
    let mut apart = 0.0_f64;
    for rpm in [170.0, 330.0, 500.0] {
        let cut = cut(&milling, rpm);
        let (teeth, curve) = (Teeth::of(&motion, &cut), Curve::of(&motion, &milling.mean_directional()));
        let edge = teeth.edge_at(cut.spindle, teeth.steps(cut.spindle), 1e-5).unwrap();
        let grown = [0.94, 1.06].map(|share| growth_in_steps::<800>(&motion, &milling, rpm, share * edge.depth));
        assert!(teeth.are_needed() && grown[0] < 1.0 && 1.0 < grown[1], "{rpm} rpm, {edge:?}: {grown:?}");
        apart = apart.max((curve.edge_at(cut.period_at(cut.spindle)).unwrap().depth / edge.depth).ln().abs());
    }
    assert!(0.5 < apart, "{apart}");
}

/// That an edge is one and the first, by the determinant of the 2 x 2 of the loop gain `G A0` and not by its eigenvalues: there it is 0; at
/// 0.999 of the depth it does not turn about 0 up to a frequency, Hz, in so many steps, at 1.001 it does (Nyquist).
pub(crate) fn swings_first_at(
    edge: stiffarm::chatter::Edge,
    gain: impl Fn(f64) -> Matrix3x2<Complex<f64>>,
    period: f64,
    (highest, steps): (f64, u32),
) {
    let one = Complex::new(1.0, 0.0);
    // Of each of some depths.
    let determinants = |w: f64, depths: [f64; 2]| {
        let whole = gain(w) * (one - Complex::from_polar(1.0, -w * period));
        let [a, b, c, d] = [(0, 0), (1, 1), (0, 1), (1, 0)].map(|at| whole[at]);
        depths.map(|depth| (one - a * depth) * (one - b * depth) - c * d * depth * depth)
    };
    let at_edge = determinants(TAU * edge.frequency, [edge.depth; 2])[0].norm();
    assert!(at_edge < 1e-6, "{edge:?}: {at_edge}");
    let depths = [0.999 * edge.depth, 1.001 * edge.depth];
    let (mut turned, mut last) = ([0.0; 2], determinants(0.0, depths));
    for i in 1..=steps {
        let now = determinants(TAU * highest * f64::from(i) / f64::from(steps), depths);
        for (turned, (now, last)) in turned.iter_mut().zip(now.iter().zip(last)) {
            *turned += (now * last.conj()).arg();
        }
        last = now;
    }
    let [below, above] = turned.map(|angle| (angle / PI).round());
    assert_eq!(below, 0.0, "{edge:?}");
    assert_ne!(above, 0.0, "{edge:?}");
}

/// `det(I - a (1 - e^(-i w T)) A0 G(w)) = 0` on a fine grid of frequencies, with the receptance of the arm itself.
#[test]
fn no_frequency_swings_at_less_than_the_depth_that_is_reported() {
    let (robot, tool, q) = kr210();
    let swing = modes(&robot, &q, &tool, Some(Damping::Ratio(0.04))).unwrap();
    let cut_axes = axes([0.2, 1.0, 0.0], &-(swing.tool.rotation * Vector3::z())).unwrap();
    let motion = swing.motion(&[1.0; 6], None).seen_along(&cut_axes);
    let milling = mill(3, 0.016, [0.0, 2.0], [800e6, 250e6, 180e6]);
    let curve = Curve::of(&motion, &milling.mean_directional());
    let factors = milling.mean_directional().map(|x| Complex::new(x, 0.0));
    let along = cut_axes.map(|x| Complex::new(x, 0.0));
    let mut least_of_all = f64::INFINITY;
    for rpm in [120.0, 431.0, 900.0, 2500.0, 12_000.0] {
        let period = 60.0 / (3.0 * rpm);
        let edge = curve.edge_at(period).unwrap();
        least_of_all = least_of_all.min(edge.depth);
        let gain = |w: f64| along.transpose() * swing.receptance(w / TAU).unwrap() * along * factors;
        swings_first_at(edge, gain, period, (200.0, 20_000));
    }
    let any = curve.any_speed().unwrap();
    assert!(any.depth <= least_of_all);
    // At the speed that meets its frequency the edge is that depth.
    let mu = 0.5 / any.depth;
    let found = (0..2000).map(|i| curve.edge_at(0.5 / any.frequency * (1.0 + f64::from(i) / 1e3)).unwrap().depth);
    let least = found.fold(f64::INFINITY, f64::min);
    assert!((least / any.depth - 1.0).abs() < 1e-3 && mu.is_finite(), "{least} {any:?}");
}

/// The eigenvalues of `M x'' + D x' + (K - a A0) x = 0` in its modes: on the left of the axis below the depth, one on the right above.
#[test]
fn without_the_delay_an_eigenvalue_crosses_the_axis_at_the_depth_that_is_reported() {
    let motion = tx200_motion();
    let factors = task().mean_directional();
    let pan = Curve::of(&motion, &factors).without_delay().unwrap();
    let rightmost = |depth: f64| {
        let n = motion.own.len();
        let push = motion.tip.transpose() * factors * motion.tip.rows(0, 2) * depth;
        let rate = DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
            (true, _) => f64::from(u8::from(j == i + n)),
            (false, true) => push[(i - n, j)] - if i - n == j { motion.own[j].powi(2) } else { 0.0 },
            (false, false) => -motion.friction[(i - n, j - n)],
        });
        rate.complex_eigenvalues().iter().map(|value| value.re).fold(f64::NEG_INFINITY, f64::max)
    };
    assert!(rightmost(0.9999 * pan.depth) < 0.0 && 0.0 < rightmost(1.0001 * pan.depth));
    assert!((0..100).all(|i| rightmost(pan.depth * f64::from(i) / 101.0) < 0.0));
}

/// One soft mode across many fast teeth: `w T << 1`, and the cut is a damper `-a T A0`: the limit is `2 zeta k / (w T A)`.
#[test]
fn a_cut_of_fast_teeth_is_a_damper_that_drives_or_calms() {
    let (own, ratio, mass) = (TAU * 8.0, 0.04, 60.0_f64);
    let motion = Motion::uncoupled(&[(own, ratio, [0.0, 1.0 / mass.sqrt(), 0.0])]);
    // A slot damps every direction: x A0 x < 0. Half immersion up drives what lies across.
    let slot = mill(4, 0.02, [0.0, PI], [1930e6, 600e6, 200e6]);
    let up = mill(4, 0.02, [0.0, FRAC_PI_2], [1930e6, 600e6, 200e6]);
    let period = 1e-4;
    assert_eq!(Curve::of(&motion, &slot.mean_directional()).edge_at(period), None);
    let factor = up.mean_directional()[(1, 1)];
    assert!(0.0 < factor);
    let edge = Curve::of(&motion, &up.mean_directional()).edge_at(period).unwrap();
    // To the square of w T, and the shift of the frequency.
    close(edge.depth, 2.0 * ratio * mass * own / (period * factor), 5e-3);
}

#[test]
fn the_axes_of_the_cut_are_feed_left_and_away() {
    let found = axes([2.0, 0.0, -0.5], &Vector3::z()).unwrap();
    assert!((found - Matrix3::identity()).norm() < 1e-15, "{found}");
}
