//! Does a job file ask what the options ask, and is what makes no sense in it refused by file, line and key?

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

const SMALLEST: &str =
    "name = \"two links\"\narchitecture = \"serial\"\nstatus = \"derived\"\n\n[planar]\nl2_mm = 1000\nl3_mm = 800\n";

/// Exit code, standard output and standard error of a run in a folder.
fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut program = Command::cargo_bin("stiffarm").expect("built by cargo");
    let output = program.current_dir(folder).args(arguments).output().expect("runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (output.status.code().expect("an exit code"), text(output.stdout), text(output.stderr))
}

fn answer(folder: &Path, arguments: &[&str]) -> String {
    let (code, out, errors) = run(folder, arguments);
    assert_eq!(code, 0, "{arguments:?}: {errors}");
    out
}

fn folder() -> TempDir {
    TempDir::new().expect("a folder")
}

/// What `rank` or `place` ask of a path is kept as the job for `mill` that it is, and asked again by either.
#[test]
fn a_job_of_a_path_is_asked_again_by_the_verb_that_saved_it() {
    let folder = folder();
    let path = ["--task", "line:0.05", "--force-n", "100"];
    for (asked, job) in [
        (&["rank", "--robots", "BT200L", "--within", "1.6..1.8,0.9..1.0"][..], "ranked.toml"),
        (&["place", "BT200L", "--within", "1.6..1.8,0.9..1.0"], "placed.toml"),
    ] {
        let asked = [asked, &path, &["--format", "json"]].concat();
        let saved = answer(folder.path(), &[&asked[..], &["--save-job", job]].concat());
        for verb in [asked[0], "mill"] {
            assert_eq!(answer(folder.path(), &[verb, job, "--format", "json"]), saved, "{verb} {job}");
        }
    }
    let (code, _, errors) = run(folder.path(), &["place", "ranked.toml"]);
    assert!(code == 2 && errors.contains("ranked.toml is a job for mill; place was asked"), "{code} {errors}");
}

/// Options of every verb, and the job that asks the same.
const SAME: [(&[&str], &str); 6] = [
    (
        &[
            "rank",
            "--robots",
            "BT200L,KR 210*",
            "--task",
            "A:0.2,B:0.3",
            "--tolerance-mm",
            "2",
            "--payload-kg",
            "100..",
        ],
        "verb = 'rank'\nrobots = ['BT200L', 'KR 210*']\ntask = ['A:0.2', 'B:0.3']\ntolerance-mm = 2\npayload_kg = '100..'\n",
    ),
    (
        &["place", "BT200L", "--task", "B:0.5", "--within", "1.4..,0.2..1.6", "--angle", "30", "--gap", "0.001"],
        "verb = 'place'\nrobot = 'BT200L'\ntask = 'B:0.5'\nwithin = ['1.4..', '0.2..1.6']\nangle = 30\ngap = 1e-3\n",
    ),
    (
        &["place", "BT200L", "--task", "A:0.3", "--model", "spatial", "--tool-mm=0,0,200", "--tool-direction=-30"],
        "verb = 'place'\nrobot = 'BT200L'\ntask = 'A:0.3'\nmodel = 'spatial'\n[tool]\nmm = [0, 0, 200]\ndirection = -30\n",
    ),
    (
        &["map", "BT200L", "--size", "20", "--direction-deg=-30", "--component", "along", "--zone", "A:0.3"],
        "verb = 'map'\nrobot = 'BT200L'\nsize = 20\ndirection-deg = -30\ncomponent = 'along'\nzone = 'A:0.3'\n",
    ),
    (
        &["compliance", "BT200L", "--joints-deg=0,-90,90,0,45,0", "--force-n=0,1000,-5.5"],
        "verb = 'compliance'\nrobot = 'BT200L'\njoints-deg = [0, -90, 90, 0, 45, 0]\nforce-n = [0, 1000, -5.5]\n",
    ),
    (
        &[
            "study",
            "--tasks",
            "A",
            "--sizes",
            "0.2",
            "--range",
            "0.6..1.4",
            "--compare",
            "serial,serial",
            "--k2",
            "1,0.5",
        ],
        "verb = 'study'\ntasks = 'A'\nsizes = 0.2\nrange = [0.6, 1.4]\ncompare = ['serial', 'serial']\nk2 = [1, 0.5]\n",
    ),
];

