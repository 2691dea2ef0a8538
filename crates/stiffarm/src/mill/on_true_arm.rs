//! Which joints must a calibrated arm be sent to, so that it stands on the path under its load, and what errs without that?
//!
//! With the true chain `F(psi)`, the link angles `psi_t` of a target and the known force `w`
//!
//! ```text
//! psi_cmd = psi_t - A kappa A^T J(psi_t)^T w,   theta_cmd + d(theta_cmd) = psi_cmd
//! ```
//!
//! The controller computes with the arm as drawn: a pose that is commanded is that of the drawn arm at these joints.

use nalgebra::{Matrix3, Point3, Vector3, Vector6};

use super::compensate::{joint_deflection, known_wrench};
use super::fault::MillError;
use super::follow::{Pushed, Stand};
use super::stations::{Acting, ErrorPart, Station};
use crate::calibration::ControllerModel;
use crate::chain::TrueArm;
use crate::compliance::PostureError;
use crate::drive::Drives;
use crate::geometry::Geometry;
use crate::limits::Limits;
use crate::mass::ToolWeight;
use crate::parallel;
use crate::robot::{Arm, Robot};
use crate::spatial::{Pose, Wrench};
use crate::tolerances::LIMIT;
use crate::toolpath::ToolPose;
use crate::watch::Watch;

/// Rounds in which the loaded posture is found, and the joints' change that ends them, rad.
const ROUNDS: usize = 40;
const SETTLED: f64 = 1e-13;
/// A third point counts where it is so far beside the line through two others, as a part of their distance.
const BESIDE: f64 = 0.05;

/// How the place of the work was found; it decides which errors count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WorkFrame {
    /// By an instrument, in the frame of the base: all of the arm's error counts.
    Measured,
    /// By touching points of the work with this arm: what they share cancels.
    #[default]
    Touched,
}

impl WorkFrame {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Measured, Self::Touched];

    /// As it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Touched => "touched",
        }
    }
}

/// The largest error of a calibrated arm along what feeds, m, geometry and load together; of a force that may point anywhere at most so much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmErrors {
    /// Nothing is corrected.
    pub uncorrected: f64,
    /// The deflection alone; `None` under a force that may point anywhere.
    pub by_stiffness: Option<f64>,
    /// The geometry alone.
    pub by_geometry: f64,
    /// Both; `None` as above.
    pub by_both: Option<f64>,
}

/// A path on the arm that stands there.
#[derive(Clone, Debug, PartialEq)]
pub struct OnTrueArm {
    /// Joints to be commanded at every station, as the robot reports them, rad.
    pub joints: Vec<[f64; 6]>,
    /// The tool in the part, in the frame that the controller has of it, at these joints: as drawn, and where it truly stands without load.
    pub poses: Vec<[ToolPose; 2]>,
    /// Where the part truly stands.
    pub base_from_part: Pose,
    /// The points at which the work is touched, m, part frame; none where it is measured.
    pub touched: Vec<[f64; 3]>,
    /// What errs.
    pub errors: ArmErrors,
    /// Stations at which a commanded joint lies beyond its range.
    pub beyond: Vec<usize>,
}

/// What a path is commanded for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrueOptions {
    /// How the place of the work was found.
    pub work_frame: WorkFrame,
    /// What counts as error.
    pub part: ErrorPart,
    /// The deflection is taken out, too.
    pub is_compensated: bool,
    /// What hangs on the flange of an arm whose base stands upright, and was not there when it was calibrated.
    pub held: Option<ToolWeight>,
}

