//! What does a request ask? Its values by what they mean, in SI, with the default where nothing was given.

use super::notation::of_tool;
use super::opt;
use super::setting::FILTERS;
use super::words::{ModelName, Quantity, StiffnessOf};
use super::{Kind, Layer, Refusal, Request, Setting, Spelling, ToolPose, Unsupported, Verb, default_of};
use nalgebra::Vector3;
use stiffarm::catalogue::{Filter, with_compliance};
use stiffarm::interval::Interval;
use stiffarm::inverse::Configuration;
use stiffarm::map::{Extent, HeldPosture, MapOptions, Spacing};
use stiffarm::mass::ToolWeight;
use stiffarm::model::ModelKind;
use stiffarm::plane::Elbow;
use stiffarm::prior::{as_in_the_paper, with_prior};
use stiffarm::robot::Robot;

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

    /// Weight of the tool, where it is given.
    pub(super) fn tool_weight(&self) -> Option<ToolWeight> {
        let centre: Result<[f64; 3], _> = self.all(opt::TOOL_COM_MM).try_into();
        let centre = centre.ok().map(|mm| Vector3::from(mm) / 1e3);
        self.get(opt::TOOL_MASS_KG).map(|mass| ToolWeight { mass, centre })
    }

    /// Largest deflection that is acceptable, mm.
    pub fn tolerance_mm(&self) -> Option<f64> {
        self.get(opt::TOLERANCE_MM)
    }

    /// A ranking of which nothing is said but what would be anyway: that of the paper, zones anywhere in the arm plane, joints up to their
    /// limits.
    pub fn is_the_papers(&self) -> bool {
        self.verb == Verb::Rank && self.given.iter().all(|given| given.values == default_of(given.setting))
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

    /// How whoever asks spells, for what is not in the table.
    pub fn reader(&self) -> &Spelling {
        &self.reader
    }
}
