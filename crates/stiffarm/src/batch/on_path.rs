//! By how much is the tool pushed off at one place of a path, in every configuration and at every roll of a grid, and with which angles is it held?

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;
use pulp::{Arch, Simd, WithSimd};

use super::branches::{Collector, FlangePoses, HeldLanes};
use super::counted::{AnyDirection, Counted};
use super::lanes::{Lanes, WIDEST};
use super::vectors::Triple;
use super::{RolledTool, SameBranch, SpatialArm};
use crate::inverse::{ArmBranch, Configuration, Wrist};
use crate::load::Push;
use crate::tolerances::CLEARANCE;

/// Rolls at which errors are wanted.
#[derive(Clone, Debug)]
pub(crate) struct RollGrid {
    rolls: Vec<f64>,
    cos: Vec<f64>,
    sin: Vec<f64>,
}

impl RollGrid {
    /// So many rolls of a whole turn in equal steps, from zero.
    pub(crate) fn turn(count: usize) -> Self {
        Self::at((0..count).map(|i| TAU * i as f64 / count as f64))
    }

    /// These rolls, rad.
    pub(crate) fn at(rolls: impl IntoIterator<Item = f64>) -> Self {
        let rolls: Vec<f64> = rolls.into_iter().collect();
        let (sin, cos) = rolls.iter().map(|roll| roll.sin_cos()).unzip();
        Self { rolls, cos, sin }
    }

    /// How many.
    pub(crate) fn len(&self) -> usize {
        self.rolls.len()
    }

    /// One of them, rad.
    pub(crate) fn roll(&self, i: usize) -> f64 {
        self.rolls[i]
    }

    /// Which of them lies nearest to a roll, rad, whole turns aside.
    pub(crate) fn nearest(&self, roll: f64) -> usize {
        let aside = |i: &usize| {
            let turn = self.rolls[*i] - roll;
            (turn - TAU * (turn / TAU).round()).abs()
        };
        (0..self.len()).min_by(|a, b| aside(a).total_cmp(&aside(b))).unwrap_or(0)
    }

    /// Between two of a whole turn, rad.
    pub(crate) fn step(&self) -> f64 {
        TAU / self.len() as f64
    }
}

/// What pushes on the tool, base axes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Pushing {
    /// Nothing: 0 m wherever the pose is held.
    Nothing,
    /// So many N in any direction: the largest displacement counts.
    Any(f64),
    /// A known force and moment.
    Known(Push),
}

impl SpatialArm {
    /// What counts of the displacement, m, at a point, m, base axes, for every roll of a grid: `found[configuration][roll]`; infinite
    /// where a limit, the distance from singular postures or a length forbids the posture, or nothing holds joint 2.
    pub(crate) fn errors_at_rolls(
        &self,
        rolled_tool: &RolledTool,
        point: &Vector3<f64>,
        pushing: &Pushing,
        grid: &RollGrid,
        found: &mut [Vec<f32>; Configuration::COUNT],
    ) {
        for errors in found.iter_mut() {
            errors.resize(grid.len(), f32::INFINITY);
        }
        let same_branch = &self.clear_of_singular();
        let arch = Arch::new();
        match *pushing {
            // A push of nothing moves nothing: a kernel of its own would be compiled for every instruction set, and hardly ever run.
            Pushing::Nothing => {
                let counted = Push { force: Vector3::zeros(), moment: Vector3::zeros(), counted: None };
                arch.dispatch(OnGrid { arm: self, counted, factor: 1.0, rolled_tool, point, grid, same_branch, found });
            }
            Pushing::Any(factor) => {
                let counted = AnyDirection;
                arch.dispatch(OnGrid { arm: self, counted, factor, rolled_tool, point, grid, same_branch, found });
            }
            Pushing::Known(counted) => {
                arch.dispatch(OnGrid { arm: self, counted, factor: 1.0, rolled_tool, point, grid, same_branch, found });
            }
        }
    }

    /// Model angles, rad, at a point, m, base axes, for the rolls of a grid that are wanted: `found[configuration * rolls + roll]`; NaN where
    /// that is no posture as [`Self::errors_at_rolls`] takes them.
    pub(crate) fn angles_at_rolls(
        &self,
        rolled_tool: &RolledTool,
        point: &Vector3<f64>,
        grid: &RollGrid,
        is_wanted: &[bool],
        found: &mut Vec<[f64; 6]>,
    ) {
        found.clear();
        found.resize(Configuration::COUNT * grid.len(), [f64::NAN; 6]);
        let same_branch = &self.clear_of_singular();
        Arch::new().dispatch(AnglesOnGrid { arm: self, rolled_tool, point, grid, same_branch, is_wanted, found });
    }

