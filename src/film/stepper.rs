//! One implicit time step of the film, second order in space and time, positive and conservative for any step.
//!
//! **Space.** Finite volumes around the nodes of a [`FilmGrid`]. With the face gap h_f = (h₀+h₁)/2 and
//! Z_f = h_f (P₀+P₁)/2 the flux through a face is −M h_f² ψ(Z_f)(P₁−P₀)/Δ: it vanishes for a uniform pressure, and for
//! a uniform gap and first-order slip it is exactly −M h (Φ₁−Φ₀)/Δ, Φ = Z²/2 + 6λ_a Z, so that the discrete film keeps
//! the invariant ⟨hΦ⟩ of the exact one. The wedge flux Z U/2 is central, plus the diffusion (Pe/2 coth Pe/2 − 1) of
//! exponential fitting, evaluated at the start of the step: O(Δ²), and upwind where sliding dominates.
//!
//! **Time.** BDF2 (L-stable), written for W = Z + θ/2 (Z − Z_old) so that mass is conserved whatever θ is:
//!
//! ```text
//! (1 + θ/2) Zⁿ⁺¹ = Wⁿ + θ/2 Zⁿ − Δt div flux(Zⁿ⁺¹),     Wⁿ⁺¹ = Zⁿ⁺¹ + θ/2 (Zⁿ⁺¹ − Zⁿ)
//! ```
//!
//! θ = 1 is BDF2. Where it would leave Wⁿ⁺¹ < Zⁿ⁺¹/10 (the trapped gas falls to a third within one step) the step is
//! repeated with θ = 0 at those nodes. So W stays positive, the right-hand side is positive, the operator is an
//! M-function (|d ln ψ/d ln Z| ≤ 1, `slip`), hence Zⁿ⁺¹ > 0: for every step, every gap, every squeeze number. A telescoping
//! sum over a cycle gives Σ div flux = 0 at every node of a periodic state: the mass balance, to round-off.
//!
//! Newton's method on P, unknown nodes ordered y fastest, banded LU. No allocation after construction.

use super::grid::{FilmGrid, Start};
use super::slip::{Mobility, SlipLaw};
use crate::numerics::banded::Banded;
use crate::problem::Gas;

/// The film's state between steps, at unknown nodes `[ix][iy]`.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmState {
    /// Trapped height Z = hP \[m\].
    pub trapped: Vec<f64>,
    /// W of the time scheme \[m\]: Z extrapolated by half a step.
    pub carried: Vec<f64>,
}

impl FilmState {
    /// The state at rest with trapped height `trapped`.
    pub fn at_rest(trapped: Vec<f64>) -> Self {
        Self { carried: trapped.clone(), trapped }
    }
}

/// What one step took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepCost {
    /// Linear solves.
    pub solves: u32,
    /// Whether positivity needed a locally first-order step.
    pub limited: bool,
}

/// Why a step failed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FilmError {
    /// Newton's iteration did not settle.
    #[error("the film step did not converge: after {iterations} iterations the pressure still changes by {change:.1e}")]
    Newton {
        /// Iterations made.
        iterations: u32,
        /// Largest relative change of the last one.
        change: f64,
    },
}

/// Newton's relative change below which a step is accepted, unless `Film::accept` loosens it. Convergence is quadratic:
/// the error left is about the square.
pub const NEWTON_TOLERANCE: f64 = 1e-7;
const NEWTON_LIMIT: u32 = 40;
/// Iterations of the damped method, and the largest relative change of a pressure that it accepts.
const CAREFUL_LIMIT: u32 = 400;
const LARGEST_CAREFUL_CHANGE: f64 = 0.8;
/// W is kept above this fraction of Z.
const CARRIED_FLOOR: f64 = 0.1;

/// The five diagonals of the film's Jacobian, at unknown nodes: row k couples to k, to its x neighbours and y
/// neighbours. Scaled so that time derivative terms are of the size of h.
#[derive(Clone, Debug, Default)]
pub struct FiveDiagonals {
    /// Node itself.
    pub centre: Vec<f64>,
    /// Neighbour at smaller x.
    pub west: Vec<f64>,
    /// Neighbour at larger x.
    pub east: Vec<f64>,
    /// Neighbour at smaller y.
    pub south: Vec<f64>,
    /// Neighbour at larger y.
    pub north: Vec<f64>,
}

impl FiveDiagonals {
    /// All zero, for `unknowns` nodes.
    pub fn new(unknowns: usize) -> Self {
        let zero = vec![0.0; unknowns];
        Self { centre: zero.clone(), west: zero.clone(), east: zero.clone(), south: zero.clone(), north: zero }
    }

