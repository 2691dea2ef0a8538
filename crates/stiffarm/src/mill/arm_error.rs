//! How far does an arm that nobody has calibrated err along a path, by what is known of such arms?
//!
//! Errors of the joints' frames, of weight and gears are drawn from the priors of a calibration, the scale of the frames' alike over its range on
//! a logarithmic scale; each moves the tip by the derivatives of the chain. Where the work is found by touch, the rigid motion that the touched
//! points tell is taken off.

use nalgebra::{DMatrix, DVector, Point3, Vector3};

use super::fault::MillError;
use super::follow::{Pushed, Stand};
use super::on_true_arm::{WorkFrame, moved, touched};
use super::stations::{ErrorPart, Station};
use crate::calibrate::{prior_of_errors, scale_of_errors};
use crate::chain::{ALL, Frames};
use crate::compliance::PostureError;
use crate::parallel;
use crate::prior::normal;
use crate::robot::Robot;
use crate::uncertainty::{DRAWS, quantile};
use crate::watch::Watch;

/// Stations at which it is looked at: the error changes slowly along a path.
const LOOKED_AT: usize = 100;

/// The largest geometric error along a path of arms that nobody has calibrated, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnError {
    /// Half of them err by less.
    pub median: f64,
    /// 95th percentile.
    pub p95: f64,
}

/// The error of arms as this one leaves its maker, where it feeds; of a robot that was calibrated it is that of others of its kind.
///
/// # Errors
/// A planar robot; what was stopped.
pub fn arm_error(
    robot: &Robot,
    stand: &Stand,
    (stations, followed): (&[Station], &[Pushed]),
    (work_frame, part): (WorkFrame, ErrorPart),
    watch: Watch,
) -> Result<DrawnError, MillError> {
    let looked = Looked::at(robot, stand, (stations, followed), (work_frame, part))?;
    let mut rng = fastrand::Rng::with_seed(38);
    let draws: Vec<DVector<f64>> = (0..DRAWS).map(|_| drawn(&mut rng)).collect();
    let error = |draw: &DVector<f64>| watch.go_on().map(|()| looked.error(draw));
    let mut all: Vec<f64> = parallel::try_each(&draws, error)?;
    all.sort_by(f64::total_cmp);
    Ok(DrawnError { median: quantile(&all, 0.5), p95: quantile(&all, 0.95) })
}

/// How errors move the tip, 3 x 56, where it stands, m from the base.
struct Tip {
    at: Vector3<f64>,
    moves: DMatrix<f64>,
    /// The direction that counts; all where `None`.
    counted: Option<Vector3<f64>>,
}

/// Where it is looked at, and where the work is touched.
struct Looked {
    feeding: Vec<Tip>,
    touched: Vec<Tip>,
}

impl Looked {
    fn at(
        robot: &Robot,
        stand: &Stand,
        (stations, followed): (&[Station], &[Pushed]),
        (work_frame, part): (WorkFrame, ErrorPart),
    ) -> Result<Self, MillError> {
        let frames = Frames::of(robot).ok_or_else(|| PostureError::Planar(robot.name.clone()))?;
        let tip = |i: usize| {
            let sample = &stations[i].sample;
            Tip {
                at: (stand.base_from_part * Point3::from(sample.pose.tip)).coords,
                moves: moves_of(&frames, stand, &followed[i]),
                counted: part.direction(&stand.cutting_axes(sample), sample),
            }
        };
        let feeding: Vec<usize> = (0..stations.len()).filter(|i| stations[*i].sample.is_cutting).collect();
        let every = feeding.len().div_ceil(LOOKED_AT).max(1);
        let touched = if work_frame == WorkFrame::Touched { touched(stations) } else { Vec::new() };
        Ok(Self {
            feeding: feeding.into_iter().step_by(every).map(tip).collect(),
            touched: touched.into_iter().map(tip).collect(),
        })
    }

