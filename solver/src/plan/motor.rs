//! The plan of a motor.

use super::grid::{Grid, graded, nested, round_up, spectral_clustering};
use super::reduction::{crown, flow, time, wedge};
use super::{Choice, Decision, Plan, ROUND_LIMIT, THINNEST_LAYER, custom, most_harmonics, name};
use crate::control::Cancel;
use crate::dimensionless::Dimensionless;
use crate::fidelity::{Fidelity, GRIDS, Spec};
use crate::numerics::grading::middle_clustering;
use crate::numerics::system::MANY_COLUMNS;
use crate::problem::{Flow, Motor, Numerics, RotorCompliance, Teeth, Time, Wedge, Width};
use crate::rotor::{Compliances, MOST_HARMONICS, RotorError};
use std::f64::consts::TAU;

/// Relative effect on α of an error of the rotor's compliance, as a multiple of [`Compliances::relative_error`] (measured; `tests/plan.rs`
/// checks it as a bound).
pub const ROTOR_EFFECT: f64 = 2.0;
/// Additional intervals along a crowned tooth, as a multiple of ln r times the intervals of a flat tooth, if the intervals in its middle
/// have to be shorter than uniform ones by the factor r.
const MIDDLE: f64 = 1.0;
/// Grids beyond those of the plan, at most: each costs about four times the one before.
const MORE_GRIDS: usize = 3;
/// Fewest intervals along a tooth with which the coarsest grid has an unknown node.
const FEWEST_ALONG: usize = 2 << (GRIDS - 1);

/// Most unknown nodes of a polynomial across half the width.
const MOST_ACROSS: usize = 12;

impl Plan {
    /// The plan of a motor at a fidelity; `numerics` overrules.
    ///
    /// # Errors
    /// [`RotorError`] if the rotor has no compliance.
    pub fn motor(motor: &Motor, fidelity: Fidelity, numerics: &Numerics) -> Result<Self, RotorError> {
        Self::motor_to(motor, fidelity, &fidelity.spec(), numerics, &Cancel::new())
    }

