//! A fit, or an optimum, as JSON, as CSV and as figures.

use super::csv;
use super::estimates::finite;
use super::figure::{
    Axis, Colour, Colours, Figure, Grid, Legend, Line, Map, Mark, Marker, Panel, Points, Provenance, Range, Shading,
    Shape, Style, extent,
};
use crate::analysis::fit::{Fitted, Measured, Minimum, Observable, Optimum};
use crate::estimate::Estimate;
use crate::problem::Problem;
use crate::scene::show_text;
use serde::Serialize;
use std::borrow::Cow;
use std::io::{self, Write};

/// The object of `fit --json`: what the unknowns are, how sure, and what the measurements are beside what is computed.
#[derive(Clone, Debug, Serialize)]
pub struct Object<'a> {
    /// Name of the scene that was fitted.
    pub preset: &'a str,
    /// Name of the table of measurements.
    pub data: &'a str,
    /// Whether the search ended at a minimum.
    pub converged: bool,
    /// The unknowns.
    pub unknowns: Vec<UnknownObject<'a>>,
    /// Σ ((computed − measured)/error)², with the errors that were given, or taken.
    pub chi_squared: Option<f64>,
    /// Measurements less unknowns that are not at a bound.
    pub degrees_of_freedom: usize,
    /// Whether the errors of the measurements were given.
    pub errors_known: bool,
    /// What the errors were multiplied by.
    pub error_scale: Option<f64>,
    /// Greatest numerical error of what is computed, in standard errors of its measurement.
    pub numerical_error: Option<f64>,
    /// Covariance of the unknowns in their units, row by row; null at a bound, and where the measurements do not tell.
    pub covariance: Vec<Vec<Option<f64>>>,
    /// Correlation of the unknowns, likewise.
    pub correlation: Vec<Vec<Option<f64>>>,
    /// The minima that several starts led to, the best first.
    pub minima: &'a [Minimum],
    /// The measurements.
    pub rows: Vec<RowObject<'a>>,
    /// How many solves it took.
    pub solves: usize,
    /// What the user should know.
    pub warnings: &'a [String],
}

/// An unknown.
#[derive(Clone, Debug, Serialize)]
pub struct UnknownObject<'a> {
    /// Its key.
    pub key: &'a str,
    /// Its value.
    pub value: f64,
    /// Its standard error.
    pub standard_error: Option<f64>,
    /// Where the search began.
    pub start: f64,
    /// Lower bound.
    pub from: f64,
    /// Upper bound.
    pub to: f64,
    /// `lower` or `upper`, if it is there.
    pub at_bound: Option<&'static str>,
}

/// A measurement: a row of the CSV.
#[derive(Clone, Debug, Serialize)]
pub struct RowObject<'a> {
    /// Name of its line.
    pub row: Cow<'a, str>,
    /// Keys that its condition changes, as `--set` takes them, divided by spaces.
    pub condition: String,
    /// What was measured.
    pub quantity: &'static str,
    /// Of a torque, the speed of the rotor.
    pub rotor_speed_rpm: Option<f64>,
    /// As measured.
    pub measured: f64,
    /// Its standard error, scaled if it was not given.
    pub error: f64,
    /// As computed.
    pub computed: Option<f64>,
    /// Estimated numerical error of that.
    pub numerical_error: Option<f64>,
    /// (computed − measured)/error; null if the measurement was left out.
    pub residual: Option<f64>,
    /// `used`, or why it was left out.
    pub status: Cow<'a, str>,
}

fn matrix(rows: &[Vec<f64>]) -> Vec<Vec<Option<f64>>> {
    rows.iter().map(|row| row.iter().map(|value| finite(*value)).collect()).collect()
}

/// The rows of a fit.
pub fn rows<'a>(fitted: &'a Fitted, measured: &'a Measured) -> Vec<RowObject<'a>> {
    let row = |(one, row): (&'a crate::analysis::fit::Measurement, &'a crate::analysis::fit::FittedRow)| {
        let changes =
            measured.conditions[one.condition].iter().map(|(key, value)| format!("{key}={}", show_text(value)));
        let computed = row.computed.as_ref().ok();
        RowObject {
            row: Cow::Borrowed(&one.label),
            condition: changes.collect::<Vec<_>>().join(" "),
            quantity: one.what.name(),
            rotor_speed_rpm: match one.what {
                Observable::Torque { speed_rpm } => Some(speed_rpm),
                Observable::Number(_) => None,
            },
            measured: one.value,
            error: row.error,
            computed: computed.map(|found| found.value),
            numerical_error: computed.and_then(|found| finite(found.error)),
            residual: row.residual,
            status: Cow::Borrowed(match (&row.computed, row.residual) {
                (_, Some(_)) => "used",
                (Err(why), None) => why,
                (Ok(_), None) => "left out: it could not be computed at the start",
            }),
        }
    };
    measured.measurements.iter().zip(&fitted.rows).map(row).collect()
}

