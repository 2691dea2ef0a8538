//! What does an edge feel of a chip: force per length of edge, along the cut, into the tool and along its axis?

/// The force law of a material and a tool. All in SI: N/m2 and N/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edge {
    /// `K_c h + K_e`, for tangential, radial and axial: mechanistic, \[Altintas\].
    Linear {
        /// `K_tc, K_rc, K_ac`, N/m2.
        chip: [f64; 3],
        /// `K_te, K_re, K_ae`, N/m.
        rubbing: [f64; 3],
    },
    /// `k_c1.1 h^(1 - m_c)` with h in mm, and shares of it, \[Kienzle\].
    Power {
        /// `k_c1.1`, N/m2: of a chip of 1 mm by 1 mm.
        specific: f64,
        /// `m_c`.
        exponent: f64,
        /// Radial and axial force over the tangential one.
        ratios: [f64; 2],
    },
}

/// The thickness to which `k_c1.1` belongs, m.
const UNIT_CHIP: f64 = 1e-3;

impl Edge {
    /// Tangential, radial and axial, N per m of axial depth, under a chip of thickness `h`, m.
    pub fn per_depth(&self, h: f64) -> [f64; 3] {
        match self {
            Self::Linear { chip, rubbing } => std::array::from_fn(|i| chip[i] * h + rubbing[i]),
            Self::Power { specific, exponent, ratios } => {
                let tangential = specific * UNIT_CHIP * (h.max(0.0) / UNIT_CHIP).powf(1.0 - exponent);
                [tangential, ratios[0] * tangential, ratios[1] * tangential]
            }
        }
    }

    /// By how much each of them grows with the chip, N/m2, at a thickness `h`, m.
    pub fn per_chip(&self, h: f64) -> [f64; 3] {
        match self {
            Self::Linear { chip, .. } => *chip,
            Self::Power { specific, exponent, ratios } => {
                let tangential = specific * (1.0 - exponent) * (h.max(0.0) / UNIT_CHIP).powf(-exponent);
                [tangential, ratios[0] * tangential, ratios[1] * tangential]
            }
        }
    }
}
