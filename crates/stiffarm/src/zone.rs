//! Which flat figure does the tool sweep? In the paper's notation.

use std::fmt;
use std::str::FromStr;

use nalgebra::Vector2;

use crate::plane::Shape;

/// The smallest and the largest side that a zone may have, m.
const SIZES: std::ops::RangeInclusive<f64> = 1e-4..=50.0;

/// A flat zone in the arm plane. Sides in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Zone {
    /// A circle.
    Circle {
        /// Its diameter.
        diameter: f64,
    },
    /// A rectangle; its angle is that of the first side, from straight ahead, counter-clockwise.
    Rectangle {
        /// First side.
        width: f64,
        /// Second side.
        height: f64,
    },
}

/// A zone that cannot be understood.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ZoneError {
    /// Not of the form `shape:size`.
    #[error(
        "task '{text}' is not understood; expected circle:D, rect:AxB, A:d, B:d or C:d with sizes in m, e.g. rect:0.5x1.0; or a part, box:AxBxC"
    )]
    Form {
        /// What was given.
        text: String,
    },
    /// A size that is not a number.
    #[error("task '{text}': '{size}' is not a number; expected a size in m, e.g. 0.5")]
    Number {
        /// What was given.
        text: String,
        /// The part that is not a number.
        size: String,
    },
    /// A size outside what a robot can reach.
    #[error("task '{text}': a side of {size:?} m; expected {} to {} m{}", SIZES.start(), SIZES.end(), hint_millimetres(*size))]
    Size {
        /// What was given.
        text: String,
        /// The side.
        size: f64,
    },
}

fn hint_millimetres(size: f64) -> String {
    if SIZES.contains(&(size / 1000.0)) && 50.0 < size {
        format!(" (sizes are in metres: {size} mm would be {})", size / 1000.0)
    } else {
        String::new()
    }
}

impl Zone {
    /// The zone grown or shrunk about its centre.
    #[must_use]
    pub fn scaled(self, scale: f64) -> Self {
        match self {
            Self::Circle { diameter } => Self::Circle { diameter: diameter * scale },
            Self::Rectangle { width, height } => Self::Rectangle { width: width * scale, height: height * scale },
        }
    }

    /// It looks the same however it is turned.
    pub const fn is_round(self) -> bool {
        match self {
            Self::Circle { .. } => true,
            Self::Rectangle { .. } => false,
        }
    }

    /// The lengths that make the shape, m: the diameter twice, or both sides.
    pub fn sides(self) -> [f64; 2] {
        match self {
            Self::Circle { diameter } => [diameter; 2],
            Self::Rectangle { width, height } => [width, height],
        }
    }

    /// The point, m from the centre along the first and the second side, that a place in the square `-1..1` stands for:
    /// the square is stretched onto a rectangle, and squares about its centre become circles on a disc.
    pub fn at(self, [a, b]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Rectangle { width, height } => [a * width / 2.0, b * height / 2.0],
            Self::Circle { diameter } => disc(a, b).map(|part| part * diameter / 2.0),
        }
    }

    /// The figure in its own axes with its centre at `centre`.
    pub(crate) fn shape(self, centre: Vector2<f64>) -> Shape {
        match self {
            Self::Circle { diameter } => Shape::Disc(centre, diameter / 2.0),
            Self::Rectangle { width, height } => Shape::Rectangle(centre, Vector2::new(width, height) / 2.0),
        }
    }

    /// Half the width and height, m, of the upright box around the zone turned by `angle`, rad.
    pub fn half_extents(self, angle: f64) -> Vector2<f64> {
        match self {
            Self::Circle { diameter } => Vector2::repeat(diameter / 2.0),
            Self::Rectangle { width, height } => {
                let (s, c) = (angle.sin().abs(), angle.cos().abs());
                Vector2::new(width * c + height * s, width * s + height * c) / 2.0
            }
        }
    }

    /// How the zone can stand symmetrically about a ray from the joint-2 axis: its depth along the ray and half its
    /// width across; for a rectangle first with the first side along the ray, then across.
    pub(crate) fn symmetric_places(self) -> impl Iterator<Item = (f64, f64)> {
        let (along, across) = match self {
            Self::Circle { diameter } => ((diameter, 0.0), None),
            Self::Rectangle { width, height } => ((width, height / 2.0), Some((height, width / 2.0))),
        };
        std::iter::once(along).chain(across)
    }

    /// The factor by which the zone may grow before not even a fully folding arm of `l2 + l3 = 1` holds it.
    pub fn largest_size(self) -> f64 {
        self.symmetric_places().map(|(depth, half_width)| 1.0 / depth.hypot(half_width)).fold(0.0, f64::max)
    }

    /// The shape with the side lengths in mm, for people.
    pub fn describe(self) -> String {
        let mm = |side: f64| if side < 0.01 { format!("{:.3}", side * 1e3) } else { format!("{:.0}", side * 1e3) };
        match self {
            Self::Circle { diameter } => format!("circle of {} mm", mm(diameter)),
            Self::Rectangle { width, height } => format!("{} x {} mm", mm(width), mm(height)),
        }
    }
}

