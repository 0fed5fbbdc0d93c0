//! A plate from rest, cycle after cycle, on all grids of a plan at once.

use super::gas_force;
use super::level::PlateLevel;
use super::result::add_errors;
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
    width_errors: [f64; 4],
}

impl PlateTransient {
    /// From rest at the mean gap, gas at ambient pressure, to the widest gap, where the first cycle begins. `width_errors`: those of mean,
    /// least and greatest load \[N\] and of the highest pressure \[Pa\], by the nodes across; `stats`: what all has cost so far, to which this is added.
    ///
    /// # Errors
    /// [`Interrupted::Failed`] if a film step has no solution to working precision.
    pub fn at_rest(plate: &Plate, plan: &Plan, width_errors: [f64; 4], stats: &mut Stats) -> Result<Self, Interrupted> {
        // It does not repeat, as frames between steps would ask.
        let plan = plan.even_steps();
        let plate = if plan.turned { plate.turned() } else { plate.clone() };
        let mut levels: Vec<PlateLevel> = plan.grids.iter().map(|grid| PlateLevel::new(&plate, &plan, grid)).collect();
        levels.iter_mut().try_for_each(|level| level.rest(plate.mean_gap, stats))?;
        Ok(Self { plate, plan, levels, width_errors })
    }

    /// The next cycle, from the present instant on; `stats`: what all has cost so far, to which this is added. `None` if cancelled.
    ///
    /// # Errors
    /// [`Interrupted::Failed`] if a film step has no solution to working precision.
    pub fn cycle(&mut self, stats: &mut Stats, cancel: &Cancel) -> Result<Option<TransientCycle>, Interrupted> {
        let (plate, plan) = (&self.plate, &self.plan);
        let [elsewhere, least, greatest, pressure] = self.width_errors;
        let marched = march_cycle(
            &mut self.levels,
            stats,
            |level, stats, record| level.transient_cycle(stats, cancel, record),
            |level| level.fields(plate, false).0,
            |level, coarser| level.recording(plate, plan, coarser),
        );
        let Marched { mut recording, change, mean, end } = match marched {
            Err(Interrupted::Cancelled) => return Ok(None),
            marched => marched?,
        };
        let of_gas = plan.left_out + elsewhere.max(least).max(greatest) / gas_force(plate, mean.value);
        recording.judge_series(of_gas, of_gas, 1.0);
        let mut result = PlateResult::of(&recording);
        add_errors(&mut result, [least, greatest, pressure, 0.0, 0.0]);
        // Its frames begin with the start of the cycle, and have not its end.
        let grown = end - recording.film_load[0];
        let load = &mut result.film_load;
        load.value += 0.5 * grown / recording.frames as f64;
        load.error = mean.error * plan.irregular + (load.value - mean.value).abs() + elsewhere;
        Ok(Some(TransientCycle { outcome: Outcome::Plate(result), recording, change, elsewhere, unsettled: None }))
    }
}
