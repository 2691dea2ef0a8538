//! From readings to a system of equations, its solution, and what that says of each spring.

use nalgebra::{DMatrix, DVector, Matrix6, Vector3, Vector6};

use super::compensated::Compensated;
use super::model::Springs;
use super::outlying::outlying;
use super::regression::{Solution, Spread, System, solve, spread, unseen};
use super::robust::{ROUNDS, Robust, robust};
use super::springs::{Bent, Spring, beyond, ranges};
use super::written::{Fitness, robot_with};
use super::{
    Axes, Estimate, Estimator, HUBER_BOUND, Identification, IdentifyError, MOST_RELATIVE_ERROR, Options, Unknown,
    diagnostics, rms, student,
};
use crate::catalogue::measurements::Reading;
use crate::parallel;
use crate::prior::by_size;
use crate::robot::{Arm, Robot};
use crate::watch::Watch;

/// An identification, how well its values are known, and how much each reading counted.
pub(super) struct Fitted {
    pub found: Identification,
    pub spread: Spread,
    pub weights: Vec<f64>,
}

/// What is known of the readings before anything is solved.
pub(super) struct Work<'a> {
    pub robot: &'a Robot,
    pub readings: &'a [Reading],
    pub springs: &'a [Spring],
    /// Displacements per compliance, rows not weighted, without a compensator.
    pub system: System,
    /// A compensator beside drive 2.
    compensated: Option<Compensated>,
    /// From where to where joint 2 stood in each region, as reported, rad.
    regions: Vec<[f64; 2]>,
    /// By its noise, mean square 1.
    pub weights: Vec<f64>,
    /// Of the noise that the table gives, m.
    pub noise: Option<f64>,
    /// What every spring has where nothing is identified.
    pub assumed: Vec<f64>,
    /// Who waits for it.
    pub watch: Watch<'a>,
}

impl<'a> Work<'a> {
    pub(super) fn of(
        robot: &'a Robot,
        readings: &'a [Reading],
        springs: &'a [Spring],
        options: &Options,
        watch: Watch<'a>,
    ) -> Result<Self, IdentifyError> {
        let Arm::SixAxis { drives, .. } = &robot.arm else { return Err(IdentifyError::Planar(robot.name.clone())) };
        let regions = ranges(readings, springs)?;
        // Markers of one posture follow one another.
        let runs: Vec<&[Reading]> = readings.chunk_by(|one, next| one.q == next.q).collect();
        let rows = |run: &&[Reading]| {
            watch.go_on()?;
            let bent = Bent::at(robot, &run[0].q)?;
            Ok::<Vec<Rows>, IdentifyError>(
                run.iter().map(|reading| Rows::of(reading, &bent, springs, &regions, options)).collect(),
            )
        };
        let rows = parallel::try_each(&runs, rows)?;
        let mut a = DMatrix::zeros(3 * readings.len(), springs.len());
        let mut y = DVector::zeros(3 * readings.len());
        for (i, rows) in rows.iter().flatten().enumerate() {
            for (j, column) in rows.columns.iter().enumerate() {
                a.fixed_view_mut::<3, 1>(3 * i, j).copy_from(column);
            }
            y.fixed_rows_mut::<3>(3 * i).copy_from(&rows.moved);
        }
        let joint_2: Vec<(usize, f64)> = rows.iter().flatten().filter_map(|rows| rows.joint_2).collect();
        let sigmas: Vec<f64> = readings.iter().filter_map(|reading| reading.sigma).collect();
        let noise = (sigmas.len() == readings.len()).then(|| {
            let mean = sigmas.iter().map(|sigma| sigma.powi(-2)).sum::<f64>() / sigmas.len() as f64;
            mean.sqrt().recip()
        });
        let weight = |reading: &Reading| noise.zip(reading.sigma).map_or(1.0, |(noise, sigma)| noise / sigma);
        let of_spring =
            |what: fn(&crate::drive::GravityCompensator) -> f64| drives.compensator.as_ref().map_or(0.0, what);
        let assumed = springs.iter().map(|spring| match spring {
            Spring::Drive(drive) => drives.compliance.0[*drive],
            Spring::Region(_) => drives.compliance.0[1],
            Spring::Compensator => of_spring(|spring| spring.stiffness),
            Spring::Preload => of_spring(|spring| spring.stiffness * spring.free_length),
            Spring::Base | Spring::Tool => 0.0,
        });
        Ok(Self {
            robot,
            readings,
            springs,
            system: System { a, y },
            compensated: drives.compensator.as_ref().map(|found| Compensated::of(found, springs, &joint_2)),
            regions,
            weights: readings.iter().map(weight).collect(),
            noise,
            assumed: assumed.collect(),
            watch,
        })
    }

