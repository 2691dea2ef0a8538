//! What does a macro file (xacro) of one robot expand to?
//!
//! The simple form in which arms are published is read: one macro, or none; numbers, `pi`, `radians()`, `degrees()` and constants
//! (`xacro:property`) between `${` and `}`; a prefix of names. Whatever else xacro knows is refused by its name. Lines stay where they are.

use std::collections::HashMap;
use std::ops::Range;

use roxmltree::{Document, Node};

use super::MOST_BYTES;
use super::urdf::attribute;
use crate::catalogue::reader::shown;

/// Parameters by which names are distinguished where several robots stand in one cell: a single arm has none.
const PREFIXES: [&str; 2] = ["prefix", "tf_prefix"];
/// Brackets in brackets: no file has more.
const DEEPEST: usize = 50;
/// What is for the eye, or for simulators and controllers.
const ASIDE: [&str; 4] = ["visual", "gazebo", "transmission", "ros2_control"];

/// A text without macros.
pub(super) struct Expanded {
    pub(super) text: String,
    /// Of the macro, where there was one.
    pub(super) name: Option<String>,
}

/// Expands a text; `Ok(None)` where nothing is to be expanded, or where the text is no XML and the reader of URDF says why.
///
/// Nothing is used before it is defined, and nothing is defined twice: where xacro would wait, this refuses.
///
/// # Errors
/// What is not read, with its line.
pub(super) fn expand(text: &str) -> Result<Option<Expanded>, String> {
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(roxmltree::Error::UnknownNamespace(prefix, at)) if prefix == "xacro" => {
            return Err(format!("line {}: the namespace xacro is not declared", at.row));
        }
        Err(_) => return Ok(None),
    };
    let read = read(document.root_element());
    if !read.iter().any(|node| is_of_xacro(node) || node.attributes().any(|one| is_open(one.value()))) {
        return Ok(None);
    }
    let mut scope = Scope::default();
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    let mut name = None;
    let mut bytes = text.len();
    for node in read {
        let at = |place: usize| document.text_pos_at(place).row;
        let here = |why: String| format!("line {}: {why}", at(node.range().start));
        if !is_of_xacro(&node) {
            for one in node.attributes().filter(|one| is_open(one.value())) {
                let value = scope.text(one.value(), one.name() == "filename");
                let value = value.map_err(|why| format!("line {}: {why}", at(one.range().start)))?;
                bytes += value.len();
                if MOST_BYTES < bytes {
                    return Err(here(format!("it expands to more than {MOST_BYTES} bytes")));
                }
                let (range, ends) = blank(text, one.range_value());
                edits.push((range, escaped(&value) + &ends));
            }
            continue;
        }
        match node.tag_name().name() {
            // Of what is included only materials may be used: all else that it defines is refused where it is used.
            "include" => edits.push(blank(text, node.range())),
            "property" => {
                scope.add_constant(&node).map_err(here)?;
                edits.push(blank(text, node.range()));
            }
            "macro" if name.is_none() && node.parent() == Some(document.root_element()) => {
                name = Some(attribute(&node, "name").to_owned());
                scope.add_parameters(attribute(&node, "params")).map_err(here)?;
                edits.extend(tags(text, &node));
            }
            "macro" => return Err(here(format!("a second macro, {}", shown(attribute(&node, "name"))))),
            other => return Err(here(format!("xacro:{} is not read", shown(other)))),
        }
    }
    Ok(Some(Expanded { text: edited(text, edits), name }))
}

/// The elements that say something of an arm, in the order of the text.
fn read<'a, 'i>(root: Node<'a, 'i>) -> Vec<Node<'a, 'i>> {
    let mut found = Vec::new();
    let mut open = vec![root];
    while let Some(node) = open.pop() {
        if node.is_element() && !ASIDE.contains(&node.tag_name().name()) && !is_paint(&node) {
            open.extend(node.children().rev());
            found.push(node);
        }
    }
    found
}

fn is_of_xacro(node: &Node) -> bool {
    node.tag_name().namespace().is_some_and(|name| name.contains("xacro"))
}

/// A macro of some colour, in a body.
fn is_paint(node: &Node) -> bool {
    let is_in_body = node.parent().is_some_and(|above| above.tag_name().name() == "collision");
    is_of_xacro(node) && is_in_body && node.tag_name().name().starts_with("material")
}

fn is_open(value: &str) -> bool {
    value.contains("${") || value.contains("$(")
}

fn escaped(value: &str) -> String {
    value.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;").replace('\'', "&apos;")
}

/// The range, with nothing in it but its ends of lines.
fn blank(text: &str, range: Range<usize>) -> (Range<usize>, String) {
    let ends = text[range.clone()].chars().filter(|&character| character == '\n').collect();
    (range, ends)
}

