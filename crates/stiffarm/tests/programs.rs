//! Do the programs of controllers, read back by formulas of their own, lead the tool where the commanded joints put it?

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::LazyLock;

use nalgebra::{Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};
use stiffarm::catalogue::find;
use stiffarm::geometry::Geometry;
use stiffarm::limits::{Pendant, ThirdAxis};
use stiffarm::program::{Controller, Language, ProgramFault, ProgramFile, Setup, Station, Style, Tool, write};
use stiffarm::robot::Arm;
use stiffarm::spatial::Pose;

/// What a pose may be off: 1 um, 1 urad.
const NEAR: f64 = 1e-6;

fn kuka() -> Geometry {
    let offset = [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0];
    let sign = [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0];
    Geometry { a1: 0.35, a2: 0.041, b: 0.02, c1: 0.675, c2: 1.15, c3: 1.2, c4: 0.215, offset, sign }
}

/// One tool beside axis 6, and one that is longer.
static HELD: LazyLock<[Tool; 2]> = LazyLock::new(|| {
    let pose = Pose::new(Vector3::new(0.05, 0.02, 0.31), Vector3::new(0.0, 0.6, 0.0));
    let held = |number, flange_from_tool| Tool { number, flange_from_tool };
    [held(None, pose), held(Some(12), pose * Pose::translation(0.0, 0.0, 0.07))]
});

fn setup(geometry: &Geometry) -> Setup<'_> {
    Setup {
        robot: "KR 210",
        geometry,
        third_axis: ThirdAxis::Elbow,
        pendant: &Pendant::AsFile,
        controller: Controller::Drawn,
        base_from_part: Pose::new(Vector3::new(1.4, -0.3, 0.8), Vector3::new(0.1, -0.2, 0.7)),
        tools: &HELD[..1],
        remarks: &[],
        stiffness: Some("robot file"),
    }
}

fn style() -> Style {
    Style { name: "part".into(), rapid: 0.5, blend: 0.001, moves_per_file: None, fanuc_letters: None }
}

fn stations(count: usize, seed: u64) -> Vec<Station> {
    let mut rng = fastrand::Rng::with_seed(seed);
    let one = |i| Station {
        line: i + 1,
        joints: std::array::from_fn(|_| 2.0 * TAU * (rng.f64() - 0.5)),
        feed: Some(0.001 * (1 + i % 7) as f64),
        is_cutting: i % 5 != 0,
        tool: 0,
    };
    (0..count).map(one).collect()
}

/// By definition: the product of three turns, written out.
fn about(axis: usize, deg: f64) -> Matrix3<f64> {
    let (s, c) = (deg * PI / 180.0).sin_cos();
    match axis {
        0 => Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c),
        1 => Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c),
        _ => Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
    }
}

fn of_angles([x, y, z, a, b, c]: [f64; 6]) -> (Vector3<f64>, Matrix3<f64>) {
    (Vector3::new(x, y, z) * 1e-3, about(2, a) * about(1, b) * about(0, c))
}

/// The matrix of a quaternion, entry by entry.
fn of_quaternion(p: [f64; 3], [w, x, y, z]: [f64; 4]) -> (Vector3<f64>, Matrix3<f64>) {
    let r = Matrix3::new(
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    );
    (Vector3::from(p) * 1e-3, r)
}

fn assert_near(found: &(Vector3<f64>, Matrix3<f64>), expected: &Pose, what: &str) {
    let off = (found.0 - expected.translation.vector).norm();
    let turned = found.1 * expected.rotation.to_rotation_matrix().matrix().transpose();
    // The turn of a small rotation is its skew part.
    let turn = 0.5 * Vector3::new(turned.m32 - turned.m23, turned.m13 - turned.m31, turned.m21 - turned.m12).norm();
    assert!(off < NEAR && turn < NEAR && 2.9 < turned.trace(), "{what}: {off} m, {turn} rad");
}

/// All numbers of a text in their order, words aside.
fn numbers(text: &str) -> Vec<f64> {
    text.split(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).filter_map(|part| part.parse().ok()).collect()
}

fn six(text: &str) -> [f64; 6] {
    numbers(text).try_into().unwrap_or_else(|found| panic!("{text}: {found:?}"))
}

/// `{X 1,Y 2,...}` without the numbers that are part of names.
fn krl_frame(line: &str) -> [f64; 6] {
    let (_, inner) = line.split_once('{').unwrap();
    let parts: Vec<&str> = inner.split_once('}').unwrap().0.split(',').collect();
    let names: Vec<&str> = parts.iter().map(|part| part.split_once(' ').unwrap().0).collect();
    assert!(names == ["X", "Y", "Z", "A", "B", "C"] || names == ["A1", "A2", "A3", "A4", "A5", "A6"], "{line}");
    std::array::from_fn(|i| parts[i].split_once(' ').unwrap().1.parse().unwrap())
}

fn one_file(language: Language, setup: &Setup, stations: &[Station], style: &Style) -> String {
    let mut files = write(language, setup, stations, style).unwrap_or_else(|why| panic!("{why}"));
    assert_eq!(files.len(), 1);
    let ProgramFile { name, text } = files.remove(0);
    assert_eq!(name, format!("part.{}", language.ending()));
    assert!(text.is_ascii());
    text
}

