//! The JSON object of a solve. The names are fixed, as scripts depend on them: add to them, rename nothing.

use crate::analysis::decision::sentences;
use crate::analysis::exact::{Comparison, slow_damping};
pub use crate::analysis::quantity::force_unit;
use crate::analysis::torque::TorqueCurves;
use crate::analysis::validity::{self, Excess};
use crate::digits::{short, significant};
use crate::dimensionless::Dimensionless;
use crate::estimate::Estimate;
use crate::motor::MotorError;
use crate::problem::{Motor, Plate, Problem, Scenario};
use crate::solution::{
    Floating, Model, MotorResult, Outcome, Performance, PlateResult, Solution, Stats, Status, settled,
};
use serde::Serialize;

/// The version of the objects, and of the columns of tables.
pub const SCHEMA: u32 = 1;

/// Why a torque has no error.
const NO_TORQUE_ERROR: &str = "no error of torque, power, speed and efficiency is known (null in the JSON): it is estimated from nested \
                               grids, and this was solved on one mesh; that of α is stated";

/// The object. Numbers that a scene does not have, and numbers that are not finite, are null.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// [`SCHEMA`].
    pub schema: u32,
    /// The scene's name.
    pub preset: String,
    /// `motor` or `plate`.
    pub scene: &'static str,
    /// The cycle repeats to the tolerance.
    pub converged: bool,
    /// `converged`, `not converged`, `not resolved` (the error is as large as the result) or `cancelled`.
    pub status: &'static str,
    /// Relative change of the last round, if it did not converge …
    pub residual: Option<f64>,
    /// … and what it had to fall below.
    pub tolerance: Option<f64>,
    /// Error of the headline (α, a plate's mean load, the mean gap of one that floats) that was asked for, relative to it, and to a hundredth of the load where α is
    /// less than that; `null` on grids that the scene prescribes.
    pub accuracy_asked: Option<f64>,
    /// Its stated error, likewise.
    pub accuracy_stated: Option<f64>,
    /// Why no finer grid was solved: `accuracy`, `budget` or `limit`.
    pub stopped_by: &'static str,
    /// The film's share of the load.
    pub alpha: Option<f64>,
    /// Estimated numerical error of `alpha`, absolute.
    pub alpha_error: Option<f64>,
    /// What forces are in: `N`, or `N/m` for a strip, where they are per metre of width.
    pub force_unit: &'static str,
    /// Cycle mean of the film's net gauge force on one wavelength or the plate.
    pub film_load_n: Option<f64>,
    /// Estimated numerical error of `film_load_n`, absolute.
    pub film_load_error_n: Option<f64>,
    /// Its least value in the cycle.
    pub film_load_min_n: Option<f64>,
    /// Its greatest value in the cycle.
    pub film_load_max_n: Option<f64>,
    /// Estimated numerical errors of the two, absolute.
    pub film_load_min_error_n: Option<f64>,
    /// See `film_load_min_error_n`.
    pub film_load_max_error_n: Option<f64>,
    /// Cycle mean of the contact force on one wavelength.
    pub contact_load_n: Option<f64>,
    /// Torque of the whole ring, the rotor held at rest.
    pub stall_torque_nm: Option<f64>,
    /// Estimated numerical error of `stall_torque_nm`, absolute.
    pub stall_torque_error_nm: Option<f64>,
    /// The paper's maximum operating torque of the whole ring, μ_d (1 − α) waves L r: a bound.
    pub max_torque_nm: Option<f64>,
    /// The same bound without the air film.
    pub dry_torque_nm: Option<f64>,
    /// Cycle mean of the number of teeth that touch.
    pub teeth_in_contact: Option<f64>,
    /// Estimated numerical error of `teeth_in_contact`, absolute.
    pub teeth_in_contact_error: Option<f64>,
    /// No tooth touches at any instant.
    pub levitated: Option<bool>,
    /// Least film thickness, H_m included.
    pub min_gap_nm: Option<f64>,
    /// Estimated numerical error of `min_gap_nm`, absolute (motor, floating plate).
    pub min_gap_error_nm: Option<f64>,
    /// Greatest absolute pressure.
    pub max_pressure_kpa: Option<f64>,
    /// Estimated numerical error of `max_pressure_kpa`, absolute.
    pub max_pressure_error_kpa: Option<f64>,
    /// How a plate floats; null if its mean gap is given.
    pub floating: Option<FloatingObject>,
    /// Film load over ambient pressure × area (plate).
    pub mean_load_ratio: Option<f64>,
    /// Estimated numerical error of `mean_load_ratio`, absolute.
    pub mean_load_ratio_error: Option<f64>,
    /// Its least value in the cycle.
    pub load_ratio_min: Option<f64>,
    /// Its greatest value in the cycle.
    pub load_ratio_max: Option<f64>,
    /// Estimated numerical errors of the two, absolute.
    pub load_ratio_min_error: Option<f64>,
    /// See `load_ratio_min_error`.
    pub load_ratio_max_error: Option<f64>,
    /// σ.
    pub squeeze_number: Option<f64>,
    /// Λ.
    pub bearing_number: Option<f64>,
    /// Kn.
    pub knudsen_number: Option<f64>,
    /// Torque, power and efficiency (motor), if they were asked for.
    #[serde(rename = "merit")]
    pub torque: Option<TorqueCurves>,
    /// What is known exactly beside what was computed (plate).
    pub exact: Option<Comparison>,
    /// Cost.
    pub stats: StatsObject,
    /// What was modelled.
    pub model: ModelObject,
    /// Limits of the model that the scene exceeds; empty within them.
    pub validity: Vec<Excess>,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// Version of this program.
    pub version: &'static str,
    /// The command line, word by word; empty if there was none.
    pub command: Vec<String>,
}

