//! How an arm swings at a posture: its lowest modes, drawn many times larger, from the side and from above.

use nalgebra::Vector3;
use stiffarm::modes::{Mode, Swing};
use stiffarm::palette::{ARM, BASE, GREY, INK, PAPER, RATIOS};
use stiffarm::robot::Arm;

use super::FigureSize;
use super::axes::{Axis, Frame, heading};
use super::canvas::{Canvas, Px};
use super::legend::{Entry, Legend};
use crate::answer::words::fixed;
use crate::answer::{ModesAnswer, stiffness};

/// How many modes are drawn.
const DRAWN: usize = 3;
/// How far a mode moves the arm at most, as part of what is shown.
const SWING: f64 = 0.12;
/// Between the diagrams, and left of each for its labels, px.
const GAP: f64 = 78.0;
/// Beside what is drawn, m.
const BESIDE: f64 = 0.12;
/// Widths of base, upper arm, forearm, wrist and tool, px.
const LINKS: [f64; 5] = [14.0, 11.0, 8.0, 6.0, 3.0];

/// Base, joint-2 axis, elbow, wrist centre, flange and tip, m, or how they move.
type Line = [Vector3<f64>; 6];

/// The figure as SVG text.
pub(crate) fn svg(answer: &ModesAnswer, figure_size: &FigureSize) -> String {
    let mut canvas = Canvas::of(figure_size);
    let title = format!("{}: how the arm swings", answer.robot.full_name());
    let subtitle = format!(
        "joints {}; {}; each mode is drawn many times larger than it is",
        joints(answer),
        stiffness(&answer.robot)
    );
    let top = heading(&mut canvas, &title, &subtitle) + 36.0;
    let at_rest = at_rest(&answer.swing);
    let swung: Vec<(usize, Line)> = answer
        .modes()
        .iter()
        .take(DRAWN)
        .enumerate()
        .filter_map(|(i, mode)| Some((i, swung(mode, &at_rest)?)))
        .collect();
    let width = (canvas.width - 2.0 * GAP - 24.0) / 2.0;
    let ahead = ahead(answer);
    // To the left of the arm plane is upwards.
    let views = [
        View { name: "from the side", upwards: "up [m]", axes: [ahead, Vector3::z()] },
        View { name: "from above", upwards: "left [m]", axes: [ahead, Vector3::z().cross(&ahead)] },
    ];
    let mut bottom: f64 = top;
    for (i, view) in views.into_iter().enumerate() {
        let left = GAP + i as f64 * (width + GAP);
        let frame = view.frame(&at_rest, &swung, [left, left + width], top);
        frame.grid(&mut canvas);
        arm(&mut canvas, &at_rest.map(|point| view.at(&frame, &point)));
        for (rank, moved) in &swung {
            view.shape(&mut canvas, &frame, (&at_rest, moved), RATIOS[*rank]);
        }
        frame.draw(&mut canvas, "ahead in the arm plane [m]", view.upwards);
        frame.headline(&mut canvas, view.name);
        bottom = bottom.max(frame.y.px[0]);
    }
    let legend = Legend::new(entries(answer, &swung), canvas.width - 80.0, 2);
    legend.draw(&mut canvas, [40.0, bottom + 54.0]);
    canvas.height = bottom + 68.0 + legend.height();
    canvas.finish()
}

/// As the robot reports them.
fn joints(answer: &ModesAnswer) -> String {
    format!("{} deg", answer.joints_deg.map(|angle| angle.to_string()).join(", "))
}

fn at_rest(swing: &Swing) -> Line {
    let [base, shoulder, elbow, wrist, flange] = swing.points;
    [base, shoulder, elbow, wrist, flange, swing.tool.translation.vector]
}

/// How far the points of a mode are drawn from where they are; `None` where it moves none of them.
fn swung(mode: &Mode, at_rest: &Line) -> Option<Line> {
    let [base, shoulder, elbow, wrist, flange] = mode.moved;
    let moved = [base, shoulder, elbow, wrist, flange, mode.tip];
    let most = |line: &Line| line.iter().map(Vector3::norm).fold(0.0, f64::max);
    let scale = SWING * most(at_rest) / most(&moved);
    scale.is_finite().then(|| moved.map(|point| point * scale))
}

