//! Which fields does an identification have?

use super::{Slot, shapes, slots};

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
