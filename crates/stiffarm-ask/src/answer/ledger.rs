//! How is the ledger of published numbers reported?

use serde_json::Value;

use super::words::fixed;
use super::{Datum, Record, Rows, Table, field, shape, with_schema};
use stiffarm::ledger::Entry;

/// The answer of `validate`: every published number beside the computed one.
#[derive(Clone, Debug)]
pub struct LedgerAnswer(pub Vec<Entry>);

impl LedgerAnswer {
    /// How many numbers neither agree nor are listed with a reason, or agree although they are listed.
    pub fn unsettled(&self) -> usize {
        self.0.iter().filter(|entry| !entry.is_settled()).count()
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        let mut answer = Record::of(&shape::LEDGER);
        answer.put(field::ROWS, self.0.iter().map(record).collect::<Datum>());
        with_schema("validate", "none", &answer)
    }

    /// For a spreadsheet.
    pub fn rows(&self) -> Rows<'static> {
        Rows::of(&shape::PUBLISHED_NUMBER, self.0.iter().map(record))
    }

    /// Why numbers are listed, each reason once.
    fn reasons(&self) -> Vec<&str> {
        let mut reasons: Vec<&str> = Vec::new();
        for note in self.0.iter().filter_map(|entry| entry.note.as_deref()) {
            if !reasons.contains(&note) {
                reasons.push(note);
            }
        }
        reasons
    }

    /// For people.
    pub fn table(&self) -> Table {
        let reasons = self.reasons();
        let mut table = Table::new(["source", "item", "cell", "printed", "computed", "verdict", "reason"]);
        for entry in &self.0 {
            let number = entry.note.as_ref().and_then(|note| reasons.iter().position(|known| known == note));
            table.row([
                entry.source.to_owned(),
                entry.item.clone(),
                entry.cell.clone(),
                entry.printed.clone(),
                entry.computed.map_or_else(|| "-".into(), |computed| fixed(computed, 4)),
                verdict(entry).into(),
                number.map_or_else(String::new, |number| format!("[{}]", number + 1)),
            ]);
        }
        // What is printed and what is computed stand side by side, however narrow the lines.
        table.with_broken_lines()
    }

    /// What stands below the table: the reasons, the units, and how many numbers agree.
    pub fn notes(&self) -> String {
        let reasons: String =
            self.reasons().iter().enumerate().map(|(i, note)| format!("[{}] {note}\n", i + 1)).collect();
        let agree = self.0.iter().filter(|entry| entry.agrees).count();
        let listed = self.0.iter().filter(|entry| !entry.agrees && entry.note.is_some()).count();
        format!(
            "{reasons}\nTable I in units of k F (l2 + l3)^2; Table III and text in mm at 1 kN with 1 urad/(N m) unless a ratio or size.\n\
             {} published numbers: {agree} agree within their printed digits, {listed} are listed with a reason, {} unsettled.\n",
            self.0.len(),
            self.unsettled()
        )
    }
}

fn verdict(entry: &Entry) -> &'static str {
    match (entry.agrees, entry.note.is_some()) {
        (true, false) => "agrees",
        (false, true) => "listed",
        (false, false) => "DISAGREES",
        (true, true) => "agrees, but LISTED",
    }
}

fn record(entry: &Entry) -> Record {
    let mut record = Record::of(&shape::PUBLISHED_NUMBER);
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
