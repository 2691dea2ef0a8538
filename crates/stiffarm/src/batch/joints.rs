//! How compliant are many postures, given by their joint angles?

use pulp::{Arch, Simd, WithSimd};

use super::SpatialArm;
use super::lanes::Lanes;
use super::posture::PostureLanes;
use super::vectors::{Symmetric, Triple};
use crate::compliance::{PostureError, check_joint};
use crate::parallel;

/// Postures that one thread takes at a time.
const BLOCK: usize = 4096;

impl SpatialArm {
    /// The largest translation per force in any direction, m/N, at every posture: `joints[i][n]` is the angle of joint
    /// `i + 1` as the robot reports it, rad, at posture `n`. On all cores.
    ///
    /// NaN where the gravity compensator pushes harder than drive 2 holds. Relative error below 3e-8 (two softest directions
    /// alike), below 1e-12 elsewhere.
    ///
    /// # Errors
    /// The first joint angle that makes no sense. Limits are not checked here.
    ///
    /// # Panics
    /// Where the slices differ in length.
    pub fn worst(&self, joints: [&[f64]; 6], worst: &mut [f64]) -> Result<(), PostureError> {
        check(&joints, worst.len())?;
        parallel::take_each(worst.chunks_mut(BLOCK), |block, found| {
            let joints = joints.map(|q| &q[block * BLOCK..][..found.len()]);
            Arch::new().dispatch(Worst { arm: self, joints, found });
        });
        Ok(())
    }

    /// The block from force to translation, m/N, base axes, at every posture: six slices for xx, yy, zz, xy, yz, xz.
    /// All NaN where the gravity compensator pushes harder than drive 2 holds.
    ///
    /// # Errors
    /// As [`Self::worst`].
    ///
    /// # Panics
    /// Where the slices differ in length.
    pub fn translations(&self, joints: [&[f64]; 6], entries: [&mut [f64]; 6]) -> Result<(), PostureError> {
        let count = entries[0].len();
        assert!(entries.iter().all(|entry| entry.len() == count), "six slices of one length");
        check(&joints, count)?;
        let [xx, yy, zz, xy, yz, xz] = entries.map(|entry| entry.chunks_mut(BLOCK));
        let blocks = xx.zip(yy).zip(zz).zip(xy).zip(yz).zip(xz);
        parallel::take_each(blocks, |block, (((((xx, yy), zz), xy), yz), xz)| {
            let joints = joints.map(|q| &q[block * BLOCK..][..xx.len()]);
            Arch::new().dispatch(Translations { arm: self, joints, entries: [xx, yy, zz, xy, yz, xz] });
        });
        Ok(())
    }

    /// The compliance in the axes of the arm, and theta 1.
    #[inline(always)]
    fn at_joints<S: Simd>(&self, simd: S, joints: &[&[f64]; 6]) -> (Symmetric<S>, Lanes<S>) {
        let lean = self.theta(simd, joints, 1);
        let third = self.theta(simd, joints, 2);
        let forearm = if self.angular_limits.third_is_forearm { third } else { lean + third };
        let (s2, c2) = lean.sin_cos();
        let (s23, c23) = forearm.sin_cos();
        let (s4, c4) = self.theta(simd, joints, 3).sin_cos();
        let (s5, c5) = self.theta(simd, joints, 4).sin_cos();
        // In the axes of the forearm: x forwards, y across, z along it.
        let axis_5 = Triple([-s4, c4, s2.all(0.0)]);
        let axis_6 = Triple([s5 * c4, s5 * s4, c5]);
        let tool = self.flange_from_tool.translation.vector;
        let mut wrist_to_tool = axis_6 * (self.geometry.c4 + tool.z);
        if !self.tool_is_on_axis_6() {
            let (s6, c6) = self.theta(simd, joints, 5).sin_cos();
            let across = Triple([c5 * c4, c5 * s4, -s5]);
            wrist_to_tool = wrist_to_tool + across * (c6 * tool.x - s6 * tool.y) + axis_5 * (s6 * tool.x + c6 * tool.y);
        }
        let at = PostureLanes {
            s2,
            c2,
            s23,
            c23,
            axis_5: axis_5.uprighted(s23, c23),
            axis_6: axis_6.uprighted(s23, c23),
            wrist_to_tool: wrist_to_tool.uprighted(s23, c23),
        };
        (self.translation(&at), self.theta(simd, joints, 0))
    }

