//! Whether a value is one that its key takes.

use super::compliance;
use super::error::What;
use super::nearest::nearest;
use super::parameter::{Parameter, ParameterKind};
use super::value::{Value, show_text};

/// Most tables of an array.
const MOST_RECORDS: usize = 32;

/// Checks how many tables there are.
pub(super) fn check_count(key: &'static str, count: usize, fewest: usize) -> Result<(), What> {
    let allowed = fewest..=MOST_RECORDS;
    if allowed.contains(&count) { Ok(()) } else { Err(What::Count { key, count, fewest, most: MOST_RECORDS }) }
}

/// What a message calls one of an array of tables: its name, if it begins with one, or its number.
pub(super) fn named(record: &[Value], number: usize) -> String {
    match record.first() {
        Some(Value::Text(name)) if !name.is_empty() => show_text(name),
        _ => format!("number {number}"),
    }
}

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
            (ParameterKind::Rows { columns }, Value::Rows(rows)) => {
                compliance::check_rows(self.key, columns, &rows)?;
                Ok(Value::Rows(rows))
            }
            (ParameterKind::Records { columns, fewest, .. }, Value::Records(records)) => {
                check_count(self.key, records.len(), fewest)?;
                let mut accepted = Vec::with_capacity(records.len());
                for (record, number) in records.into_iter().zip(1..) {
                    if record.len() != columns.len() {
                        return wrong_type(Value::Records(vec![record]));
                    }
                    let which = named(&record, number);
                    let cells = columns.iter().zip(record).map(|(column, value)| column.accept(value));
                    let cells = cells.collect::<Result<_, _>>();
                    accepted.push(cells.map_err(|fault| What::Record {
                        key: self.key,
                        which,
                        fault: Box::new(fault),
                    })?);
                }
                Ok(Value::Records(accepted))
            }
            // Read back from where no table tells what it is a table of.
            (ParameterKind::Records { fewest: 0, .. }, Value::Rows(rows)) if rows.is_empty() => {
                Ok(Value::Records(Vec::new()))
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
            ParameterKind::Rows { .. } | ParameterKind::CsvPath { .. } | ParameterKind::Records { .. } => None,
        };
        read.ok_or_else(|| What::wrong_type(self, show_text(text)))
    }
}
