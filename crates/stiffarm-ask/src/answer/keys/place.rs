//! What can be reported of a place, what it rests on, and what is advised where a tolerance is missed.

use super::groups::{OF_FORCE, OF_LOAD, OF_ROBOT, OF_SPREAD, OF_VERDICT};
use super::kinds::{Kind, Unit, fields, numbers, open_numbers};
use super::slots::{Slot, shapes, slots};

fields! {
    ROBOT: "robot", Kind::Text, "The maker's name for the robot.";
    VENDOR: "vendor", Kind::Text, "The maker.";
    ARCHITECTURE: "architecture", Kind::Text, "serial or quasi-serial.";
    ARCHITECTURE_ASSUMED: "architecture_assumed", Kind::Truth, "Nothing says that it is of this architecture.";
    STATUS: "status", Kind::Text, "How well the robot's numbers are known.";
    STIFFNESS_SOURCE: "stiffness_source", Kind::Text, "Who says how stiff the drives are: assumed, prior, published, robot file, identified or given.";
    DRIVE_COMPLIANCE: "drive_urad_per_nm", open_numbers(Unit::MicroradianPerNewtonMetre, &["k1_urad_per_nm", "k2_urad_per_nm", "k3_urad_per_nm", "k4_urad_per_nm", "k5_urad_per_nm", "k6_urad_per_nm"]),
        "The compliance of each drive; null where a robot of two links has none.";
    TASK: "task", Kind::Text, "The zone as it was asked for.";
    MODEL: "model", Kind::Text, "planar or spatial; of an identification what springs: drives, base, tool or base-and-tool.";
    FORCE: "force_n", Kind::Number(Unit::Newton), "The cutting force.";
    FORCE_AXES: "force_axes", Kind::Text, "Along which axes its direction is given: base (ahead, left, up) or tool (feed, across, axial); null for the worst.";
    FORCE_DIRECTION: "force_direction", numbers(Unit::One, &["force_direction_1", "force_direction_2", "force_direction_3"]), "Its unit direction along these axes.";
    FORCE_CONE: "force_cone_deg", Kind::Number(Unit::Given("deg")), "By how much it may point aside.";
    FEED: "feed_deg", Kind::Number(Unit::Given("deg")), "Direction of the feed from the first side of the zone, of one posture from the x axis of the tool; null where it may go any way.";
    COMPONENT: "component", Kind::Text, "What of the displacement counts: total, normal (to the face) or along (the force).";
    TOOL: "tool_mm", numbers(Unit::Given("mm"), &["tool_x_mm", "tool_y_mm", "tool_z_mm", "tool_rx_deg", "tool_ry_deg", "tool_rz_deg"]),
        "The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg.";
    TOOL_DIRECTION: "tool_direction_deg", Kind::Number(Unit::Given("deg")), "The tool axis above the horizontal.";
    WITHIN: "within_m", Kind::Numbers { unit: Unit::Metre, columns: &["within_x0_m", "within_x1_m", "within_z0_m", "within_z1_m"], nested: 2, open: true },
        "Where the zone may stand; null where it is open.";
    ASKED_LIMIT_MARGIN: "asked_limit_margin_deg", Kind::Number(Unit::Degree), "What every joint was to keep from its limits.";
    ASKED_SINGULAR_MARGIN: "asked_singular_margin_deg", Kind::Number(Unit::Degree), "What wrist and arm were to keep from straight.";
    CLEAR_OF_BASE: "clear_of_base_m", Kind::Number(Unit::Metre), "What the zone was to keep from the joint-1 axis; null where it is not known where that stands.";
    FLOOR_HEIGHT: "floor_m", Kind::Number(Unit::Metre), "Height of the floor above which the zone was to stand, from the base; null where there is none, and where the base leans or is on a wall: the floor is then z = 0 of the cell.";
    FEASIBLE: "feasible", Kind::Truth, "There is a place; null where it is not known.";
    REASON: "reason", Kind::Text, "Why there is no place, or it is not known.";
    PROVED: "proved", Kind::Truth, "That there is no place is proved.";
    LARGEST_SCALE: "largest_feasible_scale", Kind::Number(Unit::One), "The largest scale at which a zone of this shape has a place.";
    DEFLECTION: "deflection_mm", Kind::Number(Unit::Millimetre), "The worst deflection in the zone at its best place.";
    LOWER_BOUND: "lower_bound_mm", Kind::Number(Unit::Millimetre), "No allowed place has less.";
    DEFLECTION_P05: "deflection_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile of the deflection there over draws of the drive stiffness; null where its uncertainty is not known.";
    DEFLECTION_P50: "deflection_mm_p50", Kind::Number(Unit::Millimetre), "Their median; mostly more than at the nominal stiffness, as a soft drive adds more than a stiff one takes away.";
    DEFLECTION_P95: "deflection_mm_p95", Kind::Number(Unit::Millimetre), "Their 95th percentile.";
    WIN_PROBABILITY: "win_probability", Kind::List(&Kind::Maybe(&Kind::Number(Unit::One))), "In which share of the draws of the drive stiffness it has the least deflection, of each task; null where it has no place, is estimated, is not to be taken (its arm collides, it carries more than it may), or the uncertainty of its drives is not known.";
    EXPECTED_REGRET: "expected_regret_mm", Kind::List(&Kind::Maybe(&Kind::Number(Unit::Millimetre))), "How much more than the best it has on average, of each task.";
    TIES_WITH_BEST: "ties_with_best", Kind::List(&Kind::Maybe(&Kind::Truth)), "It ties with the best: no other robot has a smaller deflection in more than 95 % of the draws of the drive stiffness, of each task; shared ranks are about the proof.";
    X: "x_m", Kind::Number(Unit::Metre), "Ahead, from the base; of a place that is turned about the joint-1 axis before it is turned (`bearing_deg`, `cell_m`).";
    Z: "z_m", Kind::Number(Unit::Metre), "Up, from the base.";
    BEARING: "bearing_deg", Kind::Number(Unit::Degree), "Where about the joint-1 axis the zone stands.";
    YAW: "yaw_deg", Kind::Number(Unit::Degree), "Of the zone's plane about the vertical.";
    ANGLE: "angle_deg", Kind::Number(Unit::Degree), "Of the first side of a rectangle: below 180, or below 360 where the feed of a known force counts from it. Counted from the direction in which the zone lies from the joint-1 axis (on a wall from upright; for a tool that points up from the opposite direction); where the side then points is told beside it.";
    FIRST_SIDE: "first_side", numbers(Unit::One, &["first_side_x", "first_side_y", "first_side_z"]), "Which way the first side points where the zone stands, a unit vector: axes of the cell, of the base without one; null in the plane.";
    ROLL: "roll_deg", Kind::Number(Unit::Degree), "About the tool axis.";
    SHOULDER: "shoulder", Kind::Text, "front or back.";
    ELBOW: "elbow", Kind::Text, "up or down.";
    WRIST: "wrist", Kind::Text, "no flip or flip.";
    WORST_POINT: "worst_point_m", numbers(Unit::Metre, &["worst_x_m", "worst_y_m", "worst_z_m"]), "Where in the zone the deflection is largest.";
    FROM_AXIS_1: "from_axis_1_m", Kind::Number(Unit::Metre), "Distance of the zone's nearest point from the joint-1 axis.";
    BELOW_BASE: "below_base", Kind::Truth, "Part of the zone lies below the base.";
    BEHIND_AXIS_1: "behind_axis_1", Kind::Truth, "Part of the zone lies behind the joint-1 axis.";
    WORST_JOINTS: "worst_joints_deg", numbers(Unit::Degree, &["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"]),
        "Joint angles at the worst point as the robot reports them.";
    WORST_SHARES: "worst_shares", numbers(Unit::One, &["share_1", "share_2", "share_3", "share_4", "share_5", "share_6"]),
        "What each drive gives of the worst deflection; adds up to 1.";
    LIMIT_MARGIN: "limit_margin_deg", Kind::Number(Unit::Degree), "The smallest distance of any joint to its limits in the zone.";
    LIMIT_MARGIN_JOINT: "limit_margin_joint", Kind::Count, "That joint; 0 is the angle between the links.";
    SINGULAR_MARGIN: "singular_margin_deg", Kind::Number(Unit::Degree), "The smallest angle to a singular posture in the zone.";
    SMALLEST_MARGIN: "smallest_margin_deg", Kind::Number(Unit::Degree), "The least that is kept from a joint limit or a straight posture anywhere in the zone.";
    SMALLEST_MARGIN_OF: "smallest_margin_of", Kind::Text, "What that is of: a joint, the angle between the links, the forearm's angle, or a straight posture.";
    CLEARANCE: "clearance_mm", Kind::Number(Unit::Millimetre), "The nearest that the arm comes to anything, links as capsules; negative where they overlap.";
    CLEARANCE_OF: "clearance_of", Kind::Text, "Which link to what.";
    CLEARANCE_BY: "clearance_by", Kind::List(&Kind::Text), "By which bodies that is known: those of the arm are `enclosing`, `estimated` or `stated` by the robot file, its tool `estimated` where nothing says how thick it is, its cutter `stated` by the process, and what it comes near to may be a `keep-out`, the `mesh` of a part or fixture, or what is left of the `stock`.";
    ASKED_CLEARANCE: "asked_clearance_mm", Kind::Number(Unit::Millimetre), "What the arm was to keep from everything; null where nobody looked.";
    CONTACTS: "contacts", Kind::Objects, "Stretches of the path along which the arm is nearer to something than it was to keep; null where nobody looked.";
    UNAVOIDABLE: "unavoidable", Kind::Object, "Of a path that is not clear: what is nearer than was asked at some place of it at every roll and in every configuration, as the one that is farthest from it has it. Null where nothing of that kind is known.";
    MISPLACED: "misplaced", Kind::Objects, "What of the work (part, stock, fixture) stands more than 1 mm deep in a keep-out or below the floor; null where nobody looked.";
    CONTACT_WAY: "s_m", Kind::Number(Unit::Metre), "How far along the path it is nearest.";
    BODIES: "bodies", Kind::Text, "Which link to what; in `misplaced` what of the work.";
    CONTACT_DEPTH: "depth_mm", Kind::Number(Unit::Millimetre), "By how much that is nearer than what was to be kept; where nothing was, how deep they overlap; in `misplaced` at most, by the boxes about both along the sides of the keep-out.";
    CLEARANCE_ESTIMATED: "clearance_estimated", Kind::Truth, "A radius in it is estimated.";
    CLEARANCE_OUTSIDE: "clearance_outside_mm", Kind::Number(Unit::Millimetre), "By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most; 0 where none is estimated.";
    CLEARANCE_WIDE: "clearance_wide_mm", Kind::Number(Unit::Millimetre), "The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm; negative where they overlap, so that the arm may touch; null where its bodies are known.";
    CLEARANCE_WIDE_OF: "clearance_wide_of", Kind::Text, "Which of those to what.";
    ROBOT_CELL: "cell", Kind::Object, "The cell as it was asked for: mount, windows, what is kept free, and which of that (from 1) the base stands in or on, so that it is taken as what carries it; null where there is none.";
    CELL_CENTRE: "cell_m", numbers(Unit::Metre, &["cell_x_m", "cell_y_m", "cell_z_m"]), "The centre of the zone in the axes of the cell, its floor at 0.";
    FACES: "faces", Kind::Objects, "Every face of a part; null of one flat zone.";
    FACE: "face", Kind::Text, "Which face of a part.";
    FACE_CENTRE: "centre_m", numbers(Unit::Metre, &["centre_x_m", "centre_y_m", "centre_z_m"]), "Its centre.";
    RESOLUTION: "resolution", Kind::Object, "How finely a place was looked for.";
    COARSE_STEP: "coarse_step_m", Kind::Number(Unit::Metre), "Distance between the places of the coarse search; 0 where there is one place.";
    COARSE: "coarse_mm", Kind::Number(Unit::Millimetre), "The best value of the coarse search.";
    FINE_STEP: "fine_step_m", Kind::Number(Unit::Metre), "The last step of the refinement.";
    FINE_TURN: "fine_turn_deg", Kind::Number(Unit::Degree), "The last turn of the refinement.";
    SAMPLE_STEP: "sample_step_m", Kind::Number(Unit::Metre), "Distance between the poses in the zone.";
    SAMPLES: "samples", Kind::Count, "How many they are.";
    HALVING: "halving", Kind::Number(Unit::One), "By how much the value grew when that distance was halved last, relative.";
    BOXES: "boxes", Kind::Count, "Boxes of places behind the lower bound.";
    TOLERANCE: "tolerance_mm", Kind::Number(Unit::Given("mm")), "The largest deflection that is acceptable.";
    PASS: "pass", Kind::Truth, "The deflection keeps the tolerance, at the nominal stiffness, whatever else forbids the place: see verdict.";
    VERDICT: "verdict", Kind::Text, "pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is kept so (of `mill` also where the deflection is within the tolerance and beyond it together with what the geometry of an arm errs that was not calibrated, and where it is not decided whether the cuts swing; in the plane also where the arm may collide), else fail; of the elastic deflection of the drives under the mean force and of nothing else. Where the answer is no whatever the deflection it is what says so: collision, load exceeded, or of `mill` chatter.";
    PROBABILITY: "probability", Kind::Number(Unit::One), "Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an identified model; null where neither uncertainty is known.";
    MARGIN: "margin_mm", Kind::Number(Unit::Given("mm")), "What is left of the tolerance.";
    ADVICE: "advice", Kind::Object, "What is missing where the tolerance is not kept, and what is left where it is; null where none was given, and in a ranking of all but the best robots.";
    FORCE_FACTOR: "force_factor", Kind::Number(Unit::One), "So many times the force keeps the tolerance at this place, exactly; null where nothing gives way.";
    FORCE_FACTOR_BOUND: "force_factor_bound", Kind::Number(Unit::One), "No place keeps it under more.";
    LARGEST_FORCE: "largest_force_n", Kind::Number(Unit::Newton), "The same as a force.";
    STIFFNESS_FACTOR: "stiffness_factor", Kind::Number(Unit::One), "So many times as stiff must all drives be.";
    STIFFNESS_NEEDED: "stiffness_needed_nm_per_rad", open_numbers(Unit::Given("nm_per_rad"), &[]),
        "The stiffness of each drive that this asks for; null of rigid ones, and of drive 2 beside a gravity compensator.";
    DRIVE_SHARES: "drive_shares", open_numbers(Unit::One, &[]), "What each drive gives of the deflection at the worst point along its direction; adds up to 1.";
    SOFTEST_DRIVE: "softest_drive", Kind::Count, "The drive that gives most there.";
    SOFTEST_SHARE: "softest_drive_share", Kind::Number(Unit::One), "Its share.";
    COMPENSATION: "compensation_assumed", Kind::Number(Unit::One), "The part of the deflection that a compensation of the program is taken to take out: an assumption.";
    COMPENSATED: "compensated_mm", Kind::Number(Unit::Millimetre), "What it would leave of the deflection.";
    COMPENSATED_PASS: "compensated_pass", Kind::Truth, "That keeps the tolerance.";
    LARGEST_ZONE: "largest_zone", Kind::Object, "The largest zone of the shape that passes; null where the one that was asked for does.";
    SCALE: "scale", Kind::Number(Unit::One), "Its size as a part of the size that was asked for; null where not even the smallest that was tried passes.";
    SIZE_IN_WORDS: "size", Kind::Text, "The same in mm.";
    SIDES: "sides_m", Kind::List(&Kind::Number(Unit::Metre)), "Its sides; null of a part.";
    FAILS_AT: "fails_at_scale", Kind::Number(Unit::One), "The smallest part of that size that was tried and does not pass.";
    FAILS_PROVED: "fails_proved", Kind::Truth, "That no place of that passes is proved.";
    TRIED: "tried", Kind::Count, "How many zones were placed for it.";
}

