//! Verb: does a robot file count the joints as the very robot's pendant does?
//!
//! Some postures are read from the pendant, joints and the controller's own position, or points are measured. Base and tool of the
//! controller are fitted where they are not given: `B F(q) T` must stand where it was read, with the flange `F` of the robot file.
//! Positions within 0.05 mm and orientations within 0.02 deg agree, measured points within 3 mm rms: lengths of another robot
//! are off by 10 mm and more. A file is verified where it agrees *and* no other way of counting would. Otherwise others are tried: signs, zeros,
//! what joint 3 counts from, wrists in which joints carry others along; and the makers' other robots.

mod apart;
mod convention;
mod fit;
mod search;

use crate::catalogue::readings::Readings;
use crate::geometry::Geometry;
use crate::interval::Interval;
use crate::limits::{Limits, Pendant, Verified};
use crate::parallel;
use crate::robot::{Arm, Robot};
use crate::spatial::Pose;
use crate::watch::{Stopped, Watch};
pub use convention::{Carried, Convention};
pub use fit::Fit;
use fit::Table;

/// So few postures tell nothing: base and tool alone fit them.
pub const LEAST_ROWS: usize = 3;
/// Rows by which robots that do not fit are left aside.
const ROWS: usize = 30;
/// Robots, each in two ways of counting, that are looked at closer after a first glance.
const RANKED: usize = 40;
/// So many ways of counting are reported.
const REPORTED: usize = 5;

/// What is known beside the readings.
#[derive(Clone, Debug, Default)]
pub struct VerifyOptions {
    /// The base of the robot file in the frame of the readings; fitted where `None`.
    pub base: Option<Pose>,
    /// The tool that was in force, in the flange; fitted where `None`.
    pub tool: Option<Pose>,
}

/// What readings say of a robot.
#[derive(Clone, Debug)]
pub struct Verification {
    /// The robot asked about, as its file has it.
    pub robot: Robot,
    /// The file as it stands against the readings.
    pub as_file: Fit,
    /// It agrees, and no other way of counting would.
    pub verified: bool,
    /// Robots and ways of counting that fit best, the best first.
    pub fits: Vec<(Robot, Fit)>,
    /// What these readings do not tell apart, in words.
    pub alike: Vec<String>,
    /// Postures that would tell it, joint angles as reported, rad.
    pub postures: Vec<[f64; 6]>,
    /// Joints, 1 to 6, whose zeros a base or a tool that is fitted takes up, so that nothing is known of them.
    pub zeros_not_seen: Vec<usize>,
    /// The row that is off where all others agree: its line in the file, and by how much, m.
    pub wrong_row: Option<(usize, f64)>,
    /// How many rows were read.
    pub rows: usize,
    /// From where to where each joint was read, rad.
    pub read: [Interval; 6],
    /// Points were measured by an instrument.
    pub is_measured: bool,
}

/// Why nothing can be said.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VerifyError {
    /// Two links have no joints that a pendant shows.
    #[error(
        "{0} is known by two links only; a pendant shows six joints, so a robot with [geometry] and [limits] is needed"
    )]
    Planar(String),
    /// Base and tool fit everything.
    #[error("{0} rows; expected at least {LEAST_ROWS}, and better six that move every joint")]
    TooFew(usize),
    /// A tool has one point.
    #[error("a tool is given, and {0} points were measured; expected one point")]
    ToolOfPoints(usize),
    /// Nobody waits any longer.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Holds a robot against readings; `others` are tried where it does not fit, as they count and with joint 3 from the other line.
///
/// # Errors
/// Of a robot without six axes, of too few rows, and where nobody waits any longer.
pub fn verify(
    robot: &Robot,
    readings: &Readings,
    options: &VerifyOptions,
    others: &[Robot],
    watch: Watch,
) -> Result<Verification, VerifyError> {
    let (geometry, limits) = six_axis(robot).ok_or_else(|| VerifyError::Planar(robot.full_name()))?;
    if readings.rows.len() < LEAST_ROWS {
        return Err(VerifyError::TooFew(readings.rows.len()));
    }
    if options.tool.is_some() && 1 < readings.points {
        return Err(VerifyError::ToolOfPoints(readings.points));
    }
    let table = Table::of(readings, options);
    let file = Convention::of(geometry, limits);
    let as_file = table.fit(geometry, &file, &[]);
    let mut found = Verification {
        robot: robot.clone(),
        fits: vec![(robot.clone(), as_file.clone())],
        verified: false,
        alike: Vec::new(),
        postures: Vec::new(),
        zeros_not_seen: (0..6).filter(|joint| !table.free().contains(joint)).map(|joint| joint + 1).collect(),
        wrong_row: None,
        rows: readings.rows.len(),
        read: ranges_of(readings),
        is_measured: readings.is_measured,
        as_file,
    };
    if found.as_file.agrees() {
        (found.alike, found.postures) = apart::apart(&table, (geometry, limits), &found.as_file);
        found.verified = found.alike.is_empty();
        return Ok(found);
    }
    found.wrong_row = wrong_row(readings, options, (geometry, &file));
    if found.wrong_row.is_some() {
        return Ok(found);
    }
    let is_allowed = |convention: &Convention| beyond(convention, robot, &found.read).next().is_none();
    let mut fits: Vec<(Robot, Fit)> = search::best(&table, geometry, (&file, &is_allowed), watch)?
        .into_iter()
        .map(|fit| (robot.clone(), fit))
        .collect();
    if !fits.iter().any(|(_, fit)| fit.agrees()) {
        fits.extend(ranked(&table, others, watch)?);
    }
    sort(&mut fits, robot, &found.read);
    fits.truncate(REPORTED);
    if let Some((best, fit)) = fits.first().filter(|(_, fit)| fit.agrees())
        && let Some(parts) = six_axis(best)
    {
        (found.alike, found.postures) = apart::apart(&table, parts, fit);
    }
    found.fits = fits;
    Ok(found)
}

