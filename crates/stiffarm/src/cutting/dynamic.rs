//! By how much does the force of a tooth change where the tool is off from where the tooth before it cut?
//!
//! A displacement `u` of the tool between one tooth and the next makes the chip thicker by `[sin, cos, 0] u`, and the tooth at `phi`, counted
//! as in [`Milling`], then pushes with `a v [sin, cos, 0] u` more, `v = (-K_t cos - K_r sin, K_t sin - K_r cos, -K_a)`. \[Altintas\]

use std::f64::consts::TAU;

use nalgebra::Matrix3x2;

use super::edge::Edge;
use super::milling::{CutArc, Milling};
use super::quadrature::integral;

impl Milling {
    /// `int v [sin, cos] dphi` from one angle to another, both in the cut: N/m^2; rows feed, left, away, columns displacements along feed and left.
    ///
    /// Axially nothing changes the chip of a flat mill. Under Kienzle's law `K = dF/dh` at the chip of the feed.
    pub fn directional(&self, from: f64, to: f64) -> Matrix3x2<f64> {
        let between = |f: fn(f64) -> f64| f(to) - f(from);
        match self.edge {
            Edge::Linear { chip: [t, r, a], .. } => {
                let wave = between(|x| (2.0 * x).sin() / 4.0);
                let [ss, cc] = [(to - from) / 2.0 - wave, (to - from) / 2.0 + wave];
                let sc = between(|x| x.sin().powi(2) / 2.0);
                let [s, c] = [-between(f64::cos), between(f64::sin)];
                Matrix3x2::new(-t * sc - r * ss, -t * cc - r * sc, t * ss - r * sc, t * sc - r * cc, -a * s, -a * c)
            }
            Edge::Power { .. } => {
                let at = |phi: f64| {
                    let (s, c) = phi.sin_cos();
                    let [t, r, a] = self.edge.per_chip(self.engagement.feed_per_tooth * s);
                    let v = [-t * c - r * s, t * s - r * c, -a];
                    [v[0] * s, v[0] * c, v[1] * s, v[1] * c, v[2] * s, v[2] * c]
                };
                Matrix3x2::from_row_slice(&integral(at, from, to, 16))
            }
        }
    }

    /// The mean over a revolution a m of the largest depth, `A0 = N/2pi int v [sin, cos] dphi` over the arcs, each by its share of that depth,
    /// N/m^2; axes as in [`Self::directional`].
    pub fn mean_directional(&self) -> Matrix3x2<f64> {
        self.shares().map(|(arc, share)| self.directional(arc.entry, arc.exit) * share).sum::<Matrix3x2<f64>>()
            * (self.teeth as f64 / TAU)
    }

    /// The mean over the angles `from..to` of the first tooth, of all teeth that cut meanwhile, N/m^2 as [`Self::mean_directional`].
    pub fn step_directional(&self, from: f64, to: f64) -> Matrix3x2<f64> {
        let pitch = TAU / self.teeth as f64;
        let mut sum = Matrix3x2::zeros();
        for (&CutArc { entry, exit, .. }, share) in self.shares() {
            // Tooth `j` stands `j` pitches from the first: those that reach into the cut.
            for j in ((entry - to) / pitch).floor() as i64..=((exit - from) / pitch).ceil() as i64 {
                let by = pitch * j as f64;
                let (from, to) = ((from + by).max(entry), (to + by).min(exit));
                if from < to {
                    sum += self.directional(from, to) * share;
                }
            }
        }
        sum / (to - from)
    }

    /// Each arc with its depth in parts of the largest.
    fn shares(&self) -> impl Iterator<Item = (&CutArc, f64)> {
        let largest = self.engagement.depth();
        self.engagement.arcs.iter().map(move |arc| (arc, arc.depth / largest))
    }
}
