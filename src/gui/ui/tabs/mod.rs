//! What can be in the middle of the window, one of them at a time: the motion is in `views`, the others are here.

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
