//! The film in the limit of high frequency: gas that has no time to move, σ → ∞.
//!
//! Within a cycle gas flows only in a layer at the edges, which is too thin to matter: Z = hP is constant at each point, and P = Z/h. The
//! value of Z is determined by the slow leaks of many cycles.
//!
//! * In the layer at an edge h is uniform across it, and the cycle mean of the flux −M h ∂Φ/∂n, Φ = ∫ψ dZ, vanishes:
//!   ⟨hΦ(Z)⟩ is that of the ambient edge. So Z_e of an edge with gap h(t) follows from ⟨h⟩ Φ(Z_e) = ⟨h Φ(h)⟩.
//! * Inside, the cycle mean of −M h² ψ(Z) ∇(Z/h) with Z constant in time is −M ⟨h⟩² ψ(Z) ∇(Z/⟨h⟩): a steady film of the
//!   gap ⟨h⟩, whose pressure at the edges is Z_e/⟨h⟩.

use super::slip::Mobility;
use super::stepper::{Film, FilmError, FilmState};
use crate::numerics::gauss_legendre;

/// The trapped film of one tooth.
#[derive(Clone, Debug)]
pub struct TrappedFilm {
    film: Film,
    state: FilmState,
    mean_gap: Vec<f64>,
    edge: Vec<f64>,
}

/// Time that the steady film is given to settle \[s\]: far more than any film needs.
const FOREVER: f64 = 1e12;

impl TrappedFilm {
    /// The trapped state of `film`.
    pub fn new(film: Film) -> Self {
        let (nx, unknowns) = (film.grid().x.len(), film.grid().unknowns());
        Self { film, state: FilmState::at_rest(vec![1.0; unknowns]), mean_gap: vec![0.0; nx], edge: vec![0.0; nx] }
    }

    /// Trapped height Z \[m\] at unknown nodes under a cycle of gaps `h[step][ix]` \[m\].
    ///
    /// # Errors
    /// [`FilmError`] if the steady film has no solution to working precision.
    pub fn solve(&mut self, h: &[f64]) -> Result<&[f64], FilmError> {
        let nx = self.mean_gap.len();
        let steps = h.len() / nx;
        let law = self.film.law;
        for ix in 0..nx {
            let gaps = || (0..steps).map(|step| h[step * nx + ix]);
            self.mean_gap[ix] = gaps().sum::<f64>() / steps as f64;
            self.edge[ix] = edge_height(law, gaps) / self.mean_gap[ix];
        }
        self.film.set_edges(&self.edge);
        // Start from rest at the pressure of the sides.
        let columns = self.film.grid().y.unknown().len();
        for (column, ix) in self.state.trapped.chunks_exact_mut(columns).zip(self.film.grid().x.unknown()) {
            column.fill(self.edge[ix] * self.mean_gap[ix]);
        }
        self.state.carried.copy_from_slice(&self.state.trapped);
        self.film.step(&self.mean_gap, None, FOREVER, &mut self.state, None)?;
        Ok(&self.state.trapped)
    }
}

/// Z \[m\] of an ambient edge whose gap takes the values `gaps` \[m\] in a cycle: ⟨h ∫ψ dζ from h to Z⟩ = 0, by Newton's
/// method, which converges from above for a convex Φ.
pub fn edge_height<I: Iterator<Item = f64>>(law: impl Mobility, gaps: impl Fn() -> I) -> f64 {
    let mut z = gaps().fold(0.0, f64::max);
    let total: f64 = gaps().sum();
    for _ in 0..60 {
        let missing: f64 = gaps().map(|h| h * gauss_legendre(h.ln(), z.ln(), |s| s.exp() * law.at(s.exp()).0)).sum();
        let step = missing / (total * law.at(z).0);
        z = (z - step).max(0.3 * z);
        if step.abs() < 1e-13 * z {
            break;
        }
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::exact::trapped_height;
    use crate::film::slip::Affine;

    #[test]
    fn edge_height_of_first_order_slip_is_the_closed_form() {
        for (excursion, slip) in [(0.5, 0.0), (0.9, 1.92), (0.99, 0.3)] {
            let gaps = || (0..64).map(move |i| 1.0 + excursion * (std::f64::consts::TAU * f64::from(i) / 64.0).cos());
            let mean = |f: &dyn Fn(f64) -> f64| gaps().map(f).sum::<f64>() / 64.0;
            let exact = trapped_height(mean(&|h| h * h * (0.5 * h + slip)), mean(&|h| h), slip);
            let found = edge_height(Affine { offset: slip }, gaps);
            assert!((found / exact - 1.0).abs() < 1e-10, "{excursion} {slip}: {found} {exact}");
        }
    }
}
