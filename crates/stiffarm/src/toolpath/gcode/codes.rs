//! What does each G and M code do to a path?

use super::super::options::{ArcCentres, LengthUnit};
use super::arcs::Plane;

/// How the tool moves from here on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    /// No axis word makes sense.
    None,
    Rapid,
    Line,
    Clockwise,
    CounterClockwise,
    /// A drilling cycle, by its code in tenths.
    Cycle(u16),
}

/// What F says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FeedMode {
    PerMinute,
    /// F moves a minute.
    Inverse,
    PerTurn,
}

/// What a code does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    Motion(Motion),
    Plane(Plane),
    Unit(LengthUnit),
    /// G91.
    Incremental(bool),
    Centres(ArcCentres),
    Feed(FeedMode),
    /// Cycles end at R, not at the level at which they began.
    RetractToR(bool),
    /// A work offset.
    System,
    /// Coordinates of the machine, this block.
    Machine,
    /// To the machine's home.
    Home,
    /// The axis words name this place.
    SetPosition,
    /// What `SetPosition` did is undone, `true` for good.
    ClearPosition(bool),
    RestorePosition,
    /// The axis words shift the origin.
    Shift,
    /// The path is not the centre's.
    Compensation,
    /// I, J and K are the tool axis.
    Vectors(bool),
    /// X, Y and Z are the tip whatever A, B and C are.
    TipControl,
    /// Writes offsets.
    Data,
    /// Waits: P or X is a time.
    Dwell,
    /// Moves nothing.
    Inert,
    Refused(&'static str),
}

/// What a G code, in tenths, does.
pub(super) fn of_g(code: u16) -> Meaning {
    match code {
        0 => Meaning::Motion(Motion::Rapid),
        10 => Meaning::Motion(Motion::Line),
        20 => Meaning::Motion(Motion::Clockwise),
        30 => Meaning::Motion(Motion::CounterClockwise),
        40 => Meaning::Dwell,
        100 => Meaning::Data,
        170 => Meaning::Plane(Plane::Xy),
        180 => Meaning::Plane(Plane::Zx),
        190 => Meaning::Plane(Plane::Yz),
        200 | 700 => Meaning::Unit(LengthUnit::Inch),
        210 | 710 => Meaning::Unit(LengthUnit::Millimetre),
        280 | 300 => Meaning::Home,
        410 | 411 | 420 | 421 => Meaning::Compensation,
        434 => Meaning::TipControl,
        435 => Meaning::Vectors(true),
        490 => Meaning::Vectors(false),
        520 => Meaning::Shift,
        530 => Meaning::Machine,
        540..=599 => Meaning::System,
        730 | 740 | 810..=890 if code.is_multiple_of(10) => Meaning::Motion(Motion::Cycle(code)),
        800 => Meaning::Motion(Motion::None),
        900 => Meaning::Incremental(false),
        910 => Meaning::Incremental(true),
        901 => Meaning::Centres(ArcCentres::Absolute),
        911 => Meaning::Centres(ArcCentres::Incremental),
        920 => Meaning::SetPosition,
        921 => Meaning::ClearPosition(true),
        922 => Meaning::ClearPosition(false),
        923 => Meaning::RestorePosition,
        930 => Meaning::Feed(FeedMode::Inverse),
        940 => Meaning::Feed(FeedMode::PerMinute),
        950 => Meaning::Feed(FeedMode::PerTurn),
        980 => Meaning::RetractToR(false),
        990 => Meaning::RetractToR(true),
        // Feed override, exact stop, cutter compensation off, tool length, mirror, scale, rotation and polar off, look-ahead.
        51 | 80 | 81 | 90 | 150 | 400 | 430 | 440 | 500 | 501 | 610 | 611 | 620 | 630 | 640 | 670 | 690 | 961 | 970 => {
            Meaning::Inert
        }
        other => Meaning::Refused(refusal(other)),
    }
}

/// Why a G code is refused.
fn refusal(code: u16) -> &'static str {
    match code {
        50 | 52 | 61 | 62 => "splines are not modelled; let the CAM write lines and arcs",
        70 => "diameters are of lathes; expected the program of a mill",
        120 | 130 | 121 | 131 => "pocket cycles differ between makers; let the CAM write the moves",
        160 => "polar coordinates are not modelled; let the CAM write X Y",
        290 => "where the way back from home leads is not in the file",
        330 | 331 => "threading moves with the spindle; it is no path of a robot",
        380..=389 => "where a probe stops is not in the file",
        431 => "the tool length is shifted by what the file says; let the CAM write the tip",
        510 => "scaling is not modelled; let the CAM write true coordinates",
        511 => "mirroring is not modelled; let the CAM write true coordinates",
        650 | 660 => "macros are not run; let the CAM write the moves",
        680..=689 => "turned coordinates are not modelled; let the CAM write true coordinates",
        760 => "fine boring and threading share this code, and makers differ; let the CAM write the moves",
        _ => "it is not known whether this code moves the tool",
    }
}

/// What an M code, in tenths, does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Auxiliary {
    /// The program ends.
    End,
    Inert,
    Refused(&'static str),
}

/// What an M code does.
pub(super) fn of_m(code: u16) -> Auxiliary {
    match code {
        20 | 300 => Auxiliary::End,
        960..=980 => Auxiliary::Refused("other programs are not called; let the CAM write one file"),
        990 => Auxiliary::Refused("a jump back makes the program run without end; expected M2 or M30"),
        _ => Auxiliary::Inert,
    }
}

/// `G43.4` from tenths.
pub(super) fn named(letter: char, code: u16) -> String {
    if code.is_multiple_of(10) {
        format!("{letter}{}", code / 10)
    } else {
        format!("{letter}{}.{}", code / 10, code % 10)
    }
}
