//! What the dimensionless numbers of a scene say about its film, in words.

use crate::dimensionless::Dimensionless;

/// What the squeeze number σ says.
pub fn squeeze(numbers: &Dimensionless) -> &'static str {
    match numbers.squeeze_number {
        sigma if sigma < 1.0 => "≪ 1: viscous; the gas flows out and back in, damps and carries little",
        sigma if sigma < 100.0 => "in between: part of the gas escapes in each cycle; it damps and carries",
        _ => "≫ 1: trapped; the gas has no time to leave, is a spring and carries",
    }
}

/// What the bearing number Λ says, beside the squeeze number.
pub fn bearing(numbers: &Dimensionless) -> &'static str {
    match (numbers.bearing_number, numbers.bearing_to_squeeze) {
        (0.0, _) => "nothing slides",
        (_, ratio) if ratio < 0.01 => "≪ σ: sliding drags in next to nothing",
        (_, ratio) if ratio < 0.3 => "< σ: sliding drags in a little of what squeezing moves",
        _ => "not ≪ σ: sliding drags in as much as squeezing moves",
    }
}

/// What the Knudsen number says.
pub fn knudsen(numbers: &Dimensionless) -> &'static str {
    match numbers.knudsen_number {
        kn if kn < 0.01 => "≪ 1: a continuum, slip at the walls hardly matters",
        kn if kn < 0.1 => "< 0.1: slip at the walls counts a little",
        kn if kn < 1.0 => "slip at the walls counts; the slip laws begin to differ",
        _ => "rarefied: the slip laws differ, fukui-kaneko is made for this",
    }
}
