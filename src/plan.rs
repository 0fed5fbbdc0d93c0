//! What THIS scene needs: which terms, how many teeth, which symmetries, which grids, and why (shown to the user).

use crate::dimensionless::Dimensionless;
use crate::fidelity::{Fidelity, GRIDS, Spec};
use crate::film::slip::{Mobility, SlipLaw};
use crate::numerics::grading::{clustering, map, middle_clustering};
use crate::problem::{Flow, Motor, Named, Numerics, Plate, RotorCompliance, Teeth, Time, Wedge, Width};
use crate::rotor::{Compliances, MOST_HARMONICS, RESONANCES, RotorError};
use std::f64::consts::{PI, TAU};

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

impl Grid {
    /// Work of one cycle, in multiplications of the elimination: its blocks are full across the width.
    pub fn work(&self) -> f64 {
        (self.along * self.across.max(1).pow(2) * self.steps) as f64
    }

    /// Twice as fine. A polynomial across stays what it is.
    pub fn finer(&self, spectral: bool) -> Self {
        Self {
            along: 2 * self.along,
            across: if spectral { self.across } else { 2 * self.across },
            steps: 2 * self.steps,
            harmonic_fraction: 0.25 * self.harmonic_fraction,
        }
    }
}

/// What was decided about one part of the model; `analysis::decision` says it, and why, in words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// The part, and how it is solved.
    pub chosen: Choice,
    /// Whether the scene overruled what the plan would have done.
    pub overruled: bool,
    /// Bound of what it changes, relative to α; 0 is exact.
    pub effect: f64,
    /// What speaks for and against leaving the part out; `None` if nothing had to be weighed.
    pub weighed: Option<Weighed>,
}

/// A part of the model, and how it is solved. None of the switches is ever `Auto`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// Leaking of the gas in time.
    Time(Time),
    /// Directions in which the film flows.
    Flow(Flow),
    /// The wedge term.
    Wedge(Wedge),
    /// No wedge term, because the scene says `shear = false`.
    NoShear,
    /// Teeth whose film is solved, of so many.
    Teeth(Teeth, usize),
    /// Width of the film.
    Width(Width),
    /// The finest grid of a motor.
    MotorGrid {
        /// Intervals along a tooth, intervals or nodes across half the width, steps in a cycle.
        grid: Grid,
        /// Boundary layer of the film \[m\].
        layer: f64,
        /// First interval along, as a share of that layer.
        edge_fraction: f64,
        /// The intervals along are densest in the middle, where the crown is highest.
        middle: bool,
        /// Across the width a field is a polynomial.
        spectral: bool,
    },
    /// The finest grid of a plate; across half the width `None` of a strip.
    PlateGrid {
        /// Intervals along half the length.
        along: usize,
        /// Intervals across half the width.
        across: Option<usize>,
    },
    /// Steps in a cycle of a plate, and whether they are the shorter the closer it is.
    Steps(usize, bool),
    /// A rotor that is known to a stated error only.
    Rotor {
        /// [`Compliances::relative_error`].
        error: f64,
        /// Whether it is computed from its cross-section.
        ring: bool,
        /// Lowest natural frequency of the shape of each of the first harmonics \[Hz\], of a ring; a draft does not ask for it.
        resonances: Option<[f64; RESONANCES]>,
    },
    /// Nothing leaks from under a plate: its gas is trapped.
    NoLeaks,
}

/// What speaks for and against leaving out a part of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighed {
    /// How the part is solved if it is left out.
    pub reduced: Choice,
    /// The number that decides: Λ/σ of the wedge term; otherwise the film's boundary layer over the side of a tooth that the gas
    /// would have to leak out along, of the leaking in time the shorter one.
    pub number: f64,
    /// Whether the scene says so.
    pub asked: bool,
    /// Bound of what leaving it out changes, relative to α.
    pub effect: f64,
    /// Bound of what solving it costs, because the grid is too coarse for it, relative to α.
    pub unresolved: f64,
    /// The fidelity, and the error of α that it aims at, relative.
    pub fidelity: Fidelity,
    /// See `fidelity`.
    pub aim: f64,
}

