//! Several scenes side by side: what differs between them, and what comes of it.
//!
//! Every run is a single solve of its scene and nothing else: its numbers are those of [`solve`](crate::solve::solve) to
//! the last bit, whatever it is compared with and however many threads there are. A run that fails says so, and the others
//! go on. Differences are against the first run.

use super::attempt::{RunStatus, attempt};
use super::error::AnalysisError;
use super::quantity::{Numbers, Quantity, labelled};
use super::validity::{names, outside};
use crate::control::Cancel;
use crate::problem::Problem;
use crate::scene::{PARAMETERS, Parameter, Scene, Value, show_text};
use crate::solution::{Solution, settled};
use crate::solve::{Settings, check};
use rayon::prelude::*;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::sync::Arc;

/// One scene, solved.
#[derive(Clone, Debug)]
pub struct ComparedRun {
    /// What it is called here: the scene's name, made unique.
    pub label: String,
    /// The scene.
    pub scene: Scene,
    /// The same, checked and in SI units; a plate that floats is at the gap that was found.
    pub problem: Problem,
    /// What came of it, or why nothing did.
    pub solved: Result<Arc<Solution>, String>,
}

/// In bytes: all but the problem, which follows from the scene and the solution.
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

    /// Names of the limits of the model that it exceeds; none if it failed.
    pub fn outside(&self) -> Vec<&'static str> {
        let limits = |solution: &Arc<Solution>| names(&outside(&self.problem, Some(solution)));
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

/// Solves the scenes, several at a time on rayon's pool, and returns the runs in the order of the scenes. `finished` is told
/// of each run as it ends, from whichever thread.
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
    let prepared: Vec<_> = labels(scenes).into_iter().zip(scenes).zip(problems).collect();
    let solved = prepared.into_par_iter().map(|((label, scene), problem)| {
        let solved = attempt(&problem, settings, &mut (), cancel).map(Arc::new);
        let run = ComparedRun::new(label, scene.clone(), problem, solved);
        finished(&run);
        run
    });
    Ok(solved.collect())
}

/// The scenes' names; of several that are the same, all but the first are numbered.
fn labels(scenes: &[Scene]) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    for scene in scenes {
        labels.push(unique(&scene.name, |label| labels.iter().any(|other| other == label)));
    }
    labels
}

/// `name` as it is shown, a long one cut, numbered from 2 if it is taken.
pub fn unique(name: &str, taken: impl Fn(&str) -> bool) -> String {
    let name = if name.trim().is_empty() { "unnamed scene".to_owned() } else { show_text(name.trim()) };
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
}

impl ParameterRow {
    /// Whether the scenes differ in it.
    pub fn differs(&self) -> bool {
        self.values.windows(2).any(|pair| pair[0] != pair[1])
    }
}

/// Every key that one of the scenes has, but for name and description, in the order of the file.
pub fn parameters(scenes: &[&Scene]) -> Vec<ParameterRow> {
    let row = |parameter: &'static Parameter| {
        let values: Vec<_> = scenes.iter().map(|scene| scene.get(parameter.key)).collect();
        (!matches!(parameter.key, "name" | "about") && values.iter().any(Option::is_some))
            .then_some(ParameterRow { parameter, values })
    };
    PARAMETERS.iter().filter_map(row).collect()
}

/// One quantity, in every run.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultRow {
    /// The quantity.
    pub quantity: Quantity,
    /// Its unit, if all runs that have it have it in the same one.
    pub unit: Option<&'static str>,
    /// One for each run.
    pub cells: Vec<ResultCell>,
}

impl ResultRow {
    /// What it is, with its unit after a comma; where runs have it in different units, every value has its own.
    pub fn label(&self) -> String {
        labelled(self.quantity.words(), self.unit.unwrap_or(""))
    }
}

/// A quantity of one run. What is not there, and what is not finite, is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ResultCell {
    /// Its value, in the quantity's unit of this run's problem.
    pub value: Option<f64>,
    /// That unit; empty for a pure number.
    pub unit: &'static str,
    /// Its estimated numerical error, absolute, if there is an estimate.
    pub error: Option<f64>,
    /// By how much it exceeds that of the first run \[%\]; of the first run itself, and of one in another unit, `None`.
    pub difference_percent: Option<f64>,
    /// Error of that difference \[percentage points\]: both errors, added up.
    pub difference_error_percent: Option<f64>,
}

/// Every quantity that one of the runs has, errors beside what they are of, in the order of the columns of a sweep.
pub fn results(runs: &[ComparedRun]) -> Vec<ResultRow> {
    let numbers: Vec<Numbers> = runs.iter().map(ComparedRun::numbers).collect();
    let row = |quantity: Quantity| {
        let first = numbers.first().map(|numbers| side(numbers, quantity)).unwrap_or_default();
        let units: Vec<&'static str> = runs.iter().map(|run| quantity.unit(&run.problem)).collect();
        let cell = |(i, numbers): (usize, &Numbers)| {
            let own = side(numbers, quantity);
            // N/m less N is nothing.
            let alike = i > 0 && units[i] == units[0];
            let (difference_percent, difference_error_percent) =
                if alike { difference(first, own) } else { (None, None) };
            ResultCell { value: own.0, unit: units[i], error: own.1, difference_percent, difference_error_percent }
        };
        let cells: Vec<_> = numbers.iter().enumerate().map(cell).collect();
        let mut there = cells.iter().filter(|cell| cell.value.is_some()).map(|cell| cell.unit);
        let unit = there.next()?;
        let unit = there.all(|other| other == unit).then_some(unit);
        Some(ResultRow { quantity, unit, cells })
    };
    Quantity::all().filter(|quantity| !quantity.is_error()).filter_map(row).collect()
}

