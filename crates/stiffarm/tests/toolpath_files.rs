//! Is every file of a toolpath read to the figures that others computed, or refused with line and reason?

use std::fs;

use nalgebra::Vector3;
use stiffarm::toolpath::{
    ArcCentres, ArcSense, CutterCompensation, Format, IncrementalCycles, LengthUnit, Move, MoveKind, ReadOptions,
    Rotary, Steps, Survey, Understood, read, samples,
};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/paths");

/// A text as it is read: its moves, their survey and what was understood.
struct Parsed {
    moves: Vec<Move>,
    survey: Survey,
    understood: Understood,
}

fn parse(text: &str, format: Format, options: &ReadOptions) -> Result<Parsed, String> {
    let (mut moves, mut survey) = (Vec::new(), Survey::new(Steps::USUAL));
    let mut each = |one: &Move| {
        moves.push(*one);
        survey.add(one);
    };
    let understood =
        read(&mut text.as_bytes(), "p", format, options, &mut each, &mut |_| Ok(())).map_err(|why| why.to_string())?;
    Ok(Parsed { moves, survey, understood })
}

fn of_file(name: &str, options: &ReadOptions) -> Result<Parsed, String> {
    let text = fs::read_to_string(format!("{FOLDER}/{name}")).expect("a file of the tests");
    parse(&text, Format::of_name(name).expect("a known ending"), options)
}

fn gcode(text: &str) -> Result<Parsed, String> {
    parse(text, Format::GCode, &ReadOptions::default())
}

fn asked() -> ReadOptions {
    ReadOptions::default()
}

fn close(a: f64, b: f64, within: f64) {
    assert!((a - b).abs() <= within, "{a} is not {b}");
}

fn tips(parsed: &Parsed) -> Vec<Vector3<f64>> {
    parsed.moves.iter().map(|one| one.to.tip * 1e3).collect()
}

/// Feed length and length of arcs, mm, to the digits in which an independent interpreter printed them; moves and arcs.
#[test]
fn files_are_as_long_as_another_interpreter_found() {
    let centre = ReadOptions { cutter_compensation: CutterCompensation::Centre, ..asked() };
    for (name, options, feed, moves, arcs, of_arcs) in [
        ("contour_ij.nc", asked(), 448.504, 13, 4, 97.810),
        ("helix_full_circles.nc", asked(), 2302.683, 28, 26, 2288.683),
        ("planes_g17_g18_g19.nc", asked(), 305.619, 6, 3, 75.0 * std::f64::consts::PI),
        ("thread_mill_g91_g42_inch.gcode", centre, 65.182, 12, 10, 46.129),
        ("own_nx_contour.cls", asked(), 118.416, 6, 2, 10.0 * std::f64::consts::PI),
        ("own_sw_contour.apt", asked(), 118.416, 6, 2, 10.0 * std::f64::consts::PI),
    ] {
        let Parsed { survey, .. } = of_file(name, &options).unwrap_or_else(|why| panic!("{name}: {why}"));
        close(survey.feed_length * 1e3, feed, 6e-4);
        close(survey.arc_length * 1e3, of_arcs, 6e-4);
        assert_eq!((survey.feed_moves, survey.arcs), (moves, arcs), "{name}");
        assert!(survey.chord_error <= 1e-5, "{name}: {}", survey.chord_error);
    }
    assert_eq!(of_file("helix_full_circles.nc", &asked()).unwrap().survey.full_circles, 24);
}

#[test]
fn what_a_file_leaves_open_is_reported_with_its_line() {
    let Parsed { understood, survey, .. } = of_file("contour_ij.nc", &asked()).unwrap();
    let has =
        |remarks: &[String], what: &str| assert!(remarks.iter().any(|one| one.contains(what)), "{what}: {remarks:?}");
    has(&understood.assumed, "lengths in mm, since the file names none");
    has(&understood.assumed, "the part frame is that of G54 (line 6)");
    has(&understood.ignored, "M6 (line 5)");
    has(&understood.ignored, "G43 (line 9)");
    // Up to Z100, then home along three axes in two blocks; the way there is not the part's.
    assert_eq!(understood.apart, 4);
    let [low, high] = survey.extent.unwrap().map(|corner| corner * 1e3);
    assert!((low - Vector3::new(-55.123, -55.123, -5.123)).norm() < 1e-9);
    assert!((high - Vector3::new(55.123, 65.123, 2.0)).norm() < 1e-9);
}

