//! Where the work must stand, as a shop drawing has it: from the side and, below it, from above, with lengths in mm.

use std::borrow::Cow;

use crate::answer::words::degrees;
use crate::answer::{Base, Dimension, Layout};
use stiffarm::palette::{ARM, BASE, GREY, GROUND, INK, KEEP_OUT, PROSE, ZONE};

use super::FigureSize;
use super::axes::heading;
use super::canvas::{Canvas, Font, Px, path};

/// Left and right of both views, px: on the right stand heights.
const ROOM: [f64; 2] = [64.0, 150.0];
/// From one line of lengths to the next, px.
const STEP: f64 = 26.0;
/// From a view to its first line of lengths, px.
const FIRST: f64 = 30.0;
/// No view is higher, px.
const HIGHEST: f64 = 420.0;
/// What is shown around the foot of the robot, m.
const FOOT: f64 = 0.3;
/// What is kept free is shown so far beside the work, m.
const ASIDE: f64 = 2.5;
/// Of the x axis of a path, px.
const X_AXIS: f64 = 46.0;
/// How thick the plate is on which a robot stands, px.
const PLATE: f64 = 8.0;
/// An axis that is seen shorter than this points at who looks.
const FACING: f64 = 0.2;
/// Shorter lengths stand in the table alone, px.
const SHORTEST: f64 = 3.0;

/// A zone at its place with its lengths.
pub(crate) struct ShopFigure<'a> {
    /// What is drawn.
    pub layout: &'a Layout,
    /// What was asked of the figure.
    pub figure_size: FigureSize,
}

/// From metres to px in both views.
struct Scale {
    per_metre: f64,
    /// What stands at the left, at the bottom of the upper view, and at the bottom of the lower one: m and px.
    left: [f64; 2],
    upper: [f64; 2],
    lower: [f64; 2],
    /// Right end of both views, px.
    right: f64,
}

impl Scale {
    fn side(&self, [x, _, z]: [f64; 3]) -> Px {
        [self.across(x), self.upper[1] - self.per_metre * (z - self.upper[0])]
    }

    fn above(&self, [x, y, _]: [f64; 3]) -> Px {
        [self.across(x), self.lower[1] - self.per_metre * (y - self.lower[0])]
    }

    fn across(&self, x: f64) -> f64 {
        self.left[1] + self.per_metre * (x - self.left[0])
    }
}

