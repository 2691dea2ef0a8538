//! What pushes on the tool along a path: as the path says, as a process has it, or as what is left of the stock lets it.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use nalgebra::Vector3;

use super::stations::{Acting, Station, StationCut, cut, cutting_axes};
use crate::cutting::{Along, CuttingError, Engagement, Law, Measured, MeasuredAxes, Milling, Process, Side};
use crate::stock::{Engaged, Stock, StockError, Through};
use crate::toolpath::{Given, Move, MoveKind, Sample, Steps, of_line};
use crate::watch::{Stopped, Watch};

/// What was typed of the ends of a measured force is rounded to this, m or s.
const ROUNDED: f64 = 1e-3;
/// A corner that turns by more is sharp, rad.
const SHARP: f64 = PI / 6.0;
/// A cut that is narrower than a slot by less has its full width, rad.
const NARROW: f64 = 1e-6;
/// A cut that is wider than the tool by less is as wide as the tool.
const WIDER: f64 = 1e-6;
/// Below this part of its way across a move goes straight down.
const STRAIGHT_DOWN: f64 = 1e-6;
/// A ramp that falls by more is steep, rad.
const STEEP: f64 = PI / 6.0;

/// Where the force comes from where the path says none.
#[derive(Clone, Debug, PartialEq)]
pub enum Forcing {
    /// The same everywhere.
    Same(Acting),
    /// A process; of a mill the mean over a revolution, at the depth and width that the path gives where it gives any.
    Process(Process),
}

/// Stations under a force, and what is to be said of that.
#[derive(Clone, Debug, PartialEq)]
pub struct Forced {
    /// Along the path.
    pub stations: Vec<Station>,
    /// In words.
    pub remarks: Vec<String>,
}

/// A force that cannot be had.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ForcedError {
    /// A tool or an engagement that is none.
    #[error("{}{error}", of_line(*line))]
    Cutting {
        /// Of the path; 0 where it is no matter of the path.
        line: usize,
        /// What is wrong.
        error: CuttingError,
    },
    /// The stock does not support the path.
    #[error(transparent)]
    Stock(#[from] StockError),
    /// The table of a measured force ends before the path does, or begins after it.
    #[error(
        "{}the forces were measured from {:.6} to {:.6} {unit}, and the tool is at {at:.6} {unit} there; expected forces for all of the path that feeds",
        of_line(*line), ends[0], ends[1]
    )]
    Beyond {
        /// Of the path.
        line: usize,
        /// Where it is.
        at: f64,
        /// From where to where is known.
        ends: [f64; 2],
        /// Of all three.
        unit: &'static str,
    },
    /// Forces over time need to know when.
    #[error("{}no feed rate is given, so that forces over time have no place; expected F words, or forces over the way (s_m)", of_line(*line))]
    NoTime {
        /// Of the path.
        line: usize,
    },
    /// What is left of a stock is asked for, and nothing mills.
    #[error(
        "a stock tells how much of a mill is in the work; expected a process with a mill: [tool], [engagement] and a material"
    )]
    NoMill,
    /// The tool is in the air wherever it feeds.
    #[error(
        "the path never meets the stock, so that nothing pushes on the tool; expected the block in mm, in the path's own frame"
    )]
    Missed,
    /// Nothing is known of what it cuts.
    #[error(
        "the path cuts the stock between its samples and at none of them, so that no force is known; expected a smaller step (step-mm)"
    )]
    Between,
    /// It is no longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// How long the tool has fed.
struct Clock {
    /// Where it was last, m.
    way: f64,
    /// s; `None` where some feed rate is not given.
    time: Option<f64>,
}

impl Clock {
    /// At the next sample, s.
    fn at(&mut self, sample: &Sample) -> Option<f64> {
        let way = sample.way - std::mem::replace(&mut self.way, sample.way);
        if sample.is_cutting && 0.0 < way {
            self.time = self.time.zip(sample.feed).map(|(time, feed)| time + way / feed);
        }
        self.time
    }
}

