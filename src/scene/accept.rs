//! Whether a value is one that its key takes.

use super::compliance;
use super::error::What;
use super::nearest::nearest;
use super::parameter::{Parameter, ParameterKind};
use super::value::{Value, show_text};

impl Parameter {
    /// The value as the key holds it: whole numbers are numbers, and numbers without a fraction are whole.
    pub(super) fn accept(&'static self, value: Value) -> Result<Value, What> {
        let parameter = self;
        match (self.kind, value) {
            (
                ParameterKind::Number { .. } | ParameterKind::Whole { .. },
                value @ (Value::Number(_) | Value::Whole(_)),
            ) => {
                let whole = matches!(self.kind, ParameterKind::Whole { .. });
                let (number, range) = (value.as_number().unwrap_or(f64::NAN), self.range());
                match range.filter(|range| !range.contains(number)) {
                    _ if !number.is_finite() => Err(What::NotFinite { parameter, value: number }),
                    _ if whole && number.fract() != 0.0 => Err(What::WrongType { parameter, found: value.to_string() }),
                    Some(range) => Err(What::OutOfRange { parameter, value, range }),
                    None if whole => Ok(Value::Whole(number as i64)),
                    None => Ok(Value::Number(number)),
                }
            }
            (ParameterKind::Flag { .. }, value @ Value::Flag(_))
            | (ParameterKind::Text { .. }, value @ Value::Text(_)) => Ok(value),
            (ParameterKind::Choice { options, .. }, Value::Text(name)) => {
                if options.contains(&name.as_str()) {
                    Ok(Value::Text(name))
                } else if self.key == "rotor.model" && name == "ring" {
                    Err(What::ReservedModel)
                } else {
                    let nearest = nearest(&name, options.iter().copied()).map(str::to_owned);
                    Err(What::NotAChoice { parameter, value: show_text(&name), nearest })
                }
            }
            (ParameterKind::Rows, Value::Rows(rows)) => {
                compliance::check_rows(self.key, &rows).map(|()| Value::Rows(rows))
            }
            (_, value) => Err(What::WrongType { parameter, found: value.to_string() }),
        }
    }

    /// The value written as `--set` takes it: a number in the key's unit, a name or text without quotes, rows as in TOML.
    pub(super) fn read(&'static self, text: &str) -> Result<Value, What> {
        let read = match self.kind {
            ParameterKind::Number { .. } | ParameterKind::Whole { .. } => text.parse().ok().map(Value::Number),
            ParameterKind::Flag { .. } => text.parse().ok().map(Value::Flag),
            ParameterKind::Choice { .. } | ParameterKind::Text { .. } => Some(Value::Text(text.to_owned())),
            ParameterKind::Rows | ParameterKind::CsvPath => None,
        };
        read.ok_or_else(|| What::WrongType { parameter: self, found: show_text(text) })
    }
}
