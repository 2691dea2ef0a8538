//! Is APT as people have it read as its CAM program means it, or refused by line and word?

use std::f64::consts::PI;

use nalgebra::Vector3;
use stiffarm::toolpath::{Format, Move, MoveKind, ReadOptions, Steps, Survey, Understood, read};

struct Parsed {
    moves: Vec<Move>,
    survey: Survey,
    understood: Understood,
}

fn parse(text: &str) -> Result<Parsed, String> {
    let (mut moves, mut survey) = (Vec::new(), Survey::new(Steps::USUAL));
    let mut each = |one: &Move| {
        moves.push(*one);
        survey.add(one);
    };
    let understood = read(&mut text.as_bytes(), "p", Format::Apt, &ReadOptions::default(), &mut each, &mut |_| Ok(()))
        .map_err(|why| why.to_string())?;
    Ok(Parsed { moves, survey, understood })
}

fn is_read(text: &str) -> Parsed {
    parse(text).unwrap_or_else(|why| panic!("{why}\n{text}"))
}

fn is_refused(text: &str) -> String {
    parse(text).err().unwrap_or_else(|| panic!("it is read:\n{text}"))
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-9, "{a} is not {b}");
}

fn says(remarks: &[String], what: &str) {
    assert!(remarks.iter().any(|one| one.contains(what)), "{what}: {remarks:?}");
}

/// The head of a file of SOLIDWORKS CAM with what posts add to it; 10 mm are fed.
const SOLIDWORKS: &str = "UNIT/MM\nPARTNO BRACKET 3\nSETUP/START,1\nINSERT/10MM CRB 2FL\nCUTTER/10.,0,5.,0,0,0,50.\n\
                          CSI_SET_FLUTE_LENGTH/30.\nCSI_SET_EXTENSION_LENGTH/45.\nLOAD/TOOL,1\nCOOLNT/FLOOD\n\
                          SPINDL/5000,RPM,CLW\nTRNTYP/WORLD,0,0,0\nCSYS/1,0,0,0,0,1,0,0,0,0,1,0\nRAPID/\nGOTO/0,0,5\n\
                          FEDRAT/100,MMPM\nGOTO/0,0,0\nGOTO/3,4,0\n";

#[test]
fn words_of_tool_and_job_are_reported_and_move_nothing() {
    let parsed = is_read(&format!("{SOLIDWORKS}FINI\n"));
    close(parsed.survey.feed_length, 0.01);
    for what in ["PARTNO (line 2)", "SETUP (line 3)", "CSI_SET_.. (2 times, first in line 6)"] {
        says(&parsed.understood.ignored, what);
    }
    for (statement, says) in [
        ("TRACUT/1,0,0,5,0,1,0,0,0,0,1,0", "TRACUT: it shifts or turns the path"),
        ("ROTABL/90", "ROTABL: it shifts or turns the path"),
        ("GOBACK/5", "GOBACK: it is not known whether this statement moves the tool"),
    ] {
        let refused = is_refused(&format!("{SOLIDWORKS}{statement}\nFINI\n"));
        assert!(refused.starts_with(&format!("p:18: {says}")), "{refused}");
    }
    close(is_read(&format!("{SOLIDWORKS}TRACUT/NOMORE\nFINI\n")).survey.feed_length, 0.01);
    // What follows the end is reported.
    let over = is_read(&format!("{SOLIDWORKS}FINI\n\n$$ a remark\nGOTO/9,9,9\nPARTNO/2\n"));
    close(over.survey.feed_length, 0.01);
    says(&over.understood.ignored, "lines behind FINI (2 times, first in line 21)");
}

/// The second side of a part: its z is the part's x, and so is the tool's axis, so that points are the part's.
#[test]
fn a_further_setup_is_read_where_its_points_are_the_parts() {
    let second = "CSYS/0,0,1,7,0,1,0,0,-1,0,0,0\nRAPID/\nGOTO/20,0,0,1,0,0\nGOTO/10,0,0,1,0,0\nFINI\n";
    let parsed = is_read(&format!("{SOLIDWORKS}{second}"));
    close(parsed.survey.feed_length, 0.02);
    let last = parsed.moves.last().unwrap();
    assert_eq!((last.to.tip * 1e3, last.to.axis), (Vector3::new(10.0, 0.0, 0.0), Vector3::x()));
    says(&parsed.understood.assumed, "points are those of the part in every CSYS, as TRNTYP/WORLD says (line 18)");
    let upright = is_refused(&format!("{SOLIDWORKS}{}", second.replace("0,0,1,0,0\n", "0,0,0,0,1\n")));
    assert!(
        upright.starts_with("p:20: GOTO: its tool axis does not stand along z of the CSYS of line 18"),
        "{upright}"
    );
    let local = is_refused(&format!("{}{second}", SOLIDWORKS.replace("TRNTYP/WORLD,0,0,0\n", "")));
    assert!(local.starts_with("p:17: CSYS: the coordinates change behind points"), "{local}");
    let none = is_refused(&format!("{SOLIDWORKS}{}", second.replace("CSYS/0,0,1,7", "CSYS/0,0,0,1")));
    assert!(none.starts_with("p:18: CSYS: its numbers are no frame"), "{none}");
}

