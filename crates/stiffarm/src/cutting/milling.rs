//! A mill, tooth by tooth: mean over a revolution, and the extremes between the teeth.
//!
//! The tooth at the angle `phi`, counted from the left of the feed in the sense of the rotation (clockwise from above), cuts a chip of
//! `h = c sin(phi)` from the entry to the exit. In the axes of the cut, x along the feed and y to its left, with `F_t` against
//! the tooth's motion and `F_r` into the tool,
//!
//! ```text
//! F_x = -F_t cos(phi) - F_r sin(phi)      F_y = F_t sin(phi) - F_r cos(phi)      F_z = -F_a
//! ```
//!
//! `F_z` is away from the work. A helix that winds in the sense of the rotation, as that of an ordinary end mill, lifts the chip and draws the
//! tool into the work: `F_a` is towards it, as coefficients of such tools are published (`F_z = F_r cos(kappa) - F_a sin(kappa)` of a tooth at
//! `kappa` to the axis, here 90 deg: Engin and Altintas, International Journal of Machine Tools and Manufacture 41, 2001).
//!
//! Of the mean over a revolution the helix makes no difference: each disc of the tool has the same one, later. \[Altintas\]

use std::f64::consts::{PI, TAU};

use super::edge::Edge;
use super::quadrature::integral;
use super::{ANGLES, CuttingError, CuttingForce};

/// On which side of the tool the material is, as its engagement says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From no chip to the full one, against the motion of the work.
    Up,
    /// From the full chip to none, along with the work.
    Down,
    /// The whole width of the tool.
    Slot,
}

impl Side {
    /// As it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Up => "up",
            Self::Down => "down",
            Self::Slot => "slot",
        }
    }
}

/// An arc over which the teeth cut at one depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutArc {
    /// Axial depth, m.
    pub depth: f64,
    /// From the left of the feed in the sense of the rotation, rad, `0 <= entry < exit <= pi`.
    pub entry: f64,
    /// Where the tooth leaves, rad.
    pub exit: f64,
}

impl CutArc {
    /// The same material seen in a mirror along the feed: what was left is right.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self { depth: self.depth, entry: PI - self.exit, exit: PI - self.entry }
    }
}

/// Where the teeth cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Engagement {
    /// At least one; by their angles, none over another.
    pub arcs: Vec<CutArc>,
    /// Along the feed, m.
    pub feed_per_tooth: f64,
}

impl Engagement {
    /// At one depth, m, between two angles, rad.
    pub fn at_depth(depth: f64, [entry, exit]: [f64; 2], feed_per_tooth: f64) -> Self {
        Self { arcs: vec![CutArc { depth, entry, exit }], feed_per_tooth }
    }

    /// The largest axial depth, m.
    pub fn depth(&self) -> f64 {
        self.arcs.iter().map(|arc| arc.depth).fold(0.0, f64::max)
    }

    /// Where a tooth first enters, rad.
    pub fn entry(&self) -> f64 {
        self.arcs.first().map_or(0.0, |arc| arc.entry)
    }

    /// Where it last leaves, rad.
    pub fn exit(&self) -> f64 {
        self.arcs.last().map_or(0.0, |arc| arc.exit)
    }

    /// The same material seen in a mirror along the feed.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self { arcs: self.arcs.iter().rev().map(CutArc::mirrored).collect(), ..*self }
    }

    /// The angles of a radial width, m, of a tool of a diameter, m.
    pub fn angles(side: Side, width: f64, diameter: f64) -> [f64; 2] {
        let wrapped = (1.0 - 2.0 * width / diameter).clamp(-1.0, 1.0).acos();
        match side {
            Side::Up => [0.0, wrapped],
            Side::Down => [PI - wrapped, PI],
            Side::Slot => [0.0, PI],
        }
    }
}

