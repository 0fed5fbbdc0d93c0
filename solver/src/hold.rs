//! A plate held by hand: its gap is prescribed by the hand, and the film responds with a force.
//!
//! The film of [`crate::plate`] under a gap h(t) that is not known in advance, marched in the film's own time. This module knows no window
//! and no clock: the caller says to which gap the plate moves, and within what time. Two grids are marched side by side, the finer one with
//! twice the intervals and twice the steps; the force is extrapolated from both, and their difference is its stated error.
//!
//! A plate under a load may be released: it is then a mass on which its weight and the film act, above a face that vibrates,
//!
//! ```text
//! m z̈ = F − m g,      h = z + a(t) cos φ,  φ̇ = ω
//! ```
//!
//! marched by Verlet's method, which is of second order, with the film's force at the end of each step. The plate bounces on the film and
//! settles where the film carries it ([`mod@crate::plate::floating`]); without vibration it sinks until it rests on its roughness. If the
//! gap would become smaller than the roughness allows, the face strikes the plate, which takes the face's speed; this may throw it up to (a
//! ω)²/2g high.
//!
//! A step of the scheme carries W, which is Z extrapolated by half a step (`film::stepper`). When the step length changes, the
//! extrapolation is scaled in proportion: W = Z + (W − Z) Δt'/Δt. A step is at most twice as long as the one before.

use crate::estimate::extrapolate;
use crate::film::grid::FilmGrid;
use crate::film::slip::{Mobility, SlipLaw};
use crate::film::stepper::{Film, FilmError, FilmState};
use crate::numerics::bessel::ZERO_OF_J0;
use crate::plan::{Grid, Plan};
use crate::plate::film_grid;
use crate::problem::{GRAVITY, Outline, Plate};
use std::f64::consts::{PI, TAU};

/// Gaps that a plate may be held at, as multiples of its mean gap.
pub const REACH: [f64; 2] = [0.2, 3.0];
/// Largest change of ln h in a step, and the longest step as a fraction of the leak time at the present gap and pressure.
const LONGEST_MOVE: f64 = 0.04;
const LONGEST_STEP: f64 = 1.0 / 40.0;
/// Shortest step of a falling plate, as a fraction of the longest step that the plate's own motion allows.
const LEAST_STEP: f64 = 1.0 / 8.0;
/// Largest ratio of a step to the one before.
const GROWTH: f64 = 2.0;
/// Least W over Z after a change of the step.
const CARRIED_FLOOR: f64 = 0.1;

/// Warning about a plate that the vibrating face has struck ([`Free::struck`]).
pub const STRUCK: &str = "The vibrating face has struck the plate, which took the face's speed; the model does not describe how a real plate rebounds";

/// Steps in a cycle of the vibration, and the longest step as a fraction of the time in which the gas under a falling plate reverses its
/// motion.
const STEPS_IN_CYCLE: f64 = 96.0;
const SHARE_OF_BOUNCE: f64 = 0.1;
/// Cycles in which the vibration builds up or dies out.
const RAMP: f64 = 4.0;

/// Instantaneous state of a held plate, as shown to the user.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Time of the film since it was at rest \[s\].
    pub time: f64,
    /// Gap \[m\].
    pub gap: f64,
    /// Net gauge force on the plate \[N; of a strip N/m\], positive apart.
    pub force: f64,
    /// Estimated numerical error of `force`, absolute, in the same unit.
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
    let mode = match plate.outline() {
        // About that of a strip, as the circumference matters little.
        Outline::Strip | Outline::Ring { .. } => (PI / plate.section()).powi(2),
        Outline::Rectangle { aspect } => (PI / plate.length).powi(2) * (1.0 + aspect.powi(-2)),
        Outline::Disc => (ZERO_OF_J0 / plate.radius()).powi(2),
    };
    1.0 / (diffusivity * mode)
}

/// The first of equal steps, none longer than `most`, from `done` to `duration`; equal, so that the last one is not very short. `done` is
/// advanced by it.
fn even_step(done: &mut f64, duration: f64, most: f64) -> f64 {
    let left = duration - *done;
    let count = (left / most).ceil().max(1.0);
    *done = if count == 1.0 { duration } else { *done + left / count };
    left / count
}

