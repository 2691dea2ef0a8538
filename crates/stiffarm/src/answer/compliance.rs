//! How is the compliance of postures told?

use nalgebra::Vector3;
use rayon::prelude::*;
use serde_json::Value;

use super::words::{self, fixed, percentages};
use super::{Cell, Column, ColumnKind, Datum, Record, Rows, Table, columns_of, field, line, with_schema};
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

/// The answer of `compliance`, with what was asked.
#[derive(Clone, Debug)]
pub struct ComplianceAnswer {
    /// Which robot.
    pub robot: Robot,
    /// The joint angles that it reports, deg, as they were given.
    pub joints_deg: [f64; 6],
    /// What was found.
    pub posture: Posture,
    /// A force at the tool point, base axes, N.
    pub force: Option<Vector3<f64>>,
}

impl ComplianceAnswer {
    /// Translation, m, and rotation, rad, under the force.
    pub fn deflection(&self) -> Option<(Vector3<f64>, Vector3<f64>)> {
        self.force.map(|force| self.posture.compliance.deflection(&Wrench::force(force)))
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let Self { robot, joints_deg, posture, force } = self;
        let (translation, whole) = (posture.compliance.translation(), posture.compliance.0);
        let (_, worst) = posture.compliance.worst();
        let by_rows = |size: usize, at: &dyn Fn(usize, usize) -> f64| {
            Datum::Numbers((0..size * size).map(|n| Some(at(n / size, n % size))).collect())
        };
        let moved = self.deflection();
        let mut record = Record::new();
        record
            .put(field::ROBOT, &robot.name)
            .put(field::MODEL, "spatial")
            .put(field::JOINTS, *joints_deg)
            .put(field::TCP, posture.tool.translation.vector.as_slice())
            .put(field::COMPLIANCE, by_rows(3, &|i, j| translation[(i, j)]))
            .put(field::COMPLIANCE_6X6, by_rows(6, &|i, j| whole[(i, j)]))
            .put(field::PRINCIPAL, posture.compliance.principal().map(|(value, _)| value))
            .put(field::WORST_DIRECTION, worst.as_slice())
            .put(field::WORST_SHARES, posture.shares(&worst))
            .put(field::FORCE_VECTOR, force.as_ref().map(Vector3::as_slice))
            .put(field::MOVED, moved.as_ref().map(|moved| moved.0.as_slice()))
            .put(field::TURNED, moved.as_ref().map(|moved| moved.1.as_slice()));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("compliance", &self.record())
    }

    /// The 6 x 6 matrix for a spreadsheet: from each force and moment to translation and rotation, SI.
    pub fn rows(&self) -> Rows<'static> {
        let mut columns = columns_of(&field::ENTRY);
        columns.extend(
            ["x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad"].map(|name| Column::new(name, ColumnKind::Number)),
        );
        let names = ["fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "mz_nm"];
        let row = |(i, name): (usize, &str)| {
            let numbers = self.posture.compliance.0.column(i).iter().map(|x| Cell::Number(*x)).collect::<Vec<_>>();
            std::iter::once(Cell::Text(name.into())).chain(numbers).collect()
        };
        Rows::new(columns, names.into_iter().enumerate().map(row).collect())
    }

    /// For people.
    pub fn table(&self) -> Table {
        let Self { robot, joints_deg, posture, .. } = self;
        let mut lines = vec![
            line("robot", words::robot(robot)),
            line("joints as reported", format!("{} deg", joints_deg.map(|angle| angle.to_string()).join(", "))),
            line("tool point from the base", format!("{} m", vector(&posture.tool.translation.vector, 4))),
        ];
        for (name, (value, direction)) in
            ["stiffest direction", "", "worst direction"].into_iter().zip(posture.compliance.principal())
        {
            lines.push(line(name, format!("{} um/N along {}", fixed(value * 1e6, 4), vector(&direction, 3))));
        }
        let (_, worst) = posture.compliance.worst();
        lines.push(line("share of drives 1-6", percentages(&posture.shares(&worst))));
        for (i, name) in ["compliance x, y, z", "", ""].into_iter().enumerate() {
            let row = posture.compliance.translation().row(i).map(|x| fixed(x * 1e6, 4));
            lines.push(line(name, format!("{} um/N", row.iter().cloned().collect::<Vec<_>>().join(", "))));
        }
        if let (Some(force), Some((moved, turned))) = (self.force, self.deflection()) {
            lines.push(line("force", format!("{} N", vector(&force, 1))));
            let whole = moved.norm() * 1e3;
            lines.push(line("deflection", format!("{} mm, {whole:.4} mm in all", vector(&(moved * 1e3), 4))));
            lines.push(line("rotation", format!("{} mrad", vector(&(turned * 1e3), 4))));
            if 0.0 < force.norm() {
                let shares = percentages(&posture.shares(&force.normalize()));
                lines.push(line("share of drives 1-6 along the force", shares));
            }
        }
        Table::of_lines(lines)
    }

    /// What stands below the table.
    pub const NOTES: &'static str =
        "base axes: x forward, y left, z up; all six drives compliant, everything else rigid\n";
}

/// Three numbers, rounded.
pub fn vector(v: &Vector3<f64>, digits: usize) -> String {
    format!("{}, {}, {}", fixed(v.x, digits), fixed(v.y, digits), fixed(v.z, digits))
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
