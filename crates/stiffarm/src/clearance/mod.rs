//! How near does the arm come to the floor, to what stands about it, to the work and to itself? Links are capsules: those that enclose them, where
//! the robot file has such, else those along the lines of the arm with the radii that it states. Where it states none these are slim: what they touch
//! counts as touched. Beside them stand wide ones, inside of which nine known arms in ten lie: what those keep clear of, nine arms in ten do.

mod links;
mod mesh;
mod solid;
mod stock;

use std::sync::Arc;

use nalgebra::Vector3;

use crate::body::{Body, Capsule, Enclosing, may_meet};
use crate::cell::{Cell, MountKind};
use crate::cutting::Shank;
use crate::geometry::Geometry;
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;
use crate::stock::Remains;
use crate::task::Zone;
use links::{LINKS, Piece, Tool, enclosed, links};
pub use mesh::Mesh;
use solid::Ball;
pub(crate) use solid::Solid;
use stock::Ends;

/// The work is a sheet of this thickness, m, behind its surface.
const SHEET: f64 = 1e-3;
/// A line that runs so deep into a link, m, only grazes it.
const GRAZED: f64 = 1e-9;
/// A tool shorter than this, m, is no link.
const NO_TOOL: f64 = 1e-6;

/// A part of the arm that may touch something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// About the joint-1 axis, and out to the joint-2 axis.
    Column,
    /// Joint-2 axis to elbow.
    UpperArm,
    /// Elbow to wrist centre.
    Forearm,
    /// Wrist centre to flange.
    Wrist,
    /// Flange to tool point.
    Tool,
    /// What of the tool stands out of its spindle.
    Cutter,
    /// What of that holds the teeth.
    Shank,
}

/// What a link may touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// The floor.
    Floor,
    /// The wall or ceiling on which the robot is mounted.
    Mounting,
    /// What is machined.
    Work,
    /// The part as its mesh has it.
    Part,
    /// What is left of the block from which the part is cut.
    Stock,
    /// What holds the part.
    Fixture,
    /// A box that was asked to be kept free, by its number from 1.
    KeepOut(usize),
    /// Another link.
    Link(Link),
}

/// The nearest that any link comes to anything in one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// How far, m; less than 0 where they overlap, by so much.
    pub distance: f64,
    /// Which link.
    pub link: Link,
    /// To what.
    pub to: Obstacle,
}

/// By what it is known where the links are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinksBy {
    /// Capsules of the robot file enclose them.
    Enclosing,
    /// The robot file states how thick they are.
    Stated,
    /// Nobody says it.
    Estimated,
}

/// The nearest that any link comes to anything, over all poses that were looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// m; negative where they overlap.
    pub distance: f64,
    /// Which link.
    pub link: Link,
    /// To what.
    pub to: Obstacle,
    /// A radius in it is estimated.
    pub is_estimated: bool,
    /// How its links are known; the tool is another matter.
    pub links: LinksBy,
    /// By how much the links in it may stand out of their estimates, m, as those of nine arms in ten do at most; 0 where nothing of the arm in it
    /// is estimated.
    pub outside: f64,
    /// The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm; `None` where the bodies are known.
    pub wide: Option<Near>,
    /// The tool is among the links.
    pub knows_tool: bool,
    /// How many poses were looked at.
    pub poses: usize,
}

/// What stands about a robot, in the axes of its base.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surroundings {
    /// A point of the floor and the unit normal that leads away from it; `None` where there is none.
    pub(crate) floor: Option<[Vector3<f64>; 2]>,
    /// The same of the wall or ceiling that carries the base.
    pub(crate) mounting: Option<[Vector3<f64>; 2]>,
    /// So far the column reaches down below the base, m.
    pub(crate) pedestal: f64,
    /// What is machined.
    pub(crate) work: Option<Solid>,
    /// Boxes that must be kept free.
    pub(crate) keep_out: Vec<Solid>,
    /// What is machined, where its body is known.
    pub(crate) machined: Option<Machined>,
}

