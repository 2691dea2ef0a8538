//! `stiffarm validate`: every published number beside the computed one.

use std::io::{self, Write};

use serde_json::Value;
use stiffarm::answer::{Record, Rows, Table, field, with_schema};
use stiffarm::ledger::{Entry, Printed, validate};

use crate::args::Common;
use crate::failure::Failure;
use crate::output::{Answer, Outputs, pretty};
use crate::table::{fixed_or_dash, shown};

pub(crate) fn run(common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<Ledger>(common, &[])?;
    let ledger = Ledger(validate(&Printed::PAPER)?);
    outputs.deliver(&ledger)?;
    match ledger.0.iter().filter(|entry| !entry.is_settled()).count() {
        0 => Ok(()),
        unsettled => Err(Failure::Unsettled(unsettled)),
    }
}

struct Ledger(Vec<Entry>);

/// What the ledger says of an entry.
fn verdict(entry: &Entry) -> &'static str {
    match (entry.agrees, entry.note.is_some()) {
        (true, false) => "agrees",
        (false, true) => "listed",
        (false, false) => "DISAGREES",
        (true, true) => "agrees, but LISTED",
    }
}

impl Answer for Ledger {
    const COMMAND: &'static str = "validate";

    fn text(&self, markdown: bool) -> String {
        let mut table = Table::new(["source", "item", "cell", "printed", "computed", "verdict", "reason"]);
        let mut reasons: Vec<&str> = Vec::new();
        for entry in &self.0 {
            let note = entry.note.as_deref().map(|note| {
                let number = reasons.iter().position(|known| *known == note).unwrap_or_else(|| {
                    reasons.push(note);
                    reasons.len() - 1
                });
                format!("[{}]", number + 1)
            });
            table.row([
                entry.source.to_owned(),
                entry.item.clone(),
                entry.cell.clone(),
                entry.printed.clone(),
                fixed_or_dash(entry.computed, 4),
                verdict(entry).into(),
                note.unwrap_or_default(),
            ]);
        }
        let agree = self.0.iter().filter(|entry| entry.agrees).count();
        let listed = self.0.iter().filter(|entry| !entry.agrees && entry.note.is_some()).count();
        let unsettled = self.0.iter().filter(|entry| !entry.is_settled()).count();
        let notes: String = reasons.iter().enumerate().map(|(i, note)| format!("[{}] {note}\n", i + 1)).collect();
        format!(
            "{}\n{notes}\nTable I in units of k F (l2 + l3)^2; Table III and text in mm at 1 kN with 1 urad/(N m) unless a ratio or size.\n\
             {} published numbers: {agree} agree within their printed digits, {listed} are listed with a reason, {unsettled} unsettled.\n",
            shown(&table, markdown),
            self.0.len()
        )
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut answer = Record::new();
        answer.put(field::ROWS, self.0.iter().map(|entry| record(entry).json()).collect::<Value>());
        pretty(out, &with_schema("validate", "none", &answer))
    }

    fn rows(&self) -> Rows<'_> {
        let records: Vec<Record> = self.0.iter().map(record).collect();
        let columns = records.first().map(Record::columns).unwrap_or_default();
        Rows::new(columns, records.iter().map(Record::cells).collect())
    }
}

fn record(entry: &Entry) -> Record {
    let mut record = Record::new();
    record
        .put(field::SOURCE, entry.source)
        .put(field::ITEM, &entry.item)
        .put(field::CELL, &entry.cell)
        .put(field::PRINTED, &entry.printed)
        .put(field::COMPUTED, entry.computed)
        .put(field::AGREES, entry.agrees)
        .put(field::NOTE, entry.note.clone());
    record
}