impl Decision {
    /// Of what is exact, and what nothing overrules.
    fn exact(chosen: Choice) -> Self {
        Self { chosen, overruled: false, effect: 0.0, weighed: None }
    }

    /// The key that overrules it, if there is one: "numerics.wedge".
    pub fn key(&self) -> Option<&'static str> {
        match self.chosen {
            Choice::Time(_) => Some("numerics.time"),
            Choice::Flow(_) => Some("numerics.flow"),
            Choice::Wedge(_) => Some("numerics.wedge"),
            Choice::Teeth(..) => Some("numerics.teeth"),
            Choice::Width(_) => Some("numerics.width"),
            Choice::NoShear | Choice::NoLeaks | Choice::Rotor { .. } => None,
            Choice::MotorGrid { .. } | Choice::PlateGrid { .. } | Choice::Steps(..) => None,
        }
    }

    /// The value that key would need for the same decision: "off"; empty if there is no key for the part.
    pub fn value(&self) -> &'static str {
        match self.chosen {
            Choice::Time(time) => time.name(),
            Choice::Flow(flow) => flow.name(),
            Choice::Wedge(wedge) => wedge.name(),
            Choice::Teeth(teeth, _) => teeth.name(),
            Choice::Width(width) => width.name(),
            Choice::NoShear | Choice::NoLeaks | Choice::Rotor { .. } => "",
            Choice::MotorGrid { .. } | Choice::PlateGrid { .. } | Choice::Steps(..) => "",
        }
    }
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
    /// Clustering parameter of the steps of a cycle about its middle, where a plate is closest; 0: even steps.
    pub clustering_in_time: f64,
    /// Frames of a recording for each step: a recording is even in time, steps that cluster are not.
    pub frames_per_step: usize,
    /// Across the width a field is one polynomial, on the same nodes on all grids; or finite volumes, which nothing breaks.
    pub spectral: bool,
    /// A plate is solved turned by a quarter: much wider than it is long, it has its polynomial along the length.
    pub turned: bool,
    /// Solve half the width and mirror it.
    pub half_width: bool,
    /// Solve every tooth (or one, by lag symmetry).
    pub every_tooth: bool,
    /// Solve the wedge term.
    pub shear: bool,
    /// Directions in which the film flows; never `Auto`.
    pub flow: Flow,
    /// The gas has no time to move: its trapped height does not change during the cycle.
    pub trapped: bool,
    /// Bound of what everything that was left out changes, relative to α.
    pub left_out: f64,
    /// The rotor; a plate has none.
    pub rotor: Compliances,
    /// Rotor harmonics kept at most.
    pub most_harmonics: usize,
    /// Error of α asked for, relative; 0 on grids that were asked for, which are not refined.
    pub accuracy: f64,
    /// The error of α that the fidelity aims at, relative, whether or not the grids were asked for.
    pub aim: f64,
    /// Grids at most, those of `grids` included, and unknown nodes of a polynomial across half the width.
    pub most_grids: usize,
    /// See `most_grids`.
    pub most_across: usize,
    /// Nodes across and their clustering, should it have to be finite volumes.
    pub robust: (usize, f64),
    /// Largest relative change that counts as a repeating cycle.
    pub tolerance: f64,
    /// Rounds of the coupling after which the solve gives up.
    pub round_limit: usize,
    /// Record the pressure maps of the cycle, the largest of the fields.
    pub maps: bool,
    /// What was decided, part by part.
    pub decisions: Vec<Decision>,
}

