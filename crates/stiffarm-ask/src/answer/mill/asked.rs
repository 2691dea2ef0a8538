//! What a request asks of a path: from its options to stations, a place, and what happens there.

use std::borrow::Cow;
use std::sync::Arc;

use super::super::path::tools;
use super::super::{TipFile, fixed, words};
use super::arm;
use super::bodies::Bodies;
use super::chatter::AskedChatter;
use super::{Compensation, MillAnswer, MillAnswerError};
use crate::request::{Refusal, Request, opt};
use stiffarm::catalogue::ProcessFile;
use stiffarm::clearance::Cutter;
use stiffarm::cutting::{Law, Process, Shank};
use stiffarm::mass::ToolWeight;
use stiffarm::mill::{
    self, Acting, ErrorPart, ForcedError, Forcing, MillError, Milled, PathPlaced, Pushed, Stand, Station, TrueOptions,
    compensate, drawn_errors, forced, place_path, remaining,
};
use stiffarm::plain::on_one_line;
use stiffarm::prior::Drawn;
use stiffarm::robot::Robot;
use stiffarm::spatial::Pose;
use stiffarm::stock::{Remains, Stock};
use stiffarm::toolpath::{Move, MoveKind, Survey};
use stiffarm::uncertainty::DRAWS;
use stiffarm::watch::Watch;

/// Cells of a stock in the radius of a mill.
const CELLS_IN_A_RADIUS: f64 = 160.0;
/// Cells of a stock at most: 80 MB.
const MOST_CELLS: f64 = 1e7;

impl MillAnswer {
    /// What a request asks of a robot, a path and its moves, and what was read beside it.
    ///
    /// # Errors
    /// What makes no sense together; what nobody waited for.
    pub fn of<'m>(
        asked: &Request,
        robot: &Robot,
        (path, moves): (String, impl Into<Cow<'m, [Move]>>),
        beside: impl Into<Beside>,
        watch: Watch,
    ) -> Result<Self, MillAnswerError> {
        let all = moves.into();
        let is_cut_before = asked.only_tool().is_some_and(|number| others_cut_before(&all, number));
        let moves = of_one_tool(asked, all)?;
        let tool = surveyed(asked, moves.iter()).tools.first().and_then(|(tool, _)| *tool);
        let mut found = Self::with(asked, robot, (path, moves), Tooled { tool, beside: beside.into() }, watch)?;
        found.remarks.extend((is_cut_before && asked.stock().is_some()).then(|| {
            "MORE MATERIAL: what the other tools of the path cut before is still in the block, so that the force is that of full material; a stock that is as they leave it tells more"
                .to_owned()
        }));
        Ok(found)
    }

