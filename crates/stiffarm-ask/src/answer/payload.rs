//! What must the robot hold, against what its maker lets it carry?

use super::words::fixed;
use super::{Line, Record, field, line};
use nalgebra::Vector3;
use stiffarm::drive::WristLimit;
use stiffarm::mass::{GRAVITY, ToolWeight};
use stiffarm::model::ModelKind;
use stiffarm::robot::{Arm, Robot};

/// What is at the flange.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FlangeLoad {
    /// The weight of the tool, where it is given.
    pub(super) tool: Option<ToolWeight>,
    /// Where the force acts, in the flange frame, m; `None` where the model has no tool.
    pub(super) tip: Option<Vector3<f64>>,
    /// The largest force, N.
    pub(super) newtons: f64,
}

/// What a robot is allowed to carry, and what takes it up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Carried {
    payload: Option<Payload>,
    wrist: Option<Wrist>,
    tool: Option<ToolWeight>,
}

/// The payload.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Payload {
    /// Nominal, kg.
    nominal: f64,
    /// Mass of the tool, kg, where it is given.
    tool: Option<f64>,
    /// The mass that weighs as much as the force pushes, kg.
    force: f64,
}

/// The moments about axes 4, 5 and 6, at worst over the angles of these joints and the directions of weight and force.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wrist {
    /// N m.
    moments: [f64; 3],
    /// N m, and what says so.
    limits: Option<([f64; 3], WristLimit)>,
    /// What the moments are of.
    of: &'static str,
}

impl FlangeLoad {
    /// With the tool of a model.
    pub(super) fn of(tool: Option<ToolWeight>, model: &ModelKind, newtons: f64) -> Self {
        let tip = match model {
            ModelKind::Planar => None,
            ModelKind::Spatial(flange_from_tool) => Some(flange_from_tool.translation.vector),
        };
        Self { tool, tip, newtons }
    }

    /// By a robot.
    pub(super) fn by(self, robot: &Robot) -> Carried {
        let Self { tool, newtons, .. } = self;
        let of = |nominal| Payload { nominal, tool: tool.map(|tool| tool.mass), force: newtons / GRAVITY };
        Carried { payload: robot.payload_kg.map(of), wrist: Wrist::of(robot, self), tool }
    }
}

impl Payload {
    /// Tool and force together are more than the payload: at worst the force points down.
    fn is_exceeded(self) -> bool {
        self.nominal < self.tool.unwrap_or(0.0) + self.force
    }

    /// `210 kg; tool of 25 kg, and a force as large as the weight of 102 kg`.
    fn in_words(self) -> String {
        let kg = |mass: f64| format!("{} kg", fixed(mass, 0));
        let force = format!("a force as large as the weight of {}", kg(self.force));
        let carried = match self.tool {
            Some(tool) if self.force == 0.0 => format!("tool of {tool} kg"),
            Some(tool) => format!("tool of {tool} kg, and {force}"),
            None => format!("{force}; the tool's mass is not given (--tool-mass-kg)"),
        };
        let exceeded = if self.is_exceeded() { ": EXCEEDED" } else { "" };
        format!("{} kg{exceeded}; {carried}", self.nominal)
    }
}

impl Wrist {
    /// `None` where nothing is to be stated: of two links alone, and where neither a limit nor the tool's mass centre is known.
    fn of(robot: &Robot, FlangeLoad { tool, tip, newtons }: FlangeLoad) -> Option<Self> {
        let Arm::SixAxis { geometry, drives, .. } = &robot.arm else { return None };
        let limits = drives.motors.wrist_limit();
        let about = |point: Vector3<f64>, newtons: f64| geometry.wrist_levers(&point).map(|lever| lever * newtons);
        let weight = tool.and_then(|tool| Some(about(tool.centre?, tool.mass * GRAVITY)));
        let force = tip.map(|tip| about(tip, newtons));
        let of = match (weight, force) {
            (Some(_), Some(_)) => "of the tool's weight and the force",
            (Some(_), None) if newtons == 0.0 => "of the tool's weight",
            (Some(_), None) => "of the tool's weight alone: the planar model has no tool tip",
            (None, Some(_)) => "of the force alone: the tool's weight is not given (--tool-mass-kg with --tool-com-mm)",
            (None, None) => return None,
        };
        if weight.is_none() && limits.is_none() {
            return None;
        }
        let part = |of: Option<[f64; 3]>, axis: usize| of.map_or(0.0, |of| of[axis]);
        Some(Self { moments: [0, 1, 2].map(|axis| part(weight, axis) + part(force, axis)), limits, of })
    }

