//! Views: each draws one run at one phase of the cycle.
//!
//! A redraw reads the two frames around the present instant only (`recording::sample`); what needs the whole recording is computed once for a run (`derived::scales`).
//! Waves, maps and the held plate are drawn with the painter, on axes of our own (`ui::paint`). Curves over axes are charts of egui_plot
//! (`inset::Inset`), which are dragged, zoomed and brought back by a double click. Until one is zoomed, all parts of a view share one x axis.

mod field;
mod frame;
pub mod history;
pub mod hold;
mod inset;
mod loads;
mod motor;
pub mod overlay;
mod plate;
mod pointer;
mod ring;
pub mod run;
mod series;
pub mod swept;
mod tooth;
mod velocity;
mod wave;
