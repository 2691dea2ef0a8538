//! Is a tolerance held, how sure is that, and what does it mean?

use super::words::fixed;
use super::{Record, Unit, field};

/// With this probability or more a tolerance that is held nominally is held.
pub const SURE: f64 = 0.95;

/// What every verdict is about, and what it is not about.
pub const HOLDS: &str = "\"Holds\" means: the elastic deflection of the drives under the mean force is no more than the tolerance. Backlash, calibration, \
                         temperature, and the deflection of spindle holder and cutter are not in it; they come on top.";

/// How large these usually are, and who says so.
pub const ON_TOP: [&str; 4] = [
    "Backlash: reducers of robot joints are sold with 1 arc minute (Nabtesco, catalogues of the series RV-E and RV-N), which is 0.29 mm for each metre between joint and tool.",
    "Calibration: a robot that was not calibrated was within 0.65 mm where it was sent and within 0.04 mm where it had been before (ABB IRB 1600; Slamani, Nubiola and Bonev, Industrial Robot 39, 2012).",
    "Temperature: two metres of aluminium grow by 0.46 mm in 10 K (23 um/(m K)), of cast iron by half of that.",
    "Cutter: solid carbide of 10 mm that stands out 40 mm deflects by 0.02 mm under 300 N (cantilever, 600 GPa), and its holder adds to that.",
];

/// Between what bars an answer and its deflection.
const BY_DEFLECTION: &str = "; by the deflection alone: ";

/// Why an answer is no, whatever the deflection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Barred {
    /// The arm, or the work, overlaps with something, or comes nearer to it than was asked.
    Collides,
    /// Tool and force are more than the robot may carry.
    Overloaded,
    /// The cut swings.
    Chatters,
}

impl Barred {
    const ALL: [Self; 3] = [Self::Collides, Self::Overloaded, Self::Chatters];

    /// In a word or two.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Collides => "collision",
            Self::Overloaded => "load exceeded",
            Self::Chatters => "chatter",
        }
    }

    /// The one that a text says: as a verdict, or loud beside a number.
    pub(super) fn in_text(text: &str) -> Option<Self> {
        let says = |barred: &Self| {
            let word = barred.word();
            text == word || text.contains(&format!("{word}{BY_DEFLECTION}")) || text.contains(&word.to_uppercase())
        };
        Self::ALL.into_iter().find(says)
    }
}

/// Whether a tolerance is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// The deflection is no larger than the tolerance, at the nominal stiffness.
    pub passes: bool,
    /// What is left of the tolerance, mm; negative where it is not held.
    pub margin_mm: f64,
    /// How likely the robot is to hold it, as far as drives and model may be off; `None` where nothing is known of that.
    pub probability: Option<f64>,
    /// Something that it is not about is known to err by so much that the tolerance is not kept: the geometry of an arm that nobody calibrated, or
    /// what its calibration leaves.
    pub is_of_drives_alone: bool,
    /// Why the answer is no all the same.
    pub barred: Option<Barred>,
}

impl Verdict {
    /// Of a deflection, m, against a tolerance, mm, at the nominal stiffness.
    pub fn of(deflection: f64, tolerance_mm: f64) -> Self {
        let deflection_mm = Unit::Millimetre.of_si(deflection);
        let (passes, margin_mm) = (deflection_mm <= tolerance_mm, tolerance_mm - deflection_mm);
        Self { passes, margin_mm, probability: None, is_of_drives_alone: false, barred: None }
    }

    /// The same with how likely it is to be held.
    #[must_use]
    pub const fn with(self, probability: Option<f64>) -> Self {
        Self { probability, ..self }
    }

    /// It is held nominally, and with 95 % or more, nothing else is known to exceed the tolerance, and nothing bars it.
    pub fn is_sure(self) -> bool {
        self.passes
            && !self.is_of_drives_alone
            && self.barred.is_none()
            && self.probability.is_some_and(|probability| SURE <= probability)
    }

    /// It is held nominally, and more likely missed than held.
    pub fn is_rather_missed(self) -> bool {
        self.passes && self.probability.is_some_and(|probability| probability < 0.5)
    }

