//! Error against solve time of one scene, measured: what each fidelity, a family of grids and the paper's method cost
//! here and now, and which is the cheapest that serves.
//!
//! The clock is the caller's. Runs are interleaved, every setting once and then again, so that a machine that is busy for
//! a while favours none. What is judged is one number, α of a motor and the mean film load of a plate; errors are shares
//! of it. The measured error of a setting is its distance from the most accurate setting plus that one's own stated
//! error: a bound, for this scene. A coarse grid may be right by luck, though, and wrong in the scene beside it. Settings are
//! therefore judged by the greater of the measured error and the one that the run states of itself.

use super::attempt::attempt;
use super::quantity::{Numbers, Quantity};
use crate::control::{Cancel, Progress};
use crate::fidelity::Fidelity;
use crate::problem::{Numerics, Problem, Scenario};
use crate::solution::Status;
use crate::solve::{Method, Settings};

/// Most repeats of one setting, if they are chosen by time.
const MOST_REPEATS: usize = 31;
/// Grids beside the fidelities: what each starts from, film nodes along and across, steps in a cycle.
const GRIDS: [(Fidelity, usize, usize, usize); 6] = [
    (Fidelity::Draft, 9, 5, 36),
    (Fidelity::Draft, 25, 17, 72),
    (Fidelity::Standard, 17, 9, 108),
    (Fidelity::Standard, 33, 25, 216),
    (Fidelity::Fine, 33, 17, 180),
    (Fidelity::Fine, 65, 33, 180),
];
/// Meshes of the paper's method: film nodes along and across, contact nodes; the paper's, half and twice as fine.
const PAPER_MESHES: [(&str, usize, usize, usize); 3] =
    [("paper, half its mesh", 26, 6, 91), ("paper", 51, 11, 181), ("paper, twice its mesh", 101, 21, 361)];

/// Where a setting comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// One of the fidelities.
    Fidelity,
    /// A grid of its own.
    Grid,
    /// The paper's method.
    Paper,
}

/// One way to solve the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Its name.
    pub name: String,
    /// Where it comes from.
    pub family: Family,
    /// Fidelity and method.
    pub settings: Settings,
    /// Explicit numerics; they replace the scene's.
    pub numerics: Numerics,
}

impl Candidate {
    /// The options of the command line that choose it.
    pub fn options(&self) -> String {
        let mut options = match self.settings.method {
            Method::Auto => self.settings.fidelity.option(),
            Method::Paper => "--method paper".to_owned(),
        };
        let Numerics { film_nodes_along, film_nodes_across, contact_nodes, steps_per_cycle, .. } = self.numerics;
        for (key, value) in [
            ("film_nodes_along", film_nodes_along),
            ("film_nodes_across", film_nodes_across),
            ("contact_nodes", contact_nodes),
            ("steps_per_cycle", steps_per_cycle),
        ] {
            if let Some(value) = value {
                options.push_str(&format!(" --set numerics.{key}={value}"));
            }
        }
        options
    }
}

/// What is worth measuring for a scene: every fidelity, some grids, the preset's own if it has one, and for a motor the
/// paper's method on three meshes.
pub fn candidates(problem: &Problem) -> Vec<Candidate> {
    let auto = |fidelity| Settings { fidelity, ..Settings::default() };
    let mut all = Vec::new();
    for fidelity in Fidelity::ALL {
        all.push(Candidate {
            name: fidelity.name().to_owned(),
            family: Family::Fidelity,
            settings: auto(fidelity),
            numerics: Numerics::default(),
        });
    }
    for (fidelity, along, across, steps) in GRIDS {
        all.push(Candidate {
            name: format!("{fidelity}, {along} × {across} × {steps}"),
            family: Family::Grid,
            settings: auto(fidelity),
            numerics: Numerics {
                film_nodes_along: Some(along),
                film_nodes_across: Some(across),
                steps_per_cycle: Some(steps),
                ..Numerics::default()
            },
        });
    }
    if problem.numerics != Numerics::default() {
        let settings = Settings::default();
        let name = "the preset's own grid".to_owned();
        all.push(Candidate { name, family: Family::Grid, settings, numerics: problem.numerics });
    }
    if matches!(problem.scenario, Scenario::Motor(_)) {
        for (name, along, across, contact) in PAPER_MESHES {
            all.push(Candidate {
                name: name.to_owned(),
                family: Family::Paper,
                settings: Settings { method: Method::Paper, ..Settings::default() },
                numerics: Numerics {
                    film_nodes_along: Some(along),
                    film_nodes_across: Some(across),
                    contact_nodes: Some(contact),
                    ..Numerics::default()
                },
            });
        }
    }
    all
}

