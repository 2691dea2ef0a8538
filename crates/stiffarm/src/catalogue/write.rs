//! How is a robot written down as a robot file?

use std::fmt::Write;

use crate::body::{Body, Capsule, Enclosing};
use crate::calibration::{Calibration, Errors, JOINT_AXES, zeros};
use crate::drive::{Drives, Identified, JointCompliance, Motors, Transmission};
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::limits::{Limits, Pendant, ThirdAxis, Verified};
use crate::mass::{Carrier, Mass};
use crate::plane::PlanarArm;
use crate::robot::{Arm, Robot};

/// Angles beyond this, deg, cannot be said in a robot file.
const WIDEST_DEG: f64 = 1080.0;

/// The text of a robot file that [`read`](super::read) turns into an equal robot.
///
/// Equal to the last bit for every robot that was read from a file; lengths and angles that were computed may differ in
/// the last bit, because not every number of metres is a thousandth of a number. What a file leaves to its defaults is
/// left out, and what only whoever asked has said of the pendant. An open end of a joint's range is written as 1080 deg, the widest that a file can say.
pub fn write(robot: &Robot) -> String {
    let mut file = Text::default();
    file.text("name", &robot.name);
    if !robot.vendor.is_empty() {
        file.text("vendor", &robot.vendor);
    }
    file.text("architecture", robot.architecture.name());
    if robot.architecture_is_assumed {
        file.entry("architecture_assumed", "true");
    }
    file.text("status", robot.status.name());
    file.optional("payload_kg", robot.payload_kg.map(plain));
    file.optional("mass_kg", robot.mass_kg.map(plain));
    file.optional("reach_m", robot.reach.map(plain));
    file.optional("repeatability_mm", robot.repeatability.map(millimetres));
    match &robot.arm {
        Arm::SixAxis { geometry, limits, drives } => {
            file.geometry(geometry);
            file.limits(limits);
            file.drives(drives, robot);
            if let Some(calibration) = &robot.calibration {
                file.calibration(calibration, geometry, limits);
            }
        }
        Arm::Planar(arm) => file.planar(arm, robot.stiffness_is_assumed),
    }
    for mass in &robot.masses {
        file.mass(mass);
    }
    file.bodies(robot.body, robot.enclosing.as_ref());
    if !robot.source.is_empty() {
        file.table("source");
        for (key, text) in &robot.source {
            file.text(&key_of(key), text);
        }
    }
    file.0
}

#[derive(Default)]
struct Text(String);

impl Text {
    fn table(&mut self, name: &str) {
        writeln!(self.0, "\n[{name}]").expect("memory takes everything");
    }

    fn entry(&mut self, key: &str, value: &str) {
        writeln!(self.0, "{key} = {value}").expect("memory takes everything");
    }

    fn optional(&mut self, key: &str, value: Option<String>) {
        if let Some(value) = value {
            self.entry(key, &value);
        }
    }

    fn text(&mut self, key: &str, value: &str) {
        self.entry(key, &quoted(value));
    }

    fn list(&mut self, key: &str, values: impl IntoIterator<Item = String>) {
        self.entry(key, &list(values));
    }

    fn range(&mut self, key: &str, range: Interval) {
        if !range.is_all() {
            self.entry(key, &pair(range));
        }
    }

    fn geometry(&mut self, geometry: &Geometry) {
        let Geometry { a1, a2, b, c1, c2, c3, c4, offset, sign } = geometry;
        self.table("geometry");
        for (key, length) in
            [("a1_mm", a1), ("a2_mm", a2), ("b_mm", b), ("c1_mm", c1), ("c2_mm", c2), ("c3_mm", c3), ("c4_mm", c4)]
        {
            self.entry(key, &millimetres(*length));
        }
        self.list("offset_deg", offset.map(degrees));
        self.list("sign", sign.map(plain));
    }

    fn limits(&mut self, limits: &Limits) {
        self.table("limits");
        self.list("joint_deg", limits.joints.map(pair));
        if limits.third_axis == ThirdAxis::Forearm {
            self.text("third_axis", "forearm");
        }
        if limits.pendant == Pendant::AsFile {
            self.text("pendant", limits.pendant.name());
        }
        self.range("elbow_deg", limits.elbow);
        if let Some(speeds) = limits.speeds {
            self.list("speed_deg_per_s", speeds.map(degrees));
        }
        if let Pendant::Verified(Verified { rows, date, largest }) = &limits.pendant {
            self.table("verified");
            self.entry("rows", &rows.to_string());
            self.text("date", date);
            self.entry("largest_mm", &millimetres(*largest));
        }
    }

