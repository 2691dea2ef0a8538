//! Verb: how does the arm swing at a posture? Frequencies, shapes and damping of its modes, and what a force that swings does to the tip.
//!
//! In the coordinates of the drives `(K - w^2 M) v = 0` with `K = diag(1/k_i)` and `M = A^T M_q A` ([`crate::mass::mass_matrix`]). Solved as
//! `lambda = 1/w^2` of `N = k^1/2 M k^1/2`, so rigid drives (`k = 0`) and bodies without mass are `lambda = 0` instead of a division by zero.
//! The stiffness is that of [`mod@crate::compliance`]: gravity and springs of base and bearings are left out (\[theory\], section 12).

mod arm;
mod map;
mod motion;
mod zone;

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, Matrix3, Matrix3x6, Matrix3xX, Matrix6, SymmetricEigen, Vector3};

use crate::compliance::PostureError;
use crate::mass::{Carrier, RigidBody};
use crate::prior::factors;
use crate::robot::Robot;
use crate::spatial::Pose;
use crate::uncertainty::{DRAWS, Spread};

pub use arm::SwingingArm;
pub(crate) use arm::check_masses;
pub use map::{FirstFrequencies, first_frequencies};
pub use motion::Motion;
pub use zone::{ModeOverZone, SwingOverZone, modes_over};

/// Of each mode where the robot file says nothing of damping; measured on such arms: 0.02 to 0.08.
pub const DAMPING_RATIO: f64 = 0.03;
/// A mode whose `1/w^2` is a smaller share of the largest is none: it is rounding, or nothing springs there.
const NONE: f64 = 1e-12;
/// How many joints move the points of [`Swing::points`].
const MOVED_BY: [usize; 5] = [0, 1, 2, 3, 6];

/// What is held at the flange.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldTool {
    /// The tool frame in the flange frame; its origin is the tip.
    pub flange_from_tool: Pose,
    /// In flange axes, from the flange; a tool that weighs nothing where `None`.
    pub body: Option<RigidBody>,
}

/// How the motion of the drives dies away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// Every mode by this share of its critical damping.
    Ratio(f64),
    /// Beside the spring of each drive, N m s/rad.
    OfDrives([f64; 6]),
}

/// One way in which the arm swings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// With the motors held still, Hz.
    pub frequency: f64,
    /// How far the frequency may be off with the stiffness of the drives, Hz; `None` where nothing says how far that may be.
    pub spread: Option<Spread>,
    /// The frequency of the same rank with motors that nothing holds but the inertia of their rotors, Hz; `None` where rotors are not known.
    ///
    /// Held and free are the limits of a stiff and of a powerless servo, no bracket: a servo about as stiff as the gear lies below both.
    pub motors_free: Option<f64>,
    /// Share of critical damping, `v^T D v / 2w`.
    pub damping_ratio: f64,
    /// How the tip moves, `J v` with `v^T M v = 1 kg m^2`: m per root of kg m^2, base axes.
    pub tip: Vector3<f64>,
    /// How the points of [`Swing::points`] move, in the same unit.
    pub moved: [Vector3<f64>; 5],
    /// Which share of the energy each drive stores where the arm stands still; adds up to 1.
    pub drive_shares: [f64; 6],
}

/// How an arm swings at one posture.
#[derive(Clone, Debug)]
pub struct Swing {
    /// The tool frame in the base frame.
    pub tool: Pose,
    /// Base, joint-2 axis, elbow, wrist centre and flange, m, base frame.
    pub points: [Vector3<f64>; 5],
    /// Ascending by frequency; as many as there are drives that spring and bodies that they move.
    pub modes: Vec<Mode>,
    /// What the damping ratios are from.
    pub damping: Damping,
    /// `J A k^1/2`, rows of translation alone.
    tip: Matrix3x6<f64>,
    /// `k^1/2 A^T M A k^1/2`, s^2.
    inertia: Matrix6<f64>,
    /// `k^1/2 D k^1/2`, s.
    friction: Matrix6<f64>,
}

