//! Which of many robots are wanted: by words, maker, payload, reach, architecture and status.

use crate::drive::Architecture;
use crate::interval::Interval;
use crate::robot::{Robot, Status};

/// What a robot must have; all of it.
#[derive(Clone, Debug, Default)]
pub struct Filter {
    /// Words that must stand in the maker's or the robot's name.
    pub words: Vec<String>,
    /// One of these makers; any where empty.
    pub vendors: Vec<String>,
    /// Payload, kg.
    pub payload_kg: Option<Interval>,
    /// Reach, m.
    pub reach: Option<Interval>,
    /// Serial or quasi-serial.
    pub architecture: Option<Architecture>,
    /// One of these; any where empty.
    pub statuses: Vec<Status>,
}

/// No robot has all that is asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("none of {of} robots matches {asked}")]
pub struct NothingLeft {
    /// The criteria as they were written.
    pub asked: String,
    /// How many robots there were to choose from.
    pub of: usize,
    /// What would match.
    pub hint: String,
}

/// One thing that is asked of a robot: how it is written, and whether a robot has it.
struct Criterion<'a> {
    written: String,
    holds: Box<dyn Fn(&Robot) -> bool + 'a>,
}

impl<'a> Criterion<'a> {
    fn new(written: String, holds: impl Fn(&Robot) -> bool + 'a) -> Self {
        Self { written, holds: Box::new(holds) }
    }
}

impl Filter {
    /// The robots that have all that is asked for, in their order; `option` says how a face spells the name of an option.
    ///
    /// A missing payload or reach lies in no range.
    ///
    /// # Errors
    /// Where nothing is left, with what would match.
    pub fn keep(&self, robots: Vec<Robot>, option: impl Fn(&str) -> String) -> Result<Vec<Robot>, NothingLeft> {
        let criteria = self.criteria(option);
        let kept = |robot: &Robot| criteria.iter().all(|criterion| (criterion.holds)(robot));
        if robots.iter().any(kept) {
            return Ok(robots.into_iter().filter(kept).collect());
        }
        let written: Vec<&str> = criteria.iter().map(|criterion| criterion.written.as_str()).collect();
        let hint = match_without_one(&robots, &criteria).unwrap_or_else(|| what_there_is(&robots));
        Err(NothingLeft { asked: written.join(" "), of: robots.len(), hint })
    }

    fn criteria(&self, option: impl Fn(&str) -> String) -> Vec<Criterion<'_>> {
        let mut criteria: Vec<Criterion> = Vec::new();
        for word in self.words.iter().flat_map(|words| words.split_whitespace()) {
            criteria.push(Criterion::new(format!("'{word}'"), move |robot| {
                plain(&robot.full_name()).contains(&plain(word))
            }));
        }
        if !self.vendors.is_empty() {
            criteria.push(Criterion::new(format!("{} {}", option("vendor"), self.vendors.join(",")), |robot| {
                self.vendors.iter().any(|vendor| plain(vendor) == plain(&robot.vendor))
            }));
        }
        if let Some(range) = self.payload_kg {
            let holds = move |robot: &Robot| robot.payload_kg.is_some_and(|kg| range.contains(kg, 0.0));
            criteria.push(Criterion::new(format!("{} {}", option("payload_kg"), written(range)), holds));
        }
        if let Some(range) = self.reach {
            let holds = move |robot: &Robot| robot.reach.is_some_and(|reach| range.contains(reach, 0.0));
            criteria.push(Criterion::new(format!("{} {}", option("reach_m"), written(range)), holds));
        }
        if let Some(architecture) = self.architecture {
            let holds = move |robot: &Robot| robot.architecture == architecture;
            criteria.push(Criterion::new(format!("{} {architecture}", option("architecture")), holds));
        }
        if !self.statuses.is_empty() {
            let names: Vec<&str> = self.statuses.iter().map(|status| status.name()).collect();
            let holds = |robot: &Robot| self.statuses.contains(&robot.status);
            criteria.push(Criterion::new(format!("{} {}", option("status"), names.join(",")), holds));
        }
        criteria
    }
}

/// How many robots each single criterion keeps out.
fn match_without_one(robots: &[Robot], criteria: &[Criterion]) -> Option<String> {
    let without = |left_out: usize| {
        let others = |robot: &&Robot| {
            criteria.iter().enumerate().all(|(i, criterion)| i == left_out || (criterion.holds)(robot))
        };
        robots.iter().filter(others).count()
    };
    let ways: Vec<String> = criteria
        .iter()
        .enumerate()
        .filter(|_| 1 < criteria.len())
        .map(|(i, criterion)| (without(i), &criterion.written))
        .filter(|(count, _)| 0 < *count)
        .map(|(count, written)| format!("without {written} {count} would match"))
        .collect();
    (!ways.is_empty()).then(|| ways.join("; "))
}

/// The makers, payloads and reaches there are.
fn what_there_is(robots: &[Robot]) -> String {
    let mut vendors: Vec<&str> =
        robots.iter().map(|robot| robot.vendor.as_str()).filter(|name| !name.is_empty()).collect();
    vendors.sort_by_key(|name| name.to_lowercase());
    vendors.dedup();
    let span = |values: &mut dyn Iterator<Item = f64>, unit: &str| {
        let ends = values.fold(None, |ends: Option<Interval>, x| {
            Some(ends.map_or(Interval::point(x), |ends| Interval::spanning(ends.min().min(x), ends.max().max(x))))
        });
        ends.map_or_else(|| format!("no {unit} stated"), |ends| format!("{} to {} {unit}", ends.min(), ends.max()))
    };
    let payload = span(&mut robots.iter().filter_map(|robot| robot.payload_kg), "kg");
    let reach = span(&mut robots.iter().filter_map(|robot| robot.reach), "m");
    format!("there are robots of {}; payload {payload}; reach {reach}", vendors.join(", "))
}

fn written(range: Interval) -> String {
    let end = |x: f64| if x.is_finite() { x.to_string() } else { String::new() };
    format!("{}..{}", end(range.min()), end(range.max()))
}

/// Case, blanks and punctuation do not matter.
fn plain(text: &str) -> String {
    text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