    /// Sets every entry to zero.
    pub fn clear(&mut self) {
        for diagonal in [&mut self.centre, &mut self.west, &mut self.east, &mut self.south, &mut self.north] {
            diagonal.fill(0.0);
        }
    }

    /// Copies into a banded matrix whose half bandwidth is `columns` (unknown nodes across).
    pub fn fill(&self, columns: usize, matrix: &mut Banded) {
        matrix.clear();
        let unknowns = self.centre.len();
        for k in 0..unknowns {
            let row = matrix.row_mut(k);
            row[columns] = self.centre[k];
            if columns > 1 {
                if !k.is_multiple_of(columns) {
                    row[columns - 1] = self.south[k];
                }
                if k % columns + 1 < columns {
                    row[columns + 1] = self.north[k];
                }
            }
            if k >= columns {
                row[0] = self.west[k];
            }
            if k + columns < unknowns {
                row[2 * columns] = self.east[k];
            }
        }
    }
}

/// The film on one grid, with its workspace.
#[derive(Clone, Debug)]
pub struct Film {
    grid: FilmGrid,
    law: SlipLaw,
    /// M = p_a/(12μ) \[1/s\].
    mobility: f64,
    columns: usize,
    tolerance: f64,
    /// P at every node, edges included, `[ix][iy]`.
    pressure: Vec<f64>,
    theta: Vec<f64>,
    /// Extra conductance of the wedge term at x faces \[m²\], `[face][iy]`.
    fitting: Vec<f64>,
    rhs: Vec<f64>,
    residual: Vec<f64>,
    jacobian: FiveDiagonals,
    matrix: Banded,
    face: FaceRow,
}

/// Flux through one row of x faces and its derivatives by the pressures on either side.
#[derive(Clone, Debug, Default)]
struct FaceRow {
    flux: Vec<f64>,
    by_west: Vec<f64>,
    by_east: Vec<f64>,
}

impl Film {
    /// The film of `gas` on `grid`.
    pub fn new(grid: FilmGrid, gas: &Gas) -> Self {
        let unknowns = grid.unknowns();
        let columns = grid.y.unknown().len();
        Self {
            law: SlipLaw::of(gas),
            mobility: gas.ambient_pressure / (12.0 * gas.viscosity),
            columns,
            tolerance: NEWTON_TOLERANCE,
            pressure: vec![1.0; grid.len()],
            theta: vec![1.0; unknowns],
            fitting: vec![0.0; grid.len()],
            rhs: vec![0.0; unknowns],
            residual: vec![0.0; unknowns],
            jacobian: FiveDiagonals::new(unknowns),
            matrix: Banded::new(unknowns, columns),
            face: FaceRow { flux: vec![0.0; columns], by_west: vec![0.0; columns], by_east: vec![0.0; columns] },
            grid,
        }
    }

    /// The nodes.
    pub fn grid(&self) -> &FilmGrid {
        &self.grid
    }

    /// Accepts steps whose last Newton change is below `tolerance`, for rounds whose gap is not final yet.
    pub fn accept(&mut self, tolerance: f64) {
        self.tolerance = tolerance;
    }

    /// P = p/p_a at every node, edges included, `[ix][iy]`, after the last step.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// Jacobian of Δt·div flux by P in the last step (without the time derivative), and the matrix workspace.
    pub fn last_jacobian(&self) -> &FiveDiagonals {
        &self.jacobian
    }

    /// Advances `state` by `dt` \[s\] to the gap `h` \[m\] (one value for each node along x). `speed`: sliding speed U
    /// \[m/s\] at the nodes along x at the end of the step, or `None` to leave the wedge term out. `guess`: P at unknown
    /// nodes to start from.
    ///
    /// # Errors
    /// [`FilmError::Newton`] when the iteration does not settle; `state` is then unchanged.
    pub fn step(
        &mut self,
        h: &[f64],
        speed: Option<&[f64]>,
        dt: f64,
        state: &mut FilmState,
        guess: Option<&[f64]>,
    ) -> Result<StepCost, FilmError> {
        match self.law {
            SlipLaw::Affine(law) => self.step_with(law, h, speed, dt, state, guess),
            SlipLaw::SecondOrder(law) => self.step_with(law, h, speed, dt, state, guess),
            SlipLaw::FukuiKaneko(law) => self.step_with(law, h, speed, dt, state, guess),
        }
    }