/// The two files hold one path: Siemens NX turns arcs clockwise about their axes, SOLIDWORKS CAM counter-clockwise.
#[test]
fn nx_and_solidworks_files_of_one_path_give_one_path() {
    let [nx, sw] = ["own_nx_contour.cls", "own_sw_contour.apt"].map(|name| of_file(name, &asked()).unwrap());
    let points = |parsed: &Parsed| -> Vec<Vector3<f64>> {
        parsed.moves.iter().flat_map(|one| samples(one, &Steps::USUAL, 0.0).map(|sample| sample.pose.tip)).collect()
    };
    let (nx_points, sw_points) = (points(&nx), points(&sw));
    assert_eq!(nx_points.len(), sw_points.len());
    for (a, b) in nx_points.iter().zip(&sw_points) {
        assert!((a - b).norm() < 1e-12, "{a} {b}");
    }
    assert_eq!(
        nx.moves.iter().map(|one| one.feed).collect::<Vec<_>>(),
        sw.moves.iter().map(|one| one.feed).collect::<Vec<_>>()
    );
    let heads = [&nx, &sw].map(|parsed| parsed.understood.assumed.concat());
    assert!(
        heads[0].contains("clockwise about their axis, as Siemens NX") && heads[1].contains("as SOLIDWORKS CAM"),
        "{heads:?}"
    );
}

#[test]
fn twelve_holes_lie_on_their_circle_and_are_as_deep_as_the_user_says() {
    let refused = of_file("drill_g81_g91.nc", &asked()).err().unwrap();
    assert!(
        refused.starts_with("p:11: G81: makers differ in what R and Z of a cycle count from under G91"),
        "{refused}"
    );
    for (how, bottom) in [(IncrementalCycles::FromInitial, -20.0), (IncrementalCycles::FromR, -118.0)] {
        let parsed = of_file("drill_g81_g91.nc", &ReadOptions { incremental_cycles: Some(how), ..asked() }).unwrap();
        let holes: Vec<&Move> = parsed.moves.iter().filter(|one| one.kind == MoveKind::Feed).collect();
        assert_eq!(holes.len(), 12);
        for (k, hole) in holes.iter().enumerate() {
            let tip = hole.to.tip * 1e3;
            close(tip.x.hypot(tip.y), 100.0, 1e-3);
            close(tip.z, bottom, 1e-9);
            close(hole.from.tip.z * 1e3, 2.0, 1e-9);
            let angle = tip.y.atan2(tip.x).to_degrees().rem_euclid(360.0);
            close(angle, (15.0 + 30.0 * k as f64).rem_euclid(360.0), 1e-3);
        }
    }
    // Read as RS274/NGC, the numbers are read anew in G90: Z-120 and R-98 as places.
    let nist = ReadOptions { incremental_cycles: Some(IncrementalCycles::Nist), ..asked() };
    let parsed = of_file("drill_g81_g91.nc", &nist).unwrap();
    close(parsed.survey.extent.unwrap()[0].z * 1e3, -120.0, 1e-9);
}

/// The cycles of the RS274/NGC manual in three planes; by hand for the first ones.
#[test]
fn every_cycle_of_the_manual_is_expanded() {
    let refused = of_file("canned_cycles_c3.ngc", &asked()).err().unwrap();
    assert!(refused.starts_with("p:4: G81: makers differ"), "{refused}");
    let nist = ReadOptions { incremental_cycles: Some(IncrementalCycles::Nist), ..asked() };
    let parsed = of_file("canned_cycles_c3.ngc", &nist).unwrap();
    let of_line = |line: usize| -> Vec<(MoveKind, [f64; 3])> {
        let of = parsed.moves.iter().filter(|one| one.line == line);
        of.map(|one| (one.kind, (one.to.tip / 25.4e-3).map(|x| (x * 1e6).round() / 1e6 + 0.0).into())).collect()
    };
    let (rapid, feed) = (MoveKind::Rapid, MoveKind::Feed);
    assert_eq!(
        of_line(3),
        [(rapid, [0.0, 0.0, 0.2]), (rapid, [3.0, 4.0, 0.2]), (feed, [3.0, 4.0, -1.1]), (rapid, [3.0, 4.0, 0.2])]
    );
    // Three more an inch apart, from the level that is left, Z from R.
    let bottoms: Vec<[f64; 3]> = of_line(4).iter().filter(|(kind, _)| *kind == feed).map(|(_, at)| *at).collect();
    assert_eq!(bottoms, [[4.0, 4.0, -0.9], [5.0, 4.0, -0.9], [6.0, 4.0, -0.9]]);
    // G83 from R = 0.2 down to -1.1 in pecks of 0.21: seven of them.
    assert_eq!(of_line(9).iter().filter(|(kind, _)| *kind == feed).count(), 7);
    // Boring out at the feed rate: in and out.
    assert_eq!(of_line(11).iter().filter(|(kind, _)| *kind == feed).count(), 2);
    // Back boring beside the hole: in at (9.231, 10), up from -1.1 to -3 as written, back, and out.
    let back = of_line(13);
    assert!(back.contains(&(rapid, [9.231, 10.0, -1.1])) && back.contains(&(feed, [9.0, 10.0, -3.0])), "{back:?}");
    // Under G18 the tool comes along Y.
    let aside: Vec<&Move> = parsed.moves.iter().filter(|one| one.line == 22 && one.kind == feed).collect();
    assert!(aside.iter().all(|one| one.to.axis == Vector3::y() && one.to.tip.y < one.from.tip.y) && aside.len() == 1);
}

