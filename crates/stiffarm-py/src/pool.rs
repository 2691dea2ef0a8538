//! The threads on which long calls run.

use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::refused;

/// The process that made the pool, the number of threads asked for (0: all cores), and the pool once it is needed.
///
/// A forked process has the memory of its parent but not its threads: it makes a pool of its own.
static POOL: Mutex<(u32, usize, Option<Arc<ThreadPool>>)> = Mutex::new((0, 0, None));

fn pool() -> PyResult<Arc<ThreadPool>> {
    let mut guard = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let (process, threads, made) = &mut *guard;
    let here = std::process::id();
    if *process != here {
        // Dropping the parent's pool would wait for threads that are not here.
        std::mem::forget(made.take());
        *process = here;
    }
    if let Some(pool) = made {
        return Ok(pool.clone());
    }
    let pool = Arc::new(ThreadPoolBuilder::new().num_threads(*threads).build().map_err(refused)?);
    *made = Some(pool.clone());
    Ok(pool)
}

/// Runs the library without the interpreter's lock.
pub(crate) fn detached<T: Send>(py: Python, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    // Fetched under the interpreter's lock, so that no fork comes upon a locked pool.
    let pool = pool()?;
    Ok(py.detach(|| pool.install(work)))
}

/// Sets the number of threads of all further calls.
#[pyfunction]
#[pyo3(signature = (threads))]
pub(crate) fn set_threads(threads: Option<usize>) -> PyResult<()> {
    let threads = match threads {
        None => 0,
        Some(threads @ 1..=1024) => threads,
        Some(threads) => return Err(refused(format!("{threads} threads; expected 1 to 1024, or None for all cores"))),
    };
    // Made first, so that a fork is noticed; a pool that still works goes when its last call ends.
    drop(pool()?);
    let mut guard = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    guard.1 = threads;
    guard.2 = None;
    Ok(())
}
