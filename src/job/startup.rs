//! A start-up in the background: cycles come as they are completed.

use super::task::Task;
use crate::problem::Problem;
use crate::startup::{self, Cycle, Settings, Startup};

/// Cycles that may wait to be taken, each with all its fields: a thread that is further ahead waits.
const AHEAD: usize = 4;

/// Starts `problem` from rest. It returns how the start-up ended, or why there is no more.
pub fn start(
    problem: Problem,
    settings: Settings,
    wake: impl Fn(bool) + Send + Sync + 'static,
) -> std::io::Result<Task<Cycle, Result<Startup, String>>> {
    // Those that wait, and the one that waits to wait.
    let settings = Settings { kept: settings.kept + AHEAD + 1, ..settings };
    Task::start_bounded("startup", AHEAD, wake, move |cancel, tell| {
        startup::startup(&problem, &settings, &mut |cycle| tell(cycle), cancel).map_err(|error| error.to_string())
    })
}

#[cfg(test)]
mod tests {
    use super::super::task::to_the_end;
    use super::*;
    use crate::fidelity::Fidelity;
    use crate::problem::Scenario;
    use crate::scene::presets;
    use crate::solution::Status;
    use std::time::Duration;

    fn problem(preset: &str) -> Problem {
        Problem::new(&presets::find(preset).unwrap()).unwrap()
    }

    fn draft(problem: Problem, cycles: usize) -> Task<Cycle, Result<Startup, String>> {
        let settings = Settings { fidelity: Fidelity::Draft, cycles, ..Settings::default() };
        start(problem, settings, |_| ()).unwrap()
    }

    #[test]
    fn every_cycle_comes_in_order_and_then_how_it_ended() {
        let (cycles, ended) = to_the_end(&draft(problem("plate-crossover"), 100));
        let ended = ended.unwrap().unwrap();
        assert_eq!(ended.status, Status::Converged);
        let mut cycles: Vec<usize> = cycles.iter().map(|cycle| cycle.number).collect();
        let again = cycles.split_off(ended.cycles);
        assert_eq!(cycles, (1..=ended.cycles).collect::<Vec<_>>());
        // Some of them again, on finer grids.
        assert!(again.iter().all(|number| (1..=ended.cycles).contains(number)), "{again:?}");
    }

    #[test]
    fn cancelling_and_dropping_end_a_long_one() {
        let long = || {
            let mut numerics = problem("fundamental");
            numerics.numerics.steps_per_cycle = Some(4000);
            draft(numerics, 1000)
        };
        let transient = long();
        transient.cancel();
        assert_eq!(to_the_end(&transient).1.unwrap().unwrap().status, Status::Cancelled);
        // A thread that waits for its cycles to be taken ends too.
        let full = draft(problem("plate-trapped"), 100_000);
        std::thread::sleep(Duration::from_millis(300));
        drop(full);
        drop(long());
    }

    #[test]
    fn a_panic_in_the_solver_is_a_message() {
        let mut broken = problem("fundamental");
        // A problem that no scene can make: the solver divides by the number of teeth.
        if let Scenario::Motor(motor) = &mut broken.scenario {
            motor.teeth = 0;
        }
        let (cycles, ended) = to_the_end(&draft(broken, 10));
        assert!(cycles.is_empty() && !ended.unwrap_err().is_empty());
    }
}
