//! A plate held by hand, in the background: one named thread that follows the hand in slow motion.
//!
//! It marches the film while the plate moves or the pressure still relaxes, paced by the clock, and sleeps otherwise. Only the
//! newest gap that is asked for counts. What it publishes is bounded: one snapshot, and the samples since they were last taken.

use crate::analysis::attempt::caught;
use crate::fidelity::Fidelity;
use crate::hold::{Hold, Reading, leak_time};
use crate::plan::Plan;
use crate::problem::{Numerics, Plate};
use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How often the film is marched on, and how much time at most is made up for at once.
const TICK: Duration = Duration::from_millis(20);
const MOST: Duration = Duration::from_millis(60);
/// A hand is not faster than this \[s\]: the gap follows what is asked for with this time constant.
const HAND: f64 = 0.03;
/// Where the gap is what was asked for, a share of it, and |p/p_a − 1| below which the film is at rest.
const THERE: f64 = 1e-4;
const AT_REST: f64 = 1e-4;
/// Samples that wait to be taken at most.
const SAMPLES: usize = 2048;

/// The film at one instant.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Number, ascending.
    pub number: u64,
    /// Gap, force and what follows from them.
    pub reading: Reading,
    /// Nodes along x ≥ 0, and across y ≥ 0 (of a strip one), from the middle \[m\].
    pub x: Vec<f64>,
    /// As `x`, across.
    pub y: Vec<f64>,
    /// Absolute pressure \[Pa\], `[ix][iy]`.
    pub pressure: Vec<f64>,
    /// How fast the film's time passes, over what was asked for: below 1 where marching takes longer than that.
    pub pace: f64,
    /// Why the film was put to rest.
    pub failure: Option<String>,
}

/// What the hand asks for: the newest counts.
#[derive(Clone, Copy, Debug)]
struct Target {
    gap: f64,
    /// Seconds for a second of the film.
    slowed: f64,
    reset: bool,
    closed: bool,
    /// It is let go, and whether the face below it vibrates.
    free: Option<bool>,
}

#[derive(Debug)]
struct Shared {
    target: Mutex<Target>,
    changed: Condvar,
    published: Mutex<(Arc<Snapshot>, VecDeque<Reading>)>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Plain data, never left half-changed.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A held plate and the thread that marches its film.
#[derive(Debug)]
pub struct HeldPlate {
    plate: Plate,
    shared: Arc<Shared>,
    worker: Option<JoinHandle<()>>,
}

impl HeldPlate {
    /// Holds `plate` at rest, with `slowed` seconds of the clock for a second of the film. `wake` is called from the thread after
    /// each snapshot.
    pub fn start(
        plate: Plate,
        slowed: f64,
        now: fn() -> Instant,
        wake: impl Fn() + Send + 'static,
    ) -> std::io::Result<Self> {
        let plan = Plan::plate(&plate, Fidelity::Standard, &Numerics::default());
        let hold = Hold::new(&plate, &plan);
        let target = Target { gap: plate.mean_gap, slowed, reset: false, closed: false, free: None };
        let shared = Arc::new(Shared {
            target: Mutex::new(target),
            changed: Condvar::new(),
            published: Mutex::new((Arc::new(snapshot(&hold, 0, 1.0, None)), VecDeque::new())),
        });
        let theirs = Arc::clone(&shared);
        let spawn = std::thread::Builder::new().name("squeezefilm-hold".to_owned());
        let worker = spawn.spawn(move || follow(&theirs, hold, now, &wake))?;
        Ok(Self { plate, shared, worker: Some(worker) })
    }

    fn ask(&self, change: impl FnOnce(&mut Target)) {
        change(&mut lock(&self.shared.target));
        self.shared.changed.notify_all();
    }

    /// Moves the plate to `gap` \[m\], or as near as it may come.
    pub fn move_to(&self, gap: f64) {
        let gap = Hold::within_reach(&self.plate, gap);
        self.ask(|target| (target.gap, target.free) = (gap, None));
    }

    /// Lets a plate under a load go, above a face that vibrates or stands still.
    pub fn let_go(&self, vibrates: bool) {
        self.ask(|target| target.free = Some(vibrates));
    }

    /// Takes `slowed` seconds for a second of the film from now on.
    pub fn slow(&self, slowed: f64) {
        self.ask(|target| target.slowed = slowed);
    }

    /// Puts the film to rest at the mean gap.
    pub fn reset(&self) {
        let gap = self.plate.mean_gap;
        self.ask(|target| (target.gap, target.reset, target.free) = (gap, true, None));
    }

