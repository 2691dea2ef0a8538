//! Where must the work stand, as a shop drawing has it: heights, distances from the joint-1 axis, sideways?

mod base;
mod dimensions;

use std::f64::consts::TAU;

pub use base::Base;
pub use dimensions::Dimension;
use dimensions::{from_an_origin, of_a_zone};

use super::words::degrees;
use super::{Line, MillAnswer, PlaceAnswer, line};
use nalgebra::{Point3, Rotation3, Vector3};
use stiffarm::cell::{Block, Cell};
use stiffarm::interval::Interval;
use stiffarm::mill::Station;
use stiffarm::place::{FacePlacement, Placement, Within};
use stiffarm::robot::Arm;
use stiffarm::spatial::Pose;
use stiffarm::task::{Work, Zone};
use stiffarm::work::{WorkPlacement, WorkPlane};

/// Room in a window that rounding leaves, m.
const NO_ROOM: f64 = 1e-7;
/// Points of a cut that are drawn at most.
const MOST_POINTS: usize = 400;
/// Corners of a circle.
const CORNERS: usize = 72;

/// A zone, a part or a path at its place, in metres: ahead, to the left, up; along the axes of the base, or of the cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Whose work it is, and which.
    pub title: String,
    /// Where the robot stands.
    pub base: Base,
    /// The rim of the zone or of every face, closed lines whose first point is not repeated; or the cuts of a path.
    pub lines: Vec<Vec<[f64; 3]>>,
    /// The lines are closed.
    pub is_closed: bool,
    /// The centre of a zone, the middle of a part's underside, the origin of a path.
    pub centre: [f64; 3],
    /// Where the x axis of a path or part points, or the first side of a zone that is met from above: about the vertical, from the x axis of the
    /// origin, rad. `None` of a zone that stands.
    pub yaw: Option<f64>,
    /// What must be kept free: from where to where ahead, to the left, up; open sides without an end.
    pub keep_out: Vec<[[f64; 2]; 3]>,
    /// What is measured.
    pub dimensions: Vec<Dimension>,
    /// How it is turned about the vertical, or about the joint-1 axis.
    pub turned: Option<Line>,
}

