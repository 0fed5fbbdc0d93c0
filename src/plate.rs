//! The plate: the film alone, under a gap that is given, uniform in space and harmonic in time.

use crate::control::{Cancel, Observer, Reporter};
use crate::estimate::{Estimate, Mean, extrapolate, extrapolate_means};
use crate::film::cycle::{FilmCycle, Interrupted};
use crate::film::exact::trapped_height;
use crate::film::grid::{Axis, Between, FilmGrid, Start};
use crate::film::slip::SlipLaw;
use crate::film::stepper::FilmState;
use crate::film::trapped::edge_height;
use crate::ladder::{Found, Scene, climb};
use crate::numerics::{anderson::Anderson, grading};
use crate::plan::{Grid, Plan};
use crate::problem::Plate;
use crate::recording::{Balance, LineLoads, Recording};
use crate::solution::{PlateResult, Stats, Status};

/// Earlier cycles that the acceleration remembers.
const DEPTH: usize = 8;
/// Longest step of the acceleration in ln Z.
const LONGEST_STEP: f64 = 1.5;
/// Share of the error asked for that a cycle which does not quite repeat may have, and the change that is round-off.
const REPEATING_SHARE: f64 = 0.2;
const LEAST_CHANGE: f64 = 1e-12;
/// A change that so many rounds do not halve is round-off, too, if it is below this.
const ROUND_OFF: f64 = 1e-9;
/// Rounding of a mean load over the force of the gas.
const ROUNDING: f64 = 1e-15;
const PATIENCE: usize = 8;
/// Share of the load's swing below which its mean need not be known more exactly.
const LEAST_SHARE_OF_SWING: f64 = 1e-4;

/// A plate's periodic state: the numbers, how they were reached, and the fields.
#[derive(Clone, Debug)]
pub struct Periodic {
    /// How the finest grid ended.
    pub status: Status,
    /// The numbers, with the error estimate.
    pub result: PlateResult,
    /// Mean load of each grid, coarse to fine.
    pub loads: Vec<f64>,
    /// What it cost, all grids.
    pub stats: Stats,
    /// Fields of one cycle on the finest grid.
    pub recording: Recording,
}