    /// The first of the axes, 4 to 6, about which the limit is passed.
    fn exceeded(self) -> Option<usize> {
        let (limits, _) = self.limits?;
        (0..3).find(|&axis| limits[axis] < self.moments[axis]).map(|axis| axis + 4)
    }

    /// `axes 4, 5, 6: 465, 465, 0 N m at worst, of ..; limits 2274, 1398, 782 N m (torque limits of the drives)`.
    fn in_words(self) -> String {
        let list = |moments: [f64; 3]| moments.map(|moment| fixed(moment, 0)).join(", ");
        let limits = match self.limits {
            None => "no limit is known ([drives] wrist_moment_nm of the robot file)".into(),
            Some((limits, by)) => format!("limits {} N m ({})", list(limits), by.name()),
        };
        let exceeded = self.exceeded().map_or_else(String::new, |axis| format!(": EXCEEDED about axis {axis}"));
        format!("axes 4, 5, 6: {} N m at worst{exceeded}, {}; {limits}", list(self.moments), self.of)
    }
}

impl Carried {
    /// More than the robot may carry.
    pub(super) fn is_exceeded(self) -> bool {
        self.payload.is_some_and(Payload::is_exceeded) || self.wrist.and_then(Wrist::exceeded).is_some()
    }

    /// Each under its name, where something is known of it.
    fn each(self) -> impl Iterator<Item = (&'static str, String)> {
        let payload = self.payload.map(|payload| ("payload", payload.in_words()));
        payload.into_iter().chain(self.wrist.map(|wrist| ("wrist", wrist.in_words())))
    }

    /// For people.
    pub(super) fn lines(self) -> impl Iterator<Item = Line> {
        self.each().map(|(name, text)| line(name, text))
    }

    /// As sentences.
    pub(super) fn sentences(self) -> impl Iterator<Item = String> {
        self.each().map(|(name, text)| format!("{}{}: {text}.", name[..1].to_uppercase(), &name[1..]))
    }

    /// What is exceeded, after the name of each.
    pub(super) fn exceeded(self) -> Option<String> {
        let payload = self.payload.filter(|payload| payload.is_exceeded());
        let wrist = self.wrist.filter(|wrist| wrist.exceeded().is_some());
        let exceeded: Vec<String> =
            Self { payload, wrist, ..self }.each().map(|(name, text)| format!("{name} {text}")).collect();
        (!exceeded.is_empty()).then(|| exceeded.join("; "))
    }

    /// That a robot may not carry it, where that is so.
    pub(super) fn forbidden(self, robot: &Robot) -> Option<String> {
        Some(format!("{} may not carry this: {}.", robot.full_name(), self.exceeded()?))
    }

