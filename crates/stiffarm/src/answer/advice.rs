//! How is told what is missing where a tolerance is not kept, and what is left where it is?

use serde_json::json;

use super::words::{fixed, percentages};
use super::{Datum, Line, Record, field, line};
use crate::advice::{Advice, AtPlace, COMPENSATED, LargestZone, SMALLEST};
use crate::load::Load;
use crate::task::Task;

/// What was asked when advice was sought.
pub(super) type Asked<'a> = (&'a Task, Load);

/// Every field; the same whatever was found.
pub(super) fn record(advice: &Advice, (task, load): Asked) -> Record {
    let at = advice.at_place.as_ref();
    let factor = |of: fn(&AtPlace) -> Option<f64>| at.and_then(of);
    let softest = at.and_then(AtPlace::softest);
    let compensated = at.map(|at| at.compensated);
    let mut record = Record::new();
    record
        .put(field::FORCE_FACTOR, factor(|at| at.force_factor))
        .put(field::FORCE_FACTOR_BOUND, factor(|at| at.force_factor_bound))
        .put(field::LARGEST_FORCE, factor(|at| at.force_factor).map(|factor| factor * load.newtons()))
        .put(field::STIFFNESS_FACTOR, at.map(|at| at.stiffness_factor))
        .put(field::STIFFNESS_NEEDED, at.map_or(Datum::Absent, |at| Datum::Numbers(at.needed.to_vec())))
        .put(field::DRIVE_SHARES, at.map_or(Datum::Absent, |at| Datum::Numbers(at.shares.to_vec())))
        .put(field::SOFTEST_DRIVE, softest.map(|(drive, _)| drive))
        .put(field::SOFTEST_SHARE, softest.map(|(_, share)| share))
        .put(field::COMPENSATION, at.map(|_| COMPENSATED))
        .put(field::COMPENSATED, compensated)
        .put(field::COMPENSATED_PASS, compensated.map(|left| left <= advice.tolerance))
        .put(field::LARGEST_ZONE, advice.zone.as_ref().map(|zone| zone_record(zone, task)));
    record
}

fn zone_record(zone: &LargestZone, task: &Task) -> Record {
    let mut record = Record::new();
    record
        .put(field::SCALE, zone.holds.map(|(scale, _)| scale))
        .put(field::SIZE_IN_WORDS, zone.holds.map(|(scale, _)| task.scaled(scale).describe()))
        .put(field::SIDES, zone.holds.map_or(Datum::Absent, |(scale, _)| Datum::Nested(sides(task, scale))))
        .put(field::DEFLECTION, zone.holds.map(|(_, deflection)| deflection))
        .put(field::FAILS_AT, zone.fails_at)
        .put(field::FAILS_PROVED, zone.is_proved)
        .put(field::TRIED, zone.tried);
    record
}

/// Of a flat zone its sides, m; null of a part.
fn sides(task: &Task, scale: f64) -> serde_json::Value {
    if task.part.is_some() { serde_json::Value::Null } else { json!(task.zone.scaled(scale).sides()) }
}

/// For people, behind the verdict: the reserve where the tolerance is kept, else everything that would help.
pub(super) fn lines(advice: &Advice, (task, load): Asked) -> Vec<Line> {
    let mut lines = Vec::new();
    let passes = advice.zone.is_none();
    if let Some(at) = &advice.at_place {
        let name = if passes { "reserve" } else { "largest force" };
        lines.extend(at.force_factor.map(|factor| line(name, force(at, factor, load))));
        if !passes {
            lines.push(line("stiffness needed", stiffness(at)));
        }
    }
    lines.extend(advice.zone.as_ref().map(|zone| line("largest zone of this shape", largest(zone, task))));
    if let Some(at) = advice.at_place.as_ref().filter(|_| !passes) {
        lines.extend(at.softest().map(|(drive, share)| {
            line(
                "softest drive",
                format!("drive {drive}: {} of the deflection at the worst point", percentages(&[share])),
            )
        }));
        lines.push(line("if compensation takes out 80 %", compensated(at, advice.tolerance)));
    }
    lines
}

/// Of one robot of a ranking, in a sentence.
pub(super) fn sentence(advice: &Advice, (task, load): Asked) -> String {
    let Some(at) = &advice.at_place else {
        let zone = advice.zone.as_ref().map_or_else(String::new, |zone| largest(zone, task));
        return format!("no place; largest zone of this shape that passes: {zone}");
    };
    let Some(factor) = at.force_factor else { return "nothing gives way".into() };
    let newtons = significant(factor * load.newtons());
    let Some(zone) = &advice.zone else {
        return format!("a reserve of {} times the force ({newtons} N)", significant(factor));
    };
    let size = match zone.holds {
        Some((scale, _)) => {
            format!("a zone of {} of the size ({})", fixed(scale, 3), task.scaled(scale).describe())
        }
        None => "no zone of this shape".into(),
    };
    let softest = at
        .softest()
        .map_or_else(String::new, |(drive, share)| format!("; drive {drive} gives {}", percentages(&[share])));
    format!(
        "it is kept up to {newtons} N ({} of the force), with drives {} times as stiff, or by {size}{softest}; if compensation takes out 80 %, \
         which is assumed, {} mm are left",
        significant(factor),
        significant(at.stiffness_factor),
        fixed(at.compensated * 1e3, 3),
    )
}

fn force(at: &AtPlace, factor: f64, load: Load) -> String {
    let newtons = |factor: f64| significant(factor * load.newtons());
    let bound = at.force_factor_bound.filter(|bound| 1e-3 < bound / factor - 1.0);
    let bound =
        bound.map_or_else(String::new, |bound| format!("; no place keeps it under more than {} N", newtons(bound)));
    let times = significant(factor);
    format!("{} N, {times} of the force (deflection grows with it in proportion){bound}", newtons(factor))
}

fn stiffness(at: &AtPlace) -> String {
    let known: Vec<f64> = at.needed.iter().flatten().map(|k| k / 1e6).collect();
    let absolute = match known.split_first() {
        Some((first, others)) if others.iter().all(|other| (other / first - 1.0).abs() < 1e-12) => {
            format!(": {} MN m/rad each", significant(*first))
        }
        _ => String::new(),
    };
    format!("{} times that of every drive{absolute}", significant(at.stiffness_factor))
}

fn largest(zone: &LargestZone, task: &Task) -> String {
    let at = fixed(zone.fails_at, 4);
    let fails = if zone.is_proved { "none passes, which is proved" } else { "none was found to pass" };
    match zone.holds {
        Some((scale, _)) => {
            format!("{} of the size ({}); at {at} {fails}", fixed(scale, 4), task.scaled(scale).describe())
        }
        None => format!("none: even at {at} of the size {fails} ({SMALLEST} is the smallest that is tried)"),
    }
}

fn compensated(at: &AtPlace, tolerance: f64) -> String {
    let verdict = if at.compensated <= tolerance { "pass" } else { "fail" };
    format!("{} mm are left, {verdict}; how much it takes out is assumed", fixed(at.compensated * 1e3, 4))
}

/// Three digits.
fn significant(x: f64) -> String {
    let digits = if 0.0 < x && x.is_finite() { (2 - x.log10().floor() as i32).clamp(0, 9) } else { 0 };
    fixed(x, digits as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_told_with_three_digits() {
        let told = [0.049_25, 0.4925, 4.925, 49.25, 492.5, 4925.0, 0.0].map(significant);
        assert_eq!(told, ["0.0493", "0.492", "4.92", "49.2", "492", "4925", "0"].map(String::from));
    }
}
