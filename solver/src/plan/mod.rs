//! The plan of a solve: which terms, teeth, symmetries and grids the scene needs, and why (shown to the user).

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

/// The decision about one part of the model; `analysis::decision` of the crate `squeezefilm` puts it, and the reason, into words.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// The part, and how it is solved.
    pub chosen: Choice,
    /// Whether the scene overruled what the plan would have done.
    pub overruled: bool,
    /// Bound of what it changes, relative to α; 0 is exact.
    pub effect: f64,
    /// Reasons for and against leaving the part out; `None` if nothing had to be weighed.
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
    /// The finest grid of a plate; across half the width `None` of a strip and of a round plate.
    PlateGrid {
        /// Intervals along half the length, or half a section of a round plate.
        along: usize,
        /// Intervals across half the width.
        across: Option<usize>,
        /// Whether it is a disc or a ring.
        round: bool,
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

/// Reasons for and against leaving out a part of the model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Weighed {
    /// How the part is solved if it is left out.
    pub reduced: Choice,
    /// The number that decides: Λ/σ for the wedge term; otherwise the boundary layer over the distance between the two edges
    /// whose leakage is neglected (for the film in time, the shorter of tooth and contact width).
    pub number: f64,
    /// Whether the scene says so.
    pub asked: bool,
    /// Bound of what leaving it out changes, relative to α.
    pub effect: f64,
    /// Bound of what solving it costs, because the grid is too coarse for it, relative to α.
    pub unresolved: f64,
    /// The error of α that is asked for, relative.
    pub target_error: f64,
}

impl Decision {
    /// A decision that changes nothing, and that no key overrules.
    fn exact(chosen: Choice) -> Self {
        Self { chosen, overruled: false, effect: 0.0, weighed: None }
    }

    /// Its effect, if the scene says to leave the part out.
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
    /// The part of it that the scene's switches leave out, whether or not it is small.
    pub forced: f64,
    /// The rotor; a plate has none.
    pub rotor: Compliances,
    /// Rotor that decides how many harmonics are kept, if not `rotor`: a similar rotor then keeps the same number.
    pub counted: Option<Compliances>,
    /// Error of α asked for, relative; 0 on grids that were asked for, which are not refined.
    pub accuracy: f64,
    /// The error of α that the fidelity aims at, relative, whether or not the grids were asked for.
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

/// Effect on α, relative, of leaving out the leaks at one pair of edges, as a multiple of their layer over the length
/// between them, the layer being that of the closed film times how far the gap opens in the mean. Of a plate whose gap
/// is uniform it is 1 as the amplitude vanishes, tanh(κ/2)/(κ/2), and less for a larger one (`film::exact`); a rotor that
/// is half afloat opens the gap a little more.
const LEAK_EFFECT: f64 = 1.2;
/// Share of the fidelity's aim that may be left out with each term.
const SHARE: f64 = 0.2;
/// Boundary layer over half the width down to which a polynomial across is used: a thinner one asks for so strong a stretching that
/// the nodes in between no longer tell what the last one changes.
const THINNEST_LAYER: f64 = 0.03;
const ROUND_LIMIT: usize = 300;

/// Harmonics kept at most, down to this fraction of the local compliance: 30 over its third root. The beam's own number grows with the
/// fourth root, so that where this is less, grids differ more, and their differences show what is cut.
fn most_harmonics(fraction: f64) -> usize {
    ((30.0 / fraction.cbrt()) as usize).min(MOST_HARMONICS)
}

impl Plan {
    /// Rotor harmonics that are kept on a grid.
    pub fn harmonics(&self, grid: &Grid) -> usize {
        let (rotor, fraction) = (self.counted.as_ref().unwrap_or(&self.rotor), grid.harmonic_fraction);
        cutoff(rotor, fraction, most_harmonics(fraction))
    }

    /// This plan for a scene near its own, whose rotor is `rotor`: nothing else differs.
    pub fn near(&self, rotor: &Compliances) -> Self {
        let counted = self.counted.clone().or_else(|| Some(self.rotor.clone()));
        Self { rotor: rotor.clone(), counted, ..self.clone() }
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

    /// The next finer grids: the coarsest is left out, and one of half the spacing added.
    pub fn finer(&self) -> Self {
        let grids = self.grids.iter().map(|grid| grid.finer(self.spectral)).collect();
        let robust = (2 * self.robust.0, self.robust.1);
        Self { grids, robust, most_grids: self.most_grids.saturating_sub(1), ..self.clone() }
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
}

fn custom(numerics: &Numerics) -> bool {
    numerics.film_nodes_along.or(numerics.film_nodes_across).or(numerics.steps_per_cycle).is_some()
        || numerics.tolerance.is_some()
}

fn name(fidelity: Fidelity, numerics: &Numerics) -> String {
    if custom(numerics) { "custom".to_owned() } else { fidelity.to_string() }
}