/// The path on the arm that stands there; `None` of a robot that was not calibrated. The part stands where the controller has it.
///
/// # Errors
/// A posture that the true arm does not have; a force that may point anywhere where it is to be compensated; a planar robot; what was stopped.
pub fn on_true_arm(
    robot: &Robot,
    stand: &Stand,
    (stations, followed): (&[Station], &[Pushed]),
    options: &TrueOptions,
    watch: Watch,
) -> Result<Option<OnTrueArm>, MillError> {
    let Arm::SixAxis { geometry, limits, drives } = &robot.arm else {
        return Err(PostureError::Planar(robot.name.clone()).into());
    };
    let Some(own) = TrueArm::of(robot) else { return Ok(None) };
    let arm = own.clone().holding(robot, options.held.as_ref());
    let controller = robot.calibration.as_ref().and_then(|calibration| calibration.controller);
    let corrects_itself = controller == Some(ControllerModel::Calibrated);
    // A controller that knows the true arm has the work where it truly is.
    let at_touch = match options.work_frame {
        WorkFrame::Touched if !corrects_itself => touched(stations),
        WorkFrame::Touched | WorkFrame::Measured => Vec::new(),
    };
    let truly = Stand { base_from_part: found_by_touch(&arm, stand, (stations, followed), &at_touch), ..*stand };
    let setup =
        Setup { robot, own: &own, arm: &arm, geometry, limits, drives, stand, truly: &truly, options, corrects_itself };
    let one = |i: usize| {
        watch.go_on()?;
        setup.commanded(&stations[i], &followed[i])
    };
    let all: Vec<Commanded> = parallel::try_each_of(stations.len(), one)?;
    let is_beyond = |i: &usize| (0..6).any(|joint| !limits.joints[joint].contains(all[*i].joints[joint], LIMIT));
    Ok(Some(OnTrueArm {
        joints: all.iter().map(|one| one.joints).collect(),
        poses: all.iter().map(|one| one.poses).collect(),
        base_from_part: truly.base_from_part,
        touched: at_touch.iter().map(|i| stations[*i].sample.pose.tip.into()).collect(),
        errors: largest(all.iter().filter_map(|one| one.errors)),
        beyond: (0..all.len()).filter(is_beyond).collect(),
    }))
}

/// What is commanded at one station, and what errs there where it feeds.
struct Commanded {
    joints: [f64; 6],
    poses: [ToolPose; 2],
    errors: Option<ArmErrors>,
}

struct Setup<'a> {
    robot: &'a Robot,
    /// As it was calibrated, and with its tool.
    own: &'a TrueArm,
    arm: &'a TrueArm,
    geometry: &'a Geometry,
    limits: &'a Limits,
    drives: &'a Drives,
    /// The part as the controller has it, and where it truly stands.
    stand: &'a Stand,
    truly: &'a Stand,
    options: &'a TrueOptions,
    corrects_itself: bool,
}