    /// Every posture that keeps from singular ones what the arm keeps.
    fn clear_of_singular(&self) -> SameBranch {
        SameBranch { clearance: self.clearance, beside_axis_1: CLEARANCE, ..SameBranch::default() }
    }
}

struct AnglesOnGrid<'a> {
    arm: &'a SpatialArm,
    rolled_tool: &'a RolledTool,
    point: &'a Vector3<f64>,
    grid: &'a RollGrid,
    same_branch: &'a SameBranch,
    is_wanted: &'a [bool],
    found: &'a mut [[f64; 6]],
}

/// The model angles of every configuration, rad.
struct Angles<S: Simd> {
    found: [[Lanes<S>; 6]; Configuration::COUNT],
    /// Which of them some lane has.
    has: [bool; Configuration::COUNT],
}

impl<S: Simd> Collector<S> for Angles<S> {
    /// Theta 1.
    type Seen = Lanes<S>;

    #[inline(always)]
    fn seen(&self, s1: Lanes<S>, c1: Lanes<S>) -> Lanes<S> {
        s1.atan2(c1)
    }

    #[inline(always)]
    fn take(&mut self, _: &SpatialArm, first: &Lanes<S>, branch: ArmBranch, held: &HeldLanes<S>) {
        let [second, forearm] = [held.upper[0].atan2(held.upper[1]), held.forearm[0].atan2(held.forearm[1])];
        let fourth = held.bent[1].atan2(held.bent[0]);
        let (fifth, sixth) = (held.s5.atan2(held.bent[2]), held.sixth[1].atan2(held.sixth[0]));
        let wrists = [[fourth, fifth, sixth], [fourth + PI, -fifth, sixth + PI]];
        for wrist in 0..2 {
            let index = branch.with(Wrist::ALL[wrist]).index();
            let first_or_nan = held.slacks[wrist].at_least(0.0).select(*first, first.all(f64::NAN));
            self.has[index] = true;
            let [fourth, fifth, sixth] = wrists[wrist];
            self.found[index] = [first_or_nan, second, forearm - second, fourth, fifth, sixth];
        }
    }
}

impl WithSimd for AnglesOnGrid<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let point = Triple::splat(simd, self.point);
        let count = self.grid.len();
        for from in (0..count).step_by(S::F64_LANES) {
            let to = count.min(from + S::F64_LANES);
            if !self.is_wanted[from..to].contains(&true) {
                continue;
            }
            let (s, c) = (Lanes::load(simd, &self.grid.sin[from..to]), Lanes::load(simd, &self.grid.cos[from..to]));
            let [axis_6, flange_x, wrist_to_tool] = self.rolled_tool.at(simd, s, c);
            let flange = FlangePoses { point, axis_6, flange_x, wrist_to_tool };
            let mut angles = Angles { found: [[s; 6]; Configuration::COUNT], has: [false; Configuration::COUNT] };
            self.arm.branches::<S, _, false>(&flange, self.same_branch, &mut angles);
            for index in 0..Configuration::COUNT {
                if !angles.has[index] {
                    continue;
                }
                let mut parts = [[0.0; WIDEST]; 6];
                for joint in 0..6 {
                    angles.found[index][joint].store(&mut parts[joint][..S::F64_LANES]);
                }
                for lane in 0..to - from {
                    for joint in 0..6 {
                        self.found[index * count + from + lane][joint] = parts[joint][lane];
                    }
                }
            }
        }
    }
}

struct OnGrid<'a, C> {
    arm: &'a SpatialArm,
    counted: C,
    factor: f64,
    rolled_tool: &'a RolledTool,
    point: &'a Vector3<f64>,
    grid: &'a RollGrid,
    same_branch: &'a SameBranch,
    found: &'a mut [Vec<f32>; Configuration::COUNT],
}