/// Cuts moves into stations, each under its force: that which the path gives; else that of the process, at the depth and width that the path
/// gives, or at what of the tool is in the stock.
///
/// # Errors
/// An engagement of which no force is known; a stock and no mill, or a path that is none of three axes through it; what was stopped.
pub fn forced(
    moves: &[Move],
    steps: &Steps,
    forcing: &Forcing,
    stock: Option<&mut Stock>,
    watch: Watch,
) -> Result<Forced, ForcedError> {
    let at = |line: usize| move |error| ForcedError::Cutting { line, error };
    let usual = match forcing {
        Forcing::Same(acting) => (*acting, None),
        Forcing::Process(process) => cutting(process).map_err(at(0))?,
    };
    let (mut remarks, mut taken, has_stock) = (Vec::new(), Vec::new(), stock.is_some());
    let mut speeds = Vec::new();
    let in_work = match (stock, forcing) {
        (None, _) => None,
        (Some(stock), Forcing::Process(Process { law: Law::Milling(milling), .. })) => {
            Some(through(stock, (moves, steps), milling, &mut remarks, watch)?)
        }
        (Some(_), _) => return Err(ForcedError::NoMill),
    };
    let (mut next, mut clock) = (0, Clock { way: 0.0, time: Some(0.0) });
    let stations = cut(moves, steps, |one, sample| {
        watch.go_on()?;
        let engaged = in_work.as_ref().map(|(engaged, _)| engaged[next].as_ref());
        next += 1;
        let time = clock.at(sample);
        let is_given = one.given.force.is_some() || one.given.axial_depth.is_some() && one.given.radial_width.is_some();
        taken.push(sample.is_cutting && !is_given);
        speeds.push(one.given.spindle);
        if !sample.is_cutting {
            return Ok((None, None));
        }
        if let Some(force) = one.given.force {
            return Ok((Some(along_cut(sample, &force)), None));
        }
        let found = match (forcing, engaged) {
            (_, Some(None)) => return Ok((None, None)),
            (Forcing::Process(process), Some(Some(engaged))) => {
                let across = sample.direction.map_or(1.0, |way| way.xy().norm());
                in_stock(process, engaged, across).map_err(at(sample.line))
            }
            (Forcing::Process(Process { law: Law::Measured(measured), .. }), None) => {
                as_measured(measured, sample, time).map(|acting| (acting, None))
            }
            (Forcing::Process(process), None) => {
                as_given(process, &one.given).unwrap_or_else(|| Ok(usual.clone())).map_err(at(sample.line))
            }
            (Forcing::Same(_), _) => Ok(usual.clone()),
        };
        found.map(|(acting, cut)| (Some(acting), cut))
    })?;
    if let Some((_, between)) = in_work.filter(|_| stations.iter().all(|station| station.acting.is_none())) {
        return Err(if between == 0 { ForcedError::Missed } else { ForcedError::Between });
    }
    remarks.extend(about_path(moves, forcing, has_stock));
    remarks.extend(about_feeds(&stations, forcing));
    remarks.extend(about_chip(&stations, &speeds, forcing));
    remarks.extend(about_spindle(moves, forcing));
    remarks.extend(about_turning(moves, forcing));
    if let (false, Forcing::Process(Process { law: Law::Milling(milling), .. })) = (has_stock, forcing) {
        remarks.extend(about_engagement(&stations, &taken, milling));
    }
    Ok(Forced { stations, remarks })
}

fn along_axis(station: &Station) -> bool {
    station.sample.direction.is_some_and(|way| way.cross(&station.sample.pose.axis).norm() < STRAIGHT_DOWN)
}

/// What of a force does not go with the way that the tool feeds.
fn about_feeds(stations: &[Station], forcing: &Forcing) -> Vec<String> {
    let pushed = || stations.iter().filter(|station| station.acting.is_some());
    let mut found = Vec::new();
    let is_sideways = |station: &&Station| {
        station.acting.and_then(|acting| acting.force()).is_some_and(|[f, c, _]| f != 0.0 || c != 0.0)
    };
    let plunges = pushed().filter(|station| along_axis(station)).filter(is_sideways).count();
    if 0 < plunges {
        found.push(format!(
            "{plunges} samples feed along the tool axis: which way a force along the feed points is not known there, the part's x axis is taken"
        ));
    }
    let Forcing::Process(process) = forcing else { return found };
    let aside = pushed().filter(|station| !along_axis(station)).count();
    if let Law::Measured(Measured { along: Along::Time, .. }) = process.law {
        found.push("the time of the measured force counts while the tool feeds, from the path's beginning".into());
    }
    if matches!(process.law, Law::Drilling { .. }) && 0 < aside {
        found.push(format!("{aside} samples feed across the tool axis: the thrust of a drill is taken there, too"));
    }
    found
}

/// What the path says of forces and cuts, and where that does not count.
fn about_path(moves: &[Move], forcing: &Forcing, has_stock: bool) -> Vec<String> {
    let feeds = || moves.iter().filter(|one| one.kind == MoveKind::Feed);
    let (all, forced) = (feeds().count(), feeds().filter(|one| one.given.force.is_some()).count());
    let has_cuts = feeds().any(|one| one.given.axial_depth.or(one.given.radial_width).is_some());
    let mut found = Vec::new();
    if 0 < forced {
        let others = if forced == all { "no other force acts" } else { "what was asked acts on the others" };
        found.push(format!("THE PATH'S OWN FORCES (fx_n, fy_n, fz_n) act on {forced} of {all} feed moves: {others}"));
    }
    let why = match forcing {
        Forcing::Same(_) => "the force is given as such",
        Forcing::Process(Process { law: Law::Milling(_), .. }) if !has_stock => return found,
        Forcing::Process(_) if has_stock => "the stock tells what is cut where",
        Forcing::Process(_) => "the process is not of a mill in a material",
    };
    found.extend(has_cuts.then(|| format!("ap_mm and ae_mm of the path are not looked at: {why}")));
    found
}

