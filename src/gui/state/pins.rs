//! The pinned runs, for comparison: their names, their colours, and the numbers of all of them. The scenes of the pins are kept for the
//! next window, which solves them again.

use crate::analysis::compare::{ComparedRun, LONGEST_LABEL, ParameterRow, ResultRow, parameters, results, unique};
use crate::digits::rounded;
use crate::fidelity::Fidelity;
use crate::gui::derived::scales::RunCurves;
use crate::job::single::PinWork;
use crate::job::task::TaskOf;
use crate::scene::{Scene, Value, show_up_to};
use serde::{Deserialize, Serialize};

/// A page of the comparison of pins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Page {
    /// Their fields, in motion.
    #[default]
    Fields,
    /// Their parameters and results.
    Numbers,
}

/// A pinned run; its solution is in [`Pins::runs`].
#[derive(Debug)]
pub struct Pin {
    /// Identifier, never used for another pin.
    pub id: u64,
    /// Index of its colour and dashes.
    pub slot: usize,
    /// Scales and curves of its cycle.
    pub curves: RunCurves,
}

/// A pin that is being solved or waits to be solved: a preset, or a pin of the last window.
#[derive(Debug)]
pub struct Waiting {
    /// Identifier, kept by the pin.
    pub id: u64,
    /// Its name.
    pub name: String,
    scene: Scene,
    fidelity: Fidelity,
    /// Index of the colour that it had before; `None` for a new pin.
    slot: Option<usize>,
    /// The solve; `None` while the pin waits.
    task: Option<TaskOf<PinWork>>,
}

/// A pin as it is kept for the next window.
#[derive(Debug, Serialize, Deserialize)]
struct Stored {
    label: String,
    slot: Option<usize>,
    fidelity: String,
    /// The scene as a preset file.
    scene: String,
}

impl Stored {
    fn read(&self) -> Result<(Scene, Fidelity), String> {
        let fidelity = self.fidelity.parse()?;
        let scene = Scene::from_toml(&self.scene, &self.label).map_err(|error| error.to_string())?;
        Ok((scene, fidelity))
    }
}

/// Outcome of a request, to be shown to the user.
#[derive(Debug)]
pub enum Note {
    /// A remark; nothing failed.
    Remark(String),
    /// It could not be done.
    Failure(String),
}

/// All pins; differences are relative to the first.
#[derive(Debug, Default)]
pub struct Pins {
    /// The pins, in the order of `runs`.
    pub pins: Vec<Pin>,
    /// The pinned runs.
    pub runs: Vec<ComparedRun>,
    /// Their numbers, computed when the pins change.
    pub results: Vec<ResultRow>,
    /// Their parameters.
    pub parameters: Vec<ParameterRow>,
    /// Pins that are being solved, or wait to be solved.
    pub waiting: Vec<Waiting>,
    next: u64,
    /// The page that is shown.
    pub page: Page,
    /// Whether parameters that do not differ are listed, too.
    pub all_parameters: bool,
    /// Outcome of the last request, if it would not be visible otherwise.
    pub note: Option<Note>,
    /// The pins that were removed last, one or all, kept until there is a new pin.
    removed: Option<Box<Self>>,
}

impl Pins {
    /// A pin by its number.
    pub fn run(&self, id: u64) -> Option<&ComparedRun> {
        Some(&self.runs[self.place(id)?])
    }

    fn place(&self, id: u64) -> Option<usize> {
        self.pins.iter().position(|pin| pin.id == id)
    }

    fn number(&mut self) -> u64 {
        self.removed = None;
        self.next += 1;
        self.next
    }

    /// Pins `run`, unless the same run is pinned already.
    pub fn add(&mut self, run: ComparedRun) {
        let id = self.number();
        self.insert(id, None, run);
    }

    /// Pins `run` under its number, in the order of the numbers. `stored` is its earlier name and colour.
    fn insert(&mut self, id: u64, stored: Option<(String, usize)>, mut run: ComparedRun) {
        let twin = self.runs.iter().find(|other| other.scene == run.scene && fidelity(other) == fidelity(&run));
        if let Some(twin) = twin {
            self.note = Some(Note::Remark(format!("Not pinned twice: “{}” is the same run", twin.label)));
            return;
        }
        self.note = run.solved.as_ref().err().map(|reason| Note::Failure(format!("{}: {reason}", run.label)));
        if run.solved.is_err() {
            return;
        }
        let all = [Some(&*self), self.removed.as_deref()];
        let taken = |slot: usize| {
            all.iter().flatten().any(|of| {
                of.pins.iter().any(|pin| pin.slot == slot) || of.waiting.iter().any(|other| other.slot == Some(slot))
            })
        };
        let slot = match stored {
            Some((label, slot)) => {
                run.label = unique(&label, |label| self.runs.iter().any(|other| other.label == label));
                slot
            }
            None => {
                run.label = self.name_of(&run);
                (0..).find(|slot| !taken(*slot)).unwrap_or_default()
            }
        };
        let place = self.pins.partition_point(|pin| pin.id < id);
        self.pins.insert(place, Pin { id, slot, curves: RunCurves::new(&run) });
        self.runs.insert(place, run);
        self.tabulate();
    }

