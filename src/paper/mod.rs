//! The paper's own algorithm, literally: the yardstick that the other method is measured against.
//!
//! T. Maeno and D. B. Bogy, "Effect of the hydrodynamic bearing on rotor/stator contact in a ring-type ultrasonic
//! motor", IEEE Trans. UFFC 39 (1992). Neither made clever nor made slow: flat arrays and tridiagonal sweeps, but every
//! tooth, the full width, a uniform 51 × 11 mesh on each ([`FactoredFilm`]), 181 contact nodes in a wavelength, and
//! a march in time from ambient pressure with contact and film solved in turn.
//!
//! # One time step (the paper's Fig. 1)
//!
//! 1. The stator moves to time t.
//! 2. Contact: rotor shape and contact forces under the film's pressure, which is frozen (`contact`).
//! 3. Film: from the spacing at t − Δt and at t, and the pressure at t − Δt, the pressure at t, on every tooth (`film`).
//! 4. Until pressure and spacing at t no longer change by 1e-5 (of p_a, of H_m), back to 2, at most 20 times.
//!
//! The cycle is over when all pressures and spacings are those of one period before, to 1e-5 of the greatest. Since
//! the teeth are as many phases of one motion, comparing them at one instant compares the cycle at several.
//!
//! # What the paper leaves open, and what is done here
//!
//! * Steps in a cycle are not given: 180 unless [`Numerics`] says otherwise.
//! * The film's line load becomes nodal force by sampling at the contact nodes times their spacing, and α is the cycle
//!   mean of the sum of nodal forces over L, its equation (11).
//! * Only first-order slip, or none, fits the scheme. For any other law first-order is solved, with a warning.
//!
//! # Where it fails
//!
//! Freezing the pressure while the contact is solved is unstable for a stiff film (H_m of 50 nm or less) or a light
//! load: the film then carries all of the load at some instants, and no contact set balances it. That is reported
//! as [`Status::NotConverged`], with the numbers as reached; α may exceed 1.

mod contact;
mod film;
mod march;
mod mesh;
mod record;

pub use film::FactoredFilm;

use crate::control::{Cancel, Observer, Progress};
use crate::problem::{Motor, Numerics, Slip};
use crate::solution::{Model, MotorResult, Outcome, Solution, Stats, Status};
use contact::Balance;
use march::{INNER_ROUNDS, March};
use record::Recorder;

/// The paper's film nodes along and across a tooth, and its contact nodes in a wavelength, ends counted.
const PAPER_MESH: (usize, usize, usize) = (51, 11, 181);
/// Steps in a cycle, which the paper does not give.
const STEPS_PER_CYCLE: usize = 180;
/// Change over a cycle, relative to the greatest pressure and spacing, at which the cycle repeats.
const CYCLE_TOLERANCE: f64 = 1e-5;
/// Most cycles marched.
const CYCLES: usize = 200;
/// Cycles without a smaller change after which the march is given up.
const STALLED: usize = 20;
/// Error of α on the paper's mesh, relative: see [`discretisation_error`].
const PAPER_MESH_ERROR: f64 = 0.03;

