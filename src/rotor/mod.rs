//! The rotor's normal compliance, harmonic by harmonic (the Green's function of the paper's Fig. 3).
//!
//! By translation invariance along the ring, a line load q_n cos(k_n x), k_n = 2πn/λ, deflects the rotor by
//! C(k_n) q_n cos(k_n x). The rigid offset (n = 0) is not part of the compliance: the load balance fixes it.

use crate::problem::RotorCompliance;

impl RotorCompliance {
    /// Compliance C(k) \[m²/N\] at wavenumber `k` \[rad/m\], k > 0.
    pub fn at(&self, k: f64) -> f64 {
        match self {
            Self::Beam { decay_length, point_compliance, local_compliance } => {
                let foundation = 1.0 / (2.0 * decay_length * point_compliance);
                let kl = k * decay_length;
                1.0 / (foundation * (1.0 + 0.25 * kl * kl * kl * kl)) + local_compliance
            }
            Self::Table(rows) => interpolate_log(rows, k),
        }
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

    #[test]
    fn beam_point_compliance_is_the_sum_over_all_wavenumbers() {
        // ∫ C dk/2π of the beam alone is the deflection under a unit point load.
        let (decay_length, point_compliance) = (4.0e-3, 0.64e-6);
        let rotor = RotorCompliance::Beam { decay_length, point_compliance, local_compliance: 0.0 };
        let dk = 1.0;
        let sum: f64 = (0..2_000_000).map(|i| rotor.at((i as f64 + 0.5) * dk) * dk).sum();
        let point = sum / std::f64::consts::PI;
        assert!((point / point_compliance - 1.0).abs() < 1e-6, "{point}");
    }

    #[test]
    fn table_passes_through_its_rows_and_is_constant_beyond() {
        let rotor = RotorCompliance::Table(vec![(10.0, 4e-9), (1000.0, 1e-9)]);
        assert_eq!(rotor.at(1.0), 4e-9);
        assert!((rotor.at(10.0) - 4e-9).abs() < 1e-22);
        assert!((rotor.at(100.0) - 2e-9).abs() < 1e-22);
        assert_eq!(rotor.at(1e6), 1e-9);
    }
}
