//! What do programs read? The answers of the verbs as JSON, with the keys on which scripts rely.
//!
//! One file a verb, and every face calls it: a number is the same to the last bit wherever it is shown. Beside
//! [`catalogue`](crate::catalogue) and [`request`](crate::request) the only module in which mm and degrees exist.

pub mod compliance;
pub mod map;
pub mod place;
pub mod rank;
pub mod robot;
pub mod spatial;
pub mod study;

use serde_json::{Map, Value};

/// Keys in the order in which they are told.
type Object = Map<String, Value>;

/// Rounded for people; what rounds to zero has no sign.
pub fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| "0.".contains(c)) => rest.into(),
        _ => text,
    }
}
