//! A transient from rest in the window: its scene, its cycles so far, and the outcome.

use super::background::Background;
use super::document::solved_alike;
use crate::fall::{self, Fall};
use crate::fidelity::Fidelity;
use crate::job::task::{BackgroundTask, News};
use crate::job::work::Posed;
use crate::scene::Scene;

/// A transient, under way or ended. Its cycles are of type `C`, its outcome is of type `R`.
#[derive(Debug)]
pub struct Transient<C, R> {
    /// The task: its messages are the cycles, its result is the outcome.
    pub work: Background<C, R>,
    /// The scene that was started, and its problem.
    pub posed: Posed,
    /// The fidelity of its grids and steps.
    pub fidelity: Fidelity,
    /// All cycles, in order; those of a start-up without their fields.
    pub cycles: Vec<C>,
    /// The outcome.
    pub ended: Option<Result<R, String>>,
}

/// A plate that was dropped on its vibration. The first of its cycles is the beginning.
pub type Dropped = Transient<fall::Cycle, Fall>;

impl<C: Send + 'static, R: Send + 'static> Transient<C, R> {
    /// A transient that has begun.
    pub fn new(task: BackgroundTask<C, R>, posed: Posed, fidelity: Fidelity) -> Self {
        Self { work: task.into(), posed, fidelity, cycles: Vec::new(), ended: None }
    }

    /// Takes the outcome, `cancelled` if there is none, and cancels the task if `scene` differs from the scene that was started. Returns
    /// the cycles since the last call.
    pub fn news(&mut self, scene: &Scene, cancelled: fn() -> R) -> Vec<C> {
        let News { messages, end } = self.work.news();
        if let Some(end) = end {
            self.ended = Some(end.map(|ended| ended.unwrap_or_else(cancelled)));
        }
        if self.stale(scene) {
            self.work.cancel();
        }
        messages
    }

    /// Whether `scene` differs from the scene that was started.
    pub fn stale(&self, scene: &Scene) -> bool {
        !solved_alike(&self.posed.scene, scene)
    }
}
