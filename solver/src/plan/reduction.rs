//! Terms of a motor's model that may be left out, and a bound of the effect of leaving out each of them.

use super::{Choice, Decision, LEAK_EFFECT, SHARE, Weighed};
use crate::dimensionless::Dimensionless;
use crate::fidelity::Spec;
use crate::problem::{Flow, Motor, Numerics, Time, Wedge};
use crate::rotor::Compliances;
use crate::surface::flow::LEAST_RATIO;
use std::f64::consts::{PI, TAU};

/// Effect on α, relative, of leaving out the wedge term, as a multiple of U/(2ω) over the length that gas or gap vary
/// along (measured, and bounded by `tests/plan.rs`).
const WEDGE_EFFECT: f64 = 2.0;
/// The gap is assumed to open by at least this fraction of the wave's amplitude, however far the rotor follows the wave (measured: 0.03 is
/// too much for heavily loaded single teeth).
const LEAST_OPENING: f64 = 0.02;
/// Relative effect on α of solving the wedge term where a cell's Péclet number is above 1, per unit of that number: the upwinding that is
/// then needed spreads the gas instead. The second constant is for gas that a crown holds unevenly (measured; `tests/plan.rs` checks them
/// as bounds).
const UPWINDING: f64 = 1e-4;
const UPWINDING_UNEVEN: f64 = 0.1;

/// A term that is left out if its effect is small enough, unless the scene's switch decides.
struct Reduction {
    /// For the whole model, and for the reduced one.
    choices: [Choice; 2],
    /// Whether the scene's switch leaves the term out; `None` if that is left to the plan.
    asked: Option<bool>,
    /// As of [`Weighed`].
    effect: f64,
    unresolved: f64,
    number: f64,
}

impl Reduction {
    fn decide(self, spec: &Spec) -> Decision {
        let Self { choices, asked, effect, unresolved, number } = self;
        let allowed = effect <= SHARE * spec.target_error || effect < unresolved;
        let left_out = asked.unwrap_or(allowed);
        let [_, reduced] = choices;
        let target_error = spec.target_error;
        let weighed = Weighed { reduced, number, asked: asked.is_some(), effect, unresolved, target_error };
        Decision {
            chosen: choices[usize::from(left_out)],
            overruled: asked.is_some_and(|asked| asked != allowed),
            effect: if left_out { effect } else { unresolved },
            weighed: Some(weighed),
        }
    }
}

pub(super) fn wedge(
    numerics: &Numerics,
    numbers: &Dimensionless,
    motor: &Motor,
    rotor: &Compliances,
    along: usize,
    spec: &Spec,
) -> Decision {
    if !motor.shear {
        return Decision::exact(Choice::NoShear);
    }
    Reduction {
        choices: [Wedge::On, Wedge::Off].map(Choice::Wedge),
        // Sliding carries gas through the ends of a tooth: a film that is closed there leaves it out.
        asked: if numerics.flow == Flow::Across {
            Some(true)
        } else {
            (numerics.wedge != Wedge::Auto).then_some(numerics.wedge == Wedge::Off)
        },
        effect: wedge_effect(numbers, motor, rotor),
        unresolved: upwinding(numbers, motor, along),
        number: numbers.bearing_to_squeeze,
    }
    .decide(spec)
}

pub(super) fn time(
    numerics: &Numerics,
    numbers: &Dimensionless,
    motor: &Motor,
    rotor: &Compliances,
    spec: &Spec,
) -> Decision {
    let [layer_along, layer] = layers(numbers, motor);
    // With flow factors the flow depends on the gap differently than between smooth faces, and no bound is known.
    let rough = if motor.surface.flow.is_some() { 1.0 } else { 0.0 };
    Reduction {
        choices: [Time::March, Time::Trapped].map(Choice::Time),
        asked: (numerics.time != Time::Auto).then_some(numerics.time == Time::Trapped),
        effect: leaks(motor, layer_along, active_length(motor))
            + leaks(motor, layer, motor.contact_width)
            + 2.0 * unevenness(motor) * end_share(motor)
            + yielding(motor, rotor, layer)
            + if motor.shear { wedge_effect(numbers, motor, rotor) } else { 0.0 }
            + rough,
        unresolved: 0.0,
        number: layer / motor.tooth_width.min(motor.contact_width),
    }
    .decide(spec)
}

