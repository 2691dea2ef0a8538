//! Which options are there, by name and type? The rows of [`SETTINGS`](super::SETTINGS) say what each means, and of which verbs it is.

use std::marker::PhantomData;

use stiffarm::calibrate::Level;
use stiffarm::calibration::ControllerModel;
use stiffarm::catalogue::measurements::Marker;
use stiffarm::cell::{Block, Mount, Window};
use stiffarm::chatter::{HeldBy, Method};
use stiffarm::drive::Architecture;
use stiffarm::identify::{Axes, Estimator, Springs};
use stiffarm::interval::Interval;
use stiffarm::inverse::Configuration;
use stiffarm::load::Component;
use stiffarm::measure::{Criterion, LoadWay};
use stiffarm::mill::{ErrorPart, RollMode, WorkFrame};
use stiffarm::plane::Elbow;
use stiffarm::robot::Status;
use stiffarm::spatial::Pose;
use stiffarm::task::{Task, Zone};
use stiffarm::toolpath::{ArcCentres, ArcSense, CutterCompensation, Format, IncrementalCycles, LengthUnit, Rotary};

use super::kind::Kind;
use super::notation::{Angle, Force};
use super::setting::Setting;
use super::value::{Type, Typed};
use super::words::{BodyUnit, ForceAxes, Layer, ModelName, Quantity, StiffnessOf};

/// The name of an option, with the type of its values.
pub(crate) struct Opt<T> {
    /// The long name.
    pub(crate) name: &'static str,
    of: PhantomData<fn() -> T>,
}

impl<T> Clone for Opt<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Opt<T> {}

impl<T> AsRef<str> for Opt<T> {
    fn as_ref(&self) -> &str {
        self.name
    }
}

impl<T: Typed> Opt<T> {
    const fn named(name: &'static str) -> Self {
        Self { name, of: PhantomData }
    }

    /// A row of this name is of this option, and not of another one whose values are of another type.
    pub(super) fn has(row: &Setting) -> bool {
        row.kind.type_of() == T::TYPE && row.kind.words().iter().all(|word| T::WORDS.contains(word))
    }

    /// A row of this option: one of words has all words of its type, where the row does not say which.
    ///
    /// # Panics
    /// When the table is compiled, where what the row takes is not of this type.
    pub(super) const fn row(self, mut row: Setting) -> Setting {
        row.name = self.name;
        if matches!((row.kind, T::TYPE), (Kind::Text, Type::Word)) {
            row.kind = Kind::Word(T::WORDS);
        }
        assert!(row.kind.type_of() as u8 == T::TYPE as u8, "the row of an option takes what is not of its type");
        row
    }
}

