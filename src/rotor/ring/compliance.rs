//! Compliance of the contact face, harmonic by harmonic.
//!
//! A pressure p cos mθ, uniform over the contact band of width w about the radius r, is a line load q cos kx with q = p w, k = m/r and
//! x = rθ. Its work is done on the mean axial displacement of the band, ū cos kx, the mean over its area. C(k) = ū/q \[m²/N\], as in
//! [`crate::rotor`].

use super::section::{Band, RingError, Section};

/// A number and its estimated absolute numerical error, in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stated {
    /// The number.
    pub value: f64,
    /// Estimated error of `value`.
    pub error: f64,
}

/// The compliance of each harmonic of the wave.
#[derive(Clone, Debug, PartialEq)]
pub struct RingCompliances {
    /// C(k_n) \[m²/N\] for n = 1, 2, …: order m = waves·n, wavenumber k_n = waves·n/r. All that were asked for.
    pub harmonics: Vec<Stated>,
    /// How many of them the finite elements resolve. Beyond, each continues the last that is resolved as an elastic half-space under the
    /// same band does: the local part, which no longer depends on the shape of the section.
    pub resolved: usize,
    /// Elements of the finer mesh.
    pub elements: usize,
}

/// How the section moves under a line load of 1 N/m (amplitude) of one order, node by node of [`Section::mesh`]: displacements per
/// unit line load \[m²/N\], u_r = `radial` cos mθ, u_θ = `circumferential` sin mθ, u_z = `axial` cos mθ.
#[derive(Clone, Debug, PartialEq)]
pub struct Deflection {
    /// U.
    pub radial: Vec<f64>,
    /// V.
    pub circumferential: Vec<f64>,
    /// W.
    pub axial: Vec<f64>,
}

impl Section {
    /// Compliances of the first `count` harmonics of a wave that goes `waves` times round the ring, on the contact `band`.
    ///
    /// # Errors
    /// [`RingError`] if the band is not within the lowest face, if `waves` = 1 and nothing holds the ring against tilting, or if
    /// the mesh would be too large.
    pub fn compliances(&self, band: Band, waves: u32, count: usize) -> Result<RingCompliances, RingError> {
        let _ = (band, waves, count);
        Err(RingError::NoPart)
    }

    /// How the section moves under a unit line load of order `order` on the contact `band`.
    ///
    /// # Errors
    /// As [`Section::compliances`].
    pub fn deflection(&self, band: Band, order: u32) -> Result<Deflection, RingError> {
        let _ = (band, order);
        Err(RingError::NoPart)
    }
}