/// What is machined, and how far from it the spindle ends.
#[derive(Clone, Debug)]
pub(crate) struct Machined {
    pub(crate) pose: Pose,
    /// As it is when it is done.
    pub(crate) part: Option<Mesh>,
    /// The block from which it is cut.
    pub(crate) stock: Option<Arc<Remains>>,
    /// What holds it: the cutter, too, keeps clear of that.
    pub(crate) fixture: Option<Mesh>,
    /// `None` where that is not known, and the tool is not compared with it.
    pub(crate) cutter: Option<Cutter>,
}

/// What of a tool stands out of the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutter {
    /// Down to the tip, m.
    pub length: f64,
    /// m; 0 where it is not known, and its axis alone is compared.
    pub radius: f64,
    /// What holds the teeth, where that is known. One that is thicker than the cutter touches what the spindle may not.
    pub shank: Option<Shank>,
}

impl Cutter {
    /// The largest, m.
    pub(crate) fn widest(&self) -> f64 {
        self.thick_shank().map_or(self.radius, |shank| shank.diameter / 2.0)
    }

    /// Where it is thicker than the cutter, whose slot it would not pass.
    fn thick_shank(&self) -> Option<Shank> {
        self.shank.filter(|shank| self.radius < shank.diameter / 2.0 && shank.flute < self.length)
    }
}

/// A robot whose links have a thickness.
#[derive(Clone, Debug)]
pub(crate) struct ThickArm<'a> {
    geometry: &'a Geometry,
    body: Body,
    enclosing: Option<&'a Enclosing>,
    /// Where neither is known: what nine known arms in ten lie inside of.
    wide: Option<Enclosing>,
    /// Which links may meet, by their numbers, the lower one first: those between which others stand, but those of which it is known that they always
    /// touch.
    meets: [[bool; LINKS]; LINKS],
    is_estimated: bool,
    tool: Option<Tool>,
    /// The wrist centre is the tool point: it touches the work, and what lies beyond is not known.
    ends_at_wrist: bool,
}

impl Surroundings {
    /// Nothing but a floor, so high above the base, m; not even that where `None`.
    pub(crate) fn above(floor: Option<f64>) -> Self {
        Self { floor: floor.map(|height| [Vector3::new(0.0, 0.0, height), Vector3::z()]), ..Self::default() }
    }

    /// What a cell says; only a floor, so high above the base, m, where there is no cell.
    pub(crate) fn of(cell: Option<&Cell>, floor: Option<f64>) -> Self {
        let Some(cell) = cell else { return Self::above(floor) };
        let (mount, base_from_cell) = (cell.mount, cell.mount.cell_from_base.inverse());
        let base = mount.cell_from_base.translation.vector;
        let solid = |block: crate::cell::Block| {
            let [middle, half] = block.near(&base);
            Solid::Box { pose: base_from_cell * Pose::translation(middle.x, middle.y, middle.z), half: half.into() }
        };
        let carries = matches!(mount.kind, MountKind::Wall | MountKind::Ceiling);
        Self {
            floor: Some([base_from_cell.translation.vector, base_from_cell.rotation * Vector3::z()]),
            mounting: carries.then(|| [Vector3::zeros(), Vector3::z()]),
            pedestal: if mount.kind == MountKind::Pedestal { base.z.max(0.0) } else { 0.0 },
            work: None,
            machined: None,
            keep_out: cell.keep_out().map(solid).collect(),
        }
    }
}

impl Clearance {
    /// Without how well that is known.
    pub(crate) fn near(&self) -> Near {
        Near { distance: self.distance, link: self.link, to: self.to }
    }

    /// The nearer one of two, and of both the nearest that is wide.
    pub(crate) fn and(self, other: Self) -> Self {
        let wide = [self.wide, other.wide].into_iter().flatten().min_by(|a, b| a.distance.total_cmp(&b.distance));
        Self { wide, ..if other.distance < self.distance { other } else { self } }
    }
}

impl Link {
    /// As answers tell it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Column => "column",
            Self::UpperArm => "upper arm",
            Self::Forearm => "forearm",
            Self::Wrist => "wrist",
            Self::Tool => "tool",
            Self::Cutter => "cutter",
            Self::Shank => "shank",
        }
    }
}

