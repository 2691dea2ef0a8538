//! What is reported of a path that is milled: the error along it, how the tool is turned, where the part stands.

mod arm;
mod asked;
mod bodies;
mod by_tool;
mod chatter;
mod contact;
mod nowhere;
mod programs;
mod ranking;
mod record;
mod table;
mod worst;

pub use arm::ArmGeometry;
pub use asked::Beside;
pub use bodies::{Bodies, MeshFile};
pub use by_tool::{ByToolAnswer, Section};
pub use chatter::PathChatterAnswer;
use nalgebra::Vector3;
pub(crate) use programs::foreign;
pub use ranking::{PathRankAnswer, PathRow};
use serde_json::Value;

use super::payload::{Carried, FlangeLoad};
use super::uncertainty::Known;
use super::verdict::{Barred, Verdict};
use super::{fixed, with_schema};
use crate::request::Refusal;
use stiffarm::chatter::ChatterError;
use stiffarm::mill::{
    Acting, Blocked, Compensated, FedBack, Followed, ForcedError, MillError, MillOptions, Milled, PartPlacement,
    PathGround, PathResolution, Pushed, Remaining, RollMap, RollMode, Stand, Station, WorkFrame, roll_map,
};
use stiffarm::program::ProgramFault;
use stiffarm::robot::Robot;
use stiffarm::spatial::Pose;
use stiffarm::stock::StockError;
use stiffarm::toolpath::{PathFault, Survey};
use stiffarm::uncertainty::Spread;

/// The answer of `mill`, with what was asked.
#[derive(Clone, Debug)]
pub struct MillAnswer {
    /// Which robot.
    pub robot: Robot,
    /// The path as it was asked for.
    pub path: String,
    /// Where the force comes from, in words.
    pub force: String,
    /// The tool in the flange frame.
    pub flange_from_tool: Pose,
    /// What else was asked.
    pub options: MillOptions,
    /// What the path is, as its file has it.
    pub survey: Survey,
    /// The path, cut and under its forces.
    pub stations: Vec<Station>,
    /// Where the part stands; `None` where no place was found.
    pub placement: Option<PartPlacement>,
    /// The one tool of the path that mills, where that was asked for.
    pub only_tool: Option<u32>,
    /// Where it may stand, with the cell.
    pub ground: PathGround,
    /// How finely that was looked for, and what no other place beats, m; `None` where it was given.
    pub search: Option<(PathResolution, f64)>,
    /// What was found; `None` where there is no place at all.
    pub milled: Option<Milled>,
    /// The largest error of every draw of the drives, m; `None` where nothing says how they may be, or nothing is followed.
    pub draws: Option<Vec<f64>>,
    /// What becomes of it as the cut changes with the displacement; `None` where no cut is known, or nothing is followed.
    pub fed_back: Option<FedBack>,
    /// What compensation makes of it, where it was asked for and the path is followed.
    pub compensation: Option<Compensation>,
    /// How the place of the work was found.
    pub work_frame: WorkFrame,
    /// What the geometry of the arm does; `None` where nothing is followed.
    pub arm: Option<ArmGeometry>,
    /// Whether its cuts swing, where that was asked and the path is followed.
    pub chatter: Option<PathChatterAnswer>,
    /// The largest error that passes, mm.
    pub tolerance_mm: Option<f64>,
    /// Programs are written although the arm touches something.
    pub allows_contact: bool,
    /// What is to be said of path and forces.
    pub remarks: Vec<String>,
}

/// A path whose deflection is taken out.
#[derive(Clone, Debug, PartialEq)]
pub struct Compensation {
    /// What is commanded.
    pub done: Compensated,
    /// What is left where the drives are not as the model has them, and who says how far they may be off; `None` where nobody does.
    pub remaining: Option<(Remaining, String)>,
}

