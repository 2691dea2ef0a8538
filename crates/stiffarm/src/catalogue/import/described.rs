//! How do the links of a description move with the arm that was found in it?

use std::collections::HashMap;

use nalgebra::{UnitQuaternion, Vector3};

use super::ImportError;
use super::chain::Chain;
use super::urdf::{Joint, Kind, Urdf};
use crate::catalogue::reader::shown;
use crate::spatial::Pose;

/// A description with the arm that was found in it.
pub(super) struct Described<'a> {
    pub(super) text: &'a str,
    pub(super) file: &'a str,
    pub(super) urdf: &'a Urdf,
    pub(super) chain: &'a Chain,
    /// By which the base stands aside of the description's.
    pub(super) moved: Vector3<f64>,
}

impl Described<'_> {
    /// The description's base in that of the robot file.
    pub(super) fn base(&self) -> Pose {
        Pose::from_parts((-self.moved).into(), UnitQuaternion::identity())
    }

    /// Every link that the arm carries with the number of the arm's link and its frame at these joint angles, from the moved base; and those that
    /// move in another way.
    pub(super) fn carried(&self, q: &[f64; 6]) -> (HashMap<&str, (usize, Pose)>, Vec<&str>) {
        let mut joints: HashMap<&str, Vec<&Joint>> = HashMap::new();
        for joint in &self.urdf.joints {
            joints.entry(&joint.parent).or_default().push(joint);
        }
        let base = self.chain.base.as_str();
        let mut found = HashMap::from([(base, (0, self.base()))]);
        let (mut left_out, mut open) = (Vec::new(), vec![base]);
        while let Some(link) = open.pop() {
            for joint in joints.get(link).into_iter().flatten() {
                let of_arm = self.chain.joints.iter().position(|own| own.name == joint.name);
                let carrier = found.get(link).copied();
                match (of_arm, &joint.kind, carrier) {
                    (Some(i), _, Some((_, pose))) => {
                        let turned = joint.origin * Pose::rotation(joint.axis.into_inner() * q[i]);
                        found.insert(&joint.child, (i + 1, pose * turned));
                    }
                    (None, Kind::Fixed, Some((number, pose))) => {
                        found.insert(&joint.child, (number, pose * joint.origin));
                    }
                    _ => left_out.push(joint.child.as_str()),
                }
                open.push(&joint.child);
            }
        }
        (found, left_out)
    }

    pub(super) fn fault(&self, link: &str, why: impl Into<String>) -> ImportError {
        ImportError::Bodies { file: self.file.into(), link: shown(link), why: why.into() }
    }
}