impl<'a> ThickArm<'a> {
    /// With its tool, whose radius is estimated where `None`; nothing where only two links of the robot are known.
    pub(crate) fn new(robot: &'a Robot, flange_from_tool: &Pose, tool_radius: Option<f64>) -> Option<Self> {
        let Arm::SixAxis { geometry, .. } = &robot.arm else { return None };
        let (body, is_estimated) = robot.thickness();
        let point = flange_from_tool.translation.vector;
        let radius = tool_radius.unwrap_or_else(|| body.spindle());
        let tool = (NO_TOOL < point.norm()).then_some(Tool { point, radius });
        let enclosing = robot.enclosing.as_ref();
        let wide = (is_estimated && enclosing.is_none()).then(|| robot.estimated_bodies(geometry));
        let is_estimated = wide.is_some() || tool.is_some() && tool_radius.is_none();
        let not_compared = enclosing.map_or(&[][..], |enclosing| &enclosing.not_compared);
        let meets = |pair: [usize; 2]| may_meet(pair) && !not_compared.contains(&pair);
        let meets = std::array::from_fn(|low| std::array::from_fn(|high| meets([low, high])));
        Some(Self { geometry, body, enclosing, wide, meets, is_estimated, tool, ends_at_wrist: false })
    }

    /// Upper arm and forearm of the arm plane, the tool point at the wrist centre.
    pub(crate) fn to_wrist(robot: &'a Robot) -> Option<Self> {
        Some(Self { ends_at_wrist: true, ..Self::new(robot, &Pose::identity(), None)? })
    }

    /// The nearest to anything over postures given by their model angles; `None` where there are none, or nothing to meet.
    pub(crate) fn clearance(&self, postures: &[[f64; 6]], about: &Surroundings) -> Option<Clearance> {
        let (mut nearest, mut before) = (Nearest::looked(Looked::ALL), Vec::new());
        let (mut widest, mut wide_before) = (Nearest::looked(Looked::ALL), Vec::new());
        for theta in postures {
            let pieces = self.pieces(theta, about.pedestal);
            self.compare(&pieces, &before, (about, 0), &mut nearest);
            self.compare_links(&pieces, &mut nearest);
            before = pieces;
            if let Some(pieces) = self.wide_pieces(theta, about.pedestal) {
                self.compare(&pieces, &wide_before, (about, 0), &mut widest);
                wide_before = pieces;
            }
        }
        nearest.near.map(|near| self.told(near, widest.near, postures.len()))
    }

    /// The nearest to anything in one posture, by its model angles, before some sample of the path by which a block is cut; `None` where there is
    /// nothing to meet, or not as near as is looked.
    pub(crate) fn nearest(&self, theta: &[f64; 6], about: (&Surroundings, usize), looked: Looked) -> Option<Near> {
        let (mut nearest, pieces) = (Nearest::looked(looked), self.pieces(theta, about.0.pedestal));
        self.compare(&pieces, &[], about, &mut nearest);
        self.compare_links(&pieces, &mut nearest);
        nearest.near
    }

    /// The same of bodies inside of which nine known arms in ten lie, and what stands about the arm; `None`, too, where the bodies are known.
    pub(crate) fn nearest_wide(&self, theta: &[f64; 6], about: (&Surroundings, usize), looked: Looked) -> Option<Near> {
        let mut nearest = Nearest::looked(looked);
        self.compare(&self.wide_pieces(theta, about.0.pedestal)?, &[], about, &mut nearest);
        nearest.near
    }

    /// By how much a link may stand out of what it is taken for, m.
    fn outside(&self, link: Link) -> f64 {
        if self.wide.is_none() {
            return 0.0;
        }
        let [column, upper_arm, forearm, wrist] = self.body.outside();
        match link {
            Link::Column => column,
            Link::UpperArm => upper_arm,
            Link::Forearm => forearm,
            Link::Wrist => wrist,
            Link::Tool | Link::Cutter | Link::Shank => 0.0,
        }
    }

    /// The nearest of so many poses, with how well that is known.
    pub(crate) fn told(&self, Near { distance, link, to }: Near, wide: Option<Near>, poses: usize) -> Clearance {
        let (is_estimated, knows_tool) = (self.is_estimated, !self.ends_at_wrist);
        let other = if let Obstacle::Link(other) = to { self.outside(other) } else { 0.0 };
        let outside = self.outside(link) + other;
        let links = match (self.enclosing, &self.wide) {
            (Some(_), _) => LinksBy::Enclosing,
            (None, Some(_)) => LinksBy::Estimated,
            (None, None) => LinksBy::Stated,
        };
        Clearance { distance, link, to, is_estimated, links, outside, wide, knows_tool, poses }
    }

