//! What the library promises, held against brute force, identities, other programs and published numbers.

// One program for all of them: each would link the library once more.
mod advice;
mod architecture;
mod bad_input;
mod bad_masses;
mod bad_measurements;
mod bodies;
mod calibrate;
mod chain;
mod chatter;
mod chatter_measured;
mod chatter_path;
mod chatter_verdict;
mod directional;
mod feeds;
mod found_apt;
mod found_programs;
mod fuzz_seeds;
mod identify;
mod identify_models;
mod import;
mod import_masses;
mod links;
mod linuxcnc;
mod made;
mod margins;
mod measure;
mod modes;
mod narrow_limits;
mod not_of_the_plane;
mod odd_questions;
mod other_programs;
mod part;
mod placement_brute_force;
mod programs;
mod properties;
mod published_numbers;
mod questions;
mod rewritten;
mod robot_conventions;
mod round_trips;
mod spatial;
mod spatial_placement_brute_force;
mod study;
mod toolpath_files;
mod true_arm;
mod verify;
mod written;

/// How many cases brute force tries: as many as usual, or `STIFFARM_CASES` times that.
pub(crate) fn cases(usual: u64) -> u64 {
    usual * std::env::var("STIFFARM_CASES").map_or(1, |times| times.parse().expect("how many times the usual cases"))
}
