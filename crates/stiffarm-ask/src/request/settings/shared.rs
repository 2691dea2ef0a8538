//! What several rows have in common.

use super::super::kind::{ANY, Count, Kind, count, count_of, degrees_of, number_of, one_or};
use super::super::opt;
use super::super::setting::{Absent, DRAWN, FILTERS, Of, Setting};
use super::super::verb::Verb;

pub(super) const ONE: Count = count_of(1, 1, "values", "one");
pub(super) const SEVERAL: Count = count_of(1, ANY, "values", "some");
pub(super) const RANK: &[Verb] = &[Verb::Rank];
pub(super) const PLACE: &[Verb] = &[Verb::Place];
pub(super) const MAP: &[Verb] = &[Verb::Map];
pub(super) const COMPLIANCE: &[Verb] = &[Verb::Compliance];
/// Those that look at one posture.
pub(super) const POSTURE: &[Verb] = &[Verb::Compliance, Verb::Modes, Verb::Chatter];
/// Those whose posture is always given.
pub(super) const AT_JOINTS: &[Verb] = &[Verb::Compliance, Verb::Chatter];
/// Those that take the springs of one robot, in space.
pub(super) const SPRINGING_ALONE: &[Verb] = &[Verb::Compliance, Verb::Modes, Verb::Chatter, Verb::Measure];
/// Those that begin with the name of one robot.
pub(super) const OF_ONE_ROBOT: &[Verb] =
    &[Verb::Place, Verb::Map, Verb::Compliance, Verb::Modes, Verb::Measure, Verb::Calibrate];
pub(super) const COMPARE: &[Verb] = &[Verb::Compare];
/// Those that bend drives.
pub(super) const SPRINGING: &[Verb] = &[
    Verb::Rank,
    Verb::Place,
    Verb::Map,
    Verb::Compliance,
    Verb::Modes,
    Verb::Chatter,
    Verb::Compare,
    Verb::Measure,
    Verb::Mill,
];
pub(super) const PLACING: &[Verb] = &[Verb::Rank, Verb::Place, Verb::Map, Verb::Compare];
/// Those that hold a tool against a zone.
pub(super) const HOLDING: &[Verb] = &[Verb::Rank, Verb::Place, Verb::Map, Verb::Compare, Verb::Modes];
/// Those that place zones and nothing else.
pub(super) const ONLY_PLACING: &[Verb] = &[Verb::Rank, Verb::Place, Verb::Compare];
/// Those that tell deflections of robots.
pub(super) const BENDING: &[Verb] = &[Verb::Rank, Verb::Place, Verb::Map, Verb::Compliance, Verb::Compare];
pub(super) const CHOOSING: &[Verb] = &[Verb::Rank, Verb::Mill, Verb::List];
pub(super) const A_ZONE: &[(Verb, &str)] = &[(Verb::Map, "zone"), (Verb::Modes, "task")];
pub(super) const WITH_FORCE: &[(Verb, &str)] =
    &[(Verb::Rank, "force-n"), (Verb::Place, "force-n"), (Verb::Map, "force-n"), (Verb::Compare, "force-n")];

/// What a row has where it says nothing else.
pub(super) const ROW: Setting = Setting {
    name: "",
    keyword: "",
    verbs: &[],
    of: Of::Any,
    kind: Kind::Text,
    count: ONE,
    unit: "",
    value: "",
    absent: Absent::Optional,
    needs: &[],
    excludes: &[],
    help: "",
    heading: "",
    example: "",
    is_positional: false,
};
/// One of two that are compared.
pub(super) const SETUP: Setting =
    Setting { verbs: COMPARE, kind: Kind::Robot, absent: Absent::Required, is_positional: true, ..ROW };
/// Of the drives' springs.
pub(super) const SPRINGS: Setting = Setting {
    verbs: SPRINGING,
    count: one_or(6, "values", "one for every drive, or six, separated by commas"),
    value: "K",
    heading: "Stiffness",
    ..ROW
};
/// Who says how stiff they are.
pub(super) const WHOSE: Setting = opt::STIFFNESS.row(Setting {
    count: ONE,
    value: "WHOSE",
    excludes: &["drive-urad-per-nm", "stiffness-nm-per-rad"],
    help: "How stiff the drives are taken to be",
    ..SPRINGS
});
/// Of what every place keeps.
pub(super) const MARGIN: Setting =
    Setting { verbs: HOLDING, needs: A_ZONE, heading: "Margins; 0 or none gives them up", ..ROW };
