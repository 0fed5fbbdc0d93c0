//! The coupled problem on one grid.

mod finer;
mod recorded;
mod startup;

use super::ending::{MotorError, Stop, unit};
use crate::contact::{Contact, Instant, Modes, Shape};
use crate::control::{Cancel, Reporter};
use crate::estimate::{Mean, left};
use crate::film::cycle::{FilmCycle, shifted};
use crate::film::exact::trapped_height;
use crate::film::grid::{Axis, FilmGrid, Start};
use crate::film::stepper::{Film, FilmState, NEWTON_TOLERANCE};
use crate::film::trapped::TrappedFilm;
use crate::ladder::GridState;
use crate::numerics::anderson::Anderson;
use crate::plan::{Grid, Plan};
use crate::problem::{Flow, Motor};
use crate::solution::{Stats, Status};

/// Earlier rounds that the acceleration remembers.
const DEPTH: usize = 16;
/// Longest step of the acceleration in ln ζ.
const LONGEST_STEP: f64 = 1.5;

/// Allowed imbalance of the contact problems, as a fraction of the residual of the round before.
const CONTACT_SHARE: f64 = 1e-3;

/// Fraction of the error asked for that is allowed because the cycle does not repeat exactly, and the round-off of the load.
const REPEATING_SHARE: f64 = 0.3;
const LEAST_CHANGE: f64 = 1e-9;
/// The remaining change is at least this fraction of the last change.
const LEAST_TO_COME: f64 = 0.125;

/// The periodic state on one grid. Lines are `[tooth][step][ix]` over the stored teeth.
#[derive(Debug)]
pub(super) struct MotorLevel {
    teeth: usize,
    stored: usize,
    steps: usize,
    nx: usize,
    /// Vibration period over steps \[s\].
    dt: f64,
    ambient_pressure: f64,
    interior_width: f64,
    load: f64,
    contact: Contact,
    films: Vec<FilmCycle>,
    /// The film in the limit of trapped gas, which then replaces marching.
    trapped_film: Option<TrappedFilm>,
    states: Vec<FilmState>,
    shapes: Vec<Shape>,
    /// W_S, `[instant][tooth][ix]`.
    stator: Vec<f64>,
    /// U, lines, if the wedge term is modelled.
    speed: Option<Vec<f64>>,
    /// ζ, lines, as used by the contact problems.
    trapped: Vec<f64>,
    /// h, lines.
    film_thickness: Vec<f64>,
    /// c, lines.
    contact_load: Vec<f64>,
    /// Ambient pressure times the area of all teeth over the load, at least 1: the factor from an error of the gas to one of the load
    /// balance.
    stiffness: f64,
    /// Estimated remaining change of ln ζ, from the last two rounds, or the last imbalance if that is larger; before the first round, how far
    /// off its start is taken to be. For a transient, the largest residual of a step of the last cycle.
    pub(super) residual: f64,
    /// Change of the film's load due to the change of the gas in the last round \[N\].
    drift: f64,
    /// ζ from the film's last cycle, lines.
    line: Vec<f64>,
    /// `line` moved by the slow shift: ζ of the next round.
    next: Vec<f64>,
    /// If gas leaves within a step: the gap for which each node's film force is known, lines ([`MotorLevel::soften`]).
    reference: Option<Vec<f64>>,
    /// Width on which the film acts at the nodes of a tooth \[m\].
    widths: Vec<f64>,
}

