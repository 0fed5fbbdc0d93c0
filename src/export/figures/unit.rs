//! A unit with the prefix that makes numbers easy to read.

/// The unit with a prefix for values up to `greatest`, and the factor to it.
pub(super) fn prefixed(greatest: f64, unit: &str) -> (String, f64) {
    let size = greatest.abs();
    let prefixes = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p")];
    let fits = |(factor, _): &&(f64, &str)| size >= 0.9995 * factor;
    let (factor, prefix) = prefixes.iter().find(fits).copied().unwrap_or((1.0, ""));
    (format!("{prefix}{unit}"), 1.0 / factor)
}

/// The unit for pressures up to `greatest` \[Pa\], and the factor from pascal: kilopascal, as in the window, unless they are much smaller.
pub(super) fn pressure_unit(greatest: f64) -> (String, f64) {
    if greatest >= 1e3 { ("kPa".to_owned(), 1e-3) } else { prefixed(greatest, "Pa") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_leave_one_to_three_digits() {
        for (value, expected) in
            [(1.3e-6, "µm"), (2e-7, "nm"), (0.0, "m"), (f64::NAN, "m"), (1e-3, "mm"), (4.2e4, "km")]
        {
            assert_eq!(prefixed(value, "m").0, expected);
        }
        assert!((prefixed(250e3, "Pa").1 * 250e3 - 250.0).abs() < 1e-9);
    }

    #[test]
    fn pressures_are_in_kilopascal_however_great_they_are() {
        for (pressure, unit) in [(12.0, "Pa"), (1e3, "kPa"), (101_325.0, "kPa"), (3e6, "kPa"), (5e7, "kPa")] {
            assert_eq!(pressure_unit(pressure).0, unit);
        }
    }
}
