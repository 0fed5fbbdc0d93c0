//! A rotor as the solvers see it, whatever its model: its compliance to each harmonic of the wave.

use super::ring::{Band, RingError};
use crate::budget::MemoryExcess;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Harmonics in which a rotor is smooth: beyond, its deflection is local, and hardly matters to the film.
const SMOOTH: usize = 10;

/// Why a rotor has no compliance.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RotorError {
    /// A ring that cannot be computed.
    #[error("rotor.model = \"ring\": {0}")]
    Ring(#[from] RingError),
    /// A ring that needs more memory than is allowed.
    #[error(transparent)]
    Memory(#[from] MemoryExcess),
    /// A table that is not a Green's function.
    #[error(
        "rotor.green: harmonic {harmonic} of the wave has the compliance {compliance:.1e} m²/N, known to {error:.1e}: allowed is a deflection \
         that yields to the first harmonic; give it over half the wavelength, or until it has died out, in steps that are shorter"
    )]
    Green {
        /// Which harmonic.
        harmonic: usize,
        /// Its compliance \[m²/N\].
        compliance: f64,
        /// The estimated error of that.
        error: f64,
    },
}

impl RotorError {
    /// Whether it was only cancelled.
    pub fn is_cancelled(&self) -> bool {
        matches!(self, Self::Ring(RingError::Cancelled))
    }
}

/// The wave that loads the rotor, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Wavelength λ \[m\].
    pub length: f64,
    /// Wavelengths round the ring.
    pub waves: u32,
    /// Where the stator touches the ring.
    pub band: Band,
}

/// A rotor as the solvers see it: its compliance to each harmonic of the wave.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Compliances {
    pub(super) wavelength: f64,
    /// C(k_n) \[m²/N\] for n = 1, 2, ….
    pub(super) harmonics: Arc<[f64]>,
    pub(super) local: f64,
    /// Estimated error of the deflection under a point load, over that by the first ten harmonics; 0 of a beam or a table, which are what they say.
    pub relative_error: f64,
}

impl Compliances {
    /// Wavelength λ \[m\].
    pub fn wavelength(&self) -> f64 {
        self.wavelength
    }

    /// C(k_n) \[m²/N\], k_n = 2πn/λ, n ≥ 1; beyond the harmonics that were resolved, the local part.
    pub fn harmonic(&self, n: usize) -> f64 {
        n.checked_sub(1).and_then(|i| self.harmonics.get(i)).copied().unwrap_or(self.local)
    }

    /// C \[m²/N\] of the shortest resolved harmonic that is longer than a wave of wavenumber `k` \[rad/m\], or of the first.
    pub fn longer_than(&self, k: f64) -> f64 {
        let n = k * self.wavelength / std::f64::consts::TAU;
        self.harmonic((n as usize).clamp(1, self.harmonics.len().max(1)))
    }

    /// These compliances, each at least `least` \[m²/N\], so that short waves have a limit and the number of harmonics is finite.
    #[must_use]
    pub fn at_least(self, least: f64) -> Self {
        let harmonics = self.harmonics.iter().map(|value| value.max(least)).collect();
        Self { harmonics, local: self.local.max(least), ..self }
    }

    /// Whether a harmonic is stiffer than the limit of short waves; no real body has such a harmonic, but a measured table may.
    pub fn dips(&self) -> bool {
        let least = self.beyond(self.harmonics.len());
        self.harmonics.iter().any(|value| *value < least)
    }

    /// Local compliance beyond `n` harmonics \[m²/N\]: the limit of short waves, or C(k_n) of a rotor whose limit is zero.
    pub fn beyond(&self, n: usize) -> f64 {
        if self.local > 0.0 { self.local } else { self.harmonic(n) }
    }
}

/// Ratio of `off`, a sum of errors of harmonics, to the smooth part of the deflection under a point load.
pub(super) fn smooth_share(harmonics: &[f64], off: f64) -> f64 {
    off / harmonics.iter().take(SMOOTH).sum::<f64>()
}
