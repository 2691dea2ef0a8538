//! How does an arm swing over a zone? The answer as fields and as text.

use serde_json::{Value, json};
use stiffarm::limits::Pendant;
use stiffarm::mass::RigidBody;
use stiffarm::modes::{HeldTool, ModeOverZone, SwingOverZone, left_out};
use stiffarm::place::{PlaceOptions, Placement, SpaceHold};
use stiffarm::robot::Robot;
use stiffarm::task::{Task, Zone};

use super::compliance::vector;
use super::modes::{left_out_note, tool_note};
use super::stiffness::{self, stiffness};
use super::words::{self, asked_degrees, degrees, direction, fixed, tool_mm};
use super::{Datum, Record, Rows, Table, field, shape, with_schema};

/// The answer of `modes` over a zone, with what was asked.
#[derive(Clone, Debug)]
pub struct ModesOverAnswer {
    /// Which robot.
    pub robot: Robot,
    /// Which zone.
    pub task: Task<Zone>,
    /// Where it stands.
    pub options: PlaceOptions,
    /// How it is held there.
    pub best: Placement,
    /// With what.
    pub tool: HeldTool,
    /// How many modes are reported.
    pub count: usize,
    /// What was found.
    pub over: SwingOverZone,
}

impl ModesOverAnswer {
    /// Those that are reported.
    pub fn modes(&self) -> &[ModeOverZone] {
        &self.over.modes[..self.count.min(self.over.modes.len())]
    }

    /// 5th percentile of the least first frequency, by draws of the drive stiffness at the point of the least, Hz.
    fn first_at_least_p05(&self) -> Option<f64> {
        let first = self.over.modes.first()?;
        Some(first.spread?.p05 * (self.over.first_at_least? / first.least))
    }

    fn hold(&self) -> Option<&SpaceHold> {
        self.best.space()
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let Self { robot, task, options, best, tool, over, .. } = self;
        let (body, hold) = (tool.body.as_ref(), self.hold());
        let mut record = Record::of(&shape::MODES_OVER_ZONE);
        stiffness::put_robot(&mut record, robot);
        record
            .put(field::MODEL, "spatial")
            .put(field::TASK, &task.label)
            .put(field::TOOL, tool_mm(&tool.flange_from_tool))
            .put(field::TOOL_DIRECTION, asked_degrees(options.tool_orientation().elevation))
            .put(field::X, best.centre[0])
            .put(field::Z, best.centre[1])
            .put(field::BEARING, hold.map(|hold| hold.bearing))
            .put(field::YAW, hold.map(|hold| hold.yaw))
            .put(field::ANGLE, best.angle)
            .put(field::ROLL, hold.map(|hold| hold.roll))
            .put(field::SHOULDER, hold.map(|hold| hold.configuration.shoulder.name()))
            .put(field::ELBOW, best.elbow.name())
            .put(field::WRIST, hold.map(|hold| hold.configuration.wrist.name()))
            .put(field::PENDANT, robot.pendant().map(Pendant::name))
            .put(field::TOOL_MASS, body.map(|body| body.mass))
            .put(field::TOOL_COM, body.map(|body| body.centre.as_slice()))
            .put(field::TOOL_INERTIA, body.map(RigidBody::elements))
            .put(field::MASSES_LEFT_OUT, json!(left_out(robot)))
            .put(field::FIRST_AT_LEAST, over.first_at_least)
            .put(field::FIRST_AT_LEAST_P05, self.first_at_least_p05())
            .put(field::ZONE_PARTS, over.parts)
            .put(field::SAMPLES, over.points)
            .put(field::SAMPLE_STEP, over.step)
            .put(field::MODES, self.records().collect::<Datum>());
        record
    }

    /// Each mode.
    fn records(&self) -> impl Iterator<Item = Record> + '_ {
        self.modes().iter().enumerate().map(|(rank, mode)| {
            let mut record = Record::of(&shape::MODE_OVER_ZONE);
            record
                .put(field::MODE, rank + 1)
                .put(field::FREQUENCY_LEAST, mode.least)
                .put(field::FREQUENCY_P05, mode.spread.map(|spread| spread.p05))
                .put(field::FREQUENCY_P95, mode.spread.map(|spread| spread.p95))
                .put(field::LEAST_AT, mode.least_at)
                .put(field::FREQUENCY_LARGEST, mode.largest)
                .put(field::LARGEST_AT, mode.largest_at);
            record
        })
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("modes", super::ORIGIN, &self.record())
    }

    /// A row a mode, for a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        Rows::of(&shape::MODE_OVER_ZONE, self.records())
    }

    /// For people.
    pub fn table(&self) -> Table {
        let headings = ["mode", "least Hz", "90 % Hz there", "at x, y, z m", "largest Hz", "at x, y, z m"];
        let mut table = Table::new(headings);
        let place = |at: [f64; 3]| vector(&at.into(), 3);
        for (rank, mode) in self.modes().iter().enumerate() {
            let between = mode.spread.map(|spread| format!("{}..{}", fixed(spread.p05, 1), fixed(spread.p95, 1)));
            table.row([
                (rank + 1).to_string(),
                fixed(mode.least, 2),
                between.unwrap_or_else(|| "-".into()),
                place(mode.least_at),
                fixed(mode.largest, 2),
                place(mode.largest_at),
            ]);
        }
        table
    }

    /// What is proved of the first frequency.
    fn proof(&self) -> String {
        let Some(first) = self.over.first_at_least else {
            return format!("first frequency: nothing is proved ({} parts of the zone)", self.over.parts);
        };
        let drawn = self.first_at_least_p05().map_or_else(
            || "the drive stiffness has no stated uncertainty".into(),
            |p05| format!("5th percentile over draws of the drive stiffness: {} Hz", fixed(p05, 2)),
        );
        let missing = left_out(&self.robot);
        let of = if missing.is_empty() {
            String::new()
        } else {
            format!(" of an arm without {}, which may swing slower", missing.join(" and "))
        };
        format!(
            "first frequency: proved to be at least {} Hz in all of the zone ({} parts) at the nominal stiffness{of}; {drawn}",
            fixed(first, 2),
            self.over.parts
        )
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let Self { robot, task, options, best, tool, over, .. } = self;
        let [x, z] = best.centre;
        let mut notes = vec![
            self.proof(),
            format!(
                "least and largest: of {} points, at most {:.0} mm apart, not proved; modes are counted by frequency at each point",
                over.points,
                over.step * 1e3
            ),
            words::robot(robot),
            format!("stiffness: {}", stiffness(robot)),
            format!(
                "zone: {} ({}), {}; its middle at x {} m, z {} m from the base",
                task.label,
                task.work.describe(),
                direction(options.tool_orientation().elevation),
                fixed(x, 3),
                fixed(z, 3)
            ),
        ];
        notes.extend(self.hold().map(|hold| {
            format!(
                "held {}, first side at {}, tool rolled by {}{}: of what was left open the stiffest way",
                hold.configuration,
                degrees(best.angle),
                degrees(hold.roll),
                if hold.bearing == 0.0 {
                    String::new()
                } else {
                    format!(", turned by {} about the joint-1 axis", degrees(hold.bearing))
                }
            )
        }));
        notes.push(tool_note(robot, tool, "lowers the frequencies"));
        notes.push(
            "motors held still by the brakes or a stiff servo; a soft servo lowers all frequencies, the proved one too"
                .into(),
        );
        notes.extend(left_out_note(robot));
        notes.push("base axes: x forward, y left, z up; bearings, links and base rigid".into());
        notes.join("\n") + "\n"
    }
}
