//! What is left of measured points where tracker and target stand elsewhere, and are found anew: by least squares of its own, beside those of the library.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, SMatrix, SVector, Translation3, UnitQuaternion, Vector3};
use stiffarm::calibration::Errors;
use stiffarm::catalogue::readings::Readings;
use stiffarm::robot::Robot;

/// m, root mean square of what is left of the first point where tracker and target are fitted anew; what is beyond five robust standard deviations
/// is wrong, and is left out.
pub(crate) fn left(robot: &Robot, errors: &Errors, measured: &Readings) -> f64 {
    let mut pairs: Vec<(Isometry3<f64>, Vector3<f64>)> = (measured.rows.iter())
        .filter_map(|row| Some((errors.flange(robot, &row.q).expect("six axes"), row.points[0]?)))
        .collect();
    loop {
        let off = fitted(&pairs);
        let mut sorted = off.clone();
        sorted.sort_by(f64::total_cmp);
        let limit = 5.0 * sorted[sorted.len() / 2] / 1.538;
        if sorted.last().is_none_or(|last| *last <= limit) {
            return (off.iter().map(|x| x * x).sum::<f64>() / off.len() as f64).sqrt();
        }
        pairs = pairs.iter().zip(&off).filter(|(_, off)| **off <= limit).map(|(pair, _)| *pair).collect();
    }
}

/// m: how far each row is off where tracker and target stand so that the sum of squares is least, by Gauss and Newton.
fn fitted(pairs: &[(Isometry3<f64>, Vector3<f64>)]) -> Vec<f64> {
    const ROUNDS: usize = 20;
    let mut target = Vector3::zeros();
    let mut tracker = onto(&pairs.iter().map(|(flange, seen)| (flange.translation.vector, *seen)).collect::<Vec<_>>());
    let off = |tracker: &Isometry3<f64>, target: &Vector3<f64>, (flange, seen): &(Isometry3<f64>, Vector3<f64>)| {
        Point3::from(*seen) - tracker * flange * Point3::from(*target)
    };
    for _ in 0..ROUNDS {
        let (mut h, mut g) = (SMatrix::<f64, 9, 9>::zeros(), SVector::<f64, 9>::zeros());
        for pair in pairs {
            let flange = tracker.rotation * pair.0.rotation;
            let arm = tracker.rotation * (pair.0 * Point3::from(target)).coords;
            let mut jacobian = SMatrix::<f64, 3, 9>::zeros();
            jacobian.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
            jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
            jacobian.fixed_view_mut::<3, 3>(0, 6).copy_from(flange.to_rotation_matrix().matrix());
            h += jacobian.transpose() * jacobian;
            g += jacobian.transpose() * off(&tracker, &target, pair);
        }
        // What these postures do not show of the target stays as it is.
        let step = h.svd(true, true).solve(&g, 1e-9 * h.trace()).expect("both sides are asked for");
        let [shift, turn, more]: [Vector3<f64>; 3] = [0, 3, 6].map(|at| step.fixed_rows::<3>(at).into());
        let rotation = UnitQuaternion::new(turn) * tracker.rotation;
        tracker = Isometry3::from_parts(Translation3::from(tracker.translation.vector + shift), rotation);
        target += more;
    }
    pairs.iter().map(|pair| off(&tracker, &target, pair).norm()).collect()
}

/// The pose that leads points onto others with the least sum of squares (Kabsch).
fn onto(pairs: &[(Vector3<f64>, Vector3<f64>)]) -> Isometry3<f64> {
    let count = pairs.len() as f64;
    let from = pairs.iter().map(|(from, _)| from).sum::<Vector3<f64>>() / count;
    let to = pairs.iter().map(|(_, to)| to).sum::<Vector3<f64>>() / count;
    let turns = pairs.iter().fold(Matrix3::zeros(), |sum, (a, b)| sum + (b - to) * (a - from).transpose());
    let svd = turns.svd(true, true);
    let (u, vt) = (svd.u.expect("asked for"), svd.v_t.expect("asked for"));
    let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, (u * vt).determinant().signum()));
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(u * mirror * vt));
    Isometry3::from_parts(Translation3::from(to - turn * from), turn)
}
