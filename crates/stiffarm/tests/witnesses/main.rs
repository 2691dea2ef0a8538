//! What the library promises, held against witnesses that compute for long themselves: brute force, random arms and paths, determinants
//! over the frequency. They are optimised, as the library is; the other tests compile in a quarter of the time without that.

mod chatter;
mod chatter_measured;
mod chatter_path;
mod chatter_verdict;
#[path = "../links/mod.rs"]
mod links;
mod modes;
mod placement_brute_force;
mod properties;
mod questions;
mod rewritten;
mod round_trips;
mod spatial_placement_brute_force;

/// How many cases brute force tries: as many as usual, or `STIFFARM_CASES` times that.
pub(crate) fn cases(usual: u64) -> u64 {
    usual * std::env::var("STIFFARM_CASES").map_or(1, |times| times.parse().expect("how many times the usual cases"))
}
