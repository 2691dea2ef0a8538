//! Which of many robots are wanted: by maker, payload, reach, architecture and status.
#![allow(rustdoc::broken_intra_doc_links, reason = "help texts put units in brackets")]

use clap::Args;
use stiffarm::catalogue::{Filter, NothingLeft};
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::question::open_range;
use stiffarm::robot::{Robot, Status};

use crate::args::architecture;
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
    pub(crate) payload_kg: Option<Interval>,
    /// Only robots with a reach in this range [m]: A..B; either end may be left open
    #[arg(long, value_name = "RANGE", value_parser = open_range, allow_hyphen_values = true)]
    pub(crate) reach_m: Option<Interval>,
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

impl Filters {
    /// The robots that have all that is asked for, in their order.
    pub(crate) fn keep(&self, robots: Vec<Robot>, words: &[String]) -> Result<Vec<Robot>, Failure> {
        let Self { vendor, payload_kg, reach_m, architecture, status } = self.clone();
        let words = words.to_vec();
        let filter = Filter { words, vendors: vendor, payload_kg, reach: reach_m, architecture, statuses: status };
        let typed = |key: &str| format!("--{}", key.replace('_', "-"));
        let nothing = |NothingLeft { asked, of, hint }| Failure::NothingLeft { asked, of, hint };
        filter.keep(robots, typed).map_err(nothing)
    }
}

#[cfg(test)]
mod tests {
    use stiffarm::catalogue::paper_robots;

    use super::*;

    fn range(min: f64, max: f64) -> Option<Interval> {
        Interval::new(min, max)
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
        assert_eq!(failure.hint(), "without --payload-kg 211..300 1 would match");
        let nobody = Filters { vendor: vec!["nobody".into()], ..Filters::default() };
        let hint = nobody.keep(paper_robots(), &[]).unwrap_err().hint();
        assert_eq!(
            hint,
            "there are robots of ABB, Fanuc, Kawasaki, KUKA, Staubli, Yaskawa; payload 165 to 210 kg; reach 2.4 to 3.507 m"
        );
    }
}
