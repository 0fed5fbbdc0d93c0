//! A rotor by itself: its compliance beside that of other models, its Green's function, and for a ring its deformation under the load.

use crate::budget;
use crate::control::Cancel;
use crate::problem::{Motor, Problem, RotorCompliance};
use crate::recording::LineLoads;
use crate::rotor::ring::{Deflection, Mesh, Section};
use crate::rotor::{self, Compliances, RotorError};
use crate::scene::Scene;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::f64::consts::TAU;

/// Number of harmonics that are shown and summed in the Green's function: those of the paper's 180 nodes in a wavelength.
const HARMONICS: usize = 90;
/// Number of harmonics of the load in the drawing of the deformed section.
const BENDING: u32 = 4;

/// Name of the present model.
const PRESENT: &str = "present rotor";
/// The models for comparison: name of each, and value of `rotor.model`.
const OTHERS: [(&str, &str); 2] = [("beam fitted to Table I", "beam"), ("ring of preset ring-rotor", "ring")];

/// One model of the rotor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelCompliance {
    /// Name of the model.
    pub name: Cow<'static, str>,
    /// C(k_n) \[m²/N\] for n = 1, 2, ….
    pub compliance: Vec<f64>,
    /// Points (x \[m\], deflection \[m/N\] under a unit force in every wavelength, without the mean) at the nodes of the paper's mesh,
    /// λ/180 apart, from 0 to half the wavelength. The force is spread over the length of one node, and so is the local deformation.
    pub green: Vec<[f64; 2]>,
}

/// The cross-section of a ring, its mesh, and its deformation by each harmonic of a line load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bent {
    /// The section.
    pub section: Section,
    /// Its mesh.
    pub mesh: Mesh,
    /// The deformation by a unit line load of the harmonics n = 1, 2, ….
    pub harmonics: Vec<Deflection>,
}

/// Compliance, deflection and resonances of a rotor, its compliance beside that of other models.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RotorCurves {
    /// The present model, followed by the other models with the same wave: the beam fitted to Table I and the ring of the preset.
    pub curves: Vec<ModelCompliance>,
    /// Estimated error of the present model's deflection under a point load, relative.
    pub relative_error: f64,
    /// Lowest natural frequencies of the first harmonics \[Hz\], of a ring.
    pub resonances: Option<Vec<f64>>,
    /// The bent section of a ring; `None` for other models.
    pub bent: Option<Bent>,
}

impl RotorCurves {
    /// The curves for the rotor of `motor`; `None` if cancelled.
    pub fn of(motor: &Motor, cancel: &Cancel) -> Result<Option<Self>, RotorError> {
        match Self::computed(motor, cancel) {
            Err(error) if error.is_cancelled() => Ok(None),
            computed => computed,
        }
    }

    fn computed(motor: &Motor, cancel: &Cancel) -> Result<Option<Self>, RotorError> {
        let present = motor.compliances(HARMONICS, cancel)?;
        let mut curves = vec![curve(PRESENT, &present)];
        for (name, model) in OTHERS {
            if cancel.is_cancelled() {
                return Ok(None);
            }
            // A ring that the stator does not touch, because the wave is elsewhere, is left out.
            let other = reference(model).filter(|other| *other != motor.rotor);
            let other = other.and_then(|rotor| rotor.resolve(&motor.wave(), HARMONICS, cancel).ok());
            curves.extend(other.map(|found| curve(name, &found)));
        }
        let bent = match &motor.rotor {
            RotorCompliance::Ring(section) => {
                let band = motor.wave().band;
                let _taken = budget::take(rotor::need(section, band, 1)?, cancel)?;
                let mesh = section.mesh(band)?;
                let orders: Vec<u32> = (1..=BENDING).map(|n| n * motor.waves).collect();
                let harmonics = section.deflections(band, &orders, cancel)?;
                Some(Bent { section: section.clone(), mesh, harmonics })
            }
            _ => None,
        };
        let resonances = motor.resonances(cancel)?.map(Vec::from);
        Ok(Some(Self { curves, relative_error: present.relative_error, resonances, bent }))
    }
}

/// The rotor of a motor with default values of all keys except the model.
fn reference(model: &str) -> Option<RotorCompliance> {
    let scene = Scene::motor().with([("rotor.model", model)]).ok()?;
    Some(Problem::try_from(&scene).ok()?.scenario.motor()?.rotor.clone())
}