    /// A unique name for `run`: that of its scene, with the keys that differ from a pin of the same name.
    fn name_of(&self, run: &ComparedRun) -> String {
        let name = &run.scene.name;
        let taken = |label: &str| self.runs.iter().any(|other| other.label == label);
        let namesake = self.runs.iter().find(|other| other.scene.name == *name);
        let named = namesake.filter(|_| taken(name)).and_then(|other| {
            let same = run.scene.changed(&other.scene).next().is_none();
            if same { Some(format!("{name}, {}", fidelity(run))) } else { told_apart(&run.scene, &other.scene) }
        });
        unique(&named.unwrap_or_else(|| run.label.clone()), taken)
    }

    /// Adds a pin that waits for `task`, which solves this scene.
    pub fn wait(&mut self, scene: Scene, fidelity: Fidelity, task: TaskOf<PinWork>) {
        let id = self.number();
        self.note = None;
        let name = scene.name.clone();
        self.waiting.push(Waiting { id, name, scene, fidelity, slot: None, task: Some(task) });
    }

    /// All pins as text, also those that are still to be solved.
    pub fn stored(&self) -> String {
        let pinned = self.pins.iter().zip(&self.runs).map(|(pin, run)| {
            let (label, scene) = (run.label.clone(), run.scene.to_toml());
            (pin.id, Stored { label, slot: Some(pin.slot), fidelity: fidelity(run).to_owned(), scene })
        });
        let waiting = self.waiting.iter().map(|waiting| {
            let (label, scene) = (waiting.name.clone(), waiting.scene.to_toml());
            (waiting.id, Stored { label, slot: waiting.slot, fidelity: waiting.fidelity.to_string(), scene })
        });
        let mut all: Vec<(u64, Stored)> = pinned.chain(waiting).collect();
        all.sort_by_key(|(id, _)| *id);
        let all: Vec<Stored> = all.into_iter().map(|(_, stored)| stored).collect();
        serde_json::to_string(&all).unwrap_or_default()
    }

    /// Restores the pins of [`Self::stored`], which wait until they are solved. Pins that cannot be read are left out and reported.
    ///
    /// # Errors
    /// The faults of the pins that could not be read.
    pub fn restore(&mut self, text: &str) -> Result<(), String> {
        let stored: Vec<Stored> = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let mut faults = Vec::new();
        for stored in stored {
            match stored.read() {
                Ok((scene, fidelity)) => {
                    let (id, name, slot) = (self.number(), stored.label, stored.slot);
                    self.waiting.push(Waiting { id, name, scene, fidelity, slot, task: None });
                }
                Err(fault) => faults.push(fault),
            }
        }
        if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
    }

    /// The next pin to be solved, if no other is being solved.
    pub fn turn(&self) -> Option<(u64, &Scene, Fidelity)> {
        if self.waiting.iter().any(|waiting| waiting.task.is_some()) {
            return None;
        }
        self.waiting.first().map(|waiting| (waiting.id, &waiting.scene, waiting.fidelity))
    }

    /// Starts to track `task`, which solves this pin.
    pub fn begin(&mut self, id: u64, task: TaskOf<PinWork>) {
        if let Some(waiting) = self.waiting.iter_mut().find(|waiting| waiting.id == id) {
            waiting.task = Some(task);
        }
    }

    /// Takes solves that have ended since the last call.
    pub fn drain(&mut self) {
        let mut solved = Vec::new();
        let mut failed = None;
        self.waiting.retain_mut(|waiting| {
            let Some(task) = &waiting.task else { return true };
            let Some(end) = task.drain().end else { return true };
            let stored = waiting.slot.map(|slot| (waiting.name.clone(), slot));
            match end {
                Ok(Some(run)) => solved.push((waiting.id, stored, run)),
                Ok(None) => failed = Some(Note::Failure(format!("{} could not be solved", waiting.name))),
                Err(why) => failed = Some(Note::Failure(format!("{} could not be solved: {why}", waiting.name))),
            }
            false
        });
        self.note = failed.or(self.note.take());
        for (id, stored, run) in solved {
            self.insert(id, stored, run);
        }
    }

