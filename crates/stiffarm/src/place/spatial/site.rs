//! Which places does a cell allow a zone, and how are they seen from the robot?

use std::f64::consts::PI;

use nalgebra::{Point3, Rotation3, Vector3};

use super::search::{PLACES, ROLL_AT_ONE_PLACE, STEP_AT_ONE_PLACE, ahead_and_behind, fine_rolls};
use super::{Question, Solution};
use crate::angle::wrapped;
use crate::batch::SpatialArm;
use crate::cell::{Block, Cell, Window};
use crate::clearance::Solid;
use crate::interval::Interval;
use crate::place::{Orientation, Within};
use crate::spatial::Pose;
use crate::task::Zone;
use crate::tolerances;
use crate::work::{WorkPlacement, WorkPlane};

/// By how much a tool may point aside, rad: rounding.
const TURN: f64 = 1e-9;

/// A place in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Site {
    /// The centre of the zone, m, in the axes of the cell.
    pub(super) at: Vector3<f64>,
    /// The robot is turned away from it: it lies behind the joint-1 axis.
    pub(super) is_behind: bool,
    /// As in [`WorkPlacement`]; counted from the base's axes where the mount decides where the tool points.
    pub(super) yaw: f64,
    /// As in [`WorkPlacement`]; counted from the base's axes where [`Ground::angle_is_of_base`].
    pub(super) angle: f64,
    /// As in [`WorkPlacement`].
    pub(super) roll: f64,
}

/// What a cell allows a zone.
pub(super) struct Ground<'a> {
    arm: &'a SpatialArm,
    zone: Zone,
    pub(super) options: &'a Question<'a>,
    pub(super) cell: &'a Cell,
    pub(super) roll_is_free: bool,
    windows: Vec<Window>,
    /// The zone keeps its sides along those of the cell, wherever about the robot it stands.
    angle_is_of_base: bool,
}

impl<'a> Ground<'a> {
    pub(super) fn new(arm: &'a SpatialArm, zone: Zone, options: &'a Question<'a>, cell: &'a Cell) -> Self {
        let mut windows: Vec<Window> = cell.windows().collect();
        if windows.is_empty() {
            windows.push(Window::Block(Block { x: Interval::ALL, y: Interval::ALL, z: Interval::POSITIVE }));
        }
        let blocks = windows.iter().all(|window| matches!(window, Window::Block(_)));
        let is_circle = zone.is_round();
        Self {
            arm,
            zone,
            options,
            cell,
            roll_is_free: options.roll.is_none() && arm.tool_turns_about_axis_6(),
            windows,
            angle_is_of_base: blocks && options.is_vertical() && !is_circle,
        }
    }

    /// Where a site lies about the joint-1 axis, and how it is seen straight ahead from there.
    pub(super) fn local(&self, site: &Site) -> (f64, WorkPlacement) {
        let at = self.cell.mount.cell_from_base.inverse_transform_point(&site.at.into());
        let (from_axis, side) = (at.x.hypot(at.y), if site.is_behind { -1.0 } else { 1.0 });
        let bearing = if from_axis < 1e-9 { 0.0 } else { (side * at.y).atan2(side * at.x) };
        let turned = if self.cell.azimuth.is_some() { bearing } else { 0.0 };
        // Of a tool that points up the angle counts the other way about.
        let way = if self.options.elevation < 0.0 { 1.0 } else { -1.0 };
        let angle = if self.angle_is_of_base { site.angle - way * bearing } else { site.angle };
        (
            bearing,
            WorkPlacement { x: side * from_axis, y: 0.0, z: at.z, yaw: site.yaw - turned, angle, roll: site.roll },
        )
    }

    /// The site of an answer that was found straight ahead.
    pub(super) fn site(&self, bearing: f64, found: &Solution) -> Site {
        let way = if self.options.elevation < 0.0 { 1.0 } else { -1.0 };
        let [x, z] = found.centre;
        let at = Rotation3::from_axis_angle(&Vector3::z_axis(), bearing) * Point3::new(x, 0.0, z);
        let turned = if self.cell.azimuth.is_some() { bearing } else { 0.0 };
        Site {
            at: (self.cell.mount.cell_from_base * at).coords,
            is_behind: x < 0.0,
            yaw: found.yaw + turned,
            angle: found.angle + if self.angle_is_of_base { way * bearing } else { 0.0 },
            roll: found.roll,
        }
    }

    /// Nothing of what is asked of a place counts from the axes of the cell but windows and what stands there.
    pub(super) fn is_alike_all_about(&self) -> bool {
        !self.angle_is_of_base && self.cell.azimuth.is_none()
    }

