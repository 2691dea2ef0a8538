//! Who may ask? Whoever calls the server by its own name, from no other page.
//!
//! A page of another origin may make a browser send requests here, and may have its own name lead here (DNS rebinding). The first is
//! known by `Origin` and `Sec-Fetch-Site`, the second by `Host`: such a page can only use a name, never an address.

use std::net::{Ipv4Addr, Ipv6Addr};

use hyper::header::{CONTENT_TYPE, HOST, HeaderName, ORIGIN};
use hyper::{HeaderMap, Method, StatusCode, Uri};

use super::reply::Refused;

/// Where a browser says from where a request comes.
const FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

/// Checks host and origin.
pub(super) fn admit(method: &Method, uri: &Uri, headers: &HeaderMap, own_name: &str) -> Result<(), Refused> {
    let host = one(headers, &HOST).filter(|_| headers.get_all(HOST).iter().count() == 1);
    let Some(host) = host else {
        let why = "the request names no host, or several; expected one header Host";
        return Err(Refused::new(StatusCode::BAD_REQUEST, why, "HTTP/1.1 asks for it"));
    };
    let also = uri.authority().map(hyper::http::uri::Authority::as_str);
    if let Some(foreign) = [Some(host), also].into_iter().flatten().find(|host| !is_own(host, own_name)) {
        let why = format!("this server is not called {}", stiffarm::plain::on_one_line(foreign));
        let hint = "it is called localhost, by its address, or by the name given with --host";
        return Err(Refused::new(StatusCode::FORBIDDEN, why, hint));
    }
    // The page itself may be opened from anywhere; what computes is asked from nowhere else.
    let is_page = uri.path() == "/" || uri.path().starts_with("/assets/");
    if is_page && matches!(*method, Method::GET | Method::HEAD) {
        return Ok(());
    }
    let own_origin = format!("http://{host}");
    let is_foreign =
        headers.get_all(ORIGIN).iter().any(|origin| !origin.as_bytes().eq_ignore_ascii_case(own_origin.as_bytes()));
    let is_cross = one(headers, &FETCH_SITE).is_some_and(|site| !matches!(site, "same-origin" | "none"));
    if is_foreign || is_cross {
        let why = "this question comes from a page of another origin";
        return Err(Refused::new(StatusCode::FORBIDDEN, why, "ask from the server's own page, or from no page at all"));
    }
    Ok(())
}

/// Checks that a question is written as JSON.
pub(super) fn is_json(headers: &HeaderMap) -> Result<(), Refused> {
    let essence = one(headers, &CONTENT_TYPE).and_then(|kind| kind.split(';').next()).unwrap_or_default();
    if essence.trim().eq_ignore_ascii_case("application/json") {
        return Ok(());
    }
    let hint = "send the question as JSON, with the header Content-Type: application/json";
    Err(Refused::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, "the question is not sent as application/json", hint))
}

fn one<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<&'a str> {
    headers.get(name).and_then(|value| value.to_str().ok())
}

/// Is this host, with or without a port, an address, `localhost`, or the name that was given? A page that leads its own name here can use none.
fn is_own(host: &str, own_name: &str) -> bool {
    if let Some(rest) = host.strip_prefix('[') {
        let Some((address, port)) = rest.split_once(']') else { return false };
        return address.parse::<Ipv6Addr>().is_ok() && (port.is_empty() || port.strip_prefix(':').is_some_and(is_port));
    }
    let (name, port) = host.split_once(':').map_or((host, None), |(name, port)| (name, Some(port)));
    let is_known = name.eq_ignore_ascii_case("localhost")
        || name.eq_ignore_ascii_case(own_name)
        || name.parse::<Ipv4Addr>().is_ok();
    is_known && !name.is_empty() && port.is_none_or(is_port)
}

fn is_port(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_digit()) && text.parse::<u16>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_server_is_called_by_its_address_or_its_name_and_by_nothing_that_ends_or_begins_like_it() {
        for host in ["127.0.0.1:80", "localhost", "LOCALHOST:8080", "[::1]:9", "[::1]", "10.0.0.7:1", "robots.plant:80"]
        {
            assert!(is_own(host, "robots.plant"), "{host}");
        }
        let foreign = [
            "evil.example",
            "localhost.evil.example",
            "127.0.0.1.evil.example",
            "evil.example:80",
            "",
            ":80",
            "localhost:",
            "localhost:x",
            "localhost:80:80",
            "[::1",
            "[evil]",
            "[::1]x",
            "0x7f.1",
            "127.1",
            "user@localhost",
            "localhost:+80",
        ];
        for host in foreign {
            assert!(!is_own(host, "robots.plant"), "{host}");
        }
    }
}
