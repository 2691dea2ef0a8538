//! `stiffarm paper`: every table and figure of the paper under its number, each by the command that makes it alone.

use std::fs;

use stiffarm::ledger::{Printed, validate};
use stiffarm_ask::paper::{self, NOT_MADE};

use crate::args::PaperArgs;
use crate::common::Common;
use crate::failure::Failure;
use crate::look::say;
use crate::output::write_text;
use crate::progress::progress;

pub(crate) fn run(args: &PaperArgs, common: &Common) -> Result<(), Failure> {
    let [folder] = common.output.as_slice() else {
        return Err(Failure::usage("paper writes a folder: give one with -o DIR"));
    };
    let made = |error| Failure::Write { path: folder.clone(), error };
    fs::create_dir_all(folder).map_err(made)?;
    let (tables, items) = (paper::tables(&validate(&Printed::PAPER)?), paper::items(args.pictures.name()));
    let index = ("index.md".to_owned(), paper::index(&tables, &items));
    let texts: Vec<_> = paper::arms().into_iter().chain(tables.into_iter().flat_map(|table| table.texts)).collect();
    for (file, text) in texts.iter().chain([&index]) {
        write_text(&folder.join(file), text)?;
    }
    let further: Vec<(&str, String)> = args.width_mm.iter().map(|width| ("width-mm", width.to_string())).collect();
    let bar = progress(items.len(), "drawing", common);
    for item in &items {
        let common = Common { output: vec![folder.join(&item.file)], quiet: true, ..common.bare() };
        super::asked(&item.asked(folder, &further)?, &common)?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    if !common.quiet {
        let files = items.len() + texts.len() + 1;
        say(&format!("wrote {files} files; {} says which is which", folder.join("index.md").display()));
        for (number, why) in NOT_MADE {
            say(&format!("{number} is not made: {why}"));
        }
    }
    Ok(())
}