    /// The question as it is asked straight ahead of a robot that is turned to a bearing. Where the mount decides where the tool points, no yaw
    /// is left to choose.
    pub(super) fn seen_from(&self, bearing: f64) -> Question<'a> {
        let cell = self.cell.with_base_turned(bearing);
        let yaw = cell.azimuth.map_or(self.options.yaw, Interval::point);
        Question { within: Within::ANYWHERE, cell: Some(cell), yaw, ..*self.options }
    }

    /// The site where the search may go: straight ahead where the cell says so.
    pub(super) fn reined(&self, site: Site) -> Site {
        if !self.cell.is_ahead {
            return site;
        }
        let cell_from_base = self.cell.mount.cell_from_base;
        let mut at = cell_from_base.inverse_transform_point(&site.at.into());
        at.y = 0.0;
        Site { at: (cell_from_base * at).coords, ..site }
    }

    /// All of the zone lies in a window, nothing of it in what must be kept free, the tool may be turned so, and the bearing is one that is meant.
    pub(super) fn allows(&self, site: &Site) -> bool {
        self.holds(site) && !self.lies_in_kept_free(site)
    }

    /// Something of the zone lies in what must be kept free.
    fn lies_in_kept_free(&self, site: &Site) -> bool {
        if self.cell.keep_out().next().is_none() {
            return false;
        }
        let (bearing, work) = self.local(site);
        let plane = WorkPlane::of(self.options.elevation, &work);
        let cell_from_here = self.cell_from(bearing);
        let half = self.half_extents(&plane, &cell_from_here);
        self.cell.keep_out().any(|block| self.lies_in(&block, site, &half, &plane, &cell_from_here))
    }

    /// Every one of some sites that would be allowed lies in what must be kept free, and there are such.
    pub(super) fn all_lie_in_kept_free(&self, sites: &[Site]) -> bool {
        let mut held = sites.iter().filter(|site| self.holds(site)).peekable();
        held.peek().is_some() && held.all(|site| self.lies_in_kept_free(site))
    }

    fn cell_from(&self, bearing: f64) -> Pose {
        self.cell.mount.cell_from_base * Pose::rotation(Vector3::z() * bearing)
    }

    /// The same, whatever must be kept free.
    fn holds(&self, site: &Site) -> bool {
        let (bearing, work) = self.local(site);
        if self.cell.is_ahead && TURN < bearing.abs() {
            return false;
        }
        let plane = WorkPlane::of(self.options.elevation, &work);
        let may_point_so = match self.cell.azimuth {
            Some(azimuth) => wrapped(site.yaw - azimuth).abs() <= TURN,
            None => self.options.is_vertical() || self.options.yaw.contains(work.yaw, TURN),
        };
        if !may_point_so {
            return false;
        }
        let half = self.half_extents(&plane, &self.cell_from(bearing));
        let slack = tolerances::WINDOW;
        self.windows.iter().any(|window| match window {
            Window::Block(block) => block.holds(&site.at, &half, slack),
            Window::Ring { ahead, z } => {
                let [along, _, _] = plane.half_extents(self.zone);
                [(ahead, work.x, along), (z, site.at.z, half.z)].into_iter().all(|(range, middle, half)| {
                    range.contains(middle - half, slack) && range.contains(middle + half, slack)
                })
            }
        })
    }

    fn lies_in(&self, block: &Block, site: &Site, half: &Vector3<f64>, plane: &WorkPlane, here: &Pose) -> bool {
        block.touches(&site.at, half) && {
            let [first, along] = [plane.first, plane.tool().column(2).into()].map(|axis| here.rotation * axis);
            let [middle, half] = block.near(&site.at);
            let solid = Solid::Box { pose: Pose::translation(middle.x, middle.y, middle.z), half: half.into() };
            Solid::sheet(self.zone, site.at, first, along).touches(&solid)
        }
    }

    /// How far the zone extends from its centre along the axes of the cell, m.
    fn half_extents(&self, plane: &WorkPlane, cell_from_here: &Pose) -> Vector3<f64> {
        let [first, second] = self.zone.sides().map(|side| side / 2.0);
        let (a, b) = (cell_from_here.rotation * plane.first * first, cell_from_here.rotation * plane.second * second);
        match self.zone {
            Zone::Circle { .. } => a.zip_map(&b, f64::hypot),
            Zone::Rectangle { .. } => a.abs() + b.abs(),
        }
    }

    /// What is asked, relaxed to all places about the robot: for the lower bound; and where centres may lie.
    pub(super) fn relaxed(&self) -> (Question<'a>, [Interval; 2]) {
        let [_, up] = self.arm.reach();
        let mut cell = *self.cell;
        if self.cell.windows().next().is_none() {
            cell.windows[0] = Some(self.windows[0]);
        }
        let [far, high] = cell.around().unwrap_or([Interval::ALL; 2]);
        let yaw = if self.cell.azimuth.is_some() { Interval::spanning(-PI, PI) } else { self.options.yaw };
        let orientation = if self.angle_is_of_base { Orientation::Free } else { self.options.orientation };
        let within = Within { x: Interval::ALL, z: high };
        let region = [far.intersect(ahead_and_behind(self.arm)), high.intersect(up)]
            .map(|range| range.unwrap_or(Interval::point(1e9)));
        (Question { within, yaw, orientation, cell: None, ..*self.options }, region)
    }

    /// The turns that are tried: yaw, angle, roll, as a site counts them.
    fn turns(&self) -> Vec<[f64; 3]> {
        let every = |step_deg: f64, turn_deg: f64| -> Vec<f64> {
            (0..(turn_deg / step_deg) as usize).map(|i| (i as f64 * step_deg).to_radians()).collect()
        };
        let yaws = match (self.cell.azimuth, self.options.yaw) {
            (Some(azimuth), _) => vec![azimuth],
            _ if self.options.is_vertical() => vec![0.0],
            (None, yaw) => {
                let count = (yaw.width().to_degrees() / 15.0).ceil().min(24.0) as usize;
                (0..=count).map(|i| yaw.min() + yaw.width() * i as f64 / count.max(1) as f64).collect()
            }
        };
        let rolls = match self.options.roll {
            Some(roll) => vec![roll],
            None if self.roll_is_free => vec![0.0],
            None => every(if self.is_one_place() { ROLL_AT_ONE_PLACE } else { 30.0 }, 360.0),
        };
        let mut turns = Vec::new();
        for &yaw in &yaws {
            for angle in self.options.angles().into_iter().map(|angle| self.angle_of_base(angle)) {
                turns.extend(rolls.iter().map(|&roll| [yaw, angle, roll]));
            }
        }
        turns
    }

    /// The one place at all rolls, finely, where no other is left to choose, and any roll will do.
    pub(super) fn at_fine_rolls(&self) -> Option<Vec<Site>> {
        if self.options.roll.is_some() || self.roll_is_free || !self.is_one_place() {
            return None;
        }
        let (sites, _) = self.sites(1.0);
        let at_first = sites.iter().filter(|site| site.roll == sites[0].roll);
        Some(at_first.flat_map(|site| fine_rolls().map(|roll| Site { roll, ..*site })).collect())
    }

    /// No place is left to choose, straight ahead, at the first of the angles that are asked for.
    pub(super) fn is_one_place(&self) -> bool {
        let angle = self.options.angles().first().copied().unwrap_or_default();
        let yaw = if self.options.is_vertical() { 0.0 } else { self.options.yaw.min() };
        let work = WorkPlacement { x: 0.0, y: 0.0, z: 0.0, yaw, angle, roll: 0.0 };
        let [far, _, high] = WorkPlane::of(self.options.elevation, &work).half_extents(self.zone);
        let is_point = |range: Interval, half: f64| {
            range.room_for(half, tolerances::ONE_PLACE).is_some_and(|room| room.width() == 0.0)
        };
        let is_one = |window: &Window| match window {
            Window::Block(_) => false,
            Window::Ring { ahead, z } => is_point(*ahead, far) && is_point(*z, high),
        };
        self.cell.is_ahead && self.windows.iter().all(is_one)
    }

    /// The angle of a site from that of the first side in the cell, counter-clockwise from its x axis, seen from above.
    fn angle_of_base(&self, in_cell: f64) -> f64 {
        if !self.angle_is_of_base {
            return in_cell;
        }
        let ahead = self.cell.mount.cell_from_base.rotation.inverse() * Vector3::x();
        let direction = ahead.y.atan2(ahead.x) + self.cell.mount.uprightness().signum() * in_cell;
        if self.options.elevation < 0.0 { direction } else { PI - direction }
    }

    /// Some window is as wide as the zone, as far as its extent is known before it has a bearing.
    pub(super) fn has_room(&self) -> bool {
        let turns = self.turns();
        let holds = |block: &Block, turn: [f64; 3]| {
            let half = self.extents_of_turn(turn);
            (0..3).all(|i| 2.0 * half[i] <= block.sides()[i].width() + 2.0 * tolerances::WINDOW)
        };
        self.windows.iter().any(|window| match window {
            Window::Block(block) => turns.iter().any(|&turn| holds(block, turn)),
            Window::Ring { .. } => true,
        })
    }

    /// Sites all over the windows, about `most` of them, and the largest distance between neighbours, m.
    pub(super) fn sites(&self, most: f64) -> (Vec<Site>, f64) {
        let turns = self.turns();
        let per_turn = most / (turns.len() * self.windows.len()) as f64;
        // Straight ahead there are two ways to go.
        let along = if self.cell.is_ahead {
            (per_turn.sqrt() as usize).clamp(4, PLACES)
        } else {
            (per_turn.cbrt() as usize).clamp(4, 24)
        };
        let (mut sites, mut step) = (Vec::new(), 0.0_f64);
        for window in &self.windows {
            for &[yaw, angle, roll] in &turns {
                let (places, apart) = match window {
                    Window::Block(block) => self.points_in_block(block, [yaw, angle, roll], along),
                    Window::Ring { ahead, z } => self.points_in_ring([*ahead, *z], [yaw, angle, roll], along),
                };
                step = step.max(apart);
                let site = |(at, is_behind)| self.reined(Site { at, is_behind, yaw, angle, roll });
                sites.extend(places.into_iter().map(site));
            }
        }
        (sites, if self.is_one_place() { STEP_AT_ONE_PLACE } else { step.max(1e-3) })
    }

    /// Centres at which the zone lies in the block, where it is not turned with its bearing.
    fn points_in_block(&self, block: &Block, turn: [f64; 3], along: usize) -> (Vec<(Vector3<f64>, bool)>, f64) {
        let base = self.cell.mount.cell_from_base.translation.vector;
        let [ahead, up] = self.arm.reach();
        let far = ahead.max().hypot(up.max().abs().max(up.min().abs()));
        let half = self.extents_of_turn(turn);
        let ranges: Vec<Option<Interval>> = (0..3)
            .map(|i| {
                let side = block.sides()[i];
                let reached = Interval::spanning(base[i] - far, base[i] + far);
                side.room_for(half[i], tolerances::ONE_PLACE)?.intersect(reached)
            })
            .collect();
        let Some(ranges) = ranges.into_iter().collect::<Option<Vec<Interval>>>() else { return (Vec::new(), 0.0) };
        let spread: Vec<Vec<f64>> = ranges.iter().map(|&range| over(range, along)).collect();
        let points = spread[0].iter().flat_map(|&x| {
            let spread = &spread;
            spread[1].iter().flat_map(move |&y| spread[2].iter().map(move |&z| (Vector3::new(x, y, z), false)))
        });
        let apart = ranges.iter().map(|range| range.width() / (along - 1) as f64).fold(0.0, f64::max);
        (points.collect(), apart)
    }

    /// Of a turn that stays the same in the cell half the sides of the upright box about the zone; else only what it is sure of.
    fn extents_of_turn(&self, [yaw, angle, roll]: [f64; 3]) -> Vector3<f64> {
        let at = self.cell.mount.cell_from_base.translation.vector;
        let site = Site { at, is_behind: false, yaw, angle, roll };
        let stays = self.angle_is_of_base || self.cell.azimuth.is_some() || self.zone.is_round();
        let (bearing, work) = self.local(&site);
        let plane = WorkPlane::of(self.options.elevation, &work);
        let cell_from_here = self.cell.mount.cell_from_base * Pose::rotation(Vector3::z() * bearing);
        let half = self.half_extents(&plane, &cell_from_here);
        if stays && (self.options.is_vertical() || self.cell.azimuth.is_some()) {
            half
        } else {
            Vector3::new(0.0, 0.0, if self.cell.mount.is_vertical() { half.z } else { 0.0 })
        }
    }

    /// Centres at which the zone lies in the ring, where it is turned with its bearing.
    fn points_in_ring(
        &self,
        [ahead, z]: [Interval; 2],
        [yaw, angle, roll]: [f64; 3],
        along: usize,
    ) -> (Vec<(Vector3<f64>, bool)>, f64) {
        let [_, up] = self.arm.reach();
        let at = self.cell.mount.cell_from_base.translation.vector;
        let (bearing, work) = self.local(&Site { at, is_behind: false, yaw, angle, roll });
        let plane = WorkPlane::of(self.options.elevation, &work);
        let high =
            self.half_extents(&plane, &(self.cell.mount.cell_from_base * Pose::rotation(Vector3::z() * bearing))).z;
        // Of a zone whose turn stays that of the cell it depends on the bearing how far it reaches ahead.
        let far = if self.angle_is_of_base { 0.0 } else { plane.half_extents(self.zone)[0] };
        let heights =
            z.room_for(high, tolerances::ONE_PLACE).and_then(|z| self.cell.mount.heights_from_base(z).intersect(up));
        let ahead =
            ahead.room_for(far, tolerances::ONE_PLACE).and_then(|ahead| ahead.intersect(ahead_and_behind(self.arm)));
        let (Some(ahead), Some(heights)) = (ahead, heights) else { return (Vec::new(), 0.0) };
        let bearings = if self.cell.is_ahead { vec![0.0] } else { over(Interval::spanning(-PI, PI), 25)[1..].to_vec() };
        let mut points = Vec::new();
        for x in over(ahead, along) {
            for height in over(heights, along) {
                points.extend(bearings.iter().map(|bearing| {
                    let at = Point3::new(x * bearing.cos(), x * bearing.sin(), height);
                    ((self.cell.mount.cell_from_base * at).coords, x < 0.0)
                }));
            }
        }
        (points, ahead.width().max(heights.width()) / (along - 1) as f64)
    }

    /// All steps along one or two of what is free.
    pub(super) fn directions(&self) -> Vec<[f64; 6]> {
        let free_angle = self.options.orientation == Orientation::Free;
        let free_yaw = self.cell.azimuth.is_none() && 0.0 < self.options.yaw.width() && !self.options.is_vertical();
        let free_roll = self.options.roll.is_none() && !self.roll_is_free;
        let free: Vec<usize> = (0..6).filter(|i| [true, true, true, free_yaw, free_angle, free_roll][*i]).collect();
        let mut directions = Vec::new();
        for (n, &i) in free.iter().enumerate() {
            for one in [1.0, -1.0] {
                let mut step = [0.0; 6];
                step[i] = one;
                directions.push(step);
                for &j in &free[n + 1..] {
                    directions.extend([1.0, -1.0].map(|other| {
                        let mut both = step;
                        both[j] = other;
                        both
                    }));
                }
            }
        }
        directions
    }
}

