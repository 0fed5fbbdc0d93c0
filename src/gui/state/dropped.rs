//! A plate that was dropped on its vibration: of which scene, its way so far, and how it ended.

use super::document::solved_alike;
use super::followed::news;
use crate::fall::{Cycle, Fall};
use crate::fidelity::Fidelity;
use crate::job::drop::DropTask;
use crate::job::task::News;
use crate::scene::Scene;

/// A drop, under way or ended.
#[derive(Debug)]
pub struct Dropped {
    task: Option<DropTask>,
    scene: Scene,
    /// Grids and steps are those of this fidelity.
    pub fidelity: Fidelity,
    /// The plate at the end of each cycle so far; the first is the beginning.
    pub cycles: Vec<Cycle>,
    /// How it ended.
    pub ended: Option<Result<Fall, String>>,
}

impl Dropped {
    /// A drop of `scene` that has begun.
    pub fn new(task: DropTask, scene: Scene, fidelity: Fidelity) -> Self {
        Self { task: Some(task), scene, fidelity, cycles: Vec::new(), ended: None }
    }

    /// Takes what has been computed since the last time.
    pub fn drain(&mut self) {
        let News { messages, end } = news(&mut self.task);
        self.cycles.extend(messages);
        if let Some(end) = end {
            self.ended = Some(end.unwrap_or_else(|panic| Err(format!("the solver failed: {panic}"))));
        }
    }

    /// Asks it to end.
    pub fn cancel(&self) {
        if let Some(task) = &self.task {
            task.cancel();
        }
    }

    /// Whether it goes on.
    pub fn running(&self) -> bool {
        self.task.is_some()
    }

    /// Whether `scene` is another one than was dropped.
    pub fn stale(&self, scene: &Scene) -> bool {
        !solved_alike(&self.scene, scene)
    }
}
