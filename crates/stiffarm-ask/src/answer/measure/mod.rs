//! How is a plan of measurements reported?

mod geometry;

use nalgebra::Vector3;
use serde_json::{Value, json};

use super::numbers::digits;
use super::words::{self, fixed};
use super::{
    Cell, Column, ColumnKind, Datum, Line, Record, Rows, Table, Unit, field, line, shape, stiffness, with_schema,
};
use stiffarm::identify::MOST_RELATIVE_ERROR;
use stiffarm::limits::Pendant;
use stiffarm::measure::{Cone, Criterion, Instrument, Options, Plan, Run};
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;

pub use geometry::GeometryAnswer;

/// What a plan is judged by, and how many of the unit in which that is reported are one in SI: (um/N)^2, or nothing of parts.
const fn judged(criterion: Criterion) -> (&'static str, f64) {
    match criterion {
        Criterion::Prediction => ("mean variance of the predicted deflection over the work", 1e12),
        Criterion::A => ("A: mean variance of the drives, in parts of their compliances", 1.0),
        Criterion::D => ("D: volume of the errors of the drives, as a variance in parts of their compliances", 1.0),
    }
}

/// The answer of `measure`, with what was asked.
#[derive(Clone, Debug)]
pub struct MeasureAnswer {
    /// Which robot.
    pub robot: Robot,
    /// What was asked.
    pub options: Options,
    /// What the work is, in words.
    pub work: String,
    /// What was found.
    pub plan: Plan,
    /// A table of one's own: its name, how many runs, value and efficiency.
    pub compared: Option<(String, usize, f64, f64)>,
}

/// One posture of a plan as a picture has it: seen from the side of the arm, which is turned to the right. Lengths in m: ahead of the joint-1
/// axis along the heading of the arm, and up from the base.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPosture {
    /// Its first and its last run, from 1: those that stand the same under the same load.
    pub runs: [usize; 2],
    /// Joint 1 as the robot reports it, deg.
    pub joint_1: f64,
    /// Joint-2 axis, elbow, wrist centre and flange.
    pub points: [[f64; 2]; 4],
    /// What is looked at.
    pub markers: Vec<[f64; 2]>,
    /// The load, where there is one.
    pub load: Option<DrawnLoad>,
}

/// The load of a posture as a picture has it.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnLoad {
    /// Where it acts, and where it points, of length 1 or less where it leaves the plane of the arm.
    pub arrow: [[f64; 2]; 2],
    /// In words.
    pub text: String,
    /// How far the marker that moves most is expected to move, mm.
    pub expected_mm: f64,
}

impl DrawnPosture {
    /// Where a load acts, where there is one.
    pub fn loaded(&self) -> Option<&[f64; 2]> {
        self.load.as_ref().map(|load| &load.arrow[0])
    }

    /// Run `number`, from 1, at joint angles as reported, rad, with points of the flange frame, m, and what stands there; `None` of a robot of two links.
    fn of(
        robot: &Robot,
        (number, q): (usize, &[f64; 6]),
        markers: &[Vector3<f64>],
        load: impl FnOnce(&Seen) -> Option<DrawnLoad>,
    ) -> Option<Self> {
        let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return None };
        let theta = geometry.model_angles(q, limits.third_axis);
        let seen = Seen { flange: geometry.forward(&theta), heading: theta[0] };
        let [_, points @ ..] = geometry.points(&theta);
        Some(Self {
            runs: [number; 2],
            joint_1: in_degrees(q)[0],
            points: points.map(|point| seen.aside(&Vector3::from(point))),
            markers: markers.iter().map(|point| seen.at(point)).collect(),
            load: load(&seen),
        })
    }
}

/// An arm from its side.
struct Seen {
    flange: Pose,
    heading: f64,
}

impl Seen {
    /// Of base axes, ahead and up.
    fn aside(&self, v: &Vector3<f64>) -> [f64; 2] {
        let (s, c) = self.heading.sin_cos();
        [c * v.x + s * v.y, v.z]
    }

    /// A point of the flange frame, m.
    fn at(&self, point: &Vector3<f64>) -> [f64; 2] {
        self.aside(&(self.flange * nalgebra::Point3::from(*point)).coords)
    }
}

impl MeasureAnswer {
    /// The postures of the plan, in their order; none of a robot of two links.
    pub fn postures(&self) -> Vec<DrawnPosture> {
        let mut found: Vec<DrawnPosture> = Vec::new();
        for (i, run) in self.plan.runs.iter().enumerate() {
            if 0 < i && self.plan.runs[i - 1].q == run.q && self.plan.runs[i - 1].way == run.way {
                if let Some(last) = found.last_mut() {
                    last.runs[1] = i + 1;
                }
                continue;
            }
            let way = &self.options.ways[run.way];
            let load = |seen: &Seen| {
                Some(DrawnLoad {
                    arrow: [seen.at(&self.options.load_at), seen.aside(&way.along)],
                    text: format!("{} N {}", fixed(self.options.newtons, 0), way.name),
                    expected_mm: Unit::Millimetre.of_si(largest(run)),
                })
            };
            found.extend(DrawnPosture::of(&self.robot, (i + 1, &run.q), &self.options.markers, load));
        }
        found
    }

