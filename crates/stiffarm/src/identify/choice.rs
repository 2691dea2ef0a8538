//! Which model of what springs is taken?

use super::model::Springs;
use super::posterior::updated;
use super::work::Work;
use super::{Identification, IdentifyError, Options};
use crate::catalogue::measurements::Measurements;
use crate::prior::{NoPrior, with_prior};
use crate::robot::{Arm, Robot};
use crate::watch::Watch;

/// A model that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Tried {
    /// What springs.
    pub model: Springs,
    /// How well that fits, or why the rows cannot tell it.
    pub fit: Result<Fit, IdentifyError>,
}

/// How well a model fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// What is left of a coordinate where its posture is left out, m; `None` where a posture alone shows some spring.
    pub left_out: Option<f64>,
    /// Schwarz's criterion, `n ln(mean square) + p ln n`: less is better.
    pub bic: f64,
}

/// A richer model must be better by so much in Schwarz's criterion (very strong evidence), and miss this share less where postures are left out.
const CLEARLY: f64 = 10.0;
const MISSES_LESS: f64 = 0.02;

/// Those that can be tried of a robot, the simplest first.
fn models(robot: &Robot) -> Vec<Springs> {
    let of_compensator: &[Springs] =
        if has_compensator(robot) { &[Springs::Compensator, Springs::Preload] } else { &[] };
    [&[Springs::Drives, Springs::Base, Springs::Tool, Springs::Regions, Springs::All], of_compensator].concat()
}

/// Finds the compliances of the drives, and of what else is taken to spring.
///
/// # Errors
/// Where the rows cannot tell any, and [`IdentifyError::Stopped`] where the work is no longer wanted.
pub fn identify(
    robot: &Robot,
    measured: &Measurements,
    options: &Options,
    watch: Watch,
) -> Result<Identification, IdentifyError> {
    if options.with_prior && options.model != Springs::Drives {
        return Err(IdentifyError::PriorOfDrives(options.model.name()));
    }
    let question = Question::of(robot, measured, options, watch)?;
    if options.model == Springs::Auto { question.chosen() } else { question.of_model(options.model) }
}

/// What is asked, and what was known of the drives before.
struct Question<'a> {
    known: Robot,
    remarks: Vec<String>,
    measured: &'a Measurements,
    options: &'a Options,
    watch: Watch<'a>,
}

impl<'a> Question<'a> {
    fn of(
        robot: &Robot,
        measured: &'a Measurements,
        options: &'a Options,
        watch: Watch<'a>,
    ) -> Result<Self, IdentifyError> {
        let mut remarks = measured.remarks.clone();
        // What is not identified keeps what is known of it: by its file, else by its size.
        let known = match with_prior(robot) {
            _ if !robot.stiffness_is_assumed => robot.clone(),
            Ok(known) => known,
            Err(NoPrior::Planar(name)) => return Err(IdentifyError::Planar(name)),
            Err(why @ NoPrior::Size(_)) => {
                remarks.push(format!("drives that are not identified keep the assumed 1 urad/(N m): {why}"));
                robot.clone()
            }
        };
        Ok(Self { known, remarks, measured, options, watch })
    }

    fn of_model(&self, model: Springs) -> Result<Identification, IdentifyError> {
        if matches!(model, Springs::Compensator | Springs::Preload) && !has_compensator(&self.known) {
            return Err(IdentifyError::NoCompensator(self.known.name.clone()));
        }
        let readings = &self.measured.readings;
        let springs = &model.springs(self.options.regions);
        let least = springs.len() / 3 + 1;
        if readings.len() < least {
            return Err(IdentifyError::TooFew { readings: readings.len(), unknowns: springs.len(), least });
        }
        let work = Work::of(&self.known, readings, springs, self.options, self.watch)?;
        let fitted = work.identification(self.options, &self.remarks)?;
        let found = if self.options.with_prior { updated(&work, fitted, self.options)? } else { fitted.found };
        // A robot file has one compliance of drive 2.
        let robot = if model == Springs::Regions { self.of_model(Springs::Drives)?.robot } else { found.robot };
        Ok(Identification { robot, model, ..found })
    }

    /// The simplest model that none is clearly better than.
    fn chosen(&self) -> Result<Identification, IdentifyError> {
        let models = models(&self.known);
        let parts = self.watch.parts(Some(models.len()));
        let mut best = self.of_model(Springs::Drives)?;
        parts.one_more()?;
        let mut known = fit(&best);
        let mut tried = vec![Tried { model: Springs::Drives, fit: Ok(known) }];
        for model in models.into_iter().skip(1) {
            parts.one_more()?;
            let found = match self.of_model(model) {
                Ok(found) => found,
                Err(IdentifyError::Stopped(stopped)) => return Err(stopped.into()),
                // A model that the rows cannot tell is none to be chosen.
                Err(why) => {
                    tried.push(Tried { model, fit: Err(why) });
                    continue;
                }
            };
            let one = fit(&found);
            tried.push(Tried { model, fit: Ok(one) });
            let misses_less =
                one.left_out.zip(known.left_out).is_some_and(|(rich, simple)| rich < (1.0 - MISSES_LESS) * simple);
            if one.bic < known.bic - CLEARLY && misses_less {
                (best, known) = (found, one);
            }
        }
        Ok(Identification { tried, ..best })
    }
}

fn has_compensator(robot: &Robot) -> bool {
    matches!(&robot.arm, Arm::SixAxis { drives, .. } if drives.compensator.is_some())
}

fn fit(found: &Identification) -> Fit {
    let count = (3 * found.residuals.len()) as f64;
    let springs = found.estimates.iter().filter(|one| one.compliance.is_some_and(|k| 0.0 < k)).count() as f64;
    Fit { left_out: found.left_out, bic: count * (found.after * found.after).ln() + springs * count.ln() }
}
