//! The best place of a zone in the arm plane: exact where only the ring of distances limits it, else branch and bound.
//!
//! Everything here counts from the joint-2 axis.

mod boxes;
mod clearance;
mod directed;
mod exact;
mod objective;
mod search;

use nalgebra::Vector2;

pub(super) use clearance::clearance;
pub(crate) use exact::best_near;

use objective::Objective;
use search::Search;

use super::{
    Hold, MarginOf, Margins, Misfit, Orientation, Outside, PlaceError, PlaceOptions, Placed, Placement, Within,
    ZonePoint, check_zone,
};
use crate::interval::Interval;
use crate::load::Sector;
use crate::model::{ModelKind, PlanarModel};
use crate::plane::{Elbow, ElbowSide, PlanarArm, Rooms};
use crate::task::Zone;
use crate::watch::{Parts, Stopped, Watch};

/// What is asked, in the frame of the arm plane.
#[derive(Clone, Copy, Debug)]
struct Question {
    force: f64,
    /// Which way it may push; the worst at every point where `None`.
    sector: Option<Sector>,
    orientation: Orientation,
    within: Within,
    gap: f64,
}

/// The best place, in the frame of the arm plane.
#[derive(Clone, Debug)]
struct Solution {
    deflection: f64,
    lower_bound: f64,
    centre: [f64; 2],
    angle: f64,
    elbow: Elbow,
    worst_point: [f64; 2],
    worst_posture: [f64; 2],
}

/// The best place with its certificate, or why there is none.
pub(super) fn place(
    model: &PlanarModel,
    zone: Zone,
    options: &PlaceOptions,
    watch: Watch,
) -> Result<Placed, PlaceError> {
    let parts = watch.parts(None);
    let allowed = Allowed::of(model, options, &parts)?;
    Ok(match allowed.best(zone)? {
        Some(solution) => {
            let margin = smallest_margin(model, zone, &solution);
            let hold = solution.hold(model, zone, margin);
            Placed::Feasible(Placement { hold, ..solution.into_placement(model, zone) })
        }
        None => allowed.infeasible(zone, options)?,
    })
}

/// The same without a word about why there is none, or about margins.
pub(super) fn find(
    model: &PlanarModel,
    zone: Zone,
    options: &PlaceOptions,
    watch: Watch,
) -> Result<Option<Placement>, PlaceError> {
    let best = Allowed::of(model, options, &watch.parts(None))?.best(zone)?;
    Ok(best.map(|solution| solution.into_placement(model, zone)))
}

/// The deflection at points of a zone that has its place.
pub(super) fn deflection_field(
    model: &PlanarModel,
    options: &PlaceOptions,
    placement: &Placement,
    points: impl IntoIterator<Item = [f64; 2]>,
) -> Vec<ZonePoint> {
    let ([x, z], [ahead, up]) = (placement.centre, model.axis_from_base);
    let sector = options.load.sector().expect("a load under which the zone has its place");
    let objective = Objective::new(&model.arm, sector);
    let at = |point: [f64; 2]| {
        let moved = turned(point.into(), placement.angle);
        let at = [x + moved.x, model.aside(), z + moved.y];
        let from_axis_2 = Vector2::new(at[0] - ahead, at[2] - up);
        ZonePoint { at, deflection: Some(objective.at(placement.elbow, from_axis_2) * options.load.newtons()) }
    };
    points.into_iter().map(at).collect()
}

/// Where a zone may stand and how the arm may hold it: its limits with their margins, and windows that share no place.
struct Allowed<'a> {
    model: &'a PlanarModel,
    sides: Vec<ElbowSide>,
    questions: Vec<Question>,
    parts: &'a Parts<'a>,
}

