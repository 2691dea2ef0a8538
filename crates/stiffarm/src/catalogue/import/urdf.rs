//! What does a URDF say? Its links and joints, or every fault with its line.

use nalgebra::{Translation3, Unit, UnitQuaternion, Vector3};
use roxmltree::{Document, Error, Node};

use crate::catalogue::reader::{Log, shown};
use crate::mass::RigidBody;
use crate::spatial::Pose;

/// Places further away than this, m, are in another unit.
const FURTHEST: f64 = 100.0;
/// Angles and limits larger than this, rad, are in another unit or mean nothing.
const WIDEST: f64 = 1000.0;
/// Bodies heavier than this, kg, are in another unit.
const HEAVIEST: f64 = 50_000.0;
/// And those harder to turn, kg m^2.
const HARDEST: f64 = 100_000.0;

/// The links and joints of a URDF, in the order of the file.
#[derive(Debug)]
pub(super) struct Urdf {
    /// Of the root element; empty where it has none.
    pub(super) name: String,
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<Joint>,
}

#[derive(Debug)]
pub(super) struct Link {
    pub(super) name: String,
    /// What it weighs, in its own frame.
    pub(super) inertial: Option<RigidBody>,
    /// Where it stands in the text.
    pub(super) place: usize,
}

#[derive(Clone, Debug)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) parent: String,
    pub(super) child: String,
    /// The joint's frame in the frame of its parent.
    pub(super) origin: Pose,
    pub(super) axis: Unit<Vector3<f64>>,
    pub(super) limit: Limit,
    /// The joint that this one follows.
    pub(super) mimic: Option<String>,
    pub(super) place: usize,
}

impl Joint {
    /// How errors name it.
    pub(super) fn key(&self) -> String {
        format!("joint {}", shown(&self.name))
    }

    /// Moves by a drive of its own about its axis.
    pub(super) fn is_driven(&self) -> bool {
        self.mimic.is_none() && matches!(self.kind, Kind::Revolute | Kind::Continuous)
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    Revolute,
    Continuous,
    Fixed,
    /// Any other that URDF knows: prismatic, planar, floating.
    Sliding(&'static str),
}

/// What the element `limit` says; rad, rad/s, N m.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Limit {
    pub(super) lower: Option<f64>,
    pub(super) upper: Option<f64>,
    pub(super) velocity: Option<f64>,
    pub(super) effort: Option<f64>,
    /// From where to where a safety controller lets it turn.
    pub(super) soft: [Option<f64>; 2],
}

impl Limit {
    /// The middle of the range, as far as it has ends.
    pub(super) fn middle(&self) -> f64 {
        f64::midpoint(self.lower.unwrap_or(0.0), self.upper.unwrap_or(0.0))
    }

    /// The safety controller leaves less than the limits do.
    pub(super) fn is_softer(&self) -> bool {
        let [lower, upper] = self.soft;
        let narrower = |soft: Option<f64>, hard: Option<f64>, is: fn(f64, f64) -> bool| {
            soft.zip(hard).is_some_and(|(soft, hard)| is(soft, hard))
        };
        narrower(lower, self.lower, |soft, hard| hard < soft) || narrower(upper, self.upper, |soft, hard| soft < hard)
    }
}

/// Reads a URDF without macros; faults go to the log, and then what is returned is not to be used.
pub(super) fn parse(text: &str, log: &Log) -> Option<Urdf> {
    let document = Document::parse(text).map_err(|error| {
        let hint = match error {
            Error::DtdDetected => "; expected a URDF, which has no document type and no entities of its own",
            _ => "",
        };
        log.add(place_of(text, error.pos().row), "", format!("{}{hint}", shown(&error.to_string())));
    });
    let document = document.ok()?;
    let root = document.root_element();
    if root.tag_name().name() != "robot" {
        let found = shown(root.tag_name().name());
        log.add(root.range().start, "", format!("the outermost element is <{found}>; expected <robot>"));
        return None;
    }
    let mut urdf = Urdf { name: attribute(&root, "name").into(), links: Vec::new(), joints: Vec::new() };
    for node in root.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "link" => urdf.links.extend(Reader::of("link", &node, log).and_then(|reader| reader.whole_link(&node))),
            "joint" => urdf.joints.extend(Reader::of("joint", &node, log).and_then(|reader| reader.joint(&node))),
            _ => {} // materials, transmissions, what simulators add
        }
    }
    Some(urdf)
}

