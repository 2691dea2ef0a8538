//! What may be taken to spring?

use super::springs::Spring;

/// What is taken to spring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Springs {
    /// The six drives.
    #[default]
    Drives,
    /// These, and the base tilts.
    Base,
    /// The drives, and the tool bends.
    Tool,
    /// Drives, base and tool.
    All,
    /// The drives, and the spring of the gravity compensator, of which the robot file has the ends.
    Compensator,
    /// The same, and its preload.
    Preload,
    /// The drives, with a compliance of drive 2 for each of some ranges of joint 2.
    Regions,
    /// The simplest of these that none is clearly better than.
    Auto,
}

impl Springs {
    /// As it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Drives => "drives",
            Self::Base => "base",
            Self::Tool => "tool",
            Self::All => "base-and-tool",
            Self::Compensator => "compensator",
            Self::Preload => "compensator-and-preload",
            Self::Regions => "regions",
            Self::Auto => "auto",
        }
    }

    pub(super) fn springs(self, regions: usize) -> Vec<Spring> {
        let further: &[Spring] = match self {
            Self::Drives | Self::Auto | Self::Regions => &[],
            Self::Base => &[Spring::Base],
            Self::Tool => &[Spring::Tool],
            Self::All => &[Spring::Base, Spring::Tool],
            Self::Compensator => &[Spring::Compensator],
            Self::Preload => &[Spring::Compensator, Spring::Preload],
        };
        let in_regions = self == Self::Regions;
        let drives = Spring::DRIVES.into_iter().filter(|spring| !(in_regions && *spring == Spring::Drive(1)));
        let regions = (0..if in_regions { regions } else { 0 }).map(Spring::Region);
        drives.chain(regions).chain(further.iter().copied()).collect()
    }
}
