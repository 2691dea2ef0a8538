//! Does a path on a calibrated arm end where it is asked for, and are errors reported that such an arm has?

use nalgebra::{Point3, UnitQuaternion, Vector3, Vector6};
use stiffarm::calibration::{ControllerModel, Errors};
use stiffarm::catalogue::find;
use stiffarm::chain::TrueArm;
use stiffarm::mass::ToolWeight;
use stiffarm::mill::{
    Acting, ErrorPart, Followed, MillError, MillOptions, Milled, OnTrueArm, RollMode, Stand, Station, TrueOptions,
    WorkFrame, cutting_axes, mill, on_true_arm, remaining, stations,
};
use stiffarm::prior::Drawn;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;
use stiffarm::toolpath::{Builtin, Steps};
use stiffarm::watch::Watch;

use crate::made::calibrated;

const KNOWN: Acting = Acting::Known { force: [300.0, -120.0, 80.0], moment: 4.0 };

fn robot(errors: &Errors, controller: Option<ControllerModel>) -> Robot {
    calibrated(&find("KR 210 R2700 extra").unwrap().robot(), errors, controller)
}

fn errors(seed: u64, [frames, weight, gears]: [f64; 3]) -> Errors {
    let mut rng = fastrand::Rng::with_seed(seed);
    let mut errors = Errors::NONE;
    errors.frames.iter_mut().flatten().for_each(|x| *x = frames * (2.0 * rng.f64() - 1.0));
    errors.weight.iter_mut().for_each(|x| *x = weight * (2.0 * rng.f64() - 1.0));
    errors.gears.iter_mut().flatten().for_each(|x| *x = gears * (2.0 * rng.f64() - 1.0));
    errors
}

/// A spindle across axis 6.
fn stand() -> Stand {
    Stand {
        base_from_part: Pose::new(Vector3::new(1.6, 0.2, 0.6), Vector3::z() * 0.4),
        flange_from_tool: Pose::new(Vector3::new(0.2, 0.0, 0.15), Vector3::y() * 1.2),
    }
}

fn followed(robot: &Robot, acting: Option<Acting>) -> (Vec<Station>, Followed) {
    let moves = "circle:0.3".parse::<Builtin>().unwrap().moves(Some(0.02));
    let stations = stations(&moves, &Steps::USUAL, |_| acting);
    let options = MillOptions { roll: RollMode::Constant, ..MillOptions::usual() };
    match mill(robot, &stand(), &stations, &options, Watch::nobody()).unwrap() {
        Milled::Followed(found) => (stations, found),
        Milled::Blocked(blocked) => panic!("{blocked}"),
    }
}

fn asked(
    robot: &Robot,
    acting: Option<Acting>,
    (work_frame, is_compensated): (WorkFrame, bool),
) -> Result<(Vec<Station>, Followed, OnTrueArm), MillError> {
    let (stations, found) = followed(robot, acting);
    let options = TrueOptions { work_frame, part: ErrorPart::Total, is_compensated, held: None };
    let on = on_true_arm(robot, &stand(), (&stations, &found.samples), &options, Watch::nobody())?;
    Ok((stations, found, on.unwrap()))
}

/// The springs of an arm without weight and gears hold the wrench at the joints that are sought here by the robot's own numbers.
#[test]
fn the_loaded_tip_of_the_true_arm_is_on_the_path() {
    let robot = robot(&errors(1, [0.6e-3, 0.0, 0.0]), None);
    let Arm::SixAxis { geometry, limits, drives } = &robot.arm else { panic!("six axes") };
    let arm = TrueArm::of(&robot).unwrap();
    for work_frame in WorkFrame::ALL {
        let (stations, _, on) = asked(&robot, Some(KNOWN), (work_frame, true)).unwrap();
        for (i, station) in stations.iter().enumerate() {
            let axes = on.base_from_part.rotation.to_rotation_matrix() * cutting_axes(&station.sample);
            let (force, moment) = (axes * Vector3::new(300.0, -120.0, 80.0), axes.column(2) * 4.0);
            let wrench = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
            let commanded = geometry.model_angles(&on.joints[i], limits.third_axis);
            let mut q = on.joints[i];
            for _ in 0..30 {
                let tip = (arm.flange(&q) * stand().flange_from_tool).translation.vector;
                let a = drives.transmission.0;
                let torques = a.transpose() * arm.jacobian(&q, &tip).transpose() * wrench;
                let turned = a * torques.component_mul(&Vector6::from(drives.compliance.0));
                q = geometry.reported(&std::array::from_fn(|i| commanded[i] + turned[i]), limits.third_axis);
            }
            let tip = (arm.flange(&q) * stand().flange_from_tool).translation.vector;
            let target = on.base_from_part * Point3::from(station.sample.pose.tip);
            assert!((tip - target.coords).norm() < 1e-9, "{work_frame:?} {i}");
            // The controller has the drawn arm at these joints, in the frame in which it has the work.
            let drawn = stand().base_from_part.inverse() * geometry.forward(&commanded) * stand().flange_from_tool;
            assert!((drawn.translation.vector - on.poses[i][0].tip).norm() < 1e-12);
        }
        assert!(on.errors.by_both.unwrap() < 1e-9, "{:?}", on.errors);
    }
}