    /// Every field.
    pub fn record(&self) -> Record {
        let Self { plan, compared, .. } = self;
        let (criterion, squared) = judged(self.options.criterion);
        let compared = compared.as_ref().map(|(name, runs, value, efficiency)| {
            let mut record = Record::of(&shape::COMPARED_TABLE);
            record
                .put(field::COMPARED_FILE, name)
                .put(field::RUN_COUNT, *runs)
                .put(field::CRITERION_VALUE, value * squared)
                .put(field::EFFICIENCY, *efficiency);
            record
        });
        let runs: Datum = (0..plan.runs.len()).map(|i| self.run(i)).collect();
        let mut record = Record::of(&shape::MEASUREMENT_PLAN);
        stiffness::put_robot(&mut record, &self.robot);
        record
            .put(field::PENDANT, self.robot.pendant().map(Pendant::name))
            .put(field::CRITERION, criterion)
            .put(field::CRITERION_VALUE, plan.value * squared)
            .put(field::CRITERION_BOUND, plan.lower_bound * squared)
            .put(field::EFFICIENCY, plan.efficiency())
            .put(field::RANDOM_EFFICIENCY, Some(plan.lower_bound / plan.random).filter(|share| 0.0 < *share))
            .put(field::CANDIDATES, plan.candidates)
            .put(field::DRIVES, self.drives())
            .put(field::UNSEEN, json!(plan.unseen.iter().map(|one| one.drive + 1).collect::<Vec<_>>()))
            .put(field::UNSEEN_SHARE, plan.unseen_value / plan.value)
            .put(field::ADVISED_LOADS, json!(self.advised_loads()))
            .put(field::RUNS, runs)
            .put(field::COMPARED, compared);
        record
    }

