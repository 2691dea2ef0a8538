//! Paths for studies, without a file: contours, a line, a raster over a zone.

use std::f64::consts::TAU;
use std::str::FromStr;

use nalgebra::Vector3;

use super::fault::{PathFault, shown};
use super::moves::{Arc, Course, Given, Move, MoveKind, ToolPose};
use crate::zone::Zone;

/// The shortest and the longest side of a path, m.
const SIZES: std::ops::RangeInclusive<f64> = 1e-4..=50.0;

/// More tracks are no raster.
const MOST_TRACKS: f64 = 100_000.0;

/// What is expected, for messages.
const EXPECTED: &str = "expected circle:D, rect:AxB (contours), line:L, or raster:ZONE@STEP such as raster:rect:0.4x0.2@0.02, with sizes in m";

/// A path built in: about the origin of the part, in its plane z = 0, the tool along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Builtin {
    /// The contour of a zone, once, counter-clockwise from above.
    Contour(Zone),
    /// Along x, so long, m.
    Line(f64),
    /// To and fro along x over a zone, tracks so far apart at most, m, and from one to the next along y or its edge.
    Raster(Zone, f64),
}

impl FromStr for Builtin {
    type Err = PathFault;

    fn from_str(text: &str) -> Result<Self, PathFault> {
        let wrong = |why: String| PathFault::Notation { text: shown(text), why };
        let size = |part: &str| {
            let size: f64 =
                part.trim().parse().map_err(|_| wrong(format!("'{}' is no number; {EXPECTED}", shown(part))))?;
            if SIZES.contains(&size) {
                Ok(size)
            } else {
                Err(wrong(format!("a length of {size} m; expected {} to {} m", SIZES.start(), SIZES.end())))
            }
        };
        let zone = |text: &str| text.parse::<Zone>().map_err(|error| wrong(error.to_string()));
        match text.split_once(':') {
            Some(("circle" | "rect", _)) => Ok(Self::Contour(zone(text)?)),
            Some(("line", length)) => Ok(Self::Line(size(length)?)),
            Some(("raster", rest)) => {
                let (of, step) = rest.split_once('@').ok_or_else(|| wrong(EXPECTED.into()))?;
                let (of, step) = (zone(of)?, size(step)?);
                let across = of.sides()[1];
                if across < step * (1.0 - 1e-9) {
                    return Err(wrong(format!("tracks {step} m apart over {across} m; expected at most that")));
                }
                if MOST_TRACKS < across / step {
                    return Err(wrong(format!("more than {MOST_TRACKS} tracks; expected a wider step")));
                }
                Ok(Self::Raster(of, step))
            }
            _ => Err(wrong(EXPECTED.into())),
        }
    }
}

impl Builtin {
    /// Does a text mean a path built in, rather than a file?
    pub fn is_meant(text: &str) -> bool {
        text.split_once(':').is_some_and(|(kind, _)| matches!(kind, "circle" | "rect" | "line" | "raster"))
    }

    /// Its moves, at a feed rate, m/s.
    pub fn moves(&self, feed: Option<f64>) -> Vec<Move> {
        match *self {
            Self::Contour(Zone::Circle { diameter }) => {
                let start = pose([diameter / 2.0, 0.0]);
                let arc = Arc { centre: Vector3::zeros(), normal: Vector3::z(), angle: TAU };
                vec![Move { course: Course::Arc(arc), ..straight(start, start, feed) }]
            }
            Self::Contour(Zone::Rectangle { width, height }) => {
                let (x, y) = (width / 2.0, height / 2.0);
                along(&[[-x, -y], [x, -y], [x, y], [-x, y], [-x, -y]], feed)
            }
            Self::Line(length) => along(&[[-length / 2.0, 0.0], [length / 2.0, 0.0]], feed),
            Self::Raster(zone, step) => along(&raster(zone, step), feed),
        }
    }
}

fn pose([x, y]: [f64; 2]) -> ToolPose {
    ToolPose { tip: Vector3::new(x, y, 0.0), axis: Vector3::z() }
}

fn straight(from: ToolPose, to: ToolPose, feed: Option<f64>) -> Move {
    Move { line: 0, kind: MoveKind::Feed, from, to, course: Course::Line, feed, normals: None, given: Given::default() }
}

fn along(points: &[[f64; 2]], feed: Option<f64>) -> Vec<Move> {
    points
        .windows(2)
        .map(|pair| straight(pose(pair[0]), pose(pair[1]), feed))
        .filter(|one| one.from != one.to)
        .collect()
}

/// The corners of the tracks: evenly from the lower edge to the upper one; of a circle half a step inside it.
fn raster(zone: Zone, step: f64) -> Vec<[f64; 2]> {
    let [width, height] = zone.sides();
    let spaces = (height / step - 1e-9).ceil().max(1.0);
    let (count, at): (usize, Box<dyn Fn(f64) -> f64>) = match zone {
        Zone::Rectangle { .. } => (spaces as usize + 1, Box::new(move |k| height * (k / spaces - 0.5))),
        Zone::Circle { .. } => (spaces as usize, Box::new(move |k| height * ((k + 0.5) / spaces - 0.5))),
    };
    let half = |y: f64| match zone {
        Zone::Rectangle { .. } => width / 2.0,
        Zone::Circle { diameter } => ((diameter / 2.0).powi(2) - y * y).max(0.0).sqrt(),
    };
    (0..count)
        .flat_map(|k| {
            let y = at(k as f64);
            let x = if k.is_multiple_of(2) { half(y) } else { -half(y) };
            [[-x, y], [x, y]]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(text: &str) -> f64 {
        text.parse::<Builtin>().unwrap().moves(None).iter().map(Move::length).sum()
    }

    #[test]
    fn paths_are_as_long_as_by_hand() {
        for (text, expected) in [
            ("circle:0.4", 0.4 * std::f64::consts::PI),
            ("rect:0.4x0.2", 1.2),
            ("line:0.5", 0.5),
            // Three tracks of 0.4 m and two links of 0.1 m.
            ("raster:rect:0.4x0.2@0.1", 1.4),
            // Two chords at y = -0.1 and 0.1 in a circle of radius 0.2, and the link between them.
            ("raster:circle:0.4@0.2", 4.0 * (0.04_f64 - 0.01).sqrt() + 0.2),
        ] {
            assert!((length(text) - expected).abs() < 1e-12, "{text}: {} is not {expected}", length(text));
        }
    }

    #[test]
    fn what_is_no_path_is_refused_with_what_was_expected() {
        for text in [
            "line",
            "line:",
            "line:-1",
            "line:NaN",
            "raster:rect:1x1",
            "raster:rect:1x1@0",
            "circle:x",
            "spiral:1",
            "raster:rect:1x50@0.0001",
            // Millimetres for metres.
            "raster:rect:0.4x0.2@20",
        ] {
            let message = text.parse::<Builtin>().unwrap_err().to_string();
            assert!(message.contains("expected"), "{message}");
        }
        assert!(Builtin::is_meant("line:x") && !Builtin::is_meant("C:path.nc") && !Builtin::is_meant("a.nc"));
    }
}
