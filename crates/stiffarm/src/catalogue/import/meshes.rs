//! What of a description's meshes belongs to which link of the arm, and which capsules enclose it?

use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};
use roxmltree::{Document, Node};

use super::cover::{Triangle, cover};
use super::described::Described;
use super::inertials::Boxes;
use super::urdf::{attribute, child};
use super::{ImportError, REPORTED_M};
use crate::body::{Capsule, Enclosing};
use crate::catalogue::reader::shown;
use crate::catalogue::stl::read_stl;
use crate::geometry::Geometry;
use crate::limits::Limits;
use crate::parallel;
use crate::plain::on_one_line;
use crate::spatial::Pose;

/// Of a link at most.
const MOST_CAPSULES: usize = 6;
/// Of all links together: more take minutes.
const MOST_TRIANGLES: usize = 2_000_000;
/// A mesh wider than so many reaches has another unit, and so have meshes that all together are narrower than this part of one.
const WIDEST: f64 = 3.0;
const NARROWEST: f64 = 0.01;
/// Faces of the prism about a cylinder.
const FACES: usize = 32;
/// Capsules are written in so many steps of a millimetre.
const STEPS: f64 = 100.0;
/// Postures in which description and robot file are compared.
const SAMPLES: usize = 300;

/// Gives the bytes of a mesh, by the name that the description has for it; else why there are none.
pub type Meshes<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// What encloses the links, and what must be said of it.
pub(super) struct Enclosed {
    pub(super) enclosing: Enclosing,
    pub(super) boxes: Boxes,
    pub(super) notes: Vec<String>,
}

impl Described<'_> {
    /// Capsules that enclose every triangle of the collision meshes of the arm, as the robot file moves them.
    pub(super) fn enclosed(
        &self,
        (geometry, limits): (&Geometry, &Limits),
        meshes: Meshes,
    ) -> Result<Enclosed, ImportError> {
        let at_zero = geometry.reported(&[0.0; 6], limits.third_axis);
        let (carried, left_out) = self.carried(&at_zero);
        let bodies = self.bodies(meshes)?;
        let mut triangles: [Vec<Triangle>; 7] = Default::default();
        let mut found = 0;
        for (link, own) in bodies {
            let Some((number, pose)) = carried.get(link.as_str()) else { continue };
            found += own.len();
            if MOST_TRIANGLES < found {
                return Err(self.fault(&link, format!("more than {MOST_TRIANGLES} triangles; expected coarser meshes")));
            }
            let stands = |corner: &Vector3<f64>| (pose * Point3::from(*corner)).coords;
            triangles[*number].extend(own.iter().map(|triangle| triangle.each_ref().map(stands)));
        }
        if let Some(bare) = triangles[..6].iter().position(Vec::is_empty).filter(|_| 0 < found) {
            let why = "has no collision body, so that the arm is not enclosed; expected one of the base and of each link but the last";
            return Err(self.fault(&format!("{bare} of the arm"), why));
        }
        self.check_widths(geometry, &triangles)?;
        let links = parallel::each(&triangles, |own| cover(own, MOST_CAPSULES));
        let grown = self.off(geometry, limits, &at_zero, &links);
        let links = std::array::from_fn(|i| links[i].iter().map(|one| rounded(one, grown[i])).collect());
        let mut enclosing = Enclosing { links, not_compared: Vec::new() };
        enclosing.not_compared = enclosing.always_touching(geometry, limits);
        let mut notes = notes_on(&triangles, &enclosing.links, &grown);
        notes.extend(left_out.iter().map(|link| {
            format!("bodies: link '{}' follows a joint and is in no capsule: keep clear of it yourself", shown(link))
        }));
        if !enclosing.not_compared.is_empty() {
            let pairs: Vec<String> = enclosing.not_compared.iter().map(|[a, b]| format!("{a} and {b}")).collect();
            notes.push(format!(
                "bodies: the capsules of links {} touch in every posture and are not compared",
                pairs.join(", ")
            ));
        }
        Ok(Enclosed { enclosing, boxes: triangles.each_ref().map(|own| corners(own)), notes })
    }

    /// The triangles of every link, m, in its own frame.
    fn bodies(&self, meshes: Meshes) -> Result<Vec<(String, Vec<Triangle>)>, ImportError> {
        // It was read before.
        let document = Document::parse(self.text).map_err(|error| self.fault("", error.to_string()))?;
        let mut found = Vec::new();
        for link in document.root_element().children().filter(|node| node.tag_name().name() == "link") {
            let name = attribute(&link, "name").to_owned();
            let mut triangles = Vec::new();
            for collision in link.children().filter(|node| node.tag_name().name() == "collision") {
                let own = body(&collision, meshes).map_err(|why| self.fault(&name, why))?;
                triangles.extend(own);
            }
            found.push((name, triangles));
        }
        Ok(found)
    }

    fn check_widths(&self, geometry: &Geometry, triangles: &[Vec<Triangle>; 7]) -> Result<(), ImportError> {
        let reach = geometry.a1 + geometry.c2 + geometry.l3();
        let mut widest = 0.0_f64;
        for (number, own) in triangles.iter().enumerate() {
            let wide = width(own);
            if WIDEST * reach < wide {
                let why = format!(
                    "is {wide:.1} m wide, the arm reaches {reach:.1} m; expected meshes in metres, or their scale"
                );
                return Err(self.fault(&format!("{number} of the arm"), why));
            }
            widest = widest.max(wide);
        }
        if widest < NARROWEST * reach {
            let why = format!(
                "its collision meshes are {:.1} mm wide at most, the arm reaches {reach:.1} m; expected meshes in metres",
                widest * 1e3
            );
            return Err(self.fault("of all", why));
        }
        Ok(())
    }

    /// How far a robot file moves any capsule's end from where the description does, of each link, m.
    fn off(&self, geometry: &Geometry, limits: &Limits, at_zero: &[f64; 6], links: &[Vec<Capsule>]) -> [f64; 7] {
        let base = self.base();
        let home = self.chain.frames_at(at_zero).map(|frame| (base * frame).inverse());
        let mut rng = fastrand::Rng::with_seed(1);
        let mut off = [0.0_f64; 7];
        for _ in 0..SAMPLES {
            let q = limits.joints.map(|range| range.min() + rng.f64() * range.width());
            let written = geometry.links(&geometry.model_angles(&q, limits.third_axis));
            for (i, frame) in self.chain.frames_at(&q).into_iter().enumerate() {
                let described = base * frame * home[i];
                for end in links[i + 1].iter().flat_map(|capsule| capsule.ends).map(Point3::from) {
                    off[i + 1] = off[i + 1].max((written[i] * end - described * end).norm());
                }
            }
        }
        off
    }
}

