//! Does `stiffarm robots import` write what can be used, tell what it understood, and refuse with a reason?

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

const EXAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/examples/example_150.urdf");

/// Exit code, standard output, standard error; never a panic.
fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("stiffarm").unwrap().args(arguments).output().expect("runs");
    let [out, errors] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("text"));
    assert!(!errors.contains("panicked"), "{errors}");
    (output.status.code().expect("an exit code"), out, errors)
}

fn written(folder: &TempDir, name: &str, text: &str) -> String {
    let path = folder.path().join(name);
    fs::write(&path, text).expect("writes");
    path.to_str().expect("a plain path").into()
}

#[test]
fn the_robot_file_goes_to_standard_output_and_the_report_beside_it() {
    let (code, out, report) = run(&["robots", "import", EXAMPLE]);
    assert_eq!(code, 0);
    assert!(out.starts_with("name = \"Example 150\"\n") && out.ends_with('\n'), "{out}");
    for says in
        ["lengths", "a1 300, a2 -150, b 0, c1 600, c2 1000, c3 1100, c4 200 mm", "largest error", "'tool0'", "assumed"]
    {
        assert!(report.contains(says), "'{says}' is not in\n{report}");
    }
    let (code, quiet, report) = run(&["robots", "import", EXAMPLE, "--quiet"]);
    assert_eq!((code, quiet == out, report.as_str()), (0, true, ""));
}

#[test]
fn a_written_file_is_a_robot_like_any_other() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("robot.toml").to_str().unwrap().to_owned();
    let options = [
        "--name",
        "Mine",
        "--vendor",
        "Maker",
        "--payload-kg",
        "150",
        "--reach-m",
        "2.4",
        "--architecture",
        "quasi-serial",
    ];
    let (code, out, report) = run(&[&["robots", "import", EXAMPLE, "-o", &file][..], &options].concat());
    assert_eq!((code, out.as_str()), (0, ""), "{report}");
    assert!(report.contains("wrote ") && report.contains("robot.toml"), "{report}");
    let (code, out, _) = run(&["robots", "check", &file]);
    assert!(code == 0 && out.contains("Maker Mine can be used"), "{out}");
    let (_, sheet, _) = run(&["robots", "show", &file]);
    assert!(sheet.contains("quasi-serial") && sheet.contains("150 kg") && sheet.contains("l2 1.0000 m"), "{sheet}");
}

#[test]
fn scripts_get_notes_errors_and_the_file_as_json() {
    let (code, out, _) = run(&["robots", "import", EXAMPLE, "--format", "json"]);
    let json: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!((code, &json["robot"], &json["postures"]), (0, &"Example 150".into(), &1000.into()));
    assert!(json["largest_error_m"].as_f64().unwrap() < 1e-6 && json["largest_error_rad"].as_f64().unwrap() < 1e-6);
    assert!(json["robot_file"].as_str().unwrap().contains("c2_mm = 1000"));
    assert!(3 <= json["notes"].as_array().unwrap().len());
}

#[test]
fn a_urdf_stands_wherever_a_robot_does() {
    let (code, out, errors) = run(&["place", EXAMPLE, "--task", "A:0.5"]);
    assert!(code == 0 && out.contains("Example 150") && out.contains("derived"), "{out}{errors}");
    let (code, out, _) = run(&["rank", "--robots", &format!("{EXAMPLE},BT200L"), "--task", "A:0.5"]);
    assert!(code == 0 && out.contains("Example 150") && out.contains("BT200L"), "{out}");
    let joints = ["--joints-deg", "0,10,10,10,10,10"];
    for verb in [
        &["place", EXAMPLE, "--task", "A:0.5"][..],
        &["map", EXAMPLE],
        &[&["compliance", EXAMPLE][..], &joints].concat(),
    ] {
        let (code, out, errors) = run(verb);
        assert!(code == 0 && errors.contains("example_150.urdf: architecture: serial is assumed"), "{errors}");
        assert_eq!(run(&[verb, &["-q"]].concat()), (0, out, String::new()));
    }
    let (code, out, _) = run(&["robots", "check", EXAMPLE]);
    assert!(code == 0 && out.contains("Example 150 can be used"), "{out}");
}

#[test]
fn a_macro_file_is_answered_with_how_to_expand_it() {
    let folder = TempDir::new().unwrap();
    let text = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><xacro:arm/></robot>";
    let file = written(&folder, "arm.xacro", text);
    for arguments in [&["robots", "import", &file][..], &["place", &file, "--task", "A:0.5"]] {
        let (code, out, errors) = run(arguments);
        assert_eq!((code, out.as_str()), (1, ""));
        assert!(
            errors.contains("arm.xacro: a xacro macro file") && errors.contains("hint: expand it first: xacro FILE"),
            "{errors}"
        );
    }
}