    /// Directions of loads that show drives which are not shown.
    fn advised_loads(&self) -> Vec<&'static str> {
        let mut found: Vec<&str> = Vec::new();
        for way in self.plan.unseen.iter().filter_map(|one| one.shown_by) {
            if !found.contains(&way) {
                found.push(way);
            }
        }
        found
    }

    /// What is expected of each drive.
    fn drives(&self) -> Datum {
        let k = self.robot.drive_compliance();
        let of = |(drive, error): (usize, &Option<f64>)| {
            let mut record = Record::of(&shape::EXPECTED_DRIVE);
            record.put(field::SPRING, drive + 1).put(field::ESTIMATE, k[drive]).put(field::STANDARD_ERROR, *error);
            record
        };
        self.plan.errors.iter().enumerate().map(of).collect()
    }

    fn run(&self, i: usize) -> Record {
        let run = &self.plan.runs[i];
        let mut record = Record::of(&shape::MEASUREMENT_RUN);
        record
            .put(field::RUN, i + 1)
            .put(field::JOINTS, joints(run))
            .put(field::OF_LOAD, &self.options.ways[run.way].name)
            .put(field::FORCE_VECTOR, run.load.0.fixed_rows::<3>(0).as_slice())
            .put(field::EXPECTED, largest(run));
        record
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        with_schema("measure", super::ORIGIN, &self.record())
    }

    /// The table to be filled in, which `identify` reads: a row per run and marker.
    pub fn rows(&self) -> Rows<'static> {
        let number = |name: &str| Column::new(name, ColumnKind::Number);
        let mut columns = vec![Column::new("run", ColumnKind::Count), Column::new("posture", ColumnKind::Text)];
        columns
            .extend(["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg", "fx_n", "fy_n", "fz_n"].map(number));
        columns.push(Column::new("load", ColumnKind::Text));
        columns
            .extend(["load_x_mm", "load_y_mm", "load_z_mm", "marker_x_mm", "marker_y_mm", "marker_z_mm"].map(number));
        columns.extend(["dx_mm", "dy_mm", "dz_mm", "expected_mm"].map(number));
        let mut postures: Vec<[f64; 6]> = Vec::new();
        let mut rows = Vec::new();
        for (i, run) in self.plan.runs.iter().enumerate() {
            let posture = postures.iter().position(|q| *q == run.q).unwrap_or(postures.len());
            if posture == postures.len() {
                postures.push(run.q);
            }
            let numbers = |values: &[f64]| values.iter().map(|value| Cell::Number(value + 0.0)).collect::<Vec<_>>();
            let mm = |point: &Vector3<f64>| numbers((point * 1e3).as_slice());
            for (marker, expected) in self.options.markers.iter().zip(&run.expected) {
                let mut row = vec![Cell::Count(i as i64 + 1), Cell::Text(format!("p{}", posture + 1))];
                row.extend(numbers(&joints(run)));
                row.extend(numbers(run.load.0.fixed_rows::<3>(0).as_slice()));
                row.push(Cell::Text(self.options.ways[run.way].name.clone()));
                row.extend(mm(&self.options.load_at));
                row.extend(mm(marker));
                row.extend([
                    Cell::Absent,
                    Cell::Absent,
                    Cell::Absent,
                    Cell::Number(Unit::Millimetre.of_si(expected.norm())),
                ]);
                rows.push(row);
            }
        }
        Rows::new(columns, rows).under(words::pendant(&self.robot))
    }

    /// What stands above the runs.
    pub fn summary(&self) -> Table {
        let Self { robot, options, plan, .. } = self;
        let ways: Vec<&str> = options.ways.iter().map(|way| way.name.as_str()).collect();
        let percent = |share: f64| format!("{} %", fixed(100.0 * share, 1));
        let predicted = |value: f64| match options.criterion {
            // Of 1 kN, mm.
            Criterion::Prediction => format!("{} mm", fixed(value.sqrt() * 1e6, 4)),
            Criterion::A | Criterion::D => format!("{} %", fixed(100.0 * value.sqrt(), 3)),
        };
        let (of, in_words) = match options.criterion {
            Criterion::Prediction => ("prediction", "for 1 kN, one standard deviation, mean over the work"),
            Criterion::A => (
                "drives",
                "of its compliance, one standard deviation, root mean square over the drives that are shown (A)",
            ),
            Criterion::D => (
                "drives",
                "of its compliance, one standard deviation, mean radius of the ellipsoid of their errors (D)",
            ),
        };
        let precision = format!("precision of the {of}");
        let random = plan.lower_bound / plan.random;
        let random = if 0.0 < random { percent(random) } else { "nothing: it leaves some drive unseen".into() };
        let mut lines: Vec<Line> = vec![
            line("robot", words::robot(robot)),
            line(stiffness::LINE, stiffness(robot)),
            line("loads", format!("{} N {}", options.newtons, ways.join(", "))),
            line("work", format!("{}, {} postures", self.work, plan.work)),
            line("markers are seen", sight(options)),
            line(
                "candidates",
                format!(
                    "{}; of a coordinate {} mm by the reading and {} mm by the posture",
                    self.candidates(),
                    digits(options.sigma * 1e3, 6),
                    digits(options.posture_sigma * 1e3, 6)
                ),
            ),
            line(&precision, format!("{} {in_words}{}", predicted(plan.value), self.undecided())),
            line(
                "lower bound of any choice",
                format!("{} (efficiency {} at least)", predicted(plan.lower_bound), percent(plan.efficiency())),
            ),
            line("chosen at random", format!("efficiency {random} (median)")),
        ];
        lines.extend(self.compared.as_ref().map(|(name, runs, value, efficiency)| {
            line(
                "your table",
                format!("{name}: {} with {runs} runs (efficiency {})", predicted(*value), percent(*efficiency)),
            )
        }));
        let errors: Vec<String> = (plan.errors.iter().zip(robot.drive_compliance()).enumerate())
            .map(|(drive, (error, k))| match error.zip(k).filter(|(_, k)| 0.0 < *k) {
                Some((error, k)) => {
                    let blind = if MOST_RELATIVE_ERROR < error / k { " (will not be identified)" } else { "" };
                    format!("{} %{blind}", digits(100.0 * error / k, 2))
                }
                None => format!("drive {} not shown", drive + 1),
            })
            .collect();
        lines.push(line("error of the drives 1-6", errors.join(", ")));
        let means = format!("precision that {} measurements give", plan.runs.len());
        Table::of_lines(lines).led_by([&precision, stiffness::LINE], means, &[])
    }

    /// Where drives that no load shows decide the precision: that they do, and what would show them.
    fn undecided(&self) -> String {
        if !self.plan.is_decided_by_unseen() {
            return String::new();
        }
        let share = fixed(100.0 * self.plan.unseen_value / self.plan.value, 0);
        format!("; {share} % of its variance is the prior of {}: MEASURE UNDER MORE LOADS", self.unseen_drives())
    }

    fn unseen_drives(&self) -> String {
        let drives: Vec<String> = self.plan.unseen.iter().map(|one| (one.drive + 1).to_string()).collect();
        match drives.as_slice() {
            [drive] => format!("drive {drive}, which these loads do not show"),
            drives => format!("the drives {}, which these loads do not show", drives.join(", ")),
        }
    }

    /// How many there were, and that more were wanted.
    fn candidates(&self) -> String {
        let [found, wanted] = [self.plan.candidates, self.options.candidates];
        let of = if found < wanted {
            format!(" of {wanted}: no more postures were found where they can be measured")
        } else {
            String::new()
        };
        format!("{found} runs{of}")
    }

    /// One row per run.
    pub fn table(&self) -> Table {
        let joints_in_deg = format!("{} deg", words::joints_reported(&self.robot));
        let mut table = Table::new(["run", &joints_in_deg, "load", "force N", "expected mm"]);
        for (i, run) in self.plan.runs.iter().enumerate() {
            let force = run.load.0.fixed_rows::<3>(0);
            let most = largest(run);
            table.row([
                (i + 1).to_string(),
                joints(run).map(|angle| fixed(angle, 2)).join(", "),
                self.options.ways[run.way].name.clone(),
                force.iter().map(|newtons| fixed(*newtons, 0)).collect::<Vec<_>>().join(", "),
                fixed(most * 1e3, 2),
            ]);
        }
        table
    }

    /// What stands below the table.
    pub fn notes(&self) -> String {
        format!(
            "{}{}{}\n-o plan.csv writes the table to be filled in (dx_mm, dy_mm, dz_mm), which `stiffarm identify` reads\n",
            self.unseen_note(),
            words::pendant_note(&self.robot),
            looked_at(&self.robot, &self.options)
        )
    }
}

