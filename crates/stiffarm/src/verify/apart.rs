//! Which ways of counting can readings not tell apart, and which postures would?

use std::f64::consts::PI;

use super::fit::{Fit, Table};
use super::{Convention, VerifyOptions};
use crate::catalogue::readings::{Reading, Readings};
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::limits::Limits;

/// rad: a zero that is off by less is not asked about.
const ZERO: f64 = PI / 180.0;
/// Postures that are reported.
pub(super) const REPORTED: usize = 3;
/// Postures among which they are chosen.
const CANDIDATES: usize = 400;
/// deg: the postures that are reported are easily typed.
const ROUND: f64 = 5.0;
/// Another way of counting is distinguished where it is off by so many times what agrees.
const CLEARLY: f64 = 4.0;

/// What tells nothing of a joint wherever it stands.
const HIDDEN: &str =
    "no posture would: what is read lies on its axis; read the orientation, too, or with a tool off the axis";

/// So many numbers must be read beyond those that base, tool and zeros can fit.
const SPARE: isize = 3;

/// Another way of counting that fits as well.
struct Rival {
    what: String,
    start: Convention,
    free: Vec<usize>,
    fit: Fit,
}

/// What is not distinguished by these readings, in words; and the postures that would tell it, rad, none where no posture can.
pub(super) fn apart(
    table: &Table,
    (geometry, limits): (&Geometry, &Limits),
    fit: &Fit,
) -> (Vec<String>, Vec<[f64; 6]>) {
    let candidates = candidates(limits, geometry, &fit.convention);
    let (mut left, hidden): (Vec<Rival>, Vec<Rival>) = rivals(table, geometry, &candidates, fit)
        .into_iter()
        .partition(|rival| candidates.iter().any(|q| is_seen(fit.apart_from(&rival.fit, geometry, q))));
    let mut what: Vec<String> = left.iter().map(|rival| rival.what.clone()).collect();
    what.extend(hidden.iter().map(|rival| format!("{} ({HIDDEN})", rival.what)));
    if table.spare() < SPARE {
        what.insert(0, format!("much: base, tool and zeros alone can fit {} rows", table.len()));
    }
    let mut postures = Vec::new();
    let mut readings = table.readings.clone();
    let is_short = table.spare() < SPARE;
    while (!left.is_empty() || is_short) && postures.len() < REPORTED {
        let off = |q: &[f64; 6]| {
            let each = left.iter().map(|rival| fit.apart_from(&rival.fit, geometry, q).0.min(0.1));
            each.fold((0.0, f64::INFINITY), |(sum, least): (f64, f64), x| (sum + x, least.min(x)))
        };
        let score = |q: &[f64; 6]| {
            let (sum, least) = off(q);
            least * 10.0 + sum
        };
        let Some(best) = candidates.iter().max_by(|a, b| score(a).total_cmp(&score(b))) else { break };
        postures.push(*best);
        readings.rows.push(read_at(fit, geometry, best, table.readings));
        left = unresolved(left, &readings, table.options, geometry);
    }
    (what, postures)
}

/// What the controller would show there.
fn read_at(fit: &Fit, geometry: &Geometry, q: &[f64; 6], like: &Readings) -> Reading {
    let frame = fit.bases[0] * fit.convention.chain(geometry, &[], &[], q).flange;
    let points = fit.points.iter().map(|point| Some((frame * nalgebra::Point3::from(*point)).coords)).collect();
    let is_oriented = like.rows.iter().any(|row| row.orientation.is_some());
    let orientation = fit.tool.filter(|_| is_oriented).map(|tool| frame.rotation * tool.rotation);
    Reading { line: 0, q: *q, points, orientation, stand: 0 }
}

/// Those that further readings do not tell apart either.
fn unresolved(rivals: Vec<Rival>, readings: &Readings, options: &VerifyOptions, geometry: &Geometry) -> Vec<Rival> {
    let table = Table::of(readings, options);
    let refitted = rivals.into_iter().map(|rival| {
        let fit = table.fit(geometry, &rival.start, &rival.free);
        Rival { fit, ..rival }
    });
    refitted.filter(|rival| !rival.fit.is_clearly_off()).collect()
}

