//! Robots in order on a path: each at its own best place and rolls.

use serde_json::{Value, json};

use super::super::verdict::{self, Verdict};
use super::super::words::{self, degrees};
use super::super::{Datum, Record, Rows, Table, field, fixed, shape, stiffness, stiffnesses, uncertainty, with_schema};
use super::{Beside, MillAnswer, MillAnswerError, least};
use crate::request::Request;
use stiffarm::compliance::PostureError;
use stiffarm::mill::{Followed, MillError};
use stiffarm::rank::{Contestant, Standing, order};
use stiffarm::robot::{Robot, Status};
use stiffarm::toolpath::Move;
use stiffarm::uncertainty::{Chances, of_task};
use stiffarm::watch::{Stopped, Watch};

/// The answer of a ranking on a path.
#[derive(Clone, Debug)]
pub struct PathRankAnswer {
    /// The path as it was asked for.
    pub path: String,
    /// The robots, the best first.
    pub rows: Vec<PathRow>,
    /// The largest error that passes, mm.
    pub tolerance_mm: Option<f64>,
    /// What is to be said of path and forces.
    pub remarks: Vec<String>,
}

/// A robot on a path.
#[derive(Clone, Debug)]
pub struct PathRow {
    /// Which.
    pub robot: Robot,
    /// Where it stands among the others.
    pub standing: Standing,
    /// How it does, or why that cannot be said of it.
    pub milled: Result<MillAnswer, PostureError>,
    /// Probability that it is the best, over draws of the drive stiffness; `None` where that is not known.
    pub chances: Option<Chances>,
}

impl PathRankAnswer {
    /// What a request asks of robots, a path and its moves, and what was read beside it.
    ///
    /// # Errors
    /// What makes no sense together; what nobody waited for.
    pub fn of(
        asked: &Request,
        robots: Vec<Robot>,
        (path, moves): (String, &[Move]),
        beside: &Beside,
        watch: Watch,
    ) -> Result<Self, MillAnswerError> {
        let parts = watch.parts(Some(robots.len()));
        let mut all = Vec::with_capacity(robots.len());
        for robot in robots {
            let milled = MillAnswer::of(asked, &robot, (path.clone(), moves), beside.clone(), watch.of_part());
            let milled = match milled {
                Err(MillAnswerError::Mill { error: MillError::Posture(error), .. }) => Err(error),
                milled => Ok(milled?),
            };
            parts.one_more().map_err(|error: Stopped| MillAnswerError::Mill {
                robot: robot.name.clone(),
                path: path.clone(),
                error: error.into(),
            })?;
            // With the drives that were asked for.
            let robot = milled.as_ref().map_or(robot, |milled| milled.robot.clone());
            all.push((robot, milled));
        }
        let remarks = all.iter().find_map(|(_, milled)| Some(milled.as_ref().ok()?.remarks.clone()));
        let (rows, tolerance_mm) = (ordered(all), asked.tolerance_mm());
        Ok(Self { path, rows, tolerance_mm, remarks: remarks.unwrap_or_default() })
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let first = self.milled().next();
        let mut record = Record::of(&shape::PATH_RANKING);
        record
            .put(field::PATH, &self.path)
            .put(field::CUTTING_FORCE, first.map(|milled| &milled.force))
            .put(field::PART, first.map(MillAnswer::part))
            .put(field::ERROR_PART, first.map(|milled| milled.options.part.name()))
            .put(field::ROWS, self.rows.iter().map(|row| row.record(self.tolerance_mm)).collect::<Datum>())
            .put(field::SUMMARY, json!(self.sentences()))
            .put(field::REMARKS, json!(self.remarks));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("mill", super::super::ORIGIN, &self.record())
    }

