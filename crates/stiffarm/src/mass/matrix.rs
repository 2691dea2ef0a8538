//! How hard is an arm to turn? The mass matrix of a posture, by formulas that hold for numbers and for affine forms alike.

use nalgebra::{Matrix6, Vector3};

use super::{Carrier, Mass, RigidBody};
use crate::geometry::Geometry;
use crate::real::{Real, cross, dot};

/// Where the parts of an arm point, in axes that turn with joint 1: x forwards in the arm plane, y across it to the left, z up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkDirections<T> {
    /// Of the upper arm in the arm plane, forwards and up: sine and cosine of theta 2.
    pub(crate) upper: [T; 2],
    /// Of the forearm: sine and cosine of theta 2 + theta 3.
    pub(crate) forearm: [T; 2],
    /// A unit vector.
    pub(crate) axis_5: [T; 3],
    /// A unit vector: the flange's z.
    pub(crate) axis_6: [T; 3],
    /// A unit vector: the flange's x.
    pub(crate) flange_x: [T; 3],
}

/// The inertia of bodies as seen in the six model angles: `M = sum m Jv^T Jv + Jw^T I Jw`, kg m^2, at the model angles `theta`, rad.
///
/// The kinetic energy is `1/2 theta'^T M theta'`. What the arm holds is one of the bodies ([`Mass::held`]).
pub fn mass_matrix(geometry: &Geometry, theta: &[f64; 6], masses: &[Mass]) -> Matrix6<f64> {
    let sum = inertia_of(geometry, &LinkDirections::at(geometry, theta), masses);
    Matrix6::from_fn(|i, j| sum[i.max(j)][i.min(j)])
}

/// The same of an arm whose links point so; what is on and below the diagonal, row by row, zero above it.
pub(crate) fn inertia_of<T: Real>(geometry: &Geometry, directions: &LinkDirections<T>, masses: &[Mass]) -> [[T; 6]; 6] {
    let links = Links::of(geometry, directions);
    let mut sum = [[links.zero; 6]; 6];
    for Mass { carrier, body } in masses {
        match carrier {
            Carrier::Base => {}
            Carrier::Link(link) => links.add_link(&mut sum, *link, body),
            Carrier::Counterweight => links.add_counterweight(&mut sum, body),
            Carrier::Rod { crank } => links.add_rod(&mut sum, *crank, body),
        }
    }
    sum
}

impl LinkDirections<f64> {
    /// At the model angles `theta`, rad.
    fn at(geometry: &Geometry, theta: &[f64; 6]) -> Self {
        let [_, t2, t3, t4, t5, t6] = *theta;
        let axes = geometry.axes(&[0.0, t2, t3, t4, t5, t6]);
        let (axis_5, axis_6) = (axes[4].0, axes[5].0);
        let (s6, c6) = t6.sin_cos();
        Self {
            upper: t2.sin_cos().into(),
            forearm: (t2 + t3).sin_cos().into(),
            axis_5: axis_5.into(),
            axis_6: axis_6.into(),
            flange_x: (axis_5.cross(&axis_6) * c6 + axis_5 * s6).into(),
        }
    }
}

/// The links of an arm, in the axes of [`LinkDirections`].
struct Links<T> {
    zero: T,
    /// The axis of each joint.
    axes: [[T; 3]; 6],
    /// The x, y and z of each link, which at model zero are those of the base.
    frames: [[[T; 3]; 3]; 6],
    /// From a point of the axis of each joint to one of the next, m; the axes 4, 5 and 6 meet in the wrist centre.
    steps: [[T; 3]; 5],
    /// A point of the axis of each joint at model zero, m from the base.
    at_zero: [Vector3<f64>; 6],
}

/// How a body moves with the first joints: its centre, m per rad, and its turn, in its own axes.
type Column<T> = ([T; 3], [T; 3]);

