//! Rolls that are pinned at places of a path.

use std::f64::consts::TAU;

use super::*;

/// How far two rolls are apart, whole turns aside, rad.
fn apart(a: f64, b: f64) -> f64 {
    let turn = a - b;
    (turn - TAU * (turn / TAU).round()).abs()
}

fn pinned(text: &str, pins: &[[f64; 2]]) -> Vec<Station> {
    let mut stations = path(text, KNOWN);
    pin(&mut stations, pins).unwrap();
    stations
}

/// The rolls go through the pins, joints follow one another, nothing is better than without pins, and no roll through a pin is better than
/// that posture alone, found one after the other.
#[test]
fn rolls_go_through_their_pins_and_no_better_ones_do() {
    let (robot, stand, options) = (robot(), stand(), with(RollMode::Free));
    let free = followed(&stand, &path("circle:0.3", KNOWN), &options);
    let rolls = [0.31, 0.123, -0.2].map(|aside| free.samples[0].arrangement.roll + aside);
    let stations = pinned("circle:0.3", &[[0.0, rolls[0]], [0.4, rolls[1]], [0.7, rolls[2]]]);
    let found = followed(&stand, &stations, &options);
    let mut floor = 0.0_f64;
    for (station, pushed) in stations.iter().zip(&found.samples) {
        let Some(roll) = station.pinned else { continue };
        assert!(apart(pushed.arrangement.roll, roll) < 1e-12);
        let errors = errors_at(&robot, &stand, station, roll);
        floor = floor.max(errors.into_iter().fold(f64::INFINITY, f64::min));
    }
    let ways: Vec<f64> = stations.iter().filter(|one| one.pinned.is_some()).map(|one| one.sample.way).collect();
    assert!(ways.len() == 3 && ways.iter().zip([0.0, 0.4, 0.7]).all(|(way, asked)| (way - asked).abs() < 0.006));
    assert!(floor * (1.0 - 1e-5) <= found.lower_bound && found.lower_bound <= found.worst.0);
    assert!(free.lower_bound * (1.0 - 1e-3) <= found.lower_bound && free.worst.0 * 0.98 <= found.worst.0);
    for pair in found.samples.windows(2) {
        assert!((0..6).all(|i| (pair[1].joints[i] - pair[0].joints[i]).abs() < 0.5));
    }
}

/// Where every sample is pinned to one roll, nothing is left to choose but the configuration: as at that fixed roll.
#[test]
fn a_path_that_is_pinned_all_along_is_that_of_a_fixed_roll() {
    let stand = stand();
    let best = followed(&stand, &path("line:0.1", KNOWN), &with(RollMode::Constant));
    let roll = best.samples[0].arrangement.roll;
    let fixed = followed(&stand, &path("line:0.1", KNOWN), &with(RollMode::Fixed(roll)));
    let mut stations = path("line:0.1", KNOWN);
    for station in &mut stations {
        station.pinned = Some(roll);
    }
    let found = followed(&stand, &stations, &with(RollMode::Free));
    assert!((found.worst.0 / fixed.worst.0 - 1.0).abs() < 1e-12);
    // Also where nothing better is known, which would hide a bound that is too high.
    let options = with(RollMode::Free);
    let (robot, grid) = (robot(), RollGrid::turn(180));
    let arm = arm_with_margins(&robot, &stand, &options).unwrap();
    let question = Question { robot: &robot, arm: &arm, stations: &stations, options: &options };
    let ladder = Ladder::new(&arm, &stations, stand, (ErrorPart::Total, grid), 0.8, Watch::nobody()).unwrap();
    let bound = Floor::new(&question, &stand).lower_bound(&ladder, 1.0).unwrap();
    assert!(bound <= found.worst.0 * (1.0 + 1e-9) && (1.0 - 2e-6) * found.worst.0 < bound, "{bound} {:?}", found.worst);
}

#[test]
fn a_pin_that_nothing_holds_is_reported_as_such_and_odd_pins_are_refused() {
    let (robot, stand) = (robot(), stand());
    let stations = path("circle:0.3", KNOWN);
    let is_held = |roll: &f64| errors_at(&robot, &stand, &stations[0], *roll).iter().any(|error| error.is_finite());
    let never = (0..360).map(|degree| f64::from(degree).to_radians()).find(|roll| !is_held(roll)).unwrap();
    let answer = mill(&robot, &stand, &pinned("circle:0.3", &[[0.0, never]]), &with(RollMode::Free), Watch::nobody());
    let Ok(Milled::Blocked(blocked)) = answer else { panic!("{answer:?}") };
    assert_eq!((blocked.why, blocked.way), (Why::Pinned, 0.0));
    assert!(blocked.to_string().contains("pinned"));

    let mut twice = stations.clone();
    assert_eq!(pin(&mut twice, &[[0.1, 0.0], [0.1001, 0.5]]), Err(MillError::PinnedTwice { way: 0.1001 }));
    let beyond = pin(&mut stations.clone(), &[[1.0, 0.0]]);
    assert!(
        matches!(beyond, Err(MillError::PinnedBeyond { way: 1.0, length }) if (length - 0.3 * TAU / 2.0).abs() < 1e-3)
    );
    for roll in [RollMode::Constant, RollMode::Linear, RollMode::Fixed(0.1)] {
        let answer = mill(&robot, &stand, &twice, &with(roll), Watch::nobody());
        assert_eq!(answer, Err(MillError::PinnedElse));
    }
    let (options, margins) = (with(RollMode::Free), Margins::usual());
    let within = Within { x: Interval::spanning(1.5, 1.8), z: Interval::spanning(0.5, 0.8) };
    let ground = PathGround { margins, within: Some(within), cell: None };
    let placed = place_path(&robot, &stand.flange_from_tool, &twice, (&options, &ground), Watch::nobody());
    assert_eq!(placed.unwrap_err(), MillError::PinnedElse);
}
