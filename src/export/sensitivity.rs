//! Sensitivities and uncertainties as JSON and as CSV, with the same names, and as figures.

use super::csv::number;
use super::estimates::{self, finite};
use crate::analysis::quantity::Quantity;
use crate::analysis::sensitivity::{LEAST, MonteCarlo, Propagated, Sensitivity, Spread, Uncertainties};
use crate::analysis::variation::KeyDerivatives;
use crate::digits::significant;
use crate::estimate::Estimate;
use crate::export::figure::{Axis, Band, Colour, Dash, Figure, Legend, Line, Mark, Panel, Provenance, Style};
use crate::solution::Status;
use serde_json::{Value, json};
use std::io::{self, Write};

/// Results of a sensitivity analysis: derivatives, uncertainties of the keys, and random draws, if there are any.
#[derive(Clone, Copy, Debug)]
pub struct SensitivityStudy<'a> {
    /// Results and derivatives.
    pub sensitivity: &'a Sensitivity,
    /// Uncertain keys; there may be none.
    pub uncertainties: &'a Uncertainties,
    /// Random draws.
    pub carlo: Option<&'a MonteCarlo>,
}

/// The random draws: the seed, and how many draws were requested, solved, failed and drawn again.
fn draws(MonteCarlo { seed, asked, draws, failures, redrawn }: &MonteCarlo) -> Value {
    json!({ "seed": seed, "asked": asked, "solved": draws.len(), "failed": failures.len(), "redrawn": redrawn })
}

/// How the draws of a result are distributed.
fn spread(spread: Spread) -> Value {
    let mut object = json!({
        "count": spread.count,
        "mean": spread.mean,
        "mean_error": spread.mean_error(),
        "standard_deviation": spread.deviation,
    });
    for (name, quantile) in ["quantile_5", "quantile_50", "quantile_95"].into_iter().zip(spread.quantiles) {
        estimates::add(&mut object, name, "", Some(quantile));
    }
    object
}