/// Forwards in the arm plane.
fn ahead(answer: &ModesAnswer) -> Vector3<f64> {
    let bearing = match &answer.robot.arm {
        Arm::SixAxis { geometry, limits, .. } => {
            geometry.model_angles(&answer.joints_deg.map(f64::to_radians), limits.third_axis)[0]
        }
        Arm::Planar(_) => 0.0,
    };
    Vector3::new(bearing.cos(), bearing.sin(), 0.0)
}

/// The arm as it is seen from one side.
struct View {
    name: &'static str,
    /// What the upright axis is called.
    upwards: &'static str,
    /// What is seen to the right and upwards, of length one, base axes.
    axes: [Vector3<f64>; 2],
}

impl View {
    fn seen(&self, point: &Vector3<f64>) -> [f64; 2] {
        self.axes.map(|axis| axis.dot(point))
    }

    fn at(&self, frame: &Frame, point: &Vector3<f64>) -> Px {
        let [x, y] = self.seen(point);
        frame.at(x, y)
    }

    /// Around all that is seen, both axes on one scale.
    fn frame(&self, at_rest: &Line, swung: &[(usize, Line)], px: [f64; 2], top: f64) -> Frame {
        let ways = swung.iter().flat_map(|(_, moved)| [along(at_rest, moved, 1.0), along(at_rest, moved, -1.0)]);
        let points: Vec<[f64; 2]> = ways.chain([*at_rest]).flatten().map(|point| self.seen(&point)).collect();
        let ends = [0, 1].map(|axis| {
            let ends = points.iter().map(|point| point[axis]);
            let (low, high) = ends.fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
            [low - BESIDE, high + BESIDE]
        });
        let per_metre = (px[1] - px[0]) / (ends[0][1] - ends[0][0]);
        let height = per_metre * (ends[1][1] - ends[1][0]);
        Frame { x: Axis::new(ends[0][0], ends[0][1], px), y: Axis::new(ends[1][0], ends[1][1], [top + height, top]) }
    }

