//! `stiffarm mill PATH`: the error along a toolpath; with `--dry` what is understood of it.

use std::cell::RefCell;
use std::io::{self, Write};
use std::path::Path;

use stiffarm::catalogue::{ProcessFile, files};
use stiffarm::mill::{RollMap, Stand};
use stiffarm::model::{ArmPosture, Model, ModelError};
use stiffarm::program::Language;
use stiffarm::toolpath::{Builtin, Format, Move, Original, Survey, Understood};
use stiffarm::watch::{Stopped, Watch};
use stiffarm_ask::answer::{MillAnswer, PathAnswer, PathRankAnswer, Rows, Unit};
use stiffarm_ask::request::Request;

use super::by_tool::ByToolOutput;
use super::path_ranking::PathRankOutput;
use super::{by_tool, drawing, process_of, progress, watched};
use crate::common::Common;
use crate::failure::Failure;
use crate::figures::Plate;
use crate::figures::milled::MilledFigure;
use crate::figures::shop::ShopFigure;
use crate::figures::view3d::{Cell, Sheet, View, Zone};
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty, verdict};
use crate::report::{self, Inputs, Report};
use crate::selection;
use crate::table::{prose, shown};

/// Places along the path of which the map of rolls shows every roll.
const MAPPED: usize = 360;
/// Places along the path that a view in space shows, and how high its ribbon stands, m.
const MOST_POINTS: usize = 3000;
const RIBBON: f64 = 0.02;

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    if asked.is_dry() {
        let outputs = Outputs::open::<PathOutput>(common)?;
        return outputs.deliver(&surveyed(asked, common)?);
    }
    if asked.ranks_on_path() {
        return ranked_on_path(asked, common);
    }
    if asked.mills_by_tool() {
        return milled_by_tool(asked, common);
    }
    let outputs = Outputs::open::<MillOutput>(common)?;
    let found = answer(asked, common)?;
    let shortfall = found.answer.shortfall().filter(|_| common.check);
    verdict(outputs.deliver(&found), shortfall.map_or(Ok(()), |why| Err(Failure::NotHeld(why))))
}

/// Several tools on the path, each with its own process.
fn milled_by_tool(asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<ByToolOutput>(common)?;
    let found = by_tool::answer(asked, common)?;
    let shortfall = found.answer.shortfall().filter(|_| common.check);
    verdict(outputs.deliver(&found), shortfall.map_or(Ok(()), |why| Err(Failure::NotHeld(why))))
}

/// What is understood of a path.
pub(super) fn surveyed(asked: &Request, common: &Common) -> Result<PathOutput, Failure> {
    let (path, mut survey) = (asked.path()?, Survey::new(asked.steps()));
    let understood = read_moves(asked, &path, common, &mut |one| survey.add(one), &|| Ok(()))?;
    Ok(PathOutput(PathAnswer { path, understood, survey }))
}

pub(super) fn answer<'a>(asked: &'a Request, common: &'a Common) -> Result<MillOutput<'a>, Failure> {
    let path = asked.path()?;
    let robot = selection::robot(&asked.robot()?, common)?;
    let process = read_process_of(asked, common)?;
    let (moves, understood) = all_moves(asked, &path, common, 1)?;
    let milled = |watch: Watch| MillAnswer::of(asked, &robot, (path, moves), process, watch);
    let mut answer = watched("milling", common, milled)?;
    answer.remarks.extend(understood.into_iter().flat_map(Understood::remarks));
    Ok(MillOutput { answer, asked, common, plate: Plate::of(asked)? })
}

/// Several robots on the path, each at its best place.
fn ranked_on_path(asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<PathRankOutput>(common)?;
    let found = ranked(asked, common)?;
    let shortfall = found.answer.shortfall().filter(|_| common.check);
    verdict(outputs.deliver(&found), shortfall.map_or(Ok(()), |why| Err(Failure::NotHeld(why))))
}

