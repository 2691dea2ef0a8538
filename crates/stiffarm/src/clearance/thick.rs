//! A robot whose links have a thickness: what of it is compared with what, in one posture and in many.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::links::{LINKS, Piece, TOOL, Tool, enclosed, links, piece_of_tool};
use super::nearest::{Looked, Nearest};
use super::solid::{Ball, Solid};
use super::stock::Ends;
use super::{Clearance, Link, LinksBy, Near, Obstacle, Surroundings};
use crate::body::{Body, Capsule, Enclosing, may_meet};
use crate::geometry::Geometry;
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;

/// A line that runs so deep into a link, m, only grazes it.
const GRAZED: f64 = 1e-9;
/// Angles of joint 1 at which what it turns is compared.
const TURNS: u32 = 180;
/// A tool that lies so deep in the forearm, m, is folded back into it.
const FOLDED: f64 = 1e-3;
/// A tool shorter than this, m, is no link.
const NO_TOOL: f64 = 1e-6;

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
    /// Nobody says how thick the tool is.
    tool_is_estimated: bool,
    tool: Option<Tool>,
    /// From which share of it on the tool is compared with the forearm, which carries the wrist before it; `None` where it is not, as of
    /// estimated bodies.
    free_from: Option<f64>,
    /// The wrist centre is the tool point: it touches the work, and what lies beyond is not known.
    ends_at_wrist: bool,
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
        let not_compared = enclosing.map_or(&[][..], |enclosing| &enclosing.not_compared);
        let meets = |pair: [usize; 2]| may_meet(pair) && !not_compared.contains(&pair);
        let meets = std::array::from_fn(|low| std::array::from_fn(|high| meets([low, high])));
        // How thick an estimated forearm is where it carries the wrist says little.
        let free_from = tool.filter(|_| wide.is_none()).and_then(|tool| free_from(geometry, &body, enclosing, tool));
        let tool_is_estimated = tool_radius.is_none();
        Some(Self { geometry, body, enclosing, wide, meets, tool_is_estimated, tool, free_from, ends_at_wrist: false })
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
            self.compare_folded(&pieces, &mut nearest);
            before = pieces;
            if let Some(pieces) = self.wide_pieces(theta, about.pedestal) {
                self.compare(&pieces, &wide_before, (about, 0), &mut widest);
                wide_before = pieces;
            }
        }
        nearest.near.map(|near| self.clearance_of(near, widest.near, postures.len()))
    }

    /// The nearest to anything in one posture, by its model angles, before some sample of the path by which a block is cut; `None` where there is
    /// nothing to meet, or not as near as is looked.
    pub(crate) fn nearest(&self, theta: &[f64; 6], about: (&Surroundings, usize), looked: Looked) -> Option<Near> {
        let (mut nearest, pieces) = (Nearest::looked(looked), self.pieces(theta, about.0.pedestal));
        self.compare(&pieces, &[], about, &mut nearest);
        self.compare_links(&pieces, &mut nearest);
        nearest.near
    }

    /// The tool in the forearm, where the wrist folds it back into that in a posture, by its model angles.
    pub(crate) fn folded(&self, theta: &[f64; 6]) -> Option<Near> {
        let mut nearest = Nearest::looked(Looked::ALL);
        self.compare_folded(&self.pieces(theta, 0.0), &mut nearest);
        nearest.near
    }

    /// The same of bodies inside of which nine known arms in ten lie, and what stands about the arm; `None`, too, where the bodies are known.
    pub(crate) fn nearest_wide(&self, theta: &[f64; 6], about: (&Surroundings, usize), looked: Looked) -> Option<Near> {
        let mut nearest = Nearest::looked(looked);
        self.compare(&self.wide_pieces(theta, about.0.pedestal)?, &[], about, &mut nearest);
        nearest.near
    }

    /// The nearest that the tool alone comes to what stands about the arm, from the flange and the tool point, m; `None`, too, where there is no
    /// tool.
    pub(crate) fn nearest_of_tool(
        &self,
        ends: [Vector3<f64>; 2],
        about: (&Surroundings, usize),
        looked: Looked,
    ) -> Option<Near> {
        let mut nearest = Nearest::looked(looked);
        self.compare_one(&[piece_of_tool(ends, self.tool?)], 0, about, &mut nearest);
        nearest.near
    }

    /// No point of the tool with a cutter of this radius, m, in the spindle is farther from its tip, m; `None` where there is no tool.
    pub(crate) fn farthest_from_tip(&self, cutter: f64) -> Option<f64> {
        self.tool.map(|tool| tool.point.norm().hypot(tool.radius.max(cutter)))
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

    /// Nobody says how thick it is.
    fn estimates(&self, link: Link) -> bool {
        match link {
            Link::Column | Link::UpperArm | Link::Forearm | Link::Wrist => self.wide.is_some(),
            Link::Tool => self.tool_is_estimated,
            Link::Cutter | Link::Shank => false,
        }
    }

    /// The nearest of so many poses, with how well that is known.
    pub(crate) fn clearance_of(
        &self,
        Near { distance, link, to }: Near,
        wide: Option<Near>,
        poses: usize,
    ) -> Clearance {
        let other = if let Obstacle::Link(other) = to { Some(other) } else { None };
        let is_estimated = [Some(link), other].into_iter().flatten().any(|link| self.estimates(link));
        let outside = self.outside(link) + other.map_or(0.0, |other| self.outside(other));
        let knows_tool = !self.ends_at_wrist;
        let links = match (self.enclosing, &self.wide) {
            (Some(_), _) => LinksBy::Enclosing,
            (None, Some(_)) => LinksBy::Estimated,
            (None, None) => LinksBy::Stated,
        };
        Clearance { distance, link, to, is_estimated, links, outside, wide, knows_tool, poses }
    }

    /// The boxes in or on which stands what no joint moves, by their numbers from 1.
    pub(super) fn stands_in(&self, about: &Surroundings) -> Vec<usize> {
        let still: Vec<Piece> =
            self.pieces(&[0.0; 6], about.pedestal).into_iter().filter(Piece::stands_still).collect();
        let holds = |solid: &Solid| still.iter().any(|piece| piece.capsule.apart_from_solid(solid) <= 0.0);
        (1..).zip(&about.keep_out).filter(|(_, solid)| holds(solid)).map(|(number, _)| number).collect()
    }

    /// What comes nearer than `asked`, m, to a box that is kept free, wherever the joints stand, and how far from it it is at most; `None` where
    /// nothing does for certain.
    ///
    /// Of what joint 1 alone turns, and of the ball about the joint-2 axis that the upper arm always fills, all around: from the nearest angle that
    /// is compared no point of it moves farther than half a step of its arc.
    pub(crate) fn always_nearer(&self, about: &Surroundings, asked: f64) -> Option<Near> {
        let step = TAU / f64::from(TURNS);
        let pieces = self.turned_by_first(about.pedestal);
        let mut least: Option<Near> = None;
        for (number, solid) in (1..).zip(&about.keep_out) {
            for piece in pieces.iter().filter(|piece| !piece.is_carried_by(solid)) {
                let between = piece.capsule.farthest_from_axis_1() * step / 2.0;
                let apart = (0..TURNS).map(|i| piece.capsule.about_axis_1(f64::from(i) * step).apart_from_solid(solid));
                let distance = apart.fold(f64::NEG_INFINITY, f64::max) + between;
                if distance < least.map_or(asked, |near| near.distance) {
                    least = Some(Near { distance, link: piece.link, to: Obstacle::KeepOut(number) });
                }
            }
        }
        least
    }

    /// What no joint but the first moves, at model zero.
    fn turned_by_first(&self, pedestal: f64) -> Vec<Piece> {
        let [_, shoulder, ..] = self.geometry.points(&[0.0; 6]).map(Vector3::from);
        let at_shoulder = Capsule { ends: [shoulder; 2], radius: 0.0 };
        let kept = |piece: Piece| match piece.number {
            0 | 1 => Some(piece),
            2 => {
                let radius = -at_shoulder.apart_from(&piece.capsule);
                (0.0 < radius).then_some(Piece { capsule: Capsule { radius, ..at_shoulder }, ..piece })
            }
            _ => None,
        };
        self.pieces(&[0.0; 6], pedestal).into_iter().filter_map(kept).collect()
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

    pub(super) fn pieces(&self, theta: &[f64; 6], pedestal: f64) -> Vec<Piece> {
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

    /// Looks whether the wrist folds the tool back into the forearm. They are joined, so that how near they are says nothing until they overlap.
    fn compare_folded(&self, pieces: &[Piece], nearest: &mut Nearest) {
        let Some((tool, share)) = pieces.iter().position(|piece| piece.number == TOOL).zip(self.free_from) else {
            return;
        };
        let Some(free) = shown(pieces, tool).and_then(|capsule| capsule.behind(share)) else { return };
        for other in pieces.iter().filter(|other| other.link == Link::Forearm) {
            let apart = free.apart_from(&other.capsule);
            if apart < -FOLDED {
                nearest.take(apart, Link::Tool, Obstacle::Link(Link::Forearm));
            }
        }
    }

    /// Looks at all that stands about the arm. It does not move, so that of a link that stands where it did before nothing new is to be said.
    fn compare(&self, pieces: &[Piece], before: &[Piece], about: (&Surroundings, usize), nearest: &mut Nearest) {
        for (i, piece) in pieces.iter().enumerate() {
            if nearest.is_enough() {
                return;
            }
            let is_apart = nearest.is_tool_apart && piece.link == Link::Tool;
            if !is_apart && before.get(i) != Some(piece) {
                self.compare_one(pieces, i, about, nearest);
            }
        }
    }

    fn compare_one(&self, pieces: &[Piece], i: usize, (about, sample): (&Surroundings, usize), nearest: &mut Nearest) {
        let Piece { link, capsule, .. } = pieces[i];
        let is_last = pieces.last().is_some_and(|last| last.link == link);
        // In the arm plane the work lies where the links move.
        let may_touch = if self.ends_at_wrist { link == Link::Column } else { !is_last };
        if let Some(work) = about.work.filter(|_| may_touch) {
            nearest.solid((link, &capsule), Obstacle::Work, &work);
        }
        if let Some(machined) = &about.machined {
            if !is_last {
                nearest.machined(link, (&capsule, Ends::Round), machined, sample);
            } else if let Some(cutter) = machined.cutter.filter(|_| link == Link::Tool) {
                nearest.tool(&capsule, &cutter, machined, sample);
            }
        }
        let Some(capsule) = shown(pieces, i) else { return };
        if let Some([through, up]) = about.floor.filter(|_| link != Link::Column) {
            nearest.take(capsule.above(&through, &up), link, Obstacle::Floor);
        }
        if let Some([through, up]) = about.mounting.filter(|_| link != Link::Column) {
            nearest.take(capsule.above(&through, &up), link, Obstacle::Mounting);
        }
        for (number, solid) in (1..).zip(&about.keep_out).filter(|(_, solid)| !pieces[i].is_carried_by(solid)) {
            nearest.solid((link, &capsule), Obstacle::KeepOut(number), solid);
        }
    }
}

/// From which share of it on a tool can only meet the forearm where the wrist folds back: every point of the tool keeps its distance from the wrist
/// centre, and from there on that is more than forearm and tool are thick in front of it. `None` where no part of it is.
fn free_from(geometry: &Geometry, body: &Body, enclosing: Option<&Enclosing>, tool: Tool) -> Option<f64> {
    let [_, _, _, wrist, _] = geometry.points(&[0.0; 6]).map(Vector3::from);
    let ahead = |capsule: &Capsule| capsule.ends.iter().map(|end| end.z).fold(f64::MIN, f64::max) + capsule.radius;
    let in_front = enclosing.map_or(body.forearm, |enclosing| {
        enclosing.links[3..5].iter().flatten().map(|capsule| ahead(capsule) - wrist.z).fold(0.0, f64::max)
    });
    // |t p + c4 z| = r, and t in parts of what is compared.
    let (along, r) = (tool.point, in_front + tool.radius);
    let (a, b) = (along.norm_squared(), along.z * geometry.c4);
    let root = b * b - a * (geometry.c4 * geometry.c4 - r * r);
    let from = if root <= 0.0 { 0.0 } else { ((root.sqrt() - b) / a).max(0.0) };
    let length = along.norm();
    let from = from * length / (length - tool.radius);
    (0.0..1.0).contains(&from).then_some(from)
}

/// What of a piece is compared: the last one is there to touch the work, and the round end of its capsule would reach beyond. `None` where nothing
/// is left of it.
fn shown(pieces: &[Piece], i: usize) -> Option<Capsule> {
    let Piece { link, capsule, .. } = pieces[i];
    let is_last = i + 1 == pieces.len() && link != Link::Wrist;
    if is_last { capsule.cut_back(capsule.radius) } else { Some(capsule) }
}
