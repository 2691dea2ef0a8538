//! Does the server do what its own description says?

use serde_json::{Value, json};

use super::served::Served;

/// Why a value is not as a schema says; the part of JSON Schema that the description uses, and a panic for any other.
fn unlike(value: &Value, schema: &Value, whole: &Value) -> Option<String> {
    const KNOWN: [&str; 18] = [
        "type",
        "properties",
        "required",
        "additionalProperties",
        "items",
        "minItems",
        "not",
        "allOf",
        "dependentRequired",
        "dependentSchemas",
        "enum",
        "anyOf",
        "minimum",
        "maximum",
        "description",
        "x-example",
        "x-default",
        "$ref",
    ];
    let rules = schema.as_object().expect("a schema");
    assert!(rules.keys().all(|key| KNOWN.contains(&key.as_str()) || key == "default"), "{schema}");
    if let Some(path) = schema["$ref"].as_str() {
        return unlike(value, whole.pointer(path.trim_start_matches('#')).expect("it is there"), whole);
    }
    let kind = match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(number) if number.is_f64() => "number",
        Value::Number(_) => "integer",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    };
    let is = |wanted: &Value| wanted == kind || wanted == "number" && kind == "integer";
    let fits = match &schema["type"] {
        Value::Null => true,
        Value::Array(kinds) => kinds.iter().any(is),
        one => is(one),
    };
    if !fits {
        return Some(format!("{value} is no {}", schema["type"]));
    }
    if let Some(choices) = schema["anyOf"].as_array()
        && choices.iter().all(|one| unlike(value, one, whole).is_some())
    {
        return Some(format!("{value} is none of {schema}"));
    }
    if let Some(words) = schema["enum"].as_array()
        && !words.contains(value)
    {
        return Some(format!("{value} is none of {words:?}"));
    }
    let beyond = |end: &str, sign: f64| {
        schema[end].as_f64().zip(value.as_f64()).is_some_and(|(end, found)| sign * end < sign * found)
    };
    if beyond("maximum", 1.0) || beyond("minimum", -1.0) {
        return Some(format!("{value} is beyond {schema}"));
    }
    let all = schema["allOf"].as_array();
    if let Some(wrong) = all.into_iter().flatten().find_map(|one| unlike(value, one, whole)) {
        return Some(wrong);
    }
    if !schema["not"].is_null() && unlike(value, &schema["not"], whole).is_none() {
        return Some(format!("{value} is {}", schema["not"]));
    }
    if let Value::Array(items) = value
        && !schema["items"].is_null()
    {
        if items.len() < schema["minItems"].as_u64().unwrap_or(0) as usize {
            return Some(format!("{value} is too short a list"));
        }
        return items.iter().find_map(|item| unlike(item, &schema["items"], whole));
    }
    let Value::Object(fields) = value else { return None };
    let missing =
        schema["required"].as_array().into_iter().flatten().find(|key| !fields.contains_key(key.as_str().unwrap()));
    if let Some(missing) = missing {
        return Some(format!("{missing} is missing in {value}"));
    }
    let needed = |(key, others): (&String, &Value)| {
        let lacks = |other: &Value| !fields.contains_key(other.as_str().unwrap());
        fields.contains_key(key) && others.as_array().unwrap().iter().any(lacks)
    };
    if let Some((key, others)) = schema["dependentRequired"].as_object().into_iter().flatten().find(|row| needed(*row))
    {
        return Some(format!("{key} needs {others}"));
    }
    let others = schema["dependentSchemas"].as_object().into_iter().flatten();
    let lacking =
        others.filter(|(key, _)| fields.contains_key(*key)).find_map(|(_, other)| unlike(value, other, whole));
    if lacking.is_some() {
        return lacking;
    }
    fields.iter().find_map(|(key, field)| match (&schema["properties"][key], &schema["additionalProperties"]) {
        (Value::Null, Value::Bool(false)) => Some(format!("{key} is not described")),
        (Value::Null, Value::Null | Value::Bool(true)) => None,
        (Value::Null, any) => unlike(field, any, whole),
        (known, _) => unlike(field, known, whole),
    })
}

