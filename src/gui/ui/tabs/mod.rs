//! The tabs of the middle of the window, one shown at a time. The motion is drawn by `views`, the others here.

pub mod compare;
mod dropped;
pub mod exact;
mod face;
pub mod fit;
pub mod hold;
pub mod labels;
pub mod rotor;
pub mod sensitivity;
pub mod startup;
mod surface;
pub mod sweep;
pub mod torque;
pub mod tradeoff;
