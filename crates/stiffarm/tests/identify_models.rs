//! Does an identification find a compensator, tell regions of joint 2 apart, and update a prior?

use nalgebra::Matrix6;
use stiffarm::catalogue::{find, read, write};
use stiffarm::drive::{GravityCompensator, JointCompliance};
use stiffarm::identify::{Estimate, Identification, IdentifyError, Options, Spring, Springs, identify};
use stiffarm::prior::{by_size, factors};
use stiffarm::robot::{Arm, Robot};
use stiffarm::watch::Watch;

use crate::made::Made;

const TRUTH: [f64; 6] = [0.5e-6, 0.3e-6, 0.6e-6, 2.5e-6, 3.5e-6, 4.0e-6];

fn kuka(k: [f64; 6], compensator: Option<GravityCompensator>) -> Robot {
    let mut robot = Robot { stiffness_is_assumed: false, ..find("KR 210 R2700 extra").unwrap().robot() };
    let Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!("six axes") };
    (drives.compliance, drives.compensator) = (JointCompliance(k), compensator);
    robot
}

fn model(model: Springs) -> Options {
    Options { model, ..Options::default() }
}

fn found(robot: &Robot, made: &Made, truth: &Robot, options: &Options) -> Identification {
    identify(robot, &made.measured(truth), options, Watch::nobody()).unwrap()
}

fn of(found: &Identification, spring: Spring) -> &Estimate {
    found.estimates.iter().find(|one| one.spring == spring).unwrap()
}

/// A spring that matters: a fifth of drive 2 and more.
const TRUE_SPRING: GravityCompensator =
    GravityCompensator { base: [-0.6, 0.1], arm: [0.0, 0.25], stiffness: 5e6, free_length: 0.3 };

#[test]
fn a_compensator_is_found_with_its_preload_and_stands_in_the_robot_file() {
    let truth = kuka(TRUTH, Some(TRUE_SPRING));
    let wrong = GravityCompensator { stiffness: 3e6, free_length: 0.2, ..TRUE_SPRING };
    let before = kuka([1e-6; 6], Some(wrong));
    let made = Made { noise: 0.0, postures: 40, ..Made::usual(7) };
    let both = found(&before, &made, &truth, &model(Springs::Preload));
    // Rounding, times a condition of some thousand.
    let near = |one: &Estimate, truth: f64| {
        let found = one.compliance.unwrap();
        assert!((found / truth - 1.0).abs() < 1e-6, "{one:?}, not {truth}");
    };
    near(of(&both, Spring::Compensator), 5e6);
    near(of(&both, Spring::Preload), 1.5e6);
    (0..6).for_each(|drive| near(of(&both, Spring::Drive(drive)), TRUTH[drive]));
    let Arm::SixAxis { drives, .. } = &both.robot.arm else { unreachable!("six axes") };
    let written = drives.compensator.unwrap();
    assert!((written.stiffness / 5e6 - 1.0).abs() < 1e-6 && (written.free_length / 0.3 - 1.0).abs() < 1e-6);
    assert_eq!(read(&write(&both.robot), "x.toml").as_ref(), Ok(&both.robot));
    // The stiffness alone, where the free length is known.
    let before = kuka([1e-6; 6], Some(GravityCompensator { free_length: 0.3, ..wrong }));
    let alone = found(&before, &made, &truth, &model(Springs::Compensator));
    near(of(&alone, Spring::Compensator), 5e6);
    near(of(&alone, Spring::Drive(1)), TRUTH[1]);
    let none = kuka(TRUTH, None);
    assert_eq!(
        identify(&none, &made.measured(&none), &model(Springs::Compensator), Watch::nobody()).unwrap_err(),
        IdentifyError::NoCompensator("KR 210 R2700 extra".into())
    );
}

/// 30 tables with noise: of 95 % of each of two numbers less than 23 in 30 has a chance of one in 10 000.
#[test]
fn the_interval_of_a_compensator_holds_the_truth_as_often_as_it_says() {
    let truth = kuka(TRUTH, Some(TRUE_SPRING));
    let before = kuka(TRUTH, Some(GravityCompensator { stiffness: 3e6, ..TRUE_SPRING }));
    let mut covered = [0; 2];
    for seed in 0..30 {
        let made = Made { noise: 10e-6, postures: 40, ..Made::usual(seed) };
        let found = found(&before, &made, &truth, &model(Springs::Compensator));
        for (count, (spring, truth)) in
            covered.iter_mut().zip([(Spring::Compensator, 5e6), (Spring::Drive(1), TRUTH[1])])
        {
            *count += i32::from(of(&found, spring).interval.is_some_and(|[low, high]| low <= truth && truth <= high));
        }
    }
    assert!(covered.iter().all(|count| 23 <= *count), "{covered:?}");
}

#[test]
fn a_compensator_that_is_wrong_in_the_file_is_chosen_by_itself_and_one_that_is_right_is_not() {
    let truth = kuka(TRUTH, Some(TRUE_SPRING));
    let made = Made { noise: 10e-6, postures: 40, ..Made::usual(4) };
    let wrong = kuka(TRUTH, Some(GravityCompensator { stiffness: 1e6, ..TRUE_SPRING }));
    let chosen = found(&wrong, &made, &truth, &model(Springs::Auto));
    assert_eq!((chosen.model, chosen.tried.len()), (Springs::Compensator, 7), "{:?}", chosen.tried);
    let chosen = found(&truth, &made, &truth, &model(Springs::Auto));
    assert_eq!(chosen.model, Springs::Drives, "{:?}", chosen.tried);
}

