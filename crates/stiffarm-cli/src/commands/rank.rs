//! `stiffarm rank`: robots in order, for several tasks, against a tolerance.

use std::cell::OnceCell;
use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use stiffarm::drive::Architecture;
use stiffarm::place::{Outside, PlaceOptions};
use stiffarm::rank::{PlanarCell, Ranking, Row, curves, is_not_of_the_plane, rank};
use stiffarm::report;
use stiffarm::request::{Request, distinct};
use stiffarm::robot::{Robot, Status};
use stiffarm::task::{Task, Zone};

use super::place::{CELL_COLUMNS, cell_row};
use super::sheet::{ASSUMED_ARCHITECTURE, architecture};
use super::{progress, spatial};
use crate::args::Common;
use crate::failure::Failure;
use crate::figures::ranking::{self, Curve, Panel};
use crate::output::{Answer, Outputs, figure, pretty};
use crate::selection;
use crate::table::{Table, fixed, full, prose};

/// Sizes along each curve of the figure.
const CURVE_POINTS: usize = 40;

/// More curves than this cannot be told apart.
const MOST_DRAWN: usize = 24;

/// A remark names no more robots than this.
const MOST_NAMED: usize = 12;

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let names = asked.robots();
    let robots = selection::robots(&names, common)?;
    let robots = selection::keep(robots, asked, &[]).map_err(|failure| widened(failure, &names))?;
    let given = asked.tasks();
    let tasks = distinct(&given);
    let first = given.first().ok_or_else(|| Failure::Usage("no task to rank for; give --task".into()))?;
    if asked.is_spatial() {
        return spatial::rank::run(&robots, &tasks, asked, common);
    }
    let outputs = Outputs::open::<RankAnswer>(common, &inputs(&names))?;
    let options = asked.wanted().planar(first.zone);
    let bar = progress(robots.len() * tasks.len(), "placing zones", common);
    let ranking = rank(&robots, &tasks, &options, || bar.inc(1))?;
    bar.finish_and_clear();
    let answer = RankAnswer { ranking, options, tolerance_mm: asked.tolerance_mm(), common, svg: OnceCell::new() };
    outputs.deliver(&answer)
}

/// What may be files among the robots.
pub(crate) fn inputs(robots: &[String]) -> Vec<&Path> {
    robots.iter().map(|robot| Path::new(robot.trim())).collect()
}

/// Where only the paper's robots were asked, there are more.
fn widened(failure: Failure, robots: &[String]) -> Failure {
    match failure {
        Failure::NothingLeft { asked, of, hint } if robots == ["paper"] => {
            let hint = format!("{hint}; these are the paper's ten, --robots all takes every robot");
            Failure::NothingLeft { asked, of, hint }
        }
        other => other,
    }
}

struct RankAnswer<'a> {
    ranking: Ranking,
    options: PlaceOptions,
    tolerance_mm: Option<f64>,
    common: &'a Common,
    svg: OnceCell<String>,
}

