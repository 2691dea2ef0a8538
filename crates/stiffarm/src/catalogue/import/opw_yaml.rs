//! Reads the OPW parameters of ROS-Industrial (`opw_parameters_*.yaml`); m and rad.

use super::yaml::{self, Node, Value};
use crate::catalogue::reader::{Log, shown};
use crate::geometry::Geometry;

const LENGTHS: &str = "opw_kinematics_geometric_parameters";
const OFFSETS: &str = "opw_kinematics_joint_offsets";
const SIGNS: &str = "opw_kinematics_joint_sign_corrections";
/// Lengths beyond this, m, and angles beyond this, rad, are in another unit.
const LARGEST: f64 = 20.0;

/// Lengths, offsets and signs; `None` with every fault in the log.
pub(super) fn parse(text: &str, log: &Log) -> Option<Geometry> {
    let root = yaml::parse(text, log)?;
    let mut found = Vec::new();
    holders(&root, &mut found);
    let entries = match found[..] {
        [entries] => entries,
        [] => {
            log.add(0, "", format!("neither a URDF nor OPW parameters; expected <robot> or {LENGTHS}"));
            return None;
        }
        [..] => {
            log.add(0, LENGTHS, format!("stands here {} times; expected one arm", found.len()));
            return None;
        }
    };
    let reader = Reader { log };
    let lengths = reader.lengths(entries);
    let offset = reader.six(entries, OFFSETS, "angles in rad");
    let sign = reader.six(entries, SIGNS, "times 1 or -1");
    if sign.is_some_and(|sign| sign.iter().any(|x| x.abs() != 1.0)) {
        let place = entry(entries, SIGNS).map_or(0, |node| node.place);
        log.add(place, SIGNS, "expected six times 1 or -1");
        return None;
    }
    let [a1, a2, b, c1, c2, c3, c4] = lengths?;
    Some(Geometry { a1, a2, b, c1, c2, c3, c4, offset: offset?, sign: sign? })
}

/// The maps that hold OPW parameters; some files nest them under the name of an arm.
fn holders<'a>(node: &'a Node, found: &mut Vec<&'a [(String, Node)]>) {
    if let Value::Map(entries) = &node.value {
        if entry(entries, LENGTHS).is_some() {
            found.push(entries);
        }
        for (_, node) in entries {
            holders(node, found);
        }
    }
}

fn entry<'a>(entries: &'a [(String, Node)], key: &str) -> Option<&'a Node> {
    entries.iter().find(|(name, _)| name == key).map(|(_, node)| node)
}

struct Reader<'l> {
    log: &'l Log,
}

impl Reader<'_> {
    fn lengths(&self, entries: &[(String, Node)]) -> Option<[f64; 7]> {
        let node = entry(entries, LENGTHS)?;
        let Value::Map(lengths) = &node.value else {
            self.log.add(node.place, LENGTHS, "expected a1, a2, b, c1, c2, c3, c4 in m");
            return None;
        };
        let found = ["a1", "a2", "b", "c1", "c2", "c3", "c4"].map(|name| {
            let key = format!("{LENGTHS}.{name}");
            let Some(node) = entry(lengths, name) else {
                self.log.add(node.place, &key, "missing; expected a length in m");
                return None;
            };
            self.number(&key, node, "m")
        });
        found.into_iter().collect::<Option<Vec<f64>>>()?.try_into().ok()
    }

    fn six(&self, entries: &[(String, Node)], key: &str, what: &str) -> Option<[f64; 6]> {
        let Some(node) = entry(entries, key) else {
            self.log.add(0, key, format!("missing; expected six {what}"));
            return None;
        };
        match &node.value {
            Value::List(items) if items.len() == 6 => {
                let numbers: Vec<f64> = items.iter().filter_map(|item| self.number(key, item, what)).collect();
                numbers.try_into().ok()
            }
            Value::List(items) => {
                self.log.add(node.place, key, format!("{} values; expected six {what}", items.len()));
                None
            }
            _ => {
                self.log.add(node.place, key, format!("expected a list of six {what}"));
                None
            }
        }
    }

    fn number(&self, key: &str, node: &Node, unit: &str) -> Option<f64> {
        let Value::Scalar { text, tag } = &node.value else {
            self.log.add(node.place, key, format!("expected one number, {unit}"));
            return None;
        };
        let found = number(text, tag).filter(|x| x.abs() <= LARGEST);
        if found.is_none() {
            let message = format!("'{}'; expected a number from -{LARGEST} to {LARGEST}, {unit}", shown(text));
            self.log.add(node.place, key, message);
        }
        found
    }
}

/// A number, `deg(90)`, `rad(1.57)`, `!degrees 90`, `!radians pi/2`.
fn number(text: &str, tag: &str) -> Option<f64> {
    let text = text.trim();
    let within = |function: &str| text.strip_prefix(function)?.trim().strip_prefix('(')?.strip_suffix(')');
    match (within("deg"), within("rad"), tag) {
        (Some(inner), None, "" | "degrees" | "radians") => multiple_of_pi(inner).map(f64::to_radians),
        (None, Some(inner), "" | "degrees" | "radians") => multiple_of_pi(inner),
        (None, None, "degrees") => multiple_of_pi(text).map(f64::to_radians),
        (None, None, _) => multiple_of_pi(text),
        _ => None,
    }
}

/// A number, or `pi`, `-pi`, `2*pi`, `pi/2`, `-3*pi/4`.
fn multiple_of_pi(text: &str) -> Option<f64> {
    let text = text.trim();
    let Some((before, after)) = text.split_once("pi") else { return text.parse().ok() };
    let factor = match before.trim() {
        "" | "+" => 1.0,
        "-" => -1.0,
        before => before.strip_suffix('*')?.trim().parse::<f64>().ok()?,
    };
    let divisor = match after.trim() {
        "" => 1.0,
        after => after.strip_prefix('/')?.trim().parse::<f64>().ok()?,
    };
    Some(factor * std::f64::consts::PI / divisor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_read_in_every_way_in_which_such_files_write_them() {
        for (text, tag, degrees) in [
            ("deg(-90.0)", "", -90.0),
            ("deg( 180 )", "", 180.0),
            ("rad(pi/2)", "", 90.0),
            ("-1.5707963267948966", "", -90.0),
            ("-pi/2", "", -90.0),
            ("3*pi/2", "", 270.0),
            ("90", "degrees", 90.0),
            ("pi", "radians", 180.0),
        ] {
            let found = number(text, tag).unwrap_or(f64::NAN).to_degrees();
            assert!((found - degrees).abs() < 1e-12, "{tag} {text}: {found}");
        }
        for text in ["deg(", "deg()", "deg(90", "90 deg", "pi pi", "grad(100)", "", "nan?", "pi/x", "xpi"] {
            assert_eq!(number(text, ""), None, "{text}");
        }
    }
}