/// A value and its error.
fn side(numbers: &Numbers, quantity: Quantity) -> (Option<f64>, Option<f64>) {
    (numbers.get(quantity), quantity.error().and_then(|error| numbers.get(error)))
}

/// 100 (b/a − 1), and the sum of what the two errors make of it.
fn difference(a: (Option<f64>, Option<f64>), b: (Option<f64>, Option<f64>)) -> (Option<f64>, Option<f64>) {
    let (Some(first), Some(own)) = (a.0, b.0) else { return (None, None) };
    // Of what may be nothing at all there is no share.
    if first.abs() <= a.1.unwrap_or(0.0) {
        return (None, None);
    }
    let finite = |value: f64| value.is_finite().then_some(value);
    let error = a.1.zip(b.1).map(|(ea, eb)| 100.0 * (eb.abs() + (own / first).abs() * ea.abs()) / first.abs());
    (finite(100.0 * (own / first - 1.0)), error.and_then(finite))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fidelity::Fidelity;
    use crate::scene::presets;
    use crate::solve::{SolveError, solve};

    fn draft() -> Settings {
        Settings { fidelity: Fidelity::Draft, ..Settings::default() }
    }

    #[test]
    fn every_run_is_the_single_solve_to_the_last_bit() {
        let scenes = ["fundamental", "min-spacing-100nm", "plate-crossover"].map(|name| presets::find(name).unwrap());
        let runs = runs(&scenes, &draft(), &Cancel::new(), &|_| ()).unwrap();
        for (scene, run) in scenes.iter().zip(&runs) {
            let problem = Problem::try_from(scene).unwrap();
            let alone = solve(&problem, &draft(), &mut (), &Cancel::new()).unwrap();
            let solution = run.solved.as_ref().unwrap();
            assert_eq!(run.numbers(), Numbers::of(&problem, &alone));
            assert_eq!((solution.outcome, &solution.recording), (alone.outcome, &alone.recording));
        }
        let results = results(&runs);
        let alpha = results.iter().find(|row| row.quantity == Quantity::Alpha).unwrap();
        let [first, second, plate] = &alpha.cells[..] else { panic!("{alpha:?}") };
        let exact = 100.0 * (second.value.unwrap() / first.value.unwrap() - 1.0);
        assert_eq!((first.difference_percent, second.difference_percent), (None, Some(exact)));
        assert!(second.difference_error_percent.unwrap() > 100.0 * second.error.unwrap() / first.value.unwrap());
        assert_eq!(*plate, ResultCell::default());
        // A strip's force is per metre: it has a unit of its own, and no difference from a motor's.
        let load = results.iter().find(|row| row.quantity == Quantity::FilmLoad).unwrap();
        let [_, second, strip] = &load.cells[..] else { panic!("{load:?}") };
        assert!(second.difference_percent.is_some() && strip.value.is_some(), "{load:?}");
        assert_eq!((strip.difference_percent, strip.unit, load.unit), (None, "N/m", None));
        assert!(results.iter().all(|row| !row.quantity.name().contains("_error")));
    }

    #[test]
    fn only_the_key_that_was_changed_differs() {
        let scenes = ["fundamental", "min-spacing-100nm"].map(|name| presets::find(name).unwrap());
        let rows = parameters(&[&scenes[0], &scenes[1]]);
        let differing: Vec<_> = rows.iter().filter(|row| row.differs()).map(|row| row.parameter.key).collect();
        assert_eq!(differing, ["film.min_spacing_nm"]);
        assert!(rows.len() > 15, "{}", rows.len());
    }

    #[test]
    fn names_are_made_unique() {
        let scene = presets::find("fundamental").unwrap();
        let names = labels(&[scene.clone(), scene.clone(), scene]);
        assert_eq!(names, ["Fundamental case", "Fundamental case (2)", "Fundamental case (3)"]);
    }

    #[test]
    fn what_is_zero_or_unknown_has_no_difference() {
        assert_eq!(difference((Some(0.0), None), (Some(1.0), None)), (None, None));
        assert_eq!(difference((Some(2.0), None), (Some(3.0), Some(0.1))), (Some(50.0), None));
        assert_eq!(difference((Some(2.0), Some(0.1)), (Some(2.0), Some(0.1))), (Some(0.0), Some(10.0)));
    }

    #[test]
    fn a_plate_and_the_papers_method_do_not_go_together() {
        let scenes = ["fundamental", "plate-viscous"].map(|name| presets::find(name).unwrap());
        let settings = Settings { method: crate::solve::Method::Paper, ..draft() };
        let refused = runs(&scenes, &settings, &Cancel::new(), &|_| ()).unwrap_err();
        assert_eq!(refused, AnalysisError::Solve(SolveError::PaperPlate));
    }
}