    /// Renames a pin; if another pin has that name, a number is added.
    pub fn rename(&mut self, id: u64, name: &str) {
        if let Some(i) = self.place(id) {
            let label = unique(name, |label| self.runs.iter().enumerate().any(|(j, run)| j != i && run.label == label));
            self.runs[i].label = label;
        }
    }

    /// Removes a pin, or cancels its solve. [`Self::bring_back`] undoes it.
    pub fn remove(&mut self, id: u64) {
        self.take(|pin| pin == id);
    }

    /// Removes all pins, also those being solved; [`Self::bring_back`] undoes it.
    pub fn clear(&mut self) {
        self.take(|_| true);
    }

    /// Removes the pins whose number fulfils `goes`.
    fn take(&mut self, goes: impl Fn(u64) -> bool) {
        let mut removed = Self::default();
        for (pin, run) in std::mem::take(&mut self.pins).into_iter().zip(std::mem::take(&mut self.runs)) {
            let to = if goes(pin.id) { &mut removed } else { &mut *self };
            to.pins.push(pin);
            to.runs.push(run);
        }
        for mut waiting in std::mem::take(&mut self.waiting) {
            if goes(waiting.id) {
                waiting.task = None;
                removed.waiting.push(waiting);
            } else {
                self.waiting.push(waiting);
            }
        }
        if removed.pins.len() + removed.waiting.len() > 0 {
            self.removed = Some(Box::new(removed));
            self.note = None;
            self.tabulate();
        }
    }

    /// How many removed pins can be brought back.
    pub fn removed(&self) -> usize {
        self.removed.as_ref().map_or(0, |removed| removed.pins.len() + removed.waiting.len())
    }

    /// Restores the pins that were removed last, in their places; those that were being solved wait again.
    pub fn bring_back(&mut self) {
        let Some(removed) = self.removed.take() else { return };
        let Self { pins, runs, waiting, .. } = *removed;
        for (pin, run) in pins.into_iter().zip(runs) {
            self.insert(pin.id, Some((run.label.clone(), pin.slot)), run);
        }
        self.waiting.extend(waiting);
        self.waiting.sort_by_key(|waiting| waiting.id);
    }

    fn tabulate(&mut self) {
        self.results = results(&self.runs);
        self.parameters = parameters(&self.runs.iter().map(|run| &run.scene).collect::<Vec<&Scene>>());
    }
}

/// The fidelity that a run was solved at, in a word.
pub fn fidelity(run: &ComparedRun) -> &str {
    run.solved.as_ref().map_or("", |solution| &solution.model.fidelity)
}

/// Digits of values in the name of a pin.
const DIGITS: usize = 6;
/// Least number of characters that the name of a scene is cut to.
const SHORTEST_NAME: usize = 16;