#[test]
fn a_job_answers_what_its_options_answer_and_so_does_the_job_that_is_saved() {
    let folder = folder();
    for (options, job) in SAME {
        fs::write(folder.path().join("job.toml"), format!("format = 'json'\n{job}")).expect("written");
        let typed = answer(folder.path(), &[options, &["--format", "json", "--save-job", "saved.toml"]].concat());
        assert_eq!(answer(folder.path(), &[options[0], "job.toml"]), typed, "{job}");
        assert_eq!(answer(folder.path(), &[options[0], "saved.toml"]), typed, "{options:?}");
        answer(folder.path(), &[options[0], "saved.toml", "--save-job", "again.toml", "-q"]);
        let saved =
            |name: &str| fs::read_to_string(folder.path().join(name)).expect("written").replace("quiet = true\n", "");
        assert_eq!(saved("again.toml"), saved("saved.toml"));
    }
}

#[test]
fn what_is_typed_beside_a_job_overrules_it() {
    let folder = folder();
    let job = "verb = 'map'\nrobot = 'BT200L'\nforce-n = 500\nsize = 20\nformat = 'json'\n";
    fs::write(folder.path().join("job.toml"), job).expect("written");
    let expected = answer(folder.path(), &["map", "BT200L", "--force-n", "700", "--step-m", "0.2", "--format", "csv"]);
    let found = answer(folder.path(), &["map", "job.toml", "--force-n", "700", "--step-m", "0.2", "--format", "csv"]);
    assert_eq!(found, expected, "step-m stands in the place of size, too");
}

#[test]
fn a_folder_with_a_job_its_robot_and_its_answer_can_be_handed_on() {
    let folder = folder();
    fs::create_dir(folder.path().join("cell")).expect("a folder");
    fs::write(folder.path().join("cell/robot.toml"), SMALLEST).expect("written");
    let arguments =
        ["place", "cell/robot.toml", "--task", "A:0.3", "-o", "cell/place.json", "--save-job", "cell/job.toml"];
    answer(folder.path(), &arguments);
    let job = fs::read_to_string(folder.path().join("cell/job.toml")).expect("written");
    assert!(job.contains("robot = \"robot.toml\"") && job.contains("output = [\"./place.json\"]"), "{job}");
    fs::rename(folder.path().join("cell"), folder.path().join("other")).expect("renamed");
    let before = fs::read(folder.path().join("other/place.json")).expect("written");
    fs::remove_file(folder.path().join("other/place.json")).expect("removed");
    answer(folder.path(), &["place", "other/job.toml"]);
    assert_eq!(fs::read(folder.path().join("other/place.json")).expect("written again"), before);
}

