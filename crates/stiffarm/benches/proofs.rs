//! How much is proved of places in space: random questions, answered one after the other on all cores.
//!
//! `cargo bench -p stiffarm --bench proofs [-- QUESTIONS]` tells in which share of the places found the proved bound lies within
//! 1, 5 and 10 % of the value, of how many nothing is proved, how many questions stay without place and proof, and how long
//! they take.

use std::time::Instant;

use stiffarm::place::Placed;

#[path = "../tests/witnesses/questions/mod.rs"]
mod questions;

use questions::random_question;

/// A question that was answered.
struct Answered {
    seed: u64,
    /// Distance of the bound from the value, as part of it; without a place 0 where that is proved, and infinite where not.
    gap: f64,
    has_place: bool,
    seconds: f64,
    boxes: usize,
}

fn answer(seed: u64) -> Answered {
    let question = random_question(seed);
    let start = Instant::now();
    let placed = question.options.place(&question.robot, question.zone).expect("a question that makes sense");
    let seconds = start.elapsed().as_secs_f64();
    let (gap, boxes) = match &placed {
        Placed::Feasible(best) => {
            (1.0 - best.lower_bound / best.deflection, best.space().map_or(0, |hold| hold.resolution.boxes))
        }
        Placed::Infeasible { is_proved: true, .. } => (0.0, 0),
        Placed::Infeasible { .. } => (f64::INFINITY, 0),
    };
    Answered { seed, gap, has_place: placed.feasible().is_some(), seconds, boxes }
}

fn main() {
    let asked = std::env::args().find_map(|word| word.parse::<u64>().ok()).unwrap_or(200);
    let mut answered: Vec<Answered> = (0..asked).map(answer).collect();
    let placed: Vec<&Answered> = answered.iter().filter(|answered| answered.has_place).collect();
    println!("{asked} random questions, {} with a place", placed.len());
    for most in [0.01, 0.05, 0.1] {
        let within = placed.iter().filter(|answered| answered.gap <= most * (1.0 + 1e-9)).count();
        println!(
            "bound within {:>2.0} % of the value: {:5.1} %",
            most * 100.0,
            100.0 * within as f64 / placed.len() as f64
        );
    }
    println!("bound of zero: {}", placed.iter().filter(|answered| 1.0 <= answered.gap).count());
    let open = answered.iter().filter(|answered| answered.gap.is_infinite()).map(|answered| answered.seed);
    println!("neither place nor proof: {:?}", open.collect::<Vec<u64>>());
    answered.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    println!(
        "seconds: median {:.2}, slowest {:.2}, sum {:.1}",
        answered[answered.len() / 2].seconds,
        answered[answered.len() - 1].seconds,
        answered.iter().map(|answered| answered.seconds).sum::<f64>()
    );
    answered.retain(|answered| answered.has_place);
    answered.sort_by(|a, b| b.gap.total_cmp(&a.gap));
    println!("loosest:");
    for Answered { seed, gap, seconds, boxes, .. } in
        answered.iter().take_while(|answered| 0.0101 < answered.gap).take(40)
    {
        println!("  question {seed:3}: {:5.1} %, {boxes} boxes, {seconds:.2} s", gap * 100.0);
    }
}
