//! One move of the tool in the part frame: where from, where to, along which line or arc.

use std::f64::consts::TAU;

use nalgebra::Vector3;

/// The tool at one place, part frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolPose {
    /// The tip, m.
    pub tip: Vector3<f64>,
    /// Unit vector from the tip into the spindle.
    pub axis: Vector3<f64>,
}

/// How fast, and whether the file says that the tool cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MoveKind {
    /// As fast as the machine can, through the air.
    Rapid,
    /// At a feed rate.
    Feed,
}

/// The shape of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Course {
    /// A straight line.
    Line,
    /// An arc or a helix.
    Arc(Arc),
}

/// An arc from the beginning of its move: turned to the right (counter-clockwise) about `normal` where that points at the eye, and
/// along it where its ends differ in height. Where the radii at the two ends differ, as rounded files have it, the radius changes evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// A point of its axis, m.
    pub centre: Vector3<f64>,
    /// Unit vector.
    pub normal: Vector3<f64>,
    /// How far it turns, rad, positive; more than a turn for a helix of several.
    pub angle: f64,
}

/// What a file says about one move besides where it goes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Given {
    /// Axial depth of cut, m.
    pub axial_depth: Option<f64>,
    /// Radial width of cut, m.
    pub radial_width: Option<f64>,
    /// Force on the tool, N, part axes.
    pub force: Option<Vector3<f64>>,
    /// The number of the tool in the spindle.
    pub tool: Option<u32>,
    /// How fast the spindle turns, rad/s.
    pub spindle: Option<f64>,
    /// The spindle turns clockwise, seen from the spindle to the tip.
    pub is_clockwise: Option<bool>,
}

impl Given {
    /// What a program says of every move: the tool, turns of the spindle a minute, and which way it turns.
    pub(super) fn under(tool: Option<u32>, turns: Option<f64>, is_clockwise: Option<bool>) -> Self {
        Self { tool, spindle: turns.map(|turns| turns * TAU / 60.0), is_clockwise, ..Self::default() }
    }
}

/// One move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// The line of the file that asks for it, from 1; 0 where there is no file.
    pub line: usize,
    /// Rapid or at a feed rate.
    pub kind: MoveKind,
    /// Where it begins.
    pub from: ToolPose,
    /// Where it ends.
    pub to: ToolPose,
    /// Along what.
    pub course: Course,
    /// Feed rate, m/s; `None` of a rapid, and where the file says none.
    pub feed: Option<f64>,
    /// Outward normal of the surface where it begins and where it ends, unit vectors, where the file says them.
    pub normals: Option<[Vector3<f64>; 2]>,
    /// What else the file says.
    pub given: Given,
}

/// Two axes across the normal of an arc and what changes along it: `p(t) = c + rho(t) (u cos(a t) + v sin(a t)) + h(t) n`.
#[derive(Clone, Copy, Debug)]
struct Turning {
    centre: Vector3<f64>,
    u: Vector3<f64>,
    v: Vector3<f64>,
    normal: Vector3<f64>,
    angle: f64,
    radius: [f64; 2],
    rise: f64,
}

impl Turning {
    fn of(arc: &Arc, from: &Vector3<f64>, to: &Vector3<f64>) -> Self {
        let height = |p: &Vector3<f64>| (p - arc.centre).dot(&arc.normal);
        let (h0, h1) = (height(from), height(to));
        let centre = arc.centre + h0 * arc.normal;
        let (start, end) = (from - centre, to - centre - (h1 - h0) * arc.normal);
        let u = start.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        let v = arc.normal.cross(&u);
        let radius = [start.norm(), end.norm()];
        Self { centre, u, v, normal: arc.normal, angle: arc.angle, radius, rise: h1 - h0 }
    }

    fn radius_at(&self, t: f64) -> f64 {
        self.radius[0] + (self.radius[1] - self.radius[0]) * t
    }

    fn at(&self, t: f64) -> Vector3<f64> {
        let (s, c) = (self.angle * t).sin_cos();
        self.centre + self.radius_at(t) * (self.u * c + self.v * s) + self.rise * t * self.normal
    }

