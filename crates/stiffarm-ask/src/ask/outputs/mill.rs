//! The error along a toolpath, and what is made of it: every roll beside the path, a view in space, the path's own file with its tips led aside.

use std::io::Write;
use std::ops::Range;
use std::path::Path;

use stiffarm::catalogue::files;
use stiffarm::mill::{RollMap, Stand};
use stiffarm::model::{ArmPosture, Model, ModelError};
use stiffarm::toolpath::{Builtin, Format, Original, Rewritten, Steps};

use crate::answer::{MillAnswer, MillAnswerError, Unit};
use crate::ask::context::Context;
use crate::ask::drawing;
use crate::ask::reports::Inputs;
use crate::error::AskError;
use crate::figures::FigureSize;
use crate::figures::view3d::{Cell, Point, Surface, View, Zone};
use crate::request::Request;

/// Places along the path of which the map of rolls shows every roll.
const MAPPED: usize = 360;
/// Places along the path that a view in space shows, and how high its ribbon stands, m.
const MOST_POINTS: usize = 3000;
const RIBBON: f64 = 0.02;

pub(crate) struct MillOutput<'a> {
    pub(crate) answer: MillAnswer,
    pub(crate) asked: &'a Request,
    pub(crate) context: Context<'a>,
    pub(crate) figure_size: FigureSize,
}

impl MillOutput<'_> {
    /// What it rests on that was read.
    pub(crate) fn inputs(&self) -> Inputs {
        Inputs::of(self.asked, self.context)
    }
}

/// The path's own file with its tips led aside, by what was milled of it.
pub(crate) fn rewritten(
    (asked, context): (&Request, Context),
    ending: &str,
    write: impl FnOnce(Original, &Steps, &mut dyn Write) -> Result<Rewritten, MillAnswerError>,
) -> Result<Vec<u8>, AskError> {
    check_rewriting(asked, ending)?;
    let (name, options) = (asked.path()?, asked.read_options());
    let (format, mut input) = (asked.path_format(&name)?, context.sources.open(&name)?);
    let original = Original { input: &mut input, file: &files::shown(Path::new(&name)), format, options: &options };
    let mut output = Vec::new();
    let found = write(original, &asked.steps(), &mut output)?;
    if 0 < found.of_cycles {
        let text = format!("warning: {} moves of drilling cycles stay uncompensated", found.of_cycles);
        context.listener.warn(&text);
    }
    Ok(output)
}

/// That the path is a file of this ending, which changes as a whole.
pub(crate) fn check_rewriting(asked: &Request, ending: &str) -> Result<(), AskError> {
    let name = asked.path()?;
    let usage = |why: String| Err(AskError::Usage(why));
    if Builtin::is_meant(&name) {
        return usage(format!(
            "{name} is built in: there is no file to write back; -o path.src, path.mod or path.ls writes a robot program"
        ));
    }
    if let Some(tool) = asked.only_tool() {
        return usage(format!(
            "only tool {tool} of {name} is milled: the file with all its tools is written back where each has its process (process T1=FILE,T2=FILE)"
        ));
    }
    let read = asked.path_format(&name)?;
    if Format::of_name(&format!("a.{ending}")) != Some(read) {
        let read = read.name();
        return usage(format!("{name} is {read}: it is not written as .{ending}; choose an ending of its own format"));
    }
    if !asked.is_compensated() {
        return usage(format!("{name} is written back with --compensate: without it the path stays as it is"));
    }
    Ok(())
}

/// Every roll at places along the path.
pub(crate) fn rolls(answer: &MillAnswer) -> Result<RollMap, AskError> {
    let why = || AskError::Figure(format!("nothing to draw: {}", answer.reason().unwrap_or_default()));
    answer.roll_map(MAPPED)?.ok_or_else(why)
}

impl MillOutput<'_> {
    /// The path as a ribbon at its place, the robot at the worst sample, or where it touches deepest.
    pub(crate) fn in_space(&self) -> Result<View, AskError> {
        let answer = &self.answer;
        let nothing = || AskError::Figure(format!("nothing to draw: {}", answer.reason().unwrap_or_default()));
        let (found, placement) = answer.followed().zip(answer.placement).ok_or_else(nothing)?;
        let failure = |error: ModelError| AskError::Place { robot: answer.robot.name.clone(), error: error.into() };
        let model = Model::spatial(&answer.robot, &answer.flange_from_tool).map_err(failure)?;
        let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool: answer.flange_from_tool };
        let stride = answer.stations.len().div_ceil(MOST_POINTS).max(1);
        let cell = |i: usize, above: f64| {
            let (station, pushed) = (&answer.stations[i], &found.samples[i]);
            let mm = station.sample.is_cutting.then(|| Unit::Millimetre.of_si(pushed.error));
            Cell { at: stand.above(station, above), mm }
        };
        let row = |above: f64| (0..answer.stations.len()).step_by(stride).map(|i| cell(i, above)).collect();
        let (error, worst) = found.worst;
        let zone = Zone {
            label: format!("{}: {:.3} mm at worst", answer.along(), Unit::Millimetre.of_si(error)),
            rim: Vec::new(),
            surface: Some(Surface { rows: vec![row(0.0), row(RIBBON)] }),
            worst: Some(cell(worst, 0.0)),
        };
        let stretch = |run: Range<usize>| run.map(|i| stand.above(&answer.stations[i], 0.0)).collect();
        let touches = answer.deepest();
        let pushed = &found.samples[touches.map_or(worst, |contact| contact.station)];
        let arm = drawing::arm(&model, Some(ArmPosture::Joints(pushed.joints)), pushed.shares.as_ref());
        let shown = answer
            .deepest_sentence()
            .map_or_else(|| "at the worst sample".into(), |sentence| format!("where it touches deepest ({sentence})"));
        let clear_of = answer.options.clear_of.as_ref();
        Ok(View {
            title: format!("{} along {}", answer.robot.full_name(), answer.along()),
            notes: vec![answer.force.clone(), format!("the arm {shown}; the path as a ribbon above its tip")],
            arm,
            zone: Some(zone),
            touching: (answer.touching_is_called(), answer.touching().into_iter().map(stretch).collect()),
            colour_label: "error [mm]".into(),
            scale: self.figure_size.ends(),
            floor: true,
            cell: answer.ground.cell,
            part: clear_of.and_then(|clear_of| Some((clear_of.part.clone()?, stand.base_from_part))),
            fixture: clear_of.and_then(|clear_of| Some((clear_of.fixture.clone()?, stand.base_from_part))),
            stock: clear_of.and_then(|clear_of| clear_of.stock.as_ref()).map(|stock| corners_of(stock.block(), &stand)),
            ..View::default()
        })
    }
}

/// Of a block in the part frame, by its low and high corner: base axes.
fn corners_of(ends: [[f64; 3]; 2], stand: &Stand) -> [Point; 8] {
    std::array::from_fn(|k| stand.base_from_part.transform_point(&[0, 1, 2].map(|i| ends[k >> i & 1][i]).into()).into())
}
