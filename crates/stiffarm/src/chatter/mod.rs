//! Verb: does a cut swing, and how deep may it go? The modes of the arm, and a delay from tooth to tooth.
//!
//! A tooth cuts what the one before it left: `f = a A (x(t) - x(t - T))`. The answer gives the least depth that swings at the speed
//! of the spindle, the one that swings at no speed, and Pan's, which leaves the delay out. Modes of spindle and tool are known where they
//! were measured, those of the work never: nothing that this says is a promise above the highest mode that was looked at (\[theory\],
//! section 13).

mod advice;
mod curve;
mod cut;
mod draws;
mod measured;
mod table;
mod teeth;
mod tip;

use std::f64::consts::TAU;

use nalgebra::Matrix3;

use crate::compliance::compliance;
use crate::cutting::Process;
use crate::modes::{Damping, HeldTool, ModesError, Swing, modes, nominal_modes};
use crate::parallel;
use crate::robot::Robot;
use crate::spatial::Pose;

pub use curve::{Curve, Edge};
pub use cut::{ChatterError, Cut, LONGEST, axes};
pub use draws::{DRAWS, DRAWS_BY_TOOTH, DepthSpread};
pub use measured::{HeldBy, Looked, MeasuredMode, MeasuredTip, Response, Samples};
pub use table::{ResponseFile, read_response};
pub use teeth::Teeth;

use draws::Draws;
use tip::{Tip, arm_counts};

/// Speeds of a chart: from a tenth of the spindle's to twice it, hundredths of it.
const CHART: std::ops::RangeInclusive<usize> = 10..=200;
/// Tooth by tooth every fifth of them.
const EACH_BY_TOOTH: usize = 5;

/// How teeth are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By their mean over a revolution: the zero-order approximation with the full receptance.
    Mean,
    /// Tooth by tooth: semi-discretisation.
    Teeth,
}

/// What is asked of a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked<'a> {
    /// Of the tool in its material, base axes; made perpendicular to the tool axis.
    pub feed: [f64; 3],
    /// As [`modes`] takes it; it then has no interval.
    pub damping: Option<Damping>,
    /// Chosen by the engagement where `None`.
    pub method: Option<Method>,
    /// What was measured of spindle, holder and cutter, or of the tip as the robot holds it; nothing is known of them where `None`.
    pub measured: Option<&'a MeasuredTip>,
}

/// Does it swing?
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// Robot modes calm: the depth of the cut is less than what swings in 95 of 100 draws, and with drives and damping as they are taken.
    Calm,
    /// Robot modes limit the depth, m: that of the cut is more than what swings in 95 of 100 draws, and with drives and damping as they are taken.
    Limits(f64),
    /// Stiffness and damping are not known well enough.
    NotDecided,
}

/// One speed of a chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Of the spindle, rad/s.
    pub spindle: f64,
    /// `None` where no edge up to [`LONGEST`] swings.
    pub edge: Option<Edge>,
    /// Over the draws; `None` tooth by tooth.
    pub spread: Option<DepthSpread>,
}

/// What is reported of a cut.
#[derive(Clone, Debug)]
pub struct Chatter {
    /// The tool frame in the base frame.
    pub tool: Pose,
    /// Modes of the robot that were looked at, Hz; empty where it is in what was measured.
    pub robot_modes: Vec<f64>,
    /// What of a measured tip was looked at.
    pub measured: Option<Looked>,
    /// Feed, left and away, as columns, base axes.
    pub axes: Matrix3<f64>,
    /// The cut.
    pub cut: Cut,
    /// How teeth were counted.
    pub method: Method,
    /// At the speed of the cut; `None` where no edge up to [`LONGEST`] swings.
    pub at_speed: Option<Edge>,
    /// Over draws of drives and damping.
    pub spread: DepthSpread,
    /// At no speed less deep a cut swings, by the mean over a revolution; never deeper than what swings at the speed of the cut, tooth by tooth.
    pub any_speed: Option<Edge>,
    /// Over draws.
    pub any_speed_spread: DepthSpread,
    /// Fed the other way, up for down milling, at the speed of the cut; `None` beyond [`LONGEST`].
    pub other_way: Option<Edge>,
    /// Without the delay.
    pub without_delay: Option<Edge>,
    /// Does something say how far the drives may be off? Else the intervals are of the damping alone.
    pub drives_are_drawn: bool,
    /// The drives are nobody's: the paper's 1 urad/(N m).
    pub drives_are_assumed: bool,
    /// Does the damping have an interval?
    pub damping_is_drawn: bool,
    /// By the speed of the spindle.
    pub lobes: Vec<Lobe>,
}

