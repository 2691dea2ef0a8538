//! Which options are words, and what does each word mean?

use stiffarm::calibrate::Level;
use stiffarm::calibration::ControllerModel;
use stiffarm::chatter::{HeldBy, Method};
use stiffarm::drive::Architecture;
use stiffarm::identify::{Axes, Estimator, Springs};
use stiffarm::load::Component;
use stiffarm::measure::Criterion;
use stiffarm::mill::{ErrorPart, WorkFrame};
use stiffarm::plane::Elbow;
use stiffarm::robot::Status;
use stiffarm::toolpath::{ArcCentres, ArcSense, CutterCompensation, Format, IncrementalCycles, LengthUnit, Rotary};

use super::value::Words;

/// What the figure of a map in space shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// The worst deflection.
    Deflection,
    /// How far the nearest joint limit is.
    LimitMargin,
    /// How far the nearest singular posture is.
    SingularMargin,
    /// How slow the arm swings first.
    FirstFrequency,
}

/// What is mapped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Deflection,
    FirstFrequency,
}

/// Which model computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ModelName {
    Planar,
    Spatial,
}

/// Who says how stiff drives are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StiffnessOf {
    Paper,
    Prior,
    File,
}

/// Those along which a force of three numbers points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ForceAxes {
    Base,
    Tool,
}

/// Of the lengths in a file of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BodyUnit {
    Millimetre,
    Inch,
    Metre,
}

/// Tells what the words of a type mean, each with a line of help.
macro_rules! words {
    ($of:ty { $($meaning:expr, $word:literal, $help:literal;)* }) => {
        impl Words for $of {
            const WORDS: &'static [(&'static str, &'static str)] = &[$(($word, $help)),*];
            const MEANINGS: &'static [Self] = &[$($meaning),*];
        }
    };
}

