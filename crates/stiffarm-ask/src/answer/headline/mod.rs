//! What is the answer in a word and a few sentences? What stands at the top of a report, and what that rests on.

mod calibrate;
mod identify;
mod mill;
mod modes;
mod path_rank;
mod place;
mod rank;

use super::uncertainty::of_what;
use super::verdict::{Barred, HOLDS, SURE, Verdict, percent};
use super::words::{fixed, status};
use super::{Unit, stiffness, stiffnesses};
use stiffarm::robot::{Robot, Status, StiffnessSource};
use stiffarm::uncertainty::Spread;

/// The answer in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The tolerance is held, with a probability of 95 % or more.
    Passes,
    /// It is held at the nominal stiffness, with a probability of less than that or one that nobody knows.
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
    /// Tool and force are more than the robot may carry.
    Overloaded,
    /// The cut swings.
    Chatters,
    /// One robot is advised; no tolerance was asked.
    Advised,
    /// Numbers; no tolerance was asked.
    Computed,
    /// Every drive is identified.
    Identified,
    /// Some drives are.
    PartlyIdentified,
    /// No drive is.
    NotIdentified,
    /// The error that remains at the work is known.
    Calibrated,
    /// It is not, or some joints hardly moved.
    PartlyCalibrated,
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
            Self::Collides => Barred::Collides.word(),
            Self::NoPlace => "no place",
            Self::NotFollowed => "not followed",
            Self::Tie => "tie",
            Self::Overloaded => Barred::Overloaded.word(),
            Self::Chatters => Barred::Chatters.word(),
            Self::Advised => "advised",
            Self::Computed => "computed",
            Self::Identified => "identified",
            Self::PartlyIdentified => "identified in part",
            Self::NotIdentified => "not identified",
            Self::Calibrated => "calibrated",
            Self::PartlyCalibrated => "calibrated in part",
        }
    }

    /// How it sounds.
    pub const fn tone(self) -> Tone {
        match self {
            Self::Passes | Self::Advised | Self::Identified | Self::Calibrated => Tone::Good,
            Self::Fails | Self::Collides | Self::NoPlace | Self::NotFollowed | Self::Overloaded | Self::Chatters => {
                Tone::Bad
            }
            Self::PassesPerhaps | Self::Tie | Self::PartlyIdentified | Self::NotIdentified | Self::PartlyCalibrated => {
                Tone::Open
            }
            Self::Computed => Tone::Plain,
        }
    }
}

/// How the verdict in a text sounds, where one stands in it.
pub fn tone_of(text: &str) -> Option<Tone> {
    let says = |word: &str| text.split([' ', ',', ':', ';']).any(|part| part == word);
    match () {
        () if says("fail") || Barred::in_text(text).is_some() => Some(Tone::Bad),
        () if text.contains("pass, not sure") => Some(Tone::Open),
        () if says("pass") => Some(Tone::Good),
        () => None,
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
    format!("{} mm", fixed(Unit::Millimetre.of_si(metres), 4))
}

/// In a word.
fn judged(verdict: Verdict) -> Outcome {
    match (verdict.barred, verdict.passes, verdict.is_sure()) {
        (Some(barred), ..) => Outcome::from(barred),
        (None, false, _) => Outcome::Fails,
        (None, true, false) => Outcome::PassesPerhaps,
        (None, true, true) => Outcome::Passes,
    }
}

impl From<Barred> for Outcome {
    fn from(barred: Barred) -> Self {
        match barred {
            Barred::Collides => Self::Collides,
            Barred::Overloaded => Self::Overloaded,
            Barred::Chatters => Self::Chatters,
        }
    }
}

/// What a sentence about a tolerance that passes adds where the deflection more likely lies above it than below.
fn proviso(verdict: Verdict) -> &'static str {
    if verdict.is_rather_missed() { ", at the nominal stiffness; it more likely misses it" } else { "" }
}

