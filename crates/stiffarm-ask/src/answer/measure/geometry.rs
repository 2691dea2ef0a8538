//! How is a plan of postures reported in which an arm is measured to be calibrated?

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::super::Unit;
use super::super::numbers::digits;
use super::super::words::{self, fixed};
use super::super::{Cell, Column, ColumnKind, Datum, Line, Record, Rows, Table, field, line, shape, with_schema};
use super::{DrawnPosture, in_degrees, looked_at, sight};
use stiffarm::calibrate::{GEARS_PRIOR, WEIGHT_PRIOR};
use stiffarm::limits::Pendant;
use stiffarm::measure::{GeometryPlan, Options};
use stiffarm::robot::Robot;

/// The line that says what is left.
const LEFT: &str = "error at the work, calibrated";

/// The answer of `measure --geometry`, with what was asked.
#[derive(Clone, Debug)]
pub struct GeometryAnswer {
    /// Which robot.
    pub robot: Robot,
    /// What was asked.
    pub options: Options,
    /// What the work is, in words.
    pub work: String,
    /// What was found.
    pub plan: GeometryPlan,
}

impl GeometryAnswer {
    /// The postures, in their order.
    pub fn postures(&self) -> Vec<DrawnPosture> {
        let drawn =
            |(i, q): (usize, &[f64; 6])| DrawnPosture::of(&self.robot, (i + 1, q), &self.options.markers, |_| None);
        self.plan.postures.iter().enumerate().filter_map(drawn).collect()
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let plan = &self.plan;
        let by_count = plan.by_count.iter().map(|(count, left)| {
            let mut record = Record::of(&shape::CALIBRATION_LEAVES);
            record.put(field::POSTURE_COUNT, *count).put(field::EXPECTED_AT_WORK, *left);
            record
        });
        let run = |(i, q): (usize, &[f64; 6])| {
            let mut record = Record::of(&shape::PLANNED_POSTURE);
            record.put(field::RUN, i + 1).put(field::JOINTS, in_degrees(q));
            record
        };
        let mut at_work = Record::of(&shape::PLANNED_AT_WORK);
        at_work
            .put(field::EXPECTED_AT_WORK, plan.expected)
            .put(field::LEAST_AT_WORK, plan.lower_bound)
            .put(field::RANDOM_AT_WORK, plan.random)
            .put(field::AS_DRAWN, plan.as_drawn)
            .put(field::UNEXPLAINED, plan.unexplained)
            .put(field::WORK_POSTURES, plan.work);
        let markers = self.options.markers.iter().map(|at| json!(at.as_slice())).collect::<Value>();
        let mut record = Record::of(&shape::CALIBRATION_PLAN);
        record
            .put(field::ROBOT, &self.robot.name)
            .put(field::VENDOR, &self.robot.vendor)
            .put(field::PENDANT, self.robot.pendant().map(Pendant::name))
            .put(field::POINTS_SEEN, markers)
            .put(field::AT_WORK, at_work)
            .put(field::EFFICIENCY, plan.efficiency())
            .put(field::RANDOM_EFFICIENCY, plan.random_efficiency())
            .put(field::CANDIDATES, plan.candidates)
            .put(field::BY_COUNT, by_count.collect::<Datum>())
            .put(field::RUNS, plan.postures.iter().enumerate().map(run).collect::<Datum>());
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("measure", super::super::ORIGIN, &self.record())
    }

