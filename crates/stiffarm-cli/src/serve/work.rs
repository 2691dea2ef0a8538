//! Who computes, and who waits for it? As many questions at once as there are cores, some that wait in line, and no more.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use hyper::StatusCode;
use rayon::{ThreadPool, ThreadPoolBuilder};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task;
use tokio::time::timeout;

use super::Server;
use super::reply::Refused;
use crate::STACK;
use crate::client::Client;

/// For each that works so many may wait, and at least as many as a browser asks at once.
const WAITING: usize = 4;
const LEAST_WAITING: usize = 8;
/// Of one question; more share the cores anyway.
const MOST_THREADS: usize = 16;

/// How long somebody may wait: long questions have a line and workers of their own, so that short ones get to theirs however many there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Patience {
    /// Until the time limit.
    Short,
    /// As long as it takes.
    Long,
}

/// Those that wait and those that work.
#[derive(Debug)]
struct Lane {
    /// Places of both.
    line: Arc<Semaphore>,
    /// Places of those that work.
    workers: Arc<Semaphore>,
}

/// Where answers are computed.
#[derive(Debug)]
pub(super) struct Workshop {
    short: Lane,
    long: Lane,
    /// Threads that nobody uses; each question has some of its own, so that a long one leaves the others their share.
    idle: Mutex<Vec<ThreadPool>>,
    threads: usize,
}

/// A place in the line, which is free again when it is dropped.
#[derive(Debug)]
pub(super) struct Place {
    #[expect(dead_code, reason = "held")]
    permit: OwnedSemaphorePermit,
    workers: Arc<Semaphore>,
}

/// Whoever holds this waits; once it is dropped nobody does.
#[derive(Debug)]
pub(super) struct Waits(pub(super) Arc<Client>);

impl Drop for Waits {
    fn drop(&mut self) {
        self.0.leaves();
    }
}

impl Workshop {
    /// With so many workers of either kind, or one for each core.
    pub(super) fn new(threads: Option<usize>) -> Self {
        let cores = threads.unwrap_or_else(|| thread::available_parallelism().map_or(1, usize::from));
        let lane = || Lane {
            line: Arc::new(Semaphore::new(cores + (WAITING * cores).max(LEAST_WAITING))),
            workers: Arc::new(Semaphore::new(cores)),
        };
        Self { short: lane(), long: lane(), idle: Mutex::default(), threads: cores.min(MOST_THREADS) }
    }

    /// A place in the line, where there is one.
    pub(super) fn line_up(&self, patience: Patience) -> Result<Place, Refused> {
        let lane = match patience {
            Patience::Short => &self.short,
            Patience::Long => &self.long,
        };
        let full = |_| {
            let why = "the server computes as much as it can, and as many questions wait as may";
            Refused::new(StatusCode::SERVICE_UNAVAILABLE, why, "ask again in a moment")
        };
        let permit = Arc::clone(&lane.line).try_acquire_owned().map_err(full)?;
        Ok(Place { permit, workers: Arc::clone(&lane.workers) })
    }

    /// Waits for a worker, and computes there. Whoever drops this leaves the line, and keeps the worker only until the work notices.
    pub(super) async fn work<T: Send + 'static>(
        self: &Arc<Self>,
        place: Place,
        client: Arc<Client>,
        work: impl FnOnce(Arc<Client>) -> Result<T, Refused> + Send + 'static,
    ) -> Result<T, Refused> {
        let _waits = Waits(Arc::clone(&client));
        let ending = |_| Refused::new(StatusCode::SERVICE_UNAVAILABLE, "the server is ending", "start it again");
        let worker = Arc::clone(&place.workers).acquire_owned().await.map_err(ending)?;
        let shop = Arc::clone(self);
        let computed = task::spawn_blocking(move || {
            let _held = (place, worker);
            let pool = shop.pool()?;
            let found = catch_unwind(AssertUnwindSafe(|| pool.install(|| work(client))));
            shop.idle.lock().unwrap_or_else(PoisonError::into_inner).push(pool);
            found.unwrap_or_else(|panic| Err(broken(&*panic)))
        });
        computed.await.unwrap_or_else(|error| Err(broken(&error.to_string())))
    }

    /// Threads for one question.
    fn pool(&self) -> Result<ThreadPool, Refused> {
        if let Some(pool) = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop() {
            return Ok(pool);
        }
        let none = |error| {
            let why = format!("the system gives no threads: {error}");
            Refused::new(StatusCode::SERVICE_UNAVAILABLE, why, "ask again in a moment")
        };
        ThreadPoolBuilder::new().num_threads(self.threads).stack_size(STACK).build().map_err(none)
    }
}

