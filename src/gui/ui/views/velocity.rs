//! Velocity of the gas across the film, from wall to wall, at one place, computed by `film::velocity`.

use super::frame::Frame;
use super::inset::Inset;
use crate::film::velocity::Velocity;
use crate::gui::derived::format::number;
use crate::gui::derived::scales::{span, with_margin};
use crate::gui::ui::cache::once;
use crate::gui::ui::paint::PlotStyle;
use crate::gui::ui::plot::{between, dots, level, line, upright};
use crate::problem::Gas;
use crate::recording::sample;
use eframe::egui::{Rect, Ui};
use egui_plot::LineStyle;

const POINTS: usize = 24;
/// Number of instants from which the fixed range of the axis is determined.
const INSTANTS: usize = 48;
/// Gas slower than this \[m/s\] counts as at rest, so that the axis does not show rounding errors.
const STILL: f64 = 1e-6;
/// Margin above and below the film, relative to the greatest thickness.
const MARGIN: f64 = 0.12;

/// A place of a film, at any instant.
pub(super) struct FilmPosition<'a, T> {
    pub(super) shown: &'a Frame<'a, T>,
    pub(super) gas: &'a Gas,
    pub(super) tooth: usize,
    /// x from the middle of the tooth \[m\].
    pub(super) xi: f64,
    /// Velocities of the lower and the upper wall at an instant, in frames \[m/s\].
    pub(super) walls: &'a dyn Fn(f64) -> [f64; 2],
    /// Film thickness there at an instant, in frames \[m\].
    pub(super) thickness: &'a dyn Fn(f64) -> Option<f64>,
}

impl<T> FilmPosition<'_, T> {
    fn at(&self, instant: f64) -> Option<Velocity> {
        let pressure = sample::middle_pressure(self.shown.recording, self.tooth, self.xi, instant)?;
        let gradient = sample::middle_gradient(self.shown.recording, self.tooth, self.xi, instant)?;
        Some(Velocity::new(self.gas, (self.thickness)(instant)?, pressure, gradient, (self.walls)(instant)))
    }

    /// Least and greatest velocity over the cycle; 0 is included.
    fn range(&self) -> [f64; 2] {
        let frames = self.shown.recording.frames.max(1) as f64;
        let instants = (0..INSTANTS).filter_map(|i| self.at(frames * i as f64 / INSTANTS as f64));
        let of = |velocity: Velocity| curve(&velocity).into_iter().map(|[u, _]| u).chain(velocity.walls);
        let [low, high] = span(instants.flat_map(of).chain([0.0]));
        if high - low < STILL { [-STILL, STILL] } else { [low, high] }
    }

    /// Draws the profile at the present instant into `rect`.
    pub(super) fn draw(&self, ui: &mut Ui, style: &PlotStyle, rect: Rect) {
        let key = (self.shown.run, self.tooth, self.xi.to_bits());
        let [low, high] = *once(ui, "velocity", key, || self.range());
        let (unit, size) = if high.max(-low) < 0.1 { ("mm/s", 1e-3) } else { ("m/s", 1.0) };
        let across = with_margin([low, high], 0.08).map(|u| u / size);
        let up = [-MARGIN, 1.0 + MARGIN].map(|part| part * self.shown.ranges.thickness[1] * 1e6);
        let place = number((self.tooth as f64 * self.shown.recording.pitch + self.xi) * 1e3);
        let [long, middle] = ["Velocity across the film, z in µm, at x =", "Velocity, z in µm, x ="]
            .map(|text| format!("{text} {place} mm"));
        let palette = &style.palette;
        style.title(rect, "Velocity across the film", &[&long, &middle, "Velocity, z in µm"], &[]);
        let below = format!("u, {unit}");
        let name = "Velocity across the film over the height above the tooth in µm";
        let inset = Inset { name, rect, bounds: [across, up], below: Some(&below) };
        let found = self.at(self.shown.place);
        inset.show(ui, style, |plot| {
            let wall = |from: f64, to: f64| across.map(|u| [u, from, to]);
            plot.add(between(&wall(up[0], 0.0), style.solid(palette.stator)));
            plot.hline(level(0.0, palette.stator, 1.5));
            plot.vline(upright(0.0, palette.quiet, 1.0));
            let Some(velocity) = found else { return };
            let thickness = velocity.thickness * 1e6;
            plot.add(between(&wall(thickness, up[1].max(thickness)), style.solid(palette.rotor)));
            plot.hline(level(thickness, palette.rotor, 1.5));
            let points: Vec<_> = curve(&velocity).into_iter().map(|[u, z]| [u / size, z * 1e6]).collect();
            plot.line(line(&points, palette.film, 1.8, LineStyle::Solid));
            let [lower, upper] = velocity.walls.map(|u| u / size);
            plot.points(dots("", vec![[lower, 0.0], [upper, thickness]], palette.accent, 3.5));
        });
    }
}

/// (u, z) from the lower wall to the upper one \[m/s, m\].
fn curve(velocity: &Velocity) -> Vec<[f64; 2]> {
    let z = |i: usize| velocity.thickness * i as f64 / POINTS as f64;
    (0..=POINTS).map(z).map(|z| [velocity.at(z), z]).collect()
}
