//! How is a map reported?

use std::fmt::Write as _;

use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Value, json};

use super::modes::{left_out_note, tool_note};
use super::place::PlaceAnswer;
use super::stiffness::{self, stiffness};
use super::words::{self, tool_mm};
use super::{Cell, Line, Record, Rows, Table, Unit, columns_of, field, force, line, schema, shape, with_schema};
use stiffarm::load::Direction;
use stiffarm::map::{Grid, HeldPosture, Map, MapOptions, Margins, ROLL_TOLERANCE};
use stiffarm::mass::RigidBody;
use stiffarm::model::{ArmPosture, Model, ModelKind};
use stiffarm::modes::{FirstFrequencies, HeldTool};
use stiffarm::plane::Elbow;

/// The answer of `map`, with what was asked.
///
/// As JSON and in a spreadsheet it is written cell by cell, so that a map of any size takes no memory besides its own.
#[derive(Clone, Debug)]
pub struct MapAnswer {
    /// What was mapped.
    pub model: Model,
    /// What was asked.
    pub options: MapOptions,
    /// What was found.
    pub map: Map,
    /// The best place of a zone, where one was asked for.
    pub zone: Option<PlaceAnswer>,
    /// How slow the arm swings first, Hz, and with what it holds, where that was asked for.
    pub frequency: Option<(FirstFrequencies, HeldTool)>,
}

/// One number per cell.
#[derive(Clone, Copy, Debug)]
pub struct Layer<'a> {
    /// What it is.
    pub field: field::Field,
    grid: &'a Grid,
}

impl Layer<'_> {
    /// The cells, row by row from the first z, in the unit of the field; NaN where nothing is reached.
    pub fn cells(&self) -> Vec<f64> {
        (0..self.grid.z.count).flat_map(|j| self.row(j)).map(|cell| cell.unwrap_or(f64::NAN)).collect()
    }

    fn row(&self, j: usize) -> impl Iterator<Item = Option<f64>> {
        let unit = self.field.unit().unwrap_or(Unit::One);
        self.grid.row(j).map(move |cell| cell.map(|value| unit.of_si(value)))
    }

    fn at(&self, i: usize, j: usize) -> Cell {
        let unit = self.field.unit().unwrap_or(Unit::One);
        self.grid.get(i, j).map_or(Cell::Absent, |value| Cell::Number(unit.of_si(value)))
    }
}

