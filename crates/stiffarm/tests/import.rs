//! Is every arm recovered from a URDF, whatever its frames and zero pose, and everything else refused with a reason?

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use fastrand::Rng;
use nalgebra::{UnitQuaternion, Vector3};
use stiffarm::catalogue::import::{ImportError, ImportOptions, Imported, import};
use stiffarm::catalogue::{Faults, read};
use stiffarm::drive::Architecture;
use stiffarm::geometry::Geometry;
use stiffarm::interval::Interval;
use stiffarm::limits::ThirdAxis;
use stiffarm::robot::{Arm, Status};
use stiffarm::spatial::Pose;

const EXAMPLE: &str = include_str!("../../../docs/examples/example_150.urdf");

const OPW: &str = "# an arm
opw_kinematics_geometric_parameters:
  a1: 0.3
  a2: -0.15
  b: 0.0
  c1: 0.6
  c2: 1.0
  c3: 1.1
  c4: 0.2
opw_kinematics_joint_offsets: [0, 0, deg(-90.0), 0, 0, !degrees 180]
opw_kinematics_joint_sign_corrections: [1, 1, -1, -1, -1, -1]
";

fn plain(text: &str) -> Result<Imported, ImportError> {
    import(text, "models/mine.urdf", &ImportOptions::default())
}

fn geometry(imported: &Imported) -> &Geometry {
    let Arm::SixAxis { geometry, .. } = &imported.robot.arm else { panic!("six axes") };
    geometry
}

fn lengths(geometry: &Geometry) -> [f64; 7] {
    let Geometry { a1, a2, b, c1, c2, c3, c4, .. } = *geometry;
    [a1, a2, b, c1, c2, c3, c4]
}

fn replaced(text: &str, old: &str, new: &str) -> String {
    assert!(text.contains(old), "'{old}' is not in the text");
    text.replacen(old, new, 1)
}

/// A rotation that is any with equal chance.
fn any_rotation(rng: &mut Rng) -> UnitQuaternion<f64> {
    let mut turn = || (rng.f64() - 0.5) * TAU;
    UnitQuaternion::from_euler_angles(turn(), turn() / 2.0, turn())
}

/// `origin` with every digit.
fn origin(pose: &Pose) -> String {
    let (p, (roll, pitch, yaw)) = (pose.translation.vector, pose.rotation.euler_angles());
    format!(r#"<origin xyz="{:?} {:?} {:?}" rpy="{roll:?} {pitch:?} {yaw:?}"/>"#, p.x, p.y, p.z)
}

/// A URDF of the arm: frames turned at will and shifted along their axes, joint zero where the offsets say.
fn urdf(arm: &Geometry, rng: &mut Rng) -> String {
    let t = arm.offset.map(|offset| -offset);
    let about = |axis: Vector3<f64>, angle: f64| Pose::rotation(axis * angle);
    let (y, z) = (Vector3::y(), Vector3::z());
    let second = about(z, t[0]) * Pose::translation(arm.a1, arm.b, arm.c1);
    let third = second * about(y, t[1]) * Pose::translation(0.0, 0.0, arm.c2);
    let fourth = third * about(y, t[2]) * Pose::translation(arm.a2, 0.0, arm.c3);
    let fifth = fourth * about(z, t[3]);
    let sixth = fifth * about(y, t[4]);
    let flange = sixth * about(z, t[5]) * Pose::translation(0.0, 0.0, arm.c4);
    let axes = [(Pose::identity(), z), (second, y), (third, y), (fourth, z), (fifth, y), (sixth, z)];

    let mut text = String::from("<robot name=\"any\">\n<link name=\"link_0\"/>\n");
    let mut before = Pose::identity();
    for (i, (frame, axis)) in axes.into_iter().enumerate() {
        let axis = frame.rotation * axis * arm.sign[i];
        let through = frame.translation.vector + axis * (rng.f64() - 0.5);
        let frame = Pose::from_parts(through.into(), any_rotation(rng));
        let local = frame.rotation.inverse() * axis;
        let n = i + 1;
        let head = format!("<link name=\"link_{n}\"/>\n<joint name=\"joint_{n}\" type=\"revolute\">");
        let links = format!("<parent link=\"link_{i}\"/><child link=\"link_{n}\"/>");
        let axis = format!("<axis xyz=\"{:?} {:?} {:?}\"/>", local.x, local.y, local.z);
        let limit = "<limit lower=\"-3\" upper=\"3\" velocity=\"2\"/></joint>\n";
        text.extend([head, links, origin(&(before.inverse() * frame)), axis, limit.into()]);
        before = frame;
    }
    let last = origin(&(before.inverse() * flange));
    text + &format!(
        "<link name=\"flange\"/>\n<joint name=\"f\" type=\"fixed\"><parent link=\"link_6\"/><child link=\"flange\"/>{last}</joint>\n</robot>\n"
    )
}

fn any_arm(rng: &mut Rng) -> Geometry {
    // A third of the offsets that may be absent are.
    let mut aside = |from: f64, to: f64| {
        let length = 0.01 + rng.f64() * (to - from) + from.max(0.0);
        if rng.u8(..3) == 0 { 0.0 } else { length * if from < 0.0 && rng.bool() { -1.0 } else { 1.0 } }
    };
    let (a1, a2, b) = (aside(0.0, 0.8), aside(-0.3, 0.3), aside(-0.2, 0.2));
    let mut long = |from: f64| from + rng.f64();
    let (c1, c2, c3, c4) = (long(0.2), long(0.3), long(0.3), long(0.05));
    let mut turned = |most: f64| (rng.f64() - 0.5) * 2.0 * most;
    // Of an arm whose shoulder stands above axis 1 forwards is where the base's x axis points: further round, it is described as bending backwards.
    let offset = [turned(if a1 == 0.0 { 1.4 } else { PI }), turned(PI), turned(PI), turned(PI), turned(PI), turned(PI)];
    let sign = std::array::from_fn(|_| if rng.bool() { 1.0 } else { -1.0 });
    Geometry { a1, a2, b, c1, c2, c3, c4, offset, sign }
}

#[test]
fn any_arm_in_any_frames_and_any_zero_pose_is_recovered_from_its_urdf() {
    let mut rng = Rng::with_seed(7);
    for case in 0..300 {
        let arm = any_arm(&mut rng);
        let text = urdf(&arm, &mut rng);
        let imported = plain(&text).unwrap_or_else(|error| panic!("case {case}: {error}\n{arm:?}\n{text}"));
        let found = geometry(&imported);
        // Of a shoulder above axis 1 either side may be called forwards: the same arm, its lengths aside with the other sign.
        let side = if arm.a1 == 0.0 && (found.a2 * arm.a2 < 0.0 || found.b * arm.b < 0.0) { -1.0 } else { 1.0 };
        let aside = [side, side, side, 1.0, 1.0, 1.0, 1.0];
        let expected = lengths(&arm).into_iter().zip(aside).map(|(length, side)| length * side);
        for (found, expected) in lengths(found).into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "case {case}: {found} {expected}\n{arm:?}\n{found:?}");
        }
        for _ in 0..50 {
            let q = std::array::from_fn(|_| (rng.f64() - 0.5) * 6.0);
            let flange = found.forward(&found.model_angles(&q, ThirdAxis::Elbow));
            let expected = arm.forward(&arm.model_angles(&q, ThirdAxis::Elbow));
            let distance = (flange.translation.vector - expected.translation.vector).norm();
            // Text has every digit; lengths are rounded to 1e-10 m and angles to 1e-9 deg over metres of arm.
            assert!(distance < 1e-9, "case {case}: {distance} m\n{arm:?}\n{found:?}");
            let turn = (flange.rotation.inverse() * expected.rotation).imag().norm();
            assert!(2.0 * turn < 1e-9, "case {case}: {turn}");
        }
        assert!(imported.largest_error < 1e-9 && imported.largest_turn < 1e-9, "{imported:?}");
    }
}

