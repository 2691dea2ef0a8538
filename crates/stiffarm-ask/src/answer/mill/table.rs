//! A path that is milled, as people read it.

use super::super::cell as cell_report;
use super::super::margins;
use super::super::path::within;
use super::super::stiffness::{self, stiffness};
use super::super::verdict::HOLDS;
use super::super::words::{degrees, percentages, robot as named, tool};
use super::super::{Line, Table, fixed, line, uncertainty};
use super::{Compensation, MillAnswer, least};
use stiffarm::cell::Cell;
use stiffarm::mill::{Acting, ErrorPart, Followed, MillOptions, PathGround, PathResolution, Remaining, RollMode};
use stiffarm::place::Within;

const LARGEST_ERROR: &str = "largest error";
/// The line that says why.
pub(super) const NOT_FOLLOWED: &str = "not followed";

impl MillAnswer {
    /// For people.
    pub fn table(&self) -> Table {
        let mut lines: Vec<Line> = vec![
            line("robot", named(&self.robot)),
            line(stiffness::LINE, stiffness(&self.robot)),
            line("tool", tool(&self.flange_from_tool)),
            line("path", self.length()),
        ];
        let in_mm = |extent| {
            let [x, y, z] = within(extent);
            format!("x {x}, y {y}, z {z}")
        };
        lines.extend(self.survey.extent.map(|extent| line("feed moves within", in_mm(extent))));
        lines.extend(self.survey.rapid_extent.map(|extent| {
            let length = fixed(self.survey.rapid_length * 1e3, 3);
            line("rapid moves", format!("{length} mm, ending within {}", in_mm(extent)))
        }));
        lines.extend([line("force on the tool", &self.force), line("what counts", counted(self.options.part))]);
        lines.extend(self.carried().lines());
        lines.push(line("keeps", self.kept()));
        lines.extend(self.place_lines());
        match self.followed() {
            None => lines.extend(self.reason().map(|reason| line(NOT_FOLLOWED, reason))),
            Some(found) => lines.extend(self.lines(found)),
        }
        lines.extend(self.remarks.iter().map(|remark| line("note", remark)));
        let (decides, means) = match self.followed() {
            Some(_) => (LARGEST_ERROR, "largest error of the tool along the path"),
            None => (NOT_FOLLOWED, "why the path is not followed"),
        };
        Table::of_lines(lines).led_by([decides, stiffness::LINE], means, &[])
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
            self.along(),
            metres("length_m"),
            metres("cutting_length_m"),
            self.stations.len()
        )
    }

    pub(in crate::answer) fn kept(&self) -> String {
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

    /// The cell, where there is one.
    pub(super) fn in_cell(&self) -> impl Iterator<Item = Line> {
        let PathGround { within, cell, .. } = self.ground;
        // Where the place is given, windows are none.
        let is_searched = self.search.is_some();
        let lines = cell.map(|cell| cell_report::lines(&cell, &within.unwrap_or(Within::ANYWHERE)));
        lines.into_iter().flatten().filter(move |[name, _]| is_searched || name != cell_report::WINDOW)
    }

    fn place_lines(&self) -> Vec<Line> {
        let PathGround { margins, cell, .. } = self.ground;
        let mut lines: Vec<Line> = self.in_cell().collect();
        let column = margins::column(&margins, &self.robot).filter(|_| self.search.is_some());
        lines.extend(column.map(|kept| line("the path keeps", kept)));
        let Some(placement) = self.placement else { return lines };
        let name = if self.search.is_some() { "best place of its origin" } else { "its origin stands at" };
        let place = |[x, y, z]: [f64; 3], from: &str, yaw: Option<f64>| {
            let turned = yaw.map_or_else(String::new, |yaw| format!(", turned by {}", degrees(yaw)));
            format!("x {} m, y {} m, z {} m {from}{turned}", fixed(x, 4), fixed(y, 4), fixed(z, 4))
        };
        lines.push(line(name, place(placement.at_from_base(), "from the base", placement.yaw_from_ahead())));
        if cell.is_some() {
            lines.push(line(format!("{name}, cell"), place(placement.at, "in the cell", Some(placement.yaw))));
        }
        lines
    }

    fn lines(&self, found: &Followed) -> Vec<Line> {
        let (station, pushed) = (&self.stations[found.worst.1], &found.samples[found.worst.1]);
        let mm = |metres: f64| format!("{} mm", fixed(metres * 1e3, 4));
        let at = if station.sample.line == 0 { String::new() } else { format!(", line {}", station.sample.line) };
        let mut lines = vec![
            line(
                LARGEST_ERROR,
                format!("{} at {} mm of the way{at}", mm(found.worst.0), fixed(station.sample.way * 1e3, 1)),
            ),
            line("root mean square", mm(found.rms)),
        ];
        lines.extend(self.fed_back.as_ref().map(|found| {
            let back = format!(
                "from round to round of displacement and cut it shrinks to {} %",
                fixed(100.0 * found.contraction, 1)
            );
            let text = match found.unsettled {
                0 => format!("{}: {back}", mm(found.worst)),
                count => format!("DOES NOT SETTLE at {count} samples: {back}, the tool is drawn in"),
            };
            line("as the cut changes by it", text)
        }));
        lines.extend(uncertainty::row(&self.robot, self.spread()));
        let gap = |lower: f64| if 0.0 < found.worst.0 { 100.0 * (1.0 - lower / found.worst.0) } else { 0.0 };
        let proved = |lower: f64| format!("{} (gap {} %)", mm(lower), fixed(gap(lower), 2));
        lines.push(line(format!("lower bound {}", self.which_rolls()), proved(found.lower_bound)));
        if let Some((resolution, lower)) = self.search {
            let PathResolution { coarse, step, samples, nodes } = resolution;
            let text = if 0.0 < lower {
                format!("{}, by {nodes} boxes of places", proved(lower))
            } else {
                format!("not proved: {nodes} boxes of places are too few for a bound")
            };
            lines.push(line("proved lower bound", text));
            lines.extend(self.ground.cell.as_ref().and_then(proof_of));
            let step = fixed(step * 1e3, 1);
            let search =
                format!("{}, the best refined to {step} mm; by {samples} samples, then by all", counted_places(coarse));
            lines.push(line("search", search));
        }
        let json = self.roll().json();
        let angle = |key: &str| json[key].as_f64().map_or_else(String::new, |angle| format!("{} deg", fixed(angle, 1)));
        let turned = match self.options.roll {
            RollMode::Free | RollMode::Linear => {
                format!("{}, {} to {}", self.options.roll.name(), angle("from_deg"), angle("to_deg"))
            }
            RollMode::Constant | RollMode::Fixed(_) => format!("{}, {}", self.options.roll.name(), angle("from_deg")),
        };
        lines.push(line(
            "roll",
            format!("{turned}, of the tool's x axis from the part's, clockwise seen from the spindle"),
        ));
        let pinned: Vec<String> = (self.pins())
            .map(|(_, station, roll)| format!("{} at {} mm", degrees(roll), fixed(station.sample.way * 1e3, 1)))
            .collect();
        if !pinned.is_empty() {
            lines.push(line("roll pinned to", pinned.join(", ")));
        }
        let again = json["rearranged"].as_u64().unwrap_or(0);
        let how = if again == 0 {
            "all along".into()
        } else {
            format!("at first; arranged anew {again} times, clear of the work")
        };
        lines.push(line("configuration", format!("{} {how}", found.samples[0].arrangement.configuration)));
        lines.extend(pushed.shares.as_ref().map(|shares| line("share of drives 1-6 there", percentages(shares))));
        let margins =
            [least(found, |pushed| pushed.limit_margin), least(found, |pushed| pushed.singular_margin)].map(degrees);
        lines.push(line(
            "smallest margins",
            format!("{} to a joint limit, {} to a straight posture", margins[0], margins[1]),
        ));
        lines.extend(self.clearance_lines());
        if let Some((tolerance, verdict)) = self.tolerance_mm.zip(self.verdict()) {
            let margin = fixed(verdict.margin_mm, 4);
            let exceeded =
                self.geometry_exceeds(tolerance, (found.worst.0, self.p95()), false).filter(|_| verdict.passes);
            let alone = match exceeded.map(|exceeded| exceeded.is_likely) {
                Some(true) => "; with the geometry (below) it is more",
                Some(false) => "; with the geometry (below) it may be more",
                None => "",
            };
            lines.push(line("tolerance", format!("{tolerance} mm: {}, margin {margin} mm{alone}", verdict.in_words())));
            if !verdict.passes && 0 < station.sample.line {
                let over =
                    self.stations.iter().zip(&found.samples).filter(|(_, pushed)| tolerance < pushed.error * 1e3);
                let lines_over: std::collections::BTreeSet<usize> =
                    over.map(|(station, _)| station.sample.line).collect();
                let numbers: Vec<String> = lines_over.iter().take(8).map(ToString::to_string).collect();
                let more =
                    if 8 < lines_over.len() { format!(" and {} more", lines_over.len() - 8) } else { String::new() };
                lines.push(line("lines over it", format!("{}{more}", numbers.join(", "))));
            }
        }
        lines.extend(self.chatter_lines());
        lines.extend(self.arm_lines());
        lines.extend(self.compensation.iter().flat_map(|compensation| self.compensated_lines(compensation)));
        lines
    }

    /// What compensation does, as people read it.
    fn compensated_lines(&self, compensation: &Compensation) -> Vec<Line> {
        let Compensation { done, remaining } = compensation;
        let mm = |metres: f64| format!("{} mm", fixed(metres * 1e3, 4));
        let by_tips = if done.by_tips().is_finite() { mm(done.by_tips()) } else { "not reached".into() };
        let mut lines = vec![
            line("compensated", format!("tips are led aside by at most {}", mm(done.largest))),
            line(
                "left, by the model",
                format!("{} where joints or poses are commanded, {by_tips} where tips alone are", mm(done.by_joints)),
            ),
        ];
        match remaining {
            Some((Remaining { median, p95, all, .. }, what)) => {
                let text = format!("{}; {} ({} draws of {what})", mm(*median), mm(*p95), all.len());
                lines.push(line(EXPECTED_RESIDUAL, text));
                let verdict = self.tolerance_mm.zip(self.compensated_verdict());
                lines.extend(verdict.map(|(tolerance, verdict)| {
                    line("tolerance, compensated", format!("{tolerance} mm: {}", verdict.in_words()))
                }));
            }
            None => lines.push(line(
                EXPECTED_RESIDUAL,
                "not known: the drive stiffness has no stated uncertainty; --stiffness-uncertainty states one",
            )),
        }
        if let Some(first) = done.beyond.first() {
            let at = self.stations[*first].sample.line;
            let text = format!(
                "{} samples command a joint beyond its range, the first at line {at}: no program is written",
                done.beyond.len()
            );
            lines.push(line("BEYOND LIMITS", text));
        }
        lines
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let force = if self.stations.iter().any(|station| matches!(station.acting, Some(Acting::Any(_)))) {
            "the force points in its worst direction at every sample"
        } else {
            "a robot follows the mean force over a revolution; the teeth cut far more often than it can follow"
        };
        let holds = self.tolerance_mm.map_or_else(String::new, |_| format!("{HOLDS}\n{}", self.arm_note()));
        let swings = self.chatter_basis();
        let carrying = cell_report::carrying([&self.robot].into_iter(), self.ground.cell.as_ref());
        format!(
            "{holds}all six drives compliant, everything else rigid; {force}\n{}\n{carrying}{swings}",
            self.looked_at()
        )
    }
}

/// Half of the draws leave no more than the first number, 95 % no more than the second.
const EXPECTED_RESIDUAL: &str = "expected residual (median; 95 %)";

/// Of which places a bound is, where a cell takes some away.
fn proof_of(cell: &Cell) -> Option<Line> {
    if cell.mount.is_vertical() {
        return cell_report::proof(cell);
    }
    Some(line("proof", "of all places in the windows; keep-outs only take places away"))
}

fn counted_places([x, y, z, turned]: [usize; 4]) -> String {
    match y {
        1 => format!("{x} x {z} x {turned} places ahead, up and turned"),
        _ => format!("{x} x {y} x {z} x {turned} places across every window, up and turned"),
    }
}

fn counted(part: ErrorPart) -> &'static str {
    match part {
        ErrorPart::Total => "the whole displacement of the tip",
        ErrorPart::Across => "its part across the feed and the tool axis",
        ErrorPart::Axial => "its part along the tool axis",
        ErrorPart::Normal => "its part along the surface's outward normal",
    }
}
