//! The rotor's normal compliance, harmonic by harmonic (the Green's function of the paper's Fig. 3).
//!
//! By translation invariance along the ring, a line load q_n cos(k_n x), k_n = 2πn/λ, deflects the rotor by
//! C(k_n) q_n cos(k_n x). The rigid offset (n = 0) is not part of the compliance: the load balance fixes it.
//!
//! Every model is resolved once, before anything is solved, into the [`Compliances`] of the harmonics of the wave. That may fail: a ring
//! may be free to tilt. It is done as part of a solve and not where a scene is checked, because a ring takes
//! long and the window checks a scene while a slider is dragged.

mod compliances;
mod green;
pub mod ring;

use crate::budget::{self, MemoryUse, Need};
use crate::control::Cancel;
use crate::digits::short;
use crate::problem::{Motor, RotorCompliance};
use compliances::smooth_share;
pub use compliances::{Compliances, RotorError, Wave};
use ring::{Band, Section};
use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

/// Wavenumber beyond all that a beam or a table resolves \[rad/m\]: the compliance there is local.
const LOCAL: f64 = 1e9;
/// Most harmonics that may be asked for: those of the finest contact mesh of the paper's method.
pub const MOST_HARMONICS: usize = 2500;
/// Harmonics for which the natural frequencies of a ring are computed.
pub const RESONANCES: usize = 3;
/// Below which relative accuracy of α the meshes of a ring have how many times the usual number of elements, so that those of the preset
/// `ring-rotor` are fine enough.
const FINER: [(f64, usize); 2] = [(8e-4, 20), (4e-3, 4)];
/// Number of rings whose results are kept for the next solve of the same ring.
const KEPT: usize = 64;

impl RotorCompliance {
    /// Compliances of the first `count` harmonics of `wave`, those of a ring on its usual meshes.
    ///
    /// # Errors
    /// [`RotorError`] of a ring that the wave does not touch, or that nothing holds, or if it is cancelled.
    pub fn resolve(&self, wave: &Wave, count: usize, cancel: &Cancel) -> Result<Compliances, RotorError> {
        self.resolve_for(f64::INFINITY, wave, count, cancel)
    }

    /// As [`Self::resolve`], those of a ring on meshes for a relative `accuracy` of α.
    fn resolve_for(
        &self,
        accuracy: f64,
        wave: &Wave,
        count: usize,
        cancel: &Cancel,
    ) -> Result<Compliances, RotorError> {
        let waves = |at: &dyn Fn(f64) -> f64| Compliances {
            wavelength: wave.length,
            harmonics: (1..=count).map(|n| at(std::f64::consts::TAU * n as f64 / wave.length)).collect(),
            local: at(LOCAL),
            relative_error: 0.0,
        };
        Ok(match self {
            Self::Beam { decay_length, point_compliance, local_compliance } => {
                let foundation = 1.0 / (2.0 * decay_length * point_compliance);
                waves(&|k| {
                    let kl = k * decay_length;
                    1.0 / (foundation * (1.0 + 0.25 * kl * kl * kl * kl)) + local_compliance
                })
            }
            Self::Table(rows) => waves(&|k| interpolate_log(rows, k)),
            Self::Green(rows) => green::resolve(rows, wave, count)?,
            Self::Ring(section) => {
                let on = |times| of_ring(section, wave, times, cancel);
                let mut finer = FINER.iter().filter(|(below, _)| accuracy < *below).map(|(_, times)| on(*times));
                // Where memory is short, coarser meshes have an answer too, and state a larger error.
                finer.find(|found| !matches!(found, Err(RotorError::Memory(_)))).unwrap_or_else(|| on(1))?
            }
        })
    }
}

impl Motor {
    /// The wave, where it touches the rotor.
    pub fn wave(&self) -> Wave {
        let band = Band { radius: self.contact_radius, width: self.contact_width };
        Wave { length: self.wavelength(), waves: self.waves, band }
    }

    /// Compliances of the rotor's model to the first `count` harmonics of the wave.
    ///
    /// # Errors
    /// See [`RotorCompliance::resolve`].
    pub fn compliances(&self, count: usize, cancel: &Cancel) -> Result<Compliances, RotorError> {
        self.compliances_for(f64::INFINITY, count, cancel)
    }

