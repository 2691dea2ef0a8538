//! `stiffarm completions`, `stiffarm man`: what a shell and a reader of manuals know of the program.

use std::fs;
use std::path::Path;

use clap_complete::Shell;
use clap_mangen::{Man, generate_to};

use crate::args::command_without_hidden;
use crate::common::Common;
use crate::failure::Failure;
use crate::look::say;
use crate::output::print_text;

/// The script that lets a shell complete commands and options.
pub(crate) fn completions(shell: Shell) -> Vec<u8> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut command_without_hidden(), "stiffarm", &mut script);
    script
}

/// The program's own page, or a page for every command in a folder.
pub(crate) fn man(folder: Option<&Path>, common: &Common) -> Result<(), Failure> {
    let command = command_without_hidden();
    let Some(folder) = folder else {
        let mut page = Vec::new();
        Man::new(command).render(&mut page).map_err(Failure::Stdout)?;
        return print_text(&page);
    };
    let failure = |error| Failure::Write { path: folder.into(), error };
    fs::create_dir_all(folder).map_err(failure)?;
    generate_to(command, folder).map_err(failure)?;
    if !common.quiet {
        say(&format!("wrote the pages of every command to {}", folder.display()));
    }
    Ok(())
}
