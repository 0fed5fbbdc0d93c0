//! The film under a plate on one grid: rounds of its cycle until it repeats, or one cycle after the other from rest.

use super::frames::Frames;
use crate::control::{Cancel, Reporter};
use crate::estimate::Mean;
use crate::film::cycle::{FilmCycle, Interrupted};
use crate::film::exact::trapped_height;
use crate::film::grid::{Axis, Between, FilmGrid, Start};
use crate::film::slip::SlipLaw;
use crate::film::stepper::{Film, FilmState};
use crate::film::trapped::edge_height;
use crate::ladder::GridState;
use crate::numerics::{anderson::Anderson, grading};
use crate::plan::{Grid, Plan};
use crate::problem::Plate;
use crate::recording::{Balance, LineLoads, Recording};
use crate::solution::{Stats, Status};

/// Earlier cycles that the acceleration remembers.
const DEPTH: usize = 8;
/// Longest step of the acceleration in ln Z.
const LONGEST_STEP: f64 = 1.5;
/// Fraction of the error asked for that is allowed because the cycle does not repeat exactly, and the change that counts as round-off.
const REPEATING_SHARE: f64 = 0.2;
const LEAST_CHANGE: f64 = 1e-12;
/// A change below this that is not halved within so many rounds counts as round-off, too.
const ROUND_OFF: f64 = 1e-9;
const PATIENCE: usize = 8;
/// Fraction of the load's swing below which the mean load need not be known more exactly.
const LEAST_SHARE_OF_SWING: f64 = 1e-4;

/// Reference for the relative error of a mean load \[N; of a strip N/m\]: the mean itself, or a small share of the swing of the load where
/// the mean is negligible beside it.
pub fn unit(mean: f64, swing: f64) -> f64 {
    mean.abs().max(LEAST_SHARE_OF_SWING * swing)
}

/// Nodes of a quarter of a plate, of half a strip, or of the radius of a round plate.
pub(crate) fn film_grid(plate: &Plate, plan: &Plan, grid: &Grid) -> FilmGrid {
    let x = match plate.hole {
        Some(hole) => {
            let intervals = if hole > 0.0 { 2 * grid.along } else { grid.along };
            Axis::radial(hole, plate.radius(), intervals, plan.clustering_along)
        }
        None => Axis::clustered(0.5 * plate.length, Start::Mirror, grid.along, plan.clustering_along),
    };
    let y = match plate.width {
        Some(width) if plan.spectral => Axis::spectral(0.5 * width, Start::Mirror, grid.across, plan.clustering_across),
        Some(width) => Axis::clustered(0.5 * width, Start::Mirror, grid.across, plan.clustering_across),
        None => Axis::single(1.0),
    };
    FilmGrid { x, y }
}

/// The periodic state on one grid.
#[derive(Debug)]
pub(super) struct PlateLevel {
    /// Length of each step \[s\].
    dt: Vec<f64>,
    period: f64,
    ambient_pressure: f64,
    law: SlipLaw,
    pub(super) cycle: FilmCycle,
    state: FilmState,
    /// h, `[step][ix]`.
    gap: Vec<f64>,
    /// Z integrated across, `[step][ix]`.
    line: Vec<f64>,
    /// Where in the steps each frame of a recording is.
    frames: Frames,
    /// Change of ln Z in the last round.
    pub(super) residual: f64,
}

