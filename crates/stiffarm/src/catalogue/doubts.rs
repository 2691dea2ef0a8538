//! What in a robot file is no fault, but deserves a second look?

use crate::robot::{Arm, Robot};

/// A data sheet may count its reach to another point than the wrist centre, or with a bent elbow; by more than this it
/// is rather a mistake.
const REACH_MAY_DIFFER: f64 = 0.05;

/// Offsets of real arms are rarely as short as this, m, and lengths in metres always are.
const SHORT: f64 = 5e-3;

/// Remarks on a robot that can be used, each a sentence that names its key.
pub fn doubts(robot: &Robot) -> Vec<String> {
    let mut doubts = Vec::new();
    if robot.payload_kg.is_none() {
        doubts.push("payload_kg is missing: no choice by payload will find this robot".into());
    }
    if let Arm::SixAxis { geometry, .. } = &robot.arm {
        let lengths =
            [("a1", geometry.a1), ("a2", geometry.a2), ("b", geometry.b), ("c1", geometry.c1), ("c4", geometry.c4)];
        for (name, m) in lengths.into_iter().filter(|(_, m)| *m != 0.0 && m.abs() < SHORT) {
            let mm = (m * 1e9).round() / 1e6;
            doubts.push(format!("{name}_mm is {mm} mm: is that the unit? if it is in m, write {}", mm * 1e3));
        }
    }
    let stretch = robot.stretch();
    if let Some(reach) = robot.reach
        && REACH_MAY_DIFFER * stretch < (reach - stretch).abs()
    {
        doubts.push(format!(
            "reach_m is {reach} m, but a1 + l2 + l3 is {stretch:.3} m, {:+.1} % off: is a length wrong, or does the \
             reach count to the flange?",
            100.0 * (stretch / reach - 1.0)
        ));
    }
    doubts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::paper_robots;

    #[test]
    fn a_reach_five_per_cent_off_the_stretched_arm_is_doubted_and_less_is_not() {
        let kuka = &paper_robots()[4]; // a1 + l2 + l3 = 0.350 + 1.150 + 1.2007 = 2.7007 m
        assert!((kuka.stretch() - 2.7007).abs() < 1e-4);
        let with = |reach| doubts(&Robot { reach: Some(reach), ..kuka.clone() });
        assert_eq!(with(2.566 + 0.001), Vec::<String>::new());
        assert_eq!(with(2.8355 - 0.001), Vec::<String>::new());
        assert!(with(2.565)[0].contains("2.701 m, +5.3 % off"), "{:?}", with(2.565));
        assert!(with(2.837)[0].starts_with("reach_m is 2.837 m"));
        let Arm::SixAxis { geometry, limits, drives } = kuka.arm.clone() else { unreachable!("six axes") };
        let geometry = crate::geometry::Geometry { b: -0.0015, ..geometry };
        let offset = doubts(&Robot { arm: Arm::SixAxis { geometry, limits, drives }, ..kuka.clone() });
        assert_eq!(offset, ["b_mm is -1.5 mm: is that the unit? if it is in m, write -1500"]);
        let silent = Robot { reach: None, payload_kg: None, ..kuka.clone() };
        assert!(doubts(&silent).len() == 1 && doubts(&silent)[0].starts_with("payload_kg is missing"));
    }
}
