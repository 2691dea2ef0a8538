//! Is a robot file that counts joints otherwise than the pendant found out, and does one that counts so become verified?
//!
//! Readings are made by an arm whose way of counting is known, in the numbers that each maker's pendant shows: the formulas here
//! take angles out of rotation matrices, those of the library make rotations of angles.

use std::fmt::Write;

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use stiffarm::catalogue::find;
use stiffarm::catalogue::readings::{Notation, ReadOptions, Readings, read};
use stiffarm::geometry::Geometry;
use stiffarm::limits::{Limits, Pendant, ThirdAxis};
use stiffarm::robot::{Arm, Robot};
use stiffarm::verify::{Verification, VerifyError, VerifyOptions, rank, verify};
use stiffarm::watch::Watch;

/// Postures as one drives to them at the pendant: every joint moves, by whole degrees.
const POSTURES: [[f64; 6]; 7] = [
    [0.0, -90.0, 90.0, 0.0, 45.0, 0.0],
    [30.0, -70.0, 80.0, 40.0, 60.0, 10.0],
    [-40.0, -110.0, 100.0, -60.0, 30.0, 80.0],
    [15.0, -60.0, 60.0, 90.0, -50.0, -45.0],
    [-20.0, -80.0, 110.0, 20.0, -70.0, 120.0],
    [60.0, -100.0, 70.0, -30.0, 80.0, -100.0],
    [-75.0, -65.0, 95.0, 110.0, 40.0, 60.0],
];

fn parts(robot: &Robot) -> (Geometry, Limits) {
    match &robot.arm {
        Arm::SixAxis { geometry, limits, .. } => (geometry.clone(), limits.clone()),
        Arm::Planar(_) => panic!("six axes"),
    }
}

fn with(robot: &Robot, change: impl Fn(&mut Geometry, &mut Limits)) -> Robot {
    let mut changed = robot.clone();
    if let Arm::SixAxis { geometry, limits, .. } = &mut changed.arm {
        change(geometry, limits);
    }
    changed
}

fn kuka() -> Robot {
    find("KR 210 R2700 extra").unwrap().robot()
}

/// Base and tool as a controller may have them in force.
fn frames() -> (Isometry3<f64>, Isometry3<f64>) {
    let turn = |x, y, z| UnitQuaternion::new(Vector3::new(x, y, z));
    (
        Isometry3::from_parts(Translation3::new(0.4, -1.2, 0.1), turn(0.0, 0.0, 0.7)),
        Isometry3::from_parts(Translation3::new(0.03, -0.02, 0.21), turn(0.0, 1.1, 0.3)),
    )
}

fn flange(robot: &Robot, q: &[f64; 6]) -> Isometry3<f64> {
    let (geometry, limits) = parts(robot);
    geometry.forward(&geometry.model_angles(q, limits.third_axis))
}

/// What a pendant shows of a rotation: `R = Rz Ry Rx` as `[z, y, x]`, deg.
fn zyx(r: &Matrix3<f64>) -> [f64; 3] {
    let y = (-r[(2, 0)]).asin();
    [r[(1, 0)].atan2(r[(0, 0)]), y, r[(2, 1)].atan2(r[(2, 2)])].map(f64::to_degrees)
}

