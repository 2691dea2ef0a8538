//! How is an identification reported?

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::numbers::digits;
use super::words::{self, fixed};
use super::{Datum, Line, Record, Rows, Table, field, line, shape, stiffness, updated, with_schema};
use stiffarm::catalogue::write;
use stiffarm::identify::{Estimate, Estimator, Identification, Residual, Spring, Springs, Tried, Unknown};
use stiffarm::robot::Robot;

/// So many outliers are named; the JSON has all.
const MOST_NAMED: usize = 12;

/// The answer of `identify`, with what was asked.
#[derive(Clone, Debug)]
pub struct IdentifyAnswer {
    /// What was found.
    pub found: Identification,
    /// The robot before.
    pub before: Robot,
    /// The table of measurements, as it was named.
    pub data: String,
    /// When was measured.
    pub date: Option<String>,
}

impl IdentifyAnswer {
    /// Every field.
    pub fn record(&self) -> Record {
        let Identification { singular_values, least_seen, outliers, remarks, .. } = &self.found;
        let found = &self.found;
        let per_urad: Vec<f64> = singular_values.iter().map(|value| value * 1e-3).collect();
        let mut record = Record::of(&shape::IDENTIFICATION);
        record
            .put(field::ROBOT, &found.robot.name)
            .put(field::VENDOR, &found.robot.vendor)
            .put(field::DATE, self.date.as_ref())
            .put(field::ESTIMATOR, found.estimator.name())
            .put(field::POSTURES, found.postures)
            .put(field::READINGS, found.residuals.len())
            .put(field::MODEL, found.model.name())
            .put(field::DRIVES, self.drives().collect::<Datum>())
            .put(field::FURTHER_SPRINGS, self.further().collect::<Datum>())
            .put(field::COMPENSATOR, self.compensator().collect::<Datum>())
            .put(field::POSTERIOR_DRIVES, found.posterior.as_ref().map(|posterior| updated::records(&posterior.drives)))
            .put(field::MODELS, self.tried())
            .put(field::RMS_BEFORE, found.before)
            .put(field::RMS_AFTER, found.after)
            .put(field::RMS_LEFT_OUT, found.left_out)
            .put(field::RMS_USED, found.after_used)
            .put(field::EXPLAINED, found.explained())
            .put(field::EXPLAINED_LEFT_OUT, found.explained_left_out())
            .put(field::NOISE_RATIO, found.noise_ratio)
            .put(field::CONDITION, Some(found.condition()).filter(|condition| condition.is_finite()))
            .put(field::SINGULAR_VALUES, per_urad.as_slice())
            .put(field::LEAST_SEEN, least_seen.as_slice())
            .put(field::CORRELATION, self.correlation())
            .put(field::OUTLIERS, json!(outliers.iter().map(|outlier| outlier.row).collect::<Vec<_>>()))
            .put(field::RESIDUALS, found.residuals.iter().map(residual).collect::<Datum>())
            .put(field::REMARKS, json!(remarks));
        record
    }

