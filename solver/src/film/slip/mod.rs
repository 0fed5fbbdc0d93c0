//! Slip laws: the mobility ψ(Z) of the film.
//!
//! The Poiseuille flow, as volume at ambient pressure per metre of width \[m²/s\], is −k h² ψ(Z) ∇(p/p_a) p_a/(12μ). Here Z = h p/p_a \[m\]
//! and ψ = Z Q, where the slip factor Q depends on the local Knudsen number Kn = λ_a/Z only. k depends on the gap only: it is the flow
//! factor of rough faces (`surface::flow`), and 1 for smooth ones. Every law here has |d ln ψ/d ln Z| ≤ 1, which makes the Jacobian of the
//! discrete film an M-matrix (`film::stepper`); k does not change that.
//!
//! Each law has its own file, a line in `laws!` and an arm in [`SlipLaw::of`]; a step of the film is compiled for each law (`Film::step`).

mod accommodated;
mod affine;
mod fukui_kaneko;
mod mobility;
mod second_order;

use crate::problem::{Gas, Slip};
pub use accommodated::Accommodated;
pub use affine::Affine;
pub use fukui_kaneko::FukuiKaneko;
pub use mobility::Mobility;
pub use second_order::SecondOrder;

macro_rules! laws {
    ($($(#[$about:meta])* $Law:ident),* $(,)?) => {
        /// A slip law chosen at run time.
        #[derive(Clone, Copy, Debug)]
        pub enum SlipLaw { $($(#[$about])* $Law($Law)),* }

        impl Mobility for SlipLaw {
            fn at(self, z: f64) -> (f64, f64) {
                match self { $(Self::$Law(law) => law.at(z)),* }
            }

            fn potential(self, z: f64) -> f64 {
                match self { $(Self::$Law(law) => law.potential(z)),* }
            }

            fn knudsen_limit(&self) -> f64 {
                match self { $(Self::$Law(law) => law.knudsen_limit()),* }
            }
        }
    };
}

laws! {
    /// No slip or first order.
    Affine,
    /// Second order.
    SecondOrder,
    /// Linearised Boltzmann.
    FukuiKaneko,
    /// Linearised Boltzmann, between walls that are not fully diffuse.
    Accommodated,
}

impl SlipLaw {
    /// The law of a gas. With a mean free path of zero every law reduces to the continuum.
    pub fn of(gas: &Gas) -> Self {
        let mean_free_path = gas.mean_free_path;
        match gas.slip {
            _ if mean_free_path <= 0.0 => Self::Affine(Affine { offset: 0.0 }),
            Slip::None => Self::Affine(Affine { offset: 0.0 }),
            Slip::FirstOrder => Self::Affine(Affine { offset: 6.0 * mean_free_path }),
            Slip::SecondOrder => Self::SecondOrder(SecondOrder { mean_free_path }),
            Slip::FukuiKaneko if gas.accommodation >= 1.0 => Self::FukuiKaneko(FukuiKaneko { mean_free_path }),
            Slip::FukuiKaneko => Self::Accommodated(Accommodated::new(mean_free_path, gas.accommodation)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::gauss_legendre;

    #[test]
    fn the_potential_is_the_integral_of_the_mobility() {
        let range: [f64; 2] = [1e-10, 3e-5];
        for law in laws() {
            let exact = |z: f64| {
                let parts = 200;
                let (from, to) = (range[0].ln(), z.ln());
                let at = |i: usize| from + (to - from) * i as f64 / parts as f64;
                (0..parts).map(|i| gauss_legendre(at(i), at(i + 1), |s| s.exp() * law.at(s.exp()).0)).sum::<f64>()
            };
            for z in [2e-10_f64, 2e-8, 1e-7, 7.7e-7, 2.9e-5] {
                let found = law.potential(z) - law.potential(range[0]);
                assert!((found / exact(z) - 1.0).abs() < 1e-6, "{law:?} {z}: {found} {}", exact(z));
            }
        }
    }

    fn laws() -> Vec<SlipLaw> {
        let mean_free_path = 64e-9;
        [
            SlipLaw::Affine(Affine { offset: 0.0 }),
            SlipLaw::Affine(Affine { offset: 6.0 * mean_free_path }),
            SlipLaw::SecondOrder(SecondOrder { mean_free_path }),
            SlipLaw::FukuiKaneko(FukuiKaneko { mean_free_path }),
        ]
        .into_iter()
        .chain([0.99, 0.7, 0.3].map(|share| SlipLaw::Accommodated(Accommodated::new(mean_free_path, share))))
        .collect()
    }

    #[test]
    fn slopes_are_derivatives_and_keep_the_m_matrix() {
        for law in laws() {
            for i in 0..2000 {
                let z = 1e-12 * 10f64.powf(i as f64 * 0.004);
                let (psi, slope) = law.at(z);
                let step = 1e-6 * z;
                let difference = (law.at(z + step).0 - law.at(z - step).0) / (2.0 * step);
                assert!(psi > 0.0);
                assert!((slope - difference).abs() < 1e-4 * (psi / z), "{law:?} {z}: {slope} {difference}");
                assert!(slope.abs() * z <= psi * (1.0 + 1e-12), "{law:?} {z}: {}", slope * z / psi);
            }
        }
    }

    #[test]
    fn laws_agree_as_the_knudsen_number_falls() {
        for law in laws() {
            let z = 64e-9 * 1e4;
            // Slip grows as 2/α − 1 with the accommodation coefficient α, the least of which is 0.3.
            let most = if matches!(law, SlipLaw::Accommodated(_)) { 2.0 / 0.3 - 1.0 } else { 1.0 };
            assert!((law.at(z).0 / z - 1.0).abs() < 8e-4 * most);
        }
    }
}
