//! What does a request ask of a toolpath, and of a process?

use super::cell::CellOptions;
use super::notation::of_tool;
use super::words::BodyUnit;
use super::{Force, Refusal, Request, Verb, opt};
use stiffarm::cell::Block;
use stiffarm::load::Load;
use stiffarm::mill::{Acting, ClearOf, MillOptions, PartPlacement, PathGround, WorkFrame};
use stiffarm::place::PlaceOptions;
use stiffarm::spatial::Pose;
use stiffarm::toolpath::{Builtin, Format, Gathered, Move, ReadOptions, Steps};

/// What may be said of files, and of which: see `toolpath`.
const SILENT_OF: [(&str, &[Format]); 8] = [
    (opt::READ_AS.name, &Format::ALL),
    (opt::UNIT.name, &Format::ALL),
    (opt::ARC_CENTRES.name, &[Format::GCode]),
    (opt::ARC_SENSE.name, &[Format::Apt]),
    (opt::CUTTER_COMPENSATION.name, &[Format::GCode, Format::Apt]),
    (opt::INCREMENTAL_CYCLES.name, &[Format::GCode]),
    (opt::ROTARY.name, &[Format::GCode]),
    (opt::COLUMNS.name, &[Format::Csv]),
];

impl Request {
    /// The toolpath: a file's name, or a path built in.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn path(&self) -> Result<String, Refusal> {
        self.required(opt::PATH)
    }

    /// The one tool of the path whose cuts are meant, where that is said.
    ///
    /// # Panics
    /// Never: the row takes no larger number.
    pub fn only_tool(&self) -> Option<u32> {
        self.get(opt::ONLY_TOOL).map(|number| u32::try_from(number).expect("the row's range is that of a u32"))
    }

    /// The process file's name.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn process(&self) -> Result<String, Refusal> {
        self.given_process().ok_or_else(|| self.missing(opt::PROCESS))
    }

    /// The same, where one is given: that of the tool that is meant, where each has its own.
    pub fn given_process(&self) -> Option<String> {
        let tool = self.only_tool();
        self.processes().into_iter().find(|(of, _)| of.is_none() || *of == tool).map(|(_, name)| name)
    }

    /// Every process file with the number of its tool; without one, it is that of all.
    pub fn processes(&self) -> Vec<(Option<u32>, String)> {
        let named = |text: String| {
            let (tool, name) = of_tool(&text);
            (tool, name.to_owned())
        };
        self.all(opt::PROCESS).into_iter().map(named).collect()
    }

    /// Every tool of the path mills with a process of its own.
    pub fn mills_by_tool(&self) -> bool {
        self.verb == Verb::Mill && self.only_tool().is_none() && self.processes().iter().any(|(tool, _)| tool.is_some())
    }

    /// How far the tips of tools stand out of the spindle, by their numbers, m.
    fn tool_lengths(&self) -> Vec<(u32, f64)> {
        self.all(opt::TOOL_LENGTHS_MM)
    }

    /// The tip of a tool of the path in the flange frame: it stands out of the spindle where lengths are given, else it is where all of
    /// them are.
    ///
    /// # Errors
    /// Where lengths are given, and none of this tool.
    pub fn tip_of(&self, tool: Option<u32>) -> Result<Pose, Refusal> {
        let (lengths, spindle) = (self.tool_lengths(), self.tool_pose().tool());
        if lengths.is_empty() {
            return Ok(spindle);
        }
        let of = lengths.iter().find(|(number, _)| Some(*number) == tool);
        let missing = || self.refused(opt::TOOL_LENGTHS_MM, format!("has no length of {}", tool_name(tool)));
        of.map(|(_, length)| spindle * Pose::translation(0.0, 0.0, *length)).ok_or_else(missing)
    }

    /// That a path stands where a robot can be: farther away m were meant to be mm.
    pub(super) fn check_at(&self) -> Result<(), Refusal> {
        const FARTHEST: f64 = 50.0;
        let Some(at) = self.at().map(|placement| placement.at).filter(|_| self.verb == Verb::Mill) else {
            return Ok(());
        };
        match at.into_iter().find(|metres| FARTHEST < metres.abs()) {
            None => Ok(()),
            Some(metres) => {
                Err(self
                    .refused(opt::AT, format!("has {metres} m; expected m, from -{FARTHEST} to {FARTHEST}, not mm")))
            }
        }
    }

    /// That the mass of the tool is not where it would be if mm were m.
    pub(super) fn check_mass_centre(&self) -> Result<(), Refusal> {
        const NEAREST: f64 = 1.0;
        let centre: Vec<f64> = self.all(opt::TOOL_COM_MM);
        let farthest = centre.iter().fold(0.0, |most: f64, mm| most.max(mm.abs()));
        if farthest == 0.0 || NEAREST <= farthest {
            return Ok(());
        }
        let why = format!("lies {farthest} mm from the flange; expected mm, not m, and one of at least {NEAREST} mm");
        Err(self.refused(opt::TOOL_COM_MM, why))
    }

    /// That processes and lengths by tool say one thing of each tool, and something of every one that mills.
    pub(super) fn check_tools(&self) -> Result<(), Refusal> {
        if self.verb != Verb::Mill {
            return Ok(());
        }
        let tools: Vec<Option<u32>> = self.processes().into_iter().map(|(tool, _)| tool).collect();
        let lengths: Vec<Option<u32>> = self.tool_lengths().into_iter().map(|(tool, _)| Some(tool)).collect();
        for (name, of) in [(opt::PROCESS.name, &tools), (opt::TOOL_LENGTHS_MM.name, &lengths)] {
            if let Some(twice) = (1..of.len()).find(|&i| of[..i].contains(&of[i])) {
                let why = match of[twice] {
                    None => "names several files; expected one, or one for each tool as T1=FILE,T2=FILE".into(),
                    tool => format!("is given twice for {}; expected it once", tool_name(tool)),
                };
                return Err(self.refused(name, why));
            }
        }
        let is_by_tool = tools.iter().any(Option::is_some);
        if is_by_tool && tools.contains(&None) {
            let why = "names one file for all tools and one for a single tool; expected T1=FILE,T2=FILE".to_owned();
            return Err(self.refused(opt::PROCESS, why));
        }
        let only = self.only_tool();
        if is_by_tool && only.is_some_and(|tool| !tools.contains(&Some(tool))) {
            return Err(self.refused(opt::PROCESS, format!("has no file for {}, which mills", tool_name(only))));
        }
        if self.mills_by_tool() {
            return self.check_by_tool(lengths.is_empty());
        }
        only.map_or(Ok(()), |tool| self.tip_of(Some(tool)).map(|_| ()))
    }

    /// What milling with several tools needs, and what it does not go with.
    fn check_by_tool(&self, has_no_lengths: bool) -> Result<(), Refusal> {
        if has_no_lengths && !self.is_dry() {
            let why =
                "is missing; expected how far each tool stands out of the spindle, such as T1=82.5,T2=140".to_owned();
            return Err(self.refused(opt::TOOL_LENGTHS_MM, why));
        }
        for (name, why) in [
            (opt::ROBOTS.name, "ranks robots with one tool; expected only-tool beside processes by tool"),
            (opt::PIN.name, "pins the rolls of one tool; expected only-tool beside processes by tool"),
            (opt::STOCK_MM.name, "follows one tool; expected only-tool beside processes by tool"),
            (opt::FRF.name, "was measured of one tool; expected only-tool beside processes by tool"),
        ] {
            if self.is_given(name) {
                return Err(self.refused(name, why.into()));
            }
        }
        if self.at().is_none() && !self.is_dry() {
            let why = "is missing; expected where the part stands: the best place is found of one tool at a time, with only-tool";
            return Err(self.refused(opt::AT, why.into()));
        }
        Ok(())
    }

    /// What pushes on the tool, where that is said as a force.
    ///
    /// # Errors
    /// A force of zero, or of more than 1 MN.
    pub fn acting(&self) -> Result<Option<Acting>, Refusal> {
        let force = self.get(opt::FORCE_N);
        let Some(force) = force else { return Ok(None) };
        let (acting, load) = match force {
            Force::Size(newtons) => (Acting::Any(newtons), Load::worst(newtons)),
            Force::Along(force) => (Acting::Known { force, moment: 0.0 }, Load::along_tool(force, None)),
        };
        load.map(|_| Some(acting)).map_err(|error| self.refused(opt::FORCE_N, error.to_string()))
    }

    /// Where the path's origin stands, where that is given: in the cell, where the robot is mounted in one.
    pub fn at(&self) -> Option<PartPlacement> {
        let base_from_cell = self.mount().map_or_else(Pose::identity, |mount| mount.cell_from_base.inverse());
        // Whole turns say nothing, and rounded to radians they are none.
        let at = |at: [f64; 3], yaw: f64| Some(PartPlacement { at, yaw: (yaw % 360.0).to_radians(), base_from_cell });
        match *self.all(opt::AT).as_slice() {
            [x, y, z] => at([x, y, z], 0.0),
            [x, y, z, yaw] => at([x, y, z], yaw),
            _ => None,
        }
    }

    /// The corners of the block from which a part is cut, m.
    pub fn stock(&self) -> Option<[[f64; 3]; 2]> {
        let block = self.get(opt::STOCK_MM);
        let Block { x, y, z } = block?;
        let sides = [x, y, z];
        Some([sides.map(|side| side.min() / 1e3), sides.map(|side| side.max() / 1e3)])
    }

    /// What else is asked of a path that is milled.
    ///
    /// # Errors
    /// As [`Request::path_ground`].
    pub fn mill_options(&self) -> Result<MillOptions, Refusal> {
        let PathGround { margins, cell, .. } = self.path_ground()?;
        let clearance = self.get(opt::CLEARANCE_MM).map(|mm| mm / 1e3);
        // Of several robots the bodies are guessed: they are looked at where that is asked, or what they may touch is given.
        let bodies =
            [opt::PART.name, opt::FIXTURE.name, opt::STOCK_MM.name, opt::STICK_OUT_MM.name, opt::KEEP_OUT.name];
        let is_looked_at = !self.ranks_on_path() || bodies.iter().any(|name| self.is_given(name));
        let clearance = clearance.or_else(|| is_looked_at.then_some(0.0));
        let usual = MillOptions::usual();
        let radians = |option, usual: f64| self.get(option).map_or(usual, f64::to_radians);
        Ok(MillOptions {
            roll: self.get(opt::ROLL).unwrap_or(usual.roll),
            part: self.value(opt::ERROR),
            limit_margin: radians(opt::LIMIT_MARGIN_DEG, usual.limit_margin),
            singular_margin: radians(opt::SINGULAR_MARGIN_DEG, usual.singular_margin),
            share_of_speed: self.get(opt::SPEED_SHARE).unwrap_or(usual.share_of_speed),
            tool_weight: self.tool_weight(),
            clear_of: clearance.map(|clearance| {
                let floor = margins.floor;
                ClearOf { clearance, cell, floor, part: None, stock: None, fixture: None, cutter: None }
            }),
        })
    }

    /// The STL file of the part, where one is given.
    pub fn part(&self) -> Option<String> {
        self.get(opt::PART)
    }

    /// The same of what holds it.
    pub fn fixture(&self) -> Option<String> {
        self.get(opt::FIXTURE)
    }

    /// The unit of STL files, m.
    pub fn stl_unit(&self) -> f64 {
        match self.value(opt::PART_UNIT) {
            BodyUnit::Millimetre => 1e-3,
            BodyUnit::Inch => 0.0254,
            BodyUnit::Metre => 1.0,
        }
    }

    /// How far the cutter of a tool of the path stands out of the spindle, m, where that is said.
    pub fn stick_out(&self, tool: Option<u32>) -> Option<f64> {
        let of_tool = |(number, length): (u32, f64)| (Some(number) == tool).then_some(length);
        let given = self.get(opt::STICK_OUT_MM).map(|mm| mm / 1e3);
        given.or_else(|| self.tool_lengths().into_iter().find_map(of_tool))
    }

    /// A program is written although the arm touches something.
    pub fn allows_contact(&self) -> bool {
        self.is_set(opt::ALLOW_CONTACT)
    }

    /// Where along the path the roll is pinned, m, and to which angle, rad.
    pub fn pins(&self) -> Vec<[f64; 2]> {
        self.all(opt::PIN)
    }

    /// How the place of the work was found.
    pub fn work_frame(&self) -> WorkFrame {
        self.get(opt::WORK_FRAME).unwrap_or_default()
    }

    /// The deflection is to be taken out.
    pub fn is_compensated(&self) -> bool {
        self.get(opt::COMPENSATE) == Some(true)
    }

    /// By how much the logarithm of every drive's compliance may be off, where that is said.
    pub fn stiffness_uncertainty(&self) -> Option<f64> {
        self.get(opt::STIFFNESS_UNCERTAINTY)
    }

    /// Where all of a path must stand, and what it keeps besides: what a zone keeps.
    ///
    /// # Errors
    /// A floor beside a cell, which has its own.
    pub fn path_ground(&self) -> Result<PathGround, Refusal> {
        let within = self.ahead();
        let margins = self.margins(within);
        let options = PlaceOptions { within, margins, ..PlaceOptions::under(Load::PAPER) };
        // What a path keeps clear of decides how it is followed, not where it is placed.
        let cell = CellOptions { clearance: None, ..self.cell(self.windows()) };
        let in_cell = cell.of(&options, true).map_err(|unsupported| self.unanswered(unsupported))?;
        let PlaceOptions { margins, within, cell, .. } = in_cell;
        Ok(PathGround { margins, within, cell })
    }

    /// Only what was understood of the path is reported.
    pub fn is_dry(&self) -> bool {
        self.is_set(opt::DRY)
    }

    /// How the path of this name is written: as was said, or as its name ends.
    ///
    /// # Errors
    /// Where neither says it.
    pub fn path_format(&self, name: &str) -> Result<Format, Refusal> {
        // A path built in is not written at all.
        if Builtin::is_meant(name) {
            return Ok(Format::Csv);
        }
        self.get(opt::READ_AS).or_else(|| Format::of_name(name)).ok_or_else(|| {
            let why = Format::not_read(name).map_or_else(
                || format!("does not say by its ending how it is written; expected {}, or read-as", Format::ENDINGS),
                |what| format!("is by its ending {what}"),
            );
            self.refused(opt::PATH, why)
        })
    }

    /// That what is said where a file is silent is said of such a file as this one: a path built in is silent of nothing, and each format
    /// of something else.
    pub(super) fn check_silent(&self) -> Result<(), Refusal> {
        let Some(path) = self.get(opt::PATH).filter(|_| self.verb == Verb::Mill) else { return Ok(()) };
        let format = if Builtin::is_meant(&path) {
            None
        } else {
            // Without a format nothing is read, which is refused where that is.
            let Ok(format) = self.path_format(&path) else { return Ok(()) };
            Some(format)
        };
        for (name, formats) in SILENT_OF {
            let goes = format.is_some_and(|format| formats.contains(&format));
            if self.is_given(name) && !goes {
                let what = format.map_or("a path built in", |format| match format {
                    Format::GCode => "G-code",
                    Format::Apt => "APT",
                    Format::Csv => "a table",
                });
                return Err(self.refused(name, format!("says nothing of {what}; expected it left out")));
            }
        }
        Ok(())
    }

    /// What is said where a file of a path is silent.
    pub fn read_options(&self) -> ReadOptions {
        ReadOptions {
            unit: self.get(opt::UNIT),
            arc_centres: self.get(opt::ARC_CENTRES),
            cutter_compensation: self.value(opt::CUTTER_COMPENSATION),
            incremental_cycles: self.get(opt::INCREMENTAL_CYCLES),
            rotary: self.get(opt::ROTARY),
            arc_sense: self.get(opt::ARC_SENSE),
            columns: self.all(opt::COLUMNS),
            feed: self.get(opt::FEED_MM_PER_MIN).map(|feed| feed / 60e3),
        }
    }

    /// What takes the moves of the path, which may be cut into so many samples.
    pub fn gathered(&self, most_samples: usize) -> Gathered {
        Gathered::new(self.steps(), most_samples)
    }

    /// The moves that were taken, all of them.
    ///
    /// # Errors
    /// Where they are cut into too many samples, by the name of the step.
    pub fn all_moves(&self, gathered: Gathered) -> Result<Vec<Move>, Refusal> {
        gathered.whole().map_err(|error| self.refused(opt::STEP_MM, error.to_string()))
    }

    /// How finely a path is cut into samples.
    pub fn steps(&self) -> Steps {
        let metres = |option, usual: f64| self.get(option).map_or(usual, |mm: f64| mm / 1e3);
        let usual = Steps::USUAL;
        Steps { chord: metres(opt::CHORD_MM, usual.chord), longest: metres(opt::STEP_MM, usual.longest), ..usual }
    }
}

/// A tool as texts name it.
pub(crate) fn tool_name(tool: Option<u32>) -> String {
    tool.map_or_else(|| "cuts for which no tool is named".into(), |tool| format!("T{tool}"))
}
