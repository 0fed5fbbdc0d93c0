//! Presets with changes, which the tests of the solver solve.
#![allow(dead_code, reason = "no file of tests uses all of it")]

use squeezefilm::problem::{Motor, Plate, Problem};
use squeezefilm::scene::{Scene, presets};

/// The built-in preset of this name, with these keys changed.
pub(crate) fn scene(preset: &str, changes: &[(&str, &str)]) -> Scene {
    presets::find(preset).unwrap().with(changes).unwrap()
}

/// Changes that make the fundamental motor one whose asperities hardly touch: their stiffness differs by tens of orders of magnitude, and
/// its state repeats only when it is marched.
pub(crate) fn barely_touching() -> Vec<(&'static str, &'static str)> {
    let set = "motor.contact_radius_mm=187.547 motor.waves=1 motor.load_per_wave_n=0.0265556 stator.frequency_khz=3.06654 \
        stator.normal_amplitude_um=6.91557 stator.tangential_amplitude_um=5.61993 stator.teeth_per_wave=2 \
        stator.tooth_share=0.0765805 rotor.contact_width_mm=6.40029 rotor.point_compliance_um_per_n=54.776 \
        rotor.decay_length_mm=0.801132 rotor.local_compliance_m2_per_n=0 surface.model=asperities surface.rms_nm=81.8279 \
        surface.summit_radius_um=0.188751 surface.summit_density_per_mm2=3.58305e6 surface.elastic_modulus_gpa=9.58664 \
        film.viscosity_upa_s=16.6032 film.mean_free_path_nm=624144 film.ambient_pressure_kpa=221.963";
    set.split_whitespace().filter_map(|set| set.split_once('=')).collect()
}

/// The problem of such a scene.
pub(crate) fn problem(preset: &str, changes: &[(&str, &str)]) -> Problem {
    Problem::try_from(&scene(preset, changes)).unwrap()
}

/// The motor of such a scene.
pub(crate) fn motor(preset: &str, changes: &[(&str, &str)]) -> Motor {
    problem(preset, changes).scenario.motor().unwrap().clone()
}

/// The plate of such a scene.
pub(crate) fn plate(preset: &str, changes: &[(&str, &str)]) -> Plate {
    problem(preset, changes).scenario.plate().unwrap().clone()
}