    /// The model angle of a joint as far as it comes from that joint alone.
    #[inline(always)]
    fn theta<S: Simd>(&self, simd: S, joints: &[&[f64]; 6], i: usize) -> Lanes<S> {
        Lanes::load(simd, joints[i]) * self.geometry.sign[i] - self.geometry.offset[i]
    }
}

fn check(joints: &[&[f64]; 6], count: usize) -> Result<(), PostureError> {
    assert!(joints.iter().all(|q| q.len() == count), "six slices of joint angles, as long as the answer");
    for (joint, q) in joints.iter().enumerate() {
        // One pass without a way out early goes through registers of several numbers.
        if !q.iter().fold(true, |fine, angle| fine & makes_sense(*angle)) {
            q.iter().try_for_each(|angle| check_joint(joint, *angle))?;
        }
    }
    Ok(())
}

/// Whether a joint angle, rad, is one of which anything can be computed; [`check_joint`] says what is wrong with others.
#[inline(always)]
pub(super) fn makes_sense(angle: f64) -> bool {
    angle.abs() <= 1080_f64.to_radians()
}

pub(super) struct Worst<'a> {
    pub(super) arm: &'a SpatialArm,
    pub(super) joints: [&'a [f64]; 6],
    pub(super) found: &'a mut [f64],
}

impl WithSimd for Worst<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let count = self.found.len();
        for from in (0..count).step_by(S::F64_LANES) {
            let to = count.min(from + S::F64_LANES);
            let joints = self.joints.map(|q| &q[from..to]);
            self.arm.at_joints(simd, &joints).0.largest().store(&mut self.found[from..to]);
        }
    }
}