/// `sliding`: whether the wedge term is solved, which needs the ends of a tooth.
pub(super) fn flow(
    numerics: &Numerics,
    numbers: &Dimensionless,
    motor: &Motor,
    spec: &Spec,
    sliding: bool,
) -> Decision {
    let [layer_along, layer] = layers(numbers, motor);
    // Beyond the layers, gas that stays for many cycles is that of the nearest edges: it changes, as far from the edges
    // left out as the film is narrow, if gaps differ from place to place. They do under a crowned tooth, and they do
    // along a tooth that moves with few others.
    let (length, width) = (motor.tooth_width, motor.contact_width);
    let uneven = unevenness(motor);
    // (Without the ends of a film that is wider than long, nothing is left of what feeds it.)
    let ends = match width > length || sliding {
        true => 1.0,
        false => leaks(motor, layer_along, active_length(motor)) + uneven * width / length,
    };
    let few = 1.0 / motor.teeth as f64;
    let sides = leaks(motor, layer, width) + (2.0 * uneven + few) * (length / width).min(1.0);
    // The leaks at the ends of the longer side matter less.
    let along = match numerics.flow {
        Flow::Along => true,
        Flow::Across => false,
        Flow::Auto | Flow::Plane => motor.contact_width > motor.tooth_width,
    };
    Reduction {
        choices: [Flow::Plane, if along { Flow::Along } else { Flow::Across }].map(Choice::Flow),
        asked: (numerics.flow != Flow::Auto).then_some(numerics.flow != Flow::Plane),
        effect: if along { sides } else { ends },
        unresolved: 0.0,
        number: if along { layer / motor.contact_width } else { layer_along / motor.tooth_width },
    }
    .decide(spec)
}

/// Effect of the leaks at two edges a `length` \[m\] apart, relative to α; `layer` \[m\] is that of the closed film.
fn leaks(motor: &Motor, layer: f64, length: f64) -> f64 {
    let open = 1.0 + (motor.normal_amplitude + crown(motor)) / motor.min_spacing;
    LEAK_EFFECT * open * layer / length
}

/// Effect of the wedge term, relative to α, the sum of three, times how much more gas rough faces drag in:
///
/// * Λ/σ = U/(2ωb) for what it carries over the ends of a tooth, and U k h/(2ωA) for what it squeezes, by how much ∂x(hU/2)
///   adds to the wave's ∂h/∂t, h being the mean gap; or what it changes where teeth roll more than they open ([`rolling`]): the
///   largest of the three;
/// * the square of B/2 over the boundary layer, by which it shifts the layer at the ends to and fro, and with it the gas that
///   they hold in the long run: in as much of the tooth as the film is wide;
/// * if the rotor turns, how far that carries gas along a tooth, V_R τ/(2b), until it has leaked out of the closed film after
///   τ = 1/(π² D (1/b² + 1/w²)); under a crown over √(2 R H_m), where it opens the closed film by a quarter at most, if that is
///   less than b: what is carried into the narrowest gap is compressed there. This is a share of α with the term.
fn wedge_effect(numbers: &Dimensionless, motor: &Motor, rotor: &Compliances) -> f64 {
    let shifted = (0.5 * motor.tangential_amplitude / numbers.boundary_layer).powi(2).min(1.0);
    let squeezed = sliding_effect(numbers.bearing_to_squeeze, motor).max(rolling(numbers, motor, rotor));
    let oscillating = squeezed + WEDGE_EFFECT * shifted * end_share(motor);
    (dragged(motor) * (oscillating + carried(numbers, motor, motor.rotor_speed))).min(1.0)
}

