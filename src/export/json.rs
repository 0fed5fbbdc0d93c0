//! The JSON object of a solve. Scripts depend on the names: new ones may be added, but none may be renamed.

use super::estimates::{self, finite};
use super::figure::extent;
use super::torque::merit;
use crate::analysis::decision::sentences;
use crate::analysis::exact::ExactComparison;
use crate::analysis::quantity::{Numbers, Quantity, force_unit};
use crate::analysis::torque::TorqueCurves;
use crate::analysis::validity::{self, ExceededLimit};
use crate::digits::{short, significant};
use crate::motor::MotorError;
use crate::problem::{Plate, Problem, Scenario};
use crate::scene::is_unseen;
use crate::solution::{Accuracy, Floating, Model, Outcome, PlateResult, Solution, Stats, Status, StoppedBy, settled};
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Value, json};

/// The version of the objects, and of the columns of tables.
pub const SCHEMA: u32 = 1;

const NO_TORQUE_ERROR: &str = "the errors of torque, power, speed and efficiency are unknown (null in the JSON): they are estimated from nested \
                               grids, and this was solved on one mesh; that of α is stated";

/// The object. Numbers that a scene does not have, and numbers that are not finite, are null.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// The problem; a plate that floats is at the gap that was found. The object has the scene's name and kind.
    pub problem: Problem,
    /// The result.
    pub outcome: Outcome,
    /// How it ended; in the object in the form of [`status_name`].
    pub status: Status,
    /// The requested and the stated error of the headline (α, a plate's mean load, or the mean gap of a plate that floats), relative to it,
    /// or to a hundredth of the load if α is less than that. The requested error is null for grids that the scene prescribes.
    pub accuracy: Accuracy,
    /// The numbers. The object has those that are results of the solve, and also `residual` and `tolerance`.
    pub numbers: Numbers,
    /// Torque, power and efficiency (motor), if they were requested.
    pub torque: Option<TorqueCurves>,
    /// Exact limits beside the computed values (plate).
    pub exact: Option<ExactComparison>,
    /// Wall time of the solve alone \[s\].
    pub wall_s: f64,
    /// Cost of the solve except time, as counts.
    pub stats: Stats,
    /// The model that was solved; in the object with a sentence for each decision.
    pub model: Model,
    /// Limits of the model that the scene exceeds; empty if it exceeds none.
    pub validity: Vec<ExceededLimit>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// The command line, word by word; empty if there was none.
    pub command: Vec<String>,
}

/// The numbers of the object that are results of a solve, in its order.
const RESULTS: [&[Quantity]; 7] = {
    use Quantity::*;
    [
        &[Alpha, AlphaError],
        &[FilmLoad, FilmLoadError, FilmLoadMin, FilmLoadMax, FilmLoadMinError, FilmLoadMaxError, ContactLoad],
        &[StallTorque, StallTorqueError, MaxTorque, MaxTorqueError],
        &[TeethInContact, TeethInContactError],
        &[MinGap, MinGapError, MaxPressure, MaxPressureError],
        &[LoadRatio, LoadRatioError, LoadRatioMin, LoadRatioMax, LoadRatioMinError, LoadRatioMaxError],
        &[SqueezeNumber, BearingNumber, KnudsenNumber],
    ]
};

