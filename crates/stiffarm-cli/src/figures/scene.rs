//! What stands in the arm plane: floor, base, arm and zone, and their legend.

use std::f64::consts::TAU;

use stiffarm::plane::PlanarArm;
use stiffarm::task::Zone;

use super::axes::{Axis, Frame};
use super::canvas::{Canvas, Px, path};
use super::legend::Entry;
use super::map::ZoneMark;
use super::{ALARM, INK, marks};

const LINK: &str = "#ececec";
const HALO: &str = r#"fill="none" stroke="white" stroke-opacity="0.9" stroke-width="5" stroke-linejoin="round""#;
const CROSS: &str = r#"stroke-linecap="round" fill="none""#;

/// What is drawn over a map or a reached set.
pub(super) struct Scene<'a> {
    pub arm: &'a PlanarArm,
    /// Shoulder and elbow angle, rad, in which the arm is drawn.
    pub posture: Option<(f64, f64)>,
    /// The joint-2 axis from the base, m.
    pub base: Option<[f64; 2]>,
    pub zone: Option<&'a ZoneMark>,
}

impl Scene<'_> {
    /// A frame below `top` px with equal scales on both axes, around `shown` (m) and everything of the scene.
    pub(super) fn frame(&self, mut shown: Vec<[f64; 2]>, top: f64) -> Frame {
        let room = 0.12 * (self.arm.l2 + self.arm.l3);
        shown.extend(
            self.joints().into_iter().flatten().flat_map(|[x, z]| [[x - room, z - room], [x + room, z + room]]),
        );
        if let Some([x, z]) = self.standing() {
            let size = self.base_size();
            shown.extend([[-x - 0.45 * size, -z - 0.15 * size], [-x + 0.45 * size, room]]);
        }
        shown.extend(self.zone.into_iter().flat_map(outline));
        shown.retain(|point| point.iter().all(|x| x.is_finite()));
        let ends = |k: usize| {
            let values = shown.iter().map(|point| point[k]);
            let axis = Axis::new(
                values.clone().fold(f64::INFINITY, f64::min),
                values.fold(f64::NEG_INFINITY, f64::max),
                [0.0; 2],
            );
            (axis.from, axis.to)
        };
        let (x, z) = (ends(0), ends(1));
        let scale = (750.0 / (x.1 - x.0)).min(780.0 / (z.1 - z.0));
        // A sliver of a map still gets a frame in which axis titles have room.
        let widened = |(from, to): (f64, f64)| {
            let missing = (300.0 / scale - (to - from)).max(0.0) / 2.0;
            (from - missing, to + missing)
        };
        let (x, z) = (widened(x), widened(z));
        let (width, height) = (scale * (x.1 - x.0), scale * (z.1 - z.0));
        let left = 85.0 + (750.0 - width) / 2.0;
        Frame { x: Axis::new(x.0, x.1, [left, left + width]), y: Axis::new(z.0, z.1, [top + height, top]) }
    }

    /// Joint-2 axis, elbow and wrist centre, m.
    pub(super) fn joints(&self) -> Option<[[f64; 2]; 3]> {
        let (shoulder, elbow) = self.posture?;
        let wrist = self.arm.forward(shoulder, elbow);
        Some([[0.0; 2], [self.arm.l2 * shoulder.cos(), self.arm.l2 * shoulder.sin()], [wrist[0], wrist[1]]])
    }

    /// The joint-2 axis from the base, where it stands above one.
    pub(super) fn standing(&self) -> Option<[f64; 2]> {
        self.base.filter(|[x, z]| x.is_finite() && 0.05 < *z && z.is_finite())
    }

    /// A small arm stands on a small base; 1 for the heavy ones.
    fn base_size(&self) -> f64 {
        f64::midpoint(self.arm.l2, self.arm.l3).clamp(0.1, 1.0)
    }

    /// What labels keep clear of.
    pub(super) fn covered(&self, frame: &Frame) -> Vec<Vec<Px>> {
        let placed = |points: &[[f64; 2]]| points.iter().map(|[x, z]| frame.at(*x, *z)).collect::<Vec<_>>();
        let [[left, bottom], [right, top]] = frame.corners();
        let mut lines = vec![vec![[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]]];
        lines.extend(self.joints().map(|joints| placed(&joints)));
        lines.extend(self.standing().map(|[x, z]| placed(&[[-x, -z], [-x, 0.0], [0.0, 0.0]])));
        if let Some(mark) = self.zone {
            lines.push(placed(&outline(mark)));
            lines.push(placed(&[mark.worst_point; 2]));
        }
        lines
    }

    pub(super) fn floor(&self, canvas: &mut Canvas, frame: &Frame) {
        let Some([_, height]) = self.standing() else { return };
        let [[left, bottom], [right, _]] = frame.corners();
        let y = frame.y.at(-height);
        for i in 0..=((right - left) / 12.0) as usize {
            let x = left + 12.0 * i as f64;
            canvas.line([x, y + 9.0], [x + 9.0, y], r##"stroke="#999999" stroke-width="0.8""##);
        }
        if y < bottom {
            canvas.line([left, y], [right, y], &format!(r#"stroke="{INK}" stroke-width="1.5""#));
        }
    }

    /// A foot, and a column that leans from the joint-1 axis to the joint-2 axis; half transparent, as the map goes on behind.
    pub(super) fn draw_base(&self, canvas: &mut Canvas, frame: &Frame) {
        let Some([x, z]) = self.standing() else { return };
        let foot = (0.12 * z.abs()).min(0.1);
        let [half, waist, head] = [0.4, 0.28, 0.1].map(|width| width * self.base_size());
        let points = [
            [-x - half, -z],
            [-x + half, -z],
            [-x + half, -z + foot],
            [-x + waist, -z + foot],
            [1.2 * head, -0.5 * head],
            [head, head],
            [-head, head],
            [-x - waist, -z + foot],
            [-x - half, -z + foot],
        ];
        let placed = points.map(|[x, z]| frame.at(x, z));
        let look =
            format!(r##"fill="#b8b8b8" fill-opacity="0.7" stroke="{INK}" stroke-width="1.2" stroke-linejoin="round""##);
        canvas.path(&path(&placed, true), &look);
    }

    pub(super) fn draw_zone(&self, canvas: &mut Canvas, frame: &Frame) {
        let Some(mark) = self.zone else { return };
        let points: Vec<Px> = outline(mark).into_iter().map(|[x, z]| frame.at(x, z)).collect();
        let d = path(&points, true);
        canvas.path(&d, HALO);
        canvas.path(&d, &format!(r#"fill="none" stroke="{ALARM}" stroke-width="2.5" stroke-linejoin="round""#));
    }

    pub(super) fn draw_arm(&self, canvas: &mut Canvas, frame: &Frame) {
        if let Some(joints) = self.joints() {
            let joints = joints.map(|[x, z]| frame.at(x, z));
            for (from, to, width) in [(joints[1], joints[2], 11.0), (joints[0], joints[1], 15.0)] {
                for (colour, width) in [(INK, width), (LINK, width - 3.0)] {
                    canvas.line(
                        from,
                        to,
                        &format!(r#"stroke="{colour}" stroke-width="{width}" stroke-linecap="round""#),
                    );
                }
            }
            for (joint, radius) in [(joints[1], 5.0), (joints[2], 4.0)] {
                canvas.circle(joint, radius, &format!(r#"fill="white" stroke="{INK}" stroke-width="2""#));
            }
        }
        let axis = frame.at(0.0, 0.0);
        canvas.circle(axis, 6.0, &format!(r#"fill="white" stroke="{INK}" stroke-width="2""#));
        canvas.circle(axis, 2.0, &format!(r#"fill="{INK}""#));
    }

    pub(super) fn draw_worst_point(&self, canvas: &mut Canvas, frame: &Frame) {
        if let Some(mark) = self.zone {
            worst_mark(canvas, frame.at(mark.worst_point[0], mark.worst_point[1]));
        }
    }

    pub(super) fn entries(&self) -> Vec<Entry> {
        let mut entries = Vec::new();
        if let Some(mark) = self.zone {
            let zone = mark.zone;
            entries.push(Entry::new(mark.label.clone(), move |canvas, [x, y]| {
                let look = format!(r#"fill="none" stroke="{ALARM}" stroke-width="2.5""#);
                match zone {
                    Zone::Circle { .. } => canvas.circle([x, y], 7.5, &look),
                    Zone::Rectangle { .. } => canvas.rect([x - 12.0, y - 6.0], [x + 12.0, y + 6.0], &look),
                }
            }));
            entries.push(Entry::new("worst point of the zone", worst_mark));
        }
        if self.posture.is_some() {
            entries.push(Entry::new("upper arm and forearm", |canvas, [x, y]| {
                for (colour, width) in [(INK, 11.0), (LINK, 8.0)] {
                    let look = format!(r#"stroke="{colour}" stroke-width="{width}" stroke-linecap="round""#);
                    canvas.line([x - 12.0, y], [x + 12.0, y], &look);
                }
            }));
        }
        entries.push(Entry::new("joint-2 axis", |canvas, at| {
            canvas.circle(at, 6.0, &format!(r#"fill="white" stroke="{INK}" stroke-width="2""#));
            canvas.circle(at, 2.0, &format!(r#"fill="{INK}""#));
        }));
        entries
    }
}

fn worst_mark(canvas: &mut Canvas, at: Px) {
    marks::cross(canvas, at, 6.5, &format!(r#"{CROSS} stroke="white" stroke-width="7""#));
    marks::cross(canvas, at, 6.5, &format!(r#"{CROSS} stroke="{INK}" stroke-width="3.2""#));
}

/// The rim of a zone as a closed line, m.
pub(crate) fn outline(mark: &ZoneMark) -> Vec<[f64; 2]> {
    let own: Vec<[f64; 2]> = match mark.zone {
        Zone::Circle { diameter } => (0..=72)
            .map(|i| (TAU * f64::from(i) / 72.0).sin_cos())
            .map(|(s, c)| [diameter / 2.0 * c, diameter / 2.0 * s])
            .collect(),
        Zone::Rectangle { width, height } => [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)]
            .map(|(x, z)| [x * width / 2.0, z * height / 2.0])
            .to_vec(),
    };
    let (s, c) = mark.angle.sin_cos();
    own.into_iter().map(|[x, z]| [mark.centre[0] + c * x - s * z, mark.centre[1] + s * x + c * z]).collect()
}
