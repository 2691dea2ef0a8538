//! Which options are there? One row each, from which every face builds its parser, its help and its refusals.

mod measuring;
pub(super) mod milling;
mod reading;
mod swinging;

use super::kind::{ANY, Count, Kind, count, count_of, degrees_of, number_of, one_or};
use stiffarm::cell::MOST_BLOCKS;

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

    /// Its rows, in the order in which help tells them.
    pub fn settings(self) -> impl Iterator<Item = &'static Setting> {
        SETTINGS.iter().filter(move |setting| setting.verbs.contains(&self))
    }

    /// The row of a name.
    pub fn setting(self, name: &str) -> Option<&'static Setting> {
        self.settings().find(|setting| setting.name == name)
    }
}

/// Which model an option belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// Every model, and verbs that have only one.
    Any,
    /// The paper's.
    Planar,
    /// All six drives.
    Spatial,
}

/// What happens where an option is not given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absent {
    /// As if this were given.
    Default(&'static str),
    /// What a value cannot say, in words.
    Means(&'static str),
    /// Nothing that needs words.
    Optional,
    /// It must be given.
    Required,
}

/// One option.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// The long name: `--NAME` on the command line, `NAME` in a job file.
    pub name: &'static str,
    /// The keyword in Python, where it is not the name with underscores.
    pub keyword: &'static str,
    /// The verbs that know it.
    pub verbs: &'static [Verb],
    /// The models that know it.
    pub of: Of,
    /// What it takes.
    pub kind: Kind,
    /// How many of that.
    pub count: Count,
    /// For help; empty where there is none.
    pub unit: &'static str,
    /// What stands for its value in help.
    pub value: &'static str,
    /// Without it.
    pub absent: Absent,
    /// In a verb, the option without which it has no meaning; of several each will do.
    pub needs: &'static [(Verb, &'static str)],
    /// Options that say the same in another way.
    pub excludes: &'static [&'static str],
    /// One line.
    pub help: &'static str,
    /// Under which heading help tells it; empty for the usual.
    pub heading: &'static str,
    /// A value that is understood.
    pub example: &'static str,
    /// On the command line it stands without its name.
    pub is_positional: bool,
}

impl Setting {
    /// Options of which one is needed in a verb; none where it stands alone.
    pub fn needed_by(&self, verb: Verb) -> impl Iterator<Item = &'static str> {
        self.needs.iter().filter(move |(of, _)| *of == verb).map(|(_, name)| *name)
    }

    /// Several values may be given.
    pub fn is_list(&self) -> bool {
        1 < self.count.most
    }

    /// It changes the figures of the program, and no number.
    pub fn is_of_figures(&self) -> bool {
        self.heading == DRAWN
    }

    /// Its keyword in Python.
    pub fn keyword(&self) -> String {
        if self.keyword.is_empty() { self.name.replace('-', "_") } else { self.keyword.into() }
    }

    /// The line of help with the unit in brackets behind its first clause, and what happens without the option.
    pub fn described(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" [{}]", self.unit) };
        let clause = self.help.find([':', ',', ';']).unwrap_or(self.help.len());
        let (first, rest) = self.help.split_at(clause);
        let absent = match self.absent {
            Absent::Means(words) => format!(" [default: {words}]"),
            _ => String::new(),
        };
        let model = if self.of == Of::Planar { " [planar model only]" } else { "" };
        format!("{first}{unit}{rest}{absent}{model}")
    }
}

/// Under which heading help tells what chooses among robots.
pub(super) const FILTERS: &str = "Which robots";