/// Solves for the periodic state of `motor` by the paper's algorithm, on the paper's meshes unless `numerics` says
/// otherwise. The observer hears of every cycle; `cancel` is looked at in every time step.
pub fn solve(motor: &Motor, numerics: &Numerics, observer: &mut dyn Observer, cancel: &Cancel) -> Solution {
    let nx = numerics.film_nodes_along.unwrap_or(PAPER_MESH.0).max(3);
    let ny = numerics.film_nodes_across.unwrap_or(PAPER_MESH.1).max(3);
    let n = numerics.contact_nodes.unwrap_or(PAPER_MESH.2).max(5) - 1;
    let steps = numerics.steps_per_cycle.unwrap_or(STEPS_PER_CYCLE).max(4);

    let mut warnings = Vec::new();
    let knudsen = match motor.gas.slip {
        Slip::None => 0.0,
        Slip::FirstOrder => motor.gas.mean_free_path / motor.min_spacing,
        Slip::SecondOrder | Slip::FukuiKaneko => {
            warnings.push("The paper's method knows first-order slip only; that was solved.".to_owned());
            motor.gas.mean_free_path / motor.min_spacing
        }
    };

    let mut march = March::new(motor, nx, ny, n, steps, knudsen);
    let mut recorder = Recorder::new(&march);
    let mut run = Run::default();
    let status = run.cycles(&mut march, &mut recorder, observer, cancel, &mut warnings);

    let alpha_mesh = discretisation_error(nx, ny, n);
    let recording = recorder.finish();
    let film_load = mean(&recording.film_load);
    let contact_load = mean(&recording.contact_load);
    let alpha = film_load / motor.load;
    let touching: usize = recording.teeth_in_contact.iter().sum();
    let outcome = MotorResult {
        alpha,
        alpha_error: run.alpha_remaining + alpha_mesh * alpha.abs(),
        film_load,
        film_load_min: recording.film_load.iter().copied().fold(f64::INFINITY, f64::min),
        film_load_max: recording.film_load.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        contact_load,
        max_torque: motor.dry_friction * (1.0 - alpha) * f64::from(motor.waves) * motor.load * motor.contact_radius,
        teeth_in_contact: touching as f64 / steps as f64,
        levitated: touching == 0,
        min_gap: recording.min_film_thickness.iter().copied().fold(f64::INFINITY, f64::min),
        max_pressure: recording.max_pressure.iter().copied().fold(0.0, f64::max),
    };
    let teeth = motor.teeth as u64;
    let stats = Stats {
        film_steps: run.steps * teeth,
        film_solves: march.rounds * teeth,
        limited_steps: 0,
        cycles: run.cycles,
        coupling_iterations: march.rounds,
        contact_solves: march.contact_solves,
        contact_iterations: march.contact.rounds,
        film_nodes: nx * ny,
        contact_nodes: n + 1,
        steps_per_cycle: steps,
    };
    Solution {
        status,
        outcome: Outcome::Motor(outcome),
        stats,
        model: describe(motor, (nx, ny, n + 1), &march),
        warnings,
        recording,
    }
}

/// Relative error of α that comes with the meshes: 3 % on the paper's own, and in proportion to the coarsest of the
/// three spacings. One mesh gives no estimate; this one is from doubling all of them in the fundamental case (see
/// `tests/paper_table1.rs`), and the boundary layer of the film, one cell wide there, differs from case to case.
fn discretisation_error(nx: usize, ny: usize, n: usize) -> f64 {
    let coarseness = |paper: usize, own: usize| (paper - 1) as f64 / own as f64;
    let (along, across, contact) = PAPER_MESH;
    let worst = coarseness(along, nx - 1).max(coarseness(across, ny - 1)).max(coarseness(contact, n));
    PAPER_MESH_ERROR * worst
}

