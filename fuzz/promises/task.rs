//! Is every text either a zone of a size a robot can reach, which its own name gives back, or refused with that text?

use stiffarm::task::{Task, TaskError, Work, Zone};

/// Panics where it is not.
fn of_a_size(zone: Zone) {
    let sides = match zone {
        Zone::Circle { diameter } => [diameter; 2],
        Zone::Rectangle { width, height } => [width, height],
    };
    assert!(sides.iter().all(|side| (1e-4..=50.0).contains(side)), "{zone:?}");
    let again: Task = zone.to_string().parse().expect("the name of a zone is a task");
    assert_eq!(again.work, Work::Zone(zone));
}

/// Panics where the promise is broken.
pub(crate) fn holds(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match text.parse::<Task>() {
        Ok(task) => {
            match &task.work {
                Work::Zone(zone) => of_a_size(*zone),
                Work::Part(part) => part.faces.iter().for_each(|face| of_a_size(face.zone)),
            }
            assert!(!task.work.describe().is_empty());
        }
        Err(TaskError::Zone(error)) => assert!(error.to_string().contains(text)),
        // Of a part the face or the size that is wrong is named.
        Err(TaskError::Part(error)) => assert!(!error.to_string().is_empty()),
    }
}