    /// The system that is linear about some values: itself, where there is no compensator.
    pub(super) fn about(&self, values: &[f64]) -> Result<System, IdentifyError> {
        let mut system = self.system.clone();
        if let Some(compensated) = &self.compensated {
            if let Some(i) = compensated.unheld(values) {
                return Err(IdentifyError::Unstable { row: self.readings[i].row, robot: self.robot.name.clone() });
            }
            compensated.about(values, &mut system);
        }
        Ok(system)
    }

    /// With columns of a compensator, which have other units, as long as the longest of a compliance.
    fn comparable(&self, mut system: System) -> System {
        let lengths: Vec<f64> = system.a.column_iter().map(|column| column.norm()).collect();
        let of_compliances = self.springs.iter().zip(&lengths).filter(|(spring, _)| spring.is_compliance());
        let longest = of_compliances.map(|(_, length)| *length).fold(0.0, f64::max);
        for (i, length) in lengths.iter().enumerate().filter(|(_, length)| 0.0 < **length) {
            if !self.springs[i].is_compliance() {
                system.a.column_mut(i).scale_mut(longest / length);
            }
        }
        system
    }

    /// Solves for the springs that are not held, all rows weighted.
    fn solved(&self, held: &[Option<f64>], weights: &[f64]) -> Result<(System, Solution), IdentifyError> {
        const STEPS: usize = 60;
        let start = |(held, assumed): (&Option<f64>, &f64)| held.unwrap_or(*assumed);
        let mut values: Vec<f64> = held.iter().zip(&self.assumed).map(start).collect();
        let unknowns: Vec<usize> = (0..held.len()).filter(|&i| held[i].is_none()).collect();
        for _ in 0..STEPS {
            self.watch.go_on()?;
            let system = self.about(&values)?.weighted(weights).holding(held);
            let solution = solve(&system).ok_or(IdentifyError::NotFound)?;
            let Some(compensated) = &self.compensated else { return Ok((system, solution)) };
            let target = values_of(&unknowns, &solution.values, held);
            let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= SETTLED * a.abs().max(b.abs());
            if values.iter().zip(&target).all(is_near) {
                return Ok((system, solution));
            }
            values = compensated.towards(&values, &target).ok_or(IdentifyError::NotFound)?;
        }
        Err(IdentifyError::NotFound)
    }

    /// Huber's estimate of the springs that are not held, from least squares on; and which readings are outliers. Beside a compensator
    /// the system is made anew about what is found, until that stays.
    fn robust(
        &self,
        held: &[Option<f64>],
        (mut system, plain): (System, &Solution),
    ) -> Result<(Robust, Vec<bool>), IdentifyError> {
        const STEPS: usize = 60;
        /// Less than this share of a value is the search for the one system.
        const NEAR: f64 = 1e-7;
        let unknowns: Vec<usize> = (0..held.len()).filter(|&i| held[i].is_none()).collect();
        let mut values = values_of(&unknowns, &plain.values, held);
        for step in 1.. {
            self.watch.go_on()?;
            let found = robust(&system, HUBER_BOUND).ok_or(IdentifyError::NotFound)?;
            let target = values_of(&unknowns, &found.values, held);
            let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= NEAR * a.abs().max(b.abs());
            let is_there = self.compensated.is_none() || values.iter().zip(&target).all(is_near);
            let towards = |of: &Compensated| of.towards(&values, &target);
            let next = self.compensated.as_ref().filter(|_| step < STEPS).and_then(towards);
            let Some(next) = next.filter(|_| !is_there) else {
                let is_out = outlying(&system, &found);
                return Ok((Robust { is_settled: found.is_settled && is_there, ..found }, is_out));
            };
            values = next;
            system = self.about(&values)?.weighted(&self.weights).holding(held);
        }
        Err(IdentifyError::NotFound)
    }