pub(super) fn ranked<'a>(asked: &'a Request, common: &Common) -> Result<PathRankOutput<'a>, Failure> {
    let path = asked.path()?;
    let robots = selection::keep(selection::robots(&asked.robots(), common)?, asked, &[])?;
    let process = read_process_of(asked, common)?;
    let (moves, understood) = all_moves(asked, &path, common, robots.len())?;
    let ranked = |watch: Watch| PathRankAnswer::of(asked, robots, (path, &moves), process.as_ref(), watch);
    let mut answer = watched("milling with every robot", common, ranked)?;
    answer.remarks.extend(understood.into_iter().flat_map(Understood::remarks));
    Ok(PathRankOutput { answer, asked, inputs: Inputs::of(asked, common), plate: Plate::of(asked)? })
}

/// The process that is asked for, with the name of its file.
fn read_process_of(asked: &Request, common: &Common) -> Result<Option<(String, ProcessFile)>, Failure> {
    let Some(file) = asked.given_process() else { return Ok(None) };
    let named = files::shown(Path::new(&file));
    let read = process_of(&file, &named, common)?;
    Ok(Some((named, read)))
}

/// All moves of the path, as long as no more samples come of them, each kept for so many robots, than there may be.
pub(super) fn all_moves(
    asked: &Request,
    path: &str,
    common: &Common,
    robots: usize,
) -> Result<(Vec<Move>, Option<Understood>), Failure> {
    let gathered = RefCell::new(asked.gathered(common.most_samples / robots.max(1)));
    let goes_on = || if gathered.borrow().is_over() { Err(Stopped) } else { Ok(()) };
    let understood = read_moves(asked, path, common, &mut |one| gathered.borrow_mut().add(one), &goes_on);
    // Of a path that was left because it is too long that is said.
    let moves = asked.all_moves(gathered.into_inner())?;
    Ok((moves, understood?))
}

/// Reads the path, move by move, as long as it goes on.
fn read_moves(
    asked: &Request,
    path: &str,
    common: &Common,
    each: &mut dyn FnMut(&Move),
    goes_on: &dyn Fn() -> Result<(), Stopped>,
) -> Result<Option<Understood>, Failure> {
    let format = asked.path_format(path)?;
    let bar = progress(1, "reading", common);
    let mut told = |done: u64, all: u64| {
        bar.set_length(all);
        bar.set_position(done);
        goes_on()?;
        common.watch().go_on()
    };
    let found = common.shelf.moves((path, format), &asked.read_options(), each, &mut told);
    bar.finish_and_clear();
    found
}

pub(super) struct PathOutput(PathAnswer);

impl Answer for PathOutput {
    const COMMAND: &'static str = "mill";

    fn text(&self, look: Look) -> String {
        shown(&self.0.table(), look)
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.0.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }
}

pub(crate) struct MillOutput<'a> {
    pub(crate) answer: MillAnswer,
    asked: &'a Request,
    common: &'a Common,
    pub(crate) plate: Plate,
}

impl MillOutput<'_> {
    /// What it rests on that was read.
    pub(crate) fn inputs(&self) -> Inputs {
        Inputs::of(self.asked, self.common)
    }

    /// The path's own file with its tips led aside.
    fn rewritten(&self, ending: &str) -> Result<Vec<u8>, Failure> {
        let name = &self.answer.path;
        if Builtin::is_meant(name) {
            let why = format!(
                "{name} is built in: there is no file to write back; -o path.src, path.mod or path.ls writes a robot program"
            );
            return Err(Failure::Usage(why));
        }
        if let Some(tool) = self.answer.only_tool {
            let why = format!("only tool {tool} of {name} is milled: the file with all its tools is not written back");
            return Err(Failure::Usage(why));
        }
        let options = self.asked.read_options();
        let written = Format::of_name(&format!("a.{ending}"));
        let read = self.asked.path_format(name)?;
        if written != Some(read) {
            let why = format!(
                "{name} is {}: it is not written as .{ending}; choose an ending of its own format",
                read.name()
            );
            return Err(Failure::Usage(why));
        }
        let (format, mut input) = (self.asked.path_format(name)?, self.common.shelf.open(name)?);
        let original = Original { input: &mut input, file: &files::shown(Path::new(name)), format, options: &options };
        let mut output = Vec::new();
        let found = self.answer.rewritten(original, &self.asked.steps(), &mut output)?;
        if 0 < found.of_cycles {
            self.common.warn(&format!("warning: {} moves of drilling cycles stay uncompensated", found.of_cycles));
        }
        Ok(output)
    }
}