impl<'a> Object<'a> {
    /// Of a fit of the scene of this name.
    pub fn new(preset: &'a str, fitted: &'a Fitted, measured: &'a Measured) -> Self {
        let unknowns = fitted.unknowns.iter().map(|found| UnknownObject {
            key: found.unknown.parameter.key,
            value: found.value,
            standard_error: found.error,
            start: found.unknown.start,
            from: found.unknown.from,
            to: found.unknown.to,
            at_bound: found.at.map(|at| at.name()),
        });
        Self {
            preset,
            data: &measured.name,
            converged: fitted.converged,
            unknowns: unknowns.collect(),
            chi_squared: finite(fitted.chi_squared),
            degrees_of_freedom: fitted.degrees_of_freedom,
            errors_known: fitted.errors_known,
            error_scale: fitted.error_scale,
            numerical_error: fitted.numerical_error,
            covariance: matrix(&fitted.covariance),
            correlation: matrix(&fitted.correlation),
            minima: &fitted.minima,
            rows: rows(fitted, measured),
            solves: fitted.solves,
            warnings: &fitted.warnings,
        }
    }
}

/// Writes the measurements beside what is computed.
///
/// # Errors
/// Those of writing.
pub fn write_csv(fitted: &Fitted, measured: &Measured, out: &mut dyn Write) -> io::Result<()> {
    let in_csv = |row: RowObject<'_>| {
        let [name, status] = [&row.row, &row.status].map(|words| csv::words(words).into_owned().into());
        RowObject { row: name, status, ..row }
    };
    csv::rows(rows(fitted, measured).into_iter().map(in_csv), out)
}

/// Most rows that are named in the figure of residuals.
const MOST_NAMED: usize = 40;

/// The figures of a fit: `fit` (measured and computed, of torques over the speed), `residuals` and, of two unknowns or more,
/// `correlation`.
pub fn figures(problem: &Problem, fitted: &Fitted, measured: &Measured) -> Vec<(&'static str, Figure)> {
    let dressed = |title: &str| Figure { provenance: Provenance::named(&fitted.scene.name), ..Figure::new(title) };
    let mut names: Vec<&str> = measured.measurements.iter().map(|one| one.what.name()).collect();
    names.sort_unstable();
    names.dedup();
    let mut beside = dressed("measured and computed");
    for name in names {
        beside = beside.panel(panel(problem, fitted, measured, name));
    }
    let mut found = vec![("fit", beside), ("residuals", dressed("residuals").panel(residuals(fitted, measured)))];
    if fitted.unknowns.len() > 1 {
        found.push(("correlation", dressed("correlation").panel(correlation(fitted))));
    }
    found
}

/// What was measured under one name, beside what is computed.
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
    let solid = Marker::solid(Shape::Circle);
    let words = first.what.label(problem);
    let (label, unit) = words.split_once(", ").unwrap_or((&words, ""));
    if let Observable::Torque { .. } = first.what {
        let mut panel = Panel::new("", Axis::new("speed of the rotor", "rpm"), Axis::new(label, unit).including([0.0]));
        for condition in 0..measured.conditions.len() {
            let speed =
                |what: Observable| if let Observable::Torque { speed_rpm } = what { speed_rpm } else { f64::NAN };
            let mut points: Vec<(f64, f64, f64, f64)> = all()
                .filter(|(one, ..)| one.condition == condition)
                .map(|(one, row, computed)| (speed(one.what), one.value, row.error, computed))
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let style = Style { marker: None, ..Style::nth(condition) };
            let named = if condition == 0 { ["measured", "computed"] } else { ["", ""] };
            let mut dots = Points::new(named[0], points.iter().map(|point| [point.0, point.1]), style.colour, solid);
            dots.errors = points.iter().map(|point| point.2).collect();
            panel = panel.layer(Line::new(named[1], points.iter().map(|point| [point.0, point.3]), style)).layer(dots);
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
    // The first one at the top.
    let place = |i: usize| (count - i) as f64;
    let mut y = Axis::new("", "");
    if count <= MOST_NAMED {
        y.names = measured.measurements.iter().enumerate().map(|(i, one)| (place(i), one.label.clone())).collect();
    }
    let points = fitted.rows.iter().enumerate().filter_map(|(i, row)| Some([row.residual?, place(i)]));
    let widest =
        fitted.rows.iter().filter_map(|row| row.residual).fold(2.0, |widest: f64, one| widest.max(1.1 * one.abs()));
    let x = Axis::new("computed − measured, in standard errors", "").fixed(-widest, widest);
    Panel::new("", x, y.fixed(0.0, count as f64 + 1.0))
        .height((5.0 * count.min(MOST_NAMED) as f64).clamp(25.0, 150.0))
        .layer(Mark::vertical(-1.0, ""))
        .layer(Mark::vertical(0.0, ""))
        .layer(Mark::vertical(1.0, ""))
        .layer(Points::new("", points, Colour::FILM, Marker::solid(Shape::Circle)))
}

/// The correlation of every unknown with every other.
fn correlation(fitted: &Fitted) -> Panel {
    let count = fitted.unknowns.len();
    let places: Vec<f64> = (1..=count).map(|i| i as f64).collect();
    // The first unknown at the top.
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

/// The object of `fit --maximise --json`.
#[derive(Clone, Debug, Serialize)]
pub struct OptimumObject<'a> {
    /// Name of the scene.
    pub preset: &'a str,
    /// What was sought: `maximise` or `minimise`.
    pub sought: &'static str,
    /// The number that was.
    pub quantity: &'static str,
    /// Its value there.
    pub value: f64,
    /// Estimated numerical error of that.
    pub numerical_error: Option<f64>,
    /// Its value at the scene's own values.
    pub before: Option<f64>,
    /// Whether the search ended by itself.
    pub converged: bool,
    /// The unknowns.
    pub unknowns: Vec<OptimumUnknownObject<'a>>,
    /// The limits.
    pub limits: Vec<LimitObject>,
    /// How many solves it took.
    pub solves: usize,
    /// What the user should know.
    pub warnings: &'a [String],
}

/// An unknown at an optimum.
#[derive(Clone, Debug, Serialize)]
pub struct OptimumUnknownObject<'a> {
    /// Its key.
    pub key: &'a str,
    /// Its value.
    pub value: f64,
    /// Lower bound.
    pub from: f64,
    /// Upper bound.
    pub to: f64,
    /// `lower` or `upper`, if it is there.
    pub at_bound: Option<&'static str>,
    /// The range in which the number that was sought stays within a hundredth of its optimum.
    pub flat_from: f64,
    /// See `flat_from`.
    pub flat_to: f64,
}

