//! What the program and its server do, as those who type and those who send see it.

// One program for all of them: each would link the library once more.
mod catalogue;
mod chatter;
mod chatter_path;
mod compare;
mod habits;
#[cfg(unix)]
mod hostile;
mod identify;
mod import;
mod job;
#[cfg(unix)]
mod large_maps;
mod measure;
mod modes;
mod part;
mod path_ranking;
mod paths;
mod program;
mod readme;
mod recorded;
mod report;
mod serve;
mod verdicts;
mod verify;
mod written;
