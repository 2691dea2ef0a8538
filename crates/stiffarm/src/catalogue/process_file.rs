//! Reads a process file (TOML): tool, material, engagement and spindle, or a force as it is given; checks every value.

use include_dir::{Dir, include_dir};
use toml::de::DeTable;

use super::measured_force::measured_law;
use super::reader::{Log, Quantity, Table, shown};
use super::{Fault, Faults};
use crate::cutting::{Edge, Engagement, Law, Milling, Process, Shank, Side};
use crate::plain::on_one_line;

static MATERIALS: Dir = include_dir!("$CARGO_MANIFEST_DIR/materials");

const SPEED: Quantity = Quantity { unit: "rpm", min: 1.0, max: 200_000.0, suspect: None };
const DIAMETER: Quantity = Quantity { unit: "mm", min: 0.05, max: 500.0, suspect: None };
const TEETH: Quantity = Quantity { unit: "(number)", min: 1.0, max: 1000.0, suspect: None };
const FLUTE: Quantity = Quantity { unit: "mm", min: 0.05, max: 500.0, suspect: None };
const HELIX: Quantity = Quantity { unit: "deg", min: 0.0, max: 75.0, suspect: None };
const DEPTH: Quantity = Quantity { unit: "mm", min: 1e-3, max: 500.0, suspect: None };
const FEED: Quantity = Quantity { unit: "mm", min: 1e-5, max: 20.0, suspect: None };
/// No mill cuts deeper, or is fed faster, in parts of its diameter.
const MOST_DEEP: f64 = 10.0;
const MOST_FED: f64 = 0.25;
const CHIP: Quantity = Quantity { unit: "N/mm2", min: -1e5, max: 1e5, suspect: None };
/// Of what is cut: plastics begin at some ten, steel is at two thousand. (What yields like foam is told by its force.)
const SPECIFIC: Quantity = Quantity { unit: "N/mm2", min: 0.0, max: 1e5, suspect: Some((5.0, 1e3, "kN/mm2")) };
const RUBBING: Quantity = Quantity { unit: "N/mm", min: -1e4, max: 1e4, suspect: None };
const RATIO: Quantity = Quantity { unit: "(ratio)", min: -10.0, max: 10.0, suspect: None };
/// Measured ones lie from 0.1 to 0.4; far above that the thinnest chips decide.
const EXPONENT: Quantity = Quantity { unit: "(exponent)", min: 0.0, max: 0.6, suspect: None };
const FORCE: Quantity = Quantity { unit: "N", min: -1e5, max: 1e5, suspect: None };
const TORQUE: Quantity = Quantity { unit: "N m", min: 0.0, max: 1e4, suspect: None };
/// Longer texts are no process files.
const MOST_BYTES: usize = 1 << 20;

/// The tables of which a process file has one, which says where the force comes from.
const LAWS: [&str; 7] = ["material", "kienzle", "constant", "drilling", "friction_stir", "measured", "worst"];

/// What is known of how a material is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// As `preset` names it.
    pub name: String,
    /// What it is, and with what it is cut.
    pub about: String,
    /// `published`, or `unverified`.
    pub status: String,
    /// Who says so.
    pub source: String,
    /// What an edge feels in it.
    pub edge: Edge,
}

/// What a process file says.
#[derive(Clone, Debug, PartialEq)]
pub struct ProcessFile {
    /// The process, SI.
    pub process: Process,
    /// The material, where it is one of those that come with the program.
    pub material: Option<Material>,
    /// What holds the teeth, where the file says it.
    pub shank: Option<Shank>,
    /// What was assumed.
    pub assumed: Vec<String>,
}

/// Every material that comes with the program, by name.
///
/// # Panics
/// Never: a test reads them all.
pub fn materials() -> Vec<Material> {
    let texts = MATERIALS.files().filter_map(|file| file.contents_utf8());
    let mut found: Vec<Material> =
        texts.map(|text| material(text).expect("a test reads every material that is compiled in")).collect();
    found.sort_by(|a, b| a.name.cmp(&b.name));
    found
}

fn material(text: &str) -> Option<Material> {
    let log = Log::of(text);
    let root = DeTable::parse(text).ok()?;
    let mut table = Table::root(root.get_ref(), log.clone());
    let (name, about) = (table.text("name", true)?, table.text("about", true)?);
    let (status, source) = (table.text("status", true)?, table.text("source", true)?);
    let edge = if table.has("mc") { kienzle(&mut table) } else { linear(&mut table) };
    table.finish(&[]);
    let edge = edge.filter(|_| !log.has_faults())?;
    Some(Material { name, about, status, source, edge })
}

