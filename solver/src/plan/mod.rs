//! The plan of a solve: the terms, teeth, symmetries and grids that the scene needs, and why (shown to the user).

mod grid;
mod motor;
mod plate;
mod reduction;

pub use grid::Grid;
pub use motor::ROTOR_EFFECT;
pub use reduction::wedge_bound;

use crate::contact::cutoff;
use crate::fidelity::Fidelity;
use crate::problem::{Flow, Numerics, Teeth, Time, Wedge, Width};
use crate::rotor::{Compliances, MOST_HARMONICS, RESONANCES};
use grid::nested;
use serde::{Deserialize, Serialize};

/// The decision about one part of the model; `analysis::decision` of the crate `squeezefilm` describes it, and the reason, in words.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// The part, and how it is solved.
    pub chosen: Choice,
    /// Whether the scene overruled what the plan would have done.
    pub overruled: bool,
    /// Bound of the effect of the decision, relative to α; 0 if the decision is exact.
    pub effect: f64,
    /// Reasons for and against leaving the part out; `None` if there was nothing to weigh.
    pub weighed: Option<Weighed>,
}

/// A part of the model, and how it is solved. None of the switches is ever `Auto`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Choice {
    /// Leaking of the gas in time.
    Time(Time),
    /// Directions in which the film flows.
    Flow(Flow),
    /// The wedge term.
    Wedge(Wedge),
    /// No wedge term, because the scene says `shear = false`.
    NoShear,
    /// Teeth whose film is solved, and the number of teeth.
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
        /// Whether the intervals along are densest in the middle, where the crown is highest.
        middle: bool,
        /// Whether a field is a polynomial across the width.
        spectral: bool,
    },
    /// The finest grid of a plate.
    PlateGrid {
        /// Intervals along half the length, or half a section of a round plate.
        along: usize,
        /// Intervals across half the width; `None` for a strip and a round plate.
        across: Option<usize>,
        /// Whether the plate is a disc or a ring.
        round: bool,
    },
    /// Steps in a cycle of a plate, and whether they are shorter where the plate is closer.
    Steps(usize, bool),
    /// A rotor whose compliance has a stated error.
    Rotor {
        /// [`Compliances::relative_error`].
        error: f64,
        /// Whether the compliance is computed from its cross-section.
        ring: bool,
        /// Of a ring, the lowest natural frequency of the shape of each of the first harmonics \[Hz\]; not computed for a draft.
        resonances: Option<[f64; RESONANCES]>,
    },
    /// Nothing leaks from under a plate: its gas is trapped.
    NoLeaks,
}

/// Reasons for and against leaving out a part of the model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Weighed {
    /// How the part is solved if it is left out.
    pub reduced: Choice,
    /// The number that decides: Λ/σ for the wedge term; otherwise the boundary layer over the distance between the two edges
    /// whose leakage is neglected (for the film in time, the shorter of tooth and contact width).
    pub number: f64,
    /// Whether the scene's switch decides, to solve the part or to leave it out.
    pub asked: bool,
    /// Bound of the effect of leaving the part out, relative to α.
    pub effect: f64,
    /// Bound of the error of solving it on a grid that is too coarse for it, relative to α.
    pub unresolved: f64,
    /// The relative error of α that is asked for.
    pub target_error: f64,
}

impl Decision {
    /// A decision that does not change the result and that no key overrules.
    fn exact(chosen: Choice) -> Self {
        Self { chosen, overruled: false, effect: 0.0, weighed: None }
    }

    /// Its effect, if the scene's switch leaves the part out.
    pub(crate) fn forced(&self) -> f64 {
        let asked = self.weighed.is_some_and(|weighed| weighed.asked && weighed.reduced == self.chosen);
        if asked { self.effect } else { 0.0 }
    }

    /// The key that overrules it, if there is one: "numerics.wedge".
    pub fn key(&self) -> Option<&'static str> {
        self.switch().map(|(key, _)| key)
    }

    /// The value that key would need for the same decision: "off"; empty if there is no key for the part.
    pub fn value(&self) -> &'static str {
        self.switch().map_or("", |(_, value)| value)
    }

    fn switch(&self) -> Option<(&'static str, &'static str)> {
        match self.chosen {
            Choice::Time(time) => Some(("numerics.time", time.name())),
            Choice::Flow(flow) => Some(("numerics.flow", flow.name())),
            Choice::Wedge(wedge) => Some(("numerics.wedge", wedge.name())),
            Choice::Teeth(teeth, _) => Some(("numerics.teeth", teeth.name())),
            Choice::Width(width) => Some(("numerics.width", width.name())),
            Choice::NoShear | Choice::NoLeaks | Choice::Rotor { .. } => None,
            Choice::MotorGrid { .. } | Choice::PlateGrid { .. } | Choice::Steps(..) => None,
        }
    }
}