    /// No point of what a joint moves is farther from its axis in any posture, m, with a cutter of this radius, m, in the spindle.
    ///
    /// From the wrist centre, through which the axes of joints 4 to 6 go, backwards: each link adds its length, and what it carries may stretch
    /// out as far as it can.
    pub(crate) fn farthest(&self, cutter: f64) -> [f64; 6] {
        match self.enclosing {
            Some(enclosing) => self.farthest_of(enclosing, cutter),
            None => self.farthest_along_links(cutter),
        }
    }

    /// The same of the bodies inside of which nine known arms in ten lie; `None` where the bodies are known.
    pub(crate) fn farthest_wide(&self, cutter: f64) -> Option<[f64; 6]> {
        Some(self.farthest_of(self.wide.as_ref()?, cutter))
    }

    /// From the wrist centre.
    fn farthest_of_tool(&self, cutter: f64) -> f64 {
        let c4 = self.geometry.c4;
        let about_wrist = |point: &Vector3<f64>| (point + Vector3::z() * c4).norm();
        let of_tool = |Tool { point, radius }: Tool| about_wrist(&point).max(c4.abs()) + radius.max(cutter);
        self.tool.map_or(0.0, of_tool)
    }

    fn farthest_along_links(&self, cutter: f64) -> [f64; 6] {
        let Geometry { a1, b, c2, c4, .. } = self.geometry;
        let wrist = (c4.abs() + self.body.wrist).max(self.farthest_of_tool(cutter));
        let elbow = self.geometry.l3() + self.body.forearm.max(wrist);
        let shoulder = c2.abs() + self.body.upper_arm.max(elbow);
        [a1.hypot(*b) + shoulder, shoulder, elbow, wrist, wrist, wrist]
    }

    fn farthest_of(&self, enclosing: &Enclosing, cutter: f64) -> [f64; 6] {
        let (Geometry { a1, b, c2, .. }, l3) = (self.geometry, self.geometry.l3());
        // A link stays as far from a point of the axis that turns it as it is at model zero.
        let [_, shoulder_at, elbow_at, wrist_at, _] = self.geometry.points(&[0.0; 6]).map(Vector3::from);
        let from = |point: &Vector3<f64>, links: std::ops::Range<usize>| {
            let capsules = enclosing.links[links].iter().flatten();
            capsules.map(|capsule| capsule.farthest_from(point)).fold(0.0, f64::max)
        };
        let wrist = from(&wrist_at, 4..7).max(self.farthest_of_tool(cutter));
        let elbow = from(&elbow_at, 3..4).max(l3 + wrist);
        let shoulder = from(&shoulder_at, 2..3).max(c2.abs() + elbow);
        let column = from(&Vector3::new(0.0, 0.0, shoulder_at.z), 1..2).max(a1.hypot(*b) + shoulder);
        [column, shoulder, elbow, wrist, wrist, wrist]
    }

    fn pieces(&self, theta: &[f64; 6], pedestal: f64) -> Vec<Piece> {
        self.known_of(match self.enclosing {
            Some(enclosing) => enclosed(self.geometry, enclosing, (pedestal, self.body.column), theta, self.tool),
            None => links(self.geometry, &self.body, pedestal, theta, self.tool),
        })
    }

    fn wide_pieces(&self, theta: &[f64; 6], pedestal: f64) -> Option<Vec<Piece>> {
        let wide = self.wide.as_ref()?;
        Some(self.known_of(enclosed(self.geometry, wide, (pedestal, self.body.column), theta, self.tool)))
    }

    fn known_of(&self, mut pieces: Vec<Piece>) -> Vec<Piece> {
        if self.ends_at_wrist {
            pieces.retain(|piece| piece.link != Link::Wrist);
        }
        pieces
    }

