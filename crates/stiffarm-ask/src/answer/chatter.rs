//! Does a cut swing? The answer as fields and as text.

use std::fmt::Write;

use serde_json::{Value, json};
use stiffarm::catalogue::ProcessFile;
use stiffarm::chatter::{Chatter, DepthSpread, Edge, HeldBy, LONGEST, Lobe, Method, Verdict};
use stiffarm::cutting::Engagement;
use stiffarm::limits::Pendant;
use stiffarm::mass::RigidBody;
use stiffarm::modes::HeldTool;
use stiffarm::robot::Robot;

use super::compliance::vector;
use super::modes::tool_note;
use super::numbers::rpm;
use super::stiffness::{self, stiffness};
use super::tip::{self, TipFile};
use super::words::{self, fixed};
use super::{Datum, Line, Record, Rows, Table, field, line, shape, with_schema};

/// The answer of `chatter`, with what was asked.
#[derive(Clone, Debug)]
pub struct ChatterAnswer {
    /// Which robot.
    pub robot: Robot,
    /// The joint angles that it reports, deg, as they were given.
    pub joints_deg: [f64; 6],
    /// What it holds.
    pub tool: HeldTool,
    /// The process file as it was named.
    pub file: String,
    /// What it says.
    pub process: ProcessFile,
    /// What was measured at the tip.
    pub measured: Option<TipFile>,
    /// What was found.
    pub chatter: Chatter,
}

fn depth(edge: Option<Edge>) -> Option<f64> {
    edge.map(|edge| edge.depth)
}

fn hertz(edge: Option<Edge>) -> Option<f64> {
    edge.map(|edge| edge.frequency)
}

/// mm with four decimals, or that it is beyond all edges.
fn millimetres(depth: Option<f64>) -> String {
    depth.map_or_else(|| format!("more than {}", fixed(LONGEST * 1e3, 0)), |depth| fixed(depth * 1e3, 4))
}

fn between(spread: DepthSpread) -> String {
    format!("{}..{} mm", millimetres(spread.p05), millimetres(spread.p95))
}