/// The opening and the closing tag of an element, to be blanked.
fn tags(text: &str, node: &Node) -> Vec<(Range<usize>, String)> {
    let whole = node.range();
    match (node.first_child(), node.last_child()) {
        (Some(first), Some(last)) => {
            vec![blank(text, whole.start..first.range().start), blank(text, last.range().end..whole.end)]
        }
        _ => vec![blank(text, whole)],
    }
}

fn edited(text: &str, mut edits: Vec<(Range<usize>, String)>) -> String {
    edits.sort_by_key(|(range, _)| range.start);
    let mut found = String::with_capacity(text.len());
    let mut at = 0;
    for (range, with) in edits {
        // What stands in something that was blanked is gone with it.
        if at <= range.start {
            found.push_str(&text[at..range.start]);
            found.push_str(&with);
            at = range.end;
        }
    }
    found + &text[at..]
}

/// What names stand for.
#[derive(Default)]
struct Scope {
    constants: HashMap<String, String>,
    /// Parameters of the macro to which it gives no value.
    open: Vec<String>,
}

impl Scope {
    /// `name`, `name:=value` or `name:='value'`; blocks (`*name`) are refused where they are used.
    fn add_parameters(&mut self, parameters: &str) -> Result<(), String> {
        for parameter in parameters.split_whitespace() {
            let (name, value) = match parameter.split_once(":=") {
                Some((name, value)) => (name, Some(value)),
                None if PREFIXES.contains(&parameter) => (parameter, Some("")),
                None => (parameter, None),
            };
            self.check_new(name)?;
            match value.map(unquoted) {
                None => self.open.push(name.into()),
                Some(Some(value)) => drop(self.constants.insert(name.into(), value.into())),
                Some(None) => return Err(format!("the value of the parameter {} is not read", shown(name))),
            }
        }
        Ok(())
    }

    fn add_constant(&mut self, node: &Node) -> Result<(), String> {
        let name = attribute(node, "name");
        self.check_new(name)?;
        let Some(value) = node.attribute("value") else {
            return Err(format!("the constant {} has no value", shown(name)));
        };
        let value = self.text(value, false)?;
        if MOST_BYTES < value.len() {
            return Err(format!("the constant {} has more than {MOST_BYTES} bytes", shown(name)));
        }
        self.constants.insert(name.into(), value);
        Ok(())
    }

    /// What is defined twice means this or that, by where it is used.
    fn check_new(&self, name: &str) -> Result<(), String> {
        let is_known = self.constants.contains_key(name) || self.open.iter().any(|open| open == name);
        if is_known { Err(format!("{} is defined twice", shown(name))) } else { Ok(()) }
    }

    /// A value with all that stands between `${` and `}` worked out.
    fn text(&self, value: &str, is_file: bool) -> Result<String, String> {
        let mut found = String::new();
        let mut rest = value;
        while let Some(at) = rest.find('$') {
            found.push_str(&rest[..at]);
            let inner = rest[at..].strip_prefix("${").and_then(|inner| inner.split_once('}'));
            let Some((inner, after)) = inner else {
                return Err(format!("'{}' is not read", shown(value)));
            };
            found.push_str(&self.value(inner, is_file)?);
            if MOST_BYTES < found.len() {
                return Err(format!("it expands to more than {MOST_BYTES} bytes"));
            }
            rest = after;
        }
        Ok(found + rest)
    }

    fn value(&self, inner: &str, is_file: bool) -> Result<String, String> {
        let name = inner.trim();
        if let Some(value) = self.constants.get(name) {
            return Ok(value.clone());
        }
        if self.open.iter().any(|open| open == name) {
            // The name of a package: who reads the meshes says where it lies.
            if is_file {
                return Ok(name.into());
            }
            return Err(format!("${{{}}} is a parameter of the macro, which gives it no value", shown(name)));
        }
        let number = Expression { scope: self, rest: name }.whole();
        let number = number.ok_or_else(|| format!("${{{}}} is not read", shown(name)))?;
        if !number.is_finite() {
            return Err(format!("${{{}}} is no number", shown(name)));
        }
        // As Python has it: of whole numbers alone a whole number, as names have them.
        let is_whole = number.fract() == 0.0 && number.abs() < 1e15 && !name.contains(['.', '/']);
        Ok(if is_whole { format!("{number:.0}") } else { format!("{number:?}") })
    }
}

/// Without quotation marks; `None` of what is cut off, or to be worked out.
fn unquoted(value: &str) -> Option<&str> {
    let inner = value.strip_prefix(['\'', '"']).map_or(Some(value), |inner| inner.strip_suffix(['\'', '"']));
    inner.filter(|inner| !inner.contains(['$', '\'', '"']))
}

/// Numbers, names of constants, `+ - * /`, brackets, `radians()` and `degrees()`, as Python has them.
struct Expression<'s, 't> {
    scope: &'s Scope,
    rest: &'t str,
}

