//! What is asked of readings of an arm: does its file count the joints as they do, and how does this very arm differ from its drawing?

use super::super::kind::{Kind, count, number_of};
use super::super::opt;
use super::super::setting::{Absent, Setting};
use super::super::verb::Verb;
use super::shared::{ROW, SEVERAL};

const CALIBRATE: &[Verb] = &[Verb::Calibrate];
const VERIFY: &[Verb] = &[Verb::Verify];
const READING: &[Verb] = &[Verb::Calibrate, Verb::Verify];
/// A frame that is fitted where it is not given.
const FRAME: Setting = Setting {
    verbs: VERIFY,
    kind: Kind::Tool,
    unit: "mm, deg",
    value: "FRAME",
    absent: Absent::Means("fitted"),
    example: "0,0,200",
    ..ROW
};

pub(super) const ROWS: &[Setting] = &[
    opt::ROBOT.row(Setting {
        verbs: VERIFY,
        kind: Kind::Robot,
        value: "ROBOT",
        help: "A robot's name, or the path of a robot file; may be left out with --any",
        example: "KR 210 R2700 extra",
        is_positional: true,
        ..ROW
    }),
    opt::DATA.row(Setting {
        verbs: CALIBRATE,
        kind: Kind::File,
        value: "POINTS.csv",
        absent: Absent::Required,
        help: "The table: joint_1_deg .. joint_6_deg as the robot reports them, and one to four points x1_mm, y1_mm, z1_mm .. in the tracker's frame, empty where one was not seen; or one point and a quaternion qw, qx, qy, qz",
        example: "tracker.csv",
        is_positional: true,
        ..ROW
    }),
    opt::DATA.row(Setting {
        verbs: VERIFY,
        kind: Kind::File,
        value: "READINGS.csv",
        absent: Absent::Required,
        help: "The table of readings: joint_1_deg .. joint_6_deg, x_mm, y_mm, z_mm as the pendant shows them, and the maker's angles where it does (a_deg ..; w_deg ..; q1 .. q4; rx_deg ..; o_deg ..); or measured points x1_mm, y1_mm, z1_mm ..",
        example: "pendant.csv",
        is_positional: true,
        ..ROW
    }),
    opt::ANY.row(Setting {
        verbs: VERIFY,
        kind: Kind::Flag,
        value: "YES",
        absent: Absent::Default("false"),
        help: "Try all robots of the catalogue, not only those of the same maker; which robot are the readings from, where none is named",
        example: "true",
        ..ROW
    }),
    opt::BASE_MM.row(Setting {
        help: "The base of the robot file in the frame of the readings: x,y,z or x,y,z,rx,ry,rz about fixed axes, 0,0,0 where no base is in force; shows the zero of joint 1",
        ..FRAME
    }),
    opt::TOOL_MM.row(Setting {
        help: "The tool in force, in the flange frame: x,y,z or x,y,z,rx,ry,rz about fixed axes, 0,0,0 where none is; shows the zero of joint 6",
        ..FRAME
    }),
    opt::LEVEL.row(Setting {
        verbs: CALIBRATE,
        value: "LEVEL",
        absent: Absent::Default("auto"),
        help: "How much may differ from the drawing",
        example: "geometry",
        ..ROW
    }),
    opt::HEADINGS.row(Setting {
        verbs: READING,
        kind: Kind::Heading,
        count: SEVERAL,
        value: "NAME=HEADING",
        absent: Absent::Means("as they are called here"),
        help: "What columns are called in the table: joint_1_deg=J1,x1_mm=X",
        example: "joint_1_deg=J1",
        ..ROW
    }),
    opt::FRAME_BY.row(Setting {
        verbs: READING,
        value: "COLUMN",
        absent: Absent::Means("one frame"),
        help: "The column that tells apart where the tracker stood; each stand has a frame of its own",
        example: "station",
        ..ROW
    }),
    opt::AT.row(Setting {
        verbs: CALIBRATE,
        kind: number_of(-20.0, 20.0, "m"),
        count: count(3, "numbers", "x,y,z in m from the base"),
        unit: "m",
        value: "X,Y,Z",
        absent: Absent::Means("over all the arm reaches"),
        help: "Where the work is, from the robot's base: the error that remains is computed within 0.25 m about it",
        example: "1.8,0,0.8",
        ..ROW
    }),
    opt::CONTROLLER_MODEL.row(Setting {
        verbs: CALIBRATE,
        value: "MODEL",
        absent: Absent::Means("no program is written of the robot file"),
        help: "With which arm the controller computes while it is measured, and later: for the robot file",
        example: "nominal",
        ..ROW
    }),
    opt::DATE.row(Setting {
        verbs: READING,
        kind: Kind::Date,
        value: "DATE",
        absent: Absent::Means("today"),
        help: "When it was read or measured, as year-month-day: for the robot file",
        example: "2026-05-31",
        ..ROW
    }),
];
