//! How is a map told?

use serde_json::{Value, json};

use super::spatial::tool_mm;
use crate::inverse::Class;
use crate::map::{Direction, Map, MapOptions, ROLL_TOLERANCE, Section, SectionOptions};
use crate::place::Placement;
use crate::robot::Robot;
use crate::task::Task;

/// A map: what is said once, and its layers of cells.
#[derive(Clone, Debug)]
pub struct MapReport<'a> {
    /// Every key; null where a layer belongs.
    pub head: Value,
    /// The layers.
    pub layers: Vec<Layer<'a>>,
}

/// One number per cell, in the unit of its key.
#[derive(Clone, Copy, Debug)]
pub struct Layer<'a> {
    /// Its key, with the unit.
    pub key: &'static str,
    map: &'a Map,
    factor: f64,
}

impl Layer<'_> {
    /// The cells, row by row from the first z; NaN where nothing is reached.
    pub fn cells(&self) -> Vec<f64> {
        (0..self.map.z.count).flat_map(|j| self.row(j)).map(|cell| cell.unwrap_or(f64::NAN)).collect()
    }

    fn row(&self, j: usize) -> impl Iterator<Item = Option<f64>> {
        self.map.row(j).map(|cell| cell.map(|value| value * self.factor))
    }

    fn json(&self) -> Value {
        (0..self.map.z.count).map(|j| self.row(j).map(|cell| json!(cell)).collect::<Value>()).collect()
    }
}

impl MapReport<'_> {
    /// All of it as JSON; null where nothing is reached.
    pub fn json(self) -> Value {
        let mut object = self.head;
        for layer in &self.layers {
            object[layer.key] = layer.json();
        }
        object
    }
}

/// A map of the arm plane, from the joint-2 axis, with the best place of a zone where one is asked for.
pub fn planar<'a>(
    robot: &Robot,
    options: &MapOptions,
    map: &'a Map,
    zone: Option<(&Task, &Placement)>,
) -> MapReport<'a> {
    let mut head = json!({
        "robot": robot.name,
        "model": "planar",
        "force_n": options.force,
        "x_m": map.x.points(),
        "z_m": map.z.points(),
    });
    let key = match options.direction {
        Direction::Worst => "worst_mm",
        Direction::Given(angle, _) => {
            head["direction_deg"] = json!(angle.to_degrees());
            "deflection_mm"
        }
    };
    head[key] = Value::Null;
    if let Some((task, placement)) = zone {
        head["zone"] = json!({
            "task": task.label,
            "deflection_mm": placement.deflection * 1e3,
            "lower_bound_mm": placement.lower_bound * 1e3,
            "x_m": placement.centre[0],
            "z_m": placement.centre[1],
            "angle_deg": placement.angle.to_degrees(),
            "elbow": placement.elbow.name(),
            "worst_point_m": placement.worst_point,
        });
    }
    MapReport { head, layers: vec![Layer { key, map, factor: 1e3 }] }
}

/// A section through everything the tool reaches, from the base.
pub fn spatial<'a>(robot: &Robot, options: &SectionOptions, section: &'a Section) -> MapReport<'a> {
    let degrees = 1_f64.to_degrees();
    let layers = vec![
        Layer { key: "worst_mm", map: &section.worst, factor: 1e3 },
        Layer { key: "limit_margin_deg", map: &section.limit_margin, factor: degrees },
        Layer { key: "singular_margin_deg", map: &section.singular_margin, factor: degrees },
    ];
    let mut head = json!({
        "robot": robot.name,
        "model": "spatial",
        "force_n": options.force,
        "tool_mm": tool_mm(&options.flange_from_tool),
        "tool_direction_deg": options.elevation.to_degrees(),
        "roll_tolerance": options.roll.is_none().then_some(ROLL_TOLERANCE),
        "x_m": section.worst.x.points(),
        "z_m": section.worst.z.points(),
    });
    for layer in &layers {
        head[layer.key] = Value::Null;
    }
    let held = |part: &dyn Fn((Class, f64)) -> Value| -> Value {
        let cell = |i, j| section.posture(i, j).map_or(Value::Null, part);
        (0..section.worst.z.count).map(|j| (0..section.worst.x.count).map(|i| cell(i, j)).collect::<Value>()).collect()
    };
    head["posture"] = held(&|(class, _)| json!(class.to_string()));
    head["roll_deg"] = held(&|(_, roll)| json!(roll.to_degrees()));
    MapReport { head, layers }
}
