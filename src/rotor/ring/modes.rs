//! Natural frequencies.

use super::compliance::Stated;
use super::section::{RingError, Section};

impl Section {
    /// The lowest `count` natural frequencies \[Hz\] of order `order`, ascending; those of rigid motions that nothing holds are left out.
    /// Order 0 has those without torsion.
    ///
    /// # Errors
    /// [`RingError`] if the mesh would be too large.
    pub fn natural_frequencies(&self, order: u32, count: usize) -> Result<Vec<Stated>, RingError> {
        let _ = (order, count);
        Err(RingError::NoPart)
    }
}
