//! Which few capsules enclose a link? Found from the triangles of its mesh, with the least volume that a search finds.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

use self::axis::{Axis, Seen};
use crate::body::Capsule;

mod axis;

type Vec3 = Vector3<f64>;
/// Its corners, m.
pub(super) type Triangle = [Vec3; 3];

/// Of the largest extent: no edge of a piece of a triangle is longer, and patches of the surface are as wide.
const FINENESS: f64 = 1.0 / 30.0;
/// One more capsule must save this part of the volume.
const LEAST_GAIN: f64 = 0.04;
/// Each axis is cut at so many places.
const CUTS: usize = 7;
/// So many of the best cuts are followed up.
const FOLLOWED: usize = 12;
/// Every capsule is fitted again so often.
const ROUNDS: usize = 4;
/// A capsule that falls by less is no better.
const LEAST_FALL: f64 = 1e-3;
/// So often a capsule is found again with the points that were left out.
const MENDED: usize = 3;
/// About every capsule that is compared, of the largest extent: on a line all of them would have no volume.
const SKIN: f64 = 1e-6;
/// Cells of a grid about a union, along each side.
const CELLS: usize = 20;
/// Steps of a search that only compares, and of one that is kept.
const FEW_STEPS: usize = 60;
const STEPS: usize = 160;
/// The first step, of the largest extent; and what each next step is of it.
const FIRST_STEP: f64 = 0.1;
const FEW_SHRINK: f64 = 0.90;
const SHRINK: f64 = 0.965;
/// Rounding, of the largest coordinate.
const ROUNDING: f64 = 1e-12;

/// At most `most` capsules, at least one where there is a triangle: every triangle lies in their union.
///
/// The same triangles give the same bytes on every machine: only sums, products, quotients and roots are taken.
pub(super) fn cover(triangles: &[Triangle], most: usize) -> Vec<Capsule> {
    let points: Vec<Vec3> = triangles.iter().flatten().copied().collect();
    let Some(first) = points.first() else { return Vec::new() };
    let size = extent(&points);
    let pieces = pieces(triangles, size * FINENESS);
    let search = Search { patches: patches(&pieces, first, size * FINENESS), size };
    let mut lines = vec![search.fit(&search.patches.iter().collect::<Vec<_>>(), None)];
    let (mut found, mut least) = (lines.clone(), volume(&lines));
    // The first cut may save nothing and the second one much.
    for _ in 1..most {
        let Some(more) = search.split(&lines) else { break };
        lines = more;
        let price = volume(&lines) * (1.0 + LEAST_GAIN * (lines.len() - 1) as f64);
        if price < least {
            (found, least) = (lines.clone(), price);
        }
    }
    let largest = points.iter().map(Vec3::amax).fold(0.0, f64::max);
    grown(found, &pieces, largest * ROUNDING)
}

/// Of the box about the points.
fn corners(points: &[Vec3]) -> (Vec3, Vec3) {
    let first = points.first().copied().unwrap_or_default();
    points.iter().fold((first, first), |(low, high), point| (low.inf(point), high.sup(point)))
}

fn middle(points: &[Vec3]) -> Vec3 {
    points.iter().sum::<Vec3>() / points.len().max(1) as f64
}

fn extent(points: &[Vec3]) -> f64 {
    let (low, high) = corners(points);
    (high - low).max()
}

/// The triangles, halved at their longest edges until none is longer than this.
fn pieces(triangles: &[Triangle], longest: f64) -> Vec<Triangle> {
    let (mut small, mut large) = (Vec::new(), triangles.to_vec());
    while let Some([a, b, c]) = large.pop() {
        let length = |[from, to, _]: &Triangle| (to - from).norm_squared();
        let turned = [[b, c, a], [c, a, b]].into_iter();
        let [from, to, tip] = turned.fold([a, b, c], |x, y| if length(&x) < length(&y) { y } else { x });
        let middle = (from + to) / 2.0;
        // Between neighbouring numbers there is no middle.
        if longest * longest < length(&[from, to, tip]) && middle != from && middle != to {
            large.extend([[from, middle, tip], [middle, to, tip]]);
        } else {
            small.push([a, b, c]);
        }
    }
    small
}

