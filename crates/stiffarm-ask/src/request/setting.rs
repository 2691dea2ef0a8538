//! What is said of an option: its row in the table.

use super::kind::{Count, Kind};
use super::verb::Verb;

/// Under which heading help tells what chooses among robots.
pub(super) const FILTERS: &str = "Which robots";
/// The heading of what matters to the program's figures alone.
pub(super) const DRAWN: &str = "Figure";

/// Which model an option belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// Every model, and verbs that have only one.
    Any,
    /// The paper's.
    Planar,
    /// All six drives.
    Spatial,
}

/// What happens where an option is not given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absent {
    /// As if this were given.
    Default(&'static str),
    /// What a value cannot say, in words.
    Means(&'static str),
    /// Nothing that needs words.
    Optional,
    /// It must be given.
    Required,
}

/// One option.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// The long name: `--NAME` on the command line, `NAME` in a job file.
    pub name: &'static str,
    /// The keyword in Python, where it is not the name with underscores.
    pub keyword: &'static str,
    /// The verbs that know it.
    pub verbs: &'static [Verb],
    /// The models that know it.
    pub of: Of,
    /// What it takes.
    pub kind: Kind,
    /// How many of that.
    pub count: Count,
    /// For help; empty where there is none.
    pub unit: &'static str,
    /// What stands for its value in help.
    pub value: &'static str,
    /// Without it.
    pub absent: Absent,
    /// In a verb, the option without which it has no meaning; of several each will do.
    pub needs: &'static [(Verb, &'static str)],
    /// Options that say the same in another way.
    pub excludes: &'static [&'static str],
    /// One line.
    pub help: &'static str,
    /// Under which heading help tells it; empty for the usual.
    pub heading: &'static str,
    /// A value that is understood.
    pub example: &'static str,
    /// On the command line it stands without its name.
    pub is_positional: bool,
}

impl Setting {
    /// Options of which one is needed in a verb; none where it stands alone.
    pub fn needed_by(&self, verb: Verb) -> impl Iterator<Item = &'static str> {
        self.needs.iter().filter(move |(of, _)| *of == verb).map(|(_, name)| *name)
    }

    /// Several values may be given.
    pub fn is_list(&self) -> bool {
        1 < self.count.most
    }

    /// It changes the figures of the program, and no number.
    pub fn is_of_figures(&self) -> bool {
        self.heading == DRAWN
    }

    /// Its keyword in Python.
    pub fn keyword(&self) -> String {
        if self.keyword.is_empty() { self.name.replace('-', "_") } else { self.keyword.into() }
    }

    /// The line of help with the unit in brackets behind its first clause, and what happens without the option.
    pub fn described(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" [{}]", self.unit) };
        let clause = self.help.find([':', ',', ';']).unwrap_or(self.help.len());
        let (first, rest) = self.help.split_at(clause);
        let absent = match self.absent {
            Absent::Means(words) => format!(" [default: {words}]"),
            _ => String::new(),
        };
        let model = if self.of == Of::Planar { " [planar model only]" } else { "" };
        format!("{first}{unit}{rest}{absent}{model}")
    }
}