impl<T: Real> Links<T> {
    fn of(geometry: &Geometry, directions: &LinkDirections<T>) -> Self {
        let LinkDirections { upper: [s2, c2], forearm: [s23, c23], axis_5, axis_6, flange_x } = *directions;
        let zero = s2 * 0.0;
        let one = zero + 1.0;
        let (ahead, across, up) = ([one, zero, zero], [zero, one, zero], [zero, zero, one]);
        let along = [s23, zero, c23];
        let frames = [
            [ahead, across, up],
            [[c2, zero, -s2], across, [s2, zero, c2]],
            [[c23, zero, -s23], across, along],
            [cross(axis_5, along), axis_5, along],
            [cross(axis_5, axis_6), axis_5, axis_6],
            [flange_x, cross(axis_6, flange_x), axis_6],
        ];
        let shoulder = geometry.shoulder_at_zero();
        let (to_elbow, to_wrist) = (Vector3::z() * geometry.c2, Vector3::new(geometry.a2, 0.0, geometry.c3));
        let (elbow, wrist) = (shoulder + to_elbow, shoulder + to_elbow + to_wrist);
        let none = [zero; 3];
        Self {
            zero,
            axes: [up, across, across, along, axis_5, axis_6],
            steps: [
                carried(&frames[0], &shoulder),
                carried(&frames[1], &to_elbow),
                carried(&frames[2], &to_wrist),
                none,
                none,
            ],
            frames,
            at_zero: [Vector3::zeros(), shoulder, elbow, wrist, wrist, wrist],
        }
    }

    /// Adds a body of the link that this joint, from 1, turns.
    fn add_link(&self, sum: &mut [[T; 6]; 6], link: usize, body: &RigidBody) {
        let frame = &self.frames[link - 1];
        let mut lever = carried(frame, &(body.centre - self.at_zero[link - 1]));
        let mut columns = [([self.zero; 3], [self.zero; 3]); 6];
        for joint in (0..link).rev() {
            columns[joint] = (cross(self.axes[joint], lever), seen(frame, self.axes[joint]));
            if let Some(before) = joint.checked_sub(1) {
                lever = plus(lever, self.steps[before]);
            }
        }
        add_columns(sum, &columns[..link], body);
    }

    /// Adds a body that turns by theta 2 + theta 3 about the joint-2 axis.
    fn add_counterweight(&self, sum: &mut [[T; 6]; 6], body: &RigidBody) {
        let (frame, [up, across, ..]) = (&self.frames[2], &self.axes);
        let lever = carried(frame, &(body.centre - self.at_zero[1]));
        let turned = (cross(*across, lever), seen(frame, *across));
        let about_1 = (cross(*up, plus(lever, self.steps[0])), seen(frame, *up));
        add_columns(sum, &[about_1, turned, turned], body);
    }

    /// Adds the rod: its end on the crank turns by theta 2 + theta 3 about the joint-2 axis, and it turns itself by theta 2.
    fn add_rod(&self, sum: &mut [[T; 6]; 6], [ahead, up]: [f64; 2], body: &RigidBody) {
        let (frame, [axis_1, across, ..]) = (&self.frames[1], &self.axes);
        let to_end = Vector3::new(ahead, 0.0, up);
        let (end, lever) =
            (carried(&self.frames[2], &to_end), carried(frame, &(body.centre - self.at_zero[1] - to_end)));
        let from_shoulder = plus(end, lever);
        let columns = [
            (cross(*axis_1, plus(from_shoulder, self.steps[0])), seen(frame, *axis_1)),
            (cross(*across, from_shoulder), seen(frame, *across)),
            (cross(*across, end), [self.zero; 3]),
        ];
        add_columns(sum, &columns, body);
    }
}

/// Adds a body that moves by these columns with the first joints.
fn add_columns<T: Real>(sum: &mut [[T; 6]; 6], columns: &[Column<T>], body: &RigidBody) {
    for (i, (moved, turned)) in columns.iter().enumerate() {
        let resisted: [T; 3] = std::array::from_fn(|row| {
            let [x, y, z] = [0, 1, 2].map(|column| turned[column] * body.inertia[(row, column)]);
            x + y + z
        });
        for (part, (other_moved, other_turned)) in sum[i].iter_mut().zip(&columns[..=i]) {
            *part = *part + dot(*moved, *other_moved) * body.mass + dot(resisted, *other_turned);
        }
    }
}

/// A vector that a link carries, given as it is at model zero.
fn carried<T: Real>([x, y, z]: &[[T; 3]; 3], at_zero: &Vector3<f64>) -> [T; 3] {
    std::array::from_fn(|i| x[i] * at_zero.x + y[i] * at_zero.y + z[i] * at_zero.z)
}

/// A vector as a link sees it: the inverse of [`carried`].
fn seen<T: Real>([x, y, z]: &[[T; 3]; 3], v: [T; 3]) -> [T; 3] {
    [dot(*x, v), dot(*y, v), dot(*z, v)]
}

fn plus<T: Real>([ax, ay, az]: [T; 3], [bx, by, bz]: [T; 3]) -> [T; 3] {
    [ax + bx, ay + by, az + bz]
}
