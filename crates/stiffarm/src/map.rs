//! Verb 2: how far is the tool pushed off, everywhere the arm reaches?

mod directed;
mod planar;
mod rolls;
mod section;
mod spans;

use crate::interval::Interval;
use crate::inverse::Configuration;
use crate::load::{Load, NotInPlane};
use crate::model::{ArmPosture, Model, ModelError, PlanarModel, SpatialModel};
use crate::plane::{Elbow, InvalidArm, PlanarArm};
use crate::watch::{Stopped, Watch};

pub use section::ROLL_TOLERANCE;

/// More cells than this are refused before memory is taken (800 MB).
pub const MOST_CELLS: usize = 100_000_000;

/// And in space, where a cell holds margins, posture and roll besides (half a gigabyte while it is made).
pub const MOST_CELLS_IN_SPACE: usize = MOST_CELLS / 20;

/// Evenly spaced points along one axis of a map, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The first point.
    pub start: f64,
    /// Distance between points.
    pub step: f64,
    /// How many.
    pub count: usize,
}

impl Axis {
    /// `count` points from `start` to `end`.
    pub fn between(start: f64, end: f64, count: usize) -> Self {
        Self { start, step: (end - start) / (count.max(2) - 1) as f64, count }
    }

    /// Points that cover a range, one step apart.
    pub fn covering(range: Interval, step: f64) -> Self {
        let steps = (range.width() / step).ceil();
        // Far beyond what is allowed, so that the refusal names the size without overflow.
        let count = if steps < 1e12 { steps as usize + 1 } else { 1_000_000_000_000 };
        Self { start: range.min(), step, count }
    }

    /// The `i`-th point.
    pub fn at(&self, i: usize) -> f64 {
        self.start + self.step * i as f64
    }

    /// All points.
    pub fn points(&self) -> Vec<f64> {
        (0..self.count).map(|i| self.at(i)).collect()
    }
}

/// How close the points of a map are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spacing {
    /// Distance between them, m.
    Step(f64),
    /// So many, at least two, along the longer side.
    Points(usize),
}

impl Spacing {
    /// Points that cover a box.
    pub fn cover(self, [x, z]: [Interval; 2]) -> [Axis; 2] {
        let step = match self {
            Self::Step(step) => step,
            Self::Points(count) => x.width().max(z.width()) / (count.max(2) - 1) as f64,
        };
        [x, z].map(|range| Axis::covering(range, step))
    }
}

/// Where points of a map stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// All over what is reached.
    Reached(Spacing),
    /// On a grid, m from the base: forwards and upwards.
    Grid {
        /// Forwards.
        x: Axis,
        /// Upwards.
        z: Axis,
    },
}

/// What is mapped. What a model does not know is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapOptions {
    /// Where its points stand.
    pub extent: Extent,
    /// The force; the planar model takes one in the arm plane.
    pub load: Load,
    /// One elbow side, or the stiffer of those that reach a point; planar model only.
    pub elbow: Option<Elbow>,
    /// How the tool is held, spatial model only; straight down where `None`.
    pub held: Option<HeldPosture>,
}

/// How the tool is held at every point of a map in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldPosture {
    /// Angle of the tool axis above the horizontal, rad: `-pi/2` down, `0` ahead.
    pub elevation: f64,
    /// Angle of the tool axis about the vertical, rad: out of the plane, to the left.
    pub yaw: f64,
    /// About the tool axis, rad; the stiffest at each point, to [`ROLL_TOLERANCE`], where `None`.
    pub roll: Option<f64>,
    /// One configuration, or the stiffest at each point.
    pub configuration: Option<Configuration>,
}

impl HeldPosture {
    /// Straight down, at the best roll and in the best configuration of every point.
    pub const TOOL_DOWN: Self =
        Self { elevation: -std::f64::consts::FRAC_PI_2, yaw: 0.0, roll: None, configuration: None };
}

impl MapOptions {
    /// All over what is reached, as the model usually holds the tool.
    pub const fn over(spacing: Spacing, load: Load) -> Self {
        Self { extent: Extent::Reached(spacing), load, elbow: None, held: None }
    }

