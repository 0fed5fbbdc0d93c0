//! The axes of a sweep: keys, their ranges and the values between, and the checks of them.

use crate::analysis::error::AnalysisError;
use crate::digits::as_given;
use crate::scene::quantity_text::end_of_range;
use crate::scene::{Parameter, ParameterKind, Scale, Scene, Value};
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::fmt;
use std::str::FromStr;

/// Most values of one key.
pub const MOST_VALUES: usize = 10_000;
/// Most points of a sweep, or of a part that is solved alone.
pub const MOST_POINTS: usize = 100_000;
/// Most keys that are varied at once.
pub const MOST_KEYS: usize = 3;

/// A key to vary, and its values: `key=from:to:count`, `key=from:to:count:log` or `key=value,value,…`.
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
    /// Values, each as in `--set`.
    List(Vec<String>),
}

/// Written as on the command line.
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

impl FromStr for Vary {
    type Err = AnalysisError;

    fn from_str(text: &str) -> Result<Self, AnalysisError> {
        let syntax = || no_vary(text);
        let (key, values) = text.split_once('=').ok_or_else(syntax)?;
        let key = key.trim().to_owned();
        if !values.contains(':') {
            let words = values.split(',').map(|word| word.trim().to_owned()).collect();
            return Ok(Self { key, values: Values::List(words) });
        }
        if let Some(parameter) = Parameter::find(&key).filter(|parameter| parameter.range().is_none()) {
            return Err(no_range(parameter));
        }
        let parts: Vec<&str> = values.split(':').map(str::trim).collect();
        let (from, to, count, scale) = match parts[..] {
            [from, to, count] | [from, to, count, "lin"] => (from, to, count, Scale::Linear),
            [from, to, count, "log"] => (from, to, count, Scale::Log),
            _ => return Err(syntax()),
        };
        let number = |text| end_of_range(&key, text).map_err(|fault| AnalysisError::Input(format!("vary {fault}")));
        let (from, to) = (number(from)?, number(to)?);
        let count = count.parse().map_err(|_| count_fault(&key, count))?;
        Ok(Self { key, values: Values::Range { from, to, count, scale } })
    }
}

/// One axis of a sweep: a key and its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The key.
    pub parameter: &'static Parameter,
    /// Its values in the unit of the key, in the given order; for words, their indices in `words`.
    pub values: Vec<f64>,
    /// The values as in `--set` if they are not all numbers; otherwise empty.
    pub words: Vec<String>,
    /// Equal steps or equal ratios.
    pub scale: Scale,
}

impl Axis {
    /// Checks an axis against the scene, and computes its values. The keys are not checked in combination yet.
    pub fn new(scene: &Scene, vary: &Vary) -> Result<Self, AnalysisError> {
        let key = &vary.key;
        let Some(parameter) = Parameter::find(key) else {
            // Setting the key reports what is wrong with it.
            scene.clone().set(key, "0")?;
            return Err(no_vary(key));
        };
        let allowed = 2..=MOST_VALUES;
        match &vary.values {
            Values::List(words) => {
                let (mut there, mut numbers) = (HashSet::new(), Vec::new());
                for word in words {
                    let mut scene = scene.clone();
                    scene.set(key, word)?;
                    // The values are in the unit of the key, whatever unit they were given in.
                    let number = scene.get(key).and_then(|value| value.as_number());
                    numbers.extend(number);
                    if !there.insert(number.map_or_else(|| word.clone(), |number| number.to_string())) {
                        return Err(AnalysisError::Input(format!("vary {key}: {word} is listed twice")));
                    }
                }
                if !allowed.contains(&words.len()) {
                    return Err(no_vary(&format!("{key}={}", words.join(","))));
                }
                let (values, words) = if numbers.len() == words.len() {
                    (numbers, Vec::new())
                } else {
                    ((0..words.len()).map(|place| place as f64).collect(), words.clone())
                };
                Ok(Self { parameter, values, words, scale: Scale::Linear })
            }
            Values::Range { from, to, count, scale } => {
                let whole = match parameter.kind {
                    ParameterKind::Number { .. } => false,
                    ParameterKind::Whole { .. } => true,
                    _ => return Err(no_range(parameter)),
                };
                for end in [from, to] {
                    scene.clone().set_value(key, Value::Number(*end))?;
                }
                if !allowed.contains(count) {
                    return Err(count_fault(key, &count.to_string()));
                }
                if from == to {
                    return Err(AnalysisError::Field {
                        message: format!("vary {key}: from {from} to {to} is no range: the ends have to differ"),
                        in_place: "Both ends are the same: they have to differ".to_owned(),
                    });
                }
                if *scale == Scale::Log && (*from <= 0.0 || *to <= 0.0) {
                    return Err(AnalysisError::Field {
                        message: format!(
                            "vary {key}: from {from} to {to} cannot be spaced by equal ratios: for :log both ends have to be above 0"
                        ),
                        in_place: "For equal ratios both ends have to be above 0".to_owned(),
                    });
                }
                let mut values = spaced(*from, *to, *count, *scale);
                if whole {
                    values.iter_mut().for_each(|value| *value = value.round());
                    values.dedup();
                }
                Ok(Self { parameter, values, words: Vec::new(), scale: *scale })
            }
        }
    }

    /// A value as it is written for `--set`.
    pub fn text(&self, value: f64) -> String {
        self.words.get(value as usize).cloned().unwrap_or_else(|| value.to_string())
    }
}

/// The error for a text that does not have the required form.
fn no_vary(found: &str) -> AnalysisError {
    AnalysisError::Input(format!(
        "vary {found}: expected key=from:to:count or key=from:to:count:log, as in film.min_spacing_nm=50:400:8:log, or a list of two \
         values or more, as in film.slip=none,first-order"
    ))
}

/// The error for a range of a key that is not a number.
fn no_range(parameter: &Parameter) -> AnalysisError {
    let (key, accepts) = (parameter.key, parameter.accepts());
    let example = match parameter.kind {
        ParameterKind::Choice { options: [.., first, second], .. } => format!(", such as {key}={first},{second}"),
        _ => String::new(),
    };
    AnalysisError::Input(format!(
        "vary {key}: it accepts {accepts}, and only a number has a range: give a list{example}"
    ))
}

/// The error for a range with too few or too many values.
fn count_fault(key: &str, found: &str) -> AnalysisError {
    AnalysisError::Field {
        message: format!("vary {key}: count = {found} is out of range: allowed 2 to {MOST_VALUES}"),
        in_place: format!("{found} values: allowed 2 to {MOST_VALUES}"),
    }
}

/// `count` values from `from` to `to`; the ends are exact, the others have ten digits, so that they can be written down.
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
