//! Every key a scene can have: its unit, range, default and meaning. This table is the only place that says so; the
//! check of a file, `--set`, the sliders and the documentation all read it.

use super::value::show_number;
use crate::problem::{Flow, Slip, Teeth, Time, Wedge, Width};
use std::fmt::{self, Write as _};

/// An interval of allowed values, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
}

impl Range {
    /// The interval from `min` to `max`.
    pub const fn new(min: f64, max: f64) -> Self {
        Self { min, max }
    }

    /// Whether `value` lies inside; NaN never does.
    pub fn contains(&self, value: f64) -> bool {
        value >= self.min && value <= self.max
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", show_number(self.min), show_number(self.max))
    }
}

/// How a slider or a sweep should space the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps.
    Linear,
    /// Equal ratios.
    Log,
}

/// The type of a key's value, with the range and the default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterKind {
    /// A number.
    Number {
        /// What is accepted.
        range: Range,
        /// The part of `range` worth a slider.
        slider: Range,
        /// How the slider is spaced.
        scale: Scale,
        /// The value of an absent key; of an optional key, the value to start from when it is switched on.
        default: f64,
    },
    /// A whole number.
    Whole {
        /// Smallest allowed value.
        min: u32,
        /// Largest allowed value.
        max: u32,
        /// The value of an absent key; of an optional key, the value to start from when it is switched on.
        default: u32,
    },
    /// true or false.
    Flag {
        /// The value of an absent key.
        default: bool,
    },
    /// One of a few names.
    Choice {
        /// The names.
        options: &'static [&'static str],
        /// The value of an absent key.
        default: &'static str,
    },
    /// Free text.
    Text {
        /// The value of an absent key.
        default: &'static str,
    },
    /// Pairs of wavenumber \[1/m\] and compliance \[m²/N\], see [`super::compliance`].
    Rows,
    /// The path of a CSV file, read when the scene is; the scene keeps its rows, not the path.
    CsvPath,
}

/// The scenes, and within them the rotor models, that a key belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Belongs {
    /// Every scene.
    Any,
    /// Motor scenes.
    Motor,
    /// Motor scenes whose `rotor.model` is "beam".
    Beam,
    /// Motor scenes whose `rotor.model` is "table".
    Table,
    /// Plate scenes.
    Plate,
}

/// One key of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Dotted key, as in `--set`: `film.min_spacing_nm`.
    pub key: &'static str,
    /// Unit as shown to people; empty for a pure number, a choice or a text.
    pub unit: &'static str,
    /// Where the key is allowed.
    pub belongs: Belongs,
    /// For a key that may be left out for good: what its absence means. `None`: absence means the default.
    pub absent: Option<&'static str>,
    /// Type, range and default.
    pub kind: ParameterKind,
    /// One line: what it is.
    pub about: &'static str,
}

