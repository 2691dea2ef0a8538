//! What must the robot hold, against the payload that it is sold for?

use super::words::fixed;
use super::{Line, Record, field, line};
use stiffarm::robot::Robot;

/// m/s^2.
const GRAVITY: f64 = 9.806_65;

/// A payload, and what takes it up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Payload {
    /// Nominal, kg.
    nominal: f64,
    /// Mass of the tool, kg, where it is told.
    tool: Option<f64>,
    /// The mass that weighs as much as the force pushes, kg.
    force: f64,
}

impl Payload {
    /// Of a robot under a tool, kg, and a force, N; `None` where nobody says what it is sold for.
    pub(super) fn of(robot: &Robot, tool: Option<f64>, newtons: f64) -> Option<Self> {
        Some(Self { nominal: robot.payload_kg?, tool, force: newtons / GRAVITY })
    }

    /// Tool and force together are more than the payload: at worst the force points down.
    pub(super) fn is_exceeded(self) -> bool {
        self.nominal < self.tool.unwrap_or(0.0) + self.force
    }

    /// `210 kg; tool of 25 kg, and a force as large as the weight of 102 kg`.
    pub(super) fn told(self) -> String {
        let kg = |mass: f64| format!("{} kg", fixed(mass, 0));
        let force = format!("a force as large as the weight of {}", kg(self.force));
        let carried = match self.tool {
            Some(tool) => format!("tool of {tool} kg, and {force}"),
            None => format!("{force}; the tool's mass is not told (--tool-mass-kg)"),
        };
        let exceeded = if self.is_exceeded() { ": EXCEEDED" } else { "" };
        format!("{} kg{exceeded}; {carried}", self.nominal)
    }
}

/// For people, where there is a payload.
pub(super) fn lines(payload: Option<Payload>) -> Option<Line> {
    payload.map(|payload| line("payload", payload.told()))
}

/// As fields.
pub(super) fn put(record: &mut Record, robot: &Robot, tool: Option<f64>, newtons: f64) {
    record
        .put(field::PAYLOAD, robot.payload_kg)
        .put(field::TOOL_MASS, tool)
        .put(field::OVERLOADED, Payload::of(robot, tool, newtons).map(Payload::is_exceeded));
}

#[cfg(test)]
mod tests {
    use super::*;
    use stiffarm::catalogue::paper_robots;

    /// By hand: 1000 N weigh as much as 102 kg.
    #[test]
    fn tool_and_force_are_told_against_the_payload() {
        let robot = Robot { payload_kg: Some(120.0), ..paper_robots().swap_remove(4) };
        let of = |tool: Option<f64>, newtons: f64| Payload::of(&robot, tool, newtons).unwrap();
        assert!(!of(Some(18.0), 1000.0).is_exceeded() && of(Some(18.1), 1000.0).is_exceeded());
        assert!(of(None, 1177.0).is_exceeded() && !of(None, 1176.7).is_exceeded());
        let told = "120 kg: EXCEEDED; tool of 25 kg, and a force as large as the weight of 102 kg";
        assert_eq!(of(Some(25.0), 1000.0).told(), told);
        let nothing = Robot { payload_kg: None, ..robot.clone() };
        assert_eq!(Payload::of(&nothing, Some(25.0), 1000.0), None);
    }
}
