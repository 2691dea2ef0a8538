//! Where does a robot stand among others, as far as that is proved?
//!
//! Of a deflection two numbers are known: the value at the best place that was found, and a lower bound that is proved. What is really
//! best lies between them, so one robot is certainly better than another only where its value lies below the other's bound.

use std::fmt;

use crate::place::NOTHING;

/// Bounds hold up to rounding, relative.
const ROUNDING: f64 = 1e-9;

/// A rank as far as it is proved: one more than the number of robots that are certainly better.
///
/// Robots that cannot be distinguished from the best are all first. Where a chain of intervals overlaps, a robot in its middle may share the
/// rank of those before it, while the last of the chain, which the first is certainly better than, does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rank {
    /// From 1.
    pub place: usize,
    /// Some other robot cannot be distinguished from it.
    pub is_tied: bool,
}

/// `2`, or `2=` where it is tied.
impl fmt::Display for Rank {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(&format!("{}{}", self.place, if self.is_tied { "=" } else { "" }))
    }
}

/// What decides where a robot stands among others.
#[derive(Clone, Debug, PartialEq)]
pub struct Contestant<'a> {
    /// Its maker.
    pub vendor: &'a str,
    /// Its name.
    pub name: &'a str,
    /// Its numbers are partly assumed.
    pub is_estimated: bool,
    /// Lower bound and value of the deflection of each task, m; `None` where there is no place, or it is not known.
    pub proved: Vec<Option<[f64; 2]>>,
}

/// Where a robot stands among others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// Its place among those that were given.
    pub at: usize,
    /// As [`Row::rank`](super::Row::rank).
    pub rank: Option<Rank>,
    /// As [`Row::mean_ratio`](super::Row::mean_ratio).
    pub mean_ratio: Option<f64>,
    /// As [`Row::mean_ratio_bound`](super::Row::mean_ratio_bound).
    pub mean_ratio_bound: Option<f64>,
}

/// Robots in order: those that can do more of the tasks first, then by the mean ratio to the best, then by name.
///
/// Ranks are shared where bounds and values leave open who is better; one that does more of the tasks is better, whatever its values.
pub fn order(contestants: &[Contestant]) -> Vec<Standing> {
    let tasks = contestants.iter().map(|one| one.proved.len()).max().unwrap_or(0);
    let of = |one: &Contestant, task: usize| one.proved.get(task).copied().flatten();
    let best: Vec<f64> = (0..tasks)
        .map(|task| {
            contestants.iter().filter_map(|one| of(one, task)).map(|[_, value]| value).fold(f64::INFINITY, f64::min)
        })
        .collect();
    // The ratios of one end of the intervals.
    let mean_ratio = |one: &Contestant, end: usize| {
        let ratios: Vec<f64> =
            (0..tasks).filter_map(|task| Some(ratio(of(one, task)?[end], best[task]).ln())).collect();
        (!ratios.is_empty()).then(|| (ratios.iter().sum::<f64>() / ratios.len() as f64).exp())
    };
    let mut standings: Vec<Standing> = contestants
        .iter()
        .enumerate()
        .map(|(at, one)| Standing {
            at,
            rank: None,
            mean_ratio: mean_ratio(one, 1),
            mean_ratio_bound: mean_ratio(one, 0),
        })
        .collect();
    let misfits = |one: &Standing| (0..tasks).filter(|&task| of(&contestants[one.at], task).is_none()).count();
    let score = |one: &Standing| one.mean_ratio.unwrap_or(f64::INFINITY);
    let names = |one: &Standing| (contestants[one.at].vendor, contestants[one.at].name);
    standings.sort_by(|a, b| {
        misfits(a).cmp(&misfits(b)).then(score(a).total_cmp(&score(b))).then_with(|| names(a).cmp(&names(b)))
    });
    // Among those that do as many tasks; who does more of them stands before.
    let takes_rank = |one: &Standing| !contestants[one.at].is_estimated;
    let mut before = 0;
    for group in standings.chunk_by_mut(|a, b| misfits(a) == misfits(b)) {
        // One that can do none of the tasks stands behind all others, and has no rank.
        let proved = |one: &Standing| {
            one.mean_ratio_bound.zip(one.mean_ratio).filter(|_| takes_rank(one)).map(|(bound, value)| [bound, value])
        };
        let found = ranks(&group.iter().map(proved).collect::<Vec<_>>());
        let ranked = found.iter().flatten().count();
        for (one, rank) in group.iter_mut().zip(found) {
            one.rank = rank.map(|rank| Rank { place: before + rank.place, ..rank });
        }
        before += ranked;
    }
    standings
}

