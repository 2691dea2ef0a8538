//! What was measured at a tip: as modes and frequency by frequency it tells the same, alone it is the textbook's mode, and beside the robot their sum.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write;

use nalgebra::{Complex, Matrix3, Vector3};
use stiffarm::catalogue::find;
use stiffarm::chatter::{
    Asked, ByMean, Chatter, ChatterError, Cut, HeldBy, MeasuredMode, MeasuredTip, Method, Response, Samples, Verdict,
    axes, by_mean, chatter, read_response,
};
use stiffarm::cutting::{Law, Milling, Process};
use stiffarm::modes::{Damping, HeldTool, modes};
use stiffarm::robot::Robot;

use crate::chatter::{close, mill, swings_first_at};
use crate::modes::kr210;

const SPINDLE: [MeasuredMode; 3] = [
    MeasuredMode { frequency: 610.0, ratio: 0.03, stiffness: 2.2e7, direction: [1.0, 0.0, 0.0] },
    MeasuredMode { frequency: 655.0, ratio: 0.025, stiffness: 2.6e7, direction: [0.1, 1.0, 0.0] },
    MeasuredMode { frequency: 1480.0, ratio: 0.02, stiffness: 5.5e7, direction: [0.7, 0.7, 0.14] },
];

fn process(milling: &Milling, rpm: f64) -> Process {
    Process { spindle: Some(rpm * TAU / 60.0), is_clockwise: true, law: Law::Milling(milling.clone()) }
}

/// Well above half immersion, so that teeth are counted by their mean.
fn slot() -> Milling {
    mill(3, 0.016, [0.0, PI], [800e6, 250e6, 180e6])
}

/// Across the tool, and along none of its axes.
fn along_y() -> Vector3<f64> {
    Vector3::new(0.2, 1.0, 0.0)
}

/// `sum u u^T / k w0^2 / (w0^2 - w^2 + 2 i zeta w0 w)`, m/N.
fn receptance(modes: &[MeasuredMode], hertz: f64) -> Matrix3<Complex<f64>> {
    let of_mode = |mode: &MeasuredMode| {
        let u = Vector3::from(mode.direction) / Vector3::from(mode.direction).norm();
        let ratio = hertz / mode.frequency;
        let rest = Complex::new(1.0 - ratio * ratio, 2.0 * mode.ratio * ratio) * mode.stiffness;
        (u * u.transpose()).map(|part| Complex::new(part, 0.0) / rest)
    };
    modes.iter().map(of_mode).sum()
}

fn sampled(step: f64, to: f64, of: impl Fn(f64) -> Matrix3<Complex<f64>>) -> Response {
    let rows = (1..).map(|i| f64::from(i) * step).take_while(|hertz| *hertz <= to).map(|hertz| (hertz, of(hertz)));
    Response::Samples(Samples::new(rows.collect()).unwrap())
}

fn ask(feed: Vector3<f64>, measured: Option<&MeasuredTip>) -> Asked<'_> {
    Asked { feed: feed.into(), damping: Some(Damping::Ratio(0.04)), method: None, measured }
}

fn found(
    (robot, tool, q): &(Robot, HeldTool, [f64; 6]),
    milling: &Milling,
    rpm: f64,
    (feed, measured): (Vector3<f64>, &MeasuredTip),
) -> Chatter {
    chatter(robot, q, tool, &process(milling, rpm), &ask(feed, Some(measured))).unwrap()
}

