//! The pressure map as a picture: resampled from the graded nodes to pixels, one texture for each map on screen.

use super::frame::Frame;
use crate::digits::short;
use crate::fidelity::Fidelity;
use crate::gui::ui::cache::once;
use crate::gui::ui::paint::{Axes, PlotStyle, pressure_colour};
use crate::recording::Recording;
use crate::recording::sample::{self, Plane, between};
use eframe::egui::{Align2, Color32, ColorImage, Rect, TextureOptions, Ui, pos2};

/// Texels across the width. These are enough, because the field is smooth and the graphics card interpolates.
const MOST_ROWS: usize = 96;
/// Texels along x.
const MOST_COLUMNS: usize = 2048;

/// Key of a picture of the field: the texture is kept as long as the key stays the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stamp {
    /// Number of the run and its fidelity.
    pub(super) run: (u64, Fidelity),
    /// Instant shown, in frames.
    pub(super) place: f64,
    /// First tooth shown.
    pub(super) tooth: usize,
    /// x at the left and right edge \[m\].
    pub(super) x: [f64; 2],
    /// Pressures of the first and last colour \[Pa\].
    pub(super) range: [f64; 2],
}

/// Draws the map of the teeth from `stamp.tooth` on, with x from `stamp.x[0]` to `stamp.x[1]`, into `rect`. The picture fills it, so that
/// it needs no background. Returns the axes, along x and across the width.
pub(super) fn draw(ui: &Ui, style: &PlotStyle, rect: Rect, recording: &Recording, name: &str, stamp: Stamp) -> Axes {
    let half = sample::half_width(recording);
    let axes = Axes::new(rect, stamp.x, [-half, half]);
    let stamp = Stamp { x: axes.x, ..stamp };
    let ground = style.palette.canvas;
    let scale = style.painter.pixels_per_point();
    let texels = |length: f32, most: usize| ((length * scale).round().max(1.0) as usize).min(most);
    let size = [texels(rect.width(), MOST_COLUMNS), texels(rect.height(), MOST_ROWS)];
    let texture = once(ui, &format!("map, {name}"), (stamp, ground, size), || {
        let image = ColorImage::new(size, pixels(recording, &stamp, size, ground));
        ui.ctx().load_texture(name, image, TextureOptions::LINEAR)
    });
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    style.painter.image(texture.id(), rect, whole, Color32::WHITE);
    axes
}

/// Draws the map of all teeth, or of a plate, into `rect`. The title, one of `titles`, has the colour bar, and the values of y are at the
/// left. `name` distinguishes it from other maps.
pub(super) fn of_run<T>(
    ui: &Ui,
    style: &PlotStyle,
    rect: Rect,
    shown: &Frame<'_, T>,
    (name, titles): (&str, &[&str]),
) -> Axes {
    let range = shown.ranges.pressure;
    let stamp = Stamp { run: shown.run, place: shown.place, tooth: 0, x: shown.x_range(), range };
    let axes = draw(ui, style, rect, shown.recording, name, stamp);
    style.title_with_bar(rect, "Pressure map", titles, range);
    y_labels(style, &axes);
    axes.cursor(style, shown.view.cursor_x);
    axes
}

/// The values at the ends of y, and the name of the axis between them if there is space.
pub(super) fn y_labels(style: &PlotStyle, axes: &Axes) {
    let x = axes.rect.left() - 4.0;
    let (top, bottom) = (axes.rect.top(), axes.rect.bottom());
    let write = |y: f32, anchor: Align2, text: &str| {
        style.write(pos2(x, y), anchor, text, style.palette.quiet);
    };
    if bottom - top > 2.0 * style.row {
        let text = |value: f64| short(value * 1e3, 3);
        write(top - 0.15 * style.row, Align2::RIGHT_TOP, &text(axes.y[1]));
        write(bottom + 0.1 * style.row, Align2::RIGHT_BOTTOM, &text(axes.y[0]));
    }
    if bottom - top > 3.2 * style.row || bottom - top <= 2.0 * style.row {
        write(axes.rect.center().y, Align2::RIGHT_CENTER, "y, mm");
    }
}

/// Pixels of the map, row by row from y = +w/2 down; beside the teeth they have the colour of the background.
fn pixels(recording: &Recording, stamp: &Stamp, [columns, rows]: [usize; 2], ground: Color32) -> Vec<Color32> {
    let mut pixels = vec![ground; columns * rows];
    let Some(plane) = Plane::of(recording, 0, 0) else { return pixels };
    let half = sample::half_width(recording);
    let places: Vec<Option<(usize, f64)>> =
        (0..rows).map(|j| plane.row(half * (1.0 - (2.0 * j as f64 + 1.0) / rows as f64))).collect();
    let colour = pressure_colour(stamp.range);
    let mut values = vec![0.0; recording.map_y.len()];
    for i in 0..columns {
        let x = stamp.x[0] + (i as f64 + 0.5) / columns as f64 * (stamp.x[1] - stamp.x[0]);
        let (tooth, xi) = sample::tooth_at(x, recording.pitch, recording.teeth.saturating_sub(stamp.tooth).max(1));
        if !sample::column(recording, stamp.tooth + tooth, xi, stamp.place, &mut values) {
            continue;
        }
        for (j, place) in places.iter().enumerate() {
            if let Some(place) = *place {
                pixels[j * columns + i] = colour(between(&values, place));
            }
        }
    }
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::ui::paint::field_colours;
    use crate::recording::LineLoads;

    #[test]
    fn grooves_have_the_ground_and_the_width_is_mirrored() {
        let recording = Recording {
            lines: LineLoads { frames: 2, teeth: 2, stored_teeth: 1, pitch: 1.0, length: 2.0, ..LineLoads::default() },
            map_x: vec![-0.25, 0.0, 0.25],
            map_y: vec![0.0, 0.5],
            half_width: true,
            pressure: [[1.0, 0.0].repeat(3), [3.0, 0.0].repeat(3)].concat(),
            ..Recording::default()
        };
        let stamp = Stamp { run: (0, Fidelity::Draft), place: 0.0, tooth: 0, x: [-0.5, 1.5], range: [0.0, 3.0] };
        let (columns, rows) = (40, 9);
        let pixels = pixels(&recording, &stamp, [columns, rows], Color32::TRANSPARENT);
        let at = |i: usize, j: usize| pixels[j * columns + i];
        assert_eq!(at(0, 4), Color32::TRANSPARENT);
        assert_eq!(at(20, 4), Color32::TRANSPARENT);
        // Tooth 1 is half a cycle ahead.
        assert_eq!(at(10, 4), field_colours()[85]);
        assert_eq!(at(30, 4), field_colours()[255]);
        // Pressures that are written as the same number have the same colour.
        assert_eq!(pressure_colour([101_325.0, 101_325.3])(101_325.3), field_colours()[0]);
        assert_eq!(pressure_colour([100_000.0, 102_000.0])(101_000.0), field_colours()[127]);
        for i in 0..columns {
            for j in 0..rows {
                assert_eq!(at(i, j), at(i, rows - 1 - j));
            }
        }
    }
}
