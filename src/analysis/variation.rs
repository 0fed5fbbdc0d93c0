//! Derivatives of any numbers of a solution with respect to the keys of its scene, from solves of neighbouring scenes.
//!
//! ```text
//! D(h) = (f(p + h) − f(p − h))/2h = f′ + O(h²),      h = 1 % of p
//! ```
//!
//! All solves are by the plan of the one in the middle and start from its state ([`crate::solve::near`]), so that what the accuracy leaves
//! open is nearly the same in all of them; how well their cycles repeat changes D by less than a millionth. What does change it are
//! contact edges that pass a node of the grid: f has ripples as fine as the grid, which a very short step would differentiate. The error of
//! a derivative is therefore taken from two steps, |D(h) − D(2h)|, and from two ladders of grids, the difference to the D of the same
//! solves without their finest grid, but never less than a share of the stated error of f over the scale of p, and relative to f′ the stated
//! error of f relative to f. Their sum is stated, and what the plan leaves out of the model (measured in `docs/theory.md`).
//!
//! Where p is at an end of its range, or a rule between keys has no room on one side, D is one-sided, (4 f(h) − f(2h) − 3 f(0))/2h,
//! and its error the difference to (f(h) − f(0))/h.

use super::attempt::error_in_words;
use super::error::AnalysisError;
use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::ladder::Nested;
use crate::problem::{Problem, RotorCompliance, Scenario};
use crate::scene::{PARAMETERS, Parameter, ParameterKind, Scene, SceneError, Value};
use crate::solution::Solution;
use crate::solve::near::Centre;
use crate::solve::{Settings, check};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The step, as a share of the scale of a key.
const STEP: f64 = 0.01;
/// The scale of a key that is zero, as a share of its slider.
const SCALE_AT_ZERO: f64 = 0.1;
/// Least error of a derivative, as a share of the stated error of the number over the scale of the key (calibrated with random plates and
/// motors).
const EXPECTED: f64 = 0.3;
/// Relative rounding error of a result that is computed from the fields, such as the no-load speed.
const ROUNDING: f64 = 1e-9;
/// The points where the scene is solved, in steps from the middle: on both sides, or on one.
const BOTH: [i32; 4] = [-2, -1, 1, 2];
const ABOVE: [i32; 2] = [1, 2];
const BELOW: [i32; 2] = [-1, -2];

/// A scene and the keys that are varied in it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Variation {
    /// The scene.
    pub scene: Scene,
    /// The keys.
    pub parameters: Vec<&'static Parameter>,
}

/// The side of the scene's value on which the points of a derivative lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sides {
    /// Steps to both sides.
    Both,
    /// At greater values, because there is no room below.
    Above,
    /// Steps to smaller values.
    Below,
}

/// A derivative, in the unit of the number over that of the key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Slope {
    /// The derivative; not finite where the number is not known.
    pub value: f64,
    /// The derivative without the finest grid.
    pub coarse: f64,
    /// The least error due to the grids, absolute, because both ladders of grids may agree by chance.
    pub least: f64,
    /// Its estimated error due to the length of the step, absolute.
    pub step_error: f64,
    /// Its estimated error, absolute, due to rounding and to what the plan leaves out of the model. A term that changes the number by a share ε
    /// is taken to be proportional to the key, so it changes the derivative by ε times the number over the scale of the key. Where the ring
    /// has different elements on both sides of the step, their errors differ as well: ε times the number over the step, and four times that
    /// for a one-sided derivative.
    pub left_out: f64,
}

impl Slope {
    /// Its estimated error due to the grids, absolute.
    pub fn grid_error(&self) -> f64 {
        (self.value - self.coarse).abs().max(self.least)
    }

    /// Its whole estimated error, absolute.
    pub fn error(&self) -> f64 {
        self.step_error + self.grid_error() + self.left_out
    }
}

/// The derivatives of all numbers with respect to one key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeyDerivatives {
    /// The key.
    pub parameter: &'static Parameter,
    /// Its value in the middle, in its unit.
    pub at: f64,
    /// The step h, in its unit.
    pub step: f64,
    /// The sides of the middle on which the scene was solved.
    pub sides: Sides,
    /// One for each number; or why there are none.
    pub slopes: Result<Vec<Slope>, String>,
}