/// Solves for the periodic state on each of the plan's grids.
///
/// # Errors
/// [`Interrupted::Failed`] if a film step has no solution to working precision.
pub fn periodic(
    plate: &Plate,
    plan: &Plan,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Periodic, Interrupted> {
    let turned = plate.turned();
    let plate = if plan.turned { &turned } else { plate };
    let mut stats = Stats::default();
    let mut search = Search { plate, plan, observer, cancel, stats: &mut stats };
    let found = climb(&mut search, plan, None, cancel)?;
    let loads = found.headlines.iter().map(|mean| mean.all).collect();
    let Some((level, coarser)) = found.levels.split_last() else {
        let (result, recording) = (PlateResult::default(), Recording::default());
        return Ok(Periodic { status: found.status, result, loads, stats, recording });
    };
    stats.film_nodes = level.cycle.grid().len();
    stats.steps_per_cycle = level.steps();
    let coarser: Vec<_> = coarser.iter().rev().take(2).rev().map(|level| level.fields(plate, false).0).collect();
    let mut recording = level.recording(plate, &coarser, plan.maps || plan.turned);
    let estimate = stated(plate, plan, &found);
    let elsewhere = (estimate.error - extrapolate_means(&found.headlines).error).max(0.0);
    recording.judge_series(elsewhere / gas_force(plate, estimate.value));
    // The mean of the fields is the headline.
    let mut result = PlateResult::of(&recording);
    let [least, most, highest] = width_errors(plate, &found);
    result.film_load_range_error[0] += least;
    result.film_load_range_error[1] += most;
    result.max_pressure_error += highest;
    let force = result.film_load;
    result.film_load_error = estimate.error + (force - estimate.value).abs() + beyond_limits(plate, force);
    let status = match found.status {
        Status::Converged if result.film_load_error > level.unit().max(force.abs()) => {
            Status::NotResolved { error: result.film_load_error / force.abs() }
        }
        status => status,
    };
    if plan.turned {
        level.turn(&mut recording, plan.maps);
    }
    Ok(Periodic { status, result, loads, stats, recording })
}

/// Least and greatest mean load \[N\] that the equations allow: Z is nowhere less than the least gap and nowhere more than the greatest
/// (its equation has a maximum principle), so the mean of P = Z/H is within (1 ± ε)⟨1/H⟩ = √((1 ± ε)/(1 ∓ ε)).
fn limits(plate: &Plate) -> [f64; 2] {
    let most = ((plate.mean_gap + plate.amplitude) / (plate.mean_gap - plate.amplitude)).sqrt();
    [1.0 / most, most].map(|ratio| (ratio - 1.0) * plate.gas.ambient_pressure * plate.area())
}

/// By how much a mean load \[N\] is outside what the equations allow.
fn beyond_limits(plate: &Plate, load: f64) -> f64 {
    let [least, greatest] = limits(plate);
    (load - greatest).max(least - load).max(0.0)
}

/// Mean force of the gas alone \[N\], without the ambient pressure on the other side: what an error of Z is relative to.
fn gas_force(plate: &Plate, load: f64) -> f64 {
    plate.gas.ambient_pressure * plate.area() + load.abs()
}

/// Mean load with its error \[N\].
fn stated(plate: &Plate, plan: &Plan, found: &Found<Level>) -> Estimate {
    let estimate = extrapolate_means(&found.headlines);
    let Some(level) = found.levels.last() else { return estimate };
    let astray = if let Status::NotConverged { residual, .. } = found.status { residual.min(1.0) } else { 0.0 };
    let rounding = if plate.amplitude > 0.0 { ROUNDING } else { 0.0 };
    let repeating = (level.residual + astray + rounding) * gas_force(plate, estimate.value);
    let left_out = plan.left_out * estimate.value.abs();
    let beyond = beyond_limits(plate, estimate.value);
    let mut error = estimate.error + repeating + left_out + found.width_error();
    if astray > 0.0 {
        // Whatever it is, the load is within its limits.
        let [least, greatest] = limits(plate);
        error = error.min(greatest - least);
    }
    Estimate { error: error + beyond, ..estimate }
}

/// One solve of a plate by a plan.
struct Search<'a> {
    plate: &'a Plate,
    plan: &'a Plan,
    observer: &'a mut dyn Observer,
    cancel: &'a Cancel,
    stats: &'a mut Stats,
}

impl Scene for Search<'_> {
    type Level = Level;
    type Error = Interrupted;

    fn solve(
        &mut self,
        plan: &Plan,
        grid: &Grid,
        start: Option<&Level>,
        _: bool,
        number: usize,
    ) -> Result<(Status, Level), Interrupted> {
        let mut level = Level::new(self.plate, plan, grid);
        if let Some(coarse) = start {
            level.start_from(coarse);
        }
        let cancel = if number < plan.grids.len() { self.cancel.clone() } else { self.cancel.within_budget() };
        let grids = plan.grids.len().max(number + 1);
        let mut report = Reporter::new(&mut *self.observer, number, grids, plan.tolerance);
        match level.converge(plan, self.stats, &mut report, &cancel) {
            Ok(status) => Ok((status, level)),
            Err(Interrupted::Cancelled) => Ok((Status::Cancelled, level)),
            Err(failed) => Err(failed),
        }
    }

    fn headline(&self, level: &Level) -> Mean {
        level.mean()
    }

    fn unit(&self, level: &Level) -> f64 {
        level.unit()
    }

    /// Little: spring and damping are as exact as the mean then.
    fn width_aim(&self) -> f64 {
        0.02
    }

    /// Much: without contact a few rounds are enough.
    fn most_work(&self) -> f64 {
        4e5
    }

    fn across(&self, level: &Level) -> usize {
        level.cycle.grid().y.unknown().len()
    }

    fn settled(&self, found: &Found<Level>) -> bool {
        let whole = stated(self.plate, self.plan, found);
        let unit = found.levels.last().map_or(0.0, Level::unit);
        whole.error <= self.plan.accuracy * unit || extrapolate_means(&found.headlines).error < 0.3 * whole.error
    }
}

