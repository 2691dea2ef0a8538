//! Why does a path stand nowhere?

use super::super::fixed;
use super::MillAnswer;
use nalgebra::Vector3;
use stiffarm::cell::{Cell, Window};
use stiffarm::interval::Interval;

/// Turns at which a path is measured.
const TURNS: usize = 180;

impl MillAnswer {
    /// Why no place is tried, or none of those that were holds even the outermost samples.
    pub(super) fn nowhere(&self) -> String {
        if let Some([long, wide, high]) = self.too_large_for_windows() {
            let mm = |metres: f64| fixed(metres * 1e3, 1);
            return format!(
                "no place was found: the path is larger than what is allowed for it, {} mm long and {} mm wide where it is narrowest, and {} mm high with its rapid moves",
                mm(long),
                mm(wide),
                mm(high)
            );
        }
        let kept_free = self.ground.cell.is_some_and(|cell| cell.keep_out().next().is_some());
        let keep_outs = if kept_free { "the keep-outs, " } else { "" };
        format!(
            "no place was found at which even the outermost samples are held: the window, {keep_outs}the margins or the reach leave none"
        )
    }

    /// Length and width of the path where it is narrowest, and its height, m, where no window has room for it at any turn.
    fn too_large_for_windows(&self) -> Option<[f64; 3]> {
        let extents = |yaw: f64| {
            let (s, c) = yaw.sin_cos();
            let tips = self.stations.iter().map(|station| station.sample.pose.tip);
            let turned = tips.map(|tip| Vector3::new(c * tip.x - s * tip.y, s * tip.x + c * tip.y, tip.z));
            let ends = turned.fold([f64::INFINITY, f64::NEG_INFINITY].map(Vector3::repeat), |[low, high], tip| {
                [low.inf(&tip), high.sup(&tip)]
            });
            ends[1] - ends[0]
        };
        let turns = || (0..TURNS).map(|i| extents((i as f64).to_radians()));
        // Between the turns that are measured it may be narrower by so much.
        let slack = extents(0.0).xy().norm() * 0.5_f64.to_radians();
        let has_room = |range: Interval, extent: f64, slack: f64| extent <= range.width() + slack;
        let fits = |room: [Interval; 3]| {
            turns().any(|extent| (0..3).all(|i| has_room(room[i], extent[i], if i == 2 { 1e-9 } else { slack })))
        };
        let windows = self.ground.cell.iter().flat_map(Cell::windows).map(|window| match window {
            Window::Block(block) => [block.x, block.y, block.z],
            // As far aside as it likes.
            Window::Ring { ahead, z } => [ahead, Interval::ALL, z],
        });
        let ahead = self.ground.within.map(|within| [within.x, Interval::ALL, within.z]);
        let rooms: Vec<[Interval; 3]> = windows.chain(ahead).collect();
        if rooms.is_empty() || rooms.into_iter().any(fits) {
            return None;
        }
        let narrowest = turns().min_by(|a, b| a.xy().min().total_cmp(&b.xy().min()))?;
        Some([narrowest.xy().max(), narrowest.xy().min(), narrowest.z])
    }
}
