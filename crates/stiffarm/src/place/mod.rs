//! Verb 3: where must the zone stand, how far is the tool pushed off there, and who proves that no place is better?

mod fault;
mod margins;
mod planar;
mod spatial;

use nalgebra::{Matrix2, Matrix3, Vector2};

pub use fault::{Misfit, PlaceError};
pub use margins::{Column, MarginOf, Margins, column_radius};
pub(crate) use planar::best_near;
pub use planar::{best_without_limits, largest_scale_without_limits};
pub use spatial::{Resolution, ZonePoint};

use crate::cell::Cell;
use crate::clearance::Clearance;
use crate::interval::Interval;
use crate::inverse::Configuration;
use crate::load::{Forces, Load};
use crate::mass::ToolWeight;
use crate::model::{ArmPosture, Model, ModelKind};
use crate::part::Face;
use crate::plane::Elbow;
use crate::task::{Work, Zone};
use crate::tolerances;
use crate::watch::Watch;
use crate::work::{WorkPlacement, WorkPlane};

/// Deflections below this, m, are rounding: nothing gives way.
pub(crate) const NOTHING: f64 = 1e-15;

/// Which angles of a rectangle are tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// In the arm plane the first side horizontal or vertical, as in the paper; in space ahead (on a wall: upright) or a quarter turn to
    /// the left, and under a force of which half a turn of the zone makes another one also half a turn and three quarters.
    Axes,
    /// First side at this angle, rad.
    Fixed(f64),
    /// Any angle.
    Free,
}

/// Where the zone may stand, in m from the robot's base: all of it inside both ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Within {
    /// Forwards from the joint-1 axis; negative behind it.
    pub x: Interval,
    /// Upwards.
    pub z: Interval,
}

impl Within {
    /// Anywhere.
    pub const ANYWHERE: Self = Self { x: Interval::ALL, z: Interval::ALL };

    /// In front of the joint-1 axis and above the base.
    pub const AHEAD: Self = Self { x: Interval::POSITIVE, z: Interval::POSITIVE };

    /// The same place seen from a point at `origin`.
    #[must_use]
    pub fn seen_from(self, origin: [f64; 2]) -> Self {
        Self { x: self.x.affine(1.0, -origin[0]), z: self.z.affine(1.0, -origin[1]) }
    }
}

/// How the tool is held against the zone; for the spatial model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolOrientation {
    /// Angle of the tool axis above the horizontal, rad: `-pi/2` down, `0` ahead, `pi/2` up.
    pub elevation: f64,
    /// Angles of the zone's plane about the vertical that are tried, rad: at 0 it faces the robot, beyond a quarter turn
    /// the tool points back at it. A tool that points straight down or up has none.
    pub yaw: Interval,
    /// Rotation about the tool axis, rad, the same for the whole zone: 0 has the tool's x axis ahead (on a wall: upright;
    /// overhead: back); the best where `None`.
    pub roll: Option<f64>,
}

impl ToolOrientation {
    /// The tool points straight down, at the best roll.
    pub fn tool_down() -> Self {
        Self::tool_at(-std::f64::consts::FRAC_PI_2)
    }

    /// The tool points straight down or up: a yaw would turn nothing that the angle of the zone does not.
    pub fn is_vertical(&self) -> bool {
        std::f64::consts::FRAC_PI_2 - self.elevation.abs() < 1e-9
    }

    /// The tool axis at an angle above the horizontal, rad, at the best yaw of the half turn that faces the robot, and the best
    /// roll.
    pub fn tool_at(elevation: f64) -> Self {
        let quarter = std::f64::consts::FRAC_PI_2;
        Self { elevation, yaw: Interval::spanning(-quarter, quarter), roll: None }
    }
}

/// What is asked for besides model and zone. What a model does not know is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceOptions {
    /// The cutting force; in the arm plane in its worst direction at every point.
    pub load: Load,
    /// Which angles are tried.
    pub orientation: Orientation,
    /// Where the zone may stand; where `None`, anywhere in the arm plane, and in space in front of the joint-1 axis and above
    /// the base ([`Within::AHEAD`]).
    pub within: Option<Within>,
    /// Largest relative distance between the value and its lower bound, planar model only; 1e-4 where `None`. In space 1 % is
    /// proved where a bounded number of boxes is enough.
    pub gap: Option<f64>,
    /// How the tool is held, spatial model only; straight down where `None`.
    pub tool_orientation: Option<ToolOrientation>,
    /// What every place keeps from limits, straight postures, the robot's column and the floor.
    pub margins: Margins,
    /// How the robot stands in its cell, and what else stands there; spatial model only. Its windows replace `within`. Alone on the floor
    /// where `None`.
    pub cell: Option<Cell>,
    /// Weight of the tool, where it is known: it is compared with the robot's payload, and changes no place.
    pub tool_weight: Option<ToolWeight>,
}