/// Headings and numbers of an orientation.
fn shown(notation: Notation, r: &Matrix3<f64>) -> (&'static str, Vec<f64>) {
    let [z, y, x] = zyx(r);
    match notation {
        Notation::Abc => ("a_deg,b_deg,c_deg", vec![z, y, x]),
        Notation::Wpr => ("w_deg,p_deg,r_deg", vec![x, y, z]),
        Notation::FixedXyz => ("rx_deg,ry_deg,rz_deg", vec![x, y, z]),
        // R = Rx Ry Rz: its first row is (cy cz, -cy sz, sy), its last column (sy, -sx cy, cx cy).
        Notation::TurnedXyz => {
            let [x, y, z] = [(-r[(1, 2)]).atan2(r[(2, 2)]), r[(0, 2)].asin(), (-r[(0, 1)]).atan2(r[(0, 0)])];
            ("rx_deg,ry_deg,rz_deg", [x, y, z].map(f64::to_degrees).to_vec())
        }
        // R = Rz(o) Ry(a) Rz(t): its last column is (co sa, so sa, ca), its last row (-sa ct, sa st, ca).
        Notation::Oat => {
            let [o, a, t] = [r[(1, 2)].atan2(r[(0, 2)]), r[(2, 2)].acos(), r[(2, 1)].atan2(-r[(2, 0)])];
            ("o_deg,a_deg,t_deg", [o, a, t].map(f64::to_degrees).to_vec())
        }
        Notation::Quaternion => {
            // Shepperd: the largest of the four squares is taken by its root.
            let trace = r.trace();
            let w = (1.0 + trace).max(0.0).sqrt() / 2.0;
            if 0.1 < w {
                let v = [r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]].map(|x| x / (4.0 * w));
                return ("q1,q2,q3,q4", vec![w, v[0], v[1], v[2]]);
            }
            let i = (0..3).max_by(|&a, &b| r[(a, a)].total_cmp(&r[(b, b)])).unwrap();
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let root = (1.0 + r[(i, i)] - r[(j, j)] - r[(k, k)]).sqrt() / 2.0;
            let mut q = vec![(r[(k, j)] - r[(j, k)]) / (4.0 * root), 0.0, 0.0, 0.0];
            q[1 + i] = root;
            q[1 + j] = (r[(i, j)] + r[(j, i)]) / (4.0 * root);
            q[1 + k] = (r[(i, k)] + r[(k, i)]) / (4.0 * root);
            ("q1,q2,q3,q4", q)
        }
    }
}

/// The table that a controller of this robot shows, with the digits of a pendant.
fn table(robot: &Robot, postures: &[[f64; 6]], notation: Option<Notation>) -> String {
    table_in(frames(), robot, postures, notation)
}

/// The same in a base and with a tool.
fn table_in(
    (base, tool): (Isometry3<f64>, Isometry3<f64>),
    robot: &Robot,
    postures: &[[f64; 6]],
    notation: Option<Notation>,
) -> String {
    let mut text =
        String::from("joint_1_deg,joint_2_deg,joint_3_deg,joint_4_deg,joint_5_deg,joint_6_deg,x_mm,y_mm,z_mm");
    for (i, q) in postures.iter().enumerate() {
        let pose = base * flange(robot, &q.map(f64::to_radians)) * tool;
        let turn: Rotation3<f64> = pose.rotation.to_rotation_matrix();
        let angles = notation.map(|notation| shown(notation, turn.matrix()));
        if let Some((headings, _)) = angles.as_ref().filter(|_| i == 0) {
            write!(text, ",{headings}").unwrap();
        }
        let joints = q.map(|x| format!("{x}")).join(",");
        let at = pose.translation.vector * 1e3;
        write!(text, "\n{joints},{:.3},{:.3},{:.3}", at.x, at.y, at.z).unwrap();
        for number in angles.into_iter().flat_map(|(_, numbers)| numbers) {
            write!(text, ",{number:.5}").unwrap();
        }
    }
    text + "\n"
}

fn readings(text: &str, vendor: &str) -> Readings {
    let options = ReadOptions { vendor: vendor.into(), ..ReadOptions::default() };
    read(text, "readings.csv", &options).unwrap_or_else(|faults| panic!("{faults}\n{text}"))
}

fn asked(robot: &Robot, readings: &Readings) -> Verification {
    verify(robot, readings, &VerifyOptions::default(), &[], Watch::nobody()).unwrap()
}

#[test]
fn what_the_pendant_shows_of_a_file_that_counts_as_it_is_verified_in_every_makers_angles() {
    let robot = kuka();
    let all =
        [Notation::Abc, Notation::Wpr, Notation::Quaternion, Notation::TurnedXyz, Notation::FixedXyz, Notation::Oat];
    for notation in all.into_iter().map(Some).chain([None]) {
        let vendor = if notation == Some(Notation::TurnedXyz) { "Staubli" } else { "any" };
        let found = asked(&robot, &readings(&table(&robot, &POSTURES, notation), vendor));
        assert!(found.verified, "{notation:?}: {:?} {:?}", found.as_file, found.alike);
        // Three decimals of a mm are shown: half of the last in each coordinate.
        assert!(found.as_file.largest < 1e-6, "{notation:?}: {}", found.as_file.largest);
        let (base, tool) = frames();
        let [at, seen] = [base, found.as_file.bases[0]].map(|pose| pose.translation.vector);
        assert!((at - seen).norm() < 5e-6, "the base of the controller is found: {seen}");
        assert!((found.as_file.points[0] - tool.translation.vector).norm() < 5e-6);
        let (written, _) = found.robot_file("2026-05-31").unwrap();
        let text = stiffarm::catalogue::write(&written);
        let back = stiffarm::catalogue::read(&text, "mine.toml").unwrap();
        assert!(matches!(back.pendant(), Some(Pendant::Verified(verified)) if verified.rows == 7), "{text}");
    }
}

