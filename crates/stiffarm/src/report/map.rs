//! How is a map told?

use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Value, json};

use super::spatial::tool_mm;
use crate::map::{Direction, Map, MapOptions, ROLL_TOLERANCE, Section, SectionOptions};
use crate::place::Placement;
use crate::robot::Robot;
use crate::task::Task;

/// A map: what is said once, and its layers of cells.
///
/// As JSON it is written cell by cell, so that a map of any size takes no memory besides its own.
#[derive(Clone, Debug)]
pub struct MapReport<'a> {
    /// Every key; null where a layer belongs.
    pub head: Value,
    /// The layers of numbers.
    pub layers: Vec<Layer<'a>>,
    /// What holds posture and roll of each cell, in space.
    section: Option<&'a Section>,
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
}

/// Keys of what is no number of a layer.
const POSTURE: &str = "posture";
const ROLL: &str = "roll_deg";

impl<'a> MapReport<'a> {
    /// Every key but those of the layers, with posture and roll of each cell.
    ///
    /// # Panics
    /// Never: texts and finite numbers are JSON.
    pub fn head_with_postures(&self) -> Value {
        let mut head = self.head.clone();
        for key in [POSTURE, ROLL] {
            if let Some(grid) = self.grid(key) {
                head[key] = serde_json::to_value(grid).expect("texts and numbers");
            }
        }
        head
    }

    /// What stands under a key that holds something for each cell.
    fn grid(&self, key: &str) -> Option<Grid<'a>> {
        let layer = self.layers.iter().find(|layer| layer.key == key).copied().map(Grid::Layer);
        let held = self.section.and_then(|section| match key {
            POSTURE => Some(Grid::Postures(section)),
            ROLL => Some(Grid::Rolls(section)),
            _ => None,
        });
        layer.or(held)
    }
}

impl Serialize for MapReport<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let head = self.head.as_object().into_iter().flatten();
        let mut object = serializer.serialize_map(Some(head.clone().count()))?;
        for (key, value) in head {
            match self.grid(key) {
                Some(grid) => object.serialize_entry(key, &grid)?,
                None => object.serialize_entry(key, value)?,
            }
        }
        object.end()
    }
}

/// Rows from the first z, each from the first x; null where nothing is reached.
#[derive(Clone, Copy)]
enum Grid<'a> {
    Layer(Layer<'a>),
    Postures(&'a Section),
    Rolls(&'a Section),
}

impl Serialize for Grid<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let rows = match self {
            Self::Layer(layer) => layer.map.z.count,
            Self::Postures(section) | Self::Rolls(section) => section.worst.z.count,
        };
        serializer.collect_seq((0..rows).map(|j| GridRow(*self, j)))
    }
}

struct GridRow<'a>(Grid<'a>, usize);

impl Serialize for GridRow<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(grid, j) = *self;
        match grid {
            Grid::Layer(layer) => serializer.collect_seq(layer.row(j)),
            Grid::Postures(section) => {
                serializer.collect_seq(section.row(j).map(|held| held.map(|(class, _)| class.to_string())))
            }
            Grid::Rolls(section) => {
                serializer.collect_seq(section.row(j).map(|held| held.map(|(_, roll)| roll.to_degrees())))
            }
        }
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
    MapReport { head, layers: vec![Layer { key, map, factor: 1e3 }], section: None }
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
    for key in layers.iter().map(|layer| layer.key).chain([POSTURE, ROLL]) {
        head[key] = Value::Null;
    }
    MapReport { head, layers, section: Some(section) }
}