/// Many, all around.
fn directions() -> impl Iterator<Item = Vec3> {
    let grid = (0..125).map(|i| Vec3::new(f64::from(i % 5 - 2), f64::from(i / 5 % 5 - 2), f64::from(i / 25 - 2)));
    grid.filter(|direction| direction.amax() == 2.0)
}

/// Points of the surface that lie in one capsule as a whole.
struct Patch {
    points: Vec<Vec3>,
    middle: Vec3,
    /// In each of the directions: how far the points reach, and which of them does.
    farthest: Vec<(f64, usize)>,
}

impl Patch {
    fn new(points: Vec<Vec3>) -> Self {
        let farthest = directions().map(|direction| {
            let along = points.iter().map(|point| point.dot(&direction)).zip(0..);
            along.fold((f64::NEG_INFINITY, 0), |most, next| if most.0 < next.0 { next } else { most })
        });
        Self { middle: middle(&points), farthest: farthest.collect(), points }
    }

    fn is_in(&self, capsule: &Capsule) -> bool {
        let axis = Axis::of(capsule);
        self.points.iter().all(|point| axis.away(point).norm() <= capsule.radius)
    }
}

/// One for the pieces whose middles lie in one cell of a grid, of the outermost of their corners.
fn patches(pieces: &[Triangle], origin: &Vec3, width: f64) -> Vec<Patch> {
    let mut cells: BTreeMap<[i64; 3], Vec<Vec3>> = BTreeMap::new();
    for piece in pieces {
        let middle = middle(piece) - origin;
        let cell = middle.map(|x| if 0.0 < width { (x / width).floor() as i64 } else { 0 });
        cells.entry(cell.into()).or_default().extend(piece);
    }
    cells.into_values().map(|corners| Patch::new(outermost(&[&Patch::new(corners)]))).collect()
}

/// In each of the directions: how far some patches reach, and which point of which patch does.
#[derive(Clone)]
struct Farthest(Vec<(f64, (usize, usize))>);

impl Farthest {
    /// Of the patches in `range`, which are numbered as all of them are.
    fn of(patches: &[&Patch], range: Range<usize>) -> Self {
        let mut most = vec![(f64::NEG_INFINITY, (0, 0)); directions().count()];
        for at in range {
            for (most, (along, point)) in most.iter_mut().zip(&patches[at].farthest) {
                if most.0 < *along {
                    *most = (*along, (at, *point));
                }
            }
        }
        Self(most)
    }

    fn with(mut self, later: &Self) -> Self {
        for (most, next) in self.0.iter_mut().zip(&later.0) {
            if most.0 < next.0 {
                *most = *next;
            }
        }
        self
    }

    /// Each once.
    fn points(self, patches: &[&Patch]) -> Vec<Vec3> {
        let mut kept: Vec<(usize, usize)> = self.0.into_iter().map(|(_, at)| at).collect();
        kept.sort_unstable();
        kept.dedup();
        kept.into_iter().filter_map(|(at, point)| patches.get(at)?.points.get(point).copied()).collect()
    }
}

/// The points that are farthest in one of the directions.
fn outermost(patches: &[&Patch]) -> Vec<Vec3> {
    Farthest::of(patches, 0..patches.len()).points(patches)
}

/// Of all patches.
fn points(patches: &[&Patch]) -> Vec<Vec3> {
    patches.iter().flat_map(|patch| &patch.points).copied().collect()
}

/// Those of the frame, and before them the one along which the points spread most.
fn axes(points: &[Vec3]) -> [Vec3; 4] {
    let middle = middle(points);
    let mut spread: Matrix3<f64> = points.iter().map(|point| (point - middle) * (point - middle).transpose()).sum();
    // Its square, again and again, leaves the largest of its axes.
    for _ in 0..12 {
        spread *= spread / (spread.norm_squared().sqrt() + f64::MIN_POSITIVE);
    }
    let columns = (0..3).map(|i| spread.column(i).into_owned());
    let longest = columns.fold(Vec3::zeros(), |x, y| if x.norm_squared() < y.norm_squared() { y } else { x });
    [longest.try_normalize(0.0).unwrap_or(Vec3::x()), Vec3::x(), Vec3::y(), Vec3::z()]
}

/// For capsules about patches.
struct Search {
    patches: Vec<Patch>,
    /// The largest extent.
    size: f64,
}

