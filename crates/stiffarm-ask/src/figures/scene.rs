//! What stands in the arm plane: floor, base, arm and zone, and their legend.

use std::f64::consts::TAU;

use stiffarm::interval::Interval;
use stiffarm::palette::{ARM, BASE, FORCE, GROUND, INK, KEEP_OUT, PAPER, WINDOW, WORST_POINT, ZONE};
use stiffarm::plane::PlanarArm;
use stiffarm::task::Zone;

use super::axes::{Axis, Frame};
use super::canvas::{Canvas, Px, path};
use super::legend::Entry;
use super::marks;

const CROSS: &str = r#"stroke-linecap="round" fill="none""#;

/// What is drawn over a map or a reached set; lengths in m in the axes of the diagram.
pub(crate) struct Scene {
    /// The joint-2 axis.
    pub axis: [f64; 2],
    /// Elbow, wrist centre, and from there on to the tool point; nothing where no arm is drawn.
    pub links: Vec<[f64; 2]>,
    /// The length of a link, for the size of the base.
    pub link: f64,
    /// Where the joint-1 axis meets the floor; base and floor are drawn where the joint-2 axis is 5 cm or more above.
    pub base: Option<[f64; 2]>,
    /// How high above the floor it stands, on a pedestal, m; below it where negative.
    pub raised: f64,
    /// Where the work stands.
    pub zone: Option<ZoneMark>,
    /// Where it may stand; an end may be open.
    pub windows: Vec<[Interval; 2]>,
    /// Where nothing may be.
    pub keep_outs: Vec<[Interval; 2]>,
    /// The force on the tool.
    pub force: Option<ForceMark>,
}

/// A force of a direction that is known.
#[derive(Clone, Debug)]
pub(crate) struct ForceMark {
    /// Where it points: ahead and up, of length 1 or less where it leaves the plane.
    pub towards: [f64; 2],
    /// Its entry in the legend.
    pub label: String,
}

/// A zone at its place, as it is seen in a diagram.
pub(crate) struct ZoneMark {
    /// What stands there.
    pub zone: Zone,
    /// Its rim as a closed line, see [`rim`].
    pub rim: Vec<[f64; 2]>,
    /// Where the deflection is largest.
    pub worst_point: [f64; 2],
    /// Its entry in the legend.
    pub label: String,
}

/// Elbow and wrist centre of an arm with its joint-2 axis at the origin, at shoulder and elbow angle, rad.
pub(crate) fn links(arm: &PlanarArm, (shoulder, elbow): (f64, f64)) -> Vec<[f64; 2]> {
    vec![[arm.l2 * shoulder.cos(), arm.l2 * shoulder.sin()], arm.forward(shoulder, elbow).into()]
}

impl Scene {
    /// A frame on a sheet `width` px wide, below `top` px, with equal scales on both axes, around `shown` (m) and everything of
    /// the scene.
    pub(crate) fn frame(&self, shown: Vec<[f64; 2]>, width: f64, top: f64) -> Frame {
        frame_around(&self.points(shown), width, top, [85.0, 165.0])
    }

    /// The points that a frame must hold: `shown` (m), and everything of the scene.
    pub(crate) fn points(&self, mut shown: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        let room = 0.24 * self.link;
        shown.extend(self.joints().into_iter().flat_map(|[x, z]| [[x - room, z - room], [x + room, z + room]]));
        if let Some([x, z]) = self.standing() {
            let size = self.base_size();
            shown.extend([
                [x - 0.45 * size, z - self.raised.max(0.0) - 0.15 * size],
                [x + 0.45 * size, self.axis[1] + room],
            ]);
        }
        shown.extend(self.zone.iter().flat_map(|mark| mark.rim.iter().copied()));
        let beyond = |[from, to]: [[f64; 2]; 2]| [0, 1].map(|k| to[k] + 0.1 * (to[k] - from[k]));
        shown.extend(self.force.iter().map(|force| beyond(self.force_ends(force))));
        shown.retain(|point| point.iter().all(|x| x.is_finite()));
        shown
    }

