//! Data for drawing, derived from runs and scenes: scales, curves, samples, texts. No egui in here, and no state.

pub mod format;
pub mod ring;
pub mod scales;
pub mod sliders;
pub mod words;