    /// As fields.
    pub(super) fn put(self, record: &mut Record) {
        let limits = self.wrist.and_then(|wrist| wrist.limits);
        record
            .put(field::PAYLOAD, self.payload.map(|payload| payload.nominal))
            .put(field::TOOL_MASS, self.tool.map(|tool| tool.mass))
            .put(field::OVERLOADED, self.payload.map(Payload::is_exceeded))
            .put(field::WRIST_MOMENT, self.wrist.map(|wrist| wrist.moments))
            .put(field::WRIST_LIMIT, limits.map(|(limits, _)| limits))
            .put(field::WRIST_LIMIT_BY, limits.map(|(_, by)| by.name()))
            .put(field::WRIST_EXCEEDED, limits.and(self.wrist).map(|wrist| wrist.exceeded().is_some()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiffarm::catalogue::{find, paper_robots};

    fn held(mass: Option<f64>, centre: Option<[f64; 3]>, newtons: f64) -> FlangeLoad {
        let tool = mass.map(|mass| ToolWeight { mass, centre: centre.map(Vector3::from) });
        FlangeLoad { tool, tip: Some(Vector3::new(0.0, 0.0, 0.25)), newtons }
    }

    /// By hand: 1000 N weigh as much as 102 kg.
    #[test]
    fn tool_and_force_are_compared_with_the_payload() {
        let robot = Robot { payload_kg: Some(120.0), ..paper_robots().swap_remove(4) };
        let of = |tool: Option<f64>, newtons: f64| held(tool, None, newtons).by(&robot);
        assert!(!of(Some(18.0), 1000.0).is_exceeded() && of(Some(18.1), 1000.0).is_exceeded());
        assert!(of(None, 1177.0).is_exceeded() && !of(None, 1176.7).is_exceeded());
        let expected = "Payload: 120 kg: EXCEEDED; tool of 25 kg, and a force as large as the weight of 102 kg.";
        assert_eq!(of(Some(25.0), 1000.0).sentences().next().as_deref(), Some(expected));
        let nothing = Robot { payload_kg: None, ..robot.clone() };
        assert_eq!(held(Some(25.0), None, 1000.0).by(&nothing).sentences().next(), None);
    }

    /// By hand: the flange is 0.215 m from the wrist centre, the tip 0.465; limits 2274, 1398 and 782 N m. 60 kg at 0.1 and 0.2 m:
    /// `hypot(0.1, 0.415)` = 0.42688 m and 0.1 m of 588.399 N.
    #[test]
    fn moments_about_the_wrist_are_compared_with_its_limits() {
        let robot = find("KR 210 R2700-2").expect("in the catalogue").robot();
        let wrist = |held: FlangeLoad| held.by(&robot).wrist.map(Wrist::in_words);
        assert_eq!(
            wrist(held(Some(60.0), Some([0.1, 0.0, 0.2]), 1000.0)).as_deref(),
            Some(
                "axes 4, 5, 6: 716, 716, 59 N m at worst, of the tool's weight and the force; limits 2274, 1398, 782 N m (torque limits of the drives)"
            )
        );
        assert_eq!(
            wrist(held(Some(60.0), None, 3100.0)).as_deref(),
            Some(
                "axes 4, 5, 6: 1442, 1442, 0 N m at worst: EXCEEDED about axis 5, of the force alone: the tool's weight is not given (--tool-mass-kg with --tool-com-mm); limits 2274, 1398, 782 N m (torque limits of the drives)"
            )
        );
        // 3007 N turn axis 5 with 1398.3 N m, 3006 N with less.
        let is_exceeded =
            |newtons: f64| Wrist::of(&robot, held(None, None, newtons)).and_then(Wrist::exceeded).is_some();
        assert!(is_exceeded(3008.0) && !is_exceeded(3006.0));
        // What the maker allows comes before what the drives could hold, and an unknown limit is not kept.
        let mut allowed = robot.clone();
        let Arm::SixAxis { drives, .. } = &mut allowed.arm else { unreachable!() };
        drives.motors.wrist_moment = Some([940.0, 940.0, 58.0]);
        let (heavy, light) =
            (held(Some(60.0), Some([0.1, 0.0, 0.2]), 100.0), held(Some(59.0), Some([0.1, 0.0, 0.2]), 100.0));
        assert_eq!(heavy.by(&allowed).wrist.and_then(Wrist::exceeded), Some(6));
        assert_eq!(light.by(&allowed).wrist.and_then(Wrist::exceeded), None);
        assert!(heavy.by(&allowed).is_exceeded());
        drives_unknown(&mut allowed);
        assert!(wrist_of(&allowed, heavy).is_some_and(|wrist| wrist.contains("no limit is known")));
        assert_eq!(wrist_of(&allowed, held(None, None, 100.0)), None);
    }

    fn drives_unknown(robot: &mut Robot) {
        let Arm::SixAxis { drives, .. } = &mut robot.arm else { unreachable!() };
        drives.motors = stiffarm::drive::Motors::UNKNOWN;
    }

    fn wrist_of(robot: &Robot, held: FlangeLoad) -> Option<String> {
        held.by(robot).wrist.map(Wrist::in_words)
    }
}
