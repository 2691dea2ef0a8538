//! Reads keys of a TOML table one by one, and keeps every fault with its line.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::Fault;
use crate::plain::steers;

/// Finds the line of a place in the text, and collects faults.
#[derive(Debug)]
pub(super) struct Log {
    line_starts: Vec<usize>,
    faults: RefCell<Vec<Fault>>,
}

impl Log {
    pub(super) fn of(text: &str) -> Rc<Self> {
        let line_starts = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Rc::new(Self { line_starts, faults: RefCell::default() })
    }

    pub(super) fn add(&self, place: usize, key: &str, message: impl Into<String>) {
        let line = self.line_starts.partition_point(|&start| start <= place);
        self.faults.borrow_mut().push(Fault { line, key: key.into(), message: message.into() });
    }

    pub(super) fn has_faults(&self) -> bool {
        !self.faults.borrow().is_empty()
    }

    pub(super) fn into_faults(self: Rc<Self>) -> Vec<Fault> {
        let mut faults = self.faults.borrow().clone();
        faults.sort_by_key(|fault| fault.line);
        faults
    }
}

/// What a number may be, in the unit of its key.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quantity {
    pub(super) unit: &'static str,
    pub(super) min: f64,
    pub(super) max: f64,
    /// A non-zero number smaller than this was probably given in a larger unit: `(threshold, factor, that unit)`.
    pub(super) suspect: Option<(f64, f64, &'static str)>,
}

impl Quantity {
    /// What is wrong with `x`, if anything.
    fn fault(self, x: f64) -> Option<String> {
        let Self { unit, min, max, suspect } = self;
        if let Some((threshold, factor, other)) = suspect
            && x != 0.0
            && (0.0 < x || min < 0.0)
            && x.abs() < threshold
        {
            let meant = format!("{:.6}", x * factor);
            let meant = meant.trim_end_matches('0').trim_end_matches('.');
            return Some(format!("{x} {unit} is too small to be true; if this is in {other}, write {meant}"));
        }
        let is_stiffness = unit == "urad/(N m)" && max < x;
        let stiffness = if is_stiffness {
            format!("; if this is a stiffness in N m/rad, write {}", 1e6 / x)
        } else {
            String::new()
        };
        (!(min <= x && x <= max)).then(|| format!("{x} {unit}; expected {min} to {max} {unit}{stiffness}"))
    }
}

/// A table of which keys are taken one after the other; what is left over at the end is a fault.
pub(super) struct Table<'a, 'i> {
    path: String,
    place: usize,
    entries: Option<&'a DeTable<'i>>,
    taken: Vec<&'static str>,
    log: Rc<Log>,
}

impl<'a, 'i> Table<'a, 'i> {
    pub(super) fn root(table: &'a DeTable<'i>, log: Rc<Log>) -> Self {
        Self { path: String::new(), place: 0, entries: Some(table), taken: Vec::new(), log }
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.entries.is_some_and(|table| table.contains_key(key))
    }

    pub(super) fn fault(&self, key: &str, message: impl Into<String>) {
        let place = self.entries.and_then(|table| table.get(key)).map_or(self.place, |value| value.span().start);
        self.log.add(place, &self.name(key), message);
    }

    fn name(&self, key: &str) -> String {
        match (self.path.is_empty(), key.is_empty()) {
            (true, _) => key.into(),
            (false, true) => self.path.clone(),
            (false, false) => format!("{}.{key}", self.path),
        }
    }

    fn optional(&mut self, key: &'static str) -> Option<&'a Spanned<DeValue<'i>>> {
        self.taken.push(key);
        self.entries?.get(key)
    }

    fn required(&mut self, key: &'static str, expected: &str) -> Option<&'a Spanned<DeValue<'i>>> {
        let found = self.optional(key);
        if found.is_none() && self.entries.is_some() {
            self.log.add(self.place, &self.name(key), format!("missing; expected {expected}"));
        }
        found
    }

    /// A table of its own; where it is absent, an empty one that faults no missing keys.
    pub(super) fn table(&mut self, key: &'static str) -> Table<'a, 'i> {
        let value = self.optional(key);
        let entries = value.and_then(|value| value.get_ref().as_table());
        if value.is_some() && entries.is_none() {
            self.fault(key, "expected a table");
        }
        let place = value.map_or(self.place, |value| value.span().start);
        Table { path: self.name(key), place, entries, taken: Vec::new(), log: self.log.clone() }
    }

