//! State of the held plate in the window: its gap, the recent recording, the instant shown, and the ranges of the axes.

use crate::gui::derived::scales::span;
use crate::hold::{Hold, Reading};
use crate::job::hold::{HeldPlate, SNAPSHOTS, Snapshot, slowed};
use crate::problem::Plate;
use crate::scene::Scene;
use std::collections::VecDeque;
use std::sync::Arc;

/// Range of the slow motion: seconds on screen for the leak time.
pub const SECONDS: std::ops::RangeInclusive<f64> = 0.1..=10.0;
/// Initial slow motion: seconds on screen for the leak time.
pub const FIRST_SECONDS: f64 = 1.0;
/// Seconds of slow motion that the charts hold.
const WINDOW: f64 = 8.0;
/// Smallest range of the colours, in ambient pressures.
const LEAST_RANGE: [f64; 2] = [0.8, 1.25];

/// A held plate.
#[derive(Debug)]
pub struct HoldState {
    job: HeldPlate,
    scene: Scene,
    /// Its film, gap and gas.
    pub plate: Plate,
    /// Seconds on screen for the leak time.
    pub seconds: f64,
    /// Gap at which the plate is held \[m\].
    pub target: f64,
    /// `Some` if the plate was let go; whether the face below it vibrates.
    pub free: Option<bool>,
    /// The present film, even while a recorded one is shown.
    pub now: Arc<Snapshot>,
    trail: VecDeque<Arc<Snapshot>>,
    /// Time of the recorded film on screen \[s\], while the plate is paused; `None` if the present film is shown.
    recorded: Option<f64>,
    /// Whether the animation runs: either the plate moves, or the recorded film is replayed.
    pub playing: bool,
    /// Least and greatest pressure since it was reset \[Pa\].
    pub pressure_range: [f64; 2],
    /// Least and greatest force since it was reset \[N or N/m\], zero included.
    pub force_range: [f64; 2],
}

impl HoldState {
    /// A held plate at rest: the `plate` of `scene`, whose film `job` marches; `first` is its first snapshot.
    pub fn new((job, first): (HeldPlate, Snapshot), scene: Scene, plate: Plate) -> Self {
        let now = Arc::new(first);
        let trail = VecDeque::from([Arc::clone(&now)]);
        Self {
            job,
            scene,
            seconds: FIRST_SECONDS,
            target: plate.mean_gap,
            free: None,
            now,
            trail,
            recorded: None,
            playing: true,
            pressure_range: LEAST_RANGE.map(|ratio| ratio * plate.gas.ambient_pressure),
            force_range: [0.0; 2],
            plate,
        }
    }

    /// Takes the snapshots since the last call.
    pub fn drain(&mut self) {
        let taken = self.job.take();
        let Some(now) = taken.back().cloned() else { return };
        if now.failure.is_some() {
            (self.target, self.free) = (self.plate.mean_gap, None);
        }
        if self.free.is_some() {
            self.target = Hold::within_reach(&self.plate, now.reading.gap);
        }
        let time = |snapshot: &Arc<Snapshot>| snapshot.reading.time;
        if taken.front().zip(self.trail.back()).is_some_and(|(first, last)| time(first) < time(last)) {
            // Snapshots that were on their way when the film was put to rest no longer count.
            self.clear();
        }
        self.pressure_range = span(now.pressure.iter().copied().chain(self.pressure_range));
        self.force_range = span(taken.iter().map(|snapshot| snapshot.reading.force).chain(self.force_range));
        self.trail.extend(taken);
        let begin = now.reading.time - self.window();
        while self.trail.len() > SNAPSHOTS || self.trail.front().is_some_and(|first| time(first) < begin) {
            self.trail.pop_front();
        }
        self.now = now;
    }

    /// Puts the film to rest at the mean gap, and clears the charts.
    pub fn reset(&mut self) {
        (self.target, self.free, self.recorded, self.playing) = (self.plate.mean_gap, None, None, true);
        self.clear();
        self.job.reset();
    }

    fn clear(&mut self) {
        self.trail.clear();
        self.pressure_range = LEAST_RANGE.map(|ratio| ratio * self.plate.gas.ambient_pressure);
        self.force_range = [0.0; 2];
    }

    /// Sets how many seconds the leak time takes on screen.
    pub fn set_seconds(&mut self, seconds: f64) {
        self.seconds = seconds.clamp(*SECONDS.start(), *SECONDS.end());
        self.job.slow(self.slowed());
    }

