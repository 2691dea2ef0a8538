//! A placement field by field.

use super::super::cell as cell_report;
use super::super::payload::{Carried, FlangeLoad};
use super::super::uncertainty::Known;
use super::super::verdict::{Barred, Verdict};
use super::super::words::tool_mm;
use super::super::{Datum, Record, advice, field, force, margins, shape, stiffness, uncertainty, verdict, words};
use super::PlaceAnswer;
use stiffarm::advice::Advice;
use stiffarm::clearance::Clearance;
use stiffarm::interval::Interval;
use stiffarm::limits::Pendant;
use stiffarm::model::ModelKind;
use stiffarm::place::{FacePlacement, PlaceError, PlaceOptions, Placed, Placement, Resolution, SpaceHold, Within};
use stiffarm::robot::Robot;
use stiffarm::task::Task;

impl PlaceAnswer {
    /// Every field.
    pub fn record(&self) -> Record {
        let Self { robot, model, task, options, placed, tolerance_mm, advice } = self;
        let mut record = Record::of(&shape::PLACEMENT);
        put_placement(&mut record, robot, task, (model, options), Ok(placed), (*tolerance_mm, self.known()));
        put_advice(&mut record, advice.as_ref(), (task, options.load));
        record
    }
}

/// One face of a part.
fn face_record(found: &FacePlacement) -> Record {
    let FacePlacement { face, centre, deflection, lower_bound, worst_point, hold } = found;
    let mut record = Record::of(&shape::FACE);
    record
        .put(field::FACE, &face.name)
        .put(field::FACE_CENTRE, *centre)
        .put(field::TOOL_DIRECTION, words::asked_degrees(face.elevation))
        .put(field::YAW, hold.yaw)
        .put(field::ROLL, hold.roll)
        .put(field::DEFLECTION, *deflection)
        .put(field::LOWER_BOUND, *lower_bound)
        .put(field::SHOULDER, hold.configuration.shoulder.name())
        .put(field::ELBOW, hold.configuration.elbow.name())
        .put(field::WRIST, hold.configuration.wrist.name())
        .put(field::WORST_POINT, *worst_point)
        .put(field::WORST_JOINTS, hold.joints)
        .put(field::WORST_SHARES, hold.shares)
        .put(field::LIMIT_MARGIN, hold.limit_margin.0)
        .put(field::LIMIT_MARGIN_JOINT, hold.limit_margin.1)
        .put(field::SINGULAR_MARGIN, hold.singular_margin);
    record
}

/// One zone of one robot: the same fields whatever the model and whatever was found.
pub(in crate::answer) fn put_placement(
    record: &mut Record,
    robot: &Robot,
    task: &Task,
    (model, options): (&ModelKind, &PlaceOptions),
    placed: Result<&Placed, &PlaceError>,
    (tolerance_mm, known): (Option<f64>, Option<Known>),
) {
    let best = placed.ok().and_then(Placed::feasible);
    stiffness::put_robot(record, robot);
    record.put(field::TASK, &task.label).put(field::MODEL, model.name());
    force::put(record, options.load);
    let carried = FlangeLoad::of(options.tool_weight, model, options.load.newtons()).by(robot);
    carried.put(record);
    asked(record, robot, model, options);
    outcome(record, placed);
    record
        .put(field::DEFLECTION, best.map(|best| best.deflection))
        .put(field::LOWER_BOUND, best.map(|best| best.lower_bound))
        .put(field::X, best.map(|best| best.centre[0]))
        .put(field::Z, best.map(|best| best.centre[1]));
    let clearance = best.and_then(|best| clearance(robot, (model, options), task, best));
    held(record, (robot, best, clearance), options);
    uncertainty::put(record, known.map(|known| known.spread));
    let held = tolerance_mm
        .zip(best)
        .map(|(tolerance, best)| verdict_at(best, tolerance, known, (clearance.as_ref(), carried)));
    verdict::put(record, tolerance_mm, held, best.is_none() && placed.is_ok());
}

/// Whether a place keeps a tolerance, mm, and may be taken: how near the arm comes to anything there, and what it carries.
pub(in crate::answer) fn verdict_at(
    best: &Placement,
    tolerance_mm: f64,
    known: Option<Known>,
    (clearance, carried): (Option<&Clearance>, Carried),
) -> Verdict {
    let collides = clearance.is_some_and(Clearance::is_collision);
    Verdict {
        is_of_drives_alone: clearance.is_some_and(Clearance::may_collide),
        barred: collides.then_some(Barred::Collides).or(carried.is_exceeded().then_some(Barred::Overloaded)),
        ..Verdict::of(best.deflection, tolerance_mm).with(known.and_then(|known| known.holds))
    }
}

/// How near the arm comes to anything at a place.
pub(in crate::answer) fn clearance(
    robot: &Robot,
    (model, options): (&ModelKind, &PlaceOptions),
    task: &Task,
    best: &Placement,
) -> Option<Clearance> {
    let model = model.of(robot).expect("the model that has found the place");
    best.clearance(&model, &task.work, &options.margins)
}

/// Adds the advice on a placement.
pub(in crate::answer) fn put_advice(record: &mut Record, found: Option<&Advice>, asked: advice::Asked) {
    record.put(field::ADVICE, found.map(|found| advice::record(found, asked)));
}