impl Parameter {
    /// The parameter of a dotted key.
    pub fn find(key: &str) -> Option<&'static Self> {
        PARAMETERS.iter().find(|parameter| parameter.key == key)
    }

    /// The TOML table the key is in; empty for the keys above all tables.
    pub fn table(&self) -> &'static str {
        self.key.split_once('.').map_or("", |(table, _)| table)
    }

    /// The key within its table.
    pub fn leaf(&self) -> &'static str {
        self.key.split_once('.').map_or(self.key, |(_, leaf)| leaf)
    }

    /// The key within its table in words, without its unit: `min spacing`.
    pub fn words(&self) -> String {
        // The longer endings before what they end in.
        const UNITS: [&str; 11] =
            ["_m2_per_n", "_um_per_n", "_upa_s", "_khz", "_kpa", "_rpm", "_mm", "_um", "_nm", "_m", "_n"];
        let stem = UNITS.iter().find_map(|ending| self.leaf().strip_suffix(ending));
        stem.filter(|_| !self.unit.is_empty()).unwrap_or(self.leaf()).replace('_', " ")
    }

    /// The range of a number or a whole number.
    pub fn range(&self) -> Option<Range> {
        match self.kind {
            ParameterKind::Number { range, .. } => Some(range),
            ParameterKind::Whole { min, max, .. } => Some(Range::new(f64::from(min), f64::from(max))),
            _ => None,
        }
    }

    /// What the key accepts, in words: `a number from 5 to 10000 nm`.
    pub fn accepts(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let mut words = match self.kind {
            ParameterKind::Number { range, .. } => format!("a number from {range}{unit}"),
            ParameterKind::Whole { min, max, .. } => format!("a whole number from {min} to {max}{unit}"),
            ParameterKind::Flag { .. } => "true or false".to_owned(),
            ParameterKind::Choice { options, .. } => {
                let quoted: Vec<_> = options.iter().map(|option| format!("\"{option}\"")).collect();
                format!("one of {}", quoted.join(", "))
            }
            ParameterKind::Text { .. } => "text in quotes".to_owned(),
            ParameterKind::Rows => "rows [wavenumber_per_m, compliance_m2_per_n]".to_owned(),
            ParameterKind::CsvPath => "the path of a CSV file".to_owned(),
        };
        if let Some(meaning) = self.absent {
            let _ = write!(words, ", or none ({meaning})");
        }
        words
    }

    /// The default in words.
    fn default_words(&self) -> String {
        if let Some(meaning) = self.absent {
            return format!("absent: {meaning}");
        }
        match self.kind {
            ParameterKind::Number { default, .. } => show_number(default),
            ParameterKind::Whole { default, .. } => default.to_string(),
            ParameterKind::Flag { default } => default.to_string(),
            ParameterKind::Choice { default, .. } | ParameterKind::Text { default } => format!("\"{default}\""),
            ParameterKind::Rows | ParameterKind::CsvPath => String::new(),
        }
    }
}

/// The tables of a scene file, in the order they are written.
pub const TABLES: &[&str] = &["motor", "stator", "rotor", "plate", "film", "numerics"];

/// The kinds of scene, the values of the key `scene`.
pub const SCENES: &[&str] = &["motor", "plate"];

/// The rotor models that can be chosen.
pub const ROTOR_MODELS: &[&str] = &["beam", "table"];

/// Narrowest tooth, as a share of the pitch; the widest is the pitch itself.
pub const NARROWEST_TOOTH: f64 = 0.01;

const fn number(
    key: &'static str,
    unit: &'static str,
    belongs: Belongs,
    range: (f64, f64),
    slider: (f64, f64),
    scale: Scale,
    default: f64,
    about: &'static str,
) -> Parameter {
    let kind = ParameterKind::Number {
        range: Range::new(range.0, range.1),
        slider: Range::new(slider.0, slider.1),
        scale,
        default,
    };
    Parameter { key, unit, belongs, absent: None, kind, about }
}

const fn whole(
    key: &'static str,
    belongs: Belongs,
    range: (u32, u32),
    default: u32,
    absent: Option<&'static str>,
    about: &'static str,
) -> Parameter {
    let kind = ParameterKind::Whole { min: range.0, max: range.1, default };
    Parameter { key, unit: "", belongs, absent, kind, about }
}

const fn other(key: &'static str, belongs: Belongs, kind: ParameterKind, about: &'static str) -> Parameter {
    Parameter { key, unit: "", belongs, absent: None, kind, about }
}

