//! Uncertainties of the keys of a scene, and that of a result to first order.

use crate::analysis::error::AnalysisError;
use crate::analysis::variation::Variation;
use crate::digits::as_given;
use crate::estimate::Estimate;
use crate::problem::Problem;
use crate::scene::{Parameter, Scene};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal, StandardUniform};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Number of attempts after which a draw is given up.
const MOST_REDRAWN: usize = 1000;

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
    /// Uncertainties of keys of `scene`, by name.
    ///
    /// # Errors
    /// A key that cannot be varied, or an uncertainty that has no meaning for it.
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

    /// Random values of the keys, the problem there, and the number of draws that gave no valid scene.
    pub(super) fn draw(&self, number: u64, seed: u64) -> Result<(Vec<f64>, Problem, usize), String> {
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
    /// Its standard deviation, with the error caused by the errors of the derivatives.
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
