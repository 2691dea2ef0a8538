//! An arm as points in space, with what the pointer says of them.

use crate::answer::Unit;
use nalgebra::Point3;
use stiffarm::model::PlanarModel;
use stiffarm::robot::{Arm, Robot};
use stiffarm::spatial::Pose;

use super::Point;

/// How far the tool axis is drawn beyond the tool point, m.
const AXIS: f64 = 0.25;

/// An arm in one posture.
#[derive(Clone, Debug, Default)]
pub struct ArmMark {
    /// From the base to the tool point, each with its name and numbers, lines parted by `\n`.
    pub points: Vec<(Point, String)>,
    /// The tool axis: its beginning and its end.
    pub tool: Option<[Point; 2]>,
}

impl ArmMark {
    /// A six-axis robot at the joint angles `q` it reports, rad; `shares` is what each drive gives of the deflection.
    ///
    /// `None` for a robot of which only the arm plane is known.
    pub fn posed(robot: &Robot, q: &[f64; 6], flange_from_tool: &Pose, shares: Option<&[f64; 6]>) -> Option<Self> {
        let Arm::SixAxis { geometry, limits, .. } = &robot.arm else { return None };
        let theta = geometry.model_angles(q, limits.third_axis);
        let joint = |i: usize| {
            let share =
                shares.map_or_else(String::new, |shares| format!(", {:.1} % of the deflection", shares[i] * 1e2));
            format!("joint {} at {:.2} deg{share}", i + 1, Unit::Degree.of_si(q[i]))
        };
        let wrist = format!("wrist centre\n{}\n{}\n{}", joint(3), joint(4), joint(5));
        let texts = [
            format!("base\n{}", joint(0)),
            format!("shoulder\n{}", joint(1)),
            format!("elbow\n{}", joint(2)),
            wrist,
            "flange".into(),
        ];
        let mut points: Vec<(Point, String)> = geometry.points(&theta).into_iter().zip(texts).collect();
        let base_from_tool = geometry.forward(&theta) * flange_from_tool;
        let at = |along: f64| (base_from_tool * Point3::new(0.0, 0.0, along)).coords.into();
        if 1e-6 < flange_from_tool.translation.vector.norm() {
            points.push((at(0.0), "tool point".into()));
        }
        Some(Self { points, tool: Some([at(0.0), at(AXIS)]) })
    }

    /// The two links of an arm plane, which stands beside the joint-1 axis where the arm does, at shoulder and elbow angle, rad.
    pub fn planar(model: &PlanarModel, [shoulder, elbow]: [f64; 2]) -> Self {
        let [axis, upper_arm, wrist] = model.points([shoulder, elbow]).map(|[x, z]| [x, model.aside(), z]);
        let text = |name: &str, angle: f64| format!("{name}\n{:.2} deg in the arm plane", Unit::Degree.of_si(angle));
        let base = (model.axis_from_base() != [0.0; 2]).then(|| ([0.0; 3], "base".to_owned()));
        let links = [
            (axis, text("shoulder", shoulder)),
            (upper_arm, text("elbow", elbow)),
            (wrist, "wrist centre: tool point of the planar model".to_owned()),
        ];
        Self { points: base.into_iter().chain(links).collect(), tool: None }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use stiffarm::catalogue::paper_robots;
    use stiffarm::model::Model;

    use super::*;

    #[test]
    fn an_arm_stands_where_the_library_puts_it() {
        let robot = paper_robots().into_iter().find(|robot| robot.name.starts_with("KR 210")).unwrap();
        let q = [0.0, -90.0, 90.0, 0.0, 0.0, 0.0_f64].map(f64::to_radians);
        let arm = ArmMark::posed(&robot, &q, &Pose::translation(0.0, 0.0, 0.2), Some(&[0.25; 6])).unwrap();
        // Upper arm up, forearm level: 0.350 + 1.200 + 0.215 + 0.200 m ahead, 0.675 + 1.150 - 0.041 m up.
        let expected = [[0.0, 0.0], [0.35, 0.675], [0.35, 1.825], [1.55, 1.784], [1.765, 1.784], [1.965, 1.784]];
        assert_eq!(arm.points.len(), expected.len());
        for ((found, text), [x, z]) in arm.points.iter().zip(expected) {
            let apart = (Vector3::from(*found) - Vector3::new(x, 0.0, z)).norm();
            assert!(apart < 1e-12, "{text}: {found:?}");
        }
        assert!(arm.points[1].1.contains("joint 2 at -90.00 deg, 25.0 % of the deflection"), "{}", arm.points[1].1);
        let [from, to] = arm.tool.unwrap().map(Vector3::from);
        assert!((from - Vector3::new(1.965, 0.0, 1.784)).norm() < 1e-12);
        assert!((to - from - AXIS * Vector3::x()).norm() < 1e-12);
    }

    #[test]
    fn the_planar_arm_ends_where_the_spatial_one_has_its_wrist() {
        let robot = paper_robots().into_iter().find(|robot| robot.name.starts_with("KR 210")).unwrap();
        let Arm::SixAxis { geometry, .. } = &robot.arm else { panic!("a six-axis robot") };
        let [_, shoulder, elbow, wrist, _] = geometry.points(&[0.0, 0.3, 1.2, 0.0, 0.0, 0.0]);
        // The shoulder is pi/2 - theta2, the elbow -atan2(a2, c3) - theta3.
        let lean = geometry.a2.atan2(geometry.c3);
        let posture = [std::f64::consts::FRAC_PI_2 - 0.3, -lean - 1.2];
        let Model::Planar(model) = Model::planar(&robot).unwrap() else { panic!("asked for") };
        let arm = ArmMark::planar(&model, posture);
        for ((found, text), expected) in arm.points.iter().skip(1).zip([shoulder, elbow, wrist]) {
            assert!((Vector3::from(*found) - Vector3::from(expected)).norm() < 1e-12, "{text}: {found:?}");
        }
    }
}
