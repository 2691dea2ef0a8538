//! What can be told, each thing once: its key, its unit, and what it is.

use stiffarm::catalogue::microradians;

/// A unit as answers tell it; inside, everything is SI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A number of its own.
    One,
    /// m.
    Metre,
    /// mm, from m.
    Millimetre,
    /// deg, from rad.
    Degree,
    /// mrad, from rad.
    Milliradian,
    /// N.
    Newton,
    /// um/N, from m/N.
    MicrometrePerNewton,
    /// urad/(N m), from rad/(N m).
    MicroradianPerNewtonMetre,
    /// N m/rad.
    NewtonMetrePerRadian,
    /// kg.
    Kilogram,
    /// N m.
    NewtonMetre,
    /// s.
    Second,
    /// W.
    Watt,
    /// mm/min, from m/s.
    MillimetrePerMinute,
    /// As it was given, in the unit named.
    Given(&'static str),
}

impl Unit {
    /// A number in SI in this unit; zero has no sign.
    pub fn of_si(self, si: f64) -> f64 {
        match self {
            Self::One
            | Self::Metre
            | Self::Newton
            | Self::NewtonMetrePerRadian
            | Self::Kilogram
            | Self::NewtonMetre
            | Self::Second
            | Self::Watt
            | Self::Given(_) => si + 0.0,
            Self::MillimetrePerMinute => si * 60e3 + 0.0,
            Self::Millimetre | Self::Milliradian => si * 1e3 + 0.0,
            Self::Degree => si.to_degrees() + 0.0,
            Self::MicrometrePerNewton => si * 1e6 + 0.0,
            Self::MicroradianPerNewtonMetre => microradians(si),
        }
    }
}

/// What a field holds, and under which headings its parts stand in a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Words.
    Text,
    /// Yes or no.
    Truth,
    /// How many, or which one.
    Count,
    /// A number.
    Number(Unit),
    /// Several numbers in a fixed order.
    Numbers {
        /// Of each.
        unit: Unit,
        /// Heading of each in a table.
        columns: &'static [&'static str],
        /// So many stand together in a list of lists; 0 where there is one list.
        nested: usize,
    },
    /// What has fields of its own, or is a list; in no table.
    Nested,
}

/// One thing that can be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// The key in JSON, and the heading of its column; its ending is its unit.
    pub key: &'static str,
    /// What it holds.
    pub kind: Kind,
    /// What it is, in one line.
    pub about: &'static str,
}

impl Field {
    const fn new(key: &'static str, kind: Kind, about: &'static str) -> Self {
        Self { key, kind, about }
    }

    /// Its unit, where it holds numbers.
    pub const fn unit(&self) -> Option<Unit> {
        match self.kind {
            Kind::Number(unit) | Kind::Numbers { unit, .. } => Some(unit),
            Kind::Text | Kind::Truth | Kind::Count | Kind::Nested => None,
        }
    }
}

const fn numbers(unit: Unit, columns: &'static [&'static str]) -> Kind {
    Kind::Numbers { unit, columns, nested: 0 }
}

