//! Which way is a robot softest at one posture with a spindle, and which drive gives way most there?

use nalgebra::Vector3;
use stiffarm::catalogue::paper_robots;
use stiffarm::compliance::compliance;
use stiffarm::spatial::{Pose, Wrench};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot =
        paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").ok_or("not in the catalogue")?;
    let joints = [0.0, -60.0, 90.0, 0.0, 60.0, 0.0].map(f64::to_radians);
    let flange_from_tool = Pose::translation(0.1, 0.0, 0.25);
    let posture = compliance(&robot, &joints, &flange_from_tool)?;

    let (worst, direction) = posture.compliance.worst();
    println!("{:.3} mm per kN along {:.3?} in the axes of the base", worst * 1e6, direction.as_slice());
    for (drive, share) in (1..).zip(posture.shares(&direction)) {
        println!("drive {drive}: {:4.1} % of it", share * 100.0);
    }

    let (moved, turned) = posture.compliance.deflection(&Wrench::force(Vector3::new(0.0, 0.0, 500.0)));
    println!(
        "500 N upwards push the tool off by {:.3} mm and tilt it by {:.3} mrad",
        moved.norm() * 1e3,
        turned.norm() * 1e3
    );
    Ok(())
}