/// Holds a reply to the description of its path, method and status.
fn held(served: &Served, whole: &Value, (path, asked): (&str, &str), body: Option<&Value>) -> u16 {
    let method = if body.is_some() { "post" } else { "get" };
    let reply = body.map_or_else(|| served.get(asked), |body| served.ask(asked, body));
    let response = &whole["paths"][path][method]["responses"][reply.status.to_string()];
    assert!(!response.is_null(), "{asked}: {} is not described", reply.status);
    let schema = &response["content"]["application/json"]["schema"];
    let content = reply.json();
    let wrong = unlike(&content, schema, whole);
    assert_eq!(wrong, None, "{asked}: {}", reply.text());
    reply.status
}

fn body_schema<'a>(whole: &'a Value, path: &str) -> &'a Value {
    &whole["paths"][path]["post"]["requestBody"]["content"]["application/json"]["schema"]
}

/// Of no robot: the answer has its keys all the same.
const READINGS: &str = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n0,10,0,0,45,0,1500,0,900\n10,20,5,7,40,0,1400,200,900\n\
                        20,30,-5,-9,50,0,1500,500,1100\n30,0,15,20,30,0,1300,700,1000\n";

#[test]
fn every_answer_and_every_refusal_is_as_it_is_described() {
    let served = Served::start(&[]);
    let whole = served.get("/openapi.json").json();
    assert_eq!(whole["openapi"], "3.1.0");
    assert_eq!(held(&served, &whole, ("/api/options", "/api/options"), None), 200);
    assert_eq!(held(&served, &whole, ("/api/robots", "/api/robots?text=kuka&reach-m=3.."), None), 200);
    assert_eq!(held(&served, &whole, ("/api/robots", "/api/robots?nothing=1"), None), 400);
    assert_eq!(held(&served, &whole, ("/api/robots/{name}", "/api/robots/BT200L"), None), 200);
    assert_eq!(held(&served, &whole, ("/api/robots/{name}", "/api/robots/nobody"), None), 404);
    let questions = [
        ("/api/place", json!({ "options": { "robot": "BT200L", "task": "circle:0.3", "tolerance-mm": 2.5 } }), 200),
        ("/api/place", json!({ "options": { "robot": "BT200L", "task": "circle:9" } }), 200),
        ("/api/place", json!({ "options": { "robot": "nobody", "task": "circle:0.3" } }), 422),
        ("/api/rank", json!({ "options": { "task": ["A:0.5"], "robots": ["BT200L", "ZX200U"] } }), 200),
        ("/api/map", json!({ "options": { "robot": "BT200L", "size": 10 } }), 200),
        ("/api/compliance", json!({ "options": { "robot": "BT200L", "joints-deg": [0, 10, 20, 0, 45, 0] } }), 200),
        ("/api/study", json!({ "options": { "tasks": ["A"], "sizes": [0.5] } }), 200),
        (
            "/api/force",
            json!({ "options": { "process": "p.toml" }, "files": { "p.toml": "[worst]\nforce_n = 300\n" } }),
            200,
        ),
        (
            "/api/mill",
            json!({ "options": { "path": "line:0.1", "robot": "KR 210 R2700 extra", "force-n": [300, -120, 80], "at": [1.7, 0, 0.8], "step-mm": 50 } }),
            200,
        ),
        ("/api/robots/check", json!({ "name": "a.toml", "text": "x = 1" }), 200),
        (
            "/api/robots/verify",
            json!({ "options": { "robot": "BT200L", "data": "p.csv" }, "files": { "p.csv": READINGS } }),
            200,
        ),
        (
            "/api/robots/verify",
            json!({ "options": { "data": "p.csv", "any": true }, "files": { "p.csv": READINGS } }),
            200,
        ),
        (
            "/api/robots/verify",
            json!({ "options": { "robot": "nobody", "data": "p.csv" }, "files": { "p.csv": READINGS } }),
            422,
        ),
        (
            "/api/calibrate",
            json!({
                "options": { "robot": "KR 210 R2700 extra", "data": "t.csv", "level": "zeros", "at": [1.8, 0, 0.8] },
                "files": { "t.csv": include_str!("../../../../docs/examples/tracker.csv") },
            }),
            200,
        ),
        (
            "/api/calibrate",
            json!({ "options": { "robot": "BT200L", "data": "p.csv" }, "files": { "p.csv": READINGS } }),
            422,
        ),
        ("/api/robots/check", json!({ "name": "a.urdf", "text": "<robot/>" }), 200),
        ("/api/robots/check", json!({ "name": "a.yaml", "text": "a: [" }), 200),
    ];
    for (path, body, status) in questions {
        assert_eq!(unlike(&body, body_schema(&whole, path), &whole), None, "the question itself");
        assert_eq!(held(&served, &whole, (path, path), Some(&body)), status, "{body}");
    }
    let job = json!({ "name": "job.toml", "text": "verb = 'place'\nrobot = 'BT200L'\ntask = 'circle:0.3'\n" });
    for task in ["circle:0.3", "circle:9"] {
        let body = json!({ "options": { "robot": "BT200L", "task": task } });
        let several = served.ask("/api/place?as=json,tables,svg", &body).json();
        assert_eq!(unlike(&several, &whole["components"]["schemas"]["Forms"], &whole), None, "{several:#}");
    }
    assert_eq!(held(&served, &whole, ("/api/job", "/api/job"), Some(&job)), 200);
    assert_eq!(held(&served, &whole, ("/api/job", "/api/job"), Some(&json!({ "name": "job.toml" }))), 400);
    let wrong = json!({ "name": "job.toml", "text": "verb = 'place'\nrobot = 'BT200L'\ntsak = 'circle:0.3'\n" });
    assert_eq!(held(&served, &whole, ("/api/job", "/api/job"), Some(&wrong)), 400);
    let said = served.ask("/api/job", &wrong).text();
    assert!(said.contains("tsak is no option of place; did you mean task?"), "{said}");
    for (body, status) in [
        (json!({ "options": {} }), 400),
        (json!({ "nothing": 1 }), 400),
        (json!({ "options": { "robot": 3, "task": 4 } }), 400),
        (json!({ "options": { "robot": "BT200L", "task": "A:0.1", "tool-mm": [], "model": "spatial" } }), 400),
        (json!({ "options": { "robot": "BT200L", "task": "A:0.1", "drive-urad-per-nm": [] } }), 400),
        (json!({ "options": { "robot": "BT200L", "task": "A:0.1", "at": "2,0.5", "within": "1..,.." } }), 400),
        (json!({ "options": { "robot": "BT200L", "task": "A:0.1", "feed-deg": 3, "model": "spatial" } }), 400),
    ] {
        assert!(unlike(&body, body_schema(&whole, "/api/place"), &whole).is_some(), "{body} is described as right");
        assert_eq!(held(&served, &whole, ("/api/place", "/api/place"), Some(&body)), status);
    }
}