/// Every roll at places along the path.
pub(crate) fn rolls(answer: &MillAnswer) -> Result<RollMap, Failure> {
    let why = || Failure::Usage(format!("nothing to draw: {}", answer.reason().unwrap_or_default()));
    answer.roll_map(MAPPED)?.ok_or_else(why)
}

impl MillOutput<'_> {
    /// The path as a ribbon at its place, the robot at the worst sample.
    fn in_space(&self) -> Result<View, Failure> {
        let answer = &self.answer;
        let nothing = || Failure::Usage(format!("nothing to draw: {}", answer.reason().unwrap_or_default()));
        let (found, placement) = answer.followed().zip(answer.placement).ok_or_else(nothing)?;
        let failure = |error: ModelError| Failure::Place { robot: answer.robot.name.clone(), error: error.into() };
        let model = Model::spatial(&answer.robot, &answer.flange_from_tool).map_err(failure)?;
        let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool: answer.flange_from_tool };
        let stride = answer.stations.len().div_ceil(MOST_POINTS).max(1);
        let cell = |i: usize, above: f64| {
            let (station, pushed) = (&answer.stations[i], &found.samples[i]);
            let mm = station.sample.is_cutting.then(|| Unit::Millimetre.told(pushed.error));
            Cell { at: stand.above(station, above), mm }
        };
        let row = |above: f64| (0..answer.stations.len()).step_by(stride).map(|i| cell(i, above)).collect();
        let (error, worst) = found.worst;
        let zone = Zone {
            label: format!("{}: {:.3} mm at worst", answer.path, Unit::Millimetre.told(error)),
            rim: Vec::new(),
            sheet: Some(Sheet { rows: vec![row(0.0), row(RIBBON)] }),
            worst: Some(cell(worst, 0.0)),
        };
        let pushed = &found.samples[worst];
        let arm = drawing::arm(&model, Some(ArmPosture::Joints(pushed.joints)), pushed.shares.as_ref());
        Ok(View {
            title: format!("{} along {}", answer.robot.full_name(), answer.path),
            notes: vec![answer.force.clone(), "the arm at the worst sample; the path as a ribbon above its tip".into()],
            arm,
            zone: Some(zone),
            colour_label: "error [mm]".into(),
            scale: self.plate.ends(),
            floor: true,
            cell: answer.ground.cell,
            ..View::default()
        })
    }
}

impl Answer for MillOutput<'_> {
    const COMMAND: &'static str = "mill";
    const IS_SITED: bool = true;
    const IS_REPORTED: bool = true;
    const FURTHER: &'static [&'static str] =
        &["svg", "png", "pdf", "html", "src", "mod", "ls", "nc", "gcode", "ngc", "tap", "apt", "cls"];

    fn program(&self, ending: &str) -> Option<Result<Vec<u8>, Failure>> {
        let language = Language::of_program(ending);
        Some(match language {
            Some(language) => self.answer.program(language).map(String::into_bytes).map_err(Into::into),
            None => self.rewritten(ending),
        })
    }

    fn text(&self, look: Look) -> String {
        format!("{}\n{}", shown(&self.answer.table(), look), prose(&self.answer.notes(), look))
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.answer.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        let answer = &self.answer;
        Some(rolls(answer).map(|rolls| MilledFigure { answer, rolls: &rolls, plate: self.plate }.svg()))
    }

    fn view(&self) -> Option<Result<View, Failure>> {
        Some(self.in_space())
    }

    fn shop(&self) -> Option<Result<String, Failure>> {
        let nothing = || {
            Failure::Figure("nothing to draw: the path has no place, or nothing is known of the robot's base".into())
        };
        let drawn = |siting| ShopFigure { siting: &siting, plate: self.plate }.svg();
        Some(self.answer.siting().map(drawn).ok_or_else(nothing))
    }

    fn report(&self) -> Option<Result<Report, Failure>> {
        Some(report::mill::of(self, self.asked))
    }

    fn plate(&self) -> Plate {
        self.plate
    }
}