impl PlaceOptions {
    /// The paper's question under a load: horizontal or vertical, wherever the model usually looks, up to the very limits of the joints,
    /// to its usual certificate.
    pub const fn under(load: Load) -> Self {
        let margins = Margins::NONE;
        let orientation = Orientation::Axes;
        Self {
            load,
            orientation,
            within: None,
            gap: None,
            tool_orientation: None,
            margins,
            cell: None,
            tool_weight: None,
        }
    }

    /// What an engineer would ask of a cell: in front of the robot and above the floor, clear of its column, of joint limits and of straight
    /// postures ([`Margins::usual`]).
    pub fn careful(load: Load) -> Self {
        Self { within: Some(Within::ANYWHERE), margins: Margins::usual(), ..Self::under(load) }
    }

    /// How the tool is held: straight down where nothing is said.
    pub fn tool_orientation(&self) -> ToolOrientation {
        self.tool_orientation.unwrap_or_else(ToolOrientation::tool_down)
    }

    /// Where the zone may stand, and where a model looks when nothing is said.
    pub fn within(&self, model: &ModelKind) -> Within {
        self.within.unwrap_or(match model {
            ModelKind::Planar => Within::ANYWHERE,
            ModelKind::Spatial(_) => Within::AHEAD,
        })
    }

    /// Largest relative distance between the value and its lower bound in the arm plane; 1e-4 where nothing is said.
    pub fn gap(&self) -> f64 {
        self.gap.unwrap_or(1e-4)
    }
}

/// The best place of a zone. Lengths in m from the robot's base: x straight ahead, y to the left, z up.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// The paper's eq. (2) at the best place, eq. (3): the worst deflection inside the zone, m, under the load.
    pub deflection: f64,
    /// No place that was allowed has less; in space up to a relative 1e-9 for rounding.
    pub lower_bound: f64,
    /// Centre of the zone, ahead and up; in space before it is turned by the bearing. Of a part the middle of its underside.
    pub centre: [f64; 2],
    /// Angle of the first side, rad, in `[0, pi)`, or in `[0, 2 pi)` where half a turn of the zone makes another force of that which acts (one
    /// along a known feed and along the axis); zero for a circle. Of a part its turn about the vertical, in `[0, 2 pi)`.
    pub angle: f64,
    /// Elbow side of the whole zone.
    pub elbow: Elbow,
    /// Where in the zone the deflection is largest.
    pub worst_point: [f64; 3],
    /// Distance of the zone's nearest point from the joint-1 axis: the robot's own base and column stand there. `None` where it is not
    /// known where the base stands.
    pub from_axis_1: Option<f64>,
    /// What of the zone is reached but rarely meant; `None` where it is not known where the base stands.
    pub outside: Option<Outside>,
    /// What the search in space knows of [`Placement::clearance`]; `None` in the plane.
    pub clearance_in_space: Option<Clearance>,
    /// How the arm holds it; of a part its worst face.
    pub hold: Hold,
    /// Of a part: every face, in the order in which it has them.
    pub faces: Vec<FacePlacement>,
}

/// A face of a part at its place.
#[derive(Clone, Debug, PartialEq)]
pub struct FacePlacement {
    /// Which.
    pub face: Face,
    /// Its centre.
    pub centre: [f64; 3],
    /// Its worst deflection, m.
    pub deflection: f64,
    /// No place of this face alone has less.
    pub lower_bound: f64,
    /// Where on it the deflection is largest.
    pub worst_point: [f64; 3],
    /// How it is held.
    pub hold: SpaceHold,
}

/// How the arm holds a zone: what only one of the models knows.
#[derive(Clone, Debug, PartialEq)]
pub enum Hold {
    /// In the arm plane.
    Plane {
        /// Shoulder and elbow angle at the worst point, rad.
        posture: [f64; 2],
        /// What the drives 2 and 3 give of the compliance there, m/N, and after it where else in the zone the worst point may lie, if a drive is
        /// softer or stiffer than is given.
        by_drive: Vec<[Matrix2<f64>; 2]>,
        /// The least that is kept from a limit or a straight arm anywhere in the zone, rad; `None` of [`find`].
        margin: Option<(f64, MarginOf)>,
    },
    /// With six drives.
    Space(Box<SpaceHold>),
}

