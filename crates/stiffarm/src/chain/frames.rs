//! Where does the flange of an arm stand whose joint frames differ from the drawing, and how does each error move it?
//!
//! `F = prod_i [ Tr(p_i) E_i Rot(e_i, theta_i + d_i) Tr(-p_i) ] F_0`, with the joints' points `p_i` and axes `e_i` at model zero, the
//! frames' errors `E_i = Tr(s) exp(w)` in base axes at model zero, and the angles `d_i` of weight and gears.

use nalgebra::{Matrix3, Matrix6, Rotation3, SMatrix, SVector, Translation3, UnitQuaternion, Vector3, Vector6};

use super::weighing::Weighing;
use crate::calibration::{Errors, JOINT_AXES, WEIGHT};
use crate::geometry::Geometry;
use crate::limits::ThirdAxis;
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;

/// Three shifts and three turns of each frame.
pub(crate) const FRAMES: usize = 36;
/// Sine and cosine of each joint.
pub(crate) const GEARS: usize = 12;
/// All of them.
pub(crate) const ALL: usize = FRAMES + WEIGHT + GEARS;

impl Errors {
    pub(crate) fn of(parameters: &[f64]) -> Self {
        Self {
            frames: std::array::from_fn(|i| std::array::from_fn(|j| parameters[6 * i + j])),
            weight: std::array::from_fn(|i| parameters[FRAMES + i]),
            gears: std::array::from_fn(|i| std::array::from_fn(|j| parameters[FRAMES + WEIGHT + 2 * i + j])),
            drives: None,
        }
    }

    pub(crate) fn parameters(&self) -> Vec<f64> {
        let frames = self.frames.iter().flatten();
        frames.chain(&self.weight).chain(self.gears.iter().flatten()).copied().collect()
    }

    /// The flange of the true arm in its base at joint angles as reported, rad; `None` of two links.
    pub fn flange(&self, robot: &Robot, q: &[f64; 6]) -> Option<Pose> {
        Some(Frames::with(robot, self)?.chain(&self.parameters(), q).flange)
    }
}

/// The flange in the base, and how a unit of each parameter moves it.
pub(crate) struct Chain {
    pub flange: Pose,
    /// Velocity of what stands at the base's origin, and angular velocity; base axes.
    pub twists: Vec<[Vector3<f64>; 2]>,
}

/// A joint of an arm that stands somewhere.
pub(super) struct Joint {
    /// How the link before it is turned.
    pub(super) carrier: Matrix3<f64>,
    /// A point of its axis, m, and the axis, base frame.
    pub(super) centre: Vector3<f64>,
    pub(super) axis: Vector3<f64>,
}

/// From the point of the joint before to that of each joint, m, and the turn of its frame; in the axes of the link between, as at model zero.
pub(super) type Links = [(Vector3<f64>, Matrix3<f64>); 6];

/// Place, m, and turn of the flange in the base.
pub(super) type Placement = (Vector3<f64>, Matrix3<f64>);

/// The same as a pose.
pub(super) fn pose((at, turn): Placement) -> Pose {
    Pose::from_parts(
        Translation3::from(at),
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn)),
    )
}

/// A turn, followed by one by an angle about an axis of the base at model zero.
#[inline]
fn turned_about(turn: &Matrix3<f64>, axis: usize, angle: f64) -> Matrix3<f64> {
    let (s, c) = angle.sin_cos();
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    let mut turned = *turn;
    turned.set_column(u, &(turn.column(u) * c + turn.column(v) * s));
    turned.set_column(v, &(turn.column(v) * c - turn.column(u) * s));
    turned
}

/// The joints of an arm as drawn, whose frames may differ.
#[derive(Clone, Debug)]
pub(crate) struct Frames {
    pub(super) geometry: Geometry,
    pub(super) third_axis: ThirdAxis,
    transmission: Matrix6<f64>,
    points: [Vector3<f64>; 6],
    /// What weighs, where that is known; the parameters of weight are then, of the first six, logarithms of factors on its compliances.
    weighing: Option<Weighing>,
}