/// Effect of the wedge term under teeth that roll, relative to α. The wave also tilts a tooth, by up to k A, which moves the place
/// where a crown is highest to and fro by R k A. Sliding carries the gas after it, by up to B/2. If nothing else squeezes the
/// gas, that leaves B/(2 R k A) less squeezing, and twice as much less of α, which goes with its square. At the ends of a tooth,
/// whose gas is in w/b of it, the slope H/δ across the layer counts like that of the crown. If the gap also opens, by e, rolling
/// is only t²/(e² + t²) of the squeezing, t being the tilt times half the length that takes part. One tooth a wave never
/// opens: the rotor rides up and down with it. A rotor that follows the wave leaves less of A: e.
fn rolling(numbers: &Dimensionless, motor: &Motor, rotor: &Compliances) -> f64 {
    let amplitude = motor.normal_amplitude;
    let wavenumber = TAU / motor.wavelength();
    let opening = (amplitude - followed(motor, rotor)).max(LEAST_OPENING * amplitude);
    let tilt = 0.5 * wavenumber * active_length(motor) * amplitude;
    let share = if motor.teeth == 1 { 1.0 } else { tilt.powi(2) / (opening.powi(2) + tilt.powi(2)) };
    let ends = motor.min_spacing / numbers.boundary_layer * end_share(motor) / motor.tooth_width;
    let slope = motor.tooth_radius.map_or(0.0, f64::recip) + ends;
    motor.tangential_amplitude * slope / (wavenumber * opening) * share
}

/// How far the rotor follows the wave \[m\] if it presses on tooth j of n with L/n (1 + cos 2πj/n), as when the last tooth is about to
/// lift off: harmonics j n ± 1 of amplitude L/λ, of which those shorter than what a tooth is active on do not count.
fn followed(motor: &Motor, rotor: &Compliances) -> f64 {
    let length = motor.wavelength();
    let times = |n: usize| [n - 1, n + 1].iter().filter(|m| m.is_multiple_of(motor.teeth)).count() as f64;
    let shortest = ((length / active_length(motor)) as usize).max(1);
    motor.load / length * (1..=shortest).map(|n| times(n) * rotor.harmonic(n)).sum::<f64>()
}

/// Bound of the effect of the wedge term, relative to α, if the rotor's speed changes by `speed` \[m/s\].
pub fn wedge_bound(motor: &Motor, speed: f64) -> f64 {
    let omega = TAU * motor.frequency;
    let sliding = sliding_effect(speed.abs() / (2.0 * omega * motor.tooth_width), motor);
    (dragged(motor) * (sliding + carried(&Dimensionless::of_motor(motor), motor, speed))).min(1.0)
}

/// Factor by which sliding drags more gas into a closed film between rough faces than between smooth ones, at least 1.
fn dragged(motor: &Motor) -> f64 {
    motor.surface.flow.map_or(1.0, |roughness| roughness.at(motor.min_spacing).dragged.max(1.0))
}

fn sliding_effect(bearing_to_squeeze: f64, motor: &Motor) -> f64 {
    let wave = TAU * motor.tooth_width / motor.wavelength();
    let squeezed = wave * (1.0 + motor.min_spacing / motor.normal_amplitude);
    WEDGE_EFFECT * bearing_to_squeeze * squeezed.max(1.0)
}

/// Effect of steady sliding at `speed` \[m/s\], relative to α without it: how far it carries gas along a tooth until that has leaked out,
/// over twice the length that the closed film is even on, is a share of α with it.
fn carried(numbers: &Dimensionless, motor: &Motor, speed: f64) -> f64 {
    let [along, across] = diffusivities(numbers, motor);
    let rate = PI.powi(2) * (along * motor.tooth_width.powi(-2) + across * motor.contact_width.powi(-2));
    let even = motor.tooth_radius.map_or(f64::INFINITY, |radius| (2.0 * radius * motor.min_spacing).sqrt());
    let share = 0.5 * speed.abs() / (rate * motor.tooth_width.min(even));
    share / (1.0 - share.min(1.0))
}