/// How much to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Runs of every setting; `None`: as many as fit into `seconds`, at least one and at most 31.
    pub repeats: Option<usize>,
    /// Time for all runs together, shared equally \[s\]; one run of each takes as long as it takes.
    pub seconds: f64,
    /// A run that takes longer is given up \[s\].
    pub longest: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { repeats: None, seconds: 40.0, longest: 30.0 }
    }
}

/// How the runs of a setting ended: they are all alike but for the time they took.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ended {
    /// Not measured yet.
    Waiting,
    /// The cycle repeats to the tolerance.
    Converged,
    /// A limit was reached first.
    NotConverged,
    /// It took longer than [`Effort::longest`].
    GivenUp,
    /// There is no solution, and why.
    Failed(String),
}

/// One setting and what was measured of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The setting.
    pub candidate: Candidate,
    /// How it ended.
    pub ended: Ended,
    /// The numbers; none unless it converged or reached its limit.
    pub numbers: Numbers,
    /// Nodes of one tooth's film (or of the plate's), and steps in a cycle, of the finest grid.
    pub grid: (usize, usize),
    /// Time of each run \[s\].
    pub times: Vec<f64>,
}

/// Measures `candidates` on `problem`, one run at a time on the caller's thread. `clock` gives seconds from any start.
/// `told` hears after every run: all runs so far, and the share of the work that is done, 0 to 1; [`Tradeoff::of`]
/// makes the present state of them. If it is cancelled, the runs are what was measured.
pub fn measure(
    problem: &Problem,
    candidates: Vec<Candidate>,
    effort: &Effort,
    clock: &dyn Fn() -> f64,
    cancel: &Cancel,
    told: &mut dyn FnMut(&[Run], f64),
) -> Vec<Run> {
    let count = candidates.len();
    let blank = |candidate| Run {
        candidate,
        ended: Ended::Waiting,
        numbers: Numbers::default(),
        grid: (0, 0),
        times: Vec::new(),
    };
    let mut runs: Vec<Run> = candidates.into_iter().map(blank).collect();
    let mut round = 0;
    loop {
        let mut idle = true;
        for i in 0..count {
            if runs[i].times.len() != round || round >= wanted(&runs[i], effort, count) {
                continue;
            }
            idle = false;
            if !run_once(problem, &mut runs[i], effort, clock, cancel) {
                return runs;
            }
            let share = done(&runs, effort);
            told(&runs, share);
        }
        if idle {
            return runs;
        }
        round += 1;
    }
}

/// How often a setting is to be run.
fn wanted(run: &Run, effort: &Effort, count: usize) -> usize {
    let Some(first) = run.times.first() else { return 1 };
    if matches!(run.ended, Ended::Failed(_) | Ended::GivenUp) {
        return 1;
    }
    let affordable = || (effort.seconds / count as f64 / first.max(1e-9)) as usize;
    effort.repeats.unwrap_or_else(|| affordable().min(MOST_REPEATS)).max(1)
}

/// The share of the work that is done: in time, with the first runs to come taken to cost as much as those there are.
fn done(runs: &[Run], effort: &Effort) -> f64 {
    let (mut spent, mut left, mut waiting) = (0.0, 0.0, 0.0);
    for run in runs {
        match run.times.first() {
            Some(first) => {
                spent += run.times.iter().sum::<f64>();
                left += first * (wanted(run, effort, runs.len()) - run.times.len()) as f64;
            }
            None => waiting += 1.0,
        }
    }
    let each = (spent + left) / (runs.len() as f64 - waiting).max(1.0);
    spent / (spent + left + waiting * each).max(f64::MIN_POSITIVE)
}

