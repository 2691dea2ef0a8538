//! `stiffarm compliance`: one posture, all six drives.

use std::io::{self, Write};
use std::path::Path;

use nalgebra::Vector3;
use stiffarm::compliance::{Posture, beyond_limits, compliance};
use stiffarm::report;
use stiffarm::request::Request;
use stiffarm::robot::Robot;
use stiffarm::spatial::{Pose, Wrench};

use crate::args::Common;
use crate::failure::Failure;
use crate::figures::view3d::{ArmMark, Arrow, View};
use crate::output::{Answer, Outputs, pretty, say};
use crate::selection;
use crate::table::{Table, fixed, percentages};

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let name = asked.robot()?;
    let outputs = Outputs::open::<ComplianceAnswer>(common, &[Path::new(&name)])?;
    let robot = selection::robot(&name, common)?;
    let q = asked.joints_deg()?;
    let tool = asked.held().tool();
    let force = asked.force_along().map(Vector3::from);
    let radians = q.map(f64::to_radians);
    let posture =
        compliance(&robot, &radians, &tool).map_err(|error| Failure::Posture { robot: robot.name.clone(), error })?;
    if !common.quiet {
        remarks(&robot, &q, &radians);
    }
    outputs.deliver(&ComplianceAnswer { robot, q, tool, force, posture })
}

/// Says on stderr what looks wrong about the joint angles.
fn remarks(robot: &Robot, q: &[f64; 6], radians: &[f64; 6]) {
    if q.iter().any(|angle| *angle != 0.0) && q.iter().all(|angle| angle.abs() <= std::f64::consts::TAU) {
        say("warning: no joint angle is beyond 6.3 deg; if these are radians, convert them to degrees");
    }
    for joint in beyond_limits(robot, radians) {
        let which = if joint == 0 { "the angle between the links".into() } else { format!("joint {joint}") };
        say(&format!("warning: {which} is beyond its limits (`stiffarm robots show` lists them)"));
    }
}

struct ComplianceAnswer {
    robot: Robot,
    q: [f64; 6],
    tool: Pose,
    force: Option<Vector3<f64>>,
    posture: Posture,
}

impl ComplianceAnswer {
    fn deflection(&self) -> Option<(Vector3<f64>, Vector3<f64>)> {
        self.force.map(|force| self.posture.compliance.deflection(&Wrench::force(force)))
    }

    /// The worst direction, and the deflection where a force is given, both as many times too long.
    fn arrows(&self) -> Vec<Arrow> {
        let (worst, direction) = self.posture.compliance.worst();
        let at = self.posture.tool.translation.vector.into();
        // As long as 1 kN pushes it, or the force that was given.
        let worst = worst * 1e3 * direction;
        let moved = self.deflection().map(|(moved, _)| moved);
        let times = magnified(worst.norm().max(moved.map_or(0.0, |moved| moved.norm())));
        let arrow = |what: &str, moved: Vector3<f64>, unit: &str| Arrow {
            label: format!("{what}: {:.4} {unit}, drawn {times} times as long", moved.norm() * 1e3),
            at,
            along: (times * moved).into(),
        };
        let worst = Some(worst).map(|moved| arrow("worst direction", moved, "mm per kN"));
        let moved = moved.map(|moved| arrow("deflection", moved, "mm under the force"));
        worst.into_iter().chain(moved).filter(|arrow| arrow.along != [0.0; 3]).collect()
    }
}

/// How many times too long a deflection, m, is drawn: 1, 2 or 5 times a power of ten, so that half a metre is not passed.
fn magnified(deflection: f64) -> f64 {
    let most = 0.5 / deflection;
    if !most.is_finite() {
        return 1.0;
    }
    let ten = 10_f64.powf(most.log10().floor());
    [5.0, 2.0, 1.0].map(|step| step * ten).into_iter().find(|&times| times <= most).unwrap_or(ten)
}

fn vector(v: &Vector3<f64>, digits: usize) -> String {
    format!("{}, {}, {}", fixed(v.x, digits), fixed(v.y, digits), fixed(v.z, digits))
}