/// What the accuracy of a mean load is relative to \[N\]: itself, or a small share of the swing of the load where the mean is next to
/// nothing beside it.
pub fn unit(mean: f64, swing: f64) -> f64 {
    mean.abs().max(LEAST_SHARE_OF_SWING * swing)
}

/// A plate from rest, cycle after cycle ([`mod@crate::startup`]), on all grids of a plan at once.
pub struct Transient {
    plate: Plate,
    turned: bool,
    maps: bool,
    levels: Vec<Level>,
    width_error: f64,
    stats: Stats,
}

impl std::fmt::Debug for Transient {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Transient").field("cycles", &self.stats.cycles).finish()
    }
}

impl Transient {
    /// At rest at the gap of t = 0, gas at ambient pressure. `width_error`: that of the mean load, by the nodes across \[N\]; `stats`:
    /// what it has cost so far.
    pub fn at_rest(plate: &Plate, plan: &Plan, width_error: f64, stats: Stats) -> Self {
        // It does not repeat, as frames between steps would ask.
        let plan = &plan.even_steps();
        let plate = if plan.turned { plate.turned() } else { plate.clone() };
        let mut levels: Vec<Level> = plan.grids.iter().map(|grid| Level::new(&plate, plan, grid)).collect();
        levels.iter_mut().for_each(Level::rest);
        Self { plate, turned: plan.turned, maps: plan.maps, levels, width_error, stats }
    }

    /// The next cycle, from the present instant on: means and extremes, the fields of the finest grid, and the largest change
    /// of ln Z over it. `None` if cancelled.
    ///
    /// # Errors
    /// [`Interrupted::Failed`] if a film step has no solution to working precision.
    pub fn cycle(&mut self, cancel: &Cancel) -> Result<Option<(PlateResult, Recording, f64)>, Interrupted> {
        let finest = self.levels.len() - 1;
        let (mut loads, mut ends) = (Vec::new(), Vec::new());
        let (mut coarser, mut last) = (Vec::new(), (Recording::default(), f64::INFINITY));
        for (number, level) in self.levels.iter_mut().enumerate() {
            let start = level.load_at(0);
            let told = |level: &Level| {
                if number < finest {
                    coarser.push(level.fields(&self.plate, false).0);
                    return Recording::default();
                }
                let mut recording = level.recording(&self.plate, &coarser, self.maps || self.turned);
                if self.turned {
                    level.turn(&mut recording, self.maps);
                }
                recording
            };
            last = match level.transient_cycle(&mut self.stats, cancel, told) {
                Ok(cycle) => cycle,
                Err(Interrupted::Cancelled) => return Ok(None),
                Err(failed) => return Err(failed),
            };
            let end = level.load_at(0);
            loads.push(level.mean().from_to(start, end, level.steps()));
            ends.push(end);
            self.stats.film_nodes = level.cycle.grid().len();
            self.stats.steps_per_cycle = level.steps();
        }
        self.stats.cycles += 1;
        let (recording, change) = last;
        let estimate = extrapolate_means(&loads);
        let mut result = PlateResult::of(&recording);
        // Its frames begin with the start of the cycle, and have not its end.
        let grown = extrapolate(&ends).value - recording.film_load[0];
        result.film_load += 0.5 * grown / recording.frames as f64;
        result.film_load_error = estimate.error + (result.film_load - estimate.value).abs() + self.width_error;
        Ok(Some((result, recording, change)))
    }

    /// Error of a cycle's mean load that finer grids would not make smaller \[N\].
    pub fn elsewhere(&self) -> f64 {
        self.width_error
    }

    /// What it has cost so far, all grids.
    pub fn stats(&self) -> Stats {
        self.stats
    }
}

