//! Is every text either a robot with a reachable arm, or a list of faults with lines and reasons?

use stiffarm::catalogue;
use stiffarm::interval::Interval;
use stiffarm::robot::Arm;

/// Panics where the promise is broken.
pub(crate) fn holds(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match catalogue::read(text, "fuzz.toml") {
        Ok(robot) => {
            if let Ok(plane) = robot.arm_plane() {
                assert!(!plane.arm.sides().expect("a robot that was read reaches something").is_empty());
            }
            assert!(!robot.name.is_empty());
            if let Arm::SixAxis { geometry, limits, .. } = &robot.arm {
                assert!(geometry.sign.iter().all(|sign| sign.abs() == 1.0));
                let middle = limits.joints.map(Interval::middle);
                let flange = geometry.forward(&geometry.model_angles(&middle, limits.third_axis)).translation.vector;
                assert!(flange.iter().all(|x| x.is_finite()), "{flange}");
            }
        }
        Err(faults) => {
            assert!(!faults.faults.is_empty(), "refused without a reason");
            let lines = text.split('\n').count();
            for fault in &faults.faults {
                assert!((1..=lines).contains(&fault.line), "line {} of {lines}", fault.line);
                assert!(!fault.message.is_empty());
            }
            assert!(faults.faults.is_sorted_by_key(|fault| fault.line));
            assert!(faults.to_string().starts_with("fuzz.toml:"));
        }
    }
}