/// A limit, and what is reached.
#[derive(Clone, Debug, Serialize)]
pub struct LimitObject {
    /// As it was given.
    pub limit: String,
    /// The number there.
    pub value: Option<f64>,
    /// Estimated numerical error of that.
    pub numerical_error: Option<f64>,
}

impl<'a> OptimumObject<'a> {
    /// Of the optimum of the scene of this name.
    pub fn new(preset: &'a str, found: &'a Optimum) -> Self {
        let unknowns = found.lines.iter().map(|line| OptimumUnknownObject {
            key: line.unknown.parameter.key,
            value: line.value,
            from: line.unknown.from,
            to: line.unknown.to,
            at_bound: line.at.map(|at| at.name()),
            flat_from: line.flat.0,
            flat_to: line.flat.1,
        });
        let limits = found.goal.limits.iter().enumerate().map(|(i, (limit, _))| {
            let reached: Option<&Estimate> = found.limited.get(i);
            LimitObject {
                limit: limit.to_string(),
                value: reached.map(|reached| reached.value),
                numerical_error: reached.and_then(|reached| finite(reached.error)),
            }
        });
        Self {
            preset,
            sought: if found.goal.greatest { "maximise" } else { "minimise" },
            quantity: found.goal.quantity.name(),
            value: found.value.value,
            numerical_error: finite(found.value.error),
            before: found.before.map(|before| before.value),
            converged: found.converged,
            unknowns: unknowns.collect(),
            limits: limits.collect(),
            solves: found.solves,
            warnings: &found.warnings,
        }
    }
}

/// Lines through an optimum, one for each point.
#[derive(Serialize)]
struct LineRow {
    key: &'static str,
    value: f64,
    quantity: &'static str,
    computed: Option<f64>,
}

/// Writes the lines through the optimum.
///
/// # Errors
/// Those of writing.
pub fn write_optimum_csv(found: &Optimum, out: &mut dyn Write) -> io::Result<()> {
    let rows = found.lines.iter().flat_map(|line| {
        line.points.iter().map(|(value, computed)| LineRow {
            key: line.unknown.parameter.key,
            value: *value,
            quantity: found.goal.quantity.name(),
            computed: *computed,
        })
    });
    csv::rows(rows, out)
}

/// Lines through the optimum, a panel for each unknown.
pub fn optimum_figure(problem: &Problem, found: &Optimum) -> Figure {
    let words = found.goal.quantity.label(problem);
    let (label, unit) = words.split_once(", ").unwrap_or((&words, ""));
    let size = if found.goal.greatest { "large" } else { "small" };
    let mut figure = Figure::new(format!("{label}, as {size} as possible"));
    figure.provenance = Provenance::named(&found.scene.name);
    for line in &found.lines {
        let parameter = line.unknown.parameter;
        let curve = line.points.iter().map(|(value, computed)| [*value, computed.unwrap_or(f64::NAN)]);
        let x = Axis { scale: line.unknown.scale, ..Axis::new(parameter.words(), parameter.unit) };
        let panel = Panel::new("", x, Axis::new(label, unit))
            .layer(Line::new("", curve, Style::solid(Colour::FILM)))
            .layer(Points::new("", [[line.value, found.value.value]], Colour::CONTACT, Marker::solid(Shape::Diamond)));
        figure = figure.panel(panel);
    }
    figure
}
