//! The sheet on which a figure is drawn: SVG text, px, y down.

use std::fmt::Write;

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};
use stiffarm::palette::{INK, PAPER};

use super::FigureSize;
use super::fonts::{self, FONT};
use crate::markup::escaped;

/// A point on the sheet, px.
pub(crate) type Px = [f64; 2];

/// Where a text is held.
#[derive(Clone, Copy)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text looks.
#[derive(Clone, Copy)]
pub(crate) struct Font<'a> {
    pub size: f64,
    pub bold: bool,
    pub colour: &'a str,
    pub anchor: Anchor,
    /// Degrees, clockwise.
    pub angle: f64,
    /// A white rim keeps it legible on any ground.
    pub halo: bool,
}

impl<'a> Font<'a> {
    pub(crate) const fn new(size: f64) -> Self {
        Self { size, bold: false, colour: INK, anchor: Anchor::Start, angle: 0.0, halo: false }
    }

    pub(crate) const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(crate) const fn middle(self) -> Self {
        Self { anchor: Anchor::Middle, ..self }
    }

    pub(crate) const fn end(self) -> Self {
        Self { anchor: Anchor::End, ..self }
    }

    pub(crate) const fn colour(self, colour: &'a str) -> Self {
        Self { colour, ..self }
    }

    pub(crate) const fn turned(self, angle: f64) -> Self {
        Self { angle, ..self }
    }

    pub(crate) const fn halo(self) -> Self {
        Self { halo: true, ..self }
    }

    /// Width of a text, px, in the font that comes with the program.
    pub(crate) fn width(&self, text: &str) -> f64 {
        let advance = self.advance();
        text.chars().map(advance).sum()
    }

    /// How far each letter moves the next one, px.
    fn advance(&self) -> impl Fn(char) -> f64 {
        let data = if self.bold { fonts::bold() } else { fonts::plain() };
        let size = self.size;
        let measures = FontRef::from_index(data, 0)
            .ok()
            .map(|font| (font.charmap(), font.glyph_metrics(Size::new(size as f32), LocationRef::default())));
        move |c| match &measures {
            Some((glyphs, advances)) => {
                f64::from(advances.advance_width(glyphs.map(c).unwrap_or_default()).unwrap_or_default())
            }
            None => 0.6 * size,
        }
    }

    /// The text, cut with an ellipsis where it is wider than `room` px.
    pub(crate) fn cut(&self, text: &str, room: f64) -> String {
        let advance = self.advance();
        let (mut width, mut kept) = (0.0, 0);
        for (at, c) in text.char_indices() {
            if width + advance('…') <= room {
                kept = at;
            }
            width += advance(c);
            if room < width {
                return text[..kept].trim_end().to_owned() + "…";
            }
        }
        text.into()
    }

    /// The text in at most `most` lines of `room` px each; the last is cut.
    pub(crate) fn wrapped(&self, text: &str, room: f64, most: usize) -> Vec<String> {
        let advance = self.advance();
        let after = |width: f64, text: &str| text.chars().fold(width, |width, c| width + advance(c));
        let mut lines: Vec<String> = Vec::new();
        let mut width = 0.0;
        for word in text.split_whitespace() {
            let (joined, full) = (after(after(width, " "), word), most <= lines.len());
            match lines.last_mut() {
                Some(line) if full || joined <= room => {
                    line.push(' ');
                    line.push_str(word);
                    width = joined;
                }
                _ => {
                    lines.push(word.into());
                    width = after(0.0, word);
                }
            }
        }
        lines.into_iter().map(|line| self.cut(&line, room)).collect()
    }
}

/// A figure in the making.
pub(crate) struct Canvas {
    pub width: f64,
    pub height: f64,
    /// Its width on paper.
    mm: Option<f64>,
    /// Attributes of the whole, for programs.
    data: String,
    body: String,
    clips: usize,
}

