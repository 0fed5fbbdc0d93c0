//! Axes, ticks, text and bands: the drawing functions that the views share.

use super::glossary::{self, Explained};
use super::theme::{self, Palette};
use crate::digits::short;
use crate::export::figure::{Colour, Colours};
use crate::gui::derived::format::ends;
use crate::recording::Recording;
use crate::ticks::{Steps, round_down};
use eframe::egui::epaint::{Mesh, Shape};
use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rangef, Rect, Sense, Stroke, TextStyle, Ui, pos2, vec2};
use std::cell::RefCell;
use std::rc::Rc;
use std::sync::{Arc, OnceLock};

/// Draws, with the colours and the text of the drawings.
#[derive(Clone)]
pub(super) struct PlotStyle {
    pub(super) painter: Painter,
    pub(super) palette: Palette,
    pub(super) text: Color32,
    pub(super) grid: Color32,
    pub(super) font: FontId,
    /// Height of a line of text.
    pub(super) row: f32,
    /// Width of the space for numbers at the left of a drawing.
    pub(super) gutter: f32,
    /// Height of the space for the title above a drawing, and for the numbers below it.
    pub(super) title: f32,
    pub(super) axis: f32,
    /// The terms that were written, and their positions.
    terms: Rc<RefCell<Vec<(Rect, String)>>>,
}

impl PlotStyle {
    pub(super) fn new(ui: &Ui) -> Self {
        let palette = theme::palette(ui.visuals().dark_mode);
        let body = TextStyle::Body.resolve(ui.style());
        let font = FontId::new((0.85 * body.size).max(9.0), body.family);
        let row = ui.fonts_mut(|fonts| fonts.row_height(&font));
        let widest = ui.painter().layout_no_wrap("−0.000".to_owned(), font.clone(), palette.quiet);
        Self {
            painter: ui.painter().clone(),
            palette,
            text: ui.visuals().text_color(),
            grid: palette.quiet.gamma_multiply(0.22),
            font,
            row,
            gutter: widest.size().x + 6.0,
            title: row + 7.0,
            axis: row + 3.0,
            terms: Rc::default(),
        }
    }

    /// Fill of a solid body: opaque, so that bodies may overlap, and lighter than its outline.
    pub(super) fn solid(&self, outline: Color32) -> Color32 {
        self.palette.canvas.lerp_to_gamma(outline, 0.72)
    }

    /// A copy that draws within `rect` only.
    pub(super) fn within(&self, rect: Rect) -> Self {
        self.clipped(self.painter.clip_rect().intersect(rect))
    }

    /// A copy with the clip rectangle `clip`.
    pub(super) fn clipped(&self, clip: Rect) -> Self {
        Self { painter: self.painter.with_clip_rect(clip), ..self.clone() }
    }

    pub(super) fn write(&self, at: Pos2, anchor: Align2, text: &str, colour: Color32) -> Rect {
        self.painter.text(at, anchor, text, self.font.clone(), colour)
    }

    /// Marks the text at `place` as the glossary term `word`, to be explained on hover.
    pub(super) fn term(&self, place: Rect, word: &str) {
        self.terms.borrow_mut().push((place, word.to_owned()));
    }

    /// Explains the terms of the drawing on hover. This is called after everything else that uses the pointer. Returns whether the pointer
    /// is on a term: values are then shown elsewhere.
    pub(super) fn explain(&self, ui: &Ui) -> bool {
        let mut pointed = false;
        for (number, (place, word)) in self.terms.borrow_mut().drain(..).enumerate() {
            pointed |= glossary::over(ui, place, &word, number).explained_here(ui, &word).hovered();
        }
        pointed
    }

    pub(super) fn width(&self, text: &str) -> f32 {
        self.painter.layout_no_wrap(text.to_owned(), self.font.clone(), self.text).size().x
    }

    /// The legend entry for the run that a lesson's step began with, if that run is drawn.
    pub(super) fn at_first<T>(&self, first: Option<T>) -> Option<(&'static str, Color32)> {
        first.map(|_| ("at first", self.palette.quiet))
    }

