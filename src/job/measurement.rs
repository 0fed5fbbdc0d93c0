//! The background measurement of error against time: one named thread, that is cancelled and joined on drop. Whoever owns
//! it passes the clock and a `wake` function, called after every run.

use super::worker::Worker;
use crate::analysis::tradeoff::{Candidate, Effort, Run, measure};
use crate::problem::Problem;
use std::sync::mpsc::{Receiver, channel};
use std::time::Instant;

/// How far it is.
#[derive(Clone, Debug)]
pub struct Told {
    /// All settings, with what was measured of them so far.
    pub runs: Vec<Run>,
    /// Share of the work that is done, 0 to 1.
    pub share: f64,
    /// Nothing more will come.
    pub ended: bool,
}

/// A measurement under way, or ended.
#[derive(Debug)]
pub struct Measurement {
    told: Receiver<Told>,
    worker: Worker,
}

impl Measurement {
    /// Starts to measure `candidates` on `problem`. `wake` is called from the worker's thread; its argument says whether
    /// that was the last time.
    ///
    /// # Errors
    /// If the thread cannot be started.
    pub fn start(
        problem: Problem,
        candidates: Vec<Candidate>,
        effort: Effort,
        now: fn() -> Instant,
        wake: impl Fn(bool) + Send + 'static,
    ) -> std::io::Result<Self> {
        let (sender, told) = channel();
        let worker = Worker::start("measure", move |cancel| {
            let started = now();
            let clock = || now().duration_since(started).as_secs_f64();
            let mut done = 0.0;
            let runs = measure(&problem, candidates, &effort, &clock, cancel, &mut |runs, share| {
                done = share;
                // Nobody may be left to listen: then the owner has cancelled it too.
                let _ = sender.send(Told { runs: runs.to_vec(), share, ended: false });
                wake(false);
            });
            let _ = sender.send(Told { runs, share: done, ended: true });
            wake(true);
        })?;
        Ok(Self { told, worker })
    }

    /// The newest of what was told since the last time.
    pub fn drain(&self) -> Option<Told> {
        self.told.try_iter().last()
    }

    /// Asks it to end; it tells when it has.
    pub fn cancel(&self) {
        self.worker.cancel();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::tradeoff::{Ended, candidates};
    use crate::fidelity::Fidelity;
    use crate::scene::presets;
    use std::time::Duration;

    fn start(fidelity: Fidelity, repeats: usize) -> Measurement {
        let problem = Problem::new(&presets::find("fundamental").unwrap()).unwrap();
        let mut all = candidates(&problem);
        all.retain(|candidate| candidate.name == fidelity.name());
        let effort = Effort { repeats: Some(repeats), ..Effort::default() };
        Measurement::start(problem, all, effort, Instant::now, |_| ()).unwrap()
    }

    fn last(measurement: &Measurement) -> Told {
        for _ in 0..6000 {
            match measurement.drain() {
                Some(told) if told.ended => return told,
                _ => std::thread::sleep(Duration::from_millis(10)),
            }
        }
        panic!("it has not ended");
    }

    #[test]
    fn it_measures_and_says_when_it_has_ended() {
        let told = last(&start(Fidelity::Draft, 3));
        assert_eq!((told.runs[0].times.len(), told.share), (3, 1.0));
        assert_eq!(told.runs[0].ended, Ended::Converged);
    }

    #[test]
    fn cancelling_and_dropping_end_a_long_one() {
        let measurement = start(Fidelity::Reference, 1000);
        measurement.cancel();
        assert!(last(&measurement).share < 1.0);
        drop(start(Fidelity::Reference, 1000));
    }
}
