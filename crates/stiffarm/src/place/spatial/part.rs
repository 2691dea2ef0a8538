//! Where must a part stand? All its faces at once, each in a configuration and at a roll of its own; the worst of them counts.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::bound::{BranchAndBound, Proof};
use super::descent::{Score, descend, others};
use super::search::{CELLS, FINALISTS, STARTS, Search, region, step_in};
use super::{Outside, Question, Resolution, Solution};
use crate::batch::{SameBranch, SpatialArm};
use crate::clearance::Clearance;
use crate::follow::NotFollowed;
use crate::interval::Interval;
use crate::inverse::Configuration;
use crate::model::SpatialModel;
use crate::parallel;
use crate::part::{Face, Part};
use crate::place::{
    FacePlacement, Margins, Misfit, Orientation, PlaceError, PlaceOptions, Placed, Placement, ToolOrientation, Within,
};
use crate::tolerances;
use crate::watch::{Parts, Stopped, Watch};
use crate::work::{Grid, WorkPlacement, WorkPlane};

/// Parts that are evaluated before the best value so far is compared again.
const BLOCK: usize = 64;
/// How often a place is searched again within narrower limits.
const NARROWINGS: usize = 5;

/// Where a part stands: ahead and up, m from the base, of the middle of its underside, and its turn about the vertical, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stand {
    x: f64,
    z: f64,
    turn: f64,
}

/// A place with the roll of each face.
#[derive(Clone, Debug)]
struct Candidate {
    stand: Stand,
    rolls: Vec<f64>,
    score: Score,
}

/// The search for one part.
#[derive(Clone)]
struct PartSearch<'a> {
    faces: &'a [Face],
    /// One a face.
    searches: Vec<Search<'a>>,
    orientation: Orientation,
    region: [Interval; 2],
    step: f64,
}

/// The best place of a part with what could be proved of it, or why none was found.
pub(in crate::place) fn place(
    model: &SpatialModel,
    part: &Part,
    options: &PlaceOptions,
    watch: Watch,
) -> Result<Placed, PlaceError> {
    if options.cell.is_some_and(|cell| cell.decides_the_search() || cell.mount.raised().is_none()) {
        return Err(PlaceError::PartInCell);
    }
    let nothing_left = || Placed::Infeasible { reason: Misfit::Margins, is_proved: true, largest_scale: None };
    let parts = watch.parts(None);
    let Some(questions) = questions(model, part, options, &parts)? else { return Ok(nothing_left()) };
    let Margins { limit, singular, .. } = options.margins;
    let Some(arm) = model.arm.with_margins(limit, singular) else { return Ok(nothing_left()) };
    let search = PartSearch::new(model, &arm, part, &questions);
    match search.find()? {
        Some((stand, found)) => {
            let worst = found.iter().map(|face| face.deflection).fold(0.0, f64::max);
            let bounds = prove(&arm, part, &questions, worst / questions[0].force)?;
            Ok(Placed::Feasible(search.placement(stand, found, &bounds)))
        }
        None => infeasible(model, &arm, (part, options), &questions),
    }
}

/// What is asked of each face; `None` where the floor leaves nothing of the window.
fn questions<'a>(
    model: &SpatialModel,
    part: &Part,
    options: &PlaceOptions,
    parts: &'a Parts<'a>,
) -> Result<Option<Vec<Question<'a>>>, PlaceError> {
    if options.tool_orientation.is_some_and(|tool_orientation| !tool_orientation.yaw.contains(0.0, 0.0)) {
        return Err(PlaceError::Inapplicable { what: "a yaw of the plane", model: "one flat zone" });
    }
    let of = |face: &Face| {
        let asked = options.tool_orientation();
        let tool_orientation =
            ToolOrientation { elevation: face.elevation, yaw: Interval::point(0.0), roll: asked.roll };
        Question::of(model, &PlaceOptions { tool_orientation: Some(tool_orientation), ..*options }, parts)
    };
    part.faces.iter().map(of).collect()
}