/// Numbers of a solution, and their derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Jacobian {
    /// The numbers in the middle, with their stated errors.
    pub numbers: Nested<Vec<Estimate>>,
    /// The derivatives with respect to each key, in the order of the variation.
    pub columns: Vec<KeyDerivatives>,
}

/// Reads numbers, with their stated errors, from a problem and its solution, which has no pressure maps.
type Read<'a> = &'a (dyn Fn(&Problem, &Solution) -> Vec<Estimate> + Sync);

impl Variation {
    /// A variation of keys of `scene`, by name: each must have a value and a derivative, and may be named only once.
    pub fn new<S: AsRef<str>>(scene: &Scene, keys: &[S]) -> Result<Self, AnalysisError> {
        let all = Self::all(scene).parameters;
        let allowed = || all.iter().map(|parameter| parameter.key).collect::<Vec<_>>().join(", ");
        let mut parameters: Vec<&'static Parameter> = Vec::new();
        for key in keys.iter().map(AsRef::as_ref) {
            // Setting the key reports what is wrong with it.
            let value = Parameter::find(key).and_then(Parameter::range).map_or(0.0, |range| range.min);
            let set = scene.clone().set_value(key, Value::Number(value));
            let Some(parameter) = Parameter::find(key) else {
                set?;
                continue;
            };
            if !matches!(parameter.kind, ParameterKind::Number { .. }) || parameter.table() == "numerics" {
                return Err(AnalysisError::Input(format!(
                    "{key}: it accepts {}, and only a number that is not whole has a derivative: vary it in a sweep; allowed here: {}",
                    parameter.accepts(),
                    allowed()
                )));
            }
            // A value in an array of tables is not in the list of all keys, but may be named.
            let in_array = !PARAMETERS.contains(parameter) && scene.get(key).is_some();
            if !all.contains(&parameter) && !in_array {
                set?;
                let allowed = allowed();
                return Err(AnalysisError::Input(format!(
                    "{key}: it is not given in this scene; allowed here: {allowed}"
                )));
            }
            if parameters.contains(&parameter) {
                return Err(AnalysisError::Input(format!("{key}: given twice: the keys have to differ")));
            }
            parameters.push(parameter);
        }
        Ok(Self { scene: scene.clone(), parameters })
    }