/// A tool that was not there when the arm was calibrated bends its drives by `A k A^T tau`, with `tau` by how the height of its centre changes: the tip
/// stands on the path at the joints that are commanded for it, and a quarter of a millimetre or more beside it at those for an arm without it.
#[test]
fn the_weight_of_the_tool_is_taken_out_of_a_calibrated_arm() {
    let robot = robot(&errors(1, [0.6e-3, 0.0, 0.0]), None);
    let Arm::SixAxis { geometry, limits, drives } = &robot.arm else { panic!("six axes") };
    let arm = TrueArm::of(&robot).unwrap();
    let (stations, found) = followed(&robot, None);
    let tool = ToolWeight { mass: 35.0, centre: Some(Vector3::new(0.1, 0.02, 0.15)) };
    let on = |held: Option<ToolWeight>| {
        let options =
            TrueOptions { work_frame: WorkFrame::Measured, part: ErrorPart::Total, is_compensated: false, held };
        on_true_arm(&robot, &stand(), (&stations, &found.samples), &options, Watch::nobody()).unwrap().unwrap()
    };
    let height = |theta: &[f64; 6]| (geometry.forward(theta) * Point3::from(tool.centre.unwrap())).z;
    let off = |on: &OnTrueArm, i: usize| {
        let theta = geometry.model_angles(&on.joints[i], limits.third_axis);
        let torques = Vector6::from_fn(|joint, _| {
            let at = |step: f64| height(&std::array::from_fn(|j| theta[j] + if j == joint { step } else { 0.0 }));
            -35.0 * 9.806_65 * (at(1e-5) - at(-1e-5)) / 2e-5
        });
        let a = drives.transmission.0;
        let turned = a * (a.transpose() * torques).component_mul(&Vector6::from(drives.compliance.0));
        let q = geometry.reported(&std::array::from_fn(|j| theta[j] + turned[j]), limits.third_axis);
        let tip = (arm.flange(&q) * stand().flange_from_tool).translation.vector;
        (tip - (on.base_from_part * Point3::from(stations[i].sample.pose.tip)).coords).norm()
    };
    let (with, without) = (on(Some(tool)), on(None));
    for i in 0..stations.len() {
        assert!(off(&with, i) < 1e-8 && 2.5e-4 < off(&without, i), "{i}: {} {}", off(&with, i), off(&without, i));
    }
    assert!(with.errors.by_geometry < 1e-9 && without.errors.by_geometry < 1e-9);
    // Where nobody knows its centre nothing is taken out.
    assert_eq!(on(Some(ToolWeight { centre: None, ..tool })), without);
}

/// Drives that are a fifth softer than they were taken leave a fifth of what was taken out: of what the force pushes and of what the tool weighs.
#[test]
fn what_is_wrong_of_the_weight_of_the_tool_is_left_with_the_rest() {
    let robot = robot(&errors(1, [0.1e-3, 0.0, 0.0]), None);
    let Arm::SixAxis { geometry, limits, drives } = &robot.arm else { panic!("six axes") };
    let arm = TrueArm::of(&robot).unwrap();
    let tool = ToolWeight { mass: 35.0, centre: Some(Vector3::new(0.1, 0.02, 0.15)) };
    let (stations, found) = followed(&robot, Some(KNOWN));
    let drawn = Drawn { factors: vec![[1.2; 6]], unexplained: None };
    let path = (&stations[..], &found.samples[..]);
    let left = |held: Option<&ToolWeight>| {
        remaining(&robot, &stand(), path, (ErrorPart::Total, &drawn, held), Watch::nobody()).unwrap()
    };
    let (with, without) = (left(Some(&tool)), left(None));
    let height = |theta: &[f64; 6]| (geometry.forward(theta) * Point3::from(tool.centre.unwrap())).z;
    for (i, station) in stations.iter().enumerate() {
        let axes = stand().base_from_part.rotation.to_rotation_matrix() * cutting_axes(&station.sample);
        let (force, moment) = (axes * Vector3::new(300.0, -120.0, 80.0), axes.column(2) * 4.0);
        let wrench = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        let q = found.samples[i].joints;
        let theta = geometry.model_angles(&q, limits.third_axis);
        let weight = Vector6::from_fn(|joint, _| {
            let at = |step: f64| height(&std::array::from_fn(|j| theta[j] + if j == joint { step } else { 0.0 }));
            -35.0 * 9.806_65 * (at(1e-5) - at(-1e-5)) / 2e-5
        });
        let jacobian = arm.jacobian(&q, &(arm.flange(&q) * stand().flange_from_tool).translation.vector);
        let a = drives.transmission.0;
        let moved = |torques: Vector6<f64>| {
            let turned = a * (a.transpose() * torques).component_mul(&Vector6::from(drives.compliance.0));
            (jacobian * turned).fixed_rows::<3>(0).norm()
        };
        let pushed = jacobian.transpose() * wrench;
        for (left, expected) in [(&with, 0.2 * moved(pushed + weight)), (&without, 0.2 * moved(pushed))] {
            // By the drawing, whose compliance differs by some parts in a thousand.
            assert!((left.along[i] / expected - 1.0).abs() < 0.01, "{i}: {} {expected}", left.along[i]);
        }
    }
    assert!(
        1.2 * without.median < with.median || with.median < 0.8 * without.median,
        "{} {}",
        with.median,
        without.median
    );
}

