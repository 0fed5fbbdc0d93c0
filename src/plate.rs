//! The plate: the film alone, under a gap that is given, uniform in space and harmonic in time.

use crate::control::{Cancel, Observer, Reporter};
use crate::estimate::{Estimate, Mean, extrapolate, extrapolate_means};
use crate::film::cycle::{FilmCycle, Interrupted};
use crate::film::exact::trapped_height;
use crate::film::grid::{Axis, Between, FilmGrid, Start};
use crate::film::stepper::FilmState;
use crate::ladder::{Found, Scene, climb};
use crate::numerics::anderson::Anderson;
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
    let mut stats = Stats::default();
    let mut search = Search { plate, plan, observer, cancel, stats: &mut stats };
    let found = climb(&mut search, plan, None, cancel)?;
    let loads = found.headlines.iter().map(|mean| mean.all).collect();
    let Some((level, coarser)) = found.levels.split_last() else {
        let (result, recording) = (PlateResult::default(), Recording::default());
        return Ok(Periodic { status: found.status, result, loads, stats, recording });
    };
    stats.film_nodes = level.cycle.grid().len();
    stats.steps_per_cycle = level.steps;
    let coarser: Vec<LineLoads> = coarser.iter().rev().take(2).rev().map(|level| level.line_loads(plate)).collect();
    let mut recording = level.recording(plate, &coarser, plan.maps);
    let estimate = stated(plate, &found);
    let elsewhere = estimate.error - extrapolate_means(&found.headlines).error;
    recording.judge_series(elsewhere / (plate.gas.ambient_pressure * plate.area()));
    // The mean of the fields is the headline.
    let mut result = PlateResult::of(&recording);
    let force = result.film_load;
    result.film_load_error = estimate.error + (force - estimate.value).abs() + beyond_limits(plate, force);
    let status = match found.status {
        Status::Converged if result.film_load_error > level.unit().max(force.abs()) => {
            Status::NotResolved { error: result.film_load_error / force.abs() }
        }
        status => status,
    };
    Ok(Periodic { status, result, loads, stats, recording })
}

/// By how much a mean load \[N\] is outside what the equations allow: Z is nowhere less than the least gap and nowhere more than the
/// greatest (its equation has a maximum principle), so the mean of P = Z/H is within (1 ± ε)⟨1/H⟩ = √((1 ± ε)/(1 ∓ ε)).
fn beyond_limits(plate: &Plate, load: f64) -> f64 {
    let excursion = plate.amplitude / plate.mean_gap;
    let ratio = 1.0 + PlateResult::ratio(load, plate);
    let most = ((1.0 + excursion) / (1.0 - excursion)).sqrt();
    (ratio - most).max(1.0 / most - ratio).max(0.0) * plate.gas.ambient_pressure * plate.area()
}

/// Mean load with its error \[N\].
fn stated(plate: &Plate, found: &Found<Level>) -> Estimate {
    let estimate = extrapolate_means(&found.headlines);
    let Some(level) = found.levels.last() else { return estimate };
    let astray = if let Status::NotConverged { residual, .. } = found.status { residual.min(1.0) } else { 0.0 };
    let repeating = (level.residual + astray) * plate.gas.ambient_pressure * plate.area();
    let beyond = beyond_limits(plate, estimate.value);
    Estimate { error: estimate.error + repeating + found.width_error() + beyond, ..estimate }
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
        1.5e6
    }

    fn across(&self, level: &Level) -> usize {
        level.cycle.grid().y.unknown().len()
    }

    fn settled(&self, found: &Found<Level>) -> bool {
        let whole = stated(self.plate, found);
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
pub struct Transient<'a> {
    plate: &'a Plate,
    maps: bool,
    levels: Vec<Level>,
    width_error: f64,
    stats: Stats,
}

impl std::fmt::Debug for Transient<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Transient").field("cycles", &self.stats.cycles).finish()
    }
}

