//! How well do readings fit an arm that counts its joints in one way, wherever base and tool of the controller are?

use nalgebra::{Point3, Vector3};

use super::{Convention, VerifyOptions};
use crate::angle::wrapped;
use crate::catalogue::readings::Readings;
use crate::geometry::Geometry;
use crate::registration::{Problem, Sight, State};
use crate::spatial::Pose;

/// rad: a turn of 0.02 deg counts as much as 0.05 mm.
const LEVER: f64 = AGREED / AGREED_TURN;
/// m: so far a position that the controller computes may be off and agrees.
pub(super) const AGREED: f64 = 0.05e-3;
/// rad: the same of its orientation, 0.02 deg.
pub(super) const AGREED_TURN: f64 = 0.02 * std::f64::consts::PI / 180.0;
/// m: so far measured points of an arm that nobody has calibrated are off, rms; other lengths are off by 10 mm and more.
pub(super) const AGREED_MEASURED: f64 = 3e-3;

/// What was read, with what is given of base and tool.
pub(super) struct Table<'a> {
    pub(super) sights: Vec<Sight>,
    pub(super) readings: &'a Readings,
    pub(super) options: &'a VerifyOptions,
}

/// An arm that counts in one way, against the readings.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// How it counts.
    pub convention: Convention,
    /// Root mean square of the distances, m.
    pub rms: f64,
    /// The largest distance, m.
    pub largest: f64,
    /// The largest turn between orientations, rad; `None` where none was read.
    pub largest_turn: Option<f64>,
    /// The distance of each row, m: the largest of its points.
    pub distances: Vec<f64>,
    /// The base of the robot file in the frame of the readings; one for each stand.
    pub bases: Vec<Pose>,
    /// The points that were looked at in the flange frame, m.
    pub points: Vec<Vector3<f64>>,
    /// The tool that the controller has in force, where it tells an orientation.
    pub tool: Option<Pose>,
    /// Measured points need not agree as closely as what the controller computes.
    is_measured: bool,
}

impl Fit {
    /// Does it agree as closely as readings of this kind must?
    pub fn agrees(&self) -> bool {
        if self.is_measured {
            return self.rms <= AGREED_MEASURED;
        }
        self.largest <= AGREED && self.largest_turn.is_none_or(|turn| turn <= AGREED_TURN)
    }

    /// How much must be assumed for it: what it changes of a file's way of counting, a zero that is half a turn off as much as two changes, a base
    /// that leans, a tool behind the wrist. Ways of counting that differ in these alone stand at the same places.
    pub(super) fn assumed(&self, geometry: &Geometry, file: &Convention) -> usize {
        /// Cosine of the lean of a base that stands on its floor.
        const UPRIGHT: f64 = 0.99;
        /// rad: nearer to half a turn than to a quarter.
        const HALF: f64 = 0.75 * std::f64::consts::PI;
        let zeros = self.convention.offset.iter().zip(&file.offset);
        let half_turns = zeros.filter(|(own, file)| HALF < wrapped(*own - *file).abs()).count();
        let leans = !self.is_measured && self.bases.iter().any(|base| (base.rotation * Vector3::z()).z < UPRIGHT);
        let is_behind = self.points.iter().any(|point| point.z < -geometry.c4);
        self.convention.differences(file).len() + half_turns + usize::from(leans) + usize::from(is_behind)
    }

    /// Where the flange is expected, seen from the first stand.
    pub(super) fn flange(&self, geometry: &Geometry, q: &[f64; 6]) -> Pose {
        self.bases[0] * self.convention.chain(geometry, &[], &[], q).flange
    }

    /// How far what is read at these joints differs from what another fit expects there: the largest distance of a point, m, and the turn of
    /// the tool, rad, 0 where no orientation is read.
    pub(super) fn apart_from(&self, other: &Self, geometry: &Geometry, q: &[f64; 6]) -> (f64, f64) {
        let [a, b] = [self, other].map(|fit| fit.flange(geometry, q));
        let points = self.points.iter().zip(&other.points);
        let distances = points.map(|(p, q)| (a * Point3::from(*p) - b * Point3::from(*q)).norm());
        let turn =
            self.tool.zip(other.tool).map_or(0.0, |(own, tool)| (a * own).rotation.angle_to(&(b * tool).rotation));
        (distances.fold(0.0, f64::max), turn)
    }
}

impl<'a> Table<'a> {
    /// Numbers that were read, less those that are fitted.
    pub(super) fn spare(&self) -> isize {
        let numbers =
            |sight: &Sight| 3 * (sight.points.iter().flatten().count() + usize::from(sight.orientation.is_some()));
        let read: usize = self.sights.iter().map(numbers).sum();
        let base = if self.options.base.is_some() { 0 } else { 6 * self.readings.stands.len() };
        let turn = if self.is_oriented() { 3 } else { 0 };
        let tool = if self.options.tool.is_some() { 0 } else { 3 * self.readings.points + turn };
        read as isize - (base + tool + self.free().len()) as isize
    }

