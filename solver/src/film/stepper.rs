//! One implicit time step of the film, second order in space and time, positive and conservative for any step.
//!
//! **Space.** Finite volumes around the nodes of a [`FilmGrid`]. With Z_f = (Z₀+Z₁)/2 the flux through a face is −M h₀h₁ ψ(Z_f)(P₁−P₀)/Δ.
//! It vanishes for a uniform pressure. For a uniform gap and first-order slip it is exactly −M h (Φ₁−Φ₀)/Δ, Φ = Z²/2 + 6λ_a Z, so that the
//! discrete film keeps the invariant ⟨hΦ⟩ of the exact one. For gas that has no time to move, its cycle mean is −M ψ(Z_f)(⟨h₀⟩Z₁ −
//! ⟨h₁⟩Z₀)/Δ, which vanishes for Z ∝ ⟨h⟩ as in the continuum, however much the gap changes from node to node. From a narrow gap into a
//! wide, nearly empty one this flux would fall with the pressure in the wide gap. Below P₁(h₀−h₁)/2h₀ the face is therefore choked: its
//! flux stays constant, so that every flux is monotone in the pressures on either side. The wedge flux Z U/2 is central, plus the diffusion
//! (Pe/2 coth Pe/2 − 1) of exponential fitting, evaluated at the start of the step: O(Δ²), and upwind where sliding dominates.
//!
//! Between rough faces (`surface::flow`) the flux through a face is multiplied by the mean of the flow factors of its two nodes, which
//! depend on their gaps alone; all statements above still hold.
//!
//! **Time.** BDF2 (L-stable), written for W = Z + θ/2 (Z − Z_old) so that mass is conserved whatever θ is:
//!
//! ```text
//! (1 + θ/2) Zⁿ⁺¹ = Wⁿ + θ/2 Zⁿ − Δt div flux(Zⁿ⁺¹),     Wⁿ⁺¹ = Zⁿ⁺¹ + θ/2 (Zⁿ⁺¹ − Zⁿ)
//! ```
//!
//! θ = 1 is BDF2. Where it would make Wⁿ⁺¹ < Zⁿ⁺¹/10 (the trapped gas falls to about a third within one step), the step is repeated with θ
//! = 0 at those nodes. So W and the right-hand side stay positive, and the operator is an M-function (|d ln ψ/d ln Z| ≤ 1, `slip`, and
//! faces that choke), hence Zⁿ⁺¹ > 0: for every step, every gap, every squeeze number. A telescoping sum over a cycle gives Σ div flux = 0
//! at every node of a periodic state, which is the mass balance, to round-off.
//!
//! The unknown is P, found by Newton's method with the linear solver of [`crate::numerics::rows`]; unknown nodes are ordered y fastest.
//! Nothing is allocated after construction.

use super::grid::{Axis, FilmGrid, Start};
use super::slip::{Mobility, SlipLaw};
use crate::numerics::rows::{RowSolver, with_columns};
use crate::numerics::system::{Across, Coupling};
use crate::numerics::vectorised;
use crate::problem::Gas;
use crate::surface::flow::{Factors, Roughness};
use std::ops::AddAssign;

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

    /// Largest change of ln Z since `earlier`.
    pub fn change_since(&self, earlier: &Self) -> f64 {
        self.trapped.iter().zip(&earlier.trapped).map(|(now, then)| (now / then).ln().abs()).fold(0.0, f64::max)
    }

    /// ln Z and then ln W at all nodes.
    pub fn logarithms(&self) -> impl Iterator<Item = f64> {
        self.trapped.iter().chain(&self.carried).map(|height| height.ln())
    }

    /// Sets the state from its [`Self::logarithms`].
    pub fn set_logarithms(&mut self, logarithms: &[f64]) {
        for (height, logarithm) in self.trapped.iter_mut().chain(&mut self.carried).zip(logarithms) {
            *height = logarithm.exp();
        }
    }
}

/// Cost of the time steps of one film.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Time steps.
    pub steps: u64,
    /// Linear solves.
    pub solves: u64,
    /// Steps in which positivity needed a locally first-order step.
    pub limited: u64,
}

