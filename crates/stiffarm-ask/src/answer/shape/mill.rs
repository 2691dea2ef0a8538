//! Which fields does a path have that is milled?

use super::chatter::of_cut;
use super::groups::{OF_CHANCES, OF_LOAD, OF_ROBOT, OF_VERDICT};
use super::place::CELL;
use super::{Slot, shapes, slots};

shapes! {
    ARM_ERROR: "ArmError", "The geometric error of arms that nobody has calibrated.", &[slots![MEDIAN_OFF, P95_OFF]];
    COMPENSATED_PATH: "CompensatedPath", "What compensation makes of a path.", &[slots![
        LARGEST_CORRECTION, LEFT_BY_JOINTS, LEFT_BY_TIPS | null, LEFT_MEDIAN | null, LEFT_P95 | null, UNCERTAIN | null, VERDICT | null,
        PROBABILITY | null, BEYOND_LIMITS,
    ]];
    FED_BACK: "FedBackDict", "What becomes of an error as the cut changes by it.", &[slots![PATH_WORST | null, CONTRACTION, UNSETTLED]];
    MILLED: "MilledDict", "What `mill` answers of a path.", &[OF_MILLED, OF_LOAD, OF_QUESTION, OF_PLACE, OF_ERROR, OF_CLEARANCE, OF_VERDICT, OF_REST];
    MILLED_BY_TOOL: "MilledByToolDict", "What `mill` answers of a path with several tools.", &[
        slots![
            ROBOT, STIFFNESS_SOURCE, PATH, FEASIBLE, REASON | null, PATH_WORST | null, WORST_TOOL | null, WORST_LINE | null,
        ],
        OF_VERDICT,
        slots![BY_TOOL => MILLED_WITH_TOOL, REMARKS],
    ];
    MILLED_WITH_TOOL: "MilledWithTool", "What one tool of several mills.", &[
        slots![TOOL_NUMBER, TOOL], OF_MILLED, OF_LOAD, OF_QUESTION, OF_PLACE, OF_ERROR, OF_CLEARANCE, OF_VERDICT, OF_REST,
    ];
    PATH_CHATTER: "PathChatter", "Whether the cuts of a path swing with the arm.", &[
        slots![
            PATH_CHATTER_VERDICT | null, COVERED, NOT_COVERED => UNCOVERED_SAMPLES, MEAN_MISLEADS, CHATTER_SAMPLE | null,
            CHATTER_LINE | null, JOINTS | null, FEED_DIRECTION | null,
        ],
        of_cut!(| null),
        slots![
            DEEPEST_ROLL | null, DEEPEST_DEPTH | null, DEEPEST_ERROR | null, ROLLED_RESERVE | null, ROLLED_LINE | null,
            ROLLED_ERROR | null,
        ],
    ];
    PATH_CONTACT: "PathContact", "A stretch of a path along which the arm is nearer to something than it was to keep.",
        &[slots![LINE, CONTACT_WAY, BODIES, CONTACT_DEPTH]];
    PATH_LENGTH: "PathLength", "How long a path is.", &[slots![
        SAMPLES_OF_PATH, PATH_LENGTH, CUTTING_LENGTH, TIME | null, BOX | null, RAPID_LENGTH, RAPID_BOX | null,
    ]];
    PATH_RANKING: "PathRankingDict", "What `mill --robots` and `rank --task PATH` answer.", &[slots![
        PATH, CUTTING_FORCE | null, PART | null => PATH_LENGTH, ERROR_PART | null, ROWS => PATH_RANKING_ROW, SUMMARY, REMARKS,
    ]];
    PATH_RANKING_ROW: "PathRankingRow", "One robot of a ranking on a path.", &[
        OF_ROBOT,
        OF_LOAD,
        slots![
            RANK | null, RANK_TIED | null, FEASIBLE | null, REASON | null, PATH_WORST | null, PATH_WORST_P05 | null, PATH_WORST_P50 | null,
            PATH_WORST_P95 | null, PATH_LOWER_BOUND | null, RMS | null, ROLL_CHOICE | null => ROLL_CHOICE,
        ],
        OF_PLACE,
        slots![LIMIT_MARGIN | null, SINGULAR_MARGIN | null],
        OF_CLEARANCE,
        OF_VERDICT,
        OF_CHANCES,
        slots![SEARCH | null => PLACE_SEARCH],
    ];
    PINNED_ROLL: "PinnedRoll", "A roll that is pinned.", &[slots![PINNED_SAMPLE, PINNED_WAY, PINNED_ROLL]];
    PLACE_SEARCH: "PlaceSearch", "How finely a place was looked for.", &[slots![FINE_STEP, SAMPLES_OF_SEARCH, BOXES]];
    ROLL_CHOICE: "RollChoice", "How the tool is turned about its axis.", &[slots![
        ROLL_MODE, ROLL_FROM | null, ROLL_TO | null, PINS => PINNED_ROLL, POSTURE | null, REARRANGED | null,
    ]];
    TRUE_ARM: "TrueArm", "The largest error of a calibrated arm, geometry and load together.",
        &[slots![UNCORRECTED, BY_STIFFNESS | null, BY_GEOMETRY, BY_BOTH | null, CALIBRATION_LEFT | null, BEYOND_LIMITS]];
    UNCOVERED_SAMPLES: "UncoveredSamples", "Samples of a path of whose chatter nothing is known.",
        &[slots![UNCOVERED_WHY, SAMPLES_OF_PATH, UNCOVERED_LINES]];
}

const OF_MILLED: &[Slot] = slots![ROBOT, STIFFNESS_SOURCE, PENDANT, PATH, CUTTING_FORCE];

const OF_QUESTION: &[Slot] = slots![
    PART => PATH_LENGTH,
    ROLL_CHOICE => ROLL_CHOICE,
    ERROR_PART,
    ASKED_LIMIT_MARGIN,
    ASKED_SINGULAR_MARGIN,
    SPEED_SHARE | null,
    CLEAR_OF_BASE | null,
    ROBOT_CELL | null => CELL,
];

const OF_PLACE: &[Slot] = slots![AT | null, AT_YAW | null, CELL_ORIGIN | null, CELL_YAW | null];

const OF_ERROR: &[Slot] = slots![
    FEASIBLE,
    REASON | null,
    PATH_WORST | null,
    PATH_WORST_P05 | null,
    PATH_WORST_P50 | null,
    PATH_WORST_P95 | null,
    PATH_LOWER_BOUND | null,
    ROLL_LOWER_BOUND | null,
    RMS | null,
    WORST_SAMPLE | null,
    WORST_LINE | null,
    WORST_JOINTS | null,
    WORST_SHARES | null,
    LIMIT_MARGIN | null,
    SINGULAR_MARGIN | null,
];

const OF_CLEARANCE: &[Slot] = slots![
    CLEARANCE | null,
    CLEARANCE_OF | null,
    CLEARANCE_BY | null,
    CLEARANCE_OUTSIDE | null,
    CLEARANCE_WIDE | null,
    CLEARANCE_WIDE_OF | null,
    ASKED_CLEARANCE | null,
    CONTACTS | null => PATH_CONTACT,
    UNAVOIDABLE | null => PATH_CONTACT,
];

const OF_REST: &[Slot] = slots![
    FED_BACK | null => FED_BACK,
    PATH_CHATTER | null => PATH_CHATTER,
    PATH_COMPENSATION | null => COMPENSATED_PATH,
    SEARCH | null => PLACE_SEARCH,
    WORK_FRAME | null,
    TRUE_ARM | null => TRUE_ARM,
    ARM_ERROR | null => ARM_ERROR,
    REMARKS,
];
