//! Every field of a path that is milled, and every sample as a row.

use serde_json::json;

use super::super::cell as cell_report;
use super::super::path::corners;
use super::super::verdict::{self, Verdict};
use super::super::words::bodies;
use super::super::{Cell, Column, ColumnKind, Datum, Record, Rows, field, shape};
use super::{Compensation, MillAnswer, PathChatterAnswer, least};
use stiffarm::clearance::Near;
use stiffarm::limits::Pendant;
use stiffarm::mill::{Acting, FedBack, Pushed, Stand, Station};
use stiffarm::robot::Arm;
use stiffarm::uncertainty::Spread;

impl MillAnswer {
    /// Every field but those of single samples.
    pub fn record(&self) -> Record {
        let (robot, options) = (&self.robot, &self.options);
        let found = self.followed();
        let worst = found.map(|found| (&self.stations[found.worst.1], &found.samples[found.worst.1]));
        let mut record = Record::of(&shape::MILLED);
        record
            .put(field::ROBOT, &robot.name)
            .put(field::STIFFNESS_SOURCE, robot.stiffness_source().name())
            .put(field::PENDANT, robot.pendant().map(Pendant::name))
            .put(field::PATH, &self.path)
            .put(field::ONLY_TOOL, self.only_tool.map(|tool| tool as usize))
            .put(field::CUTTING_FORCE, &self.force);
        self.carried().put(&mut record);
        record
            .put(field::PART, self.part())
            .put(field::ROLL_CHOICE, self.roll())
            .put(field::ERROR_PART, options.part.name())
            .put(field::ASKED_LIMIT_MARGIN, options.limit_margin)
            .put(field::ASKED_SINGULAR_MARGIN, options.singular_margin)
            .put(field::SPEED_SHARE, self.speeds().map(|_| options.share_of_speed))
            .put(field::CLEAR_OF_BASE, self.column())
            .put(field::ROBOT_CELL, self.ground.cell.map(|cell| cell_report::record(&cell, &self.robot)));
        self.put_place(&mut record);
        record
            .put(field::FEASIBLE, found.is_some())
            .put(field::REASON, self.reason())
            .put(field::PATH_WORST, found.map(|found| found.worst.0))
            .put(field::PATH_WORST_P05, self.spread().map(|spread| spread.p05))
            .put(field::PATH_WORST_P50, self.spread().map(|spread| spread.median))
            .put(field::PATH_WORST_P95, self.spread().map(|spread| spread.p95))
            .put(field::PATH_LOWER_BOUND, self.lower_bound())
            .put(field::ROLL_LOWER_BOUND, found.map(|found| found.lower_bound))
            .put(field::RMS, found.map(|found| found.rms))
            .put(field::WORST_SAMPLE, found.map(|found| found.worst.1))
            .put(field::WORST_LINE, worst.map(|(station, _)| station.sample.line))
            .put(field::WORST_JOINTS, worst.map(|(_, pushed)| pushed.joints))
            .put(field::WORST_SHARES, worst.and_then(|(_, pushed)| pushed.shares))
            .put(field::LIMIT_MARGIN, found.map(|found| least(found, |pushed| pushed.limit_margin)))
            .put(field::SINGULAR_MARGIN, found.map(|found| least(found, |pushed| pushed.singular_margin)));
        Self::put_clearance(Some(self), &mut record);
        verdict::put(&mut record, self.tolerance_mm, self.verdict(), false);
        let compensated = |one: &Compensation| {
            let spread = one.remaining.as_ref().map(|(left, _)| Spread::of(left.all.clone()));
            compensated(std::iter::once(one), spread, self.compensated_verdict())
        };
        record
            .put(field::FED_BACK, self.fed_back.as_ref().map(fed_back))
            .put(field::PATH_CHATTER, self.chatter_record())
            .put(field::PATH_COMPENSATION, self.compensation.as_ref().map(compensated))
            .put(field::SEARCH, self.search());
        self.put_arm(&mut record);
        record.put(field::REMARKS, json!(self.remarks));
        record
    }

