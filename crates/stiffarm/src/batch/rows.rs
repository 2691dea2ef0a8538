//! How compliant are many postures, given as rows of six joint angles in the units of whoever asks?

use pulp::{Arch, Simd, WithSimd};

use super::SpatialArm;
use super::joints::{Translations, Worst, makes_sense};
use crate::compliance::{PostureError, compliance};
use crate::parallel;
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::watch::{Stopped, Watch};

/// Postures of which the angles are turned into radians at a time: they stay in the nearest cache.
const BLOCK: usize = 256;
/// Postures that one thread takes at a time.
const CHUNK: usize = 16 * BLOCK;

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

/// Why many postures have no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RowsError {
    /// One of them has none.
    #[error(transparent)]
    Row(#[from] RowError),
    /// No longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// The largest translation per force in any direction at many postures, given by the joint angles that the robot reports. On
/// all cores; as exact as [`SpatialArm::worst`]. The parts of the work are blocks of rows.
///
/// # Errors
/// The first posture that cannot be evaluated, or that the work is no longer wanted. Joint limits are not checked here.
///
/// # Panics
/// Where there are not as many answers as postures.
pub fn worst_of_rows(
    robot: &Robot,
    flange_from_tool: &Pose,
    rows: &[[f64; 6]],
    units: Units,
    found: &mut [f64],
    watch: Watch,
) -> Result<(), RowsError> {
    let arm = &SpatialArm::new(robot, flange_from_tool).map_err(|error| RowError { row: 0, error })?;
    assert_eq!(rows.len(), found.len(), "one answer per posture");
    let parts = watch.parts(Some(rows.len().div_ceil(CHUNK)));
    let chunk = |_, (rows, found): (&[[f64; 6]], &mut [f64])| {
        parts.one_more()?;
        let blocks = rows.chunks(BLOCK).zip(found.chunks_mut(BLOCK));
        let fine = blocks.map(|(rows, found)| Arch::new().dispatch(WorstOfRows { arm, rows, units, found }));
        Ok::<_, Stopped>(fine.fold(true, |all, one| all & one))
    };
    if parallel::try_take_each(rows.chunks(CHUNK).zip(found.chunks_mut(CHUNK)), chunk)?.into_iter().all(|fine| fine) {
        return Ok(());
    }
    refuse_first(robot, flange_from_tool, rows, units, found.iter().position(|value| value.is_nan()))
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
    watch: Watch,
) -> Result<(), RowsError> {
    let arm = &SpatialArm::new(robot, flange_from_tool).map_err(|error| RowError { row: 0, error })?;
    assert_eq!(rows.len(), found.len(), "one answer per posture");
    let parts = watch.parts(Some(rows.len().div_ceil(CHUNK)));
    let chunk = |_, (rows, found): (&[[f64; 6]], &mut [[f64; 9]])| {
        parts.one_more()?;
        let blocks = rows.chunks(BLOCK).zip(found.chunks_mut(BLOCK));
        let fine = blocks.map(|(rows, found)| Arch::new().dispatch(MatricesOfRows { arm, rows, units, found }));
        Ok::<_, Stopped>(fine.fold(true, |all, one| all & one))
    };
    if parallel::try_take_each(rows.chunks(CHUNK).zip(found.chunks_mut(CHUNK)), chunk)?.into_iter().all(|fine| fine) {
        return Ok(());
    }
    refuse_first(robot, flange_from_tool, rows, units, found.iter().position(|matrix| matrix[0].is_nan()))
}

/// One block of rows; false where a row of it may have no answer.
struct WorstOfRows<'a> {
    arm: &'a SpatialArm,
    rows: &'a [[f64; 6]],
    units: Units,
    found: &'a mut [f64],
}

impl WithSimd for WorstOfRows<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Self { arm, rows, units, found } = self;
        let mut columns = [[0.0; BLOCK]; 6];
        let mut fine = radians(rows, units, &mut columns);
        let joints = [0, 1, 2, 3, 4, 5].map(|joint| &columns[joint][..rows.len()]);
        Worst { arm, joints, found: &mut *found }.with_simd(simd);
        let scale = 1.0 / units.compliance;
        for value in found {
            *value *= scale;
            // The kernels answer NaN where nothing holds joint 2.
            fine &= !value.is_nan();
        }
        fine
    }
}

/// As [`WorstOfRows`].
struct MatricesOfRows<'a> {
    arm: &'a SpatialArm,
    rows: &'a [[f64; 6]],
    units: Units,
    found: &'a mut [[f64; 9]],
}