/// How a plate floats under its load. Of a strip, forces and mass are those of a metre of its width.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FloatingObject {
    /// The load.
    pub load_n: f64,
    /// Mean gap at which the film carries it.
    pub mean_gap_um: Option<f64>,
    /// Estimated numerical error of `mean_gap_um`, absolute.
    pub mean_gap_error_um: Option<f64>,
    /// Whether the film carries less at a greater gap.
    pub stable: bool,
    /// By how much the load that the film carries falls with the mean gap: stiffness against slow motion.
    pub stiffness_n_per_m: Option<f64>,
    /// Estimated numerical error of `stiffness_n_per_m`, absolute.
    pub stiffness_error_n_per_m: Option<f64>,
    /// Natural frequency of a mass whose weight is the load on that stiffness; null if it is not stable.
    pub natural_frequency_hz: Option<f64>,
    /// Estimated numerical error of `natural_frequency_hz`, absolute.
    pub natural_frequency_error_hz: Option<f64>,
    /// Damping of slow motion at this gap, by Reynolds: of a film that is not compressed.
    pub damping_n_s_per_m: f64,
    /// That damping over the one at which the mass no longer swings; null if it is not stable.
    pub damping_ratio: Option<f64>,
    /// Mean gap at which trapped gas that does not slip would carry it: (1 + F/(p_a A))² = (1 + 3ε²/2)/(1 − ε²).
    pub trapped_mean_gap_um: f64,
    /// The same for a small load, a √(1.25 p_a A/F).
    pub small_load_mean_gap_um: f64,
}

