//! How far is the tool pushed off along a vertical line half a metre in front of the joint-2 axis?

use stiffarm::drive::Architecture;
use stiffarm::map::{Axis, Direction, MapOptions, map};
use stiffarm::plane::PlanarArm;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arm = PlanarArm::free(1.0, 0.8, 1e-6, 1e-6, Architecture::Serial);
    let axis = Axis::between(-2.0, 2.0, 9);
    let options = MapOptions { x: axis, z: axis, force: 1000.0, direction: Direction::Worst, elbow: None };
    let map = map(&arm, &options)?;
    for j in 0..map.z.count {
        match map.get(5, j) {
            Some(deflection) => println!("z = {:5.2} m: {:.3} mm", map.z.at(j), deflection * 1e3),
            None => println!("z = {:5.2} m: out of reach", map.z.at(j)),
        }
    }
    Ok(())
}
