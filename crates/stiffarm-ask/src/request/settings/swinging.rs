//! What is asked of how an arm swings.

use super::super::kind::{Kind, count, count_of, number_of};
use super::super::opt;
use super::super::setting::{Absent, Of, Setting};
use super::super::verb::Verb;
use super::shared::{JOINTS, MASS_CENTRE, ROLL, ROW, TOOL_DIRECTION, YAW};

const MODES: &[Verb] = &[Verb::Modes];
const CHATTER: &[Verb] = &[Verb::Chatter];
const MILL: &[Verb] = &[Verb::Mill];
/// At one posture.
const SWINGING: &[Verb] = &[Verb::Modes, Verb::Chatter, Verb::Map];
/// There, and along a path.
const ALL: &[Verb] = &[Verb::Modes, Verb::Chatter, Verb::Map, Verb::Mill];
/// Of what the arm holds.
const HELD: Setting = Setting { verbs: ALL, heading: "Tool", ..ROW };

/// How motion dies away.
const DAMPING: Setting = opt::DAMPING_RATIO.row(Setting {
    kind: number_of(0.0, 1.0, "of critical damping"),
    value: "ZETA",
    absent: Absent::Means("as the robot file has it of the drives, else 0.03"),
    help: "Damping of every mode, as a share of the critical: measured on such arms: 0.02 to 0.08",
    example: "0.05",
    ..ROW
});
/// What was measured at the tip.
const FRF: Setting = opt::FRF.row(Setting {
    verbs: CHATTER,
    kind: Kind::File,
    value: "FILE.csv",
    absent: Absent::Means("spindle, holder and cutter are rigid"),
    needs: &[(Verb::Chatter, "frf-on"), (Verb::Mill, "frf-on")],
    help: "How the tip answered where it was tapped: a table with freq_hz and gxx_re, gxx_im, gyy_re, gyy_im .. gzz_im in m/N along the tool axes, or one of its modes with freq_hz, damping_ratio, stiffness_n_per_m, ux, uy, uz",
    example: "tip.csv",
    ..ROW
});
/// On what the tip was held while it was measured.
const FRF_ON: Setting = opt::FRF_ON.row(Setting {
    verbs: CHATTER,
    value: "HELD",
    help: "What held the tip while it was measured",
    example: "rigid",
    ..ROW
});
/// Of how a zone is held.
const OVER_ZONE: &[(Verb, &str)] = &[(Verb::Modes, "task")];

pub(super) const ROWS: &[Setting] = &[
    Setting {
        verbs: MODES,
        absent: Absent::Means("the postures of a zone: --task with --at"),
        excludes: &["task"],
        ..JOINTS
    },
    opt::FLAT_TASK.row(Setting {
        verbs: MODES,
        kind: Kind::Zone,
        value: "TASK",
        excludes: &["joints-deg", "damping-ratio"],
        help: "Instead of a posture a flat zone, with --at: circle:D, rect:AxB, A:d, B:d, C:d with sizes in m; tells the least and the largest frequencies, and a proved least first frequency",
        example: "rect:0.4x0.6",
        ..ROW
    }),
    opt::AT.row(Setting {
        verbs: MODES,
        kind: number_of(-1e3, 1e3, "m"),
        count: count_of(2, 2, "numbers", "x,z in m"),
        unit: "m",
        value: "X,Z",
        needs: OVER_ZONE,
        help: "The place where the middle of the zone stands: so far ahead of the robot's base and so far above it; of a rectangle with --angle 0 unless another is given",
        example: "1.5,0.8",
        ..ROW
    }),
    Setting { verbs: MODES, of: Of::Any, needs: OVER_ZONE, heading: "", ..TOOL_DIRECTION },
    Setting { verbs: MODES, of: Of::Any, needs: OVER_ZONE, heading: "", absent: Absent::Means("0"), ..YAW },
    Setting { verbs: MODES, of: Of::Any, needs: OVER_ZONE, heading: "", absent: Absent::Means("the stiffest"), ..ROLL },
    opt::TOOL_MASS_KG.row(Setting {
        verbs: SWINGING,
        kind: number_of(1e-3, 5000.0, "kg"),
        unit: "kg",
        value: "KG",
        absent: Absent::Means("a tool that weighs nothing"),
        needs: &[(Verb::Modes, "tool-com-mm"), (Verb::Chatter, "tool-com-mm"), (Verb::Map, "tool-com-mm")],
        help: "Mass of the tool with its spindle, which swings with the arm; its centre says where",
        example: "60",
        ..HELD
    }),
    Setting {
        verbs: ALL,
        heading: "Tool",
        needs: &[(Verb::Mill, "tool-mass-kg"), (Verb::Map, "quantity")],
        ..MASS_CENTRE
    },
    opt::TOOL_INERTIA_KG_M2.row(Setting {
        kind: number_of(-1e4, 1e4, "kg m2"),
        count: count(6, "numbers", "six, separated by commas"),
        unit: "kg m2",
        value: "IXX,IXY,IXZ,IYY,IYZ,IZZ",
        absent: Absent::Means("none: a point mass"),
        needs: &[
            (Verb::Modes, "tool-mass-kg"),
            (Verb::Chatter, "tool-mass-kg"),
            (Verb::Map, "tool-mass-kg"),
            (Verb::Mill, "chatter"),
        ],
        help: "Inertia of the tool about its own mass centre, along flange axes: elements of the matrix as URDF has them",
        example: "1.3,0,0,1.6,0,0.5",
        ..HELD
    }),
    Setting { verbs: MODES, excludes: &["task"], ..DAMPING },
    Setting {
        verbs: &[Verb::Chatter, Verb::Mill],
        // What is not damped swings at every depth.
        kind: number_of(1e-4, 1.0, "of critical damping"),
        needs: &[(Verb::Mill, "chatter")],
        ..DAMPING
    },
    opt::COUNT.row(Setting {
        verbs: MODES,
        kind: Kind::Whole { min: 1, max: 6 },
        value: "N",
        absent: Absent::Default("6"),
        help: "How many modes are reported, the lowest first",
        example: "3",
        ..ROW
    }),
    opt::ROBOT.row(Setting {
        verbs: CHATTER,
        kind: Kind::Robot,
        value: "ROBOT",
        absent: Absent::Required,
        help: "The robot that mills: a name, or the path of a robot file",
        example: "KR 210 R2700-2",
        ..ROW
    }),
    opt::FEED.row(Setting {
        verbs: CHATTER,
        kind: number_of(-1e6, 1e6, "along an axis of the base"),
        count: count(3, "numbers", "three, separated by commas"),
        value: "X,Y,Z",
        absent: Absent::Required,
        help: "In which direction the tool feeds, along the axes of the base; what of it is along the tool axis is left out",
        example: "1,0,0",
        ..ROW
    }),
    opt::METHOD.row(Setting {
        verbs: CHATTER,
        value: "METHOD",
        absent: Absent::Means("teeth where each cuts for half of the time or less and passes slowly, else mean"),
        help: "How teeth are counted",
        example: "teeth",
        ..ROW
    }),
    FRF,
    FRF_ON,
    Setting { verbs: MILL, ..FRF },
    opt::FRF_ON.row(Setting {
        verbs: MILL,
        kind: Kind::Word(&[(
            "rigid",
            "On something rigid: spindle, holder and cutter alone; the model's robot comes on top",
        )]),
        needs: &[(Verb::Mill, "chatter")],
        help: "What held the tip while it was measured; on the robot it would hold at one posture alone, and not along a path",
        ..FRF_ON
    }),
];
