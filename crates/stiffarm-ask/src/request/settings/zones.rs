//! What is asked of robots and of the zones where they work.

use stiffarm::cell::MOST_BLOCKS;

use super::super::kind::{Kind, count_of, degrees_of, number_of};
use super::super::opt;
use super::super::setting::{Absent, DRAWN, Of, Setting};
use super::super::verb::Verb;
use super::shared::{
    A_ZONE, BENDING, COMPARE, CUTTING_FORCE, HOLDING, MAP, MARGIN, MASS, MASS_CENTRE, OF_ONE_ROBOT, ONLY_PLACING,
    PLACE, PLACING, RANK, ROW, SETUP, SEVERAL, WITH_FORCE,
};

pub(super) const ROWS: &[Setting] = &[
    opt::ROBOT.row(Setting {
        verbs: OF_ONE_ROBOT,
        kind: Kind::Robot,
        value: "ROBOT",
        absent: Absent::Required,
        help: "A robot's name, or the path of a robot file",
        example: "KR 210 R2700 extra",
        is_positional: true,
        ..ROW
    }),
    opt::A.row(Setting {
        value: "A",
        help: "The first setup: a robot's name, the path of a robot file, or a job file for place, which may say more",
        example: "KR 210 R2700 extra",
        ..SETUP
    }),
    opt::B.row(Setting { value: "B", help: "The second setup, in the same way", example: "BT200L", ..SETUP }),
    opt::ROBOTS.row(Setting {
        verbs: RANK,
        kind: Kind::Robot,
        count: SEVERAL,
        value: "ROBOTS",
        absent: Absent::Means("paper; all where robots are chosen by maker, payload, reach, architecture or status"),
        help: "Robots: names, patterns (*), files, folders, or the sets `paper` and `all`; separated by commas or given several times",
        example: "KR 210*,BT200L",
        ..ROW
    }),
    opt::TASK.row(Setting {
        keyword: "tasks",
        verbs: RANK,
        kind: Kind::Task,
        count: SEVERAL,
        value: "TASK",
        absent: Absent::Default("A:0.1,A:1.0,B:0.1,B:0.5,C:0.05,C:0.15"),
        help: "Tasks: circle:D, rect:AxB, A:d, B:d, C:d with sizes in m, or with --model spatial a part, box:AxBxC; separated by commas or given several times; or a toolpath alone, with the options of mill",
        example: "A:0.3,rect:0.6x0.4",
        ..ROW
    }),
    opt::TASK.row(Setting {
        verbs: PLACE,
        kind: Kind::Task,
        value: "TASK",
        absent: Absent::Required,
        help: "circle:D, rect:AxB, A:d, B:d, C:d with sizes in m, or with --model spatial a part: box:AxBxC, or part: and its faces; or a toolpath, with the options of mill",
        example: "rect:0.6x0.4",
        ..ROW
    }),
    opt::TASK.row(Setting {
        verbs: COMPARE,
        kind: Kind::Task,
        value: "TASK",
        help: "circle:D, rect:AxB, A:d, B:d, C:d with sizes in m, or with --model spatial a part; of setups whose job files name none",
        example: "rect:0.6x0.4",
        ..ROW
    }),
    opt::FACES.row(Setting {
        verbs: ONLY_PLACING,
        of: Of::Spatial,
        kind: Kind::Text,
        count: SEVERAL,
        value: "FACES",
        absent: Absent::Means("all: of a box top, front, left, back, right"),
        help: "Which faces of a part are machined, by name, separated by commas; front faces the robot before the part is turned",
        example: "top,front",
        ..ROW
    }),
    opt::TOLERANCE_MM.row(Setting {
        verbs: PLACING,
        kind: number_of(1e-6, 1e3, "mm"),
        unit: "mm",
        value: "MM",
        help: "Largest deflection that is acceptable: adds pass or fail; in figures a line",
        example: "2",
        ..ROW
    }),
    Setting { verbs: ONLY_PLACING, ..MASS },
    Setting {
        verbs: ONLY_PLACING,
        needs: &[(Verb::Rank, "tool-mass-kg"), (Verb::Place, "tool-mass-kg"), (Verb::Compare, "tool-mass-kg")],
        ..MASS_CENTRE
    },
    opt::ELBOW.row(Setting {
        verbs: MAP,
        of: Of::Planar,
        value: "ELBOW",
        absent: Absent::Means("the stiffer that reaches a point"),
        help: "Only one elbow side",
        example: "up",
        ..ROW
    }),
    opt::POSTURE.row(Setting {
        verbs: MAP,
        of: Of::Spatial,
        kind: Kind::Posture,
        value: "POSTURE",
        absent: Absent::Means("the stiffest at each point"),
        help: "Only one posture, with --model spatial: such as front,up,no-flip",
        example: "front,up,no-flip",
        ..ROW
    }),
    opt::QUANTITY.row(Setting {
        verbs: MAP,
        of: Of::Spatial,
        value: "QUANTITY",
        absent: Absent::Default("deflection"),
        help: "What is mapped, with --model spatial",
        example: "first-frequency",
        ..ROW
    }),
    opt::LAYER.row(Setting {
        verbs: MAP,
        of: Of::Spatial,
        value: "LAYER",
        absent: Absent::Means("what is mapped"),
        help: "What the figure shows, with --model spatial; the tables have all of it",
        heading: DRAWN,
        example: "limit-margin",
        ..ROW
    }),
    opt::ZONE.row(Setting {
        verbs: MAP,
        of: Of::Planar,
        kind: Kind::Zone,
        value: "TASK",
        help: "Draw the best placement of this task",
        example: "B:0.5",
        ..ROW
    }),
    opt::STEP_M.row(Setting {
        verbs: MAP,
        kind: number_of(1e-6, 10.0, "m"),
        unit: "m",
        value: "M",
        excludes: &["size"],
        help: "Distance between points",
        example: "0.05",
        ..ROW
    }),
    opt::SIZE.row(Setting {
        verbs: MAP,
        kind: Kind::Whole { min: 2, max: 100_000 },
        value: "N",
        absent: Absent::Default("400"),
        excludes: &["step-m"],
        help: "Points along the longer side",
        example: "60",
        ..ROW
    }),
    Setting { verbs: &[Verb::Rank, Verb::Place], excludes: &["process"], ..CUTTING_FORCE },
    Setting { verbs: &[Verb::Map, Verb::Compare], ..CUTTING_FORCE },
    opt::PROCESS.row(Setting {
        verbs: &[Verb::Rank, Verb::Place],
        of: Of::Spatial,
        kind: Kind::File,
        value: "PROCESS",
        excludes: &["force-n"],
        help: "A process file (TOML) in place of the cutting force: its mean force over a revolution acts along feed, across and axial; its moment is left out",
        example: "endmill.toml",
        ..ROW
    }),
    opt::FORCE_AXES.row(Setting {
        verbs: PLACING,
        of: Of::Spatial,
        value: "AXES",
        absent: Absent::Means("tool"),
        needs: WITH_FORCE,
        help: "Along which axes a force of three numbers points",
        example: "base",
        ..ROW
    }),
    opt::FEED_DEG.row(Setting {
        verbs: PLACING,
        of: Of::Spatial,
        kind: degrees_of(360.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("the worst of all directions"),
        needs: WITH_FORCE,
        help: "Direction of the feed in the face, from the first side of the zone towards the second; of a circle and of a map from straight ahead, with the tool up (as down under a ceiling) from straight back, on a wall from upright",
        example: "30",
        ..ROW
    }),
    opt::DIRECTION_DEG.row(Setting {
        verbs: PLACING,
        of: Of::Planar,
        kind: degrees_of(360.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("the worst in every point"),
        help: "Direction of the force in the arm plane, counter-clockwise from straight ahead",
        example: "30",
        ..ROW
    }),
    opt::FORCE_CONE_DEG.row(Setting {
        verbs: BENDING,
        kind: number_of(0.0, 90.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("0"),
        needs: &[(Verb::Compliance, "force-n")],
        help: "Half angle of a cone about its direction in which the force may point: the largest deflection over it",
        example: "20",
        ..ROW
    }),
    opt::COMPONENT.row(Setting {
        verbs: BENDING,
        value: "COMPONENT",
        absent: Absent::Default("total"),
        needs: &[(Verb::Compliance, "force-n")],
        help: "What of the displacement counts",
        example: "along",
        ..ROW
    }),
    opt::AT.row(Setting {
        verbs: PLACING,
        kind: number_of(-1e3, 1e3, "m"),
        count: count_of(2, 2, "numbers", "x,z in m"),
        unit: "m",
        value: "X,Z",
        absent: Absent::Means("the best place within --within"),
        needs: A_ZONE,
        excludes: &["within"],
        help: "The one place where the middle of the zone stands: so far ahead of the robot's base and so far above it, or with --mount above the cell's floor; of a rectangle with --angle 0 unless another is given",
        example: "1.5,0.8",
        ..ROW
    }),
    opt::WITHIN.row(Setting {
        keyword: "within_m",
        verbs: PLACING,
        excludes: &["at"],
        kind: Kind::Within,
        value: "RANGES",
        absent: Absent::Means("in front of the joint-1 axis, above the floor"),
        count: count_of(1, MOST_BLOCKS, "windows", "at most eight"),
        needs: A_ZONE,
        help: "Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 with x from the joint-1 axis in any direction about it, or x0..x1,y0..y1,z0..z1 in the cell (several with ; between); ranges may be left open, and with --mount count from the cell's floor",
        example: "1.0..,0.5..2",
        ..ROW
    }),
    opt::LIMIT_MARGIN_DEG.row(Setting {
        kind: number_of(0.0, 90.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("5"),
        help: "What every joint keeps from either end of its range, all over the zone",
        example: "10",
        ..MARGIN
    }),
    opt::SINGULAR_MARGIN_DEG.row(Setting {
        kind: number_of(0.0, 45.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("5"),
        help: "What wrist and arm keep from straight, all over the zone",
        example: "10",
        ..MARGIN
    }),
    opt::CLEAR_OF_BASE_M.row(Setting {
        kind: number_of(0.0, 20.0, "m"),
        unit: "m",
        value: "M",
        absent: Absent::Means("the robot's own column, estimated as a1 + 0.15 (c2 + l3)"),
        help: "What the zone keeps from the joint-1 axis",
        example: "0.8",
        ..MARGIN
    }),
    opt::FLOOR.row(Setting {
        keyword: "floor_m",
        kind: Kind::Floor,
        unit: "m",
        value: "M",
        absent: Absent::Means("0, unless --within says how low the zone may stand"),
        help: "Height of the floor from the robot's base, or none; all of the zone stands above it",
        example: "-0.5",
        ..MARGIN
    }),
    opt::ANGLE.row(Setting {
        verbs: HOLDING,
        kind: Kind::Angle,
        value: "ANGLE",
        absent: Absent::Default("axes"),
        needs: A_ZONE,
        help: "Angle of a rectangle or a part, refused where there are circles alone: axes (horizontal or vertical; under a force with --feed-deg all four quarter turns), horizontal, vertical (its long side), free, or degrees of its first side from the direction in which it lies from the joint-1 axis (with windows of three ranges from x of the cell, of a base that leans from its own)",
        example: "30",
        ..ROW
    }),
    opt::GAP.row(Setting {
        verbs: PLACING,
        of: Of::Planar,
        kind: number_of(1e-9, 0.5, "(relative)"),
        value: "RATIO",
        absent: Absent::Means("0.0001"),
        needs: A_ZONE,
        help: "Largest relative distance between a value and its proof",
        example: "0.001",
        ..ROW
    }),
];
