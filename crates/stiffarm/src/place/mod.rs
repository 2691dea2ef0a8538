//! Verb 3: where must the zone stand, how far is the tool pushed off there, and who proves that no place is better?

mod boxes;
mod exact;
mod search;
mod spatial;

use nalgebra::Vector2;

pub(crate) use exact::best_near;
pub use spatial::{
    Resolution, SpatialMisfit, SpatialOptions, SpatialPlaceError, SpatialPlacement, SpatiallyPlaced, ZonePoint,
    across_zone, place_in_space,
};

use crate::interval::Interval;
use crate::plane::{Elbow, InvalidArm, PlanarArm};
use crate::robot::{ArmPlane, NoArmPlane, Robot};
use crate::task::Zone;

/// Deflections below this, m, are rounding: nothing gives way.
pub(crate) const NOTHING: f64 = 1e-15;

/// Which angles of a rectangle are tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// First side horizontal or vertical, as in the paper.
    Axes,
    /// First side at this angle, rad.
    Fixed(f64),
    /// Any angle.
    Free,
}

/// Where the zone may stand, in m from the joint-2 axis: all of it inside both ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Within {
    /// Forwards.
    pub x: Interval,
    /// Upwards.
    pub z: Interval,
}

impl Within {
    /// Anywhere.
    pub const ANYWHERE: Self = Self { x: Interval::ALL, z: Interval::ALL };

    /// The same place seen from a point at `origin`.
    #[must_use]
    pub fn seen_from(self, origin: [f64; 2]) -> Self {
        Self { x: self.x.affine(1.0, -origin[0]), z: self.z.affine(1.0, -origin[1]) }
    }
}

/// What is asked for besides arm and zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceOptions {
    /// Cutting force, N.
    pub force: f64,
    /// Which angles are tried.
    pub orientation: Orientation,
    /// Where the zone may stand.
    pub within: Within,
    /// Largest relative distance between the value and its lower bound.
    pub gap: f64,
}

impl PlaceOptions {
    /// As in the paper: horizontal or vertical, anywhere; a certificate of 1e-4.
    pub const fn paper(force: f64) -> Self {
        Self { force, orientation: Orientation::Axes, within: Within::ANYWHERE, gap: 1e-4 }
    }
}

/// The best place of a zone.
///
/// Frame of [`PlanarArm`]; deflections in m under the given force in its worst direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// The paper's eq. (2) at the best place, eq. (3): the worst deflection inside the zone.
    pub deflection: f64,
    /// No place that was allowed has less.
    pub lower_bound: f64,
    /// Centre of the zone.
    pub centre: [f64; 2],
    /// Angle of the first side, rad, in `[0, pi)`; zero for a circle.
    pub angle: f64,
    /// Elbow side of the whole zone.
    pub elbow: Elbow,
    /// Where in the zone the deflection is largest.
    pub worst_point: [f64; 2],
    /// Shoulder and elbow angle there, rad.
    pub worst_posture: [f64; 2],
}

/// Why a zone has no place.
#[derive(Clone, Debug, PartialEq)]
pub enum Misfit {
    /// No orientation fits between the nearest and the farthest point the arm reaches.
    TooLarge {
        /// Those two, m, of the widest elbow side.
        ring: [f64; 2],
    },
    /// It fits the ring, but the joint limits leave no place for it with one elbow side.
    Limits,
    /// It fits the arm, but not where it may stand.
    Within,
}

impl std::fmt::Display for Misfit {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::TooLarge { ring: [near, far] } => write!(
                f,
                "does not fit the reachable set: too long for any orientation between the nearest ({near:.3} m) and the farthest ({far:.3} m) distance from the joint-2 axis"
            ),
            Self::Limits => f.write_str(
                "does not fit the reachable set: the joint limits leave no place for it without a change of posture",
            ),
            Self::Within => f.write_str("does not fit where it may stand: no allowed place is reachable as a whole"),
        }
    }
}

