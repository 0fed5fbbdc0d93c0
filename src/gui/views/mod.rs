//! Views: each draws one run at one phase of the cycle.
//!
//! A redraw touches the present frame only; what needs the whole recording is computed once for a run ([`scales`]).
//! Everything is drawn with the painter, on axes of our own ([`paint`]): one x axis is shared by all parts of a view.

mod field;
mod loads;
mod map;
pub mod motor;
mod paint;
pub mod plate;
mod sample;
mod scales;
mod series;
mod tooth;
mod wave;
