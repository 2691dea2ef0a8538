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
    /// All of them, in the order in which help names them.
    pub const ALL: [Self; 15] = [
        Self::Rank,
        Self::Place,
        Self::Map,
        Self::Compliance,
        Self::Modes,
        Self::Chatter,
        Self::Study,
        Self::Compare,
        Self::Force,
        Self::Mill,
        Self::Measure,
        Self::Identify,
        Self::Calibrate,
        Self::Verify,
        Self::List,
    ];

    /// Those that a job file may ask.
    pub fn jobs() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|verb| *verb != Self::List)
    }

    /// As it is typed.
    pub fn name(self) -> &'static str {
        self.said().0
    }

    /// What it does, in a line of help.
    pub fn about(self) -> &'static str {
        self.said().1
    }

    /// Its function in Python.
    pub fn function(self) -> &'static str {
        self.name().rsplit(' ').next().unwrap_or_default()
    }

    fn said(self) -> (&'static str, &'static str) {
        match self {
            Self::Rank => {
                ("rank", "Rank robots for tasks; without arguments the ten robots of the paper on its six tasks")
            }
            Self::Place => ("place", "Find the best place of one zone, with a proof"),
            Self::Map => ("map", "Map the deflection over everything a robot reaches"),
            Self::Compliance => ("compliance", "Six-axis compliance at one posture, and which drive gives how much"),
            Self::Modes => (
                "modes",
                "Frequencies and shapes in which a robot swings at one posture or over a zone, where its masses are known",
            ),
            Self::Chatter => ("chatter", "Does a cut swing with the arm at one posture, and how deep may it go"),
            Self::Study => ("study", "Compare two architectures over link ratio and task size"),
            Self::Compare => {
                ("compare", "Two setups side by side: robots, tools, places; each may be a job file for place")
            }
            Self::Force => ("force", "Cutting force of a process: mean, extremes, moment and power"),
            Self::Mill => {
                ("mill", "How far is the tool pushed off along a toolpath, at the best rolls and the best place")
            }
            Self::Measure => ("measure", "Plan which postures and loads to measure, so that identify finds the drives"),
            Self::Identify => {
                ("identify", "Find how stiff the drives of a robot are, from deflections that were measured")
            }
            Self::Calibrate => (
                "calibrate",
                "Find how this very arm differs from its drawing, from points on its flange that a tracker measured",
            ),
            Self::Verify => (
                "robots verify",
                "Does a robot file count the joints as the pendant does? Three to ten postures read from it tell",
            ),
            Self::List => ("robots list", "The robots that come with the program, all or those that match"),
        }
    }
}
