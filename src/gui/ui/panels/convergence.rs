//! How the residual fell, round by round.

use crate::control::Progress;
use crate::gui::derived::format::power_of_ten;
use crate::gui::ui::chart::{level, line, numbered, powers, whole};
use crate::gui::ui::context::DrawContext;
use eframe::egui;
use egui_plot::{AxisHints, LineStyle, PlotPoints, Points};

/// Height of the plot, in lines of text.
const HEIGHT: f32 = 9.0;
/// At most this many ticks on an axis.
const TICKS: f64 = 5.0;

/// Shows the rounds of `history`: one line for each grid, and dashed what each had to fall below.
pub fn show(ui: &mut egui::Ui, history: &[Progress], cx: &DrawContext<'_>) {
    let history = Progress::last_solve(history);
    let grids = Progress::grids(history).count();
    let height = HEIGHT * ui.text_style_height(&egui::TextStyle::Body);
    let plot = numbered("convergence", height, [AxisHints::new_x(), AxisHints::new_y()])
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
            plot.hline(level(tolerance.log10(), cx.colours.quiet, 1.0).style(LineStyle::dashed_dense()));
        }
        for (grid, points) in lines(history).into_iter().enumerate() {
            let share = (grid + 1) as f32 / grids as f32;
            let colour = cx.colours.film.gamma_multiply(0.35 + 0.65 * share);
            let name = format!("grid {} of {grids}", grid + 1);
            plot.line(line(&points, colour, 1.5, LineStyle::Solid));
            plot.points(Points::new(name, PlotPoints::from(points)).color(colour).radius(2.5));
        }
    });
}

/// The rounds of each grid: number among all rounds, from 1, and log₁₀ of the residual. A residual of 0 has no place.
fn lines(history: &[Progress]) -> Vec<Vec<[f64; 2]>> {
    let mut numbers = 1..;
    let mut place = |round: &Progress| Some([numbers.next()? as f64, round.residual.log10()]);
    let placed = Progress::grids(history).map(|rounds| rounds.iter().filter_map(&mut place).collect::<Vec<_>>());
    placed.map(|points| points.into_iter().filter(|[_, y]| y.is_finite()).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_grid_has_a_line_and_a_residual_of_zero_is_left_out() {
        let round = |level, iteration, residual| Progress {
            level,
            levels: 2,
            iteration,
            residual,
            tolerance: 1e-6,
            film_load: 0.0,
        };
        let history = [round(0, 1, 1e-2), round(0, 2, 0.0), round(1, 1, 1e-4), round(1, 1, 1e-5)];
        assert_eq!(lines(&history), [[[1.0, -2.0]], [[3.0, -4.0]], [[4.0, -5.0]]]);
    }
}
