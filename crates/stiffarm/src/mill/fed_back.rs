//! How far is a tool pushed off where its cut changes with it? Moved across it cuts another width, moved along its axis another depth.
//!
//! With `F` the mean force of the cut as it is meant, `K` what it changes with the displacement (of the width and the depth, the sides of the
//! cut taken as walls along the feed), and `C` the compliance, all along the axes of the cut:
//!
//! ```text
//! delta = C (F + K delta)
//! ```
//!
//! The rounds `delta <- C (F + K delta)` settle where the spectral radius of `C K` is below one: the contraction that is reported. Then the
//! sum of all rounds is solved for at once. A program that is compensated stands at its targets, so that it cuts as it was meant.

use nalgebra::{Matrix2, Matrix3x2, Vector2, Vector3};

use super::fault::MillError;
use super::follow::{Pushed, Stand, wrench};
use super::stations::{Acting, ErrorPart, Station};
use crate::compliance::compliance;
use crate::robot::Robot;
use crate::watch::Watch;

/// What becomes of a path whose cut changes with the displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FedBack {
    /// The largest error of the samples that settle, m.
    pub worst: f64,
    /// Of every round over the one before, at most: the largest spectral radius.
    pub contraction: f64,
    /// Samples at which nothing settles: pushed aside, the tool is drawn in.
    pub unsettled: usize,
}

/// The error along a path that is followed, where the force changes with it; `None` where no force is known to.
///
/// # Errors
/// As [`super::mill`].
pub fn fed_back(
    robot: &Robot,
    stand: &Stand,
    (stations, followed): (&[Station], &[Pushed]),
    part: ErrorPart,
    watch: Watch,
) -> Result<Option<FedBack>, MillError> {
    let mut found: Option<FedBack> = None;
    for (station, pushed) in stations.iter().zip(followed) {
        watch.go_on()?;
        let (Some(Acting::Known { force, moment }), Some(cut)) = (station.acting, &station.cut) else {
            continue;
        };
        let axes = stand.cutting_axes(&station.sample);
        let posture = compliance(robot, &pushed.joints, &stand.flange_from_tool)?;
        let meant = axes.transpose() * posture.compliance.deflection(&wrench(&axes, force, moment)).0;
        let changes = Matrix3x2::from_columns(&cut.changes.map(Vector3::from));
        let back = axes.transpose() * posture.compliance.translation() * axes * changes;
        let of_cut: Matrix2<f64> = back.fixed_rows::<2>(1).into();
        let contraction = spectral_radius(&of_cut);
        let summary = found.get_or_insert(FedBack { worst: 0.0, contraction: 0.0, unsettled: 0 });
        summary.contraction = summary.contraction.max(contraction);
        let settled = if contraction < 1.0 { (Matrix2::identity() - of_cut).try_inverse() } else { None };
        let Some(settled) = settled else {
            summary.unsettled += 1;
            continue;
        };
        let moved = axes * (meant + back * (settled * Vector2::new(meant.y, meant.z)));
        let counted = part.direction(&axes, &station.sample);
        let error = counted.map_or_else(|| moved.norm(), |counted| counted.dot(&moved).abs());
        summary.worst = summary.worst.max(error);
    }
    Ok(found)
}

/// The largest size of an eigenvalue.
fn spectral_radius(m: &Matrix2<f64>) -> f64 {
    let (half, determinant) = (m.trace() / 2.0, m.determinant());
    let under = half * half - determinant;
    // Of two that are complex both have the size of the root of their product.
    if under < 0.0 { determinant.sqrt() } else { half.abs() + under.sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spectral_radius_is_that_of_a_hand_calculation() {
        for (m, expected) in [
            (Matrix2::new(0.5, 0.0, 0.0, -0.7), 0.7),
            (Matrix2::new(0.0, -0.3, 0.3, 0.0), 0.3),
            (Matrix2::new(1.0, 2.0, 3.0, 2.0), 4.0),
        ] {
            assert!((spectral_radius(&m) - expected).abs() < 1e-12, "{m}");
        }
    }
}
