//! `stiffarm compliance`: one posture, all six drives.

use crate::answer::compliance::doubts;
use crate::answer::compliance::vector;
use crate::answer::words::class;
use crate::answer::{ComplianceAnswer, Rows, Unit, stiffness};
use crate::request::Request;
use nalgebra::Vector3;
use serde_json::Value;
use stiffarm::compliance::compliance;
use stiffarm::palette::{DEFLECTION, FORCE, WORST_DIRECTION};
use stiffarm::robot::Robot;
use stiffarm::spatial::Pose;

use super::context::Context;
use crate::error::AskError;
use crate::figures::view3d::{ArmMark, Arrow, View};
use crate::forms::{Answer, Forms, Makes, Piece};

pub(crate) fn answer(asked: &Request, context: Context) -> Result<ComplianceOutput, AskError> {
    let robot = asked.equipped(super::selection::robot(&asked.robot()?, context)?)?;
    let q = asked.joints_deg()?;
    let tool = asked.tool_pose().tool();
    let load = asked.posture_load();
    let radians = q.map(f64::to_radians);
    let posture =
        compliance(&robot, &radians, &tool).map_err(|error| AskError::Posture { robot: robot.name.clone(), error })?;
    remarks(&robot, &q, context);
    let answer = ComplianceAnswer { robot, joints_deg: q, posture, load };
    Ok(ComplianceOutput { answer, tool })
}

/// Says beside the answer what looks wrong about the joint angles.
pub(crate) fn remarks(robot: &Robot, q: &[f64; 6], context: Context) {
    for doubt in doubts(robot, &[*q]) {
        context.listener.remark(&doubt);
    }
}

/// How long a force is drawn, m.
const FORCE_DRAWN: f64 = 0.4;

pub(crate) struct ComplianceOutput {
    answer: ComplianceAnswer,
    tool: Pose,
}

impl ComplianceOutput {
    /// The worst direction, and the deflection where a force is given, both as many times too long.
    fn arrows(&self) -> Vec<Arrow> {
        let posture = &self.answer.posture;
        let (worst, direction) = posture.compliance.worst();
        let at = posture.tool.translation.vector.into();
        // As long as 1 kN pushes it, or the force that was given.
        let worst = worst * 1e3 * direction;
        let moved = self.answer.deflection().map(|(moved, _)| moved);
        let times = magnified(worst.norm().max(moved.map_or(0.0, |moved| moved.norm())));
        let arrow = |what: &str, moved: Vector3<f64>, unit: &str, colour: &'static str| Arrow {
            colour,
            label: format!("{what}: {:.4} {unit}, drawn {times} times as long", Unit::Millimetre.of_si(moved.norm())),
            at,
            along: (times * moved).into(),
        };
        let worst = Some(worst).map(|moved| arrow("worst direction", moved, "mm per kN", WORST_DIRECTION));
        let moved = moved.map(|moved| arrow("deflection", moved, "mm under the force", DEFLECTION));
        // The force ends at the tool point, which it pushes.
        let force = self.answer.force().filter(|force| 0.0 < force.norm()).map(|force| {
            let along = FORCE_DRAWN * force.normalize();
            let at = (Vector3::from(at) - along).into();
            Arrow { label: format!("force of {:.0} N", force.norm()), at, along: along.into(), colour: FORCE }
        });
        worst.into_iter().chain(moved).chain(force).filter(|arrow| arrow.along != [0.0; 3]).collect()
    }
}

/// How many times too long a deflection, m, is drawn: 1, 2 or 5 times a power of ten, so that half a metre is not passed.
fn magnified(deflection: f64) -> f64 {
    let most = 0.5 / deflection;
    if !most.is_finite() {
        return 1.0;
    }
    let ten = 10_f64.powf(most.log10().floor());
    [5.0, 2.0, 1.0].map(|step| step * ten).into_iter().find(|&times| times <= most).unwrap_or(ten)
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "compliance", makes: &[Makes::View] };

impl Answer for ComplianceOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(self.answer.table()), Piece::Break, Piece::Lines(self.answer.notes())]
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn view(&self) -> Option<Result<View, AskError>> {
        let ComplianceAnswer { robot, joints_deg: q, posture, .. } = &self.answer;
        let (worst, direction) = posture.compliance.worst();
        let shares = posture.shares(&direction);
        let angles = q.map(|angle| angle.to_string()).join(", ");
        Some(Ok(View {
            title: robot.full_name(),
            notes: vec![
                format!("{}; joints as reported: {angles} deg", class(robot)),
                stiffness(robot),
                format!("worst direction: {:.4} um/N along {}", worst * 1e6, vector(&direction, 3)),
                "all six drives compliant, everything else rigid".into(),
            ],
            arm: ArmMark::posed(robot, &q.map(f64::to_radians), &self.tool, Some(&shares)),
            arrows: self.arrows(),
            floor: true,
            ..View::default()
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_are_as_long_as_a_picture_can_bear() {
        for (deflection, times) in [(0.5, 1.0), (0.004_47, 100.0), (0.002_5, 200.0), (0.000_9, 500.0), (3.0, 0.1)] {
            assert!((magnified(deflection) / times - 1.0).abs() < 1e-12, "{deflection}: {}", magnified(deflection));
        }
        assert_eq!(magnified(0.0), 1.0);
    }
}
