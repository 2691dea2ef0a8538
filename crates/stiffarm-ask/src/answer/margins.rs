//! What does every place keep?

use super::angles::degrees;
use super::{Record, field};
use stiffarm::model::ModelKind;
use stiffarm::place::{Column, MarginOf, Margins, PlaceOptions, Within};
use stiffarm::robot::{Arm, Robot};

/// Where a zone of one robot may stand.
pub(super) fn window(options: &PlaceOptions, model: &ModelKind, robot: &Robot) -> Within {
    let within = options.within(model);
    // Where nothing is left, the answer says what was asked for, and why there is no place.
    options.margins.part_of(within, robot).unwrap_or(within)
}

/// The same as a picture of the plane straight ahead shows it, the column left out; nothing where it may stand anywhere.
pub(super) fn windows(options: &PlaceOptions, model: &ModelKind, robot: &Robot) -> Vec<Within> {
    let aside = match (model, &robot.arm) {
        (ModelKind::Planar, Arm::SixAxis { geometry, .. }) => geometry.b,
        _ => 0.0,
    };
    let mut windows = options.margins.windows(options.within(model), robot, aside);
    windows.retain(|within| *within != Within::ANYWHERE);
    windows
}

/// What a margin is of.
pub(super) fn of(margin: MarginOf) -> String {
    match margin {
        MarginOf::Joint(joint) => format!("joint {joint}"),
        MarginOf::BetweenLinks => "angle between the links".into(),
        MarginOf::Forearm => "forearm".into(),
        MarginOf::Straight => "straight posture".into(),
    }
}

/// The same where there is little room; [`SHORT`] says what it means.
pub(super) fn short(margin: MarginOf) -> String {
    match margin {
        MarginOf::Joint(joint) => format!("J{joint}"),
        MarginOf::BetweenLinks => "links".into(),
        MarginOf::Forearm => "forearm".into(),
        MarginOf::Straight => "straight".into(),
    }
}

/// What a column of margins holds.
pub(super) const SHORT: &str = "margin: the least that is kept from a limit (of joint 2: J2, of the angle between the links: links) or from a straight posture\n";

/// Adds what was asked for.
pub(super) fn put(record: &mut Record, options: &PlaceOptions, robot: &Robot) {
    let Margins { limit, singular, floor, .. } = options.margins;
    let floor = floor.filter(|_| robot.knows_base());
    record
        .put(field::ASKED_LIMIT_MARGIN, limit)
        .put(field::ASKED_SINGULAR_MARGIN, singular)
        .put(field::CLEAR_OF_BASE, robot.knows_base().then(|| options.margins.radius(robot)))
        .put(field::FLOOR_HEIGHT, floor);
}

/// What places keep from joints' limits and straight postures.
pub(super) fn angles(margins: &Margins) -> String {
    let Margins { limit, singular, .. } = *margins;
    match (limit == 0.0, singular == 0.0) {
        (true, true) => "nothing: up to the very limits of the joints, and to straight postures".into(),
        (false, true) => format!("{} from joint limits, nothing from straight postures", degrees(limit)),
        (true, false) => format!("nothing from joint limits, {} from a straight wrist or arm", degrees(singular)),
        (false, false) => {
            let (limit, singular) = (degrees(limit), degrees(singular));
            if limit == singular {
                format!("{limit} from joint limits and from a straight wrist or arm")
            } else {
                format!("{limit} from joint limits, {singular} from a straight wrist or arm")
            }
        }
    }
}

/// What a zone keeps from the joint-1 axis of a robot; `None` where that is nothing, or not known.
pub(super) fn column(margins: &Margins, robot: &Robot) -> Option<String> {
    let radius = margins.radius(robot);
    let why = match margins.column {
        Column::Own if robot.body.is_some() => "the robot's own column, from its file",
        Column::Own => "the robot's own column, estimated from its lengths",
        Column::Radius(_) => "as asked",
    };
    (0.0 < radius).then(|| format!("{radius:.2} m clear of the joint-1 axis ({why})"))
}

/// The same of any robot.
pub(super) fn columns(margins: &Margins) -> Option<String> {
    match margins.column {
        Column::Radius(0.0) => None,
        Column::Radius(radius) => Some(format!("{radius} m clear of the joint-1 axis")),
        Column::Own => Some("clear of each robot's own column (by its file, or estimated from its lengths)".into()),
    }
}

/// What all robots of a ranking keep, in one line.
pub(super) fn of_all(margins: &Margins) -> String {
    if *margins == Margins::NONE {
        return "no margins: joints up to their limits, straight postures allowed".into();
    }
    let column = columns(margins).map_or_else(String::new, |column| format!("; {column}"));
    format!("kept: {}{column}", angles(margins))
}
