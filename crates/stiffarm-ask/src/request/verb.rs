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

/// What is told of a verb: a row of [`VERBS`].
struct Row {
    verb: Verb,
    /// As it is typed.
    name: &'static str,
    /// What it does, in a line.
    about: &'static str,
    /// What its command tells besides.
    help: Help,
}

/// What a command tells besides its options.
#[derive(Clone, Copy, Debug)]
pub struct Help {
    /// What `-o` writes; empty where it writes nothing.
    pub files: &'static str,
    /// It shares out its work on threads.
    pub is_long: bool,
    /// What can be typed, and what that does.
    pub examples: &'static [(&'static str, &'static str)],
}

/// All of them, in the order in which help names them.
static VERBS: [Row; 15] = [
    Row {
        verb: Verb::Rank,
        name: "rank",
        about: "Rank robots for tasks; without arguments the ten robots of the paper on its six tasks",
        help: Help {
            files: "a report to hand on as .html or report.pdf, the ranking as .csv, .parquet, .json, .md or .txt, deflection against task size (planar) or bars with what is proved \
                (spatial) as .svg, .pdf or .png",
            is_long: true,
            examples: &[
                ("stiffarm rank", "the paper's ten robots on its six tasks"),
                (
                    "stiffarm rank --task rect:0.6x0.4 --tolerance-mm 2 -o report.html",
                    "a report: verdict, places, sources",
                ),
                (
                    "stiffarm rank --payload-kg 200.. --task rect:0.6x0.4 --tolerance-mm 2",
                    "every robot for 200 kg and more",
                ),
                (
                    "stiffarm rank --robots \"KR 210*,BT200L\" --task A:0.5 -o ranking.csv",
                    "some robots, to a spreadsheet",
                ),
                (
                    "stiffarm rank --model spatial --task rect:0.6x0.4 --tool spindle:250@90",
                    "all six drives, with a spindle",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Place,
        name: "place",
        about: "Find the best place of one zone, with a proof",
        help: Help {
            files: "a report to hand on as .html or report.pdf, the placement as .csv, .parquet, .json, .md or .txt, the arm, the zone and a map as \
                .svg, .pdf or .png, where the work must stand as shop.svg, a view in space that can be turned as view.html, its lines and faces for ParaView as .vtp",
            is_long: true,
            examples: &[
                (
                    "stiffarm place BT200L --task rect:0.5x1.0 --within 1.2..,0.4..1.8 --tolerance-mm 3",
                    "a table in front of it",
                ),
                (
                    "stiffarm place BT200L --task A:0.5 --tolerance-mm 3 --check",
                    "for scripts: exit code 3 where it fails",
                ),
                (
                    "stiffarm place \"KR 210 R2700 extra\" --task rect:0.6x0.4 --model spatial --tool spindle:250@90 -o place.view.html",
                    "all six drives, a spindle across the flange, and a view in space",
                ),
                ("stiffarm place BT200L --task A:0.5 --stiffness-nm-per-rad 2e6", "with joints of known stiffness"),
            ],
        },
    },
    Row {
        verb: Verb::Map,
        name: "map",
        about: "Map the deflection over everything a robot reaches",
        help: Help {
            files: "the cells as .csv, .parquet or .json, the answer as .md or .txt, the map as .svg, .pdf or .png, a view in space that can be \
                turned as .html, for ParaView the cells as .vti and the view as .vtp",
            is_long: true,
            examples: &[
                (
                    "stiffarm map \"KR 210 R2700 extra\" --zone B:0.5 -o map.png",
                    "the arm plane, and the best place of a zone",
                ),
                ("stiffarm map BT200L --direction-deg 30", "a force of known direction"),
                (
                    "stiffarm map BT200L --model spatial --tool-mm 0,0,200 --layer limit-margin -o margin.svg",
                    "how near the limits are",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Compliance,
        name: "compliance",
        about: "Six-axis compliance at one posture, and which drive gives how much",
        help: Help {
            files: "the 6 x 6 matrix as .csv or .parquet, the answer as .json, .md or .txt, a view in space that can be turned as .html, its lines for ParaView as .vtp",
            is_long: false,
            examples: &[(
                "stiffarm compliance \"KR 210 R2700 extra\" --joints-deg 0,-90,90,0,45,0 --tool-mm 0,0,150 --force-n 0,1000,0",
                "one posture under a force to the left",
            )],
        },
    },
    Row {
        verb: Verb::Modes,
        name: "modes",
        about: "Frequencies and shapes in which a robot swings at one posture or over a zone, where its masses are known",
        help: Help {
            files: "the modes as .csv or .parquet, of one posture their shapes as .svg, .pdf or .png, the answer as .json, .md or .txt",
            is_long: false,
            examples: &[
                (
                    "stiffarm modes \"KR 210 R2700-2\" --joints-deg 0,-90,90,0,45,0",
                    "the arm alone; stiffness by the prior, with intervals",
                ),
                (
                    "stiffarm modes \"KR 210 R2700-2\" --joints-deg 0,-90,90,0,45,0 --tool-mass-kg 60 --tool-com-mm 0,0,200",
                    "with a spindle of 60 kg, its centre 200 mm before the flange",
                ),
                (
                    "stiffarm modes \"KR 210 R2700-2\" --task rect:0.4x0.6 --at 1.5,0.8 --tool-mm 0,0,200 --tool-mass-kg 60 --tool-com-mm 0,0,200",
                    "over a zone at one place, with a proved least first frequency",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Chatter,
        name: "chatter",
        about: "Does a cut swing with the arm at one posture, and how deep may it go",
        help: Help {
            files: "depth over the speed of the spindle as .csv, .parquet, .svg, .pdf or .png, the answer as .json, .md or .txt",
            is_long: true,
            examples: &[
                (
                    "stiffarm chatter endmill.toml --robot \"KR 210 R2700-2\" --joints-deg 0,-90,90,0,90,0 --feed 1,0,0",
                    "a process file, at one posture, feeding forward",
                ),
                (
                    "stiffarm chatter endmill.toml --robot \"KR 210 R2700-2\" --joints-deg 0,-90,90,0,90,0 --feed 1,0,0 --damping-ratio 0.05 -o lobes.svg",
                    "with a damping that was measured, and the lobes as a figure",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Study,
        name: "study",
        about: "Compare two architectures over link ratio and task size",
        help: Help {
            files: "every accuracy as .csv, .parquet, .json, .md or .txt, the paper's Fig. 4 to 9 as .svg, .pdf or .png",
            is_long: true,
            examples: &[
                ("stiffarm study --tasks A,rect:1x3 --sizes 0.1,0.5", "two shapes"),
                (
                    "stiffarm study --compare serial,serial --k3 1,0.5 -o study.png",
                    "one architecture, a stiffer drive 3",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Compare,
        name: "compare",
        about: "Two setups side by side: robots, tools, places; each may be a job file for place",
        help: Help {
            files: "both placements as .csv, .parquet, .json, .md or .txt, both maps on one scale of colour as .svg, .pdf or .png",
            is_long: true,
            examples: &[
                (
                    "stiffarm compare \"KR 210 R2700 extra\" BT200L --task rect:0.6x0.4 --tolerance-mm 2 -o both.png",
                    "two robots, one task",
                ),
                (
                    "stiffarm compare short.toml long.toml --task rect:0.6x0.4 --model spatial",
                    "one robot with two tools: short.toml holds `verb = \"place\"`, `robot = \"BT200L\"` and `tool = \"spindle:250@90\"`; \
                 what a job file says comes before what is asked of both",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Force,
        name: "force",
        about: "Cutting force of a process: mean, extremes, moment and power",
        help: Help {
            files: "the force over a revolution as .csv or .parquet, the answer as .json, .md or .txt, the force across the tool axis as .svg, \
                .pdf or .png",
            is_long: false,
            examples: &[("stiffarm force endmill.toml -o force.svg", "a process file, and its figure")],
        },
    },
    Row {
        verb: Verb::Mill,
        name: "mill",
        about: "How far is the tool pushed off along a toolpath, at the best rolls and the best place",
        help: Help {
            files: "a report to hand on as .html or report.pdf, every sample as .csv or .parquet, the answer as .json, .md or .txt, error, rolls and path as .svg, .pdf or .png, \
                where the part must stand as shop.svg, with --chatter from which depth cuts swing as lobes.svg, the robot and the path in space as view.html, robot programs \
                as .src (KUKA), .mod (ABB) or .ls (Fanuc), a script for RoboDK as .py, a trajectory for ROS 2 as .yaml, lines for ParaView as .vtp, with --compensate the path itself as .nc, .gcode, .ngc, .tap, .apt or .cls",
            is_long: true,
            examples: &[
                (
                    "stiffarm mill part.nc --dry",
                    "lengths, moves, extents, feed rates, what was assumed and what ignored",
                ),
                (
                    "stiffarm mill part.nc --robot \"KR 210 R2700 extra\" --tool spindle:250@90 --process endmill.toml --tolerance-mm 0.3",
                    "the best place of the part, the best rolls, and whether the tolerance is held",
                ),
                (
                    "stiffarm mill part.nc --robot cell.toml --force-n 300,-120,80 --at 1.6,0,0.8,30 --compensate -o part.src -o part.svg",
                    "the part where it stands, its deflection taken out, and a KRL program",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Measure,
        name: "measure",
        about: "Plan which postures and loads to measure, so that identify finds the drives",
        help: Help {
            files: "the table to be filled in as .csv or .parquet, the plan as .json, .md or .txt, the postures as .svg, .pdf or .png",
            is_long: true,
            examples: &[
                (
                    "stiffarm measure \"KR 210 R2700 extra\" --load-mm 0,0,200 -o plan.csv",
                    "twenty runs with a weight; a table to be filled in",
                ),
                (
                    "stiffarm measure \"KR 210 R2700 extra\" --loads down,left --runs 30 --task rect:0.6x0.4 --compare mine.csv",
                    "with a pulley, for one work, and what your own choice is worth",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Identify,
        name: "identify",
        about: "Find how stiff the drives of a robot are, from deflections that were measured",
        help: Help {
            files: "a report to hand on as .html or report.pdf, the robot file as .toml, the drives as .csv, .parquet, .json, .md or .txt, what remains of every row as .svg, .pdf or .png",
            is_long: false,
            examples: &[
                (
                    "stiffarm identify measurements.csv --robot mine.toml --load-mm 0,50,200 -o identified.toml",
                    "a robot file that knows its drives, and how well",
                ),
                (
                    "stiffarm identify measurements.csv --robot \"R-2000iC/165F\" --marker-mm \"top=0,100,150;side=0,-100,150\" -o fit.svg",
                    "two markers, and a figure of what remains",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Calibrate,
        name: "calibrate",
        about: "Find how this very arm differs from its drawing, from points on its flange that a tracker measured",
        help: Help {
            files: "a report to hand on as .html or report.pdf, the robot file with its [calibration] as .toml, every row's error as .csv or .parquet, the answer as .json, .md or .txt, both errors along the rows as \
                .svg, .pdf or .png",
            is_long: false,
            examples: &[
                (
                    "stiffarm calibrate mine.toml tracker.csv --at 1.8,0,0.8 -o calibrated.toml -o errors.svg",
                    "from forty wide postures, with the error that remains about the work",
                ),
                (
                    "stiffarm calibrate \"R-2000iC/165F\" export.csv --columns joint_1_deg=J1,x1_mm=X --frame-by station --level geometry",
                    "a tracker's export, the tracker moved once",
                ),
            ],
        },
    },
    Row {
        verb: Verb::Verify,
        name: "robots verify",
        about: "Does a robot file count the joints as the pendant does? Three to ten postures read from it tell",
        help: Help {
            files: "the robot file that counts as the readings do as .toml, the ways of counting that fit best as .csv, .parquet, .json, .md or .txt",
            is_long: true,
            examples: &[
                (
                    "stiffarm robots verify \"KR 210 R2700 extra\" pendant.csv -o mine.toml",
                    "a robot file of which programs no longer warn that its joints may count otherwise; exit code 1 where it is not verified",
                ),
                ("stiffarm robots verify pendant.csv --any", "which robot is it?"),
            ],
        },
    },
    Row {
        verb: Verb::List,
        name: "robots list",
        about: "The robots that come with the program, all or those that match",
        help: Help {
            files: "the list as .csv, .parquet, .json, .md or .txt",
            is_long: false,
            examples: &[("stiffarm robots list abb 6700 --reach-m ..2.8", "some of one maker")],
        },
    },
];

impl Verb {
    /// All of them, in the order in which help names them.
    pub const ALL: [Self; VERBS.len()] = {
        let mut all = [Self::Rank; VERBS.len()];
        let mut i = 0;
        while i < all.len() {
            all[i] = VERBS[i].verb;
            i += 1;
        }
        all
    };

    /// Those that a job file may ask.
    pub fn jobs() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|verb| *verb != Self::List)
    }

    /// As it is typed.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// What it does, in a line of help.
    pub fn about(self) -> &'static str {
        self.row().about
    }

    /// What its command tells besides its options.
    pub fn help(self) -> Help {
        self.row().help
    }

    /// Its function in Python.
    pub fn function(self) -> &'static str {
        self.name().rsplit(' ').next().unwrap_or_default()
    }

    fn row(self) -> &'static Row {
        VERBS.iter().find(|row| row.verb == self).expect("every verb has a row")
    }
}
