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
use crate::problem::Scenario;
use eframe::egui::{CursorIcon, Rect, Sense, Ui, pos2, vec2};
use egui_plot::{Axis, LineStyle, Span};

/// Least number of cycles that the axis covers.
const FEWEST: usize = 8;
/// Error bands are drawn up to this many times the range of the values, because the errors of the first cycles may be large.
const WIDEST_BAND: f64 = 0.5;

/// Curve of a plot over the cycles: a result, times a factor.
struct Curve {
    /// Titles, long to short.
    titles: [&'static str; 3],
    /// Its glossary term.
    word: &'static str,
    of: (Quantity, f64),
}

const ALPHA: Curve = Curve {
    titles: ["Film's share of the load α against the cycle", "α against the cycle", "α"],
    word: "α",
    of: (Quantity::Alpha, 1.0),
};
const RATIO: Curve = Curve {
    titles: ["Load ratio, film load over p_a × area, against the cycle", "Load ratio against the cycle", "Load ratio"],
    word: "Load ratio",
    of: (Quantity::LoadRatio, 1.0),
};
const RATIO_OF_STRIP: Curve = Curve {
    titles: [
        "Load ratio, film load over p_a × length, against the cycle",
        "Load ratio against the cycle",
        "Load ratio",
    ],
    ..RATIO
};
const THICKNESS: Curve = Curve {
    titles: ["Least film thickness, µm", "Least h, µm", "h, µm"],
    word: "Least film thickness",
    of: (Quantity::MinGap, 1e-3),
};
const PRESSURE: Curve = Curve {
    titles: ["Highest pressure, kPa absolute", "Highest p, kPa", "p, kPa"],
    word: "Highest pressure",
    of: (Quantity::MaxPressure, 1.0),
};
const OF_MOTOR: &[(Curve, f32)] = &[(ALPHA, 0.46), (THICKNESS, 0.27), (PRESSURE, 0.27)];
/// The curves where there is no space for three; the text above has the number that is left out.
const OF_MOTOR_NARROW: &[(Curve, f32)] = &[(ALPHA, 0.6), (PRESSURE, 0.4)];
const NARROW: f32 = 36.0;
/// The gap of a plate is prescribed.
const OF_PLATE: &[(Curve, f32)] = &[(RATIO, 0.62), (PRESSURE, 0.38)];
const OF_STRIP: &[(Curve, f32)] = &[(RATIO_OF_STRIP, 0.62), (PRESSURE, 0.38)];

/// Draws the numbers of the start-up into the next `height` of `ui`; a click chooses a cycle. `periodic` is the periodic solve of the same
/// scene.
pub fn show(ui: &mut Ui, startup: &StartupState, periodic: Option<&SolvedScene>, height: f32, cx: &DrawContext<'_>) {
    let style = PlotStyle::new(ui);
    let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let curves = match &startup.posed.problem.scenario {
        Scenario::Motor(_) if area.width() < NARROW * style.row => OF_MOTOR_NARROW,
        Scenario::Motor(_) => OF_MOTOR,
        Scenario::Plate(plate) if plate.is_strip() => OF_STRIP,
        Scenario::Plate(_) => OF_PLATE,
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
    curve: &Curve,
    startup: &StartupState,
    periodic: Option<&SolvedScene>,
    cx: &DrawContext<'_>,
) {
    let points = &startup.points;
    let of = |numbers: &Numbers| numbers.known(curve.of.0) * curve.of.1;
    let steady = periodic.map(|run| of(&Numbers::of_outcome(&startup.posed.problem, &run.solution.outcome)));
    let found: Vec<Estimate> = points.iter().map(|row| of(&row.numbers)).collect();
    let [low, high] = span(found.iter().chain(&steady).map(|found| found.value));
    let (film, good) = (style.palette.film, style.palette.good);
    // One curve needs no legend.
    let both = [("each cycle", film), ("periodic solve", good)];
    let legend = if steady.is_some() { &both[..] } else { &[] };
    style.title(rect, curve.word, &curve.titles, legend);

    let cap = WIDEST_BAND * (high - low);
    let reach = |error: f64| if error.is_finite() { error.min(cap) } else { cap };
    let name = format!("{}: click to look at a cycle", curve.titles[0]);
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
