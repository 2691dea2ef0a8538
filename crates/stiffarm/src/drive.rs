//! What springs, and in which coordinates?

use nalgebra::{Matrix2, Matrix6};

use crate::real::Real;

/// How drive 3 is coupled to the arm.
///
/// The two architectures differ in one constant matrix, the transmission `q = A psi`, and in nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Architecture {
    /// Every drive sits in its joint.
    Serial,
    /// An exact parallelogram: drive 3 stands on the shoulder and holds the absolute angle of the forearm.
    QuasiSerial,
}

impl Architecture {
    /// Both, in the order of the paper.
    pub const ALL: [Self; 2] = [Self::Serial, Self::QuasiSerial];

    /// The name that robot files and reports use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Serial => "serial",
            Self::QuasiSerial => "quasi-serial",
        }
    }

    /// `A` on the joints 2 and 3: joint angles `q = A psi` from drive angles `psi`.
    ///
    /// Serial `A = I`; quasi-serial `psi2 = q2`, `psi3 = q2 + q3`, so `A = [[1, 0], [-1, 1]]`.
    pub const fn transmission(self) -> Matrix2<f64> {
        match self {
            Self::Serial => Matrix2::new(1.0, 0.0, 0.0, 1.0),
            Self::QuasiSerial => Matrix2::new(1.0, 0.0, -1.0, 1.0),
        }
    }
}

impl std::fmt::Display for Architecture {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// What holds the six joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Drives {
    /// Of each drive.
    pub compliance: JointCompliance,
    /// From drive angles to joint angles.
    pub transmission: Transmission,
    /// A spring beside drive 2.
    pub compensator: Option<GravityCompensator>,
    /// What is known of the compliances where they were measured on the machine.
    pub identified: Option<Identified>,
    /// How far they may be off where they were taken from robots of the same size, or from publications.
    pub scatter: Option<Scatter>,
    /// What else is known of the motors and gears.
    pub motors: Motors,
}

/// What is known of motors and gears besides their compliance, of each drive; `None` where it is not known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motors {
    /// Largest torque, N m.
    pub torque: Option<[f64; 6]>,
    /// What the maker allows weight and force at the flange to turn axes 4, 5 and 6 with, N m.
    pub wrist_moment: Option<[f64; 3]>,
    /// Inertia of the rotor as the joint feels it, kg m^2: its own times the square of the ratio.
    pub rotor: Option<[f64; 6]>,
    /// Damping beside the spring of the drive, N m s/rad.
    pub damping: Option<[f64; 6]>,
}

impl Motors {
    /// Nothing is known of them.
    pub const UNKNOWN: Self = Self { torque: None, wrist_moment: None, rotor: None, damping: None };

    /// The largest moments about axes 4, 5 and 6, N m, and what says so; `None` where nothing does.
    pub fn wrist_limit(&self) -> Option<([f64; 3], WristLimit)> {
        let drives = self.torque.map(|[.., fourth, fifth, sixth]| ([fourth, fifth, sixth], WristLimit::Drives));
        self.wrist_moment.map(|allowed| (allowed, WristLimit::Maker)).or(drives)
    }
}

/// What says how large the moments about axes 4, 5 and 6 may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WristLimit {
    /// The maker, of the load.
    Maker,
    /// The torque limits of the drives: above them they do not hold the load even at rest.
    Drives,
}

impl WristLimit {
    /// The name that answers use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Maker => "allowed by the maker",
            Self::Drives => "torque limits of the drives",
        }
    }
}

/// How far compliances may be off: standard deviations of ln k.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// An error that all robots share, of each drive.
    pub global: [f64; 6],
    /// Of this robot, all drives alike; of each drive how much of it counts.
    pub common: [f64; 6],
    /// Of each drive of this robot.
    pub own: [f64; 6],
    /// What is behind it.
    pub knowledge: Knowledge,
}

/// What is known of drives that nobody here has measured.
#[derive(Clone, Debug, PartialEq)]
pub enum Knowledge {
    /// Drives of other robots, by their size.
    Prior,
    /// Identifications of this robot that are published; drives that they do not show as in the prior.
    Published {
        /// Which drives they show.
        drives: [bool; 6],
        /// Where.
        sources: Vec<String>,
        /// The drive, from 0, in which they differ most, and the factor; `None` where they agree, or there is one.
        disagreement: Option<(usize, f64)>,
    },
}

