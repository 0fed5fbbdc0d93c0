//! Work in the background: its messages on the way, and its result in the end. In a process it is done on a thread of its own
//! (`thread`), on a page in a worker (`page`).

#[cfg(target_arch = "wasm32")]
mod page;
#[cfg(not(target_arch = "wasm32"))]
mod thread;

#[cfg(target_arch = "wasm32")]
pub use page::BackgroundTask;
#[cfg(not(target_arch = "wasm32"))]
pub use thread::BackgroundTask;

pub use super::work::News;
use super::work::Work;

/// The task that does the work `W`.
pub type TaskOf<W> = BackgroundTask<<W as Work>::Message, <W as Work>::Output>;