    /// Holds the plate at `gap` \[m\], or as near as it may come.
    pub fn move_to(&mut self, gap: f64) {
        self.target = Hold::within_reach(&self.plate, gap);
        (self.free, self.recorded, self.playing) = (None, None, true);
        self.job.move_to(self.target);
    }

    /// Lets go of the plate: under a load it falls, or floats on the vibration; without a load it returns to its mean gap.
    pub fn let_go(&mut self, vibrates: bool) {
        if self.plate.load.is_none() {
            return self.move_to(self.plate.mean_gap);
        }
        (self.free, self.recorded, self.playing) = (Some(vibrates), None, true);
        self.job.let_go(vibrates);
    }

    /// Pauses or resumes the animation: the motion of the plate, or the replay of the recorded film.
    pub fn toggle_play(&mut self) {
        self.show(self.recorded, !self.playing);
    }

    /// Replays what the charts hold in slow motion, from the beginning or from where the replay was paused; at the end the plate is paused.
    pub fn replay(&mut self) {
        if let Some(first) = self.trail.front() {
            self.show(Some(first.reading.time), true);
        }
    }

    /// Shows the recorded film at this share of what the charts hold; at their end, the present film, paused.
    pub fn seek(&mut self, share: f64) {
        self.show_recorded((share * self.trail.len().saturating_sub(1) as f64).round() as usize);
    }

    /// Shows the recorded film `by` snapshots after the one shown.
    pub fn step(&mut self, by: i64) {
        self.show_recorded(self.place().saturating_add_signed(by as isize));
    }

    fn show_recorded(&mut self, place: usize) {
        let recorded = self.trail.get(place).filter(|_| place + 1 < self.trail.len());
        self.show(recorded.map(|at| at.reading.time), false);
    }

    fn show(&mut self, recorded: Option<f64>, playing: bool) {
        let goes_on = |hold: &Self| hold.recorded.is_none() && hold.playing;
        let before = goes_on(self);
        (self.recorded, self.playing) = (recorded, playing);
        if goes_on(self) != before {
            self.job.pause(before);
        }
    }

    /// Advances the replay by `elapsed` \[s\] of the clock. Returns whether anything moves.
    pub fn animate(&mut self, elapsed: f64) -> bool {
        let (Some(time), true) = (self.recorded, self.playing) else { return false };
        let on = time + elapsed / self.slowed();
        let ended = self.trail.back().is_none_or(|last| on >= last.reading.time);
        self.show(Some(on).filter(|_| !ended), !ended);
        true
    }

    /// Index of the snapshot shown among those recorded, oldest first.
    pub fn place(&self) -> usize {
        let newest = self.trail.len().saturating_sub(1);
        let place =
            |time| self.trail.partition_point(|snapshot| snapshot.reading.time <= time).clamp(1, newest + 1) - 1;
        self.recorded.map_or(newest, place)
    }

    /// Whether `scene` has a different plate.
    pub fn stale(&self, scene: &Scene) -> bool {
        !self.scene.same_model(scene)
    }

    /// Whether the plate has been at its mean gap for as long as the charts show.
    pub fn is_untouched(&self) -> bool {
        let at_rest = |gap: f64| gap == self.plate.mean_gap;
        let was_at_rest = self.trail.iter().all(|snapshot| at_rest(snapshot.reading.gap));
        at_rest(self.target) && was_at_rest && self.free.is_none() && self.recorded.is_none()
    }

    /// Gaps that it can be held at \[m\].
    pub fn reach(&self) -> [f64; 2] {
        Hold::reach(&self.plate)
    }

    /// The film as it is shown.
    pub fn shown(&self) -> &Snapshot {
        self.recorded.and_then(|_| self.trail.get(self.place())).unwrap_or(&self.now)
    }

    /// The highest mean absolute pressure since it was reset \[Pa\].
    pub fn highest_mean_pressure(&self) -> f64 {
        self.plate.gas.ambient_pressure + self.force_range[1] / self.plate.area()
    }

    /// Readings that the charts hold, oldest first.
    pub fn trail(&self) -> impl ExactSizeIterator<Item = &Reading> {
        self.trail.iter().map(|snapshot| &snapshot.reading)
    }

    /// Time of the film that the charts hold \[s\].
    pub fn window(&self) -> f64 {
        WINDOW / self.slowed()
    }

    /// Seconds on screen for one second of the film.
    pub fn slowed(&self) -> f64 {
        slowed(&self.plate, self.seconds)
    }
}
