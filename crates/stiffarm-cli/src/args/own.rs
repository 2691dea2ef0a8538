//! What do the commands take that are the program's own, and no verb of the library?
#![allow(rustdoc::broken_intra_doc_links, reason = "help texts put units and defaults in brackets")]
#![allow(clippy::doc_markdown, reason = "help texts are read in terminals, where backticks are noise")]

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use stiffarm::calibrate::Level;
use stiffarm::calibration::ControllerModel;
use stiffarm::drive::Architecture;
use stiffarm::interval::Interval;
use stiffarm::spatial::Pose;
use stiffarm_ask::request::{number, open_range, tool};

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
    /// How long an answer may take that is asked for at once, s; longer ones are told line by line
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
    /// Does a robot file count the joints as the pendant does? Three to ten postures read from it tell
    Verify(VerifyArgs),
}

/// A level, or `None` for the one with the largest evidence.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked(pub(crate) Option<Level>);

#[derive(Debug, Args)]
pub(crate) struct CalibrateArgs {
    /// A robot's name, or the path of a robot file
    pub(crate) robot: String,
    /// The table: joint_1_deg .. joint_6_deg as the robot reports them, and one to four points x1_mm, y1_mm, z1_mm .. in the
    /// tracker's frame, empty where one was not seen; or one point and a quaternion qw, qx, qy, qz
    pub(crate) points: String,
    /// How much may differ from the drawing, each with all before it: zeros, geometry, weight (the arm's own, on a floor), gears; auto takes
    /// the one with the largest evidence
    #[arg(long, value_name = "LEVEL", value_parser = level, default_value = "auto")]
    pub(crate) level: Asked,
    /// What columns are called in the table: joint_1_deg=J1,x1_mm=X
    #[arg(long, value_name = "NAME=HEADING", value_delimiter = ',', value_parser = column)]
    pub(crate) columns: Vec<(String, String)>,
    /// The column that tells apart where the tracker stood; each stand has a frame of its own
    #[arg(long, value_name = "COLUMN")]
    pub(crate) frame_by: Option<String>,
    /// Where the work is, x,y,z in the base frame [m]: the error that remains is told within 0.25 m about it [default: over all the
    /// arm reaches]
    #[arg(long, value_name = "POINT", value_parser = place, allow_hyphen_values = true)]
    pub(crate) at: Option<[f64; 3]>,
    /// With which arm the controller computes while it is measured, and later: nominal, the one that was drawn, or calibrated, with an
    /// absolute-accuracy option of its own; for the robot file, without it no program is written
    #[arg(long, value_name = "MODEL", value_parser = controller_model)]
    pub(crate) controller_model: Option<ControllerModel>,
    /// When it was measured, for the robot file [default: today]
    #[arg(long, value_name = "YYYY-MM-DD", value_parser = date)]
    pub(crate) date: Option<String>,
    /// Width of the figure on paper [mm], for svg, pdf and png at 300 dpi [default: 1000 px]
    #[arg(long, value_name = "MM", value_parser = width)]
    pub(crate) width_mm: Option<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct VerifyArgs {
    /// A robot's name or the path of a robot file, and the table of readings: joint_1_deg .. joint_6_deg, x_mm, y_mm, z_mm as the
    /// pendant shows them, and the maker's angles where it does (a_deg ..; w_deg ..; q1 .. q4; rx_deg ..; o_deg ..); or measured
    /// points x1_mm, y1_mm, z1_mm ..
    #[arg(required = true, num_args = 1..=2, value_names = ["ROBOT", "READINGS"])]
    pub(crate) asked: Vec<String>,
    /// Try all robots of the catalogue; the robot may be left out
    #[arg(long)]
    pub(crate) any: bool,
    /// The base of the robot file in the frame of the readings, x,y,z,rx,ry,rz [mm, deg about fixed axes], 0,0,0 where no base is in force; shows
    /// the zero of joint 1 [default: fitted]
    #[arg(long, value_name = "FRAME", value_parser = tool, allow_hyphen_values = true)]
    pub(crate) base_mm: Option<Pose>,
    /// The tool in force, in the flange frame, x,y,z,rx,ry,rz, 0,0,0 where none is; shows the zero of joint 6 [default: fitted]
    #[arg(long, value_name = "FRAME", value_parser = tool, allow_hyphen_values = true)]
    pub(crate) tool_mm: Option<Pose>,
    /// What columns are called in the table: joint_1_deg=J1,x_mm=X
    #[arg(long, value_name = "NAME=HEADING", value_delimiter = ',', value_parser = column)]
    pub(crate) columns: Vec<(String, String)>,
    /// The column that tells apart where the tracker stood; each stand has a frame of its own
    #[arg(long, value_name = "COLUMN")]
    pub(crate) frame_by: Option<String>,
    /// When it was read, for the robot file [default: today]
    #[arg(long, value_name = "YYYY-MM-DD", value_parser = date)]
    pub(crate) date: Option<String>,
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

/// `NAME=HEADING`.
fn column(text: &str) -> Result<(String, String), String> {
    let expected = || "expected NAME=HEADING, such as joint_1_deg=J1".to_owned();
    let (ours, theirs) = text.split_once('=').ok_or_else(expected)?;
    let [ours, theirs] = [ours, theirs].map(|part| part.trim().to_owned());
    if ours.is_empty() || theirs.is_empty() { Err(expected()) } else { Ok((ours, theirs)) }
}

fn date(text: &str) -> Result<String, String> {
    if stiffarm::catalogue::is_date(text) { Ok(text.into()) } else { Err("expected a day such as 2026-05-31".into()) }
}

fn level(text: &str) -> Result<Asked, String> {
    if text == "auto" {
        return Ok(Asked(None));
    }
    let known = Level::ALL.into_iter().find(|level| level.name() == text);
    known.map(|level| Asked(Some(level))).ok_or_else(|| "expected auto, zeros, geometry, weight or gears".into())
}

fn controller_model(text: &str) -> Result<ControllerModel, String> {
    let known = ControllerModel::ALL.into_iter().find(|model| model.name() == text);
    known.ok_or_else(|| "expected nominal or calibrated".into())
}

/// `x,y,z` in m.
fn place(text: &str) -> Result<[f64; 3], String> {
    let expected = || "expected x,y,z in m, each from -20 to 20".to_owned();
    let numbers = text.split(',').map(|part| number(part, -20.0, 20.0, "m").map_err(|_| expected()));
    numbers.collect::<Result<Vec<_>, _>>()?.try_into().map_err(|_| expected())
}