/// How well measured compliances are known.
#[derive(Clone, Debug, PartialEq)]
pub struct Identified {
    /// Which drives the measurements have shown; the others have what was assumed of them.
    pub drives: [bool; 6],
    /// Of the compliances, (rad/(N m))^2; zero for drives that were not shown.
    pub covariance: Matrix6<f64>,
    /// In how many postures was measured.
    pub postures: usize,
    /// When, as year-month-day, where that was said.
    pub date: Option<String>,
    /// What is left of a coordinate of a displacement, root mean square, m.
    pub residual: f64,
    /// The same of each posture by the others, where that is known.
    pub left_out: Option<f64>,
    /// How far a coordinate moved, root mean square, m; `None` in a file that does not tell it.
    pub moved: Option<f64>,
}

impl Identified {
    /// What was not explained as a share of what moved; `None` where it is not known how far that was.
    pub fn residual_share(&self) -> Option<f64> {
        self.moved.map(|moved| self.missed() / moved)
    }

    /// Standard deviation of each of so many coordinates of what the model misses of a displacement of this length, m.
    ///
    /// What an elastic model misses grows with the load: the share that it missed of what was measured. Noise of the measurement counts with
    /// it. Where it is not known how far that moved, what was missed is taken as it is.
    pub fn unexplained(&self, length: f64, coordinates: usize) -> f64 {
        self.residual_share().map_or(self.missed(), |share| share * length / (coordinates as f64).sqrt())
    }

    /// What the model misses of a coordinate that it was not fitted to, root mean square, m.
    fn missed(&self) -> f64 {
        self.left_out.map_or(self.residual, |left_out| left_out.max(self.residual))
    }
}

impl Drives {
    /// The usual couplings of an architecture, without a compensator.
    pub fn new(architecture: Architecture, compliance: JointCompliance) -> Self {
        Self {
            compliance,
            transmission: Transmission::of(architecture),
            compensator: None,
            identified: None,
            scatter: None,
            motors: Motors::UNKNOWN,
        }
    }

    /// The compliance of each drive, rad/(N m), with the compensator's part at the model angle `theta_2` (rad):
    /// `1 / (1/k2 + dK(theta2))` on drive 2. `None` where the compensator pushes harder than the drive holds.
    pub fn compliance_at(&self, theta_2: f64) -> Option<[f64; 6]> {
        let mut k = self.compliance.0;
        if let Some(compensator) = self.compensator {
            let held = 1.0 + k[1] * compensator.stiffness(theta_2);
            k[1] = (0.0 < held).then_some(k[1] / held)?;
        }
        Some(k)
    }
}

/// The compliance of the six drives, rad/(N m), in drive coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointCompliance(pub [f64; 6]);

impl JointCompliance {
    /// What the paper assumes of every heavy robot: 1 urad/(N m) on every drive.
    pub const PAPER: Self = Self([1e-6; 6]);
}

/// The constant matrix `A` of `q = A psi`: model joint angles from drive angles (\[theory\], section 1).
///
/// Joint angles are those of the open chain, in the directions of the model angles theta.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transmission(pub Matrix6<f64>);

impl Transmission {
    /// As the architecture couples the joints 2 and 3, every other joint held by its own drive.
    pub fn of(architecture: Architecture) -> Self {
        let mut a = Matrix6::identity();
        a.fixed_view_mut::<2, 2>(1, 1).copy_from(&architecture.transmission());
        Self(a)
    }

    /// The joints 2 and 3 are moved by the drives 2 and 3 alone, in the way of this architecture.
    pub fn keeps_the_arm(&self, architecture: Architecture) -> bool {
        let usual = Self::of(architecture).0;
        self.0.fixed_rows::<2>(1) == usual.fixed_rows::<2>(1)
            && self.0.fixed_columns::<2>(1) == usual.fixed_columns::<2>(1)
    }

    /// Drive 2 alone moves joint 2, one to one.
    pub fn joint_2_is_direct(&self) -> bool {
        self.0.row(1) == Matrix6::identity().row(1)
    }
}

/// A spring between the base and the upper arm that carries part of the arm's weight.
///
/// Both ends lie in the arm plane, `[forwards, up]` in m from the joint-2 axis: one stands with the base, the other turns
/// with the upper arm and is given at model zero (upper arm upright).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GravityCompensator {
    /// The end on the base.
    pub base: [f64; 2],
    /// The end on the upper arm, upper arm upright.
    pub arm: [f64; 2],
    /// Of the spring, N/m.
    pub stiffness: f64,
    /// Length at which it pulls nothing, m; shorter than its shortest length means preload.
    pub free_length: f64,
}