    fn velocity(&self, t: f64) -> Vector3<f64> {
        let (s, c) = (self.angle * t).sin_cos();
        let across = self.radius_at(t) * self.angle * (self.v * c - self.u * s);
        across + (self.radius[1] - self.radius[0]) * (self.u * c + self.v * s) + self.rise * self.normal
    }

    /// Exact for a helix; where the radius changes by what rounding makes of it, to the second order of that.
    fn length(&self) -> f64 {
        let around = 0.5 * (self.radius[0] + self.radius[1]) * self.angle;
        around.hypot(self.rise).hypot(self.radius[1] - self.radius[0])
    }

    /// Where a coordinate may be extreme between the ends, `0 < t < 1`: `A cos(a t - phi) + rise n_e t` has the derivative
    /// zero. Of many turns the first and the last two are enough, since the rise goes one way.
    fn extremes(&self, coordinate: usize) -> impl Iterator<Item = f64> {
        let (x, y) = (self.u[coordinate], self.v[coordinate]);
        let amplitude = self.radius_at(0.5) * x.hypot(y) * self.angle;
        let phi = y.atan2(x);
        let slope = (self.rise * self.normal[coordinate] / amplitude).clamp(-1.0, 1.0);
        let lean = if slope.is_finite() { slope.asin() } else { 0.0 };
        let angle = self.angle;
        let turns = (angle / TAU).floor();
        let first = [phi + lean, phi + std::f64::consts::PI - lean];
        let whole = [0.0, 1.0, turns - 1.0, turns];
        first
            .into_iter()
            .flat_map(move |at| {
                let base = at.rem_euclid(TAU);
                whole.map(|k| (base + k.max(0.0) * TAU) / angle)
            })
            .filter(|t| 0.0 < *t && *t < 1.0)
    }
}

impl Move {
    fn turning(&self) -> Option<Turning> {
        match &self.course {
            Course::Line => None,
            Course::Arc(arc) => Some(Turning::of(arc, &self.from.tip, &self.to.tip)),
        }
    }

    /// How long the way of the tip is, m.
    pub fn length(&self) -> f64 {
        self.turning().map_or_else(|| (self.to.tip - self.from.tip).norm(), |turning| turning.length())
    }

    /// The tip at a share `0..=1` of the way, m.
    pub fn tip(&self, t: f64) -> Vector3<f64> {
        match self.turning() {
            _ if t <= 0.0 => self.from.tip,
            _ if 1.0 <= t => self.to.tip,
            None => self.from.tip + t * (self.to.tip - self.from.tip),
            Some(turning) => turning.at(t),
        }
    }

    /// The direction of the motion at a share of the way; `None` where the tip does not move.
    pub fn direction(&self, t: f64) -> Option<Vector3<f64>> {
        let along = self.turning().map_or_else(|| self.to.tip - self.from.tip, |turning| turning.velocity(t));
        along.try_normalize(1e-12)
    }

    /// The tool axis at a share of the way: it turns evenly in the plane of both ends.
    pub fn axis(&self, t: f64) -> Vector3<f64> {
        between(&self.from.axis, &self.to.axis, t)
    }

    /// The outward normal of the surface at a share of the way: it turns evenly in the plane of both ends; `None` where the file says none.
    pub fn normal(&self, t: f64) -> Option<Vector3<f64>> {
        self.normals.map(|[from, to]| between(&from, &to, t))
    }

    /// By how much the tool axis turns, rad.
    pub fn turn_of_axis(&self) -> f64 {
        turn(&self.from.axis, &self.to.axis)
    }

    /// How far a chord over a share `dt` of the way is off the move at most, m: the sagitta of an arc, 0 of a line.
    pub fn chord_error(&self, dt: f64) -> f64 {
        self.turning().map_or(0.0, |turning| {
            let half = (0.5 * turning.angle * dt).min(std::f64::consts::PI);
            turning.radius[0].max(turning.radius[1]) * (1.0 - half.cos())
        })
    }

    /// The larger radius of an arc, m, and its angle, rad; nothing of a line.
    pub(super) fn radius_and_angle(&self) -> (f64, f64) {
        self.turning().map_or((0.0, 0.0), |turning| (turning.radius[0].max(turning.radius[1]), turning.angle))
    }

