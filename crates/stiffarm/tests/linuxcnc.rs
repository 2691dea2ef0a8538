//! Does the reader move the tool as `LinuxCNC`'s interpreter does?
//!
//! `validation/rs274_cases.txt` holds programs and their moves as rs274, which shares no code with this one, has printed them
//! (`scripts/rs274`). It prints four decimals of mm or of inches: half of the last one is 1.3 um.

use stiffarm::toolpath::{Arc, Course, Format, IncrementalCycles, Move, MoveKind, ReadOptions, read};

/// Four decimals of an inch at a place, and as many at the shift that is added, mm.
const PLACE: f64 = 2.0 * 0.000_05 * 25.4 + 1e-4;

/// A centre by R lies where the half chord has its height: small heights grow the error of rounding, mm.
const CENTRE: f64 = 0.01;

struct Case<'a> {
    name: &'a str,
    program: String,
    expected: Vec<&'a str>,
}

fn cases() -> Vec<Case<'static>> {
    let text = include_str!("../../../validation/rs274_cases.txt");
    let mut cases = Vec::new();
    for part in text.split("\n== ").skip(1) {
        let (name, rest) = part.split_once('\n').expect("a name");
        let (program, expected) = rest.split_once("\n--").expect("a program");
        cases.push(Case {
            name,
            program: format!("{program}\n"),
            expected: expected.lines().filter(|line| !line.is_empty()).collect(),
        });
    }
    cases
}

fn moves(case: &Case) -> Result<Vec<Move>, String> {
    // LinuxCNC keeps the levels of a cycle under G91 from block to block.
    let how = if case.name.ends_with("block after block") { IncrementalCycles::FromR } else { IncrementalCycles::Nist };
    let options = ReadOptions { incremental_cycles: Some(how), ..ReadOptions::default() };
    let mut moves = Vec::new();
    let mut each = |one: &Move| moves.push(*one);
    read(&mut case.program.as_bytes(), "p", Format::GCode, &options, &mut each, &mut |_| Ok(()))
        .map_err(|why| why.to_string())?;
    Ok(moves)
}

fn numbers(line: &str) -> Vec<f64> {
    line.split(' ').filter_map(|word| word.parse().ok()).collect()
}

/// A move against its line of rs274.
fn holds(one: &Move, line: &str) -> Result<(), String> {
    let (kind, n) = (line.split(' ').next().unwrap_or_default(), numbers(line));
    let found = match (one.kind, &one.course) {
        (MoveKind::Rapid, _) => "rapid",
        (MoveKind::Feed, Course::Line) => "feed",
        (MoveKind::Feed, Course::Arc(_)) => "arc",
    };
    if found != kind {
        return Err(format!("a {found}"));
    }
    let to = one.to.tip * 1e3;
    if (0..3).any(|axis| PLACE < (to[axis] - n[axis]).abs()) {
        return Err(format!("to {to:?}"));
    }
    let feed = one.feed.map(|feed| feed * 60e3);
    if feed.is_some_and(|feed| 1e-4 * n[3] + 2e-3 < (feed - n[3]).abs()) {
        return Err(format!("at {feed:?}"));
    }
    match &one.course {
        Course::Line => Ok(()),
        Course::Arc(arc) => turns_alike(arc, line, &n),
    }
}

/// Plane, centre, sense and turns begun of an arc.
fn turns_alike(arc: &Arc, line: &str, n: &[f64]) -> Result<(), String> {
    let plane = line.split(' ').nth(5).unwrap_or_default();
    let [a, b, normal] = match plane {
        "XY" => [0, 1, 2],
        "ZX" => [2, 0, 1],
        _ => [1, 2, 0],
    };
    let turns = arc.normal[normal] * (arc.angle / std::f64::consts::TAU - 1e-9).ceil();
    let centre = [arc.centre[a] * 1e3, arc.centre[b] * 1e3];
    let off = (centre[0] - n[4]).hypot(centre[1] - n[5]);
    if turns != n[6] || CENTRE < off {
        return Err(format!("about {centre:?} in {turns} turns of {plane}"));
    }
    Ok(())
}

#[test]
fn the_tool_moves_as_linuxcnc_moves_it() {
    let (mut wrong, mut moved, mut arcs) = (Vec::new(), 0, 0);
    for case in cases() {
        let found = match (moves(&case), &case.expected[..]) {
            (Err(_), ["refused"]) => continue,
            (Ok(_), ["refused"]) => {
                wrong.push(format!("{}: it is read, and rs274 refuses it", case.name));
                continue;
            }
            (Err(why), _) => {
                wrong.push(format!("{}: {why}", case.name));
                continue;
            }
            (Ok(found), _) => found,
        };
        let by_ends = case.name.ends_with("pecks");
        // The first move comes from where the file does not tell.
        let expected: Vec<&str> =
            case.expected[1..].iter().copied().filter(|line| !by_ends || line.starts_with("feed")).collect();
        let found: Vec<&Move> = found.iter().filter(|one| !by_ends || one.kind == MoveKind::Feed).collect();
        if expected.len() != found.len() {
            wrong.push(format!("{}: {} moves, and rs274 makes {}", case.name, found.len(), expected.len()));
            continue;
        }
        for (one, line) in found.iter().zip(expected) {
            arcs += usize::from(one.course != Course::Line);
            moved += 1;
            if let Err(why) = holds(one, line) {
                wrong.push(format!("{}, line {}: {why}, and rs274 has {line}", case.name, one.line));
            }
        }
    }
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
    assert!(
        1000 < moved && 200 < arcs && 100 < cases().len(),
        "{moved} moves, {arcs} arcs of {} programs",
        cases().len()
    );
}