    /// Tables of an array, `[[key]]`; none where it is absent.
    pub(super) fn tables(&mut self, key: &'static str) -> Vec<Table<'a, 'i>> {
        let Some(value) = self.optional(key) else { return Vec::new() };
        let items = value.get_ref().as_array().map(|items| items.iter().map(|item| (item, item.get_ref().as_table())));
        let Some(items) = items.filter(|items| items.clone().all(|(_, table)| table.is_some())) else {
            self.fault(key, format!("{}; expected tables, each under [[{key}]]", describe(value.get_ref())));
            return Vec::new();
        };
        let path = self.name(key);
        let table = |(item, entries): (&Spanned<DeValue<'i>>, Option<&'a DeTable<'i>>)| Table {
            path: path.clone(),
            place: item.span().start,
            entries,
            taken: Vec::new(),
            log: self.log.clone(),
        };
        items.map(table).collect()
    }

    /// A word in quotes or a whole number, as text.
    pub(super) fn word_or_whole(&mut self, key: &'static str, expected: &str) -> Option<String> {
        let value = self.required(key, expected)?;
        match value.get_ref() {
            DeValue::String(text) => Some(shown(text)),
            DeValue::Integer(integer) => Some(shown(&integer_as_written(integer))),
            other => {
                self.fault(key, format!("{}; expected {expected}", describe(other)));
                None
            }
        }
    }

    pub(super) fn text(&mut self, key: &'static str, required: bool) -> Option<String> {
        let value = if required { self.required(key, "a text in quotes") } else { self.optional(key) }?;
        let fault = match value.get_ref().as_str().map(str::trim) {
            None | Some("") => "expected a text in quotes that is not empty".into(),
            Some(text) => match unfit_name(text) {
                None => return Some(text.into()),
                Some(fault) => fault,
            },
        };
        self.fault(key, fault);
        None
    }

    /// One of several words.
    pub(super) fn choice<T: Copy>(
        &mut self,
        key: &'static str,
        choices: &[(&str, T)],
        default: Option<T>,
    ) -> Option<T> {
        let words: Vec<String> = choices.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        let expected = words.join(" or ");
        let value = if default.is_some() { self.optional(key) } else { self.required(key, &expected) };
        let Some(value) = value else { return default };
        let found = value.get_ref().as_str().and_then(|text| choices.iter().find(|(word, _)| *word == text));
        if found.is_none() {
            self.fault(key, format!("{} is not known; expected {expected}", describe(value.get_ref())));
        }
        found.map(|&(_, choice)| choice)
    }

    pub(super) fn number(&mut self, key: &'static str, quantity: Quantity) -> Option<f64> {
        let value = self.required(key, &format!("a number in {}", quantity.unit))?;
        self.checked(key, value, quantity)
    }

    pub(super) fn optional_number(&mut self, key: &'static str, quantity: Quantity) -> Option<f64> {
        let value = self.optional(key)?;
        self.checked(key, value, quantity)
    }

    fn checked(&self, key: &str, value: &Spanned<DeValue>, quantity: Quantity) -> Option<f64> {
        let fault = |message: String| self.log.add(value.span().start, &self.name(key), message);
        let Some(x) = number(value.get_ref()) else {
            fault(format!("{} is not a number; expected one in {}", describe(value.get_ref()), quantity.unit));
            return None;
        };
        match quantity.fault(x) {
            None => Some(x),
            Some(message) => {
                fault(message);
                None
            }
        }
    }

    /// The largest of all numbers under these keys, signs left out; zero where there are none.
    pub(super) fn largest(&self, keys: &[&str]) -> f64 {
        let values = keys.iter().filter_map(|key| self.entries?.get(*key));
        let each = values.flat_map(|value| match value.get_ref() {
            DeValue::Array(items) => items.iter().filter_map(|item| number(item.get_ref())).collect(),
            value => number(value).into_iter().collect::<Vec<_>>(),
        });
        each.map(f64::abs).fold(0.0, f64::max)
    }

    /// Exactly `N` numbers, or none at all; the outer `None` is a fault, the inner an absent key.
    pub(super) fn optional_numbers<const N: usize>(
        &mut self,
        key: &'static str,
        quantity: Quantity,
    ) -> Option<Option<[f64; N]>> {
        if self.optional(key).is_none() { Some(None) } else { self.numbers(key, quantity).map(Some) }
    }

