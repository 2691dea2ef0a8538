//! How are angles, windows, tools and shapes written, in m, mm and degrees?

use std::f64::consts::PI;
use std::str::FromStr;

use nalgebra::{Rotation3, Translation3, Vector3};

use stiffarm::catalogue::measurements::Marker;
use stiffarm::cell::{Block, Mount, MountKind, Window};
use stiffarm::interval::Interval;
use stiffarm::measure::LoadWay;
use stiffarm::mill::RollMode;
use stiffarm::place::{Orientation, Within};
use stiffarm::spatial::Pose;
use stiffarm::task::{Task, Zone};

/// The angles of a rectangle as people ask for them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Angle {
    /// First side horizontal or vertical.
    Axes,
    /// The long side horizontal.
    Horizontal,
    /// The long side vertical.
    Vertical,
    /// Any.
    Free,
    /// Of the first side, deg.
    Degrees(f64),
}

impl Angle {
    /// Of the first side of a zone.
    pub(super) fn orientation(self, zone: Zone) -> Orientation {
        let [first, second] = zone.sides();
        let lying = if second <= first { 0.0 } else { 90.0_f64 };
        match self {
            Self::Axes => Orientation::Axes,
            Self::Free => Orientation::Free,
            Self::Horizontal => Orientation::Fixed(lying.to_radians()),
            Self::Vertical => Orientation::Fixed((90.0 - lying).to_radians()),
            Self::Degrees(angle) => Orientation::Fixed(angle.to_radians()),
        }
    }
}

impl FromStr for Angle {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "axes" => Ok(Self::Axes),
            "horizontal" => Ok(Self::Horizontal),
            "vertical" => Ok(Self::Vertical),
            "free" => Ok(Self::Free),
            _ => degrees(text)
                .map(Self::Degrees)
                .map_err(|_| "expected axes, horizontal, vertical, free, or an angle from -360 to 360 degrees".into()),
        }
    }
}

/// A number within its bounds; the unit is for the words of the refusal.
///
/// # Errors
/// What was expected.
pub fn number(text: &str, min: f64, max: f64, unit: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if min <= value && value <= max => Ok(value),
        _ => Err(format!("expected a number from {min} to {max} {unit}")),
    }
}

/// An angle, deg.
///
/// # Errors
/// What was expected.
pub fn degrees(text: &str) -> Result<f64, String> {
    number(text, -360.0, 360.0, "degrees")
}

/// A force as people give it, N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Force {
    /// Its size alone.
    Size(f64),
    /// Along three axes.
    Along([f64; 3]),
}

/// A size, or `x,y,z`, N.
///
/// # Errors
/// What was expected.
pub fn force(text: &str) -> Result<Force, String> {
    const LEAST: f64 = 1e-3;
    const MOST: f64 = 1e6;
    if !text.contains(',') {
        let several = |why| format!("{why}, or three along its axes, separated by commas");
        return number(text, LEAST, MOST, "N").map(Force::Size).map_err(several);
    }
    let expected =
        || format!("expected a number from {LEAST} to {MOST} N, or three along its axes that together are as much");
    let parts: Vec<f64> =
        text.split(',').map(|part| number(part, -MOST, MOST, "")).collect::<Result<_, _>>().map_err(|_| expected())?;
    let force: [f64; 3] = parts.try_into().map_err(|_| expected())?;
    let size = force.iter().map(|part| part * part).sum::<f64>().sqrt();
    if (LEAST..=MOST).contains(&size) { Ok(Force::Along(force)) } else { Err(expected()) }
}

/// A tool that is shorter than this, mm, was given in metres.
const SHORTEST_TOOL: f64 = 5.0;

/// Lengths of a tool, mm, that are not metres.
fn checked_tool(lengths: &[f64]) -> Result<(), String> {
    in_millimetres(lengths, "is no tool")
}

/// Lengths, mm, that are not metres; so few millimetres would be something else.
fn in_millimetres(lengths: &[f64], something_else: &str) -> Result<(), String> {
    let longest = lengths.iter().fold(0.0, |longest: f64, length| longest.max(length.abs()));
    if longest == 0.0 || SHORTEST_TOOL <= longest {
        return Ok(());
    }
    let meant = (longest * 1e9).round() / 1e6;
    Err(format!(
        "expected lengths in mm, and at least one of {SHORTEST_TOOL} mm ({longest} mm {something_else}; {longest} m would be {meant})"
    ))
}

