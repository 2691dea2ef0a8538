//! Where may a label stand on its line without covering another?

use stiffarm::palette::GREY;

use super::canvas::{Canvas, Font, Px};

/// A line and what is written on it.
pub(crate) struct Labelled {
    pub points: Vec<Px>,
    pub text: String,
}

/// What is taken on the sheet, as discs.
#[derive(Default)]
pub(crate) struct Occupied {
    taken: Vec<(Px, f64)>,
}

/// A possible place of a label.
struct Place {
    at: Px,
    angle: f64,
    discs: Vec<Px>,
    cost: f64,
}

impl Occupied {
    /// Keeps labels off a line by `radius`.
    pub(crate) fn take(&mut self, points: &[Px], radius: f64) {
        for pair in points.windows(2) {
            let length = distance(pair[0], pair[1]).min(4000.0);
            let count = (length / radius.max(1.0)).ceil().max(1.0);
            self.taken.extend((0..=count as usize).map(|i| (between(pair[0], pair[1], i as f64 / count), radius)));
        }
    }

    /// Labels each line once where there is room inside `region`: rather level than steep, rather clear of other lines.
    pub(crate) fn label(&mut self, canvas: &mut Canvas, lines: &[Labelled], font: Font, region: &[Vec<Px>]) {
        for ring in region {
            self.take(ring, 3.0);
        }
        for (number, line) in lines.iter().enumerate() {
            let others = lines.iter().enumerate().filter(|(i, _)| *i != number);
            let others: Vec<Px> = others.flat_map(|(_, line)| spaced(&line.points, 4.0)).collect();
            let is_free =
                |place: &Place| place.discs.iter().all(|&disc| self.is_free(disc, font.size) && holds(region, disc));
            let crowded = |place: &Place| {
                let clearance = others.iter().map(|&p| squared(p, place.at)).fold(f64::INFINITY, f64::min).sqrt();
                2.0 * (1.0 - clearance / (1.5 * font.size)).max(0.0)
            };
            // The check for room takes longest: only places that would be better than the best one so far are checked.
            let mut places = places(&line.points, font.width(&line.text), font.size);
            places.sort_by(|a, b| a.cost.total_cmp(&b.cost));
            let mut best: Option<(f64, Place)> = None;
            for place in places {
                let least = best.as_ref().map_or(f64::INFINITY, |(cost, _)| *cost);
                if least <= place.cost {
                    break;
                }
                let cost = place.cost + crowded(&place);
                if cost < least && is_free(&place) {
                    best = Some((cost, place));
                }
            }
            let Some((_, best)) = best else { continue };
            canvas.text(best.at, &line.text, font.middle().turned(best.angle).halo());
            self.taken.extend(best.discs.iter().map(|&disc| (disc, 0.7 * font.size)));
        }
    }

