//! Verb 2: how far is the tool pushed off, everywhere the arm reaches?

mod rolls;
mod section;
mod spans;

use nalgebra::Vector2;
use rayon::prelude::*;

use crate::compliance::PostureError;
use crate::interval::Interval;
use crate::place::{PlaceError, check_force};
use crate::plane::{Elbow, ElbowSide, InvalidArm, PlanarArm, RadialCompliance};
use spans::{RowSpans, Scratch};

pub use section::{ROLL_TOLERANCE, Section, SectionOptions, reached_section, section};

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

/// What part of a deflection is mapped for a force of known direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// The whole displacement, `|C n| F`: the paper's eq. (1) for one direction.
    Total,
    /// Its part along the force, `n^T C n F`.
    Along,
}

/// The direction of the force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// The worst in every point.
    Worst,
    /// One angle in the arm plane, rad, counter-clockwise from straight ahead.
    Given(f64, Component),
}

/// What is mapped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapOptions {
    /// Forwards, from the joint-2 axis.
    pub x: Axis,
    /// Upwards, from the joint-2 axis.
    pub z: Axis,
    /// Force, N.
    pub force: f64,
    /// Its direction.
    pub direction: Direction,
    /// One elbow side, or the stiffer of those that reach a point.
    pub elbow: Option<Elbow>,
}

/// Deflections, m, over a grid; absent where the arm does not reach.
#[derive(Clone, Debug)]
pub struct Map {
    /// Forwards, from the joint-2 axis.
    pub x: Axis,
    /// Upwards, from the joint-2 axis.
    pub z: Axis,
    /// Row by row from the first z; NaN stands for absent and does not leave this module.
    cells: Vec<f64>,
}