/// The triangles of a `collision`, m, in the frame of its link.
fn body(collision: &Node, meshes: Meshes) -> Result<Vec<Triangle>, String> {
    let pose = origin(collision)?;
    let Some(shape) = child(collision, "geometry").and_then(|node| node.children().find(Node::is_element)) else {
        return Err("a collision has no geometry; expected a mesh, a box, a cylinder or a sphere".into());
    };
    let triangles = match shape.tag_name().name() {
        "mesh" => mesh(&shape, meshes)?,
        "box" => prism(&numbers::<3>(&shape, "size", None)?.map(|side| side / 2.0)),
        "cylinder" => {
            let [radius, length] = [numbers::<1>(&shape, "radius", None)?[0], numbers::<1>(&shape, "length", None)?[0]];
            cylinder(radius, length / 2.0)
        }
        // The cube about it.
        "sphere" => prism(&[numbers::<1>(&shape, "radius", None)?[0]; 3]),
        other => return Err(format!("<{}> is no body; expected a mesh, a box, a cylinder or a sphere", shown(other))),
    };
    let stands = |corner: &Vector3<f64>| (pose * Point3::from(*corner)).coords;
    Ok(triangles.iter().map(|triangle| triangle.each_ref().map(stands)).collect())
}

fn origin(node: &Node) -> Result<Pose, String> {
    let Some(origin) = child(node, "origin") else { return Ok(Pose::identity()) };
    let [x, y, z] = numbers(&origin, "xyz", Some([0.0; 3]))?;
    let [roll, pitch, yaw] = numbers(&origin, "rpy", Some([0.0; 3]))?;
    Ok(Pose::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_euler_angles(roll, pitch, yaw)))
}

fn numbers<const N: usize>(node: &Node, name: &str, default: Option<[f64; N]>) -> Result<[f64; N], String> {
    let key = format!("{} {name}", node.tag_name().name());
    let Some(text) = node.attribute(name) else {
        return default.ok_or_else(|| format!("{key} is missing"));
    };
    let found: Vec<f64> =
        text.split_whitespace().filter_map(|word| word.parse().ok()).filter(|x: &f64| x.is_finite()).collect();
    let are_all = text.split_whitespace().count() == found.len();
    let wrong = |_| format!("{key} '{}'; expected {N} numbers", shown(text.trim()));
    if are_all { found.try_into().map_err(wrong) } else { Err(wrong(Vec::new())) }
}

