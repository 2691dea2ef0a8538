//! What holds at every placement of a node: which poses no posture reaches, and how compliant the others are at least?

use nalgebra::Vector3;

use super::affine::{Affine, Vector};
use super::bounds::NodeBounds;
use super::continuity::{JointDirections, TurnExtent};
use super::links::{ArmView, Links, angle, seen_from_forearm, unit};
use super::node::WorkPlaneEnclosure;
use super::prepared::{ArmEnclosure, ToolFrameEnclosure};
use crate::interval::Interval;
use crate::inverse::{ArmBranch, Configuration, Wrist};
use crate::mass::LinkDirections;
use crate::plane::Elbow;
use crate::tolerances;
use crate::work::{WorkPlacement, WorkPlane};

/// Ranges of theta 1 to 6 and of the forearm's angle, `theta 2 + theta 3`.
pub(crate) type Angles = [Interval; 7];

impl ArmEnclosure {
    /// Adds what holds wherever the pose at a point of the zone is held in an arm branch with one of the `wrists`, and takes away the
    /// wrists that are impossible; `None` where no placement of the node allows the pose.
    ///
    /// Joints 1, 4 and 6 stay within a quarter turn of their directions at the `centre` of the zone. The answer is their
    /// directions here; inner `None` where they are not known. Where the wrists are not alike, at most one may be asked for.
    pub(crate) fn add_constraints<const N: usize>(
        &self,
        tool_frame: &ToolFrameEnclosure<N>,
        at: [f64; 2],
        branch: ArmBranch,
        centre: Option<(&JointDirections<N>, &mut TurnExtent)>,
        wrists: &mut [bool; 2],
        bounds: &mut NodeBounds<N>,
    ) -> Option<Option<JointDirections<N>>> {
        let view = self.view(tool_frame, at, branch)?;
        self.add_distance_bounds(&view, branch, bounds);
        let Some(links) = self.links(&view.wrist, branch, bounds)? else { return Some(None) };
        let [(s2, c2), (s23, c23)] = [links.upper, links.forearm].map(|[x, z]| (x, z));
        let one = Affine::point(1.0);
        let angular_limits = &self.arm.angular_limits;
        bounds.require_in(&angular_limits.joints[1], c2, s2, one)?;
        // Of theta 3.
        let (c3, s3) = (unit(c2 * c23 + s2 * s23), unit(c2 * s23 - s2 * c23));
        bounds.require_in(&angular_limits.elbow, c3, s3, one)?;
        match &angular_limits.multi_turn {
            Some(_) => self.check_third([c2, s2], [c3, s3])?,
            None if angular_limits.third_is_forearm => bounds.require_in(&angular_limits.joints[2], c23, s23, one)?,
            None => bounds.require_in(&angular_limits.joints[2], c3, s3, one)?,
        }
        let (fourth, sixth, c5) = seen_from_forearm(&view, &links);
        let [forwards, across] = fourth;
        let straight = self.arm.proof_clearance().sin();
        let clear = Interval::spanning(straight * straight, 1.0);
        let s5 = (forwards.square() + across.square()).concave(clear, |x| (x.sqrt(), 0.5 / x.sqrt()))?;
        let directions = JointDirections([view.first, fourth, sixth]);
        if let Some((centre, extent)) = centre {
            self.stay_on_branch(&directions, centre, extent, wrists, bounds)?;
        }
        self.exclude_wrists(&directions, s5, c5, wrists);
        if *wrists == [false; 2] {
            return None;
        }
        let inverse = s5.inverse(Interval::spanning(straight, 1.0)).filter(|_| straight < s5.min());
        let sign = if wrists[0] { 1.0 } else { -1.0 };
        let axis_5 = inverse.map(|inverse| {
            let (x, y) = (unit(-across * inverse * sign), unit(forwards * inverse * sign));
            [c23 * x, y, -(s23 * x)]
        });
        self.add_compliance_bounds(&view, &links, axis_5, bounds);
        Some(Some(directions))
    }