/// Effect on α, relative, of leaving out the wedge term, as a multiple of U/(2ω) over the length that gas or gap vary
/// along (measured, and bounded by `tests/plan.rs`).
const WEDGE_EFFECT: f64 = 2.0;
/// Effect on α, relative, of solving the wedge term where a cell's Péclet number is above 1, per unit of that number: the
/// upwinding it then needs spreads the gas in its stead; and more of it, the more unevenly a crown holds it (measured, and
/// bounded by `tests/plan.rs`).
const UPWINDING: f64 = 1e-4;
const UPWINDING_UNEVEN: f64 = 0.1;
/// Effect on α, relative, of leaving out the leaks at one pair of edges, as a multiple of their layer over the length
/// between them, the layer being that of the closed film times how far the gap opens in the mean. Of a plate whose gap
/// is uniform it is 1 as the amplitude vanishes, tanh(κ/2)/(κ/2), and less for a larger one (`film::exact`); a rotor that
/// is half afloat opens the gap a little more.
const LEAK_EFFECT: f64 = 1.2;
/// Effect on α, relative, of an error of the rotor's compliance, as a multiple of [`Compliances::relative_error`] (measured, and bounded by
/// `tests/plan.rs`).
pub const ROTOR_EFFECT: f64 = 2.0;
/// Share of the fidelity's aim that may be left out with each term.
const SHARE: f64 = 0.2;
/// Intervals that a crowned tooth gets beyond those of a flat one, as a multiple of them, for each factor of e by which the
/// intervals in its middle are shorter than uniform ones.
const MIDDLE: f64 = 1.0;
/// Boundary layer over half the width down to which a polynomial across is used: a thinner one asks for so strong a stretching that
/// the nodes in between no longer tell what the last one changes.
const THINNEST_LAYER: f64 = 0.03;
/// Grids beyond those of the plan, at most: each costs about four times the one before.
const MORE_GRIDS: usize = 3;
/// The same of a plate, and the frames of a recording beyond which there is none.
const MORE_GRIDS_OF_PLATE: usize = 6;
const MOST_FRAMES: usize = 1 << 17;
/// Frames within the peak of a plate's load as it nearly touches, and the narrowest such peak \[rad\] that is followed.
const FRAMES_IN_PEAK: f64 = 2.0;
const NARROWEST_PEAK: f64 = 2e-4;
/// Clustered steps of a cycle for each of even ones, and for each factor of e by which the peak is narrower than the cycle.
const STEPS_IN_FACTOR: f64 = 0.6;
/// Even steps that such a peak needs, over those of a plate far from touching, above which they cluster.
const CLUSTERED: f64 = 2.0;
/// Intervals along a tooth that leave a node to solve on the coarsest grid.
const FEWEST_ALONG: usize = 2 << (GRIDS - 1);
const ROUND_LIMIT: usize = 300;

impl Plan {
    /// The plan of a motor at a fidelity; `numerics` overrules.
    ///
    /// # Errors
    /// [`RotorError`] if the rotor has no compliance.
    pub fn motor(motor: &Motor, fidelity: Fidelity, numerics: &Numerics) -> Result<Self, RotorError> {
        Self::motor_to(motor, fidelity, &fidelity.spec(), numerics)
    }

