//! Does every promise for any input hold of the seeds of the fuzz targets, and of their neighbours?
//!
//! The random run, which looks for inputs by itself, is `scripts/fuzz`.

use std::fs;
use std::path::Path;

use fastrand::Rng;

#[path = "../../../fuzz/promises/measurements.rs"]
mod measurements;
#[path = "../../../fuzz/promises/place.rs"]
mod place;
#[path = "../../../fuzz/promises/process_file.rs"]
mod process_file;
#[path = "../../../fuzz/promises/rewrite.rs"]
mod rewrite;
#[path = "../../../fuzz/promises/robot_file.rs"]
mod robot_file;
#[path = "../../../fuzz/promises/task.rs"]
mod task;
#[path = "../../../fuzz/promises/toolpath.rs"]
mod toolpath;
#[path = "../../../fuzz/promises/urdf.rs"]
mod urdf;

/// Inputs made of each seed besides itself.
const NEIGHBOURS: usize = 25;

/// A seed with a few of its bytes changed, left out, or repeated further on.
fn neighbour(seed: &[u8], rng: &mut Rng) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..rng.usize(1..=4) {
        let at = rng.usize(..=bytes.len());
        let end = (at + rng.usize(1..=12)).min(bytes.len());
        match rng.u8(..5) {
            0 if at < end => bytes[at] = rng.u8(..),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let piece = bytes[at..end].to_vec();
                let to = rng.usize(..=bytes.len());
                bytes.splice(to..to, piece);
            }
            3 => bytes.truncate(at),
            _ => bytes.insert(at, *rng.choice(b"0123456789.-+eE \n\r\t,;%()[]=\"#GMXYZ/<>").expect("not empty")),
        }
    }
    bytes
}

/// Every seed of a target, and its neighbours, the same at every run.
fn replay(target: &str, holds: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../fuzz/seeds").join(target);
    let mut seeds: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    seeds.sort();
    assert!(!seeds.is_empty(), "no seeds in {}", folder.display());
    let mut rng = Rng::with_seed(1);
    for path in seeds {
        let seed = fs::read(&path).unwrap();
        holds(&seed);
        for _ in 0..NEIGHBOURS {
            holds(&neighbour(&seed, &mut rng));
        }
    }
}

#[test]
fn measurements() {
    replay("measurements", measurements::holds);
}

#[test]
fn places() {
    replay("place", place::holds);
}

#[test]
fn process_files() {
    replay("process_file", process_file::holds);
}

#[test]
fn rewritten_paths() {
    replay("rewrite", rewrite::holds);
}

#[test]
fn robot_files() {
    replay("robot_file", robot_file::holds);
}

#[test]
fn tasks() {
    replay("task", task::holds);
}

#[test]
fn toolpaths() {
    replay("toolpath", toolpath::holds);
}

#[test]
fn descriptions() {
    replay("urdf", urdf::holds);
}
