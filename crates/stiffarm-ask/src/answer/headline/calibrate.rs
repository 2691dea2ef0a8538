//! A calibration in a few sentences.

use super::super::words::{self, fixed};
use super::super::{CalibrateAnswer, Unit};
use super::place::sentence;
use super::{Headline, Outcome};

impl CalibrateAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let found = &self.found;
        let mm = |metres: f64| format!("{} mm", fixed(Unit::Millimetre.of_si(metres), 3));
        let is_known = found.narrow.is_empty() && found.at_work.is_some() && found.moved.is_none();
        let outcome = if is_known { Outcome::Calibrated } else { Outcome::PartlyCalibrated };
        let by = if self.is_chosen { "the level with the largest evidence" } else { "the level that was asked for" };
        let mut sentences = vec![format!(
            "Points on the flange of {} err by {} as drawn and by {} calibrated (root mean square of {} rows; {}, {by}).",
            self.robot.full_name(),
            mm(found.levels[0].rms),
            mm(found.taken().rms),
            found.rows.len(),
            found.level.name()
        )];
        sentences.push(match &found.at_work {
            Some(work) => format!(
                "At the work {} are expected, {} to {} with 95 %; 95th percentile {}.",
                mm(work.expected),
                mm(work.interval[0]),
                mm(work.interval[1]),
                mm(work.p95)
            ),
            None => "The arm does not reach the work: nothing is known of the error there.".into(),
        });
        sentences.push(match found.wrong_rows.len() {
            0 => "No point stands out.".into(),
            1 => "One point is wrong and left out.".into(),
            count => format!("{count} points are wrong and left out."),
        });
        sentences.extend(self.moved());
        let narrow: Vec<String> = found.narrow.iter().map(|(joint, _)| joint.to_string()).collect();
        if !narrow.is_empty() {
            sentences.push(format!(
                "Joints that moved over less than a third of their range: {}. Elsewhere little is known of them.",
                narrow.join(", ")
            ));
        }
        let mut rests_on = vec![
            format!("Lengths as the robot file has them: {}.", words::class(&self.robot)),
            "The interval at the work is that of this model, with what is predicted of rows that were left out as its noise.".into(),
        ];
        rests_on.extend(self.rests().lines().map(sentence));
        Headline { outcome, sentences, rests_on }
    }
}