/// The textbook's mode, along the feed: the bottom of its lobes is `2 k zeta (1 + zeta) / (N Kn / 4)`.
#[test]
fn one_mode_that_was_measured_on_the_robot_is_the_textbooks_whatever_the_robot() {
    let (own, ratio, mass, kn) = (TAU * 922.0, 0.011, 0.03993, 2e8);
    let stiffness = mass * own * own;
    let milling = mill(2, 0.02, [0.0, PI], [6e8, kn, 0.0]);
    let bottom = 2.0 * stiffness * ratio * (1.0 + ratio) / (2.0 * kn / 4.0);
    let tip = |direction: [f64; 3]| {
        let modes = [MeasuredMode { frequency: 922.0, ratio, stiffness, direction }];
        MeasuredTip { held_by: HeldBy::Robot, response: Response::of_modes(&modes) }
    };
    let arm = kr210();
    let pose = modes(&arm.0, &arm.2, &arm.1, None).unwrap().tool;
    let along = |tip_axis: Vector3<f64>| pose.rotation * tip_axis;
    let answer = found(&arm, &milling, 10_000.0, (along(Vector3::x()), &tip([1.0, 0.0, 0.0])));
    close(answer.any_speed.unwrap().depth, bottom, 1e-6);
    assert_eq!((answer.robot_modes.len(), answer.drives_are_drawn, answer.drives_are_assumed), (0, false, false));
    assert_eq!(answer.spread.p05, answer.spread.p95);
    // Turned together nothing changes; across the feed half immersion drives a mode otherwise than along it.
    let turned = found(&arm, &milling, 10_000.0, (along(Vector3::y()), &tip([0.0, 1.0, 0.0])));
    close(turned.any_speed.unwrap().depth, bottom, 1e-6);
    let half = mill(2, 0.02, [0.0, FRAC_PI_2], [6e8, kn, 0.0]);
    let depth = |feed: Vector3<f64>| {
        found(&arm, &half, 10_000.0, (along(feed), &tip([1.0, 0.0, 0.0]))).any_speed.map(|edge| edge.depth)
    };
    assert!(depth(Vector3::y()).is_none_or(|across| 0.1 < (across / depth(Vector3::x()).unwrap() - 1.0).abs()));
    // A robot without masses does as well: the model of it does not count.
    let bare = find("IRB 6650S-200").unwrap().robot();
    let other = (bare, arm.1, arm.2);
    let pose = stiffarm::compliance::compliance(&other.0, &other.2, &other.1.flange_from_tool).unwrap().tool;
    let answer = found(&other, &milling, 10_000.0, (pose.rotation * Vector3::x(), &tip([1.0, 0.0, 0.0])));
    close(answer.any_speed.unwrap().depth, bottom, 1e-6);
    let rigid = MeasuredTip { held_by: HeldBy::Rigid, ..tip([1.0, 0.0, 0.0]) };
    let refused = chatter(&other.0, &other.2, &other.1, &process(&milling, 1e4), &ask(along_y(), Some(&rigid)));
    assert!(matches!(refused, Err(ChatterError::Modes(_))), "{refused:?}");
    // What was measured has no interval: it decides by itself.
    let mut deep = milling;
    deep.engagement.arcs[0].depth = 2.0 * answer.at_speed.unwrap().depth;
    let answer = found(&arm, &deep, 10_000.0, (along(Vector3::x()), &tip([1.0, 0.0, 0.0])));
    assert_eq!(answer.verdict(), Verdict::Limits(answer.at_speed.unwrap().depth));
}

#[test]
fn modes_and_their_receptance_frequency_by_frequency_tell_the_same() {
    let arm = kr210();
    for (held_by, to) in [(HeldBy::Rigid, 4000.0), (HeldBy::Robot, 4000.0)] {
        let of_modes = MeasuredTip { held_by, response: Response::of_modes(&SPINDLE) };
        let by_hertz = MeasuredTip { held_by, response: sampled(1.0, to, |hertz| receptance(&SPINDLE, hertz)) };
        for rpm in [900.0, 5200.0, 12_000.0] {
            let [a, b] = [&of_modes, &by_hertz].map(|tip| found(&arm, &slot(), rpm, (along_y(), tip)));
            // Lines 1 Hz apart over half widths of 15 Hz and more: chords miss arcs by 1e-3.
            for (a, b) in [
                (a.at_speed, b.at_speed),
                (a.any_speed, b.any_speed),
                (a.other_way, b.other_way),
                (a.without_delay, b.without_delay),
            ] {
                let (Some(a), Some(b)) = (a, b) else {
                    assert_eq!(a, b, "{held_by:?} {rpm}");
                    continue;
                };
                close(b.depth, a.depth, 3e-3);
                close(b.frequency, a.frequency, 2e-3);
            }
            assert_eq!(a.method, Method::Mean);
        }
    }
}

