//! What can be asked for on the command line.
#![allow(rustdoc::broken_intra_doc_links, reason = "help texts put units and defaults in brackets")]

use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, Parser, Subcommand, ValueEnum};
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::inverse::Configuration;
use stiffarm::load::{Component, Load};
use stiffarm::map::Spacing;
use stiffarm::model::ModelKind;
use stiffarm::place::{PlaceOptions, Within};
use stiffarm::plane::Elbow;
use stiffarm::question::{
    Angle, Held, Unasked, Wanted, degrees, elevation, number, open_range, shape, tool, within, yaw,
};
use stiffarm::spatial::Pose;
use stiffarm::task::{Task, Zone};

use crate::failure::Failure;
use crate::filters::Filters;

/// Which robot is stiff enough for machining, where must the work stand, and how far is the tool pushed off?
#[derive(Debug, Parser)]
#[command(name = "stiffarm", version, propagate_version = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
    #[command(flatten)]
    pub(crate) common: Common,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Rank robots for tasks; without arguments the ten robots of the paper on its six tasks
    Rank(RankArgs),
    /// Find the best place of one zone, with a proof
    Place(PlaceArgs),
    /// Map the deflection over everything a robot reaches
    Map(MapArgs),
    /// Six-axis compliance at one posture, and which drive gives how much
    Compliance(ComplianceArgs),
    /// Compare two architectures over link ratio and task size
    Study(StudyArgs),
    /// List, show and check robots
    Robots(RobotsArgs),
    /// Print every published number beside the computed one
    Validate,
}

#[derive(Debug, Args)]
pub(crate) struct Common {
    /// Format of what goes to standard output
    #[arg(long, value_enum, default_value_t = Format::Table, global = true)]
    pub(crate) format: Format,
    /// Write to a file; its ending chooses the format: .csv, .parquet, .json, .md, .txt, a figure as .svg or .png, or a view
    /// in space as .html. May be given several times
    #[arg(short, long = "output", value_name = "FILE", global = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = threads, global = true)]
    pub(crate) threads: Option<usize>,
    /// No progress, no remarks
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    Table,
    Json,
    Csv,
    Md,
}

/// What is asked of a placement, whatever the verb.
#[derive(Debug, Args)]
pub(crate) struct Placing {
    /// Cutting force [N]
    #[arg(long, value_name = "N", default_value_t = 1000.0, value_parser = force, allow_hyphen_values = true)]
    pub(crate) force_n: f64,
    /// Where the zone may stand, in m from the robot's base: x0..x1,z0..z1; either range may be left open
    /// [default: anywhere; with --model spatial 0..,0..: in front of the joint-1 axis and above the base]
    #[arg(long, value_name = "RANGES", value_parser = within, allow_hyphen_values = true)]
    pub(crate) within: Option<Within>,
    /// Angle of a rectangle: axes (horizontal or vertical), horizontal, vertical (its long side), free, or degrees of its first side
    #[arg(long, value_name = "ANGLE", value_parser = Angle::from_str, default_value = "axes", allow_hyphen_values = true)]
    pub(crate) angle: Angle,
    /// Largest relative distance between a value and its proof [default: 0.0001]
    #[arg(long, value_name = "RATIO", value_parser = gap, allow_hyphen_values = true)]
    pub(crate) gap: Option<f64>,
}

