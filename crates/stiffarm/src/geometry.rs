//! Where do the joints and the tool stand?

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix6, Rotation3, Unit, Vector3, Vector6};

use crate::interval::Interval;
use crate::limits::ThirdAxis;
use crate::spatial::Pose;

/// An arm with a spherical wrist: the seven lengths, zero offsets and signs of \[OPW\].
///
/// `theta_i = sign_i q_i - offset_i`, and the flange stands at
/// `T = Rz(t1) Tr(a1,b,c1) Ry(t2) Tr(0,0,c2) Ry(t3) Tr(a2,0,c3) Rz(t4) Ry(t5) Rz(t6) Tr(0,0,c4)`.
/// At model zero, upper arm and forearm stand upright. Lengths in m, angles in rad, base frame z up, x forward.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// Joint 1 axis to joint 2 axis, forwards.
    pub a1: f64,
    /// Elbow to forearm axis, forwards at model zero (negative on most arms: the forearm lies above the elbow).
    pub a2: f64,
    /// Sideways offset of the arm plane from the joint 1 axis.
    pub b: f64,
    /// Floor to joint 2 axis.
    pub c1: f64,
    /// Upper arm, the paper's `l2`.
    pub c2: f64,
    /// Elbow to wrist centre along the forearm.
    pub c3: f64,
    /// Wrist centre to flange.
    pub c4: f64,
    /// Zero offsets of the six joints.
    pub offset: [f64; 6],
    /// +1 or -1 for each joint.
    pub sign: [f64; 6],
}

impl Geometry {
    /// The paper's `l3 = hypot(a3, d4)`: elbow to wrist centre in a straight line.
    pub fn l3(&self) -> f64 {
        self.a2.hypot(self.c3)
    }

    /// How far the line elbow - wrist centre leans forwards of the forearm axis: `delta = atan2(a2, c3)`.
    pub(crate) fn lean(&self) -> f64 {
        self.a2.atan2(self.c3)
    }

    /// The range of a model angle `theta_i` (rad) from the range of joint `i` (0 to 5) as reported.
    pub(crate) fn theta(&self, i: usize, reported: Interval) -> Interval {
        reported.affine(self.sign[i], -self.offset[i])
    }

    /// The shoulder angle of the arm plane, `pi/2 - theta2`: of the upper arm, counter-clockwise from straight ahead.
    pub fn shoulder(&self, joint_2: Interval) -> Interval {
        self.theta(1, joint_2).affine(-1.0, FRAC_PI_2)
    }

    /// What joint 3 limits in the arm plane, counter-clockwise: the elbow `-delta - theta3` (relative), or the forearm
    /// `pi/2 - delta - (theta2 + theta3)` (absolute), as `third_axis` says.
    pub fn third(&self, joint_3: Interval, third_axis: ThirdAxis) -> Interval {
        let upright = match third_axis {
            ThirdAxis::Elbow => 0.0,
            ThirdAxis::Forearm => FRAC_PI_2,
        };
        self.theta(2, joint_3).affine(-1.0, upright - self.lean())
    }

    /// The elbow angle of the arm plane from the enclosed angle `phi = pi - theta3`: `-delta - pi + phi`.
    pub fn elbow(&self, enclosed: Interval) -> Interval {
        enclosed.affine(1.0, -self.lean() - std::f64::consts::PI)
    }

    /// The flange in the base frame at the model angles `theta`, rad.
    pub fn forward(&self, theta: &[f64; 6]) -> Pose {
        let [t1, t2, t3, t4, t5, t6] = *theta;
        let turn = |axis: Unit<Vector3<f64>>, angle: f64| Pose::rotation(axis.into_inner() * angle);
        let (y, z) = (Vector3::y_axis(), Vector3::z_axis());
        turn(z, t1)
            * Pose::translation(self.a1, self.b, self.c1)
            * turn(y, t2)
            * Pose::translation(0.0, 0.0, self.c2)
            * turn(y, t3)
            * Pose::translation(self.a2, 0.0, self.c3)
            * turn(z, t4)
            * turn(y, t5)
            * turn(z, t6)
            * Pose::translation(0.0, 0.0, self.c4)
    }

