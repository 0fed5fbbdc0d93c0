//! Error against solve time of the present scene, measured on this machine when asked for: each setting a point, the front
//! of those that no other beats, the present setting ringed, and the cheapest that serves a target.

use crate::analysis::attempt::RunStatus;
use crate::analysis::tradeoff::{Candidate, Family, Point, Target, Tradeoff};
use crate::digits::{self, short};
use crate::gui::command::Command;
use crate::gui::derived::format::trimmed;
use crate::gui::derived::scales::span;
use crate::gui::state::dialogs::{Export, Purpose};
use crate::gui::state::tradeoff::{TradeoffState, is_present};
use crate::gui::ui::chart::{axes, key, level, line, numbered, place as chart_place, powers, upright};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::scroll::scrolled;
use crate::gui::ui::table;
use crate::gui::ui::{button, glossary};
use crate::solve::Method;
use eframe::egui::{self, Align2, Color32, RichText, TextStyle};
use egui_plot::{AxisHints, HoverPosition, LineStyle, MarkerShape, PlotPoint, PlotTransform, Points};

/// Height of the plot: its share of the tab, and at least this many lines of text.
const PLOT_SHARE: f32 = 0.56;
const LEAST_LINES: f32 = 12.0;
/// Radius of a point, and of the ring round the present setting.
const RADIUS: f32 = 4.5;
const RING: f32 = 9.0;
/// Around the points, a share of their range.
const MARGIN: egui::Vec2 = egui::vec2(0.12, 0.12);
/// Width of a letter of a name, in heights of the text.
const NAME_WIDTH: f32 = 0.5;
/// Between a number and its unit, which stay on one line.
const NO_BREAK: char = '\u{a0}';
/// Width of a tick's text, in heights of the text.
const TICK_WIDTH: f32 = 5.0;
/// What can be asked for: per cent, and ms.
const ACCURACY: std::ops::RangeInclusive<f64> = 1e-4..=100.0;
const BUDGET: std::ops::RangeInclusive<f64> = 1e-2..=600_000.0;

/// Shows the tab.
pub fn show(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    let height = ui.available_height();
    scrolled(ui, "trade-off", 20.0, |ui| {
        buttons(ui, cx);
        let Some(measured) = &cx.state.tradeoff else {
            cx.introduce(ui, INTRODUCTION);
            return;
        };
        state(ui, measured, cx);
        let tradeoff = &measured.tradeoff;
        if !tradeoff.points.iter().any(|point| place(point).is_some()) {
            return;
        }
        legend(ui, tradeoff, cx);
        let least = LEAST_LINES * ui.text_style_height(&TextStyle::Body);
        plot(ui, tradeoff, (PLOT_SHARE * height).max(least), cx);
        ui.add_space(4.0);
        for target in [Target::Accuracy(cx.state.view.accuracy), Target::Budget(cx.state.view.budget)] {
            advice(ui, tradeoff, target, cx);
        }
        ui.add_space(6.0);
        table(ui, tradeoff, cx);
        ui.add_space(8.0);
    });
}

fn buttons(ui: &mut egui::Ui, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        let running = cx.state.tradeoff.as_ref().filter(|measured| measured.work.running());
        match running {
            Some(measured) => {
                let hover = "Ends it; what was measured stays";
                cx.button(ui, "Cancel the measurement", hover, Command::CancelMeasure);
                let (share, left) = (measured.share, measured.left(cx.now));
                cx.progress(ui, 140.0, share, &format!("{:.0} %", 100.0 * share), left);
            }
            None => {
                let about = "Takes up to about a minute; the window stays usable";
                if button::first(ui, "Measure", (cx.state.tradeoff.as_ref().is_none(), true), cx).hint(about).clicked()
                {
                    cx.push(Command::Measure);
                }
            }
        }
        if running.is_none() && cx.state.can_export(Export::TradeoffTable) {
            for (text, export) in [("Export CSV…", Export::TradeoffTable), ("Export figure…", Export::TradeoffFigure)]
            {
                cx.button(ui, text, export.about(), Command::Ask(Purpose::Export(export)));
            }
        }
    });
}

/// What stands in the tab while there is nothing to see.
const INTRODUCTION: &[&str] = &[
    "How exact can this scene be solved, and how fast, on this machine?",
    "Each fidelity, some grids beside them and the method of the paper on its meshes are timed in turn, in the \
         background, and judged by the error of α (of a plate, of the film load). Nothing is measured before you ask.",
];

