//! Round numbers on axes, of figures and of the window.

use crate::digits::signed;
use std::ops::RangeInclusive;

/// Round numbers on an axis.
#[derive(Clone, Copy, Debug)]
pub struct Steps {
    step: f64,
    first: i64,
    last: i64,
}

impl Steps {
    /// About `about` steps over `range`, each 1, 2 or 5 times a power of ten.
    pub fn new(range: [f64; 2], about: usize) -> Self {
        Self::apart(range, (range[1] - range[0]) / about.max(1) as f64)
    }

    /// As [`Self::new`], with more steps if there would be only one number above `least`, which does not show the scale of the axis; but
    /// not with more than there is room for, `most`.
    pub fn several(range: [f64; 2], least: f64, about: usize, most: f64) -> Self {
        let span = range[1] - range[0];
        let seen = |steps: &Self| steps.values().filter(|value| *value >= least - 1e-6 * span).count();
        // Eight steps or more have two numbers wherever the range is.
        let mut more = (about..about + 9).map(|about| Self::new(range, about));
        more.find(|steps| seen(steps) > 1 && span / steps.step <= most).unwrap_or_else(|| Self::new(range, about))
    }

    /// Steps over `range` of at least `least`, each 1, 2 or 5 times a power of ten.
    pub fn apart(range: [f64; 2], least: f64) -> Self {
        Self::of(range, round_up(least))
    }

    /// The multiples of `step` in `range`.
    pub fn of(range: [f64; 2], step: f64) -> Self {
        let first = (range[0] / step - 1e-6).ceil() as i64;
        Self { step, first, last: (range[1] / step + 1e-6).floor() as i64 }
    }

    /// Minor steps: each step is divided into 4 or 5, so that numbers stay round. Returns also which of the two.
    pub fn divided(self, range: [f64; 2]) -> (Self, i64) {
        let lead = self.step / 10f64.powf((self.step.log10() + 1e-9).floor());
        let every = if (1.5..3.0).contains(&lead) { 4 } else { 5 };
        (Self::of(range, self.step / every as f64), every)
    }

    /// The round numbers as multiples of the step, ascending; at most 101.
    pub fn numbers(self) -> RangeInclusive<i64> {
        self.first..=self.last.min(self.first.saturating_add(100))
    }

    /// The round numbers, ascending.
    pub fn values(self) -> impl Iterator<Item = f64> {
        self.numbers().map(move |number| number as f64 * self.step)
    }

    /// Decimals that distinguish neighbouring numbers after division by ten to the power `power`.
    pub fn decimals(&self, power: i32) -> usize {
        (f64::from(power) - self.step.log10() - 1e-9).ceil().clamp(0.0, 15.0) as usize
    }

    /// The step from one number to the next.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// `value` with as many decimals as the step needs.
    pub fn format(&self, value: f64) -> String {
        signed(format!("{value:.*}", self.decimals(0)))
    }
}

/// A round number on a logarithmic axis: a digit times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decimal {
    /// From 1 to 9.
    pub digit: u32,
    /// Of ten.
    pub exponent: i32,
    /// Whether it has a label.
    pub major: bool,
}

impl Decimal {
    /// The number, to the last bit as it is read from a text.
    pub fn value(self) -> f64 {
        format!("{}e{}", self.digit, self.exponent).parse().unwrap_or(f64::NAN)
    }
}

