//! `stiffarm robots import`: a robot file from a URDF or from OPW parameters.

use serde_json::{Value, json};
use stiffarm::catalogue::files;
use stiffarm::catalogue::import::{ImportOptions, Imported, Packages, SAMPLES, import, import_enclosed};
use stiffarm::interval::Interval;
use stiffarm::robot::Arm;
use stiffarm_ask::answer::words::architecture;
use stiffarm_ask::answer::{Cell, Rows, Table, Unit, columns_of, field};
use stiffarm_ask::ask::AskError;

use crate::args::ImportArgs;
use crate::common::{Common, Format};
use stiffarm_ask::forms::{Answer, Forms, Makes, Piece};

use crate::failure::Failure;
use crate::look::{Look, say};
use crate::output::Outputs;
use crate::progress::watched;
use crate::table::shown;

pub(crate) fn run(args: &ImportArgs, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open(common, FORMS)?;
    let options = options(args)?;
    common.sources.check_unwritten(&args.file)?;
    let text = files::text(&args.file)?;
    let shown_file = files::shown(&args.file);
    let imported = if args.meshes {
        let packages = Packages::of(&args.file, args.package.clone());
        watched("enclosing", common, |_| import_enclosed(&text, &shown_file, &options, &|name| packages.bytes(name)))
    } else {
        import(&text, &shown_file, &options)
    };
    let ends_are_given = args.base.is_some() && args.tip.is_some();
    let answer = Report(imported.map_err(|error| AskError::Import { error, ends_are_given })?);
    if common.format == Format::Table && !common.quiet {
        say(shown(&answer.report(), Look::of_stderr()).trim_end());
    }
    outputs.deliver(&answer)
}

fn options(args: &ImportArgs) -> Result<ImportOptions, Failure> {
    let limits = match args.limits_deg.len() {
        0 => None,
        6 => Some(std::array::from_fn(|i| {
            let range = args.limits_deg[i];
            Interval::spanning(range.min().to_radians(), range.max().to_radians())
        })),
        n => return Err(Failure::usage(format!("--limits-deg has {n} ranges; expected six, separated by commas"))),
    };
    Ok(ImportOptions {
        name: args.name.clone(),
        vendor: args.vendor.clone(),
        payload_kg: args.payload_kg,
        reach: args.reach_m,
        architecture: args.architecture,
        limits,
        base: args.base.clone(),
        tip: args.tip.clone(),
    })
}

struct Report(Imported);

/// Rounding of the computer alone is no error of the file.
fn micrometres(metres: f64) -> String {
    if metres < 1e-9 { "below 0.001".into() } else { format!("{:.3}", metres * 1e6) }
}

impl Report {
    fn lines(&self) -> Vec<(&'static str, String)> {
        let Imported { robot, notes, compared_with, largest_error, largest_turn, .. } = &self.0;
        let mut rows = vec![("robot", robot.full_name()), ("architecture", architecture(robot))];
        if let Arm::SixAxis { geometry, limits, .. } = &robot.arm {
            let lengths = [
                ("a1", geometry.a1),
                ("a2", geometry.a2),
                ("b", geometry.b),
                ("c1", geometry.c1),
                ("c2", geometry.c2),
                ("c3", geometry.c3),
                ("c4", geometry.c4),
            ];
            let lengths = lengths.map(|(name, m)| format!("{name} {}", (m * 1e6).round() / 1e3));
            rows.push(("lengths", format!("{} mm", lengths.join(", "))));
            let list = |values: [f64; 6]| values.map(|x| format!("{}", (x * 1e4).round() / 1e4)).join(", ");
            rows.push((
                "zero offsets",
                format!("{} deg", list(geometry.offset.map(|angle| Unit::Degree.of_si(angle)))),
            ));
            rows.push(("signs", list(geometry.sign)));
            let ranges = limits.joints.map(|range| {
                let end = |x: f64| (Unit::Degree.of_si(x) * 1e2).round() / 1e2;
                format!("{}..{}", end(range.min()), end(range.max()))
            });
            rows.push(("limits", format!("{} deg", ranges.join(", "))));
            let speeds =
                limits.speeds.map(|speeds| format!("{} deg/s", list(speeds.map(|speed| Unit::Degree.of_si(speed)))));
            rows.push(("speeds", speeds.unwrap_or_else(|| "-".into())));
        }
        rows.extend(notes.iter().map(|note| ("note", note.clone())));
        rows.push((
            "proved",
            format!(
                "at {SAMPLES} postures, and uphill from the worst, against {compared_with}: largest error {} um, {:.5} deg",
                micrometres(*largest_error),
                Unit::Degree.of_si(*largest_turn)
            ),
        ));
        rows
    }

    fn report(&self) -> Table {
        let mut table = Table::new(["", ""]);
        for (key, value) in self.lines() {
            table.row([key.to_owned(), value]);
        }
        table
    }
}

/// In which forms it is shown.
const FORMS: Forms = Forms { command: "robots import", makes: &[Makes::RobotFile] };

impl Answer for Report {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Verbatim(self.0.text.clone())]
    }

    fn markdown(&self) -> Vec<Piece> {
        vec![Piece::Table(self.report())]
    }

    fn value(&self) -> Value {
        let Imported { robot, text, notes, compared_with, largest_error, largest_turn } = &self.0;
        json!({
            "robot": robot.name,
            "vendor": robot.vendor,
            "architecture": robot.architecture.name(),
            "status": robot.status.name(),
            "notes": notes,
            "compared_with": compared_with,
            "postures": SAMPLES,
            "largest_error_m": largest_error,
            "largest_error_rad": largest_turn,
            "robot_file": text,
        })
    }

    fn rows(&self) -> Rows<'_> {
        let rows = self.lines().into_iter().map(|(key, value)| vec![Cell::Text(key.to_owned()), Cell::Text(value)]);
        Rows::new([field::KEY, field::VALUE].map(|field| columns_of(&field)).concat(), rows.collect())
    }

    fn robot_file(&self) -> Option<Result<String, AskError>> {
        Some(Ok(self.0.text.clone()))
    }
}