/// Each fault of a file that a person may make, with the robot as it is.
fn faults() -> Vec<(&'static str, Robot)> {
    let file = kuka();
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut all: Vec<(&'static str, Robot)> = Vec::new();
    let signs = ["sign 1", "sign 2", "sign 3", "sign 4", "sign 5", "sign 6"];
    for (i, what) in signs.into_iter().enumerate() {
        all.push((what, with(&file, |geometry, _| geometry.sign[i] = -geometry.sign[i])));
    }
    for (what, i, angle) in [
        ("zero 2 by a quarter", 1, quarter),
        ("zero 3 by a quarter back", 2, -quarter),
        ("zero 5 by a quarter", 4, quarter),
        ("zero 2 by two quarters", 1, 2.0 * quarter),
        ("zero 4 by three degrees", 3, 3_f64.to_radians()),
        ("zero 3 by half a degree", 2, -0.5_f64.to_radians()),
        ("zero 2 by a tenth of a degree", 1, 0.1_f64.to_radians()),
    ] {
        all.push((what, with(&file, |geometry, _| geometry.offset[i] += angle)));
    }
    all.push(("joint 3 from the horizontal", with(&file, |_, limits| limits.third_axis = ThirdAxis::Forearm)));
    all.push((
        "three at once",
        with(&file, |geometry, limits| {
            limits.third_axis = ThirdAxis::Forearm;
            geometry.sign[2] = -geometry.sign[2];
            geometry.offset[1] += quarter;
        }),
    ));
    all
}

#[test]
fn every_wrong_way_of_counting_is_found_and_what_is_written_then_is_verified() {
    let file = kuka();
    for (what, robot) in faults() {
        for notation in [Some(Notation::Abc), None] {
            let readings = readings(&table(&robot, &POSTURES, notation), "KUKA");
            let found = asked(&file, &readings);
            assert!(!found.verified, "{what}");
            let Some((mine, _)) = found.robot_file("2026-05-31") else {
                // Without an orientation the tool point on a round flange may turn either way; else it must be found.
                panic!("{what} {notation:?}: {:?}", found.fits);
            };
            let again = asked(&mine, &readings);
            assert!(again.as_file.agrees(), "{what} {notation:?}: {:?}", again.as_file);
            // It stands where the robot stands at postures that nobody read.
            let mut rng = fastrand::Rng::with_seed(7);
            for _ in 0..20 {
                let q: [f64; 6] = std::array::from_fn(|_| 2.0 * (rng.f64() - 0.5));
                let [a, b] = [flange(&robot, &q), flange(&mine, &q)].map(|pose| pose.translation.vector.norm());
                // From the base's axis and floor, so zeros of 1 and 6, which base and tool hide, do not count; readings are rounded.
                assert!((a - b).abs() < 1e-4, "{what} {notation:?}: {a} {b}: {:?}", found.fits[0].1.convention);
            }
        }
    }
}

/// A pendant that counts joint 3 from the horizontal: with base and tool fitted, turning the wrist round fits as well, but joint 5 was read where
/// its range would not let it be.
#[test]
fn a_way_of_counting_outside_of_the_ranges_is_not_taken_before_one_within() {
    let text = "joint_1_deg,joint_2_deg,joint_3_deg,joint_4_deg,joint_5_deg,joint_6_deg,x_mm,y_mm,z_mm\n\
                -71.6557,-33.9125,-95.5348,94.8700,-61.8348,-44.0615,209.6389,1232.3161,2617.5373\n\
                -6.1493,-122.2641,-67.8878,174.4361,-55.8895,-179.1036,430.9668,63.7915,2788.7509\n\
                81.8857,-51.8032,-41.8689,-141.3118,26.0600,-76.4327,351.5756,-2047.5889,2532.9674\n\
                -8.8011,-41.1050,17.1899,-171.0469,11.8138,-127.1613,2533.4612,399.1829,1016.5842\n\
                -2.4762,-40.5113,-82.3256,194.4680,45.1376,-7.8706,1296.3624,94.1698,2775.8230\n\
                22.8325,-94.1900,-15.4310,-182.5864,50.2482,-49.6378,1400.0488,-597.5532,2297.4550\n";
    let readings = readings(text, "KUKA");
    let found = asked(&kuka(), &readings);
    let (robot, fit) = found.written_of().expect("one that agrees");
    assert!(fit.agrees() && fit.convention.third_axis == ThirdAxis::Forearm, "{:?}", fit.convention);
    let (written, remarks) = found.robot_file("2026-11-29").expect("written");
    let (_, limits) = parts(&written);
    let is_within = |(joint, range): (usize, &stiffarm::interval::Interval)| {
        readings.rows.iter().all(|row| range.contains(row.q[joint], 0.02))
    };
    assert!(limits.joints.iter().enumerate().all(is_within), "{robot:?} {limits:?}");
    assert!(!remarks.iter().any(|remark| remark.contains("it hardly counts so")), "{remarks:?}");
}

#[test]
fn readings_that_move_no_wrist_verify_nothing_and_the_postures_proposed_do() {
    let robot = kuka();
    let mut few = POSTURES[..5].to_vec();
    for q in &mut few {
        [q[3], q[4]] = [10.0, 40.0];
    }
    let found = asked(&robot, &readings(&table(&robot, &few, Some(Notation::Abc)), "KUKA"));
    assert!(found.as_file.agrees() && !found.verified);
    assert!(
        found.alike.contains(&"the sign of joint 4".into()) && found.alike.contains(&"the sign of joint 5".into()),
        "{:?}",
        found.alike
    );
    assert!((1..=3).contains(&found.postures.len()));
    few.extend(found.postures.iter().map(|q| q.map(|x| x.to_degrees().round())));
    let found = asked(&robot, &readings(&table(&robot, &few, Some(Notation::Abc)), "KUKA"));
    assert!(found.verified, "{:?}", found.alike);
}

#[test]
fn one_row_that_was_typed_wrong_is_named() {
    let robot = kuka();
    let mut postures = POSTURES;
    let right = table(&robot, &postures, Some(Notation::Abc));
    postures[3][4] = 50.0;
    let typed = table(&robot, &postures, Some(Notation::Abc));
    let wrong: Vec<&str> = typed
        .lines()
        .enumerate()
        .map(|(i, line)| {
            // The row with the wrong joint, with the position of the right one.
            let right = right.lines().nth(i).unwrap();
            if i == 4 { right } else { line }
        })
        .collect();
    let text = wrong.join("\n").replace("15,-60,60,90,-50,-45", "15,-60,60,90,50,-45");
    let found = asked(&robot, &readings(&text, "KUKA"));
    assert_eq!(found.wrong_row.map(|(line, _)| line), Some(5), "{text}");
    assert!(!found.verified && found.robot_file("2026-05-31").is_none());
}

#[test]
fn a_wrist_that_carries_joints_along_is_reported_and_not_written() {
    let robot = kuka();
    let mut text = String::new();
    // The pendant shows joint 6 less what joint 5 turns it along: theta 6 = -q6 + theta 5.
    for line in table(&robot, &POSTURES, Some(Notation::Abc)).lines() {
        let mut cells: Vec<String> = line.split(',').map(Into::into).collect();
        if let (Ok(q5), Ok(q6)) = (cells[4].parse::<f64>(), cells[5].parse::<f64>()) {
            cells[5] = format!("{}", q6 + q5);
        }
        writeln!(text, "{}", cells.join(",")).unwrap();
    }
    let found = asked(&robot, &readings(&text, "KUKA"));
    let (_, best) = &found.fits[0];
    assert!(best.agrees() && best.convention.carried == [0.0, 0.0, 1.0], "{best:?}");
    assert!(found.robot_file("2026-05-31").is_none());
}

#[test]
fn of_all_robots_the_one_is_found_that_the_readings_are_from() {
    let all = ["KR 210 R2700 extra", "R-2000iC/165F", "BT200L", "KR 210 R3100 prime", "IRB 6640-235/2.55", "TX2-90L"];
    let all: Vec<Robot> = all.iter().filter_map(|name| Some(find(name)?.robot())).collect();
    assert!(4 < all.len());
    for robot in &all {
        let found =
            rank(&readings(&table(robot, &POSTURES, None), ""), &VerifyOptions::default(), &all, Watch::nobody())
                .unwrap();
        assert_eq!(found[0].0.name, robot.name);
        assert!(found[0].1.agrees() && 2e-3 < found[1].1.rms, "{}: {}", robot.name, found[1].1.rms);
    }
}

#[test]
fn a_base_that_is_given_shows_the_zero_of_joint_1() {
    let file = kuka();
    let robot = with(&file, |geometry, _| geometry.offset[0] += 0.3);
    let (base, _) = frames();
    let options = VerifyOptions { base: Some(base), tool: None };
    let readings = readings(&table(&robot, &POSTURES, None), "KUKA");
    assert!(
        verify(&file, &readings, &VerifyOptions::default(), &[], Watch::nobody()).unwrap().verified,
        "a base takes it up"
    );
    let found = verify(&file, &readings, &options, &[], Watch::nobody()).unwrap();
    let (mine, _) = found.robot_file("2026-05-31").unwrap();
    assert!((parts(&mine).0.offset[0] - parts(&robot).0.offset[0]).abs() < 1e-5 && !found.verified);
}

/// The point of the flange lies on axis 6: whatever that joint does, it stands where it stood. The orientation shows it.
#[test]
fn a_flange_without_its_orientation_verifies_no_joint_6() {
    let file = kuka();
    let none = (Isometry3::identity(), Isometry3::identity());
    let options = VerifyOptions { base: Some(none.0), tool: Some(none.1) };
    let turned = with(&file, |geometry, _| geometry.sign[5] *= -1.0);
    for (robot, notation, agrees) in [
        (&file, None, true),
        (&turned, None, true),
        (&file, Some(Notation::Abc), true),
        (&turned, Some(Notation::Abc), false),
    ] {
        let readings = readings(&table_in(none, robot, &POSTURES, notation), "KUKA");
        let found = verify(&file, &readings, &options, &[], Watch::nobody()).unwrap();
        assert_eq!(found.as_file.agrees(), agrees, "{notation:?}");
        assert_eq!(found.verified, agrees && notation.is_some(), "{notation:?}: {:?}", found.alike);
        if notation.is_none() {
            let [one] = found.alike.as_slice() else { panic!("{:?}", found.alike) };
            assert!(one.starts_with("the sign of joint 6 (no posture would") && found.postures.is_empty(), "{one}");
            assert_eq!(found.zeros_not_seen, [6]);
            let (mine, _) = found.robot_file("2026-05-31").unwrap();
            assert_eq!(mine.pendant(), Some(&Pendant::Unknown));
        } else {
            assert!(found.zeros_not_seen.is_empty());
        }
    }
    let fitted = asked(&file, &readings(&table(&file, &POSTURES, Some(Notation::Abc)), "KUKA"));
    assert_eq!((fitted.verified, fitted.zeros_not_seen), (true, vec![1, 6]), "base and tool take them up");
}

/// The other sign of joint 5 stands where half turns of joints 4 and 6 do, that of joint 6 with a tool that is fitted where half a turn of joint 5 does.
#[test]
fn one_sign_is_told_and_not_the_half_turns_that_stand_for_it() {
    let none = (Isometry3::identity(), Isometry3::identity());
    let options = VerifyOptions { base: Some(none.0), tool: Some(none.1) };
    for name in ["KR 210 R2700 extra", "TX90", "IRB 6650S-200"] {
        let file = find(name).unwrap().robot();
        let postures = POSTURES
            .map(|q| if name == "KR 210 R2700 extra" { q } else { [q[0], q[1] + 90.0, q[2] - 90.0, q[3], q[4], q[5]] });
        for joint in [4, 5] {
            let robot = with(&file, |geometry, _| geometry.sign[joint] *= -1.0);
            let (geometry, limits) = parts(&file);
            let own = stiffarm::verify::Convention::of(&geometry, &limits);
            for (frames, options) in [(none, &options), (frames(), &VerifyOptions::default())] {
                let readings = readings(&table_in(frames, &robot, &postures, Some(Notation::Abc)), &file.vendor);
                let found = verify(&file, &readings, options, &[], Watch::nobody()).unwrap();
                let expected = format!("joint {} counts the other way", joint + 1);
                assert_eq!(found.fits[0].1.convention.differences(&own), [expected], "{name}: {:?}", found.fits[0].1);
            }
        }
    }
}

/// One zero is off by 0.005 deg, 0.2 mm at the flange: that one is told, and nothing of the others is changed.
#[test]
fn of_a_small_fault_no_more_is_told_than_is_there() {
    let file = kuka();
    let none = (Isometry3::identity(), Isometry3::identity());
    let options = VerifyOptions { base: Some(none.0), tool: Some(none.1) };
    let robot = with(&file, |geometry, _| geometry.offset[1] += 0.005_f64.to_radians());
    let readings = readings(&table_in(none, &robot, &POSTURES, Some(Notation::Abc)), "KUKA");
    let found = verify(&file, &readings, &options, &[], Watch::nobody()).unwrap();
    assert!(!found.verified && found.wrong_row.is_none());
    let (geometry, limits) = parts(&file);
    let own = stiffarm::verify::Convention::of(&geometry, &limits);
    assert_eq!(found.fits[0].1.convention.differences(&own), ["zero of joint 2 is +0.005 deg off"]);
    let (mine, remarks) = found.robot_file("2026-05-31").unwrap();
    let (offset, before) = (parts(&mine).0.offset, geometry.offset);
    assert!((0..6).all(|i| i == 1 || offset[i] == before[i]) && remarks.len() == 1, "{offset:?} {remarks:?}");
    assert!(
        mine.source["pendant"].ends_with("against the file before them zero of joint 2 is +0.005 deg off"),
        "{mine:?}"
    );
}

#[test]
fn what_tells_nothing_is_refused() {
    let robot = kuka();
    let two = readings(&table(&robot, &POSTURES[..2], None), "KUKA");
    let refused = verify(&robot, &two, &VerifyOptions::default(), &[], Watch::nobody()).unwrap_err();
    assert_eq!(refused, VerifyError::TooFew(2));
    let fault = |text: &str| read(text, "r.csv", &ReadOptions::default()).unwrap_err().to_string();
    let good = table(&robot, &POSTURES, Some(Notation::Abc));
    let cases = [
        (good.replace("joint_3_deg", "joint3"), "joint_3_deg: the column is missing"),
        (good.replace("x_mm", "x"), "x_mm: the column is missing"),
        (good.replace("a_deg,", "w_deg,"), "w_deg, p_deg, r_deg"),
        (good.replace("30,-70", "NaN,-70"), "r.csv:3: row 2, joint_1_deg: NaN"),
        (good.replace("30,-70", ",-70"), "the cell is empty"),
        (
            "joint_1_deg,joint_2_deg,joint_3_deg,joint_4_deg,joint_5_deg,joint_6_deg,x_mm,y_mm,z_mm\n".into(),
            "no row holds",
        ),
        (
            "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n0,-1.5,1.5,0,0.8,0,1500,200,900\n".into(),
            "radians",
        ),
        ("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n0,-90,90,0,45,0,1.5,0.2,0.9\n".into(), "metres"),
    ];
    for (text, says) in cases {
        assert!(fault(&text).contains(says), "'{says}' is not in {}", fault(&text));
    }
    let renamed = ReadOptions { columns: vec![("joint_3_deg".into(), "J3".into())], ..ReadOptions::default() };
    let text = good.replace("joint_3_deg", "J3");
    assert_eq!(read(&text, "r.csv", &renamed).unwrap().rows.len(), POSTURES.len());
    let twice = format!("{good}{}\n", good.lines().nth(2).unwrap());
    let found = read(&twice, "r.csv", &ReadOptions::default()).unwrap();
    assert!(found.rows.len() == POSTURES.len() && found.remarks[0].contains("repeats line 3"), "{:?}", found.remarks);
}