    fn step_with<L: Mobility>(
        &mut self,
        law: L,
        h: &[f64],
        speed: Option<&[f64]>,
        dt: f64,
        state: &mut FilmState,
        guess: Option<&[f64]>,
    ) -> Result<StepCost, FilmError> {
        let mut cost = StepCost::default();
        self.load_pressure(h, &state.trapped);
        if let Some(speed) = speed {
            self.fit(law, h, speed, dt);
        }
        if let Some(guess) = guess {
            self.scatter_pressure(guess);
        }
        self.theta.fill(1.0);
        let mut careful = false;
        loop {
            match self.newton(law, h, speed, dt, state, careful, &mut cost) {
                Ok(()) if !self.limit(h, state) => break,
                Ok(()) => cost.limited = true,
                // Strong sliding into a narrow gap: the fitting was made for another pressure, and Newton overshoots.
                // Fully upwind faces make an M-function of any pressure, damped steps find its root.
                Err(_) if !careful => {
                    careful = true;
                    cost.limited = true;
                    if let Some(speed) = speed {
                        self.fit_upwind(h, speed, dt);
                    }
                }
                Err(error) => return Err(error),
            }
        }
        // Accept: Z = hP, W = Z + θ/2 (Z − Z_old).
        let (ux, ny, columns) = (self.grid.x.unknown(), self.grid.y.len(), self.columns);
        let y0 = self.grid.y.unknown().start;
        for (row, ix) in ux.enumerate() {
            for j in 0..columns {
                let k = row * columns + j;
                let trapped = h[ix] * self.pressure[ix * ny + y0 + j];
                state.carried[k] = trapped + 0.5 * self.theta[k] * (trapped - state.trapped[k]);
                state.trapped[k] = trapped;
            }
        }
        Ok(cost)
    }

    /// P at the unknown nodes from Z and the gap; the edges hold 1 for good.
    fn load_pressure(&mut self, h: &[f64], trapped: &[f64]) {
        let (ux, uy, ny) = (self.grid.x.unknown(), self.grid.y.unknown(), self.grid.y.len());
        for (column, ix) in trapped.chunks_exact(self.columns).zip(ux) {
            let target = &mut self.pressure[ix * ny + uy.start..ix * ny + uy.end];
            for (p, z) in target.iter_mut().zip(column) {
                *p = z / h[ix];
            }
        }
    }

    fn scatter_pressure(&mut self, unknown: &[f64]) {
        let (ux, uy, ny) = (self.grid.x.unknown(), self.grid.y.unknown(), self.grid.y.len());
        for (column, ix) in unknown.chunks_exact(self.columns).zip(ux) {
            self.pressure[ix * ny + uy.start..ix * ny + uy.end].copy_from_slice(column);
        }
    }

    /// P at the unknown nodes.
    pub fn gather_pressure(&self, unknown: &mut [f64]) {
        let (ux, uy, ny) = (self.grid.x.unknown(), self.grid.y.unknown(), self.grid.y.len());
        for (column, ix) in unknown.chunks_exact_mut(self.columns).zip(ux) {
            column.copy_from_slice(&self.pressure[ix * ny + uy.start..ix * ny + uy.end]);
        }
    }

    /// The diffusion of exponential fitting at x faces, from the pressure at the start of the step.
    fn fit<L: Mobility>(&mut self, law: L, h: &[f64], speed: &[f64], dt: f64) {
        let (nx, ny) = (self.grid.x.len(), self.grid.y.len());
        for face in 0..nx - 1 {
            let (coefficient, face_gap) = self.x_face(face, h, dt);
            let drift = 0.25 * dt * face_gap * (speed[face] + speed[face + 1]);
            for j in 0..ny {
                let mean = 0.5 * (self.pressure[face * ny + j] + self.pressure[(face + 1) * ny + j]);
                let diffusion = coefficient * law.at(face_gap * mean).0;
                let half_peclet = 0.5 * (drift / diffusion).abs();
                self.fitting[face * ny + j] = if half_peclet < 1e-3 {
                    diffusion * half_peclet * half_peclet / 3.0
                } else {
                    diffusion * (half_peclet / half_peclet.tanh() - 1.0)
                };
            }
        }
    }

    /// The diffusion that makes the wedge flux fully upwind.
    fn fit_upwind(&mut self, h: &[f64], speed: &[f64], dt: f64) {
        let (nx, ny) = (self.grid.x.len(), self.grid.y.len());
        for face in 0..nx - 1 {
            let (_, face_gap) = self.x_face(face, h, dt);
            let drift = 0.125 * dt * face_gap * (speed[face] + speed[face + 1]);
            self.fitting[face * ny..(face + 1) * ny].fill(drift.abs());
        }
    }

