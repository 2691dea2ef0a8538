//! `stiffarm force`: with what force does a process push on its tool?

use std::io::{self, Write};
use std::path::Path;

use stiffarm::catalogue::files;
use stiffarm_ask::answer::{CuttingAnswer, Rows};
use stiffarm_ask::request::Request;

use super::process_of;
use crate::common::Common;
use crate::failure::Failure;
use crate::figures::Plate;
use crate::figures::hodograph::Hodograph;
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty};
use crate::table::{prose, shown};

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<ForceOutput>(common)?;
    outputs.deliver(&answer(asked, common)?)
}

pub(super) fn answer(asked: &Request, common: &Common) -> Result<ForceOutput, Failure> {
    let name = asked.process()?;
    let file = files::shown(Path::new(&name));
    let process = process_of(&name, &file, common)?;
    let force = process.process.force().map_err(|error| Failure::Process { file: file.clone(), error })?;
    Ok(ForceOutput(CuttingAnswer { file, process, force }, Plate::of(asked)?))
}

pub(super) struct ForceOutput(CuttingAnswer, Plate);

impl Answer for ForceOutput {
    const COMMAND: &'static str = "force";
    const FURTHER: &'static [&'static str] = &["svg", "png", "pdf"];

    fn text(&self, look: Look) -> String {
        format!("{}\n{}", shown(&self.0.table(), look), prose(self.0.notes(), look))
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.0.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        let CuttingAnswer { file, force, .. } = &self.0;
        // What does not turn with the spindle has no figure.
        let mean = force.mean.filter(|_| !force.revolution.is_empty())?;
        Some(Ok(Hodograph {
            title: format!("Force on the tool over a revolution, {file}"),
            subtitle: self.0.heading(),
            revolution: force.revolution.iter().map(|[feed, across, _]| [*feed, *across]).collect(),
            mean: [mean[0], mean[1]],
            plate: self.1,
        }
        .svg()))
    }

    fn plate(&self) -> Plate {
        self.1
    }
}