    /// The joint-2 axis and what follows it; nothing where no arm is drawn.
    fn joints(&self) -> Vec<[f64; 2]> {
        let axis = (!self.links.is_empty()).then_some(self.axis);
        axis.into_iter().chain(self.links.iter().copied()).collect()
    }

    /// The base, where there is one below the joint-2 axis.
    fn standing(&self) -> Option<[f64; 2]> {
        self.base.filter(|[x, z]| x.is_finite() && z.is_finite() && 0.05 < self.axis[1] - z)
    }

    /// A small arm stands on a small base; 1 for the heavy ones.
    fn base_size(&self) -> f64 {
        self.link.clamp(0.1, 1.0)
    }

    /// What labels keep clear of.
    pub(crate) fn covered(&self, frame: &Frame) -> Vec<Vec<Px>> {
        let placed = |points: &[[f64; 2]]| points.iter().map(|[x, z]| frame.at(*x, *z)).collect::<Vec<_>>();
        let [[left, bottom], [right, top]] = frame.corners();
        let mut lines = vec![vec![[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]]];
        lines.push(placed(&self.joints()));
        lines.extend(self.standing().map(|[x, z]| placed(&[[x, z], [x, self.axis[1]], self.axis])));
        if let Some(mark) = &self.zone {
            lines.push(placed(&mark.rim));
            lines.push(placed(&[mark.worst_point; 2]));
        }
        lines
    }