    /// The plan of a motor to a specification.
    ///
    /// # Errors
    /// As [`Plan::motor`].
    pub fn motor_to(motor: &Motor, fidelity: Fidelity, spec: &Spec, numerics: &Numerics) -> Result<Self, RotorError> {
        let numbers = Dimensionless::of_motor(motor);
        let layer = numbers.boundary_layer;
        let in_layer = (motor.wavelength() / (TAU * layer)) as usize;
        let rotor = motor.compliances(in_layer.clamp(spec.most_harmonics, MOST_HARMONICS))?;
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
        let across = numerics.film_nodes_across.map_or(spec.across, |n| (n / 2).max(1));
        let spectral = layer / half > THINNEST_LAYER;
        let (across, clustering_across) = if spectral { (across, spectral_clustering(layer / half)) } else { robust };
        let steps_per_pitch = numerics.steps_per_cycle.unwrap_or(spec.steps).div_ceil(motor.teeth);
        let steps = round_up(steps_per_pitch) * motor.teeth;

        let time = time(numerics, &numbers, motor, &rotor, fidelity, spec);
        let flow = flow(numerics, &numbers, motor, fidelity, spec);
        let wedge = wedge(numerics, &numbers, motor, along, fidelity, spec);
        let trapped = time.chosen == Choice::Time(Time::Trapped);
        let half_width = numerics.width != Width::Full;
        let every_tooth = numerics.teeth == Teeth::All;
        let finest = Grid { along, across, steps, harmonic_fraction: spec.harmonic_fraction };
        let grid = Choice::MotorGrid { grid: finest, layer, edge_fraction: spec.edge_fraction, middle, spectral };
        let grid = Decision { overruled: custom(numerics), ..Decision::exact(grid) };
        let decisions: Vec<Decision> = [time, flow, wedge, teeth(numerics, motor), width(numerics), grid]
            .into_iter()
            .chain(elements(motor, &rotor, spec)?)
            .collect();
        // What the trapped limit leaves out, it leaves out once.
        let moving =
            |decision: &&Decision| !trapped || matches!(decision.chosen, Choice::Time(_) | Choice::Rotor { .. });
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
            shear: !trapped && wedge.chosen == Choice::Wedge(Wedge::On),
            flow: match flow.chosen {
                Choice::Flow(flow) => flow,
                _ => Flow::Plane,
            },
            trapped,
            left_out: decisions.iter().filter(moving).map(|decision| decision.effect).sum(),
            rotor,
            most_harmonics: spec.most_harmonics,
            accuracy: if custom(numerics) { 0.0 } else { spec.aim },
            aim: spec.aim,
            most_grids: if custom(numerics) { GRIDS } else { GRIDS + MORE_GRIDS },
            most_across: if numerics.film_nodes_across.is_some() { across } else { 12 },
            robust,
            tolerance: numerics.tolerance.unwrap_or(spec.tolerance),
            round_limit: ROUND_LIMIT,
            maps: true,
            decisions,
        })
    }

    /// The same plan with finite volumes across.
    pub fn volumes(&self) -> Self {
        let (across, clustering_across) = self.robust;
        let finest = self.grids.last().map(|grid| Grid { across, ..*grid });
        let mut grids = finest.map_or_else(Vec::new, |finest| nested(finest, false));
        // As many grids as there were.
        grids.drain(..grids.len().saturating_sub(self.grids.len()));
        Self { spectral: false, most_grids: grids.len(), grids, clustering_across, ..self.clone() }
    }

    /// The same plan with the sides of the plate as they are in the scene; of finite volumes.
    pub fn not_turned(&self) -> Self {
        if !self.turned {
            return self.clone();
        }
        let grids = self.grids.iter().map(|grid| Grid { along: grid.across, across: grid.along, ..*grid }).collect();
        let (clustering_along, clustering_across) = (self.clustering_across, self.clustering_along);
        Self { grids, clustering_along, clustering_across, turned: false, ..self.clone() }
    }

    /// The same plan marched by even steps, one for each frame.
    pub fn even_steps(&self) -> Self {
        let even = |grid: &Grid| Grid { steps: grid.steps * self.frames_per_step, ..*grid };
        let grids = self.grids.iter().map(even).collect();
        Self { grids, clustering_in_time: 0.0, frames_per_step: 1, trapped: false, ..self.clone() }
    }

    /// The same plan on its finest grid alone: fields as they are solved, and no error estimate.
    pub fn on_one_grid(&self) -> Self {
        let grids = self.grids.last().copied().into_iter().collect();
        Self { grids, most_grids: 1, accuracy: 0.0, ..self.clone() }
    }

    /// The plan of a plate at a fidelity; `numerics` overrules grid sizes.
    pub fn plate(plate: &Plate, fidelity: Fidelity, numerics: &Numerics) -> Self {
        Self::plate_to(plate, fidelity, &fidelity.spec(), numerics)
    }

    /// The plan of a plate to a specification.
    pub fn plate_to(plate: &Plate, fidelity: Fidelity, spec: &Spec, numerics: &Numerics) -> Self {
        let layer = plate_layer(plate);
        let sides = [Some(plate.length), plate.width];
        let leak = sides.into_iter().flatten().map(|side| LEAK_EFFECT * layer / side).sum::<f64>();
        let trapped = leak < SHARE * spec.aim || plate.amplitude == 0.0;
        let left_out = if trapped && plate.amplitude > 0.0 { leak } else { 0.0 };
        // Of a long plate the ends reach as far as it is narrow.
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
        let (along, clustering_along) = graded(spec.plate, asked_along, 0.5 * plate.length, edge);
        let layer = reach(plate.length);
        let edge = spec.plate_edge_fraction * layer;
        let spectral = plate.width.is_some_and(|width| !thin(width, plate.length));
        let (across, clustering_across, robust) = match plate.width {
            Some(width) => {
                let across = asked_across.map_or(spec.across, |asked| asked.max(1));
                let robust = graded(spec.plate, asked_across, 0.5 * width, edge);
                if spectral {
                    (across, spectral_clustering(2.0 * layer / width), robust)
                } else {
                    (robust.0, robust.1, robust)
                }
            }
            None => (0, 0.0, (0, 0.0)),
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
                // One of them, on all grids, where the plate is closest.
                (steps.next_multiple_of(2 << (GRIDS - 1)), -beta)
            }
            None => (spec.plate_steps.max(follow as usize), 0.0),
        };
        let steps = round_up(steps);
        let frames_per_step = if clustering_in_time == 0.0 { 1 } else { (follow as usize).div_ceil(steps) };
        let more_grids = (0..=MORE_GRIDS_OF_PLATE).rev().find(|more| (frames_per_step * steps) << more <= MOST_FRAMES);
        let more_grids = more_grids.unwrap_or(0);
        let grid = Choice::PlateGrid { along, across: plate.width.map(|_| across) };
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
            rotor: Compliances::none(),
            most_harmonics: spec.most_harmonics,
            accuracy: if custom(numerics) { 0.0 } else { spec.aim },
            aim: spec.aim,
            most_grids: if custom(numerics) { GRIDS } else { GRIDS + more_grids },
            most_across: if asked_across.is_some() { across } else { 24 },
            robust,
            tolerance: numerics.tolerance.unwrap_or(spec.plate_tolerance),
            round_limit: ROUND_LIMIT,
            maps: true,
            decisions,
        }
    }
}

