//! What is computed with: a robot made ready under one model of what gives way.

use crate::batch::SpatialArm;
use crate::compliance::{PostureError, check_held};
use crate::plane::{ElbowSide, InvalidArm, PlanarArm};
use crate::robot::{Arm, ArmPlane, NoArmPlane, Robot};
use crate::spatial::Pose;

/// A robot made ready: frame, limits and elasticity under one set of assumptions. Every verb takes one.
///
/// Positions that go in and come out count from the robot's base (of two links alone, from their joint-2 axis). What only one model can do is asked of it.
///
/// ```
/// use stiffarm::catalogue::find;
/// use stiffarm::model::Model;
/// use stiffarm::spatial::Pose;
///
/// let robot = find("KR 210 R2700 extra").ok_or("in the catalogue")?.robot();
/// let spindle = Pose::translation(0.0, 0.0, 0.25); // m, in the flange frame
/// for model in [Model::planar(&robot)?, Model::spatial(&robot, &spindle)?] {
///     assert!(model.is_linear_in_load(), "{}", model.kind().name());
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub enum Model {
    /// The paper's: drives 2 and 3 are compliant, the tool point is the wrist centre, work lies in the arm plane.
    Planar(PlanarModel),
    /// All six drives are compliant, the tool point is where it is, flat work is met by the tool at a right angle.
    Spatial(SpatialModel),
}

/// The two links of the paper, and where they stand.
#[derive(Clone, Debug)]
pub struct PlanarModel {
    robot: Robot,
    pub(crate) arm: PlanarArm,
    /// The joint-2 axis from the base, forwards and up, m.
    pub(crate) axis_from_base: [f64; 2],
    pub(crate) sides: Vec<ElbowSide>,
}

/// Six axes with a tool.
#[derive(Clone, Debug)]
pub struct SpatialModel {
    robot: Robot,
    pub(crate) arm: SpatialArm,
}

/// The arm in one posture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ArmPosture {
    /// Shoulder and elbow angle in the arm plane, rad.
    Plane([f64; 2]),
    /// Joint angles as the robot reports them, rad.
    Joints([f64; 6]),
}

/// Which model of a robot is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModelKind {
    /// [`Model::Planar`].
    Planar,
    /// [`Model::Spatial`] with this tool frame in the flange frame; its z is the tool axis.
    Spatial(Pose),
}

/// A robot for which a model does not hold.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// The two links make no sense.
    #[error(transparent)]
    Arm(#[from] InvalidArm),
    /// The planar model does not hold.
    #[error(transparent)]
    NoArmPlane(#[from] NoArmPlane),
    /// The spatial model does not hold, or the tool makes no sense.
    #[error(transparent)]
    ArmPosture(#[from] PostureError),
}

impl ModelKind {
    /// The name that answers use.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Planar => "planar",
            Self::Spatial(_) => "spatial",
        }
    }

    /// Makes a robot ready.
    ///
    /// # Errors
    /// Where the model does not hold for it.
    pub fn of(&self, robot: &Robot) -> Result<Model, ModelError> {
        match self {
            Self::Planar => Model::planar(robot),
            Self::Spatial(flange_from_tool) => Model::spatial(robot, flange_from_tool),
        }
    }
}

impl Model {
    /// The planar model of a robot (\[paper\], section II).
    ///
    /// # Errors
    /// Where it has a compensator, an unusual coupling, or nothing that gives way in the plane, or makes no sense.
    pub fn planar(robot: &Robot) -> Result<Self, ModelError> {
        PlanarModel::of(robot).map(Self::Planar)
    }

    /// The planar model of two links of which nothing else is known; positions count from the joint-2 axis.
    ///
    /// # Errors
    /// Where they make no sense.
    pub fn of_links(arm: &PlanarArm) -> Result<Self, ModelError> {
        PlanarModel::of_links(arm).map(Self::Planar)
    }

    /// The spatial model of a robot with a tool frame given in the flange frame (\[theory\], section 1).
    ///
    /// # Errors
    /// Where only two links of the robot are known, its drive 2 does not hold the gravity compensator, or the tool makes no sense.
    pub fn spatial(robot: &Robot, flange_from_tool: &Pose) -> Result<Self, ModelError> {
        let arm = SpatialArm::new(robot, flange_from_tool)?;
        check_held(robot)?;
        Ok(Self::Spatial(SpatialModel { robot: robot.clone(), arm }))
    }

    /// Which robot.
    pub fn robot(&self) -> &Robot {
        match self {
            Self::Planar(model) => &model.robot,
            Self::Spatial(model) => &model.robot,
        }
    }