const ONE: Count = count_of(1, 1, "values", "one");
const SEVERAL: Count = count_of(1, ANY, "values", "some");
const EACH: Count = count_of(1, 2, "values", "one for both architectures, or two");
const RANK: &[Verb] = &[Verb::Rank];
const PLACE: &[Verb] = &[Verb::Place];
const MAP: &[Verb] = &[Verb::Map];
const COMPLIANCE: &[Verb] = &[Verb::Compliance];
/// Those that look at one posture.
const POSTURE: &[Verb] = &[Verb::Compliance, Verb::Modes, Verb::Chatter];
const STUDY: &[Verb] = &[Verb::Study];
const COMPARE: &[Verb] = &[Verb::Compare];
/// Those that bend drives.
const SPRINGING: &[Verb] = &[
    Verb::Rank,
    Verb::Place,
    Verb::Map,
    Verb::Compliance,
    Verb::Modes,
    Verb::Chatter,
    Verb::Compare,
    Verb::Measure,
    Verb::Mill,
];
const PLACING: &[Verb] = &[Verb::Rank, Verb::Place, Verb::Map, Verb::Compare];
/// Those that hold a tool against a zone.
const HOLDING: &[Verb] = &[Verb::Rank, Verb::Place, Verb::Map, Verb::Compare, Verb::Modes];
/// Those that place zones and nothing else.
const ONLY_PLACING: &[Verb] = &[Verb::Rank, Verb::Place, Verb::Compare];
/// Those that tell deflections of robots.
const BENDING: &[Verb] = &[Verb::Rank, Verb::Place, Verb::Map, Verb::Compliance, Verb::Compare];
const CHOOSING: &[Verb] = &[Verb::Rank, Verb::Mill, Verb::List];
const A_ZONE: &[(Verb, &str)] = &[(Verb::Map, "zone"), (Verb::Modes, "task")];
const WITH_FORCE: &[(Verb, &str)] =
    &[(Verb::Rank, "force-n"), (Verb::Place, "force-n"), (Verb::Map, "force-n"), (Verb::Compare, "force-n")];

/// What a row has where it says nothing else.
const ROW: Setting = Setting {
    name: "",
    keyword: "",
    verbs: &[],
    of: Of::Any,
    kind: Kind::Text,
    count: ONE,
    unit: "",
    value: "",
    absent: Absent::Optional,
    needs: &[],
    excludes: &[],
    help: "",
    heading: "",
    example: "",
    is_positional: false,
};
/// One of two that are compared.
const SETUP: Setting =
    Setting { verbs: COMPARE, kind: Kind::Robot, absent: Absent::Required, is_positional: true, ..ROW };