/// A cutter that cleans a corner goes back in 60 deg, where the other sense would sweep over 300.
#[test]
fn a_short_arc_back_is_no_sign_of_the_other_sense() {
    let arc = |degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        format!(
            "{SOLIDWORKS}GOTO/0,0,0\nGOTO/10,0,0\nCIRCLE/10,-5,0,0,0,1\nGOTO/{:.9},{:.9},0\nFINI\n",
            10.0 - 5.0 * s,
            -5.0 + 5.0 * c
        )
    };
    let parsed = is_read(&arc(60.0));
    assert!((parsed.survey.arc_length - 0.005 * PI / 3.0).abs() < 1e-9, "{}", parsed.survey.arc_length);
    let refused = is_refused(&arc(120.0));
    assert!(refused.contains("it goes back against the move before it; say arc-sense"), "{refused}");
}

/// Feed rates per turn follow the spindle, and a speed of a surface is no speed of a spindle.
#[test]
fn feed_rates_per_turn_count_the_turns_at_their_move() {
    let file = |spindle: &str| format!("UNIT/MM\nGOTO/0,0,0\n{spindle}\nGOTO/10,0,0\nFINI\n");
    let feed = |spindle: &str| is_read(&file(spindle)).moves[0].feed.unwrap();
    close(feed("SPINDL/RPM,3000,CLW\nFEDRAT/0.2,MMPR"), 0.01);
    close(feed("FEDRAT/0.2,MMPR\nSPINDL/3000,RPM"), 0.01);
    close(feed("SPINDL/3000,RPM\nFEDRAT/0.2,MMPR\nSPINDL/6000,RPM"), 0.02);
    for surface in ["SPINDL/300,SFM\nFEDRAT/0.2,MMPR", "SPINDL/RPM,3000\nSPINDL/SMM,90,CLW\nFEDRAT/0.2,MMPR"] {
        let refused = is_refused(&file(surface));
        assert!(refused.contains("GOTO: a feed rate per turn, and SPINDL tells no turns a minute"), "{refused}");
    }
}

#[test]
fn cycles_are_read_in_the_words_of_their_programs() {
    let bottoms = |text: &str| -> Vec<[f64; 3]> {
        let parsed = is_read(text);
        let down = parsed.moves.iter().filter(|one| one.kind == MoveKind::Feed && one.to.tip.z < one.from.tip.z - 0.01);
        down.map(|one| (one.to.tip * 1e3).map(f64::round).into()).collect()
    };
    // SOLIDWORKS CAM begins a cycle, and tells the depth as a positive number; NX as a level.
    let solidworks = "CYCLE/INIT\nCYCLE/DEEP2,FEDTO,20,RAPTO,2,MMPM,60,STEP,5,DWELL,0\nGOTO/10,0,0\nGOTO/20,0,0\nCYCLE/OFF\nGOTO/20,0,9\nFINI\n";
    assert_eq!(bottoms(&format!("{SOLIDWORKS}{solidworks}")), [[10.0, 0.0, -20.0], [20.0, 0.0, -20.0]]);
    let parsed = is_read(&format!("{SOLIDWORKS}{solidworks}"));
    says(&parsed.understood.assumed, "FEDTO is the depth below the point, as SOLIDWORKS CAM writes it (line 19)");
    says(&parsed.understood.assumed, "deep drilling feeds down in one");
    close(parsed.moves.iter().filter(|one| one.kind == MoveKind::Feed).nth(2).unwrap().feed.unwrap(), 1e-3);
    let nx = "PAINT/PATH\nFEDRAT/MMPM,100\nGOTO/0,0,9\nCYCLE/DRILL,DEEP,STEP,5,RAPTO,3,FEDTO,-33,RTRCTO,AUTO,MMPM,250\nGOTO/10,0,0\nCYCLE/OFF\nEND-OF-PATH\n";
    assert_eq!(bottoms(nx), [[10.0, 0.0, -33.0]]);
    let begun = is_refused(&format!("{SOLIDWORKS}CYCLE/INIT\nGOTO/10,0,0\nFINI\n"));
    assert!(begun.starts_with("p:19: GOTO: the cycle of line 18 has not said what it does"), "{begun}");
}

/// `TLAXIS` holds for the points behind it; from home a move is no part of the path.
#[test]
fn axes_of_their_own_and_moves_home_are_followed() {
    let parsed = is_read(
        "UNIT/MM\nFEDRAT/100,MMPM\nGOTO/0,0,0\nTLAXIS/0,0.6,0.8\nGOTO/10,0,0\nGOTO/20,0,0\nGOHOME\nGOTO/0,0,0\nFINI\n",
    );
    assert!(parsed.moves.iter().all(|one| (one.to.axis - Vector3::new(0.0, 0.6, 0.8)).norm() < 1e-12));
    assert_eq!((parsed.moves.len(), parsed.understood.apart), (2, 3));
    says(&parsed.understood.assumed, "GOHOME leads the tool to the machine's home (line 7)");
}