impl AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.steps += other.steps;
        self.solves += other.solves;
        self.limited += other.limited;
    }
}

/// Why a step failed: Newton's iteration did not settle.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the film step did not converge: after {iterations} iterations the pressure still changes by {change:.1e}")]
pub struct FilmError {
    /// Iterations made.
    pub iterations: u32,
    /// Largest relative change of the last one.
    pub change: f64,
}

/// Newton's relative change below which a step is accepted, unless `Film::set_tolerance` loosens it. Convergence is quadratic: the
/// remaining error is about the square of this.
pub const NEWTON_TOLERANCE: f64 = 1e-7;
const NEWTON_LIMIT: u32 = 40;
/// Iterations of the damped method, the number of them in which the damping is lowered quickly, and the largest relative change of a
/// pressure that it accepts.
const CAREFUL_LIMIT: u32 = 400;
const HASTY: u32 = 60;
const LARGEST_CAREFUL_CHANGE: f64 = 0.8;
/// Change of a pressure that counts as round-off when the damped method has reached its limit: where slip lets gas through everywhere, the
/// pressure cannot be known more exactly.
const ROUND_OFF: f64 = 1e-6;
/// Least initial pressure of such a step, relative to ambient.
const EMPTY: f64 = 1e-12;
/// W is kept above this fraction of Z.
const CARRIED_FLOOR: f64 = 0.1;

/// The film on one grid, with its workspace.
#[derive(Clone, Debug)]
pub struct Film {
    grid: FilmGrid,
    pub(super) law: SlipLaw,
    /// M = p_a/(12μ) \[1/s\].
    mobility: f64,
    columns: usize,
    tolerance: f64,
    /// Whether there is no flow along x.
    closed_along: bool,
    /// The roughness of the faces if they are not smooth, and its effect on the flow at each node along x.
    roughness: Option<Roughness>,
    flow: Vec<Factors>,
    /// P at every node, edges included, `[ix][iy]`.
    pressure: Vec<f64>,
    theta: Vec<f64>,
    /// Extra conductance of the wedge term at x faces \[m²\], `[face][iy]`.
    fitting: Vec<f64>,
    rhs: Vec<f64>,
    residual: Vec<f64>,
    /// Δt·div flux \[m\].
    divergence: Vec<f64>,
    /// Jacobian of Δt·div flux by P in the last step (without the time derivative).
    pub(super) jacobian: Coupling,
    /// Diagonal of Newton's matrix: the Jacobian's, the gas stored in the gap, and the damping of a careful step.
    pivots: Vec<f64>,
    solver: RowSolver,
    /// Faces before and after the row being assembled.
    faces: [FaceRow; 2],
    /// −∂²/∂y² across \[1/m²\].
    across: Across,
    /// Φ at the nodes of the row being assembled, less that of the edge \[m²\], and the outflow across.
    potential: Vec<f64>,
    outflow: Vec<f64>,
}

/// Δt × flux \[m²\] through one row of x faces and its derivatives by the pressures on either side.
#[derive(Clone, Debug, Default)]
struct FaceRow {
    flux: Vec<f64>,
    by_west: Vec<f64>,
    by_east: Vec<f64>,
}

/// The face between two neighbouring nodes along x.
#[derive(Clone, Copy)]
struct CellFace {
    /// Coefficient Δt M h₀h₁/Δ \[m\] of its flux; 0 where nothing flows.
    coefficient: f64,
    /// Half the gaps on either side of the face \[m\]: the weights of their pressures in Z_f.
    weights: [f64; 2],
    /// For the nodes before and after the face: the fraction of the other node's pressure below which the flux no longer depends on the
    /// node's own pressure, because the face is choked.
    choke: [f64; 2],
}