    fn drives(&mut self, drives: &Drives, robot: &Robot) {
        let is_assumed =
            robot.stiffness_is_assumed && drives.compliance == JointCompliance::PAPER && drives.identified.is_none();
        let own = drives.transmission != Transmission::of(robot.architecture);
        if !is_assumed || own {
            self.table("compliance");
        }
        if !is_assumed {
            self.list("drive_urad_per_nm", drives.compliance.0.map(|k| plain(microradians(k))));
        }
        if own {
            let rows = (0..6).map(|i| list(drives.transmission.0.row(i).iter().copied().map(plain)));
            self.list("transmission", rows);
        }
        if let Some(identified) = &drives.identified {
            self.identified(identified);
        }
        if let Some(compensator) = drives.compensator {
            self.table("compensator");
            self.list("base_mm", compensator.base.map(millimetres));
            self.list("arm_mm", compensator.arm.map(millimetres));
            self.entry("stiffness_n_per_mm", &inverse(compensator.stiffness, 1e-3, |x| x * 1e3));
            self.entry("free_length_mm", &millimetres(compensator.free_length));
        }
        self.motors(&drives.motors);
    }

    fn motors(&mut self, motors: &Motors) {
        if *motors == Motors::UNKNOWN {
            return;
        }
        let Motors { torque, wrist_moment, rotor, damping } = motors;
        self.table("drives");
        if let Some(allowed) = wrist_moment {
            self.list("wrist_moment_nm", allowed.map(plain));
        }
        for (key, numbers) in [("torque_nm", torque), ("rotor_kg_m2", rotor), ("damping_nms_per_rad", damping)] {
            if let Some(numbers) = numbers {
                self.list(key, numbers.map(plain));
            }
        }
    }

    fn bodies(&mut self, body: Option<Body>, enclosing: Option<&Enclosing>) {
        let not_compared = enclosing.map_or(&[][..], |enclosing| &enclosing.not_compared);
        if body.is_some() || !not_compared.is_empty() {
            self.table("body");
        }
        if let Some(body) = body {
            self.list("radius_mm", <[f64; 4]>::from(body).map(millimetres));
        }
        if !not_compared.is_empty() {
            self.list("not_compared", not_compared.iter().map(|pair| list(pair.map(|link| link.to_string()))));
        }
        for (link, capsules) in enclosing.iter().flat_map(|enclosing| enclosing.links.iter().enumerate()) {
            writeln!(self.0, "\n[[body.link]]\nlink = {link}").expect("memory takes everything");
            let numbers = |capsule: &Capsule| {
                let ends = capsule.ends.iter().flatten().copied();
                list(ends.chain([capsule.radius]).map(millimetres))
            };
            self.list("capsules_mm", capsules.iter().map(numbers));
        }
    }

    fn mass(&mut self, Mass { carrier, body }: &Mass) {
        writeln!(self.0, "\n[[mass]]").expect("memory takes everything");
        match carrier {
            Carrier::Base => self.entry("link", "0"),
            Carrier::Link(link) => self.entry("link", &link.to_string()),
            Carrier::Rod { crank } => {
                self.text("link", "rod");
                self.list("crank_mm", crank.map(millimetres));
            }
            Carrier::Counterweight => self.text("link", "counterweight"),
        }
        self.entry("mass_kg", &plain(body.mass));
        self.list("com_mm", <[f64; 3]>::from(body.centre).map(millimetres));
        self.list("inertia_kg_m2", body.elements().map(plain));
    }

    fn identified(&mut self, identified: &Identified) {
        self.text("status", "identified");
        self.list("identified", identified.drives.map(|seen| seen.to_string()));
        let square = |variance: f64| inverse(variance, 1e12, |urad| urad * 1e-12);
        let rows =
            (0..6).map(|i| "\n    ".to_owned() + &list(identified.covariance.row(i).iter().copied().map(square)));
        self.entry("covariance_urad2_per_n2m2", &format!("[{},\n]", rows.collect::<Vec<_>>().join(",")));
        self.entry("postures", &identified.postures.to_string());
        if let Some(date) = &identified.date {
            self.text("date", date);
        }
        self.entry("residual_mm", &millimetres(identified.residual));
        for (key, length) in [("left_out_mm", identified.left_out), ("moved_mm", identified.moved)] {
            if let Some(length) = length {
                self.entry(key, &millimetres(length));
            }
        }
    }

    fn calibration(&mut self, calibration: &Calibration, geometry: &Geometry, limits: &Limits) {
        let Calibration { errors, residual, left_out, controller, rows, date, source } = calibration;
        self.table("calibration");
        self.list("zero_deg", zeros(geometry, limits.third_axis, &errors.frames).map(degrees));
        let frames = errors.frames.iter().enumerate().map(|(i, frame)| {
            let parts = frame
                .iter()
                .enumerate()
                .map(|(j, x)| if j == 3 + JOINT_AXES[i] { "0".into() } else { millimetres(*x) });
            "\n    ".to_owned() + &list(parts)
        });
        self.entry("frames_mm_mrad", &format!("[{},\n]", frames.collect::<Vec<_>>().join(",")));
        if errors.weight != Errors::NONE.weight {
            self.list("weight_mrad", errors.weight.map(millimetres));
        }
        if let Some(drives) = errors.drives {
            self.list("weight_urad_per_nm", drives.map(|k| inverse(k, 1e6, |x| x / 1e6)));
        }
        if errors.gears != Errors::NONE.gears {
            self.list("gears_mrad", errors.gears.iter().flatten().map(|x| millimetres(*x)));
        }
        self.entry("residual_mm", &millimetres(*residual));
        self.entry("left_out_mm", &millimetres(*left_out));
        if let Some(controller) = controller {
            self.text("controller_model", controller.name());
        }
        self.entry("rows", &rows.to_string());
        self.text("date", date);
        self.text("source", source);
    }

