//! What do readings of a pendant say of a robot file?

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::robot::rounded;
use super::words::fixed;
use super::{Datum, Record, Rows, Table, Unit, field, line, shape, with_schema};
use stiffarm::catalogue::write;
use stiffarm::limits::ThirdAxis;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;
use stiffarm::verify::{Convention, Fit, Verification};

/// The answer of `robots verify`.
#[derive(Clone, Debug)]
pub struct VerifyAnswer {
    /// What was found.
    pub found: Verification,
    /// The table.
    pub data: String,
    /// When it was read, as year-month-day.
    pub date: String,
}

/// The answer of `robots verify --any`: which robot readings are from.
#[derive(Clone, Debug)]
pub struct VerifyRankAnswer {
    /// The best first.
    pub fits: Vec<(Robot, Fit)>,
    /// The table.
    pub data: String,
    /// How many postures were read.
    pub rows: usize,
}

/// So many robots are shown.
const MOST_SHOWN: usize = 10;

impl VerifyAnswer {
    /// As JSON.
    pub fn json(&self) -> Value {
        let Verification {
            robot,
            as_file,
            fits,
            alike,
            zeros_not_seen,
            postures,
            wrong_row,
            rows,
            read: _,
            is_measured,
            verified,
        } = &self.found;
        let degrees = |q: &[f64; 6]| q.map(|angle| rounded(Unit::Degree.of_si(angle)));
        let mut answer = Record::of(&shape::VERIFICATION);
        answer
            .put(field::ROBOT, robot.name.as_str())
            .put(field::VERIFIED, *verified)
            .put(field::READ_ROWS, *rows)
            .put(field::MEASURED_POINTS, *is_measured)
            .put(field::LARGEST_OFF, as_file.largest)
            .put(field::OFF, as_file.rms)
            .put(field::LARGEST_TURN, as_file.largest_turn)
            .put(field::BASE_SEEN, bases(as_file))
            .put(field::POINTS_SEEN, points(as_file))
            .put(field::FITS, fits.iter().map(record).collect::<Datum>())
            .put(field::ALIKE, json!(alike))
            .put(field::ZEROS_NOT_SEEN, json!(zeros_not_seen))
            .put(field::POSTURES_TO_READ, postures.iter().map(|q| json!(degrees(q))).collect::<Value>())
            .put(field::WRONG_ROW, wrong_row.map(wrong_reading));
        with_schema("robots verify", "the frame of the readings", &answer)
    }

