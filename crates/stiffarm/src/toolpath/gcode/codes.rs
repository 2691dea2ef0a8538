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
    /// What was in force before a cycle goes on.
    Cancel,
    /// Writes offsets.
    Data,
    /// The words of a place are its own, and move nothing: limits of the machine, or names of axes.
    OwnWords,
    /// Look-ahead by P or Q; with a place to go to, a spline.
    LookAhead,
    /// Waits.
    Dwell,
    /// Moves nothing.
    Inert,
    /// Moves nothing where the block names no place; else this is why it is refused.
    InertAlone(&'static str),
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
        50 | 51 => Meaning::LookAhead,
        100 => Meaning::Data,
        170 => Meaning::Plane(Plane::Xy),
        180 => Meaning::Plane(Plane::Zx),
        190 => Meaning::Plane(Plane::Yz),
        220 | 501 => Meaning::OwnWords,
        200 | 700 => Meaning::Unit(LengthUnit::Inch),
        210 | 710 => Meaning::Unit(LengthUnit::Millimetre),
        280 | 300 => Meaning::Home,
        410 | 411 | 420 | 421 => Meaning::Compensation,
        434 | 2340 => Meaning::TipControl,
        435 => Meaning::Vectors(true),
        490 => Meaning::Vectors(false),
        520 => Meaning::Shift,
        530 => Meaning::Machine,
        540..=599 | 1540 => Meaning::System,
        730 | 740 | 810..=890 if code.is_multiple_of(10) => Meaning::Motion(Motion::Cycle(code)),
        800 => Meaning::Cancel,
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
        // What the machine keeps as its home; scale off, which on lathes names a place.
        281 | 301 => Meaning::InertAlone("where the machine's home is kept, words of a place make no sense"),
        500 => Meaning::InertAlone("a place is named by it on lathes only; expected the program of a mill"),
        // Feed override, exact stop, polar off, cutter compensation off, tool length, rotation and macros off, smoothing, limits off.
        80 | 81 | 90 | 131 | 150 | 230 | 400 | 401 | 430 | 440 | 610 | 611 | 620 | 630 | 640 | 670 | 690 | 961
        | 970 | 1030 | 1870 => Meaning::Inert,
        other => Meaning::Refused(refusal(other)),
    }
}

/// Why a G code is refused.
fn refusal(code: u16) -> &'static str {
    match code {
        52 | 53 | 61 | 62 => "splines are not modelled; let the CAM write lines and arcs",
        70 => "diameters are of lathes; expected the program of a mill",
        121 => "polar interpolation is not modelled; let the CAM write X Y",
        120 | 130 | 1500 => "pocket cycles differ between makers; let the CAM write the moves",
        160 => "polar coordinates are not modelled; let the CAM write X Y",
        290 => "where the way back from home leads is not in the file",
        330 | 331 => "threading moves with the spindle; it is no path of a robot",
        270 => "it is known to the machine only where it goes",
        310 | 380..=389 => "where a probe stops is not in the file",
        431 => "the tool length is shifted by what the file says; let the CAM write the tip",
        510 => "scaling is not modelled; let the CAM write true coordinates",
        511 => "mirroring is not modelled; let the CAM write true coordinates",
        650 | 660 => "macros are not run; let the CAM write the moves",
        680..=689 => "turned coordinates are not modelled; let the CAM write true coordinates",
        760 => "fine boring and threading share this code, and makers differ; let the CAM write the moves",
        960 => "the speed of a surface is kept on lathes; expected G97",
        2540 => "coordinates that follow a turned table are not modelled; let the CAM write true coordinates",
        _ => "it is not known whether this code moves the tool",
    }
}

/// What an M code, in tenths, does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Auxiliary {
    /// The program ends.
    End,
    /// Another program of the file is run.
    Call,
    /// That is over.
    Return,
    /// The spindle turns, clockwise or not; that moves nothing.
    Turns(bool),
    Inert,
    Refused(&'static str),
}

/// What an M code does.
pub(super) fn of_m(code: u16) -> Auxiliary {
    match code {
        20 | 300 => Auxiliary::End,
        30 | 130 => Auxiliary::Turns(true),
        40 | 140 => Auxiliary::Turns(false),
        980 => Auxiliary::Call,
        990 => Auxiliary::Return,
        470 => Auxiliary::Refused("it makes the program run without end; expected M2 or M30"),
        700..=739 => Auxiliary::Refused(
            "it restores what was in force, or mirrors the path, as the machine has it; let the CAM write true coordinates",
        ),
        960 | 970 | 1980 => {
            Auxiliary::Refused("a program that is not this file's is not called; let the CAM write one file")
        }
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
