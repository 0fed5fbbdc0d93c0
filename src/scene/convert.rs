//! Turns a scene into a problem: values of keys become fields, in SI units.

use super::compliance::GREEN;
use super::edges;
use super::error::{FaultKind, SceneError};
use super::section::PART;
use super::value::Value;
use super::values::{Kind, Scene};
use crate::gas::species::IdealGas;
use crate::problem::{GRAVITY, Gas, HIGHEST, Motor, Plate, Problem, RotorCompliance, Scenario};
use crate::rotor::ring::{MATERIALS, Part, RingError, Section, Support};
use crate::surface::flow::Roughness;
use crate::surface::{Asperities, Summits, Surface};
use serde::Deserialize;
use serde::de::value::{Error, StrDeserializer};

impl TryFrom<&Scene> for Problem {
    type Error = SceneError;

    /// The checked, SI form of a scene.
    fn try_from(scene: &Scene) -> Result<Self, SceneError> {
        scene.check()?;
        Ok(scene.unchecked()?)
    }
}

impl Scene {
    /// The problem of a scene, without a check of the rules between keys. It is an error if the table of keys lacks a key that is used here,
    /// or has it with another type; that would be a fault of the program, which any test finds.
    pub(super) fn unchecked(&self) -> Result<Problem, FaultKind> {
        let optional = |key| {
            let parameter = self.parameter(key)?;
            Ok::<_, FaultKind>(self.optional_number(parameter).map(|number| parameter.si(number)))
        };
        let si = |key| self.si(key);
        let gas = Gas {
            ambient_pressure: si("film.ambient_pressure_kpa")?,
            viscosity: si("film.viscosity_upa_s")?,
            mean_free_path: si("film.mean_free_path_nm")?,
            slip: choice(self, "film.slip")?,
            accommodation: si("film.accommodation")?,
            ideal: match self.species() {
                Some(species) => species.at(si("film.temperature_c")?),
                None => IdealGas::UNNAMED,
            },
        };
        let surface = match self.kind() {
            Kind::Motor => self.surface()?,
            Kind::Plate => Surface::default(),
        };
        let scenario = match self.kind() {
            Kind::Motor => Scenario::Motor(Motor {
                contact_radius: si("motor.contact_radius_mm")?,
                waves: si("motor.waves")? as u32,
                load: si("motor.load_per_wave_n")?,
                dry_friction: si("motor.dry_friction")?,
                rotor_speed: std::f64::consts::TAU * si("motor.rotor_speed_rpm")? * si("motor.contact_radius_mm")?,
                frequency: si("stator.frequency_khz")?,
                normal_amplitude: si("stator.normal_amplitude_um")?,
                tangential_amplitude: si("stator.tangential_amplitude_um")?,
                teeth: si("stator.teeth_per_wave")? as usize,
                tooth_width: si("stator.tooth_width_mm")?,
                tooth_radius: optional("stator.tooth_radius_m")?,
                contact_width: si("rotor.contact_width_mm")?,
                rotor: match self.text("rotor.model")? {
                    "beam" | "section" => RotorCompliance::Beam {
                        decay_length: si("rotor.decay_length_mm")?,
                        point_compliance: si("rotor.point_compliance_um_per_n")?,
                        local_compliance: si("rotor.local_compliance_m2_per_n")?,
                    },
                    "table" => RotorCompliance::Table(self.rows("rotor.compliance").to_vec()),
                    "green" => RotorCompliance::Green(
                        self.rows("rotor.green").iter().map(|(x, g)| (GREEN[0].si(*x), GREEN[1].si(*g))).collect(),
                    ),
                    "ring" => RotorCompliance::Ring(self.section()?),
                    _ => return Err(self.unknown_key("rotor.model")),
                },
                min_spacing: match surface.asperities {
                    Some(asperities) => {
                        let tops =
                            si("rotor.contact_width_mm")? * si("stator.tooth_width_mm")? * si("stator.teeth_per_wave")?;
                        asperities.mean_gap(asperities.separation_under(si("motor.load_per_wave_n")? / tops)).0
                    }
                    None => si("film.min_spacing_nm")?,
                },
                surface,
                gas,
                shear: self.flag("film.shear")?,
            }),
            Kind::Plate => {
                let weight = optional("plate.mass_g")?.map(|mass| mass * GRAVITY);
                let load = weight.or(optional("plate.load_n")?);
                let (length, width, hole) = match self.text("plate.shape")? {
                    "disc" => (2.0 * si("plate.radius_mm")?, None, Some(0.0)),
                    "ring" => (2.0 * si("plate.radius_mm")?, None, Some(si("plate.inner_radius_mm")?)),
                    "rectangle" => (si("plate.length_mm")?, optional("plate.width_mm")?, None),
                    _ => return Err(self.unknown_key("plate.shape")),
                };
                let plate = Plate {
                    length,
                    width,
                    hole,
                    mean_gap: si("plate.mean_gap_um")?,
                    load,
                    min_spacing: si("film.min_spacing_nm")?,
                    amplitude: si("plate.amplitude_um")?,
                    frequency: si("plate.frequency_khz")?,
                    gas,
                };
                let mean_gap = load.map_or(plate.mean_gap, |load| plate.trapped_gap(load).min(HIGHEST));
                Scenario::Plate(Plate { mean_gap, ..plate })
            }
        };
        Ok(Problem { name: self.name.clone(), scenario, numerics: self.numerics() })
    }

