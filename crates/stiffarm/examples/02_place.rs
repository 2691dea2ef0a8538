//! Where must a zone stand on a table between 0.4 m and 1.6 m above the floor, and who proves it?

use stiffarm::catalogue::paper_robots;
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::model::Model;
use stiffarm::place::{PlaceOptions, Placed, Within, place};
use stiffarm::task::Task;
use stiffarm::watch::Watch;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = paper_robots().into_iter().find(|robot| robot.name == "IRB 6650S-200").ok_or("not in the catalogue")?;
    let task: Task = "rect:0.5x1.0".parse()?;
    let table = Interval::new(0.4, 1.6).ok_or("an interval")?;
    let options =
        PlaceOptions { within: Some(Within { x: Interval::ALL, z: table }), ..PlaceOptions::under(Load::PAPER) };
    match place(&Model::planar(&robot)?, &task.work, &options, Watch::nobody())? {
        Placed::Feasible(best) => {
            println!("{:.4} mm at worst; proved lower bound {:.4} mm", best.deflection * 1e3, best.lower_bound * 1e3);
            println!("centre {:.3?} m from the base, elbow {}", best.centre, best.elbow.name());
        }
        Placed::Infeasible { reason, largest_scale, .. } => {
            println!("{reason}; {largest_scale:.3?} of the size would fit");
        }
    }
    Ok(())
}