/// Of every option a value of its example: what is described as right is not refused for its type.
#[test]
fn every_option_takes_what_is_described() {
    let served = Served::start(&[]);
    let (whole, table) = (served.get("/openapi.json").json(), served.get("/api/options").json());
    for verb in table["verbs"].as_array().unwrap() {
        let name = verb["verb"].as_str().unwrap();
        let path = format!("/api/{}", name.replace(' ', "/"));
        let schema = &body_schema(&whole, &path)["properties"]["options"];
        for option in verb["options"].as_array().unwrap() {
            let key = option["name"].as_str().unwrap();
            let example = option["example"].as_str().unwrap();
            let schema = &schema["properties"][key];
            let value = [
                json!(example),
                example.parse::<f64>().map_or(Value::Null, |x| json!(x)),
                example.parse::<i64>().map_or(Value::Null, |x| json!(x)),
                json!(example == "true"),
            ]
            .into_iter()
            .chain([example.split(',').map(|part| part.parse::<f64>().map_or(json!(part), |x| json!(x))).collect()])
            .find(|value| unlike(value, schema, &whole).is_none());
            let value = value.unwrap_or_else(|| panic!("{name} {key}: {example} is not as described: {schema}"));
            let reply = served.ask(&format!("{path}?as=job"), &json!({ "options": { key: value } }));
            let text = reply.text();
            let is_of_value =
                text.contains("invalid value") || text.contains("no option") || text.contains("given twice");
            assert!(!is_of_value, "{name} {key} = {value}: {text}");
        }
    }
}
