//! The rotor and its unilateral contact with the teeth: the paper's iteration on an assumed contact set.
//!
//! # Equation
//!
//! The rotor is its discrete Green's function on N nodes per wavelength (the paper's equation (8)),
//!
//! ```text
//! W_R,i = z0 + Σ_j G_ij f_j      G_ij = (2/λ) Σ_{n=1}^{N/2} C(k_n) cos k_n (x_i − x_j),   k_n = 2πn/λ
//! ```
//!
//! the last term halved when N is even (its cosine is its own alias). Nodal forces f are film plus contact, f = φ + c.
//! On every node of a tooth top c ≥ 0, W_R − W_S ≥ 0 and one of them is zero; Σ f = L; φ is frozen.
//!
//! The sum has no n = 0 term, so z0 is the rotor's mean offset. Adding a constant γ to every G_ij only moves γ L
//! into z0, since Σ f is fixed, and makes every principal submatrix positive definite. That is what is stored, with
//! γ = G_00, so Cholesky applies whatever the contact set.
//!
//! # Iteration
//!
//! With S the assumed set: G_SS c + z0 = W_S − (G φ)_S and Σ c = L − Σ φ, by two triangular solves and an elimination
//! of z0. Nodes of S with c < 0 leave, nodes outside it that penetrate enter, until neither happens. After
//! [`TOGETHER`] rounds only the lowest-numbered offender changes (Murty's rule, which cannot cycle), and after
//! [`ROUNDS`] the set is taken as it is.
//!
//! If the film alone carries more than the load, L − Σ φ ≤ 0, there is no such set: the paper's iteration then has no answer, since it
//! cannot let the film thicken. The rotor is left just touching, without contact force, and the caller receives [`Balance::Overcarried`].

use super::mesh::Meshes;
use crate::problem::Motor;
use crate::rotor::Compliances;

/// Rounds in which all offending nodes change together.
const TOGETHER: usize = 40;
/// Most rounds.
const ROUNDS: usize = 400;
/// A negative contact force smaller than this fraction of the load counts as round-off.
const FORCE_ROUNDING: f64 = 1e-12;
/// A penetration smaller than this fraction of the amplitude counts as round-off.
const GAP_ROUNDING: f64 = 1e-9;

/// How a contact problem ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Balance {
    /// Contact conditions and load balance hold.
    Held,
    /// The set was still changing at the last round.
    Unsettled,
    /// The film carries more than the load.
    Overcarried,
}

/// The rotor with its contact set and work space; solving allocates nothing.
#[derive(Clone, Debug)]
pub(super) struct Contact {
    n: usize,
    load: f64,
    amplitude: f64,
    /// Green's function + γ over offsets −N+1..N: G_ij = `green[N + j − i]`.
    green: Vec<f64>,
    /// Contact node of each top.
    nodes: Vec<usize>,
    /// Whether each top is in contact.
    pub(super) touching: Vec<bool>,
    /// Contact force at each top \[N\].
    pub(super) force: Vec<f64>,
    /// W_R at every contact node \[m\].
    pub(super) rotor: Vec<f64>,
    /// G φ at every contact node.
    base: Vec<f64>,
    /// Tops in contact.
    set: Vec<usize>,
    factor: Vec<f64>,
    rhs: Vec<f64>,
    ones: Vec<f64>,
    /// Rounds so far, of all solves.
    pub(super) rounds: u64,
}

impl Contact {
    pub(super) fn new(motor: &Motor, rotor: &Compliances, meshes: &Meshes) -> Self {
        let n = meshes.n;
        let lambda = motor.wavelength();
        let column: Vec<f64> = (0..n)
            .map(|d| {
                let sum: f64 = (1..=n / 2)
                    .map(|harmonic| {
                        let nyquist = if 2 * harmonic == n { 0.5 } else { 1.0 };
                        // Reduced first: the cosine of a large argument loses digits.
                        let turn = (harmonic * d % n) as f64 / n as f64;
                        nyquist * rotor.harmonic(harmonic) * (std::f64::consts::TAU * turn).cos()
                    })
                    .sum();
                2.0 / lambda * sum
            })
            .collect();
        let gamma = column[0];
        let green = (0..2 * n).map(|offset| column[offset % n] + gamma).collect();
        let tops = meshes.tops.len();
        Self {
            n,
            load: motor.load,
            amplitude: motor.normal_amplitude,
            green,
            nodes: meshes.tops.iter().map(|top| top.node).collect(),
            touching: vec![false; tops],
            force: vec![0.0; tops],
            rotor: vec![0.0; n],
            base: vec![0.0; n],
            set: Vec::with_capacity(tops),
            factor: vec![0.0; tops * tops],
            rhs: vec![0.0; tops],
            ones: vec![0.0; tops],
            rounds: 0,
        }
    }

