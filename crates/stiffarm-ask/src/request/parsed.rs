//! What does a request ask? Its values by what they mean, in SI, with the default where nothing was given.

use super::cell::CellOptions;
use super::notation::of_tool;
use super::opt::{self, Opt};
use super::setting::FILTERS;
use super::words::{ModelName, Quantity, StiffnessOf};
use super::{
    Angle, Kind, Layer, PlaceRequest, Refusal, Request, Setting, Spelling, ToolPose, Unsupported, Verb, default_of,
};
use nalgebra::Vector3;
use stiffarm::catalogue::{Filter, with_compliance};
use stiffarm::cell::{Mount, Window};
use stiffarm::interval::Interval;
use stiffarm::inverse::Configuration;
use stiffarm::load::Load;
use stiffarm::map::{Extent, HeldPosture, MapOptions, Spacing};
use stiffarm::mass::ToolWeight;
use stiffarm::model::ModelKind;
use stiffarm::place::{Column, Margins, Orientation, PlaceOptions, Within};
use stiffarm::plane::Elbow;
use stiffarm::prior::{as_in_the_paper, with_prior};
use stiffarm::robot::Robot;
use stiffarm::study::{Contender, Mark, StudyOptions};
use stiffarm::task::{Task, Work, Zone};
use stiffarm::work::{WorkPlacement, WorkPlane};

/// Of a zone that stands at one place on either side, m: for rounding.
const ROOM: f64 = 1e-9;

impl Request {
    /// The model has all six drives.
    pub fn is_spatial(&self) -> bool {
        self.verb == Verb::Modes || self.get(opt::MODEL) == Some(ModelName::Spatial)
    }