impl MapAnswer {
    /// The layers of numbers, the deflection first.
    pub fn layers(&self) -> Vec<Layer<'_>> {
        let key = if self.options.load.is_worst() { field::WORST } else { field::DIRECTED };
        let mut layers = vec![Layer { field: key, grid: &self.map.deflection }];
        if let Some(margins) = &self.map.space {
            layers.push(Layer { field: field::LIMIT_MARGIN, grid: &margins.limits });
            layers.push(Layer { field: field::SINGULAR_MARGIN, grid: &margins.singular });
        }
        layers.extend(
            self.frequency.iter().map(|(found, _)| Layer { field: field::FIRST_FREQUENCY, grid: &found.hertz }),
        );
        layers
    }

    fn schema(&self) -> Value {
        schema("map", words::origin(self.model.robot()))
    }

    fn held(&self) -> HeldPosture {
        self.options.held()
    }

    /// The arm that a figure shows: at the worst point of the zone, or at the stiffest point where none has its place.
    pub fn posture(&self) -> Option<ArmPosture> {
        match self.zone.as_ref().and_then(|zone| zone.placed.feasible()) {
            Some(best) => Some(best.posture()),
            None => self.map.stiffest(&self.model, &self.options).map(|(_, _, posture)| posture),
        }
    }

    /// What is said once, besides the axes.
    fn head(&self) -> Record {
        let direction = match self.options.load.direction() {
            Direction::InPlane(angle) => Some(words::asked_degrees(angle)),
            Direction::Worst | Direction::Base(_) | Direction::Tool { .. } => None,
        };
        let tool = match self.model.kind() {
            ModelKind::Planar => None,
            ModelKind::Spatial(flange_from_tool) => Some(flange_from_tool),
        };
        let searched = tool.is_some() && self.held().roll.is_none();
        let body = self.frequency.as_ref().and_then(|(_, tool)| tool.body.as_ref());
        let mut record = Record::of(&shape::MAP_HEAD);
        let robot = self.model.robot();
        stiffness::put_robot(&mut record, robot);
        record.put(field::MODEL, self.model.kind().name());
        force::put(&mut record, self.options.load);
        record
            .put(field::DIRECTION, direction)
            .put(field::ELBOW_MAPPED, self.options.elbow.map(Elbow::name))
            .put(field::TOOL, tool.as_ref().map(tool_mm))
            .put(field::TOOL_DIRECTION, tool.map(|_| words::asked_degrees(self.held().elevation)))
            .put(field::ROLL_TOLERANCE, searched.then_some(ROLL_TOLERANCE))
            .put(field::TOOL_MASS, body.map(|body| body.mass))
            .put(field::TOOL_COM, body.map(|body| body.centre.as_slice()))
            .put(field::TOOL_INERTIA, body.map(RigidBody::elements))
            .put(
                field::SLOWEST_P05,
                self.frequency.as_ref().and_then(|(found, _)| found.slowest).map(|spread| spread.p05),
            )
            .put(field::ZONE, self.zone.as_ref().map(PlaceAnswer::record));
        record
    }

    /// Everything but the numbers of the cells, with configuration and roll of each.
    ///
    /// # Panics
    /// Never: texts and finite numbers are JSON.
    pub fn head_json(&self) -> Value {
        let Value::Object(mut object) = with_schema("map", words::origin(self.model.robot()), &self.head()) else {
            unreachable!("a record is an object")
        };
        object.insert("x_m".into(), json!(self.map.deflection.x.points()));
        object.insert("z_m".into(), json!(self.map.deflection.z.points()));
        for (key, cells) in self.cells() {
            let known = cells.filter(|cells| !matches!(cells, Cells::Layer(_)));
            object.insert(key.into(), known.map_or(Value::Null, |cells| json!(cells)));
        }
        Value::Object(object)
    }

    /// What is known of the cells by its key; nothing where the model does not know it, or it was not asked.
    fn cells(&self) -> [(&'static str, Option<Cells<'_>>); 7] {
        let deflection = &self.map.deflection;
        let [worst, directed] = if self.options.load.is_worst() { [true, false] } else { [false, true] };
        let held = self.map.space.as_ref();
        let layer =
            |field: field::Field, grid| (field.key, Option::map(grid, |grid| Cells::Layer(Layer { field, grid })));
        [
            layer(field::WORST, worst.then_some(deflection)),
            layer(field::DIRECTED, directed.then_some(deflection)),
            layer(field::LIMIT_MARGIN, held.map(|held| &held.limits)),
            layer(field::SINGULAR_MARGIN, held.map(|held| &held.singular)),
            (field::POSTURE.key, held.map(Cells::Configurations)),
            (field::ROLL.key, held.map(Cells::Rolls)),
            layer(field::FIRST_FREQUENCY, self.frequency.as_ref().map(|(found, _)| &found.hertz)),
        ]
    }

    /// One row per cell, for a spreadsheet.
    pub fn rows(&self) -> Rows<'_> {
        let layers = self.layers();
        let grid = &self.map.deflection;
        let mut columns = [field::X, field::Z, field::DIRECTED].map(|field| columns_of(&field)).concat();
        if self.map.space.is_some() {
            let further =
                [field::SHOULDER, field::ELBOW, field::WRIST, field::ROLL, field::LIMIT_MARGIN, field::SINGULAR_MARGIN];
            columns.extend(further.map(|field| columns_of(&field)).concat());
        }
        columns.extend(self.frequency.iter().flat_map(|_| columns_of(&field::FIRST_FREQUENCY)));
        let row = move |cell: usize| {
            let (i, j) = (cell % grid.x.count, cell / grid.x.count);
            let mut cells = vec![Cell::Number(grid.x.at(i)), Cell::Number(grid.z.at(j)), layers[0].at(i, j)];
            if let Some(margins) = &self.map.space {
                cells.extend(held_cells(margins, i, j));
                cells.extend(layers[1..].iter().map(|layer| layer.at(i, j)));
            }
            cells
        };
        Rows::made(columns, grid.x.count * grid.z.count, row)
    }

    /// For people.
    pub fn table(&self) -> Table {
        let (robot, grid, kind) = (self.model.robot(), &self.map.deflection, self.model.kind());
        let mut mapped = format!("{}, {} model", words::mapped(self.options.load), kind.name());
        let mut lines = vec![line("robot", words::robot(robot)), line("stiffness", stiffness(robot))];
        if let ModelKind::Spatial(tool) = kind {
            let _ = write!(mapped, ", {}", words::direction(self.held().elevation));
            lines.push(line("mapped", mapped));
            lines.push(line("tool", words::tool(&tool)));
        } else {
            if let Some(elbow) = self.options.elbow {
                let _ = write!(mapped, ", elbow {} alone", elbow.name());
            }
            lines.push(line("mapped", mapped));
        }
        lines.push(line("points", format!("{} x {}, every {:.4} m", grid.x.count, grid.z.count, grid.x.step)));
        match grid.extremes() {
            None => lines.push(line("reached", "no point of the grid: choose a smaller step")),
            Some([least, most]) => {
                for (name, (value, i, j)) in [("least", least), ("most", most)] {
                    let held = self.map.space.as_ref().and_then(|margins| margins.at(i, j));
                    let held = held.map_or_else(String::new, |(configuration, _)| format!(" ({configuration})"));
                    let place =
                        format!("x {:.3} m, z {:.3} m from {}", grid.x.at(i), grid.z.at(j), words::origin(robot));
                    lines.push(line(name, format!("{:.4} mm at {place}{held}", value * 1e3)));
                }
            }
        }
        // In one direction a posture may give way less than in its worst: down to nothing.
        if self.options.load.is_worst()
            && let Some(floor) = self.model.floor()
        {
            let floor = floor * self.options.load.newtons() * 1e3;
            let says = format!("{floor:.4} mm in the worst direction at the stiffest posture of the links");
            lines.push(line("bound", says));
        }
        lines.extend(self.frequency_lines());
        if let Some((zone, best)) = self.zone.as_ref().and_then(|zone| Some((zone, zone.placed.feasible()?))) {
            let [x, z] = best.centre;
            let mut says = format!("{:.4} mm at worst, centre x {x:.3} m, z {z:.3} m", best.deflection * 1e3);
            if let Some((tolerance, verdict)) = zone.tolerance_mm.zip(zone.verdict()) {
                let (held, margin) = (verdict.in_words(), words::fixed(verdict.margin_mm, 4));
                let _ = write!(says, "; tolerance {tolerance} mm: {held}, margin {margin} mm");
            }
            lines.push(line(format!("zone {}", zone.task.label), says));
        }
        Table::of_lines(lines)
    }

    /// With what the arm swings, where that is mapped.
    pub(crate) fn swings_with(&self) -> Option<String> {
        self.frequency.as_ref().map(|(_, tool)| tool_note(self.model.robot(), tool, "lowers the frequencies"))
    }

    /// How slow and how fast the arm swings first, and with what it holds.
    fn frequency_lines(&self) -> Vec<Line> {
        let Some((FirstFrequencies { hertz: grid, slowest }, _)) = &self.frequency else { return Vec::new() };
        let mut lines: Vec<Line> =
            self.swings_with().map(|tool| line("swings", format!("motors held still; {tool}"))).into_iter().collect();
        for (name, (hertz, i, j)) in
            grid.extremes().into_iter().flat_map(|ends| ["slowest", "fastest"].into_iter().zip(ends))
        {
            let says = format!("{hertz:.2} Hz at x {:.3} m, z {:.3} m", grid.x.at(i), grid.z.at(j));
            lines.push(line(name, says));
        }
        if let Some(spread) = slowest {
            let says = format!("{:.2} Hz at the slowest point, over draws of the drive stiffness", spread.p05);
            lines.push(line("5th percentile", says));
        }
        lines
    }

    /// In which posture and at which roll each point is held.
    fn held_in_words(&self) -> String {
        let HeldPosture { roll, configuration, .. } = self.held();
        let posture = configuration.map_or_else(
            || "the best posture of each point".to_owned(),
            |configuration| format!("posture {configuration} alone"),
        );
        match roll {
            None => format!("{posture} and its best roll, to 0.1 %"),
            Some(roll) => format!("{posture}, at a roll of {}", words::degrees(roll)),
        }
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let notes = match self.model {
            Model::Planar(_) => "-o map.svg, .pdf, .png, .html, .csv, .parquet or .json writes the map\n".to_owned(),
            Model::Spatial(_) => {
                let stands = if self.options.load.breaks_symmetry() {
                    "for itself alone: the force is fixed to the base"
                } else {
                    "for every direction about the joint-1 axis"
                };
                format!(
                    "the section points straight ahead and stands {stands}; {}\n\
                     -o map.svg, .pdf, .png, .html, .csv, .parquet or .json writes the map; the tables with posture, roll and the margins to limits and singular postures\n",
                    self.held_in_words()
                )
            }
        };
        let robot = self.model.robot();
        let left_out =
            self.frequency.as_ref().and_then(|_| left_out_note(robot)).map_or_else(String::new, |note| note + "\n");
        format!("{}{left_out}{notes}", words::assumed_architecture([robot]))
    }
}