/// Reads a process from the text of its file; `file` is named in errors.
///
/// # Errors
/// All faults of the file at once, each with its line and key.
pub fn read_process(text: &str, file: &str) -> Result<ProcessFile, Faults> {
    read_process_beside(text, file, &mut |other| Err(format!("there is no file {} beside it", shown(other))))
}

/// The same of a process that may name a file of measured forces: `beside` has the text of a file by its name, as it stands in the process file.
///
/// # Errors
/// As [`read_process`], and all faults of that file under its key.
pub fn read_process_beside(
    text: &str,
    file: &str,
    beside: &mut dyn FnMut(&str) -> Result<String, String>,
) -> Result<ProcessFile, Faults> {
    let log = Log::of(text);
    let mut found = None;
    if MOST_BYTES < text.len() {
        log.add(0, "", format!("{} bytes; a process file has at most {MOST_BYTES}", text.len()));
    } else {
        match DeTable::parse(text) {
            Ok(root) => found = process(Table::root(root.get_ref(), log.clone()), beside),
            Err(error) => log.add(error.span().map_or(0, |span| span.start), "", on_one_line(error.message())),
        }
    }
    let mut faults = log.into_faults();
    if let (Some(found), true) = (found, faults.is_empty()) {
        match found.process.force() {
            Ok(_) => return Ok(found),
            Err(error) => faults.push(Fault { line: 1, key: String::new(), message: error.to_string() }),
        }
    }
    Err(Faults { file: file.into(), faults })
}

fn process(mut root: Table, beside: &mut dyn FnMut(&str) -> Result<String, String>) -> Option<ProcessFile> {
    let spindle = root.optional_number("spindle_rpm", SPEED).map(|rpm| rpm * std::f64::consts::TAU / 60.0);
    let senses = [("clockwise", true), ("counter-clockwise", false)];
    let is_clockwise = root.choice("rotation", &senses, Some(true))?;
    let laws: Vec<&str> = LAWS.into_iter().filter(|law| root.has(law)).collect();
    let [law] = laws.as_slice() else {
        let why = match laws.as_slice() {
            [] => "missing; expected one of the tables [material] (with [tool] and [engagement]), [kienzle], [constant], [drilling], [friction_stir], [measured] or [worst]".into(),
            several => format!("{} exclude each other; expected one of them", several.join(" and ")),
        };
        root.fault(laws.first().copied().unwrap_or(""), why);
        root.finish(&LAWS);
        return None;
    };
    let mut assumed = Vec::new();
    let (mut known, mut shank) = (None, None);
    let law = match *law {
        "material" => {
            let mut table = root.table("material");
            let edge = if table.has("preset") {
                known = preset(&mut table);
                let unverified = known.iter().filter(|material| material.status == "unverified");
                assumed.extend(unverified.map(|Material { name, source, .. }| {
                    format!("the force coefficients of {name} are UNVERIFIED: {source}")
                }));
                known.as_ref().map(|material| material.edge)
            } else {
                linear(&mut table)
            };
            table.finish(&["preset"]);
            milling(&mut root, edge, (&mut shank, &mut assumed))
        }
        "kienzle" => {
            let mut table = root.table("kienzle");
            let edge = kienzle(&mut table);
            table.finish(&[]);
            milling(&mut root, edge, (&mut shank, &mut assumed))
        }
        "constant" => {
            let mut table = root.table("constant");
            let parts = ["feed_n", "across_n", "axial_n"].map(|key| table.number(key, FORCE));
            table.finish(&[]);
            match parts {
                [Some(feed), Some(across), Some(axial)] => Some(Law::Constant([feed, across, axial])),
                _ => None,
            }
        }
        "drilling" => {
            let mut table = root.table("drilling");
            let parts = (table.number("thrust_n", Quantity { min: 0.0, ..FORCE }), table.number("torque_nm", TORQUE));
            table.finish(&[]);
            parts.0.zip(parts.1).map(|(thrust, torque)| Law::Drilling { thrust, torque })
        }
        "friction_stir" => {
            let mut table = root.table("friction_stir");
            let [axial, traverse, side] = ["axial_n", "traverse_n", "side_n"].map(|key| table.number(key, FORCE));
            let torque = table.optional_number("torque_nm", TORQUE).unwrap_or(0.0);
            table.finish(&[]);
            axial.zip(traverse).zip(side).map(|((axial, traverse), side)| Law::FrictionStir {
                axial,
                traverse,
                side,
                torque,
            })
        }
        "measured" => {
            let mut table = root.table("measured");
            let found = measured_law(&mut table, &mut assumed, beside);
            table.finish(&[]);
            found
        }
        _ => {
            let mut table = root.table("worst");
            let force = table.number("force_n", Quantity { min: 1e-3, ..FORCE });
            table.finish(&[]);
            force.map(Law::Worst)
        }
    };
    root.finish(&LAWS);
    Some(ProcessFile { process: Process { spindle, is_clockwise, law: law? }, material: known, shank, assumed })
}