impl PlateResult {
    /// Cycle mean and extremes of a recording; no error of the mean is known.
    pub fn of(recording: &Recording) -> Self {
        let [least, most, highest] = extremes(&recording.film_load, &recording.max_pressure);
        let error =
            |series: fn(&LineLoads) -> Vec<f64>, found: &[f64], errors: &[f64], greater: fn(f64, f64) -> f64| {
                recording.extreme_error(series, found, errors, greater) + between_frames(found, greater)
            };
        let (loads, errors) = (&recording.film_load, &recording.film_load_error);
        let load_error = |greater| error(LineLoads::film_loads, loads, errors, greater);
        let (pressures, errors) = (&recording.max_pressure, &recording.max_pressure_error);
        Self {
            film_load: loads.iter().sum::<f64>() / recording.frames as f64,
            film_load_error: 0.0,
            film_load_min: least,
            film_load_max: most,
            min_gap: recording.min_film_thickness.iter().copied().fold(f64::INFINITY, f64::min),
            max_pressure: highest,
            film_load_range_error: [f64::min, f64::max].map(load_error),
            max_pressure_error: error(LineLoads::max_pressures, pressures, errors, f64::max),
        }
    }
}

/// Least and greatest load, and greatest pressure.
fn extremes(loads: &[f64], pressures: &[f64]) -> [f64; 3] {
    let most = |series: &[f64]| series.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [loads.iter().copied().fold(f64::INFINITY, f64::min), most(loads), most(pressures)]
}

/// By how much the extreme of a cycle exceeds that of its frames: the parabola through the three about it.
fn between_frames(series: &[f64], greater: fn(f64, f64) -> f64) -> f64 {
    let frames = series.len();
    let extreme = series.iter().copied().reduce(greater);
    let Some(top) = series.iter().position(|value| Some(*value) == extreme) else { return 0.0 };
    let (before, behind) = (series[(top + frames - 1) % frames], series[(top + 1) % frames]);
    let bend = 2.0 * series[top] - before - behind;
    if bend == 0.0 { 0.0 } else { ((before - behind).powi(2) / (8.0 * bend)).abs() }
}

/// What one node less across changes of least and greatest load and greatest pressure, on the coarsest grid.
fn width_errors(plate: &Plate, found: &Found<Level>) -> [f64; 3] {
    let (Some((narrower, _)), Some(coarsest)) = (&found.narrower, found.levels.first()) else { return [0.0; 3] };
    let of = |level: &Level| {
        let (lines, _) = level.fields(plate, false);
        extremes(&lines.film_loads(), &lines.max_pressures())
    };
    let (less, more) = (of(narrower), of(coarsest));
    std::array::from_fn(|k| (more[k] - less[k]).abs())
}

/// Nodes of a quarter of a plate, or of half a strip.
pub(crate) fn film_grid(plate: &Plate, plan: &Plan, grid: &Grid) -> FilmGrid {
    let x = Axis::clustered(0.5 * plate.length, Start::Mirror, grid.along, plan.clustering_along);
    let y = match plate.width {
        Some(width) if plan.spectral => Axis::spectral(0.5 * width, Start::Mirror, grid.across, plan.clustering_across),
        Some(width) => Axis::clustered(0.5 * width, Start::Mirror, grid.across, plan.clustering_across),
        None => Axis::unit(),
    };
    FilmGrid { x, y }
}

/// The periodic state on one grid.
struct Level {
    /// Length of each step \[s\].
    dt: Vec<f64>,
    period: f64,
    ambient_pressure: f64,
    law: SlipLaw,
    cycle: FilmCycle,
    state: FilmState,
    /// h, `[step][ix]`.
    gap: Vec<f64>,
    /// Z integrated across, `[step][ix]`.
    line: Vec<f64>,
    /// Where in the steps each frame of a recording is.
    frames: Frames,
    /// Change of ln Z in the last round.
    residual: f64,
}

