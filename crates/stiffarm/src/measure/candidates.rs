//! Which postures and loads could be measured? Postures spread evenly within the limits, each under every load.

use std::f64::consts::PI;

use nalgebra::Matrix6;

use super::{MeasureError, Options, information, stands_free};
use crate::compliance::{PostureError, beyond_limits};
use crate::interval::Interval;
use crate::parallel;
use crate::robot::{Arm, Robot};
use crate::spatial::Wrench;
use crate::watch::Parts;

/// So many postures are looked at for one that is kept, at most.
const MOST_REFUSED: usize = 60;

/// Postures and what each tells under each load.
pub(super) struct Candidates {
    /// As reported, rad.
    pub postures: Vec<[f64; 6]>,
    /// Of every posture under every load, loads first.
    pub information: Vec<Matrix6<f64>>,
}

/// So many postures spread evenly within the limits that can be measured, as reported, rad; fewer where no more are found.
///
/// # Errors
/// Where none is found.
pub(super) fn postures(
    robot: &Robot,
    options: &Options,
    wanted: usize,
    parts: &Parts,
) -> Result<Vec<[f64; 6]>, MeasureError> {
    let Arm::SixAxis { limits, .. } = &robot.arm else {
        return Err(PostureError::Planar(robot.name.clone()).into());
    };
    let ends = limits.joints.map(one_turn);
    let posture = |n: usize| {
        let at = halton(n);
        // To a hundredth of a degree, so that what is reported is what is meant.
        let rounded = |angle: f64| ((angle.to_degrees() * 100.0).round() / 100.0).to_radians();
        std::array::from_fn(|i| rounded(ends[i][0] + at[i] * (ends[i][1] - ends[i][0])))
    };
    let (mut postures, mut looked_at) = (Vec::with_capacity(wanted), 0);
    for start in (0..MOST_REFUSED * wanted).step_by(wanted.max(1)) {
        let kept = parallel::try_each_of(wanted, |n| {
            parts.go_on()?;
            let q: [f64; 6] = posture(start + n);
            Ok::<_, MeasureError>(
                (beyond_limits(robot, &q).is_empty() && stands_free(robot, &q, options)?).then_some(q),
            )
        })?;
        postures.extend(kept.into_iter().flatten());
        looked_at += wanted;
        parts.one_more()?;
        if wanted <= postures.len() {
            break;
        }
    }
    postures.truncate(wanted);
    if postures.is_empty() { Err(MeasureError::NoCandidate { looked_at }) } else { Ok(postures) }
}

/// The turn of a joint that lies nearest to zero: whole turns show nothing new.
fn one_turn(range: Interval) -> [f64; 2] {
    if range.width() <= 2.0 * PI {
        return [range.min(), range.max()];
    }
    let middle = 0.0_f64.clamp(range.min() + PI, range.max() - PI);
    [middle - PI, middle + PI]
}

impl Candidates {
    pub(super) fn of(robot: &Robot, options: &Options, parts: &Parts) -> Result<Self, MeasureError> {
        let wanted = options.candidates.div_ceil(options.ways.len().max(1));
        let postures = postures(robot, options, wanted, parts)?;
        let pairs: Vec<(usize, usize)> =
            (0..postures.len()).flat_map(|posture| (0..options.ways.len()).map(move |way| (posture, way))).collect();
        let of = |(posture, way): &(usize, usize)| {
            parts.go_on()?;
            let load = Wrench::force(options.ways[*way].along * options.newtons);
            information(robot, &postures[*posture], &load, options)
        };
        let information = parallel::try_each(&pairs, of)?;
        Ok(Self { postures, information })
    }

    /// The posture and the load of a candidate.
    pub(super) fn run(&self, index: usize, ways: usize) -> ([f64; 6], usize) {
        (self.postures[index / ways], index % ways)
    }
}

/// Halton's sequence in six dimensions, 0 to 1; its first points, which are alike in all of them, are left out.
fn halton(n: usize) -> [f64; 6] {
    [2_usize, 3, 5, 7, 11, 13].map(|base| {
        let (mut rest, mut share, mut at) = (n + 50, 1.0, 0.0);
        while 0 < rest {
            share /= base as f64;
            at += share * (rest % base) as f64;
            rest /= base;
        }
        at
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::catalogue::find;
    use crate::measure::{Criterion, LoadWay};
    use crate::prior::with_prior;
    use crate::watch::Watch;

    /// By hand: a joint of less than a whole turn keeps all of its range, wherever that lies; of one that turns further a whole turn is left.
    #[test]
    fn a_range_keeps_all_that_shows_something_new() {
        let turn = |from: f64, to: f64| {
            let [from, to] = one_turn(Interval::spanning(from.to_radians(), to.to_radians()));
            [from, to].map(|angle| angle.to_degrees().round())
        };
        assert_eq!(turn(-10.0, 255.0), [-10.0, 255.0]);
        assert_eq!(turn(200.0, 455.0), [200.0, 455.0]);
        assert_eq!(turn(-350.0, 350.0), [-180.0, 180.0]);
        assert_eq!(turn(85.0, 485.0), [85.0, 445.0]);
        assert_eq!(turn(-455.0, -55.0), [-415.0, -55.0]);
    }

    /// Points along the forearm and at the flange keep from the joint-1 axis what column and forearm are thick, and from the floor what the
    /// forearm is; postures spread over the limits alone do not.
    #[test]
    fn no_posture_has_the_forearm_in_the_column_or_in_the_floor() {
        let robot = with_prior(&find("KR 210 R2700 extra").unwrap().robot()).unwrap();
        let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!("six axes") };
        let (body, _) = robot.thickness();
        let is_free = |q: &[f64; 6]| {
            let [_, _, elbow, wrist, _] =
                geometry.points(&geometry.model_angles(q, limits.third_axis)).map(Vector3::from);
            (0..=40).map(|i| elbow + (wrist - elbow) * (f64::from(i) / 40.0)).all(|point| {
                // The column ends at the height of the joint-2 axis, and is round there.
                let above = (point.z - geometry.c1).max(0.0);
                body.column + body.forearm <= point.xy().norm().hypot(above) && body.forearm <= point.z
            })
        };
        let options = Options {
            criterion: Criterion::Prediction,
            ways: vec![LoadWay { name: "down".into(), along: -Vector3::z() }],
            newtons: 1000.0,
            load_at: Vector3::zeros(),
            markers: vec![Vector3::zeros()],
            sigma: 2e-5,
            posture_sigma: 0.0,
            repeats: 6,
            runs: 6,
            candidates: 2000,
            window: Some([Interval::ALL; 3]),
            instrument: None,
            work: Vec::new(),
            tool: Vector3::zeros(),
        };
        let found = Candidates::of(&robot, &options, &Watch::nobody().parts(None)).unwrap();
        assert_eq!(found.postures.len(), 2000);
        assert!(found.postures.iter().all(is_free));
        let spread = (0..2000).map(|n| {
            let at = halton(n);
            std::array::from_fn(|i| limits.joints[i].min() + at[i] * limits.joints[i].width())
        });
        assert!(100 < spread.filter(|q: &[f64; 6]| !is_free(q)).count());
    }
}
