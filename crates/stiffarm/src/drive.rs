//! What springs, and in which coordinates?

use nalgebra::{Matrix2, Matrix6};

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

    /// `A` on all six joints: as on the joints 2 and 3, the others held by their own drives.
    pub fn transmission_of_six(self) -> Matrix6<f64> {
        let mut a = Matrix6::identity();
        a.fixed_view_mut::<2, 2>(1, 1).copy_from(&self.transmission());
        a
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

/// The compliance of the six drives, rad/(N m), in drive coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointCompliance(pub [f64; 6]);

impl JointCompliance {
    /// What the paper assumes of every heavy robot: 1 urad/(N m) on every drive.
    pub const PAPER: Self = Self([1e-6; 6]);
}
