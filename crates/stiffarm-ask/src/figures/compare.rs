//! Two maps side by side, on one scale of colour and of length, with the zone of each at its place.

use super::axes::heading;
use super::bands::Bands;
use super::canvas::{Canvas, Font};
use super::legend::{Entry, Legend};
use super::map::MapFigure;
use super::scene::frame_around;
use super::{FigureError, FigureSize};

/// What the colour bar and its texts take, px.
const BAR: f64 = 112.0;
/// Left and right of a diagram in its panel, px.
const ROOM: [f64; 2] = [66.0, 12.0];
/// Lines of words above a panel, at most.
const LINES: usize = 8;
/// Their distance, px.
const LINE: f64 = 15.0;

/// Two maps that are compared.
pub(crate) struct CompareFigure<'a> {
    /// First line.
    pub title: String,
    /// Second line, in grey.
    pub subtitle: String,
    /// Left and right.
    pub panels: [MapFigure<'a>; 2],
    /// What the colours mean, with the unit.
    pub colour_label: String,
    /// What was asked of the figure.
    pub figure_size: FigureSize,
}

impl CompareFigure<'_> {
    /// The figure as SVG text.
    ///
    /// # Errors
    /// Where neither map reaches anything.
    pub(crate) fn svg(&self) -> Result<String, FigureError> {
        let mut canvas = Canvas::of(&self.figure_size);
        let width = (canvas.width - BAR) / 2.0;
        let legend = Legend::new(self.entries(), canvas.width - 80.0, 4);
        let top = heading(&mut canvas, &self.title, &self.subtitle) + 30.0;
        let found: Vec<[f64; 2]> = self.panels.iter().filter_map(MapFigure::extremes).collect();
        let extremes = found.into_iter().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        let extremes = extremes.ok_or(FigureError::Nothing("neither of the two reaches anything"))?;
        let bands = Bands::within(self.figure_size.ends(), extremes, self.panels[0].colours);
        let (bold, small) = (Font::new(14.0).bold(), Font::new(12.0));
        let room = width - ROOM[0] - ROOM[1];
        let words = self.panels.each_ref().map(|panel| small.wrapped(&panel.subtitle, room, LINES));
        let lines = words.iter().map(Vec::len).max().unwrap_or(0);
        let points: Vec<[f64; 2]> =
            self.panels.iter().flat_map(|panel| panel.scene.points(panel.reached().to_vec())).collect();
        let frame = frame_around(&points, width, top + 10.0 + LINE * lines as f64, ROOM);
        for ((panel, words), right) in self.panels.iter().zip(&words).zip([0.0, width]) {
            canvas.shifted(right, |canvas| {
                canvas.text([ROOM[0], top - 12.0], &bold.cut(&panel.title, room), bold);
                for (i, line) in words.iter().enumerate() {
                    canvas.text([ROOM[0], top + 6.0 + LINE * i as f64], line, small);
                }
                panel.draw_inside(canvas, &frame, Some(bands));
                panel.draw_frame(canvas, &frame);
            });
        }
        let [[_, bottom], [_, upper]] = frame.corners();
        let left = 2.0 * width + 16.0;
        let (height, middle) = ((bottom - upper - 40.0).clamp(120.0, 520.0), f64::midpoint(bottom, upper));
        let ends = [middle + height / 2.0, middle - height / 2.0];
        bands.bar(&mut canvas, [left, ends[0]], [left + 20.0, ends[1]], &self.colour_label);
        legend.draw(&mut canvas, [40.0, bottom + 52.0]);
        canvas.height = bottom + 66.0 + legend.height();
        Ok(canvas.finish())
    }

    /// Of both, each once.
    fn entries(&self) -> Vec<Entry> {
        let mut entries: Vec<Entry> = Vec::new();
        for entry in self.panels.iter().flat_map(MapFigure::entries) {
            if !entries.iter().any(|known| known.text == entry.text) {
                entries.push(entry);
            }
        }
        entries
    }
}
