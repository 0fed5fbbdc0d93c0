//! A fit, or an optimum, as JSON, as CSV and as figures.

use super::csv;
use super::figure::{
    Axis, Colour, Colours, Dash, Figure, Grid, Legend, Line, Map, Mark, Marker, Panel, Points, Provenance, Range,
    Shading, Shape, Style, extent,
};
use crate::analysis::fit::{
    Bound, Fitted, FittedRow, FittedUnknown, Limit, Measured, Measurement, Observable, Optimum, Scan,
};
use crate::estimate::Estimate;
use crate::problem::Problem;
use crate::scene::show_text;
use serde_json::{Value, json};
use std::io::{self, Write};

/// The object of `fit --json`: a fit of the scene `preset`, and the measurements beside computed values. Its numbers are those of
/// [`Fitted`]; unknown values are null.
pub fn object(preset: &str, fitted: &Fitted, measured: &Measured) -> Value {
    json!({
        "preset": preset,
        "data": measured.name,
        "converged": fitted.converged,
        "unknowns": fitted.unknowns.iter().map(unknown).collect::<Vec<_>>(),
        "chi_squared": fitted.chi_squared,
        "degrees_of_freedom": fitted.degrees_of_freedom,
        "errors_known": fitted.errors_known,
        "error_scale": fitted.error_scale,
        "numerical_error": fitted.numerical_error,
        "covariance": fitted.covariance,
        "correlation": fitted.correlation,
        "minima": fitted.minima,
        "rows": rows(fitted, measured),
        "solves": fitted.solves,
        "warnings": fitted.warnings,
    })
}

fn unknown(FittedUnknown { unknown, value, error, at }: &FittedUnknown) -> Value {
    json!({
        "key": unknown.parameter.key,
        "value": value,
        "standard_error": error,
        "start": unknown.start,
        "from": unknown.from,
        "to": unknown.to,
        "at_bound": at.map(Bound::name),
    })
}

/// One object for each measurement, a row of the CSV.
fn rows(fitted: &Fitted, measured: &Measured) -> Vec<Value> {
    let row = |(one, row): (&Measurement, &FittedRow)| {
        let changes =
            measured.conditions[one.condition].iter().map(|(key, value)| format!("{key}={}", show_text(value)));
        let computed = row.computed.as_ref().ok();
        json!({
            "row": one.label,
            // Keys by which its condition differs from the scene, as in `--set`.
            "condition": changes.collect::<Vec<_>>().join(" "),
            "quantity": one.what.name(),
            // The speed of a torque.
            "rotor_speed_rpm": one.what.speed_rpm(),
            "measured": one.value,
            // Its standard error, scaled if it was not given.
            "error": row.error,
            "computed": computed.map(|found| found.value),
            "numerical_error": computed.map(|found| found.error),
            // (computed − measured)/error; null if the measurement was left out.
            "residual": row.residual,
            // `used`, or why it was left out.
            "status": match (&row.computed, row.residual) {
                (_, Some(_)) => "used",
                (Err(why), None) => why,
                (Ok(_), None) => "left out: it could not be computed at the start",
            },
        })
    };
    measured.measurements.iter().zip(&fitted.rows).map(row).collect()
}

/// Writes the measurements beside computed values.
pub fn write_csv(fitted: &Fitted, measured: &Measured, out: &mut dyn Write) -> io::Result<()> {
    csv::rows(rows(fitted, measured), out)
}

/// Greatest number of rows that have names in the figure of residuals.
const MOST_NAMED: usize = 40;

/// The figures of a fit: `fit` (measured and computed values, torques over the speed), `residuals` and, for two or more unknowns,
/// `correlation`.
pub fn figures(problem: &Problem, fitted: &Fitted, measured: &Measured) -> Vec<(&'static str, Figure)> {
    let dressed = |title: &str| Figure { provenance: Provenance::named(&fitted.scene.name), ..Figure::new(title) };
    let mut names: Vec<&str> = measured.measurements.iter().map(|one| one.what.name()).collect();
    names.sort_unstable();
    names.dedup();
    let mut beside = dressed("measured and computed");
    beside.panels = names.into_iter().map(|name| panel(problem, fitted, measured, name)).collect();
    let mut found = vec![("fit", beside), ("residuals", dressed("residuals").panel(residuals(fitted, measured)))];
    if fitted.unknowns.len() > 1 {
        found.push(("correlation", dressed("correlation").panel(correlation(fitted))));
    }
    found
}