/// How six drives hold a zone.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceHold {
    /// Where about the joint-1 axis the zone stands, rad; zero unless a limit of joint 1 forbids straight ahead.
    pub bearing: f64,
    /// Of the zone's plane about the vertical, rad.
    pub yaw: f64,
    /// About the tool axis, rad.
    pub roll: f64,
    /// The one configuration of the whole zone.
    pub configuration: Configuration,
    /// Joint angles at the worst point as the robot reports them, rad.
    pub joints: [f64; 6],
    /// What each drive gives of the deflection there, adding up to 1.
    pub shares: [f64; 6],
    /// What each drive gives of the compliance of the translation there, m/N, base axes, and after it where else in the zone the worst point may
    /// lie, if a drive is softer or stiffer than is given.
    pub by_drive: Vec<[Matrix3<f64>; 6]>,
    /// The forces that may act there, base axes; any where `None`.
    pub(crate) forces: Option<Forces>,
    /// The smallest distance of any joint to its limits anywhere in the zone, rad, proved, and that joint from 1; 0 is the angle
    /// between the links.
    pub limit_margin: (f64, usize),
    /// The smallest angle between a singular posture (wrist or arm straight) and one in the zone, rad, proved.
    pub singular_margin: f64,
    /// What stands behind these numbers.
    pub resolution: Resolution,
}

impl Placement {
    /// How far the lower bound lies below the value, relative to it; 0 where nothing gives way.
    pub fn gap(&self) -> f64 {
        if self.deflection <= NOTHING { 0.0 } else { 1.0 - self.lower_bound / self.deflection }
    }

    /// The least that is kept from a joint limit or a straight posture anywhere in the zone, of a part on any of its faces, rad; `None` of
    /// [`find`] in the plane.
    pub fn smallest_margin(&self) -> Option<(f64, MarginOf)> {
        let hold = match &self.hold {
            Hold::Plane { margin, .. } => return *margin,
            Hold::Space(hold) => hold.as_ref(),
        };
        let faces = self.faces.iter().map(|face| &face.hold).chain(self.faces.is_empty().then_some(hold));
        faces.map(SpaceHold::smallest_margin).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The nearest that the arm comes to the floor, the work and itself, in the poses of the answer; `None` where it is not known where the base
    /// stands. The model and the work are those of the placement.
    ///
    /// The search in space looks at it anyway; in the arm plane it costs far more than the place itself and is computed here, of whoever asks.
    pub fn clearance(&self, model: &Model, work: &Work, margins: &Margins) -> Option<Clearance> {
        match (model, work) {
            (Model::Planar(model), Work::Zone(zone)) => planar::clearance(model, *zone, self, margins.floor),
            _ => self.clearance_in_space,
        }
    }

    /// The centre of the zone in a cell, m.
    pub fn in_cell(&self, cell: &Cell) -> [f64; 3] {
        let ([x, z], bearing) = (self.centre, self.space().map_or(0.0, |hold| hold.bearing));
        let at = nalgebra::Point3::new(x * bearing.cos(), x * bearing.sin(), z);
        (cell.mount.cell_from_base * at).into()
    }

    /// Which way the first side of the zone or part points where it stands, for a tool axis that rises by `elevation`, rad: axes of the cell, of
    /// the base where there is none; `None` in the plane.
    pub fn first_side(&self, elevation: f64, cell: Option<&Cell>) -> Option<[f64; 3]> {
        let hold = self.space()?;
        let ahead = if self.faces.is_empty() {
            *WorkPlane::of(elevation, &hold.work(self)).first_side()
        } else {
            nalgebra::Vector3::new(self.angle.cos(), self.angle.sin(), 0.0)
        };
        let turned = nalgebra::Rotation3::from_axis_angle(&nalgebra::Vector3::z_axis(), hold.bearing) * ahead;
        // What rounding leaves of a right angle is none.
        let tidy = |part: f64| if part.abs() < 1e-12 { 0.0 } else { part };
        Some(cell.map_or(turned, |cell| cell.mount.cell_from_base.rotation * turned).map(tidy).into())
    }

    /// The arm at the worst point.
    pub fn posture(&self) -> ArmPosture {
        match &self.hold {
            Hold::Plane { posture, .. } => ArmPosture::Plane(*posture),
            Hold::Space(hold) => ArmPosture::Joints(hold.joints),
        }
    }

    /// What only the spatial model knows.
    pub fn space(&self) -> Option<&SpaceHold> {
        match &self.hold {
            Hold::Space(hold) => Some(hold),
            Hold::Plane { .. } => None,
        }
    }
}

impl SpaceHold {
    /// How the zone of a placement that is held so lies, before it is turned by the bearing.
    pub fn work(&self, placement: &Placement) -> WorkPlacement {
        let [x, z] = placement.centre;
        WorkPlacement { x, y: 0.0, z, yaw: self.yaw, angle: placement.angle, roll: self.roll }
    }