impl Canvas {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        Self { width, height, mm: None, data: String::new(), body: String::new(), clips: 0 }
    }

    /// A sheet as it was asked for; its height is to come.
    pub(crate) fn of(figure_size: &FigureSize) -> Self {
        Self { mm: figure_size.width_mm, ..Self::new(figure_size.width(), 0.0) }
    }

    /// Says how px of the viewBox map to metres, for what draws over the figure: `x = x0_m + (px - x0_px) / px_per_m`, and z likewise,
    /// upwards.
    pub(crate) fn tell_scale(&mut self, [x0_px, z0_px]: Px, [x0_m, z0_m]: [f64; 2], px_per_m: f64) {
        let _ = write!(
            self.data,
            " data-x0-px=\"{x0_px}\" data-x0-m=\"{x0_m}\" data-z0-px=\"{z0_px}\" data-z0-m=\"{z0_m}\" data-px-per-m=\"{px_per_m}\""
        );
    }

    /// Says where something stands, for what draws over the figure: its left, top, right and bottom, px, and two numbers more.
    pub(crate) fn tell_box(&mut self, name: &str, [[left, top], [right, bottom]]: [Px; 2], [from, to]: [f64; 2]) {
        let _ = write!(self.data, " data-{name}=\"{left} {top} {right} {bottom} {from} {to}\"");
    }

    /// Straight lines through `points`; `look` are SVG attributes.
    pub(crate) fn polyline(&mut self, points: &[Px], look: &str) {
        if 1 < points.len() {
            self.path(&path(points, false), look);
        }
    }

    /// One line.
    pub(crate) fn line(&mut self, from: Px, to: Px, look: &str) {
        self.polyline(&[from, to], look);
    }

    /// An SVG path; holes count (`evenodd`).
    pub(crate) fn path(&mut self, d: &str, look: &str) {
        if !d.is_empty() {
            let _ = writeln!(self.body, r#"<path d="{d}" fill-rule="evenodd" {look}/>"#);
        }
    }

    /// An upright rectangle between two corners.
    pub(crate) fn rect(&mut self, [x0, y0]: Px, [x1, y1]: Px, look: &str) {
        let (left, top) = (number(x0.min(x1)), number(y0.min(y1)));
        let (width, height) = (number((x1 - x0).abs()), number((y1 - y0).abs()));
        let _ = writeln!(self.body, r#"<rect x="{left}" y="{top}" width="{width}" height="{height}" {look}/>"#);
    }

    /// A tip that says that what ends here goes on: from the middle of its foot so far, and half as wide as its foot.
    pub(crate) fn goes_on(&mut self, [x, y]: Px, [right, down]: Px, half: f64, colour: &str) {
        let length = right.hypot(down);
        let (across, along) = (half * down / length, half * right / length);
        let tip = path(&[[x + right, y + down], [x - across, y + along], [x + across, y - along]], true);
        self.path(&tip, &format!(r#"fill="{colour}""#));
    }

    /// A circle.
    pub(crate) fn circle(&mut self, [x, y]: Px, radius: f64, look: &str) {
        let _ = writeln!(self.body, r#"<circle cx="{}" cy="{}" r="{}" {look}/>"#, number(x), number(y), number(radius));
    }

    /// A text whose middle stands at the height of `at`. Any characters will do.
    pub(crate) fn text(&mut self, at: Px, text: &str, font: Font) {
        let anchor = match font.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let weight = if font.bold { r#" font-weight="bold""# } else { "" };
        let rim = if font.halo {
            format!(
                r#" stroke="{PAPER}" stroke-width="3" stroke-opacity="0.85" stroke-linejoin="round" paint-order="stroke""#
            )
        } else {
            String::new()
        };
        let (x, y, size, colour) = (number(at[0]), number(at[1]), number(font.size), font.colour);
        let place = if font.angle == 0.0 {
            format!(r#"x="{x}" y="{}""#, number(at[1] + 0.36 * font.size))
        } else {
            format!(r#"y="{}" transform="translate({x} {y}) rotate({})""#, number(0.36 * font.size), number(font.angle))
        };
        let text = escaped(text);
        let _ = writeln!(
            self.body,
            r#"<text {place} font-size="{size}" text-anchor="{anchor}" fill="{colour}"{weight}{rim}>{text}</text>"#
        );
    }

    /// Draws what `draw` draws, but only inside the path `d`.
    pub(crate) fn clipped(&mut self, d: &str, draw: impl FnOnce(&mut Self)) {
        self.clips += 1;
        let id = self.clips;
        let _ = writeln!(
            self.body,
            r#"<clipPath id="clip{id}"><path d="{d}" clip-rule="evenodd"/></clipPath><g clip-path="url(#clip{id})">"#
        );
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// Draws what `draw` draws, and says `text` of it where a pointer rests on it.
    pub(crate) fn with_tooltip(&mut self, text: &str, draw: impl FnOnce(&mut Self)) {
        let _ = writeln!(self.body, "<g><title>{}</title>", escaped(text));
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// Draws what `draw` draws, so many px further to the right.
    pub(crate) fn shifted(&mut self, right: f64, draw: impl FnOnce(&mut Self)) {
        let _ = writeln!(self.body, r#"<g transform="translate({} 0)">"#, number(right));
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// The SVG text.
    pub(crate) fn finish(self) -> String {
        let [width, height] = [self.width, self.height].map(number);
        let on_paper =
            |px: f64| self.mm.map_or_else(|| number(px).to_string(), |mm| format!("{:.3}mm", px * mm / self.width));
        let [across, down] = [self.width, self.height].map(on_paper);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{across}\" height=\"{down}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FONT}, Helvetica, Arial, sans-serif\"{}>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{PAPER}\"/>\n{}</svg>\n",
            self.data, self.body
        )
    }
}

/// An SVG path through `points`; points less than a tenth of a pixel off the line are left out.
pub(crate) fn path(points: &[Px], closed: bool) -> String {
    let mut d = String::new();
    for (i, [x, y]) in simplified(points, 0.05).into_iter().enumerate() {
        let _ = write!(d, "{}{} {}", if i == 0 { "M" } else { "L" }, number(x), number(y));
    }
    if closed && !d.is_empty() {
        d.push('Z');
    }
    d
}

/// The path of an upright rectangle.
pub(crate) fn rect_path([x0, y0]: Px, [x1, y1]: Px) -> String {
    path(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], true)
}

/// Douglas and Peucker's thinning: no point left out is more than `most` away from the line.
fn simplified(points: &[Px], most: f64) -> Vec<Px> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut kept = vec![false; points.len()];
    (kept[0], kept[last]) = (true, true);
    let mut open = vec![(0, last)];
    while let Some((a, b)) = open.pop() {
        let off = |i: usize| (i, distance_to_segment(points[i], points[a], points[b]));
        let farthest = (a + 1..b).map(off).max_by(|x, y| x.1.total_cmp(&y.1));
        if let Some((middle, off)) = farthest
            && most < off
        {
            kept[middle] = true;
            open.extend([(a, middle), (middle, b)]);
        }
    }
    points.iter().zip(kept).filter_map(|(&point, kept)| kept.then_some(point)).collect()
}

fn distance_to_segment(p: Px, a: Px, b: Px) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = along[0] * along[0] + along[1] * along[1];
    let share = if square == 0.0 { 0.0 } else { ((to[0] * along[0] + to[1] * along[1]) / square).clamp(0.0, 1.0) };
    (to[0] - share * along[0]).hypot(to[1] - share * along[1])
}

/// A coordinate, to a hundredth of a pixel.
fn number(x: f64) -> f64 {
    let x = if x.is_nan() { 0.0 } else { x.clamp(-1e5, 1e5) };
    (x * 100.0).round() / 100.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_makes_a_valid_figure() {
        let mut canvas = Canvas::new(100.0, 50.0);
        canvas.text(
            [f64::NAN, f64::INFINITY],
            "a<b & \"c\" 'd' \u{1}\u{ffff}\0 ]]>",
            Font::new(12.0).halo().turned(30.0),
        );
        let svg = canvas.finish();
        assert!(svg.contains("a&lt;b &amp; &quot;c&quot;"), "{svg}");
        assert!(super::super::is_svg(&svg));
    }

    #[test]
    fn a_text_that_is_too_wide_is_cut_to_its_room() {
        let font = Font::new(12.0);
        let long = "a very long name ".repeat(20);
        assert_eq!(font.cut("short", 100.0), "short");
        let cut = font.cut(&long, 100.0);
        assert!(cut.ends_with('…') && font.width(&cut) <= 100.0);
        // The longest start that fits, found by trying all of them.
        let fitting = |end: &usize| font.width(&format!("{}…", &long[..*end])) <= 100.0;
        let longest = (0..long.len()).rev().find(fitting).unwrap();
        assert_eq!(cut, format!("{}…", long[..longest].trim_end()));
        let lines = font.wrapped(&long, 150.0, 2);
        assert!(lines.len() == 2 && lines.iter().all(|line| font.width(line) <= 150.0), "{lines:?}");
        assert!(font.wrapped("", 10.0, 2).is_empty());
    }

    /// Linear: a megabyte of letters would take hours otherwise.
    #[test]
    fn a_text_of_a_million_letters_is_cut_and_wrapped_at_once() {
        let font = Font::new(12.0).bold();
        let long = "W".repeat(1_000_000);
        assert!(font.cut(&long, 8e6).len() < 1_000_000);
        assert_eq!(font.wrapped(&"W ".repeat(500_000), 150.0, 2).len(), 2);
    }

    #[test]
    fn thinning_keeps_corners_and_drops_points_on_the_way() {
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.01], [3.0, 0.0], [3.0, 5.0]];
        assert_eq!(simplified(&points, 0.05), [[0.0, 0.0], [3.0, 0.0], [3.0, 5.0]]);
        assert!(simplified(&[], 0.05).is_empty());
    }
}