/// A decision to leave a term out, if what that changes is small enough and the switch allows it.
struct Reduction {
    /// For the whole model, and for the reduced one.
    choices: [Choice; 2],
    /// What the switch says, `None` if it is left to the plan.
    asked: Option<bool>,
    /// As of [`Weighed`].
    effect: f64,
    unresolved: f64,
    number: f64,
}

impl Reduction {
    fn decide(self, fidelity: Fidelity, spec: &Spec) -> Decision {
        let Self { choices, asked, effect, unresolved, number } = self;
        let allowed = effect <= SHARE * spec.aim || effect < unresolved;
        let left_out = asked.unwrap_or(allowed);
        let [_, reduced] = choices;
        let aim = spec.aim;
        let weighed = Weighed { reduced, number, asked: asked.is_some(), effect, unresolved, fidelity, aim };
        Decision {
            chosen: choices[usize::from(left_out)],
            overruled: asked.is_some_and(|asked| asked != allowed),
            effect: if left_out { effect } else { unresolved },
            weighed: Some(weighed),
        }
    }
}

fn wedge(
    numerics: &Numerics,
    numbers: &Dimensionless,
    motor: &Motor,
    along: usize,
    fidelity: Fidelity,
    spec: &Spec,
) -> Decision {
    if !motor.shear {
        return Decision::exact(Choice::NoShear);
    }
    Reduction {
        choices: [Wedge::On, Wedge::Off].map(Choice::Wedge),
        asked: match numerics.wedge {
            Wedge::Auto => None,
            Wedge::On => Some(false),
            Wedge::Off => Some(true),
        },
        effect: wedge_effect(numbers, motor),
        unresolved: upwinding(numbers, motor, along),
        number: numbers.bearing_to_squeeze,
    }
    .decide(fidelity, spec)
}

