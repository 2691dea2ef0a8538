//! Is G-code as people have it read as a machine moves, or refused by line, word and language?

use stiffarm::toolpath::{
    Format, IncrementalCycles, LengthUnit, Move, MoveKind, ReadOptions, Steps, Survey, Understood, read,
};

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

fn gcode(text: &str) -> Result<Parsed, String> {
    parse(text, Format::GCode, &ReadOptions::default())
}

fn is_read(text: &str) -> Parsed {
    gcode(text).unwrap_or_else(|why| panic!("{why}\n{text}"))
}

fn is_refused(text: &str) -> String {
    gcode(text).err().unwrap_or_else(|| panic!("it is read:\n{text}"))
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-9, "{a} is not {b}");
}

fn feed_mm(text: &str) -> f64 {
    is_read(text).survey.feed_length * 1e3
}

fn says(remarks: &[String], what: &str) {
    assert!(remarks.iter().any(|one| one.contains(what)), "{what}: {remarks:?}");
}

/// In mm.
fn ends(parsed: &Parsed, kind: MoveKind) -> Vec<[f64; 3]> {
    let of_kind = parsed.moves.iter().filter(|one| one.kind == kind);
    of_kind.map(|one| (one.to.tip * 1e3).map(|x| (x * 1e6).round() / 1e6 + 0.0).into()).collect()
}

/// What follows a remark in the line before is not dropped, whatever ends a line.
#[test]
fn a_carriage_return_ends_a_line_in_every_format() {
    for end in ["\n", "\r\n", "\r"] {
        let lines = |text: &str| text.replace('\n', end);
        let remark = lines("G21 G90 F100\nG0 X0 Y0 Z5\nG1 Z0 ; down\nG1 X10\nG1 Y10\nM30\n");
        close(feed_mm(&remark), 25.0);
        let percent = lines("%\nG20\nG90\nG0 X0 Y0 Z1.\nG1 Z0. F10.\nG1 X1.\nM30\n%\n");
        close(feed_mm(&percent), 50.8);
        let apt = lines("UNIT/MM $$ of the part\nGOTO/0,0,0\nFEDRAT/100,MMPM\nGOTO/3,4,0\nFINI\n");
        close(parse(&apt, Format::Apt, &ReadOptions::default()).unwrap().survey.feed_length, 5e-3);
        let csv = lines("x_mm,y_mm,z_mm\n# a remark\n0,0,0\n3,4,0\n");
        close(parse(&csv, Format::Csv, &ReadOptions::default()).unwrap().survey.feed_length, 5e-3);
    }
}

#[test]
fn only_a_percent_sign_that_stands_alone_ends_a_program() {
    let program = |sign: &str| format!("G21 G90\nG0 X0 Y0 Z3\nG1 X10 F100\n{sign}\nG1 Y10\nM30\n");
    for sign in ["% LED ON", "%END", "%100", "% G1 X5"] {
        let refused = is_refused(&program(sign));
        assert!(refused.starts_with("p:4: %") && refused.contains("behind %"), "{refused}");
    }
    for sign in ["%", " % ", "% (end)", "%;end"] {
        close(feed_mm(&program(sign)), 10.0);
    }
    // At the head it may have the number of the program.
    for head in ["%", "%1234", "%O0007", "% (a)"] {
        close(feed_mm(&format!("{head}\n{}", program("(-)"))), 20.0);
    }
}

/// 250 mm/min where controls start in millimetres, not 6350.
#[test]
fn f_keeps_the_unit_in_force_where_it_stands() {
    let feed = |text: &str| is_read(text).moves.last().unwrap().feed.unwrap() * 60e3;
    let before = "F250.\nG20 G90 G17\nG0 X0 Y0 Z0\nG1 X1\nM30\n";
    close(feed(before), 250.0);
    says(&is_read(before).understood.assumed, "F before G20 is in mm, the unit in force where it stands (line 1)");
    let within = "G20 G90 F10.\nG0 X0 Y0 Z0\nG1 X1\nM30\n";
    close(feed(within), 254.0);
    says(&is_read(within).understood.assumed, "F in one block with G20 is in inch; to some machines it would be in mm");
    let behind = is_read("G20 G90\nG0 X0 Y0 Z0\nG1 X1 F10.\nM30\n");
    assert!(!behind.understood.assumed.concat().contains('F'), "{:?}", behind.understood.assumed);
    let asked = ReadOptions { unit: Some(LengthUnit::Inch), ..ReadOptions::default() };
    let inches = parse("F10.\nG21 G90\nG0 X0 Y0 Z0\nG1 X1\nM30\n", Format::GCode, &asked).unwrap();
    close(inches.moves[0].feed.unwrap() * 60e3, 254.0);
}