/// `x,y,z` or `x,y,z,rx,ry,rz`, in mm and degrees about fixed x, y, z.
///
/// # Errors
/// What was expected.
pub fn tool(text: &str) -> Result<Pose, String> {
    let expected = || "expected x,y,z in mm, or x,y,z,rx,ry,rz with degrees; lengths up to 10000 mm".to_owned();
    let numbers = text.split(',').map(|part| number(part, -10_000.0, 10_000.0, "").map_err(|_| expected()));
    let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
    let ([x, y, z], [rx, ry, rz]) = match *numbers.as_slice() {
        [x, y, z] => ([x, y, z], [0.0; 3]),
        [x, y, z, rx, ry, rz] => ([x, y, z], [rx, ry, rz].map(f64::to_radians)),
        _ => return Err(expected()),
    };
    checked_tool(&[x, y, z])?;
    Ok(Pose::from_parts(Translation3::new(x / 1e3, y / 1e3, z / 1e3), Rotation3::from_euler_angles(rx, ry, rz).into()))
}

/// `NAME=HEADING`: what a column is called here, and what a table calls it.
///
/// # Errors
/// What was expected.
pub(super) fn heading(text: &str) -> Result<(String, String), String> {
    let expected = || "expected NAME=HEADING, such as joint_1_deg=J1".to_owned();
    let (ours, theirs) = text.split_once('=').ok_or_else(expected)?;
    let [ours, theirs] = [ours, theirs].map(|part| part.trim().to_owned());
    if ours.is_empty() || theirs.is_empty() { Err(expected()) } else { Ok((ours, theirs)) }
}

/// `x,y,z` in mm in the flange frame, as m.
///
/// # Errors
/// What was expected.
pub fn point(text: &str) -> Result<[f64; 3], String> {
    let expected = || "expected x,y,z in mm from the flange centre, each from -10000 to 10000".to_owned();
    let numbers = text.split(',').map(|part| number(part, -10_000.0, 10_000.0, "").map_err(|_| expected()));
    let mm: [f64; 3] = numbers.collect::<Result<Vec<_>, _>>()?.try_into().map_err(|_| expected())?;
    in_millimetres(&mm, "is at the flange centre: 0,0,0")?;
    Ok(mm.map(|mm| mm / 1e3))
}

/// `down`, `up`, `ahead`, `back`, `left`, `right`, or `x:y:z` along base axes.
///
/// # Errors
/// What was expected.
pub fn way(text: &str) -> Result<LoadWay, String> {
    let expected = || "expected down, up, ahead, back, left, right, or x:y:z along base axes".to_owned();
    let along = match text.trim() {
        "down" => [0.0, 0.0, -1.0],
        "up" => [0.0, 0.0, 1.0],
        "ahead" => [1.0, 0.0, 0.0],
        "back" => [-1.0, 0.0, 0.0],
        "left" => [0.0, 1.0, 0.0],
        "right" => [0.0, -1.0, 0.0],
        text => direction(text).map_err(|_| expected())?.into(),
    };
    Ok(LoadWay { name: text.trim().into(), along: along.into() })
}

/// `x:y:z` along flange axes, of any length but none: the unit vector.
///
/// # Errors
/// What was expected.
pub(super) fn direction(text: &str) -> Result<Vector3<f64>, String> {
    let expected = || "expected x:y:z along flange axes, not all 0".to_owned();
    let numbers = text.split(':').map(|part| number(part, -1e6, 1e6, "").map_err(|_| expected()));
    let along: [f64; 3] = numbers.collect::<Result<Vec<_>, _>>()?.try_into().map_err(|_| expected())?;
    Vector3::from(along).try_normalize(1e-9).ok_or_else(expected)
}

/// `name=x,y,z`, or a point alone.
///
/// # Errors
/// What was expected.
pub fn marker(text: &str) -> Result<Marker, String> {
    match text.split_once('=') {
        None => Ok(Marker { name: None, at: point(text)? }),
        Some((name, _)) if name.trim().is_empty() => Err("expected name=x,y,z, and the name is empty".into()),
        Some((name, at)) => Ok(Marker { name: Some(name.trim().into()), at: point(at)? }),
    }
}