    /// Coefficient Δt M h_f²/Δ \[m\] of the flux through the x face after node `face`, and the gap there \[m\].
    #[inline]
    fn x_face(&self, face: usize, h: &[f64], dt: f64) -> (f64, f64) {
        let face_gap = 0.5 * (h[face] + h[face + 1]);
        let spacing = self.grid.x.nodes[face + 1] - self.grid.x.nodes[face];
        (dt * self.mobility * face_gap * face_gap / spacing, face_gap)
    }

    /// Flux through the x faces after node `face`, at unknown y.
    fn x_flux<L: Mobility>(&mut self, law: L, face: usize, h: &[f64], speed: Option<&[f64]>, dt: f64) {
        let (coefficient, face_gap) = self.x_face(face, h, dt);
        let ny = self.grid.y.len();
        let y0 = self.grid.y.unknown().start;
        let west = &self.pressure[face * ny + y0..][..self.columns];
        let east = &self.pressure[(face + 1) * ny + y0..][..self.columns];
        let FaceRow { flux, by_west, by_east } = &mut self.face;
        for j in 0..self.columns {
            let (psi, slope) = law.at(face_gap * 0.5 * (west[j] + east[j]));
            let drop = east[j] - west[j];
            let conductance = coefficient * psi;
            let variation = 0.5 * coefficient * slope * face_gap * drop;
            flux[j] = -conductance * drop;
            by_west[j] = conductance - variation;
            by_east[j] = -conductance - variation;
        }
        if let Some(speed) = speed {
            let drift = 0.125 * dt * face_gap * (speed[face] + speed[face + 1]);
            let fitting = &self.fitting[face * ny + y0..][..self.columns];
            for j in 0..self.columns {
                flux[j] += drift * (west[j] + east[j]) - fitting[j] * (east[j] - west[j]);
                by_west[j] += drift + fitting[j];
                by_east[j] += drift - fitting[j];
            }
        }
    }

    /// Δt·div flux into `residual` and its Jacobian into `jacobian`.
    fn assemble_flux<L: Mobility>(&mut self, law: L, h: &[f64], speed: Option<&[f64]>, dt: f64) {
        let (ux, uy) = (self.grid.x.unknown(), self.grid.y.unknown());
        let (ny, columns) = (self.grid.y.len(), self.columns);
        self.residual.fill(0.0);
        self.jacobian.clear();
        // Across: faces between y nodes, from the first unknown node to the ambient edge.
        if ny > 1 {
            for (row, ix) in ux.clone().enumerate() {
                let gap = h[ix];
                let first_face = if self.grid.y.start == Start::Mirror { uy.start } else { uy.start - 1 };
                for j in first_face..uy.end {
                    let spacing = self.grid.y.nodes[j + 1] - self.grid.y.nodes[j];
                    let coefficient = dt * self.mobility * gap * gap / spacing;
                    let (south, north) = (self.pressure[ix * ny + j], self.pressure[ix * ny + j + 1]);
                    let (psi, slope) = law.at(gap * 0.5 * (south + north));
                    let drop = north - south;
                    let (conductance, variation) = (coefficient * psi, 0.5 * coefficient * slope * gap * drop);
                    let flux = -conductance * drop;
                    if j >= uy.start {
                        let k = row * columns + j - uy.start;
                        let inverse = 1.0 / self.grid.y.lengths[j];
                        self.residual[k] += flux * inverse;
                        self.jacobian.centre[k] += (conductance - variation) * inverse;
                        self.jacobian.north[k] -= (conductance + variation) * inverse;
                    }
                    if j + 1 < uy.end {
                        let k = row * columns + j + 1 - uy.start;
                        let inverse = 1.0 / self.grid.y.lengths[j + 1];
                        self.residual[k] -= flux * inverse;
                        self.jacobian.centre[k] += (conductance + variation) * inverse;
                        self.jacobian.south[k] -= (conductance - variation) * inverse;
                    }
                }
            }
        }
        // Along: each row of faces serves the nodes on both of its sides.
        let first_face = if self.grid.x.start == Start::Mirror { ux.start } else { ux.start - 1 };
        for face in first_face..ux.end {
            self.x_flux(law, face, h, speed, dt);
            let FaceRow { flux, by_west, by_east } = &self.face;
            if face >= ux.start {
                let (base, inverse) = ((face - ux.start) * columns, 1.0 / self.grid.x.lengths[face]);
                for j in 0..columns {
                    self.residual[base + j] += flux[j] * inverse;
                    self.jacobian.centre[base + j] += by_west[j] * inverse;
                    self.jacobian.east[base + j] += by_east[j] * inverse;
                }
            }
            if face + 1 < ux.end {
                let (base, inverse) = ((face + 1 - ux.start) * columns, 1.0 / self.grid.x.lengths[face + 1]);
                for j in 0..columns {
                    self.residual[base + j] -= flux[j] * inverse;
                    self.jacobian.centre[base + j] -= by_east[j] * inverse;
                    self.jacobian.west[base + j] -= by_west[j] * inverse;
                }
            }
        }
    }

