//! Data for drawing, derived from runs and scenes: scales, curves, samples, texts. This module does not use egui and has no state.

pub mod format;
pub mod ring;
pub mod scales;
pub mod sliders;
pub mod words;
