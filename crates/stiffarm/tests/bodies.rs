//! Do capsules enclose what a description says of the links, wherever the arm stands, and is what no file can say refused?

use nalgebra::{Point3, Rotation3, Vector3};
use stiffarm::body::{Capsule, Enclosing};
use stiffarm::catalogue::import::{ImportError, ImportOptions, Imported, import_enclosed};
use stiffarm::catalogue::{find, read, write};
use stiffarm::robot::{Arm, Robot};

const EXAMPLE: &str = include_str!("../../../docs/examples/example_150.urdf");

fn boxed(size: &str, at: &str) -> String {
    format!("<collision><origin xyz=\"{at}\"/><geometry><box size=\"{size}\"/></geometry></collision>")
}

/// The example, its links with these bodies.
fn with(bodies: &[(&str, String)]) -> String {
    bodies.iter().fold(EXAMPLE.to_owned(), |text, (link, body)| {
        let bare = format!("<link name=\"{link}\"/>");
        assert!(text.contains(&bare), "{link}");
        text.replace(&bare, &format!("<link name=\"{link}\">{body}</link>"))
    })
}

fn usual() -> Vec<(&'static str, String)> {
    let mesh = "<collision><geometry><mesh filename=\"package://arm/fore.stl\" scale=\"0.001 -0.001 0.001\"/></geometry></collision>";
    let round = "<collision><geometry><cylinder radius=\"0.05\" length=\"0.1\"/></geometry></collision>";
    vec![
        ("base_link", boxed("0.6 0.5 0.4", "0 0 0.2")),
        ("link_1", boxed("0.5 0.4 0.4", "0.1 0 0.1")),
        ("link_2", boxed("0.2 0.3 1.2", "0 0.1 0.5")),
        ("link_3", mesh.into()),
        ("link_4", boxed("0.5 0.2 0.2", "0.3 0 0")),
        ("link_5", boxed("0.1 0.1 0.1", "0 0 0")),
        ("tool0", round.into()),
    ]
}

/// A block in mm, binary: 0..600 along x, 0..200 along y, 0..100 along z.
fn block() -> Vec<u8> {
    let corner = |i: usize| [[0.0, 600.0][i & 1], [0.0, 200.0][i >> 1 & 1], [0.0, 100.0_f32][i >> 2]];
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut bytes = vec![b' '; 80];
    bytes.extend(12_u32.to_le_bytes());
    for [a, b, c, d] in faces {
        for triangle in [[a, b, c], [a, c, d]] {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flat_map(|&i| corner(i)).flat_map(f32::to_le_bytes));
            bytes.extend([0; 2]);
        }
    }
    bytes
}

fn imported(text: &str) -> Result<Imported, ImportError> {
    let meshes = |name: &str| {
        assert_eq!(name, "package://arm/fore.stl");
        Ok(block())
    };
    import_enclosed(text, "arm.urdf", &ImportOptions::default(), &meshes)
}

/// The depth of a point in the capsules of a link at joint angles as reported, m; negative outside.
fn depth(robot: &Robot, link: usize, q: &[f64; 6], point: &Vector3<f64>) -> f64 {
    let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { panic!("six axes") };
    let moved = geometry.links(&geometry.model_angles(q, limits.third_axis))[link - 1];
    let depth = |capsule: &Capsule| {
        let [from, to] = capsule.ends.map(|end| (moved * Point3::from(end)).coords);
        let along = to - from;
        let share = ((point - from).dot(&along) / along.norm_squared().max(1e-30)).clamp(0.0, 1.0);
        capsule.radius - (point - from - along * share).norm()
    };
    robot.enclosing.as_ref().unwrap().links[link].iter().map(depth).fold(f64::NEG_INFINITY, f64::max)
}