/// A mill in its work.
#[derive(Clone, Debug, PartialEq)]
pub struct Milling {
    /// m.
    pub diameter: f64,
    /// How many.
    pub teeth: usize,
    /// Angle of the helix, rad, 0 for straight teeth.
    pub helix: f64,
    /// Where it cuts.
    pub engagement: Engagement,
    /// What the edge feels.
    pub edge: Edge,
}

/// Angle, rad, below which two angles of the spindle are one but for rounding.
const HAIR: f64 = 1e-12;

/// Force along feed, across and axial, N, and moment about the axis, N m.
type Felt = [f64; 4];

impl Milling {
    fn check(&self) -> Result<(), CuttingError> {
        let Engagement { arcs, feed_per_tooth } = &self.engagement;
        let value = |what, value: f64, is_well: bool, expected| {
            if is_well { Ok(()) } else { Err(CuttingError::Value { what, value, expected }) }
        };
        value("a diameter", self.diameter, 0.0 < self.diameter && self.diameter <= 1.0, "more than 0 and at most 1 m")?;
        value("a number of teeth", self.teeth as f64, (1..=1000).contains(&self.teeth), "1 to 1000")?;
        value("a helix angle", self.helix, (0.0..=1.4).contains(&self.helix), "0 to 1.4 rad")?;
        let mut from = 0.0;
        for &CutArc { depth, entry, exit } in arcs {
            value("a depth of cut", depth, 0.0 < depth && depth <= 1.0, "more than 0 and at most 1 m")?;
            let is_behind = from <= entry && entry < exit;
            value(
                "an entry angle",
                entry,
                is_behind,
                "at least 0 and less than the exit angle, behind the arc before",
            )?;
            value("an exit angle", exit, exit <= PI + 1e-9, "at most pi rad")?;
            from = exit;
        }
        value("a number of arcs", arcs.len() as f64, !arcs.is_empty(), "at least 1")?;
        value(
            "a feed per tooth",
            *feed_per_tooth,
            0.0 < *feed_per_tooth && *feed_per_tooth <= 0.1,
            "more than 0 and at most 0.1 m",
        )
    }

    /// What one tooth feels at an angle, per m of axial depth.
    fn tooth(&self, phi: f64) -> Felt {
        let (s, c) = phi.sin_cos();
        let [t, r, a] = self.edge.per_depth(self.engagement.feed_per_tooth * s);
        [-t * c - r * s, t * s - r * c, -a, t * self.diameter / 2.0]
    }

    /// Mean over a revolution, `N a / (2 pi)` times the integral over the angles of the cut.
    ///
    /// Of [`Edge::Linear`] in closed form, with `[...]` from entry to exit:
    ///
    /// ```text
    /// x: -K_tc c [sin^2/2] - K_te [sin] - K_rc c [phi/2 - sin(2 phi)/4] + K_re [cos]
    /// y:  K_tc c [phi/2 - sin(2 phi)/4] - K_te [cos] - K_rc c [sin^2/2] - K_re [sin]
    /// z:  K_ac c [cos] - K_ae [phi]          moment: D/2 (-K_tc c [cos] + K_te [phi])
    /// ```
    fn mean(&self) -> Felt {
        self.sum_over_arcs(|arc| self.mean_of(arc))
    }

    fn sum_over_arcs(&self, felt: impl Fn(&CutArc) -> Felt) -> Felt {
        self.engagement.arcs.iter().map(felt).fold([0.0; 4], |sum, felt| std::array::from_fn(|i| sum[i] + felt[i]))
    }

    fn mean_of(&self, &CutArc { depth, entry, exit }: &CutArc) -> Felt {
        let c = self.engagement.feed_per_tooth;
        let over = match self.edge {
            Edge::Power { .. } => integral(|phi| self.tooth(phi), entry, exit, 64),
            Edge::Linear { chip: [tc, rc, ac], rubbing: [te, re, ae] } => {
                let between = |f: fn(f64) -> f64| f(exit) - f(entry);
                let [half_square, sine, cosine, angle] =
                    [between(|x| x.sin().powi(2) / 2.0), between(f64::sin), between(f64::cos), exit - entry];
                let area = between(|x| x / 2.0 - (2.0 * x).sin() / 4.0);
                [
                    -tc * c * half_square - te * sine - rc * c * area + re * cosine,
                    tc * c * area - te * cosine - rc * c * half_square - re * sine,
                    ac * c * cosine - ae * angle,
                    self.diameter / 2.0 * (-tc * c * cosine + te * angle),
                ]
            }
        };
        over.map(|part| part * self.teeth as f64 * depth / TAU)
    }

