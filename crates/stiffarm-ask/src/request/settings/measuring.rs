//! What is asked of measurements: of a table of them, and of a plan for them.

use super::super::kind::{ANY, Kind, count, count_of, number_of};
use super::super::opt;
use super::super::setting::{Absent, Of, Setting};
use super::super::verb::Verb;
use super::shared::{ROW, SEVERAL, SPINDLE};

const IDENTIFY: &[Verb] = &[Verb::Identify];
const MEASURE: &[Verb] = &[Verb::Measure];
/// Those that have to do with measurements.
const MEASURING: &[Verb] = &[Verb::Identify, Verb::Measure];
/// The heading of what the table of measurements does not say itself.
const MEASURED: &str = "Measurements";
/// Of the axes along which vectors of a table point.
const IN_AXES: Setting = Setting {
    verbs: IDENTIFY,
    value: "AXES",
    absent: Absent::Default("base"),
    heading: MEASURED,
    example: "flange",
    ..ROW
};

pub(super) const ROWS: &[Setting] = &[
    opt::DATA.row(Setting {
        verbs: IDENTIFY,
        kind: Kind::File,
        value: "DATA.csv",
        absent: Absent::Required,
        help: "A table of measurements: columns q1_deg.. q6_deg (or q1_rad ..), fx_n, fy_n, fz_n, dx_mm, dy_mm, dz_mm (or _um, _m), and optionally mx_nm .., posture, marker, sigma_mm, load_x_mm .., marker_x_mm ..",
        example: "measurements.csv",
        is_positional: true,
        ..ROW
    }),
    opt::ROBOT.row(Setting {
        verbs: IDENTIFY,
        kind: Kind::Robot,
        value: "ROBOT",
        absent: Absent::Required,
        help: "The robot that was measured: a name, or the path of a robot file",
        example: "R-2000iC/165F",
        ..ROW
    }),
    opt::LOAD_MM.row(Setting {
        verbs: MEASURING,
        kind: Kind::Point,
        unit: "mm",
        value: "X,Y,Z",
        absent: Absent::Means("the flange centre"),
        heading: MEASURED,
        help: "Where the load acts, in the flange frame; columns load_x_mm, .. overrule it",
        example: "0,50,200",
        ..ROW
    }),
    opt::MARKER_MM.row(Setting {
        verbs: MEASURING,
        kind: Kind::Marker,
        count: count_of(1, ANY, "markers", "some"),
        unit: "mm",
        value: "[NAME=]X,Y,Z",
        absent: Absent::Means("the load point"),
        heading: MEASURED,
        help: "Where a marker sits, in the flange frame; of several each with the name that the column marker tells (with ; between, or given several times); columns marker_x_mm, .. overrule it",
        example: "top=0,100,150;side=0,-100,150",
        ..ROW
    }),
    opt::LOAD_AXES.row(Setting { help: "Along which axes the forces and moments point", ..IN_AXES }),
    opt::DISPLACEMENT_AXES.row(Setting { help: "Along which axes the displacements point", ..IN_AXES }),
    opt::FIT.row(Setting {
        verbs: IDENTIFY,
        value: "FIT",
        absent: Absent::Default("least-squares"),
        help: "How the compliances are estimated",
        example: "huber",
        ..ROW
    }),
    opt::SPRINGS.row(Setting {
        verbs: IDENTIFY,
        value: "MODEL",
        absent: Absent::Default("drives"),
        help: "What is taken to spring",
        example: "auto",
        ..ROW
    }),
    opt::REGIONS.row(Setting {
        verbs: IDENTIFY,
        kind: Kind::Whole { min: 2, max: 6 },
        value: "N",
        absent: Absent::Default("2"),
        help: "In how many ranges of joint 2, of as many postures each, drive 2 has a compliance of its own in the model \"regions\"",
        example: "3",
        ..ROW
    }),
    opt::PRIOR.row(Setting {
        verbs: IDENTIFY,
        kind: Kind::Flag,
        value: "YES",
        absent: Absent::Default("false"),
        example: "true",
        help: "Update what is known of drives of robots of this payload and reach, rather than leave it aside: the robot file has the posterior; drives that the rows do not show keep the prior with its scatter",
        ..ROW
    }),
    opt::DATE.row(Setting {
        verbs: IDENTIFY,
        kind: Kind::Date,
        value: "DATE",
        heading: MEASURED,
        help: "When was measured, as year-month-day: it is reported, and stands in the robot file",
        example: "2026-05-31",
        ..ROW
    }),
    opt::GEOMETRY.row(Setting {
        verbs: MEASURE,
        kind: Kind::Flag,
        value: "YES",
        absent: Absent::Default("false"),
        help: "Plan postures in which a tracker measures points of the flange, so that calibrate finds how the arm differs from its drawing; nothing is loaded then",
        example: "true",
        ..ROW
    }),
    opt::FLAT_TASK.row(Setting {
        verbs: MEASURE,
        kind: Kind::Zone,
        value: "TASK",
        absent: Absent::Means("anywhere within the limits"),
        help: "The work over which the deflection, or with geometry the error of the arm, is to be predicted: a zone at its best place, the tool down",
        example: "rect:0.6x0.4",
        ..ROW
    }),
    opt::LOADS.row(Setting {
        verbs: MEASURE,
        kind: Kind::Way,
        count: SEVERAL,
        value: "WAYS",
        absent: Absent::Default("down"),
        help: "In which directions you can load: down (weights), up, ahead, back, left, right, or x:y:z along base axes (pulleys); separated by commas",
        example: "down,1:0:-1",
        ..ROW
    }),
    opt::LOAD_FORCE_N.row(Setting {
        verbs: MEASURE,
        kind: number_of(1.0, 1e5, "N"),
        unit: "N",
        value: "N",
        absent: Absent::Default("1000"),
        help: "How large the load is",
        example: "500",
        ..ROW
    }),
    opt::RUNS.row(Setting {
        verbs: MEASURE,
        kind: Kind::Whole { min: 2, max: 1000 },
        value: "N",
        absent: Absent::Default("20"),
        help: "How many postures and loads, or with geometry postures, are to be measured",
        example: "30",
        ..ROW
    }),
    opt::CRITERION.row(Setting {
        verbs: MEASURE,
        value: "CRITERION",
        absent: Absent::Default("prediction"),
        help: "By what a plan is judged; each is certified against every other choice of the candidates",
        example: "d",
        ..ROW
    }),
    opt::CANDIDATES.row(Setting {
        verbs: MEASURE,
        kind: Kind::Whole { min: 10, max: 1_000_000 },
        value: "N",
        absent: Absent::Default("3000"),
        help: "Among how many of them is chosen",
        example: "1000",
        ..ROW
    }),
    opt::SIGMA_MM.row(Setting {
        verbs: MEASURE,
        kind: number_of(1e-5, 10.0, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Default("0.02"),
        help: "Standard deviation of what is read of a coordinate",
        example: "0.05",
        ..ROW
    }),
    opt::POSTURE_SIGMA_MM.row(Setting {
        verbs: MEASURE,
        kind: number_of(0.0, 10.0, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Default("0.1"),
        help: "Standard deviation of what the model misses of a coordinate in a posture, alike for all markers and however often it is read there: neither more markers nor repeats take it away (where markers err less alike, planned errors are upper bounds)",
        example: "0.2",
        ..ROW
    }),
    opt::REPEATS.row(Setting {
        verbs: MEASURE,
        kind: Kind::Whole { min: 1, max: 1000 },
        value: "N",
        absent: Absent::Default("2"),
        help: "How often a posture is measured at most, whatever the load",
        example: "1",
        ..ROW
    }),
    opt::WINDOW.row(Setting {
        verbs: MEASURE,
        kind: Kind::Block { of: "m", is_bounded: false },
        unit: "m",
        value: "RANGES",
        absent: Absent::Means("above the floor"),
        help: "Where load point and markers must be: x0..x1,y0..y1,z0..z1 from the base; ranges may be left open; one below the base says that the floor is as deep",
        example: "0.5..3,-1..1,0.3..2",
        ..ROW
    }),
    opt::INSTRUMENT.row(Setting {
        keyword: "instrument_m",
        verbs: MEASURE,
        kind: number_of(-100.0, 100.0, "m"),
        count: count(3, "numbers", "x,y,z in m from the base"),
        unit: "m",
        value: "X,Y,Z",
        absent: Absent::Means("markers are seen from everywhere"),
        help: "Where the tracker or camera stands, from the base: only postures in which it sees all markers past the arm are looked at",
        example: "3,-2,1.5",
        ..ROW
    }),
    opt::MARKER_FACES.row(Setting {
        verbs: MEASURE,
        kind: Kind::Direction,
        value: "X:Y:Z",
        absent: Absent::Means("all sides"),
        needs: &[(Verb::Measure, "instrument")],
        help: "Where the markers face, along flange axes: they are seen within the acceptance of this direction",
        example: "0:0:1",
        ..ROW
    }),
    opt::ACCEPTANCE_DEG.row(Setting {
        verbs: MEASURE,
        kind: number_of(1.0, 90.0, "deg"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Default("30"),
        needs: &[(Verb::Measure, "marker-faces")],
        help: "How far a marker may be turned away from the line to the instrument",
        example: "45",
        ..ROW
    }),
    opt::TOOL_MM.row(Setting {
        verbs: MEASURE,
        kind: Kind::Tool,
        unit: "mm, deg",
        value: "X,Y,Z",
        absent: Absent::Means("the flange"),
        excludes: &["tool"],
        help: "The tool of the work in the flange frame: x,y,z or x,y,z,rx,ry,rz about fixed axes",
        example: "0,0,200",
        ..ROW
    }),
    opt::TOOL.row(Setting { verbs: MEASURE, of: Of::Any, heading: "", ..SPINDLE }),
    opt::OWN_TABLE.row(Setting {
        verbs: MEASURE,
        kind: Kind::File,
        value: "MINE.csv",
        help: "A table of postures and loads of your own: what it is worth beside the plan",
        example: "mine.csv",
        ..ROW
    }),
];
