//! `stiffarm robots verify`: does a robot file count the joints as the pendant does?

use std::io::{self, Write};
use std::path::Path;

use stiffarm::catalogue::readings::{self, ReadOptions, Readings};
use stiffarm::catalogue::{self, files};
use stiffarm::robot::Robot;
use stiffarm::verify::{VerifyOptions, rank, verify};
use stiffarm_ask::answer::{Rows, VerifyAnswer, VerifyRankAnswer};

use super::watched;
use crate::args::VerifyArgs;
use crate::common::Common;
use crate::failure::Failure;
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty, verdict};
use crate::selection;
use crate::table::sheet;

pub(crate) fn run(args: &VerifyArgs, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<VerifyOutput>(common)?;
    let answer = answer(args, common)?;
    let holds = match &answer {
        VerifyOutput::One(one) if !one.found.verified => Err(Failure::NotVerified(one.found.robot.full_name())),
        _ => Ok(()),
    };
    let writes =
        common.output.iter().any(|path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")));
    if writes {
        let VerifyOutput::One(one) = &answer else {
            return Err(Failure::Usage(
                "without a robot's name no robot file is written; expected ROBOT READINGS".into(),
            ));
        };
        let Some((_, remarks)) = one.robot_file() else {
            // What is known is told; no file is written of what fits nothing.
            crate::output::say(sheet(&[one.summary()], &one.notes(), Look::of_stderr()).trim_end());
            return Err(Failure::NotVerified(one.found.robot.full_name()));
        };
        for remark in &remarks {
            common.remark(&format!("note: {remark}"));
        }
    }
    verdict(outputs.deliver(&answer), holds)
}

pub(crate) fn answer(args: &VerifyArgs, common: &Common) -> Result<VerifyOutput, Failure> {
    let options = VerifyOptions { base: args.base_mm, tool: args.tool_mm };
    let (robot, file) = match args.asked.as_slice() {
        [robot, file] => (Some(selection::robot(robot, common)?), file),
        [file] if args.any => (None, file),
        _ => return Err(Failure::Usage("expected ROBOT READINGS.csv, or READINGS.csv --any".into())),
    };
    let data = files::shown(Path::new(file));
    let reading = ReadOptions {
        columns: args.columns.clone(),
        frame_by: args.frame_by.clone(),
        vendor: robot.as_ref().map_or_else(String::new, |robot| robot.vendor.clone()),
    };
    let readings = readings::read(&common.shelf.text(file)?, &data, &reading).map_err(Failure::Readings)?;
    for remark in &readings.remarks {
        common.remark(&format!("note: {data}: {remark}"));
    }
    if let Some(notation) = readings.notation {
        common.remark(&format!("note: {data}: the orientation is read as {}", notation.about()));
    }
    let failure = |error| Failure::Verify { data: data.clone(), error };
    let Some(robot) = robot else {
        let fits = ranked(&readings, &options, common).map_err(failure)?;
        return Ok(VerifyOutput::Any(VerifyRankAnswer { fits, rows: readings.rows.len(), data }));
    };
    let others: Vec<Robot> = (catalogue::entries().iter())
        .filter(|entry| entry.name != robot.name && (args.any || entry.vendor == robot.vendor))
        .map(catalogue::Entry::robot)
        .collect();
    let found =
        watched("comparing", common, |watch| verify(&robot, &readings, &options, &others, watch)).map_err(failure)?;
    let date = args.date.clone().unwrap_or_else(today);
    Ok(VerifyOutput::One(Box::new(VerifyAnswer { found, data, date })))
}

fn ranked(
    readings: &Readings,
    options: &VerifyOptions,
    common: &Common,
) -> Result<Vec<(Robot, stiffarm::verify::Fit)>, stiffarm::verify::VerifyError> {
    watched("comparing", common, |watch| rank(readings, options, &catalogue::robots(), watch))
}

/// The day of this machine's clock, UTC, as year-month-day.
///
/// Days count from the first of March of the year 0, so that leap days end a year: 400 years have 146097 days.
pub(crate) fn today() -> String {
    let seconds = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0, |since| since.as_secs());
    date_of(seconds / 86_400)
}

/// The day so many days after the first of January 1970.
fn date_of(days: u64) -> String {
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{day:02}", era * 400 + year + later)
}

pub(crate) enum VerifyOutput {
    One(Box<VerifyAnswer>),
    Any(VerifyRankAnswer),
}

impl Answer for VerifyOutput {
    const COMMAND: &'static str = "robots verify";
    const FURTHER: &'static [&'static str] = &["toml"];

    fn text(&self, look: Look) -> String {
        match self {
            Self::One(one) => {
                let tables = [Some(one.summary()), one.table()];
                sheet(&tables.into_iter().flatten().collect::<Vec<_>>(), &one.notes(), look)
            }
            Self::Any(any) => sheet(&[any.table()], &any.notes(), look),
        }
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::One(one) => pretty(out, &one.json()),
            Self::Any(any) => pretty(out, &any.json()),
        }
    }

    fn rows(&self) -> Rows<'_> {
        match self {
            Self::One(one) => one.rows(),
            Self::Any(any) => any.rows(),
        }
    }

    fn robot_file(&self) -> Option<String> {
        match self {
            Self::One(one) => one.robot_file().map(|(text, _)| text),
            Self::Any(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_the_dates_of_the_calendar() {
        // Day numbers by hand: 1970 to 2000 has 30 years and 7 leap days; 2000 is a leap year.
        for (days, date) in [
            (0, "1970-01-01"),
            (10_957, "2000-01-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_781, "2026-11-24"),
        ] {
            assert_eq!(date_of(days), date);
        }
    }
}
