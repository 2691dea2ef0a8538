//! Robots, and which of them are meant.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use serde_json::Value;
use stiffarm::catalogue::files;
use stiffarm::catalogue::import::{ImportOptions, import};
use stiffarm::catalogue::{self, find, read, suggestions, write};
use stiffarm::robot::{Arm, Robot as Arms};
use stiffarm::toolpath::MOST_SAMPLES;
use stiffarm::watch::Watch;
use stiffarm_ask::answer::robot::{data_sheet, drive_urad_per_nm};
use stiffarm_ask::answer::words;
use stiffarm_ask::ask::{AskError, Context, selection};
use stiffarm_ask::request::Verb;
use stiffarm_ask::sources::Sources;

use crate::asked::Asked;
use crate::hearing::{self, Heard, said};
use crate::json::to_python;
use crate::numbers::{kind, refuse_masked};
use crate::{numbers, refused};

/// A robot: lengths, limits, drives, and where they come from. Never changed; equal where all numbers are.
///
/// Parameters
/// ----------
/// name : str or path
///     A name in the catalogue, or the path of a robot file or URDF.
///
/// Raises
/// ------
/// StiffarmError
///     Where no robot has the name, or the file has faults.
#[pyclass(frozen, eq, from_py_object, module = "stiffarm._stiffarm")]
#[derive(Clone, PartialEq)]
pub(crate) struct Robot(pub(crate) Arms);

impl Robot {
    fn key(&self, key: &str) -> Value {
        data_sheet(&self.0)[key].clone()
    }
}

#[pymethods]
impl Robot {
    #[new]
    fn new(py: Python, #[pyo3(from_py_with = path)] name: PathBuf) -> PyResult<Self> {
        robot(py, &name.to_string_lossy())
    }

    /// A robot that comes with the package, by its name; case, blanks and punctuation do not matter.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     With or without the maker, such as ``"KR 210 R2700 extra"``.
    ///
    /// Raises
    /// ------
    /// StiffarmError
    ///     Where no robot has the name; it suggests some that are close.
    #[staticmethod]
    fn catalogue(#[pyo3(from_py_with = text)] name: String) -> PyResult<Self> {
        find(&name).map(|entry| Self(entry.robot())).ok_or_else(|| {
            let suggestions = suggestions(&name).into_iter().map(Into::into).collect();
            hearing::refused(AskError::UnknownRobot { name, suggestions })
        })
    }

    /// A robot from the text of a robot file, or from its path.
    ///
    /// Parameters
    /// ----------
    /// source : str or path
    ///     What holds an equals sign or more than one line is taken as the text.
    ///
    /// Raises
    /// ------
    /// StiffarmError
    ///     Every fault of the file at once, each with its line and key.
    #[staticmethod]
    fn from_toml(py: Python, #[pyo3(from_py_with = path)] source: PathBuf) -> PyResult<Self> {
        match source.to_str() {
            Some(text) if text.contains(['\n', '=']) => read(text, "robot").map(Self).map_err(refused),
            _ => {
                let found = read(&text_of(&source)?, &files::shown(&source)).map_err(refused)?;
                let notes: Vec<String> = found.calibration.iter().map(|_| files::CALIBRATION_USE.into()).collect();
                remarks(py, &source, &notes)?;
                Ok(Self(found))
            }
        }
    }

    /// A robot from a URDF or from OPW parameters (YAML), proved at random postures.
    ///
    /// Parameters
    /// ----------
    /// path : str or path
    ///     The file.
    /// name, vendor : str, optional
    ///     In place of the file's.
    /// base, tip : str, optional
    ///     The links at which the arm begins and ends.
    ///
    /// Raises
    /// ------
    /// StiffarmError
    ///     Where the file describes no arm with a spherical wrist.
    #[staticmethod]
    #[pyo3(signature = (path, *, name=None, vendor=None, base=None, tip=None))]
    fn from_urdf(
        py: Python,
        #[pyo3(from_py_with = path)] path: PathBuf,
        #[pyo3(from_py_with = text_or_none)] name: Option<String>,
        #[pyo3(from_py_with = text_or_none)] vendor: Option<String>,
        #[pyo3(from_py_with = text_or_none)] base: Option<String>,
        #[pyo3(from_py_with = text_or_none)] tip: Option<String>,
    ) -> PyResult<Self> {
        let options = ImportOptions { name, vendor, base, tip, ..ImportOptions::default() };
        let text = text_of(&path)?;
        let found = import(&text, &files::shown(&path), &options).map_err(refused)?;
        remarks(py, &path, &found.notes)?;
        Ok(Self(found.robot))
    }

