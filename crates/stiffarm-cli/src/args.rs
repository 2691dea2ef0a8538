//! What can be asked for on the command line.
#![allow(rustdoc::broken_intra_doc_links, reason = "help texts put units and defaults in brackets")]

use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, Parser, Subcommand, ValueEnum};
use stiffarm::drive::Architecture;
use stiffarm::limits::Range;
use stiffarm::map::Component;
use stiffarm::place::{Orientation, PlaceOptions, Within};
use stiffarm::plane::Elbow;
use stiffarm::task::{Task, Zone};

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
    #[arg(long, value_name = "RANGES", value_parser = within, default_value = "..,..", hide_default_value = true, allow_hyphen_values = true)]
    pub(crate) within: Within,
    /// Angle of a rectangle: axes (horizontal or vertical), horizontal, vertical (its long side), free, or degrees of its first side
    #[arg(long, value_name = "ANGLE", value_parser = Angle::from_str, default_value = "axes", allow_hyphen_values = true)]
    pub(crate) angle: Angle,
    /// Largest relative distance between a value and its proof
    #[arg(long, value_name = "RATIO", default_value_t = 1e-4, value_parser = gap, allow_hyphen_values = true)]
    pub(crate) gap: f64,
}

impl Placing {
    pub(crate) fn options(&self, zone: Zone) -> PlaceOptions {
        let orientation = self.angle.orientation(zone);
        PlaceOptions { force: self.force_n, orientation, within: self.within, gap: self.gap }
    }
}

#[derive(Debug, Args)]
pub(crate) struct RankArgs {
    /// Robots: names, patterns (*), files, folders, or the set `paper`; separated by commas or given several times
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
}

#[derive(Debug, Args)]
pub(crate) struct ComplianceArgs {
    /// A robot's name, or the path of a robot file
    pub(crate) robot: String,
    /// The six joint angles as the robot reports them [deg], separated by commas
    #[arg(long, value_name = "Q1,..,Q6", value_delimiter = ',', required = true, allow_hyphen_values = true)]
    pub(crate) joints_deg: Vec<f64>,
    /// Force at the tool point, base axes [N]: x,y,z
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) force_n: Vec<f64>,
    /// Tool frame in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes [default: the flange centre]
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) tool_mm: Vec<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct StudyArgs {
    /// Shapes at size 1: A, B, C, or such as rect:1x3
    #[arg(long, value_name = "SHAPES", value_delimiter = ',', value_parser = shape, default_value = "A,B,C")]
    pub(crate) tasks: Vec<Task>,
    /// Sizes over l2 + l3
    #[arg(long, value_name = "SIZES", value_delimiter = ',', allow_hyphen_values = true, default_values_t = [0.1, 0.3, 0.5, 0.8])]
    pub(crate) sizes: Vec<f64>,
    /// Link ratios mu = l3/l2
    #[arg(long, value_name = "RATIOS", value_delimiter = ',', allow_hyphen_values = true, default_values_t = [0.8, 1.0, 1.2])]
    pub(crate) ratios: Vec<f64>,
    /// Link ratios among which the best is sought
    #[arg(long, value_name = "RANGE", value_parser = open_range, default_value = "0.5..1.5")]
    pub(crate) range: Range,
    /// The two architectures that are compared
    #[arg(long, value_name = "TWO", value_delimiter = ',', value_parser = architecture, default_value = "serial,quasi-serial")]
    pub(crate) compare: Vec<Architecture>,
    /// Compliance of drive 2 over the reference k, for both or one each
    #[arg(long, value_name = "K", value_delimiter = ',', allow_hyphen_values = true, default_value = "1")]
    pub(crate) k2: Vec<f64>,
    /// Compliance of drive 3 over the reference k, for both or one each
    #[arg(long, value_name = "K", value_delimiter = ',', allow_hyphen_values = true, default_value = "1")]
    pub(crate) k3: Vec<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct RobotsArgs {
    #[command(subcommand)]
    pub(crate) action: Option<RobotsAction>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum RobotsAction {
    /// The robots that come with the program
    List,
    /// Geometry, limits and sources of one robot
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

/// The angles of a rectangle as people ask for them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Angle {
    Axes,
    Horizontal,
    Vertical,
    Free,
    Degrees(f64),
}

impl Angle {
    fn orientation(self, zone: Zone) -> Orientation {
        let [first, second] = zone.sides();
        let lying = if second <= first { 0.0 } else { 90.0_f64 };
        match self {
            Self::Axes => Orientation::Axes,
            Self::Free => Orientation::Free,
            Self::Horizontal => Orientation::Fixed(lying.to_radians()),
            Self::Vertical => Orientation::Fixed((90.0 - lying).to_radians()),
            Self::Degrees(angle) => Orientation::Fixed(angle.to_radians()),
        }
    }
}

impl FromStr for Angle {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "axes" => Ok(Self::Axes),
            "horizontal" => Ok(Self::Horizontal),
            "vertical" => Ok(Self::Vertical),
            "free" => Ok(Self::Free),
            _ => degrees(text)
                .map(Self::Degrees)
                .map_err(|_| "expected axes, horizontal, vertical, free, or an angle from -360 to 360 degrees".into()),
        }
    }
}

