//! Why a path is not milled.

use crate::chatter::ChatterError;
use crate::compliance::PostureError;
use crate::toolpath::of_line;
use crate::watch::Stopped;

/// A question that makes no sense.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MillError {
    /// Six joints are needed, a tool that an arm carries, a compensator that drive 2 holds.
    #[error(transparent)]
    Posture(#[from] PostureError),
    /// Not wanted any more.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The tool axis lies along the part's x axis, from which the roll counts.
    #[error(
        "line {line}: the tool axis lies along the part's x axis, from which the roll counts; expected a path turned in its frame"
    )]
    Roll {
        /// Of the file.
        line: usize,
    },
    /// Margins that leave nothing of a joint's range.
    #[error("margins of {:.1} deg leave nothing of the range of some joint", limit.to_degrees())]
    Margins {
        /// rad.
        limit: f64,
    },
    /// Which way the tool gives is not known.
    #[error("a force that may point anywhere cannot be compensated; expected FEED,ACROSS,AXIAL in N, or a process")]
    AnyDirection,
    /// The loaded posture was not found.
    #[error(
        "{}the loaded posture does not settle, the joints still turn by {change:.1e} rad a round; the force is too large for these drives",
        of_line(*line)
    )]
    Unsettled {
        /// Of the file.
        line: usize,
        /// rad.
        change: f64,
    },
    /// A calibrated arm that does not have the posture of the drawing.
    #[error("{}the calibrated arm has no posture near that of the arm as drawn; expected a path farther from straight postures and the rim", of_line(*line))]
    Vanished {
        /// Of the file.
        line: usize,
    },
    /// Nothing of the path feeds.
    #[error("nothing of the path feeds: there is nothing to mill")]
    NothingFeeds,
    /// What counts is not said.
    #[error(
        "{}no outward normal of the surface is given there; expected a table (CSV) with the columns nx,ny,nz for errors along the normal",
        of_line(*line)
    )]
    NoNormal {
        /// Of the file.
        line: usize,
    },
    /// A pin where there is no path.
    #[error("a roll pinned {:.3} mm along a path of {:.3} mm; expected a place on the path", way * 1e3, length * 1e3)]
    PinnedBeyond {
        /// m.
        way: f64,
        /// m.
        length: f64,
    },
    /// Two pins of one sample.
    #[error("two rolls pinned to the sample that is nearest to {:.3} mm along the path; expected one", way * 1e3)]
    PinnedTwice {
        /// m.
        way: f64,
    },
    /// Pins leave nothing to a roll that is given otherwise, and nothing is proved of all places with them.
    #[error("pinned rolls go with free rolls and a part that stands somewhere")]
    PinnedElse,
    /// Whether its cuts swing cannot be computed.
    #[error("{}{error}", of_line(*line))]
    Chatter {
        /// Of the file; 0 where it is no matter of the path.
        line: usize,
        /// Why.
        error: ChatterError,
    },
    /// A number out of its range.
    #[error("{what} of {value}; expected {expected}")]
    Value {
        /// Which.
        what: &'static str,
        /// As it was given.
        value: f64,
        /// What was expected.
        expected: &'static str,
    },
}

/// Where and why a robot cannot follow a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocked {
    /// The line of the file at which it ends.
    pub line: usize,
    /// From the beginning of the path, m.
    pub way: f64,
    /// Where the tip would be, m from the base.
    pub tip: [f64; 3],
    /// Why.
    pub why: Why,
    /// How many samples no posture holds at any roll; 0 where each is held at some, but none along the path.
    pub samples: usize,
}

/// What is in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Why {
    /// Out of reach at every roll, by so much at the best, m.
    Reach {
        /// m.
        beyond: f64,
    },
    /// At every roll that is reached, limits with their margins forbid the posture; most often that of this joint, from 1.
    Limit {
        /// From 1.
        joint: usize,
    },
    /// At every roll that is reached within limits, wrist or arm are nearer to straight than the margin, or the limits of several joints
    /// forbid the posture.
    Narrow,
    /// From the sample before no posture leads on: joints would have to jump, or to turn beyond their ranges.
    Jump,
    /// The same for the speeds of the joints at this feed rate.
    Fast,
    /// Not at the roll that is pinned here.
    Pinned,
}

impl std::fmt::Display for Blocked {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let [x, y, z] = self.tip;
        if 0 < self.line {
            write!(f, "line {}, ", self.line)?;
        }
        write!(f, "{:.1} mm along the path, tip at {x:.3}, {y:.3}, {z:.3} m: ", self.way * 1e3)?;
        match self.why {
            Why::Reach { beyond } => {
                write!(f, "out of reach by {:.1} mm at every roll that may be taken", beyond * 1e3)?;
            }
            Why::Limit { joint } => {
                write!(f, "the range of joint {joint} with its margin forbids it at every roll that may be taken")?;
            }
            Why::Narrow => {
                f.write_str(
                    "limits and the distance from straight postures together forbid it at every roll that may be taken",
                )?;
            }
            Why::Jump => f.write_str("no posture leads on from the sample before without a jump of some joint")?,
            Why::Fast => {
                f.write_str("no posture leads on from the sample before at this feed rate: some joint is too slow")?;
            }
            Why::Pinned => f.write_str("no posture holds the roll that is pinned here; others would be held")?,
        }
        match self.samples {
            0 => Ok(()),
            count => write!(f, "; {count} samples are held at no roll"),
        }
    }
}
