//! The cycle of one grid in the form that is drawn and exported.

use super::MotorLevel;
use crate::film::grid::Start;
use crate::plan::Plan;
use crate::problem::Motor;
use crate::recording::{Balance, LineLoads, Recording, Touching};

impl MotorLevel {
    /// Film, contact and gap of the cycle.
    pub(in crate::motor) fn line_loads(&self, motor: &Motor) -> LineLoads {
        let x = &self.grid().x;
        let (rows, columns) = (x.unknown(), self.grid().y.unknown().len());
        let mut peak = vec![self.ambient_pressure; self.line.len()];
        for (line, peak) in peak.chunks_exact_mut(self.nx).enumerate() {
            let pressure = self.films[line / self.steps].pressure(line % self.steps);
            for (peak, across) in peak[rows.clone()].iter_mut().zip(pressure.chunks_exact(columns)) {
                *peak = self.ambient_pressure * across.iter().fold(1.0, |top: f64, p| top.max(*p));
            }
        }
        LineLoads {
            radial: false,
            frames: self.steps,
            length: motor.wavelength(),
            teeth: self.teeth,
            stored_teeth: self.stored,
            pitch: motor.pitch(),
            x: x.nodes.clone(),
            node_length: x.lengths.clone(),
            touching_from: motor.touching_from(),
            contact: self.contact_load.clone(),
            film: (0..self.line.len()).map(|i| self.film_line_load(i - i % self.nx, i % self.nx)).collect(),
            film_thickness: self.film_thickness.clone(),
            peak,
            ambient: (0..self.nx)
                .map(|ix| if rows.contains(&ix) { self.ambient_pressure * self.interior_width } else { 0.0 })
                .collect(),
        }
    }

    /// The cycle in the form that is drawn and exported: the lines of this, the finest grid, extrapolated with those of the `coarser` ones,
    /// coarse to fine, or without extrapolation if there are none.
    pub(in crate::motor) fn recording(&self, motor: &Motor, plan: &Plan, coarser: &[LineLoads]) -> Recording {
        let grid = self.grid();
        let nx = self.nx;
        let mut stator = vec![0.0; self.line.len()];
        for s in 0..self.instants() {
            for tooth in 0..self.teeth {
                let (to, from) = (self.line_of(tooth, s), (s * self.teeth + tooth) * nx);
                stator[to..to + nx].copy_from_slice(&self.stator[from..from + nx]);
            }
        }
        let balance = Balance {
            load: Some(motor.load),
            min_spacing: motor.least_thickness(),
            exclusive: motor.surface.asperities.is_none(),
        };
        let films = if plan.maps { &self.films[..] } else { &[] };
        let pressure = films.iter().flat_map(|film| film.full_pressure(self.ambient_pressure)).collect();
        let base = Recording {
            forced: plan.forced,
            touching: Touching { min_spacing: motor.spacing(), compliance: self.contact.modes().local_compliance() },
            rotor: plan.rotor.clone(),
            period: motor.period(),
            stator,
            map_x: grid.x.nodes.clone(),
            map_y: grid.y.nodes.clone(),
            half_width: grid.y.start == Start::Mirror,
            ..Recording::default()
        };
        base.of_lines(self.line_loads(motor), coarser, &balance, pressure, grid.y.unknown())
    }
}
