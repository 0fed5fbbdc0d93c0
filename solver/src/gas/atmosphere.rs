//! The standard atmosphere (U.S. Standard Atmosphere 1976, the same as ISO 2533 in this range): pressure over altitude.

/// g₀ M/R \[K/m\] with the constants of the standard: 9.80665 · 0.0289644/8.31432.
const PER_KELVIN: f64 = 9.80665 * 0.028_964_4 / 8.314_32;
/// Radius of the Earth in the standard \[m\], for the fall of gravity with altitude.
const EARTH: f64 = 6_356_766.0;
/// Base of each layer \[m of geopotential altitude\], and the temperature gradient in it \[K/m\].
const LAYERS: [(f64, f64); 7] =
    [(0.0, -6.5e-3), (11e3, 0.0), (20e3, 1e-3), (32e3, 2.8e-3), (47e3, 0.0), (51e3, -2.8e-3), (71e3, -2e-3)];

/// Pressure \[Pa\] at a geometric altitude above sea level \[m\], up to 86 km. Below sea level the lowest layer is extrapolated.
pub fn pressure(altitude: f64) -> f64 {
    let height = EARTH * altitude / (EARTH + altitude);
    let (mut pressure, mut temperature) = (101_325.0, 288.15);
    for (i, (foot, rate)) in LAYERS.into_iter().enumerate() {
        let top = LAYERS.get(i + 1).map_or(f64::INFINITY, |(next, _)| *next);
        let rise = height.min(top) - foot;
        if rate == 0.0 {
            pressure *= (-PER_KELVIN * rise / temperature).exp();
        } else {
            let above = temperature + rate * rise;
            pressure *= (temperature / above).powf(PER_KELVIN / rate);
            temperature = above;
        }
        if height <= top {
            break;
        }
    }
    pressure
}
