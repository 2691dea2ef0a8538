//! Is nothing that a command reads written over, and nothing written before it is answered?

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

const ROBOT: &str =
    "name = \"two links\"\narchitecture = \"serial\"\nstatus = \"derived\"\n\n[planar]\nl2_mm = 1000\nl3_mm = 800\n";
const LAW: &str = "[measured]\nfile = \"forces.csv\"\non = \"tool\"\n";
const FORCES: &str = "s_mm,f_feed_n,f_across_n,f_axial_n\n0,10,20,5\n500,12,22,5\n";
const JOB: &str = "verb = 'place'\nrobot = 'robots/mine.toml'\ntask = 'A:0.3'\n";

/// Exit code and standard error of a run in a folder.
fn run(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let mut program = Command::cargo_bin("stiffarm").expect("built by cargo");
    let output = program.current_dir(folder).args(arguments).output().expect("runs");
    (output.status.code().expect("an exit code"), String::from_utf8(output.stderr).expect("text"))
}

/// A folder with a file of every kind that is read.
fn folder() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    fs::create_dir(folder.path().join("robots")).expect("a folder");
    for (name, text) in [("robots/mine.toml", ROBOT), ("law.toml", LAW), ("forces.csv", FORCES), ("job.toml", JOB)] {
        fs::write(folder.path().join(name), text).expect("written");
    }
    folder
}

/// Every file below a folder with what stands in it, by name.
fn content(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
        if entry.is_dir() {
            found.extend(content(&entry));
        } else {
            found.push((entry.display().to_string(), fs::read(&entry).expect("read")));
        }
    }
    found.sort();
    found
}

const PATH: [&str; 5] = ["mill", "line:0.2", "--robot", "BT200L", "--process"];

#[test]
fn no_file_that_is_read_is_written_over() {
    let folder = folder();
    let before = content(folder.path());
    let mill = [&PATH[..], &["law.toml"]].concat();
    let robots = ["rank", "--robots", "robots", "--task", "A:0.3"];
    let compare = ["compare", "job.toml", "BT200L", "--task", "A:0.3"];
    for (asked, written) in [
        (&["force", "law.toml"][..], &["-o", "forces.csv"][..]),
        (&["force", "law.toml"], &["-o", "robots/../forces.csv"]),
        (&["force", "law.toml"], &["--save-job", "law.toml"]),
        (&mill, &["-o", "forces.csv"]),
        (&mill, &["--save-job", "law.toml"]),
        (&robots, &["--save-job", "robots/mine.toml"]),
        (&compare, &["--save-job", "robots/mine.toml"]),
        (&compare, &["--save-job", "job.toml"]),
        (&["place", "job.toml"], &["--save-job", "./job.toml"]),
        (&["robots", "check", "robots"], &["-o", "robots/mine.toml"]),
    ] {
        let (code, errors) = run(folder.path(), &[asked, written].concat());
        assert!(
            code == 2 && errors.contains(&format!("cannot write {}", written[1])),
            "{asked:?} {written:?}: {errors}"
        );
        assert!(errors.contains("hint: "), "{errors}");
        assert!(content(folder.path()) == before, "{asked:?} {written:?} left other files");
    }
}

#[test]
#[cfg(unix)]
fn a_link_to_what_is_read_is_what_is_read() {
    let folder = folder();
    std::os::unix::fs::symlink("forces.csv", folder.path().join("soft.csv")).expect("linked");
    fs::hard_link(folder.path().join("forces.csv"), folder.path().join("hard.csv")).expect("linked");
    for name in ["soft.csv", "hard.csv"] {
        let (code, errors) = run(folder.path(), &["force", "law.toml", "-o", name]);
        assert!(code == 2 && errors.contains(&format!("cannot write {name}: the command reads this file")), "{errors}");
    }
    assert_eq!(fs::read_to_string(folder.path().join("forces.csv")).expect("there"), FORCES);
}

#[test]
#[cfg(unix)]
fn a_link_whose_end_is_missing_leads_to_a_new_file_of_the_usual_mode() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let file = |name: &str| folder.path().join(name);
    std::os::unix::fs::symlink("robots/new.csv", file("link.csv")).expect("linked");
    for name in ["link.csv", "usual.csv"] {
        let (code, errors) = run(folder.path(), &["force", "law.toml", "-o", name]);
        assert_eq!(code, 0, "{errors}");
    }
    let mode = |name: &str| fs::symlink_metadata(file(name)).expect("there").permissions().mode();
    assert_eq!(mode("robots/new.csv"), mode("usual.csv"));
    assert_eq!(fs::read(file("robots/new.csv")).expect("there"), fs::read(file("usual.csv")).expect("there"));
    assert!(fs::symlink_metadata(file("link.csv")).expect("there").is_symlink(), "the link stays");
}

#[test]
fn what_is_asked_is_saved_only_once_it_is_answered() {
    let folder = folder();
    fs::write(folder.path().join("wrong.toml"), "name = \"half a robot\"\n").expect("written");
    for asked in [
        &["place", "wrong.toml", "--task", "A:0.3"][..],
        &["place", "BT200L", "--task", "A:0.3", "-o", "figure.xyz"],
        &["place", "BT200L", "--task", "A:0.3", "-o", "missing/answer.json"],
        &["mill", "absent.nc", "--robot", "BT200L", "--force-n", "100"],
    ] {
        let (code, errors) = run(folder.path(), &[asked, &["--save-job", "saved.toml"]].concat());
        assert!(code != 0 && !folder.path().join("saved.toml").exists(), "{asked:?}: {errors}");
    }
    let asked =
        ["place", "BT200L", "--task", "A:0.3", "--tolerance-mm", "0.001", "--check", "--save-job", "saved.toml"];
    let (code, errors) = run(folder.path(), &asked);
    assert!(code == 3 && folder.path().join("saved.toml").exists(), "not held is an answer: {errors}");
}

#[test]
fn no_job_is_saved_among_robots_that_are_read_as_a_folder() {
    let folder = folder();
    let asked = ["rank", "--robots", "robots", "--task", "A:0.3", "--save-job", "robots/job.toml"];
    let (code, errors) = run(folder.path(), &asked);
    assert!(code == 2 && errors.contains("every .toml file of this folder is read as a robot"), "{errors}");
    let (code, errors) =
        run(folder.path(), &[&asked[..5], &["--save-job", "saved.toml", "-o", "robots/rank.csv"]].concat());
    assert_eq!(code, 0, "{errors}");
}

#[test]
fn two_outputs_are_two_files() {
    let folder = folder();
    for outputs in [["-o", "a.csv", "-o", "./a.csv"], ["-o", "a.csv", "-o", "robots/../a.csv"]] {
        let (code, errors) = run(folder.path(), &[&["force", "law.toml"][..], &outputs].concat());
        assert!(code == 2 && errors.contains("twice: another output is the same file"), "{errors}");
        assert!(!folder.path().join("a.csv").exists());
    }
}
