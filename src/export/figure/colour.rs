//! Colours of figures: few, each with a meaning, and distinguishable with the common colour vision deficiencies.

use std::sync::LazyLock;

/// Red, green, blue.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

impl Colour {
    /// Black.
    pub const BLACK: Self = Self(0, 0, 0);
    /// White.
    pub const WHITE: Self = Self(0xff, 0xff, 0xff);
    /// Secondary text and thin lines.
    pub const QUIET: Self = Self(0x60, 0x66, 0x70);
    /// The stator and its teeth.
    pub const STATOR: Self = Self(0x6b, 0x77, 0x88);
    /// The rotor.
    pub const ROTOR: Self = Self(0xa9, 0x8a, 0x5c);
    /// Film pressure and film load.
    pub const FILM: Self = Self(0x00, 0x72, 0xb2);
    /// Contact pressure and contact load.
    pub const CONTACT: Self = Self(0xd5, 0x5e, 0x00);
    /// Colours of several curves, in turn (Okabe–Ito, without yellow, which is hardly visible on white).
    pub const CYCLE: [Self; 7] = [
        Self(0x00, 0x72, 0xb2),
        Self(0xd5, 0x5e, 0x00),
        Self(0x00, 0x9e, 0x73),
        Self(0xcc, 0x79, 0xa7),
        Self(0xe6, 0x9f, 0x00),
        Self(0x56, 0xb4, 0xe9),
        Self(0x00, 0x00, 0x00),
    ];

    /// `#0072b2`.
    pub fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }

    /// Perceived lightness, 0 black to 1 white.
    pub fn lightness(self) -> f64 {
        let part = |channel: u8| (f64::from(channel) / 255.0).powf(2.2);
        (0.2126 * part(self.0) + 0.7152 * part(self.1) + 0.0722 * part(self.2)).powf(1.0 / 2.2)
    }
}

/// How values become colours. All are perceptually uniform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colours {
    /// From dark to light, for quantities: viridis.
    #[default]
    Field,
    /// From blue over white to red, for differences; give it a range symmetric about zero.
    Signed,
}

/// Number of colour steps over a range: finer than eight bits can distinguish.
const SHADES: usize = 4096;

impl Colours {
    /// The colour of a fraction of the range, clamped to 0 … 1.
    pub fn at(self, fraction: f64) -> Colour {
        static RAMPS: LazyLock<[Vec<Colour>; 2]> = LazyLock::new(|| {
            [colorous::VIRIDIS, colorous::RED_BLUE].map(|gradient| {
                let shade = |i: usize| gradient.eval_rational(i, SHADES);
                (0..SHADES).map(shade).map(|shade| Colour(shade.r, shade.g, shade.b)).collect()
            })
        });
        let fraction = if fraction.is_finite() { fraction.clamp(0.0, 1.0) } else { 0.0 };
        let (ramp, fraction) = match self {
            Self::Field => (0, fraction),
            Self::Signed => (1, 1.0 - fraction),
        };
        RAMPS[ramp][((SHADES - 1) as f64 * fraction).round() as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shades_are_as_fine_as_eight_bits() {
        for i in 0..=1000 {
            let at = f64::from(i) / 1000.0;
            let Colour(r, g, b) = Colours::Field.at(at);
            let exact = colorous::VIRIDIS.eval_continuous(at);
            let off = [(r, exact.r), (g, exact.g), (b, exact.b)].map(|(shown, exact)| shown.abs_diff(exact));
            assert!(off.iter().all(|off| *off <= 1), "{at}: {off:?}");
        }
        assert_eq!(Colours::Signed.at(0.0), Colours::Signed.at(f64::NAN));
        assert_ne!(Colours::Signed.at(0.0), Colours::Signed.at(7.0));
    }
}
