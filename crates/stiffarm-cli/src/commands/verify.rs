//! `stiffarm robots verify`: does a robot file count the joints as the pendant does?

use std::path::Path;

use serde_json::Value;
use stiffarm::catalogue::readings::{self, ReadOptions, Readings};
use stiffarm::catalogue::{self, files};
use stiffarm::robot::Robot;
use stiffarm::verify::{VerifyOptions, rank, verify};
use stiffarm_ask::answer::{Rows, VerifyAnswer, VerifyRankAnswer};
use stiffarm_ask::ask::{Listener, selection};
use stiffarm_ask::date::today;

use crate::args::VerifyArgs;
use crate::common::Common;
use stiffarm_ask::forms::{Answer, Forms, Piece, sheet};

use crate::failure::Failure;
use crate::look::Look;
use crate::output::{Outputs, say, verdict};
use crate::progress::watched;
use crate::table::text;

pub(crate) fn run(args: &VerifyArgs, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open(common, FORMS)?;
    let answer = answer(args, common)?;
    let holds = match &answer {
        VerifyOutput::One(one) if !one.found.verified => Err(Failure::NotVerified(one.found.robot.full_name())),
        _ => Ok(()),
    };
    let writes =
        common.output.iter().any(|path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")));
    if writes {
        let VerifyOutput::One(one) = &answer else {
            return Err(Failure::usage("without a robot's name no robot file is written; expected ROBOT READINGS"));
        };
        let Some((_, remarks)) = one.robot_file() else {
            // What is known is told; no file is written of what fits nothing.
            say(text(&sheet([one.summary()], one.notes()), Look::of_stderr()).trim_end());
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
        [robot, file] => (Some(selection::robot(robot, common.context())?), file),
        [file] if args.any => (None, file),
        _ => return Err(Failure::usage("expected ROBOT READINGS.csv, or READINGS.csv --any")),
    };
    let data = files::shown(Path::new(file));
    let reading = ReadOptions {
        columns: args.columns.clone(),
        frame_by: args.frame_by.clone(),
        vendor: robot.as_ref().map_or_else(String::new, |robot| robot.vendor.clone()),
    };
    let readings = readings::read(&common.sources.text(file)?, &data, &reading).map_err(Failure::Readings)?;
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

pub(crate) enum VerifyOutput {
    One(Box<VerifyAnswer>),
    Any(VerifyRankAnswer),
}

/// In which forms it is shown.
const FORMS: Forms = Forms { further: &["toml"], ..Forms::of("robots verify") };

impl Answer for VerifyOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        match self {
            Self::One(one) => {
                let tables = [Some(one.summary()), one.table()];
                sheet(tables.into_iter().flatten(), one.notes())
            }
            Self::Any(any) => sheet([any.table()], any.notes()),
        }
    }

    fn value(&self) -> Value {
        match self {
            Self::One(one) => one.json(),
            Self::Any(any) => any.json(),
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
