//! What must be machined on several sides: flat faces that keep their places towards one another.

use std::f64::consts::{FRAC_PI_2, PI};
use std::str::FromStr;

use crate::zone::{Zone, ZoneError};

/// A part with the faces on which it is machined: each is met by the tool at a right angle, in a configuration of its own.
///
/// Part axes: z up from the middle of its underside, x along its first side, y to the left of that.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// As the user wrote it, e.g. `box:0.8x0.5x0.1`.
    pub label: String,
    /// At least one.
    pub faces: Vec<Face>,
}

/// A flat face of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// `top`, `front`, ...
    pub name: String,
    /// What of it is machined.
    pub zone: Zone,
    /// Its centre in part axes, m.
    pub centre: [f64; 3],
    /// Angle of the tool axis above the horizontal, rad: `-pi/2` on top.
    pub elevation: f64,
    /// Angle of the tool axis about the vertical from the part's x axis, rad; of a vertical tool, where the zone's first side points.
    pub azimuth: f64,
}

/// A part that cannot be understood.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PartError {
    /// A size or a zone.
    #[error(transparent)]
    Zone(#[from] ZoneError),
    /// Not three sizes.
    #[error(
        "part '{0}' is not understood; expected box:AxBxC with sizes in m: length, width, height, e.g. box:0.8x0.5x0.1"
    )]
    Box(String),
    /// A face of the list.
    #[error(
        "face '{0}' is not understood; expected ZONE@x,y,z,DIRECTION[,AZIMUTH], e.g. rect:0.8x0.5@0,0,0.1,down or circle:0.2@0.4,0,0.05,forward,180"
    )]
    Face(String),
    /// A name that no face has.
    #[error("no face '{name}'; this part has {known}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// What there is.
        known: String,
    },
    /// Asked for twice.
    #[error("face '{0}' is named twice")]
    Twice(String),
}

impl Part {
    /// A box that stands on its underside: length along x, width along y, height; m. All faces but the underside: `top`, `front` (towards
    /// negative x), `left`, `back`, `right`.
    pub fn of_box([length, width, height]: [f64; 3]) -> Self {
        let rectangle = |width: f64, height: f64| Zone::Rectangle { width, height };
        let top = Face {
            name: "top".into(),
            zone: rectangle(length, width),
            centre: [0.0, 0.0, height],
            elevation: -FRAC_PI_2,
            azimuth: 0.0,
        };
        // The tool points into the face; its zone's first side is upright.
        let side = |name: &str, [x, y]: [f64; 2], wide: f64, azimuth: f64| Face {
            name: name.into(),
            zone: rectangle(height, wide),
            centre: [x, y, height / 2.0],
            elevation: 0.0,
            azimuth,
        };
        let faces = vec![
            top,
            side("front", [-length / 2.0, 0.0], width, 0.0),
            side("left", [0.0, width / 2.0], length, -FRAC_PI_2),
            side("back", [length / 2.0, 0.0], width, PI),
            side("right", [0.0, -width / 2.0], length, FRAC_PI_2),
        ];
        Self { label: format!("box:{length}x{width}x{height}"), faces }
    }

    /// The same with some of its faces, in the order given.
    ///
    /// # Errors
    /// Where it has no such face, or one is named twice.
    pub fn with_faces(&self, names: &[String]) -> Result<Self, PartError> {
        let mut faces: Vec<Face> = Vec::new();
        for name in names {
            let face = self.faces.iter().find(|face| face.name == *name);
            let known = || self.face_names().join(", ");
            let face = face.ok_or_else(|| PartError::Unknown { name: name.clone(), known: known() })?;
            if faces.contains(face) {
                return Err(PartError::Twice(name.clone()));
            }
            faces.push(face.clone());
        }
        Ok(Self { label: self.label.clone(), faces })
    }

    /// The part grown or shrunk about the middle of its underside; a box is called by its new sizes.
    #[must_use]
    pub fn scaled(&self, scale: f64) -> Self {
        let scaled = |face: &Face| Face {
            zone: face.zone.scaled(scale),
            centre: face.centre.map(|part| part * scale),
            ..face.clone()
        };
        // To a micrometre, as nobody writes more.
        let side = |side: f64| (side * scale * 1e6).round() / 1e6;
        let label = match self.box_sides().as_deref() {
            Some([length, width, height]) => format!("box:{}x{}x{}", side(*length), side(*width), side(*height)),
            _ => self.label.clone(),
        };
        Self { label, faces: self.faces.iter().map(scaled).collect() }
    }

    /// Length, width and height of a box, m.
    fn box_sides(&self) -> Option<Vec<f64>> {
        let sizes = self.label.strip_prefix("box:")?;
        Some(sizes.split('x').filter_map(|side| side.trim().parse::<f64>().ok()).collect())
    }

    /// Its lengths in mm where it is a box, and which faces are machined.
    pub fn describe(&self) -> String {
        let count = self.faces.len();
        let sizes: Vec<String> =
            self.box_sides().into_iter().flatten().map(|side| format!("{:.0}", side * 1e3)).collect();
        let size = if sizes.is_empty() { String::new() } else { format!("{} mm, ", sizes.join(" x ")) };
        format!("{size}{count} face{}", if count == 1 { "" } else { "s" })
    }