fn curve(name: &'static str, rotor: &Compliances) -> ModelCompliance {
    let compliance: Vec<f64> = (1..=HARMONICS).map(|n| rotor.harmonic(n)).collect();
    let length = rotor.wavelength();
    let green = |i: usize| {
        let turn = 0.5 * i as f64 / HARMONICS as f64;
        // The highest harmonic of the nodes is its own mirror image.
        let share = |n: i32| if n as usize == HARMONICS { 0.5 } else { 1.0 };
        let terms = (1..).zip(&compliance).map(|(n, c)| share(n) * c * (TAU * f64::from(n) * turn).cos());
        [turn * length, 2.0 / length * terms.sum::<f64>()]
    };
    ModelCompliance { name: name.into(), green: (0..=HARMONICS).map(green).collect(), compliance }
}

impl Bent {
    /// Displacement (u_r, u_z) \[m\] of each node, at the place where the first harmonic of the load on the rotor is greatest at `frame`.
    pub fn under(&self, loads: &LineLoads, frame: usize) -> Vec<[f64; 2]> {
        let amplitudes: Vec<[f64; 2]> = (1..=self.harmonics.len()).map(|n| harmonic(loads, frame, n)).collect();
        let crest = amplitudes.first().map_or(0.0, |[cosine, sine]| sine.atan2(*cosine));
        let mut moved = vec![[0.0; 2]; self.mesh.nodes.len()];
        for ((n, [cosine, sine]), bent) in (1..).zip(&amplitudes).zip(&self.harmonics) {
            let (s, c) = (f64::from(n) * crest).sin_cos();
            let load = cosine * c + sine * s;
            for (moved, (radial, axial)) in moved.iter_mut().zip(bent.radial.iter().zip(&bent.axial)) {
                moved[0] += load * radial;
                moved[1] += load * axial;
            }
        }
        moved
    }
}

/// Cosine and sine amplitudes \[N/m\] of harmonic `n` of the load by film and contact at `frame`.
fn harmonic(loads: &LineLoads, frame: usize, n: usize) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for tooth in 0..loads.teeth {
        let line = loads.line_offset(tooth, frame);
        for (i, (x, length)) in loads.x.iter().zip(&loads.node_length).enumerate() {
            let force = (loads.film[line + i] + loads.contact[line + i]) * length;
            let (s, c) = (TAU * n as f64 * (tooth as f64 * loads.pitch + x) / loads.length).sin_cos();
            sum[0] += 2.0 / loads.length * force * c;
            sum[1] += 2.0 / loads.length * force * s;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Scenario;

    #[test]
    fn a_greens_function_is_the_beams() {
        let Scenario::Motor(motor) = Problem::try_from(&Scene::motor()).unwrap().scenario else { panic!("a motor") };
        let found = RotorCurves::of(&motor, &Cancel::new()).unwrap().unwrap();
        // For a beam, the beam is not shown a second time.
        assert!(found.curves.iter().all(|curve| !curve.name.starts_with("beam")) && found.bent.is_none());
        let green = &found.curves[0].green;
        // Images a wavelength apart, the local compliance aside, from half the wavelength on: G(x) − G(x').
        let beam = |x: f64| {
            let images = (-4..=4).map(|i| ((x + f64::from(i) * motor.wavelength()) / 4e-3).abs());
            0.64e-6 * images.map(|s| (-s).exp() * (s.cos() + s.sin())).sum::<f64>()
        };
        let [from, to] = [HARMONICS / 3, HARMONICS];
        let exact = beam(green[from][0]) - beam(green[to][0]);
        assert!(((green[from][1] - green[to][1]) / exact - 1.0).abs() < 0.05, "{:?} {exact}", green[from]);
    }

    #[test]
    fn harmonics_of_a_load_come_back() {
        let (teeth, nodes, length) = (3, 40, 0.03);
        let x: Vec<f64> = (0..nodes).map(|i| 0.01 * ((f64::from(i) + 0.5) / f64::from(nodes) - 0.5)).collect();
        let load = |x: f64| 5.0 + 3.0 * (TAU * 2.0 * x / length).cos() - 2.0 * (TAU * 2.0 * x / length).sin();
        let film = (0..3).flat_map(|tooth| x.iter().map(move |x| load(f64::from(tooth) * 0.01 + x))).collect();
        let loads = LineLoads {
            frames: 1,
            length,
            teeth,
            stored_teeth: teeth,
            pitch: 0.01,
            node_length: vec![0.01 / f64::from(nodes); x.len()],
            contact: vec![0.0; teeth * x.len()],
            film,
            x,
            ..LineLoads::default()
        };
        let [cosine, sine] = harmonic(&loads, 0, 2);
        assert!((cosine - 3.0).abs() < 1e-12 && (sine + 2.0).abs() < 1e-12, "{cosine} {sine}");
    }
}
