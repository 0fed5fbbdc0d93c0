//! Scene to problem: the units of the field to SI.

use super::{Film, Kind, RotorModel, Scene, SceneError};
use crate::problem::{Gas, Motor, Plate, Problem, RotorCompliance, Scenario};

// Dividing by an exact power of ten rounds once: 200 nm is the double nearest to 2e-7 m. Multiplying by 1e-9, which is
// not itself exact, would round twice.
const PER_MILLI: f64 = 1e3;
const PER_MICRO: f64 = 1e6;
const PER_NANO: f64 = 1e9;
const KILO: f64 = 1e3;

impl Problem {
    /// The checked, SI form of a scene.
    ///
    /// # Errors
    ///
    /// The faults of [`Scene::check`].
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        scene.check()?;
        let scenario = match &scene.kind {
            Kind::Motor { motor, stator, rotor, film } => {
                let contact_radius = motor.contact_radius_mm / PER_MILLI;
                Scenario::Motor(Motor {
                    contact_radius,
                    waves: motor.waves,
                    load: motor.load_per_wave_n,
                    dry_friction: motor.dry_friction,
                    rotor_speed: std::f64::consts::TAU * (motor.rotor_speed_rpm / 60.0) * contact_radius,
                    frequency: stator.frequency_khz * KILO,
                    normal_amplitude: stator.normal_amplitude_um / PER_MICRO,
                    tangential_amplitude: stator.tangential_amplitude_um / PER_MICRO,
                    teeth: stator.teeth_per_wave as usize,
                    tooth_width: stator.tooth_width_mm / PER_MILLI,
                    tooth_radius: stator.tooth_radius_m,
                    contact_width: rotor.contact_width_mm / PER_MILLI,
                    rotor: rotor_compliance(&rotor.model),
                    min_spacing: film.min_spacing_nm / PER_NANO,
                    gas: gas(film),
                    shear: film.shear,
                })
            }
            Kind::Plate { plate, film } => Scenario::Plate(Plate {
                length: plate.length_mm / PER_MILLI,
                width: plate.width_mm.map(|width| width / PER_MILLI),
                mean_gap: plate.mean_gap_um / PER_MICRO,
                amplitude: plate.amplitude_um / PER_MICRO,
                frequency: plate.frequency_khz * KILO,
                gas: gas(film),
            }),
        };
        Ok(Self { name: scene.name.clone(), scenario, numerics: scene.numerics })
    }
}

impl TryFrom<&Scene> for Problem {
    type Error = SceneError;

    fn try_from(scene: &Scene) -> Result<Self, SceneError> {
        Self::new(scene)
    }
}

fn gas(film: &Film) -> Gas {
    Gas {
        ambient_pressure: film.ambient_pressure_kpa * KILO,
        viscosity: film.viscosity_upa_s / PER_MICRO,
        mean_free_path: film.mean_free_path_nm / PER_NANO,
        slip: film.slip,
    }
}

fn rotor_compliance(model: &RotorModel) -> RotorCompliance {
    match model {
        RotorModel::Beam { decay_length_mm, point_compliance_um_per_n, local_compliance_m2_per_n } => {
            RotorCompliance::Beam {
                decay_length: decay_length_mm / PER_MILLI,
                point_compliance: point_compliance_um_per_n / PER_MICRO,
                local_compliance: *local_compliance_m2_per_n,
            }
        }
        RotorModel::Table { compliance } => RotorCompliance::Table(compliance.clone()),
    }
}