#[test]
fn krl_leads_the_tool_where_the_joints_put_it() {
    let geometry = kuka();
    let (setup, stations) = (setup(&geometry), stations(200, 1));
    let text = one_file(Language::Krl, &setup, &stations, &style());
    let starting = |start: &'static str| text.lines().filter(move |line| line.starts_with(start));
    let lines: Vec<&str> = starting("LIN ").collect();
    assert_eq!(lines.len(), 199);
    for (line, station) in lines.iter().zip(&stations[1..]) {
        assert_near(&of_angles(krl_frame(line)), &setup.part_from_tool(0, &station.joints), line);
    }
    assert!(lines[..198].iter().all(|line| line.ends_with(" C_DIS")) && lines[198].ends_with('}'));
    let base = krl_frame(starting("$BASE=").next().unwrap());
    assert_near(&of_angles(base), &setup.base_from_part, "$BASE");
    let tool = krl_frame(starting("$TOOL=").next().unwrap());
    assert_near(&of_angles(tool), &setup.tools[0].flange_from_tool, "$TOOL");
    let start = krl_frame(starting("PTP ").next().unwrap()).map(f64::to_radians);
    assert_reached(&setup, &start, &stations[0]);
    // Feed of the second place: 0.002 m/s, and 0.5 m/s through the air.
    assert!(text.contains("$APO.CDIS=1.0000\n") && text.contains("$VEL.CP=0.002000\n"));
    assert!(text.contains("$VEL.CP=0.500000\n"));
}

fn assert_reached(setup: &Setup, joints: &[f64; 6], station: &Station) {
    let found = setup.part_from_tool(0, joints);
    let found = (found.translation.vector, *found.rotation.to_rotation_matrix().matrix());
    assert_near(&found, &setup.part_from_tool(0, &station.joints), "joints");
}

#[test]
fn rapid_leads_the_tool_where_the_joints_put_it_and_says_in_which_quarters_joints_stand() {
    let geometry = kuka();
    let (setup, stations) = (setup(&geometry), stations(200, 2));
    let text = one_file(Language::Rapid, &setup, &stations, &style());
    let lines: Vec<&str> = text.lines().filter(|line| line.contains("MoveL ")).collect();
    assert_eq!(lines.len(), 199);
    for (line, station) in lines.iter().zip(&stations[1..]) {
        let n = numbers(line);
        let q = [n[3], n[4], n[5], n[6]];
        assert!(0.0 <= q[0]);
        assert_near(&of_quaternion([n[0], n[1], n[2]], q), &setup.part_from_tool(0, &station.joints), line);
        for (cf, joint) in [(n[7], 0), (n[8], 3), (n[9], 5)] {
            let deg = station.joints[joint].to_degrees();
            assert!(cf * 90.0 <= deg && deg < cf * 90.0 + 90.0, "{line}");
        }
        assert!((0.0..=7.0).contains(&n[10]));
    }
    let data = |start: &str| {
        let line = text.lines().find(|line| line.trim().starts_with(start)).unwrap();
        numbers(line.split_once(":=").unwrap().1)
    };
    let (tool, part) = (data("PERS tooldata"), data("PERS wobjdata"));
    let pose = |n: &[f64]| of_quaternion([n[0], n[1], n[2]], [n[3], n[4], n[5], n[6]]);
    assert_near(&pose(&tool), &setup.tools[0].flange_from_tool, "tooldata");
    assert_near(&pose(&part), &setup.base_from_part, "wobjdata");
    let start = numbers(text.lines().find(|line| line.contains("MoveAbsJ")).unwrap());
    let start: [f64; 6] = std::array::from_fn(|i| start[i].to_radians());
    assert_reached(&setup, &start, &stations[0]);
    assert!(lines[198].contains(",fine,part_tool\\WObj:=part_wobj;"));
}

/// Each posture by what it looks like: ahead and over the arm; overhead, reaching back; bent back behind the upper arm.
#[test]
fn configurations_are_those_that_a_person_sees() {
    let geometry = Geometry { offset: [0.0; 6], sign: [1.0; 6], ..kuka() };
    let setup = setup(&geometry);
    let of_angles = |deg: [f64; 6]| {
        let two = [[0.0; 6], deg].map(|deg| Station {
            line: 1,
            joints: deg.map(f64::to_radians),
            feed: Some(0.01),
            is_cutting: true,
            tool: 0,
        });
        let rapid = one_file(Language::Rapid, &setup, &two, &style());
        let line = numbers(rapid.lines().find(|line| line.contains("MoveL ")).unwrap());
        let ls = one_file(Language::Ls, &setup, &two, &style());
        let (_, letters) = ls.rsplit_once("CONFIG : '").unwrap();
        (line[7..11].to_vec(), letters.split_once('\'').unwrap().0.to_owned())
    };
    // Upper arm up, forearm level ahead, tool down.
    assert_eq!(of_angles([10.0, 1.0, 89.0, 0.0, 90.0, 0.0]), (vec![0.0, 0.0, 0.0, 0.0], "N U T, 0, 0, 0".into()));
    // The same with the wrist turned over.
    assert_eq!(
        of_angles([10.0, 1.0, 89.0, 180.0, -90.0, -100.0]),
        (vec![0.0, 2.0, -2.0, 1.0], "F U T, 0, 1, 0".into())
    );
    // Upper arm level ahead, forearm up and over it backwards: elbow in front, wrist behind the upper arm's line, still ahead.
    let (quarters, letters) = of_angles([-10.0, 100.0, -120.0, 0.0, 45.0, 200.0]);
    assert_eq!((quarters, letters.as_str()), (vec![-1.0, 0.0, 2.0, 2.0], "N D T, 0, 0, 1"));
    // Both leaning back over the head: the wrist centre is behind axis 1, the elbow over the line to it.
    let (quarters, letters) = of_angles([-170.0, -60.0, -30.0, 0.0, 45.0, 0.0]);
    assert_eq!((quarters, letters.as_str()), (vec![-2.0, 0.0, 0.0, 6.0], "N U B, 0, 0, 0"));
}

