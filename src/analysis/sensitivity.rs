//! How much the results of a scene depend on each of its keys, and how uncertain they are if the keys are.
//!
//! Derivatives are those of [`super::variation`]. To first order, independent uncertainties u_k of the keys, each a standard deviation, make
//!
//! ```text
//! u² = Σ_k (∂f/∂p_k)² u_k²
//! ```
//!
//! of a result f. Monte Carlo draws the keys and solves every draw by the same plan, so that the error of the grids is nearly the same in all of
//! them and does not add to their spread; a plate that floats is solved by itself. The error is stated beside the uncertainty, never in it.

mod monte_carlo;
mod output;
mod uncertainty;

pub use monte_carlo::{Draw, MonteCarlo, Spread};
pub use uncertainty::{Propagated, Uncertainties, Uncertainty};

use super::attempt::error_in_words;
use super::error::AnalysisError;
use super::quantity::Quantity;
use super::variation::{Jacobian, KeyDerivatives, Slope, Variation};
use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::problem::Problem;
use crate::scene::{Parameter, ParameterKind, Scene};
use crate::solution::{Solution, Status};
use crate::solve::near::{Centre, is_settled};
use crate::solve::{Record, Settings, solve};
use output::{outputs, read};
use rayon::prelude::*;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Results of a scene, and their derivatives with respect to its keys.
#[derive(Debug)]
pub struct Sensitivity {
    variation: Variation,
    /// How it was solved.
    pub settings: Settings,
    /// The problem.
    pub problem: Problem,
    /// The status of the solve of the scene itself.
    pub status: Status,
    /// Warnings about that solve for the user.
    pub warnings: Vec<String>,
    /// The results, the headline first.
    pub outputs: &'static [Quantity],
    /// Their values, with their numerical errors; not finite where the scene has none.
    pub values: Vec<Estimate>,
    /// Derivatives of all of them with respect to each key.
    pub columns: Vec<KeyDerivatives>,
    /// The values extrapolated without the finest grid.
    coarse: Vec<Estimate>,
}

impl Sensitivity {
    /// The sensitivity of `scene` to `keys`, or to all keys that have an effect if there are none. The solves run on rayon's pool. `solved`
    /// is called after each of them with the total number of solves. `None` if cancelled.
    ///
    /// # Errors
    /// [`AnalysisError`]: a key that has no derivative, or a scene that cannot be solved.
    pub fn of<S: AsRef<str>>(
        scene: &Scene,
        keys: &[S],
        settings: &Settings,
        cancel: &Cancel,
        solved: &(dyn Fn(usize) + Sync),
    ) -> Result<Option<Self>, AnalysisError> {
        let problem = Problem::try_from(scene)?;
        let variation = if keys.is_empty() { Variation::all(scene) } else { Variation::new(scene, keys)? };
        let centre = Centre::new(&problem, settings, cancel)?;
        let Some(Jacobian { numbers, columns }) = variation.jacobian(&centre, &read, cancel, solved) else {
            return Ok(None);
        };
        let (outputs, values) = (outputs(&problem), numbers.fine);
        let coarse = numbers.coarse.unwrap_or_else(|| values.clone());
        let Solution { status, warnings, .. } = centre.solved.fine;
        Ok(Some(Self { variation, settings: *settings, problem, status, warnings, outputs, values, columns, coarse }))
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.variation.scene
    }