/// The first character of a line, counted from 1.
fn place_of(text: &str, line: u32) -> usize {
    let before = (line as usize).saturating_sub(2);
    if line < 2 { 0 } else { text.match_indices('\n').nth(before).map_or(text.len(), |(i, _)| i + 1) }
}

pub(super) fn attribute<'a>(node: &Node<'a, '_>, name: &str) -> &'a str {
    node.attribute(name).unwrap_or_default().trim()
}

pub(super) fn child<'a, 'i>(node: &Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|child| child.is_element() && child.tag_name().name() == name)
}

/// Reads the parts of one link or joint.
struct Reader<'l> {
    what: &'static str,
    name: String,
    log: &'l Log,
}

impl<'l> Reader<'l> {
    fn of(what: &'static str, node: &Node, log: &'l Log) -> Option<Self> {
        let name = attribute(node, "name");
        if name.is_empty() {
            log.add(node.range().start, what, "has no name");
            return None;
        }
        Some(Self { what, name: name.into(), log })
    }

    fn fault(&self, node: &Node, part: &str, message: impl Into<String>) {
        let comma = if part.is_empty() { "" } else { ", " };
        self.log.add(node.range().start, &format!("{} {}{comma}{part}", self.what, shown(&self.name)), message);
    }

    fn whole_link(self, node: &Node) -> Option<Link> {
        let inertial = self.inertial(node)?;
        Some(Link { inertial, place: node.range().start, name: self.name })
    }