/// Why it cannot be computed how an arm swings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModesError {
    /// The posture or the tool.
    #[error(transparent)]
    Posture(#[from] PostureError),
    /// Nobody says what it weighs.
    #[error(
        "{robot}: {missing} in the robot file: how it swings is not known; see [[mass]], or take a robot that has masses, as KUKA's KR 210 R2700-2"
    )]
    NoMasses {
        /// Which robot.
        robot: String,
        /// What is missing.
        missing: String,
    },
    /// No tool is like this.
    #[error("the tool: {0}")]
    Tool(String),
    /// Damping that makes no sense.
    #[error("damping {0}; expected a ratio from 0 to 1, or six numbers of at least 0 N m s/rad")]
    Damping(String),
    /// A rotor that weighs nothing.
    #[error("{0}: a rotor without inertia; expected more than 0 kg m2 at every joint")]
    Rotor(String),
    /// A zone that only the two links hold.
    #[error("over a zone an arm swings in space: a placement by the spatial model is needed")]
    NotInSpace,
    /// A placement of another arm or tool.
    #[error("the posture of the zone does not lead to its point {} m, {} m from its centre", .0[0], .0[1])]
    NotHeld([f64; 2]),
    /// Nothing springs, or nothing weighs.
    #[error("{0}: nothing swings: no drive that springs moves a mass")]
    Nothing(String),
}

/// The modes of a robot at the joint angles `q` it reports, rad, with what it holds, motors held still.
///
/// A damping that is not given is that of the drives where the robot file has it, else [`DAMPING_RATIO`] of every mode. Joint limits are not
/// checked here.
///
/// # Errors
/// A robot without masses, and numbers that make no sense.
pub fn modes(robot: &Robot, q: &[f64; 6], tool: &HeldTool, damping: Option<Damping>) -> Result<Swing, ModesError> {
    let (mut swing, k, in_drives) = solved(robot, q, tool, damping)?;
    let spreads = spreads(robot, &k, &in_drives).into_iter().flatten();
    swing.modes.iter_mut().zip(spreads).for_each(|(mode, spread)| mode.spread = Some(spread));
    Ok(swing)
}

/// The same without how far the frequencies may be off, in a hundredth of the time: of many postures.
///
/// # Errors
/// As [`modes`].
pub fn nominal_modes(
    robot: &Robot,
    q: &[f64; 6],
    tool: &HeldTool,
    damping: Option<Damping>,
) -> Result<Swing, ModesError> {
    solved(robot, q, tool, damping).map(|(swing, ..)| swing)
}

/// With the compliance of the drives, rad/(N m), and the mass matrix in their coordinates, kg m^2.
fn solved(
    robot: &Robot,
    q: &[f64; 6],
    tool: &HeldTool,
    damping: Option<Damping>,
) -> Result<(Swing, [f64; 6], Matrix6<f64>), ModesError> {
    let arm = SwingingArm::new(robot, tool)?;
    let theta = arm.model_angles(q)?;
    let (geometry, motors) = (arm.geometry(), &arm.drives().motors);
    let damping = damping.or(motors.damping.map(Damping::OfDrives)).unwrap_or(Damping::Ratio(DAMPING_RATIO));
    check_damping(&damping)?;

    let base_from_tool = geometry.forward(&theta) * tool.flange_from_tool;
    let (k, in_drives) = arm.springs_and_inertia(&theta)?;
    let jacobian = geometry.jacobian(&theta, &base_from_tool.translation.vector) * arm.drives().transmission.0;
    let root = Matrix6::from_diagonal(&k.map(f64::sqrt).into());
    let tip = jacobian.fixed_rows::<3>(0) * root;
    let points = geometry.points(&theta).map(Vector3::from);
    let links: [Matrix3x6<f64>; 5] = std::array::from_fn(|i| {
        // Joint 3 passes through the elbow, the joints of the wrist through its centre.
        let moves = |joint: usize| if joint < MOVED_BY[i] { 1.0 } else { 0.0 };
        let before = Matrix6::from_diagonal(&std::array::from_fn(moves).into());
        geometry.jacobian(&theta, &points[i]).fixed_rows::<3>(0) * before * arm.drives().transmission.0 * root
    });
    let inertia = root * in_drives * root;
    let found = eigen(&inertia);
    let largest = found[0].0;
    if !(0.0 < largest) {
        return Err(ModesError::Nothing(robot.name.clone()));
    }
    let friction = friction(&damping, &root, &found);
    let beside = motors
        .rotor
        .map(|rotor| beside_rotors(&in_drives, &rotor).ok_or_else(|| ModesError::Rotor(robot.name.clone())));
    let free = beside.transpose()?.map(|inertia| frequencies(&(root * inertia * root)));
    let swinging = found.iter().filter(|(lambda, _)| NONE * largest < *lambda).enumerate();
    let modes = swinging.map(|(rank, (lambda, u))| Mode {
        frequency: frequency(*lambda),
        spread: None,
        motors_free: free.as_ref().and_then(|free| free.get(rank).copied()),
        // v = k^1/2 u / lambda^1/2, so v^T D v / 2w = u^T k^1/2 D k^1/2 u / 2 lambda^1/2.
        damping_ratio: u.dot(&(friction * u)) / (2.0 * lambda.sqrt()),
        tip: tip * u / lambda.sqrt(),
        moved: links.map(|link| link * u / lambda.sqrt()),
        drive_shares: u.map(|part| part * part).into(),
    });
    let swing = Swing { tool: base_from_tool, points, modes: modes.collect(), damping, tip, inertia, friction };
    Ok((swing, k, in_drives))
}