impl Setup<'_> {
    fn commanded(&self, station: &Station, pushed: &Pushed) -> Result<Commanded, MillError> {
        let sample = &station.sample;
        let drawn = self.geometry.model_angles(&pushed.joints, self.limits.third_axis);
        let wrench = if let Some(Acting::Any(_)) = station.acting { None } else { known_wrench(self.truly, station)? };
        if self.options.is_compensated && matches!(station.acting, Some(Acting::Any(_))) {
            return Err(MillError::AnyDirection);
        }
        let flange =
            self.truly.base_from_tool(sample, pushed.arrangement.roll)? * self.stand.flange_from_tool.inverse();
        let none = || MillError::Vanished { line: sample.line };
        let target = self.arm.link_angles_near(&flange, &self.arm.link_angles(&drawn)).ok_or_else(none)?;
        let without_load = self.arm.model_angles(&target).ok_or_else(none)?;
        let turned = wrench.as_ref().map(|wrench| self.deflection(&target, wrench)).transpose()?;
        let loaded = turned.map(|turned| std::array::from_fn(|i| target[i] - turned[i]));
        let with_load = match &loaded {
            None => without_load,
            Some(loaded) => self.arm.model_angles(loaded).ok_or_else(none)?,
        };
        let theta = if self.options.is_compensated { with_load } else { without_load };
        let errors = if sample.is_cutting {
            // A controller that corrects the arm knows it as it was calibrated.
            let by_itself = |psi: &[f64; 6]| self.own.model_angles(psi).ok_or_else(none);
            let (drawn, stiff) = if self.corrects_itself {
                (by_itself(&target)?, by_itself(loaded.as_ref().unwrap_or(&target))?)
            } else {
                (drawn, self.by_stiffness(&drawn, wrench.as_ref())?)
            };
            Some(self.errors((station, pushed), wrench.as_ref(), [&drawn, &stiff, &without_load, &with_load])?)
        } else {
            None
        };
        let joints = self.geometry.reported(&theta, self.limits.third_axis);
        let in_part = |flange: Pose, stand: &Stand| {
            let tool = stand.base_from_part.inverse() * flange * stand.flange_from_tool;
            ToolPose { tip: tool.translation.vector, axis: -(tool.rotation * Vector3::z()) }
        };
        let truly = self.own.placed(&self.own.link_angles(&theta)).flange();
        let poses = [in_part(self.geometry.forward(&theta), self.stand), in_part(truly, self.truly)];
        Ok(Commanded { joints, poses, errors })
    }

    /// The model angles that take the deflection out of the arm as drawn.
    fn by_stiffness(&self, drawn: &[f64; 6], wrench: Option<&Wrench>) -> Result<[f64; 6], MillError> {
        let Some(wrench) = wrench else { return Ok(*drawn) };
        let turned = joint_deflection(self.robot, drawn, self.stand, wrench)?;
        Ok(std::array::from_fn(|i| drawn[i] - turned[i]))
    }

    /// What counts of how far the loaded tip is off: as drawn, with the deflection, the geometry, both taken out.
    fn errors(
        &self,
        (station, pushed): (&Station, &Pushed),
        wrench: Option<&Wrench>,
        commanded: [&[f64; 6]; 4],
    ) -> Result<ArmErrors, MillError> {
        let any = if let Some(Acting::Any(_)) = station.acting { Some(pushed.error) } else { None };
        let mut off = [0.0; 4];
        for (off, theta) in off.iter_mut().zip(commanded) {
            *off = self.off(station, theta, wrench)? + any.unwrap_or(0.0);
        }
        let [uncorrected, stiff, by_geometry, both] = off;
        let known = |off: f64| any.is_none().then_some(off);
        Ok(ArmErrors { uncorrected, by_stiffness: known(stiff), by_geometry, by_both: known(both) })
    }

    fn off(&self, station: &Station, theta: &[f64; 6], wrench: Option<&Wrench>) -> Result<f64, MillError> {
        let psi = self.loaded(&self.arm.link_angles(theta), wrench, station.sample.line)?;
        let tip = (self.arm.placed(&psi).flange() * self.stand.flange_from_tool).translation.vector;
        let off = tip - (self.truly.base_from_part * Point3::from(station.sample.pose.tip)).coords;
        let counted = self.options.part.direction(&self.truly.cutting_axes(&station.sample), &station.sample);
        Ok(counted.map_or_else(|| off.norm(), |counted| counted.dot(&off).abs()))
    }

    /// The link angles at which the springs hold a wrench, found round by round.
    fn loaded(&self, free: &[f64; 6], wrench: Option<&Wrench>, line: usize) -> Result<[f64; 6], MillError> {
        let (mut psi, Some(wrench)) = (*free, wrench) else { return Ok(*free) };
        let mut change = f64::INFINITY;
        for _ in 0..ROUNDS {
            let turned = self.deflection(&psi, wrench)?;
            let next: [f64; 6] = std::array::from_fn(|i| free[i] + turned[i]);
            change = (0..6).map(|i| (next[i] - psi[i]).abs()).fold(0.0, f64::max);
            psi = next;
            if change <= SETTLED {
                return Ok(psi);
            }
        }
        Err(MillError::Unsettled { line, change })
    }

    /// By how much links give way under a wrench at the tip, rad: `A kappa A^T J^T w`.
    fn deflection(&self, psi: &[f64; 6], wrench: &Wrench) -> Result<Vector6<f64>, MillError> {
        let placed = self.arm.placed(psi);
        let tip = (placed.flange() * self.stand.flange_from_tool).translation.vector;
        let unheld = || PostureError::Unstable(self.robot.name.clone());
        let kappa = self.drives.compliance_at(psi[1]).ok_or_else(unheld)?;
        let a = self.drives.transmission.0;
        let torques = a.transpose() * placed.jacobian(&tip).transpose() * wrench.0;
        Ok(a * torques.component_mul(&Vector6::from(kappa)))
    }
}

/// The largest of each; what is not known at one place is not known.
fn largest(errors: impl Iterator<Item = ArmErrors>) -> ArmErrors {
    let zero = ArmErrors { uncorrected: 0.0, by_stiffness: Some(0.0), by_geometry: 0.0, by_both: Some(0.0) };
    let more = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a.max(b));
    errors.fold(zero, |all, one| ArmErrors {
        uncorrected: all.uncorrected.max(one.uncorrected),
        by_stiffness: more(all.by_stiffness, one.by_stiffness),
        by_geometry: all.by_geometry.max(one.by_geometry),
        by_both: more(all.by_both, one.by_both),
    })
}

