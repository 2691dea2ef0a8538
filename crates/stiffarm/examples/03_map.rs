//! How far is the tool pushed off along a vertical line half a metre in front of the joint-2 axis?

use stiffarm::drive::Architecture;
use stiffarm::load::Load;
use stiffarm::map::{Axis, Extent, MapOptions, map};
use stiffarm::model::Model;
use stiffarm::plane::PlanarArm;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arm = PlanarArm::free(1.0, 0.8, 1e-6, 1e-6, Architecture::Serial);
    let axis = Axis::between(-2.0, 2.0, 9);
    let extent = Extent::Grid { x: axis, z: axis };
    let options = MapOptions { extent, load: Load::PAPER, elbow: None, held: None };
    let map = map(&Model::of_links(&arm)?, &options)?.deflection;
    for j in 0..map.z.count {
        match map.get(5, j) {
            Some(deflection) => println!("z = {:5.2} m: {:.3} mm", map.z.at(j), deflection * 1e3),
            None => println!("z = {:5.2} m: out of reach", map.z.at(j)),
        }
    }
    Ok(())
}
