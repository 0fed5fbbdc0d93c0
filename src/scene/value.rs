//! The value of a key, of any type, and how values are shown to people.

use serde::{Deserialize, Serialize};
use std::fmt;

/// The value of one key of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// A number, in the unit of its key.
    Number(f64),
    /// A whole number.
    Whole(i64),
    /// true or false.
    Flag(bool),
    /// Text, or the name of a choice.
    Text(String),
    /// Rows of a table of pairs of numbers, in the units of its columns.
    Rows(Vec<(f64, f64)>),
    /// An array of tables, each as the values of its columns, in their order.
    Records(Vec<Vec<Value>>),
}

impl Value {
    /// The value as a number, if it is one.
    pub fn as_number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Whole(whole) => Some(*whole as f64),
            Self::Flag(_) | Self::Text(_) | Self::Rows(_) | Self::Records(_) => None,
        }
    }

    /// The value as text, if it is one.
    pub(super) fn as_text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => f.write_str(&show_number(*number)),
            Self::Whole(whole) => write!(f, "{whole}"),
            Self::Flag(flag) => write!(f, "{flag}"),
            Self::Text(text) => f.write_str(&show_text(text)),
            Self::Rows(rows) => write!(f, "{} rows", rows.len()),
            Self::Records(records) if records.is_empty() => f.write_str("none"),
            Self::Records(records) => {
                let cells = |record: &Vec<Self>| record.iter().map(Self::to_string).collect::<Vec<_>>().join(" ");
                f.write_str(&records.iter().map(cells).collect::<Vec<_>>().join("; "))
            }
        }
    }
}

/// A number as a person would write it: with plain digits from 1e-4 to 1e6, with an exponent outside of that. It has the fewest digits that
/// distinguish it from every other number.
pub(super) fn show_number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !size.is_finite() || (1e-4..1e6).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Most characters of a text that is shown in a title or a message.
const LONGEST: usize = 60;

/// A text that is safe to show on one line of a terminal: it is [`escaped`], and cut if it is long.
pub(crate) fn show_text(text: &str) -> String {
    show_up_to(LONGEST, text)
}

/// [`show_text`] with so many characters.
pub(crate) fn show_up_to(longest: usize, text: &str) -> String {
    match text.char_indices().nth(longest) {
        Some((end, _)) => escaped(&text[..end]) + "…",
        None => escaped(text),
    }
}

/// A text from a file as it is shown. Control characters, invisible ones, and those that change the direction of the text after them are
/// written as escapes, such as `\u{202e}`.
pub(crate) fn escaped(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_unseen(c) {
            shown.extend(c.escape_default());
        } else {
            shown.push(c);
        }
    }
    shown
}

/// Whether a character is invisible, or changes how the text around it is shown.
pub(crate) fn is_unseen(c: char) -> bool {
    c.is_control() || UNSEEN.iter().any(|range| range.contains(&c))
}

/// Marks of direction, separators of lines, joiners that no script needs, and code points that are not characters.
const UNSEEN: [std::ops::RangeInclusive<char>; 9] = [
    '\u{61c}'..='\u{61c}',
    '\u{200b}'..='\u{200b}',
    '\u{200e}'..='\u{200f}',
    '\u{2028}'..='\u{202e}',
    '\u{2060}'..='\u{206f}',
    '\u{feff}'..='\u{feff}',
    '\u{fff9}'..='\u{fffb}',
    '\u{fffe}'..='\u{ffff}',
    '\u{e0000}'..='\u{e007f}',
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_as_people_write_them() {
        for (value, shown) in [
            (0.0, "0"),
            (3.0, "3"),
            (-10000.0, "-10000"),
            (0.001, "0.001"),
            (1.05e-10, "1.05e-10"),
            (1e9, "1e9"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(show_number(value), shown);
        }
    }

    #[test]
    fn text_stays_on_one_line() {
        assert_eq!(show_text("a\nb\u{1b}[1m"), "a\\nb\\u{1b}[1m");
        assert_eq!(escaped("µ \u{202e}x\u{200b}\u{9b}"), "µ \\u{202e}x\\u{200b}\\u{9b}");
        assert_eq!(show_text(&"x".repeat(100)).chars().count(), 61);
    }
}