impl RankAnswer<'_> {
    fn tolerance_mm(&self) -> Option<f64> {
        self.tolerance_mm
    }

    /// `1.234`, marked when it is the best of its column, with the margin where a tolerance is given.
    fn cell(&self, row: &Row, task: usize) -> String {
        let Some(deflection) = row.deflection(task) else {
            return match &row.cells[task] {
                Ok(_) => "-".into(),
                Err(error) if is_not_of_the_plane(error) => "n/a".into(),
                Err(_) => "?".into(),
            };
        };
        let is = |best: Option<&Row>| best.is_some_and(|best| best.robot == row.robot);
        let published = self.ranking.best_published(task);
        let beats =
            row.robot.status == Status::Estimated && is(self.ranking.best(task, |_| true)) && published.is_some();
        let mark = if is(published) {
            "*"
        } else if beats {
            "~"
        } else {
            ""
        };
        let millimetres = deflection * 1e3;
        let verdict = self.tolerance_mm().map_or_else(String::new, |tolerance| {
            let margin = tolerance - millimetres;
            format!(" {} {margin:+.3}", if 0.0 <= margin { "pass" } else { "fail" })
        });
        format!("{}{mark}{verdict}", fixed(millimetres, 3))
    }

    fn notes(&self) -> String {
        let statuses: Vec<Status> = self.ranking.rows.iter().map(|row| row.robot.status).collect();
        let mut notes = String::from("* best of the robots of which no number is assumed");
        if statuses.contains(&Status::Estimated) {
            notes += "; ~ estimated robot: it cannot win, even where its value is smaller";
        }
        notes += "; - the zone does not fit (`stiffarm place` says why)\n";
        for row in &self.ranking.rows {
            if let Some(error) = row.why_not_of_the_plane() {
                let _ = writeln!(notes, "n/a {}: {error} (--model spatial)", row.robot.name);
            }
        }
        let unfinished = |cell: &PlanarCell| cell.as_ref().is_err_and(|error| !is_not_of_the_plane(error));
        if self.ranking.rows.iter().any(|row| row.cells.iter().any(unfinished)) {
            notes += "? the search for a place did not end; `stiffarm place` says between which values\n";
        }
        notes += &self.overloaded();
        notes += &self.below_base();
        if self.ranking.rows.iter().any(|row| row.robot.architecture_is_assumed) {
            notes += ASSUMED_ARCHITECTURE;
        }
        notes += "bound: deflection at the stiffest posture of the links; no placement of any task has less\n";
        if statuses.contains(&Status::Derived) {
            notes += "derived: partly from published figures of the same or a sister model\n";
        }
        if statuses.contains(&Status::Estimated) {
            notes += "estimated: lengths or limits partly assumed, see `stiffarm robots show NAME`\n";
        }
        notes
    }

    /// Counts the robots of which the force is more than the weight they are sold to carry.
    fn overloaded(&self) -> String {
        let held = self.options.force / 9.81;
        let rows = &self.ranking.rows;
        let count = rows.iter().filter(|row| row.robot.payload_kg.is_some_and(|kg| kg < held)).count();
        if count == 0 {
            return String::new();
        }
        let (of, least) = (rows.len(), held.ceil());
        format!(
            "{count} of {of} robots are sold for less than this force ({held:.0} kg), and the usual 1 urad/(N m) per drive is that of \
             heavy robots: --payload-kg {least}.. leaves them out\n"
        )
    }

    /// Names the places that lie partly below the base: reached, but rarely meant.
    fn below_base(&self) -> String {
        let mut found = Vec::new();
        for row in &self.ranking.rows {
            let below: Vec<&str> = (0..row.cells.len())
                .filter(|&task| {
                    let zone = self.ranking.tasks[task].zone;
                    row.placement(task).is_some_and(|placement| Outside::of(&row.robot, zone, placement).below)
                })
                .map(|task| self.ranking.tasks[task].label.as_str())
                .collect();
            if !below.is_empty() {
                found.push(format!("{} on {}", row.robot.name, below.join(", ")));
            }
        }
        if found.is_empty() {
            return String::new();
        }
        let more = found.len().saturating_sub(MOST_NAMED);
        found.truncate(MOST_NAMED);
        let more = if more == 0 { String::new() } else { format!("; and {more} robots more") };
        format!("zones partly below the base (--within=..,0.. keeps them above): {}{more}\n", found.join("; "))
    }

    fn figure(&self) -> Result<String, Failure> {
        let rows = &self.ranking.rows;
        let robots: Vec<Robot> = rows.iter().take(MOST_DRAWN).map(|row| row.robot.clone()).collect();
        let shapes = shapes(&self.ranking.tasks);
        let bar = progress(shapes.len() * robots.len() * CURVE_POINTS, "drawing curves", self.common);
        let mut panels = Vec::new();
        for (shape, marks) in shapes {
            let largest = 1.01 * largest_scale(&robots, shape.zone);
            let scales: Vec<f64> = (1..=CURVE_POINTS).map(|i| largest * i as f64 / CURVE_POINTS as f64).collect();
            let options = PlaceOptions { gap: self.options.gap.max(1e-3), ..self.options };
            let values = curves(&robots, &shape, &scales, &options, || bar.inc(1))?;
            let curves = robots.iter().zip(values).map(|(robot, curve)| Curve {
                robot: robot.name.clone(),
                serial: robot.architecture == Architecture::Serial,
                estimated: robot.status == Status::Estimated,
                points: curve.points.into_iter().map(|(scale, deflection)| (scale, deflection * 1e3)).collect(),
                is_complete: curve.is_complete,
            });
            panels.push(Panel {
                title: shape.label.clone(),
                size_label: "d [m]".into(),
                curves: curves.collect(),
                marks,
                tolerance_mm: self.tolerance_mm(),
            });
        }
        bar.finish_and_clear();
        let chosen = if rows.len() == robots.len() {
            String::new()
        } else {
            format!("; the first {MOST_DRAWN} of {} robots", rows.len())
        };
        let title = format!("Worst deflection at the best place under {} N, planar model{chosen}", self.ranking.force);
        ranking::svg(&title, &panels).map_err(figure)
    }
}