    /// The largest error of one arm, m.
    fn error(&self, draw: &DVector<f64>) -> f64 {
        let off = |tip: &Tip| Vector3::from_iterator((&tip.moves * draw).iter().copied());
        let at: Vec<Vector3<f64>> = self.touched.iter().map(|tip| tip.at).collect();
        let found = moved(&at, &self.touched.iter().map(off).collect::<Vec<_>>());
        let left = |tip: &Tip| {
            let left = off(tip) - found.at(&tip.at);
            tip.counted.map_or_else(|| left.norm(), |counted| counted.dot(&left).abs())
        };
        self.feeding.iter().map(left).fold(0.0, f64::max)
    }
}

/// How each error moves the tip of a station, 3 x 56.
fn moves_of(frames: &Frames, stand: &Stand, pushed: &Pushed) -> DMatrix<f64> {
    let chain = frames.chain(&[0.0; ALL], &pushed.joints);
    let tip = (chain.flange * stand.flange_from_tool).translation.vector;
    let columns: Vec<Vector3<f64>> = chain.twists.iter().map(|[v, w]| v + w.cross(&tip)).collect();
    DMatrix::from_fn(3, ALL, |i, j| columns[j][i])
}

/// One arm.
fn drawn(rng: &mut fastrand::Rng) -> DVector<f64> {
    let prior = prior_of_errors(scale_of_errors(rng.f64()));
    DVector::from_fn(ALL, |i, _| prior[i] * normal(rng))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::{Calibration, Errors};
    use crate::catalogue::paper_robots;
    use crate::mill::{MillOptions, Milled, TrueOptions, mill, on_true_arm, stations};
    use crate::spatial::Pose;
    use crate::toolpath::{Builtin, Steps};

    /// The same arms, one after the other, exactly: what is linear there is not here.
    #[test]
    fn arms_that_are_drawn_err_as_they_do_by_the_chain_itself() {
        let robot = paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").unwrap();
        let stand = Stand {
            base_from_part: Pose::new(Vector3::new(1.6, 0.2, 0.6), Vector3::z() * 0.4),
            flange_from_tool: Pose::new(Vector3::new(0.2, 0.0, 0.15), Vector3::y() * 1.2),
        };
        let moves = "rect:0.4x0.3".parse::<Builtin>().unwrap().moves(Some(0.02));
        let stations = stations(&moves, &Steps { longest: 0.02, ..Steps::USUAL }, |_| None);
        let found = mill(&robot, &stand, &stations, &MillOptions::usual(), Watch::nobody()).unwrap();
        let Milled::Followed(found) = found else { panic!("{found:?}") };
        let mut rng = fastrand::Rng::with_seed(3);
        for work_frame in WorkFrame::ALL {
            let part = ErrorPart::Total;
            let looked = Looked::at(&robot, &stand, (&stations, &found.samples), (work_frame, part)).unwrap();
            assert_eq!(looked.feeding.len(), stations.iter().filter(|station| station.sample.is_cutting).count());
            for _ in 0..10 {
                let draw = drawn(&mut rng);
                let errors = Errors::of(draw.as_slice());
                let calibration = Calibration {
                    errors,
                    residual: 1e-4,
                    left_out: 1e-4,
                    controller: None,
                    rows: 40,
                    date: "2026-05-31".into(),
                    source: "drawn".into(),
                };
                let mine = Robot { calibration: Some(Box::new(calibration)), ..robot.clone() };
                let options = TrueOptions { work_frame, part, is_compensated: false, held: None };
                let path = (&stations[..], &found.samples[..]);
                let exact = on_true_arm(&mine, &stand, path, &options, Watch::nobody()).unwrap().unwrap();
                let (linear, exact) = (looked.error(&draw), exact.errors.uncorrected);
                // Errors of 2 mrad change each other by that part of themselves, and turn the axes of the rest.
                assert!((linear / exact - 1.0).abs() < 0.02, "{work_frame:?} {linear} {exact}");
            }
        }
    }
}
