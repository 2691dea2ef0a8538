//! Is every text either a process with a finite force, or a list of faults with lines and reasons?

use stiffarm::catalogue::read_process;

/// Panics where the promise is broken.
pub(crate) fn holds(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match read_process(text, "fuzz.toml") {
        Ok(found) => {
            let force = found.process.force().expect("a process that was read has a force");
            assert!(force.largest.is_finite() && force.moment.is_finite());
            if let (Some(mean), Some([low, high])) = (force.mean, force.range) {
                for i in 0..3 {
                    let slack = 1e-6 * (1.0 + force.largest);
                    assert!(low[i] - slack <= mean[i] && mean[i] <= high[i] + slack, "{low:?} {mean:?} {high:?}");
                }
            }
        }
        Err(faults) => {
            assert!(!faults.faults.is_empty(), "refused without a reason");
            let lines = text.split('\n').count();
            assert!(faults.faults.iter().all(|fault| (1..=lines).contains(&fault.line) && !fault.message.is_empty()));
        }
    }
}
