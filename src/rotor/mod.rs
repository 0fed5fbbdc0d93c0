//! The rotor's normal compliance, harmonic by harmonic (the Green's function of the paper's Fig. 3).
//!
//! By translation invariance along the ring, a line load q_n cos(k_n x), k_n = 2πn/λ, deflects the rotor by
//! C(k_n) q_n cos(k_n x). The rigid offset (n = 0) is not part of the compliance: the load balance fixes it.

pub mod ring;

use crate::problem::{Motor, RotorCompliance};

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

/// An end of a table counts as covering a wavenumber that is this near to it, relative.
const NEAR: f64 = 0.01;
/// Harmonics that contact is always resolved with.
const FEWEST_HARMONICS: f64 = 4.0;

impl Motor {
    /// In words, what the rotor's compliance table does not cover of what contact asks of it: wavelengths from that of the wave,
    /// k₁ = waves/r, down to the width of a tooth, 2π/b. `None` if it covers all that, or the rotor is no table.
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
            let rows = if rows.len() == 1 { format!("{first} 1/m only") } else { format!("{first} to {last} 1/m") };
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
    fn a_table_says_what_it_does_not_cover() {
        let problem = crate::problem::Problem::new(&crate::scene::presets::find("fundamental").unwrap()).unwrap();
        let crate::problem::Scenario::Motor(motor) = problem.scenario else { panic!("a motor") };
        let told = |rows: &[(f64, f64)]| {
            Motor { rotor: RotorCompliance::Table(rows.to_vec()), ..motor.clone() }.compliance_not_covered()
        };
        assert_eq!(motor.compliance_not_covered(), None);
        assert_eq!(told(&[(241.4, 2e-9), (4000.0, 1e-10)]), None);
        let below = told(&[(300.0, 2e-9), (4000.0, 1e-10)]).unwrap();
        assert!(below.contains("300 to 4000 1/m: the wave itself, 241.4") && !below.contains("tooth"), "{below}");
        let above = told(&[(200.0, 2e-9), (900.0, 1e-10)]).unwrap();
        assert!(above.contains("a tooth, 3621") && !above.contains("the wave itself"), "{above}");
        let neither = told(&[(100.0, 2e-9)]).unwrap();
        assert!(neither.contains("100 1/m only") && neither.contains("of the last row; waves"), "{neither}");
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