    /// As [`Placement::smallest_margin`].
    pub fn smallest_margin(&self) -> (f64, MarginOf) {
        match self.limit_margin {
            (limit, _) if self.singular_margin < limit => (self.singular_margin, MarginOf::Straight),
            (limit, 0) => (limit, MarginOf::BetweenLinks),
            (limit, joint) => (limit, MarginOf::Joint(joint)),
        }
    }
}

/// Where part of a place lies that is reached but rarely meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outside {
    /// Below the base.
    pub below: bool,
    /// Behind the joint-1 axis.
    pub behind: bool,
}

impl Outside {
    /// Of an upright box around a zone, by its centre from the base and half its sides.
    fn of([x, z]: [f64; 2], half: Vector2<f64>) -> Self {
        Self { below: z - half.y < -tolerances::OUTSIDE, behind: x - half.x < -tolerances::OUTSIDE }
    }
}

/// The answer of [`place`].
#[derive(Clone, Debug, PartialEq)]
pub enum Placed {
    /// There is a place; this is the best that was found.
    Feasible(Placement),
    /// None was found.
    Infeasible {
        /// Why.
        reason: Misfit,
        /// There is none.
        is_proved: bool,
        /// The largest scale found, to 1e-4, at which a zone of this shape has a place; zero where none has. `None` where the
        /// model does not look for it.
        largest_scale: Option<f64>,
    },
}

impl Placed {
    /// The placement, where there is one.
    pub fn feasible(&self) -> Option<&Placement> {
        match self {
            Self::Feasible(placement) => Some(placement),
            Self::Infeasible { .. } => None,
        }
    }
}

/// Finds the place of the work that minimises the worst deflection on it, with a certificate (\[paper\], eq. 3).
///
/// **A zone in the plane** lies in the arm plane, is reached with one elbow side throughout, and leaves the joint-2 axis outside.
/// Over a zone only the nearest and the farthest distance from that axis matter, `max(sigma(near), sigma(far))`,
/// because sigma has one valley. Where no limit on absolute angles binds, the optimum is exact (value = lower bound);
/// else a branch and bound over positions (and angle) proves it to `gap`.
///
/// **A zone in space** is a flat patch that the tool axis meets at a right angle. Its centre lies in the plane through the joint-1
/// axis that points straight ahead, before the robot or behind it; by symmetry this is any place about the robot, and joint 1
/// turns there as far as its range is wide enough. One configuration and one roll hold throughout. Every limit is kept everywhere
/// in the zone, and no joint turns by a quarter turn from where it is at the centre: both are proved by enclosures of the joints
/// over parts of it. Places keep 0.001 rad from a straight wrist or arm, and the wrist centre a thousandth of the upper arm from the
/// joint-1 axis. The deflection is the largest of samples. The search is coarse over all places, then refined from the best
/// ones; it is deterministic, and [`Resolution`] says how finely it looked. A branch and bound over all places then proves a lower
/// bound (\[theory\], section 7), within 1 % of the value where a bounded number of boxes is enough for that.
///
/// **A part**, in space alone, stands upright, straight ahead, at any turn that the orientation allows; each face is met by the tool at a right
/// angle, in one configuration and at one roll of its own. The lower bound is that of the face which alone has the worst best place: no place of
/// the part is better, and how near it comes is reported as the gap.
///
/// The parts of the work that are reported to `watch` are what the search looks at; how many there will be is not known.
///
/// ```
/// use stiffarm::catalogue::find;
/// use stiffarm::load::Load;
/// use stiffarm::model::Model;
/// use stiffarm::part::Part;
/// use stiffarm::place::{PlaceOptions, place};
/// use stiffarm::spatial::Pose;
/// use stiffarm::task::Task;
/// use stiffarm::watch::Watch;
///
/// let robot = find("KR 210 R2700 extra").ok_or("in the catalogue")?.robot();
/// let task: Task = "B:0.5".parse()?; // 0.5 x 1 m
/// let options = PlaceOptions::under(Load::PAPER);
/// let placed = place(&Model::planar(&robot)?, &task.work, &options, Watch::nobody())?;
/// let best = placed.feasible().ok_or("it fits")?;
/// assert!((best.deflection - 1.987e-3).abs() < 1e-6 && best.gap() < 1e-4); // m, proved
/// assert!((best.centre[0] - 1.072).abs() < 1e-3 && (best.centre[1] - 0.675).abs() < 1e-3); // m from the base
///
/// let spindle = Pose::new([0.0, 0.0, 0.25].into(), [0.0, std::f64::consts::FRAC_PI_2, 0.0].into());
/// let part = Part::of_box([0.4, 0.3, 0.1]).with_faces(&["top".into(), "front".into()])?;
/// let options = PlaceOptions::careful(Load::worst(400.0)?);
/// let placed = place(&Model::spatial(&robot, &spindle)?, &part.into(), &options, Watch::nobody())?;
/// let best = placed.feasible().ok_or("it fits")?;
/// assert!(best.faces.len() == 2 && best.faces.iter().all(|face| face.deflection <= best.deflection));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Where an argument makes no sense or belongs to another model, or the search does not end; [`PlaceError::Stopped`] where the work is no
/// longer wanted.
pub fn place(model: &Model, work: &Work, options: &PlaceOptions, watch: Watch) -> Result<Placed, PlaceError> {
    match work {
        Work::Zone(zone) => check(*zone, options)?,
        Work::Part(part) => part.faces.iter().try_for_each(|face| check(face.zone, options))?,
    }
    match (work, model) {
        (Work::Zone(zone), Model::Planar(model)) => planar::place(model, *zone, options, watch),
        (Work::Zone(zone), Model::Spatial(model)) => spatial::place(model, *zone, options, watch),
        (Work::Part(_), Model::Planar(_)) => Err(PlaceError::PartInPlane),
        (Work::Part(part), Model::Spatial(_)) if part.faces.is_empty() => Err(PlaceError::NoFace),
        (Work::Part(part), Model::Spatial(model)) => spatial::place_part(model, part, options, watch),
    }
}

