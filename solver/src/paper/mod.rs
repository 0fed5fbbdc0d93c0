//! The paper's own algorithm, literally: the reference against which the other method is measured.
//!
//! T. Maeno and D. B. Bogy, "Effect of the hydrodynamic bearing on rotor/stator contact in a ring-type ultrasonic motor", IEEE Trans. UFFC
//! 39 (1992). The implementation is efficient (flat arrays, tridiagonal sweeps) but takes no shortcuts: every tooth, the full width, a
//! uniform 51 × 11 mesh on each ([`FactoredFilm`]), 181 contact nodes in a wavelength, and a march in time from ambient pressure with
//! contact and film solved in turn.
//!
//! # One time step (the paper's Fig. 1)
//!
//! 1. The stator moves to time t.
//! 2. Contact: rotor shape and contact forces under the film's pressure, which is frozen (`contact`).
//! 3. Film: from the spacing at t − Δt and at t, and the pressure at t − Δt, the pressure at t, on every tooth (`film`).
//! 4. Until pressure and spacing at t no longer change by 1e-3 of the greatest, back to 2; given up after 8 rounds without
//!    progress, or 40.
//!
//! The cycle repeats when all pressures and spacings equal those of one period before, to 1e-5 of the greatest. Since the teeth are at
//! different phases of the same motion, comparing them at one instant compares the cycle at several.
//!
//! # What the paper leaves open, and what is done here
//!
//! * Steps in a cycle are not given: 180 unless [`Numerics`] says otherwise.
//! * "Linear interpolation" of the film's pressure to the contact nodes is taken so that no force is lost: each film
//!   node's share goes to the two contact nodes beside it (`mesh`). α is then equation (11) as it stands.
//! * "Finite difference operators" are central differences of the expanded form along x; across the width, where the gap
//!   is uniform, (Z²/2 + 6mZ)_yy is differenced as it is (`film`): of the two readings it gives the paper's own numbers.
//! * Only first-order slip, or none, fits the scheme. For any other law first-order is solved, with a warning.
//!
//! # Where it fails
//!
//! Freezing the pressure while the contact is solved is unstable for a stiff film or a light load. In the fundamental
//! case the inner loop settles everywhere at H_m = 200 nm, all but settles at 100 nm (in 9 of 180 steps it ends in a
//! cycle of 0.25 % of the pressure: a warning, and part of the error), in 27 of 180 steps at 80 nm and in none at 60 and
//! 50 nm. For L = 0.5 N at 200 nm the film alone carries more than the load in 135 of 180 steps, and no contact set balances
//! it. That is reported as
//! [`Status::NotConverged`], with the numbers as reached; α may exceed 1.

mod contact;
mod film;
mod march;
mod mesh;
mod record;

pub use film::FactoredFilm;
pub use mesh::Mesh;

use crate::control::{Cancel, Observer, Reporter};
use crate::digits::percent;
use crate::estimate::Estimate;
use crate::problem::{Motor, Numerics, Slip};
use crate::rotor::RotorError;
use crate::solution::{Accuracy, Model, MotorResult, Outcome, Solution, Stats, Status, StoppedBy};
use contact::Balance;
use march::{INNER_TOLERANCE, March, StepOutcome};
use mesh::PAPER_MESH;
use record::Recorder;

/// Change over a cycle, relative to the greatest pressure and spacing, at which the cycle repeats.
const CYCLE_TOLERANCE: f64 = 1e-5;
/// Most cycles marched.
const CYCLES: usize = 200;
/// Cycles without a change smaller by [`PROGRESS`] after which the march is given up.
const STALLED: usize = 10;
/// A cycle counts as progress if its change is below this multiple of the smallest one so far.
const PROGRESS: f64 = 0.9;
/// An inner loop that ends in a limit cycle smaller than this, in a march whose cycle repeats, is a warning and part of
/// the error; a larger one means that there is no solution of this kind.
const LIMIT_CYCLE: f64 = 1e-2;
/// Error of α on the paper's mesh, relative: see [`discretisation_error`].
const PAPER_MESH_ERROR: f64 = 0.045;