    /// The plan of a motor to a specification.
    ///
    /// # Errors
    /// As [`Plan::motor`], or if it is cancelled.
    pub fn motor_to(
        motor: &Motor,
        fidelity: Fidelity,
        spec: &Spec,
        numerics: &Numerics,
        cancel: &Cancel,
    ) -> Result<Self, RotorError> {
        let numbers = Dimensionless::of_motor(motor);
        let layer = numbers.boundary_layer;
        let in_layer = (motor.wavelength() / (TAU * layer)) as usize;
        let finest = spec.harmonic_fraction / (1 << (2 * MORE_GRIDS)) as f64;
        let harmonics = in_layer.max(most_harmonics(finest));
        let film = motor.least_thickness() / (motor.gas.ambient_pressure * motor.contact_width);
        // Finer meshes of a ring may take longer than a budget of time allows.
        let accuracy = if cancel.has_budget() { f64::INFINITY } else { spec.target_error };
        let rotor = motor.compliances_for(accuracy, harmonics.min(MOST_HARMONICS), cancel)?.at_least(RIGID * film);
        let per_wave = (spec.per_wave as f64 * motor.tooth_width / motor.wavelength()).ceil() as usize;
        let edge = spec.edge_fraction * layer;
        let base = spec.along.max(per_wave);
        let asked = numerics.film_nodes_along.map(|n| (n - 1).max(FEWEST_ALONG));
        let crowned = 2.0 * crown_length(motor) / spec.along as f64;
        let middle = crowned < motor.tooth_width / base as f64;
        let (along, clustering_along) = if middle {
            let ratio = |intervals: usize| crowned * intervals as f64 / motor.tooth_width;
            let intervals =
                asked.map_or_else(|| round_up(base + (MIDDLE * base as f64 * -ratio(base).ln()) as usize), round_up);
            (intervals, middle_clustering(ratio(intervals)))
        } else {
            graded(base, asked, motor.tooth_width, edge)
        };
        let half = 0.5 * motor.contact_width;
        let robust = graded(spec.volumes, numerics.film_nodes_across.map(|n| n / 2), half, edge);
        // With fewer nodes, the last one may change little by chance although the layer at the sides is not resolved.
        let least = (half / layer).sqrt().round() as usize;
        let across = numerics.film_nodes_across.map_or(spec.across.max(least), |n| (n / 2).max(1));
        // More nodes than a polynomial ever needs are taken as finite volumes, whose cost is proportional to their number.
        let spectral = layer / half > THINNEST_LAYER && across < MANY_COLUMNS;
        let (across, clustering_across) = if spectral { (across, spectral_clustering(layer / half)) } else { robust };
        let steps_per_pitch = numerics.steps_per_cycle.unwrap_or(spec.steps).div_ceil(motor.teeth);
        let steps = round_up(steps_per_pitch) * motor.teeth;

        let time = time(numerics, &numbers, motor, &rotor, spec);
        let wedge = wedge(numerics, &numbers, motor, &rotor, along, spec);
        let sliding = wedge.chosen == Choice::Wedge(Wedge::On);
        let flow = flow(numerics, &numbers, motor, spec, sliding);
        let trapped = time.chosen == Choice::Time(Time::Trapped);
        let half_width = numerics.width != Width::Full;
        let every_tooth = numerics.teeth == Teeth::All;
        let finest = Grid { along, across, steps, harmonic_fraction: spec.harmonic_fraction };
        let teeth = Choice::Teeth(if every_tooth { Teeth::All } else { Teeth::One }, motor.teeth);
        let width = Choice::Width(if half_width { Width::Half } else { Width::Full });
        let grid = Choice::MotorGrid { grid: finest, layer, edge_fraction: spec.edge_fraction, middle, spectral };
        let mut decisions = vec![time, flow, wedge];
        let exact = [(teeth, every_tooth), (width, !half_width), (grid, custom(numerics))];
        decisions.extend(exact.map(|(chosen, overruled)| Decision { overruled, ..Decision::exact(chosen) }));
        decisions.extend(rotor_error(motor, &rotor, spec, cancel)?);
        // Terms that the trapped limit leaves out must not be counted twice.
        let moving =
            |decision: &&Decision| !trapped || matches!(decision.chosen, Choice::Time(_) | Choice::Rotor { .. });
        let sharp = 1.0 / (1.0 + (rotor.beyond(MOST_HARMONICS) / (SHARP * film)).powi(2));
        let crowned = crown(motor) / (crown(motor) + 0.1 * motor.min_spacing);
        let ample = (motor.normal_amplitude / motor.min_spacing / AMPLE[0]).ln() / (AMPLE[1] / AMPLE[0]).ln();
        let irregular = 1.0
            + (IRREGULAR - 1.0) * if rotor.dips() { 1.0 } else { sharp }
            + CROWNED * crowned
            + OF_AMPLE * ample.clamp(0.0, 1.0);
        Ok(Self {
            fidelity: name(fidelity, numerics),
            grids: nested(finest, spectral),
            clustering_along,
            clustering_across,
            clustering_in_time: 0.0,
            frames_per_step: 1,
            spectral,
            turned: false,
            half_width,
            every_tooth,
            shear: !trapped && sliding,
            flow: match flow.chosen {
                Choice::Flow(flow) => flow,
                _ => Flow::Plane,
            },
            trapped,
            left_out: decisions.iter().filter(moving).map(|decision| decision.effect).sum(),
            forced: decisions.iter().filter(moving).map(Decision::forced).sum(),
            rotor,
            counted: None,
            accuracy: if custom(numerics) { 0.0 } else { spec.target_error },
            target_error: spec.target_error,
            most_grids: if custom(numerics) { GRIDS } else { GRIDS + MORE_GRIDS },
            most_across: if numerics.film_nodes_across.is_some() { across } else { MOST_ACROSS },
            robust,
            tolerance: numerics.tolerance.unwrap_or(spec.tolerance),
            round_limit: ROUND_LIMIT,
            maps: true,
            irregular: irregular.max(spec.least_factor),
            decisions,
        })
    }
}

/// Compliance of a rotor over that of the closed film, H_m/(p_a w), below which it might as well be rigid. What is stiffer by many orders
/// than all else is lost in rounding.
const RIGID: f64 = 1e-5;

/// Local compliance over that of the closed film below which contact ends abruptly at the edges of teeth, so that its errors are not of
/// second order; and what their estimate is multiplied by then, and where a harmonic is stiffer than the limit of short waves
/// (calibrated: docs/validation.md).
const SHARP: f64 = 2e-3;
const IRREGULAR: f64 = 3.0;
/// Addition to that factor where teeth are crowned, so that contact ends between nodes, and where the amplitude is `AMPLE` times the minimum
/// spacing, so that contact begins and ends within few instants (calibrated as well).
const CROWNED: f64 = 0.6;
const OF_AMPLE: f64 = 0.4;
const AMPLE: [f64; 2] = [7.0, 12.0];

/// Length \[m\] in the middle of a crowned tooth over which its crown opens the gap by H_m: the film that carries, at the least.
fn crown_length(motor: &Motor) -> f64 {
    motor.tooth_radius.map_or(f64::INFINITY, |radius| (8.0 * radius * motor.min_spacing).sqrt())
}

/// Of a rotor that is known to a stated error only.
fn rotor_error(
    motor: &Motor,
    rotor: &Compliances,
    spec: &Spec,
    cancel: &Cancel,
) -> Result<Option<Decision>, RotorError> {
    let error = rotor.relative_error;
    if error == 0.0 {
        return Ok(None);
    }
    let ring = matches!(motor.rotor, RotorCompliance::Ring(_));
    let in_time = spec.target_error < Fidelity::Draft.accuracy() && !cancel.has_budget();
    let resonances = if in_time { motor.resonances(cancel)? } else { None };
    let chosen = Choice::Rotor { error, ring, resonances };
    Ok(Some(Decision { effect: ROTOR_EFFECT * error, ..Decision::exact(chosen) }))
}