impl Search {
    /// The volume, with a skin.
    fn cost(&self, line: &Capsule) -> f64 {
        let radius = line.radius + self.size * SKIN;
        PI * radius * radius * ((line.ends[1] - line.ends[0]).norm() + radius * 4.0 / 3.0)
    }

    /// The capsule with the least cost about the patches that is found from a line and from the axes.
    fn fit(&self, patches: &[&Patch], from: Option<Capsule>) -> Capsule {
        let (points, mut near) = (points(patches), outermost(patches));
        let starts = axes(&near).map(|axis| Capsule::along(&axis, &near)).into_iter().chain(from);
        let tried = starts.map(|start| self.descend(start, &near, (STEPS, SHRINK)));
        let least = tried.min_by(|x, y| self.cost(x).total_cmp(&self.cost(y)));
        let mut best = least.unwrap_or(Capsule { ends: [Vec3::zeros(); 2], radius: 0.0 });
        for _ in 0..MENDED {
            let axis = Axis::of(&best);
            let is_out = |point: &&Vec3| best.radius < axis.away(point).norm();
            let out: Vec<Vec3> = points.iter().filter(is_out).copied().collect();
            if out.is_empty() {
                break;
            }
            near.extend(outermost(&[&Patch::new(out)]));
            best = self.descend(Capsule::about(best.ends, &near), &near, (STEPS, SHRINK));
        }
        Capsule::about(best.ends, &points)
    }

    /// One to compare, about patches of which `near` are the outermost points.
    fn sketch(&self, patches: &[&Patch], near: &[Vec3]) -> Capsule {
        let start = Capsule::along(&axes(near)[0], near);
        let best = self.descend(start, near, (FEW_STEPS, FEW_SHRINK));
        let axis = Axis::of(&best);
        let reaches = patches.iter().map(|patch| axis.reach(&patch.points));
        Capsule { radius: reaches.fold(0.0, f64::max), ..best }
    }

    /// Downhill in ever smaller steps: the ends follow the points that are farthest, and each other.
    fn descend(&self, start: Capsule, points: &[Vec3], (steps, shrink): (usize, f64)) -> Capsule {
        let mut step = extent(points) * FIRST_STEP;
        let (mut line, mut best) = (start, start);
        let mut seen = Vec::with_capacity(points.len());
        Axis::of(&line).see(points, &mut seen);
        for _ in 0..steps {
            let slopes = self.slopes(&line, &seen, step);
            let slope = (slopes[0].norm_squared() + slopes[1].norm_squared()).sqrt();
            if slope == 0.0 {
                break;
            }
            line.ends = [0, 1].map(|i| line.ends[i] - slopes[i] * (step / slope));
            line.radius = Axis::of(&line).see(points, &mut seen);
            if self.cost(&line) < self.cost(&best) {
                best = line;
            }
            step *= shrink;
        }
        best
    }

    /// Of the cost by the ends, the points within `near` of the farthest all pulling.
    fn slopes(&self, line: &Capsule, seen: &[Seen], near: f64) -> [Vec3; 2] {
        let along = line.ends[1] - line.ends[0];
        let length = along.norm();
        let (mut pulls, mut weights) = ([Vec3::zeros(); 2], 0.0);
        let nearest = (line.radius - near).max(0.0);
        for point in seen.iter().filter(|point| nearest * nearest < point.square) {
            let distance = point.square.sqrt();
            let weight = distance - line.radius + near;
            let pull = point.away * (weight / distance);
            pulls[0] += pull * (1.0 - point.part);
            pulls[1] += pull * point.part;
            weights += weight;
        }
        let radius = line.radius + self.size * SKIN;
        let axis = along.try_normalize(0.0).unwrap_or_default() * (radius / 2.0);
        let pull = (length + 2.0 * radius) / f64::max(weights, f64::MIN_POSITIVE);
        [-pulls[0] * pull - axis, -pulls[1] * pull + axis]
    }

    /// The patches that no other capsule holds as a whole.
    fn left_to(&self, lines: &[Capsule], own: usize) -> Vec<&Patch> {
        let held = |patch: &&Patch| lines.iter().enumerate().any(|(i, line)| i != own && patch.is_in(line));
        self.patches.iter().filter(|patch| !held(patch)).collect()
    }

