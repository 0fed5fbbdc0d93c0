//! The output of results: the objects of `--json`, the tables of `--out`, figures, animations and reports.

pub mod animation;
pub mod compare;
pub mod csv;
mod error;
mod estimates;
pub mod fall;
pub mod fields;
pub mod figure;
pub mod figures;
pub mod files;
pub mod fit;
pub mod html;
pub mod json;
#[cfg(feature = "video")]
mod mp4;
pub mod npz;
pub mod reproduce;
pub mod saved;
pub mod sensitivity;
pub mod stability;
pub mod startup;
pub mod surface;
pub mod sweep;
pub mod torque;
pub mod tradeoff;
pub mod vtk;