    /// The newest snapshot, and what was read off since the last time.
    pub fn take(&self) -> (Arc<Snapshot>, VecDeque<Reading>) {
        let mut published = lock(&self.shared.published);
        (Arc::clone(&published.0), std::mem::take(&mut published.1))
    }
}

impl Drop for HeldPlate {
    fn drop(&mut self) {
        self.ask(|target| target.closed = true);
        if let Some(worker) = self.worker.take() {
            // What panics in the film is caught; another panic would have nothing left to tell.
            let _ = worker.join();
        }
    }
}

/// Slow motion in which the leak time of `plate` at its mean gap takes `seconds`.
pub fn slowed(plate: &Plate, seconds: f64) -> f64 {
    seconds / leak_time(plate, plate.mean_gap)
}

fn snapshot(hold: &Hold, number: u64, pace: f64, failure: Option<String>) -> Snapshot {
    let grid = hold.grid();
    Snapshot {
        number,
        reading: hold.reading(),
        x: grid.x.nodes.clone(),
        y: grid.y.nodes.clone(),
        pressure: hold.pressure().collect(),
        pace,
        failure,
    }
}

/// Follows the hand until it is told to end.
fn follow(shared: &Shared, mut hold: Hold, now: fn() -> Instant, wake: &dyn Fn()) {
    let mut last: Option<Instant> = None;
    let (mut number, mut pace) = (0, 1.0);
    loop {
        let target = {
            let mut target = lock(&shared.target);
            loop {
                if target.closed {
                    return;
                }
                let there = (target.gap - hold.gap()).abs() <= THERE * hold.gap();
                let moves = match target.free {
                    Some(vibrates) => vibrates || !hold.is_still(),
                    None => !there,
                };
                if target.reset || moves || hold.unrest() > AT_REST {
                    break;
                }
                last = None;
                target = shared.changed.wait(target).unwrap_or_else(PoisonError::into_inner);
            }
            let taken = *target;
            target.reset = false;
            taken
        };
        let began = now();
        let passed = last.map_or(TICK, |last| began.saturating_duration_since(last));
        last = Some(began);
        let elapsed = passed.min(MOST).as_secs_f64();
        if passed > Duration::ZERO {
            let share = elapsed / passed.as_secs_f64();
            pace += 0.2 * (share - pace);
        }
        let toward = target.gap - hold.gap();
        let near = toward.abs() <= THERE * hold.gap();
        let gap = if near { target.gap } else { hold.gap() + toward * (1.0 - (-elapsed / HAND).exp()) };
        let (mut failure, mut mean) = (None, None);
        if target.reset {
            hold.reset();
        } else {
            let time = elapsed / target.slowed;
            let moved = caught(|| match target.free {
                Some(vibrates) => hold.fall(time, vibrates).map(Some),
                None => hold.advance(gap, time).map(|()| None),
            });
            failure = match moved {
                Ok(Ok(read)) => {
                    mean = read;
                    None
                }
                Ok(Err(error)) => Some(error.to_string()),
                Err(panic) => Some(format!("the film failed: {panic}")),
            };
            if failure.is_some() {
                hold.reset();
                let mut target = lock(&shared.target);
                (target.gap, target.free) = (hold.gap(), None);
            }
        }
        number += 1;
        {
            let mut published = lock(&shared.published);
            let mut taken = snapshot(&hold, number, pace, failure);
            // Of a plate that shakes, what a slow eye sees.
            taken.reading = mean.unwrap_or(taken.reading);
            published.0 = Arc::new(taken);
            if target.reset {
                published.1.clear();
            }
            if published.1.len() == SAMPLES {
                published.1.pop_front();
            }
            let reading = published.0.reading;
            published.1.push_back(reading);
        }
        wake();
        // Until the next tick, or the end.
        let spent = now().saturating_duration_since(began);
        let target = lock(&shared.target);
        if let (Some(left), false) = (TICK.checked_sub(spent), target.closed) {
            drop(shared.changed.wait_timeout_while(target, left, |target| !target.closed));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{Problem, Scenario};
    use crate::scene::Scene;
    use std::sync::atomic::{AtomicUsize, Ordering};

    fn plate() -> Plate {
        match Problem::new(&Scene::plate()).unwrap().scenario {
            Scenario::Plate(plate) => plate,
            Scenario::Motor(_) => panic!("a plate"),
        }
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
        let held = HeldPlate::start(plate.clone(), slowed(&plate, 0.1), Instant::now, wake).unwrap();
        std::thread::sleep(Duration::from_millis(100));
        assert_eq!(woken.load(Ordering::Relaxed), 0, "nothing moves");
        held.move_to(0.6 * plate.mean_gap);
        until("it is there and at rest", || {
            let (seen, samples) = held.take();
            assert!(samples.len() <= SAMPLES && seen.failure.is_none());
            let (gap, force) = (seen.reading.gap, seen.reading.ratio);
            (gap / plate.mean_gap - 0.6).abs() < 1e-3 && force.abs() < 1e-3
        });
        held.move_to(plate.mean_gap);
        until("it is pulled", || held.take().0.reading.ratio < -0.05);
        held.reset();
        until("it is reset", || held.take().0.reading.time == 0.0);
        std::thread::sleep(Duration::from_millis(100));
        let before = woken.load(Ordering::Relaxed);
        std::thread::sleep(Duration::from_millis(200));
        assert_eq!(woken.load(Ordering::Relaxed), before, "it sleeps");
    }

    #[test]
    fn it_ends_while_it_moves() {
        let plate = plate();
        let held = HeldPlate::start(plate.clone(), slowed(&plate, 10.0), Instant::now, || ()).unwrap();
        held.move_to(2.0 * plate.mean_gap);
        until("it moves", || held.take().0.number > 0);
        drop(held);
    }
}
