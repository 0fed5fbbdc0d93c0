//! The result of a solve: plain data, in SI units, that the command line, the window and the exports read.

use crate::estimate::Estimate;
use crate::film::stepper::Cost;
use crate::plan::Decision;
use crate::problem::{Plate, Problem, Scenario};
use crate::recording::Recording;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::f64::consts::TAU;
use std::ops::{AddAssign, Mul};

/// How a solve ended. None of these is an error: what was reached is always reported.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Status {
    /// The cycle repeats to the tolerance.
    Converged,
    /// The iteration limit was reached first.
    NotConverged {
        /// The change of the last iteration, relative.
        residual: f64,
        /// Relative change below which the iteration would have ended.
        tolerance: f64,
    },
    /// The cycle repeats, but the stated error of the headline is as large as the headline: these grids do not resolve it.
    NotResolved {
        /// Stated error over the headline, at least 1.
        error: f64,
    },
    /// The caller cancelled.
    Cancelled,
}

/// Why a solve stopped refining its grids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum StoppedBy {
    /// The stated error is what was asked for.
    Accuracy,
    /// The time allowed was up.
    Budget,
    /// No finer grid is tried, or none would help.
    #[default]
    Limit,
}

impl StoppedBy {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Accuracy, Self::Budget, Self::Limit];

    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accuracy => "accuracy",
            Self::Budget => "budget",
            Self::Limit => "limit",
        }
    }
}

/// The accuracy of the headline, relative to it; that of α to a hundredth of the load where the film carries less than that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// The relative error asked for; 0 on grids that the scene prescribes.
    pub asked: f64,
    /// The stated relative error.
    pub stated: f64,
    /// Why no finer grid was solved.
    pub stopped_by: StoppedBy,
}

/// Results of a motor scene: cycle means for one wavelength, each with its estimated numerical error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MotorResult {
    /// α: the film's share of the load.
    pub alpha: Estimate,
    /// Cycle mean of the film's net gauge force \[N\].
    pub film_load: Estimate,
    /// Least film force in the cycle \[N\].
    pub film_load_min: Estimate,
    /// Greatest film force in the cycle \[N\].
    pub film_load_max: Estimate,
    /// Cycle mean of the contact force \[N\].
    pub contact_load: Estimate,
    /// The paper's maximum operating torque of the whole ring, μ_d (1−α) waves L r \[N m\]: a bound, see
    /// [`Performance::stall_torque`].
    pub max_torque: Estimate,
    /// Cycle mean of the number of teeth that touch the rotor.
    pub teeth_in_contact: Estimate,
    /// No tooth touches at any instant: the rotor floats.
    pub levitated: bool,
    /// Least film thickness \[m\], H_m included.
    pub min_film_thickness: Estimate,
    /// Greatest absolute pressure \[Pa\].
    pub max_pressure: Estimate,
    /// Greatest contact line load at any node and instant \[N/m\].
    pub max_contact: f64,
}

/// The motor at one speed of its rotor; the whole ring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OperatingPoint {
    /// Surface speed of the rotor \[m/s\].
    pub speed: f64,
    /// Torque on the rotor \[N m\].
    pub torque: Estimate,
    /// Power given to the rotor \[W\].
    pub output: Estimate,
    /// Heat of friction \[W\].
    pub friction: Estimate,
    /// Output over what the stator gives to friction, rotor and film; `None` where the rotor is not driven.
    pub efficiency: Option<Estimate>,
}

/// Torque, power and efficiency with the film, or without it; the whole ring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Performance {
    /// Torque at rest \[N m\].
    pub stall_torque: Estimate,
    /// The paper's maximum operating torque μ_d N waves r \[N m\]: the bound at which all of the contact pulls one way.
    pub max_torque: Estimate,
    /// Speed at which the torque vanishes \[m/s\]; `None` without contact.
    pub no_load_speed: Option<Estimate>,
    /// Greatest output \[W\].
    pub max_power: Estimate,
    /// Speed of the greatest output \[m/s\]; `None` without contact.
    pub max_power_speed: Option<Estimate>,
    /// Greatest efficiency; `None` without contact.
    pub max_efficiency: Option<Estimate>,
    /// Speed of the greatest efficiency \[m/s\].
    pub max_efficiency_speed: Option<Estimate>,
    /// At the rotor speed of the scene.
    pub present: OperatingPoint,
    /// From rest to the stator's greatest speed, ascending; empty where only the numbers were asked for.
    pub curve: Vec<OperatingPoint>,
}

