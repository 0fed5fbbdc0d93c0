//! A start-up in the background. Each cycle is sent when it is complete.

use super::work::{Posed, Work};
use crate::control::Cancel;
use crate::startup::{self, Cycle, Settings, Startup};
use serde::{Deserialize, Serialize};

/// Most cycles, each with all its fields, that wait to be taken. A thread that is further ahead waits.
const AHEAD: usize = 4;

/// A start-up, as it is sent to the thread or worker that computes it.
#[derive(Debug, Serialize, Deserialize)]
pub struct StartupWork {
    /// The scene that is started.
    pub posed: Posed,
    /// How it is solved.
    pub settings: Settings,
}

impl Work for StartupWork {
    const NAME: &'static str = "startup";
    const AHEAD: Option<usize> = Some(AHEAD);
    type Message = Cycle;
    /// How the start-up ended.
    type Found = Startup;

    fn run(self, cancel: &Cancel, tell: &(dyn Fn(Cycle) + Sync)) -> Result<Option<Self::Found>, String> {
        // Kept are also those that wait to be taken, and the one that the thread holds while it waits for room.
        let settings = Settings { kept: self.settings.kept + AHEAD + 1, ..self.settings };
        startup::startup(&self.posed.problem, &settings, &mut |cycle| tell(cycle), cancel)
            .map(Some)
            .map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::super::task::{Task, TaskOf, to_the_end};
    use super::super::work::tests::posed;
    use super::*;
    use crate::fidelity::Fidelity;
    use crate::solution::Status;
    use std::time::Duration;

    fn draft(posed: Posed, cycles: usize) -> TaskOf<StartupWork> {
        let settings = Settings { fidelity: Fidelity::Draft, cycles, ..Settings::default() };
        Task::of(StartupWork { posed, settings }, |_| ()).unwrap()
    }

    #[test]
    fn every_cycle_comes_in_order_and_then_how_it_ended() {
        let (cycles, ended) = to_the_end(&draft(posed("plate-crossover"), 100));
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
            let mut fine = posed("fundamental");
            fine.problem.numerics.steps_per_cycle = Some(4000);
            draft(fine, 1000)
        };
        let transient = long();
        transient.cancel();
        assert_eq!(to_the_end(&transient).1.unwrap().unwrap().status, Status::Cancelled);
        // A thread that waits for its cycles to be taken ends too.
        let full = draft(posed("plate-trapped"), 100_000);
        std::thread::sleep(Duration::from_millis(300));
        drop(full);
        drop(long());
    }
}