impl<'a> Transient<'a> {
    /// At rest at the gap of t = 0, gas at ambient pressure. `width_error`: that of the mean load, by the nodes across \[N\]; `stats`:
    /// what it has cost so far.
    pub fn at_rest(plate: &'a Plate, plan: &Plan, width_error: f64, stats: Stats) -> Self {
        let mut levels: Vec<Level> = plan.grids.iter().map(|grid| Level::new(plate, plan, grid)).collect();
        levels.iter_mut().for_each(Level::rest);
        Self { plate, maps: plan.maps, levels, width_error, stats }
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
                    coarser.push(level.line_loads(self.plate));
                    Recording::default()
                } else {
                    level.recording(self.plate, &coarser, self.maps)
                }
            };
            last = match level.transient_cycle(&mut self.stats, cancel, told) {
                Ok(cycle) => cycle,
                Err(Interrupted::Cancelled) => return Ok(None),
                Err(failed) => return Err(failed),
            };
            let end = level.load_at(0);
            loads.push(level.mean().from_to(start, end, level.steps));
            ends.push(end);
            self.stats.film_nodes = level.cycle.grid().len();
            self.stats.steps_per_cycle = level.steps;
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
    /// Cycle mean and extremes of a recording; no error is known.
    pub fn of(recording: &Recording) -> Self {
        let least = |series: &[f64]| series.iter().copied().fold(f64::INFINITY, f64::min);
        let most = |series: &[f64]| series.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self {
            film_load: recording.film_load.iter().sum::<f64>() / recording.frames as f64,
            film_load_error: 0.0,
            film_load_min: least(&recording.film_load),
            film_load_max: most(&recording.film_load),
            min_gap: least(&recording.min_film_thickness),
            max_pressure: most(&recording.max_pressure),
            film_load_range_error: [f64::min, f64::max].map(|greater| {
                let (loads, errors) = (&recording.film_load, &recording.film_load_error);
                recording.extreme_error(LineLoads::film_loads, loads, errors, greater)
            }),
            max_pressure_error: recording.extreme_error(
                LineLoads::max_pressures,
                &recording.max_pressure,
                &recording.max_pressure_error,
                f64::max,
            ),
        }
    }
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
    steps: usize,
    dt: f64,
    ambient_pressure: f64,
    cycle: FilmCycle,
    state: FilmState,
    /// h, `[step][ix]`.
    gap: Vec<f64>,
    /// Z integrated across, `[step][ix]`.
    line: Vec<f64>,
    /// Change of ln Z in the last round.
    residual: f64,
}

impl Level {
    fn new(plate: &Plate, plan: &Plan, grid: &Grid) -> Self {
        let nodes = film_grid(plate, plan, grid);
        let nx = nodes.x.len();
        let steps = grid.steps;
        let gaps: Vec<f64> = (0..steps).map(|m| plate.gap(m as f64 / steps as f64)).collect();
        // Trapped gas as at high frequency, with the discrete means so that the discrete invariant holds from the start.
        let slip = 6.0 * plate.gas.mean_free_path;
        let mean = |f: &dyn Fn(f64) -> f64| gaps.iter().map(|h| f(*h)).sum::<f64>() / steps as f64;
        let trapped = trapped_height(mean(&|h| h * h * (0.5 * h + slip)), mean(&|h| h), slip);
        Self {
            steps,
            dt: 1.0 / (plate.frequency * steps as f64),
            ambient_pressure: plate.gas.ambient_pressure,
            state: FilmState::at_rest(vec![trapped; nodes.unknowns()]),
            gap: gaps.iter().flat_map(|h| std::iter::repeat_n(*h, nx)).collect(),
            line: vec![0.0; steps * nx],
            residual: f64::INFINITY,
            cycle: FilmCycle::new(nodes, &plate.gas, steps),
        }
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
        for step in 1..self.steps {
            if cancel.is_cancelled() {
                return Err(Interrupted::Cancelled);
            }
            self.advance(step, step, stats)?;
        }
        let recording = told(self);
        self.advance(self.steps, 0, stats)?;
        self.cycle.remember(true);
        Ok((recording, self.state.change_since(&before)))
    }

