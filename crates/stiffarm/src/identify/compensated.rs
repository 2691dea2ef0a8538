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
    /// Springs that are sought of it, and what stiffness a unit of each adds.
    sought: Vec<(usize, Vec<f64>)>,
}

impl Compensated {
    /// At readings at which drive 2 is this spring, and joint 2 stands at this model angle, rad.
    pub(super) fn of(compensator: &GravityCompensator, springs: &[Spring], readings: &[(usize, f64)]) -> Self {
        let at = |spring: Spring| springs.iter().position(|one| *one == spring);
        let parts = || readings.iter().map(|(_, theta_2)| compensator.parts(*theta_2));
        let free = compensator.free_length;
        let sought = match (at(Spring::Compensator), at(Spring::Preload)) {
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
        let known = |theta_2: f64| if sought.is_empty() { compensator.stiffness(theta_2) } else { 0.0 };
        Self {
            second: readings.iter().map(|(second, _)| *second).collect(),
            known: readings.iter().map(|(_, theta_2)| known(*theta_2)).collect(),
            sought,
        }
    }

    /// `1 + k dK` at a reading: nothing holds joint 2 where it is not positive.
    fn held(&self, i: usize, values: &[f64]) -> f64 {
        let added = self.sought.iter().map(|(spring, unit)| values[*spring] * unit[i]).sum::<f64>();
        1.0 + values[self.second[i]] * (self.known[i] + added)
    }

    /// The reading at which nothing would hold joint 2.
    pub(super) fn unheld(&self, values: &[f64]) -> Option<usize> {
        (0..self.second.len()).find(|&i| !(0.0 < self.held(i, values)))
    }

    /// The system that is linear about some values, of one that knows no compensator.
    pub(super) fn about(&self, values: &[f64], system: &mut System) {
        for (i, &second) in self.second.iter().enumerate() {
            let (k, held) = (values[second], self.held(i, values));
            let kappa = k / held;
            let column: Vector3<f64> = system.a.fixed_view::<3, 1>(3 * i, second).into();
            system.a.fixed_view_mut::<3, 1>(3 * i, second).copy_from(&(column / (held * held)));
            let mut reached = k / (held * held);
            for (spring, unit) in &self.sought {
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
