//! Which of many robots are wanted: by maker, payload, reach, architecture and status.
#![allow(rustdoc::broken_intra_doc_links, reason = "help texts put units in brackets")]

use clap::Args;
use stiffarm::drive::Architecture;
use stiffarm::limits::Range;
use stiffarm::robot::{Robot, Status};

use crate::args::{architecture, open_range};
use crate::failure::Failure;

/// What a robot must have; all of it.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Which robots")]
pub(crate) struct Filters {
    /// Only robots of these makers, separated by commas
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub(crate) vendor: Vec<String>,
    /// Only robots with a payload in this range [kg]: A..B; either end may be left open
    #[arg(long, value_name = "RANGE", value_parser = open_range, allow_hyphen_values = true)]
    pub(crate) payload_kg: Option<Range>,
    /// Only robots with a reach in this range [m]: A..B; either end may be left open
    #[arg(long, value_name = "RANGE", value_parser = open_range, allow_hyphen_values = true)]
    pub(crate) reach_m: Option<Range>,
    /// Only robots of this architecture: serial or quasi-serial
    #[arg(long, value_name = "NAME", value_parser = architecture)]
    pub(crate) architecture: Option<Architecture>,
    /// Only robots of these statuses: identified, data-sheet, derived, estimated; separated by commas
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = status)]
    pub(crate) status: Vec<Status>,
}

fn status(text: &str) -> Result<Status, String> {
    let known = Status::ALL.into_iter().find(|status| status.name() == text);
    known.ok_or_else(|| "expected identified, data-sheet, derived or estimated".into())
}

/// One thing that is asked of a robot: how it is written, and whether a robot has it.
struct Wish<'a> {
    written: String,
    holds: Box<dyn Fn(&Robot) -> bool + 'a>,
}

impl<'a> Wish<'a> {
    fn new(written: String, holds: impl Fn(&Robot) -> bool + 'a) -> Self {
        Self { written, holds: Box::new(holds) }
    }
}

impl Filters {
    /// The robots that have all that is asked for, in their order.
    ///
    /// A missing payload or reach lies in no range. Where nothing is left, the failure says what would match.
    pub(crate) fn keep(&self, robots: Vec<Robot>, words: &[String]) -> Result<Vec<Robot>, Failure> {
        let wishes = self.wishes(words);
        let kept = |robot: &Robot| wishes.iter().all(|wish| (wish.holds)(robot));
        if robots.iter().any(kept) {
            return Ok(robots.into_iter().filter(kept).collect());
        }
        let written: Vec<&str> = wishes.iter().map(|wish| wish.written.as_str()).collect();
        let hint = match_without_one(&robots, &wishes).unwrap_or_else(|| what_there_is(&robots));
        Err(Failure::NothingLeft { asked: written.join(" "), of: robots.len(), hint })
    }

    fn wishes<'a>(&'a self, words: &'a [String]) -> Vec<Wish<'a>> {
        let mut wishes: Vec<Wish> = Vec::new();
        for word in words.iter().flat_map(|words| words.split_whitespace()) {
            wishes.push(Wish::new(format!("'{word}'"), move |robot| plain(&robot.full_name()).contains(&plain(word))));
        }
        if !self.vendor.is_empty() {
            wishes.push(Wish::new(format!("--vendor {}", self.vendor.join(",")), |robot| {
                self.vendor.iter().any(|vendor| plain(vendor) == plain(&robot.vendor))
            }));
        }
        if let Some(range) = self.payload_kg {
            let holds = move |robot: &Robot| robot.payload_kg.is_some_and(|kg| range.contains(kg, 0.0));
            wishes.push(Wish::new(format!("--payload-kg {}", written(range)), holds));
        }
        if let Some(range) = self.reach_m {
            let holds = move |robot: &Robot| robot.reach.is_some_and(|reach| range.contains(reach, 0.0));
            wishes.push(Wish::new(format!("--reach-m {}", written(range)), holds));
        }
        if let Some(architecture) = self.architecture {
            let holds = move |robot: &Robot| robot.architecture == architecture;
            wishes.push(Wish::new(format!("--architecture {architecture}"), holds));
        }
        if !self.status.is_empty() {
            let names: Vec<&str> = self.status.iter().map(|status| status.name()).collect();
            let holds = |robot: &Robot| self.status.contains(&robot.status);
            wishes.push(Wish::new(format!("--status {}", names.join(",")), holds));
        }
        wishes
    }
}

