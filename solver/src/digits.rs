//! Numbers for people: as many digits as the error justifies, with true minus signs. All numbers that a person reads are formatted here.

use std::time::Duration;

/// Below this size numbers are written with an exponent.
const SMALL: f64 = 1e-4;
/// From this size on, too, numbers are written with an exponent.
const LARGE: f64 = 1e7;
/// Below this size percentages are written with an exponent.
const SMALLEST_PERCENT: f64 = 1e-10;
/// Shortest and longest time that [`parse_duration`] accepts \[s\].
const SHORTEST_TIME: f64 = 1e-6;
const LONGEST_TIME: f64 = 86_400.0;

/// `value` to a number of significant digits; digits before the decimal point are never dropped: `0.2458`, `541.3`, `30418`, `1.050e-10`.
pub fn significant(value: f64, digits: usize) -> String {
    let size = value.abs();
    if !value.is_finite() {
        return UNKNOWN.to_owned();
    }
    if size == 0.0 {
        return "0".to_owned();
    }
    let digits = digits.max(1);
    if !(SMALL..LARGE).contains(&size) {
        return signed(format!("{value:.*e}", digits - 1));
    }
    signed(format!("{value:.*}", decimals(size, digits)))
}

/// As [`significant`], without trailing zeros: `0.1`, `250`, `1.05e-10`.
pub fn short(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (size, exponent) = text.split_at(text.find('e').unwrap_or(text.len()));
    if size.contains('.') { size.trim_end_matches('0').trim_end_matches('.').to_owned() + exponent } else { text }
}

/// A fraction as a percentage with two significant digits, without an exponent unless it is tiny: `5.0 %`, `0.00010 %`.
pub fn percent(share: f64) -> String {
    let value = 100.0 * share;
    if value != 0.0 && value.abs() < SMALL && value.abs() > SMALLEST_PERCENT {
        return signed(format!("{value:.*} %", decimals(value.abs(), 2)));
    }
    format!("{} %", significant(value, 2))
}

/// A change in per cent with its sign and so many decimal `places`: `+3.2 %`, `−0.5 %`.
pub fn change(per_cent: f64, places: usize) -> String {
    signed(format!("{per_cent:+.places$} %"))
}

/// `value` rounded to a number of significant digits.
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.max(1) - 1).parse().unwrap_or(value)
}

/// `value` to three digits, for use in sentences: `0.128`, `541`, `30400`.
pub fn brief(value: f64) -> f64 {
    rounded(value, 3)
}

/// A number of a scene, with the digits in which it was given: conversion to SI units leaves round-off in the last digit.
pub fn as_given(value: f64) -> f64 {
    rounded(value, 10)
}

/// A time \[s\] in a suitable unit, with three digits: `42.6 ms`.
pub fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1.0 => (1e3 * s, "ms"),
        s if s < 120.0 => (s, "s"),
        s => (s / 60.0, "min"),
    };
    format!("{} {unit}", significant(value, 3))
}

/// Reads a time with its unit, µs (or us), ms, s, min or h: `20ms`, `1,5 s`, `2min`.
///
/// # Errors
/// A message that names the text and the allowed range, 1 µs to a day.
pub fn parse_duration(text: &str) -> Result<Duration, String> {
    let text = text.trim();
    let (number, unit) =
        [("ms", 1e-3), ("us", 1e-6), ("µs", 1e-6), ("μs", 1e-6), ("min", 60.0), ("s", 1.0), ("h", 3600.0)]
            .into_iter()
            .find_map(|(name, unit)| text.strip_suffix(name).map(|number| (number, unit)))
            .ok_or_else(|| {
                let lacks = if text.ends_with(|c: char| c.is_ascii_digit()) {
                    "no unit"
                } else {
                    "none of the units µs, ms, s, min and h"
                };
                format!("{text} has {lacks}: expected a time such as 20ms, 1.5s or 2min")
            })?;
    match number.trim().replace(',', ".").parse::<f64>() {
        Ok(number) if (SHORTEST_TIME..=LONGEST_TIME).contains(&(number * unit)) => {
            Ok(Duration::from_secs_f64(number * unit))
        }
        _ => Err(format!("{text} is not a time: expected from 1 µs to a day, such as 20ms, 1.5s or 2min")),
    }
}

