//! The plate: the film alone, under a gap that is given, uniform in space and harmonic in time.

use crate::control::{Cancel, Observer, Reporter};
use crate::estimate::extrapolate;
use crate::film::cycle::{FilmCycle, Interrupted};
use crate::film::exact::trapped_height;
use crate::film::grid::{Axis, FilmGrid, Start};
use crate::film::stepper::FilmState;
use crate::numerics::anderson::Anderson;
use crate::plan::{Grid, Plan};
use crate::problem::Plate;
use crate::recording::Recording;
use crate::solution::{PlateResult, Stats, Status};

/// Earlier cycles that the acceleration remembers.
const DEPTH: usize = 8;
/// Longest step of the acceleration in ln Z.
const LONGEST_STEP: f64 = 1.5;

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
    let mut loads = Vec::new();
    let mut status = Status::Cancelled;
    let mut recording = Recording::default();
    let mut coarser = Vec::new();
    for (number, grid) in plan.grids.iter().enumerate() {
        let mut level = Level::new(plate, plan, grid);
        let mut report = Reporter::new(&mut *observer, number, plan.grids.len(), plan.tolerance);
        status = match level.converge(plan, &mut stats, &mut report, cancel) {
            Ok(status) => status,
            Err(Interrupted::Cancelled) => Status::Cancelled,
            Err(failed) => return Err(failed),
        };
        loads.push(level.mean_load());
        stats.film_nodes = level.cycle.grid().len();
        stats.steps_per_cycle = grid.steps;
        if status == Status::Cancelled || number + 1 == plan.grids.len() {
            recording = level.recording(plate, plan.maps);
        } else {
            coarser.push(level.loads());
        }
        if status == Status::Cancelled {
            break;
        }
    }
    recording.coarser_film_load = coarser;
    let estimate = extrapolate(&loads);
    let result = PlateResult {
        film_load: estimate.value,
        film_load_error: estimate.error + plan.tolerance * estimate.value.abs(),
        ..PlateResult::of(&recording)
    };
    Ok(Periodic { status, result, loads, stats, recording })
}

/// A plate from rest, cycle after cycle ([`crate::startup`]), on all grids of a plan at once.
pub struct Transient<'a> {
    plate: &'a Plate,
    maps: bool,
    levels: Vec<Level>,
    stats: Stats,
}

impl std::fmt::Debug for Transient<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Transient").field("cycles", &self.stats.cycles).finish()
    }
}

impl<'a> Transient<'a> {
    /// At rest at the gap of t = 0, gas at ambient pressure.
    pub fn at_rest(plate: &'a Plate, plan: &Plan) -> Self {
        let levels = plan
            .grids
            .iter()
            .map(|grid| {
                let mut level = Level::new(plate, plan, grid);
                level.rest();
                level
            })
            .collect();
        Self { plate, maps: plan.maps, levels, stats: Stats::default() }
    }

    /// The next cycle, from the present instant on: means and extremes, the fields of the finest grid, and the largest change
    /// of ln Z over it. `None` if cancelled.
    ///
    /// # Errors
    /// [`Interrupted::Failed`] if a film step has no solution to working precision.
    pub fn cycle(&mut self, cancel: &Cancel) -> Result<Option<(PlateResult, Recording, f64)>, Interrupted> {
        let finest = self.levels.len() - 1;
        let mut loads = Vec::with_capacity(self.levels.len());
        let mut last = (Recording::default(), f64::INFINITY);
        for (number, level) in self.levels.iter_mut().enumerate() {
            let maps = self.maps && number == finest;
            last = match level.transient_cycle(self.plate, maps, &mut self.stats, cancel) {
                Ok(cycle) => cycle,
                Err(Interrupted::Cancelled) => return Ok(None),
                Err(failed) => return Err(failed),
            };
            loads.push(level.mean_load());
            self.stats.film_nodes = level.cycle.grid().len();
            self.stats.steps_per_cycle = level.steps;
        }
        self.stats.cycles += 1;
        let (recording, change) = last;
        let estimate = extrapolate(&loads);
        let result =
            PlateResult { film_load: estimate.value, film_load_error: estimate.error, ..PlateResult::of(&recording) };
        Ok(Some((result, recording, change)))
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
        }
    }
}

