//! How much the results of a scene depend on each of its keys, and how uncertain they are if the keys are.
//!
//! Derivatives are those of [`super::variation`]. To first order, independent uncertainties u_k of the keys, each a standard deviation, make
//!
//! ```text
//! u² = Σ_k (∂f/∂p_k)² u_k²
//! ```
//!
//! of a result f. Monte Carlo draws the keys and solves every draw by the same plan, so that the error of the grids is nearly the same in all of
//! them and does not add to their spread. It is stated beside the uncertainty, never in it.

use super::attempt::told;
use super::error::AnalysisError;
use super::exact::{Harmonic, solved, units};
use super::quantity::{Numbers, Quantity, labelled};
use super::tradeoff::quantile;
use super::variation::{Column, Jacobian, Slope, Variation};
use crate::control::Cancel;
use crate::digits::as_given;
use crate::estimate::Estimate;
use crate::problem::{Problem, Scenario};
use crate::scene::{Parameter, ParameterKind, Scene};
use crate::solution::{Outcome, Solution, Status, settled};
use crate::solve::near::Centre;
use crate::solve::{Settings, SolveError};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal, StandardUniform};
use rayon::prelude::*;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;
use std::sync::OnceLock;

/// A result whose sensitivity is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// One of the numbers of every solve.
    Number(Quantity),
    /// Stiffness of a plate's film.
    Stiffness,
    /// Damping of a plate's film.
    Damping,
}

impl Output {
    /// Those of a problem, the headline first.
    pub fn of(problem: &Problem) -> &'static [Self] {
        use Quantity::{Alpha, FilmLoad, MeanGap, NoLoadSpeed, StallTorque};
        match &problem.scenario {
            Scenario::Motor(_) => &[Self::Number(Alpha), Self::Number(StallTorque), Self::Number(NoLoadSpeed)],
            Scenario::Plate(plate) if plate.load.is_some() => &[Self::Number(MeanGap), Self::Stiffness, Self::Damping],
            Scenario::Plate(_) => &[Self::Number(FilmLoad), Self::Stiffness, Self::Damping],
        }
    }

    /// Its name in files, with its unit.
    pub fn name(self) -> &'static str {
        match self {
            Self::Number(quantity) => quantity.name(),
            Self::Stiffness => "stiffness_n_per_m",
            Self::Damping => "damping_n_s_per_m",
        }
    }

    /// The name of its numerical error.
    pub fn error_name(self) -> &'static str {
        match self {
            Self::Number(quantity) => quantity.error().map_or("", Quantity::name),
            Self::Stiffness => "stiffness_error_n_per_m",
            Self::Damping => "damping_error_n_s_per_m",
        }
    }

    /// Its description in words, without the unit.
    pub fn words(self) -> &'static str {
        match self {
            Self::Number(quantity) => quantity.words(),
            Self::Stiffness => "dynamic stiffness",
            Self::Damping => "dynamic damping",
        }
    }

    /// Its unit in the results of `problem`; empty for a pure number.
    pub fn unit(self, problem: &Problem) -> &'static str {
        match (self, &problem.scenario) {
            (Self::Number(quantity), _) => quantity.unit(problem),
            (Self::Stiffness, Scenario::Plate(plate)) => units(plate)[0],
            (Self::Damping, Scenario::Plate(plate)) => units(plate)[1],
            _ => "",
        }
    }

    /// Its description with its unit after a comma.
    pub fn label(self, problem: &Problem) -> String {
        labelled(self.words(), self.unit(problem))
    }

    /// Its value in a solution, whose lines are kept, with its stated numerical error; not finite where it has none.
    fn read(self, problem: &Problem, solution: &Solution, numbers: &Numbers) -> Estimate {
        let harmonic = |part: fn(&Harmonic<Estimate>) -> Estimate, unit: fn(&Harmonic<f64>) -> f64| {
            let (Scenario::Plate(plate), Outcome::Plate(result)) = (&problem.scenario, &solution.outcome) else {
                return None;
            };
            Some(part(&solved(plate, result, &solution.recording)?) * unit(&Harmonic::unit(plate)))
        };
        let found = match self {
            Self::Number(quantity) => numbers.estimate(quantity),
            Self::Stiffness => harmonic(|found| found.spring, |unit| unit.spring),
            Self::Damping => harmonic(|found| found.damping, |unit| unit.damping),
        };
        found.unwrap_or(Estimate { value: f64::NAN, error: f64::NAN })
    }
}

/// All outputs of a solution of `problem`.
fn read(problem: &Problem, solution: &Solution) -> Vec<Estimate> {
    let problem = &*settled(problem, &solution.outcome);
    let numbers = Numbers::of(problem, solution);
    Output::of(problem).iter().map(|output| output.read(problem, solution, &numbers)).collect()
}