    /// Newton's method for the step. `careful`: damped by pseudo-time, the matrix's inertia raised until no pressure
    /// moves by more than a factor, for the rare step on which plain Newton runs away.
    fn newton<L: Mobility>(
        &mut self,
        law: L,
        h: &[f64],
        speed: Option<&[f64]>,
        dt: f64,
        state: &FilmState,
        careful: bool,
        cost: &mut StepCost,
    ) -> Result<(), FilmError> {
        let (ux, uy) = (self.grid.x.unknown(), self.grid.y.unknown());
        let (ny, columns) = (self.grid.y.len(), self.columns);
        for k in 0..self.rhs.len() {
            self.rhs[k] = state.carried[k] + 0.5 * self.theta[k] * state.trapped[k];
        }
        let mut change = f64::INFINITY;
        let mut damping = if careful { 1.0 } else { 0.0 };
        let limit = if careful { CAREFUL_LIMIT } else { NEWTON_LIMIT };
        for _ in 0..limit {
            self.assemble_flux(law, h, speed, dt);
            self.jacobian.fill(columns, &mut self.matrix);
            for (row, ix) in ux.clone().enumerate() {
                for j in 0..columns {
                    let k = row * columns + j;
                    let inertia = (1.0 + 0.5 * self.theta[k]) * h[ix];
                    self.matrix.row_mut(k)[columns] += inertia + damping * self.jacobian.centre[k];
                    let pressure = self.pressure[ix * ny + uy.start + j];
                    self.residual[k] = self.rhs[k] - inertia * pressure - self.residual[k];
                }
            }
            self.matrix.solve_in_place(&mut self.residual);
            cost.solves += 1;
            change = 0.0;
            for (column, ix) in self.residual.chunks_exact(columns).zip(ux.clone()) {
                let values = &self.pressure[ix * ny + uy.start..ix * ny + uy.end];
                for (p, step) in values.iter().zip(column) {
                    let relative = (step / p).abs();
                    if relative.is_nan() || relative > change {
                        change = relative;
                    }
                }
            }
            if change.is_nan() {
                break;
            }
            if careful && change > LARGEST_CAREFUL_CHANGE {
                damping = f64::max(4.0 * damping, 1e-3);
                continue;
            }
            for (column, ix) in self.residual.chunks_exact(columns).zip(ux.clone()) {
                let values = &mut self.pressure[ix * ny + uy.start..ix * ny + uy.end];
                for (p, step) in values.iter_mut().zip(column) {
                    // A Newton step from below may overshoot zero: it is cut, not refused.
                    *p = (*p + step).clamp(0.1 * *p, 10.0 * *p);
                }
            }
            if change < self.tolerance && damping == 0.0 {
                return Ok(());
            }
            damping = if damping < 1e-6 { 0.0 } else { 0.25 * damping };
        }
        // The caller gets a film that still holds the state it had.
        self.load_pressure(h, &state.trapped);
        Err(FilmError::Newton { iterations: limit, change })
    }

    /// Lowers θ to 0 where W would fall too far; whether any was lowered.
    fn limit(&mut self, h: &[f64], state: &FilmState) -> bool {
        let (ux, uy, ny) = (self.grid.x.unknown(), self.grid.y.unknown(), self.grid.y.len());
        let mut any = false;
        for (row, ix) in ux.enumerate() {
            for j in 0..self.columns {
                let k = row * self.columns + j;
                let trapped = h[ix] * self.pressure[ix * ny + uy.start + j];
                let carried = trapped + 0.5 * self.theta[k] * (trapped - state.trapped[k]);
                if self.theta[k] > 0.0 && carried < CARRIED_FLOOR * trapped {
                    self.theta[k] = 0.0;
                    any = true;
                }
            }
        }
        any
    }
}