/// Solves for the periodic state of `motor` by the paper's algorithm, on the paper's meshes unless `numerics` says otherwise. The observer
/// is called after every cycle; `cancel` is checked in every time step.
///
/// # Errors
/// [`RotorError`] if the rotor has no compliance.
pub fn solve(
    motor: &Motor,
    numerics: &Numerics,
    observer: &mut dyn Observer,
    cancel: &Cancel,
) -> Result<Solution, RotorError> {
    let mesh = Mesh::of(numerics);
    let rotor = motor.compliances(mesh.n / 2, cancel)?;

    let mut warnings = Vec::new();
    let knudsen = match motor.gas.slip {
        Slip::None => 0.0,
        Slip::FirstOrder => motor.gas.mean_free_path / motor.min_spacing,
        Slip::SecondOrder | Slip::FukuiKaneko => {
            warnings.push("The paper's method knows first-order slip only; that was solved.".to_owned());
            motor.gas.mean_free_path / motor.min_spacing
        }
    };

    let mut march = March::new(motor, &rotor, &mesh, knudsen);
    let mut recorder = Recorder::new(&march, &rotor);
    let mut counts = Counts::default();
    let status = counts.cycles(&mut march, &mut recorder, observer, cancel, &mut warnings);

    // If there is no periodic state, the residual is the only measure of the error.
    let astray = if let Status::NotConverged { residual, .. } = status { residual } else { counts.limit_cycle };
    let relative_error = discretisation_error(&mesh) + astray + rotor.relative_error;
    let recording = recorder.recording;
    let film_load = mean(&recording.film_load);
    let alpha = film_load / motor.load;
    let alpha = Estimate { value: alpha, error: counts.alpha_remaining + relative_error * alpha.abs() };
    let touching: usize = recording.teeth_in_contact.iter().sum();
    let least = |series: &[f64]| series.iter().copied().fold(f64::INFINITY, f64::min);
    let most = |series: &[f64]| series.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let off = |value: f64| Estimate { value, error: relative_error * value.abs() };
    let thicknesses = &recording.min_film_thickness;
    let mut outcome = MotorResult {
        film_load_min: off(least(&recording.film_load)),
        film_load_max: off(most(&recording.film_load)),
        teeth_in_contact: Estimate {
            value: touching as f64 / mesh.steps as f64,
            error: motor.teeth as f64 / mesh.steps as f64,
        },
        levitated: touching == 0,
        min_film_thickness: Estimate {
            value: least(thicknesses),
            error: relative_error * (most(thicknesses) - motor.min_spacing),
        },
        max_pressure: off(most(&recording.max_pressure)),
        max_contact: most(&recording.contact),
        ..MotorResult::default()
    };
    outcome.set_alpha(motor, alpha);
    // Film and contact share the load as accurately as the march determines it.
    outcome.film_load.value = film_load;
    outcome.contact_load.value = mean(&recording.contact_load);
    let teeth = motor.teeth as u64;
    let stats = Stats {
        film_steps: counts.steps * teeth,
        film_solves: march.rounds * teeth,
        cycles: counts.cycles,
        coupling_iterations: march.rounds,
        contact_solves: march.contact_solves,
        contact_iterations: march.contact.rounds,
        film_nodes: mesh.nx * mesh.ny,
        contact_nodes: mesh.n + 1,
        steps_per_cycle: mesh.steps,
        ..Stats::default()
    };
    let stated = alpha.error / alpha.value.abs();
    Ok(Solution {
        accuracy: Accuracy { asked: 0.0, stated, stopped_by: StoppedBy::Limit },
        status,
        outcome: Outcome::Motor(outcome),
        performance: None,
        harmonic: None,
        stats,
        model: describe(motor, &mesh, &march),
        warnings,
        recording,
    })
}

/// Relative error of α due to the meshes: 4.5 % on the paper's own, scaled in proportion to the coarsest of the three spacings, which is
/// cautious, since the error falls faster. One mesh gives no estimate; this one is from the fundamental case (0.2383 and, with the meshes
/// doubled, 0.2437; our own method converges to 0.2459, a difference of 3.1 %), with a margin, since the film's boundary layer, one cell
/// wide there, differs from case to case. Almost all of the error is due to the mesh across the width. Time steps matter less: 90, 180 and
/// 360 in a cycle give 0.2381, 0.2383 and 0.2383.
fn discretisation_error(&Mesh { nx, ny, n, .. }: &Mesh) -> f64 {
    let coarseness = |paper: usize, own: usize| (paper - 1) as f64 / own as f64;
    let (along, across, contact) = PAPER_MESH;
    let worst = coarseness(along, nx - 1).max(coarseness(across, ny - 1)).max(coarseness(contact, n));
    PAPER_MESH_ERROR * worst
}