/// A plate held above a flat face.
#[derive(Clone, Debug)]
pub struct Hold {
    plate: Plate,
    coarse: HeldFilm,
    fine: HeldFilm,
    gap: f64,
    time: f64,
    free: Free,
    /// For a released plate: the integrals over the last cycle of the vibration, and over the present one so far.
    cycle: Integrals,
    running: Integrals,
    /// Factor by which steps are shorter than usual.
    finer: f64,
}

/// The motion of a released plate; at rest while it is held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Free {
    /// Speed of the plate, upwards \[m/s\].
    pub speed: f64,
    /// Amplitude of the vibration under it now \[m\].
    pub amplitude: f64,
    /// Phase φ of the vibration \[rad\].
    pub phase: f64,
    /// Steps in which it rested on its roughness.
    pub rests: u64,
    /// Whether it has rested on its roughness while the face vibrated, that is, was struck.
    pub struck: bool,
}

/// Integrals over a period of time.
#[derive(Clone, Debug, Default)]
struct Integrals {
    /// Duration \[s\].
    time: f64,
    /// Integral of the force \[N s; of a strip N s/m\].
    impulse: f64,
    /// Integral of pressure over ambient pressure at the unknown nodes of the finer grid \[s\].
    ratio: Vec<f64>,
}

impl Integrals {
    /// Adds `step` \[s\] with this force and these pressure ratios.
    fn add(&mut self, step: f64, force: f64, ratio: impl ExactSizeIterator<Item = f64>) {
        self.ratio.resize(ratio.len(), 0.0);
        self.time += step;
        self.impulse += step * force;
        self.ratio.iter_mut().zip(ratio).for_each(|(sum, ratio)| *sum += step * ratio);
    }

    fn clear(&mut self) {
        (self.time, self.impulse) = (0.0, 0.0);
        self.ratio.clear();
    }
}

impl Free {
    /// By how much the face below is lower than in the mean \[m\].
    fn lowered(&self) -> f64 {
        self.amplitude * self.phase.cos()
    }
}

impl Hold {
    /// At rest at the mean gap, gas at ambient pressure, on the finest grid of `plan` and on one twice as fine.
    pub fn new(plate: &Plate, plan: &Plan) -> Self {
        // A hand may move fast and make layers too thin for any polynomial across to resolve.
        let plan = &plan.volumes().not_turned();
        let coarse = &plan.grids[plan.grids.len() - 1];
        let fine = HeldFilm::new(plate, plan, &coarse.finer(plan.spectral));
        Self {
            coarse: HeldFilm::new(plate, plan, coarse),
            cycle: Integrals::default(),
            running: Integrals::default(),
            fine,
            gap: plate.mean_gap,
            time: 0.0,
            free: Free::default(),
            finer: 1.0,
            plate: plate.clone(),
        }
    }

    /// Makes the steps shorter by this factor.
    pub fn finer(self, times: f64) -> Self {
        Self { finer: times, ..self }
    }

    /// Least and greatest gap that the plate may be held at \[m\].
    pub fn reach(plate: &Plate) -> [f64; 2] {
        let [lowest, most] = REACH.map(|share| share * plate.mean_gap);
        // A plate under a load rests on its roughness.
        let least = if plate.load.is_some() { lowest.max(plate.min_spacing).min(plate.mean_gap) } else { lowest };
        [least, most]
    }

    /// The gap nearest to `gap` \[m\] that the plate may be held at.
    pub fn within_reach(plate: &Plate, gap: f64) -> f64 {
        let [least, most] = Self::reach(plate);
        if gap.is_finite() { gap.clamp(least, most) } else { plate.mean_gap }
    }

    /// Moves the plate at constant speed to `gap` \[m\], or as near to it as it may come, within `duration` \[s\] of film time. If
    /// `duration` is 0, nothing flows: the trapped gas is compressed by Boyle's law.
    ///
    /// # Errors
    /// [`FilmError`] if a step has no solution to working precision.
    pub fn advance(&mut self, gap: f64, duration: f64) -> Result<(), FilmError> {
        let (from, to) = (self.gap, Self::within_reach(&self.plate, gap));
        self.held();
        if !(duration.is_finite() && duration > 0.0) {
            self.gap = to;
            for level in [&mut self.coarse, &mut self.fine] {
                level.state.carried.clone_from(&level.state.trapped);
                level.last_step = None;
            }
            return Ok(());
        }
        let moves = ((to / from).ln().abs() / LONGEST_MOVE).ceil().max(1.0);
        let mut done = 0.0;
        while done < duration {
            let step = even_step(&mut done, duration, self.longest_step(duration / moves, 0.0));
            let (now, next) = (self.gap, if done == duration { to } else { from + (to - from) * (done / duration) });
            self.step([0.5 * (now + next), next], step)?;
        }
        Ok(())
    }