/// Of what, and whether that still is the scene.
fn state(ui: &mut egui::Ui, measured: &TradeoffState, cx: &DrawContext<'_>) {
    if measured.stale(cx.state.document.scene()) {
        let text = format!("Measured on “{}” before the scene changed; measure again", measured.scene.name);
        cx.say(ui, text, cx.colours.alarm);
    } else if measured.work.cancelled {
        let text = if measured.work.running() { "Ending…" } else { "Cancelled; this was measured until then" };
        cx.note(ui, text);
    }
    if let Some(failure) = &measured.failure {
        cx.say(ui, format!("The measurement failed: {failure}"), cx.colours.alarm);
    }
    let usable = |point: &&Point| matches!(point.run.status, RunStatus::Waiting | RunStatus::Converged);
    let unconverged = measured.tradeoff.points.iter().filter(|point| !usable(point)).count();
    if unconverged > 0 {
        let text = format!("{unconverged} of the settings did not converge: they are in the table only");
        cx.note(ui, text);
    }
}

/// Whether the window solves with just this setting.
fn in_use(candidate: &Candidate, cx: &DrawContext<'_>) -> bool {
    is_present(candidate, cx.state.document.target(), cx.state.document.scene().numerics())
}

/// Where the families stand, in colour and shape.
fn style(family: Family, cx: &DrawContext<'_>) -> (&'static str, Color32, MarkerShape) {
    match family {
        Family::Fidelity => ("fidelities", cx.colours.film, MarkerShape::Circle),
        Family::Grid => ("other grids", cx.colours.good, MarkerShape::Up),
        Family::Paper => ("the paper's method", cx.colours.contact, MarkerShape::Square),
    }
}

fn legend(ui: &mut egui::Ui, tradeoff: &Tradeoff, cx: &DrawContext<'_>) {
    let em = ui.text_style_height(&TextStyle::Body);
    ui.horizontal_wrapped(|ui| {
        let shown = |family: &Family| tradeoff.points.iter().any(|point| point.run.candidate.family == *family);
        for family in [Family::Fidelity, Family::Grid, Family::Paper].into_iter().filter(shown) {
            let (name, colour, shape) = style(family, cx);
            sign(ui, name, |painter, at| match shape {
                MarkerShape::Square => {
                    painter.rect_filled(egui::Rect::from_center_size(at, egui::Vec2::splat(1.6 * RADIUS)), 0, colour);
                }
                MarkerShape::Up => {
                    let corner = |x: f32, y: f32| at + RADIUS * egui::vec2(x, y);
                    let corners = vec![corner(0.0, -1.1), corner(1.0, 0.8), corner(-1.0, 0.8)];
                    painter.add(egui::Shape::convex_polygon(corners, colour, egui::Stroke::NONE));
                }
                _ => drop(painter.circle_filled(at, RADIUS, colour)),
            });
        }
        sign(ui, "present setting", |painter, at| {
            painter.circle_stroke(at, 0.6 * RING, egui::Stroke::new(2.0, cx.colours.accent));
        });
        sign(ui, "best", |painter, at| {
            let end = egui::vec2(0.5 * em, 0.0);
            let stroke = egui::Stroke::new(1.5, cx.colours.quiet);
            painter.extend(egui::Shape::dashed_line(&[at - end, at + end], stroke, 4.0, 3.0));
        });
    });
}

/// An entry of the legend, whose sign is drawn round a place.
fn sign(ui: &mut egui::Ui, text: &str, draw: impl FnOnce(&egui::Painter, egui::Pos2)) {
    key(ui, text, 1.3, 0.0, |painter, left, em| draw(painter, left + egui::vec2(0.5 * em, 0.0)));
}

/// log₁₀ of time \[s\] and of the error \[%\]; `None` without either.
fn place(point: &Point) -> Option<[f64; 2]> {
    let [time, error] = [point.median, 100.0 * point.error?].map(f64::log10);
    (time.is_finite() && error.is_finite()).then_some([time, error])
}

