//! What a person edits: a scene, in the units of the field, as a TOML file, as `--set key=value`, or in the window.
//!
//! A [`Scene`] becomes a checked, SI [`crate::problem::Problem`] by [`crate::problem::Problem::new`]. Fields are named
//! as in the file, with their unit. [`PARAMETERS`] holds every key with its unit, range, default and meaning; nothing
//! else says so. Errors ([`SceneError`]) name file, line, key, value and what is allowed, and list all faults at once.
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
//! let problem = Problem::new(&scene)?;
//! assert_eq!(scene.set("film.min_spacing_nm", "3").unwrap_err().to_string(),
//!     "film.min_spacing_nm = 3 is out of range: allowed 5 to 10000 nm");
//! # Ok::<(), squeezefilm::scene::SceneError>(())
//! ```

mod access;
mod check;
pub mod compliance;
mod convert;
mod error;
mod nearest;
mod parameter;
mod parse;
pub mod presets;
pub mod table1;
mod value;
mod write;

pub use compliance::RowFault;
pub use error::{Fault, SceneError, What};
pub use parameter::{
    Belongs, NARROWEST_TOOTH, PARAMETERS, Parameter, ParameterKind, ROTOR_MODELS, Range, SCENES, Scale, TABLES,
    markdown,
};
pub use value::Value;
pub(crate) use value::{escaped, show_text};

use crate::problem::{Numerics, Slip};

/// The version of the file format this program reads and writes.
pub const SCHEMA: i64 = 1;

/// One scene: a preset, whether built in, on disk or in the window.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name, shown with every result.
    pub name: String,
    /// One line: what this scene is.
    pub about: String,
    /// What is to be solved.
    pub kind: Kind,
    /// Explicit numerics; each `None` is left to the fidelity.
    pub numerics: Numerics,
}

/// The kind of scene, with its tables.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A ring-type travelling-wave motor.
    Motor {
        /// The motor as a whole.
        motor: Motor,
        /// The stator and its teeth.
        stator: Stator,
        /// The rotor.
        rotor: Rotor,
        /// The gas film.
        film: Film,
    },
    /// A plate vibrating above a wall.
    Plate {
        /// The plate.
        plate: Plate,
        /// The gas film.
        film: Film,
    },
}

/// The table `[motor]`. Ranges are in [`PARAMETERS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Motor {
    /// Contact radius \[mm\].
    pub contact_radius_mm: f64,
    /// Wavelengths round the ring.
    pub waves: u32,
    /// Axial load on one wavelength \[N\].
    pub load_per_wave_n: f64,
    /// Dry friction coefficient.
    pub dry_friction: f64,
    /// Speed of the rotor \[rpm\], towards +x if positive.
    pub rotor_speed_rpm: f64,
}

/// The table `[stator]`. Ranges are in [`PARAMETERS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Stator {
    /// Frequency \[kHz\].
    pub frequency_khz: f64,
    /// Normal amplitude \[µm\].
    pub normal_amplitude_um: f64,
    /// Tangential amplitude \[µm\].
    pub tangential_amplitude_um: f64,
    /// Teeth in one wavelength.
    pub teeth_per_wave: u32,
    /// Tooth width along the ring \[mm\], 1 % to 100 % of the pitch.
    pub tooth_width_mm: f64,
    /// Radius of a crowned tooth top \[m\]; `None` is flat.
    pub tooth_radius_m: Option<f64>,
}

/// The table `[rotor]`. Ranges are in [`PARAMETERS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Rotor {
    /// Radial contact width \[mm\].
    pub contact_width_mm: f64,
    /// The compliance.
    pub model: RotorModel,
}

/// How the rotor's compliance is described. A third model, "ring", is reserved.
#[derive(Clone, Debug, PartialEq)]
pub enum RotorModel {
    /// A beam on an elastic foundation, in series with a local compliance.
    Beam {
        /// Decay length \[mm\].
        decay_length_mm: f64,
        /// Point compliance \[µm/N\].
        point_compliance_um_per_n: f64,
        /// Local compliance \[m²/N\].
        local_compliance_m2_per_n: f64,
    },
    /// Measured or computed elsewhere, see [`compliance`].
    Table {
        /// Rows of (wavenumber \[1/m\], compliance \[m²/N\]), wavenumbers ascending.
        compliance: Vec<(f64, f64)>,
    },
}

impl RotorModel {
    /// The name in the file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Beam { .. } => "beam",
            Self::Table { .. } => "table",
        }
    }
}

/// The table `[plate]`. Ranges are in [`PARAMETERS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Length \[mm\].
    pub length_mm: f64,
    /// Width \[mm\]; `None` is an infinitely wide strip.
    pub width_mm: Option<f64>,
    /// Mean gap \[µm\].
    pub mean_gap_um: f64,
    /// Amplitude \[µm\], smaller than the mean gap.
    pub amplitude_um: f64,
    /// Frequency \[kHz\].
    pub frequency_khz: f64,
}

