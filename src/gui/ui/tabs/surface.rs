//! The faces by themselves, below the rotor: contact pressure of the asperities and flow factors over the mean gap.

use crate::analysis::surface::SurfaceCurves;
use crate::digits::significant;
use crate::gui::derived::format::power_of_ten;
use crate::gui::ui::cache::once;
use crate::gui::ui::chart::{Chart, SOLID, WIDTH, dots, legend, line, powers, title};
use crate::gui::ui::context::DrawContext;
use crate::problem::Motor;
use crate::surface::Surface;
use eframe::egui::Ui;
use egui_plot::LineStyle;

/// Shows what there is to show of the faces of a motor; nothing of a hard stop between smooth ones.
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
        flow(ui, &curves, height, cx);
    }
}

fn contact(ui: &mut Ui, curves: &SurfaceCurves, height: f32, cx: &DrawContext<'_>) {
    let name = "Contact pressure of the asperities, MPa";
    title(ui, name, "Asperities");
    let points: Vec<[f64; 2]> = curves.contact.iter().map(|[h, p]| [h * 1e9, (p * 1e-6).log10()]).collect();
    let (Some([near, high]), Some([far, low])) = (points.first().copied(), points.last().copied()) else { return };
    let (bounds, words) = ([[near.min(0.0), far], [low, high + 0.2]], (None, "Asperities"));
    Chart { name, height, bounds, below: "mean gap, nm", words }.show_with(
        ui,
        |plot| {
            plot.y_grid_spacer(|input| powers(&input, 6.0, false))
                .y_axis_formatter(|mark, _| power_of_ten(mark.value.round()))
        },
        |plot| {
            plot.line(line(&points, cx.colours.contact, WIDTH, SOLID));
            if let Some([h, p]) = curves.even {
                plot.points(dots(vec![[h * 1e9, (p * 1e-6).log10()]], cx.colours.film, 4.0));
            }
        },
    );
    if let Some([h, p]) = curves.even {
        let [h, p] = [significant(h * 1e9, 3), significant(p * 1e-6, 3)];
        cx.note(ui, format!("Pressed evenly by the load ({p} MPa) the faces stay {h} nm apart in the mean, the point"));
    }
}

fn flow(ui: &mut Ui, curves: &SurfaceCurves, height: f32, cx: &DrawContext<'_>) {
    let name = "Flow over that between smooth faces";
    title(ui, name, "Flow factors");
    let styles = [(cx.colours.film, SOLID), (cx.colours.rotor, LineStyle::dashed_loose())];
    legend(ui, &[("along the wave", styles[0].0, styles[0].1), ("across the wave", styles[1].0, styles[1].1)]);
    let of = |i: usize| -> Vec<[f64; 2]> { curves.flow.iter().map(|row| [row[0] * 1e9, row[i]]).collect() };
    let lines = [of(1), of(2)];
    let values = || lines.iter().flatten();
    let top = values().map(|point| point[1]).fold(1.0, f64::max);
    let far = values().map(|point| point[0]).fold(0.0, f64::max);
    let (bounds, words) = ([[0.0, far], [0.0, 1.05 * top]], (None, "Flow factors"));
    Chart { name, height, bounds, below: "film thickness, nm", words }.show(ui, |plot| {
        for (points, (colour, style)) in lines.iter().zip(styles) {
            plot.line(line(points, colour, WIDTH, style));
        }
    });
}