/// The plan of a solve: model terms, symmetries, grids and tolerances.
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
    /// Frames of a recording for each step. Frames are uniform in time; clustered steps are not.
    pub frames_per_step: usize,
    /// Whether a field is one polynomial across the width, on the same nodes on all grids; otherwise the scheme has finite volumes, which
    /// keep the pressure positive.
    pub spectral: bool,
    /// Whether a plate is solved turned by a quarter: one much wider than it is long has its polynomial along the length.
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
    /// Bound of the effect of all terms that are left out, relative to α.
    pub left_out: f64,
    /// The part of that bound due to the scene's switches, however large it is.
    pub forced: f64,
    /// The rotor; a plate has none.
    pub rotor: Compliances,
    /// Rotor that decides how many harmonics are kept, if not `rotor`: a similar rotor then keeps the same number.
    pub counted: Option<Compliances>,
    /// Relative error of α that is asked for; 0 on grids that the scene prescribes, which are not refined.
    pub accuracy: f64,
    /// Relative error of α that the fidelity aims at, whether or not the scene prescribes its grids.
    pub target_error: f64,
    /// Most grids, those of `grids` included.
    pub most_grids: usize,
    /// Most unknown nodes of a polynomial across half the width.
    pub most_across: usize,
    /// Fallback to finite volumes: intervals across half the width, and their clustering parameter.
    pub robust: (usize, f64),
    /// Largest relative change that counts as a repeating cycle.
    pub tolerance: f64,
    /// Rounds of the coupling after which the solve gives up.
    pub round_limit: usize,
    /// Record the pressure maps of the cycle, the largest of the fields.
    pub maps: bool,
    /// Safety factor on the error estimated from the grids: 1, and more where contact is sharper than any grid.
    pub irregular: f64,
    /// The decisions, part by part.
    pub decisions: Vec<Decision>,
}

/// Relative effect on α of leaving out the leaks at one pair of edges, as a multiple of their layer over the distance between them. The
/// layer is that of the closed film times the mean opening of the gap. For a plate with a uniform gap the multiple is 1 as the amplitude
/// vanishes, tanh(κ/2)/(κ/2), and less for a larger amplitude (`film::exact`); a rotor that half floats opens the gap a little more.
const LEAK_EFFECT: f64 = 1.2;
/// Fraction of the fidelity's target error that may be left out with each term.
const SHARE: f64 = 0.2;
/// Boundary layer over half the width down to which a polynomial across is used. A thinner layer needs so strong a stretching that the
/// change due to the last node no longer shows the error.
const THINNEST_LAYER: f64 = 0.03;
const ROUND_LIMIT: usize = 300;

/// Most harmonics that are kept if they are to fall below this fraction of the local compliance: 30 over its cube root. The number that a
/// beam needs grows with the inverse fourth root; where the limit here is smaller, the grids differ more, and their differences show the
/// error of the cut-off.
fn most_harmonics(fraction: f64) -> usize {
    ((30.0 / fraction.cbrt()) as usize).min(MOST_HARMONICS)
}

impl Plan {
    /// Rotor harmonics that are kept on a grid.
    pub fn harmonics(&self, grid: &Grid) -> usize {
        let (rotor, fraction) = (self.counted.as_ref().unwrap_or(&self.rotor), grid.harmonic_fraction);
        cutoff(rotor, fraction, most_harmonics(fraction))
    }

    /// This plan for a neighbouring scene with the rotor `rotor`: nothing else differs.
    pub fn near(&self, rotor: &Compliances) -> Self {
        let counted = self.counted.clone().or_else(|| Some(self.rotor.clone()));
        Self { rotor: rotor.clone(), counted, ..self.clone() }
    }

    /// The same plan with finite volumes across.
    pub fn volumes(&self) -> Self {
        let (across, clustering_across) = self.robust;
        let finest = self.grids.last().map(|grid| Grid { across, ..*grid });
        let mut grids = finest.map_or_else(Vec::new, |finest| nested(finest, false));
        // The number of grids stays the same.
        grids.drain(..grids.len().saturating_sub(self.grids.len()));
        Self { spectral: false, most_grids: grids.len(), grids, clustering_across, ..self.clone() }
    }

    /// The next finer grids: the coarsest is left out, and one of half the spacing added.
    pub fn finer(&self) -> Self {
        let grids = self.grids.iter().map(|grid| grid.finer(self.spectral)).collect();
        let robust = (2 * self.robust.0, self.robust.1);
        Self { grids, robust, most_grids: self.most_grids.saturating_sub(1), ..self.clone() }
    }

    /// The same plan with finite volumes and with the sides of the plate as in the scene.
    pub fn not_turned(&self) -> Self {
        if !self.turned {
            return self.clone();
        }
        let grids = self.grids.iter().map(|grid| Grid { along: grid.across, across: grid.along, ..*grid }).collect();
        let (clustering_along, clustering_across) = (self.clustering_across, self.clustering_along);
        Self { grids, clustering_along, clustering_across, turned: false, ..self.clone() }
    }

    /// The same plan with uniform steps, one for each frame.
    pub fn even_steps(&self) -> Self {
        let even = |grid: &Grid| Grid { steps: grid.steps * self.frames_per_step, ..*grid };
        let grids = self.grids.iter().map(even).collect();
        Self { grids, clustering_in_time: 0.0, frames_per_step: 1, trapped: false, ..self.clone() }
    }

    /// The same plan on its finest grid alone: fields without extrapolation, and no error estimate.
    pub fn on_one_grid(&self) -> Self {
        let grids = self.grids.last().copied().into_iter().collect();
        Self { grids, most_grids: 1, accuracy: 0.0, ..self.clone() }
    }
}

fn custom(numerics: &Numerics) -> bool {
    numerics.film_nodes_along.or(numerics.film_nodes_across).or(numerics.steps_per_cycle).is_some()
        || numerics.tolerance.is_some()
}

fn name(fidelity: Fidelity, numerics: &Numerics) -> String {
    if custom(numerics) { "custom".to_owned() } else { fidelity.to_string() }
}
