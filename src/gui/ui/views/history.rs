//! A start-up's numbers against the number of the cycle, with the periodic solve's that they converge to.

use crate::gui::command::StartupCommand;
use crate::gui::derived::format::number;
use crate::gui::derived::scales::span;
use crate::gui::state::startup::{Point, StartupState};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::{Axes, PlotStyle, band};
use crate::job::SolvedScene;
use crate::problem::Scenario;
use crate::solution::{Outcome, PlateResult};
use eframe::egui::{self, CursorIcon, Painter, Pos2, Rect, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Cycles that the axis holds at least.
const FEWEST: usize = 8;
/// Error bands are drawn up to this many times the range of the values: the first ones may be known badly.
const WIDEST_BAND: f64 = 0.5;

/// What a plot shows of a cycle: the value, and its error if one is known.
struct Quantity {
    /// Long to short.
    titles: [&'static str; 3],
    /// What the glossary explains it under.
    word: &'static str,
    unit: f64,
    /// Known with an error.
    extrapolated: bool,
    of: fn(&Outcome, &Scenario) -> (f64, f64),
}

const ALPHA: Quantity = Quantity {
    titles: ["Film's share of the load α against the cycle", "α against the cycle", "α"],
    word: "α",
    unit: 1.0,
    extrapolated: true,
    of: |outcome, scenario| match (outcome, scenario) {
        (Outcome::Motor(result), _) => (result.alpha, result.alpha_error),
        (Outcome::Plate(result), Scenario::Plate(plate)) => {
            (PlateResult::ratio(result.film_load, plate), PlateResult::ratio(result.film_load_error, plate))
        }
        (Outcome::Plate(result), Scenario::Motor(_)) => (result.film_load, result.film_load_error),
    },
};
const RATIO: Quantity = Quantity {
    titles: ["Load ratio, film load over p_a × area, against the cycle", "Load ratio against the cycle", "Load ratio"],
    word: "Load ratio",
    ..ALPHA
};
const THICKNESS: Quantity = Quantity {
    titles: ["Least film thickness, µm", "Least h, µm", "h, µm"],
    word: "Least film thickness",
    unit: 1e-6,
    extrapolated: false,
    of: |outcome, _| match outcome {
        Outcome::Motor(result) => (result.min_gap, 0.0),
        Outcome::Plate(result) => (result.min_gap, 0.0),
    },
};
const PRESSURE: Quantity = Quantity {
    titles: ["Highest pressure, kPa absolute", "Highest p, kPa", "p, kPa"],
    word: "Highest pressure",
    unit: 1e3,
    extrapolated: false,
    of: |outcome, _| match outcome {
        Outcome::Motor(result) => (result.max_pressure, 0.0),
        Outcome::Plate(result) => (result.max_pressure, 0.0),
    },
};
const OF_MOTOR: &[(Quantity, f32)] = &[(ALPHA, 0.46), (THICKNESS, 0.27), (PRESSURE, 0.27)];
/// Without room for three: what is left out is in the words above.
const OF_MOTOR_NARROW: &[(Quantity, f32)] = &[(ALPHA, 0.6), (PRESSURE, 0.4)];
const NARROW: f32 = 36.0;
/// The gap of a plate is given.
const OF_PLATE: &[(Quantity, f32)] = &[(RATIO, 0.62), (PRESSURE, 0.38)];

/// Draws the start-up's numbers into the next `height` of `ui`; a click looks at the cycle there. `periodic`: the periodic
/// solve of the same scene.
pub fn show(ui: &mut Ui, startup: &StartupState, periodic: Option<&SolvedScene>, height: f32, cx: &DrawContext<'_>) {
    let style = PlotStyle::new(ui);
    let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let painter = ui.painter_at(area);
    let gutter = style.width(&painter, "−0.000") + 6.0;
    let scenario = &startup.problem().scenario;
    let quantities = match scenario {
        Scenario::Motor(_) if area.width() < NARROW * style.row => OF_MOTOR_NARROW,
        Scenario::Motor(_) => OF_MOTOR,
        Scenario::Plate(_) => OF_PLATE,
    };
    let mut left = area.left();
    for (quantity, share) in quantities {
        let right = left + share * area.width();
        let rect = Rect::from_min_max(
            pos2(left + gutter, area.top() + style.row + 7.0),
            pos2(right - 0.5 * style.row, area.bottom() - style.row - 3.0),
        );
        left = right;
        if rect.width() > 20.0 && rect.height() > 10.0 {
            let axes = plot(&painter, &style, rect, quantity, startup, periodic);
            choose(ui, &axes, quantity.titles[0], startup, cx);
        }
    }
    style.explain(ui);
}

fn plot(
    painter: &Painter,
    style: &PlotStyle,
    rect: Rect,
    quantity: &Quantity,
    startup: &StartupState,
    periodic: Option<&SolvedScene>,
) -> Axes {
    let scenario = &startup.problem().scenario;
    let points = startup.points();
    let value = |point: &Point| (quantity.of)(&point.outcome, scenario);
    // Extremes are those of one grid, without an error: compared with those of another they would mislead.
    let aim = periodic
        .filter(|run| quantity.extrapolated || run.fidelity == startup.fidelity())
        .map(|run| (quantity.of)(&run.solution.outcome, scenario));
    let [low, high] = span(points.iter().map(|point| value(point).0).chain(aim.map(|aim| aim.0)));
    let margin = 0.12 * (high - low);
    let last = points.len().max(FEWEST) as f64;
    let axes = Axes::new(rect, [0.5, last + 0.5], [low - margin, high + margin]);
    axes.canvas(painter, style);
    axes.y_ticks(painter, style, quantity.unit);
    axes.x_labels(painter, style, 1.0, "cycle");
    let film = style.palette.film;
    // One curve needs no legend.
    let both = [("each cycle", film), ("periodic solve", style.palette.good)];
    let legend = if aim.is_some() { &both[..] } else { &[] };
    style.title(painter, rect, quantity.word, &quantity.titles, legend);

    let inside = &painter.with_clip_rect(painter.clip_rect().intersect(rect));
    let cap = WIDEST_BAND * (high - low);
    let reach = |error: f64| if error.is_finite() { error.min(cap) } else { cap };
    if let Some((aim, error)) = aim {
        let (top, bottom) = (axes.py(aim + reach(error)), axes.py(aim - reach(error)));
        let band = Rect::from_x_y_ranges(rect.x_range(), top..=bottom);
        inside.rect_filled(band, 0.0, style.palette.good.gamma_multiply(0.25));
        inside.hline(rect.x_range(), axes.py(aim), Stroke::new(1.5, style.palette.good));
    }
    let line: Vec<Pos2> = points.iter().map(|point| axes.at(point.number as f64, value(point).0)).collect();
    let columns = points.iter().map(|point| {
        let (value, error) = value(point);
        (axes.px(point.number as f64), axes.py(value + reach(error)), axes.py(value - reach(error)))
    });
    band(inside, columns, film.gamma_multiply(0.25));
    inside.line(line.clone(), Stroke::new(1.6, film));
    // A dot where the cycle can be looked at.
    for kept in startup.kept() {
        if let Some(at) = line.get(kept.wrapping_sub(1)) {
            inside.circle_filled(*at, 2.0, film);
        }
    }
    if let Some(at) = line.get(startup.chosen().wrapping_sub(1)) {
        inside.vline(at.x, rect.y_range(), Stroke::new(1.0, style.palette.accent));
        painter.circle(*at, 4.0, film, Stroke::new(1.5, style.palette.accent));
    }
    axes
}

/// Clicking or dragging looks at the cycle there.
fn choose(ui: &Ui, axes: &Axes, name: &str, startup: &StartupState, cx: &DrawContext<'_>) {
    let name = format!("{name}: click to look at a cycle");
    let response = ui.interact(axes.rect, ui.scope_id().with(&name), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Image, true, &name));
    let response = response.on_hover_cursor(CursorIcon::PointingHand);
    let at = |place: Pos2| {
        axes.x_at(place.x.clamp(axes.rect.left(), axes.rect.right())).map(|x| x.round().max(1.0) as usize)
    };
    if let Some(cycle) = response.interact_pointer_pos().and_then(at)
        && (response.clicked() || response.dragged())
    {
        cx.push(StartupCommand::Choose(cycle));
    }
    let hovered = response.hover_pos().and_then(at).and_then(|cycle| startup.points().get(cycle - 1));
    if let Some(point) = hovered {
        response.on_hover_text_at_pointer(words(point, &startup.problem().scenario));
    }
}

/// A cycle's numbers in words.
pub fn words(point: &Point, scenario: &Scenario) -> String {
    let kilo = |pressure: f64| number(pressure / 1e3);
    match (&point.outcome, scenario) {
        (Outcome::Motor(result), _) => format!(
            "cycle {}: α {:.4} ± {:.1e}, least film thickness {} µm, highest pressure {} kPa absolute",
            point.number,
            result.alpha,
            result.alpha_error,
            number(result.min_gap * 1e6),
            kilo(result.max_pressure),
        ),
        (Outcome::Plate(result), Scenario::Plate(plate)) => format!(
            "cycle {}: load ratio {:.4} ± {:.1e}, highest pressure {} kPa absolute",
            point.number,
            PlateResult::ratio(result.film_load, plate),
            PlateResult::ratio(result.film_load_error, plate),
            kilo(result.max_pressure),
        ),
        (Outcome::Plate(_), Scenario::Motor(_)) => format!("cycle {}", point.number),
    }
}