impl Frames {
    pub(crate) fn of(robot: &Robot) -> Option<Self> {
        let Arm::SixAxis { geometry, limits, drives } = &robot.arm else { return None };
        let Geometry { a1, a2, b, c1, c2, c3, .. } = *geometry;
        let shoulder = Vector3::new(a1, b, c1);
        let elbow = shoulder + Vector3::z() * c2;
        let wrist = elbow + Vector3::new(a2, 0.0, c3);
        Some(Self {
            geometry: geometry.clone(),
            third_axis: limits.third_axis,
            transmission: drives.transmission.0,
            points: [Vector3::zeros(), shoulder, elbow, wrist, wrist, wrist],
            weighing: None,
        })
    }

    /// The joints of an arm that yields under its own weight as these errors say; `None` of two links, and where the masses are missing.
    pub(crate) fn with(robot: &Robot, errors: &Errors) -> Option<Self> {
        let frames = Self::of(robot)?;
        match errors.drives {
            None => Some(frames),
            Some(compliance) => Some(frames.weighed(Weighing::of(robot, compliance)?)),
        }
    }

    /// The same arm, whose own weight is that of its masses.
    pub(crate) fn weighed(self, weighing: Weighing) -> Self {
        Self { weighing: Some(weighing), ..self }
    }

    /// Its own weight is that of its masses.
    pub(super) fn is_weighed(&self) -> bool {
        self.weighing.is_some()
    }

    /// The flange as drawn.
    pub(crate) fn drawn(&self, q: &[f64; 6]) -> Pose {
        self.geometry.forward(&self.geometry.model_angles(q, self.third_axis))
    }

    /// How weight and gears turn each joint by a unit of each of their parameters, and by all of them, rad.
    fn turned(&self, theta: &[f64; 6], yielding: &[f64]) -> ([[f64; WEIGHT + GEARS]; 6], [f64; 6]) {
        let weighed = self.weighing.as_ref().map(|weighing| weighing.yields(&self.geometry, &self.transmission, theta));
        let joints = match weighed {
            None => self.transmission * of_terms(theta),
            Some(yields) => {
                let mut drives = SMatrix::<f64, 6, WEIGHT>::zeros();
                for (i, nominal) in yields.iter().enumerate() {
                    drives[(i, i)] = nominal * yielding[i].exp();
                }
                self.transmission * drives
            }
        };
        let parts = std::array::from_fn(|i| {
            let mut row = [0.0; WEIGHT + GEARS];
            for (j, part) in row.iter_mut().take(WEIGHT).enumerate() {
                *part = joints[(i, j)];
            }
            let (sine, cosine) = theta[i].sin_cos();
            [row[WEIGHT + 2 * i], row[WEIGHT + 2 * i + 1]] = [sine, cosine];
            row
        });
        // `k e^x` is its own derivative; all else is linear.
        let times = |j: usize| if weighed.is_some() && j < WEIGHT { 1.0 } else { yielding[j] };
        let all = std::array::from_fn(|i| {
            let row: &[f64; WEIGHT + GEARS] = &parts[i];
            row.iter().enumerate().map(|(j, part)| part * times(j)).sum()
        });
        (parts, all)
    }

    /// By how much weight and gears turn each joint, rad, by the parameters behind those of the frames: as [`Self::turned`], without its parts.
    pub(super) fn yielded(&self, theta: &[f64; 6], yielding: &[f64]) -> [f64; 6] {
        let (weight, gears) = yielding.split_at(WEIGHT);
        let drives = match &self.weighing {
            None => of_terms(theta) * SVector::<f64, WEIGHT>::from_column_slice(weight),
            Some(weighing) => {
                let nominal = weighing.yields(&self.geometry, &self.transmission, theta);
                Vector6::from_fn(|i, _| nominal[i] * weight[i].exp())
            }
        };
        let joints = self.transmission * drives;
        std::array::from_fn(|i| {
            let [of_sine, of_cosine] = [gears[2 * i], gears[2 * i + 1]];
            let is_even = of_sine == 0.0 && of_cosine == 0.0;
            joints[i] + if is_even { 0.0 } else { of_sine * theta[i].sin() + of_cosine * theta[i].cos() }
        })
    }

    /// The links between joints whose frames are shifted and turned by parameters.
    pub(super) fn links(&self, parameters: &[f64]) -> Links {
        std::array::from_fn(|i| {
            let [shift, turn] = [0, 3].map(|first| Vector3::from_fn(|j, _| parameters[6 * i + first + j]));
            let before = i.checked_sub(1).map_or_else(Vector3::zeros, |before| self.points[before]);
            (self.points[i] - before + shift, Rotation3::new(turn).into_inner())
        })
    }