    /// Writes a text as near to a point as there is room inside `region`, with a thin line to it where it stands apart.
    pub(crate) fn beside(&mut self, canvas: &mut Canvas, at: Px, text: &str, font: Font, region: &[Vec<Px>]) {
        const DIRECTIONS: u32 = 16;
        let around = (2..=14).flat_map(|ring| {
            let radius = 0.5 * font.size * f64::from(ring);
            (0..DIRECTIONS).map(move |i| {
                // To the right first, then alternately up and down.
                let turn = f64::from(i.div_ceil(2)) * if i % 2 == 0 { 1.0 } else { -1.0 };
                let (s, c) = (turn / f64::from(DIRECTIONS) * std::f64::consts::TAU).sin_cos();
                (radius, [at[0] + radius * c, at[1] + radius * s])
            })
        });
        let mut free = around.filter(|(_, spot)| self.is_free(*spot, font.size) && holds(region, *spot));
        let Some((radius, spot)) = free.next() else { return };
        if 1.2 * font.size < radius {
            let share = 1.0 - 0.55 * font.size / radius;
            canvas.line(at, between(at, spot, share), &format!(r#"stroke="{GREY}" stroke-width="0.8""#));
        }
        canvas.text(spot, text, font.middle().halo());
        self.taken.push((spot, 0.6 * font.size));
    }

    fn is_free(&self, at: Px, size: f64) -> bool {
        self.taken.iter().all(|&(taken, radius)| (radius + 0.7 * size).powi(2) < squared(taken, at))
    }
}

/// Places along a line where it is straight enough for a text `width` px wide.
fn places(points: &[Px], width: f64, size: f64) -> Vec<Place> {
    let mut lengths = vec![0.0];
    for pair in points.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + distance(pair[0], pair[1]));
    }
    let total = lengths[lengths.len() - 1];
    let at = |s: f64| {
        let i = lengths.partition_point(|&length| length <= s).clamp(1, points.len() - 1);
        let piece = lengths[i] - lengths[i - 1];
        between(points[i - 1], points[i], if piece == 0.0 { 0.0 } else { (s - lengths[i - 1]) / piece })
    };
    let half = width / 2.0 + 2.0;
    let room = total - 2.0 * half;
    if points.len() < 2 || !(0.5 * width < room && total < 1e5) {
        return Vec::new();
    }
    let count = (room / 5.0).ceil() as usize;
    let place = |i: usize| {
        let s = half + room * i as f64 / count as f64;
        let (from, to, middle) = (at(s - half), at(s + half), at(s));
        let bend = distance(middle, between(from, to, 0.5));
        let straight = bend < 0.35 * size && 1.8 * half < distance(from, to);
        let mut angle = (to[1] - from[1]).atan2(to[0] - from[0]).to_degrees();
        if angle <= -90.0 || 90.0 < angle {
            angle -= 180.0 * angle.signum();
        }
        // Along a cliff of the field a line takes the stairs of the grid; the chord is then much shorter.
        let ragged = 10.0 * (1.0 - distance(from, to) / (2.0 * half));
        let discs = (0..=4).map(|k| between(from, to, f64::from(k) / 4.0)).collect();
        straight.then(|| Place {
            at: between(middle, between(from, to, 0.5), 0.5),
            angle,
            discs,
            cost: angle.abs() / 90.0 + bend / size + ragged,
        })
    };
    (0..=count).filter_map(place).collect()
}

