//! A whole cycle of the film under a given periodic gap, and the shortcut to its periodic state.
//!
//! Marching from rest takes the film as many cycles as the gas needs to leak out: tens at 30 kHz, thousands at high
//! squeeze numbers. After one cycle with defect d = W(T) − W(0), the slow part of the error obeys the cycle-averaged
//! film operator Ā = ⟨∂ div flux/∂Z⟩: the periodic state is about
//!
//! ```text
//! W(0) + d + s,     (T Ā) s = d
//! ```
//!
//! for modes that leak slowly ((I − monodromy) ≈ T Ā), and W(0) + d = W(T) for modes that decay within a cycle (s ≈ 0). One linear solve
//! makes the number of cycles independent of the squeeze number. The caller removes the remaining error by Anderson acceleration.

use super::grid::FilmGrid;
use super::stepper::{Cost, Film, FilmError, FilmState};
use crate::control::Cancel;
use crate::numerics::rows::RowSolver;
use crate::numerics::system::Coupling;

/// Why a cycle ended early.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Interrupted {
    /// The caller cancelled.
    #[error("cancelled")]
    Cancelled,
    /// A step failed.
    #[error("step {step}: {source}")]
    Failed {
        /// Which step of the cycle.
        step: usize,
        /// Why.
        source: FilmError,
    },
}

/// Film of one tooth over a cycle of `steps` equal time steps.
#[derive(Clone, Debug)]
pub struct FilmCycle {
    film: Film,
    steps: usize,
    /// P at unknown nodes, `[step][unknown]`. Step m is at t = mT/steps; step 0 is also the end of the cycle.
    pressure: Vec<f64>,
    marched: bool,
    before: Vec<f64>,
    leak: Coupling,
    solver: RowSolver,
    shift: Vec<f64>,
    /// Whether the defect is computed from the outflow ([`Self::count_outflow`]).
    stiff: bool,
    outflow: Vec<f64>,
}

impl FilmCycle {
    /// A cycle of `film` in `steps` time steps.
    pub fn new(film: Film, steps: usize) -> Self {
        let grid = film.grid();
        let (unknowns, columns) = (grid.unknowns(), grid.y.unknown().len());
        let solver = RowSolver::new(unknowns / columns, columns, &grid.across());
        Self {
            film,
            steps,
            pressure: vec![1.0; steps * unknowns],
            marched: false,
            before: vec![0.0; unknowns],
            leak: Coupling::new(unknowns),
            solver,
            shift: vec![0.0; unknowns],
            stiff: false,
            outflow: vec![0.0; unknowns],
        }
    }

    /// Computes the defect of a cycle from the outflow of the nodes, which is the same except for round-off. In a film that needs many
    /// cycles to leak, the round-off of W is multiplied by that number of cycles, whereas the round-off of a small outflow is as small as
    /// the outflow.
    pub fn count_outflow(&mut self) {
        self.stiff = true;
    }

    /// The nodes.
    pub fn grid(&self) -> &FilmGrid {
        self.film.grid()
    }

    /// Accepts steps whose last Newton change is below `tolerance` ([`Film::set_tolerance`]).
    pub fn set_tolerance(&mut self, tolerance: f64) {
        self.film.set_tolerance(tolerance);
    }

    /// Fraction of a small excess of gas over ambient pressure, in a uniform gap `h` \[m\], that remains in the slowest mode after one
    /// implicit step of `dt` \[s\].
    pub fn stays(&self, h: f64, dt: f64) -> f64 {
        1.0 / (1.0 + dt * self.film.slowest_leak(h))
    }

    /// Unknown P of step `m`.
    pub fn pressure(&self, m: usize) -> &[f64] {
        let unknowns = self.before.len();
        &self.pressure[m * unknowns..(m + 1) * unknowns]
    }

    /// The buffer for the first guess of step `m`'s unknown P; all steps need one before the first march.
    pub fn guess_mut(&mut self, m: usize) -> &mut [f64] {
        let unknowns = self.before.len();
        self.marched = true;
        &mut self.pressure[m * unknowns..(m + 1) * unknowns]
    }

    /// Marches one cycle from `state` through the gaps `h[step][ix]` \[m\], with sliding speeds `speed[step][ix]` \[m/s\]
    /// (or without the wedge term), by steps of `dt(step)` \[s\]. Writes the trapped height integrated across the width,
    /// `line[step][ix]` \[m²\].
    ///
    /// Steps of varying length are uniform steps Δs of a parameter s with time t(s): dZ/ds = dZ/dt × dt/ds is of second order in s, with
    /// dt(step) = Δs dt/ds at the end of the step.
    ///
    /// # Errors
    /// When cancelled, or when a step fails.
    pub fn march(
        &mut self,
        h: &[f64],
        speed: Option<&[f64]>,
        dt: impl Fn(usize) -> f64,
        state: &mut FilmState,
        line: &mut [f64],
        cancel: &Cancel,
    ) -> Result<Cost, Interrupted> {
        let nx = self.grid().x.len();
        let mut cost = Cost::default();
        self.before.copy_from_slice(&state.carried);
        self.leak.clear();
        self.outflow.fill(0.0);
        for step in 1..=self.steps {
            if cancel.is_cancelled() {
                return Err(Interrupted::Cancelled);
            }
            let m = step % self.steps;
            let here = m * nx..(m + 1) * nx;
            let gap = &h[here.clone()];
            let slide = speed.map(|u| &u[here.clone()]);
            cost += self
                .advance(m, gap, slide, dt(m), state, &mut line[here])
                .map_err(|source| Interrupted::Failed { step, source })?;
            self.accumulate_leak(gap);
            if self.stiff {
                self.film.add_outflow(&mut self.outflow);
            }
        }
        self.marched = true;
        Ok(cost)
    }

