//! Python waits for long work: Ctrl-C stops it, and a callable is given how far it is.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use pyo3::prelude::*;
use rayon::ThreadPool;
use stiffarm::watch::{Waiting, Watch};

/// How often signals are looked for, and a callable is called.
const EVERY: Duration = Duration::from_millis(100);

/// What is called with how much is done, and of how much or None; or nothing.
pub(crate) type Progress = Option<Py<PyAny>>;

/// What the work tells from its threads, for the thread that called to pass on.
struct Progressed {
    done: AtomicUsize,
    /// 0 where it is not known.
    total: AtomicUsize,
    is_stopped: AtomicBool,
}

impl Progressed {
    fn new() -> Self {
        Self { done: AtomicUsize::new(0), total: AtomicUsize::new(0), is_stopped: AtomicBool::new(false) }
    }

    fn take(&self, done: usize, total: Option<usize>) {
        self.done.fetch_max(done, Ordering::Relaxed);
        self.total.store(total.unwrap_or(0), Ordering::Relaxed);
    }

    /// Runs the handlers of signals that have come, and calls the callable, once there is something to report or nothing more to
    /// come; an exception stops the work.
    fn pass_on(&self, py: Python, progress: &Progress, is_last: bool) -> PyResult<()> {
        let passed = py.check_signals().and_then(|()| {
            let (done, total) = (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed));
            let Some(progress) = progress.as_ref().filter(|_| is_last || 0 < done) else { return Ok(()) };
            progress.call1(py, (done, (total != 0).then_some(total))).map(drop)
        });
        if passed.is_err() {
            self.is_stopped.store(true, Ordering::Relaxed);
        }
        passed
    }
}

impl Waiting for Progressed {
    fn is_wanted(&self) -> bool {
        !self.is_stopped.load(Ordering::Relaxed)
    }

    fn progress(&self, done: usize, total: Option<usize>) {
        self.take(done, total);
    }
}

/// Runs work on the threads of a pool, while the thread that calls waits and passes on its progress.
pub(crate) fn on_pool<T: Send>(
    py: Python,
    pool: &ThreadPool,
    progress: &Progress,
    work: impl FnOnce(Watch) -> T + Send,
) -> PyResult<T> {
    let progressed = &Progressed::new();
    let (sender, receiver) = channel();
    let waited = py.detach(move || {
        pool.in_place_scope(|scope| {
            scope.spawn(move |_| {
                // Whoever waits is there until the scope ends.
                let _ = sender.send(work(Watch::of(progressed)));
            });
            let mut passed = Ok(());
            loop {
                match receiver.recv_timeout(EVERY) {
                    Ok(found) => break passed.map(|()| Some(found)),
                    // The work has panicked, and so will the end of the scope.
                    Err(RecvTimeoutError::Disconnected) => break passed.map(|()| None),
                    Err(RecvTimeoutError::Timeout) => {
                        if passed.is_ok() {
                            passed = Python::attach(|py| progressed.pass_on(py, progress, false));
                        }
                    }
                }
            }
        })
    })?;
    progressed.pass_on(py, progress, true)?;
    Ok(waited.expect("a panic has ended the scope"))
}

/// Work on the thread that calls: it looks about itself, from time to time.
struct Alone<'a> {
    progressed: Progressed,
    progress: &'a Progress,
    /// When it last did, and the exception that has stopped the work.
    looked: Mutex<(Instant, Option<PyErr>)>,
}

impl Waiting for Alone<'_> {
    fn is_wanted(&self) -> bool {
        if !self.progressed.is_wanted() {
            return false;
        }
        // Only one thread comes here; where another holds the lock, it looks.
        let Ok(mut looked) = self.looked.try_lock() else { return true };
        if looked.0.elapsed() < EVERY {
            return true;
        }
        let passed = Python::attach(|py| self.progressed.pass_on(py, self.progress, false));
        *looked = (Instant::now(), passed.err());
        looked.1.is_none()
    }

    fn progress(&self, done: usize, total: Option<usize>) {
        self.progressed.take(done, total);
    }
}

/// Runs work on the thread that calls, in a pool of its own.
pub(crate) fn alone<T: Send>(
    py: Python,
    progress: &Progress,
    run: impl FnOnce(Watch) -> PyResult<T> + Send,
) -> PyResult<T> {
    let alone = Alone { progressed: Progressed::new(), progress, looked: Mutex::new((Instant::now(), None)) };
    let found = py.detach(|| run(Watch::of(&alone)));
    match alone.looked.into_inner().unwrap_or_else(PoisonError::into_inner).1 {
        Some(exception) => Err(exception),
        None => alone.progressed.pass_on(py, progress, true).and(found),
    }
}