    /// Goes from joint to joint, each turned by its angle, rad, to the flange.
    #[inline]
    pub(super) fn walk(&self, links: &Links, angles: &[f64; 6], mut each: impl FnMut(usize, Joint)) -> Placement {
        let (mut centre, mut carrier) = (Vector3::zeros(), Matrix3::identity());
        for (i, (link, turn)) in links.iter().enumerate() {
            centre += carrier * link;
            let frame = carrier * turn;
            each(i, Joint { carrier, centre, axis: frame.column(JOINT_AXES[i]).into() });
            carrier = turned_about(&frame, JOINT_AXES[i], angles[i]);
        }
        (centre + carrier.column(2) * self.geometry.c4, carrier)
    }

    /// The flange, and how each parameter moves it.
    pub(crate) fn chain(&self, parameters: &[f64], q: &[f64; 6]) -> Chain {
        let theta = self.geometry.model_angles(q, self.third_axis);
        let (turned, more) = self.turned(&theta, &parameters[FRAMES..]);
        let angles = std::array::from_fn(|i| theta[i] + more[i]);
        let mut twists = vec![[Vector3::zeros(); 2]; ALL];
        let flange = self.walk(&self.links(parameters), &angles, |i, Joint { carrier, centre, axis }| {
            let left = carrier * left_jacobian(&Vector3::from_fn(|j, _| parameters[6 * i + 3 + j]));
            for j in 0..3 {
                twists[6 * i + j] = [carrier.column(j).into(), Vector3::zeros()];
                let about = left.column(j).into();
                twists[6 * i + 3 + j] = [centre.cross(&about), about];
            }
            for (part, twist) in turned[i].iter().zip(&mut twists[FRAMES..]) {
                twist[0] += centre.cross(&axis) * *part;
                twist[1] += axis * *part;
            }
        });
        Chain { flange: pose(flange), twists }
    }
}

/// How a unit of each term of weight turns each drive, of an arm of which nothing is known but its joints.
fn of_terms(theta: &[f64; 6]) -> SMatrix<f64, 6, WEIGHT> {
    let mut drives = SMatrix::zeros();
    let (s2, c2) = theta[1].sin_cos();
    let (s23, c23) = (theta[1] + theta[2]).sin_cos();
    let (s5, c5) = theta[4].sin_cos();
    let c4 = theta[3].cos();
    for (i, part) in [s2, c2, s23, c23].into_iter().enumerate() {
        drives[(1, i)] = part;
    }
    [drives[(2, 4)], drives[(2, 5)]] = [s23, c23];
    // -(e5 x v) z with v along the tool axis, and along the line that e5 turns it to.
    [drives[(4, 6)], drives[(4, 7)]] = [c5 * c4 * s23 + s5 * c23, c5 * c23 - s5 * c4 * s23];
    drives
}

