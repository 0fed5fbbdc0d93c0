//! A held plate of a process: a named thread marches its film.

use super::follower::{Follower, HandTarget, SNAPSHOTS, Snapshot, TICK};
use crate::platform::Instant;
use crate::problem::Plate;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

#[derive(Debug)]
struct Shared {
    target: Mutex<HandTarget>,
    closed: AtomicBool,
    changed: Condvar,
    published: Mutex<VecDeque<Arc<Snapshot>>>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // The data is plain, and a panic never leaves it half-changed.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A held plate and the thread that marches its film.
#[derive(Debug)]
pub struct HeldPlate {
    pub(super) plate: Plate,
    shared: Arc<Shared>,
    worker: Option<JoinHandle<()>>,
}

impl HeldPlate {
    /// Holds `plate` at rest, with `slowed` seconds of the clock for a second of the film; with its first snapshot. `wake` is called
    /// from the thread after each other one.
    pub fn start(
        plate: Plate,
        slowed: f64,
        now: fn() -> Instant,
        wake: impl Fn() + Send + 'static,
    ) -> std::io::Result<(Self, Snapshot)> {
        let follower = Follower::new(&plate);
        let first = follower.snapshot(None);
        let target = HandTarget::first(&plate, slowed);
        let shared = Arc::new(Shared {
            target: Mutex::new(target),
            closed: AtomicBool::new(false),
            changed: Condvar::new(),
            published: Mutex::default(),
        });
        let theirs = Arc::clone(&shared);
        let spawn = std::thread::Builder::new().name("squeezefilm-hold".to_owned());
        let worker = spawn.spawn(move || follow(&theirs, follower, now, &wake))?;
        Ok((Self { plate, shared, worker: Some(worker) }, first))
    }

    pub(super) fn ask(&self, change: impl FnOnce(&mut HandTarget)) {
        change(&mut lock(&self.shared.target));
        self.shared.changed.notify_all();
    }

    /// The snapshots since the last call, oldest first.
    pub fn take(&self) -> VecDeque<Arc<Snapshot>> {
        std::mem::take(&mut lock(&self.shared.published))
    }
}

impl Drop for HeldPlate {
    fn drop(&mut self) {
        // It is set under the lock, so that a thread that is about to wait sees it.
        self.ask(|_| self.shared.closed.store(true, Ordering::Relaxed));
        if let Some(worker) = self.worker.take() {
            // A panic in the film is caught. After any other panic nothing is left to report.
            let _ = worker.join();
        }
    }
}

/// Marches the film until the plate is dropped.
fn follow(shared: &Shared, mut follower: Follower, now: fn() -> Instant, wake: &dyn Fn()) {
    let closed = || shared.closed.load(Ordering::Relaxed);
    loop {
        let target = {
            let mut target = lock(&shared.target);
            loop {
                if closed() {
                    return;
                }
                if !follower.rests(&target) {
                    break;
                }
                follower.last = None;
                target = shared.changed.wait(target).unwrap_or_else(PoisonError::into_inner);
            }
            let taken = *target;
            target.reset = false;
            taken
        };
        let began = now();
        let snapshot = follower.tick(&target, began);
        if snapshot.failure.is_some() {
            let mut target = lock(&shared.target);
            (target.gap, target.free) = (follower.hold.gap(), None);
        }
        {
            let mut published = lock(&shared.published);
            if target.reset {
                published.clear();
            }
            if published.len() == SNAPSHOTS {
                published.pop_front();
            }
            published.push_back(Arc::new(snapshot));
        }
        wake();
        // Until the next tick, or the end.
        let spent = now().saturating_duration_since(began);
        let target = lock(&shared.target);
        if let (Some(left), false) = (TICK.checked_sub(spent), closed()) {
            drop(shared.changed.wait_timeout_while(target, left, |_| !closed()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::follower::slowed;
    use super::*;
    use crate::hold::Reading;
    use crate::problem::Problem;
    use crate::scene::Scene;
    use std::sync::atomic::AtomicUsize;
    use std::time::Duration;

    fn plate() -> Plate {
        Problem::try_from(&Scene::plate()).unwrap().scenario.plate().unwrap().clone()
    }

    fn until(what: &str, ready: impl Fn() -> bool) {
        for _ in 0..3000 {
            if ready() {
                return;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        panic!("{what}: did not happen");
    }

    #[test]
    fn it_follows_the_hand_relaxes_and_then_sleeps() {
        let plate = plate();
        let woken = Arc::new(AtomicUsize::new(0));
        let count = Arc::clone(&woken);
        let wake = move || {
            count.fetch_add(1, Ordering::Relaxed);
        };
        let (held, _) = HeldPlate::start(plate.clone(), slowed(&plate, 0.1), Instant::now, wake).unwrap();
        std::thread::sleep(Duration::from_millis(100));
        assert_eq!(woken.load(Ordering::Relaxed), 0, "nothing moves");
        held.move_to(0.6 * plate.mean_gap);
        until("it is there and at rest", || {
            let samples = held.take();
            assert!(samples.len() <= SNAPSHOTS && samples.iter().all(|seen| seen.failure.is_none()));
            let at_rest =
                |Reading { gap, ratio, .. }: Reading| (gap / plate.mean_gap - 0.6).abs() < 1e-3 && ratio.abs() < 1e-3;
            samples.back().is_some_and(|seen| at_rest(seen.reading))
        });
        held.move_to(plate.mean_gap);
        until("it is pulled", || held.take().iter().any(|seen| seen.reading.ratio < -0.05));
        held.reset();
        until("it is reset", || held.take().iter().any(|seen| seen.reading.time == 0.0));
        std::thread::sleep(Duration::from_millis(100));
        let before = woken.load(Ordering::Relaxed);
        std::thread::sleep(Duration::from_millis(200));
        assert_eq!(woken.load(Ordering::Relaxed), before, "it sleeps");
    }

    #[test]
    fn it_ends_while_it_moves() {
        let plate = plate();
        let (held, _) = HeldPlate::start(plate.clone(), slowed(&plate, 10.0), Instant::now, || ()).unwrap();
        held.move_to(2.0 * plate.mean_gap);
        until("it moves", || !held.take().is_empty());
        drop(held);
    }
}