fn values(problem: &Problem, solution: &Solution) -> Vec<f64> {
    read(problem, solution).into_iter().map(|found| found.value).collect()
}

/// Results of a scene, and their derivatives by its keys.
#[derive(Debug)]
pub struct Sensitivity {
    variation: Variation,
    /// How it was solved.
    pub settings: Settings,
    /// The problem.
    pub problem: Problem,
    /// Solve from which random scenes start: not serialized, but solved again.
    centre: OnceLock<Centre>,
    /// How the solve in the middle ended.
    pub status: Status,
    /// Warnings about that solve for the user.
    pub warnings: Vec<String>,
    /// The results, the headline first.
    pub outputs: &'static [Output],
    /// Their values, with their numerical errors; not finite where the scene has none.
    pub values: Vec<Estimate>,
    /// Derivatives of all of them by each key.
    pub columns: Vec<Column>,
    /// The values without the finest grid.
    coarse: Vec<f64>,
}

impl Sensitivity {
    /// Of `scene` by `keys`, or by all that act if there are none. The solves run on rayon's pool; `solved` is told after each how many there
    /// will be. `None` if cancelled.
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
        let centre = Centre::new(&problem, settings, None, cancel)?;
        let Some(Jacobian { numbers, mut columns }) =
            variation.jacobian(&variation.values(), &centre, &values, cancel, solved)
        else {
            return Ok(None);
        };
        let (outputs, values) = (Output::of(&problem), read(&problem, &centre.solved.fine));
        for column in &mut columns {
            column.expect(&values);
        }
        let coarse = numbers.coarse.unwrap_or(numbers.fine);
        let (status, warnings) = (centre.solved.fine.status, centre.solved.fine.warnings.clone());
        let (settings, centre) = (*settings, OnceLock::from(centre));
        Ok(Some(Self { variation, settings, problem, centre, status, warnings, outputs, values, columns, coarse }))
    }

    /// Solve from which random scenes start, made on first use.
    fn centre(&self, cancel: &Cancel) -> Result<&Centre, SolveError> {
        match self.centre.get() {
            Some(centre) => Ok(centre),
            None => {
                let centre = Centre::new(&self.problem, &self.settings, None, cancel)?;
                Ok(self.centre.get_or_init(|| centre))
            }
        }
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.variation.scene
    }

    /// Keys that act in the scene and are whole numbers, which have no derivative.
    pub fn whole(&self) -> Vec<&'static str> {
        let whole = |parameter: &&'static Parameter| {
            matches!(parameter.kind, ParameterKind::Whole { .. }) && parameter.table() != "numerics"
        };
        self.scene().parameters().filter(whole).map(|parameter| parameter.key).collect()
    }

    /// The derivative of an output by a key, in their units, with its estimated error; both by their place. `None` if it is not known.
    pub fn slope(&self, output: usize, column: usize) -> Option<Estimate> {
        self.column_slope(output, column).map(|slope| Estimate { value: slope.value, error: slope.error() })
    }

    /// By what share of itself an output changes with a key: for a change of the key by as large a share of its own scale
    /// ([`Column::scale`]), or by one unit of a key that has none. Its error by the grids is how it changes itself without the finest one, which is
    /// less than that of the derivative where that is off as the output is. `None` if it is not known, or the output is nothing but its
    /// error.
    pub fn elasticity(&self, output: usize, column: usize) -> Option<Estimate> {
        let (slope, scale) = (self.column_slope(output, column)?, self.columns[column].scale().unwrap_or(1.0));
        let Estimate { value, error } = self.values[output];
        // An error that is not known hides nothing.
        let hidden = value == 0.0 || error >= value.abs();
        let of = |slope: f64, value: f64| slope * scale / value.abs();
        let found = of(slope.value, value);
        let grids = (found - of(slope.coarse, self.coarse[output])).abs();
        // Where both ladders have the same to rounding, the output is a power of the key.
        let least = if grids < SAME { 0.0 } else { of(slope.least, value) };
        let error = of(slope.step_error + slope.left_out, value) + grids.max(least);
        (!hidden).then_some(Estimate { value: found, error })
    }

    fn column_slope(&self, output: usize, column: usize) -> Option<&Slope> {
        self.columns[column].slopes.as_ref().ok()?.get(output).filter(|slope| slope.value.is_finite())
    }

    /// The standard deviation of an output that these of the keys make, to first order.
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
    /// `solved` is told after each. `None` if cancelled.
    pub fn monte_carlo(
        &self,
        uncertainties: &Uncertainties,
        draws: usize,
        seed: u64,
        cancel: &Cancel,
        solved: &(dyn Fn() + Sync),
    ) -> Option<MonteCarlo> {
        // Known, unless this was carried here: then it is solved as it was before.
        let centre = self.centre(cancel).ok()?;
        let one = |number: usize| {
            let found = uncertainties.draw(number as u64, seed).and_then(|(values, problem, redrawn)| {
                let results = if cancel.is_cancelled() { Vec::new() } else { solve_draw(centre, &problem, cancel)? };
                Ok((Draw { values, results }, redrawn))
            });
            solved();
            found
        };
        let found: Vec<_> = (0..draws).into_par_iter().map(one).collect();
        if cancel.is_cancelled() {
            return None;
        }
        let mut carlo = MonteCarlo { seed, ..MonteCarlo::default() };
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
}

