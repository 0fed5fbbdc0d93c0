//! Work in the background: what it tells on the way, and what comes of it in the end. In a process it is done on a thread of its own
//! (`thread`), on a page in a worker (`page`).

#[cfg(target_arch = "wasm32")]
mod page;
#[cfg(not(target_arch = "wasm32"))]
mod thread;

#[cfg(target_arch = "wasm32")]
pub use page::Task;
#[cfg(not(target_arch = "wasm32"))]
pub use thread::Task;

/// What a task has told since it was last asked.
#[derive(Debug)]
pub struct News<M, R> {
    /// Messages, in order.
    pub messages: Vec<M>,
    /// Once nothing more will come: what the work returned, or the text of its panic.
    pub end: Option<Result<R, String>>,
}

/// All messages of a task and its end, for tests.
#[cfg(test)]
pub(super) fn to_the_end<M: Send + 'static, R: Send + 'static>(task: &Task<M, R>) -> (Vec<M>, Result<R, String>) {
    let mut seen = Vec::new();
    for _ in 0..6000 {
        let News { messages, end } = task.drain();
        seen.extend(messages);
        if let Some(end) = end {
            return (seen, end);
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    panic!("it has not ended: {} messages", seen.len());
}