impl<C: Counted> WithSimd for OnGrid<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let point = Triple::splat(simd, self.point);
        for from in (0..self.grid.len()).step_by(S::F64_LANES) {
            let to = self.grid.len().min(from + S::F64_LANES);
            let (s, c) = (Lanes::load(simd, &self.grid.sin[from..to]), Lanes::load(simd, &self.grid.cos[from..to]));
            let [axis_6, flange_x, wrist_to_tool] = self.rolled_tool.at(simd, s, c);
            let flange = FlangePoses { point, axis_6, flange_x, wrist_to_tool };
            let allowed = self.arm.allowed(&flange, self.same_branch, self.counted);
            for index in 0..Configuration::COUNT {
                let mut errors = [0.0; WIDEST];
                (allowed[index] * self.factor).store(&mut errors[..S::F64_LANES]);
                for lane in 0..to - from {
                    self.found[index][from + lane] = errors[lane] as f32;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point3, Rotation3};

    use super::*;
    use crate::catalogue::paper_robots;
    use crate::interval::Interval;
    use crate::inverse::{posture_of, within_limits};
    use crate::robot::Arm;
    use crate::spatial::Pose;

    /// Rolls of the grid; not a multiple of any register.
    const ROLLS: usize = 45;

    #[test]
    fn angles_at_rolls_are_those_of_single_poses() {
        let mut rng = fastrand::Rng::with_seed(23);
        let (mut held, mut left) = ([0; Configuration::COUNT], 0);
        for (n, mut robot) in paper_robots().into_iter().enumerate() {
            if let Arm::SixAxis { limits, .. } = &mut robot.arm
                && n % 2 == 0
            {
                // What one wrist alone holds.
                limits.joints[3] = Interval::spanning(0.2, 1.9);
            }
            let tool = Pose::new(Vector3::new(0.2, 0.05, 0.15), Vector3::new(0.1, 1.2, 0.0));
            let arm = SpatialArm::new(&robot, &tool).unwrap().with_margins(0.05, 0.05).unwrap();
            for _ in 0..40 {
                let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
                let point = Vector3::new(part(-2.5, 2.5), part(-2.5, 2.5), part(0.0, 2.0));
                let turned = Rotation3::new(Vector3::new(part(-3.0, 3.0), part(-3.0, 3.0), part(-3.0, 3.0)));
                let at = |roll: f64| turned * Rotation3::from_axis_angle(&Vector3::z_axis(), roll);
                let tools = [0.0, TAU / 4.0, TAU / 2.0].map(|roll| *at(roll).matrix());
                let rolled = arm.rolled_tool(tools.each_ref());
                let grid = RollGrid::turn(ROLLS);
                // Whole registers are left out, and parts of others.
                let is_wanted: Vec<bool> = (0..ROLLS).map(|i| !(20..=37).contains(&i)).collect();
                let mut found = Vec::new();
                arm.angles_at_rolls(&rolled, &point, &grid, &is_wanted, &mut found);
                for (i, configuration) in (0..ROLLS).flat_map(|i| Configuration::ALL.map(|one| (i, one))) {
                    let pose = Pose::from_parts(point.into(), at(grid.roll(i)).into());
                    let flange = pose * tool.inverse();
                    let single = posture_of(&arm.geometry, &flange, configuration);
                    let theta = found[configuration.index() * ROLLS + i];
                    if theta[0].is_nan() {
                        let wrist = flange * Point3::new(0.0, 0.0, -arm.geometry.c4);
                        let is_allowed = single.is_some_and(|single| {
                            within_limits(&arm.geometry, &arm.limits, &single).is_some()
                                && 0.05 + 1e-9 < arm.geometry.singular_margin(&single)
                                && 0.01 < wrist.x.hypot(wrist.y)
                        });
                        assert!(!is_wanted[i] || !is_allowed, "{}: {configuration} {single:?}", robot.name);
                        left += usize::from(!is_wanted[i]);
                        continue;
                    }
                    let single = single.expect("a posture");
                    let is_allowed = within_limits(&arm.geometry, &arm.limits, &single).is_some();
                    assert!(
                        is_allowed && 0.05 - 1e-9 < arm.geometry.singular_margin(&single),
                        "{configuration}: {single:?}"
                    );
                    for joint in 0..6 {
                        let turn = theta[joint] - single[joint];
                        let aside = (turn - TAU * (turn / TAU).round()).abs();
                        // The angles of a wrist 0.05 rad from straight, or of an arm, multiply rounding by less than a thousand.
                        assert!(aside < 1e-12, "{}: {configuration} joint {joint}: {theta:?} {single:?}", robot.name);
                    }
                    held[configuration.index()] += 1;
                }
            }
        }
        assert!(6 <= held.iter().filter(|count| 20 < **count).count() && 5 * 40 * 8 * 8 < left, "{held:?} {left}");
    }
}
