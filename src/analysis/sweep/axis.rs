//! What is varied in a sweep: keys, their ranges and the values between, and what is wrong with them.

use crate::digits::as_given;
use crate::scene::{Parameter, ParameterKind, Scale, Scene, SceneError, Value};
use crate::solve::SolveError;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::fmt;
use std::str::FromStr;

/// Most values of one key.
pub const MOST_VALUES: usize = 10_000;
/// Most points of a sweep, or of a part of it that is solved alone.
pub const MOST_POINTS: usize = 100_000;
/// Most keys that are varied at once.
pub const MOST_KEYS: usize = 3;

/// What to vary: `key=from:to:count`, `key=from:to:count:log` or `key=value,value,…`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Vary {
    /// Dotted key, as in `--set`.
    pub key: String,
    /// Its values.
    pub values: Values,
}

/// The values of a key that is varied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Values {
    /// Numbers from one end to the other.
    Range {
        /// First value, in the unit of the key.
        from: f64,
        /// Last value, in the unit of the key.
        to: f64,
        /// How many values, both ends counted.
        count: usize,
        /// Equal steps or equal ratios.
        scale: Scale,
    },
    /// Each as in `--set`.
    List(Vec<String>),
}

/// As it is given.
impl fmt::Display for Vary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.values {
            Values::Range { from, to, count, scale } => {
                let scale = if *scale == Scale::Log { ":log" } else { "" };
                write!(f, "{}={from}:{to}:{count}{scale}", self.key)
            }
            Values::List(words) => write!(f, "{}={}", self.key, words.join(",")),
        }
    }
}

impl SweepError {
    /// What is wrong, said where it is: the key need not be named.
    pub fn in_place(&self) -> String {
        match self {
            Self::Count { found, .. } => format!("{found} values: allowed 2 to {MOST_VALUES}"),
            Self::Nothing { .. } => "Both ends are the same: they have to differ".to_owned(),
            Self::Log { .. } => "For equal ratios both ends have to be above 0".to_owned(),
            Self::Twice { .. } => "Both axes vary the same parameter: choose another".to_owned(),
            other => other.to_string(),
        }
    }
}

impl FromStr for Vary {
    type Err = SweepError;

    fn from_str(text: &str) -> Result<Self, SweepError> {
        let syntax = || SweepError::Syntax { found: text.to_owned() };
        let (key, values) = text.split_once('=').ok_or_else(syntax)?;
        let key = key.trim().to_owned();
        if !values.contains(':') {
            return Ok(Self {
                key,
                values: Values::List(values.split(',').map(|word| word.trim().to_owned()).collect()),
            });
        }
        let parts: Vec<&str> = values.split(':').map(str::trim).collect();
        let (ends, scale) = match parts[..] {
            [from, to, count] | [from, to, count, "lin"] => ([from, to, count], Scale::Linear),
            [from, to, count, "log"] => ([from, to, count], Scale::Log),
            _ => return Err(syntax()),
        };
        let number = |text: &str| text.parse::<f64>().map_err(|_| syntax());
        let (from, to) = (number(ends[0])?, number(ends[1])?);
        let count = ends[2].parse().map_err(|_| SweepError::Count { key: key.clone(), found: ends[2].to_owned() })?;
        Ok(Self { key, values: Values::Range { from, to, count, scale } })
    }
}

/// One axis of a sweep: a key and its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The key.
    pub parameter: &'static Parameter,
    /// Its values in the unit of the key, in the order they were asked for; of words their places in `words`.
    pub values: Vec<f64>,
    /// The values if they are not all numbers, as in `--set`; otherwise empty.
    pub words: Vec<String>,
    /// Equal steps or equal ratios.
    pub scale: Scale,
}

