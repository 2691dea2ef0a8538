//! A path made ready for milling: samples in the part frame, what pushes on the tool at each, and how long the way to the next takes.

use std::convert::Infallible;
use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};

use super::fault::MillError;
use crate::batch::Pushing;
use crate::cutting::Engagement;
use crate::load::Push;
use crate::toolpath::{Move, Sample, Steps, samples};

/// What of the displacement of the tip counts as error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ErrorPart {
    /// All of it: the one that cannot flatter.
    #[default]
    Total,
    /// Across the feed, at a right angle to the tool axis: the error of a contour that is milled with the side of the tool.
    Across,
    /// Along the tool axis: the error of depth.
    Axial,
    /// Along the outward normal of the surface, which the path must say: material left where it is positive.
    Normal,
}

impl ErrorPart {
    /// The direction that counts at a sample, in those axes in which the columns are the axes of its cut; `None` where all of the displacement
    /// does, and of a normal that the path does not say.
    pub(super) fn direction(self, axes: &Matrix3<f64>, sample: &Sample) -> Option<Vector3<f64>> {
        match self {
            Self::Total => None,
            Self::Across => Some(axes.column(1).into()),
            Self::Axial => Some(axes.column(2).into()),
            Self::Normal => sample.normal.map(|normal| axes * (cutting_axes(sample).transpose() * normal)),
        }
    }

    /// As it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Total => "total",
            Self::Across => "across",
            Self::Axial => "axial",
            Self::Normal => "normal",
        }
    }
}

/// What pushes on the tool, in the axes of the cut: feed, across (to its left, seen from the spindle), axial (away from the work).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Acting {
    /// So many N, in any direction.
    Any(f64),
    /// A force and a moment.
    Known {
        /// N.
        force: [f64; 3],
        /// N m about the axis away from the work.
        moment: f64,
    },
}

impl Acting {
    /// The size of the force, N.
    pub fn newtons(&self) -> f64 {
        match self {
            Self::Any(newtons) => *newtons,
            Self::Known { force, .. } => Vector3::from(*force).norm(),
        }
    }

    /// The force along the three axes, N; `None` where it may point anywhere.
    pub fn force(&self) -> Option<[f64; 3]> {
        if let Self::Known { force, .. } = self { Some(*force) } else { None }
    }

    /// With the axes of the cut as columns, in any axes. Where the force may point anywhere and only a part of the displacement counts,
    /// that part is as large as all that a force along it moves.
    pub(crate) fn pushing(&self, axes: &Matrix3<f64>, sample: &Sample, part: ErrorPart) -> Pushing {
        match (self, part.direction(axes, sample)) {
            (Self::Any(newtons), None) => Pushing::Any(*newtons),
            (Self::Any(newtons), Some(direction)) => {
                Pushing::Known(Push { force: direction * *newtons, moment: Vector3::zeros(), counted: None })
            }
            (Self::Known { force, moment }, counted) => {
                let moment = axes.column(2) * *moment;
                Pushing::Known(Push { force: axes * Vector3::from(*force), moment, counted })
            }
        }
    }
}

/// How a mill cuts.
#[derive(Clone, Debug, PartialEq)]
pub struct StationCut {
    /// Where its teeth are in the work.
    pub engagement: Engagement,
    /// By how much the force changes, along feed, across and axial, where the tool is moved across and axially, N/m.
    pub changes: [[f64; 3]; 2],
}

/// The tool at one place of its path.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Where.
    pub sample: Sample,
    /// What pushes; `None` in air.
    pub acting: Option<Acting>,
    /// Of a mill, once for all stations of the same cut; `None` where no cut is known.
    pub cut: Option<Arc<StationCut>>,
    /// How long the way from the station before takes, s; `None` at the beginning, in rapid moves, and where the feed rate is not said.
    pub time: Option<f64>,
    /// The arm may come here in any configuration and at any roll: the path begins, goes on elsewhere, or is clear of the work.
    pub is_fresh: bool,
    /// The tool must be turned so about its axis here, rad; `None` where the roll is free.
    pub pinned: Option<f64>,
}

/// Feed, across and axial as columns, part frame. Where the tool goes along its axis, or only turns, any direction across it stands
/// for the feed: the part's x axis, laid across.
pub fn cutting_axes(sample: &Sample) -> Matrix3<f64> {
    let a = sample.pose.axis;
    let across = |v: Vector3<f64>| (v - v.dot(&a) * a).try_normalize(1e-6);
    let feed = sample.direction.and_then(across).or_else(|| across(Vector3::x()));
    let feed = feed.unwrap_or_else(|| across(Vector3::y()).unwrap_or_else(Vector3::zeros));
    Matrix3::from_columns(&[feed, a.cross(&feed), a])
}

