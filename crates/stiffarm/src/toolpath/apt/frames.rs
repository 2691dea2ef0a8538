//! In which coordinates do the points of a file stand: `MSYS`, `CSYS`, `TRNTYP`?

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::super::fault::Wrong;
use super::Reader;
use super::statement::{Part, Statement};

/// Below this cosine a tool axis does not stand along z of its setup.
const ALONG: f64 = 0.999;

/// The setups of SOLIDWORKS CAM: `CSYS/` tells where one stands in the part, in three rows of four numbers, the axes in the first
/// three columns. Under `TRNTYP/WORLD` the points are those of the part in every setup, as the tool axes show, which stand along its z.
#[derive(Clone, Debug, Default)]
pub(super) struct Setup {
    numbers: Option<Vec<f64>>,
    /// Points are those of the part.
    is_world: bool,
    /// Along which the tool stands in a setup that begins behind points, and its line.
    axis: Option<(Vector3<f64>, usize)>,
}

impl Setup {
    /// The tool axis of the first point of a further setup.
    ///
    /// # Errors
    /// Where it does not stand along z of the setup: then the points may be in its own coordinates.
    pub(super) fn check(&mut self, axis: &Vector3<f64>, name: &str) -> Result<(), Wrong> {
        match self.axis.take() {
            Some((z, line)) if !(ALONG < z.dot(axis)) => {
                let why = format!(
                    "its tool axis does not stand along z of the CSYS of line {line}: whether points are those of the part is not known; write one file for each setup"
                );
                Err(Wrong::new(name, why))
            }
            _ => Ok(()),
        }
    }
}

impl Reader<'_> {
    /// `MSYS/`: origin, x and y axis of the coordinates; the first one is the part's.
    pub(super) fn take_frame(&mut self, statement: &Statement) -> Result<(), Wrong> {
        let n = statement.numbers(&[9])?;
        let (x, y) = (Vector3::new(n[3], n[4], n[5]), Vector3::new(n[6], n[7], n[8]));
        if 1e-3 < (x.norm() - 1.0).abs().max((y.norm() - 1.0).abs()).max(x.dot(&y).abs()) {
            return Err(Wrong::new(&statement.name, "its axes are no unit vectors at a right angle"));
        }
        let x = x.normalize();
        let y = (y - x.dot(&y) * x).normalize();
        let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
        let origin = Vector3::new(n[0], n[1], n[2]) * self.unit.metres();
        let frame = Isometry3::from_parts(Translation3::from(origin), UnitQuaternion::from_rotation_matrix(&rotation));
        let first = *self.first_frame.get_or_insert(frame);
        // A frame that stays the same changes nothing, not even by rounding.
        self.part_from_coordinates = if first == frame { Isometry3::identity() } else { first.inverse() * frame };
        Ok(())
    }

    /// `CSYS/`, twelve numbers.
    ///
    /// # Errors
    /// Where they are no frame, or points before and behind it may not be in the same coordinates.
    pub(super) fn take_setup(&mut self, statement: &Statement, line: usize) -> Result<(), Wrong> {
        let name = &statement.name;
        let numbers = statement.numbers(&[12])?;
        let column = |at: usize| Vector3::new(numbers[at], numbers[at + 4], numbers[at + 8]);
        let [x, y, z] = [0, 1, 2].map(column);
        if !((x.cross(&y) - z).norm() < 1e-3 && (x.norm() - 1.0).abs() < 1e-3 && x.dot(&y).abs() < 1e-3) {
            let why = "its numbers are no frame; expected three rows of four, the axes in the first three columns";
            return Err(Wrong::new(name, why));
        }
        let is_another = self.setup.numbers.as_ref().is_some_and(|known| *known != numbers);
        if is_another && self.has_points() {
            if !self.setup.is_world {
                let why = "the coordinates change behind points, and no TRNTYP/WORLD says that all are those of the part; write one file for each setup";
                return Err(Wrong::new(name, why));
            }
            self.setup.axis = Some((z, line));
            self.notes.assume(line, "points are those of the part in every CSYS, as TRNTYP/WORLD says");
        } else {
            self.notes.assume(line, "the part frame is that of the first CSYS");
        }
        self.setup.numbers = Some(numbers);
        Ok(())
    }

    /// `TRNTYP/WORLD,0,0,0`: of what the points are.
    ///
    /// # Errors
    /// Where they are shifted, or what they are changes behind points.
    pub(super) fn take_points(&mut self, statement: &Statement, line: usize) -> Result<(), Wrong> {
        let name = &statement.name;
        if statement.parts.iter().any(|part| matches!(part, Part::Number(number) if *number != 0.0)) {
            return Err(Wrong::new(name, "the path is shifted by it; expected WORLD,0,0,0"));
        }
        let is_world = statement.words().any(|word| word == "WORLD");
        if is_world != self.setup.is_world && self.has_points() {
            return Err(Wrong::new(
                name,
                "of what the points are changes behind points; write one file for each setup",
            ));
        }
        self.setup.is_world = is_world;
        self.notes.ignore(line, name);
        Ok(())
    }

    /// Some point was given.
    fn has_points(&self) -> bool {
        self.has_moved || self.tip.is_some()
    }
}
