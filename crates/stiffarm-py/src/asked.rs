//! Keyword arguments as the command line spells them, read by the library.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use stiffarm::load::Load;
use stiffarm::model::ModelKind;
use stiffarm::question::{Angle, Held, Wanted, degrees, elevation, number, tool, within, yaw};
use stiffarm::task::Task;

use crate::refused;

/// What was given, by its name.
#[derive(FromPyObject)]
#[pyo3(transparent)]
pub(crate) struct Asked(BTreeMap<String, String>);

impl Asked {
    /// What was given under a name, or `None`.
    pub(crate) fn read<T>(&self, name: &str, read: impl FnOnce(&str) -> Result<T, String>) -> PyResult<Option<T>> {
        let Some(text) = self.0.get(name) else { return Ok(None) };
        read(text).map(Some).map_err(|error| refused(format!("{name}={text}: {error}")))
    }

    /// The same, of what must be given.
    pub(crate) fn required<T>(&self, name: &str, read: impl FnOnce(&str) -> Result<T, String>) -> PyResult<T> {
        self.read(name, read)?.ok_or_else(|| refused(format!("{name} is missing")))
    }

    /// The model has all six drives; refuses what the planar one does not know.
    pub(crate) fn is_spatial(&self) -> PyResult<bool> {
        let is_spatial = self.required("model", |model| match model {
            "planar" => Ok(false),
            "spatial" => Ok(true),
            _ => Err("expected planar or spatial".into()),
        })?;
        let further = ["tool_mm", "tool_direction", "yaw_deg", "roll_deg"];
        match further.into_iter().find(|name| self.0.contains_key(*name)) {
            Some(name) if !is_spatial => Err(refused(format!("{name} needs model=\"spatial\""))),
            _ => Ok(is_spatial),
        }
    }

    /// Refuses the first of these that was given.
    pub(crate) fn refuse(&self, names: &[&str], why: &str) -> PyResult<()> {
        match names.iter().find(|name| self.0.contains_key(**name)) {
            Some(name) => Err(refused(format!("{name} {why}"))),
            None => Ok(()),
        }
    }

    pub(crate) fn load(&self) -> PyResult<Load> {
        let newtons = self.required("force_n", |text| number(text, 1e-3, 1e6, "N"))?;
        Load::worst(newtons).map_err(refused)
    }

    /// Which model, with the tool where it has one.
    pub(crate) fn kind(&self) -> PyResult<ModelKind> {
        Ok(if self.is_spatial()? { ModelKind::Spatial(self.held()?.tool()) } else { ModelKind::Planar })
    }

    pub(crate) fn tolerance_mm(&self) -> PyResult<Option<f64>> {
        self.read("tolerance_mm", |text| number(text, 1e-6, 1e3, "mm"))
    }

    pub(crate) fn wanted(&self) -> PyResult<Wanted> {
        Ok(Wanted {
            load: self.load()?,
            within: self.read("within_m", within)?,
            angle: self.read("angle", str::parse)?.unwrap_or(Angle::Axes),
            gap: self.read("gap", |text| number(text, 1e-9, 0.5, "(relative)"))?,
        })
    }

    pub(crate) fn held(&self) -> PyResult<Held> {
        Ok(Held {
            tool: self.read("tool_mm", tool)?,
            elevation_deg: self.read("tool_direction", elevation)?,
            yaw: self.read("yaw_deg", yaw)?,
            roll_deg: self.read("roll_deg", degrees)?,
        })
    }
}

/// A task by its notation.
pub(crate) fn task(text: &str) -> PyResult<Task> {
    text.parse().map_err(|error: stiffarm::task::TaskError| refused(error))
}