const fn choice(key: &'static str, options: &'static [&'static str], about: &'static str) -> Parameter {
    other(key, Belongs::Any, ParameterKind::Choice { options, default: "auto" }, about)
}

const fn optional(parameter: Parameter, meaning: &'static str) -> Parameter {
    Parameter { absent: Some(meaning), ..parameter }
}

use Scale::{Linear, Log};

const LEFT_OPEN: Option<&str> = Some("left to the fidelity");

/// Every key of a scene file except `schema` and `scene`, in the order they are written.
pub static PARAMETERS: &[Parameter] = &[
    other("name", Belongs::Any, ParameterKind::Text { default: "Untitled" }, "Name shown with every result"),
    other("about", Belongs::Any, ParameterKind::Text { default: "" }, "One line: what this scene is"),
    number(
        "motor.contact_radius_mm",
        "mm",
        Belongs::Motor,
        (1.0, 500.0),
        (5.0, 100.0),
        Log,
        29.0,
        "Radius at which the teeth touch the rotor",
    ),
    whole("motor.waves", Belongs::Motor, (1, 100), 7, None, "Wavelengths round the ring"),
    number(
        "motor.load_per_wave_n",
        "N",
        Belongs::Motor,
        (0.01, 100.0),
        (0.1, 20.0),
        Log,
        2.45,
        "Axial load on one wavelength",
    ),
    number(
        "motor.dry_friction",
        "",
        Belongs::Motor,
        (0.0, 2.0),
        (0.0, 1.0),
        Linear,
        0.7,
        "Friction coefficient where tooth and rotor touch",
    ),
    number(
        "motor.rotor_speed_rpm",
        "rpm",
        Belongs::Motor,
        (-10000.0, 10000.0),
        (-300.0, 300.0),
        Linear,
        0.0,
        "Speed of the rotor, towards +x (against the wave) if positive",
    ),
    number(
        "stator.frequency_khz",
        "kHz",
        Belongs::Motor,
        (0.001, 10000.0),
        (1.0, 200.0),
        Log,
        30.0,
        "Frequency of the vibration",
    ),
    number(
        "stator.normal_amplitude_um",
        "µm",
        Belongs::Motor,
        (0.0, 20.0),
        (0.0, 5.0),
        Linear,
        1.3,
        "Amplitude of the travelling wave, normal to the face",
    ),
    number(
        "stator.tangential_amplitude_um",
        "µm",
        Belongs::Motor,
        (0.0, 20.0),
        (0.0, 5.0),
        Linear,
        1.0,
        "Amplitude of the tooth tops along the ring",
    ),
    whole("stator.teeth_per_wave", Belongs::Motor, (1, 64), 9, None, "Teeth in one wavelength"),
    number(
        "stator.tooth_width_mm",
        "mm",
        Belongs::Motor,
        (1e-6, 3142.0),
        (0.1, 5.0),
        Linear,
        1.7353,
        "Width of a tooth along the ring; from 1 % to 100 % of the tooth pitch",
    ),
    optional(
        number(
            "stator.tooth_radius_m",
            "m",
            Belongs::Motor,
            (0.01, 1e6),
            (1.0, 100.0),
            Log,
            6.5,
            "Radius of a crowned tooth top",
        ),
        "flat teeth",
    ),
    number(
        "rotor.contact_width_mm",
        "mm",
        Belongs::Motor,
        (0.01, 10.0),
        (0.05, 5.0),
        Log,
        0.3,
        "Radial width of the contact",
    ),
    other(
        "rotor.model",
        Belongs::Motor,
        ParameterKind::Choice { options: ROTOR_MODELS, default: "beam" },
        "How the rotor's compliance is described",
    ),
    number(
        "rotor.decay_length_mm",
        "mm",
        Belongs::Beam,
        (0.1, 100.0),
        (0.5, 20.0),
        Log,
        4.0,
        "Length over which the deflection under a point load dies out",
    ),
    number(
        "rotor.point_compliance_um_per_n",
        "µm/N",
        Belongs::Beam,
        (1e-3, 100.0),
        (0.05, 10.0),
        Log,
        0.64,
        "Deflection of the beam under a unit point load",
    ),
    number(
        "rotor.local_compliance_m2_per_n",
        "m²/N",
        Belongs::Beam,
        (0.0, 1e-7),
        (0.0, 1e-9),
        Linear,
        1.05e-10,
        "Local (Winkler) compliance in series with the beam",
    ),
    other(
        "rotor.compliance_csv",
        Belongs::Table,
        ParameterKind::CsvPath,
        "CSV file of the compliance, relative to the preset's folder",
    ),
    other("rotor.compliance", Belongs::Table, ParameterKind::Rows, "Compliance per wavenumber, inline"),
    number(
        "plate.length_mm",
        "mm",
        Belongs::Plate,
        (0.001, 1000.0),
        (0.01, 50.0),
        Log,
        1.0,
        "Length of the plate along x",
    ),
    optional(
        number(
            "plate.width_mm",
            "mm",
            Belongs::Plate,
            (0.001, 1000.0),
            (0.01, 50.0),
            Log,
            1.0,
            "Width of the plate along y",
        ),
        "infinitely wide strip, forces per metre of width",
    ),
    number(
        "plate.mean_gap_um",
        "µm",
        Belongs::Plate,
        (0.01, 1000.0),
        (0.1, 100.0),
        Log,
        1.0,
        "Mean gap under the plate",
    ),
    number(
        "plate.amplitude_um",
        "µm",
        Belongs::Plate,
        (0.0, 1000.0),
        (0.0, 10.0),
        Linear,
        0.5,
        "Amplitude of the vibration; smaller than the mean gap",
    ),
    number(
        "plate.frequency_khz",
        "kHz",
        Belongs::Plate,
        (0.001, 10000.0),
        (0.01, 1000.0),
        Log,
        30.0,
        "Frequency of the vibration",
    ),
    number(
        "film.min_spacing_nm",
        "nm",
        Belongs::Any,
        (5.0, 10000.0),
        (5.0, 2000.0),
        Log,
        200.0,
        "Spacing that roughness leaves where the faces touch; unused by a plate",
    ),
    number(
        "film.ambient_pressure_kpa",
        "kPa",
        Belongs::Any,
        (0.01, 1000.0),
        (1.0, 1000.0),
        Log,
        101.325,
        "Pressure of the gas around",
    ),
    number(
        "film.viscosity_upa_s",
        "µPa s",
        Belongs::Any,
        (1.0, 1000.0),
        (5.0, 50.0),
        Log,
        18.1,
        "Viscosity of the gas",
    ),
    number(
        "film.mean_free_path_nm",
        "nm",
        Belongs::Any,
        (0.0, 1e9),
        (0.0, 500.0),
        Linear,
        64.0,
        "Mean free path of the gas at the ambient pressure given",
    ),
    other(
        "film.slip",
        Belongs::Any,
        ParameterKind::Choice { options: Slip::NAMES, default: "first-order" },
        "How the gas slips at the walls",
    ),
    other(
        "film.shear",
        Belongs::Any,
        ParameterKind::Flag { default: true },
        "Whether sliding drags gas along (the wedge term); unused by a plate",
    ),
    whole(
        "numerics.film_nodes_along",
        Belongs::Any,
        (5, 2001),
        101,
        LEFT_OPEN,
        "Film nodes along a tooth or plate, both ends counted",
    ),
    whole(
        "numerics.film_nodes_across",
        Belongs::Any,
        (3, 501),
        21,
        LEFT_OPEN,
        "Film nodes across the full width, both ends counted",
    ),
    whole(
        "numerics.contact_nodes",
        Belongs::Any,
        (19, 5001),
        361,
        LEFT_OPEN,
        "Contact nodes on one wavelength for --method paper, both ends counted",
    ),
    whole("numerics.steps_per_cycle", Belongs::Any, (8, 100_000), 360, LEFT_OPEN, "Time steps in one cycle"),
    optional(
        number(
            "numerics.tolerance",
            "",
            Belongs::Any,
            (1e-9, 1e-2),
            (1e-7, 1e-2),
            Log,
            1e-4,
            "Relative change of the trapped gas at which the cycle counts as repeating",
        ),
        "left to the fidelity",
    ),
    choice(
        "numerics.wedge",
        Wedge::NAMES,
        "The wedge term of sliding: solved (on), left out (off), or as the scene needs",
    ),
    choice(
        "numerics.teeth",
        Teeth::NAMES,
        "Teeth whose film is solved: one by lag symmetry, or all; the result is the same",
    ),
    choice(
        "numerics.width",
        Width::NAMES,
        "Width of the film that is solved: half by symmetry, or full; the result is the same",
    ),
    choice("numerics.flow", Flow::NAMES, "Where the film flows: in the plane, or only across or along a tooth"),
    choice("numerics.time", Time::NAMES, "The film in time: marched step by step, or trapped, with no time to move"),
];

/// All keys as a Markdown table, for the documentation.
pub fn markdown() -> String {
    let mut page = "| key | unit | accepts | default | meaning |\n| --- | --- | --- | --- | --- |\n".to_owned();
    for p in PARAMETERS {
        let accepts = match p.range() {
            Some(range) => range.to_string(),
            None => Parameter { absent: None, ..*p }.accepts(),
        };
        let _ = writeln!(page, "| `{}` | {} | {accepts} | {} | {} |", p.key, p.unit, p.default_words(), p.about);
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn keys_are_unique_and_in_a_known_table() {
        let keys: HashSet<_> = PARAMETERS.iter().map(|p| p.key).collect();
        assert_eq!(keys.len(), PARAMETERS.len());
        for p in PARAMETERS {
            assert!(p.table().is_empty() || TABLES.contains(&p.table()), "{}", p.key);
        }
    }

    #[test]
    fn keys_are_written_table_by_table() {
        let mut tables: Vec<_> = PARAMETERS.iter().map(Parameter::table).collect();
        tables.dedup();
        assert_eq!(tables[0], "");
        assert_eq!(&tables[1..], TABLES);
    }

    #[test]
    fn defaults_and_sliders_are_inside_the_range() {
        for p in PARAMETERS {
            match p.kind {
                ParameterKind::Number { range, slider, scale, default } => {
                    assert!(range.contains(default) && slider.contains(default), "{}", p.key);
                    assert!(range.contains(slider.min) && range.contains(slider.max), "{}", p.key);
                    assert!(slider.min < slider.max, "{}", p.key);
                    assert!(scale == Linear || slider.min > 0.0, "{}: a log slider from zero", p.key);
                }
                ParameterKind::Whole { min, max, default } => {
                    assert!((min..=max).contains(&default), "{}", p.key);
                }
                ParameterKind::Choice { options, default } => assert!(options.contains(&default), "{}", p.key),
                _ => {}
            }
        }
    }

    #[test]
    fn the_unit_is_the_one_in_the_key() {
        let endings = [
            ("_mm", "mm"),
            ("_um", "µm"),
            ("_nm", "nm"),
            ("_khz", "kHz"),
            ("_kpa", "kPa"),
            ("_rpm", "rpm"),
            ("_upa_s", "µPa s"),
            ("_um_per_n", "µm/N"),
            ("_m2_per_n", "m²/N"),
            ("_radius_m", "m"),
            ("_wave_n", "N"),
        ];
        for p in PARAMETERS.iter().filter(|p| !p.unit.is_empty()) {
            assert!(endings.iter().any(|(ending, unit)| p.key.ends_with(ending) && p.unit == *unit), "{}", p.key);
        }
    }

    #[test]
    fn keys_are_put_into_words() {
        for (key, words) in [
            ("rotor.local_compliance_m2_per_n", "local compliance"),
            ("rotor.point_compliance_um_per_n", "point compliance"),
            ("motor.load_per_wave_n", "load per wave"),
            ("film.min_spacing_nm", "min spacing"),
            ("motor.waves", "waves"),
        ] {
            assert_eq!(Parameter::find(key).unwrap().words(), words);
        }
    }

    #[test]
    fn markdown_has_a_row_per_key() {
        assert_eq!(markdown().lines().count(), PARAMETERS.len() + 2);
        assert!(markdown().contains("| `film.min_spacing_nm` | nm | 5 to 10000 | 200 |"));
    }
}