    /// How well the values of a solution are known.
    fn spread(&self, solution: &Solution) -> Result<Spread, IdentifyError> {
        let postures: Vec<usize> = self.readings.iter().map(|reading| reading.posture).collect();
        spread(solution, &postures).ok_or(IdentifyError::TooFew {
            readings: self.readings.len(),
            unknowns: self.springs.len(),
            least: self.springs.len() / 3 + 1,
        })
    }

    pub(super) fn identification(&self, options: &Options, remarks: &[String]) -> Result<Fitted, IdentifyError> {
        let count = self.springs.len();
        let groups = unseen(&self.comparable(self.about(&self.assumed)?));
        let mut held: Vec<Option<f64>> = vec![None; count];
        groups.iter().flatten().for_each(|&i| held[i] = Some(self.assumed[i]));
        if held.iter().all(Option::is_some) {
            let is_of_sums = groups.iter().any(|group| 1 < group.len());
            return Err(if is_of_sums { IdentifyError::OnlySums } else { IdentifyError::NothingSeen });
        }
        // Springs of which only a sum shows are held at what is assumed; those that nothing shows add nothing.
        let (weighted, plain) = self.solved(&held, &self.weights)?;
        if plain.free.is_empty() {
            return Err(IdentifyError::Against);
        }
        let (robust, is_out) = self.robust(&held, (weighted, &plain))?;
        let weights = match options.estimator {
            Estimator::LeastSquares => self.weights.clone(),
            Estimator::Huber => {
                self.weights.iter().zip(&robust.weights).map(|(noise, fit)| noise * fit.sqrt()).collect()
            }
        };
        let solution = match options.estimator {
            Estimator::LeastSquares => plain,
            Estimator::Huber => self.solved(&held, &weights)?.1,
        };
        if solution.free.is_empty() {
            return Err(IdentifyError::Against);
        }
        let spread = self.spread(&solution)?;
        let unknowns: Vec<usize> = (0..count).filter(|&i| held[i].is_none()).collect();
        let mut estimates = self.estimates(&unknowns, &solution, &spread, &robust, &groups);
        let (used, own) = self.used(&mut estimates, &weights, (&solution, &spread))?;
        let fit = self.fit_of(&unknowns, (&solution, &spread), (&robust, &is_out), &weights);
        let after_used = rms(&own);
        let before = rms(self.system.y.as_slice());
        let fitness = Fitness { postures: fit.postures, moved: before, residual: after_used, left_out: fit.left_out };
        let written = robot_with(self.robot, &estimates, &used, options, fitness);
        let mut remarks = remarks.to_vec();
        remarks.extend(self.odd_postures());
        remarks.extend((!robust.is_settled).then(|| {
            format!("Huber's estimate still changed after {ROUNDS} rounds: its values, and the rows that do not fit, are near, not exact")
        }));
        remarks.extend(unlike_its_size(self.robot, &estimates));
        let residual = self.residual(&values_of(&unknowns, &solution.values, &held));
        remarks.extend(diagnostics::little_explained(self.system.y.as_slice(), &residual, &is_out));
        let found = Identification {
            robot: written,
            estimator: options.estimator,
            before,
            after: rms(&residual),
            after_used,
            remarks,
            estimates,
            ..fit
        };
        Ok(Fitted { found, spread, weights })
    }

    /// What compliances leave of the displacements, m, not weighted.
    pub(super) fn residual(&self, values: &[f64]) -> Vec<f64> {
        let mut missed = &self.system.y - &self.system.a * DVector::from_column_slice(values);
        if let Some(compensated) = &self.compensated {
            compensated.add_to(&mut missed, values, &self.system);
        }
        missed.as_slice().to_vec()
    }

