//! What do measured points say of one arm?

use serde_json::{Value, json};

use super::verify::numbers;
use super::words::fixed;
use super::{Datum, Record, Rows, Table, Unit, field, line, shape, updated, with_schema};
use stiffarm::calibrate::{Calibrated, Level, LevelFit};
use stiffarm::calibration::zeros;
use stiffarm::catalogue::write;
use stiffarm::robot::{Arm, Robot};

/// Half of a 95 % interval of a normal, in standard deviations.
const HALF: f64 = 1.959_964;

/// The answer of `calibrate`.
#[derive(Clone, Debug)]
pub struct CalibrateAnswer {
    /// What was found.
    pub found: Calibrated,
    /// The robot as it was asked about.
    pub robot: Robot,
    /// The table.
    pub data: String,
    /// When it was measured, as year-month-day.
    pub date: String,
    /// The level was chosen by its evidence.
    pub is_chosen: bool,
}

impl CalibrateAnswer {
    /// As JSON.
    pub fn json(&self) -> Value {
        let found = &self.found;
        let errors = &found.errors;
        let weight = errors.weight.iter().zip(&found.deviations.weight);
        let intervals = weight.map(|(x, s)| json!([x - HALF * s, x + HALF * s])).collect::<Value>();
        let by_terms = found.drives.is_none();
        let wrong = found.wrong_rows.iter().map(|row| {
            let mut record = Record::of(&shape::WRONG_POINT);
            record
                .put(field::LINE, row.line)
                .put(field::WRONG_NUMBER, row.point)
                .put(field::DISTANCE_OFF, row.distance);
            record
        });
        let narrow = found.narrow.iter().map(|(joint, share)| {
            let mut record = Record::of(&shape::NARROW_JOINT);
            record.put(field::NARROW_NUMBER, *joint).put(field::NARROW_SHARE, *share);
            record
        });
        let at_work = found.at_work.as_ref().map(|work| {
            let mut record = Record::of(&shape::CALIBRATED_AT_WORK);
            record
                .put(field::EXPECTED_AT_WORK, work.expected)
                .put(field::WORK_INTERVAL, work.interval)
                .put(field::WORK_P95, work.p95)
                .put(field::WORK_POSTURES, work.postures);
            record
        });
        let mut answer = Record::of(&shape::CALIBRATION);
        answer
            .put(field::ROBOT, self.robot.name.as_str())
            .put(field::LEVEL, found.level.name())
            .put(field::OWN_WEIGHT, own_weight(found.taken()))
            .put(field::READ_ROWS, found.rows.len())
            .put(field::NOMINAL_RMS, found.levels[0].rms)
            .put(field::NOISE_FOUND, found.noise.reading)
            .put(field::POSTURE_NOISE_FOUND, found.noise.posture)
            .put(field::LEVELS, found.levels.iter().map(level).collect::<Datum>())
            .put(field::WRONG_ROWS, wrong.collect::<Datum>())
            .put(
                field::TRACKER_IN_BASE,
                found.tracker_in_base.iter().map(|pose| json!(numbers(pose))).collect::<Value>(),
            )
            .put(field::POINTS_SEEN, found.points.iter().map(|at| json!([at.x, at.y, at.z])).collect::<Value>())
            .put(field::ZERO_FOUND, self.zeros())
            .put(
                field::FRAMES_FOUND,
                self.frames().iter().map(|frame| json!(frame.map(|x| Unit::Millimetre.of_si(x)))).collect::<Value>(),
            )
            .put(field::WEIGHT_FOUND, by_terms.then(|| json!(errors.weight)))
            .put(field::WEIGHT_INTERVALS, by_terms.then_some(intervals))
            .put(field::DRIVES, found.drives.as_ref().map(updated::records))
            .put(field::GEARS_FOUND, json!(errors.gears))
            .put(field::NARROW, narrow.collect::<Datum>())
            .put(field::AT_WORK, at_work);
        with_schema("calibrate", super::ORIGIN, &answer)
    }

    fn zeros(&self) -> [f64; 6] {
        match &self.robot.arm {
            Arm::SixAxis { geometry, limits, .. } => zeros(geometry, limits.third_axis, &self.found.errors.frames),
            Arm::Planar(_) => [0.0; 6],
        }
    }

