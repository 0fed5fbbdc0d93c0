//! Numbers and words as the window shows them.

use crate::digits::{raised, rounded, signed};
use crate::estimate::Estimate;

/// Share of its error below which a value is shown as 0.
const NOTHING: f64 = 0.05;

/// `value` with about three significant digits.
pub fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 4.0) as usize;
    signed(format!("{value:.decimals$}"))
}

/// The ends of a range, with enough digits to tell them apart: with three digits, 99.96 and 100.02 are both 100. If four digits are not
/// enough, both texts are equal.
pub fn ends(range: [f64; 2]) -> [String; 2] {
    let written = range.map(number);
    let span = range[1] - range[0];
    if written[0] == written[1] || span.is_nan() || span >= NARROW * range[0].abs().max(range[1].abs()) {
        return written;
    }
    let decimals = (-span.log10()).ceil().max(0.0) as usize;
    range.map(|value| signed(format!("{value:.decimals$}")))
}

/// Ratio of a range's length to its greater end below which three digits are not enough for its ends.
const NARROW: f64 = 0.02;

/// "×9000", to two digits.
pub fn times(factor: f64) -> String {
    if !(factor.is_finite() && factor > 0.0) {
        return "×1".to_owned();
    }
    let rounded = rounded(factor, 2);
    let decimals = if rounded < 10.0 { 1 } else { 0 };
    format!("×{rounded:.decimals$}")
}

/// A value with its error, with the exponent as a superscript. A value far below its error is shown as 0.
pub fn uncertain(found: Estimate) -> String {
    let value = if found.value.abs() < NOTHING * found.error { 0.0 } else { found.value };
    raised(&Estimate { value, ..found }.to_string())
}

/// A time in the unit that suits it.
pub fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1e-4 => format!("{:.2} µs", s * 1e6),
        s if s < 1e-1 => format!("{:.2} ms", s * 1e3),
        s => format!("{s:.2} s"),
    }
}

/// A factor with its digits in groups of three.
pub fn thousands(value: f64) -> String {
    if value < 10.0 {
        return format!("{value:.2}");
    }
    let digits = format!("{value:.0}");
    let groups: Vec<_> = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy).collect();
    groups.join("\u{202f}")
}

/// The remaining time, in whole seconds or minutes.
pub fn rough(seconds: f64) -> String {
    if seconds < 99.5 { format!("{:.0} s", seconds.max(1.0)) } else { format!("{:.0} min", seconds / 60.0) }
}

/// The unit that suits loads up to `greatest` \[N, of a `strip` N/m\]: its name and its size.
pub fn load_unit(greatest: f64, strip: bool) -> (&'static str, f64) {
    match (greatest < 0.5, strip) {
        (true, false) => ("mN", 1e-3),
        (true, true) => ("mN/m", 1e-3),
        (false, false) => ("N", 1.0),
        (false, true) => ("N/m", 1.0),
    }
}

/// A value rounded to the last digit that its error leaves known, with at most three decimals.
pub fn with_known_digits(value: f64, error: f64) -> String {
    let decimals = if error > 0.0 { (-error.log10().floor()).clamp(0.0, 3.0) } else { 3.0 };
    let least = 10f64.powf(-decimals);
    let decimals = decimals as usize;
    let sign = if value < -0.5 * least { "−" } else { "" };
    format!("{sign}{:.decimals$} ± {:.decimals$}", value.abs(), error.max(least))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_and_a_true_minus() {
        assert_eq!(number(1234.6), "1235");
        assert_eq!(number(0.012345), "0.0123");
        assert_eq!(number(-12.34), "−12.3");
        assert_eq!(number(-0.00001), "0.0000");
        assert_eq!(number(0.0), "0");
        assert_eq!(times(9012.0), "×9000");
        assert_eq!(times(0.0), "×1");
    }

    #[test]
    fn ends_of_a_range_are_told_apart_where_they_round_to_the_same() {
        assert_eq!(ends([79.5, 541.3]), ["79.5", "541"]);
        assert_eq!(ends([99.96, 100.02]), ["99.96", "100.02"]);
        assert_eq!(ends([99.88, 100.12]), ["99.9", "100.1"]);
        assert_eq!(ends([9.997, 10.0]), ["9.997", "10.000"]);
        assert_eq!(ends([-100.02, -99.96]), ["−100.02", "−99.96"]);
        assert_eq!(ends([101.325, 101.3251]), ["101", "101"]);
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!(thousands(180_000.4), "180\u{202f}000");
        assert_eq!(thousands(12.0), "12");
        assert_eq!(time(3.333e-5), "33.33 µs");
        assert_eq!(time(0.5), "0.50 s");
    }

    #[test]
    fn a_force_has_the_digits_that_are_known() {
        assert_eq!(with_known_digits(186.04, 0.63), "186.0 ± 0.6");
        assert_eq!(with_known_digits(-35.104, 0.061), "−35.10 ± 0.06");
        assert_eq!(with_known_digits(-0.0001, 1e-7), "0.000 ± 0.001");
        assert_eq!(with_known_digits(0.0, 0.0), "0.000 ± 0.001");
    }
}
