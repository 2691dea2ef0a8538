//! `stiffarm validate`: every published number beside the computed one.

use std::io::{self, Write};

use stiffarm::ledger::{Printed, validate};
use stiffarm_ask::answer::{LedgerAnswer, Rows};

use crate::common::Common;
use crate::failure::Failure;
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty, verdict};
use crate::table::{prose, shown};

pub(crate) fn run(common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<Ledger>(common)?;
    let ledger = Ledger(LedgerAnswer(validate(&Printed::PAPER)?));
    let holds = match ledger.0.unsettled() {
        0 => Ok(()),
        unsettled => Err(Failure::Unsettled(unsettled)),
    };
    verdict(outputs.deliver(&ledger), holds)
}

struct Ledger(LedgerAnswer);

impl Answer for Ledger {
    const COMMAND: &'static str = "validate";

    fn text(&self, look: Look) -> String {
        format!("{}\n{}", shown(&self.0.table(), look), prose(&self.0.notes(), look))
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.0.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }
}