    /// Exactly `N` numbers.
    pub(super) fn numbers<const N: usize>(&mut self, key: &'static str, quantity: Quantity) -> Option<[f64; N]> {
        let value = self.required(key, &format!("{N} numbers in {}", quantity.unit))?;
        let items = self.items(key, value, N)?;
        let numbers: Vec<f64> = items.iter().filter_map(|item| self.checked(key, item, quantity)).collect();
        numbers.try_into().ok()
    }

    /// Exactly `N` items of an array, else a fault.
    fn items<'b>(&self, key: &str, value: &'b Spanned<DeValue<'i>>, n: usize) -> Option<&'b [Spanned<DeValue<'i>>]> {
        match value.get_ref().as_array() {
            Some(items) if items.len() == n => Some(items),
            Some(items) => {
                self.log.add(value.span().start, &self.name(key), format!("{} values; expected {n}", items.len()));
                None
            }
            None => {
                let message = format!("{} is not a list; expected {n} values in brackets", describe(value.get_ref()));
                self.log.add(value.span().start, &self.name(key), message);
                None
            }
        }
    }

    fn pair(&self, key: &str, value: &Spanned<DeValue<'i>>, quantity: Quantity) -> Option<(f64, f64)> {
        let items = self.items(key, value, 2)?;
        let (min, max) = (self.checked(key, &items[0], quantity), self.checked(key, &items[1], quantity));
        let (min, max) = (min?, max?);
        if min <= max {
            return Some((min, max));
        }
        self.log.add(
            value.span().start,
            &self.name(key),
            format!("[{min}, {max}]: the lower end lies above the upper end"),
        );
        None
    }

    /// `[min, max]`; the outer `None` is a fault, the inner an absent key.
    pub(super) fn range(&mut self, key: &'static str, quantity: Quantity) -> Option<Option<(f64, f64)>> {
        let Some(value) = self.optional(key) else {
            return Some(None);
        };
        self.pair(key, value, quantity).map(Some)
    }

    /// `N` times `[min, max]`.
    pub(super) fn ranges<const N: usize>(&mut self, key: &'static str, quantity: Quantity) -> Option<[(f64, f64); N]> {
        let value = self.required(key, &format!("{N} times [min, max] in {}", quantity.unit))?;
        let items = self.items(key, value, N)?;
        let ranges: Vec<(f64, f64)> = items.iter().filter_map(|item| self.pair(key, item, quantity)).collect();
        ranges.try_into().ok()
    }

    /// `N` times `N` numbers, row by row; the outer `None` is a fault, the inner an absent key.
    pub(super) fn matrix<const N: usize>(
        &mut self,
        key: &'static str,
        quantity: Quantity,
    ) -> Option<Option<[[f64; N]; N]>> {
        let Some(value) = self.optional(key) else {
            return Some(None);
        };
        let rows = self.items(key, value, N)?.iter().filter_map(|row| {
            let items = self.items(key, row, N)?.iter();
            let numbers: Vec<f64> = items.filter_map(|item| self.checked(key, item, quantity)).collect();
            numbers.try_into().ok()
        });
        let rows: Vec<[f64; N]> = rows.collect();
        rows.try_into().ok().map(Some)
    }

    /// Any number of times `N` numbers.
    pub(super) fn rows<const N: usize>(
        &mut self,
        key: &'static str,
        quantities: &[Quantity; N],
    ) -> Option<Vec<[f64; N]>> {
        let value = self.required(key, &format!("lists of {N} numbers"))?;
        let Some(items) = value.get_ref().as_array() else {
            let message = format!("{} is not a list; expected lists of {N} numbers", describe(value.get_ref()));
            self.log.add(value.span().start, &self.name(key), message);
            return None;
        };
        let row = |row| {
            let items = self.items(key, row, N)?.iter().zip(quantities);
            let numbers: Option<Vec<f64>> = items.map(|(item, quantity)| self.checked(key, item, *quantity)).collect();
            numbers?.try_into().ok()
        };
        let rows: Vec<Option<[f64; N]>> = items.iter().map(row).collect();
        rows.into_iter().collect()
    }

