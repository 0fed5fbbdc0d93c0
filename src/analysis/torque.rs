//! Performance of a motor: torque, power and efficiency over the rotor's speed ([`crate::drive`]), with the film and without it.
//!
//! The pressures are those at the scene's rotor speed. The effect of another speed is bounded, or solved for where the bound is large
//! ([`TorqueCurves::speed_effect`]).

use crate::control::Cancel;
use crate::drive::{Scaled, film_power, lines, ring};
use crate::estimate::Estimate;
use crate::fidelity::Fidelity;
use crate::motor::{MotorError, without_film};
use crate::plan::{Plan, wedge_bound};
use crate::problem::{Motor, Numerics, Problem, Scenario, Wedge, rpm};
use crate::recording::Recording;
use crate::solution::{Accuracy, MotorResult, Outcome, Performance, Solution, Status, StoppedBy};
use crate::solve::{Record, Settings, solve};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// An effect of the speed on the torque below which the bound is sufficient.
const SMALL_EFFECT: f64 = 0.01;
/// Number of speeds of a curve, equally spaced from rest to the stator's greatest speed; marked speeds are added.
const SPEEDS: usize = 121;

/// Performance of a motor over the rotor's speed, for the whole ring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TorqueCurves {
    /// With the film.
    pub with_film: Performance,
    /// The same motor without gas: the contact is solved in a vacuum.
    pub without_film: Performance,
    /// Contact radius \[m\], to convert surface speeds to rpm.
    pub radius: f64,
    /// Greatest tangential speed of the stator's surface V₀ = 2πf B_S \[m/s\].
    pub stator_speed: f64,
    /// The friction coefficient that a model without film needs for the same maximum operating torque, μ_d(1 − α).
    pub dry_equivalent: Estimate,
    /// Mean power that the stator needs to squeeze the film \[W\].
    pub film_power: Estimate,
    /// Greatest torque of the film's own drag from rest to the stator's greatest speed \[N m\], signed. It is an upper bound of its size,
    /// because slip is neglected.
    pub viscous_drag: f64,
    /// Bound of the relative change of the torque because the film changes with the rotor speed.
    pub speed_effect: f64,
}

impl TorqueCurves {
    /// From the solve of a motor, and from the contact without film, which is solved here. The grids are those of `fidelity` and the scene
    /// or, if the solve ended at its time limit, of the fidelity that it reached. `None` for a plate, and if cancelled.
    ///
    /// # Errors
    /// [`MotorError`] if a contact problem without film has no solution to working precision.
    pub fn of(
        problem: &Problem,
        fidelity: Fidelity,
        solution: &Solution,
        cancel: &Cancel,
    ) -> Result<Option<Self>, MotorError> {
        let Some((motor, result)) = problem.scenario.motor().zip(solution.outcome.motor()) else { return Ok(None) };
        let Accuracy { stated, stopped_by, .. } = solution.accuracy;
        let reached = Fidelity::ALL.into_iter().rfind(|level| level.accuracy() >= stated).unwrap_or(Fidelity::Draft);
        let fidelity = if stopped_by == StoppedBy::Budget { fidelity.min(reached) } else { fidelity };
        let plan = Plan::motor_to(motor, fidelity, &fidelity.spec(), &problem.numerics, &cancel.started())?;
        let Some(dry) = without_film(motor, &plan, cancel)? else { return Ok(None) };
        let with_film = Scaled::with_film(motor, result, &solution.recording);
        let without_film = Scaled::without_film(motor, &dry, plan.rotor.relative_error);
        let share = (1.0 - result.alpha.value).max(0.0);
        let speeds = speeds(motor, &[with_film.no_load_speed(), without_film.no_load_speed()]);
        Ok(Some(Self {
            with_film: with_film.performance(&speeds),
            without_film: without_film.performance(&speeds),
            radius: motor.contact_radius,
            stator_speed: motor.stator_speed(),
            dry_equivalent: Estimate { value: share, ..result.alpha } * motor.dry_friction,
            film_power: film_power(motor, &solution.recording),
            viscous_drag: viscous_drag(motor, &solution.recording),
            speed_effect: speed_effect(motor, &problem.numerics, (result.alpha.value, fidelity), cancel),
        }))
    }

