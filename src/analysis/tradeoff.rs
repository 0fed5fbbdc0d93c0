//! Measures error against solve time for one scene: the cost of each accuracy, of a family of grids and of the paper's method on this
//! machine, and the cheapest setting that meets a target.
//!
//! The caller passes the clock. Runs are interleaved, so that no setting is favoured if the machine is busy for a while. One number is
//! judged: α of a motor, the mean film load of a plate, or the mean gap of a plate that floats; errors are shares of it. The measured error
//! of a setting is its distance from the most accurate setting plus the stated error of that one: a bound, for this scene. A coarse grid
//! may be accurate by chance, however, and inaccurate for a similar scene. Settings are therefore judged by the greater of the measured
//! error and the stated error.
//!
//! Settings differ only in their grids. The switches of the scene's model (`numerics.flow`, …) apply to all of them.

mod candidates;
mod curve;
mod measure;

pub use candidates::{Candidate, Family, candidates, without_grid};
pub(super) use curve::quantile;
pub use curve::{Target, Tradeoff, TradeoffPoint};
pub use measure::{Effort, MeasuredSetting, measure};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::attempt::RunStatus;
    use crate::analysis::quantity::{Numbers, Quantity};
    use crate::control::Cancel;
    use crate::problem::{Numerics, Problem};
    use crate::scene::presets;
    use crate::solve::{Method, Settings};
    use std::cell::Cell;

    fn run(name: &str, method: Method, alpha: f64, stated: f64, times: &[f64]) -> MeasuredSetting {
        let mut numbers = Numbers::default();
        numbers.set(Quantity::Alpha, alpha);
        numbers.set(Quantity::AlphaError, stated);
        let settings = Settings { method, ..Settings::default() };
        let numerics = Numerics::default();
        let candidate = Candidate::new(name.to_owned(), Family::Grid, settings, numerics, &numerics);
        MeasuredSetting { candidate, status: RunStatus::Converged, numbers, grid: (1, 1), times: times.to_vec() }
    }

    fn synthetic() -> Vec<MeasuredSetting> {
        let mut limit = run("limit", Method::Auto, 0.5, 1e-9, &[1e-9]);
        limit.status = RunStatus::NotConverged;
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
        let name = |target| tradeoff.choose(target).map(|i| tradeoff.points[i].run.candidate.name.clone());
        for (target, chosen) in [
            (Target::Accuracy(0.5), Some("lucky")),
            (Target::Accuracy(0.1), Some("fast")),
            (Target::Accuracy(0.0201), Some("middle")),
            (Target::Accuracy(0.0002), Some("exact")),
            (Target::Accuracy(0.0001), None),
            (Target::Budget(0.0001), None),
            (Target::Budget(0.016), Some("fast")),
            (Target::Budget(0.5), Some("middle")),
            (Target::Budget(60.0), Some("exact")),
        ] {
            assert_eq!(name(target).as_deref(), chosen, "{target:?}");
        }
        assert_eq!(Tradeoff::of(&[]).choose(Target::Budget(1.0)), None);
    }

    #[test]
    fn runs_are_interleaved_and_counted_by_the_callers_clock() {
        let problem = Problem::try_from(&presets::find("plate-crossover").unwrap()).unwrap();
        let named = |candidate: &Candidate| ["draft", "standard"].contains(&candidate.name.as_str());
        let two: Vec<Candidate> = candidates(&problem).into_iter().filter(named).collect();
        // A clock that advances by a second at each call; each run reads it in every round.
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
        assert!(
            runs.iter().all(|run| run.status == RunStatus::Converged && run.times.iter().all(|t| *t == run.times[0]))
        );
        assert!(shares.windows(2).all(|pair| pair[0] < pair[1]) && (shares[5] - 1.0).abs() < 1e-12, "{shares:?}");
        let tradeoff = Tradeoff::of(&runs);
        assert_eq!((tradeoff.judged, tradeoff.reference), (Quantity::FilmLoad, Some(1)));

        // This run was given up because of the clock; the other one was cancelled, and returned what there was.
        let short = Effort { longest: 2.0, ..effort };
        let runs = measure(&problem, two.clone(), &short, &clock, &Cancel::new(), &mut |_, _| ());
        assert!(runs.iter().all(|run| run.status == RunStatus::GivenUp && run.times.len() == 1));
        let cancel = Cancel::new();
        let runs = measure(&problem, two, &effort, &clock, &cancel, &mut |_, _| cancel.cancel());
        assert_eq!(runs.iter().map(|run| run.times.len()).collect::<Vec<_>>(), [1, 0]);
        assert_eq!(runs[1].status, RunStatus::Waiting);
    }
}
