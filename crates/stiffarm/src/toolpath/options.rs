//! What a user says of a file where the file is silent.

/// The unit of lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// mm.
    Millimetre,
    /// in.
    Inch,
}

impl LengthUnit {
    /// In m.
    pub const fn metres(self) -> f64 {
        match self {
            Self::Millimetre => 1e-3,
            Self::Inch => 25.4e-3,
        }
    }

    /// As it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Inch => "inch",
        }
    }

    /// What is to be said where a file names its unit although another one was said, in case it named none.
    pub(super) fn instead_of(self, said: Option<Self>) -> Option<String> {
        let said = said.filter(|said| *said != self)?;
        Some(format!("lengths in {}, as the file says, not in {} as was said", self.name(), said.name()))
    }
}

/// From where I, J and K of an arc count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArcCentres {
    /// From the beginning of the arc.
    Incremental,
    /// From the origin.
    Absolute,
}

/// What is done about a path that is not that of the tool's centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CutterCompensation {
    /// It is refused.
    #[default]
    Refuse,
    /// It is taken for the centre's, and that is said.
    Centre,
}

/// From where drilling cycles under G91 count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IncrementalCycles {
    /// R from the present level, Z from R; what a later hole does not repeat is read anew from it (RS274/NGC).
    Nist,
    /// R from the level at which the cycle began, Z from R; both hold as levels.
    FromR,
    /// R and Z from the level at which the cycle began; both hold as levels.
    FromInitial,
}

/// What the words A, B and C turn; X, Y and Z are the tip in the part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rotary {
    /// The spindle, by C about z and then A about the turned x: axis `Rz(C) Rx(A) z`.
    HeadAc,
    /// The spindle, by C about z and then B about the turned y: axis `Rz(C) Ry(B) z`.
    HeadBc,
    /// The part, by A about x, on it C about z: axis `Rz(-C) Rx(-A) z`.
    TableAc,
    /// The part, by B about y, on it C about z: axis `Rz(-C) Ry(-B) z`.
    TableBc,
}

/// In which sense an arc of APT turns about its axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArcSense {
    /// Clockwise, seen against the axis: Siemens NX.
    LeftHand,
    /// Counter-clockwise: SOLIDWORKS CAM, Autodesk.
    RightHand,
}

/// What is known besides the file; `None` leaves it to the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Where the file names none.
    pub unit: Option<LengthUnit>,
    /// Of G-code, where no G90.1 or G91.1 says it.
    pub arc_centres: Option<ArcCentres>,
    /// What is done about G41 and G42.
    pub cutter_compensation: CutterCompensation,
    /// What G91 means to drilling cycles.
    pub incremental_cycles: Option<IncrementalCycles>,
    /// What A, B and C turn.
    pub rotary: Option<Rotary>,
    /// Of APT.
    pub arc_sense: Option<ArcSense>,
    /// Names of the columns of a CSV file without a header.
    pub columns: Vec<String>,
    /// m/s, where the file says none.
    pub feed: Option<f64>,
}

/// No tip is farther from the origin of the part along any axis, m.
pub(super) const FARTHEST: f64 = 100.0;