#[test]
fn a_unit_may_change_between_moves() {
    let parsed = is_read("G21 G90 F100\nG0 X0 Y0 Z0\nG1 X25.4\nG20\nX2.\nX3. F10.\nG21 X0\nM30\n");
    assert_eq!(ends(&parsed, MoveKind::Feed), [[25.4, 0.0, 0.0], [50.8, 0.0, 0.0], [76.2, 0.0, 0.0], [0.0; 3]]);
    let feeds: Vec<f64> = parsed.moves.iter().map(|one| (one.feed.unwrap() * 60e3).round()).collect();
    assert_eq!(feeds, [100.0, 100.0, 254.0, 254.0]);
    says(&parsed.understood.assumed, "the unit changes from mm to inch: places stay where they are (line 4)");
}

/// 60 mm: the block waits and then moves, as `LinuxCNC` has it.
#[test]
fn g4_drops_no_motion() {
    let program = |block: &str| format!("G21 G90 F100\nG0 X0 Y0 Z0\nG1 X10\n{block}\nG1 X60\nM30\n");
    let both = is_read(&program("G4 P1 G1 X50"));
    close(both.survey.feed_length, 0.06);
    assert_eq!(both.survey.feed_moves, 3);
    says(&both.understood.assumed, "a block with G4 P and a place waits, and then moves (line 4)");
    // The time by itself, in the words of several makers; a speed of it is none.
    for wait in ["G4 P1", "G4 X2.", "G4 U2.", "G4 F2.", "G4 S30", "G04 P500 F100"] {
        let parsed = is_read(&program(wait));
        assert_eq!(
            (parsed.survey.feed_moves, parsed.moves[1].feed.map(|feed| (feed * 60e3).round())),
            (2, Some(100.0)),
            "{wait}"
        );
    }
    for either in ["G4 X2. Y3.", "G4 G1 X50", "G4 Y5", "G4 F2 X5 Y5", "G4 P1 G2 X20 I5 J0"] {
        let refused = is_refused(&program(either));
        assert!(refused.starts_with("p:4: G4: ") && refused.contains("expected"), "{either}: {refused}");
    }
}

/// Each of these moves the tool otherwise than the words before it say, on some machine.
#[test]
fn what_may_move_the_tool_is_refused_by_line_and_word() {
    let head = "G21 G90\nG0 X0 Y0 Z0\nG1 X1. F100\n";
    for (line, says) in [
        ("G1 X1.5E-5", "X1.5E-5: an exponent"),
        ("M70", "M70: it restores"),
        ("M72", "M72: it restores"),
        ("M198 P5", "M198: a program that is not this file's"),
        ("M97 P5", "M97: a program that is not this file's"),
        ("M47", "M47: it makes the program run without end"),
        ("L1", "L1: there is nothing to repeat"),
        ("G1 X5. L1", "L1: there is nothing to repeat"),
        ("G90 G91 X5.", "G90: G91 stands in the same block"),
        ("G20 G21", "G20: G21 stands in the same block"),
        ("G17 G18", "G17: G18 stands in the same block"),
        ("G54 G55", "G54: G55 stands in the same block"),
        ("G80 G81 Z-1 R1", "G80: G81 stands in the same block"),
        ("G5 X1. Y1. I0 J1. P0 Q0", "G5: splines"),
        ("G5.1 X1. Y1. I1. J1.", "G5.1: splines"),
        ("G5 P10001 L3", "G5: it moves as only the machine knows"),
        ("G50 X100. Z50.", "G50: a place is named by it on lathes"),
        ("G70 I5. J15. L12", "G70: with these words it is a cycle"),
        ("G31 X5.", "G31: where a probe stops"),
        ("G27 X0", "G27: it is known to the machine only"),
        ("G254", "G254: coordinates that follow"),
        ("G15 H1", "G15 H: the language of Okuma"),
        ("G52 X5.\nG92 X0", "G92: X is shifted by G52 already"),
        ("G92 X0\nG52 X5.", "G52: X is shifted by G92 already"),
        ("G28\nG92 X0 Y0 Z0", "G92: where X of the machine lies"),
        ("G10 L2 P1 X5.", "G10: offsets are written after places"),
        ("$J=G91 X5", "$J=G91 X5: a jog"),
        ("$100=250", "$100=250: a setting of the machine"),
        ("$C", "$C: the sender only checks"),
    ] {
        let refused = is_refused(&format!("{head}{line}\n"));
        let line_number = 3 + line.split('\n').count();
        assert!(refused.starts_with(&format!("p:{line_number}: {says}")), "{line}: {refused}");
    }
    // A first positioning comes from where the file does not tell, and is a place all the same.
    for (code, says) in [
        ("G10 L2 P1 X5.", "p:3: G10: offsets are written after places"),
        ("G55", "p:4: G1: X is where the machine has it since line 3"),
    ] {
        let refused = is_refused(&format!("G21 G90\nG0 X0 Y0 Z5.\n{code}\nG1 Z0 F100\nM30\n"));
        assert!(refused.starts_with(says), "{refused}");
    }
}

