//! Where is the flange?

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::chain::Chain;
use super::joint_axis::Axis;
use super::{MEETS_M, REPORTED_DEG, REPORTED_M, STRAIGHT_DEG};
use crate::catalogue::reader::{Log, shown};
use crate::spatial::Pose;

/// A flange nearer than this to the wrist centre, m, does not say which way is out.
const NO_LENGTH: f64 = 1e-3;

/// The flange at joint zero: its centre on axis 6, its z axis out along axis 6.
#[derive(Debug)]
pub(super) struct Flange {
    pub(super) centre: Point3<f64>,
    /// Away from the wrist centre, along axis 6.
    pub(super) out: Vector3<f64>,
    pub(super) turned: UnitQuaternion<f64>,
    /// The frame of the description in that of the sixth moving link: its centre where it stands, its z axis turned outwards
    /// by the angle that is said, and not onto axis 6 exactly.
    pub(super) in_link: Pose,
    /// Which frame was taken, and how it was turned.
    pub(super) note: String,
    /// How the frame stands otherwise than a flange on axis 6.
    pub(super) left: Vec<String>,
}

/// Takes the frame of link `tip`, else of a link named flange or tool0, else of the sixth moving link.
///
/// `None` where the frame that the user named does not stand on axis 6.
pub(super) fn flange(
    chain: &Chain,
    tip: Option<&str>,
    axis: &Axis,
    wrist: &Point3<f64>,
    forearm: &Vector3<f64>,
    log: &Log,
) -> Option<Flange> {
    let link = chain.forward(&[0.0; 6]);
    let ends: Vec<(&str, Pose)> = chain.ends.iter().map(|(name, pose)| (name.as_str(), link * pose)).collect();
    let aside = |pose: &Pose| {
        let centre = Point3::from(pose.translation.vector);
        (centre - axis.nearest(&centre)).norm()
    };
    let z_lies_along = |pose: &Pose| {
        let z = pose.rotation * Vector3::z();
        z.cross(&axis.along).norm() <= STRAIGHT_DEG.to_radians()
    };
    let on_axis = |pose: &Pose| aside(pose) <= MEETS_M;
    let named = |word: &str, along: bool| {
        ends.iter().find(|(name, pose)| name.ends_with(word) && on_axis(pose) && (!along || z_lies_along(pose)))
    };
    let (name, pose) = match tip {
        Some(tip) => {
            // A link further out on the arm than the sixth moving one is among its ends.
            let end = ends.iter().find(|(name, _)| *name == tip)?;
            if !on_axis(&end.1) {
                let joint = &chain.joints[5];
                let off = aside(&end.1) * 1e3;
                let message =
                    format!("link '{}' stands {off:.1} mm beside axis 6; expected a flange on it", shown(tip));
                log.add(joint.place, &joint.key(), message);
                return None;
            }
            end
        }
        None => named("flange", true)
            .or_else(|| named("tool0", true))
            .or_else(|| named("flange", false))
            .or_else(|| named("tool0", false))
            .unwrap_or(&ends[0]),
    };
    let centre = axis.nearest(&pose.translation.vector.into());
    let z = pose.rotation * Vector3::z();
    let from_wrist = (centre - wrist).dot(&axis.along);
    let outwards = if NO_LENGTH < from_wrist.abs() {
        from_wrist
    } else if z_lies_along(pose) {
        z.dot(&axis.along)
    } else {
        axis.along.dot(forearm)
    };
    let out = axis.along * 1_f64.copysign(outwards);
    let onto = least_turn(&z, &out, &(pose.rotation * Vector3::x()));
    let turned = onto * pose.rotation;
    // Frames turned by right angles are a custom; what is left beside one is a lean.
    let angle = onto.angle();
    let square = (angle / FRAC_PI_2).round() * FRAC_PI_2;
    let lean = (angle - square).abs();
    let meant = if lean.to_degrees() <= STRAIGHT_DEG { square } else { angle };
    let said = onto.axis().map_or(UnitQuaternion::identity(), |about| UnitQuaternion::from_axis_angle(&about, meant));
    let stands = Pose::from_parts(pose.translation, said * pose.rotation);
    let mut left = Vec::new();
    if REPORTED_M < aside(pose) {
        left.push(format!("link '{}' stands {:.3} mm beside axis 6", shown(name), aside(pose) * 1e3));
    }
    if meant == square && REPORTED_DEG < lean.to_degrees() {
        left.push(format!("link '{}' leans by {:.4} deg against axis 6", shown(name), lean.to_degrees()));
    }
    let called = |name: &str| name.ends_with("flange") || name.ends_with("tool0");
    let passed_over = ends.iter().filter(|(end, pose)| tip.is_none() && !called(name) && called(end) && !on_axis(pose));
    left.extend(passed_over.map(|(end, pose)| {
        format!("link '{}' stands {:.1} mm beside axis 6 and is taken for no flange", shown(end), aside(pose) * 1e3)
    }));
    let about = onto.axis().map(|axis| pose.rotation.inverse() * axis.into_inner());
    let note = note(name, angle.to_degrees(), about.as_ref(), from_wrist.abs() <= NO_LENGTH, tip.is_some());
    Some(Flange { centre, out, turned, in_link: link.inverse() * stands, note, left })
}

/// The least turn that brings the unit vector `from` onto `to`; about `spare` where they are opposite.
fn least_turn(from: &Vector3<f64>, to: &Vector3<f64>, spare: &Vector3<f64>) -> UnitQuaternion<f64> {
    let across = from.cross(to);
    let angle = across.norm().atan2(from.dot(to));
    let about = across.try_normalize(1e-12).unwrap_or(*spare);
    UnitQuaternion::from_scaled_axis(about * angle)
}

/// Which frame was taken, and how it was turned: about an axis of its own.
fn note(name: &str, turned_deg: f64, about: Option<&Vector3<f64>>, at_wrist: bool, is_chosen: bool) -> String {
    let turned = match about {
        Some(about) if STRAIGHT_DEG < turned_deg => {
            let about = axis_name(about);
            format!(", turned by {turned_deg:.1} deg about its {about} so that its z axis points out along axis 6")
        }
        _ => String::new(),
    };
    let at_wrist = match (at_wrist, is_chosen) {
        (false, _) => "",
        (true, true) => "; it stands at the wrist centre, so c4 is 0",
        (true, false) => "; it stands at the wrist centre, so c4 is 0: name the link of the flange if there is another",
    };
    format!("flange: the frame of link '{}'{turned}{at_wrist}", shown(name))
}

/// `x axis`, or the direction where it is none of the three; turning about the reverse is turning back, so the sign counts.
fn axis_name(about: &Vector3<f64>) -> String {
    let [x, y, z] = [about.x, about.y, about.z].map(|part| (part * 1e3).round() / 1e3 + 0.0);
    for (name, part) in [("x", x), ("y", y), ("z", z)] {
        if part.abs() == 1.0 {
            return format!("{}{name} axis", if part < 0.0 { "-" } else { "" });
        }
    }
    format!("axis ({x}, {y}, {z})")
}