    /// A variation of all keys of `scene` whose values are numbers, except whole ones, and on which its results can depend. Keys that
    /// follow from others, and numerics, are left out.
    pub fn all(scene: &Scene) -> Self {
        let acts = |parameter: &&'static Parameter| {
            matches!(parameter.kind, ParameterKind::Number { .. })
                && parameter.table() != "numerics"
                && scene.heeds(parameter.key)
                && scene.get(parameter.key).is_some()
        };
        Self { scene: scene.clone(), parameters: scene.parameters().filter(acts).collect() }
    }

    /// The values of the keys in the scene, each in its unit.
    pub fn values(&self) -> Vec<f64> {
        let number = |parameter: &&Parameter| self.scene.get(parameter.key).and_then(|value| value.as_number());
        self.parameters.iter().map(|parameter| number(parameter).unwrap_or(f64::NAN)).collect()
    }

    /// Problem at other values of the keys, in their units.
    pub fn problem(&self, values: &[f64]) -> Result<Problem, SceneError> {
        let keys = self.parameters.iter().map(|parameter| parameter.key);
        Problem::try_from(&self.scene.with_numbers(keys.zip(values.iter().copied()))?)
    }

    /// The derivatives, at the values of the scene, of the numbers that `numbers` reads. `centre` is the solution of the scene. The solves
    /// run on rayon's pool, and the result does not depend on the number of threads; `solved` is called after each of them with their total
    /// number. `None` if cancelled.
    pub fn jacobian(
        &self,
        centre: &Centre,
        numbers: Read<'_>,
        cancel: &Cancel,
        solved: &(dyn Fn(usize) + Sync),
    ) -> Option<Jacobian> {
        let (values, middle) = (self.values(), read(&centre.problem, &centre.solved, numbers));
        let plan = |column| {
            if centre.is_settled() {
                return self.steps(&values, column);
            }
            let points = Err("the scene itself is not converged".to_owned());
            Steps { step: f64::NAN, sides: Sides::Both, points }
        };
        let plans: Vec<_> = (0..self.parameters.len()).map(plan).collect();
        let jobs: Vec<&Problem> = plans.iter().flat_map(|plan| &plan.points).flatten().collect();
        let of = |problem: &&Problem| {
            let found = error_in_words(|| centre.solve(problem, cancel));
            solved(jobs.len());
            let found = found?
                .ok_or("a solve beside it has no periodic state on the same grids, or floats at quite another gap")?;
            Ok(read(problem, &found, numbers))
        };
        let mut found: Vec<Result<Nested<Vec<Estimate>>, String>> = jobs.par_iter().map(of).collect();
        if cancel.is_cancelled() {
            return None;
        }
        let columns = plans.iter().enumerate().map(|(column, Steps { step, sides, points })| {
            let slopes = points.as_ref().map_err(Clone::clone).and_then(|points| {
                let solved = found.drain(..points.len()).collect::<Result<Vec<_>, String>>()?;
                let smooth = points.iter().all(|point| same_elements(point, &centre.problem));
                let one_sided = if *sides == Sides::Both { 1.0 } else { 4.0 };
                let relative = centre.left_out() / step * if smooth { STEP } else { one_sided };
                Ok(slopes(*sides, *step, relative, &middle, &solved))
            });
            KeyDerivatives {
                parameter: self.parameters[column],
                at: values[column],
                step: *step,
                sides: *sides,
                slopes,
            }
        });
        let columns = columns.collect();
        Some(Jacobian { numbers: middle, columns })
    }

    /// Where to solve for the derivative with respect to one key.
    fn steps(&self, values: &[f64], column: usize) -> Steps {
        let step = STEP * scale(self.parameters[column], values[column]);
        let at = |steps: i32| -> Result<Problem, String> {
            let mut moved = values.to_vec();
            moved[column] += f64::from(steps) * step;
            let problem = self.problem(&moved).map_err(|error| error.to_string())?;
            // A ring may not reach under the contact at that value.
            check(&problem, &Settings::default()).map_err(|error| error.to_string())?;
            Ok(problem)
        };
        let mut refused = String::new();
        for (sides, steps) in [(Sides::Both, &BOTH[..]), (Sides::Above, &ABOVE), (Sides::Below, &BELOW)] {
            match steps.iter().map(|steps| at(*steps)).collect() {
                Ok(points) => return Steps { step, sides, points: Ok(points) },
                Err(why) => refused = why,
            }
        }
        Steps { step, sides: Sides::Both, points: Err(refused) }
    }
}

/// The problems beside the middle, or why there are none.
struct Steps {
    step: f64,
    sides: Sides,
    points: Result<Vec<Problem>, String>,
}

/// Reference for a relative change of a key, in its unit: its value, for a temperature from absolute zero; for a key that is zero, a share
/// of the range of its slider.
fn scale(parameter: &Parameter, value: f64) -> f64 {
    match parameter.kind {
        _ if parameter.unit == "°C" => value + 273.15,
        ParameterKind::Number { slider, .. } if value == 0.0 => SCALE_AT_ZERO * (slider.max - slider.min),
        _ => value.abs(),
    }
}

fn read(problem: &Problem, solved: &Nested<Solution>, numbers: Read<'_>) -> Nested<Vec<Estimate>> {
    Nested {
        fine: numbers(problem, &solved.fine),
        coarse: solved.coarse.as_ref().map(|coarse| numbers(problem, coarse)),
    }
}

/// Whether the neglected part of the compliance changes smoothly between the two problems: two rings have the same elements only if their
/// sections are connected in the same way, and otherwise neglect a different part.
fn same_elements(a: &Problem, b: &Problem) -> bool {
    let (Scenario::Motor(a), Scenario::Motor(b)) = (&a.scenario, &b.scenario) else { return true };
    let (RotorCompliance::Ring(one), RotorCompliance::Ring(other)) = (&a.rotor, &b.rotor) else { return true };
    one.is_meshed_like(a.wave().band, other, b.wave().band).unwrap_or(false)
}

