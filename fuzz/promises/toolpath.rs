//! Is every file either a path of finite moves that hang together, or refused with a line of it and a reason?

use stiffarm::toolpath::{
    ArcSense, CutterCompensation, Format, IncrementalCycles, Move, PathFault, ReadOptions, Rotary, Steps, Survey, read,
};

// The first byte says how the rest is read: the format, and whether the user says what a file may leave open.
/// Panics where the promise is broken.
pub(crate) fn holds(bytes: &[u8]) {
    let Some((&how, mut text)) = bytes.split_first() else { return };
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
    let lines = text.split(|byte| *byte == b'\n').count();
    let mut survey = Survey::new(Steps::USUAL);
    let mut last: Option<Move> = None;
    let mut count = 0_usize;
    let mut each = |one: &Move| {
        count += 1;
        assert!((1..=lines).contains(&one.line), "line {} of {lines}", one.line);
        for pose in [one.from, one.to] {
            assert!(pose.tip.iter().all(|x| x.abs() <= 100.0) && (pose.axis.norm() - 1.0).abs() < 1e-9, "{one:?}");
        }
        assert!(one.length().is_finite() && one.feed.is_none_or(|feed| 0.0 < feed && feed.is_finite()), "{one:?}");
        // Both ends of an arc lie on it: the way to its end is short where the end is near.
        assert!((one.tip(1.0 - 1e-9) - one.to.tip).norm() <= 1e-4 + 1e-8 * one.length(), "{one:?}");
        assert!(last.is_none_or(|before| before.line <= one.line), "lines go back");
        last = Some(*one);
        survey.add(one);
    };
    match read(&mut text, "fuzz", format, &options, &mut each, &mut |_| Ok(())) {
        Ok(told) => {
            assert!(0 < count && told.lines <= lines);
            assert_eq!(count, survey.feed_moves + survey.rapid_moves);
            assert!(survey.feed_length.is_finite() && survey.extent.is_none_or(|[a, b]| a <= b));
        }
        Err(PathFault::Refused { line, why, word, .. }) => {
            assert!((0..=lines).contains(&line), "line {line} of {lines}: {word} {why}");
            assert!(!why.is_empty());
        }
        Err(error) => assert!(error.to_string().starts_with("fuzz")),
    }
}