fn held_cells(margins: &Margins, i: usize, j: usize) -> [Cell; 4] {
    match margins.at(i, j) {
        None => [Cell::Absent, Cell::Absent, Cell::Absent, Cell::Absent],
        Some((held, roll)) => [
            Cell::Text(held.shoulder.name().into()),
            Cell::Text(held.elbow.name().into()),
            Cell::Text(held.wrist.name().into()),
            Cell::Number(Unit::Degree.of_si(roll)),
        ],
    }
}

impl Serialize for MapAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        object.serialize_entry("schema", &self.schema())?;
        for (key, value) in self.head().json().as_object().into_iter().flatten() {
            object.serialize_entry(key, value)?;
        }
        object.serialize_entry("x_m", &self.map.deflection.x.points())?;
        object.serialize_entry("z_m", &self.map.deflection.z.points())?;
        for (key, cells) in self.cells() {
            object.serialize_entry(key, &cells)?;
        }
        object.end()
    }
}

/// Rows from the first z, each from the first x; null where nothing is reached.
#[derive(Clone, Copy)]
enum Cells<'a> {
    Layer(Layer<'a>),
    Configurations(&'a Margins),
    Rolls(&'a Margins),
}

impl Serialize for Cells<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let rows = match self {
            Self::Layer(layer) => layer.grid.z.count,
            Self::Configurations(margins) | Self::Rolls(margins) => margins.limits.z.count,
        };
        serializer.collect_seq((0..rows).map(|j| CellsOfRow(*self, j)))
    }
}

struct CellsOfRow<'a>(Cells<'a>, usize);

impl Serialize for CellsOfRow<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(cells, j) = *self;
        match cells {
            Cells::Layer(layer) => serializer.collect_seq(layer.row(j)),
            Cells::Configurations(margins) => serializer
                .collect_seq(margins.row(j).map(|held| held.map(|(configuration, _)| configuration.to_string()))),
            Cells::Rolls(margins) => {
                serializer.collect_seq(margins.row(j).map(|held| held.map(|(_, roll)| Unit::Degree.of_si(roll))))
            }
        }
    }
}