    /// A row of each fit.
    pub fn rows(&self) -> Rows<'static> {
        rows(&self.found.fits)
    }

    /// What was found, line by line.
    pub fn summary(&self) -> Table {
        let Verification { robot, as_file, rows, is_measured, verified, fits, wrong_row, .. } = &self.found;
        let verdict = match (verified, as_file.agrees()) {
            (true, _) => format!("verified: the file counts the joints as they were read{}", self.not_seen()),
            (false, true) => "agrees, NOT verified: other ways of counting the joints fit as well".into(),
            (false, false) if wrong_row.is_some() => "NOT verified: one row is off".into(),
            (false, false) if fits.iter().any(|(_, fit)| fit.agrees()) => {
                "NOT verified: the file does not fit, but another way of counting does".into()
            }
            (false, false) => "NOT verified: no way of counting the joints fits".into(),
        };
        let kind = if *is_measured { "measured postures" } else { "postures read from the pendant" };
        let mut lines = vec![
            line("robot", robot.full_name()),
            line("readings", format!("{rows} {kind}, {}", self.data)),
            line("verdict", verdict),
            line("off", off(as_file)),
        ];
        for (i, base) in as_file.bases.iter().enumerate().filter(|_| as_file.agrees()) {
            let which = if as_file.bases.len() == 1 { String::new() } else { format!(" {}", i + 1) };
            lines.push(line(format!("base{which}"), format!("in the frame of the readings at {}", placed(base))));
        }
        if as_file.agrees() {
            let at = match &as_file.tool {
                Some(tool) => placed(tool),
                None => as_file.points.iter().map(three).collect::<Vec<_>>().join("; ") + " mm",
            };
            lines.push(line("tool", format!("in the flange frame at {at}")));
        }
        Table::of_lines(lines).led_by(
            ["verdict", "readings"],
            "whether the file counts the joints as they were read",
            &[],
        )
    }

    /// Which zeros a fitted base or tool takes up.
    fn not_seen(&self) -> String {
        let joints: Vec<String> = self.found.zeros_not_seen.iter().map(usize::to_string).collect();
        match joints.as_slice() {
            [] => String::new(),
            [one] => format!("; the zero of joint {one} was not looked at"),
            several => format!("; the zeros of joints {} were not looked at", several.join(" and ")),
        }
    }

    /// The ways of counting that fit best; none where the file does.
    pub fn table(&self) -> Option<Table> {
        (!self.found.as_file.agrees() && self.found.wrong_row.is_none()).then(|| table(&self.found.fits))
    }

    /// What follows from it.
    pub fn notes(&self) -> String {
        let Verification { as_file, fits, alike, zeros_not_seen, postures, wrong_row, .. } = &self.found;
        let mut notes = Vec::new();
        if let Some((line, off)) = wrong_row {
            let off = fixed(Unit::Millimetre.of_si(*off), 2);
            notes.push(format!("Line {line} is off by {off} mm, and all other rows agree with the file: look at that row, and read it again.\n"));
        } else if !as_file.agrees() {
            notes.push(what_fits(fits.first(), as_file));
        }
        if !alike.is_empty() {
            notes.push(format!("These readings do not tell apart: {}.\n", alike.join(", ")));
        }
        if as_file.agrees() && !zeros_not_seen.is_empty() {
            notes.push("Zeros not looked at: --base-mm shows that of joint 1, --tool-mm beside readings of the orientation that of joint 6.\n".into());
        }
        if !postures.is_empty() {
            notes.push("Postures that would, if the cell lets the robot go there:\n".into());
        }
        notes.extend(postures.iter().map(|q| {
            let angles = q.map(|angle| fixed(Unit::Degree.of_si(angle), 0)).join(", ");
            format!("  joints at {angles} deg\n")
        }));
        notes.concat()
    }

    /// The robot that counts as the readings do; and what must be looked at in it.
    pub fn robot_file(&self) -> Option<(String, Vec<String>)> {
        let (robot, remarks) = self.found.robot_file(&self.date)?;
        Some((write(&robot), remarks))
    }
}

impl VerifyRankAnswer {
    /// As JSON.
    pub fn json(&self) -> Value {
        let mut answer = Record::of(&shape::FITTING_ROBOTS);
        answer
            .put(field::VERIFIED, false)
            .put(field::READ_ROWS, self.rows)
            .put(field::FITS, self.fits.iter().map(record).collect::<Datum>());
        with_schema("robots verify", "the frame of the readings", &answer)
    }

    /// A row of each robot.
    pub fn rows(&self) -> Rows<'static> {
        rows(&self.fits)
    }

    /// The best of them.
    pub fn table(&self) -> Table {
        table(&self.fits[..self.fits.len().min(MOST_SHOWN)])
    }

    /// Which it is.
    pub fn notes(&self) -> String {
        let agree = self.fits.iter().filter(|(_, fit)| fit.agrees());
        let names: Vec<String> = agree.map(|(robot, _)| robot.full_name()).collect();
        let (rows, data) = (self.rows, &self.data);
        match names.as_slice() {
            [] => "No robot fits as it counts its joints; `stiffarm robots verify ROBOT ..` tries other ways of counting.\n".into(),
            [one] => {
                format!("{rows} rows of {data} are from {one}; `stiffarm robots verify \"{}\" ..` verifies it.\n", self.fits[0].0.name)
            }
            several => format!(
                "{rows} rows of {data} fit {} robots alike: {}. The name plate tells which it is; `stiffarm robots verify ROBOT ..` verifies it.\n",
                several.len(),
                several.join(", ")
            ),
        }
    }
}

/// What to do where a file does not agree.
fn what_fits(best: Option<&(Robot, Fit)>, as_file: &Fit) -> String {
    /// m: what two decimals of a degree round away is no other way of counting.
    const NEAR: f64 = 1e-3;
    match best.filter(|(_, fit)| fit.agrees()) {
        Some((robot, fit)) if fit.convention.carried != [0.0; 3] => {
            format!("The readings fit {} where {}; a robot file cannot say that.\n", robot.full_name(), said(robot, fit))
        }
        Some((robot, fit)) => {
            format!("The readings fit {} where {}; -o mine.toml writes that.\n", robot.full_name(), said(robot, fit))
        }
        None if as_file.largest < NEAR => {
            "Nothing fits better, and the file is near: a pendant that shows two decimals of a degree rounds by as much. Drive to whole degrees and \
             read again.\n"
                .into()
        }
        None => "No way of counting the joints fits. Is it this robot? --any tries all; is a row typed wrong, or was the tool or the base changed between \
                 rows?\n"
            .into(),
    }
}

