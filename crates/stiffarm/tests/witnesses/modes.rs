//! How an arm swings: published modes, frequencies worked out apart from this library, hand calculations and identities.

use std::f64::consts::TAU;

use nalgebra::{Complex, Matrix3, Vector3};
use stiffarm::catalogue::{find, read, with_compliance, write};
use stiffarm::compliance::compliance;
use stiffarm::drive::Architecture;
use stiffarm::inverse::postures;
use stiffarm::load::Load;
use stiffarm::map::{MapOptions, Spacing, map};
use stiffarm::mass::{Carrier, GRAVITY, Mass, RigidBody, gravity_torques, mass_matrix};
use stiffarm::model::{ArmPosture, Model};
use stiffarm::modes::{Damping, FirstFrequencies, HeldTool, ModesError, Swing, SwingingArm, first_frequencies, modes};
use stiffarm::prior::with_prior;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;

/// Masses of a Staubli TX200 (Huynh's thesis on a milling robot), turned from the frames of its links to model zero; numbers only.
const TX200_MASSES: &[(usize, f64, [f64; 3], [f64; 6])] = &[
    (1, 364.0, [0.150, -0.008, 0.553], [12.248, -0.204, 1.552, 17.833, 0.25, 16.95]),
    (2, 256.1, [0.257, 0.374, 1.043], [36.584, 0.054, 0.178, 39.916, 0.741, 6.574]),
    (3, 98.7, [0.289, 0.060, 1.549], [0.569, -0.018, -0.073, 0.512, 0.025, 0.462]),
    (4, 40.8, [0.250, 0.004, 2.037], [1.23, 0.001, 0.0, 1.172, 0.062, 0.299]),
    (4, 5.4, [0.109, -0.054, 2.056], [0.078, 0.002, 0.0, 0.024, 0.005, 0.058]),
    (5, 13.6, [0.250, 0.0, 2.459], [0.026, 0.0, 0.0, 0.026, 0.0, 0.016]),
    (6, 0.6, [0.250, 0.0, 2.574], [0.0005, 0.0, 0.0, 0.0005, 0.0, 0.001]),
];
/// Where its published modes are given.
pub(crate) const START_DEG: [f64; 6] = [-91.2017, 26.2433, 113.0264, -2.0609, -34.2838, 1.3920];

pub(crate) fn tx200(drive_nm_per_rad: [f64; 6]) -> Robot {
    let robot = find("TX200").unwrap().robot();
    let urad = drive_nm_per_rad.map(|k| if k.is_infinite() { 0.0 } else { 1e6 / k });
    let mut robot = with_compliance(&robot, urad).unwrap();
    robot.masses = TX200_MASSES
        .iter()
        .map(|&(link, mass, centre, inertia)| Mass {
            carrier: Carrier::Link(link),
            body: RigidBody::new(mass, centre.into(), inertia),
        })
        .collect();
    robot
}

pub(crate) fn tx200_spindle() -> HeldTool {
    let turned = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 75_f64.to_radians());
    HeldTool {
        flange_from_tool: Pose::from_parts(Vector3::new(0.277, 0.0, 0.326).into(), turned),
        body: Some(RigidBody::new(
            61.4,
            Vector3::new(-0.048, -0.001, 0.173),
            [1.342, 0.002, 0.016, 1.622, 0.018, 0.548],
        )),
    }
}

fn frequencies(swing: &Swing) -> Vec<f64> {
    swing.modes.iter().map(|mode| mode.frequency).collect()
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance, "{found:?} is not {expected:?}");
    }
}

#[test]
fn three_springs_and_the_masses_of_a_tx200_give_its_published_modes_to_all_digits() {
    const RIGID: f64 = f64::INFINITY;
    let robot = tx200([1.15e6, 3.76e6, 1.29e6, RIGID, RIGID, RIGID]);
    let q = START_DEG.map(f64::to_radians);
    let swing = modes(&robot, &q, &tx200_spindle(), None).unwrap();
    // Angles of four decimals of a degree: 2e-6 of a length of metres, and half of that of a frequency.
    close(&frequencies(&swing), &[8.76944, 14.82100, 23.13586], 5e-5);

    let Arm::SixAxis { geometry, .. } = &robot.arm else { panic!("six axes") };
    let mut masses = robot.masses.clone();
    masses.push(Mass::held(geometry, &tx200_spindle().body.unwrap()));
    let m = mass_matrix(geometry, &q, &masses);
    let upper = [m[(0, 0)], m[(0, 1)], m[(0, 2)], m[(1, 1)], m[(1, 2)], m[(2, 2)]];
    close(&upper, &[377.1118, -38.6733, 0.1667, 330.1834, 74.2362, 98.3999], 2e-3);
}

