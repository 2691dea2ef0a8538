//! What do people ask, in their own units? Options from words, mm and degrees, with the usual answer where nothing is said.

use std::f64::consts::{FRAC_PI_2, PI};
use std::str::FromStr;

use nalgebra::{Rotation3, Translation3};

use crate::interval::Interval;
use crate::load::Load;
use crate::model::ModelKind;
use crate::place::{Orientation, PlaceOptions, Stance, Within};
use crate::spatial::Pose;
use crate::task::{Task, Zone};

/// What is asked of a placement, whatever the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Cutting force.
    pub load: Load,
    /// Where the zone may stand, m from the robot's base; anywhere, or in space in front of the joint-1 axis and above the
    /// base, where `None`.
    pub within: Option<Within>,
    /// Of a rectangle.
    pub angle: Angle,
    /// Largest relative distance between a value and its proof; that of the paper's options where `None`.
    pub gap: Option<f64>,
}

/// How the tool is held, in space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Held {
    /// The tool frame in the flange frame; the flange where `None`.
    pub tool: Option<Pose>,
    /// Angle of the tool axis above the horizontal, deg; down where `None`.
    pub elevation_deg: Option<f64>,
    /// Angles of the zone about the vertical, rad; the best of a half turn where `None`.
    pub yaw: Option<Interval>,
    /// About the tool axis, deg; the best where `None`.
    pub roll_deg: Option<f64>,
}

/// What a model cannot be asked; the first word is the name of the option.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unasked {
    /// A proof in space.
    #[error("gap is of the planar model: the spatial search proves 1 % where it can")]
    Gap,
    /// On a table no side is the upper one.
    #[error(
        "angle horizontal and vertical mean the long side on a wall; on a table give degrees, 0 has the first side ahead"
    )]
    LongSide,
    /// A vertical tool has no yaw.
    #[error("yaw-deg turns nothing where the tool points straight down or up; the angle of the zone does")]
    Yaw,
}

impl Wanted {
    /// In the arm plane.
    pub fn planar(&self, zone: Zone) -> PlaceOptions {
        PlaceOptions {
            orientation: self.angle.orientation(zone),
            within: self.within,
            gap: self.gap,
            ..PlaceOptions::under(self.load)
        }
    }

    /// In space, for zones of any shape.
    ///
    /// # Errors
    /// Where the spatial model has no answer.
    pub fn spatial(&self, held: &Held) -> Result<PlaceOptions, Unasked> {
        if self.gap.is_some() {
            return Err(Unasked::Gap);
        }
        let usual = Stance::tool_at(held.elevation());
        let is_vertical = FRAC_PI_2 - usual.elevation.abs() < 1e-9;
        if held.yaw.is_some() && is_vertical {
            return Err(Unasked::Yaw);
        }
        let is_wall = held.elevation().abs() < 1.5;
        let orientation = match self.angle {
            Angle::Axes => Orientation::Axes,
            Angle::Free => Orientation::Free,
            Angle::Degrees(angle) => Orientation::Fixed(angle.to_radians()),
            Angle::Horizontal | Angle::Vertical if is_wall => Orientation::Axes,
            Angle::Horizontal | Angle::Vertical => return Err(Unasked::LongSide),
        };
        let stance = Stance { yaw: held.yaw.unwrap_or(usual.yaw), roll: held.roll(), ..usual };
        Ok(PlaceOptions { orientation, within: self.within, stance: Some(stance), ..PlaceOptions::under(self.load) })
    }

    /// The same for one zone, of which it is known which side is the long one.
    ///
    /// # Errors
    /// As [`Self::spatial`].
    pub fn spatial_for(&self, held: &Held, zone: Zone) -> Result<PlaceOptions, Unasked> {
        let options = self.spatial(held)?;
        let [first, second] = zone.sides();
        let upright = if second <= first { 0.0 } else { 90.0_f64 };
        let orientation = match self.angle {
            Angle::Vertical => Orientation::Fixed(upright.to_radians()),
            Angle::Horizontal => Orientation::Fixed((90.0 - upright).to_radians()),
            _ => options.orientation,
        };
        Ok(PlaceOptions { orientation, ..options })
    }

    /// The options of a model for one zone, or for zones of any shape where there is none.
    ///
    /// # Errors
    /// As [`Self::spatial`].
    pub fn options(&self, model: &ModelKind, held: &Held, zone: Option<Zone>) -> Result<PlaceOptions, Unasked> {
        match (model, zone) {
            (ModelKind::Planar, Some(zone)) => Ok(self.planar(zone)),
            (ModelKind::Planar, None) => Ok(self.planar(Zone::Circle { diameter: 1.0 })),
            (ModelKind::Spatial(_), Some(zone)) => self.spatial_for(held, zone),
            (ModelKind::Spatial(_), None) => self.spatial(held),
        }
    }
}

impl Held {
    /// Of the tool axis above the horizontal, rad.
    pub fn elevation(&self) -> f64 {
        self.elevation_deg.unwrap_or(-90.0).to_radians()
    }