    /// The robot's name or path.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn robot(&self) -> Result<String, Refusal> {
        self.required(opt::ROBOT)
    }

    /// Names, patterns, files, folders and sets, in the order given.
    ///
    /// Where none are named, the paper's, or all where some are chosen by what they have.
    pub fn robots(&self) -> Vec<String> {
        let is_chosen = self.verb.settings().any(|row| row.heading == FILTERS && self.is_given(row.name));
        let usual = if is_chosen { "all" } else { "paper" };
        let is_of_one = self.verb.setting(opt::ROBOTS).is_none() || self.verb == Verb::Mill && !self.ranks_on_path();
        if self.is_given(opt::ROBOTS) || is_of_one {
            return self.all(opt::ROBOTS);
        }
        vec![usual.into()]
    }

    /// The one task.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn task(&self) -> Result<Task, Refusal> {
        self.tasks().into_iter().next().ok_or_else(|| self.missing(opt::TASK))
    }

    /// The one task of a verb that knows flat zones alone.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn flat_task(&self) -> Result<Task<Zone>, Refusal> {
        self.required(opt::FLAT_TASK)
    }

    /// What is machined, with the faces of parts that are asked for.
    ///
    /// # Panics
    /// Never: that parts have the faces that are asked for is checked when the request is read.
    pub fn tasks(&self) -> Vec<Task> {
        let faces = self.all(opt::FACES);
        let with_faces = |task: Task| match &task.work {
            Work::Part(part) if !faces.is_empty() => part.with_faces(&faces).expect("checked when it was read").into(),
            _ => task,
        };
        self.all(opt::TASK).into_iter().map(with_faces).collect()
    }

    /// The zone that a map places.
    pub fn zone(&self) -> Option<Task<Zone>> {
        self.get(opt::ZONE)
    }

    /// Which model, with the tool where it has one.
    pub fn model(&self) -> ModelKind {
        if self.is_spatial() { ModelKind::Spatial(self.tool_pose().tool()) } else { ModelKind::Planar }
    }

    /// The robot with the stiffness that is asked for, or as it is where none is; and with what is said of its pendant.
    ///
    /// # Errors
    /// Where no robot has such drives: all of them rigid, or too soft for the gravity compensator.
    pub fn equipped(&self, robot: Robot) -> Result<Robot, Refusal> {
        let robot = self.with_asked_stiffness(robot)?;
        Ok(if self.is_set(opt::PENDANT_AS_FILE) { robot.with_pendant_given() } else { robot })
    }

    fn with_asked_stiffness(&self, robot: Robot) -> Result<Robot, Refusal> {
        let compliances = self.all(opt::DRIVE_URAD_PER_NM);
        // k = 1 / K, in urad/(N m).
        let stiffnesses = self.all(opt::STIFFNESS_NM_PER_RAD).into_iter().map(|stiffness| 1e6 / stiffness);
        let option = if compliances.is_empty() { opt::STIFFNESS_NM_PER_RAD } else { opt::DRIVE_URAD_PER_NM };
        let given: Vec<f64> = compliances.into_iter().chain(stiffnesses).collect();
        let Some(&first) = given.first() else { return self.with_usual_stiffness(robot) };
        let each = std::array::from_fn(|drive| given.get(drive).copied().unwrap_or(first));
        with_compliance(&robot, each).map_err(|faults| {
            let why = faults.faults.first().map_or_else(String::new, |fault| fault.message.clone());
            self.refused(option, format!("makes no sense of {}: {why}", robot.name))
        })
    }

    /// The robot with the drives of the paper, of the prior, or of its file.
    fn with_usual_stiffness(&self, robot: Robot) -> Result<Robot, Refusal> {
        match self.get(opt::STIFFNESS) {
            Some(StiffnessOf::Paper) => Ok(as_in_the_paper(&robot)),
            Some(StiffnessOf::Prior) => {
                with_prior(&robot).map_err(|error| self.refused(opt::STIFFNESS, format!("prior: {error}")))
            }
            Some(StiffnessOf::File) if robot.stiffness_is_assumed => {
                let why = format!(
                    "file: the file of {} does not say how stiff its drives are; prior or paper do",
                    robot.name
                );
                Err(self.refused(opt::STIFFNESS, why))
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
        let name = |kind: Kind, text: &String| match kind {
            Kind::FileOfTool => Some(of_tool(text).1.to_owned()),
            Kind::File | Kind::Robot => Some(text.clone()),
            _ => None,
        };
        let names = |row: &'static Setting| {
            let texts = self.find(row.name).into_iter().flat_map(|given| &given.texts);
            texts.filter_map(move |text| name(row.kind, text))
        };
        self.verb.settings().flat_map(names).collect()
    }

    /// The joint angles of one posture, deg.
    ///
    /// # Errors
    /// Where they are missing.
    pub fn joints_deg(&self) -> Result<[f64; 6], Refusal> {
        self.all(opt::JOINTS_DEG).try_into().map_err(|_| self.missing(opt::JOINTS_DEG))
    }

    /// Weight of the tool, where it is told.
    pub(super) fn tool_weight(&self) -> Option<ToolWeight> {
        let centre: Result<[f64; 3], _> = self.all(opt::TOOL_COM_MM).try_into();
        let centre = centre.ok().map(|mm| Vector3::from(mm) / 1e3);
        self.get(opt::TOOL_MASS_KG).map(|mass| ToolWeight { mass, centre })
    }

    /// Largest deflection that is acceptable, mm.
    pub fn tolerance_mm(&self) -> Option<f64> {
        self.get(opt::TOLERANCE_MM)
    }

    /// Of a rectangle.
    pub(super) fn angle(&self) -> Angle {
        self.get(opt::ANGLE).unwrap_or(Angle::Axes)
    }

    fn place_request(&self) -> PlaceRequest {
        let within = self.ahead();
        if self.is_the_papers() {
            return PlaceRequest {
                load: Load::PAPER,
                within: None,
                margins: Margins::NONE,
                angle: Angle::Axes,
                gap: None,
            };
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
        PlaceRequest { load, within: within_or_anywhere, margins, angle: self.angle(), gap: self.get(opt::GAP) }
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
        let radians = |option, usual: f64| self.get(option).map_or(usual, f64::to_radians);
        // Whoever says where a zone may stand means it, below the base and behind the robot, too.
        // The middle alone says nothing of the floor.
        let is_low = within.is_some_and(|within| within.z.min().is_finite());
        Margins {
            limit: radians(opt::LIMIT_MARGIN_DEG, usual.limit),
            singular: radians(opt::SINGULAR_MARGIN_DEG, usual.singular),
            column: self.get(opt::CLEAR_OF_BASE_M).map_or(usual.column, Column::Radius),
            front: within.is_none() && !self.is_given(opt::AT),
            floor: self.get(opt::FLOOR).unwrap_or(usual.floor.filter(|_| !is_low)),
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
        let unanswered = |unsupported| self.unanswered(unsupported);
        let mut options = self.place_request().options(&self.model(), &self.tool_pose(), zone).map_err(unanswered)?;
        options.tool_weight = self.tool_weight();
        let windows = match *self.all(opt::AT).as_slice() {
            [x, z] => vec![self.only_place(&mut options, [x, z], zone).map_err(unanswered)?],
            _ => self.windows(),
        };
        self.cell(windows).of(&options, self.is_spatial()).map_err(unanswered)
    }

    /// Options under which the middle of a zone stands at one place, and the window that it fills there.
    fn only_place(&self, options: &mut PlaceOptions, at: [f64; 2], zone: Option<Zone>) -> Result<Window, Unsupported> {
        let zone = zone.ok_or(Unsupported::Middle)?;
        let angle = match options.orientation {
            Orientation::Axes => 0.0,
            Orientation::Fixed(angle) => angle,
            Orientation::Free => return Err(Unsupported::FreeAtOnePlace),
        };
        options.orientation = Orientation::Fixed(angle);
        let half: [f64; 2] = match &mut options.tool_orientation {
            None => zone.half_extents(angle).into(),
            Some(tool_orientation) => {
                if !tool_orientation.is_vertical() && self.tool_pose().yaw.is_none() {
                    tool_orientation.yaw = Interval::point(0.0);
                }
                if !tool_orientation.is_vertical() && 0.0 < tool_orientation.yaw.width() {
                    return Err(Unsupported::YawAtOnePlace);
                }
                let yaw = if tool_orientation.is_vertical() { 0.0 } else { tool_orientation.yaw.min() };
                let work = WorkPlacement { x: 0.0, y: 0.0, z: 0.0, yaw, angle, roll: 0.0 };
                let [x, _, z] = WorkPlane::of(tool_orientation.elevation, &work).half_extents(zone);
                [x, z]
            }
        };
        let [ahead, z] = [0, 1].map(|i| Interval::spanning(at[i] - half[i] - ROOM, at[i] + half[i] + ROOM));
        options.within = Some(Within { x: ahead, z });
        Ok(Window::Ring { ahead, z })
    }

    pub(super) fn windows(&self) -> Vec<Window> {
        self.all(opt::WITHIN)
    }

    /// How the base is mounted, where that is said.
    pub fn mount(&self) -> Option<Mount> {
        self.get(opt::MOUNT)
    }

    /// What is asked of the cell.
    pub(super) fn cell(&self, windows: Vec<Window>) -> CellOptions {
        CellOptions {
            mount: self.mount(),
            windows,
            keep_out: self.all(opt::KEEP_OUT),
            clearance: self.clearance(),
            has_floor: self.is_given(opt::FLOOR),
            is_at: self.is_given(opt::AT),
        }
    }

    /// So far, m, the arm must keep from everything, where that is asked: who names what must be kept free means the arm, too.
    fn clearance(&self) -> Option<f64> {
        let given = self.get(opt::CLEARANCE_MM).map(|mm| mm / 1e3);
        let is_meant = self.is_given(opt::KEEP_OUT) && !self.allows_contact();
        given.or_else(|| is_meant.then_some(0.0))
    }

    /// What is asked of a map.
    ///
    /// # Panics
    /// Of a verb that maps nothing.
    pub fn map_options(&self) -> MapOptions {
        let tool = self.tool_pose();
        let held = self.is_spatial().then(|| HeldPosture {
            elevation: tool.elevation(),
            yaw: 0.0,
            roll: tool.roll(),
            configuration: self.posture(),
        });
        MapOptions { extent: Extent::Reached(self.spacing()), load: self.load(), elbow: self.elbow(), held }
    }

    /// How the tool is held, in space.
    pub fn tool_pose(&self) -> ToolPose {
        ToolPose {
            tool: self.get(opt::TOOL_MM).or_else(|| self.get(opt::TOOL)),
            elevation_deg: self.get(opt::TOOL_DIRECTION),
            yaw: self.get(opt::YAW_DEG),
            roll_deg: self.get(opt::ROLL_DEG),
        }
    }

    pub(super) fn unanswered(&self, unsupported: Unsupported) -> Refusal {
        self.refused(unsupported.setting(), unsupported.to_string())
    }

    /// What an option means has no answer.
    pub(crate) fn refused(&self, name: impl AsRef<str>, why: String) -> Refusal {
        let name = name.as_ref();
        let at = self.find(name).map_or(&self.reader, |given| &given.at).clone();
        let name = self.verb.setting(name).map_or_else(|| at.bare(name), |setting| at.name(setting));
        Refusal::Unanswered { at, name, why }
    }

    /// How finely a map is drawn.
    ///
    /// # Panics
    /// Of a verb that has no such option.
    fn spacing(&self) -> Spacing {
        let points = || Spacing::Points(self.value(opt::SIZE));
        self.get(opt::STEP_M).map_or_else(points, Spacing::Step)
    }

    /// The one elbow side of a map in the plane.
    fn elbow(&self) -> Option<Elbow> {
        self.get(opt::ELBOW)
    }

    /// The one posture of a map in space.
    fn posture(&self) -> Option<Configuration> {
        self.get(opt::POSTURE)
    }

    /// Is it mapped how slow the arm swings first?
    pub fn maps_frequency(&self) -> bool {
        self.get(opt::QUANTITY) == Some(Quantity::FirstFrequency)
    }

    /// What the figure of a map in space shows.
    pub fn layer(&self) -> Layer {
        let usual = if self.maps_frequency() { Layer::FirstFrequency } else { Layer::Deflection };
        self.get(opt::LAYER).unwrap_or(usual)
    }

    /// From where to where colours and bars of the figure go, in the unit of what is drawn.
    ///
    /// # Errors
    /// Where both ends are the same.
    pub fn scale(&self) -> Result<Option<Interval>, Refusal> {
        let scale = self.get(opt::SCALE);
        match scale.filter(|scale| scale.width() == 0.0) {
            None => Ok(scale),
            Some(_) => Err(self.unanswered(Unsupported::Scale)),
        }
    }

    /// How wide the figure is on paper, mm.
    pub fn width_mm(&self) -> Option<f64> {
        self.get(opt::WIDTH_MM)
    }

    /// Which robots of the catalogue are asked for.
    pub fn filter(&self, words: Vec<String>) -> Filter {
        Filter {
            words,
            vendors: self.all(opt::VENDOR),
            payload_kg: self.get(opt::PAYLOAD_KG),
            reach: self.get(opt::REACH_M),
            architecture: self.get(opt::ARCHITECTURE),
            statuses: self.all(opt::STATUS),
        }
    }

    /// What a study compares; `robot` is that which is to be found among it, where one is asked for.
    ///
    /// # Errors
    /// Where two architectures or the range are missing, which have defaults; a robot without two links.
    pub fn study(&self, robot: Option<&Robot>) -> Result<StudyOptions, Refusal> {
        let compared = self.all(opt::COMPARE);
        let [first, second] = *compared.as_slice() else { return Err(self.missing(opt::COMPARE)) };
        let (k2, k3) = (self.for_both(opt::K2)?, self.for_both(opt::K3)?);
        let (mut tasks, mut mark) = (self.all(opt::TASKS), None);
        if let Some(Task { label, work: zone }) = self.get(opt::FLAT_TASK) {
            if !self.is_given(opt::TASKS) {
                tasks.clear();
            }
            let [side, _] = zone.sides();
            tasks.insert(0, Task { label, work: zone.scaled(1.0 / side) });
            let marked = robot.map(|robot| Mark::of(robot, zone)).transpose();
            mark = marked.map_err(|why| self.refused(opt::ROBOT, why.to_string()))?;
        }
        Ok(StudyOptions {
            mark,
            contenders: [
                Contender { architecture: first, k2: k2[0], k3: k3[0] },
                Contender { architecture: second, k2: k2[1], k3: k3[1] },
            ],
            tasks,
            sizes: self.all(opt::SIZES),
            ratios: self.all(opt::RATIOS),
            range: self.required(opt::RANGE)?,
        })
    }

    /// One number for both, or one each.
    fn for_both(&self, option: Opt<f64>) -> Result<[f64; 2], Refusal> {
        match *self.all(option).as_slice() {
            [both] => Ok([both, both]),
            [first, second] => Ok([first, second]),
            _ => Err(self.missing(option)),
        }
    }

    /// How whoever asks spells, for what is not in the table.
    pub fn reader(&self) -> &Spelling {
        &self.reader
    }
}