impl CellFace {
    /// The face after node `face`.
    #[inline(always)]
    fn after(grid: &FilmGrid, flow: &[Factors], mobility: f64, face: usize, h: &[f64], dt: f64) -> Self {
        let spacing = grid.x.nodes[face + 1] - grid.x.nodes[face];
        let factor = 0.5 * (flow[face].along + flow[face + 1].along);
        let [before, behind] = [h[face], h[face + 1]];
        let choke = |own: f64, other: f64| (0.5 * (own - other) / own).max(0.0);
        Self {
            coefficient: grid.x.face(face) * factor * (dt * mobility * before * behind / spacing),
            weights: [0.5 * before, 0.5 * behind],
            choke: [choke(before, behind), choke(behind, before)],
        }
    }
}

impl FaceRow {
    fn new(columns: usize) -> Self {
        Self { flux: vec![0.0; columns], by_west: vec![0.0; columns], by_east: vec![0.0; columns] }
    }

    /// Pressure-driven flux through the faces between two rows of nodes.
    #[inline(always)]
    fn between<L: Mobility, const B: usize>(&mut self, law: L, face: CellFace, west: &[f64], east: &[f64]) {
        let b = if B == 0 { west.len() } else { B };
        let (flux, by_west, by_east) = (&mut self.flux[..b], &mut self.by_west[..b], &mut self.by_east[..b]);
        let [west_weight, east_weight] = face.weights;
        for j in 0..b {
            let least = [face.choke[0] * east[j], face.choke[1] * west[j]];
            let (west, east) = (west[j].max(least[0]), east[j].max(least[1]));
            let (psi, slope) = law.at(west_weight * west + east_weight * east);
            let drop = east - west;
            let conductance = face.coefficient * psi;
            let variation = face.coefficient * slope * drop;
            flux[j] = -conductance * drop;
            let (from_west, from_east) =
                (conductance - west_weight * variation, -conductance - east_weight * variation);
            // The pressure of a choked side follows from that of the other side.
            let (west_chokes, east_chokes) = (west == least[0], east == least[1]);
            by_west[j] =
                if west_chokes { 0.0 } else { from_west + if east_chokes { face.choke[1] * from_east } else { 0.0 } };
            by_east[j] =
                if east_chokes { 0.0 } else { from_east + if west_chokes { face.choke[0] * from_west } else { 0.0 } };
        }
    }

    /// Adds the flux that the sliding walls drag along.
    #[inline(always)]
    fn slide<const B: usize>(&mut self, drift: f64, fitting: &[f64], west: &[f64], east: &[f64]) {
        let b = if B == 0 { west.len() } else { B };
        for j in 0..b {
            self.flux[j] += drift * (west[j] + east[j]) - fitting[j] * (east[j] - west[j]);
            self.by_west[j] += drift + fitting[j];
            self.by_east[j] += drift - fitting[j];
        }
    }

    fn close(&mut self) {
        for values in [&mut self.flux, &mut self.by_west, &mut self.by_east] {
            values.fill(0.0);
        }
    }
}

impl Film {
    /// The film of `gas` on `grid`.
    pub fn new(grid: FilmGrid, gas: &Gas) -> Self {
        let unknowns = grid.unknowns();
        let columns = grid.y.unknown().len();
        let across = grid.across();
        Self {
            law: SlipLaw::of(gas),
            mobility: gas.ambient_pressure / (12.0 * gas.viscosity),
            columns,
            tolerance: NEWTON_TOLERANCE,
            closed_along: false,
            roughness: None,
            flow: vec![Factors::SMOOTH; grid.x.len()],
            pressure: vec![1.0; grid.nodes()],
            theta: vec![1.0; unknowns],
            fitting: vec![0.0; grid.nodes()],
            rhs: vec![0.0; unknowns],
            residual: vec![0.0; unknowns],
            divergence: vec![0.0; unknowns],
            jacobian: Coupling::new(unknowns),
            pivots: vec![0.0; unknowns],
            solver: RowSolver::new(unknowns / columns, columns, &across),
            faces: [FaceRow::new(columns), FaceRow::new(columns)],
            across,
            potential: vec![0.0; columns],
            outflow: vec![0.0; columns],
            grid,
        }
    }

    /// The nodes.
    pub fn grid(&self) -> &FilmGrid {
        &self.grid
    }

