//! The description of a key of a scene: its unit, range, default and meaning, and the scenes that have it.

use super::value::{Value, show_number};
use crate::digits::uncapitalised;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The options of a key: any that are given here, then the names of the entries of a table.
macro_rules! names {
    ($($first:literal,)* $table:ident) => {{
        const FIRST: &[&str] = &[$($first),*];
        const NAMES: &[&str] = &{
            let mut names = [""; FIRST.len() + $table.len()];
            let mut i = 0;
            while i < names.len() {
                names[i] = if i < FIRST.len() { FIRST[i] } else { $table[i - FIRST.len()].name };
                i += 1;
            }
            names
        };
        NAMES
    }};
}
pub(super) use names;

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

/// The spacing of the values of a slider, a sweep or an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal ratios.
    Log,
}

impl Scale {
    /// Where a value is on an axis: on a logarithmic one equal ratios are equal steps.
    pub fn place(self, value: f64) -> f64 {
        if self == Self::Log { value.log10() } else { value }
    }
}

/// The type of a key's value, with the range and the default.
#[derive(Clone, Copy, Debug)]
pub enum ParameterKind {
    /// A number.
    Number {
        /// The allowed values.
        range: Range,
        /// The range of the slider, a part of `range`.
        slider: Range,
        /// The spacing of the slider.
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
    /// A table: rows of two numbers, see [`super::compliance`].
    Rows {
        /// The two columns.
        columns: &'static [Parameter; 2],
    },
    /// The path of a CSV file, which is read together with the scene. The scene keeps the values that follow from the file, not the path.
    CsvPath {
        /// The key of the table that is in the file; `None` of measured heights, from which several numbers follow
        /// ([`super::heights::keys_of`]). Those that the preset gives are not replaced.
        table: Option<&'static str>,
    },
    /// An array of tables.
    Records {
        /// The keys of each table. Their names have no dot.
        columns: &'static [Parameter],
        /// Fewest tables.
        fewest: usize,
        /// The value of an absent key: a value for each column of each table.
        default: fn() -> Vec<Vec<Value>>,
    },
}

/// The scenes that a key belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Belongs {
    /// Every scene.
    Any,
    /// Every scene, but the results of a plate do not depend on it. The file of a plate may have it; setting or varying it is an error.
    IdleOnPlate,
    /// Motor scenes.
    Motor,
    /// Plate scenes.
    Plate,
}

