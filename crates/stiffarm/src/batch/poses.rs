//! Which posture holds a pose of the tool best, and how compliant is every other? For many poses.

use nalgebra::Vector3;
use pulp::{Arch, Simd, WithSimd};

use super::branches::{BranchLanes, FlangePoses};
use super::counted::{AnyDirection, Counted};
use super::lanes::{Lanes, WIDEST};
use super::orientation::{RolledTool, ToolVectors};
use super::vectors::Triple;
use super::{SameBranch, SpatialArm};
use crate::inverse::Configuration;
use crate::parallel;
use crate::spatial::Pose;

/// Poses that one thread takes at a time.
const BLOCK: usize = 1024;

/// The stiffest way to hold a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Best {
    /// The largest translation per force in any direction, m/N.
    pub worst: f64,
    /// The posture.
    pub configuration: Configuration,
}

/// Every configuration of one pose, at its index.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AtRoll {
    pub(crate) roll: f64,
    /// What counts of the translation per force, m/N, whatever the limits; NaN where nothing holds joint 2.
    pub(crate) worst: [f64; Configuration::COUNT],
    /// Negative where a limit or a length forbids the posture.
    pub(crate) slack: [f64; Configuration::COUNT],
    /// The same for lengths and joints 2 and 3 alone, which stay smooth near singular postures of shoulder and wrist.
    pub(crate) links: [f64; Configuration::COUNT],
    /// From the joint-1 axis to the wrist centre, x and y, m: a vector in the direction of the arm.
    pub(crate) wrist: [f64; 2],
    /// Axis 6 forwards of the forearm and across it: a vector in the direction of theta 4.
    pub(crate) bent: [[f64; 2]; Configuration::COUNT],
}

impl SpatialArm {
    /// For every pose of the tool (base axes) the stiffest posture that all limits allow and in which drive 2 holds the gravity
    /// compensator; absent where there is none.
    ///
    /// All eight configurations of each are evaluated. Where the wrist is singular, it is reached if some split between joints 4
    /// and 6 is allowed for certain. Accuracy as [`Self::worst`]. On all cores.
    pub fn best(&self, poses: &[Pose]) -> Vec<Option<Best>> {
        let mut found = vec![None; poses.len()];
        let blocks = found.chunks_mut(BLOCK).zip(poses.chunks(BLOCK));
        parallel::take_each(blocks, |_, (found, poses)| Arch::new().dispatch(BestOf { arm: self, poses, found }));
        found
    }

    /// What counts of the translation per force, m/N, of every configuration at points of one orientation; infinite where a limit
    /// or the `same_branch` forbids it, or nothing holds joint 2. `configurations` by [`Configuration::index`].
    pub(crate) fn configurations_at(
        &self,
        orientation: &ToolVectors,
        same_branch: &SameBranch,
        points: [&[f64]; 3],
        configurations: [&mut [f64]; Configuration::COUNT],
    ) {
        let arch = Arch::new();
        match orientation.forces {
            None => arch.dispatch(ConfigurationsAt {
                arm: self,
                counted: AnyDirection,
                orientation,
                same_branch,
                points,
                configurations,
            }),
            Some(counted) => {
                arch.dispatch(ConfigurationsAt {
                    arm: self,
                    counted,
                    orientation,
                    same_branch,
                    points,
                    configurations,
                });
            }
        }
    }

    /// Appends every configuration at a point, m, base axes, at these rolls, rad.
    pub(crate) fn at_rolls(
        &self,
        rolled_tool: &RolledTool,
        point: &Vector3<f64>,
        rolls: &[f64],
        found: &mut Vec<AtRoll>,
    ) {
        let arch = Arch::new();
        match rolled_tool.forces {
            None => arch.dispatch(AtRolls { arm: self, counted: AnyDirection, rolled_tool, point, rolls, found }),
            Some(counted) => arch.dispatch(AtRolls { arm: self, counted, rolled_tool, point, rolls, found }),
        }
    }
}

struct ConfigurationsAt<'a, C> {
    arm: &'a SpatialArm,
    counted: C,
    orientation: &'a ToolVectors,
    same_branch: &'a SameBranch,
    points: [&'a [f64]; 3],
    configurations: [&'a mut [f64]; Configuration::COUNT],
}

impl<C: Counted> WithSimd for ConfigurationsAt<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let ToolVectors { axis_6, flange_x, wrist_to_tool, .. } = self.orientation;
        let count = self.points[0].len();
        for from in (0..count).step_by(S::F64_LANES) {
            let to = count.min(from + S::F64_LANES);
            let flange = FlangePoses {
                point: Triple::load(simd, self.points.map(|part| &part[from..to])),
                axis_6: Triple::splat(simd, axis_6),
                flange_x: Triple::splat(simd, flange_x),
                wrist_to_tool: Triple::splat(simd, wrist_to_tool),
            };
            let allowed = self.arm.allowed(&flange, self.same_branch, self.counted);
            for index in 0..Configuration::COUNT {
                allowed[index].store(&mut self.configurations[index][from..to]);
            }
        }
    }
}