    /// The same of moves that are all of one tool.
    pub(super) fn with(
        asked: &Request,
        robot: &Robot,
        (path, moves): (String, Cow<[Move]>),
        Tooled { tool, beside: Beside { process, bodies, measured } }: Tooled,
        watch: Watch,
    ) -> Result<Self, MillAnswerError> {
        let robot = asked.equipped(robot.clone())?;
        arm::check_mount(asked, &robot)?;
        let (mut options, flange_from_tool) = (asked.mill_options()?, asked.tip_of(tool)?);
        let of_tip = measured.as_ref().map_or_else(Vec::new, |measured| measured.remarks.clone());
        let chatter = AskedChatter::of(asked, &robot, (tool, process.as_ref()), measured)?;
        let shank = process.as_ref().and_then(|(_, process)| process.shank);
        let (forcing, force, mut remarks) = forcing(asked, process, &moves)?;
        let of_force = |error| MillAnswerError::Force { path: on_one_line(&path).into_owned(), error };
        let (mut stock, known_to) = block_of(asked, &forcing, &path)?;
        remarks.extend(known_to);
        let survey = surveyed(asked, moves.iter());
        remarks.extend(tiny(&survey));
        let forced = forced(&moves, &asked.steps(), &forcing, stock.as_mut(), watch).map_err(of_force)?;
        if let Some(clear_of) = &mut options.clear_of {
            clear_of.cutter = asked.stick_out(tool).map(|length| Cutter { length, radius: radius_of(&forcing), shank });
            remarks.extend(clear_of.cutter.and_then(|cutter| no_spindle(&cutter, &flange_from_tool)));
            clear_of.stock = stock.as_ref().map(|stock| Arc::new(Remains::of(stock)));
            remarks.extend(bodies.checked(asked, &survey)?);
            clear_of.part = bodies.part.map(|part| part.mesh);
            clear_of.fixture = bodies.fixture.map(|fixture| fixture.mesh);
        }
        drop(stock);
        // Long ones need the memory.
        drop(moves);
        remarks.extend(shank.and_then(|shank| beyond_flutes(&forced.stations, shank)));
        remarks.extend(forced.remarks);
        remarks.extend(words::pendant(&robot));
        remarks.extend(of_tip);
        let failed =
            |error| MillAnswerError::Mill { robot: robot.name.clone(), path: on_one_line(&path).into_owned(), error };
        let mut stations = forced.stations;
        let force =
            if matches!(forcing, Forcing::Same(_)) { force } else { format!("{force}: {}", newtons(&stations)) };
        mill::pin(&mut stations, &asked.pins()).map_err(failed)?;
        let ground = asked.path_ground()?;
        let (placement, search, milled) = if let Some(placement) = asked.at() {
            let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool };
            let milled = mill::mill(&robot, &stand, &stations, &options, watch).map_err(failed)?;
            (Some(placement), None, Some(milled))
        } else {
            let placed = place_path(&robot, &flange_from_tool, &stations, (&options, &ground), watch);
            match placed.map_err(failed)? {
                Ok(PathPlaced { placement, milled, lower_bound, resolution }) => {
                    (Some(placement), Some((resolution, lower_bound)), Some(milled))
                }
                Err(blocked) => (None, None, blocked.map(Milled::Blocked)),
            }
        };
        let tolerance_mm = asked.tolerance_mm();
        let (mut draws, mut compensated, mut fed_back, mut arm, mut swings) = (None, None, None, None, None);
        let work_frame = asked.work_frame();
        if let (Some(Milled::Followed(found)), Some(placement)) = (&milled, placement) {
            let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool };
            let held = arm::held(&robot, options.tool_weight, &ground);
            let drawn = |drawn: Drawn| {
                let what = (options.part, &drawn, held.as_ref());
                drawn_errors(&robot, &stand, (&stations, &found.samples), what, watch).map_err(failed)
            };
            draws = Drawn::of(&robot, DRAWS).map(drawn).transpose()?;
            fed_back =
                mill::fed_back(&robot, &stand, (&stations, &found.samples), options.part, watch).map_err(failed)?;
            if asked.is_compensated() {
                let what = (&stations[..], &found.samples[..], options.part, held.as_ref());
                compensated = Some(compensation(asked, &robot, &stand, what, watch).map_err(failed)?);
            }
            let along = |chatter: AskedChatter| {
                chatter.looked_at(&robot, &stand, (&stations, &found.samples), &options, watch).map_err(failed)
            };
            swings = chatter.map(along).transpose()?;
            let options = TrueOptions { work_frame, part: options.part, is_compensated: asked.is_compensated(), held };
            arm = Some(arm::looked_at(&robot, &stand, (&stations, &found.samples), options, watch).map_err(failed)?);
        }
        Ok(Self {
            robot,
            path,
            force,
            flange_from_tool,
            options,
            survey,
            stations,
            placement,
            only_tool: asked.only_tool(),
            ground,
            search,
            milled,
            draws,
            fed_back,
            compensation: compensated,
            work_frame,
            arm,
            chatter: swings,
            tolerance_mm,
            allows_contact: asked.allows_contact(),
            remarks,
        })
    }
}

/// What was read beside a path.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// The process with the name of its file; `None` where the force is given as such.
    pub process: Option<(String, ProcessFile)>,
    /// Part and fixture, where their meshes are given.
    pub bodies: Bodies,
    /// What was measured at the tip.
    pub measured: Option<TipFile>,
}

impl From<Option<(String, ProcessFile)>> for Beside {
    fn from(process: Option<(String, ProcessFile)>) -> Self {
        Self { process, ..Self::default() }
    }
}

/// Which tool of a path mills, and what was read beside the path.
pub(super) struct Tooled {
    /// Its number; `None` where the path has one tool.
    pub(super) tool: Option<u32>,
    pub(super) beside: Beside,
}