/// Those along which a force of three numbers points.
const AXES: Kind = Kind::Word(&[
    ("base", "Those of the base: ahead, to the left, up"),
    (
        "tool",
        "Those of the work: along the feed, across it (left of the feed, seen from the spindle), axial (away from the work)",
    ),
]);
/// Of the drives' compliances in a study.
const RELATIVE: Setting = Setting {
    verbs: STUDY,
    kind: Kind::Number { min: 1e-3, max: 1e3, of: "times the reference, or 0 for a rigid drive", or_zero: true },
    count: EACH,
    value: "K",
    absent: Absent::Default("1"),
    example: "0.5",
    ..ROW
};
/// Of the drives' springs.
const SPRINGS: Setting = Setting {
    verbs: SPRINGING,
    count: one_or(6, "values", "one for every drive, or six, separated by commas"),
    value: "K",
    heading: "Stiffness",
    ..ROW
};
/// Who says how stiff they are.
const WHOSE: Setting = Setting {
    name: "stiffness",
    kind: Kind::Word(&[
        ("paper", "1 urad/(N m) on every drive, as the paper assumes"),
        (
            "prior",
            "As published of the robot, else as robots of its payload and reach have it; and how far that may be off",
        ),
        ("file", "As the robot file has it; robots whose file says nothing are refused"),
    ]),
    count: ONE,
    value: "WHOSE",
    excludes: &["drive-urad-per-nm", "stiffness-nm-per-rad"],
    help: "How stiff the drives are taken to be",
    ..SPRINGS
};
/// Of what every place keeps.
const MARGIN: Setting = Setting { verbs: HOLDING, needs: A_ZONE, heading: "Margins; 0 or none gives them up", ..ROW };
/// Of the tool's pose.
const TOOL: Setting = Setting { verbs: PLACING, of: Of::Spatial, value: "DEG", heading: "Model", ..ROW };
/// The same, as spindles are described.
const SPINDLE: Setting = Setting {
    kind: Kind::Spindle,
    unit: "mm, deg",
    value: "TOOL",
    excludes: &["tool-mm"],
    help: "The tool by its shape: spindle:LENGTH@ANGLE+OFFSET, ANGLE between tool axis and flange axis (it leans towards the flange's x, \
           and joint 6 turns it), OFFSET from the flange to where they cross",
    example: "spindle:250@90+30",
    ..TOOL
};
/// The six joints of a posture.
const JOINTS: Setting = Setting {
    name: "joints-deg",
    kind: degrees_of(1080.0, "degrees for each of six joints"),
    count: count(6, "angles", "six, separated by commas"),
    unit: "deg",
    value: "Q1,..,Q6",
    absent: Absent::Required,
    help: "The six joint angles as the robot reports them, separated by commas",
    example: "0,-90,90,0,45,0",
    ..ROW
};
/// Where the tool points.
const TOOL_DIRECTION: Setting = Setting {
    name: "tool-direction",
    kind: Kind::Elevation,
    value: "DIRECTION",
    absent: Absent::Means("down"),
    help: "The tool axis: down, forward, up, or its angle above the horizontal in degrees",
    example: "forward",
    ..TOOL
};
/// Which way a zone faces.
const YAW: Setting = Setting {
    name: "yaw-deg",
    verbs: ONLY_PLACING,
    kind: Kind::Yaw,
    unit: "deg",
    absent: Absent::Means("the best of -90..90"),
    help: "Angle of the zone about the vertical, 0 faces the robot; or any",
    example: "30",
    ..TOOL
};
/// How the tool is turned about its axis.
const ROLL: Setting = Setting {
    name: "roll-deg",
    kind: degrees_of(360.0, "degrees"),
    unit: "deg",
    absent: Absent::Means("the best"),
    help: "Rotation about the tool axis; 0 has the tool's x axis ahead, on a wall upright",
    example: "45",
    ..TOOL
};
/// What pushes on the tool in a zone.
const CUTTING_FORCE: Setting = Setting {
    name: "force-n",
    kind: Kind::Force,
    unit: "N",
    value: "N",
    absent: Absent::Default("1000"),
    help: "Cutting force: its size, in its worst direction; or three numbers along the feed, across it and axial (away from the work), in the planar model ahead,0,up",
    example: "300,0,100",
    ..ROW
};
/// What the tool weighs.
const MASS: Setting = Setting {
    name: "tool-mass-kg",
    kind: number_of(0.0, 1e4, "kg"),
    unit: "kg",
    value: "KG",
    help: "Mass of the tool with its spindle: told against the robot's payload, beside the force",
    example: "25",
    ..ROW
};
/// Where the tool's mass is.
const MASS_CENTRE: Setting = Setting {
    name: "tool-com-mm",
    kind: number_of(-1e4, 1e4, "mm"),
    count: count(3, "numbers", "three, separated by commas"),
    unit: "mm",
    value: "X,Y,Z",
    help: "Mass centre of the tool in the flange frame: x,y,z; with its mass",
    example: "0,0,200",
    ..ROW
};
/// Of the place where the robot works.
const CELL: Setting = Setting { verbs: ONLY_PLACING, of: Of::Spatial, heading: "Cell", ..ROW };
/// The heading of what matters to the program's figures alone.
const DRAWN: &str = "Figure";
/// Of the figure alone.
const FIGURE: Setting = Setting { verbs: PLACING, heading: DRAWN, ..ROW };
/// Of the catalogue.
const FILTER: Setting = Setting { verbs: CHOOSING, value: "NAME", heading: FILTERS, ..ROW };

/// Every option, each once for the verbs in which it means the same.
pub static SETTINGS: &[Setting] = &joined::<
    { OF_ZONES.len() + swinging::ROWS.len() + measuring::ROWS.len() + reading::ROWS.len() + milling::ROWS.len() },
>([OF_ZONES, swinging::ROWS, measuring::ROWS, reading::ROWS, milling::ROWS]);

/// One list of four.
const fn joined<const N: usize>(lists: [&[Setting]; 5]) -> [Setting; N] {
    let (mut all, mut filled, mut list) = ([ROW; N], 0, 0);
    while list < lists.len() {
        let mut i = 0;
        while i < lists[list].len() {
            all[filled] = lists[list][i];
            filled += 1;
            i += 1;
        }
        list += 1;
    }
    all
}

