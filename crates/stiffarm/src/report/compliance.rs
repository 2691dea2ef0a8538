//! How is the compliance of postures told?

use nalgebra::Vector3;
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::compliance::{Posture, PostureError, compliance};
use crate::robot::{Arm, Robot};
use crate::space::SpatialArm;
use crate::spatial::{Pose, Wrench};

/// Postures that are turned into radians at a time: they stay in the nearest cache.
const BLOCK: usize = 256;

/// One of many postures that cannot be judged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("posture {row}: {error}")]
pub struct RowError {
    /// Which, from 0.
    pub row: usize,
    /// Why.
    pub error: PostureError,
}

/// One posture, given by the joint angles that the robot reports, deg; with a force, N, the deflection under it.
pub fn posture(robot: &Robot, joints_deg: &[f64; 6], posture: &Posture, force: Option<&Vector3<f64>>) -> Value {
    let rows = |size: usize, at: &dyn Fn(usize, usize) -> f64| -> Value {
        (0..size).map(|i| (0..size).map(|j| at(i, j)).collect::<Value>()).collect()
    };
    let (translation, whole) = (posture.compliance.translation(), posture.compliance.0);
    let (_, worst) = posture.compliance.worst();
    let mut answer = json!({
        "robot": robot.name,
        "model": "spatial",
        "joints_deg": joints_deg,
        "tcp_m": posture.tool.translation.vector.as_slice(),
        "compliance_um_per_n": rows(3, &|i, j| translation[(i, j)] * 1e6),
        "compliance_6x6_si": rows(6, &|i, j| whole[(i, j)]),
        "principal_um_per_n": posture.compliance.principal().map(|(value, _)| value * 1e6),
        "worst_direction": worst.as_slice(),
        "worst_shares": posture.shares(&worst),
    });
    if let Some(force) = force {
        let (moved, turned) = posture.compliance.deflection(&Wrench::force(*force));
        answer["force_n"] = json!(force.as_slice());
        answer["deflection_mm"] = json!((moved * 1e3).as_slice());
        answer["rotation_mrad"] = json!((turned * 1e3).as_slice());
    }
    answer
}

/// The largest translation per force in any direction, um/N, at many postures, given by the joint angles that the robot
/// reports, deg. On all cores; as exact as [`SpatialArm::worst`].
///
/// # Errors
/// The first posture that cannot be judged. Joint limits are not checked here.
///
/// # Panics
/// Where there are not as many answers as postures.
pub fn worst_um_per_n(
    robot: &Robot,
    flange_from_tool: &Pose,
    joints_deg: &[[f64; 6]],
    found: &mut [f64],
) -> Result<(), RowError> {
    let arm = SpatialArm::new(robot, flange_from_tool).map_err(|error| RowError { row: 0, error })?;
    assert_eq!(joints_deg.len(), found.len(), "one answer per posture");
    let block = |(joints_deg, found): (&[[f64; 6]], &mut [f64])| {
        let mut columns = [[0.0; BLOCK]; 6];
        let joints = radians(joints_deg, &mut columns);
        arm.worst(joints, found)?;
        for value in found {
            *value *= 1e6;
        }
        Ok(())
    };
    let done = joints_deg.par_chunks(BLOCK).zip(found.par_chunks_mut(BLOCK)).try_for_each(block);
    named(robot, flange_from_tool, joints_deg, &done)
}

/// The block from force to translation, um/N, base axes, at many postures; else as [`worst_um_per_n`].
///
/// # Errors
/// As [`worst_um_per_n`].
///
/// # Panics
/// As [`worst_um_per_n`].
pub fn matrices_um_per_n(
    robot: &Robot,
    flange_from_tool: &Pose,
    joints_deg: &[[f64; 6]],
    found: &mut [[f64; 9]],
) -> Result<(), RowError> {
    let arm = SpatialArm::new(robot, flange_from_tool).map_err(|error| RowError { row: 0, error })?;
    assert_eq!(joints_deg.len(), found.len(), "one answer per posture");
    let block = |(joints_deg, found): (&[[f64; 6]], &mut [[f64; 9]])| {
        let (mut columns, mut entries) = ([[0.0; BLOCK]; 6], [[0.0; BLOCK]; 6]);
        let joints = radians(joints_deg, &mut columns);
        arm.translations(joints, entries.each_mut().map(|entry| &mut entry[..joints_deg.len()]))?;
        for (n, matrix) in found.iter_mut().enumerate() {
            let [xx, yy, zz, xy, yz, xz] = entries.each_ref().map(|entry| entry[n] * 1e6);
            *matrix = [xx, xy, xz, xy, yy, yz, xz, yz, zz];
        }
        Ok(())
    };
    let done = joints_deg.par_chunks(BLOCK).zip(found.par_chunks_mut(BLOCK)).try_for_each(block);
    named(robot, flange_from_tool, joints_deg, &done)
}

