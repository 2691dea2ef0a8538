//! Numbers and choices as people read them.

pub(super) use super::angles::asked_degrees;
pub use super::force::{acting, component, force, loaded, mapped};
pub use super::numbers::fixed;
use std::borrow::Cow;

use super::{Line, line};
use stiffarm::clearance::{Clearance, Link, LinksBy, Obstacle};
use stiffarm::interval::Interval;
use stiffarm::limits::{Pendant, ThirdAxis};
use stiffarm::load::Load;
use stiffarm::model::ModelKind;
use stiffarm::place::Within;
use stiffarm::robot::{Arm, Robot, Status};
use stiffarm::spatial::Pose;

/// A zone that is nearer to the joint-1 axis, m, stands where most robots have their own base.
pub const COLUMN: f64 = 0.3;

/// Degrees of an angle, rad, to a tenth.
pub fn degrees(angle: f64) -> String {
    format!("{} deg", fixed(angle.to_degrees(), 1))
}

/// Maker, name, architecture and status.
pub fn robot(robot: &Robot) -> String {
    format!("{} ({})", robot.full_name(), class(robot))
}

/// Architecture and status, for a line below a name.
pub fn class(robot: &Robot) -> String {
    format!("{}, {}", architecture(robot), status(robot))
}

/// That joint angles may not be those of the pendant; `None` where somebody says that they are, and of two links.
pub fn pendant(robot: &Robot) -> Option<String> {
    (robot.pendant()? == &Pendant::Unknown).then(|| {
        format!(
            "joints are given as the robot file of {} counts them; it is not known whether its pendant shows the same zeros, signs and joint 3: compare before you type them",
            robot.name
        )
    })
}

/// The same as a note below a table.
pub fn pendant_note(robot: &Robot) -> String {
    pendant(robot).map_or_else(String::new, |remark| remark + "\n")
}

/// Of which joints the angles are given, and what joint 3 counts from where that is not the upper arm.
pub fn joints_reported(robot: &Robot) -> &'static str {
    match &robot.arm {
        Arm::SixAxis { limits, .. } if limits.third_axis == ThirdAxis::Forearm => {
            "joints as reported (joint 3 against the horizontal)"
        }
        _ => "joints as reported",
    }
}

/// How well its lengths and limits are known. A robot file says `data-sheet` of all that is published of this very model; where that is a
/// robot description, this says so.
pub fn status(robot: &Robot) -> &'static str {
    match robot.status {
        Status::DataSheet if is_described(robot) => "description",
        status => status.name(),
    }
}

/// The source of its lengths is a URDF or what makes one, and no data sheet.
fn is_described(robot: &Robot) -> bool {
    robot.source.get("geometry").is_some_and(|source| {
        let source = source.to_lowercase();
        ["urdf", "xacro", "robot description"].iter().any(|word| source.contains(word))
            && !source.contains("data sheet")
    })
}

/// How zones stand in the arm plane.
pub const UPRIGHT: &str = "upright in the arm plane";

/// Its architecture, with a question mark where nothing says that it is.
pub fn architecture(robot: &Robot) -> String {
    format!("{}{}", robot.architecture, if robot.architecture_is_assumed { "?" } else { "" })
}

/// Why there is a question mark, where some of these robots have one.
pub fn assumed_architecture<'a>(robots: impl IntoIterator<Item = &'a Robot>) -> &'static str {
    if robots.into_iter().any(|robot| robot.architecture_is_assumed) { ASSUMED_ARCHITECTURE } else { "" }
}

/// Why there is a question mark.
pub const ASSUMED_ARCHITECTURE: &str = "serial?: no parallelogram is reported, and none is ruled out\n";

/// What the status of some of these robots means, where it is not the best.
pub fn statuses<'a>(robots: impl IntoIterator<Item = &'a Robot>) -> String {
    let found: Vec<&str> = robots.into_iter().map(status).collect();
    let has = |status| found.contains(&status);
    let mut notes = String::new();
    if has("description") {
        notes += "description: lengths and limits from a published robot description (URDF), not from the maker's data sheet\n";
    }
    if has(Status::Derived.name()) {
        notes += "derived: partly from published figures of the same or a sister model\n";
    }
    if has(Status::Estimated.name()) {
        notes += "estimated: lengths or limits partly assumed, see `stiffarm robots show NAME`\n";
    }
    notes
}

