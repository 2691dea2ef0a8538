//! Are masses and torques taken from a description as they stand, from one macro too, and placeholders refused by name?

use std::fmt::Write;

use nalgebra::{Matrix3, Vector3};
use stiffarm::catalogue::find;
use stiffarm::catalogue::import::{ImportError, ImportOptions, Imported, import, import_enclosed};
use stiffarm::mass::{Carrier, Mass};
use stiffarm::robot::Arm;

const EXAMPLE: &str = include_str!("../../../docs/examples/example_150.urdf");

/// Joint, its parent, xyz m, rpy in xacro's words, limits deg, effort N m: KR 120 R2700-2 of `kroshu/kuka_robot_descriptions` @7766e92afc (facts).
const JOINTS: [(&str, &str, &str, [f64; 2], f64); 6] = [
    ("base_link", "0 0 0.3056", "${-pi} 0 0", [-185.0, 185.0], 7290.0),
    ("link_1", "0.33 0.072 -0.3394", "${pi/2} 0 0", [-140.0, -5.0], 8910.0),
    ("link_2", "1.15 0 -0.103", "0 0 0", [-120.0, 168.0], 7759.4539),
    ("link_3", "0.828 -0.115 0.175", "${pi/2} 0 ${-pi/2}", [-350.0, 350.0], 2462.3921),
    ("link_4", "0 0.096 -0.392", "0 ${radians(90)} ${pi/2}", [-125.0, 125.0], 1491.6988),
    ("link_5", "0.1665 0 -0.096", "${pi/2} 0 ${-radians(90)}", [-350.0, 350.0], 908.4312),
];

/// kg, centre m, inertia kg m^2 along the link's axes, base to link 6; the same source.
const BODIES: [(f64, [f64; 3], [f64; 6]); 7] = [
    (
        225.96,
        [-0.0595, 0.0022, 0.2033],
        [9.034_379_01, 0.181_754_796, -0.268_318_737, 12.822_204_558, 0.009_901_59, 14.282_216_432],
    ),
    (
        363.07,
        [0.0288, 0.0119, -0.234],
        [14.365_455_08, 4.312_590_772, 1.981_794_643, 32.718_817_944, 0.242_162_992, 31.503_526_976],
    ),
    (
        232.06,
        [0.4869, -0.0019, -0.1176],
        [6.259_171_706, -0.519_176_293, 5.665_515_517, 58.471_576_314, -0.182_933_503, 57.257_451_98],
    ),
    (
        181.83,
        [0.1908, -0.0745, 0.1325],
        [3.395_751_272, 1.157_601_593, -1.357_710_958, 20.248_985_252, 0.553_968_446, 19.908_963_476],
    ),
    (
        42.4118,
        [0.0, 0.0192, -0.1979],
        [1.391_599_996, -8.767e-06, 6.5767e-05, 1.343_025_517, 0.159_301_428, 0.182_774_487],
    ),
    (
        16.9917,
        [0.0622, 0.0003, -0.0658],
        [0.153_163_518, 0.000_178_884, 0.039_094_736, 0.220_999_527, -0.000_108_959, 0.167_536_955],
    ),
    (6.6, [0.0, 0.0, -0.0065], [0.0115, 0.0, 0.0, 0.0115, 0.0, 0.0145]),
];

fn inertial(mass: f64, [x, y, z]: [f64; 3], [xx, xy, xz, yy, yz, zz]: [f64; 6]) -> String {
    format!(
        "<inertial><origin xyz=\"{x} {y} {z}\"/><mass value=\"{mass}\"/><inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/></inertial>"
    )
}