    /// A link stands between a point on the wrist and another one, m from the base, at model angles.
    ///
    /// Wrist and forearm do not hide a point that lies in them: it sits there, and how thick they are is coarse.
    pub(crate) fn hides(&self, theta: &[f64; 6], marker: &Vector3<f64>, from: &Vector3<f64>) -> bool {
        let [line, point] = [*from, *marker].map(|end| Capsule { ends: [*marker, end], radius: 0.0 });
        let carries = |Piece { link, capsule, .. }: &Piece| {
            matches!(link, Link::Forearm | Link::Wrist) && point.apart_from(capsule) <= -GRAZED
        };
        let hides = |piece: &Piece| !carries(piece) && line.apart_from(&piece.capsule) < -GRAZED;
        self.pieces(theta, 0.0).iter().any(hides)
    }

    /// Looks at every pair of links that may meet in one posture.
    fn compare_links(&self, pieces: &[Piece], nearest: &mut Nearest) {
        if nearest.is_enough() {
            return;
        }
        let balls: Vec<Ball> = pieces.iter().map(|piece| piece.capsule.ball()).collect();
        for (i, piece) in pieces.iter().enumerate() {
            let Some(capsule) = shown(pieces, i) else { continue };
            for (other, ball) in pieces.iter().zip(&balls) {
                if self.meets[other.number][piece.number] && balls[i].is_within(nearest.within, ball) {
                    nearest.take(capsule.apart_from(&other.capsule), piece.link, Obstacle::Link(other.link));
                }
            }
        }
    }

    /// Looks at all that stands about the arm. It does not move, so that of a link that stands where it did before nothing new is to be said.
    fn compare(
        &self,
        pieces: &[Piece],
        before: &[Piece],
        (about, sample): (&Surroundings, usize),
        nearest: &mut Nearest,
    ) {
        let Some(last) = pieces.last().map(|piece| piece.link) else { return };
        for (i, piece) in pieces.iter().enumerate() {
            if nearest.is_enough() {
                return;
            }
            let Piece { link, capsule, .. } = *piece;
            if before.get(i) == Some(piece) {
                continue;
            }
            // In the arm plane the work lies where the links move.
            let may_touch = if self.ends_at_wrist { link == Link::Column } else { link != last };
            if let Some(work) = about.work.filter(|_| may_touch) {
                nearest.solid((link, &capsule), Obstacle::Work, &work);
            }
            if let Some(machined) = &about.machined {
                if link != last {
                    nearest.machined(link, (&capsule, Ends::Round), machined, sample);
                } else if let Some(cutter) = machined.cutter.filter(|_| link == Link::Tool) {
                    nearest.tool(&capsule, &cutter, machined, sample);
                }
            }
            let Some(capsule) = shown(pieces, i) else { continue };
            if let Some([through, up]) = about.floor.filter(|_| link != Link::Column) {
                nearest.take(capsule.above(&through, &up), link, Obstacle::Floor);
            }
            if let Some([through, up]) = about.mounting.filter(|_| link != Link::Column) {
                nearest.take(capsule.above(&through, &up), link, Obstacle::Mounting);
            }
            for (i, solid) in about.keep_out.iter().enumerate() {
                nearest.solid((link, &capsule), Obstacle::KeepOut(i + 1), solid);
            }
        }
    }
}

/// What of a piece is compared: the last one is there to touch the work, and the round end of its capsule would reach beyond. `None` where nothing
/// is left of it.
fn shown(pieces: &[Piece], i: usize) -> Option<Capsule> {
    let Piece { link, capsule, .. } = pieces[i];
    let is_last = i + 1 == pieces.len() && link != Link::Wrist;
    if is_last { capsule.cut_back(capsule.radius) } else { Some(capsule) }
}

/// How far it is looked for what is nearest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Looked {
    /// Of what is nearer than this, m, anything does: nothing else is looked at.
    pub(crate) enough: f64,
    /// Nothing that is farther, m, is looked at.
    pub(crate) within: f64,
}

impl Looked {
    pub(crate) const ALL: Self = Self { enough: f64::NEG_INFINITY, within: f64::INFINITY };
}

/// The nearest so far.
struct Nearest {
    near: Option<Near>,
    /// Nothing farther is looked at, m.
    within: f64,
    /// What is nearer than this, m, is near enough: nothing else is looked at.
    enough: f64,
}