impl Level {
    fn new(plate: &Plate, plan: &Plan, grid: &Grid) -> Self {
        let nodes = film_grid(plate, plan, grid);
        let nx = nodes.x.len();
        let (steps, beta) = (grid.steps, plan.clustering_in_time);
        let place = |m: usize| 2.0 * m as f64 / steps as f64 - 1.0;
        let phase = |m: usize| {
            if beta == 0.0 { m as f64 / steps as f64 } else { 0.5 * (1.0 + grading::map(beta, place(m))) }
        };
        let share = |m: usize| grading::slope(beta, place(m)) / steps as f64;
        let gaps: Vec<f64> = (0..steps).map(|m| plate.gap(phase(m))).collect();
        // Trapped gas as at high frequency, with the discrete means so that the discrete invariant holds from the start.
        let slip = 6.0 * plate.gas.mean_free_path;
        let mean = |f: &dyn Fn(f64) -> f64| gaps.iter().enumerate().map(|(m, h)| f(*h) * share(m)).sum::<f64>();
        let trapped = trapped_height(mean(&|h| h * h * (0.5 * h + slip)), mean(&|h| h), slip);
        let mut cycle = FilmCycle::new(nodes, &plate.gas, steps);
        cycle.count_outflow();
        Self {
            dt: (0..steps).map(|m| share(m) / plate.frequency).collect(),
            period: 1.0 / plate.frequency,
            ambient_pressure: plate.gas.ambient_pressure,
            law: SlipLaw::of(&plate.gas),
            state: FilmState::at_rest(vec![trapped; cycle.grid().unknowns()]),
            gap: gaps.iter().flat_map(|h| std::iter::repeat_n(*h, nx)).collect(),
            line: vec![0.0; steps * nx],
            frames: Frames::new(plate, beta, steps, plan.frames_per_step),
            residual: f64::INFINITY,
            cycle,
        }
    }

    fn steps(&self) -> usize {
        self.dt.len()
    }

    /// Rest, at the gap of step 0, gas at ambient pressure.
    fn rest(&mut self) {
        let nx = self.cycle.grid().x.len();
        self.state = FilmState::at_rest(vec![self.gap[0]; self.state.trapped.len()]);
        self.cycle.grid().line_integral(&self.state.trapped, &mut self.line[..nx]);
        self.cycle.remember(false);
    }

    /// Starts from the state on another grid, interpolated linearly between its nodes.
    fn start_from(&mut self, coarse: &Self) {
        let (to, from) = (self.cycle.grid(), coarse.cycle.grid());
        let between = |axis: &Axis, other: &Axis| -> Vec<Between> {
            let end = axis.nodes[axis.len() - 1];
            let place = |node: &f64| if end > 0.0 { node / end } else { 0.0 };
            axis.unknown().map(|i| Between::at(place(&axis.nodes[i]), &other.nodes)).collect()
        };
        let (along, across) = (between(&to.x, &from.x), between(&to.y, &from.y));
        let (rows, columns) = (from.x.unknown().len(), from.y.unknown().len());
        // On the edges Z is the gap.
        let at = |field: &[f64], i: usize, j: usize| {
            if i < rows && j < columns { field[i * columns + j] } else { coarse.gap[0] }
        };
        let mix = |field: &[f64], x: &Between, y: &Between| {
            let row = |i: usize| y.mix(at(field, i, y.low), at(field, i, y.high()));
            x.mix(row(x.low), row(x.high()))
        };
        for (row, x) in along.iter().enumerate() {
            for (column, y) in across.iter().enumerate() {
                let k = row * across.len() + column;
                self.state.trapped[k] = mix(&coarse.state.trapped, x, y);
                self.state.carried[k] = mix(&coarse.state.carried, x, y);
            }
        }
    }

    /// One cycle on, with nothing accelerated: what `told` makes of it, the first frame being the present, and the largest change of
    /// ln Z.
    fn transient_cycle(
        &mut self,
        stats: &mut Stats,
        cancel: &Cancel,
        told: impl FnOnce(&Self) -> Recording,
    ) -> Result<(Recording, f64), Interrupted> {
        let before = self.state.clone();
        for step in 1..self.steps() {
            if cancel.is_cancelled() {
                return Err(Interrupted::Cancelled);
            }
            self.advance(step, step, stats)?;
        }
        let recording = told(self);
        self.advance(self.steps(), 0, stats)?;
        self.cycle.remember(true);
        Ok((recording, self.state.change_since(&before)))
    }

    /// One step, to step `m` of the cycle.
    fn advance(&mut self, step: usize, m: usize, stats: &mut Stats) -> Result<(), Interrupted> {
        let nx = self.cycle.grid().x.len();
        let here = m * nx..(m + 1) * nx;
        let taken = self
            .cycle
            .advance(m, &self.gap[here.clone()], None, self.dt[m], &mut self.state, &mut self.line[here])
            .map_err(|source| Interrupted::Failed { step, source })?;
        stats.film_steps += 1;
        stats.film_solves += u64::from(taken.solves);
        stats.limited_steps += u64::from(taken.limited);
        Ok(())
    }