    /// Exactly `N` times `true` or `false`.
    pub(super) fn flags<const N: usize>(&mut self, key: &'static str) -> Option<[bool; N]> {
        let value = self.required(key, &format!("{N} times true or false"))?;
        let items = self.items(key, value, N)?;
        let flags: Vec<bool> = items.iter().filter_map(|item| item.get_ref().as_bool()).collect();
        let flags = flags.try_into().ok();
        if flags.is_none() {
            self.fault(key, format!("expected {N} times true or false"));
        }
        flags
    }

    /// `true` or `false`; false where the key is absent.
    pub(super) fn flag(&mut self, key: &'static str) -> Option<bool> {
        let Some(value) = self.optional(key) else { return Some(false) };
        let found = value.get_ref().as_bool();
        if found.is_none() {
            self.fault(key, format!("{}; expected true or false", describe(value.get_ref())));
        }
        found
    }

    /// Every key with a text.
    pub(super) fn texts(&mut self) -> BTreeMap<String, String> {
        let mut texts = BTreeMap::new();
        for (key, value) in self.entries.into_iter().flat_map(DeTable::iter) {
            let key: &str = key.get_ref();
            let fault = |message: String| self.log.add(value.span().start, &self.name(&shown(key)), message);
            let Some(text) = value.get_ref().as_str() else {
                fault("expected a text in quotes".into());
                continue;
            };
            match steering(key).or_else(|| steering(&text.replace(['\n', '\r', '\t'], " "))) {
                None => drop(texts.insert(key.to_owned(), text.to_owned())),
                Some(message) => fault(message),
            }
        }
        texts
    }

    /// Faults every key that was neither asked for nor is one of `further`.
    pub(super) fn finish(mut self, further: &[&'static str]) {
        self.taken.extend(further.iter().filter(|key| !self.taken.contains(key)).collect::<Vec<_>>());
        for key in self.entries.into_iter().flat_map(DeTable::keys) {
            let name: &str = key.get_ref();
            if self.taken.contains(&name) {
                continue;
            }
            let near = self.taken.iter().map(|known| (crate::plain::alike(known, name), known));
            let near = near.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(score, _)| 0.8 < *score);
            let hint = near.map_or_else(
                || format!("expected {}", self.taken.join(", ")),
                |(_, known)| format!("did you mean {known}?"),
            );
            self.log.add(key.span().start, &self.name(&shown(name)), format!("unknown key; {hint}"));
        }
    }
}

fn number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().replace('_', "").parse().ok(),
        DeValue::Float(float) => float.as_str().replace('_', "").parse().ok(),
        _ => None,
    }
}

/// With the prefix of its radix, which the parser keeps apart.
fn integer_as_written(integer: &toml::de::DeInteger) -> String {
    let prefix = match integer.radix() {
        2 => "0b",
        8 => "0o",
        16 => "0x",
        _ => "",
    };
    format!("{prefix}{}", integer.as_str())
}

/// Makers need no more letters for a name.
const MOST_LETTERS: usize = 200;

/// What is wrong with a name of a robot or a maker, if anything.
pub(super) fn unfit_name(name: &str) -> Option<String> {
    let letters = name.chars().count();
    if MOST_LETTERS < letters {
        return Some(format!("a name of {letters} letters; expected at most {MOST_LETTERS}"));
    }
    steering(name)
}

/// Names the character that would steer a terminal or the direction of reading, if there is one.
fn steering(text: &str) -> Option<String> {
    let found = text.chars().find(|&c| steers(c))?;
    Some(format!(
        "holds the character {}, which steers terminals and lines; expected letters that can be seen",
        found.escape_default()
    ))
}

/// A text from a file as it may stand in a message: short, on one line, without control characters.
pub(crate) fn shown(text: &str) -> String {
    const MOST: usize = 60;
    let escaped: String = text.chars().take(MOST).flat_map(char::escape_debug).collect();
    if text.chars().count() <= MOST { escaped } else { escaped + "..." }
}

fn describe(value: &DeValue) -> String {
    match value {
        DeValue::String(text) => format!("\"{}\"", shown(text)),
        DeValue::Integer(integer) => shown(&integer_as_written(integer)),
        DeValue::Float(float) => shown(float.as_str()),
        DeValue::Boolean(flag) => flag.to_string(),
        DeValue::Datetime(_) => "a date".into(),
        DeValue::Array(_) => "a list".into(),
        DeValue::Table(_) => "a table".into(),
    }
}