#[test]
fn a_table_of_points_and_normals_needs_names_for_its_columns() {
    let refused = of_file("puzzle_bent_head.csv", &asked()).err().unwrap();
    assert!(refused.starts_with("p:1: the header: it does not name x, y and z"), "{refused}");
    let columns = "-,x_mm,y_mm,z_mm,nx,ny,nz".split(',').map(String::from).collect();
    let parsed = of_file("puzzle_bent_head.csv", &ReadOptions { columns, ..asked() }).unwrap();
    // 23 points; the first six steps by hand: the tool stands along y, the normal.
    assert_eq!((parsed.moves.len(), parsed.moves[0].line), (22, 4));
    close(parsed.moves[0].length() * 1e3, (0.1877_f64.powi(2) + 2.507_f64.powi(2)).sqrt(), 1e-9);
    assert_eq!(parsed.moves[0].to.axis, Vector3::y());
    assert_eq!(parsed.survey.feed_time, None);
    let tabled = "x_mm;y_mm;z_mm;i;j;k;feed_mm_per_min;rapid;ap_mm;note\n0;0;0;0;0;2;600;0;1;a\n# rest\n30;0;0;0;0;1;600;0;1.5;\n30;40;0;0;0;1;;1;;\n";
    let parsed = parse_csv(tabled).unwrap();
    close(parsed.survey.feed_time.unwrap(), 3.0, 1e-12);
    close(parsed.survey.rapid_length, 0.04, 1e-12);
    assert_eq!(parsed.moves[0].given.axial_depth, Some(1.5e-3));
    assert!(parsed.understood.ignored[0].contains("column note"));
}

/// By hand: from up to ahead by a quarter turn, so that in the middle the normal leans by an eighth; beside a tool axis of its own.
#[test]
fn normals_of_a_table_turn_evenly_from_point_to_point() {
    let table = "x_mm,y_mm,z_mm,i,j,k,nx,ny,nz\n0,0,0,0,0,1,0,0,2\n10,0,0,0,0,1,1,0,0\n20,0,0,0,0,1,-1,0,0\n";
    let parsed = parse_csv(table).unwrap();
    let normal = |i: usize, t: f64| parsed.moves[i].normal(t).unwrap();
    assert!((normal(0, 0.5) - Vector3::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt())).norm() < 1e-12);
    assert_eq!((normal(0, 0.0), normal(0, 1.0)), (Vector3::z(), Vector3::x()));
    // Between opposite ones there is no even turn.
    assert_eq!((normal(1, 0.4), normal(1, 0.6)), (Vector3::x(), -Vector3::x()));
    assert!(parsed.moves.iter().all(|one| one.axis(0.5) == Vector3::z()));
    assert!(parsed.understood.assumed.concat().contains("normals are taken as directions, whatever their length"));
    let refused = parse_csv(&table.replace("-1,0,0", "0,0,0")).err().unwrap();
    assert!(refused.contains("the normal is zero"), "{refused}");
    assert_eq!(parse_csv("x_mm,y_mm,z_mm\n0,0,0\n1,0,0\n").unwrap().moves[0].normal(0.5), None);
}

fn parse_csv(text: &str) -> Result<Parsed, String> {
    parse(text, Format::Csv, &asked())
}

#[test]
fn arcs_about_the_origin_are_found_by_which_reading_closes() {
    // From (10, 0) a quarter about (20, 0): I = 10 from the beginning, I = 20 from the origin.
    let program = |i: f64| format!("G21 G90 G0 X10. Y0 Z0\nG1 F100 X10. Y0 Z0.5\nG2 X20. Y10. I{i} J0\nG1 X30.\nM2\n");
    let [from_start, from_origin] = [10.0, 20.0].map(|i| gcode(&program(i)).unwrap());
    assert_eq!(tips(&from_start), tips(&from_origin));
    close(from_start.survey.arc_length, 0.01 * std::f64::consts::FRAC_PI_2, 1e-12);
    close(from_origin.survey.arc_length, 0.01 * std::f64::consts::FRAC_PI_2, 1e-12);
    assert!(
        from_origin
            .understood
            .assumed
            .concat()
            .contains("I J K of arcs count from the origin: read so, the arcs close (line 3)")
    );
    // What is said is not guessed.
    let said = |code: &str, i: f64| gcode(&format!("{code}\n{}", program(i)));
    assert!(said("G90.1", 20.0).is_ok() && said("G91.1", 10.0).is_ok());
    let refused = said("G91.1", 20.0).err().unwrap();
    assert!(
        refused.starts_with("p:4: G2: the arc does not close: its radius is 20.0000 mm at its beginning and 14.1421"),
        "{refused}"
    );
    let options = ReadOptions { arc_centres: Some(ArcCentres::Absolute), ..asked() };
    assert!(parse(&program(10.0), Format::GCode, &options).is_err());
    // A full circle closes either way: an arc behind it must not say that it was read wrongly.
    let doubtful = "G21 G90 G1 F100 X10. Y0 Z0\nG2 I5. J0\nG2 X20. Y10. I20. J0\n";
    let refused = gcode(doubtful).err().unwrap();
    assert!(refused.contains("the arc of line 2 closes either way; say arc-centres"), "{refused}");
}