/// A path that has no answer.
#[derive(Debug, thiserror::Error)]
pub enum MillAnswerError {
    /// What is asked makes no sense.
    #[error(transparent)]
    Request(#[from] Refusal),
    /// A stock of which nothing can be computed.
    #[error("stock: {0}")]
    Stock(#[from] StockError),
    /// Of a process no force is known.
    #[error("{path}: {error}")]
    Force {
        /// As it was asked for.
        path: String,
        /// Why.
        error: ForcedError,
    },
    /// Whether its cuts swing cannot be computed.
    #[error("{process}: {error}")]
    Chatter {
        /// Its file, and the tool where there are several.
        process: String,
        /// Why.
        error: ChatterError,
    },
    /// There is no program to write.
    #[error("no program: {0}")]
    NoProgram(String),
    /// A language cannot say it.
    #[error("{0}")]
    Program(#[from] ProgramFault),
    /// A path that is not written back.
    #[error(transparent)]
    Path(#[from] PathFault),
    /// The robot cannot be judged, or was not waited for.
    #[error("{robot} along {path}: {error}")]
    Mill {
        /// Which.
        robot: String,
        /// Along what, as it was asked for.
        path: String,
        /// Why.
        error: MillError,
    },
}

impl MillAnswer {
    /// The path as it is followed, where it is.
    pub fn followed(&self) -> Option<&Followed> {
        match &self.milled {
            Some(Milled::Followed(found)) => Some(found),
            _ => None,
        }
    }

    /// What every other roll would have done at so many places along the path; `None` where it is not followed.
    ///
    /// # Errors
    /// As [`stiffarm::mill::mill`].
    pub fn roll_map(&self, places: usize) -> Result<Option<RollMap>, MillAnswerError> {
        let Some((placement, found)) = self.placement.zip(self.followed()) else { return Ok(None) };
        let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool: self.flange_from_tool };
        let map = roll_map(&self.robot, &stand, &self.stations, &self.options, (found, places));
        map.map(Some).map_err(|error| MillAnswerError::Mill {
            robot: self.robot.name.clone(),
            path: self.path.clone(),
            error,
        })
    }

    /// Where the largest error lies with 90 %, over draws of the drive stiffness, m.
    pub fn spread(&self) -> Option<Spread> {
        self.draws.clone().map(Spread::of)
    }

    /// How large the largest error is with 95 %, m.
    pub(super) fn p95(&self) -> Option<f64> {
        self.spread().map(|spread| spread.p95)
    }

    /// Whether the tolerance is kept along the path; `None` where there is none, or the path is not followed.
    pub fn verdict(&self) -> Option<Verdict> {
        let (tolerance, found) = self.tolerance_mm.zip(self.followed())?;
        let known = self.draws.clone().map(|draws| Known::of(draws, Some(tolerance)));
        self.judged((found.worst.0, self.p95()), known.and_then(|known| known.holds), false)
    }

    /// The same of what compensation leaves, the median of the draws as the nominal value; `None`, too, where nothing says how far the drives may
    /// be off.
    pub(in crate::answer) fn compensated_verdict(&self) -> Option<Verdict> {
        let (tolerance, (left, _)) = self.tolerance_mm.zip(self.compensation.as_ref()?.remaining.as_ref())?;
        self.judged((left.median, Some(left.p95)), Known::of(left.all.clone(), Some(tolerance)).holds, true)
    }

    /// A deflection, nominal and with 95 %, m, held with such a probability, beside what the geometry errs.
    fn judged(&self, deflection: (f64, Option<f64>), holds: Option<f64>, is_compensated: bool) -> Option<Verdict> {
        let tolerance = self.tolerance_mm?;
        let is_of_drives_alone = self.chatter_is_open()
            || self.lacks_weight()
            || self.geometry_exceeds(tolerance, deflection, is_compensated).is_some();
        Some(Verdict { is_of_drives_alone, barred: self.barred(), ..Verdict::of(deflection.0, tolerance).with(holds) })
    }

    /// Why the answer is no, whatever the error.
    pub(in crate::answer) fn barred(&self) -> Option<Barred> {
        let collides = self.forbidding_contact().map(|_| Barred::Collides);
        let chatters = || self.chatter_shortfall().map(|_| Barred::Chatters);
        collides.or_else(chatters).or_else(|| self.carried().is_exceeded().then_some(Barred::Overloaded))
    }

    /// The same of what is milled: who compensates sends a program that leaves the median of the draws. Where nothing is known of the drives nobody
    /// knows what it leaves, and compensation promises nothing.
    pub(super) fn milled_verdict(&self) -> Option<Verdict> {
        self.compensated_verdict().or_else(|| self.verdict())
    }

    /// What is milled: the path, or what one of its tools cuts.
    pub(crate) fn along(&self) -> String {
        along(&self.path, self.only_tool)
    }

    /// The largest force along the path, N.
    fn newtons(&self) -> f64 {
        let force = |station: &Station| match station.acting {
            None => 0.0,
            Some(Acting::Any(newtons)) => newtons,
            Some(Acting::Known { force, .. }) => Vector3::from(force).norm(),
        };
        self.stations.iter().map(force).fold(0.0, f64::max)
    }

    /// What the robot must hold.
    pub(super) fn carried(&self) -> Carried {
        let tip = Some(self.flange_from_tool.translation.vector);
        FlangeLoad { tool: self.options.tool_weight, tip, newtons: self.newtons() }.by(&self.robot)
    }

    /// More than the robot may carry.
    pub(crate) fn overload_sentence(&self) -> Option<String> {
        self.carried().forbidden(&self.robot)
    }

    fn blocked(&self) -> Option<&Blocked> {
        match &self.milled {
            Some(Milled::Blocked(blocked)) => Some(blocked),
            _ => None,
        }
    }

    /// Why there is no answer, where there is none.
    pub fn reason(&self) -> Option<String> {
        match (self.followed(), self.blocked()) {
            (Some(_), _) => None,
            (None, Some(blocked)) if self.search.is_some() || self.placement.is_none() => {
                Some(format!("no place was found at which the path is followed; at the best one tried: {blocked}"))
            }
            (None, Some(blocked)) => Some(blocked.to_string()),
            (None, None) => Some(self.nowhere()),
        }
    }

    /// What no path of rolls beats, and where the best place was asked for, no place; m.
    pub fn lower_bound(&self) -> Option<f64> {
        let found = self.followed()?;
        Some(self.search.map_or(found.lower_bound, |(_, of_all)| of_all.min(found.lower_bound)))
    }

    /// The bound is of all rolls, rather than of those that were asked for.
    pub fn bounds_all_rolls(&self) -> bool {
        matches!(self.options.roll, RollMode::Free | RollMode::Linear) && self.pins().next().is_none()
    }

    /// Of which rolls the bound is, in words, to follow "lower bound".
    pub fn which_rolls(&self) -> &'static str {
        match self.options.roll {
            RollMode::Fixed(_) => "at this roll",
            RollMode::Constant => "of constant rolls",
            RollMode::Free | RollMode::Linear if self.bounds_all_rolls() => "of all rolls",
            RollMode::Free | RollMode::Linear => "of rolls through the pins",
        }
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("mill", super::ORIGIN, &self.record())
    }

    /// Why the answer is no, where it is.
    pub fn shortfall(&self) -> Option<String> {
        if let Some(reason) = self.reason() {
            return Some(format!("{}: {reason}", self.robot.name));
        }
        if let Some(why) = self.forbidding_contact() {
            return Some(format!("{}: {why}", self.robot.name));
        }
        if let Some(why) = self.chatter_shortfall() {
            return Some(format!("{}: {why}", self.robot.name));
        }
        if let Some(exceeded) = self.carried().exceeded() {
            return Some(format!("{}: {exceeded}", self.robot.name));
        }
        let (tolerance, verdict) = self.tolerance_mm.zip(self.milled_verdict())?;
        let what = match &self.compensation {
            Some(Compensation { remaining: Some(_), .. }) => " left after compensation",
            Some(Compensation { remaining: None, .. }) => {
                " without compensation (what it leaves is not known: --stiffness-uncertainty)"
            }
            None => "",
        };
        (!verdict.passes).then(|| {
            let error = fixed(tolerance - verdict.margin_mm, 4);
            format!("{}: {error} mm along {}{what}, tolerance {tolerance} mm", self.robot.name, self.along())
        })
    }
}

/// A path, of which all that is said may be of one tool.
fn along(path: &str, only_tool: Option<u32>) -> String {
    only_tool.map_or_else(|| path.to_owned(), |tool| format!("{path} (tool {tool} alone)"))
}

fn least(found: &Followed, of: impl Fn(&Pushed) -> f64) -> f64 {
    found.samples.iter().map(of).fold(f64::INFINITY, f64::min)
}
