//! Every key a scene can have: its unit, range, default and meaning. They are stated in this table only; files, `--set`, checks, sliders
//! and sweeps all read it. Besides an entry here, a new key needs its field in `problem.rs`, which `convert.rs` fills.
//! A key of `[numerics]` needs only a field of the same name in [`Numerics`](crate::problem::Numerics).

use super::compliance::{COMPLIANCE, GREEN};
use super::parameter::Belongs::{Any, IdleOnPlate, Motor, Plate};
use super::parameter::ParameterKind::{CsvPath, Records, Rows};
use super::parameter::Scale::{Linear, Log};
use super::parameter::{Model, Parameter, ParameterKind, choice, flag, names, number, text, whole};
use super::section::{PART, SUPPORT, parts};
use crate::gas::GASES;
use crate::problem::{Flow, Slip, Teeth, Time, Wedge, Width};
use crate::surface::{HEIGHTS, LAWS};

const BEAM: &[Model] = &[("rotor.model", &["beam"])];
const SECTION: &[Model] = &[("rotor.model", &["section"])];
const BENDING: &[Model] = &[("rotor.model", &["beam", "section"])];
const TABLE: &[Model] = &[("rotor.model", &["table"])];
const GREENS: &[Model] = &[("rotor.model", &["green"])];
const RING: &[Model] = &[("rotor.model", &["ring"])];
const RECTANGLE: &[Model] = &[("plate.shape", &["rectangle"])];
const ROUND: &[Model] = &[("plate.shape", &["disc", "ring"])];
const RING_PLATE: &[Model] = &[("plate.shape", &["ring"])];
const BOLTZMANN: &[Model] = &[("film.slip", &["fukui-kaneko"])];
const CUSTOM: &[Model] = &[("film.gas", &["custom"])];
const NAMED: &[Model] = &[("film.gas", names!(GASES))];
const HARD: &[Model] = &[("surface.model", &["minimum-spacing"])];
const ASPERITIES: &[Model] = &[("surface.model", &["asperities"])];
const ROUGH_FLOW: &[Model] = &[("surface.flow_factors", &["patir-cheng"])];
const ROUGH: &[Model] = &[ASPERITIES[0], ROUGH_FLOW[0]];
/// The meaning of a numerics key that is absent.
const LEFT_OPEN: &str = "left to the fidelity";

