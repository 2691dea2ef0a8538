//! What does a request ask of a toolpath, and of a process?

use super::{Refusal, Request};
use crate::toolpath::{
    ArcCentres, ArcSense, CutterCompensation, Format, IncrementalCycles, LengthUnit, ReadOptions, Rotary, Steps,
};

impl Request {
    /// The toolpath: a file's name, or a path built in.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn path(&self) -> Result<String, Refusal> {
        self.texts("path").pop().ok_or_else(|| self.missing("path"))
    }

    /// The process file's name.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn process(&self) -> Result<String, Refusal> {
        self.texts("process").pop().ok_or_else(|| self.missing("process"))
    }

    /// Only what was understood of the path is told.
    pub fn is_dry(&self) -> bool {
        self.is_wished("dry")
    }

    /// How the path of this name is written: as was said, or as its name ends.
    ///
    /// # Errors
    /// Where neither says it.
    pub fn path_format(&self, name: &str) -> Result<Format, Refusal> {
        let said = self.word("read-as").and_then(|word| Format::ALL.into_iter().find(|format| format.name() == word));
        said.or_else(|| Format::of_name(name)).ok_or_else(|| {
            let why = format!("does not say by its ending how it is written; expected {}, or read-as", Format::ENDINGS);
            self.refused("path", why)
        })
    }

    /// What is said where a file of a path is silent.
    pub fn read_options(&self) -> ReadOptions {
        let cutter_compensation = match self.word("cutter-compensation") {
            Some("centre") => CutterCompensation::Centre,
            _ => CutterCompensation::Refuse,
        };
        ReadOptions {
            unit: self.word("unit").map(|word| if word == "mm" { LengthUnit::Millimetre } else { LengthUnit::Inch }),
            arc_centres: self
                .word("arc-centres")
                .map(|word| if word == "absolute" { ArcCentres::Absolute } else { ArcCentres::Incremental }),
            cutter_compensation,
            incremental_cycles: self.word("incremental-cycles").map(|word| match word {
                "nist" => IncrementalCycles::Nist,
                "r-plane" => IncrementalCycles::FromR,
                _ => IncrementalCycles::FromInitial,
            }),
            rotary: self.word("rotary").map(|word| match word {
                "head-ac" => Rotary::HeadAc,
                "head-bc" => Rotary::HeadBc,
                "table-ac" => Rotary::TableAc,
                _ => Rotary::TableBc,
            }),
            arc_sense: self
                .word("arc-sense")
                .map(|word| if word == "left" { ArcSense::LeftHand } else { ArcSense::RightHand }),
            columns: self.texts("columns"),
            feed: self.number("feed-mm-per-min").map(|feed| feed / 60e3),
        }
    }

    /// How finely a path is cut into samples.
    pub fn steps(&self) -> Steps {
        let metres = |name: &str, usual: f64| self.number(name).map_or(usual, |mm| mm / 1e3);
        let usual = Steps::USUAL;
        Steps { chord: metres("chord-mm", usual.chord), longest: metres("step-mm", usual.longest), ..usual }
    }
}