/// [`place`] without a word about why a zone has no place, or what is kept from the limits there: in the plane both cost more than the place
/// itself.
///
/// # Errors
/// As [`place`].
pub fn find(model: &Model, zone: Zone, options: &PlaceOptions, watch: Watch) -> Result<Option<Placement>, PlaceError> {
    check(zone, options)?;
    match model {
        Model::Planar(model) => planar::find(model, zone, options, watch),
        Model::Spatial(model) => Ok(spatial::place(model, zone, options, watch)?.feasible().cloned()),
    }
}

/// The worst deflection at points of a zone, m from its centre along its sides, held as the placement says; in the axes of the
/// base, the zone at bearing zero.
///
/// # Errors
/// Where `options` are not those of the placement's model.
pub fn deflection_field(
    model: &Model,
    options: &PlaceOptions,
    placement: &Placement,
    points: impl IntoIterator<Item = [f64; 2]>,
) -> Result<Vec<ZonePoint>, PlaceError> {
    match (model, &placement.hold) {
        (Model::Planar(model), Hold::Plane { .. }) => Ok(planar::deflection_field(model, options, placement, points)),
        (Model::Spatial(model), Hold::Space(hold)) => {
            spatial::deflection_field(model, options, placement, hold, points)
        }
        (Model::Planar(_), _) => Err(PlaceError::Inapplicable { what: "this placement", model: "spatial" }),
        (Model::Spatial(_), _) => Err(PlaceError::Inapplicable { what: "this placement", model: "planar" }),
    }
}

fn check(zone: Zone, options: &PlaceOptions) -> Result<(), PlaceError> {
    if let Orientation::Fixed(angle) = options.orientation
        && !(angle.abs() <= 1e3)
    {
        return Err(PlaceError::Angle(angle));
    }
    options.margins.check()?;
    if options.cell.is_some() && options.load.breaks_symmetry() {
        return Err(PlaceError::ForceInCell);
    }
    check_zone(zone)
}

/// Checks the sides of a zone.
fn check_zone(zone: Zone) -> Result<(), PlaceError> {
    match zone.sides().into_iter().find(|side| !(1e-9 <= *side && *side <= 1e3)) {
        Some(side) => Err(PlaceError::Side(side)),
        None => Ok(()),
    }
}