    fn estimates(
        &self,
        unknowns: &[usize],
        solution: &Solution,
        spread: &Spread,
        robust: &Robust,
        groups: &[Vec<usize>],
    ) -> Vec<Estimate> {
        let rows = 3 * self.readings.len();
        let postures = self.readings.iter().map(|reading| reading.posture).max().map_or(0, |last| last + 1);
        let quantile = |freedom: usize| student(freedom as f64);
        let (of_rows, of_postures) = (quantile(rows - solution.free.len()), quantile(postures.max(2) - 1));
        let estimate = |i: usize| {
            let spring = self.springs[i];
            let nothing = Estimate {
                spring,
                compliance: None,
                standard_error: None,
                interval: None,
                robust: None,
                unknown: None,
                used: self.assumed[i],
            };
            let Some(at) = unknowns.iter().position(|&known| known == i) else {
                return Estimate { unknown: Some(self.why_unseen(i, groups)), ..nothing };
            };
            let (value, robust) = (solution.values[at], robust.values[at]);
            let found = Estimate { compliance: Some(value), robust: Some(robust), ..nothing };
            let Some(free) = solution.free.iter().position(|&known| known == at) else {
                return Estimate { unknown: Some(Unknown::Rigid), ..found };
            };
            let (classical, by_posture) = (spread.classical[free], spread.by_posture[free]);
            if by_posture.is_infinite() {
                return Estimate { unknown: Some(Unknown::OnePosture), ..found };
            }
            let error = classical.max(by_posture);
            let half = (of_rows * classical).max(of_postures * by_posture);
            let relative = error / value;
            let unknown = (!(relative <= MOST_RELATIVE_ERROR)).then_some(Unknown::Uncertain(relative));
            let interval = Some([(value - half).max(0.0), value + half]);
            Estimate { standard_error: Some(error), interval, unknown, ..found }
        };
        (0..self.springs.len()).map(estimate).collect()
    }

    /// Why a spring is not seen.
    fn why_unseen(&self, i: usize, groups: &[Vec<usize>]) -> Unknown {
        let group = groups.iter().find(|group| group.contains(&i));
        if let Some(group) = group.filter(|group| 1 < group.len()) {
            return Unknown::OnlyWith(group.iter().copied().filter(|&other| other != i).collect());
        }
        if !self.springs[i].is_compliance() {
            return Unknown::NotTurned;
        }
        // A marker at the load point is moved wherever the load turns the spring.
        let turned = self.readings.iter().any(|reading| {
            let Ok(bent) = Bent::at(self.robot, &reading.q) else { return false };
            let at = bent.point(&reading.load_at);
            let along = bent.column(self.springs[i], (&reading.load.0, &at), &at);
            let others = self.springs.iter().map(|spring| bent.column(*spring, (&reading.load.0, &at), &at).norm());
            1e-9 * others.fold(0.0, f64::max) < along.norm()
        });
        if turned { Unknown::NotMoved } else { Unknown::NotTurned }
    }

