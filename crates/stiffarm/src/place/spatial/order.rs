//! Which poses of a zone bound a node best, and in which order are they tried?

use super::bound::{BranchAndBound, HeldNode};
use crate::batch::{SameBranch, SpatialArm};
use crate::enclose::middle;
use crate::inverse::{Configuration, Wrist};
use crate::work::WorkPlane;

/// How many of the softest poses in the middle of a node are enclosed.
const SOFTEST: usize = 4;
/// How many of the poses that a limit forbids in the middle of a node are enclosed.
const FORBIDDEN: usize = 3;

impl BranchAndBound<'_> {
    /// The poses of the zone with the wrist centre nearest to the joint-2 axis and farthest from it, by their index.
    pub(super) fn extreme_poses(&self, held: &HeldNode) -> [usize; 2] {
        let work = middle(&held.node);
        let plane = WorkPlane::of(self.options.elevation, &work);
        let distance = |at: &[f64; 2]| self.enclosure.distance(&plane, &plane.point(&work, *at), held.branch);
        let distances: Vec<f64> = self.samples.iter().map(distance).collect();
        let by_distance = |a: &usize, b: &usize| distances[*a].total_cmp(&distances[*b]);
        let all = || 0..self.samples.len();
        [all().min_by(by_distance).expect("poses"), all().max_by(by_distance).expect("poses")]
    }

    /// The poses worth enclosing: the extreme ones, which limits forbid first, then some that a limit forbids in the middle of the
    /// node, then the softest.
    pub(super) fn poses_worth_enclosing(&self, held: &HeldNode) -> Vec<usize> {
        let work = middle(&held.node);
        let plane = WorkPlane::of(self.options.elevation, &work);
        let points: Vec<_> = self.samples.iter().map(|&at| plane.point(&work, at)).collect();
        let all = || 0..points.len();
        let mut order = self.extreme_poses(held).to_vec();
        let columns = [0, 1, 2].map(|i| points.iter().map(|point| point[i]).collect::<Vec<f64>>());
        let values = |arm: &SpatialArm, same_branch: &SameBranch| {
            let mut configurations = vec![0.0; Configuration::COUNT * points.len()];
            let mut rows = configurations.chunks_exact_mut(points.len());
            let into = std::array::from_fn(|_| rows.next().expect("one row per configuration"));
            let columns = columns.each_ref().map(Vec::as_slice);
            let orientation = arm.orientation(plane.tool()).under(plane.forces(self.options.load));
            arm.configurations_at(&orientation, same_branch, columns, into);
            Wrist::ALL.map(|wrist| {
                let from = held.branch.with(wrist).index() * points.len();
                configurations[from..from + points.len()].to_vec()
            })
        };
        let allowed = values(&self.freed, &self.freed.same_branches(&plane.pose(&work, [0.0; 2]))[0]);
        for of_wrist in allowed.iter().zip(held.wrists).filter_map(|(values, asked)| asked.then_some(values)) {
            let forbidden: Vec<usize> = all().filter(|&i| !of_wrist[i].is_finite()).collect();
            let taken = FORBIDDEN.min(forbidden.len());
            for at in (0..taken).map(|part| forbidden[part * forbidden.len() / taken]) {
                if !order.contains(&at) {
                    order.push(at);
                }
            }
        }
        let [no_flip, flip] = values(&self.bare, &SameBranch::default());
        let row = if held.wrists[0] { no_flip } else { flip };
        let mut soft: Vec<usize> = all().filter(|&i| row[i].is_finite()).collect();
        soft.sort_by(|&a, &b| row[b].total_cmp(&row[a]));
        for i in soft.into_iter().take(SOFTEST) {
            if !order.contains(&i) {
                order.push(i);
            }
        }
        order
    }
}
