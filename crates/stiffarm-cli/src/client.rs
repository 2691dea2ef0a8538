//! Somebody who asks from elsewhere: is the work still wanted, how far is it, and what was said beside the answer?

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use stiffarm::watch::Waiting;

/// Who waits for one answer.
#[derive(Debug)]
pub(crate) struct Client {
    is_gone: AtomicBool,
    far: Mutex<Far>,
    remarks: Mutex<Vec<String>>,
}

/// How far a work is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Far {
    /// What is being done.
    pub(crate) doing: &'static str,
    /// How many parts of it are done.
    pub(crate) done: usize,
    /// Of how many, where that is known.
    pub(crate) total: Option<usize>,
}

impl Client {
    /// Somebody who waits in line.
    pub(crate) fn waiting() -> Self {
        Self {
            is_gone: AtomicBool::new(false),
            far: Mutex::new(Far { doing: "waiting", done: 0, total: None }),
            remarks: Mutex::default(),
        }
    }

    /// Nobody waits any longer.
    pub(crate) fn leaves(&self) {
        self.is_gone.store(true, Ordering::Relaxed);
    }

    /// The next thing is done.
    pub(crate) fn begins(&self, doing: &'static str) {
        *locked(&self.far) = Far { doing, done: 0, total: None };
    }

    /// How far it is.
    pub(crate) fn far(&self) -> Far {
        *locked(&self.far)
    }

    /// Says something beside the answer.
    pub(crate) fn remark(&self, text: &str) {
        locked(&self.remarks).push(text.into());
    }

    /// What was said.
    pub(crate) fn remarks(&self) -> Vec<String> {
        locked(&self.remarks).clone()
    }
}

impl Waiting for Client {
    fn is_wanted(&self) -> bool {
        !self.is_gone.load(Ordering::Relaxed)
    }

    fn progress(&self, done: usize, total: Option<usize>) {
        let mut far = locked(&self.far);
        // Parts that end at once are reported in any order; other parts begin anew.
        let done = if far.total == total { far.done.max(done) } else { done };
        *far = Far { done: total.map_or(done, |total| done.min(total)), total, ..*far };
    }
}

/// What is kept is whole after every step, whoever panicked.
fn locked<T>(kept: &Mutex<T>) -> MutexGuard<'_, T> {
    kept.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A verb does several works one after the other, each of parts of its own.
    #[test]
    fn no_more_is_done_than_there_is_to_do_and_the_next_work_begins_anew() {
        let client = Client::waiting();
        client.begins("milling");
        for (reported, far) in [
            ((3, Some(9)), (3, Some(9))),
            ((2, Some(9)), (3, Some(9))),
            ((9, Some(9)), (9, Some(9))),
            ((1, Some(4)), (1, Some(4))),
            ((7, None), (7, None)),
            ((8, None), (8, None)),
            ((2, Some(5)), (2, Some(5))),
        ] {
            client.progress(reported.0, reported.1);
            let Far { done, total, doing } = client.far();
            assert_eq!(((done, total), doing), (far, "milling"));
        }
    }
}
