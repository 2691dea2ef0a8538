//! Is a place under a force with a known feed the best of all turns of the zone, and is it reported at the turn at which it was computed?

use stiffarm::catalogue::find;
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::model::Model;
use stiffarm::part::Part;
use stiffarm::place::{Orientation, PlaceOptions, Placement, ToolOrientation, Within, deflection_field, place};
use stiffarm::spatial::Pose;
use stiffarm::task::Zone;
use stiffarm::watch::Watch;

const ZONE: Zone = Zone::Rectangle { width: 0.37, height: 0.224 };

/// Along a feed and into the spindle: half a turn of the zone makes it another force.
fn load() -> Load {
    Load::along_tool([-228.0, -134.0, 472.0], Some(93.4_f64.to_radians())).unwrap()
}

fn model() -> Model {
    Model::spatial(&find("KR 210 R2700 extra").unwrap().robot(), &Pose::translation(0.0, 0.0, 0.25)).unwrap()
}

fn asked(orientation: Orientation) -> PlaceOptions {
    let within = Some(Within { x: Interval::spanning(1.0, 2.2), z: Interval::spanning(0.5, 0.9) });
    PlaceOptions {
        orientation,
        within,
        tool_orientation: Some(ToolOrientation::tool_down()),
        ..PlaceOptions::under(load())
    }
}

fn best(orientation: Orientation) -> Placement {
    place(&model(), &ZONE.into(), &asked(orientation), Watch::nobody())
        .unwrap()
        .feasible()
        .expect("there is a place")
        .clone()
}

#[test]
fn under_a_feed_no_turn_of_a_rectangle_is_better_than_is_proved_and_none_by_much_than_is_found() {
    let fixed = |degrees: i32| best(Orientation::Fixed(f64::from(degrees).to_radians())).deflection;
    let [axes, free] = [Orientation::Axes, Orientation::Free].map(best);
    for (found, step) in [(&axes, 90), (&free, 45)] {
        let others: Vec<f64> = (0..360 / step).map(|n| fixed(n * step)).collect();
        let least = others.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(found.lower_bound <= least && found.deflection <= least * 1.001, "{found:?} {others:?}");
        assert!(0.98 * found.deflection < found.lower_bound, "{found:?}");
    }
    assert!(free.lower_bound <= axes.deflection && free.deflection <= axes.deflection * 1.001);
    // It matters: half a turn costs more than what is left open.
    let half = fixed(axes.angle.to_degrees().round() as i32 + 180);
    assert!(1.05 * axes.deflection < half, "{} {half}", axes.deflection);
}

/// The field across the zone at the turn that is reported, and the same place asked for by that turn.
#[test]
fn the_turn_that_is_reported_is_the_one_that_was_computed() {
    for orientation in [Orientation::Axes, Orientation::Free, Orientation::Fixed(-2.0), Orientation::Fixed(4.0)] {
        let found = best(orientation);
        let side = |i: i32| f64::from(i) / 20.0 - 1.0;
        let points = (0..=40).flat_map(|j| (0..=40).map(move |i| ZONE.at([side(i), side(j)])));
        let field = deflection_field(&model(), &asked(orientation), &found, points).unwrap();
        let worst = field.iter().map(|point| point.deflection.unwrap()).fold(0.0, f64::max);
        assert!((worst / found.deflection - 1.0).abs() < 2e-3, "{orientation:?}: {worst} {found:?}");
        assert!((0.0..std::f64::consts::TAU).contains(&found.angle), "{}", found.angle);
        if let Orientation::Fixed(angle) = orientation {
            let turned = (found.angle - angle) / std::f64::consts::TAU;
            assert!((turned - turned.round()).abs() < 1e-12, "{} is not {angle}", found.angle);
        }
    }
}

/// A round face has no sides, but its feed turns with the part: by whichever turn of the part, none lies under the bound.
#[test]
fn the_bound_of_a_round_face_holds_for_every_turn_of_its_part() {
    let part: Part = "part:circle:0.3@0,0,0.1,down".parse().unwrap();
    let placed = |orientation: Orientation| {
        let placed = place(
            &model(),
            &part.clone().into(),
            &PlaceOptions { tool_orientation: None, ..asked(orientation) },
            Watch::nobody(),
        )
        .unwrap();
        placed.feasible().expect("there is a place").clone()
    };
    let fixed: Vec<f64> = (0..8).map(|n| placed(Orientation::Fixed(0.785 * f64::from(n))).deflection).collect();
    let free = placed(Orientation::Free);
    let least = fixed.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(free.lower_bound <= least && free.deflection <= least * 1.01, "{free:?} {fixed:?}");
    let most = fixed.iter().copied().fold(0.0, f64::max);
    assert!(1.02 * least < most, "the turn matters: {fixed:?}");
}
