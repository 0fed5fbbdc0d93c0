//! What THIS scene needs: which terms, how many teeth, which symmetries, which grids, and why (shown to the user).

use crate::dimensionless::Dimensionless;
use crate::fidelity::{Fidelity, GRIDS, Spec};
use crate::numerics::grading::clustering;
use crate::problem::{Motor, Numerics, Plate};

/// One grid of a motor: intervals along a tooth and across half the width, time steps in a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Intervals along a tooth (of a plate: along half its length).
    pub along: usize,
    /// Intervals across half the width.
    pub across: usize,
    /// Time steps in a cycle.
    pub steps: usize,
    /// Rotor harmonics are kept until they fall below this fraction of the local compliance: four times as large on a
    /// grid of twice the spacing, so that what the cut changes is extrapolated, and estimated, with the rest.
    pub harmonic_fraction: f64,
}

/// What will be solved.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Fidelity's name, or `custom`.
    pub fidelity: String,
    /// Grids, coarse to fine, each with half the intervals and steps of the next.
    pub grids: Vec<Grid>,
    /// Clustering parameter of the nodes along (`numerics::grading`).
    pub clustering_along: f64,
    /// Clustering parameter of the nodes across.
    pub clustering_across: f64,
    /// Solve half the width and mirror it.
    pub half_width: bool,
    /// Solve every tooth (or one, by lag symmetry).
    pub every_tooth: bool,
    /// Solve the wedge term.
    pub shear: bool,
    /// Bound of what leaving out the wedge term changes, relative to α.
    pub shear_effect: f64,
    /// Rotor harmonics kept at most.
    pub most_harmonics: usize,
    /// Largest relative change that counts as a repeating cycle.
    pub tolerance: f64,
    /// Rounds of the coupling after which the solve gives up.
    pub round_limit: usize,
    /// A sentence for each decision.
    pub why: Vec<String>,
}

/// Effect of the wedge term on α, relative, is below this times Λ/σ (measured: `tests/motor.rs`).
const WEDGE_EFFECT: f64 = 2.0;
const ROUND_LIMIT: usize = 300;

impl Plan {
    /// The plan of a motor at a fidelity; `numerics` overrules grid sizes.
    pub fn motor(motor: &Motor, fidelity: Fidelity, numerics: &Numerics) -> Self {
        let spec = fidelity.spec();
        let numbers = Dimensionless::of_motor(motor);
        let mut why = Vec::new();

        let layer = numbers.boundary_layer;
        let per_wave = (spec.per_wave as f64 * motor.tooth_width / motor.wavelength()).ceil() as usize;
        let (along, clustering_along) =
            graded(spec.along.max(per_wave), numerics.film_nodes_along.map(|n| n - 1), motor.tooth_width, layer, &spec);
        let (across, clustering_across) =
            graded(spec.across, numerics.film_nodes_across.map(|n| n / 2), 0.5 * motor.contact_width, layer, &spec);
        let steps_per_pitch = numerics.steps_per_cycle.unwrap_or(spec.steps).div_ceil(motor.teeth);
        let steps = round_up(steps_per_pitch) * motor.teeth;
        why.push(format!(
            "grid: {along} intervals along a tooth and {across} across half the width, the first {} of the film's \
             boundary layer of {:.3} µm; {steps} steps a cycle; two coarser grids for the error estimate",
            spec.edge_fraction,
            layer * 1e6
        ));
        why.push(if motor.teeth == 1 {
            "teeth: the wave has one tooth, and it is solved".to_owned()
        } else {
            format!(
                "teeth: one of {} solved; in the steady state tooth k at time t is tooth 0 at t + kT/{} (exact)",
                motor.teeth, motor.teeth
            )
        });
        why.push(
            "width: half of it solved; the gap does not depend on y, so the other half is its mirror (exact)"
                .to_owned(),
        );

        let shear_effect = WEDGE_EFFECT * numbers.bearing_to_squeeze;
        let shear = motor.shear && shear_effect > 0.2 * spec.aim;
        why.push(if !motor.shear {
            "wedge term left out: the scene says shear = false".to_owned()
        } else if shear {
            format!(
                "wedge term solved: Λ/σ = {:.1e} may change α by up to {:.1e} of itself, and {fidelity} aims at {:.0e}",
                numbers.bearing_to_squeeze, shear_effect, spec.aim
            )
        } else {
            format!(
                "wedge term left out: Λ/σ = {:.1e} changes α by less than {:.1e} of itself, and {fidelity} aims at {:.0e}",
                numbers.bearing_to_squeeze, shear_effect, spec.aim
            )
        });
        Self {
            fidelity: name(fidelity, numerics),
            grids: nested(Grid { along, across, steps, harmonic_fraction: spec.harmonic_fraction }),
            clustering_along,
            clustering_across,
            half_width: true,
            every_tooth: false,
            shear,
            shear_effect: if motor.shear && !shear { shear_effect } else { 0.0 },
            most_harmonics: spec.most_harmonics,
            tolerance: spec.tolerance,
            round_limit: ROUND_LIMIT,
            why,
        }
    }