    /// How the tool is held: straight down where nothing is said.
    pub fn held(&self) -> HeldPosture {
        self.held.unwrap_or(HeldPosture::TOOL_DOWN)
    }
}

/// One number over a grid; absent where the arm does not reach.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Forwards from the base.
    pub x: Axis,
    /// Upwards from the base.
    pub z: Axis,
    /// Row by row from the first z; NaN stands for absent and does not leave this module.
    cells: Vec<f64>,
}

/// Deflections over everything an arm reaches.
#[derive(Clone, Debug)]
pub struct Map {
    /// m, under the load.
    pub deflection: Grid,
    /// What only the spatial model knows.
    pub space: Option<Margins>,
    /// Of the planar model: the points as its arm sees them.
    from_axis_2: [Axis; 2],
}

/// Which posture holds each point in space, and how far it is from what it must not reach.
#[derive(Clone, Debug)]
pub struct Margins {
    /// Distance of the nearest joint, or of the angle between the links, to its limits, rad; joint 1 left aside, and joint 6 where the
    /// roll moves nothing.
    pub limits: Grid,
    /// Distance to a straight wrist or a stretched or folded arm, rad.
    pub singular: Grid,
    /// Configuration and roll (rad) of every cell, row by row.
    held: Vec<Option<(Configuration, f64)>>,
}

