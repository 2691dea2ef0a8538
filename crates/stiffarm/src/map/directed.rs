//! Rows of a map of the arm plane under a force of which the direction is known.
//!
//! With the wrist centre at `p` from the joint-2 axis, the elbow at `u = a p + b e x p` and the forearm `g = p - u`, drives move it along `e x p`
//! (drive 2 of a serial arm), `e x u` (of a parallelogram) and `e x g`. Seen along and across the force, both sides of the elbow share
//! everything but the sign of `b`. Plain loops over columns, so that they run on as many at a time as the registers hold.

use pulp::{Simd, WithSimd};

use super::PlaneGrid;
use super::spans::{RowSpans, Scratch};
use crate::drive::Architecture;
use crate::load::Sector;
use crate::plane::{Elbow, PlanarArm};

/// What is the same at every cell.
#[derive(Clone, Copy)]
pub(super) struct DirectedRows {
    /// Squared length of the upper arm, m^2, and half of what that of the forearm lacks.
    upper_square: f64,
    kappa: f64,
    /// Compliance of both drives times the force, m/(N m) N.
    k2: f64,
    k3: f64,
    architecture: Architecture,
    sector: Sector,
}

/// Compliance times the force, seen along and across the middle direction of it, m.
#[derive(Clone, Copy)]
struct Seen {
    along: f64,
    mixed: f64,
    across: f64,
}

impl DirectedRows {
    pub(super) fn new(arm: &PlanarArm, sector: Sector, newtons: f64) -> Self {
        Self {
            upper_square: arm.l2 * arm.l2,
            kappa: (arm.l2 * arm.l2 - arm.l3 * arm.l3) / 2.0,
            k2: arm.k2 * newtons,
            k3: arm.k3 * newtons,
            architecture: arm.architecture,
            sector,
        }
    }

    /// Rows from `first` on: the deflection of the stiffer side that reaches a cell, blank elsewhere. Vectorised with what the machine has.
    pub(super) fn fill(&self, spans: &RowSpans, grid: &PlaneGrid, first: usize, cells: &mut [f64]) {
        match (self.architecture, self.sector.is_one(), self.sector.is_along) {
            (Architecture::Serial, true, false) => self.rows::<false, true, false>(spans, grid, first, cells),
            (Architecture::Serial, true, true) => self.rows::<false, true, true>(spans, grid, first, cells),
            (Architecture::Serial, false, false) => self.rows::<false, false, false>(spans, grid, first, cells),
            (Architecture::Serial, false, true) => self.rows::<false, false, true>(spans, grid, first, cells),
            (Architecture::QuasiSerial, true, false) => self.rows::<true, true, false>(spans, grid, first, cells),
            (Architecture::QuasiSerial, true, true) => self.rows::<true, true, true>(spans, grid, first, cells),
            (Architecture::QuasiSerial, false, false) => self.rows::<true, false, false>(spans, grid, first, cells),
            (Architecture::QuasiSerial, false, true) => self.rows::<true, false, true>(spans, grid, first, cells),
        }
    }

    fn rows<const QUASI: bool, const ONE: bool, const ALONG: bool>(
        &self,
        spans: &RowSpans,
        grid: &PlaneGrid,
        first: usize,
        cells: &mut [f64],
    ) {
        pulp::Arch::new().dispatch(Rows::<QUASI, ONE, ALONG> { counted: *self, spans, grid, first, cells });
    }