/// One slice per joint, in radians.
fn radians<'a>(joints_deg: &[[f64; 6]], columns: &'a mut [[f64; BLOCK]; 6]) -> [&'a [f64]; 6] {
    for (joint, column) in columns.iter_mut().enumerate() {
        for (angle, q) in column.iter_mut().zip(joints_deg) {
            *angle = q[joint].to_radians();
        }
    }
    columns.each_ref().map(|column| &column[..joints_deg.len()])
}

/// Names the first posture that cannot be judged; whatever thread came upon one.
fn named(
    robot: &Robot,
    flange_from_tool: &Pose,
    joints_deg: &[[f64; 6]],
    done: &Result<(), PostureError>,
) -> Result<(), RowError> {
    // Wide registers do not notice where a compensator is held by nothing.
    let may_slip = matches!(&robot.arm, Arm::SixAxis { drives, .. } if drives.compensator.is_some());
    if done.is_ok() && !may_slip {
        return Ok(());
    }
    let judge = |(row, q): (usize, &[f64; 6])| {
        let judged = compliance(robot, &q.map(f64::to_radians), flange_from_tool);
        judged.err().map(|error| RowError { row, error })
    };
    joints_deg.par_iter().enumerate().find_map_first(judge).map_or(Ok(()), Err)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::drive::GravityCompensator;

    fn postures() -> Vec<[f64; 6]> {
        let mut rng = fastrand::Rng::with_seed(8);
        (0..3 * BLOCK + 7).map(|_| std::array::from_fn(|_| 340.0 * (rng.f64() - 0.5))).collect()
    }

    #[test]
    fn many_postures_in_degrees_are_what_single_ones_are() {
        let tool = Pose::translation(0.1, -0.05, 0.2);
        for robot in paper_robots() {
            let joints = postures();
            let mut worst = vec![0.0; joints.len()];
            let mut matrices = vec![[0.0; 9]; joints.len()];
            worst_um_per_n(&robot, &tool, &joints, &mut worst).unwrap();
            matrices_um_per_n(&robot, &tool, &joints, &mut matrices).unwrap();
            for ((q, worst), matrix) in joints.iter().zip(worst).zip(matrices) {
                let c = compliance(&robot, &q.map(f64::to_radians), &tool).unwrap().compliance;
                let largest = c.worst().0 * 1e6;
                assert!((worst - largest).abs() <= 3e-8 * largest, "{}: {worst} {largest}", robot.name);
                for (n, entry) in matrix.iter().enumerate() {
                    // Some forty roundings of numbers up to the largest entry.
                    let expected = c.translation()[(n / 3, n % 3)] * 1e6;
                    assert!((entry - expected).abs() <= 2e-14 * largest, "{}: {n}", robot.name);
                }
            }
        }
    }

    #[test]
    fn the_first_posture_that_cannot_be_judged_is_named_whichever_thread_finds_one() {
        let mut robot = paper_robots().swap_remove(4);
        let mut joints = postures();
        joints[2 * BLOCK + 3][4] = f64::NAN;
        joints[BLOCK + 3][1] = 1081.0;
        let error = worst_um_per_n(&robot, &Pose::identity(), &joints, &mut vec![0.0; joints.len()]).unwrap_err();
        assert_eq!(error.row, BLOCK + 3);
        assert!(error.to_string().starts_with(&format!("posture {}: joint 2: 1081", BLOCK + 3)), "{error}");

        // A spring that is pressed together pushes the upper arm over.
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!("six axes") };
        let (base, arm) = ([-0.5, -0.1], [0.05, 0.4]);
        drives.compensator = Some(GravityCompensator { base, arm, stiffness: 2e7, free_length: 2.0 });
        let joints = postures();
        let judged = |q: &[f64; 6]| compliance(&robot, &q.map(f64::to_radians), &Pose::identity());
        let row = joints.iter().position(|q| judged(q).is_err()).expect("some lean that nothing holds");
        let error = worst_um_per_n(&robot, &Pose::identity(), &joints, &mut vec![0.0; joints.len()]).unwrap_err();
        assert_eq!((error.row, error.error), (row, PostureError::Unstable(robot.name.clone())));
        let held: Vec<[f64; 6]> = joints.into_iter().filter(|q| judged(q).is_ok()).collect();
        assert_eq!(worst_um_per_n(&robot, &Pose::identity(), &held, &mut vec![0.0; held.len()]), Ok(()));
    }
}