/// `0.24583 ± 0.00018`: both to the second significant digit of the error. An exact value is written without an error, to four digits; if
/// the error is not finite, the text says that it was not estimated.
pub fn with_error(value: f64, error: f64) -> String {
    if !value.is_finite() {
        return UNKNOWN.to_owned();
    }
    if !error.is_finite() {
        return format!("{} (error not estimated)", significant(value, 4));
    }
    let error = error.abs();
    if error <= value.abs() * 1e-12 {
        return significant(value, 4);
    }
    let size = value.abs().max(error);
    if !(SMALL..LARGE).contains(&size) {
        let exponent = size.log10().floor();
        let scale = 10f64.powf(-exponent);
        // The value is scaled to between 1 and 10, unless the scale factor itself overflows.
        if scale.is_finite() && scale > 0.0 {
            return format!("({}) × 10^{exponent}", with_error(value * scale, error * scale));
        }
        return signed(format!("{value:.3e} ± {error:.1e}"));
    }
    let places = decimals(error, 2);
    // Whole numbers, too, are rounded to the second significant digit of the error.
    let error = rounded(error, 2);
    let unit = 10f64.powf(error.log10().floor() - 1.0).max(1.0);
    let value = if unit > 1.0 { (value / unit).round() * unit } else { value };
    format!("{} ± {error:.places$}", signed(format!("{value:.places$}")))
}

/// Placeholder for a number that is not finite.
const UNKNOWN: &str = "unknown";

/// Number of decimal places with which `size`, positive, shows `digits` significant digits once it is rounded.
fn decimals(size: f64, digits: usize) -> usize {
    let places = |size: f64| (digits as f64 - 1.0 - size.log10().floor()).clamp(0.0, 15.0);
    let first = places(size);
    // 0.0996 to two digits is 0.10, which is a decade higher.
    let unit = 10f64.powf(-first);
    places((size / unit).round() * unit * (1.0 + 1e-12)) as usize
}

/// The power of ten with this exponent: `10⁻⁶`.
pub fn power_of_ten(exponent: f64) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| match (c, c.to_digit(10)) {
        ('-', _) => '⁻',
        (_, Some(digit)) => RAISED[digit as usize],
        (other, None) => other,
    };
    let exponent: String = format!("{exponent:.0}").chars().map(raised).collect();
    format!("10{exponent}")
}

/// `text` with its powers of ten as in print: `10^-7` becomes `10⁻⁷`, and `1.05e-7` becomes `1.05 × 10⁻⁷`.
pub fn raised(text: &str) -> String {
    let power = |after: &str| {
        let end = after.find(|c: char| c != '-' && !c.is_ascii_digit()).unwrap_or(after.len());
        Some((power_of_ten(after[..end].parse().ok()?), end))
    };
    let (mut raised, mut rest) = (String::new(), text);
    while let Some(first) = rest.chars().next() {
        let (mark, before) = match first {
            '1' if rest.starts_with("10^") => (3, ""),
            'e' if raised.ends_with(|c: char| c.is_ascii_digit()) => (1, " × "),
            _ => (0, ""),
        };
        let found = if mark > 0 { power(&rest[mark..]) } else { None };
        let taken = found.as_ref().map_or(first.len_utf8(), |(_, end)| mark + end);
        match found {
            Some((power, _)) => raised += &format!("{before}{power}"),
            None => raised.push(first),
        }
        rest = &rest[taken..];
    }
    raised
}

/// `text` with a true minus sign; "-0.00" becomes "0.00".
pub fn signed(text: String) -> String {
    match text.strip_prefix('-') {
        Some(size) if size.bytes().any(|digit| matches!(digit, b'1'..=b'9')) => format!("−{size}"),
        Some(zero) => zero.to_owned(),
        None => text,
    }
}