impl MeasureAnswer {
    /// Which drives these loads do not show, and what does.
    fn unseen_note(&self) -> String {
        let unseen: Vec<String> = self.plan.unseen.iter().map(|one| (one.drive + 1).to_string()).collect();
        if unseen.is_empty() {
            return String::new();
        }
        let ways: Vec<&str> = self.options.ways.iter().map(|way| way.name.as_str()).collect();
        let (loads, advised) = (ways.join(", "), self.advised_loads());
        let drives = if unseen.len() == 1 { "drive" } else { "the drives" };
        let do_not =
            if unseen.len() == 1 { "does not show: it keeps its prior" } else { "do not show: they keep their prior" };
        let mut note = format!("under these loads ({loads}) {drives} {} {do_not}", unseen.join(", "));
        if !advised.is_empty() {
            let all = [ways, advised.iter().map(AsRef::as_ref).collect()].concat().join(",");
            note = format!("{note}; --loads {all} shows {}", self.shown_by_advised());
        }
        if self.plan.unseen.iter().any(|one| one.shown_by.is_none()) {
            note += "; a load point and a marker aside of an axis (--load-mm, --marker-mm) show its drive";
        }
        note + "\n"
    }

    fn shown_by_advised(&self) -> String {
        let shown = self.plan.unseen.iter().filter(|one| one.shown_by.is_some());
        let drives: Vec<String> = shown.map(|one| (one.drive + 1).to_string()).collect();
        if drives.len() == 1 { format!("drive {}", drives[0]) } else { format!("the drives {}", drives.join(", ")) }
    }
}

/// From where markers are seen.
fn sight(options: &Options) -> String {
    let Some(Instrument { at, cone }) = &options.instrument else {
        return "from everywhere: where the instrument stands is not given (--instrument)".into();
    };
    let triple =
        |vector: &Vector3<f64>| vector.iter().map(|x| digits(*x, 3).to_string()).collect::<Vec<_>>().join(", ");
    let side = cone.as_ref().map_or("from all sides".into(), |Cone { faces, acceptance }| {
        format!("up to {} deg from {} of the flange", fixed(acceptance.to_degrees(), 1), triple(faces))
    });
    format!("{side}, from ({}) m, past the arm", triple(at))
}

/// What was looked at of every posture.
fn looked_at(robot: &Robot, options: &Options) -> String {
    let sight = if options.instrument.is_some() { ", sight" } else { "" };
    let coarse = match robot.thickness() {
        _ if robot.enclosing.is_some() => "as capsules that enclose them",
        (_, true) => "as capsules of estimated radii",
        (_, false) => "as capsules",
    };
    format!(
        "in this order the joints travel little; looked at were joint limits, window{sight}, and the links ({coarse}) towards floor and each other, in these postures and not on the way"
    )
}

/// How far the marker that moves most is expected to move, m.
fn largest(run: &Run) -> f64 {
    run.expected.iter().map(nalgebra::Matrix::norm).fold(0.0, f64::max)
}

/// As the robot reports them, deg, to a hundredth, to which they are chosen.
fn joints(run: &Run) -> [f64; 6] {
    in_degrees(&run.q)
}

fn in_degrees(q: &[f64; 6]) -> [f64; 6] {
    q.map(|angle| (angle.to_degrees() * 100.0).round() / 100.0 + 0.0)
}