/// What positions count from, of a robot of which only two links are known their joint-2 axis.
pub fn origin(robot: &Robot) -> &'static str {
    match &robot.arm {
        Arm::SixAxis { .. } => "the base",
        Arm::Planar(_) => "the joint-2 axis",
    }
}

/// Its name, marked where its numbers are partly assumed.
pub fn marked(robot: &Robot) -> String {
    format!("{}{}", robot.name, if robot.status == Status::Estimated { " ~" } else { "" })
}

/// What each drive gives, in percent.
pub fn percentages(shares: &[f64]) -> String {
    shares.iter().map(|share| format!("{} %", fixed(share * 100.0, 1))).collect::<Vec<_>>().join(", ")
}

/// A force and the model under which it acts.
pub fn load(load: Load, model: &ModelKind) -> String {
    format!("{}, {} model", force(load), model.name())
}

/// The tool axis, by its angle above the horizontal, rad.
pub fn direction(elevation: f64) -> String {
    let degrees = elevation.to_degrees();
    if (degrees + 90.0).abs() < 1e-9 {
        "tool down".into()
    } else if degrees.abs() < 1e-9 {
        "tool forward".into()
    } else if (degrees - 90.0).abs() < 1e-9 {
        "tool up".into()
    } else {
        let side = if degrees < 0.0 { "below" } else { "above" };
        format!("tool {} deg {side} the horizontal", asked_degrees(elevation).abs())
    }
}

/// The tool frame in the flange frame.
pub fn tool(tool: &Pose) -> String {
    if *tool == Pose::identity() {
        return "the flange".into();
    }
    let v = tool.translation.vector * 1e3;
    let (rx, ry, rz) = tool.rotation.euler_angles();
    let point = format!("{:.1}, {:.1}, {:.1} mm from the flange", v.x + 0.0, v.y + 0.0, v.z + 0.0);
    if tool.rotation.angle() < 1e-12 {
        return point;
    }
    if let Some(spindle) = spindle(tool) {
        return format!("{spindle}: {point}");
    }
    let turned = [rx, ry, rz].map(|angle| format!("{:.2}", angle.to_degrees() + 0.0));
    format!("{point}, turned {} deg", turned.join(", "))
}

/// A tool that leans towards the flange's x, in the words of `spindle:250@90+30`.
fn spindle(tool: &Pose) -> Option<String> {
    let [x, y, z] = tool.translation.vector.map(|metres| metres * 1e3).into();
    let axis = tool.rotation.to_rotation_matrix().into_inner();
    let [s, c] = [axis[(0, 2)], axis[(2, 2)]];
    let keeps_y = (axis[(1, 1)] - 1.0).abs() < 1e-12 && y.abs() < 1e-9;
    if !keeps_y || s < 1e-6 || x <= 0.0 {
        return None;
    }
    // The tool point is (L s, 0, O + L c).
    let length = x / s;
    let offset = z - length * c;
    let before = match offset {
        offset if offset.abs() < 0.05 => String::new(),
        offset if offset < 0.0 => return None,
        offset => format!(", {offset:.1} mm before the flange"),
    };
    let angle = asked_degrees(s.atan2(c));
    Some(format!("spindle of {length:.1} mm at {angle} deg to the flange axis{before}"))
}

/// As `--tool-mm` takes it: x, y, z, mm, and the turns about fixed axes, deg.
pub(crate) fn tool_mm(tool: &Pose) -> [f64; 6] {
    let (rx, ry, rz) = tool.rotation.euler_angles();
    let [x, y, z] = tool.translation.vector.map(|metres| metres * 1e3).into();
    [x, y, z, rx.to_degrees(), ry.to_degrees(), rz.to_degrees()].map(|part| part + 0.0)
}

/// Which link is nearest to what, such as `forearm (estimated radius) to floor`.
pub fn clearance_of(clearance: &Clearance) -> String {
    let known = match clearance {
        Clearance { link: Link::Tool, is_estimated: true, .. } => " (estimated radius)",
        Clearance { link: Link::Tool | Link::Cutter | Link::Shank, .. } | Clearance { links: LinksBy::Stated, .. } => {
            ""
        }
        Clearance { links: LinksBy::Enclosing, .. } => " (enclosing capsules)",
        Clearance { links: LinksBy::Estimated, .. } => " (estimated radius)",
    };
    format!("{}{known} to {}", clearance.link.name(), clearance.to)
}