/// `text` with a capital first letter.
pub fn capitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}

/// A number with its noun: `1 cycle`, `2 cycles`.
pub fn counted(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

/// `text` with a small first letter.
pub fn uncapitalised(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_follow_the_error() {
        for (value, error, shown) in [
            (0.2458277, 1.8e-4, "0.24583 ± 0.00018"),
            (0.2458277, 9.96e-4, "0.2458 ± 0.0010"),
            (33.556824, 3.6e-3, "33.5568 ± 0.0036"),
            (12345.6, 678.0, "12350 ± 680"),
            (148_492.0, 1352.0, "148500 ± 1400"),
            (9_960.0, 99.6, "9960 ± 100"),
            (0.0, 0.5, "0.00 ± 0.50"),
            (-1e-13, 1.2e-5, "(0.0 ± 1.2) × 10^-5"),
            (0.5, 0.0, "0.5000"),
            (1.2345e-9, 1.2e-11, "(1.234 ± 0.012) × 10^-9"),
            (0.25, f64::INFINITY, "0.2500 (error not estimated)"),
            (f64::NAN, 0.1, "unknown"),
        ] {
            assert_eq!(with_error(value, error), shown);
        }
    }

    #[test]
    fn significant_digits() {
        for (value, digits, shown) in [
            (200.0, 4, "200.0"),
            (30417.8, 4, "30418"),
            (0.99996, 4, "1.000"),
            (-0.5, 2, "−0.50"),
            (0.0, 4, "0"),
            (1.05e-10, 3, "1.05e-10"),
            (f64::INFINITY, 3, "unknown"),
        ] {
            assert_eq!(significant(value, digits), shown);
        }
        assert_eq!([short(0.1, 3), short(200.0, 4), short(1.05e-10, 4)], ["0.1", "200", "1.05e-10"]);
        assert_eq!([0, 1, 2].map(|cycles| counted(cycles, "cycle", "cycles")), ["0 cycles", "1 cycle", "2 cycles"]);
        assert_eq!([uncapitalised("Rms roughness σ"), capitalised("rms")], ["rms roughness σ", "Rms"]);
        assert_eq!(
            [0.05, 3e-4, 1.0, -1e-6, 1e-14].map(percent),
            ["5.0 %", "0.030 %", "100 %", "−0.00010 %", "1.0e-12 %"]
        );
        assert_eq!((as_given(0.7 + 1e-16), rounded(-1234.0, 2), brief(30417.8)), (0.7, -1200.0, 30400.0));
    }

    #[test]
    fn powers_of_ten_are_raised() {
        for (text, shown) in [
            ("(1 ± 2) × 10^-6 … (3 ± 4) × 10^12 N", "(1 ± 2) × 10⁻⁶ … (3 ± 4) × 10¹² N"),
            ("4.060e7 N/m", "4.060 × 10⁷ N/m"),
            ("−1.0e-12 %", "−1.0 × 10⁻¹² %"),
            ("10^{−3}, 0.25 (error not estimated), 1e", "10^{−3}, 0.25 (error not estimated), 1e"),
        ] {
            assert_eq!(raised(text), shown);
        }
    }

    #[test]
    fn durations_have_a_unit() {
        assert_eq!([0.0426, 5.0, 300.0].map(duration), ["42.6 ms", "5.00 s", "5.00 min"]);
    }

    #[test]
    fn times_are_read_with_their_units() {
        let read = |text: &str| parse_duration(text).map(|time| time.as_secs_f64());
        assert_eq!(
            [read("16ms"), read(" 2 s"), read("1,5min"), read("100µs"), read("100us"), read("100 μs"), read("1h")],
            [Ok(0.016), Ok(2.0), Ok(90.0), Ok(1e-4), Ok(1e-4), Ok(1e-4), Ok(3600.0)]
        );
        for wrong in ["", "16", "0ms", "1e-12s", "-1s", "nan s", "16 hours", "ms", "2000min"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
