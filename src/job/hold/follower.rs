//! What marches the film of a held plate: the gap follows the hand, the film follows the gap.

use crate::analysis::attempt::caught;
use crate::fidelity::Fidelity;
use crate::hold::{Hold, Reading, leak_time};
use crate::plan::Plan;
use crate::platform::Instant;
use crate::problem::{Numerics, Plate};
use std::time::Duration;

/// How often the film is marched on, and how much time at most is made up for at once.
pub(super) const TICK: Duration = Duration::from_millis(20);
const MOST: Duration = Duration::from_millis(60);
/// Snapshots that are kept at most: those of 10 s of the clock, and of some more where marching takes longer.
pub const SNAPSHOTS: usize = 512;
/// A hand is not faster than this \[s\]: the gap follows what is asked for with this time constant.
const HAND: f64 = 0.03;
/// Where the gap is what was asked for, a share of it, and |p/p_a − 1| below which the film is at rest.
const THERE: f64 = 1e-4;
const AT_REST: f64 = 1e-4;

/// The film at one instant.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Number, ascending.
    pub number: u64,
    /// Gap, force and what follows from them.
    pub reading: Reading,
    /// Nodes along x ≥ 0, and across y ≥ 0 (of a strip or a round plate one), from the middle \[m\]; of a round plate,
    /// those along x are radii.
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
pub(super) struct Target {
    pub(super) gap: f64,
    /// Seconds for a second of the film.
    pub(super) slowed: f64,
    pub(super) reset: bool,
    /// It is let go, and whether the face below it vibrates.
    pub(super) free: Option<bool>,
    /// Nothing moves, and no time passes.
    pub(super) paused: bool,
}

impl Target {
    /// Held at the mean gap.
    pub(super) fn first(plate: &Plate, slowed: f64) -> Self {
        Self { gap: plate.mean_gap, slowed, reset: false, free: None, paused: false }
    }
}

/// A plate, and how its film has been marched.
#[derive(Debug)]
pub(super) struct Follower {
    pub(super) hold: Hold,
    /// When it was last marched, if it has not rested since.
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

    /// Whether neither the plate nor the pressure moves, or may.
    pub(super) fn rests(&self, target: &Target) -> bool {
        let still = match target.free {
            Some(vibrates) => !vibrates && self.hold.is_still(),
            None => (target.gap - self.hold.gap()).abs() <= THERE * self.hold.gap(),
        };
        !target.reset && (target.paused || still && self.hold.unrest() <= AT_REST)
    }

    /// Marches the film on to the time `began`. Where that fails it is put to rest.
    pub(super) fn tick(&mut self, target: &Target, began: Instant) -> Snapshot {
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
            }
        }
        self.number += 1;
        let snapshot = self.snapshot(failure);
        // Of a plate that shakes, what a slow eye sees.
        Snapshot { reading: mean.unwrap_or(snapshot.reading), ..snapshot }
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
            failure,
        }
    }
}

/// Slow motion in which the leak time of `plate` at its mean gap takes `seconds`.
pub fn slowed(plate: &Plate, seconds: f64) -> f64 {
    seconds / leak_time(plate, plate.mean_gap)
}