/// What was asked of a model, with what it takes where nothing was said.
fn asked(record: &mut Record, robot: &Robot, model: &ModelKind, options: &PlaceOptions) {
    let flange_from_tool = match model {
        ModelKind::Planar => None,
        ModelKind::Spatial(flange_from_tool) => Some(flange_from_tool),
    };
    let in_cell = options.cell.is_some_and(|cell| cell.windows().next().is_some());
    let Within { x, z } = margins::window(options, model, robot);
    let ends = |range: Interval| [range.min(), range.max()].map(|end| end.is_finite().then_some(end));
    record
        .put(field::TOOL, flange_from_tool.map(tool_mm))
        .put(field::TOOL_DIRECTION, flange_from_tool.map(|_| words::asked_degrees(cell_report::elevation(options))))
        .put(field::WITHIN, if in_cell { Datum::Absent } else { Datum::Numbers([ends(x), ends(z)].concat()) })
        .put(field::ROBOT_CELL, options.cell.map(|cell| cell_report::record(&cell, robot)));
    margins::put(record, options, robot);
}

/// Whether there is a place, and why not.
fn outcome(record: &mut Record, placed: Result<&Placed, &PlaceError>) {
    let (feasible, reason, proved, scale) = match placed {
        Ok(Placed::Feasible(_)) => (Some(true), None, None, None),
        Ok(Placed::Infeasible { reason, is_proved, largest_scale }) => {
            (Some(false), Some(reason.to_string()), Some(*is_proved), *largest_scale)
        }
        Err(error) => (None, Some(error.to_string()), None, None),
    };
    record
        .put(field::FEASIBLE, feasible)
        .put(field::REASON, reason)
        .put(field::PROVED, proved)
        .put(field::LARGEST_SCALE, scale);
}

/// How the zone stands and what holds it.
fn held(
    record: &mut Record,
    (robot, best, clearance): (&Robot, Option<&Placement>, Option<Clearance>),
    options: &PlaceOptions,
) {
    let cell = options.cell.as_ref();
    let hold = best.and_then(Placement::space);
    let of = |value: fn(&SpaceHold) -> f64| hold.map(value);
    let margin = best.and_then(Placement::smallest_margin);
    let wide = clearance.and_then(|clearance| clearance.wide);
    record
        .put(field::BEARING, of(|hold| hold.bearing))
        .put(field::YAW, of(|hold| hold.yaw))
        .put(field::ANGLE, best.map(|best| best.angle))
        .put(field::FIRST_SIDE, best.and_then(|best| best.first_side(options.tool_orientation().elevation, cell)))
        .put(field::ROLL, of(|hold| hold.roll))
        .put(field::SHOULDER, hold.map(|hold| hold.configuration.shoulder.name()))
        .put(field::ELBOW, best.map(|best| best.elbow.name()))
        .put(field::WRIST, hold.map(|hold| hold.configuration.wrist.name()))
        .put(field::WORST_POINT, best.map(|best| best.worst_point))
        .put(field::FROM_AXIS_1, best.and_then(|best| best.from_axis_1))
        .put(field::BELOW_BASE, best.and_then(|best| best.outside).map(|outside| outside.below))
        .put(field::BEHIND_AXIS_1, best.and_then(|best| best.outside).map(|outside| outside.behind))
        .put(field::WORST_JOINTS, hold.map(|hold| hold.joints))
        .put(field::PENDANT, hold.and(robot.pendant()).map(Pendant::name))
        .put(field::WORST_SHARES, hold.map(|hold| hold.shares))
        .put(field::LIMIT_MARGIN, of(|hold| hold.limit_margin.0))
        .put(field::LIMIT_MARGIN_JOINT, hold.map(|hold| hold.limit_margin.1))
        .put(field::SINGULAR_MARGIN, of(|hold| hold.singular_margin))
        .put(field::SMALLEST_MARGIN, margin.map(|(least, _)| least))
        .put(field::SMALLEST_MARGIN_OF, margin.map(|(_, of)| margins::of(of)))
        .put(field::CLEARANCE, clearance.map(|clearance| clearance.distance))
        .put(field::CLEARANCE_OF, clearance.map(|clearance| words::clearance_of(&clearance)))
        .put(field::CLEARANCE_ESTIMATED, clearance.map(|clearance| clearance.is_estimated))
        .put(field::CLEARANCE_OUTSIDE, clearance.map(|clearance| clearance.outside))
        .put(field::CLEARANCE_WIDE, wide.map(|wide| wide.distance))
        .put(field::CLEARANCE_WIDE_OF, wide.map(|wide| words::bodies(wide.link, wide.to)))
        .put(field::CELL_CENTRE, best.zip(cell).map(|(best, cell)| best.in_cell(cell)))
        .put(field::RESOLUTION, hold.map(|hold| resolution(&hold.resolution)))
        .put(field::FACES, faces(best));
}

/// Every face of a part; null of one flat zone.
fn faces(best: Option<&Placement>) -> Datum {
    let faces = best.map(|best| &best.faces).filter(|faces| !faces.is_empty());
    faces.map_or(Datum::Absent, |faces| faces.iter().map(face_record).collect())
}

fn resolution(found: &Resolution) -> Record {
    let mut record = Record::of(&shape::RESOLUTION);
    record
        .put(field::COARSE_STEP, found.coarse_step)
        .put(field::COARSE, found.coarse)
        .put(field::FINE_STEP, found.fine_step)
        .put(field::FINE_TURN, found.fine_turn)
        .put(field::SAMPLE_STEP, found.sample_step)
        .put(field::SAMPLES, found.samples)
        .put(field::HALVING, found.halving)
        .put(field::BOXES, found.boxes);
    record
}