impl<'t> Expression<'_, 't> {
    fn whole(mut self) -> Option<f64> {
        let value = self.sum(0)?;
        self.rest.trim_start().is_empty().then_some(value)
    }

    fn takes(&mut self, sign: char) -> bool {
        match self.rest.trim_start().strip_prefix(sign) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn sum(&mut self, depth: usize) -> Option<f64> {
        let mut sum = self.product(depth)?;
        loop {
            if self.takes('+') {
                sum += self.product(depth)?;
            } else if self.takes('-') {
                sum -= self.product(depth)?;
            } else {
                return Some(sum);
            }
        }
    }

    fn product(&mut self, depth: usize) -> Option<f64> {
        let mut product = self.factor(depth)?;
        loop {
            if self.takes('*') {
                product *= self.factor(depth)?;
            } else if self.takes('/') {
                product /= self.factor(depth)?;
            } else {
                return Some(product);
            }
        }
    }

    fn factor(&mut self, depth: usize) -> Option<f64> {
        if depth == DEEPEST {
            return None;
        }
        if self.takes('-') {
            return self.factor(depth + 1).map(|value| -value);
        }
        if self.takes('(') {
            let value = self.sum(depth + 1)?;
            return self.takes(')').then_some(value);
        }
        let word = self.word();
        if let Some(constant) = self.scope.constants.get(word) {
            return number(constant);
        }
        match word {
            "pi" => Some(std::f64::consts::PI),
            "radians" | "degrees" => {
                self.takes('(').then_some(())?;
                let value = self.sum(depth + 1)?;
                self.takes(')').then_some(())?;
                Some(if word == "radians" { value.to_radians() } else { value.to_degrees() })
            }
            _ => number(word),
        }
    }

    /// A name or a number; the sign of an exponent belongs to it.
    fn word(&mut self) -> &'t str {
        let rest = self.rest.trim_start();
        let is_number = rest.starts_with(|first: char| first.is_ascii_digit() || first == '.');
        let mut before = ' ';
        let ends = |character: char| {
            let is_exponent = is_number && matches!(before, 'e' | 'E') && matches!(character, '+' | '-');
            before = character;
            !(character.is_ascii_alphanumeric() || matches!(character, '_' | '.') || is_exponent)
        };
        let (word, rest) = rest.split_at(rest.find(ends).unwrap_or(rest.len()));
        self.rest = rest;
        word
    }
}