/// `G92.1` takes G52 back, too, as Fanuc and `LinuxCNC` have it; by hand: at 1, then at 5 + 1, then at 2.
#[test]
fn g92_1_clears_every_shift() {
    let parsed = is_read("G21 G90 F100\nG0 X0 Y0 Z0\nG1 X1\nG52 X5\nG1 X1\nG92.1\nG1 X2\nM30\n");
    assert_eq!(ends(&parsed, MoveKind::Feed).iter().map(|end| end[0]).collect::<Vec<_>>(), [1.0, 6.0, 2.0]);
    // Named axes only, as Fanuc writes it; G92.3 brings back what G92.2 has suspended.
    let parsed =
        is_read("G21 G90 F100\nG0 X0 Y0 Z0\nG92 X1 Y1\nG92.1 X0\nG1 X2 Y2\nG92.2\nG1 X3 Y3\nG92.3\nG1 Y5\nM30\n");
    assert_eq!(ends(&parsed, MoveKind::Feed), [[2.0, 1.0, 0.0], [3.0, 3.0, 0.0], [3.0, 4.0, 0.0]]);
}

/// With L the second and third hole are as deep as the first, whether the tool goes back to R or to where it began.
#[test]
fn repeats_of_an_incremental_cycle_are_equally_deep() {
    let nist = ReadOptions { incremental_cycles: Some(IncrementalCycles::Nist), ..ReadOptions::default() };
    for retract in ["G98", "G99"] {
        let text = format!("G21 G91 {retract} F100\nG0 X1 Y0 Z5\nG81 X1 Z-2 R-1 L3\nM2\n");
        let parsed = parse(&text, Format::GCode, &nist).unwrap();
        assert_eq!(ends(&parsed, MoveKind::Feed), [[2.0, 0.0, 2.0], [3.0, 0.0, 2.0], [4.0, 0.0, 2.0]], "{retract}");
    }
}

