//! What does a gravity compensator beside drive 2 leave of its compliance?
//!
//! `kappa = k / (1 + k dK)` in place of `k`, with `dK` linear in the spring and in its preload: solved by Gauss and Newton's steps,
//! `d kappa / d k = 1 / (1 + k dK)^2` and `d kappa / d dK = -kappa^2`.

use nalgebra::Vector3;

use super::regression::System;
use super::springs::Spring;
use crate::drive::GravityCompensator;

/// A compensator at every reading.
pub(super) struct Compensated {
    /// Which spring is drive 2.
    second: Vec<usize>,
    /// What of the stiffness it adds is known, N m/rad.
    known: Vec<f64>,
    /// Its springs that are unknown, and what stiffness a unit of each adds.
    unknowns: Vec<(usize, Vec<f64>)>,
}

impl Compensated {
    /// At readings at which drive 2 is this spring, and joint 2 stands at this model angle, rad.
    pub(super) fn of(compensator: &GravityCompensator, springs: &[Spring], readings: &[(usize, f64)]) -> Self {
        let at = |spring: Spring| springs.iter().position(|one| *one == spring);
        let parts = || readings.iter().map(|(_, theta_2)| compensator.parts(*theta_2));
        let free = compensator.free_length;
        let unknowns = match (at(Spring::Compensator), at(Spring::Preload)) {
            (Some(spring), Some(preload)) => vec![
                (spring, parts().map(|[of_spring, _]| of_spring).collect()),
                (preload, parts().map(|[_, of_preload]| of_preload).collect()),
            ],
            // With the free length that is known.
            (Some(spring), None) => {
                vec![(spring, parts().map(|[of_spring, of_preload]| of_spring + free * of_preload).collect())]
            }
            (None, _) => Vec::new(),
        };
        let known = |theta_2: f64| if unknowns.is_empty() { compensator.stiffness(theta_2) } else { 0.0 };
        Self {
            second: readings.iter().map(|(second, _)| *second).collect(),
            known: readings.iter().map(|(_, theta_2)| known(*theta_2)).collect(),
            unknowns,
        }
    }

    /// `1 + k dK` at a reading: nothing holds joint 2 where it is not positive.
    fn held(&self, i: usize, values: &[f64]) -> f64 {
        let added = self.unknowns.iter().map(|(spring, unit)| values[*spring] * unit[i]).sum::<f64>();
        1.0 + values[self.second[i]] * (self.known[i] + added)
    }

    /// The reading at which nothing would hold joint 2.
    pub(super) fn unheld(&self, values: &[f64]) -> Option<usize> {
        (0..self.second.len()).find(|&i| !(0.0 < self.held(i, values)))
    }

    /// From some values towards others, as far as joint 2 is held.
    pub(super) fn towards(&self, values: &[f64], target: &[f64]) -> Option<Vec<f64>> {
        let step = |share: f64| -> Vec<f64> {
            values.iter().zip(target).map(|(value, target)| value + share * (target - value)).collect()
        };
        let shares = (0..20).map(|halved| 0.5_f64.powi(halved));
        shares.map(step).find(|values| self.unheld(values).is_none())
    }

    /// The system that is linear about some values, of one that knows no compensator.
    pub(super) fn about(&self, values: &[f64], system: &mut System) {
        for (i, &second) in self.second.iter().enumerate() {
            let (k, held) = (values[second], self.held(i, values));
            let kappa = k / held;
            let column: Vector3<f64> = system.a.fixed_view::<3, 1>(3 * i, second).into();
            system.a.fixed_view_mut::<3, 1>(3 * i, second).copy_from(&(column / (held * held)));
            let mut reached = k / (held * held);
            for (spring, unit) in &self.unknowns {
                let slope = -kappa * kappa * unit[i];
                system.a.fixed_view_mut::<3, 1>(3 * i, *spring).copy_from(&(column * slope));
                reached += slope * values[*spring];
            }
            let mut y = system.y.fixed_rows_mut::<3>(3 * i);
            y -= column * (kappa - reached);
        }
    }

    /// Adds to what a system that knows no compensator leaves.
    pub(super) fn add_to(&self, missed: &mut nalgebra::DVector<f64>, values: &[f64], system: &System) {
        for (i, &second) in self.second.iter().enumerate() {
            let k = values[second];
            let column: Vector3<f64> = system.a.fixed_view::<3, 1>(3 * i, second).into();
            let mut missed = missed.fixed_rows_mut::<3>(3 * i);
            missed += column * (k - k / self.held(i, values));
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    #[test]
    fn the_linear_system_touches_the_curved_one_and_leaves_it_with_the_square_of_the_step() {
        let spring = GravityCompensator { base: [-0.6, 0.1], arm: [0.0, 0.25], stiffness: 5e6, free_length: 0.3 };
        let springs = [Spring::Drive(1), Spring::Compensator, Spring::Preload];
        let readings: Vec<(usize, f64)> = (0..5).map(|i| (0, 0.3 * f64::from(i) - 0.5)).collect();
        let found = Compensated::of(&spring, &springs, &readings);
        let raw = System {
            a: DMatrix::from_fn(15, 3, |i, j| if j == 0 { 1.0 + i as f64 } else { 0.0 }),
            y: DVector::from_element(15, 1e-6),
        };
        let curved = |values: &[f64]| {
            let mut missed = &raw.y - &raw.a * DVector::from_column_slice(values);
            found.add_to(&mut missed, values, &raw);
            missed
        };
        let at = [0.4e-6, 5e6, 1.5e6];
        let mut linear = raw.clone();
        found.about(&at, &mut linear);
        let off = |step: f64, which: usize| {
            let mut values = at;
            values[which] *= 1.0 + step;
            (curved(&values) - (&linear.y - &linear.a * DVector::from_column_slice(&values))).norm()
        };
        for which in 0..3 {
            let moved = {
                let mut values = at;
                values[which] *= 1.01;
                (curved(&values) - curved(&at)).norm()
            };
            assert!(off(0.0, which) < 1e-12 * raw.y.norm() + 1e-18);
            // A wrong slope would leave a part of the step, not of its square.
            assert!(off(0.01, which) < 0.02 * moved, "{which}: {} of {moved}", off(0.01, which));
            assert!((off(0.02, which) / off(0.01, which) - 4.0).abs() < 0.2);
        }
    }
}