    /// Solves again with all that is not identified held at what is assumed of it, until nothing more must be; what that leaves of the
    /// displacements, and the covariance.
    fn used(
        &self,
        estimates: &mut [Estimate],
        weights: &[f64],
        found: (&Solution, &Spread),
    ) -> Result<(Matrix6<f64>, Vec<f64>), IdentifyError> {
        let count = self.springs.len();
        loop {
            let held: Vec<Option<f64>> =
                (0..count).map(|i| estimates[i].unknown.is_some().then_some(self.assumed[i])).collect();
            let unknowns: Vec<usize> = (0..count).filter(|&i| held[i].is_none()).collect();
            if unknowns.is_empty() {
                return Ok((Matrix6::zeros(), self.residual(&self.assumed)));
            }
            let again;
            let (solution, spread) = if unknowns.len() == count {
                found
            } else {
                let (_, solution) = self.solved(&held, weights)?;
                let spread = self.spread(&solution)?;
                again = (solution, spread);
                (&again.0, &again.1)
            };
            let mut is_settled = true;
            for (at, &i) in unknowns.iter().enumerate() {
                let unknown = match solution.free.iter().position(|&free| free == at) {
                    None => Some(Unknown::Rigid),
                    Some(free) => {
                        let relative = spread.classical[free].max(spread.by_posture[free]) / solution.values[at];
                        (!(relative <= MOST_RELATIVE_ERROR)).then_some(Unknown::Uncertain(relative))
                    }
                };
                is_settled &= unknown.is_none();
                estimates[i].unknown = unknown;
                estimates[i].used = solution.values[at];
            }
            if !is_settled {
                estimates
                    .iter_mut()
                    .zip(&self.assumed)
                    .filter(|(one, _)| one.unknown.is_some())
                    .for_each(|(one, assumed)| one.used = *assumed);
                continue;
            }
            let errors: Vec<f64> = spread.classical.iter().zip(&spread.by_posture).map(|(a, b)| a.max(*b)).collect();
            let mut covariance = Matrix6::zeros();
            for (a, &i) in unknowns.iter().enumerate() {
                for (b, &j) in unknowns.iter().enumerate() {
                    if let (Spring::Drive(i), Spring::Drive(j)) = (self.springs[i], self.springs[j]) {
                        covariance[(i, j)] = errors[a] * errors[b] * spread.correlation[(a, b)];
                    }
                }
            }
            // Symmetric to the last bit.
            let covariance = Matrix6::from_fn(|i, j| covariance[(i.min(j), i.max(j))]);
            return Ok((covariance, self.residual(&values_of(&unknowns, &solution.values, &held))));
        }
    }

    /// Postures where the robot cannot be, by its limits.
    fn odd_postures(&self) -> Option<String> {
        /// So many rows are named.
        const MOST: usize = 6;
        let rows: Vec<String> = (self.readings.iter())
            .filter_map(|reading| {
                let joints = beyond(self.robot, reading);
                let names: Vec<String> = joints
                    .iter()
                    .map(|&joint| if joint == 0 { "angle between the links".into() } else { format!("joint {joint}") })
                    .collect();
                (!joints.is_empty()).then(|| format!("{} ({})", reading.row, names.join(", ")))
            })
            .collect();
        let more = if MOST < rows.len() { format!(" and {} more", rows.len() - MOST) } else { String::new() };
        let shown = rows.iter().take(MOST).cloned().collect::<Vec<_>>().join(", ");
        (!rows.is_empty()).then(|| {
            format!(
                "joint angles beyond the limits of {} in the rows {shown}{more}: are these the angles that it reports?",
                self.robot.name
            )
        })
    }

    /// Everything that is reported of a fit besides its values; what the caller knows is left at nothing.
    fn fit_of(
        &self,
        unknowns: &[usize],
        (solution, spread): (&Solution, &Spread),
        (robust, is_out): (&Robust, &[bool]),
        weights: &[f64],
    ) -> Identification {
        let count = self.springs.len();
        let mut correlation = DMatrix::identity(count, count);
        for (a, &i) in solution.free.iter().enumerate() {
            for (b, &j) in solution.free.iter().enumerate() {
                correlation[(unknowns[i], unknowns[j])] = spread.correlation[(a, b)];
            }
        }
        let postures = self.readings.iter().map(|reading| reading.posture).max().map_or(0, |last| last + 1);
        // Of compliances alone: other unknowns have other units.
        let compliances = self.springs.iter().filter(|spring| spring.is_compliance()).count();
        let system = System { a: self.system.a.columns(0, compliances).into_owned(), y: self.system.y.clone() };
        let (singular_values, least_seen) = diagnostics::seen(&system.weighted(&self.weights));
        let left_out: Option<Vec<f64>> = spread
            .left_out
            .iter()
            .enumerate()
            .map(|(row, missed)| missed.map(|missed| missed / weights[row / 3]))
            .collect();
        Identification {
            robot: self.robot.clone(),
            known: self.robot.clone(),
            estimator: Estimator::LeastSquares,
            model: Springs::Drives,
            tried: Vec::new(),
            regions: self.regions.clone(),
            posterior: None,
            estimates: Vec::new(),
            before: 0.0,
            after: 0.0,
            after_used: 0.0,
            left_out: left_out.map(|missed| rms(&missed)),
            noise_ratio: self.noise.map(|noise| spread.sigma / noise),
            singular_values,
            least_seen,
            correlation,
            residuals: diagnostics::residuals(
                self.readings,
                &self.system.y,
                solution,
                (spread, weights),
                &robust.ratios,
            ),
            outliers: diagnostics::outliers(self.readings, (&robust.ratios, is_out)),
            postures,
            remarks: Vec::new(),
        }
    }
}

