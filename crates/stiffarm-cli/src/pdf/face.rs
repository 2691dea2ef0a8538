//! The letters of a printed report: the fonts that come with the program, how wide a text is, and where its lines are broken.

use krilla::text::{Font, GlyphId, KrillaGlyph};
use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::{FontRef, MetadataProvider};
use stiffarm_ask::figures::fonts;

/// Which font.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    Plain,
    Bold,
    /// All letters as wide: commands and files.
    Mono,
}

/// A font, ready to be measured and drawn.
pub(super) struct Face {
    pub font: Font,
    letters: Charmap<'static>,
    advances: GlyphMetrics<'static>,
    units: f32,
}

/// The fonts of a document.
pub(super) struct Faces([Face; 3]);

impl Faces {
    /// Those that come with the program; `None` where they are none, which no program has that was built.
    pub(super) fn new() -> Option<Self> {
        let [plain, bold, mono] = [fonts::plain(), fonts::bold(), fonts::mono()].map(Face::new);
        Some(Self([plain?, bold?, mono?]))
    }

    pub(super) fn of(&self, cut: Cut) -> &Face {
        &self.0[match cut {
            Cut::Plain => 0,
            Cut::Bold => 1,
            Cut::Mono => 2,
        }]
    }
}

impl Face {
    fn new(data: &'static [u8]) -> Option<Self> {
        let known = FontRef::from_index(data, 0).ok()?; // a font that is none has no letters to tell of
        let advances = known.glyph_metrics(Size::unscaled(), LocationRef::default());
        let units = f32::from(known.metrics(Size::unscaled(), LocationRef::default()).units_per_em);
        Some(Self { font: Font::new(data.into(), 0)?, letters: known.charmap(), advances, units })
    }

    /// The letters of a line for the printer, in parts of the font's size.
    pub(super) fn glyphs(&self, text: &str) -> Vec<KrillaGlyph> {
        let glyph = |(at, c): (usize, char)| KrillaGlyph {
            glyph_id: GlyphId::new(self.letters.map(c).unwrap_or_default().to_u32()),
            text_range: at..at + c.len_utf8(),
            x_advance: self.advance(c),
            x_offset: 0.0,
            y_offset: 0.0,
            y_advance: 0.0,
            location: None,
        };
        text.char_indices().map(glyph).collect()
    }

    fn advance(&self, c: char) -> f32 {
        let glyph = self.letters.map(c).unwrap_or_default();
        self.advances.advance_width(glyph).unwrap_or_default() / self.units
    }

    /// How wide a text is, in the unit of the size.
    pub(super) fn width(&self, text: &str, size: f32) -> f32 {
        text.chars().map(|c| self.advance(c)).sum::<f32>() * size
    }

    /// A text in lines that fit: broken between words, and within one that is wider than a line.
    pub(super) fn lines(&self, text: &str, size: f32, room: f32) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        let (mut line, mut width) = (String::new(), 0.0);
        let space = self.width(" ", size);
        for word in text.split_whitespace() {
            let needed = self.width(word, size);
            if !line.is_empty() && width + space + needed <= room {
                line.push(' ');
                line.push_str(word);
                width += space + needed;
                continue;
            }
            if !line.is_empty() {
                lines.push(std::mem::take(&mut line));
            }
            let mut rest = word;
            while room < self.width(rest, size) && 1 < rest.chars().count() {
                let end = self.fitting(rest, size, room);
                lines.push(rest[..end].to_owned());
                rest = &rest[end..];
            }
            (line, width) = (rest.to_owned(), self.width(rest, size));
        }
        if !line.is_empty() {
            lines.push(line);
        }
        lines
    }

    /// How much of a text fits, bytes; at least one letter.
    pub(super) fn fitting(&self, text: &str, size: f32, room: f32) -> usize {
        let mut width = 0.0;
        for (at, c) in text.char_indices() {
            width += self.advance(c) * size;
            if room < width && 0 < at {
                return at;
            }
        }
        text.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_is_wider_than_its_room_and_no_letter_is_lost() {
        let faces = Faces::new().unwrap();
        let text = "The KR 210 R2700 extra holds 3 mm; see https://a.very/long/word/without/any/blank/in/it/at/all.html ok \u{4e2d}\u{6587}";
        for cut in [Cut::Plain, Cut::Bold, Cut::Mono] {
            let face = faces.of(cut);
            for room in [20.0, 60.0, 200.0, 5000.0] {
                let lines = face.lines(text, 9.0, room);
                assert!(lines.iter().all(|line| face.width(line, 9.0) <= room), "{lines:?}");
                let letters = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<String>();
                assert_eq!(letters(&lines.concat()), letters(text));
            }
            assert!(face.lines("", 9.0, 10.0).is_empty());
            // Narrower than any letter: one on each line.
            assert_eq!(face.lines("abc", 9.0, 0.1), ["a", "b", "c"]);
        }
    }
}
