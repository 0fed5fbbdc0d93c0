//! A scene with its unknowns, solved under every condition of a table.

use super::measured::{Measured, Observable};
use super::unknown::{Bounds, MOST_UNKNOWNS, Unknown};
use crate::analysis::attempt::{RunStatus, attempt, caught};
use crate::analysis::error::AnalysisError;
use crate::analysis::quantity::Numbers;
use crate::analysis::sweep::spaced;
use crate::analysis::variation::Variation;
use crate::control::Cancel;
use crate::drive::Scaled;
use crate::estimate::Estimate;
use crate::fidelity::Fidelity;
use crate::problem::{Problem, Scenario, rpm};
use crate::scene::{Scale, Scene, SceneError};
use crate::solution::{Outcome, Solution};
use crate::solve::near::Centre;
use crate::solve::{Method, Record, Settings, check};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Points of a curve of torque over speed.
const CURVE: usize = 61;

/// Torque over the rotor's speed, `[rpm, N m]`.
pub(super) type Curve = Vec<[f64; 2]>;

/// A computed number with its estimated numerical error, or why there is none.
pub type Computed = Result<Estimate, String>;

/// A scene, the keys that are chosen, and the conditions under which it is solved.
#[derive(Debug)]
pub(super) struct FitModel<'a> {
    scene: &'a Scene,
    /// How it is solved.
    pub(super) settings: Settings,
    /// The keys that are chosen.
    pub(super) unknowns: Vec<Unknown>,
    conditions: Vec<Condition>,
    solves: AtomicUsize,
}

/// The scene under one condition.
#[derive(Debug)]
struct Condition {
    scene: Scene,
    /// Whether each unknown is chosen under this condition: if the table sets the key, its value is known.
    chosen: Vec<bool>,
    /// The numbers to be computed.
    asked: Vec<Observable>,
}

impl<'a> FitModel<'a> {
    /// Checks the keys to be chosen, and whether the scene can be solved at the values from which the search starts.
    pub(super) fn new(scene: &'a Scene, bounds: &[Bounds], settings: &Settings) -> Result<Self, AnalysisError> {
        if !(1..=MOST_UNKNOWNS).contains(&bounds.len()) {
            let found = bounds.len();
            return Err(AnalysisError::Input(format!("vary: {found} keys given: allowed 1 to {MOST_UNKNOWNS}")));
        }
        let unknowns = bounds.iter().map(|bounds| Unknown::new(scene, bounds)).collect::<Result<Vec<_>, _>>()?;
        for (i, unknown) in unknowns.iter().enumerate() {
            let key = unknown.parameter.key;
            if unknowns[..i].iter().any(|other| other.parameter.key == key) {
                return Err(AnalysisError::Input(format!("vary {key}: given twice: the keys have to differ")));
            }
        }
        check(&Problem::try_from(scene)?, &Settings { record: Record::Numbers, ..*settings })?;
        Ok(Self { scene, settings: *settings, unknowns, conditions: Vec::new(), solves: AtomicUsize::new(0) })
    }

    /// Adds the conditions of a table, with the numbers that are to be computed under each.
    ///
    /// # Errors
    /// Every line sets a key that is to be chosen, or a line sets a key that the scene does not accept.
    pub(super) fn under(mut self, measured: &Measured) -> Result<Self, AnalysisError> {
        let sets = |changes: &[(String, String)], key: &str| changes.iter().any(|(other, _)| other == key);
        for unknown in &self.unknowns {
            let key = unknown.parameter.key;
            if measured.measurements.iter().all(|one| sets(&measured.conditions[one.condition], key)) {
                return Err(AnalysisError::Input(format!(
                    "vary {key}: every line of the table of measurements sets it: nothing is left to choose"
                )));
            }
        }
        let condition = |(i, changes): (usize, &Vec<(String, String)>)| -> Result<Condition, AnalysisError> {
            let mut measurements = measured.measurements.iter().filter(|one| one.condition == i).peekable();
            let place = measurements.peek().map_or_else(String::new, |one| format!(", {}", one.label));
            let scene = self.scene.with(changes);
            let scene = scene.map_err(|error| AnalysisError::Input(format!("{}{place}: {error}", measured.name)))?;
            let chosen = self.unknowns.iter().map(|unknown| !sets(changes, unknown.parameter.key)).collect();
            Ok(Condition { scene, chosen, asked: measurements.map(|one| one.what).collect() })
        };
        self.conditions = measured.conditions.iter().enumerate().map(condition).collect::<Result<_, _>>()?;
        Ok(self)
    }

