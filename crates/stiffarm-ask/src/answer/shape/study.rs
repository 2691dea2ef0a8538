//! Which fields does a study of architectures have?

use super::{shapes, slots};

shapes! {
    BOUNDARY: "Boundary", "A size at which the better one changes.", &[slots![TASK, MU | null, SIZE, BETTER_BELOW, BETTER_ABOVE]];
    STUDY: "StudyDict", "What `study` answers.",
        &[slots![ROWS => STUDY_ROW, BOUNDARIES => BOUNDARY, MARK | null => STUDY_MARK]];
    STUDY_MARK: "StudyMark", "A robot with its task among what was studied.",
        &[slots![ROBOT, TASK, MU, SIZE, ACCURACIES, STIFFER | null]];
    STUDY_ROW: "StudyRow", "One contender at one size.",
        &[slots![TASK, SIZE, MU | null, IS_BEST, ARCHITECTURE, K2, K3, ACCURACY | null]];
}