/// Which of many robots readings are from, the best first; none of two links.
///
/// # Errors
/// As [`verify`].
pub fn rank(
    readings: &Readings,
    options: &VerifyOptions,
    robots: &[Robot],
    watch: Watch,
) -> Result<Vec<(Robot, Fit)>, VerifyError> {
    if readings.rows.len() < LEAST_ROWS {
        return Err(VerifyError::TooFew(readings.rows.len()));
    }
    Ok(ranked(&Table::of(readings, options), robots, watch)?)
}

/// Those of many robots that fit best, the best first, each as it counts or with joint 3 from the other line where that fits better.
fn ranked(table: &Table, robots: &[Robot], watch: Watch) -> Result<Vec<(Robot, Fit)>, Stopped> {
    let few = table.thinned(ROWS);
    let ways: Vec<(&Robot, &Geometry, Convention)> = (robots.iter())
        .filter_map(|robot| Some((robot, six_axis(robot)?)))
        .flat_map(|(robot, (geometry, limits))| {
            let file = Convention::of(geometry, limits);
            [file.with_third(0.0), file].map(|convention| (robot, geometry, convention))
        })
        .collect();
    watch.go_on()?;
    let mut glances = parallel::each(&ways, |way| (few.glance(way.1, &way.2), way));
    glances.sort_by(|a, b| a.0.total_cmp(&b.0));
    watch.go_on()?;
    glances.truncate(RANKED);
    let fits: Vec<(Robot, Fit)> = parallel::each(&glances, |(_, (robot, geometry, convention))| {
        ((*robot).clone(), few.fit(geometry, convention, &[]))
    });
    let mut found: Vec<(Robot, Fit)> = Vec::new();
    for (robot, fit) in fits {
        match found.iter_mut().find(|(known, _)| *known == robot) {
            Some((_, known)) if fit.rms < known.rms => *known = fit,
            Some(_) => {}
            None => found.push((robot, fit)),
        }
    }
    found.sort_by(|a, b| a.1.rms.total_cmp(&b.1.rms));
    found.truncate(2 * REPORTED);
    for (robot, fit) in &mut found {
        let (geometry, _) = six_axis(robot).expect("only such were taken");
        *fit = table.fit(geometry, &fit.convention, &[]);
    }
    found.sort_by(|a, b| a.1.rms.total_cmp(&b.1.rms));
    Ok(found)
}

/// From where to where each joint was read, rad.
fn ranges_of(readings: &Readings) -> [Interval; 6] {
    std::array::from_fn(|joint| {
        let angles = || readings.rows.iter().map(|row| row.q[joint]);
        Interval::spanning(angles().fold(f64::INFINITY, f64::min), angles().fold(f64::NEG_INFINITY, f64::max))
    })
}

/// The joints, from 0, that were read where the ranges of a robot that counts so do not let them be.
fn beyond(convention: &Convention, robot: &Robot, read: &[Interval; 6]) -> impl Iterator<Item = (usize, Interval)> {
    /// rad: ranges are rounded, and a pendant shows a joint at its stop.
    const SLACK: f64 = 0.02;
    let (written, _) = convention.written(robot);
    let ranges = six_axis(&written).map(|(_, limits)| limits.joints);
    let read = *read;
    ranges.into_iter().flat_map(move |ranges| ranges.into_iter().zip(read).enumerate()).filter_map(
        |(joint, (range, read))| {
            let is_within = range.contains(read.min(), SLACK) && range.contains(read.max(), SLACK);
            (!is_within).then_some((joint, range))
        },
    )
}

