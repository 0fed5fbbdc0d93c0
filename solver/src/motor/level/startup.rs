//! The transient from rest, instant after instant, with every tooth and without acceleration from cycle to cycle. It converges to the
//! periodic state slowly, but also where the rounds over all instants at once do not converge.
//!
//! At each instant film and contact have to agree: the contact problem needs the trapped gas ζ, and the film's step needs the gap. The
//! fixed point of the two is found by Anderson acceleration of ln ζ, starting from ζ extrapolated from the last two instants. It satisfies
//! the same discrete equations as a step of the periodic state, so the transient ends in that state, to round-off.

use super::{CONTACT_SHARE, MotorLevel, step_tolerance};
use crate::contact::{Instant, Shape};
use crate::control::{Cancel, Reporter};
use crate::estimate::left;
use crate::film::stepper::FilmState;
use crate::motor::ending::{MotorError, Stop, unless_cancelled};
use crate::numerics::anderson::Anderson;
use crate::plan::Plan;
use crate::solution::{Stats, Status};

const DEPTH: usize = 6;
const LONGEST_STEP: f64 = 1.0;
/// Most rounds of a step, until gas and load balance have settled. A step that needs more is accepted as it is, and counted.
const ROUND_LIMIT: usize = 60;

/// Most cycles until a state repeats.
const CYCLE_LIMIT: usize = 250;
/// The march is given up after so many cycles in a row whose steps leave the load more unbalanced than is allowed: such a march does not
/// settle later, and each of its cycles takes the most rounds.
const UNBALANCED_LIMIT: usize = 10;
/// Tolerance of the steps, as a fraction of the plan's tolerance.
const SETTLED_SHARE: f64 = 0.01;
/// Where three cycles change the film's load hardly less than the three before, the remaining change is taken to be this many times theirs.
const CREEP: f64 = 10.0;

impl MotorLevel {
    /// Sets the state of rest: the wave stands still, pressed against the rotor without a film, and the gas is at ambient pressure.
    ///
    /// # Errors
    /// [`MotorError::Contact`] if the dry contact problem has no solution to working precision.
    pub(in crate::motor) fn rest(&mut self) -> Result<(), MotorError> {
        unless_cancelled(self.dry(1, &Cancel::new()))?;
        self.shapes.fill(Shape::default());
        let (nx, columns) = (self.nx, self.grid().y.unknown().len());
        for tooth in 0..self.teeth {
            let to = tooth * self.steps * nx;
            let gap = &self.film_thickness[to..to + nx];
            let trapped: Vec<f64> =
                self.grid().x.unknown().flat_map(|ix| std::iter::repeat_n(gap[ix], columns)).collect();
            let line = &mut self.line[to..to + nx];
            self.films[tooth].grid().line_integral(&trapped, line);
            self.trapped[to..to + nx].copy_from_slice(line);
            self.states[tooth] = FilmState::at_rest(trapped);
            self.films[tooth].remember(false);
        }
        Ok(())
    }

    /// Marches one cycle from the present instant, t = 0 of the cycle, with each step solved to `tolerance` in ln ζ. `record` receives the
    /// cycle, whose first frame is the present state. Returns the largest change of ln Z over the cycle. The level's residual is then the
    /// largest residual of a step.
    pub(in crate::motor) fn transient_cycle(
        &mut self,
        tolerance: f64,
        stats: &mut Stats,
        cancel: &Cancel,
        record: &mut dyn FnMut(&Self),
    ) -> Result<f64, Stop> {
        let exact = step_tolerance(tolerance / self.stiffness);
        self.films.iter_mut().for_each(|film| film.set_tolerance(exact));
        self.contact.set_tolerance(CONTACT_SHARE * tolerance);
        let before: Vec<FilmState> = self.states.clone();
        let mut worst = 0.0_f64;
        for step in 1..self.steps {
            if cancel.is_cancelled() {
                return Err(Stop::Cancelled);
            }
            self.transient_step(step, tolerance, stats)?;
            worst = worst.max(self.residual);
        }
        record(self);
        self.transient_step(0, tolerance, stats)?;
        self.residual = worst.max(self.residual);
        self.films.iter_mut().for_each(|film| film.remember(true));
        Ok(self.states.iter().zip(&before).map(|(now, then)| now.change_since(then)).fold(0.0, f64::max))
    }