impl Axis {
    /// Checks what is to be varied against the scene, and spaces its values. The keys are not yet checked together.
    ///
    /// # Errors
    /// [`SweepError`], which names the key, the value and what is allowed.
    pub fn new(scene: &Scene, vary: &Vary) -> Result<Self, SweepError> {
        let key = &vary.key;
        let Some(parameter) = Parameter::find(key) else {
            // Setting it tells what is wrong with it.
            scene.clone().set(key, "0")?;
            return Err(SweepError::Syntax { found: key.clone() });
        };
        let count = match &vary.values {
            Values::Range { count, .. } => *count,
            Values::List(words) => words.len(),
        };
        let allowed = (2..=MOST_VALUES).contains(&count);
        match &vary.values {
            Values::List(words) => {
                let mut there = HashSet::new();
                for word in words {
                    scene.clone().set(key, word)?;
                    if !there.insert(word) {
                        return Err(SweepError::Repeated { key: key.clone(), value: word.clone() });
                    }
                }
                if !allowed {
                    return Err(SweepError::Syntax { found: format!("{key}={}", words.join(",")) });
                }
                let numbers: Result<Vec<f64>, _> = words.iter().map(|word| word.parse()).collect();
                let (values, words) = match numbers {
                    Ok(numbers) => (numbers, Vec::new()),
                    Err(_) => ((0..count).map(|place| place as f64).collect(), words.clone()),
                };
                Ok(Self { parameter, values, words, scale: Scale::Linear })
            }
            Values::Range { from, to, scale, .. } => {
                let whole = match parameter.kind {
                    ParameterKind::Number { .. } => false,
                    ParameterKind::Whole { .. } => true,
                    _ => return Err(SweepError::NotANumber { parameter }),
                };
                for end in [from, to] {
                    scene.clone().set_value(key, Value::Number(*end))?;
                }
                if !allowed {
                    return Err(SweepError::Count { key: key.clone(), found: count.to_string() });
                }
                if from == to {
                    return Err(SweepError::Nothing { key: key.clone(), at: *from });
                }
                if *scale == Scale::Log && (*from <= 0.0 || *to <= 0.0) {
                    return Err(SweepError::Log { key: key.clone(), from: *from, to: *to });
                }
                let mut values = spaced(*from, *to, count, *scale);
                if whole {
                    values.iter_mut().for_each(|value| *value = value.round());
                    values.dedup();
                }
                Ok(Self { parameter, values, words: Vec::new(), scale: *scale })
            }
        }
    }

    /// A value as it is written in `--set`.
    pub fn text(&self, value: f64) -> String {
        self.words.get(value as usize).cloned().unwrap_or_else(|| value.to_string())
    }
}

/// What cannot be swept. Found before anything is solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SweepError {
    /// Not of the form asked for.
    #[error(
        "vary {found}: expected key=from:to:count or key=from:to:count:log, as in film.min_spacing_nm=50:400:8:log, or a list of two \
         values or more, as in film.slip=none,first-order"
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
    #[error("vary {}: it accepts {}, and only a number has a range; list its values, divided by commas", parameter.key, parameter.accepts())]
    NotANumber {
        /// The key.
        parameter: &'static Parameter,
    },
    /// A list with the same value twice.
    #[error("vary {key}: {value} is listed twice")]
    Repeated {
        /// The key.
        key: String,
        /// The value.
        value: String,
    },
    /// No axis, or more than [`MOST_KEYS`].
    #[error("vary: {found} keys given: allowed 1 to {MOST_KEYS}")]
    Axes {
        /// How many.
        found: usize,
    },
    /// Two axes with one key.
    #[error("vary {key}: given twice: the keys have to differ")]
    Twice {
        /// The key.
        key: String,
    },
    /// More points than anyone waits for.
    #[error(
        "vary: {found} points{}: allowed up to {MOST_POINTS}, or as many in each part of sweep --part",
        if *parts == 1 { String::new() } else { format!(" in one of {parts} parts") }
    )]
    Points {
        /// How many.
        found: usize,
        /// In one of how many parts; 1 is the whole.
        parts: usize,
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
            (_, Scale::Linear) => as_given(from * (1.0 - share) + to * share),
            (_, Scale::Log) => as_given((from.ln() * (1.0 - share) + to.ln() * share).exp()),
        }
    };
    (0..count).map(value).collect()
}
