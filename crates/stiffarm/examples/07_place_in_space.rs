//! Where must a square lie under a spindle that points down, all six drives compliant, and how sure is that?

use stiffarm::catalogue::paper_robots;
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::model::Model;
use stiffarm::place::{PlaceOptions, Placed, Within, place};
use stiffarm::spatial::Pose;
use stiffarm::task::Task;
use stiffarm::watch::Watch;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot =
        paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").ok_or("not in the catalogue")?;
    let task: Task = "rect:0.4x0.4".parse()?;
    let table = Interval::new(0.5, 1.2).ok_or("an interval")?;
    let model = Model::spatial(&robot, &Pose::translation(0.0, 0.0, 0.3))?;
    let within = Within { x: Interval::POSITIVE, z: table };
    let options = PlaceOptions { within: Some(within), ..PlaceOptions::under(Load::PAPER) };
    match place(&model, &task.work, &options, Watch::nobody())? {
        Placed::Feasible(best) => {
            println!("{:.4} mm at worst, at least {:.4} mm anywhere", best.deflection * 1e3, best.lower_bound * 1e3);
            println!(
                "centre {:.3?} m from the base, {:.1} deg about the tool axis",
                best.centre,
                best.space().map_or(0.0, |hold| hold.roll.to_degrees())
            );
        }
        Placed::Infeasible { reason, is_proved, .. } => {
            println!("no place{}: {reason}", if is_proved { ", which is proved" } else { " found" });
        }
    }
    Ok(())
}
