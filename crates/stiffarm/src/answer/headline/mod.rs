//! What is the answer in a word and a few sentences? What stands at the top of a report, and what that rests on.

mod identify;
mod mill;
mod path_rank;
mod place;
mod rank;

use super::words::fixed;
use super::{Unit, stiffness, stiffnesses};
use crate::robot::{Robot, Status, StiffnessSource};
use crate::uncertainty::Spread;

/// The answer in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The tolerance is held, as far as anybody knows.
    Passes,
    /// It is held at the stiffness told, and not by all drives that may be meant by it.
    PassesPerhaps,
    /// The tolerance is not held.
    Fails,
    /// The arm collides there.
    Collides,
    /// No place was found.
    NoPlace,
    /// A path that cannot be followed where it stands.
    NotFollowed,
    /// Several are as good.
    Tie,
    /// One robot is advised; no tolerance was asked.
    Advised,
    /// Numbers; no tolerance was asked.
    Told,
    /// Every drive is identified.
    Identified,
    /// Some drives are.
    PartlyIdentified,
    /// No drive is.
    NotIdentified,
}

/// What a reader may feel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// It holds.
    Good,
    /// It does not hold.
    Bad,
    /// It is open.
    Open,
    /// Numbers alone.
    Plain,
}

impl Outcome {
    /// In a word or two.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Passes => "pass",
            Self::PassesPerhaps => "pass, not sure",
            Self::Fails => "fail",
            Self::Collides => "collision",
            Self::NoPlace => "no place",
            Self::NotFollowed => "not followed",
            Self::Tie => "tie",
            Self::Advised => "advised",
            Self::Told => "computed",
            Self::Identified => "identified",
            Self::PartlyIdentified => "identified in part",
            Self::NotIdentified => "not identified",
        }
    }

    /// How it sounds.
    pub const fn tone(self) -> Tone {
        match self {
            Self::Passes | Self::Advised | Self::Identified => Tone::Good,
            Self::Fails | Self::Collides | Self::NoPlace | Self::NotFollowed => Tone::Bad,
            Self::PassesPerhaps | Self::Tie | Self::PartlyIdentified | Self::NotIdentified => Tone::Open,
            Self::Told => Tone::Plain,
        }
    }
}

/// The answer as a manager reads it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Headline {
    /// In one word.
    pub outcome: Outcome,
    /// What, by how much, and how sure; each a sentence.
    pub sentences: Vec<String>,
    /// What that rests on; each a sentence.
    pub rests_on: Vec<String>,
}

/// Millimetres, as tables tell them.
fn mm(metres: f64) -> String {
    format!("{} mm", fixed(Unit::Millimetre.told(metres), 4))
}

/// Whether what is held at the stiffness told is held by drives as they may be.
fn judged(passes: bool, spread: Option<Spread>, tolerance_mm: f64) -> Outcome {
    match (passes, spread) {
        (false, _) => Outcome::Fails,
        (true, Some(spread)) if tolerance_mm < Unit::Millimetre.told(spread.p95) => Outcome::PassesPerhaps,
        (true, _) => Outcome::Passes,
    }
}

/// Where the value lies as the drives may be, against a tolerance; nothing where nothing says how they may be.
fn scattered(passes: bool, spread: Option<Spread>, tolerance_mm: f64) -> Option<String> {
    let Spread { p05, p95 } = spread?;
    let [low, high] = [p05, p95].map(|metres| fixed(Unit::Millimetre.told(metres), 3));
    let verdict = match (passes, Unit::Millimetre.told(p05) <= tolerance_mm, Unit::Millimetre.told(p95) <= tolerance_mm)
    {
        (true, _, true) => "so it holds for nearly all of them",
        (true, ..) => {
            "so softer drives among them do not hold it: measure the drives (`stiffarm measure`), or keep more distance"
        }
        (false, true, _) => {
            "so the stiffer of them would hold it: measure the drives (`stiffarm measure`) before it is given up"
        }
        (false, false, _) => "so hardly any of them holds it",
    };
    Some(format!("90 % of such drives give {low} to {high} mm, {verdict}."))
}

/// What every number about a robot rests on.
fn rests_on(robot: &Robot) -> Vec<String> {
    let mut told = vec![format!("Stiffness of {}: {}.", robot.name, stiffness(robot))];
    if robot.stiffness_source() == StiffnessSource::Assumed {
        told.push(ASSUMED.into());
    }
    told.extend(status(robot.status).map(|why| format!("Lengths and limits of {}: {}.", robot.name, why)));
    told
}

/// The same of several robots, their drives alone.
fn drives_rest_on<'a>(robots: impl Iterator<Item = &'a Robot> + Clone) -> Vec<String> {
    let is_assumed = robots.clone().any(|robot| robot.stiffness_source() == StiffnessSource::Assumed);
    let told = format!("Stiffness: {}.", stiffnesses(robots));
    [told].into_iter().chain(is_assumed.then(|| ASSUMED.into())).collect()
}

/// What it means that nobody knows the drives.
const ASSUMED: &str = "No source tells how stiff these drives are: a deflection grows in proportion to what is assumed of them, \
                       and robots of one size can be compared, but a value is no promise.";

/// What a status means for whoever signs.
fn status(status: Status) -> Option<&'static str> {
    match status {
        Status::Identified | Status::DataSheet => None,
        Status::Derived => Some("derived, partly from published figures of the same or a sister model"),
        Status::Estimated => Some("estimated, partly assumed"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_is_as_sure_as_the_drives_are_known() {
        let spread = |p05: f64, p95: f64| Some(Spread { p05: p05 / 1e3, p95: p95 / 1e3 });
        let cases = [
            (true, None, Outcome::Passes, None),
            (true, spread(0.5, 1.9), Outcome::Passes, Some("nearly all")),
            (true, spread(0.5, 2.1), Outcome::PassesPerhaps, Some("softer drives")),
            (false, spread(1.9, 3.0), Outcome::Fails, Some("stiffer of them")),
            (false, spread(2.1, 3.0), Outcome::Fails, Some("hardly any")),
            (false, None, Outcome::Fails, None),
        ];
        for (passes, spread, outcome, words) in cases {
            assert_eq!(judged(passes, spread, 2.0), outcome);
            let told = scattered(passes, spread, 2.0);
            assert_eq!(told.is_some(), words.is_some());
            assert!(words.is_none_or(|words| told.unwrap().contains(words)));
        }
    }

    #[test]
    fn what_fails_never_sounds_good() {
        use Outcome::{Collides, Fails, NoPlace, NotFollowed};
        assert!([Fails, Collides, NoPlace, NotFollowed].iter().all(|one| one.tone() == Tone::Bad));
        assert!(Outcome::Tie.tone() == Tone::Open && Outcome::Passes.tone() == Tone::Good);
    }
}
