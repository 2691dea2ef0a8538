//! What can be asked, and what is answered, as `OpenAPI` 3.1: from the table of options, so that it says what the server takes.

use serde_json::{Map, Value, json};
use stiffarm_ask::answer::field::Kind as FieldKind;
use stiffarm_ask::answer::shape::{self, Shape, Slot};
use stiffarm_ask::request::{Absent, Kind, Setting, Verb};

use super::options::bounds;
use super::reply::{Reply, json_reply};

/// Every status that a question may have besides 200, and when.
const REFUSALS: [(&str, &str); 11] = [
    ("400", "What is asked makes no sense, or is too much"),
    ("403", "The server is called by a foreign name, or from a page of another origin"),
    ("404", "There is nothing of this name"),
    ("405", "It is asked in another way; Allow tells in which"),
    ("408", "The question was not there in time"),
    ("413", "The question has more than 4 MiB"),
    ("415", "The question is not sent as application/json"),
    ("422", "It was asked well, and has no answer: a file with faults, a robot that is not known, nothing to draw"),
    ("500", "The program broke"),
    ("503", "As many questions wait as may; Retry-After tells when to ask again"),
    ("504", "There was no answer in time; ask for application/x-ndjson"),
];

pub(super) fn reply() -> Reply {
    json_reply(&description())
}

/// The whole description.
pub(super) fn description() -> Value {
    let mut paths = Map::new();
    for verb in Verb::jobs() {
        paths.insert(format!("/api/{}", address(verb)), json!({ "post": asked(verb) }));
    }
    let sheet = || referred(&shape::ROBOT_SHEET);
    let sheets = || json!({ "type": "array", "items": sheet() });
    paths.insert(
        "/api/options".into(),
        json!({ "get": operation("Every option of every verb", &[], &options_schema()) }),
    );
    let filters: Vec<Value> = Verb::List.settings().map(parameter).chain([words()]).collect();
    paths.insert("/api/robots".into(), json!({ "get": operation("Robots of the catalogue", &filters, &sheets()) }));
    paths.insert(
        "/api/robots/{name}".into(),
        json!({ "get": operation("One robot of the catalogue", &[name()], &sheet()) }),
    );
    paths.insert("/api/robots/check".into(), json!({ "post": checked() }));
    paths.insert("/api/job".into(), json!({ "post": job() }));
    json!({
        "openapi": "3.1.0",
        "info": {
            "title": "stiffarm", "version": env!("CARGO_PKG_VERSION"),
            "description": "Which industrial robot is stiff enough for machining, and where the work must stand. Every answer is what the \
                            program `stiffarm` writes with the same options; units are the ending of each key.",
        },
        "paths": paths,
        "components": { "schemas": schemas() },
    })
}

fn schemas() -> Map<String, Value> {
    let mut schemas = objects();
    let sheet = (shape::ROBOT_SHEET.name, object(&shape::ROBOT_SHEET));
    for (name, schema) in
        [sheet, ("Answer", answer()), ("Forms", forms()), ("Tables", tables()), ("Refusal", refusal())]
    {
        schemas.insert(name.into(), schema);
    }
    schemas
}