impl MotorLevel {
    pub(super) fn new(motor: &Motor, plan: &Plan, grid: &Grid) -> Self {
        let x = Axis::clustered(0.5 * motor.tooth_width, Start::Ambient, grid.along, plan.clustering_along);
        let (half, beta) = (0.5 * motor.contact_width, plan.clustering_across);
        let (start, intervals) =
            if plan.half_width { (Start::Mirror, grid.across) } else { (Start::Ambient, 2 * grid.across) };
        let y = match plan.flow {
            Flow::Along => Axis::single(motor.contact_width),
            _ if plan.spectral => Axis::spectral(half, start, grid.across, beta),
            _ => Axis::clustered(half, start, intervals, beta),
        };
        let film_grid = FilmGrid { x, y };
        let (nx, steps, teeth) = (film_grid.x.len(), grid.steps, motor.teeth);
        let stored = if plan.every_tooth { teeth } else { 1 };
        let instants = if plan.every_tooth { steps } else { steps / teeth };

        let (nodes, interior_width) = (&film_grid.x.nodes, film_grid.interior_width());
        let place = |i: usize| (i / nx) as f64 * motor.pitch() + nodes[i % nx];
        let positions: Vec<f64> = (0..teeth * nx).map(place).collect();
        let mut widths = vec![0.0; nx];
        widths[film_grid.x.unknown()].fill(interior_width);
        let stator = (0..instants * teeth * nx)
            .map(|k| {
                let (s, i) = (k / (teeth * nx), k % (teeth * nx));
                motor.stator_displacement(positions[i], nodes[i % nx], s as f64 / steps as f64)
            })
            .collect();
        let speed = plan.shear.then(|| {
            (0..stored * steps * nx)
                .map(|i| {
                    let (tooth, step, ix) = (i / (steps * nx), i / nx % steps, i % nx);
                    motor.sliding_speed(positions[tooth * nx + ix], step as f64 / steps as f64)
                })
                .collect()
        });
        let harmonics = plan.harmonics(grid);
        let modes = Modes::new(&plan.rotor, harmonics, grid.harmonic_fraction, &positions);
        let gas = &motor.gas;
        let (lengths, film_widths) = (film_grid.x.lengths.repeat(teeth), widths.repeat(teeth));
        let contact = Contact::new(modes, lengths, &film_widths, gas.ambient_pressure, motor.min_spacing, motor.load)
            .on(motor.surface.asperities, motor.contact_width);
        let unknowns = film_grid.unknowns();
        let mut film = Film::new(film_grid, gas);
        if plan.flow == Flow::Across {
            film.close_along();
        }
        let trapped_film = plan.trapped.then(|| TrappedFilm::new(film.clone()));
        film.roughen(motor.surface.flow);
        let film = FilmCycle::new(film, steps);
        Self {
            teeth,
            stored,
            steps,
            nx,
            dt: motor.period() / steps as f64,
            ambient_pressure: gas.ambient_pressure,
            interior_width,
            load: motor.load,
            contact,
            films: vec![film; stored],
            trapped_film,
            states: vec![FilmState::at_rest(vec![motor.min_spacing; unknowns]); stored],
            shapes: vec![Shape::default(); instants],
            stator,
            speed,
            trapped: vec![0.0; stored * steps * nx],
            film_thickness: vec![motor.min_spacing; stored * steps * nx],
            contact_load: vec![0.0; stored * steps * nx],
            stiffness: (gas.ambient_pressure * motor.contact_width * motor.tooth_width * teeth as f64 / motor.load)
                .max(1.0),
            residual: f64::INFINITY,
            drift: f64::INFINITY,
            line: vec![0.0; stored * steps * nx],
            next: vec![0.0; stored * steps * nx],
            reference: None,
            widths,
        }
    }

    fn grid(&self) -> &FilmGrid {
        self.films[0].grid()
    }

    /// Whether no tooth touches at any instant.
    pub(super) fn floats(&self) -> bool {
        self.contact_load.iter().all(|load| *load == 0.0)
    }

    /// Least contact load at any node and instant, over the mean; 0 if any node does not touch at some instant.
    pub(super) fn least_contact(&self) -> f64 {
        let mean = self.contact_load.iter().sum::<f64>() / self.contact_load.len() as f64;
        self.contact_load.iter().copied().fold(mean, f64::min) / mean.max(f64::MIN_POSITIVE)
    }

    pub(super) fn instants(&self) -> usize {
        self.shapes.len()
    }

    /// Offset of the line of `tooth` at instant `s` in line arrays.
    fn line_of(&self, tooth: usize, s: usize) -> usize {
        let (tooth, step) = if self.stored == self.teeth && self.instants() == self.steps {
            (tooth, s)
        } else {
            (0, (s + tooth * self.instants()) % self.steps)
        };
        (tooth * self.steps + step) * self.nx
    }