#[test]
fn dampers_beside_the_drives_of_a_tx200_give_the_published_ratios() {
    const RIGID: f64 = f64::INFINITY;
    let robot = tx200([1.15e6, 3.76e6, 1.29e6, RIGID, RIGID, RIGID]);
    let damping = Damping::OfDrives([2820.0, 610.0, 1870.0, 0.0, 0.0, 0.0]);
    let swing = modes(&robot, &START_DEG.map(f64::to_radians), &tx200_spindle(), Some(damping)).unwrap();
    let ratios: Vec<f64> = swing.modes.iter().map(|mode| mode.damping_ratio).collect();
    close(&ratios, &[0.067, 0.033, 0.066], 6e-4); // three decimals are published
}

#[test]
fn six_springs_of_a_tx200_swing_first_at_the_frequency_worked_out_apart() {
    let robot = tx200([2.3e6, 8.6e6, 2.8e6, 3.0e6, 0.2e6, 0.9e6]);
    let swing = modes(&robot, &START_DEG.map(f64::to_radians), &tx200_spindle(), None).unwrap();
    assert!((swing.modes[0].frequency - 12.3767).abs() < 5e-5, "{:?}", frequencies(&swing));
    assert_eq!(swing.modes.len(), 6);
}

pub(crate) fn kr210() -> (Robot, HeldTool, [f64; 6]) {
    let robot = find("KR 210 R2700-2").unwrap().robot();
    let robot = with_compliance(&robot, [0.477, 0.296, 0.358, 2.52, 3.01, 2.1]).unwrap();
    let body = RigidBody::point(60.0, Vector3::new(0.0, 0.0, 0.2));
    let tool = HeldTool { flange_from_tool: Pose::translation(0.0, 0.0, 0.2), body: Some(body) };
    (robot, tool, [0.0, -90.0, 90.0, 0.0, 45.0, 0.0].map(f64::to_radians))
}

#[test]
fn the_kr_210_of_the_catalogue_swings_as_its_published_masses_say() {
    let (robot, tool, q) = kr210();
    let found = frequencies(&modes(&robot, &q, &tool, None).unwrap());
    close(&found[..4], &[9.4584, 10.3533, 19.1985, 44.727], 6e-4);
    assert!((found[4] - 57.146).abs() < 1e-3, "{found:?}");
    let weight: f64 = robot.masses.iter().map(|mass| mass.body.mass).sum();
    assert!((weight - 1077.4).abs() < 0.05, "{weight}");
}