impl FloatingObject {
    fn new(plate: &Plate, load: f64, floating: &Floating) -> Self {
        let known = |value: f64| Some(value).filter(|value| value.is_finite());
        let stable = floating.stiffness.value > floating.stiffness.error;
        let damping = slow_damping(plate);
        Self {
            load_n: load,
            mean_gap_um: known(floating.mean_gap.value * 1e6),
            mean_gap_error_um: known(floating.mean_gap.error * 1e6),
            stable,
            stiffness_n_per_m: known(floating.stiffness.value),
            stiffness_error_n_per_m: known(floating.stiffness.error),
            natural_frequency_hz: known(floating.natural_frequency.value).filter(|_| stable),
            natural_frequency_error_hz: known(floating.natural_frequency.error).filter(|_| stable),
            damping_n_s_per_m: damping,
            damping_ratio: known(floating.damping_ratio(damping)).filter(|_| stable),
            trapped_mean_gap_um: plate.trapped_gap(load) * 1e6,
            small_load_mean_gap_um: plate.amplitude * (1.25 / PlateResult::ratio(load, plate)).sqrt() * 1e6,
        }
    }
}

/// What the solve cost.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StatsObject {
    /// Wall time of the solve alone \[s\].
    pub wall_s: Option<f64>,
    /// What was counted.
    #[serde(flatten)]
    pub counted: Stats,
}

/// What was modelled.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ModelObject {
    /// `draft`, `standard`, …
    pub fidelity: String,
    /// `auto` or `paper`.
    pub method: String,
    /// Teeth whose film was solved.
    pub teeth_solved: usize,
    /// Half the width was solved and mirrored.
    pub half_width: bool,
    /// The wedge term was solved.
    pub shear: bool,
    /// A sentence for each decision.
    pub why: Vec<String>,
}

/// Collects numbers, and the names of those that are not finite.
#[derive(Default)]
struct Numbers {
    unknown: Vec<&'static str>,
}

impl Numbers {
    fn take(&mut self, name: &'static str, value: f64) -> Option<f64> {
        if value.is_finite() {
            return Some(value);
        }
        self.unknown.push(name);
        None
    }
}

impl Summary {
    /// Adds torque over speed, or the warning that it is not known.
    pub fn add_torque(&mut self, found: Result<Option<TorqueCurves>, MotorError>) {
        match found {
            Ok(curves) => self.torque = curves,
            Err(error) => self.warnings.push(format!("torque over speed is not known: without film, {error}")),
        }
    }

    /// The object of a solution. `wall_s`: how long the solve took, by the caller's clock. `command`: the words of the
    /// command line, kept as they are.
    pub fn new(problem: &Problem, solution: &Solution, wall_s: f64, command: &[String]) -> Self {
        let mut numbers = Numbers::default();
        let problem = &*settled(problem, &solution.outcome);
        let groups = Dimensionless::of(problem);
        let mut summary = Self {
            schema: SCHEMA,
            preset: problem.name.clone(),
            converged: solution.status == Status::Converged,
            status: status_name(&solution.status),
            force_unit: force_unit(problem),
            squeeze_number: numbers.take("squeeze_number", groups.squeeze_number),
            bearing_number: numbers.take("bearing_number", groups.bearing_number),
            knudsen_number: numbers.take("knudsen_number", groups.knudsen_number),
            accuracy_asked: (solution.accuracy.asked > 0.0).then_some(solution.accuracy.asked),
            accuracy_stated: numbers.take("accuracy_stated", solution.accuracy.stated),
            stopped_by: solution.accuracy.stopped_by.name(),
            stats: StatsObject { wall_s: numbers.take("stats.wall_s", wall_s), counted: solution.stats },
            model: ModelObject::new(&solution.model),
            validity: validity::outside(problem, Some(solution)),
            version: env!("CARGO_PKG_VERSION"),
            command: command.to_vec(),
            ..Self::default()
        };
        if let Status::NotConverged { residual, tolerance } = solution.status {
            summary.residual = numbers.take("residual", residual);
            summary.tolerance = numbers.take("tolerance", tolerance);
        }
        match (&problem.scenario, &solution.outcome) {
            (Scenario::Plate(plate), Outcome::Plate(result)) => {
                summary.fill_plate(plate, result, &mut numbers);
                let film_load = Estimate { value: result.film_load, error: result.film_load_error };
                summary.exact = Some(Comparison::of(plate, film_load, &solution.recording));
            }
            (Scenario::Motor(motor), Outcome::Motor(result)) => {
                summary.fill_motor(motor, result, &mut numbers);
                if let Some(Performance { stall_torque, .. }) = &solution.performance {
                    summary.stall_torque_nm = numbers.take("stall_torque_nm", stall_torque.value);
                    // Of a recording on one mesh there is no estimate.
                    summary.stall_torque_error_nm = stall_torque.error.is_finite().then_some(stall_torque.error);
                }
            }
            // A solver answers in kind; an answer of the other kind would have no numbers for this scene.
            (Scenario::Plate(_), Outcome::Motor(_)) => summary.scene = "plate",
            (Scenario::Motor(_), Outcome::Plate(_)) => summary.scene = "motor",
        }
        summary.warnings = solution.warnings.clone();
        if summary.stall_torque_nm.is_some() && summary.stall_torque_error_nm.is_none() {
            summary.warnings.push(NO_TORQUE_ERROR.to_owned());
        }
        if !numbers.unknown.is_empty() {
            summary.warnings.push(format!("not known, hence null: {}", numbers.unknown.join(", ")));
        }
        summary
    }