    /// The points that bound the move, as shares of the way besides its ends.
    pub(super) fn extremes(&self) -> Vec<f64> {
        let Some(turning) = self.turning() else { return Vec::new() };
        (0..3).flat_map(|coordinate| turning.extremes(coordinate)).collect()
    }
}

/// From one unit vector to another, rad.
fn turn(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

/// The unit vector at a share of the even turn from one to another. Opposite ones have no plane: then the first up to the middle, the second
/// beyond. (Such tool axes are refused where paths are read.)
fn between(a: &Vector3<f64>, b: &Vector3<f64>, t: f64) -> Vector3<f64> {
    let turn = turn(a, b);
    if turn < 1e-12 {
        return *a;
    }
    let (s, rest) = ((turn * t).sin(), (turn * (1.0 - t)).sin());
    ((rest * a + s * b) / turn.sin()).try_normalize(1e-3).unwrap_or(if t < 0.5 { *a } else { *b })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn arc(from: [f64; 3], to: [f64; 3], normal: [f64; 3], angle: f64) -> Move {
        let pose = |tip: [f64; 3]| ToolPose { tip: tip.into(), axis: Vector3::z() };
        let arc = Arc { centre: Vector3::zeros(), normal: normal.into(), angle };
        let (from, to) = (pose(from), pose(to));
        Move {
            line: 1,
            kind: MoveKind::Feed,
            from,
            to,
            course: Course::Arc(arc),
            feed: Some(0.1),
            normals: None,
            given: Given::default(),
        }
    }

    #[test]
    fn a_quarter_and_a_helix_are_as_long_as_by_hand() {
        let quarter = arc([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], FRAC_PI_2);
        assert!((quarter.length() - FRAC_PI_2).abs() < 1e-15);
        assert!((quarter.tip(0.5) - Vector3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0)).norm() < 1e-15);
        assert!((quarter.direction(0.0).unwrap() - Vector3::y()).norm() < 1e-15);
        // Three turns of 2 pi and a rise of 4: a hypotenuse.
        let helix = arc([1.0, 0.0, 0.0], [1.0, 0.0, 4.0], [0.0, 0.0, 1.0], 6.0 * PI);
        assert!((helix.length() - (6.0 * PI).hypot(4.0)).abs() < 1e-12);
        assert!((helix.tip(0.5) - Vector3::new(-1.0, 0.0, 2.0)).norm() < 1e-12);
    }

    /// The length and the box of a tilted helix against its own polyline.
    #[test]
    fn length_and_extremes_hold_against_ten_thousand_chords() {
        let n = Vector3::new(0.3, -0.5, 0.8).normalize();
        let u = n.cross(&Vector3::x()).normalize();
        let from = 0.2 * u;
        for (angle, rise) in [(1.0, 0.0), (4.0, 0.05), (9.0, -0.3), (30.0, 2.0), (30.0, 0.02)] {
            let (s, c) = f64::sin_cos(angle);
            let to = 0.2 * (u * c + n.cross(&u) * s) + rise * n;
            let helix = arc(from.into(), to.into(), n.into(), angle);
            let points: Vec<Vector3<f64>> = (0..=10_000).map(|i| helix.tip(f64::from(i) / 1e4)).collect();
            let polyline: f64 = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
            assert!((polyline / helix.length() - 1.0).abs() < 2e-6, "{angle}: {polyline} {}", helix.length());
            let mut ends = [helix.from.tip, helix.to.tip].to_vec();
            ends.extend(helix.extremes().into_iter().map(|t| helix.tip(t)));
            for e in 0..3 {
                let most = |of: &[Vector3<f64>]| of.iter().map(|p| p[e]).fold(f64::MIN, f64::max);
                let least = |of: &[Vector3<f64>]| of.iter().map(|p| p[e]).fold(f64::MAX, f64::min);
                assert!((most(&ends) - most(&points)).abs() < 2e-6, "{angle} {e}");
                assert!((least(&ends) - least(&points)).abs() < 2e-6, "{angle} {e}");
            }
        }
    }

    #[test]
    fn the_axis_turns_evenly() {
        let mut tilting = arc([1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], PI);
        tilting.to.axis = Vector3::x();
        let third = tilting.axis(1.0 / 3.0);
        assert!((third - Vector3::new((PI / 6.0).sin(), 0.0, (PI / 6.0).cos())).norm() < 1e-15);
    }
}