fn describe(motor: &Motor, (nx, ny, nodes): (usize, usize, usize), march: &March<'_>) -> Model {
    let mut why = vec![
        format!(
            "The paper's literal algorithm: every tooth, full width, {nx} × {ny} uniform film nodes, {nodes} contact \
             nodes, marched from ambient pressure with contact and film in turn."
        ),
        format!(
            "The error given for α is the change still to come from cycle to cycle plus {:.1} % for the meshes, \
             scaled from doubling them in the fundamental case: one mesh has no estimate of its own.",
            100.0 * discretisation_error(nx, ny, nodes - 1)
        ),
    ];
    if motor.shear {
        why.push("The wedge term is solved, with the sliding speed of each point of a tooth.".to_owned());
    } else {
        why.push("The wedge term is left out, as the scene asks.".to_owned());
    }
    if !march.meshes.alike {
        why.push(
            "The pitch is not a whole number of contact spacings, so the teeth carry different nodes; the recorded \
             lines are interpolated to those of tooth 0."
                .to_owned(),
        );
    }
    Model {
        fidelity: "paper mesh".to_owned(),
        method: "paper".to_owned(),
        teeth_solved: motor.teeth,
        half_width: false,
        shear: motor.shear,
        why,
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Counts of the march, and how far α still has to go.
#[derive(Clone, Copy, Debug, Default)]
struct Run {
    steps: u64,
    cycles: u64,
    alpha_remaining: f64,
}

impl Run {
    /// Marches until the cycle repeats.
    fn cycles(
        &mut self,
        march: &mut March<'_>,
        recorder: &mut Recorder,
        observer: &mut dyn Observer,
        cancel: &Cancel,
        warnings: &mut Vec<String>,
    ) -> Status {
        let (mut p_before, mut h_before) = (march.p.clone(), march.h.clone());
        let (mut film_before, mut change_before) = (0.0, f64::INFINITY);
        let (mut least, mut least_at) = (f64::INFINITY, 0);
        let mut residual = f64::INFINITY;
        for cycle in 1..=CYCLES {
            let (mut unsettled, mut overcarried, mut unsettled_contact) = (0_usize, 0_usize, 0_usize);
            for step in 0..march.steps {
                if cancel.is_cancelled() {
                    return Status::Cancelled;
                }
                let result = march.advance(step);
                if !result.sound {
                    warnings.push(format!(
                        "The march blew up in cycle {cycle}, step {}: fields and loads are the last finite ones.",
                        step + 1
                    ));
                    return Status::NotConverged { residual: residual.min(f64::MAX), tolerance: CYCLE_TOLERANCE };
                }
                self.steps += 1;
                unsettled += usize::from(!result.settled);
                overcarried += usize::from(result.balance == Balance::Overcarried);
                unsettled_contact += usize::from(result.balance == Balance::Unsettled);
                recorder.record(march, (step + 1) % march.steps);
            }
            self.cycles += 1;

            residual = change(&march.p, &p_before).max(change(&march.h, &h_before));
            p_before.copy_from_slice(&march.p);
            h_before.copy_from_slice(&march.h);
            let film = recorder.mean_film_load();
            let moved = (film - film_before).abs() / march.motor.load;
            // Geometric: the changes to come are the last one over (1 − ratio), if the ratio is below one at all.
            let ratio = if moved < change_before { moved / change_before } else { 0.5 };
            self.alpha_remaining = moved / (1.0 - ratio).max(0.01);
            (film_before, change_before) = (film, moved);
            observer.progress(&Progress {
                level: 0,
                levels: 1,
                iteration: cycle,
                residual,
                tolerance: CYCLE_TOLERANCE,
                film_load: film,
            });

            let repeats = residual < CYCLE_TOLERANCE;
            if residual < least {
                (least, least_at) = (residual, cycle);
            }
            if !repeats && cycle < CYCLES && cycle - least_at < STALLED {
                continue;
            }
            if overcarried > 0 {
                warnings.push(format!(
                    "In {overcarried} of {} steps the film alone carries more than the load, which this coupling \
                     cannot balance: the rotor should lift there.",
                    march.steps
                ));
            }
            if unsettled > 0 {
                warnings.push(format!(
                    "In {unsettled} of {} steps contact and film did not settle in {INNER_ROUNDS} rounds.",
                    march.steps
                ));
            }
            if unsettled_contact > 0 {
                warnings.push(format!("In {unsettled_contact} steps the contact set did not settle."));
            }
            if repeats && overcarried + unsettled + unsettled_contact == 0 {
                return Status::Converged;
            }
            return Status::NotConverged { residual, tolerance: CYCLE_TOLERANCE };
        }
        Status::NotConverged { residual, tolerance: CYCLE_TOLERANCE }
    }
}

/// Greatest change of a field, relative to its greatest value.
fn change(now: &[f64], before: &[f64]) -> f64 {
    let greatest = now.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    now.iter().zip(before).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / greatest
}