    /// The table to be filled in, which `calibrate` reads: a row a posture.
    pub fn rows(&self) -> Rows<'static> {
        let number = |name: String| Column::new(name, ColumnKind::Number);
        let count = self.options.markers.len();
        let joints = (1..=6).map(|i| number(format!("q{i}_deg")));
        let seen = (1..=count).flat_map(|i| ["x", "y", "z"].map(|axis| number(format!("{axis}{i}_mm"))));
        let row = |q: &[f64; 6]| {
            let joints = in_degrees(q).map(Cell::Number).into_iter();
            joints.chain(std::iter::repeat_n(Cell::Absent, 3 * count)).collect()
        };
        let rows = self.plan.postures.iter().map(row).collect();
        Rows::new(joints.chain(seen).collect(), rows).under(words::pendant(&self.robot))
    }

    /// What stands above the postures.
    pub fn summary(&self) -> Table {
        let Self { robot, options, plan, work } = self;
        let mm = |metres: f64| format!("{} mm", fixed(metres * 1e3, 3));
        let percent = |share: f64| format!("{} %", fixed(100.0 * share, 1));
        let point =
            |at: &Vector3<f64>| (at * 1e3).iter().map(|x| digits(*x, 4).to_string()).collect::<Vec<_>>().join(",");
        let points: Vec<String> = options.markers.iter().map(point).collect();
        let wanted = if plan.candidates < options.candidates {
            format!(" of {}: no more were found that can be measured", options.candidates)
        } else {
            String::new()
        };
        let by_count = plan.by_count.iter().map(|(count, left)| format!("{count}: {}", fixed(left * 1e3, 3)));
        let mut lines: Vec<Line> = vec![
            line("robot", words::robot(robot)),
            line("points in the flange", format!("{} mm", points.join("; "))),
            line("points are seen", sight(options)),
            line("work", format!("{work}, {} postures", plan.work)),
            line(
                "candidates",
                format!(
                    "{} postures{wanted}; of a coordinate {} mm by the reading, and {} mm that no error of the arm explains",
                    plan.candidates,
                    digits(options.sigma * 1e3, 6),
                    digits(options.posture_sigma * 1e3, 6)
                ),
            ),
            line(LEFT, format!("{} expected (rms of point 1{})", mm(plan.expected), self.beside_the_tip())),
            line(
                "lower bound of any choice",
                format!("{} (efficiency {} at least)", mm(plan.lower_bound), percent(plan.efficiency())),
            ),
            line(
                "chosen at random",
                format!("{} (efficiency {}, median)", mm(plan.random), percent(plan.random_efficiency())),
            ),
            line("as drawn", mm(plan.as_drawn)),
        ];
        lines.push(line("mm by number of postures", by_count.collect::<Vec<_>>().join(", ")));
        let means = format!("error at the work that {} measured postures leave", plan.postures.len());
        Table::of_lines(lines).led_by([LEFT, "points are seen"], means, &[])
    }

    /// That the tip of the tool is not the point of which is said what remains.
    fn beside_the_tip(&self) -> String {
        let first = self.options.markers.first().copied().unwrap_or_default();
        let apart = (self.options.tool - first).norm();
        if self.options.work.is_empty() || apart < 1e-3 {
            return String::new();
        }
        format!("; the tool tip, {} mm from it, errs otherwise", fixed(apart * 1e3, 0))
    }

    /// One row a posture.
    pub fn table(&self) -> Table {
        let joints_in_deg = format!("{} deg", words::joints_reported(&self.robot));
        let mut table = Table::new(["posture", &joints_in_deg]);
        for (i, q) in self.plan.postures.iter().enumerate() {
            table.row([(i + 1).to_string(), in_degrees(q).map(|angle| fixed(angle, 2)).join(", ")]);
        }
        table
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let mrad = |rad: f64| digits(Unit::Milliradian.of_si(rad), 2);
        format!(
            "{}{}\nassumed: frames of the joints are off by {} mm and mrad, drives yield by {} mrad under the own weight, gears err by {} mrad (one standard deviation each)\n\
             {}-o plan.csv writes the table to be filled in (x1_mm, y1_mm, z1_mm), which `stiffarm calibrate` reads\n",
            words::pendant_note(&self.robot),
            looked_at(&self.robot, &self.options),
            mrad(self.plan.scale),
            mrad(WEIGHT_PRIOR),
            mrad(GEARS_PRIOR),
            self.on_axis_note()
        )
    }

    /// Points on the axis of joint 6 do not move with it.
    fn on_axis_note(&self) -> &'static str {
        /// m: nearer to it the zero of joint 6 cannot be found.
        const NEAR: f64 = 1e-3;
        if self.options.markers.iter().any(|at| NEAR < at.xy().norm()) {
            return "";
        }
        "all points lie on the axis of joint 6, so they show nothing of its zero: a point aside of it does (--marker-mm)\n"
    }
}