/// The name of a scene with the one or two keys that distinguish it from another. A key that the scene does not have is left out. If the
/// text is too long, the name is cut.
pub fn told_apart(scene: &Scene, other: &Scene) -> Option<String> {
    let rows = parameters(&[other, scene]);
    let differing = rows.iter().filter(|row| row.differs()).filter_map(|row| {
        let value = row.values[1].clone()?;
        let value = value.as_number().map_or(value, |number| Value::Number(rounded(number, DIGITS)));
        Some(format!("{} {value} {}", row.parameter.words(), scene.unit(row.parameter)).trim_end().to_owned())
    });
    let differing: Vec<String> = differing.collect();
    (1..=2).contains(&differing.len()).then(|| {
        let differing = differing.join(", ");
        // Without the comma, the space and the "…".
        let room = LONGEST_LABEL.saturating_sub(differing.chars().count() + 3).max(SHORTEST_NAME);
        format!("{}, {differing}", show_up_to(room, &scene.name))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::compare::runs;
    use crate::control::Cancel;
    use crate::fidelity::Fidelity;
    use crate::scene::presets;
    use crate::solve::Settings;

    fn solved(preset: &str, set: &[(&str, &str)], fidelity: Fidelity) -> ComparedRun {
        let mut scene = presets::find(preset).unwrap();
        scene.set_all(set.iter().copied()).unwrap();
        let settings = Settings { fidelity, ..Settings::default() };
        runs(&[scene], &settings, &Cancel::new(), &|_| ()).unwrap().remove(0)
    }

    #[test]
    fn pins_are_told_apart_by_what_differs() {
        let mut pins = Pins::default();
        let plate = |set: &[(&str, &str)], fidelity| solved("plate-crossover", set, fidelity);
        pins.add(plate(&[], Fidelity::Draft));
        pins.add(plate(&[("plate.frequency_khz", "12")], Fidelity::Draft));
        pins.add(plate(&[], Fidelity::Standard));
        pins.add(plate(&[], Fidelity::Draft));
        let name = &presets::find("plate-crossover").unwrap().name;
        let labels: Vec<&str> = pins.runs.iter().map(|run| run.label.as_str()).collect();
        assert_eq!(labels, [name.as_str(), &format!("{name}, frequency 12 kHz"), &format!("{name}, standard")]);
        assert!(matches!(&pins.note, Some(Note::Remark(text)) if text.contains("same run")));
    }

    #[test]
    fn what_a_scene_does_not_have_is_not_in_its_name() {
        let given = presets::find("plate-crossover").unwrap();
        let floating = given.with([("plate.mean_gap_um", "none"), ("plate.load_n", "1")]).unwrap();
        let name = told_apart(&floating, &given).unwrap();
        assert!(name.ends_with(" 1 N/m") && !name.contains("none") && !name.contains("gap"), "{name}");
    }

    #[test]
    fn names_keep_the_units_of_what_differs() {
        let given = presets::find("fundamental").unwrap();
        let mut changed = given.with([("film.min_spacing_nm", "100"), ("stator.frequency_khz", "45")]).unwrap();
        let named = |scene: &Scene| unique(&told_apart(scene, &given).unwrap(), |_| false);
        let name = named(&changed);
        assert!(name.starts_with("Fundamental case, ") && !name.contains('…'), "{name}");
        assert!(name.contains("minimum spacing H_m 100 nm") && name.contains("frequency 45 kHz"), "{name}");
        changed.set("name", &"long name ".repeat(12)).unwrap();
        let cut = named(&changed);
        assert!(cut.starts_with("long name ") && cut.contains("…, "), "{cut}");
        assert!(cut.contains("minimum spacing H_m 100 nm") && cut.contains("frequency 45 kHz"), "{cut}");
    }

    #[test]
    fn a_colour_is_used_again_and_names_stay_unique() {
        let mut pins = Pins::default();
        for spacing in ["2", "3", "4"] {
            pins.add(solved("plate-crossover", &[("plate.frequency_khz", spacing)], Fidelity::Draft));
        }
        let second = pins.pins[1].id;
        pins.remove(second);
        pins.add(solved("plate-viscous", &[], Fidelity::Draft));
        let slots: Vec<usize> = pins.pins.iter().map(|pin| pin.slot).collect();
        assert_eq!(slots, [0, 2, 1]);
        let last = pins.pins[2].id;
        assert!(last > second);
        assert_eq!(pins.removed(), 0);
        pins.rename(last, "one");
        let first = pins.pins[0].id;
        pins.rename(first, "one");
        assert_eq!(pins.run(first).unwrap().label, "one (2)");
        pins.rename(first, " one (2)  ");
        assert_eq!(pins.run(first).unwrap().label, "one (2)");
        assert_eq!(pins.results[0].cells.len(), 3);
        pins.clear();
        assert!(pins.runs.is_empty() && pins.results.is_empty());
        // All come back, until there is another one.
        assert_eq!(pins.removed(), 3);
        pins.bring_back();
        assert_eq!((pins.runs.len(), pins.results[0].cells.len(), pins.removed()), (3, 3, 0));
        // One comes back to its place, with its name and its colour.
        let told = |pins: &Pins| -> Vec<(u64, usize, String)> {
            pins.pins.iter().zip(&pins.runs).map(|(pin, run)| (pin.id, pin.slot, run.label.clone())).collect()
        };
        let before = told(&pins);
        let middle = pins.pins[1].id;
        pins.remove(middle);
        assert_eq!((pins.runs.len(), pins.results[0].cells.len(), pins.removed()), (2, 2, 1));
        // What is not there cannot be removed.
        pins.remove(middle);
        pins.bring_back();
        assert_eq!((told(&pins), pins.results[0].cells.len()), (before, 3));
        pins.clear();
        pins.add(solved("plate-viscous", &[], Fidelity::Draft));
        assert_eq!(pins.removed(), 0);
    }
}
