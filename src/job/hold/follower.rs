//! Marches the film of a held plate: the gap follows the hand, and the pressure follows the gap.

use crate::analysis::attempt::caught;
use crate::fidelity::Fidelity;
use crate::hold::{Hold, Reading, leak_time};
use crate::plan::Plan;
use crate::platform::Instant;
use crate::problem::{Numerics, Plate};
use std::time::Duration;

/// Interval at which the film is marched.
pub(super) const TICK: Duration = Duration::from_millis(20);
/// Longest interval of clock time that one tick catches up with.
const MOST: Duration = Duration::from_millis(60);
/// Most snapshots that are kept: those of 10 s of the clock, or of a longer time if marching takes longer than a tick.
pub const SNAPSHOTS: usize = 512;
/// Time constant \[s\] with which the gap follows the gap that is asked for: about that of a hand.
const HAND: f64 = 0.03;
/// Relative difference below which the gap is the one that is asked for.
const THERE: f64 = 1e-4;
/// |p/p_a − 1| below which the film is at rest.
const AT_REST: f64 = 1e-4;

/// The film at one instant.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Number, ascending.
    pub number: u64,
    /// Gap, force and what follows from them.
    pub reading: Reading,
    /// Nodes along x ≥ 0, from the middle \[m\]; of a round plate, radii. There is one node across a strip or a round plate.
    pub x: Vec<f64>,
    /// Nodes along y ≥ 0, across the plate, from the middle \[m\].
    pub y: Vec<f64>,
    /// Absolute pressure \[Pa\], `[ix][iy]`; of a plate that was let go the mean over the last cycle, as the force is.
    pub pressure: Vec<f64>,
    /// Speed of the film's time over the speed that was asked for: below 1 if marching takes too long for it.
    pub pace: f64,
    /// Whether the vibrating face has struck the plate since it was let go.
    pub struck: bool,
    /// Why the film was put to rest, if its march failed.
    pub failure: Option<String>,
}

/// Request of the hand to a held plate. Only the newest counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct HandTarget {
    pub(super) gap: f64,
    /// Seconds for a second of the film.
    pub(super) slowed: f64,
    pub(super) reset: bool,
    /// `Some` if the plate was let go; whether the face below it vibrates.
    pub(super) free: Option<bool>,
    /// Whether everything stands still, the film's time too.
    pub(super) paused: bool,
}

impl HandTarget {
    /// Held at the mean gap.
    pub(super) fn first(plate: &Plate, slowed: f64) -> Self {
        Self { gap: plate.mean_gap, slowed, reset: false, free: None, paused: false }
    }
}

/// A plate, and the state of its film.
#[derive(Debug)]
pub(super) struct Follower {
    pub(super) hold: Hold,
    /// When the film was last marched; `None` if it has rested since.
    pub(super) last: Option<Instant>,
    number: u64,
    pace: f64,
}

impl Follower {
    /// At rest at its mean gap.
    pub(super) fn new(plate: &Plate) -> Self {
        let plan = Plan::plate(plate, Fidelity::Standard, &Numerics::default());
        Self { hold: Hold::new(plate, &plan), last: None, number: 0, pace: 1.0 }
    }

    /// Whether neither the plate nor the pressure moves, or neither may.
    pub(super) fn rests(&self, target: &HandTarget) -> bool {
        let still = match target.free {
            Some(vibrates) => !vibrates && self.hold.is_still(),
            None => (target.gap - self.hold.gap()).abs() <= THERE * self.hold.gap(),
        };
        !target.reset && (target.paused || still && self.hold.unrest() <= AT_REST)
    }

    /// Marches the film to the time `began`. If that fails, the film is put to rest.
    pub(super) fn tick(&mut self, target: &HandTarget, began: Instant) -> Snapshot {
        let hold = &mut self.hold;
        let passed = self.last.map_or(TICK, |last| began.saturating_duration_since(last));
        self.last = Some(began);
        let elapsed = passed.min(MOST).as_secs_f64();
        if passed > Duration::ZERO {
            let share = elapsed / passed.as_secs_f64();
            self.pace += 0.2 * (share - self.pace);
        }
        let toward = target.gap - hold.gap();
        let near = toward.abs() <= THERE * hold.gap();
        let gap = if near { target.gap } else { hold.gap() + toward * (1.0 - (-elapsed / HAND).exp()) };
        let time = elapsed / target.slowed;
        let moved = caught(|| match target.free {
            _ if target.reset => Ok(None),
            Some(vibrates) => hold.fall(time, vibrates).map(Some),
            None => hold.advance(gap, time).map(|()| None),
        });
        let (mean, failure) = match moved {
            Ok(Ok(mean)) => (mean, None),
            Ok(Err(error)) => (None, Some(error.to_string())),
            Err(panic) => (None, Some(format!("the film failed: {panic}"))),
        };
        if target.reset || failure.is_some() {
            hold.reset();
        }
        self.number += 1;
        let snapshot = self.snapshot(failure);
        // Of a plate that vibrates, the gap without the vibration, and the mean force and pressure over the last cycle, are shown.
        match mean {
            Some(reading) => Snapshot { reading, pressure: self.hold.mean_pressure().collect(), ..snapshot },
            None => snapshot,
        }
    }

    pub(super) fn snapshot(&self, failure: Option<String>) -> Snapshot {
        let grid = self.hold.grid();
        Snapshot {
            number: self.number,
            reading: self.hold.reading(),
            x: grid.x.nodes.clone(),
            y: grid.y.nodes.clone(),
            pressure: self.hold.pressure().collect(),
            pace: self.pace,
            struck: self.hold.free().struck,
            failure,
        }
    }
}

/// The slow motion in which the leak time of `plate` at its mean gap takes `seconds`.
pub fn slowed(plate: &Plate, seconds: f64) -> f64 {
    seconds / leak_time(plate, plate.mean_gap)
}