/// The arm as its maker writes it: one macro with a prefix.
fn macro_file() -> String {
    let mut text = String::from(
        "<robot xmlns:xacro=\"http://wiki.ros.org/xacro\">\n<xacro:macro name=\"kr_120\" params=\"prefix package_name\">\n",
    );
    for (i, (mass, centre, elements)) in BODIES.into_iter().enumerate() {
        let name = if i == 0 { "base_link".into() } else { format!("link_{i}") };
        let body = inertial(mass, centre, elements);
        writeln!(text, "<link name=\"${{prefix}}{name}\">{body}<visual><xacro:paint/></visual></link>").unwrap();
    }
    for (i, (parent, xyz, rpy, [lower, upper], effort)) in JOINTS.into_iter().enumerate() {
        let n = i + 1;
        writeln!(
            text,
            "<joint name=\"${{prefix}}joint_{n}\" type=\"revolute\"><origin xyz=\"{xyz}\" rpy=\"{rpy}\"/><parent link=\"${{prefix}}{parent}\"/>\
             <child link=\"${{prefix}}link_{n}\"/><axis xyz=\"0 0 1\"/><limit lower=\"${{radians({lower})}}\" upper=\"${{radians({upper})}}\" \
             velocity=\"2\" effort=\"{effort}\"/></joint>"
        )
        .unwrap();
    }
    text + "<link name=\"${prefix}tool0\"/>\n<joint name=\"${prefix}t\" type=\"fixed\"><origin xyz=\"0 0 -0.0485\" rpy=\"${pi} 0 ${pi}\"/>\
            <parent link=\"${prefix}link_6\"/><child link=\"${prefix}tool0\"/></joint>\n</xacro:macro>\n</robot>\n"
}

fn plain(text: &str) -> Result<Imported, ImportError> {
    import(text, "models/mine.urdf", &ImportOptions::default())
}

fn note<'i>(imported: &'i Imported, of: &str) -> &'i str {
    imported.notes.iter().find(|note| note.starts_with(of)).unwrap_or_else(|| panic!("{of}: {:?}", imported.notes))
}

#[test]
fn a_makers_macro_has_the_masses_and_torques_that_the_catalogue_has_by_another_program() {
    let imported = import(&macro_file(), "kr120_macro.xacro", &ImportOptions::default()).unwrap();
    let known = find("KR 120 R2700-2").unwrap().robot();
    assert_eq!(imported.robot.name, "kr_120");
    let (Arm::SixAxis { geometry, drives, .. }, Arm::SixAxis { geometry: of_known, drives: drives_known, .. }) =
        (&imported.robot.arm, &known.arm)
    else {
        panic!("six axes")
    };
    assert!((geometry.c1 - of_known.c1).abs() < 1e-9 && (geometry.c3 - of_known.c3).abs() < 1e-9);
    assert_eq!(imported.robot.masses.len(), 7);
    for (found, known) in imported.robot.masses.iter().zip(&known.masses) {
        assert_eq!(found.carrier, known.carrier);
        assert!((found.body.mass - known.body.mass).abs() < 1e-9);
        // The catalogue turned the frames by angles with four digits: 4e-6 rad over 3 m.
        let off = (found.body.centre - known.body.centre).norm();
        assert!(off < 0.05e-3, "{}: {off} m", found.carrier);
        let [found_inertia, known_inertia] = [found.body.inertia, known.body.inertia];
        let off = (found_inertia - known_inertia).norm() / known_inertia.norm();
        assert!(off < 2e-5, "{}: {off} {found_inertia} {known_inertia}", found.carrier);
    }
    let torque = drives.motors.torque.unwrap();
    for (found, known) in torque.iter().zip(drives_known.motors.torque.unwrap()) {
        assert!((found - known).abs() < 0.006, "{found} {known}");
    }
    assert!(note(&imported, "masses:").contains("of 7 bodies"));
    assert!(imported.text.contains("masses = \"inertials of kr120_macro.xacro\""), "{}", imported.text);
}