impl fmt::Display for Zone {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Circle { diameter } => write!(f, "circle:{diameter}"),
            Self::Rectangle { width, height } => write!(f, "rect:{width}x{height}"),
        }
    }
}

impl FromStr for Zone {
    type Err = ZoneError;

    /// `circle:D`, `rect:AxB`; the paper's `A:d` = `circle:d`, `B:d` = `rect:d x 2d`, `C:d` = `rect:d x 10d`; metres.
    fn from_str(text: &str) -> Result<Self, ZoneError> {
        let form = || ZoneError::Form { text: text.into() };
        let side = |size: &str| {
            let size: f64 =
                size.trim().parse().map_err(|_| ZoneError::Number { text: text.into(), size: size.into() })?;
            if SIZES.contains(&size) { Ok(size) } else { Err(ZoneError::Size { text: text.into(), size }) }
        };
        let (shape, sizes) = text.split_once(':').ok_or_else(form)?;
        let long = |factor: f64| {
            let width = side(sizes)?;
            let height = width * factor;
            if SIZES.contains(&height) {
                Ok(Self::Rectangle { width, height })
            } else {
                Err(ZoneError::Size { text: text.into(), size: height })
            }
        };
        match shape.trim().to_ascii_lowercase().as_str() {
            "circle" | "a" => Ok(Self::Circle { diameter: side(sizes)? }),
            "rect" => {
                let (width, height) = sizes.split_once(['x', 'X']).ok_or_else(form)?;
                Ok(Self::Rectangle { width: side(width)?, height: side(height)? })
            }
            "b" => long(2.0),
            "c" => long(10.0),
            _ => Err(form()),
        }
    }
}

/// The square `-1..1` onto the unit disc.
fn disc(a: f64, b: f64) -> [f64; 2] {
    let quarter = std::f64::consts::FRAC_PI_4;
    if a == 0.0 && b == 0.0 {
        [0.0, 0.0]
    } else if b.abs() <= a.abs() {
        let angle = quarter * b / a;
        [a * angle.cos(), a * angle.sin()]
    } else {
        let angle = quarter * a / b;
        [b * angle.sin(), b * angle.cos()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_letters_are_shorthand_for_shapes() {
        let zone = |text: &str| text.parse::<Zone>().unwrap();
        assert_eq!(zone("A:0.5"), zone("circle:0.5"));
        assert_eq!(zone("b:0.5"), zone("rect:0.5x1.0"));
        assert_eq!(zone("C: 0.15"), zone("rect:0.15 x 1.5"));
    }

    #[test]
    fn what_is_no_task_is_refused_with_what_was_expected() {
        let message = |text: &str| text.parse::<Zone>().unwrap_err().to_string();
        for (text, expected) in [
            ("", "expected circle:D"),
            ("hexagon:1", "expected circle:D"),
            ("rect:0.5", "expected circle:D"),
            ("circle:big", "'big' is not a number"),
            ("circle:0", "expected 0.0001 to 50 m"),
            ("circle:-1", "a side of -1.0 m"),
            ("circle:NaN", "a side of NaN m"),
            ("rect:1xinf", "a side of inf m"),
            ("circle:1e300", "expected 0.0001 to 50 m"),
            ("C:40", "a side of 400.0 m"),
            ("circle:500", "500 mm would be 0.5"),
        ] {
            assert!(message(text).contains(expected), "{text}: {}", message(text));
        }
    }
}