    /// The geometric Jacobian, 6 x 6, at the model angles `theta` for a point at `tool` (m, base frame).
    ///
    /// Column `i` is `(e_i x (tool - p_i), e_i)` for joint axis `e_i` through `p_i`; base axes, translation first.
    pub fn jacobian(&self, theta: &[f64; 6], tool: &Vector3<f64>) -> Matrix6<f64> {
        let columns = self.axes(theta).map(|(axis, through)| {
            let moved = axis.cross(&(tool - through));
            Vector6::new(moved.x, moved.y, moved.z, axis.x, axis.y, axis.z)
        });
        Matrix6::from_columns(&columns)
    }

    /// How far a point of the flange frame, m, ever comes from axes 4, 5 and 6 as these three joints turn, m.
    ///
    /// All three pass through the wrist centre. Axis 6 keeps its distance; joint 6 turns the point square to axis 5, and joint 5 then square
    /// to axis 4.
    pub fn wrist_levers(&self, point: &Vector3<f64>) -> [f64; 3] {
        let from_centre = point + Vector3::new(0.0, 0.0, self.c4);
        [from_centre.norm(), from_centre.norm(), from_centre.xy().norm()]
    }

    /// The six joint axes at the model angles `theta`, rad: a unit direction and a point that each passes through, m, base frame.
    pub(crate) fn axes(&self, theta: &[f64; 6]) -> [(Vector3<f64>, Vector3<f64>); 6] {
        let [t1, t2, t3, t4, t5, _] = *theta;
        let (s1, c1) = t1.sin_cos();
        let in_base = |x: f64, y: f64, z: f64| Vector3::new(c1 * x - s1 * y, s1 * x + c1 * y, z);
        let (s2, c2) = t2.sin_cos();
        let (s23, c23) = (t2 + t3).sin_cos();
        let (s4, c4) = t4.sin_cos();
        let (s5, c5) = t5.sin_cos();
        let across = in_base(0.0, 1.0, 0.0);
        let along = in_base(s23, 0.0, c23); // the forearm, which joint 4 turns about
        let forwards = in_base(c23, 0.0, -s23);
        let bend = -s4 * forwards + c4 * across; // joint 5
        let spin = s5 * (c4 * forwards + s4 * across) + c5 * along; // joint 6
        let shoulder = in_base(self.a1, self.b, self.c1);
        let elbow = shoulder + self.c2 * in_base(s2, 0.0, c2);
        let wrist = elbow + self.a2 * forwards + self.c3 * along;
        [
            (Vector3::z(), Vector3::zeros()),
            (across, shoulder),
            (across, elbow),
            (along, wrist),
            (bend, wrist),
            (spin, wrist),
        ]
    }

    /// How each link has moved from where it is at model zero, at the model angles `theta`, rad, base frame: the link that joint 1 turns, and
    /// so on to the one that joint 6 turns.
    pub fn links(&self, theta: &[f64; 6]) -> [Pose; 6] {
        let shoulder = self.shoulder_at_zero();
        let elbow = shoulder + Vector3::new(0.0, 0.0, self.c2);
        let wrist = elbow + Vector3::new(self.a2, 0.0, self.c3);
        let (y, z) = (Vector3::y(), Vector3::z());
        let axes = [(z, Vector3::zeros()), (y, shoulder), (y, elbow), (z, wrist), (y, wrist), (z, wrist)];
        let mut moved = Pose::identity();
        std::array::from_fn(|i| {
            moved *= about(axes[i].1, axes[i].0 * theta[i]);
            moved
        })
    }

