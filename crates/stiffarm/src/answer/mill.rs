//! What is told of a path that is milled: the error along it, how the tool is turned, where the part stands.

use serde_json::Value;

use super::place::Verdict;
use super::stiffness::stiffness;
use super::words::{degrees, percentages, robot as named, tool};
use super::{Cell, Column, ColumnKind, Line, Record, Rows, Table, field, fixed, line, with_schema};
use crate::catalogue::ProcessFile;
use crate::cutting::{Law, Process};
use crate::mill::{
    Acting, Blocked, ErrorPart, Followed, ForcedError, Forcing, MillError, MillOptions, Milled, PartPlacement,
    PathPlaced, PathResolution, Pushed, RollMap, RollMode, Stand, Station, forced, mill, place_path, roll_map,
};
use crate::request::{Refusal, Request};
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::stock::{Stock, StockError};
use crate::toolpath::Move;
use crate::watch::Watch;

/// The answer of `mill`, with what was asked.
#[derive(Clone, Debug)]
pub struct MillAnswer {
    /// Which robot.
    pub robot: Robot,
    /// The path as it was asked for.
    pub path: String,
    /// Where the force comes from, in words.
    pub force: String,
    /// The tool in the flange frame.
    pub flange_from_tool: Pose,
    /// What else was asked.
    pub options: MillOptions,
    /// The path, cut and under its forces.
    pub stations: Vec<Station>,
    /// Where the part stands; `None` where no place was found.
    pub placement: Option<PartPlacement>,
    /// How finely that was looked for, and what no other place beats, m; `None` where it was given.
    pub sought: Option<(PathResolution, f64)>,
    /// What was found; `None` where there is no place at all.
    pub milled: Option<Milled>,
    /// The largest error that passes, mm.
    pub tolerance_mm: Option<f64>,
    /// What is to be said of path and forces.
    pub remarks: Vec<String>,
}