/// What the model says of a robot, handed in as if it had been measured, is what the model says.
#[test]
fn a_robot_measured_is_the_robot_modelled() {
    let arm = kr210();
    let (robot, tool, q) = &arm;
    let swing = modes(robot, q, tool, Some(Damping::Ratio(0.04))).unwrap();
    let turn = swing.tool.rotation.to_rotation_matrix().matrix().map(|x| Complex::new(x, 0.0));
    let of = |hertz: f64| turn.transpose() * swing.receptance(hertz).unwrap() * turn;
    let tip = MeasuredTip { held_by: HeldBy::Robot, response: sampled(0.02, 120.0, of) };
    // No axis of the tool lies along the feed.
    let feed = Vector3::new(0.6, 1.0, 0.0);
    let milling = mill(3, 0.016, [0.0, 2.2], [800e6, 250e6, 180e6]);
    for rpm in [120.0, 900.0] {
        let modelled = chatter(robot, q, tool, &process(&milling, rpm), &ask(feed, None)).unwrap();
        let measured = found(&arm, &milling, rpm, (feed, &tip));
        for (a, b) in [
            (modelled.at_speed, measured.at_speed),
            (modelled.any_speed, measured.any_speed),
            (modelled.other_way, measured.other_way),
        ] {
            close(b.unwrap().depth, a.unwrap().depth, 3e-3);
            close(b.unwrap().frequency, a.unwrap().frequency, 1e-3);
        }
    }
}

/// `det(I - a (1 - e^(-i w T)) A0 G) = 0` where G is the sum of what the robot and the spindle do.
#[test]
fn beside_the_robot_the_edge_is_that_of_the_sum_of_both() {
    let arm = kr210();
    let (robot, tool, q) = &arm;
    let swing = modes(robot, q, tool, Some(Damping::Ratio(0.04))).unwrap();
    let feed = Vector3::new(0.2, 1.0, 0.0);
    let cut_axes = axes(feed.into(), &-(swing.tool.rotation * Vector3::z())).unwrap().map(|x| Complex::new(x, 0.0));
    let turn = swing.tool.rotation.to_rotation_matrix().matrix().map(|x| Complex::new(x, 0.0));
    let factors = slot().mean_directional().map(|x| Complex::new(x, 0.0));
    let tip = MeasuredTip { held_by: HeldBy::Rigid, response: Response::of_modes(&SPINDLE) };
    for rpm in [431.0, 4000.0, 12_000.0, 18_000.0] {
        let answer = found(&arm, &slot(), rpm, (feed, &tip));
        let edge = answer.at_speed.unwrap();
        let gain = |w: f64| {
            let hertz = w / TAU;
            let both = swing.receptance(hertz).unwrap() + turn * receptance(&SPINDLE, hertz) * turn.transpose();
            cut_axes.transpose() * both * cut_axes * factors
        };
        swings_first_at(edge, gain, 60.0 / (3.0 * rpm), (3000.0, 60_000));
        assert_eq!((answer.robot_modes.len(), answer.measured.unwrap().modes.len()), (6, 3));
        // Along a path the same is reported of each posture.
        let cut = stiffarm::chatter::Cut::of(&process(&slot(), rpm)).unwrap();
        let one = by_mean(robot, q, tool, &cut, &ask(feed, Some(&tip))).unwrap();
        assert_eq!(one.edge, Some(edge));
    }
}

#[test]
fn without_modes_teeth_are_not_counted_one_by_one() {
    let arm = kr210();
    let short = mill(2, 0.02, [PI - 0.45, PI], [1930e6, 1160e6, 200e6]);
    let of = |response: Response, method: Option<Method>| {
        let tip = MeasuredTip { held_by: HeldBy::Rigid, response };
        let asked = Asked { method, ..ask(along_y(), Some(&tip)) };
        chatter(&arm.0, &arm.2, &arm.1, &process(&short, 9000.0), &asked)
    };
    let samples = || sampled(2.0, 4000.0, |hertz| receptance(&SPINDLE, hertz));
    assert_eq!(of(samples(), Some(Method::Teeth)).err(), Some(ChatterError::NoModes));
    let answer = of(samples(), None).unwrap();
    assert_eq!((answer.method, answer.may_mislead()), (Method::Mean, true));
    let answer = of(Response::of_modes(&SPINDLE), None).unwrap();
    assert_eq!((answer.method, answer.may_mislead()), (Method::Teeth, false));
    // However slowly teeth pass, and however many steps it would take to follow the fastest mode.
    let soft = SPINDLE.map(|mode| MeasuredMode { stiffness: mode.stiffness / 8.0, ..mode });
    let tip = MeasuredTip { held_by: HeldBy::Rigid, response: Response::of_modes(&soft) };
    let slow = found(&arm, &short, 200.0, (along_y(), &tip));
    let by_mean = chatter_by_mean(&arm, &process(&short, 200.0), &ask(along_y(), Some(&tip)));
    let [teeth, mean] = [slow.at_speed.unwrap().depth, by_mean.edge.unwrap().depth];
    assert!(slow.method == Method::Teeth && by_mean.misleads && 0.05 < (mean / teeth).ln().abs(), "{teeth} {mean}");
    let wide = found(&arm, &slot(), 9000.0, (along_y(), &MeasuredTip { held_by: HeldBy::Rigid, response: samples() }));
    assert!(!wide.may_mislead());
}

