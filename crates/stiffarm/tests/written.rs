//! Does a robot survive being written down, to the last bit?

use std::collections::BTreeMap;

use nalgebra::{Matrix6, Vector6};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use stiffarm::body::Body;
use stiffarm::catalogue::{read, write};
use stiffarm::drive::{Architecture, Drives, GravityCompensator, Identified, JointCompliance, Motors, Transmission};
use stiffarm::geometry::Geometry;
use stiffarm::interval::Interval;
use stiffarm::limits::{Limits, PENDANT_SOURCE, Pendant, ThirdAxis, Verified};
use stiffarm::plane::PlanarArm;
use stiffarm::robot::{Arm, Robot, Status};

/// Lengths as a file may have them, in m.
fn length(min_mm: f64, max_mm: f64) -> impl Strategy<Value = f64> {
    prop_oneof![(min_mm..max_mm).prop_map(|mm| mm / 1e3), (min_mm..max_mm).prop_map(|mm| mm.round() / 1e3)]
}

/// Zero or a length of either sign.
fn offset() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), length(-900.0, -6.0), length(6.0, 900.0)]
}

fn angle(min: f64, max: f64) -> impl Strategy<Value = f64> {
    prop_oneof![(min..max).prop_map(f64::to_radians), (min..max).prop_map(|deg| deg.round().to_radians())]
}

/// So wide that every arm reaches something.
fn range() -> impl Strategy<Value = Interval> {
    (angle(-350.0, -185.0), angle(185.0, 350.0)).prop_map(|(min, max)| Interval::spanning(min, max))
}

fn compliance() -> impl Strategy<Value = f64> {
    prop_oneof![Just(1e-6), (0.01..50.0).prop_map(|urad| urad / 1e6)]
}

fn six<S: Strategy>(strategy: impl Fn() -> S) -> impl Strategy<Value = [S::Value; 6]> {
    [strategy(), strategy(), strategy(), strategy(), strategy(), strategy()]
}

fn geometry() -> impl Strategy<Value = Geometry> {
    let lengths = (offset(), offset(), offset(), offset(), length(200.0, 2000.0), length(200.0, 2000.0), offset());
    let sign = six(|| prop_oneof![Just(1.0), Just(-1.0)]);
    (lengths, six(|| angle(-90.0, 90.0)), sign).prop_map(|((a1, a2, b, c1, c2, c3, c4), offset, sign)| Geometry {
        a1,
        a2,
        b,
        c1,
        c2,
        c3,
        c4,
        offset,
        sign,
    })
}

fn limits() -> impl Strategy<Value = Limits> {
    // Beside a limit on the elbow itself, one on the enclosed angle may leave nothing.
    let enclosed = (angle(1.0, 60.0), angle(300.0, 359.0)).prop_map(|(min, max)| Interval::spanning(min, max));
    let third = prop_oneof![
        Just((ThirdAxis::Elbow, Interval::ALL)),
        Just((ThirdAxis::Forearm, Interval::ALL)),
        enclosed.prop_map(|enclosed| (ThirdAxis::Forearm, enclosed)),
    ];
    let speeds = proptest::option::of(six(|| angle(1.0, 900.0)));
    let verified = (3_usize..20, 0_u32..50).prop_map(|(rows, um)| {
        let largest = f64::from(um) / 1e3 / 1e3;
        Pendant::Verified(Verified { rows, date: "2026-05-31".into(), largest })
    });
    let pendant = prop_oneof![Just(Pendant::Unknown), Just(Pendant::AsFile), verified];
    (six(range), third, pendant, speeds).prop_map(|(joints, (third_axis, elbow), pendant, speeds)| Limits {
        joints,
        third_axis,
        pendant,
        elbow,
        speeds,
    })
}

fn drives(architecture: Architecture) -> impl Strategy<Value = Drives> {
    let geared = (-2.0..2.0).prop_map(move |ratio| {
        let mut transmission = Transmission::of(architecture);
        transmission.0[(5, 4)] = ratio;
        transmission
    });
    let transmission = prop_oneof![Just(Transmission::of(architecture)), geared];
    // Ends that never meet, and a spring far softer than any drive.
    let compensator =
        (length(-900.0, -800.0), offset(), length(10.0, 200.0), 1.0..9.0).prop_map(|(far, near, free, k)| {
            GravityCompensator { base: [far, -far], arm: [near, 0.0], stiffness: k * 1e3, free_length: free }
        });
    (six(compliance), transmission, proptest::option::of(compensator), proptest::option::of(identified())).prop_map(
        |(k, transmission, compensator, identified)| Drives {
            compliance: JointCompliance(k),
            transmission,
            compensator,
            identified,
            scatter: None,
            motors: Motors::UNKNOWN,
        },
    )
}

/// With a covariance that is the square of a matrix, and so is one; read from a file, to whose numbers it is rounded.
fn identified() -> impl Strategy<Value = Identified> {
    let square = |parts: [f64; 6]| {
        let part = Vector6::from(parts);
        let whole = Matrix6::from_diagonal(&part.map(f64::abs)) + part * part.transpose();
        let rounded = |x: f64| (x * 1e6).round() / 1e6 * 1e-12;
        Matrix6::from_fn(|i, j| rounded(whole[(i.min(j), i.max(j))]))
    };
    let date = prop_oneof![Just(None), Just(Some("2024-02-29".to_owned()))];
    let rms = || proptest::option::of(length(0.1, 10.0));
    // What nothing moved has nothing to be explained.
    let moved = proptest::option::of(length(1.0, 10.0));
    (six(|| 0.01..2.0_f64), six(any::<bool>), 2_usize..500, date, length(0.0, 10.0), rms(), moved).prop_map(
        move |(parts, drives, postures, date, residual, left_out, moved)| Identified {
            drives,
            covariance: square(parts),
            postures,
            date,
            residual,
            left_out,
            moved,
        },
    )
}