/// 75 postures of 25 robots with tools, as the mass matrix of Pinocchio and the eigenvalues of `SciPy` have them (`scripts/swinging.py`).
#[test]
fn postures_of_every_serial_robot_with_masses_swing_as_two_other_programs_say() {
    let text = include_str!("../../../../validation/modes_cases.csv");
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let columns = reader.headers().unwrap().clone();
    let mut count = 0;
    for record in reader.records().map(Result::unwrap) {
        let cell = |name: &str| &record[columns.iter().position(|column| column == name).unwrap()];
        let numbers = |name: &str| cell(name).split(' ').map(|x| x.parse().unwrap()).collect::<Vec<f64>>();
        let three = |name: &str| Vector3::from_vec(numbers(name)) / 1e3;
        let six = |name: &str| <[f64; 6]>::try_from(numbers(name)).unwrap();
        let robot = with_compliance(&find(cell("robot")).unwrap().robot(), six("drive_urad_per_nm")).unwrap();
        let body = RigidBody::new(numbers("tool_mass_kg")[0], three("tool_com_mm"), six("tool_inertia_kg_m2"));
        let [x, y, z] = three("tip_mm").into();
        let tool = HeldTool { flange_from_tool: Pose::translation(x, y, z), body: Some(body) };
        let swing = modes(&robot, &six("joints_deg").map(f64::to_radians), &tool, None).unwrap();
        // Springs differ by a factor of twenty and masses by thousands: eigenvalues are good to 1e-16 of the largest.
        close(&frequencies(&swing), &numbers("frequency_hz"), 1e-8);
        let shapes = numbers("tip_shapes");
        for (mode, shape) in swing.modes.iter().zip(shapes.chunks(3)) {
            let shape = Vector3::from_column_slice(shape);
            let apart = (mode.tip - shape).norm().min((mode.tip + shape).norm());
            assert!(apart < 1e-6 * shape.norm().max(1e-3), "{}: {} {shape}", cell("robot"), mode.tip);
        }
        let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { panic!("six axes") };
        let theta = geometry.model_angles(&six("joints_deg").map(f64::to_radians), limits.third_axis);
        let masses: Vec<Mass> = robot.masses.iter().copied().chain([Mass::held(geometry, &body)]).collect();
        let (turned, expected) = (gravity_torques(geometry, &theta, &masses), six("gravity_nm"));
        // Some thousand N m, of a dozen products each.
        assert!((turned - nalgebra::Vector6::from(expected)).norm() < 1e-9, "{}: {turned} {expected:?}", cell("robot"));
        count += 1;
    }
    assert_eq!(count, 75);
}

/// Two links in a plane with a point mass each, worked out by hand: `M = [[m1 l1^2 + m2 r^2, ..], [.., m2 l3^2]]`.
#[test]
fn two_links_with_a_mass_at_each_end_swing_as_the_double_pendulum_of_a_textbook() {
    let robot = find("KR 210 R2700 extra").unwrap().robot();
    let mut robot = with_compliance(&robot, [0.0, 0.5, 2.0, 0.0, 0.0, 0.0]).unwrap();
    let Arm::SixAxis { geometry, drives, .. } = &mut robot.arm else { panic!("six axes") };
    (geometry.a2, geometry.b) = (0.0, 0.0);
    drives.motors.rotor = Some([1.0, 40.0, 25.0, 1.0, 1.0, 1.0]);
    let (l2, l3, m1, m2) = (geometry.c2, geometry.c3, 90.0, 50.0);
    let elbow = Vector3::new(geometry.a1, 0.0, geometry.c1 + l2);
    let wrist = elbow + Vector3::new(0.0, 0.0, l3);
    let dust = |link| Mass { carrier: Carrier::Link(link), body: RigidBody::point(1e-9, wrist) };
    robot.masses = [1, 4, 5, 6].map(dust).to_vec();
    for (link, mass, at) in [(2, m1, elbow), (3, m2, wrist)] {
        robot.masses.push(Mass { carrier: Carrier::Link(link), body: RigidBody::point(mass, at) });
    }
    let bare = HeldTool { flange_from_tool: Pose::identity(), body: None };
    for architecture in Architecture::ALL {
        robot.architecture = architecture;
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { panic!("six axes") };
        drives.transmission = stiffarm::drive::Transmission::of(architecture);
        let swing =
            modes(&robot, &[0.0, -90_f64.to_radians(), 60_f64.to_radians(), 0.0, 0.4, 0.0], &bare, None).unwrap();
        // The elbow is bent by 60 deg: relative angle of the links on a serial arm, absolute of the forearm on the other.
        let c = 0.5;
        let m22 = m2 * l3 * l3;
        let [m11, m12] = match architecture {
            Architecture::Serial => {
                [m1 * l2 * l2 + m2 * (l2 * l2 + l3 * l3 + 2.0 * l2 * l3 * c), m2 * (l3 * l3 + l2 * l3 * c)]
            }
            Architecture::QuasiSerial => [(m1 + m2) * l2 * l2, m2 * l2 * l3 * c],
        };
        let (k1, k2) = (1e6 / 0.5, 1e6 / 2.0);
        // det(K - x M) = 0.
        let by_hand = |m11: f64, m12: f64, m22: f64| {
            let (a, b) = (m11 * m22 - m12 * m12, k1 * m22 + k2 * m11);
            let root = (b * b - 4.0 * a * k1 * k2).sqrt();
            [(b - root) / (2.0 * a), (b + root) / (2.0 * a)].map(|x| x.sqrt() / TAU)
        };
        // Masses of 1e-9 kg beside 50 kg.
        close(&frequencies(&swing), &by_hand(m11, m12, m22), 1e-7);
        // Free rotors, with the inverse of M^-1 + J^-1 written out.
        let determinant = m11 * m22 - m12 * m12;
        let [a, b, d] = [m22 / determinant + 1.0 / 40.0, -m12 / determinant, m11 / determinant + 1.0 / 25.0];
        let whole = a * d - b * b;
        let free: Vec<f64> = swing.modes.iter().map(|mode| mode.motors_free.unwrap()).collect();
        close(&free, &by_hand(d / whole, -b / whole, a / whole), 1e-7);
    }
}