/// The answer of [`place`].
#[derive(Clone, Debug, PartialEq)]
pub enum Placed {
    /// There is a best place.
    Feasible(Placement),
    /// There is none.
    Infeasible {
        /// Why.
        reason: Misfit,
        /// The largest scale found, to 1e-4, at which a zone of this shape has a place; zero where none has.
        largest_scale: f64,
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

/// A question that has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlaceError {
    /// The arm makes no sense.
    #[error(transparent)]
    Arm(#[from] InvalidArm),
    /// The planar model does not hold.
    #[error(transparent)]
    NoArmPlane(#[from] NoArmPlane),
    /// Force outside `0 < force <= 1e6`.
    #[error("a force of {0} N; expected more than 0 and at most 1e6 N")]
    Force(f64),
    /// Gap outside `1e-9..=0.5`.
    #[error("a gap of {0}; expected 1e-9 to 0.5 (relative)")]
    Gap(f64),
    /// An angle that is not a sensible number.
    #[error("an angle of {0} rad; expected a number from -1000 to 1000")]
    Angle(f64),
    /// A tool axis steeper than straight up or down.
    #[error("a tool axis {0} rad above the horizontal; expected -pi/2 (down) to pi/2 (up)")]
    Elevation(f64),
    /// A side of the zone that is not a sensible number.
    #[error("a zone with a side of {0} m; expected 1e-9 to 1000 m")]
    Side(f64),
    /// The search grew too large.
    #[error("the search stopped after {nodes} boxes: the best place lies between {:.4} and {:.4} mm; ask for a larger gap", lower * 1e3, upper * 1e3)]
    Unfinished {
        /// Boxes looked at.
        nodes: usize,
        /// Bound reached, m.
        lower: f64,
        /// Best value found, m (infinite where no place was found).
        upper: f64,
    },
}

/// Checks a force in N.
///
/// # Errors
/// Where it is not positive, or above 1 MN.
pub fn check_force(force: f64) -> Result<(), PlaceError> {
    if 0.0 < force && force <= 1e6 { Ok(()) } else { Err(PlaceError::Force(force)) }
}

/// Finds the place of `zone` that minimises the worst deflection inside it, with a certificate (\[paper\], eq. 3).
///
/// The zone lies in the arm plane, is reached with one elbow side throughout, and leaves the joint-2 axis outside.
/// Over a zone only the nearest and the farthest distance from that axis matter, `max(sigma(near), sigma(far))`,
/// because sigma has one valley. Where no limit on absolute angles binds, the optimum is exact (value = lower bound);
/// else a branch and bound over positions (and angle) proves it to `gap`.
///
/// # Errors
/// Where an argument makes no sense, or the search does not end.
pub fn place(arm: &PlanarArm, zone: Zone, options: &PlaceOptions) -> Result<Placed, PlaceError> {
    check(zone, options)?;
    let sides = arm.sides()?;
    let search = search::Search::new(arm, &sides, options);
    match search.best(zone)? {
        Some(placement) => Ok(Placed::Feasible(placement)),
        None => Ok(infeasible(arm, zone, options, &search)),
    }
}

/// [`place`] without a word about why a zone has no place, which costs more than finding out that it has none.
///
/// # Errors
/// As [`place`].
pub fn find(arm: &PlanarArm, zone: Zone, options: &PlaceOptions) -> Result<Option<Placement>, PlaceError> {
    check(zone, options)?;
    let sides = arm.sides()?;
    search::Search::new(arm, &sides, options).best(zone)
}

fn check(zone: Zone, options: &PlaceOptions) -> Result<(), PlaceError> {
    check_force(options.force)?;
    if !(1e-9..=0.5).contains(&options.gap) {
        return Err(PlaceError::Gap(options.gap));
    }
    if let Orientation::Fixed(angle) = options.orientation
        && !(angle.abs() <= 1e3)
    {
        return Err(PlaceError::Angle(angle));
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

/// [`place`] for a robot: `options.within` counts from its base, the answer from its joint-2 axis.
///
/// # Errors
/// As [`place`].
pub fn place_robot(robot: &Robot, zone: Zone, options: &PlaceOptions) -> Result<Placed, PlaceError> {
    let (plane, options) = plane_and_options(robot, options)?;
    place(&plane.arm, zone, &options)
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
    /// Looks where a placement of a robot stands; nowhere outside for a robot of which only the plane is known.
    pub fn of(robot: &Robot, zone: Zone, placement: &Placement) -> Self {
        const SLACK: f64 = 1e-6;
        let axis = robot.axis_2();
        if axis == [0.0; 2] {
            return Self { below: false, behind: false };
        }
        let half = zone.half_extents(placement.angle);
        let [x, z] = placement.centre;
        Self { below: z + axis[1] - half.y < -SLACK, behind: x + axis[0] - half.x < -SLACK }
    }
}

/// [`find`] for a robot, as [`place_robot`].
///
/// # Errors
/// As [`place`].
pub fn find_robot(robot: &Robot, zone: Zone, options: &PlaceOptions) -> Result<Option<Placement>, PlaceError> {
    let (plane, options) = plane_and_options(robot, options)?;
    find(&plane.arm, zone, &options)
}

fn plane_and_options(robot: &Robot, options: &PlaceOptions) -> Result<(ArmPlane, PlaceOptions), PlaceError> {
    let plane = robot.arm_plane()?;
    let within = options.within.seen_from(plane.axis_from_base);
    Ok((plane, PlaceOptions { within, ..*options }))
}

/// The value of the best place, m/N, of a zone for an arm whose limits are left aside; `None` where it does not fit.
///
/// Exact: the paper's section III, where any angle of a rectangle is as good as another.
///
/// # Errors
/// Where a length, a compliance or a side of the zone makes no sense.
pub fn best_without_limits(arm: &PlanarArm, zone: Zone) -> Result<Option<f64>, PlaceError> {
    arm.check()?;
    check_zone(zone)?;
    let sigma = arm.radial();
    let ring = Interval::spanning(sigma.folded, sigma.stretched);
    Ok(exact::stances(&sigma, ring, zone).first().map(|stance| stance.compliance))
}

/// The largest scale at which a zone fits an arm whose limits are left aside.
pub fn largest_scale_without_limits(arm: &PlanarArm, zone: Zone) -> f64 {
    let sigma = arm.radial();
    exact::largest_scale(Interval::spanning(sigma.folded, sigma.stretched), zone)
}

fn infeasible(arm: &PlanarArm, zone: Zone, options: &PlaceOptions, search: &search::Search) -> Placed {
    let sides = search.sides();
    let roomiest = sides.iter().max_by(|a, b| a.ring.width().total_cmp(&b.ring.width())).expect("a side");
    let fits = sides.iter().map(|side| exact::largest_scale(side.ring, zone)).fold(0.0, f64::max);
    let reason = if fits < 1.0 {
        Misfit::TooLarge { ring: [roomiest.ring.min(), roomiest.ring.max()] }
    } else if options.within == Within::ANYWHERE {
        Misfit::Limits
    } else {
        let anywhere = PlaceOptions { within: Within::ANYWHERE, ..*options };
        // Undecided so near to the limit of what fits, the limits are the likelier reason.
        if search::Search::new(arm, sides, &anywhere).has_place(zone) == Some(true) {
            Misfit::Within
        } else {
            Misfit::Limits
        }
    };
    Placed::Infeasible { reason, largest_scale: largest_scale(zone, search, fits.min(1.0)) }
}

/// The largest scale below `misfit` with a place, to 1e-4: zones of one shape nest about a common centre, so what fits is
/// monotone in the scale. Zero where nothing of a hundredth of a millimetre fits.
fn largest_scale(zone: Zone, search: &search::Search, mut misfit: f64) -> f64 {
    let [first, second] = zone.sides();
    let least = 1e-5 / first.max(second);
    let mut fit = 0.0;
    while least < misfit && 1e-4 * misfit < misfit - fit {
        let scale = f64::midpoint(fit, misfit);
        // An open answer counts as no: the scale that is reported has a place for certain.
        if search.has_place(zone.scaled(scale)) == Some(true) {
            fit = scale;
        } else {
            misfit = scale;
        }
    }
    fit
}

/// `v` turned by `angle`.
pub(crate) fn turned(v: Vector2<f64>, angle: f64) -> Vector2<f64> {
    let (s, c) = angle.sin_cos();
    Vector2::new(c * v.x - s * v.y, s * v.x + c * v.y)
}
