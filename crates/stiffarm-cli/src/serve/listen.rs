//! How are connections taken, bounded and ended?

use std::convert::Infallible;
use std::pin::Pin;
use std::sync::Arc;
use std::time::Duration;

use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::sleep;
use tokio_io_timeout::TimeoutStream;

use super::Server;
use super::route::route;

/// More connections wait until one ends.
const MOST_CONNECTIONS: usize = 256;
/// Until the head of a request is there.
const HEAD_TIME: Duration = Duration::from_secs(10);
/// Until whoever asked takes more of an answer.
const TAKING_TIME: Duration = Duration::from_secs(30);
/// Of the head of a request, bytes.
const MOST_HEAD: usize = 128 << 10;
/// Until answers that are under way are broken off when the server ends.
const LAST_ANSWERS: Duration = Duration::from_secs(5);
/// After the system gave no connection.
const PAUSE: Duration = Duration::from_millis(50);

/// Takes connections until it is asked to end; then lets answers that are under way go out.
pub(super) async fn listen(listener: TcpListener, server: Arc<Server>) {
    let (connections, open) = (Arc::new(Semaphore::new(MOST_CONNECTIONS)), GracefulShutdown::new());
    let mut end = std::pin::pin!(asked_to_end());
    loop {
        tokio::select! {
            () = &mut end => break,
            (stream, permit) = next(&listener, &connections) => connect(stream, permit, &server, &open),
        }
    }
    drop(listener);
    tokio::select! {
        () = open.shutdown() => {}
        () = sleep(LAST_ANSWERS) => {}
    }
}

/// The next connection, once there is room for it.
async fn next(listener: &TcpListener, connections: &Arc<Semaphore>) -> (TcpStream, OwnedSemaphorePermit) {
    let permit = Arc::clone(connections).acquire_owned().await.expect("it is never closed");
    loop {
        match listener.accept().await {
            Ok((stream, _)) => return (stream, permit),
            // The other has gone again, or the system has no room; both pass.
            Err(_) => sleep(PAUSE).await,
        }
    }
}

/// Speaks HTTP on a connection, in a task of its own.
fn connect(stream: TcpStream, permit: OwnedSemaphorePermit, server: &Arc<Server>, open: &GracefulShutdown) {
    // Small answers go out at once; where the system cannot do that they go out later.
    let _ = stream.set_nodelay(true);
    let server = Arc::clone(server);
    let service = service_fn(move |request| {
        let server = Arc::clone(&server);
        async move { Ok::<_, Infallible>(route(&server, request).await) }
    });
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(HEAD_TIME).max_buf_size(MOST_HEAD);
    let connection = open.watch(http.serve_connection(TokioIo::new(patient(stream, TAKING_TIME)), service));
    tokio::spawn(async move {
        // What fails here is the other's matter: it hung up, was too slow, or spoke no HTTP, which the reply said.
        let _ = connection.await;
        drop(permit);
    });
}

/// A connection that breaks when nothing more is taken of what is written to it.
fn patient(stream: TcpStream, time: Duration) -> Pin<Box<TimeoutStream<TcpStream>>> {
    let mut stream = TimeoutStream::new(stream);
    stream.set_write_timeout(Some(time));
    Box::pin(stream)
}

/// Until ctrl-C, or what systems send to end a program.
async fn asked_to_end() {
    let interrupted = async {
        // Without signals the program ends as every other does.
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    };
    #[cfg(unix)]
    {
        use tokio::signal::unix::{SignalKind, signal};
        if let Ok(mut terminated) = signal(SignalKind::terminate()) {
            tokio::select! {
                () = interrupted => {}
                _ = terminated.recv() => {}
            }
            return;
        }
    }
    interrupted.await;
}

#[cfg(test)]
mod tests {
    use std::future::poll_fn;
    use std::io::ErrorKind;

    use tokio::io::AsyncWrite;
    use tokio::runtime::Builder;

    use super::*;

    /// More than the system keeps between two ends is written to one who reads nothing.
    #[test]
    fn who_takes_nothing_of_an_answer_is_not_waited_for() {
        let runtime = Builder::new_current_thread().enable_all().build().unwrap();
        let failed = runtime.block_on(async {
            let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
            let idle = TcpStream::connect(listener.local_addr().unwrap()).await.unwrap();
            let (stream, _) = listener.accept().await.unwrap();
            let mut stream = patient(stream, Duration::from_millis(50));
            let answer = vec![0; 1 << 20];
            let failed = loop {
                if let Err(failed) = poll_fn(|waker| stream.as_mut().poll_write(waker, &answer)).await {
                    break failed;
                }
            };
            drop(idle);
            failed
        });
        assert_eq!(failed.kind(), ErrorKind::TimedOut);
    }
}
