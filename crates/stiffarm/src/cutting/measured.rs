//! A force that was measured along a path: from row to row it changes evenly.

use nalgebra::Vector3;

use super::CuttingForce;

/// What rows count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// The way from the beginning of the path, rapid moves and all, m.
    Way,
    /// The time while the tool feeds, s.
    Time,
}

/// Along which axes a force was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeasuredAxes {
    /// Those of the cut: feed, across, axial.
    Cut,
    /// Those of the part: x, y, z.
    Part,
}

/// One row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredForce {
    /// m or s.
    pub at: f64,
    /// On the tool, N.
    pub force: [f64; 3],
    /// On the tool about the axis away from the work, N m.
    pub moment: f64,
}

/// Forces along a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// What rows count.
    pub along: Along,
    /// The axes of the forces.
    pub axes: MeasuredAxes,
    /// At least two, rising.
    rows: Vec<MeasuredForce>,
}

impl Measured {
    /// `None` of fewer than two rows, and where one does not lie beyond the one before.
    pub fn new(along: Along, axes: MeasuredAxes, rows: Vec<MeasuredForce>) -> Option<Self> {
        let rises = rows.windows(2).all(|pair| pair[0].at < pair[1].at);
        (2 <= rows.len() && rises).then_some(Self { along, axes, rows })
    }

    /// Where the first and the last row lie.
    pub fn ends(&self) -> [f64; 2] {
        [self.rows[0].at, self.rows[self.rows.len() - 1].at]
    }

    /// Force and moment somewhere; `None` beyond the ends.
    pub fn at(&self, at: f64) -> Option<([f64; 3], f64)> {
        let [first, last] = self.ends();
        if !(first <= at && at <= last) {
            return None;
        }
        let above = self.rows.partition_point(|row| row.at < at).max(1);
        let [low, high] = [&self.rows[above - 1], &self.rows[above]];
        let share = (at - low.at) / (high.at - low.at);
        let between = |a: f64, b: f64| a + share * (b - a);
        let force = std::array::from_fn(|i| between(low.force[i], high.force[i]));
        Some((force, between(low.moment, high.moment)))
    }

    /// The mean over all of it, and how large it is.
    pub(super) fn force(&self) -> CuttingForce {
        let (mut sum, mut turning) = (Vector3::zeros(), 0.0);
        for pair in self.rows.windows(2) {
            let half = (pair[1].at - pair[0].at) / 2.0;
            sum += (Vector3::from(pair[0].force) + Vector3::from(pair[1].force)) * half;
            turning += (pair[0].moment + pair[1].moment) * half;
        }
        let [first, last] = self.ends();
        let most = |pick: fn(f64, f64) -> f64, from: f64| {
            std::array::from_fn(|i| self.rows.iter().map(|row| row.force[i]).fold(from, pick))
        };
        CuttingForce {
            mean: Some((sum / (last - first)).into()),
            range: Some([most(f64::min, f64::INFINITY), most(f64::max, f64::NEG_INFINITY)]),
            largest: self.rows.iter().map(|row| Vector3::from(row.force).norm()).fold(0.0, f64::max),
            moment: turning / (last - first),
            power: None,
            revolution: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(at: f64, force: [f64; 3], moment: f64) -> MeasuredForce {
        MeasuredForce { at, force, moment }
    }

    #[test]
    fn between_rows_a_force_changes_evenly_and_beyond_them_none_is_known() {
        let rows =
            vec![row(1.0, [0.0, 10.0, 4.0], 0.0), row(2.0, [8.0, 10.0, 0.0], 2.0), row(4.0, [8.0, -10.0, 0.0], 2.0)];
        let measured = Measured::new(Along::Way, MeasuredAxes::Cut, rows.clone()).unwrap();
        assert_eq!(measured.at(1.25), Some(([2.0, 10.0, 3.0], 0.5)));
        assert_eq!((measured.at(1.0).unwrap().0, measured.at(4.0).unwrap().0), ([0.0, 10.0, 4.0], [8.0, -10.0, 0.0]));
        assert_eq!((measured.at(0.999), measured.at(4.001), measured.at(f64::NAN)), (None, None, None));
        // By hand: areas of trapezia over 3 m.
        let force = measured.force();
        assert_eq!(force.mean, Some([(4.0 + 16.0) / 3.0, 10.0 / 3.0, 2.0 / 3.0]));
        assert_eq!(force.range, Some([[0.0, -10.0, 0.0], [8.0, 10.0, 4.0]]));
        assert!((force.moment - 5.0 / 3.0).abs() < 1e-15 && (force.largest - 164.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(Measured::new(Along::Way, MeasuredAxes::Cut, vec![rows[0]]), None);
        assert_eq!(Measured::new(Along::Way, MeasuredAxes::Cut, vec![rows[0], rows[0]]), None);
    }
}
