//! What a machine reads of a path that is milled: programs of controllers, and the path's own file with its tips led aside.

use std::io::Write;

use super::super::stiffness::stiffness;
use super::{Compensation, MillAnswer, MillAnswerError};
use stiffarm::calibration::ControllerModel;
use stiffarm::catalogue::robots;
use stiffarm::chain::TrueArm;
use stiffarm::limits::Pendant;
use stiffarm::mill::{Followed, PartPlacement, Stand, Station, approach};
use stiffarm::plain::on_one_line;
use stiffarm::program::{self, Language, Setup, Style};
use stiffarm::robot::{Arm, Robot};
use stiffarm::toolpath::{Original, Rewriting, Rewritten, Sample, Steps, ToolPose, rewrite};

/// Of moves through the air in programs, m/s.
const RAPID: f64 = 0.5;
/// How far from a place a program may round a corner, m: less than any tolerance of robots.
const BLEND: f64 = 5e-5;
/// How far above its beginning a path is approached, m: the first of these that is held.
const APPROACH: [f64; 3] = [0.05, 0.02, 0.005];
/// How far straight moves may be off the corrected samples, m.
const STRAIGHT: f64 = 1e-6;

impl MillAnswer {
    /// A controller's program that follows the path, compensated where that was asked for.
    ///
    /// # Errors
    /// Where there is nothing to follow, a joint is commanded beyond its range, or the language cannot say it.
    pub fn program(&self, language: Language) -> Result<String, MillAnswerError> {
        program_of(&[(None, self)], language)
    }

    /// The stations of this part of a program, from above its beginning, and what is to be known of it.
    fn stations(&self, tool: usize) -> Result<(Vec<program::Station>, String), MillAnswerError> {
        let (Some(found), Some(placement)) = (self.followed(), self.placement) else {
            return Err(MillAnswerError::NoProgram(self.reason().unwrap_or_default()));
        };
        self.check_contact()?;
        self.check_commanded()?;
        let joints = |i: usize| self.sent(i).map_or(found.samples[i].joints, |(joints, _)| joints);
        let station = |(i, station): (usize, &Station)| program::Station {
            line: station.sample.line,
            joints: joints(i),
            feed: station.sample.feed,
            is_cutting: station.sample.is_cutting,
            tool,
        };
        let mut stations: Vec<program::Station> = self.stations.iter().enumerate().map(station).collect();
        let approach = self.approach(found, placement)?;
        // A program has moves in joints where it is known how the pendant counts them.
        let is_known = self.robot.pendant().is_some_and(|pendant| *pendant != Pendant::Unknown);
        let in_joints = if is_known { ", in joints," } else { "" };
        let remark = match approach {
            Some((height, _)) => format!(
                "The first move{in_joints} goes to a place {:.0} mm above the path's beginning, along the tool axis; the way there is checked by nobody.",
                height * 1e3
            ),
            None => format!(
                "No approach: no place above the path's beginning is held and touches nothing, and the first move{in_joints} goes to the beginning itself."
            ),
        };
        if let Some((_, joints)) = approach {
            stations.insert(0, program::Station { joints, feed: None, is_cutting: false, ..stations[0] });
        }
        Ok((stations, remark))
    }

    /// That nothing is touched, or may be.
    fn check_contact(&self) -> Result<(), MillAnswerError> {
        self.forbidding_contact().map_or(Ok(()), |why| Err(MillAnswerError::NoProgram(why)))
    }

    /// From where the path is approached: how far above its beginning, m, and the joints there.
    fn approach(&self, found: &Followed, placement: PartPlacement) -> Result<Option<(f64, [f64; 6])>, MillAnswerError> {
        let stand = Stand { base_from_part: placement.base_from_part(), flange_from_tool: self.flange_from_tool };
        for height in APPROACH {
            let first = (&self.stations[0], &found.samples[0]);
            let joints =
                approach(&self.robot, &stand, first, &self.options, height).map_err(|error| MillAnswerError::Mill {
                    robot: self.robot.name.clone(),
                    path: on_one_line(&self.path).into_owned(),
                    error,
                })?;
            if let Some(joints) = joints {
                return self.truly(joints, &stand).map(|joints| Some((height, joints)));
            }
        }
        Ok(None)
    }

