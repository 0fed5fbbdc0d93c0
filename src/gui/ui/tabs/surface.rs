//! The faces by themselves, below the rotor: contact pressure of the asperities and flow factors over the mean gap.

use crate::analysis::surface::SurfaceCurves;
use crate::digits::significant;
use crate::export::figure::{Axis, Colour, Dash, Line, Marker, Panel, Points, Style};
use crate::gui::ui::cache::once;
use crate::gui::ui::chart::{Chart, legend, title};
use crate::gui::ui::context::DrawContext;
use crate::problem::Motor;
use crate::surface::Surface;
use eframe::egui::Ui;

/// Shows the curves of the faces of a motor; nothing for smooth faces with a hard stop.
pub(super) fn show(ui: &mut Ui, motor: &Motor, height: f32, cx: &DrawContext<'_>) {
    if motor.surface == Surface::default() {
        return;
    }
    let key = (motor.surface, motor.min_spacing, motor.load);
    let curves = once(ui, "surface curves", key, || SurfaceCurves::of(motor));
    ui.add_space(4.0);
    if !curves.contact.is_empty() {
        contact(ui, &curves, height, cx);
    }
    if !curves.flow.is_empty() {
        flow(ui, &curves, height);
    }
}

fn contact(ui: &mut Ui, curves: &SurfaceCurves, height: f32, cx: &DrawContext<'_>) {
    let name = "Contact pressure of the asperities, MPa";
    title(ui, name, "Asperities");
    let at = |[h, p]: [f64; 2]| [h * 1e9, p * 1e-6];
    let x = Axis::new("mean gap", "nm").including([0.0]);
    let points = curves.contact.iter().map(|point| at(*point));
    let dot = Points::new("", curves.even.map(at), Colour::FILM, Marker::default());
    let panel = Panel::new("", x, Axis::new("", "").log()).layer(Line::new("", points, Style::solid(Colour::CONTACT)));
    Chart { name, height, panel: &panel.layer(dot), words: (None, "Asperities") }.show(ui);
    if let Some([h, p]) = curves.even.map(at) {
        let [h, p] = [h, p].map(|value| significant(value, 3));
        let apart = format!("the faces stay {h} nm apart in the mean: the point in the chart");
        cx.note(ui, format!("Pressed evenly by the load ({p} MPa), {apart}"));
    }
}

fn flow(ui: &mut Ui, curves: &SurfaceCurves, height: f32) {
    let name = "Flow over that between smooth faces";
    title(ui, name, "Flow factors");
    let of = |i: usize| curves.flow.iter().map(move |row| [row[0] * 1e9, row[i]]);
    let x = Axis::new("film thickness", "nm").including([0.0]);
    let panel = Panel::new("", x, Axis::new("", "").including([0.0, 1.0]))
        .layer(Line::new("along the wave", of(1), Style::solid(Colour::FILM)))
        .layer(Line::new("across the wave", of(2), Style::solid(Colour::ROTOR).dash(Dash::Dashed)));
    legend(ui, &[&panel]);
    Chart { name, height, panel: &panel, words: (None, "Flow factors") }.show(ui);
}