fn chatter_by_mean((robot, tool, q): &(Robot, HeldTool, [f64; 6]), process: &Process, asked: &Asked) -> ByMean {
    by_mean(robot, q, tool, &Cut::of(process).unwrap(), asked).unwrap()
}

fn table(step: f64, columns: &[&str], of: impl Fn(f64) -> Matrix3<Complex<f64>>) -> String {
    let mut text = format!("freq_hz,{}\n", columns.join(","));
    for i in 1..=60 {
        let hertz = f64::from(i) * step;
        let found = of(hertz);
        write!(text, "{hertz}").unwrap();
        for column in columns {
            let at = |i: usize| usize::from(column.as_bytes()[i] - b'x');
            let part = found[(at(1), at(2))];
            write!(text, ",{}", if column.ends_with("re") { part.re } else { part.im }).unwrap();
        }
        text.push('\n');
    }
    text
}

#[test]
fn tables_are_read_as_they_are_meant_and_faults_are_named() {
    const TWO: &[&str] = &["gxx_re", "gxx_im", "gyy_re", "gyy_im"];
    const FIVE: &[&str] = &["gxx_re", "gxx_im", "gyy_re", "gyy_im", "gzz_re", "gzz_im", "gyx_re", "gyx_im"];
    let modes = [
        MeasuredMode { frequency: 300.0, ratio: 0.25, stiffness: 2e7, direction: [2.0, 1.0, 0.0] },
        MeasuredMode { frequency: 420.0, ratio: 0.25, stiffness: 3e7, direction: [-1.0, 2.0, 0.5] },
    ];
    let of = |hertz: f64| receptance(&modes, hertz);
    let read = |text: &str| read_response(text, "tip.csv", HeldBy::Rigid);
    let file = read(&table(20.0, FIVE, of)).unwrap();
    let Response::Samples(samples) = &file.response else { panic!("samples") };
    // The one of two that are alike is taken for both; what nobody measured is 0.
    let expected = (1..=60).map(|i| {
        let mut found = of(20.0 * f64::from(i));
        for at in [(0, 2), (2, 0), (1, 2), (2, 1)] {
            found[at] = Complex::new(0.0, 0.0);
        }
        (20.0 * f64::from(i), found)
    });
    assert_eq!(samples, &Samples::new(expected.collect()).unwrap());
    assert_eq!(file.remarks, ["gxz, gyz are not in the table and taken as 0"]);
    let coarse = read(&table(100.0, TWO, of)).unwrap().remarks;
    assert!(coarse.iter().any(|remark| remark.contains("Hz the response moves by")), "{coarse:?}");
    let noisy = table(20.0, TWO, |hertz| {
        let mut found = of(hertz);
        if hertz == 20.0 {
            found[(0, 0)].im = 0.2 * found[(0, 0)].norm();
        }
        found
    });
    let noisy = read(&noisy).unwrap().remarks;
    assert!(noisy.iter().any(|remark| remark.contains("at 1 of 60 frequencies the damping is negative")), "{noisy:?}");
    // A table of modes, in any order.
    let by_hand = "damping_ratio;freq_hz;stiffness_n_per_m;ux;uy;uz;note\n# tapped\n0.25;420;3e7;-1;2;0.5;b\n0.25;300;2e7;2;1;0;a\n";
    let file = read(by_hand).unwrap();
    assert_eq!(file.response, Response::of_modes(&modes));
    let [ignored, scaled] = file.remarks.as_slice() else { panic!("{:?}", file.remarks) };
    assert_eq!(ignored, "column note is ignored");
    // The length of (-1, 2, 0.5).
    assert!(scaled.starts_with("line 3: ux, uy, uz are 2.291 long and taken as a direction alone"), "{scaled}");
    // The same answer whichever of two places is tapped: a sign of one of them is not.
    let crossed = [TWO, &["gxy_re", "gxy_im", "gyx_re", "gyx_im"]].concat();
    let with_sign = |sign: f64| {
        table(20.0, &crossed, |hertz| {
            let mut found = of(hertz);
            found[(1, 0)] *= Complex::new(sign, 0.0);
            found
        })
    };
    for (sign, differs) in [(1.0, false), (-1.0, true)] {
        let remarks = read(&with_sign(sign)).unwrap().remarks;
        assert_eq!(
            remarks.iter().any(|one| one.contains("gxy and gyx, or another such pair, differ by")),
            differs,
            "{remarks:?}"
        );
    }

    let good = table(20.0, TWO, of);
    let conjugated = table(20.0, TWO, |hertz| of(hertz).conjugate());
    let unit = table(20.0, TWO, |hertz| of(hertz) * Complex::new(1e6, 0.0));
    let active = table(20.0, TWO, |hertz| {
        let mut found = of(hertz);
        if hertz < 210.0 {
            found[(0, 0)].im = 0.2 * found[(0, 0)].norm();
        }
        found
    });
    let late: Vec<&str> = good.lines().enumerate().filter(|(i, _)| *i == 0 || 24 < *i).map(|(_, line)| line).collect();
    let late = late.join("\n");
    let lines = |text: &str, kept: usize| text.lines().take(kept).collect::<Vec<_>>().join("\n");
    for (text, says) in [
        (String::new(), "tip.csv:1: no headings; expected freq_hz and gxx_re"),
        (good.replace("gyy_im", "gyy_imag"), "tip.csv:1: gyy_re without gyy_im"),
        (good.replace("gxx", "hxx"), "tip.csv:1: the columns are freq_hz, hxx_re"),
        (good.replace("gyy", "gxx"), "tip.csv:1: the column gxx_re is there twice"),
        (good.replace("\n40,", "\n20,"), "tip.csv:3: freq_hz: 20 Hz does not lie above the row before"),
        (good.replace("\n40,", "\nnan,"), "tip.csv:3: freq_hz: nan; expected a frequency from 0 to 100000 Hz"),
        (good.replace("\n40,", "\n40,1,"), "tip.csv:3: row 2: 6 cells; expected 5"),
        (lines(&good, 6), "tip.csv:1: 5 rows; expected at least 8 frequencies"),
        (conjugated, "tip.csv:1: gxx_im: more than 0 at the largest answer"),
        (unit, "expected a number of at most 0.00002 in size, m/N; mm/N and um/N are other units"),
        (
            by_hand.replace("0.25;300", "-0.25;300"),
            "tip.csv:4: damping_ratio: -0.25; expected a share of critical damping",
        ),
        (by_hand.replace("0.25;300", "0;300"), "tip.csv:4: damping_ratio: 0; expected"),
        (
            by_hand.replace(";2;1;0;", ";0;0;0;"),
            "tip.csv:4: ux: 0.0, 0.0, 0.0; expected the direction in which the tip moves",
        ),
        (by_hand.replace("2e7", "inf"), "tip.csv:4: stiffness_n_per_m: inf; expected a stiffness"),
        (by_hand.replace("ux", "u"), "tip.csv:1: the columns are damping_ratio, freq_hz"),
        (lines(by_hand, 1), "tip.csv:1: no rows; expected a mode a row"),
        (by_hand.replace(";2;1;0;", ";1e-200;0;0;"), "tip.csv:4: ux: 1e-200, 0.0, 0.0; expected the direction"),
        (by_hand.replace("2e7", "2e4"), "stiffness_n_per_m: 2e4; expected a stiffness from 100000 to 1e12 N/m"),
        (table(20.0, TWO, |_| Matrix3::zeros()), "tip.csv:1: gxx_re: 0 at every frequency"),
        (active, "frequencies the damping is negative; expected displacement over force"),
        (lines(&good, 10), "gxx_re: in the last row more than half of the answer in the first"),
        (late, "gxx_re: not more than 0 in the first row: the table begins above a resonance"),
    ] {
        let message = read(&text).err().unwrap_or_else(|| panic!("{text} is read")).to_string();
        assert!(message.contains(says), "{message}\n{says}");
    }
    assert_eq!(Samples::new(vec![(1.0, Matrix3::zeros())]), None);
}