    /// `pass`, `pass, not sure`, `fail`, or what bars it.
    pub fn word(self) -> &'static str {
        match (self.barred, self.passes, self.is_sure()) {
            (Some(barred), ..) => barred.word(),
            (None, true, true) => "pass",
            (None, true, false) => "pass, not sure",
            (None, false, _) => "fail",
        }
    }

    /// The word, and how likely it is to be held: `pass, not sure (P = 84 %)`. Below 50 % it is more likely missed, and that is said.
    pub fn in_words(self) -> String {
        if let Some(barred) = self.barred {
            let of_deflection = Self { barred: None, ..self }.in_words();
            return format!("{}{BY_DEFLECTION}{of_deflection}", barred.word());
        }
        match self.probability {
            Some(probability) => {
                let of_drives = if self.passes && self.is_of_drives_alone { " of the drives alone" } else { "" };
                let missed = if self.is_rather_missed() { ": more likely missed" } else { "" };
                format!("{} (P = {}{of_drives}{missed})", self.word(), percent(probability))
            }
            None if self.passes => format!("{} (P not known)", self.word()),
            None => self.word().into(),
        }
    }

    /// The same as it stands in a column beside a deflection: `pass +0.120, P 97 %`, `COLLISION`.
    pub(super) fn short(self) -> String {
        if let Some(barred) = self.barred {
            return barred.word().to_uppercase();
        }
        let alone = if self.passes && self.is_of_drives_alone { " (drives)" } else { "" };
        let probability = self.probability.map_or_else(String::new, |known| format!(", P {}{alone}", percent(known)));
        format!("{} {:+.3}{probability}", self.word(), self.margin_mm)
    }
}

/// Never more than it is: what is not sure is not given as 95 %.
pub(super) fn percent(probability: f64) -> String {
    format!("{} %", fixed((100.0 * probability + 1e-9).floor(), 0))
}

/// Tolerance, verdict and margin as fields; `pass` stays nominal. Where there is no place no tolerance is held.
pub(super) fn put(record: &mut Record, tolerance_mm: Option<f64>, verdict: Option<Verdict>, is_nowhere: bool) {
    let fails = tolerance_mm.filter(|_| is_nowhere);
    record
        .put(field::TOLERANCE, tolerance_mm)
        .put(field::PASS, verdict.map(|verdict| verdict.passes).or(fails.map(|_| false)))
        .put(field::VERDICT, verdict.map(Verdict::word).or(fails.map(|_| "fail")))
        .put(field::PROBABILITY, verdict.and_then(|verdict| verdict.probability))
        .put(field::MARGIN, verdict.map(|verdict| verdict.margin_mm));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The three words of the border, on either side of each of its two bounds.
    #[test]
    fn a_verdict_is_sure_from_95_percent_and_fails_by_the_nominal_value_alone() {
        let cases = [
            (2.0, Some(0.95), "pass", "pass (P = 95 %)"),
            (2.0, Some(0.9499), "pass, not sure", "pass, not sure (P = 94 %)"),
            (2.0, Some(1.0), "pass", "pass (P = 100 %)"),
            (2.0, Some(0.35), "pass, not sure", "pass, not sure (P = 35 %: more likely missed)"),
            (2.0, None, "pass, not sure", "pass, not sure (P not known)"),
            (2.000_001, Some(0.45), "fail", "fail (P = 45 %)"),
            (2.000_001, None, "fail", "fail"),
        ];
        for (mm, probability, word, expected) in cases {
            let verdict = Verdict::of(mm / 1e3, 2.0).with(probability);
            assert_eq!((verdict.word(), verdict.in_words().as_str()), (word, expected));
        }
        assert_eq!(Verdict::of(1.8e-3, 2.0).with(Some(0.97)).short(), "pass +0.200, P 97 %");
    }

    #[test]
    fn what_bars_an_answer_comes_before_its_deflection() {
        let verdict = Verdict { barred: Some(Barred::Overloaded), ..Verdict::of(1.8e-3, 2.0).with(Some(0.97)) };
        assert!(verdict.passes && !verdict.is_sure());
        assert_eq!((verdict.word(), verdict.short().as_str()), ("load exceeded", "LOAD EXCEEDED"));
        assert_eq!(verdict.in_words(), "load exceeded; by the deflection alone: pass (P = 97 %)");
        assert_eq!(Barred::in_text(&verdict.in_words()), Some(Barred::Overloaded));
        let judged = format!("20 mm: {}, margin 1.2 mm", verdict.in_words());
        assert_eq!([judged.as_str(), "0.102 LOAD EXCEEDED"].map(Barred::in_text), [Some(Barred::Overloaded); 2]);
        assert_eq!(["pass (P = 97 %)", "Chatter: robot modes calm"].map(Barred::in_text), [None; 2]);
    }

    /// By hand: 1 arc minute is 1/60 deg; a cantilever bends by F L^3 / (3 E I), with I = pi d^4 / 64.
    #[test]
    fn what_comes_on_top_is_as_large_as_it_is_stated() {
        let of_a_metre = (1.0_f64 / 60.0).to_radians();
        let inertia = std::f64::consts::PI * 0.01_f64.powi(4) / 64.0;
        let bends = 300.0 * 0.04_f64.powi(3) / (3.0 * 600e9 * inertia);
        let grows = 2.0 * 23e-6 * 10.0;
        for (metres, expected, says) in [(of_a_metre, "0.29 mm", 0), (grows, "0.46 mm", 2), (bends, "0.02 mm", 3)] {
            assert_eq!(format!("{:.2} mm", metres * 1e3), expected);
            assert!(ON_TOP[says].contains(expected));
        }
    }
}