fn time(
    numerics: &Numerics,
    numbers: &Dimensionless,
    motor: &Motor,
    rotor: &Compliances,
    fidelity: Fidelity,
    spec: &Spec,
) -> Decision {
    let layer = numbers.boundary_layer;
    Reduction {
        choices: [Time::March, Time::Trapped].map(Choice::Time),
        asked: match numerics.time {
            Time::Auto => None,
            Time::March => Some(false),
            Time::Trapped => Some(true),
        },
        effect: leaks(motor, layer, active_length(motor))
            + leaks(motor, layer, motor.contact_width)
            + 2.0 * unevenness(motor) * end_share(motor)
            + yielding(motor, rotor, layer)
            + if motor.shear { wedge_effect(numbers, motor) } else { 0.0 },
        unresolved: 0.0,
        number: layer / motor.tooth_width.min(motor.contact_width),
    }
    .decide(fidelity, spec)
}

fn flow(numerics: &Numerics, numbers: &Dimensionless, motor: &Motor, fidelity: Fidelity, spec: &Spec) -> Decision {
    let layer = numbers.boundary_layer;
    // Beyond the layers, gas that stays for many cycles is that of the nearest edges: it changes, as far from the edges
    // left out as the film is narrow, if gaps differ from place to place. They do under a crowned tooth, and they do
    // along a tooth that moves with few others.
    let (length, width) = (motor.tooth_width, motor.contact_width);
    let uneven = unevenness(motor);
    // (Without the ends of a film that is wider than long, nothing is left of what feeds it.)
    let ends = if width > length { 1.0 } else { leaks(motor, layer, active_length(motor)) + uneven * width / length };
    let few = 1.0 / motor.teeth as f64;
    let sides = leaks(motor, layer, width) + (2.0 * uneven + few) * (length / width).min(1.0);
    // The longer side's leaks matter less.
    let along = match numerics.flow {
        Flow::Along => true,
        Flow::Across => false,
        Flow::Auto | Flow::Plane => motor.contact_width > motor.tooth_width,
    };
    Reduction {
        choices: [Flow::Plane, if along { Flow::Along } else { Flow::Across }].map(Choice::Flow),
        asked: match numerics.flow {
            Flow::Auto => None,
            Flow::Plane => Some(false),
            Flow::Across | Flow::Along => Some(true),
        },
        effect: if along { sides } else { ends },
        unresolved: 0.0,
        number: layer / if along { motor.contact_width } else { motor.tooth_width },
    }
    .decide(fidelity, spec)
}

/// Effect of the leaks at two edges a `length` \[m\] apart, relative to α; `layer` \[m\] is that of the closed film.
fn leaks(motor: &Motor, layer: f64, length: f64) -> f64 {
    let open = 1.0 + (motor.normal_amplitude + crown(motor)) / motor.min_spacing;
    LEAK_EFFECT * open * layer / length
}