/// Points on the bodies, moved by hand: the example turns about z, then about y at the shoulder and at the elbow.
#[test]
fn capsules_hold_every_point_of_the_bodies_in_every_posture() {
    let found = imported(&with(&usual())).unwrap();
    let robot = read(&found.text, "mine.toml").unwrap();
    assert!(robot == found.robot && robot.source["body"].contains("arm.urdf"), "{:?}", robot.source);
    let mut rng = fastrand::Rng::with_seed(3);
    let (mut outside, mut deepest) = (0, 0.0_f64);
    for _ in 0..400 {
        let q: [f64; 6] = std::array::from_fn(|_| 2.0 * rng.f64() - 1.0);
        let about = |axis: Vector3<f64>, angle: f64| Rotation3::new(axis * angle);
        let (turn, lean, bend) = (about(Vector3::z(), q[0]), about(Vector3::y(), q[1]), about(Vector3::y(), q[2]));
        let shoulder = Vector3::new(0.3, 0.0, 0.6);
        // On a face of the box of link 2, 0.2 x 0.3 x 1.2 about 0, 0.1, 0.5; on one of the block of link 3, which is mirrored.
        let mut on_face = |low: [f64; 3], high: [f64; 3]| {
            let mut point = Vector3::from_fn(|i, _| low[i] + (high[i] - low[i]) * rng.f64());
            let axis = rng.usize(0..3);
            point[axis] = if rng.bool() { low[axis] } else { high[axis] };
            point
        };
        let on_upper = on_face([-0.1, -0.05, -0.1], [0.1, 0.25, 1.1]);
        let on_fore = on_face([0.0, -0.2, 0.0], [0.6, 0.0, 0.1]);
        let upper = turn * (shoulder + lean * on_upper);
        let fore = turn * (shoulder + lean * (Vector3::z() + bend * on_fore));
        for (link, point) in [(2, upper), (3, fore)] {
            let found = depth(&robot, link, &q, &point);
            assert!(-1e-9 < found, "link {link}: {found} at {q:?}");
            deepest = deepest.max(found);
            // The other link stands elsewhere.
            outside += usize::from(depth(&robot, 5 - link, &q, &point) < 0.0);
        }
    }
    assert!(500 < outside && deepest < 0.2, "{outside} {deepest}");
}

#[test]
fn what_hangs_on_the_flange_moves_with_link_6_and_what_follows_a_joint_is_named() {
    let rod = "<link name=\"rod\"><collision><geometry><sphere radius=\"0.1\"/></geometry></collision></link><joint name=\"rod_joint\" type=\"revolute\"><parent link=\"link_1\"/><child link=\"rod\"/><axis xyz=\"0 1 0\"/><mimic joint=\"joint_2\"/></joint></robot>";
    let found = imported(&with(&usual()).replace("</robot>", rod)).unwrap();
    let Enclosing { links, .. } = found.robot.enclosing.as_ref().unwrap();
    let counts = links.each_ref().map(Vec::len);
    assert!(counts.iter().all(|count| *count <= 6) && counts.iter().all(|count| 0 < *count), "{counts:?}");
    // 0.6 m to the shoulder, 1.0 and 1.1 m of the links, 0.2 m to the flange.
    let flange = links[6][0].ends[0].z;
    assert!((2.7..3.0).contains(&flange), "{flange}");
    assert!(found.notes.iter().any(|note| note.contains("'rod' follows a joint")), "{:?}", found.notes);
    assert!(found.notes.iter().any(|note| note.contains("enclose the collision meshes")), "{:?}", found.notes);
}

/// An offset of the wrist that is taken for none.
#[test]
fn capsules_grow_by_what_the_file_moves_otherwise() {
    let text = with(&usual());
    let aside = text.replacen("<origin xyz=\"0.6 0 0\"/>", "<origin xyz=\"0.6 0.0004 0\"/>", 1);
    assert!(aside != text);
    let [found, plain] = [aside, text].map(|text| imported(&text).unwrap());
    let radii = |imported: &Imported| {
        let links = &imported.robot.enclosing.as_ref().unwrap().links;
        links.each_ref().map(|capsules| capsules.iter().map(|one| one.radius).fold(0.0, f64::max))
    };
    let (grown, as_it_is) = (radii(&found), radii(&plain));
    // Axis 6 stands 0.4 mm aside of where the file has it, and joint 6 turns link 6 to either side; joint 5 turns about the line along which it is moved.
    let grown: Vec<f64> = grown.iter().zip(as_it_is).map(|(grown, as_it_is)| grown - as_it_is).collect();
    assert!((6e-4..1e-3).contains(&grown[6]) && grown[..6].iter().all(|by| by.abs() < 2e-4), "{grown:?}");
    assert!(found.notes.iter().any(|note| note.contains("radii are up to 0.")), "{:?}", found.notes);
}