impl Placing {
    pub(crate) fn question(&self) -> Result<Wanted, Failure> {
        let load = Load::worst(self.force_n).map_err(|error| Failure::Usage(error.to_string()))?;
        Ok(Wanted { load, within: self.within, angle: self.angle, gap: self.gap })
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Model {
    /// The paper's: drives 2 and 3, the wrist centre, zones in the arm plane
    Planar,
    /// All six drives, the tool where it is, flat zones that the tool axis meets at a right angle
    Spatial,
}

/// What only the spatial model knows.
#[derive(Debug, Args)]
#[command(next_help_heading = "Model")]
pub(crate) struct Space {
    /// Which model
    #[arg(long, value_enum, default_value_t = Model::Planar)]
    pub(crate) model: Model,
    /// Tool frame in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes; its z is the tool axis [default: the flange]
    #[arg(long, value_name = "X,Y,Z", value_parser = tool, allow_hyphen_values = true)]
    pub(crate) tool_mm: Option<Pose>,
    /// The tool axis: down, forward, up, or its angle above the horizontal [deg] [default: down]
    #[arg(long, value_name = "DIRECTION", value_parser = elevation, allow_hyphen_values = true)]
    pub(crate) tool_direction: Option<f64>,
    /// Angle of the zone about the vertical [deg], 0 faces the robot; or any [default: the best of -90..90]
    #[arg(long, value_name = "DEG", value_parser = yaw, allow_hyphen_values = true)]
    pub(crate) yaw_deg: Option<Interval>,
    /// Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, on a wall upright [default: the best]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_hyphen_values = true)]
    pub(crate) roll_deg: Option<f64>,
}

impl Space {
    /// Refuses what the planar model does not know.
    pub(crate) fn is_spatial(&self) -> Result<bool, Failure> {
        let further = [
            ("--tool-mm", self.tool_mm.is_some()),
            ("--tool-direction", self.tool_direction.is_some()),
            ("--yaw-deg", self.yaw_deg.is_some()),
            ("--roll-deg", self.roll_deg.is_some()),
        ];
        match (self.model, further.iter().find(|(_, given)| *given)) {
            (Model::Spatial, _) => Ok(true),
            (Model::Planar, None) => Ok(false),
            (Model::Planar, Some((name, _))) => Err(Failure::Usage(format!("{name} needs --model spatial"))),
        }
    }

    pub(crate) fn elevation(&self) -> f64 {
        self.held().elevation()
    }

    pub(crate) fn tool(&self) -> Pose {
        self.held().tool()
    }

    /// Which model, with the tool where it has one.
    pub(crate) fn kind(&self) -> Result<ModelKind, Failure> {
        Ok(if self.is_spatial()? { ModelKind::Spatial(self.tool()) } else { ModelKind::Planar })
    }

    /// What `place` and `rank` ask of a model, of one zone or of zones of any shape.
    pub(crate) fn options(
        &self,
        placing: &Placing,
        kind: &ModelKind,
        zone: Option<Zone>,
    ) -> Result<PlaceOptions, Failure> {
        placing.question()?.options(kind, &self.held(), zone).map_err(flagged)
    }

    fn held(&self) -> Held {
        Held { tool: self.tool_mm, elevation_deg: self.tool_direction, yaw: self.yaw_deg, roll_deg: self.roll_deg }
    }
}

/// An option's name as it is typed.
fn flagged(error: Unasked) -> Failure {
    Failure::Usage(format!("--{error}"))
}

#[derive(Debug, Args)]
pub(crate) struct RankArgs {
    /// Robots: names, patterns (*), files, folders, or the sets `paper` and `all`; separated by commas or given several times
    #[arg(long, value_name = "ROBOTS", value_delimiter = ',', default_value = "paper")]
    pub(crate) robots: Vec<String>,
    /// Tasks: circle:D, rect:AxB, A:d, B:d, C:d with sizes in m; separated by commas or given several times
    #[arg(long = "task", value_name = "TASK", value_delimiter = ',', default_values = ["A:0.1", "A:1.0", "B:0.1", "B:0.5", "C:0.05", "C:0.15"])]
    pub(crate) tasks: Vec<Task>,
    /// Largest deflection that is acceptable [mm]: adds pass or fail
    #[arg(long, value_name = "MM", value_parser = tolerance, allow_hyphen_values = true)]
    pub(crate) tolerance_mm: Option<f64>,
    #[command(flatten)]
    pub(crate) placing: Placing,
    #[command(flatten)]
    pub(crate) space: Space,
    #[command(flatten)]
    pub(crate) filters: Filters,
}

#[derive(Debug, Args)]
pub(crate) struct PlaceArgs {
    /// A robot's name, or the path of a robot file
    pub(crate) robot: String,
    /// circle:D, rect:AxB, A:d, B:d, C:d with sizes in m
    #[arg(long, value_name = "TASK")]
    pub(crate) task: Task,
    /// Largest deflection that is acceptable [mm]: adds pass or fail
    #[arg(long, value_name = "MM", value_parser = tolerance, allow_hyphen_values = true)]
    pub(crate) tolerance_mm: Option<f64>,
    #[command(flatten)]
    pub(crate) placing: Placing,
    #[command(flatten)]
    pub(crate) space: Space,
}

#[derive(Debug, Args)]
pub(crate) struct MapArgs {
    /// A robot's name, or the path of a robot file
    pub(crate) robot: String,
    /// Direction of the force [deg], counter-clockwise from straight ahead [default: the worst in every point]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_hyphen_values = true)]
    pub(crate) direction_deg: Option<f64>,
    /// The whole displacement, or its part along the force [default: total]
    #[arg(long, value_enum, requires = "direction_deg")]
    pub(crate) component: Option<Part>,
    /// Only one elbow side [default: the stiffer that reaches a point]
    #[arg(long, value_enum)]
    pub(crate) elbow: Option<Side>,
    /// Only one posture, with --model spatial: such as front,up,no-flip [default: the stiffest at each point]
    #[arg(long, value_name = "POSTURE")]
    pub(crate) posture: Option<Configuration>,
    /// What the figure shows, with --model spatial; the tables have all of it
    #[arg(long, value_enum, default_value_t = Layer::Deflection)]
    pub(crate) layer: Layer,
    /// Draw the best placement of this task
    #[arg(long, value_name = "TASK")]
    pub(crate) zone: Option<Task>,
    /// Distance between points [m]
    #[arg(long, value_name = "M", value_parser = step, allow_hyphen_values = true, conflicts_with = "size")]
    pub(crate) step_m: Option<f64>,
    /// Points along the longer side
    #[arg(long, value_name = "N", default_value_t = 400, value_parser = points)]
    pub(crate) size: usize,
    #[command(flatten)]
    pub(crate) placing: Placing,
    #[command(flatten)]
    pub(crate) space: Space,
}

impl MapArgs {
    pub(crate) fn spacing(&self) -> Spacing {
        self.step_m.map_or(Spacing::Points(self.size), Spacing::Step)
    }
}

#[derive(Debug, Args)]
pub(crate) struct ComplianceArgs {
    /// A robot's name, or the path of a robot file
    pub(crate) robot: String,
    /// The six joint angles as the robot reports them [deg], separated by commas
    #[arg(long, value_name = "Q1,..,Q6", value_delimiter = ',', required = true, value_parser = joint, allow_hyphen_values = true)]
    pub(crate) joints_deg: Vec<f64>,
    /// Force at the tool point, base axes [N]: x,y,z
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', value_parser = force_along, allow_hyphen_values = true)]
    pub(crate) force_n: Vec<f64>,
    /// Tool frame in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes [default: the flange centre]
    #[arg(long, value_name = "X,Y,Z", value_parser = tool, allow_hyphen_values = true)]
    pub(crate) tool_mm: Option<Pose>,
}

#[derive(Debug, Args)]
pub(crate) struct StudyArgs {
    /// Shapes at size 1: A, B, C, or such as rect:1x3
    #[arg(long, value_name = "SHAPES", value_delimiter = ',', value_parser = shape, default_value = "A,B,C")]
    pub(crate) tasks: Vec<Task>,
    /// Sizes over l2 + l3
    #[arg(long, value_name = "SIZES", value_delimiter = ',', value_parser = size, allow_hyphen_values = true, default_values_t = [0.1, 0.3, 0.5, 0.8])]
    pub(crate) sizes: Vec<f64>,
    /// Link ratios mu = l3/l2
    #[arg(long, value_name = "RATIOS", value_delimiter = ',', value_parser = link_ratio, allow_hyphen_values = true, default_values_t = [0.8, 1.0, 1.2])]
    pub(crate) ratios: Vec<f64>,
    /// Link ratios among which the best is sought
    #[arg(long, value_name = "RANGE", value_parser = open_range, default_value = "0.5..1.5")]
    pub(crate) range: Interval,
    /// The two architectures that are compared
    #[arg(long, value_name = "TWO", value_delimiter = ',', value_parser = architecture, default_value = "serial,quasi-serial")]
    pub(crate) compare: Vec<Architecture>,
    /// Compliance of drive 2 over the reference k, for both or one each; 0: rigid
    #[arg(long, value_name = "K", value_delimiter = ',', value_parser = relative_compliance, allow_hyphen_values = true, default_value = "1")]
    pub(crate) k2: Vec<f64>,
    /// Compliance of drive 3 over the reference k, for both or one each; 0: rigid
    #[arg(long, value_name = "K", value_delimiter = ',', value_parser = relative_compliance, allow_hyphen_values = true, default_value = "1")]
    pub(crate) k3: Vec<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct RobotsArgs {
    #[command(subcommand)]
    pub(crate) action: Option<RobotsAction>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum RobotsAction {
    /// The robots that come with the program, all or those that match
    List {
        /// Words that must stand in the maker's or the robot's name
        text: Vec<String>,
        #[command(flatten)]
        filters: Filters,
    },
    /// Geometry, limits and sources of one robot; -o draws what it reaches
    Show {
        /// A robot's name, or the path of a robot file
        robot: String,
    },
    /// Check robot files: every fault at once
    Check {
        /// Robot files, or folders of them
        #[arg(required = true)]
        files: Vec<PathBuf>,
    },
    /// Make a robot file from a URDF or from OPW parameters, and prove it
    Import(ImportArgs),
}

#[derive(Debug, Args)]
pub(crate) struct ImportArgs {
    /// A URDF, or OPW parameters (`opw_parameters_*.yaml`); -o robot.toml writes the robot file
    pub(crate) file: PathBuf,
    /// Name of the robot [default: as in the file]
    #[arg(long, value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Its maker
    #[arg(long, value_name = "NAME")]
    pub(crate) vendor: Option<String>,
    /// Nominal payload [kg]
    #[arg(long, value_name = "KG", value_parser = payload, allow_hyphen_values = true)]
    pub(crate) payload_kg: Option<f64>,
    /// Reach by the data sheet [m]
    #[arg(long, value_name = "M", value_parser = reach, allow_hyphen_values = true)]
    pub(crate) reach_m: Option<f64>,
    /// serial or quasi-serial [default: serial, marked as assumed]
    #[arg(long, value_name = "KIND", value_parser = architecture)]
    pub(crate) architecture: Option<Architecture>,
    /// Six ranges [deg] in place of the file's limits: a..b,a..b,...
    #[arg(long, value_name = "RANGES", value_delimiter = ',', value_parser = joint_range, allow_hyphen_values = true)]
    pub(crate) limits_deg: Vec<Interval>,
    /// The link whose frame is the base [default: the base of the arm]
    #[arg(long, value_name = "LINK")]
    pub(crate) base: Option<String>,
    /// The link whose frame is the flange [default: flange or tool0, or the link that joint 6 moves]
    #[arg(long, value_name = "LINK")]
    pub(crate) tip: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Layer {
    /// The worst deflection
    Deflection,
    /// How far the nearest joint limit is
    LimitMargin,
    /// How far the nearest singular posture is
    SingularMargin,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Part {
    Total,
    Along,
}

impl From<Part> for Component {
    fn from(part: Part) -> Self {
        match part {
            Part::Total => Self::Total,
            Part::Along => Self::Along,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Side {
    Up,
    Down,
}

impl From<Side> for Elbow {
    fn from(side: Side) -> Self {
        match side {
            Side::Up => Self::Up,
            Side::Down => Self::Down,
        }
    }
}

fn force(text: &str) -> Result<f64, String> {
    number(text, 1e-3, 1e6, "N")
}

fn force_along(text: &str) -> Result<f64, String> {
    number(text, -1e6, 1e6, "N along each of x, y, z")
}

fn joint(text: &str) -> Result<f64, String> {
    number(text, -1080.0, 1080.0, "degrees for each of six joints")
}

fn size(text: &str) -> Result<f64, String> {
    number(text, 1e-4, 10.0, "times l2 + l3")
}

fn link_ratio(text: &str) -> Result<f64, String> {
    number(text, 0.05, 20.0, "(l3 over l2)")
}

fn relative_compliance(text: &str) -> Result<f64, String> {
    number(text, 0.0, 0.0, "").or_else(|_| number(text, 1e-3, 1e3, "times the reference, or 0 for a rigid drive"))
}

fn gap(text: &str) -> Result<f64, String> {
    number(text, 1e-9, 0.5, "(relative)")
}

fn tolerance(text: &str) -> Result<f64, String> {
    number(text, 1e-6, 1e3, "mm")
}

fn payload(text: &str) -> Result<f64, String> {
    number(text, 0.1, 1e4, "kg")
}

fn reach(text: &str) -> Result<f64, String> {
    number(text, 0.1, 20.0, "m")
}

/// `a..b` in degrees, both ends given.
fn joint_range(text: &str) -> Result<Interval, String> {
    open_range(text).ok().filter(|range| range.is_bounded()).ok_or_else(|| {
        format!("'{text}' is not a range of a joint; expected such as -185..185, in degrees, the lower end first")
    })
}

fn step(text: &str) -> Result<f64, String> {
    number(text, 1e-6, 10.0, "m")
}

fn points(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(points @ 2..=100_000) => Ok(points),
        _ => Err("expected a whole number from 2 to 100000".into()),
    }
}

fn threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads @ 1..=1024) => Ok(threads),
        _ => Err("expected a whole number from 1 to 1024".into()),
    }
}

pub(crate) fn architecture(text: &str) -> Result<Architecture, String> {
    let known = Architecture::ALL.into_iter().find(|architecture| architecture.name() == text);
    known.ok_or_else(|| "expected serial or quasi-serial".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
    }
}
