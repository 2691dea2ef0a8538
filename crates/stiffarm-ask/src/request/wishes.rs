//! What does a request ask? Its values by what they mean, in SI, with the default where nothing was given.

use super::cell::CellWish;
use super::kind::Value;
use super::settings::FILTERS;
use super::{Angle, Held, Refusal, Request, Spelling, Unasked, Verb, Wanted, default_of};
use nalgebra::Vector3;
use stiffarm::catalogue::{Filter, with_compliance};
use stiffarm::cell::{Mount, Window};
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::inverse::Configuration;
use stiffarm::load::Load;
use stiffarm::map::{Extent, Held as HeldTool, MapOptions, Spacing};
use stiffarm::mass::ToolWeight;
use stiffarm::model::ModelKind;
use stiffarm::place::{Column, Margins, Orientation, PlaceOptions, Within};
use stiffarm::plane::Elbow;
use stiffarm::prior::{as_in_the_paper, with_prior};
use stiffarm::robot::{Robot, Status};
use stiffarm::study::{Contender, Mark, StudyOptions};
use stiffarm::task::{Task, Zone};
use stiffarm::work::{WorkPlacement, WorkPlane};

/// Of a zone that stands at one place on either side, m: for rounding.
const ROOM: f64 = 1e-9;

/// What the figure of a map in space shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// The worst deflection.
    Deflection,
    /// How far the nearest joint limit is.
    LimitMargin,
    /// How far the nearest singular posture is.
    SingularMargin,
    /// How slow the arm swings first.
    FirstFrequency,
}

impl Request {
    /// The model has all six drives.
    pub fn is_spatial(&self) -> bool {
        self.verb == Verb::Modes || self.word("model") == Some("spatial")
    }

