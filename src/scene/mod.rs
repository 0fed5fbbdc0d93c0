//! Scenes: what a person edits, in the units of the field, as a TOML file, by `--set key=value`, or in the window.
//!
//! A [`Scene`] holds the values of its keys. [`PARAMETERS`] has everything about each key: its unit, range, default and meaning, and the
//! scenes and models that have it. Reading, setting, resetting, checking and writing use that table and know no key by name.
//! [`crate::problem::Problem::try_from`] (`convert.rs`) turns a scene into a checked [`crate::problem::Problem`] in SI units; only there does
//! each key have a type of its own. An error ([`SceneError`]) names file, line, key, value and what is allowed, and lists up to ten faults.
//!
//! A file starts with `schema = 1`, which is required, because the meaning of the rest depends on it. Every other key may be
//! left out and then has its default: those of the fundamental case of Maeno and Bogy (1992), or for `scene = "plate"` of an
//! infinitely wide strip. An unknown key, or a key of another scene or rotor model, is an error.
//!
//! ```
//! use squeezefilm::{problem::Problem, scene::presets};
//!
//! let mut scene = presets::find("fundamental")?;
//! scene.set("film.min_spacing_nm", "100")?;
//! let problem = Problem::try_from(&scene)?;
//! assert_eq!(scene.set("film.min_spacing_nm", "3").unwrap_err().to_string(),
//!     "film.min_spacing_nm = 3 is out of range: allowed 5 to 10000 nm");
//! # Ok::<(), squeezefilm::scene::SceneError>(())
//! ```

mod accept;
mod cell;
mod comments;
pub mod compliance;
mod convert;
pub mod edges;
mod edit;
mod error;
mod follow;
pub mod heights;
mod keys;
mod nearest;
pub mod new_motor;
mod parameter;
mod parse;
pub mod presets;
pub mod quantity_text;
mod restate;
mod rules;
mod section;
pub mod table1;
mod value;
mod values;
mod write;

pub use error::{Fault, FaultKind, SCHEMA, SceneError};
pub use keys::PARAMETERS;
pub(crate) use nearest::nearest;
pub use parameter::{Belongs, Parameter, ParameterKind, Range, Scale};
pub use restate::SolvedPlate;
pub use value::Value;
pub(crate) use value::{escaped, is_unseen, show_text, show_up_to};
pub use values::{Kind, Scene};