    /// The model angles with which a configuration holds all of a part of the work plane, up to whole turns: theta 1 to 6, and
    /// `theta 2 + theta 3`. `None` where they are not known, or some may be singular.
    pub(crate) fn angles(
        &self,
        plane: &WorkPlane,
        work: &WorkPlacement,
        part: [Affine<2>; 2],
        configuration: Configuration,
    ) -> Option<Angles> {
        let HeldPart { view, links, fourth, sixth, fifth: [c5, s5] } =
            self.held_part(plane, work, part, configuration)?;
        let [(s2, c2), (s23, c23)] = [links.upper, links.forearm].map(|[x, z]| (x, z));
        Some([
            angle(view.first[0], view.first[1])?,
            angle(c2, s2)?,
            angle(c2 * c23 + s2 * s23, c2 * s23 - s2 * c23)?,
            angle(fourth[0], fourth[1])?,
            angle(c5, s5)?,
            angle(sixth[0], sixth[1])?,
            angle(c23, s23)?,
        ])
    }

    /// Where the links point with which a configuration holds all of a part of the work plane, and the compliance of each drive there,
    /// rad/(N m). `None` as of [`Self::angles`].
    pub(crate) fn directions(
        &self,
        plane: &WorkPlane,
        work: &WorkPlacement,
        part: [Affine<2>; 2],
        configuration: Configuration,
    ) -> Option<(LinkDirections<Affine<2>>, [Affine<2>; 6])> {
        let HeldPart { view, links, fourth, fifth, .. } = self.held_part(plane, work, part, configuration)?;
        let [_, s5] = fifth;
        let length = if configuration.wrist == Wrist::Flip { -s5 } else { s5 };
        let inverse = length.inverse(Interval::spanning(tolerances::PROOF_CLEARANCE, 1.0))?;
        let [c4, s4] = fourth.map(|part| unit(part * inverse));
        let [s23, c23] = links.forearm;
        let compliances = self.drive_compliances(&links);
        let directions = LinkDirections {
            upper: links.upper,
            forearm: links.forearm,
            axis_5: [-(c23 * s4), c4, s23 * s4],
            axis_6: view.axis_6,
            flange_x: view.flange_x,
        };
        Some((directions, compliances))
    }

    /// How a configuration holds all of a part of the work plane. `None` as of [`Self::angles`].
    fn held_part(
        &self,
        plane: &WorkPlane,
        work: &WorkPlacement,
        part: [Affine<2>; 2],
        configuration: Configuration,
    ) -> Option<HeldPart> {
        let [wrist_to_tool, axis_6, flange_x] =
            [self.wrist_to_tool, self.axis_6, self.flange_x].map(|v| <[f64; 3]>::from(plane.tool() * Vector3::from(v)));
        let fixed = |v: [f64; 3]| v.map(Affine::point);
        let points = plane_part(plane, work, part);
        let enclosed = WorkPlaneEnclosure::at(points, plane.tool());
        let tool_frame = ToolFrameEnclosure {
            plane: enclosed,
            wrist_to_tool: fixed(wrist_to_tool),
            axis_6: fixed(axis_6),
            flange_x: fixed(flange_x),
            push: None,
        };
        let branch = configuration.arm();
        let view = self.view(&tool_frame, [0.0; 2], branch)?;
        let square = view.wrist[0].square() + view.wrist[1].square();
        let ring = self.distance_rings[usize::from(branch.elbow == Elbow::Down)]?;
        if !(ring.min() < square.min() && square.max() < ring.max()) {
            return None;
        }
        let links = self.links(&view.wrist, branch, &mut NodeBounds::default()).flatten()?;
        let (fourth, sixth, c5) = seen_from_forearm(&view, &links);
        let square = fourth[0].square() + fourth[1].square();
        if !(tolerances::PROOF_CLEARANCE * tolerances::PROOF_CLEARANCE < square.min()) {
            return None;
        }
        let sign = if configuration.wrist == Wrist::Flip { -1.0 } else { 1.0 };
        let s5 = square.sqrt()? * sign;
        let (fourth, sixth) = (fourth.map(|x| x * sign), sixth.map(|x| x * sign));
        Some(HeldPart { view, links, fourth, sixth, fifth: [c5, s5] })
    }
}