impl Chatter {
    /// Does the cut swing, as far as robot modes and what was measured tell? Nothing is decided by a table that is coarse or ends below the frequency at which
    /// teeth pass, nor by a mean over a revolution that may mislead.
    pub fn verdict(&self) -> Verdict {
        let depth = self.cut.milling.engagement.depth();
        if self.drives_are_assumed || self.is_vague() {
            return Verdict::NotDecided;
        }
        match (self.spread, self.at_speed) {
            (spread, taken) if spread.allows(depth, taken) => Verdict::Calm,
            (DepthSpread { p95: Some(p95), .. }, Some(edge)) if p95.max(edge.depth) < depth => {
                Verdict::Limits(edge.depth)
            }
            _ => Verdict::NotDecided,
        }
    }

    /// What was measured decides nothing of this cut.
    pub fn is_vague(&self) -> bool {
        self.ends_below_teeth()
            || self.may_mislead()
            || self.measured.as_ref().is_some_and(|measured| measured.is_coarse)
    }

    /// A table that was measured ends below the frequency at which teeth pass.
    pub fn ends_below_teeth(&self) -> bool {
        let passing = 1.0 / self.cut.period_at(self.cut.spindle);
        self.measured.as_ref().and_then(|measured| measured.between).is_some_and(|[_, to]| to < passing)
    }

    /// Each tooth cuts for half of the time or less and nobody knows the modes of what was measured: the mean over a revolution may mislead.
    pub fn may_mislead(&self) -> bool {
        self.measured.as_ref().is_some_and(|measured| measured.between.is_some()) && self.cut.is_short()
    }

    /// By how much a swing at the edge turns from one tooth to the next, `w T`, rad: far below 1 the cut is a damper, for good or ill.
    pub fn tooth_phase(&self) -> Option<f64> {
        let edge = self.at_speed?;
        Some(TAU * edge.frequency * self.cut.period_at(self.cut.spindle))
    }
}

/// Does a cut swing with the robot at the joint angles `q` it reports, rad, and how deep may it go?
///
/// # Errors
/// What [`modes`] refuses, and cuts that are not covered.
pub fn chatter(
    robot: &Robot,
    q: &[f64; 6],
    tool: &HeldTool,
    process: &Process,
    asked: &Asked,
) -> Result<Chatter, ChatterError> {
    let cut = Cut::of(process)?;
    let (swing, tool) = swinging(robot, q, tool, asked, modes)?;
    let tip = Tip::of(swing.as_ref(), &tool, asked.feed, asked.measured)?;
    if tip.is_sampled() && asked.method == Some(Method::Teeth) {
        return Err(ChatterError::NoModes);
    }
    let teeth = Teeth::of(&tip.motion, &cut);
    let steps = if tip.is_sampled() { None } else { steps(&teeth, &cut, asked.method) };
    let count = if steps.is_some() { DRAWS_BY_TOOTH } else { DRAWS };
    let has_damping = |swing: &Swing| asked.damping.is_some() || matches!(swing.damping, Damping::OfDrives(_));
    let damping_is_given = swing.as_ref().is_none_or(has_damping);
    let draws = match &swing {
        Some(swing) => Draws::of(robot, swing, &tip, damping_is_given, count),
        None => Draws::one(&tip),
    };
    let (curve, drawn) = (tip.curve(&tip.motion, &cut), draws.curves(&cut));
    let any_speed = curve.any_speed();
    let at = |curve: &Curve| curve.edge_at(cut.period_at(cut.spindle));
    let from = any_speed.map_or(LONGEST, |edge| edge.depth) / 2.0;
    let (at_speed, spread) = match steps {
        Some(steps) => (teeth.edge_at(cut.spindle, steps, from), draws.by_tooth(&cut, &drawn, steps)),
        None => (at(&curve), DepthSpread::of(drawn.iter().map(at))),
    };
    let other_way = advice::other_way(&tip, &cut, steps, from);
    let shallower = |edge: Option<Edge>, other: Option<Edge>| {
        edge.into_iter().chain(other).min_by(|a, b| a.depth.total_cmp(&b.depth))
    };
    let any_speed_spread = DepthSpread::of(drawn.iter().map(Curve::any_speed)).at_most(&spread);
    Ok(Chatter {
        at_speed,
        spread,
        any_speed: shallower(any_speed, at_speed),
        any_speed_spread,
        other_way,
        without_delay: curve.without_delay(),
        drives_are_drawn: swing.is_some() && crate::prior::factors(robot, 1).is_some(),
        drives_are_assumed: swing.is_some() && robot.stiffness_is_assumed,
        damping_is_drawn: !damping_is_given,
        method: if steps.is_some() { Method::Teeth } else { Method::Mean },
        lobes: match steps {
            Some(_) => lobes_by_tooth(&teeth, &cut, from),
            None => lobes(&curve, &drawn, &cut),
        },
        tool,
        robot_modes: swing.iter().flat_map(|swing| &swing.modes).map(|mode| mode.frequency).collect(),
        measured: asked.measured.map(MeasuredTip::looked),
        axes: tip.axes,
        cut,
    })
}

