//! How does an arm swing? The answer as fields and as text.

use serde_json::{Value, json};
use stiffarm::limits::Pendant;
use stiffarm::mass::{RigidBody, ToolWeight};
use stiffarm::modes::{DAMPING_RATIO, Damping, HeldTool, Mode, Swing, left_out};
use stiffarm::robot::{Arm, Robot};

use super::compliance::vector;
use super::payload::FlangeLoad;
use super::stiffness::{self, stiffness};
use super::words::{self, fixed, percentages};
use super::{Datum, Record, Rows, Table, field, shape, with_schema};

/// The answer of `modes`, with what was asked.
#[derive(Clone, Debug)]
pub struct ModesAnswer {
    /// Which robot.
    pub robot: Robot,
    /// The joint angles that it reports, deg, as they were given.
    pub joints_deg: [f64; 6],
    /// What it holds.
    pub tool: HeldTool,
    /// A damping that was given.
    pub damping: Option<Damping>,
    /// How many modes are reported.
    pub count: usize,
    /// What was found.
    pub swing: Swing,
}

impl ModesAnswer {
    /// Those that are reported.
    pub fn modes(&self) -> &[Mode] {
        &self.swing.modes[..self.count.min(self.swing.modes.len())]
    }

    /// Where the damping is from.
    fn damping_source(&self) -> &'static str {
        match (self.damping, &self.robot.arm) {
            (Some(_), _) => "given",
            (None, Arm::SixAxis { drives, .. }) if drives.motors.damping.is_some() => "robot file",
            (None, _) => "assumed",
        }
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let Self { robot, joints_deg, tool, swing, .. } = self;
        let body = tool.body.as_ref();
        let mut record = Record::of(&shape::MODES);
        stiffness::put_robot(&mut record, robot);
        record
            .put(field::MODEL, "spatial")
            .put(field::JOINTS, *joints_deg)
            .put(field::PENDANT, robot.pendant().map(Pendant::name))
            .put(field::TCP, swing.tool.translation.vector.as_slice())
            .put(field::TOOL_MASS, body.map(|body| body.mass))
            .put(field::TOOL_COM, body.map(|body| body.centre.as_slice()))
            .put(field::TOOL_INERTIA, body.map(RigidBody::elements))
            .put(field::DAMPING_SOURCE, self.damping_source())
            .put(field::MASSES_LEFT_OUT, json!(left_out(robot)))
            .put(field::MODES, self.records().collect::<Datum>());
        record
    }

    /// Each mode.
    fn records(&self) -> impl Iterator<Item = Record> + '_ {
        self.modes().iter().enumerate().map(|(rank, mode)| {
            let mut record = Record::of(&shape::SWING_MODE);
            record
                .put(field::MODE, rank + 1)
                .put(field::FREQUENCY, mode.frequency)
                .put(field::FREQUENCY_P05, mode.spread.map(|spread| spread.p05))
                .put(field::FREQUENCY_P95, mode.spread.map(|spread| spread.p95))
                .put(field::FREQUENCY_FREE, mode.motors_free)
                .put(field::DAMPING_RATIO, mode.damping_ratio)
                .put(field::TIP_SHAPE, mode.tip.as_slice())
                .put(field::ENERGY_SHARES, mode.drive_shares);
            record
        })
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("modes", super::ORIGIN, &self.record())
    }

    /// A row a mode, for a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        Rows::of(&shape::SWING_MODE, self.records())
    }

    /// For people.
    pub fn table(&self) -> Table {
        let headings =
            ["mode", "Hz", "90 % Hz", "motors free Hz", "damping", "tip moves along x, y, z", "energy in drives 1-6"];
        let mut table = Table::new(headings);
        let or_dash = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |hertz| fixed(hertz, 2));
        for (rank, mode) in self.modes().iter().enumerate() {
            let between =
                |spread: stiffarm::uncertainty::Spread| format!("{}..{}", fixed(spread.p05, 1), fixed(spread.p95, 1));
            table.row([
                (rank + 1).to_string(),
                fixed(mode.frequency, 2),
                mode.spread.map_or_else(|| "-".into(), between),
                or_dash(mode.motors_free),
                fixed(mode.damping_ratio, 3),
                // A mode that does not move the tip has no direction.
                mode.tip.try_normalize(1e-9).map_or_else(|| "-".into(), |along| vector(&along, 2)),
                percentages(&mode.drive_shares),
            ]);
        }
        table
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let Self { robot, joints_deg, tool, swing, .. } = self;
        let angles = joints_deg.map(|angle| angle.to_string()).join(", ");
        let mut notes = vec![
            format!("{}; {}: {angles} deg", words::robot(robot), words::joints_reported(robot)),
            format!("stiffness: {}", stiffness(robot)),
            format!("tool point from the base: {} m", vector(&swing.tool.translation.vector, 4)),
            tool_note(robot, tool, "lowers the frequencies"),
            match self.damping_source() {
                "assumed" => {
                    format!("damping: assumed {DAMPING_RATIO} of every mode; measured on such arms 0.02 to 0.08")
                }
                source => format!("damping: {source}"),
            },
            "motors held still by the brakes or a stiff servo; a soft servo lowers the frequencies below both columns"
                .into(),
        ];
        notes.extend(left_out_note(robot));
        let calm = self.modes().iter().enumerate().filter(|(_, mode)| 1.0 - 1e-9 <= mode.damping_ratio);
        let calm: Vec<String> = calm.map(|(rank, _)| (rank + 1).to_string()).collect();
        if !calm.is_empty() {
            let modes = calm.join(", ");
            notes.push(format!(
                "with a damping of 1 or more nothing swings (mode {modes}): the frequency is the undamped one"
            ));
        }
        if swing.modes.iter().all(|mode| mode.spread.is_none()) {
            notes.push("the drive stiffness has no stated uncertainty, so the frequencies have no interval".into());
        }
        notes.push("base axes: x forward, y left, z up; bearings, links and base rigid".into());
        notes.join("\n") + "\n"
    }
}

/// What the tool weighs; of one that weighs nothing what a real one does.
pub(super) fn tool_note(robot: &Robot, tool: &HeldTool, does: &str) -> String {
    let Some(body) = tool.body else {
        return format!("tool: weighs nothing; a real one {does} (--tool-mass-kg, --tool-com-mm)");
    };
    let weight = ToolWeight { mass: body.mass, centre: Some(body.centre) };
    let carried = FlangeLoad { tool: Some(weight), tip: None, newtons: 0.0 }.by(robot);
    let forbidden = carried.forbidden(robot).map_or_else(String::new, |sentence| format!("; {sentence}"));
    format!("tool: {} kg, centre {} mm from the flange{forbidden}", body.mass, vector(&(body.centre * 1e3), 0))
}

/// Which moving parts are left out, where there are some.
pub(super) fn left_out_note(robot: &Robot) -> Option<String> {
    let missing = left_out(robot);
    (!missing.is_empty()).then(|| {
        let missing = missing.join(" and ");
        format!("left out, no mass in the robot file: {missing}; true frequencies lie lower or higher")
    })
}
