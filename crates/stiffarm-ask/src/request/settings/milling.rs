//! What is asked of a part that is milled, of its toolpath and of a process.

use super::super::kind::{Kind, count_of, number_of};
use super::super::opt;
use super::super::setting::{Absent, Of, Setting};
use super::super::verb::Verb;
use super::shared::{MASS, ROW, SEVERAL, SPINDLE, WHOSE};

use stiffarm::cell::MOST_BLOCKS;

const MILL: &[Verb] = &[Verb::Mill];
/// Of a path that is milled.
const MILLED: Setting = Setting { verbs: MILL, ..ROW };
/// Of a toolpath.
const PATH: Setting = Setting { verbs: MILL, heading: SILENT, ..ROW };
/// The headings of what matters to reading alone.
const SILENT: &str = "Where the file is silent";
const SAMPLES: &str = "Samples";

/// It has a meaning where a path is only read.
pub(in crate::request) fn is_of_reading(setting: &Setting) -> bool {
    [SILENT, SAMPLES].contains(&setting.heading) || ["path", "dry"].contains(&setting.name)
}

pub(super) const ROWS: &[Setting] = &[
    opt::PATH.row(Setting {
        kind: Kind::File,
        value: "PATH",
        absent: Absent::Required,
        help: "A toolpath: G-code, APT or CLS, or a CSV table; or a path built in, with sizes in m: circle:D, rect:AxB, line:L, raster:ZONE@STEP",
        heading: "",
        example: "circle:0.3",
        is_positional: true,
        ..PATH
    }),
    opt::DRY.row(Setting {
        kind: Kind::Flag,
        value: "YES",
        absent: Absent::Default("false"),
        help: "Only tell what was understood of the path: lengths, moves, extents, feed rates, what was assumed and ignored",
        heading: "",
        example: "true",
        ..PATH
    }),
    opt::ROBOT.row(Setting {
        kind: Kind::Robot,
        value: "ROBOT",
        excludes: &["robots"],
        help: "The robot that mills: a name, or the path of a robot file; for several robots there is `robots`; with `dry` none is needed",
        example: "KR 210 R2700 extra",
        ..MILLED
    }),
    opt::ROBOTS.row(Setting {
        kind: Kind::Robot,
        count: SEVERAL,
        value: "ROBOTS",
        excludes: &["robot", "at", "work-frame", "compensate", "allow-contact", "pendant-as-file", "chatter"],
        help: "Robots that are ranked on the path, each at its best place: names, patterns (*), files, folders, or the sets `paper` and `all`; separated by commas or given several times",
        example: "KR 210*,BT200L",
        ..MILLED
    }),
    opt::ONLY_TOOL.row(Setting {
        kind: Kind::Whole { min: 0, max: 99_999_999 },
        value: "N",
        absent: Absent::Means("all of the path, which then has one tool"),
        help: "Mill only what the tool of this number cuts (T, LOAD); each tool of a path has a process and a length of its own",
        example: "2",
        ..MILLED
    }),
    opt::PROCESS.row(Setting {
        kind: Kind::FileOfTool,
        count: SEVERAL,
        value: "PROCESS",
        excludes: &["force-n"],
        help: "A process file (TOML): tool, material and engagement, or a force as it is; the mean force over a revolution acts. T1=FILE,T2=FILE: one for each tool of a path that changes its tool",
        example: "endmill.toml",
        ..MILLED
    }),
    opt::TOOL_LENGTHS_MM.row(Setting {
        kind: Kind::LengthOfTool,
        count: SEVERAL,
        unit: "mm",
        value: "LENGTHS",
        needs: &[(Verb::Mill, "process")],
        help: "How far the tip of each tool of the path stands out of the spindle, along the tool axis: T1=82.5,T2=140; the tool point (tool, tool-mm) is then the spindle's nose, from which tools are measured",
        example: "T1=82.5,T2=140",
        ..MILLED
    }),
    opt::FORCE_N.row(Setting {
        kind: Kind::Force,
        unit: "N",
        value: "F",
        excludes: &["process"],
        help: "Cutting force on the tool: FEED,ACROSS,AXIAL (across: left of the feed, seen from the spindle; axial: away from the work), or its size, in its worst direction",
        example: "300,-120,80",
        ..MILLED
    }),
    opt::STOCK_MM.row(Setting {
        kind: Kind::Block { of: "mm", is_bounded: true },
        unit: "mm",
        value: "BOX",
        needs: &[(Verb::Mill, "process")],
        help: "The block from which the part is cut, in the path's frame: x0..x1,y0..y1,z0..z1; entry, exit and depth of the cut are then computed along the path, and arm and spindle keep clear of what is left of it (three axes, flat mills)",
        example: "-50..50,-50..50,-20..0",
        ..MILLED
    }),
    opt::AT.row(Setting {
        kind: number_of(-1e3, 1e3, "m, and deg of yaw"),
        count: count_of(3, 4, "numbers", "x,y,z in m, or x,y,z and the yaw in deg"),
        value: "X,Y,Z,YAW",
        absent: Absent::Means("the best place within --within"),
        excludes: &["within", "robots", "clear-of-base-m"],
        help: "Where the path's origin stands, m from the robot's base, or with --mount from the cell's origin, and by how many degrees the part is turned about the vertical",
        example: "1.6,0,0.6,30",
        ..MILLED
    }),
    opt::WITHIN.row(Setting {
        keyword: "within_m",
        kind: Kind::Within,
        value: "RANGES",
        absent: Absent::Means("in front of the joint-1 axis, above the floor"),
        excludes: &["at"],
        count: count_of(1, MOST_BLOCKS, "windows", "at most eight"),
        help: "Where all of the path must stand, in m from the robot's base: x0..x1,z0..z1 about it, or x0..x1,y0..y1,z0..z1 in the cell (several with ; between); ranges may be left open, and with --mount count from the cell's floor",
        example: "1.0..,0.5..2",
        ..MILLED
    }),
    opt::MOUNT.row(Setting {
        kind: Kind::Mount,
        value: "MOUNT",
        absent: Absent::Means("floor"),
        help: "How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical",
        heading: "Cell",
        example: "pedestal:0.5",
        ..MILLED
    }),
    opt::KEEP_OUT.row(Setting {
        kind: Kind::Block { of: "m", is_bounded: false },
        count: count_of(1, MOST_BLOCKS, "boxes", "at most eight"),
        unit: "m",
        value: "BOX",
        help: "Where neither path nor arm may go: x0..x1,y0..y1,z0..z1 in the cell; several with ; between, or given several times",
        heading: "Cell",
        example: "1.0..2.0,-3.0..-1.5,..1.2",
        ..MILLED
    }),
    opt::CLEARANCE_MM.row(Setting {
        kind: number_of(0.0, 5e3, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Means("0; of several robots not looked at"),
        help: "Smallest distance that arm and tool, links as capsules, keep along the path from floor, themselves and what is kept free",
        heading: "Cell",
        example: "20",
        ..MILLED
    }),
    opt::PART.row(Setting {
        kind: Kind::File,
        value: "FILE.stl",
        help: "The finished part as STL in the path's frame: arm and spindle keep clear of it, the cutter may touch it",
        heading: "Cell",
        example: "part.stl",
        ..MILLED
    }),
    opt::FIXTURE.row(Setting {
        kind: Kind::File,
        value: "FILE.stl",
        help: "What holds the part as STL in the path's frame: arm, spindle and cutter keep clear of it",
        heading: "Cell",
        example: "fixture.stl",
        ..MILLED
    }),
    opt::PART_UNIT.row(Setting {
        value: "UNIT",
        absent: Absent::Default("mm"),
        needs: &[(Verb::Mill, "part"), (Verb::Mill, "fixture")],
        help: "Of the lengths in the STL files, which name none",
        heading: "Cell",
        example: "m",
        ..MILLED
    }),
    opt::STICK_OUT_MM.row(Setting {
        kind: number_of(0.0, 5e3, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Means(
            "the length of the tool (tool-lengths-mm); else the tool is not compared with part, stock and fixture",
        ),
        needs: &[(Verb::Mill, "part"), (Verb::Mill, "stock-mm"), (Verb::Mill, "fixture")],
        help: "How far the cutter stands out of the spindle: so near to its tip nothing of the tool can touch part or stock",
        heading: "Cell",
        example: "80",
        ..MILLED
    }),
    opt::ALLOW_CONTACT.row(Setting {
        kind: Kind::Flag,
        excludes: &["robots"],
        value: "YES",
        absent: Absent::Default("false"),
        help: "Write programs of a path along which the arm comes nearer to something than it should",
        heading: "Cell",
        example: "true",
        ..MILLED
    }),
    opt::ROLL.row(Setting {
        kind: Kind::Roll,
        unit: "deg",
        value: "MODE",
        absent: Absent::Default("free"),
        excludes: &["pin"],
        help: "How the tool is turned about its axis: free (from sample to sample, as is best), constant (the best of all), linear (changing evenly), or so many degrees of its x axis from the part's, clockwise seen from the spindle",
        example: "constant",
        ..MILLED
    }),
    opt::PIN.row(Setting {
        kind: Kind::Pin,
        count: SEVERAL,
        value: "MM@DEG",
        excludes: &["roll"],
        needs: &[(Verb::Mill, "at")],
        help: "So many mm along the path the roll must be so many degrees, and is as is best on the way there and on; separated by commas or given several times",
        example: "0@30,150@75",
        ..MILLED
    }),
    opt::ERROR.row(Setting {
        value: "PART",
        absent: Absent::Default("total"),
        help: "What of the displacement counts",
        example: "across",
        ..MILLED
    }),
    opt::TOLERANCE_MM.row(Setting {
        kind: number_of(1e-4, 1e3, "mm"),
        unit: "mm",
        value: "MM",
        help: "Largest error that passes",
        example: "0.3",
        ..MILLED
    }),
    opt::WORK_FRAME.row(Setting {
        value: "HOW",
        excludes: &["robots"],
        absent: Absent::Default("touched"),
        help: "How the place of the work was found, for the error of the arm's own geometry",
        heading: "Compensation",
        example: "measured",
        ..MILLED
    }),
    opt::COMPENSATE.row(Setting {
        kind: Kind::Flag,
        excludes: &["robots"],
        value: "YES",
        absent: Absent::Default("false"),
        help: "Take the deflection out: tell what is left of it, and which joints and tips are to be commanded; -o writes programs with them",
        heading: "Compensation",
        example: "true",
        ..MILLED
    }),
    opt::STIFFNESS_UNCERTAINTY.row(Setting {
        kind: number_of(0.0, 2.0, "(relative)"),
        value: "SHARE",
        absent: Absent::Means("as the robot file or the prior has it"),
        needs: &[(Verb::Mill, "compensate")],
        help: "Standard deviation of the logarithm of the compliance of every drive, for what compensation leaves",
        heading: "Compensation",
        example: "0.2",
        ..MILLED
    }),
    opt::CHATTER.row(Setting {
        kind: Kind::Flag,
        excludes: &["robots"],
        needs: &[(Verb::Mill, "process")],
        value: "YES",
        absent: Absent::Default("false"),
        help: "Tell whether the cuts swing with the arm, and from which depth: at every sample, and with intervals at the worst; flat end mills and a robot whose masses are known",
        heading: "Tool",
        example: "true",
        ..MILLED
    }),
    opt::PENDANT_AS_FILE.row(Setting {
        kind: Kind::Flag,
        excludes: &["robots"],
        value: "YES",
        absent: Absent::Default("false"),
        help: "The pendant shows the joints as the robot file counts them (zeros, signs, joint 3): programs then begin with a move in joints where the file does not say so",
        heading: "Programs",
        example: "true",
        ..MILLED
    }),
    opt::SPEED_SHARE.row(Setting {
        kind: number_of(1e-3, 1.0, "of the joints' speeds"),
        value: "SHARE",
        absent: Absent::Default("0.8"),
        help: "Of the largest speed of every joint what is used while cutting, where the robot file tells speeds",
        example: "0.5",
        ..MILLED
    }),
    opt::LIMIT_MARGIN_DEG.row(Setting {
        kind: number_of(0.0, 90.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Default("5"),
        help: "What every joint keeps from either end of its range",
        heading: "Margins",
        example: "10",
        ..MILLED
    }),
    opt::SINGULAR_MARGIN_DEG.row(Setting {
        kind: number_of(0.0, 45.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Default("5"),
        help: "What wrist and arm keep from straight",
        heading: "Margins",
        example: "10",
        ..MILLED
    }),
    opt::CLEAR_OF_BASE_M.row(Setting {
        kind: number_of(0.0, 20.0, "m"),
        unit: "m",
        value: "M",
        absent: Absent::Means("the robot's own column, estimated as a1 + 0.15 (c2 + l3)"),
        excludes: &["at"],
        help: "What the whole path keeps from the joint-1 axis",
        heading: "Margins",
        example: "0.8",
        ..MILLED
    }),
    opt::FLOOR.row(Setting {
        keyword: "floor_m",
        kind: Kind::Floor,
        unit: "m",
        value: "M",
        absent: Absent::Means("0, unless --within says how low the path may stand"),
        help: "Height of the floor from the robot's base, or none; all of the path stands above it",
        heading: "Margins",
        example: "-0.5",
        ..MILLED
    }),
    opt::TOOL_MM.row(Setting {
        kind: Kind::Tool,
        unit: "mm, deg",
        value: "X,Y,Z",
        absent: Absent::Means("the flange centre"),
        excludes: &["tool"],
        help: "Tool frame in the flange frame: x,y,z or x,y,z,rx,ry,rz about fixed axes; z out of the spindle to the tip",
        heading: "Robot",
        example: "0,0,150",
        ..MILLED
    }),
    opt::TOOL.row(Setting { verbs: MILL, of: Of::Any, heading: "Robot", ..SPINDLE }),
    Setting { verbs: MILL, heading: "Robot", ..MASS },
    Setting { verbs: MILL, absent: Absent::Means("as the robot file has it, else prior"), example: "paper", ..WHOSE },
    opt::READ_AS.row(Setting {
        value: "FORMAT",
        absent: Absent::Means("by the ending of its name"),
        help: "How the path is written",
        example: "gcode",
        ..PATH
    }),
    opt::UNIT.row(Setting {
        value: "UNIT",
        absent: Absent::Means("mm"),
        help: "Of lengths, where the file names none",
        example: "inch",
        ..PATH
    }),
    opt::ARC_CENTRES.row(Setting {
        value: "FROM",
        absent: Absent::Means("the reading in which arcs close"),
        help: "What centres of arcs in G-code count from",
        example: "absolute",
        ..PATH
    }),
    opt::ARC_SENSE.row(Setting {
        value: "HAND",
        absent: Absent::Means("that of the program which wrote the file"),
        help: "In which sense arcs of APT turn",
        example: "left",
        ..PATH
    }),
    opt::CUTTER_COMPENSATION.row(Setting {
        value: "HOW",
        absent: Absent::Default("refuse"),
        help: "What is done about a path that is not that of the tool's centre",
        example: "centre",
        ..PATH
    }),
    opt::INCREMENTAL_CYCLES.row(Setting {
        value: "FROM",
        absent: Absent::Means("such cycles are refused"),
        help: "What R and Z of drilling cycles count from under G91",
        example: "initial",
        ..PATH
    }),
    opt::ROTARY.row(Setting {
        value: "MACHINE",
        absent: Absent::Means("angles that turn anything are refused"),
        help: "What A, B and C turn; X, Y and Z are the tip in the part",
        example: "table-ac",
        ..PATH
    }),
    opt::COLUMNS.row(Setting {
        count: SEVERAL,
        value: "NAMES",
        absent: Absent::Means("the header"),
        help: "Names of the columns of a CSV file without a header, separated by commas: x_mm, y_mm, z_mm, i, j, k or nx, ny, nz, feed_mm_per_min, rapid; - for one that moves nothing",
        example: "x_mm,y_mm,z_mm",
        ..PATH
    }),
    opt::FEED_MM_PER_MIN.row(Setting {
        kind: number_of(1e-3, 1e6, "mm/min"),
        unit: "mm/min",
        value: "F",
        help: "Feed rate, where the file says none",
        example: "1000",
        ..PATH
    }),
    opt::CHORD_MM.row(Setting {
        kind: number_of(1e-6, 100.0, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Default("0.01"),
        help: "By how much the chord between two samples may be off an arc",
        heading: SAMPLES,
        example: "0.1",
        ..PATH
    }),
    opt::STEP_MM.row(Setting {
        kind: number_of(1e-3, 10_000.0, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Default("10"),
        help: "Longest way between two samples",
        heading: SAMPLES,
        example: "5",
        ..PATH
    }),
    opt::PROCESS.row(Setting {
        verbs: &[Verb::Force, Verb::Chatter],
        kind: Kind::File,
        value: "PROCESS",
        absent: Absent::Required,
        help: "A process file (TOML): tool, material, engagement and spindle, or a force as it is",
        example: "endmill.toml",
        is_positional: true,
        ..ROW
    }),
];