impl PlaceAnswer {
    /// Where the zone or the part stands; `None` where it has no place, or nothing is known of the base.
    pub fn layout(&self) -> Option<Layout> {
        let best = self.best().filter(|_| self.robot.knows_base())?;
        let cell = self.options.cell;
        let cell_from_base = cell.map_or_else(Pose::identity, |cell| cell.mount.cell_from_base);
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), best.space().map_or(0.0, |hold| hold.bearing));
        let placed = |at: Vector3<f64>| {
            let at = Point3::from(turn * at);
            <[f64; 3]>::from(cell_from_base * at)
        };
        let rims = match &self.task.work {
            Work::Zone(zone) => vec![self.rim(*zone, best)],
            Work::Part(_) => best.faces.iter().map(rim_of).collect(),
        };
        let is_part = self.task.work.part().is_some();
        let lines: Vec<Vec<[f64; 3]>> = rims.into_iter().map(|rim| rim.into_iter().map(placed).collect()).collect();
        let [x, z] = best.centre;
        let centre = placed(Vector3::new(x, self.aside(best), z));
        let [from, to] = match &self.task.work {
            Work::Part(_) => [Vector3::zeros(), Vector3::new(best.angle.cos(), best.angle.sin(), 0.0)].map(placed),
            Work::Zone(zone) if zone.is_round() => [centre, lines[0][0]],
            Work::Zone(_) => [lines[0][0], lines[0][1]],
        };
        let yaw = (is_part || self.is_met_from_above(best)).then(|| (to[1] - from[1]).atan2(to[0] - from[0]));
        let bearing = best.space().map(|hold| hold.bearing).filter(|&bearing| bearing != 0.0);
        let mut layout = Layout {
            title: format!("{}: {} ({})", self.robot.full_name(), self.task.label, self.task.work.describe()),
            base: Base::of(cell.as_ref()),
            lines,
            is_closed: true,
            centre,
            yaw,
            keep_out: kept_free(cell.as_ref()),
            dimensions: Vec::new(),
            turned: match (&self.task.work, yaw) {
                (Work::Part(_), Some(yaw)) => Some(turned("the part's x axis", cell.is_some(), yaw)),
                (Work::Zone(zone), Some(yaw)) if !zone.is_round() => {
                    Some(turned("its first side", cell.is_some(), yaw))
                }
                _ => bearing.map(|bearing| line("joint 1 turned from straight ahead", degrees(bearing))),
            },
        };
        layout.dimensions = if is_part {
            from_an_origin(&layout, "the middle of its underside", "the machined faces")
        } else {
            of_a_zone(&layout)
        };
        Some(layout)
    }

    /// Where a path stands that has its origin in the middle of the work, of a part of its underside, and its x axis along the first side: m, and
    /// its turn about the vertical, rad, as `mill --at` takes them. `None` of a zone that is not met from above, and where nothing is known of the
    /// base.
    pub fn stand_of_path(&self) -> Option<[f64; 4]> {
        let Layout { centre: [x, y, z], yaw, .. } = self.layout()?;
        Some([x, y, z, yaw?])
    }

    /// The tool points down in the cell.
    fn is_met_from_above(&self, best: &Placement) -> bool {
        /// The cosine of a lean that is none.
        const DOWN: f64 = -1.0 + 1e-9;
        let Some(hold) = best.space() else { return false };
        let plane = WorkPlane::of(self.options.tool_orientation().elevation, &hold.work(best));
        let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), hold.bearing) * plane.tool().column(2);
        self.options.cell.map_or(turned, |cell| cell.mount.cell_from_base.rotation * turned).z < DOWN
    }

    /// The zone may stand in one place only: its window is no larger than itself.
    pub fn is_at_one_place(&self) -> bool {
        let window = self.options.within;
        let fits = |zone: Zone, best: &Placement, within: Within| {
            let rim = self.rim(zone, best);
            let room = |window: Interval, axis: usize| window.width() - extent(&rim, axis);
            room(within.x, 0) < NO_ROOM && room(within.z, 2) < NO_ROOM
        };
        let placed = self.task.work.zone().zip(self.best());
        placed.zip(window).is_some_and(|((zone, best), within)| fits(zone, best, within))
    }

    /// At which place it stands, in words.
    pub fn where_it_stands(&self) -> &'static str {
        if self.is_at_one_place() { "at the place asked for" } else { "at its best place" }
    }

    /// How far beside the joint-1 axis the zone's centre stands before it is turned, m: the arm plane's own offset.
    fn aside(&self, best: &Placement) -> f64 {
        match (&self.robot.arm, best.space()) {
            (Arm::SixAxis { geometry, .. }, None) => geometry.b,
            _ => 0.0,
        }
    }

    /// The rim of the zone straight ahead, from the base.
    fn rim(&self, zone: Zone, best: &Placement) -> Vec<Vector3<f64>> {
        let corners = corners(zone);
        let [x, z] = best.centre;
        match best.space() {
            None => {
                let (s, c) = best.angle.sin_cos();
                let y = self.aside(best);
                corners.iter().map(|[u, v]| Vector3::new(x + c * u - s * v, y, z + s * u + c * v)).collect()
            }
            Some(hold) => {
                let work = WorkPlacement { x, y: 0.0, z, yaw: hold.yaw, angle: best.angle, roll: hold.roll };
                let plane = WorkPlane::of(self.options.tool_orientation().elevation, &work);
                corners.iter().map(|&at| plane.point(&work, at)).collect()
            }
        }
    }
}

/// The corners of a zone, along its sides, m; a circle has many.
fn corners(zone: Zone) -> Vec<[f64; 2]> {
    match zone {
        Zone::Rectangle { .. } => [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|at| zone.at(at)).into(),
        Zone::Circle { diameter } => (0..CORNERS)
            .map(|i| TAU * i as f64 / CORNERS as f64)
            .map(|turn| [turn.cos(), turn.sin()].map(|part| part * diameter / 2.0))
            .collect(),
    }
}