/// A path that has no answer.
#[derive(Debug, thiserror::Error)]
pub enum MillAnswerError {
    /// What is asked makes no sense.
    #[error(transparent)]
    Request(#[from] Refusal),
    /// Of a stock nothing can be told.
    #[error("stock: {0}")]
    Stock(#[from] StockError),
    /// Of a process no force is known.
    #[error(transparent)]
    Force(#[from] ForcedError),
    /// The robot cannot be judged, or was not waited for.
    #[error("{robot}: {error}")]
    Mill {
        /// Which.
        robot: String,
        /// Why.
        error: MillError,
    },
}

/// Cells of a stock in the radius of a mill.
const CELLS_IN_A_RADIUS: f64 = 40.0;

impl MillAnswer {
    /// What a request asks of a robot, a path and its moves, and a process (with the name of its file) where there is one.
    ///
    /// # Errors
    /// What makes no sense together; what nobody waited for.
    pub fn of(
        asked: &Request,
        robot: &Robot,
        (path, moves): (String, &[Move]),
        process: Option<(String, ProcessFile)>,
        watch: Watch,
    ) -> Result<Self, MillAnswerError> {
        let robot = asked.equipped(robot.clone())?;
        let (options, flange_from_tool) = (asked.mill_options(), asked.held().tool());
        let (forcing, force, mut remarks) = forcing(asked, process)?;
        let mut stock = match (asked.stock()?, &forcing) {
            (Some([low, high]), Forcing::Process(Process { law: Law::Milling(milling), .. })) => {
                Some(Stock::block(low, high, milling.diameter / 2.0 / CELLS_IN_A_RADIUS)?)
            }
            (Some(_), _) => return Err(ForcedError::NoMill.into()),
            (None, _) => None,
        };
        let forced = forced(moves, &asked.steps(), &forcing, stock.as_mut())?;
        remarks.extend(forced.remarks);
        let stations = forced.stations;
        let failed = |error| MillAnswerError::Mill { robot: robot.name.clone(), error };
        let (placement, sought, milled) = match asked.at() {
            Some(placement) => {
                let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool };
                let milled = mill(&robot, &stand, &stations, &options, watch).map_err(failed)?;
                (Some(placement), None, Some(milled))
            }
            None => {
                let (within, margins) = asked.path_window()?;
                let placed = place_path(&robot, &flange_from_tool, &stations, (&options, &margins, within), watch);
                match placed.map_err(failed)? {
                    Ok(PathPlaced { placement, milled, lower_bound, resolution }) => {
                        (Some(placement), Some((resolution, lower_bound)), Some(milled))
                    }
                    Err(blocked) => (None, None, blocked.map(Milled::Blocked)),
                }
            }
        };
        let tolerance_mm = asked.tolerance_mm();
        Ok(Self {
            robot,
            path,
            force,
            flange_from_tool,
            options,
            stations,
            placement,
            sought,
            milled,
            tolerance_mm,
            remarks,
        })
    }

    /// The path as it is followed, where it is.
    pub fn followed(&self) -> Option<&Followed> {
        match &self.milled {
            Some(Milled::Followed(found)) => Some(found),
            _ => None,
        }
    }

    /// What every other roll would have done at so many places along the path; `None` where it is not followed.
    ///
    /// # Errors
    /// As [`mill`].
    pub fn roll_map(&self, places: usize) -> Result<Option<RollMap>, MillAnswerError> {
        let Some((placement, found)) = self.placement.zip(self.followed()) else { return Ok(None) };
        let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool: self.flange_from_tool };
        let map = roll_map(&self.robot, &stand, &self.stations, &self.options, (found, places));
        map.map(Some).map_err(|error| MillAnswerError::Mill { robot: self.robot.name.clone(), error })
    }

    fn blocked(&self) -> Option<&Blocked> {
        match &self.milled {
            Some(Milled::Blocked(blocked)) => Some(blocked),
            _ => None,
        }
    }

    /// Why there is no answer, where there is none.
    pub fn reason(&self) -> Option<String> {
        match (self.followed(), self.blocked()) {
            (Some(_), _) => None,
            (None, Some(blocked)) if self.sought.is_some() || self.placement.is_none() => {
                Some(format!("no place was found at which the path is followed; at the best one tried: {blocked}"))
            }
            (None, Some(blocked)) => Some(blocked.to_string()),
            (None, None) => Some("no place was found at which even the outermost samples are held: the window, the margins or the reach leave none".into()),
        }
    }

    /// What no path of rolls beats, and where the place was sought, no place; m.
    pub fn lower_bound(&self) -> Option<f64> {
        let found = self.followed()?;
        Some(self.sought.map_or(found.lower_bound, |(_, of_all)| of_all.min(found.lower_bound)))
    }

    /// Every field but those of single samples.
    pub fn record(&self) -> Record {
        let (robot, options) = (&self.robot, &self.options);
        let found = self.followed();
        let verdict = self.tolerance_mm.zip(found).map(|(tolerance, found)| Verdict::of(found.worst.0, tolerance));
        let worst = found.map(|found| (&self.stations[found.worst.1], &found.samples[found.worst.1]));
        let mut record = Record::new();
        record
            .put(field::ROBOT, &robot.name)
            .put(field::STIFFNESS_SOURCE, stiffness(robot))
            .put(field::PATH, &self.path)
            .put(field::CUTTING_FORCE, &self.force)
            .put(field::PART, self.part())
            .put(field::ROLL_CHOICE, self.roll())
            .put(field::ERROR_PART, options.part.name())
            .put(field::ASKED_LIMIT_MARGIN, options.limit_margin)
            .put(field::ASKED_SINGULAR_MARGIN, options.singular_margin)
            .put(field::SPEED_SHARE, self.speeds().map(|_| options.share_of_speed))
            .put(field::AT, self.placement.map(|placement| placement.at))
            .put(field::AT_YAW, self.placement.map(|placement| placement.yaw))
            .put(field::FEASIBLE, found.is_some())
            .put(field::REASON, self.reason())
            .put(field::PATH_WORST, found.map(|found| found.worst.0))
            .put(field::PATH_LOWER_BOUND, self.lower_bound())
            .put(field::ROLL_LOWER_BOUND, found.map(|found| found.lower_bound))
            .put(field::RMS, found.map(|found| found.rms))
            .put(field::WORST_SAMPLE, found.map(|found| found.worst.1))
            .put(field::WORST_LINE, worst.map(|(station, _)| station.sample.line))
            .put(field::WORST_JOINTS, worst.map(|(_, pushed)| pushed.joints))
            .put(field::WORST_SHARES, worst.and_then(|(_, pushed)| pushed.shares))
            .put(field::LIMIT_MARGIN, found.map(|found| least(found, |pushed| pushed.limit_margin)))
            .put(field::SINGULAR_MARGIN, found.map(|found| least(found, |pushed| pushed.singular_margin)))
            .put(field::TOLERANCE, self.tolerance_mm)
            .put(field::PASS, verdict.map(|verdict| verdict.passes))
            .put(field::MARGIN, verdict.map(|verdict| verdict.margin_mm))
            .put(field::SEARCH, self.search())
            .put(field::REMARKS, serde_json::json!(self.remarks));
        record
    }

    /// How long the path is, and how long it takes.
    fn part(&self) -> Record {
        let cutting = self.stations.windows(2).filter(|pair| pair[1].sample.is_cutting && pair[0].sample.is_cutting);
        let way = |station: Option<&Station>| station.map_or(0.0, |station| station.sample.way);
        let feeding = self.stations.iter().filter(|station| station.sample.is_cutting && !station.is_fresh);
        let mut record = Record::new();
        record
            .put(field::SAMPLES_OF_PATH, self.stations.len())
            .put(field::PATH_LENGTH, way(self.stations.last()) - way(self.stations.first()))
            .put(field::CUTTING_LENGTH, cutting.map(|pair| pair[1].sample.way - pair[0].sample.way).sum::<f64>())
            .put(field::TIME, feeding.map(|station| station.time).sum::<Option<f64>>());
        record
    }

    /// How the tool is turned about its axis.
    fn roll(&self) -> Record {
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
        let mut record = Record::new();
        record
            .put(field::ROLL_MODE, self.options.roll.name())
            .put(field::ROLL_FROM, rolls.map(|rolls| rolls[0]))
            .put(field::ROLL_TO, rolls.map(|rolls| rolls[1]))
            .put(field::POSTURE, first.map(|configuration| configuration.to_string()))
            .put(field::REARRANGED, changes);
        record
    }

    /// How finely the place was looked for; absent where it was given.
    fn search(&self) -> Option<Record> {
        self.sought.map(|(resolution, _)| {
            let mut record = Record::new();
            record
                .put(field::FINE_STEP, resolution.step)
                .put(field::SAMPLES_OF_SEARCH, resolution.samples)
                .put(field::BOXES, resolution.nodes);
            record
        })
    }

    fn speeds(&self) -> Option<[f64; 6]> {
        match &self.robot.arm {
            crate::robot::Arm::SixAxis { limits, .. } => limits.speeds,
            crate::robot::Arm::Planar(_) => None,
        }
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("mill", super::ORIGIN, &self.record())
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
        columns.extend(numbers(&["error_mm", "dx_mm", "dy_mm", "dz_mm", "along_mm", "across_mm", "axial_mm"]));
        columns.extend(numbers(&["share_1", "share_2", "share_3", "share_4", "share_5", "share_6"]));
        columns.extend(numbers(&["limit_margin_deg", "singular_margin_deg"]));
        columns.push(Column::new("pass", Truth));
        columns.push(Column::new("cutting", Truth));
        let samples = self.followed().map_or(&[][..], |found| &found.samples);
        Rows::made(columns, samples.len(), move |i| self.cells(&self.stations[i], &samples[i]))
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
        let moved = pushed.moved.map(<[f64; 3]>::from);
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
        cells.extend(some(pushed.parts.as_ref().map(|parts| &parts[..]), 3, 1e3));
        cells.extend(some(pushed.shares.as_ref().map(|shares| &shares[..]), 6, 1.0));
        cells.extend([degrees(pushed.limit_margin), degrees(pushed.singular_margin)]);
        let passes = self.tolerance_mm.map(|tolerance| Verdict::of(pushed.error, tolerance).passes);
        cells.push(passes.map_or(Cell::Absent, Cell::Truth));
        cells.push(Cell::Truth(sample.is_cutting));
        cells
    }

    /// For people.
    pub fn table(&self) -> Table {
        let mut lines: Vec<Line> = vec![
            line("robot", named(&self.robot)),
            line("stiffness", stiffness(&self.robot)),
            line("tool", tool(&self.flange_from_tool)),
            line("path", self.length()),
            line("force on the tool", &self.force),
            line("what counts", counted(self.options.part)),
        ];
        lines.push(line("keeps", self.kept()));
        lines.extend(self.place_lines());
        match self.followed() {
            None => lines.extend(self.reason().map(|reason| line("not followed", reason))),
            Some(found) => lines.extend(self.lines(found)),
        }
        lines.extend(self.remarks.iter().map(|remark| line("note", remark)));
        Table::of_lines(lines)
    }

    fn length(&self) -> String {
        let part = self.part();
        let json = part.json();
        let number = |key: &str| json[key].as_f64();
        let metres = |key: &str| number(key).map_or_else(String::new, |x| format!("{} m", fixed(x, 3)));
        let time = number("time_s")
            .map_or("time not known: no feed rate".into(), |time| format!("{} s of feeding", fixed(time, 1)));
        format!(
            "{}: {} long, {} of it cutting, {time}, {} samples",
            self.path,
            metres("length_m"),
            metres("cutting_length_m"),
            self.stations.len()
        )
    }

    fn kept(&self) -> String {
        let MillOptions { limit_margin, singular_margin, share_of_speed, .. } = self.options;
        let speeds = if self.speeds().is_some() {
            format!("{} % of the joints' speeds while cutting", fixed(100.0 * share_of_speed, 0))
        } else {
            "no test of the joints' speeds: the robot file tells none".into()
        };
        format!(
            "{} from joint limits, {} from straight postures; {speeds}",
            degrees(limit_margin),
            degrees(singular_margin)
        )
    }

    fn place_lines(&self) -> Vec<Line> {
        let Some(PartPlacement { at: [x, y, z], yaw }) = self.placement else { return Vec::new() };
        let name = if self.sought.is_some() { "best place of its origin" } else { "its origin stands at" };
        let told = format!(
            "x {} m, y {} m, z {} m from the base, turned by {}",
            fixed(x, 4),
            fixed(y, 4),
            fixed(z, 4),
            degrees(yaw)
        );
        vec![line(name, told)]
    }

    fn lines(&self, found: &Followed) -> Vec<Line> {
        let (station, pushed) = (&self.stations[found.worst.1], &found.samples[found.worst.1]);
        let mm = |metres: f64| format!("{} mm", fixed(metres * 1e3, 4));
        let at = if station.sample.line == 0 { String::new() } else { format!(", line {}", station.sample.line) };
        let mut lines = vec![
            line(
                "largest error",
                format!("{} at {} mm of the way{at}", mm(found.worst.0), fixed(station.sample.way * 1e3, 1)),
            ),
            line("root mean square", mm(found.rms)),
        ];
        let gap = |lower: f64| if 0.0 < found.worst.0 { 100.0 * (1.0 - lower / found.worst.0) } else { 0.0 };
        let proved = |lower: f64| format!("{} (gap {} %)", mm(lower), fixed(gap(lower), 2));
        lines.push(line("no rolls have less than", proved(found.lower_bound)));
        if let Some((resolution, lower)) = self.sought {
            lines.push(line(
                "no place has less than",
                format!("{}, by {} boxes of places", proved(lower), resolution.nodes),
            ));
        }
        let json = self.roll().json();
        let angle = |key: &str| json[key].as_f64().map_or_else(String::new, |angle| format!("{} deg", fixed(angle, 1)));
        let turned = match self.options.roll {
            RollMode::Free | RollMode::Linear => {
                format!("{}, {} to {}", self.options.roll.name(), angle("from_deg"), angle("to_deg"))
            }
            RollMode::Constant | RollMode::Fixed(_) => format!("{}, {}", self.options.roll.name(), angle("from_deg")),
        };
        lines.push(line("roll", format!("{turned}, of the tool's x axis from the part's")));
        let again = json["rearranged"].as_u64().unwrap_or(0);
        let how = if again == 0 {
            "all along".into()
        } else {
            format!("at first; arranged anew {again} times, clear of the work")
        };
        lines.push(line("posture", format!("{} {how}", found.samples[0].arrangement.configuration)));
        lines.extend(pushed.shares.as_ref().map(|shares| line("share of drives 1-6 there", percentages(shares))));
        let margins =
            [least(found, |pushed| pushed.limit_margin), least(found, |pushed| pushed.singular_margin)].map(degrees);
        lines.push(line(
            "smallest margins",
            format!("{} to a joint limit, {} to a straight posture", margins[0], margins[1]),
        ));
        if let Some(tolerance) = self.tolerance_mm {
            let verdict = Verdict::of(found.worst.0, tolerance);
            let margin = fixed(verdict.margin_mm, 4);
            lines.push(line("tolerance", format!("{tolerance} mm: {}, margin {margin} mm", verdict.word())));
            if !verdict.passes && 0 < station.sample.line {
                let over =
                    self.stations.iter().zip(&found.samples).filter(|(_, pushed)| tolerance < pushed.error * 1e3);
                let lines_over: std::collections::BTreeSet<usize> =
                    over.map(|(station, _)| station.sample.line).collect();
                let told: Vec<String> = lines_over.iter().take(8).map(ToString::to_string).collect();
                let more =
                    if 8 < lines_over.len() { format!(" and {} more", lines_over.len() - 8) } else { String::new() };
                lines.push(line("lines over it", format!("{}{more}", told.join(", "))));
            }
        }
        lines
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let force = if self.stations.iter().any(|station| matches!(station.acting, Some(Acting::Any(_)))) {
            "the force points in its worst direction at every sample"
        } else {
            "a robot follows the mean force over a revolution; the teeth pass far above"
        };
        format!("all six drives compliant, everything else rigid; {force}\nbetween samples nothing is looked at\n")
    }

    /// Why the answer is no, where it is.
    pub fn shortfall(&self) -> Option<String> {
        if let Some(reason) = self.reason() {
            return Some(format!("{}: {reason}", self.robot.name));
        }
        let (found, tolerance) = (self.followed()?, self.tolerance_mm?);
        let fails = !Verdict::of(found.worst.0, tolerance).passes;
        fails.then(|| {
            format!(
                "{}: {} mm along {}, tolerance {tolerance} mm",
                self.robot.name,
                fixed(found.worst.0 * 1e3, 4),
                self.path
            )
        })
    }
}

/// Where the force comes from, in words too, and what is to be said of it.
fn forcing(
    asked: &Request,
    process: Option<(String, ProcessFile)>,
) -> Result<(Forcing, String, Vec<String>), MillAnswerError> {
    if let Some((name, file)) = process {
        let mut remarks = file.assumed;
        let unverified = file.material.filter(|material| material.status == "unverified");
        remarks.extend(unverified.map(|material| {
            format!("the force coefficients of {} are UNVERIFIED: {}", material.name, material.source)
        }));
        return Ok((Forcing::Process(file.process), name, remarks));
    }
    let acting = asked.acting()?.ok_or_else(|| {
        let why = "missing; expected --force-n with a size or FEED,ACROSS,AXIAL in N, or --process with a process file"
            .to_owned();
        asked.refused("force-n", why)
    })?;
    let told = match acting {
        Acting::Any(newtons) => format!("{} N in its worst direction", fixed(newtons, 1)),
        Acting::Known { force: [feed, across, axial], .. } => {
            format!(
                "{} N along the feed, {} N across (left), {} N axial (away from the work)",
                fixed(feed, 1),
                fixed(across, 1),
                fixed(axial, 1)
            )
        }
    };
    Ok((Forcing::Same(acting), told, Vec::new()))
}

fn counted(part: ErrorPart) -> &'static str {
    match part {
        ErrorPart::Total => "the whole displacement of the tip",
        ErrorPart::Across => "its part across the feed and the tool axis",
        ErrorPart::Axial => "its part along the tool axis",
    }
}

fn least(found: &Followed, of: impl Fn(&Pushed) -> f64) -> f64 {
    found.samples.iter().map(of).fold(f64::INFINITY, f64::min)
}
