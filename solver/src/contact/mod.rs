//! Unilateral contact between the teeth and the elastic rotor at one instant, with the film's trapped gas in between.
//!
//! The unknowns at every node are the gap g_i ≥ 0 and the contact line load c_i ≥ 0, with c_i g_i = 0; the rigid offset z₀ follows from the
//! load balance Σ Δx_i q_i = L. (Faces that meet on asperities: see below.) The line load is q = c + film. The film's part is that of a
//! fixed amount of trapped gas ζ (Z integrated across the width), p_a (ζ/h − w) with h = g + H_m. It stiffens as the gap closes, so that
//! the load balance always has a solution.
//!
//! The rotor's compliance is split into a local part C_∞, between the compliance of harmonic N and the limit of short waves, and a smooth part
//! C(k_n) − C_∞ for n < N. The local part couples a node with itself only, so that everything at a node follows from
//! s = z₀ + smooth deflection − W_S:
//!
//! ```text
//! g = s + C_∞ q,   c ≥ 0, g ≥ 0, c g = 0   ⟹   q = φ(s), decreasing, piecewise smooth, in closed form
//! ```
//!
//! The remaining unknowns are z₀ and 2(N−1) amplitudes, the minimum of a strictly convex function (or its saddle point, if a table has a
//! harmonic stiffer than the last one: see `modes`). Newton's method (semi-smooth, since φ has a corner where contact begins) with a line
//! search on the slope converges from any start; once no node changes between contact and gap, the remaining error is round-off. The Newton
//! step is solved for in the modes or, if there are fewer nodes than modes, in the nodes. Complementarity holds exactly by construction.
//!
//! **Asperities** in place of the hard stop make c = w p(g) a smooth function that falls with g. Here g is the separation of the mean
//! planes, and h the mean gap over them. Then g − s − C_∞ q(g) = 0 is a scalar equation whose left side rises with g, so it has one root,
//! which is found to working precision. q is still a decreasing function of s, and the rest of the problem is unchanged.

mod modes;
mod rough;

use modes::scale_both;
pub use modes::{Modes, Shape, cutoff};

use crate::numerics::{dot, sum_of, vectorised};
use crate::surface::Asperities;
use faer::linalg::solvers::{Ldlt, SolveCore};
use faer::{Conj, MatMut, MatRef, Side};
use nalgebra::{DMatrix, DVector};
use rough::Rough;

/// The contact problem of a rotor on its teeth: everything that is the same at every instant, and a workspace.
#[derive(Clone, Debug)]
pub struct Contact {
    modes: Modes,
    /// Deflection \[m/N\] of the smooth part at each node under a unit force at each node; `None` unless there are fewer nodes than
    /// unknowns.
    compliance: Option<DMatrix<f64>>,
    /// Δx_i \[m\].
    lengths: Vec<f64>,
    /// p_a × width on which the film acts at the node \[N/m\]; 0 at a tooth's edges, where the film is at p_a.
    ambient: Vec<f64>,
    ambient_pressure: f64,
    min_spacing: f64,
    /// The asperities that replace the hard stop at the minimum spacing.
    asperities: Option<Rough>,
    load: f64,
    /// Accepted imbalance, relative to the sum of all forces.
    tolerance: f64,
    /// Force \[N\] due to the round-off of the displacements at the last gradient: the imbalance of a stiff rotor cannot be smaller.
    noise: f64,
    // Workspace, one value for each node:
    s: Vec<f64>,
    /// The part of s that is smaller than its round-off.
    rest: Vec<f64>,
    force: Vec<f64>,
    stiffness: Vec<f64>,
}

/// Fields of one instant at the nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Instant {
    /// Film thickness h \[m\]: g + H_m, or over asperities the mean gap.
    pub film_thickness: Vec<f64>,
    /// Contact line load c \[N/m\].
    pub contact: Vec<f64>,
}

/// Why a contact problem failed: Newton's iteration did not settle.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the contact problem did not converge: after {iterations} iterations the balance is off by {imbalance:.1e} of the load"
)]
pub struct ContactError {
    /// Iterations made.
    pub iterations: u32,
    /// Largest imbalance, relative to the load.
    pub imbalance: f64,
}

