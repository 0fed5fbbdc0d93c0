//! Numbers for people: as many digits as the error justifies.

/// Below this size numbers are written with an exponent.
const SMALL: f64 = 1e-4;
/// From this size on as well.
const LARGE: f64 = 1e7;

/// `value` to a number of significant digits, whole digits never dropped: `0.2458`, `541.3`, `30418`, `1.050e-10`.
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
        return format!("{value:.*e}", digits - 1);
    }
    format!("{value:.*}", decimals(size, digits))
}

/// `0.24583 ± 0.00018`: both to the error's second significant digit. An error that is not finite is said to be unknown.
pub fn with_error(value: f64, error: f64) -> String {
    if !value.is_finite() {
        return UNKNOWN.to_owned();
    }
    if !error.is_finite() {
        return format!("{} (error not estimated)", significant(value, 4));
    }
    let error = error.abs();
    if error <= value.abs() * 1e-12 {
        return significant(value, 6);
    }
    let size = value.abs().max(error);
    if !(SMALL..LARGE).contains(&size) {
        let exponent = size.log10().floor();
        let scale = 10f64.powf(-exponent);
        // Scaled to between 1 and 10, unless the scale itself leaves the range of numbers.
        if scale.is_finite() && scale > 0.0 {
            return format!("({}) × 10^{exponent}", with_error(value * scale, error * scale));
        }
        return format!("{value:.3e} ± {error:.1e}");
    }
    let places = decimals(error, 2);
    format!("{value:.places$} ± {error:.places$}")
}

/// What stands for a number that is not one.
const UNKNOWN: &str = "unknown";

/// Decimal places at which `size`, positive, shows `digits` significant digits once it is rounded.
fn decimals(size: f64, digits: usize) -> usize {
    let places = |size: f64| (digits as f64 - 1.0 - size.log10().floor()).clamp(0.0, 15.0);
    let first = places(size);
    // 0.0996 to two digits is 0.10, which has moved up a decade.
    let unit = 10f64.powf(-first);
    places((size / unit).round() * unit * (1.0 + 1e-12)) as usize
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
            (12345.6, 678.0, "12346 ± 678"),
            (0.0, 0.5, "0.00 ± 0.50"),
            (0.5, 0.0, "0.500000"),
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
            (-0.5, 2, "-0.50"),
            (0.0, 4, "0"),
            (1.05e-10, 3, "1.05e-10"),
            (f64::INFINITY, 3, "unknown"),
        ] {
            assert_eq!(significant(value, digits), shown);
        }
    }
}