fn plot(ui: &mut egui::Ui, tradeoff: &Tradeoff, height: f32, cx: &DrawContext<'_>) {
    let judged = format!("error of {}", tradeoff.of_what());
    let grid = ui.visuals().widgets.noninteractive.bg_stroke.color;
    let em = ui.text_style_height(&TextStyle::Body);
    let width = ui.available_width();
    let most = f64::from((width / (TICK_WIDTH * em)).floor().max(2.0));
    let whole = chart_place(ui, height);
    // For screen readers the table below says it all.
    let plot = numbered("trade-off plot", height, [AxisHints::new_x(), AxisHints::new_y()])
        .show_x(true)
        .show_y(true)
        .grid_color(grid)
        .x_axis_label("solve time")
        .y_axis_label(judged.as_str())
        .x_grid_spacer(move |input| powers(&input, most, true))
        .y_grid_spacer(|input| powers(&input, 12.0, true))
        .x_axis_formatter(|mark, _| duration(10f64.powf(mark.value)))
        .y_axis_formatter(|mark, _| percent(10f64.powf(mark.value - 2.0)))
        .label_formatter(|at| match at {
            HoverPosition::NearDataPoint { plot_name, .. } if !plot_name.is_empty() => {
                let point = tradeoff.points.iter().find(|point| point.run.candidate.name == *plot_name)?;
                let error = point.error.map_or_else(String::new, |error| format!("\nerror {}", percent(error)));
                Some(format!("{plot_name}{error}\ntime {}", duration(point.median)))
            }
            _ => None,
        })
        .set_margin_fraction(MARGIN);
    let shown_plot = plot.show(ui, |plot| {
        let guide = LineStyle::dashed_loose();
        let quiet = cx.colours.quiet;
        let within = |low: f64, value: f64, high: f64| value > low && value < high;
        let range = |axis: usize| span(tradeoff.points.iter().filter_map(place).map(|at| at[axis]));
        let ([left, right], [bottom, top]) = (range(0), range(1));
        // Room for the names, at the left of their points.
        for point in tradeoff.points.iter().filter(|point| point.run.candidate.family == Family::Fidelity) {
            let letters = point.run.candidate.name.len() as f32;
            if let Some([time, error]) = place(point) {
                let room = f64::from(NAME_WIDTH * em * letters / width) * (right - left);
                plot.points(Points::new("", vec![[time - room, error]]).radius(0.0).allow_hover(false));
            }
        }
        // Wishes beyond all points would only squeeze them together.
        let (accuracy, budget) = ((100.0 * cx.state.view.accuracy).log10(), cx.state.view.budget.log10());
        if within(bottom, accuracy, top) {
            plot.hline(level(accuracy, quiet, 1.0).style(guide));
        }
        if within(left, budget, right) {
            plot.vline(upright(budget, quiet, 1.0).style(guide));
        }
        let mut front: Vec<[f64; 2]> = tradeoff.points.iter().filter(|p| p.best).filter_map(place).collect();
        front.sort_by(|a, b| a[0].total_cmp(&b[0]));
        plot.line(line(&front, quiet, 1.5, LineStyle::dashed_dense()));
        for point in &tradeoff.points {
            let Some([time, error]) = place(point) else { continue };
            let candidate = &point.run.candidate;
            let (_, colour, shape) = style(candidate.family, cx);
            let (low, high) = point.quartiles;
            if low > 0.0 && high > low {
                let bar = [[low.log10(), error], [high.log10(), error]];
                plot.line(line(&bar, colour, 1.0, LineStyle::Solid));
            }
            plot.points(
                Points::new(candidate.name.clone(), vec![[time, error]]).color(colour).shape(shape).radius(RADIUS),
            );
            if in_use(candidate, cx) {
                let ring = Points::new("", vec![[time, error]]).color(cx.colours.accent).radius(RING).filled(false);
                plot.points(ring.allow_hover(false));
            }
        }
    });
    names(ui, tradeoff, &shown_plot.transform, cx);
    axes(ui, whole, *shown_plot.transform.frame(), Some("Solve time"), &judged);
}

/// Names of the fidelities, below and left of their points, right of them at the edge, where a point of the front has no other; names that
/// would lie on each other, one below the other.
fn names(ui: &egui::Ui, tradeoff: &Tradeoff, transform: &PlotTransform, cx: &DrawContext<'_>) {
    let painter = ui.painter_at(*transform.frame());
    let (font, colour) = (TextStyle::Body.resolve(ui.style()), style(Family::Fidelity, cx).1);
    let fidelities = tradeoff.points.iter().filter(|point| point.run.candidate.family == Family::Fidelity);
    let mut places: Vec<_> = fidelities.filter_map(|point| Some((point, place(point)?))).collect();
    places.sort_by(|(_, a), (_, b)| b[1].total_cmp(&a[1]));
    let mut taken: Vec<egui::Rect> = Vec::new();
    for (point, [time, error]) in places {
        let galley = painter.layout_no_wrap(point.run.candidate.name.clone(), font.clone(), colour);
        let at = transform.position_from_point(&PlotPoint::new(time, error));
        let mut rect = Align2::RIGHT_TOP.anchor_size(at + egui::vec2(-RADIUS, RADIUS), galley.size());
        if rect.left() < transform.frame().left() {
            rect = Align2::LEFT_TOP.anchor_size(at + egui::Vec2::splat(RADIUS), galley.size());
        }
        while let Some(other) = taken.iter().find(|other| other.intersects(rect)) {
            rect = rect.translate(egui::vec2(0.0, other.bottom() - rect.top() + 1.0));
        }
        painter.galley(rect.min, galley, colour);
        taken.push(rect);
    }
}