    /// Sets the initial state: the wave under a rigid rotor that just touches its crest, with gas trapped as at high frequency.
    pub(super) fn start(&mut self, motor: &Motor) {
        let slip = 6.0 * motor.gas.mean_free_path;
        for s in 0..self.instants() {
            for tooth in 0..self.teeth {
                let to = self.line_of(tooth, s);
                for ix in 0..self.nx {
                    let stator = self.stator[(s * self.teeth + tooth) * self.nx + ix];
                    self.film_thickness[to + ix] = motor.min_spacing + (motor.normal_amplitude - stator).max(0.0);
                }
            }
        }
        for tooth in 0..self.stored {
            let x = self.grid().x.unknown();
            let columns = self.grid().y.unknown().len();
            for (row, ix) in x.enumerate() {
                let (mut gap, mut invariant) = (0.0, 0.0);
                for step in 0..self.steps {
                    let h = self.film_thickness[(tooth * self.steps + step) * self.nx + ix];
                    gap += h;
                    invariant += h * h * (0.5 * h + slip);
                }
                let trapped = trapped_height(invariant / self.steps as f64, gap / self.steps as f64, slip);
                self.states[tooth].trapped[row * columns..(row + 1) * columns].fill(trapped);
            }
            self.states[tooth].carried = self.states[tooth].trapped.clone();
        }
    }

    /// From now on only the gas that cannot leave within a step acts as a spring in the contact problem; the force of the rest is that of
    /// the last round. Where nearly all gas leaves, treating all of it as a spring would let the rotor sink by only a small fraction of the
    /// gap in each round.
    pub(super) fn soften(&mut self) {
        self.reference = Some(self.film_thickness.clone());
    }

    pub(super) fn is_soft(&self) -> bool {
        self.reference.is_some()
    }

    /// Whether a solve of `motor` by `plan` may start from this state.
    pub(super) fn serves(&self, motor: &Motor, plan: &Plan) -> bool {
        self.teeth == motor.teeth
            && self.stored == if plan.every_tooth { motor.teeth } else { 1 }
            && self.trapped_film.is_some() == plan.trapped
    }

    /// Solves the contact problems of all instants with the present ζ.
    fn solve_contacts(&mut self, stats: &mut Stats, cancel: &Cancel) -> Result<(), Stop> {
        let nodes = self.contact.nodes();
        let (teeth, nx) = (self.teeth, self.nx);
        let mut gathered = vec![0.0; nodes];
        let mut fields = Instant::default();
        for s in 0..self.instants() {
            if cancel.is_cancelled() {
                return Err(Stop::Cancelled);
            }
            for tooth in 0..teeth {
                let from = self.line_of(tooth, s);
                gathered[tooth * nx..(tooth + 1) * nx].copy_from_slice(&self.trapped[from..from + nx]);
                if let Some(reference) = &self.reference {
                    let heights = &reference[from..from + nx];
                    let places = gathered[tooth * nx..].iter_mut().zip(&mut self.contact.ambient_mut()[tooth * nx..]);
                    for (((gas, back), h), width) in places.zip(heights).zip(&self.widths) {
                        // The film must not carry load once the rotor has lifted off: the subtracted force must not become negative.
                        let stays = self.films[0].stays(*h, self.dt).max(1.0 - width * h / *gas);
                        *back = self.ambient_pressure * (width - (1.0 - stays) * *gas / h);
                        *gas *= stays;
                    }
                }
            }
            self.meet(s, &gathered, &mut fields, stats)?;
        }
        Ok(())
    }

    /// Solves the contact problem of instant `s` with the gas ζ at the nodes, and stores the result.
    fn meet(&mut self, s: usize, gas: &[f64], fields: &mut Instant, stats: &mut Stats) -> Result<(), Stop> {
        let stator = &self.stator[s * gas.len()..(s + 1) * gas.len()];
        let solved = self.contact.solve(stator, gas, &mut self.shapes[s], fields);
        stats.contact_iterations += u64::from(solved.map_err(|source| MotorError::Contact { instant: s, source })?);
        stats.contact_solves += 1;
        self.keep(s, fields);
        Ok(())
    }

    /// Stores the result of the contact problem of instant `s`.
    fn keep(&mut self, s: usize, fields: &Instant) {
        let nx = self.nx;
        for tooth in 0..self.teeth {
            let to = self.line_of(tooth, s);
            self.film_thickness[to..to + nx].copy_from_slice(&fields.film_thickness[tooth * nx..(tooth + 1) * nx]);
            self.contact_load[to..to + nx].copy_from_slice(&fields.contact[tooth * nx..(tooth + 1) * nx]);
        }
    }