/// Where the path feeds more or less a tooth than the process means: at its own speed of the spindle where it gives one.
fn about_chip(stations: &[Station], speeds: &[Option<f64>], forcing: &Forcing) -> Option<String> {
    /// In parts of what is meant.
    const ALIKE: f64 = 0.1;
    let Forcing::Process(Process { law: Law::Milling(milling), spindle, .. }) = forcing else { return None };
    let meant = milling.engagement.feed_per_tooth;
    // Into the work a mill is fed otherwise than across it.
    let fed = stations.iter().zip(speeds).filter(|(station, _)| station.acting.is_some() && !along_axis(station));
    let chips: Vec<(f64, usize)> = fed
        .filter_map(|(station, speed)| {
            let chip = station.sample.feed? * TAU / (speed.or(*spindle)? * milling.teeth as f64);
            chip.is_finite().then_some((chip, station.sample.line))
        })
        .collect();
    let others: Vec<(f64, usize)> =
        chips.iter().copied().filter(|(chip, _)| ALIKE < (chip / meant - 1.0).abs()).collect();
    let (_, first) = others.first()?;
    let [low, high] =
        others.iter().fold([f64::INFINITY, 0.0], |[low, high], (chip, _)| [chip.min(low), chip.max(high)]);
    let mm = |metres: f64| format!("{:.4}", metres * 1e3).trim_end_matches('0').trim_end_matches('.').to_owned();
    let fed = if mm(low) == mm(high) { mm(low) } else { format!("{} to {}", mm(low), mm(high)) };
    let at = if *first == 0 { String::new() } else { format!(", first at line {first}") };
    let share = if others.len() == chips.len() {
        String::new()
    } else {
        format!(" on {} of {} samples{at}", others.len(), chips.len())
    };
    let meant = mm(meant);
    Some(format!(
        "the path feeds {fed} mm a tooth{share} where the process means {meant}: the force is that of the process"
    ))
}

/// Where the path turns the spindle otherwise than the process means.
fn about_spindle(moves: &[Move], forcing: &Forcing) -> Option<String> {
    let Forcing::Process(Process { spindle: Some(meant), .. }) = forcing else { return None };
    let per_minute = |spindle: f64| (spindle * 60.0 / TAU).round();
    let feeds = moves.iter().filter(|one| one.kind == MoveKind::Feed);
    let mut speeds = feeds.filter_map(|one| one.given.spindle.map(|spindle| (spindle, one.line)));
    let (spindle, line) = speeds.find(|(spindle, _)| 0.01 < (spindle / meant - 1.0).abs())?;
    Some(format!(
        "{}the path turns the spindle at {} rpm where the process means {}: forces, power and chatter are those of the process",
        of_line(line),
        per_minute(spindle),
        per_minute(*meant)
    ))
}

/// Where the path turns a mill the other way than the process means.
fn about_turning(moves: &[Move], forcing: &Forcing) -> Option<String> {
    let Forcing::Process(Process { is_clockwise: meant, law: Law::Milling(_), .. }) = forcing else { return None };
    let is_other =
        |one: &&Move| one.kind == MoveKind::Feed && one.given.is_clockwise.is_some_and(|turns| turns != *meant);
    let line = moves.iter().find(is_other)?.line;
    let [turns, meant] =
        [!meant, *meant].map(|is_clockwise| if is_clockwise { "clockwise" } else { "counter-clockwise" });
    Some(format!(
        "WRONG WAY: {}the path turns the spindle {turns} where the process means {meant}: forces point as those of the process, and up is down milling there",
        of_line(line)
    ))
}

/// What is to be said of a cut that is taken from the process, wherever the tool is; `taken` says of every station whether it is.
fn about_engagement(stations: &[Station], taken: &[bool], milling: &Milling) -> Vec<String> {
    let engagement = &milling.engagement;
    let (depth, entry, exit) = (engagement.depth(), engagement.entry(), engagement.exit());
    if !taken.contains(&true) {
        return Vec::new();
    }
    let width = milling.diameter / 2.0 * (1.0 - (exit - entry).cos());
    let mm = |metres: f64| (metres * 1e6).round() / 1e3;
    let mut found = vec![format!(
        "the cut of the process, {} mm deep and {} mm wide, is taken on every feed move, in air too; a stock (stock-mm) tells what is cut where",
        mm(depth),
        mm(width)
    )];
    if exit - entry > PI - NARROW {
        // No cut is wider than a slot.
        return found;
    }
    let begins = |i: &usize| taken[*i] && (*i == 0 || !taken[*i - 1] || stations[*i].is_fresh);
    let turns = |i: &usize| {
        let directions = [*i - 1, *i].map(|i| stations[i].sample.direction.filter(|_| taken[i]));
        let [Some(before), Some(after)] = directions else { return false };
        !stations[*i].is_fresh && before.dot(&after) < SHARP.cos()
    };
    let mut warn = |at: Vec<usize>, what: &str, why: &str| {
        let Some(first) = at.first() else { return };
        let line = of_line(stations[*first].sample.line);
        let times = if at.len() == 1 { "once".into() } else { format!("{} times", at.len()) };
        found.push(format!("WIDER CUTS: {line}{times} {what}: {why}, under more force than is computed"));
    };
    let all = || 0..stations.len();
    warn(
        all().filter(begins).collect(),
        "a cut begins",
        "where that is inside the material the mill cuts in its full width",
    );
    warn(
        all().skip(1).filter(turns).collect(),
        "the feed turns by more than 30 deg",
        "in an inside corner the mill cuts wider",
    );
    found
}

