//! Several scenes side by side: the differences between them, and between their results.
//!
//! Each run is a single solve of its scene: its numbers are those of [`solve`](crate::solve::solve) to the last bit, whatever it is
//! compared with and however many threads there are. A run that fails gives the reason, and the others go on. Differences are relative to
//! the first run.

use super::attempt::{RunStatus, attempt};
use super::error::AnalysisError;
use super::quantity::{Numbers, Quantity, labelled};
use super::validity::{names, outside};
use crate::control::Cancel;
use crate::estimate::Estimate;
use crate::problem::{Outline, Problem, Scenario};
use crate::scene::{PARAMETERS, Parameter, Scene, Value, show_up_to};
use crate::solution::{Solution, settled};
use crate::solve::{Settings, check};
use rayon::prelude::*;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::sync::Arc;

/// Most characters of a label: room for the name of a scene with two values that differ.
pub const LONGEST_LABEL: usize = 80;

/// One scene, solved.
#[derive(Clone, Debug)]
pub struct ComparedRun {
    /// Label in the comparison: the scene's name, made unique.
    pub label: String,
    /// The scene.
    pub scene: Scene,
    /// The scene, checked and in SI units; a plate that floats is at the gap that was found.
    pub problem: Problem,
    /// The solution, or why there is none.
    pub solved: Result<Arc<Solution>, String>,
}

/// Serialised without the problem, which follows from the scene and the solution.
impl Serialize for ComparedRun {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        (&self.label, &self.scene, &self.solved).serialize(to)
    }
}

impl<'de> Deserialize<'de> for ComparedRun {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let (label, scene, solved) = <(String, Scene, _)>::deserialize(from)?;
        let problem = Problem::try_from(&scene).map_err(D::Error::custom)?;
        Ok(Self::new(label, scene, problem, solved))
    }
}

impl ComparedRun {
    /// A run of `problem`, which `scene` poses.
    pub(crate) fn new(label: String, scene: Scene, problem: Problem, solved: Result<Arc<Solution>, String>) -> Self {
        let found = solved.as_ref().map_or(Cow::Borrowed(&problem), |solved| settled(&problem, &solved.outcome));
        Self { label, scene, problem: found.into_owned(), solved }
    }

    /// The numbers; none if it failed.
    pub fn numbers(&self) -> Numbers {
        self.solved.as_ref().map_or_else(|_| Numbers::default(), |solution| Numbers::of(&self.problem, solution))
    }

    /// Names of the limits of the model that the run exceeds; none if it failed.
    pub fn outside(&self) -> Vec<&'static str> {
        let limits = |solution: &Arc<Solution>| names(&outside(&self.problem, solution));
        self.solved.as_ref().map_or_else(|_| Vec::new(), limits)
    }

    /// How it ended.
    pub fn status(&self) -> RunStatus {
        self.solved.as_ref().map_or_else(|reason| RunStatus::Failed(reason.clone()), |solution| solution.status.into())
    }

    /// Whether its cycle repeats to the tolerance.
    pub fn converged(&self) -> bool {
        self.status() == RunStatus::Converged
    }
}

/// Solves the scenes, several at a time on rayon's pool, and returns the runs in the order of the scenes. `finished` is called after each
/// run, on any thread.
///
/// # Errors
/// [`AnalysisError`] for a scene that cannot be solved by the method asked for. A solve that fails is a [`ComparedRun`] that says so.
pub fn runs(
    scenes: &[Scene],
    settings: &Settings,
    cancel: &Cancel,
    finished: &(dyn Fn(&ComparedRun) + Sync),
) -> Result<Vec<ComparedRun>, AnalysisError> {
    let problems = scenes.iter().map(Problem::try_from).collect::<Result<Vec<_>, _>>()?;
    problems.iter().try_for_each(|problem| check(problem, settings))?;
    Ok(each(scenes, problems, settings, cancel, finished))
}

/// Solves scenes whose problems are given. A problem that the requested method cannot solve gives a failed run.
pub(super) fn each(
    scenes: &[Scene],
    problems: Vec<Problem>,
    settings: &Settings,
    cancel: &Cancel,
    finished: &(dyn Fn(&ComparedRun) + Sync),
) -> Vec<ComparedRun> {
    let prepared: Vec<_> = labels(scenes).into_iter().zip(scenes).zip(problems).collect();
    let solved = prepared.into_par_iter().map(|((label, scene), problem)| {
        let solved = attempt(&problem, settings, &mut (), cancel).map(Arc::new);
        let run = ComparedRun::new(label, scene.clone(), problem, solved);
        finished(&run);
        run
    });
    solved.collect()
}