/// Above its last frequency nothing is known of the tip, and all that the model knows of the robot.
#[test]
fn a_table_that_ends_below_the_modes_of_the_robot_leaves_them_there() {
    let arm = kr210();
    let stiff = |hertz: f64| receptance(&SPINDLE, hertz) * Complex::new(1e-3, 0.0);
    for rpm in [300.0, 900.0, 12_000.0] {
        let tip = MeasuredTip { held_by: HeldBy::Rigid, response: sampled(1.0, 30.0, stiff) };
        let with = found(&arm, &slot(), rpm, (along_y(), &tip));
        let asked = ask(along_y(), None);
        let without = chatter(&arm.0, &arm.2, &arm.1, &process(&slot(), rpm), &asked).unwrap();
        for (with, without) in [(with.at_speed, without.at_speed), (with.any_speed, without.any_speed)] {
            close(with.unwrap().depth, without.unwrap().depth, 1e-2);
            close(with.unwrap().frequency, without.unwrap().frequency, 1e-2);
        }
    }
}

#[test]
fn a_coarse_table_and_one_that_ends_below_the_teeth_decide_nothing() {
    let arm = kr210();
    let mut shallow = slot();
    shallow.engagement.arcs[0].depth = 1e-6;
    // Teeth pass at 450 Hz.
    let verdict = |step: f64, to: f64| {
        let response = sampled(step, to, |hertz| receptance(&SPINDLE, hertz));
        let tip = MeasuredTip { held_by: HeldBy::Robot, response };
        found(&arm, &shallow, 9000.0, (along_y(), &tip)).verdict()
    };
    assert_eq!(verdict(2.0, 3000.0), Verdict::Calm);
    assert_eq!(verdict(2.0, 440.0), Verdict::NotDecided);
    assert_eq!(verdict(300.0, 3000.0), Verdict::NotDecided);
}

