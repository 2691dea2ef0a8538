//! `stiffarm robots check`: every fault of robot files at once, and what is doubtful about the rest.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use stiffarm::catalogue::files::{self, Loaded};
use stiffarm::catalogue::{Fault, warnings};
use stiffarm::robot::Robot;
use stiffarm_ask::answer::{Cell, Rows, Table, columns_of, field};
use stiffarm_ask::ask::AskError;

use crate::common::Common;
use stiffarm_ask::forms::{Answer, Forms, Piece};

use crate::failure::Failure;
use crate::look::say;
use crate::output::{Outputs, verdict};

pub(crate) fn run(asked: &[PathBuf], common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open(common, FORMS)?;
    let mut checked = Vec::new();
    for path in asked {
        let paths = common.sources.folder(&path.to_string_lossy()).unwrap_or_else(|| Ok(vec![path.clone()]));
        for path in paths.iter().flatten() {
            common.sources.check_unwritten(path)?;
        }
        match paths {
            Ok(paths) => checked.extend(paths.iter().map(|path| Checked::of(path, common))),
            Err(failure) => checked.push(Checked { file: files::shown(path), found: Err(failure) }),
        }
    }
    for Checked { file, found } in &checked {
        match found {
            Ok(Found { notes, warnings, .. }) => {
                for note in notes.iter().filter(|_| !common.quiet) {
                    say(&format!("note: {file}: {note}"));
                }
                for warning in warnings {
                    say(&format!("warning: {file}: {warning}"));
                }
            }
            Err(failure) => say(&failure.to_string()),
        }
    }
    let check = Check(checked);
    let bad: Vec<&AskError> = check.0.iter().filter_map(|checked| checked.found.as_ref().err()).collect();
    let holds = match bad[..] {
        [] => Ok(()),
        [first, ..] => Err(Failure::BadFiles { count: bad.len(), hint: first.hint() }),
    };
    verdict(outputs.deliver(&check), holds)
}

/// Every file, and what was found in it.
struct Check(Vec<Checked>);

struct Checked {
    file: String,
    found: Result<Found, AskError>,
}

struct Found {
    robot: Robot,
    notes: Vec<String>,
    warnings: Vec<String>,
}

impl Checked {
    fn of(path: &Path, common: &Common) -> Self {
        let found = common.sources.robot(path);
        let found = found.map(|Loaded { robot, notes }| Found { warnings: warnings(&robot), robot, notes });
        Self { file: files::shown(path), found }
    }

    fn robot(&self) -> Option<String> {
        self.found.as_ref().ok().map(|found| found.robot.full_name())
    }

    /// What makes the file useless; what concerns the whole file has no line.
    fn faults(&self) -> Vec<Fault> {
        match &self.found {
            Ok(_) => Vec::new(),
            Err(AskError::RobotFile(faults)) => faults.faults.clone(),
            Err(failure) => vec![Fault { line: 0, key: String::new(), message: failure.to_string() }],
        }
    }

    fn warnings(&self) -> &[String] {
        self.found.as_ref().map_or(&[], |found| &found.warnings)
    }
}

/// In which forms it is shown.
const FORMS: Forms = Forms::of("robots check");

impl Answer for Check {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let usable = self.0.iter().filter_map(|checked| Some((&checked.file, checked.robot()?)));
        let lines = usable.map(|(file, robot)| format!("{file}: {robot} can be used\n"));
        vec![Piece::Verbatim(lines.collect())]
    }

    fn markdown(&self) -> Vec<Piece> {
        vec![Piece::Table(Table::of_rows(&self.rows()))]
    }

    fn value(&self) -> Value {
        let each = self.0.iter().map(|checked| {
            let faults = checked.faults().into_iter().map(|Fault { line, key, message }| {
                json!({ "line": (0 < line).then_some(line), "key": key, "message": message })
            });
            json!({
                "file": checked.file,
                "usable": checked.found.is_ok(),
                "robot": checked.robot(),
                "faults": faults.collect::<Value>(),
                "doubts": checked.warnings(),
            })
        });
        each.collect()
    }

    /// A row per fault or warning; one without for a file that has none.
    fn rows(&self) -> Rows<'_> {
        let columns = [field::FILE, field::USABLE, field::ROBOT, field::LINE, field::KEY, field::MESSAGE];
        let mut rows = Vec::new();
        for checked in &self.0 {
            let mut row = |line: Cell, key: Cell, message: Cell| {
                let robot = checked.robot().map_or(Cell::Absent, Cell::Text);
                rows.push(vec![
                    Cell::Text(checked.file.clone()),
                    Cell::Truth(checked.found.is_ok()),
                    robot,
                    line,
                    key,
                    message,
                ]);
            };
            let faults = checked.faults();
            for Fault { line, key, message } in &faults {
                let line = if *line == 0 { Cell::Absent } else { Cell::Count(*line as i64) };
                row(line, Cell::Text(key.clone()), Cell::Text(message.clone()));
            }
            for warning in checked.warnings() {
                row(Cell::Absent, Cell::Absent, Cell::Text(warning.clone()));
            }
            if faults.is_empty() && checked.warnings().is_empty() {
                row(Cell::Absent, Cell::Absent, Cell::Absent);
            }
        }
        Rows::new(columns.map(|field| columns_of(&field)).concat(), rows)
    }
}
