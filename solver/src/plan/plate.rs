//! The plan of a plate.

use super::grid::{Grid, graded, nested, round_up, spectral_clustering};
use super::{Choice, Decision, LEAK_EFFECT, Plan, ROUND_LIMIT, SHARE, THINNEST_LAYER, custom, name};
use crate::fidelity::{Fidelity, GRIDS, Spec};
use crate::film::slip::{Mobility, SlipLaw};
use crate::numerics::system::MANY_COLUMNS;
use crate::problem::{Flow, Numerics, Outline, Plate, Slip};
use crate::rotor::Compliances;
use std::f64::consts::{PI, TAU};

/// Most grids beyond those of the plan, and the number of frames of a recording up to which they are added.
const MORE_GRIDS: usize = 6;
const MOST_FRAMES: usize = 1 << 17;
/// Frames within the peak of a plate's load near touching, and the narrowest such peak \[rad\] that is resolved.
const FRAMES_IN_PEAK: f64 = 2.0;
const NARROWEST_PEAK: f64 = 2e-4;
/// Clustered steps of a cycle as a fraction of the uniform ones, for each factor of e by which the peak is narrower than the cycle.
const STEPS_IN_FACTOR: f64 = 0.6;
/// Steps cluster if such a peak needs more than this many times the uniform steps of a plate far from touching.
const CLUSTERED: f64 = 2.0;

/// Safety factor on the error that grids show for such a peak with second-order slip (calibrated: docs/validation.md).
const SHARP: f64 = 4.0;

impl Plan {
    /// The plan of a plate at a fidelity; `numerics` overrules grid sizes.
    pub fn plate(plate: &Plate, fidelity: Fidelity, numerics: &Numerics) -> Self {
        Self::plate_to(plate, fidelity, &fidelity.spec(), numerics)
    }

    /// The plan of a plate to a specification.
    pub fn plate_to(plate: &Plate, fidelity: Fidelity, spec: &Spec, numerics: &Numerics) -> Self {
        let layer = plate_layer(plate);
        // For its area, a disc has twice as long an edge as a strip whose length is the disc's diameter.
        let sides = [Some(plate.section()), plate.width.or((plate.outline() == Outline::Disc).then_some(plate.length))];
        let leak = sides.into_iter().flatten().map(|side| LEAK_EFFECT * layer / side).sum::<f64>();
        let trapped = leak < SHARE * spec.target_error || plate.amplitude == 0.0;
        let left_out = if trapped && plate.amplitude > 0.0 { leak } else { 0.0 };
        // On a long plate the effect of the ends reaches about as far as the plate is narrow.
        let reach = |other: f64| layer.min(other / PI);
        let thin = |side: f64, other: f64| 2.0 * reach(other) / side <= THINNEST_LAYER;
        let turned = plate.width.is_some_and(|width| thin(width, plate.length) && !thin(plate.length, width));
        let (plate, asked) = if turned {
            (&plate.turned(), [numerics.film_nodes_across, numerics.film_nodes_along])
        } else {
            (plate, [numerics.film_nodes_along, numerics.film_nodes_across])
        };
        let [asked_along, asked_across] = asked.map(|nodes| nodes.map(|n| n / 2));
        let edge = spec.plate_edge_fraction * plate.width.map_or(layer, reach);
        let (along, clustering_along) = graded(spec.plate, asked_along, 0.5 * plate.section(), edge);
        let layer = reach(plate.length);
        let edge = spec.plate_edge_fraction * layer;
        // As in the plan of a motor, many nodes are finite volumes.
        let thick = plate.width.is_some_and(|width| !thin(width, plate.length));
        let spectral = thick && asked_across.is_none_or(|asked| asked < MANY_COLUMNS);
        let robust = plate.width.map_or((0, 0.0), |width| graded(spec.plate, asked_across, 0.5 * width, edge));
        let (across, clustering_across) = match plate.width {
            Some(width) if spectral => {
                let across = asked_across.map_or(spec.across, |asked| asked.max(1));
                (across, spectral_clustering(2.0 * layer / width))
            }
            _ => robust,
        };
        // Near touching, the load is a peak as narrow as √(2(1 − ε)) of a cycle's 2π.
        let excursion = (plate.amplitude / plate.mean_gap).min(1.0);
        let narrowest = (2.0 * (1.0 - excursion)).sqrt().max(NARROWEST_PEAK);
        let follow = FRAMES_IN_PEAK * TAU / narrowest;
        let (steps, clustering_in_time) = match numerics.steps_per_cycle {
            Some(asked) => (asked, 0.0),
            None if follow > CLUSTERED * spec.plate_steps as f64 => {
                // sinh: the peak is where its argument is below 1.
                let beta = (PI / narrowest).asinh();
                let steps = (STEPS_IN_FACTOR * beta * spec.plate_steps as f64) as usize;
                // On all grids, one step is at the instant when the plate is closest.
                (steps.next_multiple_of(2 << (GRIDS - 1)), -beta)
            }
            None => (spec.plate_steps.max(follow as usize), 0.0),
        };
        // With this law the flow through a closing gap stays finite, so the peak is narrower.
        let sharp = clustering_in_time != 0.0 && plate.gas.slip == Slip::SecondOrder;
        let steps = round_up(steps);
        let frames_per_step = if clustering_in_time == 0.0 { 1 } else { (follow as usize).div_ceil(steps) };
        let more_grids = (0..=MORE_GRIDS).rev().find(|more| (frames_per_step * steps) << more <= MOST_FRAMES);
        let more_grids = more_grids.unwrap_or(0);
        let grid = Choice::PlateGrid { along, across: plate.width.map(|_| across), round: plate.hole.is_some() };
        let mut decisions =
            vec![Decision::exact(grid), Decision::exact(Choice::Steps(steps, clustering_in_time != 0.0))];
        if trapped {
            decisions.push(Decision { effect: left_out, ..Decision::exact(Choice::NoLeaks) });
        }
        Self {
            fidelity: name(fidelity, numerics),
            grids: nested(Grid { along, across, steps, harmonic_fraction: spec.harmonic_fraction }, spectral),
            clustering_along,
            clustering_across,
            clustering_in_time,
            frames_per_step,
            spectral,
            turned,
            half_width: true,
            every_tooth: false,
            shear: false,
            flow: Flow::Plane,
            trapped,
            left_out,
            forced: 0.0,
            rotor: Compliances::default(),
            counted: None,
            accuracy: if custom(numerics) { 0.0 } else { spec.target_error },
            target_error: spec.target_error,
            most_grids: if custom(numerics) { GRIDS } else { GRIDS + more_grids },
            most_across: if asked_across.is_some() { across } else { 24 },
            robust,
            tolerance: numerics.tolerance.unwrap_or(spec.plate_tolerance),
            round_limit: ROUND_LIMIT,
            maps: true,
            irregular: if sharp { SHARP } else { 1.0 },
            decisions,
        }
    }
}

/// The boundary layer of a plate's film \[m\], by its slip law ([`Dimensionless::boundary_layer`] estimates it).
fn plate_layer(plate: &Plate) -> f64 {
    let gas = &plate.gas;
    let conductance = plate.mean_gap * SlipLaw::of(gas).at(plate.mean_gap).0;
    (gas.ambient_pressure * conductance / (6.0 * gas.viscosity * TAU * plate.frequency)).sqrt()
}
