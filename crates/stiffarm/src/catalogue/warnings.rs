//! What in a robot file is no fault, but deserves a second look?

use crate::robot::{Arm, Robot};

/// By more than this, m, a reach that is published and one that lengths and limits give are not the same, rounded.
const REACH_MAY_DIFFER: f64 = 0.01;

/// By more than this part of the stretched arm it is that of another arm, or an angle or a length is wrong.
const REACH_IS_ANOTHER: f64 = 0.15;

/// Offsets of real arms are rarely as short as this, m, and lengths in metres always are.
const SHORT: f64 = 5e-3;

/// Joints of industrial arms turn this fast, deg/s; in rad/s, or taken for rad/s, they lie outside.
const SPEEDS: [f64; 2] = [10.0, 2000.0];

/// Joints of arms turn by more than this, deg; in radians the widest range is less.
const TURN: f64 = 15.0;

/// A payload, kg, of less than this is no arm's that reaches farther than that, m.
const PAYLOAD: (f64, f64) = (1.0, 1.2);

/// Remarks on a robot that can be used, each a sentence that names its key.
pub fn warnings(robot: &Robot) -> Vec<String> {
    let missing = robot.payload_kg.is_none();
    let missing = missing.then(|| "payload_kg is missing: no choice by payload will find this robot".to_owned());
    let doubts = doubts(robot);
    // What is told already is not told twice.
    let reach = reach_doubt(robot, REACH_MAY_DIFFER).filter(|reach| !doubts.contains(reach));
    missing.into_iter().chain(doubts).chain(reach).collect()
}

/// What of these a number may mean that is wrong: it is said beside every answer that rests on the file.
pub fn doubts(robot: &Robot) -> Vec<String> {
    let mut warnings = Vec::new();
    if let (Some(payload), Some(mass)) = (robot.payload_kg, robot.mass_kg)
        && mass < payload
    {
        warnings.push(format!(
            "mass_kg is {mass} kg beside payload_kg {payload} kg: does an arm carry more than it weighs?"
        ));
    }
    let (least, far) = PAYLOAD;
    if let Some(payload) = robot.payload_kg.filter(|payload| *payload < least && far < robot.stretch()) {
        let stretch = robot.stretch();
        warnings.push(format!("payload_kg is {payload} kg at {stretch:.2} m of arm: is that the unit?"));
    }
    if let Arm::SixAxis { geometry, limits, .. } = &robot.arm {
        let turns = limits.joints.iter().map(|range| range.width().to_degrees());
        if let Some((i, turn)) = turns.enumerate().find(|(_, turn)| *turn < TURN) {
            let tidy = (turn * 1e3).round() / 1e3;
            warnings.push(format!("joint_deg of joint {} is {tidy} deg wide: is that the unit?", i + 1));
        }
        let speeds = limits.speeds.iter().flatten().map(|speed| speed.to_degrees());
        if let Some((i, speed)) = speeds.enumerate().find(|(_, speed)| *speed < SPEEDS[0] || SPEEDS[1] < *speed) {
            let tidy = (speed * 1e3).round() / 1e3;
            warnings.push(format!(
                "speed_deg_per_s of joint {} is {tidy}: is that the unit? joints turn by {} to {} deg/s",
                i + 1,
                SPEEDS[0],
                SPEEDS[1]
            ));
        }
        let lengths =
            [("a1", geometry.a1), ("a2", geometry.a2), ("b", geometry.b), ("c1", geometry.c1), ("c4", geometry.c4)];
        for (name, m) in lengths.into_iter().filter(|(_, m)| *m != 0.0 && m.abs() < SHORT) {
            let mm = (m * 1e9).round() / 1e6;
            warnings.push(format!("{name}_mm is {mm} mm: is that the unit? if it is in m, write {}", mm * 1e3));
        }
    }
    warnings.extend(reach_doubt(robot, REACH_IS_ANOTHER * robot.stretch()));
    warnings
}