#[test]
fn at_rest_the_receptance_is_the_compliance_and_the_modes_add_up_to_it() {
    let (robot, tool, q) = kr210();
    let swing = modes(&robot, &q, &tool, None).unwrap();
    let at_rest = compliance(&robot, &q, &tool.flange_from_tool).unwrap().compliance.translation();
    let found = swing.receptance(0.0).unwrap();
    let real = found.map(|x| x.re);
    let size = at_rest.norm();
    assert!((real - at_rest).norm() < 1e-14 * size * 10.0 && found.map(|x| x.im).norm() == 0.0, "{found}");
    // sum of tip tip^T / w^2 over all modes.
    let by_modes: Matrix3<f64> =
        swing.modes.iter().map(|mode| mode.tip * mode.tip.transpose() / (TAU * mode.frequency).powi(2)).sum();
    assert!((by_modes - at_rest).norm() < 1e-10 * size);
}

#[test]
fn a_receptance_is_the_sum_of_its_modes_under_one_ratio_of_damping() {
    let (robot, tool, q) = kr210();
    let zeta = 0.05;
    let swing = modes(&robot, &q, &tool, Some(Damping::Ratio(zeta))).unwrap();
    for hertz in [3.0, 9.4584, 15.0, 60.0, 300.0] {
        let w = TAU * hertz;
        let sum: Matrix3<Complex<f64>> = swing
            .modes
            .iter()
            .map(|mode| {
                let own = TAU * mode.frequency;
                let whole = Complex::new(own * own - w * w, 2.0 * zeta * own * w);
                (mode.tip * mode.tip.transpose()).map(|x| Complex::new(x, 0.0) / whole)
            })
            .sum();
        let found = swing.receptance(hertz).unwrap();
        assert!((found - sum).norm() < 1e-9 * sum.norm(), "{hertz} Hz");
        assert!(swing.modes.iter().all(|mode| (mode.damping_ratio - zeta).abs() < 1e-12));
    }
}