    /// The plan of a plate at a fidelity; `numerics` overrules grid sizes.
    pub fn plate(plate: &Plate, fidelity: Fidelity, numerics: &Numerics) -> Self {
        let spec = fidelity.spec();
        let layer = Dimensionless::of_plate(plate).boundary_layer;
        let mut why = Vec::new();
        let (along, clustering_along) =
            graded(spec.plate, numerics.film_nodes_along.map(|n| n / 2), 0.5 * plate.length, layer, &spec);
        let (across, clustering_across) = match plate.width {
            Some(width) => graded(spec.plate, numerics.film_nodes_across.map(|n| n / 2), 0.5 * width, layer, &spec),
            None => (0, 0.0),
        };
        let steps = round_up(numerics.steps_per_cycle.unwrap_or(spec.plate_steps));
        why.push(match plate.width {
            Some(_) => format!("plate: a quarter of it solved, {along} × {across} intervals, and mirrored (exact)"),
            None => format!("strip: one line across half its length solved, {along} intervals, and mirrored (exact)"),
        });
        why.push(format!("time: {steps} steps a cycle; two coarser grids for the error estimate"));
        Self {
            fidelity: name(fidelity, numerics),
            grids: nested(Grid { along, across, steps, harmonic_fraction: spec.harmonic_fraction }),
            clustering_along,
            clustering_across,
            half_width: true,
            every_tooth: false,
            shear: false,
            shear_effect: 0.0,
            most_harmonics: spec.most_harmonics,
            tolerance: spec.tolerance,
            round_limit: ROUND_LIMIT,
            why,
        }
    }
}

fn name(fidelity: Fidelity, numerics: &Numerics) -> String {
    let custom = numerics.film_nodes_along.or(numerics.film_nodes_across).or(numerics.steps_per_cycle);
    if custom.is_some() { "custom".to_owned() } else { fidelity.name().to_owned() }
}

/// Rounded up so that it can be halved for the coarser grids.
fn round_up(count: usize) -> usize {
    count.max(1).next_multiple_of(1 << (GRIDS - 1))
}

/// The grids down to the coarsest.
fn nested(finest: Grid) -> Vec<Grid> {
    (0..GRIDS)
        .rev()
        .map(|halved| Grid {
            along: finest.along >> halved,
            across: finest.across >> halved,
            steps: finest.steps >> halved,
            harmonic_fraction: finest.harmonic_fraction * (1 << (2 * halved)) as f64,
        })
        .collect()
}

/// Intervals over `length` and their clustering, so that the first is `edge_fraction` of the boundary `layer`. A thin
/// layer gets more of them: the map stretches its interior by about ln(1/ratio)/2.
fn graded(base: usize, asked: Option<usize>, length: f64, layer: f64, spec: &Spec) -> (usize, f64) {
    let edge = spec.edge_fraction * layer;
    let ratio = |intervals: usize| (edge * intervals as f64 / length).max(SMALLEST_RATIO);
    let intervals = match asked {
        Some(asked) => round_up(asked),
        None => round_up((base as f64 * (1.0 + 0.15 * (1.0 / ratio(base)).ln().max(0.0))) as usize),
    };
    (intervals, clustering(ratio(intervals)))
}

/// Edge intervals are not made smaller than this fraction of a uniform grid's.
const SMALLEST_RATIO: f64 = 1e-5;
