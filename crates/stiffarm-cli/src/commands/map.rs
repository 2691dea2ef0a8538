//! `stiffarm map`: the deflection over everything a robot reaches.

use std::io::{self, Write};
use std::path::Path;

use stiffarm::interval::Interval;
use stiffarm::map::{Component, Direction, Map, MapError, MapOptions, Spacing, map, reached_box, stiffest_posture};
use stiffarm::place::{PlaceOptions, Placement, Within, find_robot};
use stiffarm::plane::PlanarArm;
use stiffarm::report;
use stiffarm::request::Request;
use stiffarm::robot::{Arm, ArmPlane, Robot};
use stiffarm::task::Task;

use super::{spatial, waiting};
use crate::args::Common;
use crate::failure::Failure;
use crate::figures::map::MapFigure;
use crate::figures::scene::{Scene, ZoneMark, links, rim};
use crate::figures::view3d::{ArmMark, Cell, Sheet, View, Zone};
use crate::output::{Answer, Outputs, figure, pretty, say};
use crate::selection;
use crate::table::{Table, full};

/// Points along the longer side of a map that is only drawn.
const FIGURE_SIZE: usize = 400;

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let name = asked.robot()?;
    let robot = selection::robot(&name, common)?;
    if asked.is_spatial() {
        return spatial::map::run(robot, asked, common);
    }
    let outputs = Outputs::open::<MapAnswer>(common, &[Path::new(&name)])?;
    let failure = |error| Failure::Map { robot: robot.name.clone(), error };
    let plane = arm_plane(&robot).map_err(failure)?;
    let [x, z] = asked.spacing().cover(reached_box(&plane.arm).map_err(failure)?);
    let options = MapOptions { x, z, force: asked.force(), direction: asked.direction(), elbow: asked.elbow() };
    let map = waiting("mapping", common, || map(&plane.arm, &options)).map_err(failure)?;
    let zone = match asked.zone() {
        None => None,
        Some(task) => {
            let placing = asked.wanted().planar(task.zone);
            let found = waiting("searching places", common, || find_robot(&robot, task.zone, &placing))
                .map_err(|error| Failure::Place { robot: robot.name.clone(), error })?;
            if found.is_none() && !common.quiet {
                say(&format!("note: {} has no place for {}; `stiffarm place` says why", robot.name, task.label));
            }
            found.map(|placement| (task, placement))
        }
    };
    let within = asked.wanted().within.unwrap_or(Within::ANYWHERE);
    outputs.deliver(&MapAnswer { within, robot, plane, options, map, zone })
}

fn arm_plane(robot: &Robot) -> Result<ArmPlane, MapError> {
    robot.arm_plane().map_err(|error| MapError::Arm(error.into()))
}

/// The figures of `place`: the robot's map with the zone in it.
pub(crate) fn placement_map(
    robot: &Robot,
    task: &Task,
    options: &PlaceOptions,
    placement: Option<&Placement>,
) -> Result<MapAnswer, Failure> {
    let failure = |error| Failure::Map { robot: robot.name.clone(), error };
    let plane = arm_plane(robot).map_err(failure)?;
    let [x, z] = Spacing::Points(FIGURE_SIZE).cover(reached_box(&plane.arm).map_err(failure)?);
    let within = options.within;
    let options = MapOptions { x, z, force: options.force, direction: Direction::Worst, elbow: None };
    let map = map(&plane.arm, &options).map_err(failure)?;
    let zone = placement.map(|placement| (task.clone(), placement.clone()));
    Ok(MapAnswer { within, robot: robot.clone(), plane, options, map, zone })
}

pub(crate) struct MapAnswer {
    within: Within,
    robot: Robot,
    plane: ArmPlane,
    options: MapOptions,
    map: Map,
    zone: Option<(Task, Placement)>,
}

impl MapAnswer {
    fn what(&self) -> String {
        let force = self.options.force;
        match self.options.direction {
            Direction::Worst => format!("worst deflection under {force} N"),
            Direction::Given(angle, component) => {
                let part = match component {
                    Component::Total => "deflection",
                    Component::Along => "deflection along the force",
                };
                format!("{part} under {force} N at {:.0} deg", angle.to_degrees())
            }
        }
    }

    /// Where the zone had to stand, where that was restricted.
    fn window(&self) -> String {
        let range = |range: Interval| {
            let end = |x: f64| if x.is_finite() { x.to_string() } else { String::new() };
            format!("{}..{}", end(range.min()), end(range.max()))
        };
        match (&self.zone, self.within) {
            (Some(_), within) if within != Within::ANYWHERE => {
                format!("; zone within x {} m, z {} m of the base", range(within.x), range(within.z))
            }
            _ => String::new(),
        }
    }

    /// Shoulder and elbow angle at the worst point of the zone, or at the stiffest point of the map.
    fn posture(&self) -> Option<(f64, f64)> {
        if let Some((_, placement)) = &self.zone {
            let [shoulder, elbow] = placement.worst_posture;
            return Some((shoulder, elbow));
        }
        stiffest_posture(&self.plane.arm, &self.map, self.options.elbow)
    }

    fn subtitle(&self) -> String {
        let Robot { architecture, status, .. } = &self.robot;
        format!("{architecture}, {status}; {}, planar model{}", self.what(), self.window())
    }

