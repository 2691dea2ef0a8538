//! Is nonsense refused with file, line, key, value and what was expected, at once and without a panic?

use std::f64::consts::PI;

use stiffarm::catalogue::{Faults, read};
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::limits::{Pendant, Verified};
use stiffarm::load::{Component, Load, LoadError};
use stiffarm::map::{Axis, MOST_CELLS, MapError, MapOptions};
use stiffarm::model::ModelError;
use stiffarm::place::{Orientation, PlaceError, PlaceOptions, Placed, Within};
use stiffarm::plane::{InvalidArm, PlanarArm};
use stiffarm::study::{Contender, StudyError, StudyOptions, study};
use stiffarm::task::Zone;

use crate::links::{map, over, place};

/// Six axes; the numbers on the right are the lines.
const SIX_AXES: &str = r#"name = "Test 6"
vendor = "Maker"
architecture = "serial"
status = "estimated"
payload_kg = 200
reach_m = 2.7

[geometry]
a1_mm = 350
a2_mm = -41
b_mm = 0
c1_mm = 675
c2_mm = 1150
c3_mm = 1200
c4_mm = 215
offset_deg = [0, -90, 0, 0, 0, 0]
sign = [-1, 1, 1, -1, 1, -1]

[limits]
joint_deg = [[-185, 185], [-140, -5], [-120, 155], [-350, 350], [-125, 125], [-350, 350]]
third_axis = "elbow"
elbow_deg = [20, 340]

[compliance]
drive_urad_per_nm = [1, 1, 1, 1, 1, 1]

[source]
geometry = "a data sheet"
"#;

const TWO_LINKS: &str = r#"name = "Test 2"
architecture = "quasi-serial"
status = "derived"

[planar]
l2_mm = 1000
l3_mm = 800
shoulder_deg = [0, 150]
elbow_deg = [-150, -10]
forearm_deg = [-120, 60]
k2_urad_per_nm = 1
k3_urad_per_nm = 2
"#;

/// The text with the line that begins with `start` replaced.
fn with(text: &str, start: &str, line: &str) -> String {
    let replaced: Vec<&str> = text.lines().map(|old| if old.starts_with(start) { line } else { old }).collect();
    let replaced = replaced.join("\n") + "\n";
    assert_ne!(text, replaced, "no line begins with {start}");
    replaced
}

/// The text without the line that begins with `start`.
fn without(text: &str, start: &str) -> String {
    let kept: String = text.lines().filter(|old| !old.starts_with(start)).map(|line| format!("{line}\n")).collect();
    assert_ne!(text, kept, "no line begins with {start}");
    kept
}

fn refused(text: &str) -> Faults {
    let Err(faults) = read(text, "robots/mine.toml") else { panic!("accepted:\n{}", &text[..text.len().min(2000)]) };
    assert!(!faults.faults.is_empty(), "refused without a reason");
    assert!(faults.faults.is_sorted_by_key(|fault| fault.line), "{faults}");
    // The first twenty are printed, and the others counted on one line more.
    let printed = faults.to_string().lines().filter(|line| line.starts_with("robots/mine.toml:")).count();
    assert_eq!(printed, faults.faults.len().min(21));
    faults
}

/// The one fault of a text: the line and key it names, and what its message says.
fn assert_fault(text: &str, line: usize, key: &str, says: &[&str]) {
    let faults = refused(text);
    assert_eq!(faults.faults.len(), 1, "one fault expected:\n{faults}");
    assert_eq!((faults.faults[0].line, faults.faults[0].key.as_str()), (line, key), "{faults}");
    let begins = format!("robots/mine.toml:{line}: {key}");
    assert!(faults.to_string().starts_with(&begins), "'{faults}' does not begin with '{begins}'");
    for part in says {
        assert!(faults.faults[0].message.contains(part), "'{faults}' does not say '{part}'");
    }
}

#[test]
fn the_texts_from_which_the_faulty_ones_are_made_are_robots() {
    assert_eq!(read(SIX_AXES, "mine.toml").unwrap().name, "Test 6");
    let soft = read(&with(SIX_AXES, "drive", "drive_urad_per_nm = [1, 2, 3, 4, 5, 6]"), "mine.toml").unwrap();
    let arm = soft.arm_plane().unwrap().arm;
    assert_eq!((arm.l2, arm.k2, arm.k3), (1.15, 2e-6, 3e-6));
    let two_links = read(TWO_LINKS, "mine.toml").unwrap();
    assert_eq!(two_links.name, "Test 2");
    // 1000 mm, 1 and 2 urad/(N m), 150 deg: in m, rad/(N m) and rad.
    let arm = two_links.arm_plane().unwrap().arm;
    assert_eq!((arm.l2, arm.l3, arm.k2, arm.k3), (1.0, 0.8, 1e-6, 2e-6));
    assert_eq!(arm.shoulder, Interval::spanning(0.0, 150_f64.to_radians()));
}

