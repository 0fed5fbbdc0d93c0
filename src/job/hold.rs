//! A plate held by hand, that follows the hand in slow motion.
//!
//! Its film is marched on while the plate moves or the pressure still relaxes, paced by the clock. Only the newest gap that is asked for
//! counts. What is published is bounded: the newest snapshots since they were last taken. In a process a named thread marches
//! (`thread`), and sleeps when nothing moves; a page marches before each redraw (`page`).

mod follower;
#[cfg(target_arch = "wasm32")]
mod page;
#[cfg(not(target_arch = "wasm32"))]
mod thread;

use follower::Target;
pub use follower::{SNAPSHOTS, Snapshot, slowed};
#[cfg(target_arch = "wasm32")]
pub use page::HeldPlate;
#[cfg(not(target_arch = "wasm32"))]
pub use thread::HeldPlate;

use crate::hold::Hold;

/// What is asked of a held plate, wherever it is marched.
impl HeldPlate {
    /// Moves the plate to `gap` \[m\], or as near as it may come.
    pub fn move_to(&self, gap: f64) {
        let gap = Hold::within_reach(&self.plate, gap);
        self.ask(|target| *target = Target { gap, free: None, paused: false, ..*target });
    }

    /// Stops plate, film and their clock, or lets them go on from where they are, and as fast.
    pub fn pause(&self, paused: bool) {
        self.ask(|target| target.paused = paused);
    }

    /// Lets a plate under a load go, above a face that vibrates or stands still.
    pub fn let_go(&self, vibrates: bool) {
        self.ask(|target| (target.free, target.paused) = (Some(vibrates), false));
    }

    /// Takes `slowed` seconds for a second of the film from now on.
    pub fn slow(&self, slowed: f64) {
        self.ask(|target| target.slowed = slowed);
    }

    /// Puts the film to rest at the mean gap.
    pub fn reset(&self) {
        self.ask(|target| *target = Target { reset: true, ..Target::first(&self.plate, target.slowed) });
    }
}