    fn converge(
        &mut self,
        plan: &Plan,
        stats: &mut Stats,
        report: &mut Reporter<'_>,
        cancel: &Cancel,
    ) -> Result<Status, Interrupted> {
        if plan.trapped {
            self.trap();
            return Ok(Status::Converged);
        }
        let mut anderson = Anderson::new(DEPTH, LONGEST_STEP);
        let mut least = (f64::INFINITY, 0);
        let unknowns = self.state.trapped.len();
        let (mut present, mut image) = (vec![0.0; 2 * unknowns], vec![0.0; 2 * unknowns]);
        pack(&self.state, &mut present);
        for round in 1..=plan.round_limit {
            let cost = self.cycle.march(&self.gap, None, |m| self.dt[m], &mut self.state, &mut self.line, cancel)?;
            stats.film_steps += cost.steps;
            stats.film_solves += cost.solves;
            stats.limited_steps += cost.limited;
            stats.cycles += 1;
            self.cycle.shift(&mut self.state);
            pack(&self.state, &mut image);
            let residual = image.iter().zip(&present).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            self.residual = residual;
            report.round(round, residual, self.mean_load());
            if residual < 0.5 * least.0 {
                least = (residual, round);
            }
            let round_off = residual < ROUND_OFF && round > least.1 + PATIENCE;
            if residual < plan.tolerance && (residual <= self.allowed_change(plan) || round_off) {
                return Ok(Status::Converged);
            }
            anderson.advance(&mut present, &image);
            for k in 0..unknowns {
                self.state.trapped[k] = present[k].exp();
                self.state.carried[k] = present[unknowns + k].exp();
            }
        }
        Ok(Status::NotConverged { residual: self.residual, tolerance: plan.tolerance })
    }

    /// The limit of gas that has no time to leave: Z is the same everywhere and at all times, what the edges leave of it
    /// ([`edge_height`]).
    fn trap(&mut self) {
        let grid = self.cycle.grid();
        let (nx, known, width) = (grid.x.len(), grid.x.unknown(), grid.interior_width());
        let trapped = edge_height(self.law, || self.frames.gap.iter().copied());
        for step in 0..self.steps() {
            let h = self.gap[step * nx];
            self.cycle.guess_mut(step).fill(trapped / h);
            self.line[step * nx..][known.clone()].fill(width * trapped);
        }
        self.state = FilmState::at_rest(vec![trapped; self.state.trapped.len()]);
        self.residual = 0.0;
    }

    /// Net gauge load \[N\] of Z integrated across, `line[ix]`, at the gap `h`.
    fn load(&self, line: &[f64], h: f64) -> f64 {
        let (x, width) = (&self.cycle.grid().x, self.cycle.grid().interior_width());
        let net = x.unknown().map(|ix| (line[ix] - width * h) * x.lengths[ix]).sum::<f64>();
        x.copies() * self.ambient_pressure * net / h
    }

    /// Film load at each step \[N\].
    fn loads(&self) -> Vec<f64> {
        let nx = self.cycle.grid().x.len();
        self.line.chunks_exact(nx).zip(self.gap.iter().step_by(nx)).map(|(line, h)| self.load(line, *h)).collect()
    }

    fn mean_load(&self) -> f64 {
        self.loads().iter().zip(&self.dt).map(|(load, dt)| load * dt).sum::<f64>() / self.period
    }

    /// Mean load over all frames, and over those of the next coarser grid \[N\].
    fn mean(&self) -> Mean {
        let nx = self.cycle.grid().x.len();
        let (mut line, mut all, mut shared) = (vec![0.0; nx], 0.0, 0.0);
        let frames = self.frames.len();
        for frame in 0..frames {
            self.frames.mix(frame, &mut line, |m, ix| self.line[m * nx + ix]);
            let load = self.load(&line, self.frames.gap[frame]);
            all += load;
            shared += if frame % 2 == 0 { load } else { 0.0 };
        }
        Mean { all: all / frames as f64, shared: shared / frames.div_ceil(2) as f64 }
    }

