//! What can be reported of one posture.

use super::groups::{OF_ROBOT, OF_SPREAD};
use super::kinds::{Kind, Unit, fields, numbers};
use super::slots::{shapes, slots};

fields! {
    JOINTS: "joints_deg", numbers(Unit::Given("deg"), &["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"]), "Joint angles as the robot reports them, deg.";
    JOINTS_BEYOND: "joints_beyond_limits", Kind::List(&Kind::Count), "Joints beyond their limits at these angles, 0 for the angle between the links.";
    PENDANT: "pendant", Kind::Text, "Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by whoever asks), unknown.";
    TCP: "tcp_m", numbers(Unit::Metre, &["tcp_x_m", "tcp_y_m", "tcp_z_m"]), "The tool point.";
    COMPLIANCE: "compliance_um_per_n", Kind::Numbers { unit: Unit::MicrometrePerNewton, columns: &[], nested: 3, open: false }, "From force to translation, base axes.";
    COMPLIANCE_6X6: "compliance_6x6_si", Kind::Numbers { unit: Unit::One, columns: &[], nested: 6, open: false }, "From wrench to translation and rotation, base axes, SI.";
    PRINCIPAL: "principal_um_per_n", numbers(Unit::MicrometrePerNewton, &[]), "Principal compliances, ascending.";
    WORST_DIRECTION: "worst_direction", numbers(Unit::One, &[]), "The unit direction of the last of them.";
    FORCE_VECTOR: "force_n", numbers(Unit::Newton, &["fx_n", "fy_n", "fz_n"]), "The force at the tool point, base axes: as given, or of those that it may be the one that does most.";
    MOVED: "deflection_mm", numbers(Unit::Millimetre, &["dx_mm", "dy_mm", "dz_mm"]), "The translation under it.";
    TURNED: "rotation_mrad", numbers(Unit::Milliradian, &["rx_mrad", "ry_mrad", "rz_mrad"]), "The rotation under it.";
    COUNTED: "largest_mm", Kind::Number(Unit::Millimetre), "What counts of the translation, the largest that the force may cause.";
}

shapes! {
    COMPLIANCE: "ComplianceDict", "What `compliance` answers.", &[
        OF_ROBOT,
        slots![
            MODEL, JOINTS, JOINTS_BEYOND, PENDANT, TCP, COMPLIANCE, COMPLIANCE_6X6, PRINCIPAL, WORST_DIRECTION, WORST_SHARES,
            FORCE_VECTOR | null, MOVED | null, TURNED | null, COUNTED | null,
        ],
        OF_SPREAD,
        slots![FORCE_AXES | null, FORCE_DIRECTION | null, FORCE_CONE | null, FEED | null, COMPONENT | null],
    ];
    FORCE: "ForceDict", "What `force` answers.", &[slots![
        PROCESS, LAW, MATERIAL | null, MATERIAL_STATUS | null, MATERIAL_SOURCE | null, MEAN_FORCE | null, MAX_FORCE | null,
        MIN_FORCE | null, PEAK_FORCE, MOMENT, POWER | null, SPINDLE_SPEED | null, ENTRY_ANGLE | null, EXIT_ANGLE | null, ASSUMED,
    ]];
}