/// What a frame is to be, from the remarks of the head of an LS file.
fn to_be_set(text: &str, start: &str) -> (Vector3<f64>, Matrix3<f64>) {
    let remarks = text.lines().filter_map(|line| line.split_once("  !")).map(|(_, remark)| remark);
    let head = remarks.map(|remark| remark.trim_end_matches(" ;")).collect::<Vec<_>>().join(" ");
    let (_, rest) = head.split_once(start).unwrap();
    let [x, y, z, r, p, w] = six(rest.split_once(" deg").unwrap().0);
    of_angles([x, y, z, r, p, w])
}

#[test]
fn ls_leads_the_tool_where_the_joints_put_it_in_the_frames_of_a_fanuc() {
    let geometry = kuka();
    let (setup, stations) = (setup(&geometry), stations(200, 3));
    let text = one_file(Language::Ls, &setup, &stations, &style());
    let (program, positions) = text.split_once("/POS\n").unwrap();
    let positions: Vec<&str> = positions.split("};\n").filter(|part| part.starts_with("P[")).collect();
    assert_eq!(positions.len(), 200);
    for (i, (text, station)) in positions.iter().zip(&stations).enumerate() {
        assert!(text.starts_with(&format!("P[{}]{{\n   GP1:\n\tUF : 1, UT : 1,", i + 1)), "{text}");
        let value = |name: &str| numbers(text.split_once(&format!("{name}= ")).unwrap().1)[0];
        if i == 0 {
            let joints = std::array::from_fn(|i| value(&format!("\tJ{}", i + 1)).to_radians());
            assert_reached(&setup, &joints, station);
        } else {
            let [x, y, z, w, p, r] = ["\tX ", "\tY ", "\tZ ", "\tW ", "\tP ", "\tR "].map(value);
            assert_near(&of_angles([x, y, z, r, p, w]), &setup.part_from_tool(0, &station.joints), text);
        }
    }
    let frame = |start: &str| to_be_set(&text, start);
    let up = Pose::translation(0.0, 0.0, 0.675);
    let user = frame("at the height of joint 2, to: ");
    assert_near(&(user.0 + up.translation.vector, user.1), &setup.base_from_part, "UFRAME");
    // At the zero of a Fanuc, forearm level ahead, the pendant shows W 180, P -90, R 0.
    let (_, shown) = of_angles([0.0, 0.0, 0.0, 0.0, -90.0, 180.0]);
    let level = geometry.forward(&[0.0, 0.0, FRAC_PI_2, 0.0, 0.0, 0.0]).rotation;
    let tool = frame("UTOOL 1, in the flange frame, to: ");
    let found = Rotation3::from_matrix_unchecked(shown * tool.1);
    let expected = level * setup.tools[0].flange_from_tool.rotation;
    assert!(expected.angle_to(&UnitQuaternion::from_rotation_matrix(&found)) < NEAR);
    // Lines are numbered and counted.
    let lines: Vec<&str> = program.split_once("/MN\n").unwrap().1.lines().collect();
    assert!(program.contains(&format!("LINE_COUNT\t= {};", lines.len())));
    assert!(lines.iter().enumerate().all(|(i, line)| line.starts_with(&format!("{:4}:", i + 1))));
    assert!(lines[lines.len() - 199].ends_with(":L P[2] 2.0mm/sec CNT100 ;"), "{:?}", lines.last());
    assert!(lines.last().unwrap().contains(":L P[200] ") && lines.last().unwrap().ends_with(" FINE ;"));
}

#[test]
fn the_table_of_joints_holds_the_joints_and_their_poses() {
    let geometry = kuka();
    let (setup, stations) = (setup(&geometry), stations(100, 4));
    let text = one_file(Language::JointsCsv, &setup, &stations, &style());
    let rows: Vec<Vec<f64>> = text.lines().filter(|line| !line.starts_with(['#', 'l'])).map(numbers).collect();
    assert_eq!(rows.len(), 100);
    for (i, (row, station)) in rows.iter().zip(&stations).enumerate() {
        assert_eq!((row[0], row.len()), (station.line as f64, 16));
        let joints: [f64; 6] = std::array::from_fn(|i| row[1 + i].to_radians());
        assert_reached(&setup, &joints, station);
        let pose = of_quaternion([row[7], row[8], row[9]], [row[10], row[11], row[12], row[13]]);
        assert_near(&pose, &setup.part_from_tool(0, &joints), "pose");
        let feed = if station.is_cutting { station.feed.unwrap() * 60e3 } else { 30e3 };
        assert!((row[14] - feed).abs() < 1e-3 && row[15] == f64::from(u8::from(station.is_cutting && i != 0)));
    }
}