/// Panel of the measurements of one name, beside the computed values.
fn panel(problem: &Problem, fitted: &Fitted, measured: &Measured, name: &str) -> Panel {
    let all = || {
        measured
            .measurements
            .iter()
            .zip(&fitted.rows)
            .filter(|(one, _)| one.what.name() == name)
            .filter_map(|(one, row)| Some((one, row, row.computed.as_ref().ok()?.value)))
    };
    let Some((first, ..)) = all().next() else { return Panel::default() };
    let [solid, hollow] = [Marker::solid(Shape::Circle), Marker::hollow(Shape::Circle)];
    let words = first.what.label(problem);
    let (label, unit) = words.split_once(", ").unwrap_or((&words, ""));
    if first.what.speed_rpm().is_some() {
        let speed = |what: Observable| what.speed_rpm().unwrap_or(f64::NAN);
        let [slowest, fastest] = extent(all().map(|(one, ..)| speed(one.what)));
        let room = 0.04 * (fastest - slowest);
        let x = Axis::new("speed of the rotor", "rpm").including([slowest - room, fastest + room]);
        let mut panel = Panel::new("", x, Axis::new(label, unit).including([0.0]));
        for condition in 0..measured.conditions.len() {
            let of_condition = all().filter(|(one, ..)| one.condition == condition);
            let points: Vec<(f64, f64, f64)> =
                of_condition.map(|(one, row, _)| (speed(one.what), one.value, row.error)).collect();
            let style = Style::unmarked(condition);
            let named = if condition == 0 { ["measured", "computed"] } else { ["", ""] };
            // With several conditions, points and curves of the same condition have the same colour.
            let colour = if measured.conditions.len() == 1 { Colour::BLACK } else { style.colour };
            let mut dots = Points::new(named[0], points.iter().map(|point| [point.0, point.1]), colour, hollow);
            dots.errors = points.iter().map(|point| point.2).collect();
            let curve = fitted.curves[condition].iter().copied();
            panel = panel.layer(Line::new(named[1], curve, style)).layer(dots);
        }
        return panel.legend(Legend::Above);
    }
    let ends = all().flat_map(|(one, _, computed)| [one.value, computed]);
    let [least, most] = extent(ends);
    let mut dots = Points::new("", all().map(|(one, _, computed)| [computed, one.value]), Colour::FILM, solid);
    dots.errors = all().map(|(_, row, _)| row.error).collect();
    let room = 0.04 * (most - least);
    let axis = |label: String| Axis::new(label, unit).including([least - room, most + room]);
    Panel::new("", axis(format!("{label}, computed")), axis("measured".to_owned()))
        .layer(Line::new("", [[least, least], [most, most]], Style::quiet()))
        .layer(dots)
}

/// Residuals in standard errors, a line for each measurement.
fn residuals(fitted: &Fitted, measured: &Measured) -> Panel {
    let count = fitted.rows.len();
    // The first one is at the top.
    let place = |i: usize| (count - i) as f64;
    let mut y = Axis::new("", "");
    if count <= MOST_NAMED {
        let names = || measured.measurements.iter().map(|one| one.what.name());
        let several = names().zip(names().skip(1)).any(|(one, next)| one != next);
        // A line of the table may hold several results.
        let label = |one: &Measurement| {
            if several { format!("{}, {}", one.label, one.what.name()) } else { one.label.clone() }
        };
        y.names = measured.measurements.iter().enumerate().map(|(i, one)| (place(i), label(one))).collect();
    }
    let points = fitted.rows.iter().enumerate().filter_map(|(i, row)| Some([row.residual?, place(i)]));
    let widest =
        fitted.rows.iter().filter_map(|row| row.residual).fold(2.0, |widest: f64, one| widest.max(1.1 * one.abs()));
    let x = Axis::new("computed − measured, in standard errors", "").fixed(-widest, widest);
    Panel::new("", x, y.fixed(0.0, count as f64 + 1.0))
        .height((5.0 * count.min(MOST_NAMED) as f64).clamp(25.0, 150.0))
        .layers([-1.0, 0.0, 1.0].map(|x| Mark::vertical(x, "")))
        .layer(Points::new("", points, Colour::FILM, Marker::solid(Shape::Circle)))
}

