//! Somebody who asks from elsewhere: is the work still wanted, how far is it, and what was said beside the answer?

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use stiffarm::watch::Waiting;

/// Not known.
const UNKNOWN: usize = usize::MAX;

/// Who waits for one answer.
#[derive(Debug)]
pub(crate) struct Client {
    is_gone: AtomicBool,
    doing: Mutex<&'static str>,
    done: AtomicUsize,
    total: AtomicUsize,
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
            doing: Mutex::new("waiting"),
            done: AtomicUsize::new(0),
            total: AtomicUsize::new(UNKNOWN),
            remarks: Mutex::default(),
        }
    }

    /// Nobody waits any longer.
    pub(crate) fn leaves(&self) {
        self.is_gone.store(true, Ordering::Relaxed);
    }

    /// The next thing is done.
    pub(crate) fn begins(&self, doing: &'static str) {
        let mut known = locked(&self.doing);
        self.done.store(0, Ordering::Relaxed);
        self.total.store(UNKNOWN, Ordering::Relaxed);
        *known = doing;
    }

    /// How far it is.
    pub(crate) fn far(&self) -> Far {
        let doing = *locked(&self.doing);
        let total = Some(self.total.load(Ordering::Relaxed)).filter(|total| *total != UNKNOWN);
        Far { doing, done: self.done.load(Ordering::Relaxed), total }
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

    fn told(&self, done: usize, total: Option<usize>) {
        self.total.store(total.unwrap_or(UNKNOWN), Ordering::Relaxed);
        self.done.fetch_max(done, Ordering::Relaxed);
    }
}

/// What is kept is whole after every step, whoever panicked.
fn locked<T>(kept: &Mutex<T>) -> MutexGuard<'_, T> {
    kept.lock().unwrap_or_else(PoisonError::into_inner)
}
