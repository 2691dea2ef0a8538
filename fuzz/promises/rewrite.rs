//! Does every path that is read, written back without correction, read back to itself?

use stiffarm::toolpath::{
    ArcSense, CutterCompensation, Format, IncrementalCycles, Move, MoveKind, Original, PathFault, ReadOptions,
    Rewriting, Rotary, Steps, read, rewrite,
};

const STEPS: Steps = Steps { chord: 1e-4, longest: 1.0, turn: 0.1 };

/// Longer paths take long and say no more, samples.
const MOST: usize = 100_000;

/// Panics where the promise is broken.
pub(crate) fn holds(bytes: &[u8]) {
    let Some((&how, text)) = bytes.split_first() else { return };
    let format = Format::ALL[usize::from(how % 3)];
    let options = if how & 128 == 0 {
        ReadOptions::default()
    } else {
        ReadOptions {
            cutter_compensation: CutterCompensation::Centre,
            incremental_cycles: Some(IncrementalCycles::Nist),
            rotary: Some(Rotary::TableAc),
            arc_sense: Some(ArcSense::LeftHand),
            feed: Some(0.01),
            ..ReadOptions::default()
        }
    };
    let moves = |text: &[u8]| -> Result<Vec<Move>, PathFault> {
        let (mut moves, mut input) = (Vec::new(), text);
        read(&mut input, "fuzz", format, &options, &mut |one| moves.push(*one), &mut |_| Ok(())).map(|_| moves)
    };
    let Ok(before) = moves(text) else { return };
    if MOST < before.iter().map(|one| STEPS.pieces(one)).sum() {
        return;
    }
    let (mut input, mut output) = (text, Vec::new());
    let original = Original { input: &mut input, file: "fuzz", format, options: &options };
    let how = Rewriting { steps: STEPS, straight: 1e-6, remarks: &[] };
    match rewrite(original, &mut output, &how, &mut |sample| sample.pose, &mut |_| Ok(())) {
        Ok(told) => {
            let after = moves(&output).expect("what was written is a path");
            let ends = |moves: &[Move], kind| moves.iter().rfind(|one| one.kind == kind).map(|one| one.to.tip);
            for kind in [MoveKind::Feed, MoveKind::Rapid] {
                let off = ends(&before, kind).zip(ends(&after, kind)).map(|(a, b)| (a - b).norm());
                assert!(off.is_none_or(|off| off < 1e-5), "{kind:?} ends {off:?} m off: {told:?}");
            }
            let length = |moves: &[Move]| -> f64 { moves.iter().map(Move::length).sum() };
            // Chords are shorter than their arcs, and rounding adds a little to every move.
            let [a, b] = [&before, &after].map(|moves| length(moves));
            assert!(b <= a + 1e-6 * (1 + after.len()) as f64, "{a} m became {b} m");
        }
        // A place to the tenth of a micrometre next to the end of all measure, or of all numbers.
        Err(error) => assert!(error.to_string().starts_with("fuzz"), "{error}"),
    }
}