words! { Architecture {
    Self::Serial, "serial", "";
    Self::QuasiSerial, "quasi-serial", "";
}}
words! { Status {
    Self::Identified, "identified", "";
    Self::DataSheet, "data-sheet", "";
    Self::Derived, "derived", "";
    Self::Estimated, "estimated", "";
}}
words! { ModelName {
    Self::Planar, "planar", "The paper's: drives 2 and 3, the wrist centre, zones in the arm plane";
    Self::Spatial, "spatial", "All six drives, the tool where it is, flat zones that the tool axis meets at a right angle";
}}
words! { StiffnessOf {
    Self::Paper, "paper", "1 urad/(N m) on every drive, as the paper assumes";
    Self::Prior, "prior", "As published of the robot, else as robots of its payload and reach have it; with its uncertainty";
    Self::File, "file", "As the robot file has it; robots whose file says nothing are refused";
}}
words! { ForceAxes {
    Self::Base, "base", "Those of the base: ahead, to the left, up";
    Self::Tool, "tool", "Those of the work: along the feed, across it (left of the feed, seen from the spindle), axial (away from the work)";
}}
words! { Component {
    Self::Total, "total", "All of the displacement";
    Self::Normal, "normal", "Its part along the tool axis, normal to the face";
    Self::Along, "along", "Its part along the force";
}}
words! { Elbow {
    Self::Up, "up", "";
    Self::Down, "down", "";
}}
words! { Quantity {
    Self::Deflection, "deflection", "The deflection";
    Self::FirstFrequency, "first-frequency", "Besides it how slow the arm swings first, which the figure shows; of robots with masses";
}}
words! { Layer {
    Self::Deflection, "deflection", "The worst deflection";
    Self::LimitMargin, "limit-margin", "How far the nearest joint limit is";
    Self::SingularMargin, "singular-margin", "How far the nearest singular posture is";
    Self::FirstFrequency, "first-frequency", "How slow the arm swings first, with --quantity first-frequency";
}}
words! { Method {
    Self::Mean, "mean", "The mean of the teeth over a revolution: zero order with the full receptance";
    Self::Teeth, "teeth", "Tooth by tooth: semi-discretisation";
}}
words! { HeldBy {
    Self::Rigid, "rigid", "On something rigid: spindle, holder and cutter alone; the model's robot comes on top";
    Self::Robot, "robot", "On the robot, at the posture of the cut: it takes the place of the model";
}}
words! { Axes {
    Self::Base, "base", "Those of the base";
    Self::Flange, "flange", "Those of the flange at the posture of the row";
}}
words! { Estimator {
    Self::LeastSquares, "least-squares", "Every row counts by its noise alone";
    Self::Huber, "huber", "Rows that fit badly count less";
}}
words! { Springs {
    Self::Drives, "drives", "The six drives";
    Self::Base, "base", "These, and the base tilts about the level axes through its origin";
    Self::Tool, "tool", "The drives, and the tool bends about the axes across the flange's";
    Self::All, "base-and-tool", "Drives, base and tool";
    Self::Compensator, "compensator", "The drives, and the spring of the gravity compensator whose ends the robot file has";
    Self::Preload, "compensator-and-preload", "The same, and its preload";
    Self::Regions, "regions", "The drives, drive 2 with a compliance for each of some ranges of joint 2 (--regions)";
    Self::Auto, "auto", "The simplest of these that none is clearly better than, by postures left out and Schwarz's criterion";
}}
words! { Criterion {
    Self::Prediction, "prediction", "How well the deflection over the work is predicted";
    Self::A, "a", "The mean variance of the compliances, each in parts of its own";
    Self::D, "d", "The volume of the ellipsoid of their errors";
}}
words! { Option<Level> {
    None, "auto", "The one with the largest evidence";
    Some(Level::Zeros), "zeros", "The zeros of the joints";
    Some(Level::Geometry), "geometry", "These, and how the joints' frames stand to each other";
    Some(Level::Weight), "weight", "These, and how the drives yield under the arm's own weight, on a floor";
    Some(Level::Gears), "gears", "These, and gears that err once per turn";
}}
words! { ControllerModel {
    Self::Nominal, "nominal", "With the arm that was drawn";
    Self::Calibrated, "calibrated", "With an absolute-accuracy option of its own";
}}
words! { ErrorPart {
    Self::Total, "total", "The whole displacement of the tip";
    Self::Across, "across", "Its part across the feed and the tool axis: the contour that the side of the tool leaves";
    Self::Axial, "axial", "Its part along the tool axis: depth";
    Self::Normal, "normal", "Its part along the outward normal of the surface, which a table tells as nx,ny,nz";
}}
words! { WorkFrame {
    Self::Touched, "touched", "By touching points of it with this robot: what the arm errs alike at all of them cancels";
    Self::Measured, "measured", "By an instrument in the frame of the base: all that the arm errs counts";
}}
words! { BodyUnit {
    Self::Millimetre, "mm", "";
    Self::Inch, "inch", "";
    Self::Metre, "m", "";
}}
words! { Format {
    Self::GCode, "gcode", "RS-274";
    Self::Apt, "apt", "APT or CLS";
    Self::Csv, "csv", "A table of points";
}}
words! { LengthUnit {
    Self::Millimetre, "mm", "";
    Self::Inch, "inch", "";
}}
words! { ArcCentres {
    Self::Incremental, "incremental", "I, J, K count from the beginning of the arc";
    Self::Absolute, "absolute", "They count from the origin";
}}
words! { ArcSense {
    Self::LeftHand, "left", "Clockwise about their axis, as Siemens NX writes them";
    Self::RightHand, "right", "Counter-clockwise, as SOLIDWORKS CAM does";
}}
words! { CutterCompensation {
    Self::Refuse, "refuse", "A path under G41 or G42 is refused";
    Self::Centre, "centre", "It is read as if it were that of the tool's centre";
}}
words! { IncrementalCycles {
    Self::Nist, "nist", "R from the present level, Z from R, read anew at every hole (RS274/NGC)";
    Self::FromR, "r-plane", "R from the level at which the cycle began, Z from R";
    Self::FromInitial, "initial", "R and Z from the level at which the cycle began";
}}
words! { Rotary {
    Self::HeadAc, "head-ac", "The spindle, by C about z and A about the turned x";
    Self::HeadBc, "head-bc", "The spindle, by C about z and B about the turned y";
    Self::TableAc, "table-ac", "The part, by A about x and on it C about z";
    Self::TableBc, "table-bc", "The part, by B about y and on it C about z";
}}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_the_name_of_what_it_means() {
        fn check<T: Words>(name: impl Fn(T) -> &'static str) {
            assert_eq!(T::WORDS.len(), T::MEANINGS.len());
            for (meaning, (word, _)) in T::MEANINGS.iter().zip(T::WORDS) {
                assert_eq!(name(*meaning), *word);
            }
        }
        check(Architecture::name);
        check(Status::name);
        check(|level: Option<Level>| level.map_or("auto", Level::name));
        check(ControllerModel::name);
        check(WorkFrame::name);
        check(Format::name);
    }
}