#[test]
fn a_number_that_no_robot_has_is_refused_with_line_key_value_and_range() {
    for (start, line, number, key, says) in [
        ("c2_mm", "c2_mm = -1150", 13, "geometry.c2_mm", &["-1150 mm", "20 to 10000 mm"][..]),
        ("c2_mm", "c2_mm = 0", 13, "geometry.c2_mm", &["0 mm", "20 to 10000 mm"]),
        ("c3_mm", "c3_mm = 0.0", 14, "geometry.c3_mm", &["0 mm", "20 to 10000 mm"]),
        ("c3_mm", "c3_mm = 1e9", 14, "geometry.c3_mm", &["1000000000 mm", "20 to 10000 mm"]),
        ("a1_mm", "a1_mm = -1e300", 9, "geometry.a1_mm", &["mm; expected -10000 to 10000 mm"]),
        ("c4_mm", "c4_mm = 1e400", 15, "geometry.c4_mm", &["inf mm", "10000 mm"]),
        ("c2_mm", "c2_mm = nan", 13, "geometry.c2_mm", &["NaN mm", "20 to 10000 mm"]),
        ("b_mm", "b_mm = inf", 11, "geometry.b_mm", &["inf mm", "10000 mm"]),
        ("c1_mm", "c1_mm = -inf", 12, "geometry.c1_mm", &["-inf mm", "-10000"]),
        ("payload_kg", "payload_kg = -5", 5, "payload_kg", &["-5 kg", "0.1 to 10000 kg"]),
        ("reach_m", "reach_m = 2700", 6, "reach_m", &["2700 m", "0.1 to 20 m"]),
        ("reach_m", "reach_m = nan", 6, "reach_m", &["NaN m", "0.1 to 20 m"]),
        ("offset_deg", "offset_deg = [0, -90, nan, 0, 0, 0]", 16, "geometry.offset_deg", &["NaN deg", "1080"]),
        ("offset_deg", "offset_deg = [0, 5e4, 0, 0, 0, 0]", 16, "geometry.offset_deg", &["50000 deg", "1080"]),
        ("elbow_deg", "elbow_deg = [-10, 160]", 22, "limits.elbow_deg", &["-10 deg", "0 to 360 deg"]),
        ("elbow_deg", "elbow_deg = [20, inf]", 22, "limits.elbow_deg", &["inf deg", "360"]),
        (
            "drive_urad_per_nm",
            "drive_urad_per_nm = [0, 0, 0, 0, 0, 0]",
            24,
            "compliance",
            &["every drive is rigid", "nothing to compute"],
        ),
        (
            "drive_urad_per_nm",
            "drive_urad_per_nm = [1, 1, -1, 1, 1, 1]",
            25,
            "compliance.drive_urad_per_nm",
            &["-1 urad", "0 to 10000"],
        ),
        (
            "drive_urad_per_nm",
            "drive_urad_per_nm = [1, 1, inf, 1, 1, 1]",
            25,
            "compliance.drive_urad_per_nm",
            &["inf urad", "10000"],
        ),
    ] {
        assert_fault(&with(SIX_AXES, start, line), number, key, says);
    }
    assert_fault(&with(TWO_LINKS, "l2_mm", "l2_mm = nan"), 6, "planar.l2_mm", &["NaN mm", "20 to 10000 mm"]);
    assert_fault(
        &with(TWO_LINKS, "k3", "k3_urad_per_nm = nan"),
        12,
        "planar.k3_urad_per_nm",
        &["NaN urad/(N m)", "10000"],
    );
}

#[test]
fn metres_where_millimetres_are_wanted_are_recognised() {
    assert_fault(
        &with(SIX_AXES, "c2_mm", "c2_mm = 1.15"),
        13,
        "geometry.c2_mm",
        &["1.15 mm", "if this is in m, write 1150"],
    );
    assert_fault(
        &with(SIX_AXES, "a2_mm", "a2_mm = -0.041"),
        10,
        "geometry.a2_mm",
        &["-0.041 mm", "if this is in m, write -41"],
    );
    assert_fault(
        &with(TWO_LINKS, "l2_mm", "l2_mm = 1.15"),
        6,
        "planar.l2_mm",
        &["1.15 mm", "if this is in m, write 1150"],
    );
}