#[test]
fn what_is_corrected_alone_leaves_the_other_part() {
    let robot = robot(&errors(2, [0.6e-3, 0.5e-3, 0.1e-3]), None);
    let (mut stations, found, on) = asked(&robot, Some(KNOWN), (WorkFrame::Measured, false)).unwrap();
    let (stiffness, both) = (on.errors.by_stiffness.unwrap(), on.errors.by_both.unwrap());
    assert!(both < 1e-9, "{both}");
    // The deflection at the loaded posture, rather than at the path's: some parts in a thousand.
    assert!((on.errors.by_geometry / found.worst.0 - 1.0).abs() < 0.01, "{:?} {:?}", on.errors, found.worst);
    // The same rolls in air: without a force others would be as good.
    for station in &mut stations {
        station.acting = None;
    }
    let options =
        TrueOptions { work_frame: WorkFrame::Measured, part: ErrorPart::Total, is_compensated: false, held: None };
    let path = (&stations[..], &found.samples[..]);
    let unloaded = on_true_arm(&robot, &stand(), path, &options, Watch::nobody()).unwrap().unwrap();
    assert!((stiffness / unloaded.errors.uncorrected - 1.0).abs() < 0.01, "{:?} {:?}", on.errors, unloaded.errors);
    assert!(on.errors.uncorrected <= on.errors.by_geometry + stiffness + 1e-9);
    // Without load the joints that correct the geometry are those of the true chain.
    assert!(unloaded.errors.by_geometry < 1e-11 && unloaded.base_from_part == stand().base_from_part);
}

/// An arm that stands elsewhere as a whole.
#[test]
fn what_an_arm_errs_alike_everywhere_cancels_where_the_work_is_touched() {
    let mut shifted = Errors::NONE;
    shifted.frames[0] = [1e-3, 2e-3, -1e-3, 1e-3, -2e-3, 3e-3];
    let robot = robot(&shifted, None);
    let moved =
        Pose::from_parts(Vector3::new(1e-3, 2e-3, -1e-3).into(), UnitQuaternion::new(Vector3::new(1e-3, -2e-3, 3e-3)));
    let (stations, _, touched) = asked(&robot, None, (WorkFrame::Touched, false)).unwrap();
    assert!(touched.errors.uncorrected < 1e-9 && touched.touched.len() == 3, "{touched:?}");
    let (_, _, measured) = asked(&robot, None, (WorkFrame::Measured, false)).unwrap();
    let off = stations.iter().map(|station| {
        let at = stand().base_from_part * Point3::from(station.sample.pose.tip);
        let truly = touched.base_from_part * Point3::from(station.sample.pose.tip);
        assert!((truly - moved * at).norm() < 1e-9);
        (moved * at - at).norm()
    });
    let largest = off.fold(0.0, f64::max);
    assert!((measured.errors.uncorrected - largest).abs() < 1e-9, "{measured:?} {largest}");
    assert!(measured.touched.is_empty());
}

#[test]
fn a_force_that_may_point_anywhere_is_not_compensated_and_a_controller_that_corrects_is_not_corrected_again() {
    let known = errors(3, [0.6e-3, 0.5e-3, 0.1e-3]);
    let drawn = robot(&known, Some(ControllerModel::Nominal));
    let any = Some(Acting::Any(300.0));
    assert_eq!(asked(&drawn, any, (WorkFrame::Touched, true)).unwrap_err(), MillError::AnyDirection);
    let (_, found, on) = asked(&drawn, any, (WorkFrame::Touched, false)).unwrap();
    assert!(on.errors.by_both.is_none() && on.errors.by_stiffness.is_none());
    assert!((on.errors.by_geometry - found.worst.0).abs() < 1e-9, "{:?} {:?}", on.errors, found.worst);
    let own = robot(&known, Some(ControllerModel::Calibrated));
    let (stations, _, on) = asked(&own, None, (WorkFrame::Touched, false)).unwrap();
    assert!(on.errors.uncorrected < 1e-11 && on.touched.is_empty() && on.base_from_part == stand().base_from_part);
    // It is sent where the path is.
    for (poses, station) in on.poses.iter().zip(&stations) {
        assert!((poses[1].tip - station.sample.pose.tip).norm() < 1e-11);
    }
}

#[test]
fn an_arm_that_was_not_calibrated_is_left_as_it_is() {
    let robot = find("KR 210 R2700 extra").unwrap().robot();
    let (stations, found) = followed(&robot, Some(KNOWN));
    let options =
        TrueOptions { work_frame: WorkFrame::Touched, part: ErrorPart::Total, is_compensated: true, held: None };
    let on = on_true_arm(&robot, &stand(), (&stations, &found.samples), &options, Watch::nobody()).unwrap();
    assert_eq!(on, None);
}