    pub(super) fn len(&self) -> usize {
        self.sights.len()
    }

    /// The same with at most so many rows, evenly taken: as many as it takes to see which fits are bad.
    pub(super) fn thinned(&self, most: usize) -> Self {
        let count = self.sights.len().min(most);
        let sights = (0..count).map(|i| self.sights[i * self.sights.len() / count].clone()).collect();
        Self { sights, readings: self.readings, options: self.options }
    }

    pub(super) fn of(readings: &'a Readings, options: &'a VerifyOptions) -> Self {
        let sights = readings.rows.iter().map(|row| Sight {
            q: row.q,
            points: row.points.iter().map(|point| point.map(|at| (at, 1.0))).collect(),
            orientation: row.orientation,
            stand: row.stand,
        });
        Self { sights: sights.collect(), readings, options }
    }

    /// The joints whose zeros the readings can show: base and tool take up those of 1 and 6 where they are not given.
    pub(super) fn free(&self) -> Vec<usize> {
        let first = self.options.base.is_some().then_some(0);
        let last = (self.options.tool.is_some() && self.is_oriented()).then_some(5);
        first.into_iter().chain(1..5).chain(last).collect()
    }

    pub(super) fn is_oriented(&self) -> bool {
        self.sights.iter().any(|sight| sight.orientation.is_some())
    }

    /// The best base and tool, and the best angles added at the joints `free`.
    pub(super) fn fit(&self, geometry: &Geometry, convention: &Convention, free: &[usize]) -> Fit {
        /// m along the flange's axis: where the point may be at first.
        const STARTS: [f64; 2] = [0.0, 0.3];
        let chain = |added: &[f64], q: &[f64; 6]| convention.chain(geometry, free, added, q);
        let problem = self.problem(free.len(), &chain);
        let found = STARTS.map(|z| {
            let (state, rows) = problem.solved(problem.start(vec![0.0; free.len()], Vector3::z() * z));
            (problem.cost(&rows, &state), state)
        });
        let [first, second] = found;
        let (_, state) = if second.0 < first.0 { second } else { first };
        let convention = convention.added(free, &state.parameters);
        self.fit_of(&convention, geometry, &state)
    }

    /// How far a convention is off with the base and the tool that the means give; a first glance.
    pub(super) fn glance(&self, geometry: &Geometry, convention: &Convention) -> f64 {
        /// Each of which brings the point nearer.
        const ROUNDS: usize = 3;
        let chain = |added: &[f64], q: &[f64; 6]| convention.chain(geometry, &[], added, q);
        let problem = self.problem(0, &chain);
        let mut state = problem.start(Vec::new(), Vector3::zeros());
        for _ in 0..ROUNDS {
            state = problem.start(Vec::new(), state.points[0]);
        }
        problem.cost(&problem.linear(&state), &state)
    }

    fn problem<'p>(
        &'p self,
        free: usize,
        chain: &'p (dyn Fn(&[f64], &[f64; 6]) -> crate::chain::Chain + Sync),
    ) -> Problem<'p> {
        Problem {
            sights: &self.sights,
            stands: self.readings.stands.len(),
            points: self.readings.points,
            lever: LEVER,
            base: self.options.base,
            tool: self.options.tool,
            precision: vec![0.0; free],
            common: 0.0,
            chain,
        }
    }

    fn fit_of(&self, convention: &Convention, geometry: &Geometry, state: &State) -> Fit {
        let (mut sum, mut count, mut turn) = (0.0, 0, None::<f64>);
        let distances: Vec<f64> = (self.sights.iter())
            .map(|sight| {
                let frame = state.bases[sight.stand] * convention.chain(geometry, &[], &[], &sight.q).flange;
                if let Some(orientation) = sight.orientation {
                    let angle = (frame.rotation * state.turn).angle_to(&orientation);
                    turn = Some(turn.map_or(angle, |largest| largest.max(angle)));
                }
                let seen = sight
                    .points
                    .iter()
                    .zip(&state.points)
                    .filter_map(|(seen, point)| Some(((*seen)?.0 - (frame * Point3::from(*point)).coords).norm()));
                seen.fold(0.0, |largest: f64, distance| {
                    sum += distance * distance;
                    count += 1;
                    largest.max(distance)
                })
            })
            .collect();
        let tool = self.is_oriented().then(|| Pose::from_parts(state.points[0].into(), state.turn));
        Fit {
            convention: convention.clone(),
            rms: (sum / f64::from(count.max(1))).sqrt(),
            largest: distances.iter().copied().fold(0.0, f64::max),
            largest_turn: turn,
            distances,
            bases: state.bases.clone(),
            points: state.points.clone(),
            tool,
            is_measured: self.readings.is_measured,
        }
    }
}