/// Effect of the wedge term, relative to α, the sum of four:
///
/// * Λ/σ = U/(2ωb) for what it carries over the ends of a tooth, and U k h/(2ωA) for what it squeezes, by how much ∂x(hU/2)
///   adds to the wave's ∂h/∂t, h being the mean gap: the larger of the two;
/// * the square of B/2 over the boundary layer, by which it shifts the layer at the ends to and fro, and with it the gas that
///   they hold in the long run: in as much of the tooth as the film is wide;
/// * if the rotor turns, how far that carries gas along a tooth, V_R τ/(2b), until it has leaked out of the closed film after
///   τ = 1/(π² D (1/b² + 1/w²)).
fn wedge_effect(numbers: &Dimensionless, motor: &Motor) -> f64 {
    let shifted = (0.5 * motor.tangential_amplitude / numbers.boundary_layer).powi(2).min(1.0);
    let oscillating = sliding_effect(numbers.bearing_to_squeeze, motor) + WEDGE_EFFECT * shifted * end_share(motor);
    (oscillating + carried(numbers, motor, motor.rotor_speed)).min(1.0)
}

/// Bound of what the wedge changes, relative to α, if the rotor's speed changes by `speed` \[m/s\].
pub fn wedge_bound(motor: &Motor, speed: f64) -> f64 {
    let omega = TAU * motor.frequency;
    let sliding = sliding_effect(speed.abs() / (2.0 * omega * motor.tooth_width), motor);
    (sliding + carried(&Dimensionless::of_motor(motor), motor, speed)).min(1.0)
}

fn sliding_effect(bearing_to_squeeze: f64, motor: &Motor) -> f64 {
    let wave = TAU * motor.tooth_width / motor.wavelength();
    let squeezed = wave * (1.0 + motor.min_spacing / motor.normal_amplitude);
    WEDGE_EFFECT * bearing_to_squeeze * squeezed.max(1.0)
}

/// How far steady sliding at `speed` \[m/s\] carries gas along a tooth until it has leaked out, over twice its length.
fn carried(numbers: &Dimensionless, motor: &Motor, speed: f64) -> f64 {
    let wavenumber = PI.powi(2) * (motor.tooth_width.powi(-2) + motor.contact_width.powi(-2));
    0.5 * speed.abs() / (diffusivity(numbers, motor) * wavenumber * motor.tooth_width)
}

/// Share of a tooth whose gas is, in the long run, that of its ends rather than of its sides.
fn end_share(motor: &Motor) -> f64 {
    (motor.contact_width / motor.tooth_width).min(1.0)
}

/// Diffusivity of the gas in the closed film \[m²/s\].
fn diffusivity(numbers: &Dimensionless, motor: &Motor) -> f64 {
    0.5 * numbers.boundary_layer.powi(2) * TAU * motor.frequency
}

/// Effect of the upwinding that the wedge term needs on a grid of so many intervals along a tooth, relative to α. None below a
/// cell Péclet number U Δ/(2D) of 1, where exponential fitting is of second order.
fn upwinding(numbers: &Dimensionless, motor: &Motor, along: usize) -> f64 {
    let speed = motor.rotor_speed.abs() + motor.surface_speed();
    let peclet = 0.5 * speed * motor.tooth_width / (along as f64 * diffusivity(numbers, motor));
    let each = UPWINDING + UPWINDING_UNEVEN * unevenness(motor) * end_share(motor);
    (each * (peclet - 1.0)).clamp(0.0, 1.0)
}

/// Height of a tooth's crown above its ends \[m\].
fn crown(motor: &Motor) -> f64 {
    motor.tooth_radius.map_or(0.0, |radius| motor.tooth_width * motor.tooth_width / (8.0 * radius))
}

/// Length \[m\] in the middle of a crowned tooth over which its crown opens the gap by H_m: the film that carries, at the least.
fn crown_length(motor: &Motor) -> f64 {
    motor.tooth_radius.map_or(f64::INFINITY, |radius| (8.0 * radius * motor.min_spacing).sqrt())
}

/// Share of the mean gap at a tooth's ends that is its crown's.
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

