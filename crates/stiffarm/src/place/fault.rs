//! Why has a zone no place, and a question no answer?

use crate::clearance::{Clearance, Near};
use crate::load::NotInPlane;
use crate::model::ModelError;
use crate::robot::NoArmPlane;
use crate::watch::Stopped;

/// Why a zone has no place.
#[derive(Clone, Debug, PartialEq)]
pub enum Misfit {
    /// No orientation fits between the nearest and the farthest point the arm reaches.
    TooLarge {
        /// Those two, m, of the widest elbow side.
        ring: [f64; 2],
    },
    /// It fits the ring, but the joint limits leave no place for it with one elbow side.
    Limits,
    /// It fits the arm, but not where it may stand.
    Within,
    /// Wherever it may stand, something of it lies in what must be kept free.
    KeptFree,
    /// It fits, but no place keeps the margins.
    Margins,
    /// This face of a part has no place, even without the others.
    Face(String),
    /// The window is narrower than the zone.
    WindowTooNarrow,
    /// No single point with this direction of the tool.
    NothingReached,
    /// Points are reached, but nowhere the whole zone in one posture.
    NowhereWhole {
        /// The coarsest step of the search for one, m; zero at one place.
        step: f64,
    },
    /// There are places, but the arm keeps less from everything there than was asked.
    Clearance {
        /// m.
        asked: f64,
        /// What it keeps at the best place where none is asked for; `None` where no body of the arm is known.
        otherwise: Option<Clearance>,
    },
    /// Wherever the joints stand, the arm keeps less from a box than was asked.
    Blocked {
        /// What of it, and how far apart they are at most.
        near: Near,
    },
    /// The zone is reached, but a joint would have to turn by more than it can on the way through it.
    Turning,
}

impl std::fmt::Display for Misfit {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::TooLarge { ring: [near, far] } => write!(
                f,
                "does not fit the reachable set: too long for any orientation between the nearest ({near:.3} m) and the farthest ({far:.3} m) distance from the joint-2 axis"
            ),
            Self::Limits => f.write_str(
                "does not fit the reachable set: the joint limits leave no place for it without a change of posture",
            ),
            Self::Within => f.write_str("does not fit where it may stand: no allowed place is reachable as a whole"),
            Self::KeptFree => f.write_str(
                "does not fit where it may stand: at every place that was tried it would lie in what must be kept free (keep-out)",
            ),
            Self::Margins => f.write_str(
                "has a place only nearer to a joint limit, to a straight posture, to the robot's column or to the floor than the margins allow",
            ),
            Self::Face(name) => {
                // Faces that nobody named are counted: "face 1".
                let name = name.strip_prefix("face ").unwrap_or(name);
                write!(f, "its face {name} has no place, even without the others")
            }
            Self::WindowTooNarrow => f.write_str("the allowed place is narrower or lower than the zone"),
            Self::NothingReached => f.write_str("no point of the allowed place is reached with the tool held as it is asked for"),
            Self::NowhereWhole { step: 0.0 } => f.write_str("the whole zone is not reached there in one posture"),
            Self::NowhereWhole { step } => write!(
                f,
                "no place was found (places {:.0} mm apart, then refined) where the whole zone is reached in one posture",
                step * 1e3
            ),
            Self::Clearance { asked, otherwise } => {
                write!(f, "no place was found where the arm keeps {:.0} mm from everything", asked * 1e3)?;
                let Some(Clearance { distance, link, to, .. }) = otherwise else { return Ok(()) };
                // Without the sign of a zero.
                let kept = (distance * 1e3).round() + 0.0;
                if kept < 0.0 {
                    write!(f, "; at the best place otherwise {} and {to} overlap by {:.0} mm", link.name(), -kept)
                } else {
                    write!(f, "; at the best place otherwise {} to {to} keeps {kept:.0} mm", link.name())
                }
            }
            Self::Blocked { near: Near { distance, link, to } } => {
                let (link, mm) = (link.name(), distance * 1e3);
                if mm < 0.0 {
                    write!(f, "{link} and {to} overlap by {:.0} mm or more wherever the joints stand", -mm)
                } else {
                    write!(f, "{link} to {to} keeps {mm:.0} mm or less wherever the joints stand")
                }
            }
            Self::Turning => f.write_str(
                "the zone is reached, but not in one go: within it a joint passes a singular posture or the end of its range",
            ),
        }
    }
}

/// A question that has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlaceError {
    /// The model does not hold for the robot.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// What another model knows.
    #[error("{what} needs the {model} model")]
    Inapplicable {
        /// What was asked for.
        what: &'static str,
        /// The model that knows it.
        model: &'static str,
    },
    /// What a cell is not asked for yet.
    #[error(
        "a part with several faces; walls and ceilings, windows with y, keep-outs and a clearance that is asked for are known of one flat zone"
    )]
    PartInCell,
    /// A force along the axes of the base, and a cell in which the work may stand all around it.
    #[error(
        "a force fixed to the base points another way wherever the work stands about it; in a cell give it in axes of the tool"
    )]
    ForceInCell,
    /// A force of which the planar model knows nothing.
    #[error(transparent)]
    Load(#[from] NotInPlane),
    /// Gap outside `1e-9..=0.5`.
    #[error("a gap of {0}; expected 1e-9 to 0.5 (relative)")]
    Gap(f64),
    /// An angle that is not a sensible number.
    #[error("an angle of {0} rad; expected a number from -1000 to 1000")]
    Angle(f64),
    /// Faces that look all ways have no place in one plane.
    #[error("a part with several faces needs the spatial model")]
    PartInPlane,
    /// A part without faces.
    #[error("a part without faces; expected at least one")]
    NoFace,
    /// A margin that is not a sensible number.
    #[error("a {what} of {value}; expected 0 to {most}")]
    Margin {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The largest that makes sense.
        most: f64,
    },
    /// A floor that is not a sensible number.
    #[error("a floor at {0} m; expected -100 to 100 m from the base")]
    Floor(f64),
    /// A tool axis steeper than straight up or down.
    #[error("a tool axis {0} rad above the horizontal; expected -pi/2 (down) to pi/2 (up)")]
    Elevation(f64),
    /// A side of the zone that is not a sensible number.
    #[error("a zone with a side of {0} m; expected 1e-9 to 1000 m")]
    Side(f64),
    /// The search grew too large.
    #[error("the search stopped after {nodes} boxes: the best place lies between {:.4} and {:.4} mm; ask for a larger gap", lower * 1e3, upper * 1e3)]
    Unfinished {
        /// Boxes looked at.
        nodes: usize,
        /// Bound reached, m.
        lower: f64,
        /// Best value found, m (infinite where no place was found).
        upper: f64,
    },
    /// No longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

impl PlaceError {
    /// The question makes no sense, or asks for what is not known of any robot.
    pub fn is_of_the_question(&self) -> bool {
        !matches!(self, Self::Model(_) | Self::Unfinished { .. } | Self::Stopped(_))
    }

    /// The robot is sound, but the planar model does not hold for it: a compensator, an unusual coupling, or rigid drives 2
    /// and 3; or it does not hold for the work.
    pub fn is_not_of_the_plane(&self) -> bool {
        *self == Self::PartInPlane
            || matches!(self, Self::Model(ModelError::NoArmPlane(error)) if *error != NoArmPlane::Limits)
    }
}