fn mesh(shape: &Node, meshes: Meshes) -> Result<Vec<Triangle>, String> {
    let name = attribute(shape, "filename");
    let scale = numbers(shape, "scale", Some([1.0; 3]))?;
    // The unit of the file is checked by it.
    let metres = scale.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if scale.contains(&0.0) {
        return Err("mesh scale has a zero; expected how many metres its unit has".into());
    }
    let bytes = meshes(name).map_err(|why| format!("mesh '{}': {why}", shown(name)))?;
    let surface = read_stl(&bytes, &shown(name), metres);
    let surface = surface.map_err(|fault| on_one_line(&fault.to_string()).into_owned())?;
    let scaled = |corner: &[f64; 3]| Vector3::from_fn(|i, _| corner[i] * (scale[i] / metres));
    let corners: Vec<Vector3<f64>> = surface.corners.iter().map(scaled).collect();
    Ok(surface.triangles.iter().map(|triangle| triangle.map(|i| corners[i as usize])).collect())
}

/// The box with these half sides.
fn prism([x, y, z]: &[f64; 3]) -> Vec<Triangle> {
    let corner = |i: usize| Vector3::new([-x, *x][i & 1], [-y, *y][i >> 1 & 1], [-z, *z][i >> 2]);
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|face| face.map(corner)).collect()
}

/// A prism about the cylinder along z.
fn cylinder(radius: f64, half: f64) -> Vec<Triangle> {
    let outer = radius / (std::f64::consts::PI / FACES as f64).cos();
    let corner = |i: usize, z: f64| {
        let (s, c) = (std::f64::consts::TAU * i as f64 / FACES as f64).sin_cos();
        Vector3::new(outer * c, outer * s, z)
    };
    (0..FACES)
        .flat_map(|i| {
            let [a, b, c, d] = [corner(i, -half), corner(i + 1, -half), corner(i + 1, half), corner(i, half)];
            let [low, high] = [-half, half].map(|z| Vector3::new(0.0, 0.0, z));
            [[a, b, c], [a, c, d], [a, b, low], [d, c, high]]
        })
        .collect()
}

/// The least and the largest corner of the box about triangles, m.
fn corners(triangles: &[Triangle]) -> Option<[Vector3<f64>; 2]> {
    let each = || triangles.iter().flatten().copied();
    Some([each().reduce(|a, b| a.inf(&b))?, each().reduce(|a, b| a.sup(&b))?])
}

/// The largest extent along an axis, m.
fn width(triangles: &[Triangle]) -> f64 {
    corners(triangles).map_or(0.0, |[least, largest]| (largest - least).max())
}

/// Ends to hundredths of a millimetre, and a radius that has all of the capsule still inside, and what moves otherwise.
fn rounded(Capsule { ends, radius }: &Capsule, grown: f64) -> Capsule {
    // As the file has it, so that nothing is added in its last digits.
    let metres = |steps: f64| steps / STEPS / 1e3;
    let near = |x: f64| metres((x * 1e3 * STEPS).round());
    let ends_moved = metres(0.5) * 3_f64.sqrt();
    let radius = metres(((radius + ends_moved + grown) * 1e3 * STEPS).ceil());
    Capsule { ends: ends.map(|end| end.map(near)), radius }
}

fn notes_on(triangles: &[Vec<Triangle>; 7], links: &[Vec<Capsule>; 7], grown: &[f64; 7]) -> Vec<String> {
    let each = triangles.iter().zip(links).enumerate().map(|(link, (own, capsules))| {
        if own.is_empty() {
            format!("{link}: none")
        } else {
            format!("{link}: {} about {} triangles", capsules.len(), own.len())
        }
    });
    let mut notes = vec![format!(
        "bodies: capsules that enclose the collision meshes of the links {}",
        each.collect::<Vec<_>>().join(", ")
    )];
    let most = grown.iter().copied().fold(0.0, f64::max);
    if REPORTED_M < most {
        notes.push(format!(
            "bodies: radii are up to {:.2} mm larger, as the robot file moves links otherwise by so much",
            most * 1e3
        ));
    }
    notes
}