const ITERATION_LIMIT: u32 = 200;
/// Imbalance, relative to the sum of all forces, that counts as round-off.
const ROUND_OFF: f64 = 2e-14;
/// Relative error of a displacement that is a sum of a few terms.
const LAST_BITS: f64 = 1e-15;

impl Contact {
    /// A contact problem whose nodes stand for `lengths` \[m\], with a film on `film_widths` \[m\] of the width at each, on a rotor with
    /// `modes`; `ambient_pressure` is in Pa, `min_spacing` H_m in m, and `load` L, on one wavelength, in N.
    pub fn new(
        mut modes: Modes,
        lengths: Vec<f64>,
        film_widths: &[f64],
        ambient_pressure: f64,
        min_spacing: f64,
        load: f64,
    ) -> Self {
        let nodes = lengths.len();
        modes.keep_positive(&lengths);
        let compliance = (nodes < modes.unknowns()).then(|| modes.compliance(|sign| sign));
        Self {
            modes,
            compliance,
            ambient: film_widths.iter().map(|w| ambient_pressure * w).collect(),
            lengths,
            ambient_pressure,
            min_spacing,
            asperities: None,
            load,
            tolerance: ROUND_OFF,
            noise: 0.0,
            s: vec![0.0; nodes],
            rest: vec![0.0; nodes],
            force: vec![0.0; nodes],
            stiffness: vec![0.0; nodes],
        }
    }

    /// Replaces the hard stop by `asperities`, if there are any, on a contact that is `width` \[m\] wide.
    pub fn on(self, asperities: Option<Asperities>, width: f64) -> Self {
        let nodes = self.nodes();
        Self { asperities: asperities.map(|law| Rough::new(law, width, nodes)), ..self }
    }

    /// The same teeth and rotor without a film: dry contact.
    pub fn dry(&self) -> Self {
        Self { ambient: vec![0.0; self.nodes()], tolerance: ROUND_OFF, ..self.clone() }
    }

    /// Accepts an imbalance of `tolerance` times the sum of all forces, but never less than round-off, for rounds whose trapped gas is not
    /// final yet. Complementarity stays exact.
    pub fn set_tolerance(&mut self, tolerance: f64) {
        self.tolerance = tolerance.max(ROUND_OFF);
    }

    /// Force subtracted from that of the trapped gas at the nodes \[N/m\]: ambient pressure on the rotor's back, less a force of the film
    /// that does not depend on the gap.
    pub fn ambient_mut(&mut self) -> &mut [f64] {
        &mut self.ambient
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.lengths.len()
    }

    /// The rotor's modes.
    pub fn modes(&self) -> &Modes {
        &self.modes
    }