fn solve_draw(centre: &Centre, problem: &Problem, cancel: &Cancel) -> Result<Vec<Estimate>, String> {
    let found = told(|| centre.solve(problem, cancel))?.ok_or("it has no periodic state on the grids of the scene")?;
    Ok(read(problem, &found.fine))
}

/// In bytes: all but what random scenes are solved from, and what follows from the scene.
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
        let (outputs, centre) = (Output::of(&problem), OnceLock::new());
        Ok(Self { variation, settings, problem, centre, status, warnings, outputs, values, columns, coarse })
    }
}

/// Elasticities that differ by less are the same.
const SAME: f64 = 1e-6;

/// Bars of a tornado that are shorter than this share of the longest are left out.
pub const LEAST: f64 = 0.01;

/// A draw is given up after so many.
const MOST_REDRAWN: usize = 1000;

// ---- uncertainties

/// The uncertainty of a key, as in `20%`, `10` or `±10`: a standard deviation, or limits if it begins with `±`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// Standard deviation or limit, in the unit of the key, or as a share of its value.
    pub amount: f64,
    /// Whether it is a share.
    pub relative: bool,
    /// Whether it is limits, between which all values are equally likely; otherwise the standard deviation of a normal distribution.
    pub limits: bool,
}

impl Uncertainty {
    /// The standard deviation of a key whose value is `at`, in its unit.
    pub fn deviation(&self, at: f64) -> f64 {
        let amount = if self.relative { self.amount * at.abs() } else { self.amount };
        if self.limits { amount / 3f64.sqrt() } else { amount }
    }

    /// A random value of a key whose value is `at`.
    fn draw(&self, at: f64, random: &mut ChaCha8Rng) -> f64 {
        let away: f64 = if self.limits {
            let share: f64 = StandardUniform.sample(random);
            (2.0 * share - 1.0) * 3f64.sqrt()
        } else {
            StandardNormal.sample(random)
        };
        at + self.deviation(at) * away
    }
}

impl FromStr for Uncertainty {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bare = text.trim();
        let limits = bare.strip_prefix('±').or_else(|| bare.strip_prefix("+-"));
        let number = limits.unwrap_or(bare);
        let (number, relative) = number.strip_suffix('%').map_or((number, false), |number| (number, true));
        match number.trim().replace(',', ".").parse::<f64>() {
            Ok(amount) if amount > 0.0 && amount.is_finite() => {
                let amount = if relative { amount / 100.0 } else { amount };
                Ok(Self { amount, relative, limits: limits.is_some() })
            }
            _ => Err(format!(
                "uncertainty {text}: expected a standard deviation above 0 in the unit of the key or in per cent, as 10 or 20%, or limits, \
                 as ±10"
            )),
        }
    }
}

impl fmt::Display for Uncertainty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.limits { "±" } else { "" };
        if self.relative {
            write!(f, "{sign}{}%", as_given(100.0 * self.amount))
        } else {
            write!(f, "{sign}{}", self.amount)
        }
    }
}

/// Uncertainties of keys of one scene, which are independent of each other.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Uncertainties {
    variation: Variation,
    given: Vec<Uncertainty>,
}

impl Uncertainties {
    /// Of keys of `scene` by name.
    ///
    /// # Errors
    /// A key that cannot be varied, or an uncertainty that means nothing for it.
    pub fn new<S: AsRef<str>>(scene: &Scene, given: &[(S, Uncertainty)]) -> Result<Self, AnalysisError> {
        let keys: Vec<&str> = given.iter().map(|(key, _)| key.as_ref()).collect();
        let given = given.iter().map(|(_, uncertainty)| *uncertainty).collect();
        let found = Self { variation: Variation::new(scene, &keys)?, given };
        let meaningless = |(parameter, at, given): &(&Parameter, f64, Uncertainty)| {
            given.relative && (*at == 0.0 || parameter.unit == "°C")
        };
        if let Some((Parameter { key, unit, .. }, at, given)) = found.iter().find(meaningless) {
            return Err(AnalysisError::Input(format!(
                "uncertainty of {key} = {given}: its value is {at} {unit}, of which a share means nothing; give it in {unit}"
            )));
        }
        Ok(found)
    }