pub(super) struct Translations<'a> {
    pub(super) arm: &'a SpatialArm,
    pub(super) joints: [&'a [f64]; 6],
    pub(super) entries: [&'a mut [f64]; 6],
}

impl WithSimd for Translations<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let count = self.entries[0].len();
        let entries = self.entries;
        for from in (0..count).step_by(S::F64_LANES) {
            let to = count.min(from + S::F64_LANES);
            let joints = self.joints.map(|q| &q[from..to]);
            let (arm_axes, theta_1) = self.arm.at_joints(simd, &joints);
            let (s, c) = theta_1.sin_cos();
            let base_axes = arm_axes.turned(s, c).0;
            for i in 0..6 {
                base_axes[i].store(&mut entries[i][from..to]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::batch::SpatialArm;
    use crate::catalogue::paper_robots;
    use crate::compliance::compliance;
    use crate::drive::{GravityCompensator, JointCompliance, Transmission};
    use crate::robot::{Arm, Robot};
    use crate::spatial::Pose;

    /// The paper's robots with unequal drives, and one of each kind with a geared wrist and a compensator.
    fn robots() -> Vec<Robot> {
        let mut robots = paper_robots();
        robots.extend_from_within(..);
        for (n, robot) in robots.iter_mut().enumerate() {
            let Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!("six axes") };
            drives.compliance = JointCompliance([0.7e-6, 1.1e-6, 1.9e-6, 3e-6, 5e-6, 8e-6]);
            if n >= 10 {
                drives.transmission = Transmission(
                    drives.transmission.0
                        + nalgebra::Matrix6::from_fn(|i, j| {
                            if i >= 3 && j >= 3 && j < i { 0.1 * (i + j) as f64 } else { 0.0 }
                        }),
                );
                let (base, arm) = ([-0.5, -0.1], [0.05, 0.4]);
                drives.compensator = Some(GravityCompensator { base, arm, stiffness: 2e5, free_length: 0.3 });
            }
        }
        robots
    }

    /// Postures of one batch; not a multiple of any register.
    const COUNT: usize = 203;

    /// Random postures, and what the registers make of them.
    struct Batch {
        q: [Vec<f64>; 6],
        worst: Vec<f64>,
        entries: Vec<Vec<f64>>,
    }

    /// Angles lie in a range of `width`, rad, about zero.
    fn batch(robot: &Robot, tool: &Pose, width: f64) -> Batch {
        let mut rng = fastrand::Rng::with_seed(4);
        let arm = SpatialArm::new(robot, tool).unwrap();
        let q: [Vec<f64>; 6] = std::array::from_fn(|_| (0..COUNT).map(|_| width * (rng.f64() - 0.5)).collect());
        let joints = std::array::from_fn(|i| q[i].as_slice());
        let (mut worst, mut entries) = (vec![0.0; COUNT], vec![vec![0.0; COUNT]; 6]);
        arm.worst(joints, &mut worst).unwrap();
        let mut rows = entries.iter_mut();
        arm.translations(joints, std::array::from_fn(|_| rows.next().unwrap().as_mut_slice())).unwrap();
        Batch { q, worst, entries }
    }

    #[test]
    fn batches_are_what_single_postures_are() {
        let tools = [Pose::identity(), Pose::translation(0.0, 0.0, 0.3), Pose::translation(0.1, -0.2, 0.25)];
        for (n, robot) in robots().iter().enumerate() {
            let tool = tools[n % 3];
            let Batch { q, worst, entries } = batch(robot, &tool, 12.0);
            for k in 0..COUNT {
                let expected = compliance(robot, &std::array::from_fn(|i| q[i][k]), &tool).unwrap().compliance;
                let (largest, _) = expected.worst();
                assert!((worst[k] - largest).abs() <= 3e-8 * largest, "{}: {} {largest}", robot.name, worst[k]);
                let c = expected.translation();
                let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
                for (entry, (i, j)) in entries.iter().zip(pairs) {
                    // Some forty roundings of numbers up to the largest entry.
                    assert!((entry[k] - c[(i, j)]).abs() <= 2e-14 * largest, "{}: {i} {j}", robot.name);
                }
            }
        }
    }

    /// A paper robot whose spring, pressed together, pushes the upper arm over at many of its angles.
    fn pushed_over() -> Robot {
        let mut robot = paper_robots().swap_remove(4);
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!("six axes") };
        let (base, arm) = ([-0.5, -0.1], [0.05, 0.4]);
        drives.compensator = Some(GravityCompensator { base, arm, stiffness: 2e7, free_length: 2.0 });
        robot
    }

    #[test]
    fn where_nothing_holds_joint_2_there_is_no_number() {
        let (robot, tool) = (pushed_over(), Pose::translation(0.05, 0.0, 0.2));
        let Batch { q, worst, entries } = batch(&robot, &tool, 6.0);
        let mut unheld = 0;
        for k in 0..COUNT {
            let is_held = compliance(&robot, &std::array::from_fn(|i| q[i][k]), &tool).is_ok();
            unheld += usize::from(!is_held);
            assert_eq!(worst[k].is_nan(), !is_held, "{k}: {}", worst[k]);
            assert!(entries.iter().all(|entry| entry[k].is_nan() != is_held), "{k}");
        }
        assert!(20 < unheld && unheld < COUNT - 20, "{unheld}");
    }

    #[test]
    fn a_joint_angle_that_makes_no_sense_is_named() {
        let arm = SpatialArm::new(&paper_robots()[0], &Pose::identity()).unwrap();
        for bad in [f64::NAN, f64::INFINITY, 1e3] {
            let (fine, odd) = ([0.1, 0.2], [0.1, bad]);
            let error = arm.worst([&fine, &fine, &fine, &fine, &odd, &fine], &mut [0.0; 2]).unwrap_err();
            assert!(error.to_string().starts_with("joint 5"), "{error}");
        }
    }
}
