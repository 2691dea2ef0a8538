//! How is the compliance of postures reported?

use std::borrow::Cow;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::stiffness::{self, stiffness};
use super::words::{self, fixed, percentages};
use super::{
    Cell, Column, ColumnKind, Datum, Record, Rows, Table, columns_of, field, force, line, shape, uncertainty,
    with_schema,
};
use stiffarm::batch::{RowsError, Units, matrices_of_rows, worst_of_rows};
use stiffarm::compliance::{Posture, beyond_limits};
use stiffarm::limits::Pendant;
use stiffarm::load::{Direction, Largest, Load};
use stiffarm::robot::Robot;
use stiffarm::spatial::{Pose, Wrench};
use stiffarm::uncertainty::{Spread, of_posture};
use stiffarm::watch::Watch;

/// The units of many postures: joint angles in degrees, compliances in um/N.
const UNITS: Units = Units { angle: std::f64::consts::PI / 180.0, compliance: 1e-6 };

/// The answer of `compliance`, with what was asked.
#[derive(Clone, Debug)]
pub struct ComplianceAnswer {
    /// Which robot.
    pub robot: Robot,
    /// The joint angles that it reports, deg, as they were given.
    pub joints_deg: [f64; 6],
    /// What was found.
    pub posture: Posture,
    /// A force at the tool point.
    pub load: Option<Load>,
}

impl ComplianceAnswer {
    /// What the force does at most.
    fn largest(&self) -> Option<Largest> {
        self.load.map(|load| self.posture.under(load))
    }

    /// The force, base axes, N: as it was given, or of those that it may be the one that does most.
    pub fn force(&self) -> Option<Vector3<f64>> {
        let load = self.load?;
        match load.direction() {
            Direction::Base(force) if load.cone() == 0.0 => Some(force.into()),
            _ => self.largest().map(|largest| largest.force * load.newtons()),
        }
    }

    /// Translation, m, and rotation, rad, under that force.
    pub fn deflection(&self) -> Option<(Vector3<f64>, Vector3<f64>)> {
        self.force().map(|force| self.posture.compliance.deflection(&Wrench::force(force)))
    }

    /// Joints beyond their limits, 0 for the angle between the links.
    pub fn beyond_limits(&self) -> Vec<usize> {
        beyond_limits(&self.robot, &self.joints_deg.map(f64::to_radians))
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let Self { robot, joints_deg, posture, load } = self;
        let (translation, whole) = (posture.compliance.translation(), posture.compliance.0);
        let (_, worst) = posture.compliance.worst();
        let by_rows = |size: usize, at: &dyn Fn(usize, usize) -> f64| {
            Datum::Numbers((0..size * size).map(|n| Some(at(n / size, n % size))).collect())
        };
        let (force, moved) = (self.force(), self.deflection());
        let counted = load.zip(self.largest()).map(|(load, largest)| largest.value * load.newtons());
        let mut record = Record::of(&shape::COMPLIANCE);
        stiffness::put_robot(&mut record, robot);
        record
            .put(field::MODEL, "spatial")
            .put(field::JOINTS, *joints_deg)
            .put(field::JOINTS_BEYOND, json!(self.beyond_limits()))
            .put(field::PENDANT, robot.pendant().map(Pendant::name))
            .put(field::TCP, posture.tool.translation.vector.as_slice())
            .put(field::COMPLIANCE, by_rows(3, &|i, j| translation[(i, j)]))
            .put(field::COMPLIANCE_6X6, by_rows(6, &|i, j| whole[(i, j)]))
            .put(field::PRINCIPAL, posture.compliance.principal().map(|(value, _)| value))
            .put(field::WORST_DIRECTION, worst.as_slice())
            .put(field::WORST_SHARES, posture.shares(&worst))
            .put(field::FORCE_VECTOR, force.as_ref().map(Vector3::as_slice))
            .put(field::MOVED, moved.as_ref().map(|moved| moved.0.as_slice()))
            .put(field::TURNED, moved.as_ref().map(|moved| moved.1.as_slice()))
            .put(field::COUNTED, counted);
        uncertainty::put(&mut record, self.spread());
        force::put_direction(&mut record, *load);
        record
    }

