//! `stiffarm robots show`: everything that is known of one robot, and what it reaches.

use serde_json::Value;
use stiffarm::catalogue::write;
use stiffarm::drive::{Architecture, Drives, Transmission};
use stiffarm::geometry::Geometry;
use stiffarm::interval::Interval;
use stiffarm::limits::{Limits, Pendant, ThirdAxis, Verified};
use stiffarm::map::MapError;
use stiffarm::plane::PlanarArm;
use stiffarm::prior::with_prior;
use stiffarm::robot::{Arm, ArmPlane, Robot};
use stiffarm_ask::answer::robot::{data_sheet, lengths, rounded};
use stiffarm_ask::answer::words::{architecture, assumed_architecture, class, status};
use stiffarm_ask::answer::{Cell, Rows, Table, Unit, columns_of, field, stiffness};
use stiffarm_ask::ask::AskError;

use stiffarm_ask::forms::{Answer, Forms, Makes, Picture, Piece};

use stiffarm_ask::figures::FigureSize;
use stiffarm_ask::figures::reach::ReachFigure;

pub(crate) struct DataSheet(pub(super) Robot, pub(super) FigureSize);

/// `-40.0 to 160.0`, in degrees.
fn degrees(range: Interval) -> String {
    if range.is_all() {
        "no limit".into()
    } else {
        format!("{:.1} to {:.1} deg", Unit::Degree.of_si(range.min()), Unit::Degree.of_si(range.max()))
    }
}

type Lines = Vec<(String, String)>;

impl DataSheet {
    fn lines(&self) -> Lines {
        let robot = &self.0;
        let mut rows: Lines = vec![
            ("robot".into(), robot.full_name()),
            ("architecture".into(), architecture(robot)),
            ("status".into(), status(robot).into()),
            ("payload".into(), robot.payload_kg.map_or_else(|| "-".into(), |kg| format!("{kg} kg"))),
            ("reach".into(), robot.reach.map_or_else(|| "-".into(), |reach| format!("{reach:.3} m"))),
        ];
        rows.extend(robot.mass_kg.map(|kg| ("mass".into(), format!("{kg} kg"))));
        let repeatability = robot.repeatability.map(|m| format!("{} mm", rounded(Unit::Millimetre.of_si(m))));
        rows.extend(repeatability.map(|text| ("repeatability".into(), text)));
        if let Arm::SixAxis { geometry, limits, drives } = &robot.arm {
            rows.extend(geometry_rows(geometry));
            rows.extend(limit_rows(limits));
            rows.extend(drive_rows(drives, robot.architecture));
            rows.push(("radii of the links".into(), radii(robot)));
            rows.extend(robot.enclosing.as_ref().map(|enclosing| {
                let each = enclosing.links.each_ref().map(|capsules| capsules.len().to_string()).join(", ");
                (
                    "bodies".into(),
                    format!("links 0 to 6 enclosed by {each} capsules; the radii are those of column and spindle"),
                )
            }));
        }
        rows.push(("stiffness".into(), stiffness(robot)));
        // What every answer in space takes where nothing else is asked; none of a robot whose size is not known.
        if robot.stiffness_is_assumed
            && let Ok(known) = with_prior(robot)
        {
            rows.push(("stiffness in space".into(), stiffness(&known)));
        }
        if let Ok(plane) = robot.two_links() {
            rows.extend(plane_rows(&plane.arm));
        }
        rows.push((
            "stiffest posture".into(),
            match robot.arm_plane() {
                Ok(ArmPlane { arm, .. }) => {
                    let sigma = arm.radial();
                    format!("{:.4} um/N at {:.3} m from the joint-2 axis", sigma.floor() * 1e6, sigma.valley())
                }
                Err(error) => format!("n/a: {error}"),
            },
        ));
        rows.extend(robot.source.iter().map(|(key, text)| (format!("source: {key}"), text.clone())));
        rows
    }

    fn figure(&self) -> Result<String, AskError> {
        let robot = &self.0;
        let failure = |error| AskError::Map { robot: robot.name.clone(), error };
        let plane = robot.two_links().map_err(|error| failure(MapError::Model(error.into())))?;
        let base = (plane.axis_from_base != [0.0; 2]).then_some(plane.axis_from_base);
        let drawn = ReachFigure {
            title: robot.full_name(),
            subtitle: format!("{}; what the wrist centre reaches in the arm plane", class(robot)),
            arm: &plane.arm,
            base,
            figure_size: self.1,
        };
        drawn.svg().map_err(Into::into)
    }
}

/// Column, upper arm, forearm and wrist.
fn radii(robot: &Robot) -> String {
    let (body, is_estimated) = robot.thickness();
    let names = ["column", "upper arm", "forearm", "wrist"];
    let radii = names.iter().zip(<[f64; 4]>::from(body));
    let named: Vec<String> = radii.map(|(name, m)| format!("{name} {:.0}", Unit::Millimetre.of_si(m))).collect();
    format!("{} mm{}", named.join(", "), if is_estimated { " (estimated)" } else { "" })
}