/// A reach that is stated and the one that lengths and limits give, where they differ by more than so many metres.
fn reach_doubt(robot: &Robot, most: f64) -> Option<String> {
    let reach = robot.reach?;
    match robot.reach_ahead() {
        Ok(ahead) if (reach - ahead).abs() <= most => None,
        Ok(ahead) => {
            let (off, stretch) = (1e3 * (ahead - reach), robot.stretch());
            Some(format!(
                "reach_m is {reach} m, but within the limits the wrist centre comes {ahead:.3} m ahead of the joint-1 axis, \
                 {off:+.0} mm off; a1 + l2 + l3 is {stretch:.3} m: is a length or a limit wrong, does the reach count to \
                 the flange, or is it rounded?"
            ))
        }
        Err(error) => Some(format!("reach_m cannot be compared: {error}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;

    #[test]
    fn a_reach_more_than_a_centimetre_off_is_doubted_and_less_is_not() {
        let kuka = &paper_robots()[4]; // a1 + l2 + l3 = 0.350 + 1.150 + 1.2007 = 2.7007 m
        assert!((kuka.stretch() - 2.7007).abs() < 1e-4);
        let with = |reach| warnings(&Robot { reach: Some(reach), ..kuka.clone() });
        assert_eq!(with(2.687), Vec::<String>::new());
        assert_eq!(with(2.706), Vec::<String>::new());
        assert!(with(2.685)[0].contains("comes 2.696 m ahead of the joint-1 axis, +11 mm off"), "{:?}", with(2.685));
        assert!(with(2.707)[0].starts_with("reach_m is 2.707 m"));
        // By hand: an upper arm that stops upright leaves a1 + l3 = 0.350 + 1.2007 m.
        let mut upright = kuka.clone();
        let Arm::SixAxis { limits, .. } = &mut upright.arm else { unreachable!("six axes") };
        limits.joints[1] = crate::interval::Interval::spanning(-140_f64.to_radians(), -90_f64.to_radians());
        assert!(warnings(&upright)[0].contains("comes 1.551 m ahead"), "{:?}", warnings(&upright));
        let Arm::SixAxis { geometry, limits, drives } = kuka.arm.clone() else { unreachable!("six axes") };
        let geometry = crate::geometry::Geometry { b: -0.0015, ..geometry };
        let offset = warnings(&Robot { arm: Arm::SixAxis { geometry, limits, drives }, ..kuka.clone() });
        assert_eq!(offset, ["b_mm is -1.5 mm: is that the unit? if it is in m, write -1500"]);
        let Arm::SixAxis { geometry, mut limits, drives } = kuka.arm.clone() else { unreachable!("six axes") };
        limits.speeds = Some([2.0_f64, 1.9, 2.1, 3.1, 3.0, 3.8].map(f64::to_radians));
        let slow = warnings(&Robot { arm: Arm::SixAxis { geometry, limits, drives }, ..kuka.clone() });
        assert_eq!(slow, ["speed_deg_per_s of joint 1 is 2: is that the unit? joints turn by 10 to 2000 deg/s"]);
        let light = doubts(&Robot { payload_kg: Some(0.21), mass_kg: Some(1.1), ..kuka.clone() });
        assert_eq!(light, ["payload_kg is 0.21 kg at 2.70 m of arm: is that the unit?"]);
        let heavy = doubts(&Robot { mass_kg: Some(1.1), ..kuka.clone() });
        assert!(heavy[0].starts_with("mass_kg is 1.1 kg beside payload_kg 210 kg"), "{heavy:?}");
        let Arm::SixAxis { geometry, mut limits, drives } = kuka.arm.clone() else { unreachable!("six axes") };
        limits.joints[3] = crate::interval::Interval::spanning(-6.1_f64.to_radians(), 6.1_f64.to_radians());
        let narrow = doubts(&Robot { arm: Arm::SixAxis { geometry, limits, drives }, ..kuka.clone() });
        assert_eq!(narrow, ["joint_deg of joint 4 is 12.2 deg wide: is that the unit?"]);
        let silent = Robot { reach: None, payload_kg: None, ..kuka.clone() };
        assert!(warnings(&silent).len() == 1 && warnings(&silent)[0].starts_with("payload_kg is missing"));
    }
}