#[test]
fn a_whole_robot_in_metres_is_recognised_and_a_short_offset_is_none() {
    let metres = [("a1", 0.35), ("a2", -4.1), ("c1", 0.675), ("c2", 1.15), ("c3", 1.2), ("c4", 0.215)];
    let mut text = SIX_AXES.to_owned();
    for (name, m) in metres {
        text = with(&text, &format!("{name}_mm"), &format!("{name}_mm = {m}"));
    }
    let faults = refused(&text);
    assert_eq!(faults.faults.len(), metres.len(), "{faults}");
    assert!(faults.faults.iter().all(|fault| fault.message.contains("if this is in m, write")), "{faults}");
    for mm in ["0.5", "-0.7", "1", "4.999"] {
        let robot = read(&with(SIX_AXES, "b_mm", &format!("b_mm = {mm}")), "robot.toml").expect("a true offset");
        let stiffarm::robot::Arm::SixAxis { geometry, .. } = robot.arm else { unreachable!("six axes") };
        assert_eq!(geometry.b, mm.parse::<f64>().unwrap() / 1e3);
    }
    let spring =
        "[compensator]\nbase_mm = [-0.5, 1.5]\narm_mm = [0, 3]\nstiffness_n_per_mm = 200\nfree_length_mm = 300\n";
    let faults = refused(&format!("{SIX_AXES}\n{spring}"));
    assert_eq!(faults.faults.len(), 3, "{faults}");
}

#[test]
fn a_compliance_in_rad_is_recognised() {
    let soft = with(SIX_AXES, "drive", "drive_urad_per_nm = [1, 1e-6, 1, 1, 1, 1]");
    assert_fault(&soft, 25, "compliance.drive_urad_per_nm", &["urad/(N m)", "if this is in rad/(N m), write 1"]);
    assert_fault(&with(TWO_LINKS, "k2", "k2_urad_per_nm = 2.5e-6"), 11, "planar.k2_urad_per_nm", &["write 2.5"]);
}

#[test]
fn limits_in_radians_are_recognised() {
    let limits = "joint_deg = [[-3.2, 3.2], [-2.4, -0.1], [-2.1, 2.7], [-3.4, 3.4], [-2.2, 2.2], [-3.4, 3.4]]";
    assert_fault(&with(SIX_AXES, "joint_deg", limits), 20, "limits.joint_deg", &["radians", "degrees"]);
}

#[test]
fn a_missing_key_is_named_with_its_table_and_what_it_holds() {
    // A missing key has no line of its own: that of its table stands for it, the first for the file.
    for (start, line, key, says) in [
        ("name", 1, "name", &["missing", "text in quotes"][..]),
        ("architecture", 1, "architecture", &["missing", "\"serial\" or \"quasi-serial\""]),
        ("status", 1, "status", &["missing", "\"identified\"", "\"estimated\""]),
        ("c2_mm", 8, "geometry.c2_mm", &["missing", "a number in mm"]),
        ("sign", 8, "geometry.sign", &["missing", "6 numbers"]),
        ("joint_deg", 19, "limits.joint_deg", &["missing", "6 times [min, max] in deg"]),
        ("drive", 24, "compliance.drive_urad_per_nm", &["missing", "6 numbers in urad/(N m)"]),
    ] {
        // The tables after a line that is gone stand one line higher.
        let above = usize::from(line == 19 && start != "joint_deg");
        assert_fault(&without(SIX_AXES, start), line - above, key, says);
    }
    assert_fault(&without(TWO_LINKS, "l3_mm"), 5, "planar.l3_mm", &["missing", "a number in mm"]);
    let no_limits: String = SIX_AXES.lines().take(18).map(|line| format!("{line}\n")).collect();
    let faults = refused(&no_limits);
    assert!(faults.faults.iter().any(|fault| fault.key == "limits" && fault.message.contains("missing")), "{faults}");
}

#[test]
fn an_unknown_key_is_answered_with_the_one_that_was_meant() {
    for (start, line, number, key, says) in [
        ("vendor", "vendro = \"Maker\"", 2, "vendro", "did you mean vendor?"),
        ("payload_kg", "payload = 200", 5, "payload", "did you mean payload_kg?"),
        ("third_axis", "third_axes = \"elbow\"", 21, "limits.third_axes", "did you mean third_axis?"),
        ("elbow_deg", "zzz = 1", 22, "limits.zzz", "expected joint_deg, third_axis, pendant, elbow_deg"),
        ("[compliance]", "[complaince]", 24, "complaince", "did you mean compliance?"),
    ] {
        assert_fault(&with(SIX_AXES, start, line), number, key, &["unknown key", says]);
    }
    // A key misspelt is also a key missing; both are said.
    let faults = refused(&with(SIX_AXES, "c2_mm", "c2_m = 1150"));
    let keys: Vec<&str> = faults.faults.iter().map(|fault| fault.key.as_str()).collect();
    assert_eq!(keys, ["geometry.c2_mm", "geometry.c2_m"], "{faults}");
    assert!(faults.faults[1].message.contains("did you mean c2_mm?"), "{faults}");
}