/// A map that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MapError {
    /// The model does not hold for the robot.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// What another model knows.
    #[error("{what} needs the {model} model")]
    Inapplicable {
        /// What was asked for.
        what: &'static str,
        /// The model that knows it.
        model: &'static str,
    },
    /// A force of which the planar model knows nothing.
    #[error(transparent)]
    Load(#[from] NotInPlane),
    /// Too many cells, or none.
    #[error(
        "a map of {columns} x {rows} cells; expected at least 2 x 2 and at most {most} cells: choose a larger step"
    )]
    Size {
        /// Along x.
        columns: usize,
        /// Along z.
        rows: usize,
        /// How many may be asked for.
        most: usize,
    },
    /// A grid that is not finite.
    #[error("a grid that starts at {start} m with steps of {step} m; expected finite numbers and a positive step")]
    Grid {
        /// First point.
        start: f64,
        /// Step.
        step: f64,
    },
    /// An angle of the tool that is no sensible number.
    #[error("a direction of {0} rad; expected a finite number")]
    Direction(f64),
    /// The limits leave nothing on the elbow side asked for.
    #[error("the limits leave nothing reachable with the elbow {0}")]
    Elbow(&'static str),
    /// No point at all.
    #[error("no point is reached with this direction of the tool")]
    NothingReached,
    /// No longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

impl From<InvalidArm> for MapError {
    fn from(error: InvalidArm) -> Self {
        Self::Model(error.into())
    }
}

impl Grid {
    /// Row by row from the first z; NaN where nothing is known.
    pub(crate) fn of(x: Axis, z: Axis, cells: Vec<f64>) -> Self {
        Self { x, z, cells }
    }

    /// The number at column `i` and row `j`.
    pub fn get(&self, i: usize, j: usize) -> Option<f64> {
        Some(self.cells[j * self.x.count + i]).filter(|value| !value.is_nan())
    }

    /// The numbers of one row.
    pub fn row(&self, j: usize) -> impl Iterator<Item = Option<f64>> {
        let row = &self.cells[j * self.x.count..(j + 1) * self.x.count];
        row.iter().map(|&value| Some(value).filter(|value| !value.is_nan()))
    }

    /// The smallest and the largest number, each with its column and row; `None` where nothing is reached.
    pub fn extremes(&self) -> Option<[(f64, usize, usize); 2]> {
        let found = self.cells.iter().enumerate().filter(|(_, value)| !value.is_nan());
        let at = |i: usize| (self.cells[i], i % self.x.count, i / self.x.count);
        let least = found.clone().min_by(|a, b| a.1.total_cmp(b.1))?.0;
        let most = found.max_by(|a, b| a.1.total_cmp(b.1))?.0;
        Some([at(least), at(most)])
    }
}

impl Map {
    /// Joint angles as the robot reports them, rad, at column `i` and row `j` of a map in space that `model` made with `options`.
    pub(crate) fn joints(&self, model: &SpatialModel, options: &MapOptions, i: usize, j: usize) -> Option<[f64; 6]> {
        let point = [self.deflection.x.at(i), self.deflection.z.at(j)];
        section::joints(model, (options.load, &options.held()), self.space.as_ref()?.at(i, j)?, point)
    }

    /// The stiffest point: its column, its row, and the posture that holds it there; `None` where nothing is reached. In space joint 1
    /// points straight ahead whatever its limits, and joint 6 turns freely where the roll moves nothing.
    ///
    /// `options` are those with which `model` made the map.
    pub fn stiffest(&self, model: &Model, options: &MapOptions) -> Option<(usize, usize, ArmPosture)> {
        let [(_, i, j), _] = self.deflection.extremes()?;
        let posture = match (model, &self.space) {
            (Model::Planar(model), None) => {
                let point = [self.from_axis_2[0].at(i), self.from_axis_2[1].at(j)];
                ArmPosture::Plane(planar::posture(model, options.elbow, point)?)
            }
            (Model::Spatial(model), Some(_)) => ArmPosture::Joints(self.joints(model, options, i, j)?),
            (Model::Planar(_), Some(_)) | (Model::Spatial(_), None) => return None, // another model's map
        };
        Some((i, j, posture))
    }
}

/// Points in space between those of a map: where it ends, and where one way to hold them gives way to another.
pub struct PointsBetween(section::Points);

impl PointsBetween {
    /// Of a map with these options.
    pub fn of(model: &SpatialModel, options: &MapOptions) -> Self {
        Self(section::Points::new(model.arm(), options.load, &options.held()))
    }

    /// Configuration and roll, rad, that a map tells of a point, m from the base; `None` where nothing reaches it.
    pub fn held(&self, point: [f64; 2]) -> Option<(Configuration, f64)> {
        self.0.at(point)
    }
}

impl Margins {
    /// Configuration and roll, rad, at column `i` and row `j`.
    pub fn at(&self, i: usize, j: usize) -> Option<(Configuration, f64)> {
        self.held[j * self.limits.x.count + i]
    }

    /// Configuration and roll, rad, of every cell of row `j`.
    pub fn row(&self, j: usize) -> impl Iterator<Item = Option<(Configuration, f64)>> {
        let columns = self.limits.x.count;
        self.held[j * columns..(j + 1) * columns].iter().copied()
    }
}

/// Maps the deflection over a grid: in the arm plane (\[paper\], Fig. 2 and 3), or over the section through the joint-1 axis that
/// points straight ahead, at the best configuration and roll of every point.
///
/// In space the points stand for all places about the robot: joint 1 turns there, and its limits are left aside. Under a force along
/// base axes that points aside they stand for themselves alone, and joint 1 keeps its limits. The first side of the work, from which
/// the direction of the feed counts, points ahead; on work that leans, upwards.
///
/// ```
/// use stiffarm::catalogue::find;
/// use stiffarm::load::Load;
/// use stiffarm::map::{MapOptions, Spacing, map};
/// use stiffarm::model::Model;
///
/// let robot = find("KR 210 R2700 extra").ok_or("in the catalogue")?.robot();
/// let map = map(&Model::planar(&robot)?, &MapOptions::over(Spacing::Step(0.05), Load::PAPER))?;
/// let [(least, i, j), _] = map.deflection.extremes().ok_or("reached")?;
/// assert!(1.444e-3 < least && least < 1.5e-3); // m under 1 kN
/// println!("stiffest at {:.2} m ahead of and {:.2} m above the base", map.deflection.x.at(i), map.deflection.z.at(j));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Where an argument makes no sense or belongs to another model; a map that is too large is refused before memory is taken.
pub fn map(model: &Model, options: &MapOptions) -> Result<Map, MapError> {
    map_watched(model, options, Watch::nobody())
}

/// [`map`] that somebody waits for. Its parts are rows, or some of them at once.
///
/// # Errors
/// As [`map`], and [`MapError::Stopped`] where the work is no longer wanted.
pub fn map_watched(model: &Model, options: &MapOptions, watch: Watch) -> Result<Map, MapError> {
    match model {
        Model::Planar(model) => {
            let grid = PlaneGrid::of(model, options)?;
            let mut cells = vec![0.0; grid.x.count * grid.z.count];
            planar::fill(model, options, &grid, &mut cells, watch)?;
            let [ahead, up] = model.axis_from_base;
            let from_base = |axis: Axis, by: f64| Axis { start: axis.start + by, ..axis };
            let deflection = Grid { x: from_base(grid.x, ahead), z: from_base(grid.z, up), cells };
            Ok(Map { deflection, space: None, from_axis_2: [grid.x, grid.z] })
        }
        Model::Spatial(model) => in_space(model, options, watch),
    }
}

/// [`map`] of the planar model into memory that is there already, row by row; NaN where the arm does not reach.
///
/// # Errors
/// As [`map`].
///
/// # Panics
/// Where `cells` is not as long as the grid has points.
pub fn map_into(model: &PlanarModel, options: &MapOptions, cells: &mut [f64]) -> Result<(), MapError> {
    planar::fill(model, options, &PlaneGrid::of(model, options)?, cells, Watch::nobody())
}

/// A grid as the arm sees it: from the joint-2 axis.
struct PlaneGrid {
    x: Axis,
    z: Axis,
}

impl PlaneGrid {
    fn of(model: &PlanarModel, options: &MapOptions) -> Result<Self, MapError> {
        if options.held.is_some() {
            return Err(MapError::Inapplicable { what: "a direction of the tool", model: "spatial" });
        }
        let [x, z] = match options.extent {
            Extent::Reached(spacing) => spacing.cover(planar::reached_box(model)?),
            Extent::Grid { x, z } => {
                let [ahead, up] = model.axis_from_base;
                [Axis { start: x.start - ahead, ..x }, Axis { start: z.start - up, ..z }]
            }
        };
        check_grid(x, z, MOST_CELLS)?;
        Ok(Self { x, z })
    }
}

fn check_grid(x: Axis, z: Axis, most: usize) -> Result<(), MapError> {
    let (columns, rows) = (x.count, z.count);
    if columns < 2 || rows < 2 || !columns.checked_mul(rows).is_some_and(|cells| cells <= most) {
        return Err(MapError::Size { columns, rows, most });
    }
    match [x, z].into_iter().find(|axis| !(axis.start.is_finite() && axis.step.is_finite() && 0.0 < axis.step)) {
        Some(Axis { start, step, .. }) => Err(MapError::Grid { start, step }),
        None => Ok(()),
    }
}

fn in_space(model: &SpatialModel, options: &MapOptions, watch: Watch) -> Result<Map, MapError> {
    if options.elbow.is_some() {
        return Err(MapError::Inapplicable { what: "one elbow side", model: "planar" });
    }
    let held = options.held();
    if let Some(angle) =
        [held.elevation, held.yaw, held.roll.unwrap_or(0.0)].into_iter().find(|angle| !(angle.abs() <= 1e3))
    {
        return Err(MapError::Direction(angle));
    }
    let [x, z] = match options.extent {
        Extent::Reached(spacing) => {
            let reached = section::reached_box(model.arm(), options.load, &held, watch.of_part())?;
            spacing.cover(reached.ok_or(MapError::NothingReached)?)
        }
        Extent::Grid { x, z } => [x, z],
    };
    check_grid(x, z, MOST_CELLS_IN_SPACE)?;
    Ok(section::section(model.arm(), [x, z], (options.load, &held), watch)?)
}

/// The upright box, m from the joint-2 axis, outside which two links reach nothing: forwards, upwards.
///
/// Found on a 256 x 256 grid and widened by one step, so that it holds all of the reached set that a map can show.
///
/// # Errors
/// Where the arm makes no sense.
pub fn reached_box(arm: &PlanarArm) -> Result<[Interval; 2], MapError> {
    planar::reached_box(&PlanarModel::of_links(arm)?)
}
