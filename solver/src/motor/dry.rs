//! The same motor without its film: contact alone, in a vacuum.
//!
//! Without gas there is no memory of earlier instants, so every instant is one contact problem (`contact`, with no gas at any node) and
//! there is no periodic state to find. Nodes and rotor are those of the plan, so that the difference to the solve with film is the effect
//! of the film, not of the grid. There are twice as many instants, since they cost little.

use super::MotorError;
use super::ending::unless_cancelled;
use super::level::MotorLevel;
use crate::control::Cancel;
use crate::plan::{Grid, Plan};
use crate::problem::{Flow, Motor};
use crate::recording::LineLoads;

/// The contact of one cycle on each of the plan's grids at twice its steps, coarse to fine, one tooth stored; `None` if cancelled.
///
/// # Errors
/// [`MotorError::Contact`] if a contact problem has no solution to working precision.
pub fn without_film(motor: &Motor, plan: &Plan, cancel: &Cancel) -> Result<Option<Vec<LineLoads>>, MotorError> {
    // Nothing is solved across the width, so the nodes across need no memory.
    let plan = Plan { every_tooth: false, trapped: false, shear: false, flow: Flow::Along, ..plan.clone() };
    let mut cycles = Vec::with_capacity(plan.grids.len());
    for grid in &plan.grids {
        let mut level = MotorLevel::new(motor, &plan, &Grid { steps: 2 * grid.steps, ..*grid });
        let Some(()) = unless_cancelled(level.dry(level.instants(), cancel))? else { return Ok(None) };
        let lines = level.line_loads(motor);
        cycles.push(LineLoads {
            film: vec![0.0; lines.film.len()],
            film_thickness: Vec::new(),
            peak: Vec::new(),
            ambient: Vec::new(),
            ..lines
        });
    }
    Ok(Some(cycles))
}
