//! Whether a value is one that its key takes.

use super::compliance;
use super::error::What;
use super::nearest::nearest;
use super::parameter::{Parameter, ParameterKind};
use super::value::{Value, show_text};

impl Parameter {
    /// The value as the key holds it: whole numbers are numbers, and numbers without a fraction are whole.
    pub(super) fn accept(&'static self, value: Value) -> Result<Value, What> {
        let wrong_type = |value: Value| Err(What::wrong_type(self, value.to_string()));
        let refused = |found, why, nearest| Err(What::Refused { parameter: self, found, why, nearest });
        match (self.kind, value) {
            (ParameterKind::Number { .. } | ParameterKind::Whole { .. }, value) => {
                let whole = matches!(self.kind, ParameterKind::Whole { .. });
                let Some(number) = value.as_number() else { return wrong_type(value) };
                match self.range().filter(|range| !range.contains(number)) {
                    _ if !number.is_finite() => refused(number.to_string(), "not finite", None),
                    _ if whole && number.fract() != 0.0 => wrong_type(value),
                    Some(range) => Err(What::OutOfRange { parameter: self, value, range }),
                    None if whole => Ok(Value::Whole(number as i64)),
                    None => Ok(Value::Number(number)),
                }
            }
            (ParameterKind::Choice { options, .. }, Value::Text(name)) if !options.contains(&name.as_str()) => {
                let nearest = nearest(&name, options.iter().copied()).map(str::to_owned);
                refused(format!("\"{}\"", show_text(&name)), "not available", nearest)
            }
            (ParameterKind::Rows, Value::Rows(rows)) => {
                compliance::check_rows(self.key, &rows)?;
                Ok(Value::Rows(rows))
            }
            (ParameterKind::Flag { .. }, value @ Value::Flag(_))
            | (ParameterKind::Choice { .. } | ParameterKind::Text { .. }, value @ Value::Text(_)) => Ok(value),
            (_, value) => wrong_type(value),
        }
    }

    /// The value written as `--set` takes it: a number in the key's unit, a name or text without quotes.
    pub(super) fn read(&'static self, text: &str) -> Result<Value, What> {
        let read = match self.kind {
            ParameterKind::Number { .. } | ParameterKind::Whole { .. } => text.parse().ok().map(Value::Number),
            ParameterKind::Flag { .. } => text.parse().ok().map(Value::Flag),
            ParameterKind::Choice { .. } | ParameterKind::Text { .. } => Some(Value::Text(text.to_owned())),
            ParameterKind::Rows | ParameterKind::CsvPath => None,
        };
        read.ok_or_else(|| What::wrong_type(self, show_text(text)))
    }
}
