//! A plate from rest, cycle after cycle, on all grids of a plan at once.

use super::level::PlateLevel;
use crate::control::Cancel;
use crate::film::cycle::Interrupted;
use crate::ladder::{Marched, TransientCycle, march_cycle};
use crate::plan::Plan;
use crate::problem::Plate;
use crate::solution::{Outcome, PlateResult, Stats};

/// A plate from rest, cycle after cycle ([`mod@crate::startup`]), on all grids of a plan at once.
#[derive(Debug)]
pub struct PlateTransient {
    plate: Plate,
    plan: Plan,
    levels: Vec<PlateLevel>,
    width_error: f64,
}

impl PlateTransient {
    /// From rest at the mean gap, gas at ambient pressure, to the widest gap, where the first cycle begins. `width_error`: that of the mean
    /// load, by the nodes across \[N\]; `stats`: what all has cost so far, to which this is added.
    ///
    /// # Errors
    /// [`Interrupted::Failed`] if a film step has no solution to working precision.
    pub fn at_rest(plate: &Plate, plan: &Plan, width_error: f64, stats: &mut Stats) -> Result<Self, Interrupted> {
        // It does not repeat, as frames between steps would ask.
        let plan = plan.even_steps();
        let plate = if plan.turned { plate.turned() } else { plate.clone() };
        let mut levels: Vec<PlateLevel> = plan.grids.iter().map(|grid| PlateLevel::new(&plate, &plan, grid)).collect();
        levels.iter_mut().try_for_each(|level| level.rest(plate.mean_gap, stats))?;
        Ok(Self { plate, plan, levels, width_error })
    }

    /// The next cycle, from the present instant on; `stats`: what all has cost so far, to which this is added. `None` if cancelled.
    ///
    /// # Errors
    /// [`Interrupted::Failed`] if a film step has no solution to working precision.
    pub fn cycle(&mut self, stats: &mut Stats, cancel: &Cancel) -> Result<Option<TransientCycle>, Interrupted> {
        let (plate, plan, elsewhere) = (&self.plate, &self.plan, self.width_error);
        let marched = march_cycle(
            &mut self.levels,
            stats,
            |level, stats, told| level.transient_cycle(stats, cancel, told),
            |level| level.fields(plate, false).0,
            |level, coarser| level.recording(plate, plan, coarser),
        );
        let Marched { mut recording, change, mean, end } = match marched {
            Err(Interrupted::Cancelled) => return Ok(None),
            marched => marched?,
        };
        recording.judge_series(plan.left_out, plan.left_out, 1.0);
        let mut result = PlateResult::of(&recording);
        // Its frames begin with the start of the cycle, and have not its end.
        let grown = end - recording.film_load[0];
        let load = &mut result.film_load;
        load.value += 0.5 * grown / recording.frames as f64;
        load.error = mean.error + (load.value - mean.value).abs() + elsewhere;
        Ok(Some(TransientCycle { outcome: Outcome::Plate(result), recording, change, elsewhere, unsettled: None }))
    }
}