    /// A robot from its numbers, by the keys of a robot file.
    ///
    /// Either the seven lengths with ``joint_deg``, or ``l2_mm`` and ``l3_mm`` of a planar arm.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     What to call it.
    /// a1_mm, a2_mm, b_mm, c1_mm, c2_mm, c3_mm, c4_mm : float
    ///     Lengths [mm]; ``b_mm`` is 0 where it is left out.
    /// offset_deg, sign : (6,) array_like, optional
    ///     Zero positions [deg] and signs of the joints; without them those of the model.
    /// joint_deg : (6, 2) array_like
    ///     Ranges of the joints as reported [deg].
    /// drive_urad_per_nm : (6,) array_like, optional
    ///     Compliance of the drives [urad/(N m)]; 1 where it is left out.
    /// l2_mm, l3_mm : float
    ///     The two links of a planar arm [mm].
    /// k2_urad_per_nm, k3_urad_per_nm : float, optional
    ///     Compliance of its drives [urad/(N m)].
    /// shoulder_deg, elbow_deg, forearm_deg : (2,) array_like, optional
    ///     Ranges [deg]; ``elbow_deg`` of a six-axis robot is the angle between the links.
    /// architecture, status, vendor, third_axis : str, optional
    ///     ``"serial"`` or ``"quasi-serial"``; how well the numbers are known (``"estimated"``).
    /// payload_kg, reach_m, mass_kg, repeatability_mm : float, optional
    ///     By the data sheet.
    #[staticmethod]
    #[pyo3(signature = (name, **numbers))]
    fn from_numbers(#[pyo3(from_py_with = text)] name: String, numbers: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let text = numbers::robot_file(&name, numbers)?;
        read(&text, &name).map(Self).map_err(refused)
    }

    /// The same robot with other compliances of its drives.
    ///
    /// Parameters
    /// ----------
    /// drive_urad_per_nm : float or (6,) array_like
    ///     Of all drives, or of each [urad/(N m)], 0.001 to 10000; of a planar robot those of the drives 2 and 3 count.
    #[pyo3(signature = (*, drive_urad_per_nm))]
    fn with_compliance(&self, drive_urad_per_nm: &Bound<'_, PyAny>) -> PyResult<Self> {
        refuse_masked(drive_urad_per_nm).map_err(|why| refused(format!("drive_urad_per_nm: {why}")))?;
        let each = drive_urad_per_nm
            .extract::<f64>()
            .map(|all| [all; 6])
            .or_else(|_| drive_urad_per_nm.extract::<[f64; 6]>())
            .map_err(|_| refused("drive_urad_per_nm takes one number, or six"))?;
        catalogue::with_compliance(&self.0, each).map(Self).map_err(refused)
    }

    /// The robot file that makes an equal robot.
    fn to_toml(&self) -> String {
        write(&self.0)
    }