#[test]
fn bodies_that_cannot_be_read_are_refused_with_the_link_and_what_was_expected() {
    let of = |body: &str, mesh: Result<Vec<u8>, String>| {
        let others = usual().into_iter().filter(|(link, _)| !["link_2", "link_3"].contains(link));
        let others = others.chain([("link_3", boxed("0.2 0.2 0.2", "0 0 0")), ("link_2", body.to_owned())]);
        let text = with(&others.collect::<Vec<_>>());
        let meshes = |_: &str| mesh.clone();
        import_enclosed(&text, "arm.urdf", &ImportOptions::default(), &meshes).unwrap_err().to_string()
    };
    let mesh = |scale: &str| {
        format!("<collision><geometry><mesh filename=\"m.stl\" scale=\"{scale}\"/></geometry></collision>")
    };
    for (body, bytes, words) in [
        (mesh("1 1 1"), Ok(block()), "is 600 m wide"),
        (mesh("0.02 0.02 0.02"), Ok(block()), "is 12.0 m wide, the arm reaches"),
        (mesh("1 0 1"), Ok(block()), "has a zero"),
        (mesh("1 1"), Ok(block()), "mesh scale '1 1'; expected 3 numbers"),
        (mesh("1 1 1"), Err("there is no such file".into()), "mesh 'm.stl': there is no such file"),
        (mesh("1 1 1"), Ok(b"<?xml version=\"1.0\"?><COLLADA/>".to_vec()), "XML, such as COLLADA"),
        (mesh("1 1 1"), Ok(b"version https://git-lfs.github.com/spec/v1".to_vec()), "Git LFS"),
        (mesh("1 1 1"), Ok(Vec::new()), "empty"),
        ("<collision/>".into(), Ok(block()), "has no geometry"),
        ("<collision><geometry><cone/></geometry></collision>".into(), Ok(block()), "<cone> is no body"),
        ("<collision><geometry><box size=\"1 x 1\"/></geometry></collision>".into(), Ok(block()), "box size '1 x 1'"),
        ("<collision><geometry><sphere/></geometry></collision>".into(), Ok(block()), "sphere radius is missing"),
    ] {
        let message = of(&body, bytes);
        assert!(message.contains(words) && message.starts_with("arm.urdf: link "), "{body}: {message}");
    }
    // An arm of which a link has none is not enclosed.
    let bare: Vec<_> = usual().into_iter().filter(|(link, _)| *link != "link_4").collect();
    let message = imported(&with(&bare)).unwrap_err().to_string();
    assert!(message.contains("link 4 of the arm: has no collision body"), "{message}");
    // Without a body anywhere nothing is.
    let none = imported(EXAMPLE).unwrap_err().to_string();
    assert!(none.contains("0.0 mm wide"), "{none}");
}

/// A robot whose links are enclosed by a ball each.
fn enclosed() -> Robot {
    let mut robot = find("KR 210 R2700 extra").unwrap().robot();
    let Arm::SixAxis { geometry, .. } = &robot.arm else { panic!("six axes") };
    let [_, shoulder, elbow, wrist, flange] = geometry.points(&[0.0; 6]).map(Vector3::from);
    let ball = |at: Vector3<f64>| vec![Capsule { ends: [at, at + Vector3::new(0.0, 0.0, 0.012_345)], radius: 0.2 }];
    let links = [Vector3::new(0.0, 0.0, 0.2), shoulder, elbow, elbow, wrist, wrist, flange].map(ball);
    robot.enclosing = Some(Enclosing { links, not_compared: vec![[0, 2], [1, 3]] });
    robot
}

#[test]
fn a_robot_file_keeps_what_was_given_of_bodies() {
    // Decimals of a millimetre first: of any metres the last bit may be the one beside it.
    let robot = read(&write(&enclosed()), "mine.toml").unwrap();
    let text = write(&robot);
    assert_eq!(read(&text, "mine.toml").unwrap(), robot, "{text}");
    let ends = |robot: &Robot| {
        let Enclosing { links, not_compared } = robot.enclosing.clone().unwrap();
        (links.concat().iter().flat_map(|capsule| capsule.ends).collect::<Vec<_>>(), not_compared)
    };
    let ((found, pairs), (given, expected)) = (ends(&robot), ends(&enclosed()));
    assert!(found.iter().zip(&given).all(|(a, b)| (a - b).norm() < 1e-12) && found.len() == given.len());
    assert_eq!(pairs, expected);
    let mut bare = robot;
    bare.enclosing = None;
    assert_eq!(read(&write(&bare), "mine.toml").unwrap(), bare);
}