#[test]
fn opw_parameters_need_limits_and_say_so() {
    let folder = TempDir::new().unwrap();
    let text = "opw_kinematics_geometric_parameters: {a1: 0.3, a2: -0.15, b: 0, c1: 0.6, c2: 1.0, c3: 1.1, c4: 0.2}\n\
                opw_kinematics_joint_offsets: [0, 0, deg(-90), 0, 0, 0]\n\
                opw_kinematics_joint_sign_corrections: [1, 1, 1, 1, 1, 1]\n";
    let file = written(&folder, "opw_parameters_mine.yaml", text);
    let (code, _, errors) = run(&["robots", "import", &file]);
    assert!(
        code == 1 && errors.contains("have no joint limits") && errors.contains("--limits-deg=-185..185,"),
        "{errors}"
    );
    let limits = "--limits-deg=-180..180,-65..85,-180..70,-360..360,-120..120,-360..360";
    let (code, out, report) = run(&["robots", "import", &file, limits]);
    assert!(code == 0 && out.contains("[-65, 85]") && report.contains("largest error below 0.001 um"), "{out}{report}");
    for end in ["--base", "--tip"] {
        let (code, out, errors) = run(&["robots", "import", &file, limits, end, "link_1"]);
        assert!(code == 1 && out.is_empty() && errors.contains("OPW parameters name no links"), "{errors}");
        assert!(errors.contains("hint: --base and --tip say where in a URDF"), "{errors}");
    }
    for (bad, says) in [
        ("--limits-deg=-180..180", "1 ranges; expected six"),
        ("--limits-deg=1..-1", "such as -185..185"),
        ("--limits-deg=..", "such as -185..185"),
    ] {
        let (code, _, errors) = run(&["robots", "import", &file, bad]);
        assert!(code == 2 && errors.contains(says), "{errors}");
    }
}

#[test]
fn nothing_is_written_where_the_file_is_refused() {
    let folder = TempDir::new().unwrap();
    let text = fs::read_to_string(EXAMPLE).unwrap().replace("xyz=\"0.6 0 0\"", "xyz=\"0.6 0 nan\"");
    let bad = written(&folder, "bad.urdf", &text);
    let target = folder.path().join("robot.toml");
    let (code, out, errors) = run(&["robots", "import", &bad, "-o", target.to_str().unwrap()]);
    assert!(code == 1 && out.is_empty(), "{out}");
    assert!(errors.contains("bad.urdf:42: joint joint_5, origin xyz: 'nan'; expected a number"), "{errors}");
    assert!(!Path::new(&target).exists());
    let (code, _, errors) =
        run(&["robots", "import", EXAMPLE, "-o", folder.path().join("robot.urdf").to_str().unwrap()]);
    assert!(code == 2 && errors.contains("ends in .toml, .json"), "{errors}");
    let (code, _, errors) = run(&["place", "nowhere.urdf", "--task", "A:0.5"]);
    assert!(code == 1 && errors.contains("cannot read nowhere.urdf"), "{errors}");
}

/// A tetrahedron with edges of half a metre, as text.
const MESH: &str = "solid body
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0.5 0 vertex 0.5 0 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0.5 0 0 vertex 0 0 0.5 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 0.5 vertex 0 0.5 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 0.5 0 0 vertex 0 0.5 0 vertex 0 0 0.5 endloop endfacet
endsolid body
";

#[test]
fn links_are_enclosed_by_the_meshes_of_packages_that_are_found_or_named() {
    let folder = TempDir::new().unwrap();
    let package = folder.path().join("arm_support");
    for below in ["urdf", "meshes"] {
        fs::create_dir_all(package.join(below)).unwrap();
    }
    let body = "<collision><geometry><mesh filename=\"package://arm_support/meshes/2.stl\"/></geometry></collision>";
    let links = ["base_link", "link_1", "link_2", "link_3", "link_4", "link_5"];
    let text = links.iter().fold(fs::read_to_string(EXAMPLE).unwrap(), |text, link| {
        text.replace(&format!("<link name=\"{link}\"/>"), &format!("<link name=\"{link}\">{body}</link>"))
    });
    let lines = [" outer", " vertex", " endloop", " endfacet"];
    let mesh = lines.iter().fold(MESH.to_owned(), |text, word| text.replace(word, &word.replace(' ', "\n")));
    fs::write(package.join("meshes/2.stl"), mesh).unwrap();
    let urdf = package.join("urdf/arm.urdf").to_str().unwrap().to_owned();
    fs::write(&urdf, text).unwrap();
    // Nothing makes a package of the folder yet.
    let (code, _, errors) = run(&["robots", "import", &urdf, "--meshes"]);
    assert!(code == 1 && errors.contains("--package arm_support=FOLDER"), "{errors}");
    let named = format!("arm_support={}", package.display());
    let (code, out, errors) = run(&["robots", "import", &urdf, "--meshes", "--package", &named]);
    assert!(code == 0 && out.contains("[[body.link]]\nlink = 2\ncapsules_mm = [["), "{errors}{out}");
    assert!(
        errors.contains("enclose the collision meshes")
            && errors.contains("2: ")
            && errors.contains("about 4 triangles"),
        "{errors}"
    );
    fs::write(package.join("package.xml"), "<package/>").unwrap();
    let file = folder.path().join("arm.toml").to_str().unwrap().to_owned();
    let (code, _, errors) = run(&["robots", "import", &urdf, "--meshes", "-o", &file]);
    assert_eq!(code, 0, "{errors}");
    let (code, out, _) = run(&["robots", "show", &file]);
    assert!(code == 0 && out.contains("links 0 to 6 enclosed by "), "{out}");
    let (code, out, _) = run(&["place", &file, "--task", "circle:0.2", "--model", "spatial"]);
    assert!(code == 0 && out.contains("links as capsules that enclose them"), "{out}");
    // What cannot be is refused.
    let (code, _, errors) = run(&["robots", "import", &urdf, "--package", &named]);
    assert!(code == 2 && errors.contains("--meshes"), "{errors}");
    let (code, _, errors) = run(&["robots", "import", &urdf, "--meshes", "--package", "arm_support"]);
    assert!(code == 2 && errors.contains("NAME=FOLDER"), "{errors}");
    fs::write(package.join("meshes/2.stl"), "<?xml version=\"1.0\"?><COLLADA/>").unwrap();
    let (code, _, errors) = run(&["robots", "import", &urdf, "--meshes"]);
    assert!(
        code == 1 && errors.contains("link base_link") && errors.contains("COLLADA") && errors.contains("hint: "),
        "{errors}"
    );
}