/// Share of a tooth whose gas is, in the long run, that of its ends rather than of its sides.
fn end_share(motor: &Motor) -> f64 {
    (motor.contact_width / motor.tooth_width).min(1.0)
}

/// Flow along a tooth over that across it, least and greatest: between rough faces they differ, the more so the narrower the gap, which under
/// load is narrower than the minimum spacing.
fn along_over_across(motor: &Motor) -> [f64; 2] {
    let Some(roughness) = &motor.surface.flow else { return [1.0, 1.0] };
    let [a, b] = [motor.min_spacing, LEAST_RATIO * roughness.rms].map(|gap| roughness.at(gap));
    let [a, b] = [a, b].map(|flow| flow.along / flow.across);
    [a.min(b), a.max(b)]
}

/// Boundary layers of the closed film \[m\] at the ends of a tooth, at most, and at its sides.
fn layers(numbers: &Dimensionless, motor: &Motor) -> [f64; 2] {
    let [_, greatest] = along_over_across(motor);
    [numbers.boundary_layer * greatest.sqrt(), numbers.boundary_layer]
}

/// Diffusivities of the gas in the closed film \[m²/s\], along a tooth, at least, and across it.
fn diffusivities(numbers: &Dimensionless, motor: &Motor) -> [f64; 2] {
    let (across, [least, _]) = (0.5 * numbers.boundary_layer.powi(2) * TAU * motor.frequency, along_over_across(motor));
    [across * least, across]
}

/// Effect of the upwinding that the wedge term needs on a grid of so many intervals along a tooth, relative to α. None below a
/// cell Péclet number U Δ/(2D) of 1, where exponential fitting is of second order.
fn upwinding(numbers: &Dimensionless, motor: &Motor, along: usize) -> f64 {
    let speed = motor.rotor_speed.abs() + motor.stator_speed();
    let peclet = 0.5 * speed * motor.tooth_width / (along as f64 * diffusivities(numbers, motor)[0]);
    let each = UPWINDING + UPWINDING_UNEVEN * unevenness(motor) * end_share(motor);
    (each * (peclet - 1.0)).clamp(0.0, 1.0)
}

/// Height of a tooth's crown above its ends \[m\].
pub(super) fn crown(motor: &Motor) -> f64 {
    motor.tooth_radius.map_or(0.0, |radius| motor.tooth_width * motor.tooth_width / (8.0 * radius))
}

/// Height of the crown as a fraction of the mean gap at a tooth's ends.
fn unevenness(motor: &Motor) -> f64 {
    crown(motor) / (crown(motor) + motor.normal_amplitude + motor.min_spacing)
}

/// Bound of what the rotor's deflection under the film's own pressure changes, relative to α. In the boundary layer at the ends
/// of a tooth the pressure falls to ambient. The rotor deflects less there, so the gap is smaller and holds less gas. The bound
/// is twice that change of the gap over the mean gap, times the force of the compressed gas over the load if that exceeds 1.
fn yielding(motor: &Motor, rotor: &Compliances, layer: f64) -> f64 {
    let pressure = motor.gas.ambient_pressure * motor.contact_width;
    let bulge = rotor.longer_than(1.0 / layer) * pressure / (motor.normal_amplitude + motor.min_spacing);
    let stiffness = pressure * motor.tooth_width * motor.teeth as f64 / motor.load;
    2.0 * bulge * end_share(motor) * stiffness.max(1.0)
}

/// Length of tooth \[m\] over which a crown opens the gap by no more than the wave does.
fn active_length(motor: &Motor) -> f64 {
    let opening = motor.normal_amplitude + motor.min_spacing;
    motor.tooth_radius.map_or(motor.tooth_width, |radius| motor.tooth_width.min((8.0 * radius * opening).sqrt()))
}