/// One run; false if it was cancelled.
fn run_once(problem: &Problem, run: &mut Run, effort: &Effort, clock: &dyn Fn() -> f64, cancel: &Cancel) -> bool {
    let problem = Problem { numerics: run.candidate.numerics, ..problem.clone() };
    let stop = cancel.child();
    let started = clock();
    let mut watch = |_: &Progress| {
        if clock() - started > effort.longest {
            stop.cancel();
        }
    };
    let solved = attempt(&problem, &run.candidate.settings, &mut watch, &stop);
    let time = clock() - started;
    if cancel.is_cancelled() {
        return false;
    }
    run.times.push(time);
    match solved {
        Ok(solution) => {
            run.ended = match solution.status {
                Status::Converged => Ended::Converged,
                Status::NotConverged { .. } | Status::NotResolved { .. } => Ended::NotConverged,
                Status::Cancelled => Ended::GivenUp,
            };
            if run.ended != Ended::GivenUp {
                run.numbers = Numbers::of(&problem, &solution);
            }
            run.grid = (solution.stats.film_nodes, solution.stats.steps_per_cycle);
        }
        Err(reason) => run.ended = Ended::Failed(reason),
    }
    true
}

/// A setting on the curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What was measured.
    pub run: Run,
    /// Median time \[s\]; NaN before the first run.
    pub median: f64,
    /// Lower and upper quartile of the time \[s\].
    pub quartiles: (f64, f64),
    /// Its distance from the reference plus the reference's own error, a share of the value that is judged; `None` unless
    /// it converged and there is a reference.
    pub measured: Option<f64>,
    /// The error it states of itself, a share of the value that is judged.
    pub stated: Option<f64>,
    /// The greater of the two, by which it is judged.
    pub error: Option<f64>,
    /// No other is at once as fast and as accurate.
    pub best: bool,
}

/// What a user asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wish {
    /// An error of at most this share of the value that is judged.
    Accuracy(f64),
    /// A time of at most this \[s\].
    Budget(f64),
}

/// Error against time.
#[derive(Clone, Debug, PartialEq)]
pub struct Tradeoff {
    /// All settings, in the order they were measured.
    pub points: Vec<Point>,
    /// Which of them the others are judged by: the one that states the least error.
    pub reference: Option<usize>,
    /// The number that is judged: α, or a plate's film load.
    pub judged: Quantity,
}

impl Tradeoff {
    /// The curve of these runs, finished or not.
    pub fn of(runs: &[Run]) -> Self {
        let plate = runs.iter().any(|run| run.numbers.get(Quantity::LoadRatio).is_some());
        let judged = if plate { Quantity::FilmLoad } else { Quantity::Alpha };
        let value = |run: &Run| (run.ended == Ended::Converged).then(|| run.numbers.get(judged)).flatten();
        let stated = |run: &Run| run.numbers.get(judged.error()?);
        let reference = runs
            .iter()
            .enumerate()
            .filter(|(_, run)| run.candidate.settings.method == Method::Auto && value(run).is_some())
            .filter_map(|(i, run)| Some((i, stated(run)?)))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let truth = reference.and_then(|(i, error)| Some((value(&runs[i])?, error)));
        let scale = truth.map(|(truth, _)| truth.abs().max(f64::MIN_POSITIVE));
        let mut points: Vec<Point> = runs
            .iter()
            .enumerate()
            .map(|(i, run)| {
                let mut times = run.times.clone();
                times.sort_by(f64::total_cmp);
                let measured = truth.zip(value(run)).map(|((truth, error), value)| {
                    let distance =
                        if reference.is_some_and(|(best, _)| best == i) { 0.0 } else { (value - truth).abs() };
                    (distance + error) / scale.unwrap_or(1.0)
                });
                let stated = stated(run).zip(scale).map(|(stated, scale)| stated / scale);
                Point {
                    run: run.clone(),
                    median: quantile(&times, 0.5),
                    quartiles: (quantile(&times, 0.25), quantile(&times, 0.75)),
                    measured,
                    stated,
                    error: measured.zip(stated).map(|(measured, stated)| measured.max(stated)),
                    best: false,
                }
            })
            .collect();
        let costs: Vec<Option<(f64, f64)>> = points.iter().map(|point| Some((point.median, point.error?))).collect();
        for (point, best) in points.iter_mut().zip(front(&costs)) {
            point.best = best;
        }
        Self { points, reference: reference.map(|(i, _)| i), judged }
    }