fn number(text: &str, min: f64, max: f64, unit: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if min <= value && value <= max => Ok(value),
        _ => Err(format!("expected a number from {min} to {max} {unit}")),
    }
}

fn force(text: &str) -> Result<f64, String> {
    number(text, 1e-3, 1e6, "N")
}

fn gap(text: &str) -> Result<f64, String> {
    number(text, 1e-9, 0.5, "(relative)")
}

fn tolerance(text: &str) -> Result<f64, String> {
    number(text, 1e-6, 1e3, "mm")
}

fn degrees(text: &str) -> Result<f64, String> {
    number(text, -360.0, 360.0, "degrees")
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

fn architecture(text: &str) -> Result<Architecture, String> {
    let known = Architecture::ALL.into_iter().find(|architecture| architecture.name() == text);
    known.ok_or_else(|| "expected serial or quasi-serial".into())
}

/// A shape at size 1: a letter of the paper, or a task.
fn shape(text: &str) -> Result<Task, String> {
    let notation = if text.contains(':') { text.into() } else { format!("{text}:1") };
    let task: Task = notation.parse().map_err(|_| "expected A, B, C, or a shape such as rect:1x3".to_owned())?;
    Ok(Task { label: text.into(), ..task })
}

/// `a..b`; either end may be left open.
fn open_range(text: &str) -> Result<Range, String> {
    let expected = || format!("'{text}' is not a range; expected such as 0.5..2, 0.5.. or ..2, the lower end first");
    let (low, high) = text.split_once("..").ok_or_else(expected)?;
    let end = |text: &str, open: f64| {
        if text.trim().is_empty() {
            return Ok(open);
        }
        number(text, -1e3, 1e3, "").map_err(|_| expected())
    };
    Range::new(end(low, f64::NEG_INFINITY)?, end(high, f64::INFINITY)?).ok_or_else(expected)
}

/// `x0..x1,z0..z1` in m; without the second range any height.
pub(crate) fn within(text: &str) -> Result<Within, String> {
    // One range alone is that of x.
    let (x, z) = text.split_once(',').unwrap_or((text, ".."));
    Ok(Within { x: open_range(x)?, z: open_range(z)? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
    }

    #[test]
    fn a_place_may_be_open_at_any_end() {
        let place = within("0.5..2,..1.5").unwrap();
        assert_eq!((place.x.min(), place.x.max()), (0.5, 2.0));
        assert_eq!((place.z.min(), place.z.max()), (f64::NEG_INFINITY, 1.5));
        assert_eq!(within("..,..").unwrap(), Within::ANYWHERE);
        assert_eq!(within("1..").unwrap().z, Range::ALL);
        for bad in ["", "1", "2..1,..", "a..b,..", "1..2,..,3", "nan..1,..", "1..inf,.."] {
            assert!(within(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn horizontal_means_the_long_side() {
        let upright = Zone::Rectangle { width: 0.5, height: 1.0 };
        assert_eq!(Angle::Horizontal.orientation(upright), Orientation::Fixed(90_f64.to_radians()));
        assert_eq!(Angle::Vertical.orientation(upright), Orientation::Fixed(0.0));
    }
}
