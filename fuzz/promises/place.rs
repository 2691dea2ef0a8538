//! Does every arm, zone and question get an answer that keeps its certificate, or an error, and never a panic?

use std::f64::consts::PI;

use arbitrary::{Result, Unstructured};
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::model::Model;
use stiffarm::place::{Hold, Orientation, PlaceOptions, Placed, Within, place};
use stiffarm::plane::PlanarArm;
use stiffarm::task::Zone;
use stiffarm::watch::Watch;

/// A number from `min` to `max`; one time in sixteen any 64 bits, NaN and infinity among them.
fn number(u: &mut Unstructured, min: f64, max: f64) -> Result<f64> {
    if u.ratio(1, 16)? {
        return u.arbitrary();
    }
    Ok(min + (max - min) * f64::from(u.arbitrary::<u16>()?) / f64::from(u16::MAX))
}

/// No limit, or one about `centre`, open at either end at times; what is no range counts as no limit.
fn range(u: &mut Unstructured, centre: f64, spread: f64) -> Result<Interval> {
    let (open_below, open_above) = (u.ratio(1, 3)?, u.ratio(1, 3)?);
    let min = number(u, centre - spread, centre + spread)?;
    let max = min + number(u, 0.0, 2.0 * spread)?;
    let min = if open_below { f64::NEG_INFINITY } else { min };
    let max = if open_above { f64::INFINITY } else { max };
    Ok(Interval::new(min, max).unwrap_or(Interval::ALL))
}

fn arm(u: &mut Unstructured) -> Result<PlanarArm> {
    Ok(PlanarArm {
        l2: number(u, 0.3, 2.0)?,
        l3: number(u, 0.3, 2.0)?,
        k2: number(u, 1e-7, 1e-5)?,
        k3: number(u, 1e-7, 1e-5)?,
        architecture: *u.choose(&Architecture::ALL)?,
        shoulder: range(u, 1.0, PI)?,
        elbow: range(u, -1.0, PI)?,
        forearm: range(u, 0.0, PI)?,
    })
}

fn zone(u: &mut Unstructured) -> Result<Zone> {
    let width = number(u, 1e-3, 2.0)?;
    Ok(if u.arbitrary()? {
        Zone::Circle { diameter: width }
    } else {
        Zone::Rectangle { width, height: number(u, 1e-3, 2.0)? }
    })
}

fn options(u: &mut Unstructured) -> Result<PlaceOptions> {
    let orientation = match u.int_in_range(0..=3)? {
        0 => Orientation::Free,
        1 => Orientation::Fixed(number(u, -PI, PI)?),
        _ => Orientation::Axes,
    };
    let within = Within { x: range(u, 0.5, 2.0)?, z: range(u, 0.0, 2.0)? };
    // The gap is coarse so that a run sees many questions; the tests ask the fine ones.
    let load = Load::worst(number(u, 1.0, 1e4)?).unwrap_or(Load::PAPER);
    let gap = Some(number(u, 0.01, 0.5)?);
    Ok(PlaceOptions { orientation, within: Some(within), gap, ..PlaceOptions::under(load) })
}

/// Panics where the promise is broken.
pub(crate) fn holds(bytes: &[u8]) {
    let mut u = Unstructured::new(bytes);
    let (Ok(arm), Ok(zone), Ok(options)) = (arm(&mut u), zone(&mut u), options(&mut u)) else { return };
    let model = match Model::of_links(&arm) {
        Ok(model) => model,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    match place(&model, &zone.into(), &options, Watch::nobody()) {
        Ok(Placed::Feasible(best)) => {
            assert!(0.0 < best.deflection && best.deflection.is_finite(), "{best:?}");
            assert!(best.lower_bound <= best.deflection, "{best:?}");
            assert!(
                best.deflection - best.lower_bound <= options.gap.unwrap_or(1e-4) * best.deflection * (1.0 + 1e-12),
                "{best:?}"
            );
            let [x, z] = best.centre;
            assert!(x.hypot(z) <= (arm.l2 + arm.l3) * (1.0 + 1e-8), "{best:?}");
            let Hold::Plane { posture: [shoulder, elbow], .. } = best.hold else { panic!("in the plane: {best:?}") };
            let reached = arm.forward(shoulder, elbow);
            let missed = (reached.x - best.worst_point[0]).hypot(reached.y - best.worst_point[2]);
            // At the rim a slack of 1e-9 on the length is its square root on the angle.
            assert!(missed <= 1e-4 * (arm.l2 + arm.l3), "{missed} {best:?}");
        }
        Ok(Placed::Infeasible { largest_scale, .. }) => {
            assert!(largest_scale.is_some_and(|scale| (0.0..=1.0).contains(&scale)), "{largest_scale:?}");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