impl Fit {
    fn is_clearly_off(&self) -> bool {
        is_seen((self.largest, self.largest_turn.unwrap_or(0.0)))
    }
}

/// Clearly more than what agrees.
fn is_seen((distance, turn): (f64, f64)) -> bool {
    CLEARLY * super::fit::AGREED < distance || CLEARLY * super::fit::AGREED_TURN < turn
}

fn rivals(table: &Table, geometry: &Geometry, candidates: &[[f64; 6]], fit: &Fit) -> Vec<Rival> {
    let free = table.free();
    let mean = |i: usize| table.sights.iter().map(|sight| sight.q[i]).sum::<f64>() / table.sights.len() as f64;
    let own = &fit.convention;
    let mut tried: Vec<(String, Convention, Vec<usize>)> = Vec::new();
    for i in 0..6 {
        tried.push((format!("the sign of joint {}", i + 1), own.flipped(i, mean(i)), free.clone()));
    }
    let theta_2 = own.sign[1] * mean(1) - own.offset[1];
    tried.push((
        "whether joint 3 counts from the upper arm or the horizontal".into(),
        own.with_third(theta_2),
        free.clone(),
    ));
    for &i in &free {
        let others = free.iter().copied().filter(|&other| other != i).collect();
        tried.push((format!("the zero of joint {}", i + 1), own.added(&[i], &[ZERO]), others));
    }
    let found = tried.into_iter().map(|(what, start, free)| {
        let fit = table.fit(geometry, &start, &free);
        Rival { what, start, free, fit }
    });
    // Flanges that at all joint angles are the same shift and turn apart, which a tool takes up, are one way of counting, said twice.
    let is_other = |rival: &Rival| {
        let between = |q: &[f64; 6]| fit.flange(geometry, q).inverse() * rival.fit.flange(geometry, q);
        let probes = &candidates[..candidates.len().min(20)];
        // Of one posture nothing is known.
        probes.len() < 2
            || probes.windows(2).any(|pair| {
                let changed = between(&pair[0]).inverse() * between(&pair[1]);
                1e-4 < changed.translation.vector.norm() || 1e-4 < changed.rotation.angle()
            })
    };
    let fits_as_well = |rival: &Rival| {
        if table.readings.is_measured {
            // What is off anyway does not tell them apart.
            return rival.fit.rms <= 1.2 * fit.rms + super::fit::AGREED;
        }
        !rival.fit.is_clearly_off()
    };
    found.filter(|rival| fits_as_well(rival) && is_other(rival)).collect()
}

/// Postures within the limits that can be driven to: away from their ends, and the wrist not straight; rad, in round degrees.
fn candidates(limits: &Limits, geometry: &Geometry, convention: &Convention) -> Vec<[f64; 6]> {
    let mut rng = fastrand::Rng::with_seed(38);
    let mut found = Vec::new();
    for _ in 0..20 * CANDIDATES {
        let q: [f64; 6] = std::array::from_fn(|i| {
            let range = limits.joints[i].or_one_turn();
            // Cables wind about joints that turn by more than half a turn to a side.
            let [low, high] = [range.min().max(-0.9 * PI), range.max().min(0.9 * PI)];
            let [low, high] = [low + 0.15 * (high - low), high - 0.15 * (high - low)];
            let degrees = (low + rng.f64() * (high - low)).to_degrees();
            ((degrees / ROUND).round() * ROUND).to_radians()
        });
        let theta = geometry.model_angles(&q, limits.third_axis);
        let elbow = Interval::point(PI - theta[2]);
        let wrist = convention.chain(geometry, &[], &[], &q).flange;
        let above = 0.2 < wrist.translation.z;
        if above && 0.25 < theta[4].sin().abs() && limits.elbow.contains(elbow.middle(), 0.0) {
            found.push(q);
        }
        if found.len() == CANDIDATES {
            break;
        }
    }
    found
}