/// Of the cutter, m; 0 where no process tells it.
fn radius_of(forcing: &Forcing) -> f64 {
    if let Forcing::Process(Process { law: Law::Milling(milling), .. }) = forcing {
        milling.diameter / 2.0
    } else {
        0.0
    }
}

/// What is said of a cut that is deeper than the flutes reach.
fn beyond_flutes(stations: &[Station], shank: Shank) -> Option<String> {
    let depth = |station: &Station| station.cut.as_ref().map(|cut| cut.engagement.depth());
    let deeper = stations.iter().filter(|station| depth(station).is_some_and(|depth| shank.flute < depth));
    let deepest = deeper.clone().filter_map(depth).fold(0.0, f64::max);
    let first = deeper.clone().next()?.sample.line;
    let [deepest, flute] = [deepest, shank.flute].map(|metres| fixed(metres * 1e3, 1));
    Some(format!(
        "DEEPER THAN THE FLUTES: {} samples, from line {first} on, cut up to {deepest} mm deep, and the flutes reach {flute} mm: the shank rubs there, under a force that nobody computes",
        deeper.count()
    ))
}

/// What is said of a cutter that is longer than its tool.
fn no_spindle(cutter: &Cutter, flange_from_tool: &Pose) -> Option<String> {
    let (length, reach) = (cutter.length, flange_from_tool.translation.vector.norm());
    let [length_mm, reach_mm] = [length, reach].map(|metres| fixed(metres * 1e3, 1));
    (reach < length).then(|| {
        format!("the cutter stands out of the spindle by {length_mm} mm, the tool reaches {reach_mm} mm from the flange: no spindle is compared with part, stock and fixture")
    })
}

/// All that a path feeds lies within so little that its unit may be another one.
fn tiny(survey: &Survey) -> Option<String> {
    const LEAST: f64 = 2e-3;
    let [low, high] = survey.extent?;
    let widest = (high - low).max();
    (widest < LEAST).then(|| {
        format!("all that the path feeds lies within {} mm: are its numbers in another unit (unit, or the headings of a table)?", fixed(widest * 1e3, 3))
    })
}

/// Of moves, all of them.
fn surveyed<'a>(asked: &Request, moves: impl IntoIterator<Item = &'a Move>) -> Survey {
    let mut survey = Survey::new(asked.steps());
    moves.into_iter().for_each(|one| survey.add(one));
    survey
}

/// Another tool feeds before this one does.
fn others_cut_before(moves: &[Move], number: u32) -> bool {
    let mut feeds = moves.iter().filter(|one| one.kind == MoveKind::Feed).map(|one| one.given.tool);
    feeds.by_ref().any(|tool| tool != Some(number)) && feeds.any(|tool| tool == Some(number))
}

/// The moves of the tool that is meant; of a path with several tools one must be.
fn of_one_tool<'m>(asked: &Request, moves: Cow<'m, [Move]>) -> Result<Cow<'m, [Move]>, Refusal> {
    let survey = surveyed(asked, moves.iter());
    match (asked.only_tool(), survey.tools.as_slice()) {
        (None, [] | [_]) => Ok(moves),
        (None, several) => {
            let why = format!(
                "changes its tool ({}), and one process and one length are not those of all; give each its own by process (T1=FILE,T2=FILE) and tool-lengths-mm, or say by only-tool which one mills",
                tools(several)
            );
            Err(asked.refused(opt::PATH, why))
        }
        (Some(number), found) if found.iter().any(|(tool, _)| *tool == Some(number)) => {
            let mut before = None;
            let is_of_it = |one: &&Move| {
                let tool = one.given.tool;
                let is_changed = before.replace(tool).is_some_and(|before| before != tool);
                // From where a tool comes that was just put in is not in the file.
                tool == Some(number) && !(is_changed && one.kind == MoveKind::Rapid)
            };
            Ok(moves.iter().filter(is_of_it).copied().collect())
        }
        (Some(number), found) => {
            let there = if found.is_empty() { "nothing that feeds".into() } else { tools(found) };
            Err(asked.refused(opt::ONLY_TOOL, format!("{number} never feeds; the path has {there}")))
        }
    }
}