/// A key that chooses a model, and those of its values with which a scene has the key in question.
pub(super) type Model = (&'static str, &'static [&'static str]);

/// One key of a scene. Two are equal if their keys are.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Dotted key, as in `--set`: `film.min_spacing_nm`.
    pub key: &'static str,
    /// Unit as shown to people; empty for a pure number, a choice or a text.
    pub unit: &'static str,
    /// The scenes that have it.
    pub belongs: Belongs,
    /// The models that have it, of which a scene needs one. If empty, it does not depend on a model.
    pub when: &'static [Model],
    /// Of an optional key that can be given in place of another one: that other key.
    pub instead_of: Option<&'static str>,
    /// For an optional key: the meaning of its absence. `None` if an absent key has its default.
    pub absent: Option<&'static str>,
    /// For an optional key: what its checkbox says. Otherwise empty.
    pub switch: &'static str,
    /// Its name, if its key says too little.
    pub name: Option<&'static str>,
    /// Type, range and default.
    pub kind: ParameterKind,
    /// Its meaning in one line.
    pub about: &'static str,
}

impl PartialEq for Parameter {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

/// The units of the field: the ending of a key, the unit as it is shown, and its conversion to SI (`rpm` to turns per second). An ending
/// comes before shorter ones that it ends in.
const UNITS: [(&str, &str, Per); 16] = [
    ("_per_mm2", "1/mm²", Per::Times(1e6)),
    ("_m2_per_n", "m²/N", Per::One),
    ("_um_per_n", "µm/N", Per::Over(1e6)),
    ("_mm_per_s", "mm/s", Per::Over(1e3)),
    ("_upa_s", "µPa·s", Per::Over(1e6)),
    ("_gpa", "GPa", Per::Times(1e9)),
    ("_khz", "kHz", Per::Times(1e3)),
    ("_kpa", "kPa", Per::Times(1e3)),
    ("_rpm", "rpm", Per::Over(60.0)),
    ("_mm", "mm", Per::Over(1e3)),
    ("_um", "µm", Per::Over(1e6)),
    ("_nm", "nm", Per::Over(1e9)),
    ("_m", "m", Per::One),
    ("_n", "N", Per::One),
    ("_g", "g", Per::Over(1e3)),
    ("_c", "°C", Per::Above(273.15)),
];

/// The conversion of a number to SI. Division by a power of ten, which is exact, rounds once: 200 nm becomes the double nearest to 2e-7 m.
/// Multiplication by 1e-9, which is not exact itself, would round twice.
#[derive(Clone, Copy)]
enum Per {
    One,
    Times(f64),
    Over(f64),
    Above(f64),
}

impl Parameter {
    /// A parameter that every model has, and that replaces no other; its value is a pure number or none.
    pub(super) const fn new(key: &'static str, belongs: Belongs, kind: ParameterKind, about: &'static str) -> Self {
        Self { key, unit: "", belongs, when: &[], instead_of: None, absent: None, switch: "", name: None, kind, about }
    }

    pub(super) const fn named(self, name: &'static str) -> Self {
        Self { name: Some(name), ..self }
    }

    /// The TOML table the key is in; empty for the keys above all tables.
    pub fn table(&self) -> &'static str {
        self.key.split_once('.').map_or("", |(table, _)| table)
    }

    /// The key within its table.
    pub fn leaf(&self) -> &'static str {
        self.key.split_once('.').map_or(self.key, |(_, leaf)| leaf)
    }

    /// Its name as part of a sentence, or of an axis: `minimum spacing H_m`. Of a value in an array of tables also that of its table:
    /// `part flange r outer`.
    pub fn words(&self) -> String {
        let in_array = self.key.matches('.').count() > 1;
        self.name.filter(|_| !in_array).map_or_else(|| self.key_words(), uncapitalised)
    }

    /// The key within its table in words, without its unit: `min spacing`.
    pub(crate) fn key_words(&self) -> String {
        let stem = UNITS.iter().find_map(|(ending, ..)| self.leaf().strip_suffix(ending));
        stem.filter(|_| !self.unit.is_empty()).unwrap_or(self.leaf()).replace(['_', '.'], " ")
    }

    /// `9.5 nm`: a number of this key, with its unit.
    pub fn with_unit(&self, number: impl fmt::Display) -> String {
        format!("{number} {}", self.unit).trim_end().to_owned()
    }

    pub(super) fn si(&self, value: f64) -> f64 {
        match UNITS.iter().find(|(_, unit, _)| *unit == self.unit) {
            Some((.., Per::Times(factor))) => value * factor,
            Some((.., Per::Over(divisor))) => value / divisor,
            Some((.., Per::Above(zero))) => zero + value,
            _ => value,
        }
    }

    /// The range of a number or a whole number.
    pub fn range(&self) -> Option<Range> {
        match self.kind {
            ParameterKind::Number { range, .. } => Some(range),
            ParameterKind::Whole { min, max, .. } => Some(Range::new(f64::from(min), f64::from(max))),
            _ => None,
        }
    }

    /// The names of a choice; none of anything else.
    pub fn options(&self) -> &'static [&'static str] {
        match self.kind {
            ParameterKind::Choice { options, .. } => options,
            _ => &[],
        }
    }

    /// The value of an absent key; `None` if its absence has a meaning of its own.
    pub fn default(&self) -> Option<Value> {
        self.usual().filter(|_| self.absent.is_none())
    }

    /// The default, and the value that an optional key has at first when it is switched on.
    pub fn usual(&self) -> Option<Value> {
        Some(match self.kind {
            ParameterKind::Number { default, .. } => Value::Number(default),
            ParameterKind::Whole { default, .. } => Value::Whole(i64::from(default)),
            ParameterKind::Flag { default } => Value::Flag(default),
            ParameterKind::Choice { default, .. } | ParameterKind::Text { default } => Value::Text(default.to_owned()),
            ParameterKind::Rows { .. } => Value::Rows(Vec::new()),
            ParameterKind::Records { default, .. } => Value::Records(default()),
            ParameterKind::CsvPath { .. } => return None,
        })
    }

    /// Accepted values in words: `a number from 5 to 10000 nm`; of an optional key also that it may be absent.
    pub fn accepts(&self) -> String {
        self.accepts_if_given() + &self.or_none()
    }

    /// Meaning of the absence of an optional key, in words; empty if the key is required.
    pub(super) fn or_none(&self) -> String {
        self.absent.map_or_else(String::new, |meaning| format!(", or none ({meaning})"))
    }

    /// Accepted values in words, if the key is given.
    pub(super) fn accepts_if_given(&self) -> String {
        match self.kind {
            ParameterKind::Number { range, .. } => format!("a number from {}", self.with_unit(range)),
            ParameterKind::Whole { min, max, .. } => format!("a whole number from {min} to {}", self.with_unit(max)),
            ParameterKind::Flag { .. } => "true or false".to_owned(),
            ParameterKind::Choice { options, .. } => {
                let quoted: Vec<_> = options.iter().map(|option| format!("\"{option}\"")).collect();
                format!("one of {}", quoted.join(", "))
            }
            ParameterKind::Text { .. } => "text in quotes".to_owned(),
            ParameterKind::Rows { columns: [first, second] } => format!("rows [{}, {}]", first.key, second.key),
            ParameterKind::Records { columns, .. } => {
                let keys: Vec<_> = columns.iter().map(|column| column.key).collect();
                format!("tables with {}", keys.join(", "))
            }
            ParameterKind::CsvPath { .. } => "the path of a CSV file".to_owned(),
        }
    }
}

