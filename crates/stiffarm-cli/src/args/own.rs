//! What do the commands take that are the program's own, and no verb of the library?
#![allow(rustdoc::broken_intra_doc_links, reason = "help texts put units and defaults in brackets")]
#![allow(clippy::doc_markdown, reason = "help texts are read in terminals, where backticks are noise")]

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm_ask::request::{number, open_range};

#[derive(Debug, Args)]
pub(crate) struct PaperArgs {
    /// Format of the figures
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = Pictures::Svg)]
    pub(crate) pictures: Pictures,
    /// Width of the figures on paper [mm] [default: 1000 px]
    #[arg(long, value_name = "MM", value_parser = width)]
    pub(crate) width_mm: Option<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct ServeArgs {
    /// Where to listen: an address of this machine, or its name; whoever reaches it may ask
    #[arg(long, value_name = "HOST", default_value = "127.0.0.1")]
    pub(crate) host: String,
    /// On which port; 0 takes a free one, and tells it
    #[arg(long, value_name = "PORT", default_value_t = 0)]
    pub(crate) port: u16,
    /// Open the page in the browser
    #[arg(long)]
    pub(crate) open: bool,
    /// How long an answer may take that is asked for at once, s; longer ones are sent line by line
    #[arg(long, value_name = "S", default_value_t = 30, value_parser = clap::value_parser!(u64).range(1..=3600))]
    pub(crate) time_limit_s: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Pictures {
    Svg,
    Pdf,
    Png,
}

impl Pictures {
    /// The ending of its files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Pdf => "pdf",
            Self::Png => "png",
        }
    }
}

#[derive(Debug, Subcommand)]
pub(crate) enum RobotsAction {
    /// Geometry, limits and sources of one robot; -o draws what it reaches
    Show {
        /// A robot's name, or the path of a robot file
        robot: String,
        /// Width of the figure on paper [mm], for svg, pdf and png at 300 dpi [default: 1000 px]
        #[arg(long, value_name = "MM", value_parser = width)]
        width_mm: Option<f64>,
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
    /// A URDF, a macro file (xacro) of one arm, or OPW parameters (`opw_parameters_*.yaml`); -o robot.toml writes the robot file
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
    /// Enclose the links by capsules, from the collision meshes that a URDF names (STL; boxes, cylinders, spheres): what the arm may touch is then known
    #[arg(long)]
    pub(crate) meshes: bool,
    /// Where a package lies whose meshes a URDF names: NAME=FOLDER [default: found above the URDF by its package.xml]
    #[arg(long, value_name = "NAME=FOLDER", value_parser = package, requires = "meshes")]
    pub(crate) package: Vec<(String, PathBuf)>,
    /// The link whose frame is the base [default: the base of the arm]
    #[arg(long, value_name = "LINK")]
    pub(crate) base: Option<String>,
    /// The link whose frame is the flange [default: flange or tool0, or the link that joint 6 moves]
    #[arg(long, value_name = "LINK")]
    pub(crate) tip: Option<String>,
}

/// `NAME=FOLDER`.
fn package(text: &str) -> Result<(String, PathBuf), String> {
    match text.split_once('=') {
        Some((name, folder)) if !name.is_empty() && !folder.is_empty() => Ok((name.into(), folder.into())),
        _ => Err("expected NAME=FOLDER, such as arm_support=../arm_support".into()),
    }
}

fn payload(text: &str) -> Result<f64, String> {
    number(text, 0.1, 1e4, "kg")
}

fn width(text: &str) -> Result<f64, String> {
    number(text, 40.0, 2000.0, "mm")
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

fn architecture(text: &str) -> Result<Architecture, String> {
    let known = Architecture::ALL.into_iter().find(|architecture| architecture.name() == text);
    known.ok_or_else(|| "expected serial or quasi-serial".into())
}