pub(crate) const A: Opt<String> = Opt::named("a");
pub(crate) const ACCEPTANCE_DEG: Opt<f64> = Opt::named("acceptance-deg");
pub(crate) const ALLOW_CONTACT: Opt<bool> = Opt::named("allow-contact");
pub(crate) const ANGLE: Opt<Angle> = Opt::named("angle");
pub(crate) const ANY: Opt<bool> = Opt::named("any");
pub(crate) const ARCHITECTURE: Opt<Architecture> = Opt::named("architecture");
pub(crate) const ARC_CENTRES: Opt<ArcCentres> = Opt::named("arc-centres");
pub(crate) const ARC_SENSE: Opt<ArcSense> = Opt::named("arc-sense");
pub(crate) const AT: Opt<f64> = Opt::named("at");
pub(crate) const B: Opt<String> = Opt::named("b");
pub(crate) const BASE_MM: Opt<Pose> = Opt::named("base-mm");
pub(crate) const CANDIDATES: Opt<usize> = Opt::named("candidates");
pub(crate) const CHATTER: Opt<bool> = Opt::named("chatter");
pub(crate) const CHORD_MM: Opt<f64> = Opt::named("chord-mm");
pub(crate) const CLEARANCE_MM: Opt<f64> = Opt::named("clearance-mm");
pub(crate) const CLEAR_OF_BASE_M: Opt<f64> = Opt::named("clear-of-base-m");
pub(crate) const COLUMNS: Opt<String> = Opt::named("columns");
pub(crate) const COMPARE: Opt<Architecture> = Opt::named("compare");
pub(crate) const COMPENSATE: Opt<bool> = Opt::named("compensate");
pub(crate) const COMPONENT: Opt<Component> = Opt::named("component");
pub(crate) const CONTROLLER_MODEL: Opt<ControllerModel> = Opt::named("controller-model");
pub(crate) const COUNT: Opt<usize> = Opt::named("count");
pub(crate) const CRITERION: Opt<Criterion> = Opt::named("criterion");
pub(crate) const CUTTER_COMPENSATION: Opt<CutterCompensation> = Opt::named("cutter-compensation");
pub(crate) const DAMPING_RATIO: Opt<f64> = Opt::named("damping-ratio");
pub(crate) const DATA: Opt<String> = Opt::named("data");
pub(crate) const DATE: Opt<String> = Opt::named("date");
pub(crate) const DIRECTION_DEG: Opt<f64> = Opt::named("direction-deg");
pub(crate) const DISPLACEMENT_AXES: Opt<Axes> = Opt::named("displacement-axes");
pub(crate) const DRIVE_URAD_PER_NM: Opt<f64> = Opt::named("drive-urad-per-nm");
pub(crate) const DRY: Opt<bool> = Opt::named("dry");
pub(crate) const ELBOW: Opt<Elbow> = Opt::named("elbow");
pub(crate) const ERROR: Opt<ErrorPart> = Opt::named("error");
pub(crate) const FACES: Opt<String> = Opt::named("faces");
pub(crate) const FEED: Opt<f64> = Opt::named("feed");
pub(crate) const FEED_DEG: Opt<f64> = Opt::named("feed-deg");
pub(crate) const FEED_MM_PER_MIN: Opt<f64> = Opt::named("feed-mm-per-min");
pub(crate) const FIT: Opt<Estimator> = Opt::named("fit");
pub(crate) const FIXTURE: Opt<String> = Opt::named("fixture");
pub(crate) const FLAT_TASK: Opt<Task<Zone>> = Opt::named("task");
pub(crate) const FLOOR: Opt<Option<f64>> = Opt::named("floor");
pub(crate) const FORCE_AXES: Opt<ForceAxes> = Opt::named("force-axes");
pub(crate) const FORCE_CONE_DEG: Opt<f64> = Opt::named("force-cone-deg");
pub(crate) const FORCE_N: Opt<Force> = Opt::named("force-n");
pub(crate) const FRAME_BY: Opt<String> = Opt::named("frame-by");
pub(crate) const FRF: Opt<String> = Opt::named("frf");
pub(crate) const FRF_ON: Opt<HeldBy> = Opt::named("frf-on");
pub(crate) const GAP: Opt<f64> = Opt::named("gap");
pub(crate) const GEOMETRY: Opt<bool> = Opt::named("geometry");
pub(crate) const HEADINGS: Opt<(String, String)> = Opt::named("columns");
pub(crate) const INCREMENTAL_CYCLES: Opt<IncrementalCycles> = Opt::named("incremental-cycles");
pub(crate) const INSTRUMENT: Opt<f64> = Opt::named("instrument");
pub(crate) const JOINTS_DEG: Opt<f64> = Opt::named("joints-deg");
pub(crate) const K2: Opt<f64> = Opt::named("k2");
pub(crate) const K3: Opt<f64> = Opt::named("k3");
pub(crate) const KEEP_OUT: Opt<Block> = Opt::named("keep-out");
pub(crate) const LAYER: Opt<Layer> = Opt::named("layer");
pub(crate) const LEVEL: Opt<Option<Level>> = Opt::named("level");
pub(crate) const LIMIT_MARGIN_DEG: Opt<f64> = Opt::named("limit-margin-deg");
pub(crate) const LOADS: Opt<LoadWay> = Opt::named("loads");
pub(crate) const LOAD_AXES: Opt<Axes> = Opt::named("force-axes");
pub(crate) const LOAD_FORCE_N: Opt<f64> = Opt::named("force-n");
pub(crate) const LOAD_MM: Opt<[f64; 3]> = Opt::named("load-mm");
pub(crate) const MARKER_FACES: Opt<[f64; 3]> = Opt::named("marker-faces");
pub(crate) const MARKER_MM: Opt<Marker> = Opt::named("marker-mm");
pub(crate) const METHOD: Opt<Method> = Opt::named("method");
pub(crate) const MODEL: Opt<ModelName> = Opt::named("model");
pub(crate) const MOUNT: Opt<Mount> = Opt::named("mount");
pub(crate) const ONLY_TOOL: Opt<usize> = Opt::named("only-tool");
pub(crate) const OWN_TABLE: Opt<String> = Opt::named("compare");
pub(crate) const PART: Opt<String> = Opt::named("part");
pub(crate) const PART_UNIT: Opt<BodyUnit> = Opt::named("part-unit");
pub(crate) const PATH: Opt<String> = Opt::named("path");
pub(crate) const PAYLOAD_KG: Opt<Interval> = Opt::named("payload-kg");
pub(crate) const PENDANT_AS_FILE: Opt<bool> = Opt::named("pendant-as-file");
pub(crate) const PIN: Opt<[f64; 2]> = Opt::named("pin");
pub(crate) const POSTURE: Opt<Configuration> = Opt::named("posture");
pub(crate) const POSTURE_SIGMA_MM: Opt<f64> = Opt::named("posture-sigma-mm");
pub(crate) const PRIOR: Opt<bool> = Opt::named("prior");
pub(crate) const PROCESS: Opt<String> = Opt::named("process");
pub(crate) const QUANTITY: Opt<Quantity> = Opt::named("quantity");
pub(crate) const RANGE: Opt<Interval> = Opt::named("range");
pub(crate) const RATIOS: Opt<f64> = Opt::named("ratios");
pub(crate) const REACH_M: Opt<Interval> = Opt::named("reach-m");
pub(crate) const READ_AS: Opt<Format> = Opt::named("read-as");
pub(crate) const REGIONS: Opt<usize> = Opt::named("regions");
pub(crate) const REPEATS: Opt<usize> = Opt::named("repeats");
pub(crate) const ROBOT: Opt<String> = Opt::named("robot");
pub(crate) const ROBOTS: Opt<String> = Opt::named("robots");
pub(crate) const ROLL: Opt<RollMode> = Opt::named("roll");
pub(crate) const ROLL_DEG: Opt<f64> = Opt::named("roll-deg");
pub(crate) const ROTARY: Opt<Rotary> = Opt::named("rotary");
pub(crate) const RUNS: Opt<usize> = Opt::named("runs");
pub(crate) const SCALE: Opt<Interval> = Opt::named("scale");
pub(crate) const SIGMA_MM: Opt<f64> = Opt::named("sigma-mm");
pub(crate) const SINGULAR_MARGIN_DEG: Opt<f64> = Opt::named("singular-margin-deg");
pub(crate) const SIZE: Opt<usize> = Opt::named("size");
pub(crate) const SIZES: Opt<f64> = Opt::named("sizes");
pub(crate) const SPEED_SHARE: Opt<f64> = Opt::named("speed-share");
pub(crate) const SPRINGS: Opt<Springs> = Opt::named("model");
pub(crate) const STATUS: Opt<Status> = Opt::named("status");
pub(crate) const STEP_M: Opt<f64> = Opt::named("step-m");
pub(crate) const STEP_MM: Opt<f64> = Opt::named("step-mm");
pub(crate) const STICK_OUT_MM: Opt<f64> = Opt::named("stick-out-mm");
pub(crate) const STIFFNESS: Opt<StiffnessOf> = Opt::named("stiffness");
pub(crate) const STIFFNESS_NM_PER_RAD: Opt<f64> = Opt::named("stiffness-nm-per-rad");
pub(crate) const STIFFNESS_UNCERTAINTY: Opt<f64> = Opt::named("stiffness-uncertainty");
pub(crate) const STOCK_MM: Opt<Block> = Opt::named("stock-mm");
pub(crate) const TASK: Opt<Task> = Opt::named("task");
pub(crate) const TASKS: Opt<Task<Zone>> = Opt::named("tasks");
pub(crate) const TOLERANCE_MM: Opt<f64> = Opt::named("tolerance-mm");
pub(crate) const TOOL: Opt<Pose> = Opt::named("tool");
pub(crate) const TOOL_COM_MM: Opt<f64> = Opt::named("tool-com-mm");
pub(crate) const TOOL_DIRECTION: Opt<f64> = Opt::named("tool-direction");
pub(crate) const TOOL_INERTIA_KG_M2: Opt<f64> = Opt::named("tool-inertia-kg-m2");
pub(crate) const TOOL_LENGTHS_MM: Opt<(u32, f64)> = Opt::named("tool-lengths-mm");
pub(crate) const TOOL_MASS_KG: Opt<f64> = Opt::named("tool-mass-kg");
pub(crate) const TOOL_MM: Opt<Pose> = Opt::named("tool-mm");
pub(crate) const UNIT: Opt<LengthUnit> = Opt::named("unit");
pub(crate) const VENDOR: Opt<String> = Opt::named("vendor");
pub(crate) const WIDTH_MM: Opt<f64> = Opt::named("width-mm");
pub(crate) const WINDOW: Opt<Block> = Opt::named("window");
pub(crate) const WITHIN: Opt<Window> = Opt::named("within");
pub(crate) const WORK_FRAME: Opt<WorkFrame> = Opt::named("work-frame");
pub(crate) const YAW_DEG: Opt<Interval> = Opt::named("yaw-deg");
pub(crate) const ZONE: Opt<Task<Zone>> = Opt::named("zone");

