//! What is varied in a sweep: keys, their ranges and the values between, and what is wrong with them.

use crate::scene::{Parameter, ParameterKind, Scale, Scene, SceneError, Value};
use crate::solve::SolveError;
use std::str::FromStr;

/// Most values of one key.
pub const MOST_VALUES: usize = 10_000;

/// Most points of a sweep.
pub const MOST_POINTS: usize = 100_000;

/// What to vary: `key=from:to:count` or `key=from:to:count:log`.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// Dotted key, as in `--set`.
    pub key: String,
    /// First value, in the unit of the key.
    pub from: f64,
    /// Last value, in the unit of the key.
    pub to: f64,
    /// How many values, both ends counted.
    pub count: usize,
    /// Equal steps or equal ratios.
    pub scale: Scale,
}

impl FromStr for Vary {
    type Err = SweepError;

    fn from_str(text: &str) -> Result<Self, SweepError> {
        let syntax = || SweepError::Syntax { found: text.to_owned() };
        let (key, range) = text.split_once('=').ok_or_else(syntax)?;
        let parts: Vec<&str> = range.split(':').map(str::trim).collect();
        let (ends, scale) = match parts[..] {
            [from, to, count] | [from, to, count, "lin"] => ([from, to, count], Scale::Linear),
            [from, to, count, "log"] => ([from, to, count], Scale::Log),
            _ => return Err(syntax()),
        };
        let number = |text: &str| text.parse::<f64>().map_err(|_| syntax());
        let (from, to) = (number(ends[0])?, number(ends[1])?);
        let key = key.trim().to_owned();
        let count = ends[2].parse().map_err(|_| SweepError::Count { key: key.clone(), found: ends[2].to_owned() })?;
        Ok(Self { key, from, to, count, scale })
    }
}

/// One axis of a sweep: a key and its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The key.
    pub parameter: &'static Parameter,
    /// Its values in the unit of the key, in the order they were asked for.
    pub values: Vec<f64>,
    /// Equal steps or equal ratios.
    pub scale: Scale,
}

impl Axis {
    /// Checks what is to be varied against the scene, and spaces its values. The keys are not yet checked together.
    ///
    /// # Errors
    /// [`SweepError`], which names the key, the value and what is allowed.
    pub fn new(scene: &Scene, vary: &Vary) -> Result<Self, SweepError> {
        let Vary { key, from, to, count, scale } = vary;
        let parameter = match Parameter::find(key) {
            Some(parameter) => parameter,
            // Setting it tells what is wrong with it.
            None => {
                return match scene.clone().set(key, "0") {
                    Err(error) => Err(error.into()),
                    Ok(()) => Err(SweepError::Syntax { found: key.clone() }),
                };
            }
        };
        let whole = match parameter.kind {
            ParameterKind::Number { .. } => false,
            ParameterKind::Whole { .. } => true,
            _ => return Err(SweepError::NotANumber { parameter }),
        };
        for end in [from, to] {
            scene.clone().set_value(key, Value::Number(*end))?;
        }
        if !(2..=MOST_VALUES).contains(count) {
            return Err(SweepError::Count { key: key.clone(), found: count.to_string() });
        }
        if from == to {
            return Err(SweepError::Nothing { key: key.clone(), at: *from });
        }
        if *scale == Scale::Log && (*from <= 0.0 || *to <= 0.0) {
            return Err(SweepError::Log { key: key.clone(), from: *from, to: *to });
        }
        let mut values = spaced(*from, *to, *count, *scale);
        if whole {
            values.iter_mut().for_each(|value| *value = value.round());
            values.dedup();
        }
        Ok(Self { parameter, values, scale: *scale })
    }
}

/// What cannot be swept. Found before anything is solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SweepError {
    /// Not of the form asked for.
    #[error(
        "vary {found}: expected key=from:to:count or key=from:to:count:log, as in film.min_spacing_nm=50:400:8:log"
    )]
    Syntax {
        /// What was given.
        found: String,
    },
    /// Too few values, or too many.
    #[error("vary {key}: count = {found} is out of range: allowed 2 to {MOST_VALUES}")]
    Count {
        /// The key.
        key: String,
        /// The count given.
        found: String,
    },
    /// Both ends are the same.
    #[error("vary {key}: from {at} to {at} is no range: the ends have to differ")]
    Nothing {
        /// The key.
        key: String,
        /// Both ends.
        at: f64,
    },
    /// Equal ratios from or to zero or below.
    #[error("vary {key}: from {from} to {to} cannot be spaced by equal ratios: for :log both ends have to be above 0")]
    Log {
        /// The key.
        key: String,
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
    },
    /// A key whose values are not numbers.
    #[error("vary {}: it accepts {}, and only a number can be varied", parameter.key, parameter.accepts())]
    NotANumber {
        /// The key.
        parameter: &'static Parameter,
    },
    /// No axis, or more than two.
    #[error("vary: {found} keys given: allowed 1 or 2")]
    Axes {
        /// How many.
        found: usize,
    },
    /// Two axes with one key.
    #[error("vary {key}: given twice: the two keys have to differ")]
    Twice {
        /// The key.
        key: String,
    },
    /// More points than anyone waits for.
    #[error("vary: {found} points: allowed up to {MOST_POINTS}")]
    Points {
        /// How many.
        found: usize,
    },
    /// A value outside its range, or a key that does not exist.
    #[error("{0}")]
    Scene(#[from] SceneError),
    /// A method that does not apply, or more memory than is allowed.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// `count` values from `from` to `to`, both exact; those between to ten digits, so that they can be written down.
pub fn spaced(from: f64, to: f64, count: usize, scale: Scale) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1);
    let value = |i: usize| {
        let share = i as f64 / last as f64;
        match (i, scale) {
            (0, _) => from,
            (i, _) if i == last => to,
            (_, Scale::Linear) => short(from * (1.0 - share) + to * share),
            (_, Scale::Log) => short((from.ln() * (1.0 - share) + to.ln() * share).exp()),
        }
    };
    (0..count).map(value).collect()
}

fn short(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}