    /// Closes the faces along x from now on: every node along x is a strip of its own.
    pub fn close_along(&mut self) {
        self.closed_along = true;
    }

    /// Sets the roughness of the faces from now on.
    pub fn roughen(&mut self, roughness: Option<Roughness>) {
        self.roughness = roughness;
        self.flow.fill(Factors::SMOOTH);
    }

    /// Sets P at the nodes on the ambient edges, which is 1 by default: `edge[ix]`, at all y of an end and at the side of each node along
    /// x. The pressure inside is lost: the next step must start without a guess.
    pub(super) fn set_edges(&mut self, edge: &[f64]) {
        for (row, edge) in self.pressure.chunks_exact_mut(self.grid.y.len()).zip(edge) {
            row.fill(*edge);
        }
    }

    /// Accepts steps whose last Newton change is below `tolerance`, for rounds whose gap is not final yet.
    pub fn set_tolerance(&mut self, tolerance: f64) {
        self.tolerance = tolerance;
    }

    /// P = p/p_a at every node, edges included, `[ix][iy]`, after the last step.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// Adds Δt·div flux of the last step \[m\] to `sum`, at unknown nodes: that of the last Newton iterate, plus the change due to the last
    /// Newton step.
    pub fn add_outflow(&mut self, sum: &mut [f64]) {
        let (b, last) = (self.columns, sum.len());
        // After the solve `residual` holds the Newton step of P.
        let (jacobian, step) = (&self.jacobian, &self.residual);
        for (row, sum) in sum.chunks_exact_mut(b).enumerate() {
            let nodes = row * b..(row + 1) * b;
            let (moved, outflow) = (&mut self.potential[..b], &mut self.outflow[..b]);
            for (moved, k) in moved.iter_mut().zip(nodes.clone()) {
                *moved = jacobian.within[k] * step[k];
            }
            self.across.multiply::<0>(moved, outflow);
            for (j, k) in nodes.enumerate() {
                let west = if k >= b { jacobian.west[k] * step[k - b] } else { 0.0 };
                let east = if k + b < last { jacobian.east[k] * step[k + b] } else { 0.0 };
                sum[j] += self.divergence[k] + outflow[j] + jacobian.centre[k] * step[k] + west + east;
            }
        }
    }