/// The first lines of the usual posts; each mills 10 mm.
#[test]
fn openings_of_the_usual_posts_are_read() {
    for (post, head) in [
        (
            "Mastercam",
            "%\nO0000(PART)\n(DATE=DD-MM-YY)\n(T1|10 FLAT ENDMILL|H1)\nN100 G21\nN102 G0 G17 G40 G49 G80 G90\nN104 T1 M6\nN106 G0 G90 G54 X0. Y0. A0. S5000 M3\nN108 G43 H1 Z5.",
        ),
        ("SolidCAM", "%\nO5000 (PART)\nG21\nG90 G17 G40 G80 G00\nM06 T1 ()\nX0. Y0. S1000 M03\nG43 H1 D51 G00 Z5. M08"),
        (
            "Fusion, Fanuc",
            "%\nO1001 (PART)\nN10 G90 G94 G17 G49 G40 G80\nN15 G21\nN20 G28 G91 Z0.\nN25 G90\nN30 T1 M6\nN35 S5000 M3\nN40 G54\nN45 G0 X0. Y0.\nN50 G43 Z5. H1",
        ),
        (
            "Fusion, Haas",
            "%\nO01001 (PART)\nN10 G90 G94 G17\nN15 G21\nN20 G53 G0 Z0.\nN25 T1 M6\nN30 S5000 M3\nN35 G54\nN40 G187 P3\nN45 G0 X0. Y0.\nN50 G43 Z5. H1",
        ),
        ("Fusion, grbl", "(PART)\nG90 G94\nG17\nG21\nG54\nG0 X0 Y0\nZ5"),
        (
            "FreeCAD",
            "(Exported by FreeCAD)\n(Begin preamble)\nG17 G54 G40 G49 G80 G90\nG21\n(Begin operation)\nM6 T1\nM3 S1000\nG0 Z5.000\nG0 X0.000 Y0.000",
        ),
        (
            "Vectric",
            "( part )\n(Material Size)\nG00G21G17G90G40G49G80\nG71G91.1\nT1M06\nG00G43Z5.000H1\nS12000M03\n(Toolpath:- Profile)\nG94\nX0.000Y0.000F500.0",
        ),
        (
            "Carbide Create",
            "%\n(Design File:  part)\n(TOOL/MILL,0.1, 0.05, 0.000, 0)\nG90\nG21\nM05\nM0 ;T102\nM03S18000\nG0X0.000Y0.000\nZ5.000",
        ),
        ("HSMWorks, look-ahead", "%\nO1\nG90 G94 G17\nG21\nG05 P10000\nG5.1 Q1\nG54\nG0 X0. Y0.\nG43 H1 Z5."),
        ("Esprit", "%\nO1000\nG00 G17 G21 G40 G80 G90 G94\nG13.1\nG69\nG40.1\nG15\nG50.1 X0 Y0\nG0 G54 X0 Y0\nG0 Z5."),
        (
            "Haas, limits",
            "%\nO1\nG21 G90 G17\nG103 P1\nG22 X100. Y100. Z100. I-1. J-1. K-1.\nG23\nG154 P5\nG0 X0 Y0\nZ5.",
        ),
        ("a sender of grbl", "$H\n$G\n?\n$X\nG21 G90\nG0 X0 Y0\nG0 Z5"),
        (
            "NX",
            "%\nN0010 G40 G17 G90 G71\nN0020 G91 G28 Z0.0\nN0030 T01 M06\nN0040 G00 G90 X0.0 Y0.0 S1000 M03\nN0050 G43 Z5. H01",
        ),
    ] {
        let parsed = is_read(&format!("{head}\nG1 Z0. F100.\nX5.\nM30\n%\n"));
        assert_eq!((parsed.survey.feed_moves, (parsed.survey.feed_length * 1e6).round()), (2, 10_000.0), "{post}");
    }
}

#[test]
fn g80_ends_a_cycle_and_what_was_in_force_before_goes_on() {
    // A motion in its block holds, whichever stands first.
    for both in ["G0 G80 Z50.", "G80 G0 Z50."] {
        let text = format!("G21 G90 F100\nG0 X0 Y0 Z5\nG81 X1 Y1 Z-1 R1\n{both}\nG1 X5\nM30\n");
        let parsed = is_read(&text);
        assert_eq!(ends(&parsed, MoveKind::Feed), [[1.0, 1.0, -1.0], [5.0, 1.0, 50.0]]);
        assert!(!parsed.understood.assumed.concat().contains("G80"), "{:?}", parsed.understood.assumed);
    }
    let parsed = is_read("G21 G90 F100\nG0 X0 Y0 Z5\nG81 X1 Y1 Z-1 R1\nG80\nX9\nG1 X10\nM30\n");
    assert_eq!(ends(&parsed, MoveKind::Rapid).last(), Some(&[9.0, 1.0, 5.0]));
    says(&parsed.understood.assumed, "behind G80 the motion before it goes on, G0 (line 5)");
    let refused = is_refused("G21 G90 G80\nX9\nM30\n");
    assert!(refused.starts_with("p:2: X: no motion is in force"), "{refused}");
}