    fn planar(&mut self, arm: &PlanarArm, is_assumed: bool) {
        self.table("planar");
        self.entry("l2_mm", &millimetres(arm.l2));
        self.entry("l3_mm", &millimetres(arm.l3));
        self.range("shoulder_deg", arm.shoulder);
        self.range("elbow_deg", arm.elbow);
        self.range("forearm_deg", arm.forearm);
        for (key, k) in [("k2_urad_per_nm", arm.k2), ("k3_urad_per_nm", arm.k3)] {
            if !is_assumed || k != JointCompliance::PAPER.0[1] {
                self.entry(key, &plain(microradians(k)));
            }
        }
    }
}

fn list(values: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", values.into_iter().collect::<Vec<_>>().join(", "))
}

fn pair(range: Interval) -> String {
    let end = |x: f64| if x.is_finite() { degrees(x) } else { plain(WIDEST_DEG.copysign(x)) };
    list([end(range.min()), end(range.max())])
}

/// A key as TOML has it: bare where it may be, else in quotes.
fn key_of(key: &str) -> String {
    let bare = !key.is_empty() && key.bytes().all(|c| c.is_ascii_alphanumeric() || matches!(c, b'_' | b'-'));
    if bare { key.into() } else { quoted(key) }
}

/// A TOML string in double quotes.
pub fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => write!(quoted, "\\u{:04X}", u32::from(c)).expect("memory takes everything"),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// The shortest decimals of `x`; a zero has no sign.
fn plain(x: f64) -> String {
    format!("{}", x + 0.0)
}

fn millimetres(metres: f64) -> String {
    inverse(metres, 1e3, |mm| mm / 1e3)
}

fn degrees(radians: f64) -> String {
    inverse(radians, 1_f64.to_degrees(), f64::to_radians)
}

/// urad/(N m), without the noise of the change of units.
pub fn microradians(k: f64) -> f64 {
    shortest(k, 1e6, |urad| urad / 1e6)
}

/// The shortest decimals that `read` turns into `x`, which is about the `factor`-th part of what is written.
fn inverse(x: f64, factor: f64, read: impl Fn(f64) -> f64) -> String {
    plain(shortest(x, factor, read))
}

/// The number that they are.
fn shortest(x: f64, factor: f64, read: impl Fn(f64) -> f64) -> f64 {
    const MOST_DIGITS: usize = 17;
    let about = x * factor;
    let neighbours = [about, about.next_up(), about.next_down()];
    let exact = neighbours.into_iter().find(|&y| read(y) == x).unwrap_or(about);
    let target = read(exact);
    let short = (0..MOST_DIGITS).map(|digits| format!("{exact:.digits$}"));
    let found = short.into_iter().find_map(|text| text.parse().ok().filter(|&y| read(y) == target));
    found.unwrap_or(exact)
}

#[cfg(test)]
mod tests {
    use super::super::read;
    use super::*;
    use crate::catalogue::paper_robots;
    use crate::plain::steers;

    #[test]
    fn every_robot_that_is_compiled_in_is_written_and_read_back_unchanged() {
        for robot in paper_robots() {
            let text = write(&robot);
            assert_eq!(read(&text, "written.toml").as_ref(), Ok(&robot), "{text}");
        }
    }

    #[test]
    fn texts_with_any_character_that_can_be_seen_survive_and_others_are_refused() {
        let mut robot = paper_robots().swap_remove(0);
        let any: Vec<char> = ('\0'..='\u{a0}').chain("\u{2028}\u{202e}\u{1f9be}".chars()).collect();
        let seen: String = any.iter().filter(|&&c| !steers(c)).collect();
        robot.name = format!("x{seen}x");
        robot.source.insert(seen.clone(), format!("{seen}\n\r\t"));
        robot.source.insert(String::new(), String::new());
        assert_eq!(read(&write(&robot), "written.toml").as_ref(), Ok(&robot));
        for unseen in any.into_iter().filter(|&c| steers(c)) {
            robot.name = format!("x{unseen}x");
            let faults = read(&write(&robot), "written.toml").unwrap_err().faults;
            assert!(faults.len() == 1 && faults[0].key == "name", "{unseen:?}: {faults:?}");
        }
    }

    #[test]
    fn numbers_are_written_as_people_write_them() {
        assert_eq!(millimetres(1.15), "1150");
        assert_eq!(millimetres(-0.041), "-41");
        assert_eq!(millimetres(-0.0), "0");
        assert_eq!(degrees(-90_f64.to_radians()), "-90");
        assert_eq!(degrees(0.1_f64.to_radians()), "0.1");
        assert_eq!(microradians(0.7e-6).to_string(), "0.7");
        assert_eq!(quoted("a \"b\" \\ \n"), "\"a \\\"b\\\" \\\\ \\u000A\"");
    }
}
