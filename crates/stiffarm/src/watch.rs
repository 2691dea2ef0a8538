//! `Watch`: who waits for long work is informed how far it is, and says whether it goes on.
//!
//! Work that is stopped has no answer: every verb then ends with [`Stopped`], and nothing of what was begun is reported.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Somebody who waits for long work.
pub trait Waiting: Sync {
    /// Whether the work is still wanted. Asked at least some times a second, from any thread and often many thousand times: cheap. Once it
    /// is not, it stays so.
    fn is_wanted(&self) -> bool;

    /// How much of the work is done, in parts of about the same size, and how many there are, where that is known beforehand. From any
    /// thread; of parts that end at once the order is not kept.
    fn progress(&self, done: usize, total: Option<usize>);
}

/// The work is no longer wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("stopped before there was an answer")]
pub struct Stopped;

/// What long work knows of who waits for it; handed down as it is.
#[derive(Clone, Copy, Default)]
pub struct Watch<'a> {
    waiting: Option<&'a dyn Waiting>,
    is_part: bool,
}

impl<'a> Watch<'a> {
    /// Nobody is informed, and the work goes on to its end.
    pub const fn nobody() -> Self {
        Self { waiting: None, is_part: false }
    }

    /// Informed and asked.
    pub fn of(waiting: &'a dyn Waiting) -> Self {
        Self { waiting: Some(waiting), is_part: false }
    }

    /// The same for one part of a work that tells its parts: it may be stopped, and tells nothing of its own.
    #[must_use]
    pub fn of_part(self) -> Self {
        Self { is_part: true, ..self }
    }

    /// Asked between any two steps.
    ///
    /// # Errors
    /// Where the work is no longer wanted.
    pub fn go_on(self) -> Result<(), Stopped> {
        match self.waiting {
            Some(waiting) if !waiting.is_wanted() => Err(Stopped),
            _ => Ok(()),
        }
    }

    /// Work of so many parts, where that is known.
    pub fn parts(self, total: Option<usize>) -> Parts<'a> {
        Parts { watch: self, done: AtomicUsize::new(0), total }
    }
}

impl std::fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(if self.waiting.is_some() { "Watch::of(..)" } else { "Watch::nobody()" })
    }
}

/// The parts of a work as they are done, on any thread.
#[derive(Debug)]
pub struct Parts<'a> {
    watch: Watch<'a>,
    done: AtomicUsize,
    total: Option<usize>,
}

impl Parts<'_> {
    /// As [`Watch::go_on`].
    ///
    /// # Errors
    /// Where the work is no longer wanted.
    pub fn go_on(&self) -> Result<(), Stopped> {
        self.watch.go_on()
    }

    /// One more is done; asks, too, whether to go on.
    ///
    /// # Errors
    /// Where the work is no longer wanted.
    pub fn one_more(&self) -> Result<(), Stopped> {
        self.watch.go_on()?;
        if let Some(waiting) = self.watch.waiting.filter(|_| !self.watch.is_part) {
            waiting.progress(self.done.fetch_add(1, Ordering::Relaxed) + 1, self.total);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    /// Wants so many parts, and keeps what is reported to it.
    struct Wants(usize, Mutex<Vec<(usize, Option<usize>)>>);

    impl Waiting for Wants {
        fn is_wanted(&self) -> bool {
            self.1.lock().unwrap().len() < self.0
        }

        fn progress(&self, done: usize, total: Option<usize>) {
            self.1.lock().unwrap().push((done, total));
        }
    }

    #[test]
    fn parts_are_counted_and_reported_until_no_more_are_wanted() {
        let waiting = Wants(3, Mutex::default());
        let watch = Watch::of(&waiting);
        let parts = watch.parts(Some(7));
        let done: Vec<Result<(), Stopped>> = (0..5).map(|_| parts.one_more()).collect();
        assert_eq!(done, [Ok(()), Ok(()), Ok(()), Err(Stopped), Err(Stopped)]);
        assert_eq!(*waiting.1.lock().unwrap(), [(1, Some(7)), (2, Some(7)), (3, Some(7))]);
        assert_eq!(watch.go_on(), Err(Stopped));
        assert_eq!(watch.of_part().go_on(), Err(Stopped));
    }

    #[test]
    fn a_part_tells_nothing_and_nobody_stops_nothing() {
        let waiting = Wants(1, Mutex::default());
        let parts = Watch::of(&waiting).of_part().parts(None);
        assert!((0..9).all(|_| parts.one_more() == Ok(())));
        assert!(waiting.1.lock().unwrap().is_empty());
        assert!((0..9).all(|_| Watch::nobody().parts(None).one_more() == Ok(())));
    }
}