/// A question to a verb.
fn asked(verb: Verb) -> Value {
    let settings: Vec<&Setting> = verb.settings().collect();
    let required: Vec<&str> =
        settings.iter().filter(|row| row.absent == Absent::Required).map(|row| row.name).collect();
    let options: Map<String, Value> = settings.iter().map(|row| (row.name.to_owned(), taken(row))).collect();
    let mut options = json!({ "type": "object", "properties": options, "required": required });
    go_together(verb, &settings, &mut options);
    let mut question = json!({
        "type": "object", "additionalProperties": false,
        "properties": {
            "options": options,
            "files": {
                "type": "object", "additionalProperties": { "type": "string" },
                "description": "Texts that options name: robot files, processes, toolpaths, tables, STL files (binary ones as data:;base64,...). No file of the server is read.",
            },
        },
    });
    if !required.is_empty() {
        question["required"] = json!(["options"]);
    }
    let form = json!({
        "name": "as", "in": "query", "schema": { "type": "string", "default": "json" },
        "description": "The form: json, csv, md, txt, parquet; tables (what people read, as JSON); of most verbs svg, png, pdf; of place and mill shop (drawing of where the work must stand, SVG); of mill lobes (with chatter, SVG); view (3-D, HTML), report (HTML) and report-pdf, toml (robot file), src, mod, ls, \
                        py (RoboDK), yaml (ROS 2) or nc (programs), vtp and vti (ParaView); job and command tell how the same is asked elsewhere. \
                        Several texts of one answer, which is computed once, with commas: json,tables,svg",
    });
    let wait = json!({
        "name": "Prefer", "in": "header", "required": false, "schema": { "type": "string" },
        "description": "wait=SECONDS (RFC 7240): how long an answer that is no stream may take, instead of what --time-limit-s says; who hangs up stops the work",
    });
    let mut any = answers(verb);
    any.push(json!({ "$ref": "#/components/schemas/Forms" }));
    let mut responses = refusals();
    responses["200"] = json!({
        "description": "What the program writes in this form; line by line, progress and then the answer, where application/x-ndjson is accepted",
        "headers": { "stiffarm-notes": { "description": "What the program says beside it: a JSON list of texts", "schema": { "type": "string" } } },
        "content": {
            "application/json": { "schema": { "anyOf": any } },
            "application/x-ndjson": { "schema": stream() },
        },
    });
    json!({
        "summary": verb.about(), "operationId": verb.function(), "parameters": [form, wait],
        "requestBody": { "required": true, "content": { "application/json": { "schema": question } } },
        "responses": responses,
    })
}

/// Which options need others, and which exclude one another.
fn go_together(verb: Verb, settings: &[&Setting], options: &mut Value) {
    let is_known = |name: &str| settings.iter().any(|row| row.name == name);
    let mut pairs: Vec<[&str; 2]> = Vec::new();
    for row in settings {
        for other in row.excludes.iter().filter(|other| is_known(other)) {
            let pair = [row.name.min(other), row.name.max(other)];
            if !pairs.contains(&pair) {
                pairs.push(pair);
            }
        }
        match row.needed_by(verb).collect::<Vec<_>>().as_slice() {
            [] => {}
            needed @ [_] => options["dependentRequired"][row.name] = json!(needed),
            each => {
                let each: Value = each.iter().map(|name| json!({ "required": [name] })).collect();
                options["dependentSchemas"][row.name] = json!({ "anyOf": each });
            }
        }
    }
    if !pairs.is_empty() {
        options["allOf"] = pairs.iter().map(|pair| json!({ "not": { "required": pair } })).collect();
    }
}

/// What an option takes in JSON: numbers where a job file has numbers, else texts.
fn taken(row: &Setting) -> Value {
    let number = |kind: &str| {
        let [least, most] = bounds(row.kind);
        let mut schema = json!({ "type": kind });
        for (key, end) in [("minimum", least), ("maximum", most)] {
            if let Some(end) = end {
                schema[key] = json!(end);
            }
        }
        schema
    };
    let list = |items: &Value| json!({ "type": "array", "items": items, "minItems": 1 });
    let numbers = list(&json!({ "type": "number" }));
    let text = json!({ "type": "string" });
    let one = match row.kind {
        Kind::Number { .. } => number("number"),
        Kind::Whole { .. } => number("integer"),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Word(words) => {
            json!({ "type": "string", "enum": words.iter().map(|(word, _)| *word).collect::<Vec<_>>() })
        }
        Kind::Force => json!({ "anyOf": [{ "type": "number" }, numbers] }),
        Kind::Tool | Kind::Point => json!({ "anyOf": [text, numbers] }),
        Kind::Angle | Kind::Elevation | Kind::Floor | Kind::Yaw | Kind::Roll => json!({ "type": ["string", "number"] }),
        Kind::Range { .. } | Kind::Within => {
            json!({ "anyOf": [text, list(&json!({ "type": ["string", "number"] }))] })
        }
        _ => text,
    };
    let schema = if row.is_list() { json!({ "anyOf": [one, list(&one)] }) } else { one };
    described(schema, row)
}

/// With what help says of it.
fn described(mut schema: Value, row: &Setting) -> Value {
    schema["description"] = row.described().into();
    if !row.example.is_empty() {
        schema["x-example"] = row.example.into();
    }
    if let Absent::Default(text) = row.absent {
        schema["x-default"] = text.into();
    }
    schema
}

/// A filter of the catalogue.
fn parameter(row: &Setting) -> Value {
    json!({ "name": row.name, "in": "query", "required": false, "schema": described(json!({ "type": "string" }), row) })
}