/// Finds the modes of an arm.
type Modes = fn(&Robot, &[f64; 6], &HeldTool, Option<Damping>) -> Result<Swing, ModesError>;

/// The arm, where the model of it counts, and the tool frame in the base frame.
fn swinging(
    robot: &Robot,
    q: &[f64; 6],
    tool: &HeldTool,
    asked: &Asked,
    modes: Modes,
) -> Result<(Option<Swing>, Pose), ChatterError> {
    if arm_counts(asked.measured) {
        let swing = modes(robot, q, tool, asked.damping)?;
        let tool = swing.tool;
        return Ok((Some(swing), tool));
    }
    let posture = compliance(robot, q, &tool.flange_from_tool).map_err(ModesError::from)?;
    Ok((None, posture.tool))
}

/// The least depth that swings at one posture, by the mean of the teeth over a revolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByMean {
    /// At the speed of the cut; `None` where no edge up to [`LONGEST`] swings.
    pub edge: Option<Edge>,
    /// Teeth cut so shortly, and pass so slowly, that this mean misleads: [`chatter`] counts them one by one.
    pub misleads: bool,
}

/// What [`chatter`] tells by [`Method::Mean`] of a depth at the speed of the cut, without what it may be off: of many postures.
///
/// # Errors
/// As [`chatter`].
pub fn by_mean(robot: &Robot, q: &[f64; 6], tool: &HeldTool, cut: &Cut, asked: &Asked) -> Result<ByMean, ChatterError> {
    let (swing, tool) = swinging(robot, q, tool, asked, nominal_modes)?;
    let tip = Tip::of(swing.as_ref(), &tool, asked.feed, asked.measured)?;
    let edge = tip.curve(&tip.motion, cut).edge_at(cut.period_at(cut.spindle));
    let misleads = if tip.is_sampled() { cut.is_short() } else { Teeth::of(&tip.motion, cut).are_needed() };
    Ok(ByMean { edge, misleads })
}

/// Steps of a cut tooth by tooth; `None` by the mean.
fn steps(teeth: &Teeth, cut: &Cut, method: Option<Method>) -> Option<usize> {
    let one_by_one = method.map_or_else(|| teeth.are_needed(), |method| method == Method::Teeth);
    one_by_one.then(|| teeth.steps(cut.spindle))
}

fn lobes(curve: &Curve, drawn: &[Curve], cut: &Cut) -> Vec<Lobe> {
    let speeds: Vec<f64> = CHART.map(|share| cut.spindle * share as f64 / 100.0).collect();
    let lobe = |spindle: &f64| {
        let at = |curve: &Curve| curve.edge_at(cut.period_at(*spindle));
        Lobe { spindle: *spindle, edge: at(curve), spread: Some(DepthSpread::of(drawn.iter().map(at))) }
    };
    parallel::each(&speeds, lobe)
}

fn lobes_by_tooth(teeth: &Teeth, cut: &Cut, from: f64) -> Vec<Lobe> {
    let speeds: Vec<f64> = CHART.step_by(EACH_BY_TOOTH).map(|share| cut.spindle * share as f64 / 100.0).collect();
    let lobe = |spindle: &f64| Lobe {
        spindle: *spindle,
        edge: teeth.edge_at(*spindle, teeth.steps(*spindle), from),
        spread: None,
    };
    parallel::each(&speeds, lobe)
}