    /// Ends free motion: the plate is held.
    fn held(&mut self) {
        self.free = Free::default();
        self.cycle.clear();
        self.running.clear();
    }

    /// The longest step \[s\] that the film allows, at most `most`; the leak time does not make it shorter than `least`.
    fn longest_step(&self, most: f64, least: f64) -> f64 {
        let greatest_ratio = self.fine.state.trapped.iter().fold(1.0, |most: f64, z| most.max(z / self.gap));
        let leak = leak_time(&self.plate, self.gap) / greatest_ratio;
        let most = most.min(least.max(LONGEST_STEP * leak)) / self.finer;
        self.coarse.last_step.map_or(most, |last| most.min(GROWTH * last))
    }

    /// One step of both films to the gap at its end; the finer one takes two, by way of the gap halfway.
    fn step(&mut self, [halfway, end]: [f64; 2], step: f64) -> Result<(), FilmError> {
        self.coarse.step(end, step)?;
        self.fine.step(halfway, 0.5 * step)?;
        self.fine.step(end, 0.5 * step)?;
        self.gap = end;
        self.time += step;
        Ok(())
    }

    /// Lets the plate move freely for `duration` \[s\] of film time from its present position and speed, above a face that vibrates or
    /// comes to rest. A plate without a load stays where it is. Returns the gap without the vibration at the end, and the mean force over
    /// the last cycle of the vibration, or without vibration the force of the last step. [`Self::mean_pressure`] gives the pressure
    /// averaged in the same way.
    ///
    /// # Errors
    /// [`FilmError`] if a step has no solution to working precision.
    pub fn fall(&mut self, duration: f64, vibrates: bool) -> Result<Reading, FilmError> {
        let Some(load) = self.plate.load else { return Ok(self.reading()) };
        let (mass, omega) = (load / GRAVITY, TAU * self.plate.frequency);
        let gas = self.plate.gas.ambient_pressure * self.plate.area();
        let wanted = if vibrates { self.plate.amplitude } else { 0.0 };
        let (mut force, mut done) = (self.reading().force, 0.0);
        while done < duration {
            let free = self.free;
            let moving = free.amplitude > 0.0 || wanted > 0.0;
            let cycle = if moving { TAU / (omega * STEPS_IN_CYCLE) } else { f64::INFINITY };
            let bounce = SHARE_OF_BOUNCE * (mass * self.gap / (gas + force.max(0.0))).sqrt();
            let closing = (free.speed - omega * free.amplitude * free.phase.sin()).abs();
            let approach = LONGEST_MOVE * self.gap / closing.max(f64::MIN_POSITIVE);
            let most = cycle.min(bounce).min(approach);
            // A film that leaks much faster than the plate moves is quasi-steady: its leak time does not limit the step.
            let step = even_step(&mut done, duration, self.longest_step(most, LEAST_STEP * most));
            let ramp = self.plate.amplitude * omega * step / (TAU * RAMP);
            let towards = |share: f64| free.amplitude + (wanted - free.amplitude).clamp(-share * ramp, share * ramp);
            let speed = free.speed + 0.5 * step * (force / mass - GRAVITY);
            let height = self.gap - free.lowered();
            let at = |share: f64| {
                let then = Free { amplitude: towards(share), phase: free.phase + share * omega * step, ..free };
                (then, height + share * step * speed + then.lowered())
            };
            let ((_, halfway), (mut free, end)) = (at(0.5), at(1.0));
            let least = self.plate.min_spacing;
            self.integrate(0.5 * step, force);
            self.step([halfway.max(least), end.max(least)], step)?;
            force = self.reading().force;
            self.integrate(0.5 * step, force);
            free.speed = speed + 0.5 * step * (force / mass - GRAVITY);
            if end <= least {
                // The plate moves with the face that it rests on.
                free.speed = omega * free.amplitude * free.phase.sin();
                free.rests += 1;
                free.struck |= free.amplitude > 0.0;
            }
            if !moving || free.phase >= TAU {
                std::mem::swap(&mut self.cycle, &mut self.running);
                self.running.clear();
            }
            free.phase %= TAU;
            self.free = free;
        }
        let mean = self.lately().map_or(force, |lately| lately.impulse / lately.time);
        let ambient = self.plate.gas.ambient_pressure;
        let (ratio, mean_pressure) = (mean / gas, ambient * (1.0 + mean / gas));
        Ok(Reading { gap: self.height(), force: mean, ratio, mean_pressure, ..self.reading() })
    }

