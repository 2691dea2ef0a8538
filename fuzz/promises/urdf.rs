//! Is every description of a robot either imported exactly, or refused with lines and reasons?

use stiffarm::catalogue::import::{ImportError, ImportOptions, LARGEST_ERROR_M, import};
use stiffarm::catalogue::{read, write};
use stiffarm::interval::Interval;

/// Panics where the promise is broken.
pub(crate) fn holds(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    // OPW parameters have no limits of their own; a URDF keeps its own.
    let limits = (!text.trim_start().starts_with('<')).then(|| [Interval::spanning(-2.0, 2.0); 6]);
    match import(text, "fuzz.urdf", &ImportOptions { limits, ..ImportOptions::default() }) {
        Ok(imported) => {
            assert!(imported.largest_error <= LARGEST_ERROR_M);
            assert_eq!(read(&imported.text, "fuzz.toml").as_ref(), Ok(&imported.robot));
            assert_eq!(write(&imported.robot), imported.text);
        }
        Err(ImportError::Faults(faults) | ImportError::Which(faults) | ImportError::Class(faults)) => {
            assert!(!faults.faults.is_empty(), "refused without a reason");
            let lines = text.split('\n').count();
            for fault in &faults.faults {
                assert!((1..=lines).contains(&fault.line), "line {} of {lines}", fault.line);
                assert!(!fault.message.is_empty());
            }
            assert!(faults.to_string().starts_with("fuzz.urdf:"));
        }
        Err(
            ImportError::Xacro { file, .. }
            | ImportError::NoLinks { file, .. }
            | ImportError::NoLimits { file }
            | ImportError::Bodies { file, .. }
            | ImportError::Inexact { file, .. },
        ) => {
            assert_eq!(file, "fuzz.urdf");
        }
    }
}