#[test]
fn what_the_pendant_shows_needs_a_source_or_readings_that_agree() {
    let as_file = with(SIX_AXES, "third_axis", "pendant = \"as-file\"");
    assert_fault(&as_file, 21, "limits.pendant", &["[source] pendant is missing", "[verified]"]);
    let sourced = with(&as_file, "geometry = ", "pendant = \"a manual\"");
    let said = |text: &str| read(text, "test.toml").unwrap().pendant().cloned().unwrap();
    assert_eq!(said(&sourced), Pendant::AsFile);
    assert_eq!(said(SIX_AXES), Pendant::Unknown);
    let verified = |rows: &str, date: &str, mm: &str| {
        format!("{SIX_AXES}\n[verified]\nrows = {rows}\ndate = \"{date}\"\nlargest_mm = {mm}\n")
    };
    let agreed = Verified { rows: 6, date: "2026-05-31".into(), largest: 0.02e-3 };
    assert_eq!(said(&verified("6", "2026-05-31", "0.02")), Pendant::Verified(agreed));
    assert_fault(&verified("2", "2026-05-31", "0.02"), 31, "verified.rows", &["expected 3"]);
    assert_fault(&verified("6", "2026-02-31", "0.02"), 32, "verified.date", &["is no date"]);
    assert_fault(&verified("6", "2026-05-31", "0.2"), 33, "verified.largest_mm", &["0.2 mm", "0.05"]);
    let both = verified("6", "2026-05-31", "0.02").replace("third_axis = \"elbow\"", "pendant = \"unknown\"");
    assert_fault(&both, 21, "limits.pendant", &["[verified] says"]);
}

#[test]
fn a_range_the_wrong_way_round_is_refused() {
    let limits = "joint_deg = [[-185, 185], [-5, -140], [-120, 155], [-350, 350], [-125, 125], [-350, 350]]";
    assert_fault(
        &with(SIX_AXES, "joint_deg", limits),
        20,
        "limits.joint_deg",
        &["[-5, -140]", "lower end", "upper end"],
    );
    assert_fault(&with(TWO_LINKS, "elbow", "elbow_deg = [-10, -150]"), 9, "planar.elbow_deg", &["[-10, -150]"]);
}

#[test]
fn a_list_of_the_wrong_length_is_refused_with_both_numbers() {
    let five = "joint_deg = [[-185, 185], [-140, -5], [-120, 155], [-350, 350], [-125, 125]]";
    assert_fault(&with(SIX_AXES, "joint_deg", five), 20, "limits.joint_deg", &["5 values", "expected 6"]);
    assert_fault(&with(SIX_AXES, "joint_deg", "joint_deg = []"), 20, "limits.joint_deg", &["0 values", "expected 6"]);
    assert_fault(
        &with(SIX_AXES, "sign", "sign = [1, 1, 1, 1, 1, 1, 1]"),
        17,
        "geometry.sign",
        &["7 values", "expected 6"],
    );
    assert_fault(&with(SIX_AXES, "elbow_deg", "elbow_deg = [20]"), 22, "limits.elbow_deg", &["1 values", "expected 2"]);
    let triple = "joint_deg = [[-185, 0, 185], [-140, -5], [-120, 155], [-350, 350], [-125, 125], [-350, 350]]";
    assert_fault(&with(SIX_AXES, "joint_deg", triple), 20, "limits.joint_deg", &["3 values", "expected 2"]);
}

#[test]
fn a_sign_that_is_none_is_refused() {
    for sign in ["0.5", "0", "-0.999"] {
        let line = format!("sign = [-1, {sign}, 1, -1, 1, -1]");
        assert_fault(&with(SIX_AXES, "sign", &line), 17, "geometry.sign", &["expected six times 1 or -1"]);
    }
    assert_fault(&with(SIX_AXES, "sign", "sign = [-1, 2, 1, -1, 1, -1]"), 17, "geometry.sign", &["2", "-1 to 1"]);
}

