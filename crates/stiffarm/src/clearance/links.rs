//! Where do the links of a robot stand in a posture?

use nalgebra::Vector3;

use super::Link;
use super::solid::Capsule;
use crate::body::Body;
use crate::geometry::Geometry;
use crate::spatial::Pose;

/// The tool as a link: its point in the flange frame, m, and the radius of what stands between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tool {
    pub(super) point: Vector3<f64>,
    pub(super) radius: f64,
}

/// Capsules along the links at model angles, m from the base, the column from so far below it; some links have two.
///
/// The wrist ends at the flange, or, where it is thicker than long, is a ball about its centre. The column stands on the joint-1 axis and reaches out to the joint-2 axis as thick as the upper arm; the forearm keeps its
/// offset from the elbow.
pub(super) fn links(
    geometry: &Geometry,
    body: &Body,
    pedestal: f64,
    theta: &[f64; 6],
    tool: Option<Tool>,
) -> Vec<(Link, Capsule)> {
    let [t1, t2, t3, ..] = *theta;
    let [_, shoulder, elbow, wrist, flange] = geometry.points(theta).map(Vector3::from);
    let (s1, c1) = t1.sin_cos();
    let (s23, c23) = (t2 + t3).sin_cos();
    let bend = elbow + geometry.a2 * Vector3::new(c1 * c23, s1 * c23, -s23);
    let foot = Vector3::new(0.0, 0.0, -pedestal);
    let top = Vector3::new(0.0, 0.0, geometry.c1);
    // Its round end does not reach beyond the flange.
    let shown = (1.0 - body.wrist / geometry.c4.abs().max(body.wrist)).max(0.0);
    let capsule = |link, ends: [Vector3<f64>; 2], radius| (link, Capsule { ends, radius });
    let mut links = vec![
        capsule(Link::Column, [foot, top], body.column),
        capsule(Link::Column, [top, shoulder], body.upper_arm),
        capsule(Link::UpperArm, [shoulder, elbow], body.upper_arm),
        capsule(Link::Forearm, [elbow, bend], body.forearm),
        capsule(Link::Forearm, [bend, wrist], body.forearm),
        capsule(Link::Wrist, [wrist, wrist + (flange - wrist) * shown], body.wrist),
    ];
    links.extend(tool.map(|Tool { point, radius }| {
        let base_from_flange: Pose = geometry.forward(theta);
        capsule(Link::Tool, [flange, base_from_flange.transform_point(&point.into()).coords], radius)
    }));
    links
}
