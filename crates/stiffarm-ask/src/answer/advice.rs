//! What is missing where a tolerance is not kept, and what is left where it is?

use serde_json::json;

use super::words::{fixed, percentages};
use super::{Datum, Line, Record, field, line, shape};
use stiffarm::advice::{Advice, AtPlace, COMPENSATED, LargestZone, SMALLEST};
use stiffarm::load::Load;
use stiffarm::task::Task;

/// What was asked where advice is given.
pub(super) type Asked<'a> = (&'a Task, Load);

/// Every field; the same whatever was found.
pub(super) fn record(advice: &Advice, (task, load): Asked) -> Record {
    let at = advice.at_place.as_ref();
    let factor = |of: fn(&AtPlace) -> Option<f64>| at.and_then(of);
    let softest = at.and_then(AtPlace::softest);
    let compensated = at.map(|at| at.compensated);
    let mut record = Record::of(&shape::ADVICE);
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
    let mut record = Record::of(&shape::LARGEST_ZONE);
    record
        .put(field::SCALE, zone.holds.map(|(scale, _)| scale))
        .put(field::SIZE_IN_WORDS, zone.holds.map(|(scale, _)| task.work.scaled(scale).describe()))
        .put(field::SIDES, zone.holds.and_then(|(scale, _)| sides(task, scale)))
        .put(field::DEFLECTION, zone.holds.map(|(_, deflection)| deflection))
        .put(field::FAILS_AT, zone.fails_at)
        .put(field::FAILS_PROVED, zone.is_proved)
        .put(field::TRIED, zone.tried);
    record
}

/// Of a flat zone its sides, m; null of a part.
fn sides(task: &Task, scale: f64) -> Option<serde_json::Value> {
    Some(json!(task.work.zone()?.scaled(scale).sides()))
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
    let newtons = down(factor * load.newtons());
    let Some(zone) = &advice.zone else {
        return format!("a reserve of {} times the force ({newtons} N)", down(factor));
    };
    let size = match zone.holds {
        Some((scale, _)) => {
            format!(" or by a zone of {} of the size ({})", down(scale), task.work.scaled(scale).describe())
        }
        None => format!(" and by no zone of this shape down to {} of its size", percentages(&[SMALLEST])),
    };
    let softest = at
        .softest()
        .map_or_else(String::new, |(drive, share)| format!("; drive {drive} gives {}", percentages(&[share])));
    format!(
        "it is kept up to {newtons} N ({} of the force), with drives {} times as stiff,{size}{softest}; if compensation takes out 80 %, \
         which is assumed, {} mm are left",
        down(factor),
        up(at.stiffness_factor),
        fixed(at.compensated * 1e3, 3),
    )
}

fn force(at: &AtPlace, factor: f64, load: Load) -> String {
    let newtons = |factor: f64| down(factor * load.newtons());
    let bound = at.force_factor_bound.filter(|bound| 1e-3 < bound / factor - 1.0);
    let bound = bound.map_or_else(String::new, |bound| {
        format!("; no place keeps it under more than {} N", up(bound * load.newtons()))
    });
    let times = down(factor);
    format!("{} N, {times} of the force (deflection grows with it in proportion){bound}", newtons(factor))
}

fn stiffness(at: &AtPlace) -> String {
    let known: Vec<f64> = at.needed.iter().flatten().map(|k| k / 1e6).collect();
    let absolute = match known.split_first() {
        Some((first, others)) if others.iter().all(|other| (other / first - 1.0).abs() < 1e-12) => {
            format!(": {} MN m/rad each", up(*first))
        }
        _ => String::new(),
    };
    format!("{} times that of every drive{absolute}", up(at.stiffness_factor))
}

fn largest(zone: &LargestZone, task: &Task) -> String {
    let at = up(zone.fails_at);
    let fails = if zone.is_proved { "none passes, which is proved" } else { "none was found to pass" };
    match zone.holds {
        Some((scale, _)) => {
            format!("{} of the size ({}); at {at} {fails}", down(scale), task.work.scaled(scale).describe())
        }
        None => format!("none: even at {at} of the size {fails} ({SMALLEST} is the smallest that is tried)"),
    }
}

fn compensated(at: &AtPlace, tolerance: f64) -> String {
    let verdict = if at.compensated <= tolerance { "pass" } else { "fail" };
    format!("{} mm are left, {verdict}; how much it takes out is assumed", fixed(at.compensated * 1e3, 4))
}

/// Four digits of what holds, which a little more need not: never more than it is.
fn down(x: f64) -> String {
    four_digits(x, |scaled| (scaled * (1.0 + 1e-12)).floor())
}

/// Four digits of what is needed, of which a little less may not do: never less than it is.
fn up(x: f64) -> String {
    four_digits(x, |scaled| (scaled * (1.0 - 1e-12)).ceil())
}

fn four_digits(x: f64, round: impl Fn(f64) -> f64) -> String {
    let digits = if 0.0 < x && x.is_finite() { (3 - x.log10().floor() as i32).clamp(0, 9) } else { 0 };
    let scale = 10_f64.powi(digits);
    fixed(round(x * scale) / scale, digits as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_holds_is_rounded_down_and_what_is_needed_up() {
        let x = [0.049_256_6, 0.492_566, 4.925_66, 49.2566, 4925.66, 1.0, 0.0];
        assert_eq!(x.map(down), ["0.04925", "0.4925", "4.925", "49.25", "4925", "1.000", "0"].map(String::from));
        assert_eq!(x.map(up), ["0.04926", "0.4926", "4.926", "49.26", "4926", "1.000", "0"].map(String::from));
    }
}