impl ChatterAnswer {
    /// Of robot modes, in a word.
    fn robot_modes(&self) -> &'static str {
        match self.chatter.verdict() {
            Verdict::Calm => "calm",
            Verdict::Limits(_) => "limit",
            Verdict::NotDecided => "not decided",
        }
    }

    /// Speed of the spindle, turns a minute.
    pub fn rpm(&self) -> f64 {
        rpm(self.chatter.cut.spindle)
    }

    /// In words; never that a cut is stable.
    pub fn verdict(&self) -> String {
        format!("{}; {}", self.of_robot(), tip::besides(self.chatter.measured.as_ref()))
    }

    /// The part of the verdict that is known.
    pub(super) fn of_robot(&self) -> String {
        let measured = self.chatter.measured.as_ref();
        let to = measured.and_then(|measured| measured.between);
        let upto = to.map_or_else(String::new, |[_, to]| format!(" up to {} Hz", fixed(to, 0)));
        let whose = format!("{}{upto}", tip::whose(measured));
        match self.chatter.verdict() {
            Verdict::Calm => format!("{whose} calm"),
            Verdict::Limits(depth) => format!("{whose} limit the depth to {} mm", fixed(depth * 1e3, 3)),
            Verdict::NotDecided => format!("{whose}: not decided"),
        }
    }

    /// Of the process and of what was measured.
    fn assumed(&self) -> impl Iterator<Item = &String> {
        self.process.assumed.iter().chain(self.measured.iter().flat_map(|measured| &measured.remarks))
    }

    fn method(&self) -> &'static str {
        match self.chatter.method {
            Method::Mean => "mean",
            Method::Teeth => "teeth",
        }
    }

    /// What the intervals are over.
    fn drawn(&self) -> Vec<&'static str> {
        let parts = [("drives", self.chatter.drives_are_drawn), ("damping", self.chatter.damping_is_drawn)];
        parts.into_iter().filter(|(_, is_drawn)| *is_drawn).map(|(name, _)| name).collect()
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let Self { robot, joints_deg, tool, chatter, .. } = self;
        let body = tool.body.as_ref();
        let mut record = Record::of(&shape::CHATTER);
        stiffness::put_robot(&mut record, robot);
        record
            .put(field::MODEL, "spatial")
            .put(field::JOINTS, *joints_deg)
            .put(field::PENDANT, robot.pendant().map(Pendant::name))
            .put(field::TCP, chatter.tool.translation.vector.as_slice())
            .put(field::TOOL_MASS, body.map(|body| body.mass))
            .put(field::TOOL_COM, body.map(|body| body.centre.as_slice()))
            .put(field::TOOL_INERTIA, body.map(RigidBody::elements))
            .put(field::PROCESS, &self.file);
        Self::put_cut(Some(self), &mut record);
        record
            .put(field::CHATTER_VERDICT, self.verdict())
            .put(field::ASSUMED, json!(self.assumed().collect::<Vec<_>>()))
            .put(field::LOBES, self.lobes().collect::<Datum>());
        record
    }

    /// What is reported of a cut, whoever asks, but the verdict in words; every key is there where nothing is known, too.
    pub(super) fn put_cut(found: Option<&Self>, record: &mut Record) {
        let chatter = found.map(|found| &found.chatter);
        let cut = chatter.map(|chatter| &chatter.cut.milling.engagement);
        let measured = chatter.and_then(|chatter| chatter.measured.as_ref());
        let edge = |of: fn(&Chatter) -> Option<Edge>| chatter.and_then(of);
        let [at_speed, any_speed] = [edge(|chatter| chatter.at_speed), edge(|chatter| chatter.any_speed)];
        let [other_way, without_delay] = [edge(|chatter| chatter.other_way), edge(|chatter| chatter.without_delay)];
        record
            .put(field::SPINDLE_SPEED, found.map(Self::rpm))
            .put(field::CUT_DEPTH, cut.map(Engagement::depth))
            .put(field::ENTRY_ANGLE, cut.map(Engagement::entry))
            .put(field::EXIT_ANGLE, cut.map(Engagement::exit))
            .put(field::CHATTER_METHOD, found.map(Self::method))
            .put(field::CRITICAL_DEPTH, depth(at_speed))
            .put(field::CRITICAL_DEPTH_P05, chatter.and_then(|chatter| chatter.spread.p05))
            .put(field::CRITICAL_DEPTH_P95, chatter.and_then(|chatter| chatter.spread.p95))
            .put(field::DEPTH_RESERVE, found.and_then(|found| found.reserve(depth(at_speed))))
            .put(field::CHATTER_FREQUENCY, hertz(at_speed))
            .put(field::TOOTH_PHASE, chatter.and_then(Chatter::tooth_phase))
            .put(field::ANY_SPEED_DEPTH, depth(any_speed))
            .put(field::ANY_SPEED_DEPTH_P05, chatter.and_then(|chatter| chatter.any_speed_spread.p05))
            .put(field::ANY_SPEED_DEPTH_P95, chatter.and_then(|chatter| chatter.any_speed_spread.p95))
            .put(field::ANY_SPEED_FREQUENCY, hertz(any_speed))
            .put(field::OTHER_WAY_DEPTH, depth(other_way))
            .put(field::OTHER_WAY_FREQUENCY, hertz(other_way))
            .put(field::CALM_SPEEDS, found.and_then(Self::calm_rpm).map(|speeds| json!(speeds)))
            .put(field::PAN_DEPTH, depth(without_delay))
            .put(field::PAN_FREQUENCY, hertz(without_delay))
            .put(field::CHATTER_DRAWN, found.map(|found| json!(found.drawn())))
            .put(field::MODES_LOOKED_AT, chatter.map(|chatter| json!(chatter.robot_modes)))
            .put(field::ROBOT_MODES, found.map_or("not covered", Self::robot_modes))
            .put(field::SPINDLE_MODES, if measured.is_some() { "measured" } else { "unknown" })
            .put(field::FRF, found.and_then(|found| Some(&*found.measured.as_ref()?.file)))
            .put(field::FRF_ON, measured.map(|measured| tip::held_by(measured.held_by)))
            .put(field::MEASURED_MODES, measured.filter(|tip| tip.between.is_none()).map(|tip| json!(tip.modes)))
            .put(field::MEASURED_BETWEEN, measured.and_then(|measured| measured.between).map(|ends| json!(ends)));
    }

    /// Speeds at which the cut is calm, turns a minute, from where to where; `None` where they are not known.
    fn calm_rpm(&self) -> Option<Vec<[f64; 2]>> {
        Some(self.chatter.calm_speeds()?.into_iter().map(|ends| ends.map(rpm)).collect())
    }

    /// Where the tool feeds, of length one, base axes.
    pub(super) fn feed(&self) -> [f64; 3] {
        self.chatter.axes.column(0).into()
    }

    fn lobes(&self) -> impl Iterator<Item = Record> + '_ {
        self.chatter.lobes.iter().map(|Lobe { spindle, edge, spread }| {
            let mut record = Record::of(&shape::LOBE);
            record
                .put(field::SPINDLE_SPEED, rpm(*spindle))
                .put(field::LOBE_DEPTH, depth(*edge))
                .put(field::LOBE_DEPTH_P05, spread.and_then(|spread| spread.p05))
                .put(field::LOBE_DEPTH_P95, spread.and_then(|spread| spread.p95))
                .put(field::CHATTER_FREQUENCY, hertz(*edge));
            record
        })
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("chatter", super::ORIGIN, &self.record())
    }

    /// A row a speed of the spindle, for a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        Rows::of(&shape::LOBE, self.lobes())
    }

    /// For people.
    pub fn table(&self) -> Table {
        let mut lines = vec![line("verdict", self.verdict())];
        lines.extend(self.lines());
        lines.extend(self.assumed().map(|one| line("assumed", one)));
        Table::of_lines(lines)
    }

    /// What is reported of the cut.
    pub(super) fn lines(&self) -> Vec<Line> {
        let Self { chatter, .. } = self;
        let at =
            |edge: Option<Edge>| edge.map_or_else(String::new, |edge| format!(" at {} Hz", fixed(edge.frequency, 2)));
        let depth_of = |edge: Option<Edge>| format!("{} mm{}", millimetres(depth(edge)), at(edge));
        let is_drawn = !self.drawn().is_empty();
        let with = |edge: Option<Edge>, spread: DepthSpread| {
            if is_drawn { format!("{}; 90 %: {}", depth_of(edge), between(spread)) } else { depth_of(edge) }
        };
        let cut = &chatter.cut.milling.engagement;
        let degrees = |angle: f64| fixed(angle.to_degrees(), 1);
        let mut engagement = format!(
            "{} mm deep, {} teeth from {} to {} deg",
            fixed(cut.depth() * 1e3, 3),
            chatter.cut.milling.teeth,
            degrees(cut.entry()),
            degrees(cut.exit())
        );
        if 1 < cut.arcs.len() {
            let _ = write!(engagement, ", in {} arcs of which that is the deepest", cut.arcs.len());
        }
        let mut lines: Vec<Line> = vec![
            line("cut", engagement),
            line(format!("swings at {} rpm from", fixed(self.rpm(), 0)), with(chatter.at_speed, chatter.spread)),
            line("reserve", self.reserves()),
            line(self.at_no_speed(), with(chatter.any_speed, chatter.any_speed_spread)),
            line("without the delay (Pan)", depth_of(chatter.without_delay)),
        ];
        if let Some(phase) = chatter.tooth_phase() {
            lines.push(line("turn from tooth to tooth", format!("{} rad", fixed(phase, 3))));
        }
        lines.push(line("calm speeds", self.calm()));
        lines.push(line("fed the other way, swings from", depth_of(chatter.other_way)));
        if !chatter.robot_modes.is_empty() {
            lines.push(line("robot modes looked at", format!("{} Hz", tip::frequencies(&chatter.robot_modes))));
        }
        let measured = chatter.measured.as_ref().zip(self.measured.as_ref());
        lines.extend(measured.map(|(looked, tip)| line("measured", tip::described(looked, &tip.file))));
        lines.push(line("teeth", self.counted()));
        lines
    }

    /// What the depth below which no speed swings rests on.
    fn at_no_speed(&self) -> &'static str {
        match self.chatter.method {
            Method::Mean => "at no speed below",
            Method::Teeth => "at no speed below, by the mean",
        }
    }

    /// A depth in parts of that of the cut.
    fn reserve(&self, depth: Option<f64>) -> Option<f64> {
        Some(depth? / self.chatter.cut.milling.engagement.depth())
    }

    fn reserves(&self) -> String {
        let most = LONGEST / self.chatter.cut.milling.engagement.depth();
        let [at_speed, p05, p95] = [depth(self.chatter.at_speed), self.chatter.spread.p05, self.chatter.spread.p95]
            .map(|depth| {
                self.reserve(depth).map_or_else(|| format!("more than {}", fixed(most, 1)), |share| fixed(share, 3))
            });
        let spread = if self.drawn().is_empty() { String::new() } else { format!("; 90 %: {p05}..{p95}") };
        format!("{at_speed} of the depth of the cut{spread}; below 1 it swings")
    }

    /// At which speeds the cut would be calm.
    fn calm(&self) -> String {
        let within = [0.5, 1.5].map(|share| fixed(share * self.rpm(), 0)).join(" to ");
        match self.calm_rpm().as_deref() {
            None if self.chatter.drives_are_assumed => "not known: the stiffness is nobody's".into(),
            None if self.chatter.is_vague() => "not known: the measured table does not decide it".into(),
            None => "not known: counted tooth by tooth, depths at other speeds have no interval".into(),
            Some([]) => format!(
                "none from {within} rpm: at each it swings at the nominal stiffness or in more than 5 of 100 draws"
            ),
            Some(speeds) => {
                let range = |[from, to]: &[f64; 2]| format!("{} to {}", fixed(*from, 0), fixed(*to, 0));
                format!("{} rpm, of {within} rpm", speeds.iter().map(range).collect::<Vec<_>>().join(", "))
            }
        }
    }

    fn counted(&self) -> &'static str {
        match self.chatter.method {
            Method::Mean if self.chatter.may_mislead() => {
                "by their mean over a revolution, which may mislead: each cuts for half of the time or less, and a table without modes is not counted tooth by tooth"
            }
            Method::Mean => "by their mean over a revolution",
            Method::Teeth => "one by one (semi-discretisation), as straight ones",
        }
    }

    /// What a figure says below its title.
    pub fn heading(&self) -> String {
        let (rpm, depth) = (fixed(self.rpm(), 0), fixed(self.chatter.cut.milling.engagement.depth() * 1e3, 3));
        format!("{depth} mm at {rpm} rpm: {}; {}", self.verdict(), self.file)
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        let Self { robot, joints_deg, .. } = self;
        let angles = joints_deg.map(|angle| angle.to_string()).join(", ");
        let mut notes = vec![
            format!("{}; {}: {angles} deg", words::robot(robot), words::joints_reported(robot)),
            self.stiffness_in_words(),
            format!("feed along {} from the base", vector(&self.feed().into(), 3)),
        ];
        notes.extend(self.basis());
        notes.join("\n") + "\n"
    }

    /// What it rests on, and what is not known.
    pub(super) fn basis(&self) -> Vec<String> {
        let Self { chatter, .. } = self;
        let mut notes = if self.robot_is_measured() {
            Vec::new()
        } else {
            vec![tool_note(&self.robot, &self.tool, "changes the depths")]
        };
        notes.push(match self.drawn()[..] {
            [] if self.robot_is_measured() => "intervals: none; the tip is taken as it was measured".into(),
            [] => "intervals: none; stiffness and damping are taken as given".into(),
            _ => {
                let measured =
                    if chatter.measured.is_some() { "; what was measured at the tip is taken as it is" } else { "" };
                format!("intervals: over draws of {}{measured}", self.drawn().join(" and "))
            }
        });
        notes.push(tip::not_known(chatter));
        if chatter.drives_are_assumed {
            notes.push("stiffness is nobody's: nothing is decided by it".into());
        }
        if chatter.verdict() == Verdict::NotDecided && !self.robot_is_measured() {
            let drives = if self.robot.identified().is_some() {
                ""
            } else {
                "the drives (`stiffarm measure`, `stiffarm identify`) and "
            };
            notes.push(format!(
                "to decide: measure {drives}the damping of the first modes at this posture by a tap test (--damping-ratio)"
            ));
        }
        notes
    }

    /// Is the robot in what was measured at the tip, so that its model does not count?
    fn robot_is_measured(&self) -> bool {
        self.chatter.measured.as_ref().is_some_and(|measured| measured.held_by == HeldBy::Robot)
    }

    fn stiffness_in_words(&self) -> String {
        if self.robot_is_measured() {
            "stiffness, masses and damping: in what was measured; the model of the robot does not count".into()
        } else {
            format!("stiffness: {}", stiffness(&self.robot))
        }
    }
}
