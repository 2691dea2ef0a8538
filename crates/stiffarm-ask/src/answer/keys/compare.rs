//! Which fields do two setups have that are compared?

use super::place::shape::PLACEMENT;
use super::slots::{shapes, slots};

shapes! {
    COMPARISON: "ComparisonDict", "What `compare` answers.", &[slots![
        SETUP_A => PLACEMENT, SETUP_B => PLACEMENT, SETUP_RATIO | null, DISTINGUISHED, BETTER_SETUP | null, WIN_PROBABILITY | null,
        DIFFERENT, SUMMARY,
    ]];
}
