//! Does every published number agree, or stand on the list of known disagreements, which can only shrink?

use stiffarm::ledger::{Printed, validate};

#[test]
fn every_published_number_agrees_or_is_listed_with_its_reason() {
    let entries = validate(&Printed::PAPER).unwrap();
    assert_eq!(entries.len(), 14 + 96 + 20 + 60);
    let unsettled: Vec<_> = entries.iter().filter(|entry| !entry.is_settled()).collect();
    for e in &unsettled {
        println!(
            "{},\"{}\",\"{}\"  printed {} computed {:?} listed {}",
            e.source,
            e.item,
            e.cell,
            e.printed,
            e.computed,
            e.note.is_some()
        );
    }
    assert!(unsettled.is_empty(), "{} unsettled entries, see above", unsettled.len());
}