#[test]
fn turning_joint_1_turns_the_shapes_and_leaves_the_frequencies() {
    let (robot, tool, mut q) = kr210();
    let before = modes(&robot, &q, &tool, None).unwrap();
    q[0] = 0.8;
    let after = modes(&robot, &q, &tool, None).unwrap();
    close(&frequencies(&after), &frequencies(&before), 1e-9);
    // Joint 1 of a KUKA counts clockwise.
    let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), -0.8);
    for (a, b) in after.modes.iter().zip(&before.modes) {
        let turned = turn * b.tip;
        assert!((a.tip - turned).norm().min((a.tip + turned).norm()) < 1e-9);
        assert!((a.drive_shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}

/// Links do not stretch: of two ends of a link the difference of their motions is across it. The flange moves as a tip without a tool does.
#[test]
fn in_every_mode_the_links_keep_their_lengths_and_the_flange_moves_with_the_last() {
    let (robot, tool, _) = kr210();
    let tool = HeldTool { flange_from_tool: Pose::identity(), ..tool };
    let q = [0.3, -1.4, 1.5, 0.4, 0.7, -0.2];
    let swing = modes(&robot, &q, &tool, None).unwrap();
    let wrist_to_flange = (swing.points[4] - swing.points[3]).norm();
    assert!((wrist_to_flange - 0.215).abs() < 1e-12, "{wrist_to_flange}");
    for mode in &swing.modes {
        let size = mode.moved.iter().map(Vector3::norm).fold(0.0, f64::max);
        assert!(mode.moved[0].norm() == 0.0 && (mode.moved[4] - mode.tip).norm() <= 1e-12 * size, "{mode:?}");
        for (points, moved) in swing.points.windows(2).zip(mode.moved.windows(2)) {
            let stretch = (points[1] - points[0]).dot(&(moved[1] - moved[0]));
            assert!(stretch.abs() <= 1e-12 * size * (points[1] - points[0]).norm(), "{mode:?}");
        }
        // Joint 1 alone moves the joint-2 axis, about the vertical.
        assert!(mode.moved[1].z.abs() <= 1e-12 * size && mode.moved[1].dot(&swing.points[1]).abs() <= 1e-12 * size);
    }
}

/// `frequencies` is the quick way to the numbers of `modes`.
#[test]
fn the_frequencies_of_a_prepared_arm_are_those_of_its_modes() {
    let (robot, tool, q) = kr210();
    let arm = SwingingArm::new(&robot, &tool).unwrap();
    for turn in [-0.4, 0.0, 0.7] {
        let q = q.map(|angle| angle + turn);
        close(&arm.frequencies(&q).unwrap(), &frequencies(&modes(&robot, &q, &tool, None).unwrap()), 1e-7);
    }
    assert!(matches!(arm.frequencies(&[f64::NAN; 6]), Err(ModesError::Posture(_))));
}

#[test]
fn four_times_the_mass_halves_every_frequency_and_a_heavier_tool_raises_none() {
    let (mut robot, mut tool, q) = kr210();
    let before = frequencies(&modes(&robot, &q, &tool, None).unwrap());
    tool.body = tool.body.map(|body| RigidBody { mass: 1.5 * body.mass, ..body });
    let heavier = frequencies(&modes(&robot, &q, &tool, None).unwrap());
    assert!(heavier.iter().zip(&before).all(|(a, b)| *a <= b + 1e-9), "{heavier:?} {before:?}");
    let fourfold = |body: RigidBody| RigidBody { mass: 4.0 * body.mass, inertia: 4.0 * body.inertia, ..body };
    robot.masses.iter_mut().for_each(|mass| mass.body = fourfold(mass.body));
    tool.body = tool.body.map(|body| fourfold(RigidBody { mass: body.mass / 1.5, ..body }));
    let halved: Vec<f64> = before.iter().map(|f| f / 2.0).collect();
    close(&frequencies(&modes(&robot, &q, &tool, None).unwrap()), &halved, 1e-9);
}

#[test]
fn free_motors_raise_every_frequency_and_very_heavy_rotors_raise_none() {
    let (robot, tool, q) = kr210();
    let with = |rotor: f64| {
        let mut robot = robot.clone();
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { panic!("six axes") };
        drives.motors.rotor = Some([rotor; 6]);
        modes(&robot, &q, &tool, None).map(|swing| swing.modes)
    };
    assert!(with(300.0).unwrap().iter().all(|mode| mode.frequency < mode.motors_free.unwrap()));
    assert!(with(1e12).unwrap().iter().all(|mode| (mode.motors_free.unwrap() / mode.frequency - 1.0).abs() < 1e-6));
    assert!(modes(&robot, &q, &tool, None).unwrap().modes.iter().all(|mode| mode.motors_free.is_none()));
    assert!([0.0, -1.0, f64::NAN].into_iter().all(|rotor| matches!(with(rotor), Err(ModesError::Rotor(_)))));
}

#[test]
fn an_interval_holds_the_frequency_and_is_that_of_the_prior() {
    let (robot, tool, q) = kr210();
    assert!(modes(&robot, &q, &tool, None).unwrap().modes.iter().all(|mode| mode.spread.is_none()));
    let robot = with_prior(&robot).unwrap();
    let first = modes(&robot, &q, &tool, None).unwrap().modes[0];
    let spread = first.spread.unwrap();
    assert!(spread.p05 < first.frequency && first.frequency < spread.p95, "{first:?}");
    // A frequency goes by the root of a stiffness.
    let total = robot.scatter().unwrap().total();
    let widest = total.iter().copied().fold(0.0, f64::max);
    assert!((spread.p95 / spread.p05).ln() < 2.0 * 1.645 * widest / 2.0 * 1.05);
}

#[test]
fn every_robot_of_the_catalogue_with_masses_swings_and_the_others_say_what_is_missing() {
    let (_, tool, _) = kr210();
    let mut swinging = 0;
    for robot in stiffarm::catalogue::robots() {
        let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { continue };
        let q = geometry.reported(&[0.0, 0.2, 1.2, 0.3, 0.6, 0.0], limits.third_axis);
        match modes(&robot, &q, &tool, None) {
            Ok(swing) => {
                swinging += 1;
                assert_eq!(swing.modes.len(), 6, "{}", robot.name);
                assert_eq!(read(&write(&robot), "written.toml").as_ref(), Ok(&robot));
            }
            Err(ModesError::NoMasses { missing, .. }) => assert_eq!(missing, "no masses", "{}", robot.name),
            Err(error) => panic!("{error}"),
        }
    }
    assert_eq!(swinging, 25);
}

#[test]
fn what_a_tool_cannot_be_is_refused() {
    let (robot, tool, q) = kr210();
    let refused = |body: RigidBody| {
        let tool = HeldTool { body: Some(body), ..tool };
        modes(&robot, &q, &tool, None).unwrap_err().to_string()
    };
    assert!(refused(RigidBody::point(-1.0, Vector3::zeros())).contains("a mass of -1 kg; expected more than 0"));
    assert!(refused(RigidBody::point(f64::NAN, Vector3::zeros())).contains("a mass of NaN kg"));
    assert!(refused(RigidBody::point(60.0, Vector3::new(0.0, 0.0, 200.0))).contains("200 m from the flange"));
    let flat = RigidBody::new(60.0, Vector3::zeros(), [1.0, 0.0, 0.0, 1.0, 0.0, 3.0]);
    assert!(refused(flat).contains("at most the sum of the other two"));
    let damped = |damping| modes(&robot, &q, &tool, Some(damping)).unwrap_err().to_string();
    assert!(damped(Damping::Ratio(-0.1)).contains("damping ratio -0.1; expected"));
    assert!(damped(Damping::OfDrives([f64::NAN; 6])).contains("expected"));
}

/// The frequency of a tool along the flange axis does not depend on the roll but for the little that link 6 is not round.
#[test]
fn a_map_has_at_every_point_the_first_frequency_of_its_posture() {
    let (robot, tool, _) = kr210();
    let model = Model::spatial(&robot, &tool.flange_from_tool).unwrap();
    let options = MapOptions::over(Spacing::Step(0.2), Load::PAPER);
    let map = map(&model, &options).unwrap();
    let FirstFrequencies { hertz: found, slowest } = first_frequencies(&model, &map, &options, &tool).unwrap();
    assert_eq!(slowest, None);
    let mut count = 0;
    let margins = map.space.as_ref().unwrap();
    for j in 0..found.z.count {
        for i in 0..found.x.count {
            let Some((configuration, _)) = margins.at(i, j) else {
                assert_eq!(found.get(i, j), None);
                continue;
            };
            // Straight down, at a roll of its own.
            let down = nalgebra::UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
            let at = Vector3::new(found.x.at(i), 0.0, found.z.at(j));
            let flange = Pose::from_parts(at.into(), down) * tool.flange_from_tool.inverse();
            let geometry = match &robot.arm {
                Arm::SixAxis { geometry, .. } => geometry,
                Arm::Planar(_) => unreachable!("six axes"),
            };
            let all = postures(geometry, &flange);
            let Some((_, theta)) = all.found.iter().find(|(other, _)| *other == configuration) else {
                panic!("no posture {configuration} at {at}")
            };
            let q = geometry.reported(theta, stiffarm::limits::ThirdAxis::Elbow);
            let hertz = modes(&robot, &q, &tool, None).unwrap().modes[0].frequency;
            let value = found.get(i, j).unwrap();
            assert!((value / hertz - 1.0).abs() < 2e-3, "{at}: {value} {hertz}");
            count += 1;
        }
    }
    assert!(100 < count, "{count}");
    let (i, j, posture) = map.stiffest(&model, &options).unwrap();
    let ArmPosture::Joints(q) = posture else { panic!("six joints") };
    let hertz = modes(&robot, &q, &tool, None).unwrap().modes[0].frequency;
    assert!((found.get(i, j).unwrap() / hertz - 1.0).abs() < 1e-12);
}

/// By the axes of the arm itself, over all angles of its wrist: what turns a joint is the length of its column of the Jacobian.
#[test]
fn no_angle_of_the_wrist_gives_a_longer_lever_than_is_reported_and_some_angle_gives_it() {
    let robot = find("KR 210 R2700-2").unwrap().robot();
    let Arm::SixAxis { geometry, .. } = &robot.arm else { panic!("six axes") };
    let steps = |count: u32| (0..count).map(move |step| f64::from(step) / f64::from(count) * TAU);
    for point in [[0.0, 0.0, 0.2], [0.15, -0.1, 0.3], [0.3, 0.2, -0.215], [0.1, 0.0, -0.4]].map(Vector3::from) {
        let mut longest = [0.0_f64; 3];
        for fourth in [0.0, 0.7, 2.9] {
            for (fifth, sixth) in steps(144).flat_map(|fifth| steps(144).map(move |sixth| (fifth, sixth))) {
                let theta = [0.4, -0.3, 1.2, fourth, fifth, sixth];
                let at = (geometry.forward(&theta) * Pose::translation(point.x, point.y, point.z)).translation.vector;
                let jacobian = geometry.jacobian(&theta, &at);
                for (axis, longest) in longest.iter_mut().enumerate() {
                    *longest = longest.max(jacobian.fixed_view::<3, 1>(0, 3 + axis).norm());
                }
            }
        }
        for (longest, bound) in longest.into_iter().zip(geometry.wrist_levers(&point)) {
            // Half a step of 2.5 degrees misses the longest by the square of that, 5e-4.
            assert!(
                longest <= bound + 1e-12 && bound * (1.0 - 1e-3) <= longest + 1e-12,
                "{point:?}: {longest} of {bound}"
            );
        }
    }
}

/// By the heights of their centres alone, written down from the axes of a parallelogram: `tau = -m g dz/dtheta`.
#[test]
fn weight_of_rod_and_counterweight_turns_the_joints_as_their_heights_change() {
    let robot = find("KR 210 R2700-2").unwrap().robot();
    let Arm::SixAxis { geometry, .. } = &robot.arm else { panic!("six axes") };
    let shoulder = Vector3::new(geometry.a1, geometry.b, geometry.c1);
    let (crank, rod, counterweight) = ([-0.3, -0.1], Vector3::new(-0.1, 0.1, 1.2), Vector3::new(-0.3, 0.05, 0.6));
    let up = |x: f64, z: f64, angle: f64| z * angle.cos() - x * angle.sin();
    let height = |mass: &Mass, theta: &[f64; 6]| {
        let (upper, forearm) = (theta[1], theta[1] + theta[2]);
        if mass.carrier == Carrier::Counterweight {
            let lever = counterweight - shoulder;
            return up(lever.x, lever.z, forearm);
        }
        let own = rod - shoulder - Vector3::new(crank[0], 0.0, crank[1]);
        up(crank[0], crank[1], forearm) + up(own.x, own.z, upper)
    };
    let theta = [0.4, -0.3, 1.2, 0.7, -0.5, 0.3];
    for (carrier, centre) in [(Carrier::Rod { crank }, rod), (Carrier::Counterweight, counterweight)] {
        let mass = Mass { carrier, body: RigidBody::point(150.0, centre) };
        let turned = gravity_torques(geometry, &theta, &[mass]);
        for joint in 0..6 {
            let moved = |step: f64| {
                let mut theta = theta;
                theta[joint] += step;
                height(&mass, &theta)
            };
            let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            assert!((turned[joint] + 150.0 * GRAVITY * slope).abs() < 1e-5, "joint {}: {turned}", joint + 1);
        }
    }
}
