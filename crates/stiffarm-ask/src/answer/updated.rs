//! What do measurements make of what was known of the drives?

use stiffarm::identify::Updated;

use super::numbers::digits;
use super::words::fixed;
use super::{Datum, Record, Table, field, shape};

/// A record of each drive.
pub(super) fn records(drives: &[Updated; 6]) -> Datum {
    let of = |(drive, one): (usize, &Updated)| {
        let mut record = Record::of(&shape::UPDATED_DRIVE);
        record
            .put(field::SPRING, drive + 1)
            .put(field::PRIOR, one.prior)
            .put(field::PRIOR_SD, one.prior_sd)
            .put(field::POSTERIOR, one.posterior)
            .put(field::POSTERIOR_SD, one.sd)
            .put(field::INTERVAL, one.interval())
            .put(field::MOVED_BY_DATA, one.moved())
            .put(field::LEARNED, one.learned())
            .put(field::IS_SHOWN, one.is_shown());
        record
    };
    drives.iter().enumerate().map(of).collect()
}

/// A row of each drive.
pub(super) fn table(drives: &[Updated; 6]) -> Table {
    let headings = ["drive", "prior urad/(N m)", "posterior urad/(N m)", "95 % interval", "moved", "learned", "shown"];
    let mut table = Table::new(headings);
    let urad = |k: f64| digits(k * 1e6, 3).to_string();
    for (drive, one) in drives.iter().enumerate() {
        let [low, high] = one.interval().map(urad);
        table.row([
            (drive + 1).to_string(),
            format!("{} x/: {}", urad(one.prior), fixed((1.645 * one.prior_sd).exp(), 1)),
            urad(one.posterior),
            format!("{low} .. {high}"),
            format!("{} sd", fixed(one.moved(), 1)),
            format!("{} %", fixed(100.0 * one.learned(), 0)),
            if one.is_shown() { "yes" } else { "no" }.into(),
        ]);
    }
    table
}