/// Every key of a scene file except `schema` and `scene`, in the order in which they are written. The columns of a number are: key, unit,
/// scenes that have it, range, range of the slider, spacing of the slider, default, meaning.
#[rustfmt::skip]
pub static PARAMETERS: &[Parameter] = &[
    text("name", "Untitled", "Name shown with every result"),
    text("about", "", "Description of the scene in one line").named("What this scene is"),

    number("motor.contact_radius_mm", "mm", Motor, (1.0, 500.0), (5.0, 100.0), Log, 29.0,
        "Radius at which the teeth touch the rotor"),
    whole("motor.waves", Motor, (1, 100), 7, "Wavelengths round the ring").named("Waves round the ring"),
    number("motor.load_per_wave_n", "N", Motor, (0.01, 100.0), (0.1, 20.0), Log, 2.45, "Axial load on one wavelength").named("Load on one wave"),
    number("motor.load_n", "N", Motor, (0.01, 10000.0), (1.0, 200.0), Log, 17.15, "Axial load on the whole ring")
        .absent("the load on one wavelength is given", "Load on the whole ring").instead_of("motor.load_per_wave_n").named("Load on the ring"),
    number("motor.dry_friction", "", Motor, (0.0, 2.0), (0.0, 1.0), Linear, 0.7,
        "Friction coefficient where tooth and rotor touch").named("Dry friction coefficient"),
    number("motor.rotor_speed_rpm", "rpm", Motor, (-10000.0, 10000.0), (-300.0, 300.0), Linear, 0.0,
        "Speed of the rotor; positive is towards +x, against the wave"),
    number("motor.rotor_speed_mm_per_s", "mm/s", Motor, (-600e3, 600e3), (-1000.0, 1000.0), Linear, 0.0,
        "Speed of the rotor's surface at the contact radius; same sign as the speed in rpm")
        .absent("the speed in rpm is given", "Speed in mm/s").instead_of("motor.rotor_speed_rpm").named("Surface speed of the rotor"),

    number("stator.frequency_khz", "kHz", Motor, (0.001, 10000.0), (1.0, 200.0), Log, 30.0, "Frequency of the vibration"),
    number("stator.normal_amplitude_um", "µm", Motor, (0.0, 20.0), (0.0, 5.0), Linear, 1.3,
        "Amplitude of the travelling wave, normal to the face"),
    number("stator.tangential_amplitude_um", "µm", Motor, (0.0, 20.0), (0.0, 5.0), Linear, 1.0,
        "Amplitude of the tooth tops along the ring"),
    whole("stator.teeth_per_wave", Motor, (1, 64), 9, "Teeth in one wavelength").named("Teeth on one wave"),
    number("stator.tooth_width_mm", "mm", Motor, (1e-6, 3142.0), (0.1, 5.0), Linear, 1.7353,
        "Width of a tooth along the ring; from 1 % to 100 % of the tooth pitch"),
    number("stator.tooth_share", "", Motor, (0.01, 1.0), (0.1, 1.0), Linear, 0.6, "Width of a tooth as a share of the tooth pitch")
        .absent("the width of a tooth is given", "Tooth width as a share of the pitch").instead_of("stator.tooth_width_mm")
        .named("Share of the pitch"),
    number("stator.tooth_radius_m", "m", Motor, (0.01, 1e6), (1.0, 100.0), Log, 6.5,
        "Radius of a crowned tooth top").absent("flat teeth", "Crowned teeth"),

    number("rotor.contact_width_mm", "mm", Motor, (0.01, 10.0), (0.05, 5.0), Log, 0.3, "Radial width of the contact"),
    choice("rotor.model", Motor, &["beam", "section", "ring", "table", "green"], "beam",
        "Model of the rotor's compliance").named("Compliance model"),
    number("rotor.decay_length_mm", "mm", Motor, (0.1, 100.0), (0.5, 20.0), Log, 4.0,
        "Length over which the deflection under a point load dies out").when(BENDING),
    number("rotor.elastic_modulus_gpa", "GPa", Motor, (0.01, 1000.0), (1.0, 250.0), Log, 70.0,
        "Elastic modulus of the rim that bends").when(SECTION),
    number("rotor.thickness_mm", "mm", Motor, (0.01, 100.0), (0.2, 10.0), Log, 1.0, "Axial thickness of the rim that bends").when(SECTION)
        .named("Thickness of the rim"),
    number("rotor.width_mm", "mm", Motor, (0.01, 200.0), (0.5, 30.0), Log, 2.0, "Radial width of the rim that bends").when(SECTION)
        .named("Width of the rim"),
    number("rotor.point_compliance_um_per_n", "µm/N", Motor, (1e-3, 100.0), (0.05, 10.0), Log, 0.64,
        "Deflection of the beam under a unit point load").when(BEAM),
    number("rotor.local_compliance_m2_per_n", "m²/N", Motor, (0.0, 1e-7), (0.0, 1e-9), Linear, 1.05e-10,
        "Local (Winkler) compliance in series with the beam").when(BENDING),
    Parameter::new("rotor.compliance_csv", Motor, CsvPath { table: Some("rotor.compliance") },
        "CSV of the compliance; path relative to the preset's folder").when(TABLE).named("Compliance from a CSV file"),
    Parameter::new("rotor.compliance", Motor, Rows { columns: &COMPLIANCE }, "Rows of wavenumber and compliance").when(TABLE)
        .named("Compliance table"),
    Parameter::new("rotor.green_csv", Motor, CsvPath { table: Some("rotor.green") },
        "CSV of the deflection under a unit force; path relative to the preset's folder").when(GREENS).named("Deflection from a CSV file"),
    Parameter::new("rotor.green", Motor, Rows { columns: &GREEN }, "Rows of distance from a unit force and deflection there").when(GREENS)
        .named("Deflection table"),
    Parameter::new("rotor.part", Motor, Records { columns: &PART, fewest: 1, default: parts },
        "Rectangles that make up the ring's cross-section; the stator touches the lowest").when(RING).named("Parts"),
    Parameter::new("rotor.support", Motor, Records { columns: &SUPPORT, fewest: 0, default: Vec::new },
        "Boxes of the cross-section in which the ring is held").when(RING).named("Supports"),

    choice("plate.shape", Plate, &["rectangle", "disc", "ring"], "rectangle", "Outline of the plate"),
    number("plate.length_mm", "mm", Plate, (0.001, 1000.0), (0.01, 50.0), Log, 1.0, "Length of the plate along x").when(RECTANGLE),
    number("plate.width_mm", "mm", Plate, (0.001, 1000.0), (0.01, 50.0), Log, 1.0,
        "Width of the plate along y").absent("infinitely wide strip, forces per metre of width", "Finite width").when(RECTANGLE),
    number("plate.radius_mm", "mm", Plate, (0.001, 500.0), (0.1, 50.0), Log, 10.0, "Radius of the plate").when(ROUND),
    number("plate.inner_radius_mm", "mm", Plate, (0.0005, 499.0), (0.05, 45.0), Log, 5.0,
        "Radius of the hole, in which the gas is at ambient pressure").when(RING_PLATE).named("Radius of the hole"),
    number("plate.mean_gap_um", "µm", Plate, (0.01, 1000.0), (0.1, 100.0), Log, 1.0, "Mean gap under the plate"),
    number("plate.load_n", "N", Plate, (1e-6, 1e6), (0.01, 100.0), Log, 1.0,
        "Load on a plate that floats; for a strip, load per metre of width")
        .absent("the mean gap or the mass is given", "Floats under a load").instead_of("plate.mean_gap_um"),
    number("plate.mass_g", "g", Plate, (1e-4, 1e8), (1.0, 10e3), Log, 100.0,
        "Mass of a plate that floats under its weight; for a strip, mass per metre of width")
        .absent("the mean gap or the load is given", "Floats under its weight").instead_of("plate.mean_gap_um"),
    number("plate.amplitude_um", "µm", Plate, (0.0, 1000.0), (0.0, 10.0), Linear, 0.5,
        "Amplitude of the vibration; must be smaller than the mean gap, if that is given"),
    number("plate.frequency_khz", "kHz", Plate, (0.001, 10000.0), (0.01, 1000.0), Log, 30.0, "Frequency of the vibration"),

    number("film.min_spacing_nm", "nm", IdleOnPlate, (5.0, 10000.0), (5.0, 2000.0), Log, 200.0,
        "Spacing that roughness leaves where the faces touch; not used for a plate with a given gap").when(HARD).named("Minimum spacing H_m"),
    choice("film.gas", Any, names!("custom", GASES), "custom",
        "Gas, which sets the viscosity and mean free path; for a custom gas they are given"),
    number("film.temperature_c", "°C", Any, (-70.0, 500.0), (-20.0, 100.0), Linear, 20.0, "Temperature of the gas").when(NAMED),
    number("film.ambient_pressure_kpa", "kPa", Any, (0.01, 1000.0), (1.0, 1000.0), Log, 101.325, "Pressure of the surrounding gas"),
    number("film.altitude_m", "m", Any, (-1000.0, 60e3), (0.0, 10e3), Linear, 0.0, "Altitude at which the standard atmosphere has the ambient pressure")
        .absent("the pressure is given", "Pressure of an altitude").when(NAMED).instead_of("film.ambient_pressure_kpa"),
    number("film.viscosity_upa_s", "µPa·s", Any, (1.0, 1000.0), (5.0, 50.0), Log, 18.1, "Viscosity of the gas").when(CUSTOM),
    number("film.mean_free_path_nm", "nm", Any, (0.0, 1e9), (0.0, 500.0), Linear, 64.0,
        "Mean free path of the gas at the ambient pressure").when(CUSTOM),
    choice("film.slip", Any, Slip::NAMES, "first-order", "Slip law of the gas at the walls").named("Slip at the walls"),
    number("film.accommodation", "", Any, (0.3, 1.0), (0.5, 1.0), Linear, 1.0,
        "Share of the molecules that the walls reflect diffusely; the others specularly").when(BOLTZMANN)
        .named("Accommodation coefficient"),
    flag("film.shear", IdleOnPlate, true, "Whether sliding drags gas along (the wedge term); not used for a plate")
        .named("Sliding drags gas along"),

    choice("surface.model", Motor, &["minimum-spacing", "asperities"], "minimum-spacing",
        "Contact of the faces: a hard stop at the minimum spacing, or elastic asperities").named("Faces meet on"),
    choice("surface.contact_law", Motor, names!(LAWS), "greenwood-williamson",
        "Contact law: asperities of one face against a plane, or of both faces").when(ASPERITIES),
    choice("surface.summit_heights", Motor, names!(HEIGHTS), "gaussian", "Distribution of the heights of the summits").when(ASPERITIES)
        .named("Heights of summits"),
    Parameter::new("surface.heights_csv", Motor, CsvPath { table: None },
        "CSV of the measured heights of both faces; path relative to the preset's folder. It gives roughness, summits and lay where they are not set")
        .when(ROUGH).named("Measured heights from a CSV file"),
    number("surface.rms_nm", "nm", Motor, (10.0, 5000.0), (20.0, 1000.0), Log, 100.0,
        "Standard deviation of the heights of both faces together").when(ROUGH).named("Rms roughness σ"),
    number("surface.summit_radius_um", "µm", Motor, (0.1, 1e4), (1.0, 1000.0), Log, 50.0, "Radius of a summit").when(ASPERITIES)
        .named("Radius of a summit"),
    number("surface.summit_density_per_mm2", "1/mm²", Motor, (1.0, 1e7), (100.0, 1e6), Log, 1e4, "Number of summits per area").when(ASPERITIES)
        .named("Density of summits"),
    number("surface.elastic_modulus_gpa", "GPa", Motor, (0.01, 1000.0), (1.0, 250.0), Log, 60.0,
        "Contact modulus E* of both faces together, 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂").when(ASPERITIES).named("Contact modulus"),
    choice("surface.flow_factors", Motor, &["none", "patir-cheng"], "none", "Flow factors: how roughness changes the flow of the gas")
        .named("Flow between rough faces"),
    number("surface.lay", "", Motor, (0.112, 9.0), (0.112, 9.0), Log, 1.0,
        "Ratio of the asperities' length along the wave to that across it").when(ROUGH_FLOW),
    number("surface.stator_share", "", Motor, (0.0, 1.0), (0.0, 1.0), Linear, 0.5,
        "Stator's share of the variance of both faces' heights").when(ROUGH_FLOW).named("Stator's share of the roughness"),

    whole("numerics.film_nodes_along", Any, (5, 2001), 101,
        "Film nodes along a tooth or plate, both ends counted; rounded up so that coarser grids fit in").absent(LEFT_OPEN, "Set film nodes along"),
    whole("numerics.film_nodes_across", Any, (3, 501), 21, "Film nodes across the full width, both ends counted; rounded up likewise").absent(LEFT_OPEN, "Set film nodes across"),
    whole("numerics.contact_nodes", IdleOnPlate, (19, 5001), 361,
        "Contact nodes on one wavelength for --method paper, both ends counted").absent(LEFT_OPEN, "Set contact nodes"),
    whole("numerics.steps_per_cycle", Any, (8, 100_000), 360, "Time steps in one cycle, rounded up so that coarser grids and all teeth fit in").absent(LEFT_OPEN, "Set steps in a cycle")
        .named("Steps in a cycle"),
    number("numerics.tolerance", "", Any, (1e-9, 1e-2), (1e-7, 1e-2), Log, 1e-4,
        "Relative change of trapped gas below which the cycle counts as repeating").absent(LEFT_OPEN, "Set tolerance of a cycle")
        .named("Tolerance of a cycle"),
    choice("numerics.wedge", IdleOnPlate, Wedge::NAMES, "auto",
        "Wedge term of sliding: solved (on), left out (off), or as the scene needs (auto)").named("Wedge term"),
    choice("numerics.teeth", IdleOnPlate, Teeth::NAMES, "auto",
        "Teeth whose film is solved: one (the others lag behind it) or all; the result is the same").named("Teeth solved"),
    choice("numerics.width", IdleOnPlate, Width::NAMES, "auto",
        "Width of the film that is solved: half (it is symmetric) or all; the result is the same").named("Width solved"),
    choice("numerics.flow", IdleOnPlate, Flow::NAMES, "auto",
        "Directions in which the gas flows: both, or only across or along a tooth").named("Flow of the film"),
    choice("numerics.time", IdleOnPlate, Time::NAMES, "auto",
        "Film over time: solved step by step, or as trapped gas with no time to flow").named("Leakage in time"),
];

