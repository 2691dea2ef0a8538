//! Questions about places in space, drawn at random: the witness answers them, and the benchmark counts what is proved.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use nalgebra::Vector3;
use stiffarm::catalogue::{entries, paper_robots};
use stiffarm::drive::{Architecture, Drives, JointCompliance};
use stiffarm::geometry::Geometry;
use stiffarm::interval::Interval;
use stiffarm::limits::{Limits, Pendant, ThirdAxis};
use stiffarm::load::Load;
use stiffarm::model::{Model, ModelError};
use stiffarm::place::{Column, Margins, Orientation, PlaceError, PlaceOptions, Placed, ToolOrientation, Within, place};
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;
use stiffarm::task::Zone;
use stiffarm::watch::Watch;

/// What is asked of one robot.
#[derive(Clone, Debug)]
pub(crate) struct Question {
    pub(crate) robot: Robot,
    pub(crate) zone: Zone,
    pub(crate) options: Asked,
}

/// What is asked besides robot and zone, with nothing left open.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    pub(crate) force: f64,
    pub(crate) flange_from_tool: Pose,
    pub(crate) elevation: f64,
    pub(crate) yaw: Interval,
    pub(crate) orientation: Orientation,
    pub(crate) roll: Option<f64>,
    pub(crate) within: Within,
    pub(crate) margins: Margins,
}

impl Asked {
    /// Tool down, the flange itself as the tool.
    pub(crate) fn tool_down(force: f64) -> Self {
        let ToolOrientation { elevation, yaw, roll } = ToolOrientation::tool_down();
        let (flange_from_tool, orientation) = (Pose::identity(), Orientation::Axes);
        Self {
            force,
            flange_from_tool,
            elevation,
            yaw,
            orientation,
            roll,
            within: Within::AHEAD,
            margins: Margins::NONE,
        }
    }

    pub(crate) fn place(&self, robot: &Robot, zone: Zone) -> Result<Placed, PlaceError> {
        let Self { force, flange_from_tool, elevation, yaw, orientation, roll, within, margins } = *self;
        let load = Load::worst(force).expect("a force");
        let options = PlaceOptions {
            orientation,
            within: Some(within),
            tool_orientation: Some(ToolOrientation { elevation, yaw, roll }),
            margins,
            ..PlaceOptions::under(load)
        };
        let model: Result<Model, ModelError> = Model::spatial(robot, &flange_from_tool);
        place(&model?, &zone.into(), &options, Watch::nobody())
    }
}

/// An arm as no maker builds it, with limits anywhere.
pub(crate) fn random_robot(rng: &mut fastrand::Rng) -> Robot {
    let architecture = rng.choice(Architecture::ALL).unwrap();
    let mut length = |low: f64, high: f64| low + (high - low) * rng.f64();
    let geometry = Geometry {
        a1: length(-0.1, 0.6),
        a2: length(-0.25, 0.25),
        b: length(-0.3, 0.15).max(0.0),
        c1: length(0.3, 0.9),
        c2: length(0.6, 1.3),
        c3: length(0.6, 1.5),
        c4: length(0.0, 0.3),
        offset: std::array::from_fn(|_| length(-PI, PI)),
        sign: std::array::from_fn(|_| if length(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 }),
    };
    let drives = JointCompliance(std::array::from_fn(|_| 1e-6 * length(0.2, 3.0)));
    let third_axis = if length(0.0, 1.0) < 0.5 { ThirdAxis::Elbow } else { ThirdAxis::Forearm };
    // Middle and half width of the model angles, before they are seen as reported.
    let about = [(0.0, 3.0), (0.6, 1.3), (1.2, 1.6), (0.0, 3.0), (0.0, 2.0), (0.0, 3.5)];
    let joints = std::array::from_fn(|joint| {
        let (middle, half) = about[joint];
        let (middle, half) = (middle + length(-0.5, 0.5), half * length(0.5, 1.3));
        let seen = |theta: f64| (theta + geometry.offset[joint]) * geometry.sign[joint];
        if length(0.0, 1.0) < 0.15 {
            Interval::ALL
        } else {
            Interval::spanning(seen(middle - half), seen(middle + half))
        }
    });
    let elbow =
        if length(0.0, 1.0) < 0.5 { Interval::ALL } else { Interval::spanning(length(0.2, 1.0), length(2.6, 3.6)) };
    let limits = Limits { joints, third_axis, pendant: Pendant::Unknown, elbow, speeds: None };
    let mut robot = paper_robots().swap_remove(0);
    robot.architecture = architecture;
    robot.arm = Arm::SixAxis { geometry, limits, drives: Drives::new(architecture, drives) };
    robot
}