impl PlateLevel {
    pub(super) fn new(plate: &Plate, plan: &Plan, grid: &Grid) -> Self {
        let nodes = film_grid(plate, plan, grid);
        let nx = nodes.x.len();
        let (steps, beta) = (grid.steps, plan.clustering_in_time);
        let place = |m: usize| 2.0 * m as f64 / steps as f64 - 1.0;
        let phase = |m: usize| {
            if beta == 0.0 { m as f64 / steps as f64 } else { 0.5 * (1.0 + grading::map(beta, place(m))) }
        };
        let share = |m: usize| grading::slope(beta, place(m)) / steps as f64;
        let gaps: Vec<f64> = (0..steps).map(|m| plate.gap(phase(m))).collect();
        // Trapped gas as at high frequency; with first-order slip, the discrete means let the discrete invariant hold from the start.
        let slip = 6.0 * plate.gas.mean_free_path;
        let mean = |f: &dyn Fn(f64) -> f64| gaps.iter().enumerate().map(|(m, h)| f(*h) * share(m)).sum::<f64>();
        let trapped = trapped_height(mean(&|h| h * h * (0.5 * h + slip)), mean(&|h| h), slip);
        let mut cycle = FilmCycle::new(Film::new(nodes, &plate.gas), steps);
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

    /// Starts from rest at the mean gap, gas at ambient pressure, and marches to the beginning of the first cycle; the gap opens first.
    pub(super) fn rest(&mut self, mean_gap: f64, stats: &mut Stats) -> Result<(), Interrupted> {
        self.state = FilmState::at_rest(vec![mean_gap; self.state.trapped.len()]);
        self.cycle.remember(false);
        // The gap is the mean one three quarters of a cycle after it is widest, which may be between two steps.
        let steps = self.steps();
        let whole = steps / 4;
        let first = steps - whole;
        let part = 0.25 * steps as f64 - whole as f64;
        if part > 0.0 {
            self.advance(part * self.dt[first], first, first, stats)?;
        }
        (first + 1..=steps).try_for_each(|step| self.advance(self.dt[step % steps], step, step % steps, stats))
    }

    /// Starts from the state on another grid, or of another gap, interpolated linearly between its nodes.
    pub(super) fn start_from(&mut self, coarse: &Self) {
        let (to, from) = (self.cycle.grid(), coarse.cycle.grid());
        let between = |axis: &Axis, other: &Axis| -> Vec<Between> {
            let end = axis.nodes[axis.len() - 1];
            let place = |node: &f64| if end > 0.0 { node / end } else { 0.0 };
            axis.unknown().map(|i| Between::at(place(&axis.nodes[i]), &other.nodes)).collect()
        };
        let (along, across) = (between(&to.x, &from.x), between(&to.y, &from.y));
        let (rows, columns) = (from.x.unknown(), from.y.unknown().len());
        // On the edges Z is the gap, of which it is a multiple.
        let ratio = self.gap[0] / coarse.gap[0];
        let at = |field: &[f64], i: usize, j: usize| {
            let inside = rows.contains(&i) && j < columns;
            ratio * if inside { field[(i - rows.start) * columns + j] } else { coarse.gap[0] }
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

    /// Marches one cycle without acceleration; `record` receives it, its first frame being the present state. Returns the largest change of
    /// ln Z.
    pub(super) fn transient_cycle(
        &mut self,
        stats: &mut Stats,
        cancel: &Cancel,
        record: &mut dyn FnMut(&Self),
    ) -> Result<f64, Interrupted> {
        let before = self.state.clone();
        for step in 1..self.steps() {
            if cancel.is_cancelled() {
                return Err(Interrupted::Cancelled);
            }
            self.advance(self.dt[step], step, step, stats)?;
        }
        record(self);
        self.advance(self.dt[0], self.steps(), 0, stats)?;
        self.cycle.remember(true);
        Ok(self.state.change_since(&before))
    }

    /// One step in the time `dt` \[s\], to step `m` of the cycle.
    fn advance(&mut self, dt: f64, step: usize, m: usize, stats: &mut Stats) -> Result<(), Interrupted> {
        let nx = self.cycle.grid().x.len();
        let here = m * nx..(m + 1) * nx;
        *stats += self
            .cycle
            .advance(m, &self.gap[here.clone()], None, dt, &mut self.state, &mut self.line[here])
            .map_err(|source| Interrupted::Failed { step, source })?;
        Ok(())
    }

    pub(super) fn converge(
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
        let mut present: Vec<f64> = self.state.logarithms().collect();
        let mut image = Vec::with_capacity(present.len());
        for round in 1..=plan.round_limit {
            *stats += self.cycle.march(&self.gap, None, |m| self.dt[m], &mut self.state, &mut self.line, cancel)?;
            stats.cycles += 1;
            self.cycle.shift(&mut self.state);
            image.clear();
            image.extend(self.state.logarithms());
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
            self.state.set_logarithms(&present);
        }
        Ok(Status::NotConverged { residual: self.residual, tolerance: plan.tolerance.min(self.allowed_change(plan)) })
    }

    /// The limit of gas that has no time to leave: Z is the same everywhere and at all times, and is determined by the edges
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

    /// Allowed change of ln Z from round to round. Its effect on the load is a fraction of the error asked for, or of the load where the
    /// grid is prescribed.
    fn allowed_change(&self, plan: &Plan) -> f64 {
        let share = if plan.accuracy == 0.0 { plan.tolerance } else { REPEATING_SHARE * plan.accuracy };
        let grid = self.cycle.grid();
        let area = grid.interior_width() * grid.x.copies() * grid.x.lengths.iter().sum::<f64>();
        let force = self.ambient_pressure * area + self.mean_load();
        (share * self.unit() / force).max(LEAST_CHANGE)
    }

    /// The film of one cycle, lengths are those of the whole plate; and the absolute pressure at every node, if `maps`,
    /// `[frame][ix][iy]`.
    pub(super) fn fields(&self, plate: &Plate, maps: bool) -> (LineLoads, Vec<f64>) {
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
            radial: grid.x.radial,
            touching_from: 0.0,
            contact: vec![0.0; frames * nx],
            film,
            film_thickness: self.frames.gap.iter().flat_map(|h| std::iter::repeat_n(*h, nx)).collect(),
            peak,
            ambient: (0..nx).map(|ix| if grid.x.unknown().contains(&ix) { ambient * width } else { 0.0 }).collect(),
        };
        (lines, pressure)
    }

    /// The cycle as it is drawn and exported: this, the finest grid, extrapolated with the `coarser` ones, coarse to fine; of a plate that
    /// `plan` solves turned, turned back.
    pub(super) fn recording(&self, plate: &Plate, plan: &Plan, coarser: &[LineLoads]) -> Recording {
        let grid = self.cycle.grid();
        let (lines, pressure) = self.fields(plate, plan.maps || plan.turned);
        let base = Recording {
            period: self.period,
            stator: vec![0.0; lines.film.len()],
            map_x: grid.x.nodes.clone(),
            map_y: grid.y.nodes.clone(),
            half_width: true,
            half_length: true,
            ..Recording::default()
        };
        let balance = Balance { load: None, min_spacing: 0.0, exclusive: true };
        let mut recording = base.of_lines(lines, coarser, &balance, pressure, grid.y.unknown());
        if plan.turned {
            self.turn(&mut recording, plan.maps);
        }
        recording
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

impl GridState for PlateLevel {
    /// Mean load over all frames, and over those of the next coarser grid \[N\].
    fn headline(&self) -> Mean {
        let nx = self.cycle.grid().x.len();
        let (mut line, mut all, mut shared) = (vec![0.0; nx], 0.0, 0.0);
        let frames = self.frames.len();
        for frame in 0..frames {
            self.frames.mix(frame, &mut line, |m, ix| self.line[m * nx + ix]);
            let load = self.load(&line, self.frames.gap[frame]);
            all += load;
            shared += if frame % 2 == 0 { load } else { 0.0 };
        }
        let all = all / frames as f64;
        // Every other one of an odd number of frames is no grid.
        Mean { all, shared: if frames.is_multiple_of(2) { 2.0 * shared / frames as f64 } else { all } }
    }

    fn now(&self) -> f64 {
        self.load(&self.line[..self.cycle.grid().x.len()], self.gap[0])
    }

    fn steps(&self) -> usize {
        self.dt.len()
    }

    /// See [`unit`].
    fn unit(&self) -> f64 {
        let loads = self.loads();
        let (low, high) = loads.iter().fold((0.0f64, 0.0f64), |(low, high), load| (low.min(*load), high.max(*load)));
        unit(self.mean_load(), high - low)
    }

    fn across(&self) -> usize {
        self.cycle.grid().y.unknown().len()
    }

    fn count(&self, stats: &mut Stats) {
        stats.film_nodes = self.cycle.grid().nodes();
        stats.steps_per_cycle = self.steps();
    }
}
