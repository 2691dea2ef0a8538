//! Which keys does the answer of a verb have? Those of its shapes, each with its unit and what it is.

use std::fmt::Write as _;

use stiffarm_ask::answer::field::{Field, Kind};
use stiffarm_ask::answer::shape::{self, Shape, Slot};
use stiffarm_ask::request::Verb;

use super::reference::{head, row, unit};

/// A page as it is written, with objects that stand in several places once.
#[derive(Default)]
struct Page {
    text: String,
    /// What was written.
    slots: Vec<&'static Slot>,
    /// Objects that were written, and where.
    objects: Vec<(&'static str, String)>,
}

impl Page {
    /// The fields of an object but for those that stand above with the same meaning.
    fn write(&mut self, above: &str, shape: &Shape) {
        for slot in self.own(shape) {
            let path = format!("{above}{}{}", slot.field.key, if slot.field.kind == Kind::Objects { "[]" } else { "" });
            let known = slot.of.and_then(|of| self.objects.iter().find(|(name, _)| *name == of.name));
            let keys = match (known, slot.of) {
                (Some((_, at)), _) => format!(" Its keys are those of `{at}`."),
                (None, Some(of)) if *of == shape::PATH_CHATTER => {
                    " Its other keys are those of [chatter](chatter.md).".into()
                }
                (None, Some(of)) if self.own(of).len() < of.slots().count() => " Its other keys stand above.".into(),
                (None, _) => String::new(),
            };
            let is_known = known.is_some();
            row(&mut self.text, &[&format!("`{path}`"), &unit(&slot.field), &format!("{}{keys}", slot.field.about)]);
            self.slots.push(slot);
            if let Some(of) = slot.of.filter(|_| !is_known) {
                self.objects.push((of.name, path.clone()));
                self.write(&format!("{path}."), of);
            }
        }
    }

    fn own(&self, shape: &Shape) -> Vec<&'static Slot> {
        // The cut of a path is that of `chatter`.
        let is_elsewhere =
            |field: &Field| *shape == shape::PATH_CHATTER && shape::CHATTER.slots().any(|slot| slot.field == *field);
        let is_known = |slot: &Slot| self.slots.iter().any(|known| known.field == slot.field && known.of == slot.of);
        let is_own = |slot: &&Slot| !is_known(slot) && !is_elsewhere(&slot.field);
        shape.slots().filter(is_own).collect()
    }
}

/// The keys of the answers of a verb.
pub(super) fn of_verb(verb: Verb) -> String {
    let of_paths = shape::answers(Verb::Mill);
    let (of_mill, own): (Vec<_>, Vec<_>) = shape::answers(verb).into_iter().partition(|shape| of_paths.contains(shape));
    let mut page = Page::default();
    page.text.push_str(
        "\n## Keys of its answer\n\nAs `--format json`, HTTP and Python's `to_dict()` have them: `a.b` stands in the object `a`, `a[].b` in each \
         object of the list `a`. A key that does not apply is null. `schema` says the version of the keys and what positions count from.",
    );
    let shapes = match verb {
        Verb::Mill => of_mill,
        Verb::List => vec![&shape::ROBOT_SHEET],
        _ if !of_mill.is_empty() => {
            page.text.push_str(" Of a toolpath they are those of [mill](mill.md).");
            own
        }
        _ => own,
    };
    page.text.push_str("\n\n");
    head(&mut page.text, &["key", "unit", "meaning"]);
    for shape in shapes {
        page.write("", shape);
    }
    if verb == Verb::List {
        let _ = writeln!(
            page.text,
            "\nWhere they are known, by the keys of a robot file: `body`, `geometry`, `limits`, `masses[]`, `drives` (of the motors) and `verified`; and \
             `arm_plane`, its two links with their limits in the arm plane."
        );
    }
    page.text
}

#[test]
fn a_key_of_several_meanings_has_that_of_its_place() {
    for (verb, line) in [
        (Verb::Mill, "| `search.samples` | count | Samples that stood for the path in the search. |"),
        (Verb::Mill, "| `part.samples` | count | Samples along the path. |"),
        (Verb::Mill, "| `worst_mm` | mm | The largest error along the path. |"),
        (Verb::Mill, "| `verdict` | text | pass where the tolerance is kept"),
        (Verb::Map, "| `zone.deflection_mm` | mm | The worst deflection in the zone at its best place. |"),
        (Verb::Calibrate, "| `at_work.postures` | count | Postures over which it is "),
        (Verb::Rank, "| `winners[].best` | text | The best robot whose geometry and limits are published: of those "),
        (Verb::Study, "| `rows[].best` | yes or no | The link ratio is the best. |"),
        (Verb::Measure, "| `compared.file` | text | The table. |"),
        (Verb::Modes, "| `modes[].least_at_m` | m |"),
        (Verb::Place, "| `cell.mount` | text | How the base is mounted"),
    ] {
        let text = of_verb(verb);
        assert!(text.contains(line), "{line}: {text}");
    }
}