    /// The joints that put a calibrated arm where the drawing is at these, the part where it truly stands; the same ones of another arm.
    fn truly(&self, joints: [f64; 6], stand: &Stand) -> Result<[f64; 6], MillAnswerError> {
        let Some((arm, found)) = TrueArm::of(&self.robot).zip(self.on_true_arm()) else { return Ok(joints) };
        let Arm::SixAxis { geometry, limits, .. } = &self.robot.arm else { return Ok(joints) };
        let drawn = geometry.forward(&geometry.model_angles(&joints, limits.third_axis));
        let flange = found.base_from_part * stand.base_from_part.inverse() * drawn;
        let gone = "the calibrated arm has no posture above the path's beginning near that of the drawing";
        arm.joints_near(&flange, &joints).ok_or_else(|| MillAnswerError::NoProgram(gone.into()))
    }

    /// The joints and the tool in the part that a controller is sent at a station in place of those of the path: of a calibrated arm, or compensated.
    pub(super) fn sent(&self, i: usize) -> Option<([f64; 6], ToolPose)> {
        let corrects_itself = self.robot.calibration.as_ref().and_then(|known| known.controller);
        let which = usize::from(corrects_itself == Some(ControllerModel::Calibrated));
        let of_true_arm = self.on_true_arm().map(|found| (found.joints[i], found.poses[i][which]));
        of_true_arm
            .or_else(|| self.compensation.as_ref().map(|Compensation { done, .. }| (done.joints[i], done.poses[i])))
    }

    /// That no joint is sent beyond its range.
    fn check_commanded(&self) -> Result<(), MillAnswerError> {
        let of_true_arm = self.on_true_arm().map(|found| &found.beyond);
        let beyond = of_true_arm.or_else(|| self.compensation.as_ref().map(|Compensation { done, .. }| &done.beyond));
        match beyond.and_then(|beyond| beyond.first()) {
            None => Ok(()),
            Some(first) => {
                let line = self.stations[*first].sample.line;
                let why = format!(
                    "line {line}: the compensated path commands a joint beyond its range; another place or roll leaves room for it"
                );
                Err(MillAnswerError::NoProgram(why))
            }
        }
    }

    /// Writes the path's own file with its tips led aside; what was not touched stays as it is.
    ///
    /// # Errors
    /// Where nothing was compensated, or the file cannot say it.
    pub fn rewritten(
        &self,
        original: Original,
        steps: &Steps,
        output: &mut dyn Write,
    ) -> Result<Rewritten, MillAnswerError> {
        rewritten_of(&[(None, self)], original, steps, output)
    }

    /// That the tips of its file may be led aside.
    fn check_rewriting(&self) -> Result<(), MillAnswerError> {
        if self.compensation.is_none() {
            let stays = || "without --compensate the path stays as it is".into();
            return Err(MillAnswerError::NoProgram(self.reason().unwrap_or_else(stays)));
        }
        self.check_commanded()?;
        self.check_contact()
    }
}

/// The file of a path that several tools mill, one after the other, each with its number where there are several, with its tips led aside.
///
/// # Errors
/// As [`MillAnswer::rewritten`].
pub(super) fn rewritten_of(
    sections: &[(Option<u32>, &MillAnswer)],
    original: Original,
    steps: &Steps,
    output: &mut dyn Write,
) -> Result<Rewritten, MillAnswerError> {
    let Some((_, first)) = sections.first() else {
        return Err(MillAnswerError::NoProgram("nothing is milled".into()));
    };
    sections.iter().try_for_each(|(_, section)| section.check_rewriting())?;
    let arm = TrueArm::of(&first.robot);
    let controller = first.controller(arm.as_ref())?;
    let mut remarks: Vec<String> = controller.of_calibration().iter().map(|remark| (*remark).to_owned()).collect();
    remarks.push(format!("compensated by stiffarm for {}, {}", first.robot.name, stiffness(&first.robot)));
    remarks.push(controller.corrections().to_owned());
    remarks.extend(first.arm_remarks());
    for (number, section) in sections {
        let named = |remark: String| number.map_or_else(|| remark.clone(), |number| format!("T{number}: {remark}"));
        remarks.extend(section.contact_remark().map(named));
    }
    let how = Rewriting { steps: *steps, straight: STRAIGHT, remarks: &remarks };
    let mut milled =
        sections.iter().flat_map(|(_, section)| (0..section.stations.len()).map(move |i| (*section, i))).peekable();
    let mut corrected = |sample: &Sample| {
        // Where a tool that was just put in comes from is in the file, and milled by none.
        let is_this = |(section, i): &(&MillAnswer, usize)| {
            let known = &section.stations[*i].sample;
            (known.line, known.is_cutting, known.pose) == (sample.line, sample.is_cutting, sample.pose)
        };
        let sent = milled.next_if(is_this).and_then(|(section, i)| section.sent(i));
        // A file of three axes holds tips; what that leaves is reported.
        ToolPose { tip: sent.map_or(sample.pose.tip, |(_, pose)| pose.tip), axis: sample.pose.axis }
    };
    let rewritten = rewrite(original, output, &how, &mut corrected, &mut |_| Ok(()))?;
    match milled.next() {
        None => Ok(rewritten),
        Some((section, i)) => Err(MillAnswerError::NoProgram(format!(
            "line {}: what was milled is not found in the file",
            section.stations[i].sample.line
        ))),
    }
}