    /// As [`Self::compliances`], but a ring is solved on meshes that are fine enough for a relative `accuracy` of α.
    ///
    /// # Errors
    /// See [`RotorCompliance::resolve`].
    pub fn compliances_for(&self, accuracy: f64, count: usize, cancel: &Cancel) -> Result<Compliances, RotorError> {
        self.rotor.resolve_for(accuracy, &self.wave(), count, cancel)
    }

    /// Lowest natural frequency of the shape of each of the first harmonics of the wave \[Hz\]; `None` of a rotor whose mass is not known.
    ///
    /// # Errors
    /// [`RotorError`] of a ring that cannot be computed.
    pub fn resonances(&self, cancel: &Cancel) -> Result<Option<[f64; RESONANCES]>, RotorError> {
        let RotorCompliance::Ring(section) = &self.rotor else { return Ok(None) };
        let found = RESONATING.or((section.clone(), self.waves), |_| {
            let _taken = budget::take(need_of_frequencies(section)?, cancel)?;
            let orders: Vec<u32> = (1..).take(RESONANCES).map(|n: u32| n * self.waves).collect();
            let mut resonances = [f64::INFINITY; RESONANCES];
            for (resonance, found) in resonances.iter_mut().zip(section.natural_frequencies(&orders, 1, cancel)?) {
                *resonance = found.first().map_or(f64::INFINITY, |frequency| frequency.value);
            }
            Ok::<_, RotorError>(resonances)
        })?;
        Ok(Some(found))
    }
}

/// Cache of the latest results, the newest first. A result does not depend on whether it is found here.
struct Cache<K, V>(Mutex<VecDeque<(K, V)>>);

impl<K: PartialEq, V: Clone> Cache<K, V> {
    const fn new() -> Self {
        Self(Mutex::new(VecDeque::new()))
    }

    /// The cached result for `key`, or else that of `compute`, which is then kept.
    fn or<E>(&self, key: K, compute: impl FnOnce(&K) -> Result<V, E>) -> Result<V, E> {
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, found)) = kept().iter().find(|(known, _)| *known == key) {
            return Ok(found.clone());
        }
        let found = compute(&key)?;
        let mut kept = kept();
        kept.truncate(KEPT - 1);
        kept.push_front((key, found.clone()));
        Ok(found)
    }
}

/// Bytes that a ring takes whose finer mesh has so many elements: equations, and a factor that grows a little faster than they do
/// (`tests/memory_needs.rs`).
fn bytes(elements: usize) -> u64 {
    let elements = elements as f64;
    (elements * (8e3 + 2.4e3 * elements.log2())) as u64
}

/// Memory that a ring needs while its compliances under a contact band are computed, on meshes with so many times the usual number of elements.
///
/// # Errors
/// [`RotorError`] of a ring that has no mesh.
pub fn need(section: &Section, band: Band, times: usize) -> Result<Need, RotorError> {
    let elements = section.elements(Some(band), times)?;
    Ok(Need { what: MemoryUse::Ring { elements }, bytes: bytes(elements) })
}

/// Memory that a ring needs while its natural frequencies are computed, each of which may be on a thread of its own.
///
/// # Errors
/// As [`need`].
pub fn need_of_frequencies(section: &Section) -> Result<Need, RotorError> {
    let elements = section.elements(None, 1)?;
    Ok(Need { what: MemoryUse::Ring { elements }, bytes: bytes(elements) * RESONANCES as u64 })
}

static RINGS: Cache<(Section, Wave, usize), Compliances> = Cache::new();
static RESONATING: Cache<(Section, u32), [f64; RESONANCES]> = Cache::new();

fn of_ring(section: &Section, wave: &Wave, times: usize, cancel: &Cancel) -> Result<Compliances, RotorError> {
    RINGS.or((section.clone(), *wave, times), |_| {
        let _taken = budget::take(need(section, wave.band, times)?, cancel)?;
        let ring::RingCompliances { harmonics: found, resolved } =
            section.compliances(wave.band, wave.waves, MOST_HARMONICS, times, cancel)?;
        let harmonics: Vec<f64> = found.iter().map(|harmonic| harmonic.value).collect();
        let off = found[..resolved].iter().map(|harmonic| harmonic.error).sum();
        Ok(Compliances {
            wavelength: wave.length,
            relative_error: smooth_share(&harmonics, off),
            harmonics: harmonics.into(),
            local: 0.0,
        })
    })
}

