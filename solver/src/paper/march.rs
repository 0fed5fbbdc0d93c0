//! The state of the motor and one time step: the inner loop of the paper's Fig. 1.

use super::contact::{Balance, Contact};
use super::film::FactoredFilm;
use super::mesh::{Mesh, Meshes};
use crate::problem::Motor;
use crate::rotor::Compliances;

/// Change of pressure and of film thickness in a round of the inner loop, relative to the greatest, at which the loop has converged.
pub(super) const INNER_TOLERANCE: f64 = 1e-3;
/// Most rounds of the inner loop in a time step.
const INNER_ROUNDS: usize = 40;
/// Rounds without a smaller change after which the inner loop counts as not converging.
const INNER_STALLED: usize = 8;
/// Pressure \[p_a\] beyond which the march counts as having blown up.
const BLOWN_UP: f64 = 1e4;

/// Outcome of one time step.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepOutcome {
    /// Whether pressure and spacing settled.
    pub(super) settled: bool,
    /// Change of pressure or film thickness in the last round of the inner loop, relative to the greatest of each,
    /// whichever is greater.
    pub(super) change: f64,
    /// Difference between the load and the sum of film and contact load, relative to L.
    pub(super) imbalance: f64,
    /// How the last contact problem ended.
    pub(super) balance: Balance,
    /// Whether the state is finite and below `BLOWN_UP`; if not, the step was not taken.
    pub(super) sound: bool,
}

/// Films, rotor and contact at one instant. All films are scaled as in [`super::film`], forces are in N.
#[derive(Clone, Debug)]
pub(super) struct March<'a> {
    pub(super) motor: &'a Motor,
    pub(super) meshes: Meshes,
    pub(super) film: FactoredFilm,
    pub(super) contact: Contact,
    pub(super) steps: usize,
    /// Z, `[tooth][ix][iy]`, and h, `[tooth][ix]`, at the instant reached.
    pub(super) z: Vec<f64>,
    pub(super) h: Vec<f64>,
    /// Pressure \[p_a\], `[tooth][ix][iy]`, and its gauge line load \[N/m\], `[tooth][ix]`.
    pub(super) p: Vec<f64>,
    pub(super) line: Vec<f64>,
    /// Film's nodal force \[N\], per top.
    pub(super) nodal: Vec<f64>,
    /// Gap \[m\], per entry.
    pub(super) gap: Vec<f64>,
    z_new: Vec<f64>,
    h_new: Vec<f64>,
    stator_top: Vec<f64>,
    stator: Vec<f64>,
    wedge: Vec<f64>,
    /// Rounds of the inner loop in all steps.
    pub(super) rounds: u64,
    /// Contact problems solved.
    pub(super) contact_solves: u64,
}

impl<'a> March<'a> {
    /// Everything at rest at t = 0: ambient pressure, the rotor pressed on the stator without a film.
    pub(super) fn new(motor: &'a Motor, rotor: &Compliances, mesh: &Mesh, knudsen: f64) -> Self {
        let Mesh { nx, ny, n, steps } = *mesh;
        let meshes = Meshes::new(motor, n, nx);
        let contact = Contact::new(motor, rotor, &meshes);
        let (b, h_m) = (motor.tooth_width, motor.min_spacing);
        let film = FactoredFilm::new(nx, ny, motor.contact_width / b, squeeze_number(motor), knudsen);
        let (teeth, nodes) = (motor.teeth, film.nodes());
        let mut march = Self {
            z: vec![0.0; teeth * nodes],
            h: vec![0.0; teeth * nx],
            p: vec![1.0; teeth * nodes],
            line: vec![0.0; teeth * nx],
            nodal: vec![0.0; meshes.tops.len()],
            gap: vec![0.0; meshes.entries.len()],
            z_new: vec![0.0; teeth * nodes],
            h_new: vec![0.0; teeth * nx],
            stator_top: vec![0.0; meshes.tops.len()],
            stator: vec![0.0; meshes.entries.len()],
            wedge: vec![0.0; nx],
            rounds: 0,
            contact_solves: 0,
            motor,
            meshes,
            film,
            contact,
            steps,
        };
        march.move_stator(0.0);
        // "The positively displaced stator teeth contact the rotor."
        for (touching, &stator) in march.contact.touching.iter_mut().zip(&march.stator_top) {
            *touching = stator > 0.0;
        }
        march.meet();
        march.thicken(h_m);
        std::mem::swap(&mut march.h, &mut march.h_new);
        for (column, &h) in march.z.chunks_exact_mut(ny).zip(&march.h) {
            column.fill(h);
        }
        march
    }

    /// One time step, from t = `step` T/steps to t = (`step` + 1) T/steps.
    pub(super) fn advance(&mut self, step: usize) -> StepOutcome {
        self.move_stator((step + 1) as f64 / self.steps as f64);
        let dtau = std::f64::consts::TAU / self.steps as f64;
        let half_step = (step as f64 + 0.5) / self.steps as f64;
        let mut result =
            StepOutcome { settled: false, change: 0.0, imbalance: 0.0, balance: Balance::Held, sound: true };
        let (mut least, mut least_at) = (f64::INFINITY, 0);
        // The first guess of the pressure is that of the last step, which `nodal` still holds.
        for round in 0..INNER_ROUNDS {
            self.rounds += 1;
            result.balance = self.meet();
            let moved = self.thicken(self.motor.min_spacing);
            for tooth in 0..self.motor.teeth {
                self.step_film(tooth, half_step, dtau);
            }
            let (changed, greatest) = self.press();
            result.sound = moved.is_finite() && greatest < BLOWN_UP;
            if !result.sound {
                return result;
            }
            result.change = moved.max(changed / greatest);
            // The first round's change is due to the time step, so it does not count.
            result.settled = round > 0 && result.change < INNER_TOLERANCE;
            if result.change < least {
                (least, least_at) = (result.change, round);
            }
            if result.settled || round - least_at >= INNER_STALLED {
                break;
            }
        }
        let carried = self.nodal.iter().sum::<f64>() + self.contact.force.iter().sum::<f64>();
        result.imbalance = (carried / self.motor.load - 1.0).abs();
        std::mem::swap(&mut self.z, &mut self.z_new);
        std::mem::swap(&mut self.h, &mut self.h_new);
        result
    }