/// The same for people, with what is known of an arm whose links are estimated.
pub fn clearance_between(clearance: &Clearance) -> String {
    let mut of = clearance_of(clearance);
    // Two links are compared as slim ones alone.
    if matches!(clearance.to, Obstacle::Link(_)) && 0.0 < clearance.outside {
        of = format!("{of}, of which real links stand out by up to {} mm", fixed(clearance.outside * 1e3, 0));
    }
    let Some(wide) = clearance.wide else { return of };
    let (bodies, distance) = (bodies(wide.link, wide.to), wide.distance * 1e3);
    if distance < 0.0 {
        // What the tool touches it touches, however thick the arm is.
        if !is_of_arm(wide.link) {
            return of;
        }
        let by = fixed(-distance, 0);
        return format!("{of}; but {bodies} may touch: bodies that hold nine arms in ten overlap there by {by} mm");
    }
    format!("{of}; bodies that hold nine arms in ten keep {} mm ({bodies})", fixed(distance, 0))
}

/// It is no part of the tool.
pub fn is_of_arm(link: Link) -> bool {
    !matches!(link, Link::Tool | Link::Cutter | Link::Shank)
}

/// As what the links of a robot are compared.
pub fn links_are(robot: &Robot) -> &'static str {
    if robot.enclosing.is_some() {
        "links as capsules that enclose them, without cables, hoses and gravity compensators"
    } else {
        "links as capsules, coarse"
    }
}

/// The same without how well the radius is known.
pub fn bodies(link: Link, to: Obstacle) -> String {
    format!("{} to {to}", link.name())
}

/// A collision, or what may be one where wrist and tool are not in the model.
pub fn collision(clearance: &Clearance) -> Option<&'static str> {
    match (clearance.is_collision(), clearance.may_collide()) {
        (true, _) => Some("COLLISION"),
        (false, true) => Some("MAY COLLIDE"),
        (false, false) => None,
    }
}

/// How near the arm comes to anything; loud where it is too near.
pub fn clearance(clearance: &Clearance) -> Line {
    // Rounding below nothing is nothing.
    let distance = if clearance.overlaps() { clearance.distance } else { clearance.distance.max(0.0) } * 1e3;
    let poses = clearance.poses;
    let tool = if clearance.knows_tool { "" } else { "; wrist and tool are not known to this model" };
    if let Some(loud) = collision(clearance) {
        let (of, by) = (clearance_of(clearance), fixed(-distance, 0));
        let so = if clearance.is_collision() {
            "a place not to be chosen"
        } else {
            "wrist and tool are not known to this model, --model spatial tells"
        };
        return line(loud, format!("{of}: they overlap by {by} mm; {so}"));
    }
    let of = clearance_between(clearance);
    line("clearance", format!("{} mm at {poses} poses, {of}{tool}", fixed(distance, 0)))
}

/// Where a zone may stand, and what that counts from.
pub fn window(within: &Within, origin: &str) -> String {
    let range = |range: Interval| {
        // A tenth of a millimetre: the column of a robot is an estimate.
        let rounded = |x: f64| ((x * 1e4).round() / 1e4 + 0.0).to_string();
        let end = |x: f64| if x.is_finite() { rounded(x) } else { String::new() };
        format!("{}..{}", end(range.min()), end(range.max()))
    };
    if *within == Within::ANYWHERE {
        return "anywhere".into();
    }
    format!("x {} m, z {} m from {origin}", range(within.x), range(within.z))
}

/// To follow why there is no place: whether that is proved, of the zone itself where no other size is told.
pub(super) fn proved_none(is_proved: bool, largest_scale: Option<f64>) -> &'static str {
    match (is_proved, largest_scale) {
        (true, None) => "; it is proved that there is none",
        (false, None) => "; the search found none, which is no proof",
        (_, Some(_)) => "",
    }
}
/// What a limit is of: a joint from 1, or 0 for the angle between the links.
pub fn limited(joint: usize) -> Cow<'static, str> {
    if joint == 0 { "the angle between the links".into() } else { format!("joint {joint}").into() }
}