/// The scenes' names; if several are equal, all except the first are numbered.
fn labels(scenes: &[Scene]) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    for scene in scenes {
        labels.push(unique(&scene.name, |label| labels.iter().any(|other| other == label)));
    }
    labels
}

/// `name` as it is shown: cut if it is long, and numbered from 2 if it is taken.
pub fn unique(name: &str, taken: impl Fn(&str) -> bool) -> String {
    let name = if name.trim().is_empty() { "unnamed scene".to_owned() } else { show_up_to(LONGEST_LABEL, name.trim()) };
    let mut label = name.clone();
    let mut count = 1;
    while taken(&label) {
        count += 1;
        label = format!("{name} ({count})");
    }
    label
}

/// One key, and its value in every scene.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterRow {
    /// The key.
    pub parameter: &'static Parameter,
    /// Its value in each scene; `None` where it is absent or does not apply.
    pub values: Vec<Option<Value>>,
    /// Whether each scene has the key.
    has: Vec<bool>,
}

impl ParameterRow {
    /// What a table for people shows if the scene has no value: `none` where the key is absent, and `–` where it does not apply.
    pub fn missing(&self, place: usize) -> &'static str {
        if self.has.get(place) == Some(&true) { "none" } else { "–" }
    }

    /// Whether the scenes differ in it.
    pub fn differs(&self) -> bool {
        self.values.windows(2).any(|pair| pair[0] != pair[1])
    }
}

/// Every key that at least one of the scenes has, except name and description, in the order of the file.
pub fn parameters(scenes: &[&Scene]) -> Vec<ParameterRow> {
    let row = |parameter: &'static Parameter| {
        let values: Vec<_> = scenes.iter().map(|scene| scene.get(parameter.key)).collect();
        let has = scenes.iter().map(|scene| scene.has(parameter)).collect();
        let listed = !matches!(parameter.key, "name" | "about") && values.iter().any(Option::is_some);
        listed.then_some(ParameterRow { parameter, values, has })
    };
    PARAMETERS.iter().filter_map(row).collect()
}

/// One quantity, in every run.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultRow {
    /// The quantity.
    pub quantity: Quantity,
    /// Its unit, if it is the same in all runs that have the quantity.
    pub unit: Option<&'static str>,
    /// One for each run.
    pub cells: Vec<ResultCell>,
}

impl ResultRow {
    /// Its description, with the unit after a comma; if the runs have different units, each value has its own.
    pub fn label(&self) -> String {
        labelled(self.quantity.words(), self.unit.unwrap_or(""))
    }
}

/// A quantity of one run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ResultCell {
    /// Its value with its estimated numerical error, in the run's unit of the quantity; `None` if the run does not have it.
    pub found: Option<Estimate>,
    /// That unit; empty for a pure number.
    pub unit: &'static str,
    /// The difference from the first run \[% of the size of the first run's value\], with the sum of both errors \[percentage points\];
    /// `None` for the first run itself, for a run in another unit, and if the first run's value is smaller than its error.
    pub difference_percent: Option<Estimate>,
}

/// The unit of a quantity of a run. A squeeze number is based on a length, and a Knudsen number on a gap; numbers with different bases
/// cannot be compared, just as numbers with different units cannot.
fn unit(quantity: Quantity, run: &ComparedRun) -> &'static str {
    match (quantity, &run.problem.scenario) {
        (Quantity::SqueezeNumber, Scenario::Motor(_)) => "by tooth width",
        (Quantity::SqueezeNumber, Scenario::Plate(plate)) => match plate.outline() {
            Outline::Strip | Outline::Rectangle { .. } => "by length",
            Outline::Disc => "by radius",
            Outline::Ring { .. } => "by width of the ring",
        },
        (Quantity::KnudsenNumber, Scenario::Motor(_)) => "at the closed gap",
        (Quantity::KnudsenNumber, Scenario::Plate(_)) => "at the mean gap",
        _ => quantity.unit(&run.problem),
    }
}