/// The rim of a face of a part, from the base.
fn rim_of(placed: &FacePlacement) -> Vec<Vector3<f64>> {
    let [x, y, z] = placed.centre;
    let work = WorkPlacement { x, y, z, yaw: placed.hold.yaw, angle: 0.0, roll: placed.hold.roll };
    let plane = WorkPlane::of(placed.face.elevation, &work);
    corners(placed.face.zone).into_iter().map(|at| plane.point(&work, at)).collect()
}

impl MillAnswer {
    /// Where the path stands, followed there or not; `None` where it has no place, or nothing is known of the base.
    pub fn layout(&self) -> Option<Layout> {
        let placement = self.placement.filter(|_| self.robot.knows_base())?;
        let cell = self.ground.cell;
        let cell_from_base = cell.map_or_else(Pose::identity, |cell| cell.mount.cell_from_base);
        let pose = cell_from_base * placement.base_from_part();
        let is_apart =
            |one: &Station, next: &Station| !next.sample.is_cutting || !one.sample.is_cutting || next.is_fresh;
        let cut = |cut: &[Station]| -> Vec<[f64; 3]> {
            let tip = |station: &Station| (pose * Point3::from(station.sample.pose.tip)).coords.into();
            // The last one closes what is closed.
            let stride = cut.len().div_ceil(MOST_POINTS).max(1);
            cut.iter().step_by(stride).chain(cut.last().filter(|_| 1 < stride)).map(tip).collect()
        };
        let cuts = self.stations.chunk_by(|one, next| !is_apart(one, next));
        let cuts = cuts.filter(|cut| cut[0].sample.is_cutting);
        let mut layout = Layout {
            title: format!("{}: {}", self.robot.full_name(), self.path),
            base: Base::of(cell.as_ref()),
            lines: cuts.map(cut).collect(),
            centre: placement.at,
            is_closed: false,
            yaw: Some(placement.yaw),
            keep_out: kept_free(cell.as_ref()),
            dimensions: Vec::new(),
            turned: Some(turned("the path's x axis", cell.is_some(), placement.yaw)),
        };
        layout.dimensions = from_an_origin(&layout, "the path's origin", "the path");
        Some(layout)
    }
}