    /// A point of the joint-2 axis at model zero, in the arm plane, m, base frame.
    pub(crate) fn shoulder_at_zero(&self) -> Vector3<f64> {
        Vector3::new(self.a1, self.b, self.c1)
    }

    /// The points between which the arm is drawn, m, base frame, at the model angles `theta`, rad: base, shoulder (on the
    /// joint 2 axis), elbow (on the joint 3 axis), wrist centre (where the axes 4, 5 and 6 meet), flange centre.
    pub fn points(&self, theta: &[f64; 6]) -> [[f64; 3]; 5] {
        let [t1, t2, t3, t4, t5, _] = *theta;
        let about_y = |angle: f64| Rotation3::from_axis_angle(&Vector3::y_axis(), angle);
        let about_z = |angle: f64| Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        let (upper_arm, forearm) = (about_z(t1) * about_y(t2), about_z(t1) * about_y(t2 + t3));
        let shoulder = about_z(t1) * Vector3::new(self.a1, self.b, self.c1);
        let elbow = shoulder + upper_arm * Vector3::new(0.0, 0.0, self.c2);
        let wrist = elbow + forearm * Vector3::new(self.a2, 0.0, self.c3);
        let flange = wrist + forearm * about_z(t4) * about_y(t5) * Vector3::new(0.0, 0.0, self.c4);
        [Vector3::zeros(), shoulder, elbow, wrist, flange].map(Into::into)
    }

    /// Wrist centre in the base frame, m, for the six joint angles as reported, rad.
    pub fn wrist_centre(&self, q: [f64; 6], third_axis: ThirdAxis) -> [f64; 3] {
        let [_, _, _, wrist, _] = self.points(&self.model_angles(&q, third_axis));
        wrist
    }

    /// How far a pose of the flange lies outside of what the links reach, m, limits left aside; 0 where they do.
    pub(crate) fn beyond(&self, flange: &Pose) -> f64 {
        let wrist = flange.translation.vector - flange.rotation * Vector3::z() * self.c4;
        let ahead = (wrist.xy().norm_squared() - self.b * self.b).max(0.0).sqrt();
        let from = |forwards: f64| (forwards - self.a1).hypot(wrist.z - self.c1);
        let outside = |far: f64| (far - self.c2 - self.l3()).max((self.c2 - self.l3()).abs() - far).max(0.0);
        outside(from(ahead)).min(outside(from(-ahead)))
    }

    /// The six joint angles as reported from model angles, rad; whole turns are left as they are.
    pub fn reported(&self, theta: &[f64; 6], third_axis: ThirdAxis) -> [f64; 6] {
        std::array::from_fn(|i| {
            let forearm = i == 2 && third_axis == ThirdAxis::Forearm;
            let angle = if forearm { theta[1] + theta[2] } else { theta[i] };
            (angle + self.offset[i]) * self.sign[i]
        })
    }

    /// The smaller of the angles of joint 5 to a straight wrist and of the elbow to a stretched or folded arm, rad.
    pub fn singular_margin(&self, theta: &[f64; 6]) -> f64 {
        let to_a_line = |angle: f64| angle.sin().abs().min(1.0).asin();
        to_a_line(theta[4]).min(to_a_line(theta[2] + self.lean()))
    }

    /// Model angles from the six joint angles as reported, rad.
    pub fn model_angles(&self, q: &[f64; 6], third_axis: ThirdAxis) -> [f64; 6] {
        let mut theta = std::array::from_fn(|i| self.sign[i] * q[i] - self.offset[i]);
        if third_axis == ThirdAxis::Forearm {
            theta[2] -= theta[1];
        }
        theta
    }
}