fn geometry_rows(geometry: &Geometry) -> Lines {
    let lengths: Vec<String> =
        lengths(geometry).iter().map(|(name, m)| format!("{name} {}", rounded(Unit::Millimetre.of_si(*m)))).collect();
    let offsets: Vec<String> = geometry.offset.iter().map(|x| rounded(Unit::Degree.of_si(*x)).to_string()).collect();
    let signs: Vec<&str> = geometry.sign.iter().map(|&sign| if 0.0 < sign { "+" } else { "-" }).collect();
    vec![
        ("lengths".into(), format!("{} mm", lengths.join(", "))),
        ("zero offsets".into(), format!("{} deg", offsets.join(", "))),
        ("signs".into(), signs.join(" ")),
    ]
}

fn limit_rows(limits: &Limits) -> Lines {
    let mut rows = Lines::new();
    for (i, range) in limits.joints.iter().enumerate() {
        let speed = limits
            .speeds
            .map_or_else(String::new, |speeds| format!(", {} deg/s", rounded(Unit::Degree.of_si(speeds[i]))));
        let forearm = i == 2 && limits.third_axis == ThirdAxis::Forearm;
        let remark = if forearm { " (absolute angle of the forearm)" } else { "" };
        rows.push((format!("joint {} as reported", i + 1), degrees(*range) + &speed + remark));
    }
    rows.push(("pendant".into(), pendant(&limits.pendant)));
    if !limits.elbow.is_all() {
        rows.push(("angle between the links".into(), degrees(limits.elbow)));
    }
    rows
}

/// Whether it shows those angles.
fn pendant(pendant: &Pendant) -> String {
    match pendant {
        Pendant::Unknown => "not known to show the joints as they are counted here".into(),
        Pendant::AsFile => "shows the joints as they are counted here".into(),
        Pendant::Verified(Verified { rows, date, largest }) => format!(
            "shows the joints as they are counted here: {rows} readings of {date} agree within {} mm",
            rounded(Unit::Millimetre.of_si(*largest))
        ),
        Pendant::Given => "said to show the joints as they are counted here".into(),
    }
}

fn drive_rows(drives: &Drives, architecture: Architecture) -> Lines {
    let mut rows = Lines::new();
    if drives.transmission != Transmission::of(architecture) {
        for (i, row) in drives.transmission.0.row_iter().enumerate() {
            let row: Vec<String> = row.iter().map(|ratio| rounded(*ratio).to_string()).collect();
            rows.push((format!("joint {} from the drives", i + 1), row.join(", ")));
        }
    }
    if let Some(spring) = drives.compensator {
        let point = |[x, z]: [f64; 2]| {
            format!("{}, {}", rounded(Unit::Millimetre.of_si(x)), rounded(Unit::Millimetre.of_si(z)))
        };
        let [base, arm] = [spring.base, spring.arm].map(point);
        let (stiffness, free) = (rounded(spring.stiffness / 1e3), rounded(Unit::Millimetre.of_si(spring.free_length)));
        rows.push((
            "gravity compensator".into(),
            format!("{stiffness} N/mm, {free} mm when free, from {base} mm on the base to {arm} mm on the upper arm"),
        ));
    }
    rows
}

fn plane_rows(arm: &PlanarArm) -> Lines {
    let links = format!("l2 {:.4} m, l3 {:.4} m, l3/l2 {:.4}", arm.l2, arm.l3, arm.l3 / arm.l2);
    vec![
        ("arm plane".into(), links),
        ("  shoulder".into(), degrees(arm.shoulder)),
        ("  elbow".into(), degrees(arm.elbow)),
        ("  forearm".into(), degrees(arm.forearm)),
    ]
}

/// In which forms it is shown.
pub(super) const FORMS: Forms =
    Forms { command: "robots show", makes: &[Makes::Picture(Picture::Figure), Makes::RobotFile] };

impl Answer for DataSheet {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let mut table = Table::new(["", ""]);
        for (key, value) in self.lines() {
            table.row([key, value]);
        }
        let notes = assumed_architecture([&self.0]).to_owned()
            + "angles of the arm plane: counter-clockwise, 0 straight ahead; negative elbow: bent forwards and down\n\
               -o reach.svg, .png or .pdf draws what it reaches, -o robot.toml writes the robot file\n";
        vec![Piece::Table(table), Piece::Lines(notes)]
    }

    fn value(&self) -> Value {
        data_sheet(&self.0)
    }

    fn rows(&self) -> Rows<'_> {
        let rows =
            self.lines().into_iter().map(|(key, value)| vec![Cell::Text(key.trim().to_owned()), Cell::Text(value)]);
        Rows::new([field::KEY, field::VALUE].map(|field| columns_of(&field)).concat(), rows.collect())
    }

    fn robot_file(&self) -> Option<Result<String, AskError>> {
        Some(Ok(write(&self.0)))
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(self.figure())
    }

    fn figure_size(&self) -> FigureSize {
        self.1
    }
}
