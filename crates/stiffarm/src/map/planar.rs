//! Deflections over a grid of the arm plane, row by row within the circles that bound what is reached.

use pulp::{Arch, Simd, WithSimd};

use super::directed::DirectedRows;
use super::spans::{RowSpans, Scratch};
use super::{Axis, Grid, MapError, MapOptions, PlaneGrid, Spacing};
use crate::interval::Interval;
use crate::load::Load;
use crate::model::PlanarModel;
use crate::parallel;
use crate::plane::{Elbow, ElbowSide, RadialCompliance};
use crate::watch::Watch;

/// Shoulder and elbow angle, rad, at a point from the joint-2 axis, with the one elbow side or the first that reaches it.
pub(super) fn posture(model: &PlanarModel, elbow: Option<Elbow>, point: [f64; 2]) -> Option<[f64; 2]> {
    let wanted = |side: &&ElbowSide| elbow.is_none_or(|only| only == side.elbow);
    model.sides.iter().filter(wanted).find_map(|side| side.posture(point.into())).map(<[f64; 2]>::from)
}

/// The upright box, m from the joint-2 axis, outside which the arm reaches nothing: forwards, upwards.
///
/// Found on a 256 x 256 grid and widened by one step, so that it holds all of the reached set that a map can show.
///
/// # Errors
/// Where the arm makes no sense.
pub(super) fn reached_box(model: &PlanarModel) -> Result<[Interval; 2], MapError> {
    const CELLS: usize = 256;
    let far = model.sides.iter().map(|side| side.ring.max()).fold(0.0, f64::max);
    let axis = Axis::between(-far, far, CELLS);
    let grid = PlaneGrid { x: axis, z: axis };
    let mut cells = vec![0.0; CELLS * CELLS];
    fill(model, &MapOptions::over(Spacing::Points(CELLS), Load::UNIT), &grid, &mut cells, Watch::nobody())?;
    let map = Grid { x: axis, z: axis, cells };
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

/// The deflection, m, at every point of a grid; NaN where the arm does not reach.
pub(super) fn fill(
    model: &PlanarModel,
    options: &MapOptions,
    grid: &PlaneGrid,
    cells: &mut [f64],
    watch: Watch,
) -> Result<(), MapError> {
    let columns = grid.x.count;
    assert_eq!(cells.len(), columns * grid.z.count, "one cell per grid point");
    let mut sides = model.sides.clone();
    if let Some(elbow) = options.elbow {
        sides.retain(|side| side.elbow == elbow);
        if sides.is_empty() {
            return Err(MapError::Elbow(elbow.name()));
        }
    }
    let (arm, force) = (&model.arm, options.load.newtons());
    let directed = options.load.sector()?.map(|sector| DirectedRows::new(arm, sector, force));
    let spans = RowSpans::new(&sides, grid.x);
    let block = (16_384 / columns).max(1);
    let parts = watch.parts(Some(grid.z.count.div_ceil(block)));
    let fill = |number: usize, block_cells: &mut [f64]| {
        let first = number * block;
        match &directed {
            None => {
                let (sigma, spans) = (arm.radial(), &spans);
                Arch::new().dispatch(WorstRows { sigma, spans, grid, force, first, cells: block_cells });
            }
            Some(directed) => directed.fill(&spans, grid, first, block_cells),
        }
        parts.one_more()
    };
    parallel::try_take_each(cells.chunks_mut(block * columns), fill)?;
    Ok(())
}

/// Rows from `first` on: sigma(r) over the reached spans, blank elsewhere. A type of its own: a closure may be compiled without the wide
/// instructions.
struct WorstRows<'a> {
    sigma: RadialCompliance,
    spans: &'a RowSpans<'a>,
    grid: &'a PlaneGrid,
    force: f64,
    first: usize,
    cells: &'a mut [f64],
}

impl WithSimd for WorstRows<'_> {
    type Output = ();

    #[allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { sigma, spans, grid, force, first, cells } = self;
        // sigma F = (h0 + h1 t) + sqrt(a (t - t0)^2 + e), all scaled by F.
        let (h0, h1) = (sigma.half_trace_0 * force, sigma.half_trace_1 * force);
        let (a, e) = (sigma.a * force * force, sigma.e * force * force);
        let t0 = sigma.t0;
        let squares: &[f64] = &spans.squares;
        let mut scratch = Scratch::default();
        for (j, row) in cells.chunks_mut(squares.len()).enumerate() {
            let z = grid.z.at(first + j);
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
    }
}