/// Numbers from end to end of a range; its middle where it has no width.
fn over(range: Interval, count: usize) -> Vec<f64> {
    if range.width() == 0.0 {
        return vec![range.min()];
    }
    (0..count).map(|i| range.min() + range.width() * i as f64 / (count - 1) as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::cell::Mount;
    use crate::interval::Interval;
    use crate::load::Load;
    use crate::model::Model;
    use crate::place::PlaceOptions;
    use crate::watch::Watch;

    /// Of all ways to leave sides of a block open: places are found, inside and finite.
    #[test]
    fn a_window_may_be_open_on_any_side() {
        let Model::Spatial(model) = Model::spatial(&paper_robots()[4], &Pose::identity()).unwrap() else {
            unreachable!("asked for")
        };
        let open = f64::INFINITY;
        let sides = |low: f64, high: f64| [[low, high], [-open, high], [low, open], [-open, open]];
        for mount in [Mount::pedestal(0.5), Mount::wall(1.0)] {
            for n in 0..64 {
                let side = |i: usize, low: f64, high: f64| {
                    let [low, high] = sides(low, high)[n / 4_usize.pow(i as u32) % 4];
                    Interval::spanning(low, high)
                };
                let block = Block { x: side(0, 0.2, 1.5), y: side(1, -1.0, 0.8), z: side(2, 0.4, 1.6) };
                let mut cell = Cell::of(mount);
                cell.windows[0] = Some(Window::Block(block));
                let options = PlaceOptions { cell: Some(cell), ..PlaceOptions::under(Load::UNIT) };
                let parts = Watch::nobody().parts(None);
                let question = Question::of(&model, &options, &parts).unwrap().expect("all of the window is left");
                let ground = Ground::new(&model.arm, Zone::Circle { diameter: 0.2 }, &question, &cell);
                let (sites, step) = ground.sites(500.0);
                assert!(!sites.is_empty() && step.is_finite() && 0.0 < step, "{block:?}");
                for site in sites {
                    assert!(site.at.iter().all(|part| part.is_finite()), "{block:?}: {site:?}");
                    assert!(block.holds(&site.at, &Vector3::zeros(), 1e-9), "{block:?}: {site:?}");
                }
                assert!(ground.has_room() && ground.relaxed().1.iter().all(|range| range.is_bounded()), "{block:?}");
            }
        }
    }
}