impl Layout {
    /// From where to where the zone goes along an axis, m.
    pub fn extent(&self, axis: usize) -> [f64; 2] {
        let along = || self.lines.iter().flatten().map(|point| point[axis]);
        [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// For people: what is measured, line by line.
    pub fn measured(&self) -> Vec<Line> {
        let mut lines: Vec<Line> =
            self.dimensions.iter().map(|one| line(&one.name, format!("{} mm", one.text))).collect();
        lines.extend(self.turned.clone());
        lines
    }
}

/// How something is turned about the vertical.
fn turned(what: &str, is_in_cell: bool, yaw: f64) -> Line {
    let from = if is_in_cell { "the cell's x axis" } else { "straight ahead" };
    line(format!("{what} from {from}, counterclockwise from above"), degrees(yaw))
}

/// The boxes that must be kept free in a cell.
fn kept_free(cell: Option<&Cell>) -> Vec<[[f64; 2]; 3]> {
    let ends = |block: Block| [block.x, block.y, block.z].map(|side| [side.min(), side.max()]);
    cell.into_iter().flat_map(Cell::keep_out).map(ends).collect()
}

/// How far points reach along an axis, m.
fn extent(points: &[Vector3<f64>], axis: usize) -> f64 {
    let along = || points.iter().map(|point| point[axis]);
    along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::super::words::fixed;
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::request::{Pair, Request, Spelling, Verb};
    use stiffarm::catalogue::paper_robots;
    use stiffarm::cell::Mount;
    use stiffarm::load::Load;
    use stiffarm::model::ModelKind;
    use stiffarm::part::Part;
    use stiffarm::place::{PlaceOptions, ToolOrientation, place};
    use stiffarm::spatial::Pose;
    use stiffarm::task::Task;
    use stiffarm::toolpath::Builtin;
    use stiffarm::watch::Watch;

    fn placed(task: &str, kind: ModelKind) -> PlaceAnswer {
        let robot = paper_robots().swap_remove(4);
        let (model, task) = (kind.of(&robot).unwrap(), task.parse::<Task>().unwrap());
        let options = PlaceOptions::under(Load::PAPER);
        let placed = place(&model, &task.work, &options, Watch::nobody()).unwrap();
        PlaceAnswer { robot, model: kind, task, options, placed, tolerance_mm: None, advice: None }
    }

    #[test]
    fn a_zone_of_the_arm_plane_is_as_long_and_as_high_as_it_is() {
        let answer = placed("rect:0.4x0.6", ModelKind::Planar);
        let (best, layout) = (answer.best().unwrap(), answer.layout().unwrap());
        let [across, aside, up] = [0, 1, 2].map(|axis| layout.extent(axis));
        // Its first side lies level, its second one stands.
        assert!(
            (across[0] - (best.centre[0] - 0.2)).abs() < 1e-12 && (across[1] - (best.centre[0] + 0.2)).abs() < 1e-12
        );
        assert!((up[0] - (best.centre[1] - 0.3)).abs() < 1e-12 && (up[1] - up[0] - 0.6).abs() < 1e-12);
        assert_eq!(aside[0], aside[1]);
        assert_eq!(layout.measured()[1], ["from there to its highest edge".to_owned(), "600.0 mm".into()]);
    }

    #[test]
    fn a_window_as_large_as_the_zone_leaves_it_one_place() {
        for kind in [ModelKind::Planar, ModelKind::Spatial(Pose::translation(0.0, 0.0, 0.2))] {
            let mut answer = placed("circle:0.3", kind);
            assert!(!answer.is_at_one_place());
            let [x, z] = answer.best().unwrap().centre;
            let up = if kind == ModelKind::Planar { 0.15 } else { 0.0 };
            let (ahead, z) = (Interval::spanning(x - 0.15, x + 0.15), Interval::spanning(z - up, z + up));
            answer.options.within = Some(Within { x: ahead, z });
            assert!(answer.is_at_one_place());
            answer.options.within = Some(Within { x: Interval::spanning(x - 0.15, x + 0.151), z });
            assert!(!answer.is_at_one_place());
        }
    }

    #[test]
    fn a_level_zone_has_the_height_of_its_face_and_its_sides() {
        let answer = placed("rect:0.3x0.2", ModelKind::Spatial(Pose::translation(0.0, 0.0, 0.2)));
        let (best, layout) = (answer.best().unwrap(), answer.layout().unwrap());
        let measured = layout.measured();
        assert!(measured[0][0].starts_with("height of the worked face"), "{measured:?}");
        assert_eq!(measured[0][1], format!("{} mm", fixed(best.centre[1] * 1e3, 1)));
        let sides: Vec<f64> = [0, 1].map(|axis| layout.extent(axis)).iter().map(|[low, high]| high - low).collect();
        // The area of a rectangle that is turned by a quarter or not at all.
        assert!((sides[0] * sides[1] - 0.06).abs() < 1e-9, "{sides:?}");
        let nearest = best.from_axis_1.unwrap();
        let [near, _] = layout.extent(0);
        assert!((nearest - near).abs() < 1e-9, "straight ahead, the near edge is the nearest: {nearest} {near}");
    }

    /// The corners of a path over the zone, from its origin and turned as the answer says, are those of the zone.
    #[test]
    fn a_path_stands_where_its_zone_was_placed() {
        let spindle = ModelKind::Spatial(Pose::translation(0.0, 0.0, 0.2));
        let mut answer = placed("rect:0.3x0.2", spindle);
        for mount in [Mount::pedestal(0.0), Mount::pedestal(0.5).turned(0.7)] {
            answer.options.cell = Some(Cell::of(mount));
            let [x, y, z, yaw] = answer.stand_of_path().unwrap();
            let (s, c) = yaw.sin_cos();
            let rim = answer.layout().unwrap().lines.swap_remove(0);
            for (u, v) in [(-0.15, -0.1), (-0.15, 0.1), (0.15, -0.1), (0.15, 0.1)] {
                let corner = [x + c * u - s * v, y + s * u + c * v, z];
                let is_it = |found: &[f64; 3]| (0..3).all(|i| (found[i] - corner[i]).abs() < 1e-9);
                assert!(rim.iter().any(is_it), "{corner:?} of {rim:?}");
            }
        }
        assert!(placed("circle:0.2", spindle).stand_of_path().is_some());
        // A zone of the arm plane lies nowhere flat, and one that is met from below is no ground for a path.
        assert_eq!(placed("rect:0.4x0.6", ModelKind::Planar).stand_of_path(), None);
        answer.options.tool_orientation = Some(ToolOrientation::tool_at(FRAC_PI_2));
        assert_eq!(answer.stand_of_path(), None);
    }

    /// A box of 0.4 x 0.3 x 0.1 m, of which top and front are machined, turned by whatever is best: its corners by hand.
    #[test]
    fn a_part_stands_with_the_rims_of_its_faces() {
        let kind = ModelKind::Spatial(Pose::translation(0.0, 0.0, 0.2));
        let robot = paper_robots().swap_remove(4);
        let part = Part::of_box([0.4, 0.3, 0.1]).with_faces(&["top".into(), "front".into()]).unwrap();
        let (model, task) = (kind.of(&robot).unwrap(), Task::from(part));
        let options = PlaceOptions::under(Load::PAPER);
        let placed = place(&model, &task.work, &options, Watch::nobody()).unwrap();
        let answer = PlaceAnswer { robot, model: kind, task, options, placed, tolerance_mm: None, advice: None };
        let (best, layout) = (answer.best().unwrap(), answer.layout().unwrap());
        let ([x, z], (s, c)) = (best.centre, best.angle.sin_cos());
        let at = |[u, v, w]: [f64; 3]| [x + c * u - s * v, s * u + c * v, z + w];
        let has = |rim: &[[f64; 3]], corner: [f64; 3]| {
            rim.iter().any(|found| (0..3).all(|i| (found[i] - at(corner)[i]).abs() < 1e-12))
        };
        let [top, front] = layout.lines.as_slice() else { panic!("two faces: {:?}", layout.lines) };
        for (u, v) in [(-0.2, -0.15), (-0.2, 0.15), (0.2, -0.15), (0.2, 0.15)] {
            assert!(has(top, [u, v, 0.1]), "{u} {v}: {top:?}");
        }
        for (v, w) in [(-0.15, 0.0), (-0.15, 0.1), (0.15, 0.0), (0.15, 0.1)] {
            assert!(has(front, [-0.2, v, w]), "{v} {w}: {front:?}");
        }
        assert!(
            layout.is_closed && layout.yaw.is_some_and(|yaw| (yaw.cos() - c).abs() + (yaw.sin() - s).abs() < 1e-12)
        );
        let measured = layout.measured();
        assert_eq!(measured[0][0], "height of the middle of its underside above the base");
        assert_eq!([0, 1, 2].map(|i| measured[i][1].clone()), [z, x, 0.0].map(|m| format!("{} mm", fixed(m * 1e3, 1))));
        assert_eq!(measured[5], ["extent of the machined faces upwards".to_owned(), "100.0 mm".into()]);
        let turn = layout.yaw.unwrap();
        assert_eq!(measured.last().unwrap()[1], degrees(turn));
    }

    /// On a wall the joint-1 axis is level: lengths count from the foot; where a base is posed, from where it is and not from the cell's origin.
    #[test]
    fn lengths_count_from_the_joint_1_axis_where_it_is_upright_and_from_the_foot_elsewhere() {
        let of = |mount: &str| {
            let options =
                [("path", "line:0.1"), ("robot", "it"), ("force-n", "100"), ("at", "1.6,0.9,0.7,0"), ("mount", mount)];
            let pair = |(name, text): (&str, &str)| Pair { name: name.into(), text: text.into(), at: Spelling::Typed };
            let asked = Request::read(Verb::Mill, &options.map(pair), Spelling::Typed).unwrap();
            let (moves, robot) = ("line:0.1".parse::<Builtin>().unwrap().moves(None), paper_robots().swap_remove(4));
            let answer = MillAnswer::of(&asked, &robot, ("line:0.1".into(), &moves), None, Watch::nobody()).unwrap();
            answer.layout().unwrap()
        };
        for (mount, fixed_to, from, lengths) in [
            ("pose:0.2,0.1,0.6,0,0,0", None, "joint-1 axis", ["700.0 mm", "1400.0 mm", "800.0 mm"]),
            ("pedestal:0.4", None, "joint-1 axis", ["700.0 mm", "1600.0 mm", "900.0 mm"]),
            ("ceiling:3", Some("ceiling"), "joint-1 axis", ["700.0 mm", "1600.0 mm", "900.0 mm"]),
            ("wall:1.6", Some("wall"), "middle of the foot", ["700.0 mm", "1600.0 mm", "900.0 mm"]),
            (
                "pose:0.2,0.1,0.6,0,20,0",
                Some("base as posed"),
                "middle of the foot",
                ["700.0 mm", "1400.0 mm", "800.0 mm"],
            ),
        ] {
            let layout = of(mount);
            let measured = layout.measured();
            assert_eq!(
                (layout.base.fixed_to, [0, 1, 2].map(|i| measured[i][1].as_str())),
                (fixed_to, lengths),
                "{mount}"
            );
            assert_eq!(measured[1][0], format!("{from} to the path's origin, ahead"), "{mount}");
            assert_eq!(measured[2][0], format!("the path's origin to the left of the {from}"), "{mount}");
            assert_eq!(
                layout.base.origin(),
                format!("the {from} and the floor, along the axes of the cell"),
                "{mount}"
            );
        }
        let axis = of("wall:1.6").base.axis;
        assert!((axis[0] - 1.0).abs() < 1e-12, "out of the wall: {axis:?}");
    }

    /// A line of 0.4 m along the part's x axis about its origin, turned by 30 deg: by hand.
    #[test]
    fn a_path_stands_where_its_origin_and_its_yaw_put_it() {
        let options = [("path", "line:0.4"), ("robot", "it"), ("force-n", "400"), ("at", "1.7,0.3,0.8,30")];
        let pair = |(name, text): (&str, &str)| Pair { name: name.into(), text: text.into(), at: Spelling::Typed };
        let asked = Request::read(Verb::Mill, &options.map(pair), Spelling::Typed).unwrap();
        let moves = "line:0.4".parse::<Builtin>().unwrap().moves(None);
        let robot = paper_robots().swap_remove(4);
        let answer = MillAnswer::of(&asked, &robot, ("line:0.4".into(), &moves), None, Watch::nobody()).unwrap();
        let layout = answer.layout().unwrap();
        let (s, c) = 30_f64.to_radians().sin_cos();
        let near = |found: [f64; 3], expected: [f64; 3]| (0..3).all(|i| (found[i] - expected[i]).abs() < 1e-12);
        assert!((layout.yaw.unwrap() - 30_f64.to_radians()).abs() < 1e-12);
        let [line] = layout.lines.as_slice() else { panic!("one cut: {:?}", layout.lines) };
        let [from, to] = [line[0], line[line.len() - 1]];
        let along: Vec<f64> = (0..3).map(|i| to[i] - from[i]).collect();
        assert!(near([along[0], along[1], along[2]], [0.4 * c, 0.4 * s, 0.0]), "{from:?} {to:?}");
        assert!(line.len() <= MOST_POINTS + 1);
        let measured = layout.measured();
        let length = |i: usize| measured[i][1].as_str();
        assert_eq!([0, 1, 2].map(length), ["800.0 mm", "1700.0 mm", "300.0 mm"]);
        assert_eq!([3, 4].map(length), ["346.4 mm", "200.0 mm"], "0.4 m times cosine and sine");
        assert_eq!(measured[5][1], "30.0 deg");
    }
}