    /// Where what counts of the translation lies with 90 %, over draws of the drive stiffness; `None` where its uncertainty is not known.
    fn spread(&self) -> Option<Spread> {
        of_posture(&self.robot, &self.posture, self.load?)
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("compliance", super::ORIGIN, &self.record())
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
        let Self { robot, joints_deg, posture, load } = self;
        let mut lines = vec![
            line("robot", words::robot(robot)),
            line("stiffness", stiffness(robot)),
            line(
                words::joints_reported(robot),
                format!("{} deg", joints_deg.map(|angle| angle.to_string()).join(", ")),
            ),
        ];
        let beyond: Vec<Cow<str>> = self.beyond_limits().into_iter().map(words::limited).collect();
        if !beyond.is_empty() {
            lines.push(line("beyond its limits", beyond.join(", ")));
        }
        lines.push(line("tool point from the base", format!("{} m", vector(&posture.tool.translation.vector, 4))));
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
        if let (Some(load), Some(force), Some((moved, turned))) = (load, self.force(), self.deflection()) {
            if matches!(load.direction(), Direction::Base(_)) && load.cone() == 0.0 {
                lines.push(line("force", format!("{} N", vector(&force, 1))));
            } else {
                lines.push(line("force", words::force(*load)));
                lines.push(line("of these the one that does most", format!("{} N", vector(&force, 1))));
            }
            let whole = moved.norm() * 1e3;
            lines.push(line("deflection", format!("{} mm, {whole:.4} mm in all", vector(&(moved * 1e3), 4))));
            if let (false, Some(largest)) = (words::component(*load).is_empty(), self.largest()) {
                lines.push(line(words::component(*load), format!("{:.4} mm", largest.value * load.newtons() * 1e3)));
            }
            lines.extend(uncertainty::row(&self.robot, self.spread()));
            lines.push(line("rotation", format!("{} mrad", vector(&(turned * 1e3), 4))));
            let shares = percentages(&posture.shares(&force.normalize()));
            lines.push(line("share of drives 1-6 along the force", shares));
        }
        Table::of_lines(lines)
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let assumed = words::assumed_architecture([&self.robot]);
        let pendant = words::pendant_note(&self.robot);
        format!(
            "{assumed}{pendant}base axes: x forward, y left, z up; all six drives compliant, everything else rigid\n"
        )
    }
}

/// Three numbers, rounded.
pub fn vector(v: &Vector3<f64>, digits: usize) -> String {
    format!("{}, {}, {}", fixed(v.x, digits), fixed(v.y, digits), fixed(v.z, digits))
}

/// The largest translation per force in any direction, um/N, at many postures, given by the joint angles that the robot
/// reports, deg; see [`worst_of_rows`].
///
/// # Errors
/// As [`worst_of_rows`].
///
/// # Panics
/// Where there are not as many answers as postures.
pub fn worst_um_per_n(
    robot: &Robot,
    flange_from_tool: &Pose,
    joints_deg: &[[f64; 6]],
    found: &mut [f64],
    watch: Watch,
) -> Result<(), RowsError> {
    worst_of_rows(robot, flange_from_tool, joints_deg, UNITS, found, watch)
}

/// What looks wrong about joint angles, deg, of one posture or many: radians, and joints beyond their limits.
pub fn doubts(robot: &Robot, joints_deg: &[[f64; 6]]) -> Vec<String> {
    let (mut found, mut beyond) = (Vec::new(), [0_usize; 7]);
    let angles = || joints_deg.iter().flatten();
    if angles().any(|angle| *angle != 0.0) && angles().all(|angle| angle.abs() <= std::f64::consts::TAU) {
        found.push(
            "warning: no joint angle is beyond 6.3 deg; if these are radians, convert them to degrees".to_owned(),
        );
    }
    for q in joints_deg {
        for joint in beyond_limits(robot, &q.map(f64::to_radians)) {
            beyond[joint] += 1;
        }
    }
    for (joint, count) in beyond.into_iter().enumerate().filter(|(_, count)| 0 < *count) {
        let (which, all) = (words::limited(joint), joints_deg.len());
        let at = if all == 1 { String::new() } else { format!(" at {count} of {all} postures") };
        found.push(format!("warning: {which} is beyond its limits{at} (`stiffarm robots show` lists them)"));
    }
    found
}

/// The block from force to translation, um/N, base axes, at many postures; see [`matrices_of_rows`].
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
    watch: Watch,
) -> Result<(), RowsError> {
    matrices_of_rows(robot, flange_from_tool, joints_deg, UNITS, found, watch)
}