    /// Solves the contact problems of the first `count` instants, one after the other, as if there were no gas.
    pub(super) fn dry(&mut self, count: usize, cancel: &Cancel) -> Result<(), Stop> {
        let (mut contact, nodes) = (self.contact.dry(), self.contact.nodes());
        let (nothing, mut shape, mut fields) = (vec![0.0; nodes], Shape::default(), Instant::default());
        for s in 0..count {
            if cancel.is_cancelled() {
                return Err(Stop::Cancelled);
            }
            contact
                .solve(&self.stator[s * nodes..(s + 1) * nodes], &nothing, &mut shape, &mut fields)
                .map_err(|source| MotorError::Contact { instant: s, source })?;
            self.keep(s, &fields);
        }
        Ok(())
    }

    /// Computes the trapped gas of every stored tooth under the present h: `line`, pressures and states.
    fn trap(&mut self, stats: &mut Stats) -> Result<(), Stop> {
        let Some(trapped_film) = &mut self.trapped_film else { return Ok(()) };
        let (nx, size) = (self.nx, self.steps * self.nx);
        let lines = self.film_thickness.chunks_exact(size).zip(self.line.chunks_exact_mut(size));
        for ((gaps, lines), (film, state)) in lines.zip(self.films.iter_mut().zip(&mut self.states)) {
            let trapped = trapped_film.solve(gaps).map_err(|source| MotorError::Film { step: 0, source })?;
            stats.film_solves += 1;
            state.trapped.copy_from_slice(trapped);
            state.carried.copy_from_slice(trapped);
            let (columns, rows) = (film.grid().y.unknown().len(), film.grid().x.unknown());
            for (step, (line, gap)) in lines.chunks_exact_mut(nx).zip(gaps.chunks_exact(nx)).enumerate() {
                film.grid().line_integral(trapped, line);
                let pressure = film.guess_mut(step);
                for (k, (p, z)) in pressure.iter_mut().zip(trapped).enumerate() {
                    *p = z / gap[rows.start + k / columns];
                }
            }
        }
        Ok(())
    }

    /// Marches one cycle of every stored tooth through the present h; updates `line` and the states.
    fn march(&mut self, stats: &mut Stats, cancel: &Cancel) -> Result<(), Stop> {
        if self.trapped_film.is_some() {
            return self.trap(stats);
        }
        let (size, dt) = (self.steps * self.nx, self.dt);
        for tooth in 0..self.stored {
            let range = tooth * size..(tooth + 1) * size;
            *stats += self.films[tooth].march(
                &self.film_thickness[range.clone()],
                self.speed.as_ref().map(|u| &u[range.clone()]),
                |_| dt,
                &mut self.states[tooth],
                &mut self.line[range],
                cancel,
            )?;
        }
        stats.cycles += 1;
        Ok(())
    }

    /// The vector that the acceleration works on: ln of (ζ, Z(0), W(0)) at unknown nodes of all stored teeth, and of the reference gap if
    /// there is one.
    fn pack(&self, lines: &[f64], heights: &[f64], out: &mut Vec<f64>) {
        out.clear();
        let ux = self.grid().x.unknown();
        for line in lines.chunks_exact(self.nx) {
            out.extend(line[ux.clone()].iter().map(|v| v.ln()));
        }
        if self.reference.is_some() {
            out.extend(heights.iter().map(|h| h.ln()));
        }
        for state in &self.states {
            out.extend(state.logarithms());
        }
    }

    fn unpack(&mut self, packed: &[f64]) {
        let ux = self.grid().x.unknown();
        let (lines, states) = packed.split_at(self.trapped.len() / self.nx * ux.len());
        for (line, values) in self.trapped.chunks_exact_mut(self.nx).zip(lines.chunks_exact(ux.len())) {
            for (target, value) in line[ux.clone()].iter_mut().zip(values) {
                *target = value.exp();
            }
        }
        let (heights, states) = states.split_at(self.reference.as_ref().map_or(0, Vec::len));
        for (reference, value) in self.reference.iter_mut().flatten().zip(heights) {
            *reference = value.exp();
        }
        let unknowns = self.states[0].trapped.len();
        for (state, values) in self.states.iter_mut().zip(states.chunks_exact(2 * unknowns)) {
            state.set_logarithms(values);
        }
    }