    /// Everything that is known of it, as ``stiffarm robots show --format json`` prints it.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &data_sheet(&self.0))
    }

    /// The maker's name for it.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// The maker; empty where none is known.
    #[getter]
    fn vendor(&self) -> &str {
        &self.0.vendor
    }

    /// Maker and name.
    #[getter]
    fn full_name(&self) -> String {
        self.0.full_name()
    }

    /// ``"serial"`` or ``"quasi-serial"``.
    #[getter]
    fn architecture(&self) -> &str {
        self.0.architecture.name()
    }

    /// Nothing says that the architecture is so.
    #[getter]
    fn architecture_assumed(&self) -> bool {
        self.0.architecture_is_assumed
    }

    /// ``"identified"``, ``"data-sheet"``, ``"derived"`` or ``"estimated"``.
    #[getter]
    fn status(&self) -> &str {
        self.0.status.name()
    }

    /// Nominal payload [kg], or None.
    #[getter]
    fn payload_kg(&self) -> Option<f64> {
        self.0.payload_kg
    }

    /// Reach by the data sheet [m], or None.
    #[getter]
    fn reach_m(&self) -> Option<f64> {
        self.0.reach
    }

    /// Mass of the arm [kg], or None.
    #[getter]
    fn mass_kg(&self) -> Option<f64> {
        self.0.mass_kg
    }

    /// Repeatability by the data sheet [mm], or None.
    #[getter]
    fn repeatability_mm(&self) -> Option<f64> {
        self.key("repeatability_mm").as_f64()
    }

    /// Only its two links are known: there is no spatial model.
    #[getter]
    fn is_planar(&self) -> bool {
        matches!(self.0.arm, Arm::Planar(_))
    }

    /// Compliance of the drives [urad/(N m)]: six, or those of the drives 2 and 3 of a planar robot.
    #[getter]
    fn drive_urad_per_nm(&self) -> Vec<f64> {
        drive_urad_per_nm(&self.0)
    }

    /// Where each group of numbers comes from.
    #[getter]
    fn source<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.key("source"))
    }

    fn __repr__(&self) -> String {
        format!("<stiffarm.Robot {}>", words::robot(&self.0))
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        write(&self.0).hash(&mut hasher);
        hasher.finish()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let make = py.get_type::<Self>().getattr("from_toml")?;
        Ok((make, PyTuple::new(py, [write(&self.0)])?))
    }
}

/// A name or a path.
fn path(given: &Bound<'_, PyAny>) -> PyResult<PathBuf> {
    given.extract().map_err(|_| refused(format!("{}; expected a name or a path", kind(given))))
}

fn text(given: &Bound<'_, PyAny>) -> PyResult<String> {
    given.extract().map_err(|_| refused(format!("{}; expected a text", kind(given))))
}

fn text_or_none(given: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    (!given.is_none()).then(|| text(given)).transpose()
}

/// The one robot that a name or path means.
fn robot(py: Python, name: &str) -> PyResult<Robot> {
    Ok(Robot(heard(py, |context| selection::robot(name, context))?))
}

/// What is found on this machine, with what is said of it.
fn heard<T: Send>(py: Python, found: impl FnOnce(Context) -> Result<T, AskError> + Send) -> PyResult<T> {
    let (found, remarks) = py.detach(|| {
        let (sources, heard) = (Sources::disk(Vec::new()), Heard::by(Watch::nobody()));
        let context = Context { sources: &sources, listener: &heard, most_samples: MOST_SAMPLES, advises: false };
        (found(context), heard.remarks())
    });
    let found = found.map_err(hearing::refused)?;
    said(py, &remarks)?;
    Ok(found)
}

/// Says what was chosen in reading a file.
fn remarks(py: Python, path: &Path, notes: &[String]) -> PyResult<()> {
    said(py, &notes.iter().map(|note| format!("{}: {note}", files::shown(path))).collect::<Vec<_>>())
}

fn text_of(path: &Path) -> PyResult<String> {
    files::text(path).map_err(|error| hearing::refused(error.into()))
}

/// The robots that a name, a pattern, a path, and the sets `paper` and `all` mean, in the order given.
#[pyfunction]
pub(crate) fn select(py: Python, name: String) -> PyResult<Vec<Robot>> {
    let found = heard(py, |context| selection::robots(&[name], context))?;
    Ok(found.into_iter().map(Robot).collect())
}

/// Those of some robots that have all that is asked for.
#[pyfunction]
pub(crate) fn robots(among: Vec<PyRef<'_, Robot>>, words: Vec<String>, asked: Asked) -> PyResult<Vec<Robot>> {
    let among = among.iter().map(|robot| robot.0.clone()).collect();
    let kept = selection::keep(among, &asked.of(Verb::List)?, &words).map_err(hearing::refused)?;
    Ok(kept.into_iter().map(Robot).collect())
}