    /// Where the part stands.
    pub(super) fn put_place(&self, record: &mut Record) {
        let in_cell = self.placement.filter(|_| self.ground.cell.is_some());
        record
            .put(field::AT, self.placement.map(|placement| placement.at_from_base()))
            .put(field::AT_YAW, self.placement.and_then(|placement| placement.yaw_from_ahead()))
            .put(field::CELL_ORIGIN, in_cell.map(|placement| placement.at))
            .put(field::CELL_YAW, in_cell.map(|placement| placement.yaw));
    }

    /// What the path was to keep from the joint-1 axis, m; `None` where its place was given, or it is not known where that axis stands.
    fn column(&self) -> Option<f64> {
        self.search.filter(|_| self.robot.knows_base()).map(|_| self.ground.margins.radius(&self.robot))
    }

    /// How long the path is, and how long it takes.
    pub(super) fn part(&self) -> Record {
        let cutting = self.stations.windows(2).filter(|pair| pair[1].sample.is_cutting && pair[0].sample.is_cutting);
        let way = |station: Option<&Station>| station.map_or(0.0, |station| station.sample.way);
        let feeding = self.stations.iter().filter(|station| station.sample.is_cutting && !station.is_fresh);
        let mut record = Record::of(&shape::PATH_LENGTH);
        record
            .put(field::SAMPLES_OF_PATH, self.stations.len())
            .put(field::PATH_LENGTH, way(self.stations.last()) - way(self.stations.first()))
            .put(field::CUTTING_LENGTH, cutting.map(|pair| pair[1].sample.way - pair[0].sample.way).sum::<f64>())
            .put(field::TIME, feeding.map(|station| station.time).sum::<Option<f64>>())
            .put(field::BOX, self.survey.extent.map(corners))
            .put(field::RAPID_LENGTH, self.survey.rapid_length)
            .put(field::RAPID_BOX, self.survey.rapid_extent.map(corners));
        record
    }