    /// Cells that both sides of the elbow reach, or one of them: that of the sign.
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]
    #[inline(always)]
    fn each<const BOTH: bool, const QUASI: bool, const ONE: bool, const ALONG: bool>(
        &self,
        sign: f64,
        z: f64,
        x: &[f64],
        found: &mut [f64],
    ) {
        for (found, &x) in found.iter_mut().zip(x) {
            *found = self.cell::<BOTH, QUASI, ONE, ALONG>(sign, [x, z]);
        }
    }

    /// What counts at a cell, m, of the stiffer side or that of the sign.
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]
    #[inline(always)]
    fn cell<const BOTH: bool, const QUASI: bool, const ONE: bool, const ALONG: bool>(
        &self,
        sign: f64,
        [x, z]: [f64; 2],
    ) -> f64 {
        let (part, height, along, across) = self.triangle(x, z);
        let height = sign * height;
        let mut counted = self.counted::<QUASI, ONE, ALONG>(part, height, along, across);
        if BOTH {
            let other = self.counted::<QUASI, ONE, ALONG>(part, -height, along, across);
            counted = if counted < other { counted } else { other };
        }
        if ALONG { counted } else { counted.sqrt() }
    }

    /// `a`, and `b` of the upper side; the wrist centre along the force and across it, m.
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]
    #[inline(always)]
    fn triangle(&self, x: f64, z: f64) -> (f64, f64, f64, f64) {
        let inverse = 1.0 / (x * x + z * z);
        let part = 0.5 + self.kappa * inverse;
        let height = (self.upper_square * inverse - part * part).max(0.0).sqrt();
        let (fx, fz) = (self.sector.middle.x, self.sector.middle.y);
        (part, height, x * fx + z * fz, x * fz - z * fx)
    }

    /// What counts, m; squared where all of the displacement does.
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]
    #[inline(always)]
    fn counted<const QUASI: bool, const ONE: bool, const ALONG: bool>(
        &self,
        part: f64,
        height: f64,
        along: f64,
        across: f64,
    ) -> f64 {
        // The links, along and across the force: what is across turns them along it.
        let (upper_across, upper_along) = (part * across - height * along, part * along + height * across);
        let (fore_across, fore_along) = (across - upper_across, along - upper_along);
        let (by_2, aside_2) = if QUASI { (upper_across, upper_along) } else { (across, along) };
        let seen = Seen {
            along: self.k2 * (by_2 * by_2) + self.k3 * (fore_across * fore_across),
            mixed: self.k2 * (by_2 * aside_2) + self.k3 * (fore_across * fore_along),
            across: self.k2 * (aside_2 * aside_2) + self.k3 * (fore_along * fore_along),
        };
        match (ONE, ALONG) {
            (true, true) => seen.along,
            (true, false) => seen.along * seen.along + seen.mixed * seen.mixed,
            (false, true) => self.most(seen),
            (false, false) => self.most(seen.squared()),
        }
    }

    /// The greatest of a quadratic form over the sector: in the middle of its eigenvalues plus or minus half their distance times the cosine
    /// of twice the angle to the softer one.
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]
    #[inline(always)]
    fn most(&self, seen: Seen) -> f64 {
        let (apart, mixed) = (seen.along - seen.across, 2.0 * seen.mixed.abs());
        let length = (apart * apart + mixed * mixed).sqrt();
        let [c, s] = self.sector.twice;
        let at_edge = apart * c + mixed * s;
        0.5 * ((seen.along + seen.across) + if length * c <= apart { length } else { at_edge })
    }
}

/// Rows that are filled. A type of its own: a closure as large as this is compiled without the wide instructions.
struct Rows<'a, const QUASI: bool, const ONE: bool, const ALONG: bool> {
    counted: DirectedRows,
    spans: &'a RowSpans<'a>,
    grid: &'a PlaneGrid,
    first: usize,
    cells: &'a mut [f64],
}

impl<const QUASI: bool, const ONE: bool, const ALONG: bool> WithSimd for Rows<'_, QUASI, ONE, ALONG> {
    type Output = ();

    #[allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { counted, spans, grid, first, cells } = self;
        let points = spans.points.as_slice();
        let mut scratch = Scratch::default();
        let mut pieces = Vec::new();
        for (j, row) in cells.chunks_mut(points.len()).enumerate() {
            let z = grid.z.at(first + j);
            spans.by_elbow(z, &mut scratch, &mut pieces);
            let mut blank_from = 0;
            for (span, by) in &pieces {
                row[blank_from..span.start].fill(f64::NAN);
                let (found, x) = (&mut row[span.clone()], &points[span.clone()]);
                match *by {
                    [true, true] => counted.each::<true, QUASI, ONE, ALONG>(1.0, z, x, found),
                    [true, false] => counted.each::<false, QUASI, ONE, ALONG>(-Elbow::Up.sign(), z, x, found),
                    _ => counted.each::<false, QUASI, ONE, ALONG>(-Elbow::Down.sign(), z, x, found),
                }
                blank_from = span.end;
            }
            row[blank_from..].fill(f64::NAN);
        }
    }
}

impl Seen {
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]
    #[inline(always)]
    fn squared(self) -> Self {
        let Self { along, mixed, across } = self;
        Self {
            along: along * along + mixed * mixed,
            mixed: mixed * (along + across),
            across: across * across + mixed * mixed,
        }
    }
}