impl Swing {
    /// How the tip follows a force that swings with `frequency`, Hz: `G = J (K + i w D - w^2 M)^-1 J^T`, m/N, base axes.
    ///
    /// `G(0)` is the compliance of [`mod@crate::compliance`]. `None` where an arm without damping swings at one of its own frequencies.
    pub fn receptance(&self, frequency: f64) -> Option<Matrix3<Complex<f64>>> {
        let w = TAU * frequency;
        let held = Matrix6::identity() - self.inertia * (w * w);
        let dynamic = held.zip_map(&(self.friction * w), Complex::new);
        let tip = self.tip.map(|x| Complex::new(x, 0.0));
        Some(tip * dynamic.lu().solve(&tip.transpose())?)
    }

    /// The same arm in its modes, base axes, with every drive so many times as compliant; `ratios` takes the place of its damping, mode by mode.
    ///
    /// Coordinates that spring without a mass are left out: [`Self::massless_share`].
    pub fn motion(&self, factors: &[f64; 6], ratios: Option<&[f64; 6]>) -> Motion {
        let root = Matrix6::from_diagonal(&factors.map(f64::sqrt).into());
        let (tip, friction) = (self.tip * root, root * self.friction * root);
        let found = eigen(&(root * self.inertia * root));
        let swinging: Vec<_> = found.iter().filter(|(lambda, _)| NONE * found[0].0 < *lambda).collect();
        let ratio = |i: usize| match (ratios, self.damping) {
            (Some(ratios), _) => Some(ratios[i]),
            (None, Damping::Ratio(ratio)) => Some(ratio),
            (None, Damping::OfDrives(_)) => None,
        };
        let friction = |i: usize, j: usize| match ratio(i) {
            Some(ratio) if i == j => 2.0 * ratio / swinging[i].0.sqrt(),
            Some(_) => 0.0,
            None => swinging[i].1.dot(&(friction * swinging[j].1)) / (swinging[i].0 * swinging[j].0).sqrt(),
        };
        let shapes: Vec<Vector3<f64>> = swinging.iter().map(|(lambda, u)| tip * u / lambda.sqrt()).collect();
        Motion {
            own: swinging.iter().map(|(lambda, _)| 1.0 / lambda.sqrt()).collect(),
            friction: DMatrix::from_fn(swinging.len(), swinging.len(), friction),
            tip: Matrix3xX::from_columns(&shapes),
        }
    }

    /// Which share of the compliance of the tip, by the trace, is of coordinates that spring without a mass.
    pub fn massless_share(&self) -> f64 {
        let found = eigen(&self.inertia);
        let massless = found.iter().filter(|(lambda, _)| !(NONE * found[0].0 < *lambda));
        let compliance: f64 = massless.map(|(_, u)| (self.tip * u).norm_squared()).sum();
        compliance / self.tip.norm_squared()
    }
}

/// Eigenvalues and eigenvectors of a symmetric matrix, the largest first; `lambda` is not negative but for rounding.
fn eigen(matrix: &Matrix6<f64>) -> [(f64, nalgebra::Vector6<f64>); 6] {
    let eigen = SymmetricEigen::new(*matrix);
    let mut order = [0, 1, 2, 3, 4, 5];
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    order.map(|i| (eigen.eigenvalues[i].max(0.0), eigen.eigenvectors.column(i).into()))
}

