//! Changes of the state by commands, background work and time. Nothing is drawn here.

pub mod dialogs;
mod exports;
mod fit;
mod lessons;
mod links;
mod live;
mod pictures;
mod pins;
pub mod platform;
mod run;
mod scene;
mod sensitivity;
pub mod storage;
mod sweep;
mod tradeoff;
pub mod updater;