shapes! {
    ADVICE: "AdviceDict", "What a tolerance says of force, stiffness and size.", &[slots![
        FORCE_FACTOR | null, FORCE_FACTOR_BOUND | null, LARGEST_FORCE | null, STIFFNESS_FACTOR | null, STIFFNESS_NEEDED | null,
        DRIVE_SHARES | null, SOFTEST_DRIVE | null, SOFTEST_SHARE | null, COMPENSATION | null, COMPENSATED | null,
        COMPENSATED_PASS | null, LARGEST_ZONE | null => LARGEST_ZONE,
    ]];
    CELL: "CellDict", "A cell as it was asked for.", &[slots![
        MOUNT, BASE_IN_CELL, BASE_TURNED, WINDOWS, KEPT_FREE, CARRIES_BASE, CLEARANCE_KEPT | null,
    ]];
    FACE: "FaceDict", "One face of a part.", &[slots![
        FACE, FACE_CENTRE, TOOL_DIRECTION, YAW, ROLL, DEFLECTION, LOWER_BOUND, SHOULDER, ELBOW, WRIST, WORST_POINT, WORST_JOINTS,
        WORST_SHARES, LIMIT_MARGIN, LIMIT_MARGIN_JOINT, SINGULAR_MARGIN,
    ]];
    LARGEST_ZONE: "LargestZone", "The largest zone that passes.", &[slots![
        SCALE | null, SIZE_IN_WORDS | null, SIDES | null, DEFLECTION | null, FAILS_AT | null, FAILS_PROVED, TRIED,
    ]];
    PLACEMENT: "Placed", "One placement; `pass` says whether the tolerance is kept.",
        &[OF_ROBOT, OF_TASK, OF_FORCE, OF_LOAD, OF_QUESTION, OF_PLACE, OF_SPREAD, OF_VERDICT, slots![ADVICE | null => ADVICE]];
    PLACEMENT_IN_RANKING: "PlacedInRanking", "One placement of a ranking, with its rank for this task.", &[
        OF_ROBOT, OF_TASK, OF_FORCE, OF_LOAD, OF_QUESTION, OF_PLACE, OF_SPREAD, OF_VERDICT,
        slots![TASK_RANK | null, TASK_RANK_TIED | null, ADVICE | null => ADVICE],
    ];
    RESOLUTION: "Resolution", "How finely a place was looked for.",
        &[slots![COARSE_STEP, COARSE | null, FINE_STEP, FINE_TURN, SAMPLE_STEP, SAMPLES, HALVING, BOXES]];
    SETUP: "PlacedSetup", "One placement of two that are compared.", &[
        slots![SETUP], OF_ROBOT, OF_TASK, OF_FORCE, OF_LOAD, OF_QUESTION, OF_PLACE, OF_SPREAD, OF_VERDICT,
        slots![ADVICE | null => ADVICE],
    ];
}