/// Reads what was sent beside the threads that speak HTTP: megabytes of it take a while.
pub(super) async fn aside<T: Send + 'static>(
    read: impl FnOnce() -> Result<T, Refused> + Send + 'static,
) -> Result<T, Refused> {
    let found = task::spawn_blocking(move || catch_unwind(AssertUnwindSafe(read)));
    match found.await {
        Ok(Ok(found)) => found,
        Ok(Err(panic)) => Err(broken(&*panic)),
        Err(error) => Err(broken(&error.to_string())),
    }
}

/// A fault of the program: the question has no answer, and the server goes on.
fn broken(panic: &(dyn Any + Send)) -> Refused {
    let said = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    let why = format!("the program broke: {}", stiffarm::plain::on_one_line(said.unwrap_or("it does not say why")));
    Refused::new(
        StatusCode::INTERNAL_SERVER_ERROR,
        why,
        "this is a fault of the program, please report it with the question",
    )
}

/// Computes something in the time that every question has; with what was said beside it.
pub(super) async fn computed(
    server: &Arc<Server>,
    work: impl FnOnce(Arc<Client>) -> Result<Vec<u8>, Refused> + Send + 'static,
) -> Result<(Vec<u8>, Vec<String>), Refused> {
    within(server, None, work).await
}

/// The same for somebody who waits so long; who hangs up before stops the work.
pub(super) async fn within(
    server: &Arc<Server>,
    wait: Option<Duration>,
    work: impl FnOnce(Arc<Client>) -> Result<Vec<u8>, Refused> + Send + 'static,
) -> Result<(Vec<u8>, Vec<String>), Refused> {
    let client = Arc::new(Client::waiting());
    let place = server.workshop.line_up(if wait.is_some() { Patience::Long } else { Patience::Short })?;
    let limit = wait.unwrap_or(server.time_limit);
    let late = |_| {
        let why = format!("there was no answer after {} s", limit.as_secs());
        let hint = "ask with Accept: application/x-ndjson: then it may take as long as somebody waits, and tells how far it is; or with Prefer: wait=SECONDS";
        Refused::new(StatusCode::GATEWAY_TIMEOUT, why, hint)
    };
    let found = timeout(limit, server.workshop.work(place, Arc::clone(&client), work)).await;
    Ok((found.map_err(late)??, client.remarks()))
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use stiffarm::watch::Waiting;
    use tokio::runtime::Runtime;

    use super::*;

    fn client() -> Arc<Client> {
        Arc::new(Client::waiting())
    }

    #[test]
    fn a_panic_is_a_refusal_and_its_bench_is_free_again() {
        let shop = Arc::new(Workshop::new(Some(1)));
        Runtime::new().unwrap().block_on(async {
            for _ in 0..3 {
                let place = shop.line_up(Patience::Short).unwrap();
                let refused = shop.work::<()>(place, client(), |_| panic!("on purpose")).await.unwrap_err();
                assert_eq!(refused.status, StatusCode::INTERNAL_SERVER_ERROR);
                assert!(refused.json()["error"].as_str().unwrap().ends_with("on purpose"));
            }
            assert_eq!(shop.work(shop.line_up(Patience::Short).unwrap(), client(), |_| Ok(7)).await, Ok(7));
        });
    }

    #[test]
    fn who_leaves_stops_the_work_and_who_comes_to_a_full_line_is_sent_away() {
        let shop = Arc::new(Workshop::new(Some(1)));
        Runtime::new().unwrap().block_on(async {
            let (begun, begins) = mpsc::channel();
            let (ended, ends) = mpsc::channel();
            let until_left = move |client: Arc<Client>| {
                begun.send(()).unwrap();
                while client.is_wanted() {
                    thread::yield_now();
                }
                ended.send(()).unwrap();
                Ok(())
            };
            let working = tokio::spawn({
                let (shop, place) = (Arc::clone(&shop), shop.line_up(Patience::Short).unwrap());
                async move { shop.work(place, client(), until_left).await }
            });
            begins.recv().unwrap();
            let waiting: Vec<Place> = (0..LEAST_WAITING).map(|_| shop.line_up(Patience::Short).unwrap()).collect();
            assert_eq!(shop.line_up(Patience::Short).unwrap_err().status, StatusCode::SERVICE_UNAVAILABLE);
            let long = shop.line_up(Patience::Long).unwrap();
            assert_eq!(shop.work(long, client(), |_| Ok(3)).await, Ok(3), "the others have workers of their own");
            drop(waiting);
            working.abort();
            ends.recv().unwrap();
            assert_eq!(shop.work(shop.line_up(Patience::Short).unwrap(), client(), |_| Ok(1)).await, Ok(1));
        });
    }
}
