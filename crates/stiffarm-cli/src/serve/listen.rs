//! How are connections taken, bounded and ended?

use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::sleep;

use super::Server;
use super::route::route;

/// More connections wait until one ends.
const MOST_CONNECTIONS: usize = 256;
/// Until the head of a request is there.
const HEAD_TIME: Duration = Duration::from_secs(10);
/// Of the head of a request, bytes.
const MOST_HEAD: usize = 128 << 10;
/// Until answers that are under way are broken off when the server ends.
const LAST_ANSWERS: Duration = Duration::from_secs(5);
/// After the system gave no connection.
const PAUSE: Duration = Duration::from_millis(50);

/// Takes connections until it is told to end; then lets answers that are under way go out.
pub(super) async fn listen(listener: TcpListener, server: Arc<Server>) {
    let (connections, open) = (Arc::new(Semaphore::new(MOST_CONNECTIONS)), GracefulShutdown::new());
    let mut end = std::pin::pin!(told_to_end());
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
    let connection = open.watch(http.serve_connection(TokioIo::new(stream), service));
    tokio::spawn(async move {
        // What fails here is the other's matter: it hung up, was too slow, or spoke no HTTP, which it was told.
        let _ = connection.await;
        drop(permit);
    });
}

/// Until ctrl-C, or what systems send to end a program.
async fn told_to_end() {
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
