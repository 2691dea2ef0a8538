//! What is asked too much of one server? What would need memory or rows without end; the command line takes it.

use hyper::StatusCode;
use stiffarm::map::{Extent, Spacing};
use stiffarm_ask::request::{Request, Verb};

use super::reply::Refused;

/// Points along the longer side of a map.
const MOST_POINTS: usize = 1000;
/// The same as a distance, m: of robots that reach 4 m.
const LEAST_STEP: f64 = 0.01;
/// Rows of a study, and cells of a ranking.
const MOST_ROWS: usize = 20_000;
/// Values of one option.
const MOST_VALUES: usize = 1000;
/// Postures among which measurements are planned.
const MOST_CANDIDATES: usize = 20_000;
/// Along a path, m.
const LEAST_ALONG_PATH: f64 = 1e-5;

/// Samples of a path, whose length is known once it is read.
pub(super) const MOST_SAMPLES: usize = 1_000_000;

/// Refuses what would need memory without end.
pub(super) fn check(asked: &Request) -> Result<(), Refused> {
    let too_much = |what: String| {
        let hint = "ask for less, or ask the command line, which has the whole machine";
        Err(Refused::new(StatusCode::BAD_REQUEST, format!("too much is asked of the server: {what}"), hint))
    };
    if let Some((name, count)) = asked.counts().find(|(_, count)| MOST_VALUES < *count) {
        return too_much(format!("{count} values of {name}; expected at most {MOST_VALUES}"));
    }
    match asked.verb {
        Verb::Map => match asked.map_options().extent {
            Extent::Reached(Spacing::Points(points)) if MOST_POINTS < points => {
                too_much(format!("size {points}; expected at most {MOST_POINTS}"))
            }
            Extent::Reached(Spacing::Step(step)) if step < LEAST_STEP => {
                too_much(format!("step-m {step}; expected at least {LEAST_STEP}"))
            }
            _ => Ok(()),
        },
        Verb::Study => match asked.study(None) {
            Ok(study) if MOST_ROWS < study.tasks.len() * study.sizes.len() * (study.ratios.len() + 1) => {
                too_much(format!("more than {MOST_ROWS} tasks, sizes and ratios together"))
            }
            _ => Ok(()),
        },
        Verb::Measure => match asked.measurement_plan().candidates {
            candidates if MOST_CANDIDATES < candidates => {
                too_much(format!("{candidates} candidates; expected at most {MOST_CANDIDATES}"))
            }
            _ => Ok(()),
        },
        Verb::Mill => {
            let steps = asked.steps();
            if steps.chord < LEAST_ALONG_PATH || steps.longest < 10.0 * LEAST_ALONG_PATH {
                return too_much("steps along the path below 0.01 mm of chord or 0.1 mm of length".into());
            }
            Ok(())
        }
        _ => Ok(()),
    }
}