    /// How the tool is turned about its axis.
    pub(super) fn roll(&self) -> Record {
        let rolls = self.followed().map(|found| {
            let all = || found.samples.iter().map(|pushed| pushed.arrangement.roll);
            [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
        });
        let changes = self.followed().map(|found| {
            found
                .samples
                .windows(2)
                .filter(|pair| pair[0].arrangement.configuration != pair[1].arrangement.configuration)
                .count()
        });
        let first = self.followed().map(|found| found.samples[0].arrangement.configuration);
        let mut record = Record::of(&shape::ROLL_CHOICE);
        record
            .put(field::ROLL_MODE, self.options.roll.name())
            .put(field::ROLL_FROM, rolls.map(|rolls| rolls[0]))
            .put(field::ROLL_TO, rolls.map(|rolls| rolls[1]))
            .put(field::PINS, self.pins().map(pinned).collect::<Datum>())
            .put(field::POSTURE, first.map(|configuration| configuration.to_string()))
            .put(field::REARRANGED, changes);
        record
    }

    /// The samples whose roll is pinned, each with its index and the roll, rad.
    pub fn pins(&self) -> impl Iterator<Item = (usize, &Station, f64)> {
        self.stations.iter().enumerate().filter_map(|(i, station)| Some((i, station, station.pinned?)))
    }

    /// How finely the place was looked for; absent where it was given.
    pub(super) fn search(&self) -> Option<Record> {
        self.search.map(|(resolution, _)| {
            let mut record = Record::of(&shape::PLACE_SEARCH);
            record
                .put(field::FINE_STEP, resolution.step)
                .put(field::SAMPLES_OF_SEARCH, resolution.samples)
                .put(field::BOXES, resolution.nodes);
            record
        })
    }

    pub(super) fn speeds(&self) -> Option<[f64; 6]> {
        match &self.robot.arm {
            Arm::SixAxis { limits, .. } => limits.speeds,
            Arm::Planar(_) => None,
        }
    }

    /// One row per sample.
    pub fn rows(&self) -> Rows<'_> {
        use ColumnKind::{Count, Number, Text, Truth};
        let numbers = |names: &[&'static str]| names.iter().map(|name| Column::new(*name, Number)).collect::<Vec<_>>();
        let mut columns = vec![Column::new("line", Count)];
        columns.extend(numbers(&["s_m", "x_mm", "y_mm", "z_mm", "i", "j", "k", "roll_deg"]));
        columns.push(Column::new("posture", Text));
        columns.extend(numbers(&["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"]));
        columns.extend(numbers(&["f_feed_n", "f_across_n", "f_axial_n", "moment_nm"]));
        columns.extend(numbers(&[
            "error_mm",
            "dx_mm",
            "dy_mm",
            "dz_mm",
            "along_mm",
            "across_mm",
            "axial_mm",
            "normal_mm",
        ]));
        columns.extend(numbers(&["share_1", "share_2", "share_3", "share_4", "share_5", "share_6"]));
        columns.extend(numbers(&["limit_margin_deg", "singular_margin_deg"]));
        columns.push(Column::new("pass", Truth));
        columns.push(Column::new("cutting", Truth));
        if self.clearance().is_some() {
            columns.extend([Column::new("clearance_mm", Number), Column::new("clearance_of", Text)]);
        }
        if self.compensation.is_some() || self.on_true_arm().is_some() {
            columns.extend(numbers(&[
                "q1_cmd_deg",
                "q2_cmd_deg",
                "q3_cmd_deg",
                "q4_cmd_deg",
                "q5_cmd_deg",
                "q6_cmd_deg",
            ]));
            columns.extend(numbers(&["x_cmd_mm", "y_cmd_mm", "z_cmd_mm"]));
        }
        columns.extend(self.chatter.iter().flat_map(|_| PathChatterAnswer::columns()));
        let samples = self.followed().map_or(&[][..], |found| &found.samples);
        Rows::made(columns, samples.len(), move |i| {
            let mut cells = self.cells(&self.stations[i], &samples[i]);
            cells.extend(self.clearance().into_iter().flat_map(|found| clearance_cells(found.at[i])));
            if let Some((joints, pose)) = self.sent(i) {
                cells.extend(joints.map(|q| Cell::Number(q.to_degrees() + 0.0)));
                cells.extend(pose.tip.iter().map(|x| Cell::Number(x * 1e3 + 0.0)));
            }
            cells.extend(self.chatter.iter().flat_map(|chatter| chatter.cells(i)));
            cells
        })
    }

    fn cells(&self, station: &Station, pushed: &Pushed) -> Vec<Cell> {
        let number = |x: f64| Cell::Number(x + 0.0);
        let all = |numbers: &[f64], factor: f64| numbers.iter().map(|x| number(x * factor)).collect::<Vec<_>>();
        let some = |numbers: Option<&[f64]>, count: usize, factor: f64| {
            numbers.map_or_else(|| vec![Cell::Absent; count], |numbers| all(numbers, factor))
        };
        let sample = &station.sample;
        let (force, moment) = match station.acting {
            Some(Acting::Known { force, moment }) => (Some(force), number(moment)),
            _ => (None, Cell::Absent),
        };
        // As the tip is given: in the axes of the part.
        let stand = self.placement.map(|placement| Stand {
            base_from_part: placement.base_from_part(),
            flange_from_tool: self.flange_from_tool,
        });
        let turn = stand.map(|stand| stand.base_from_part.rotation.inverse());
        let moved = pushed.moved.zip(turn).map(|(moved, turn)| <[f64; 3]>::from(turn * moved));
        let parts = stand.and_then(|stand| pushed.parts(&stand, sample));
        let normal = stand.and_then(|stand| pushed.normal(&stand, sample));
        let degrees = |x: f64| number(x.to_degrees());
        let mut cells = vec![Cell::Count(sample.line as i64), number(sample.way)];
        cells.extend(all(sample.pose.tip.as_slice(), 1e3));
        cells.extend(all(sample.pose.axis.as_slice(), 1.0));
        cells.push(degrees(pushed.arrangement.roll));
        cells.push(Cell::Text(pushed.arrangement.configuration.to_string()));
        cells.extend(pushed.joints.map(degrees));
        cells.extend(some(force.as_ref().map(|force| &force[..]), 3, 1.0));
        cells.push(moment);
        cells.push(number(pushed.error * 1e3));
        cells.extend(some(moved.as_ref().map(|moved| &moved[..]), 3, 1e3));
        cells.extend(some(parts.as_ref().map(|parts| &parts[..]), 3, 1e3));
        cells.push(normal.map_or(Cell::Absent, |normal| number(normal * 1e3)));
        cells.extend(some(pushed.shares.as_ref().map(|shares| &shares[..]), 6, 1.0));
        cells.extend([degrees(pushed.limit_margin), degrees(pushed.singular_margin)]);
        let passes = self.tolerance_mm.map(|tolerance| Verdict::of(pushed.error, tolerance).passes);
        cells.push(passes.map_or(Cell::Absent, Cell::Truth));
        cells.push(Cell::Truth(sample.is_cutting));
        cells
    }
}

fn clearance_cells(near: Option<Near>) -> [Cell; 2] {
    near.map_or([Cell::Absent, Cell::Absent], |near| {
        [Cell::Number(near.distance * 1e3 + 0.0), Cell::Text(bodies(near.link, near.to))]
    })
}

/// What becomes of the path as the cut changes with the displacement.
fn fed_back(found: &FedBack) -> Record {
    let mut record = Record::of(&shape::FED_BACK);
    record
        .put(field::PATH_WORST, Some(found.worst).filter(|_| found.unsettled == 0))
        .put(field::CONTRACTION, found.contraction)
        .put(field::UNSETTLED, found.unsettled);
    record
}

/// What is commanded along a path, or along all sections of one, and what is left.
pub(super) fn compensated<'a>(
    all: impl Iterator<Item = &'a Compensation> + Clone,
    spread: Option<Spread>,
    verdict: Option<Verdict>,
) -> Record {
    let largest = |of: fn(&Compensation) -> f64| all.clone().map(of).fold(0.0, f64::max);
    let by_tips = largest(|one| one.done.by_tips());
    let mut remaining = all.clone().filter_map(|one| one.remaining.as_ref());
    let mut record = Record::of(&shape::COMPENSATED_PATH);
    record
        .put(field::LARGEST_CORRECTION, largest(|one| one.done.largest))
        .put(field::LEFT_BY_JOINTS, largest(|one| one.done.by_joints))
        .put(field::LEFT_BY_TIPS, Some(by_tips).filter(|left| left.is_finite()))
        .put(field::LEFT_MEDIAN, spread.map(|spread| spread.median))
        .put(field::LEFT_P95, spread.map(|spread| spread.p95))
        .put(field::UNCERTAIN, remaining.next().map(|(_, who)| who))
        .put(field::VERDICT, verdict.map(Verdict::word))
        .put(field::PROBABILITY, verdict.and_then(|verdict| verdict.probability))
        .put(field::BEYOND_LIMITS, all.map(|one| one.done.beyond.len()).sum::<usize>());
    record
}

/// A pinned roll as an object.
fn pinned((sample, station, roll): (usize, &Station, f64)) -> Record {
    let mut record = Record::of(&shape::PINNED_ROLL);
    record.put(field::PINNED_SAMPLE, sample).put(field::PINNED_WAY, station.sample.way).put(field::PINNED_ROLL, roll);
    record
}
