//! A plate held by hand: its gap is whatever the hand makes it, and the film answers.
//!
//! The film of [`crate::plate`] under a gap h(t) that nobody knows beforehand, marched in the time of the film. No window and no
//! clock: whoever holds the plate says where to, and within which time. Two grids are marched beside each other, the finer one
//! with twice the intervals and twice the steps; the force is extrapolated from both, and their difference is its stated error.
//!
//! A step of the scheme carries W, which is Z half a step ahead (`film::stepper`). Where the next step is longer or shorter, W is
//! taken that much further ahead: W = Z + (W − Z) Δt'/Δt. Steps grow twofold at most.

use crate::estimate::extrapolate;
use crate::film::grid::FilmGrid;
use crate::film::slip::{Mobility, SlipLaw};
use crate::film::stepper::{Film, FilmError, FilmState};
use crate::plan::{Grid, Plan};
use crate::plate::film_grid;
use crate::problem::Plate;
use std::f64::consts::PI;

/// Gaps that a plate may be held at, as multiples of its mean gap.
pub const REACH: [f64; 2] = [0.2, 3.0];
/// Largest change of ln h in a step, and the longest step over the leak time of the present gap and pressure.
const LONGEST_MOVE: f64 = 0.04;
const LONGEST_STEP: f64 = 1.0 / 40.0;
/// By how much a step may be longer than the one before.
const GROWTH: f64 = 2.0;
/// Least W over Z after a change of the step.
const CARRIED_FLOOR: f64 = 0.1;

/// What is read off a held plate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Time of the film since it was at rest \[s\].
    pub time: f64,
    /// Gap \[m\].
    pub gap: f64,
    /// Net gauge force on the plate \[N; of a strip N/m\], positive apart.
    pub force: f64,
    /// Estimated numerical error of `force`, absolute.
    pub error: f64,
    /// Force over ambient pressure × area.
    pub ratio: f64,
    /// Mean absolute pressure \[Pa\].
    pub mean_pressure: f64,
}

/// Leak time \[s\] of the film under `plate` at `gap` \[m\], near ambient pressure: the slowest mode of the linear film,
/// h ∂P/∂t = M h² ψ(h) ∇²P, decays as exp(−t/leak time).
pub fn leak_time(plate: &Plate, gap: f64) -> f64 {
    let mobility = plate.gas.ambient_pressure / (12.0 * plate.gas.viscosity);
    let diffusivity = mobility * gap * SlipLaw::of(&plate.gas).at(gap).0;
    let across = plate.width.map_or(0.0, |width| PI / width);
    1.0 / (diffusivity * ((PI / plate.length).powi(2) + across.powi(2)))
}

/// A plate held above its stator.
#[derive(Clone, Debug)]
pub struct Hold {
    plate: Plate,
    coarse: HeldFilm,
    fine: HeldFilm,
    gap: f64,
    time: f64,
    /// The last step \[s\]; `None` at rest.
    last_step: Option<f64>,
}

impl Hold {
    /// At rest at the mean gap, gas at ambient pressure, on the finest grid of `plan` and on one twice as fine.
    pub fn new(plate: &Plate, plan: &Plan) -> Self {
        // A hand may be fast: layers thinner than any polynomial across resolves.
        let plan = &plan.volumes().not_turned();
        let mut grids = plan.grids.iter().rev();
        let none = Grid { along: 8, across: 8, steps: 0, harmonic_fraction: 0.0 };
        let coarse = grids.next().unwrap_or(&none);
        let fine = &coarse.finer(plan.spectral);
        Self {
            coarse: HeldFilm::new(plate, plan, coarse),
            fine: HeldFilm::new(plate, plan, fine),
            gap: plate.mean_gap,
            time: 0.0,
            last_step: None,
            plate: plate.clone(),
        }
    }

    /// The gap nearest to `gap` \[m\] that the plate may be held at.
    pub fn within_reach(plate: &Plate, gap: f64) -> f64 {
        let [least, most] = REACH.map(|share| share * plate.mean_gap);
        if gap.is_finite() { gap.clamp(least, most) } else { plate.mean_gap }
    }

    /// Moves the plate evenly to `gap` \[m\], or as near as it may come, within `duration` \[s\] of the film's time. In no time
    /// nothing flows: the trapped gas is compressed as Boyle has it.
    ///
    /// # Errors
    /// [`FilmError`] if a step has no solution to working precision.
    pub fn advance(&mut self, gap: f64, duration: f64) -> Result<(), FilmError> {
        let (from, to) = (self.gap, Self::within_reach(&self.plate, gap));
        if !(duration.is_finite() && duration > 0.0) {
            self.gap = to;
            self.last_step = None;
            for level in [&mut self.coarse, &mut self.fine] {
                level.state.carried.clone_from(&level.state.trapped);
                level.last_step = None;
            }
            return Ok(());
        }
        let moves = ((to / from).ln().abs() / LONGEST_MOVE).ceil().max(1.0);
        let mut done = 0.0;
        while done < duration {
            let leak = leak_time(&self.plate, self.gap) / self.greatest_ratio();
            let most = (duration / moves).min(LONGEST_STEP * leak);
            let most = self.last_step.map_or(most, |last| most.min(GROWTH * last));
            // Equal steps to the end, so that none is a crumb.
            let left = duration - done;
            let count = (left / most).ceil().max(1.0);
            let step = left / count;
            done = if count == 1.0 { duration } else { done + step };
            let (now, next) = (self.gap, if count == 1.0 { to } else { from + (to - from) * (done / duration) });
            self.coarse.step(next, step)?;
            self.fine.step(0.5 * (now + next), 0.5 * step)?;
            self.fine.step(next, 0.5 * step)?;
            self.gap = next;
            self.time += step;
            self.last_step = Some(step);
        }
        Ok(())
    }