pub(super) const fn number(
    key: &'static str,
    unit: &'static str,
    belongs: Belongs,
    range: (f64, f64),
    slider: (f64, f64),
    scale: Scale,
    default: f64,
    about: &'static str,
) -> Parameter {
    let (range, slider) = (Range::new(range.0, range.1), Range::new(slider.0, slider.1));
    Parameter { unit, ..Parameter::new(key, belongs, ParameterKind::Number { range, slider, scale, default }, about) }
}

pub(super) const fn whole(
    key: &'static str,
    belongs: Belongs,
    (min, max): (u32, u32),
    default: u32,
    about: &'static str,
) -> Parameter {
    Parameter::new(key, belongs, ParameterKind::Whole { min, max, default }, about)
}

pub(super) const fn choice(
    key: &'static str,
    belongs: Belongs,
    options: &'static [&'static str],
    default: &'static str,
    about: &'static str,
) -> Parameter {
    Parameter::new(key, belongs, ParameterKind::Choice { options, default }, about)
}

pub(super) const fn flag(key: &'static str, belongs: Belongs, default: bool, about: &'static str) -> Parameter {
    Parameter::new(key, belongs, ParameterKind::Flag { default }, about)
}

pub(super) const fn text(key: &'static str, default: &'static str, about: &'static str) -> Parameter {
    Parameter::new(key, Belongs::Any, ParameterKind::Text { default }, about)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::PARAMETERS;

    #[test]
    fn the_unit_is_the_one_in_the_key() {
        for p in PARAMETERS.iter().filter(|p| !p.unit.is_empty()) {
            let (_, unit, _) = UNITS.iter().find(|(ending, ..)| p.key.ends_with(ending)).unwrap();
            assert_eq!(*unit, p.unit, "{}", p.key);
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
            assert_eq!(Parameter::find(key).unwrap().key_words(), words);
        }
        for (key, words) in [
            ("motor.load_per_wave_n", "load on one wave"),
            ("film.min_spacing_nm", "minimum spacing H_m"),
            ("motor.contact_radius_mm", "contact radius"),
            ("rotor.part.flange.r_outer_mm", "part flange r outer"),
        ] {
            assert_eq!(Parameter::find(key).unwrap().words(), words);
        }
    }
}