    /// The robot's name or path.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn robot(&self) -> Result<String, Refusal> {
        self.texts("robot").pop().ok_or_else(|| self.missing("robot"))
    }

    /// Names, patterns, files, folders and sets, in the order given.
    ///
    /// Where none are named, the paper's, or all where some are chosen by what they have.
    pub fn robots(&self) -> Vec<String> {
        let is_chosen = self.verb.settings().any(|row| row.heading == FILTERS && self.is_given(row.name));
        let usual = if is_chosen { "all" } else { "paper" };
        let is_of_one = self.verb.setting("robots").is_none() || self.verb == Verb::Mill && !self.ranks_on_path();
        if self.is_given("robots") || is_of_one {
            return self.texts("robots");
        }
        vec![usual.into()]
    }

    /// The one zone.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn task(&self) -> Result<Task, Refusal> {
        self.tasks().into_iter().next().ok_or_else(|| self.missing("task"))
    }

    /// The zones; of a study its shapes at size 1.
    ///
    /// # Panics
    /// Never: that parts have the faces that are asked for is checked when the request is read.
    pub fn tasks(&self) -> Vec<Task> {
        let faces = self.texts("faces");
        let with_faces = |task: Task| match &task.part {
            Some(part) if !faces.is_empty() => part.with_faces(&faces).expect("checked when it was read").into(),
            _ => task,
        };
        self.works().into_iter().map(with_faces).collect()
    }

    /// The same with all the faces that parts have.
    pub(super) fn works(&self) -> Vec<Task> {
        let name = if self.verb.setting("tasks").is_some() { "tasks" } else { "task" };
        if self.verb.setting(name).is_some() { self.all(name, task) } else { Vec::new() }
    }

    /// The zone that a map places.
    pub fn zone(&self) -> Option<Task> {
        self.one("zone", task)
    }

    /// Which model, with the tool where it has one.
    pub fn model(&self) -> ModelKind {
        if self.is_spatial() { ModelKind::Spatial(self.held().tool()) } else { ModelKind::Planar }
    }

    /// The robot with the stiffness that is asked for, or as it is where none is; and with what is said of its pendant.
    ///
    /// # Errors
    /// Where no robot has such drives: all of them rigid, or too soft for the gravity compensator.
    pub fn equipped(&self, robot: Robot) -> Result<Robot, Refusal> {
        let robot = self.with_asked_stiffness(robot)?;
        Ok(if self.is_wished("pendant-as-file") { robot.with_pendant_given() } else { robot })
    }

    fn with_asked_stiffness(&self, robot: Robot) -> Result<Robot, Refusal> {
        let compliances = self.all("drive-urad-per-nm", number);
        // k = 1 / K, in urad/(N m).
        let stiffnesses = self.all("stiffness-nm-per-rad", number).into_iter().map(|stiffness| 1e6 / stiffness);
        let name = if compliances.is_empty() { "stiffness-nm-per-rad" } else { "drive-urad-per-nm" };
        let given: Vec<f64> = compliances.into_iter().chain(stiffnesses).collect();
        let Some(&first) = given.first() else { return self.with_usual_stiffness(robot) };
        let each = std::array::from_fn(|drive| given.get(drive).copied().unwrap_or(first));
        with_compliance(&robot, each).map_err(|faults| {
            let why = faults.faults.first().map_or_else(String::new, |fault| fault.message.clone());
            self.refused(name, format!("makes no sense of {}: {why}", robot.name))
        })
    }

    /// The robot with the drives of the paper, of the prior, or of its file.
    fn with_usual_stiffness(&self, robot: Robot) -> Result<Robot, Refusal> {
        match self.word("stiffness") {
            Some("paper") => Ok(as_in_the_paper(&robot)),
            Some("prior") => with_prior(&robot).map_err(|error| self.refused("stiffness", format!("prior: {error}"))),
            Some(_) if robot.stiffness_is_assumed => {
                let why = format!(
                    "file: the file of {} does not say how stiff its drives are; prior or paper do",
                    robot.name
                );
                Err(self.refused("stiffness", why))
            }
            // In space all six drives count, and nobody's are alike. Of what no size is known that is all that can be said.
            None if robot.stiffness_is_assumed
                && (self.is_spatial()
                    || matches!(self.verb, Verb::Compliance | Verb::Chatter | Verb::Measure | Verb::Mill)) =>
            {
                Ok(with_prior(&robot).unwrap_or(robot))
            }
            _ => Ok(robot),
        }
    }

    /// What was given that may be the name of a file: paths, tables, processes, robots.
    pub fn files(&self) -> Vec<String> {
        let is_file = |row: &&'static super::Setting| {
            matches!(row.kind, super::Kind::File | super::Kind::FileOfTool | super::Kind::Robot)
        };
        let name = |row: &super::Setting, text: String| match row.kind {
            super::Kind::FileOfTool => super::notation::of_tool(&text).1.to_owned(),
            _ => text,
        };
        let names = |row: &'static super::Setting| self.texts(row.name).into_iter().map(move |text| name(row, text));
        self.verb.settings().filter(is_file).flat_map(names).collect()
    }

    /// The joint angles of one posture, deg.
    ///
    /// # Errors
    /// Where they are missing.
    pub fn joints_deg(&self) -> Result<[f64; 6], Refusal> {
        self.all("joints-deg", number).try_into().map_err(|_| self.missing("joints-deg"))
    }

    /// Weight of the tool, where it is told.
    pub(super) fn tool_weight(&self) -> Option<ToolWeight> {
        let centre: Result<[f64; 3], _> = self.all("tool-com-mm", number).try_into();
        let centre = centre.ok().map(|mm| Vector3::from(mm) / 1e3);
        self.number("tool-mass-kg").map(|mass| ToolWeight { mass, centre })
    }

    /// Largest deflection that is acceptable, mm.
    pub fn tolerance_mm(&self) -> Option<f64> {
        self.number("tolerance-mm")
    }

    /// Of a rectangle.
    pub(super) fn angle(&self) -> Angle {
        let angle = |value| if let Value::Angle(angle) = value { Some(angle) } else { None };
        self.one("angle", angle).unwrap_or(Angle::Axes)
    }

    fn wanted(&self) -> Wanted {
        let within = self.ahead();
        if self.is_the_papers() {
            return Wanted { load: Load::PAPER, within: None, margins: Margins::NONE, angle: Angle::Axes, gap: None };
        }
        let load = match self.verb {
            // A zone on a map of the arm plane is placed for the worst direction, whatever is mapped.
            Verb::Map => self.load().in_worst_direction(),
            // Held in the stiffest way, whatever pushes.
            Verb::Modes => Load::PAPER,
            _ => self.load(),
        };
        let within_or_anywhere = Some(within.unwrap_or(Within::ANYWHERE));
        let margins = self.margins(within);
        Wanted { load, within: within_or_anywhere, margins, angle: self.angle(), gap: self.number("gap") }
    }

    /// The one window that lies ahead of the robot wherever that is turned to, where it is the only one.
    pub(super) fn ahead(&self) -> Option<Within> {
        match self.windows().as_slice() {
            [Window::Ring { ahead, z }] => Some(Within { x: *ahead, z: *z }),
            _ => None,
        }
    }

    /// A ranking of which nothing is said but what would be anyway: that of the paper, zones anywhere in the arm plane, joints up to their
    /// limits.
    pub fn is_the_papers(&self) -> bool {
        self.verb == Verb::Rank && self.given.iter().all(|given| given.values == default_of(given.setting))
    }

    /// What every place keeps: what was given, and what is usual.
    pub(super) fn margins(&self, within: Option<Within>) -> Margins {
        let usual = Margins::usual();
        let floor = |value| if let Value::Floor(floor) = value { Some(floor) } else { None };
        let radians = |name: &str, usual: f64| self.number(name).map_or(usual, f64::to_radians);
        // Whoever says where a zone may stand means it, below the base and behind the robot, too.
        // The middle alone says nothing of the floor.
        let is_low = within.is_some_and(|within| within.z.min().is_finite());
        Margins {
            limit: radians("limit-margin-deg", usual.limit),
            singular: radians("singular-margin-deg", usual.singular),
            column: self.number("clear-of-base-m").map_or(usual.column, Column::Radius),
            front: within.is_none() && !self.is_given("at"),
            floor: self.one("floor", floor).unwrap_or(usual.floor.filter(|_| !is_low)),
        }
    }

    /// What is asked of a placement of one zone, or of zones of any shape where there is none.
    ///
    /// # Errors
    /// Where the options together have no answer.
    ///
    /// # Panics
    /// Of a verb that places nothing.
    pub fn place_options(&self, zone: Option<Zone>) -> Result<PlaceOptions, Refusal> {
        self.check_process()?;
        let unanswered = |unasked| self.unanswered(unasked);
        let mut options = self.wanted().options(&self.model(), &self.held(), zone).map_err(unanswered)?;
        options.tool_weight = self.tool_weight();
        let windows = match *self.all("at", number).as_slice() {
            [x, z] => vec![self.only_place(&mut options, [x, z], zone).map_err(unanswered)?],
            _ => self.windows(),
        };
        self.cell(windows).of(&options, self.is_spatial()).map_err(unanswered)
    }

    /// Options under which the middle of a zone stands at one place, and the window that it fills there.
    fn only_place(&self, options: &mut PlaceOptions, at: [f64; 2], zone: Option<Zone>) -> Result<Window, Unasked> {
        let zone = zone.filter(|_| self.works().iter().all(|task| task.part.is_none())).ok_or(Unasked::Middle)?;
        let angle = match options.orientation {
            Orientation::Axes => 0.0,
            Orientation::Fixed(angle) => angle,
            Orientation::Free => return Err(Unasked::FreeAtOnePlace),
        };
        options.orientation = Orientation::Fixed(angle);
        let half: [f64; 2] = match &mut options.stance {
            None => zone.half_extents(angle).into(),
            Some(stance) => {
                if !stance.is_vertical() && self.held().yaw.is_none() {
                    stance.yaw = Interval::point(0.0);
                }
                if !stance.is_vertical() && 0.0 < stance.yaw.width() {
                    return Err(Unasked::YawAtOnePlace);
                }
                let yaw = if stance.is_vertical() { 0.0 } else { stance.yaw.min() };
                let work = WorkPlacement { x: 0.0, y: 0.0, z: 0.0, yaw, angle, roll: 0.0 };
                let [x, _, z] = WorkPlane::of(stance.elevation, &work).half_extents(zone);
                [x, z]
            }
        };
        let [ahead, z] = [0, 1].map(|i| Interval::spanning(at[i] - half[i] - ROOM, at[i] + half[i] + ROOM));
        options.within = Some(Within { x: ahead, z });
        Ok(Window::Ring { ahead, z })
    }

    pub(super) fn windows(&self) -> Vec<Window> {
        self.all("within", window)
    }

    /// How the base is mounted, where that is said.
    pub fn mount(&self) -> Option<Mount> {
        self.one("mount", |value| if let Value::Mount(mount) = value { Some(mount) } else { None })
    }

    /// What is asked of the cell.
    pub(super) fn cell(&self, windows: Vec<Window>) -> CellWish {
        CellWish {
            mount: self.mount(),
            windows,
            keep_out: self.all("keep-out", |value| if let Value::Block(block) = value { Some(block) } else { None }),
            clearance: self.number("clearance-mm").map(|mm| mm / 1e3),
            has_floor: self.is_given("floor"),
        }
    }

    /// What is asked of a map.
    ///
    /// # Panics
    /// Of a verb that maps nothing.
    pub fn map_options(&self) -> MapOptions {
        let held = self.held();
        let held = self.is_spatial().then(|| HeldTool {
            elevation: held.elevation(),
            yaw: 0.0,
            roll: held.roll(),
            configuration: self.posture(),
        });
        MapOptions { extent: Extent::Reached(self.spacing()), load: self.load(), elbow: self.elbow(), held }
    }

    /// How the tool is held, in space.
    pub fn held(&self) -> Held {
        let tool = |value| if let Value::Tool(tool) = value { Some(tool) } else { None };
        Held {
            tool: self.one("tool-mm", tool).or_else(|| self.one("tool", tool)),
            elevation_deg: self.number("tool-direction"),
            yaw: self.one("yaw-deg", interval),
            roll_deg: self.number("roll-deg"),
        }
    }

    pub(super) fn unanswered(&self, unasked: Unasked) -> Refusal {
        self.refused(unasked.setting(), unasked.to_string())
    }

    /// What an option means has no answer.
    pub(crate) fn refused(&self, name: &str, why: String) -> Refusal {
        let at = self.find(name).map_or(&self.reader, |given| &given.at).clone();
        let name = self.verb.setting(name).map_or_else(|| at.bare(name), |setting| at.name(setting));
        Refusal::Unanswered { at, name, why }
    }

    /// How finely a map is drawn.
    ///
    /// # Panics
    /// Of a verb that has no such option.
    fn spacing(&self) -> Spacing {
        let whole = |value| if let Value::Whole(whole) = value { Some(whole) } else { None };
        let points = || Spacing::Points(self.one("size", whole).expect("the row has a default"));
        self.number("step-m").map_or_else(points, Spacing::Step)
    }

    /// The one elbow side of a map in the plane.
    fn elbow(&self) -> Option<Elbow> {
        self.word("elbow").map(|side| if side == "up" { Elbow::Up } else { Elbow::Down })
    }

    /// The one posture of a map in space.
    fn posture(&self) -> Option<Configuration> {
        self.one("posture", |value| if let Value::Posture(posture) = value { Some(posture) } else { None })
    }

    /// Is it mapped how slow the arm swings first?
    pub fn maps_frequency(&self) -> bool {
        self.word("quantity") == Some("first-frequency")
    }

    /// What the figure of a map in space shows.
    pub fn layer(&self) -> Layer {
        match self.word("layer") {
            Some("limit-margin") => Layer::LimitMargin,
            Some("singular-margin") => Layer::SingularMargin,
            Some("first-frequency") => Layer::FirstFrequency,
            None if self.maps_frequency() => Layer::FirstFrequency,
            _ => Layer::Deflection,
        }
    }

    /// From where to where colours and bars of the figure go, in the unit of what is drawn.
    ///
    /// # Errors
    /// Where both ends are the same.
    pub fn scale(&self) -> Result<Option<Interval>, Refusal> {
        let scale = self.one("scale", interval);
        match scale.filter(|scale| scale.width() == 0.0) {
            None => Ok(scale),
            Some(_) => Err(self.unanswered(Unasked::Scale)),
        }
    }

    /// How wide the figure is on paper, mm.
    pub fn width_mm(&self) -> Option<f64> {
        self.number("width-mm")
    }

    /// Which robots of the catalogue are wanted.
    pub fn filter(&self, words: Vec<String>) -> Filter {
        let named = |word: &str| Status::ALL.into_iter().find(|status| status.name() == word);
        Filter {
            words,
            vendors: self.texts("vendor"),
            payload_kg: self.one("payload-kg", interval),
            reach: self.one("reach-m", interval),
            architecture: self.architectures("architecture").pop(),
            statuses: self.words("status").into_iter().filter_map(named).collect(),
        }
    }

    /// What a study compares; `robot` is that which is to be found among it, where one is asked for.
    ///
    /// # Errors
    /// Where two architectures or the range are missing, which have defaults; work that is no flat zone, a robot without two links.
    pub fn study(&self, robot: Option<&Robot>) -> Result<StudyOptions, Refusal> {
        let compared = self.architectures("compare");
        let [first, second] = *compared.as_slice() else { return Err(self.missing("compare")) };
        let (k2, k3) = (self.for_both("k2")?, self.for_both("k3")?);
        let (mut tasks, mut mark) = (self.tasks(), None);
        if let Some(Task { label, zone, part }) = self.one("task", task) {
            if part.is_some() {
                return Err(self.refused("task", "is a part with several faces; expected one flat zone".into()));
            }
            if !self.is_given("tasks") {
                tasks.clear();
            }
            let [side, _] = zone.sides();
            tasks.insert(0, Task { label, ..zone.scaled(1.0 / side).into() });
            let marked = robot.map(|robot| Mark::of(robot, zone)).transpose();
            mark = marked.map_err(|why| self.refused("robot", why.to_string()))?;
        }
        Ok(StudyOptions {
            mark,
            contenders: [
                Contender { architecture: first, k2: k2[0], k3: k3[0] },
                Contender { architecture: second, k2: k2[1], k3: k3[1] },
            ],
            tasks,
            sizes: self.all("sizes", number),
            ratios: self.all("ratios", number),
            range: self.one("range", interval).ok_or_else(|| self.missing("range"))?,
        })
    }

    /// One number for both, or one each.
    fn for_both(&self, name: &str) -> Result<[f64; 2], Refusal> {
        match *self.all(name, number).as_slice() {
            [both] => Ok([both, both]),
            [first, second] => Ok([first, second]),
            _ => Err(self.missing(name)),
        }
    }

    fn architectures(&self, name: &str) -> Vec<Architecture> {
        let named = |word: &str| Architecture::ALL.into_iter().find(|architecture| architecture.name() == word);
        self.words(name).into_iter().filter_map(named).collect()
    }

    pub(super) fn number(&self, name: &str) -> Option<f64> {
        self.one(name, number)
    }

    /// What is asked for by saying so.
    pub(super) fn is_wished(&self, name: &str) -> bool {
        self.one(name, |value| if let Value::Truth(truth) = value { Some(truth) } else { None }) == Some(true)
    }

    /// A number of things, of a row that has a default.
    pub(super) fn count(&self, name: &str) -> usize {
        let whole = |value| if let Value::Whole(whole) = value { Some(whole) } else { None };
        self.one(name, whole).expect("the row has a default")
    }

    fn words(&self, name: &str) -> Vec<&'static str> {
        self.all(name, |value| if let Value::Word(word) = value { Some(word) } else { None })
    }

    pub(super) fn word(&self, name: &str) -> Option<&'static str> {
        self.words(name).pop()
    }

    pub(super) fn texts(&self, name: &str) -> Vec<String> {
        self.all(name, |value| if let Value::Text(text) = value { Some(text) } else { None })
    }

    pub(super) fn one<T>(&self, name: &str, pick: impl FnMut(Value) -> Option<T>) -> Option<T> {
        self.all(name, pick).pop()
    }

    pub(super) fn all<T>(&self, name: &str, mut pick: impl FnMut(Value) -> Option<T>) -> Vec<T> {
        let values = self.values(name).into_iter();
        values
            .map(|value| pick(value).unwrap_or_else(|| panic!("{name} is read as what its row does not take")))
            .collect()
    }

    /// How whoever asks spells, for what is not in the table.
    pub fn reader(&self) -> &Spelling {
        &self.reader
    }
}

#[expect(clippy::needless_pass_by_value, reason = "picks from values that are handed over")]
pub(super) fn number(value: Value) -> Option<f64> {
    if let Value::Number(number) = value { Some(number) } else { None }
}

#[expect(clippy::needless_pass_by_value, reason = "picks from values that are handed over")]
fn window(value: Value) -> Option<Window> {
    if let Value::Window(window) = value { Some(window) } else { None }
}

#[expect(clippy::needless_pass_by_value, reason = "picks from values that are handed over")]
fn interval(value: Value) -> Option<Interval> {
    if let Value::Interval(interval) = value { Some(interval) } else { None }
}

fn task(value: Value) -> Option<Task> {
    if let Value::Task(task) = value { Some(task) } else { None }
}
