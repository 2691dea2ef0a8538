//! How are angles, windows, tools and shapes written, in m, mm and degrees?

use std::f64::consts::PI;
use std::str::FromStr;

use nalgebra::{Rotation3, Translation3};

use crate::interval::Interval;
use crate::place::{Orientation, Within};
use crate::spatial::Pose;
use crate::task::{Task, Zone};

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
    /// Of the first side of a zone.
    pub(super) fn orientation(self, zone: Zone) -> Orientation {
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