/// How many robots each single wish keeps out.
fn match_without_one(robots: &[Robot], wishes: &[Wish]) -> Option<String> {
    let without = |left_out: usize| {
        let others = |robot: &&Robot| wishes.iter().enumerate().all(|(i, wish)| i == left_out || (wish.holds)(robot));
        robots.iter().filter(others).count()
    };
    let ways: Vec<String> = wishes
        .iter()
        .enumerate()
        .filter(|_| 1 < wishes.len())
        .map(|(i, wish)| (without(i), &wish.written))
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
        let ends = values.fold(None, |ends: Option<Range>, x| {
            Some(ends.map_or(Range::point(x), |ends| Range::spanning(ends.min().min(x), ends.max().max(x))))
        });
        ends.map_or_else(|| format!("no {unit} stated"), |ends| format!("{} to {} {unit}", ends.min(), ends.max()))
    };
    let payload = span(&mut robots.iter().filter_map(|robot| robot.payload_kg), "kg");
    let reach = span(&mut robots.iter().filter_map(|robot| robot.reach), "m");
    format!("there are robots of {}; payload {payload}; reach {reach}", vendors.join(", "))
}

fn written(range: Range) -> String {
    let end = |x: f64| if x.is_finite() { x.to_string() } else { String::new() };
    format!("{}..{}", end(range.min()), end(range.max()))
}

/// Case, blanks and punctuation do not matter.
fn plain(text: &str) -> String {
    text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use stiffarm::catalogue::paper_robots;

    use super::*;

    fn range(min: f64, max: f64) -> Option<Range> {
        Range::new(min, max)
    }

    fn names(filters: &Filters, words: &[&str]) -> Vec<String> {
        let words: Vec<String> = words.iter().map(|&word| word.into()).collect();
        filters.keep(paper_robots(), &words).unwrap().into_iter().map(|robot| robot.name).collect()
    }

    #[test]
    fn every_wish_must_be_met_and_the_ends_of_a_range_belong_to_it() {
        let kuka = Filters { vendor: vec!["kuka".into(), "STAUBLI".into()], ..Filters::default() };
        assert_eq!(names(&kuka, &[]), ["KR 210 R2700 extra", "TX340 SH"]);
        assert_eq!(names(&Filters { payload_kg: range(210.0, 210.0), ..kuka.clone() }, &[]), ["KR 210 R2700 extra"]);
        assert_eq!(names(&Filters { reach_m: range(3.45, f64::INFINITY), ..kuka.clone() }, &[]), ["TX340 SH"]);
        let serial = Filters { architecture: Some(Architecture::Serial), status: vec![Status::Derived], ..kuka };
        assert!(serial.keep(paper_robots(), &[]).is_err());
        assert_eq!(names(&Filters::default(), &["fanuc 210"]), ["R-2000iC/210R"]);
        assert_eq!(names(&Filters::default(), &["irb-66"]), ["IRB 6650S-200"]);
        assert_eq!(names(&Filters::default(), &[]).len(), 10);
    }

    #[test]
    fn what_nothing_meets_is_answered_with_what_would_match() {
        let heavy = Filters { vendor: vec!["KUKA".into()], payload_kg: range(211.0, 300.0), ..Filters::default() };
        let failure = heavy.keep(paper_robots(), &[]).unwrap_err();
        assert_eq!(failure.to_string(), "none of 10 robots matches --vendor KUKA --payload-kg 211..300");
        assert_eq!(failure.hint().unwrap(), "without --payload-kg 211..300 1 would match");
        let nobody = Filters { vendor: vec!["nobody".into()], ..Filters::default() };
        let hint = nobody.keep(paper_robots(), &[]).unwrap_err().hint().unwrap();
        assert_eq!(
            hint,
            "there are robots of ABB, Fanuc, Kawasaki, KUKA, Staubli, Yaskawa; payload 165 to 210 kg; reach 2.4 to 3.507 m"
        );
    }
}