impl Nearest {
    fn looked(Looked { enough, within }: Looked) -> Self {
        Self { near: None, within, enough }
    }

    fn is_enough(&self) -> bool {
        self.within < self.enough
    }

    fn take(&mut self, distance: f64, link: Link, to: Obstacle) {
        if distance < self.within {
            (self.near, self.within) = (Some(Near { distance, link, to }), distance);
        }
    }

    /// What is so far at least may be nearer than what is known.
    fn may_be(&self, at_least: f64) -> bool {
        !(self.within <= at_least)
    }

    /// Spindle and shank keep clear of all that is machined, the cutter of what holds it.
    fn tool(&mut self, tool: &Capsule, cutter: &Cutter, about: &Machined, sample: usize) {
        let spindle = tool.cut_back(cutter.length);
        if let Some(spindle) = &spindle {
            self.machined(Link::Tool, (spindle, Ends::Flat), about, sample);
        }
        let out_of = spindle.map_or(tool.ends[0], |spindle| spindle.ends[1]);
        let cylinder = Capsule { ends: [out_of, tool.ends[1]], radius: cutter.radius };
        if let Some(shank) = cutter.thick_shank()
            && let Some(above) = cylinder.cut_back(shank.flute)
        {
            let shank = Capsule { radius: shank.diameter / 2.0, ..above };
            self.machined(Link::Shank, (&shank, Ends::Flat), about, sample);
        }
        self.fixture(Link::Cutter, (&cylinder, Ends::Flat), about);
    }

    /// As of a solid.
    fn machined(&mut self, link: Link, (capsule, ends): (&Capsule, Ends), about: &Machined, sample: usize) {
        let Machined { pose, part, stock, .. } = about;
        if let Some(part) = part {
            self.mesh((link, capsule, ends), (part, pose), Obstacle::Part);
        }
        self.fixture(link, (capsule, ends), about);
        if let Some(stock) = stock
            && let Some(apart) = stock.apart_from((pose, sample), (capsule, ends), self.within)
        {
            self.take(apart, link, Obstacle::Stock);
        }
    }

    /// As of a solid.
    fn fixture(&mut self, link: Link, (capsule, ends): (&Capsule, Ends), about: &Machined) {
        if let Some(fixture) = &about.fixture {
            self.mesh((link, capsule, ends), (fixture, &about.pose), Obstacle::Fixture);
        }
    }

    /// As of a solid.
    fn mesh(&mut self, (link, capsule, ends): (Link, &Capsule, Ends), (mesh, pose): (&Mesh, &Pose), to: Obstacle) {
        if self.may_be(capsule.apart_from_ball(&mesh.ball(pose))) {
            let apart = match ends {
                Ends::Round => mesh.apart_from(pose, capsule),
                Ends::Flat => mesh.apart_from_cylinder(pose, capsule),
            };
            self.take(apart, link, to);
        }
    }

    /// Asks `parry` only where the ball and the box about it come nearer than what is known.
    fn solid(&mut self, (link, capsule): (Link, &Capsule), to: Obstacle, solid: &Solid) {
        if self.may_be(capsule.apart_from_ball(&solid.ball())) && self.may_be(capsule.at_least_from(solid)) {
            self.take(capsule.apart_from_solid(solid), link, to);
        }
    }
}