/// A turn by a vector of its axis and angle, rad, about a point.
fn about(point: Vector3<f64>, turn: Vector3<f64>) -> Pose {
    Pose::translation(point.x, point.y, point.z)
        * Pose::rotation(turn)
        * Pose::translation(-point.x, -point.y, -point.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kuka() -> Geometry {
        let offset = [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0];
        let sign = [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0];
        Geometry { a1: 0.35, a2: 0.041, b: 0.02, c1: 0.675, c2: 1.15, c3: 1.2, c4: 0.215, offset, sign }
    }

    #[test]
    fn upright_with_the_forearm_level_the_flange_stands_where_the_lengths_add_up() {
        // Upper arm up, forearm level and forwards, wrist straight: the forearm axis lies 41 mm below the elbow.
        let flange = kuka().forward(&[0.0, 0.0, FRAC_PI_2, 0.0, 0.0, 0.0]);
        let expected = Vector3::new(0.35 + 1.2 + 0.215, 0.02, 0.675 + 1.15 - 0.041);
        assert!((flange.translation.vector - expected).norm() < 1e-12, "{flange}");
        assert!((flange.rotation * Vector3::z() - Vector3::x()).norm() < 1e-12, "the tool points ahead");
    }

    #[test]
    fn the_points_of_the_arm_lead_to_the_flange() {
        let (geometry, mut rng) = (kuka(), fastrand::Rng::with_seed(5));
        for _ in 0..200 {
            let theta: [f64; 6] = std::array::from_fn(|_| 6.0 * (rng.f64() - 0.5));
            let [base, shoulder, elbow, wrist, flange] = geometry.points(&theta).map(Vector3::from);
            let pose = geometry.forward(&theta);
            let ahead = pose.rotation * Vector3::z();
            // Sums of a few metres.
            let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} is not {b}: {theta:?}");
            close((flange - pose.translation.vector).norm(), 0.0);
            close((flange - wrist - geometry.c4 * ahead).norm(), 0.0);
            close((shoulder - base).norm(), geometry.a1.hypot(geometry.b).hypot(geometry.c1));
            close((elbow - shoulder).norm(), geometry.c2);
            close((wrist - elbow).norm(), geometry.l3());
            // Joint 3 does not move the elbow, nor the wrist its centre.
            let bent: [f64; 6] = std::array::from_fn(|i| theta[i] + if i < 2 { 0.0 } else { 0.7 });
            close((Vector3::from(geometry.points(&bent)[2]) - elbow).norm(), 0.0);
            let turned: [f64; 6] = std::array::from_fn(|i| theta[i] + if i < 3 { 0.0 } else { 0.7 });
            close((Vector3::from(geometry.points(&turned)[3]) - wrist).norm(), 0.0);
        }
    }

    #[test]
    fn the_jacobian_is_what_finite_differences_of_the_flange_give() {
        let (geometry, mut rng) = (kuka(), fastrand::Rng::with_seed(3));
        let tool_in_flange = Vector3::new(0.1, -0.05, 0.3);
        for _ in 0..200 {
            let theta: [f64; 6] = std::array::from_fn(|_| 6.0 * (rng.f64() - 0.5));
            let flange = geometry.forward(&theta);
            let tool = flange * nalgebra::Point3::from(tool_in_flange);
            let jacobian = geometry.jacobian(&theta, &tool.coords);
            for i in 0..6 {
                let h = 1e-6;
                let moved = |step: f64| {
                    let mut theta = theta;
                    theta[i] += step;
                    geometry.forward(&theta)
                };
                let (ahead, behind) = (moved(h), moved(-h));
                let point = |pose: &Pose| pose * nalgebra::Point3::from(tool_in_flange);
                let translation = (point(&ahead) - point(&behind)) / (2.0 * h);
                let rotation = (ahead.rotation * behind.rotation.inverse()).scaled_axis() / (2.0 * h);
                let expected =
                    Vector6::new(translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z);
                // Central differences of step 1e-6: rounding 1e-10, truncation 1e-12, metres of arm.
                assert!((jacobian.column(i) - expected).norm() < 1e-8, "joint {}: {theta:?}", i + 1);
            }
        }
    }
}
