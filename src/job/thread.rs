//! The background solver of a process: a named worker thread.

use super::{Event, Request, SolvedScene, solved};
use crate::control::Cancel;
use crate::fidelity::Fidelity;
use crate::motor::Warm;
use crate::platform::Instant;
use std::collections::HashMap;
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

#[derive(Debug, Default)]
struct Slot {
    waiting: Option<(u64, Request)>,
    running: Option<Cancel>,
    closed: bool,
}

impl Slot {
    /// Cancels what is running and forgets what is waiting.
    fn clear(&mut self) {
        self.waiting = None;
        self.running.iter().for_each(Cancel::cancel);
    }
}

#[derive(Debug, Default)]
struct Shared {
    slot: Mutex<Slot>,
    changed: Condvar,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Slot> {
        // The slot is plain data, which a panic never leaves half-changed.
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The worker and the way to it.
#[derive(Debug)]
pub struct Solver {
    shared: Arc<Shared>,
    events: Receiver<Event>,
    worker: Option<JoinHandle<()>>,
    next: u64,
}

impl Solver {
    /// Starts the worker. The clock `now` measures the solves; `wake` is called after every event, from the worker's thread.
    pub fn start(now: fn() -> Instant, wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let (sender, events) = channel();
        let theirs = Arc::clone(&shared);
        let worker = std::thread::Builder::new().name("squeezefilm-solver".to_owned()).spawn(move || {
            let tell = |event: Event| {
                drop(sender.send(event));
                wake();
            };
            work(&theirs, now, &tell);
        })?;
        Ok(Self { shared, events, worker: Some(worker), next: 0 })
    }

    /// Solves `request` instead of whatever is running or waiting. Returns its number.
    pub fn submit(&mut self, request: Request) -> u64 {
        self.next += 1;
        let mut slot = self.shared.lock();
        slot.clear();
        slot.waiting = Some((self.next, request));
        self.shared.changed.notify_all();
        self.next
    }

    /// Cancels what is running and forgets what is waiting.
    pub fn cancel(&self) {
        self.shared.lock().clear();
    }

    /// The events since the last call, in order.
    pub fn drain(&self) -> impl Iterator<Item = Event> {
        self.events.try_iter()
    }
}

impl Drop for Solver {
    fn drop(&mut self) {
        {
            let mut slot = self.shared.lock();
            slot.closed = true;
            slot.clear();
            self.shared.changed.notify_all();
        }
        if let Some(worker) = self.worker.take() {
            // After a panic outside a solve nothing is left to report.
            let _ = worker.join();
        }
    }
}

fn work(shared: &Shared, now: fn() -> Instant, tell: &dyn Fn(Event)) {
    // Each solve starts from the last one of its fidelity, because a slider moves in small steps.
    let mut warm = HashMap::new();
    loop {
        let (number, request, cancel) = {
            let mut slot = shared.lock();
            loop {
                if slot.closed {
                    return;
                }
                if let Some((number, request)) = slot.waiting.take() {
                    let cancel = Cancel::new();
                    slot.running = Some(cancel.clone());
                    break (number, request, cancel);
                }
                slot = shared.changed.wait(slot).unwrap_or_else(PoisonError::into_inner);
            }
        };
        refine(number, &request, &mut warm, &cancel, now, tell);
        shared.lock().running = None;
        tell(Event::Done { number });
    }
}

/// Solves at every fidelity of the request, until it is cancelled or one fails.
fn refine(
    number: u64,
    request: &Request,
    warm: &mut HashMap<Fidelity, Warm>,
    cancel: &Cancel,
    now: fn() -> Instant,
    tell: &dyn Fn(Event),
) {
    for &fidelity in &request.fidelities {
        if cancel.is_cancelled() {
            return;
        }
        let mut history = Vec::new();
        let warm = warm.entry(fidelity).or_default();
        let found = solved(&request.posed.problem, (fidelity, request.budget), now, warm, cancel, |progress| {
            history.push(*progress);
            tell(Event::Progress { number, fidelity, progress: *progress });
        });
        match found {
            Ok(None) => return,
            Ok(Some(timed)) => {
                let run = SolvedScene::of(number, request.posed.clone(), fidelity, timed, history);
                tell(Event::Solved(Arc::new(run)));
            }
            Err(message) => {
                tell(Event::Failed { number, message });
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::work::tests::posed;
    use crate::problem::Scenario;
    use std::time::Duration;

    fn request(preset: &str, fidelities: &[Fidelity]) -> Request {
        Request { posed: posed(preset), fidelities: fidelities.to_vec(), budget: None }
    }

    fn until_done(solver: &Solver, number: u64) -> Vec<Event> {
        let mut seen = Vec::new();
        for _ in 0..6000 {
            seen.extend(solver.drain());
            if seen.iter().any(|event| matches!(event, Event::Done { number: n } if *n == number)) {
                return seen;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        panic!("request {number} is not done: {} events", seen.len());
    }

    #[test]
    fn results_come_coarse_to_fine() {
        let mut solver = Solver::start(Instant::now, || ()).unwrap();
        let number = solver.submit(request("plate-crossover", &[Fidelity::Draft, Fidelity::Standard]));
        let events = until_done(&solver, number);
        let solved: Vec<Fidelity> =
            events.iter().filter_map(|e| if let Event::Solved(run) = e { Some(run.fidelity) } else { None }).collect();
        assert_eq!(solved, [Fidelity::Draft, Fidelity::Standard]);
        assert!(events.iter().any(|event| matches!(event, Event::Progress { .. })));
    }

    #[test]
    fn the_newest_request_wins() {
        let mut solver = Solver::start(Instant::now, || ()).unwrap();
        let mut last = 0;
        for _ in 0..50 {
            last = solver.submit(request("fundamental", &[Fidelity::Reference]));
        }
        last = last.max(solver.submit(request("plate-trapped", &[Fidelity::Draft])));
        let events = until_done(&solver, last);
        let finished: Vec<u64> =
            events.iter().filter_map(|e| if let Event::Solved(run) = e { Some(run.number) } else { None }).collect();
        assert_eq!(finished, [last]);
    }

    #[test]
    fn a_panic_in_a_solver_is_an_event_and_the_worker_lives_on() {
        let mut solver = Solver::start(Instant::now, || ()).unwrap();
        let mut broken = request("fundamental", &[Fidelity::Draft]);
        // A problem that no scene can make: the solver divides by the number of teeth.
        if let Scenario::Motor(motor) = &mut broken.posed.problem.scenario {
            motor.teeth = 0;
        }
        let number = solver.submit(broken);
        let events = until_done(&solver, number);
        assert!(events.iter().any(|event| matches!(event, Event::Failed { message, .. } if message.contains("draft"))));
        let number = solver.submit(request("plate-crossover", &[Fidelity::Draft]));
        assert!(until_done(&solver, number).iter().any(|event| matches!(event, Event::Solved(_))));
    }

    #[test]
    fn cancelling_and_dropping_end_a_long_solve() {
        let mut solver = Solver::start(Instant::now, || ()).unwrap();
        // This accuracy takes seconds.
        let number = solver.submit(request("fundamental", &[Fidelity::to(1e-6)]));
        std::thread::sleep(Duration::from_millis(50));
        solver.cancel();
        let events = until_done(&solver, number);
        assert!(!events.iter().any(|event| matches!(event, Event::Solved(_))));
        solver.submit(request("fundamental", &[Fidelity::Reference]));
        drop(solver);
    }
}