fn describe(motor: &Motor, mesh: &Mesh, march: &March<'_>) -> Model {
    let (nx, ny, nodes) = (mesh.nx, mesh.ny, mesh.n + 1);
    let mut remarks = vec![
        format!(
            "The paper's literal algorithm: every tooth, full width, {nx} × {ny} uniform film nodes, {nodes} contact \
             nodes, marched from ambient pressure with contact and film in turn."
        ),
        format!(
            "The error given for α is the change still to come from cycle to cycle plus {:.1} % for the meshes, \
             scaled from doubling them in the fundamental case: one mesh has no estimate of its own.",
            100.0 * discretisation_error(mesh)
        ),
    ];
    if motor.shear {
        remarks.push("The wedge term is solved, with the sliding speed of each point of a tooth.".to_owned());
    } else {
        remarks.push("The wedge term is left out, as the scene asks.".to_owned());
    }
    if !march.meshes.alike {
        remarks.push(
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
        remarks,
        decisions: Vec::new(),
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Counts of the march, and the remaining change of α.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    steps: u64,
    cycles: u64,
    alpha_remaining: f64,
    limit_cycle: f64,
}

impl Counts {
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
        let mut report = Reporter::new(observer, 0, 1, CYCLE_TOLERANCE);
        // Before the first cycle is complete, nothing has repeated.
        let mut residual = 1.0;
        for cycle in 1..=CYCLES {
            let mut trouble = Trouble::default();
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
                    return Status::NotConverged { residual, tolerance: CYCLE_TOLERANCE };
                }
                self.steps += 1;
                trouble.add(&result);
                recorder.record(march, (step + 1) % march.steps);
            }
            self.cycles += 1;

            residual = change(&march.p, &p_before).max(change(&march.h, &h_before));
            p_before.copy_from_slice(&march.p);
            h_before.copy_from_slice(&march.h);
            let film = mean(&recorder.recording.film_load);
            let moved = (film - film_before).abs() / march.motor.load;
            // Geometric series: the changes to come are the last one over (1 − ratio), if the ratio is below one.
            let ratio = if moved < change_before { moved / change_before } else { 0.5 };
            self.alpha_remaining = moved / (1.0 - ratio).max(0.01);
            (film_before, change_before) = (film, moved);
            report.round(cycle, residual, film);

            if residual < PROGRESS * least {
                (least, least_at) = (residual, cycle);
            }
            let repeats = residual < CYCLE_TOLERANCE;
            if repeats || cycle == CYCLES || cycle - least_at >= STALLED {
                trouble.warn(march.steps, warnings);
                // The worst is an inner loop that ended in a small limit cycle.
                if repeats && trouble.contact + trouble.overcarried == 0 && trouble.change < LIMIT_CYCLE {
                    self.limit_cycle = trouble.change;
                    return Status::Converged;
                }
                let (residual, tolerance) =
                    trouble.residual().map_or((residual, CYCLE_TOLERANCE), |residual| (residual, INNER_TOLERANCE));
                return Status::NotConverged { residual, tolerance };
            }
        }
        Status::NotConverged { residual, tolerance: CYCLE_TOLERANCE }
    }
}

/// Failures in the steps of one cycle.
#[derive(Clone, Copy, Debug, Default)]
struct Trouble {
    /// Steps whose inner loop did not settle.
    unsettled: usize,
    /// Steps whose contact set did not settle.
    contact: usize,
    /// Steps in which the film carries more than the load.
    overcarried: usize,
    /// Greatest change in a last round, and greatest imbalance, of those steps.
    change: f64,
    imbalance: f64,
}

impl Trouble {
    fn add(&mut self, step: &StepOutcome) {
        if !step.settled {
            self.unsettled += 1;
            self.change = self.change.max(step.change);
        }
        self.contact += usize::from(step.balance == Balance::Unsettled);
        self.overcarried += usize::from(step.balance == Balance::Overcarried);
        if step.balance != Balance::Held {
            self.imbalance = self.imbalance.max(step.imbalance);
        }
    }

    /// Greatest change or imbalance of the failed steps; `None` if none failed.
    fn residual(&self) -> Option<f64> {
        (self.unsettled + self.contact + self.overcarried > 0).then(|| self.change.max(self.imbalance))
    }

    fn warn(&self, steps: usize, warnings: &mut Vec<String>) {
        if self.overcarried > 0 {
            warnings.push(format!(
                "In {} of {steps} steps the film alone carries more than the load, which this coupling cannot \
                 balance (off by up to {:.3} of the load): the rotor should lift there.",
                self.overcarried, self.imbalance
            ));
        }
        if self.unsettled > 0 {
            warnings.push(format!(
                "In {} of {steps} steps contact and film did not agree: the last round still changed \
                 pressure or gap by up to {} of the greatest.",
                self.unsettled,
                percent(self.change)
            ));
        }
        if self.contact > 0 {
            warnings.push(format!("In {} of {steps} steps the contact set did not settle.", self.contact));
        }
    }
}

/// Greatest change of a field, relative to its greatest value.
fn change(now: &[f64], before: &[f64]) -> f64 {
    let greatest = now.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    now.iter().zip(before).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / greatest
}
