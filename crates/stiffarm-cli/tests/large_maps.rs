//! Are maps written cell by cell as they would be written whole, in little memory?
#![cfg(unix)]

use std::fmt::Write;
use std::fs;
use std::process::Command;

use serde_json::{Value, json};
use stiffarm::catalogue::find;
use stiffarm::load::Load;
use stiffarm::map::{MapOptions, Spacing, map};
use stiffarm::model::ModelKind;
use stiffarm::spatial::Pose;
use stiffarm_ask::answer::MapAnswer;
use tempfile::TempDir;

fn run(arguments: &[&str]) -> String {
    let program = assert_cmd::cargo::cargo_bin("stiffarm");
    let output = Command::new(program).args(arguments).output().expect("runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// A JSON text that was held as one value.
fn whole(value: &Value) -> String {
    serde_json::to_string_pretty(value).expect("JSON") + "\n"
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

fn answer(kind: ModelKind, points: usize) -> MapAnswer {
    let robot = find("BT200L").expect("in the catalogue").robot();
    let model = kind.of(&robot).expect("a model");
    let options = MapOptions::over(Spacing::Points(points), Load::PAPER);
    let map = map(&model, &options).expect("a map");
    MapAnswer { model, options, map, zone: None, frequency: None }
}

#[test]
fn a_map_of_the_plane_is_written_as_it_was_when_it_was_held_whole() {
    let answer = answer(ModelKind::Planar, 37);
    let map = &answer.map.deflection;
    let mm = |i, j| map.get(i, j).map(|metres| metres * 1e3);
    let mut csv = String::from("x_m,z_m,deflection_mm\n");
    for (j, i) in (0..map.z.count).flat_map(|j| (0..map.x.count).map(move |i| (j, i))) {
        let _ = writeln!(csv, "{},{},{}", map.x.at(i), map.z.at(j), number(mm(i, j)));
    }
    let rows: Vec<Vec<Option<f64>>> = (0..map.z.count).map(|j| (0..map.x.count).map(|i| mm(i, j)).collect()).collect();
    let mut expected = answer.head_json();
    expected["worst_mm"] = json!(rows);
    let asked = ["map", "BT200L", "--size", "37"];
    assert_eq!(run(&[&asked[..], &["--format", "csv"]].concat()), csv);
    assert_eq!(run(&[&asked[..], &["--format", "json"]].concat()), whole(&expected));
    assert_eq!(
        (&expected["robot"], &expected["model"], &expected["force_n"]),
        (&json!("BT200L"), &json!("planar"), &json!(1e3))
    );
}

#[test]
fn a_map_in_space_is_written_as_it_was_when_it_was_held_whole() {
    let answer = answer(ModelKind::Spatial(Pose::identity()), 23);
    let (x, z) = (answer.map.deflection.x, answer.map.deflection.z);
    // The head with its postures, and each layer, as Python gets them.
    let mut expected = answer.head_json();
    for layer in answer.layers() {
        let cells: Vec<Value> = layer.cells().into_iter().map(|cell| json!(cell)).collect();
        expected[layer.field.key] = cells.chunks(x.count).map(<[Value]>::to_vec).collect::<Value>();
    }
    let asked = ["map", "BT200L", "--model", "spatial", "--stiffness", "paper", "--size", "23"];
    assert_eq!(run(&[&asked[..], &["--format", "json"]].concat()), whole(&expected));
    let csv = run(&[&asked[..], &["--format", "csv"]].concat());
    assert_eq!(csv.lines().count(), 1 + x.count * z.count);
    let reached = csv.lines().find(|line| line.contains(",front,")).expect("a cell that is reached");
    assert_eq!(reached.split(',').count(), 9, "{reached}");
}

/// Half a million rows, held as texts, would take 120 MB, and as JSON as much again; the map itself takes 4 MB.
#[test]
fn a_map_takes_little_more_memory_than_its_cells_in_every_kind_of_table() {
    let folder = TempDir::new().expect("a folder");
    let program = assert_cmd::cargo::cargo_bin("stiffarm");
    let script =
        "ulimit -v 130000; \"$S\" map BT200L --size 750 --threads 1 -q -o m.csv -o m.parquet -o m.json -o m.md";
    let mut command = Command::new("bash");
    let output = command.args(["-c", script]).env("S", program).current_dir(folder.path()).output().expect("bash runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let csv = fs::read_to_string(folder.path().join("m.csv")).expect("written");
    assert!(400_000 < csv.lines().count());
    assert!(fs::read(folder.path().join("m.parquet")).expect("written").ends_with(b"PAR1"));
}