fn words() -> Value {
    json!({ "name": "text", "in": "query", "description": "Words of the maker's or the robot's name", "schema": { "type": "string" } })
}

fn name() -> Value {
    json!({ "name": "name", "in": "path", "required": true, "schema": { "type": "string" } })
}

/// Something that is read.
fn operation(about: &str, parameters: &[Value], schema: &Value) -> Value {
    let mut responses = refusals();
    responses["200"] = json!({ "description": about, "content": { "application/json": { "schema": schema } } });
    json!({ "summary": about, "parameters": parameters, "responses": responses })
}

/// What the checker is asked and says.
fn checked() -> Value {
    let text = || json!({ "type": "string" });
    let texts = || json!({ "type": "array", "items": text() });
    let keys = ["robot", "notes", "doubts", "toml", "hint", "faults"];
    let verdict = json!({
        "type": "object", "required": keys, "additionalProperties": false,
        "properties": {
            "robot": or_null(referred(&shape::ROBOT_SHEET)), "notes": texts(), "doubts": texts(), "toml": { "type": ["string", "null"] },
            "hint": { "type": ["string", "null"] },
            "faults": { "type": "array", "items": {
                "type": "object", "required": ["line", "key", "text"], "additionalProperties": false,
                "properties": { "line": { "type": ["integer", "null"] }, "key": text(), "text": text() },
            } },
        },
    });
    of_file("What is wrong with a robot file, a URDF, or OPW parameters", &verdict)
}

/// What a job file asks.
fn job() -> Value {
    let typed = json!({ "anyOf": [{ "type": "string" }, { "type": "array", "items": { "type": "string" } }] });
    let asked = json!({
        "type": "object", "required": ["verb", "options"], "additionalProperties": false,
        "properties": {
            "verb": { "type": "string", "enum": Verb::jobs().map(Verb::name).collect::<Vec<_>>() },
            "options": { "type": "object", "additionalProperties": typed },
        },
    });
    of_file("What a job file asks: its verb, and every option as it is typed", &asked)
}

/// An operation that answers about a file, which is sent with its name.
fn of_file(about: &str, schema: &Value) -> Value {
    let text = || json!({ "type": "string" });
    let mut question = json!({ "type": "object", "additionalProperties": false, "required": ["name", "text"] });
    question["properties"] = json!({ "name": text(), "text": text() });
    let mut described = operation(about, &[], schema);
    described["requestBody"] = json!({ "required": true, "content": { "application/json": { "schema": question } } });
    described
}

/// Every object that stands in answers, by its name.
fn objects() -> Map<String, Value> {
    shape::all().into_iter().map(|shape| (shape.name.to_owned(), object(shape))).collect()
}

fn object(shape: &Shape) -> Value {
    let keys: Vec<&str> = shape.slots().map(|slot| slot.field.key).collect();
    let fields: Map<String, Value> = shape.slots().map(|slot| (slot.field.key.to_owned(), field(slot))).collect();
    json!({ "type": "object", "description": shape.about, "required": keys, "properties": fields })
}

fn field(slot: &Slot) -> Value {
    let mut schema = match (slot.field.kind, slot.of) {
        (FieldKind::Object, Some(of)) => referred(of),
        (FieldKind::Objects, Some(of)) => json!({ "type": "array", "items": referred(of) }),
        (kind, _) => held(kind),
    };
    if slot.may_be_null {
        schema = or_null(schema);
    }
    schema["description"] = slot.field.about.into();
    schema
}

fn referred(shape: &Shape) -> Value {
    json!({ "$ref": format!("#/components/schemas/{}", shape.name) })
}

fn or_null(mut schema: Value) -> Value {
    match schema["type"].take() {
        Value::String(kind) => schema["type"] = json!([kind, "null"]),
        _ => return json!({ "anyOf": [{ "$ref": schema["$ref"] }, { "type": "null" }] }),
    }
    schema
}