/// A material by its name.
fn preset(table: &mut Table) -> Option<Material> {
    let asked = table.text("preset", true)?;
    let plain =
        |name: &str| -> String { name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect() };
    let all = materials();
    if let Some(found) = all.iter().find(|material| plain(&material.name) == plain(&asked)) {
        return Some(found.clone());
    }
    let near = all.iter().map(|material| (crate::plain::alike(&plain(&material.name), &plain(&asked)), &material.name));
    let near = near.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(score, _)| 0.75 < *score);
    let hint = near.map_or_else(
        || format!("expected {}", all.iter().map(|material| material.name.clone()).collect::<Vec<_>>().join(", ")),
        |(_, name)| format!("did you mean {name}?"),
    );
    table.fault("preset", format!("no material of this name is known; {hint}"));
    None
}

fn linear(table: &mut Table) -> Option<Edge> {
    // A chip that is cut resists: along the edge and across it a fit may be of either sign.
    let tangential = table.number("ktc_n_per_mm2", SPECIFIC);
    let [radial, axial] = ["krc_n_per_mm2", "kac_n_per_mm2"].map(|key| table.number(key, CHIP));
    let chip = [tangential, radial, axial];
    let rubbing = ["kte_n_per_mm", "kre_n_per_mm", "kae_n_per_mm"].map(|key| table.number(key, RUBBING));
    match (chip, rubbing) {
        ([Some(tc), Some(rc), Some(ac)], [Some(te), Some(re), Some(ae)]) => {
            Some(Edge::Linear { chip: [tc, rc, ac].map(|k| k * 1e6), rubbing: [te, re, ae].map(|k| k * 1e3) })
        }
        _ => None,
    }
}

fn kienzle(table: &mut Table) -> Option<Edge> {
    let (specific, exponent) =
        (table.number("kc11_n_per_mm2", Quantity { min: 5.0, ..SPECIFIC }), table.number("mc", EXPONENT));
    let ratios = [table.number("radial_ratio", RATIO), table.number("axial_ratio", RATIO)];
    match (specific, exponent, ratios) {
        (Some(specific), Some(exponent), [Some(radial), Some(axial)]) => {
            Some(Edge::Power { specific: specific * 1e6, exponent, ratios: [radial, axial] })
        }
        _ => None,
    }
}