/// A number as Python writes it.
fn number(word: &str) -> Option<f64> {
    let word = word.trim();
    let digits = word.strip_prefix('-').unwrap_or(word);
    let is_octal = digits.len() > 1 && digits.starts_with('0') && digits.bytes().all(|byte| byte.is_ascii_digit());
    let begins = digits.starts_with(|first: char| first.is_ascii_digit() || first == '.');
    (begins && !is_octal).then(|| word.parse().ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "<robot xmlns:xacro=\"http://wiki.ros.org/xacro\">";

    fn value(inner: &str) -> Result<String, String> {
        let mut scope = Scope::default();
        scope.constants.insert("DEG2RAD".into(), "0.5".into());
        scope.text(&format!("${{{inner}}}"), false)
    }

    #[test]
    fn numbers_are_those_of_python() {
        // By Python's own arithmetic.
        for (inner, expected) in [
            ("pi/2", "1.5707963267948966"),
            ("-pi", "-3.141592653589793"),
            ("radians(112)", "1.9547687622336491"),
            ("-radians( 90)", "-1.5707963267948966"),
            ("180 * DEG2RAD", "90.0"),
            ("-1.5e+2 * DEG2RAD", "-75.0"),
            ("2-3-4", "-5.0"),
            ("8/4/2", "1.0"),
            ("-(2 + 3) * 2", "-10.0"),
            ("degrees(pi)", "180.0"),
            ("1e-3", "0.001"),
        ] {
            let [found, expected] = [&value(inner).unwrap(), expected].map(|text| text.parse::<f64>().unwrap());
            assert_eq!(found, expected, "{inner}");
        }
        for inner in [
            "cos(1)",
            "2 ** 3",
            "pi pi",
            "(1",
            "1)",
            "radians 3",
            "x",
            "",
            "1/",
            "load_yaml(1)",
            "nan",
            "1/inf",
            "1 + 1/infinity",
            "0150",
        ] {
            assert!(value(inner).unwrap_err().contains(inner), "{inner}");
        }
        assert_eq!((value("1+1").unwrap().as_str(), value("4/2").unwrap().as_str()), ("2", "2.0"));
        assert!(value("1/0").unwrap_err().contains("no number"));
        assert!(value(&"(".repeat(10_000)).is_err() && value(&"-".repeat(10_000)).is_err());
    }

    #[test]
    fn a_macro_leaves_its_links_in_their_lines() {
        let text = format!(
            "{HEAD}\n<xacro:include filename=\"$(find a)/b\"/>\n<xacro:property name=\"L\" value=\"${{pi}}\"/>\n\
             <xacro:macro name=\"arm\" params=\"prefix package_name\n  z:='0.25' *block\">\n<link name=\"${{prefix}}base\">\
             <visual><xacro:colour/><x y=\"${{what}}\"/></visual>\n<collision><xacro:material_blue/></collision>\n<mesh filename=\"package://${{package_name}}/a.stl\"/></link>\n\
             <joint name=\"${{prefix}}j\" xyz=\"0 ${{L}} ${{z * 2}}\"/>\n</xacro:macro>\n</robot>"
        );
        let Expanded { text: found, name } = expand(&text).unwrap().unwrap();
        assert_eq!(name.as_deref(), Some("arm"));
        assert_eq!(found.lines().count(), text.lines().count());
        let line = |part: &str| {
            (
                found.lines().position(|line| line.contains(part)),
                text.lines().position(|line| line.contains("${prefix}j")),
            )
        };
        assert_eq!(line("<joint name=\"j\" xyz=\"0 3.141592653589793 0.5\"/>").0, line("").1, "{found}");
        assert!(found.contains("<link name=\"base\">") && found.contains("package://package_name/a.stl"), "{found}");
        // What is said behind an attribute of several lines keeps its line.
        let long = format!("{HEAD}\n<joint xyz=\"${{1}}\n2\n3\"/>\n<last/></robot>");
        let found = expand(&long).unwrap().unwrap().text;
        assert_eq!(found.lines().position(|line| line.contains("<last/>")), Some(4), "{found}");
        // What is not of the arm is not read.
        assert!(expand(&format!("{HEAD}<gazebo><a b=\"$(find c)\"/></gazebo><link name=\"${{1}}\"/></robot>")).is_ok());
        // Nothing to be done.
        assert!(expand("<robot name=\"a\"><link name=\"b\"/></robot>").unwrap().is_none());
        assert!(expand(&format!("{HEAD}<link name=\"b\"/></robot>")).unwrap().is_none());
    }

    #[test]
    fn what_grows_or_nests_without_end_is_refused_at_once() {
        let mut text = format!("{HEAD}<xacro:property name=\"a0\" value=\"0123456789\"/>");
        for i in 1..10 {
            let of = format!("${{a{}}}", i - 1).repeat(10);
            text.extend([&format!("<xacro:property name=\"a{i}\" value=\""), &of, "\"/>"]);
        }
        assert!(expand(&(text + "</robot>")).err().unwrap().contains("more than 4194304 bytes"));
        let deep = format!("{HEAD}<a b=\"${{1}}\"/>{}{}</robot>", "<g>".repeat(100_000), "</g>".repeat(100_000));
        assert!(expand(&deep).is_ok());
    }

    #[test]
    fn all_else_is_refused_by_name_and_line() {
        for (body, expected) in [
            ("<xacro:if value=\"1\"><link name=\"a\"/></xacro:if>", "line 2: xacro:if is not read"),
            ("<xacro:macro name=\"a\"/><xacro:macro name=\"b\"/>", "line 2: a second macro, b"),
            (
                "<xacro:macro name=\"a\" params=\"x\"><link name=\"${x}\"/></xacro:macro>",
                "${x} is a parameter of the macro",
            ),
            (
                "<xacro:macro name=\"a\" params=\"*x\"><xacro:insert_block name=\"x\"/></xacro:macro>",
                "xacro:insert_block",
            ),
            ("<link name=\"$(arg prefix)a\"/>", "'$(arg prefix)a' is not read"),
            ("<link name=\"${a\"/>", "'${a' is not read"),
            ("<joint xyz=\"${2 ** 3}\"/>", "line 2: ${2 ** 3} is not read"),
            ("<joint\n xyz=\"${x}\"/><xacro:property name=\"x\" value=\"1\"/>", "line 3: ${x} is not read"),
            (
                "<xacro:property name=\"x\" value=\"1\"/>\n<xacro:property name=\"x\" value=\"2\"/>",
                "line 3: x is defined twice",
            ),
            ("<xacro:property name=\"x\" value=\"1\"/><xacro:macro name=\"a\" params=\"x\"/>", "x is defined twice"),
            ("<xacro:property name=\"x\" default=\"1\"/>", "the constant x has no value"),
            ("<xacro:macro name=\"a\" params=\"x:='1 + 1'\"/>", "the value of the parameter x is not read"),
            ("<xacro:macro name=\"a\" params=\"x:=${1}\"/>", "the value of the parameter x is not read"),
        ] {
            let why = expand(&format!("{HEAD}\n{body}</robot>")).err().unwrap();
            assert!(why.contains(expected), "{why}; expected {expected}");
        }
    }
}