    fn fill_motor(&mut self, motor: &Motor, result: &MotorResult, numbers: &mut Numbers) {
        self.scene = "motor";
        self.alpha = numbers.take("alpha", result.alpha);
        self.alpha_error = numbers.take("alpha_error", result.alpha_error);
        self.film_load_n = numbers.take("film_load_n", result.film_load);
        self.film_load_error_n = numbers.take("film_load_error_n", result.alpha_error * motor.load);
        self.film_load_min_n = numbers.take("film_load_min_n", result.film_load_min);
        self.film_load_max_n = numbers.take("film_load_max_n", result.film_load_max);
        self.fill_range(result.film_load_range_error, result.max_pressure_error, numbers);
        self.teeth_in_contact_error = numbers.take("teeth_in_contact_error", result.teeth_in_contact_error);
        self.min_gap_error_nm = numbers.take("min_gap_error_nm", result.min_gap_error * 1e9);
        self.contact_load_n = numbers.take("contact_load_n", result.contact_load);
        self.max_torque_nm = numbers.take("max_torque_nm", result.max_torque);
        self.dry_torque_nm = numbers.take("dry_torque_nm", motor.friction_torque(motor.load));
        self.teeth_in_contact = numbers.take("teeth_in_contact", result.teeth_in_contact);
        self.levitated = Some(result.levitated);
        self.min_gap_nm = numbers.take("min_gap_nm", result.min_gap * 1e9);
        self.max_pressure_kpa = numbers.take("max_pressure_kpa", result.max_pressure * 1e-3);
    }

    fn fill_plate(&mut self, plate: &Plate, result: &PlateResult, numbers: &mut Numbers) {
        self.scene = "plate";
        self.film_load_n = numbers.take("film_load_n", result.film_load);
        self.film_load_error_n = numbers.take("film_load_error_n", result.film_load_error);
        self.film_load_min_n = numbers.take("film_load_min_n", result.film_load_min);
        self.film_load_max_n = numbers.take("film_load_max_n", result.film_load_max);
        self.min_gap_nm = numbers.take("min_gap_nm", result.min_gap * 1e9);
        self.max_pressure_kpa = numbers.take("max_pressure_kpa", result.max_pressure * 1e-3);
        self.fill_range(result.film_load_range_error, result.max_pressure_error, numbers);
        if let Some((load, floating)) = plate.load.zip(result.floating) {
            self.min_gap_error_nm = numbers.take("min_gap_error_nm", floating.mean_gap.error * 1e9);
            self.floating = Some(FloatingObject::new(plate, load, &floating));
        }
        let mut ratio = |name, load| numbers.take(name, PlateResult::ratio(load, plate));
        self.mean_load_ratio = ratio("mean_load_ratio", result.film_load);
        self.mean_load_ratio_error = ratio("mean_load_ratio_error", result.film_load_error);
        self.load_ratio_min = ratio("load_ratio_min", result.film_load_min);
        self.load_ratio_max = ratio("load_ratio_max", result.film_load_max);
        self.load_ratio_min_error = ratio("load_ratio_min_error", result.film_load_range_error[0]);
        self.load_ratio_max_error = ratio("load_ratio_max_error", result.film_load_range_error[1]);
    }

