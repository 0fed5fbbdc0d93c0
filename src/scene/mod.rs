//! What a person edits: a scene, in the units of the field, as a TOML file, as `--set key=value`, or in the window.
//!
//! A [`Scene`] holds the values of its keys; [`PARAMETERS`] says everything about each key: its unit, range, default,
//! meaning, and the scenes and models that have it. Reading, setting, resetting, checking and writing go through that
//! table and know no key by name. A scene becomes a checked, SI [`crate::problem::Problem`] by
//! [`crate::problem::Problem::try_from`] (`convert.rs`), the only place where keys get types of their own. Errors
//! ([`SceneError`]) name file, line, key, value and what is allowed, and list the first ten faults at once.
//!
//! A file starts with `schema = 1`, which is required, as the meaning of the rest depends on it. Everything else may be
//! left out and takes its default: the fundamental case of Maeno and Bogy (1992), or for `scene = "plate"` an
//! infinitely wide strip. An unknown key, or one of another scene or rotor model, is refused.
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
mod rules;
mod section;
pub mod table1;
mod value;
mod values;
mod write;

pub use error::{Fault, SCHEMA, SceneError, What};
pub use keys::{PARAMETERS, markdown};
pub use parameter::{Belongs, Cell, Parameter, ParameterKind, Range, Scale};
pub use value::Value;
pub(crate) use value::{escaped, show_text};
pub use values::{Kind, Scene};