#[test]
fn a_job_that_makes_no_sense_is_refused_and_nothing_is_written_over_what_is_read() {
    let folder = folder();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    write("robot.toml", SMALLEST);
    write("job.toml", "verb = 'place'\nrobot = 'robot.toml'\ntask = 'A:0.3'\n");
    write("unknown.toml", "verb = 'place'\nrobot = 'BT200L'\ntaks = 'A:0.3'\n");
    write("type.toml", "verb = 'place'\nrobot = 'BT200L'\ntask = 'A:0.3'\nforce-n = 'much'\n");
    write("nan.toml", "verb = 'place'\nrobot = 'BT200L'\ntask = 'A:0.3'\nforce-n = nan\n");
    write("twice.toml", "verb = 'place'\nforce-n = 1\nforce_n = 2\n");
    write("same.toml", "verb = 'place'\nforce-n = 1\nforce-n = 2\n");
    write("text.toml", "verb = 'place'\ntask A:0.3\n");
    write("model.toml", "verb = 'place'\nrobot = 'BT200L'\ntask = 'A:0.3'\nroll-deg = 3\n");
    write("milled.toml", "verb = 'mill'\npath = 'line:0.1'\nrobot = 'BT200L'\nforce-n = 9\nat = [1.5, 0, 0.8]\n");
    write("less.toml", "verb = 'place'\nrobot = 'BT200L'\n");
    write("threads.toml", "verb = 'place'\nrobot = 'BT200L'\ntask = 'A:0.3'\nthreads = 0\n");
    write("huge.toml", &format!("verb = 'place'\n{}", "#".repeat(5 << 20)));
    for (arguments, code, expected) in [
        (&["place", "unknown.toml"][..], 2, "unknown.toml:3: taks is no option of place; did you mean task?"),
        (&["place", "type.toml"], 2, "type.toml:4: invalid value 'much' for 'force-n': expected a number"),
        (&["place", "nan.toml"], 2, "nan.toml:4: invalid value 'nan' for 'force-n': expected a number from 0.001"),
        (&["place", "twice.toml"], 2, "twice.toml:3: force-n is given twice"),
        (&["place", "same.toml"], 2, "same.toml:3: "),
        (&["place", "text.toml"], 2, "text.toml:2: "),
        (&["place", "model.toml"], 2, "model.toml:4: roll-deg needs model = \"spatial\""),
        (&["place", "less.toml"], 2, "less.toml: task is missing; expected circle:D"),
        (&["place", "threads.toml"], 2, "threads.toml:4: invalid value '0' for 'threads': expected a whole number"),
        (&["place", "huge.toml"], 1, "larger than 4 MiB"),
        (&["place", "nothing.toml"], 1, "cannot read nothing.toml"),
        (&["map", "job.toml"], 2, "job.toml is a job for place; map was asked"),
        (&["rank", "milled.toml"], 2, "milled.toml is a job for mill; rank was asked"),
        (&["place", "milled.toml"], 2, "milled.toml is a job for mill; place was asked"),
        (&["rank", "robot.toml"], 2, "robot.toml: verb is missing; expected rank"),
        (&["rank", "BT200L"], 2, "'BT200L' is no job file"),
        (&["place", "job.toml", "--save-job", "job.toml"], 2, "cannot write job.toml: the command reads this file"),
        (&["place", "job.toml", "--save-job", "robot.toml"], 2, "cannot write robot.toml: the command reads this file"),
        (
            &["rank", "--save-job", "job.json"],
            2,
            "--save-job cannot write job.json: expected a name that ends in .toml",
        ),
    ] {
        let (found, _, errors) = run(folder.path(), arguments);
        assert_eq!(found, code, "{arguments:?}: {errors}");
        assert!(errors.contains(expected) && errors.contains("hint: "), "{arguments:?}: {errors}");
        assert!(!errors.contains("panicked"), "{errors}");
    }
    assert_eq!(fs::read_to_string(folder.path().join("robot.toml")).expect("still there"), SMALLEST);
}

#[test]
fn a_map_takes_what_places_a_zone_only_with_one() {
    let folder = folder();
    for option in [["--gap", "0.01"], ["--within", "1..2,.."], ["--angle", "30"]] {
        let (code, _, errors) = run(folder.path(), &[&["map", "BT200L", "--size", "9"][..], &option].concat());
        assert!(code == 2 && errors.contains(&format!("{} needs --zone", option[0])), "{errors}");
        let spatial = ["map", "BT200L", "--size", "9", "--model", "spatial"];
        let (code, _, errors) = run(folder.path(), &[&spatial[..], &option].concat());
        let expected = format!("{} is of the planar model; it does not go with --model spatial", option[0]);
        assert!(code == 2 && errors.contains(&expected) && !errors.contains("give --zone"), "{errors}");
    }
}
