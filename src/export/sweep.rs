//! A sweep as JSON and as CSV, with the same names, and as a figure.
//!
//! Numbers are written with the fewest digits that read back to the same bits, so that a sweep that was cancelled and
//! continued is the same, byte by byte, as one that was not.

use super::csv::{number, words};
use super::estimates;
use crate::analysis::attempt::RunStatus;
use crate::analysis::quantity::{Quantity, force_unit};
use crate::analysis::sweep::{Axis as SweepAxis, Sweep, SweepRow, typical_error};
use crate::analysis::table1::Published;
use crate::digits::significant;
use crate::export::figure::{
    Axis, Band, Colour, Figure, Grid, Legend, Line, Map, Marker, Panel, Points, Provenance, Range, Shading, Shape,
    Style, Width, extent,
};
use crate::scene::{ParameterKind, Scale, show_text};
use crate::solution::StoppedBy;
use crate::solve::Method;
use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use std::io::{self, Write};

/// Columns before those of the keys: the fingerprint of the sweep, and the index of the point.
pub(super) const FIRST: [&str; 2] = ["sweep", "point"];
const STATUS: &str = "status";
/// Why no finer grid was solved: `accuracy`, `budget` or `limit`; empty if it failed.
pub(super) const STOPPED_BY: &str = "stopped_by";
/// Names of the limits of the model that a point exceeds; in a CSV file they are separated by this.
pub(super) const VALIDITY: &str = "validity";
pub(super) const BETWEEN: &str = ";";

pub(super) fn header(sweep: &Sweep) -> Vec<String> {
    let mut names = FIRST.map(str::to_owned).to_vec();
    names.extend(sweep.axes().iter().map(|axis| axis.parameter.key.to_owned()));
    names.extend([STATUS, STOPPED_BY, VALIDITY].map(str::to_owned));
    names.extend(sweep.quantities().into_iter().map(|quantity| quantity.column(sweep.problem())));
    names
}

/// Cells of a row. Every row carries the fingerprint of its sweep.
pub(super) fn record(sweep: &Sweep, fingerprint: &str, row: &SweepRow) -> Vec<String> {
    let mut cells = vec![fingerprint.to_owned(), row.point.to_string()];
    cells.extend(sweep.axes().iter().zip(&row.values).map(|(axis, value)| match axis.words.is_empty() {
        true => number(*value),
        false => words(&axis.text(*value)).into_owned(),
    }));
    cells.push(row.status.to_string());
    cells.push(row.stopped_by.map_or("", StoppedBy::name).to_owned());
    cells.push(row.outside.join(BETWEEN));
    cells.extend(sweep.quantities().into_iter().map(|quantity| {
        let show = if quantity.is_count() { |count: f64| count.to_string() } else { number };
        row.numbers.get(quantity).map_or_else(String::new, show)
    }));
    cells
}

/// Writes the rows as CSV, the header first; missing values are empty.
pub fn write_csv(sweep: &Sweep, rows: &[SweepRow], out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(header(sweep))?;
    let fingerprint = sweep.fingerprint();
    rows.iter().try_for_each(|row| writer.write_record(record(sweep, &fingerprint, row)))?;
    writer.flush()
}

/// The object of `--json`: a sweep, its points so far, of which the last axis varies fastest, and the published values of Table I in its plane.
pub fn object<'a>(sweep: &'a Sweep, rows: &'a [SweepRow]) -> impl Serialize + 'a {
    let (scene, settings) = (sweep.scene(), sweep.settings());
    Object {
        preset: &scene.name,
        scene: scene.scene(),
        force_unit: force_unit(sweep.problem()),
        method: settings.method.name(),
        // The paper's method has no fidelity.
        fidelity: (settings.method == Method::Auto).then(|| settings.fidelity.to_string()),
        complete: rows.len() == sweep.len(),
        // These are the values in the first column of the CSV.
        sweep: sweep.fingerprint(),
        axes: sweep.axes().iter().map(axis_object).collect(),
        rows: Rows { sweep, rows },
        published: sweep.published(),
    }
}