impl<'a> Allowed<'a> {
    fn of(model: &'a PlanarModel, options: &PlaceOptions, parts: &'a Parts<'a>) -> Result<Self, PlaceError> {
        if options.tool_orientation.is_some() {
            return Err(PlaceError::Inapplicable { what: "a direction of the tool", model: "spatial" });
        }
        let sector = options.load.sector()?;
        if options.cell.is_some() {
            return Err(PlaceError::Inapplicable { what: "a cell", model: "spatial" });
        }
        let gap = options.gap();
        if !(1e-9..=0.5).contains(&gap) {
            return Err(PlaceError::Gap(gap));
        }
        let Margins { limit, singular, .. } = options.margins;
        let is_narrower = limit != 0.0 || singular != 0.0;
        let sides = if is_narrower { model.arm.sides_clear(limit, singular) } else { model.sides.clone() };
        let question = |within: Within| Question {
            force: options.load.newtons(),
            sector,
            orientation: options.orientation,
            within: within.seen_from(model.axis_from_base),
            gap,
        };
        let windows = options.margins.windows(options.within(&ModelKind::Planar), model.robot(), model.aside());
        Ok(Self { model, sides, questions: windows.into_iter().map(question).collect(), parts })
    }

    fn search<'b>(&'b self, question: &'b Question) -> Search<'b> {
        Search::new(&self.model.arm, &self.sides, question, self.parts)
    }

    /// The best place of all windows; its bound holds for all of them.
    fn best(&self, zone: Zone) -> Result<Option<Solution>, PlaceError> {
        let mut best: Option<Solution> = None;
        for question in &self.questions {
            let Some(found) = self.search(question).best(zone)? else { continue };
            best = Some(match best {
                None => found,
                Some(best) => {
                    let lower_bound = best.lower_bound.min(found.lower_bound);
                    let better = if found.deflection < best.deflection { found } else { best };
                    Solution { lower_bound, ..better }
                }
            });
        }
        Ok(best)
    }