    /// Advances `state` by `dt` \[s\] to the gap `h` \[m\] (one value for each node along x). `speed`: sliding speed U
    /// \[m/s\] at the nodes along x at the end of the step, or `None` to leave the wedge term out. `guess`: P at unknown
    /// nodes to start from.
    ///
    /// # Errors
    /// [`FilmError`] when the iteration does not settle; `state` is then unchanged.
    pub fn step(
        &mut self,
        h: &[f64],
        speed: Option<&[f64]>,
        dt: f64,
        state: &mut FilmState,
        guess: Option<&[f64]>,
    ) -> Result<Cost, FilmError> {
        if let Some(roughness) = &self.roughness {
            self.flow.iter_mut().zip(h).for_each(|(flow, h)| *flow = roughness.at(*h));
        }
        match self.law {
            SlipLaw::Affine(law) => self.step_with(law, h, speed, dt, state, guess),
            SlipLaw::SecondOrder(law) => self.step_with(law, h, speed, dt, state, guess),
            SlipLaw::FukuiKaneko(law) => self.step_with(law, h, speed, dt, state, guess),
            SlipLaw::Accommodated(law) => self.step_with(law, h, speed, dt, state, guess),
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
    ) -> Result<Cost, FilmError> {
        let mut cost = Cost { steps: 1, ..Cost::default() };
        if guess.is_none() || speed.is_some() {
            self.load_pressure(h, &state.trapped);
        }
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
                Ok(()) => cost.limited = 1,
                // Strong sliding into a narrow gap: the exponential fitting was made for another pressure, and Newton overshoots. With
                // fully upwind faces the operator is an M-function for any pressure, and damped steps find its root.
                Err(_) if !careful => {
                    careful = true;
                    cost.limited = 1;
                    if let Some(speed) = speed {
                        self.fit_upwind(h, speed, dt);
                    }
                }
                Err(error) => return Err(error),
            }
        }
        // Accept: Z = hP, W = Z + θ/2 (Z − Z_old).
        for (row, (gap, pressure)) in self.rows(h).enumerate() {
            let nodes = row * self.columns..(row + 1) * self.columns;
            let (trapped, carried) = (&mut state.trapped[nodes.clone()], &mut state.carried[nodes.clone()]);
            for (((z, w), p), theta) in trapped.iter_mut().zip(carried).zip(pressure).zip(&self.theta[nodes]) {
                let now = gap * p;
                *w = now + 0.5 * theta * (now - *z);
                *z = now;
            }
        }
        Ok(cost)
    }

    /// Gap and unknown pressures of each row of nodes.
    fn rows<'a>(&'a self, h: &'a [f64]) -> impl Iterator<Item = (f64, &'a [f64])> {
        self.grid.rows().map(move |(ix, row)| (h[ix], &self.pressure[row]))
    }

    /// P at the unknown nodes from Z and the gap; the edges keep their P.
    fn load_pressure(&mut self, h: &[f64], trapped: &[f64]) {
        for (column, (ix, row)) in trapped.chunks_exact(self.columns).zip(self.grid.rows()) {
            for (p, z) in self.pressure[row].iter_mut().zip(column) {
                *p = z / h[ix];
            }
        }
    }

    fn scatter_pressure(&mut self, unknown: &[f64]) {
        for (column, (_, row)) in unknown.chunks_exact(self.columns).zip(self.grid.rows()) {
            self.pressure[row].copy_from_slice(column);
        }
    }

    /// Rate \[1/s\] at which a small excess of gas at ambient pressure leaves a uniform gap `h` \[m\], in its slowest mode.
    pub fn slowest_leak(&self, h: f64) -> f64 {
        // A direction in which nothing leaves does not count.
        let leak = |axis: &Axis, closed: bool| {
            let ends = axis.nodes[axis.len() - 1] - axis.nodes[0];
            let length = if axis.start == Start::Mirror { 2.0 * ends } else { ends };
            if closed || length == 0.0 { 0.0 } else { length.powi(-2) }
        };
        let mode = leak(&self.grid.x, self.closed_along) + leak(&self.grid.y, false);
        let flow = self.roughness.as_ref().map_or(Factors::SMOOTH, |roughness| roughness.at(h));
        flow.along.max(flow.across) * self.mobility * h * self.law.at(h).0 * std::f64::consts::PI.powi(2) * mode
    }

    /// P at the unknown nodes.
    pub fn gather_pressure(&self, unknown: &mut [f64]) {
        for (column, (_, row)) in unknown.chunks_exact_mut(self.columns).zip(self.grid.rows()) {
            column.copy_from_slice(&self.pressure[row]);
        }
    }

    /// The diffusion of exponential fitting at x faces, from the pressure at the start of the step.
    fn fit<L: Mobility>(&mut self, law: L, h: &[f64], speed: &[f64], dt: f64) {
        let (nx, ny) = (self.grid.x.len(), self.grid.y.len());
        for face in 0..nx - 1 {
            let CellFace { coefficient, weights: [west, east], .. } =
                CellFace::after(&self.grid, &self.flow, self.mobility, face, h, dt);
            let drift = 0.25 * dt * self.dragged(face) * (west + east) * (speed[face] + speed[face + 1]);
            for j in 0..ny {
                let trapped = west * self.pressure[face * ny + j] + east * self.pressure[(face + 1) * ny + j];
                let diffusion = coefficient * law.at(trapped).0;
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
            let face_gap = 0.5 * (h[face] + h[face + 1]);
            let drift = 0.125 * dt * self.dragged(face) * face_gap * (speed[face] + speed[face + 1]);
            self.fitting[face * ny..(face + 1) * ny].fill(drift.abs());
        }
    }

    /// Factor of the wedge flux through the face after node `face`.
    #[inline(always)]
    fn dragged(&self, face: usize) -> f64 {
        0.5 * (self.flow[face].dragged + self.flow[face + 1].dragged)
    }

    /// Δt·div flux and its Jacobian, the residual of the step, and the matrix of Newton's method with the diagonal raised
    /// by `damping` times the flux's own. `B` is the number of unknown nodes across, or 0 to take it at run time.
    #[inline(always)]
    fn assemble<L: Mobility, const B: usize>(
        &mut self,
        law: L,
        h: &[f64],
        speed: Option<&[f64]>,
        dt: f64,
        damping: f64,
    ) {
        let b = if B == 0 { self.columns } else { B };
        let (ux, y0, ny) = (self.grid.x.unknown(), self.grid.y.unknown().start, self.grid.y.len());
        let first = if self.grid.x.start == Start::Mirror {
            self.faces[0].close();
            ux.start
        } else {
            ux.start - 1
        };
        for face in first..ux.end {
            // The face after node `face`; the face before it was computed in the previous iteration.
            let mut between = CellFace::after(&self.grid, &self.flow, self.mobility, face, h, dt);
            if self.closed_along {
                between.coefficient = 0.0;
            }
            let west = &self.pressure[face * ny + y0..][..b];
            let east = &self.pressure[(face + 1) * ny + y0..][..b];
            let dragged = self.dragged(face);
            let [before, after] = &mut self.faces;
            after.between::<L, B>(law, between, west, east);
            if let (Some(speed), false) = (speed, self.closed_along) {
                let gaps = between.weights[0] + between.weights[1];
                let drift = 0.125 * dt * dragged * gaps * (speed[face] + speed[face + 1]);
                after.slide::<B>(drift, &self.fitting[face * ny + y0..][..b], west, east);
            }
            if face >= ux.start {
                let (row, gap) = (face - ux.start, h[face]);
                let nodes = row * b..(row + 1) * b;
                let inverse = 1.0 / self.grid.x.lengths[face];
                let edge = if ny > 1 { self.pressure[face * ny + y0 + b] } else { west[b - 1] };
                let at_edge = law.potential(gap * edge);
                let (potential, outflow) = (&mut self.potential[..b], &mut self.outflow[..b]);
                for (potential, p) in potential.iter_mut().zip(west) {
                    *potential = law.potential(gap * p) - at_edge;
                }
                self.across.multiply::<B>(potential, outflow);
                let scale = self.flow[face].across * (dt * self.mobility * gap);
                let own = west;
                let residual = &mut self.residual[nodes.clone()];
                let flown = &mut self.divergence[nodes.clone()];
                let (rhs, theta) = (&self.rhs[nodes.clone()], &self.theta[nodes.clone()]);
                let jacobian = &mut self.jacobian;
                let centre = &mut jacobian.centre[nodes.clone()];
                let within = &mut jacobian.within[nodes.clone()];
                let to_west = &mut jacobian.west[nodes.clone()];
                let to_east = &mut jacobian.east[nodes.clone()];
                let pivots = &mut self.pivots[nodes];
                let (flux_west, west_by_west, west_by_east) =
                    (&before.flux[..b], &before.by_west[..b], &before.by_east[..b]);
                let (flux_east, east_by_west, east_by_east) =
                    (&after.flux[..b], &after.by_west[..b], &after.by_east[..b]);
                for j in 0..b {
                    let storage = (1.0 + 0.5 * theta[j]) * gap;
                    let divergence = scale * outflow[j] + (flux_east[j] - flux_west[j]) * inverse;
                    residual[j] = rhs[j] - storage * own[j] - divergence;
                    flown[j] = divergence;
                    let here = (east_by_west[j] - west_by_east[j]) * inverse;
                    centre[j] = here;
                    within[j] = scale * gap * law.at(gap * own[j]).0;
                    pivots[j] = storage + here;
                    to_west[j] = -west_by_west[j] * inverse;
                    to_east[j] = east_by_east[j] * inverse;
                }
                if damping > 0.0 {
                    for j in 0..b {
                        pivots[j] += damping * (centre[j] + within[j] * self.across.diagonal(j, b));
                    }
                }
            }
            self.faces.swap(0, 1);
        }
    }

    /// Newton's method for the step. `careful` is for the rare step on which plain Newton diverges: the fluxes' part of the matrix diagonal
    /// is increased until no pressure changes by more than a given factor, and then reduced again.
    fn newton<L: Mobility>(
        &mut self,
        law: L,
        h: &[f64],
        speed: Option<&[f64]>,
        dt: f64,
        state: &FilmState,
        careful: bool,
        cost: &mut Cost,
    ) -> Result<(), FilmError> {
        for k in 0..self.rhs.len() {
            self.rhs[k] = state.carried[k] + 0.5 * self.theta[k] * state.trapped[k];
        }
        if careful {
            // A start from an almost empty film would need more iterations than are allowed.
            self.pressure.iter_mut().for_each(|p| *p = p.max(EMPTY));
        }
        let mut damping = if careful { 1.0 } else { 0.0 };
        let limit = if careful { CAREFUL_LIMIT } else { NEWTON_LIMIT };
        for iteration in 0..limit {
            with_columns!(self.columns, B => vectorised(
                #[inline(always)]
                || self.assemble::<L, B>(law, h, speed, dt, damping)
            ));
            self.solver.solve(&self.jacobian, &self.pivots, &mut self.residual);
            cost.solves += 1;
            if careful && self.largest_change() > LARGEST_CAREFUL_CHANGE {
                damping = f64::max(4.0 * damping, 1e-3);
                continue;
            }
            let (mut settled, mut sum) = (true, 0.0);
            for (column, (_, row)) in self.residual.chunks_exact(self.columns).zip(self.grid.rows()) {
                for (p, step) in self.pressure[row].iter_mut().zip(column) {
                    settled &= step.abs() <= self.tolerance * *p;
                    sum += step;
                    // A Newton step may overshoot zero: the step is then limited, not rejected.
                    *p = (*p + step).clamp(0.1 * *p, 10.0 * *p);
                }
            }
            if settled && damping == 0.0 {
                return Ok(());
            }
            if sum.is_nan() {
                break;
            }
            // With damping lowered quickly, the iteration may keep returning to the same state: after `HASTY` iterations it is lowered
            // slowly. Once no pressure changes, damping is removed to check whether this is the solution.
            let slower = if iteration < HASTY { 0.25 } else { 0.7 };
            damping = if damping < 1e-6 || settled && damping < 1.0 { 0.0 } else { slower * damping };
        }
        let change = self.largest_change();
        if careful && damping == 0.0 && change < ROUND_OFF {
            return Ok(());
        }
        // After a failure the film holds the state that it had.
        self.load_pressure(h, &state.trapped);
        Err(FilmError { iterations: limit, change })
    }

    /// Largest relative change of a pressure in the last linear solve; infinite if one is not a number.
    fn largest_change(&self) -> f64 {
        let mut change = 0.0_f64;
        for (column, (_, row)) in self.residual.chunks_exact(self.columns).zip(self.grid.rows()) {
            for (p, step) in self.pressure[row].iter().zip(column) {
                let relative = (step / p).abs();
                change = if relative.is_nan() { f64::INFINITY } else { change.max(relative) };
            }
        }
        change
    }

    /// Lowers θ to 0 where W would fall too far. Returns whether any θ was lowered.
    fn limit(&mut self, h: &[f64], state: &FilmState) -> bool {
        let mut theta = std::mem::take(&mut self.theta);
        let mut any = false;
        for (row, (gap, pressure)) in self.rows(h).enumerate() {
            let nodes = row * self.columns..(row + 1) * self.columns;
            for ((theta, z), p) in theta[nodes.clone()].iter_mut().zip(&state.trapped[nodes]).zip(pressure) {
                let now = gap * p;
                if *theta > 0.0 && now + 0.5 * *theta * (now - z) < CARRIED_FLOOR * now {
                    *theta = 0.0;
                    any = true;
                }
            }
        }
        self.theta = theta;
        any
    }
}