/// Of a rotor that is known to a stated error only.
fn elements(motor: &Motor, rotor: &Compliances, spec: &Spec) -> Result<Option<Decision>, RotorError> {
    let error = rotor.relative_error();
    if error == 0.0 {
        return Ok(None);
    }
    let ring = matches!(motor.rotor, RotorCompliance::Ring(_));
    let resonances = if spec.aim < Fidelity::Draft.accuracy() { motor.resonances()? } else { None };
    let chosen = Choice::Rotor { error, ring, resonances };
    Ok(Some(Decision { effect: ROTOR_EFFECT * error, ..Decision::exact(chosen) }))
}

fn teeth(numerics: &Numerics, motor: &Motor) -> Decision {
    let all = numerics.teeth == Teeth::All;
    let teeth = if all { Teeth::All } else { Teeth::One };
    Decision { overruled: all, ..Decision::exact(Choice::Teeth(teeth, motor.teeth)) }
}

fn width(numerics: &Numerics) -> Decision {
    let full = numerics.width == Width::Full;
    let width = if full { Width::Full } else { Width::Half };
    Decision { overruled: full, ..Decision::exact(Choice::Width(width)) }
}

fn custom(numerics: &Numerics) -> bool {
    numerics.film_nodes_along.or(numerics.film_nodes_across).or(numerics.steps_per_cycle).is_some()
        || numerics.tolerance.is_some()
}

fn name(fidelity: Fidelity, numerics: &Numerics) -> String {
    if custom(numerics) { "custom".to_owned() } else { fidelity.to_string() }
}

/// The boundary layer of a plate's film \[m\], by its slip law ([`Dimensionless::boundary_layer`] estimates it).
fn plate_layer(plate: &Plate) -> f64 {
    let gas = &plate.gas;
    let conductance = plate.mean_gap * SlipLaw::of(gas).at(plate.mean_gap).0;
    (gas.ambient_pressure * conductance / (6.0 * gas.viscosity * TAU * plate.frequency)).sqrt()
}

/// Rounded up so that it can be halved for the coarser grids.
fn round_up(count: usize) -> usize {
    count.max(1).next_multiple_of(1 << (GRIDS - 1))
}

/// The grids down to the coarsest. A polynomial across is the same on all of them.
fn nested(finest: Grid, spectral: bool) -> Vec<Grid> {
    (0..GRIDS)
        .rev()
        .map(|halved| Grid {
            along: finest.along >> halved,
            across: if spectral { finest.across } else { finest.across >> halved },
            steps: finest.steps >> halved,
            harmonic_fraction: finest.harmonic_fraction * (1 << (2 * halved)) as f64,
        })
        .collect()
}

/// Clustering of spectral nodes for a boundary layer of `layer` times the half width: the edge's interval of a polynomial with three
/// nodes, 0.17 of the half width without clustering, is at most 1.5 layers.
fn spectral_clustering(layer: f64) -> f64 {
    const OUTERMOST: f64 = 0.830_223_896_278_567;
    let interval = |beta: f64| 1.0 - map(beta, OUTERMOST);
    let asked = 1.5 * layer;
    let (mut low, mut high) = (0.0, 20.0);
    if interval(low) <= asked {
        return 0.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if interval(middle) > asked { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Intervals over `length` and their clustering, so that the first is `edge` \[m\]. A thin layer gets more of them: the map
/// stretches its interior by about ln(1/ratio)/2.
fn graded(base: usize, asked: Option<usize>, length: f64, edge: f64) -> (usize, f64) {
    let ratio = |intervals: usize| (edge * intervals as f64 / length).max(SMALLEST_RATIO);
    let intervals = match asked {
        Some(asked) => round_up(asked),
        None => round_up((base as f64 * (1.0 + 0.15 * (1.0 / ratio(base)).ln().max(0.0))) as usize),
    };
    (intervals, clustering(ratio(intervals)))
}

/// Edge intervals are not made smaller than this fraction of a uniform grid's.
const SMALLEST_RATIO: f64 = 1e-5;
