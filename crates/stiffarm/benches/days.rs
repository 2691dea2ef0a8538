//! Does the interval at the work hold what is measured on other days, of real arms? No time is measured.
//!
//! `cargo bench -p stiffarm --bench days -- FOLDER` reads tables of arms under laser trackers from a folder: `irb120_a.csv`,
//! `tx2_90l_calibration.csv` and every other `tx2_90l_*.csv`. They state no licence, so that they are not part of this repository.
//!
//! Rows of one table calibrate; rows of another, or the rest of the same, are what is measured later. There the tracker and its target
//! stand elsewhere, so that both are fitted anew; what is left is held against the interval that was given for those postures.

#[path = "../tests/made/mod.rs"]
mod made;

use std::path::Path;

use made::other_day::left;
use stiffarm::calibrate::{CalibrateOptions, Work, calibrate};
use stiffarm::calibration::Errors;
use stiffarm::catalogue::find;
use stiffarm::catalogue::readings::{ReadOptions, Readings, read};
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