/// Every quantity that at least one of the runs has, in the order of the columns of a sweep; errors are beside their values.
pub fn results(runs: &[ComparedRun]) -> Vec<ResultRow> {
    let mut numbers: Vec<Numbers> = runs.iter().map(ComparedRun::numbers).collect();
    // The cost of a solve that started from the fields of another one says nothing about its scene.
    for (numbers, run) in numbers.iter_mut().zip(runs) {
        if run.solved.as_ref().is_ok_and(|solution| solution.stats.warm_start) {
            Quantity::all().filter(|quantity| quantity.is_count()).for_each(|count| numbers.set(count, f64::NAN));
        }
    }
    let row = |quantity: Quantity| {
        let first = numbers.first().and_then(|numbers| numbers.estimate(quantity));
        let units: Vec<&'static str> = runs.iter().map(|run| unit(quantity, run)).collect();
        let cell = |(i, numbers): (usize, &Numbers)| {
            let found = numbers.estimate(quantity);
            // The difference between N/m and N has no meaning.
            let alike = first.zip(found).filter(|_| i > 0 && units[i] == units[0]);
            ResultCell { found, unit: units[i], difference_percent: alike.and_then(|(a, b)| difference(a, b)) }
        };
        let cells: Vec<_> = numbers.iter().enumerate().map(cell).collect();
        let mut there = cells.iter().filter(|cell| cell.found.is_some()).map(|cell| cell.unit);
        let unit = there.next()?;
        // For a pure number, a basis that all runs have in common need not be named.
        let pure = matches!(quantity, Quantity::SqueezeNumber | Quantity::KnudsenNumber);
        let unit = there.all(|other| other == unit).then_some(if pure { "" } else { unit });
        Some(ResultRow { quantity, unit, cells })
    };
    Quantity::all().filter(|quantity| !quantity.is_error()).filter_map(row).collect()
}

/// 100 (b − a)/|a|, with the greatest error that both errors can cause.
fn difference(a: Estimate, b: Estimate) -> Option<Estimate> {
    // A value that may be zero has no relative difference. An unknown error does not count here.
    if a.value.abs() <= a.error.max(0.0) {
        return None;
    }
    let ratio = b.value / a.value;
    let most = (b.value.abs() + b.error.abs()) / (a.value.abs() - a.error.abs());
    let error = 100.0 * (most - ratio.abs());
    let value = 100.0 * (ratio - 1.0) * a.value.signum();
    Some(Estimate { value, error }).filter(|found| found.value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;

    #[test]
    fn only_the_key_that_was_changed_differs() {
        let scenes = ["fundamental", "min-spacing-100nm"].map(|name| presets::find(name).unwrap());
        let rows = parameters(&[&scenes[0], &scenes[1]]);
        let differing: Vec<_> = rows.iter().filter(|row| row.differs()).map(|row| row.parameter.key).collect();
        assert_eq!(differing, ["film.min_spacing_nm"]);
        assert!(rows.len() > 15, "{}", rows.len());
    }

    #[test]
    fn a_key_that_a_scene_has_not_is_not_one_that_is_absent() {
        let floating = Scene::plate().with([("plate.mass_g", "100")]).unwrap();
        let rows = parameters(&[&Scene::motor(), &Scene::plate(), &floating]);
        let row = |key: &str| rows.iter().find(|row| row.parameter.key == key).unwrap();
        assert_eq!([0, 1].map(|place| row("plate.mass_g").missing(place)), ["–", "none"]);
        assert_eq!(row("plate.mean_gap_um").missing(2), "–");
    }

    #[test]
    fn names_are_made_unique() {
        let scene = presets::find("fundamental").unwrap();
        let names = labels(&[scene.clone(), scene.clone(), scene]);
        assert_eq!(names, ["Fundamental case", "Fundamental case (2)", "Fundamental case (3)"]);
    }

    #[test]
    fn what_is_zero_or_unknown_has_no_difference() {
        let unknown = |value: f64| Estimate { value, error: f64::NAN };
        let with = |value: f64, error: f64| Estimate { value, error };
        assert_eq!(difference(unknown(0.0), unknown(1.0)), None);
        let found = difference(unknown(2.0), with(3.0, 0.1)).unwrap();
        assert!(found.value == 50.0 && found.error.is_nan());
        let alike = difference(with(2.0, 0.1), with(2.0, 0.1)).unwrap();
        assert!(alike.value == 0.0 && (alike.error - 100.0 * (2.1 / 1.9 - 1.0)).abs() < 1e-9, "{alike:?}");
        // The value is hardly resolved, so the difference may be much larger.
        let hardly = difference(with(1.7e-4, 1.1e-4), with(0.6, 0.005)).unwrap();
        assert!(hardly.value + hardly.error > 100.0 * (0.6 / 6e-5), "{hardly:?}");
        // Deeper suction is a smaller value.
        assert_eq!(difference(with(-2.0, 0.0), with(-3.0, 0.0)), Some(with(-50.0, 0.0)));
        assert_eq!(difference(with(-2.0, 0.0), with(1.0, 0.0)), Some(with(150.0, 0.0)));
    }
}
