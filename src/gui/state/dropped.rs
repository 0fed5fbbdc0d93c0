//! A plate that was dropped on its vibration: its scene, its motion so far, and the outcome.

use super::background::Background;
use super::document::solved_alike;
use crate::fall::{Cycle, Fall};
use crate::fidelity::Fidelity;
use crate::job::task::{News, TaskOf};
use crate::job::transient::DropWork;
use crate::job::work::Posed;
use crate::scene::Scene;
use crate::solution::Status;

/// A drop, under way or ended.
#[derive(Debug)]
pub struct Dropped {
    /// The task: its messages are the cycles, its result is the outcome.
    pub work: Background<Cycle, Fall>,
    /// The scene that was dropped, and its problem.
    pub posed: Posed,
    /// The fidelity of its grids and steps.
    pub fidelity: Fidelity,
    /// The plate at the end of each cycle so far; the first is the beginning.
    pub cycles: Vec<Cycle>,
    /// The outcome.
    pub ended: Option<Result<Fall, String>>,
}

impl Dropped {
    /// A drop that has begun.
    pub fn new(task: TaskOf<DropWork>, posed: Posed, fidelity: Fidelity) -> Self {
        Self { work: task.into(), posed, fidelity, cycles: Vec::new(), ended: None }
    }

    /// Takes progress and results since the last call; cancels the task if `scene` differs from the scene that was dropped.
    pub fn drain(&mut self, scene: &Scene) {
        let News { messages, end } = self.work.news();
        self.cycles.extend(messages);
        if let Some(end) = end {
            let cancelled =
                || Fall { status: Status::Cancelled, cycles: 0, floats: Err("cancelled".to_owned()), outcome: None };
            self.ended = Some(end.map(|ended| ended.unwrap_or_else(cancelled)));
        }
        if self.stale(scene) {
            self.work.cancel();
        }
    }

    /// Whether `scene` differs from the scene that was dropped.
    pub fn stale(&self, scene: &Scene) -> bool {
        !solved_alike(&self.posed.scene, scene)
    }
}