/// Hz, from `lambda = 1/w^2`, s^2.
fn frequency(lambda: f64) -> f64 {
    1.0 / (TAU * lambda.sqrt())
}

/// Of all modes of `k^1/2 M k^1/2`, ascending, Hz.
fn frequencies(inertia: &Matrix6<f64>) -> Vec<f64> {
    let mut lambdas: [f64; 6] = inertia.symmetric_eigenvalues().into();
    lambdas.sort_by(|a, b| b.total_cmp(a));
    let [largest, ..] = lambdas;
    lambdas.into_iter().filter(|lambda| NONE * largest < *lambda).map(frequency).collect()
}

/// `(M^-1 + J_r^-1)^-1 = M - M (M + J_r)^-1 M`: what swings against free rotors, that only the springs join to the links.
///
/// `None` where a rotor has no inertia. From `M psi'' = -K d`, `J_r phi'' = K d` for `d = psi - phi`; written so that it holds for an `M` without inverse, too.
fn beside_rotors(in_drives: &Matrix6<f64>, rotor: &[f64; 6]) -> Option<Matrix6<f64>> {
    let both = in_drives + Matrix6::from_diagonal(&(*rotor).into());
    let is_sound = rotor.iter().all(|inertia| 0.0 < *inertia && inertia.is_finite());
    both.cholesky().filter(|_| is_sound).map(|both| in_drives - in_drives * both.solve(in_drives))
}

/// `k^1/2 D k^1/2`; under one ratio of all modes `sum 2 zeta lambda^1/2 u u^T`.
fn friction(damping: &Damping, root: &Matrix6<f64>, found: &[(f64, nalgebra::Vector6<f64>); 6]) -> Matrix6<f64> {
    match damping {
        Damping::Ratio(zeta) => found.iter().map(|(lambda, u)| u * u.transpose() * (2.0 * zeta * lambda.sqrt())).sum(),
        Damping::OfDrives(damping) => root * Matrix6::from_diagonal(&(*damping).into()) * root,
    }
}

/// Where each frequency lies with 90 %, Hz, over draws of the drives' compliance; `None` where nothing says how far that may be off.
fn spreads(robot: &Robot, k: &[f64; 6], in_drives: &Matrix6<f64>) -> Option<Vec<Spread>> {
    let drawn = factors(robot, DRAWS)?;
    let of_draw = |factor: &[f64; 6]| {
        let root = Matrix6::from_diagonal(&std::array::from_fn(|i| (k[i] * factor[i]).sqrt()).into());
        frequencies(&(root * in_drives * root))
    };
    let draws: Vec<Vec<f64>> = drawn.iter().map(of_draw).collect();
    let fewest = draws.iter().map(Vec::len).min()?;
    Some((0..fewest).map(|rank| Spread::of(draws.iter().map(|draw| draw[rank]).collect())).collect())
}

/// What is left out of a robot's masses, though it has them of every link: rod and counterweight of a parallelogram.
pub fn left_out(robot: &Robot) -> Vec<&'static str> {
    let has = |carrier: fn(&Carrier) -> bool| robot.masses.iter().any(|mass| carrier(&mass.carrier));
    let quasi_serial = robot.architecture == crate::drive::Architecture::QuasiSerial;
    let parts = [
        ("rod", has(|carrier| matches!(carrier, Carrier::Rod { .. }))),
        ("counterweight", has(|carrier| *carrier == Carrier::Counterweight)),
    ];
    parts.into_iter().filter(|(_, is_there)| quasi_serial && !is_there).map(|(part, _)| part).collect()
}

fn check_damping(damping: &Damping) -> Result<(), ModesError> {
    let (sound, text) = match damping {
        Damping::Ratio(zeta) => ((0.0..=1.0).contains(zeta), format!("ratio {zeta}")),
        Damping::OfDrives(each) => (each.iter().all(|d| 0.0 <= *d && d.is_finite()), format!("{each:?} N m s/rad")),
    };
    if sound { Ok(()) } else { Err(ModesError::Damping(text)) }
}