/// Of each point of a trajectory: its joints, rad, and its time, s.
fn trajectory(text: &str) -> Vec<([f64; 6], f64)> {
    let point = |line: &str| {
        let (_, rest) = line.split_once("positions: [").unwrap();
        let (joints, rest) = rest.split_once("], time_from_start: {sec: ").unwrap();
        let (whole, rest) = rest.split_once(", nanosec: ").unwrap();
        let nanoseconds: u32 = rest.trim_end_matches('}').parse().unwrap();
        assert!(nanoseconds < 1_000_000_000, "{line}");
        let joints: Vec<f64> = joints.split(", ").map(|number| number.parse().unwrap()).collect();
        (joints.try_into().unwrap(), whole.parse::<f64>().unwrap() + f64::from(nanoseconds) / 1e9)
    };
    text.lines().filter(|line| line.starts_with("  - ")).map(point).collect()
}

#[test]
fn a_trajectory_has_the_joints_and_takes_as_long_as_the_way_at_its_speed() {
    let geometry = kuka();
    let (setup, stations) = (setup(&geometry), stations(100, 4));
    let text = one_file(Language::Ros2, &setup, &stations, &style());
    assert!(text.contains("joint_names: [joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]"));
    let points = trajectory(&text);
    assert_eq!((points.len(), points[0].1), (100, 0.0));
    let place = |station: &Station| setup.part_from_tool(0, &station.joints).translation.vector;
    for (pair, way) in points.windows(2).zip(stations.windows(2)) {
        assert!(pair[1].0.iter().zip(way[1].joints).all(|(a, b)| (a - b).abs() < 1e-9));
        let speed = if way[1].is_cutting { way[1].feed.unwrap() } else { 0.5 };
        let largest =
            way[0].joints.iter().zip(way[1].joints).map(|(a, b)| (b - a).abs().to_degrees()).fold(0.0, f64::max);
        let expected = ((place(&way[1]) - place(&way[0])).norm() / speed).max(largest / 30.0);
        // Both times are whole nanoseconds.
        assert!((pair[1].1 - pair[0].1 - expected).abs() < 2e-9, "{} {expected}", pair[1].1 - pair[0].1);
    }
    // A tool that only turns takes as long as 30 deg/s make of it: its tip stands while joint 6 turns by 60 deg.
    let turned = |turn: f64| Station { joints: [0.0, -1.2, 1.3, 0.0, 0.5, turn], ..stations[1] };
    let upright = Tool { number: None, flange_from_tool: Pose::translation(0.0, 0.0, 0.2) };
    // A place that is said twice is one point.
    let (tools, still) = ([upright], [turned(0.0), turned(0.0), turned(PI / 3.0), turned(PI / 3.0)]);
    let setup = Setup { tools: &tools, ..setup };
    let points = trajectory(&one_file(Language::Ros2, &setup, &still, &style()));
    assert!(points.len() == 2 && (points[1].1 - 2.0).abs() < 1e-9, "{points:?}");
}

#[test]
fn the_script_for_robodk_has_the_joints_and_the_poses_they_make() {
    let geometry = kuka();
    let (setup, stations) = (setup(&geometry), stations(100, 4));
    let text = one_file(Language::RoboDk, &setup, &stations, &style());
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter(|line| line.starts_with("    (") && line.ends_with("),"))
        .map(|line| numbers(&line.replace(['(', ')'], "").trim().trim_end_matches(',').replace(", ", ",")))
        .collect();
    assert_eq!(rows.len(), 100);
    for (i, (row, station)) in rows.iter().zip(&stations).enumerate() {
        assert_eq!((row[0], row.len(), row[15]), (station.line as f64, 16, 0.0));
        let joints: [f64; 6] = std::array::from_fn(|i| row[1 + i].to_radians());
        let pose = of_quaternion([row[7], row[8], row[9]], [row[10], row[11], row[12], row[13]]);
        assert_near(&pose, &setup.part_from_tool(0, &joints), "pose");
        let speed = if station.is_cutting && i != 0 { station.feed.unwrap() * 1e3 } else { 500.0 };
        assert!((row[14] - speed).abs() < 1e-5, "{} {speed}", row[14]);
    }
    // A name closes no text of the script.
    let named = Setup { robot: "a\"b\\", ..setup };
    let text = one_file(Language::RoboDk, &named, &stations, &style());
    assert!(
        text.contains("ROBOT = \"a\\\"b\\\\\"\n"),
        "{}",
        text.lines().find(|line| line.starts_with("ROBOT")).unwrap()
    );
}

