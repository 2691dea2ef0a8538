//! Masses and motors in robot files that cannot be: refused with line, key, value and what was expected.

use stiffarm::catalogue::{find, read, write};
use stiffarm::drive::WristLimit;

/// The file of an arm that has masses, one line of it replaced; what is said of it.
fn said(from: &str, to: &str) -> String {
    let text = write(&find("KR 210 R2700-2").unwrap().robot());
    assert!(text.contains(from), "{from}: {text}");
    let faulty = text.replacen(from, to, 1);
    read(&faulty, "mine.toml").unwrap_err().to_string()
}

fn holds(said: &str, words: &[&str]) {
    for word in words {
        assert!(said.contains(word), "{word}: {said}");
    }
}

#[test]
fn a_mass_that_is_negative_or_a_placeholder_is_refused_with_key_and_value() {
    holds(&said("mass_kg = 232.06", "mass_kg = -232.06"), &["mass.mass_kg", "-232.06 kg", "expected 0 to"]);
    holds(
        &said("mass_kg = 6.6", "mass_kg = 1e-6"),
        &["mass.mass_kg", "0.000001 kg is a placeholder", "at least 0.001 kg"],
    );
    holds(&said("mass_kg = 6.6", "mass_kg = nan"), &["mass.mass_kg", "NaN"]);
}

#[test]
fn an_inertia_that_no_body_has_is_refused_with_its_principal_moments() {
    let negative = said("inertia_kg_m2 = [58.4716", "inertia_kg_m2 = [-58.4716");
    holds(&negative, &["mass.inertia_kg_m2", "expected none negative"]);
    let long = said("0.0114565, 0, -0.000000022616, 0.0114565", "0.0014565, 0, 0, 0.0114565");
    holds(&long, &["mass.inertia_kg_m2", "no body has this inertia", "at most the sum of the other two"]);
}

#[test]
fn a_mass_centre_far_off_its_link_is_refused_with_its_distance() {
    // In metres by mistake it lies in the base.
    let text = said("com_mm = [214.997, 0.004, 3188]", "com_mm = [0.215, 0, 3.188]");
    holds(&text, &["mass.com_mm", "off the line of the link 6", "expected at most", "model zero"]);
}

#[test]
fn a_link_that_no_arm_has_and_a_rod_of_a_serial_arm_are_refused() {
    holds(&said("link = 6", "link = 7"), &["mass.link", "7; expected a link from 0 (the base) to 6"]);
    holds(&said("link = 6", "link = \"bar\""), &["mass.link", "bar; expected"]);
    holds(&said("link = 6", "link = 2.5"), &["mass.link", "2.5; expected"]);
    holds(&said("link = 6", "link = \"rod\""), &["crank_mm", "missing"]);
    holds(&said("link = 6", "link = 6\ncrank_mm = [1, 2]"), &["mass.crank_mm", "is of a rod"]);
    holds(&said("link = 2", "link = \"rod\"\ncrank_mm = [0, -300]"), &["rod of a serial arm", "quasi-serial"]);
    holds(&said("link = 6", "links = 6"), &["unknown key", "did you mean link?"]);
}

#[test]
fn a_rotor_without_a_ratio_and_one_that_is_not_reflected_are_refused() {
    let motor = "[drives]\nmotor_kg_m2 = [0.009, 0.012, 0.012, 0.002, 0.002, 0.002]";
    holds(&said("[drives]", motor), &["drives.motor_kg_m2", "needs ratio beside it"]);
    holds(
        &said("[drives]", "[drives]\nratio = [257, 267, 252, 221, 240, 154]"),
        &["drives.ratio", "needs motor_kg_m2"],
    );
    let own = "[drives]\nrotor_kg_m2 = [0.009, 0.012, 0.012, 0.002, 0.002, 0.002]";
    holds(&said("[drives]", own), &["drives.rotor_kg_m2", "0.009 kg m2; expected 0.01 to"]);
    let both = format!("{motor}\nratio = [257, 267, 252, 221, 240, 154]\nrotor_kg_m2 = [600, 600, 600, 80, 80, 80]");
    holds(&said("[drives]", &both), &["drives.rotor_kg_m2", "stands beside motor_kg_m2"]);
    holds(&said("torque_nm = [7290", "torque_nm = [-7290"), &["drives.torque_nm", "-7290 N m; expected"]);
    let allowed = |moments: &str| said("[drives]", &format!("[drives]\nwrist_moment_nm = {moments}"));
    holds(&allowed("[1300, -1300, 750]"), &["drives.wrist_moment_nm", "-1300 N m; expected"]);
    holds(&allowed("[1300, 750]"), &["drives.wrist_moment_nm", "2 values; expected 3"]);
}

/// What the maker allows of the load comes before the torque limits of the drives, and is written as it is read.
#[test]
fn what_the_maker_allows_about_the_wrist_is_kept() {
    let text = write(&find("KR 210 R2700-2").unwrap().robot());
    let limit = |text: &str| {
        let robot = read(text, "mine.toml").unwrap();
        assert_eq!(read(&write(&robot), "written.toml").unwrap(), robot);
        let stiffarm::robot::Arm::SixAxis { drives, .. } = robot.arm else { panic!("six axes") };
        drives.motors.wrist_limit()
    };
    assert_eq!(limit(&text), Some(([2274.29, 1398.3, 781.55], WristLimit::Drives)));
    let allowed = text.replacen("[drives]", "[drives]\nwrist_moment_nm = [1300, 1300, 750]", 1);
    assert_eq!(limit(&allowed), Some(([1300.0, 1300.0, 750.0], WristLimit::Maker)));
}

#[test]
fn a_rotor_with_its_ratio_is_reflected_by_the_square() {
    let text = write(&find("KR 210 R2700-2").unwrap().robot());
    let motors = "[drives]\nmotor_kg_m2 = [0.00923, 0.0118, 0.0118, 0.00173, 0.00173, 0.00173]\nratio = [256.857, 267, 252, 221, 240, 154]";
    let robot = read(&text.replacen("[drives]", motors, 1), "mine.toml").unwrap();
    let stiffarm::robot::Arm::SixAxis { drives, .. } = &robot.arm else { panic!("six axes") };
    let rotor = drives.motors.rotor.unwrap();
    // 256.857^2 x 0.00923 = 608.96.
    assert!((rotor[0] - 608.96).abs() < 0.01, "{rotor:?}");
    assert_eq!(read(&write(&robot), "written.toml").unwrap(), robot);
}

#[test]
fn masses_do_not_go_with_a_planar_robot() {
    let text = "name = \"x\"\narchitecture = \"serial\"\nstatus = \"derived\"\n[planar]\nl2_mm = 1000\nl3_mm = 1000\n[[mass]]\nlink = 1\n";
    let said = read(text, "mine.toml").unwrap_err().to_string();
    holds(&said, &["mass", "does not go with [planar]"]);
}