    /// One row per robot.
    pub fn rows(&self) -> Rows<'static> {
        Rows::of(&shape::PATH_RANKING_ROW, self.rows.iter().map(|row| row.record(self.tolerance_mm)))
    }

    pub(in crate::answer) fn milled(&self) -> impl Iterator<Item = &MillAnswer> {
        self.rows.iter().filter_map(|row| row.milled.as_ref().ok())
    }

    /// What is milled.
    fn along(&self) -> String {
        super::along(&self.path, self.milled().next().and_then(|milled| milled.only_tool))
    }

    /// The first robot with a rank that follows the path and may carry what it holds, and those that cannot be distinguished from it by the proof.
    pub(in crate::answer) fn best(&self) -> Option<(&PathRow, Vec<&PathRow>)> {
        let mut ranked = self.rows.iter().filter(|row| row.is_candidate());
        let best = ranked.next()?;
        let place = |row: &PathRow| row.standing.rank.map(|rank| rank.place);
        Some((best, ranked.filter(|row| place(row) == place(best)).collect()))
    }

    /// Where the force on the tool comes from, in words.
    pub fn force(&self) -> &str {
        self.milled().next().map_or("no robot has six joints", |milled| &milled.force)
    }

    /// What stands above the table.
    pub fn heading(&self) -> String {
        let Some(first) = self.milled().next() else { return format!("{}: no robot has six joints\n", self.along()) };
        format!(
            "Largest error [mm] along {}, each robot at its best place and rolls ({})\n{}; {}\ntool {}{}; keeps {}\n{}",
            self.along(),
            first.options.roll.name(),
            first.force,
            stiffnesses(self.rows.iter().map(|row| &row.robot)),
            words::tool(&first.flange_from_tool),
            first.options.tool_weight.map_or_else(String::new, |weight| format!(", {} kg", weight.mass)),
            first.kept(),
            first.in_cell().map(|[name, text]| format!("{name}: {text}\n")).collect::<String>(),
        )
    }

    /// From what places count: the robots stand in a cell, or each by itself.
    fn counts_from(&self) -> &'static str {
        let is_in_cell = self.milled().next().is_some_and(|milled| milled.ground.cell.is_some());
        if is_in_cell { "in the cell" } else { "from the base" }
    }

    /// For people: one row per robot.
    pub fn table(&self) -> Table {
        let origin = format!("origin {} [m]", self.counts_from());
        let headings = [
            "#",
            "robot",
            "status",
            "error [mm]",
            "at least [mm]",
            "90 % interval [mm]",
            &origin,
            "yaw [deg]",
            "margin [deg]",
        ];
        let mut table = Table::new(headings).with_room(2, &["yaw [deg]", "margin [deg]", "status", &origin]);
        let best = self.best().map(|(best, _)| &best.robot);
        for row in &self.rows {
            let is_estimated = row.robot.status == Status::Estimated;
            let none = if is_estimated { "~" } else { "-" };
            let mut cells = vec![
                row.standing.rank.map_or_else(|| none.to_owned(), |rank| rank.to_string()),
                format!("{}{}", row.robot.full_name(), if is_estimated { " ~" } else { "" }),
                words::status(&row.robot).into(),
            ];
            cells.extend(row.cells(best == Some(&row.robot)));
            table.row(cells);
        }
        table
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let mut notes = self.sentences().join("\n") + "\n\n";
        for row in &self.rows {
            notes.extend(reason(&row.milled).map(|why| format!("- {}: {why}\n", row.robot.name)));
        }
        notes.extend(self.remarks.iter().map(|remark| format!("note: {remark}\n")));
        notes += "* smallest error of the robots whose geometry is published; #: one more than the robots that are certainly better, by their errors and the proved bounds; = cannot be distinguished by the proof\n";
        notes.extend(self.milled().next().map(MillAnswer::notes));
        notes
    }

    /// What a manager would read.
    pub fn sentences(&self) -> Vec<String> {
        let Some((best, rivals)) = self.best() else {
            let carried = if self.overloads().next().is_some() { " and may carry tool and force" } else { "" };
            let none =
                format!("No robot whose geometry is published follows {}{}{carried}.", self.along(), self.clearly());
            return [none].into_iter().chain(self.overloads()).collect();
        };
        let mm = |metres: f64| format!("{} mm", fixed(metres * 1e3, 3));
        let value = best.proved().map_or(0.0, |[_, value]| value);
        let mut sentences = vec![format!(
            "The smallest error along {} is that of {}: {}{}.",
            self.along(),
            best.robot.full_name(),
            mm(value),
            self.leaves_out(best, value)
        )];
        if self.milled().any(|milled| milled.options.clear_of.is_none()) {
            sentences.push("No arm was looked at for collisions: with --clearance-mm 0 they are, and what keeps clear may err more.".into());
        }
        if !rivals.is_empty() {
            let names = named(rivals.iter().map(|row| row.robot.name.clone()).collect());
            sentences.push(format!("By the proof it cannot be distinguished from {names}."));
        }
        sentences.extend(self.tolerance_mm.map(|tolerance| {
            let name = |row: &PathRow| {
                let probability = row.milled.as_ref().ok().and_then(|milled| milled.verdict()?.probability);
                let sure = probability.map_or_else(String::new, |known| format!(" (P {})", verdict::percent(known)));
                let estimated = if row.robot.status == Status::Estimated { " ~" } else { "" };
                format!("{}{estimated}{sure}", row.robot.name)
            };
            let holds: Vec<String> = self.rows.iter().filter(|row| row.holds(tolerance)).map(name).collect();
            if holds.is_empty() {
                format!("No robot holds {tolerance} mm, at the nominal stiffness.")
            } else {
                format!("{tolerance} mm is held by {}, at the nominal stiffness.", named(holds))
            }
        }));
        let known = self.rows.iter().filter_map(|row| Some((row.robot.name.as_str(), row.chances?))).collect();
        sentences.extend(uncertainty::sentence(&self.along(), known));
        sentences.extend(self.overloads());
        sentences
    }

    /// Robots that follow the path and may not carry what they hold.
    pub(in crate::answer) fn overloads(&self) -> impl Iterator<Item = String> {
        self.milled().filter(|milled| clear(milled).is_some()).filter_map(MillAnswer::overload_sentence)
    }

    /// Of which robots the best is not, where others have a smaller error.
    fn leaves_out(&self, best: &PathRow, value: f64) -> &'static str {
        let is_better = |row: &&PathRow| row.proved().is_some_and(|[_, other]| other < value);
        let better: Vec<&PathRow> = self.rows.iter().filter(is_better).collect();
        let of_others = |is_left_out: fn(&PathRow) -> bool| better.iter().any(|row| is_left_out(row));
        match (of_others(|row| row.robot.status == Status::Estimated), of_others(PathRow::is_overloaded)) {
            _ if !best.is_candidate() => "",
            (true, true) => ", of the robots whose geometry is published and that may carry tool and force",
            (true, false) => ", of the robots whose geometry is published",
            (false, true) => ", of the robots that may carry tool and force",
            (false, false) => "",
        }
    }

    /// What a path that is followed must do besides, where some robot does not.
    fn clearly(&self) -> &'static str {
        let touches = |milled: &MillAnswer| milled.followed().is_some_and(Followed::touches);
        if self.milled().any(touches) { " and keeps clear" } else { "" }
    }

    /// Why the answer is no, where it is: no robot of published geometry follows the path and holds the tolerance.
    pub fn shortfall(&self) -> Option<String> {
        let is_good =
            |row: &PathRow| row.is_candidate() && self.tolerance_mm.is_none_or(|tolerance| row.holds(tolerance));
        if self.rows.iter().any(is_good) {
            return None;
        }
        Some(match self.tolerance_mm {
            Some(tolerance) => format!("no robot of published geometry holds {tolerance} mm along {}", self.along()),
            None => format!("no robot of published geometry follows {}{}", self.along(), self.clearly()),
        })
    }
}