impl Serialize for Summary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // The bound of the torque of the whole ring without the air film; whether no tooth touches at any instant; and how a plate floats,
        // which is null if its mean gap is prescribed.
        let (dry, levitated, floating) = match (&self.problem.scenario, &self.outcome) {
            (Scenario::Motor(motor), Outcome::Motor(result)) => {
                (finite(motor.friction_torque(motor.load)), Some(result.levitated), None)
            }
            (Scenario::Plate(plate), Outcome::Plate(result)) => {
                let floats = plate.load.zip(result.floating);
                (None, None, floats.map(|(load, found)| floating_object(plate, load, &found)))
            }
            // A solver returns the kind of result that belongs to the scene.
            _ => (None, None, None),
        };
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("schema", &SCHEMA)?;
        map.serialize_entry("preset", &self.problem.name)?;
        map.serialize_entry("scene", kind(&self.problem))?;
        map.serialize_entry("converged", &(self.status == Status::Converged))?;
        map.serialize_entry("status", status_name(&self.status))?;
        map.serialize_entry("residual", &self.numbers.get(Quantity::Residual))?;
        map.serialize_entry("tolerance", &self.numbers.get(Quantity::Tolerance))?;
        for (name, value) in accuracy_entries(Some(self.accuracy)) {
            map.serialize_entry(name, &value)?;
        }
        for quantity in RESULTS.concat() {
            // Between the numbers are entries that are not numbers, or not numbers of every solve.
            match quantity {
                Quantity::FilmLoad => map.serialize_entry("force_unit", force_unit(&self.problem))?,
                // If the film load is too large, the contact load is too small by as much.
                Quantity::StallTorque => {
                    let error = self.numbers.estimate(Quantity::ContactLoad).and_then(|load| finite(load.error));
                    map.serialize_entry("contact_load_error_n", &error)?;
                }
                Quantity::TeethInContact => map.serialize_entry("dry_torque_nm", &dry)?,
                Quantity::MinGap => map.serialize_entry("levitated", &levitated)?,
                Quantity::LoadRatio => map.serialize_entry("floating", &floating)?,
                _ => {}
            }
            map.serialize_entry(quantity.name(), &self.numbers.get(quantity))?;
        }
        map.serialize_entry("merit", &self.torque.as_ref().map(merit))?;
        map.serialize_entry("exact", &self.exact.as_ref().map(exact_object))?;
        map.serialize_entry("stats", &StatsObject { wall_s: self.wall_s, counted: self.stats })?;
        map.serialize_entry("model", &model_object(&self.model))?;
        map.serialize_entry("validity", &self.validity)?;
        map.serialize_entry("warnings", &self.warnings)?;
        map.serialize_entry("version", env!("CARGO_PKG_VERSION"))?;
        map.serialize_entry("command", &self.command)?;
        map.end()
    }
}

/// The accuracy of a solve, by the names of `solve --json`; null where there is none.
pub(super) fn accuracy_entries(accuracy: Option<Accuracy>) -> [(&'static str, Value); 3] {
    let asked = accuracy.map(|accuracy| accuracy.asked).filter(|asked| *asked > 0.0);
    [
        ("accuracy_asked", asked.into()),
        ("accuracy_stated", accuracy.map(|accuracy| accuracy.stated).into()),
        ("stopped_by", accuracy.map(|accuracy| accuracy.stopped_by.name()).into()),
    ]
}

/// The kind of scene, as in its file.
pub(super) fn kind(problem: &Problem) -> &'static str {
    if matches!(problem.scenario, Scenario::Motor(_)) { "motor" } else { "plate" }
}

/// Mean gap \[m\] at which trapped gas that does not slip would carry a small load: a √(1.25 p_a A/F).
pub fn small_load_gap(plate: &Plate, load: f64) -> f64 {
    plate.amplitude * (1.25 / PlateResult::ratio(load, plate)).sqrt()
}

/// How a plate floats under its load: the mean gap at which the film carries it, the stiffness against slow motion, and the natural
/// frequency of a mass whose weight is the load; also the mean gap at which trapped gas without slip would carry the load, and would carry
/// a small load. For a strip, forces and mass are per metre of width. `stable` is null if the error of the stiffness leaves it open.
/// Natural frequency and slow motion are null unless it is true, and so is a time or frequency of a motion that the plate does not perform.
fn floating_object(plate: &Plate, load: f64, found: &Floating) -> Value {
    let mut object = json!({ "load_n": load });
    estimates::add(&mut object, "mean_gap", "_um", Some(found.mean_gap * 1e6));
    // Whether the film carries less at a greater gap.
    object["stable"] = found.stability().into();
    let slow = found.slow;
    for (name, unit, found) in [
        ("stiffness", "_n_per_m", Some(found.stiffness)),
        ("natural_frequency", "_hz", found.is_stable().then_some(found.natural_frequency)),
        ("damping", "_n_s_per_m", slow.map(|slow| slow.damping)),
        ("damping_ratio", "", slow.map(|slow| slow.damping_ratio)),
        ("creep_time", "_ms", slow.and_then(|slow| slow.creep_time).map(|time| time * 1e3)),
        ("swing_frequency", "_hz", slow.and_then(|slow| slow.swing_frequency)),
        ("swing_decay", "_ms", slow.and_then(|slow| slow.swing_decay).map(|time| time * 1e3)),
    ] {
        estimates::add(&mut object, name, unit, found);
    }
    object["trapped_mean_gap_um"] = (plate.trapped_gap(load) * 1e6).into();
    object["small_load_mean_gap_um"] = (small_load_gap(plate, load) * 1e6).into();
    object
}

