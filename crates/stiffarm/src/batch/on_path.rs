//! By how much is the tool pushed off at one place of a path, in every configuration and at every roll of a grid?

use std::f64::consts::TAU;

use nalgebra::Vector3;
use pulp::{Arch, Simd, WithSimd};

use super::branches::FlangePoses;
use super::counted::{AnyDirection, Counted};
use super::lanes::Lanes;
use super::vectors::Triple;
use super::{RolledTool, SameBranch, SpatialArm};
use crate::inverse::Configuration;
use crate::load::Push;
use crate::tolerances::CLEARANCE;

/// More numbers than any register holds.
const WIDEST: usize = 8;

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
        let same_branch = &SameBranch { clearance: self.clearance, beside_axis_1: CLEARANCE, ..SameBranch::default() };
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
