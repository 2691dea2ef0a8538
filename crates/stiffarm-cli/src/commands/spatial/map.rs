//! `stiffarm map --model spatial`: a section through everything the tool reaches.

use std::io::{self, Write};
use std::path::Path;

use stiffarm::map::{Axis, Section, SectionOptions, section};
use stiffarm::report;
use stiffarm::request::{Layer, Request};
use stiffarm::robot::Robot;

use super::drawing::{over_everything, scene};
use super::{direction, tool};
use crate::args::Common;
use crate::commands::waiting;
use crate::failure::Failure;
use crate::figures::map::MapFigure;
use crate::figures::view3d::{ArmMark, Sheet, View};
use crate::output::{Answer, Outputs, figure, pretty};
use crate::table::{Table, full};

pub(crate) fn run(robot: Robot, args: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<MapAnswer>(common, &[Path::new(&args.robot()?)])?;
    let unit = Axis { start: 0.0, step: 1.0, count: 2 };
    let held = args.held();
    let asked = SectionOptions {
        x: unit,
        z: unit,
        force: args.force(),
        flange_from_tool: held.tool(),
        elevation: held.elevation(),
        yaw: 0.0,
        roll: held.roll(),
        configuration: args.posture(),
    };
    let Some(options) = over_everything(&robot, &asked, args.spacing())? else {
        return Err(Failure::Usage(format!(
            "{}: no point is reached with the {}",
            robot.name,
            direction(asked.elevation)
        )));
    };
    let section = waiting("mapping", common, || section(&robot, &options))
        .map_err(|error| Failure::Map { robot: robot.name.clone(), error })?;
    outputs.deliver(&MapAnswer { robot, options, section, layer: args.layer() })
}

struct MapAnswer {
    robot: Robot,
    options: SectionOptions,
    section: Section,
    /// What the figure shows.
    layer: Layer,
}

impl MapAnswer {
    /// The joints at the stiffest point.
    fn stiffest(&self) -> Option<[f64; 6]> {
        let [(_, i, j), _] = self.section.worst.extremes()?;
        self.section.joints(&self.robot, &self.options, i, j)
    }

    fn subtitle(&self) -> String {
        let Self { robot, options, .. } = self;
        format!(
            "{}, {}; all six drives, {}, tool: {}; drawn at the stiffest point",
            robot.architecture,
            robot.status,
            direction(options.elevation),
            tool(&options.flange_from_tool)
        )
    }

    fn colour_label(&self) -> String {
        format!("worst deflection under {} N [mm]", self.options.force)
    }
}

impl Answer for MapAnswer {
    const COMMAND: &'static str = "map";
    const FURTHER: &'static [&'static str] = &["svg", "png", "html"];

    fn text(&self, markdown: bool) -> String {
        let Self { robot, options, section, .. } = self;
        let mut table = Table::new(["", ""]);
        table.row(["robot".into(), format!("{} ({}, {})", robot.full_name(), robot.architecture, robot.status)]);
        table.row([
            "mapped".into(),
            format!("worst deflection under {} N, spatial model, {}", options.force, direction(options.elevation)),
        ]);
        table.row(["tool".into(), tool(&options.flange_from_tool)]);
        let (x, z) = (section.worst.x, section.worst.z);
        table.row(["points".into(), format!("{} x {}, every {:.4} m", x.count, z.count, x.step)]);
        if section.worst.extremes().is_none() {
            table.row(["reached", "no point of the grid: choose a smaller step"]);
        }
        if let Some([least, most]) = section.worst.extremes() {
            for (name, (value, i, j)) in [("least", least), ("most", most)] {
                let class = section.posture(i, j).map_or_else(String::new, |(class, _)| format!(" ({class})"));
                let place = format!("x {:.3} m, z {:.3} m from the base", x.at(i), z.at(j));
                table.row([name.into(), format!("{:.4} mm at {place}{class}", value * 1e3)]);
            }
        }
        table.text(markdown)
            + "\nthe section points straight ahead and stands for every direction about the joint-1 axis; the best posture of each point and its best roll, to 0.1 %\n\
               -o map.svg, .png, .html, .csv, .parquet or .json writes the map; the tables with posture, roll and the margins to limits and singular postures\n"
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &report::map::spatial(&self.robot, &self.options, &self.section))
    }

    fn csv(&self) -> Table<'_> {
        let section = &self.section;
        let (x, z) = (section.worst.x, section.worst.z);
        let headings = [
            "x_m",
            "z_m",
            "deflection_mm",
            "shoulder",
            "elbow",
            "wrist",
            "roll_deg",
            "limit_margin_deg",
            "singular_margin_deg",
        ];
        let row = move |cell: usize| {
            let (i, j) = (cell % x.count, cell / x.count);
            let posture = section.posture(i, j);
            let word = |word: Option<&str>| word.unwrap_or_default().to_owned();
            [
                x.at(i).to_string(),
                z.at(j).to_string(),
                full(section.worst.get(i, j).map(|metres| metres * 1e3)),
                word(posture.map(|(class, _)| class.shoulder.name())),
                word(posture.map(|(class, _)| class.elbow.name())),
                word(posture.map(|(class, _)| class.wrist.name())),
                full(posture.map(|(_, roll)| roll.to_degrees())),
                full(section.limit_margin.get(i, j).map(f64::to_degrees)),
                full(section.singular_margin.get(i, j).map(f64::to_degrees)),
            ]
        };
        Table::made(headings, x.count * z.count, row)
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        let degrees = 1_f64.to_degrees();
        let Section { worst, limit_margin, singular_margin, .. } = &self.section;
        let (map, factor, ends, colour_label) = match self.layer {
            Layer::Deflection => (worst, 1e3, ["stiff", "soft"], self.colour_label()),
            Layer::LimitMargin => (limit_margin, degrees, ["near", "far"], "nearest joint limit [deg]".into()),
            Layer::SingularMargin => {
                (singular_margin, degrees, ["near", "far"], "nearest singular posture [deg]".into())
            }
        };
        let drawn = MapFigure {
            title: self.robot.full_name(),
            subtitle: self.subtitle(),
            map,
            factor,
            ends,
            edge: None,
            scene: scene(&self.robot, self.stiffest().as_ref(), &self.options.flange_from_tool, None),
            colour_label,
            origin: "the base",
            face: None,
        };
        Some(drawn.svg().map_err(figure))
    }

    fn view(&self) -> Option<Result<View, Failure>> {
        let arm = self.stiffest().and_then(|q| ArmMark::posed(&self.robot, &q, &self.options.flange_from_tool, None));
        Some(Ok(View {
            title: self.robot.full_name(),
            notes: vec![self.subtitle(), "the section stands for every direction about the joint-1 axis".into()],
            arm,
            section: Some(Sheet::of_map(&self.section.worst, [0.0; 2], 0.0)),
            colour_label: self.colour_label(),
            floor: true,
            ..View::default()
        }))
    }
}