/// Tools that point along x of the part, up and down, and a hair beside: the gimbal of all Euler angles.
#[test]
fn at_the_gimbal_and_close_to_it_poses_are_as_exact() {
    let geometry = kuka();
    let joints = [0.2, -1.1, 1.4, 0.3, 0.9, -0.4];
    let mut rng = fastrand::Rng::with_seed(5);
    for beside in [0.0, 1e-12, 1e-9, 1e-8, 3e-8, 1e-7, 1e-5, 1e-3] {
        for up in [-1.0, 1.0] {
            let (roll, yaw) = (TAU * rng.f64(), TAU * rng.f64());
            let wanted = about(2, yaw.to_degrees())
                * about(1, up * (90.0 - f64::to_degrees(beside)))
                * about(0, roll.to_degrees());
            let mut setup = setup(&geometry);
            let flange = geometry.forward(&geometry.model_angles(&joints, ThirdAxis::Elbow));
            let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(wanted));
            let target = Pose::from_parts(Translation3::new(0.1, 0.2, 0.3), rotation);
            let turned = Tool { number: None, flange_from_tool: flange.inverse() * setup.base_from_part * target };
            let tools = [turned];
            setup.tools = &tools;
            let station = |joints| Station { line: 1, joints, feed: Some(0.01), is_cutting: true, tool: 0 };
            let two = [station([0.0; 6]), station(joints)];
            let krl = one_file(Language::Krl, &setup, &two, &style());
            let line = krl.lines().find(|line| line.starts_with("LIN")).unwrap();
            assert_near(&of_angles(krl_frame(line)), &target, &format!("{beside} beside: {line}"));
            if beside <= 1e-9 {
                assert_eq!(krl_frame(line)[5], 0.0);
                assert!(
                    krl.contains("1 poses have B at 90 or -90 deg, where the angles are not unique: C is set to 0.")
                );
            }
        }
    }
}

#[test]
fn long_programs_are_cut_where_the_tool_is_in_the_air_and_hang_together() {
    let geometry = kuka();
    let (setup, stations) = (setup(&geometry), stations(50, 6));
    let style = Style { moves_per_file: Some(12), ..style() };
    let poses =
        |text: &str| -> Vec<[f64; 6]> { text.lines().filter(|line| line.starts_with("LIN ")).map(krl_frame).collect() };
    let files = write(Language::Krl, &setup, &stations, &style).unwrap();
    let whole = poses(&one_file(Language::Krl, &setup, &stations, &self::style()));
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    assert_eq!(names, ["part.src", "part_1.src", "part_2.src", "part_3.src", "part_4.src", "part_5.src"]);
    assert!(files[0].text.contains("\npart_1()\npart_2()\npart_3()\npart_4()\npart_5()\nEND\n"));
    let parts: Vec<Vec<[f64; 6]>> = files[1..].iter().map(|file| poses(&file.text)).collect();
    // Every fifth way is through the air: 10, 20, 30, 40, and the rest.
    assert_eq!(parts.iter().map(Vec::len).collect::<Vec<_>>(), [10, 10, 10, 10, 9]);
    assert_eq!(parts.concat(), whole);
    // Each begins, in joints, where the one before it ended.
    let start = krl_frame(files[2].text.lines().find(|line| line.starts_with("PTP ")).unwrap()).map(f64::to_radians);
    assert_reached(&setup, &start, &stations[10]);
    for language in [Language::Rapid, Language::Ls] {
        let files = write(language, &setup, &stations, &style).unwrap();
        let moves = |text: &str| text.lines().filter(|line| line.contains("MoveL ") || line.contains(":L P[")).count();
        assert_eq!(files.iter().map(|file| moves(&file.text)).collect::<Vec<_>>(), [0, 10, 10, 10, 10, 9]);
        let calls = files[0].text.lines().filter(|line| line.contains("part_") || line.contains("CALL PART_"));
        assert!(5 <= calls.count());
    }
}

#[test]
fn a_place_that_stays_is_written_once() {
    let geometry = kuka();
    let (setup, mut stations) = (setup(&geometry), stations(4, 7));
    stations[2].joints = stations[1].joints;
    stations[2].feed = None;
    let text = one_file(Language::Krl, &setup, &stations, &style());
    assert_eq!(text.matches("\nLIN ").count(), 2);
}

#[test]
fn heads_say_what_must_be_known_and_nothing_leaves_its_comment() {
    let geometry = kuka();
    let mut setup = setup(&geometry);
    setup.robot = "KR\nEND; \u{fc}";
    for language in Language::ALL {
        let text = one_file(language, &setup, &stations(5, 8), &style());
        let text = text
            .replace(" ;\n", "\n")
            .lines()
            .map(|line| line.split_once('!').map_or(line, |(_, it)| it))
            .collect::<Vec<_>>()
            .join(" ");
        assert!(text.contains("KR\\nEND"), "{text}");
        assert!(text.contains("absolute-accuracy correction of the controller must be off"), "{text}");
        assert!(text.contains("Stiffness: robot file"));
        assert!(text.contains("spindle, coolant and tool changes are not in it"), "{text}");
    }
}