#[test]
fn the_example_is_understood_as_its_drawing_says() {
    let imported = plain(EXAMPLE).unwrap();
    // By hand: 300 ahead, 400 + 200 up, 1000 upper arm, forearm 150 above the elbow and 500 + 600 long, 100 + 100 to the flange.
    assert_eq!(lengths(geometry(&imported)), [0.3, -0.15, 0.0, 0.6, 1.0, 1.1, 0.2]);
    assert_eq!(geometry(&imported).offset, [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0]);
    assert_eq!(geometry(&imported).sign, [1.0; 6]);
    let robot = &imported.robot;
    assert_eq!(
        (robot.name.as_str(), robot.status, robot.architecture_is_assumed),
        ("Example 150", Status::Derived, true)
    );
    let Arm::SixAxis { limits, .. } = &robot.arm else { panic!("six axes") };
    let degrees = |i: usize| (limits.joints[i].min().to_degrees().round(), limits.joints[i].max().to_degrees().round());
    assert_eq!([degrees(1), degrees(2), degrees(5)], [(-65.0, 85.0), (-180.0, 70.0), (-360.0, 360.0)]);
    assert_eq!(limits.speeds.map(|speeds| speeds[1].to_degrees().round()), Some(100.0));
    assert_eq!(read(&imported.text, "x.toml").as_ref(), Ok(robot));
    assert!(imported.text.contains("joint_deg = [[-180, 180], [-65, 85], "), "{}", imported.text);
    assert!(imported.notes.iter().any(|note| note.contains("'tool0'")), "{:?}", imported.notes);
}

#[test]
fn what_the_user_knows_better_goes_before_the_file() {
    let options = ImportOptions {
        name: Some("Mine".into()),
        vendor: Some("Maker".into()),
        payload_kg: Some(150.0),
        reach: Some(2.4),
        architecture: Some(Architecture::QuasiSerial),
        limits: Some([Interval::spanning(-1.0, 1.0); 6]),
        tip: Some("link_6".into()),
        base: Some("link_1".into()),
    };
    // Without joint 1 no arm is left, and that is said; from the root it is.
    assert!(matches!(import(EXAMPLE, "x.urdf", &options), Err(ImportError::Class(_))));
    let imported = import(EXAMPLE, "x.urdf", &ImportOptions { base: Some("base_link".into()), ..options }).unwrap();
    let robot = &imported.robot;
    assert_eq!((robot.full_name().as_str(), robot.payload_kg, robot.reach), ("Maker Mine", Some(150.0), Some(2.4)));
    assert_eq!((robot.architecture, robot.architecture_is_assumed), (Architecture::QuasiSerial, false));
    assert!((geometry(&imported).c4 - 0.1).abs() < 1e-12, "link 6 stands 100 mm from the wrist centre");
    let Arm::SixAxis { limits, .. } = &robot.arm else { panic!("six axes") };
    assert!((limits.joints[3].max() - 1.0).abs() < 1e-4, "to 0.01 deg");
}

