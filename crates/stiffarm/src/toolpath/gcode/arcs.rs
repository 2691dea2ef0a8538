//! Which arc do the words of a block mean?

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::super::closing::Closing;
use super::super::fault::Wrong;
use super::super::moves::Arc;
use super::super::options::ArcCentres;

/// Centres that are no farther apart, m, are one: what rounding to 0.01 mm makes of them.
const ONE_CENTRE: f64 = 2e-5;

/// Ends that are no farther apart, m, are one: a full circle.
const SAME: f64 = 1e-10;

/// The plane of arcs and cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Plane {
    Xy,
    Zx,
    Yz,
}

impl Plane {
    /// First and second axis of the plane, and its normal: right-handed.
    pub(super) const fn axes(self) -> [usize; 3] {
        match self {
            Self::Xy => [0, 1, 2],
            Self::Zx => [2, 0, 1],
            Self::Yz => [1, 2, 0],
        }
    }

    pub(super) const fn code(self) -> &'static str {
        match self {
            Self::Xy => "G17",
            Self::Zx => "G18",
            Self::Yz => "G19",
        }
    }

    pub(super) fn normal(self) -> Vector3<f64> {
        let mut normal = Vector3::zeros();
        normal[self.axes()[2]] = 1.0;
        normal
    }
}

/// What a block says of an arc, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    pub(super) from: Vector3<f64>,
    pub(super) to: Vector3<f64>,
    pub(super) plane: Plane,
    pub(super) is_clockwise: bool,
    /// I, J, K where there are some.
    pub(super) offsets: [Option<f64>; 3],
    pub(super) radius: Option<f64>,
    /// Turns begun: 1 for less than a whole one.
    pub(super) turns: f64,
    /// The origin from which absolute centres count.
    pub(super) origin: [f64; 3],
    /// By how much its ends may miss one radius.
    pub(super) closing: Closing,
}

/// Which reading of I, J and K is in force, and who says so.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reading {
    /// Said by a code or by the user.
    pub(super) said: Option<ArcCentres>,
    /// Found by an arc that closes in one reading only, and in which line.
    pub(super) found: Option<(ArcCentres, usize)>,
    /// The first arc that closes in both and was read as incremental.
    pub(super) doubtful: Option<usize>,
    /// By how much the worst arc does not close, m.
    pub(super) worst: f64,
}

impl Asked {
    fn radii(&self, centre: &Vector3<f64>) -> [f64; 2] {
        let [a, b, _] = self.plane.axes();
        [self.from, self.to].map(|p| (p[a] - centre[a]).hypot(p[b] - centre[b]))
    }

    fn centre(&self, reading: ArcCentres) -> Vector3<f64> {
        let mut centre = self.from;
        for axis in &self.plane.axes()[..2] {
            let offset = self.offsets[*axis];
            centre[*axis] = match reading {
                ArcCentres::Incremental => self.from[*axis] + offset.unwrap_or(0.0),
                // What is not given stays as it is.
                ArcCentres::Absolute => offset.map_or(self.from[*axis], |at| at + self.origin[*axis]),
            };
        }
        centre
    }

    fn is_closed(&self) -> bool {
        let [a, b, _] = self.plane.axes();
        (self.to[a] - self.from[a]).hypot(self.to[b] - self.from[b]) <= SAME
    }

    /// The arc about a centre.
    fn about(&self, centre: Vector3<f64>) -> Arc {
        let [a, b, _] = self.plane.axes();
        let angle = |p: &Vector3<f64>| (p[b] - centre[b]).atan2(p[a] - centre[a]);
        let ahead = angle(&self.to) - angle(&self.from);
        let turned = if self.is_clockwise { -ahead } else { ahead }.rem_euclid(TAU);
        let first = if self.is_closed() { TAU } else { turned };
        let sense = if self.is_clockwise { -1.0 } else { 1.0 };
        Arc { centre, normal: sense * self.plane.normal(), angle: first + TAU * (self.turns - 1.0) }
    }

    /// The arc that is meant.
    ///
    /// # Errors
    /// Where it does not close, or no one can know which is meant.
    pub(super) fn arc(&self, reading: &mut Reading, line: usize) -> Result<Arc, Wrong> {
        let word = if self.is_clockwise { "G2" } else { "G3" };
        let [a, b, n] = self.plane.axes();
        let letters = ["I", "J", "K"];
        if self.offsets[n].is_some_and(|offset| offset != 0.0) {
            let why = format!("{} lies across the plane of the arc, {}", letters[n], self.plane.code());
            return Err(Wrong::new(word, why));
        }
        let has_centre = self.offsets[a].is_some() || self.offsets[b].is_some();
        match (self.radius, has_centre) {
            (Some(_), true) => Err(Wrong::new(word, "both R and a centre are given; expected one of them")),
            (Some(radius), false) => self.by_radius(radius, word),
            (None, false) => {
                let why = format!("the arc has no centre; expected {} or {}, or R", letters[a], letters[b]);
                Err(Wrong::new(word, why))
            }
            (None, true) => self.by_centre(reading, line, word),
        }
    }