    /// Each key, its value in the scene, and its uncertainty.
    pub fn iter(&self) -> impl Iterator<Item = (&'static Parameter, f64, Uncertainty)> {
        let keys = self.variation.parameters.iter().zip(self.variation.values()).zip(&self.given);
        keys.map(|((parameter, at), given)| (*parameter, at, *given))
    }

    /// The standard deviation of a key in its unit, if it is uncertain.
    pub fn deviation(&self, parameter: &Parameter) -> Option<f64> {
        self.iter().find(|(other, ..)| other.key == parameter.key).map(|(_, at, given)| given.deviation(at))
    }

    /// Whether no key is uncertain.
    pub fn is_empty(&self) -> bool {
        self.given.is_empty()
    }

    /// Random values of the keys, what is to be solved there, and how often what was drawn is no scene.
    fn draw(&self, number: u64, seed: u64) -> Result<(Vec<f64>, Problem, usize), String> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(number);
        for redrawn in 0..MOST_REDRAWN {
            let values: Vec<f64> = self.iter().map(|(_, at, given)| given.draw(at, &mut random)).collect();
            if let Ok(problem) = self.variation.problem(&values) {
                return Ok((values, problem, redrawn));
            }
        }
        Err(format!("of {MOST_REDRAWN} draws none is within the ranges of its keys"))
    }
}

/// The uncertainty of a result, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Propagated {
    /// Its standard deviation, with the error that those of the derivatives make.
    pub deviation: Estimate,
    /// Contribution of each key, signed, in the unit of the result.
    pub parts: Vec<(&'static Parameter, Estimate)>,
    /// Uncertain keys whose derivative is not known; their contribution is missing.
    pub unknown: Vec<&'static str>,
}

impl Propagated {
    /// The share of the variance that comes from a key; `None` if it is not known, or there is no variance.
    pub fn share(&self, parameter: &Parameter) -> Option<f64> {
        let (_, part) = self.parts.iter().find(|(other, _)| other.key == parameter.key)?;
        (self.deviation.value > 0.0).then(|| (part.value / self.deviation.value).powi(2))
    }
}

// ---- Monte Carlo

/// One draw: the values of the uncertain keys in their order, and the results.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Draw {
    /// Values of the keys, in their units.
    pub values: Vec<f64>,
    /// Results in the order of the outputs, with their numerical errors; not finite where the draw has none.
    pub results: Vec<Estimate>,
}

/// Results of random scenes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MonteCarlo {
    /// Where the random numbers began.
    pub seed: u64,
    /// Those that were solved, in the order in which they were drawn.
    pub draws: Vec<Draw>,
    /// Why others were not.
    pub failures: Vec<String>,
    /// How many draws were outside of the ranges of their keys, or broke a rule between keys, and were drawn again: what they would have given is
    /// missing.
    pub redrawn: usize,
}

/// How the draws of one result are distributed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spread {
    /// How many there are.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// Quantiles of 5, 50 and 95 %.
    pub quantiles: [f64; 3],
    /// Bins of equal width from the least draw to the greatest: where the first begins, how wide they are, how many draws each has.
    pub bins: (f64, f64, Vec<usize>),
}

impl Spread {
    /// Whether the mean is not `value`, by more than chance and than a tenth of the spread.
    pub fn is_off(&self, value: f64) -> bool {
        (self.mean - value).abs() > (3.0 * self.mean_error()).max(0.1 * self.deviation)
    }

    /// The standard deviation that the mean has because there are so many draws and no more.
    pub fn mean_error(&self) -> f64 {
        self.deviation / (self.count as f64).sqrt()
    }
}

impl MonteCarlo {
    /// Of the outputs at a place; `None` with fewer than two draws.
    pub fn spread(&self, output: usize) -> Option<Spread> {
        let mut found: Vec<f64> = self
            .draws
            .iter()
            .filter_map(|draw| draw.results.get(output))
            .map(|found| found.value)
            .filter(|v| v.is_finite())
            .collect();
        found.sort_by(f64::total_cmp);
        let (count, last) = (found.len(), found.len().checked_sub(1)?);
        if last == 0 {
            return None;
        }
        let mean = found.iter().sum::<f64>() / count as f64;
        let deviation = (found.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / last as f64).sqrt();
        // Twice the cube root: Rice's rule.
        let number = if found[last] > found[0] { (2.0 * (count as f64).cbrt()).ceil() as usize } else { 1 };
        let width = (found[last] - found[0]) / number as f64;
        let mut bins = vec![0; number];
        for value in &found {
            let bin = if width > 0.0 { ((value - found[0]) / width) as usize } else { 0 };
            bins[bin.min(number - 1)] += 1;
        }
        let quantiles = [0.05, 0.5, 0.95].map(|share| quantile(&found, share));
        Some(Spread { count, mean, deviation, quantiles, bins: (found[0], width, bins) })
    }
}