    /// The cheapest setting that meets an accuracy, or the most accurate that keeps a budget; `None` if none does.
    pub fn choose(&self, wish: Wish) -> Option<usize> {
        let known = self.points.iter().enumerate().filter_map(|(i, point)| Some((i, point.median, point.error?)));
        let (time, error) = (|a: &(usize, f64, f64)| a.1, |a: &(usize, f64, f64)| a.2);
        match wish {
            Wish::Accuracy(allowed) => {
                known.filter(|point| error(point) <= allowed).min_by(|a, b| time(a).total_cmp(&time(b)))
            }
            Wish::Budget(allowed) => {
                known.filter(|point| time(point) <= allowed).min_by(|a, b| error(a).total_cmp(&error(b)))
            }
        }
        .map(|(i, _, _)| i)
    }
}

/// Which of these (time, error) are such that no other is at least as good in both and better in one. What is not known
/// is not among them.
fn front(costs: &[Option<(f64, f64)>]) -> Vec<bool> {
    let beaten = |(time, error): (f64, f64)| {
        costs.iter().flatten().any(|(t, e)| *t <= time && *e <= error && (*t < time || *e < error))
    };
    costs.iter().map(|cost| cost.is_some_and(|cost| !beaten(cost))).collect()
}

/// Of ascending values, linear between them; NaN of none.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * sorted.len().saturating_sub(1) as f64;
    let (low, high) = (place.floor() as usize, place.ceil() as usize);
    match (sorted.get(low), sorted.get(high)) {
        (Some(a), Some(b)) => a + (b - a) * (place - place.floor()),
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;
    use std::cell::Cell;

    fn run(name: &str, method: Method, alpha: f64, stated: f64, times: &[f64]) -> Run {
        let mut numbers = Numbers::default();
        numbers.set(Quantity::Alpha, alpha);
        numbers.set(Quantity::AlphaError, stated);
        let settings = Settings { method, ..Settings::default() };
        let candidate =
            Candidate { name: name.to_owned(), family: Family::Grid, settings, numerics: Numerics::default() };
        Run { candidate, ended: Ended::Converged, numbers, grid: (1, 1), times: times.to_vec() }
    }

    fn synthetic() -> Vec<Run> {
        let mut limit = run("limit", Method::Auto, 0.5, 1e-9, &[1e-9]);
        limit.ended = Ended::NotConverged;
        vec![
            run("lucky", Method::Auto, 0.5001, 0.2, &[0.0015]),
            run("fast", Method::Auto, 0.51, 0.002, &[0.003, 0.001, 0.002, 0.002]),
            run("slower and worse", Method::Auto, 0.55, 0.1, &[0.01]),
            run("middle", Method::Auto, 0.5005, 0.01, &[0.02, 0.01, 0.03, 0.04]),
            run("exact", Method::Auto, 0.5, 0.0001, &[1.0]),
            run("paper", Method::Paper, 0.49, 1e-12, &[2.0]),
            limit,
        ]
    }

    #[test]
    fn errors_times_and_the_front_of_synthetic_runs() {
        let tradeoff = Tradeoff::of(&synthetic());
        assert_eq!(tradeoff.reference, Some(4));
        let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
        let errors: Vec<f64> = tradeoff.points.iter().filter_map(|point| point.measured).collect();
        for (error, expected) in errors.iter().zip([0.0004, 0.0202, 0.1002, 0.0012, 0.0002, 0.0202]) {
            assert!(near(*error, expected), "{errors:?}");
        }
        let best: Vec<bool> = tradeoff.points.iter().map(|point| point.best).collect();
        assert_eq!(best, [true, true, false, true, true, false, false]);
        let middle = &tradeoff.points[3];
        assert!(near(middle.median, 0.025) && near(middle.quartiles.0, 0.0175) && near(middle.quartiles.1, 0.0325));
        assert!(near(middle.stated.unwrap(), 0.02) && near(middle.error.unwrap(), 0.02));
    }

    #[test]
    fn the_cheapest_that_serves_is_chosen() {
        let tradeoff = Tradeoff::of(&synthetic());
        let name = |wish| tradeoff.choose(wish).map(|i| tradeoff.points[i].run.candidate.name.clone());
        for (wish, chosen) in [
            (Wish::Accuracy(0.5), Some("lucky")),
            (Wish::Accuracy(0.1), Some("fast")),
            (Wish::Accuracy(0.0201), Some("middle")),
            (Wish::Accuracy(0.0002), Some("exact")),
            (Wish::Accuracy(0.0001), None),
            (Wish::Budget(0.0001), None),
            (Wish::Budget(0.016), Some("fast")),
            (Wish::Budget(0.5), Some("middle")),
            (Wish::Budget(60.0), Some("exact")),
        ] {
            assert_eq!(name(wish).as_deref(), chosen, "{wish:?}");
        }
        assert_eq!(Tradeoff::of(&[]).choose(Wish::Budget(1.0)), None);
    }

    #[test]
    fn runs_are_interleaved_and_counted_by_the_callers_clock() {
        let problem = Problem::new(&presets::find("plate-crossover").unwrap()).unwrap();
        let two: Vec<Candidate> =
            candidates(&problem).into_iter().filter(|c| c.numerics == Numerics::default()).take(2).collect();
        // A clock that goes on by a second whenever it is looked at, and each run looks at it in every round.
        let now = Cell::new(0.0);
        let clock = || {
            now.set(now.get() + 1.0);
            now.get()
        };
        let (mut order, mut shares) = (Vec::new(), Vec::new());
        let effort = Effort { repeats: Some(3), seconds: 1.0, longest: 1e9 };
        let runs = measure(&problem, two.clone(), &effort, &clock, &Cancel::new(), &mut |runs, share| {
            order.push(runs.iter().map(|run| run.times.len()).collect::<Vec<_>>());
            shares.push(share);
        });
        assert_eq!(order, [[1, 0], [1, 1], [2, 1], [2, 2], [3, 2], [3, 3]]);
        assert!(runs.iter().all(|run| run.ended == Ended::Converged && run.times.iter().all(|t| *t == run.times[0])));
        assert!(shares.windows(2).all(|pair| pair[0] < pair[1]) && (shares[5] - 1.0).abs() < 1e-12, "{shares:?}");
        let tradeoff = Tradeoff::of(&runs);
        assert_eq!((tradeoff.judged, tradeoff.reference), (Quantity::FilmLoad, Some(1)));

        // Given up by the clock; and cancelled, with what there was.
        let short = Effort { longest: 2.0, ..effort };
        let runs = measure(&problem, two.clone(), &short, &clock, &Cancel::new(), &mut |_, _| ());
        assert!(runs.iter().all(|run| run.ended == Ended::GivenUp && run.times.len() == 1));
        let cancel = Cancel::new();
        let runs = measure(&problem, two, &effort, &clock, &cancel, &mut |_, _| cancel.cancel());
        assert_eq!(runs.iter().map(|run| run.times.len()).collect::<Vec<_>>(), [1, 0]);
        assert_eq!(runs[1].ended, Ended::Waiting);
    }

    #[test]
    fn plates_have_no_paper_and_a_grid_of_the_preset_is_measured() {
        let plate = Problem::new(&presets::find("plate-viscous").unwrap()).unwrap();
        assert!(candidates(&plate).iter().all(|candidate| candidate.family != Family::Paper));
        let own = Problem::new(&presets::find("doubled-mesh").unwrap()).unwrap();
        let own = candidates(&own).into_iter().find(|candidate| candidate.name.contains("preset")).unwrap();
        assert!(own.options().contains("--set numerics.film_nodes_along=101"), "{}", own.options());
    }
}