/// A lower bound on the largest compliance of each face, m/N, wherever the part stands, and the boxes behind it: the face is let go from the
/// others. `upper` is what is known of the part: no bound need be larger.
fn prove(arm: &SpatialArm, part: &Part, questions: &[Question], upper: f64) -> Result<Vec<(f64, usize)>, Stopped> {
    // A face that is let go turns about the joint-1 axis, and a force fixed to the base does not turn with it.
    if questions[0].load.breaks_symmetry() {
        return Ok(vec![(0.0, 0); part.faces.len()]);
    }
    let one = |i: usize| {
        let (face, question) = (&part.faces[i], &questions[i]);
        let proof = proof(arm, face, &alone(&part.faces, face, question), upper)?;
        Ok((proof.lower, proof.boxes))
    };
    parallel::try_each_of(part.faces.len(), one)
}

/// What is proved of a face that is let go from the others, where that is asked of it.
fn proof(arm: &SpatialArm, face: &Face, alone: &Question, upper: f64) -> Result<Proof, Stopped> {
    let roll_is_free = alone.roll.is_none() && arm.tool_turns_about_axis_6();
    let [x, z] = region(arm, alone.within);
    let ahead = x.intersect(Interval::POSITIVE).unwrap_or(x);
    BranchAndBound::new(arm, face.zone, alone, [ahead, z], [true, roll_is_free]).prove(upper)
}

/// What is asked of a face that is let go from others, which may reach below and above it: its centre turns about the joint-1 axis into the arm
/// plane, and with it whatever the part's turn leaves open.
fn alone<'a>(others: &[Face], face: &Face, question: &Question<'a>) -> Question<'a> {
    let is_vertical = FRAC_PI_2 - face.elevation.abs() < 1e-9;
    let is_central = face.centre[0] == 0.0 && face.centre[1] == 0.0;
    let is_alike = face.zone.is_round() && !question.load.turns_with_work();
    let orientation = match question.orientation {
        _ if !is_vertical || is_alike => Orientation::Fixed(0.0),
        // Of a tool that points up the angle counts the other way about.
        Orientation::Fixed(angle) if is_central => {
            Orientation::Fixed((angle + face.azimuth) * -face.elevation.signum())
        }
        Orientation::Axes if is_central && face.azimuth.rem_euclid(FRAC_PI_2).abs() < 1e-12 => Orientation::Axes,
        _ => Orientation::Free,
    };
    let (own, all) = (heights(std::slice::from_ref(face)), heights(others));
    let Within { x, z } = question.within;
    let z = Interval::new(z.min() + (own[0] - all[0]), z.max() - (all[1] - own[1])).unwrap_or(Interval::point(1e9));
    // Turned into the arm plane a point keeps its distance from the axis alone.
    let column = question.column.max(if x.min().is_finite() { x.min() } else { 0.0 });
    let yaw = Interval::spanning(-PI, PI);
    // Of a vertical tool the roll counts from the part's axes, which turn.
    let roll = question.roll.filter(|_| !is_vertical);
    Question { orientation, yaw, roll, within: Within { x: Interval::ALL, z }, column, ..*question }
}

/// From where to where some faces reach up, m above the underside: the same at every turn.
fn heights(faces: &[Face]) -> [f64; 2] {
    let of = |face: &Face| {
        let [.., half] = extents(face, 0.0);
        [face.centre[2] - half, face.centre[2] + half]
    };
    faces.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| [low.min(a), high.max(b)])
}

/// How far a face reaches to either side of its centre: ahead, across and up, m, where its part is turned so.
fn extents(face: &Face, turn: f64) -> [f64; 3] {
    WorkPlane::of(face.elevation, &placed(face, &Stand { x: 0.0, z: 0.0, turn }, 0.0)).half_extents(face.zone)
}

/// Where a face lies when its part stands somewhere.
fn placed(face: &Face, stand: &Stand, roll: f64) -> WorkPlacement {
    let [x, y, z] = face.centre;
    let (s, c) = stand.turn.sin_cos();
    WorkPlacement {
        x: stand.x + c * x - s * y,
        y: s * x + c * y,
        z: stand.z + z,
        yaw: stand.turn + face.azimuth,
        angle: 0.0,
        roll,
    }
}