#[derive(Serialize)]
struct Object<'a> {
    preset: &'a str,
    scene: &'static str,
    force_unit: &'static str,
    method: &'static str,
    fidelity: Option<String>,
    complete: bool,
    sweep: String,
    axes: Vec<Value>,
    rows: Rows<'a>,
    published: Vec<Published>,
}

/// The rows, converted to JSON one after the other, because there may be a hundred thousand.
struct Rows<'a> {
    sweep: &'a Sweep,
    rows: &'a [SweepRow],
}

impl Serialize for Rows<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let quantities = self.sweep.quantities();
        serializer.collect_seq(self.rows.iter().map(|row| row_object(self.sweep.axes(), &quantities, row)))
    }
}

/// An axis: its key, the unit, the spacing of its values (`linear`, `log`, or `list` for words), and the values, numbers or words as in
/// `--set`.
fn axis_object(axis: &SweepAxis) -> Value {
    let scale = match axis.scale {
        _ if !axis.words.is_empty() => "list",
        Scale::Log => "log",
        Scale::Linear => "linear",
    };
    let values: Vec<Value> = axis.values.iter().map(|value| json_value(axis, *value)).collect();
    json!({ "key": axis.parameter.key, "unit": axis.parameter.unit, "scale": scale, "values": values })
}

fn json_value(axis: &SweepAxis, value: f64) -> Value {
    if axis.words.is_empty() { value.into() } else { axis.text(value).into() }
}

/// One point: its keys, its status, the names of the limits of the model that it exceeds, and its quantities by name.
fn row_object(axes: &[SweepAxis], quantities: &[Quantity], row: &SweepRow) -> Value {
    let keys = axes.iter().zip(&row.values).map(|(axis, value)| (axis.parameter.key, json_value(axis, *value)));
    let how = [
        (STATUS, row.status.to_string().into()),
        (STOPPED_BY, row.stopped_by.map(StoppedBy::name).into()),
        (VALIDITY, json!(row.outside)),
    ];
    let numbers = estimates::named(quantities.iter().copied(), &row.numbers);
    [(FIRST[1], row.point.into())].into_iter().chain(keys).chain(how).chain(numbers).collect()
}

/// A quantity of the sweep as a figure. Over one key: a curve with its error as a band, and a second curve below the [`primary`] one. Over
/// two keys: a map with contours. Published points of Table I are included, and crosses where a point did not converge.
pub fn figure(sweep: &Sweep, rows: &[SweepRow], quantity: Quantity) -> Figure {
    let settings = sweep.settings();
    let worst = |error: Quantity| {
        let worst = rows.iter().filter_map(|row| row.numbers.get(error)).fold(0.0, f64::max);
        format!("{} up to {} {}", error.words(), significant(worst, 2), error.unit(sweep.problem()))
            .trim_end()
            .to_owned()
    };
    let missing = sweep.len() - rows.iter().filter(|row| row.status == RunStatus::Converged).count();
    let late = |row: &&SweepRow| row.status == RunStatus::Converged && row.stopped_by == Some(StoppedBy::Budget);
    let notes = [(missing, "points not solved"), (rows.iter().filter(late).count(), "points where time was up")];
    let of = sweep.len();
    let notes = notes.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} of {of} {what}"));
    let provenance = Provenance {
        fidelity: match settings.method {
            Method::Auto => settings.fidelity.to_string(),
            Method::Paper => "paper mesh".to_owned(),
        },
        error: quantity.error().map_or_else(String::new, worst),
        note: notes.collect::<Vec<_>>().join(", "),
        ..Provenance::named(&show_text(&sweep.headline()))
    };
    let mut figure = Figure { provenance, share_x: true, ..Figure::default() };
    let found =
        rows.iter().filter(|row| row.status == RunStatus::Converged).filter_map(|row| row.numbers.get(quantity));
    let [least, most] = extent(found);
    // On a map, values that differ by less than their error have one colour.
    let error = typical_error(rows, quantity);
    let noise = error.is_finite() && (0.0..error).contains(&(most - least));
    let noise = noise.then_some(Range::Fixed(least - error, most + error));
    match sweep.axes() {
        [x, y] => figure.panels.push(map_panel(sweep, rows, [x, y], quantity, noise.unwrap_or_default())),
        [first, x, y] => {
            // There is a map for each value of the first key, with one colour scale.
            let range = noise.unwrap_or(if least < most { Range::Fixed(least, most) } else { Range::Auto });
            for value in first.values.iter().take(MOST_MAPS) {
                let of_value = rows.iter().filter(|row| row.values[0] == *value);
                let of_value: Vec<SweepRow> =
                    of_value.map(|row| SweepRow { values: row.values[1..].to_vec(), ..row.clone() }).collect();
                let mut panel = map_panel(sweep, &of_value, [x, y], quantity, range.clone());
                panel.title = format!("{} = {} {}", first.parameter.words(), first.text(*value), first.parameter.unit);
                figure.panels.push(panel.height(46.0));
            }
            (figure.columns, figure.width) = (first.values.len().clamp(1, 2), Width::Page);
        }
        [x, ..] => {
            figure.panels.push(curve_panel(sweep, rows, x, quantity));
            if quantity != primary(sweep) {
                return figure;
            }
            let below = if sweep.quantities().contains(&Quantity::StallTorque) {
                Quantity::StallTorque
            } else {
                Quantity::MaxPressure
            };
            figure.panels.push(curve_panel(sweep, rows, x, below).height(30.0).legend(Legend::None));
        }
        [] => {}
    }
    figure
}