    /// Converts a surface speed \[m/s\] to revolutions per minute.
    pub fn rpm(&self, speed: f64) -> f64 {
        rpm(speed, self.radius)
    }
}

/// The performance with the film alone, from a solve of `motor`; for the whole ring.
pub fn with_film(motor: &Motor, result: &MotorResult, recording: &Recording) -> Performance {
    let scaled = Scaled::with_film(motor, result, recording);
    scaled.performance(&speeds(motor, &[scaled.no_load_speed()]))
}

/// Speeds of a curve \[m/s\], ascending: equally spaced from rest to the stator's greatest speed, with the `marked` speeds and that of the
/// rotor. Empty if the stator does not move.
fn speeds(motor: &Motor, marked: &[Option<f64>]) -> Vec<f64> {
    let v0 = motor.stator_speed();
    if v0 <= 0.0 {
        return Vec::new();
    }
    let even = (0..SPEEDS).map(|i| v0 * i as f64 / (SPEEDS - 1) as f64);
    let marked = marked.iter().copied().flatten().chain([motor.rotor_speed]);
    let mut speeds: Vec<f64> = even.chain(marked.filter(|speed| (0.0..=v0).contains(speed))).collect();
    speeds.sort_by(f64::total_cmp);
    // The speed of the rotor may be equal to one of the others except for rounding.
    speeds.dedup_by(|a, b| (*a - *b).abs() <= 1e-12 * v0);
    speeds
}

/// [`TorqueCurves::speed_effect`]: a bound from the problem alone if that is small; otherwise the effect in a solve at the speed farthest
/// from the scene's, with its error.
fn speed_effect(motor: &Motor, numerics: &Numerics, (alpha, fidelity): (f64, Fidelity), cancel: &Cancel) -> f64 {
    let share = 1.0 - alpha;
    if share <= 0.0 {
        return 0.0;
    }
    let v0 = motor.stator_speed();
    let farthest = if motor.rotor_speed > 0.5 * v0 { 0.0 } else { v0 };
    let bound = wedge_bound(motor, (farthest - motor.rotor_speed).abs());
    if bound * alpha.abs() < SMALL_EFFECT * share {
        return bound * alpha.abs() / share;
    }
    let solved = |rotor_speed| {
        let scenario = Scenario::Motor(Motor { rotor_speed, ..motor.clone() });
        let numerics = Numerics { wedge: Wedge::On, ..*numerics };
        let problem = Problem { name: String::new(), scenario, numerics };
        let fidelity = fidelity.min(Settings::default().fidelity);
        let settings = Settings { fidelity, record: Record::Numbers, ..Settings::default() };
        match solve(&problem, &settings, &mut (), cancel).ok()? {
            Solution { status: Status::Converged, outcome: Outcome::Motor(result), .. } => Some(result.alpha),
            _ => None,
        }
    };
    let change = match [motor.rotor_speed, farthest].map(solved) {
        [Some(here), Some(there)] => (there.value - here.value).abs() + here.error.max(there.error),
        _ => f64::INFINITY,
    };
    change.min(bound * alpha.abs()) / share
}

/// Torque of the shear stress μU/h in the film on the teeth, for the whole ring \[N m\]: the greatest from rest to the stator's greatest
/// speed. Slip would lower it; it is neglected here.
fn viscous_drag(motor: &Motor, recording: &Recording) -> f64 {
    let loads = &recording.lines;
    let v0 = motor.stator_speed();
    let (mut still, mut slope) = (0.0, 0.0);
    for (phase, line) in lines(loads) {
        for (i, (x, length)) in loads.x.iter().zip(&loads.node_length).enumerate() {
            let per_speed = motor.gas.viscosity * motor.contact_width * length / recording.film_thickness[line + i];
            still += per_speed * v0 * (TAU * (phase + x / loads.length)).cos();
            slope += per_speed;
        }
    }
    let scale = ring(motor, loads) * motor.contact_radius / loads.frames.max(1) as f64;
    let [at_rest, at_speed] = [scale * still, scale * (still - slope * v0)];
    if at_rest.abs() > at_speed.abs() { at_rest } else { at_speed }
}