    /// A title above `plot`, and a legend at its right end. The title is the first of `titles`, long to short, that fits beside the legend,
    /// or else the first that fits alone. `word` is its glossary term; the entries of the legend are terms themselves.
    pub(super) fn title(&self, plot: Rect, word: &str, titles: &[&str], legend: &[(&str, Color32)]) {
        let bottom = plot.top() - 2.0;
        let gap = 0.7 * self.row;
        let width: f32 = legend.iter().map(|(text, _)| self.width(text) + gap + self.row).sum();
        let fits = |beside: f32| titles.iter().copied().find(|title| self.width(title) + beside <= plot.width());
        let with_legend = fits(gap + width);
        let Some(title) = with_legend.or_else(|| fits(0.0)).or(titles.last().copied()) else { return };
        let left = self.within(Rect::everything_left_of(plot.right() + 1.0));
        let corner = pos2(plot.left(), bottom);
        let place = left.write(corner, Align2::LEFT_BOTTOM, title, self.text);
        self.term(place.intersect(left.painter.clip_rect()), word);
        if with_legend.is_none() {
            return;
        }
        let mut right = plot.right();
        for (text, colour) in legend.iter().rev() {
            let place = self.write(pos2(right, bottom), Align2::RIGHT_BOTTOM, text, self.text);
            let left = place.left();
            let middle = pos2(left - 0.6 * self.row, bottom - 0.5 * self.row);
            let key = Rect::from_center_size(middle, vec2(0.7 * self.row, 0.35 * self.row));
            self.painter.rect_filled(key, 1.0, *colour);
            self.term(place.union(key), text);
            right = key.left() - gap;
        }
    }

    /// Fills the area between two lines, given as columns (x, one y, other y).
    pub(super) fn band(&self, columns: impl Iterator<Item = (f32, f32, f32)>, colour: Color32) {
        self.shaded(columns.map(|(x, one, other)| (x, one, other, colour)));
    }

    /// As [`Self::band`], with a colour for each column: (x, one y, other y, colour).
    pub(super) fn shaded(&self, columns: impl Iterator<Item = (f32, f32, f32, Color32)>) {
        let mut mesh = Mesh::default();
        let (least, _) = columns.size_hint();
        mesh.reserve_vertices(2 * least);
        mesh.reserve_triangles(2 * least);
        for (x, one, other, colour) in columns {
            let next = mesh.vertices.len() as u32;
            mesh.colored_vertex(pos2(x, one), colour);
            mesh.colored_vertex(pos2(x, other), colour);
            if next > 0 {
                mesh.add_triangle(next - 2, next - 1, next);
                mesh.add_triangle(next - 1, next, next + 1);
            }
        }
        self.painter.add(Shape::Mesh(Arc::new(mesh)));
    }

    /// A title above `plot`, with the colour bar and the values of its ends at the right end of the same line. `word` is its glossary term.
    pub(super) fn title_with_bar(&self, plot: Rect, word: &str, titles: &[&str], range: [f64; 2]) {
        let ends = ends(range.map(|pascal| pascal / 1e3));
        // A single value needs no scale.
        if ends[0] == ends[1] {
            let everywhere: Vec<_> =
                titles.iter().map(|title| format!("{title}: {} kPa everywhere", ends[1])).collect();
            return self.title(plot, word, &everywhere.iter().map(String::as_str).collect::<Vec<_>>(), &[]);
        }
        self.title_with_ends(plot, word, titles, [&ends[0], &format!("{} kPa", ends[1])]);
    }

    /// As [`Self::title_with_bar`], with given texts at the ends of the bar.
    pub(super) fn title_with_ends(&self, plot: Rect, word: &str, titles: &[&str], ends: [&str; 2]) {
        let bottom = plot.top() - 2.0;
        let written = self.width(ends[0]) + self.width(ends[1]) + 2.0 * self.row;
        let room = plot.width() - written - 2.0 * self.row;
        // The longest title that leaves room for a bar; if none does, no title is written.
        let title = titles.iter().copied().find(|title| self.width(title) < room).unwrap_or_default();
        let length = (room - self.width(title)).clamp(2.0 * self.row, 9.0 * self.row);
        let place = self.write(pos2(plot.left(), bottom), Align2::LEFT_BOTTOM, title, self.text);
        self.term(place, word);
        let right = self.write(pos2(plot.right(), bottom), Align2::RIGHT_BOTTOM, ends[1], self.palette.quiet).left();
        let bar = Rect::from_min_max(
            pos2(right - 4.0 - length, bottom - 0.8 * self.row),
            pos2(right - 4.0, bottom - 0.2 * self.row),
        );
        let colours = field_colours();
        let column =
            |i: u8| (bar.left() + bar.width() * f32::from(i) / 255.0, bar.top(), bar.bottom(), colours[usize::from(i)]);
        self.shaded((0..=255u8).step_by(5).map(column));
        self.write(pos2(bar.left() - 4.0, bottom), Align2::RIGHT_BOTTOM, ends[0], self.palette.quiet);
    }

