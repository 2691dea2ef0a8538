//! How does an arm swing over a zone at its place, and below which frequency does it swing nowhere?
//!
//! `lambda_max` of `k^1/2 M k^1/2` is convex in `M`. Over a part of the zone `M` is affine in the coordinates of the zone but for a remainder
//! `R`, entry by entry (`enclose`): `lambda_max` is at most its largest value at the vertices plus the largest eigenvalue of
//! `k^1/2 R k^1/2` (\[theory\], section 12).

use nalgebra::{Matrix6, Rotation3, Vector3};

use super::arm::SwingingArm;
use super::{HeldTool, ModesError, frequency, spreads};
use crate::enclose::{Affine, ArmEnclosure, least_over};
use crate::inverse::{Configuration, posture_of};
use crate::mass::inertia_of;
use crate::model::{Model, SpatialModel};
use crate::place::{PlaceOptions, Placement, SpaceHold};
use crate::spatial::Pose;
use crate::task::Zone;
use crate::tolerances;
use crate::uncertainty::Spread;
use crate::work::{Grid, WorkPlacement, WorkPlane};

/// The proof goes on until it is within this part of the least first frequency that was found.
const NEAR: f64 = 0.01;
/// Cells of the sampled grid along the shorter side of a zone.
const CELLS: usize = 32;

/// One mode over a zone; modes are counted by their frequencies at each point, from the lowest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeOverZone {
    /// The least frequency of the points that were looked at, Hz.
    pub least: f64,
    /// Where, m from the base.
    pub least_at: [f64; 3],
    /// How far the frequency there may be off with the stiffness of the drives, Hz; `None` where nothing says how far that may be.
    pub spread: Option<Spread>,
    /// The largest frequency of the points that were looked at, Hz.
    pub largest: f64,
    /// Where, m from the base.
    pub largest_at: [f64; 3],
}

/// How an arm swings over a zone that it holds in one configuration, motors held still.
#[derive(Clone, Debug, PartialEq)]
pub struct SwingOverZone {
    /// Ascending.
    pub modes: Vec<ModeOverZone>,
    /// How many points were looked at.
    pub points: usize,
    /// The largest distance between neighbours of them, m.
    pub step: f64,
    /// Nowhere in the zone is the first frequency lower, Hz: proved for the stiffness that is stated; `None` where the proof did not end.
    pub first_at_least: Option<f64>,
    /// Into how many parts the zone was cut for that.
    pub parts: usize,
}

/// How an arm swings over a zone at the place and in the hold that a placement has for it.
///
/// # Errors
/// A robot without masses, a tool that makes no sense, and a zone that is not held in space.
pub fn modes_over(
    model: &Model,
    zone: Zone,
    options: &PlaceOptions,
    placement: &Placement,
    tool: &HeldTool,
) -> Result<SwingOverZone, ModesError> {
    let arm = SwingingArm::new(model.robot(), tool)?;
    let (Model::Spatial(model), Some(hold)) = (model, placement.space()) else { return Err(ModesError::NotInSpace) };
    let held = HeldSwing::new(model, &arm, zone, (options.tool_orientation().elevation, hold.work(placement), hold));
    let grid = Grid::of(zone, CELLS);
    let samples = grid.points.iter().map(|&at| Ok((at, held.frequencies(at)?)));
    let samples: Vec<([f64; 2], Vec<f64>)> = samples.collect::<Result<_, ModesError>>()?;
    let (first_at_least, parts) = held.first_at_least();
    let count = samples.iter().map(|(_, frequencies)| frequencies.len()).min().unwrap_or(0);
    if count == 0 {
        return Err(ModesError::Nothing(model.robot().name.clone()));
    }
    let modes = (0..count).map(|rank| held.mode(rank, &samples)).collect::<Result<_, ModesError>>()?;
    Ok(SwingOverZone { modes, points: samples.len(), step: grid.step, first_at_least, parts })
}

/// A zone at its place, held in one configuration by an arm that swings.
struct HeldSwing<'a> {
    arm: &'a SwingingArm<'a>,
    enclosure: ArmEnclosure,
    tool_from_flange: Pose,
    plane: WorkPlane,
    work: WorkPlacement,
    zone: Zone,
    configuration: Configuration,
    /// By how much the zone is turned about the joint-1 axis, rad.
    bearing: f64,
}

impl<'a> HeldSwing<'a> {
    fn new(
        model: &SpatialModel,
        arm: &'a SwingingArm<'a>,
        zone: Zone,
        (elevation, work, hold): (f64, WorkPlacement, &SpaceHold),
    ) -> Self {
        Self {
            arm,
            enclosure: ArmEnclosure::new(&model.arm().without_limits(), [false; 6]),
            tool_from_flange: model.flange_from_tool().inverse(),
            plane: WorkPlane::of(elevation, &work),
            work,
            zone,
            configuration: hold.configuration,
            bearing: hold.bearing,
        }
    }

