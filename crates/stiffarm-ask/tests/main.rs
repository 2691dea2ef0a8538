//! What is asked and what is answered, held against what the library computes and what was refused.

// One program for all of them: each would link the library once more.
mod at_one_place;
mod cell;
mod distinguished;
mod measured;
mod path_places;
mod requests;
mod several_tools;
mod watch;