    /// Back to rest at the mean gap.
    pub fn reset(&mut self) {
        (self.gap, self.time, self.last_step) = (self.plate.mean_gap, 0.0, None);
        for level in [&mut self.coarse, &mut self.fine] {
            level.rest(self.gap);
        }
    }

    /// Gap \[m\].
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// What is read off now.
    pub fn reading(&self) -> Reading {
        let ambient = self.plate.gas.ambient_pressure;
        let force = extrapolate(&[&self.coarse, &self.fine].map(|level| level.force(self.gap, ambient)));
        let area = self.plate.area();
        Reading {
            time: self.time,
            gap: self.gap,
            force: force.value,
            error: force.error,
            ratio: force.value / (ambient * area),
            mean_pressure: ambient + force.value / area,
        }
    }

    /// The nodes of the finer grid: a quarter of the plate, of a strip half its length.
    pub fn grid(&self) -> &FilmGrid {
        self.fine.film.grid()
    }

    /// Absolute pressure \[Pa\] at the nodes of [`Self::grid`], `[ix][iy]`; y = 0 is the middle of the width.
    pub fn pressure(&self) -> impl Iterator<Item = f64> {
        let grid = self.grid();
        let (ux, uy, ny) = (grid.x.unknown(), grid.y.unknown(), grid.y.len());
        let (ambient, gap) = (self.plate.gas.ambient_pressure, self.gap);
        let trapped = &self.fine.state.trapped;
        (0..grid.len()).map(move |i| {
            let (ix, iy) = (i / ny, i % ny);
            let inside = ux.contains(&ix) && uy.contains(&iy);
            if inside { ambient * trapped[(ix - ux.start) * uy.len() + iy - uy.start] / gap } else { ambient }
        })
    }

    /// Trapped gas \[m³, at ambient pressure; of a strip m²\] under the nodes whose pressure is unknown, half a step ahead: what
    /// a step of the scheme balances.
    pub fn carried_gas(&self) -> f64 {
        self.fine.sum(&self.fine.state.carried)
    }

    /// Largest |p/p_a − 1|.
    pub fn unrest(&self) -> f64 {
        let ratios = self.fine.state.trapped.iter().map(|z| z / self.gap);
        ratios.fold(0.0, |most: f64, ratio| most.max((ratio - 1.0).abs()))
    }

    fn greatest_ratio(&self) -> f64 {
        self.fine.state.trapped.iter().fold(1.0, |most: f64, z| most.max(z / self.gap))
    }
}

/// The film on one grid.
#[derive(Clone, Debug)]
struct HeldFilm {
    film: Film,
    state: FilmState,
    /// The gap at each node along x.
    h: Vec<f64>,
    last_step: Option<f64>,
}

impl HeldFilm {
    fn new(plate: &Plate, plan: &Plan, grid: &Grid) -> Self {
        let nodes = film_grid(plate, plan, grid);
        let (nx, unknowns) = (nodes.x.len(), nodes.unknowns());
        Self {
            film: Film::new(nodes, &plate.gas),
            state: FilmState::at_rest(vec![plate.mean_gap; unknowns]),
            h: vec![plate.mean_gap; nx],
            last_step: None,
        }
    }

    fn rest(&mut self, gap: f64) {
        self.state.trapped.fill(gap);
        self.state.carried.fill(gap);
        self.last_step = None;
    }

    fn step(&mut self, gap: f64, dt: f64) -> Result<(), FilmError> {
        if let Some(last) = self.last_step.filter(|last| *last != dt) {
            let ratio = dt / last;
            for (w, z) in self.state.carried.iter_mut().zip(&self.state.trapped) {
                *w = (z + (*w - z) * ratio).max(CARRIED_FLOOR * z);
            }
        }
        self.h.fill(gap);
        self.film.step(&self.h, None, dt, &mut self.state, None)?;
        self.last_step = Some(dt);
        Ok(())
    }

    /// Sum of `field` × area over the unknown nodes, all quarters.
    fn sum(&self, field: &[f64]) -> f64 {
        let grid = self.film.grid();
        let (uy, copies) = (grid.y.unknown(), grid.x.copies() * grid.y.copies());
        let rows = field.chunks_exact(uy.len()).zip(grid.x.unknown());
        let row = |values: &[f64]| values.iter().zip(&grid.y.lengths[uy.clone()]).map(|(f, w)| f * w).sum::<f64>();
        copies * rows.map(|(values, ix)| row(values) * grid.x.lengths[ix]).sum::<f64>()
    }

    fn force(&self, gap: f64, ambient: f64) -> f64 {
        let gauge: Vec<f64> = self.state.trapped.iter().map(|z| ambient * (z / gap - 1.0)).collect();
        self.sum(&gauge)
    }
}