    /// The tool frame in the flange frame.
    pub fn tool(&self) -> Pose {
        self.tool.unwrap_or_else(Pose::identity)
    }

    /// About the tool axis, rad.
    pub fn roll(&self) -> Option<f64> {
        self.roll_deg.map(f64::to_radians)
    }
}

/// Tasks of which no two have the same zone, in their order.
pub fn distinct(tasks: &[Task]) -> Vec<Task> {
    let mut kept: Vec<Task> = Vec::new();
    for task in tasks {
        if !kept.iter().any(|known| known.zone == task.zone) {
            kept.push(task.clone());
        }
    }
    kept
}

/// The angles of a rectangle as people ask for them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Angle {
    /// First side horizontal or vertical.
    Axes,
    /// The long side horizontal.
    Horizontal,
    /// The long side vertical.
    Vertical,
    /// Any.
    Free,
    /// Of the first side, deg.
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

/// A number within its bounds; the unit is for the words of the refusal.
///
/// # Errors
/// What was expected.
pub fn number(text: &str, min: f64, max: f64, unit: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if min <= value && value <= max => Ok(value),
        _ => Err(format!("expected a number from {min} to {max} {unit}")),
    }
}

/// An angle, deg.
///
/// # Errors
/// What was expected.
pub fn degrees(text: &str) -> Result<f64, String> {
    number(text, -360.0, 360.0, "degrees")
}

/// `x,y,z` or `x,y,z,rx,ry,rz`, in mm and degrees about fixed x, y, z.
///
/// # Errors
/// What was expected.
pub fn tool(text: &str) -> Result<Pose, String> {
    let expected = || "expected x,y,z in mm, or x,y,z,rx,ry,rz with degrees; lengths up to 10000 mm".to_owned();
    let numbers = text.split(',').map(|part| number(part, -10_000.0, 10_000.0, "").map_err(|_| expected()));
    let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
    let ([x, y, z], [rx, ry, rz]) = match *numbers.as_slice() {
        [x, y, z] => ([x, y, z], [0.0; 3]),
        [x, y, z, rx, ry, rz] => ([x, y, z], [rx, ry, rz].map(f64::to_radians)),
        _ => return Err(expected()),
    };
    Ok(Pose::from_parts(Translation3::new(x / 1e3, y / 1e3, z / 1e3), Rotation3::from_euler_angles(rx, ry, rz).into()))
}

/// The tool axis in words, or degrees above the horizontal.
///
/// # Errors
/// What was expected.
pub fn elevation(text: &str) -> Result<f64, String> {
    match text {
        "down" => Ok(-90.0),
        "forward" => Ok(0.0),
        "up" => Ok(90.0),
        _ => number(text, -90.0, 90.0, "")
            .map_err(|_| "expected down, forward, up, or -90 to 90 degrees above the horizontal".into()),
    }
}

/// `any`, or the yaw of a zone in degrees; in radians.
///
/// # Errors
/// What was expected.
pub fn yaw(text: &str) -> Result<Interval, String> {
    if text == "any" {
        return Ok(Interval::spanning(-PI, PI));
    }
    let angle = degrees(text).map_err(|_| "expected any, or an angle from -360 to 360 degrees".to_owned())?;
    Ok(Interval::point(angle.to_radians()))
}

/// A shape at size 1: a letter of the paper, or a task.
///
/// # Errors
/// What was expected.
pub fn shape(text: &str) -> Result<Task, String> {
    let notation = if text.contains(':') { text.into() } else { format!("{text}:1") };
    let task: Task = notation.parse().map_err(|_| "expected A, B, C, or a shape such as rect:1x3".to_owned())?;
    Ok(Task { label: text.into(), ..task })
}

/// `a..b`; either end may be left open.
///
/// # Errors
/// What was expected.
pub fn open_range(text: &str) -> Result<Interval, String> {
    let expected = || format!("'{text}' is not a range; expected such as 0.5..2, 0.5.. or ..2, the lower end first");
    let (low, high) = text.split_once("..").ok_or_else(expected)?;
    let end = |text: &str, open: f64| {
        if text.trim().is_empty() {
            return Ok(open);
        }
        number(text, -1e5, 1e5, "").map_err(|_| expected())
    };
    Interval::new(end(low, f64::NEG_INFINITY)?, end(high, f64::INFINITY)?).ok_or_else(expected)
}

/// `x0..x1,z0..z1` in m; without the second range any height.
///
/// # Errors
/// What was expected.
pub fn within(text: &str) -> Result<Within, String> {
    // One range alone is that of x.
    let (x, z) = text.split_once(',').unwrap_or((text, ".."));
    Ok(Within { x: open_range(x)?, z: open_range(z)? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_may_be_open_at_any_end() {
        let place = within("0.5..2,..1.5").unwrap();
        assert_eq!((place.x.min(), place.x.max()), (0.5, 2.0));
        assert_eq!((place.z.min(), place.z.max()), (f64::NEG_INFINITY, 1.5));
        assert_eq!(within("..,..").unwrap(), Within::ANYWHERE);
        assert_eq!(within("1..").unwrap().z, Interval::ALL);
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