#[test]
fn digits_that_were_rounded_away_are_tolerated_and_reported() {
    // An arm that faces -x at zero and turns back by a pi of five digits; its forearm lies level by another.
    let text = replaced(EXAMPLE, r#"<origin xyz="0 0 0.4"/>"#, r#"<origin xyz="0 0 0.4" rpy="0 3.1416 3.1416"/>"#);
    let text = replaced(&text, r#"<origin xyz="0.3 0 0.2"/>"#, r#"<origin xyz="0.3 0 -0.2" rpy="3.1416 0 0"/>"#);
    let imported = plain(&text).unwrap();
    assert_eq!(lengths(geometry(&imported)), [0.3, -0.15, 0.0, 0.6, 1.0, 1.1, 0.2], "{}", imported.text);
    // 7e-6 rad twice over about 2.5 m.
    assert!((1e-6..1e-4).contains(&imported.largest_error), "{}", imported.largest_error);
}

#[test]
fn an_arm_that_faces_sideways_or_backwards_at_zero_keeps_its_lengths() {
    let facing = |rpy: &str| {
        let first = format!(r#"<origin xyz="0 0 0.4" rpy="{rpy}"/>"#);
        plain(&replaced(EXAMPLE, r#"<origin xyz="0 0 0.4"/>"#, &first)).unwrap()
    };
    for (rpy, offset) in [("0 0 1.5707963267948966", -FRAC_PI_2), ("0 0 -1.5707963267948966", FRAC_PI_2)] {
        let imported = facing(rpy);
        assert_eq!(lengths(geometry(&imported)), [0.3, -0.15, 0.0, 0.6, 1.0, 1.1, 0.2]);
        assert!((geometry(&imported).offset[0] - offset).abs() < 1e-9);
    }
    // However the base frame is turned, it is the same arm: the shoulder says where forwards is, and joint 1 has the turn.
    let drawn = plain(EXAMPLE).unwrap();
    for rpy in ["0 0 3.141592653589793", "0 0 1.75", "0 0 -2.5"] {
        let turned = facing(rpy);
        for (found, expected) in lengths(geometry(&turned)).into_iter().zip(lengths(geometry(&drawn))) {
            assert!((found - expected).abs() < 1e-9, "{rpy}: {found} {expected}");
        }
        assert!(turned.largest_error < 1e-9);
        let planes = [&turned, &drawn].map(|one| one.robot.arm_plane().unwrap());
        assert!((planes[0].arm.l3 - planes[1].arm.l3).abs() < 1e-9);
    }
    // A shoulder above axis 1 says nothing of it; then joint 2 does, which turns from -65 to 85 deg.
    let first = r#"<origin xyz="0 0 0.4" rpy="0 0 3.141592653589793"/>"#;
    for shoulder in ["0", "0.008"] {
        let above = replaced(EXAMPLE, r#"<origin xyz="0.3 0 0.2"/>"#, &format!(r#"<origin xyz="{shoulder} 0 0.2"/>"#));
        let turned = plain(&replaced(&above, r#"<origin xyz="0 0 0.4"/>"#, first)).unwrap();
        for (found, expected) in lengths(geometry(&turned)).into_iter().zip(lengths(geometry(&plain(&above).unwrap())))
        {
            assert!((found - expected).abs() < 1e-9, "{shoulder}: {found} {expected}");
        }
        // And where that turns as far to either side, the base's x axis.
        let limit = r#"lower="-1.1345" upper="1.4835""#;
        let even =
            replaced(&replaced(&above, limit, r#"lower="-1.4" upper="1.4""#), r#"<origin xyz="0 0 0.4"/>"#, first);
        assert!((geometry(&plain(&even).unwrap()).a2 - 0.15).abs() < 1e-9);
    }
}

#[test]
fn helper_links_pedestals_and_shifted_bases_are_noted() {
    let loops = r#"<link name="lever"/><joint name="lever_joint" type="continuous"><parent link="link_2"/><child link="lever"/>
        <axis xyz="0 1 0"/><mimic joint="joint_3" multiplier="-1"/></joint>
        <link name="world"/><link name="pedestal"/>
        <joint name="p" type="fixed"><origin xyz="1 2 0.5"/><parent link="world"/><child link="pedestal"/></joint>
        <joint name="b" type="fixed"><parent link="pedestal"/><child link="base_link"/></joint></robot>"#;
    let text = replaced(EXAMPLE, "</robot>", loops);
    let imported = plain(&text).unwrap();
    let notes = imported.notes.join("\n");
    assert_eq!(lengths(geometry(&imported))[3], 0.6, "the pedestal is not part of the arm");
    for says in ["'base_link'", "lever_joint", "parallelogram", "serial is assumed"] {
        assert!(notes.contains(says), "'{says}' is not in\n{notes}");
    }
    let on_world = ImportOptions { base: Some("world".into()), ..ImportOptions::default() };
    let imported = import(&text, "x.urdf", &on_world).unwrap();
    assert!((lengths(geometry(&imported))[3] - 1.1).abs() < 1e-9);
    assert!(imported.notes.join("\n").contains("axis 1 stands 1000.0 mm, 2000.0 mm from the origin"));
    let continuous =
        replaced(EXAMPLE, r#"<joint name="joint_6" type="revolute">"#, r#"<joint name="joint_6" type="continuous">"#);
    let continuous =
        replaced(&continuous, r#"<limit lower="-6.2832" upper="6.2832" effort="0" velocity="3.3161"/>"#, "");
    assert!(plain(&continuous).unwrap().notes.join("\n").contains("joint_6 is continuous: -360 to 360 deg"));
}

/// The faults of a text that must be refused, under the name of the file and with lines in order.
fn faults(text: &str) -> Faults {
    let faults = match plain(text) {
        Ok(imported) => panic!("accepted:\n{}", imported.text),
        Err(ImportError::Faults(faults) | ImportError::Which(faults) | ImportError::Class(faults)) => faults,
        Err(other) => panic!("{other}"),
    };
    assert!(!faults.faults.is_empty() && faults.faults.is_sorted_by_key(|fault| fault.line), "{faults}");
    assert!(faults.to_string().starts_with("models/mine.urdf:"));
    faults
}

#[test]
fn what_is_no_arm_of_this_class_is_refused_with_the_joint_and_the_reason() {
    let j5 = "<origin xyz=\"0.6 0 0\"/>";
    let slide = r#"type="prismatic">"#;
    for (old, new, key, says) in [
        (
            r#"<origin xyz="0.3 0 0.2"/>"#,
            r#"<origin xyz="0.3 0 0.2" rpy="0.01 0 0"/>"#,
            "joint joint_2",
            &["89.427 deg to axis 1"][..],
        ),
        (
            r#"<origin xyz="0.1 0 0"/>"#,
            r#"<origin xyz="0.1 0 0" rpy="0 0 0.01"/>"#,
            "joint joint_6",
            &["89.427 deg to axis 5"],
        ),
        (
            j5,
            r#"<origin xyz="0.6 0 0.0012"/>"#,
            "joint joint_5",
            &["axes 4, 5, 6 do not meet", "1.200 mm", "within 0.5 mm"],
        ),
        (
            r#"<origin xyz="0.1 0 0"/>"#,
            r#"<origin xyz="0.1 0.16 0"/>"#,
            "joint joint_5",
            &["160.000 mm apart along axis 5"],
        ),
        (
            j5,
            r#"<origin xyz="0.6 0 0" rpy="0 0 0.01"/>"#,
            "joint joint_5",
            &["axis 5 stands at 89.427 deg to axis 4", "at right angles"],
        ),
        (
            r#"<origin xyz="0 0 1"/>"#,
            r#"<origin xyz="0 0 1" rpy="0.01 0 0"/>"#,
            "joint joint_3",
            &["0.573 deg to axis 2", "parallel"],
        ),
        (
            r#"<origin xyz="0 0 0.4"/>"#,
            r#"<origin xyz="0 0 0.4" rpy="1.5 0 0"/>"#,
            "joint joint_1",
            &["85.944 deg to the base's z axis"],
        ),
        (r#"<origin xyz="0 0 1"/>"#, r#"<origin xyz="0 0 0"/>"#, "joint joint_5", &["beside the elbow"]),
        (
            r#"name="joint_4" type="revolute">"#,
            &format!(r#"name="joint_4" {slide}"#),
            "",
            &["5 joints turn", "'joint_4' slides", "expected six"],
        ),
        (
            r#"name="joint_6-flange" type="fixed">"#,
            r#"name="joint_6-flange" type="continuous">"#,
            "joint joint_6-flange",
            &["a seventh axis"],
        ),
        (r#"<limit lower="-2.0944""#, r#"<mimic joint="joint_4"/><limit lower="-2.0944""#, "", &["5 joints turn"]),
        (
            r#"<origin xyz="0.5 0 0.15"/>"#,
            r#"<origin xyz="0.5 0 50"/>"#,
            "geometry.a2_mm",
            &["-50000 mm", "as it was recovered"],
        ),
    ] {
        let found = faults(&replaced(EXAMPLE, old, new));
        let fault = &found.faults[0];
        assert_eq!(fault.key, key, "{found}");
        for part in says {
            assert!(fault.message.contains(part), "'{found}' does not say '{part}'");
        }
    }
    let rail = replaced(
        EXAMPLE,
        "</robot>",
        r#"<link name="rail"/><joint name="slide" type="prismatic"><parent link="rail"/><child link="base_link"/></joint></robot>"#,
    );
    assert!(
        faults(&replaced(&rail, "base_link\"/>\n  <link", "base_link\"/>\n<link"))
            .to_string()
            .contains("joint slide: a prismatic joint")
    );
    let from = ImportOptions { base: Some("base_link".into()), ..ImportOptions::default() };
    assert!(import(&rail, "x.urdf", &from).is_ok(), "the arm on the rail is one");
}

#[test]
fn a_faulty_urdf_is_refused_with_line_joint_value_and_what_was_expected() {
    let axis_2 = "<child link=\"link_2\"/>\n    <axis xyz=\"0 1 0\"/>";
    let with_axis_2 = |xyz: &str| format!("<child link=\"link_2\"/>\n    <axis xyz=\"{xyz}\"/>");
    let limit_5 = r#"<limit lower="-2.0944" upper="2.0944" effort="0" velocity="2.4435"/>"#;
    for (old, new, line, key, says) in [
        (axis_2, with_axis_2("0 0 0"), 24, "joint joint_2, axis xyz", &["0 0 0 has no direction"][..]),
        (axis_2, with_axis_2("0 nan 0"), 24, "joint joint_2, axis xyz", &["'nan'; expected a number"]),
        (axis_2, with_axis_2("0 1"), 24, "joint joint_2, axis xyz", &["'0 1' has 2 numbers; expected three"]),
        (r#"xyz="0.3 0 0.2""#, "xyz=\"0.3 1e999 0.2\"".into(), 21, "joint joint_2, origin xyz", &["'1e999'"]),
        (
            r#"xyz="0.3 0 0.2""#,
            "xyz=\"300 0 200\"".into(),
            21,
            "joint joint_2, origin xyz",
            &["'300'", "-100 to 100, in m"],
        ),
        (limit_5, String::new(), 41, "joint joint_5, limit", &["missing; expected lower and upper in rad"]),
        (
            limit_5,
            r#"<limit lower="2" upper="-2"/>"#.into(),
            41,
            "joint joint_5, limit",
            &["2 to -2 rad", "below the upper"],
        ),
        (
            limit_5,
            r#"<limit lower="-120" upper="120"/>"#.into(),
            41,
            "joint joint_5, limit",
            &["-120 to 120 rad", "in radians"],
        ),
        (limit_5, r#"<limit lower="inf" upper="NaN"/>"#.into(), 46, "joint joint_5, limit lower", &["'inf'"]),
        (
            r#"name="joint_3" type="revolute""#,
            r#"name="joint_3" type="hinge""#.into(),
            27,
            "joint joint_3, type",
            &["'hinge'"],
        ),
        (
            r#"name="joint_3" type="revolute""#,
            r#"name="joint_2" type="revolute""#.into(),
            27,
            "joint joint_2",
            &["two joints of this name"],
        ),
        (r#"name="joint_3" type="revolute""#, r#"type="revolute""#.into(), 27, "joint", &["has no name"]),
        ("<parent link=\"link_2\"/>", "<parent link=\"link_X\"/>".into(), 27, "joint joint_3", &["parent 'link_X'"]),
        ("<child link=\"link_3\"/>", String::new(), 27, "joint joint_3, child", &["missing"]),
        ("<link name=\"link_3\"/>", "<link name=\"link_2\"/>".into(), 7, "link link_2", &["two links of this name"]),
        (
            "<parent link=\"base_link\"/>",
            "<parent link=\"tool0\"/>".into(),
            5,
            "link link_1",
            &["not carried by the root 'base_link'", "ring"],
        ),
        (
            "<link name=\"link_3\"/>",
            "<link name=\"link_3\"/><link name=\"lost\"/>".into(),
            4,
            "",
            &["2 links are the child of no joint ('base_link', 'lost')"],
        ),
        (
            "<link name=\"base_link\"/>",
            String::new(),
            13,
            "joint joint_1",
            &["parent 'base_link' is not the name of a link"],
        ),
        ("<parent link=\"flange\"/>", "<parent link=\"tool0\"/>".into(), 12, "link tool0", &["ring"]),
        (
            "<child link=\"flange\"/>",
            "<child link=\"link_6\"/>".into(),
            55,
            "joint joint_6-flange",
            &["'link_6' is the child of joint 'joint_6' too", "a tree"],
        ),
        ("<robot name=\"Example 150\">", "<robot>".into(), 1, "robot name", &["missing"]),
    ] {
        let found = faults(&replaced(EXAMPLE, old, &new));
        let fault = &found.faults[0];
        assert_eq!((fault.line, fault.key.as_str()), (line, key), "{found}");
        for part in says {
            assert!(fault.message.contains(part), "'{found}' does not say '{part}'");
        }
    }
}

#[test]
fn every_fault_of_a_file_is_found_at_once() {
    let text = replaced(EXAMPLE, "0.3 0 0.2", "0.3 zero 0.2");
    let text = replaced(&text, r#"<axis xyz="1 0 0"/>"#, r#"<axis xyz="0 0 0"/>"#);
    let text = replaced(&text, r#"name="joint_5" type="revolute""#, r#"name="joint_5""#);
    let text = replaced(&text, "-6.2832", "-inf");
    let found = faults(&text);
    let keys: Vec<_> = found.faults.iter().map(|fault| fault.key.as_str()).collect();
    let expected =
        ["joint joint_2, origin xyz", "joint joint_4, axis xyz", "joint joint_4, limit lower", "joint joint_5, type"];
    assert_eq!(keys, expected, "{found}");
    // Limits and axes are judged together too.
    let text = replaced(EXAMPLE, r#"<origin xyz="0.6 0 0"/>"#, r#"<origin xyz="0.6 0.2 0" rpy="0 0 0.2"/>"#);
    let text = replaced(&text, r#"lower="-3.1416""#, r#"lower="3.2""#);
    let found = faults(&text);
    assert_eq!(found.faults[0].key, "joint joint_1, limit", "{found}");
    assert_eq!(found.faults[1].key, "joint joint_5", "{found}");
}

#[test]
fn one_of_several_arms_is_chosen_by_name() {
    let second = EXAMPLE.replace("_link\"", "_link_b\"").replace("link_", "b_link_").replace("joint_", "b_joint_");
    let second = second.replace("\"flange", "\"b_flange").replace("\"tool0\"", "\"b_tool0\"");
    let (first, _) = EXAMPLE.split_once("</robot>").unwrap();
    let (_, second) = second.split_once("Example 150\">").unwrap();
    let both = format!("{first}{second}").replace(
        "</robot>",
        r#"<link name="table"/><joint name="t" type="fixed"><parent link="table"/><child link="base_link"/></joint>
        <joint name="u" type="fixed"><origin xyz="0 2 0"/><parent link="table"/><child link="base_b_link_b"/></joint></robot>"#,
    );
    let Err(ImportError::Which(found)) = plain(&both) else { panic!("two arms are not one") };
    assert!(found.to_string().contains("several arms: the links 'link_6', 'b_link_6'"), "{found}");
    let tip = |tip: &str| ImportOptions { tip: Some(tip.into()), ..ImportOptions::default() };
    assert!(import(&both, "x.urdf", &tip("b_tool0")).is_ok());
    let Err(ImportError::Which(found)) = import(&both, "x.urdf", &tip("b_tol0")) else { panic!("no such link") };
    assert!(found.to_string().contains("no link is named 'b_tol0'; did you mean 'b_tool0'?"), "{found}");
}

#[test]
fn a_macro_file_that_is_not_of_the_simple_form_is_refused_with_what_is_not_read() {
    let head = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" name=\"a\">";
    let called = format!("{head}\n<xacro:arm prefix=\"\"/></robot>");
    let undeclared = "<robot name=\"a\">\n<xacro:macro name=\"b\"/></robot>".to_owned();
    let prefixed = replaced(EXAMPLE, "name=\"joint_3\"", "name=\"${prefix}joint_3\"");
    for (text, expected) in [
        (called, "line 2: xacro:arm is not read"),
        (undeclared, "line 2: the namespace xacro is not declared"),
        (prefixed, "${prefix} is not read"),
    ] {
        let error = plain(&text).unwrap_err();
        let ImportError::Xacro { file, why } = &error else { panic!("{error}") };
        assert!(file == "models/mine.urdf" && why.contains(expected), "{why}; expected {expected}");
        assert!(error.to_string().contains("; expected the URDF that it expands to"), "{error}");
    }
    // What xacro leaves behind: the declaration, and comments.
    let expanded = EXAMPLE.replace("<robot ", "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" ");
    assert!(plain(&expanded.replace("<link name=\"link_1\"/>", "<!-- xacro:x --><link name=\"link_1\"/>")).is_ok());
}

#[test]
fn hostile_texts_are_refused_at_once() {
    for end in (0..EXAMPLE.len()).step_by(7) {
        let error = plain(&EXAMPLE[..end]).expect_err("a truncated file");
        assert!(error.to_string().starts_with("models/mine.urdf:"), "{error}");
    }
    let bomb = "<?xml version=\"1.0\"?><!DOCTYPE r [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]><robot name=\"&b;\"/>";
    assert!(faults(bomb).to_string().contains("no document type and no entities"), "{}", faults(bomb));
    let deep = "<robot name=\"a\">".to_owned() + &"<link name=\"x\">".repeat(50_000);
    let closed = deep.clone() + &"</link>".repeat(50_000) + "</robot>";
    let chain: String = (0..20_000)
        .map(|i| format!("<link name=\"l{i}\"/><joint name=\"j{i}\" type=\"revolute\"><parent link=\"l{i}\"/><child link=\"l{}\"/></joint>", i + 1))
        .collect();
    let chain = format!("<robot name=\"a\">{chain}<link name=\"l20000\"/></robot>");
    let control = "<robot name=\"\u{1}\"/>";
    let large = format!("<robot>{}", " ".repeat(5_000_000));
    for text in [
        "",
        "  ",
        "<",
        "<robot/>",
        "<robot name='a'/>",
        "<a><b></a>",
        "{",
        "&",
        "a: *b",
        &deep,
        &closed,
        &chain,
        control,
        &large,
    ] {
        let found = faults(text);
        assert!(found.to_string().len() < 2000, "{}", &text[..text.len().min(100)]);
    }
    for joint in [
        "<joint/>",
        "<joint name='j' type='fixed'/>",
        "<joint name='j' type='revolute'><origin xyz='1e308 1e308 1e308' rpy='1e308 0 0'/></joint>",
    ] {
        faults(&replaced(EXAMPLE, "</robot>", &format!("{joint}</robot>")));
    }
    let esc = replaced(EXAMPLE, "0.3 0 0.2", "0.3 \u{202e} &#10;&#10;x");
    assert!(!faults(&esc).to_string().contains('\u{202e}'));
}

#[test]
fn opw_parameters_are_an_arm_once_limits_are_given() {
    let given = ImportOptions { limits: Some([Interval::spanning(-2.0, 2.0); 6]), ..ImportOptions::default() };
    let file = "config/opw_parameters_mine.yaml";
    assert_eq!(import(OPW, file, &ImportOptions::default()), Err(ImportError::NoLimits { file: file.into() }));
    let imported = import(OPW, file, &given).unwrap();
    assert_eq!(lengths(geometry(&imported)), [0.3, -0.15, 0.0, 0.6, 1.0, 1.1, 0.2]);
    assert_eq!(geometry(&imported).offset, [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, PI]);
    assert_eq!(geometry(&imported).sign, [1.0, 1.0, -1.0, -1.0, -1.0, -1.0]);
    assert_eq!(imported.robot.name, "mine");
    assert!(imported.largest_error < 1e-9 && imported.largest_turn < 1e-9);
    // Nested under the name of an arm, as some files have it.
    let nested: String =
        std::iter::once("manipulator:\n".to_owned()).chain(OPW.lines().map(|line| format!("  {line}\n"))).collect();
    assert_eq!(import(&nested, file, &given).unwrap().robot.arm, imported.robot.arm);
}

#[test]
fn faulty_opw_parameters_are_refused_with_line_key_and_value() {
    for (old, new, line, key, says) in [
        (
            "a1: 0.3",
            "a1: short",
            3,
            "opw_kinematics_geometric_parameters.a1",
            "'short'; expected a number from -20 to 20, m",
        ),
        ("a1: 0.3", "a1: .nan", 3, "opw_kinematics_geometric_parameters.a1", "'.nan'"),
        ("a1: 0.3", "a1: 300", 3, "opw_kinematics_geometric_parameters.a1", "'300'"),
        ("  c4: 0.2\n", "", 3, "opw_kinematics_geometric_parameters.c4", "missing"),
        ("deg(-90.0)", "deg(-90.0", 0, "", ""),
        ("deg(-90.0)", "-90 deg", 10, "opw_kinematics_joint_offsets", "'-90 deg'"),
        ("[1, 1, -1,", "[1, 1, 0,", 11, "opw_kinematics_joint_sign_corrections", "six times 1 or -1"),
        ("[1, 1, -1,", "[1, 1,", 11, "opw_kinematics_joint_sign_corrections", "5 values; expected six"),
        ("opw_kinematics_joint_offsets", "offsets", 1, "opw_kinematics_joint_offsets", "missing"),
        ("opw_kinematics_geometric_parameters", "lengths", 1, "", "neither a URDF nor OPW parameters"),
        ("c2: 1.0", "c2: [1.0", 0, "", ""),
        ("c2: 1.0", "c2: *two", 0, "", ""),
    ] {
        let found = faults(&replaced(OPW, old, new));
        let fault = &found.faults[0];
        assert!(line == 0 || (fault.line, fault.key.as_str()) == (line, key), "{found}");
        assert!(fault.message.contains(says), "{found}");
    }
    let under = |name: &str| format!("{name}:\n{}", OPW.lines().map(|line| format!("  {line}\n")).collect::<String>());
    assert!(faults(&(under("a") + &under("b"))).to_string().contains("stands here 2 times; expected one arm"));
    assert!(faults(&(under("a") + &under("a"))).to_string().contains("a: stands here twice"));
    let alias = replaced(&replaced(OPW, "a1: 0.3", "a1: &x 0.3"), "c4: 0.2", "c4: *x");
    assert!(faults(&alias).to_string().contains("9: an alias (*); expected plain values"), "{}", faults(&alias));
    assert!(faults(&("- ".repeat(40) + "1")).to_string().contains("nested too deeply"));
    for deep in
        ["[".repeat(100_000), "- ".repeat(100_000), "a:\n".repeat(10), "? ".repeat(50_000), "{a: ".repeat(50_000)]
    {
        assert!(faults(&deep).faults.len() == 1);
    }
}

#[test]
fn a_lean_that_adds_up_over_the_arm_is_refused() {
    // 0.046 deg at joint 1 are within what axes may lean, but not over the length of this arm.
    let text = replaced(EXAMPLE, r#"<origin xyz="0 0 0.4"/>"#, r#"<origin xyz="0 0 0.4" rpy="0 0.0008 0"/>"#);
    let error = plain(&text).unwrap_err();
    let ImportError::Inexact { error_m, .. } = error else { panic!("{error}") };
    // The fit is exact at zero; half a turn on, twice 0.0008 rad over at most the 2.9 m from joint 1 to the flange.
    assert!((1e-3..5e-3).contains(&error_m), "{error_m}");
    assert!(error.to_string().contains("expected at most 0.5 mm and 0.05 deg: axis 1 leans by 0.0458 deg"), "{error}");
}

#[test]
fn an_axis_that_turns_the_other_way_is_a_sign_and_no_offset() {
    let text = replaced(
        EXAMPLE,
        "<child link=\"link_5\"/>\n    <axis xyz=\"0 1 0\"/>",
        "<child link=\"link_5\"/>\n    <axis xyz=\"0 -1 0\"/>",
    );
    let imported = plain(&text).unwrap();
    assert_eq!(geometry(&imported).sign, [1.0, 1.0, 1.0, 1.0, -1.0, 1.0]);
    assert_eq!(geometry(&imported).offset, [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0]);
}

#[test]
fn lengths_are_rounded_only_where_the_file_is_no_more_exact() {
    let imported = plain(&replaced(EXAMPLE, "0 0 0.4\"", "0 0 0.400123456\"")).unwrap();
    assert!((geometry(&imported).c1 - 0.600_123_456).abs() < 1e-9);
}

#[test]
fn a_flange_beside_axis_6_is_refused_where_it_is_named_and_passed_over_where_not() {
    let text = replaced(
        EXAMPLE,
        "</robot>",
        r#"<link name="side_flange"/><joint name="s" type="fixed"><origin xyz="0.1 0.1 0"/><parent link="link_6"/><child link="side_flange"/></joint></robot>"#,
    );
    assert!(plain(&text).unwrap().notes.join("\n").contains("'tool0'"));
    // Where it is the only one, what was taken instead is not all that is said.
    let only = text.replace("\"flange\"", "\"plate\"").replace("tool0", "tip");
    let notes = plain(&only).unwrap().notes.join("\n");
    assert!(notes.contains("link 'side_flange' stands 100.0 mm beside axis 6 and is taken for no flange"), "{notes}");
    let named = ImportOptions { tip: Some("side_flange".into()), ..ImportOptions::default() };
    let error = import(&text, "x.urdf", &named).unwrap_err();
    assert!(error.to_string().contains("link 'side_flange' stands 100.0 mm beside axis 6"), "{error}");
}

/// The last frame of a description, moved by hand: what is reported is what a robot file cannot say.
#[test]
fn a_flange_a_little_beside_axis_6_is_reported_by_how_much_or_refused() {
    let tool = r#"<origin rpy="0 1.5707963267948966 0"/>"#;
    let beside = |origin: &str| plain(&replaced(EXAMPLE, tool, origin));
    for (origin, metres, degrees, says) in [
        (r#"<origin xyz="0 0.0003 0" rpy="0 1.5707963267948966 0"/>"#, 3e-4, 0.0, "stands 0.300 mm beside axis 6"),
        (
            r#"<origin xyz="0 -0.0003 0.0003" rpy="0 1.5707963267948966 0"/>"#,
            3e-4 * 2_f64.sqrt(),
            0.0,
            "stands 0.424 mm beside axis 6",
        ),
        (
            r#"<origin rpy="0 1.5713963267948966 0"/>"#,
            0.0,
            0.0006_f64.to_degrees(),
            "leans by 0.0344 deg against axis 6",
        ),
    ] {
        let imported = beside(origin).unwrap_or_else(|error| panic!("{error}"));
        // The whole of what stands aside, at every posture, and nothing else.
        assert!((imported.largest_error - metres).abs() < 1e-9, "{origin}: {}", imported.largest_error);
        assert!((imported.largest_turn.to_degrees() - degrees).abs() < 1e-6, "{origin}: {}", imported.largest_turn);
        assert!(imported.notes.iter().any(|note| note.contains(says)), "{:?}", imported.notes);
    }
    let exact = plain(EXAMPLE).unwrap();
    assert!(!exact.notes.iter().any(|note| note.contains("not in the robot file")), "{:?}", exact.notes);
}

#[test]
fn small_differences_that_add_up_to_more_than_half_a_millimetre_are_refused_with_their_causes() {
    let text = replaced(
        EXAMPLE,
        r#"<origin rpy="0 1.5707963267948966 0"/>"#,
        r#"<origin xyz="0 0.0004 0" rpy="0 1.5707963267948966 0"/>"#,
    );
    let text = replaced(&text, r#"<origin xyz="0 0 0.4"/>"#, r#"<origin xyz="0.0004 0 0.4"/>"#);
    let error = plain(&text).unwrap_err();
    let ImportError::Inexact { error_m, causes, .. } = &error else { panic!("{error}") };
    // Both point the same way somewhere: 0.4 + 0.4 mm.
    assert!((error_m - 8e-4).abs() < 1e-6, "{error_m}");
    assert!(causes.iter().any(|cause| cause.contains("0.400 mm beside axis 6")), "{causes:?}");
    assert!(error.to_string().contains("axis 1 stands 0.400 mm beside the origin"), "{error}");
}

#[test]
fn speeds_are_taken_where_every_joint_has_one() {
    for gone in ["", "velocity=\"0\""] {
        let imported = plain(&replaced(EXAMPLE, "velocity=\"2.4435\"", gone)).unwrap();
        let Arm::SixAxis { limits, .. } = &imported.robot.arm else { panic!("six axes") };
        assert_eq!(limits.speeds, None);
        assert!(imported.notes.join("\n").contains("not every joint has a speed"), "{:?}", imported.notes);
    }
}

#[test]
fn soft_limits_are_told_where_they_leave_less() {
    let soft = |least: &str, most: &str| {
        let controller =
            format!(r#"<safety_controller soft_lower_limit="{least}" soft_upper_limit="{most}" k_velocity="1"/>"#);
        let limit = r#"<limit lower="-1.1345" upper="1.4835" effort="0" velocity="1.7453"/>"#;
        plain(&replaced(EXAMPLE, limit, &(limit.to_owned() + &controller))).unwrap().notes.join("\n")
    };
    assert!(
        soft("-1.1345", "0.2").contains("soft limits of safety controllers leave less and are not taken"),
        "{}",
        soft("-1.1345", "0.2")
    );
    assert!(soft("-1.1345", "0.2").contains("joint_2") && !soft("-1.1345", "1.4835").contains("soft limits"));
    assert!(soft("-0.5", "1.4835").contains("soft limits"));
}

#[test]
fn a_true_offset_below_five_millimetres_is_imported() {
    for metres in ["0.0006", "-0.002", "0.0049"] {
        let text = replaced(EXAMPLE, r#"<origin xyz="0.3 0 0.2"/>"#, &format!(r#"<origin xyz="{metres} 0 0.2"/>"#));
        let imported = import(&text, "x.urdf", &ImportOptions::default()).unwrap();
        // Written in mm and read back: a rounding or two.
        assert!((geometry(&imported).a1 - metres.parse::<f64>().unwrap()).abs() < 1e-15, "{}", imported.text);
    }
}
