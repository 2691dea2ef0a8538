//! Does the instrument see the markers? Turned towards it, and past the arm, whose links are capsules.

use nalgebra::{Point3, Vector3};

use crate::clearance::ThickArm;
use crate::spatial::Pose;

/// What looks at the markers: a tracker, a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instrument {
    /// Where it stands, from the base, m.
    pub at: Vector3<f64>,
    /// From where markers can be seen; `None` from all sides.
    pub cone: Option<Cone>,
}

/// From where a marker can be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Where it faces, along flange axes, length one.
    pub faces: Vector3<f64>,
    /// How far it may be turned away, rad, up to a quarter turn.
    pub acceptance: f64,
}

impl Instrument {
    /// All markers, in the flange frame, m, at model angles, rad, that have the flange there.
    pub(super) fn sees(&self, arm: &ThickArm, (theta, flange): (&[f64; 6], &Pose), markers: &[Vector3<f64>]) -> bool {
        markers.iter().all(|marker| {
            let marker = (flange * Point3::from(*marker)).coords;
            let turned_to = |cone: &Cone| (flange.rotation * cone.faces).angle(&(self.at - marker)) <= cone.acceptance;
            self.cone.as_ref().is_none_or(turned_to) && !arm.hides(theta, &marker, &self.at)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use crate::catalogue::find;
    use crate::geometry::Geometry;
    use crate::robot::{Arm, Robot};

    /// Forearm level and ahead at 1.7 m, the flange at x = 1.5 m, facing ahead; links 0.3, 0.2, 0.15 and 0.1 m thick.
    fn robot() -> (Robot, Pose) {
        let mut robot = find("KR 210 R2700 extra").unwrap().robot();
        let Arm::SixAxis { geometry, .. } = &mut robot.arm else { unreachable!("it has six axes") };
        *geometry = Geometry { a1: 0.3, a2: 0.0, b: 0.0, c1: 0.7, c2: 1.0, c3: 1.0, c4: 0.2, ..geometry.clone() };
        let flange = geometry.forward(&LEVEL);
        robot.body = Some(Body::from([0.3, 0.2, 0.15, 0.1]));
        (robot, flange)
    }

    const LEVEL: [f64; 6] = [0.0, 0.0, std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0];

    fn sees(at: impl Into<Vector3<f64>>, cone: Option<Cone>, markers: &[Vector3<f64>]) -> bool {
        let (robot, flange) = robot();
        let arm = ThickArm::new(&robot, &Pose::identity(), None).unwrap();
        Instrument { at: at.into(), cone }.sees(&arm, (&LEVEL, &flange), markers)
    }

    #[test]
    fn the_arm_hides_what_lies_behind_it() {
        let sees = |at: [f64; 3], marker: [f64; 3]| sees(at, None, &[marker.into()]);
        // Before the flange, beside it, and straight above.
        assert!(sees([5.0, 0.0, 1.7], [0.0; 3]) && sees([1.6, 4.0, 1.7], [0.0; 3]) && sees([1.5, 0.0, 6.0], [0.0; 3]));
        // 0.4 m ahead of the flange: from behind on the line of the forearm, and 3 m over it, where the line passes the forearm's end at
        // 0.6 m x 3 / 7.5 = 0.24 m.
        assert!(!sees([-5.0, 0.0, 1.7], [0.0, 0.0, 0.4]) && sees([-5.0, 0.0, 4.7], [0.0, 0.0, 0.4]));
        let aside = |y: f64| (robot().1.rotation.inverse() * Vector3::new(0.0, y, 0.0)).into();
        // To the side of the flange, from behind: past the upper arm, 0.2 m thick, and not past the forearm.
        assert!(sees([-5.0, 0.25, 1.7], aside(0.25)) && !sees([-5.0, 0.1, 1.7], aside(0.1)));
        // From behind and below, where the line passes the joint-1 axis 0.15 m high: the column is 0.3 m thick.
        assert!(!sees([-5.0, 0.25, -5.0], aside(0.25)) && sees([-5.0, 0.45, -5.0], aside(0.45)));
    }

    #[test]
    fn a_marker_is_seen_within_its_acceptance_and_no_further() {
        let acceptance = 30_f64.to_radians();
        let cone = Some(Cone { faces: Vector3::z(), acceptance });
        // The flange faces ahead: a ray at so many degrees to it.
        let sees = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            super::tests::sees([1.5 + 3.0 * cos, 3.0 * sin, 1.7], cone, &[Vector3::zeros()])
        };
        assert!(sees(0.0) && sees(29.9) && sees(-29.9) && !sees(30.1) && !sees(-30.1) && !sees(90.0));
    }

    #[test]
    fn every_marker_must_be_seen() {
        // The second one sits on the forearm, behind the wrist.
        let [seen, hidden] = [Vector3::zeros(), Vector3::new(0.0, 0.0, -0.4)];
        let ahead = [5.0, 0.0, 1.7];
        assert!(sees(ahead, None, &[seen]) && !sees(ahead, None, &[seen, hidden]));
    }

    #[test]
    fn a_marker_in_the_column_is_seen_from_nowhere() {
        // The flange is 1.5 m ahead of the joint-1 axis and 1.7 m high.
        let in_the_column = robot().1.inverse_transform_point(&Point3::new(0.0, 0.0, 0.3)).coords;
        assert!(!sees([5.0, 0.0, 0.3], None, &[in_the_column]) && !sees([0.0, 0.0, 0.2], None, &[in_the_column]));
    }
}
