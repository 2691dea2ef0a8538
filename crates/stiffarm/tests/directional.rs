//! By how much the force of teeth changes where the tool is off: numbers worked out apart, and sums over many angles.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Matrix3x2;
use stiffarm::cutting::{Edge, Engagement, Milling};

fn mill(edge: Edge) -> Milling {
    let engagement = Engagement::at_depth(1e-3, [FRAC_PI_2, PI], 1e-4);
    Milling { diameter: 0.016, teeth: 4, helix: 0.0, engagement, edge }
}

fn close(found: &Matrix3x2<f64>, expected: &Matrix3x2<f64>, within: f64) {
    assert!((found - expected).amax() < within * expected.amax(), "{found} is not {expected}");
}

const CHIP: [f64; 3] = [1930.4e6, 1159.6e6, 200.6e6];
const LINEAR: Edge = Edge::Linear { chip: CHIP, rubbing: [3e4, 2e4, 1e3] };

/// Half immersion down of the TX200's milling task, N/mm2, worked out apart, along the axis away from the work.
#[test]
fn the_mean_over_a_revolution_is_as_worked_out_apart() {
    let expected = Matrix3x2::new(34.6654, -596.0879, 1334.3121, -1194.2654, -127.7059, 127.7059);
    close(&(mill(LINEAR).mean_directional() * 1e-6), &expected, 1e-7);
}

/// `A0 u` is the change of the mean force with a displacement of every chip by `[sin, cos] u`, here as a sum over teeth.
#[test]
fn it_is_what_a_sum_over_many_angles_gives_under_either_law() {
    for edge in [LINEAR, Edge::Power { specific: 2e9, exponent: 0.3, ratios: [0.4, 0.1] }] {
        let one = mill(edge);
        let steps = 400_000;
        let turn = FRAC_PI_2 / f64::from(steps);
        let mut sum = Matrix3x2::zeros();
        for i in 0..steps {
            let (s, c) = (FRAC_PI_2 + (f64::from(i) + 0.5) * turn).sin_cos();
            let h = 1e-4 * s;
            let ([t, r, a], [t1, r1, a1]) = (edge.per_depth(h), edge.per_depth(h * 1.000_01));
            let [t, r, a] = [t1 - t, r1 - r, a1 - a].map(|more| more / (h * 1e-5));
            sum += Matrix3x2::from_row_slice(&[
                (-t * c - r * s) * s,
                (-t * c - r * s) * c,
                (t * s - r * c) * s,
                (t * s - r * c) * c,
                -a * s,
                -a * c,
            ]);
        }
        // A chip of no thickness at the exit: midpoints miss h^(1 - m) by a 1e-4th.
        close(&one.mean_directional(), &(sum * turn * 4.0 / TAU), 1e-4);
    }
}

/// Steps over a pitch add up to the mean, however many teeth cut at once.
#[test]
fn steps_over_a_pitch_add_up_to_the_mean() {
    for teeth in [1, 2, 3, 8] {
        let one = Milling { teeth, ..mill(LINEAR) };
        let (pitch, steps) = (TAU / teeth as f64, 7);
        let part = pitch / f64::from(steps);
        let angle = |i: i32| 0.3 + part * f64::from(i);
        let sum: Matrix3x2<f64> = (0..steps).map(|i| one.step_directional(angle(i), angle(i + 1))).sum();
        close(&(sum / f64::from(steps)), &one.mean_directional(), 1e-12);
    }
}