/// Displacements of two robots that differ in drive 2, one below and one above the middle of joint 2.
#[test]
fn regions_of_joint_2_have_the_compliances_of_two_robots() {
    let [low, high] = [0.3e-6, 0.5e-6].map(|k| kuka([TRUTH[0], k, TRUTH[2], TRUTH[3], TRUTH[4], TRUTH[5]], None));
    let made = Made { noise: 0.0, postures: 40, ..Made::usual(12) };
    let (mut measured, other) = (made.measured(&low), made.measured(&high));
    let mut angles: Vec<f64> = measured.readings.iter().map(|reading| reading.q[1]).collect();
    angles.sort_by(f64::total_cmp);
    let middle = angles[angles.len() / 2];
    for (reading, other) in measured.readings.iter_mut().zip(other.readings) {
        if middle <= reading.q[1] {
            *reading = other;
        }
    }
    let found = identify(&low, &measured, &model(Springs::Auto), Watch::nobody()).unwrap();
    assert_eq!(found.model, Springs::Regions, "{:?}", found.tried);
    for (region, truth) in [(0, 0.3e-6), (1, 0.5e-6)] {
        assert!((of(&found, Spring::Region(region)).compliance.unwrap() / truth - 1.0).abs() < 1e-8);
    }
    assert!(found.regions[0][1] < middle && found.regions[1][0] == middle);
    // A robot file has one compliance of drive 2, between the two.
    let k = found.robot.drive_compliance()[1].unwrap();
    assert!(0.3e-6 < k && k < 0.5e-6);
    let three = Options { regions: 3, ..model(Springs::Regions) };
    let mut still = measured.clone();
    still.readings.iter_mut().enumerate().for_each(|(i, reading)| reading.q[1] = -1.0 - 0.1 * (i % 4) as f64);
    assert_eq!(
        identify(&low, &still, &three, Watch::nobody()).unwrap_err(),
        IdentifyError::TooFewAngles { angles: 4, least: 6, regions: 3 }
    );
}

#[test]
fn many_good_rows_leave_least_squares_and_under_vertical_loads_drive_1_keeps_its_scatter() {
    let truth = kuka(TRUTH, None);
    let options = Options { with_prior: true, ..Options::default() };
    let made = Made { noise: 5e-6, postures: 200, ..Made::usual(5) };
    let updated = found(&truth, &made, &truth, &options);
    let plain = found(&truth, &made, &truth, &Options::default());
    let posterior = updated.posterior.as_ref().unwrap();
    for (drive, one) in plain.estimates.iter().zip(&posterior.drives) {
        let (k, error) = (drive.compliance.unwrap(), drive.standard_error.unwrap());
        assert!((one.posterior - k).abs() < 0.1 * error, "{one:?} and {drive:?}");
        assert!((one.sd * k / error - 1.0).abs() < 0.3 && one.is_shown() && 0.99 < one.learned(), "{one:?}");
    }
    let (median, scatter) = by_size(&truth).unwrap();
    let down = found(&truth, &Made { only_down: true, ..made }, &truth, &options);
    let first = down.posterior.as_ref().unwrap().drives[0];
    assert!((first.prior / median[0] - 1.0).abs() < 1e-12 && (first.prior_sd - scatter.total()[0]).abs() < 1e-12);
    // By hand: only the common factor of 0.35 is learned, and at most all of it: 0.66^2 - 0.35^2 = 0.56^2.
    assert!(!first.is_shown() && 0.56 < first.sd && first.sd < first.prior_sd, "{first:?}");
    // The robot file has it, and draws scatter by it.
    assert_eq!(read(&write(&down.robot), "x.toml").as_ref(), Ok(&down.robot));
    let identified = down.robot.identified().unwrap();
    assert_eq!(identified.drives, [false, true, true, true, true, true]);
    let k = down.robot.drive_compliance().map(|k| k.unwrap());
    let of_ln = Matrix6::from_fn(|i, j| identified.covariance[(i, j)] / (k[i] * k[j]));
    assert!((of_ln[(0, 0)].sqrt() / first.sd - 1.0).abs() < 1e-6);
    let drawn: Vec<f64> = factors(&down.robot, 4000).unwrap().iter().map(|factor| factor[0].ln()).collect();
    let found = (drawn.iter().map(|x| x * x).sum::<f64>() / 4000.0).sqrt();
    assert!((found / first.sd - 1.0).abs() < 0.06, "{found} and {first:?}");
}

#[test]
fn a_prior_goes_with_the_drives_alone_and_needs_a_size() {
    let robot = kuka(TRUTH, None);
    let measured = Made::usual(1).measured(&robot);
    let options = Options { with_prior: true, model: Springs::Base, ..Options::default() };
    assert_eq!(
        identify(&robot, &measured, &options, Watch::nobody()).unwrap_err(),
        IdentifyError::PriorOfDrives("base")
    );
    let nameless = Robot { payload_kg: None, ..robot };
    let options = Options { with_prior: true, ..Options::default() };
    let error = identify(&nameless, &measured, &options, Watch::nobody()).unwrap_err().to_string();
    assert!(error.contains("KR 210 R2700 extra: payload_kg is needed"), "{error}");
}