impl Solid {
    /// The sheet behind a flat zone, from its middle point, the directions of its sides and the one in which the tool points.
    pub(crate) fn sheet(zone: Zone, centre: Vector3<f64>, first: Vector3<f64>, along_tool: Vector3<f64>) -> Self {
        let axes = nalgebra::Matrix3::from_columns(&[first, along_tool.cross(&first), along_tool]);
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(axes);
        let pose = Pose::from_parts((centre + along_tool * (SHEET / 2.0)).into(), rotation.into());
        match zone {
            Zone::Circle { diameter } => Self::Disc { pose, radius: diameter / 2.0, half_thickness: SHEET / 2.0 },
            Zone::Rectangle { width, height } => Self::Box { pose, half: [width / 2.0, height / 2.0, SHEET / 2.0] },
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::catalogue::find;

    /// A robot with round lengths and radii.
    fn robot() -> Robot {
        let mut robot = find("KR 210 R2700 extra").unwrap().robot();
        let Arm::SixAxis { geometry, .. } = &mut robot.arm else { unreachable!("it has six axes") };
        *geometry = Geometry { a1: 0.3, a2: 0.0, b: 0.0, c1: 0.7, c2: 1.0, c3: 1.0, c4: 0.2, ..geometry.clone() };
        robot.body = Some(Body::from([0.3, 0.2, 0.15, 0.1]));
        robot
    }

    fn nearest(robot: &Robot, tool: Option<f64>, theta: [f64; 6], about: &Surroundings) -> (f64, Link, Obstacle) {
        let flange_from_tool = tool.map_or(Pose::identity(), |length| Pose::translation(0.0, 0.0, length));
        let thick = ThickArm::new(robot, &flange_from_tool, Some(0.05)).unwrap();
        let found = thick.clearance(&[theta], about).unwrap();
        assert!(!found.is_estimated && found.knows_tool && found.poses == 1);
        ((found.distance * 1e6).round() / 1e6, found.link, found.to)
    }

    /// Upper arm up, forearm level at 1.7 m, the wrist centre 1.3 m ahead.
    const LEVEL: [f64; 6] = [0.0, 0.0, FRAC_PI_2, 0.0, 0.0, 0.0];
    /// The same, the tool down.
    const DOWN: [f64; 6] = [0.0, 0.0, FRAC_PI_2, 0.0, FRAC_PI_2, 0.0];

    #[test]
    fn the_nearest_of_all_links_is_that_of_a_hand_calculation() {
        let (robot, floor) = (robot(), Surroundings::above(Some(0.0)));
        // The joint-2 axis stands 0.7 m high, and the upper arm is 0.2 m thick there.
        assert_eq!(nearest(&robot, None, LEVEL, &floor), (0.5, Link::UpperArm, Obstacle::Floor));
        let far = Solid::Box { pose: Pose::translation(9.0, 0.0, 0.0), half: [0.1; 3] };
        let post = Solid::Box { pose: Pose::translation(1.1, 0.0, 0.7), half: [0.1, 0.1, 0.7] };
        let fenced = Surroundings { keep_out: vec![far, post], ..floor.clone() };
        // 1.7 m - 1.4 m - 0.15 m.
        assert_eq!(nearest(&robot, None, LEVEL, &fenced), (0.15, Link::Forearm, Obstacle::KeepOut(2)));
        // The flange stands 1.5 m high, and the tool point touches the work.
        let disc =
            Solid::sheet(Zone::Circle { diameter: 0.6 }, Vector3::new(1.3, 0.0, 1.25), Vector3::x(), -Vector3::z());
        let work = Surroundings { work: Some(disc), ..floor };
        assert_eq!(nearest(&robot, Some(0.25), DOWN, &work), (0.25, Link::Wrist, Obstacle::Work));
        // A table 0.1 m under the tool point: the tool counts up to its point.
        let table = Solid::Box { pose: Pose::translation(1.3, 0.0, 1.1), half: [0.2, 0.2, 0.05] };
        let on_a_table = Surroundings { keep_out: vec![table], ..work };
        assert_eq!(nearest(&robot, Some(0.25), DOWN, &on_a_table), (0.1, Link::Tool, Obstacle::KeepOut(1)));
    }

    #[test]
    fn an_arm_that_folds_back_meets_its_own_column() {
        let robot = robot();
        // Upper arm forwards and level at 0.7 m, the forearm back over it: the wrist centre at 0.3 m, 0.7 m high.
        let theta = [0.4, FRAC_PI_2, std::f64::consts::PI, 0.0, 0.0, 0.0];
        let (distance, link, to) = nearest(&robot, None, theta, &Surroundings::default());
        // The flange lies 0.1 m before the joint-1 axis; the lines of both run into each other.
        assert_eq!((distance, link, to), (-0.35, Link::Forearm, Obstacle::Link(Link::Column)));
    }

    /// Capsules that stand where those along the lines of the arm do are as near to everything, in every posture.
    #[test]
    fn enclosing_capsules_move_with_their_links() {
        let coarse = robot();
        let Arm::SixAxis { geometry, .. } = &coarse.arm else { unreachable!("it has six axes") };
        let mut enclosing = Enclosing::default();
        for piece in links(geometry, &coarse.thickness().0, 0.0, &[0.0; 6], None) {
            enclosing.links[piece.number].push(piece.capsule);
        }
        let enclosed = Robot { enclosing: Some(enclosing), ..coarse.clone() };
        let post = Solid::Box { pose: Pose::translation(1.1, 0.2, 0.7), half: [0.1, 0.1, 0.7] };
        let about = Surroundings { keep_out: vec![post], ..Surroundings::above(Some(0.0)) };
        let mut rng = fastrand::Rng::with_seed(4);
        let mut met = Vec::new();
        for _ in 0..300 {
            let theta: [f64; 6] = std::array::from_fn(|_| 4.0 * (rng.f64() - 0.5));
            let [a, b] = [&coarse, &enclosed].map(|robot| nearest(robot, Some(0.3), theta, &about));
            assert!((a.0 - b.0).abs() < 2e-6 && a.1 == b.1 && a.2 == b.2, "{a:?} {b:?}");
            met.push(a.2);
        }
        for to in [Obstacle::Floor, Obstacle::KeepOut(1), Obstacle::Link(Link::Column)] {
            assert!(met.contains(&to), "{to:?}");
        }
        // A pair that is not compared is not.
        let folded = [0.4, FRAC_PI_2, std::f64::consts::PI, 0.0, 0.0, 0.0];
        let near = |robot: &Robot| nearest(robot, None, folded, &Surroundings::default());
        assert_eq!(near(&enclosed).0, -0.35);
        let mut left_out = enclosed;
        left_out.enclosing.as_mut().unwrap().not_compared = vec![[1, 3]];
        assert!(-0.35 < near(&left_out).0);
    }

    #[test]
    fn no_point_of_a_capsule_is_farther_from_an_axis_than_it_is_said_to_be() {
        let mut robot = robot();
        let mut rng = fastrand::Rng::with_seed(6);
        let mut any = |at: Vector3<f64>| at + Vector3::from_fn(|_, _| 0.6 * (rng.f64() - 0.5));
        let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("it has six axes") };
        let [foot, shoulder, elbow, wrist, flange] = geometry.points(&[0.0; 6]).map(Vector3::from);
        let links = [foot, shoulder, elbow, elbow, wrist, wrist, flange].map(|at| {
            vec![Capsule { ends: [any(at), any(at)], radius: 0.1 }, Capsule { ends: [any(at), any(at)], radius: 0.2 }]
        });
        robot.enclosing = Some(Enclosing { links, not_compared: Vec::new() });
        let Arm::SixAxis { geometry, .. } = &robot.arm else { unreachable!("it has six axes") };
        let thick = ThickArm::new(&robot, &Pose::translation(0.1, 0.0, 0.3), None).unwrap();
        let (said, mut seen) = (thick.farthest(0.0), [0.0_f64; 6]);
        for _ in 0..2000 {
            let theta: [f64; 6] = std::array::from_fn(|_| 6.0 * (rng.f64() - 0.5));
            let axes = geometry.axes(&theta);
            for Piece { number, capsule, .. } in thick.pieces(&theta, 0.0) {
                for (joint, (along, through)) in axes.iter().enumerate().take(number.min(6)) {
                    let off = |end: &Vector3<f64>| (end - through).cross(along).norm() + capsule.radius;
                    seen[joint] = seen[joint].max(capsule.ends.iter().map(off).fold(0.0, f64::max));
                }
            }
        }
        for (seen, said) in seen.iter().zip(said) {
            assert!(*seen <= said && said < 2.0 * seen, "{seen} {said}");
        }
    }

    #[test]
    fn of_two_links_the_wrist_touches_the_work() {
        let robot = robot();
        let thick = ThickArm::to_wrist(&robot).unwrap();
        // Upper arm level forwards at 0.7 m, forearm straight down to -0.3 m, and 0.15 m of it are left out.
        let theta = [0.0, FRAC_PI_2, FRAC_PI_2, 0.0, 0.0, 0.0];
        let found = thick.clearance(&[theta], &Surroundings::above(Some(0.0))).unwrap();
        assert!((found.distance + 0.3).abs() < 1e-12 && found.link == Link::Forearm && !found.knows_tool, "{found:?}");
    }
}
