//! Which tables of measurements make no sense as a whole, though each of their numbers may?

use std::collections::HashMap;
use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::super::Fault;
use super::columns::Angles;
use super::rows::Units;
use super::{Measurements, Reading};

/// How far robots give way per force, um/N: the heaviest some tenths, the smallest arms some tens. Beyond, a unit is wrong; as the ends
/// are more than a thousand apart, nothing that is common is taken for something else.
const COMPLIANCES: [f64; 2] = [0.1, 300.0];
/// Faults of the table as a whole.
pub(super) fn check(measurements: &Measurements, units: &Units, faults: &mut Vec<Fault>) {
    let readings = &measurements.readings;
    let line = |reading: &Reading| units.lines[reading.row - 1];
    let whole =
        |message: String| Fault { line: units.lines.first().copied().unwrap_or(1), key: String::new(), message };
    if readings.is_empty() {
        faults.push(whole("no row holds a measurement".into()));
        return;
    }
    if let Some(fault) = angles(readings, units) {
        faults.push(fault);
    }
    if let Some(message) = compliances(readings, units) {
        faults.push(whole(message));
    }
    let mut known: HashMap<Vec<u64>, &Reading> = HashMap::new();
    for reading in readings {
        if let Some(first) = known.insert(bits(reading), reading) {
            let key = format!("row {}", reading.row);
            let message = format!(
                "repeats row {} in every number; a measurement that is made twice differs by its noise",
                first.row
            );
            faults.push(Fault { line: line(reading), key, message });
        }
    }
    faults.extend(elsewhere(readings).map(|(reading, first, far)| Fault {
        line: line(reading),
        key: format!("row {}, posture", reading.row),
        message: format!(
            "is that of row {}, and its joints are up to {:.1} deg apart from those; expected rows of one posture, or another name",
            first.row,
            far.to_degrees()
        ),
    }));
    let last = readings.last().map_or(0, |reading| reading.posture);
    if readings.iter().all(|reading| reading.posture == readings[0].posture) && last == 0 {
        let rows = readings.len();
        faults.push(whole(format!(
            "{rows} rows, all of one posture; drives are distinguished by postures that differ, expected at least two and better twenty"
        )));
    } else if readings.iter().all(|reading| reading.q == readings[0].q) {
        faults.push(whole(
            "q1 to q6 are the same in every row, whatever the column posture says; expected postures that differ"
                .into(),
        ));
    }
}

/// A reading, the first one of its posture, and how far their joints are apart, rad, where that is no one posture.
fn elsewhere(readings: &[Reading]) -> impl Iterator<Item = (&Reading, &Reading, f64)> {
    /// rad: what a controller that is sent to a posture again may be off, and much more.
    const APART: f64 = 0.02;
    let mut first: HashMap<usize, &Reading> = HashMap::new();
    readings.iter().filter_map(move |reading| {
        let first = *first.entry(reading.posture).or_insert(reading);
        let far = reading.q.iter().zip(first.q).map(|(here, there)| (here - there).abs()).fold(0.0, f64::max);
        (APART < far).then_some((reading, first, far))
    })
}

/// Radians under `deg`. (Degrees under `rad` are beyond what a joint turns.)
fn angles(readings: &[Reading], units: &Units) -> Option<Fault> {
    let most = readings.iter().flat_map(|reading| reading.q.map(|angle| angle.to_degrees().abs())).fold(0.0, f64::max);
    let is_suspect = units.angles == Angles::Degrees && 0.0 < most && most <= TAU;
    is_suspect.then(|| Fault {
        line: units.lines.first().copied().unwrap_or(1),
        key: "q1_deg to q6_deg".into(),
        message: format!(
            "no angle of any row is beyond {most:.3} deg: are these radians? then name the columns q1_rad to q6_rad"
        ),
    })
}

/// Displacements per force that no robot has.
fn compliances(readings: &[Reading], units: &Units) -> Option<String> {
    let force = |reading: &Reading| Vector3::from(reading.load.0.fixed_rows::<3>(0)).norm();
    let mut ratios: Vec<f64> = (readings.iter())
        .filter(|reading| 0.0 < force(reading))
        .map(|reading| 1e6 * reading.moved.norm() / force(reading))
        .collect();
    ratios.sort_by(f64::total_cmp);
    let median = *ratios.get(ratios.len() / 2)?;
    let [least, most] = COMPLIANCES;
    let unit = units.length;
    let others: Vec<String> =
        ["um", "mm", "m"].into_iter().filter(|other| *other != unit).map(|other| format!("dx_{other}")).collect();
    let ask = format!(
        "is the displacement in {unit}, as dx_{unit} says? if not, name the columns {}; or is the force not in N?",
        others.join(" or ")
    );
    let message = |what: &str| {
        format!("half of the rows move {what} than {median:.3e} um per N, and robots move {least} to {most}: {ask}")
    };
    if median == 0.0 {
        return Some("half of the rows and more have displacements of 0; were they measured?".into());
    }
    match median {
        median if median < least => Some(message("less")),
        median if most < median => Some(message("more")),
        _ => None,
    }
}

/// Everything that a row says.
fn bits(reading: &Reading) -> Vec<u64> {
    let Reading { q, load, load_at, marker_at, moved, .. } = reading;
    let numbers = q.iter().chain(load.0.iter()).chain(load_at.iter()).chain(marker_at.iter()).chain(moved.iter());
    numbers.map(|number| (number + 0.0).to_bits()).collect()
}