/// `d exp(w) = exp(J dw) exp(w)`, to the third power of `w`, which is some mrad.
fn left_jacobian(w: &Vector3<f64>) -> Matrix3<f64> {
    let cross = w.cross_matrix();
    Matrix3::identity() + cross / 2.0 + cross * cross / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::{own_turns, zeros};
    use crate::catalogue::paper_robots;

    fn random(rng: &mut fastrand::Rng, size: f64) -> Vec<f64> {
        (0..ALL).map(|_| size * (2.0 * rng.f64() - 1.0)).collect()
    }

    #[test]
    fn an_arm_without_errors_stands_as_drawn() {
        let mut rng = fastrand::Rng::with_seed(1);
        for robot in paper_robots() {
            let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!("six axes") };
            let q: [f64; 6] = std::array::from_fn(|_| 4.0 * (rng.f64() - 0.5));
            let drawn = geometry.forward(&geometry.model_angles(&q, limits.third_axis));
            let found = Errors::NONE.flange(&robot, &q).unwrap();
            // Metres, a dozen operations.
            assert!((drawn.translation.vector - found.translation.vector).norm() < 1e-13 * 100.0, "{}", robot.name);
            assert!(drawn.rotation.angle_to(&found.rotation) < 1e-7, "an angle near zero is a root of rounding");
        }
    }

    #[test]
    fn the_twists_are_what_differences_of_the_flange_give() {
        let mut rng = fastrand::Rng::with_seed(2);
        for robot in paper_robots() {
            let arm = Frames::of(&robot).unwrap();
            let q: [f64; 6] = std::array::from_fn(|_| 4.0 * (rng.f64() - 0.5));
            let parameters = random(&mut rng, 5e-3);
            let Chain { flange, twists } = arm.chain(&parameters, &q);
            for i in 0..ALL {
                let h = 1e-6;
                let moved = |step: f64| {
                    let mut parameters = parameters.clone();
                    parameters[i] += step;
                    arm.chain(&parameters, &q).flange
                };
                let (ahead, behind) = (moved(h), moved(-h));
                let along = (ahead.translation.vector - behind.translation.vector) / (2.0 * h);
                let about = (ahead.rotation * behind.rotation.inverse()).scaled_axis() / (2.0 * h);
                let [v, w] = twists[i];
                // Rounding 1e-15 m over 2e-6; the left Jacobian is left out from the third power of 9 mrad.
                assert!((v + w.cross(&flange.translation.vector) - along).norm() < 2e-7, "{i}: {}", robot.name);
                assert!((w - about).norm() < 2e-7, "{i}: {}", robot.name);
            }
        }
    }

    /// Moments of a weight about the axes of the drives, by vectors: what the terms of the own weight are made of.
    #[test]
    fn the_terms_of_weight_are_moments_of_masses_on_the_links() {
        let mut rng = fastrand::Rng::with_seed(3);
        let robot = paper_robots().into_iter().find(|robot| robot.name == "KR 210 R2700 extra").unwrap();
        let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!("six axes") };
        let arm = Frames::of(&robot).unwrap();
        for _ in 0..50 {
            let q: [f64; 6] = std::array::from_fn(|_| 4.0 * (rng.f64() - 0.5));
            let theta = geometry.model_angles(&q, limits.third_axis);
            let (turned, _) = arm.turned(&theta, &[0.0; WEIGHT + GEARS]);
            let axes = geometry.jacobian(&theta, &Vector3::zeros());
            let axis = |i: usize| -> Vector3<f64> { axes.fixed_view::<3, 1>(3, i).into() };
            let [_, shoulder, elbow, _, flange] = geometry.points(&theta).map(Vector3::from);
            let down = -Vector3::z();
            let moment = |i: usize, arm: Vector3<f64>| axis(i).dot(&arm.cross(&down));
            let upper = (elbow - shoulder).normalize();
            let tool = geometry.forward(&theta).rotation * Vector3::z();
            assert!((moment(1, upper) - turned[1][0]).abs() < 1e-12 && flange.norm() > 0.0);
            assert!((moment(4, tool) - turned[4][6]).abs() < 1e-12);
            assert!((moment(4, axis(4).cross(&tool)) - turned[4][7]).abs() < 1e-12);
            let forearm = axis(3);
            assert!((moment(2, forearm) - turned[2][4]).abs() < 1e-12);
            assert!((moment(2, axis(2).cross(&forearm)) - turned[2][5]).abs() < 1e-12);
        }
    }

    #[test]
    fn zeros_of_the_pendant_are_turns_about_the_joints_axes() {
        for robot in paper_robots() {
            let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("six axes") };
            for third_axis in [ThirdAxis::Elbow, ThirdAxis::Forearm] {
                let zero = [1e-3, -2e-3, 3e-3, 4e-3, -5e-3, 6e-3];
                let own = own_turns(geometry, third_axis, &zero);
                let mut frames = [[0.0; 6]; 6];
                (0..6).for_each(|i| frames[i][3 + JOINT_AXES[i]] = own[i]);
                let back = zeros(geometry, third_axis, &frames);
                assert!(zero.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-15));
                // Turned by them the arm stands as at angles as reported to which they are added.
                let mut robot = robot.clone();
                if let Arm::SixAxis { limits, .. } = &mut robot.arm {
                    limits.third_axis = third_axis;
                }
                let q = [0.1, -0.9, 1.2, 0.3, 0.8, -0.4];
                let turned = Errors { frames, ..Errors::NONE }.flange(&robot, &q).unwrap();
                let added = Errors::NONE.flange(&robot, &std::array::from_fn(|i| q[i] + zero[i])).unwrap();
                assert!((turned.translation.vector - added.translation.vector).norm() < 1e-12, "{}", robot.name);
            }
        }
    }
}