    /// Sets these numbers of the scene itself as those to be computed.
    pub(super) fn asking(mut self, asked: Vec<Observable>) -> Self {
        self.conditions = vec![Condition { scene: self.scene.clone(), chosen: vec![true; self.unknowns.len()], asked }];
        self
    }

    /// How many solves there have been.
    pub(super) fn solves(&self) -> usize {
        self.solves.load(Ordering::Relaxed)
    }

    /// The values from which the search starts, from 0 to 1.
    pub(super) fn start(&self) -> Vec<f64> {
        self.unknowns.iter().map(|unknown| unknown.place(unknown.start)).collect()
    }

    /// The scene with the values at `x`, under one condition.
    fn scene_at(&self, condition: &Condition, x: &[f64]) -> Result<Scene, SceneError> {
        let all = self.unknowns.iter().zip(x).zip(&condition.chosen);
        let chosen = all.filter(|(_, chosen)| **chosen);
        condition.scene.with_numbers(chosen.map(|((unknown, x), _)| (unknown.parameter.key, unknown.value(*x))))
    }

    /// The scene itself with the values at `x`; its name says that it was fitted.
    pub(super) fn fitted(&self, x: &[f64], word: &str) -> Result<Scene, AnalysisError> {
        let values = self.unknowns.iter().zip(x).map(|(unknown, x)| (unknown.parameter.key, unknown.value(*x)));
        let mut scene = self.scene.with_numbers(values)?;
        scene.name = format!("{}, {word}", self.scene.name);
        scene.retitle(self.scene);
        Ok(scene)
    }

    /// Observables of each condition at each of several points, computed in parallel: `[point][condition][asked]`. `None` if cancelled.
    pub(super) fn at(
        &self,
        points: &[Vec<f64>],
        settings: &Settings,
        cancel: &Cancel,
    ) -> Option<Vec<Vec<Vec<Computed>>>> {
        let at = |x: &Vec<f64>| {
            let solve = |condition: &Condition| self.solve(condition, &condition.asked, x, settings, cancel);
            self.conditions.par_iter().map(solve).collect::<Vec<_>>()
        };
        let rows = points.par_iter().map(at).collect();
        (!cancel.is_cancelled()).then_some(rows)
    }

    /// Observables of each condition at one point, solved as asked: `[condition][asked]`. `None` if cancelled.
    pub(super) fn at_one(&self, x: &[f64], cancel: &Cancel) -> Option<Vec<Vec<Computed>>> {
        self.at(&[x.to_vec()], &self.settings, cancel)?.pop()
    }

    /// As `at_one`, with the torque over the rotor's speed, `[rpm, N m]`, of each condition under which torques are asked for, at speeds from the
    /// least to the greatest of them.
    pub(super) fn with_curves(&self, x: &[f64], cancel: &Cancel) -> Option<(Vec<Vec<Computed>>, Vec<Curve>)> {
        let of = |condition: &Condition| {
            let asked = &condition.asked;
            let measured = || asked.iter().filter_map(|what| what.speed_rpm());
            let ends = measured().reduce(f64::min).zip(measured().reduce(f64::max));
            let speeds = ends.map_or_else(Vec::new, |(from, to)| spaced(from, to, CURVE, Scale::Linear));
            let more = speeds.iter().map(|speed_rpm| Observable::Torque { speed_rpm: *speed_rpm });
            let all: Vec<Observable> = asked.iter().copied().chain(more).collect();
            let mut found = self.solve(condition, &all, x, &self.settings, cancel);
            let curve =
                found.split_off(asked.len()).into_iter().map(|found| found.map_or(f64::NAN, |found| found.value));
            (found, speeds.into_iter().zip(curve).map(|(speed, torque)| [speed, torque]).collect())
        };
        let found = self.conditions.par_iter().map(of).unzip();
        (!cancel.is_cancelled()).then_some(found)
    }

    /// As `at`, but solved at draft fidelity.
    pub(super) fn drafts(&self, points: &[Vec<f64>], cancel: &Cancel) -> Option<Vec<Vec<Vec<Computed>>>> {
        self.at(points, &Settings { fidelity: Fidelity::Draft, method: Method::Auto, ..self.settings }, cancel)
    }