fn rows(fits: &[(Robot, Fit)]) -> Rows<'static> {
    Rows::of(&shape::WAY_OF_COUNTING, fits.iter().map(record))
}

fn wrong_reading((line, off): (usize, f64)) -> Record {
    let mut record = Record::of(&shape::WRONG_READING);
    record.put(field::LINE, line).put(field::DISTANCE_OFF, off);
    record
}

fn record((robot, fit): &(Robot, Fit)) -> Record {
    let Convention { third_axis, sign, offset, carried } = fit.convention;
    let third_axis = match third_axis {
        ThirdAxis::Elbow => "elbow",
        ThirdAxis::Forearm => "forearm",
    };
    let differences = differences(robot, fit);
    let mut record = Record::of(&shape::WAY_OF_COUNTING);
    record
        .put(field::ROBOT, robot.name.as_str())
        .put(field::VENDOR, robot.vendor.as_str())
        .put(field::THIRD_AXIS, third_axis)
        .put(field::SIGN, sign)
        .put(field::ZERO, offset)
        .put(field::CARRIED, carried)
        .put(field::OFF, fit.rms)
        .put(field::LARGEST_OFF, fit.largest)
        .put(field::LARGEST_TURN, fit.largest_turn)
        .put(field::DIFFERS, differences.join("; "))
        .put(field::DIFFERENCES, json!(differences));
    record
}

fn table(fits: &[(Robot, Fit)]) -> Table {
    let mut table = Table::new(["robot", "rms mm", "largest mm", "where"]);
    for (robot, fit) in fits {
        let [rms, largest] = [fit.rms, fit.largest].map(|off| fixed(Unit::Millimetre.of_si(off), 3));
        table.row([robot.full_name(), rms, largest, said(robot, fit)]);
    }
    table.with_broken_lines()
}

/// In what it differs from the robot's own file.
fn differences(robot: &Robot, fit: &Fit) -> Vec<String> {
    match &robot.arm {
        Arm::SixAxis { geometry, limits, .. } => fit.convention.differences(&Convention::of(geometry, limits)),
        Arm::Planar(_) => Vec::new(),
    }
}

fn said(robot: &Robot, fit: &Fit) -> String {
    let differences = differences(robot, fit);
    if differences.is_empty() { "the joints count as in its file".into() } else { differences.join(", ") }
}

fn off(fit: &Fit) -> String {
    let [rms, largest] = [fit.rms, fit.largest].map(|off| fixed(Unit::Millimetre.of_si(off), 3));
    let turn =
        fit.largest_turn.map_or_else(String::new, |turn| format!(", {} deg", fixed(Unit::Degree.of_si(turn), 3)));
    format!("{rms} mm rms; largest {largest} mm{turn}")
}

pub(super) fn numbers(pose: &Pose) -> [f64; 6] {
    let (rx, ry, rz) = pose.rotation.euler_angles();
    let [x, y, z] = [pose.translation.x, pose.translation.y, pose.translation.z].map(|m| Unit::Millimetre.of_si(m));
    let [rx, ry, rz] = [rx, ry, rz].map(|angle| Unit::Degree.of_si(angle));
    [x, y, z, rx, ry, rz]
}

fn bases(fit: &Fit) -> Value {
    fit.bases.iter().map(|base| json!(numbers(base))).collect()
}

fn points(fit: &Fit) -> Value {
    fit.points.iter().map(|point| json!(<[f64; 3]>::from(*point))).collect()
}

fn three(point: &Vector3<f64>) -> String {
    [point.x, point.y, point.z].map(|m| fixed(Unit::Millimetre.of_si(m), 2)).join(", ")
}

fn placed(pose: &Pose) -> String {
    let [x, y, z, rx, ry, rz] = numbers(pose);
    let mm = [x, y, z].map(|mm| fixed(mm, 2)).join(", ");
    let degrees = [rx, ry, rz].map(|angle| fixed(angle, 3)).join(", ");
    format!("{mm} mm, turned by {degrees} deg about fixed x, y, z")
}