    fn drives(&self) -> impl Iterator<Item = Record> + '_ {
        let drives = self.found.estimates.iter().filter_map(|estimate| match estimate.spring {
            Spring::Drive(drive) => Some((drive, estimate)),
            Spring::Region(_) | Spring::Base | Spring::Tool | Spring::Compensator | Spring::Preload => None,
        });
        drives.map(|(drive, estimate)| {
            let mut record = Record::of(&shape::IDENTIFIED_DRIVE);
            record.put(field::SPRING, drive + 1);
            put_estimate(&mut record, estimate, &self.found);
            record
        })
    }

    /// What springs besides the drives.
    fn further(&self) -> impl Iterator<Item = Record> + '_ {
        let is_other = |spring: Spring| spring.is_compliance() && !matches!(spring, Spring::Drive(_));
        self.found.estimates.iter().filter(move |estimate| is_other(estimate.spring)).map(|estimate| {
            let region =
                if let Spring::Region(region) = estimate.spring { Some(self.found.regions[region]) } else { None };
            let mut record = Record::of(&shape::FURTHER_SPRING);
            record.put(field::SPRING_NAME, estimate.spring.name()).put(field::REGION, region);
            put_estimate(&mut record, estimate, &self.found);
            record
        })
    }

    /// What is found of a gravity compensator.
    fn compensator(&self) -> impl Iterator<Item = Record> + '_ {
        self.found.estimates.iter().filter(|estimate| !estimate.spring.is_compliance()).map(|estimate| {
            let (unit, factor) = unit_of(estimate.spring);
            let why = estimate.unknown.as_ref().map(|why| in_words(why, &self.found));
            let mut record = Record::of(&shape::FOUND_COMPENSATOR);
            record
                .put(field::SPRING_NAME, estimate.spring.name())
                .put(field::IN_UNIT, unit)
                .put(field::FOUND, estimate.compliance.map(|x| x * factor))
                .put(field::FOUND_ERROR, estimate.standard_error.map(|x| x * factor))
                .put(field::FOUND_INTERVAL, estimate.interval.map(|range| range.map(|x| x * factor)))
                .put(field::IS_IDENTIFIED, estimate.unknown.is_none())
                .put(field::NOT_IDENTIFIED, why)
                .put(field::FOUND_USED, estimate.used * factor);
            record
        })
    }

    /// The models among which was chosen.
    fn tried(&self) -> Datum {
        let of = |one: &Tried| {
            let mut record = Record::of(&shape::TRIED_MODEL);
            let (fit, why) = (one.fit.as_ref().ok(), one.fit.as_ref().err());
            record
                .put(field::MODEL, one.model.name())
                .put(field::RMS_LEFT_OUT, fit.and_then(|fit| fit.left_out))
                .put(field::BIC, fit.map(|fit| fit.bic))
                .put(field::NOT_IDENTIFIED, why.map(ToString::to_string));
            record
        };
        self.found.tried.iter().map(of).collect()
    }

    fn correlation(&self) -> Value {
        self.found.correlation.row_iter().map(|row| json!(row.iter().collect::<Vec<_>>())).collect()
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("identify", super::ORIGIN, &self.record())
    }

    /// One row per drive, for a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        Rows::of(&shape::IDENTIFIED_DRIVE, self.drives())
    }

    /// The robot file with what was identified; `None` where no drive was.
    pub fn robot_file(&self) -> Option<String> {
        (self.found.robot != self.found.known).then(|| write(&self.found.robot))
    }

    /// What stands above the drives: what was measured, and how well it is explained.
    pub fn summary(&self) -> Table {
        let found = &self.found;
        let mm = |metres: f64| format!("{} mm", fixed(metres * 1e3, 3));
        let percent = |share: f64| format!("{} %", fixed(100.0 * share, 1));
        let date = self.date.as_ref().map_or_else(String::new, |date| format!(", measured {date}"));
        let method = match found.estimator {
            Estimator::LeastSquares => {
                "least squares; beside it Huber's estimate, in which what fits badly counts less"
            }
            Estimator::Huber => "Huber's estimate: what fits badly counts less",
        };
        let mut lines: Vec<Line> = vec![
            line("robot", words::robot(&self.before)),
            line(
                "measurements",
                format!("{} rows in {} postures, {}{date}", found.residuals.len(), found.postures, self.data),
            ),
            line("fit", format!("{method}; {}, everything else is rigid", springing(found.model))),
            line("a coordinate moved", format!("{} root mean square", mm(found.before))),
            line("not explained", format!("{}; explained {}", mm(found.after), percent(found.explained()))),
            line(
                "the same left out",
                match found.left_out.zip(found.explained_left_out()) {
                    Some((left_out, explained)) => {
                        format!("{}; explained {}, each posture by the others", mm(left_out), percent(explained))
                    }
                    None => "not known: one posture alone shows some drive".into(),
                },
            ),
        ];
        if !found.tried.is_empty() {
            let each = found.tried.iter().map(|one| {
                let name = one.model.name();
                match &one.fit {
                    Ok(fit) => {
                        let left_out = fit.left_out.map_or_else(|| "-".into(), mm);
                        format!("{name} {left_out} (BIC {})", fixed(fit.bic, 0))
                    }
                    Err(why) => format!("{name} not fitted ({why})"),
                }
            });
            let each = each.collect::<Vec<_>>().join(", ");
            lines.push(line("models, left out", format!("{each}: {} chosen", found.model.name())));
        }
        lines.extend(
            found
                .noise_ratio
                .map(|ratio| line("against the noise given", format!("{} times as much remains", fixed(ratio, 2)))),
        );
        let condition = found.condition();
        let condition =
            if condition.is_finite() { format!("condition {}; ", fixed(condition, 0)) } else { String::new() };
        lines.push(line("seen worst", format!("{condition}{}", self.least_seen())));
        lines.push(line("do not fit", self.outliers()));
        Table::of_lines(lines).led_by(["not explained", "fit"], "not explained by the drives as found", &[])
    }

    /// One row per drive.
    pub fn table(&self) -> Table {
        let headings = [
            "drive",
            "found urad/(N m)",
            "95 % interval",
            "error",
            "stiffness MN m/rad",
            "Huber urad/(N m)",
            "robot file urad/(N m)",
            "identified",
        ];
        let mut table = Table::new(headings).with_room(1, &["Huber urad/(N m)", "stiffness MN m/rad"]);
        for estimate in &self.found.estimates {
            let (unit, factor) = unit_of(estimate.spring);
            let urad = |k: f64| digits(k * factor, 3).to_string();
            let or_none = |text: Option<String>| text.unwrap_or_else(|| "-".into());
            let relative = estimate
                .compliance
                .zip(estimate.standard_error)
                .map(|(k, error)| format!("{} %", fixed(100.0 * error / k, 0)));
            let compliance = estimate.compliance.filter(|k| estimate.spring.is_compliance() && 0.0 < *k);
            let stiffness = compliance.map(f64::recip);
            let says = estimate
                .unknown
                .as_ref()
                .map_or_else(|| "yes".into(), |why| format!("no: {}", in_words(why, &self.found)));
            let name = self.shown(estimate.spring);
            let name = if estimate.spring.is_compliance() { name } else { format!("{name} {unit}") };
            table.row([
                name,
                or_none(estimate.compliance.map(urad)),
                or_none(estimate.interval.map(|[low, high]| format!("{} .. {}", urad(low), urad(high)))),
                or_none(relative),
                or_none(stiffness.map(|stiffness| digits(stiffness * 1e-6, 3).to_string())),
                or_none(estimate.robust.map(urad)),
                urad(estimate.used),
                says,
            ]);
        }
        table
    }

    /// The name of a spring in the table, under the heading drive.
    fn shown(&self, spring: Spring) -> String {
        match spring {
            Spring::Drive(drive) => (drive + 1).to_string(),
            Spring::Region(region) => {
                let [from, to] = self.found.regions[region].map(|angle| fixed(angle.to_degrees(), 0));
                format!("2, joint at {from} .. {to} deg")
            }
            Spring::Base | Spring::Tool | Spring::Compensator | Spring::Preload => spring.name(),
        }
    }

    /// Prior and posterior of each drive, where the prior was updated.
    pub fn updated(&self) -> Option<Table> {
        Some(updated::table(&self.found.posterior.as_ref()?.drives))
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let found = &self.found;
        let mut notes = String::new();
        let others: Vec<&Estimate> = found.estimates.iter().filter(|estimate| estimate.unknown.is_some()).collect();
        if let Some(posterior) = &found.posterior {
            let _ = writeln!(
                notes,
                "prior: drives of robots of this payload and reach, x/: the factor that 90 % stay within; moved: by the measurements, in standard \
                 deviations of the prior; learned: what part of its variance they took away. A coordinate was taken to scatter by {} mm ({} times what rows \
                 alone say, as those of a posture err together); the robot file has the posterior: {} mm are then not explained",
                fixed(posterior.sigma * 1e3, 3),
                fixed(posterior.clustering, 2),
                fixed(found.after_used * 1e3, 3),
            );
        } else if !others.is_empty() {
            let names: Vec<String> = others.iter().map(|estimate| estimate.spring.name()).collect();
            let keep = if names.len() == 1 { "keeps" } else { "keep" };
            let _ = writeln!(
                notes,
                "{} {keep} in the robot file what was known before ({}), and the others are found again beside that: {} mm are then not explained",
                names.join(", "),
                stiffness(&found.known),
                fixed(found.after_used * 1e3, 3),
            );
        }
        notes += "error: standard error, the larger of that from the scatter of all remainders and that from leaving out each posture in turn; \
                  beyond 50 % a drive is not identified\n";
        notes += match found.model {
            Springs::Base | Springs::Tool | Springs::All => {
                "a robot file has drives alone: base and tool are reported here, so that the drives are not blamed for them\n"
            }
            Springs::Regions => {
                "a robot file has one compliance of drive 2: that of the model drives; regions are reported here\n"
            }
            Springs::Compensator | Springs::Preload => {
                "error of the compensator: beside that of drive 2, which pulls at the same joint; its ends are those of the robot file\n"
            }
            Springs::Drives | Springs::Auto => "",
        };
        for remark in &found.remarks {
            let _ = writeln!(notes, "{remark}");
        }
        notes += &self.read_as();
        let writes = if self.robot_file().is_some() { "-o robot.toml writes the robot file, " } else { "" };
        notes + writes + "-o fit.svg, .png or .pdf draws what remains\n"
    }

    /// How the joint angles of the table were read.
    fn read_as(&self) -> String {
        if words::pendant(&self.before).is_none() {
            return String::new();
        }
        format!(
            "the joints of {} are read as the robot file counts them; it is not known whether the pendant shows the same zeros, signs and joint 3: \
             if the joints were read there, compare one posture\n",
            self.data
        )
    }

    /// The readings that do not fit, the worst first; `None` where all do.
    pub fn outlier_table(&self) -> Option<Table> {
        let found = &self.found;
        let mm = |metres: f64| fixed(metres * 1e3, 3);
        let mut table = Table::new(["row", "posture", "moved [mm]", "not explained [mm]", "beyond the others"]);
        for outlier in &found.outliers {
            let of_row = found.residuals.iter().find(|one| one.row == outlier.row);
            let cell = |value: &dyn Fn(&Residual) -> String| of_row.map_or_else(|| "-".into(), value);
            table.row([
                outlier.row.to_string(),
                cell(&|one| (one.posture + 1).to_string()),
                cell(&|one| mm(one.moved.norm())),
                cell(&|one| mm(one.after.norm())),
                format!("{} sigma", fixed(outlier.ratio, 1)),
            ]);
        }
        (!table.rows.is_empty()).then_some(table)
    }

    /// The combination of drives that is seen worst, its parts above a tenth.
    fn least_seen(&self) -> String {
        let parts = self.found.least_seen.iter().zip(&self.found.estimates).filter(|(part, _)| 0.01 < part.powi(2));
        let mut parts: Vec<(f64, String)> = parts.map(|(part, estimate)| (*part, estimate.spring.name())).collect();
        parts.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
        match parts.as_slice() {
            [(_, name)] => format!("{name} alone"),
            parts => {
                let first = parts.first().map_or(1.0, |(part, _)| *part);
                let terms = parts.iter().map(|(part, name)| format!("{} x {name}", fixed(part / first, 2)));
                format!("{} together", terms.collect::<Vec<_>>().join(", "))
            }
        }
    }

    fn outliers(&self) -> String {
        let outliers = &self.found.outliers;
        if outliers.is_empty() {
            return "no row stands out".into();
        }
        let named = outliers
            .iter()
            .take(MOST_NAMED)
            .map(|outlier| format!("row {} ({} sigma)", outlier.row, fixed(outlier.ratio, 1)));
        let more = outliers.len().saturating_sub(MOST_NAMED);
        let more = if more == 0 { String::new() } else { format!(", and {more} more") };
        format!("{}{more}: look what was different there", named.collect::<Vec<_>>().join(", "))
    }
}

