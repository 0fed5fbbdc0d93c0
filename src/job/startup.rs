//! A start-up in the background: one named thread, that is cancelled and joined on drop. Cycles come as they are completed; a
//! thread that is a few ahead of whoever takes them waits. A panic in the solver becomes a message.

use super::panic_text;
use super::worker::Worker;
use crate::problem::Problem;
use crate::startup::{Cycle, Settings, Startup, startup};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, sync_channel};

/// Cycles that may wait to be taken: each holds all its fields.
const AHEAD: usize = 4;

/// What it tells.
#[derive(Debug)]
pub enum Told {
    /// A cycle is completed.
    Cycle(Box<Cycle>),
    /// Nothing more will come: how it ended, or why there is no more.
    Ended(Box<Result<Startup, String>>),
}

/// A start-up under way, or ended.
#[derive(Debug)]
pub struct Transient {
    told: Receiver<Told>,
    worker: Worker,
}

impl Transient {
    /// Starts `problem` from rest. `wake` is called from the worker's thread, after everything that it tells.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub fn start(problem: Problem, settings: Settings, wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let (sender, told) = sync_channel(AHEAD);
        // Those that wait, and the one that waits to wait.
        let settings = Settings { kept: settings.kept + AHEAD + 1, ..settings };
        let worker = Worker::start("startup", move |cancel| {
            // Nobody may be left to listen: then the owner has cancelled it too.
            let tell = |what: Told| {
                if sender.send(what).is_ok() {
                    wake();
                }
            };
            let mut each = |cycle: Cycle| tell(Told::Cycle(Box::new(cycle)));
            let run = AssertUnwindSafe(|| startup(&problem, &settings, &mut each, cancel));
            tell(Told::Ended(Box::new(match catch_unwind(run) {
                Ok(ended) => ended.map_err(|error| error.to_string()),
                Err(panic) => Err(format!("the solver failed: {}", panic_text(panic.as_ref()))),
            })));
        })?;
        Ok(Self { told, worker })
    }

    /// What was told since the last time.
    pub fn drain(&self) -> impl Iterator<Item = Told> {
        self.told.try_iter()
    }

    /// Asks it to end; it tells when it has.
    pub fn cancel(&self) {
        self.worker.cancel();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fidelity::Fidelity;
    use crate::problem::Scenario;
    use crate::scene::presets;
    use crate::solution::Status;
    use std::time::Duration;

    fn problem(preset: &str) -> Problem {
        Problem::new(&presets::find(preset).unwrap()).unwrap()
    }

    fn start(problem: Problem, cycles: usize) -> Transient {
        let settings = Settings { fidelity: Fidelity::Draft, cycles, ..Settings::default() };
        Transient::start(problem, settings, || ()).unwrap()
    }

    fn to_the_end(transient: &Transient) -> (Vec<usize>, Result<Startup, String>) {
        let mut cycles = Vec::new();
        for _ in 0..6000 {
            for told in transient.drain() {
                match told {
                    Told::Cycle(cycle) => cycles.push(cycle.number),
                    Told::Ended(ended) => return (cycles, *ended),
                }
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        panic!("it has not ended: {} cycles", cycles.len());
    }

    #[test]
    fn every_cycle_comes_in_order_and_then_how_it_ended() {
        let (cycles, ended) = to_the_end(&start(problem("plate-crossover"), 100));
        let ended = ended.unwrap();
        assert_eq!(ended.status, Status::Converged);
        assert_eq!(cycles, (1..=ended.cycles).collect::<Vec<_>>());
    }

    #[test]
    fn cancelling_and_dropping_end_a_long_one() {
        let long = || {
            let mut numerics = problem("fundamental");
            numerics.numerics.steps_per_cycle = Some(4000);
            start(numerics, 1000)
        };
        let transient = long();
        transient.cancel();
        assert_eq!(to_the_end(&transient).1.unwrap().status, Status::Cancelled);
        // A thread that waits for its cycles to be taken ends too.
        let full = start(problem("plate-trapped"), 100_000);
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
        let (cycles, ended) = to_the_end(&start(broken, 10));
        assert!(cycles.is_empty() && ended.unwrap_err().starts_with("the solver failed"));
    }
}
