//! What is asked of the arm: its posture, its springs, its model, its tool, and the cell where it stands.

use stiffarm::cell::MOST_BLOCKS;

use super::super::kind::{Kind, count_of, degrees_of, number_of};
use super::super::opt;
use super::super::setting::{Absent, Of, Setting};
use super::super::verb::Verb;
use super::shared::{
    AT_JOINTS, CELL, COMPLIANCE, JOINTS, PLACING, POSTURE, ROLL, ROW, SPINDLE, SPRINGING_ALONE, SPRINGS, TOOL,
    TOOL_DIRECTION, WHOSE, YAW,
};

pub(super) const ROWS: &[Setting] = &[
    Setting { verbs: AT_JOINTS, ..JOINTS },
    opt::FORCE_N.row(Setting {
        verbs: COMPLIANCE,
        kind: Kind::Force,
        unit: "N",
        value: "X,Y,Z",
        help: "Force at the tool point: x,y,z in base axes, or its size, in its worst direction",
        example: "0,1000,0",
        ..ROW
    }),
    opt::FORCE_AXES.row(Setting {
        verbs: COMPLIANCE,
        value: "AXES",
        absent: Absent::Means("base"),
        needs: &[(Verb::Compliance, "force-n")],
        help: "Along which axes a force of three numbers points",
        example: "tool",
        ..ROW
    }),
    opt::FEED_DEG.row(Setting {
        verbs: COMPLIANCE,
        kind: degrees_of(360.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("the worst of all directions"),
        needs: &[(Verb::Compliance, "force-axes")],
        help: "Direction of the feed of a force along tool axes, from the tool's x axis, counter-clockwise seen from the spindle",
        example: "30",
        ..ROW
    }),
    opt::TOOL_MM.row(Setting {
        verbs: POSTURE,
        kind: Kind::Tool,
        unit: "mm, deg",
        value: "X,Y,Z",
        absent: Absent::Means("the flange centre"),
        excludes: &["tool"],
        help: "Tool frame in the flange frame: x,y,z or x,y,z,rx,ry,rz about fixed axes",
        example: "0,0,150",
        ..ROW
    }),
    opt::TOOL.row(Setting { verbs: POSTURE, of: Of::Any, heading: "", ..SPINDLE }),
    Setting {
        verbs: PLACING,
        absent: Absent::Means("as the robot file has it, else paper in the planar model and prior in space"),
        example: "prior",
        ..WHOSE
    },
    Setting {
        verbs: SPRINGING_ALONE,
        absent: Absent::Means("as the robot file has it, else prior"),
        example: "paper",
        ..WHOSE
    },
    opt::DRIVE_URAD_PER_NM.row(Setting {
        kind: Kind::Number { min: 1e-3, max: 1e4, of: "urad/(N m), or 0 for a rigid drive", or_zero: true },
        unit: "urad/(N m)",
        absent: Absent::Means("as --stiffness says"),
        excludes: &["stiffness-nm-per-rad", "stiffness"],
        help: "Compliance of the drives: one for all six, or six; of every robot that is asked for",
        example: "0.5,0.5,0.8,2,3,3",
        ..SPRINGS
    }),
    opt::STIFFNESS_NM_PER_RAD.row(Setting {
        kind: number_of(100.0, 1e9, "N m/rad"),
        unit: "N m/rad",
        excludes: &["drive-urad-per-nm", "stiffness"],
        help: "The same as a stiffness: one for all six drives, or six",
        example: "2e6",
        ..SPRINGS
    }),
    opt::MODEL.row(Setting {
        verbs: PLACING,
        value: "MODEL",
        absent: Absent::Default("planar"),
        help: "Which model",
        heading: "Model",
        example: "spatial",
        ..ROW
    }),
    opt::TOOL_MM.row(Setting {
        kind: Kind::Tool,
        unit: "mm, deg",
        value: "X,Y,Z",
        absent: Absent::Means("the flange"),
        excludes: &["tool"],
        help: "Tool frame in the flange frame: x,y,z or x,y,z,rx,ry,rz about fixed axes; its z is the tool axis",
        example: "0,0,200",
        ..TOOL
    }),
    opt::TOOL.row(Setting { ..SPINDLE }),
    TOOL_DIRECTION,
    YAW,
    ROLL,
    opt::MOUNT.row(Setting {
        kind: Kind::Mount,
        value: "MOUNT",
        absent: Absent::Means("floor"),
        help: "How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical",
        example: "pedestal:0.5",
        ..CELL
    }),
    opt::KEEP_OUT.row(Setting {
        kind: Kind::Block { of: "m", is_bounded: false },
        count: count_of(1, MOST_BLOCKS, "boxes", "at most eight"),
        unit: "m",
        value: "BOX",
        help: "What neither work nor arm may touch (with --allow-contact the work alone): x0..x1,y0..y1,z0..z1 in the cell; several with ; between, or given several times",
        example: "1.0..2.0,-3.0..-1.5,..1.2",
        ..CELL
    }),
    opt::CLEARANCE_MM.row(Setting {
        kind: number_of(0.0, 5e3, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Means("0 with --keep-out; else reported, none required"),
        excludes: &["allow-contact"],
        help: "Smallest distance of the arm, links as capsules, from floor, work, itself and what is kept free",
        example: "50",
        ..CELL
    }),
    opt::ALLOW_CONTACT.row(Setting {
        kind: Kind::Flag,
        needs: &[(Verb::Place, "keep-out"), (Verb::Rank, "keep-out"), (Verb::Compare, "keep-out")],
        excludes: &["clearance-mm"],
        value: "YES",
        absent: Absent::Default("false"),
        help: "Take the best place of the work although the arm may touch something there",
        example: "true",
        ..CELL
    }),
];
