//! The pages of a printed report while they are filled: what stands where, in points from the left top of A4.

use super::face::{Cut, Face, Faces};

/// A4, points.
pub(super) const PAGE: [f32; 2] = [595.28, 841.89];
/// Left and right; top and bottom, where the footer stands, points.
pub(super) const LEFT: f32 = 51.0;
pub(super) const RIGHT: f32 = PAGE[0] - LEFT;
pub(super) const TOP: f32 = 48.0;
pub(super) const BOTTOM: f32 = PAGE[1] - 60.0;
/// So much stands between them.
pub(super) const WIDTH: f32 = RIGHT - LEFT;
/// So high is an empty page.
pub(super) const HEIGHT: f32 = BOTTOM - TOP;
/// From line to line, in parts of the size of the letters.
pub(super) const LEADING: f32 = 1.36;

/// Red, green, blue.
pub(super) type Colour = [u8; 3];
pub(super) const INK: Colour = [0x1a; 3];
pub(super) const PROSE: Colour = [0x2d; 3];
pub(super) const GREY: Colour = [0x66; 3];
pub(super) const FAINT: Colour = [0xcc; 3];
pub(super) const SHADE: Colour = [0xf4, 0xf5, 0xf6];
pub(super) const GOOD: Colour = [0x0a, 0x6b, 0x34];
pub(super) const BAD: Colour = [0xb0, 0x00, 0x18];
pub(super) const OPEN: Colour = [0x7a, 0x52, 0x00];
pub(super) const PLAIN: Colour = [0x26, 0x47, 0x6b];

/// How a text looks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    pub cut: Cut,
    /// Points.
    pub size: f32,
    pub colour: Colour,
}

impl Style {
    pub(super) const fn new(cut: Cut, size: f32, colour: Colour) -> Self {
        Self { cut, size, colour }
    }

    /// From line to line, points.
    pub(super) fn leading(self) -> f32 {
        LEADING * self.size
    }
}

/// What is drawn.
#[derive(Clone, Debug)]
pub(super) enum Mark {
    /// A line of text, its left end on the base line.
    Text { at: [f32; 2], text: String, style: Style },
    /// A filled rectangle: left top, width and height.
    Box { at: [f32; 2], size: [f32; 2], colour: Colour },
    /// A picture of the report, by its number: left top and its scale.
    Figure { at: [f32; 2], number: usize, scale: f32 },
}

/// Pages, of which the last one is filled.
pub(super) struct Page<'a> {
    pub faces: &'a Faces,
    pub pages: Vec<Vec<Mark>>,
    /// How far down the last page is filled.
    pub y: f32,
    /// Headings with their pages and heights.
    pub headings: Vec<(String, usize, f32)>,
}

impl<'a> Page<'a> {
    pub(super) fn new(faces: &'a Faces) -> Self {
        Self { faces, pages: vec![Vec::new()], y: TOP, headings: Vec::new() }
    }

    pub(super) fn draw(&mut self, mark: Mark) {
        if let Some(page) = self.pages.last_mut() {
            page.push(mark);
        }
    }

    /// Nothing stands on the last page yet.
    pub(super) fn is_fresh(&self) -> bool {
        self.y <= TOP
    }

    pub(super) fn new_page(&mut self) {
        if !self.is_fresh() {
            self.pages.push(Vec::new());
            self.y = TOP;
        }
    }

    /// How much room the last page has left.
    pub(super) fn left(&self) -> f32 {
        BOTTOM - self.y
    }

    /// Makes sure that so much fits on the last page; what is higher than a page begins one.
    pub(super) fn reserve(&mut self, height: f32) {
        if self.left() < height {
            self.new_page();
        }
    }

    /// Leaves room, but not at the top of a page.
    pub(super) fn skip(&mut self, height: f32) {
        if !self.is_fresh() {
            self.y += height;
        }
    }

    /// A line of text at `x`; the page moves on by one line.
    pub(super) fn line(&mut self, x: f32, text: &str, style: Style) {
        self.text_at([x, self.y + style.size], text, style);
        self.y += style.leading();
    }

    pub(super) fn text_at(&mut self, at: [f32; 2], text: &str, style: Style) {
        self.draw(Mark::Text { at, text: text.to_owned(), style });
    }

    pub(super) fn rule(&mut self, x: [f32; 2], y: f32, thick: f32, colour: Colour) {
        self.draw(Mark::Box { at: [x[0], y], size: [x[1] - x[0], thick], colour });
    }

    /// Lines of a text in a room.
    pub(super) fn broken(&self, text: &str, style: Style, room: f32) -> Vec<String> {
        self.faces.of(style.cut).lines(text, style.size, room)
    }

    /// A paragraph at `x`, over pages where it must.
    pub(super) fn paragraph(&mut self, x: f32, text: &str, style: Style) {
        for line in self.broken(text, style, RIGHT - x) {
            self.reserve(style.leading());
            self.line(x, &line, style);
        }
    }
}

/// A text cut to one line.
pub(super) fn one_line(face: &Face, text: &str, size: f32, room: f32) -> String {
    if face.width(text, size) <= room {
        return text.to_owned();
    }
    let end = face.fitting(text, size, room - face.width("...", size));
    format!("{}...", text[..end].trim_end())
}