impl GravityCompensator {
    /// `(u, v)`: inner and outer product of the two ends, `s^2 = |base|^2 + |arm|^2 - 2 u`, `du/dtheta2 = v`; from sine and cosine
    /// of theta2.
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled without the wide instructions")]
    #[inline(always)]
    pub(crate) fn products<T: Real>(&self, s: T, c: T) -> (T, T) {
        let ([bx, bz], [ax, az]) = (self.base, self.arm);
        let (x, z) = (c * ax + s * az, c * az - s * ax);
        (x * bx + z * bz, z * bx - x * bz)
    }

    /// Length of the spring, m.
    pub fn length(&self, theta_2: f64) -> f64 {
        let square = |[x, z]: [f64; 2]| x * x + z * z;
        let (s, c) = theta_2.sin_cos();
        (square(self.base) + square(self.arm) - 2.0 * self.products(s, c).0).max(0.0).sqrt()
    }

    /// Torque on the upper arm, N m, in the direction of theta2: `M = k (1 - s0/s) v`.
    pub fn torque(&self, theta_2: f64) -> f64 {
        let (s, c) = theta_2.sin_cos();
        let (_, v) = self.products(s, c);
        self.stiffness * (1.0 - self.free_length / self.length(theta_2)) * v
    }

    /// The stiffness it adds to joint 2, `dK = -dM/dtheta2 = k ((1 - s0/s) u + s0 v^2 / s^3)`, N m/rad; may be negative.
    pub fn stiffness(&self, theta_2: f64) -> f64 {
        let [of_spring, of_preload] = self.parts(theta_2);
        self.stiffness * (of_spring + self.free_length * of_preload)
    }

    /// What of that a unit of the spring's stiffness gives, `u`, m^2, and a unit of stiffness times free length, `v^2 / s^3 - u / s`, m: `dK` is
    /// linear in the two, whatever the geometry.
    pub fn parts(&self, theta_2: f64) -> [f64; 2] {
        let (s, c) = theta_2.sin_cos();
        let (u, v) = self.products(s, c);
        let s = self.length(theta_2);
        [u, v * v / (s * s * s) - u / s]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_compensators_stiffness_is_the_slope_of_its_torque_and_the_torque_that_of_its_energy() {
        let mut rng = fastrand::Rng::with_seed(5);
        for _ in 0..500 {
            let mut at = || [rng.f64() - 0.5, rng.f64() - 0.5];
            let (base, arm) = (at(), at());
            let spring = GravityCompensator { base, arm, stiffness: 1e5 * rng.f64(), free_length: 0.5 * rng.f64() };
            let theta = 6.0 * (rng.f64() - 0.5);
            if spring.length(theta) < 0.1 {
                continue; // finite differences of 1/s are worth nothing there
            }
            let energy = |theta: f64| 0.5 * spring.stiffness * (spring.length(theta) - spring.free_length).powi(2);
            let slope = |f: &dyn Fn(f64) -> f64| (f(theta + 1e-5) - f(theta - 1e-5)) / 2e-5;
            // Central differences of step 1e-5: rounding 1e-11, truncation 1e-10 times third derivatives (1/s^3 <= 1e3).
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * spring.stiffness;
            assert!(close(spring.torque(theta), -slope(&energy)), "{spring:?} at {theta}");
            assert!(close(spring.stiffness(theta), -slope(&|t| spring.torque(t))), "{spring:?} at {theta}");
        }
    }

    #[test]
    fn a_compensator_can_soften_joint_2_and_not_beyond_what_the_drive_holds() {
        // Straight above the axis and pulling down to an end below: the unstable equilibrium of a pendulum.
        let pulling =
            |stiffness| GravityCompensator { base: [0.0, -0.3], arm: [0.0, 0.5], stiffness, free_length: 0.0 };
        let drives = |stiffness| Drives {
            compensator: Some(pulling(stiffness)),
            ..Drives::new(Architecture::Serial, JointCompliance::PAPER)
        };
        // By hand: dK = k u = -1e5 * 0.15 = -15000 N m/rad, of the drive's 1e6.
        let k2 = drives(1e5).compliance_at(0.0).unwrap()[1];
        assert!((k2 - 1.0 / (1e6 - 15e3)).abs() < 1e-18);
        assert_eq!(drives(1e7).compliance_at(0.0), None);
    }
}
