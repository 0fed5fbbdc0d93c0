//! How the residual fell, round by round.

use crate::control::Progress;
use crate::gui::derived::format::power_of_ten;
use crate::gui::ui::chart::{bare, line, powers, whole};
use crate::gui::ui::context::DrawContext;
use eframe::egui;
use egui_plot::{HLine, LineStyle, PlotPoints, Points};

/// Height of the plot, in lines of text.
const HEIGHT: f32 = 9.0;
/// At most this many ticks on an axis.
const TICKS: f64 = 5.0;

/// Shows the rounds of `history`: one line for each grid, and dashed what each had to fall below.
pub fn show(ui: &mut egui::Ui, history: &[Progress], cx: &DrawContext<'_>) {
    let grids = history.iter().map(|progress| progress.level).max().map_or(0, |level| level + 1);
    let height = HEIGHT * ui.text_style_height(&egui::TextStyle::Body);
    let plot = bare("convergence", height)
        .x_axis_label("round")
        .y_axis_label("relative change")
        .y_grid_spacer(|input| powers(&input, TICKS, false))
        .y_axis_formatter(|mark, _| power_of_ten(mark.value))
        .x_grid_spacer(|input| {
            let mut ticks = whole(&input, TICKS);
            ticks.retain(|tick| tick.value >= 1.0);
            ticks
        })
        .x_axis_formatter(|mark, _| format!("{}", mark.value))
        .label_formatter(|at| match at {
            egui_plot::HoverPosition::NearDataPoint { plot_name, position, .. } if !plot_name.is_empty() => {
                Some(format!("{plot_name}\nround {}\nchange {:.1e}", position.x, 10f64.powf(position.y)))
            }
            _ => None,
        })
        .set_margin_fraction(egui::vec2(0.05, 0.1));
    plot.show(ui, |plot| {
        let mut tolerances: Vec<f64> = Vec::new();
        for progress in history.iter().filter(|progress| progress.tolerance > 0.0) {
            if !tolerances.contains(&progress.tolerance) {
                tolerances.push(progress.tolerance);
            }
        }
        for tolerance in tolerances {
            plot.hline(
                HLine::new("", tolerance.log10())
                    .color(cx.colours.quiet)
                    .width(1.0)
                    .style(LineStyle::dashed_dense())
                    .allow_hover(false),
            );
        }
        for grid in 0..grids {
            let points = rounds(history, grid);
            let share = (grid + 1) as f32 / grids as f32;
            let colour = cx.colours.film.gamma_multiply(0.35 + 0.65 * share);
            let name = format!("grid {} of {grids}", grid + 1);
            plot.line(line(&points, colour, 1.5, LineStyle::Solid));
            plot.points(Points::new(name, PlotPoints::from(points)).color(colour).radius(2.5));
        }
    });
}

/// The rounds of one grid: number among all rounds, from 1, and log₁₀ of the residual. A residual of 0 has no place.
fn rounds(history: &[Progress], grid: usize) -> Vec<[f64; 2]> {
    let numbered = history.iter().enumerate().filter(|(_, progress)| progress.level == grid);
    numbered
        .filter(|(_, progress)| progress.residual.is_finite() && progress.residual > 0.0)
        .map(|(round, progress)| [(round + 1) as f64, progress.residual.log10()])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_residual_of_zero_is_left_out() {
        let round =
            |level, residual| Progress { level, levels: 2, iteration: 1, residual, tolerance: 1e-6, film_load: 0.0 };
        let history = [round(0, 1e-2), round(0, 0.0), round(1, 1e-4)];
        assert_eq!(rounds(&history, 0), [[1.0, -2.0]]);
        assert_eq!(rounds(&history, 1), [[3.0, -4.0]]);
    }
}