fn planar(architecture: Architecture) -> impl Strategy<Value = PlanarArm> {
    let all = || prop_oneof![Just(Interval::ALL), range()];
    (length(200.0, 3000.0), length(200.0, 3000.0), compliance(), compliance(), all(), all(), all()).prop_map(
        move |(l2, l3, k2, k3, shoulder, elbow, forearm)| PlanarArm {
            l2,
            l3,
            k2,
            k3,
            architecture,
            shoulder,
            elbow,
            forearm,
        },
    )
}

/// Boxed: the trees by which proptest shrinks what it drew would not fit into the stack of a test.
fn arm(architecture: Architecture) -> impl Strategy<Value = Arm> {
    let six = (geometry().boxed(), limits().boxed(), drives(architecture).boxed());
    prop_oneof![
        six.prop_map(|(geometry, limits, drives)| Arm::SixAxis { geometry, limits, drives }).boxed(),
        planar(architecture).prop_map(Arm::Planar).boxed()
    ]
    .boxed()
}

/// A file that leaves out what is assumed can say this.
fn may_be_assumed(arm: &Arm) -> bool {
    let paper = JointCompliance::PAPER;
    match arm {
        Arm::SixAxis { drives, .. } => drives.compliance == paper && drives.identified.is_none(),
        Arm::Planar(arm) => arm.k2 == paper.0[1] || arm.k3 == paper.0[2],
    }
}

fn robot() -> impl Strategy<Value = Robot> {
    // What steers terminals and lines is refused when a file is read.
    let legible = || any::<String>().prop_filter("a text", |text| !text.chars().any(stiffarm::plain::steers));
    let text = move || legible().prop_map(|text| format!("x{text}x"));
    let names = (text(), prop_oneof![Just(String::new()), text()], any::<bool>());
    let figures = (
        proptest::option::of(0.1..1e4),
        proptest::option::of(0.1..20.0),
        proptest::option::of(1.0..1e5),
        proptest::option::of(length(0.001, 10.0).prop_filter("a repeatability", |m| 1e-7 <= *m)),
        proptest::option::of([(); 4].map(|()| length(5.0, 1500.0))).prop_map(|radii| radii.map(Body::from)),
    );
    let source = proptest::collection::btree_map(legible(), legible(), 0..4);
    let kind = prop_oneof![Just(Architecture::Serial), Just(Architecture::QuasiSerial)];
    let arm = kind.prop_flat_map(|architecture| (Just(architecture), arm(architecture)));
    let status = proptest::sample::select(&Status::ALL[..]);
    (names, figures, source, arm, status).prop_map(
        |(
            (name, vendor, assumed),
            (payload_kg, reach, mass_kg, repeatability, body),
            source,
            (architecture, arm),
            status,
        )| {
            let mut source = BTreeMap::from_iter(source);
            if matches!(&arm, Arm::SixAxis { limits, .. } if limits.pendant == Pendant::AsFile) {
                source.insert(PENDANT_SOURCE.into(), "a manual".into());
            }
            Robot {
                name,
                vendor,
                architecture,
                architecture_is_assumed: assumed,
                stiffness_is_assumed: assumed && may_be_assumed(&arm),
                status,
                payload_kg,
                reach,
                mass_kg,
                repeatability,
                body: if matches!(arm, Arm::SixAxis { .. }) { body } else { None },
                enclosing: None,
                masses: Vec::new(),
                calibration: None,
                arm,
                source,
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn what_was_read_from_a_file_is_written_and_read_back_equal(robot in robot()) {
        let text = write(&robot);
        let back = read(&text, "written.toml");
        prop_assert_eq!(back.as_ref(), Ok(&robot), "{}", text);
    }

    #[test]
    fn any_length_and_angle_is_written_to_the_last_bit_or_the_one_beside_it(metres in 0.02..10.0_f64, radians in -17.0..17.0_f64) {
        let arm = PlanarArm {
            l2: metres,
            l3: 1.0,
            k2: 1e-6,
            k3: 1e-6,
            architecture: Architecture::Serial,
            shoulder: Interval::spanning(radians - 1.0, radians),
            elbow: Interval::ALL,
            forearm: Interval::ALL,
        };
        let robot = Robot {
            name: "two links".into(),
            vendor: String::new(),
            architecture: Architecture::Serial,
            architecture_is_assumed: false,
            stiffness_is_assumed: true,
            status: Status::Derived,
            payload_kg: None,
            reach: None,
            mass_kg: None,
            repeatability: None,
            body: None,
            enclosing: None,
            masses: Vec::new(),
            calibration: None,
            arm: Arm::Planar(arm.clone()),
            source: BTreeMap::new(),
        };
        let Arm::Planar(back) = read(&write(&robot), "written.toml").unwrap().arm else { panic!("planar") };
        let beside = |a: f64, b: f64| a.next_down() <= b && b <= a.next_up();
        prop_assert!(beside(arm.l2, back.l2) && beside(arm.shoulder.max(), back.shoulder.max()), "{:?} {:?}", arm, back);
    }
}
