//! A held plate of a page: its film is marched when its snapshots are taken, before each redraw.

use super::follower::{Follower, HandTarget, Snapshot, TICK};
use crate::platform::Instant;
use crate::problem::Plate;
use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::Arc;

/// A held plate.
pub struct HeldPlate {
    pub(super) plate: Plate,
    held: RefCell<(Follower, HandTarget)>,
    now: fn() -> Instant,
    wake: Box<dyn Fn()>,
}

impl std::fmt::Debug for HeldPlate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("HeldPlate").field("held", &self.held).finish_non_exhaustive()
    }
}

impl HeldPlate {
    /// Holds `plate` at rest, with `slowed` seconds of the clock for a second of the film; with its first snapshot. `wake` asks
    /// for a redraw.
    pub fn start(
        plate: Plate,
        slowed: f64,
        now: fn() -> Instant,
        wake: impl Fn() + Send + 'static,
    ) -> std::io::Result<(Self, Snapshot)> {
        let (follower, target) = (Follower::new(&plate), HandTarget::first(&plate, slowed));
        let first = follower.snapshot(None);
        Ok((Self { plate, held: RefCell::new((follower, target)), now, wake: Box::new(wake) }, first))
    }

    pub(super) fn ask(&self, change: impl FnOnce(&mut HandTarget)) {
        change(&mut self.held.borrow_mut().1);
        (self.wake)();
    }

    /// The snapshots since the last call, oldest first.
    pub fn take(&self) -> VecDeque<Arc<Snapshot>> {
        let (follower, target) = &mut *self.held.borrow_mut();
        if follower.rests(target) {
            follower.last = None;
            return VecDeque::new();
        }
        (self.wake)();
        let began = (self.now)();
        if follower.last.is_some_and(|last| began.saturating_duration_since(last) < TICK / 2) {
            return VecDeque::new();
        }
        let snapshot = follower.tick(target, began);
        target.reset = false;
        if snapshot.failure.is_some() {
            (target.gap, target.free) = (follower.hold.gap(), None);
        }
        VecDeque::from([Arc::new(snapshot)])
    }
}