/// `spindle:L@A+O`: a tool of length L, mm, whose axis stands at the angle A, deg, to the flange axis, and crosses it O mm before the
/// flange; without `@A` straight, without `+O` at the flange centre.
///
/// In the flange frame, z along axis 6 and out of the flange, it leans towards x:
///
/// ```text
/// tool point = (L sin A, 0, O + L cos A)      tool axis = (sin A, 0, cos A)      y stays that of the flange
/// ```
///
/// Joint 6 turns all of it about the flange axis, so that to lean another way is to count joint 6 from elsewhere.
///
/// # Errors
/// What was expected.
pub fn spindle(text: &str) -> Result<Pose, String> {
    let expected = || {
        "expected spindle:LENGTH, spindle:LENGTH@ANGLE or spindle:LENGTH@ANGLE+OFFSET with mm and degrees, e.g. spindle:250@90+30; \
         lengths up to 10000 mm, angles from 0 to 180"
            .to_owned()
    };
    let part = |text: &str, least: f64, most: f64| number(text, least, most, "").map_err(|_| expected());
    let rest = text.trim().strip_prefix("spindle:").ok_or_else(expected)?;
    let (length, rest) = rest.split_once('@').map_or((rest, None), |(length, rest)| (length, Some(rest)));
    let (angle, offset) = match rest.map(|rest| rest.split_once('+').map_or((rest, None), |(a, o)| (a, Some(o)))) {
        None => (0.0, 0.0),
        Some((angle, offset)) => {
            (part(angle, 0.0, 180.0)?, offset.map_or(Ok(0.0), |offset| part(offset, 0.0, 10_000.0))?)
        }
    };
    let length = part(length, 0.0, 10_000.0)?;
    checked_tool(&[length])?;
    let lean = angle.to_radians();
    // Exactly nothing sideways at 0 and 180 deg, nothing along the flange axis at 90.
    let (s, c) = (if angle == 180.0 { 0.0 } else { lean.sin() }, if angle == 90.0 { 0.0 } else { lean.cos() });
    let point = Translation3::new(length * s / 1e3, 0.0, (offset + length * c) / 1e3);
    Ok(Pose::from_parts(point, Rotation3::from_euler_angles(0.0, lean, 0.0).into()))
}

/// The tool axis in words, or degrees above the horizontal.
///
/// # Errors
/// What was expected.
pub fn elevation(text: &str) -> Result<f64, String> {
    match text {
        "down" => Ok(-90.0),
        "forward" => Ok(0.0),
        "up" => Ok(90.0),
        _ => number(text, -90.0, 90.0, "")
            .map_err(|_| "expected down, forward, up, or -90 to 90 degrees above the horizontal".into()),
    }
}

/// `any`, or the yaw of a zone in degrees; in radians.
///
/// # Errors
/// What was expected.
pub fn yaw(text: &str) -> Result<Interval, String> {
    if text == "any" {
        return Ok(Interval::spanning(-PI, PI));
    }
    let angle = degrees(text).map_err(|_| "expected any, or an angle from -360 to 360 degrees".to_owned())?;
    Ok(Interval::point(angle.to_radians()))
}

/// How the roll of a tool is chosen: `free`, `constant`, `linear`, or degrees.
///
/// # Errors
/// What was expected.
pub fn roll(text: &str) -> Result<RollMode, String> {
    match text {
        "free" => Ok(RollMode::Free),
        "constant" => Ok(RollMode::Constant),
        "linear" => Ok(RollMode::Linear),
        _ => {
            let angle = degrees(text)
                .map_err(|_| "expected free, constant, linear, or an angle from -360 to 360 degrees".to_owned())?;
            Ok(RollMode::Fixed(angle.to_radians()))
        }
    }
}

/// `MM@DEG`: so far along a path, and the roll there, to m and rad.
///
/// # Errors
/// What was expected.
pub fn pin(text: &str) -> Result<[f64; 2], String> {
    let expected = || {
        "expected MM@DEG with the way along the path in mm and an angle from -360 to 360 degrees, such as 120@45"
            .to_owned()
    };
    let (way, roll) = text.split_once('@').ok_or_else(expected)?;
    let way = number(way, 0.0, 1e7, "").map_err(|_| expected())?;
    let roll = degrees(roll).map_err(|_| expected())?;
    Ok([way / 1e3, roll.to_radians()])
}