#[test]
fn a_value_of_the_wrong_type_is_refused_with_what_it_is_and_what_was_expected() {
    for (start, line, number, key, says) in [
        ("c2_mm", "c2_mm = \"1150\"", 13, "geometry.c2_mm", &["\"1150\" is not a number", "mm"][..]),
        ("c2_mm", "c2_mm = true", 13, "geometry.c2_mm", &["true is not a number"]),
        ("c2_mm", "c2_mm = [1150]", 13, "geometry.c2_mm", &["a list is not a number"]),
        ("c2_mm", "c2_mm = {}", 13, "geometry.c2_mm", &["a table is not a number"]),
        ("c2_mm", "c2_mm = 2020-01-01", 13, "geometry.c2_mm", &["a date is not a number"]),
        ("c2_mm", "c2_mm = 0x47E", 13, "geometry.c2_mm", &["47E is not a number"]),
        ("c2_mm", "c2_mm = 0o2176", 13, "geometry.c2_mm", &["2176 is not a number"]),
        ("sign", "sign = 1", 17, "geometry.sign", &["1 is not a list", "6 values"]),
        (
            "offset_deg",
            "offset_deg = [0, \"-90\", 0, 0, 0, 0]",
            16,
            "geometry.offset_deg",
            &["\"-90\" is not a number"],
        ),
        ("joint_deg", "joint_deg = \"all\"", 20, "limits.joint_deg", &["\"all\" is not a list", "6 values"]),
        ("name", "name = 6", 1, "name", &["expected a text in quotes"]),
        ("name", "name = \"  \"", 1, "name", &["not empty"]),
        ("vendor", "vendor = [\"Maker\"]", 2, "vendor", &["expected a text in quotes"]),
        (
            "architecture",
            "architecture = \"paralel\"",
            3,
            "architecture",
            &["\"paralel\" is not known", "\"serial\" or \"quasi-serial\""],
        ),
        ("architecture", "architecture = 1", 3, "architecture", &["1 is not known", "\"serial\""]),
        ("status", "status = \"measured\"", 4, "status", &["\"measured\" is not known", "\"identified\""]),
        (
            "third_axis",
            "third_axis = \"wrist\"",
            21,
            "limits.third_axis",
            &["\"wrist\" is not known", "\"elbow\" or \"forearm\""],
        ),
        ("geometry = ", "geometry = 7", 28, "source.geometry", &["expected a text in quotes"]),
    ] {
        assert_fault(&with(SIX_AXES, start, line), number, key, says);
    }
    let faults = refused("name = \"x\"\narchitecture = \"serial\"\nstatus = \"derived\"\nplanar = 3\n");
    assert!(
        faults.faults.iter().any(|f| f.line == 4 && f.key == "planar" && f.message.contains("expected a table")),
        "{faults}"
    );
}

#[test]
fn a_robot_has_either_two_links_or_six_axes() {
    let both = format!("{TWO_LINKS}\n{}", &SIX_AXES[SIX_AXES.find("[geometry]").unwrap()..]);
    let faults = refused(&both);
    for (line, key) in [(14, "geometry"), (25, "limits"), (30, "compliance")] {
        let named = faults.faults.iter().find(|fault| fault.key == key);
        assert!(named.is_some_and(|fault| fault.line == line && fault.message.contains("[planar]")), "{key}: {faults}");
    }
    let neither: String = TWO_LINKS.lines().take(3).map(|line| format!("{line}\n")).collect();
    assert_fault(&neither, 1, "", &["neither [geometry] with [limits] nor [planar]"]);
}

#[test]
fn limits_that_leave_nothing_reachable_are_refused() {
    // The forearm would have to turn counter-clockwise from the upper arm, the elbow only turns clockwise.
    let torn = with(TWO_LINKS, "forearm", "forearm_deg = [160, 200]");
    let faults = refused(&torn);
    assert!(faults.to_string().contains("planar") && faults.to_string().contains("nothing reachable"), "{faults}");
    // KUKA's A3 in [-120, 155] leaves 25 to 300 deg between the links.
    let closed = with(SIX_AXES, "elbow_deg", "elbow_deg = [310, 340]");
    let faults = refused(&closed);
    assert!(faults.to_string().contains("limits") && faults.to_string().contains("nothing reachable"), "{faults}");
}

#[test]
fn broken_toml_is_refused_at_the_line_where_it_breaks() {
    for (text, line) in [
        (with(SIX_AXES, "c2_mm", "c2_mm = "), 13),
        (with(SIX_AXES, "c2_mm", "c2_mm 1150"), 13),
        (with(SIX_AXES, "c2_mm", "c2_mm = 1150 1150"), 13),
        (with(SIX_AXES, "c2_mm", "c2_mm = 1.2.3"), 13),
        (with(SIX_AXES, "name", "name = \"Test"), 1),
        (with(SIX_AXES, "[limits]", "[limits"), 19),
        (with(SIX_AXES, "b_mm", "a1_mm = 350"), 11),
        (with(SIX_AXES, "[compliance]", "[geometry]"), 24),
        (with(SIX_AXES, "vendor", "vendor = 'a\u{0}b'"), 2),
        (with(SIX_AXES, "vendor", "\u{1b}[31mvendor = 'x'"), 2),
    ] {
        let faults = refused(&text);
        assert_eq!(faults.faults[0].line, line, "{faults}");
        assert!(!faults.faults[0].message.is_empty());
    }
}