    /// A vertical scale bar at the left of `axes`; its length is a round number of micrometres.
    fn scale_bar(&self, axes: &Axes) {
        let (plot, scale) = (axes.rect, axes.points_per_metre());
        let length = round_down(0.3 * f64::from(plot.height()) / scale / 1e-6);
        let height = (length * 1e-6 * scale) as f32;
        let x = plot.left() - 6.0;
        let middle = plot.center().y;
        let (top, bottom) = (middle - 0.5 * height, middle + 0.5 * height);
        let stroke = Stroke::new(1.5, self.text);
        self.painter.vline(x, top..=bottom, stroke);
        for y in [top, bottom] {
            self.painter.hline(x - 3.0..=x + 3.0, y, stroke);
        }
        let at = pos2(x - 5.0, middle);
        self.write(at - vec2(0.0, 0.5 * self.row), Align2::RIGHT_CENTER, &short(length, 3), self.text);
        self.write(at + vec2(0.0, 0.5 * self.row), Align2::RIGHT_CENTER, "µm", self.text);
    }
}

/// Whether there is something to draw.
pub(super) fn has_fields(recording: &Recording) -> bool {
    recording.frames > 0 && !recording.x.is_empty() && !recording.film.is_empty()
}

/// Takes the whole of `ui`; `None`, with a message, if the space is too small to draw in.
pub(super) fn room(ui: &mut Ui) -> Option<Rect> {
    let size = ui.available_size();
    if size.x <= 160.0 || size.y <= 160.0 {
        ui.label("There is no room for this view. Hide the side panels with the menu View.");
        return None;
    }
    Some(ui.allocate_exact_size(size.min(vec2(6000.0, 6000.0)), Sense::hover()).0)
}

/// Drawings below each other, with numbers at the left of them.
pub(super) struct DrawingStack {
    /// Horizontal range of the drawings, without the numbers.
    pub(super) x: Rangef,
    /// Bottom of the last drawing.
    pub(super) bottom: f32,
}

impl DrawingStack {
    /// An empty column in `area`.
    pub(super) fn of(area: Rect, style: &PlotStyle) -> Self {
        let x = Rangef::new(area.left() + style.gutter, area.right() - 0.5 * style.row);
        Self { x, bottom: area.top() }
    }

    /// The rectangle of the next drawing, with this much space above it.
    pub(super) fn next(&mut self, above: f32, height: f32) -> Rect {
        let top = self.bottom + above;
        self.bottom = top + height;
        Rect::from_x_y_ranges(self.x, top..=self.bottom)
    }
}

/// A rectangle on the screen and what its edges mean.
#[derive(Clone, Copy)]
pub(super) struct Axes {
    pub(super) rect: Rect,
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
}

impl Axes {
    /// A range of zero length is widened.
    pub(super) fn new(rect: Rect, x: [f64; 2], y: [f64; 2]) -> Self {
        Self { rect, x: widened(x), y: widened(y) }
    }

    /// Axes for a drawing of heights \[m\], with its background and a scale bar: from `low` to `high`, with these shares of the drawing
    /// below and above.
    pub(super) fn of_heights(
        style: &PlotStyle,
        (rect, x): (Rect, [f64; 2]),
        [low, high]: [f64; 2],
        [below, above]: [f64; 2],
    ) -> Self {
        let whole = (high - low) / (1.0 - below - above);
        let bottom = low - below * whole;
        let axes = Self::new(rect, x, [bottom, bottom + whole]);
        style.painter.rect_filled(rect, 2.0, style.palette.canvas);
        style.scale_bar(&axes);
        axes
    }

    pub(super) fn px(&self, x: f64) -> f32 {
        let part = (x - self.x[0]) / (self.x[1] - self.x[0]);
        self.rect.left() + part as f32 * self.rect.width()
    }

    pub(super) fn py(&self, y: f64) -> f32 {
        let part = (y - self.y[0]) / (self.y[1] - self.y[0]);
        self.rect.bottom() - part as f32 * self.rect.height()
    }

    /// Length of a metre along y on the screen.
    pub(super) fn points_per_metre(&self) -> f64 {
        f64::from(self.rect.height()) / (self.y[1] - self.y[0])
    }

    /// Factor by which y is drawn larger than x.
    pub(super) fn exaggeration(&self) -> f64 {
        self.points_per_metre() * (self.x[1] - self.x[0]) / f64::from(self.rect.width())
    }