#[cfg(test)]
mod tests {
    use super::super::{Pair, Request, Spelling, Verb};
    use super::*;

    #[test]
    fn an_option_of_another_type_is_another_one_of_this_name() {
        let asked = |verb, pairs: &[(&str, &str)]| {
            let pair =
                |(name, text): &(&str, &str)| Pair { name: (*name).into(), text: (*text).into(), at: Spelling::Typed };
            Request::read(verb, &pairs.iter().map(pair).collect::<Vec<_>>(), Spelling::Typed).unwrap()
        };
        let identified = asked(Verb::Identify, &[("model", "base"), ("force-axes", "flange")]);
        assert_eq!((identified.get(SPRINGS), identified.get(MODEL)), (Some(Springs::Base), None));
        assert_eq!((identified.get(LOAD_AXES), identified.get(FORCE_AXES)), (Some(Axes::Flange), None));
        let placed = asked(Verb::Place, &[("model", "spatial"), ("force-n", "1,2,3"), ("force-axes", "base")]);
        assert_eq!((placed.get(SPRINGS), placed.get(MODEL)), (None, Some(ModelName::Spatial)));
        // "base" is a word of both, and of another list of words.
        assert_eq!((placed.get(LOAD_AXES), placed.get(FORCE_AXES)), (None, Some(ForceAxes::Base)));
        let planned = asked(Verb::Measure, &[("force-n", "500")]);
        assert_eq!((planned.get(LOAD_FORCE_N), planned.get(FORCE_N)), (Some(500.0), None));
    }
}