#[test]
fn bodies_that_no_file_can_have_are_refused_with_key_value_and_what_was_expected() {
    let text = write(&enclosed());
    let said = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}: {text}");
        read(&text.replacen(from, to, 1), "mine.toml").unwrap_err().to_string()
    };
    let first = "link = 0\ncapsules_mm = [[0, 0, 200, 0, 0, 212.345, 200]]";
    for (from, to, words) in [
        ("link = 6", "link = 7", "body.link.link: 7 (a link from 0 to 6); expected 0 to 6"),
        ("link = 6", "link = 5", "5 is there twice"),
        ("link = 6", "link = 5.5", "5.5; expected a link"),
        (first, "link = 0\ncapsules_mm = [[0, 0, 200, 0, 0, 212.345]]", "6 values; expected 7"),
        (first, "link = 0\ncapsules_mm = 3", "expected lists of 7 numbers"),
        (first, "link = 0\ncapsules_mm = [[0, 0, 200, 0, 0, 212, -1]]", "-1 mm; expected 0.1 to"),
        (first, "link = 0\ncapsules_mm = [[0, 0, nan, 0, 0, 212, 3]]", "NaN"),
        (first, "link = 0\nradius_mm = 3", "capsules_mm: missing"),
        (first, "link = 0\ncapsules_mm = [[0, 0, 2200, 0, 0, 2212, 200]]", "off the line of link 0"),
        ("[[0, 2], [1, 3]]", "[[2, 0]]", "[2, 0]; expected two links"),
        ("[[0, 2], [1, 3]]", "[[0, 9]]", "expected 0 to 6"),
    ] {
        let message = said(from, to);
        assert!(message.contains(words) && message.contains("mine.toml:"), "{to}: {message}");
    }
    let without = text.replacen(&format!("\n[[body.link]]\n{first}\n"), "", 1);
    let message = read(&without, "mine.toml").unwrap_err().to_string();
    assert!(message.contains("capsules of link 0 are missing"), "{message}");
    let bare = write(&find("KR 210 R2700 extra").unwrap().robot())
        + "\n[body]\nnot_compared = [[0, 2]]\nradius_mm = [400, 200, 150, 100]\n";
    assert!(read(&bare, "mine.toml").unwrap_err().to_string().contains("expected [[body.link]] beside it"));
}

/// Boxes about the meshes, in their own frames and by the joint frames of the description: neither a mesh nor the import has a part in them.
#[test]
fn the_capsules_of_published_arms_hold_the_boxes_about_their_meshes() {
    let text = include_str!("../../../validation/link_boxes.csv");
    let (mut links, mut wider) = (0, 0.0);
    for row in text.lines().skip(2) {
        let [name, link, numbers @ ..] = &row.split(',').collect::<Vec<_>>()[..] else { panic!("{row}") };
        let numbers: Vec<f64> = numbers.iter().map(|number| number.parse::<f64>().unwrap() / 1e3).collect();
        let robot = find(name).unwrap_or_else(|| panic!("{name}")).robot();
        let capsules =
            &robot.enclosing.as_ref().unwrap_or_else(|| panic!("{name}")).links[link.parse::<usize>().unwrap()];
        for axis in 0..3 {
            let ends = || capsules.iter().flat_map(|one| one.ends.map(|end| (end[axis], one.radius)));
            let low = ends().map(|(at, radius)| at - radius).fold(f64::INFINITY, f64::min);
            let high = ends().map(|(at, radius)| at + radius).fold(f64::NEG_INFINITY, f64::max);
            // Those of KUKA arms are given to a millimetre.
            let (under, over) = (numbers[axis] - low, high - numbers[3 + axis]);
            assert!(-1e-3 < under && -1e-3 < over, "{name}, link {link}: {under} {over}");
            assert!(under < 0.36 && over < 0.36, "{name}, link {link}: {under} {over}");
            wider += (under + over) / 6.0;
        }
        links += 1;
    }
    assert!(links == 805 && wider / f64::from(links) < 0.035, "{links} {}", wider / f64::from(links));
}