    /// As [`Self::rest`], from the state on another grid.
    pub(in crate::motor) fn march_on_from(&mut self, coarse: &Self) {
        self.start_from(coarse);
        self.line.copy_from_slice(&self.trapped);
        self.films.iter_mut().for_each(|film| film.remember(true));
    }

    /// Marches cycle after cycle until α repeats as exactly as `plan` asks.
    pub(in crate::motor) fn settle(
        &mut self,
        plan: &Plan,
        stats: &mut Stats,
        report: &mut Reporter<'_>,
        cancel: &Cancel,
    ) -> Result<Status, Stop> {
        let (mut loads, mut unbalanced) = (Vec::new(), 0);
        for cycle in 1..=CYCLE_LIMIT {
            let change = self.transient_cycle(SETTLED_SHARE * plan.tolerance, stats, cancel, &mut |_| ())?;
            stats.cycles += 1;
            loads.push(self.mean_film_load());
            report.round(cycle, change, self.mean_film_load());
            let [.., first, _, _, middle, _, _, last] = loads[..] else { continue };
            let (before, after) = ((middle - first).abs(), (last - middle).abs());
            self.drift = left(before, after, 0.7, CREEP);
            let allowed = self.allowed(plan);
            if self.astray() <= allowed {
                return Ok(Status::Converged);
            }
            unbalanced = if self.unbalanced() > allowed { unbalanced + 1 } else { 0 };
            if unbalanced == UNBALANCED_LIMIT {
                break;
            }
        }
        Ok(Status::NotConverged { residual: self.astray(), tolerance: self.allowed(plan) })
    }

    /// One step, to instant `m` of the cycle.
    fn transient_step(&mut self, m: usize, tolerance: f64, stats: &mut Stats) -> Result<(), Stop> {
        let (teeth, nx, steps, nodes) = (self.teeth, self.nx, self.steps, self.contact.nodes());
        let line = |tooth: usize, m: usize| (tooth * steps + m) * nx;
        let (last, earlier) = ((m + steps - 1) % steps, (m + steps - 2) % steps);
        // Trapped gas changes slowly and steadily.
        let mut present = vec![0.0; nodes];
        for tooth in 0..teeth {
            for ix in 0..nx {
                let now = self.line[line(tooth, last) + ix];
                let then = self.line[line(tooth, earlier) + ix];
                present[tooth * nx + ix] = if then > 0.0 { now * (now / then).clamp(0.5, 2.0) } else { now };
            }
        }
        if self.shapes[m] == Shape::default() {
            self.shapes[m] = self.shapes[last].clone();
        }
        let inside: Vec<usize> = (0..nodes).filter(|i| self.grid().x.unknown().contains(&(i % nx))).collect();
        let before = self.states.clone();
        let mut anderson = Anderson::new(DEPTH, LONGEST_STEP);
        let mut fields = Instant::default();
        let mut x: Vec<f64> = inside.iter().map(|i| present[*i].ln()).collect();
        let mut image = vec![0.0; x.len()];
        for _ in 0..ROUND_LIMIT {
            for (i, x) in inside.iter().zip(&x) {
                present[*i] = x.exp();
            }
            self.meet(m, &present, &mut fields, stats)?;
            stats.coupling_iterations += 1;
            for tooth in 0..teeth {
                let here = line(tooth, m)..line(tooth, m) + nx;
                let gap = &fields.film_thickness[tooth * nx..(tooth + 1) * nx];
                self.states[tooth].clone_from(&before[tooth]);
                let speed = self.speed.as_ref().map(|u| &u[here.clone()]);
                *stats += self.films[tooth]
                    .advance(m, gap, speed, self.dt, &mut self.states[tooth], &mut self.line[here])
                    .map_err(|source| MotorError::Film { step: m, source })?;
            }
            for (i, image) in inside.iter().zip(&mut image) {
                *image = self.line[line(i / nx, m) + i % nx].ln();
            }
            let change = image.iter().zip(&x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            self.residual = change.max(self.imbalance_at(m).abs());
            if self.residual < tolerance {
                break;
            }
            anderson.advance(&mut x, &image);
        }
        stats.unsettled_steps += u64::from(self.residual >= tolerance);
        for tooth in 0..teeth {
            let here = line(tooth, m)..line(tooth, m) + nx;
            self.trapped[here].copy_from_slice(&present[tooth * nx..(tooth + 1) * nx]);
        }
        Ok(())
    }
}
