//! Where does this very arm stand, and which joints put it somewhere? The chain of frames of an arm that was calibrated.
//!
//! `frames` has the product of the joints' frames with their errors and its derivatives, `arm` the flange of a calibrated robot, `inverse` the
//! joints of a pose by Newton's method from the closed form of the arm as drawn. Of a robot without `[calibration]` there is no
//! [`TrueArm`]: it stands as drawn, and is computed as drawn. `weighing` has how drives
//! yield under masses that are known. The own weight holds for a base that stands on a floor.

mod arm;
mod frames;
mod inverse;
mod weighing;

pub use arm::{TrueArm, is_upright};
pub(crate) use frames::{ALL, Chain, FRAMES, Frames};
pub use inverse::TruePostures;
pub(crate) use weighing::Weighing;
