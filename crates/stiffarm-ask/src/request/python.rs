//! What must be written in Python to ask the same again?

use super::{Given, Kind, Request};
use stiffarm::catalogue::quoted;

impl Request {
    /// The call that asks the same, of the package `stiffarm`, in the folder in which it was asked.
    pub fn python(&self) -> String {
        let rows = self.verb.settings().filter(|row| row.is_positional);
        let mut positional: Vec<Option<String>> = rows.map(|row| self.find(row.name).map(literal)).collect();
        while positional.pop_if(|last| last.is_none()).is_some() {}
        let positional = positional.into_iter().map(|literal| literal.unwrap_or_else(|| "None".into()));
        let named = self.given.iter().filter(|given| !given.setting.is_positional);
        let named = named.map(|given| format!("{}={}", given.setting.keyword(), literal(given)));
        let arguments: Vec<String> = positional.chain(named).collect();
        format!("stiffarm.{}({})", self.verb.function(), arguments.join(", "))
    }
}

fn literal(given: &Given) -> String {
    let kind = given.setting.kind;
    let each: Vec<String> = given.texts.iter().map(|text| one(kind, text.trim())).collect();
    match each.as_slice() {
        [one] => one.clone(),
        several => format!("[{}]", several.join(", ")),
    }
}

/// A value: a number where one is taken, else the text as it is typed. What a text is quoted with means the same in Python.
fn one(kind: Kind, text: &str) -> String {
    match kind {
        Kind::Flag => if text == "true" { "True" } else { "False" }.into(),
        kind if kind.may_be_number() && text.parse::<f64>().is_ok_and(f64::is_finite) => {
            text.trim_start_matches('+').into()
        }
        _ => quoted(text),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Pair, Spelling, Verb};
    use super::*;

    #[test]
    fn what_stands_without_its_name_keeps_its_place() {
        let pair = |name: &str, text: &str| Pair { name: name.into(), text: text.into(), at: Spelling::Typed };
        let pairs = [pair("data", "pendant.csv"), pair("any", "true"), pair("columns", "x_mm=X,y_mm=Y")];
        let asked = Request::read(Verb::Verify, &pairs, Spelling::Typed).unwrap();
        let expected = r#"stiffarm.verify(None, "pendant.csv", any=True, columns=["x_mm=X", "y_mm=Y"])"#;
        assert_eq!(asked.python(), expected);
    }

    #[test]
    fn a_call_asks_the_same_and_nothing_in_it_is_run() {
        let pair = |name: &str, text: &str| Pair { name: name.into(), text: text.into(), at: Spelling::Typed };
        let pairs = [
            pair("robot", "a\"); import os\\\n"),
            pair("task", "rect:0.6x0.4"),
            pair("model", "spatial"),
            pair("tolerance-mm", "2"),
            pair("drive-urad-per-nm", "1,1,2,2,3,3"),
        ];
        let asked = Request::read(Verb::Place, &pairs, Spelling::Typed).unwrap();
        assert_eq!(
            asked.python(),
            r#"stiffarm.place("a\"); import os\\", task="rect:0.6x0.4", model="spatial", tolerance_mm=2, drive_urad_per_nm=[1, 1, 2, 2, 3, 3])"#
        );
    }
}