/// Nodes of a quarter of a plate, or of half a strip.
pub(crate) fn film_grid(plate: &Plate, plan: &Plan, grid: &Grid) -> FilmGrid {
    let x = Axis::clustered(0.5 * plate.length, Start::Mirror, grid.along, plan.clustering_along);
    let y = plate.width.map_or_else(Axis::unit, |width| {
        Axis::clustered(0.5 * width, Start::Mirror, grid.across, plan.clustering_across)
    });
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

    /// One cycle on, with nothing accelerated: its recording, the first frame being the present, and the largest change of ln Z.
    fn transient_cycle(
        &mut self,
        plate: &Plate,
        maps: bool,
        stats: &mut Stats,
        cancel: &Cancel,
    ) -> Result<(Recording, f64), Interrupted> {
        let nx = self.cycle.grid().x.len();
        let before = self.state.clone();
        let mut recording = Recording::default();
        for step in 1..=self.steps {
            if cancel.is_cancelled() {
                return Err(Interrupted::Cancelled);
            }
            if step == self.steps {
                recording = self.recording(plate, maps);
            }
            let m = step % self.steps;
            let here = m * nx..(m + 1) * nx;
            let taken = self
                .cycle
                .advance(m, &self.gap[here.clone()], None, self.dt, &mut self.state, &mut self.line[here])
                .map_err(|source| Interrupted::Failed { step, source })?;
            stats.film_steps += 1;
            stats.film_solves += u64::from(taken.solves);
            stats.limited_steps += u64::from(taken.limited);
        }
        self.cycle.remember(true);
        Ok((recording, self.state.change_since(&before)))
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
        let mut residual = f64::INFINITY;
        pack(&self.state, &mut present);
        for round in 1..=plan.round_limit {
            let cost = self.cycle.march(&self.gap, None, self.dt, &mut self.state, &mut self.line, cancel)?;
            stats.film_steps += cost.steps;
            stats.film_solves += cost.solves;
            stats.limited_steps += cost.limited;
            stats.cycles += 1;
            self.cycle.shift(&mut self.state);
            pack(&self.state, &mut image);
            residual = image.iter().zip(&present).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            report.round(round, residual, self.mean_load());
            if residual < plan.tolerance {
                return Ok(Status::Converged);
            }
            anderson.advance(&mut present, &image);
            for k in 0..unknowns {
                self.state.trapped[k] = present[k].exp();
                self.state.carried[k] = present[unknowns + k].exp();
            }
        }
        Ok(Status::NotConverged { residual, tolerance: plan.tolerance })
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

    /// Film load at each step \[N\].
    fn loads(&self) -> Vec<f64> {
        let x = &self.cycle.grid().x;
        let nx = x.len();
        let at = |m: usize| (0..nx).map(|i| self.line_load(m * nx + i) * x.lengths[i]).sum::<f64>() * x.copies();
        (0..self.steps).map(at).collect()
    }

    fn recording(&self, plate: &Plate, maps: bool) -> Recording {
        let grid = self.cycle.grid();
        let greatest: Vec<f64> = (0..self.steps)
            .map(|m| self.cycle.pressure(m).iter().fold(1.0, |top: f64, p| top.max(*p)) * self.ambient_pressure)
            .collect();
        let mut recording = Recording {
            period: 1.0 / plate.frequency,
            frames: self.steps,
            length: plate.length,
            teeth: 1,
            stored_teeth: 1,
            pitch: plate.length,
            x: grid.x.nodes.clone(),
            node_length: grid.x.lengths.iter().map(|length| grid.x.copies() * length).collect(),
            film_thickness: self.gap.clone(),
            stator: vec![0.0; self.gap.len()],
            contact: vec![0.0; self.gap.len()],
            film: (0..self.line.len()).map(|i| self.line_load(i)).collect(),
            map_x: grid.x.nodes.clone(),
            map_y: grid.y.nodes.clone(),
            half_width: true,
            half_length: true,
            pressure: if maps { self.cycle.full_pressure(self.ambient_pressure) } else { Vec::new() },
            ..Recording::default()
        };
        recording.fill_series(&greatest);
        recording
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
