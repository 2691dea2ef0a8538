//! How far is the tool pushed off along a path, at the best rolls, and what does compensation leave?

use stiffarm::catalogue::find;
use stiffarm::mill::{Acting, MillOptions, Milled, PartPlacement, Stand, compensate, mill, stations};
use stiffarm::spatial::Pose;
use stiffarm::toolpath::{Builtin, Steps};
use stiffarm::watch::Watch;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = find("KR 210 R2700 extra").ok_or("in the catalogue")?.robot();
    // A circle of 300 mm at 1.2 m/min; N along the feed, across it and axial.
    let moves = "circle:0.3".parse::<Builtin>()?.moves(Some(0.02));
    let acting = Acting::Known { force: [300.0, -120.0, 80.0], moment: 0.0 };
    let stations = stations(&moves, &Steps::USUAL, |_| Some(acting));
    let placement = PartPlacement::from_base([1.7, 0.0, 0.8], 0.0);
    // A spindle of 250 mm across axis 6.
    let tool = Pose::new(nalgebra::Vector3::new(0.25, 0.0, 0.0), nalgebra::Vector3::y() * std::f64::consts::FRAC_PI_2);
    let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool: tool };
    let options = MillOptions::usual();
    match mill(&robot, &stand, &stations, &options, Watch::nobody())? {
        Milled::Blocked(blocked) => println!("not followed: {blocked}"),
        Milled::Followed(found) => {
            let (worst, lower) = (1e3 * found.worst.0, 1e3 * found.lower_bound);
            println!("largest error {worst:.3} mm; lower bound of all rolls {lower:.3} mm");
            let done = compensate(&robot, &stand, (&stations, &found.samples), options.part, Watch::nobody())?;
            println!(
                "compensated: {:.4} mm are left by the model where tips alone are commanded",
                1e3 * done.by_tips()
            );
        }
    }
    Ok(())
}