/// A controller's program of what several tools mill, one after the other, each with its number where there are several.
///
/// # Errors
/// As [`MillAnswer::program`].
pub(super) fn program_of(
    sections: &[(Option<u32>, &MillAnswer)],
    language: Language,
) -> Result<String, MillAnswerError> {
    let nothing = |why: Option<String>| MillAnswerError::NoProgram(why.unwrap_or_else(|| "nothing is milled".into()));
    let Some((_, first)) = sections.first() else { return Err(nothing(None)) };
    let (Some(placement), Arm::SixAxis { geometry, limits, .. }) = (first.placement, &first.robot.arm) else {
        return Err(nothing(first.reason().or_else(|| Some("the robot has no six joints".into()))));
    };
    let (mut stations, mut remarks, mut tools) = (Vec::new(), Vec::new(), Vec::<program::Tool>::new());
    for (number, section) in sections {
        // A tool that is put in again is the same one.
        let known = tools.iter().position(|tool| tool.number == *number);
        let tool = known.unwrap_or(tools.len());
        if known.is_none() {
            tools.push(program::Tool { number: *number, flange_from_tool: section.flange_from_tool });
        }
        let (found, remark) = section.stations(tool)?;
        stations.extend(found);
        remarks.push(number.map_or_else(|| remark.clone(), |number| format!("T{number}: {remark}")));
        remarks.extend(section.contact_remark());
        remarks.extend(section.overload_sentence().map(|sentence| format!("WARNING: {sentence}")));
        let only = section.only_tool.filter(|_| number.is_none());
        remarks.extend(only.map(|tool| format!("Only what tool {tool} of the path cuts.")));
    }
    let stiffness = stiffness(&first.robot);
    remarks.extend(foreign(language, &first.robot).map(|remark| format!("WARNING: {remark}.")));
    remarks.extend(first.arm_remarks());
    let arm = TrueArm::of(&first.robot);
    let controller = first.controller(arm.as_ref())?;
    let setup = Setup {
        robot: &first.robot.name,
        geometry,
        third_axis: limits.third_axis,
        pendant: &limits.pendant,
        controller,
        base_from_part: placement.base_from_part(),
        tools: &tools,
        remarks: &remarks,
        stiffness: first.compensation.as_ref().map(|_| stiffness.as_str()),
    };
    let style =
        Style { name: "STIFFARM".into(), rapid: RAPID, blend: BLEND, moves_per_file: None, fanuc_letters: None };
    let files = program::write(language, &setup, &stations, &style)?;
    Ok(files.into_iter().next().map_or_else(String::new, |file| file.text))
}

/// That a program is of other controllers than the robot's, where its maker is one of the catalogue's.
pub(crate) fn foreign(language: Language, robot: &Robot) -> Option<String> {
    let maker = language.maker().filter(|maker| !robot.vendor.eq_ignore_ascii_case(maker))?;
    robots().iter().find(|known| known.vendor == robot.vendor)?;
    Some(format!(
        "a .{} is read by controllers of {maker}, and the robot is one of {}",
        language.ending(),
        robot.vendor
    ))
}
