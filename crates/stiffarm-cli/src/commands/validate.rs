//! `stiffarm validate`: every published number beside the computed one.

use serde_json::Value;
use stiffarm::ledger::{Printed, validate};
use stiffarm_ask::answer::{LedgerAnswer, Rows};

use crate::common::Common;
use stiffarm_ask::forms::{Answer, Forms, Piece};

use crate::failure::Failure;
use crate::output::{Outputs, verdict};

pub(crate) fn run(common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open(common, FORMS)?;
    let ledger = Ledger(LedgerAnswer(validate(&Printed::PAPER)?));
    let holds = match ledger.0.unsettled() {
        0 => Ok(()),
        unsettled => Err(Failure::Unsettled(unsettled)),
    };
    verdict(outputs.deliver(&ledger), holds)
}

struct Ledger(LedgerAnswer);

/// In which forms it is shown.
const FORMS: Forms = Forms::of("validate");

impl Answer for Ledger {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(self.0.table()), Piece::Break, Piece::Lines(self.0.notes())]
    }

    fn value(&self) -> Value {
        self.0.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }
}