/// Greatest number of maps in a figure of three keys.
const MOST_MAPS: usize = 12;

/// The main quantity of a sweep: α of a motor, the mean gap of a plate that floats, the load ratio of any other plate.
pub fn primary(sweep: &Sweep) -> Quantity {
    let there = sweep.quantities();
    Quantity::HEADLINES.into_iter().find(|quantity| there.contains(quantity)).unwrap_or(Quantity::LoadRatio)
}

fn figure_axis(axis: &SweepAxis) -> Axis {
    let drawn = Axis::new(axis.parameter.words(), axis.parameter.unit);
    if axis.words.is_empty() {
        let whole = matches!(axis.parameter.kind, ParameterKind::Whole { .. });
        return Axis { scale: axis.scale, whole, ..drawn };
    }
    let names = axis.values.iter().map(|value| (*value, axis.text(*value))).collect();
    Axis { names, label: axis.parameter.words().to_owned(), ..drawn }.fixed(-0.5, axis.values.len() as f64 - 0.5)
}

/// Points whose numbers are not reliable.
const UNSOUND: &str = "not converged or not resolved";

/// Curves with at most this many points have a marker at each.
const FEW: usize = 40;

/// One quantity over one key, with a gap where a point has no value, or is not solved yet.
pub(crate) fn curve_panel(sweep: &Sweep, rows: &[SweepRow], x: &SweepAxis, quantity: Quantity) -> Panel {
    let mut points: Vec<(f64, Option<&SweepRow>)> = x.values.iter().map(|value| (*value, None)).collect();
    rows.iter().for_each(|row| points[row.point].1 = Some(row));
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let sound = |row: &&SweepRow| row.status == RunStatus::Converged;
    let number = |row: &Option<&SweepRow>, of: Quantity| row.and_then(|row| row.numbers.get(of)).unwrap_or(f64::NAN);
    let colour = Colour::FILM;
    let mut panel =
        Panel::new("", figure_axis(x), Axis::new(quantity.words(), quantity.unit(sweep.problem())).including([0.0]));
    let errors: Vec<f64> = match quantity.error() {
        Some(error) => points.iter().map(|(_, row)| number(row, error)).collect(),
        None => Vec::new(),
    };
    let curve: Vec<[f64; 2]> = points.iter().map(|(x, row)| [*x, number(&row.filter(sound), quantity)]).collect();
    let dot = Marker { size: 2.5, ..Marker::solid(Shape::Circle) };
    // There are no values between words.
    if !x.words.is_empty() {
        panel = panel.layer(Points { errors, ..Points::new("computed", curve, colour, dot) });
    } else {
        if !errors.is_empty() {
            let band = curve.iter().zip(&errors).map(|([x, value], error)| [*x, value - error, value + error]);
            panel = panel.layer(Band::new("stated error", band, colour));
        }
        panel = panel.layer(Line::new("computed", curve.clone(), Style::solid(colour)));
        if rows.len() <= FEW {
            panel = panel.layer(Points::new("", curve, colour, dot));
        }
    }
    let unsound: Vec<[f64; 2]> = rows
        .iter()
        .filter(|row| row.status != RunStatus::Converged)
        .filter_map(|row| Some([row.values[0], row.numbers.get(quantity)?]))
        .collect();
    panel = with_points(panel, UNSOUND, unsound, Colour::CONTACT, Marker::solid(Shape::Cross));
    let value = |point: &Published| match quantity {
        Quantity::Alpha => Some(point.alpha),
        Quantity::FilmLoad => Some(point.film_load),
        _ => None,
    };
    let published: Vec<[f64; 2]> =
        sweep.published().into_iter().filter_map(|point| Some([point.values[0], value(&point)?])).collect();
    with_points(panel, "published (Table I)", published, Colour::BLACK, Marker::hollow(Shape::Square))
}

