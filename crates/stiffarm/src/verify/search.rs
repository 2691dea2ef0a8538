//! Which way of counting joints do readings fit, where that of the robot file does not?

use std::f64::consts::FRAC_PI_2;

use super::Convention;
use super::fit::{Fit, Table};
use crate::geometry::Geometry;
use crate::parallel;
use crate::watch::{Stopped, Watch};

/// rad: a zero that is found so near a quarter turn from the file's is there.
const NEAR: f64 = 0.02;
/// Rows by which it is looked for.
const ROWS: usize = 30;
/// So many are refined after a first glance.
const REFINED: usize = 40;
/// So many of them with their zeros.
const ZEROED: usize = 12;

/// The ways of counting that fit best, in no order; it is looked on until one agrees that the ranges allow.
///
/// # Errors
/// Where nobody waits any longer.
pub(super) fn best(
    table: &Table,
    geometry: &Geometry,
    (file, is_allowed): (&Convention, &dyn Fn(&Convention) -> bool),
    watch: Watch,
) -> Result<Vec<Fit>, Stopped> {
    let is_likely = |fit: &Fit| fit.agrees() && is_allowed(&fit.convention);
    let all = table;
    let table = &all.thinned(ROWS);
    let free = table.free();
    let near = [file.clone(), file.with_third(0.0)];
    // One sign stands for half turns of other joints of the wrist, and is what is wrong rather than those.
    let signs = (0..6).map(|joint| {
        let mut one = file.clone();
        one.sign[joint] = -one.sign[joint];
        one
    });
    let first: Vec<Convention> = near.iter().cloned().chain(signs).collect();
    let mut found = parallel::each(&first, |convention| settled(table, geometry, (convention, file), &free));
    // Ways of counting that the ranges allow come first: those that only a fitted tool makes alike are too many.
    let (allowed, others): (Vec<_>, Vec<_>) = every(file).into_iter().partition(|convention| is_allowed(convention));
    for ways in [allowed, others] {
        if found.iter().any(is_likely) {
            break;
        }
        watch.go_on()?;
        let glances = parallel::each(&ways, |convention| table.glance(geometry, convention));
        let mut glances: Vec<(f64, Convention)> = glances.into_iter().zip(ways).collect();
        watch.go_on()?;
        glances.sort_by(|a, b| a.0.total_cmp(&b.0));
        glances.truncate(REFINED);
        let mut refined = parallel::each(&glances, |(_, convention)| table.fit(geometry, convention, &[]));
        refined.sort_by(|a, b| a.rms.total_cmp(&b.rms));
        watch.go_on()?;
        refined.truncate(ZEROED);
        found.extend(parallel::each(&refined, |fit| settled(table, geometry, (&fit.convention, file), &free)));
    }
    if !found.iter().any(Fit::agrees) {
        let carried = near.iter().flat_map(|convention| {
            let each = carried();
            each.into_iter().map(|carried| Convention { carried, ..convention.clone() })
        });
        let carried: Vec<Convention> = carried.collect();
        watch.go_on()?;
        found.extend(parallel::each(&carried, |convention| settled(table, geometry, (convention, file), &free)));
    }
    if table.len() < all.len() {
        found = found.iter().map(|fit| all.fit(geometry, &fit.convention, &[])).collect();
    }
    Ok(found)
}

/// With its zeros at the file's or a quarter turn from it, but for as few as must stand elsewhere.
fn settled(table: &Table, geometry: &Geometry, (convention, file): (&Convention, &Convention), free: &[usize]) -> Fit {
    let fitted = table.fit(geometry, convention, free);
    let mut rounded = fitted.convention.clone();
    for &i in free {
        let away = rounded.offset[i] - file.offset[i];
        let quarter = (away / FRAC_PI_2).round() * FRAC_PI_2;
        if (away - quarter).abs() < NEAR {
            rounded.offset[i] = file.offset[i] + quarter;
        }
    }
    let held = table.fit(geometry, &rounded, &[]);
    if held.agrees() || !fitted.agrees() {
        return if held.agrees() { held } else { fitted };
    }
    let single = free.iter().map(|&i| vec![i]).collect();
    let pairs = free.iter().enumerate().flat_map(|(at, &i)| free[at + 1..].iter().map(move |&j| vec![i, j])).collect();
    let released = [single, pairs].into_iter().find_map(|few: Vec<Vec<usize>>| {
        let fits = few.iter().map(|few| table.fit(geometry, &rounded, few)).filter(Fit::agrees);
        fits.min_by(|a, b| a.rms.total_cmp(&b.rms))
    });
    released.unwrap_or(fitted)
}

/// Every sign of every joint, both lines of joint 3, and quarter turns of the joints 2, 3 and 5.
fn every(file: &Convention) -> Vec<Convention> {
    let mut all = Vec::new();
    for third in [file.clone(), file.with_third(0.0)] {
        for signs in 0..64_u32 {
            for quarters in 0..64_u32 {
                let mut one = third.clone();
                for i in 0..6 {
                    one.sign[i] *= if signs >> i & 1 == 1 { -1.0 } else { 1.0 };
                }
                for (place, joint) in [1, 2, 4].into_iter().enumerate() {
                    one.offset[joint] += f64::from(quarters >> (2 * place) & 3) * FRAC_PI_2;
                }
                all.push(one);
            }
        }
    }
    all
}

/// Every way in which joints of a wrist carry others along, one turn for one.
fn carried() -> Vec<[f64; 3]> {
    let part = |place: u32, number: u32| f64::from(number / 3_u32.pow(place) % 3) - 1.0;
    let all = (0..27).map(|number| std::array::from_fn(|place| part(place as u32, number)));
    all.filter(|carried| *carried != [0.0; 3]).collect()
}