/// What is asked of robots and zones.
const OF_ZONES: &[Setting] = &[
    Setting {
        name: "robot",
        verbs: &[Verb::Place, Verb::Map, Verb::Compliance, Verb::Modes, Verb::Measure, Verb::Calibrate],
        kind: Kind::Robot,
        value: "ROBOT",
        absent: Absent::Required,
        help: "A robot's name, or the path of a robot file",
        example: "KR 210 R2700 extra",
        is_positional: true,
        ..ROW
    },
    Setting {
        name: "a",
        value: "A",
        help: "The first setup: a robot's name, the path of a robot file, or a job file for place, which may say more",
        example: "KR 210 R2700 extra",
        ..SETUP
    },
    Setting { name: "b", value: "B", help: "The second setup, in the same way", example: "BT200L", ..SETUP },
    Setting {
        name: "robots",
        verbs: RANK,
        kind: Kind::Robot,
        count: SEVERAL,
        value: "ROBOTS",
        absent: Absent::Means("paper; all where robots are chosen by maker, payload, reach, architecture or status"),
        help: "Robots: names, patterns (*), files, folders, or the sets `paper` and `all`; separated by commas or given several times",
        example: "KR 210*,BT200L",
        ..ROW
    },
    Setting {
        name: "task",
        keyword: "tasks",
        verbs: RANK,
        kind: Kind::Task,
        count: SEVERAL,
        value: "TASK",
        absent: Absent::Default("A:0.1,A:1.0,B:0.1,B:0.5,C:0.05,C:0.15"),
        help: "Tasks: circle:D, rect:AxB, A:d, B:d, C:d with sizes in m, or with --model spatial a part, box:AxBxC; separated by commas or given several times; or a toolpath alone, with the options of mill",
        example: "A:0.3,rect:0.6x0.4",
        ..ROW
    },
    Setting {
        name: "task",
        verbs: PLACE,
        kind: Kind::Task,
        value: "TASK",
        absent: Absent::Required,
        help: "circle:D, rect:AxB, A:d, B:d, C:d with sizes in m, or with --model spatial a part: box:AxBxC, or part: and its faces; or a toolpath, with the options of mill",
        example: "rect:0.6x0.4",
        ..ROW
    },
    Setting {
        name: "task",
        verbs: COMPARE,
        kind: Kind::Task,
        value: "TASK",
        help: "Of setups whose job files name none: circle:D, rect:AxB, A:d, B:d, C:d with sizes in m, or with --model spatial a part",
        example: "rect:0.6x0.4",
        ..ROW
    },
    Setting {
        name: "faces",
        verbs: ONLY_PLACING,
        of: Of::Spatial,
        kind: Kind::Text,
        count: SEVERAL,
        value: "FACES",
        absent: Absent::Means("all: of a box top, front, left, back, right"),
        help: "Which faces of a part are machined, by name, separated by commas; front faces the robot before the part is turned",
        example: "top,front",
        ..ROW
    },
    Setting {
        name: "tolerance-mm",
        verbs: PLACING,
        kind: number_of(1e-6, 1e3, "mm"),
        unit: "mm",
        value: "MM",
        help: "Largest deflection that is acceptable: adds pass or fail; in figures a line",
        example: "2",
        ..ROW
    },
    Setting { verbs: ONLY_PLACING, ..MASS },
    Setting {
        verbs: ONLY_PLACING,
        needs: &[(Verb::Rank, "tool-mass-kg"), (Verb::Place, "tool-mass-kg"), (Verb::Compare, "tool-mass-kg")],
        ..MASS_CENTRE
    },
    Setting {
        name: "elbow",
        verbs: MAP,
        of: Of::Planar,
        kind: Kind::Word(&[("up", ""), ("down", "")]),
        value: "ELBOW",
        absent: Absent::Means("the stiffer that reaches a point"),
        help: "Only one elbow side",
        example: "up",
        ..ROW
    },
    Setting {
        name: "posture",
        verbs: MAP,
        of: Of::Spatial,
        kind: Kind::Posture,
        value: "POSTURE",
        absent: Absent::Means("the stiffest at each point"),
        help: "Only one posture, with --model spatial: such as front,up,no-flip",
        example: "front,up,no-flip",
        ..ROW
    },
    Setting {
        name: "quantity",
        verbs: MAP,
        of: Of::Spatial,
        kind: Kind::Word(&[
            ("deflection", "The deflection"),
            (
                "first-frequency",
                "Besides it how slow the arm swings first, which the figure shows; of robots with masses",
            ),
        ]),
        value: "QUANTITY",
        absent: Absent::Default("deflection"),
        help: "What is mapped, with --model spatial",
        example: "first-frequency",
        ..ROW
    },
    Setting {
        name: "layer",
        verbs: MAP,
        of: Of::Spatial,
        kind: Kind::Word(&[
            ("deflection", "The worst deflection"),
            ("limit-margin", "How far the nearest joint limit is"),
            ("singular-margin", "How far the nearest singular posture is"),
            ("first-frequency", "How slow the arm swings first, with --quantity first-frequency"),
        ]),
        value: "LAYER",
        absent: Absent::Means("what is mapped"),
        help: "What the figure shows, with --model spatial; the tables have all of it",
        heading: DRAWN,
        example: "limit-margin",
        ..ROW
    },
    Setting {
        name: "zone",
        verbs: MAP,
        of: Of::Planar,
        kind: Kind::Task,
        value: "TASK",
        help: "Draw the best placement of this task",
        example: "B:0.5",
        ..ROW
    },
    Setting {
        name: "step-m",
        verbs: MAP,
        kind: number_of(1e-6, 10.0, "m"),
        unit: "m",
        value: "M",
        excludes: &["size"],
        help: "Distance between points",
        example: "0.05",
        ..ROW
    },
    Setting {
        name: "size",
        verbs: MAP,
        kind: Kind::Whole { min: 2, max: 100_000 },
        value: "N",
        absent: Absent::Default("400"),
        excludes: &["step-m"],
        help: "Points along the longer side",
        example: "60",
        ..ROW
    },
    Setting { verbs: &[Verb::Rank, Verb::Place], excludes: &["process"], ..CUTTING_FORCE },
    Setting { verbs: &[Verb::Map, Verb::Compare], ..CUTTING_FORCE },
    Setting {
        name: "process",
        verbs: &[Verb::Rank, Verb::Place],
        of: Of::Spatial,
        kind: Kind::File,
        value: "PROCESS",
        excludes: &["force-n"],
        help: "A process file (TOML) in place of the cutting force: its mean force over a revolution acts along feed, across and axial; its moment is left out",
        example: "endmill.toml",
        ..ROW
    },
    Setting {
        name: "force-axes",
        verbs: PLACING,
        of: Of::Spatial,
        kind: AXES,
        value: "AXES",
        absent: Absent::Means("tool"),
        needs: WITH_FORCE,
        help: "Along which axes a force of three numbers points",
        example: "base",
        ..ROW
    },
    Setting {
        name: "feed-deg",
        verbs: PLACING,
        of: Of::Spatial,
        kind: degrees_of(360.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("the worst of all directions"),
        needs: WITH_FORCE,
        help: "Direction of the feed in the face, from the first side of the zone towards the second; of a circle and of a map from straight ahead, on a wall from upright",
        example: "30",
        ..ROW
    },
    Setting {
        name: "direction-deg",
        verbs: PLACING,
        of: Of::Planar,
        kind: degrees_of(360.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("the worst in every point"),
        help: "Direction of the force in the arm plane, counter-clockwise from straight ahead",
        example: "30",
        ..ROW
    },
    Setting {
        name: "force-cone-deg",
        verbs: BENDING,
        kind: number_of(0.0, 90.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("0"),
        needs: &[(Verb::Compliance, "force-n")],
        help: "Half angle of a cone about its direction in which the force may point: the largest deflection over it",
        example: "20",
        ..ROW
    },
    Setting {
        name: "component",
        verbs: BENDING,
        kind: Kind::Word(&[
            ("total", "All of the displacement"),
            ("normal", "Its part along the tool axis, normal to the face"),
            ("along", "Its part along the force"),
        ]),
        value: "COMPONENT",
        absent: Absent::Default("total"),
        needs: &[(Verb::Compliance, "force-n")],
        help: "What of the displacement counts",
        example: "along",
        ..ROW
    },
    Setting {
        name: "at",
        verbs: PLACING,
        kind: number_of(-1e3, 1e3, "m"),
        count: count_of(2, 2, "numbers", "x,z in m"),
        unit: "m",
        value: "X,Z",
        absent: Absent::Means("the best place within --within"),
        needs: A_ZONE,
        excludes: &["within"],
        help: "The one place where the middle of the zone stands: so far ahead of the robot's base and so far above it, or with --mount above the cell's floor; of a rectangle with --angle 0 unless another is given",
        example: "1.5,0.8",
        ..ROW
    },
    Setting {
        name: "within",
        keyword: "within_m",
        verbs: PLACING,
        excludes: &["at"],
        kind: Kind::Within,
        value: "RANGES",
        absent: Absent::Means("in front of the joint-1 axis, above the floor"),
        count: count_of(1, MOST_BLOCKS, "windows", "at most eight"),
        needs: A_ZONE,
        help: "Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 about it, or x0..x1,y0..y1,z0..z1 in the cell (several with ; between); ranges may be left open, and with --mount count from the cell's floor",
        example: "1.0..,0.5..2",
        ..ROW
    },
    Setting {
        name: "limit-margin-deg",
        kind: number_of(0.0, 90.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("5"),
        help: "What every joint keeps from either end of its range, all over the zone",
        example: "10",
        ..MARGIN
    },
    Setting {
        name: "singular-margin-deg",
        kind: number_of(0.0, 45.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("5"),
        help: "What wrist and arm keep from straight, all over the zone",
        example: "10",
        ..MARGIN
    },
    Setting {
        name: "clear-of-base-m",
        kind: number_of(0.0, 100.0, "m"),
        unit: "m",
        value: "M",
        absent: Absent::Means("the robot's own column, estimated as a1 + 0.15 (c2 + l3)"),
        help: "What the zone keeps from the joint-1 axis",
        example: "0.8",
        ..MARGIN
    },
    Setting {
        name: "floor",
        keyword: "floor_m",
        kind: Kind::Floor,
        unit: "m",
        value: "M",
        absent: Absent::Means("0, unless --within says how low the zone may stand"),
        help: "Height of the floor from the robot's base, or none; all of the zone stands above it",
        example: "-0.5",
        ..MARGIN
    },
    Setting {
        name: "angle",
        verbs: HOLDING,
        kind: Kind::Angle,
        value: "ANGLE",
        absent: Absent::Default("axes"),
        needs: A_ZONE,
        help: "Angle of a rectangle: axes (horizontal or vertical; under a force with --feed-deg all four quarter turns), horizontal, vertical (its long side), free, or degrees of its first side",
        example: "30",
        ..ROW
    },
    Setting {
        name: "gap",
        verbs: PLACING,
        of: Of::Planar,
        kind: number_of(1e-9, 0.5, "(relative)"),
        value: "RATIO",
        absent: Absent::Means("0.0001"),
        needs: A_ZONE,
        help: "Largest relative distance between a value and its proof",
        example: "0.001",
        ..ROW
    },
    Setting { verbs: &[Verb::Compliance, Verb::Chatter], ..JOINTS },
    Setting {
        name: "force-n",
        verbs: COMPLIANCE,
        kind: Kind::Force,
        unit: "N",
        value: "X,Y,Z",
        help: "Force at the tool point: x,y,z in base axes, or its size, in its worst direction",
        example: "0,1000,0",
        ..ROW
    },
    Setting {
        name: "force-axes",
        verbs: COMPLIANCE,
        kind: AXES,
        value: "AXES",
        absent: Absent::Means("base"),
        needs: &[(Verb::Compliance, "force-n")],
        help: "Along which axes a force of three numbers points",
        example: "tool",
        ..ROW
    },
    Setting {
        name: "feed-deg",
        verbs: COMPLIANCE,
        kind: degrees_of(360.0, "degrees"),
        unit: "deg",
        value: "DEG",
        absent: Absent::Means("the worst of all directions"),
        needs: &[(Verb::Compliance, "force-axes")],
        help: "Direction of the feed of a force along tool axes, from the tool's x axis, counter-clockwise seen from the spindle",
        example: "30",
        ..ROW
    },
    Setting {
        name: "tool-mm",
        verbs: POSTURE,
        kind: Kind::Tool,
        unit: "mm, deg",
        value: "X,Y,Z",
        absent: Absent::Means("the flange centre"),
        excludes: &["tool"],
        help: "Tool frame in the flange frame: x,y,z or x,y,z,rx,ry,rz about fixed axes",
        example: "0,0,150",
        ..ROW
    },
    Setting { name: "tool", verbs: POSTURE, of: Of::Any, heading: "", ..SPINDLE },
    Setting {
        name: "tasks",
        verbs: STUDY,
        kind: Kind::Shape,
        count: SEVERAL,
        value: "SHAPES",
        absent: Absent::Default("A,B,C"),
        help: "Shapes at size 1: A, B, C, or such as rect:1x3; the shape of the task is studied besides, and instead where nothing is said here",
        example: "A,rect:1x3",
        ..ROW
    },
    Setting {
        name: "robot",
        verbs: STUDY,
        kind: Kind::Robot,
        value: "ROBOT",
        needs: &[(Verb::Study, "task")],
        help: "A robot that is to be found among all this with its task: a name, or the path of a robot file",
        example: "KR 210 R2700 extra",
        ..ROW
    },
    Setting {
        name: "task",
        verbs: STUDY,
        kind: Kind::Task,
        value: "TASK",
        help: "A flat zone at its size, whose shape is studied: where it stands with a robot is marked, and told which architecture is stiffer there",
        example: "rect:0.6x0.4",
        ..ROW
    },
    Setting {
        name: "sizes",
        verbs: STUDY,
        kind: number_of(1e-4, 10.0, "times l2 + l3"),
        count: SEVERAL,
        value: "SIZES",
        absent: Absent::Default("0.1,0.3,0.5,0.8"),
        help: "Sizes over l2 + l3",
        example: "0.1,0.5",
        ..ROW
    },
    Setting {
        name: "ratios",
        verbs: STUDY,
        kind: number_of(0.05, 20.0, "(l3 over l2)"),
        count: SEVERAL,
        value: "RATIOS",
        absent: Absent::Default("0.8,1,1.2"),
        help: "Link ratios mu = l3/l2",
        example: "0.9",
        ..ROW
    },
    Setting {
        name: "range",
        verbs: STUDY,
        kind: Kind::Range { is_bounded: true },
        value: "RANGE",
        absent: Absent::Default("0.5..1.5"),
        help: "Link ratios among which the best is sought",
        example: "0.6..1.4",
        ..ROW
    },
    Setting {
        name: "compare",
        verbs: STUDY,
        kind: Kind::ARCHITECTURE,
        count: count(2, "architectures", "two, e.g. serial,quasi-serial"),
        value: "TWO",
        absent: Absent::Default("serial,quasi-serial"),
        help: "The two architectures that are compared",
        example: "serial,serial",
        ..ROW
    },
    Setting {
        name: "k2",
        help: "Compliance of drive 2 over the reference k, for both or one each; 0: rigid",
        ..RELATIVE
    },
    Setting {
        name: "k3",
        help: "Compliance of drive 3 over the reference k, for both or one each; 0: rigid",
        ..RELATIVE
    },
    Setting {
        verbs: PLACING,
        absent: Absent::Means("as the robot file has it, else paper in the planar model and prior in space"),
        example: "prior",
        ..WHOSE
    },
    Setting {
        verbs: &[Verb::Compliance, Verb::Modes, Verb::Chatter, Verb::Measure],
        absent: Absent::Means("as the robot file has it, else prior"),
        example: "paper",
        ..WHOSE
    },
    Setting {
        name: "drive-urad-per-nm",
        kind: Kind::Number { min: 1e-3, max: 1e4, of: "urad/(N m), or 0 for a rigid drive", or_zero: true },
        unit: "urad/(N m)",
        absent: Absent::Means("as --stiffness says"),
        excludes: &["stiffness-nm-per-rad", "stiffness"],
        help: "Compliance of the drives: one for all six, or six; of every robot that is asked for",
        example: "0.5,0.5,0.8,2,3,3",
        ..SPRINGS
    },
    Setting {
        name: "stiffness-nm-per-rad",
        kind: number_of(100.0, 1e9, "N m/rad"),
        unit: "N m/rad",
        excludes: &["drive-urad-per-nm", "stiffness"],
        help: "The same as a stiffness: one for all six drives, or six",
        example: "2e6",
        ..SPRINGS
    },
    Setting {
        name: "model",
        verbs: PLACING,
        kind: Kind::Word(&[
            ("planar", "The paper's: drives 2 and 3, the wrist centre, zones in the arm plane"),
            ("spatial", "All six drives, the tool where it is, flat zones that the tool axis meets at a right angle"),
        ]),
        value: "MODEL",
        absent: Absent::Default("planar"),
        help: "Which model",
        heading: "Model",
        example: "spatial",
        ..ROW
    },
    Setting {
        name: "tool-mm",
        kind: Kind::Tool,
        unit: "mm, deg",
        value: "X,Y,Z",
        absent: Absent::Means("the flange"),
        excludes: &["tool"],
        help: "Tool frame in the flange frame: x,y,z or x,y,z,rx,ry,rz about fixed axes; its z is the tool axis",
        example: "0,0,200",
        ..TOOL
    },
    Setting { name: "tool", ..SPINDLE },
    TOOL_DIRECTION,
    YAW,
    ROLL,
    Setting {
        name: "mount",
        kind: Kind::Mount,
        value: "MOUNT",
        absent: Absent::Means("floor"),
        help: "How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical",
        example: "pedestal:0.5",
        ..CELL
    },
    Setting {
        name: "keep-out",
        kind: Kind::Block { of: "m", is_bounded: false },
        count: count_of(1, MOST_BLOCKS, "boxes", "at most eight"),
        unit: "m",
        value: "BOX",
        help: "What must be kept free: x0..x1,y0..y1,z0..z1 in the cell; several with ; between, or given several times",
        example: "1.0..2.0,-3.0..-1.5,..1.2",
        ..CELL
    },
    Setting {
        name: "clearance-mm",
        kind: number_of(0.0, 5e3, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Means("reported, none required"),
        help: "Smallest distance of the arm, links as capsules, from floor, work, itself and what is kept free",
        example: "50",
        ..CELL
    },
    Setting {
        name: "scale",
        kind: Kind::Range { is_bounded: true },
        unit: "mm, deg of margins, Hz of frequencies",
        value: "RANGE",
        absent: Absent::Means("what is found"),
        help: "From where to where the figure goes: A..B; the same for figures that are to be compared",
        example: "0..5",
        ..FIGURE
    },
    Setting {
        name: "width-mm",
        verbs: &[
            Verb::Rank,
            Verb::Place,
            Verb::Map,
            Verb::Study,
            Verb::Compare,
            Verb::Identify,
            Verb::Measure,
            Verb::Calibrate,
            Verb::Force,
            Verb::Modes,
            Verb::Chatter,
            Verb::Mill,
        ],
        kind: number_of(40.0, 2000.0, "mm"),
        unit: "mm",
        value: "MM",
        absent: Absent::Means("1000 px"),
        help: "Width of the figure on paper, for svg, pdf and png at 300 dpi",
        example: "170",
        ..FIGURE
    },
    Setting {
        name: "vendor",
        count: SEVERAL,
        help: "Only robots of these makers, separated by commas",
        example: "KUKA,ABB",
        ..FILTER
    },
    Setting {
        name: "payload-kg",
        kind: Kind::Range { is_bounded: false },
        unit: "kg",
        value: "RANGE",
        help: "Only robots with a payload in this range: A..B; either end may be left open",
        example: "200..",
        ..FILTER
    },
    Setting {
        name: "reach-m",
        kind: Kind::Range { is_bounded: false },
        unit: "m",
        value: "RANGE",
        help: "Only robots with a reach in this range: A..B; either end may be left open",
        example: "..2.8",
        ..FILTER
    },
    Setting {
        name: "architecture",
        kind: Kind::ARCHITECTURE,
        help: "Only robots of this architecture: serial or quasi-serial",
        example: "serial",
        ..FILTER
    },
    Setting {
        name: "status",
        kind: Kind::STATUS,
        count: SEVERAL,
        help: "Only robots of these statuses: identified, data-sheet, derived, estimated; separated by commas",
        example: "data-sheet,derived",
        ..FILTER
    },
];