#[test]
fn what_a_program_cannot_hold_is_refused_with_its_line() {
    let geometry = kuka();
    let (setup, good) = (setup(&geometry), stations(5, 9));
    let program_of = |stations: &[Station], style: &Style, language: Language| -> String {
        write(language, &setup, stations, style).expect_err("it is wrong").to_string()
    };
    let with = |change: fn(&mut Station)| {
        let mut stations = good.clone();
        change(&mut stations[3]);
        stations
    };
    for (change, expected) in [
        ((|s| s.feed = None) as fn(&mut Station), "line 4: no feed rate: expected one in the path"),
        (|s| s.feed = Some(0.0), "line 4: a feed rate of 0 mm/s: expected 0.01 to 3000 mm/s for KUKA KRL"),
        (|s| s.feed = Some(f64::NAN), "line 4: a feed rate of NaN mm/s"),
        (|s| s.feed = Some(9.0), "line 4: a feed rate of 9000 mm/s"),
        (|s| s.joints[2] = f64::NAN, "line 4: joint 3 at NaN deg: expected a number of at most 2000 deg"),
        (|s| s.joints[5] = 1e5, "line 4: joint 6 at"),
    ] {
        let found = program_of(&with(change), &style(), Language::Krl);
        assert!(found.starts_with(expected), "{found}");
    }
    let named = |name: &str| Style { name: name.into(), ..style() };
    for name in ["", "1a", "a-b", "a\nb", "seventeen_letters"] {
        assert!(matches!(write(Language::Krl, &setup, &good, &named(name)), Err(ProgramFault::Name { .. })));
    }
    for (style, expected) in [
        (Style { rapid: 4.0, ..style() }, "rapid = 4 m/s: expected a speed"),
        (Style { rapid: f64::NAN, ..style() }, "rapid = NaN m/s"),
        (Style { blend: -1.0, ..style() }, "blend = -1000 mm: expected 0 to 200 mm"),
        (Style { moves_per_file: Some(1), ..style() }, "moves per file = 1: expected at least 2"),
        (Style { fanuc_letters: Some("N U\n".into()), ..style() }, "fanuc letters = N U\\n: expected one of N F"),
    ] {
        let found = program_of(&good, &style, Language::Ls);
        assert!(found.starts_with(expected), "{found}");
    }
    assert_eq!(
        program_of(&good[..1], &style(), Language::Krl),
        "1 places of the robot; expected at least 2, from where to where"
    );
}

/// The chain that the authors of `docs/examples/fanuc_r2000ic.md` state of the R-2000iC, in modified Denavit-Hartenberg parameters (alpha, a, d),
/// whose angles are `(q1, q2, -(q2 + q3), -q4, -q5, -q6)` of those that the pendant shows; joint 2 stands upright at zero.
fn published_chain(q: &[f64; 6]) -> Pose {
    let quarter = FRAC_PI_2;
    let rows = [
        (0.0, 0.0, 0.670, q[0]),
        (-quarter, 0.312, 0.0, q[1] - quarter),
        (0.0, 1.075, 0.0, -(q[1] + q[2])),
        (-quarter, 0.225, 1.280, -q[3]),
        (quarter, 0.0, 0.0, -q[4]),
        (-quarter, 0.0, 0.215, -q[5]),
    ];
    rows.into_iter().fold(Pose::identity(), |chain, (alpha, a, d, theta)| {
        let turn = |axis: Vector3<f64>, angle: f64| Pose::rotation(axis * angle);
        chain
            * turn(Vector3::x(), alpha)
            * Pose::translation(a, 0.0, 0.0)
            * turn(Vector3::z(), theta)
            * Pose::translation(0.0, 0.0, d)
    })
}

/// `J1= 1 deg, J2= ...` of the first position.
fn first_joints(text: &str) -> [f64; 6] {
    let (_, positions) = text.split_once("P[1]{").unwrap();
    std::array::from_fn(|i| {
        let (_, rest) = positions.split_once(&format!("J{}= ", i + 1)).unwrap();
        rest.split_once(" deg").unwrap().0.parse::<f64>().unwrap().to_radians()
    })
}

#[test]
fn the_first_joints_of_a_fanuc_program_lead_its_published_chain_to_where_the_path_begins() {
    let robot = find("R-2000iC/165F").unwrap().robot();
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { panic!("six axes") };
    let setup = Setup { geometry, third_axis: limits.third_axis, pendant: &limits.pendant, ..setup(geometry) };
    let mut stations = stations(3, 5);
    // Joint 2 leans, so that an elbow and a forearm are not the same.
    stations[0].joints = [10.0, 35.0, -20.0, 30.0, -60.0, 100.0].map(f64::to_radians);
    let text = one_file(Language::Ls, &setup, &stations, &style());
    let reached = published_chain(&first_joints(&text));
    let wanted =
        setup.base_from_part * setup.part_from_tool(0, &stations[0].joints) * setup.tools[0].flange_from_tool.inverse();
    // Angles to 1e-6 deg on 3 m.
    assert!((reached.translation.vector - wanted.translation.vector).norm() < NEAR, "{reached} {wanted}");
    // At zero x of that chain points up, as of a Fanuc: the tool that is to be set stands in its flange where the path begins.
    let up = published_chain(&[0.0; 6]).rotation * Vector3::x();
    assert!((up - Vector3::z()).norm() < NEAR, "{up}");
    let (at, turn) = to_be_set(&text, "UTOOL 1, in the flange frame, to: ");
    let tip = ((reached * Point3::from(at)).coords, reached.rotation.to_rotation_matrix().matrix() * turn);
    let wanted = setup.base_from_part * setup.part_from_tool(0, &stations[0].joints);
    assert_near(&tip, &wanted, "the tip by the chain and UTOOL");
}