    /// Model angles at a point of the zone, m from its centre, rad.
    fn angles(&self, at: [f64; 2]) -> Result<[f64; 6], ModesError> {
        let flange = self.plane.pose(&self.work, at) * self.tool_from_flange;
        posture_of(self.arm.geometry(), &flange, self.configuration).ok_or(ModesError::NotHeld(at))
    }

    /// Frequencies at a point of the zone, m from its centre, Hz.
    fn frequencies(&self, at: [f64; 2]) -> Result<Vec<f64>, ModesError> {
        self.arm.frequencies_at(&self.angles(at)?)
    }

    /// From the base, m.
    fn place(&self, at: [f64; 2]) -> [f64; 3] {
        (Rotation3::from_axis_angle(&Vector3::z_axis(), self.bearing) * self.plane.point(&self.work, at)).into()
    }

    /// One mode of samples, at least one.
    fn mode(&self, rank: usize, samples: &[([f64; 2], Vec<f64>)]) -> Result<ModeOverZone, ModesError> {
        let of = |sample: &([f64; 2], Vec<f64>)| (sample.1[rank], sample.0);
        let (mut least, mut largest) = (of(&samples[0]), of(&samples[0]));
        for sample in samples.iter().map(of) {
            if sample.0 < least.0 {
                least = sample;
            }
            if largest.0 < sample.0 {
                largest = sample;
            }
        }
        let (k, in_drives) = self.arm.springs_and_inertia(&self.angles(least.1)?)?;
        let spreads = spreads(self.arm.robot(), &k, &in_drives);
        Ok(ModeOverZone {
            least: least.0,
            least_at: self.place(least.1),
            spread: spreads.and_then(|spreads| spreads.get(rank).copied()),
            largest: largest.0,
            largest_at: self.place(largest.1),
        })
    }

    /// A proved lower bound on the first frequency in the zone, Hz, and into how many parts the zone was cut for it.
    fn first_at_least(&self) -> (Option<f64>, usize) {
        // Of frequencies that go by 1/lambda^1/2.
        let near = (1.0 - NEAR).powi(-2);
        let value = |at: [f64; 2]| {
            let found = self.frequencies(at).map(|found| found.first().copied());
            // Where a point is not held nothing is proved.
            found.map_or(f64::NEG_INFINITY, |first| first.map_or(0.0, |first| -lambda(first)))
        };
        let bound = |part: [Affine<2>; 2]| self.most_lambda(part).map_or(f64::NEG_INFINITY, |lambda| -lambda);
        let found = least_over(self.zone, |bound, found| found * near <= bound, bound, value);
        let most = -found.bound;
        let is_bound = 0.0 < most && most.is_finite();
        (is_bound.then(|| frequency(most) * (1.0 - tolerances::BOUND)), found.parts)
    }

    /// No point of a part of the zone has a larger `lambda = 1/w^2`, s^2; `None` where nothing is known of the part.
    fn most_lambda(&self, part: [Affine<2>; 2]) -> Option<f64> {
        let [at_vertices, left_over] = self.enclosed_lambda(part)?;
        Some(at_vertices + left_over)
    }

    /// The largest `lambda` at the vertices of a part, and by how much it may be more for what is not affine, s^2.
    fn enclosed_lambda(&self, part: [Affine<2>; 2]) -> Option<[f64; 2]> {
        let (directions, k) = self.enclosure.directions(&self.plane, &self.work, part, self.configuration)?;
        let inertia = inertia_of(self.arm.geometry(), &directions, self.arm.bodies());
        // Softer drives swing slower, whatever the masses.
        let root = Matrix6::from_diagonal(&k.map(|k| k.max().sqrt()).into());
        let a = self.arm.drives().transmission.0;
        let each = |part: &dyn Fn(&Affine<2>) -> f64| Matrix6::from_fn(|i, j| part(&inertia[i.max(j)][i.min(j)]));
        let in_springs = |m: Matrix6<f64>| root * a.transpose() * m * a * root;
        let middle = in_springs(each(&|x| x.centre));
        let [first, second] = [0, 1].map(|i| in_springs(each(&|x| x.deviations[i])));
        let left_over = root * a.abs().transpose() * each(&|x| x.remainder) * a.abs() * root;
        if ![middle, first, second, left_over].iter().all(|m| m.iter().all(|x| x.is_finite())) {
            return None;
        }
        let vertices =
            [middle - first - second, middle - first + second, middle + first - second, middle + first + second];
        let largest = |m: Matrix6<f64>| m.symmetric_eigenvalues().max();
        // |u^T E u| <= |u|^T R |u| for every E whose entries are at most those of R.
        Some([vertices.map(largest).into_iter().fold(0.0, f64::max), largest(left_over)])
    }
}

/// `1/w^2`, s^2, of a frequency, Hz.
fn lambda(hertz: f64) -> f64 {
    (std::f64::consts::TAU * hertz).powi(-2)
}

#[cfg(test)]
mod tests;