/// Round numbers over a `range` of log₁₀, ascending, about `most` of them with labels: powers of ten, and 2 and 5 times each where there is room.
/// `None` where fewer than two would have one: the axis is short enough for equal steps.
pub fn decades(range: [f64; 2], most: usize) -> Option<Vec<Decimal>> {
    // Beyond are no numbers in double precision.
    let range = range.map(|end| end.clamp(-330.0, 330.0));
    let count = range[1] - range[0];
    if !count.is_finite() {
        return None;
    }
    let every = ((count / most as f64).ceil() as i32).max(1);
    let labelled: &[u32] = if count * 3.0 <= most as f64 + 0.5 { &[1, 2, 5] } else { &[1] };
    let digits = if every == 1 { 1..=9 } else { 1..=1 };
    let found: Vec<Decimal> = (range[0].floor() as i32..=range[1].ceil() as i32)
        .map(|exponent| (exponent, exponent.rem_euclid(every) == 0))
        // So many decades that a tick for each would be a bar.
        .filter(|(_, labels)| *labels || count <= 40.0)
        .flat_map(|(exponent, labels)| {
            let digits = digits.clone();
            digits.map(move |digit| Decimal { digit, exponent, major: labels && labelled.contains(&digit) })
        })
        .filter(|number| {
            let place = f64::from(number.exponent) + f64::from(number.digit).log10();
            (range[0] - 1e-9 * count..=range[1] + 1e-9 * count).contains(&place)
        })
        .collect();
    (found.iter().filter(|number| number.major).count() > 1).then_some(found)
}

/// The least of 1, 2, 5 × 10ⁿ that is not below `value`.
pub fn round_up(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let power = 10f64.powf(value.log10().floor());
    let lead = value / power;
    let lead = [1.0, 2.0, 5.0].into_iter().find(|round| lead <= round * (1.0 + 1e-9)).unwrap_or(10.0);
    lead * power
}

/// The greatest of 1, 2, 5 × 10ⁿ that is not above `value`.
pub fn round_down(value: f64) -> f64 {
    1.0 / round_up(1.0 / value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let steps = Steps::new([-1.4, 24.6], 6);
        assert_eq!(steps.values().collect::<Vec<_>>(), [0.0, 5.0, 10.0, 15.0, 20.0]);
        let steps = Steps::new([0.0, 0.031], 4);
        let texts: Vec<String> = steps.values().map(|value| steps.format(value)).collect();
        assert_eq!(texts, ["0.00", "0.01", "0.02", "0.03"]);
        let several = |range, least, about| Steps::several(range, least, about, 4.0).values().collect::<Vec<_>>();
        assert_eq!(several([0.15, 1.9], 0.15, 1), [0.5, 1.0, 1.5], "1 alone has no scale");
        assert_eq!(several([0.0, 2.2], 0.1, 1), [0.0, 1.0, 2.0], "nor has 2, if 0 is not seen");
        assert_eq!(several([0.0, 2.2], 0.0, 1), [0.0, 2.0]);
        assert_eq!(several([9.1, 10.9], 9.1, 1), [9.5, 10.0, 10.5]);
        assert_eq!(several([9.51, 10.49], 9.51, 1), [10.0], "there is no room for more");
        assert!(Steps::new([0.0, 0.0], 3).values().count() <= 101);
        assert!(Steps::new([1e300, -1e300], 0).values().count() <= 101);
    }

    #[test]
    fn decades_are_thinned_where_they_are_many_and_filled_where_they_are_few() {
        let labelled = |range, most| -> Option<Vec<f64>> {
            let major = decades(range, most)?.into_iter().filter(|number| number.major);
            Some(major.map(Decimal::value).collect())
        };
        assert_eq!(labelled([-1.5, 3.4], 10), Some(vec![0.1, 1.0, 10.0, 100.0, 1000.0]));
        assert_eq!(labelled([-4.0, 5.0], 3), Some(vec![1e-3, 1.0, 1e3]));
        assert_eq!(labelled([0.0, 1.0], 9), Some(vec![1.0, 2.0, 5.0, 10.0]));
        assert_eq!(decades([0.0, 2.0], 4).map(|numbers| numbers.len()), Some(19));
        assert!(decades([-1e12, f64::INFINITY], 4).is_some_and(|numbers| numbers.len() < 10));
        for range in [[0.0, 0.0], [0.02, 0.3], [f64::NAN, 1.0]] {
            assert_eq!(decades(range, 4), None);
        }
    }

    #[test]
    fn steps_are_round() {
        assert!((round_down(3.9) - 2.0).abs() < 1e-12);
        assert!((round_up(3.9) - 5.0).abs() < 1e-12);
    }
}