/// A Fanuc's flange has x up at its zeros, whatever a robot file takes for the zero of joint 6; KUKA's and ABB's has it down.
#[test]
fn a_tool_is_set_in_the_flange_frame_of_the_maker_whatever_the_file_counts_as_zero() {
    let plain = kuka();
    for (offset_6, fanuc, kuka) in [(0.0, [-1.0, -1.0], [1.0, 1.0]), (180.0, [1.0, 1.0], [-1.0, -1.0])] {
        let mut offset = plain.offset;
        offset[5] = f64::to_radians(offset_6);
        let geometry = Geometry { offset, ..plain.clone() };
        let tools = [Tool { number: None, flange_from_tool: Pose::translation(0.01, 0.02, 0.15) }];
        let setup = Setup { tools: &tools, ..setup(&geometry) };
        let stations = stations(2, 5);
        let (at, _) =
            to_be_set(&one_file(Language::Ls, &setup, &stations, &style()), "UTOOL 1, in the flange frame, to: ");
        let expected = Vector3::new(0.01 * fanuc[0], 0.02 * fanuc[1], 0.15);
        assert!((at - expected).norm() < NEAR, "{offset_6}: {at}");
        let krl = one_file(Language::Krl, &setup, &stations, &style());
        let (_, rest) = krl.split_once("$TOOL={X ").unwrap();
        let x: f64 = rest.split_once(',').unwrap().0.parse().unwrap();
        assert!((x - 10.0 * kuka[0]).abs() < 1e-3, "{offset_6}: {x}");
        let ros = one_file(Language::Ros2, &setup, &stations, &style());
        let towards = if offset_6 == 0.0 { "x points down" } else { "x points up" };
        assert!(ros.contains(towards), "{offset_6}: {ros}");
    }
}

#[test]
fn where_it_is_not_known_what_the_pendant_shows_no_joint_angle_is_written_and_the_first_lines_say_so() {
    let geometry = kuka();
    let setup = Setup { pendant: &Pendant::Unknown, ..setup(&geometry) };
    let stations = stations(30, 9);
    let start = setup.part_from_tool(0, &stations[0].joints);
    for (language, first_move, joints) in
        [(Language::Krl, "PTP {X ", "{A1"), (Language::Rapid, "MoveJ [", "MoveAbsJ"), (Language::Ls, "J P[1]", "J1=")]
    {
        let text = one_file(language, &setup, &stations, &style());
        assert!(text.contains(first_move) && !text.contains(joints), "{text}");
        let head: String = text.lines().take(24).collect::<Vec<_>>().join(" ");
        let said = head.replace(" ;", "").replace('!', "").replace(char::is_numeric, "").replace(": ", "");
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        let warning = said.find("WARNING").unwrap_or_else(|| panic!("{head}"));
        assert!(warning < said.find("Robot").unwrap(), "{said}");
    }
    let krl = one_file(Language::Krl, &setup, &stations, &style());
    let line = krl.lines().find(|line| line.starts_with("PTP ")).unwrap();
    assert_near(&of_angles(krl_frame(line)), &start, line);
    let rapid = one_file(Language::Rapid, &setup, &stations, &style());
    assert!(rapid.contains("ConfJ\\Off;") && rapid.contains("ConfL\\Off;"), "{rapid}");
    for language in [Language::RoboDk, Language::Ros2, Language::JointsCsv] {
        let refused = write(language, &setup, &stations, &style()).unwrap_err().to_string();
        assert!(refused.contains("KR 210") && refused.contains("pendant-as-file"), "{refused}");
    }
}

#[test]
fn whoever_says_that_the_pendant_counts_so_gets_the_move_in_joints_and_learns_what_it_rests_on() {
    let geometry = kuka();
    let (known, given) = (setup(&geometry), Setup { pendant: &Pendant::Given, ..setup(&geometry) });
    let stations = stations(30, 9);
    for language in Language::ALL {
        let [known, given] = [known, given].map(|setup| one_file(language, &setup, &stations, &style()));
        assert!(given.contains("WARNING") && !known.contains("WARNING"), "{given}");
        // Else the two programs are one.
        let moves = |text: &str| {
            let is_remark = |line: &&str| !line.trim_start().starts_with([';', '!', '#']) && !line.contains("  !");
            let of_count = |line: &&str| !line.starts_with("LINE_COUNT");
            let rest = text.lines().filter(is_remark).filter(of_count);
            // Lines of a Fanuc program are numbered.
            rest.map(|line| line.split_once(':').map_or(line, |(_, after)| after).to_owned()).collect::<Vec<_>>()
        };
        assert_eq!(moves(&given), moves(&known));
    }
}

/// A program of two tools, the first of which is put in again: 5, 4 and 3 places.
fn of_two_tools(language: Language, count: [usize; 3]) -> (Vec<Station>, Vec<String>) {
    let geometry = kuka();
    let numbered = [Tool { number: Some(3), ..HELD[0] }, HELD[1]];
    let setup = Setup { tools: &numbered, ..setup(&geometry) };
    let tools = [0, 1, 0].into_iter().zip(count).flat_map(|(tool, count)| std::iter::repeat_n(tool, count));
    let stations: Vec<Station> =
        stations(12, 5).into_iter().zip(tools).map(|(one, tool)| Station { tool, ..one }).collect();
    let text = one_file(language, &setup, &stations, &style());
    (stations, text.lines().map(str::to_owned).collect())
}

