//! How far and how fast does each joint turn?

use super::ImportOptions;
use super::chain::Chain;
use super::urdf::{Joint, Kind};
use crate::catalogue::reader::{Log, shown};
use crate::interval::Interval;
use crate::limits::{Limits, Pendant, ThirdAxis};

/// Speeds outside, rad/s, are placeholders.
const SPEEDS: std::ops::RangeInclusive<f64> = 0.02..=170.0;

/// Ranges and speeds of the six joints; faults go to the log.
pub(super) fn joint_limits(
    chain: &Chain,
    options: &ImportOptions,
    log: &Log,
    notes: &mut Vec<String>,
) -> Option<Limits> {
    let given = options.limits.map(|ranges| ranges.map(hundredths).to_vec());
    let found = given.or_else(|| {
        let ranges: Vec<_> = chain.joints.iter().map(|joint| joint_range(joint, log, notes)).collect();
        ranges.into_iter().collect()
    })?;
    let joints = found.try_into().ok()?;
    let limited = |joint: &&Joint| joint.kind == Kind::Continuous && joint.limit.lower.or(joint.limit.upper).is_some();
    let names: Vec<_> = chain.joints.iter().filter(limited).map(|joint| shown(&joint.name)).collect();
    if !names.is_empty() && options.limits.is_none() {
        notes.push(format!("continuous joints with limits, which are taken: {}", names.join(", ")));
    }
    let softer: Vec<_> =
        chain.joints.iter().filter(|joint| joint.limit.is_softer()).map(|joint| shown(&joint.name)).collect();
    if !softer.is_empty() && options.limits.is_none() {
        let names = softer.join(", ");
        notes.push(format!(
            "soft limits of safety controllers leave less and are not taken (--limits-deg states them): {names}"
        ));
    }
    let speeds: Vec<f64> = chain.joints.iter().filter_map(|joint| joint.limit.velocity).collect();
    let speeds = speeds.iter().all(|speed| SPEEDS.contains(speed)).then_some(speeds);
    let speeds: Option<[f64; 6]> = speeds.and_then(|speeds| speeds.try_into().ok());
    if speeds.is_none() {
        notes.push("speeds: not every joint has a speed, so none is taken".into());
    }
    let speeds = speeds.map(|speeds| speeds.map(|speed| round(speed.to_degrees(), 1e2).to_radians()));
    // A description counts as its author pleased: what the pendant shows, it does not say.
    Some(Limits { joints, third_axis: ThirdAxis::Elbow, pendant: Pendant::Unknown, elbow: Interval::ALL, speeds })
}

fn joint_range(joint: &Joint, log: &Log, notes: &mut Vec<String>) -> Option<Interval> {
    const WIDEST: f64 = 6.0 * std::f64::consts::PI;
    let fault = |message: String| log.add(joint.place, &format!("{}, limit", joint.key()), message);
    let continuous = joint.kind == Kind::Continuous;
    let (lower, upper) = match (joint.limit.lower, joint.limit.upper) {
        (None, None) if continuous => {
            notes.push(format!("joint {} is continuous: -360 to 360 deg is taken", shown(&joint.name)));
            return Some(Interval::spanning(-2.0 * std::f64::consts::PI, 2.0 * std::f64::consts::PI));
        }
        (None, None) => {
            fault("missing; expected lower and upper in rad".into());
            return None;
        }
        // Zero where only one is given, as URDF has it.
        (lower, upper) => (lower.unwrap_or(0.0), upper.unwrap_or(0.0)),
    };
    if WIDEST + 1e-3 < lower.abs().max(upper.abs()) {
        fault(format!("{lower} to {upper} rad; expected within -6 pi to 6 pi; a URDF is in radians"));
        return None;
    }
    if !(lower < upper) {
        fault(format!("{lower} to {upper} rad; expected the lower end below the upper end"));
        return None;
    }
    Some(hundredths(Interval::spanning(lower, upper)))
}

/// To 0.01 deg: makers state no finer limits, and descriptions round them in radians.
pub(super) fn hundredths(range: Interval) -> Interval {
    let end = |x: f64| round(x.to_degrees(), 1e2).to_radians();
    Interval::spanning(end(range.min()), end(range.max()))
}

/// To steps of which so many make a unit.
pub(super) fn round(x: f64, per_unit: f64) -> f64 {
    (x * per_unit).round() / per_unit
}
