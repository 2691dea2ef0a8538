//! What can be reported of how an arm swings.

use super::groups::{OF_ROBOT, OF_TOOL_BODY};
use super::kinds::{Kind, Unit, fields, numbers};
use super::slots::{shapes, slots};

fields! {
    TOOL_COM: "tool_com_mm", numbers(Unit::Millimetre, &["tool_com_x_mm", "tool_com_y_mm", "tool_com_z_mm"]), "Mass centre of the tool in the flange frame.";
    TOOL_INERTIA: "tool_inertia_kg_m2", numbers(Unit::Given("kg_m2"), &["tool_ixx_kg_m2", "tool_ixy_kg_m2", "tool_ixz_kg_m2", "tool_iyy_kg_m2", "tool_iyz_kg_m2", "tool_izz_kg_m2"]),
        "Inertia of the tool about its mass centre, along flange axes.";
    MODES: "modes", Kind::Objects, "How the arm swings, the lowest frequency first.";
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
    MASSES_LEFT_OUT: "masses_left_out", Kind::List(&Kind::Text), "Moving parts whose masses the robot file does not have.";
}

shapes! {
    MODES: "ModesDict", "What `modes` answers of a posture.", &[
        OF_ROBOT, slots![MODEL, JOINTS, PENDANT, TCP], OF_TOOL_BODY, slots![DAMPING_SOURCE, MASSES_LEFT_OUT, MODES => SWING_MODE],
    ];
    MODES_OVER_ZONE: "ModesOverZoneDict", "What `modes --task` answers of a zone.", &[
        OF_ROBOT,
        slots![
            MODEL, TASK, TOOL, TOOL_DIRECTION, X, Z, BEARING | null, YAW | null, ANGLE, ROLL | null, SHOULDER | null, ELBOW,
            WRIST | null, PENDANT,
        ],
        OF_TOOL_BODY,
        slots![
            MASSES_LEFT_OUT, FIRST_AT_LEAST | null, FIRST_AT_LEAST_P05 | null, ZONE_PARTS, SAMPLES, SAMPLE_STEP,
            MODES => MODE_OVER_ZONE,
        ],
    ];
    MODE_OVER_ZONE: "ModeOverZone", "One mode over a zone; modes are counted by their frequencies at each point.", &[slots![
        MODE, FREQUENCY_LEAST, FREQUENCY_P05 | null, FREQUENCY_P95 | null, LEAST_AT, FREQUENCY_LARGEST, LARGEST_AT,
    ]];
    SWING_MODE: "SwingMode", "One way in which an arm swings.", &[slots![
        MODE, FREQUENCY, FREQUENCY_P05 | null, FREQUENCY_P95 | null, FREQUENCY_FREE | null, DAMPING_RATIO, TIP_SHAPE, ENERGY_SHARES,
    ]];
}