    /// Keys of the scene that have an effect and are whole numbers, which have no derivative.
    pub fn whole(&self) -> Vec<&'static str> {
        let whole = |parameter: &&'static Parameter| {
            matches!(parameter.kind, ParameterKind::Whole { .. }) && parameter.table() != "numerics"
        };
        self.scene().parameters().filter(whole).map(|parameter| parameter.key).collect()
    }

    /// The derivative of an output with respect to a key, in their units, with its estimated error; both are given by index. `None` if it
    /// is not known.
    pub fn slope(&self, output: usize, column: usize) -> Option<Estimate> {
        self.column_slope(output, column).map(|slope| Estimate { value: slope.value, error: slope.error() })
    }

    /// By what share of itself an output changes with a key: for a change of the key by as large a share of its own scale
    /// ([`KeyDerivatives::scale`]), or by one unit of a key that has none. Its error due to the grids is its own change if the finest grid is
    /// left out; that is less than the error of the derivative where derivative and output have the same relative error. `None` if it is
    /// not known, or if the error of the output is as large as the output.
    pub fn elasticity(&self, output: usize, column: usize) -> Option<Estimate> {
        let (slope, scale) = (self.column_slope(output, column)?, self.columns[column].scale().unwrap_or(1.0));
        let Estimate { value, error } = self.values[output];
        // An unknown error does not count here.
        let hidden = value == 0.0 || error >= value.abs();
        let of = |slope: f64, value: f64| slope * scale / value.abs();
        let found = of(slope.value, value);
        let grids = (found - of(slope.coarse, self.coarse[output].value)).abs();
        // If both give the same whole or half number to rounding, the output is that power of the key. Any other number may be the same in
        // both only because they have the same nodes across.
        let power = grids < SAME && (2.0 * found - (2.0 * found).round()).abs() < SAME;
        let least = if power { 0.0 } else { of(slope.least, value) };
        let error = of(slope.step_error + slope.left_out, value) + grids.max(least);
        (!hidden).then_some(Estimate { value: found, error })
    }

    fn column_slope(&self, output: usize, column: usize) -> Option<&Slope> {
        self.columns[column].slopes.as_ref().ok()?.get(output).filter(|slope| slope.value.is_finite())
    }

    /// The standard deviation of an output that follows from those of the keys, to first order.
    pub fn propagated(&self, output: usize, uncertainties: &Uncertainties) -> Propagated {
        let (mut parts, mut unknown) = (Vec::new(), Vec::new());
        for (parameter, at, given) in uncertainties.iter() {
            let column = self.columns.iter().position(|column| column.parameter == parameter);
            match column.and_then(|column| self.slope(output, column)) {
                Some(slope) => parts.push((parameter, slope * given.deviation(at))),
                None => unknown.push(parameter.key),
            }
        }
        let variance: f64 = parts.iter().map(|(_, part)| part.value * part.value).sum();
        let deviation = variance.sqrt();
        let error = if deviation > 0.0 {
            parts.iter().map(|(_, part)| part.value.abs() * part.error).sum::<f64>() / deviation
        } else {
            parts.iter().map(|(_, part)| part.error).sum()
        };
        Propagated { deviation: Estimate { value: deviation, error }, parts, unknown }
    }

    /// Bars of the tornado chart of an output, the greatest first: the elasticities of all keys that have a scale; or, if there are uncertain
    /// keys, the contribution of each to the uncertainty, in the unit of the output. And how many bars are left out because they are less than
    /// [`LEAST`] of the greatest.
    pub fn tornado(
        &self,
        output: usize,
        uncertainties: Option<&Uncertainties>,
    ) -> (Vec<(&'static Parameter, Estimate)>, usize) {
        let mut bars: Vec<_> = match uncertainties.filter(|uncertain| !uncertain.is_empty()) {
            None => {
                let columns = self.columns.iter().enumerate().filter(|(_, column)| column.scale().is_some());
                columns.filter_map(|(i, column)| Some((column.parameter, self.elasticity(output, i)?))).collect()
            }
            Some(uncertain) => self.propagated(output, uncertain).parts,
        };
        bars.sort_by(|(_, a), (_, b)| b.value.abs().total_cmp(&a.value.abs()));
        let least = LEAST * bars.first().map_or(0.0, |(_, bar)| bar.value.abs());
        let shown = bars.iter().take_while(|(_, bar)| bar.value.abs() >= least && bar.value != 0.0).count();
        let smaller = bars.len() - shown;
        bars.truncate(shown);
        (bars, smaller)
    }

    /// Solves `draws` random scenes of these uncertainties on rayon's pool; the same seed gives the same draws, whatever the number of threads.
    /// `solved` is told after each. Those that were solved before it was cancelled; `None` if none was.
    pub fn monte_carlo(
        &self,
        uncertainties: &Uncertainties,
        draws: usize,
        seed: u64,
        cancel: &Cancel,
        solved: &(dyn Fn() + Sync),
    ) -> Option<MonteCarlo> {
        // The gap at which a plate floats may be far from that of the scene itself: it is searched for again, without a starting point.
        let floats = self.problem.scenario.plate().is_some_and(|plate| plate.load.is_some());
        let centre = if floats { None } else { Some(Centre::new(&self.problem, &self.settings, cancel).ok()?) };
        let one = |number: usize| {
            if cancel.is_cancelled() {
                return None;
            }
            let found = uncertainties.draw(number as u64, seed).and_then(|(values, problem, redrawn)| {
                Ok((Draw { values, results: self.solve_draw(centre.as_ref(), &problem, cancel)? }, redrawn))
            });
            solved();
            // A solve that was cancelled does not count.
            (!cancel.is_cancelled()).then_some(found)
        };
        let found: Vec<_> = (0..draws).into_par_iter().filter_map(one).collect();
        if found.is_empty() {
            return None;
        }
        let mut carlo = MonteCarlo { seed, asked: draws, ..MonteCarlo::default() };
        for found in found {
            match found {
                Ok((draw, redrawn)) => {
                    carlo.redrawn += redrawn;
                    carlo.draws.push(draw);
                }
                Err(reason) => carlo.failures.push(reason),
            }
        }
        Some(carlo)
    }

    fn solve_draw(&self, centre: Option<&Centre>, problem: &Problem, cancel: &Cancel) -> Result<Vec<Estimate>, String> {
        let Some(centre) = centre else {
            let settings = Settings { record: Record::Numbers, ..self.settings };
            let found = error_in_words(|| solve(problem, &settings, &mut (), cancel))?;
            return if is_settled(found.status) {
                Ok(read(problem, &found))
            } else {
                Err("its cycle does not repeat".to_owned())
            };
        };
        let found = error_in_words(|| centre.solve(problem, cancel))?;
        Ok(read(problem, &found.ok_or("it has no periodic state on the grids of the scene")?.fine))
    }
}

/// Serialised without what follows from the scene.
impl Serialize for Sensitivity {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { variation, settings, status, warnings, values, columns, coarse, .. } = self;
        (variation, settings, status, warnings, values, columns, coarse).serialize(to)
    }
}

impl<'de> Deserialize<'de> for Sensitivity {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let carried = <(Variation, _, _, _, _, _, _)>::deserialize(from)?;
        let (variation, settings, status, warnings, values, columns, coarse) = carried;
        let problem = Problem::try_from(&variation.scene).map_err(D::Error::custom)?;
        let outputs = outputs(&problem);
        Ok(Self { variation, settings, problem, status, warnings, outputs, values, columns, coarse })
    }
}

/// Difference below which elasticities count as equal.
const SAME: f64 = 1e-6;

/// Bars of a tornado that are shorter than this share of the longest are left out.
pub const LEAST: f64 = 0.01;