    fn mark(&self) -> Option<ZoneMark> {
        self.zone.as_ref().map(|(task, placement)| ZoneMark {
            zone: task.zone,
            rim: rim(task.zone, placement.centre, placement.angle),
            worst_point: placement.worst_point,
            label: format!("{}: {:.3} mm at worst", task.label, placement.deflection * 1e3),
        })
    }

    /// The map, the arm and the zone in their plane, which stands beside the joint-1 axis where the arm does.
    pub(crate) fn in_space(&self) -> View {
        let Self { robot, plane, map, .. } = self;
        let y = match &robot.arm {
            Arm::SixAxis { geometry, .. } => geometry.b,
            Arm::Planar(_) => 0.0,
        };
        let [axis_x, axis_z] = plane.axis_from_base;
        let at = |[x, z]: [f64; 2]| [x + axis_x, y, z + axis_z];
        let zone = self.zone.as_ref().zip(self.mark()).map(|((_, placement), mark)| Zone {
            rim: mark.rim.iter().copied().map(at).collect(),
            worst: Some(Cell { at: at(mark.worst_point), mm: Some(placement.deflection * 1e3) }),
            label: mark.label,
            sheet: None,
        });
        let origin = if self.floor() { "the base" } else { "the joint-2 axis" };
        View {
            title: robot.full_name(),
            notes: vec![self.subtitle(), format!("section in the arm plane, m from {origin}")],
            arm: self.posture().map(|(shoulder, elbow)| ArmMark::planar(plane, [shoulder, elbow], y)),
            zone,
            section: Some(Sheet::of_map(map, plane.axis_from_base, y)),
            arrows: Vec::new(),
            colour_label: format!("{} [mm]", self.what()),
            floor: self.floor(),
        }
    }

    /// Whether the base is known, and with it the floor.
    fn floor(&self) -> bool {
        matches!(self.robot.arm, Arm::SixAxis { .. })
    }

    pub(crate) fn figure(&self) -> Result<String, Failure> {
        let robot = &self.robot;
        let PlanarArm { l2, l3, .. } = self.plane.arm;
        let figure_of_map = MapFigure {
            title: robot.full_name(),
            subtitle: self.subtitle(),
            map: &self.map,
            factor: 1e3,
            ends: ["stiff", "soft"],
            edge: Some(&self.plane.arm),
            scene: Scene {
                axis: [0.0; 2],
                links: self.posture().map_or_else(Vec::new, |posture| links(&self.plane.arm, posture)),
                link: f64::midpoint(l2, l3),
                base: self.floor().then_some(self.plane.axis_from_base.map(|part| -part)),
                zone: self.mark(),
            },
            colour_label: format!("{} [mm]", self.what()),
            origin: "the joint-2 axis",
            face: None,
        };
        figure_of_map.svg().map_err(figure)
    }
}

impl Answer for MapAnswer {
    const COMMAND: &'static str = "map";
    const FURTHER: &'static [&'static str] = &["svg", "png", "html"];

    fn text(&self, markdown: bool) -> String {
        let Self { robot, map, options, .. } = self;
        let mut table = Table::new(["", ""]);
        table.row(["robot".into(), format!("{} ({}, {})", robot.full_name(), robot.architecture, robot.status)]);
        table.row(["mapped".into(), format!("{}, planar model", self.what())]);
        table.row(["points".into(), format!("{} x {}, every {:.4} m", map.x.count, map.z.count, map.x.step)]);
        match map.extremes() {
            None => table.row(["reached", "no point of the grid: choose a smaller step"]),
            Some([least, most]) => {
                for (name, (value, i, j)) in [("least", least), ("most", most)] {
                    let (x, z) = (map.x.at(i), map.z.at(j));
                    table.row([
                        name.into(),
                        format!("{:.4} mm at x {x:.3} m, z {z:.3} m from the joint-2 axis", value * 1e3),
                    ]);
                }
            }
        }
        // In one direction a posture may give way less than in its worst: down to nothing.
        if options.direction == Direction::Worst {
            let floor = self.plane.arm.radial().floor() * options.force * 1e3;
            table.row([
                "bound".into(),
                format!("{floor:.4} mm in the worst direction at the stiffest posture of the links"),
            ]);
        }
        if let Some((task, placement)) = &self.zone {
            let [x, z] = placement.centre;
            let deflection = placement.deflection * 1e3;
            table.row([
                format!("zone {}", task.label),
                format!("{deflection:.4} mm at worst, centre x {x:.3} m, z {z:.3} m"),
            ]);
        }
        table.text(markdown) + "\n-o map.svg, .png, .html, .csv, .parquet or .json writes the map\n"
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        let zone = self.zone.as_ref().map(|(task, placement)| (task, placement));
        pretty(out, &report::map::planar(&self.robot, &self.options, &self.map, zone))
    }

    fn csv(&self) -> Table<'_> {
        let map = &self.map;
        let row = |cell: usize| {
            let (i, j) = (cell % map.x.count, cell / map.x.count);
            [map.x.at(i).to_string(), map.z.at(j).to_string(), full(map.get(i, j).map(|metres| metres * 1e3))]
        };
        Table::made(["x_m", "z_m", "deflection_mm"], map.x.count * map.z.count, row)
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        Some(self.figure())
    }

    fn view(&self) -> Option<Result<View, Failure>> {
        Some(Ok(self.in_space()))
    }
}