/// Where a part may stand, ahead and up, that a face of it lies with all its corners where the tool may be; `None` where it does so nowhere.
///
/// A grid over more than that would miss places in windows that are hardly wider than the part.
fn stands_of(face: &Face, [ahead, up]: [Interval; 2], orientation: Orientation) -> [Option<Interval>; 2] {
    let room = |range: Interval, half: f64, centre: f64| {
        range.room_for(half, tolerances::ONE_PLACE).map(|room| room.affine(1.0, -centre))
    };
    let [.., half] = extents(face, 0.0);
    let across = if orientation == Orientation::Free {
        // The face may lie on any side of the middle.
        let far = face.centre[0].hypot(face.centre[1]);
        Some(Interval::spanning(ahead.min() - far, ahead.max() + far))
    } else {
        let at = |turn: f64| {
            let centre = placed(face, &Stand { x: 0.0, z: 0.0, turn }, 0.0).x;
            room(ahead, extents(face, turn)[0], centre)
        };
        let whole = |a: Interval, b: Interval| Interval::spanning(a.min().min(b.min()), a.max().max(b.max()));
        turns(orientation).into_iter().filter_map(at).reduce(whole)
    };
    [across, room(up, half, face.centre[2])]
}

/// The turns of a part that are tried, rad.
fn turns(orientation: Orientation) -> Vec<f64> {
    let every = |count: usize| (0..count).map(|i| TAU * i as f64 / count as f64).collect();
    match orientation {
        Orientation::Axes => every(4),
        Orientation::Fixed(angle) => vec![angle],
        Orientation::Free => every(24),
    }
}

/// Why a part has no place: the first face that has none of its own, or none that all share.
fn infeasible(
    model: &SpatialModel,
    arm: &SpatialArm,
    (part, options): (&Part, &PlaceOptions),
    questions: &[Question],
) -> Result<Placed, PlaceError> {
    let infeasible =
        |reason: Misfit, is_proved: bool| Ok(Placed::Infeasible { reason, is_proved, largest_scale: None });
    let bare = PlaceOptions { margins: Margins::NONE, ..*options };
    if options.margins != Margins::NONE
        && let Some(bare) = self::questions(model, part, &bare, questions[0].parts)?
        && PartSearch::new(model, &model.arm, part, &bare).find()?.is_some()
    {
        return infeasible(Misfit::Margins, false);
    }
    let [low, high] = heights(&part.faces);
    if questions[0].within.z.width() + tolerances::PROOF < high - low {
        return infeasible(Misfit::WindowTooNarrow, true);
    }
    // Turned about the joint-1 axis a face is reached as before, whatever pushes.
    let nowhere = |(face, question): (&Face, &Question), others: &[Face]| {
        let question = Question { load: question.load.in_worst_direction(), ..*question };
        proof(arm, face, &alone(others, face, &question), f64::INFINITY).map(|proof| proof.unfathomed.is_empty())
    };
    let each = || part.faces.iter().zip(questions);
    for one in each() {
        if nowhere(one, std::slice::from_ref(one.0))? {
            return infeasible(Misfit::Face(one.0.name.clone()), true);
        }
    }
    let step = PartSearch::new(model, arm, part, questions).step;
    for one in each() {
        if nowhere(one, &part.faces)? {
            return infeasible(Misfit::NowhereWhole { step }, true);
        }
    }
    infeasible(Misfit::NowhereWhole { step }, false)
}