    pub(crate) fn floor(&self, canvas: &mut Canvas, frame: &Frame) {
        let Some([_, floor]) = self.standing() else { return };
        let [[left, bottom], [right, _]] = frame.corners();
        let y = frame.y.at(floor - self.raised);
        for i in 0..=((right - left) / 12.0) as usize {
            let x = left + 12.0 * i as f64;
            canvas.line([x, y + 9.0], [x + 9.0, y], &format!(r#"stroke="{GROUND}" stroke-width="0.8""#));
        }
        if y < bottom {
            canvas.line([left, y], [right, y], &format!(r#"stroke="{INK}" stroke-width="1.5""#));
        }
    }

    /// A foot, and a column that leans from the joint-1 axis to the joint-2 axis; half transparent, as the map goes on behind.
    pub(crate) fn draw_base(&self, canvas: &mut Canvas, frame: &Frame) {
        let Some([x, z]) = self.standing() else { return };
        let [ahead, height] = [self.axis[0] - x, self.axis[1] - z];
        let foot = (0.12 * height).min(0.1);
        let [half, waist, head] = [0.4, 0.28, 0.1].map(|width| width * self.base_size());
        let points = [
            [-half, 0.0],
            [half, 0.0],
            [half, foot],
            [waist, foot],
            [ahead + 1.2 * head, height - 0.5 * head],
            [ahead + head, height + head],
            [ahead - head, height + head],
            [-waist, foot],
            [-half, foot],
        ];
        let placed = points.map(|[right, up]| frame.at(x + right, z + up));
        let look =
            format!(r#"fill="{BASE}" fill-opacity="0.7" stroke="{INK}" stroke-width="1.2" stroke-linejoin="round""#);
        if 0.0 < self.raised {
            canvas.rect(frame.at(x - 0.85 * half, z - self.raised), frame.at(x + 0.85 * half, z), &look);
        }
        canvas.path(&path(&placed, true), &look);
    }

    /// Windows in which the work may stand, and what must stay free.
    pub(crate) fn draw_cell(&self, canvas: &mut Canvas, frame: &Frame) {
        let [[left, bottom], [right, top]] = frame.corners();
        // An open end lies outside the frame.
        let within = |[x, z]: &[Interval; 2]| {
            let across = [x.min(), x.max()].map(|x| frame.x.at(x).clamp(left - 9.0, right + 9.0));
            let up = [z.min(), z.max()].map(|z| frame.y.at(z).clamp(top - 9.0, bottom + 9.0));
            [[across[0], up[0]], [across[1], up[1]]]
        };
        for range in &self.keep_outs {
            let [one, other] = within(range);
            keep_out(canvas, one, other);
        }
        for range in &self.windows {
            let [one, other] = within(range);
            for look in
                [format!(r#"fill="none" stroke="{PAPER}" stroke-opacity="0.8" stroke-width="4.5""#), window_look()]
            {
                // A box without a height or a width is drawn by no program; it is a line.
                if one[0] == other[0] || one[1] == other[1] {
                    canvas.path(&path(&[one, other], false), &look);
                } else {
                    canvas.rect(one, other, &look);
                }
            }
        }
    }

    /// The force at the tool point, or at the joint-2 axis where no arm is drawn.
    pub(crate) fn draw_force(&self, canvas: &mut Canvas, frame: &Frame) {
        let Some(force) = &self.force else { return };
        let [from, to] = self.force_ends(force);
        arrow(canvas, frame.at(from[0], from[1]), frame.at(to[0], to[1]));
    }

    /// It starts at the tool point: ending there, it would lie on the arm.
    fn force_ends(&self, force: &ForceMark) -> [[f64; 2]; 2] {
        let at = self.links.last().copied().unwrap_or(self.axis);
        [at, [0, 1].map(|k| at[k] + 0.35 * self.link * force.towards[k])]
    }

    pub(crate) fn draw_zone(&self, canvas: &mut Canvas, frame: &Frame) {
        if let Some(mark) = &self.zone {
            draw_rim(canvas, &mark.rim.iter().map(|[x, z]| frame.at(*x, *z)).collect::<Vec<_>>());
        }
    }

    pub(crate) fn draw_arm(&self, canvas: &mut Canvas, frame: &Frame) {
        let joints: Vec<Px> = self.joints().iter().map(|[x, z]| frame.at(*x, *z)).collect();
        // Upper arm, forearm, hand, tool; the nearer to the base the nearer to the eye.
        for (link, width) in joints.windows(2).zip([15.0, 11.0, 8.0, 5.0]).rev() {
            for (colour, width) in [(INK, width), (ARM, width - 3.0)] {
                let look = format!(r#"stroke="{colour}" stroke-width="{width}" stroke-linecap="round""#);
                canvas.line(link[0], link[1], &look);
            }
        }
        for (joint, radius) in joints.iter().skip(1).zip([5.0, 4.0]) {
            canvas.circle(*joint, radius, &format!(r#"fill="{PAPER}" stroke="{INK}" stroke-width="2""#));
        }
        let axis = frame.at(self.axis[0], self.axis[1]);
        canvas.circle(axis, 6.0, &format!(r#"fill="{PAPER}" stroke="{INK}" stroke-width="2""#));
        canvas.circle(axis, 2.0, &format!(r#"fill="{INK}""#));
    }

    pub(crate) fn draw_worst_point(&self, canvas: &mut Canvas, frame: &Frame) {
        if let Some(mark) = &self.zone {
            worst_mark(canvas, frame.at(mark.worst_point[0], mark.worst_point[1]));
        }
    }

    pub(crate) fn entries(&self) -> Vec<Entry> {
        let mut entries = Vec::new();
        if let Some(mark) = &self.zone {
            let zone = mark.zone;
            entries.push(Entry::new(mark.label.clone(), move |canvas, [x, y]| {
                let look = format!(r#"fill="none" stroke="{ZONE}" stroke-width="2.5""#);
                match zone {
                    Zone::Circle { .. } => canvas.circle([x, y], 7.5, &look),
                    Zone::Rectangle { .. } => canvas.rect([x - 12.0, y - 6.0], [x + 12.0, y + 6.0], &look),
                }
            }));
            entries.push(Entry::new("worst point of the zone", worst_mark));
        }
        if !self.windows.is_empty() {
            entries.push(Entry::new("where the zone may stand", |canvas, [x, y]| {
                canvas.rect([x - 15.0, y - 6.5], [x + 15.0, y + 6.5], &window_look());
            }));
        }
        if !self.keep_outs.is_empty() {
            let sample = |canvas: &mut Canvas, [x, y]: Px| keep_out(canvas, [x - 15.0, y - 6.5], [x + 15.0, y + 6.5]);
            entries.push(Entry::new("kept free", sample));
        }
        if let Some(force) = &self.force {
            let sample = |canvas: &mut Canvas, [x, y]: Px| arrow(canvas, [x - 17.0, y], [x + 17.0, y]);
            entries.push(Entry::new(force.label.clone(), sample));
        }
        if !self.links.is_empty() {
            let text =
                if self.links.len() == 2 { "upper arm and forearm" } else { "the arm, seen from its right side" };
            entries.push(Entry::new(text, |canvas, [x, y]| {
                for (colour, width) in [(INK, 11.0), (ARM, 8.0)] {
                    let look = format!(r#"stroke="{colour}" stroke-width="{width}" stroke-linecap="round""#);
                    canvas.line([x - 12.0, y], [x + 12.0, y], &look);
                }
            }));
        }
        entries.push(Entry::new("joint-2 axis", |canvas, at| {
            canvas.circle(at, 6.0, &format!(r#"fill="{PAPER}" stroke="{INK}" stroke-width="2""#));
            canvas.circle(at, 2.0, &format!(r#"fill="{INK}""#));
        }));
        entries
    }
}

/// A frame around points, m, on a sheet `width` px wide, below `top` px, with room on its left and right, and equal scales on both axes.
pub(crate) fn frame_around(points: &[[f64; 2]], width: f64, top: f64, [left, right]: [f64; 2]) -> Frame {
    let ends = |k: usize| {
        let values = points.iter().map(|point| point[k]);
        let axis =
            Axis::new(values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max), [0.0; 2]);
        (axis.from, axis.to)
    };
    let (x, z) = (ends(0), ends(1));
    let room = width - left - right;
    let scale = (room / (x.1 - x.0)).min(0.78 * width / (z.1 - z.0));
    // A sliver of a map still gets a frame in which axis titles have room.
    let widened = |(from, to): (f64, f64)| {
        let missing = (room.min(300.0) / scale - (to - from)).max(0.0) / 2.0;
        (from - missing, to + missing)
    };
    let (x, z) = (widened(x), widened(z));
    let (width, height) = (scale * (x.1 - x.0), scale * (z.1 - z.0));
    let left = left + (room - width) / 2.0;
    Frame { x: Axis::new(x.0, x.1, [left, left + width]), y: Axis::new(z.0, z.1, [top + height, top]) }
}

fn window_look() -> String {
    format!(r#"fill="none" stroke="{WINDOW}" stroke-width="2" stroke-dasharray="8 4""#)
}

/// A hatched rectangle.
fn keep_out(canvas: &mut Canvas, [x0, y0]: Px, [x1, y1]: Px) {
    let [left, right, top, bottom] = [x0.min(x1), x0.max(x1), y0.min(y1), y0.max(y1)];
    canvas.rect([left, top], [right, bottom], &format!(r#"fill="{KEEP_OUT}" fill-opacity="0.14""#));
    let thin = format!(r#"stroke="{KEEP_OUT}" stroke-width="1""#);
    let (width, height) = (right - left, bottom - top);
    // Lines down to the left, each cut to the rectangle.
    for i in 1..((width + height) / 9.0).min(600.0) as usize {
        let sum = 9.0 * i as f64;
        let (from, to) = (
            [left + sum.min(width), top + (sum - width).max(0.0)],
            [left + (sum - height).max(0.0), top + sum.min(height)],
        );
        canvas.line(from, to, &thin);
    }
    canvas.rect([left, top], [right, bottom], &format!(r#"fill="none" stroke="{KEEP_OUT}" stroke-width="1.8""#));
}

/// An arrow with a white rim.
fn arrow(canvas: &mut Canvas, from: Px, to: Px) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    if !(1.0 <= length) {
        return;
    }
    let unit = along.map(|part| part / length);
    let head = 13.0_f64.min(0.5 * length);
    let neck = [0, 1].map(|k| to[k] - head * unit[k]);
    let side = |s: f64| [neck[0] - s * 0.5 * head * unit[1], neck[1] + s * 0.5 * head * unit[0]];
    let tip = path(&[to, side(1.0), side(-1.0)], true);
    canvas.line(from, neck, &format!(r#"stroke="{PAPER}" stroke-width="7.5" stroke-linecap="round""#));
    canvas.path(&tip, &format!(r#"fill="{PAPER}" stroke="{PAPER}" stroke-width="4" stroke-linejoin="round""#));
    canvas.line(from, neck, &format!(r#"stroke="{FORCE}" stroke-width="3.5" stroke-linecap="round""#));
    canvas.path(&tip, &format!(r#"fill="{FORCE}""#));
}

/// The rim of a zone, px.
pub(crate) fn draw_rim(canvas: &mut Canvas, points: &[Px]) {
    let d = path(points, true);
    canvas.path(
        &d,
        &format!(r#"fill="none" stroke="{PAPER}" stroke-opacity="0.9" stroke-width="5" stroke-linejoin="round""#),
    );
    canvas.path(&d, &format!(r#"fill="none" stroke="{ZONE}" stroke-width="2.5" stroke-linejoin="round""#));
}

pub(crate) fn worst_mark(canvas: &mut Canvas, at: Px) {
    marks::cross(canvas, at, 6.5, &format!(r#"{CROSS} stroke="{PAPER}" stroke-width="7""#));
    marks::cross(canvas, at, 6.5, &format!(r#"{CROSS} stroke="{WORST_POINT}" stroke-width="3.2""#));
}

/// The rim of a zone as a closed line, m, with its centre and the angle of its first side, rad.
pub(crate) fn rim(zone: Zone, centre: [f64; 2], angle: f64) -> Vec<[f64; 2]> {
    let own: Vec<[f64; 2]> = match zone {
        Zone::Circle { diameter } => (0..=72)
            .map(|i| (TAU * f64::from(i) / 72.0).sin_cos())
            .map(|(s, c)| [diameter / 2.0 * c, diameter / 2.0 * s])
            .collect(),
        Zone::Rectangle { .. } => {
            [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]].map(|corner| zone.at(corner)).to_vec()
        }
    };
    let (s, c) = angle.sin_cos();
    own.into_iter().map(|[x, z]| [centre[0] + c * x - s * z, centre[1] + s * x + c * z]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a metre under a base that stands at -0.7 m: the floor lies there, in the picture, and the pedestal reaches down to it.
    #[test]
    fn below_a_raised_base_stand_a_pedestal_and_the_floor() {
        let drawn = |raised: f64| {
            let scene = Scene {
                axis: [0.0; 2],
                links: Vec::new(),
                link: 1.0,
                base: Some([-0.3, -0.7]),
                raised,
                zone: None,
                windows: Vec::new(),
                keep_outs: Vec::new(),
                force: None,
            };
            let frame = scene.frame(vec![[0.0; 2], [1.0; 2]], 600.0, 20.0);
            let mut canvas = Canvas::new(600.0, 600.0);
            scene.floor(&mut canvas, &frame);
            let floor = canvas.finish();
            let mut canvas = Canvas::new(600.0, 600.0);
            scene.draw_base(&mut canvas, &frame);
            (frame, floor, canvas.finish())
        };
        let px = |x: f64| ((x * 100.0).round() / 100.0).to_string();
        let (frame, floor, base) = drawn(0.5);
        let [[left, bottom], [right, _]] = frame.corners();
        let y = frame.y.at(-1.2);
        assert!(y < bottom, "inside the picture");
        assert!(floor.contains(&format!("M{} {}L{} {}", px(left), px(y), px(right), px(y))), "{y}: {floor}");
        let height = px(y - frame.y.at(-0.7));
        assert!(base.contains("<rect") && base.contains(&format!("height=\"{height}\"")), "{height}: {base}");
        let (frame, floor, base) = drawn(0.0);
        assert!(floor.contains(&px(frame.y.at(-0.7))) && base.matches("<rect").count() == 1, "the sheet alone: {base}");
    }
}
