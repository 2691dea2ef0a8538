//! The threads on which long calls run.

use std::cell::OnceCell;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use stiffarm::watch::Watch;

use crate::numbers::kind;
use crate::refused;
use crate::waiting::{self, Progress};

/// The process that made the pool, the number of threads asked for (0: all cores), and the pool once it is needed.
///
/// A forked process has the memory of its parent but not its threads: it makes a pool of its own.
static POOL: Mutex<(u32, usize, Option<Arc<ThreadPool>>)> = Mutex::new((0, 0, None));

thread_local! {
    /// A pool of the calling thread alone, once one thread was asked for; it starts none, so a fork changes nothing.
    static ALONE: OnceCell<ThreadPool> = const { OnceCell::new() };
}

/// The pool for further calls; `None` where the calling thread does the work itself.
fn pool() -> PyResult<Option<Arc<ThreadPool>>> {
    let mut guard = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let (process, threads, made) = &mut *guard;
    let here = std::process::id();
    if *process != here {
        // Dropping the parent's pool would wait for threads that are not here.
        std::mem::forget(made.take());
        *process = here;
    }
    if *threads == 1 {
        return Ok(None);
    }
    if let Some(pool) = made {
        return Ok(Some(pool.clone()));
    }
    let pool = Arc::new(ThreadPoolBuilder::new().num_threads(*threads).build().map_err(refused)?);
    *made = Some(pool.clone());
    Ok(Some(pool))
}

/// Runs the library without the interpreter's lock. Some times a second signals are looked for, and `progress` is called; where either
/// raises an exception, the work is stopped, and that is its end.
pub(crate) fn detached<T: Send>(py: Python, progress: &Progress, work: impl FnOnce(Watch) -> T + Send) -> PyResult<T> {
    // Fetched under the interpreter's lock, so that no fork comes upon a locked pool.
    match pool()? {
        Some(pool) => waiting::on_pool(py, &pool, progress, work),
        None => waiting::alone(py, progress, |watch| alone(|| work(watch))),
    }
}

/// Runs the library on the calling thread: as many of them as call at once compute side by side.
fn alone<T: Send>(work: impl FnOnce() -> T + Send) -> PyResult<T> {
    ALONE.with(|alone| {
        let pool = if let Some(pool) = alone.get() {
            pool
        } else {
            let pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build().map_err(refused)?;
            alone.get_or_init(|| pool)
        };
        Ok(pool.install(work))
    })
}

/// Sets the number of threads of all further calls; one is the caller's own.
#[pyfunction]
#[pyo3(signature = (threads))]
pub(crate) fn set_threads(threads: &Bound<'_, PyAny>) -> PyResult<()> {
    let expected = "expected 1 to 1024, or None for all cores";
    let threads = match threads.extract::<Option<i64>>() {
        Ok(None) => 0,
        Ok(Some(threads @ 1..=1024)) => threads as usize,
        Ok(Some(threads)) => return Err(refused(format!("{threads} threads; {expected}"))),
        Err(_) => return Err(refused(format!("threads: {}; {expected}", kind(threads)))),
    };
    // Made first, so that a fork is noticed; a pool that still works goes when its last call ends.
    drop(pool()?);
    let mut guard = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    guard.1 = threads;
    guard.2 = None;
    Ok(())
}