/// How likely the tolerance is held, where the value lies, and what to do about it.
fn scattered(verdict: Verdict, spread: Option<Spread>, robot: &Robot) -> String {
    let Some((probability, Spread { p05, median, p95 })) = verdict.probability.zip(spread) else {
        return match robot.stiffness_source() {
            StiffnessSource::Assumed => {
                "How likely that is is not known: nothing is known of the drives; --stiffness prior takes what robots of this size have, `stiffarm measure` and `identify` what this one has.".into()
            }
            _ => "Its probability is not known: the drive stiffness has no stated uncertainty.".into(),
        };
    };
    let [low, middle, high] = [p05, median, p95].map(|metres| fixed(Unit::Millimetre.of_si(metres), 3));
    let measure = if robot.identified().is_some() {
        "measure in more postures and with more loads (`stiffarm measure`)"
    } else {
        "measure the drives (`stiffarm measure`)"
    };
    let advice = match (verdict.passes, verdict.is_sure()) {
        // What is missed then is not for want of the drives.
        (true, false) if SURE <= probability => String::new(),
        (true, false) => format!(": {measure}, or keep more distance"),
        (false, _) if 0.05 <= probability => format!(": {measure} before it is given up"),
        (true, true) | (false, _) => String::new(),
    };
    let it = if verdict.passes && verdict.is_of_drives_alone { "By the drives alone it" } else { "It" };
    format!(
        "{it} is held with a probability of {}: the 90 % interval ({}) is {low} to {high} mm, the median {middle} mm{advice}.",
        percent(probability),
        of_what(robot)
    )
}

/// What every verdict rests on first: what it is about.
fn means(tolerance_mm: Option<f64>) -> Option<String> {
    tolerance_mm.map(|_| HOLDS.to_owned())
}

/// What every number about a robot rests on.
fn rests_on(robot: &Robot) -> Vec<String> {
    let mut sentences = vec![format!("Stiffness of {}: {}.", robot.name, stiffness(robot))];
    if robot.stiffness_source() == StiffnessSource::Assumed {
        sentences.push(ASSUMED.into());
    }
    sentences.extend(known(robot).map(|why| format!("Lengths and limits of {}: {}.", robot.name, why)));
    sentences
}

/// The same of several robots, their drives alone.
fn drives_rest_on<'a>(robots: impl Iterator<Item = &'a Robot> + Clone) -> Vec<String> {
    let is_assumed = robots.clone().any(|robot| robot.stiffness_source() == StiffnessSource::Assumed);
    let drives = format!("Stiffness: {}.", stiffnesses(robots));
    [drives].into_iter().chain(is_assumed.then(|| ASSUMED.into())).collect()
}

/// What it means that nobody knows the drives.
const ASSUMED: &str = "No source tells how stiff these drives are: a deflection grows in proportion to what is assumed of them, \
                       and robots of one size can be compared, but a value is no promise.";

/// What a status means for whoever signs.
fn known(robot: &Robot) -> Option<&'static str> {
    match robot.status {
        Status::DataSheet if status(robot) != Status::DataSheet.name() => {
            Some("from a published robot description (URDF), not from the maker's data sheet")
        }
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
        let robot = stiffarm::catalogue::paper_robots().swap_remove(4);
        let spread = Spread { p05: 0.5e-3, median: 1.1e-3, p95: 2.1e-3 };
        let cases = [
            (1.0, None, Outcome::PassesPerhaps, "nothing is known of the drives"),
            (
                1.0,
                Some(0.97),
                Outcome::Passes,
                "probability of 97 %: the 90 % interval (drive stiffness) is 0.500 to 2.100 mm, the median 1.100 mm.",
            ),
            (1.0, Some(0.94), Outcome::PassesPerhaps, "keep more distance"),
            (2.5, Some(0.2), Outcome::Fails, "before it is given up"),
            (2.5, Some(0.01), Outcome::Fails, "probability of 1 %"),
            (2.5, None, Outcome::Fails, "is not known"),
        ];
        for (mm, probability, outcome, words) in cases {
            let verdict = Verdict::of(mm / 1e3, 2.0).with(probability);
            assert_eq!(judged(verdict), outcome);
            let text = scattered(verdict, probability.map(|_| spread), &robot);
            assert!(text.contains(words), "{text}");
        }
    }

    #[test]
    fn what_fails_never_sounds_good() {
        use Outcome::{Collides, Fails, NoPlace, NotFollowed};
        assert!([Fails, Collides, NoPlace, NotFollowed].iter().all(|one| one.tone() == Tone::Bad));
        assert!(Outcome::Tie.tone() == Tone::Open && Outcome::Passes.tone() == Tone::Good);
    }
}