/// The first ten of some names, and how many there are besides.
fn named(names: Vec<String>) -> String {
    const MOST: usize = 10;
    let more = names.len().saturating_sub(MOST);
    let listed = names.into_iter().take(MOST).collect::<Vec<_>>().join(", ");
    if more == 0 { listed } else { format!("{listed} and {more} more") }
}

/// The robots in order.
fn ordered(all: Vec<(Robot, Result<MillAnswer, PostureError>)>) -> Vec<PathRow> {
    let contestants: Vec<Contestant> = all
        .iter()
        .map(|(robot, milled)| (robot, milled.as_ref().ok().and_then(proved)))
        .map(|(robot, proved)| Contestant {
            vendor: &robot.vendor,
            name: &robot.name,
            is_estimated: robot.status == Status::Estimated,
            proved: vec![proved],
        })
        .collect();
    let standings = order(&contestants);
    let draws = |(robot, milled): &(Robot, Result<MillAnswer, PostureError>)| {
        let milled = milled.as_ref().ok().filter(|_| robot.status != Status::Estimated)?;
        clear(milled).filter(|_| !milled.carried().is_exceeded()).and_then(|_| milled.draws.clone())
    };
    let chances = of_task(&all.iter().map(draws).collect::<Vec<_>>());
    let mut all: Vec<_> = all.into_iter().zip(chances).map(Some).collect();
    let row = |standing: Standing| {
        let ((robot, milled), chances) = all[standing.at].take()?;
        Some(PathRow { robot, standing, milled, chances })
    };
    standings.into_iter().filter_map(row).collect()
}

/// What the largest error may be by what is proved, m: the lower bound and the value; `None` where the path is not followed, or touches something.
fn proved(milled: &MillAnswer) -> Option<[f64; 2]> {
    Some([milled.lower_bound()?, clear(milled)?.worst.0])
}

/// The path as it is followed, where it is and touches nothing: an arm that cannot do without is no better than one that does not reach.
fn clear(milled: &MillAnswer) -> Option<&Followed> {
    milled.followed().filter(|found| !found.touches())
}

/// Why a robot has no rank.
fn reason(milled: &Result<MillAnswer, PostureError>) -> Option<String> {
    match milled {
        Ok(milled) => milled.reason().or_else(|| milled.contact_sentence()),
        Err(error) => Some(error.to_string()),
    }
}

impl PathRow {
    /// What the largest error may be by what is proved, m: the lower bound and the value; `None` where the path is not followed, or touches something.
    pub fn proved(&self) -> Option<[f64; 2]> {
        proved(self.milled.as_ref().ok()?)
    }

