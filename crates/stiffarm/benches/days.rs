//! Does the interval at the work hold what is measured on other days, of real arms? No time is measured.
//!
//! `cargo bench -p stiffarm --bench days -- FOLDER` reads tables of arms under laser trackers from a folder: `irb120_a.csv`,
//! `tx2_90l_calibration.csv` and every other `tx2_90l_*.csv`. They state no licence, so that they are not part of this repository.
//!
//! Rows of one table calibrate; rows of another, or the rest of the same, are what is measured later. There the tracker and its target
//! stand elsewhere, so that both are fitted anew; what is left is held against the interval that was told for those postures.

use std::path::Path;

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, SMatrix, SVector, Translation3, UnitQuaternion, Vector3};
use stiffarm::calibrate::{CalibrateOptions, Work, calibrate};
use stiffarm::calibration::Errors;
use stiffarm::catalogue::find;
use stiffarm::catalogue::readings::{ReadOptions, Readings, read};
use stiffarm::robot::Robot;
use stiffarm::watch::Watch;

/// Rows that calibrate; as many subsets of each table are drawn.
const ROWS: [usize; 2] = [40, 150];
const SUBSETS: usize = 20;
/// Millimetres.
const MM: f64 = 1e3;

fn main() {
    let folder = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let Some(folder) = folder else {
        println!(
            "left out: no folder with tables of a tracker was given (cargo bench -p stiffarm --bench days -- FOLDER)"
        );
        return;
    };
    let folder = Path::new(&folder);
    let mut held = Held::default();
    let irb = table(&folder.join("irb120_a.csv"));
    held.of_subsets("IRB 120-3/0.58", ("irb120_a", &irb), &[]);
    let days: Vec<(String, Readings)> = ["tx2_90l_points", "tx2_90l_line", "tx2_90l_curve", "tx2_90l_surface"]
        .iter()
        .flat_map(|name| ["", "_a", "_b"].map(|part| format!("{name}{part}")))
        .filter(|name| folder.join(format!("{name}.csv")).exists())
        .map(|name| (name.clone(), table(&folder.join(format!("{name}.csv")))))
        .collect();
    let wide = table(&folder.join("tx2_90l_calibration.csv"));
    held.of("TX2-90L", ("tx2_90l_calibration", &wide), &days);
    for (name, readings) in &days {
        let others: Vec<_> = days.iter().filter(|(other, _)| other != name).cloned().collect();
        held.of_subsets("TX2-90L", (name, readings), &others);
    }
    println!("the interval holds {} of {}; {} lie under it, {} over it", held.inside, held.all, held.under, held.over);
}

fn table(path: &Path) -> Readings {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    read(&text, &path.display().to_string(), &ReadOptions::default()).unwrap_or_else(|faults| panic!("{faults}"))
}

/// How many intervals hold.
#[derive(Default)]
struct Held {
    all: usize,
    inside: usize,
    under: usize,
    over: usize,
}

impl Held {
    /// Subsets of a table calibrate; its other rows and other tables are measured later.
    fn of_subsets(&mut self, robot: &str, (name, readings): (&str, &Readings), others: &[(String, Readings)]) {
        let mut rng = fastrand::Rng::with_seed(38);
        for rows in ROWS.into_iter().filter(|rows| 2 * rows <= readings.rows.len()) {
            for subset in 0..SUBSETS {
                let mut order = readings.rows.clone();
                rng.shuffle(&mut order);
                let rest = Readings { rows: order.split_off(rows), ..readings.clone() };
                let chosen = Readings { rows: order, ..readings.clone() };
                let mut later = vec![(format!("its other {}", rest.rows.len()), rest)];
                later.extend(others.iter().cloned());
                self.of(robot, (&format!("{rows} of {name}, subset {}", subset + 1), &chosen), &later);
            }
        }
    }

    /// One table calibrates.
    fn of(&mut self, robot: &str, (name, readings): (&str, &Readings), later: &[(String, Readings)]) {
        let robot = find(robot).expect("in the catalogue").robot();
        for (other, measured) in later {
            let postures = measured.rows.iter().map(|row| row.q).collect();
            let options = CalibrateOptions { work: Work::OtherDay(postures), ..CalibrateOptions::default() };
            let found = match calibrate(&robot, readings, &options, Watch::nobody()) {
                Ok(found) => found,
                Err(error) => {
                    println!("{name}: {error}");
                    return;
                }
            };
            let [before, after] = [&Errors::NONE, &found.errors].map(|errors| left(&robot, errors, measured));
            let Some(at_work) = found.at_work else {
                println!("{name}, {other}: the work is out of reach");
                continue;
            };
            let [low, high] = at_work.interval;
            self.all += 1;
            let place = if after < low {
                self.under += 1;
                "under"
            } else if high < after {
                self.over += 1;
                "over"
            } else {
                self.inside += 1;
                "inside"
            };
            println!(
                "{name} ({}) -> {other}: {:.3} mm rms as drawn, {:.3} calibrated, {place} {:.3} to {:.3}",
                found.level.name(),
                before * MM,
                after * MM,
                low * MM,
                high * MM
            );
        }
    }
}

/// m, root mean square of what is left of the first point where tracker and target are fitted anew; what is beyond five robust standard deviations
/// is wrong, and is left out.
fn left(robot: &Robot, errors: &Errors, measured: &Readings) -> f64 {
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