impl WithSimd for MatricesOfRows<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Self { arm, rows, units, found } = self;
        let (mut columns, mut entries) = ([[0.0; BLOCK]; 6], [[0.0; BLOCK]; 6]);
        let mut fine = radians(rows, units, &mut columns);
        let joints = [0, 1, 2, 3, 4, 5].map(|joint| &columns[joint][..rows.len()]);
        let into = entries.each_mut().map(|entry| &mut entry[..rows.len()]);
        Translations { arm, joints, entries: into }.with_simd(simd);
        let scale = 1.0 / units.compliance;
        for n in 0..found.len() {
            let [xx, yy, zz, xy, yz, xz] = [0, 1, 2, 3, 4, 5].map(|entry| entries[entry][n] * scale);
            found[n] = [xx, xy, xz, xy, yy, yz, xz, yz, zz];
            fine &= !xx.is_nan();
        }
        fine
    }
}

/// Rows as columns, in radians; whether every angle makes sense. Inlined, so that it is compiled with the wide instructions.
#[inline(always)]
fn radians(rows: &[[f64; 6]], units: Units, columns: &mut [[f64; BLOCK]; 6]) -> bool {
    let mut fine = true;
    for n in 0..rows.len().min(BLOCK) {
        for joint in 0..6 {
            let angle = rows[n][joint] * units.angle;
            columns[joint][n] = angle;
            fine &= makes_sense(angle);
        }
    }
    fine
}

/// Refuses the first posture that cannot be evaluated, whichever thread came upon one; where one at a time all can be, that which
/// many at once have no number for.
fn refuse_first(
    robot: &Robot,
    flange_from_tool: &Pose,
    rows: &[[f64; 6]],
    units: Units,
    without_number: Option<usize>,
) -> Result<(), RowsError> {
    let evaluate = |chunk: usize, rows: &[[f64; 6]]| {
        rows.iter().enumerate().try_for_each(|(i, q)| {
            let evaluated = compliance(robot, &q.map(|angle| angle * units.angle), flange_from_tool);
            evaluated.map(|_| ()).map_err(|error| RowError { row: chunk * CHUNK + i, error })
        })
    };
    parallel::try_take_each(rows.chunks(CHUNK), evaluate)?;
    let unstable = |row| RowError { row, error: PostureError::Unstable(robot.name.clone()) };
    without_number.map_or(Ok(()), |row| Err(unstable(row).into()))
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

    /// The row that both kinds of answers refuse.
    fn refusal(robot: &Robot, joints: &[[f64; 6]]) -> Option<RowError> {
        let (tool, watch) = (Pose::identity(), Watch::nobody());
        let refused = |done| match done {
            Ok(()) => None,
            Err(RowsError::Row(error)) => Some(error),
            Err(RowsError::Stopped(error)) => panic!("{error}"),
        };
        let worst = refused(worst_of_rows(robot, &tool, joints, UNITS, &mut vec![0.0; joints.len()], watch));
        let mut matrices = vec![[0.0; 9]; joints.len()];
        assert_eq!(refused(matrices_of_rows(robot, &tool, joints, UNITS, &mut matrices, watch)), worst);
        worst
    }

    #[test]
    fn many_postures_in_degrees_are_what_single_ones_are() {
        let tool = Pose::translation(0.1, -0.05, 0.2);
        for robot in paper_robots() {
            let joints = postures();
            let mut worst = vec![0.0; joints.len()];
            let mut matrices = vec![[0.0; 9]; joints.len()];
            worst_of_rows(&robot, &tool, &joints, UNITS, &mut worst, Watch::nobody()).unwrap();
            matrices_of_rows(&robot, &tool, &joints, UNITS, &mut matrices, Watch::nobody()).unwrap();
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
        let error = refusal(&robot, &joints).unwrap();
        assert_eq!(error.row, BLOCK + 3);
        assert!(error.to_string().starts_with(&format!("posture {}: joint 2: 1081", BLOCK + 3)), "{error}");

        // A spring that is pressed together pushes the upper arm over.
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!("six axes") };
        let (base, arm) = ([-0.5, -0.1], [0.05, 0.4]);
        drives.compensator = Some(GravityCompensator { base, arm, stiffness: 2e7, free_length: 2.0 });
        let joints = postures();
        let judged = |q: &[f64; 6]| compliance(&robot, &q.map(f64::to_radians), &Pose::identity());
        let row = joints.iter().position(|q| judged(q).is_err()).expect("some lean that nothing holds");
        let error = refusal(&robot, &joints).unwrap();
        assert_eq!((error.row, error.error), (row, PostureError::Unstable(robot.name.clone())));
        let held: Vec<[f64; 6]> = joints.into_iter().filter(|q| judged(q).is_ok()).collect();
        assert_eq!(refusal(&robot, &held), None);
    }
}
