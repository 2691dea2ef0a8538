//! Which of the paper's ten robots holds a 1 kN force best on a zone of half a metre by a metre?

use stiffarm::catalogue::paper_robots;
use stiffarm::load::Load;
use stiffarm::model::ModelKind;
use stiffarm::place::PlaceOptions;
use stiffarm::rank::rank;
use stiffarm::task::Task;
use stiffarm::watch::Watch;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let task: Task = "rect:0.5x1.0".parse()?;
    let ranking =
        rank(&paper_robots(), &[task], &ModelKind::Planar, &PlaceOptions::under(Load::PAPER), Watch::nobody())?;
    for row in &ranking.rows {
        match row.deflection(0) {
            Some(deflection) => println!("{:20} {:12} {:.3} mm", row.robot.name, row.robot.status, deflection * 1e3),
            None => println!("{:20} {:12} no place", row.robot.name, row.robot.status),
        }
    }
    Ok(())
}
