//! The page and its parts, as they came with the program.

use std::hash::{DefaultHasher, Hash, Hasher};

use hyper::header::{CACHE_CONTROL, CONTENT_SECURITY_POLICY, ETAG, HeaderValue, IF_NONE_MATCH};
use hyper::{HeaderMap, StatusCode};
use include_dir::{Dir, include_dir};

use super::reply::{Refused, Reply, reply};

static PAGE: Dir = include_dir!("$CARGO_MANIFEST_DIR/page");

/// What the page may do: its own scripts, what it draws itself, questions to its own server, and views in frames.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; \
                      connect-src 'self'; frame-src 'self'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'";

/// The kind of every ending that a part may have.
const KINDS: [(&str, &str); 7] = [
    ("html", "text/html; charset=utf-8"),
    ("css", "text/css; charset=utf-8"),
    ("js", "text/javascript; charset=utf-8"),
    ("svg", "image/svg+xml"),
    ("png", "image/png"),
    ("json", "application/json"),
    ("woff2", "font/woff2"),
];

/// The page at `/`, and its parts under `/assets/`.
pub(super) fn part(path: &str, headers: &HeaderMap) -> Result<Reply, Refused> {
    let name = if path == "/" { "index.html" } else { path.strip_prefix("/assets/").ok_or_else(Refused::nowhere)? };
    let file = PAGE.get_file(name).ok_or_else(Refused::nowhere)?;
    let ending = name.rsplit('.').next().unwrap_or_default();
    let (_, kind) = KINDS.into_iter().find(|(known, _)| *known == ending).ok_or_else(Refused::nowhere)?;
    let mut hasher = DefaultHasher::new();
    file.contents().hash(&mut hasher);
    let tag = format!("\"{:016x}\"", hasher.finish());
    let is_known = headers.get(IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == tag.as_bytes());
    let mut response = reply(if is_known { &[] } else { file.contents() }, kind);
    if is_known {
        *response.status_mut() = StatusCode::NOT_MODIFIED;
    }
    let headers = response.headers_mut();
    headers.insert(CACHE_CONTROL, HeaderValue::from_static("no-cache"));
    headers.insert(CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY));
    if let Ok(tag) = HeaderValue::from_str(&tag) {
        headers.insert(ETAG, tag);
    }
    Ok(response)
}