    /// The angle by which the top of an arc lags behind its bottom, rad: `2 a tan(helix) / D`.
    fn lag(&self, arc: &CutArc) -> f64 {
        2.0 * arc.depth * self.helix.tan() / self.diameter
    }

    /// What the tool feels when the bottom of its first tooth stands at an angle.
    ///
    /// Along a tooth the angle falls evenly by the lag: the integral over the depth is one over the angle.
    fn at(&self, angle: f64) -> Felt {
        self.sum_over_arcs(|arc| self.at_of(arc, angle))
    }

    fn at_of(&self, arc: &CutArc, angle: f64) -> Felt {
        let CutArc { depth, entry, exit } = *arc;
        let (lag, mut sum) = (self.lag(arc), [0.0; 4]);
        for tooth in 0..self.teeth {
            let at = angle + TAU * tooth as f64 / self.teeth as f64;
            let bottom = at.rem_euclid(TAU);
            if lag < 1e-9 {
                // Of two teeth as far apart as entry and exit one cuts: it enters a hair before the other would, which leaves as early.
                let cut = (at - entry + HAIR).rem_euclid(TAU);
                if cut < exit - entry {
                    let felt = self.tooth((entry + cut - HAIR).max(entry));
                    (0..4).for_each(|i| sum[i] += depth * felt[i]);
                }
                continue;
            }
            // The same edge one or more turns earlier, where it winds about the tool.
            for turns in 0..=(lag / TAU).ceil() as usize {
                let bottom = bottom - TAU * turns as f64 + TAU * (lag / TAU).ceil();
                let (from, to) = ((bottom - lag).max(entry), bottom.min(exit));
                if from < to {
                    let felt = integral(|phi| self.tooth(phi), from, to, 4);
                    (0..4).for_each(|i| sum[i] += depth / lag * felt[i]);
                }
            }
        }
        sum
    }

    /// Angles of the spindle at which the force may be extreme: a fine grid over a pitch, and straight teeth where they enter and leave.
    fn telling_angles(&self) -> Vec<f64> {
        const FINE: usize = 720;
        let pitch = TAU / self.teeth as f64;
        let mut angles: Vec<f64> = (0..FINE).map(|i| pitch * i as f64 / FINE as f64).collect();
        let edges = |arc: &CutArc| [arc.entry, arc.exit, arc.entry + self.lag(arc), arc.exit + self.lag(arc)];
        for edge in self.engagement.arcs.iter().flat_map(edges) {
            angles.extend([edge - 1e-9, edge, edge + 1e-9].map(|angle| angle.rem_euclid(pitch)));
        }
        angles
    }

    /// The mean alone, force and moment; `sense` as [`Self::force`] has it.
    pub(super) fn checked_mean(&self, sense: f64) -> Result<([f64; 3], f64), CuttingError> {
        self.check()?;
        let [x, y, z, moment] = self.mean();
        Ok(([x, sense * y, z], sense * moment))
    }

    /// By how much the mean force, along feed, across and axial, changes where the tool is moved across (to its left) and axially (away from the
    /// work), N/m: by another width, the sides of the cut being walls along the feed, and by another depth.
    pub(super) fn changes(&self, sense: f64) -> Result<[[f64; 3]; 2], CuttingError> {
        self.check()?;
        let mut found = [[0.0; 3]; 2];
        for arc in &self.engagement.arcs {
            for (sum, change) in found.iter_mut().zip(self.changes_of(arc, sense)) {
                (0..3).for_each(|i| sum[i] += change[i]);
            }
        }
        Ok(found)
    }