impl SensitivityStudy<'_> {
    /// The object of `--json`. Unknown values are null.
    pub fn object(&self) -> Value {
        let sensitivity = self.sensitivity;
        json!({
            "preset": sensitivity.scene().name,
            "scene": sensitivity.scene().scene(),
            "fidelity": sensitivity.settings.fidelity.to_string(),
            "converged": sensitivity.status == Status::Converged,
            "outputs": (0..sensitivity.outputs.len()).map(|output| self.output(output)).collect::<Vec<_>>(),
            "whole_numbers": sensitivity.whole(),
            "monte_carlo": self.carlo.map(draws),
            "warnings": sensitivity.warnings,
        })
    }

    /// The result with this index: its value, the standard deviation due to the uncertain keys, the distribution of the random draws, and a
    /// row for each key.
    fn output(&self, output: usize) -> Value {
        let of = self.sensitivity.outputs[output];
        let propagated = self.propagated(output);
        json!({
            "name": of.name(),
            "unit": of.unit(&self.sensitivity.problem),
            "value": self.sensitivity.values[output].value,
            "error": self.sensitivity.values[output].error,
            "uncertainty": propagated.as_ref().map(|found| found.deviation.value),
            "uncertainty_error": propagated.as_ref().map(|found| found.deviation.error),
            "uncertainty_without": propagated.as_ref().map_or(&[][..], |found| &found.unknown),
            "monte_carlo": self.carlo.and_then(|carlo| carlo.spread(output)).map(spread),
            "by": self.rows_of(output),
        })
    }

    /// To first order; `None` without an uncertain key.
    pub fn propagated(&self, output: usize) -> Option<Propagated> {
        (!self.uncertainties.is_empty()).then(|| self.sensitivity.propagated(output, self.uncertainties))
    }

    fn rows_of(&self, output: usize) -> Vec<Value> {
        let propagated = self.propagated(output);
        (0..self.sensitivity.columns.len()).map(|column| self.row(output, column, propagated.as_ref())).collect()
    }

    /// A result with respect to a key, a row of the CSV. Errors are estimated and absolute.
    fn row(&self, output: usize, column: usize, propagated: Option<&Propagated>) -> Value {
        let sensitivity = self.sensitivity;
        let KeyDerivatives { parameter, at, step, sides, slopes } = &sensitivity.columns[column];
        let slope = slopes.as_ref().ok().map(|slopes| slopes[output]);
        let relative = sensitivity.columns[column].scale().and_then(|_| sensitivity.elasticity(output, column));
        let contribution =
            propagated.and_then(|found| found.parts.iter().find(|(other, _)| other.key == parameter.key));
        json!({
            "output": sensitivity.outputs[output].name(),
            "key": parameter.key,
            "key_unit": parameter.unit,
            "at": at,
            // In the unit of the result over that of the key.
            "derivative": slope.map(|slope| slope.value),
            // The sum of the next three.
            "derivative_error": slope.map(|slope| slope.error()),
            // Due to the length of the step.
            "step_error": slope.map(|slope| slope.step_error),
            // Due to the grids.
            "grid_error": slope.map(|slope| slope.grid_error()),
            // Due to what is left out of the model.
            "left_out_error": slope.map(|slope| slope.left_out),
            // By how many per cent the result changes with 1 % of the key, of a temperature from absolute zero.
            "elasticity": relative.map(|found| found.value),
            "elasticity_error": relative.map(|found| found.error),
            // The step of the differences, in the unit of the key.
            "step": step,
            // `both`, or the side with the points: `above` or `below`.
            "sides": sides,
            // Standard deviation of the key, in its unit, if it is uncertain; its contribution to that of the result, signed; and its share
            // of the variance of the result, 0 to 1.
            "uncertainty": self.uncertainties.deviation(parameter),
            "contribution": contribution.map(|(_, part)| part.value),
            "variance_share": propagated.and_then(|found| found.share(parameter)),
            // Why there is no derivative.
            "why": slopes.as_ref().err(),
        })
    }

    /// The rows of the CSV, result by result.
    pub fn rows(&self) -> impl Iterator<Item = Value> {
        (0..self.sensitivity.outputs.len()).flat_map(|output| self.rows_of(output))
    }

    /// Writes the random draws as CSV: the keys, then the results.
    pub fn write_draws(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        let keys = self.uncertainties.iter().map(|(parameter, ..)| parameter.key);
        let outputs = self
            .sensitivity
            .outputs
            .iter()
            .flat_map(|output| [*output].into_iter().chain(output.error()).map(Quantity::name));
        writer.write_record(keys.chain(outputs))?;
        for draw in self.carlo.iter().flat_map(|carlo| &carlo.draws) {
            let number = |value: &f64| finite(*value).map_or_else(String::new, number);
            let results = draw.results.iter().flat_map(|Estimate { value, error }| [value, error]);
            writer.write_record(draw.values.iter().chain(results).map(number))?;
        }
        writer.flush()
    }

    fn figure_of(&self, caption: String) -> Figure {
        let mut provenance = Provenance::named(&self.sensitivity.scene().headline());
        provenance.fidelity = self.sensitivity.settings.fidelity.to_string();
        Figure { caption, provenance, ..Figure::default() }
    }

    /// A tornado chart for each result: its elasticities. Keys with little effect are left out.
    pub fn tornado(&self) -> Figure {
        self.tornado_of("Change of each result for 1 % more of each parameter", None)
    }

    /// A tornado chart for each result: the contribution of each uncertain key; `None` if no key is uncertain.
    pub fn uncertainty(&self) -> Option<Figure> {
        let what = "Change of each result for one standard deviation (s.d.) more of each uncertain parameter";
        (!self.uncertainties.is_empty()).then(|| self.tornado_of(what, Some(self.uncertainties)))
    }

    fn tornado_of(&self, what: &str, uncertain: Option<&Uncertainties>) -> Figure {
        let mut figure = self.figure_of(format!("{what}, with the error of the derivative."));
        figure.panels =
            (0..self.sensitivity.outputs.len()).map(|output| bars(self.sensitivity, output, uncertain)).collect();
        figure
    }

    /// The distribution of the random draws of each result, beside the normal distribution to first order; `None` without draws.
    pub fn histogram(&self) -> Option<Figure> {
        let carlo = self.carlo?;
        let caption = format!(
            "Results of {} random draws, and the normal distribution of the linear estimate. Above each: the standard deviation of the \
             draws, that of the linear estimate, and the numerical error of the result.",
            carlo.draws.len()
        );
        let mut figure = self.figure_of(caption);
        let (made, asked) = (carlo.draws.len(), carlo.asked);
        let of = if made + carlo.failures.len() < asked { format!(" of {asked}, cancelled") } else { String::new() };
        figure.provenance.note = format!("{made} draws{of}, seed {}", carlo.seed);
        let panel = |output| distribution(self.sensitivity, output, self.uncertainties, carlo);
        figure.panels = (0..self.sensitivity.outputs.len()).filter_map(panel).collect();
        Some(figure)
    }
}

