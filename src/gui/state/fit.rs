//! Measurements as the window has them: the table, the keys that are to be chosen, and what a fit or the search for an optimum found.

use super::sweep::{AxisEdit, AxisForm};
use crate::analysis::fit::{Bounds, Goal, Limit, MOST_UNKNOWNS, Measured, Observable, Unknown, measurable};
use crate::gui::derived::words::unused;
pub use crate::job::fit::{FitTask, Found};
use crate::job::task::News;
use crate::problem::Problem;
use crate::scene::{Parameter, ParameterKind, Scale, Scene, quantity_text};
use std::sync::Arc;

/// What is chosen at first: the first that a scene has.
const FIRST: [&str; 2] = ["plate.mean_gap_um", "film.min_spacing_nm"];

/// What is looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sought {
    /// Agreement with the measurements.
    #[default]
    Agreement,
    /// The greatest value of a number.
    Greatest,
    /// Its least value.
    Least,
}

/// The table, the form, and the fit.
#[derive(Debug, Default)]
pub struct FitState {
    /// The table.
    pub measured: Option<Arc<Measured>>,
    form: Vec<AxisForm>,
    /// What is wrong with each line of the form.
    faults: Vec<Option<String>>,
    /// Of which scene the form was judged.
    judged: Option<Scene>,
    sought: Sought,
    /// The number whose optimum is sought, by its name.
    quantity: Option<&'static str>,
    /// Limits on other numbers, as they are typed.
    limits: String,
    /// What is wrong with them.
    goal_fault: Option<String>,
    /// The search under way, and the scene that it is of.
    task: Option<(Scene, FitTask)>,
    /// How many points were tried, and the least χ² or the best number so far.
    pub told: Option<(usize, f64)>,
    /// What was found, and for which scene.
    pub found: Option<(Scene, Arc<Found>)>,
    /// Why there is nothing.
    pub failure: Option<String>,
    /// Whether the last one was told to end.
    pub cancelled: bool,
}

/// Whether a key can be chosen between two bounds.
pub fn chooses(scene: &Scene, parameter: &Parameter) -> bool {
    matches!(parameter.kind, ParameterKind::Number { .. })
        && parameter.table() != "numerics"
        && unused(scene, parameter).is_none()
        && scene.get(parameter.key).is_some()
}

impl FitState {
    /// Takes a table of measurements in place of the one there was.
    pub fn load(&mut self, measured: Measured) {
        self.measured = Some(Arc::new(measured));
        (self.failure, self.told) = (None, None);
    }

    /// Forgets the table.
    pub fn forget(&mut self) {
        self.measured = None;
    }

    /// The torques of the table that were measured on the scene as it is: speed \[rpm\] and torque \[N m\]; and how many others there are,
    /// measured with other values of some keys.
    pub fn torques(&self) -> (Vec<[f64; 2]>, usize) {
        let Some(measured) = &self.measured else { return (Vec::new(), 0) };
        let mut others = 0;
        let torques = measured.measurements.iter().filter_map(|one| match one.what {
            Observable::Torque { speed_rpm } if measured.conditions[one.condition].is_empty() => {
                Some([speed_rpm, one.value])
            }
            Observable::Torque { .. } => {
                others += 1;
                None
            }
            Observable::Number(_) => None,
        });
        (torques.collect(), others)
    }

    /// Looks whether the form is one of `scene`, and what is wrong with it; only if one of them has changed.
    pub fn review(&mut self, scene: &Scene) {
        if self.judged.as_ref() == Some(scene) && self.faults.len() == self.form.len() {
            return;
        }
        let has = |key: &str| Parameter::find(key).is_some_and(|parameter| chooses(scene, parameter));
        self.form.retain(|axis| has(axis.key));
        if self.form.is_empty() {
            self.form.extend(FIRST.iter().find(|key| has(key)).map(|key| AxisForm::around(scene, key, 2)));
        }
        let bounds: Vec<Result<Bounds, String>> = self.form.iter().map(|axis| bounds(scene, axis)).collect();
        let twice = |i: usize| self.form[..i].iter().any(|other| other.key == self.form[i].key);
        self.faults = bounds
            .into_iter()
            .enumerate()
            .map(|(i, bounds)| if twice(i) { Some("Chosen twice: take another key".to_owned()) } else { bounds.err() })
            .collect();
        let known = quantities(scene);
        let present = self.quantity.filter(|name| known.iter().any(|(other, _)| other == name));
        self.quantity = present.or_else(|| known.first().map(|(name, _)| *name));
        self.goal_fault = self.goal(scene).err();
        self.judged = Some(scene.clone());
    }

    /// What is looked for, the name of the number if it is an optimum, and limits on others as they are typed.
    pub fn sought(&self) -> (Sought, Option<&'static str>, &str) {
        (self.sought, self.quantity, &self.limits)
    }

    /// Looks for something else.
    pub fn seek(&mut self, sought: Sought) {
        self.sought = sought;
        self.judged = None;
    }

    /// Looks for the optimum of the number of this name.
    pub fn seek_of(&mut self, name: &'static str) {
        self.quantity = Some(name);
        self.judged = None;
    }