macro_rules! fields {
    ($($name:ident: $key:literal, $kind:expr, $about:literal;)*) => {
        $(#[doc = $about] pub const $name: Field = Field::new($key, $kind, $about);)*

        /// All of them.
        pub const ALL: &[Field] = &[$($name),*];
    };
}

fields! {
    ROBOT: "robot", Kind::Text, "The maker's name for the robot.";
    VENDOR: "vendor", Kind::Text, "The maker.";
    ARCHITECTURE: "architecture", Kind::Text, "serial or quasi-serial.";
    ARCHITECTURE_ASSUMED: "architecture_assumed", Kind::Truth, "Nothing says that it is of this architecture.";
    STATUS: "status", Kind::Text, "How well the robot's numbers are known.";
    STIFFNESS_SOURCE: "stiffness_source", Kind::Text, "Who says how stiff the drives are: assumed, prior, published, robot file, identified or given.";
    DRIVE_COMPLIANCE: "drive_urad_per_nm", numbers(Unit::MicroradianPerNewtonMetre, &["k1_urad_per_nm", "k2_urad_per_nm", "k3_urad_per_nm", "k4_urad_per_nm", "k5_urad_per_nm", "k6_urad_per_nm"]),
        "The compliance of each drive; null where a robot of two links has none.";
    TASK: "task", Kind::Text, "The zone as it was asked for.";
    MODEL: "model", Kind::Text, "planar or spatial; of an identification what springs: drives, base, tool or base-and-tool.";
    FORCE: "force_n", Kind::Number(Unit::Newton), "The cutting force.";
    FORCE_AXES: "force_axes", Kind::Text, "Along which axes its direction is told: base (ahead, left, up) or tool (feed, across, axial); null for the worst.";
    FORCE_DIRECTION: "force_direction", numbers(Unit::One, &["force_direction_1", "force_direction_2", "force_direction_3"]), "Its unit direction along these axes.";
    FORCE_CONE: "force_cone_deg", Kind::Number(Unit::Given("deg")), "By how much it may point aside.";
    FEED: "feed_deg", Kind::Number(Unit::Given("deg")), "Direction of the feed from the first side of the zone; null where it may go any way.";
    COMPONENT: "component", Kind::Text, "What of the displacement counts: total, normal (to the face) or along (the force).";
    TOOL: "tool_mm", numbers(Unit::Given("mm"), &["tool_x_mm", "tool_y_mm", "tool_z_mm", "tool_rx_deg", "tool_ry_deg", "tool_rz_deg"]),
        "The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg.";
    TOOL_DIRECTION: "tool_direction_deg", Kind::Number(Unit::Given("deg")), "The tool axis above the horizontal.";
    WITHIN: "within_m", Kind::Numbers { unit: Unit::Metre, columns: &["within_x0_m", "within_x1_m", "within_z0_m", "within_z1_m"], nested: 2 },
        "Where the zone may stand; null where it is open.";
    ASKED_LIMIT_MARGIN: "asked_limit_margin_deg", Kind::Number(Unit::Degree), "What every joint was to keep from its limits.";
    ASKED_SINGULAR_MARGIN: "asked_singular_margin_deg", Kind::Number(Unit::Degree), "What wrist and arm were to keep from straight.";
    CLEAR_OF_BASE: "clear_of_base_m", Kind::Number(Unit::Metre), "What the zone was to keep from the joint-1 axis; null where it is not known where that stands.";
    FLOOR_HEIGHT: "floor_m", Kind::Number(Unit::Metre), "Height of the floor above which the zone was to stand, from the base; null where there is none.";
    FEASIBLE: "feasible", Kind::Truth, "There is a place; null where it is not known.";
    REASON: "reason", Kind::Text, "Why there is no place, or it is not known.";
    PROVED: "proved", Kind::Truth, "That there is no place is proved.";
    LARGEST_SCALE: "largest_feasible_scale", Kind::Number(Unit::One), "The largest scale at which a zone of this shape has a place.";
    DEFLECTION: "deflection_mm", Kind::Number(Unit::Millimetre), "The worst deflection in the zone at its best place.";
    LOWER_BOUND: "lower_bound_mm", Kind::Number(Unit::Millimetre), "No allowed place has less.";
    DEFLECTION_P05: "deflection_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile of the deflection there over draws of the drive stiffness; null where its uncertainty is not known.";
    DEFLECTION_P50: "deflection_mm_p50", Kind::Number(Unit::Millimetre), "Their median; mostly more than at the nominal stiffness, as a soft drive adds more than a stiff one takes away.";
    DEFLECTION_P95: "deflection_mm_p95", Kind::Number(Unit::Millimetre), "Their 95th percentile.";
    WIN_PROBABILITY: "win_probability", Kind::Nested, "In which share of the draws of the drive stiffness it has the least deflection, of each task; null where it has no place, is estimated, or the uncertainty of its drives is not known.";
    EXPECTED_REGRET: "expected_regret_mm", Kind::Nested, "How much more than the best it has on average, of each task.";
    TIES_WITH_BEST: "ties_with_best", Kind::Nested, "Its deflection and that of the best robot overlap: neither is smaller in 95 % of the draws of the drive stiffness, of each task; shared ranks are about the proof.";
    X: "x_m", Kind::Number(Unit::Metre), "Ahead, from the base.";
    Z: "z_m", Kind::Number(Unit::Metre), "Up, from the base.";
    BEARING: "bearing_deg", Kind::Number(Unit::Degree), "Where about the joint-1 axis the zone stands.";
    YAW: "yaw_deg", Kind::Number(Unit::Degree), "Of the zone's plane about the vertical.";
    ANGLE: "angle_deg", Kind::Number(Unit::Degree), "Of the first side of a rectangle: below 180, or below 360 where the feed of a known force counts from it.";
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
    CLEARANCE_BY: "clearance_by", Kind::Nested, "By which bodies that is known: those of the arm are `enclosing`, `estimated` or `stated` by the robot file, its tool `estimated` where nothing says how thick it is, its cutter `stated` by the process, and what it comes near to may be a `keep-out`, the `mesh` of a part or fixture, or what is left of the `stock`.";
    ASKED_CLEARANCE: "asked_clearance_mm", Kind::Number(Unit::Millimetre), "What the arm was to keep from everything; null where nobody looked.";
    CONTACTS: "contacts", Kind::Nested, "Stretches of the path along which the arm is nearer to something than it was to keep; null where nobody looked.";
    UNAVOIDABLE: "unavoidable", Kind::Nested, "Of a path that is not clear: what is nearer than was asked at some place of it at every roll and in every configuration, as the one that is farthest from it has it. Null where nothing of that kind is known.";
    CONTACT_WAY: "s_m", Kind::Number(Unit::Metre), "How far along the path it is nearest.";
    BODIES: "bodies", Kind::Text, "Which link to what.";
    CONTACT_DEPTH: "depth_mm", Kind::Number(Unit::Millimetre), "By how much that is nearer than what was to be kept; where nothing was, how deep they overlap.";
    CLEARANCE_ESTIMATED: "clearance_estimated", Kind::Truth, "A radius in it is estimated.";
    CLEARANCE_OUTSIDE: "clearance_outside_mm", Kind::Number(Unit::Millimetre), "By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most; 0 where none is estimated.";
    CLEARANCE_WIDE: "clearance_wide_mm", Kind::Number(Unit::Millimetre), "The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm; negative where they overlap, so that the arm may touch; null where its bodies are known.";
    CLEARANCE_WIDE_OF: "clearance_wide_of", Kind::Text, "Which of those to what.";
    ROBOT_CELL: "cell", Kind::Nested, "The cell as it was asked for: mount, windows, what is kept free, and which of that (from 1) the base stands in or on, so that it is taken as what carries it; null where there is none.";
    CELL_CENTRE: "cell_m", numbers(Unit::Metre, &["cell_x_m", "cell_y_m", "cell_z_m"]), "The centre of the zone in the axes of the cell, its floor at 0.";
    FACES: "faces", Kind::Nested, "Every face of a part; null of one flat zone.";
    FACE: "face", Kind::Text, "Which face of a part.";
    FACE_CENTRE: "centre_m", numbers(Unit::Metre, &["centre_x_m", "centre_y_m", "centre_z_m"]), "Its centre.";
    RESOLUTION: "resolution", Kind::Nested, "How finely a place was looked for.";
    COARSE_STEP: "coarse_step_m", Kind::Number(Unit::Metre), "Distance between the places of the coarse search.";
    COARSE: "coarse_mm", Kind::Number(Unit::Millimetre), "The best value of the coarse search.";
    FINE_STEP: "fine_step_m", Kind::Number(Unit::Metre), "The last step of the refinement.";
    FINE_TURN: "fine_turn_deg", Kind::Number(Unit::Degree), "The last turn of the refinement.";
    SAMPLE_STEP: "sample_step_m", Kind::Number(Unit::Metre), "Distance between the poses in the zone.";
    SAMPLES: "samples", Kind::Count, "How many they are.";
    HALVING: "halving", Kind::Number(Unit::One), "By how much the value grew when that distance was halved last, relative.";
    BOXES: "boxes", Kind::Count, "Boxes of places behind the lower bound.";
    TOLERANCE: "tolerance_mm", Kind::Number(Unit::Given("mm")), "The largest deflection that is acceptable.";
    PASS: "pass", Kind::Truth, "The tolerance is kept, at the nominal stiffness.";
    VERDICT: "verdict", Kind::Text, "pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is kept so (of `mill` also where the geometry of an arm that was not calibrated errs by more than the tolerance), else fail; of the elastic deflection of the drives under the mean force and of nothing else.";
    PROBABILITY: "probability", Kind::Number(Unit::One), "Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an identified model; null where neither uncertainty is known.";
    MARGIN: "margin_mm", Kind::Number(Unit::Given("mm")), "What is left of the tolerance.";
    ADVICE: "advice", Kind::Nested, "What is missing where the tolerance is not kept, and what is left where it is; null where none was given, and in a ranking of all but the best robots.";
    FORCE_FACTOR: "force_factor", Kind::Number(Unit::One), "So many times the force keeps the tolerance at this place, exactly; null where nothing gives way.";
    FORCE_FACTOR_BOUND: "force_factor_bound", Kind::Number(Unit::One), "No place keeps it under more.";
    LARGEST_FORCE: "largest_force_n", Kind::Number(Unit::Newton), "The same as a force.";
    STIFFNESS_FACTOR: "stiffness_factor", Kind::Number(Unit::One), "So many times as stiff must all drives be.";
    STIFFNESS_NEEDED: "stiffness_needed_nm_per_rad", Kind::Numbers { unit: Unit::Given("nm_per_rad"), columns: &[], nested: 0 },
        "The stiffness of each drive that this asks for; null of rigid ones, and of drive 2 beside a gravity compensator.";
    DRIVE_SHARES: "drive_shares", numbers(Unit::One, &[]), "What each drive gives of the deflection at the worst point along its direction; adds up to 1.";
    SOFTEST_DRIVE: "softest_drive", Kind::Count, "The drive that gives most there.";
    SOFTEST_SHARE: "softest_drive_share", Kind::Number(Unit::One), "Its share.";
    COMPENSATION: "compensation_assumed", Kind::Number(Unit::One), "The part of the deflection that a compensation of the program is taken to take out: an assumption.";
    COMPENSATED: "compensated_mm", Kind::Number(Unit::Millimetre), "What it would leave of the deflection.";
    COMPENSATED_PASS: "compensated_pass", Kind::Truth, "That keeps the tolerance.";
    LARGEST_ZONE: "largest_zone", Kind::Nested, "The largest zone of the shape that passes; null where the one that was asked for does.";
    SCALE: "scale", Kind::Number(Unit::One), "Its size as a part of the size that was asked for; null where not even the smallest that was tried passes.";
    SIZE_IN_WORDS: "size", Kind::Text, "The same in mm.";
    SIDES: "sides_m", Kind::Nested, "Its sides; null of a part.";
    FAILS_AT: "fails_at_scale", Kind::Number(Unit::One), "The smallest part of that size that was tried and does not pass.";
    FAILS_PROVED: "fails_proved", Kind::Truth, "That no place of that passes is proved.";
    TRIED: "tried", Kind::Count, "How many zones were placed for it.";
    RANK: "rank", Kind::Count, "One more than the robots that are certainly better, their values below its bound; none for a robot that is estimated, or of which nothing is known.";
    RANK_TIED: "rank_tied", Kind::Truth, "Some other robot cannot be distinguished from it by the proof, at the nominal stiffness.";
    TASK_RANK: "task_rank", Kind::Count, "The same for this task alone.";
    TASK_RANK_TIED: "task_rank_tied", Kind::Truth, "Some other robot cannot be distinguished from it by the proof in this task.";
    PLANAR_RANK: "planar_rank", Kind::Count, "The rank in the planar ranking of the same robots and tasks.";
    BOUND: "bound_mm", Kind::Number(Unit::Millimetre), "Deflection at the stiffest posture of the links.";
    MEAN_RATIO: "mean_ratio", Kind::Number(Unit::One), "How much worse than the best of each task, geometric mean.";
    MEAN_RATIO_BOUND: "mean_ratio_bound", Kind::Number(Unit::One), "The same of the proved lower bounds.";
    TASKS: "tasks", Kind::Nested, "The tasks as they were asked for.";
    CELLS: "cells", Kind::Nested, "One placement per task.";
    ROWS: "rows", Kind::Nested, "One entry per row.";
    WINNERS: "winners", Kind::Nested, "Who is best at each task.";
    BEST: "best", Kind::Text, "The best robot whose geometry and limits are published.";
    BEST_WITH_ESTIMATED: "best_with_estimated", Kind::Text, "The best robot of all.";
    BEST_SERIAL: "best_serial", Kind::Text, "The best serial robot.";
    BEST_QUASI_SERIAL: "best_quasi_serial", Kind::Text, "The best quasi-serial robot.";
    TOLD_APART: "told_apart", Kind::Truth, "It is proved that no other is as good, at the nominal stiffness.";
    RIVALS: "rivals", Kind::Nested, "Robots of published geometry that may be as good as the best.";
    SETUP: "setup", Kind::Text, "a or b, of two that are compared.";
    SETUP_A: "a", Kind::Nested, "The first setup, as place tells it.";
    SETUP_B: "b", Kind::Nested, "The second setup.";
    SETUP_RATIO: "ratio", Kind::Number(Unit::One), "The deflection of the second over that of the first; null where one has no place.";
    BETTER_SETUP: "better", Kind::Text, "Which of the two is better, a or b, which is proved at the nominal stiffness; null where they cannot be distinguished.";
    DIFFERENT: "differ_in", Kind::Nested, "What is not the same of both besides the answer: robot, stiffness, model, tool, force, task, tolerance, place.";
    SUMMARY: "summary", Kind::Nested, "What a manager would read.";
    JOINTS: "joints_deg", numbers(Unit::Given("deg"), &["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"]), "Joint angles as the robot reports them, deg.";
    PENDANT: "pendant", Kind::Text, "Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by whoever asks), unknown.";
    TCP: "tcp_m", numbers(Unit::Metre, &["tcp_x_m", "tcp_y_m", "tcp_z_m"]), "The tool point.";
    COMPLIANCE: "compliance_um_per_n", Kind::Numbers { unit: Unit::MicrometrePerNewton, columns: &[], nested: 3 }, "From force to translation, base axes.";
    COMPLIANCE_6X6: "compliance_6x6_si", Kind::Numbers { unit: Unit::One, columns: &[], nested: 6 }, "From wrench to translation and rotation, base axes, SI.";
    PRINCIPAL: "principal_um_per_n", numbers(Unit::MicrometrePerNewton, &[]), "Principal compliances, ascending.";
    WORST_DIRECTION: "worst_direction", numbers(Unit::One, &[]), "The unit direction of the last of them.";
    FORCE_VECTOR: "force_n", numbers(Unit::Newton, &["fx_n", "fy_n", "fz_n"]), "The force at the tool point, base axes: as given, or of those that it may be the one that does most.";
    MOVED: "deflection_mm", numbers(Unit::Millimetre, &["dx_mm", "dy_mm", "dz_mm"]), "The translation under it.";
    TURNED: "rotation_mrad", numbers(Unit::Milliradian, &["rx_mrad", "ry_mrad", "rz_mrad"]), "The rotation under it.";
    COUNTED: "largest_mm", Kind::Number(Unit::Millimetre), "What counts of the translation, the largest that the force may cause.";
    SIZE: "d", Kind::Number(Unit::One), "The size over l2 + l3.";
    MU: "mu_l3_over_l2", Kind::Number(Unit::One), "The link ratio; null where every contender has its best.";
    IS_BEST: "best", Kind::Truth, "The link ratio is the best.";
    K2: "k2", Kind::Number(Unit::One), "Compliance of drive 2 over the reference.";
    K3: "k3", Kind::Number(Unit::One), "Compliance of drive 3 over the reference.";
    ACCURACY: "accuracy", Kind::Number(Unit::One), "The worst deflection over k F (l2 + l3)^2; null where the zone does not fit.";
    MARK: "mark", Kind::Nested, "Where the robot with its task stands among what was studied.";
    ACCURACIES: "accuracies", Kind::Nested, "What either contender would have there; null where the task does not fit.";
    STIFFER: "stiffer", Kind::Text, "The contender that has less.";
    BOUNDARIES: "boundaries", Kind::Nested, "Sizes at which the better architecture changes.";
    BETTER_BELOW: "better_below", Kind::Text, "The better contender for smaller tasks.";
    BETTER_ABOVE: "better_above", Kind::Text, "The better contender for larger tasks.";
    WORST: "worst_mm", Kind::Number(Unit::Millimetre), "Deflection under the force in its worst direction.";
    DIRECTED: "deflection_mm", Kind::Number(Unit::Millimetre), "Deflection under the force in the direction asked for.";
    DIRECTION: "direction_deg", Kind::Number(Unit::Given("deg")), "Of the force in the arm plane, from straight ahead.";
    ROLL_TOLERANCE: "roll_tolerance", Kind::Number(Unit::One), "How much more than at the best roll a point may tell, relative.";
    POSTURE: "posture", Kind::Text, "The configuration that holds a point.";
    ZONE: "zone", Kind::Nested, "The best placement of the task that was given.";
    PAYLOAD: "payload_kg", Kind::Number(Unit::Kilogram), "Nominal payload.";
    TOOL_MASS: "tool_mass_kg", Kind::Number(Unit::Kilogram), "Mass of the tool, where it was given: it is held against the payload and bends nothing.";
    OVERLOADED: "overloaded", Kind::Truth, "The tool and a mass that weighs as much as the force are more than the payload together; null where no payload is known.";
    WRIST_MOMENT: "wrist_moment_nm", numbers(Unit::Given("nm"), &["wrist_moment_4_nm", "wrist_moment_5_nm", "wrist_moment_6_nm"]),
        "Moments about axes 4, 5 and 6 at worst over the angles of these joints and the directions: of the tool's weight where its mass centre was given, and in the spatial model of the force at the tool tip.";
    WRIST_LIMIT: "wrist_limit_nm", numbers(Unit::Given("nm"), &["wrist_limit_4_nm", "wrist_limit_5_nm", "wrist_limit_6_nm"]), "The largest that are allowed; null where the robot file has none.";
    WRIST_LIMIT_BY: "wrist_limit_by", Kind::Text, "What says so: `allowed by the maker`, or `torque limits of the drives`, above which they do not hold the load even at rest.";
    WRIST_EXCEEDED: "wrist_exceeded", Kind::Truth, "A moment about axis 4, 5 or 6 is above its limit; null where no limit is known.";
    REACH: "reach_m", Kind::Number(Unit::Metre), "Reach by the data sheet, from the joint-1 axis.";
    L2: "l2_m", Kind::Number(Unit::Metre), "Upper arm.";
    L3: "l3_m", Kind::Number(Unit::Metre), "Elbow to wrist centre.";
    FLOOR: "bound_um_per_n", Kind::Number(Unit::MicrometrePerNewton), "Compliance at the stiffest posture of the links; null where the planar model does not hold.";
    TOOL_COM: "tool_com_mm", numbers(Unit::Millimetre, &["tool_com_x_mm", "tool_com_y_mm", "tool_com_z_mm"]), "Mass centre of the tool in the flange frame.";
    TOOL_INERTIA: "tool_inertia_kg_m2", numbers(Unit::Given("kg_m2"), &["tool_ixx_kg_m2", "tool_ixy_kg_m2", "tool_ixz_kg_m2", "tool_iyy_kg_m2", "tool_iyz_kg_m2", "tool_izz_kg_m2"]),
        "Inertia of the tool about its mass centre, along flange axes.";
    MODES: "modes", Kind::Nested, "How the arm swings, the lowest frequency first.";
    MODE: "mode", Kind::Count, "Which mode, from 1.";
    FREQUENCY: "frequency_hz", Kind::Number(Unit::Given("hz")), "With the motors held still.";
    FREQUENCY_P05: "frequency_hz_p05", Kind::Number(Unit::Given("hz")), "5th percentile over draws of the drive stiffness; null where its uncertainty is not known.";
    FREQUENCY_P95: "frequency_hz_p95", Kind::Number(Unit::Given("hz")), "95th percentile.";
    FREQUENCY_FREE: "frequency_motors_free_hz", Kind::Number(Unit::Given("hz")), "Of the same rank with motors that only the inertia of their rotors holds; null where rotors are not known.";
    FIRST_FREQUENCY: "first_frequency_hz", Kind::Number(Unit::Given("hz")), "The first frequency at every point of a map, in its configuration and at its roll, motors held still; null where it was not asked for (quantity first-frequency).";
    SLOWEST_P05: "slowest_hz_p05", Kind::Number(Unit::Given("hz")), "5th percentile, over draws of the drive stiffness, of the first frequency at the slowest point of the map; null where its uncertainty is not known, and where frequencies are not mapped.";
    FIRST_AT_LEAST: "first_at_least_hz", Kind::Number(Unit::Given("hz")), "Nowhere in the zone the first frequency is lower, motors held still: proved at the nominal stiffness, and no promise where that is not measured; null where the proof did not end.";
    FIRST_AT_LEAST_P05: "first_at_least_hz_p05", Kind::Number(Unit::Given("hz")), "5th percentile of the least first frequency over draws of the drive stiffness: drawn, not proved; null where its uncertainty is not known.";
    FREQUENCY_LEAST: "least_frequency_hz", Kind::Number(Unit::Given("hz")), "The least frequency of the points of the zone that were looked at, motors held still.";
    LEAST_AT: "least_at_m", numbers(Unit::Metre, &["least_x_m", "least_y_m", "least_z_m"]), "Where, from the base.";
    FREQUENCY_LARGEST: "largest_frequency_hz", Kind::Number(Unit::Given("hz")), "The largest frequency of the points of the zone that were looked at.";
    LARGEST_AT: "largest_at_m", numbers(Unit::Metre, &["largest_x_m", "largest_y_m", "largest_z_m"]), "Where, from the base.";
    ZONE_PARTS: "zone_parts", Kind::Count, "Into how many parts the zone was cut for the proof.";
    DAMPING_RATIO: "damping_ratio", Kind::Number(Unit::One), "Share of the critical damping.";
    TIP_SHAPE: "tip_shape", numbers(Unit::One, &["tip_x", "tip_y", "tip_z"]), "How the tool point moves, base axes, in m per root of kg m2 of modal mass: its square over (2 pi f)^2 is what the mode gives of the compliance.";
    ENERGY_SHARES: "drive_shares", numbers(Unit::One, &["share_1", "share_2", "share_3", "share_4", "share_5", "share_6"]), "What each drive stores of the energy; adds up to 1.";
    DAMPING_SOURCE: "damping_source", Kind::Text, "Where the damping is from: assumed, given or robot file.";
    MASSES_LEFT_OUT: "masses_left_out", Kind::Nested, "Moving parts whose masses the robot file does not have.";
    CUT_DEPTH: "cut_depth_mm", Kind::Number(Unit::Millimetre), "Axial depth of the cut, as the process has it.";
    CRITICAL_DEPTH: "critical_depth_mm", Kind::Number(Unit::Millimetre), "The least axial depth that swings with the robot at the speed of the spindle; null where none up to 300 mm does.";
    CRITICAL_DEPTH_P05: "critical_depth_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile over draws of drive stiffness and damping; null beyond 300 mm.";
    CRITICAL_DEPTH_P95: "critical_depth_mm_p95", Kind::Number(Unit::Millimetre), "95th percentile; null beyond 300 mm.";
    CHATTER_FREQUENCY: "chatter_hz", Kind::Number(Unit::Given("hz")), "The frequency of the swing at that depth.";
    TOOTH_PHASE: "tooth_phase_rad", Kind::Number(Unit::Given("rad")), "By how much the swing turns from tooth to tooth; far below 1 the cut is a damper, which calms or drives.";
    ANY_SPEED_DEPTH: "any_speed_depth_mm", Kind::Number(Unit::Millimetre), "Less deep no speed swings, by the mean of the teeth; null where none up to 300 mm does.";
    ANY_SPEED_DEPTH_P05: "any_speed_depth_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile over the same draws.";
    ANY_SPEED_DEPTH_P95: "any_speed_depth_mm_p95", Kind::Number(Unit::Millimetre), "95th percentile.";
    ANY_SPEED_FREQUENCY: "any_speed_hz", Kind::Number(Unit::Given("hz")), "The frequency of the swing at that depth.";
    OTHER_WAY_DEPTH: "other_way_depth_mm", Kind::Number(Unit::Millimetre), "The least axial depth that swings at the speed of the spindle where the cut is fed the other way, up for down; null where none up to 300 mm does.";
    OTHER_WAY_FREQUENCY: "other_way_hz", Kind::Number(Unit::Given("hz")), "The frequency of the swing at that depth.";
    CALM_SPEEDS: "calm_rpm", Kind::Nested, "Speeds of the spindle within 0.5 to 1.5 of its own at which the cut is less deep than 95 of 100 draws allow: pairs of from and to; null where teeth are counted one by one, and of drives that are nobody's.";
    PAN_DEPTH: "pan_depth_mm", Kind::Number(Unit::Millimetre), "The least depth at which modes couple without the delay (Pan); beside the others, never instead of them.";
    PAN_FREQUENCY: "pan_hz", Kind::Number(Unit::Given("hz")), "Its frequency; 0 where the arm gives way.";
    MODES_LOOKED_AT: "modes_looked_at", Kind::Nested, "Frequencies of the robot's modes that were looked at, Hz; none where the robot is in what was measured. Nothing is told above the last of these and of what was measured.";
    ROBOT_MODES: "robot_modes", Kind::Text, "Of the robot with what was measured at its tip: calm where the cut is less deep than 95 of 100 draws allow, limit where it is deeper than 95 of 100 allow, else not decided; not covered of a path without a cut of which anything is known.";
    SPINDLE_MODES: "spindle_modes", Kind::Text, "unknown where nothing was measured at the tip, else measured; those of the work are never looked at.";
    FRF: "frf", Kind::Text, "The table of what was measured at the tip; null where there is none.";
    FRF_ON: "frf_on", Kind::Text, "What held the tip while it was measured: rigid (spindle, holder and cutter alone) or robot (it takes the place of the model); null without a table.";
    MEASURED_MODES: "measured_modes", Kind::Nested, "Frequencies of the modes of the table, Hz; null without a table of modes.";
    MEASURED_BETWEEN: "measured_between", Kind::Nested, "From where to where the table tells frequency by frequency, Hz; null without one.";
    CHATTER_VERDICT: "verdict", Kind::Text, "What is told of robot modes and of what was measured at the tip, in words.";
    CHATTER_METHOD: "method", Kind::Text, "How teeth are counted: mean (over a revolution) or teeth (one by one).";
    CHATTER_DRAWN: "drawn", Kind::Nested, "What the intervals are over: drives, damping, both or neither.";
    DEPTH_RESERVE: "depth_reserve", Kind::Number(Unit::One), "The least depth that swings at the speed of the spindle, in parts of that of the cut; null where none up to 300 mm does.";
    LOBES: "lobes", Kind::Nested, "By the speed of the spindle: the least depth that swings.";
    LOBE_DEPTH: "depth_mm", Kind::Number(Unit::Millimetre), "The least axial depth that swings at a speed; null where none up to 300 mm does.";
    LOBE_DEPTH_P05: "depth_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile over draws of drive stiffness and damping; null beyond 300 mm, and where teeth are counted one by one.";
    LOBE_DEPTH_P95: "depth_mm_p95", Kind::Number(Unit::Millimetre), "95th percentile.";
    MASS: "mass_kg", Kind::Number(Unit::Kilogram), "Mass of the arm.";
    REPEATABILITY: "repeatability_mm", Kind::Number(Unit::Millimetre), "Repeatability by the data sheet.";
    SOURCE: "source", Kind::Text, "Where it is published.";
    ITEM: "item", Kind::Text, "What it is of.";
    CELL: "cell", Kind::Text, "Which number.";
    PRINTED: "printed", Kind::Text, "As it is printed.";
    COMPUTED: "computed", Kind::Number(Unit::One), "As it is computed.";
    AGREES: "agrees", Kind::Truth, "The two agree to the digits that are printed.";
    NOTE: "note", Kind::Text, "Why they do not.";
    FILE: "file", Kind::Text, "The robot file.";
    USABLE: "usable", Kind::Truth, "It can be used.";
    LINE: "line", Kind::Count, "From 1.";
    KEY: "key", Kind::Text, "What it is called.";
    MESSAGE: "message", Kind::Text, "What is wrong or odd.";
    VALUE: "value", Kind::Text, "As people read it.";
    SPRING: "drive", Kind::Count, "Which drive, from 1.";
    DRIVES: "drives", Kind::Nested, "One entry per drive.";
    ESTIMATE: "compliance_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "The compliance found; null where it is not seen.";
    STANDARD_ERROR: "standard_error_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "The larger of that from the scatter of all remainders and that from leaving out each posture.";
    INTERVAL: "ci95_urad_per_nm", numbers(Unit::MicroradianPerNewtonMetre, &["ci95_low_urad_per_nm", "ci95_high_urad_per_nm"]), "Where it lies with 95 %.";
    STIFFNESS: "stiffness_nm_per_rad", Kind::Number(Unit::NewtonMetrePerRadian), "One over the compliance found.";
    ROBUST: "robust_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "The compliance by Huber's estimate.";
    IS_IDENTIFIED: "identified", Kind::Truth, "The measurements show it, to half of itself or better.";
    NOT_IDENTIFIED: "why_not", Kind::Text, "Why they do not.";
    USED: "used_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "What the robot file has: found with all that is not identified held, or as it was before.";
    ESTIMATOR: "fit", Kind::Text, "least-squares or huber.";
    FURTHER_SPRINGS: "springs", Kind::Nested, "What springs besides the drives.";
    SPRING_NAME: "spring", Kind::Text, "Its name.";
    REGION: "joint_2_deg", numbers(Unit::Degree, &["joint_2_from_deg", "joint_2_to_deg"]), "Where joint 2 stood, as reported, deg; null of what is no region of joint 2.";
    COMPENSATOR: "compensator", Kind::Nested, "What is found of a gravity compensator: its spring, and its preload.";
    IN_UNIT: "unit", Kind::Text, "The unit of its numbers.";
    FOUND: "found", Kind::Number(Unit::One), "What is found; null where it is not seen.";
    FOUND_ERROR: "standard_error", Kind::Number(Unit::One), "Its standard error.";
    FOUND_INTERVAL: "ci95", numbers(Unit::One, &["ci95_low", "ci95_high"]), "Where it lies with 95 %.";
    FOUND_USED: "used", Kind::Number(Unit::One), "What the robot file has.";
    POSTERIOR_DRIVES: "posterior", Kind::Nested, "What the measurements make of the prior, drive by drive; null where that was not asked for.";
    PRIOR: "prior_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "Median of the prior.";
    PRIOR_SD: "prior_sd_ln", Kind::Number(Unit::One), "Standard deviation of its logarithm.";
    POSTERIOR: "posterior_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "Median of the posterior.";
    POSTERIOR_SD: "posterior_sd_ln", Kind::Number(Unit::One), "Standard deviation of its logarithm.";
    MOVED_BY_DATA: "moved_sd", Kind::Number(Unit::One), "How far the measurements moved it, in standard deviations of the prior.";
    LEARNED: "learned", Kind::Number(Unit::One), "What part of the variance of the prior the measurements took away.";
    IS_SHOWN: "shown", Kind::Truth, "The measurements tell more of it than the prior, and it is known to half of itself.";
    MODELS: "models", Kind::Nested, "The models that were tried.";
    BIC: "bic", Kind::Number(Unit::One), "Schwarz's criterion; less is better.";
    POSTURES: "postures", Kind::Count, "How many postures.";
    READINGS: "readings", Kind::Count, "How many rows.";
    RMS_BEFORE: "rms_before_mm", Kind::Number(Unit::Millimetre), "How far a coordinate moved, root mean square.";
    RMS_AFTER: "rms_after_mm", Kind::Number(Unit::Millimetre), "What the compliances found leave of that.";
    RMS_USED: "rms_used_mm", Kind::Number(Unit::Millimetre), "What the compliances of the robot file leave of that.";
    RMS_LEFT_OUT: "rms_left_out_mm", Kind::Number(Unit::Millimetre), "The same of each posture by the others; null where a posture alone shows some drive.";
    EXPLAINED: "explained", Kind::Number(Unit::One), "1 - rms after / rms before.";
    EXPLAINED_LEFT_OUT: "explained_left_out", Kind::Number(Unit::One), "The same of each posture by the others.";
    NOISE_RATIO: "noise_ratio", Kind::Number(Unit::One), "How many times the noise that the table tells the remainders are.";
    CONDITION: "condition", Kind::Number(Unit::One), "The largest singular value over the smallest; null where some drive is not seen.";
    SINGULAR_VALUES: "singular_values", numbers(Unit::One, &[]), "Of all rows, mm per urad/(N m), descending.";
    LEAST_SEEN: "least_seen", numbers(Unit::One, &[]), "The combination of drives that is seen worst; its squares add up to 1.";
    CORRELATION: "correlation", Kind::Nested, "Correlation of the compliances found.";
    OUTLIERS: "outliers", Kind::Nested, "Rows that do not fit, from 1, the worst first.";
    RESIDUALS: "residuals", Kind::Nested, "What remains of every row.";
    READING: "row", Kind::Count, "Its number, from 1.";
    OF_POSTURE: "posture", Kind::Count, "Its posture, from 1.";
    MEASURED: "measured_mm", numbers(Unit::Millimetre, &["dx_mm", "dy_mm", "dz_mm"]), "The displacement along base axes.";
    REMAINS: "remains_mm", numbers(Unit::Millimetre, &["rx_mm", "ry_mm", "rz_mm"]), "What the compliances found leave of it.";
    LEFT_OUT: "left_out_mm", Kind::Number(Unit::Millimetre), "Length of what those leave that are found without its posture.";
    RATIO: "sigmas", Kind::Number(Unit::One), "What Huber's estimate leaves of it, in standard deviations of a coordinate.";
    DATE: "date", Kind::Text, "When was measured.";
    RUNS: "runs", Kind::Nested, "One entry per run, in the order in which they are made.";
    RUN: "run", Kind::Count, "Its number, from 1.";
    OF_LOAD: "load", Kind::Text, "In which direction is loaded.";
    EXPECTED: "expected_mm", Kind::Number(Unit::Millimetre), "How far the marker is expected to move.";
    CRITERION: "criterion", Kind::Text, "What a plan is judged by.";
    CRITERION_VALUE: "value", Kind::Number(Unit::One), "By the criterion: mean variance of the displacement under 1 N over the work, (um/N)^2, or a variance in parts of the compliances.";
    CRITERION_BOUND: "lower_bound", Kind::Number(Unit::One), "No plan of so many runs of the candidates has less.";
    EFFICIENCY: "efficiency", Kind::Number(Unit::One), "The bound over the value: 1 is proved best.";
    RANDOM_EFFICIENCY: "random_efficiency", Kind::Number(Unit::One), "The same of the median random choice; null where that leaves some drive unseen.";
    CANDIDATES: "candidates", Kind::Count, "Among so many was chosen.";
    UNSEEN: "unseen_drives", Kind::Nested, "Drives that no candidate shows.";
    UNSEEN_SHARE: "unseen_share", Kind::Number(Unit::One), "What part of the variance of the prediction is the prior of these drives.";
    ADVISED_LOADS: "advised_loads", Kind::Nested, "Directions of loads that show them, where some do.";
    COMPARED: "compared", Kind::Nested, "What the table that was given is worth.";
    REMARKS: "remarks", Kind::Nested, "What is odd.";
    ENTRY: "row", Kind::Text, "Which row of a matrix.";
    PATH: "path", Kind::Text, "The toolpath as it was asked for.";
    PATH_FORMAT: "format", Kind::Text, "How it is written: gcode, apt, csv or built-in.";
    LINES: "lines", Kind::Count, "Lines that were read.";
    FEED_LENGTH: "feed_length_m", Kind::Number(Unit::Metre), "Length of all moves at a feed rate.";
    RAPID_LENGTH: "rapid_length_m", Kind::Number(Unit::Metre), "Length of all rapid moves whose beginning is known.";
    FEED_MOVES: "feed_moves", Kind::Count, "Moves at a feed rate.";
    TOOLS: "tools", Kind::Nested, "Numbers of the tools that feed, in the order in which they come; null where none is named.";
    RAPID_MOVES: "rapid_moves", Kind::Count, "Rapid moves whose beginning is known.";
    APART: "machine_moves", Kind::Count, "Moves that are no part of the path: from where the file does not tell, or by coordinates of the machine.";
    ARCS: "arcs", Kind::Count, "Feed moves that are arcs or helices.";
    FULL_CIRCLES: "full_circles", Kind::Count, "Of these, those of a whole turn or more.";
    ARC_LENGTH: "arc_length_m", Kind::Number(Unit::Metre), "Length of the arcs.";
    BOX: "box_m", Kind::Numbers { unit: Unit::Metre, columns: &["box_x0_m", "box_y0_m", "box_z0_m", "box_x1_m", "box_y1_m", "box_z1_m"], nested: 3 },
        "Two corners of the box about all feed moves, in the axes of the path.";
    RAPID_BOX: "rapid_box_m", Kind::Numbers { unit: Unit::Metre, columns: &["rapid_box_x0_m", "rapid_box_y0_m", "rapid_box_z0_m", "rapid_box_x1_m", "rapid_box_y1_m", "rapid_box_z1_m"], nested: 3 },
        "Two corners of the box about the ends of all rapid moves whose beginning is known, in the axes of the path; null where there is none.";
    FEEDS: "feed_mm_per_min", numbers(Unit::MillimetrePerMinute, &["feed_min_mm_per_min", "feed_max_mm_per_min"]), "The smallest and the largest feed rate; null where none is said.";
    FEED_TIME: "time_s", Kind::Number(Unit::Second), "Time of all feed moves; null where a feed rate is missing.";
    TILT: "tilt_deg", Kind::Number(Unit::Degree), "The largest angle between tool axis and z while it feeds.";
    AXIS_TURN: "turn_deg", Kind::Number(Unit::Degree), "The largest angle of the tool axis to where it first feeds.";
    CHORD_ERROR: "chord_error_mm", Kind::Number(Unit::Millimetre), "By how much chords between samples are off the arcs at most.";
    ARC_MISS: "arc_miss_mm", Kind::Number(Unit::Millimetre), "By how much the ends of an arc miss one radius at most.";
    ASSUMED: "assumed", Kind::Nested, "What the file leaves open and how it was taken, with the line that came first.";
    IGNORED: "ignored", Kind::Nested, "Words of the file that move nothing, each kind once.";
    PROCESS: "process", Kind::Text, "The process file.";
    LAW: "law", Kind::Text, "Where the force comes from.";
    MATERIAL: "material", Kind::Text, "The material whose numbers come with the program; null where they are given.";
    MATERIAL_STATUS: "material_status", Kind::Text, "How well its numbers are known: published or unverified.";
    MATERIAL_SOURCE: "material_source", Kind::Text, "Who says so.";
    MEAN_FORCE: "mean_n", numbers(Unit::Newton, &["mean_feed_n", "mean_across_n", "mean_axial_n"]), "Mean force over a revolution, on the tool: along the feed, across (left of it), axial (away from the work); null where it may point anywhere.";
    MAX_FORCE: "max_n", numbers(Unit::Newton, &["max_feed_n", "max_across_n", "max_axial_n"]), "The largest of each over a revolution.";
    MIN_FORCE: "min_n", numbers(Unit::Newton, &["min_feed_n", "min_across_n", "min_axial_n"]), "The smallest of each over a revolution.";
    PEAK_FORCE: "largest_n", Kind::Number(Unit::Newton), "The largest size of the force over a revolution.";
    MOMENT: "moment_nm", Kind::Number(Unit::NewtonMetre), "Mean moment on the tool about its axis, positive about the axis away from the work.";
    POWER: "power_w", Kind::Number(Unit::Watt), "Mean power of the spindle; null where its speed or the moment is not known.";
    SPINDLE_SPEED: "spindle_rpm", Kind::Number(Unit::Given("rpm")), "Speed of the spindle.";
    ENTRY_ANGLE: "entry_deg", Kind::Number(Unit::Degree), "Where a tooth enters, from the left of the feed in the sense of the rotation.";
    EXIT_ANGLE: "exit_deg", Kind::Number(Unit::Degree), "Where a tooth leaves.";
    CUTTING_FORCE: "force", Kind::Text, "Where the force on the tool comes from.";
    PART: "part", Kind::Nested, "The path as it was cut: samples, lengths and time.";
    SAMPLES_OF_PATH: "samples", Kind::Count, "Samples along the path.";
    PATH_LENGTH: "length_m", Kind::Number(Unit::Metre), "Length of the path, rapid ways and all.";
    CUTTING_LENGTH: "cutting_length_m", Kind::Number(Unit::Metre), "Length of what feeds.";
    TIME: "time_s", Kind::Number(Unit::Second), "Time of what feeds; null where a feed rate is not said.";
    ROLL_CHOICE: "roll", Kind::Nested, "How the tool is turned about its axis.";
    ROLL_MODE: "mode", Kind::Text, "free, constant, linear or fixed.";
    ROLL_FROM: "from_deg", Kind::Number(Unit::Degree), "The smallest roll: of the tool's x axis from the part's.";
    ROLL_TO: "to_deg", Kind::Number(Unit::Degree), "The largest roll.";
    PINS: "pins", Kind::Nested, "Where the roll is pinned: samples with their way along the path and their roll.";
    PINNED_SAMPLE: "sample", Kind::Count, "Which sample, from 0.";
    PINNED_WAY: "way_mm", Kind::Number(Unit::Millimetre), "How far along the path it stands.";
    PINNED_ROLL: "roll_deg", Kind::Number(Unit::Degree), "Its roll.";
    REARRANGED: "rearranged", Kind::Count, "How often the arm takes another configuration, clear of the work.";
    ERROR_PART: "error", Kind::Text, "What of the displacement counts: total, across or axial.";
    SPEED_SHARE: "speed_share", Kind::Number(Unit::One), "Of the joints' speeds what is used at most; null where the robot file tells none.";
    AT: "at_m", numbers(Unit::Metre, &["at_x_m", "at_y_m", "at_z_m"]), "Where the path's origin stands, from the robot's base.";
    AT_YAW: "at_yaw_deg", Kind::Number(Unit::Degree), "By how much the part is turned about the vertical from straight ahead of the robot; null of a base that leans.";
    CELL_ORIGIN: "cell_m", numbers(Unit::Metre, &["cell_x_m", "cell_y_m", "cell_z_m"]), "Where the path's origin stands in the axes of the cell, its floor at 0; null without a cell.";
    CELL_YAW: "cell_yaw_deg", Kind::Number(Unit::Degree), "By how much the part is turned about the vertical from the cell's x axis; null without a cell.";
    PATH_WORST: "worst_mm", Kind::Number(Unit::Millimetre), "The largest error along the path.";
    PATH_WORST_P05: "worst_mm_p05", Kind::Number(Unit::Millimetre), "5th percentile over draws of the drive stiffness, in the postures of the answer; null where the uncertainty of the drives is not known.";
    PATH_WORST_P50: "worst_mm_p50", Kind::Number(Unit::Millimetre), "Median.";
    PATH_WORST_P95: "worst_mm_p95", Kind::Number(Unit::Millimetre), "95th percentile.";
    PATH_LOWER_BOUND: "lower_bound_mm", Kind::Number(Unit::Millimetre), "No rolls of the mode that was asked for, through the pins where there are some, and where the place was searched for no place, have less.";
    ROLL_LOWER_BOUND: "roll_lower_bound_mm", Kind::Number(Unit::Millimetre), "No rolls of that mode have less at this place.";
    RMS: "rms_mm", Kind::Number(Unit::Millimetre), "The root mean square of the error over what feeds.";
    WORST_SAMPLE: "worst_sample", Kind::Count, "The sample with the largest error, from 0.";
    WORST_TOOL: "worst_tool", Kind::Count, "The tool with the largest error, of a path that is milled with several.";
    BY_TOOL: "by_tool", Kind::Nested, "What each tool of the path does, in the order in which they mill: the keys of a path with one tool, its number and its tip.";
    TOOL_NUMBER: "tool_number", Kind::Count, "The number of the tool in the file of the path.";
    WORST_LINE: "worst_line", Kind::Count, "Its line in the file; 0 of a path built in.";
    FED_BACK: "fed_back", Kind::Nested, "What becomes of the largest error as width and depth of the cut change with the displacement; null where no cut is known.";
    CONTRACTION: "contraction", Kind::Number(Unit::One), "What of a displacement the cut gives back at most; from 1 on nothing settles.";
    UNSETTLED: "unsettled", Kind::Count, "Samples at which nothing settles: pushed aside, the tool is drawn in.";
    PATH_CHATTER: "chatter", Kind::Nested, "Whether the cuts swing with the arm, at the sample at which the critical depth is least in proportion to the cut; null where that was not asked, or the path is not followed.";
    PATH_CHATTER_VERDICT: "chatter_verdict", Kind::Text, "What is told of robot modes and of spindle modes along a path, in words, with the sample of which it is.";
    CHATTER_SAMPLE: "at_sample", Kind::Count, "The sample at which the critical depth is least in proportion to the cut, from 0; null where no sample is covered.";
    CHATTER_LINE: "at_line", Kind::Count, "Its line in the file; 0 of a path built in.";
    FEED_DIRECTION: "feed", numbers(Unit::One, &["feed_x", "feed_y", "feed_z"]), "Where the tool feeds, of length one, base axes.";
    DEEPEST_ROLL: "deepest_roll_deg", Kind::Number(Unit::Degree), "Of the rolls, in steps of 5 deg, that keep the margins and touch nothing at the worst sample in its configuration: the one with which its cut goes deepest; null where nothing is told.";
    DEEPEST_DEPTH: "deepest_depth_mm", Kind::Number(Unit::Millimetre), "From which depth it then swings, by the mean of the teeth over a revolution; null where none up to 300 mm does.";
    DEEPEST_ERROR: "deepest_error_mm", Kind::Number(Unit::Millimetre), "The error of that sample, so rolled.";
    ROLLED_RESERVE: "rolled_reserve", Kind::Number(Unit::One), "The whole path so rolled: its least critical depth in parts of that of the cut, by the mean; null where it is not followed so, or no edge swings.";
    ROLLED_LINE: "rolled_at_line", Kind::Count, "The line of the file on which that is; null where the path is not followed so.";
    ROLLED_ERROR: "rolled_error_mm", Kind::Number(Unit::Millimetre), "The largest error along the path so rolled.";
    COVERED: "covered_samples", Kind::Count, "Samples of which a critical depth is told.";
    NOT_COVERED: "not_covered", Kind::Nested, "Samples that feed, and of which nothing is told: why, how many, and the lines on which they are.";
    UNCOVERED_WHY: "why", Kind::Text, "plunge, turn in place, force of the path (it gives no cut), or air.";
    UNCOVERED_LINES: "lines", Kind::Nested, "Lines of the file, ascending; none of a path built in.";
    MEAN_MISLEADS: "mean_misleads", Kind::Count, "Samples whose teeth cut so shortly, and pass so slowly, that their mean over a revolution misleads; only the worst is counted tooth by tooth.";
    PATH_COMPENSATION: "compensation", Kind::Nested, "What compensation makes of the path; null where it was not asked for.";
    LARGEST_CORRECTION: "largest_correction_mm", Kind::Number(Unit::Millimetre), "By how much a tip is led aside at most.";
    LEFT_BY_JOINTS: "left_by_joints_mm", Kind::Number(Unit::Millimetre), "The largest error that is left by the model where joints, or whole poses, are commanded.";
    LEFT_BY_TIPS: "left_by_tips_mm", Kind::Number(Unit::Millimetre), "The same where tips alone are, the tool turned as in the path; null where one is not reached.";
    LEFT_MEDIAN: "left_median_mm", Kind::Number(Unit::Millimetre), "Median over draws of the drive stiffness; null where its uncertainty is not known.";
    LEFT_P95: "left_p95_mm", Kind::Number(Unit::Millimetre), "95th percentile over these draws.";
    UNCERTAIN: "uncertainty", Kind::Text, "The source of the uncertainty of the drive stiffness.";
    BEYOND_LIMITS: "beyond_limits", Kind::Count, "Samples at which a joint is commanded beyond its range.";
    WORK_FRAME: "work_frame", Kind::Text, "How the place of the work was found: measured or touched; null where nothing is followed.";
    TRUE_ARM: "true_arm", Kind::Nested, "The largest error of the calibrated arm, geometry and load together; null of an arm that was not calibrated.";
    UNCORRECTED: "uncorrected_mm", Kind::Number(Unit::Millimetre), "Where nothing is corrected.";
    BY_STIFFNESS: "by_stiffness_mm", Kind::Number(Unit::Millimetre), "Where the deflection alone is; null under a force that may point anywhere.";
    BY_GEOMETRY: "by_geometry_mm", Kind::Number(Unit::Millimetre), "Where the geometry alone is.";
    BY_BOTH: "by_both_mm", Kind::Number(Unit::Millimetre), "Where both are, by the model; null under a force that may point anywhere.";
    CALIBRATION_LEFT: "calibration_left_mm", Kind::Number(Unit::Millimetre), "What the calibration leaves where it was not measured, rms.";
    ARM_ERROR: "arm_error", Kind::Nested, "The largest geometric error along the path of arms that nobody has calibrated: median and 95th percentile; null of one that was calibrated.";
    SEARCH: "search", Kind::Nested, "How finely a place was looked for; null where it was given.";
    SAMPLES_OF_SEARCH: "samples", Kind::Count, "Samples that stood for the path in the search.";
    VERIFIED: "verified", Kind::Truth, "The readings agree with the robot file, and with no other way of counting the joints.";
    READ_ROWS: "rows", Kind::Count, "Postures that were read.";
    LARGEST_OFF: "largest_mm", Kind::Number(Unit::Millimetre), "The largest distance between what was read and what the file says.";
    OFF: "rms_mm", Kind::Number(Unit::Millimetre), "The root mean square of these distances.";
    LARGEST_TURN: "largest_deg", Kind::Number(Unit::Degree), "The largest turn between orientations; null where none was read.";
    FITS: "fits", Kind::Nested, "Robots and ways of counting the joints, the best first.";
    THIRD_AXIS: "third_axis", Kind::Text, "What joint 3 counts from: elbow, the upper arm; forearm, the horizontal.";
    SIGN: "sign", numbers(Unit::One, &["sign_1", "sign_2", "sign_3", "sign_4", "sign_5", "sign_6"]), "Of each joint, as in a robot file.";
    ZERO: "zero_deg", numbers(Unit::Degree, &["zero_1_deg", "zero_2_deg", "zero_3_deg", "zero_4_deg", "zero_5_deg", "zero_6_deg"]), "Zero offset of each joint, as a robot file has it.";
    CARRIED: "carried", numbers(Unit::One, &["4_in_5", "4_in_6", "5_in_6"]), "By how much joints of the wrist carry others along: 4 turns 5, 4 turns 6, 5 turns 6.";
    DIFFERENCES: "differences", Kind::Nested, "In what it differs from its robot file, in words.";
    DIFFERS: "differs", Kind::Text, "The same in a line.";
    ALIKE: "alike", Kind::Nested, "What the readings do not tell apart, in words.";
    POSTURES_TO_READ: "postures_deg", Kind::Nested, "Postures that would tell it apart: joint angles.";
    WRONG_ROW: "wrong_row", Kind::Nested, "The row that is off where all others agree: its line in the file and its distance, mm; null where there is none.";
    BASE_SEEN: "base_mm_deg", Kind::Nested, "The base of the robot file in the frame of the readings: x, y, z mm and turns about fixed x, y, z deg; one for each stand.";
    POINTS_SEEN: "points_mm", Kind::Nested, "The points that were looked at, in the flange frame, mm.";
    MEASURED_POINTS: "measured", Kind::Truth, "Points were measured by an instrument; else the controller computed them.";
    LEVEL: "level", Kind::Text, "How much of the arm may differ from its drawing: zeros, geometry, weight, gears; of a list also as drawn.";
    OWN_WEIGHT: "own_weight", Kind::Text, "How the own weight is computed: `terms` of the joint angles, or `masses` of the robot file, with the compliance of each drive (`drives`) as all that is unknown; null of levels without it.";
    LEVELS: "levels", Kind::Nested, "Every level: what it leaves.";
    NOMINAL_RMS: "nominal_rms_mm", Kind::Number(Unit::Millimetre), "Root mean square of the distances of the arm as drawn.";
    MEDIAN_OFF: "median_mm", Kind::Number(Unit::Millimetre), "Median of the distances.";
    P95_OFF: "p95_mm", Kind::Number(Unit::Millimetre), "95th percentile of the distances.";
    LEFT_OUT_RMS: "left_out_rms_mm", Kind::Number(Unit::Millimetre), "Root mean square of the distances that are predicted where a third of a joint's range is left out; null where none can be.";
    EVIDENCE: "log_evidence", Kind::Number(Unit::One), "Logarithm of the marginal likelihood, up to what all levels share.";
    SHOWN: "shown", Kind::Number(Unit::One), "How many parameters the rows show: the trace of one less posterior over prior.";
    WRONG_ROWS: "wrong_rows", Kind::Nested, "Points that were left out: line of the file, point (0: all of the row) and distance, mm.";
    TRACKER_IN_BASE: "tracker_in_base", Kind::Nested, "Each stand of the tracker in the base: x, y, z mm and turns about fixed x, y, z deg.";
    NARROW: "narrow", Kind::Nested, "Joints that moved over less than a third of their range, with that share.";
    EXPECTED_AT_WORK: "expected_mm", Kind::Number(Unit::Millimetre), "Root mean square of the error that remains at the work, where it is found by the tracker.";
    LEAST_AT_WORK: "lower_bound_mm", Kind::Number(Unit::Millimetre), "No choice of as many of the candidates leaves less.";
    RANDOM_AT_WORK: "random_mm", Kind::Number(Unit::Millimetre), "What the median random choice leaves.";
    AS_DRAWN: "as_drawn_mm", Kind::Number(Unit::Millimetre), "Without a calibration.";
    UNEXPLAINED: "unexplained_mm", Kind::Number(Unit::Millimetre), "The part of all of these that no error of the arm explains, and no calibration takes away.";
    BY_COUNT: "by_count", Kind::Nested, "What so many postures leave, each chosen after those before.";
    POSTURE_COUNT: "postures", Kind::Count, "So many.";
    WORK_INTERVAL: "ci95_mm", numbers(Unit::Millimetre, &["ci95_low_mm", "ci95_high_mm"]), "Where that root mean square lies with 95 %.";
    WORK_P95: "work_p95_mm", Kind::Number(Unit::Millimetre), "95th percentile of the error at the work.";
    AT_WORK: "at_work", Kind::Nested, "The error that remains at the work: expected, with its interval, and over how many postures; null where the arm does not reach it.";
    WORK_POSTURES: "postures", Kind::Count, "Postures over which it is told.";
    ZERO_FOUND: "zero_deg", numbers(Unit::Degree, &["zero_1_deg", "zero_2_deg", "zero_3_deg", "zero_4_deg", "zero_5_deg", "zero_6_deg"]), "What is to be added to each reported angle.";
    FRAMES_FOUND: "frames_mm_mrad", Kind::Nested, "Of each joint's frame three shifts, mm, and three turns, mrad, in the base's axes at model zero; the zeros are left out.";
    WEIGHT_FOUND: "weight_mrad", Kind::Nested, "How drives yield under the arm's own weight, null where it is that of masses: of drive 2 on sin t2, cos t2, sin t23, cos t23, of drive 3 on sin t23, cos t23, of drive 5 on two arms of the tool.";
    WEIGHT_INTERVALS: "weight_ci95_mrad", Kind::Nested, "Where each lies with 95 %.";
    GEARS_FOUND: "gears_mrad", Kind::Nested, "Once per turn of each joint: sine, cosine.";
    BEFORE: "before_mm", Kind::Number(Unit::Millimetre), "The largest distance of the row's points as drawn.";
    AFTER: "after_mm", Kind::Number(Unit::Millimetre), "The same calibrated.";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_of_a_key_is_the_unit_of_its_numbers() {
        for field in ALL {
            let ending = match field.unit() {
                Some(Unit::Metre) => "_m",
                Some(Unit::Millimetre) => "_mm",
                Some(Unit::Degree) => "_deg",
                Some(Unit::Milliradian) => "_mrad",
                Some(Unit::Newton) => "_n",
                Some(Unit::MicrometrePerNewton) => "_um_per_n",
                Some(Unit::MicroradianPerNewtonMetre) => "_urad_per_nm",
                Some(Unit::NewtonMetrePerRadian) => "_nm_per_rad",
                Some(Unit::Kilogram) => "_kg",
                Some(Unit::NewtonMetre) => "_nm",
                Some(Unit::Second) => "_s",
                Some(Unit::Watt) => "_w",
                Some(Unit::MillimetrePerMinute) => "_mm_per_min",
                Some(Unit::Given(unit)) => unit,
                Some(Unit::One) | None => "",
            };
            let key =
                ["_p05", "_p50", "_p95"].iter().find_map(|share| field.key.strip_suffix(share)).unwrap_or(field.key);
            assert!(key.ends_with(ending), "{field:?}");
            let endings = ["_m", "_mm", "_deg", "_mrad", "_n", "_um_per_n", "_urad_per_nm", "_nm_per_rad", "_kg"];
            let has_unit = endings.iter().any(|ending| key.ends_with(ending));
            assert!(!ending.is_empty() || !has_unit || field.unit().is_none(), "a number of no unit: {field:?}");
            assert!(field.about.ends_with('.') && field.about.is_ascii(), "{field:?}");
            if let Kind::Numbers { columns, .. } = field.kind {
                assert!(columns.is_empty() || 1 < columns.len(), "{field:?}");
            }
        }
    }

    #[test]
    fn numbers_are_told_in_their_unit() {
        for (unit, si, told) in [
            (Unit::Millimetre, 0.0025, 2.5),
            (Unit::Degree, std::f64::consts::PI, 180.0),
            (Unit::MicrometrePerNewton, 3e-6, 3.0),
            (Unit::Milliradian, 0.5, 500.0),
            (Unit::MicroradianPerNewtonMetre, 0.7e-6, 0.7),
            (Unit::Metre, 1.5, 1.5),
            (Unit::MillimetrePerMinute, 0.01, 600.0),
        ] {
            assert!((unit.of_si(si) - told).abs() < 1e-12, "{unit:?}");
        }
    }
}
