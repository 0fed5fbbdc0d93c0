//! Checks whether a key accepts a value.

use super::compliance::{check_row_count, in_order};
use super::edges;
use super::error::{FaultKind, check_count};
use super::nearest::nearest;
use super::parameter::{Parameter, ParameterKind};
use super::quantity_text;
use super::value::{Value, show_text};

/// Most tables of an array.
const MOST_RECORDS: usize = 32;

/// Checks how many tables an array has; `fewest` is the least that its key allows.
pub(super) fn check_records(key: &'static str, count: usize, fewest: usize) -> Result<(), FaultKind> {
    check_count(key, "tables", count, fewest..=MOST_RECORDS)
}

/// The name in messages of one table of an array: its first value if that is a text, or else its number.
pub(super) fn named(first: Option<&str>, number: usize) -> String {
    first.filter(|name| !name.is_empty()).map_or_else(|| format!("number {number}"), show_text)
}

impl Parameter {
    /// The value in the type of the key: a whole number is accepted as a number, and a number without a fraction as a whole number.
    pub(super) fn accept(&'static self, value: Value) -> Result<Value, FaultKind> {
        let wrong_type = |value: Value| Err(FaultKind::wrong_type(self, value.to_string()));
        let refused = |found, why, nearest| Err(FaultKind::Refused { parameter: self, found, why, nearest });
        match (self.kind, value) {
            (ParameterKind::Number { .. } | ParameterKind::Whole { .. }, value) => {
                let whole = matches!(self.kind, ParameterKind::Whole { .. });
                let Some(number) = value.as_number() else { return wrong_type(value) };
                match self.range().filter(|range| !range.contains(number)) {
                    _ if !number.is_finite() => refused(number.to_string(), "not finite", None),
                    _ if whole && number.fract() != 0.0 => wrong_type(value),
                    Some(range) => Err(FaultKind::OutOfRange { parameter: self, value, range }),
                    None if whole => Ok(Value::Whole(number as i64)),
                    None => Ok(Value::Number(number)),
                }
            }
            (ParameterKind::Choice { options, .. }, Value::Text(name)) if !options.contains(&name.as_str()) => {
                let nearest = nearest(&name, options.iter().copied()).map(str::to_owned);
                refused(format!("\"{}\"", show_text(&name)), "not available", nearest)
            }
            (ParameterKind::Rows { columns }, Value::Rows(rows)) => {
                check_row_count(self.key, rows.len())?;
                let (mut wrong, rows) = (None, rows.into_iter().map(|row| ((), Ok(row))));
                let rows = in_order(self.key, columns, rows, |(), fault| {
                    wrong.get_or_insert(fault);
                });
                wrong.map_or(Ok(Value::Rows(rows)), Err)
            }
            (ParameterKind::Records { columns, fewest, .. }, Value::Records(records)) => {
                check_records(self.key, records.len(), fewest)?;
                let mut accepted = Vec::with_capacity(records.len());
                for (record, number) in records.into_iter().zip(1..) {
                    if record.len() != columns.len() {
                        return wrong_type(Value::Records(vec![record]));
                    }
                    let which = named(edges::name(&record), number);
                    let cells = columns.iter().zip(record).map(|(column, value)| column.accept(value));
                    let cells = cells.collect::<Result<_, _>>();
                    accepted.push(cells.map_err(|fault| FaultKind::Within {
                        key: self.key,
                        which,
                        fault: fault.into(),
                    })?);
                }
                Ok(Value::Records(accepted))
            }
            // An empty array, when it is read back, does not show whether it was one of rows or of tables.
            (ParameterKind::Records { fewest: 0, .. }, Value::Rows(rows)) if rows.is_empty() => {
                Ok(Value::Records(Vec::new()))
            }
            (ParameterKind::Flag { .. }, value @ Value::Flag(_))
            | (ParameterKind::Choice { .. } | ParameterKind::Text { .. }, value @ Value::Text(_)) => Ok(value),
            (_, value) => wrong_type(value),
        }
    }

    /// The value written as `--set` takes it: a number in the key's unit, or with another of its kind, a name or text without quotes.
    pub(super) fn read(&'static self, text: &str) -> Result<Value, FaultKind> {
        let read = match self.kind {
            ParameterKind::Number { .. } | ParameterKind::Whole { .. } => {
                // Commas are between the values of a list.
                let typed = || quantity_text::number(self.unit, text).filter(|_| !text.contains(','));
                let number = text.parse().ok().or_else(typed).map(Value::Number);
                let message = || quantity_text::no_number(self, text);
                return number.ok_or_else(|| FaultKind::Rule { key: self.key, message: message() });
            }
            ParameterKind::Flag { .. } => text.parse().ok().map(Value::Flag),
            ParameterKind::Choice { .. } | ParameterKind::Text { .. } => Some(Value::Text(text.to_owned())),
            ParameterKind::Rows { .. } | ParameterKind::CsvPath { .. } | ParameterKind::Records { .. } => None,
        };
        read.ok_or_else(|| FaultKind::wrong_type(self, show_text(text)))
    }
}
