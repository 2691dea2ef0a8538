//! What can be asked?

/// What can be asked of the library, as a command, a function or the `verb` of a job file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verb {
    /// Robots in order.
    Rank,
    /// The best place of one zone.
    Place,
    /// The deflection everywhere.
    Map,
    /// One posture.
    Compliance,
    /// How the arm swings at one posture.
    Modes,
    /// Whether a cut swings with it.
    Chatter,
    /// Two architectures.
    Study,
    /// Two setups.
    Compare,
    /// Stiffness from measurements.
    Identify,
    /// Which measurements to make.
    Measure,
    /// How an arm differs from its drawing.
    Calibrate,
    /// Whether a robot file counts the joints as readings do.
    Verify,
    /// A part along a toolpath.
    Mill,
    /// The force of a process.
    Force,
    /// Which robots there are.
    List,
}

impl Verb {
    /// All of them.
    pub const ALL: [Self; 15] = [
        Self::Rank,
        Self::Place,
        Self::Map,
        Self::Compliance,
        Self::Modes,
        Self::Chatter,
        Self::Study,
        Self::Compare,
        Self::Identify,
        Self::Measure,
        Self::Calibrate,
        Self::Verify,
        Self::Mill,
        Self::Force,
        Self::List,
    ];
    /// Those that a job file may ask.
    pub const JOBS: [Self; 14] = [
        Self::Rank,
        Self::Place,
        Self::Map,
        Self::Compliance,
        Self::Modes,
        Self::Chatter,
        Self::Study,
        Self::Compare,
        Self::Identify,
        Self::Measure,
        Self::Calibrate,
        Self::Verify,
        Self::Mill,
        Self::Force,
    ];

    /// As it is typed.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rank => "rank",
            Self::Place => "place",
            Self::Map => "map",
            Self::Compliance => "compliance",
            Self::Modes => "modes",
            Self::Chatter => "chatter",
            Self::Study => "study",
            Self::Compare => "compare",
            Self::Identify => "identify",
            Self::Measure => "measure",
            Self::Calibrate => "calibrate",
            Self::Verify => "robots verify",
            Self::Mill => "mill",
            Self::Force => "force",
            Self::List => "robots list",
        }
    }

    /// Its function in Python.
    pub fn function(self) -> &'static str {
        self.name().rsplit(' ').next().unwrap_or_default()
    }
}