#[test]
fn an_empty_file_lacks_everything_a_robot_needs() {
    for text in ["", "\n\n", "# nothing\n", "\u{feff}"] {
        let faults = refused(text);
        for key in ["name", "architecture", "status"] {
            assert!(
                faults.faults.iter().any(|fault| fault.key == key && fault.message.contains("missing")),
                "{faults}"
            );
        }
        assert!(faults.to_string().contains("neither [geometry]"), "{faults}");
    }
}

#[test]
fn letters_of_all_the_world_are_kept_and_faults_behind_them_have_the_right_line() {
    let umlaut = with(SIX_AXES, "name", "name = \"\u{534e}\u{4e2d} R\u{f6}bi \u{1f9be}\"");
    assert_eq!(read(&umlaut, "mine.toml").unwrap().name, "\u{534e}\u{4e2d} R\u{f6}bi \u{1f9be}");
    assert_fault(&with(&umlaut, "c2_mm", "c2_mm = 1.15"), 13, "geometry.c2_mm", &["write 1150"]);
    let wide = format!("architecture = \"{}\"", "\u{1f9be}".repeat(500));
    assert_fault(&with(SIX_AXES, "architecture", &wide), 3, "architecture", &["is not known", "\"serial\""]);
    // A mark that turns the reading direction round is shown as what it is.
    let strange = with(SIX_AXES, "payload_kg", "\"\u{202e}\u{1f9be}\" = 1");
    assert_fault(&strange, 5, "\\u{202e}\u{1f9be}", &["unknown key"]);
    let windows = with(SIX_AXES, "c2_mm", "c2_mm = 1.15").replace('\n', "\r\n");
    assert_fault(&windows, 13, "geometry.c2_mm", &["write 1150"]);
}

#[test]
fn deep_nesting_and_large_files_are_refused_at_once() {
    for text in [
        format!("name = {}", "[".repeat(100_000)),
        format!("name = {}1{}", "[".repeat(100_000), "]".repeat(100_000)),
        format!("name = {}1{}", "{a=".repeat(100_000), "}".repeat(100_000)),
        format!("{}name = 1", "a.".repeat(100_000)),
        format!("[{}a]\n", "a.".repeat(100_000)),
    ] {
        assert!(refused(&text).faults[0].message.len() < 1000);
    }
    let long = format!("{SIX_AXES}\n# {}\n", "x".repeat(2 << 20));
    assert_fault(&long, 1, "", &[&long.len().to_string(), "1048576"]);
    // Many faults in a file of a permitted size.
    let many: String = (0..50_000).map(|i| format!("k{i} = 1\n")).collect();
    assert_eq!(refused(&many).faults.len(), 50_004);
}

#[test]
fn several_faults_are_all_reported_in_the_order_of_the_lines() {
    let text = with(SIX_AXES, "sign", "sign = [-1, 1, 1, -1, 1, 0.5]");
    let text = with(&text, "c2_mm", "c2_mm = 1.15");
    let text = with(&text, "elbow_deg", "elbow_deg = [160, 20]");
    let text = with(&text, "status", "status = \"sure\"");
    let text = with(&text, "vendor", "vendor = 3");
    let text = with(&text, "geometry = ", "geometry = 7");
    let text = with(&text, "drive", "drive_urad_per_nm = [1, nan, inf, 1, 1, 1]");
    let faults = refused(&text);
    let found: Vec<(usize, &str)> = faults.faults.iter().map(|fault| (fault.line, fault.key.as_str())).collect();
    assert_eq!(
        found,
        [
            (2, "vendor"),
            (4, "status"),
            (13, "geometry.c2_mm"),
            (17, "geometry.sign"),
            (22, "limits.elbow_deg"),
            (25, "compliance.drive_urad_per_nm"),
            (25, "compliance.drive_urad_per_nm"),
            (28, "source.geometry"),
        ]
    );
    assert_eq!(faults.to_string().lines().count(), 8);
}

// What programs may pass directly.

const NONSENSE: [f64; 6] = [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300];

fn free() -> PlanarArm {
    PlanarArm::free(1.0, 0.8, 1e-6, 1e-6, Architecture::Serial)
}

fn limited() -> PlanarArm {
    PlanarArm {
        shoulder: Interval::spanning(0.2, 2.5),
        elbow: Interval::spanning(-2.4, -0.3),
        forearm: Interval::spanning(-1.8, 1.0),
        ..free()
    }
}

const CIRCLE: Zone = Zone::Circle { diameter: 0.3 };
const RECTANGLE: Zone = Zone::Rectangle { width: 0.2, height: 0.4 };

fn axis(count: usize) -> Axis {
    Axis::between(-2.0, 2.0, count)
}

fn asked(count: usize) -> MapOptions {
    over(axis(count), axis(count), Load::PAPER, None)
}

