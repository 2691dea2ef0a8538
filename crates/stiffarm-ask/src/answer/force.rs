//! How is a force reported?

use super::angles::asked_degrees;
use super::numbers::digits;
use super::{Record, field};
use stiffarm::load::{Component, Direction, Load};

/// Every field of a load.
pub(super) fn put(record: &mut Record, load: Load) {
    record.put(field::FORCE, load.newtons());
    put_direction(record, Some(load));
}

/// The fields that say which way a load points, and what counts.
pub(super) fn put_direction(record: &mut Record, load: Option<Load>) {
    let unit = |load: Load, force: [f64; 3]| Some(force.map(|part| part / load.newtons()));
    let (axes, along, feed) = match load.map(|load| (load, load.direction())) {
        None | Some((_, Direction::Worst)) => (None, None, None),
        Some((_, Direction::InPlane(angle))) => (Some("base"), Some([angle.cos(), 0.0, angle.sin()]), None),
        Some((load, Direction::Base(force))) => (Some("base"), unit(load, force), None),
        Some((load, Direction::Tool { force, feed })) => (Some("tool"), unit(load, force), feed),
    };
    record
        .put(field::FORCE_AXES, axes)
        .put(field::FORCE_DIRECTION, along)
        .put(field::FORCE_CONE, axes.and(load).map(|load| asked_degrees(load.cone())))
        .put(field::FEED, feed.map(asked_degrees))
        .put(field::COMPONENT, load.map(|load| load.component().name()));
}

/// A force and its direction.
pub fn force(load: Load) -> String {
    let newtons = load.newtons();
    let along = |force: [f64; 3], names: [&str; 3]| {
        let parts = force.iter().zip(names).filter(|(part, _)| **part != 0.0);
        parts.map(|(part, name)| format!("{} N {name}", digits(*part, 6))).collect::<Vec<_>>().join(", ")
    };
    let cone = if load.cone() == 0.0 {
        String::new()
    } else {
        format!(", or within {} deg of that", asked_degrees(load.cone()))
    };
    match load.direction() {
        Direction::Worst => format!("{newtons} N in its worst direction"),
        Direction::InPlane(angle) => format!("{newtons} N at {:.0} deg{cone}", angle.to_degrees()),
        Direction::Base(force) => format!("{}{cone}", along(force, ["ahead", "to the left", "up"])),
        Direction::Tool { force, feed } => {
            let feed = match feed {
                // Nothing but the angle to the tool axis matters of an axial force.
                _ if force[..2] == [0.0; 2] => String::new(),
                None => "; feed any way".into(),
                Some(angle) => format!("; feed at {} deg from the first side", asked_degrees(angle)),
            };
            format!("{}{cone}{feed}", along(force, ["along the feed", "across", "axial"]))
        }
    }
}

/// A force as it stands in a sentence, with what of the displacement counts.
pub fn acting(load: Load) -> String {
    if load.is_worst() {
        return format!("{} N in the worst direction", load.newtons());
    }
    let counts = match component(load) {
        "" => String::new(),
        part => format!("; the deflection {part} counts"),
    };
    format!("{}{counts}", force(load))
}

/// The same without a word about the worst direction, for a title.
pub fn loaded(load: Load) -> String {
    if load.is_worst() { format!("{} N", load.newtons()) } else { acting(load) }
}

/// What of the displacement counts, where it is not all of it.
pub fn component(load: Load) -> &'static str {
    match load.component() {
        Component::Normal => "normal to the face",
        Component::Along if !load.is_worst() => "along the force",
        Component::Along | Component::Total => "",
    }
}

/// What a map or a placement shows.
pub fn mapped(load: Load) -> String {
    if load.is_worst() {
        return format!("worst deflection under {} N", load.newtons());
    }
    let apart = if component(load).is_empty() { "" } else { " " };
    format!("deflection{apart}{} under {}", component(load), force(load))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_is_worded_as_a_machinist_gives_it() {
        let in_words = |load: Result<Load, _>| force(load.unwrap());
        assert_eq!(in_words(Load::worst(400.0)), "400 N in its worst direction");
        let milling = Load::along_tool([300.0, 100.0, 50.0], None);
        assert_eq!(in_words(milling.clone()), "300 N along the feed, 100 N across, 50 N axial; feed any way");
        let fed = Load::along_tool([300.0, 0.0, 0.0], Some(30_f64.to_radians()));
        assert_eq!(in_words(fed), "300 N along the feed; feed at 30 deg from the first side");
        let drilling = Load::along_tool([0.0, 0.0, 800.0], None).unwrap().with_cone(10_f64.to_radians());
        assert_eq!(in_words(drilling), "800 N axial, or within 10 deg of that");
        assert_eq!(in_words(Load::along_base([100.0, 0.0, -50.0])), "100 N ahead, -50 N up");
        assert_eq!(
            mapped(milling.unwrap().counting(Component::Normal)),
            "deflection normal to the face under 300 N along the feed, 100 N across, 50 N axial; feed any way"
        );
    }
}