    fn move_stator(&mut self, t_over_period: f64) {
        for (stator, entry) in self.stator.iter_mut().zip(&self.meshes.entries) {
            *stator = self.motor.stator_displacement(entry.x, entry.xi, t_over_period);
        }
        for (stator, top) in self.stator_top.iter_mut().zip(&self.meshes.tops) {
            *stator = self.stator[top.entry];
        }
    }

    /// The contact problem under the film's present pressure.
    fn meet(&mut self) -> Balance {
        self.contact_solves += 1;
        let balance = self.contact.solve(&self.nodal, &self.stator_top);
        for ((gap, &stator), entry) in self.gap.iter_mut().zip(&self.stator).zip(&self.meshes.entries) {
            *gap = (self.contact.rotor[entry.node] - stator).max(0.0);
        }
        balance
    }

    /// h = gap + H_m on the film meshes, into `h_new`; returns the greatest change from what `h_new` held, relative to
    /// the greatest h.
    fn thicken(&mut self, h_m: f64) -> f64 {
        let nx = self.film.nx();
        let (mut moved, mut greatest) = (0.0_f64, 0.0_f64);
        for tooth in 0..self.motor.teeth {
            let gap = &self.gap[self.meshes.first[tooth]..self.meshes.first[tooth + 1]];
            for i in tooth * nx..(tooth + 1) * nx {
                let h = 1.0 + self.meshes.to_film[i].of(gap) / h_m;
                moved = worst(moved, (h - self.h_new[i]).abs());
                greatest = worst(greatest, h);
                self.h_new[i] = h;
            }
        }
        moved / greatest
    }

    fn step_film(&mut self, tooth: usize, half_step: f64, dtau: f64) {
        let (nx, nodes) = (self.film.nx(), self.film.nodes());
        let wedge = if self.motor.shear {
            let scale = bearing_per_speed(self.motor);
            let b = self.motor.tooth_width;
            for (i, lambda) in self.wedge.iter_mut().enumerate() {
                let x = tooth as f64 * self.motor.pitch() + b * (i as f64 / (nx - 1) as f64 - 0.5);
                *lambda = scale * self.motor.sliding_speed(x, half_step);
            }
            Some(self.wedge.as_slice())
        } else {
            None
        };
        let (field, line) = (tooth * nodes..(tooth + 1) * nodes, tooth * nx..(tooth + 1) * nx);
        self.film.step(
            &self.z[field.clone()],
            &self.h[line.clone()],
            &self.h_new[line],
            wedge,
            dtau,
            &mut self.z_new[field],
        );
    }

    /// Pressure and its loads from `z_new`; returns the greatest change of p and the greatest |p|.
    fn press(&mut self) -> (f64, f64) {
        let (nx, ny, nodes) = (self.film.nx(), self.film.ny(), self.film.nodes());
        let (mut changed, mut greatest) = (0.0_f64, 0.0_f64);
        for ((p, z), &h) in self.p.chunks_exact_mut(ny).zip(self.z_new.chunks_exact(ny)).zip(&self.h_new) {
            let inverse = 1.0 / h;
            for (p, &z) in p.iter_mut().zip(z) {
                let now = z * inverse;
                changed = worst(changed, (now - *p).abs());
                greatest = worst(greatest, now.abs());
                *p = now;
            }
        }
        let scale = self.motor.gas.ambient_pressure * self.motor.tooth_width;
        for tooth in 0..self.motor.teeth {
            let line = &mut self.line[tooth * nx..(tooth + 1) * nx];
            self.film.line_load(&self.p[tooth * nodes..(tooth + 1) * nodes], line);
            for load in line {
                *load *= scale;
            }
        }
        self.nodal.fill(0.0);
        let dx = self.motor.tooth_width / (nx - 1) as f64;
        // The edges need no half weight: p = p_a there.
        for (line, share) in self.line.iter().zip(&self.meshes.shares) {
            self.nodal[share.low] += (1.0 - share.weight) * line * dx;
            self.nodal[share.high] += share.weight * line * dx;
        }
        (changed, greatest)
    }
}

/// The greater of two, or NaN if either is: `f64::max` would hide it.
fn worst(a: f64, b: f64) -> f64 {
    if b <= a { a } else { b }
}

/// σ = 12 μ ω b²/(p_a H_m²).
fn squeeze_number(motor: &Motor) -> f64 {
    let omega = std::f64::consts::TAU * motor.frequency;
    let reach = motor.tooth_width / motor.min_spacing;
    12.0 * motor.gas.viscosity * omega * reach * reach / motor.gas.ambient_pressure
}

/// Λ/U = 6 μ b/(p_a H_m²).
fn bearing_per_speed(motor: &Motor) -> f64 {
    6.0 * motor.gas.viscosity * motor.tooth_width / (motor.gas.ambient_pressure * motor.min_spacing * motor.min_spacing)
}