/// The distinct shapes among the tasks, at a first side of 1 m, with the first sides asked for.
fn shapes(tasks: &[Task]) -> Vec<(Task, Vec<f64>)> {
    let mut shapes: Vec<(Task, Vec<f64>)> = Vec::new();
    for task in tasks {
        let [first, second] = task.zone.sides();
        let ratio = second / first;
        let (label, zone) = match task.zone {
            Zone::Circle { .. } => ("Circle of diameter d".to_owned(), Zone::Circle { diameter: 1.0 }),
            Zone::Rectangle { .. } => {
                let times = format!("{ratio:.3}");
                let times = times.trim_end_matches('0').trim_end_matches('.');
                let long = if times == "1" { "d".to_owned() } else { format!("{times} d") };
                (format!("Rectangle of d x {long}"), Zone::Rectangle { width: 1.0, height: ratio })
            }
        };
        match shapes.iter_mut().find(|(shape, _)| shape.label == label) {
            Some((_, marks)) => marks.push(first),
            None => shapes.push((Task { label, zone }, vec![first])),
        }
    }
    shapes
}

/// Beyond this scale no robot's links hold the zone.
fn largest_scale(robots: &[Robot], zone: Zone) -> f64 {
    robots
        .iter()
        .filter_map(|robot| robot.arm_plane().ok()) // others have no curve
        .map(|plane| stiffarm::place::largest_scale_without_limits(&plane.arm, zone))
        .fold(0.0, f64::max)
}

impl Answer for RankAnswer<'_> {
    const COMMAND: &'static str = "rank";
    const FURTHER: &'static [&'static str] = &["svg", "png"];

    fn text(&self, markdown: bool) -> String {
        let Ranking { tasks, force, rows } = &self.ranking;
        let mut headings =
            vec!["#".to_owned(), "robot".into(), "architecture".into(), "status".into(), "bound mm".into()];
        headings.extend(tasks.iter().map(|task| format!("{} mm", task.label)));
        headings.push("mean ratio".into());
        let mut table = Table::new(headings);
        for (row, place) in rows.iter().zip(self.ranking.places()) {
            let robot = &row.robot;
            let estimated = robot.status == Status::Estimated;
            let none = if estimated { "~" } else { "n/a" };
            let mut cells = vec![
                place.map_or_else(|| none.to_owned(), |place| place.to_string()),
                format!("{}{}", robot.full_name(), if estimated { " ~" } else { "" }),
                architecture(robot),
                robot.status.to_string(),
                row.floor(*force).map_or_else(|| "n/a".to_owned(), |floor| fixed(floor * 1e3, 3)),
            ];
            cells.extend((0..tasks.len()).map(|task| self.cell(row, task)));
            cells.push(if row.score.is_finite() { fixed(row.score, 3) } else { "-".into() });
            table.row(cells);
        }
        let gap = self.options.gap;
        format!(
            "Worst deflection inside each zone at its best place, {force} N in the worst direction, planar model; proved to {gap}\n\n\
             {}\n{}\n{}\n",
            table.text(markdown),
            prose(&self.notes(), markdown),
            prose(&report::rank::sentences(&self.ranking, self.tolerance_mm()).join("\n"), markdown)
        )
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &report::rank::ranking(&self.ranking, &self.options, self.tolerance_mm()))
    }

    fn csv(&self) -> Table<'_> {
        let mut table = Table::new(["rank", "bound_mm"].into_iter().chain(CELL_COLUMNS));
        for (row, place) in self.ranking.rows.iter().zip(self.ranking.places()) {
            for (task, cell) in self.ranking.tasks.iter().zip(&row.cells) {
                let rank = place.map_or_else(String::new, |place| place.to_string());
                let mut cells = vec![rank, full(row.floor(self.ranking.force).map(|floor| floor * 1e3))];
                cells.extend(cell_row(&row.robot, task, &self.options, cell.as_ref(), self.tolerance_mm()));
                table.row(cells);
            }
        }
        table
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        if let Some(svg) = self.svg.get() {
            return Some(Ok(svg.clone()));
        }
        Some(self.figure().map(|svg| self.svg.get_or_init(|| svg).clone()))
    }
}