/// The slopes of all numbers, from those in the middle and at the points of the sides. `relative`: what is left out of the model, as a share of
/// a number, over the scale of the key, or over the step where it does not change smoothly.
fn slopes(
    sides: Sides,
    step: f64,
    relative: f64,
    middle: &Nested<Vec<Estimate>>,
    points: &[Nested<Vec<Estimate>>],
) -> Vec<Slope> {
    // D(h), and the value that the error due to the step is estimated from.
    let derivative = |middle: f64, at: &[f64]| match (sides, at) {
        (Sides::Both, [b2, b1, a1, a2]) => ((a1 - b1) / (2.0 * step), (a2 - b2) / (4.0 * step)),
        (sides, [one, two]) => {
            let step = if sides == Sides::Below { -step } else { step };
            ((4.0 * one - two - 3.0 * middle) / (2.0 * step), (one - middle) / step)
        }
        _ => (f64::NAN, f64::NAN),
    };
    let number = |i: usize| {
        let at: Vec<f64> = points.iter().map(|point| point.fine[i].value).collect();
        let Estimate { value: number, error } = middle.fine[i];
        let (value, longer) = derivative(number, &at);
        let coarse = middle.coarse.as_ref().and_then(|middle| {
            let at: Option<Vec<f64>> = points.iter().map(|point| Some(point.coarse.as_ref()?[i].value)).collect();
            Some(derivative(middle[i].value, &at?).0)
        });
        // A number that does not depend on a key has no rounding error either.
        let rounding = if value == 0.0 { 0.0 } else { ROUNDING / step };
        let left_out = (relative + rounding) * number.abs();
        // A share of the stated error, as if this changed as the key does, and of the derivative as large a share as that of its number. An error
        // that is not known is no measure, and what is exact or has nothing to do with a key has none.
        let least = if error.is_finite() && error > 0.0 && value != 0.0 {
            EXPECTED * error * STEP / step + error / number.abs().max(error) * value.abs()
        } else {
            0.0
        };
        // A single grid gives no information about its error.
        let coarse = coarse.unwrap_or(f64::INFINITY);
        Slope { value, coarse, least, step_error: (value - longer).abs(), left_out }
    };
    (0..middle.fine.len()).map(number).collect()
}

impl KeyDerivatives {
    /// The scale of the key to which an elasticity refers, in its unit: the size of its value; for a temperature, the value above absolute
    /// zero. `None` if the value is 0 and the key is not a temperature.
    pub fn scale(&self) -> Option<f64> {
        let relative = self.parameter.unit == "°C" || self.at != 0.0;
        relative.then(|| scale(self.parameter, self.at))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_that_have_no_derivative_are_refused_by_name() {
        let error = |keys: &[&str]| Variation::new(&Scene::motor(), keys).unwrap_err().to_string();
        assert!(error(&["film.min_spacing"]).contains("did you mean film.min_spacing_nm?"));
        assert!(error(&["motor.waves"]).contains("a whole number from 1 to 100"));
        assert!(error(&["film.gas"]).starts_with("film.gas: it accepts one of"));
        assert!(error(&["numerics.tolerance"]).contains("numerics.tolerance"));
        assert!(
            error(&["stator.tooth_radius_m"])
                .contains("not given in this scene; allowed here: motor.contact_radius_mm")
        );
        assert!(error(&["plate.length_mm"]).contains("plate"));
        assert!(error(&["film.viscosity_upa_s", "film.viscosity_upa_s"]).contains("given twice"));
        assert!(error(&["film.temperature_c"]).contains("film.gas"));
    }

    #[test]
    fn all_keys_are_those_that_act() {
        let keys = |scene: &Scene| -> Vec<&str> { Variation::all(scene).parameters.iter().map(|p| p.key).collect() };
        let mut scene = Scene::motor();
        assert!(keys(&scene).contains(&"film.viscosity_upa_s") && !keys(&scene).contains(&"motor.load_n"));
        scene.set_all([("film.gas", "air"), ("film.altitude_m", "2000"), ("motor.load_n", "20")]).unwrap();
        let now = keys(&scene);
        for (key, acts) in [
            ("film.viscosity_upa_s", false),
            ("film.temperature_c", true),
            ("film.ambient_pressure_kpa", false),
            ("film.altitude_m", true),
            ("motor.load_per_wave_n", false),
            ("motor.load_n", true),
        ] {
            assert_eq!(now.contains(&key), acts, "{key}");
        }
        assert!(!keys(&Scene::plate()).contains(&"film.min_spacing_nm"));
    }
}