/// Those that agree first, within the ranges of the joints, with the fewest changes, of which another robot is one; then by rms.
fn sort(fits: &mut [(Robot, Fit)], asked: &Robot, read: &[Interval; 6]) {
    let outside = |(robot, fit): &(Robot, Fit)| beyond(&fit.convention, robot, read).count();
    let changes = |(robot, fit): &(Robot, Fit)| {
        let own = six_axis(robot).map(|(geometry, limits)| (geometry, Convention::of(geometry, limits)));
        own.map_or(0, |(geometry, own)| fit.assumed(geometry, &own)) + usize::from(robot.name != asked.name)
    };
    fits.sort_by(|a, b| match (a.1.agrees(), b.1.agrees()) {
        (true, true) => (outside(a), changes(a)).cmp(&(outside(b), changes(b))).then(a.1.rms.total_cmp(&b.1.rms)),
        (x, y) => y.cmp(&x).then(a.1.rms.total_cmp(&b.1.rms)),
    });
}

/// The row without which all others agree; only where enough are left.
fn wrong_row(
    readings: &Readings,
    options: &VerifyOptions,
    (geometry, file): (&Geometry, &Convention),
) -> Option<(usize, f64)> {
    /// Longer tables are no one's typing.
    const MOST: usize = 30;
    if readings.rows.len() <= LEAST_ROWS + 1 || MOST < readings.rows.len() {
        return None;
    }
    (0..readings.rows.len()).find_map(|i| {
        let mut others = readings.clone();
        let row = others.rows.remove(i);
        let fit = Table::of(&others, options).fit(geometry, file, &[]);
        if !fit.agrees() {
            return None;
        }
        let frame = fit.bases[row.stand] * file.chain(geometry, &[], &[], &row.q).flange;
        let distances = row
            .points
            .iter()
            .zip(&fit.points)
            .filter_map(|(seen, point)| Some(((*seen)? - (frame * nalgebra::Point3::from(*point)).coords).norm()));
        Some((row.line, distances.fold(0.0, f64::max)))
    })
}

fn six_axis(robot: &Robot) -> Option<(&Geometry, &Limits)> {
    match &robot.arm {
        Arm::SixAxis { geometry, limits, .. } => Some((geometry, limits)),
        Arm::Planar(_) => None,
    }
}

impl Verification {
    /// The fit that a robot file is written of: the best that agrees, and can be said in one.
    pub fn written_of(&self) -> Option<&(Robot, Fit)> {
        self.fits.iter().find(|(_, fit)| fit.agrees() && fit.convention.carried == [0.0; 3])
    }

    /// The robot that counts as the readings do, with what they verify of it at this date (year-month-day); and what must be looked at in its ranges.
    ///
    /// What the controller computed is written as verified where nothing else would fit as well. Measured points say that the pendant
    /// shows what the file says, and by how much the arm is off.
    pub fn robot_file(&self, date: &str) -> Option<(Robot, Vec<String>)> {
        let (robot, fit) = self.written_of()?;
        let differences = six_axis(robot)
            .map_or_else(Vec::new, |(geometry, limits)| fit.convention.differences(&Convention::of(geometry, limits)));
        let beyond: Vec<(usize, Interval)> = beyond(&fit.convention, robot, &self.read).collect();
        let (mut robot, mut remarks) = fit.convention.written(robot);
        remarks.extend(beyond.iter().map(|(joint, range)| {
            let [least, most, from, to] = [range.min(), range.max(), self.read[*joint].min(), self.read[*joint].max()]
                .map(|angle| (angle.to_degrees() * 100.0).round() / 100.0);
            format!(
                "joint {} was read from {from} to {to} deg, beyond its range of {least} to {most} deg in this file: it hardly counts so",
                joint + 1
            )
        }));
        if !differences.is_empty() {
            // What was said of the way of counting before holds no longer.
            let (rows, differences) = (self.rows, differences.join(", "));
            let source = format!("{rows} postures of {date}; against the file before them {differences}");
            robot.source.insert(crate::limits::PENDANT_SOURCE.into(), source);
        }
        let Arm::SixAxis { limits, .. } = &mut robot.arm else { return None };
        if !self.alike.is_empty() {
            limits.pendant = Pendant::Unknown;
            remarks.push(format!("not verified: the readings do not tell {}", self.alike.join(", ")));
        } else if self.is_measured {
            limits.pendant = Pendant::AsFile;
            let source = format!("{} measured postures of {date} fit within {:.2} mm rms", self.rows, fit.rms * 1e3);
            robot.source.insert(crate::limits::PENDANT_SOURCE.into(), source);
        } else {
            limits.pendant = Pendant::Verified(Verified { rows: self.rows, date: date.into(), largest: fit.largest });
        }
        Some((robot, remarks))
    }
}