    /// The outer `None` is a fault.
    fn inertial(&self, node: &Node) -> Option<Option<RigidBody>> {
        let Some(inertial) = child(node, "inertial") else { return Some(None) };
        let origin = self.origin(&inertial);
        let number = |part: &str, name: &str, most: f64, unit: &str| {
            let found = child(&inertial, part).and_then(|node| Some((node, node.attribute(name)?)));
            let Some((node, text)) = found else {
                self.fault(&inertial, &format!("inertial {part} {name}"), format!("missing; expected {unit}"));
                return None;
            };
            self.number(&node, &format!("inertial {part} {name}"), text, most, unit)
        };
        let mass = number("mass", "value", HEAVIEST, "kg");
        if let Some(mass) = mass.filter(|mass| *mass < 0.0) {
            self.fault(&inertial, "inertial mass value", format!("{mass} kg; expected 0 or more"));
        }
        let elements = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].map(|name| number("inertia", name, HARDEST, "kg m2"));
        let elements: Vec<f64> = elements.into_iter().flatten().collect();
        let elements: [f64; 6] = elements.try_into().ok()?;
        Some(Some(RigidBody::new(mass?, Vector3::zeros(), elements).seen_from(&origin?)))
    }

    fn joint(self, node: &Node) -> Option<Joint> {
        let kind = self.kind(node);
        let (parent, below) = (self.link(node, "parent"), self.link(node, "child"));
        let origin = self.origin(node);
        // The axis of a joint that does not move may be anything.
        let axis = if kind == Some(Kind::Fixed) { Some(Vector3::x_axis()) } else { self.axis(node) };
        let limit = self.limit(node);
        let mimic = child(node, "mimic").map(|mimic| attribute(&mimic, "joint").to_owned());
        let place = node.range().start;
        Some(Joint {
            kind: kind?,
            parent: parent?,
            child: below?,
            origin: origin?,
            axis: axis?,
            limit: limit?,
            mimic,
            place,
            name: self.name,
        })
    }

    fn kind(&self, node: &Node) -> Option<Kind> {
        Some(match attribute(node, "type") {
            "revolute" => Kind::Revolute,
            "continuous" => Kind::Continuous,
            "fixed" => Kind::Fixed,
            "prismatic" => Kind::Sliding("prismatic"),
            "planar" => Kind::Sliding("planar"),
            "floating" => Kind::Sliding("floating"),
            other => {
                let expected = "expected revolute, continuous, fixed, prismatic, planar or floating";
                self.fault(node, "type", format!("'{}' is not known; {expected}", shown(other)));
                return None;
            }
        })
    }

    fn link(&self, node: &Node, which: &'static str) -> Option<String> {
        let name = child(node, which).map_or("", |link| attribute(&link, "link"));
        if name.is_empty() {
            self.fault(node, which, "missing; expected the name of a link");
            return None;
        }
        Some(name.into())
    }

    /// `origin xyz rpy`: roll, pitch, yaw about fixed x, y, z; both are zero where absent.
    fn origin(&self, node: &Node) -> Option<Pose> {
        let Some(origin) = child(node, "origin") else { return Some(Pose::identity()) };
        let xyz = self.vector(&origin, "xyz", [0.0; 3], FURTHEST, "m");
        let rpy = self.vector(&origin, "rpy", [0.0; 3], WIDEST, "rad");
        let ([x, y, z], [roll, pitch, yaw]) = (xyz?, rpy?);
        Some(Pose::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_euler_angles(roll, pitch, yaw)))
    }

    /// `1 0 0` where absent, as URDF has it.
    fn axis(&self, node: &Node) -> Option<Unit<Vector3<f64>>> {
        let Some(axis) = child(node, "axis") else { return Some(Vector3::x_axis()) };
        let xyz = self.vector(&axis, "xyz", [1.0, 0.0, 0.0], WIDEST, "(a direction)")?;
        let unit = Unit::try_new(Vector3::from(xyz), 1e-6);
        if unit.is_none() {
            let [x, y, z] = xyz;
            self.fault(&axis, "axis xyz", format!("{x} {y} {z} has no direction; expected one of length 1"));
        }
        unit
    }

    fn limit(&self, node: &Node) -> Option<Limit> {
        let number = |element: &'static str, name: &str, unit: &str| {
            let Some(found) = child(node, element) else { return Some(None) };
            let Some(text) = found.attribute(name) else { return Some(None) };
            self.number(&found, &format!("{element} {name}"), text, f64::MAX, unit).map(Some)
        };
        let [lower, upper, velocity, effort] =
            [("lower", "rad"), ("upper", "rad"), ("velocity", "rad"), ("effort", "N m")]
                .map(|(name, unit)| number("limit", name, unit));
        let [from, to] = ["soft_lower_limit", "soft_upper_limit"].map(|name| number("safety_controller", name, "rad"));
        Some(Limit { lower: lower?, upper: upper?, velocity: velocity?, effort: effort?, soft: [from?, to?] })
    }

    fn vector(&self, node: &Node, name: &str, default: [f64; 3], most: f64, unit: &str) -> Option<[f64; 3]> {
        let Some(text) = node.attribute(name) else { return Some(default) };
        let part = format!("{} {name}", node.tag_name().name());
        let words: Vec<&str> = text.split_whitespace().collect();
        if words.len() != 3 {
            let found = shown(text.trim());
            self.fault(node, &part, format!("'{found}' has {} numbers; expected three, in {unit}", words.len()));
            return None;
        }
        let numbers: Vec<f64> = words.iter().filter_map(|word| self.number(node, &part, word, most, unit)).collect();
        numbers.try_into().ok()
    }

    fn number(&self, node: &Node, part: &str, text: &str, most: f64, unit: &str) -> Option<f64> {
        let found = text.trim().parse::<f64>().ok().filter(|x| x.abs() <= most);
        if found.is_none() {
            let up_to = if most == f64::MAX { "a number".into() } else { format!("a number from -{most} to {most}") };
            self.fault(node, part, format!("'{}'; expected {up_to}, in {unit}", shown(text.trim())));
        }
        found
    }
}