/// The bars of a result: elasticities or, for `uncertain` keys, the contribution of each.
pub fn bars(sensitivity: &Sensitivity, output: usize, uncertain: Option<&Uncertainties>) -> Panel {
    let of = sensitivity.outputs[output];
    let (shown, smaller) = sensitivity.tornado(output, uncertain);
    let axis = match uncertain {
        None => Axis::new(format!("{}, % for 1 % more", of.words()), ""),
        Some(_) => Axis::new(format!("{}, for 1 s.d. more", of.words()), of.unit(&sensitivity.problem)),
    };
    let mut names: Vec<(f64, String)> = Vec::new();
    let mut panel = Panel::default();
    for (row, (parameter, bar)) in shown.iter().enumerate() {
        let y = -(row as f64);
        names.push((y, parameter.words()));
        let colour = if bar.value < 0.0 { Colour::CONTACT } else { Colour::FILM };
        let ends = [bar.value.min(0.0), bar.value.max(0.0)].map(|x| [x, y - 0.36, y + 0.36]);
        panel = panel.layer(Band { opacity: 0.8, ..Band::new("", ends, colour) });
        let error = [bar.value - bar.error, bar.value + bar.error].map(|x| [x, y]);
        panel = panel.layer(Line::new("", error, Style { width: 0.8, ..Style::default() }));
    }
    if smaller > 0 {
        panel.title = format!("not shown: {smaller} below {} % of the largest", significant(100.0 * LEAST, 1));
    }
    let ends = shown.iter().flat_map(|(_, bar)| [-1.0, 1.0].map(|sign| bar.value + sign * bar.error));
    let room = 1.03;
    panel.x = axis.including(ends.map(|end| room * end).chain([0.0]));
    panel.y = Axis { names, ..Axis::default().fixed(0.6 - shown.len() as f64, 0.6) };
    panel.legend = Legend::None;
    panel.height = 4.2 * shown.len().max(2) as f64;
    panel.layer(Mark::vertical(0.0, ""))
}

/// The distribution of the random draws of a result, beside the normal distribution to first order; `None` without draws of it.
pub fn distribution(
    sensitivity: &Sensitivity,
    output: usize,
    uncertainties: &Uncertainties,
    carlo: &MonteCarlo,
) -> Option<Panel> {
    let of = sensitivity.outputs[output];
    let spread = carlo.spread(output)?;
    let (from, width, bins) = &spread.bins;
    let bars = bins.iter().enumerate().flat_map(|(bin, count)| {
        let left = from + bin as f64 * width;
        [left, left + width].map(|x| [x, 0.0, *count as f64])
    });
    let unit = of.unit(&sensitivity.problem);
    let linear = sensitivity.propagated(output, uncertainties).deviation.value;
    let numerical = sensitivity.values[output];
    let area = spread.count as f64 * width;
    let density = |i: u32| {
        let away = f64::from(i) / 20.0 - 3.5;
        let height = area / (linear * std::f64::consts::TAU.sqrt()) * (-0.5 * away * away).exp();
        [numerical.value + away * linear, height]
    };
    let style = Style::solid(Colour::CONTACT).dash(Dash::Dashed);
    let normal = (linear > 0.0 && *width > 0.0).then(|| Line::new("linear", (0..=140).map(density), style));
    let [drawn, normal_size, error] = [spread.deviation, linear, numerical.error].map(|size| significant(size, 2));
    let title = format!("± {drawn} drawn, ± {normal_size} linear, ± {error} numerical");
    let panel = Panel::new(title, Axis::new(of.words(), unit), Axis::new("draws", "").including([0.0]))
        .height(32.0)
        .layer(Band { opacity: 0.5, ..Band::new("Monte Carlo", bars, Colour::FILM) })
        .layers(normal)
        .layer(Mark::vertical(numerical.value, ""));
    Some(panel)
}