/// The number of the tool before what is said of it, and that: `T1=endmill.toml`; no number where it is said of all.
pub(super) fn of_tool(text: &str) -> (Option<u32>, &str) {
    let numbered = text.trim().split_once('=').and_then(|(tool, what)| Some((tool.trim().strip_prefix('T')?, what)));
    let number = |digits: &str| digits.bytes().all(|digit| digit.is_ascii_digit()).then(|| digits.parse().ok())?;
    numbered.and_then(|(tool, what)| Some((Some(number(tool)?), what))).unwrap_or((None, text))
}

/// How far a tool of a path stands out, with its number; m.
///
/// # Errors
/// What was expected.
pub(super) fn tool_length(text: &str) -> Result<(u32, f64), String> {
    let expected = || "expected T and the number of a tool, =, and 0 to 2000 mm, such as T1=82.5".to_owned();
    let (Some(tool), length) = of_tool(text) else { return Err(expected()) };
    let length = number(length, 0.0, 2e3, "").map_err(|_| expected())?;
    checked_tool(&[length])?;
    Ok((tool, length / 1e3))
}

/// A shape at size 1: a letter of the paper, or a task.
///
/// # Errors
/// What was expected.
pub fn shape(text: &str) -> Result<Task<Zone>, String> {
    let notation = if text.contains(':') { text.into() } else { format!("{text}:1") };
    let work = notation.parse().map_err(|_| "expected A, B, C, or a shape such as rect:1x3".to_owned())?;
    Ok(Task { label: text.into(), work })
}

/// A flat zone with its size.
///
/// # Errors
/// What was expected.
pub(super) fn flat(text: &str) -> Result<Task<Zone>, String> {
    let task: Task = text.parse().map_err(|error: stiffarm::task::TaskError| error.to_string())?;
    task.flat().ok_or_else(|| "expected one flat zone, such as rect:0.6x0.4; a part with several faces is placed by place, rank and compare".into())
}

/// `a..b`; either end may be left open.
///
/// # Errors
/// What was expected.
pub fn open_range(text: &str) -> Result<Interval, String> {
    let expected = || format!("'{text}' is not a range; expected such as 0.5..2, 0.5.. or ..2, the lower end first");
    let (low, high) = text.split_once("..").ok_or_else(expected)?;
    let end = |text: &str, open: f64| {
        if text.trim().is_empty() {
            return Ok(open);
        }
        number(text, -1e5, 1e5, "").map_err(|_| expected())
    };
    Interval::new(end(low, f64::NEG_INFINITY)?, end(high, f64::INFINITY)?).ok_or_else(expected)
}

/// `x0..x1,z0..z1` in m; without the second range any height.
///
/// # Errors
/// What was expected.
pub fn within(text: &str) -> Result<Within, String> {
    // One range alone is that of x.
    let (x, z) = text.split_once(',').unwrap_or((text, ".."));
    let side = |text: &str| near(text, open_range(text)?, "m");
    Ok(Within { x: side(x)?, z: side(z)? })
}

/// No cell reaches farther, m: beyond it the unit is another one.
const FARTHEST: f64 = 100.0;

/// A range whose ends are in the unit in which it is asked.
fn near(text: &str, range: Interval, of: &str) -> Result<Interval, String> {
    let farthest = if of == "mm" { FARTHEST * 1e3 } else { FARTHEST };
    let is_near = [range.min(), range.max()].iter().all(|end| !end.is_finite() || end.abs() <= farthest);
    if is_near { Ok(range) } else { Err(format!("'{text}' lies beyond {farthest} {of}; the ranges are in {of}")) }
}

