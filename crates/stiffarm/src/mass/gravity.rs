//! How does weight turn the joints of an arm?

use nalgebra::{Point3, Vector3, Vector6};

use super::{Carrier, Mass};
use crate::geometry::Geometry;
use crate::spatial::Pose;

/// m/s^2.
pub const GRAVITY: f64 = 9.806_65;

/// The torque of weight about each model angle, N m, of bodies whose base stands upright: `-dV/dtheta` of the potential energy `V`.
pub fn gravity_torques(geometry: &Geometry, theta: &[f64; 6], masses: &[Mass]) -> Vector6<f64> {
    let (links, axes) = (geometry.links(theta), geometry.axes(theta));
    let (across, shoulder) = axes[1];
    let forearm = shoulder_turned(geometry, &links[0], theta[1] + theta[2]);
    let mut torques = Vector6::zeros();
    for Mass { carrier, body } in masses {
        let weight = body.mass * GRAVITY;
        let about = |axis: Vector3<f64>, lever: Vector3<f64>| -weight * axis.cross(&lever).z;
        match carrier {
            Carrier::Base => {}
            Carrier::Link(link) => {
                let centre = (links[link - 1] * Point3::from(body.centre)).coords;
                for (joint, (axis, through)) in axes[..*link].iter().enumerate() {
                    torques[joint] += about(*axis, centre - through);
                }
            }
            Carrier::Counterweight => {
                let lever = (forearm * Point3::from(body.centre)).coords - shoulder;
                torques[1] += about(across, lever);
                torques[2] += about(across, lever);
            }
            // Its end on the crank turns with the forearm, and it stays parallel to the upper arm.
            Carrier::Rod { crank: [ahead, up] } => {
                let end_at_zero = geometry.shoulder_at_zero() + Vector3::new(*ahead, 0.0, *up);
                let end = (forearm * Point3::from(end_at_zero)).coords - shoulder;
                let own = links[1].rotation * (body.centre - end_at_zero);
                torques[1] += about(across, end + own);
                torques[2] += about(across, end);
            }
        }
    }
    torques
}

/// What turns about the joint-2 axis by an angle, rad, behind the link of joint 1.
fn shoulder_turned(geometry: &Geometry, first: &Pose, angle: f64) -> Pose {
    let shoulder = geometry.shoulder_at_zero();
    let turn = nalgebra::UnitQuaternion::new(Vector3::y() * angle);
    first * Pose::from_parts((shoulder - turn * shoulder).into(), turn)
}