/// A plate beside what is known exactly: σ/Q, Q the factor by which slip raises the flow at the mean gap; spring and damping over p_a · area · ε, and the same as
/// stiffness \[N/m, of a strip per metre of width\] and damping \[N s/m\]; `linear_…` is exact for ε → 0 (Langlois 1962 of a strip, Blech 1983
/// of a rectangle), `trapped_…` for σ → ∞ (Langlois 1962, Salbu 1964; with slip); loads in the object's force unit, of gas that cannot
/// leave (Boyle), and of gas that is not compressed, whose least is its greatest, negative. What is not known is null.
fn exact_object(found: &ExactComparison) -> Value {
    let boyle = extent(found.boyle.iter().copied());
    let (linear, unit, absolute) = (found.linear, found.unit, found.stiffness_and_damping());
    let mut object = json!({ "effective_squeeze_number": found.effective_squeeze_number });
    for (name, of_unit, solved, exact) in [
        ("spring", "", found.solved.map(|solved| solved.spring), linear.spring),
        ("damping", "", found.solved.map(|solved| solved.damping), linear.damping),
        ("stiffness", "_n_per_m", absolute.map(|solved| solved.spring), linear.spring * unit.spring),
        ("damping", "_n_s_per_m", absolute.map(|solved| solved.damping), linear.damping * unit.damping),
    ] {
        estimates::add(&mut object, name, of_unit, solved);
        object[format!("linear_{name}{of_unit}")] = exact.into();
    }
    estimates::add(&mut object, "mean_pressure_ratio", "", Some(found.mean_pressure));
    object["trapped_mean_pressure_ratio"] = found.trapped_mean_pressure.into();
    object["invariant_deviation"] = found.invariant_deviation.into();
    object["boyle_load_min_n"] = boyle[0].into();
    object["boyle_load_max_n"] = boyle[1].into();
    object["incompressible_load_max_n"] = found.greatest_viscous.into();
    object
}

/// Cost of the solve: its wall time \[s\], and the counts.
#[derive(serde::Serialize)]
struct StatsObject {
    wall_s: f64,
    #[serde(flatten)]
    counted: Stats,
}

/// The model that was solved, with a sentence for each decision.
fn model_object(model: &Model) -> Value {
    json!({
        "fidelity": model.fidelity,
        "method": model.method,
        "teeth_solved": model.teeth_solved,
        "half_width": model.half_width,
        "shear": model.shear,
        "why": sentences(model),
    })
}

impl Summary {
    /// Adds torque over speed, or the warning that it is not known.
    pub fn add_torque(&mut self, found: Result<Option<TorqueCurves>, MotorError>) {
        match found {
            Ok(curves) => self.torque = curves,
            Err(error) => self.warnings.push(format!("torque over speed is not known: without film, {error}")),
        }
    }

    /// The object of a solution. `wall_s` is the wall time of the solve by the caller's clock. `command` is the words of the command line.
    pub fn new(problem: &Problem, solution: &Solution, wall_s: f64, command: &[String]) -> Self {
        let problem = &*settled(problem, &solution.outcome);
        let plate = problem.scenario.plate().zip(solution.outcome.plate());
        let mut summary = Self {
            outcome: solution.outcome,
            status: solution.status,
            accuracy: solution.accuracy,
            numbers: Numbers::of(problem, solution),
            torque: None,
            exact: plate.map(|(plate, result)| ExactComparison::of(plate, result, &solution.recording)),
            wall_s,
            stats: solution.stats,
            model: solution.model.clone(),
            validity: validity::outside(problem, solution),
            warnings: solution.warnings.clone(),
            command: command.to_vec(),
            problem: problem.clone(),
        };
        summary.tell_unknown(solution);
        summary
    }

