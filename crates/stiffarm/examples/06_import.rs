//! Which robot does a URDF describe, and how far is the robot file from it?

use stiffarm::catalogue::import::{ImportOptions, import};
use stiffarm::drive::Architecture;

const URDF: &str = include_str!("../../../docs/examples/example_150.urdf");

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // What no URDF says: whose robot it is, what it carries, and how joint 3 is driven.
    let options = ImportOptions {
        vendor: Some("Example".into()),
        payload_kg: Some(150.0),
        architecture: Some(Architecture::Serial),
        ..ImportOptions::default()
    };
    let imported = import(URDF, "example_150.urdf", &options)?;
    println!("{}", imported.text);
    println!(
        "{}: at most {:.1e} mm from {}",
        imported.robot.full_name(),
        imported.largest_error * 1e3,
        imported.compared_with
    );
    for note in &imported.notes {
        println!("note: {note}");
    }
    Ok(())
}
