//! How compliant are many postures, given as rows of six joint angles in the units of whoever asks?

use rayon::prelude::*;

use super::SpatialArm;
use crate::compliance::{PostureError, compliance};
use crate::robot::Robot;
use crate::spatial::Pose;

/// Postures of which the angles are turned into radians at a time: they stay in the nearest cache.
const BLOCK: usize = 256;

/// The units of rows, each in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// Of joint angles, rad.
    pub angle: f64,
    /// Of compliances, m/N.
    pub compliance: f64,
}

/// One of many postures that cannot be evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("posture {row}: {error}")]
pub struct RowError {
    /// Which, from 0.
    pub row: usize,
    /// Why.
    pub error: PostureError,
}

/// The largest translation per force in any direction at many postures, given by the joint angles that the robot reports. On
/// all cores; as exact as [`SpatialArm::worst`].
///
/// # Errors
/// The first posture that cannot be evaluated. Joint limits are not checked here.
///
/// # Panics
/// Where there are not as many answers as postures.
pub fn worst_of_rows(
    robot: &Robot,
    flange_from_tool: &Pose,
    rows: &[[f64; 6]],
    units: Units,
    found: &mut [f64],
) -> Result<(), RowError> {
    let arm = SpatialArm::new(robot, flange_from_tool).map_err(|error| RowError { row: 0, error })?;
    assert_eq!(rows.len(), found.len(), "one answer per posture");
    let block = |(rows, found): (&[[f64; 6]], &mut [f64])| {
        let mut columns = [[0.0; BLOCK]; 6];
        arm.worst(radians(rows, units, &mut columns), found)?;
        for value in &mut *found {
            *value *= 1.0 / units.compliance;
        }
        check_held(robot, found.iter().copied())
    };
    let done = rows.par_chunks(BLOCK).zip(found.par_chunks_mut(BLOCK)).try_for_each(block);
    done.map_err(|error| first_row(robot, flange_from_tool, rows, units, error))
}

/// The block from force to translation, base axes, row by row, at many postures; else as [`worst_of_rows`].
///
/// # Errors
/// As [`worst_of_rows`].
///
/// # Panics
/// As [`worst_of_rows`].
pub fn matrices_of_rows(
    robot: &Robot,
    flange_from_tool: &Pose,
    rows: &[[f64; 6]],
    units: Units,
    found: &mut [[f64; 9]],
) -> Result<(), RowError> {
    let arm = SpatialArm::new(robot, flange_from_tool).map_err(|error| RowError { row: 0, error })?;
    assert_eq!(rows.len(), found.len(), "one answer per posture");
    let block = |(rows, found): (&[[f64; 6]], &mut [[f64; 9]])| {
        let (mut columns, mut entries) = ([[0.0; BLOCK]; 6], [[0.0; BLOCK]; 6]);
        let joints = radians(rows, units, &mut columns);
        arm.translations(joints, entries.each_mut().map(|entry| &mut entry[..rows.len()]))?;
        for (n, matrix) in found.iter_mut().enumerate() {
            let [xx, yy, zz, xy, yz, xz] = entries.each_ref().map(|entry| entry[n] * (1.0 / units.compliance));
            *matrix = [xx, xy, xz, xy, yy, yz, xz, yz, zz];
        }
        check_held(robot, found.iter().map(|matrix| matrix[0]))
    };
    let done = rows.par_chunks(BLOCK).zip(found.par_chunks_mut(BLOCK)).try_for_each(block);
    done.map_err(|error| first_row(robot, flange_from_tool, rows, units, error))
}

/// One slice per joint, in radians.
fn radians<'a>(rows: &[[f64; 6]], units: Units, columns: &'a mut [[f64; BLOCK]; 6]) -> [&'a [f64]; 6] {
    for (joint, column) in columns.iter_mut().enumerate() {
        for (angle, row) in column.iter_mut().zip(rows) {
            *angle = row[joint] * units.angle;
        }
    }
    columns.each_ref().map(|column| &column[..rows.len()])
}

/// The kernels answer NaN where nothing holds joint 2.
fn check_held(robot: &Robot, mut values: impl Iterator<Item = f64>) -> Result<(), PostureError> {
    if values.any(f64::is_nan) { Err(PostureError::Unstable(robot.name.clone())) } else { Ok(()) }
}

/// The first posture that cannot be evaluated, whichever thread came upon one.
fn first_row(robot: &Robot, flange_from_tool: &Pose, rows: &[[f64; 6]], units: Units, error: PostureError) -> RowError {
    let evaluate = |(row, q): (usize, &[f64; 6])| {
        let evaluated = compliance(robot, &q.map(|angle| angle * units.angle), flange_from_tool);
        evaluated.err().map(|error| RowError { row, error })
    };
    rows.par_iter().enumerate().find_map_first(evaluate).unwrap_or(RowError { row: 0, error })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::drive::GravityCompensator;
    use crate::robot::Arm;

    const UNITS: Units = Units { angle: std::f64::consts::PI / 180.0, compliance: 1e-6 };

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
            worst_of_rows(&robot, &tool, &joints, UNITS, &mut worst).unwrap();
            matrices_of_rows(&robot, &tool, &joints, UNITS, &mut matrices).unwrap();
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
        let error = worst_of_rows(&robot, &Pose::identity(), &joints, UNITS, &mut vec![0.0; joints.len()]).unwrap_err();
        assert_eq!(error.row, BLOCK + 3);
        assert!(error.to_string().starts_with(&format!("posture {}: joint 2: 1081", BLOCK + 3)), "{error}");

        // A spring that is pressed together pushes the upper arm over.
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!("six axes") };
        let (base, arm) = ([-0.5, -0.1], [0.05, 0.4]);
        drives.compensator = Some(GravityCompensator { base, arm, stiffness: 2e7, free_length: 2.0 });
        let joints = postures();
        let judged = |q: &[f64; 6]| compliance(&robot, &q.map(f64::to_radians), &Pose::identity());
        let row = joints.iter().position(|q| judged(q).is_err()).expect("some lean that nothing holds");
        let error = worst_of_rows(&robot, &Pose::identity(), &joints, UNITS, &mut vec![0.0; joints.len()]).unwrap_err();
        assert_eq!((error.row, error.error), (row, PostureError::Unstable(robot.name.clone())));
        let held: Vec<[f64; 6]> = joints.into_iter().filter(|q| judged(q).is_ok()).collect();
        assert_eq!(worst_of_rows(&robot, &Pose::identity(), &held, UNITS, &mut vec![0.0; held.len()]), Ok(()));
    }
}