    /// One step, to step `m` of the cycle: advances `state` to the gap `h[ix]` \[m\], with sliding speeds `speed[ix]` \[m/s\], and writes
    /// the trapped height integrated across the width to `line[ix]` \[m²\].
    ///
    /// # Errors
    /// When the step fails; `state` is then unchanged.
    pub fn advance(
        &mut self,
        m: usize,
        h: &[f64],
        speed: Option<&[f64]>,
        dt: f64,
        state: &mut FilmState,
        line: &mut [f64],
    ) -> Result<Cost, FilmError> {
        let unknowns = self.before.len();
        // The pressure of the last cycle is the guess: as cycles converge, a step needs only one linear solve.
        let guess = self.marched.then(|| &self.pressure[m * unknowns..(m + 1) * unknowns]);
        let taken = self.film.step(h, speed, dt, state, guess)?;
        self.film.gather_pressure(&mut self.pressure[m * unknowns..(m + 1) * unknowns]);
        self.film.grid().line_integral(&state.trapped, line);
        Ok(taken)
    }

    /// Sets whether the stored pressures of all steps are used as first guesses in the next cycle.
    pub fn remember(&mut self, marched: bool) {
        self.marched = marched;
    }

    /// Adds this step's ∂(Δt div flux)/∂Z to T Ā.
    fn accumulate_leak(&mut self, h: &[f64]) {
        let columns = self.grid().y.unknown().len();
        let x = self.grid().x.unknown();
        let jacobian = &self.film.jacobian;
        let leak = &mut self.leak;
        let add = |sum: &mut [f64], terms: &[f64], factor: f64| {
            for (sum, term) in sum.iter_mut().zip(terms) {
                *sum += term * factor;
            }
        };
        // Beyond the first and the last row there is no unknown: entries there are not read.
        let (mut west, mut here) = (0.0, 1.0 / h[x.start]);
        for (row, ix) in x.enumerate() {
            let east = 1.0 / h[ix + 1];
            let nodes = row * columns..(row + 1) * columns;
            add(&mut leak.centre[nodes.clone()], &jacobian.centre[nodes.clone()], here);
            add(&mut leak.within[nodes.clone()], &jacobian.within[nodes.clone()], here);
            add(&mut leak.west[nodes.clone()], &jacobian.west[nodes.clone()], west);
            add(&mut leak.east[nodes.clone()], &jacobian.east[nodes], east);
            (west, here) = (here, east);
        }
    }

    /// Moves `state`, as the last cycle left it, by the slow shift s of that cycle, (T Ā) s = W(T) − W(0), and returns s
    /// \[m\] at unknown nodes. No node changes by more than a factor of 3.
    pub fn shift(&mut self, state: &mut FilmState) -> &[f64] {
        for k in 0..self.shift.len() {
            self.shift[k] = if self.stiff { -self.outflow[k] } else { state.carried[k] - self.before[k] };
        }
        let defect = self.shift.clone();
        self.solver.solve(&self.leak, &self.leak.centre, &mut self.shift);
        // A negative leak is not a leak: it comes from a wedge that pumps gas from node to node within a cycle. For a node that only fills,
        // no leak rate is known.
        let leaks = crate::numerics::dot(&defect, &self.shift);
        if !(0.0..f64::INFINITY).contains(&leaks) {
            self.shift.fill(0.0);
        }
        for k in 0..self.shift.len() {
            state.trapped[k] = shifted(state.trapped[k], self.shift[k]);
            state.carried[k] = shifted(state.carried[k], self.shift[k]);
        }
        &self.shift
    }

    /// Pressure \[the unit of `ambient`\] of all steps at every node, edges included, `[step][ix][iy]`.
    pub fn full_pressure(&self, ambient: f64) -> Vec<f64> {
        let grid = self.film.grid();
        let (nx, ny, columns) = (grid.x.len(), grid.y.len(), grid.y.unknown().len());
        let mut full = vec![ambient; self.steps * nx * ny];
        for (m, map) in full.chunks_exact_mut(nx * ny).enumerate() {
            for (column, (_, row)) in self.pressure(m).chunks_exact(columns).zip(grid.rows()) {
                map[row].iter_mut().zip(column).for_each(|(to, p)| *to = p * ambient);
            }
        }
        full
    }
}

/// `value` + `by`, kept within a factor of 3 of `value`.
pub fn shifted(value: f64, by: f64) -> f64 {
    const LARGEST: f64 = 3.0;
    value * (1.0 + by / value).clamp(1.0 / LARGEST, LARGEST)
}
