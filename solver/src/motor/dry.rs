//! The same motor without its film: contact alone, in a vacuum.
//!
//! Without gas nothing remembers, so every instant is one contact problem (`contact`, with no gas at any node) and there
//! is no periodic state to look for. Grids and rotor are those of the plan, so that what the film changes is not what
//! another grid changes.

use super::MotorError;
use crate::contact::{Contact, Instant, Modes, Shape};
use crate::control::Cancel;
use crate::film::grid::{Axis, Start};
use crate::plan::Plan;
use crate::problem::Motor;
use crate::recording::LineLoads;

/// The contact of one cycle on each of the plan's grids, coarse to fine, one tooth stored; `None` if cancelled.
///
/// # Errors
/// [`MotorError::Contact`] if a contact problem has no solution to working precision.
pub fn without_film(motor: &Motor, plan: &Plan, cancel: &Cancel) -> Result<Option<Vec<LineLoads>>, MotorError> {
    let mut cycles = Vec::with_capacity(plan.grids.len());
    for grid in &plan.grids {
        let axis = Axis::clustered(0.5 * motor.tooth_width, Start::Ambient, grid.along, plan.clustering_along);
        let (nx, teeth, steps) = (axis.len(), motor.teeth, grid.steps);
        let nodes = teeth * nx;
        let positions: Vec<f64> = (0..nodes).map(|i| (i / nx) as f64 * motor.pitch() + axis.nodes[i % nx]).collect();
        let lengths = (0..nodes).map(|i| axis.lengths[i % nx]).collect();
        let harmonics = plan.harmonics(grid);
        let modes = Modes::new(&plan.rotor, harmonics, &positions);
        let nothing = vec![0.0; nodes];
        let mut contact =
            Contact::new(modes, lengths, &nothing, motor.gas.ambient_pressure, motor.min_spacing, motor.load)
                .on(motor.surface.asperities, motor.contact_width);
        let (mut shape, mut fields) = (Shape::unknown(), Instant::default());
        let mut load = vec![0.0; steps * nx];
        let instants = steps / teeth;
        for s in 0..instants {
            if cancel.is_cancelled() {
                return Ok(None);
            }
            let phase = s as f64 / steps as f64;
            let stator: Vec<f64> =
                (0..nodes).map(|i| motor.stator_displacement(positions[i], axis.nodes[i % nx], phase)).collect();
            contact
                .solve(&stator, &nothing, &mut shape, &mut fields)
                .map_err(|source| MotorError::Contact { instant: s, source })?;
            // Tooth k now is the first tooth k/teeth of a cycle later.
            for tooth in 0..teeth {
                let to = (s + tooth * instants) % steps * nx;
                load[to..to + nx].copy_from_slice(&fields.contact[tooth * nx..(tooth + 1) * nx]);
            }
        }
        cycles.push(LineLoads {
            frames: steps,
            length: motor.wavelength(),
            teeth,
            stored_teeth: 1,
            pitch: motor.pitch(),
            x: axis.nodes,
            node_length: axis.lengths,
            touching_from: motor.touching_from(),
            film: vec![0.0; load.len()],
            contact: load,
            ..LineLoads::default()
        });
    }
    Ok(Some(cycles))
}
