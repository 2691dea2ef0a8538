//! How often do the intervals of an identification hold the truth, over 1000 tables of known truth? No time is measured.
//!
//! Of 95 % some 950, with a standard deviation of 7; the larger of two errors is reported, so that it may be more.

#[path = "../tests/made/mod.rs"]
mod made;

use made::{Made, Spot};
use rayon::prelude::*;
use stiffarm::catalogue::find;
use stiffarm::drive::JointCompliance;
use stiffarm::identify::{Identification, Options, identify};
use stiffarm::robot::{Arm, Robot};
use stiffarm::watch::Watch;

const SEEDS: u64 = 1000;
const TRUTH: [f64; 6] = [0.5e-6, 0.3e-6, 0.6e-6, 2.5e-6, 3.5e-6, 4.0e-6];

fn main() {
    let mut robot = find("KR 210 R2700 extra").expect("in the catalogue").robot();
    robot.stiffness_is_assumed = false;
    let Arm::SixAxis { drives, .. } = &mut robot.arm else { return };
    drives.compliance = JointCompliance(TRUTH);
    println!("of {SEEDS} tables with 50 um of noise, 95 % intervals that hold the truth, drives 1 to 6");
    for (name, spots, with_prior) in [
        ("20 postures x 1 marker, least squares", Spot::one(), false),
        ("20 postures x 3 markers, least squares", Spot::three(), false),
        ("20 postures x 3 markers, posterior", Spot::three(), true),
    ] {
        println!("{name}: {:?}", covered(&robot, &spots, with_prior));
    }
}

fn covered(robot: &Robot, spots: &[Spot], with_prior: bool) -> [usize; 6] {
    let options = Options { with_prior, ..Options::default() };
    let one = |seed: u64| {
        let made = Made { spots: spots.to_vec(), postures: 20, noise: 50e-6, ..Made::usual(seed) };
        let found = identify(robot, &made.measured(robot), &options, Watch::nobody()).expect("six drives show");
        holds(&found).map(usize::from)
    };
    let add = |a: [usize; 6], b: [usize; 6]| std::array::from_fn(|i| a[i] + b[i]);
    (0..SEEDS).into_par_iter().map(one).reduce(|| [0; 6], add)
}

fn holds(found: &Identification) -> [bool; 6] {
    std::array::from_fn(|drive| {
        let interval = match &found.posterior {
            Some(posterior) => Some(posterior.drives[drive].interval()),
            None => found.estimates[drive].interval,
        };
        interval.is_some_and(|[low, high]| low <= TRUTH[drive] && TRUTH[drive] <= high)
    })
}