/// At each stop: the tool is named before it, then taken, and the arm goes in joints to where it begins; no corner before the stop is rounded.
#[test]
fn every_controller_stops_where_a_tool_is_changed_and_leads_each_where_its_joints_put_it() {
    let (geometry, changes, named) = (kuka(), [5, 9], ["Tool T12: change it by hand", "Tool T3: change it by hand"]);
    let numbered = [Tool { number: Some(3), ..HELD[0] }, HELD[1]];
    let setup = Setup { tools: &numbered, ..setup(&geometry) };
    let expected = |station: &Station| setup.part_from_tool(station.tool, &station.joints);
    let stops = |lines: &[String], stop: &str| -> Vec<usize> {
        lines.iter().enumerate().filter(|(_, line)| line.contains(stop)).map(|(at, _)| at).collect()
    };

    let (stations, krl) = of_two_tools(Language::Krl, [5, 4, 3]);
    let straight: Vec<&String> = krl.iter().filter(|line| line.starts_with("LIN ")).collect();
    let led: Vec<&Station> = (1..12).filter(|i| !changes.contains(i)).map(|i| &stations[i]).collect();
    assert_eq!((straight.len(), stops(&krl, "HALT").len()), (9, 2));
    for (line, station) in straight.iter().zip(&led) {
        assert_near(&of_angles(krl_frame(line)), &expected(station), line);
    }
    for ((at, change), named) in stops(&krl, "HALT").into_iter().zip(changes).zip(named) {
        assert!(
            krl[at - 2].starts_with(&format!("; {named}")) && !krl[at - 3].ends_with("C_DIS"),
            "{:?}",
            &krl[at - 3..at]
        );
        let tool = of_angles(krl_frame(&krl[at + 1]));
        assert_near(&tool, &setup.tools[stations[change].tool].flange_from_tool, &krl[at + 1]);
        let joints = krl_frame(&krl[at + 2]).map(f64::to_radians);
        assert!(krl[at + 2].starts_with("PTP {A1 "), "{}", krl[at + 2]);
        assert!((0..6).all(|i| (joints[i] - stations[change].joints[i]).abs() < NEAR), "{}", krl[at + 2]);
    }

    let (stations, rapid) = of_two_tools(Language::Rapid, [5, 4, 3]);
    let straight: Vec<&String> = rapid.iter().filter(|line| line.contains("MoveL ")).collect();
    assert_eq!((straight.len(), stops(&rapid, "    Stop;").len()), (9, 2));
    for (line, station) in straight.iter().zip(&led) {
        let n = numbers(line);
        assert_near(&of_quaternion([n[0], n[1], n[2]], [n[3], n[4], n[5], n[6]]), &expected(station), line);
        assert!(line.ends_with(&format!("part_tool{}\\WObj:=part_wobj;", [3, 12][station.tool])), "{line}");
    }
    for (number, tool) in [(3, 0), (12, 1)] {
        let data = rapid.iter().find(|line| line.contains(&format!("tooldata part_tool{number}:="))).expect("the tool");
        let n = numbers(data.split_once(":=").unwrap().1);
        let pose = of_quaternion([n[0], n[1], n[2]], [n[3], n[4], n[5], n[6]]);
        assert_near(&pose, &setup.tools[tool].flange_from_tool, data);
    }
    for ((at, change), named) in stops(&rapid, "    Stop;").into_iter().zip(changes).zip(named) {
        assert!(
            rapid[at - 2].contains(&format!("! {named}")) && rapid[at - 3].contains(",fine,"),
            "{:?}",
            &rapid[at - 3..at]
        );
        let start = &rapid[at + 1];
        assert!(
            start.contains("MoveAbsJ") && start.contains(&format!("part_tool{}\\", [3, 12][stations[change].tool]))
        );
        assert!((0..6).all(|i| (numbers(start)[i].to_radians() - stations[change].joints[i]).abs() < NEAR), "{start}");
    }

    let (stations, ls) = of_two_tools(Language::Ls, [5, 4, 3]);
    assert_eq!(stops(&ls, "  PAUSE").len(), 2);
    for ((at, change), named) in stops(&ls, "  PAUSE").into_iter().zip(changes).zip(named) {
        let before: Vec<&str> =
            ls[..at].iter().rev().take_while(|line| line.contains("  !")).map(String::as_str).collect();
        let remark: Vec<&str> =
            before.iter().rev().filter_map(|line| Some(line.split_once('!')?.1.trim_end_matches(" ;"))).collect();
        assert!(remark.join(" ").starts_with(named), "{remark:?}");
        assert!(ls[at - before.len() - 1].contains("FINE"), "{}", ls[at - before.len() - 1]);
        assert!(ls[at + 1].contains(&format!("UTOOL_NUM={}", stations[change].tool + 1)), "{}", ls[at + 1]);
        assert!(ls[at + 2].contains(&format!("J P[{}] 10% FINE", change + 1)), "{}", ls[at + 2]);
    }
    let whole = ls.join("\n");
    let positions: Vec<&str> = whole.split("/POS\n").nth(1).unwrap().split("};\n").collect();
    for (i, station) in stations.iter().enumerate() {
        assert!(positions[i].contains(&format!("UF : 1, UT : {},", station.tool + 1)), "{}", positions[i]);
        let value = |name: &str| numbers(positions[i].split_once(&format!("{name}= ")).unwrap().1)[0];
        if i == 0 || changes.contains(&i) {
            let joints: [f64; 6] = std::array::from_fn(|i| value(&format!("\tJ{}", i + 1)).to_radians());
            assert!((0..6).all(|i| (joints[i] - station.joints[i]).abs() < NEAR), "{}", positions[i]);
        } else {
            let [x, y, z, w, p, r] = ["\tX ", "\tY ", "\tZ ", "\tW ", "\tP ", "\tR "].map(value);
            assert_near(&of_angles([x, y, z, r, p, w]), &expected(station), positions[i]);
        }
    }
    let table = write(Language::JointsCsv, &setup, &stations, &style()).unwrap_err();
    assert_eq!(table, ProgramFault::Tools);
}