/// What a reading says: three rows of the system.
struct Rows {
    /// Of each spring.
    columns: Vec<Vector3<f64>>,
    /// Along base axes, m.
    moved: Vector3<f64>,
    /// Which spring is drive 2, and the model angle of joint 2, rad.
    joint_2: Option<(usize, f64)>,
}

impl Rows {
    fn of(reading: &Reading, bent: &Bent, springs: &[Spring], regions: &[[f64; 2]], options: &Options) -> Self {
        let load = turned(&reading.load.0, options.load_axes, bent);
        let moved = if options.moved_axes == Axes::Flange { bent.turned(reading.moved) } else { reading.moved };
        let (at, marker) = (bent.point(&reading.load_at), bent.point(&reading.marker_at));
        let region = regions.iter().position(|[_, last]| reading.q[1] <= *last);
        let is_idle = |spring: Spring| matches!(spring, Spring::Region(other) if Some(other) != region);
        let column = |spring: &Spring| {
            if is_idle(*spring) { Vector3::zeros() } else { bent.column(*spring, (&load, &at), &marker) }
        };
        let is_second = |spring: &Spring| matches!(spring, Spring::Drive(1) | Spring::Region(_));
        let second = springs.iter().position(|spring| is_second(spring) && !is_idle(*spring));
        let joint_2 = second.map(|second| (second, bent.theta_2));
        Self { columns: springs.iter().map(column).collect(), moved, joint_2 }
    }
}

/// The values of a system with a compensator are found when none changes by more than this share of itself.
const SETTLED: f64 = 1e-11;

/// All values, those that are held among them.
fn values_of(unknowns: &[usize], found: &[f64], held: &[Option<f64>]) -> Vec<f64> {
    let mut values: Vec<f64> = held.iter().map(|held| held.unwrap_or(0.0)).collect();
    unknowns.iter().zip(found).for_each(|(&i, value)| values[i] = *value);
    values
}

/// A load along base axes.
fn turned(load: &Vector6<f64>, axes: Axes, bent: &Bent) -> Vector6<f64> {
    match axes {
        Axes::Base => *load,
        Axes::Flange => {
            let force = bent.turned(load.fixed_rows::<3>(0).into());
            let moment = bent.turned(load.fixed_rows::<3>(3).into());
            Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
        }
    }
}

/// All drives that are identified give way so many times as much, or as little, as those of robots of this size: a unit is more likely than such a robot.
fn unlike_its_size(robot: &Robot, estimates: &[Estimate]) -> Option<String> {
    const LEAST: usize = 3;
    const TIMES: f64 = 6.0;
    let Ok((usual, _)) = by_size(robot) else { return None };
    let known = estimates.iter().filter(|estimate| estimate.unknown.is_none());
    let ratios: Vec<f64> = known
        .filter_map(|estimate| match estimate.spring {
            Spring::Drive(i) => Some(estimate.used / usual[i]),
            _ => None,
        })
        .filter(|ratio| 0.0 < *ratio)
        .collect();
    if ratios.len() < LEAST {
        return None;
    }
    let mean = (ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64).exp();
    let (times, more) = match mean {
        mean if TIMES < mean && ratios.iter().all(|ratio| 1.0 < *ratio) => (mean, "more"),
        mean if mean < 1.0 / TIMES && ratios.iter().all(|ratio| *ratio < 1.0) => (1.0 / mean, "less"),
        _ => return None,
    };
    Some(format!(
        "the {} drives that are identified give way about {times:.1} times {more} than those of robots of this payload and reach: are the forces in N (1 kgf is 9.81 N, 1 lbf 4.45 N), and the displacements in the unit of their headings?",
        ratios.len()
    ))
}