/// Up to three stations that feed, far from each other: where the work is taken to be touched, with the tool as it mills there.
pub(super) fn touched(stations: &[Station]) -> Vec<usize> {
    let feeding: Vec<usize> = (0..stations.len()).filter(|i| stations[*i].sample.is_cutting).collect();
    let tip = |i: usize| stations[i].sample.pose.tip;
    let farthest = |off: &dyn Fn(usize) -> f64| feeding.iter().copied().max_by(|a, b| off(*a).total_cmp(&off(*b)));
    let Some(first) = feeding.first().and_then(|first| farthest(&|i| (tip(i) - tip(*first)).norm())) else {
        return Vec::new();
    };
    let Some(second) = farthest(&|i| (tip(i) - tip(first)).norm()) else { return vec![first] };
    let Some(along) = (tip(second) - tip(first)).try_normalize(1e-6) else { return vec![first] };
    let beside = |i: usize| (tip(i) - tip(first)).cross(&along).norm();
    let length = (tip(second) - tip(first)).norm();
    let third = farthest(&beside).filter(|third| BESIDE * length <= beside(*third));
    [first, second].into_iter().chain(third).collect()
}

/// Where the part truly stands that a controller has at `stand` by these touches: moved as little as they tell.
fn found_by_touch(
    arm: &TrueArm,
    stand: &Stand,
    (stations, followed): (&[Station], &[Pushed]),
    touched: &[usize],
) -> Pose {
    const ROUNDS: usize = 5;
    let truly = |i: &usize| (arm.flange(&followed[*i].joints) * stand.flange_from_tool).translation.vector;
    let seen: Vec<Vector3<f64>> = touched.iter().map(truly).collect();
    let mut base_from_part = stand.base_from_part;
    for _ in 0..ROUNDS {
        let at = |i: &usize| (base_from_part * Point3::from(stations[*i].sample.pose.tip)).coords;
        let at: Vec<Vector3<f64>> = touched.iter().map(at).collect();
        let off: Vec<Vector3<f64>> = seen.iter().zip(&at).map(|(seen, at)| seen - at).collect();
        let moved = moved(&at, &off);
        let about = moved.about;
        base_from_part = Pose::translation(about.x, about.y, about.z)
            * Pose::from_parts(moved.shift.into(), nalgebra::UnitQuaternion::new(moved.turn))
            * Pose::translation(-about.x, -about.y, -about.z)
            * base_from_part;
    }
    base_from_part
}

/// A small rigid motion: a turn, rad, about a point, m, and a shift, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moved {
    pub(super) about: Vector3<f64>,
    pub(super) shift: Vector3<f64>,
    pub(super) turn: Vector3<f64>,
}

impl Moved {
    /// By how much it moves a point.
    pub(super) fn at(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.shift + self.turn.cross(&(point - self.about))
    }
}

/// The small motion that takes points nearest to where they are off, least squares; what they do not tell of its turn is none.
pub(super) fn moved(at: &[Vector3<f64>], off: &[Vector3<f64>]) -> Moved {
    /// Of the largest moment of inertia.
    const LEAST: f64 = 1e-9;
    let count = at.len().max(1) as f64;
    let about = at.iter().sum::<Vector3<f64>>() / count;
    let shift = off.iter().sum::<Vector3<f64>>() / count;
    let (mut inertia, mut moment) = (Matrix3::zeros(), Vector3::zeros());
    for (at, off) in at.iter().zip(off) {
        let from = at - about;
        inertia += Matrix3::identity() * from.norm_squared() - from * from.transpose();
        moment += from.cross(off);
    }
    let eigen = inertia.symmetric_eigen();
    let largest = eigen.eigenvalues.amax();
    let turn = (0..3).filter(|i| 0.0 < largest && LEAST * largest < eigen.eigenvalues[*i]).map(|i| {
        let axis: Vector3<f64> = eigen.eigenvectors.column(i).into();
        axis * (axis.dot(&moment) / eigen.eigenvalues[i])
    });
    Moved { about, shift, turn: turn.sum() }
}
