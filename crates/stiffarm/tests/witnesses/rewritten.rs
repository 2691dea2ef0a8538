//! Does a toolpath that is led elsewhere read back to where it was led, and does everything else in its file stay?

use std::fs;
use std::io::{self, Write};

use nalgebra::Vector3;
use stiffarm::toolpath::{
    Course, CutterCompensation, Format, IncrementalCycles, Move, MoveKind, Original, PathFault, ReadOptions, Rewriting,
    Rewritten, Rotary, Sample, Steps, ToolPose, read, rewrite, samples,
};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../paths");

/// 0.01 mm of chord, 1 um between samples, and what rounding to 0.1 um in three axes adds.
const KEEPS: f64 = 1e-5 + 1e-6 + 2e-7;

const STEPS: Steps = Steps { chord: 1e-5, longest: 0.002, turn: 0.01 };

fn how(remarks: &[String]) -> Rewriting<'_> {
    Rewriting { steps: STEPS, straight: 1e-6, remarks }
}

fn path(text: &str, format: Format, options: &ReadOptions) -> Vec<Move> {
    let mut moves = Vec::new();
    read(&mut text.as_bytes(), "p", format, options, &mut |one| moves.push(*one), &mut |_| Ok(()))
        .unwrap_or_else(|why| panic!("{why}\n{text}"));
    moves
}

type Field = fn(Vector3<f64>) -> Vector3<f64>;

const NOWHERE: Field = |_| Vector3::zeros();
const ASIDE: Field = |_| Vector3::new(5e-5, -3e-5, 2e-5);
const TURNED: Field = |p| 0.002 * Vector3::new(p.y, -p.x, 0.0);
fn is_nowhere(field: Field) -> bool {
    field(Vector3::new(0.012, 0.034, 0.056)) == Vector3::zeros()
}

/// 0.1 mm up and down every 60 mm: straight lines do not stay straight.
const WAVES: Field = |p| Vector3::new(0.0, 1e-5, 1e-4 * (p.x * 100.0).sin() + 1e-4 * (p.y * 100.0).cos());

fn written(text: &str, format: Format, options: &ReadOptions, field: Field) -> Result<(String, Rewritten), PathFault> {
    written_by(&how(&[]), text, format, options, field)
}

/// Straight moves that are sampled at their ends only.
fn by_ends(text: &str, format: Format, field: Field) -> String {
    let how = Rewriting { steps: Steps { longest: 1.0, ..STEPS }, ..how(&[]) };
    written_by(&how, text, format, &asked(), field).unwrap_or_else(|why| panic!("{why}\n{text}")).0
}

fn written_by(
    how: &Rewriting,
    text: &str,
    format: Format,
    options: &ReadOptions,
    field: Field,
) -> Result<(String, Rewritten), PathFault> {
    let original = Original { input: &mut text.as_bytes(), file: "p", format, options };
    let mut output = Vec::new();
    let mut corrected = |sample: &Sample| ToolPose { tip: sample.pose.tip + field(sample.pose.tip), ..sample.pose };
    let rewritten = rewrite(original, &mut output, how, &mut corrected, &mut |_| Ok(()))?;
    Ok((String::from_utf8(output).expect("text"), rewritten))
}

/// Led elsewhere, and checked: each feed move that goes on from another one lies where the field puts it, and nothing else does.
fn led(text: &str, format: Format, options: &ReadOptions, field: Field) -> (String, Rewritten) {
    let (output, rewritten) = written(text, format, options, field).unwrap_or_else(|why| panic!("{why}\n{text}"));
    let (before, after) = (path(text, format, options), path(&output, format, options));
    assert!(after.iter().all(|one| one.kind == MoveKind::Rapid || one.course == Course::Line), "{output}");
    let feeds: Vec<&Move> = after.iter().filter(|one| one.kind == MoveKind::Feed).collect();
    let mut put = Vec::new();
    for (i, one) in before.iter().enumerate().filter(|(_, one)| one.kind == MoveKind::Feed) {
        let last = i.checked_sub(1).map(|last| before[last]);
        // A table and APT begin where their first row or statement is; that stays where the tool was not led before.
        let is_led = last.is_some() || is_nowhere(field);
        let found: Vec<Sample> = samples(one, &STEPS, 0.0).collect();
        let from = if is_led { 0 } else { found.len() - 1 };
        put.extend(found[from..].iter().map(|sample| (sample.pose.tip + field(sample.pose.tip), one.feed)));
    }
    for (p, feed) in &put {
        let nearest = feeds
            .iter()
            .filter(|one| close_speeds(one.feed, *feed))
            .map(|one| to_segment(p, one))
            .fold(f64::INFINITY, f64::min);
        assert!(nearest <= KEEPS, "{p} is {nearest} m off\n{output}");
    }
    let length =
        |moves: &[Move]| -> f64 { moves.iter().filter(|one| one.kind == MoveKind::Feed).map(Move::length).sum() };
    // Chords that are off an arc of 2 mm by 0.01 mm are shorter by 0.2 %; from where a rapid move ends it is as far as the field leads to the
    // corrected beginning of the cut, under 1 % of these short files.
    let grows = length(&after) / length(&before) - 1.0;
    assert!(-5e-3 < grows && grows < 1e-2, "{grows}\n{output}");
    (output, rewritten)
}