/// What of a mill is in the stock at every sample, and how often something is cut at none of them.
fn through(
    stock: &mut Stock,
    (moves, steps): (&[Move], &Steps),
    milling: &Milling,
    remarks: &mut Vec<String>,
    watch: Watch,
) -> Result<(Vec<Option<Engaged>>, usize), ForcedError> {
    let (mut found, mut feeding, mut in_air, mut plunging, mut steep) = (Vec::new(), 0, 0, 0, 0);
    let mut each = |sample: &Sample, engaged: Option<Engaged>| {
        let falls = sample.direction.filter(|way| sample.is_cutting && way.z < 0.0).map(|way| way.xy().norm());
        let goes_down = falls.is_some_and(|across| across < STRAIGHT_DOWN);
        feeding += usize::from(sample.is_cutting);
        plunging += usize::from(goes_down);
        steep += usize::from(!goes_down && engaged.is_some() && falls.is_some_and(|across| across < STEEP.cos()));
        in_air += usize::from(sample.is_cutting && engaged.is_none() && !goes_down);
        found.push(engaged);
    };
    let Through { rapid, between } = stock.follow(moves, steps, milling.diameter / 2.0, &mut each, watch)?;
    remarks.extend(rapid.map(|line| format!("line {line}: a rapid move goes through the stock")));
    let mut tell = |count: usize, what: &str| remarks.extend((0 < count).then(|| format!("{count} {what}")));
    tell(plunging, "samples feed straight down: no force of a mill is known there, none is taken");
    tell(steep, "samples feed down by more than 30 deg: what the end of the mill cuts there is not in the force");
    tell(
        between,
        "times something of the stock is cut between two samples and at neither: a smaller step (step-mm) tells it",
    );
    if feeding < 2 * in_air {
        tell(
            in_air,
            &format!("of {feeding} samples that feed meet no stock: is the block where the work is, and in mm?"),
        );
    }
    Ok((found, between))
}

/// What pushes, and how a mill cuts.
type Cutting = (Acting, Option<Arc<StationCut>>);

/// The mean force of a process.
fn cutting(process: &Process) -> Result<Cutting, CuttingError> {
    let found = process.mean()?;
    let acting = found.map_or_else(
        || Acting::Any(if let Law::Worst(newtons) = process.law { newtons } else { 0.0 }),
        |(force, moment)| Acting::Known { force, moment },
    );
    let Law::Milling(milling) = &process.law else { return Ok((acting, None)) };
    let of_mill = |changes| Arc::new(StationCut { engagement: milling.engagement.clone(), changes });
    Ok((acting, process.changes()?.map(of_mill)))
}

/// A mill of a process at what of it is in the stock; `across` is how much of the feed goes across the axis, which makes the chip.
fn in_stock(process: &Process, engaged: &Engaged, across: f64) -> Result<Cutting, CuttingError> {
    let Law::Milling(milling) = &process.law else { return cutting(process) };
    let engagement = engaged.engagement(across * milling.engagement.feed_per_tooth, process.is_clockwise);
    cutting(&Process { law: Law::Milling(Milling { engagement, ..*milling }), ..process.clone() })
}

/// A mill of a process at the depth and width that a path gives, where it gives any.
fn as_given(process: &Process, given: &Given) -> Option<Result<Cutting, CuttingError>> {
    let Law::Milling(milling) = &process.law else { return None };
    if given.axial_depth.is_none() && given.radial_width.is_none() {
        return None;
    }
    if [given.axial_depth, given.radial_width].contains(&Some(0.0)) {
        return Some(Ok((Acting::Known { force: [0.0; 3], moment: 0.0 }, None)));
    }
    if let Some(width) = given.radial_width.filter(|width| milling.diameter * (1.0 + WIDER) < *width) {
        let expected = "no more than the diameter of the tool";
        return Some(Err(CuttingError::Value { what: "ae_mm", value: (width * 1e9).round() / 1e6, expected }));
    }
    let usual = &milling.engagement;
    let depth = given.axial_depth.unwrap_or(usual.depth());
    let angles = given.radial_width.map_or([usual.entry(), usual.exit()], |width| {
        // The side on which the material is stays that of the process; a slot that becomes narrower is one of up milling.
        let side = if 0.0 < usual.entry() { Side::Down } else { Side::Up };
        Engagement::angles(side, width, milling.diameter)
    });
    let engagement = Engagement::at_depth(depth, angles, usual.feed_per_tooth);
    Some(cutting(&Process { law: Law::Milling(Milling { engagement, ..*milling }), ..process.clone() }))
}