    /// Solves one instant: `stator` is W_S \[m\] and `trapped` is ζ \[m²\] at the nodes. Returns the Newton iterations.
    ///
    /// # Errors
    /// [`ContactError`] if Newton's iteration does not settle.
    pub fn solve(
        &mut self,
        stator: &[f64],
        trapped: &[f64],
        shape: &mut Shape,
        out: &mut Instant,
    ) -> Result<u32, ContactError> {
        let unknowns = self.modes.unknowns();
        if shape.amplitudes.len() != unknowns {
            shape.amplitudes = vec![0.0; unknowns];
            shape.amplitudes[0] = self.rigid_offset(stator, trapped, &shape.amplitudes);
        }
        let mut amplitudes = std::mem::take(&mut shape.amplitudes);
        let mut gradient = vec![0.0; unknowns];
        let mut trial = vec![0.0; unknowns];
        let mut total = self.gradient(stator, trapped, &amplitudes, &mut gradient);
        let mut iterations = 0;
        let mut best = f64::INFINITY;
        let mut stalled = 0;
        let result = loop {
            let imbalance = (self.modes.imbalance(&gradient) - self.noise).max(0.0) / total;
            if imbalance < self.tolerance {
                break Ok(iterations);
            }
            // Near round-off Newton's method stops improving: an imbalance a few orders of magnitude above it is accepted, too.
            stalled = if imbalance < 0.5 * best { 0 } else { stalled + 1 };
            best = best.min(imbalance);
            if stalled >= 3 && imbalance < 1e3 * ROUND_OFF {
                break Ok(iterations);
            }
            if iterations == ITERATION_LIMIT {
                break Err(ContactError { iterations, imbalance });
            }
            iterations += 1;
            let Some(step) = self.newton_step(&gradient) else {
                // No node has any stiffness: only the rigid offset can restore contact.
                amplitudes[0] = self.rigid_offset(stator, trapped, &amplitudes);
                total = self.gradient(stator, trapped, &amplitudes, &mut gradient);
                continue;
            };
            // Line search: along the step the slope rises from slope0 < 0; stop where it is not far above zero. From where asperities hardly
            // touch, a step may be too long by tens of orders of magnitude.
            let slope0 = dot(&gradient, step.as_slice());
            let (mut low, mut high, mut fraction) = (0.0, f64::INFINITY, 1.0);
            for _ in 0..200 {
                for ((t, a), s) in trial.iter_mut().zip(&amplitudes).zip(step.iter()) {
                    *t = a + fraction * s;
                }
                total = self.gradient(stator, trapped, &trial, &mut gradient);
                let slope = dot(&gradient, step.as_slice());
                if slope.abs() <= 0.9 * slope0.abs()
                    || self.modes.imbalance(&gradient) <= self.tolerance.max(1e3 * ROUND_OFF) * total
                {
                    break;
                }
                if slope > 0.0 {
                    high = fraction;
                } else {
                    low = fraction;
                }
                fraction = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * fraction };
            }
            std::mem::swap(&mut amplitudes, &mut trial);
        };
        // The imbalance due to round-off at stiff nodes is added to their forces.
        self.rest.fill(0.0);
        if self.modes.imbalance(&gradient) > self.tolerance * total
            && let Some(step) = self.newton_step(&gradient)
        {
            self.modes.deflection(step.as_slice(), &mut self.rest);
        }
        self.fields(trapped, out);
        shape.amplitudes = amplitudes;
        result
    }

    /// Line load and its stiffness −dq/ds at node `i`, given s \[m\] and the trapped gas p_aζ.
    #[inline]
    fn node(&self, i: usize, s: f64, gas: f64) -> (f64, f64) {
        let (local, ambient) = (self.modes.local_compliance(), self.ambient[i]);
        if let Some(rough) = &self.asperities {
            let found = rough.node(i, local, s, gas, ambient);
            return (found.force, found.stiffness);
        }
        hard_stop(local, self.min_spacing, s, gas, ambient)
    }

    /// Film thickness at a node, given s \[m\] and the trapped gas p_aζ; `None` if the node touches.
    #[inline]
    fn gap(&self, s: f64, gas: f64, ambient: f64) -> Option<f64> {
        let (local, closed) = (self.modes.local_compliance(), self.min_spacing);
        let touches = s + local * (gas / closed - ambient) < 0.0;
        (!touches).then(|| free_height(s + closed - local * ambient, local * gas))
    }

    /// Force and stiffness of all nodes at s.
    #[inline(always)]
    fn forces(&mut self, trapped: &[f64]) {
        let (local, closed, pressure) = (self.modes.local_compliance(), self.min_spacing, self.ambient_pressure);
        let nodes =
            self.s.iter().zip(trapped).zip(&self.ambient).map(|((s, gas), ambient)| (*s, pressure * gas, *ambient));
        let to = self.force.iter_mut().zip(&mut self.stiffness);
        match &mut self.asperities {
            Some(rough) => {
                for (i, ((s, gas, ambient), (force, stiffness))) in nodes.zip(to).enumerate() {
                    (*force, *stiffness) = rough.next(i, local, s, gas, ambient);
                }
            }
            None => {
                for ((s, gas, ambient), (force, stiffness)) in nodes.zip(to) {
                    (*force, *stiffness) = hard_stop(local, closed, s, gas, ambient);
                }
            }
        }
        for values in [&mut self.force, &mut self.stiffness] {
            values.iter_mut().zip(&self.lengths).for_each(|(value, length)| *value *= length);
        }
    }

    /// Gradient of the energy (balance of every mode and of the load) at `amplitudes`; also stores s, force and stiffness of the nodes.
    /// Returns the sum of the magnitudes of all forces, the scale of round-off.
    fn gradient(&mut self, stator: &[f64], trapped: &[f64], amplitudes: &[f64], gradient: &mut [f64]) -> f64 {
        self.modes.deflection(amplitudes, &mut self.s);
        let mut total = self.load;
        vectorised(
            #[inline(always)]
            || {
                self.s.iter_mut().zip(stator).for_each(|(s, stator)| *s -= stator);
                self.forces(trapped);
                total += sum_of(&self.force, &self.force, |force, _| force.abs());
                let size = |stiffness: f64, stator: f64| stiffness * (amplitudes[0].abs() + stator.abs());
                self.noise = LAST_BITS * sum_of(&self.stiffness, stator, size);
            },
        );
        self.modes.project(&self.force, gradient);
        gradient[0] = self.load - gradient[0];
        for (g, a) in gradient.iter_mut().zip(amplitudes).skip(1) {
            *g = a - *g;
        }
        total
    }

    fn newton_step(&self, gradient: &[f64]) -> Option<DVector<f64>> {
        let step = match &self.compliance {
            Some(compliance) => self.step_of_nodes(compliance, gradient),
            None => self.step_of_modes(gradient),
        };
        step.filter(|step| step.iter().all(|v| v.is_finite()))
    }

    fn step_of_modes(&self, gradient: &[f64]) -> Option<DVector<f64>> {
        let mut hessian: DMatrix<f64> = self.modes.stiffness(&self.stiffness);
        for k in 1..hessian.nrows() {
            hessian[(k, k)] += self.modes.sign(k);
        }
        if hessian[(0, 0)] <= 0.0 {
            return None;
        }
        // The balance a − ⟨q, ψ⟩ of a concave mode is its gradient with the other sign, and so is its step.
        let mut step = -DVector::from_column_slice(gradient);
        Factors::of(&hessian)?.solve(&mut step);
        for k in 1..step.len() {
            step[k] *= self.modes.sign(k);
        }
        Some(step)
    }

    /// The same step, solved for in the forces of the nodes. With nodal stiffness K, smooth compliance G between the nodes, and the
    /// deflection v of the gradient's modes, the forces that the step removes are r = K(δz₀ − v − G r), with Σ r = −∂₀. The matrix is made
    /// symmetric with K^½ on both sides: I + K^½ G K^½ is positive definite whatever the sign of a mode, because the whole compliance is.
    fn step_of_nodes(&self, compliance: &DMatrix<f64>, gradient: &[f64]) -> Option<DVector<f64>> {
        let nodes = self.nodes();
        let root = DVector::from_iterator(nodes, self.stiffness.iter().map(|stiffness| stiffness.sqrt()));
        let mut matrix = compliance.clone();
        scale_both(&mut matrix, root.as_slice());
        for i in 0..nodes {
            matrix[(i, i)] += 1.0;
        }
        let factors = Factors::of(&matrix)?;
        let mut modal = gradient.to_vec();
        modal[0] = 0.0;
        let mut deflection = DVector::zeros(nodes);
        self.modes.deflection(&modal, deflection.as_mut_slice());
        let (mut rigid, mut smooth) = (root.clone(), root.component_mul(&deflection));
        factors.solve(&mut rigid);
        factors.solve(&mut smooth);
        let pushes = root.dot(&rigid);
        let offset = (root.dot(&smooth) - gradient[0]) / pushes;
        let force = (rigid * offset - smooth).component_mul(&root);
        let mut step = DVector::zeros(gradient.len());
        self.modes.project(force.as_slice(), step.as_mut_slice());
        for (step, gradient) in step.iter_mut().zip(gradient) {
            *step = -gradient - *step;
        }
        step[0] = offset;
        (pushes > 0.0).then_some(step)
    }

    /// z₀ that balances the load with the other amplitudes as they are, by bisection: the total force falls with z₀.
    fn rigid_offset(&mut self, stator: &[f64], trapped: &[f64], amplitudes: &[f64]) -> f64 {
        let mut shape = amplitudes.to_vec();
        shape[0] = 0.0;
        self.modes.deflection(&shape, &mut self.s);
        let base: Vec<f64> = self.s.iter().zip(stator).map(|(u, w)| u - w).collect();
        let force = |z0: f64| -> f64 {
            (0..base.len())
                .map(|i| self.lengths[i] * self.node(i, base[i] + z0, self.ambient_pressure * trapped[i]).0)
                .sum()
        };
        // Where the rotor would just touch, and a step to either side, doubled until the two bracket the root.
        let touch = base.iter().fold(f64::NEG_INFINITY, |top, b| top.max(-b));
        let end = |side: f64| {
            let mut reach = side * self.min_spacing;
            while side * force(touch + reach) > side * self.load && reach.abs() < 1e3 {
                reach *= 2.0;
            }
            touch + reach
        };
        let (mut low, mut high) = (end(-1.0), end(1.0));
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if middle == low || middle == high {
                break;
            }
            if force(middle) > self.load { low = middle } else { high = middle }
        }
        low
    }

    fn fields(&self, trapped: &[f64], out: &mut Instant) {
        let nodes = self.nodes();
        out.film_thickness.resize(nodes, 0.0);
        out.contact.resize(nodes, 0.0);
        let local = self.modes.local_compliance();
        for i in 0..nodes {
            let (s, gas, ambient) = (self.s[i], self.ambient_pressure * trapped[i], self.ambient[i]);
            (out.film_thickness[i], out.contact[i]) = if let Some(rough) = &self.asperities {
                let found = rough.node(i, local, s, gas, ambient);
                (found.thickness, (found.contact - found.stiffness * self.rest[i]).max(0.0))
            } else if let Some(h) = self.gap(s, gas, ambient) {
                (h.max(self.min_spacing), 0.0)
            } else {
                let film = gas / self.min_spacing - ambient;
                (self.min_spacing, (-s / local - self.rest[i] / local - film).max(0.0))
            };
        }
    }
}