    /// Adds `step` \[s\] with the present state to the integrals of this cycle.
    fn integrate(&mut self, step: f64, force: f64) {
        let gap = self.gap;
        self.running.add(step, force, self.fine.state.trapped.iter().map(|z| z / gap));
    }

    /// The integrals of the last cycle, or of the first one so far; `None` for a plate that was not released.
    fn lately(&self) -> Option<&Integrals> {
        [&self.cycle, &self.running].into_iter().find(|lately| lately.time > 0.0)
    }

    /// Whether the plate is at rest and the face does not vibrate.
    pub fn is_still(&self) -> bool {
        self.free.speed == 0.0 && self.free.amplitude == 0.0
    }

    /// Speed of the plate and state of the vibration under it; at rest while it is held.
    pub fn free(&self) -> Free {
        self.free
    }

    /// The gap without the vibration \[m\].
    pub fn height(&self) -> f64 {
        self.gap - self.free.lowered()
    }

    /// Puts the plate to rest at `gap` \[m\], without limits, with gas at ambient pressure.
    pub fn rest_at(&mut self, gap: f64) {
        (self.gap, self.time) = (gap, 0.0);
        self.held();
        for level in [&mut self.coarse, &mut self.fine] {
            level.rest(gap);
        }
    }

    /// Back to rest at the mean gap.
    pub fn reset(&mut self) {
        self.rest_at(self.plate.mean_gap);
    }

    /// Gap \[m\].
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// Reading of the present state.
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

    /// Nodes of the finer grid: a quarter of a rectangle, half the length of a strip, the radius of a round plate.
    pub fn grid(&self) -> &FilmGrid {
        self.fine.film.grid()
    }

    /// Absolute pressure \[Pa\] at the nodes of [`Self::grid`], `[ix][iy]`; y = 0 is the middle of the width.
    pub fn pressure(&self) -> impl Iterator<Item = f64> {
        self.at_nodes(|unknown| self.fine.state.trapped[unknown] / self.gap)
    }

    /// Absolute pressure at the same nodes \[Pa\], averaged over the same time as the force that [`Self::fall`] returns.
    pub fn mean_pressure(&self) -> impl Iterator<Item = f64> {
        let lately = self.lately();
        self.at_nodes(move |unknown| match lately {
            Some(lately) => lately.ratio[unknown] / lately.time,
            None => self.fine.state.trapped[unknown] / self.gap,
        })
    }

    /// Absolute pressure \[Pa\] at all nodes, given its `ratio` to ambient pressure at the unknown nodes.
    fn at_nodes(&self, ratio: impl Fn(usize) -> f64) -> impl Iterator<Item = f64> {
        let grid = self.grid();
        let (ux, uy, ny) = (grid.x.unknown(), grid.y.unknown(), grid.y.len());
        let ambient = self.plate.gas.ambient_pressure;
        (0..grid.nodes()).map(move |i| {
            let (ix, iy) = (i / ny, i % ny);
            let inside = ux.contains(&ix) && uy.contains(&iy);
            if inside { ambient * ratio((ix - ux.start) * uy.len() + iy - uy.start) } else { ambient }
        })
    }

    /// Trapped gas \[m³, at ambient pressure; of a strip m²\] under the nodes whose pressure is unknown, extrapolated by half a step: the
    /// quantity that a step of the scheme conserves.
    pub fn carried_gas(&self) -> f64 {
        self.fine.sum(&self.fine.state.carried)
    }

    /// Largest deviation of the pressure from ambient at any node, |p/p_a − 1|.
    pub fn unrest(&self) -> f64 {
        let ratios = self.fine.state.trapped.iter().map(|z| z / self.gap);
        ratios.fold(0.0, |most: f64, ratio| most.max((ratio - 1.0).abs()))
    }
}

/// The film on one grid.
#[derive(Clone, Debug)]
struct HeldFilm {
    film: Film,
    state: FilmState,
    /// The gap at each node along x.
    h: Vec<f64>,
    /// The last step \[s\]; `None` at rest.
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

    /// Sum of `field` × area over the unknown nodes of the whole plate.
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