struct AtRolls<'a, C> {
    arm: &'a SpatialArm,
    counted: C,
    rolled_tool: &'a RolledTool,
    point: &'a Vector3<f64>,
    rolls: &'a [f64],
    found: &'a mut Vec<AtRoll>,
}

impl<C: Counted> WithSimd for AtRolls<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for rolls in self.rolls.chunks(S::F64_LANES) {
            let (s, c) = Lanes::load(simd, rolls).sin_cos();
            let [axis_6, flange_x, wrist_to_tool] = self.rolled_tool.at(simd, s, c);
            let flange = FlangePoses { point: Triple::splat(simd, self.point), axis_6, flange_x, wrist_to_tool };
            let branches = self.arm.configurations::<S, C, true>(&flange, &SameBranch::default(), self.counted);
            let mut parts = [[[0.0; WIDEST]; Configuration::COUNT]; 5];
            for index in 0..Configuration::COUNT {
                let BranchLanes { worst, slack, links, bent: [forwards, across] } = branches[index];
                worst.store(&mut parts[0][index][..S::F64_LANES]);
                slack.store(&mut parts[1][index][..S::F64_LANES]);
                forwards.store(&mut parts[2][index][..S::F64_LANES]);
                across.store(&mut parts[3][index][..S::F64_LANES]);
                links.store(&mut parts[4][index][..S::F64_LANES]);
            }
            let mut wrist = [[0.0; WIDEST]; 2];
            for axis in 0..2 {
                (flange.point.0[axis] - flange.wrist_to_tool.0[axis]).store(&mut wrist[axis][..S::F64_LANES]);
            }
            for lane in 0..rolls.len() {
                let of = |part: usize| std::array::from_fn(|index| parts[part][index][lane]);
                self.found.push(AtRoll {
                    roll: rolls[lane],
                    worst: of(0),
                    slack: of(1),
                    links: of(4),
                    wrist: wrist.map(|axis| axis[lane]),
                    bent: std::array::from_fn(|index| [parts[2][index][lane], parts[3][index][lane]]),
                });
            }
        }
    }
}

struct BestOf<'a> {
    arm: &'a SpatialArm,
    poses: &'a [Pose],
    found: &'a mut [Option<Best>],
}