    /// Without the turns about the joints' own axes, which are the zeros.
    fn frames(&self) -> [[f64; 6]; 6] {
        let mut frames = self.found.errors.frames;
        frames.iter_mut().enumerate().for_each(|(i, frame)| frame[3 + stiffarm::calibration::JOINT_AXES[i]] = 0.0);
        frames
    }

    /// A row of each posture.
    pub fn rows(&self) -> Rows<'static> {
        let records = self.found.rows.iter().map(|row| {
            let mut record = Record::of(&shape::CALIBRATED_POSTURE);
            record.put(field::LINE, row.line).put(field::BEFORE, row.before).put(field::AFTER, row.after);
            record
        });
        Rows::of(&shape::CALIBRATED_POSTURE, records)
    }

    /// What was found, line by line.
    pub fn summary(&self) -> Table {
        let found = &self.found;
        let taken = found.taken();
        let mm = |m: f64| fixed(Unit::Millimetre.of_si(m), 3);
        let by = if self.is_chosen { "by evidence" } else { "as asked" };
        let mut lines = vec![
            line("robot", self.robot.full_name()),
            line(
                "points",
                format!(
                    "{} rows of {}, {} point{} each",
                    found.rows.len(),
                    self.data,
                    found.points.len(),
                    plural(found.points.len())
                ),
            ),
            line("level", format!("{}, {by}; the rows show {} parameters", name(taken), fixed(taken.shown, 1))),
            line("error", format!("{} mm rms as drawn, {} mm calibrated", mm(found.levels[0].rms), mm(taken.rms))),
        ];
        let reading = mm(found.noise.reading);
        lines.push(line(
            "noise",
            match found.noise.posture.map(mm) {
                Some(posture) => format!(
                    "{reading} mm (1 sigma) a coordinate of a reading, {posture} mm of where the arm stands at a posture; for `measure --geometry`: --sigma-mm {reading} --posture-sigma-mm {posture}"
                ),
                None => format!(
                    "{reading} mm (1 sigma) a coordinate, of readings and of how the arm repeats a posture: of single points nothing tells them apart"
                ),
            },
        ));
        let degrees = self.zeros().map(|zero| fixed(Unit::Degree.of_si(zero), 4)).join(", ");
        lines.push(line(
            "zeros",
            format!(
                "{degrees} deg to be added to the joints as reported; those of joints 1 and 6 are not seen: the frame of the tracker and the places of the points take them up, so the tool counts from the flange frame in which these points are"
            ),
        ));
        lines.push(line(
            "at the work",
            match &found.at_work {
                Some(work) => format!(
                    "{} mm rms expected as measured there, {} to {} with 95 %; 95th percentile {}; over {} postures, where the tracker finds the work",
                    mm(work.expected),
                    mm(work.interval[0]),
                    mm(work.interval[1]),
                    mm(work.p95),
                    work.postures
                ),
                None => "the arm does not reach it".into(),
            },
        ));
        Table::of_lines(lines).led_by(["error", "at the work"], "how far the points are from where they should be", &[])
    }

    /// What every level leaves.
    pub fn table(&self) -> Table {
        let mut table = Table::new([
            "level",
            "rms [mm]",
            "median [mm]",
            "95 % [mm]",
            "largest [mm]",
            "left out rms [mm]",
            "shown",
            "log evidence",
        ]);
        for fit in &self.found.levels {
            let mm = |m: f64| fixed(Unit::Millimetre.of_si(m), 3);
            table.row([
                name(fit),
                mm(fit.rms),
                mm(fit.median),
                mm(fit.p95),
                mm(fit.largest),
                fit.left_out.map_or_else(|| "-".into(), mm),
                fixed(fit.shown, 1),
                fixed(fit.evidence, 1),
            ]);
        }
        table
    }

    /// What the own weight tells of each drive; `None` where it has terms.
    pub fn drives(&self) -> Option<Table> {
        self.found.drives.as_ref().map(updated::table)
    }

    /// The points that were left out; `None` where there are none.
    pub fn wrong_table(&self) -> Option<Table> {
        if self.found.wrong_rows.is_empty() {
            return None;
        }
        let mut table = Table::new(["line", "point", "off mm"]);
        for row in &self.found.wrong_rows {
            let which = if row.point == 0 { "all".into() } else { row.point.to_string() };
            table.row([row.line.to_string(), which, fixed(Unit::Millimetre.of_si(row.distance), 2)]);
        }
        Some(table)
    }

    /// What must be looked at.
    pub fn notes(&self) -> String {
        let wrong = self.found.wrong_rows.iter().map(|row| {
            let which = if row.point == 0 { "all points".into() } else { format!("point {}", row.point) };
            let distance = fixed(Unit::Millimetre.of_si(row.distance), 2);
            format!("Line {}: {which} {distance} mm off, left out.\n", row.line)
        });
        let moved = self.moved().map(|moved| format!("{moved}\n"));
        wrong.chain(moved).collect::<String>() + &self.rests()
    }

    /// What all of it rests on.
    pub(super) fn rests(&self) -> String {
        let found = &self.found;
        let mut notes: Vec<String> = Vec::new();
        if !found.narrow.is_empty() {
            let each = found.narrow.iter().map(|(joint, share)| format!("{joint} ({} %)", fixed(100.0 * share, 0)));
            notes.push(format!(
                "Joints that moved over less than a third of their range: {}. Elsewhere little is known of them: the interval at the work says how little.\n",
                each.collect::<Vec<_>>().join(", ")
            ));
        }
        notes.push("Left out: each third of each joint's range, predicted by the other rows. Own weight is that of a base on a floor.\n".into());
        notes.extend(self.on_weight().map(str::to_owned));
        notes.push(
            "The angles and positions of this table must be as the controller moves without a calibration of its own; with one in force it corrects twice.\n".into(),
        );
        notes.concat()
    }

    /// That the instrument seems to have moved, and what to do.
    pub fn moved(&self) -> Option<String> {
        let (line, far) = self.found.moved?;
        let far = fixed(Unit::Millimetre.of_si(far), 2);
        Some(format!(
            "From line {line} on all points stand {far} mm elsewhere, as if the tracker or the base had moved: a column that tells its stands apart, named by frame-by, gives each a frame of its own; else measure again."
        ))
    }

    /// What the own weight rests on.
    fn on_weight(&self) -> Option<&'static str> {
        let found = &self.found;
        if found.drives.is_some() {
            return Some(
                "Own weight by the masses of the robot file: what the flange holds counts where the file has it as a mass of link 6, and a counterbalance that the file does not have makes drive 2 look stiffer than it is. The robot file keeps its [compliance]; --drive-urad-per-nm takes what is reported here.\n",
            );
        }
        (found.has_masses && Level::Weight <= found.level).then_some(
            "The masses of the robot file explain the own weight less well than terms do: does it miss a counterbalance, or what the flange held?\n",
        )
    }

    /// The calibrated robot's file.
    pub fn robot_file(&self) -> String {
        write(&self.found.written(&self.robot, &self.date, &self.data))
    }
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

/// Of a level, with how its own weight is computed.
fn name(fit: &LevelFit) -> String {
    let level = fit.level.map_or("as drawn", Level::name);
    if fit.by_masses { format!("{level}, by masses") } else { level.into() }
}

/// How the own weight is computed, where it is.
fn own_weight(fit: &LevelFit) -> Option<&'static str> {
    let weighs = fit.level.is_some_and(|level| Level::Weight <= level);
    weighs.then_some(if fit.by_masses { "masses" } else { "terms" })
}

fn level(fit: &LevelFit) -> Record {
    let mut record = Record::of(&shape::LEVEL_FIT);
    record
        .put(field::LEVEL, fit.level.map_or("as drawn", Level::name))
        .put(field::OWN_WEIGHT, own_weight(fit))
        .put(field::OFF, fit.rms)
        .put(field::MEDIAN_OFF, fit.median)
        .put(field::P95_OFF, fit.p95)
        .put(field::LARGEST_OFF, fit.largest)
        .put(field::LEFT_OUT_RMS, fit.left_out)
        .put(field::SHOWN, fit.shown)
        .put(field::EVIDENCE, fit.evidence);
    record
}