/// Relative tolerance within which the end of a table counts as covering a wavenumber.
const NEAR: f64 = 0.01;
/// Harmonics that contact is always resolved with.
const FEWEST_HARMONICS: f64 = 4.0;

impl Motor {
    /// Describes in words which wavenumbers needed by the contact problem the compliance table does not cover: from that of the wave, k₁ =
    /// waves/r, to that of a wave as short as a tooth, 2π/b. `None` if it covers them all, or if the rotor is not a table.
    pub fn compliance_not_covered(&self) -> Option<String> {
        let RotorCompliance::Table(rows) = &self.rotor else { return None };
        let (first, last) = (rows.first()?.0, rows.last()?.0);
        let wave = std::f64::consts::TAU / self.wavelength();
        let tooth = (std::f64::consts::TAU / self.tooth_width).max(FEWEST_HARMONICS * wave);
        let mut missing = Vec::new();
        if first > (1.0 + NEAR) * wave || last < (1.0 - NEAR) * wave {
            let end = if first > wave { "first" } else { "last" };
            missing.push(format!("the wave itself, {wave:.1} 1/m, has the compliance of the {end} row"));
        }
        if last < (1.0 - NEAR) * tooth {
            missing.push(format!("waves as short as a tooth, {tooth:.0} 1/m, have that of the last row"));
        }
        (!missing.is_empty()).then(|| {
            let ends = [first, last].map(|end| short(end, 4));
            let rows =
                if rows.len() == 1 { format!("{} 1/m only", ends[0]) } else { format!("{} 1/m", ends.join(" to ")) };
            format!("rotor.compliance covers wavenumbers {rows}: {}", missing.join("; "))
        })
    }
}

/// C at `k` from rows of (k, C): linear in (ln k, ln C), constant beyond either end.
fn interpolate_log(rows: &[(f64, f64)], k: f64) -> f64 {
    let after = rows.partition_point(|row| row.0 <= k);
    match (after.checked_sub(1).and_then(|i| rows.get(i)), rows.get(after)) {
        (Some(&(k0, c0)), Some(&(k1, c1))) => {
            let s = (k / k0).ln() / (k1 / k0).ln();
            (c0.ln() * (1.0 - s) + c1.ln() * s).exp()
        }
        (Some(&(_, c)), None) | (None, Some(&(_, c))) => c,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave so long that its harmonics are dense.
    fn wave(length: f64) -> Wave {
        Wave { length, waves: 7, band: Band { radius: 0.029, width: 3e-4 } }
    }

    #[test]
    fn beam_point_compliance_is_the_sum_over_all_wavenumbers() {
        // ∫ C dk/2π of the beam alone is the deflection under a unit point load.
        let (decay_length, point_compliance) = (4.0e-3, 0.64e-6);
        let rotor = RotorCompliance::Beam { decay_length, point_compliance, local_compliance: 0.0 };
        let dk = 1.0;
        let found = rotor.resolve(&wave(std::f64::consts::TAU / dk), 2_000_000, &Cancel::new()).unwrap();
        // The trapezoidal rule, with C(0) = 2 ℓ C_p.
        let sum: f64 = (1..=2_000_000).map(|n| found.harmonic(n) * dk).sum();
        let point = (sum + decay_length * point_compliance * dk) / std::f64::consts::PI;
        assert!((point / point_compliance - 1.0).abs() < 1e-6, "{point}");
    }

    #[test]
    fn table_passes_through_its_rows_and_is_constant_beyond() {
        let rotor = RotorCompliance::Table(vec![(10.0, 4e-9), (1000.0, 1e-9)]);
        let at = |k: f64| rotor.resolve(&wave(std::f64::consts::TAU / k), 1, &Cancel::new()).unwrap().harmonic(1);
        assert_eq!(at(1.0), 4e-9);
        assert!((at(10.0) - 4e-9).abs() < 1e-22);
        assert!((at(100.0) - 2e-9).abs() < 1e-22);
        assert_eq!(at(1e6), 1e-9);
    }
}
