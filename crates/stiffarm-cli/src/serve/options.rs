//! Which options are there, for whoever builds a form? The library's table, as it is.

use serde_json::{Value, json};
use stiffarm_ask::request::{Absent, Kind, Of, Setting, Verb};

use super::reply::{Reply, json_reply};

pub(super) fn reply() -> Reply {
    json_reply(&table())
}

/// Every verb with its options.
pub(super) fn table() -> Value {
    let verbs = Verb::jobs().map(|verb| {
        let options: Vec<Value> = verb.settings().map(|setting| option(verb, setting)).collect();
        json!({ "verb": verb.name(), "about": verb.about(), "options": options })
    });
    json!({ "version": env!("CARGO_PKG_VERSION"), "verbs": verbs.collect::<Value>() })
}

fn option(verb: Verb, setting: &Setting) -> Value {
    let (default, means) = match setting.absent {
        Absent::Default(text) => (Some(text), None),
        Absent::Means(words) => (None, Some(words)),
        Absent::Optional | Absent::Required => (None, None),
    };
    let models: &[&str] = match setting.of {
        Of::Any => &["planar", "spatial"],
        Of::Planar => &["planar"],
        Of::Spatial => &["spatial"],
    };
    let choices = setting.kind.words().iter().map(|(word, help)| json!({ "word": word, "help": help }));
    let needs: Vec<&str> = setting.needed_by(verb).collect();
    let [least, most] = bounds(setting.kind);
    json!({
        "name": setting.name, "keyword": setting.keyword(), "help": setting.help, "heading": setting.heading, "value": setting.value,
        "unit": setting.unit, "kind": kind(setting.kind), "choices": choices.collect::<Value>(), "min": least, "max": most,
        "default": default, "means": means, "required": setting.absent == Absent::Required,
        "list": setting.is_list(), "models": models, "excludes": setting.excludes, "needs": needs,
        "example": setting.example, "positional": setting.is_positional, "figure": setting.is_of_figures(),
    })
}

/// The ends of a number.
pub(super) fn bounds(kind: Kind) -> [Option<f64>; 2] {
    match kind {
        Kind::Number { min, max, or_zero, .. } => [Some(if or_zero { min.min(0.0) } else { min }), Some(max)],
        Kind::Whole { min, max } => [min, max].map(|end| Some(end as f64)),
        _ => [None, None],
    }
}

/// What an option takes, in a word.
pub(super) fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Text => "text",
        Kind::Robot => "robot",
        Kind::File => "file",
        Kind::FileOfTool => "file-of-tool",
        Kind::LengthOfTool => "length-of-tool",
        Kind::Flag => "flag",
        Kind::Word(_) => "choice",
        Kind::Number { .. } => "number",
        Kind::Whole { .. } => "integer",
        Kind::Force => "force",
        Kind::Range { .. } => "range",
        Kind::Within => "within",
        Kind::Block { .. } => "block",
        Kind::Mount => "mount",
        Kind::Angle => "angle",
        Kind::Elevation => "elevation",
        Kind::Yaw => "yaw",
        Kind::Roll => "roll",
        Kind::Pin => "pin",
        Kind::Floor => "floor",
        Kind::Tool => "tool",
        Kind::Spindle => "spindle",
        Kind::Point => "point",
        Kind::Marker => "marker",
        Kind::Way => "way",
        Kind::Direction => "direction",
        Kind::Date => "date",
        Kind::Heading => "heading",
        // A zone that is typed for one verb is meant for another one, too.
        Kind::Task | Kind::Zone => "task",
        Kind::Shape => "shape",
        Kind::Posture => "posture",
    }
}
