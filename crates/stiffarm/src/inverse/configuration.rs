//! Which branch of the inverse kinematics holds a pose, how it is called, and where it stands in arrays?

use crate::plane::Elbow;

/// Which way joint 1 faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shoulder {
    /// Towards the wrist centre.
    Front,
    /// Away from it, the arm bent over backwards.
    Back,
}

impl Shoulder {
    /// Both, in the order in which configurations count.
    pub const ALL: [Self; 2] = [Self::Front, Self::Back];

    /// The name that reports use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
        }
    }
}

/// Which way joint 5 bends; the flipped wrist turns joints 4 and 6 by half a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Wrist {
    /// `theta5 >= 0`.
    NoFlip,
    /// `theta5 < 0`.
    Flip,
}

impl Wrist {
    /// Both, in the order in which configurations count.
    pub const ALL: [Self; 2] = [Self::NoFlip, Self::Flip];

    /// The name that reports use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoFlip => "no flip",
            Self::Flip => "flip",
        }
    }
}

/// One of the eight ways to reach a pose: a branch of the inverse kinematics.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Configuration {
    /// Of joint 1.
    pub shoulder: Shoulder,
    /// Of joint 3.
    pub elbow: Elbow,
    /// Of joint 5.
    pub wrist: Wrist,
}

impl Configuration {
    /// How many there are.
    pub const COUNT: usize = 8;

    /// All of them, each at its [`index`](Self::index).
    pub const ALL: [Self; Self::COUNT] = {
        let mut all = [Self { shoulder: Shoulder::Front, elbow: Elbow::Up, wrist: Wrist::NoFlip }; Self::COUNT];
        let mut index = 0;
        while index < Self::COUNT {
            all[index] =
                Self { shoulder: Shoulder::ALL[index / 4], elbow: ELBOWS[index / 2 % 2], wrist: Wrist::ALL[index % 2] };
            index += 1;
        }
        all
    };

    /// Where it stands in arrays with one entry per configuration: shoulder counts first, then elbow, then wrist.
    #[inline]
    pub const fn index(self) -> usize {
        4 * self.shoulder as usize + 2 * matches!(self.elbow, Elbow::Down) as usize + self.wrist as usize
    }

    /// The configuration at an index below [`COUNT`](Self::COUNT); `None` beyond.
    pub const fn from_index(index: usize) -> Option<Self> {
        if index < Self::COUNT { Some(Self::ALL[index]) } else { None }
    }

    /// Its shoulder and elbow.
    pub(crate) const fn arm(self) -> ArmBranch {
        ArmBranch { shoulder: self.shoulder, elbow: self.elbow }
    }
}

/// Both elbow sides, in the order in which configurations count.
pub(crate) const ELBOWS: [Elbow; 2] = [Elbow::Up, Elbow::Down];

/// A shoulder and an elbow: the configurations that differ in the wrist alone put the wrist centre at one place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ArmBranch {
    pub(crate) shoulder: Shoulder,
    pub(crate) elbow: Elbow,
}

impl ArmBranch {
    /// All four, in the order in which configurations count.
    pub(crate) const ALL: [Self; 4] = [
        Configuration::ALL[0].arm(),
        Configuration::ALL[2].arm(),
        Configuration::ALL[4].arm(),
        Configuration::ALL[6].arm(),
    ];

    /// The configuration with this wrist.
    #[inline]
    pub(crate) const fn with(self, wrist: Wrist) -> Configuration {
        Configuration { shoulder: self.shoulder, elbow: self.elbow, wrist }
    }
}

impl std::fmt::Display for Configuration {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{}, elbow {}, {}", self.shoulder.name(), self.elbow.name(), self.wrist.name())
    }
}

/// No name of a posture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "posture '{0}' is not understood; expected front or back, elbow up or down, no-flip or flip, e.g. front,up,no-flip"
)]
pub struct UnknownConfiguration(pub String);

impl std::str::FromStr for Configuration {
    type Err = UnknownConfiguration;

    /// As it is written, or shorter: `front,up,no-flip`.
    fn from_str(text: &str) -> Result<Self, UnknownConfiguration> {
        let unknown = || UnknownConfiguration(text.into());
        let word = |part: &str| part.to_lowercase().replace([' ', '-'], "");
        let [shoulder, elbow, wrist]: [String; 3] =
            text.split(',').map(word).collect::<Vec<_>>().try_into().map_err(|_| unknown())?;
        Ok(Self {
            shoulder: match shoulder.as_str() {
                "front" => Shoulder::Front,
                "back" => Shoulder::Back,
                _ => return Err(unknown()),
            },
            elbow: match elbow.trim_start_matches("elbow") {
                "up" => Elbow::Up,
                "down" => Elbow::Down,
                _ => return Err(unknown()),
            },
            wrist: match wrist.as_str() {
                "noflip" => Wrist::NoFlip,
                "flip" => Wrist::Flip,
                _ => return Err(unknown()),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_configuration_stands_at_its_index() {
        for (index, configuration) in Configuration::ALL.into_iter().enumerate() {
            assert_eq!(configuration.index(), index);
            assert_eq!(Configuration::from_index(index), Some(configuration));
            assert_eq!(configuration.arm().with(configuration.wrist), configuration);
            assert_eq!(ArmBranch::ALL[index / 2], configuration.arm());
        }
        assert_eq!(Configuration::from_index(Configuration::COUNT), None);
        // Arrays of answers count shoulder, elbow, wrist.
        let last = Configuration { shoulder: Shoulder::Back, elbow: Elbow::Up, wrist: Wrist::Flip };
        assert_eq!(last.index(), 5);
    }

    #[test]
    fn a_posture_is_read_as_it_is_written() {
        for configuration in Configuration::ALL {
            assert_eq!(configuration.to_string().parse(), Ok(configuration));
        }
        let short: Configuration = "Back,down,no-flip".parse().unwrap();
        assert_eq!(short.to_string(), "back, elbow down, no flip");
        for wrong in ["", "front", "front,up", "front,up,flip,flip", "up,front,flip"] {
            assert!(wrong.parse::<Configuration>().unwrap_err().to_string().contains("front,up,no-flip"), "{wrong}");
        }
    }
}