#[test]
fn a_force_gap_or_angle_that_makes_no_sense_is_refused_with_its_value() {
    for nonsense in NONSENSE {
        let refused = Load::worst(nonsense).unwrap_err();
        assert!(matches!(refused, LoadError::Force(x) if x.to_bits() == nonsense.to_bits()), "{refused:?}");
        assert!(refused.to_string().contains(&nonsense.to_string()), "{refused}");
        let gap = place(&free(), CIRCLE, &PlaceOptions { gap: Some(nonsense), ..PlaceOptions::under(Load::UNIT) })
            .unwrap_err();
        assert!(matches!(gap, PlaceError::Gap(_)) && gap.to_string().contains(&nonsense.to_string()), "{gap:?}");
    }
    for nonsense in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let turned = PlaceOptions { orientation: Orientation::Fixed(nonsense), ..PlaceOptions::under(Load::UNIT) };
        assert!(matches!(place(&free(), RECTANGLE, &turned), Err(PlaceError::Angle(_))));
        for component in [Component::Total, Component::Along] {
            assert!(matches!(Load::in_plane(1.0, nonsense, component), Err(LoadError::Direction(_))));
        }
    }
}

#[test]
fn lengths_and_compliances_that_make_no_sense_are_refused_with_name_and_value() {
    for nonsense in NONSENSE {
        for (name, arm) in [
            ("l2", PlanarArm { l2: nonsense, ..limited() }),
            ("l3", PlanarArm { l3: nonsense, ..limited() }),
            ("k2", PlanarArm { k2: nonsense, ..limited() }),
            ("k3", PlanarArm { k3: nonsense, ..limited() }),
        ] {
            if nonsense == 0.0 && name.starts_with('k') {
                continue; // a rigid drive
            }
            let placed = place(&arm, CIRCLE, &PlaceOptions::under(Load::UNIT)).unwrap_err();
            let PlaceError::Model(ModelError::Arm(InvalidArm::Quantity { quantity, value, .. })) = placed else {
                panic!("{placed:?}")
            };
            assert_eq!((quantity, value.to_bits()), (name, nonsense.to_bits()));
            let mapped = map(&arm, &asked(3)).unwrap_err();
            assert!(matches!(mapped, MapError::Model(ModelError::Arm(InvalidArm::Quantity { .. }))), "{mapped:?}");
            assert!(
                mapped.to_string().starts_with(name) && mapped.to_string().contains("expected a number from"),
                "{mapped}"
            );
        }
    }
}

#[test]
fn a_zone_with_a_side_that_makes_no_sense_is_refused_or_has_no_place() {
    for nonsense in NONSENSE {
        for zone in [
            Zone::Circle { diameter: nonsense },
            Zone::Rectangle { width: nonsense, height: 0.2 },
            Zone::Rectangle { width: 0.2, height: nonsense },
            Zone::Rectangle { width: nonsense, height: nonsense },
        ] {
            for arm in [free(), limited()] {
                for orientation in [Orientation::Axes, Orientation::Fixed(0.4), Orientation::Free] {
                    let placed = place(&arm, zone, &PlaceOptions { orientation, ..PlaceOptions::under(Load::UNIT) });
                    assert!(!matches!(placed, Ok(Placed::Feasible(_))), "{zone:?}: {placed:?}");
                }
            }
        }
    }
}

#[test]
fn a_map_that_is_too_large_or_none_is_refused_before_memory_is_taken() {
    // 10^12 cells of 8 bytes are more memory than the test has; the last product does not fit a number.
    for (x, z) in [
        (1_000_000, 1_000_000),
        (MOST_CELLS, 2),
        (2, MOST_CELLS),
        (usize::MAX, usize::MAX),
        (0, 5),
        (5, 0),
        (1, 5),
        (5, 1),
    ] {
        let count = |count| Axis { start: -2.0, step: 0.1, count };
        let refused = map(&free(), &over(count(x), count(z), Load::PAPER, None)).unwrap_err();
        assert_eq!(refused, MapError::Size { columns: x, rows: z, most: MOST_CELLS });
        assert!(
            refused.to_string().contains(&format!("{x} x {z}"))
                && refused.to_string().contains(&MOST_CELLS.to_string())
        );
    }
}

#[test]
fn a_grid_that_is_not_finite_or_does_not_advance_is_refused() {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for (start, step) in odd.map(|x| (x, 0.1)).into_iter().chain(odd.map(|x| (0.0, x))).chain([(0.0, 0.0), (0.0, -0.1)])
    {
        let bad = Axis { start, step, count: 5 };
        for options in [over(bad, axis(5), Load::PAPER, None), over(axis(5), bad, Load::PAPER, None)] {
            assert!(matches!(map(&limited(), &options), Err(MapError::Grid { .. })), "{start} {step}");
        }
    }
}

