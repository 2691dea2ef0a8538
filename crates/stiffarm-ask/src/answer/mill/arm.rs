//! How the geometry of the very arm enters a path: as it was calibrated, or as large as it is of arms that nobody has calibrated.

use stiffarm::calibration::{Calibration, ControllerModel};
use stiffarm::chain::{TrueArm, is_upright};
use stiffarm::mass::ToolWeight;
use stiffarm::mill::{
    ArmErrors, DrawnError, MillError, OnTrueArm, PathGround, Pushed, RollMode, Stand, Station, TrueOptions, WorkFrame,
    arm_error, on_true_arm,
};
use stiffarm::program::Controller;
use stiffarm::robot::Robot;
use stiffarm::watch::Watch;

use super::super::{Line, Record, field, fixed, line, shape};
use super::{MillAnswer, MillAnswerError};
use crate::request::{Refusal, Request, opt};

/// How the arm's own geometry counts.
#[derive(Clone, Debug, PartialEq)]
pub enum ArmGeometry {
    /// It was calibrated: what is commanded, and what errs.
    Calibrated(Box<OnTrueArm>),
    /// It was not: so far such arms err along this path.
    Drawn(DrawnError),
}

/// Why a tolerance that the deflection keeps is not kept, or may not be.
pub(in crate::answer) struct Exceeded {
    /// In words.
    pub(in crate::answer) sentence: String,
    /// In more than half of such arms, rather than in some.
    pub(in crate::answer) is_likely: bool,
}

/// The 95 % distance of three normal coordinates over its root mean square: the root of a third of that of chi squared with 3 degrees of freedom.
const P95_OF_RMS: f64 = 1.614;

/// That the base stands as the calibration has it.
///
/// # Errors
/// A base that does not stand on a floor where the own weight has terms.
pub(super) fn check_mount(asked: &Request, robot: &Robot) -> Result<(), Refusal> {
    let Some(mount) = asked.mount() else { return Ok(()) };
    let holds = TrueArm::of(robot).is_none_or(|arm| arm.stands_as_measured(&mount.cell_from_base));
    if holds {
        return Ok(());
    }
    let why = format!(
        "has a base that does not stand upright, and the own weight in the calibration of {} (weight_mrad, weight_urad_per_nm) holds on a floor; expected floor, pedestal:H, or a calibration without it (--level geometry)",
        robot.name
    );
    Err(asked.refused(opt::MOUNT, why))
}

/// The tool whose weight is taken out: of an arm that was calibrated, on a base that stands upright, where its centre is known.
pub(super) fn held(robot: &Robot, tool: Option<ToolWeight>, ground: &PathGround) -> Option<ToolWeight> {
    let is_upright = ground.cell.as_ref().is_none_or(|cell| is_upright(&cell.mount.cell_from_base));
    tool.filter(|tool| robot.calibration.is_some() && is_upright && tool.centre.is_some())
}

/// What the arm's geometry does along a path.
pub(super) fn looked_at(
    robot: &Robot,
    stand: &Stand,
    path: (&[Station], &[Pushed]),
    options: TrueOptions,
    watch: Watch,
) -> Result<ArmGeometry, MillError> {
    if let Some(found) = on_true_arm(robot, stand, path, &options, watch)? {
        return Ok(ArmGeometry::Calibrated(Box::new(found)));
    }
    arm_error(robot, stand, path, (options.work_frame, options.part), watch).map(ArmGeometry::Drawn)
}

impl MillAnswer {
    /// The path on the arm that was calibrated, where it was.
    pub fn on_true_arm(&self) -> Option<&OnTrueArm> {
        match &self.arm {
            Some(ArmGeometry::Calibrated(found)) => Some(found),
            Some(ArmGeometry::Drawn(_)) | None => None,
        }
    }