/// That every sample at which something pushes says what counts.
///
/// # Errors
/// A normal that is missing.
pub(super) fn check_normals(stations: &[Station], part: ErrorPart) -> Result<(), MillError> {
    let lacks = |station: &&Station| station.acting.is_some() && station.sample.normal.is_none();
    match stations.iter().filter(|_| part == ErrorPart::Normal).find(lacks) {
        None => Ok(()),
        Some(station) => Err(MillError::NoNormal { line: station.sample.line }),
    }
}

/// How near to the highest point of a rapid way the arm counts as clear of the work, m.
const CLEAR: f64 = 1e-6;

/// Cuts moves into stations; `acting` is asked at every sample what pushes on the tool, and counts where it feeds.
pub fn stations(moves: &[Move], steps: &Steps, mut acting: impl FnMut(&Sample) -> Option<Acting>) -> Vec<Station> {
    let pushed = |_: &Move, sample: &Sample| Ok::<_, Infallible>((acting(sample), None));
    let Ok(found) = cut(moves, steps, pushed);
    found
}

/// What pushes on the tool, and how it cuts.
pub(super) type Pushes = (Option<Acting>, Option<Arc<StationCut>>);

/// The same where what pushes may have no answer: the first sample without one ends it.
pub(super) fn cut<E>(
    moves: &[Move],
    steps: &Steps,
    mut pushes: impl FnMut(&Move, &Sample) -> Result<Pushes, E>,
) -> Result<Vec<Station>, E> {
    // Of long paths there is no memory to be moved about.
    let count = moves.iter().map(|one| steps.pieces(one) + 1).sum();
    let (mut found, mut way) = (Vec::<Station>::with_capacity(count), 0.0);
    for one in moves {
        for (piece, sample) in samples(one, steps, way).enumerate() {
            let before = found.last().map(|before| before.sample);
            let goes_on = before.is_some_and(|before| (before.pose.tip - sample.pose.tip).norm() < CLEAR || 0 < piece);
            let time = before.filter(|_| goes_on && sample.is_cutting).and_then(|before| match sample.feed {
                Some(feed) => Some((sample.way - before.way) / feed),
                None => (sample.way == before.way).then_some(0.0),
            });
            let (acting, cut) = pushes(one, &sample)?;
            let acting = acting.filter(|_| sample.is_cutting);
            found.push(Station { sample, acting, cut, time, is_fresh: !goes_on, pinned: None });
        }
        way += one.length();
    }
    mark_clear(&mut found);
    Ok(found)
}

/// At the highest place of every rapid way, along the tool axis, the arm may be arranged anew.
fn mark_clear(stations: &mut [Station]) {
    let mut from = 0;
    while from < stations.len() {
        let to = (from..stations.len()).find(|i| stations[*i].sample.is_cutting).unwrap_or(stations.len());
        let height = |i: usize| stations[i].sample.pose.tip.dot(&stations[i].sample.pose.axis);
        let highest = (from..to).max_by(|a, b| height(*a).total_cmp(&height(*b)));
        // A rapid way that stays at the height of the cut is clear of nothing.
        let beside = [from.checked_sub(1), Some(to).filter(|to| *to < stations.len())];
        let cut = beside.into_iter().flatten().map(height).fold(f64::NEG_INFINITY, f64::max);
        if let Some(highest) = highest.filter(|highest| cut + CLEAR < height(*highest)) {
            stations[highest].is_fresh = true;
        }
        from = (to..stations.len()).find(|i| !stations[*i].sample.is_cutting).unwrap_or(stations.len());
    }
}

/// Pins the roll where the path has gone on for so many m, at the station that is nearest to it, to an angle, rad.
///
/// # Errors
/// Beyond the path's end; two pins of one station.
pub fn pin(stations: &mut [Station], pins: &[[f64; 2]]) -> Result<(), MillError> {
    let length = stations.last().map_or(0.0, |last| last.sample.way);
    for &[way, roll] in pins {
        if !(0.0 <= way && way <= length + PAST_END) {
            return Err(MillError::PinnedBeyond { way, length });
        }
        let aside = |station: &Station| (station.sample.way - way).abs();
        let nearest = stations.iter_mut().min_by(|a, b| aside(a).total_cmp(&aside(b)));
        let nearest = nearest.ok_or(MillError::NothingFeeds)?;
        if nearest.pinned.replace(roll).is_some() {
            return Err(MillError::PinnedTwice { way });
        }
    }
    Ok(())
}

/// A pin may lie so far past the end of a path by the rounding of what was typed, m.
const PAST_END: f64 = 1e-4;