impl<'a> PartSearch<'a> {
    fn new(model: &'a SpatialModel, arm: &'a SpatialArm, part: &'a Part, questions: &'a [Question<'a>]) -> Self {
        let of = |(face, question): (&Face, &'a Question<'a>)| {
            let mut search = Search::new(model.robot(), arm, face.zone, question);
            // The faces share one place: none of them is turned into the range of joint 1 on its own.
            search.freed = arm.without_limit_on(5, search.roll_is_free);
            search
        };
        let searches: Vec<Search> = part.faces.iter().zip(questions).map(of).collect();
        let orientation = questions[0].orientation;
        // Where faces share nothing, one place far away says so.
        let stands = searches.iter().map(|search| region(arm, search.options.within)).zip(&part.faces);
        let stands = stands.map(|(centres, face)| stands_of(face, centres, orientation));
        let shared = stands.reduce(|a, b| [0, 1].map(|i| a[i]?.intersect(b[i]?)));
        let region = shared.unwrap_or([None; 2]).map(|range| range.unwrap_or(Interval::point(1e9)));
        let step = step_in(&region);
        Self { faces: &part.faces, searches, orientation, region, step }
    }

    /// The best place that is seen, face by face.
    fn find(&self) -> Result<Option<(Stand, Vec<Solution>)>, Stopped> {
        let seen = self.coarse()?;
        let mut rough = self.refined(&seen, CELLS[1], self.step / 2.0)?;
        rough.truncate(FINALISTS);
        let refined = self.refined(&rough, CELLS[2], self.step / 8.0)?;
        let coarse = seen.iter().map(|candidate| candidate.score).min_by(Score::total_cmp).unwrap_or(Score::NONE);
        for candidate in &refined {
            if let Some(found) = self.evaluate(candidate, coarse)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    fn rolls(&self, face: usize) -> Vec<f64> {
        let search = &self.searches[face];
        match search.options.roll {
            Some(roll) => vec![roll],
            None if search.roll_is_free => vec![0.0],
            None => (0..12).map(|i| TAU * f64::from(i) / 12.0).collect(),
        }
    }

    /// The best places of a grid over the region and all turns, best first, far enough apart to be different.
    fn coarse(&self) -> Result<Vec<Candidate>, Stopped> {
        let [columns, rows] = self.region.map(|range| (range.width() / self.step).ceil() as usize + 1);
        let at = |range: Interval, i: usize, count: usize| match count {
            1 => range.middle(),
            _ => range.min() + range.width() * i as f64 / (count - 1) as f64,
        };
        let stands = |turn: f64| -> Vec<Stand> {
            (0..rows * columns)
                .map(|i| Stand {
                    x: at(self.region[0], i % columns, columns),
                    z: at(self.region[1], i / columns, rows),
                    turn,
                })
                .collect()
        };
        let of_turn = |turn: &f64| {
            let stands = stands(*turn);
            let centres = (0..self.faces.len()).map(|face| self.centres(face, &stands));
            let faces: Vec<Vec<(f64, f64)>> = centres.collect::<Result<_, _>>()?;
            let whole = move |i: usize| {
                let worst = faces.iter().map(|face| face[i].0).fold(0.0, f64::max);
                let rolls: Vec<f64> = faces.iter().map(|face| face[i].1).collect();
                worst.is_finite().then_some((worst, stands[i], rolls))
            };
            Ok((0..rows * columns).filter_map(whole).collect::<Vec<_>>())
        };
        let of_turns = parallel::try_each(&turns(self.orientation), of_turn)?;
        let mut centres: Vec<_> = of_turns.into_iter().flatten().collect();
        centres.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (grids, mut seen, mut best) = (self.grids(CELLS[0]), Vec::new(), f64::INFINITY);
        for block in centres.chunks(BLOCK) {
            // A face is no stiffer than its centre.
            if best < block[0].0 {
                break;
            }
            self.parts().one_more()?;
            let evaluated = parallel::each(block, |(_, stand, rolls)| self.candidate(*stand, rolls, PI / 12.0, &grids));
            let feasible = evaluated.iter().filter(|candidate| candidate.score.is_feasible());
            best = feasible.map(|candidate| candidate.score.worst).fold(best, f64::min);
            seen.extend(evaluated);
        }
        seen.sort_by(|a, b| a.score.total_cmp(&b.score));
        Ok(self.apart(seen))
    }

    fn parts(&self) -> &Parts<'_> {
        self.searches[0].options.parts
    }

    /// The compliance at the centre of a face at each stand, all of one turn, and the roll at which it is least; infinite where it is not
    /// reached.
    fn centres(&self, face: usize, stands: &[Stand]) -> Result<Vec<(f64, f64)>, Stopped> {
        let search = &self.searches[face];
        let mut best = vec![(f64::INFINITY, 0.0); stands.len()];
        for roll in self.rolls(face) {
            self.parts().go_on()?;
            let works: Vec<WorkPlacement> = stands.iter().map(|stand| placed(&self.faces[face], stand, roll)).collect();
            let plane = WorkPlane::of(search.options.elevation, &works[0]);
            let orientation = search.freed.orientation(plane.tool()).under(plane.forces(search.options.load));
            let column = |part: fn(&WorkPlacement) -> f64| works.iter().map(part).collect::<Vec<f64>>();
            let (x, y, z) = (column(|work| work.x), column(|work| work.y), column(|work| work.z));
            let mut values = vec![0.0; Configuration::COUNT * works.len()];
            let mut rows = values.chunks_exact_mut(works.len());
            let into = std::array::from_fn(|_| rows.next().expect("one row per configuration"));
            search.freed.configurations_at(&orientation, &SameBranch::default(), [&x, &y, &z], into);
            for row in values.chunks_exact(works.len()) {
                for (best, value) in best.iter_mut().zip(row) {
                    if *value < best.0 {
                        *best = (*value, roll);
                    }
                }
            }
        }
        Ok(best)
    }

    fn grids(&self, cells: usize) -> Vec<Grid> {
        self.faces.iter().map(|face| Grid::of(face.zone, cells).outermost_first()).collect()
    }

    /// A place with its score, each face at the best of its roll and those a `turn` from it.
    fn candidate(&self, stand: Stand, rolls: &[f64], turn: f64, grids: &[Grid]) -> Candidate {
        self.candidate_below(stand, rolls, turn, (grids, Score::NONE))
    }

    /// The same where the score is less than a bound; else any score that is not. One face that is not less than it is enough.
    fn candidate_below(&self, stand: Stand, rolls: &[f64], turn: f64, (grids, bound): (&[Grid], Score)) -> Candidate {
        let mut whole = Candidate { stand, rolls: rolls.to_vec(), score: Score::LEAST };
        for (i, search) in self.searches.iter().enumerate() {
            let is_free = search.options.roll.is_none() && !search.roll_is_free;
            let tried = if is_free { vec![rolls[i], rolls[i] + turn, rolls[i] - turn] } else { vec![rolls[i]] };
            let score = |roll: f64| {
                let scores = search.scores_below(&placed(&self.faces[i], &stand, roll), &grids[i], bound);
                (scores.into_iter().min_by(Score::total_cmp).expect("eight configurations"), roll)
            };
            let (score, roll) =
                tried.into_iter().map(score).min_by(|a, b| a.0.total_cmp(&b.0)).expect("at least one roll");
            whole.rolls[i] = roll;
            whole.score.unreached = whole.score.unreached.saturating_add(score.unreached);
            whole.score.worst = whole.score.worst.max(score.worst);
            if whole.score.total_cmp(&bound).is_ge() {
                break;
            }
        }
        whole
    }

    /// The first of a sorted list that are two steps or another turn apart.
    fn apart(&self, sorted: Vec<Candidate>) -> Vec<Candidate> {
        let mut chosen: Vec<Candidate> = Vec::new();
        for candidate in sorted {
            let near = |other: &Candidate| {
                let (a, b) = (candidate.stand, other.stand);
                (a.x - b.x).hypot(a.z - b.z) < 2.0 * self.step && (a.turn - b.turn).abs() < 0.3
            };
            if !chosen.iter().any(near) {
                chosen.push(candidate);
            }
            if chosen.len() == STARTS[0] {
                break;
            }
        }
        chosen
    }

    /// Every start refined, the best first.
    fn refined(&self, starts: &[Candidate], cells: usize, step: f64) -> Result<Vec<Candidate>, Stopped> {
        let grids = self.grids(cells);
        let mut refined = parallel::try_each(starts, |start| self.descend(start, &grids, step))?;
        refined.retain(|candidate| candidate.score.is_feasible());
        refined.sort_by(|a, b| a.score.total_cmp(&b.score));
        Ok(refined)
    }

    /// Steps in every direction of what is free, halved where none is better.
    fn descend(&self, start: &Candidate, grids: &[Grid], first_step: f64) -> Result<Candidate, Stopped> {
        let turns: &[f64] = if self.orientation == Orientation::Free { &[0.0, 1.0, -1.0] } else { &[0.0] };
        let steps = [first_step, 0.3 * first_step / self.step];
        let moved = |best: &Candidate, [step, turn]: [f64; 2]| {
            let ways = turns.iter().flat_map(|t| {
                [0.0, 1.0, -1.0].into_iter().flat_map(move |x| [0.0, 1.0, -1.0].map(move |z| [x, z, *t]))
            });
            let stands = ways.map(|[x, z, t]| Stand {
                x: self.region[0].clamp(best.stand.x + step * x),
                z: self.region[1].clamp(best.stand.z + step * z),
                turn: best.stand.turn + turn * t,
            });
            // Where it stands itself, a face may be rolled.
            let each = [best.stand].into_iter().chain(others(&best.stand, stands));
            each.map(|stand| self.candidate_below(stand, &best.rolls, turn, (grids, best.score))).collect()
        };
        let start = self.candidate(start.stand, &start.rolls, steps[1], grids);
        descend((start, steps, self.parts()), |candidate| candidate.score, moved)
    }

    /// The answer of every face at a refined place; where one oversteps a limit between samples, at the place next to it that was refined
    /// within limits so much narrower. `None` where some face is not followed.
    fn evaluate(&self, candidate: &Candidate, coarse: Score) -> Result<Option<(Stand, Vec<Solution>)>, Stopped> {
        let (mut narrower, mut candidate) = (0.0, candidate.clone());
        for _ in 0..NARROWINGS {
            match self.evaluate_at(&candidate, coarse) {
                Ok(found) => return Ok(Some((candidate.stand, found))),
                Err(NotFollowed::Impossible) => return Ok(None),
                Err(NotFollowed::Oversteps(by)) => narrower = 4.0 * narrower + 1.1 * by + 2.0 * tolerances::FOLLOWED,
            }
            let mut within = self.clone();
            for search in &mut within.searches {
                let Some(freed) = search.freed.narrowed(narrower) else { return Ok(None) };
                search.freed = freed;
            }
            let step = (self.step / 64.0).max(4.0 * narrower * self.searches[0].robot.stretch());
            match within.refined(&[candidate], CELLS[2], step)?.into_iter().next() {
                Some(refined) => candidate = refined,
                None => return Ok(None),
            }
        }
        Ok(None)
    }

    fn evaluate_at(&self, candidate: &Candidate, coarse: Score) -> Result<Vec<Solution>, NotFollowed> {
        let one = |i: usize| {
            let work = placed(&self.faces[i], &candidate.stand, candidate.rolls[i]);
            let found = self.searches[i].evaluate_placement(&work, coarse)?;
            if found.bearing == 0.0 { Ok(found) } else { Err(NotFollowed::Impossible) }
        };
        parallel::try_each_of(self.faces.len(), one)
    }

    /// The placement of the part: that of its worst face, with all of them.
    fn placement(&self, stand: Stand, found: Vec<Solution>, bounds: &[(f64, usize)]) -> Placement {
        let force = self.searches[0].options.force;
        let boxes = bounds.iter().map(|(_, boxes)| boxes).sum();
        let worst = found.iter().max_by(|a, b| a.deflection.total_cmp(&b.deflection)).expect("a face").clone();
        let lower_bound = bounds.iter().map(|(lower, _)| lower * force).fold(0.0, f64::max).min(worst.deflection);
        let outside = Outside {
            below: found.iter().any(|face| face.outside.below),
            behind: found.iter().any(|face| face.outside.behind),
        };
        let clearance = found.iter().filter_map(|face| face.clearance).reduce(Clearance::and);
        let from_axis_1 = found.iter().map(|face| face.from_axis_1).fold(f64::INFINITY, f64::min);
        let face_placement = |((mut found, face), (lower, _)): ((Solution, &Face), &(f64, usize))| {
            let work = placed(face, &stand, found.roll);
            found.resolution.boxes = boxes;
            FacePlacement {
                face: face.clone(),
                centre: [work.x, work.y, work.z],
                deflection: found.deflection,
                lower_bound: (lower * force).min(found.deflection),
                worst_point: found.worst_point,
                hold: found.hold(),
            }
        };
        let whole = Solution {
            lower_bound,
            centre: [stand.x, stand.z],
            angle: stand.turn.rem_euclid(TAU),
            outside,
            from_axis_1,
            clearance,
            resolution: Resolution { boxes, ..worst.resolution },
            ..worst
        };
        Placement { faces: found.into_iter().zip(self.faces).zip(bounds).map(face_placement).collect(), ..whole.into() }
    }
}