    /// Which model.
    pub fn kind(&self) -> ModelKind {
        match self {
            Self::Planar(_) => ModelKind::Planar,
            Self::Spatial(model) => ModelKind::Spatial(model.arm.flange_from_tool),
        }
    }

    /// Twice the force gives twice the deflection, everywhere: drives are springs that do not stiffen, and the posture is that
    /// of the unloaded arm.
    pub const fn is_linear_in_load(&self) -> bool {
        match self {
            Self::Planar(_) | Self::Spatial(_) => true,
        }
    }

    /// The arm in a posture, m from the base: in the plane its joint-2 axis, elbow and wrist centre; in space the base before them, and
    /// the flange after them. `None` for a posture of another model.
    pub fn points(&self, posture: &ArmPosture) -> Option<Vec<[f64; 3]>> {
        match (self, posture) {
            (Self::Planar(model), ArmPosture::Plane(angles)) => {
                Some(model.points(*angles).map(|[x, z]| [x, model.aside(), z]).to_vec())
            }
            (Self::Spatial(model), ArmPosture::Joints(q)) => Some(model.points(q).to_vec()),
            (Self::Planar(_), ArmPosture::Joints(_)) | (Self::Spatial(_), ArmPosture::Plane(_)) => None,
        }
    }

    /// The base is known, and with it the floor.
    pub fn knows_base(&self) -> bool {
        match self {
            Self::Planar(model) => model.knows_base(),
            Self::Spatial(_) => true,
        }
    }

    /// Compliance, m/N, at the stiffest posture of the links: no place of any work has less. `None` where the model knows no such
    /// bound.
    pub fn floor(&self) -> Option<f64> {
        match self {
            Self::Planar(model) => Some(model.arm.radial().floor()),
            Self::Spatial(_) => None,
        }
    }
}

impl PlanarModel {
    /// As [`Model::planar`].
    ///
    /// # Errors
    /// As [`Model::planar`].
    pub fn of(robot: &Robot) -> Result<Self, ModelError> {
        let ArmPlane { arm, axis_from_base } = robot.arm_plane()?;
        let sides = arm.sides()?;
        Ok(Self { robot: robot.clone(), arm, axis_from_base, sides })
    }

    /// As [`Model::of_links`].
    ///
    /// # Errors
    /// As [`Model::of_links`].
    pub fn of_links(arm: &PlanarArm) -> Result<Self, ModelError> {
        Self::of(&Robot::of_links(arm.clone()))
    }

    /// Which robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// The two links, in their own frame: the joint-2 axis is the origin.
    pub fn arm(&self) -> &PlanarArm {
        &self.arm
    }

    /// The joint-2 axis from the base, forwards and up, m; zero for a robot of which only the plane is known.
    pub fn axis_from_base(&self) -> [f64; 2] {
        self.axis_from_base
    }

    /// How far the arm plane stands to the left of the joint-1 axis, m.
    pub fn aside(&self) -> f64 {
        match &self.robot.arm {
            Arm::SixAxis { geometry, .. } => geometry.b,
            Arm::Planar(_) => 0.0,
        }
    }

    /// The joint-2 axis, the elbow and the wrist centre at a shoulder and an elbow angle, rad; forwards and up from the base, m.
    pub fn points(&self, [shoulder, elbow]: [f64; 2]) -> [[f64; 2]; 3] {
        let [ahead, up] = self.axis_from_base;
        self.arm.points(shoulder, elbow).map(|[x, z]| [x + ahead, z + up])
    }

    /// The base is known, and with it the floor.
    pub fn knows_base(&self) -> bool {
        self.robot.knows_base()
    }
}

impl SpatialModel {
    /// Which robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// The arm with its tool.
    pub fn arm(&self) -> &SpatialArm {
        &self.arm
    }

    /// Base, joint-2 axis, elbow, wrist centre and flange at joint angles as the robot reports them, rad; m from the base.
    pub fn points(&self, q: &[f64; 6]) -> [[f64; 3]; 5] {
        let theta = self.arm.geometry.model_angles(q, self.arm.limits.third_axis);
        self.arm.geometry.points(&theta)
    }

    /// Which way joint 1 counts: 1 counter-clockwise seen from above, else -1.
    pub fn joint_1_sign(&self) -> f64 {
        self.arm.geometry.sign[0]
    }

    /// The tool frame in the flange frame.
    pub fn flange_from_tool(&self) -> &Pose {
        &self.arm.flange_from_tool
    }
}