impl Parameter {
    /// Whether other keys belong to one of its values, as those of a beam to `rotor.model = "beam"`.
    pub(super) fn selects(&self) -> bool {
        PARAMETERS.iter().any(|parameter| parameter.when.iter().any(|(selector, _)| *selector == self.key))
    }

    /// The order in which several keys are set at once, lowest first. A key that chooses a model comes first, because it decides which other
    /// keys there are. Numbers come after a file, so that they replace those of the file. A key that replaces another one comes after it, and a
    /// table of harmonics after the keys of the wavelength, which it needs.
    pub(super) fn rank(&self) -> u8 {
        match self.kind {
            // A load or a mass on a plate decides which other keys have an effect.
            _ if self.selects() || self.instead_of == Some("plate.mean_gap_um") => 0,
            ParameterKind::CsvPath { table: None } => 1,
            ParameterKind::Rows { .. } | ParameterKind::CsvPath { .. } => 4,
            // A value of an array comes after the array.
            _ if self.key.matches('.').count() > 1 => 5,
            _ => 2 + u8::from(self.instead_of.is_some()),
        }
    }

    /// The other keys for the same quantity: a scene has only one of them.
    pub fn alternatives(&'static self) -> impl Iterator<Item = &'static Self> {
        let first = |parameter: &Self| parameter.instead_of.unwrap_or(parameter.key);
        PARAMETERS.iter().filter(move |other| other.key != self.key && first(other) == first(self))
    }

    const fn when(self, models: &'static [Model]) -> Self {
        Self { when: models, ..self }
    }

    const fn instead_of(self, key: &'static str) -> Self {
        Self { instead_of: Some(key), ..self }
    }

    const fn absent(self, meaning: &'static str, switch: &'static str) -> Self {
        Self { absent: Some(meaning), switch, ..self }
    }
}

/// The tables of a scene file, in the order they are written.
pub(super) fn tables() -> Vec<&'static str> {
    let mut tables: Vec<_> = PARAMETERS.iter().map(Parameter::table).filter(|table| !table.is_empty()).collect();
    tables.dedup();
    tables
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn keys_are_unique_and_written_table_by_table() {
        let keys: HashSet<_> = PARAMETERS.iter().map(|p| p.key).collect();
        assert_eq!(keys.len(), PARAMETERS.len());
        assert_eq!(tables().len(), tables().into_iter().collect::<HashSet<_>>().len());
        // The keys above all tables come first.
        assert!(PARAMETERS.is_sorted_by_key(|p| !p.table().is_empty()));
    }

    #[test]
    fn a_model_that_has_keys_of_its_own_can_be_chosen() {
        for p in PARAMETERS {
            for (selector, models) in p.when {
                let selector = Parameter::find(selector).unwrap();
                let ParameterKind::Choice { options, .. } = selector.kind else { panic!("{}", selector.key) };
                assert!(models.iter().all(|model| options.contains(model)), "{}", p.key);
                // A plate keeps what a motor's model chooses, and does not heed it.
                assert!(
                    selector.belongs == p.belongs || p.belongs == IdleOnPlate && selector.belongs == Motor,
                    "{}",
                    p.key
                );
            }
        }
    }

    #[test]
    fn what_replaces_a_key_is_optional_and_in_its_table() {
        for p in PARAMETERS.iter().filter(|p| p.instead_of.is_some()) {
            let replaced = p.instead_of.and_then(Parameter::find).unwrap();
            assert!(p.absent.is_some() && replaced.absent.is_none(), "{}", p.key);
            assert!(p.table() == replaced.table() && p.belongs == replaced.belongs, "{}", p.key);
            assert!(p.alternatives().any(|other| other == replaced) && replaced.alternatives().any(|other| other == p));
        }
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
}
