//! How good is a place? The largest compliance over the poses of a zone, in each configuration.

use super::descent::Score;
use super::search::{Candidate, Search};
use crate::inverse::Configuration;
use crate::place::Within;
use crate::tolerances;
use crate::work::{Grid, WorkPlacement, WorkPlane};

/// Poses of a zone that are evaluated before it is asked whether any more must be: two of the widest registers.
const POSES: usize = 16;

impl Search<'_> {
    /// A place with its score over a grid of poses.
    pub(super) fn candidate(&self, work: WorkPlacement, grid: &Grid) -> Candidate {
        self.candidate_below(work, grid, Score::NONE)
    }

    /// The same where the score is less than a bound; else any score that is not.
    pub(super) fn candidate_below(&self, work: WorkPlacement, grid: &Grid, bound: Score) -> Candidate {
        let scores = self.scores_below(&work, grid, bound).into_iter().zip(Configuration::ALL);
        let (score, configuration) = scores.min_by(|a, b| a.0.total_cmp(&b.0)).expect("eight configurations");
        Candidate { work, score, configuration }
    }

    /// All of the zone lies in the window, and clear of the robot's column.
    fn is_within(&self, work: &WorkPlacement, plane: &WorkPlane) -> bool {
        let [ahead, _, up] = plane.half_extents(self.zone);
        let Within { x, z } = self.options.within;
        [(x, work.x, ahead), (z, work.z, up)].into_iter().all(|(range, at, half)| {
            range.contains(at - half, tolerances::WINDOW) && range.contains(at + half, tolerances::WINDOW)
        }) && (self.options.column == 0.0
            || self.options.column <= plane.distance_from_axis_1(work, self.zone) + tolerances::WINDOW)
    }

    /// The score of every configuration.
    pub(super) fn scores(&self, work: &WorkPlacement, grid: &Grid) -> [Score; Configuration::COUNT] {
        self.scores_below(work, grid, Score::NONE)
    }

    /// The same where one is less than a bound; else any scores that are not: no further pose is looked at once every configuration has
    /// reached the bound, as scores only grow.
    pub(super) fn scores_below(
        &self,
        work: &WorkPlacement,
        grid: &Grid,
        bound: Score,
    ) -> [Score; Configuration::COUNT] {
        let plane = WorkPlane::of(self.options.elevation, work);
        let mut best = [Score::NONE; Configuration::COUNT];
        if !self.is_within(work, &plane) {
            return best;
        }
        let orientation = self.freed.orientation(plane.tool()).under(plane.forces(self.options.load));
        for same_branch in self.freed.same_branches(&plane.pose(work, [0.0; 2])) {
            let mut scores = [Score::LEAST; Configuration::COUNT];
            for points in grid.points.chunks(POSES) {
                let mut at = [[0.0; POSES]; 3];
                for (i, &point) in points.iter().enumerate() {
                    let point = plane.point(work, point);
                    (at[0][i], at[1][i], at[2][i]) = (point.x, point.y, point.z);
                }
                let mut found = [[0.0; POSES]; Configuration::COUNT];
                let into = found.each_mut().map(|row| &mut row[..points.len()]);
                let at = at.each_ref().map(|part| &part[..points.len()]);
                self.freed.configurations_at(&orientation, &same_branch, at, into);
                for (score, row) in scores.iter_mut().zip(&found) {
                    row[..points.len()].iter().for_each(|value| score.take(*value));
                }
                if scores.iter().all(|score| score.total_cmp(&bound).is_ge()) {
                    break;
                }
            }
            for (best, score) in best.iter_mut().zip(scores) {
                if score.total_cmp(best).is_lt() {
                    *best = score;
                }
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::super::Question;
    use super::*;
    use crate::batch::SpatialArm;
    use crate::catalogue::paper_robots;
    use crate::load::Load;
    use crate::model::Model;
    use crate::place::{PlaceOptions, ToolOrientation};
    use crate::spatial::Pose;
    use crate::task::Zone;
    use crate::watch::Watch;

    /// Below a bound a place has the score that it has without one, and what has reached it is not reported to lie below.
    #[test]
    fn a_score_is_exact_below_the_bound_and_not_below_it_elsewhere() {
        let mut rng = fastrand::Rng::with_seed(31);
        let zone = Zone::Rectangle { width: 0.5, height: 0.3 };
        let grid = Grid::of(zone, 6).outermost_first();
        let options =
            PlaceOptions { tool_orientation: Some(ToolOrientation::tool_down()), ..PlaceOptions::under(Load::UNIT) };
        let [mut exact, mut pruned, mut unreached] = [0; 3];
        for robot in paper_robots().iter().step_by(3) {
            let tool = Pose::translation(0.1, 0.0, 0.2);
            let Model::Spatial(model) = Model::spatial(robot, &tool).unwrap() else { unreachable!("spatial") };
            let arm = SpatialArm::new(robot, &tool).unwrap();
            let parts = Watch::nobody().parts(None);
            let question = Question::of(&model, &options, &parts).unwrap().expect("all of the window is left");
            let search = Search::new(robot, &arm, zone, &question);
            let works: Vec<WorkPlacement> = (0..60)
                .map(|_| {
                    let mut part = |low: f64, high: f64| low + (high - low) * rng.f64();
                    let (x, z) = (part(0.8, 2.4), part(0.3, 1.5));
                    WorkPlacement { x, y: 0.0, z, yaw: 0.0, angle: part(-3.0, 3.0), roll: part(-3.0, 3.0) }
                })
                .collect();
            let scores: Vec<Score> = works.iter().map(|work| search.candidate(*work, &grid).score).collect();
            for (work, whole) in works.iter().zip(&scores) {
                for bound in scores.iter().step_by(7) {
                    let candidate = search.candidate_below(*work, &grid, *bound);
                    if whole.total_cmp(bound).is_lt() {
                        let alone = search.candidate(*work, &grid);
                        assert_eq!((candidate.score, candidate.configuration), (*whole, alone.configuration));
                        exact += 1;
                    } else {
                        assert!(candidate.score.total_cmp(bound).is_ge(), "{candidate:?} {bound:?}");
                        pruned += usize::from(candidate.score != *whole);
                        unreached += usize::from(bound.is_feasible() && !whole.is_feasible());
                    }
                }
            }
        }
        assert!(200 < exact && 100 < pruned && 50 < unreached, "{exact} {pruned} {unreached}");
    }
}