/// How much worse than the best; 1 for two robots of which neither gives way.
fn ratio(deflection: f64, best: f64) -> f64 {
    deflection.max(NOTHING) / best.max(NOTHING)
}

/// One is not certainly worse than the other: its bound does not lie above the other's value. Both as lower bound and value.
pub fn may_be_as_good([bound, _]: [f64; 2], [_, value]: [f64; 2]) -> bool {
    bound <= value * (1.0 + ROUNDING) + NOTHING
}

/// The rank of each of some that are known by lower bound and value.
pub(super) fn ranks(proved: &[Option<[f64; 2]>]) -> Vec<Option<Rank>> {
    let others =
        |at: usize| proved.iter().enumerate().filter(move |(other, _)| *other != at).filter_map(|(_, one)| *one);
    let rank = |(at, one): (usize, &Option<[f64; 2]>)| {
        one.map(|one| Rank {
            place: 1 + others(at).filter(|other| !may_be_as_good(one, *other)).count(),
            is_tied: others(at).any(|other| may_be_as_good(one, other) && may_be_as_good(other, one)),
        })
    };
    proved.iter().enumerate().map(rank).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(proved: &[Option<[f64; 2]>]) -> Vec<String> {
        ranks(proved).iter().map(|rank| rank.map_or_else(|| "-".into(), |rank| rank.to_string())).collect()
    }

    /// By hand: who is certainly better is who ends before another begins.
    #[test]
    fn intervals_that_overlap_share_a_rank() {
        assert_eq!(written(&[Some([1.0, 1.0]), Some([2.0, 2.0]), Some([3.0, 3.0])]), ["1", "2", "3"]);
        assert_eq!(written(&[Some([1.0, 2.0]), Some([1.5, 2.5]), Some([3.0, 3.0])]), ["1=", "1=", "3"]);
        // Equal robots; what touches is not distinguished.
        assert_eq!(written(&[Some([2.0, 2.0]), Some([2.0, 2.0]), Some([2.1, 2.2])]), ["1=", "1=", "3"]);
        // A chain: the first is certainly better than the last, the one in the middle may be as good as both.
        assert_eq!(written(&[Some([1.0, 2.0]), Some([1.9, 2.9]), Some([2.5, 3.0])]), ["1=", "1=", "2="]);
        // One of which little is proved may be better than those that stand before it.
        assert_eq!(written(&[Some([2.0, 2.0]), Some([2.1, 2.2]), Some([1.0, 2.5])]), ["1=", "2=", "1="]);
        assert_eq!(written(&[None, Some([1.0, 1.0]), None]), ["-", "1", "-"]);
        // Rounding tells nobody apart: two robots that do not give way, and two that differ by 1e-12.
        assert_eq!(written(&[Some([0.0, 0.0]), Some([1e-17, 1e-17])]), ["1=", "1="]);
        assert_eq!(written(&[Some([2.0, 2.0]), Some([2.0 + 2e-12, 2.0 + 2e-12])]), ["1=", "1="]);
    }

    fn contestant<'a>(name: &'a str, is_estimated: bool, proved: &[Option<[f64; 2]>]) -> Contestant<'a> {
        Contestant { vendor: "v", name, is_estimated, proved: proved.to_vec() }
    }

    #[test]
    fn the_order_is_that_of_the_values_whatever_is_shared() {
        let [sure, loose] = [[1.0, 1.0], [0.5, 1.2]];
        let contestants = [
            contestant("b", false, &[Some(loose), Some(loose)]),
            contestant("c", false, &[Some(sure), None]),
            contestant("a", false, &[Some(sure), Some(sure)]),
            contestant("guess", true, &[Some([0.1, 0.1]), Some([0.1, 0.1])]),
            contestant("d", false, &[Some([3.0, 3.0]), Some([3.0, 3.0])]),
            contestant("none", false, &[None, None]),
        ];
        let standings = order(&contestants);
        let found: Vec<(&str, Option<String>)> =
            standings.iter().map(|one| (contestants[one.at].name, one.rank.map(|rank| rank.to_string()))).collect();
        let rank = |text: &str| Some(text.to_owned());
        // One that does fewer tasks comes after all that do more; an estimated one, and one that does none, take no rank.
        let expected =
            [("guess", None), ("a", rank("1=")), ("b", rank("1=")), ("d", rank("3")), ("c", rank("4")), ("none", None)];
        assert_eq!(found, expected);
        // By hand: ratios to 0.1 of both tasks, 12 by value and 5 by what is proved.
        let b = standings[2];
        assert!((b.mean_ratio.unwrap() - 12.0).abs() < 1e-12 && (b.mean_ratio_bound.unwrap() - 5.0).abs() < 1e-12);
    }
}