/// A force that was measured where the tool is, after so many s of feeding.
fn as_measured(measured: &Measured, sample: &Sample, time: Option<f64>) -> Result<Acting, ForcedError> {
    let line = sample.line;
    let (at, unit) = match measured.along {
        Along::Way => (sample.way, "m"),
        Along::Time => (time.ok_or(ForcedError::NoTime { line })?, "s"),
    };
    let ends = measured.ends();
    let inside = Some(at.clamp(ends[0], ends[1])).filter(|inside| (inside - at).abs() <= ROUNDED);
    let beyond = ForcedError::Beyond { line, at, ends, unit };
    let (force, moment) = inside.and_then(|inside| measured.at(inside)).ok_or(beyond)?;
    let force = match measured.axes {
        MeasuredAxes::Cut => force,
        MeasuredAxes::Part => (cutting_axes(sample).transpose() * Vector3::from(force)).into(),
    };
    Ok(Acting::Known { force, moment })
}

/// The force that a path gives in its own axes, along those of the cut.
fn along_cut(sample: &Sample, force: &Vector3<f64>) -> Acting {
    Acting::Known { force: (cutting_axes(sample).transpose() * force).into(), moment: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::read_process;
    use crate::toolpath::{Builtin, Course, Format, ReadOptions, ToolPose, read};

    const SLOT: &str = "[tool]\ndiameter_mm = 16\nteeth = 4\n[material]\nktc_n_per_mm2 = 767.01\nkrc_n_per_mm2 = 168.8\n\
        kac_n_per_mm2 = 222\nkte_n_per_mm = 27.7\nkre_n_per_mm = 26.6\nkae_n_per_mm = 0.7\n[engagement]\nap_mm = 2\n\
        ae_mm = 16\nside = \"slot\"\nfeed_per_tooth_mm = 0.1\n";

    fn process() -> Process {
        read_process(SLOT, "slot.toml").unwrap().process
    }

    fn force(station: &Station) -> [f64; 3] {
        station.acting.unwrap().force().unwrap()
    }

    /// A slot by hand: `F_x = -N a K_rc c / 4 - N a K_re / pi`, `F_y = N a K_tc c / 4 + N a K_te / pi`, `F_z = N a K_ac c / pi + N a K_ae / 2`.
    #[test]
    fn a_slot_pushes_as_four_lines_by_hand_say() {
        let moves = "line:0.1".parse::<Builtin>().unwrap().moves(Some(0.01));
        let found = forced(&moves, &Steps::USUAL, &Forcing::Process(process()), None, Watch::nobody()).unwrap();
        let pi = std::f64::consts::PI;
        let expected = [
            -(4.0 * 2.0 * 168.8 * 0.1 / 4.0) - 4.0 * 2.0 * 26.6 / pi,
            4.0 * 2.0 * 767.01 * 0.1 / 4.0 + 4.0 * 2.0 * 27.7 / pi,
            -4.0 * 2.0 * 222.0 * 0.1 / pi - 4.0 * 2.0 * 0.7 / 2.0,
        ];
        for station in &found.stations {
            assert!(
                (0..3).all(|i| (force(station)[i] - expected[i]).abs() < 1e-9),
                "{:?} {expected:?}",
                force(station)
            );
        }
        let [remark] = found.remarks.as_slice() else { panic!("{:?}", found.remarks) };
        assert!(remark.contains("2 mm deep and 16 mm wide, is taken on every feed move, in air too"), "{remark}");
    }

    /// A path that begins twice, turns once sharply and once not: counted by hand, and only where the cut is that of the process.
    #[test]
    fn a_cut_that_may_be_wider_than_given_is_warned_of_where_it_begins_and_turns() {
        let pose = |[x, y]: [f64; 2]| ToolPose { tip: Vector3::new(x, y, 0.0), axis: Vector3::z() };
        let one = |line, kind, from, to, given| Move {
            line,
            kind,
            from: pose(from),
            to: pose(to),
            course: Course::Line,
            feed: Some(0.01),
            normals: None,
            given,
        };
        let (feed, rapid, nothing) = (MoveKind::Feed, MoveKind::Rapid, Given::default());
        let down = Given { axial_depth: Some(1e-3), radial_width: Some(2e-3), ..nothing };
        let path = |given: Given| {
            [
                one(1, rapid, [0.0, -0.1], [0.0, 0.0], nothing),
                one(2, feed, [0.0, 0.0], [0.1, 0.0], given),
                // 20 deg are no corner, 31 deg more are.
                one(3, feed, [0.1, 0.0], [0.194, 0.0342], given),
                one(4, feed, [0.194, 0.0342], [0.26, 0.115], given),
                one(5, rapid, [0.26, 0.115], [0.0, 0.2], nothing),
                one(6, feed, [0.0, 0.2], [0.0, 0.3], given),
            ]
        };
        let remarks_of = |ae: f64, side: &str, given: Given| {
            let narrow = SLOT.replace("ae_mm = 16", &format!("ae_mm = {ae}")).replace("\"slot\"", &format!("{side:?}"));
            let process = Forcing::Process(read_process(&narrow, "narrow.toml").unwrap().process);
            forced(&path(given), &Steps::USUAL, &process, None, Watch::nobody()).unwrap().remarks
        };
        for side in ["up", "down"] {
            let remarks = remarks_of(4.0, side, nothing);
            let starting =
                |start: &str| remarks.iter().filter(|remarks_of| remarks_of.contains(start)).collect::<Vec<_>>();
            let [cut] = starting("the cut of the process")[..] else { panic!("{remarks:?}") };
            assert!(cut.contains("2 mm deep and 4 mm wide, is taken on every feed move, in air too"), "{cut}");
            let [begins, turns] = starting("WIDER CUTS")[..] else { panic!("{remarks:?}") };
            assert!(begins.starts_with("WIDER CUTS: line 2: 2 times a cut begins"), "{begins}");
            assert!(turns.starts_with("WIDER CUTS: line 4: once the feed turns by more than 30 deg"), "{turns}");
        }
        // No cut is wider than a slot, and what the path says itself is not the process's.
        let slot = remarks_of(16.0, "slot", nothing);
        assert!(
            slot.iter().any(|remarks_of| remarks_of.contains("in air too"))
                && !slot.iter().any(|remarks_of| remarks_of.contains("WIDER"))
        );
        let given = remarks_of(4.0, "up", down);
        assert!(
            !given.iter().any(|remarks_of| remarks_of.contains("in air too") || remarks_of.contains("WIDER")),
            "{given:?}"
        );
    }

    #[test]
    fn a_spindle_that_turns_otherwise_than_the_process_means_is_told() {
        let process = format!("spindle_rpm = 12000\n{SLOT}");
        let process = Forcing::Process(read_process(&process, "slot.toml").unwrap().process);
        let remarks = |rpm: Option<f64>| {
            let mut moves = "line:0.1".parse::<Builtin>().unwrap().moves(Some(0.01));
            moves[0].given.spindle = rpm.map(|rpm| rpm * TAU / 60.0);
            forced(&moves, &Steps::USUAL, &process, None, Watch::nobody()).unwrap().remarks.join("\n")
        };
        let told = "the path turns the spindle at 8000 rpm where the process means 12000";
        assert!(remarks(Some(8000.0)).contains(told), "{}", remarks(Some(8000.0)));
        for rpm in [None, Some(12000.0)] {
            assert!(!remarks(rpm).contains("spindle"), "{}", remarks(rpm));
        }
    }

    #[test]
    fn a_mill_that_the_path_turns_the_other_way_is_told() {
        let other = "rotation = \"counter-clockwise\"\n";
        let (left, right) = (
            "counter-clockwise where the process means clockwise",
            "clockwise where the process means counter-clockwise",
        );
        for (process, says, told) in [
            ("", "M3", None),
            ("", "M5", None),
            ("", "M4", Some(left)),
            (other, "M3", Some(right)),
            (other, "M4", None),
            ("", "SPINDL/RPM,8000,CLW", None),
            ("", "SPINDL/RPM,8000,CCLW", Some(left)),
        ] {
            let process = Forcing::Process(read_process(&format!("{process}{SLOT}"), "slot.toml").unwrap().process);
            let (format, text) = if says.starts_with('M') {
                (Format::GCode, format!("G21 G90\nG0 X0 Y0 Z0\n{says}\nG1 X100.0 F600\nM30\n"))
            } else {
                (Format::Apt, format!("UNITS/MM\n{says}\nFEDRAT/600,MMPM\nGOTO/0,0,0\nGOTO/100,0,0\nFINI\n"))
            };
            let mut moves = Vec::new();
            let mut take = |one: &Move| moves.push(*one);
            read(&mut text.as_bytes(), "turns", format, &ReadOptions::default(), &mut take, &mut |_| Ok(())).unwrap();
            let remarks = forced(&moves, &Steps::USUAL, &process, None, Watch::nobody()).unwrap().remarks;
            let turning = remarks.iter().find(|remark| remark.contains("turns the spindle"));
            match told {
                None => assert_eq!(turning, None, "{says}"),
                Some(told) => assert!(turning.is_some_and(|remark| remark.contains(told)), "{says}: {remarks:?}"),
            }
        }
    }

    /// A wall on the left of a tool that turns left is climbed, and a ramp has the chips of its feed across: the force of the process that says so.
    #[test]
    fn a_stock_tells_the_side_of_a_tool_that_turns_left_and_the_chips_of_a_ramp() {
        let law = |is_clockwise: bool, side: Side, depth: f64, share: f64| {
            let Law::Milling(milling) = process().law else { unreachable!("a mill") };
            let engagement =
                Engagement::at_depth(depth, Engagement::angles(side, 0.004, milling.diameter), share * 1e-4);
            Process { is_clockwise, law: Law::Milling(Milling { engagement, ..milling }), ..process() }
        };
        // The block reaches from the axis' left by 4 mm into the rim, x along it.
        let along = |drop: f64| {
            let pose = |x: f64, z: f64| ToolPose { tip: Vector3::new(x, -0.004, z), axis: Vector3::z() };
            let (from, to) = (pose(0.03, -0.002), pose(0.07, -0.002 - drop));
            let feed = Some(0.01);
            [Move {
                line: 1,
                kind: MoveKind::Feed,
                from,
                to,
                course: Course::Line,
                feed,
                normals: None,
                given: Given::default(),
            }]
        };
        for (is_clockwise, side) in [(true, Side::Up), (false, Side::Down)] {
            let mut stock = Stock::block([0.0, 0.0, -0.03], [0.1, 0.1, 0.0], 5e-5).unwrap();
            let forcing = Forcing::Process(Process { is_clockwise, ..process() });
            let found = forced(&along(0.0), &Steps::USUAL, &forcing, Some(&mut stock), Watch::nobody()).unwrap();
            let (expected, _) = law(is_clockwise, side, 0.002, 1.0).mean().unwrap().unwrap();
            for (a, b) in force(&found.stations[2]).iter().zip(expected) {
                assert!((a - b).abs() < 0.02 * expected[1].abs(), "{a} is not {b} of {expected:?}");
            }
        }
        // 30 deg down: at its end 23 mm deeper.
        let mut stock = Stock::block([0.0, 0.0, -0.03], [0.1, 0.1, 0.0], 5e-5).unwrap();
        let (fall, forcing) = ((PI / 6.0 - 1e-3).tan(), Forcing::Process(process()));
        let found = forced(&along(0.04 * fall), &Steps::USUAL, &forcing, Some(&mut stock), Watch::nobody()).unwrap();
        let last = found.stations.last().unwrap();
        let across = (PI / 6.0 - 1e-3).cos();
        let (expected, _) = law(true, Side::Up, 0.002 + 0.04 * fall, across).mean().unwrap().unwrap();
        for (a, b) in force(last).iter().zip(expected) {
            assert!((a - b).abs() < 0.03 * expected[1].abs(), "{a} is not {b} of {expected:?}");
        }
    }

    /// Along a square: over the way in the axes of the cut, over time in those of the part; by hand.
    #[test]
    fn a_measured_force_acts_where_and_when_it_was_measured() {
        use crate::cutting::MeasuredForce;
        use crate::toolpath::{MoveKind, ToolPose};
        // Four sides of 0.1 m at 0.05 m/s.
        let moves = "rect:0.1x0.1".parse::<Builtin>().unwrap().moves(Some(0.05));
        let of = |along, axes, end: f64| {
            let row = |at, force| MeasuredForce { at, force, moment: 1.5 };
            let rows = vec![row(0.0, [0.0, 0.0, 7.0]), row(end, [100.0 * end, 0.0, 7.0])];
            let law = Law::Measured(Measured::new(along, axes, rows).unwrap());
            let process = Process { spindle: None, is_clockwise: true, law };
            // Fine enough for samples near the ends.
            forced(&moves, &Steps { longest: 2e-4, ..Steps::USUAL }, &Forcing::Process(process), None, Watch::nobody())
        };
        for station in of(Along::Way, MeasuredAxes::Cut, 0.399_2).unwrap().stations {
            // The table ends 0.8 mm before the path does, by rounding.
            let expected = [100.0 * station.sample.way.min(0.399_2), 0.0, 7.0];
            assert!((0..3).all(|i| (force(&station)[i] - expected[i]).abs() < 1e-9), "{station:?}");
        }
        let timed = of(Along::Time, MeasuredAxes::Part, 8.0).unwrap();
        assert!(timed.remarks[0].contains("counts while the tool feeds"));
        for station in timed.stations {
            // x of the part along the direction of the feed, and to its left.
            let (way, size) = (station.sample.direction.unwrap(), 100.0 * station.sample.way / 0.05);
            let expected = [size * way.x, -size * way.y, 7.0];
            assert!((0..3).all(|i| (force(&station)[i] - expected[i]).abs() < 1e-6), "{station:?} {expected:?}");
        }
        // Between two sides the tool is led away and back, which takes no time of feeding.
        let mut led = moves.clone();
        let (at, up) = (led[1].to, ToolPose { tip: led[1].to.tip + Vector3::z(), ..led[1].to });
        led.insert(2, Move { kind: MoveKind::Rapid, from: at, to: up, ..led[1] });
        led.insert(3, Move { kind: MoveKind::Rapid, from: up, to: at, ..led[1] });
        let row = |at| MeasuredForce { at, force: [at, 0.0, 0.0], moment: 0.0 };
        let law = Law::Measured(Measured::new(Along::Time, MeasuredAxes::Cut, vec![row(0.0), row(8.0)]).unwrap());
        let process = Process { spindle: None, is_clockwise: true, law };
        let found = forced(&led, &Steps::USUAL, &Forcing::Process(process), None, Watch::nobody()).unwrap().stations;
        let last = found.last().unwrap();
        assert!((last.sample.way - 2.4).abs() < 1e-9 && (force(last)[0] - 8.0).abs() < 1e-9, "{last:?}");
        let short = of(Along::Way, MeasuredAxes::Cut, 0.3).unwrap_err().to_string();
        assert!(short.contains("measured from 0.000000 to 0.300000 m, and the tool is at 0.3"), "{short}");
        let rows = vec![
            MeasuredForce { at: 0.0, force: [0.0; 3], moment: 0.0 },
            MeasuredForce { at: 9.0, force: [0.0; 3], moment: 0.0 },
        ];
        let law = Law::Measured(Measured::new(Along::Time, MeasuredAxes::Cut, rows).unwrap());
        let timeless = "rect:0.1x0.1".parse::<Builtin>().unwrap().moves(None);
        let process = Process { spindle: None, is_clockwise: true, law };
        let refused = forced(&timeless, &Steps::USUAL, &Forcing::Process(process), None, Watch::nobody());
        assert!(matches!(refused, Err(ForcedError::NoTime { .. })), "{refused:?}");
    }

    /// What the path gives overrules the process: half the depth is half the force, and a force is turned into the axes of the cut.
    #[test]
    fn what_the_path_gives_overrules_the_process() {
        let mut moves = "rect:0.1x0.1".parse::<Builtin>().unwrap().moves(Some(0.01));
        moves[1].given.axial_depth = Some(1e-3);
        moves[2].given.force = Some(Vector3::new(10.0, 20.0, 30.0));
        moves[3].given.radial_width = Some(4e-3);
        let found = forced(&moves, &Steps::USUAL, &Forcing::Process(process()), None, Watch::nobody()).unwrap();
        let of =
            |one: &Move| force(found.stations.iter().find(|it| it.sample.direction == one.direction(0.5)).unwrap());
        let [whole, half, turned, narrow] = [0, 1, 2, 3].map(|i| of(&moves[i]));
        assert!((0..3).all(|i| (whole[i] - 2.0 * half[i]).abs() < 1e-9));
        let feed = moves[2].direction(0.5).unwrap();
        let left = Vector3::z().cross(&feed);
        let part = Vector3::new(10.0, 20.0, 30.0);
        assert!((turned[0] - part.dot(&feed)).abs() < 1e-12 && (turned[1] - part.dot(&left)).abs() < 1e-12);
        assert!((turned[2] - 30.0).abs() < 1e-12);
        assert!(0.5 * whole[2] < narrow[2] && narrow[2] < 0.0);
    }

    /// Along the edge of a block half of the mill is in the work, beyond it nothing: by hand.
    #[test]
    fn in_a_stock_half_a_mill_pushes_as_half_and_air_not_at_all() {
        let moves = "line:0.2".parse::<Builtin>().unwrap().moves(Some(0.01));
        let (from, to) = (moves[0].from.tip, moves[0].to.tip);
        let y = from.y;
        // The line runs along x; to its left the block, its edge under the axis, 2 mm high, ending in the middle.
        let middle = f64::midpoint(from.x, to.x);
        let mut stock =
            Stock::block([from.x - 0.05, y, from.z - 0.01], [middle, y + 0.05, from.z + 2e-3], 2e-4).unwrap();
        let found =
            forced(&moves, &Steps::USUAL, &Forcing::Process(process()), Some(&mut stock), Watch::nobody()).unwrap();
        let pi = std::f64::consts::PI;
        // Left of the feed the tooth enters, seen clockwise: from 0 to 90 deg. Mean by hand: N a / (2 pi) times the integral.
        let n_a = 4.0 * 2.0;
        let expected = n_a / (2.0 * pi) * ((0.5 - 0.0) * -767.01 * 0.1 - 27.7 - 168.8 * 0.1 * pi / 4.0 - 26.6);
        for station in &found.stations {
            let x = station.sample.pose.tip.x;
            match station.acting {
                None => assert!(middle - 1e-3 < x, "{x}"),
                Some(acting) if x < middle - 0.02 && from.x + 1e-3 < x => {
                    let [feed, ..] = acting.force().unwrap();
                    // The rim is looked at in cells of 0.2 mm of 8 mm.
                    assert!((feed / expected - 1.0).abs() < 0.05, "{feed} {expected}");
                }
                Some(_) => {}
            }
        }
        assert!(found.stations.iter().any(|station| station.acting.is_none()));
        let same = Forcing::Same(Acting::Any(5.0));
        assert_eq!(forced(&moves, &Steps::USUAL, &same, Some(&mut stock), Watch::nobody()), Err(ForcedError::NoMill));
    }
}