/// Takes the deflection out of a path, and tells what is left.
fn compensation(
    asked: &Request,
    robot: &Robot,
    stand: &Stand,
    (stations, followed, part, held): (&[Station], &[Pushed], ErrorPart, Option<&ToolWeight>),
    watch: Watch,
) -> Result<Compensation, MillError> {
    let path = (stations, followed);
    let done = compensate(robot, stand, path, part, watch)?;
    let drawn = match asked.stiffness_uncertainty() {
        Some(share) => {
            let of_drives = format!("standard deviation of {} % on every drive", fixed(100.0 * share, 0));
            Some((Drawn::within(robot, share, DRAWS), of_drives))
        }
        None => Drawn::of(robot, DRAWS).map(|drawn| (drawn, "drive stiffness".to_owned())),
    };
    let remaining = drawn
        .map(|(drawn, of_drives)| {
            let of_model = if drawn.unexplained.is_some() { " and identification residual" } else { "" };
            let left = remaining(robot, stand, path, (part, &drawn, held), watch)?;
            Ok::<_, MillError>((left, format!("{of_drives}{of_model}")))
        })
        .transpose()?;
    Ok(Compensation { done, remaining })
}

/// The block from which the path is cut, where one is given, and how finely it is known.
fn block_of(
    asked: &Request,
    forcing: &Forcing,
    path: &str,
) -> Result<(Option<Stock>, Option<String>), MillAnswerError> {
    let Some([low, high]) = asked.stock() else { return Ok((None, None)) };
    let Forcing::Process(Process { law: Law::Milling(milling), .. }) = forcing else {
        let path = on_one_line(path).into_owned();
        return Err(MillAnswerError::Force { path, error: ForcedError::NoMill });
    };
    let area = (high[0] - low[0]) * (high[1] - low[1]);
    let cell = (milling.diameter / 2.0 / CELLS_IN_A_RADIUS).max((area / MOST_CELLS).sqrt());
    let known_to = format!("stock in cells of {} mm: the width of a cut is known to that", fixed(cell * 1e3, 3));
    Ok((Some(Stock::block(low, high, cell)?), Some(known_to)))
}

/// How large the force of a process is along a path, in words.
fn newtons(stations: &[Station]) -> String {
    let sizes = stations.iter().filter_map(|station| station.acting.as_ref()).map(Acting::newtons);
    let (low, high) = sizes.fold((f64::INFINITY, 0.0_f64), |(low, high), size| (low.min(size), high.max(size)));
    let [least, most] = [low, high].map(|newtons| fixed(newtons, 1));
    match () {
        () if high < low => "cuts nothing".into(),
        () if least == most => format!("mean force {most} N"),
        () => format!("mean force {least} .. {most} N along the path"),
    }
}

/// Where the force comes from, in words too, and what is to be said of it.
fn forcing(
    asked: &Request,
    process: Option<(String, ProcessFile)>,
    moves: &[Move],
) -> Result<(Forcing, String, Vec<String>), MillAnswerError> {
    if let Some((name, file)) = process {
        return Ok((Forcing::Process(file.process), name, file.assumed));
    }
    let mut feeds = moves.iter().filter(|one| one.kind == MoveKind::Feed).peekable();
    let asked_for = asked.acting()?;
    if feeds.peek().is_some() && feeds.all(|one| one.given.force.is_some()) {
        if asked_for.is_some() {
            let why = "acts nowhere: every feed move of the path has its own force (fx_n, fy_n, fz_n); leave out the one or the other";
            return Err(asked.refused(opt::FORCE_N, why.into()).into());
        }
        // None of it acts anywhere.
        return Ok((Forcing::Same(Acting::Any(0.0)), "as the path gives it (fx_n, fy_n, fz_n)".into(), Vec::new()));
    }
    let acting = asked_for.ok_or_else(|| {
        let why = "missing; expected --force-n with a size or FEED,ACROSS,AXIAL in N, --process with a process file, or columns fx_n, fy_n, fz_n in every row of the path"
            .to_owned();
        asked.refused(opt::FORCE_N, why)
    })?;
    let text = match acting {
        Acting::Any(newtons) => format!("{} N in its worst direction", fixed(newtons, 1)),
        Acting::Known { force: [feed, across, axial], .. } => {
            format!(
                "{} N along the feed, {} N across (left), {} N axial (away from the work)",
                fixed(feed, 1),
                fixed(across, 1),
                fixed(axial, 1)
            )
        }
    };
    Ok((Forcing::Same(acting), text, Vec::new()))
}