/// A map that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MapError {
    /// The arm or the force makes no sense.
    #[error(transparent)]
    Arm(#[from] PlaceError),
    /// Robot or tool make no sense.
    #[error(transparent)]
    Posture(#[from] PostureError),
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
    /// A direction that is not finite.
    #[error("a direction of {0} rad; expected a finite number")]
    Direction(f64),
    /// The limits leave nothing on the elbow side asked for.
    #[error("the limits leave nothing reachable with the elbow {0}")]
    Elbow(&'static str),
}

impl From<InvalidArm> for MapError {
    fn from(error: InvalidArm) -> Self {
        Self::Arm(error.into())
    }
}

impl Map {
    /// Deflection, m, at column `i` and row `j`.
    pub fn get(&self, i: usize, j: usize) -> Option<f64> {
        Some(self.cells[j * self.x.count + i]).filter(|value| !value.is_nan())
    }

    /// The deflections of one row.
    pub fn row(&self, j: usize) -> impl Iterator<Item = Option<f64>> {
        let row = &self.cells[j * self.x.count..(j + 1) * self.x.count];
        row.iter().map(|&value| Some(value).filter(|value| !value.is_nan()))
    }

    /// The smallest and the largest deflection, each with its column and row; `None` where nothing is reached.
    pub fn extremes(&self) -> Option<[(f64, usize, usize); 2]> {
        let found = self.cells.iter().enumerate().filter(|(_, value)| !value.is_nan());
        let at = |i: usize| (self.cells[i], i % self.x.count, i / self.x.count);
        let least = found.clone().min_by(|a, b| a.1.total_cmp(b.1))?.0;
        let most = found.max_by(|a, b| a.1.total_cmp(b.1))?.0;
        Some([at(least), at(most)])
    }
}

/// Maps the deflection over a grid (\[paper\], Fig. 2 and 3), within the joint limits of each elbow side.
///
/// # Errors
/// Where an argument makes no sense; a map that is too large is refused before memory is taken.
pub fn map(arm: &PlanarArm, options: &MapOptions) -> Result<Map, MapError> {
    let (columns, rows) = (options.x.count, options.z.count);
    if columns < 2 || rows < 2 || !columns.checked_mul(rows).is_some_and(|cells| cells <= MOST_CELLS) {
        return Err(MapError::Size { columns, rows, most: MOST_CELLS });
    }
    let mut cells = vec![0.0; columns * rows];
    map_into(arm, options, &mut cells)?;
    Ok(Map { x: options.x, z: options.z, cells })
}

/// Shoulder and elbow angle, rad, at the stiffest point of a map, with the one elbow side or the first that reaches it.
pub fn stiffest_posture(arm: &PlanarArm, map: &Map, elbow: Option<Elbow>) -> Option<(f64, f64)> {
    let [(_, i, j), _] = map.extremes()?;
    let p = [map.x.at(i), map.z.at(j)];
    let sides = arm.sides().ok()?;
    let wanted = |side: &&ElbowSide| elbow.is_none_or(|only| only == side.elbow);
    sides.iter().filter(wanted).find_map(|side| side.posture(p.into()))
}

/// The upright box, m from the joint-2 axis, outside which the arm reaches nothing: forwards, upwards.
///
/// Found on a 256 x 256 grid and widened by one step, so that it holds all of the reached set that a map can show.
///
/// # Errors
/// Where the arm makes no sense.
pub fn reached_box(arm: &PlanarArm) -> Result<[Interval; 2], MapError> {
    const CELLS: usize = 256;
    let far = arm.sides()?.iter().map(|side| side.ring.max()).fold(0.0, f64::max);
    let axis = Axis::between(-far, far, CELLS);
    let options = MapOptions { x: axis, z: axis, force: 1.0, direction: Direction::Worst, elbow: None };
    let map = map(arm, &options)?;
    let reached: Vec<(usize, usize)> = (0..CELLS)
        .flat_map(|j| {
            map.row(j).enumerate().filter(|(_, cell)| cell.is_some()).map(move |(i, _)| (i, j)).collect::<Vec<_>>()
        })
        .collect();
    let span = |pick: fn(&(usize, usize)) -> usize| {
        let (min, max) = (reached.iter().map(pick).min(), reached.iter().map(pick).max());
        match (min, max) {
            (Some(min), Some(max)) => Interval::spanning(axis.at(min) - axis.step, axis.at(max) + axis.step),
            _ => Interval::spanning(-far, far),
        }
    };
    Ok([span(|cell| cell.0), span(|cell| cell.1)])
}

/// [`map`] into memory that is there already, row by row; NaN where the arm does not reach.
///
/// # Errors
/// As [`map`].
///
/// # Panics
/// Where `cells` is not `x.count * z.count` long.
pub fn map_into(arm: &PlanarArm, options: &MapOptions, cells: &mut [f64]) -> Result<(), MapError> {
    check_force(options.force)?;
    for Axis { start, step, .. } in [options.x, options.z] {
        if !(start.is_finite() && step.is_finite() && 0.0 < step) {
            return Err(MapError::Grid { start, step });
        }
    }
    if let Direction::Given(angle, _) = options.direction
        && !angle.is_finite()
    {
        return Err(MapError::Direction(angle));
    }
    let columns = options.x.count;
    assert_eq!(cells.len(), columns * options.z.count, "one cell per grid point");
    let mut sides = arm.sides()?;
    if let Some(elbow) = options.elbow {
        sides.retain(|side| side.elbow == elbow);
        if sides.is_empty() {
            return Err(MapError::Elbow(elbow.name()));
        }
    }
    let spans = RowSpans::new(&sides, options.x);
    let block = (16_384 / columns).max(1);
    let fill = |(number, block_cells): (usize, &mut [f64])| {
        let first = number * block;
        match options.direction {
            Direction::Worst => worst_rows(&arm.radial(), &spans, options, first, block_cells),
            Direction::Given(angle, component) => {
                for (j, row) in block_cells.chunks_mut(columns).enumerate() {
                    directed_row(arm, &sides, &spans, options, (angle, component), first + j, row);
                }
            }
        }
    };
    cells.par_chunks_mut(block * columns).enumerate().for_each(fill);
    Ok(())
}

/// Rows from `first` on: sigma(r) over the reached spans, blank elsewhere. Vectorised with what the machine has.
fn worst_rows(sigma: &RadialCompliance, spans: &RowSpans, options: &MapOptions, first: usize, cells: &mut [f64]) {
    let force = options.force;
    // sigma F = (h0 + h1 t) + sqrt(a (t - t0)^2 + e), all scaled by F.
    let (h0, h1) = (sigma.half_trace_0 * force, sigma.half_trace_1 * force);
    let (a, e) = (sigma.a * force * force, sigma.e * force * force);
    let t0 = sigma.t0;
    let squares: &[f64] = &spans.squares;
    let mut scratch = Scratch::default();
    pulp::Arch::new().dispatch(|| {
        for (j, row) in cells.chunks_mut(squares.len()).enumerate() {
            let z = options.z.at(first + j);
            let z2 = z * z;
            let mut blank_from = 0;
            spans.reached(z, &mut scratch);
            for span in &scratch.spans {
                row[blank_from..span.start].fill(f64::NAN);
                for (cell, x2) in row[span.clone()].iter_mut().zip(&squares[span.clone()]) {
                    let t = x2 + z2;
                    let u = t - t0;
                    *cell = h0 + h1 * t + (a * u * u + e).sqrt();
                }
                blank_from = span.end;
            }
            row[blank_from..].fill(f64::NAN);
        }
    });
}

/// One row for a given direction: the smaller deflection of the sides that reach a point.
fn directed_row(
    arm: &PlanarArm,
    sides: &[ElbowSide],
    spans: &RowSpans,
    options: &MapOptions,
    (angle, component): (f64, Component),
    j: usize,
    row: &mut [f64],
) {
    let force = options.force * Vector2::new(angle.cos(), angle.sin());
    let z = options.z.at(j);
    row.fill(f64::NAN);
    let mut scratch = Scratch::default();
    for (i, side) in sides.iter().enumerate() {
        spans.reached_by(i, z, &mut scratch);
        for span in &scratch.spans {
            for column in span.clone() {
                let p = Vector2::new(options.x.at(column), z);
                let Some(upper) = side.upper_arm(p) else {
                    continue;
                };
                let moved = arm.compliance_of_links(upper, p - upper) * force;
                let deflection = match component {
                    Component::Total => moved.norm(),
                    Component::Along => moved.dot(&force) / options.force,
                };
                row[column] = row[column].min(deflection);
            }
        }
    }
}