/// Every other one about a robot of the catalogue; one zone in eight is too large for most arms; one in three asks for margins.
pub(crate) fn random_question(seed: u64) -> Question {
    let mut rng = fastrand::Rng::with_seed(seed);
    let robot = if seed.is_multiple_of(2) {
        random_robot(&mut rng)
    } else {
        loop {
            let entries = entries();
            let robot = entries[rng.usize(0..entries.len())].robot();
            if matches!(robot.arm, Arm::SixAxis { .. }) {
                break robot;
            }
        }
    };
    let reach = robot.stretch();
    // One in eight too large for most arms.
    let size = reach * if seed % 8 < 7 { 0.05 + 0.5 * rng.f64().powi(2) } else { 0.8 + rng.f64() };
    let zone = match rng.u8(0..3) {
        0 => Zone::Circle { diameter: size },
        1 => Zone::Rectangle { width: size, height: size / 2.0 },
        _ => Zone::Rectangle { width: size * (0.4 + 0.5 * rng.f64()), height: size },
    };
    let mut options = Asked::tool_down(100.0 + 2000.0 * rng.f64());
    options.elevation = [-FRAC_PI_2, -FRAC_PI_2, 0.0, 30_f64.to_radians(), FRAC_PI_2][rng.usize(0..5)];
    options.yaw = match rng.u8(0..4) {
        0 => Interval::point(0.0),
        1 => Interval::spanning(-2.0, -0.5),
        _ => options.yaw,
    };
    options.orientation = match rng.u8(0..4) {
        0 => Orientation::Fixed(3.0 * rng.f64()),
        1 => Orientation::Free,
        _ => Orientation::Axes,
    };
    let long = 0.3 * rng.f64();
    options.flange_from_tool = match rng.u8(0..4) {
        0 => Pose::identity(),
        1 => Pose::translation(0.0, 0.0, long),
        2 => Pose::translation(0.15, -0.1, long),
        _ => Pose::new(Vector3::new(0.0, 0.1, long), Vector3::new(0.2, FRAC_PI_4, -0.5)),
    };
    if rng.u8(0..3) == 0 {
        options.roll = Some(TAU * (rng.f64() - 0.5));
    }
    if rng.u8(0..3) == 0 {
        let (low, left) = (reach * (0.6 * rng.f64() - 0.2), 0.5 * reach * rng.f64());
        options.within.x = Interval::spanning(left, left + size * (1.0 + rng.f64()));
        options.within.z = Interval::spanning(low, low + size * (1.0 + 2.0 * rng.f64()));
        // Some of the windows behind the robot, some across its axis.
        match rng.u8(0..4) {
            0 => options.within.x = options.within.x.affine(-1.0, 0.0),
            1 => options.within.x = options.within.x.affine(1.0, -left - size * rng.f64()),
            _ => {}
        }
    }
    if seed % 3 == 1 {
        let [limit, singular] = [0.2, 0.5].map(|most| most * rng.f64());
        let column = Column::Radius(0.4 * reach * rng.f64());
        options.margins = Margins { limit, singular, column, ..Margins::NONE };
    }
    Question { robot, zone, options }
}