const OF_TASK: &[Slot] = slots![TASK, MODEL];

const OF_QUESTION: &[Slot] = slots![
    TOOL | null,
    TOOL_DIRECTION | null,
    WITHIN | null,
    ROBOT_CELL | null => shape::CELL,
    ASKED_LIMIT_MARGIN,
    ASKED_SINGULAR_MARGIN,
    CLEAR_OF_BASE | null,
    FLOOR_HEIGHT | null,
];

const OF_PLACE: &[Slot] = slots![
    FEASIBLE | null,
    REASON | null,
    PROVED | null,
    LARGEST_SCALE | null,
    DEFLECTION | null,
    LOWER_BOUND | null,
    X | null,
    Z | null,
    BEARING | null,
    YAW | null,
    ANGLE | null,
    FIRST_SIDE | null,
    ROLL | null,
    SHOULDER | null,
    ELBOW | null,
    WRIST | null,
    WORST_POINT | null,
    FROM_AXIS_1 | null,
    BELOW_BASE | null,
    BEHIND_AXIS_1 | null,
    WORST_JOINTS | null,
    PENDANT | null,
    WORST_SHARES | null,
    LIMIT_MARGIN | null,
    LIMIT_MARGIN_JOINT | null,
    SINGULAR_MARGIN | null,
    SMALLEST_MARGIN | null,
    SMALLEST_MARGIN_OF | null,
    CLEARANCE | null,
    CLEARANCE_OF | null,
    CLEARANCE_ESTIMATED | null,
    CLEARANCE_OUTSIDE | null,
    CLEARANCE_WIDE | null,
    CLEARANCE_WIDE_OF | null,
    CELL_CENTRE | null,
    RESOLUTION | null => shape::RESOLUTION,
    FACES | null => shape::FACE,
];