/// Line load and its stiffness −dq/ds at a node, given s \[m\], the trapped gas p_aζ and the ambient pressure on its width, over a hard
/// stop at `closed` = H_m. Both branches are computed for every node, because one vector register holds nodes of both kinds.
#[inline(always)]
fn hard_stop(local: f64, closed: f64, s: f64, gas: f64, ambient: f64) -> (f64, f64) {
    let touches = s + local * (gas / closed - ambient) < 0.0;
    let h = free_height(s + closed - local * ambient, local * gas);
    let spring = gas / (h * h);
    let (free, rising) = (gas / h - ambient, spring / (1.0 + local * spring));
    if touches { (-s / local, 1.0 / local) } else { (free, rising) }
}

/// L D Lᵀ factorisation of a symmetric matrix, from its lower triangle. The matrix is positive definite or, at a saddle point, positive for
/// some unknowns and negative for the others.
struct Factors(Ldlt<f64>);

impl Factors {
    fn of(matrix: &DMatrix<f64>) -> Option<Self> {
        let matrix = MatRef::from_column_major_slice(matrix.as_slice(), matrix.nrows(), matrix.ncols());
        Ldlt::new(matrix, Side::Lower).ok().map(Self)
    }

    fn solve(&self, right: &mut DVector<f64>) {
        let rows = right.len();
        self.0.solve_in_place_with_conj(Conj::No, MatMut::from_column_major_slice_mut(right.as_mut_slice(), rows, 1));
    }
}

/// Positive root h of h² − b h − g = 0, g ≥ 0, without cancellation.
#[inline]
fn free_height(b: f64, g: f64) -> f64 {
    let root = (b * b + 4.0 * g).sqrt();
    if b >= 0.0 { 0.5 * (b + root) } else { 2.0 * g / (root - b) }
}