    /// See [`unit`].
    fn unit(&self) -> f64 {
        let loads = self.loads();
        let (low, high) = loads.iter().fold((0.0f64, 0.0f64), |(low, high), load| (low.min(*load), high.max(*load)));
        unit(self.mean_load(), high - low)
    }

    /// By how much ln Z may still change from round to round: what that does to the load is a share of the error asked for.
    fn allowed_change(&self, plan: &Plan) -> f64 {
        if plan.accuracy == 0.0 {
            return f64::INFINITY;
        }
        let grid = self.cycle.grid();
        let area = grid.interior_width() * grid.x.copies() * grid.x.lengths.iter().sum::<f64>();
        let force = self.ambient_pressure * area + self.mean_load();
        (REPEATING_SHARE * plan.accuracy * self.unit() / force).max(LEAST_CHANGE)
    }

    /// Film load at step `m` \[N\]; between two cycles of a transient step 0 is the present.
    fn load_at(&self, m: usize) -> f64 {
        let nx = self.cycle.grid().x.len();
        self.load(&self.line[m * nx..(m + 1) * nx], self.gap[m * nx])
    }

    /// The film of one cycle, lengths are those of the whole plate; and the absolute pressure at every node, if `maps`,
    /// `[frame][ix][iy]`.
    fn fields(&self, plate: &Plate, maps: bool) -> (LineLoads, Vec<f64>) {
        let grid = self.cycle.grid();
        let (nx, ny, columns, frames) = (grid.x.len(), grid.y.len(), grid.y.unknown().len(), self.frames.len());
        let (ambient, width) = (self.ambient_pressure, grid.interior_width());
        let (mut film, mut peak) = (vec![0.0; frames * nx], vec![ambient; frames * nx]);
        let mut pressure = vec![ambient; if maps { frames * nx * ny } else { 0 }];
        let (mut line, mut heights) = (vec![0.0; nx], vec![0.0; self.state.trapped.len()]);
        for (frame, h) in self.frames.gap.iter().enumerate() {
            self.frames.mix(frame, &mut line, |m, ix| self.line[m * nx + ix]);
            self.frames.mix(frame, &mut heights, |m, k| self.cycle.pressure(m)[k] * self.gap[m * nx]);
            for (across, ix) in heights.chunks_exact(columns).zip(grid.x.unknown()) {
                let k = frame * nx + ix;
                film[k] = ambient * (line[ix] - width * h) / h;
                for (z, iy) in across.iter().zip(grid.y.unknown()) {
                    let p = ambient * z / h;
                    peak[k] = peak[k].max(p);
                    if maps {
                        pressure[k * ny + iy] = p;
                    }
                }
            }
        }
        let lines = LineLoads {
            frames,
            length: plate.length,
            teeth: 1,
            stored_teeth: 1,
            pitch: plate.length,
            x: grid.x.nodes.clone(),
            node_length: grid.x.lengths.iter().map(|length| grid.x.copies() * length).collect(),
            contact: vec![0.0; frames * nx],
            film,
            film_thickness: self.frames.gap.iter().flat_map(|h| std::iter::repeat_n(*h, nx)).collect(),
            peak,
            ambient: (0..nx).map(|ix| if grid.x.unknown().contains(&ix) { ambient * width } else { 0.0 }).collect(),
        };
        (lines, pressure)
    }

    /// The cycle as it is drawn and exported: this, the finest grid, extrapolated with the `coarser` ones, coarse to fine.
    fn recording(&self, plate: &Plate, coarser: &[LineLoads], maps: bool) -> Recording {
        let grid = self.cycle.grid();
        let (lines, pressure) = self.fields(plate, maps);
        let base = Recording {
            period: self.period,
            stator: vec![0.0; lines.film.len()],
            map_x: grid.x.nodes.clone(),
            map_y: grid.y.nodes.clone(),
            half_width: true,
            half_length: true,
            ..Recording::default()
        };
        let balance = Balance { load: None, min_spacing: 0.0 };
        base.of_lines(lines, coarser, &balance, pressure, grid.y.unknown())
    }

