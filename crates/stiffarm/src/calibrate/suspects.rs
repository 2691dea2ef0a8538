//! What may be the matter with a table of which an arm explains nothing?

use super::robust::start;
use crate::chain::Frames;
use crate::registration::Sight;

/// Subsets that are tried of each suspect.
const SUBSETS: usize = 20;
/// So many times nearer, and the suspect is named.
const NEARER: f64 = 5.0;

/// The fault that explains a table best, in words; none where none does. `off` is the median distance as it stands, m; `lines` are
/// those of the rows.
pub(super) fn suspect(
    arm: &Frames,
    sights: &[Sight],
    shape: (usize, usize),
    (off, lines): (f64, &[usize]),
) -> Option<String> {
    let tried = |changed: &[Sight], (stands, points): (usize, usize)| {
        start(arm, changed, (stands, points), SUBSETS).map_or(f64::INFINITY, |(_, off)| off)
    };
    let mut best: Option<(f64, String)> = None;
    let mut consider = |found: f64, what: String| {
        if NEARER * found < off && best.as_ref().is_none_or(|(least, _)| found < *least) {
            best = Some((found, what));
        }
    };
    for (later, what) in [(true, "the row before"), (false, "the row after")] {
        let count = sights.len() - 1;
        let shifted = (0..count).map(|i| {
            let (joints, points) = if later { (i, i + 1) } else { (i + 1, i) };
            Sight { q: sights[joints].q, ..sights[points].clone() }
        });
        consider(
            tried(&shifted.collect::<Vec<_>>(), shape),
            format!("rows are shifted by one: points fit the joints of {what}"),
        );
    }
    let changed = |change: &dyn Fn(&mut Sight)| {
        let mut changed = sights.to_vec();
        changed.iter_mut().for_each(change);
        changed
    };
    for i in 0..6 {
        for j in i + 1..6 {
            let found = tried(&changed(&|sight| sight.q.swap(i, j)), shape);
            consider(found, format!("columns are exchanged: joint {} and joint {}", i + 1, j + 1));
        }
    }
    // Whichever two are exchanged, or has the other sign: space is mirrored, and a frame turns the rest.
    let mirrored =
        tried(&changed(&|sight| sight.points.iter_mut().flatten().for_each(|(at, _)| at.swap_rows(0, 1))), shape);
    consider(
        mirrored,
        "the points are mirrored: two of the columns x, y and z are exchanged, or one has the other sign".into(),
    );
    for (factor, unit) in
        [(25.4, "inches"), (1.0 / 25.4, "mm that were converted as inches"), (1e3, "metres"), (1e-3, "micrometres")]
    {
        let found =
            tried(&changed(&|sight| sight.points.iter_mut().flatten().for_each(|(at, _)| *at *= factor)), shape);
        consider(found, format!("the points are in {unit}; expected mm"));
    }
    if shape.0 == 1 {
        for part in 1..10 {
            let from = sights.len() * part / 10;
            if from < 5 || sights.len() < from + 5 {
                continue;
            }
            let mut moved = sights.to_vec();
            moved[from..].iter_mut().for_each(|sight| sight.stand = 1);
            let found = tried(&moved, (2, shape.1));
            consider(found, moved_near(lines[from]));
        }
    }
    best.map(|(found, what)| format!("{what} (then half of the points are within {:.2} mm)", found * 1e3))
}

/// That the instrument moved near a line of the table, and what to do.
pub(super) fn moved_near(line: usize) -> String {
    format!(
        "the tracker moved near line {line}: a column that tells its stands apart, named by frame-by, gives each a frame of its own"
    )
}