/// How a configuration holds all of a part of the work plane.
struct HeldPart {
    view: ArmView<2>,
    links: Links<2>,
    /// Cosine and sine of theta 4, each times the length of the sine of theta 5.
    fourth: [Affine<2>; 2],
    /// The same of theta 6.
    sixth: [Affine<2>; 2],
    /// Cosine and sine of theta 5.
    fifth: [Affine<2>; 2],
}

/// All points of a part of the work plane, base axes.
fn plane_part(plane: &WorkPlane, work: &WorkPlacement, [u, v]: [Affine<2>; 2]) -> Vector<2> {
    let centre = [work.x, work.y, work.z];
    std::array::from_fn(|i| u * plane.first[i] + v * plane.second[i] + centre[i])
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, TAU};

    use super::*;
    use crate::batch::SpatialArm;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::drive::{GravityCompensator, JointCompliance, Transmission};
    use crate::enclose::middle;
    use crate::enclose::node::Node;
    use crate::enclose::prepared::TURNED_BY_ZONE;
    use crate::inverse::{postures, within_limits};
    use crate::load::{Component, Load};
    use crate::robot::{Arm, Robot};
    use crate::spatial::Pose;

    /// A robot of the paper with other drives and an offset; every other one with a geared wrist and a compensator.
    fn robot(n: usize, rng: &mut fastrand::Rng) -> Robot {
        let mut robot = paper_robots().swap_remove(n % 10);
        let Arm::SixAxis { geometry, drives, .. } = &mut robot.arm else { unreachable!("six axes") };
        drives.compliance = JointCompliance(std::array::from_fn(|_| 1e-6 * (0.3 + 3.0 * rng.f64())));
        if n.is_multiple_of(3) {
            geometry.b = 0.2 * (rng.f64() - 0.5);
        }
        if n.is_multiple_of(2) {
            let coupled = |i: usize, j: usize| if i >= 3 && j >= 3 && j < i { 0.1 * (i + j) as f64 } else { 0.0 };
            drives.transmission = Transmission(drives.transmission.0 + nalgebra::Matrix6::from_fn(coupled));
        }
        if n % 4 < 2 {
            let (base, arm) = ([-0.5, -0.1], [0.05, 0.4]);
            drives.compensator = Some(GravityCompensator { base, arm, stiffness: 2e5, free_length: 0.3 });
        }
        robot
    }

    /// The worst direction, and forces of which more is known.
    fn load(n: usize) -> Load {
        let mut rng = fastrand::Rng::with_seed(n as u64);
        let force = std::array::from_fn(|_| 2.0 * rng.f64() - 1.0);
        let feed = [None, Some(3.0 * rng.f64())][n / 4 % 2];
        let known = [Load::along_tool(force, feed), Load::along_base(force)][n / 8 % 2].clone().unwrap();
        let known = [known, Load::UNIT][usize::from(n % 32 == 5)];
        let component = [Component::Total, Component::Normal, Component::Along][n / 5 % 3];
        if n.is_multiple_of(2) {
            Load::UNIT
        } else {
            known.with_cone(rng.f64() * f64::from(n as u32 % 7 / 4)).unwrap().counting(component)
        }
    }

    #[test]
    fn no_stand_of_a_box_is_stiffer_than_it_says_or_held_where_it_says_none_is() {
        let mut rng = fastrand::Rng::with_seed(33);
        let (mut held, mut useful, mut refused) = (0, [0, 0], 0);
        for n in 0..6000 {
            let load = load(n);
            let robot = robot(n, &mut rng);
            let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
            let tool = Pose::new(
                Vector3::new(part(-0.2, 0.2), part(-0.2, 0.2), part(0.0, 0.4)),
                Vector3::new(part(-0.3, 0.3), part(-0.3, 0.3), part(-3.0, 3.0)),
            );
            let tool = if n % 5 < 2 { Pose::translation(0.0, 0.0, 0.3) } else { tool };
            let arm = SpatialArm::new(&robot, &tool).unwrap();
            let elevation = [-FRAC_PI_2, 0.0, part(-1.5, 1.5)][n % 3];
            let width = [0.4, 0.1, 0.02][n / 3 % 3];
            let from = [part(-2.3, 2.3), part(0.0, 2.2), part(-1.5, 1.5), part(0.0, 3.0), part(0.0, 6.0)];
            let node: Node = from.map(|from| Interval::spanning(from, from + width * part(0.1, 1.0)));
            let enclosure = ArmEnclosure::new(&arm, [false; 6]).under(load);
            let tool_frame = enclosure.tool_frame::<5>(elevation, &node);
            let at = [part(-0.3, 0.3), part(-0.3, 0.3)];
            let variables: [f64; 5] = std::array::from_fn(|_| part(-1.0, 1.0));
            let place: [f64; 5] = std::array::from_fn(|i| node[i].middle() + variables[i] * node[i].width() / 2.0);
            let [x, z, yaw, angle, roll] = place;
            let work = WorkPlacement { x, y: 0.0, z, yaw, angle, roll };
            let plane = WorkPlane::of(elevation, &work);
            let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { unreachable!("six axes") };
            let flange = |at| plane.pose(&work, at) * tool.inverse();
            let (here, centre) = (postures(geometry, &flange(at)), postures(geometry, &flange([0.0; 2])));
            for (configuration, theta) in here.found {
                let branch = configuration.arm();
                let mut wrists = [configuration.wrist == Wrist::NoFlip, configuration.wrist == Wrist::Flip];
                let asked = wrists;
                let mut at_centre = NodeBounds::default();
                let directions = enclosure
                    .add_constraints(&tool_frame, [0.0; 2], branch, None, &mut asked.clone(), &mut at_centre)
                    .flatten();
                // The directions at the centre say nothing of a posture that turned too far from there.
                let begun = centre.found.iter().find(|(other, _)| *other == configuration).map(|found| found.1);
                let near = begun.is_some_and(|begun| {
                    TURNED_BY_ZONE.iter().all(|&i| {
                        let turned = theta[i] - begun[i] - ((theta[i] - begun[i]) / TAU).round() * TAU;
                        let range = geometry.theta(i, limits.joints[i]);
                        let goes_on = |turns: i32| {
                            let from = begun[i] + f64::from(turns) * TAU;
                            range.contains(from, 0.0) && range.contains(from + turned, 0.0)
                        };
                        turned.abs() < FRAC_PI_2 && (-4..=4).any(goes_on)
                    })
                });
                let directions = if near { directions } else { None };
                let mut bounds = NodeBounds::default();
                let mut extent = TurnExtent::default();
                let from = directions.as_ref().map(|directions| (directions, &mut extent));
                let added = enclosure.add_constraints(&tool_frame, at, branch, from, &mut wrists, &mut bounds);
                let Some(q) = within_limits(geometry, limits, &theta) else {
                    refused += usize::from(added.is_none());
                    continue;
                };
                held += 1;
                let what = || format!("{n} {}: {configuration} at {work:?} in {node:?} under {load:?}", robot.name);
                assert!(added.is_some() && wrists == asked, "{}", what());
                let Ok(posture) = compliance(&robot, &q, &tool) else { continue };
                let value = posture.most(plane.forces(load).as_ref()).value;
                let rounding = 1e-9 * posture.compliance.worst().0;
                let linear = |x: &Affine<5>| x.centre + (0..5).map(|i| x.deviations[i] * variables[i]).sum::<f64>();
                for found in &bounds.values {
                    assert!(linear(found) - found.remainder <= value + rounding, "{} {found:?} {value}", what());
                    useful[usize::from(!load.is_worst())] += usize::from(0.5 * value < found.min());
                }
                for limit in &bounds.limits {
                    assert!(-1e-9 <= linear(limit) + limit.remainder, "{} {limit:?}", what());
                }
            }
            assert!(node[0].contains(middle(&node).x, 0.0));
        }
        let enough = 4000 < held && 1000 < useful[0] && 300 < useful[1] && 4000 < refused;
        assert!(enough, "{held} held, {useful:?} useful, {refused} refused");
    }
}