#[test]
fn planes_radii_turns_and_units_are_as_by_hand() {
    // R: a quarter of radius 10 and the three quarters that R-10 means.
    let by_radius = |r: &str| gcode(&format!("G21 G90 G1 F100 X10. Y0 Z0\nG3 X0 Y10. R{r}\n")).unwrap().moves[1];
    close(by_radius("10.").length(), 0.005 * std::f64::consts::PI, 1e-12);
    close(by_radius("-10.").length(), 0.015 * std::f64::consts::PI, 1e-12);
    let middle = by_radius("-10.").tip(0.5) * 1e3;
    let far = 10.0 + 10.0 / 2.0_f64.sqrt();
    assert!((middle - Vector3::new(far, far, 0.0)).norm() < 1e-9, "{middle}");
    // Two and a half turns up by 5 mm, in inches a turn of one inch.
    let helix = gcode("G20 G90 G1 F10 X1. Y0 Z0\nG3 X-1. Y0 Z1. I-1. J0 P3\n").unwrap();
    close(helix.moves[1].length() / 25.4e-3, (5.0 * std::f64::consts::PI).hypot(1.0), 1e-9);
    // In ZX the first axis is Z: G2 from +Z turns towards -X.
    let zx = gcode("G21 G18 G90 G1 F100 X0 Y0 Z10.\nG2 X-10. Z0 I0 K-10.\n").unwrap();
    close(zx.moves[1].length(), 0.005 * std::f64::consts::PI, 1e-12);
}

#[test]
fn offsets_of_position_are_followed_and_machine_moves_are_apart() {
    // After G92 at X10 the program counts from there; G92.1 goes back.
    let parsed = gcode("G21 G90 G1 F100 X10. Y0 Z0\nG92 X0\nG1 X5.\nG92.1\nG1 X20.\n").unwrap();
    assert_eq!(tips(&parsed).iter().map(|tip| tip.x.round()).collect::<Vec<_>>(), [10.0, 15.0, 20.0]);
    // G52 shifts.
    let parsed = gcode("G21 G90 G1 F100 X10. Y0 Z0\nG52 X1. Y2.\nG1 X5. Y0\nG52 X0 Y0\nG1 X5.\n").unwrap();
    assert_eq!(tips(&parsed)[1].map(f64::round), Vector3::new(6.0, 2.0, 0.0));
    assert_eq!(tips(&parsed)[2].map(f64::round), Vector3::new(5.0, 2.0, 0.0));
    // From home no feed move can be followed, a rapid one is apart.
    let refused = gcode("G21 G90 G0 X0 Y0 Z0\nG1 X1. F1\nG28 G91 Z0\nG90\nG1 X5. Z5.\n").err().unwrap();
    assert!(refused.starts_with("p:5: G1: Z is where the machine has it since line 3"), "{refused}");
    let parsed = gcode("G21 G90 G0 X0 Y0 Z0\nG1 X1. F1\nG0 G53 Z0\nG0 X5. Y5.\nG0 Z2.\nG1 Z0\n").unwrap();
    assert_eq!((parsed.understood.apart, parsed.survey.feed_moves, parsed.survey.rapid_moves), (4, 2, 0));
    close(parsed.survey.feed_length, 3e-3, 1e-12);
}

#[test]
fn five_axes_are_read_by_vectors_or_by_a_machine_that_is_named() {
    let program = "G21 G90 G43.4 H1\nG0 X0 Y0 Z0 A0 C0\nG1 X10. A90. C90. F600\n";
    let refused = gcode(program).err().unwrap();
    assert!(refused.starts_with("p:3: A90: what it turns is not in the file; say rotary"), "{refused}");
    for (rotary, axis) in [
        // Rx(90) z = -y; Rz(90) (-y) = x.
        (Rotary::HeadAc, Vector3::x()),
        // Rx(-90) z = y; Rz(-90) y = x.
        (Rotary::TableAc, Vector3::x()),
    ] {
        let parsed = parse(program, Format::GCode, &ReadOptions { rotary: Some(rotary), ..asked() }).unwrap();
        assert!((parsed.moves[0].to.axis - axis).norm() < 1e-12, "{rotary:?} {}", parsed.moves[0].to.axis);
        // Samples every 2 deg of a quarter turn at most, although 10 mm is one step.
        assert_eq!(parsed.survey.samples, 46);
    }
    let half = "G21 G90 G0 X0 Y0 Z0\nG1 X1. B30. C90. F60\n";
    for (rotary, x, y) in [(Rotary::HeadBc, 0.0, 0.5), (Rotary::TableBc, 0.0, 0.5)] {
        let parsed = parse(half, Format::GCode, &ReadOptions { rotary: Some(rotary), ..asked() }).unwrap();
        let axis = parsed.moves[0].to.axis;
        // Ry(30) z = (0.5, 0, 0.87), turned by 90 about z; Ry(-30) z = (-0.5, 0, 0.87), turned by -90.
        assert!((axis - Vector3::new(x, y, 0.75_f64.sqrt())).norm() < 1e-12, "{rotary:?}: {axis}");
        assert!(parsed.understood.assumed.concat().contains("X Y Z are the tip in the part, as under G43.4"));
    }
    let vectors = gcode("G21 G90 G43.5\nG0 X0 Y0 Z0\nG1 X10. I0 J3. K4. F600\n").unwrap();
    assert!((vectors.moves[0].to.axis - Vector3::new(0.0, 0.6, 0.8)).norm() < 1e-12);
    let zero = gcode("G21 G90 G43.5\nG0 X0 Y0 Z0\nG1 X10. I0 J0 K0 F600\n").err().unwrap();
    assert!(zero.contains("the tool axis is zero"), "{zero}");
}