    /// Moves the states, and the film's lines into `next`, by the slow shift of the last cycle.
    fn shift(&mut self) {
        self.next.copy_from_slice(&self.line);
        if self.trapped_film.is_some() {
            return;
        }
        let (nx, steps) = (self.nx, self.steps);
        let mut across = vec![0.0; nx];
        for (tooth, film) in self.films.iter_mut().enumerate() {
            let shift = film.shift(&mut self.states[tooth]).to_vec();
            film.grid().line_integral(&shift, &mut across);
            for line in self.next[tooth * steps * nx..(tooth + 1) * steps * nx].chunks_exact_mut(nx) {
                for ix in 1..nx - 1 {
                    line[ix] = shifted(line[ix], across[ix]);
                }
            }
        }
    }

    /// Iterates until the trapped gas repeats to the plan's tolerance.
    pub(super) fn converge(
        &mut self,
        plan: &Plan,
        rounds: usize,
        stats: &mut Stats,
        report: &mut Reporter<'_>,
        cancel: &Cancel,
    ) -> Result<Status, Stop> {
        if self.trapped.iter().all(|&t| t == 0.0) {
            self.march(stats, cancel)?;
            self.shift();
            self.trapped.copy_from_slice(&self.next);
        }
        let mut anderson = Anderson::new(if self.reference.is_some() { DEPTH / 2 } else { DEPTH }, LONGEST_STEP);
        let (mut present, mut image) = (Vec::new(), Vec::new());
        let (mut residual, mut last_residual, mut last_change) = (self.residual, 0.0, 0.0);
        self.pack(&self.trapped, self.reference.as_deref().unwrap_or(&[]), &mut present);
        for round in 1..=rounds {
            let exact = step_tolerance(residual / self.stiffness);
            self.films.iter_mut().for_each(|film| film.set_tolerance(exact));
            self.contact.set_tolerance(CONTACT_SHARE * residual.min(1.0));
            self.solve_contacts(stats, cancel)?;
            self.march(stats, cancel)?;
            stats.coupling_iterations += 1;
            let imbalance = self.imbalance();
            self.shift();
            self.pack(&self.next, &self.film_thickness, &mut image);
            let change = image.iter().zip(&present).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let to_come = left(std::mem::replace(&mut last_residual, change), change, 0.5, 1.0);
            residual = to_come.max(LEAST_TO_COME * change).max(imbalance);
            self.residual = residual;
            let change = self.force_of_change(&self.trapped, &self.next);
            self.drift = left(std::mem::replace(&mut last_change, change), change, 0.5, 1.0);
            // The force is evaluated with the gas before the slow shift.
            self.drift += self.force_of_change(&self.line, &self.next);
            report.round(round, residual, self.mean_film_load());
            if residual < plan.tolerance && self.astray() <= self.allowed(plan) {
                return Ok(Status::Converged);
            }
            anderson.advance(&mut present, &image);
            self.unpack(&present);
        }
        // The residual that is not small enough yet: the change at single nodes or else the remaining change of α.
        let (residual, tolerance) = match residual < plan.tolerance {
            true => (self.astray(), self.allowed(plan)),
            false => (residual, plan.tolerance),
        };
        Ok(Status::NotConverged { residual, tolerance })
    }

    /// Allowed error of α because the cycle does not repeat exactly: a fraction of the error asked for or, on prescribed grids, of the
    /// fidelity's target.
    fn allowed(&self, plan: &Plan) -> f64 {
        let aim = if plan.accuracy == 0.0 { plan.target_error } else { plan.accuracy };
        (REPEATING_SHARE * aim * self.unit()).max(LEAST_CHANGE)
    }

    /// Film line load \[N/m\] at node `ix` of the line that begins at `line`, from the film's own pressure.
    fn film_line_load(&self, line: usize, ix: usize) -> f64 {
        if ix == 0 || ix + 1 == self.nx {
            return 0.0;
        }
        self.ambient_pressure * (self.line[line + ix] / self.film_thickness[line + ix] - self.interior_width)
    }

    /// Cycle mean \[N\], on one wavelength, of the magnitude of the change of the gas's force when ζ changes from `before` to `after`: the
    /// sum of the absolute changes at all nodes.
    fn force_of_change(&self, before: &[f64], after: &[f64]) -> f64 {
        let (ux, lengths) = (self.grid().x.unknown(), &self.grid().x.lengths);
        let mut sum = 0.0;
        for at in (0..self.line.len()).step_by(self.nx) {
            for ix in ux.clone() {
                sum += (after[at + ix] - before[at + ix]).abs() / self.film_thickness[at + ix] * lengths[ix];
            }
        }
        sum * self.ambient_pressure * self.teeth as f64 / (self.stored * self.steps) as f64
    }