/// How a plate floats under its load.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Floating {
    /// Mean gap at which the film carries the load \[m\].
    pub mean_gap: Estimate,
    /// By how much the load that the film carries falls with the mean gap, −dF/dh \[N/m, of a strip per metre of width\]: the stiffness
    /// against slow motion. Positive: stable.
    pub stiffness: Estimate,
    /// Natural frequency of a mass whose weight is the load, on that stiffness \[Hz\]; 0 if it is not stable.
    pub natural_frequency: Estimate,
    /// How that mass moves when it is pushed; `None` if it is not stable, or so light that it shakes with the vibration.
    pub slow: Option<SlowMotion>,
}

/// Motion of a mass that floats on a film and is displaced: it creeps back, oscillates, or both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SlowMotion {
    /// Damping of a motion so slow that gas has time to leave \[N s/m, of a strip per metre of width\].
    pub damping: Estimate,
    /// Damping ratio: this damping over the critical damping 2 √(k m) with the stiffness k against slow motion.
    pub damping_ratio: Estimate,
    /// Time constant of creep back to equilibrium \[s\]; `None` if creep is negligible.
    pub creep_time: Option<Estimate>,
    /// Frequency of the oscillation \[Hz\]; `None` if the mass does not oscillate.
    pub swing_frequency: Option<Estimate>,
    /// Time constant of the oscillation's decay \[s\]; `None` if the mass does not oscillate.
    pub swing_decay: Option<Estimate>,
}

impl Floating {
    /// Whether the film carries less at a greater gap; `None` if the error of the stiffness leaves that open.
    pub fn stability(&self) -> Option<bool> {
        let Estimate { value, error } = self.stiffness;
        (value.abs() > error).then_some(value > 0.0)
    }

    /// Whether the film is known to carry less at a greater gap.
    pub fn is_stable(&self) -> bool {
        self.stability() == Some(true)
    }
}

/// Results of a plate scene. Forces of a strip are per metre of width.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlateResult {
    /// Cycle mean of the net gauge force \[N or N/m\].
    pub film_load: Estimate,
    /// Least gauge force in the cycle \[N; of a strip N/m\].
    pub film_load_min: Estimate,
    /// Greatest gauge force in the cycle \[N; of a strip N/m\].
    pub film_load_max: Estimate,
    /// Least film thickness \[m\]; of a plate that floats it is as accurate as its mean gap, of others exact.
    pub min_film_thickness: Estimate,
    /// Greatest absolute pressure \[Pa\].
    pub max_pressure: Estimate,
    /// Error of the load's first harmonic that refinement along and in time does not show \[N; of a strip N/m\], in phase with the approach and
    /// with its speed: it is due to the nodes across, and to the gap of a plate that floats.
    pub harmonic_error: [f64; 2],
    /// How it floats; `None` if its mean gap is given.
    pub floating: Option<Floating>,
}

/// The result of either scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// Result of a motor.
    Motor(MotorResult),
    /// Result of a plate.
    Plate(PlateResult),
}

impl Outcome {
    /// The result of a motor; `None` of a plate.
    pub fn motor(&self) -> Option<&MotorResult> {
        if let Self::Motor(result) = self { Some(result) } else { None }
    }

    /// The result of a plate; `None` of a motor.
    pub fn plate(&self) -> Option<&PlateResult> {
        if let Self::Plate(result) = self { Some(result) } else { None }
    }
}

/// The problem as it was solved: a plate under a load is at the mean gap that was found for it.
pub fn settled<'a>(problem: &'a Problem, outcome: &Outcome) -> Cow<'a, Problem> {
    match (&problem.scenario, outcome) {
        (Scenario::Plate(plate), Outcome::Plate(PlateResult { floating: Some(floating), .. })) => {
            let plate = Plate { mean_gap: floating.mean_gap.value, ..plate.clone() };
            Cow::Owned(Problem { scenario: Scenario::Plate(plate), ..problem.clone() })
        }
        _ => Cow::Borrowed(problem),
    }
}