    /// One step, to step `m` of the cycle.
    fn advance(&mut self, step: usize, m: usize, stats: &mut Stats) -> Result<(), Interrupted> {
        let nx = self.cycle.grid().x.len();
        let here = m * nx..(m + 1) * nx;
        let taken = self
            .cycle
            .advance(m, &self.gap[here.clone()], None, self.dt, &mut self.state, &mut self.line[here])
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
        let mut anderson = Anderson::new(DEPTH, LONGEST_STEP);
        let unknowns = self.state.trapped.len();
        let (mut present, mut image) = (vec![0.0; 2 * unknowns], vec![0.0; 2 * unknowns]);
        pack(&self.state, &mut present);
        for round in 1..=plan.round_limit {
            let cost = self.cycle.march(&self.gap, None, self.dt, &mut self.state, &mut self.line, cancel)?;
            stats.film_steps += cost.steps;
            stats.film_solves += cost.solves;
            stats.limited_steps += cost.limited;
            stats.cycles += 1;
            self.cycle.shift(&mut self.state);
            pack(&self.state, &mut image);
            let residual = image.iter().zip(&present).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            self.residual = residual;
            report.round(round, residual, self.mean_load());
            if residual < plan.tolerance && residual <= self.allowed_change(plan) {
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

    /// Net gauge line load \[N/m\] at a node of the lines (for a strip: times one metre).
    fn line_load(&self, index: usize) -> f64 {
        let grid = self.cycle.grid();
        if !grid.x.unknown().contains(&(index % grid.x.len())) {
            return 0.0;
        }
        self.ambient_pressure * (self.line[index] / self.gap[index] - grid.interior_width())
    }

    fn mean_load(&self) -> f64 {
        let x = &self.cycle.grid().x;
        let sum: f64 = (0..self.line.len()).map(|i| self.line_load(i) * x.lengths[i % x.len()]).sum();
        x.copies() * sum / self.steps as f64
    }

    /// Mean load over all steps, and over those of the next coarser grid \[N\].
    fn mean(&self) -> Mean {
        let loads = self.loads();
        let shared = loads.iter().step_by(2).sum::<f64>() / self.steps.div_ceil(2) as f64;
        Mean { all: loads.iter().sum::<f64>() / self.steps as f64, shared }
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
        (REPEATING_SHARE * plan.accuracy * self.unit() / (self.ambient_pressure * area)).max(LEAST_CHANGE)
    }

    /// Film load at each step \[N\].
    fn loads(&self) -> Vec<f64> {
        (0..self.steps).map(|m| self.load_at(m)).collect()
    }

    /// Film load at step `m` \[N\]; between two cycles of a transient step 0 is the present.
    fn load_at(&self, m: usize) -> f64 {
        let x = &self.cycle.grid().x;
        (0..x.len()).map(|i| self.line_load(m * x.len() + i) * x.lengths[i]).sum::<f64>() * x.copies()
    }

    /// The film of one cycle; lengths are those of the whole plate.
    fn line_loads(&self, plate: &Plate) -> LineLoads {
        let grid = self.cycle.grid();
        let columns = grid.y.unknown().len();
        let mut peak = vec![self.ambient_pressure; self.line.len()];
        for (step, peak) in peak.chunks_exact_mut(grid.x.len()).enumerate() {
            for (peak, across) in peak.iter_mut().zip(self.cycle.pressure(step).chunks_exact(columns)) {
                *peak = self.ambient_pressure * across.iter().fold(1.0, |top: f64, p| top.max(*p));
            }
        }
        let width = self.ambient_pressure * grid.interior_width();
        LineLoads {
            frames: self.steps,
            length: plate.length,
            teeth: 1,
            stored_teeth: 1,
            pitch: plate.length,
            x: grid.x.nodes.clone(),
            node_length: grid.x.lengths.iter().map(|length| grid.x.copies() * length).collect(),
            contact: vec![0.0; self.gap.len()],
            film: (0..self.line.len()).map(|i| self.line_load(i)).collect(),
            film_thickness: self.gap.clone(),
            peak,
            ambient: (0..grid.x.len()).map(|i| if grid.x.unknown().contains(&i) { width } else { 0.0 }).collect(),
        }
    }

    /// The cycle as it is drawn and exported: this, the finest grid, extrapolated with the `coarser` ones, coarse to fine.
    fn recording(&self, plate: &Plate, coarser: &[LineLoads], maps: bool) -> Recording {
        let grid = self.cycle.grid();
        let pressure = if maps { self.cycle.full_pressure(self.ambient_pressure) } else { Vec::new() };
        let base = Recording {
            period: 1.0 / plate.frequency,
            stator: vec![0.0; self.gap.len()],
            map_x: grid.x.nodes.clone(),
            map_y: grid.y.nodes.clone(),
            half_width: true,
            half_length: true,
            ..Recording::default()
        };
        let balance = Balance { load: None, min_spacing: 0.0 };
        base.of_lines(self.line_loads(plate), coarser, &balance, pressure, grid.y.unknown())
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
