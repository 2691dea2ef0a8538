//! An identification in a few sentences.

use super::super::words::{self, fixed};
use super::super::{IdentifyAnswer, Unit};
use super::place::sentence;
use super::{Headline, Outcome};
use stiffarm::identify::{Estimate, Spring};

impl IdentifyAnswer {
    /// What a manager would read.
    pub fn headline(&self) -> Headline {
        let found = &self.found;
        let of_drives =
            || found.estimates.iter().filter(|one| matches!(one.spring, Spring::Drive(_) | Spring::Region(_)));
        let is_known = |one: &&Estimate| one.unknown.is_none();
        let (all, known) = (of_drives().count(), of_drives().filter(is_known).count());
        let outcome = match known {
            0 => Outcome::NotIdentified,
            some if some == all => Outcome::Identified,
            _ => Outcome::PartlyIdentified,
        };
        let percent = |share: f64| format!("{} %", fixed(100.0 * share, 1));
        let mm = |metres: f64| format!("{} mm", fixed(Unit::Millimetre.of_si(metres), 3));
        let mut sentences = vec![format!(
            "{known} of {all} compliances of the drives of {} are identified, from {} readings in {} postures.",
            self.before.full_name(),
            found.residuals.len(),
            found.postures
        )];
        let left_out = found.explained_left_out().map_or_else(String::new, |explained| {
            format!(", and {} of it where each posture is predicted by the others alone", percent(explained))
        });
        sentences.push(format!(
            "They explain {} of how far the tool moved ({} root mean square){left_out}; {} is not explained.",
            percent(found.explained()),
            mm(found.before),
            mm(found.after)
        ));
        let others: Vec<String> = of_drives().filter(|one| !is_known(one)).map(|one| one.spring.name()).collect();
        if !others.is_empty() {
            sentences.push(format!("Not identified: {}.", others.join(", ")));
        }
        sentences.push(match found.outliers.len() {
            0 => "No reading stands out.".into(),
            1 => "One reading does not fit.".into(),
            count => format!("{count} readings do not fit."),
        });
        let mut rests_on = vec![
            format!("Lengths and limits as the robot file has them: {}.", words::class(&self.before)),
            format!("Model: {}, everything else is rigid.", super::super::identify::springing(found.model)),
        ];
        rests_on.extend(self.notes().lines().filter(|line| !line.starts_with("-o ")).map(sentence));
        Headline { outcome, sentences, rests_on }
    }
}