    /// Where one arc ends and the next begins, both change by the step between them.
    fn changes_of(&self, &CutArc { depth, entry, exit }: &CutArc, sense: f64) -> [[f64; 3]; 2] {
        let radius = self.diameter / 2.0;
        let step = (1e-3 * radius).min(0.1 * radius * (entry.cos() - exit.cos()));
        // Turned the other way the picture is mirrored: there to the left is to the right.
        let moved = |by: f64| {
            let wall = |angle: f64| {
                let is_wall = 1e-9 < angle && angle < PI - 1e-9;
                if is_wall { (angle.cos() - by / radius).clamp(-1.0, 1.0).acos() } else { angle }
            };
            self.mean_of(&CutArc { depth, entry: wall(entry), exit: wall(exit) })
        };
        let turned = |[x, y, z, _]: Felt| [x, sense * y, z];
        let [force, less, more] = [moved(0.0), moved(-sense * step), moved(sense * step)].map(turned);
        [std::array::from_fn(|i| (more[i] - less[i]) / (2.0 * step)), force.map(|part| -part / depth)]
    }

    /// Mean, extremes and a revolution; `sense` is 1 where the tool turns clockwise from above, else -1.
    pub(super) fn force(&self, sense: f64) -> Result<CuttingForce, CuttingError> {
        // Turned the other way the picture is mirrored at the feed: what is left is right.
        let turned = |[x, y, z, m]: Felt| ([x, sense * y, z], sense * m);
        let (mean, moment) = self.checked_mean(sense)?;
        let mut range = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        let mut largest = 0.0_f64;
        for angle in self.telling_angles() {
            let (force, _) = turned(self.at(angle));
            for i in 0..3 {
                range[0][i] = range[0][i].min(force[i]);
                range[1][i] = range[1][i].max(force[i]);
            }
            largest = largest.max(force.iter().map(|part| part * part).sum::<f64>().sqrt());
        }
        let revolution = (0..ANGLES).map(|i| turned(self.at(TAU * i as f64 / ANGLES as f64)).0).collect();
        Ok(CuttingForce { mean: Some(mean), range: Some(range), largest, moment, power: None, revolution })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINEAR: Edge = Edge::Linear { chip: [767.01e6, 168.8e6, 222e6], rubbing: [27.7e3, 26.6e3, 0.7e3] };
    const POWER: Edge = Edge::Power { specific: 2220e6, exponent: 0.14, ratios: [0.4, 0.2] };

    fn mill(side: Side, width: f64, helix: f64, edge: Edge) -> Milling {
        let [entry, exit] = Engagement::angles(side, width, 0.016);
        let engagement = Engagement::at_depth(0.002, [entry, exit], 1e-4);
        Milling { diameter: 0.016, teeth: 4, helix, engagement, edge }
    }

    fn close(a: &[f64], b: &[f64], within: f64) {
        let scale = b.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= within * scale), "{a:?} is not {b:?}");
    }

    /// The four lines of every textbook: N a K c / 4 and so on, here in N and mm, and along the axis away from the work.
    #[test]
    fn a_slot_is_as_by_hand() {
        let (n, a, c) = (4.0, 2.0, 0.1);
        let by_hand = [
            -n * a * 168.8 * c / 4.0 - n * a * 26.6 / PI,
            n * a * 767.01 * c / 4.0 + n * a * 27.7 / PI,
            -n * a * 222.0 * c / PI - n * a * 0.7 / 2.0,
        ];
        let found = mill(Side::Slot, 0.016, 0.0, LINEAR).force(1.0).unwrap();
        close(&found.mean.unwrap(), &by_hand, 1e-13);
        // Tangential force times radius: N D a (K_tc c + pi K_te / 2) / (2 pi), in N m.
        let moment = n * 16.0 * a * (767.01 * c + PI * 27.7 / 2.0) / TAU / 1e3;
        close(&[found.moment], &[moment], 1e-13);
    }

    /// The closed mean against the sum over a revolution of the tool itself, straight and with a helix that winds further than a pitch.
    #[test]
    fn the_mean_is_that_of_the_revolution() {
        for edge in [LINEAR, POWER] {
            for (side, width) in
                [(Side::Slot, 0.016), (Side::Up, 0.008), (Side::Down, 0.008), (Side::Down, 0.001), (Side::Up, 0.0137)]
            {
                for helix in [0.0, 0.5, 1.3] {
                    let one = mill(side, width, helix, edge);
                    let mean = one.mean();
                    // Straight teeth: over the angles of the cut, where nothing jumps. Else over the revolution, which is periodic.
                    let summed = if helix == 0.0 {
                        let CutArc { entry, exit, depth } = one.engagement.arcs[0];
                        integral(|phi| one.tooth(phi), entry, exit, 200).map(|part| part * 4.0 * depth / TAU)
                    } else {
                        let CutArc { entry, exit, .. } = one.engagement.arcs[0];
                        let mut breaks: Vec<f64> = [
                            entry,
                            exit,
                            entry + one.lag(&one.engagement.arcs[0]),
                            exit + one.lag(&one.engagement.arcs[0]),
                        ]
                        .map(|at| at.rem_euclid(TAU / 4.0))
                        .to_vec();
                        breaks.extend([0.0, TAU / 4.0]);
                        breaks.sort_by(f64::total_cmp);
                        let mut sum = [0.0; 4];
                        for pair in breaks.windows(2) {
                            let part = integral(|angle| one.at(angle), pair[0], pair[1], 40);
                            (0..4).for_each(|i| sum[i] += part[i] * 4.0 / TAU);
                        }
                        sum
                    };
                    // Under Kienzle's law the four pieces of `at` see the power at thin chips; the tool is held to less there.
                    let within = if matches!(edge, Edge::Power { .. }) { 1e-6 } else { 1e-9 };
                    close(&mean, &summed, within);
                }
            }
        }
    }

    /// A rake face without friction pushes across its edge. That of a helix winds back as it rises: what lies above stands where the bottom stood by
    /// the lag before, so that the edge runs along `(-tan b cos, tan b sin, 1)`, and the tool is drawn into the work by `tan b` of the tangential force.
    #[test]
    fn a_helix_draws_the_tool_into_the_work() {
        let helix = 0.6_f64;
        let edge = Edge::Linear { chip: [1e9, 0.0, 1e9 * helix.tan()], rubbing: [0.0; 3] };
        let one = mill(Side::Slot, 0.016, helix, edge);
        let lag = one.lag(&one.engagement.arcs[0]) / one.engagement.depth();
        for phi in [0.3_f64, 1.2, 2.9] {
            let place = |angle: f64| [one.diameter / 2.0 * angle.sin(), one.diameter / 2.0 * angle.cos()];
            let (below, above) = (place(phi), place(phi - lag * 1e-6));
            let along = [(above[0] - below[0]) / 1e-6, (above[1] - below[1]) / 1e-6, 1.0];
            let [x, y, z, _] = one.tooth(phi);
            let across = x * along[0] + y * along[1] + z;
            assert!(z < 0.0 && across.abs() < 1e-3 * x.hypot(y), "{phi}: {across} of {x} {y} {z}");
        }
    }

    /// One straight tooth in a slot: across, the force is largest where the chip is thickest; along the feed at the ends, by rubbing.
    #[test]
    fn extremes_of_one_straight_tooth_are_as_by_hand() {
        let one = Milling { teeth: 1, ..mill(Side::Slot, 0.016, 0.0, LINEAR) };
        let found = one.force(1.0).unwrap();
        let [low, high] = found.range.unwrap();
        close(&[low[2], high[2]], &[-2.0 * (222.0 * 0.1 + 0.7), 0.0], 1e-9);
        // At the exit phi = pi: F_x = a K_te; F_y there is a K_re.
        let grid: Vec<Felt> = (0..=100_000).map(|i| one.at(PI * f64::from(i) / 1e5)).collect();
        for i in 0..3 {
            let most = grid.iter().map(|felt| felt[i]).fold(f64::MIN, f64::max).max(0.0);
            let least = grid.iter().map(|felt| felt[i]).fold(f64::MAX, f64::min).min(0.0);
            close(&[low[i], high[i]], &[least, most], 1e-4);
        }
        // Four teeth in a slot: two always cut, so that the force across never vanishes.
        let four = mill(Side::Slot, 0.016, 0.0, LINEAR).force(1.0).unwrap().range.unwrap();
        assert!(0.0 < four[0][1]);
    }

    /// In a slot half of an even number of straight teeth cut at every angle, in half the width a quarter of those whose number four divides: as one
    /// enters another leaves. Edges that only rub axially feel 20 N/mm on 2 mm each.
    #[test]
    fn as_a_straight_tooth_enters_another_leaves() {
        let rubs = Edge::Linear { chip: [0.0; 3], rubbing: [0.0, 0.0, 20e3] };
        let cases = [(Side::Slot, 0.016, 2), (Side::Up, 0.008, 4), (Side::Down, 0.008, 4)];
        for (side, width, apart) in cases {
            for teeth in (apart..=24).step_by(apart) {
                let one = Milling { teeth, ..mill(side, width, 0.0, rubs) };
                let found = one.force(1.0).unwrap();
                let expected = 40.0 * (teeth / apart) as f64;
                let [low, high] = found.range.unwrap();
                for value in [-low[2], -high[2], found.largest, -found.mean.unwrap()[2]] {
                    assert!((value - expected).abs() < 1e-9, "{side:?}, {teeth} teeth: {value} is not {expected}");
                }
                assert!(found.revolution.iter().all(|force| (force[2] + expected).abs() < 1e-9), "{teeth} teeth");
            }
        }
    }

    /// Up milling has its material to the left of a tool that turns clockwise: moved there it cuts a wider strip, as if that had been asked; moved
    /// away from the work it cuts less deep. Down milling has it to the right; a slot is one wherever the tool is.
    #[test]
    fn a_tool_that_is_moved_cuts_another_width_and_another_depth() {
        let of = |side: Side, width: f64, depth: f64| {
            let [entry, exit] = Engagement::angles(side, width, 0.016);
            let edge = Edge::Linear { chip: [8e8, 2e8, 2e8], rubbing: [3e4, 3e4, 1e3] };
            let engagement = Engagement::at_depth(depth, [entry, exit], 1e-4);
            Milling { diameter: 0.016, teeth: 4, helix: 0.5, engagement, edge }
        };
        let mean = |milling: Milling, sense: f64| milling.checked_mean(sense).unwrap().0;
        for (side, to_the_left) in [(Side::Up, 1.0), (Side::Down, -1.0)] {
            for sense in [1.0, -1.0] {
                let [across, axial] = of(side, 0.004, 0.002).changes(sense).unwrap();
                let wider = [mean(of(side, 0.00401, 0.002), sense), mean(of(side, 0.00399, 0.002), sense)];
                let deeper = [mean(of(side, 0.004, 0.00201), sense), mean(of(side, 0.004, 0.00199), sense)];
                for i in 0..3 {
                    let by_width = sense * to_the_left * (wider[0][i] - wider[1][i]) / 2e-5;
                    let by_depth = (deeper[0][i] - deeper[1][i]) / 2e-5;
                    // Central differences over steps of 1/400 of the width.
                    assert!(
                        (across[i] - by_width).abs() < 1e-4 * by_width.abs() + 1.0,
                        "{side:?} {sense}: {across:?} {by_width}"
                    );
                    assert!((axial[i] + by_depth).abs() < 1e-6 * by_depth.abs() + 1e-3, "{axial:?} {by_depth}");
                }
            }
        }
        assert_eq!(of(Side::Slot, 0.016, 0.002).changes(1.0).unwrap()[0], [0.0; 3]);
    }

    /// Up milling with one sense is the mirror image of up milling with the other.
    #[test]
    fn a_tool_that_turns_the_other_way_is_pushed_to_the_other_side() {
        let one = mill(Side::Up, 0.004, 0.6, LINEAR);
        let [cw, ccw] = [1.0, -1.0].map(|sense| one.force(sense).unwrap());
        let ([x, y, z], mirrored) = (cw.mean.unwrap(), ccw.mean.unwrap());
        assert_eq!(mirrored, [x, -y, z]);
        assert_eq!(cw.moment, -ccw.moment);
        assert_eq!(cw.range.unwrap()[1][1], -ccw.range.unwrap()[0][1]);
    }

    #[test]
    fn engagements_that_are_none_are_refused() {
        let good = mill(Side::Up, 0.004, 0.6, LINEAR);
        let cut = |change: fn(&mut Milling)| {
            let mut one = good.clone();
            change(&mut one);
            one.force(1.0)
        };
        assert!(cut(|_| ()).is_ok());
        assert!(cut(|one| one.engagement.arcs[0].depth = f64::NAN).is_err());
        assert!(cut(|one| one.engagement.arcs[0].exit = one.engagement.entry()).is_err());
        assert!(cut(|one| one.engagement.feed_per_tooth = 0.0).is_err());
        assert!(cut(|one| one.teeth = 0).is_err());
        assert!(cut(|one| one.diameter = f64::INFINITY).is_err());
        assert!(cut(|one| one.helix = 2.0).is_err());
    }

    /// An arc in two pieces is one arc; and of two depths each piece gives what it would alone.
    #[test]
    fn arcs_add_up() {
        let arc = |depth: f64, entry: f64, exit: f64| CutArc { depth, entry, exit };
        let with = |arcs: &[CutArc], helix: f64| Milling {
            engagement: Engagement { arcs: arcs.to_vec(), feed_per_tooth: 1e-4 },
            ..mill(Side::Slot, 0.016, helix, LINEAR)
        };
        let flat = |one: &Milling| one.changes(1.0).unwrap().concat();
        for helix in [0.0, 0.5] {
            let whole = with(&[arc(0.002, 0.4, 2.6)], helix);
            let split = with(&[arc(0.002, 0.4, 1.7), arc(0.002, 1.7, 2.6)], helix);
            close(&split.mean(), &whole.mean(), 1e-13);
            for angle in [0.2, 0.9, 1.6, 2.2] {
                close(&split.at(angle), &whole.at(angle), 1e-9);
            }
            // By a wall that moves: a step of a thousandth of the radius sees the third order.
            close(&flat(&split), &flat(&whole), 1e-5);
            close(split.mean_directional().as_slice(), whole.mean_directional().as_slice(), 1e-13);
            close(split.step_directional(0.3, 0.9).as_slice(), whole.step_directional(0.3, 0.9).as_slice(), 1e-13);
            // Half a depth on one piece: A0 counts by the larger one.
            let parts = [arc(0.001, 0.4, 1.7), arc(0.002, 1.7, 2.6)];
            let (uneven, [shallow, deep]) = (with(&parts, helix), parts.map(|part| with(&[part], helix)));
            let sum: Vec<f64> = shallow.mean().iter().zip(deep.mean()).map(|(a, b)| a + b).collect();
            close(&uneven.mean(), &sum, 1e-13);
            let of_both = |of: fn(&Milling) -> nalgebra::Matrix3x2<f64>| 0.5 * of(&shallow) + of(&deep);
            close(uneven.mean_directional().as_slice(), of_both(Milling::mean_directional).as_slice(), 1e-13);
            let step = |one: &Milling| one.step_directional(0.3, 0.9);
            close(step(&uneven).as_slice(), of_both(step).as_slice(), 1e-13);
        }
        let gone = with(&[arc(0.002, 1.7, 2.6), arc(0.002, 0.4, 1.7)], 0.0);
        assert!(gone.force(1.0).is_err() && with(&[], 0.0).force(1.0).is_err());
    }
}