    /// Observables of a condition at `x`.
    fn solve(
        &self,
        condition: &Condition,
        asked: &[Observable],
        x: &[f64],
        settings: &Settings,
        cancel: &Cancel,
    ) -> Vec<Computed> {
        let fields = asked.iter().any(|what| what.speed_rpm().is_some());
        let record = if fields { Record::Everything } else { Record::Numbers };
        let settings = Settings { record, ..*settings };
        self.solves.fetch_add(1, Ordering::Relaxed);
        let problem = self.scene_at(condition, x).and_then(|scene| Problem::try_from(&scene));
        let solved = problem.map_err(|error| error.to_string()).and_then(|problem| {
            let solution = attempt(&problem, &settings, &mut (), cancel)?;
            match RunStatus::from(solution.status) {
                RunStatus::Converged => Ok((problem, solution)),
                status => Err(status.to_string()),
            }
        });
        match solved {
            Ok((problem, solution)) => read(&problem, &solution, asked),
            Err(reason) => asked.iter().map(|_| Err(reason.clone())).collect(),
        }
    }

    /// ∂/∂x of the numbers of each condition at `x`, by the unknowns that are free: `[condition][asked][unknown]`. They are zero for the
    /// others, and a condition without derivatives has none. They are derivatives of `Method::Auto`; for the paper's method, whose contact
    /// moves from node to node of a fixed mesh, they are scaled by the ratio of the two results. `None` if cancelled.
    pub(super) fn slopes(&self, x: &[f64], free: &[bool], cancel: &Cancel) -> Option<Vec<Vec<Vec<f64>>>> {
        let of = |condition: &Condition| {
            self.slopes_of(condition, x, free, cancel).unwrap_or_else(|| vec![Vec::new(); condition.asked.len()])
        };
        let found: Vec<_> = self.conditions.par_iter().map(of).collect();
        (!cancel.is_cancelled()).then_some(found)
    }

    fn slopes_of(&self, condition: &Condition, x: &[f64], free: &[bool], cancel: &Cancel) -> Option<Vec<Vec<f64>>> {
        let Condition { chosen, asked, .. } = condition;
        let varied: Vec<usize> = (0..x.len()).filter(|k| free[*k] && chosen[*k]).collect();
        let mut slopes = vec![vec![0.0; x.len()]; asked.len()];
        if varied.is_empty() {
            return Some(slopes);
        }
        let scene = self.scene_at(condition, x).ok()?;
        let keys: Vec<&str> = varied.iter().map(|k| self.unknowns[*k].parameter.key).collect();
        let variation = Variation::new(&scene, &keys).ok()?;
        let problem = Problem::try_from(&scene).ok()?;
        let centre = caught(|| Centre::new(&problem, &self.settings, cancel)).ok()?.ok()?;
        let numbers = |problem: &Problem, solution: &Solution| -> Vec<Estimate> {
            let unknown = Estimate { value: f64::NAN, error: f64::NAN };
            read(problem, solution, asked).into_iter().map(|found| found.unwrap_or(unknown)).collect()
        };
        let count = |_| {
            self.solves.fetch_add(1, Ordering::Relaxed);
        };
        let found = variation.jacobian(&centre, &numbers, cancel, &count)?;
        let ratios: Vec<f64> = match self.settings.method {
            Method::Auto => vec![1.0; asked.len()],
            Method::Paper => {
                let own = self.solve(condition, asked, x, &self.settings, cancel);
                own.iter()
                    .zip(&found.numbers.fine)
                    .map(|(own, ours)| own.as_ref().map_or(0.0, |own| own.value / ours.value))
                    .collect()
            }
        };
        for (k, column) in varied.iter().zip(&found.columns) {
            let Ok(column) = &column.slopes else { continue };
            for (row, slope) in column.iter().enumerate() {
                let slope = slope.value * self.unknowns[*k].slope(x[*k]) * ratios[row];
                slopes[row][*k] = if slope.is_finite() { slope } else { 0.0 };
            }
        }
        Some(slopes)
    }
}

/// Takes the observables from a solution.
fn read(problem: &Problem, solution: &Solution, asked: &[Observable]) -> Vec<Computed> {
    let numbers = Numbers::of(problem, solution);
    let mut curve = Vec::new();
    if let (Scenario::Motor(motor), Outcome::Motor(result)) = (&problem.scenario, &solution.outcome) {
        let per_rpm = rpm(1.0, motor.contact_radius);
        let speeds: Vec<f64> = asked.iter().filter_map(|what| Some(what.speed_rpm()? / per_rpm)).collect();
        if !speeds.is_empty() {
            curve = Scaled::with_film(motor, result, &solution.recording).performance(&speeds).curve;
        }
    }
    let mut curve = curve.into_iter();
    let none = || "the scene has no such number".to_owned();
    asked
        .iter()
        .map(|what| match what {
            Observable::Number(quantity) => numbers.estimate(*quantity).ok_or_else(none),
            Observable::Torque { .. } => curve.next().map(|point| point.torque).ok_or_else(none),
        })
        .collect()
}