#[test]
fn feed_rates_are_per_minute_per_turn_or_inverse_time() {
    let feed = |text: &str| gcode(text).unwrap().moves.last().unwrap().feed.unwrap();
    close(feed("G21 G90 G1 X10. Y0 Z0 F600"), 0.01, 1e-15);
    close(feed("G20 G90 G1 X10. Y0 Z0 F60"), 0.0254, 1e-15);
    close(feed("G21 G95 S3000 G90 G1 X10. Y0 Z0 F0.2"), 0.01, 1e-15);
    close(feed("G21 G93 G90 G1 X30. Y0 Z0 F20"), 0.01, 1e-15);
    let missing = gcode("G21 G90 G1 X10. Y0 Z0").err().unwrap();
    assert!(missing.starts_with("p:1: G1: no feed rate: expected F in this or an earlier block"), "{missing}");
    let given = ReadOptions { feed: Some(0.02), ..asked() };
    assert_eq!(parse("G21 G90 G1 X10. Y0 Z0", Format::GCode, &given).unwrap().moves[0].feed, Some(0.02));
}

/// Every trap of G-code by its line, word and reason.
#[test]
fn what_cannot_be_modelled_is_refused_by_line_and_name() {
    let head = "G21 G90\nG0 X0 Y0 Z0\nG1 X1. F100\n";
    for (line, says) in [
        ("G41 D1", "G41: cutter compensation"),
        ("G5 X1.", "G5: splines"),
        ("G68 X0 Y0 R30", "G68: turned coordinates"),
        ("G51 X0 Y0 P2", "G51: scaling"),
        ("G76 X1. Y1. Z-1. R1.", "G76: fine boring and threading"),
        ("G999", "G999: it is not known"),
        ("M98 P100", "M98 P100: no program of this number"),
        ("M99", "M99: a jump back"),
        ("G0 G1 X1.", "G1: two motions"),
        ("G10 L2 P1 X5.", "G10: offsets are written after places"),
        ("#1=3", "#1=3: variables"),
        ("o100 sub", "O100: the file ends before its endsub"),
        ("IF [1 EQ 1] GOTO 3", "IF [1 EQ 1] GOTO 3: variables"),
        ("U5.", "U: a further axis"),
        ("B5.", "B5: what it turns"),
        ("X1e+", "X1e+: an exponent"),
        ("X200000.", "G1: X of 200000 mm; expected at most 100 m"),
        ("G2 X5. Y5.", "G2: the arc has no centre; expected I or J"),
        ("G2 X5. Y0 I1. J1.", "G2: the arc does not close"),
        ("G2 X5. Y0 I2. R2.", "G2: both R and a centre"),
        ("G2 X50. Y0 R2.", "G2: R of 2.0000 mm is too small for its ends; expected at least 24.5"),
        ("G2 X1. Y0 R2.", "G2: R cannot say a full circle"),
        ("G2 X5. Y0 I2. K1.", "G2: K lies across the plane"),
        ("G2 X5. Y0 I2. P1.5", "P1.5: expected a whole number of turns"),
        ("G1 X5. R2.", "R: what it means to G1"),
        ("G81 X1. Y1. Z-1.", "G81: R is missing"),
        ("G81 X1. Y1. R1.", "G81: the depth is missing"),
        ("G81 X1. Y1. Z2. R1.", "G81: it ends at 2.0000 mm, above R"),
        ("G83 X1. Y1. Z-1. R1.", "G83: Q is missing or too small"),
        ("G81 X1. Y1. Z-1. R1. L2.5", "G81: 2.5 repeats"),
        ("G87 X1. Y1. Z-1. R1. Q1.", "G87: makers differ in back boring"),
        ("G1 F0 X2.", "G1: a feed rate of 0"),
        ("G1 F-5 X2.", "F-5: expected a feed rate"),
        ("G93\nG1 X2.", "G1: no feed rate: expected F in every block under G93"),
        ("G54\nG55\nX5.", "G55: another origin than that of G54 in line 4"),
        ("G1 X1. X2.", "X2.: X is given twice"),
        ("(no end", "(: the comment has no end"),
        ("G1 X", "X: no number follows"),
        ("L5", "L5: there is nothing to repeat"),
    ] {
        let refused = gcode(&format!("{head}{line}\n")).err().unwrap_or_else(|| panic!("{line} is read"));
        let line_number = 3 + line.split('\n').count();
        assert!(refused.starts_with(&format!("p:{line_number}: ")) && refused.contains(says), "{line}: {refused}");
    }
}