fn close_speeds(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a / b - 1.0).abs() < 1e-3,
        (a, b) => a == b,
    }
}

fn to_segment(p: &Vector3<f64>, one: &Move) -> f64 {
    let along = one.to.tip - one.from.tip;
    let t = ((p - one.from.tip).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (one.from.tip + if t.is_finite() { t } else { 0.0 } * along - p).norm()
}

fn asked() -> ReadOptions {
    ReadOptions::default()
}

fn gcode(text: &str, field: Field) -> (String, Rewritten) {
    led(text, Format::GCode, &asked(), field)
}

/// The lines of a rewritten file without the two of its head.
fn body(output: &str) -> Vec<&str> {
    output
        .lines()
        .filter(|line| !line.starts_with("(Feed moves are") && !line.starts_with("(Rapid moves and"))
        .collect()
}

fn files() -> Vec<(&'static str, ReadOptions)> {
    let columns = ["-", "x_mm", "y_mm", "z_mm", "nx", "ny", "nz"].map(str::to_owned).to_vec();
    let cycles = ReadOptions { incremental_cycles: Some(IncrementalCycles::FromInitial), ..asked() };
    let nist = ReadOptions { incremental_cycles: Some(IncrementalCycles::Nist), ..asked() };
    vec![
        ("contour_ij.nc", asked()),
        ("helix_full_circles.nc", asked()),
        ("planes_g17_g18_g19.nc", asked()),
        ("drill_g81_g91.nc", cycles),
        ("canned_cycles_c3.ngc", nist),
        ("thread_mill_g91_g42_inch.gcode", ReadOptions { cutter_compensation: CutterCompensation::Centre, ..asked() }),
        ("own_nx_contour.cls", asked()),
        ("own_sw_contour.apt", asked()),
        ("puzzle_bent_head.csv", ReadOptions { columns, ..asked() }),
    ]
}

#[test]
fn nothing_but_arcs_changes_in_files_that_are_led_nowhere_else() {
    for (name, options) in files() {
        let text = fs::read_to_string(format!("{FOLDER}/{name}")).expect("a file of the tests");
        let format = Format::of_name(name).expect("a known ending");
        let (output, rewritten) = led(&text, format, &options, NOWHERE);
        let arcs: Vec<usize> =
            path(&text, format, &options).iter().filter(|one| one.course != Course::Line).map(|one| one.line).collect();
        assert_eq!(rewritten.arcs, arcs.len(), "{name}");
        // Every line without an arc comes, byte by byte and in its order, and none of them twice.
        let mut rest = output.split_inclusive('\n');
        for (i, line) in text.split_inclusive('\n').enumerate() {
            if !arcs.contains(&(i + 1)) && !line.starts_with("CIRCLE") {
                assert!(rest.any(|other| other == line), "{name}: {line}");
            }
        }
        assert!(rewritten.aside <= 1e-7 && rewritten.turn_lost < 1e-9, "{name}: {rewritten:?}");
        if arcs.is_empty() {
            let head = if format == Format::Csv { 0 } else { 2 };
            assert_eq!((rewritten.changed, rewritten.added), (0, head), "{name}");
            assert_eq!(output.len() - text.len() == 0, head == 0, "{name}");
        }
    }
}

#[test]
fn files_that_are_led_elsewhere_read_back_to_where_they_were_led() {
    for field in [ASIDE, TURNED, WAVES] {
        for (name, options) in files() {
            // Cycles are not led elsewhere.
            if !name.starts_with("drill") && !name.starts_with("canned") {
                let text = fs::read_to_string(format!("{FOLDER}/{name}")).expect("a file of the tests");
                let (_, rewritten) = led(&text, Format::of_name(name).expect("a known ending"), &options, field);
                assert!(0 < rewritten.changed, "{name}");
            }
        }
    }
}

#[test]
fn drilling_cycles_stay_as_they_are_and_are_counted() {
    let text = fs::read_to_string(format!("{FOLDER}/drill_g81_g91.nc")).unwrap();
    let options = ReadOptions { incremental_cycles: Some(IncrementalCycles::FromInitial), ..asked() };
    let (output, rewritten) = written(&text, Format::GCode, &options, ASIDE).unwrap();
    assert_eq!((rewritten.of_cycles, rewritten.changed), (12, 0));
    assert_eq!(body(&output), text.lines().collect::<Vec<_>>());
}

#[test]
fn words_change_where_they_stand_and_missing_ones_come_behind_them() {
    let output =
        by_ends("%\nO1 (A)\nG21 G90\nG0 X0 Y0 Z5\nN7 g1 x10. F600 (go) M8\nY20\nG0 Z5\nM30\n%\n", Format::GCode, ASIDE);
    let expected = "%\nO1 (A)\n(Feed moves are corrected. Arcs are straight moves, off by at most 0.0110 mm)\n\
        (Rapid moves and drilling cycles are not corrected, from where a rapid move ends a feed move leads to the corrected path)\nG21 G90\nG0 X0 Y0 Z5\n\
        N7 g1 x0.05 Y-0.03 Z5.02 F600 (go) M8\nX10.05\nY19.97\nG0 Z5\nM30\n%\n";
    assert_eq!(output, expected);
    let output = by_ends("G20G90G0X0Y0Z1\nG1X1.F10\nZ0\n", Format::GCode, ASIDE);
    // 50, -30 and 20 um in inches.
    assert_eq!(body(&output), ["G20G90G0X0Y0Z1", "G1X0.00197Y-0.00118Z1.00079F10", "X1.00197", "Z0.00079"]);
}

#[test]
fn what_follows_an_arc_by_its_mode_is_said_anew() {
    // Modal arcs, a motion word alone in its block, a full circle without X Y, a straight move behind.
    let text =
        "G21 G90 G0 X0 Y0 Z0\nG1 X10 F600\nG3 X20 Y10 I0 J10\nX10 Y20 I-10 J0\nG2 F500\nI0 J-5\nG1 X0 Y0\nG2X10Y0R5\n";
    for field in [NOWHERE, ASIDE, TURNED, WAVES] {
        let (output, rewritten) = gcode(text, field);
        assert_eq!(rewritten.arcs, 4);
        let after: Vec<&str> = output.lines().skip_while(|line| *line != "G2 F500").skip(1).collect();
        assert!(after[0].contains("G1"), "{output}");
        assert!(body(&output).iter().all(|line| !line.contains(['I', 'J', 'R']) && !line.contains("G3")), "{output}");
    }
}

#[test]
fn codes_that_act_behind_a_motion_stay_behind_it_and_skipped_blocks_are_skipped_whole() {
    let text = "G21 G90 G0 X0 Y0 Z0\n/2 N10 M8 G2 X10 Y0 I5 J0 F600 M5 (arc) M30\n";
    let (output, rewritten) = gcode(text, NOWHERE);
    let lines = body(&output);
    assert!(lines[1].starts_with("/2 N10 M8 G1 X0.") && lines[1].ends_with("F600 (arc)"), "{output}");
    assert!(lines[2..].iter().all(|line| line.starts_with("/2 X")), "{output}");
    assert!(lines.last().unwrap().starts_with("/2 X10.0 Y0.0 M5 M30"), "{output}");
    assert_eq!(rewritten.changed, 1);
    assert_eq!(lines.len(), 2 + rewritten.added - 2);
}

#[test]
fn differences_count_from_where_the_machine_stands() {
    let text = "G21 G90 G0 X0 Y0 Z0\nG91\nG1 X10 F600\nY10\nG3 X-10 Y10 I-10 J0\nG0 X5\nG1 X5\nX-1\nX-1\nX-1\n";
    for field in [NOWHERE, ASIDE, TURNED, WAVES] {
        let (output, rewritten) = gcode(text, field);
        let ends = [text, &output].map(|text| path(text, Format::GCode, &asked()).last().unwrap().to.tip);
        assert!((ends[0] + field(ends[0]) - ends[1]).norm() < 2e-7, "{output}");
        assert!(rewritten.aside < 2e-4);
    }
    let output = by_ends(text, Format::GCode, ASIDE);
    assert_eq!(body(&output)[2..5], ["G1 X0.05 Y-0.03 Z0.02 F600", "X10.0", "Y10"]);
}

#[test]
fn a_point_that_is_named_again_stays_corrected() {
    let output = by_ends("G21 G90 G0 X0 Y0 Z0\nG1 X10 F600\nG1 X10\nX10 Y5\n", Format::GCode, ASIDE);
    assert_eq!(body(&output)[1..], ["G1 X0.05 Y-0.03 Z0.02 F600", "X10.05", "G1 X10.05", "X10.05 Y4.97"]);
    let apt = "UNITS/MM\nFEDRAT/MMPM,600\nGOTO/0,0,0\nGOTO/10,0,0\nGOTO/10,0,0\nGOTO/10,5,0\nFINI\n";
    let output = by_ends(apt, Format::Apt, ASIDE);
    assert!(output.ends_with("GOTO/10.05,-0.03,0.02\nGOTO/10.05,-0.03,0.02\nGOTO/10.05,4.97,0.02\nFINI\n"), "{output}");
    let csv = "x_mm,y_mm,z_mm\n0,0,0\n10,0,0\n10,0,0\n10,5,0\n";
    let output = by_ends(csv, Format::Csv, ASIDE);
    assert_eq!(output, "x_mm,y_mm,z_mm\n0.05,-0.03,0.02\n10.05,-0.03,0.02\n10.05,-0.03,0.02\n10.05,4.97,0.02\n");
}

#[test]
fn a_place_that_is_set_counts_from_the_corrected_one() {
    for field in [ASIDE, TURNED, WAVES] {
        gcode("G21 G90 G0 X0 Y0 Z0\nG1 X10 F600\nY10\nG92 X0 Y0\nG1 X5 Y5\nX9\nG52 Z3\nX2 Z1\n", field);
    }
}

#[test]
fn inverse_time_keeps_the_speed() {
    for field in [NOWHERE, WAVES] {
        // 20 mm at 2 moves a minute, a half circle, and 50 mm.
        gcode("G21 G90 G93 G0 X0 Y0 Z0\nG1 X20 F2\nG3 X20 Y20 I0 J10 F3\nG1 X70 F6\n", field);
    }
}

#[test]
fn tool_axes_are_written_where_the_file_has_them() {
    // Led about the tip by a small angle about x.
    let tilt = |sample: &Sample| {
        let axis =
            nalgebra::Rotation3::from_axis_angle(&Vector3::x_axis(), 1e-3 + sample.pose.tip.x) * sample.pose.axis;
        ToolPose { axis, ..sample.pose }
    };
    let vectors = "G21 G90 G0 X0 Y0 Z0\nG43.5\nG1 X10 I0 J0 K1 F600\nX20\nX30 I0 J0.6 K0.8\n";
    let apt = "UNITS/MM\nMULTAX/ON\nFEDRAT/MMPM,600\nGOTO/0,0,0,0,0,1\nGOTO/10,0,0,0,0,1\nGOTO/20,0,0\nGOTO/30,0,0,0,0.6,0.8\nFINI\n";
    let csv = "x_mm\ty_mm\tz_mm\ti\tj\tk\tname\n0\t0\t0\t0\t0\t1\ta\n10\t0\t0\t0\t0\t1\tb\n20\t0\t0\t0\t0\t1\tc\n30\t0\t0\t0\t0.6\t0.8\td\n";
    for (text, format) in [(vectors, Format::GCode), (apt, Format::Apt), (csv, Format::Csv)] {
        let mut output = Vec::new();
        let options = asked();
        let original = Original { input: &mut text.as_bytes(), file: "p", format, options: &options };
        let rewritten = rewrite(original, &mut output, &how(&[]), &mut { tilt }, &mut |_| Ok(())).unwrap();
        let output = String::from_utf8(output).unwrap();
        assert!(rewritten.turn_lost < 2e-8, "{format:?}: {rewritten:?}\n{output}");
        let (before, after) = (path(text, format, &asked()), path(&output, format, &asked()));
        for one in before.iter().filter(|one| one.kind == MoveKind::Feed) {
            let last = samples(one, &STEPS, 0.0).last().unwrap();
            let wanted = tilt(&last);
            let found = after.iter().map(|one| one.to).find(|to| (to.tip - wanted.tip).norm() < 1e-9).unwrap();
            assert!((found.axis - wanted.axis).norm() < 2e-8, "{format:?} {found:?} {wanted:?}\n{output}");
        }
    }
    // Nothing in this file says an axis: how much is lost is reported.
    let mut output = Vec::new();
    let options = asked();
    let text = "G21 G90 G0 X0 Y0 Z0\nG1 X10 F600\n";
    let original = Original { input: &mut text.as_bytes(), file: "p", format: Format::GCode, options: &options };
    let rewritten = rewrite(original, &mut output, &how(&[]), &mut { tilt }, &mut |_| Ok(())).unwrap();
    assert!((rewritten.turn_lost - 0.011).abs() < 1e-9, "{rewritten:?}");
    assert!(String::from_utf8(output).unwrap().ends_with(text));
}

#[test]
fn angles_of_a_block_are_shared_out_where_it_becomes_several() {
    let options = ReadOptions { rotary: Some(Rotary::HeadAc), ..asked() };
    let text = "G21 G90 G0 X0 Y0 Z0 A0 C0\nG43.4\nG1 X100 A10 F600\nG91\nX50 A5 C2\n";
    let (output, rewritten) = led(text, Format::GCode, &options, WAVES);
    assert!(10 < rewritten.added, "{output}");
    let [before, after] = [text, &output].map(|text| path(text, Format::GCode, &options).last().unwrap().to.axis);
    // Five decimals of a degree, some dozen times by differences.
    assert!((before - after).norm() < 1e-6, "{before} {after}");
    assert!(rewritten.turn_lost < 1e-3, "{rewritten:?}");
}

#[test]
fn frames_differences_continuations_and_arcs_of_apt_are_written_as_they_are_read() {
    let text = "TOOL PATH/A,TOOL,B\nMSYS/0,0,0,1,0,0,0,1,0\nFEDRAT/MMPM,600\nGOTO/0,0,0,0,0,1\nGOTO/10,0,$\n 0 $$ far\n\
        GODLTA/0,10,0\nEND-OF-PATH\nTOOL PATH/C,TOOL,B\nMSYS/5,0,0,0,1,0,-1,0,0\nRAPID\nGOTO/0,0,5\nFEDRAT/MMPM,600\nGOTO/0,0,0\n\
        GOTO/40.,0.,0.\nCIRCLE/40.,10.,0,0,0,-1.,10.\nGOTO/50.,10.,0.\nGODLTA/0.,20.,0.\nEND-OF-PATH\n";
    for field in [NOWHERE, ASIDE, TURNED, WAVES] {
        let (output, rewritten) = led(text, Format::Apt, &asked(), field);
        assert!(output.starts_with("TOOL PATH/A,TOOL,B\n$$ Feed moves are corrected."), "{output}");
        assert!(output.contains("\n$$ CIRCLE/40.,10.,0,0,0,-1.,10.\n") && rewritten.arcs == 1, "{output}");
        assert_eq!(output.contains("GOTO/10,0,$\n 0 $$ far\n"), is_nowhere(field), "{output}");
    }
}

#[test]
fn ends_of_lines_marks_quotes_and_rapid_rows_stay() {
    let csv = "\u{feff}# made by hand\r\nx_mm; y_mm;z_mm;rapid;note\r\n\"0\";0;5;1;\"a\"\r\n\r\n\" 1.5 \";0;5;0;b\r\n 3.0; 0;5;0;c\r\n9;9;9;1;d";
    let (same, _) = led(csv, Format::Csv, &asked(), NOWHERE);
    assert_eq!(same, csv);
    let (output, rewritten) = led(csv, Format::Csv, &asked(), ASIDE);
    let expected = csv
        .replace("\"0\";0;5;1", "\"0.05\";-0.03;5.02;1")
        .replace("\" 1.5 \";0;5;0;b", "\" 1.55 \";-0.03;5.02;0;b")
        .replace(" 3.0; 0;5;0;c", " 3.05; -0.03;5.02;0;c");
    assert_eq!(output, expected);
    assert_eq!((rewritten.changed, rewritten.added), (3, 0));
    let gcode_text = "G21 G90 G0 X0 Y0 Z0\r\nG2 X10 Y0 I5 J0 F600\r\nG1 X20";
    let (output, _) = gcode(gcode_text, NOWHERE);
    assert!(output.matches('\n').count() == output.matches("\r\n").count() && output.ends_with("G1 X20"), "{output:?}");
}

#[test]
fn metres_and_inches_of_tables_are_written_to_the_same_tenth_of_a_micrometre() {
    for (unit, row) in [("m", "0.01,0,0"), ("inch", "0.4,0,0"), ("mm", "10,0,0")] {
        let text = format!("x_{unit},y_{unit},z_{unit}\n0,0,0\n{row}\n");
        let (output, _) = led(&text, Format::Csv, &asked(), ASIDE);
        let [a, b] = [&text, &output].map(|text| path(text, Format::Csv, &asked())[0].to.tip);
        assert!((b - a - ASIDE(a)).norm() < 2.5e-7, "{output}");
    }
}

#[test]
fn remarks_of_the_caller_stand_at_the_head() {
    let remarks = ["Robot (new); $ \u{fc}".to_owned()];
    for (text, format, expected) in [
        ("G0 X0 Y0 Z0\nG1 X1 F1\n", Format::GCode, "(Robot [new], , ?)\n"),
        ("UNITS/MM\nFEDRAT/MMPM,6\nGOTO/0,0,0\nGOTO/1,0,0\n", Format::Apt, "UNITS/MM\n$$ Robot [new], , ?\n"),
        ("x_mm,y_mm,z_mm\n0,0,0\n1,0,0\n", Format::Csv, "# Robot [new], , ?\nx_mm"),
    ] {
        let (mut output, options) = (Vec::new(), asked());
        let original = Original { input: &mut text.as_bytes(), file: "p", format, options: &options };
        rewrite(original, &mut output, &how(&remarks), &mut |sample| sample.pose, &mut |_| Ok(())).unwrap();
        let output = String::from_utf8(output).unwrap();
        assert!(output.starts_with(expected), "{output}");
        assert_eq!(path(&output, format, &asked()), shifted(path(text, format, &asked()), &output, text));
    }
}

/// The same moves, so many lines farther down.
fn shifted(moves: Vec<Move>, longer: &str, shorter: &str) -> Vec<Move> {
    let by = longer.lines().count() - shorter.lines().count();
    moves.into_iter().map(|one| Move { line: one.line + by, ..one }).collect()
}

#[test]
fn every_sample_is_asked_for_once_and_in_order() {
    for (name, options) in files() {
        let text = fs::read_to_string(format!("{FOLDER}/{name}")).unwrap();
        let format = Format::of_name(name).unwrap();
        let (mut way, mut expected) = (0.0, Vec::new());
        for one in path(&text, format, &options) {
            expected.extend(samples(&one, &STEPS, way));
            way += one.length();
        }
        let (mut found, mut output) = (Vec::new(), Vec::new());
        let original = Original { input: &mut text.as_bytes(), file: "p", format, options: &options };
        let mut corrected = |sample: &Sample| {
            found.push(*sample);
            sample.pose
        };
        rewrite(original, &mut output, &how(&[]), &mut corrected, &mut |_| Ok(())).unwrap();
        assert!(found == expected, "{name}");
    }
}

#[test]
fn what_cannot_be_led_elsewhere_is_refused_with_its_line() {
    let nist = ReadOptions { incremental_cycles: Some(IncrementalCycles::Nist), ..asked() };
    let text = "G21 G90 G0 X0 Y0 Z5\nG1 X10 F600\nG91 G81 X5 Z-2 R-1\n";
    let why = written(text, Format::GCode, &nist, ASIDE).unwrap_err().to_string();
    assert!(
        why.starts_with("p:3: G91: a drilling cycle under G91 counts from a place that was corrected by 0.06"),
        "{why}"
    );
    assert!(written(text, Format::GCode, &nist, NOWHERE).is_ok());
    for (text, format, expected) in [
        ("G21 G0 X0 Y0 Z0\nG41 G1 X1 F1\n", Format::GCode, "p:2: G41: cutter compensation"),
        ("", Format::GCode, "p: nothing in it moves the tool"),
        ("G0 X0 Y0 Z0\nG1 X", Format::GCode, "p:2: X: no number follows the letter"),
        ("x_mm,y_mm,z_mm\n0,0,0\n0,0\n", Format::Csv, "p:3: the line: 2 cells; expected 3"),
        ("UNITS/MM\nGOTO/0,0,0\nGOTO/1,0,0\n", Format::Apt, "p:3: GOTO: no feed rate"),
    ] {
        let why = written(text, format, &asked(), ASIDE).unwrap_err().to_string();
        assert!(why.starts_with(expected), "{why}");
    }
    // Led beyond all measure, or nowhere.
    for field in [(|_| Vector3::new(1e3, 0.0, 0.0)) as Field, |_| Vector3::new(f64::NAN, 0.0, 0.0)] {
        for (text, format) in [
            ("G21 G0 X0 Y0 Z0\nG1 X1 F1\n", Format::GCode),
            ("UNITS/MM\nFEDRAT/MMPM,6\nGOTO/0,0,0\nGOTO/1,0,0\n", Format::Apt),
            ("x_mm,y_mm,z_mm\n0,0,0\n1,0,0\n", Format::Csv),
        ] {
            let why = written(text, format, &asked(), field).unwrap_err().to_string();
            assert!(why.contains("as it would be written with corrections"), "{why}");
        }
    }
}

/// A disk that is full.
struct Full;

impl Write for Full {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(io::Error::other("no space left"))
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn what_cannot_be_written_is_reported_with_the_line() {
    let options = asked();
    let original =
        Original { input: &mut "G0 X0 Y0 Z0\n".as_bytes(), file: "p", format: Format::GCode, options: &options };
    let why = rewrite(original, &mut Full, &how(&[]), &mut |sample| sample.pose, &mut |_| Ok(())).unwrap_err();
    assert_eq!(why.to_string(), "p:1: what is made of it cannot be written: no space left");
}

#[test]
fn files_with_carriage_returns_alone_keep_them() {
    let text = "G21 G90 F100\nG0 X0 Y0 Z5\nG1 Z0 ; down\nG2 X10 I5\nM30\n";
    let (output, rewritten) = gcode(&text.replace('\n', "\r"), ASIDE);
    assert!(!output.contains('\n') && 5 < output.split('\r').count() && 0 < rewritten.added, "{output:?}");
    assert_eq!(output.replace('\r', "\n"), gcode(text, ASIDE).0);
}

/// A feed at the machine's own height is no part of the path, and keeps its words; G80 stays where it stands beside a motion.
#[test]
fn what_is_no_part_of_the_path_stays_byte_by_byte() {
    let air = "G1 X7.1884 Y0.159 F650.";
    let park = "G90 G58 G0 X12. Y20.";
    let text = format!(
        "G21 G90 G54\nG0 X0 Y0 Z5\nG1 Z0 F100\nG1 X5\nG53 G0 Z0.\n{air}\nG0 Z0.6\nG80 G1 X20 Y0 Z0\nG0 Z9\n{park}\nM30\n"
    );
    let (output, _) = gcode(&text, ASIDE);
    let lines = body(&output);
    assert!(
        lines.contains(&air) && lines.contains(&park) && lines.iter().any(|line| line.starts_with("G80 G1 X")),
        "{output}"
    );
}

#[test]
fn a_file_with_subprograms_is_not_written_back() {
    for text in [
        "G21 G90 F100\nG0 X0 Y0 Z0\nM98 P2\nM30\nO2\nG1 X1\nM99\n",
        "o1 sub\nG1 X1\no1 endsub\nG21 G90 F100\nG0 X0 Y0 Z0\no1 call\nM2\n",
    ] {
        let refused = written(text, Format::GCode, &asked(), NOWHERE).unwrap_err().to_string();
        assert!(refused.contains("a line of a subprogram may stand for several moves"), "{refused}");
    }
}
