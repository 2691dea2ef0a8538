//! A robot file from keyword arguments.

use std::fmt::Write;

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyString};

use crate::refused;

/// The keys of a robot file by their tables; without `[source]`.
const TABLES: [(&str, &[&str]); 5] = [
    ("geometry", &["a1_mm", "a2_mm", "b_mm", "c1_mm", "c2_mm", "c3_mm", "c4_mm", "offset_deg", "sign"]),
    ("limits", &["joint_deg", "third_axis", "elbow_deg", "speed_deg_per_s"]),
    ("compliance", &["drive_urad_per_nm", "transmission"]),
    ("body", &["radius_mm"]),
    ("planar", &["l2_mm", "l3_mm", "shoulder_deg", "elbow_deg", "forearm_deg", "k2_urad_per_nm", "k3_urad_per_nm"]),
];
const HEAD: [&str; 8] = [
    "vendor",
    "architecture",
    "architecture_assumed",
    "status",
    "payload_kg",
    "reach_m",
    "mass_kg",
    "repeatability_mm",
];
/// What stands where nothing is said.
const USUAL: [(&str, &str, &str); 3] = [
    ("geometry", "b_mm", "0"),
    ("geometry", "offset_deg", "[0, 0, 0, 0, 0, 0]"),
    ("geometry", "sign", "[1, 1, 1, 1, 1, 1]"),
];

/// The text of a robot file; the library reads and checks it.
pub(crate) fn robot_file(name: &str, numbers: Option<&Bound<'_, PyDict>>) -> PyResult<String> {
    let mut given = Vec::new();
    for (key, value) in numbers.into_iter().flat_map(PyDictMethods::iter) {
        if !value.is_none() {
            let key = key.extract::<String>()?;
            let value = literal(&value).map_err(|why| refused(format!("{name}: {key}: {why}")))?;
            given.push((key, value));
        }
    }
    let value = |key: &str| given.iter().find(|(known, _)| known == key).map(|(_, value)| value.as_str());
    let is_planar = value("l2_mm").is_some() || value("l3_mm").is_some();
    let tables = TABLES.iter().filter(|(table, _)| is_planar == (*table == "planar"));
    let known = |key: &str| HEAD.contains(&key) || tables.clone().any(|(_, keys)| keys.contains(&key));
    if let Some((key, _)) = given.iter().find(|(key, _)| !known(key)) {
        let what = if is_planar { "planar" } else { "six-axis" };
        return Err(refused(format!("{name}: {key} is no number of a {what} robot file")));
    }
    let mut text = format!("name = {}\n", quoted(name));
    for (key, usual) in HEAD.map(|key| {
        (
            key,
            match key {
                "architecture" => Some("\"serial\""),
                "status" => Some("\"estimated\""),
                _ => None,
            },
        )
    }) {
        if let Some(value) = value(key).or(usual) {
            writeln!(text, "{key} = {value}").expect("memory takes everything");
        }
    }
    for (table, keys) in tables {
        let usual = |key: &str| USUAL.iter().find(|usual| (usual.0, usual.1) == (*table, key)).map(|usual| usual.2);
        let entries: Vec<(&str, &str)> =
            keys.iter().filter_map(|key| Some((*key, value(key).or_else(|| usual(key))?))).collect();
        if !entries.is_empty() {
            writeln!(text, "[{table}]").expect("memory takes everything");
        }
        for (key, value) in entries {
            writeln!(text, "{key} = {value}").expect("memory takes everything");
        }
    }
    Ok(text)
}

/// A value as TOML has it, or why it is none.
fn literal(value: &Bound<'_, PyAny>) -> Result<String, String> {
    refuse_masked(value)?;
    if let Ok(truth) = value.cast::<PyBool>() {
        return Ok(truth.is_true().to_string());
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(quoted(&text.to_string_lossy()));
    }
    if let Ok(number) = value.extract::<f64>() {
        return Ok(format!("{number:?}").to_lowercase());
    }
    let unknown = |_| format!("{}; expected a number, a text or a list of them", kind(value));
    let items = value.try_iter().map_err(unknown)?.map(|item| literal(&item.map_err(unknown)?));
    Ok(format!("[{}]", items.collect::<Result<Vec<_>, _>>()?.join(", ")))
}

/// The type of a value, in a message.
pub(crate) fn kind(value: &Bound<'_, PyAny>) -> String {
    value.get_type().name().map_or_else(|_| "this".into(), |name| format!("a value of type {name}"))
}

/// What NumPy masks is no number.
pub(crate) fn refuse_masked(value: &Bound<'_, PyAny>) -> Result<(), String> {
    let masked = value.getattr("mask").and_then(|mask| mask.call_method0("any")).and_then(|any| any.is_truthy());
    if masked.is_ok_and(|masked| masked) {
        Err("numbers are masked; fill them, or leave them out".into())
    } else {
        Ok(())
    }
}

/// JSON's quotes are TOML's.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
