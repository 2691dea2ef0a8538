//! What can be reported of a toolpath as it is milled.

use super::chatter::of_cut;
use super::groups::{OF_CHANCES, OF_LOAD, OF_ROBOT, OF_VERDICT};
use super::kinds::{Kind, Unit, fields, numbers};
use super::place::shape::CELL;
use super::slots::{Slot, shapes, slots};

fields! {
    PART: "part", Kind::Object, "The path as it was cut: samples, lengths and time.";
    SAMPLES_OF_PATH: "samples", Kind::Count, "Samples along the path.";
    PATH_LENGTH: "length_m", Kind::Number(Unit::Metre), "Length of the path, rapid ways and all.";
    CUTTING_LENGTH: "cutting_length_m", Kind::Number(Unit::Metre), "Length of what feeds.";
    TIME: "time_s", Kind::Number(Unit::Second), "Time of what feeds; null where a feed rate is not said.";
    ROLL_CHOICE: "roll", Kind::Object, "How the tool is turned about its axis.";
    ROLL_MODE: "mode", Kind::Text, "free, constant, linear or fixed.";
    ROLL_FROM: "from_deg", Kind::Number(Unit::Degree), "The smallest roll: of the tool's x axis from the part's.";
    ROLL_TO: "to_deg", Kind::Number(Unit::Degree), "The largest roll.";
    PINS: "pins", Kind::Objects, "Where the roll is pinned: samples with their way along the path and their roll.";
    PINNED_SAMPLE: "sample", Kind::Count, "Which sample, from 0.";
    PINNED_WAY: "way_mm", Kind::Number(Unit::Millimetre), "How far along the path it stands.";
    PINNED_ROLL: "roll_deg", Kind::Number(Unit::Degree), "Its roll.";
    REARRANGED: "rearranged", Kind::Count, "How often the arm takes another configuration, clear of the work.";
    ERROR_PART: "error", Kind::Text, "What of the displacement counts: total, across, axial or normal.";
    SPEED_SHARE: "speed_share", Kind::Number(Unit::One), "Of the joints' speeds what is used at most; null where the robot file tells none.";
    AT: "at_m", numbers(Unit::Metre, &["at_x_m", "at_y_m", "at_z_m"]), "Where the path's origin stands, from the robot's base.";
    AT_YAW: "at_yaw_deg", Kind::Number(Unit::Degree), "By how much the part is turned about the vertical from straight ahead of the robot; null of a base that leans.";
    CELL_ORIGIN: "cell_m", numbers(Unit::Metre, &["cell_x_m", "cell_y_m", "cell_z_m"]), "Where the path's origin stands in the axes of the cell, its floor at 0; null without a cell.";
    CELL_YAW: "cell_yaw_deg", Kind::Number(Unit::Degree), "By how much the part is turned about the vertical from the cell's x axis; null without a cell.";
    PATH_WORST: "worst_mm", Kind::Number(Unit::Millimetre), "The largest error along the path.";
    PATH_WORST_P05: "worst_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile over draws of the drive stiffness, in the postures of the answer; null where the uncertainty of the drives is not known.";
    PATH_WORST_P50: "worst_mm_p50", Kind::Number(Unit::Millimetre), "Median.";
    PATH_WORST_P95: "worst_mm_p95", Kind::Number(Unit::Millimetre), "95th percentile.";
    PATH_LOWER_BOUND: "lower_bound_mm", Kind::Number(Unit::Millimetre), "No rolls of the mode that was asked for, through the pins where there are some, and where the best place was asked for no place, have less.";
    ROLL_LOWER_BOUND: "roll_lower_bound_mm", Kind::Number(Unit::Millimetre), "No rolls of that mode have less at this place.";
    RMS: "rms_mm", Kind::Number(Unit::Millimetre), "The root mean square of the error over what feeds.";
    WORST_SAMPLE: "worst_sample", Kind::Count, "The sample with the largest error, from 0.";
    WORST_TOOL: "worst_tool", Kind::Count, "The tool with the largest error, of a path that is milled with several.";
    BY_TOOL: "by_tool", Kind::Objects, "What each tool of the path does, in the order in which they mill: the keys of a path with one tool, its number and its tip.";
    ONLY_TOOL: "only_tool", Kind::Count, "The number of the only tool that mills, of several; null where all of the path is milled, and in `by_tool`.";
    TOOL_NUMBER: "tool_number", Kind::Count, "The number of the tool in the file of the path.";
    WORST_LINE: "worst_line", Kind::Count, "Its line in the file; 0 of a path built in.";
    FED_BACK: "fed_back", Kind::Object, "What becomes of the largest error as width and depth of the cut change with the displacement; null where no cut is known.";
    CONTRACTION: "contraction", Kind::Number(Unit::One), "To which part a displacement shrinks, in the long run, from round to round of displacement and force of the cut (spectral radius), at the worst sample; from 1 on nothing settles.";
    UNSETTLED: "unsettled", Kind::Count, "Samples at which nothing settles: pushed aside, the tool is drawn in.";
    PATH_CHATTER: "chatter", Kind::Object, "Whether the cuts swing with the arm, at the sample at which the critical depth is least in proportion to the cut; null where that was not asked, or the path is not followed.";
    PATH_CHATTER_VERDICT: "chatter_verdict", Kind::Text, "What is reported of robot modes and of spindle modes along a path, in words, with the sample of which it is.";
    CHATTER_SAMPLE: "at_sample", Kind::Count, "The sample at which the critical depth is least in proportion to the cut, from 0; null where no sample is covered.";
    CHATTER_LINE: "at_line", Kind::Count, "Its line in the file; 0 of a path built in.";
    FEED_DIRECTION: "feed", numbers(Unit::One, &["feed_x", "feed_y", "feed_z"]), "Where the tool feeds, of length one, base axes.";
    DEEPEST_ROLL: "deepest_roll_deg", Kind::Number(Unit::Degree), "Of the rolls, in steps of 5 deg, that keep the margins and touch nothing at the worst sample in its configuration: the one with which its cut goes deepest; null where nothing is known.";
    DEEPEST_DEPTH: "deepest_depth_mm", Kind::Number(Unit::Millimetre), "From which depth it then swings, by the mean of the teeth over a revolution; null where none up to 300 mm does.";
    DEEPEST_ERROR: "deepest_error_mm", Kind::Number(Unit::Millimetre), "The error of that sample, so rolled.";
    ROLLED_RESERVE: "rolled_reserve", Kind::Number(Unit::One), "The whole path so rolled: its least critical depth in parts of that of the cut, by the mean; null where it is not followed so, or no edge swings.";
    ROLLED_LINE: "rolled_at_line", Kind::Count, "The line of the file on which that is; null where the path is not followed so.";
    ROLLED_ERROR: "rolled_error_mm", Kind::Number(Unit::Millimetre), "The largest error along the path so rolled.";
    COVERED: "covered_samples", Kind::Count, "Samples of which a critical depth is computed.";
    NOT_COVERED: "not_covered", Kind::Objects, "Samples that feed, and of which nothing is computed: why, how many, and the lines on which they are.";
    UNCOVERED_WHY: "why", Kind::Text, "plunge, turn in place, force of the path (it gives no cut), or air.";
    UNCOVERED_LINES: "lines", Kind::List(&Kind::Count), "Lines of the file, ascending; none of a path built in.";
    MEAN_MISLEADS: "mean_misleads", Kind::Count, "Samples whose teeth cut so shortly, and pass so slowly, that their mean over a revolution misleads; only the worst is counted tooth by tooth.";
    PATH_COMPENSATION: "compensation", Kind::Object, "What compensation makes of the path; null where it was not asked for.";
    LARGEST_CORRECTION: "largest_correction_mm", Kind::Number(Unit::Millimetre), "By how much a tip is led aside at most.";
    LEFT_BY_JOINTS: "left_by_joints_mm", Kind::Number(Unit::Millimetre), "The largest error that is left by the model where joints, or whole poses, are commanded.";
    LEFT_BY_TIPS: "left_by_tips_mm", Kind::Number(Unit::Millimetre), "The same where tips alone are, the tool turned as in the path; null where one is not reached.";
    LEFT_MEDIAN: "left_median_mm", Kind::Number(Unit::Millimetre), "Median over draws of the drive stiffness; null where its uncertainty is not known.";
    LEFT_P95: "left_p95_mm", Kind::Number(Unit::Millimetre), "95th percentile over these draws.";
    UNCERTAIN: "uncertainty", Kind::Text, "The source of the uncertainty of the drive stiffness.";
    BEYOND_LIMITS: "beyond_limits", Kind::Count, "Samples at which a joint is commanded beyond its range.";
    WORK_FRAME: "work_frame", Kind::Text, "How the place of the work was found: measured or touched; null where nothing is followed.";
    TRUE_ARM: "true_arm", Kind::Object, "The largest error of the calibrated arm, geometry and load together; null of an arm that was not calibrated.";
    ERROR_WITHOUT_WIDE: "error_without_wide_mm", Kind::Number(Unit::Millimetre), "The largest error of the best path, where `clearance_wide_mm` ruled it out and this one is worse.";
    UNCORRECTED: "uncorrected_mm", Kind::Number(Unit::Millimetre), "Where nothing is corrected.";
    BY_STIFFNESS: "by_stiffness_mm", Kind::Number(Unit::Millimetre), "Where the deflection alone is; null under a force that may point anywhere.";
    BY_GEOMETRY: "by_geometry_mm", Kind::Number(Unit::Millimetre), "Where the geometry alone is.";
    BY_BOTH: "by_both_mm", Kind::Number(Unit::Millimetre), "Where both are, by the model; null under a force that may point anywhere.";
    CALIBRATION_LEFT: "calibration_left_mm", Kind::Number(Unit::Millimetre), "What the calibration leaves where it was not measured, rms.";
    ARM_ERROR: "arm_error", Kind::Object, "The largest geometric error along the path of arms that nobody has calibrated: median and 95th percentile; null of one that was calibrated.";
    SEARCH: "search", Kind::Object, "How finely a place was looked for; null where it was given.";
    SAMPLES_OF_SEARCH: "samples", Kind::Count, "Samples that stood for the path in the search.";
}

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
        slots![PATH_COMPENSATION | null => COMPENSATED_PATH, BY_TOOL => MILLED_WITH_TOOL, REMARKS],
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
    MISPLACED: "Misplaced", "Something of the work that stands where nothing may.", &[slots![BODIES, CONTACT_DEPTH]];
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

const OF_MILLED: &[Slot] = slots![ROBOT, STIFFNESS_SOURCE, PENDANT, PATH, ONLY_TOOL | null, CUTTING_FORCE];

const OF_QUESTION: &[Slot] = slots![
    PART => shape::PATH_LENGTH,
    ROLL_CHOICE => shape::ROLL_CHOICE,
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
    ERROR_WITHOUT_WIDE | null,
    ASKED_CLEARANCE | null,
    CONTACTS | null => shape::PATH_CONTACT,
    UNAVOIDABLE | null => shape::PATH_CONTACT,
    MISPLACED | null => shape::MISPLACED,
];

const OF_REST: &[Slot] = slots![
    FED_BACK | null => shape::FED_BACK,
    PATH_CHATTER | null => shape::PATH_CHATTER,
    PATH_COMPENSATION | null => shape::COMPENSATED_PATH,
    SEARCH | null => shape::PLACE_SEARCH,
    WORK_FRAME | null,
    TRUE_ARM | null => shape::TRUE_ARM,
    ARM_ERROR | null => shape::ARM_ERROR,
    REMARKS,
];
