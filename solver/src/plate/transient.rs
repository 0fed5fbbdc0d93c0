//! A plate from rest, cycle after cycle, on all grids of a plan at once.

use super::level::Level;
use crate::control::Cancel;
use crate::estimate::{extrapolate, extrapolate_means};
use crate::film::cycle::Interrupted;
use crate::ladder::State;
use crate::plan::Plan;
use crate::problem::Plate;
use crate::recording::Recording;
use crate::solution::{Outcome, PlateResult, Stats};

/// A plate from rest, cycle after cycle ([`mod@crate::startup`]), on all grids of a plan at once.
#[derive(Debug)]
pub struct Transient {
    plate: Plate,
    turned: bool,
    maps: bool,
    levels: Vec<Level>,
    /// Error of a cycle's mean load that finer grids would not make smaller: by the nodes across \[N\].
    pub width_error: f64,
    /// What it has cost so far, all grids.
    pub stats: Stats,
}

impl Transient {
    /// From rest at the mean gap, gas at ambient pressure, to the widest gap, where the first cycle begins. `width_error`: that of the mean
    /// load, by the nodes across \[N\]; `stats`: what it has cost so far.
    ///
    /// # Errors
    /// [`Interrupted::Failed`] if a film step has no solution to working precision.
    pub fn at_rest(plate: &Plate, plan: &Plan, width_error: f64, mut stats: Stats) -> Result<Self, Interrupted> {
        // It does not repeat, as frames between steps would ask.
        let plan = &plan.even_steps();
        let plate = if plan.turned { plate.turned() } else { plate.clone() };
        let mut levels: Vec<Level> = plan.grids.iter().map(|grid| Level::new(&plate, plan, grid)).collect();
        levels.iter_mut().try_for_each(|level| level.rest(plate.mean_gap, &mut stats))?;
        Ok(Self { plate, turned: plan.turned, maps: plan.maps, levels, width_error, stats })
    }

    /// The next cycle, from the present instant on: means and extremes, the fields of the finest grid, and the largest change
    /// of ln Z over it. `None` if cancelled.
    ///
    /// # Errors
    /// [`Interrupted::Failed`] if a film step has no solution to working precision.
    pub fn cycle(&mut self, cancel: &Cancel) -> Result<Option<(Outcome, Recording, f64)>, Interrupted> {
        let finest = self.levels.len() - 1;
        let (mut loads, mut ends) = (Vec::new(), Vec::new());
        let (mut coarser, mut last) = (Vec::new(), (Recording::default(), f64::INFINITY));
        for (number, level) in self.levels.iter_mut().enumerate() {
            let start = level.load_now();
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
            let end = level.load_now();
            loads.push(level.headline().from_to(start, end, level.steps()));
            ends.push(end);
            level.count(&mut self.stats);
        }
        self.stats.cycles += 1;
        let (recording, change) = last;
        let estimate = extrapolate_means(&loads);
        let mut result = PlateResult::of(&recording);
        // Its frames begin with the start of the cycle, and have not its end.
        let grown = extrapolate(&ends).value - recording.film_load[0];
        let load = &mut result.film_load;
        load.value += 0.5 * grown / recording.frames as f64;
        load.error = estimate.error + (load.value - estimate.value).abs() + self.width_error;
        Ok(Some((Outcome::Plate(result), recording, change)))
    }
}
