//! The held plate as the window has it: where it is held, what was read off it lately, and the ranges of its axes.

use crate::hold::{Hold, REACH, Reading, leak_time};
use crate::job::hold::{HeldPlate, Snapshot, slowed};
use crate::problem::Plate;
use crate::scene::Scene;
use std::collections::VecDeque;
use std::sync::Arc;

/// Seconds for the leak time that can be chosen.
pub const SECONDS: std::ops::RangeInclusive<f64> = 0.1..=10.0;
/// Seconds for the leak time at first.
pub const FIRST_SECONDS: f64 = 1.0;
/// Seconds of slow motion that the charts hold, and samples at most.
const WINDOW: f64 = 8.0;
const SAMPLES: usize = 2000;
/// Pressures that the colours hold at least, over ambient.
const LEAST_RANGE: [f64; 2] = [0.8, 1.25];

/// A held plate.
#[derive(Debug)]
pub struct HoldState {
    job: HeldPlate,
    scene: Scene,
    plate: Plate,
    seconds: f64,
    /// Where it is held \[m\].
    target: f64,
    /// It is let go, and whether the face below it vibrates.
    free: Option<bool>,
    now: Arc<Snapshot>,
    trail: VecDeque<Reading>,
    pressure: [f64; 2],
    force: [f64; 2],
}

impl HoldState {
    /// The `plate` of `scene` in hand, at rest, whose film `job` marches.
    pub fn new(job: HeldPlate, scene: Scene, plate: Plate) -> Self {
        let (now, _) = job.take();
        Self {
            job,
            scene,
            seconds: FIRST_SECONDS,
            target: plate.mean_gap,
            free: None,
            now,
            trail: VecDeque::new(),
            pressure: LEAST_RANGE.map(|ratio| ratio * plate.gas.ambient_pressure),
            force: [0.0; 2],
            plate,
        }
    }

    /// Takes what was read off since the last time.
    pub fn drain(&mut self) {
        let (now, readings) = self.job.take();
        if now.number == self.now.number {
            return;
        }
        if now.failure.is_some() {
            (self.target, self.free) = (self.plate.mean_gap, None);
        }
        if self.free.is_some() {
            self.target = Hold::within_reach(&self.plate, now.reading.gap);
        }
        if readings.front().is_some_and(|first| self.trail.back().is_some_and(|last| first.time < last.time)) {
            self.trail.clear();
        }
        for pressure in &now.pressure {
            self.pressure = [self.pressure[0].min(*pressure), self.pressure[1].max(*pressure)];
        }
        for reading in &readings {
            self.force = [self.force[0].min(reading.force), self.force[1].max(reading.force)];
        }
        self.trail.extend(readings);
        let begin = now.reading.time - self.window();
        while self.trail.len() > SAMPLES || self.trail.front().is_some_and(|first| first.time < begin) {
            self.trail.pop_front();
        }
        self.now = now;
    }

    /// Puts the film to rest at the mean gap, and clears the charts.
    pub fn reset(&mut self) {
        (self.target, self.free) = (self.plate.mean_gap, None);
        self.trail.clear();
        self.pressure = LEAST_RANGE.map(|ratio| ratio * self.plate.gas.ambient_pressure);
        self.force = [0.0; 2];
        self.job.reset();
    }

    /// Lets the leak time take this many seconds.
    pub fn set_seconds(&mut self, seconds: f64) {
        self.seconds = seconds.clamp(*SECONDS.start(), *SECONDS.end());
        self.job.slow(self.slowed());
    }

    /// Holds the plate at `gap` \[m\], or as near as it may come.
    pub fn move_to(&mut self, gap: f64) {
        self.target = Hold::within_reach(&self.plate, gap);
        self.free = None;
        self.job.move_to(self.target);
    }

    /// Lets go: a plate under a load falls, or floats on the vibration; any other goes back to its mean gap.
    pub fn let_go(&mut self, vibrates: bool) {
        if self.plate.load.is_none() {
            return self.move_to(self.plate.mean_gap);
        }
        self.free = Some(vibrates);
        self.job.let_go(vibrates);
    }

    /// Whether it is let go, and if so, whether the face below it vibrates.
    pub fn free(&self) -> Option<bool> {
        self.free
    }

    /// Whether `scene` has another plate.
    pub fn stale(&self, scene: &Scene) -> bool {
        !self.scene.same_model(scene)
    }

    /// The plate.
    pub fn plate(&self) -> &Plate {
        &self.plate
    }

    /// Gaps that it can be held at \[m\].
    pub fn reach(&self) -> [f64; 2] {
        REACH.map(|share| share * self.plate.mean_gap)
    }

    /// Where it is held \[m\].
    pub fn target(&self) -> f64 {
        self.target
    }

    /// The film now.
    pub fn now(&self) -> &Snapshot {
        &self.now
    }

    /// What was read off it lately, oldest first.
    pub fn trail(&self) -> &VecDeque<Reading> {
        &self.trail
    }

    /// Time of the film that the charts hold \[s\].
    pub fn window(&self) -> f64 {
        WINDOW / self.slowed()
    }

    /// Leak time at the mean gap \[s\].
    pub fn leak_time(&self) -> f64 {
        leak_time(&self.plate, self.plate.mean_gap)
    }

    /// Seconds that the leak time takes.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Seconds for a second of the film.
    pub fn slowed(&self) -> f64 {
        slowed(&self.plate, self.seconds)
    }

    /// Least and greatest pressure since it was reset \[Pa\].
    pub fn pressure_range(&self) -> [f64; 2] {
        self.pressure
    }

    /// Least and greatest force since it was reset \[N or N/m\], zero included.
    pub fn force_range(&self) -> [f64; 2] {
        self.force
    }
}
