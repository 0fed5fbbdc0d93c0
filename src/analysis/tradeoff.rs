//! Error against solve time of one scene, measured: what each accuracy, a family of grids and the paper's method cost
//! here and now, and which is the cheapest that serves.
//!
//! The clock is the caller's. Runs are interleaved, every setting once and then again, so that a machine that is busy for
//! a while favours none. What is judged is one number, α of a motor and the mean film load of a plate; errors are shares
//! of it. The measured error of a setting is its distance from the most accurate setting plus that one's own stated
//! error: a bound, for this scene. A coarse grid may be right by luck, though, and wrong in the scene beside it. Settings are
//! therefore judged by the greater of the measured error and the one that the run states of itself.
//!
//! Settings differ in grids alone. The model stays the scene's: what its switches (`numerics.flow`, …) say holds for each of them.

mod curve;
mod measure;

pub use curve::{Point, Tradeoff, Wish};
pub use measure::{Effort, Ended, Run, measure};

use crate::fidelity::Fidelity;
use crate::problem::{Numerics, Problem, Scenario};
use crate::solve::{Method, Settings};

/// Accuracies between those that have names, in millionths.
const BETWEEN: [u32; 3] = [10_000, 2_000, 500];
/// Grids beside the accuracies: what each starts from, film nodes along and across, steps in a cycle.
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
    /// An accuracy that is asked for, by its name or as a number.
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
    /// All of the scene's numerics as they are solved: its switches, and a grid that may be another one.
    pub numerics: Numerics,
    /// The options of the command line that choose it, added to those that make the scene.
    pub options: String,
}

impl Candidate {
    /// A way to solve a scene that has the numerics `scene`.
    pub fn new(name: String, family: Family, settings: Settings, numerics: Numerics, scene: &Numerics) -> Self {
        let mut options = match settings.method {
            Method::Auto => settings.fidelity.option(),
            Method::Paper => "--method paper".to_owned(),
        };
        let grid = |of: &Numerics| {
            [
                ("film_nodes_along", of.film_nodes_along.map(|count| count.to_string())),
                ("film_nodes_across", of.film_nodes_across.map(|count| count.to_string())),
                ("contact_nodes", of.contact_nodes.map(|count| count.to_string())),
                ("steps_per_cycle", of.steps_per_cycle.map(|count| count.to_string())),
                ("tolerance", of.tolerance.map(|change| change.to_string())),
            ]
        };
        for ((key, value), (_, present)) in grid(&numerics).into_iter().zip(grid(scene)) {
            if value != present {
                options.push_str(&format!(" --set numerics.{key}={}", value.as_deref().unwrap_or("none")));
            }
        }
        Self { name, family, settings, numerics, options }
    }
}

/// The scene's numerics without its grid: the switches of the model, which every candidate keeps, and the contact nodes, which our own
/// method does not heed.
pub fn without_grid(numerics: &Numerics) -> Numerics {
    Numerics { film_nodes_along: None, film_nodes_across: None, steps_per_cycle: None, tolerance: None, ..*numerics }
}

/// What is worth measuring for a scene: every fidelity and some accuracies between them, some grids, the scene's own if it has one,
/// and for a motor the paper's method on three meshes.
pub fn candidates(problem: &Problem) -> Vec<Candidate> {
    let (scene, free) = (&problem.numerics, without_grid(&problem.numerics));
    let auto = |fidelity| Settings { fidelity, ..Settings::default() };
    let mut accuracies: Vec<Fidelity> = Fidelity::ALL.into_iter().chain(BETWEEN.map(Fidelity::To)).collect();
    accuracies.sort_by(|a, b| b.accuracy().total_cmp(&a.accuracy()));
    let named = |fidelity: Fidelity| match fidelity {
        Fidelity::To(_) => format!("accuracy {fidelity}"),
        _ => fidelity.to_string(),
    };
    let mut all: Vec<Candidate> = accuracies
        .into_iter()
        .map(|fidelity| Candidate::new(named(fidelity), Family::Fidelity, auto(fidelity), free, scene))
        .collect();
    for (fidelity, along, across, steps) in GRIDS {
        let numerics = Numerics {
            film_nodes_along: Some(along),
            film_nodes_across: Some(across),
            steps_per_cycle: Some(steps),
            ..free
        };
        let name = format!("{fidelity}, {along} × {across} × {steps}");
        all.push(Candidate::new(name, Family::Grid, auto(fidelity), numerics, scene));
    }
    if *scene != free {
        let name = "the scene's own grid".to_owned();
        all.push(Candidate::new(name, Family::Grid, Settings::default(), *scene, scene));
    }
    if matches!(problem.scenario, Scenario::Motor(_)) {
        for (name, along, across, contact) in PAPER_MESHES {
            let numerics = Numerics {
                film_nodes_along: Some(along),
                film_nodes_across: Some(across),
                contact_nodes: Some(contact),
                ..free
            };
            let settings = Settings { method: Method::Paper, ..Settings::default() };
            all.push(Candidate::new(name.to_owned(), Family::Paper, settings, numerics, scene));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::quantity::{Numbers, Quantity};
    use crate::control::Cancel;
    use crate::scene::presets;
    use std::cell::Cell;

    fn run(name: &str, method: Method, alpha: f64, stated: f64, times: &[f64]) -> Run {
        let mut numbers = Numbers::default();
        numbers.set(Quantity::Alpha, alpha);
        numbers.set(Quantity::AlphaError, stated);
        let settings = Settings { method, ..Settings::default() };
        let numerics = Numerics::default();
        let candidate = Candidate::new(name.to_owned(), Family::Grid, settings, numerics, &numerics);
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
    fn plates_have_no_paper_and_a_grid_of_the_scene_is_measured_beside_others() {
        let problem = |preset: &str| Problem::new(&presets::find(preset).unwrap()).unwrap();
        assert!(candidates(&problem("plate-viscous")).iter().all(|candidate| candidate.family != Family::Paper));
        let own = candidates(&problem("doubled-mesh"));
        let options = |name: &str| own.iter().find(|candidate| candidate.name == name).unwrap().options.as_str();
        assert_eq!(options("the scene's own grid"), "--fidelity standard");
        assert_eq!(
            options("draft"),
            "--fidelity draft --set numerics.film_nodes_along=none --set numerics.film_nodes_across=none"
        );
        assert_eq!(options("accuracy 0.2%").split(" --set").next(), Some("--accuracy 0.2%"));
    }

    #[test]
    fn every_candidate_keeps_the_switches_of_the_model() {
        let mut scene = presets::find("fundamental").unwrap();
        scene.set_all([("numerics.flow", "along"), ("numerics.steps_per_cycle", "72")]).unwrap();
        let problem = Problem::new(&scene).unwrap();
        assert!(candidates(&problem).iter().all(|candidate| candidate.numerics.flow == problem.numerics.flow));
        assert!(candidates(&problem).iter().all(|candidate| !candidate.options.contains("flow")));
    }
}
