//! Stations made ready for any language: checked, each place once, cut into parts.

use std::ops::RangeInclusive;

use super::angles::Zyx;
use super::{Language, ProgramFault, Setup, Station, Style};
use crate::plain::on_one_line;
use crate::spatial::Pose;

/// The longest name: two signs and a number are put behind it, and 24 are the most that KRL reads.
const LONGEST_NAME: usize = 16;

/// No joint turns farther, deg: five whole turns and some.
const FARTHEST_DEG: f64 = 2000.0;

/// The fastest move through the air, m/s.
const FASTEST: f64 = 3.0;

/// The widest rounding of a corner, m.
const WIDEST_BLEND: f64 = 0.2;

/// A place, and how fast the way to it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub(super) line: usize,
    /// As reported, rad.
    pub(super) joints: [f64; 6],
    pub(super) part_from_tool: Pose,
    pub(super) angles: Zyx,
    /// m/s; of the first place that of moves through the air.
    pub(super) speed: f64,
    pub(super) is_cutting: bool,
    /// Of the setup's tools.
    pub(super) tool: usize,
}

/// What is written.
pub(super) struct Program<'a> {
    pub(super) setup: &'a Setup<'a>,
    pub(super) style: &'a Style,
    pub(super) steps: Vec<Step>,
    /// The steps of each file: from where its first, in joints, to its last move. A file begins where the one before it ends.
    pub(super) parts: Vec<RangeInclusive<usize>>,
}

impl<'a> Program<'a> {
    /// Checks everything that any language relies on.
    pub(super) fn of(
        language: Language,
        setup: &'a Setup<'a>,
        stations: &[Station],
        style: &'a Style,
    ) -> Result<Self, ProgramFault> {
        check(style, language)?;
        let mut steps: Vec<Step> = Vec::new();
        for (i, station) in stations.iter().enumerate() {
            if setup.tools.len() <= station.tool {
                return Err(ProgramFault::NoTool { line: station.line, tool: station.tool, tools: setup.tools.len() });
            }
            let before = i.checked_sub(1).map(|before| &stations[before]);
            let is_same = before.is_some_and(|before| before.tool == station.tool);
            if !(is_same && before.is_some_and(|before| before.joints == station.joints)) {
                steps.push(step(language, setup, station, style, !is_same)?);
            }
        }
        if steps.len() < 2 {
            return Err(ProgramFault::TooFew { stations: steps.len() });
        }
        let most = style.moves_per_file.filter(|_| language.is_cut_into_files());
        let parts = parts(&steps, most.unwrap_or(usize::MAX));
        Ok(Self { setup, style, steps, parts })
    }

    /// The name of a part, from 1, or of the program itself.
    pub(super) fn name_of(&self, part: Option<usize>) -> String {
        part.map_or_else(|| self.style.name.clone(), |part| format!("{}_{part}", self.style.name))
    }

    /// The tool of a part's step is put in there: with another one than at the step before.
    pub(super) fn change_at(steps: &[Step], i: usize) -> bool {
        0 < i && steps.get(i).is_some_and(|step| step.tool != steps[i - 1].tool)
    }

    /// The tool goes through this place exactly: no way goes on from it.
    pub(super) fn ends_at(steps: &[Step], i: usize) -> bool {
        i + 1 == steps.len() || Self::change_at(steps, i + 1)
    }

    /// What is said where a step's tool is put in.
    pub(super) fn change_to(&self, step: &Step) -> [String; 2] {
        [
            format!("{}: change it by hand, then go on.", self.setup.tools[step.tool].name()),
            "The next move, in joints or to a pose, goes to where it begins; the way there is checked by nobody."
                .into(),
        ]
    }

    /// The parts with their names: one under the program's own, or several under numbers.
    pub(super) fn named_parts(&self) -> impl Iterator<Item = (String, &[Step])> {
        let is_one = self.parts.len() == 1;
        self.parts.iter().enumerate().map(move |(i, part)| {
            let name = self.name_of(if is_one { None } else { Some(i + 1) });
            (name, &self.steps[part.clone()])
        })
    }
}

fn step(
    language: Language,
    setup: &Setup,
    station: &Station,
    style: &Style,
    is_first: bool,
) -> Result<Step, ProgramFault> {
    let Station { line, joints, feed, is_cutting, tool } = *station;
    for (i, &angle) in joints.iter().enumerate() {
        if !(angle.to_degrees().abs() <= FARTHEST_DEG) {
            return Err(ProgramFault::Joint { line, joint: i + 1, angle, most_deg: FARTHEST_DEG });
        }
    }
    // How the first place is reached is not the path's.
    let is_cutting = is_cutting && !is_first;
    let speed = if is_cutting { feed.ok_or(ProgramFault::NoFeed { line })? } else { style.rapid };
    let [least, most] = language.feeds();
    if !(least <= speed && speed <= most) {
        return Err(ProgramFault::Feed { line, feed: speed, least, most, language: language.name() });
    }
    let part_from_tool = setup.part_from_tool(tool, &joints);
    let angles = Zyx::of(&part_from_tool.rotation);
    Ok(Step { line, joints, part_from_tool, angles, speed, is_cutting, tool })
}

fn check(style: &Style, language: Language) -> Result<(), ProgramFault> {
    let name = style.name.as_bytes();
    let is_name = name.first().is_some_and(u8::is_ascii_alphabetic)
        && name.iter().all(|sign| sign.is_ascii_alphanumeric() || *sign == b'_')
        && name.len() <= LONGEST_NAME;
    if !is_name {
        return Err(ProgramFault::Name { name: on_one_line(&style.name).into_owned(), most: LONGEST_NAME });
    }
    let option = |key, value: String, expected| Err(ProgramFault::Option { key, value, expected });
    let [least, most] = language.feeds();
    if !(least <= style.rapid && style.rapid <= most.min(FASTEST) && 0.0 < style.rapid) {
        return option(
            "rapid",
            format!("{} m/s", style.rapid),
            "a speed that the language can say: at most 3 m/s, of a Fanuc 2 m/s",
        );
    }
    if !(0.0..=WIDEST_BLEND).contains(&style.blend) {
        return option("blend", format!("{} mm", style.blend * 1e3), "0 to 200 mm");
    }
    if let Some(moves) = style.moves_per_file.filter(|moves| *moves < 2) {
        return option("moves per file", moves.to_string(), "at least 2");
    }
    if let Some(letters) = &style.fanuc_letters {
        let parts: Vec<&str> = letters.split(' ').collect();
        let fits = matches!(parts[..], [wrist, elbow, front]
            if ["N", "F"].contains(&wrist) && ["U", "D"].contains(&elbow) && ["T", "B"].contains(&front));
        if !fits {
            return option(
                "fanuc letters",
                on_one_line(letters).into_owned(),
                "one of N F, one of U D, one of T B, such as 'N U T'",
            );
        }
    }
    Ok(())
}

/// Cuts the steps into parts of at most so many moves: where the tool moves through the air, if it does so in the later half of a part.
fn parts(steps: &[Step], most: usize) -> Vec<RangeInclusive<usize>> {
    let mut parts = Vec::new();
    let (mut first, last) = (0, steps.len() - 1);
    while most < last - first {
        let farthest = first + most;
        let in_the_air = (first + most.div_ceil(2)..=farthest).rev().find(|&at| !steps[at].is_cutting);
        let end = in_the_air.unwrap_or(farthest);
        parts.push(first..=end);
        first = end;
    }
    parts.push(first..=last);
    parts
}