/// Teeth that cut for half of the time or less hit: their mean called a cut calm up to 28.9 mm that swings from 12.1.
#[test]
fn a_table_without_modes_decides_nothing_of_short_cuts() {
    let arm = kr210();
    let tip =
        MeasuredTip { held_by: HeldBy::Robot, response: sampled(2.0, 3000.0, |hertz| receptance(&SPINDLE, hertz)) };
    for depth in [1e-6, 0.1] {
        let mut short = slot();
        short.teeth = 1;
        short.engagement = stiffarm::cutting::Engagement::at_depth(depth, [PI / 2.0, PI], 1e-4);
        let answer = found(&arm, &short, 4000.0, (along_y(), &tip));
        assert!(answer.may_mislead());
        assert_eq!((answer.verdict(), answer.calm_speeds()), (Verdict::NotDecided, None));
    }
}

/// One mode pushes with `u u^T`: `gxy` is the root of `gxx gyy` at most. Thirty times that is another unit, and so is a mode of a thousand tons.
#[test]
fn tables_in_another_unit_are_refused() {
    const FOUR: &[&str] = &["gxx_re", "gxx_im", "gyy_re", "gyy_im", "gxy_re", "gxy_im"];
    let modes = [
        MeasuredMode { frequency: 300.0, ratio: 0.25, stiffness: 2e7, direction: [0.9, 0.4, 0.0] },
        MeasuredMode { frequency: 420.0, ratio: 0.25, stiffness: 3e7, direction: [-0.4, 0.9, 0.0] },
    ];
    let crossed = |times: f64| {
        table(20.0, FOUR, |hertz| {
            let mut found = receptance(&modes, hertz);
            for at in [(0, 1), (1, 0)] {
                found[at] *= Complex::new(times, 0.0);
            }
            found
        })
    };
    let read = |text: &str| read_response(text, "tip.csv", HeldBy::Rigid);
    assert!(read(&crossed(1.0)).is_ok());
    let error = read(&crossed(30.0)).unwrap_err().to_string();
    assert!(
        error.contains("tip.csv:1: gxy_im: ") && error.contains("times what gxx and gyy allow at its peak"),
        "{error}"
    );
    let kilohertz = "freq_hz,damping_ratio,stiffness_n_per_m,ux,uy,uz\n0.612,0.03,2.2e7,1,0,0\n";
    // 2.2e7 / (2 pi 0.612)^2 kg.
    let error = read(kilohertz).unwrap_err().to_string();
    assert!(error.contains("tip.csv:2: freq_hz: 0.612 Hz with 2.2e7 N/m is a mass of 1487853 kg"), "{error}");
}