/// A target, what serves it, and the way to use that.
fn advice(ui: &mut egui::Ui, tradeoff: &Tradeoff, target: Target, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        let (name, mut value, unit, range, about) = match target {
            Target::Accuracy(share) => {
                ("Accuracy", 100.0 * share, " %", ACCURACY, "The cheapest with at most this error")
            }
            Target::Budget(time) => ("Budget", 1e3 * time, " ms", BUDGET, "The most accurate within this time"),
        };
        let label = glossary::term(ui, name, name);
        let speed = 0.01 * value;
        let drag = egui::DragValue::new(&mut value)
            .suffix(unit)
            .range(range)
            .speed(speed)
            .custom_formatter(|value, _| short(value, 3));
        if ui.add(drag).labelled_by(label.id).hint(about).changed() {
            cx.push(Command::Target(match target {
                Target::Accuracy(_) => Target::Accuracy(1e-2 * value),
                Target::Budget(_) => Target::Budget(1e-3 * value),
            }));
        }
        let Some(point) = tradeoff.choose(target).and_then(|i| tradeoff.points.get(i)) else {
            ui.add(egui::Label::new(RichText::new("no setting serves").color(cx.colours.alarm)));
            return;
        };
        let candidate = &point.run.candidate;
        let error = point.error.map_or_else(String::new, |error| format!(", error at most {}", percent(error)));
        ui.add(egui::Label::new(format!("→ {}: {}{error}", candidate.name, duration(point.median))).wrap());
        if in_use(candidate, cx) {
            ui.label(RichText::new("in use").color(cx.colours.good));
            return;
        }
        let ours = candidate.settings.method == Method::Auto;
        let button = ui.add_enabled(ours, egui::Button::new("Use it"));
        let button = button.on_disabled_hover_text("The window solves by its own method only");
        let named = button.accessible_name(format!("Use it for the {}", name.to_lowercase()));
        if named.hint("One edit, undone like any other").clicked() {
            cx.push(Command::Use { target: candidate.settings.fidelity, numerics: candidate.numerics });
        }
    });
}

/// Every setting in words, the fastest first.
fn table(ui: &mut egui::Ui, tradeoff: &Tradeoff, cx: &DrawContext<'_>) {
    let mut order: Vec<&Point> = tradeoff.points.iter().collect();
    order.sort_by(|a, b| a.median.total_cmp(&b.median));
    table::table(ui, "settings", 4, 14.0, |ui| {
        let heads = [("Setting", "Setting"), ("Time", "Solve time"), ("Error", "Stated error"), ("", "")];
        table::heads(ui, &heads, cx.colours.quiet);
        ui.end_row();
        for point in order {
            let candidate = &point.run.candidate;
            let (family, colour, _) = style(candidate.family, cx);
            glossary::term(ui, RichText::new(&candidate.name).color(colour), family);
            ui.label(if point.median.is_finite() { duration(point.median) } else { "…".to_owned() });
            ui.label(point.error.map_or_else(String::new, percent));
            let mut marks = Vec::new();
            match &point.run.status {
                RunStatus::Waiting | RunStatus::Converged => {}
                RunStatus::Failed(_) => marks.push("failed".to_owned()),
                other => marks.push(other.to_string()),
            }
            if point.best {
                marks.push("best".to_owned());
            }
            if in_use(candidate, cx) {
                marks.push("in use".to_owned());
            }
            let marks = ui.label(RichText::new(marks.join(", ")).color(cx.colours.quiet));
            if let RunStatus::Failed(reason) = &point.run.status {
                marks.hint(reason);
            }
            ui.end_row();
        }
    });
}

/// A time in the unit that suits it, three digits.
fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 0.9995e-3 => (1e6 * s, "µs"),
        s if s < 0.9995 => (1e3 * s, "ms"),
        s if s < 99.5 => (s, "s"),
        s => (s / 60.0, "min"),
    };
    format!("{}{NO_BREAK}{unit}", short(value, 3))
}

/// A share in per cent, two digits, written out however small.
fn percent(share: f64) -> String {
    format!("{}{NO_BREAK}%", trimmed(digits::percent(share).trim_end_matches(" %")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_unit_that_suits_them() {
        for (seconds, text) in [(1e-4, "100 µs"), (1e-3, "1 ms"), (0.0161, "16.1 ms"), (1.0, "1 s"), (150.0, "2.5 min")]
        {
            assert_eq!(duration(seconds), text.replace(' ', "\u{a0}"));
        }
        let percents = [percent(0.01), percent(0.0213), percent(1e-6)];
        assert_eq!(percents, ["1\u{a0}%", "2.1\u{a0}%", "0.0001\u{a0}%"]);
    }
}