/// What stands in JSON for a value of a kind.
fn held(kind: FieldKind) -> Value {
    let list = |items: Value| json!({ "type": "array", "items": items });
    match kind {
        FieldKind::Text => json!({ "type": "string" }),
        FieldKind::Truth => json!({ "type": "boolean" }),
        FieldKind::Count => json!({ "type": "integer" }),
        FieldKind::Number(_) => json!({ "type": "number" }),
        FieldKind::Numbers { nested, open, .. } => {
            let number = if open { json!({ "type": ["number", "null"] }) } else { json!({ "type": "number" }) };
            if nested == 0 { list(number) } else { list(list(number)) }
        }
        FieldKind::List(of) => list(held(*of)),
        FieldKind::Maybe(of) => or_null(held(*of)),
        FieldKind::ByName(of) => json!({ "type": "object", "additionalProperties": held(*of) }),
        FieldKind::Object | FieldKind::Objects => json!({ "type": ["object", "array"] }),
    }
}

/// An answer of a verb: its schema, then the fields of one of its objects.
fn answers(verb: Verb) -> Vec<Value> {
    let answer = json!({ "$ref": "#/components/schemas/Answer" });
    shape::answers(verb).into_iter().map(|shape| json!({ "allOf": [answer, referred(shape)] })).collect()
}

fn answer() -> Value {
    json!({ "type": "object", "required": ["schema"], "properties": { "schema": referred(&shape::SCHEMA) } })
}

fn refusals() -> Value {
    let schema = json!({ "$ref": "#/components/schemas/Refusal" });
    let content = json!({ "application/json": { "schema": schema } });
    let each = REFUSALS
        .iter()
        .map(|(status, when)| ((*status).to_owned(), json!({ "description": when, "content": content })));
    Value::Object(each.collect())
}

/// Several forms of an answer.
fn forms() -> Value {
    json!({
        "type": "object", "required": ["refused"], "additionalProperties": { "type": ["string", "null"] },
        "properties": {
            "json": { "$ref": "#/components/schemas/Answer" }, "tables": { "$ref": "#/components/schemas/Tables" },
            "refused": {
                "type": "object", "additionalProperties": { "$ref": "#/components/schemas/Refusal" },
                "description": "Why a form is null: of a path that is not followed there is a table and no figure",
            },
        },
    })
}

/// What people read of an answer.
fn tables() -> Value {
    let words = || json!({ "type": "array", "items": { "type": "string" } });
    let lead = json!({
        "type": ["object", "null"], "required": ["value", "means", "rests_on", "rows"],
        "description": "The line that decides: its value, what that is, what it rests on, and the rows that say no more than these and the keys of the place",
        "properties": {
            "value": { "type": "string" }, "means": { "type": "string" }, "rests_on": { "type": "string" },
            "rows": { "type": "array", "items": { "type": "integer" } },
        },
    });
    let table = json!({
        "type": "object", "required": ["headings", "rows", "lead"],
        "properties": { "headings": words(), "rows": { "type": "array", "items": words() }, "lead": lead },
    });
    json!({
        "type": "object", "required": ["tables", "sentences"], "additionalProperties": false,
        "properties": {
            "tables": { "type": "array", "items": table },
            "sentences": { "type": "array", "items": words(), "description": "One list before the first table and one behind each" },
        },
    })
}

fn refusal() -> Value {
    json!({
        "type": "object", "required": ["error", "hint"], "additionalProperties": false,
        "properties": {
            "error": { "type": "string" }, "hint": { "type": "string" },
            "exit_code": { "type": "integer", "description": "With which the program would end" },
        },
    })
}

/// A line of a stream.
fn stream() -> Value {
    let far = json!({
        "type": "object", "required": ["doing", "done", "total"],
        "properties": { "doing": { "type": "string" }, "done": { "type": "integer" }, "total": { "type": ["integer", "null"] } },
    });
    json!({
        "type": "object",
        "properties": {
            "progress": far, "answer": {}, "notes": { "type": "array", "items": { "type": "string" } },
            "error": { "type": "string" }, "hint": { "type": "string" }, "exit_code": { "type": "integer" }, "status": { "type": "integer" },
        },
    })
}

fn options_schema() -> Value {
    json!({
        "type": "object", "required": ["version", "verbs"],
        "properties": {
            "version": { "type": "string" },
            "verbs": { "type": "array", "items": {
                "type": "object", "required": ["verb", "about", "options"],
                "properties": { "verb": { "type": "string" }, "about": { "type": "string" }, "options": { "type": "array", "items": {
                    "type": "object", "required": ["name", "keyword", "help", "kind", "choices", "default", "means", "required", "list"],
                } } },
            } },
        },
    })
}

/// Of a verb behind `/api/`.
pub(super) fn address(verb: Verb) -> String {
    verb.name().replace(' ', "/")
}
