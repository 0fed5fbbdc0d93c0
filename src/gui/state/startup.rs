//! A start-up in the window: its scene, the numbers of every cycle, the recordings that are kept, and the cycle on screen.

use super::transient::Transient;
use crate::export::startup::{CycleRow, place};
use crate::fidelity::Fidelity;
use crate::gui::derived::scales::{Ranges, Scales};
use crate::job::SolvedScene;
use crate::job::task::TaskOf;
use crate::job::transient::StartupWork;
use crate::job::work::Posed;
use crate::recording::Recording;
use crate::scene::Scene;
use crate::solution::{Model, Outcome, Solution, Stats, Status};
use crate::startup::{Cycle, Startup};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Memory that recordings may take \[bytes\], together.
const MOST_BYTES: usize = 64 << 20;
/// Runs with numbers from here on are cycles of a start-up; the solver never uses such numbers.
const FIRST_NUMBER: u64 = 1 << 40;

/// Keeps the `run` of cycle `number`. If all recordings take more than `most` bytes, the first, the newest, and those between that show
/// most of the change are kept.
fn keep(runs: &mut BTreeMap<usize, Arc<SolvedScene>>, number: usize, run: Arc<SolvedScene>, most: usize) {
    runs.insert(number, run);
    while runs.len() > 1 && runs.values().map(|run| bytes(&run.solution.recording)).sum::<usize>() > most {
        let numbers: Vec<usize> = runs.keys().copied().collect();
        // Changes become smaller and smaller with time: the recording whose neighbours are nearest in proportion is removed.
        let ratio = |three: &[usize]| three[2] as f64 / three[0] as f64;
        let least = numbers.windows(3).min_by(|a, b| ratio(a).total_cmp(&ratio(b)));
        runs.remove(&least.map_or(numbers[0], |three| three[1]));
    }
}

/// Memory of a recording's fields \[bytes\].
fn bytes(recording: &Recording) -> usize {
    let Recording { lines, stator, pressure, other_pressure, film_load, .. } = recording;
    let fields = lines.film_thickness.len() + stator.len() + lines.contact.len() + lines.film.len();
    let maps = pressure.len() + other_pressure.len();
    8 * (fields + maps + 5 * film_load.len())
}

/// A start-up, under way or ended.
#[derive(Debug)]
pub struct StartupState {
    /// Its scene, its cycles and its outcome.
    pub transient: Transient<Cycle, Startup>,
    /// Its number in this window.
    pub count: u64,
    /// All cycles, in order.
    pub points: Vec<CycleRow>,
    /// Runs that are kept, by the number of their cycle.
    kept: BTreeMap<usize, Arc<SolvedScene>>,
    /// Ranges of the axes over all cycles so far.
    pub ranges: Option<Ranges>,
    /// Number of the cycle on screen; 0 before the first.
    pub chosen: usize,
    /// Whether the newest cycle is looked at.
    pub follows_newest: bool,
}

impl StartupState {
    /// A start-up of `scene`, number `count` of this window.
    pub fn new(task: TaskOf<StartupWork>, posed: Posed, fidelity: Fidelity, count: u64) -> Self {
        Self {
            transient: Transient::new(task, posed, fidelity),
            count,
            points: Vec::new(),
            kept: BTreeMap::new(),
            ranges: None,
            chosen: 0,
            follows_newest: true,
        }
    }

    /// Takes progress and results since the last call; cancels the task if `scene` differs from the scene that was started.
    pub fn drain(&mut self, scene: &Scene) {
        self.transient.news(scene, Startup::cancelled).into_iter().for_each(|cycle| self.take(cycle));
    }

    fn take(&mut self, cycle: Cycle) {
        let newest = cycle.number > self.points.len();
        place(&mut self.points, cycle.number, CycleRow::of(&self.transient.posed.problem, &cycle));
        place(&mut self.transient.cycles, cycle.number, cycle.slim());
        let Cycle { number, outcome, recording, .. } = cycle;
        let ranges = Scales::new(&recording).ranges;
        self.ranges = Some(self.ranges.map_or(ranges, |known| known.and(ranges)));
        let number_of_run = FIRST_NUMBER * (1 + self.count) + number as u64;
        let run = as_solved(number_of_run, self.transient.posed.clone(), self.transient.fidelity, outcome, recording);
        keep(&mut self.kept, number, Arc::new(run), MOST_BYTES);
        if newest && self.follows_newest || self.chosen == 0 {
            self.chosen = number;
        } else {
            // The cycle on screen may no longer be kept.
            self.choose(self.chosen);
        }
    }

    /// Shows cycle `number`, or the nearest one that is kept, and no longer follows the newest.
    pub fn stay_at(&mut self, number: usize) {
        self.follows_newest = false;
        self.choose(number);
    }

    fn choose(&mut self, number: usize) {
        if let Some(kept) = self.kept().min_by_key(|kept| kept.abs_diff(number)) {
            self.chosen = kept;
        }
    }

    /// Shows the newest cycle from now on, or stays at the present one.
    pub fn follow(&mut self, follow: bool) {
        self.follows_newest = follow;
        if let (true, Some(newest)) = (follow, self.kept().last()) {
            self.chosen = newest;
        }
    }

    /// The cycle on screen has been shown to its end: goes on to the next one that is kept, if there is one.
    pub fn next_cycle(&mut self) {
        if let Some((next, _)) = self.kept.range(self.chosen + 1..).next() {
            self.chosen = *next;
        }
    }

    /// Cycles whose recordings are kept, ascending.
    pub fn kept(&self) -> impl DoubleEndedIterator<Item = usize> {
        self.kept.keys().copied()
    }

    /// The cycle looked at.
    pub fn run(&self) -> Option<&Arc<SolvedScene>> {
        self.kept.get(&self.chosen)
    }
}

/// A cycle in the form that the views draw: as a solve.
fn as_solved(number: u64, posed: Posed, fidelity: Fidelity, outcome: Outcome, recording: Recording) -> SolvedScene {
    let solution = Arc::new(Solution {
        status: Status::Converged,
        outcome,
        performance: None,
        harmonic: None,
        stats: Stats::default(),
        accuracy: Default::default(),
        model: Model::default(),
        warnings: Vec::new(),
        recording,
    });
    let Posed { scene, problem } = posed;
    let (validity, history) = (Vec::new(), Vec::new());
    SolvedScene { number, scene, problem, fidelity, solution, validity, wall_s: 0.0, history }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_bounded_and_holds_first_newest_and_the_early_way() {
        let posed = Posed::try_from(Scene::plate()).unwrap();
        let run = |values: usize| {
            let recording = Recording { pressure: vec![0.0; values], ..Recording::default() };
            let outcome = Outcome::Plate(Default::default());
            Arc::new(as_solved(0, posed.clone(), Fidelity::Draft, outcome, recording))
        };
        let mut kept = BTreeMap::new();
        for number in 1..=100 {
            keep(&mut kept, number, run(100), 8000);
            assert!(kept.len() <= 10, "100 values of 8 bytes each");
        }
        let numbers: Vec<usize> = kept.keys().copied().collect();
        assert_eq!(numbers.len(), 10);
        assert!(numbers.starts_with(&[1, 2, 3]) && numbers.ends_with(&[100]), "{numbers:?}");
        // A recording that is too large by itself is kept, because it is the newest.
        keep(&mut kept, 101, run(5000), 8000);
        assert_eq!(kept.keys().copied().collect::<Vec<_>>(), [101]);
    }
}
