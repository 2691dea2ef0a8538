//! What is reported of the force of a process.

use serde_json::Value;

use super::numbers::rpm;
use super::{Cell, Column, ColumnKind, Line, Record, Rows, Table, field, fixed, line, schema_of, shape, under};
use stiffarm::catalogue::ProcessFile;
use stiffarm::cutting::{CuttingForce, Engagement, Law, Measured, MeasuredAxes, Milling, Side};

/// The answer of `force`, with what was asked.
#[derive(Clone, Debug)]
pub struct CuttingAnswer {
    /// The process file as it was named.
    pub file: String,
    /// What it says.
    pub process: ProcessFile,
    /// What was found.
    pub force: CuttingForce,
}

impl CuttingAnswer {
    /// Where the force comes from, in a word.
    pub fn law(&self) -> &'static str {
        match &self.process.process.law {
            Law::Worst(_) => "worst",
            Law::Constant(_) => "constant",
            Law::Milling(Milling { edge: stiffarm::cutting::Edge::Linear { .. }, .. }) => "mechanistic milling",
            Law::Milling(_) => "Kienzle milling",
            Law::Drilling { .. } => "drilling",
            Law::FrictionStir { .. } => "friction stir",
            Law::Measured(Measured { axes: MeasuredAxes::Cut, .. }) => "measured, along the axes of the cut",
            Law::Measured(_) => "measured, along the axes of the part",
        }
    }

    fn milling(&self) -> Option<&Milling> {
        if let Law::Milling(milling) = &self.process.process.law { Some(milling) } else { None }
    }

    /// Speed of the spindle, turns a minute.
    fn rpm(&self) -> Option<f64> {
        self.process.process.spindle.map(rpm)
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let Self { file, process, force } = self;
        let (material, cut) = (process.material.as_ref(), self.milling().map(|milling| &milling.engagement));
        let mut record = Record::of(&shape::FORCE);
        record
            .put(field::PROCESS, file)
            .put(field::LAW, self.law())
            .put(field::MATERIAL, material.map(|material| &material.name))
            .put(field::MATERIAL_STATUS, material.map(|material| &material.status))
            .put(field::MATERIAL_SOURCE, material.map(|material| &material.source))
            .put(field::MEAN_FORCE, force.mean)
            .put(field::MAX_FORCE, force.range.map(|[_, high]| high))
            .put(field::MIN_FORCE, force.range.map(|[low, _]| low))
            .put(field::PEAK_FORCE, force.largest)
            .put(field::MOMENT, force.moment)
            .put(field::POWER, force.power)
            .put(field::SPINDLE_SPEED, self.rpm())
            .put(field::ENTRY_ANGLE, cut.map(Engagement::entry))
            .put(field::EXIT_ANGLE, cut.map(Engagement::exit))
            .put(field::ASSUMED, serde_json::json!(process.assumed));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        under(
            schema_of("force", "the tool point", "feed, across (left of the feed), axial (away from the work)"),
            &self.record(),
        )
    }

    /// For a spreadsheet: the force over a revolution.
    pub fn rows(&self) -> Rows<'_> {
        let columns = ["angle_deg", "feed_n", "across_n", "axial_n"].map(|name| Column::new(name, ColumnKind::Number));
        let count = self.force.revolution.len();
        Rows::made(columns.into(), count, move |i| {
            let angle = 360.0 * i as f64 / count as f64;
            let [x, y, z] = self.force.revolution[i];
            [angle, x, y, z].map(|number| Cell::Number(number + 0.0)).into()
        })
    }

    /// For people.
    pub fn table(&self) -> Table {
        let Self { file, process, force } = self;
        let mut lines: Vec<Line> = vec![line("process", file), line("law", self.law())];
        if let Some(material) = &process.material {
            lines.push(line("material", format!("{}: {}", material.name, material.about)));
            lines.push(line("", &material.source));
        }
        if let Some(milling) = self.milling() {
            let cut = &milling.engagement;
            let degrees = |angle: f64| fixed(angle.to_degrees(), 2);
            let of = format!("{} mm, {} teeth", fixed(milling.diameter * 1e3, 2), milling.teeth);
            lines.push(line("tool", format!("{of}, helix {} deg", degrees(milling.helix))));
            let (depth, feed) = (fixed(cut.depth() * 1e3, 3), fixed(cut.feed_per_tooth * 1e3, 4));
            lines.push(line(
                "engagement",
                format!(
                    "{depth} mm deep, {feed} mm per tooth, from {} to {} deg",
                    degrees(cut.entry()),
                    degrees(cut.exit())
                ),
            ));
        }
        if let Some(rpm) = self.rpm() {
            lines.push(line("spindle", format!("{} rpm", fixed(rpm, 1))));
        }
        match (force.mean, force.range) {
            (Some(mean), Some([low, high])) => {
                let is_of_part =
                    matches!(process.process.law, Law::Measured(Measured { axes: MeasuredAxes::Part, .. }));
                let names = ["feed", "across, to its left", "axial, away from the work"];
                let names = if is_of_part { ["along x of the part", "along y", "along z"] } else { names };
                for (i, name) in names.into_iter().enumerate() {
                    let text =
                        format!("mean {} N, from {} to {} N", fixed(mean[i], 2), fixed(low[i], 2), fixed(high[i], 2));
                    lines.push(line(name, text));
                }
                lines.push(line("largest", format!("{} N", fixed(force.largest, 2))));
            }
            _ => lines.push(line("force", format!("{} N in any direction", fixed(force.largest, 2)))),
        }
        let moment = if force.moment == 0.0 {
            "none is given, so that 0 is taken".into()
        } else {
            format!("{} N m", fixed(force.moment, 4))
        };
        lines.push(line("moment about the axis", moment));
        let power = force.power.map_or("not known".into(), |power| format!("{} W", fixed(power, 1)));
        lines.push(line("power of the spindle", power));
        for one in &process.assumed {
            lines.push(line("assumed", one));
        }
        Table::of_lines(lines)
    }

    /// What stands below the table.
    pub fn notes(&self) -> &'static str {
        if matches!(self.process.process.law, Law::Measured(_)) {
            return "forces on the tool, as measured along the path: mean and range of the whole table\n";
        }
        "forces on the tool; a robot follows the mean, the teeth cut at frequencies far above its first modes\n"
    }

    /// What a figure says of the engagement.
    pub fn heading(&self) -> String {
        self.milling().map_or_else(String::new, |milling| {
            let cut = &milling.engagement;
            let side = match (cut.entry(), cut.exit()) {
                (0.0, exit) if exit < std::f64::consts::PI => Side::Up.name(),
                (entry, _) if 0.0 < entry => Side::Down.name(),
                _ => Side::Slot.name(),
            };
            let [d, a, c] = [milling.diameter, cut.depth(), cut.feed_per_tooth].map(|metres| fixed(metres * 1e3, 3));
            format!("{d} mm, {} teeth, {side}, {a} mm deep, {c} mm per tooth", milling.teeth)
        })
    }
}