/// A public test bed of Mastercam ends all its programs so.
#[test]
fn a_parking_move_under_another_origin_is_the_machines() {
    let program =
        |park: &str| format!("G21 G90 G54\nG0 X0 Y0 Z5\nG1 Z0 F100\nX10\nG0 Z25.\nM5\nG91 G28 Z0.\n{park}\nM30\n");
    let parsed = is_read(&program("G90 G58 X12. Y20."));
    close(parsed.survey.feed_length, 0.015);
    assert_eq!(parsed.understood.apart, 3);
    says(
        &parsed.understood.assumed,
        "rapid moves under G58 are the machine's: where its origin lies is not in the file (line 8)",
    );
    says(&parsed.understood.assumed, "the part frame is that of G54 (line 1)");
    let refused = is_refused(&program("G90 G1 G58 X12. Y20."));
    assert!(refused.starts_with("p:8: G58: another origin than that of G54 in line 1"), "{refused}");
    // Back under the first origin, what was said in it holds where it was named again.
    let back = is_read(&program("G90 G0 G58 X12.\nG54 X0 Y0\nZ5.\nG1 Z0"));
    assert_eq!(ends(&back, MoveKind::Feed).last(), Some(&[0.0; 3]));
    let refused = is_refused(&program("G90 G0 G58 X12.\nG54 Z5.\nG1 Z0"));
    assert!(refused.starts_with("p:10: G1: X is where the machine has it since line 8"), "{refused}");
    // Where nothing has moved yet, the part's origin is the last one that was named.
    let parsed = is_read("G21 G90 G54\nG59\nG0 X0 Y0 Z5\nG1 Z0 F100\nM30\n");
    says(&parsed.understood.assumed, "the part frame is that of G59 (line 2)");
}

/// Fusion's post for Haas goes home in Z, and feeds in X and Y to the next part.
#[test]
fn feed_moves_at_the_machines_height_are_in_the_air() {
    let program = |park: &str| {
        format!("G21 G90 G54\nG0 X0 Y0 Z5\nG1 Z0 F100\nG53 G0 Z0.\n{park}\nG0 G43 Z0.6 H10\nG1 Z0 F100.\nM30\n")
    };
    let parsed = is_read(&program("G1 X7.1884 Y0.159 F650."));
    assert_eq!(ends(&parsed, MoveKind::Feed), [[0.0; 3], [7.1884, 0.159, 0.0]]);
    assert_eq!(parsed.understood.apart, 4);
    says(
        &parsed.understood.assumed,
        "feed moves along X and Y while Z is the machine's are in the air, no part of the path (line 5)",
    );
    for down in ["G1 X7. Z0.5 F650.", "G2 X7. Y0 I3.5 J0 F650.", "G1 Z0.5 F650."] {
        let refused = is_refused(&program(down));
        assert!(refused.contains("Z is where the machine has it since line 4"), "{down}: {refused}");
    }
}

/// 0.001 in of 2 in: half a thousandth of the radius, as `LinuxCNC` lets pass.
#[test]
fn arcs_close_as_linuxcnc_has_it() {
    let parsed = is_read("G20 G90 G17\nG0 X0 Y0 Z0\nG2 Y4.001 I0 J2. F10\nM30\n");
    assert!((parsed.survey.arc_length / 25.4e-3 - std::f64::consts::PI * 2.0005).abs() < 1e-6);
    close(parsed.understood.arc_miss, 0.001 * 25.4e-3);
    let refused = is_refused("G20 G90 G17\nG0 X0 Y0 Z0\nG2 Y4.005 I0 J2. F10\nM30\n");
    assert!(refused.contains("the arc does not close"), "{refused}");
    // A file of three decimals has 0.0127 mm, one of two 0.02 mm.
    let of_small = |y: &str| gcode(&format!("G21 G90 G17\nG0 X0 Y0 Z0\nG2 X{y} I5. J0 F10\nM30\n"));
    assert!(of_small("10.01").is_ok() && of_small("10.015").is_err() && of_small("10.009").is_ok());
}