/// The correlation of every unknown with every other.
fn correlation(fitted: &Fitted) -> Panel {
    let count = fitted.unknowns.len();
    let places: Vec<f64> = (1..=count).map(|i| i as f64).collect();
    // The first unknown is at the top.
    let values = (0..count).flat_map(|x| (0..count).rev().map(move |y| fitted.correlation[x][y])).collect();
    let mut x = Axis::new("unknown", "");
    let mut y = Axis::new("", "");
    x.names = places.iter().map(|place| (*place, place.to_string())).collect();
    y.names = fitted
        .unknowns
        .iter()
        .enumerate()
        .map(|(i, found)| ((count - i) as f64, format!("{} {}", i + 1, found.unknown.parameter.words())))
        .collect();
    Panel::new("", x, y).height(10.0 * count as f64).layer(Map {
        label: "correlation".to_owned(),
        grid: Grid { x: places.clone(), y: places, values },
        colours: Colours::Signed,
        range: Range::Fixed(-1.0, 1.0),
        shading: Shading::Cells,
        ..Map::default()
    })
}

/// The object of `fit --maximise --json` for the scene `preset`. Its numbers are those of [`Optimum`]; unknown values are null.
pub fn optimum(preset: &str, found: &Optimum) -> Value {
    let Optimum { goal, value, before, limited, lines, converged, solves, warnings, .. } = found;
    json!({
        "preset": preset,
        "sought": if goal.greatest { "maximise" } else { "minimise" },
        "quantity": goal.quantity.name(),
        "value": value.value,
        "numerical_error": value.error,
        "before": before.map(|before| before.value),
        "converged": converged,
        "unknowns": lines.iter().map(scan).collect::<Vec<_>>(),
        "flat_share": found.flatness(),
        "limits": goal.limits.iter().enumerate().map(|(i, (one, _))| limit(one, limited.get(i))).collect::<Vec<_>>(),
        "solves": solves,
        "warnings": warnings,
    })
}

fn scan(Scan { unknown, value, at, flat, .. }: &Scan) -> Value {
    json!({
        "key": unknown.parameter.key,
        "value": value,
        "from": unknown.from,
        "to": unknown.to,
        "at_bound": at.map(Bound::name),
        "flat_from": flat.map(|(from, _)| from),
        "flat_to": flat.map(|(_, to)| to),
    })
}

fn limit(limit: &Limit, reached: Option<&Estimate>) -> Value {
    let [value, error] = [reached.map(|reached| reached.value), reached.map(|reached| reached.error)];
    json!({ "limit": limit.to_string(), "value": value, "numerical_error": error })
}

/// Writes the lines through the optimum, one row for each point.
pub fn write_optimum_csv(found: &Optimum, out: &mut dyn Write) -> io::Result<()> {
    let rows = found.lines.iter().flat_map(|line| {
        line.points.iter().zip(&line.kept).map(|((value, computed), kept)| {
            json!({
                "key": line.unknown.parameter.key,
                "value": value,
                "quantity": found.goal.quantity.name(),
                "computed": computed,
                "within_limits": kept,
            })
        })
    });
    csv::rows(rows, out)
}

/// Name of the part of a line through an optimum where a limit is broken.
pub const BEYOND: &str = "beyond";

/// Lines through the optimum, a panel for each unknown; they are dashed where a limit is broken.
pub fn optimum_figure(problem: &Problem, found: &Optimum) -> Figure {
    let (label, unit) = (found.goal.quantity.words(), found.goal.quantity.unit(problem));
    let size = if found.goal.greatest { "large" } else { "small" };
    let limits = found.goal.limits.iter().map(|(limit, _)| limit.to_string()).collect::<Vec<_>>().join(", ");
    let names =
        if limits.is_empty() { [limits.clone(), limits] } else { [format!("within {limits}"), BEYOND.to_owned()] };
    let panel = |line: &Scan| {
        let parameter = line.unknown.parameter;
        let curve = || line.points.iter().map(|(value, computed)| [*value, computed.unwrap_or(f64::NAN)]);
        let within = curve().zip(&line.kept).map(|(point, kept)| if *kept { point } else { [f64::NAN; 2] });
        let x = Axis { scale: line.unknown.scale, ..Axis::new(parameter.words(), parameter.unit) };
        let [kept, beyond] = &names;
        Panel::new("", x, Axis::new(label, unit))
            .layer(Line::new(beyond, curve(), Style::quiet().dash(Dash::Dashed)))
            .layer(Line::new(kept, within, Style::solid(Colour::FILM)))
            .layer(Points::new("", [[line.value, found.value.value]], Colour::CONTACT, Marker::solid(Shape::Diamond)))
    };
    let (panels, provenance) = (found.lines.iter().map(panel).collect(), Provenance::named(&found.scene.name));
    Figure { panels, provenance, ..Figure::new(format!("{label}, as {size} as possible")) }
}
