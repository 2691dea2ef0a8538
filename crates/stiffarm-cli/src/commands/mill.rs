//! `stiffarm mill PATH --dry`: what is understood of a toolpath.

use std::fs::File;
use std::io::{self, BufReader, Write};
use std::path::Path;

use stiffarm::answer::{PathAnswer, Rows};
use stiffarm::catalogue::files;
use stiffarm::request::Request;
use stiffarm::toolpath::{Builtin, Progress, Survey, read};

use super::progress;
use crate::args::Common;
use crate::failure::Failure;
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty};
use crate::table::shown;

/// Of the buffer through which a path is read, bytes.
const BUFFER: usize = 1 << 16;

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let path = asked.path()?;
    if !asked.is_dry() {
        return Err(Failure::Usage(
            "mill computes no error along a path yet: robot, force and roll are missing; --dry tells what is understood of the path".into(),
        ));
    }
    let outputs = Outputs::open::<PathOutput>(common, &[Path::new(&path)])?;
    outputs.deliver(&PathOutput(understood(asked, path, common)?))
}

/// Reads the path, move by move.
fn understood(asked: &Request, path: String, common: &Common) -> Result<PathAnswer, Failure> {
    let options = asked.read_options();
    let mut survey = Survey::new(asked.steps());
    if Builtin::is_meant(&path) {
        path.parse::<Builtin>()?.moves(options.feed).iter().for_each(|one| survey.add(one));
        return Ok(PathAnswer { path, understood: None, survey });
    }
    let format = asked.path_format(&path)?;
    let file: File = files::open(Path::new(&path))?;
    let length = file.metadata().map_or(0, |found| found.len());
    let bar = progress(length as usize, "reading", common);
    let shown = files::shown(Path::new(&path));
    let mut input = BufReader::with_capacity(BUFFER, file);
    let mut each = |one: &_| survey.add(one);
    let mut told = |far: Progress| {
        bar.set_position(far.bytes);
        Ok(())
    };
    let found = read(&mut input, &shown, format, &options, &mut each, &mut told);
    bar.finish_and_clear();
    Ok(PathAnswer { path, understood: Some(found?), survey })
}

struct PathOutput(PathAnswer);

impl Answer for PathOutput {
    const COMMAND: &'static str = "mill";

    fn text(&self, look: Look) -> String {
        shown(&self.0.table(), look)
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.0.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }
}
