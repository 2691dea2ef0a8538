//! Do other programs, which share no code with this one, compute the same numbers for six axes?
//!
//! `validation/spatial_cases.csv` holds compliances that Pinocchio and the Robotics Toolbox for Python both computed
//! (`scripts/reference` records them anew); rs-opw-kinematics computes flange poses while the test runs.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use nalgebra::{Matrix3, Matrix6, Quaternion, Rotation3, Translation3, UnitQuaternion, Vector3};
use rs_opw_kinematics::glam::{DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{J2, J3, Kinematics, Pose as OpwPose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parallelogram::Parallelogram;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use stiffarm::catalogue::{names, paper_robots};
use stiffarm::compliance::{Posture, beyond_limits, compliance};
use stiffarm::drive::{Architecture, Drives, JointCompliance};
use stiffarm::geometry::Geometry;
use stiffarm::inverse::postures;
use stiffarm::limits::ThirdAxis;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::{Pose, Wrench};

/// Each program multiplies some ten rotations and adds some ten lengths: 1e-15 of the size of the result. A fault in a
/// formula shows at 1e-3, so a hundred times the rounding hides none.
const ROUNDING: f64 = 1e-13;

/// One line of the recorded file.
struct Case {
    name: String,
    robot: Robot,
    joints: [f64; 6],
    flange_from_tool: Pose,
    force: Vector3<f64>,
    wrist: Vector3<f64>,
    tcp: Vector3<f64>,
    rotation: Matrix3<f64>,
    compliance: Matrix6<f64>,
    deflection_mm: Vector3<f64>,
    rotation_mrad: Vector3<f64>,
}

impl Case {
    fn all() -> Vec<Self> {
        let text = include_str!("../../../validation/spatial_cases.csv");
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
        let columns = reader.headers().unwrap().clone();
        reader.records().map(|record| Self::read(&columns, &record.unwrap())).collect()
    }

    fn read(columns: &csv::StringRecord, record: &csv::StringRecord) -> Self {
        let cell = |name: &str| &record[columns.iter().position(|column| column == name).unwrap()];
        let numbers = |name: &str| cell(name).split(' ').map(|x| x.parse().unwrap()).collect::<Vec<f64>>();
        let six = |name: &str| <[f64; 6]>::try_from(numbers(name)).unwrap();
        let vector = |name: &str| Vector3::from(<[f64; 3]>::try_from(numbers(name)).unwrap());
        let [x, y, z, rx, ry, rz] = six("tool_mm_deg");
        let turned = Rotation3::from_euler_angles(rx.to_radians(), ry.to_radians(), rz.to_radians());
        Self {
            name: format!("{} at {}, {}", cell("robot"), cell("joints_deg"), cell("architecture")),
            robot: robot(cell("robot"), cell("architecture"), cell("b_mm"), six("drive_urad_per_nm")),
            joints: six("joints_deg").map(f64::to_radians),
            flange_from_tool: Pose::from_parts(Translation3::new(1e-3 * x, 1e-3 * y, 1e-3 * z), turned.into()),
            force: vector("force_n"),
            wrist: vector("wrist_m"),
            tcp: vector("tcp_m"),
            rotation: Matrix3::from_row_slice(&numbers("tool_rotation")),
            compliance: symmetric(&numbers("compliance_si")),
            deflection_mm: vector("deflection_mm"),
            rotation_mrad: vector("rotation_mrad"),
        }
    }

    fn answer(&self) -> Posture {
        compliance(&self.robot, &self.joints, &self.flange_from_tool).unwrap()
    }

    #[track_caller]
    fn assert_close<const R: usize, const C: usize>(
        &self,
        what: &str,
        found: nalgebra::SMatrix<f64, R, C>,
        recorded: nalgebra::SMatrix<f64, R, C>,
    ) {
        let apart = (found - recorded).norm() / recorded.norm();
        assert!(
            apart <= ROUNDING,
            "{}: {what} differs by {apart:.1e}; ours {found} the other programs' {recorded}",
            self.name
        );
    }
}

/// A robot of the catalogue with the drives, the architecture and the sideways offset of a case.
fn robot(name: &str, architecture: &str, b_mm: &str, drive_urad_per_nm: [f64; 6]) -> Robot {
    let mut robot = paper_robots().into_iter().find(|robot| names(robot, name)).unwrap();
    robot.architecture = Architecture::ALL.into_iter().find(|each| each.name() == architecture).unwrap();
    let Arm::SixAxis { geometry, drives, .. } = &mut robot.arm else { panic!("{name} has six axes") };
    geometry.b = 1e-3 * b_mm.parse::<f64>().unwrap();
    *drives = Drives::new(robot.architecture, JointCompliance(drive_urad_per_nm.map(|k| 1e-6 * k)));
    robot
}

/// A matrix from its upper triangle, row by row.
fn symmetric(upper: &[f64]) -> Matrix6<f64> {
    let mut matrix = Matrix6::zeros();
    let places = (0..6).flat_map(|i| (i..6).map(move |j| (i, j)));
    for ((i, j), value) in places.zip(upper.iter().copied()) {
        matrix[(i, j)] = value;
        matrix[(j, i)] = value;
    }
    assert_eq!(upper.len(), 21);
    matrix
}

fn six_axis(robot: &Robot) -> (&Geometry, ThirdAxis) {
    match &robot.arm {
        Arm::SixAxis { geometry, limits, .. } => (geometry, limits.third_axis),
        Arm::Planar(_) => panic!("{} has six axes", robot.name),
    }
}

#[test]
fn the_recorded_cases_hold_every_robot_with_both_architectures() {
    let cases = Case::all();
    for robot in paper_robots() {
        for architecture in Architecture::ALL {
            let held = |case: &&Case| case.robot.name == robot.name && case.robot.architecture == architecture;
            assert!(2 <= cases.iter().filter(held).count(), "{}, {architecture}", robot.name);
        }
    }
    assert!(cases.iter().any(|case| six_axis(&case.robot).0.b != 0.0), "an arm beside the axis of joint 1");
}

#[test]
fn wrist_and_tool_stand_where_pinocchio_and_the_robotics_toolbox_put_them() {
    for case in Case::all() {
        let (geometry, third_axis) = six_axis(&case.robot);
        let tool = case.answer().tool;
        case.assert_close("wrist centre", geometry.wrist_centre(case.joints, third_axis).into(), case.wrist);
        case.assert_close("tool point", tool.translation.vector, case.tcp);
        case.assert_close("tool rotation", tool.rotation.to_rotation_matrix().into_inner(), case.rotation);
    }
}

#[test]
fn the_compliance_is_what_pinocchio_and_the_robotics_toolbox_compute() {
    for case in Case::all() {
        let found = case.answer().compliance.0;
        // Block by block: m/N, rad/N and rad/(N m) have no common size.
        for (what, row, column) in [("translation", 0, 0), ("coupling", 0, 3), ("coupling", 3, 0), ("rotation", 3, 3)] {
            let block = |matrix: &Matrix6<f64>| matrix.fixed_view::<3, 3>(row, column).into_owned();
            case.assert_close(&format!("compliance, {what}"), block(&found), block(&case.compliance));
        }
    }
}

#[test]
fn a_force_pushes_and_turns_the_tool_as_far_as_the_recorded_compliance_says() {
    for case in Case::all() {
        let (moved, turned) = case.answer().compliance.deflection(&Wrench::force(case.force));
        // Parts of a sum may cancel: the size is that of the compliance times the force.
        let size = |row: usize| case.compliance.fixed_view::<3, 3>(row, 0).norm() * case.force.norm();
        let (off_mm, off_mrad) = (1e3 * moved - case.deflection_mm, 1e3 * turned - case.rotation_mrad);
        assert!(off_mm.norm() <= ROUNDING * 1e3 * size(0), "{}: {moved} {}", case.name, case.deflection_mm);
        assert!(off_mrad.norm() <= ROUNDING * 1e3 * size(3), "{}: {turned} {}", case.name, case.rotation_mrad);
    }
}

#[test]
fn the_recorded_postures_lie_within_the_limits_as_the_recorder_reads_them() {
    for case in Case::all() {
        assert_eq!(beyond_limits(&case.robot, &case.joints), [0; 0], "{}", case.name);
    }
}

/// The arm in rs-opw-kinematics, which counts joints by the same formula `theta_i = sign_i q_i - offset_i`.
fn opw(geometry: &Geometry) -> OPWKinematics {
    let Geometry { a1, a2, b, c1, c2, c3, c4, offset, sign } = geometry.clone();
    let sign_corrections = sign.map(|sign| if sign < 0.0 { -1 } else { 1 });
    OPWKinematics::new(Parameters { a1, a2, b, c1, c2, c3, c4, offsets: offset, sign_corrections, dof: 6 })
}

/// The robot in rs-opw-kinematics, which takes the forearm's absolute angle as a parallelogram between J2 and J3.
///
/// `theta2 + theta3 = s3 q3 - o3` is `theta3 = s3 (q3 - s3 s2 q2) - (o3 - o2)`.
fn opw_as_reported(robot: &Robot) -> Arc<dyn Kinematics> {
    let (geometry, third_axis) = six_axis(robot);
    match third_axis {
        ThirdAxis::Elbow => Arc::new(opw(geometry)),
        ThirdAxis::Forearm => {
            let mut elbow = geometry.clone();
            elbow.offset[J3] -= elbow.offset[J2];
            let scaling = geometry.sign[J2] * geometry.sign[J3];
            Arc::new(Parallelogram { robot: Arc::new(opw(&elbow)), scaling, driven: J2, coupled: J3 })
        }
    }
}

/// All postures that rs-opw-kinematics finds for a flange pose, as model angles `theta`.
fn opw_inverse_model_angles(geometry: &Geometry, flange: &Pose) -> Vec<[f64; 6]> {
    let model = Geometry { offset: [0.0; 6], sign: [1.0; 6], ..geometry.clone() };
    let translation = DVec3::from_array(flange.translation.vector.into());
    opw(&model).inverse(&OpwPose::from_parts(translation, DQuat::from_array(flange.rotation.coords.into())))
}

fn pose(theirs: &OpwPose) -> Pose {
    let rotation = UnitQuaternion::from_quaternion(Quaternion::from(theirs.rotation.to_array()));
    Pose::from_parts(Vector3::from(theirs.translation.to_array()).into(), rotation)
}

/// The larger of the distance over the arm's length and the difference of the rotations.
fn apart(geometry: &Geometry, one: &Pose, other: &Pose) -> f64 {
    let Geometry { a1, a2, b, c1, c2, c3, c4, .. } = geometry;
    let length: f64 = [a1, a2, b, c1, c2, c3, c4].map(|x| x.abs()).iter().sum();
    let moved = (one.translation.vector - other.translation.vector).norm() / length;
    let turned = one.rotation.to_rotation_matrix().matrix() - other.rotation.to_rotation_matrix().matrix();
    moved.max(turned.norm())
}

fn random_angles(rng: &mut fastrand::Rng) -> [f64; 6] {
    std::array::from_fn(|_| TAU * (rng.f64() - 0.5))
}

fn random_geometry(rng: &mut fastrand::Rng) -> Geometry {
    let mut length = |low: f64, high: f64| low + (high - low) * rng.f64();
    Geometry {
        a1: length(0.0, 0.8),
        a2: length(-0.3, 0.3),
        b: length(-0.3, 0.3),
        c1: length(0.3, 1.0),
        c2: length(0.6, 1.5),
        c3: length(0.6, 1.8),
        c4: length(0.1, 0.3),
        offset: std::array::from_fn(|_| length(-PI, PI)),
        sign: std::array::from_fn(|_| if length(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 }),
    }
}

/// The largest difference of two sets of angles, whole turns aside.
fn turned_apart(one: &[f64; 6], other: &[f64; 6]) -> f64 {
    let differences = one.iter().zip(other).map(|(a, b)| ((a - b) / TAU - ((a - b) / TAU).round()).abs() * TAU);
    differences.fold(0.0, f64::max)
}

#[test]
fn the_postures_of_a_pose_are_those_that_rs_opw_kinematics_finds() {
    let mut rng = fastrand::Rng::with_seed(23);
    let mut counted = 0;
    for case in 0..500 {
        let geometry = random_geometry(&mut rng);
        let model = Geometry { offset: [0.0; 6], sign: [1.0; 6], ..geometry };
        let flange = model.forward(&random_angles(&mut rng));
        let ours = postures(&model, &flange).found;
        let theirs = opw_inverse_model_angles(&model, &flange);
        assert_eq!(ours.len(), theirs.len(), "case {case}: {ours:?} {theirs:?}");
        counted += ours.len();
        for angles in &theirs {
            let nearest = ours.iter().map(|(_, angles_of_ours)| turned_apart(angles, angles_of_ours));
            // Near a stretched arm or a straight wrist angles are as ill conditioned as a square root.
            assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-6, "case {case}: {angles:?} not among {ours:?}");
        }
    }
    assert!(2000 < counted, "{counted} postures compared");
}

#[test]
fn the_flange_of_every_robot_stands_where_rs_opw_kinematics_puts_it() {
    let mut rng = fastrand::Rng::with_seed(21);
    for robot in paper_robots() {
        let (theirs, (geometry, third_axis)) = (opw_as_reported(&robot), six_axis(&robot));
        for _ in 0..100 {
            let q = random_angles(&mut rng);
            let ours = geometry.forward(&geometry.model_angles(&q, third_axis));
            let off = apart(geometry, &ours, &pose(&theirs.forward(&q)));
            assert!(off <= ROUNDING, "{} at {q:?}: {off:.1e}", robot.name);
        }
    }
}

#[test]
fn the_flange_of_random_arms_stands_where_rs_opw_kinematics_puts_it() {
    let mut rng = fastrand::Rng::with_seed(22);
    for _ in 0..50 {
        let geometry = random_geometry(&mut rng);
        let theirs = opw(&geometry);
        for _ in 0..100 {
            let q = random_angles(&mut rng);
            let ours = geometry.forward(&geometry.model_angles(&q, ThirdAxis::Elbow));
            let off = apart(&geometry, &ours, &pose(&theirs.forward(&q)));
            assert!(off <= ROUNDING, "{geometry:?} at {q:?}: {off:.1e}");
        }
    }
}

#[test]
fn every_posture_that_rs_opw_kinematics_finds_leads_back_to_the_flange() {
    let mut rng = fastrand::Rng::with_seed(23);
    for _ in 0..50 {
        let geometry = random_geometry(&mut rng);
        for _ in 0..20 {
            let theta = random_angles(&mut rng);
            let flange = geometry.forward(&theta);
            let found = opw_inverse_model_angles(&geometry, &flange);
            assert!(!found.is_empty(), "{geometry:?} at {theta:?}");
            for back in found {
                // An inverse loses digits where the arm is nearly stretched; they accept 1e-6.
                let off = apart(&geometry, &geometry.forward(&back), &flange);
                assert!(off <= 1e-6, "{geometry:?} at {theta:?}, back {back:?}: {off:.1e}");
            }
        }
    }
}