    /// One mode: where it swings to, and back.
    fn shape(&self, canvas: &mut Canvas, frame: &Frame, (at_rest, moved): (&Line, &Line), colour: &str) {
        for (sign, dashes) in [(1.0, ""), (-1.0, r#" stroke-dasharray="5 4""#)] {
            let points = along(at_rest, moved, sign).map(|point| self.at(frame, &point));
            let look = format!(r#"fill="none" stroke="{colour}" stroke-width="2.2" stroke-linejoin="round"{dashes}"#);
            canvas.polyline(&points, &look);
            if 0.0 < sign {
                canvas.circle(points[5], 3.6, &format!(r#"fill="{colour}""#));
            }
        }
    }
}

/// The points of the arm where a mode has moved them.
fn along(at_rest: &Line, moved: &Line, sign: f64) -> Line {
    std::array::from_fn(|i| at_rest[i] + moved[i] * sign)
}

/// The arm at rest, its links as thick lines.
fn arm(canvas: &mut Canvas, points: &[Px; 6]) {
    for (i, (link, width)) in points.windows(2).zip(LINKS).enumerate().rev() {
        let fill = if i == 0 { BASE } else { ARM };
        for (colour, width) in [(GREY, width), (fill, width - 2.0)] {
            let look = format!(r#"stroke="{colour}" stroke-width="{width}" stroke-linecap="round""#);
            canvas.line(link[0], link[1], &look);
        }
    }
    for joint in &points[1..4] {
        canvas.circle(*joint, 3.2, &format!(r#"fill="{PAPER}" stroke="{INK}" stroke-width="1.4""#));
    }
}

/// A line a mode, with its frequency and how far that may be off.
fn entries(answer: &ModesAnswer, swung: &[(usize, Line)]) -> Vec<Entry> {
    let label = |rank: usize| {
        let mode = &answer.modes()[rank];
        let between = mode.spread.map_or_else(String::new, |spread| {
            format!(" (90 %: {} to {} Hz)", fixed(spread.p05, 1), fixed(spread.p95, 1))
        });
        format!("mode {}: {} Hz{between}", rank + 1, fixed(mode.frequency, 2))
    };
    let look = |rank: usize| format!(r#"stroke="{}" stroke-width="2.2""#, RATIOS[rank]);
    let modes = swung.iter().map(|(rank, _)| Entry::line(label(*rank), look(*rank)));
    let back = format!(r#"stroke="{GREY}" stroke-width="2.2" stroke-dasharray="5 4""#);
    modes.chain([Entry::line("the same half a swing later", back)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::is_svg;
    use nalgebra::Vector2;
    use stiffarm::catalogue::find;
    use stiffarm::mass::RigidBody;
    use stiffarm::modes::{HeldTool, modes};
    use stiffarm::prior::with_prior;
    use stiffarm::spatial::Pose;

    fn answer(joint_1: f64, count: usize) -> ModesAnswer {
        let robot = with_prior(&find("KR 210 R2700-2").unwrap().robot()).unwrap();
        let body = RigidBody::point(60.0, Vector3::new(0.0, 0.0, 0.2));
        let tool = HeldTool { flange_from_tool: Pose::translation(0.0, 0.0, 0.2), body: Some(body) };
        let joints_deg = [joint_1, -90.0, 90.0, 0.0, 45.0, 0.0];
        let swing = modes(&robot, &joints_deg.map(f64::to_radians), &tool, None).unwrap();
        ModesAnswer { robot, joints_deg, tool, damping: None, count, swing }
    }

    #[test]
    fn a_figure_has_each_mode_there_and_back_in_both_views_with_its_interval() {
        for (count, drawn) in [(6, 3), (2, 2)] {
            let answer = answer(20.0, count);
            let text = svg(&answer, &FigureSize::default());
            assert!(is_svg(&text), "{text}");
            assert_eq!(text.matches("stroke-linejoin").count(), drawn * 2 * 2, "{text}");
            let first = answer.modes()[0];
            let spread = first.spread.unwrap();
            let expected =
                format!("mode 1: {:.2} Hz (90 %: {:.1} to {:.1} Hz)", first.frequency, spread.p05, spread.p95);
            assert!(text.contains(&expected), "{expected}: {text}");
        }
    }

    /// Seen along the arm plane, whatever joint 1 does; a shape may be drawn the other way about.
    #[test]
    fn turning_joint_1_turns_the_views_with_it() {
        let [straight, turned] = [0.0, 70.0].map(|joint_1| answer(joint_1, 6));
        for axes in
            [|ahead: Vector3<f64>| [ahead, Vector3::z()], |ahead: Vector3<f64>| [ahead, Vector3::z().cross(&ahead)]]
        {
            let seen = |answer: &ModesAnswer| {
                let view = View { name: "", upwards: "", axes: axes(ahead(answer)) };
                let at_rest = at_rest(&answer.swing);
                let moved = swung(&answer.swing.modes[0], &at_rest).unwrap();
                [at_rest, moved].map(|line| line.map(|point| Vector2::from(view.seen(&point))))
            };
            let ([rest, moved], [rest_turned, moved_turned]) = (seen(&straight), seen(&turned));
            for (point, other) in rest.iter().zip(&rest_turned) {
                assert!((point - other).norm() < 1e-9, "{rest:?} {rest_turned:?}");
            }
            for (by, other) in moved.iter().zip(&moved_turned) {
                assert!((by - other).norm().min((by + other).norm()) < 1e-6, "{moved:?} {moved_turned:?}");
            }
        }
        // The largest of what is drawn is a set part of the arm.
        let rest = at_rest(&straight.swing);
        let most = |line: Line| line.iter().map(Vector3::norm).fold(0.0, f64::max);
        let moved = swung(&straight.swing.modes[1], &rest).unwrap();
        assert!((most(moved) / most(rest) - SWING).abs() < 1e-9);
    }
}