#[test]
fn letters_that_move_nothing_are_reported() {
    let parsed = gcode("%\nO7 (all)\nN10 G21 G90 G17 G40 T5 M6\nG0 X0 Y0 Z0 S900 M3\ng1x 1 .5 f100 e3\n/G1 X2.\n;rest\nM30\nG1 X99.\n%").unwrap();
    close(parsed.survey.feed_length, 2e-3, 1e-12);
    let ignored = parsed.understood.ignored.concat();
    for what in [
        "E (line 5)",
        "N (block number) (line 3)",
        "T (tool) (line 3)",
        "M6",
        "G40",
        "lines behind the end of the program",
    ] {
        assert!(ignored.contains(what), "{what}: {ignored}");
    }
    assert!(parsed.understood.assumed.concat().contains("blocks behind / are run (line 6)"));
}

#[test]
fn a_tool_that_has_cut_before_the_first_change_is_told_and_a_number_of_none_refused() {
    let cut = "G21 G90\nT2\nG0 X0 Y0 Z20\nG1 Z-3 F1000\nM6\nG1 X10\nM30\n";
    let assumed = gcode(cut).unwrap().understood.assumed.concat();
    assert!(
        assumed.contains("T2 alone is taken for a change of tools, as the first M6 comes after it has cut (line 5)"),
        "{assumed}"
    );
    // Another tool that is selected before the change has not cut.
    let assumed = gcode(&cut.replace("M6\n", "T3\nM6\n")).unwrap().understood.assumed.concat();
    assert!(assumed.contains("T2 alone is taken for a change of tools"), "{assumed}");
    for clean in
        [cut.replace("T2\n", "T2 M6\n"), cut.replace("M6\n", ""), cut.replace("G1 Z-3 F1000\nM6", "M6\nG1 Z-3 F1000")]
    {
        let assumed = gcode(&clean).unwrap().understood.assumed.concat();
        assert!(!assumed.contains("change of tools"), "{clean}: {assumed}");
    }
    for (word, shown) in [("T1.5", "T1.5"), ("T-1", "T-1")] {
        let refused = gcode(&cut.replace("T2", word)).err().unwrap();
        assert!(refused.contains(shown) && refused.contains("expected a whole number of a tool"), "{refused}");
    }
    let polar = gcode("G21 G90\nG0 X0 Y0 Z0\nG12.1\nG1 X1 F100\n").err().unwrap();
    assert!(polar.contains("polar interpolation is not modelled"), "{polar}");
}

#[test]
fn places_after_tip_control_are_told_where_the_tool_is_still_tilted() {
    let head = ReadOptions { rotary: Some(Rotary::HeadAc), ..asked() };
    let text = |ends: &str| {
        format!(
            "G90 G94 G17 G21\nG43.4 H1\nG0 X0. Y0. Z50. A{ends} C90.\nG1 X10. Y0. Z0. F1000.\nG49\nG1 X20. Y0. Z0.\nM30\n"
        )
    };
    let assumed = |ends: &str| parse(&text(ends), Format::GCode, &head).unwrap().understood.assumed.concat();
    assert!(assumed("-30.").contains("X Y Z are the tip in the part, as under G43.4 (line 6)"), "{}", assumed("-30."));
    // Nothing goes anywhere by X Y Z, or the tool is upright.
    let ends = text("-30.").replace("G1 X20. Y0. Z0.\n", "");
    let ended = parse(&ends, Format::GCode, &head).unwrap().understood.assumed.concat();
    assert!(!ended.contains("as under G43.4") && !assumed("0.").contains("as under G43.4"), "{ended}");
}