    /// How its faces are called.
    pub fn face_names(&self) -> Vec<&str> {
        self.faces.iter().map(|face| face.name.as_str()).collect()
    }
}

impl FromStr for Part {
    type Err = PartError;

    /// `box:AxBxC`, or `part:` and faces joined by `+`, each `ZONE@x,y,z,DIRECTION[,AZIMUTH]`: m in part axes; the tool's direction `down`,
    /// `forward`, `up` or degrees above the horizontal; its angle about the vertical in degrees.
    fn from_str(text: &str) -> Result<Self, PartError> {
        if let Some(list) = text.strip_prefix("part:") {
            let faces = list.split('+').enumerate().map(|(i, face)| read_face(i, face)).collect::<Result<_, _>>()?;
            return Ok(Self { label: text.into(), faces });
        }
        let sizes = text.strip_prefix("box:").ok_or_else(|| PartError::Box(text.into()))?;
        let sizes: Vec<&str> = sizes.split('x').collect();
        let [length, width, height] = sizes.as_slice() else { return Err(PartError::Box(text.into())) };
        // Checked as a zone is.
        let sides = |a: &str, b: &str| format!("rect:{a}x{b}").parse::<Zone>().map(Zone::sides);
        let ([length, width], [_, height]) = (sides(length, width)?, sides(width, height)?);
        Ok(Self { label: text.into(), ..Self::of_box([length, width, height]) })
    }
}

fn read_face(index: usize, text: &str) -> Result<Face, PartError> {
    let form = || PartError::Face(text.into());
    let (zone, placed) = text.split_once('@').ok_or_else(form)?;
    let zone = zone.parse::<Zone>()?;
    let parts: Vec<&str> = placed.split(',').map(str::trim).collect();
    let (x, y, z, direction, azimuth) = match *parts.as_slice() {
        [x, y, z, direction] => (x, y, z, direction, "0"),
        [x, y, z, direction, azimuth] => (x, y, z, direction, azimuth),
        _ => return Err(form()),
    };
    let number =
        |text: &str, most: f64| text.parse::<f64>().ok().filter(|number| number.abs() <= most).ok_or_else(form);
    let elevation = match direction {
        "down" => -90.0,
        "forward" => 0.0,
        "up" => 90.0,
        degrees => number(degrees, 90.0)?,
    };
    Ok(Face {
        name: format!("face {}", index + 1),
        zone,
        centre: [number(x, 100.0)?, number(y, 100.0)?, number(z, 100.0)?],
        elevation: elevation.to_radians(),
        azimuth: number(azimuth, 360.0)?.to_radians(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: a box of 0.8 x 0.5 x 0.1 m.
    #[test]
    fn a_box_has_a_top_and_four_sides_that_the_tool_points_into() {
        let part: Part = "box:0.8x0.5x0.1".parse().unwrap();
        assert_eq!(part.face_names(), ["top", "front", "left", "back", "right"]);
        for face in &part.faces {
            let [x, y, z] = face.centre;
            let (s, c) = face.azimuth.sin_cos();
            let axis = [c * face.elevation.cos(), s * face.elevation.cos(), face.elevation.sin()];
            // From the middle of the box to a face, against the tool.
            let out = [x, y, z - 0.05];
            let half = out.iter().zip(axis).map(|(a, b)| -a * b).sum::<f64>();
            let length = out.iter().map(|part| part * part).sum::<f64>().sqrt();
            assert!((half - length).abs() < 1e-12, "{face:?}");
            let [first, second] = face.zone.sides();
            let volume = 2.0 * half * first * second;
            assert!((volume - 0.8 * 0.5 * 0.1).abs() < 1e-12, "{face:?}");
        }
        assert_eq!(part.scaled(0.5).describe(), "400 x 250 x 50 mm, 5 faces");
        let some = part.with_faces(&["back".into(), "top".into()]).unwrap();
        assert_eq!(some.face_names(), ["back", "top"]);
        assert!(matches!(part.with_faces(&["under".into()]), Err(PartError::Unknown { .. })));
        assert!(matches!(part.with_faces(&["top".into(), "top".into()]), Err(PartError::Twice(_))));
    }

    #[test]
    fn a_list_of_faces_is_read_and_faults_are_named() {
        let part: Part = "part:rect:0.8x0.5@0,0,0.1,down+circle:0.2@0.4,0,0.05,forward,180".parse().unwrap();
        let [top, back] = part.faces.as_slice() else { panic!("two faces") };
        assert_eq!((top.zone, top.elevation), (Zone::Rectangle { width: 0.8, height: 0.5 }, -FRAC_PI_2));
        assert_eq!((back.centre, back.azimuth), ([0.4, 0.0, 0.05], PI));
        for wrong in ["box:0.8x0.5", "box:800x500x100", "box:axbxc", "part:", "part:rect:1x1@0,0,down", "tube:1x1x1"] {
            assert!(wrong.parse::<Part>().is_err(), "{wrong}");
        }
        assert!("part:rect:1x1@0,0,0,sideways".parse::<Part>().unwrap_err().to_string().contains("sideways"));
    }
}