    /// With one capsule more, where a cut through one of them is best; `None` where nothing can be cut.
    fn split(&self, lines: &[Capsule]) -> Option<Vec<Capsule>> {
        let mut cuts = Vec::new();
        for own in 0..lines.len() {
            let mut patches = self.left_to(lines, own);
            for axis in axes(&points(&patches)) {
                patches.sort_by(|x, y| x.middle.dot(&axis).total_cmp(&y.middle.dot(&axis)));
                let cut = |i: usize| patches.len() * i / (CUTS + 1);
                let between: Vec<_> = (0..=CUTS).map(|i| Farthest::of(&patches, cut(i)..cut(i + 1))).collect();
                for i in 1..=CUTS {
                    let (low, high) = patches.split_at(cut(i));
                    if !low.is_empty() && !high.is_empty() {
                        let near = |parts: &[Farthest]| {
                            parts[1..].iter().fold(parts[0].clone(), Farthest::with).points(&patches)
                        };
                        let mut more = lines.to_vec();
                        more[own] = self.sketch(low, &near(&between[..i]));
                        more.push(self.sketch(high, &near(&between[i..])));
                        cuts.push((volume(&more), more));
                    }
                }
            }
        }
        cuts.sort_by(|x, y| x.0.total_cmp(&y.0));
        let followed = cuts.into_iter().take(FOLLOWED).map(|(_, more)| self.refined(more));
        let followed = followed.map(|lines| (volume(&lines), lines));
        followed.min_by(|x, y| x.0.total_cmp(&y.0)).map(|(_, lines)| lines)
    }

    /// Each fitted again to what the others leave to it, as long as that helps.
    fn refined(&self, mut lines: Vec<Capsule>) -> Vec<Capsule> {
        for _ in 0..ROUNDS {
            let mut has_fallen = false;
            for own in (0..lines.len()).rev() {
                let left = self.left_to(&lines, own);
                if left.is_empty() {
                    lines.remove(own);
                    continue;
                }
                let about = Capsule::about(lines[own].ends, &points(&left));
                let again = self.fit(&left, Some(about));
                has_fallen |= self.cost(&again) < (1.0 - LEAST_FALL) * self.cost(&lines[own]);
                if self.cost(&again) < self.cost(&lines[own]) {
                    lines[own] = again;
                }
            }
            if !has_fallen {
                break;
            }
        }
        lines
    }
}

/// The volume of the union, over a grid: cells that the surface passes through count in part.
fn volume(lines: &[Capsule]) -> f64 {
    let reach = |line: &Capsule| line.ends.map(|end| [-1.0, 1.0].map(|side| end.add_scalar(side * line.radius)));
    let (low, high) = corners(&lines.iter().flat_map(reach).flatten().collect::<Vec<Vec3>>());
    let cell = (high - low) / CELLS as f64;
    let width = cell.mean() + f64::MIN_POSITIVE;
    let axes: Vec<(Axis, f64)> = lines.iter().map(|line| (Axis::of(line), line.radius)).collect();
    let mut full = 0.0;
    for row in 0..CELLS * CELLS {
        let at = Vec3::new(0.0, (row % CELLS) as f64, (row / CELLS) as f64);
        let first = low + at.add_scalar(0.5).component_mul(&cell);
        let mut deepest = [-width; CELLS];
        for (axis, radius) in &axes {
            axis.deepen(&first, cell.x, *radius, &mut deepest);
        }
        full += deepest.iter().map(|deep| (0.5 + deep / width).clamp(0.0, 1.0)).sum::<f64>();
    }
    full * cell.product()
}

/// With radii so much larger that every piece lies in one of them, and by the rounding.
fn grown(mut lines: Vec<Capsule>, pieces: &[Triangle], rounding: f64) -> Vec<Capsule> {
    for piece in pieces {
        let needs = lines.iter_mut().map(|line| (Axis::of(line).reach(piece), line));
        let least = needs.min_by(|(x, of_x), (y, of_y)| (x - of_x.radius).total_cmp(&(y - of_y.radius)));
        if let Some((reach, line)) = least {
            line.radius = line.radius.max(reach);
        }
    }
    for line in &mut lines {
        line.radius += rounding;
    }
    lines
}

#[cfg(test)]
mod tests;