    pub(super) fn at(&self, x: f64, y: f64) -> Pos2 {
        pos2(self.px(x), self.py(y))
    }

    /// x at a position on the screen; `None` outside of the rectangle.
    pub(super) fn x_at(&self, px: f32) -> Option<f64> {
        let part = f64::from((px - self.rect.left()) / self.rect.width());
        (0.0..=1.0).contains(&part).then(|| self.x[0] + part * (self.x[1] - self.x[0]))
    }

    pub(super) fn x_grid(&self, style: &PlotStyle, unit: f64) {
        for value in self.x_values(style, unit).values() {
            style.painter.vline(self.px(value * unit), self.rect.y_range(), Stroke::new(1.0, style.grid));
        }
    }

    fn x_values(&self, style: &PlotStyle, unit: f64) -> Steps {
        let about = (self.rect.width() / (3.6 * style.row)).clamp(1.0, 12.0) as usize;
        Steps::new([self.x[0] / unit, self.x[1] / unit], about)
    }

    /// Values below the plot, and the name of the axis at the left of them.
    pub(super) fn x_labels(&self, style: &PlotStyle, unit: f64, name: &str) {
        let ticks = self.x_values(style, unit);
        let top = self.rect.bottom() + 1.0;
        let place = style.write(pos2(self.rect.left() - 4.0, top), Align2::RIGHT_TOP, name, style.palette.quiet);
        style.term(place, name.split(',').next().unwrap_or(name));
        let named = place.right();
        for value in ticks.values() {
            let text = ticks.format(value);
            let half = 0.5 * style.width(&text);
            let x = self.px(value * unit);
            if x - half > named + 2.0 && x + half < self.rect.right() + 8.0 {
                style.write(pos2(x, top), Align2::CENTER_TOP, &text, style.palette.quiet);
            }
        }
    }

    /// The line under the pointer.
    pub(super) fn cursor(&self, style: &PlotStyle, x: Option<f64>) {
        if let Some(x) = x.filter(|x| (self.x[0]..=self.x[1]).contains(x)) {
            style.painter.vline(self.px(x), self.rect.y_range(), Stroke::new(1.0, style.palette.accent));
        }
    }
}

/// The range; if its length is zero, a range round it.
pub(super) fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    if !(low.is_finite() && high.is_finite()) {
        return [0.0, 1.0];
    }
    let span = high - low;
    if span > 1e-12 * low.abs().max(high.abs()) && span > f64::MIN_POSITIVE {
        return [low, high];
    }
    let half = if low == 0.0 { 0.5 } else { 0.05 * low.abs() };
    [low - half, high + half]
}

/// Colours of the field in 256 steps.
pub(super) fn field_colours() -> &'static [Color32; 256] {
    static COLOURS: OnceLock<[Color32; 256]> = OnceLock::new();
    COLOURS.get_or_init(|| {
        std::array::from_fn(|i| {
            let Colour(r, g, b) = Colours::Field.at(i as f64 / 255.0);
            Color32::from_rgb(r, g, b)
        })
    })
}

/// The colour of a value of the field; the two given values get the first and the last colour.
pub(super) fn colour_between([low, high]: [f64; 2]) -> impl Fn(f64) -> Color32 {
    let (colours, per_unit) = (field_colours(), 255.0 / (high - low).max(f64::MIN_POSITIVE));
    move |value| colours[((value - low) * per_unit).clamp(0.0, 255.0) as usize]
}

/// The colour of a pressure \[Pa\] in this range. If both ends read the same, their difference is noise, and all pressures have one colour.
pub(super) fn pressure_colour(range: [f64; 2]) -> impl Fn(f64) -> Color32 {
    let [least, most] = ends(range.map(|pascal| pascal / 1e3));
    colour_between(if least == most { [range[0], f64::INFINITY] } else { range })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_of_no_extent_is_widened() {
        let axes = Axes::new(Rect::from_min_size(Pos2::ZERO, vec2(10.0, 10.0)), [0.0, 0.0], [5.0, 5.0]);
        assert!(axes.at(0.0, 5.0).is_finite());
        let axes = Axes::new(axes.rect, [0.0, f64::NAN], [f64::INFINITY, f64::NEG_INFINITY]);
        assert!(axes.at(0.0, 5.0).is_finite());
        assert_eq!(axes.x_at(-1.0), None);
        assert_eq!(axes.x_at(5.0), Some(0.5));
    }
}