    /// Turns the recording of a plate that was solved turned: x and y change places, and lines run along the other side. The fields
    /// that it is judged by stay as they are, since only their sums count.
    fn turn(&self, recording: &mut Recording, maps: bool) {
        let y = &self.cycle.grid().y;
        let (nx, ny, frames) = (recording.map_x.len(), recording.map_y.len(), recording.frames);
        let mut pressure = vec![0.0; recording.pressure.len()];
        let mut film = vec![0.0; frames * ny];
        for (k, p) in recording.pressure.iter().enumerate() {
            let (frame, ix, iy) = (k / (nx * ny), k / ny % nx, k % ny);
            pressure[(frame * ny + iy) * nx + ix] = *p;
            if y.unknown().contains(&iy) {
                film[frame * ny + iy] += recording.node_length[ix] * (p - self.ambient_pressure);
            }
        }
        recording.length = 2.0 * y.nodes[ny - 1];
        recording.pitch = recording.length;
        recording.film_thickness =
            recording.film_thickness.iter().step_by(nx).flat_map(|h| std::iter::repeat_n(*h, ny)).collect();
        recording.node_length = y.lengths.iter().map(|length| y.copies() * length).collect();
        recording.stator = vec![0.0; frames * ny];
        recording.contact = vec![0.0; frames * ny];
        recording.film = film;
        recording.x = recording.map_y.clone();
        std::mem::swap(&mut recording.map_x, &mut recording.map_y);
        recording.pressure = if maps { pressure } else { Vec::new() };
    }
}

/// The frames of a recording, even in time, among the steps of a cycle, which cluster about its middle.
struct Frames {
    /// Gap of each frame \[m\].
    gap: Vec<f64>,
    /// The step before each frame, and how far it is towards the next; empty if each step is a frame.
    places: Vec<(usize, f64)>,
    steps: usize,
}

impl Frames {
    fn new(plate: &Plate, beta: f64, steps: usize, per_step: usize) -> Self {
        let frames = steps * per_step;
        let gap = (0..frames).map(|frame| plate.gap(frame as f64 / frames as f64)).collect();
        let place = |frame: usize| {
            let share = 2.0 * frame as f64 / frames as f64 - 1.0;
            let place = 0.5 * (1.0 + (share * beta.sinh()).asinh() / beta) * steps as f64;
            let step = (place as usize).min(steps - 1);
            (step, place - step as f64)
        };
        Self { gap, places: if beta == 0.0 { Vec::new() } else { (0..frames).map(place).collect() }, steps }
    }

    fn len(&self) -> usize {
        self.gap.len()
    }

    /// What is known at the steps, `value(step, k)` > 0, at a frame: cubic in the steps.
    fn mix(&self, frame: usize, out: &mut [f64], value: impl Fn(usize, usize) -> f64) {
        let Some((step, t)) = self.places.get(frame).copied() else {
            out.iter_mut().enumerate().for_each(|(k, out)| *out = value(frame, k));
            return;
        };
        let at = |ahead: usize| (step + self.steps + ahead - 1) % self.steps;
        let (before, behind) = (t + 1.0, t - 1.0);
        let weights = [
            -t * behind * (t - 2.0) / 6.0,
            before * behind * (t - 2.0) / 2.0,
            -before * t * (t - 2.0) / 2.0,
            before * t * behind / 6.0,
        ];
        for (k, out) in out.iter_mut().enumerate() {
            let near = [0, 1, 2, 3].map(|ahead| value(at(ahead), k));
            let cubic = near.iter().zip(weights).map(|(value, weight)| value * weight).sum::<f64>();
            *out = cubic.clamp(0.5 * near[1].min(near[2]), 2.0 * near[1].max(near[2]));
        }
    }
}

impl PlateResult {
    /// Load over ambient pressure × area.
    pub fn ratio(load: f64, plate: &Plate) -> f64 {
        load / (plate.gas.ambient_pressure * plate.area())
    }
}

fn pack(state: &FilmState, out: &mut [f64]) {
    let unknowns = state.trapped.len();
    for k in 0..unknowns {
        out[k] = state.trapped[k].ln();
        out[unknowns + k] = state.carried[k].ln();
    }
}
