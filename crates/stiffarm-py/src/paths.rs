//! Toolpaths and processes.

use std::cell::RefCell;
use std::io::BufReader;
use std::path::Path;

use pyo3::prelude::*;
use stiffarm::catalogue::{ProcessFile, files, read_process_beside};
use stiffarm::program::Language;
use stiffarm::robot::Robot as Arms;
use stiffarm::toolpath::{Builtin, MOST_SAMPLES, Move, Original, Survey, Understood, read_toolpath};
use stiffarm::watch::{Stopped, Watch};
use stiffarm_ask::answer::{
    ByToolAnswer, ChatterAnswer, CuttingAnswer, MillAnswer, MillAnswerError, PathAnswer, PathRankAnswer,
};
use stiffarm_ask::request::{Request, Verb};

use crate::asked::Asked;
use crate::json::to_python;
use crate::pool::detached;
use crate::refused;
use crate::robot::{Robot, kept, robot as named};
use crate::verbs::{WithColumns, columns};
use crate::waiting::Progress;

/// What a process file says, and what the files say that it names beside itself.
fn process_of(path: &Path, shown: &str) -> PyResult<ProcessFile> {
    let mut beside = |other: &str| files::text(&files::beside(path, other)).map_err(|error| error.to_string());
    read_process_beside(&files::text(path).map_err(refused)?, shown, &mut beside).map_err(refused)
}

/// What is asked of a zone, under the force of its process where one is given.
pub(crate) fn under_process(asked: Request) -> PyResult<Request> {
    let Some(file) = asked.given_process() else { return Ok(asked) };
    let path = Path::new(&file);
    asked.under(&process_of(path, &files::shown(path))?.process).map_err(refused)
}

/// The force of a process.
#[pyfunction]
pub(crate) fn force<'py>(py: Python<'py>, process: &str) -> WithColumns<'py> {
    let path = Path::new(process);
    let file = files::shown(path);
    let process = process_of(path, &file)?;
    let force = process.process.force().map_err(|error| refused(format!("{file}: {error}")))?;
    let answer = CuttingAnswer { file, process, force };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// Whether a cut swings with the arm at one posture: the answer, and a row a speed of the spindle.
#[pyfunction]
pub(crate) fn chatter<'py>(
    py: Python<'py>,
    process: &str,
    robot: &Robot,
    joints_deg: [f64; 6],
    asked: Asked,
) -> WithColumns<'py> {
    let asked = asked.of(Verb::Chatter)?;
    let path = Path::new(process);
    let file = files::shown(path);
    let process = process_of(path, &file)?;
    let robot = asked.equipped(robot.0.clone()).map_err(refused)?;
    let (tool, wanted) = (asked.held_tool().map_err(refused)?, asked.chatter().map_err(refused)?);
    let radians = joints_deg.map(f64::to_radians);
    let work = |_: Watch| stiffarm::chatter::chatter(&robot, &radians, &tool, &process.process, &wanted);
    let chatter = detached(py, &None, work)?.map_err(|error| refused(format!("{file}: {error}")))?;
    let answer = ChatterAnswer { robot, joints_deg, tool, file, process, chatter };
    Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?))
}

/// A toolpath: what is understood of it, the error along it, or the order of several robots on it.
#[pyfunction]
#[pyo3(signature = (path, asked, robot = None, robots = None, progress = None))]
pub(crate) fn mill<'py>(
    py: Python<'py>,
    path: &str,
    asked: Asked,
    robot: Option<&Robot>,
    robots: Option<Vec<PyRef<'py, Robot>>>,
    progress: Progress,
) -> WithColumns<'py> {
    let robots: Option<Vec<Arms>> = robots.map(|robots| robots.iter().map(|robot| robot.0.clone()).collect());
    let names = robots.iter().flatten().map(|robot| ("robots", robot.name.as_str()));
    let given = [("path", path)].into_iter().chain(robot.map(|robot| ("robot", robot.0.name.as_str()))).chain(names);
    let asked = asked.with(Verb::Mill, &given.collect::<Vec<_>>())?;
    let format = asked.path_format(path).map_err(refused)?;
    let options = asked.read_options();
    if asked.is_dry() {
        let mut survey = Survey::new(asked.steps());
        let understood = detached(py, &progress, |watch| {
            read_toolpath(path, format, &options, &mut |one| survey.add(one), &mut |_, _| watch.go_on())
        })?;
        let answer = PathAnswer { path: path.into(), understood: understood.map_err(refused)?, survey };
        return Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?));
    }
    let milling = match (robot, robots) {
        (_, Some(robots)) => Milling::Several(kept(robots, &asked, Vec::new())?),
        (Some(robot), None) => Milling::One(robot.0.clone()),
        (None, None) if asked.ranks_on_path() => {
            return Err(refused("robots is missing; expected those among which is chosen, such as robots=\"all\""));
        }
        (None, None) => Milling::One(named(&asked.robot().map_err(refused)?)?.0),
    };
    let process = Cutting::of(&asked)?;
    let question = Milled { asked: &asked, path, milling };
    match detached(py, &progress, |watch| question.told(process, watch))?.map_err(refused)? {
        Told::One(answer) => Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?)),
        Told::ByTool(answer) => Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?)),
        Told::Several(answer) => Ok((to_python(py, &answer.json())?, columns(py, &answer.rows())?)),
    }
}