#[test]
fn apt_is_read_by_who_wrote_it_and_refused_where_nobody_knows() {
    let apt = |text: &str, options: &ReadOptions| parse(text, Format::Apt, options);
    let quarter = "GOTO/0,0,0\nFEDRAT/600,MMPM\nGOTO/10,0,0\nCIRCLE/10,10,0,0,0,1\nGOTO/20,10,0\nFINI\n";
    // No head says who wrote it; the move before the arc does: it goes on counter-clockwise.
    let seen = apt(quarter, &asked()).unwrap();
    close(seen.survey.arc_length, 0.005 * std::f64::consts::PI, 1e-12);
    assert!(seen.understood.assumed.concat().contains("so they go on from the moves before them"));
    let refused = apt(&format!("PAINT/PATH\n{quarter}"), &asked()).err().unwrap();
    assert!(refused.contains("p:6: CIRCLE") && refused.contains("goes back against the move before it"), "{refused}");
    let left = ReadOptions { arc_sense: Some(ArcSense::LeftHand), ..asked() };
    close(apt(quarter, &left).unwrap().survey.arc_length, 0.015 * std::f64::consts::PI, 1e-12);
    // The axis holds on; a statement may go on; inches.
    let inch =
        apt("UNITS/INCHES\nGOTO/0,0,0,0,1,$\n0 $$ up to here\nFEDRAT/10,IPM\nGOTO/1,0,0\nFINI", &asked()).unwrap();
    assert_eq!((inch.moves[0].to.tip.x, inch.moves[0].to.axis), (25.4e-3, Vector3::y()));
    close(inch.moves[0].feed.unwrap(), 10.0 * 25.4e-3 / 60.0, 1e-15);
    // A second frame turned by a quarter and shifted: the first one is the part's.
    let frames = "MSYS/0,0,0,1,0,0,0,1,0\nRAPID\nGOTO/0,0,0\nFEDRAT/MMPM,60\nGOTO/1,0,0\nEND-OF-PATH\n\
                  MSYS/5,0,0,0,1,0,-1,0,0\nGOTO/0,0,0\nGOTO/1,0,0\nEND-OF-PATH\n";
    let turned = apt(frames, &asked()).unwrap();
    assert!((tips(&turned)[1] - Vector3::new(5.0, 1.0, 0.0)).norm() < 1e-12);
    // A cycle in the words of NX: 3 above, 20 deep, out to 5.
    let drilled = "GOTO/0,0,30\nFEDRAT/MMPM,600\nCYCLE/DRILL,RAPTO,3,FEDTO,-20,RTRCTO,5,MMPM,60\nGOTO/10,0,0\nGOTO/20,0,0\nCYCLE/OFF\nGOTO/20,0,30\nFINI\n";
    let drilled = apt(drilled, &asked()).unwrap();
    close(drilled.survey.feed_length, 0.023 * 2.0 + 0.025, 1e-12);
    close(drilled.moves[1].feed.unwrap(), 0.001, 1e-15);
    close(drilled.moves.last().unwrap().feed.unwrap(), 0.01, 1e-15);
    for (text, says) in [
        ("GOTO/1,2", "p:1: GOTO: 2 numbers; expected 3 or 6"),
        ("GOTO/0,0,0,0,0,0", "the tool axis is zero"),
        ("GOTO/0,0,0\nGOTO/1,0,0", "p:2: GOTO: no feed rate"),
        ("GOTO/0,0,nan", "'NAN' is no number"),
        ("GOTO/0,0,1e99", "expected at most 1e9"),
        ("NURBS/3", "p:1: NURBS: it is not known"),
        ("CUTCOM/LEFT", "CUTCOM: cutter compensation"),
        ("GOTO/0,0,0\nFEDRAT/MMPM,1\nCIRCLE/1,0,0,0,0,1\nGOTO/2,2,0", "the arc does not close"),
        ("GOTO/0,0,0\nFEDRAT/MMPM,1\nCIRCLE/1,0,0,0,0,1\nGOTO/2,0,0", "in which sense it turns"),
        ("GOTO/0,0,0\nFEDRAT/MMPM,1\nCIRCLE/1,0,0,0,0,1", "p:3: CIRCLE: the file ends before"),
        ("CIRCLE/1,0,0,0,0,1,1,TIMES,3", "TIMES"),
        ("GOTO/0,0,$", "the file ends where a statement goes on"),
        ("UNIT/FEET", "'FEET' is no unit"),
        ("GOTO/0,0,0\nUNIT/INCH", "the unit changes"),
        ("FEDRAT/MMPM,0", "expected a feed rate"),
        ("FEDRAT/1,FURLONG", "'FURLONG' is no unit of feed"),
        ("CYCLE/THREAD,RAPTO,1,FEDTO,-2", "cycle THREAD is not known"),
        ("CYCLE/DRILL,RAPTO,1,FEDTO,2", "makers differ in its sign"),
        ("MSYS/0,0,0,1,0,0,1,0,0", "no unit vectors at a right angle"),
        ("", "p: nothing in it moves the tool"),
    ] {
        let refused = apt(text, &asked()).err().unwrap_or_else(|| panic!("{text} is read"));
        assert!(refused.contains(says), "{text}: {refused}");
    }
}