/// Tool and engagement, of which a mill needs both.
fn milling(
    root: &mut Table,
    edge: Option<Edge>,
    (shank, assumed): (&mut Option<Shank>, &mut Vec<String>),
) -> Option<Law> {
    for (name, keys) in
        [("tool", "diameter_mm, teeth, helix_deg"), ("engagement", "ap_mm, ae_mm, side, feed_per_tooth_mm")]
    {
        if !root.has(name) {
            root.fault(name, format!("missing; expected a table with {keys}"));
        }
    }
    let mut tool = root.table("tool");
    let (diameter, teeth) = (tool.number("diameter_mm", DIAMETER), tool.number("teeth", TEETH));
    if teeth.is_some_and(|teeth| teeth.fract() != 0.0) {
        tool.fault("teeth", "expected a whole number");
    }
    if !tool.has("helix_deg") && diameter.is_some() {
        assumed.push("straight teeth: the helix is not given".into());
    }
    let helix = tool.optional_number("helix_deg", HELIX).unwrap_or(0.0);
    let above = [tool.optional_number("flute_mm", FLUTE), tool.optional_number("shank_mm", DIAMETER)];
    *shank = match above {
        [Some(flute), Some(diameter)] => Some(Shank { flute: flute * 1e-3, diameter: diameter * 1e-3 }),
        _ => None,
    };
    for (key, other) in [("flute_mm", "shank_mm"), ("shank_mm", "flute_mm")] {
        if tool.has(key) && !tool.has(other) {
            tool.fault(key, format!("expected {other} beside it: the shank stands above the flutes"));
        }
    }
    tool.finish(&[]);
    let mut cut = root.table("engagement");
    let depth = cut.number("ap_mm", DEPTH);
    if let ([Some(flute), _], Some(depth)) = (above, depth)
        && flute < depth
    {
        cut.fault("ap_mm", format!("{depth} mm is deeper than the flutes reach, {flute} mm"));
    }
    let sides = [Side::Up, Side::Down, Side::Slot].map(|side| (side.name(), side));
    let side = cut.choice("side", &sides, None);
    let width = if side == Some(Side::Slot) && !cut.has("ae_mm") { diameter } else { cut.number("ae_mm", DEPTH) };
    let feed = cut.number("feed_per_tooth_mm", FEED);
    if let (Some(diameter), Some(width), Some(side)) = (diameter, width, side) {
        if diameter < width {
            cut.fault("ae_mm", format!("{width} mm is wider than the tool, {diameter} mm"));
        } else if side == Side::Slot && width < diameter {
            cut.fault(
                "ae_mm",
                format!("{width} mm is no slot of a tool of {diameter} mm; expected up or down for its side"),
            );
        }
    }
    if let Some(diameter) = diameter {
        for (key, given, most, what) in [
            ("ap_mm", depth, MOST_DEEP * diameter, "ten diameters deep"),
            ("feed_per_tooth_mm", feed, MOST_FED * diameter, "a quarter of the diameter a tooth"),
        ] {
            if let Some(mm) = given.filter(|mm| most < *mm) {
                cut.fault(key, format!("{mm} mm with a tool of {diameter} mm; expected at most {what}, {most} mm"));
            }
        }
    }
    cut.finish(&[]);
    let (diameter, depth, side, width, feed) = (diameter? * 1e-3, depth? * 1e-3, side?, width? * 1e-3, feed? * 1e-3);
    let engagement = Engagement::at_depth(depth, Engagement::angles(side, width, diameter), feed);
    Some(Law::Milling(Milling { diameter, teeth: teeth? as usize, helix: helix.to_radians(), engagement, edge: edge? }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "spindle_rpm = 12000\n[tool]\ndiameter_mm = 16\nteeth = 4\nhelix_deg = 0\n[material]\npreset = \"al7075-t6\"\n\
                        [engagement]\nap_mm = 2\nside = \"slot\"\nfeed_per_tooth_mm = 0.1\n";

    #[test]
    fn every_material_that_is_compiled_in_is_read() {
        let all = materials();
        assert!(5 < all.len());
        assert!(all.iter().all(|material| ["published", "unverified"].contains(&material.status.as_str())));
        for material in all {
            let text = GOOD.replace("al7075-t6", &material.name);
            assert_eq!(read_process(&text, "p").unwrap().material, Some(material));
        }
    }

    #[test]
    fn a_process_is_read_into_si() {
        let found = read_process(GOOD, "p").unwrap().process;
        assert!((found.spindle.unwrap() - 400.0 * std::f64::consts::PI).abs() < 1e-9);
        let Law::Milling(milling) = found.law else { panic!("a mill") };
        assert_eq!((milling.diameter, milling.teeth, milling.engagement.depth()), (0.016, 4, 0.002));
        assert_eq!(milling.engagement.exit(), std::f64::consts::PI);
        assert_eq!(read_process(GOOD, "p").unwrap().shank, None);
        let with_shank = GOOD.replace("teeth = 4", "teeth = 4\nflute_mm = 30\nshank_mm = 20");
        assert_eq!(read_process(&with_shank, "p").unwrap().shank, Some(Shank { flute: 0.03, diameter: 0.02 }));
        let force = |text: &str| read_process(text, "p").unwrap().process.force().unwrap();
        assert_eq!(force("[constant]\nfeed_n = 3\nacross_n = 4\naxial_n = 0").largest, 5.0);
        let drilled = force("spindle_rpm = 60\n[drilling]\nthrust_n = 500\ntorque_nm = 2");
        assert_eq!((drilled.mean, drilled.moment), (Some([0.0, 0.0, 500.0]), 2.0));
        assert!((drilled.power.unwrap() - 4.0 * std::f64::consts::PI).abs() < 1e-12);
        let stirred = force("[friction_stir]\naxial_n = 5000\ntraverse_n = 900\nside_n = -300");
        assert_eq!(stirred.mean, Some([-900.0, -300.0, 5000.0]));
        assert_eq!(force("[worst]\nforce_n = 1000").mean, None);
    }

    #[test]
    fn what_makes_no_sense_is_refused_by_line_and_key() {
        let without = |what: &str| GOOD.replace(what, "");
        for (text, says) in [
            (String::new(), "p:1: missing; expected one of the tables [material]"),
            (without("[engagement]\nap_mm = 2\nside = \"slot\"\nfeed_per_tooth_mm = 0.1\n"), "engagement: missing; expected a table with ap_mm"),
            (without("[tool]\ndiameter_mm = 16\nteeth = 4\nhelix_deg = 0\n"), "tool: missing"),
            (without("ap_mm = 2\n"), "engagement.ap_mm: missing"),
            (GOOD.replace("al7075-t6", "al7075-t66"), "p:7: material.preset: no material of this name is known; did you mean al7075-t6?"),
            (GOOD.replace("al7075-t6", "cheese"), "expected 42crmo4, al6061-t6"),
            (GOOD.replace("teeth = 4", "teeth = 4.5"), "p:4: tool.teeth: expected a whole number"),
            (GOOD.replace("teeth = 4", "teeth = nan"), "tool.teeth: NaN (number); expected 1"),
            (GOOD.replace("teeth = 4", "teeth = 4\nflute_mm = 30"), "tool.flute_mm: expected shank_mm beside it"),
            (GOOD.replace("teeth = 4", "teeth = 4\nshank_mm = 20"), "tool.shank_mm: expected flute_mm beside it"),
            (GOOD.replace("teeth = 4", "teeth = 4\nshank_mm = 20\nflute_mm = 1.5"), "engagement.ap_mm: 2 mm is deeper than the flutes reach, 1.5 mm"),
            (GOOD.replace("teeth = 4", "teeth = 4\nshank_mm = 20\nflute_mm = -3"), "tool.flute_mm: -3 mm; expected"),
            (GOOD.replace("ap_mm = 2", "ap_mm = -2"), "engagement.ap_mm: -2 mm; expected"),
            (GOOD.replace("ap_mm = 2", "ap_mm = 400"), "engagement.ap_mm: 400 mm with a tool of"),
            (GOOD.replace("feed_per_tooth_mm = 0.1", "feed_per_tooth_mm = 10"), "engagement.feed_per_tooth_mm: 10 mm with a tool of"),
            (GOOD.replace("ap_mm = 2", "ap_mm = 2\nae_mm = 20"), "engagement.ae_mm: 20 mm is wider than the tool"),
            (GOOD.replace("ap_mm = 2", "ap_mm = 2\nae_mm = 3"), "3 mm is no slot"),
            (GOOD.replace("\"slot\"", "\"left\""), "engagement.side: \"left\" is not known; expected \"up\""),
            (GOOD.replace("side", "sied"), "unknown key; did you mean side?"),
            (format!("{GOOD}[constant]\nfeed_n = 1\n"), "material and constant exclude each other"),
            ("[constant]\nfeed_n = 1e6\nacross_n = 0\naxial_n = 0".into(), "p:2: constant.feed_n: 1000000 N; expected"),
            ("[constant]\nfeed_n = nan\nacross_n = 0\naxial_n = 0".into(), "constant.feed_n: NaN N"),
            ("[worst]\nforce_n = 0".into(), "worst.force_n: 0 N"),
            ("[drilling]\nthrust_n = -5\ntorque_nm = 1".into(), "drilling.thrust_n: -5 N; expected 0"),
            (GOOD.replace("preset = \"al7075-t6\"", "ktc_n_per_mm2 = -800"), "material.ktc_n_per_mm2: -800 N/mm2; expected 0"),
            (GOOD.replace("ap_mm = 2", "ap_mm = 160").replace("preset = \"al7075-t6\"", "ktc_n_per_mm2 = 1e5\nkrc_n_per_mm2 = 0\nkac_n_per_mm2 = 0\nkte_n_per_mm = 1e4\nkre_n_per_mm = 0\nkae_n_per_mm = 0"), "N; expected at most 1e6 N"),
            ("rotation = \"up\"\n[worst]\nforce_n = 1".into(), "rotation: \"up\" is not known"),
            ("a = [".into(), "p:1: "),
        ] {
            let message = read_process(&text, "p").err().unwrap_or_else(|| panic!("{text} is read")).to_string();
            assert!(message.contains(says), "{message}\n{says}");
        }
    }
}