/// `x0..x1,y0..y1,z0..z1` in m, or in mm.
///
/// # Errors
/// What was expected.
pub fn block(text: &str, of: &str, is_bounded: bool) -> Result<Block, String> {
    let ends = if is_bounded { "both ends of all three ranges" } else { "each range may be left open at either end" };
    let expected = || format!("expected x0..x1,y0..y1,z0..z1 in {of}; {ends}");
    let ranges: Vec<&str> = text.split(',').collect();
    let &[x, y, z] = ranges.as_slice() else { return Err(expected()) };
    let side = |text: &str| {
        let range = open_range(text)?;
        if is_bounded && !range.is_bounded() {
            return Err(expected());
        }
        near(text, range, of)
    };
    Ok(Block { x: side(x)?, y: side(y)?, z: side(z)? })
}

/// A place for work: as [`within`], or with y as a block of the cell.
///
/// # Errors
/// What was expected.
pub fn window(text: &str) -> Result<Window, String> {
    if text.matches(',').count() == 2 {
        return block(text, "m", false).map(Window::Block);
    }
    let Within { x, z } = within(text)?;
    Ok(Window::Ring { ahead: x, z })
}

/// `floor`, `pedestal:H`, `wall:H`, `ceiling:H` or `pose:x,y,z,rx,ry,rz` in m and degrees; `@DEG` behind it turns it to the left about the
/// vertical.
///
/// # Errors
/// What was expected.
pub fn mount(text: &str) -> Result<Mount, String> {
    let expected = || {
        "expected floor, pedestal:H, wall:H or ceiling:H with a height in m (of a pedestal 0 or more), or pose:x,y,z,rx,ry,rz in m and degrees; \
         @DEG behind it turns it about the vertical"
            .to_owned()
    };
    let (what, turn) = text.split_once('@').map_or((text, Ok(0.0)), |(what, turn)| (what, degrees(turn)));
    let turn = turn.map_err(|_| expected())?.to_radians();
    let height = |text: &str, least: f64| number(text, least, 50.0, "m").map_err(|_| expected());
    let (name, value) = what.split_once(':').unwrap_or((what, ""));
    let mount = match name.trim() {
        "floor" if value.is_empty() => Mount::pedestal(0.0),
        "pedestal" => Mount::pedestal(height(value, 0.0)?),
        "wall" => Mount::wall(height(value, -20.0)?),
        "ceiling" => Mount::ceiling(height(value, -20.0)?),
        "pose" => {
            let numbers = value.split(',').map(|part| number(part, -360.0, 360.0, "").map_err(|_| expected()));
            let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
            let &[x, y, z, rx, ry, rz] = numbers.as_slice() else { return Err(expected()) };
            let [rx, ry, rz] = [rx, ry, rz].map(f64::to_radians);
            let turned = Rotation3::from_euler_angles(rx, ry, rz);
            Mount { kind: MountKind::Pose, cell_from_base: Pose::from_parts(Translation3::new(x, y, z), turned.into()) }
        }
        _ => return Err(expected()),
    };
    Ok(mount.turned(turn))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_may_be_open_at_any_end() {
        let place = within("0.5..2,..1.5").unwrap();
        assert_eq!((place.x.min(), place.x.max()), (0.5, 2.0));
        assert_eq!((place.z.min(), place.z.max()), (f64::NEG_INFINITY, 1.5));
        assert_eq!(within("..,..").unwrap(), Within::ANYWHERE);
        assert_eq!(within("1..").unwrap().z, Interval::ALL);
        for bad in ["", "1", "2..1,..", "a..b,..", "1..2,..,3", "nan..1,..", "1..inf,.."] {
            assert!(within(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_force_is_one_number_or_three() {
        assert_eq!(force("400"), Ok(Force::Size(400.0)));
        assert_eq!(force(" 300, 0,-50.5"), Ok(Force::Along([300.0, 0.0, -50.5])));
        for bad in ["", "-1", "0", "1,2", "1,2,3,4", "0,0,0", "1e6,1e6,0", "1,nan,0", "a", "1,2,inf", "1e-4,0,0"] {
            assert!(force(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_spindle_is_the_tool_frame_that_its_drawing_shows() {
        // By hand: 250 mm across the flange axis, 30 mm before the flange; its axis is the flange's x, its y the flange's.
        let across = spindle("spindle:250@90+30").unwrap();
        assert_eq!(across.translation.vector, nalgebra::Vector3::new(0.25, 0.0, 0.03));
        let turned = across.rotation.to_rotation_matrix();
        assert!((turned.matrix().column(2) - nalgebra::Vector3::x()).norm() < 1e-15);
        assert!((turned.matrix().column(1) - nalgebra::Vector3::y()).norm() < 1e-15);
        assert_eq!(across, tool("250,0,30,0,90,0").unwrap());
        assert_eq!(spindle("spindle:200").unwrap(), tool("0,0,200").unwrap());
        // Pythagoras: 3-4-5.
        let slanted = spindle("spindle:500@36.86989764584402").unwrap().translation.vector;
        assert!((slanted - nalgebra::Vector3::new(0.3, 0.0, 0.4)).norm() < 1e-15, "{slanted}");
        for bad in [
            "250@90",
            "spindle",
            "spindle:",
            "spindle:x",
            "spindle:250@",
            "spindle:250@200",
            "spindle:250@90-30",
            "spindle:-1",
        ] {
            assert!(spindle(bad).unwrap_err().starts_with("expected spindle:LENGTH"), "{bad}");
        }
    }

    #[test]
    fn windows_have_two_or_three_ranges_and_mounts_a_height() {
        let Ok(Window::Block(found)) = window("1..2,-0.5..,..0.8") else { panic!("a block") };
        assert_eq!((found.x.max(), found.y.min(), found.y.max(), found.z.max()), (2.0, -0.5, f64::INFINITY, 0.8));
        assert_eq!(
            window("1..,..0.8"),
            Ok(Window::Ring { ahead: open_range("1..").unwrap(), z: open_range("..0.8").unwrap() })
        );
        assert!(block("1..2,0..1", "m", false).is_err());
        let refusal = |text: &str, of: &str, is_bounded| block(text, of, is_bounded).unwrap_err();
        assert_eq!(refusal("500..900,0..1,0..1", "m", false), "'500..900' lies beyond 100 m; the ranges are in m");
        assert_eq!(within("1200..,0.4..1.8").unwrap_err(), "'1200..' lies beyond 100 m; the ranges are in m");
        assert!(block("500..900,..1,0..1", "mm", false).is_ok() && block("..,0..1,0..1", "m", false).is_ok());
        assert!(refusal("..9,0..1,0..1", "mm", true).ends_with("in mm; both ends of all three ranges"));
        assert!(window("1..2,3..4,5..6,7..8").is_err());
        assert_eq!(mount("floor"), Ok(Mount::pedestal(0.0)));
        assert_eq!(mount("wall:2.5@90"), Ok(Mount::wall(2.5).turned(90_f64.to_radians())));
        let posed = mount("pose:1,0.5,3,180,0,0").unwrap();
        assert!((posed.cell_from_base.inverse() * Mount::ceiling(3.0).cell_from_base).rotation.angle() < 1e-12);
        for bad in [
            "",
            "pedestal",
            "pedestal:x",
            "pedestal:-0.5",
            "wall:1@x",
            "pose:1,2,3",
            "floor:1",
            "shelf:1",
            "wall:nan",
            "ceiling:1e9",
        ] {
            assert!(mount(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_tool_in_metres_is_not_taken_for_millimetres() {
        for text in ["0,0,0.25", "0.1,0,0.25,0,90,0"] {
            let why = tool(text).unwrap_err();
            assert!(why.ends_with("(0.25 mm is no tool; 0.25 m would be 250)"), "{why}");
        }
        assert!(spindle("spindle:0.25@90").unwrap_err().contains("0.25 m would be 250"));
        let why = point("0.0069,0.2453,0.3193").unwrap_err();
        assert!(why.ends_with("(0.3193 mm is at the flange centre: 0,0,0; 0.3193 m would be 319.3)"), "{why}");
        assert!(marker("a=0.1,0,0.2").is_err() && marker("a=0,0,0").is_ok() && point("0,0.2,250").is_ok());
        assert!(tool("0,0,0").is_ok() && tool("0,0.2,250").is_ok() && tool("0,0,5").is_ok());
    }

    #[test]
    fn horizontal_means_the_long_side() {
        let upright = Zone::Rectangle { width: 0.5, height: 1.0 };
        assert_eq!(Angle::Horizontal.orientation(upright), Orientation::Fixed(90_f64.to_radians()));
        assert_eq!(Angle::Vertical.orientation(upright), Orientation::Fixed(0.0));
    }
}
