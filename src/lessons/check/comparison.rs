//! Comparisons of a check, and their evaluation for a run.

use super::name::{Name, Ran};
use crate::digits::{capitalised, short};
use crate::lessons::live::Live;
use crate::scene::Value;

/// Relative tolerance of `about`, unless the check gives another one.
pub(super) const ABOUT: f64 = 0.05;
/// Relative tolerance of `=`, `<=` and `>=` between numbers, so that a value that was typed passes.
const SAME: f64 = 1e-9;
/// Significant digits in a hint.
const DIGITS: usize = 3;
/// Most significant digits in a hint, where the value and the one that is asked for agree to fewer.
const MOST_DIGITS: usize = 9;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Comparison {
    pub(super) left: Expression,
    pub(super) operator: Operator,
    pub(super) right: Expression,
    /// Relative tolerance of `about`.
    pub(super) within: f64,
    /// The left side as written.
    pub(super) words: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Less,
    AtMost,
    More,
    AtLeast,
    Equal,
    About,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Expression {
    Number(f64),
    Text(String),
    Name { name: Name, start: bool },
    Negative(Box<Self>),
    Absolute(Box<Self>),
    Pair(char, Box<Self>, Box<Self>),
}

impl Comparison {
    /// Why it does not hold, in words; `None` if it holds.
    pub(super) fn unmet(&self, now: Ran<'_>, start: Ran<'_>) -> Option<String> {
        let subject = match &self.left {
            Expression::Name { name, start: false } => capitalised(&name.words()),
            _ => self.words.clone(),
        };
        if let (Expression::Name { name: Name::Key(key), .. }, Expression::Text(wanted)) = (&self.left, &self.right) {
            let present = match now.scene.get(key.key) {
                Some(Value::Text(text)) => text,
                Some(other) => other.to_string(),
                None => "none".to_owned(),
            };
            return (present != *wanted).then(|| format!("{subject} is {present}, and should be {wanted}"));
        }
        let (Some(left), Some(right)) = (self.left.value(now, start), self.right.value(now, start)) else {
            let tab = match &self.left {
                Expression::Name { name: Name::Live(live), .. } => format!("yet: see the tab {}", live.tab()),
                _ => "for this scene".to_owned(),
            };
            return Some(format!("{subject} is not known {tab}"));
        };
        let unit = match &self.left {
            Expression::Name { name, .. } => format!(" {}", name.unit(now.scene)).trim_end().to_owned(),
            _ => String::new(),
        };
        let words = match self.operator {
            Operator::Less => "below ",
            Operator::AtMost => "at most ",
            Operator::More => "above ",
            Operator::AtLeast => "at least ",
            Operator::Equal => "",
            Operator::About => "about ",
        };
        let to = match self.operator {
            Operator::About if self.within != ABOUT => format!(" to {} %", short(100.0 * self.within, DIGITS)),
            _ => String::new(),
        };
        let apart = (DIGITS..MOST_DIGITS).find(|digits| short(left, *digits) != short(right, *digits));
        let [is, wanted] = [left, right].map(|value| short(value, apart.unwrap_or(MOST_DIGITS)));
        (!self.holds(left, right)).then(|| format!("{subject} is {is}{unit}, and should be {words}{wanted}{unit}{to}"))
    }

    fn holds(&self, left: f64, right: f64) -> bool {
        let off = (left - right).abs();
        match self.operator {
            Operator::Less => left < right,
            Operator::AtMost => left <= right * (1.0 + SAME.copysign(right)),
            Operator::More => left > right,
            Operator::AtLeast => left >= right * (1.0 - SAME.copysign(right)),
            Operator::Equal => off <= SAME * right.abs().max(f64::MIN_POSITIVE),
            Operator::About => off <= self.within * right.abs(),
        }
    }
}

impl Expression {
    /// The numbers of tabs that it uses.
    pub(super) fn live(&self) -> Vec<Live> {
        match self {
            Self::Name { name: Name::Live(live), .. } => vec![*live],
            Self::Number(_) | Self::Text(_) | Self::Name { .. } => Vec::new(),
            Self::Negative(inside) | Self::Absolute(inside) => inside.live(),
            Self::Pair(_, left, right) => [left.live(), right.live()].concat(),
        }
    }

    /// Its value for the run `now` of a step that began with the run `begun`.
    pub(super) fn value(&self, now: Ran<'_>, begun: Ran<'_>) -> Option<f64> {
        let value = match self {
            Self::Number(number) => *number,
            Self::Text(_) => return None,
            Self::Name { name, start } => name.number(if *start { begun } else { now })?,
            Self::Negative(inside) => -inside.value(now, begun)?,
            Self::Absolute(inside) => inside.value(now, begun)?.abs(),
            Self::Pair(operator, left, right) => {
                let (left, right) = (left.value(now, begun)?, right.value(now, begun)?);
                match operator {
                    '+' => left + right,
                    '-' => left - right,
                    '*' => left * right,
                    _ => left / right,
                }
            }
        };
        value.is_finite().then_some(value)
    }
}