impl Answer for ComplianceAnswer {
    const COMMAND: &'static str = "compliance";
    const FURTHER: &'static [&'static str] = &["html"];

    fn text(&self, markdown: bool) -> String {
        let Self { robot, q, posture, .. } = self;
        let mut table = Table::new(["", ""]);
        table.row(["robot".into(), format!("{} ({}, {})", robot.full_name(), robot.architecture, robot.status)]);
        table.row(["joints as reported".into(), format!("{} deg", q.map(|angle| angle.to_string()).join(", "))]);
        table.row(["tool point from the base".into(), format!("{} m", vector(&posture.tool.translation.vector, 4))]);
        for (name, (value, direction)) in
            ["stiffest direction", "", "worst direction"].into_iter().zip(posture.compliance.principal())
        {
            table.row([name.into(), format!("{} um/N along {}", fixed(value * 1e6, 4), vector(&direction, 3))]);
        }
        let (_, worst) = posture.compliance.worst();
        table.row(["drives 1 to 6 give of it".into(), percentages(&posture.shares(&worst))]);
        for (i, name) in ["compliance x, y, z".into(), String::new(), String::new()].into_iter().enumerate() {
            let row = posture.compliance.translation().row(i).map(|x| fixed(x * 1e6, 4));
            table.row([name, format!("{} um/N", row.iter().cloned().collect::<Vec<_>>().join(", "))]);
        }
        if let (Some(force), Some((moved, turned))) = (self.force, self.deflection()) {
            table.row(["force".into(), format!("{} N", vector(&force, 1))]);
            table.row([
                "deflection".into(),
                format!("{} mm, {:.4} mm in all", vector(&(moved * 1e3), 4), moved.norm() * 1e3),
            ]);
            table.row(["rotation".into(), format!("{} mrad", vector(&(turned * 1e3), 4))]);
            if 0.0 < force.norm() {
                let shares = percentages(&posture.shares(&force.normalize()));
                table.row(["drives 1 to 6 give along the force".into(), shares]);
            }
        }
        table.text(markdown) + "\nbase axes: x forward, y left, z up; all six drives compliant, everything else rigid\n"
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &report::compliance::posture(&self.robot, &self.q, &self.posture, self.force.as_ref()))
    }

    fn csv(&self) -> Table<'_> {
        let mut table = Table::new(["row", "x_m", "y_m", "z_m", "rx_rad", "ry_rad", "rz_rad"]);
        for (i, name) in ["fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "mz_nm"].into_iter().enumerate() {
            let column = self.posture.compliance.0.column(i).map(|x| x.to_string());
            table.row(std::iter::once(name.to_owned()).chain(column.iter().cloned()));
        }
        table
    }

    fn view(&self) -> Option<Result<View, Failure>> {
        let Self { robot, q, posture, .. } = self;
        let (worst, direction) = posture.compliance.worst();
        let shares = posture.shares(&direction);
        let angles = q.map(|angle| angle.to_string()).join(", ");
        Some(Ok(View {
            title: robot.full_name(),
            notes: vec![
                format!("{}, {}; joints as reported: {angles} deg", robot.architecture, robot.status),
                format!("worst direction: {:.4} um/N along {}", worst * 1e6, vector(&direction, 3)),
                "all six drives compliant, everything else rigid".into(),
            ],
            arm: ArmMark::posed(robot, &q.map(f64::to_radians), &self.tool, Some(&shares)),
            arrows: self.arrows(),
            floor: true,
            ..View::default()
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_are_as_long_as_a_picture_can_bear() {
        for (deflection, times) in [(0.5, 1.0), (0.004_47, 100.0), (0.002_5, 200.0), (0.000_9, 500.0), (3.0, 0.1)] {
            assert!((magnified(deflection) / times - 1.0).abs() < 1e-12, "{deflection}: {}", magnified(deflection));
        }
        assert_eq!(magnified(0.0), 1.0);
    }
}