    /// Cycle mean of the absolute force of the gas on one wavelength \[N\], ambient pressure included.
    pub(super) fn gas_force(&self) -> f64 {
        let ambient = self.ambient_pressure
            * self.interior_width
            * self.grid().x.unknown().map(|ix| self.grid().x.lengths[ix]).sum::<f64>();
        self.mean_film_load() + ambient * self.teeth as f64
    }

    /// Error of α because the cycle does not repeat exactly: the trapped gas, and its force, still change; and film and contact still
    /// disagree about their shares of the load.
    pub(super) fn astray(&self) -> f64 {
        self.drift / self.load + self.unbalanced()
    }

    /// How far film and contact disagree about their shares of the load, as an error of α: twice the mean imbalance (calibrated,
    /// docs/validation.md).
    fn unbalanced(&self) -> f64 {
        2.0 * self.mean_imbalance()
    }

    /// Cycle mean of the film load on one wavelength \[N\].
    fn mean_film_load(&self) -> f64 {
        self.mean_film_load_of(1)
    }

    /// Cycle mean of the film load over every `every`-th step \[N\].
    fn mean_film_load_of(&self, every: usize) -> f64 {
        let lengths = &self.grid().x.lengths;
        let lines = (0..self.stored * self.steps).filter(|line| (line % self.steps).is_multiple_of(every));
        let load = |line: usize| -> f64 {
            lengths.iter().enumerate().map(|(ix, length)| self.film_line_load(line * self.nx, ix) * length).sum()
        };
        let sum: f64 = lines.map(load).sum();
        sum * self.teeth as f64 / (self.stored * self.steps.div_ceil(every)) as f64
    }

    pub(super) fn alpha(&self) -> f64 {
        self.mean_film_load() / self.load
    }

    /// (film load + contact load − L)/L at an instant, with the film load from the film's own pressure: the remaining disagreement between
    /// film and contact.
    fn imbalance_at(&self, instant: usize) -> f64 {
        let lengths = &self.grid().x.lengths;
        let mut total = -self.load;
        for tooth in 0..self.teeth {
            let line = self.line_of(tooth, instant);
            for (ix, length) in lengths.iter().enumerate() {
                total += (self.film_line_load(line, ix) + self.contact_load[line + ix]) * length;
            }
        }
        total / self.load
    }

    fn imbalances(&self) -> impl Iterator<Item = f64> {
        (0..self.instants()).map(|instant| self.imbalance_at(instant))
    }

    /// Largest imbalance over all instants.
    fn imbalance(&self) -> f64 {
        self.imbalances().fold(0.0, |worst, imbalance| worst.max(imbalance.abs()))
    }

    /// Cycle mean of the imbalance: the difference between α from the film load and α from the contact load.
    pub(super) fn mean_imbalance(&self) -> f64 {
        self.imbalances().sum::<f64>().abs() / self.instants() as f64
    }
}

impl GridState for MotorLevel {
    /// α.
    fn headline(&self) -> Mean {
        Mean { all: self.alpha(), shared: self.mean_film_load_of(2) / self.load }
    }

    fn now(&self) -> f64 {
        self.mean_film_load_of(self.steps) / self.load
    }

    fn unit(&self) -> f64 {
        unit(self.alpha())
    }

    fn steps(&self) -> usize {
        self.steps
    }

    /// Of half the width.
    fn across(&self) -> usize {
        let y = &self.grid().y;
        if y.start == Start::Mirror { y.unknown().len() } else { y.len() / 2 }
    }

    fn count(&self, stats: &mut Stats) {
        stats.film_nodes = self.grid().nodes();
        stats.contact_nodes = self.contact.nodes();
        stats.steps_per_cycle = self.steps;
    }
}

/// Tolerance of the film steps in a round that starts `residual` away from the periodic state: Newton's last change leaves an error of
/// about its square, here a hundredth of the residual.
fn step_tolerance(residual: f64) -> f64 {
    (0.1 * residual.min(1.0).sqrt()).max(NEWTON_TOLERANCE)
}
