//! Robot files and the robots that come with the program; process files, and the materials that do; meshes of parts.

mod bodies;
pub(crate) mod cells;
mod fault;
pub mod files;
mod filter;
pub mod import;
mod index;
mod masses;
mod measured_force;
pub mod measurements;
mod process_file;
mod reader;
pub mod readings;
mod robot_file;
pub mod stl;
mod warnings;
mod write;

pub use fault::{Fault, Faults};
pub use filter::{Filter, NothingLeft};
pub use index::{Entry, entries, find, matching, names, suggestions};
pub use process_file::{Material, ProcessFile, materials, read_process, read_process_beside};
pub(crate) use reader::shown;
pub use robot_file::is_date;
pub use robot_file::read;
pub use warnings::{doubts, warnings};
pub use write::write;
pub use write::{microradians, quoted};

use crate::drive::JointCompliance;
use crate::robot::{Arm, COMPLIANCE_SOURCE, GIVEN, Robot};

/// The ten robots of the paper, in the order of its Table II.
const PAPER: [&str; 10] = [
    "yaskawa_es200rd_ii",
    "yaskawa_hp350d_200",
    "abb_irb_6650s_200_3_0",
    "abb_irb_6400_2_4_200",
    "kuka_kr_210_r2700_extra",
    "staubli_tx340_sh",
    "fanuc_r_2000ic_210r",
    "fanuc_m_900ia_200p",
    "kawasaki_bt200l",
    "kawasaki_zx200u",
];

/// The ten robots of the paper, in its order. No other file is read.
///
/// # Panics
/// Never: the files are compiled in, and a test reads them all.
pub fn paper_robots() -> Vec<Robot> {
    PAPER.iter().map(|stem| Entry::at(&format!("paper/{stem}.toml")).expect("compiled in").robot()).collect()
}

/// The names of the paper's robots, in its order; no file is read whole.
pub fn paper_names() -> Vec<&'static str> {
    PAPER.iter().filter_map(|stem| Entry::at(&format!("paper/{stem}.toml"))).map(|entry| entry.name).collect()
}

/// Every robot that comes with the program, by maker and name.
pub fn robots() -> Vec<Robot> {
    entries().iter().map(Entry::robot).collect()
}

/// The robot with other compliances of its drives, urad/(N m), held to what a robot file may say; of a planar robot those of
/// the drives 2 and 3 count. Answers call them given.
///
/// # Errors
/// A value that no drive has.
pub fn with_compliance(robot: &Robot, drive_urad_per_nm: [f64; 6]) -> Result<Robot, Faults> {
    let k = drive_urad_per_nm.map(|urad| urad / 1e6);
    let mut changed = robot.clone();
    changed.stiffness_is_assumed = false;
    changed.source.insert(COMPLIANCE_SOURCE.into(), GIVEN.into());
    match &mut changed.arm {
        Arm::SixAxis { drives, .. } => {
            (drives.compliance, drives.identified, drives.scatter) = (JointCompliance(k), None, None);
        }
        Arm::Planar(arm) => (arm.k2, arm.k3) = (k[1], k[2]),
    }
    read(&write(&changed), &robot.name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::StiffnessSource;

    #[test]
    fn other_compliances_change_nothing_else_and_are_held_to_what_a_file_may_say() {
        let urad = [0.7, 1.1, 1.9, 3.0, 5.0, 8.0];
        for robot in paper_robots() {
            let changed = with_compliance(&robot, urad).unwrap();
            let Arm::SixAxis { drives, .. } = &changed.arm else { unreachable!("six axes") };
            assert_eq!(drives.compliance.0, urad.map(|urad| urad / 1e6));
            assert_eq!(with_compliance(&changed, [1.0; 6]).unwrap().arm, robot.arm);
            let sources = [&robot, &changed].map(Robot::stiffness_source);
            assert_eq!(sources, [StiffnessSource::Assumed, StiffnessSource::Given]);
            assert_eq!(with_compliance(&robot, [1.0, 1.0, f64::NAN, 1.0, 1.0, 1.0]).unwrap_err().faults.len(), 1);
            assert!(with_compliance(&robot, [1e-6; 6]).is_err());
        }
    }
}