    fn fill_range(&mut self, [least, most]: [f64; 2], pressure: f64, numbers: &mut Numbers) {
        self.film_load_min_error_n = numbers.take("film_load_min_error_n", least);
        self.film_load_max_error_n = numbers.take("film_load_max_error_n", most);
        self.max_pressure_error_kpa = numbers.take("max_pressure_error_kpa", pressure * 1e-3);
    }

    /// As text, indented, with a line break at the end.
    pub fn to_text(&self) -> String {
        text(self)
    }
}

/// An object of `--json` as text, between what all of them have: the version of the format first, the program's version and the
/// command line (word by word; empty if there was none) last.
pub fn document(object: &impl Serialize, command: &[String]) -> String {
    #[derive(Serialize)]
    struct Document<'a, T> {
        schema: u32,
        #[serde(flatten)]
        object: &'a T,
        version: &'static str,
        command: &'a [String],
    }
    text(&Document { schema: SCHEMA, object, version: env!("CARGO_PKG_VERSION"), command })
}

/// Any object as indented JSON text with a line break at the end. Numbers that are not finite become null.
pub fn text(object: &impl Serialize) -> String {
    // Fails only for maps whose keys are not text, and for types that refuse: ours are plain structs.
    serde_json::to_string_pretty(object).map_or_else(|_| String::new(), |text| text + "\n")
}

/// `348, limit 0.1`
pub fn beside_limit(excess: &Excess) -> String {
    let unit = if excess.unit.is_empty() { String::new() } else { format!(" {}", excess.unit) };
    format!("{}{unit}, limit {}{unit}", significant(excess.value, 3), short(excess.limit, 3))
}

/// How a solve ended, in a word.
pub fn status_name(status: &Status) -> &'static str {
    match status {
        Status::Converged => "converged",
        Status::NotConverged { .. } => "not converged",
        Status::NotResolved { .. } => "not resolved",
        Status::Cancelled => "cancelled",
    }
}

impl ModelObject {
    fn new(model: &Model) -> Self {
        Self {
            fidelity: model.fidelity.clone(),
            method: model.method.clone(),
            teeth_solved: model.teeth_solved,
            half_width: model.half_width,
            shear: model.shear,
            why: sentences(model),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Cancel;
    use crate::fidelity::Fidelity;
    use crate::scene::presets;
    use crate::solve::{Settings, solve};

    fn solved(preset: &str) -> (Problem, Solution) {
        let problem = Problem::try_from(&presets::find(preset).unwrap()).unwrap();
        let settings = Settings { fidelity: Fidelity::Draft, ..Settings::default() };
        let solution = solve(&problem, &settings, &mut (), &Cancel::new()).unwrap();
        (problem, solution)
    }

    #[test]
    fn numbers_that_are_not_finite_are_null_and_said_to_be() {
        let (problem, mut solution) = solved("plate-viscous");
        let Outcome::Plate(result) = &mut solution.outcome else { panic!("a plate") };
        result.film_load_error = f64::INFINITY;
        let summary = Summary::new(&problem, &solution, f64::NAN, &[]);
        assert_eq!((summary.film_load_error_n, summary.stats.wall_s), (None, None));
        let warning = summary.warnings.last().unwrap();
        for name in ["stats.wall_s", "film_load_error_n", "mean_load_ratio_error"] {
            assert!(warning.contains(name), "{warning}");
        }
        let value: serde_json::Value = serde_json::from_str(&summary.to_text()).unwrap();
        assert!(value["film_load_error_n"].is_null() && value["film_load_n"].is_f64());
    }
}
