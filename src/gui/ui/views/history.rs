//! The numbers of a start-up over the number of the cycle, with the values of the periodic solve to which they converge.

use super::inset::{Inset, chosen};
use crate::analysis::quantity::{Numbers, Quantity};
use crate::digits::raised;
use crate::estimate::Estimate;
use crate::export::startup::CycleRow;
use crate::gui::command::StartupCommand;
use crate::gui::derived::scales::{span, with_margin};
use crate::gui::state::startup::StartupState;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::PlotStyle;
use crate::gui::ui::plot::{between, dots, level, line, upright};
use crate::job::SolvedScene;
use crate::problem::{Plate, Scenario};
use eframe::egui::{CursorIcon, Rect, Sense, Ui, pos2, vec2};
use egui_plot::{Axis, LineStyle, Span};

/// Least number of cycles that the axis covers.
const FEWEST: usize = 8;
/// Error bands are drawn up to this many times the range of the values, because the errors of the first cycles may be large.
const WIDEST_BAND: f64 = 0.5;

/// A curve over the cycles: its titles, long to short, its glossary term, and a result with the factor from its unit to that of the titles.
type Curve<'a> = ([&'a str; 3], &'static str, (Quantity, f64));

const ALPHA: Curve<'_> =
    (["Film's share of the load α against the cycle", "α against the cycle", "α"], "α", (Quantity::Alpha, 1.0));
const THICKNESS: Curve<'_> =
    (["Least film thickness, µm", "Least h, µm", "h, µm"], "Least film thickness", (Quantity::MinGap, 1e-3));
const PRESSURE: Curve<'_> =
    (["Highest pressure, kPa absolute", "Highest p, kPa", "p, kPa"], "Highest pressure", (Quantity::MaxPressure, 1.0));
/// With less width than this, in lines of text, there is no space for three curves.
const NARROW: f32 = 36.0;

/// Draws the numbers of the start-up into the next `height` of `ui`; a click chooses a cycle. `periodic` is the periodic solve of the same
/// scene.
pub fn show(ui: &mut Ui, startup: &StartupState, periodic: Option<&SolvedScene>, height: f32, cx: &DrawContext<'_>) {
    let style = PlotStyle::new(ui);
    let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let scenario = &startup.transient.posed.problem.scenario;
    let over = if scenario.plate().is_some_and(Plate::is_strip) { "length" } else { "area" };
    let ratio = format!("Load ratio, film load over p_a × {over}, against the cycle");
    let ratio = [ratio.as_str(), "Load ratio against the cycle", "Load ratio"];
    // The curves, and their shares of the width.
    let curves: &[(Curve<'_>, f32)] = match scenario {
        // The text above has the number that is left out.
        Scenario::Motor(_) if area.width() < NARROW * style.row => &[(ALPHA, 0.6), (PRESSURE, 0.4)],
        Scenario::Motor(_) => &[(ALPHA, 0.46), (THICKNESS, 0.27), (PRESSURE, 0.27)],
        // The gap of a plate is prescribed.
        Scenario::Plate(_) => &[((ratio, "Load ratio", (Quantity::LoadRatio, 1.0)), 0.62), (PRESSURE, 0.38)],
    };
    let mut left = area.left();
    for (curve, share) in curves {
        let right = left + share * area.width();
        let rect = Rect::from_min_max(
            pos2(left + style.gutter, area.top() + style.title),
            pos2(right - 0.5 * style.row, area.bottom() - style.axis),
        );
        left = right;
        if rect.width() > 20.0 && rect.height() > 10.0 {
            plot(ui, &style, rect, curve, startup, periodic, cx);
        }
    }
    style.explain(ui);
}

/// One chart. A click, or a drag of its vertical line, chooses the cycle.
fn plot(
    ui: &mut Ui,
    style: &PlotStyle,
    rect: Rect,
    (titles, word, (quantity, factor)): &Curve<'_>,
    startup: &StartupState,
    periodic: Option<&SolvedScene>,
    cx: &DrawContext<'_>,
) {
    let points = &startup.points;
    let of = |numbers: &Numbers| numbers.known(*quantity) * *factor;
    let steady = periodic.map(|run| of(&Numbers::of_outcome(&startup.transient.posed.problem, &run.solution.outcome)));
    let found: Vec<Estimate> = points.iter().map(|row| of(&row.numbers)).collect();
    let [low, high] = span(found.iter().chain(&steady).map(|found| found.value));
    let (film, good) = (style.palette.film, style.palette.good);
    // One curve needs no legend.
    let both = [("each cycle", film), ("periodic solve", good)];
    let legend = if steady.is_some() { &both[..] } else { &[] };
    style.title(rect, word, titles, legend);

    let cap = WIDEST_BAND * (high - low);
    let reach = |error: f64| if error.is_finite() { error.min(cap) } else { cap };
    let name = format!("{}: click to look at a cycle", titles[0]);
    let bounds = [[0.5, points.len().max(FEWEST) as f64 + 0.5], with_margin([low, high], 0.12)];
    let inset = Inset { name: &name, rect, bounds, below: Some("cycle") };
    let present = startup.chosen as f64;
    let shown = inset.show(ui, style, |plot| {
        if let Some(Estimate { value: steady, error }) = steady {
            let band = Span::new("", steady - reach(error)..=steady + reach(error)).axis(Axis::Y);
            plot.span(band.fill(good.gamma_multiply(0.25)));
            plot.hline(level(steady, good, 1.5));
        }
        let means: Vec<[f64; 2]> = points.iter().zip(&found).map(|(row, of)| [row.cycle as f64, of.value]).collect();
        let band = |([x, y], of): (&[f64; 2], &Estimate)| [*x, y + reach(of.error), y - reach(of.error)];
        let bands: Vec<_> = means.iter().zip(&found).map(band).collect();
        plot.add(between(&bands, film.gamma_multiply(0.25)));
        plot.line(line(&means, film, 1.6, LineStyle::Solid));
        // A dot marks a cycle that can be shown.
        let kept = startup.kept().filter_map(|kept| means.get(kept.wrapping_sub(1)).copied());
        plot.points(dots("", kept.collect(), film, 2.0));
        if let Some(at) = means.get(startup.chosen.wrapping_sub(1)) {
            plot.vline(upright(present, style.palette.accent, 1.0));
            plot.points(dots("", vec![*at], style.palette.accent, 4.5));
            plot.points(dots("", vec![*at], film, 3.0));
        }
    });
    let cycle = |x: f64| x.round().max(1.0) as usize;
    if let Some(x) = chosen(ui, &shown, Some(present).filter(|_| startup.chosen > 0), &name) {
        cx.push(StartupCommand::Choose(cycle(x)));
    }
    let response = shown.response.on_hover_cursor(CursorIcon::PointingHand);
    if let Some(row) = shown.inner.and_then(|x| points.get(cycle(x) - 1)) {
        response.on_hover_text_at_pointer(words(row));
    }
}

/// A cycle's numbers in words.
pub fn words(row: &CycleRow) -> String {
    let (name, thickness) = match row.numbers.get(Quantity::Alpha) {
        Some(_) => ("α", format!(", least film thickness {} nm", row.numbers.text(Quantity::MinGap))),
        None => ("load ratio", String::new()),
    };
    let (cycle, main, pressure) = (row.cycle, row.numbers.main(), row.numbers.text(Quantity::MaxPressure));
    raised(&format!("cycle {cycle}: {name} {main}{thickness}, highest pressure {pressure} kPa absolute"))
}
