//! What can be reported of identified drives.

use super::kinds::{Kind, Unit, fields, numbers};
use super::slots::{Slot, shapes, slots};

fields! {
    SPRING: "drive", Kind::Count, "Which drive, from 1.";
    DRIVES: "drives", Kind::Objects, "One entry per drive.";
    ESTIMATE: "compliance_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "The compliance found; null where it is not seen.";
    STANDARD_ERROR: "standard_error_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "The larger of that from the scatter of all remainders and that from leaving out each posture.";
    INTERVAL: "ci95_urad_per_nm", numbers(Unit::MicroradianPerNewtonMetre, &["ci95_low_urad_per_nm", "ci95_high_urad_per_nm"]), "Where it lies with 95 %.";
    STIFFNESS: "stiffness_nm_per_rad", Kind::Number(Unit::NewtonMetrePerRadian), "One over the compliance found.";
    ROBUST: "robust_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "The compliance by Huber's estimate.";
    IS_IDENTIFIED: "identified", Kind::Truth, "The measurements show it, to half of itself or better.";
    NOT_IDENTIFIED: "why_not", Kind::Text, "Why they do not.";
    USED: "used_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "What the robot file has: found with all that is not identified held, or as it was before.";
    ESTIMATOR: "fit", Kind::Text, "least-squares or huber.";
    FURTHER_SPRINGS: "springs", Kind::Objects, "What springs besides the drives.";
    SPRING_NAME: "spring", Kind::Text, "Its name.";
    REGION: "joint_2_deg", numbers(Unit::Degree, &["joint_2_from_deg", "joint_2_to_deg"]), "Where joint 2 stood, as reported, deg; null of what is no region of joint 2.";
    COMPENSATOR: "compensator", Kind::Objects, "What is found of a gravity compensator: its spring, and its preload.";
    IN_UNIT: "unit", Kind::Text, "The unit of its numbers.";
    FOUND: "found", Kind::Number(Unit::One), "What is found; null where it is not seen.";
    FOUND_ERROR: "standard_error", Kind::Number(Unit::One), "Its standard error.";
    FOUND_INTERVAL: "ci95", numbers(Unit::One, &["ci95_low", "ci95_high"]), "Where it lies with 95 %.";
    FOUND_USED: "used", Kind::Number(Unit::One), "What the robot file has.";
    POSTERIOR_DRIVES: "posterior", Kind::Objects, "What the measurements make of the prior, drive by drive; null where that was not asked for.";
    PRIOR: "prior_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "Median of the prior.";
    PRIOR_SD: "prior_sd_ln", Kind::Number(Unit::One), "Standard deviation of its logarithm.";
    POSTERIOR: "posterior_urad_per_nm", Kind::Number(Unit::MicroradianPerNewtonMetre), "Where the posterior of its logarithm is densest; the interval is that of the normal distribution about it (Laplace).";
    POSTERIOR_SD: "posterior_sd_ln", Kind::Number(Unit::One), "Standard deviation of its logarithm.";
    MOVED_BY_DATA: "moved_sd", Kind::Number(Unit::One), "How far the measurements moved it, in standard deviations of the prior.";
    LEARNED: "learned", Kind::Number(Unit::One), "What part of the variance of the prior the measurements took away.";
    IS_SHOWN: "shown", Kind::Truth, "The measurements tell more of it than the prior, and it is known to half of itself.";
    MODELS: "models", Kind::Objects, "The models that were tried.";
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
    CORRELATION: "correlation", Kind::List(&Kind::List(&Kind::Number(Unit::One))), "Correlation of the compliances found.";
    OUTLIERS: "outliers", Kind::List(&Kind::Count), "Rows that do not fit, from 1, the worst first.";
    RESIDUALS: "residuals", Kind::Objects, "What remains of every row.";
    READING: "row", Kind::Count, "Its number, from 1.";
    OF_POSTURE: "posture", Kind::Count, "Its posture, from 1.";
    MEASURED: "measured_mm", numbers(Unit::Millimetre, &["dx_mm", "dy_mm", "dz_mm"]), "The displacement along base axes.";
    REMAINS: "remains_mm", numbers(Unit::Millimetre, &["rx_mm", "ry_mm", "rz_mm"]), "What the compliances found leave of it.";
    LEFT_OUT: "left_out_mm", Kind::Number(Unit::Millimetre), "Length of what those leave that are found without its posture.";
    RATIO: "sigmas", Kind::Number(Unit::One), "What Huber's estimate leaves of it, in standard deviations of a coordinate.";
    DATE: "date", Kind::Text, "When was measured.";
}

shapes! {
    FOUND_COMPENSATOR: "FoundCompensator", "What is found of a gravity compensator.", &[slots![
        SPRING_NAME, IN_UNIT, FOUND | null, FOUND_ERROR | null, FOUND_INTERVAL | null, IS_IDENTIFIED, NOT_IDENTIFIED | null, FOUND_USED,
    ]];
    FURTHER_SPRING: "FurtherSpring", "What is found of what springs besides the drives.",
        &[slots![SPRING_NAME, REGION | null], OF_SPRING];
    IDENTIFICATION: "IdentificationDict", "What `identify` answers.", &[slots![
        ROBOT, VENDOR, DATE | null, ESTIMATOR, POSTURES, READINGS, MODEL, DRIVES => IDENTIFIED_DRIVE,
        FURTHER_SPRINGS => FURTHER_SPRING, COMPENSATOR => FOUND_COMPENSATOR, POSTERIOR_DRIVES | null => UPDATED_DRIVE,
        MODELS => TRIED_MODEL, RMS_BEFORE, RMS_AFTER, RMS_LEFT_OUT | null, RMS_USED, EXPLAINED, EXPLAINED_LEFT_OUT | null,
        NOISE_RATIO | null, CONDITION | null, SINGULAR_VALUES, LEAST_SEEN, CORRELATION, OUTLIERS, RESIDUALS => READING_RESIDUAL, REMARKS,
    ]];
    IDENTIFIED_DRIVE: "IdentifiedDrive", "What is found of a drive.", &[slots![SPRING], OF_SPRING];
    READING_RESIDUAL: "ReadingRemainder", "What remains of a row of the measurements.",
        &[slots![READING, OF_POSTURE, MEASURED, REMAINS, LEFT_OUT | null, RATIO]];
    TRIED_MODEL: "TriedModel", "A model that was tried.", &[slots![MODEL, RMS_LEFT_OUT | null, BIC | null, NOT_IDENTIFIED | null]];
    UPDATED_DRIVE: "UpdatedDrive", "What measurements make of the prior of a drive.",
        &[slots![SPRING, PRIOR, PRIOR_SD, POSTERIOR, POSTERIOR_SD, INTERVAL, MOVED_BY_DATA, LEARNED, IS_SHOWN]];
}

const OF_SPRING: &[Slot] = slots![
    ESTIMATE | null,
    STANDARD_ERROR | null,
    INTERVAL | null,
    STIFFNESS | null,
    ROBUST | null,
    IS_IDENTIFIED,
    NOT_IDENTIFIED | null,
    USED,
];
