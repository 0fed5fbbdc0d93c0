//! What the views show: nothing in here changes a result.

use crate::recording::Recording;

/// How the present run is looked at.
#[derive(Clone, Debug)]
pub struct View {
    /// Phase of the cycle shown, 0 ≤ phase < 1.
    pub phase: f64,
    /// Whether the animation runs.
    pub playing: bool,
    /// Seconds on screen for one cycle.
    pub seconds_per_cycle: f64,
    /// Tooth that is followed.
    pub tooth: usize,
    /// x under the pointer in any view \[m\], read out by all of them. Cleared at the start of a frame by the application.
    pub hover_x: Option<f64>,
    /// The same of the frame before, which views draw.
    pub cursor_x: Option<f64>,
}

impl Default for View {
    fn default() -> Self {
        Self { phase: 0.0, playing: true, seconds_per_cycle: 6.0, tooth: 0, hover_x: None, cursor_x: None }
    }
}

impl View {
    /// The recorded frame at the present phase.
    pub fn frame(&self, recording: &Recording) -> usize {
        let frames = recording.frames.max(1);
        ((self.phase * frames as f64) as usize).min(frames - 1)
    }
}