#[test]
fn a_grid_far_beyond_the_arm_is_blank() {
    for (start, step) in [(1e300, 1e299), (-1e308, 1e307), (1e6, 1.0)] {
        let far = Axis { start, step, count: 7 };
        for load in [Load::PAPER, Load::in_plane(1000.0, 0.3, Component::Along).unwrap()] {
            let blank = map(&limited(), &over(far, far, load, None)).unwrap();
            assert!(blank.extremes().is_none(), "{start} {step}");
        }
    }
}

#[test]
fn a_range_is_made_of_two_numbers_in_order() {
    for (min, max) in
        [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::NAN), (f64::NAN, f64::NAN), (f64::INFINITY, f64::NEG_INFINITY)]
    {
        assert!(Interval::new(min, max).is_none(), "{min} {max}");
    }
}

#[test]
fn a_joint_that_cannot_move_leaves_no_place_for_a_zone() {
    for angle in [-0.7, 0.0, 1.0] {
        let still = Interval::point(angle);
        for arm in [
            PlanarArm { shoulder: still, ..free() },
            PlanarArm { elbow: still, ..free() },
            PlanarArm { forearm: still, ..free() },
        ] {
            let coarse = PlaceOptions { gap: Some(0.1), ..PlaceOptions::under(Load::UNIT) };
            let placed = place(&arm, CIRCLE, &coarse);
            assert!(!matches!(placed, Ok(Placed::Feasible(_))), "{placed:?}");
            let line = map(&arm, &asked(40));
            // What is reached is an arc, which a grid meets by chance only.
            assert!(line.is_err() || line.unwrap().extremes().is_none());
        }
    }
}

#[test]
fn limits_that_span_many_turns_are_no_limits() {
    let wide = |half: f64| Interval::spanning(-half, half);
    let turning = PlanarArm { shoulder: wide(40.0 * PI), elbow: wide(6.0 * PI), forearm: wide(40.0 * PI), ..free() };
    for zone in [CIRCLE, RECTANGLE] {
        let options = PlaceOptions::under(Load::PAPER);
        let (a, b) = (place(&free(), zone, &options).unwrap(), place(&turning, zone, &options).unwrap());
        let [a, b] = [a, b].map(|placed| placed.feasible().unwrap().deflection);
        // Both are exact but for the gap.
        assert!((a - b).abs() <= 1e-4 * a, "{a} {b}");
    }
    let [a, b] = [free(), turning].map(|arm| map(&arm, &asked(101)).unwrap());
    for j in 0..101 {
        assert!(a.row(j).eq(b.row(j)), "row {j}");
    }
}

#[test]
fn a_place_that_must_stand_beyond_everything_is_none() {
    for x in
        [Interval::spanning(5.0, 6.0), Interval::spanning(1e300, 1e301), Interval::new(1e9, f64::INFINITY).unwrap()]
    {
        for orientation in [Orientation::Axes, Orientation::Fixed(0.4), Orientation::Free] {
            let within = Within { x, z: Interval::ALL };
            let placed = place(
                &limited(),
                RECTANGLE,
                &PlaceOptions { within: Some(within), orientation, ..PlaceOptions::under(Load::UNIT) },
            )
            .unwrap();
            assert!(placed.feasible().is_none(), "{x:?} {placed:?}");
        }
    }
    let line = Within { x: Interval::point(0.9), z: Interval::ALL };
    let placed =
        place(&limited(), RECTANGLE, &PlaceOptions { within: Some(line), ..PlaceOptions::under(Load::UNIT) }).unwrap();
    assert!(placed.feasible().is_none(), "{placed:?}");
}

#[test]
fn a_study_of_nonsense_is_refused_with_what_is_meant() {
    let paper = StudyOptions::paper;
    for nonsense in NONSENSE {
        let soft = Contender { k2: nonsense, ..Contender::equal(Architecture::Serial) };
        for options in [
            StudyOptions { ratios: vec![1.0, nonsense], ..paper() },
            StudyOptions { sizes: vec![0.1, nonsense], ..paper() },
            StudyOptions { contenders: [soft, soft], ..paper() },
        ] {
            if options.contenders[0].k2 == 0.0 {
                continue; // a rigid drive
            }
            let refused = study(&options).unwrap_err();
            assert!(matches!(refused, StudyError::Quantity { .. }), "{refused:?}");
            let says = refused.to_string();
            assert!(says.contains(&nonsense.to_string()) && says.contains("expected a number from"), "{says}");
        }
    }
    assert!(study(&StudyOptions { range: Interval::ALL, ..paper() }).is_err());
    let large = StudyOptions { sizes: vec![0.1; 10_000], ratios: vec![1.0; 10_000], ..paper() };
    assert!(matches!(study(&large), Err(StudyError::Size(_))));
}
