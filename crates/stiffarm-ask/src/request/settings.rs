//! Which options are there? One row each, from which every face builds its parser, its help and its refusals.

mod arm;
mod figure;
mod filters;
mod measuring;
pub(super) mod milling;
mod reading;
mod shared;
mod study;
mod swinging;
mod zones;

use super::setting::Setting;
use super::verb::Verb;

impl Verb {
    /// Its rows, in the order in which help tells them.
    pub fn settings(self) -> impl Iterator<Item = &'static Setting> {
        SETTINGS.iter().filter(move |setting| setting.verbs.contains(&self))
    }

    /// The row of a name.
    pub fn setting(self, name: impl AsRef<str>) -> Option<&'static Setting> {
        self.settings().find(|setting| setting.name == name.as_ref())
    }
}

/// Every option, each once for the verbs in which it means the same.
pub static SETTINGS: &[Setting] = &joined::<{ rows_of(LISTS) }>(LISTS);

/// In the order in which help tells them.
const LISTS: [&[Setting]; 9] = [
    study::ROWS,
    zones::ROWS,
    arm::ROWS,
    figure::ROWS,
    filters::ROWS,
    swinging::ROWS,
    measuring::ROWS,
    reading::ROWS,
    milling::ROWS,
];

const fn rows_of(lists: [&[Setting]; 9]) -> usize {
    let (mut count, mut list) = (0, 0);
    while list < lists.len() {
        count += lists[list].len();
        list += 1;
    }
    count
}

/// One list of all.
const fn joined<const N: usize>(lists: [&[Setting]; 9]) -> [Setting; N] {
    let (mut all, mut filled, mut list) = ([lists[0][0]; N], 0, 0);
    while list < lists.len() {
        let mut i = 0;
        while i < lists[list].len() {
            assert!(!lists[list][i].name.is_empty(), "a row of no option");
            all[filled] = lists[list][i];
            filled += 1;
            i += 1;
        }
        list += 1;
    }
    all
}