    /// Adds warnings about numbers that the scene has, but that are not known.
    fn tell_unknown(&mut self, solution: &Solution) {
        let known = |quantity: Quantity| self.numbers.get(quantity).is_some();
        if known(Quantity::StallTorque) && !known(Quantity::StallTorqueError) {
            self.warnings.push(NO_TORQUE_ERROR.to_owned());
        }
        let own: Vec<Quantity> = Quantity::of(&self.problem).collect();
        let expected = |quantity: &Quantity| match quantity {
            Quantity::Residual | Quantity::Tolerance => matches!(solution.status, Status::NotConverged { .. }),
            Quantity::StallTorque => solution.performance.is_some(),
            Quantity::StallTorqueError => false,
            other => own.contains(other),
        };
        let results = [Quantity::Residual, Quantity::Tolerance].into_iter().chain(RESULTS.concat());
        let unknown = results.filter(|quantity| expected(quantity) && !known(*quantity)).map(Quantity::name);
        let accuracy = (!self.accuracy.stated.is_finite()).then_some("accuracy_stated");
        let time = (!self.wall_s.is_finite()).then_some("stats.wall_s");
        let unknown: Vec<&str> = accuracy.into_iter().chain(time).chain(unknown).collect();
        if !unknown.is_empty() {
            self.warnings.push(format!("not known, hence null: {}", unknown.join(", ")));
        }
    }
}

/// An object of `--json` as text, with the parts that all of them have: the version of the format first, the program's version and the
/// command line (word by word; empty if there was none) last.
pub fn document(object: &impl Serialize, command: &[String]) -> String {
    #[derive(serde::Serialize)]
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
    let text = serde_json::to_string_pretty(object).map_or_else(|_| String::new(), |text| text + "\n");
    // Names may contain characters that control a terminal; in JSON these occur only within strings.
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if c != '\n' && is_unseen(c) {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| shown += &format!("\\u{unit:04x}"));
        } else {
            shown.push(c);
        }
    }
    shown
}

/// `348, limit 0.1`
pub fn beside_limit(excess: &ExceededLimit) -> String {
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

/// The status of a solve, or that of a run in files, as a mark beside numbers: in capitals, except for a reason after a colon; empty if all
/// is well.
pub fn mark(status: &str) -> String {
    match status.split_once(": ") {
        _ if status == status_name(&Status::Converged) => String::new(),
        Some((status, reason)) => format!("{}: {reason}", status.to_uppercase()),
        None => status.to_uppercase(),
    }
}

/// Of a result that is less accurate than requested, because the time allowed for it was up.
pub const TIME_UP: &str = "time was up";

/// How a solve ended, as it is marked beside its numbers: that it did not converge, or that its time was up; empty where all is well.
pub fn mark_of(solution: &Solution) -> String {
    match solution.accuracy.stopped_by {
        StoppedBy::Budget if solution.status == Status::Converged => TIME_UP.to_owned(),
        _ => mark(status_name(&solution.status)),
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
    fn characters_that_a_terminal_obeys_are_escaped() {
        let name = "a\u{9b}2J \u{202e}b\u{e0041}\n";
        let shown = text(&serde_json::json!({ "name": name }));
        assert!(shown.is_ascii() && shown.contains(r"a\u009b2J \u202eb\udb40\udc41\n"), "{shown}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&shown).unwrap()["name"], name);
    }

    #[test]
    fn numbers_that_are_not_finite_are_null_and_said_to_be() {
        let (problem, mut solution) = solved("plate-viscous");
        let Outcome::Plate(result) = &mut solution.outcome else { panic!("a plate") };
        result.film_load.error = f64::INFINITY;
        let summary = Summary::new(&problem, &solution, f64::NAN, &[]);
        assert_eq!(summary.numbers.get(Quantity::FilmLoadError), None);
        let warning = summary.warnings.last().unwrap();
        for name in ["stats.wall_s", "film_load_error_n", "mean_load_ratio_error"] {
            assert!(warning.contains(name), "{warning}");
        }
        let value: serde_json::Value = serde_json::from_str(&text(&summary)).unwrap();
        assert!(value["film_load_error_n"].is_null() && value["film_load_n"].is_f64());
        assert!(value["stats"]["wall_s"].is_null());
    }
}
