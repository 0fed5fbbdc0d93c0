//! Maps of where a method solves, as JSON and as CSV, with the same names, and as a figure.

use crate::analysis::quantity::Quantity;
use crate::analysis::stability::{Cell, Map, VERDICTS, Verdict};
use crate::digits::as_given;
use crate::export::figure::{Axis, Categories, Colour, Figure, Legend, Panel, Provenance, Width};
use crate::fidelity::Fidelity;
use crate::scene::Parameter;
use crate::solve::Method;
use serde_json::{Value, json};

/// The object of `--json`: the scene whose parameters are mapped, the fidelity of method auto, the cells, and the maps that the scene
/// does not have, with the reason.
pub fn object(preset: &str, fidelity: Fidelity, cells: &[Cell], unmapped: &[(&Map, String)]) -> Value {
    let cells: Vec<_> = cells.iter().map(cell_object).collect();
    let unmapped: Vec<_> = unmapped.iter().map(|(map, reason)| json!({ "map": map.name, "reason": reason })).collect();
    json!({ "preset": preset, "fidelity": fidelity.to_string(), "cells": cells, "unmapped": unmapped })
}

/// One cell, a row of the CSV; x and y are the keys of the map. Unknown values are null, or empty.
pub fn cell_object(cell: &Cell) -> Value {
    let number = |quantity| cell.numbers.get(quantity);
    let count = |quantity| number(quantity).map(|count| count as u64);
    json!({
        "map": cell.map.name,
        "method": cell.method.name(),
        "x_key": cell.changes[0].0,
        "x": cell.changes[0].1,
        "y_key": cell.changes[1].0,
        "y": cell.changes[1].1,
        "verdict": cell.verdict.name(),
        "alpha": number(Quantity::Alpha),
        "alpha_error": number(Quantity::AlphaError),
        "residual": number(Quantity::Residual),
        "coupling_iterations": count(Quantity::Rounds),
        "cycles": count(Quantity::Cycles),
        "film_steps": count(Quantity::FilmSteps),
        "detail": detail(cell),
        "options": cell.options(),
    })
}

/// Why a cell is not solved, and what is physically impossible in its numbers.
pub fn detail(cell: &Cell) -> String {
    let mut reasons = cell.violations.clone();
    match &cell.verdict {
        Verdict::Failed(reason) | Verdict::Refused(reason) => reasons.insert(0, reason.clone()),
        Verdict::NotConverged => reasons.insert(
            0,
            match cell.numbers.get(Quantity::Residual) {
                Some(residual) => format!("further rounds would still change it by {residual:.1e}"),
                None if cell.method == Method::Paper => "stopped: too many cycles".to_owned(),
                None => "no number left".to_owned(),
            },
        ),
        Verdict::Solved | Verdict::NonPhysical => {}
    }
    reasons.join("; ")
}

const COLOURS: [Colour; VERDICTS.len()] = [
    Colour(0x56, 0xb4, 0xe9),
    Colour(0xe6, 0x9f, 0x00),
    Colour(0xd5, 0x5e, 0x00),
    Colour::BLACK,
    Colour(0xbb, 0xbb, 0xbb),
];

/// The maps below each other; those of the methods are side by side.
pub fn figure(preset: &str, fidelity: Fidelity, cells: &[Cell]) -> Figure {
    let several = cells.iter().any(|cell| cell.method != cells[0].method);
    let (columns, width) = if several { (2, Width::Page) } else { (1, Width::Column) };
    let provenance = Provenance { fidelity: fidelity.to_string(), ..Provenance::named(preset) };
    let mut figure = Figure { provenance, columns, width, ..Figure::default() };
    // The cells are in the order of maps and methods.
    for of_one in cells.chunk_by(|a, b| a.map.name == b.map.name && a.method == b.method) {
        let first = &of_one[0];
        let axes = [0, 1].map(|axis| {
            places(first.map.axes[axis], of_one.iter().map(|cell| (cell.place[axis], cell.changes[axis].1)))
        });
        let [(x_axis, x), (y_axis, y)] = axes;
        let mut values = vec![usize::MAX; x.len() * y.len()];
        for cell in of_one {
            values[cell.place[0] * y.len() + cell.place[1]] = cell.verdict.number();
        }
        let kinds = VERDICTS.iter().map(|name| (*name).to_owned()).zip(COLOURS).collect();
        let method = match first.method {
            Method::Auto => "ours",
            Method::Paper => "the paper's method",
        };
        let title = format!("{}, {method}", first.map.name.replace('-', " and "));
        let panel = Panel::new(title, x_axis, y_axis).height(38.0).layer(Categories { x, y, values, kinds });
        figure.panels.push(panel.legend(Legend::Above));
    }
    figure
}

/// A logarithmic axis, and the positions of its values. Zero has its own position, below the others.
fn places(key: &str, values: impl Iterator<Item = (usize, f64)>) -> (Axis, Vec<f64>) {
    let mut found: Vec<(usize, f64)> = values.collect();
    found.sort_by_key(|(place, _)| *place);
    found.dedup();
    let mut values: Vec<f64> = found.into_iter().map(|(_, value)| value).collect();
    let mut axis = match Parameter::find(key) {
        Some(parameter) => Axis::new(parameter.words(), parameter.unit),
        None => Axis::new(key, ""),
    }
    .log();
    if let [zero, first, second, ..] = values[..]
        && zero <= 0.0
    {
        let stand_in = first * first / second;
        axis.names.push((stand_in, "0".to_owned()));
        // Decades from the first of the other values, which keep their positions.
        let decades = (0..=values.len()).map(|decade| first * 10f64.powi(decade as i32));
        let last = values.iter().copied().fold(first, f64::max) * (1.0 + 1e-9);
        axis.names.extend(decades.take_while(|at| *at <= last).map(|at| (at, as_given(at).to_string())));
        values[0] = stand_in;
    }
    (axis, values)
}