#[test]
fn a_fault_of_a_macro_file_is_reported_with_its_own_line() {
    let text = replaced(&macro_file(), "upper=\"${radians(125)}\"", "upper=\"wide\"");
    let Err(ImportError::Faults(faults)) = plain(&text) else { panic!("a word is no limit") };
    let line = text.lines().position(|line| line.contains("wide")).unwrap() + 1;
    assert!(
        faults.faults[0].line == line && faults.faults[0].key == "joint joint_5, limit upper",
        "{faults}; line {line}"
    );
}

fn replaced(text: &str, old: &str, new: &str) -> String {
    assert!(text.contains(old), "'{old}' is not in the text");
    text.replacen(old, new, 1)
}

/// The example, its links with these parts.
fn with(parts: &[(&str, String)]) -> String {
    parts.iter().fold(EXAMPLE.to_owned(), |text, (link, part)| {
        let bare = format!("<link name=\"{link}\"/>");
        assert!(text.contains(&bare), "{link}");
        text.replace(&bare, &format!("<link name=\"{link}\">{part}</link>"))
    })
}

/// A body of this mass at the origin of each link.
fn weights(masses: [f64; 6]) -> Vec<(&'static str, String)> {
    let links = ["link_1", "link_2", "link_3", "link_4", "link_5", "link_6"];
    let part = |mass: f64| inertial(mass, [0.0; 3], [mass / 10.0, 0.0, 0.0, mass / 10.0, 0.0, mass / 10.0]);
    links.into_iter().zip(masses.map(part)).collect()
}

const USUAL: [f64; 6] = [300.0, 200.0, 150.0, 40.0, 15.0, 6.0];

fn of(robot: &Imported, carrier: Carrier) -> Mass {
    *robot.robot.masses.iter().find(|mass| mass.carrier == carrier).unwrap()
}