/// The table `[film]`. Ranges are in [`PARAMETERS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Minimum spacing left by roughness \[nm\]; unused by a plate.
    pub min_spacing_nm: f64,
    /// Ambient pressure \[kPa\].
    pub ambient_pressure_kpa: f64,
    /// Viscosity \[µPa s\].
    pub viscosity_upa_s: f64,
    /// Mean free path at the ambient pressure \[nm\].
    pub mean_free_path_nm: f64,
    /// Slip law.
    pub slip: Slip,
    /// Whether the wedge (sliding) term is asked for; unused by a plate.
    pub shear: bool,
}

impl Scene {
    /// A motor with every key at its default: the fundamental case.
    pub fn motor() -> Self {
        let motor =
            Motor { contact_radius_mm: 0.0, waves: 0, load_per_wave_n: 0.0, dry_friction: 0.0, rotor_speed_rpm: 0.0 };
        let stator = Stator {
            frequency_khz: 0.0,
            normal_amplitude_um: 0.0,
            tangential_amplitude_um: 0.0,
            teeth_per_wave: 0,
            tooth_width_mm: 0.0,
            tooth_radius_m: None,
        };
        let rotor = Rotor { contact_width_mm: 0.0, model: blank_beam() };
        Self::with_defaults(Kind::Motor { motor, stator, rotor, film: blank_film() })
    }

    /// A plate with every key at its default: an infinitely wide strip.
    pub fn plate() -> Self {
        let plate = Plate { length_mm: 0.0, width_mm: None, mean_gap_um: 0.0, amplitude_um: 0.0, frequency_khz: 0.0 };
        Self::with_defaults(Kind::Plate { plate, film: blank_film() })
    }

    /// The kind of scene as named in the file: "motor" or "plate".
    pub fn scene(&self) -> &'static str {
        match self.kind {
            Kind::Motor { .. } => "motor",
            Kind::Plate { .. } => "plate",
        }
    }

    /// The film, which every scene has.
    pub fn film(&self) -> &Film {
        match &self.kind {
            Kind::Motor { film, .. } | Kind::Plate { film, .. } => film,
        }
    }

    /// The rotor model, if this is a motor.
    pub fn rotor_model(&self) -> Option<&RotorModel> {
        match &self.kind {
            Kind::Motor { rotor, .. } => Some(&rotor.model),
            Kind::Plate { .. } => None,
        }
    }

    /// The keys, but for name and description, in which this scene differs from `original`.
    pub fn changed<'a>(&'a self, original: &'a Self) -> impl Iterator<Item = &'static Parameter> + 'a {
        let told = self.parameters().filter(|parameter| !matches!(parameter.key, "name" | "about"));
        told.filter(move |parameter| self.get(parameter.key) != original.get(parameter.key))
    }

    /// What to call a scene that was made of `original`: `Fundamental case, changed: 3 keys`, unless it has a name of its own.
    pub fn title(&self, original: &Self) -> String {
        match self.changed(original).count() {
            keys if keys > 0 && self.name == original.name => {
                format!("{}, changed: {keys} {}", self.name, if keys == 1 { "key" } else { "keys" })
            }
            _ => self.name.clone(),
        }
    }

    /// Gives a scene that was made of `original` a name and a description that claim no more than is true: its [`Scene::title`], and
    /// what was changed. Words of its own are kept.
    pub fn retitle(&mut self, original: &Self) {
        let shown = |scene: &Self, Parameter { key, unit, .. }: &Parameter| match scene.get(key) {
            None => "none".to_owned(),
            Some(Value::Rows(_)) => "another table".to_owned(),
            Some(value) => format!("{value} {unit}").trim_end().to_owned(),
        };
        let changes = self.changed(original).map(|parameter| {
            format!("{} = {}, was {}", parameter.key, shown(self, parameter), shown(original, parameter))
        });
        let changes = changes.collect::<Vec<_>>().join("; ");
        let title = self.title(original);
        if !changes.is_empty() && self.about == original.about {
            self.about = format!("{} with {changes}.", original.name);
        }
        self.name = title;
    }

    fn with_defaults(kind: Kind) -> Self {
        let mut scene = Self { name: String::new(), about: String::new(), kind, numerics: Numerics::default() };
        for parameter in PARAMETERS {
            scene.reset(parameter);
        }
        scene
    }
}

/// A beam to be filled with defaults.
fn blank_beam() -> RotorModel {
    RotorModel::Beam { decay_length_mm: 0.0, point_compliance_um_per_n: 0.0, local_compliance_m2_per_n: 0.0 }
}

/// A film to be filled with defaults.
fn blank_film() -> Film {
    Film {
        min_spacing_nm: 0.0,
        ambient_pressure_kpa: 0.0,
        viscosity_upa_s: 0.0,
        mean_free_path_nm: 0.0,
        slip: Slip::None,
        shear: false,
    }
}