/// What a controller reads of a path that one robot mills, by the ending of its files; of `None` the path's own file with its tips led aside.
#[pyfunction]
#[pyo3(signature = (path, asked, robot, ending = None, progress = None))]
pub(crate) fn milled_program(
    py: Python,
    path: &str,
    asked: Asked,
    robot: &Robot,
    ending: Option<&str>,
    progress: Progress,
) -> PyResult<String> {
    let asked = asked.with(Verb::Mill, &[("path", path), ("robot", robot.0.name.as_str())])?;
    let process = Cutting::of(&asked)?;
    let question = Milled { asked: &asked, path, milling: Milling::One(robot.0.clone()) };
    let told = detached(py, &progress, |watch| question.told(process, watch))?.map_err(refused)?;
    let language = |ending: &str| {
        Language::of_program(ending)
            .ok_or_else(|| refused(format!("no controller reads '{ending}'; expected src, mod or ls")))
    };
    match (told, ending) {
        (Told::One(answer), Some(ending)) => answer.program(language(ending)?).map_err(refused),
        (Told::ByTool(answer), Some(ending)) => answer.program(language(ending)?).map_err(refused),
        (Told::One(answer), None) => rewritten(&answer, &asked),
        (Told::ByTool(answer), None) => Err(refused(format!(
            "the file of {} with all its tools is not written back; program() writes one for a controller",
            answer.path
        ))),
        (Told::Several(_), _) => unreachable!("one robot was asked"),
    }
}

/// The path's own file with its tips led aside.
fn rewritten(answer: &MillAnswer, asked: &Request) -> PyResult<String> {
    let name = &answer.path;
    if Builtin::is_meant(name) {
        return Err(refused(format!(
            "{name} is built in: there is no file to write back; program() writes one for a controller"
        )));
    }
    let (options, format) = (asked.read_options(), asked.path_format(name).map_err(refused)?);
    let mut input = BufReader::new(files::open(Path::new(name)).map_err(refused)?);
    let original = Original { input: &mut input, file: &files::shown(Path::new(name)), format, options: &options };
    let mut output = Vec::new();
    answer.rewritten(original, &asked.steps(), &mut output).map_err(refused)?;
    String::from_utf8(output).map_err(|_| refused(format!("{name} is no UTF-8 text")))
}

/// The processes that are asked for, with the names of their files.
enum Cutting {
    /// That of the whole path, where there is one.
    One(Option<(String, ProcessFile)>),
    /// Of each tool by its number.
    ByTool(Vec<(u32, String, ProcessFile)>),
}

impl Cutting {
    fn of(asked: &Request) -> PyResult<Self> {
        let read = |file: String| {
            let named = files::shown(Path::new(&file));
            let process = process_of(Path::new(&file), &named)?;
            Ok((named, process))
        };
        if !asked.mills_by_tool() {
            return Ok(Self::One(asked.given_process().map(read).transpose()?));
        }
        let of_tools = asked.processes().into_iter().filter_map(|(tool, file)| Some((tool?, file)));
        let with_tool = |(tool, file)| read(file).map(|(named, process)| (tool, named, process));
        Ok(Self::ByTool(of_tools.map(with_tool).collect::<PyResult<_>>()?))
    }
}

/// A path, what is asked of it, and who mills.
struct Milled<'a> {
    asked: &'a Request,
    path: &'a str,
    milling: Milling,
}

impl Milled<'_> {
    /// The answer, with what is to be said of the path among the remarks.
    fn told(self, process: Cutting, watch: Watch) -> Result<Told, String> {
        let Self { asked, path, milling } = self;
        let format = asked.path_format(path).map_err(|error| error.to_string())?;
        let options = asked.read_options();
        let gathered = RefCell::new(asked.gathered(MOST_SAMPLES / milling.robots().max(1)));
        let each = &mut |one: &Move| gathered.borrow_mut().add(one);
        let goes_on = &mut |_, _| if gathered.borrow().is_over() { Err(Stopped) } else { watch.go_on() };
        let understood = read_toolpath(path, format, &options, each, goes_on);
        // Of a path that was left because it is too long that is said.
        let moves = asked.all_moves(gathered.into_inner()).map_err(|error| error.to_string())?;
        let remarks = understood.map_err(|error| error.to_string())?.into_iter().flat_map(Understood::remarks);
        let told = milling.told(asked, (path, moves), process, (remarks.collect(), watch));
        told.map_err(|error| error.to_string())
    }
}

/// Who mills.
enum Milling {
    One(Arms),
    Several(Vec<Arms>),
}

/// What comes of it.
enum Told {
    One(MillAnswer),
    ByTool(ByToolAnswer),
    Several(PathRankAnswer),
}

impl Milling {
    fn robots(&self) -> usize {
        match self {
            Self::One(_) => 1,
            Self::Several(robots) => robots.len(),
        }
    }

    /// The answer, with what is to be said of the path among the remarks.
    fn told(
        self,
        asked: &Request,
        (path, moves): (&str, Vec<Move>),
        process: Cutting,
        (remarks, watch): (Vec<String>, Watch),
    ) -> Result<Told, MillAnswerError> {
        let path = path.to_owned();
        Ok(match (self, process) {
            (Self::One(robot), Cutting::ByTool(processes)) => {
                let mut answer = ByToolAnswer::of(asked, &robot, (&path, &moves), &processes, watch)?;
                answer.remarks.extend(remarks);
                Told::ByTool(answer)
            }
            (Self::One(robot), Cutting::One(process)) => {
                let mut answer = MillAnswer::of(asked, &robot, (path, moves), process, watch)?;
                answer.remarks.extend(remarks);
                Told::One(answer)
            }
            (Self::Several(_), Cutting::ByTool(_)) => unreachable!("refused when the question was read"),
            (Self::Several(robots), Cutting::One(process)) => {
                let mut answer = PathRankAnswer::of(asked, robots, (path, &moves), process.as_ref(), watch)?;
                answer.remarks.extend(remarks);
                Told::Several(answer)
            }
        })
    }
}
