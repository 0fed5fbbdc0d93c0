//! The keys that are chosen, each within its bounds.

use crate::analysis::error::AnalysisError;
use crate::digits::short;
use crate::scene::quantity_text::end_of_range;
use crate::scene::{Parameter, ParameterKind, Scale, Scene, Value};
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// Most keys that are chosen at once.
pub const MOST_UNKNOWNS: usize = 12;
/// Bounds with at least this ratio are searched on a logarithmic scale.
const WIDE: f64 = 10.0;

/// A key to choose, and its bounds: `key=from:to`, `key=from:to:log` or `key=from:to:lin`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// Dotted key, as in `--set`.
    pub key: String,
    /// Lower bound, in the unit of the key.
    pub from: f64,
    /// Upper bound, in the unit of the key.
    pub to: f64,
    /// Equal steps or equal ratios; `None`: by ratios if the upper bound is at least ten times the lower one.
    pub scale: Option<Scale>,
}

impl FromStr for Bounds {
    type Err = AnalysisError;

    fn from_str(text: &str) -> Result<Self, AnalysisError> {
        let syntax = || no_bounds(text);
        let (key, range) = text.split_once('=').ok_or_else(syntax)?;
        let key = key.trim().to_owned();
        if let Some(parameter) = Parameter::find(&key).filter(|parameter| parameter.range().is_none()) {
            return Err(no_number(parameter));
        }
        let parts: Vec<&str> = range.split(':').map(str::trim).collect();
        let (from, to, scale) = match parts[..] {
            [from, to] => (from, to, None),
            [from, to, "log"] => (from, to, Some(Scale::Log)),
            [from, to, "lin"] => (from, to, Some(Scale::Linear)),
            _ => return Err(syntax()),
        };
        let number = |text| end_of_range(&key, text).map_err(|fault| AnalysisError::Input(format!("vary {fault}")));
        Ok(Self { from: number(from)?, to: number(to)?, key, scale })
    }
}

/// The error for bounds that do not have the required form.
fn no_bounds(found: &str) -> AnalysisError {
    let expected = "expected key=from:to or key=from:to:log, as in film.min_spacing_nm=100:400";
    AnalysisError::Input(format!("vary {found}: {expected}"))
}

/// The error for bounds of a key that is not a number, or is a whole number.
fn no_number(parameter: &Parameter) -> AnalysisError {
    AnalysisError::Input(format!(
        "vary {}: it accepts {}; only a key that is a number, and not a whole one, can be chosen between two bounds",
        parameter.key,
        parameter.accepts()
    ))
}

/// Which bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Bound {
    /// The lower one.
    Lower,
    /// The upper one.
    Upper,
}

impl Bound {
    /// `lower` or `upper`: as files have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lower => "lower",
            Self::Upper => "upper",
        }
    }

    /// The bound that x, from 0 to 1, is closer to than `within`.
    pub(super) fn near(x: f64, within: f64) -> Option<Self> {
        match x {
            x if x < within => Some(Self::Lower),
            x if x > 1.0 - within => Some(Self::Upper),
            _ => None,
        }
    }

    /// Its position from 0 to 1.
    pub(super) fn place(self) -> f64 {
        match self {
            Self::Lower => 0.0,
            Self::Upper => 1.0,
        }
    }
}

/// A key that is chosen, checked against the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unknown {
    /// The key.
    pub parameter: &'static Parameter,
    /// Lower bound, in the unit of the key.
    pub from: f64,
    /// Upper bound, in the unit of the key.
    pub to: f64,
    /// How the range between them is searched.
    pub scale: Scale,
    /// The value to start from: that of the scene, or the middle of the bounds if that lies outside of them.
    pub start: f64,
}

impl Unknown {
    /// Checks bounds against the scene.
    pub fn new(scene: &Scene, bounds: &Bounds) -> Result<Self, AnalysisError> {
        let key = &bounds.key;
        let Some(parameter) = Parameter::find(key) else {
            // Setting the key reports what is wrong with it.
            scene.clone().set(key, "0")?;
            return Err(no_bounds(key));
        };
        for end in [bounds.from, bounds.to] {
            scene.clone().set_value(key, Value::Number(end))?;
        }
        if !matches!(parameter.kind, ParameterKind::Number { .. }) {
            return Err(no_number(parameter));
        }
        let (from, to) = (bounds.from.min(bounds.to), bounds.from.max(bounds.to));
        let range = |why| AnalysisError::Input(format!("vary {key}: from {from} to {to} {why}"));
        if from == to {
            return Err(range("is no range: the ends have to differ"));
        }
        let wide = from > 0.0 && to / from >= WIDE;
        let scale = bounds.scale.unwrap_or(if wide { Scale::Log } else { Scale::Linear });
        if scale == Scale::Log && from <= 0.0 {
            return Err(range("cannot be searched by equal ratios: for :log both ends have to be above 0"));
        }
        let mut unknown = Self { parameter, from, to, scale, start: 0.0 };
        let present = scene.get(key).and_then(|value| value.as_number()).filter(|at| (from..=to).contains(at));
        unknown.start = present.unwrap_or_else(|| unknown.value(0.5));
        Ok(unknown)
    }

    /// The value at x from 0 to 1.
    pub fn value(&self, x: f64) -> f64 {
        match (x, self.scale) {
            (x, _) if x <= 0.0 => self.from,
            (x, _) if x >= 1.0 => self.to,
            (x, Scale::Linear) => self.from + x * (self.to - self.from),
            (x, Scale::Log) => self.from * (self.to / self.from).powf(x),
        }
    }

    /// Where a value lies from 0 to 1.
    pub fn place(&self, value: f64) -> f64 {
        let x = match self.scale {
            Scale::Linear => (value - self.from) / (self.to - self.from),
            Scale::Log => (value / self.from).ln() / (self.to / self.from).ln(),
        };
        x.clamp(0.0, 1.0)
    }

    /// d value / dx at x.
    pub fn slope(&self, x: f64) -> f64 {
        match self.scale {
            Scale::Linear => self.to - self.from,
            Scale::Log => self.value(x) * (self.to / self.from).ln(),
        }
    }

    /// Its key and its value at x, for people: `film.min_spacing_nm = 200 nm`.
    pub(super) fn with_value(&self, x: f64) -> String {
        format!("{} = {}", self.parameter.key, self.parameter.with_unit(short(self.value(x), 4)))
    }
}