/// O1 drills rows of holes by O2, which calls O3; 3 x 2 moves of 1 mm, in absolute numbers by hand.
#[test]
fn subprograms_of_the_file_are_run_where_they_are_called() {
    let main = "O1\nG21 G90 F100\nG0 X0 Y0 Z0\nM98 P2 L3\nG90 G1 Z5\nM30\n";
    let subs = "O2\nG91 G1 X1\nM98 P0003\nM99\nO3 (up)\nG1 Y1\nM99\n%\n";
    let parsed = is_read(&format!("{main}{subs}"));
    let expected = [[1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [3.0, 2.0], [3.0, 3.0], [3.0, 3.0]];
    assert_eq!(ends(&parsed, MoveKind::Feed).iter().map(|end| [end[0], end[1]]).collect::<Vec<_>>(), expected);
    assert_eq!(parsed.moves.iter().map(|one| one.line).collect::<Vec<_>>(), [8, 12, 8, 12, 8, 12, 5]);
    says(&parsed.understood.assumed, "subprograms of the file are run where they are called (line 4)");
    assert!(
        parsed.understood.ignored.iter().all(|one| !one.contains("behind the end")),
        "{:?}",
        parsed.understood.ignored
    );
    // Three times in one number; LinuxCNC's own words.
    let folded = is_read(&format!("{}{subs}", main.replace("P2 L3", "P30002")));
    assert_eq!(ends(&folded, MoveKind::Feed), ends(&parsed, MoveKind::Feed));
    let words = "o<row> sub\nG91 G1 X1\no3 call\no<row> endsub\n";
    let text = format!(
        "o3 sub\nG91 G1 Y1\no3 endsub\n{words}G21 G90 F100\nG0 X0 Y0 Z0\no<row> call\nO<ROW> CALL (again)\no <row> call ; and again\nG90 G1 Z5\nM2\n"
    );
    assert_eq!(ends(&is_read(&text), MoveKind::Feed), ends(&parsed, MoveKind::Feed));
}

#[test]
fn subprograms_that_cannot_be_followed_are_refused_by_line_and_name() {
    let head = "O1\nG21 G90 F100\nG0 X0 Y0 Z0\n";
    for (rest, says) in [
        ("M98 P7\nM30\nO2\nM99\n", "p:4: M98 P7: no program of this number"),
        ("M98\nM30\n", "p:4: M98: it names no program"),
        ("M98 P2 Q5\nM30\nO2\nM99\n", "p:4: M98: H or Q tell"),
        ("M98 P2 L0\nM30\nO2\nM99\n", "p:4: M98: expected a whole number of repeats"),
        ("M98 P2\nM30\nO2\nG1 X1\n", "M98: the file ends before the M99"),
        ("M98 P2\nM30\nO2\nG1 X1\nO3\nM99\n", "p:8: O3: the program before it has no M99"),
        ("M98 P2\nG1 X1\nO2\nM99\n", "p:6: O2: the program before it has no M30"),
        ("M98 P2\nM30\nO2\nM99 P5\n", "p:7: M99: it jumps to a block"),
        ("M98 P2\nM30\nO2\nG1 X1 Y\nM99\n", "p:7: Y: no number follows"),
        ("M98 P2\nM30\nO2\nM98 P2\nM99\n", "p:7: M98 P2: programs call one another more than 10 deep"),
        ("M98 P2 L9999\nM30\nO2\nM98 P3 L9999\nM99\nO3\nG91 X0\nM99\n", "subprograms of more than 1048576 lines"),
        ("G1 X1\nM99\n", "p:5: M99: a jump back"),
        ("o5 call\n", "p:4: o5 call: this sub does not stand before it"),
        ("o5 sub\nG1 X1\n", "O5: the file ends before its endsub"),
        ("o5 if [1 GT 0]\n", "p:4: o5 if [1 GT 0]: O-words of LinuxCNC"),
        ("o5 sub\no5 endsub\no5 call [1]\n", "p:6: o5 call [1]: O-words of LinuxCNC"),
    ] {
        let refused = is_refused(&format!("{head}{rest}"));
        assert!(refused.contains(says), "{rest}: {refused}");
    }
}

/// Of a language that is not read, its name and what to choose.
#[test]
fn other_languages_are_refused_by_name() {
    for (text, line, says) in [
        ("0 BEGIN PGM 11 MM\n1 BLK FORM 0.1 Z X-1 Y-1 Z-1\n", 1, "Heidenhain's conversational language"),
        ("%PART G71 *\nN10 G30 G17 X+0 Y+0 Z-40*\n", 1, "Heidenhain's DIN/ISO"),
        ("%_N_PART_MPF\n;$PATH=/_N_WKS_DIR\n", 1, "Siemens Sinumerik"),
        ("G21 G90\nG0 SUPA Z0 D0\n", 2, "Siemens Sinumerik"),
        ("G21 G90\nCYCLE800(0,\"\",0)\n", 2, "Siemens Sinumerik"),
        ("G21 G90\nCALL O100\n", 2, "Okuma"),
        ("G21\n#HSC ON\n", 2, "Fagor"),
        ("G21\n#100=5.\n", 2, "macros are not computed"),
        ("G21\nG1 X#100\n", 2, "macros are not computed"),
        ("G21\nN5 WHILE [#1 LT 5] DO1\n", 2, "macros are not computed"),
        ("G21\nG1 X[5+3]\n", 2, "macros are not computed"),
        ("SA\nM3,1.5,2.0,-0.1\n", 2, "OpenSBP"),
        ("IN;PU0,0;PD100,100;\n", 1, "HPGL"),
    ] {
        let text = text.strip_prefix("SA\n").map_or(text.to_owned(), |rest| format!("G21\n{rest}"));
        let refused = is_refused(&text);
        assert!(refused.starts_with(&format!("p:{line}: ")) && refused.contains(says), "{text}: {refused}");
        assert!(refused.contains("choose") || refused.contains("switch"), "{refused}");
    }
    let nested = is_refused("G21 G90\nG1 (a (b) c) X1\n");
    assert!(nested.starts_with("p:2: (a (b) c) X1: a comment within a comment"), "{nested}");
}

/// Words that move nothing stand in what was ignored, each with the line that came first.
#[test]
fn modes_that_move_nothing_are_reported() {
    let text = "G21 G90\n$G\nG187 P3 E0.02\nG103 P1\nG05 P10000\nG40.1\nG22 X9 Y9 Z9 I0 J0 K0\nG23\nG0 X0 Y0 Z0\nG1 X1 F10\nM30\nG1 X99\n";
    let parsed = is_read(text);
    for what in [
        "G187 (line 3)",
        "G103 (line 4)",
        "G5 (line 5)",
        "G40.1 (line 6)",
        "G22 (line 7)",
        "G23 (line 8)",
        "$G (of the sender) (line 2)",
        "lines behind the end of the program (line 12)",
    ] {
        says(&parsed.understood.ignored, what);
    }
    assert_eq!(parsed.survey.feed_length * 1e3, 1.0);
}

#[test]
fn files_are_named_for_what_they_are() {
    for (name, says) in [
        ("part.h", "Heidenhain's conversational language"),
        ("PART.H", "Heidenhain's conversational language"),
        ("part.i", "Heidenhain's DIN/ISO"),
        ("part.txt", "say read-as gcode, apt or csv"),
        ("part.nci", "choose a post of G-code"),
        ("part.stl", "a shape and no path"),
    ] {
        assert!(Format::of_name(name).is_none() && Format::not_read(name).unwrap().contains(says), "{name}");
    }
    assert_eq!((Format::of_name("part.mpf"), Format::not_read("part.mpf")), (Some(Format::GCode), None));
    // What Siemens' control knows besides is named where it stands.
    assert!(is_refused("G21 G90\nG0 X0 Y0 Z0\nTRANS X5\n").starts_with("p:3: TRANS X5: the language of Siemens"));
}

/// What `mill` and its reports say of a file besides its answer.
#[test]
fn everything_that_was_assumed_or_left_out_is_a_remark() {
    let parsed = is_read(
        "G20 G90 T1 M6\nG0 X0 Y0 Z0\nG2 Y4.001 I0 J2. F10\nG53 Z0\nM30\n".replace("G53 Z0", "G0 G53 Z0").as_str(),
    );
    let remarks = parsed.understood.remarks();
    for what in [
        "the ends of arcs miss one radius by up to 0.0254 mm",
        "2 moves to or from where only the machine knows are no part of the path",
        "ignored in the file of the path: T (tool) (line 1), M6 (line 1)",
    ] {
        says(&remarks, what);
    }
}

/// The way of rapid moves and where they end, by hand: from (0, 0, 5) on.
#[test]
fn rapid_moves_have_a_box_of_their_own() {
    let parsed = is_read("G21 G90 F100\nG0 X0 Y0 Z5\nG1 Z0\nG0 Z9\nX-3 Y4\nG1 Z0\nM30\n");
    let [low, high] = parsed.survey.rapid_extent.unwrap().map(|corner| corner * 1e3);
    assert!((low.x + 3.0).abs() < 1e-9 && low.y.abs() < 1e-9 && (low.z - 9.0).abs() < 1e-9, "{low}");
    assert!(high.x.abs() < 1e-9 && (high.y - 4.0).abs() < 1e-9 && (high.z - 9.0).abs() < 1e-9, "{high}");
    close(parsed.survey.rapid_length, 0.014);
}
