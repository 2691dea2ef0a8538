//! Bodies with a width, as triangles: what a line in space cannot show.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Unit, Vector3};
use serde_json::{Value, json};

use super::{Point, length};

/// Sides of a round body, and rings of each of its rounded ends.
const SIDES: usize = 18;
const RINGS: usize = 4;

/// Triangles.
#[derive(Default)]
pub(crate) struct Solid {
    points: Vec<Point>,
    /// Three points each, counter-clockwise from outside.
    faces: Vec<[usize; 3]>,
}

impl Solid {
    /// A cone with round ends about two balls; a ball where both are one.
    pub(crate) fn capsule(from: Point, to: Point, radii: [f64; 2]) -> Self {
        let (from, to) = (Vector3::from(from), Vector3::from(to));
        let axis = Unit::try_new(to - from, 1e-9).unwrap_or(Vector3::z_axis());
        let axis = axis.into_inner();
        let first = across(&axis);
        let second = axis.cross(&first);
        let mut solid = Self::default();
        for (end, centre) in [from, to].into_iter().enumerate() {
            for ring in 0..=RINGS {
                // From the first pole to its rim, then from the second rim to its pole.
                let up = FRAC_PI_2 * ring as f64 / RINGS as f64 - if end == 0 { FRAC_PI_2 } else { 0.0 };
                let middle = centre + radii[end] * up.sin() * axis;
                for side in 0..SIDES {
                    let (s, c) = (TAU * side as f64 / SIDES as f64).sin_cos();
                    let out = radii[end] * up.cos() * (c * first + s * second);
                    solid.points.push((middle + out).into());
                }
            }
        }
        for ring in 0..=2 * RINGS {
            for side in 0..SIDES {
                let at = |ring: usize, side: usize| ring * SIDES + side % SIDES;
                let [a, b, c, d] = [at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)];
                solid.faces.extend([[a, b, c], [a, c, d]]);
            }
        }
        solid
    }

    /// A box, or one that stands askew: corner `k` lies at the far end of axis `i` where bit `i` of `k` is set.
    pub(crate) fn block(corners: [Point; 8]) -> Self {
        // Seen from outside.
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3]];
        Self {
            points: corners.into(),
            faces: sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        }
    }

    /// Triangles as they are.
    pub(crate) fn mesh(points: Vec<Point>, triangles: &[[u32; 3]]) -> Self {
        let faces = triangles.iter().map(|triangle| triangle.map(|i| i as usize)).collect();
        Self { points, faces }
    }

    /// The body as plotly.js draws it.
    pub(crate) fn trace(&self, name: &str, colour: &str) -> Value {
        let part = |k: usize| self.points.iter().map(|at| length(at[k])).collect::<Value>();
        let corner = |k: usize| self.faces.iter().map(|face| face[k]).collect::<Value>();
        json!({
            "type": "mesh3d", "name": name, "color": colour, "flatshading": false, "hoverinfo": "skip",
            "x": part(0), "y": part(1), "z": part(2), "i": corner(0), "j": corner(1), "k": corner(2),
            "lighting": { "ambient": 0.55, "diffuse": 0.75, "specular": 0.12, "roughness": 0.6, "fresnel": 0.05 },
            "lightposition": { "x": -2000, "y": -6000, "z": 9000 },
        })
    }
}

/// Across a direction.
fn across(axis: &Vector3<f64>) -> Vector3<f64> {
    let mut least = Vector3::zeros();
    least[axis.iamin()] = 1.0;
    axis.cross(&least).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The volume that the faces enclose, positive where they look outwards.
    fn volume(solid: &Solid) -> f64 {
        let corner = |i: usize| Vector3::from(solid.points[i]);
        solid.faces.iter().map(|[a, b, c]| corner(*a).dot(&corner(*b).cross(&corner(*c))) / 6.0).sum()
    }

    #[test]
    fn bodies_enclose_what_they_should() {
        let radius: f64 = 0.2;
        let solid = Solid::capsule([1.0, 2.0, 3.0], [1.0, 2.6, 3.8], [radius; 2]);
        let exact = radius.powi(2) * std::f64::consts::PI * (1.0 + 4.0 / 3.0 * radius);
        // Flat faces cut off some per cent of what is round.
        assert!((0.93..1.0).contains(&(volume(&solid) / exact)), "{} {exact}", volume(&solid));
        let corner =
            |k: usize| std::array::from_fn(|i| if k >> i & 1 == 1 { [3.0, 2.5, 0.7][i] } else { [1.0, 2.0, -0.3][i] });
        assert!((volume(&Solid::block(std::array::from_fn(corner))) - 1.0).abs() < 1e-12, "2 x 0.5 x 1 m");
        let ball = Solid::capsule([0.0; 3], [0.0; 3], [radius; 2]);
        assert!(ball.points.iter().all(|at| (Vector3::from(*at).norm() - radius).abs() < 1e-12));
    }
}