#[test]
fn tables_that_make_no_sense_are_refused_by_line_and_name() {
    let head = "x_mm,y_mm,z_mm,i,j,k\n0,0,0,0,0,1\n";
    for (text, says) in [
        ("1,2,3\n".to_owned(), "p:1: the header: it holds numbers"),
        ("x,y,z\n".into(), "x: it has no unit that is known; expected x_mm, x_m or x_inch"),
        ("x_mm,y_inch,z_mm\n".into(), "in one unit"),
        ("x_mm,y_mm\n".into(), "does not name x, y and z"),
        ("x_mm,y_mm,z_mm,x_mm\n".into(), "x_mm: the column stands twice"),
        ("x_mm,y_mm,z_mm,i,j\n".into(), "i,j,k: 2 of 3"),
        ("x_mm,y_mm,z_mm,b_deg\n".into(), "b_deg: an angle of a machine"),
        ("x_mm,y_mm,z_mm,feed\n".into(), "feed: it has no unit"),
        (format!("{head}1,0,0,0,0\n"), "p:3: the line: 5 cells; expected 6"),
        (format!("{head}1,0,0,0,0,1,1\n"), "p:3: the line: 7 cells; expected 6"),
        (format!("{head}1,0,zero,0,0,1\n"), "p:3: zero: it is no number"),
        (format!("{head}1,0,nan,0,0,1\n"), "p:3: nan: expected a number"),
        (format!("{head}1,0,inf,0,0,1\n"), "p:3: inf: expected a number"),
        (format!("{head}1,0,,0,0,1\n"), "it is no number"),
        (format!("{head}1,0,0,0,0,0\n"), "p:3: the line: the tool axis is zero"),
        (format!("{head}1,0,0,0,0,-1\n"), "turns right over"),
        (format!("{head}1e6,0,0,0,0,1\n"), "expected at most 100 m"),
        ("x_mm,y_mm,z_mm,feed_mm_per_min\n0,0,0,1\n1,0,0,-1\n".into(), "p:3: -1: expected a feed rate of more than 0"),
        (head.into(), "p: nothing in it moves the tool"),
        (String::new(), "it has no header"),
    ] {
        let refused = parse_csv(&text).err().unwrap_or_else(|| panic!("{text} is read"));
        assert!(refused.contains(says), "{text}: {refused}");
    }
    let unit = ReadOptions { unit: Some(LengthUnit::Inch), ..asked() };
    assert_eq!(parse("x,y,z\n0,0,0\n1,0,0\n", Format::Csv, &unit).unwrap().moves[0].to.tip.x, 25.4e-3);
}

/// What a file says of its unit holds, and whoever said another one hears of it.
#[test]
fn a_unit_that_the_file_overrules_is_remarked_on() {
    let said = ReadOptions { unit: Some(LengthUnit::Inch), ..asked() };
    for (format, text, remark) in [
        (
            Format::GCode,
            "G21 G90 F100\nG0 X0 Y0 Z0\nG1 X1\nM30\n",
            "lengths in mm, as the file says, not in inch as was said (line 1)",
        ),
        (
            Format::Apt,
            "UNITS/MM\nFROM/0,0,0\nFEDRAT/100\nGOTO/1,0,0\n",
            "lengths in mm, as the file says, not in inch as was said (line 1)",
        ),
        (
            Format::Csv,
            "x_mm,y_mm,z_mm\n0,0,0\n1,0,0\n",
            "lengths in the unit of the headings, not in inch as was said (line 1)",
        ),
    ] {
        let parsed = parse(text, format, &said).unwrap();
        assert_eq!(parsed.moves.last().unwrap().to.tip.x, 1e-3, "{format:?}");
        assert!(parsed.understood.assumed.iter().any(|line| line == remark), "{:?}", parsed.understood.assumed);
        let alike = ReadOptions { unit: Some(LengthUnit::Millimetre), ..asked() };
        let assumed = parse(text, format, &alike).unwrap().understood.assumed;
        assert!(!assumed.iter().any(|line| line.contains("as was said")), "{assumed:?}");
    }
}

/// No file, cut off anywhere, may end in anything but a path or a refusal with a line of it.
#[test]
fn files_cut_off_anywhere_are_read_or_refused() {
    let nist = ReadOptions {
        cutter_compensation: CutterCompensation::Centre,
        incremental_cycles: Some(IncrementalCycles::Nist),
        ..asked()
    };
    for name in ["contour_ij.nc", "canned_cycles_c3.ngc", "own_nx_contour.cls", "puzzle_bent_head.csv"] {
        let text = fs::read_to_string(format!("{FOLDER}/{name}")).unwrap();
        for end in 0..text.len() {
            if let Err(refused) = parse(&text[..end], Format::of_name(name).unwrap(), &nist) {
                assert!(refused.starts_with("p:"), "{refused}");
            }
        }
    }
    for format in Format::ALL {
        let (mut zeros, mut noise): (&[u8], &[u8]) = (&[0; 4096], &[0x9f, 0xff, 0xfe, b'\n', 0xc3, 0x28]);
        for input in [&mut zeros, &mut noise] {
            let refused = read(input, "p", format, &asked(), &mut |_| (), &mut |_| Ok(())).unwrap_err().to_string();
            assert!(refused.starts_with('p'), "{refused}");
        }
    }
}

/// Each chord of the samples keeps to its arc as it was asked to, and no two samples are farther apart than a step.
#[test]
fn samples_keep_chord_and_step() {
    let parsed = of_file("helix_full_circles.nc", &asked()).unwrap();
    for steps in [Steps::USUAL, Steps { chord: 1e-3, longest: 2e-3, turn: 1.0 }] {
        let mut worst = 0.0_f64;
        for one in &parsed.moves {
            let all: Vec<_> = samples(one, &steps, 1.0).collect();
            let n = (all.len() - 1) as f64;
            for (k, pair) in all.windows(2).enumerate() {
                assert!(pair[1].way - pair[0].way <= steps.longest * (1.0 + 1e-9));
                let middle = one.tip((k as f64 + 0.5) / n);
                worst = worst.max((middle - (pair[0].pose.tip + pair[1].pose.tip) / 2.0).norm());
            }
        }
        assert!(worst <= steps.chord && 0.5 * steps.chord.min(3e-5) < worst, "{worst}");
    }
}