/// What springs, in words.
pub(super) fn springing(model: Springs) -> &'static str {
    match model {
        Springs::Drives | Springs::Auto => "the drives spring",
        Springs::Base => "the drives spring and the base tilts",
        Springs::Tool => "the drives spring and the tool bends",
        Springs::All => "the drives spring, the base tilts and the tool bends",
        Springs::Compensator => "the drives and the gravity compensator spring",
        Springs::Preload => "the drives and the gravity compensator spring, which has a preload",
        Springs::Regions => "the drives spring, drive 2 in each region of joint 2 by itself",
    }
}

/// In which unit a spring is reported, and how many of it are one in SI.
const fn unit_of(spring: Spring) -> (&'static str, f64) {
    match spring {
        Spring::Compensator => ("N/mm", 1e-3),
        Spring::Preload => ("N", 1.0),
        _ => ("urad/(N m)", 1e6),
    }
}

/// What is found of a spring.
fn put_estimate(record: &mut Record, estimate: &Estimate, found: &Identification) {
    let why = estimate.unknown.as_ref().map(|why| in_words(why, found));
    record
        .put(field::ESTIMATE, estimate.compliance)
        .put(field::STANDARD_ERROR, estimate.standard_error)
        .put(field::INTERVAL, estimate.interval)
        .put(field::STIFFNESS, estimate.compliance.filter(|k| 0.0 < *k).map(f64::recip))
        .put(field::ROBUST, estimate.robust)
        .put(field::IS_IDENTIFIED, estimate.unknown.is_none())
        .put(field::NOT_IDENTIFIED, why)
        .put(field::USED, estimate.used);
}

/// Why a drive is not identified.
fn in_words(why: &Unknown, found: &Identification) -> String {
    match why {
        Unknown::NotTurned => "no load turns it".into(),
        Unknown::NotMoved => "no marker moves when it turns".into(),
        Unknown::OnlyWith(others) => {
            let names: Vec<String> = others.iter().map(|&i| found.estimates[i].spring.name()).collect();
            format!("only a sum with {} shows", names.join(", "))
        }
        Unknown::Rigid => "the best fit leaves it rigid".into(),
        Unknown::OnePosture => "one posture alone shows it".into(),
        Unknown::Uncertain(relative) => format!("the error is {} % of it", fixed(100.0 * relative, 0)),
    }
}

fn residual(one: &Residual) -> Record {
    let mut record = Record::of(&shape::READING_RESIDUAL);
    record
        .put(field::READING, one.row)
        .put(field::OF_POSTURE, one.posture + 1)
        .put(field::MEASURED, one.moved.as_slice())
        .put(field::REMAINS, one.after.as_slice())
        .put(field::LEFT_OUT, one.left_out.map(|missed| missed.norm()))
        .put(field::RATIO, one.ratio);
    record
}