    /// With which arm the controller computes.
    ///
    /// # Errors
    /// A calibrated robot of which nobody has said it.
    pub(super) fn controller<'a>(&self, arm: Option<&'a TrueArm>) -> Result<Controller<'a>, MillAnswerError> {
        let (Some(calibration), Some(arm)) = (&self.robot.calibration, arm) else { return Ok(Controller::Drawn) };
        match calibration.controller {
            Some(ControllerModel::Nominal) => Ok(Controller::Mirrored),
            Some(ControllerModel::Calibrated) => Ok(Controller::Calibrated(arm)),
            None => Err(MillAnswerError::NoProgram(format!(
                "the [calibration] of {} does not say controller_model; expected \"nominal\" (the controller computes with the arm as drawn) or \"calibrated\" (with an absolute-accuracy option of its own, as while it was measured): the wrong one corrects twice, or not at all",
                self.robot.name
            ))),
        }
    }

    /// Both kinds of error as fields.
    pub(super) fn put_arm(&self, record: &mut Record) {
        let calibrated = self.on_true_arm().map(|found| {
            let ArmErrors { uncorrected, by_stiffness, by_geometry, by_both } = found.errors;
            let mut record = Record::of(&shape::TRUE_ARM);
            record
                .put(field::UNCORRECTED, uncorrected)
                .put(field::BY_STIFFNESS, by_stiffness)
                .put(field::BY_GEOMETRY, by_geometry)
                .put(field::BY_BOTH, by_both)
                .put(field::CALIBRATION_LEFT, self.robot.calibration.as_ref().map(|known| known.left_out))
                .put(field::BEYOND_LIMITS, found.beyond.len());
            record
        });
        let drawn = self.drawn_error().map(|found| {
            let mut record = Record::of(&shape::ARM_ERROR);
            record.put(field::MEDIAN_OFF, found.median).put(field::P95_OFF, found.p95);
            record
        });
        record
            .put(field::WORK_FRAME, self.arm.as_ref().map(|_| self.work_frame.name()))
            .put(field::TRUE_ARM, calibrated)
            .put(field::ARM_ERROR, drawn);
    }

    fn drawn_error(&self) -> Option<DrawnError> {
        match self.arm {
            Some(ArmGeometry::Drawn(found)) => Some(found),
            Some(ArmGeometry::Calibrated(_)) | None => None,
        }
    }

    /// The same as people read it.
    pub(super) fn arm_lines(&self) -> Vec<Line> {
        let mm = |metres: f64| format!("{} mm", fixed(metres * 1e3, 4));
        let some = |metres: Option<f64>| metres.map_or_else(|| "not known under such a force".into(), mm);
        let mut lines = Vec::new();
        if let (Some(found), Some(known)) = (self.on_true_arm(), &self.robot.calibration) {
            let ArmErrors { uncorrected, by_stiffness, by_geometry, by_both } = found.errors;
            lines.push(line("calibrated arm, nothing corrected", mm(uncorrected)));
            lines.push(line("deflection alone corrected", some(by_stiffness)));
            lines.push(line("geometry alone corrected", mm(by_geometry)));
            lines.push(line("both corrected, by the model", some(by_both)));
            lines.push(line(
                "the calibration itself leaves",
                format!("{} rms where it was not measured", mm(known.left_out)),
            ));
            lines.push(line("weight of the tool", self.held_in_words()));
            lines.extend(beyond(found).map(|sentence| line("BEYOND LIMITS", sentence)));
        }
        lines.extend(self.drawn_error().map(|DrawnError { median, p95 }| {
            let text = format!(
                "{} (median), {} (95 %) by the geometry of arms that nobody has calibrated, the work found as {}: not in the error",
                mm(median),
                mm(p95),
                self.work_frame.name()
            );
            line("besides", text)
        }));
        lines
    }

    /// A calibrated arm bends further under its tool, and the weight of that is not counted.
    pub(super) fn lacks_weight(&self) -> bool {
        self.on_true_arm().is_some() && held(&self.robot, self.options.tool_weight, &self.ground).is_none()
    }

    /// Whether the weight of the tool bends the calibrated arm here.
    fn held_in_words(&self) -> String {
        match self.options.tool_weight {
            Some(weight) if !self.lacks_weight() => {
                format!("{} kg bend the drives beside what the arm was calibrated with: counted", weight.mass)
            }
            Some(weight) if weight.centre.is_some() => "NOT COUNTED: the base does not stand upright".into(),
            Some(_) => "NOT COUNTED: its centre is not given (--tool-com-mm)".into(),
            None => "NOT COUNTED: not given (--tool-mass-kg, --tool-com-mm); it bends the drives beside what the arm was calibrated with".into(),
        }
    }

    /// What a verdict is without: the geometry of an arm that was not calibrated, with its size here.
    pub(super) fn arm_note(&self) -> String {
        let worst = self.followed().map_or(f64::INFINITY, |found| found.worst.0);
        let drawn = |found: DrawnError| {
            // The rolls are those of the least deflection, whatever the wrist turns for it.
            let is_of_turning = self.options.roll == RollMode::Free && worst < found.median;
            let turning =
                if is_of_turning { "; with --roll constant the wrist turns less, and it may be less" } else { "" };
            let [median, p95] = [found.median, found.p95].map(|metres| fixed(metres * 1e3, 2));
            format!(
                "Along this path the geometry of a {} that was not calibrated errs by {median} mm (median), {p95} mm (95 %) on top; `stiffarm calibrate` finds it{turning}.\n",
                self.robot.name
            )
        };
        self.drawn_error().map_or_else(String::new, drawn)
    }

    /// The geometry errs, or may err, by so much that a tolerance, mm, is not kept, although a deflection, m, of a program that is compensated or not
    /// keeps it, nominal and with 95 %: that verdict is of the deflection alone.
    pub(in crate::answer) fn geometry_exceeds(
        &self,
        tolerance_mm: f64,
        deflection: (f64, Option<f64>),
        is_compensated: bool,
    ) -> Option<Exceeded> {
        let left = self.geometry_left(tolerance_mm, deflection);
        if is_compensated || left.as_ref().is_some_and(|left| left.is_likely) {
            return left;
        }
        self.geometry_uncorrected(tolerance_mm).or(left)
    }

    /// The same of what nobody corrects: that of an arm that was not calibrated, or what its calibration leaves.
    fn geometry_left(&self, tolerance_mm: f64, (deflection, p95): (f64, Option<f64>)) -> Option<Exceeded> {
        let (besides, most, what, helps) = match (&self.robot.calibration, self.drawn_error()) {
            (Some(known), _) => (
                known.left_out,
                known.left_out * P95_OF_RMS,
                "The calibration of this arm leaves {} mm (rms, where it was not measured) besides",
                "more points, nearer to the work, leave less.",
            ),
            (None, Some(found)) => (
                found.median,
                found.p95,
                "The geometry of this arm, which was not calibrated, errs by {} mm (median) besides",
                "`stiffarm calibrate` finds it.",
            ),
            (None, None) => return None,
        };
        // What errs by itself adds up as squares do.
        let together = p95.map_or(0.0, |p95| p95.hypot(most)).max(most + deflection);
        let (more, is_likely) = match tolerance_mm / 1e3 {
            tolerance if tolerance < besides => ("more than the tolerance".into(), true),
            tolerance if tolerance < besides + deflection => {
                ("with the deflection more than the tolerance".into(), true)
            }
            tolerance if tolerance < together => {
                let most = fixed(most * 1e3, 2);
                (format!("{most} mm (95 %), which with the deflection may be more than the tolerance"), false)
            }
            _ => return None,
        };
        Some(Exceeded {
            sentence: format!("{}, {more}: {helps}", what.replace("{}", &fixed(besides * 1e3, 2))),
            is_likely,
        })
    }

    /// The same of a program that does not know the calibrated arm; one that is compensated is written for it.
    fn geometry_uncorrected(&self, tolerance_mm: f64) -> Option<Exceeded> {
        let ArmErrors { uncorrected, by_geometry, .. } = self.on_true_arm()?.errors;
        let tolerance = tolerance_mm / 1e3;
        (by_geometry <= tolerance && tolerance < uncorrected).then(|| {
            let sentence = format!(
                "A program that does not correct the geometry of this arm errs by {} mm, more than the tolerance: a program written by `stiffarm mill` (such as -o program.src) corrects it.",
                fixed(uncorrected * 1e3, 2)
            );
            Exceeded { sentence, is_likely: true }
        })
    }

    /// What of it stands in the head of a program.
    pub(super) fn arm_remarks(&self) -> Vec<String> {
        let (Some(found), Some(known)) = (self.on_true_arm(), &self.robot.calibration) else { return Vec::new() };
        let Calibration { rows, date, source, left_out, .. } = &**known;
        let mut remarks = vec![format!(
            "Calibration: {date}, {rows} rows of {source}; it leaves {} mm rms where it was not measured.",
            fixed(left_out * 1e3, 3)
        )];
        if known.controller == Some(ControllerModel::Calibrated) {
            return remarks;
        }
        remarks.push(match self.work_frame {
            WorkFrame::Measured => "Work frame: measured by an instrument in the frame of the base.".into(),
            WorkFrame::Touched => {
                let at = |at: &[f64; 3]| at.map(|x| fixed(x * 1e3, 1)).join(" ");
                let points: Vec<String> = found.touched.iter().map(at).collect();
                format!(
                    "Work frame: touched with this robot at the part's points {} mm, the tool turned as it mills there; touched elsewhere, another part of the arm's error cancels.",
                    points.join("; ")
                )
            }
        });
        remarks
    }
}

/// Samples at which the true arm is commanded beyond its limits, in words.
fn beyond(found: &OnTrueArm) -> Option<String> {
    (!found.beyond.is_empty()).then(|| {
        format!(
            "{} samples command a joint of the calibrated arm beyond its range: no program is written",
            found.beyond.len()
        )
    })
}