impl WithSimd for BestOf<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (poses, found) in self.poses.chunks(S::F64_LANES).zip(self.found.chunks_mut(S::F64_LANES)) {
            let mut parts = [[[0.0; WIDEST]; 3]; 4];
            for (lane, pose) in poses.iter().enumerate() {
                let rotation = pose.rotation.to_rotation_matrix();
                let ToolVectors { axis_6, flange_x, wrist_to_tool, .. } = self.arm.orientation(rotation.matrix());
                for (triple, vector) in [pose.translation.vector, axis_6, flange_x, wrist_to_tool].iter().enumerate() {
                    for axis in 0..3 {
                        parts[triple][axis][lane] = vector[axis];
                    }
                }
            }
            let [point, axis_6, flange_x, wrist_to_tool] = &parts;
            let flange = FlangePoses {
                point: Triple::load(simd, point.each_ref().map(|part| &part[..S::F64_LANES])),
                axis_6: Triple::load(simd, axis_6.each_ref().map(|part| &part[..S::F64_LANES])),
                flange_x: Triple::load(simd, flange_x.each_ref().map(|part| &part[..S::F64_LANES])),
                wrist_to_tool: Triple::load(simd, wrist_to_tool.each_ref().map(|part| &part[..S::F64_LANES])),
            };
            let allowed = self.arm.allowed(&flange, &SameBranch::default(), AnyDirection);
            let mut configurations = [[0.0; WIDEST]; Configuration::COUNT];
            for index in 0..Configuration::COUNT {
                allowed[index].store(&mut configurations[index][..S::F64_LANES]);
            }
            for (lane, found) in found.iter_mut().enumerate() {
                let branches = (0..Configuration::COUNT)
                    .map(|index| (configurations[index][lane], index))
                    .filter(|branch| branch.0.is_finite());
                let best = branches.min_by(|a, b| a.0.total_cmp(&b.0));
                *found = best.map(|(worst, index)| Best { worst, configuration: Configuration::ALL[index] });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::drive::GravityCompensator;
    use crate::inverse::reached;
    use crate::robot::Arm;

    #[test]
    fn the_best_posture_in_bulk_is_the_best_of_all_single_ones() {
        let mut rng = fastrand::Rng::with_seed(14);
        for (n, robot) in paper_robots().iter().enumerate() {
            let tool = if n % 2 == 0 { Pose::translation(0.05, 0.1, 0.2) } else { Pose::identity() };
            let arm = SpatialArm::new(robot, &tool).unwrap();
            let poses: Vec<Pose> = (0..400)
                .map(|_| {
                    let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
                    let at = Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-1.0, 3.0));
                    Pose::new(at, Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-3.0, 3.0)))
                })
                .collect();
            let mut several = 0;
            for (pose, best) in poses.iter().zip(arm.best(&poses)) {
                let ways: Vec<(f64, Configuration)> = reached(robot, &(pose * tool.inverse()))
                    .into_iter()
                    .map(|(configuration, q)| {
                        (compliance(robot, &q, &tool).unwrap().compliance.worst().0, configuration)
                    })
                    .collect();
                several += usize::from(1 < ways.len());
                let expected = ways.iter().map(|way| way.0).fold(f64::INFINITY, f64::min);
                match best {
                    None => assert!(ways.is_empty(), "{}: {pose} is reached by {ways:?}", robot.name),
                    Some(best) => {
                        assert!((best.worst - expected).abs() <= 1e-7 * expected, "{}: {best:?} {ways:?}", robot.name);
                        assert!(
                            ways.iter().any(|way| way.1 == best.configuration),
                            "{}: {best:?} {ways:?}",
                            robot.name
                        );
                    }
                }
            }
            assert!(10 < several, "{}: {several} poses are reached in several ways", robot.name);
        }
    }

    /// A register full of one pose: no other one keeps alive what limits on joint 4 leave of it, often but one of two wrists.
    #[test]
    fn what_one_wrist_alone_may_hold_is_found() {
        let mut rng = fastrand::Rng::with_seed(16);
        let tool = Pose::translation(0.05, 0.1, 0.2);
        let mut single = [0; 2];
        for mut robot in paper_robots() {
            let Arm::SixAxis { limits, .. } = &mut robot.arm else { unreachable!("six axes") };
            limits.joints[3] = crate::interval::Interval::spanning(0.2, 1.9);
            let arm = SpatialArm::new(&robot, &tool).unwrap();
            for _ in 0..400 {
                let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
                let at = Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-1.0, 3.0));
                let pose = Pose::new(at, Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-3.0, 3.0)));
                let ways = reached(&robot, &(pose * tool.inverse()));
                let found = arm.best(&[pose; WIDEST]);
                assert!(found.iter().all(|best| best.is_some() != ways.is_empty()), "{}: {pose} {ways:?}", robot.name);
                if let [(configuration, _)] = ways[..] {
                    assert!(found.iter().flatten().all(|best| best.configuration == configuration));
                    single[configuration.index() % 2] += 1;
                }
            }
        }
        assert!(single.iter().all(|count| 20 < *count), "{single:?}");
    }

    #[test]
    fn a_pose_at_which_nothing_holds_joint_2_is_not_reached() {
        let mut robot = paper_robots().swap_remove(4);
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!("six axes") };
        // By hand: 1e6 - 1.5e6 cos(theta2) N m/rad, negative within 48 degrees of upright.
        let (base, arm) = ([0.0, -0.3], [0.0, 0.5]);
        drives.compensator = Some(GravityCompensator { base, arm, stiffness: 1e7, free_length: 0.0 });
        let tool = Pose::translation(0.05, 0.1, 0.2);
        let arm = SpatialArm::new(&robot, &tool).unwrap();
        let mut rng = fastrand::Rng::with_seed(15);
        let poses: Vec<Pose> = (0..1500)
            .map(|_| {
                let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
                let at = Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-1.0, 3.0));
                Pose::new(at, Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-3.0, 3.0)))
            })
            .collect();
        let (mut some_unheld, mut all_unheld) = (0, 0);
        for (pose, best) in poses.iter().zip(arm.best(&poses)) {
            let ways = reached(&robot, &(pose * tool.inverse()));
            let held: Vec<f64> = ways
                .iter()
                .filter_map(|(_, q)| compliance(&robot, q, &tool).ok())
                .map(|posture| posture.compliance.worst().0)
                .collect();
            some_unheld += usize::from(!held.is_empty() && held.len() < ways.len());
            all_unheld += usize::from(held.is_empty() && !ways.is_empty());
            let least = held.into_iter().reduce(f64::min);
            assert_eq!(best.is_some(), least.is_some(), "{pose}: {best:?}");
            if let (Some(best), Some(least)) = (best, least) {
                assert!((best.worst - least).abs() <= 1e-7 * least, "{pose}: {best:?} {least}");
            }
        }
        assert!(5 < some_unheld && 20 < all_unheld, "{some_unheld} {all_unheld}");
    }
}