    /// Within these limits on other numbers.
    pub fn limit(&mut self, limits: String) {
        self.limits = limits;
        self.judged = None;
    }

    /// What is wrong with the limits.
    pub fn goal_fault(&self) -> Option<&str> {
        self.goal_fault.as_deref()
    }

    /// The optimum that is sought; `None` of agreement.
    ///
    /// # Errors
    /// What is wrong with the limits.
    pub fn goal(&self, scene: &Scene) -> Result<Option<Goal>, String> {
        let (Some(name), true) = (self.quantity, self.sought != Sought::Agreement) else { return Ok(None) };
        let limits = self.limits.split(',').map(str::trim).filter(|limit| !limit.is_empty());
        let limits = limits.map(str::parse).collect::<Result<Vec<Limit>, _>>().map_err(|error| error.to_string())?;
        Goal::new(scene, name, self.sought == Sought::Greatest, &limits).map(Some).map_err(|error| error.to_string())
    }

    /// The keys to be chosen.
    pub fn form(&self) -> &[AxisForm] {
        &self.form
    }

    /// What is wrong with each.
    pub fn faults(&self) -> &[Option<String>] {
        &self.faults
    }

    /// Whether one more key can be chosen.
    pub fn has_room(&self) -> bool {
        self.form.len() < MOST_UNKNOWNS
    }

    /// Changes a line of the form.
    pub fn edit(&mut self, scene: &Scene, line: usize, edit: AxisEdit) {
        if let Some(axis) = self.form.get_mut(line) {
            axis.edit(scene, edit, 2);
        }
        self.judged = None;
    }

    /// One more line: the first key that is not there.
    pub fn add(&mut self, scene: &Scene) {
        let taken = |key: &str| self.form.iter().any(|axis| axis.key == key);
        let next = scene.parameters().find(|parameter| chooses(scene, parameter) && !taken(parameter.key));
        self.form.extend(next.map(|parameter| AxisForm::around(scene, parameter.key, 2)));
        self.judged = None;
    }

    /// One line less.
    pub fn remove(&mut self, line: usize) {
        if line < self.form.len() {
            self.form.remove(line);
        }
        self.judged = None;
    }

    /// The bounds that the form says.
    ///
    /// # Errors
    /// The first thing that is wrong with it.
    pub fn asked(&self, scene: &Scene) -> Result<Vec<Bounds>, String> {
        if let Some(fault) = self.faults.iter().flatten().chain(&self.goal_fault).next() {
            return Err(fault.clone());
        }
        self.form.iter().map(|axis| bounds(scene, axis)).collect()
    }

    /// `task` searches for `scene`.
    pub fn begin(&mut self, scene: Scene, task: FitTask) {
        self.task = Some((scene, task));
        (self.failure, self.told, self.cancelled) = (None, None, false);
    }

    /// Takes what was told and found since the last time.
    pub fn drain(&mut self) {
        let Some((scene, task)) = &self.task else { return };
        let News { messages, end } = task.drain();
        self.told = messages.into_iter().last().or(self.told);
        let Some(end) = end else { return };
        let scene = scene.clone();
        self.task = None;
        match end {
            Ok(Ok(Some(found))) => self.found = Some((scene, Arc::new(found))),
            Ok(Ok(None)) => {}
            Ok(Err(why)) => self.failure = Some(why),
            Err(panic) => self.failure = Some(format!("it failed: {panic}")),
        }
    }

    /// Asks it to end.
    pub fn cancel(&mut self) {
        if let Some((_, task)) = &self.task {
            task.cancel();
            self.cancelled = true;
        }
    }

    /// Whether a fit goes on.
    pub fn running(&self) -> bool {
        self.task.is_some()
    }

    /// Whether `scene` is another one than was fitted: neither that nor the one that came out.
    pub fn stale(&self, scene: &Scene) -> bool {
        let same = |other: &Scene| other.same_model(scene) && other.numerics() == scene.numerics();
        self.found.as_ref().is_some_and(|(asked, found)| !same(asked) && !same(found.scene()))
    }
}

/// Numbers whose optimum can be sought: name, and words with the unit.
pub fn quantities(scene: &Scene) -> Vec<(&'static str, String)> {
    let Ok(problem) = Problem::try_from(scene) else { return Vec::new() };
    measurable(&problem).into_iter().map(|quantity| (quantity.name(), quantity.label(&problem))).collect()
}

/// What a line of the form says.
fn bounds(scene: &Scene, axis: &AxisForm) -> Result<Bounds, String> {
    let parameter = Parameter::find(axis.key).ok_or_else(|| format!("{} is not known", axis.key))?;
    let (from, to) = (quantity_text::read(parameter, &axis.from)?, quantity_text::read(parameter, &axis.to)?);
    let scale = Some(if axis.log { Scale::Log } else { Scale::Linear });
    let bounds = Bounds { key: axis.key.to_owned(), from, to, scale };
    Unknown::new(scene, &bounds).map_err(|error| error.to_string())?;
    Ok(bounds)
}