/// Cost of a solve as counts of steps, iterations and nodes; no time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stats {
    /// Time steps of one tooth's film.
    pub film_steps: u64,
    /// Linear solves of those steps (Newton iterations, or factored sweeps).
    pub film_solves: u64,
    /// Steps in which positivity needed a locally first-order step.
    pub limited_steps: u64,
    /// Cycles of the vibration marched.
    pub cycles: u64,
    /// Rounds of the film–contact coupling.
    pub coupling_iterations: u64,
    /// Contact problems solved.
    pub contact_solves: u64,
    /// Newton iterations (or active-set changes) in them.
    pub contact_iterations: u64,
    /// Steps of a start-up in which film and contact did not agree to the tolerance within their rounds.
    pub unsettled_steps: u64,
    /// Film nodes of one tooth as stored.
    pub film_nodes: usize,
    /// Contact nodes in one wavelength.
    pub contact_nodes: usize,
    /// Time steps in a cycle.
    pub steps_per_cycle: usize,
    /// Whether the solve started from the fields of an earlier problem. The cost, but not the result beyond its error, then depends on that.
    pub warm_start: bool,
}

impl Stats {
    /// Adds what another solve cost; sizes of grids stay.
    pub fn add_cost(&mut self, other: &Self) {
        self.film_steps += other.film_steps;
        self.film_solves += other.film_solves;
        self.unsettled_steps += other.unsettled_steps;
        self.limited_steps += other.limited_steps;
        self.cycles += other.cycles;
        self.coupling_iterations += other.coupling_iterations;
        self.contact_solves += other.contact_solves;
        self.contact_iterations += other.contact_iterations;
    }
}

impl AddAssign<Cost> for Stats {
    fn add_assign(&mut self, film: Cost) {
        self.film_steps += film.steps;
        self.film_solves += film.solves;
        self.limited_steps += film.limited;
    }
}

/// The model that was solved, in words for the user.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Model {
    /// `draft`, `standard`, … or `paper mesh`.
    pub fidelity: String,
    /// `auto` or `paper`.
    pub method: String,
    /// Teeth whose film was solved.
    pub teeth_solved: usize,
    /// Whether the mirror symmetry across the width was used.
    pub half_width: bool,
    /// Whether the wedge term was solved.
    pub shear: bool,
    /// Remarks of the paper's method on its own result, in sentences.
    pub remarks: Vec<String>,
    /// The decisions of our own method; `analysis::decision` of the crate `squeezefilm` says them in words.
    pub decisions: Vec<Decision>,
}

/// Spring and damping: parts of the load amplitude over p_a · area · ε, both positive if they resist. Or the same over the
/// amplitude and over the greatest speed: stiffness \[N/m\] and damping \[N s/m\], of a strip per metre of width.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Harmonic<T> {
    /// In phase with the approach: 1 for gas that cannot leave.
    pub spring: T,
    /// In phase with the speed of the approach.
    pub damping: T,
}

impl<T: Mul<f64, Output = T>> Harmonic<T> {
    /// Each in its [unit](Harmonic::unit).
    pub fn times(self, unit: Harmonic<f64>) -> Self {
        Self { spring: self.spring * unit.spring, damping: self.damping * unit.damping }
    }
}

impl Harmonic<f64> {
    /// Units of the spring and damping numbers \[N/m, N s/m; of a strip per metre of width\]: p_a A/h₀, and that over ω.
    pub fn unit(plate: &Plate) -> Self {
        let spring = plate.gas.ambient_pressure * plate.area() / plate.mean_gap;
        Self { spring, damping: spring / (TAU * plate.frequency) }
    }
}

/// Everything a solve returns.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Solution {
    /// How it ended.
    pub status: Status,
    /// The numbers.
    pub outcome: Outcome,
    /// Torque, power and efficiency of a motor with its film, without the curve; `None` of a plate, and where no cycle was
    /// reached.
    pub performance: Option<Performance>,
    /// First harmonic of a plate's load, over p_a · area · ε; `None` for a motor, and where nothing vibrates.
    pub harmonic: Option<Harmonic<Estimate>>,
    /// Cost of the solve.
    pub stats: Stats,
    /// The model that was solved.
    pub model: Model,
    /// How exact the headline is.
    pub accuracy: Accuracy,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// Fields of one cycle.
    pub recording: Recording,
}