/// Does a set of rings hold a point (a ring within a ring is a hole)?
fn holds(rings: &[Vec<Px>], [x, y]: Px) -> bool {
    let crosses = |pair: &&[Px]| {
        let (a, b) = (pair[0], pair[1]);
        (a[1] <= y) != (b[1] <= y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    rings.iter().flat_map(|ring| ring.windows(2)).filter(crosses).count() % 2 == 1
}

/// Points of a line, `gap` px or more apart.
fn spaced(points: &[Px], gap: f64) -> Vec<Px> {
    let mut kept: Vec<Px> = Vec::new();
    for &point in points {
        if kept.last().is_none_or(|&last| gap <= distance(last, point)) {
            kept.push(point);
        }
    }
    kept
}

fn between(a: Px, b: Px, share: f64) -> Px {
    [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
}

/// The square of the distance: of thousands of pairs roots take most of the time.
fn squared(a: Px, b: Px) -> f64 {
    (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)
}

fn distance(a: Px, b: Px) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_label_covers_another_or_leaves_the_region() {
        let region = [vec![[0.0, 0.0], [200.0, 0.0], [200.0, 200.0], [0.0, 200.0], [0.0, 0.0]]];
        let line = |y: f64| Labelled { points: vec![[-100.0, y], [300.0, y + 20.0]], text: "1.25".into() };
        let lines: Vec<Labelled> = (0..40).map(|i| line(f64::from(i) * 5.0)).collect();
        let (mut occupied, mut canvas) = (Occupied::default(), Canvas::new(200.0, 200.0));
        occupied.take(&[[0.0, 100.0], [200.0, 100.0]], 10.0);
        occupied.label(&mut canvas, &lines, Font::new(12.0), &region);
        let discs: Vec<Px> =
            occupied.taken.iter().filter(|(_, radius)| *radius == 0.7 * 12.0).map(|(at, _)| *at).collect();
        let labels: Vec<&[Px]> = discs.chunks(5).collect();
        assert!(10 < labels.len());
        for (i, label) in labels.iter().enumerate() {
            assert!(label.iter().all(|p| holds(&region, *p) && 10.0 < (p[1] - 100.0).abs()));
            for other in &labels[..i] {
                assert!(label.iter().all(|p| other.iter().all(|q| 12.0 < distance(*p, *q))));
            }
        }
    }

    /// Against every place of every line, each checked for room.
    #[test]
    fn a_label_stands_at_the_free_place_of_the_least_cost() {
        let font = Font::new(12.0);
        let region = [vec![[0.0, 0.0], [300.0, 0.0], [300.0, 200.0], [150.0, 120.0], [0.0, 200.0], [0.0, 0.0]]];
        let wave = |phase: f64| {
            let point = |i: u32| [f64::from(i) * 3.0, 100.0 + 60.0 * (f64::from(i) / 12.0 + phase).sin()];
            Labelled { points: (0..=100).map(point).collect(), text: "0.5".into() }
        };
        let lines: Vec<Labelled> = (0..7).map(|i| wave(f64::from(i) * 0.6)).collect();
        let mut occupied = Occupied::default();
        occupied.label(&mut Canvas::new(300.0, 200.0), &lines, font, &region);
        let is_of_label = |(_, radius): &&(Px, f64)| *radius == 0.7 * font.size;
        let labels: Vec<Px> = occupied.taken.iter().filter(is_of_label).map(|(at, _)| *at).collect();
        let mut labels = labels.chunks(5);

        let mut before = Occupied::default();
        before.take(&region[0], 3.0);
        let (mut written, mut kept_from_the_cheapest) = (0, 0);
        for (number, line) in lines.iter().enumerate() {
            let others = lines.iter().enumerate().filter(|(i, _)| *i != number);
            let others: Vec<Px> = others.flat_map(|(_, line)| spaced(&line.points, 4.0)).collect();
            let all = places(&line.points, font.width(&line.text), font.size).into_iter().map(|place| {
                let clearance = others.iter().map(|&p| distance(p, place.at)).fold(f64::INFINITY, f64::min);
                let has_room = place.discs.iter().all(|&disc| before.is_free(disc, font.size) && holds(&region, disc));
                (place.cost + 2.0 * (1.0 - clearance / (1.5 * font.size)).max(0.0), has_room, place)
            });
            let all: Vec<(f64, bool, Place)> = all.collect();
            let by_cost = |a: &&(f64, bool, Place), b: &&(f64, bool, Place)| a.0.total_cmp(&b.0);
            let Some((_, _, best)) = all.iter().filter(|(_, has_room, _)| *has_room).min_by(by_cost) else { continue };
            assert_eq!(labels.next(), Some(&best.discs[..]), "line {number}");
            before.taken.extend(best.discs.iter().map(|&disc| (disc, 0.7 * font.size)));
            written += 1;
            kept_from_the_cheapest += usize::from(all.iter().min_by(by_cost).is_some_and(|least| !least.1));
        }
        assert!(
            labels.next().is_none() && 3 < written && 0 < kept_from_the_cheapest,
            "{written} {kept_from_the_cheapest}"
        );
    }

    #[test]
    fn lines_without_length_or_place_get_no_label() {
        let region = [vec![[0.0, 0.0], [200.0, 0.0], [200.0, 200.0], [0.0, 0.0]]];
        let line = |points: &[Px]| Labelled { points: points.to_vec(), text: "1".into() };
        let lines = [line(&[]), line(&[[5.0, 5.0]]), line(&[[5.0, 5.0]; 3]), line(&[[f64::NAN, 0.0], [1.0, 1.0]])];
        let mut occupied = Occupied::default();
        occupied.label(&mut Canvas::new(9.0, 9.0), &lines, Font::new(12.0), &region);
        assert!(occupied.taken.iter().all(|(_, radius)| *radius == 3.0));
    }
}