    /// A place in any of the windows? An open answer counts as no.
    fn has_place(&self, zone: Zone) -> Result<bool, Stopped> {
        for question in &self.questions {
            if self.search(question).has_place(zone)? == Some(true) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn infeasible(&self, zone: Zone, options: &PlaceOptions) -> Result<Placed, Stopped> {
        let fits = self.sides.iter().map(|side| exact::largest_scale(side.ring, zone)).fold(0.0, f64::max);
        let largest_scale = Some(self.largest_scale(zone, fits.min(1.0))?);
        Ok(Placed::Infeasible { reason: self.reason(zone, options)?, is_proved: true, largest_scale })
    }

    /// The first of what stands in the way: margins, lengths, the window, limits. Undecided so near to the limit of what fits, the limits are
    /// the likeliest reason.
    fn reason(&self, zone: Zone, options: &PlaceOptions) -> Result<Misfit, Stopped> {
        let has_place = |asked: PlaceOptions| {
            Allowed::of(self.model, &asked, self.parts).map_or(Ok(false), |allowed| allowed.has_place(zone))
        };
        let bare = PlaceOptions { margins: Margins::NONE, ..*options };
        if options.margins != Margins::NONE && has_place(bare)? {
            return Ok(Misfit::Margins);
        }
        let rings = || self.model.sides.iter().map(|side| side.ring);
        if rings().all(|ring| exact::largest_scale(ring, zone) < 1.0) {
            let ring = rings().max_by(|a, b| a.width().total_cmp(&b.width())).expect("a side");
            return Ok(Misfit::TooLarge { ring: [ring.min(), ring.max()] });
        }
        let anywhere = PlaceOptions { within: None, ..bare };
        let is_window = options.within(&ModelKind::Planar) != Within::ANYWHERE && has_place(anywhere)?;
        Ok(if is_window { Misfit::Within } else { Misfit::Limits })
    }

    /// The largest scale below `misfit` with a place, to 1e-4: zones of one shape nest about a common centre, so what fits is
    /// monotone in the scale. Zero where nothing of a hundredth of a millimetre fits.
    fn largest_scale(&self, zone: Zone, mut misfit: f64) -> Result<f64, Stopped> {
        let [first, second] = zone.sides();
        let least = 1e-5 / first.max(second);
        let mut fit = 0.0;
        while least < misfit && 1e-4 * misfit < misfit - fit {
            let scale = f64::midpoint(fit, misfit);
            // The scale that is reported has a place for certain.
            if self.has_place(zone.scaled(scale))? {
                fit = scale;
            } else {
                misfit = scale;
            }
        }
        Ok(fit)
    }
}

impl Solution {
    /// Whatever the drives give, a force in any direction moves most at the nearest or the farthest point (the compliance has one valley over the
    /// distance), and one that is known, as a rule, there or at a corner.
    fn hold(&self, model: &PlanarModel, zone: Zone, margin: Option<(f64, MarginOf)>) -> Hold {
        let shape = zone.shape(turned(self.centre.into(), -self.angle));
        let points = [shape.nearest(), shape.farthest()].into_iter().chain(shape.corners().into_iter().flatten());
        let side = model.sides.iter().find(|side| side.elbow == self.elbow).expect("the side that holds the zone");
        let postures = points.map(|point| side.posture_near(turned(point, self.angle)));
        let by_drive = std::iter::once(self.worst_posture.into()).chain(postures);
        let by_drive = by_drive.map(|(shoulder, elbow)| model.arm.by_drive(shoulder, elbow)).collect();
        Hold::Plane { posture: self.worst_posture, by_drive, margin }
    }

    fn into_placement(self, model: &PlanarModel, zone: Zone) -> Placement {
        let [ahead, up] = model.axis_from_base;
        let [x, z] = self.centre;
        let centre = [x + ahead, z + up];
        let half = zone.half_extents(self.angle);
        let [wx, wz] = self.worst_point;
        Placement {
            deflection: self.deflection,
            lower_bound: self.lower_bound,
            centre,
            angle: self.angle,
            elbow: self.elbow,
            worst_point: [wx + ahead, model.aside(), wz + up],
            from_axis_1: model.knows_base().then(|| (centre[0].abs() - half.x).max(0.0).hypot(model.aside())),
            outside: model.knows_base().then(|| Outside::of(centre, half)),
            clearance_in_space: None,
            hold: self.hold(model, zone, None),
            faces: Vec::new(),
        }
    }
}

/// What a place keeps the least, over the whole zone, on the side that holds it.
fn smallest_margin(model: &PlanarModel, zone: Zone, found: &Solution) -> Option<(f64, MarginOf)> {
    let shape = zone.shape(turned(found.centre.into(), -found.angle));
    let mut sides = model.sides.iter().filter(|side| side.elbow == found.elbow);
    let Rooms { shoulder, elbow, forearm, straight } =
        sides.find_map(|side| side.rooms_over(&model.arm, &shape, found.angle))?;
    let rooms = [
        (shoulder, MarginOf::Joint(2)),
        (elbow, MarginOf::BetweenLinks),
        (forearm, MarginOf::Forearm),
        (straight, MarginOf::Straight),
    ];
    rooms.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The value of the best place, m/N, of a zone for an arm whose limits are left aside; `None` where it does not fit.
///
/// Exact: the paper's section III, where any angle of a rectangle is as good as another.
///
/// # Errors
/// Where a length, a compliance or a side of the zone makes no sense.
pub fn best_without_limits(arm: &PlanarArm, zone: Zone) -> Result<Option<f64>, PlaceError> {
    arm.check().map_err(crate::model::ModelError::from)?;
    check_zone(zone)?;
    let sigma = arm.radial();
    let ring = Interval::spanning(sigma.folded, sigma.stretched);
    Ok(exact::symmetric_places(&sigma, ring, zone).first().map(|place| place.compliance))
}

/// The largest scale at which a zone fits an arm whose limits are left aside.
pub fn largest_scale_without_limits(arm: &PlanarArm, zone: Zone) -> f64 {
    let sigma = arm.radial();
    exact::largest_scale(Interval::spanning(sigma.folded, sigma.stretched), zone)
}

/// `v` turned by `angle`.
fn turned(v: Vector2<f64>, angle: f64) -> Vector2<f64> {
    let (s, c) = angle.sin_cos();
    Vector2::new(c * v.x - s * v.y, s * v.x + c * v.y)
}
