//! Error against time as JSON and as CSV, with the same names, and as a figure.

use crate::analysis::quantity::Quantity;
use crate::analysis::tradeoff::{Family, Target, Tradeoff, TradeoffPoint};
use crate::export::figure::{
    Axis, Colour, Dash, Figure, Legend, Line, Marker, Panel, Points, Provenance, Shape, Style, Text,
};
use serde_json::{Value, json};

/// The object of `--json`: the settings of a scene, and those that meet the targets, if there are any.
pub fn object(preset: &str, tradeoff: &Tradeoff, targets: &[Target]) -> Value {
    json!({
        "preset": preset,
        "judged": tradeoff.judged.name(),
        "reference": tradeoff.reference.map(|i| &tradeoff.points[i].run.candidate.name),
        "settings": settings(tradeoff),
        "chosen": targets.iter().map(|target| choice(tradeoff, *target)).collect::<Vec<_>>(),
    })
}

/// The target, a share or a time \[s\], and the setting that meets it with its options on the command line; null if none does.
fn choice(tradeoff: &Tradeoff, target: Target) -> Value {
    let chosen = tradeoff.choose(target).map(|i| &tradeoff.points[i].run.candidate);
    let (wish, value) = match target {
        Target::Accuracy(share) => ("accuracy", share),
        Target::Budget(seconds) => ("budget_s", seconds),
    };
    let [setting, options] = [chosen.map(|candidate| &candidate.name), chosen.map(|candidate| &candidate.options)];
    json!({ "wish": wish, "value": value, "setting": setting, "options": options })
}

/// One object for each setting, a row of the CSV, in the order of the curve. Unknown values are null, or empty.
pub fn settings(tradeoff: &Tradeoff) -> Vec<Value> {
    let setting = |(i, point): (usize, &TradeoffPoint)| {
        let run = &point.run;
        let count = |quantity| run.numbers.get(quantity).map(|count| count as u64);
        json!({
            "setting": run.candidate.name,
            // `fidelity`, `grid` or `paper`.
            "family": run.candidate.family,
            // `converged`, `not converged`, `given up`, `failed: …`, or `waiting`.
            "status": run.status.to_string(),
            "median_s": point.median,
            "lower_quartile_s": point.quartiles.0,
            "upper_quartile_s": point.quartiles.1,
            "runs": run.times.len(),
            "value": run.numbers.get(tradeoff.judged),
            // The greater of the next two, by which the setting is judged.
            "error": point.error,
            // Distance from the reference plus the reference's own stated error, relative.
            "measured_error": point.measured,
            // Its stated error, relative.
            "stated_error": point.stated,
            // Whether no other setting is both faster and more accurate.
            "pareto": point.best,
            // Whether the others are judged by this setting.
            "reference": tradeoff.reference == Some(i),
            "film_nodes": run.grid.0,
            "steps_per_cycle": run.grid.1,
            "film_steps": count(Quantity::FilmSteps),
            "coupling_iterations": count(Quantity::Rounds),
            "contact_solves": count(Quantity::ContactSolves),
            "options": run.candidate.options,
        })
    };
    tradeoff.points.iter().enumerate().map(setting).collect()
}

/// Name of a family of settings, and its colour.
pub fn words(family: Family) -> (&'static str, Colour) {
    match family {
        Family::Fidelity => ("fidelities", Colour::FILM),
        Family::Grid => ("other grids", Colour::CYCLE[2]),
        Family::Paper => ("the paper's method", Colour::CONTACT),
    }
}

/// Error against time, both logarithmic: the error that each setting is judged by, the front of the settings that no other beats, names at
/// the fidelities, and rings with this name and colour round some settings.
pub fn panel(tradeoff: &Tradeoff, (name, colour, chosen): (&str, Colour, &[usize])) -> Panel {
    let place = |point: &TradeoffPoint| Some([point.median, 100.0 * point.error?]);
    let label = format!("error of {}", tradeoff.of_what());
    // Room for points and names at the ends.
    let times = || tradeoff.points.iter().map(|point| point.median).filter(|time| time.is_finite());
    let room = [times().fold(f64::INFINITY, f64::min) / 1.5, times().fold(0.0, f64::max) * 3.0];
    let time = Axis::new("solve time", "s").log().including(room.into_iter().filter(|end| *end > 0.0));
    let mut front: Vec<[f64; 2]> = tradeoff.points.iter().filter(|point| point.best).filter_map(place).collect();
    front.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let families = [(Family::Fidelity, Shape::Circle), (Family::Grid, Shape::Triangle), (Family::Paper, Shape::Square)];
    let families = families.into_iter().map(|(family, shape)| {
        let (of_family, colour) = words(family);
        let members = tradeoff.points.iter().filter(|point| point.run.candidate.family == family);
        Points::new(of_family, members.filter_map(place), colour, Marker::solid(shape))
    });
    let rings = chosen.iter().filter_map(|i| tradeoff.points.get(*i)).filter_map(place);
    let rings = Points::new(name, rings, colour, Marker { size: 9.0, ..Marker::hollow(Shape::Circle) });
    let there = |points: &Points| !points.points.is_empty();
    let named = tradeoff.points.iter().filter(|point| point.run.candidate.family == Family::Fidelity);
    Panel::new("", time, Axis::new(label, "%").log())
        .height(60.0)
        // Inside the axes, the symbols of the legend could be taken for settings, and settings for symbols.
        .legend(Legend::Above)
        .layer(Line::new("best", front, Style::quiet().dash(Dash::Dashed)))
        // The rings are below the points, so that the points remain visible.
        .layers(std::iter::once(rings).chain(families).filter(there))
        .layers(named.filter_map(|point| Some(Text::new(place(point)?, point.run.candidate.name.clone()))))
}

/// Error against time as a figure, with rings round the settings in `chosen`.
pub fn figure(preset: &str, tradeoff: &Tradeoff, chosen: &[usize]) -> Figure {
    let panel = panel(tradeoff, ("serves what was asked for", Colour::BLACK, chosen));
    let runs: usize = tradeoff.points.iter().map(|point| point.run.times.len()).sum();
    let provenance = Provenance {
        note: format!("medians of {runs} runs of {} settings", tradeoff.points.len()),
        ..Provenance::named(preset)
    };
    Figure { provenance, ..Figure::default() }.panel(panel)
}