    fn by_radius(&self, radius: f64, word: &str) -> Result<Arc, Wrong> {
        let [a, b, _] = self.plane.axes();
        if self.is_closed() {
            return Err(Wrong::new(word, "R cannot say a full circle: the centre may lie anywhere; expected I J K"));
        }
        let (x, y) = (self.to[a] - self.from[a], self.to[b] - self.from[b]);
        let half = 0.5 * x.hypot(y);
        let height = radius.abs().powi(2) - half * half;
        if !self.closing.holds(half - radius.abs(), half) {
            let (r, needed) = (radius.abs() * 1e3, half * 1e3);
            return Err(Wrong::new(
                word,
                format!("R of {r:.4} mm is too small for its ends; expected at least {needed:.4} mm"),
            ));
        }
        // The centre lies left of the way for a short arc counter-clockwise and for a long one clockwise.
        let is_left = self.is_clockwise == (radius < 0.0);
        let aside = height.max(0.0).sqrt() * if is_left { 1.0 } else { -1.0 };
        let mut centre = self.from;
        centre[a] = self.from[a] + 0.5 * x - aside * y / (2.0 * half);
        centre[b] = self.from[b] + 0.5 * y + aside * x / (2.0 * half);
        Ok(self.about(centre))
    }

    fn by_centre(&self, reading: &mut Reading, line: usize, word: &str) -> Result<Arc, Wrong> {
        let miss = |centre: &Vector3<f64>| {
            let [start, end] = self.radii(centre);
            // A centre on the path is none.
            if start.min(end) <= SAME { f64::INFINITY } else { (start - end).abs() }
        };
        let both = [ArcCentres::Incremental, ArcCentres::Absolute].map(|how| (how, self.centre(how)));
        let misses = both.map(|(_, centre)| miss(&centre));
        let of = |how: ArcCentres| usize::from(how == ArcCentres::Absolute);
        let holds = |how: ArcCentres| {
            let [start, end] = self.radii(&both[of(how)].1);
            self.closing.holds(misses[of(how)], start.max(end))
        };
        let radii = |how: ArcCentres| {
            let radii = self.radii(&both[of(how)].1);
            format!("{:.4} mm at its beginning and {:.4} mm at its end", radii[0] * 1e3, radii[1] * 1e3)
        };
        let how = if let Some(said) = reading.said {
            said
        } else {
            // What closes to a hair in one reading is meant, whatever a large radius lets pass in the other.
            let tight = misses.map(|miss| self.closing.is_tight(miss));
            let closes = if tight == [false; 2] { both.map(|(how, _)| holds(how)) } else { tight };
            let differ = ONE_CENTRE < (both[0].1 - both[1].1).norm();
            match closes {
                // On a short arc a wrong centre closes, too: it says nothing.
                [true, true] => {
                    let usual = reading.found.map_or(ArcCentres::Incremental, |(found, _)| found);
                    if differ && reading.found.is_none() {
                        reading.doubtful.get_or_insert(line);
                    }
                    usual
                }
                [true, false] | [false, true] => {
                    let how = if closes[0] { ArcCentres::Incremental } else { ArcCentres::Absolute };
                    Self::settle(reading, how, line, word)?;
                    how
                }
                [false, false] => {
                    let (from, origin) = (radii(ArcCentres::Incremental), radii(ArcCentres::Absolute));
                    let why = format!(
                        "the arc does not close: its radius is {from} where the centre counts from the beginning, and {origin} where it counts from the origin"
                    );
                    return Err(Wrong::new(word, why));
                }
            }
        };
        let miss = misses[of(how)];
        if !holds(how) {
            return Err(Wrong::new(word, format!("the arc does not close: its radius is {}", radii(how))));
        }
        reading.worst = reading.worst.max(miss);
        Ok(self.about(both[of(how)].1))
    }

    /// An arc has said what the centres of all count from.
    fn settle(reading: &mut Reading, how: ArcCentres, line: usize, word: &str) -> Result<(), Wrong> {
        let name = |how| if how == ArcCentres::Absolute { "the origin" } else { "the beginning of the arc" };
        match reading.found {
            Some((found, first)) if found != how => {
                let (here, there) = (name(how), name(found));
                Err(Wrong::new(word, format!("its centre counts from {here}, that of line {first} from {there}")))
            }
            Some(_) => Ok(()),
            None => {
                if let Some(doubtful) = reading.doubtful.filter(|_| how == ArcCentres::Absolute) {
                    let why = format!(
                        "its centre counts from the origin, and the arc of line {doubtful} closes either way; say arc-centres absolute or incremental"
                    );
                    return Err(Wrong::new(word, why));
                }
                reading.found = Some((how, line));
                Ok(())
            }
        }
    }
}