/// Of the tool's pose.
pub(super) const TOOL: Setting = Setting { verbs: PLACING, of: Of::Spatial, value: "DEG", heading: "Model", ..ROW };
/// The same, as spindles are described.
pub(super) const SPINDLE: Setting = Setting {
    kind: Kind::Spindle,
    unit: "mm, deg",
    value: "TOOL",
    excludes: &["tool-mm"],
    help: "The tool by its shape: spindle:LENGTH@ANGLE+OFFSET, ANGLE between tool axis and flange axis (it leans towards the flange's x, \
           and joint 6 turns it), OFFSET from the flange to where they cross",
    example: "spindle:250@90+30",
    ..TOOL
};
/// The six joints of a posture.
pub(super) const JOINTS: Setting = opt::JOINTS_DEG.row(Setting {
    kind: degrees_of(1080.0, "degrees for each of six joints"),
    count: count(6, "angles", "six, separated by commas"),
    unit: "deg",
    value: "Q1,..,Q6",
    absent: Absent::Required,
    help: "The six joint angles as the robot reports them, separated by commas",
    example: "0,-90,90,0,45,0",
    ..ROW
});
/// Where the tool points.
pub(super) const TOOL_DIRECTION: Setting = opt::TOOL_DIRECTION.row(Setting {
    kind: Kind::Elevation,
    value: "DIRECTION",
    absent: Absent::Means("down"),
    help: "The tool axis: down, forward, up, or its angle above the horizontal in degrees",
    example: "forward",
    ..TOOL
});
/// Which way a zone faces.
pub(super) const YAW: Setting = opt::YAW_DEG.row(Setting {
    verbs: ONLY_PLACING,
    kind: Kind::Yaw,
    unit: "deg",
    absent: Absent::Means("the best of -90..90"),
    help: "Angle of the zone about the vertical, 0 faces the robot; or any",
    example: "30",
    ..TOOL
});
/// How the tool is turned about its axis.
pub(super) const ROLL: Setting = opt::ROLL_DEG.row(Setting {
    kind: degrees_of(360.0, "degrees"),
    unit: "deg",
    absent: Absent::Means("the best"),
    help: "Rotation about the tool axis; 0 has the tool's x axis ahead, with the tool up (as down under a ceiling) back, on a wall upright",
    example: "45",
    ..TOOL
});
/// What pushes on the tool in a zone.
pub(super) const CUTTING_FORCE: Setting = opt::FORCE_N.row(Setting {
    kind: Kind::Force,
    unit: "N",
    value: "N",
    absent: Absent::Default("1000"),
    help: "Cutting force: its size, in its worst direction; or three numbers along the feed, across it and axial (away from the work), in the planar model ahead,0,up",
    example: "300,0,100",
    ..ROW
});
/// What the tool weighs.
pub(super) const MASS: Setting = opt::TOOL_MASS_KG.row(Setting {
    kind: number_of(0.0, 1e4, "kg"),
    unit: "kg",
    value: "KG",
    help: "Mass of the tool with its spindle: compared with the robot's payload, together with the force",
    example: "25",
    ..ROW
});
/// Where the tool's mass is.
pub(super) const MASS_CENTRE: Setting = opt::TOOL_COM_MM.row(Setting {
    kind: number_of(-1e4, 1e4, "mm"),
    count: count(3, "numbers", "three, separated by commas"),
    unit: "mm",
    value: "X,Y,Z",
    help: "Mass centre of the tool in the flange frame: x,y,z; with its mass",
    example: "0,0,200",
    ..ROW
});
/// Of the place where the robot works.
pub(super) const CELL: Setting = Setting { verbs: ONLY_PLACING, of: Of::Spatial, heading: "Cell", ..ROW };
/// Of the figure alone.
pub(super) const FIGURE: Setting = Setting { verbs: PLACING, heading: DRAWN, ..ROW };
/// Of the catalogue.
pub(super) const FILTER: Setting = Setting { verbs: CHOOSING, value: "NAME", heading: FILTERS, ..ROW };