/// Adds points of this name, if there are any.
fn with_points(panel: Panel, name: &str, points: Vec<[f64; 2]>, colour: Colour, marker: Marker) -> Panel {
    if points.is_empty() { panel } else { panel.layer(Points::new(name, points, colour, marker)) }
}

/// `rows` are those of the map, with only the values of its two axes.
pub(crate) fn map_panel(
    sweep: &Sweep,
    rows: &[SweepRow],
    [x, y]: [&SweepAxis; 2],
    quantity: Quantity,
    range: Range,
) -> Panel {
    let ascending = |values: &[f64]| {
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        values
    };
    let (xs, ys) = (ascending(&x.values), ascending(&y.values));
    let mut values = vec![f64::NAN; xs.len() * ys.len()];
    let mut unsound = Vec::new();
    // The description that all of them share.
    let number = |row: &SweepRow| matches!(row.status, RunStatus::NotConverged | RunStatus::NotResolved);
    let sound = |row: &SweepRow| row.status == RunStatus::Converged;
    let name = if rows.iter().all(|row| sound(row) || number(row)) {
        UNSOUND
    } else if rows.iter().any(number) {
        "not solved, not converged or not resolved"
    } else {
        "not solved"
    };
    for row in rows {
        let place = |axis: &[f64], value: f64| axis.iter().position(|at| *at == value);
        let at = place(&xs, row.values[0]).zip(place(&ys, row.values[1]));
        if !sound(row) {
            unsound.push([row.values[0], row.values[1]]);
        } else if let (Some((i, j)), Some(value)) = (at, row.numbers.get(quantity)) {
            values[i * ys.len() + j] = value;
        }
    }
    // There are no values between words.
    let contours = (x.words.is_empty() && y.words.is_empty()).then(|| typical_error(rows, quantity));
    let (label, unit) = (quantity.words().to_owned(), quantity.unit(sweep.problem()).to_owned());
    let grid = Grid { x: xs, y: ys, values };
    let map = Map { label, unit, grid, range, shading: Shading::Cells, contours, ..Map::default() };
    let panel = Panel::new("", figure_axis(x), figure_axis(y)).height(60.0).layer(map);
    let panel = with_points(panel, name, unsound, Colour::CONTACT, Marker::solid(Shape::Cross));
    let here = |point: Published| <[f64; 2]>::try_from(point.values).ok();
    let published: Vec<[f64; 2]> = sweep.published().into_iter().filter_map(here).collect();
    with_points(panel, "rows of Table I", published, Colour::BLACK, Marker::hollow(Shape::Square))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::analysis::quantity::Numbers;
    use crate::scene::presets;
    use crate::solve::Settings;

    pub(in crate::export) fn sweep(vary: &str) -> Sweep {
        Sweep::new(&presets::find("fundamental").unwrap(), &[vary.parse().unwrap()], &Settings::default()).unwrap()
    }

    pub(in crate::export) fn rows(sweep: &Sweep) -> Vec<SweepRow> {
        let mut numbers = Numbers::default();
        numbers.set(Quantity::Alpha, 0.1 + 0.2);
        numbers.set(Quantity::AlphaError, 1e-300);
        let failed = RunStatus::Failed("film, step 3: no \"solution\",\nat all".to_owned());
        let row = |point: usize, status: RunStatus| SweepRow {
            point,
            values: sweep.values(point),
            stopped_by: (status == RunStatus::Converged).then_some(StoppedBy::Budget),
            status,
            numbers,
            outside: vec!["slip-law", "sound"],
        };
        vec![row(0, RunStatus::Converged), row(2, failed), row(1, RunStatus::NotConverged)]
    }

    #[test]
    fn figures_have_a_curve_or_a_map_and_the_published_points() {
        use crate::export::figure::Layer;
        let line = sweep("stator.frequency_khz=3:50:3:log");
        let drawn = figure(&line, &rows(&line), primary(&line));
        let points = |panel: &Panel| {
            let points = |layer: &Layer| if let Layer::Points(points) = layer { Some(points.clone()) } else { None };
            panel.layers.iter().filter_map(points).collect::<Vec<_>>()
        };
        assert_eq!(drawn.panels.len(), 2);
        let [_, unsound, published] = &points(&drawn.panels[0])[..] else { panic!("{drawn:?}") };
        assert_eq!((unsound.points.len(), published.points.len()), (2, 5));
        assert!(drawn.provenance.note.contains("2 of 3 points not solved"), "{drawn:?}");

        let vary = ["film.min_spacing_nm=200:100:3".parse().unwrap(), "stator.frequency_khz=3:50:2".parse().unwrap()];
        let plane = Sweep::new(&presets::find("fundamental").unwrap(), &vary, &Settings::default()).unwrap();
        let mut numbers = Numbers::default();
        numbers.set(Quantity::Alpha, 0.5);
        let row = |point: usize, numbers: Numbers| {
            let values = plane.values(point);
            SweepRow { point, values, numbers, ..rows(&plane).swap_remove(0) }
        };
        let drawn = figure(&plane, &[row(1, numbers)], primary(&plane));
        let Layer::Map(map) = &drawn.panels[0].layers[0] else { panic!("{drawn:?}") };
        assert_eq!((&map.grid.x[..], &map.grid.y[..]), (&[100.0, 150.0, 200.0][..], &[3.0, 50.0][..]));
        let known: Vec<usize> = (0..6).filter(|i| map.grid.values[*i].is_finite()).collect();
        assert_eq!(known, [5]);
        assert_eq!((&*map.label, &*map.unit), ("film share of the load α", ""));
        let drawn = figure(&plane, &[row(1, numbers)], Quantity::MaxPressure);
        let Layer::Map(map) = &drawn.panels[0].layers[0] else { panic!("{drawn:?}") };
        assert_eq!((&*map.label, &*map.unit), ("highest pressure", "kPa"));

        // The name of the crosses must be true for all of them.
        let failed = || RunStatus::Failed("no solution".to_owned());
        for (statuses, name) in [
            ([failed(), failed()], "not solved"),
            ([RunStatus::NotResolved, RunStatus::NotConverged], "not converged or not resolved"),
            ([RunStatus::NotConverged, failed()], "not solved, not converged or not resolved"),
        ] {
            let status = |(point, status)| SweepRow { status, ..row(point, numbers) };
            let rows: Vec<SweepRow> = statuses.into_iter().enumerate().map(status).collect();
            let drawn = figure(&plane, &rows, Quantity::Alpha);
            let crosses = points(&drawn.panels[0]).swap_remove(0);
            assert_eq!((&*crosses.name, crosses.points.len()), (name, 2));
        }

        // Without values there is no range, and values that differ by less than their error have one colour.
        let range = |rows: &[SweepRow]| match figure(&plane, rows, Quantity::Alpha).panels[0].layers[0] {
            Layer::Map(ref map) => map.range.clone(),
            _ => panic!("no map"),
        };
        let with = |alpha: f64, error: f64| {
            let mut numbers = Numbers::default();
            numbers.set(Quantity::Alpha, alpha);
            numbers.set(Quantity::AlphaError, error);
            numbers
        };
        let two = |error: f64| range(&[row(0, with(0.25, error)), row(1, with(0.75, error))]);
        assert_eq!((range(&[]), two(0.25), two(f64::INFINITY)), (Range::Auto, Range::Auto, Range::Auto));
        assert_eq!(two(1.0), Range::Fixed(-0.75, 1.75));
    }
}