    /// Solves for contact forces and rotor shape under the film's nodal forces `film` \[N\] and against the stator's
    /// displacement `stator` \[m\], both per top, starting from the current contact set.
    pub(super) fn solve(&mut self, film: &[f64], stator: &[f64]) -> Balance {
        self.base.fill(0.0);
        for (top, &force) in film.iter().enumerate() {
            spread(&self.green, self.n, self.nodes[top], force, &mut self.base);
        }
        let carried: f64 = film.iter().sum();
        let left = self.load - carried;
        self.force.fill(0.0);
        // A NaN ends here too.
        if left.is_nan() || left <= 0.0 {
            self.rounds += 1;
            self.touching.fill(false);
            let offset = self.highest(stator).map_or(0.0, |top| stator[top] - self.base[self.nodes[top]]);
            for (w, base) in self.rotor.iter_mut().zip(&self.base) {
                *w = base + offset;
            }
            return Balance::Overcarried;
        }
        if !self.touching.contains(&true)
            && let Some(highest) = self.highest(stator)
        {
            self.touching[highest] = true;
        }
        for round in 0..ROUNDS {
            self.rounds += 1;
            self.deform(stator, left);
            if !self.revise(stator, round >= TOGETHER) {
                return Balance::Held;
            }
        }
        Balance::Unsettled
    }

    /// Contact forces and rotor shape for the assumed set.
    fn deform(&mut self, stator: &[f64], left: f64) {
        self.set.clear();
        self.set.extend((0..self.nodes.len()).filter(|&top| self.touching[top]));
        let size = self.set.len();
        for (row, &top) in self.set.iter().enumerate() {
            let node = self.nodes[top];
            for (column, &other) in self.set[..=row].iter().enumerate() {
                self.factor[row * size + column] = self.green[self.n + self.nodes[other] - node];
            }
            self.rhs[row] = stator[top] - self.base[node];
            self.ones[row] = 1.0;
        }
        cholesky(&mut self.factor, size);
        cholesky_solve(&self.factor, size, &mut self.rhs[..size]);
        cholesky_solve(&self.factor, size, &mut self.ones[..size]);
        let rhs: f64 = self.rhs[..size].iter().sum();
        let ones: f64 = self.ones[..size].iter().sum();
        let offset = (rhs - left) / ones;

        self.force.fill(0.0);
        for (w, base) in self.rotor.iter_mut().zip(&self.base) {
            *w = base + offset;
        }
        for (row, &top) in self.set.iter().enumerate() {
            let force = self.rhs[row] - offset * self.ones[row];
            self.force[top] = force;
            spread(&self.green, self.n, self.nodes[top], force, &mut self.rotor);
        }
    }

    /// Changes the set where the conditions fail; false if they hold.
    fn revise(&mut self, stator: &[f64], one_at_a_time: bool) -> bool {
        let (pull, penetration) = (-FORCE_ROUNDING * self.load, -GAP_ROUNDING * self.amplitude);
        let mut changed = false;
        for top in 0..self.nodes.len() {
            let offends = if self.touching[top] {
                self.force[top] < pull
            } else {
                self.rotor[self.nodes[top]] - stator[top] < penetration
            };
            if offends {
                self.touching[top] = !self.touching[top];
                changed = true;
                if one_at_a_time {
                    break;
                }
            }
        }
        if changed
            && !self.touching.contains(&true)
            && let Some(highest) = self.highest(stator)
        {
            self.touching[highest] = true;
        }
        changed
    }

    /// The top that the rotor, bent by the film alone, would meet first.
    fn highest(&self, stator: &[f64]) -> Option<usize> {
        let height = |top: usize| stator[top] - self.base[self.nodes[top]];
        (0..self.nodes.len()).max_by(|&a, &b| height(a).total_cmp(&height(b)))
    }
}

/// Adds the rotor's displacement under `force` at `node` to `w`.
fn spread(green: &[f64], n: usize, node: usize, force: f64, w: &mut [f64]) {
    for (w, g) in w.iter_mut().zip(&green[n - node..2 * n - node]) {
        *w += g * force;
    }
}

/// Factors the lower triangle of a symmetric positive definite matrix, row-major, in place.
fn cholesky(a: &mut [f64], size: usize) {
    for i in 0..size {
        for j in 0..=i {
            let dot: f64 = (0..j).map(|k| a[i * size + k] * a[j * size + k]).sum();
            let rest = a[i * size + j] - dot;
            a[i * size + j] = if i == j { rest.sqrt() } else { rest / a[j * size + j] };
        }
    }
}

/// Solves with the factor of [`cholesky`], in place.
fn cholesky_solve(factor: &[f64], size: usize, b: &mut [f64]) {
    for i in 0..size {
        let dot: f64 = (0..i).map(|k| factor[i * size + k] * b[k]).sum();
        b[i] = (b[i] - dot) / factor[i * size + i];
    }
    for i in (0..size).rev() {
        let dot: f64 = (i + 1..size).map(|k| factor[k * size + i] * b[k]).sum();
        b[i] = (b[i] - dot) / factor[i * size + i];
    }
}
