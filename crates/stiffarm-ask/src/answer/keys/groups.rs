//! Which fields stand together in several objects?

use super::slots::{Slot, slots};

/// Which robot, and how stiff.
pub(super) const OF_ROBOT: &[Slot] =
    slots![ROBOT, VENDOR, ARCHITECTURE, ARCHITECTURE_ASSUMED, STATUS, STIFFNESS_SOURCE, DRIVE_COMPLIANCE];

/// A force, its direction, and what counts of the displacement.
pub(super) const OF_FORCE: &[Slot] =
    slots![FORCE, FORCE_AXES | null, FORCE_DIRECTION | null, FORCE_CONE | null, FEED | null, COMPONENT];

/// What the robot carries, and whether it may.
pub(super) const OF_LOAD: &[Slot] = slots![
    PAYLOAD | null,
    TOOL_MASS | null,
    OVERLOADED | null,
    WRIST_MOMENT | null,
    WRIST_LIMIT | null,
    WRIST_LIMIT_BY | null,
    WRIST_EXCEEDED | null,
];

/// The tool as a body.
pub(super) const OF_TOOL_BODY: &[Slot] = slots![TOOL_MASS | null, TOOL_COM | null, TOOL_INERTIA | null];

/// Where the deflection lies over draws of the drives.
pub(super) const OF_SPREAD: &[Slot] = slots![DEFLECTION_P05 | null, DEFLECTION_P50 | null, DEFLECTION_P95 | null];

/// Whether a tolerance is kept.
pub(super) const OF_VERDICT: &[Slot] =
    slots![TOLERANCE | null, PASS | null, VERDICT | null, PROBABILITY | null, MARGIN | null];

/// A robot among others by draws of the drives, for each task.
pub(super) const OF_CHANCES: &[Slot] = slots![WIN_PROBABILITY, EXPECTED_REGRET, TIES_WITH_BEST];