    /// How the faces of a motor meet.
    fn surface(&self) -> Result<Surface, FaultKind> {
        let asperities = match self.text("surface.model")? {
            "asperities" => {
                let summits = Summits {
                    rms: self.si("surface.rms_nm")?,
                    radius: self.si("surface.summit_radius_um")?,
                    density: self.si("surface.summit_density_per_mm2")?,
                    modulus: self.si("surface.elastic_modulus_gpa")?,
                };
                let law = Surface::law(self.text("surface.contact_law")?);
                let heights = Surface::heights(self.text("surface.summit_heights")?);
                let (law, heights) = law.zip(heights).ok_or_else(|| self.unknown_key("surface.contact_law"))?;
                Some(Asperities::new(summits, law, heights))
            }
            "minimum-spacing" => None,
            _ => return Err(self.unknown_key("surface.model")),
        };
        let flow = match self.text("surface.flow_factors")? {
            "patir-cheng" => Some(Roughness {
                rms: self.si("surface.rms_nm")?,
                lay: self.number("surface.lay")?,
                stator_share: self.number("surface.stator_share")?,
                asperities,
            }),
            "none" => None,
            _ => return Err(self.unknown_key("surface.flow_factors")),
        };
        Ok(Surface { asperities, flow })
    }

    /// The cross-section of the ring, checked.
    pub(super) fn section(&self) -> Result<Section, FaultKind> {
        let records = |key: &'static str| match self.get(key) {
            Some(Value::Records(records)) => records,
            _ => Vec::new(),
        };
        let metres = |cells: &[Value]| Some(edges::lengths(cells)?.map(|length| PART[1].si(length)));
        let text = |cell: Option<&Value>| cell.and_then(Value::as_text).unwrap_or_default().to_owned();
        let parts = records("rotor.part").into_iter().filter_map(|cells| {
            let [inner_radius, outer_radius, bottom, top] = metres(&cells)?;
            let material = text(cells.last());
            let material = *MATERIALS.iter().find(|known| known.name == material)?;
            Some(Part { name: text(cells.first()), inner_radius, outer_radius, bottom, top, material })
        });
        let supports = records("rotor.support").into_iter().filter_map(|cells| {
            let [inner_radius, outer_radius, bottom, top] = metres(&cells)?;
            let fixed = text(cells.last());
            let holds = |direction: &str| fixed == "all" || fixed.split('-').any(|held| held == direction);
            let [radial, axial, circumferential] = ["radial", "axial", "circumferential"].map(holds);
            Some(Support { inner_radius, outer_radius, bottom, top, radial, axial, circumferential })
        });
        Section::new(parts.collect(), supports.collect()).map_err(|fault| {
            let key = if matches!(fault, RingError::Support { .. }) { "rotor.support" } else { "rotor.part" };
            FaultKind::Rule { key, message: format!("{key}: {fault}") }
        })
    }
}

/// The choice of a key, by its name.
fn choice<T: for<'de> Deserialize<'de>>(scene: &Scene, key: &str) -> Result<T, FaultKind> {
    T::deserialize(StrDeserializer::<Error>::new(scene.text(key)?)).map_err(|_| scene.unknown_key(key))
}
