//! A plate held by hand, which follows the hand in slow motion.
//!
//! Its film is marched, paced by the clock, while the plate moves or the pressure still relaxes. Only the newest gap that is asked for
//! counts. The snapshots that wait to be taken are bounded: the oldest are dropped. In a process a named thread marches the film
//! (`thread`), and sleeps when nothing moves. A page marches it before each redraw (`page`).

mod follower;
#[cfg(target_arch = "wasm32")]
mod page;
#[cfg(not(target_arch = "wasm32"))]
mod thread;

use follower::HandTarget;
pub use follower::{SNAPSHOTS, Snapshot, slowed};
#[cfg(target_arch = "wasm32")]
pub use page::HeldPlate;
#[cfg(not(target_arch = "wasm32"))]
pub use thread::HeldPlate;

use crate::hold::Hold;

/// Requests to a held plate, the same in a process and on a page.
impl HeldPlate {
    /// Moves the plate to the gap `gap` \[m\], or to the nearest one that is allowed.
    pub fn move_to(&self, gap: f64) {
        let gap = Hold::within_reach(&self.plate, gap);
        self.ask(|target| *target = HandTarget { gap, free: None, paused: false, ..*target });
    }

    /// Stops the plate, the film and their clock, or lets them go on from where they are, with the same speed.
    pub fn pause(&self, paused: bool) {
        self.ask(|target| target.paused = paused);
    }

    /// Lets go of a plate under a load. The face below it vibrates or stands still.
    pub fn let_go(&self, vibrates: bool) {
        self.ask(|target| (target.free, target.paused) = (Some(vibrates), false));
    }

    /// Sets the slow motion: `slowed` seconds of the clock for a second of the film.
    pub fn slow(&self, slowed: f64) {
        self.ask(|target| target.slowed = slowed);
    }

    /// Puts the plate and the film to rest at the mean gap.
    pub fn reset(&self) {
        self.ask(|target| *target = HandTarget { reset: true, ..HandTarget::first(&self.plate, target.slowed) });
    }
}