impl ShopFigure<'_> {
    /// The figure as SVG text.
    pub(crate) fn svg(&self) -> String {
        let mut canvas = Canvas::of(&self.figure_size);
        let Layout { title, yaw, .. } = self.layout;
        let turned =
            yaw.map_or_else(String::new, |yaw| format!("; x at {}, counterclockwise from above", degrees(yaw)));
        let subtitle = format!("side and top view; lengths in mm from {}{turned}", self.layout.base.origin());
        let top = heading(&mut canvas, title, &subtitle) + 18.0;
        let scale = self.scale(canvas.width, top);
        // From above: y, to the left, upwards.
        canvas.tell_scale([scale.left[1], scale.lower[1]], [scale.left[0], scale.lower[0]], scale.per_metre);
        self.tell_work(&mut canvas, &scale);
        let mut texts = self.draw_kept_free(&mut canvas, &scale, top);
        self.draw_side(&mut canvas, &scale, top);
        self.draw_above(&mut canvas, &scale);
        let of = |axis: usize| self.layout.dimensions.iter().filter(move |one| one.axis == axis).enumerate();
        let from = scale.across(self.layout.extent(0)[1]);
        let column = |i: usize| scale.right + FIRST + 1.6 * STEP * i as f64;
        for (i, one) in of(2) {
            texts.extend(upright(&mut canvas, one, column(i), &|z| scale.side([0.0, 0.0, z])[1], from));
        }
        for (i, one) in of(1) {
            texts.extend(upright(&mut canvas, one, column(i), &|y| scale.above([0.0, y, 0.0])[1], from));
        }
        let below = scale.lower[1];
        for (i, one) in of(0) {
            texts.extend(level(&mut canvas, one, below + FIRST + STEP * i as f64, &|x| scale.across(x), below));
        }
        // Over the lines of all the others.
        for (at, text, font) in texts {
            canvas.text(at, &text, font);
        }
        canvas.height = below + FIRST + STEP * of(0).count() as f64 + 4.0;
        canvas.finish()
    }

    fn scale(&self, width: f64, top: f64) -> Scale {
        let Base { foot, floor, .. } = &self.layout.base;
        let with_origin = |axis: usize| {
            let ([low, high], origin) = (self.layout.extent(axis), self.layout.centre[axis]);
            [low.min(origin), high.max(origin)]
        };
        // What is kept free beside the work is seen whole, and of what goes on beyond only its beginning.
        let with_kept_free = |axis: usize| {
            let [low, high] = with_origin(axis);
            let ends = self.layout.keep_out.iter().flat_map(|block| block[axis]).filter(|end| end.is_finite());
            ends.fold([low, high], |[from, to], end| [from.min(end.max(low - ASIDE)), to.max(end.min(high + ASIDE))])
        };
        let [x, y, z] = [0, 1, 2].map(with_kept_free);
        let across = [x[0].min(foot[0] - FOOT), x[1].max(foot[0] + FOOT)];
        let aside = [y[0].min(foot[1] - FOOT), y[1].max(foot[1] + FOOT)];
        let up = [z[0].min(floor.unwrap_or(foot[2])).min(foot[2]), z[1].max(foot[2] + FOOT)];
        let span = |[low, high]: [f64; 2]| high - low;
        let room = width - ROOM[0] - ROOM[1];
        let per_metre = (room / span(across)).min(HIGHEST / span(up)).min(HIGHEST / span(aside));
        let upper = top + per_metre * span(up);
        let lower = upper + 44.0 + per_metre * span(aside);
        Scale {
            per_metre,
            left: [across[0], ROOM[0]],
            upper: [up[0], upper],
            lower: [aside[0], lower],
            right: ROOM[0] + per_metre * span(across),
        }
    }

    /// Says where the work lies from above, and its origin.
    fn tell_work(&self, canvas: &mut Canvas, scale: &Scale) {
        let [[x0, x1], [y0, y1]] = [0, 1].map(|axis| self.layout.extent(axis));
        canvas.tell_box(
            "work",
            [scale.above([x0, y1, 0.0]), scale.above([x1, y0, 0.0])],
            scale.above(self.layout.centre),
        );
    }

    /// What must be kept free, as far as the views go, and its names.
    fn draw_kept_free(&self, canvas: &mut Canvas, scale: &Scale, top: f64) -> Vec<Text<'static>> {
        let look = format!(r#"fill="{KEEP_OUT}" fill-opacity="0.12" stroke="{KEEP_OUT}" stroke-width="1.2""#);
        let font = Font::new(12.0).colour(PROSE).halo();
        let sides = [scale.left[1] - 14.0, scale.right + 14.0];
        let mut names = Vec::new();
        for (i, [x, y, z]) in self.layout.keep_out.iter().enumerate() {
            let across = x.map(|x| scale.across(x).clamp(sides[0], sides[1]));
            let up = [z[1], z[0]].map(|z| scale.side([0.0, 0.0, z])[1].clamp(top - 6.0, scale.upper[1]));
            let over = [y[1], y[0]].map(|y| scale.above([0.0, y, 0.0])[1].clamp(scale.upper[1] + 30.0, scale.lower[1]));
            for [high, low] in [up, over].into_iter().filter(|[high, low]| high < low && across[0] < across[1]) {
                canvas.rect([across[0], high], [across[1], low], &look);
                names.push(([across[0] + 4.0, high + 10.0], Cow::from(format!("keep-out {}", i + 1)), font));
            }
        }
        names
    }

    /// Floor, foot, axis and zone from the right side of the robot.
    fn draw_side(&self, canvas: &mut Canvas, scale: &Scale, top: f64) {
        let Base { foot, floor, .. } = &self.layout.base;
        let ground = floor.unwrap_or(foot[2]);
        let level = scale.side([0.0, 0.0, ground])[1];
        canvas.rect(
            [ROOM[0] - 14.0, level],
            [scale.right + 14.0, level + 5.0],
            &format!(r#"fill="{GROUND}" fill-opacity="0.45""#),
        );
        canvas.line(
            [ROOM[0] - 14.0, level],
            [scale.right + 14.0, level],
            &format!(r#"stroke="{INK}" stroke-width="1.2""#),
        );
        let name = if floor.is_some() { "floor" } else { "base" };
        canvas.text([ROOM[0] - 18.0, level], name, Font::new(12.0).end().colour(PROSE));
        if let Some(carrier) = self.layout.base.fixed_to {
            let [ahead, _, up] = self.layout.base.axis;
            draw_fixed(canvas, (scale.side(*foot), [ahead, -up]), scale, carrier);
        } else {
            let [x, y] = scale.side(*foot);
            let half = FOOT / 2.0 * scale.per_metre;
            canvas.rect([x - half, y], [x + half, level], &format!(r#"fill="{ARM}" stroke="{GREY}""#));
            canvas.rect([x - half, y - PLATE], [x + half, y], &plate());
            axis(canvas, [x, top - 6.0], [x, level + 10.0]);
        }
        self.draw_work(canvas, |at| scale.side(at));
    }

    /// The zone, also where it is seen as a line, or the cuts of a path.
    fn draw_work(&self, canvas: &mut Canvas, at: impl Fn([f64; 3]) -> Px) {
        let is_closed = self.layout.is_closed;
        let fill = if is_closed { format!(r#"fill="{ZONE}" fill-opacity="0.14""#) } else { r#"fill="none""#.into() };
        let look = format!(r#"{fill} stroke="{ZONE}" stroke-width="2.5" stroke-linejoin="round""#);
        for line in &self.layout.lines {
            let points: Vec<Px> = line.iter().map(|&point| at(point)).collect();
            canvas.path(&path(&points, is_closed), &look);
        }
    }

    /// Foot and zone from above.
    fn draw_above(&self, canvas: &mut Canvas, scale: &Scale) {
        let [x, y] = scale.above(self.layout.base.foot);
        let arm = FOOT * scale.per_metre;
        if let Some(carrier) = self.layout.base.fixed_to.filter(|_| !self.layout.base.is_vertical) {
            let [ahead, left, _] = self.layout.base.axis;
            draw_fixed(canvas, ([x, y], [ahead, -left]), scale, carrier);
        } else {
            canvas.circle([x, y], FOOT / 2.0 * scale.per_metre, &plate());
            axis(canvas, [x - arm, y], [scale.right + 8.0, y]);
            axis(canvas, [x, y - arm], [x, y + arm]);
            let above = y - FOOT / 2.0 * scale.per_metre - 9.0;
            canvas.text([x + 6.0, above], "joint-1 axis", Font::new(12.0).colour(PROSE));
        }
        self.draw_work(canvas, |at| scale.above(at));
        if let Some(yaw) = self.layout.yaw {
            let ([x, y], length, (dy, dx)) = (scale.above(self.layout.centre), X_AXIS, yaw.sin_cos());
            let end = [x + length * dx, y - length * dy];
            canvas.line([x, y], end, &format!(r#"stroke="{INK}" stroke-width="1.6""#));
            canvas.text([end[0] + 9.0 * dx, end[1] - 9.0 * dy], "x", Font::new(12.0).middle().halo());
        }
        let centre = scale.above(self.layout.centre);
        for ends in [[[-5.0, 0.0], [5.0, 0.0]], [[0.0, -5.0], [0.0, 5.0]]] {
            let [from, to] = ends.map(|end: Px| [centre[0] + end[0], centre[1] + end[1]]);
            canvas.line(from, to, &format!(r#"stroke="{INK}" stroke-width="1""#));
        }
    }
}

/// The foot of a robot that does not stand, at a place of a view in which the joint-1 axis points so; round where it points at who looks.
fn draw_fixed(canvas: &mut Canvas, (at, along): (Px, Px), scale: &Scale, carrier: &'static str) {
    let half = FOOT / 2.0 * scale.per_metre;
    let length = along[0].hypot(along[1]);
    if length < FACING {
        canvas.circle(at, half, &plate());
        return;
    }
    let [out, side] = [[along[0] / length, along[1] / length], [-along[1] / length, along[0] / length]];
    let corner = |across: f64, away: f64| [0, 1].map(|i| at[i] + across * side[i] + away * out[i]);
    let behind =
        [corner(-2.0 * half, 0.0), corner(2.0 * half, 0.0), corner(2.0 * half, -5.0), corner(-2.0 * half, -5.0)];
    canvas.path(&path(&behind, true), &format!(r#"fill="{GROUND}" fill-opacity="0.45""#));
    canvas.line(behind[0], behind[1], &format!(r#"stroke="{INK}" stroke-width="1.2""#));
    let foot = [corner(-half, 0.0), corner(half, 0.0), corner(half, PLATE), corner(-half, PLATE)];
    canvas.path(&path(&foot, true), &plate());
    let end = corner(0.0, FOOT * scale.per_metre * length);
    axis(canvas, corner(0.0, -10.0), end);
    let font = Font::new(12.0).colour(PROSE).halo();
    canvas.text([end[0] + 6.0, end[1]], "joint-1 axis", font);
    // Beside the right end, the lower one of a wall.
    let beside = behind[..2].iter().copied().max_by(|a, b| (a[0] + 0.01 * a[1]).total_cmp(&(b[0] + 0.01 * b[1])));
    canvas.text(beside.map_or(at, |[x, y]| [x + 6.0, y]), carrier, font);
}

/// How the plate looks on which a robot stands.
fn plate() -> String {
    format!(r#"fill="{BASE}" stroke="{INK}" stroke-width="0.8""#)
}

/// A dash-dotted line.
fn axis(canvas: &mut Canvas, from: Px, to: Px) {
    canvas.line(from, to, &format!(r#"stroke="{GREY}" stroke-width="1" stroke-dasharray="12 4 2 4""#));
}

/// How lines of lengths are drawn.
fn thin() -> String {
    format!("stroke=\"{INK}\" stroke-width=\"0.8\"")
}

/// A text along a length would lie on the lines at its ends: it stands beyond one of them.
fn is_too_short([a, b]: [f64; 2], text: &str) -> bool {
    (b - a).abs() < Font::new(12.0).width(text) + 2.0
}

/// A text, where it stands, and how it looks.
type Text<'a> = (Px, Cow<'a, str>, Font<'static>);

/// A length along x, at the height `y`; lines lead up to `from`. Its text is still to be drawn.
fn level<'a>(canvas: &mut Canvas, one: &'a Dimension, y: f64, at: &dyn Fn(f64) -> f64, from: f64) -> Option<Text<'a>> {
    let [a, b] = one.ends.map(at);
    if (b - a).abs() < SHORTEST {
        return None;
    }
    for x in [a, b] {
        canvas.line([x, from + 4.0], [x, y + 5.0], &thin());
        canvas.line([x - 4.0, y + 4.0], [x + 4.0, y - 4.0], &thin());
    }
    canvas.line([a, y], [b, y], &thin());
    let font = Font::new(12.0).halo();
    Some(if is_too_short([a, b], &one.text) {
        ([a.max(b) + 9.0, y], Cow::from(&*one.text), font)
    } else {
        ([f64::midpoint(a, b), y - 8.0], Cow::from(&*one.text), font.middle())
    })
}

/// A length upwards, at `x`; lines lead left to `from`. Its text is still to be drawn.
fn upright<'a>(
    canvas: &mut Canvas,
    one: &'a Dimension,
    x: f64,
    at: &dyn Fn(f64) -> f64,
    from: f64,
) -> Option<Text<'a>> {
    let [a, b] = one.ends.map(at);
    if (b - a).abs() < SHORTEST {
        return None;
    }
    for y in [a, b] {
        canvas.line([from + 6.0, y], [x + 5.0, y], &thin());
        canvas.line([x - 4.0, y + 4.0], [x + 4.0, y - 4.0], &thin());
    }
    canvas.line([x, a], [x, b], &thin());
    let font = Font::new(12.0).halo();
    Some(if is_too_short([a, b], &one.text) {
        ([x, a.min(b) - 9.0], Cow::from(&*one.text), font.middle())
    } else {
        ([x - 9.0, f64::midpoint(a, b)], Cow::from(&*one.text), font.middle().turned(-90.0))
    })
}