#[test]
fn what_is_fixed_to_a_link_weighs_with_it() {
    let mut parts = weights(USUAL);
    let ten = "<inertial><origin xyz=\"0.1 0 0\" rpy=\"0 0 1.5707963267948966\"/><mass value=\"2\"/>\
               <inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.2\" iyz=\"0\" izz=\"0.25\"/></inertial>";
    parts.push(("tool0", ten.into()));
    let imported = plain(&with(&parts)).unwrap();
    let alone = plain(&with(&weights(USUAL))).unwrap();
    let Arm::SixAxis { geometry, .. } = &imported.robot.arm else { panic!("six axes") };
    let (whole, link) = (of(&imported, Carrier::Link(6)).body, of(&alone, Carrier::Link(6)).body);
    assert_eq!(whole.mass, 8.0);
    // Where the body of the flange stands at model zero: 0.1 m along the x axis of tool0, its inertia turned by 90 deg about z, so that x and y change.
    let flange = geometry.forward(&[0.0; 6]);
    let [z, x] = [Vector3::z(), Vector3::x()].map(|axis| flange.rotation * axis);
    let tool_z = Vector3::z();
    assert!((z - tool_z).norm() < 1e-9, "at model zero the flange looks up: {z}");
    let second = (whole.centre * 8.0 - link.centre * 6.0) / 2.0;
    let from_flange = second - flange.translation.vector;
    assert!((from_flange.norm() - 0.1).abs() < 2e-6 && from_flange.dot(&z).abs() < 2e-6, "{from_flange} {x}");
    // Steiner, by hand: both about the common centre.
    let along = from_flange / 0.1;
    let across = z.cross(&along);
    let own = along * along.transpose() * 0.2 + across * across.transpose() * 0.1 + z * z.transpose() * 0.25;
    let about = |mass: f64, d: Vector3<f64>| (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * mass;
    let expected = link.inertia + about(6.0, link.centre - whole.centre) + own + about(2.0, second - whole.centre);
    assert!((whole.inertia - expected).norm() < 1e-6, "{} {expected}", whole.inertia);
    assert_eq!(note(&imported, "masses: counted"), "masses: counted where they hang: 'tool0' of 2 kg with link 6");
    // The base has none, and no link of the arm is without.
    assert_eq!(imported.robot.masses.len(), 6);
}

#[test]
fn without_inertials_nothing_is_taken_and_nothing_said() {
    let imported = plain(EXAMPLE).unwrap();
    assert!(imported.robot.masses.is_empty() && !imported.text.contains("drives"));
    assert!(
        !imported.notes.iter().any(|note| note.contains("mass") || note.contains("torque")),
        "{:?}",
        imported.notes
    );
}

/// The usual masses, and a counterweight that turns against joint 2.
fn follower() -> String {
    let body = inertial(400.0, [0.0; 3], [40.0, 0.0, 0.0, 40.0, 0.0, 40.0]);
    let joint = "<joint name=\"w\" type=\"continuous\"><parent link=\"link_1\"/><child link=\"arm\"/><axis xyz=\"0 1 0\"/>\
                 <mimic joint=\"joint_2\" multiplier=\"-1\"/></joint><joint name=\"f\" type=\"fixed\"><parent link=\"arm\"/><child link=\"counterweight\"/></joint>";
    let end = format!("<link name=\"arm\"/><link name=\"counterweight\">{body}</link>{joint}</robot>");
    replaced(&with(&weights(USUAL)), "</robot>", &end)
}

#[test]
fn placeholders_and_centres_where_no_body_is_are_refused_by_the_name_of_the_link() {
    let weight = |link: usize, mass: f64| {
        let mut masses = USUAL;
        masses[link - 1] = mass;
        with(&weights(masses))
    };
    let mut lacking = weights(USUAL);
    lacking.remove(3);
    let mut flat = weights(USUAL);
    flat[4].1 = inertial(15.0, [0.0; 3], [1.0, 0.0, 0.0, 1.0, 0.0, 5.0]);
    let mut small = weights(USUAL);
    small[2].1 = inertial(150.0, [0.0; 3], [1e-6, 0.0, 0.0, 1e-6, 0.0, 1e-6]);
    let mut aside = weights(USUAL);
    aside[2].1 = inertial(150.0, [0.0, 0.9, 0.0], [15.0, 0.0, 0.0, 15.0, 0.0, 15.0]);
    for (text, expected) in [
        (weight(4, 1e-6), "link 'link_4' weighs 0.000001 kg, a placeholder"),
        (weight(2, 0.0), "link 'link_2', which joint joint_2 turns, has no mass"),
        (with(&weights([1.0; 6])), "all moving links weigh 1 kg, a placeholder"),
        (weight(1, 30_000.0), "together they weigh 30411 kg"),
        (with(&small), "link 'link_3': 0.000001 kg m2 at most beside 150 kg is a radius of gyration"),
        (follower(), "link 'counterweight' weighs 400 kg and follows a joint"),
        (with(&lacking), "link 'link_4', which joint joint_4 turns, has no mass"),
        (with(&flat), "link 'link_5': no body has this inertia"),
        (with(&aside), "the mass centre of link 'link_3' lies 900 mm off the line of the link 3"),
    ] {
        let imported = plain(&text).unwrap();
        let note = note(&imported, "masses: none is taken: ");
        assert!(note.contains(expected), "{note}; expected {expected}");
        assert!(imported.robot.masses.is_empty() && !imported.text.contains("masses"));
    }
}

#[test]
fn a_mass_centre_outside_its_mesh_is_refused_where_meshes_are_looked_at() {
    let body = |size: &str| format!("<collision><geometry><box size=\"{size}\"/></geometry></collision>");
    let parts = |z: f64| {
        let mut parts = weights(USUAL);
        parts[1].1 = inertial(200.0, [0.0, 0.0, z], [20.0, 0.0, 0.0, 20.0, 0.0, 20.0]);
        for (link, part) in &mut parts {
            part.push_str(&body(if *link == "link_2" { "0.3 0.3 1.0" } else { "0.4 0.4 0.4" }));
        }
        parts.push(("base_link", body("0.5 0.5 0.5")));
        with(&parts)
    };
    let none = |_: &str| Err("there is no mesh".into());
    let enclosed = |z: f64| import_enclosed(&parts(z), "arm.urdf", &ImportOptions::default(), &none).unwrap();
    // The box ends 0.5 m above the link's origin: 20 mm more are as published ones are, 60 are not.
    assert_eq!(note(&enclosed(0.52), "masses:"), "masses: of 6 bodies, from the inertials");
    assert!(
        note(&enclosed(0.56), "masses:")
            .ends_with("the mass centre of link 'link_2' lies 60 mm outside the box about its meshes")
    );
    assert!(note(&plain(&parts(0.56)).unwrap(), "masses:").contains("not compared with the meshes (--meshes)"));
}

#[test]
fn faulty_inertials_are_refused_with_line_link_value_and_what_was_expected() {
    for (part, key, expected) in [
        (
            "<inertial><mass value=\"-3\"/>INERTIA</inertial>",
            "link link_2, inertial mass value",
            "-3 kg; expected 0 or more",
        ),
        ("<inertial><mass value=\"3 kg\"/>INERTIA</inertial>", "link link_2, inertial mass value", "'3 kg'; expected"),
        ("<inertial><mass value=\"nan\"/>INERTIA</inertial>", "link link_2, inertial mass value", "'nan'; expected"),
        (
            "<inertial><mass value=\"1e9\"/>INERTIA</inertial>",
            "link link_2, inertial mass value",
            "from -50000 to 50000, in kg",
        ),
        ("<inertial>INERTIA</inertial>", "link link_2, inertial mass value", "missing; expected kg"),
        ("<inertial><mass value=\"3\"/></inertial>", "link link_2, inertial inertia ixx", "missing; expected kg m2"),
        (
            "<inertial><origin xyz=\"0 0\"/><mass value=\"3\"/>INERTIA</inertial>",
            "link link_2, origin xyz",
            "expected three, in m",
        ),
    ] {
        let inertia = "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>";
        let text = with(&[("link_2", part.replace("INERTIA", inertia))]);
        let Err(ImportError::Faults(faults)) = plain(&text) else { panic!("{part}") };
        let fault = faults.faults.iter().find(|fault| fault.key == key).unwrap_or_else(|| panic!("{faults}"));
        let line = text.lines().position(|line| line.contains("<inertial>")).unwrap() + 1;
        assert!(fault.line == line && fault.message.contains(expected), "{faults}; expected {expected}");
    }
}

#[test]
fn torques_are_taken_where_every_joint_has_its_own() {
    let text = |efforts: [&str; 6]| {
        let open = EXAMPLE.replace("effort=\"0\"", "effort=\"?\"");
        efforts.iter().fold(open, |text, effort| replaced(&text, "effort=\"?\"", &format!("effort=\"{effort}\"")))
    };
    let torque = |imported: &Imported| {
        let Arm::SixAxis { drives, .. } = &imported.robot.arm else { panic!("six axes") };
        drives.motors.torque
    };
    let imported = plain(&text(["5000", "6000", "4000", "900", "800", "500"])).unwrap();
    assert_eq!(torque(&imported), Some([5000.0, 6000.0, 4000.0, 900.0, 800.0, 500.0]));
    for (efforts, expected) in [
        (["100"; 6], "all joints have 100 N m, a placeholder"),
        (["5000", "6000", "4000", "900", "0", "500"], "joint joint_5 has 0e0 N m; expected 0.1 to 1000000 N m"),
        (["5000", "6000", "4000", "900", "1e300", "500"], "joint joint_5 has 1e300 N m; expected"),
    ] {
        let imported = plain(&text(efforts)).unwrap();
        assert!(torque(&imported).is_none() && note(&imported, "torques: none is taken: ").contains(expected));
    }
}