    /// It holds the tolerance, mm, at the nominal stiffness, and may carry what it holds.
    pub(in crate::answer) fn holds(&self, tolerance_mm: f64) -> bool {
        !self.is_overloaded() && self.proved().is_some_and(|[_, value]| Verdict::of(value, tolerance_mm).passes)
    }

    /// Tool and force are more than it may carry.
    fn is_overloaded(&self) -> bool {
        self.milled.as_ref().is_ok_and(|milled| milled.carried().is_exceeded())
    }

    /// It has a rank, follows the path and may carry what it holds.
    fn is_candidate(&self) -> bool {
        self.standing.rank.is_some() && self.proved().is_some() && !self.is_overloaded()
    }

    fn record(&self, tolerance_mm: Option<f64>) -> Record {
        let Self { robot, standing, milled, chances } = self;
        let milled = milled.as_ref();
        let answer = milled.ok();
        let found = answer.and_then(MillAnswer::followed);
        let placement = answer.and_then(|answer| answer.placement);
        let in_cell = placement.filter(|_| answer.is_some_and(|answer| answer.ground.cell.is_some()));
        let spread = answer.and_then(MillAnswer::spread);
        let mut record = Record::of(&shape::PATH_RANKING_ROW);
        stiffness::put_robot(&mut record, robot);
        if let Some(milled) = answer {
            milled.carried().put(&mut record);
        }
        record
            .put(field::RANK, standing.rank.map(|rank| rank.place))
            .put(field::RANK_TIED, standing.rank.map(|rank| rank.is_tied))
            .put(field::FEASIBLE, answer.map(|milled| clear(milled).is_some()))
            .put(field::REASON, reason(&self.milled))
            .put(field::PATH_WORST, found.map(|found| found.worst.0))
            .put(field::PATH_WORST_P05, spread.map(|spread| spread.p05))
            .put(field::PATH_WORST_P50, spread.map(|spread| spread.median))
            .put(field::PATH_WORST_P95, spread.map(|spread| spread.p95))
            .put(field::PATH_LOWER_BOUND, answer.and_then(MillAnswer::lower_bound))
            .put(field::RMS, found.map(|found| found.rms))
            .put(field::ROLL_CHOICE, answer.map(MillAnswer::roll))
            .put(field::AT, placement.map(|placement| placement.at_from_base()))
            .put(field::AT_YAW, placement.and_then(|placement| placement.yaw_from_ahead()))
            .put(field::CELL_ORIGIN, in_cell.map(|placement| placement.at))
            .put(field::CELL_YAW, in_cell.map(|placement| placement.yaw))
            .put(field::LIMIT_MARGIN, found.map(|found| least(found, |pushed| pushed.limit_margin)))
            .put(field::SINGULAR_MARGIN, found.map(|found| least(found, |pushed| pushed.singular_margin)));
        MillAnswer::put_clearance(answer, &mut record);
        let verdict = answer.filter(|milled| clear(milled).is_some()).and_then(MillAnswer::verdict);
        verdict::put(&mut record, tolerance_mm, verdict, false);
        uncertainty::put_chances(&mut record, &[*chances]);
        record.put(field::SEARCH, answer.and_then(MillAnswer::search));
        record
    }

    /// Its cells in the table besides rank and name.
    fn cells(&self, is_best: bool) -> Vec<String> {
        let nothing = || vec!["-".to_owned(); 6];
        let Ok(milled) = &self.milled else { return nothing() };
        let (Some(found), Some(placement), Some([bound, value])) =
            (milled.followed(), milled.placement, proved(milled))
        else {
            return nothing();
        };
        let mm = |metres: f64| fixed(metres * 1e3, 3);
        let is_rival = self.is_candidate() && self.standing.rank.is_some_and(|rank| rank.place == 1);
        let mark = if is_best {
            "*"
        } else if is_rival {
            "="
        } else {
            ""
        };
        let verdict = match milled.verdict() {
            _ if self.is_overloaded() => " LOAD EXCEEDED".into(),
            Some(verdict) => format!(" {}", verdict.short()),
            None => String::new(),
        };
        // As `mill --at` takes it.
        let (at, yaw) = match milled.ground.cell {
            Some(_) => (placement.at, Some(placement.yaw)),
            None => (placement.at_from_base(), placement.yaw_from_ahead()),
        };
        let margin = least(found, |pushed| pushed.limit_margin.min(pushed.singular_margin));
        vec![
            format!("{}{mark}{verdict}", mm(value)),
            mm(bound),
            milled.spread().map_or_else(|| "-".into(), |spread| format!("{} .. {}", mm(spread.p05), mm(spread.p95))),
            at.map(|metres| fixed(metres, 3)).join(", "),
            yaw.map_or_else(|| "-".into(), |yaw| degrees(yaw).trim_end_matches(" deg").to_owned()),
            degrees(margin).trim_end_matches(" deg").to_owned(),
        ]
    }
}
