//! Each limit of the model: its number, the limit, and a sentence about its meaning.

use crate::digits::brief;
use crate::film::slip::{FukuiKaneko, Mobility, SlipLaw};
use crate::problem::{Gas, Motor, Plate, RotorCompliance, Slip};
use crate::surface::flow::LEAST_RATIO;
use std::f64::consts::TAU;

/// Greatest Re.
const INERTIA: f64 = 0.1;
/// Greatest Re/σ. The mean load due to inertia, over that of a viscous film, is [`INERTIAL_LOAD`] times Re/σ.
const INERTIA_TO_SQUEEZE: f64 = 0.015;
/// (1/14)/(1/96), the two mean loads of a strip as σ → 0.
const INERTIAL_LOAD: f64 = 48.0 / 7.0;
/// Greatest gap over the thermal depth.
const THERMAL_DEPTHS: f64 = 1.0;
/// Greatest side over the wavelength of sound, where the film is too viscous for waves …
const WAVELENGTHS: f64 = 1.0;
/// … and if it is not: half a wavelength fits under the side.
const WAVELENGTHS_IN_THE_FILM: f64 = 0.5;
/// Greatest sliding speed over that of sound.
const MACH: f64 = 1.0;
/// Greatest frequency over a natural frequency: there the rotor yields a tenth more than under a static load, 1/(1 − 0.3²).
const RESONANCE: f64 = 0.3;
/// Greatest pressure \[MPa\] up to which the gas counts as ideal, and its viscosity as constant: about 5 % more viscous there.
const DENSE_MPA: f64 = 5.0;
/// Yield stress of aluminium 6061-T6 \[MPa\].
const YIELD_MPA: f64 = 276.0;
/// Hardness over the yield stress (Tabor 1951).
const HARDNESS: f64 = 2.8;
/// Plasticity index from which most summits yield (Greenwood and Williamson 1966).
const PLASTIC: f64 = 1.0;
/// Greatest rms roughness over the separation of the faces.
const ROUGHNESS: f64 = 1.0 / LEAST_RATIO;
/// Least separation, as a multiple of the rms roughness, that a message states.
const LEAST_TOLD: f64 = 0.01;
/// Greatest gap over the shorter side.
const THINNESS: f64 = 0.025;
/// Ratio to the gap of the length by which the gas beyond the edges lengthens a side.
const ELONGATION: f64 = 1.3;
/// Greatest width of the contact over its radius: at the edges the wave is a tenth faster or slower than in the middle.
const CURVATURE: f64 = 0.2;
/// Greatest amplitude of a plate over its mean gap.
const AMPLITUDE: f64 = 0.9;

/// The names of all limits in JSON.
pub const NAMES: [&str; 11] = [
    "gas-inertia",
    "isothermal",
    "slip-law",
    "sound",
    "dense-gas",
    "rotor-resonance",
    "contact-stress",
    "roughness",
    "thinness",
    "curvature",
    "amplitude",
];

/// Names of limits, read from bytes.
pub(in crate::analysis) fn known_names<'de, D: serde::Deserializer<'de>>(
    from: D,
) -> Result<Vec<&'static str>, D::Error> {
    let found = <Vec<String> as serde::Deserialize>::deserialize(from)?;
    Ok(NAMES.into_iter().filter(|name| found.iter().any(|found| found == name)).collect())
}

/// One limit that a scene exceeds.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ExceededLimit {
    /// Its name in JSON: `gas-inertia`.
    pub name: &'static str,
    /// The number, which exceeds …
    pub value: f64,
    /// … this limit.
    pub limit: f64,
    /// Unit of both; empty for a pure number.
    pub unit: &'static str,
    /// Explanation, in a sentence.
    pub text: String,
}

/// Quantities of the film on which most limits depend, in SI units.
pub(super) struct Film<'a> {
    pub(super) gas: &'a Gas,
    pub(super) omega: f64,
    /// h.
    pub(super) gap: f64,
    /// h closed, for the Knudsen number.
    pub(super) closed: f64,
    /// s.
    pub(super) side: f64,
    pub(super) amplitude: f64,
    pub(super) body: &'static str,
}

impl Film<'_> {
    fn density(&self) -> f64 {
        self.gas.ideal.density(self.gas.ambient_pressure)
    }

    /// Re.
    fn reynolds(&self) -> f64 {
        self.omega * self.density() * self.gap * self.gap / (12.0 * self.gas.viscosity)
    }

    pub(super) fn inertia(&self) -> Option<ExceededLimit> {
        let value = self.reynolds();
        let sigma = 12.0 * self.gas.viscosity * self.omega * (self.side / self.gap).powi(2) / self.gas.ambient_pressure;
        let (limit, text) = if value > INERTIA {
            let text = format!(
                "The inertia of the gas matters in a gap of {} µm (ωρh²/12μ = {}, {}); the film equation neglects it.",
                brief(self.gap * 1e6),
                brief(value),
                self.gas.ideal
            );
            (INERTIA, text)
        } else {
            let text = format!(
                "In so viscous a film (gap {} µm) the inertia of the gas, which the film equation leaves out, adds about {} times the \
                 mean load that is computed.",
                brief(self.gap * 1e6),
                brief(INERTIAL_LOAD * value / sigma)
            );
            (INERTIA_TO_SQUEEZE * sigma, text)
        };
        excess("gas-inertia", value, limit, "", text)
    }

    pub(super) fn heat(&self) -> Option<ExceededLimit> {
        let diffusivity = self.gas.viscosity / (self.density() * self.gas.ideal.prandtl);
        let depth = (2.0 * diffusivity / self.omega).sqrt();
        let value = self.gap / depth;
        let text = format!(
            "A gap of {} µm is {} times as wide as heat travels in a cycle ({} µm): the gas is warmed and cooled as it is squeezed, and \
             not isothermal.",
            brief(self.gap * 1e6),
            brief(value),
            brief(depth * 1e6)
        );
        excess("isothermal", value, THERMAL_DEPTHS, "", text)
    }

    pub(super) fn slip(&self) -> Option<ExceededLimit> {
        let gas = self.gas;
        let value = gas.mean_free_path / self.closed;
        let limit = SlipLaw::of(gas).knudsen_limit();
        let law = match gas.slip {
            Slip::None => "flow without slip".to_owned(),
            slip => format!("{} slip", slip.name()),
        };
        let text = if gas.slip == Slip::FukuiKaneko {
            format!("The fit of Fukui and Kaneko ends before Kn = {}; beyond, the flow is extrapolated.", brief(value))
        } else {
            let exact = FukuiKaneko { mean_free_path: gas.mean_free_path.max(f64::MIN_POSITIVE) };
            let ratio = SlipLaw::of(gas).at(self.closed).0 / exact.at(self.closed).0;
            format!(
                "At Kn = {}, in a film of {} nm, {law} predicts {} % {} flow than the Boltzmann equation, which the law of Fukui and Kaneko (film.slip) follows.",
                brief(value),
                brief(self.closed * 1e9),
                (100.0 * (ratio - 1.0)).abs().round(),
                if ratio < 1.0 { "less" } else { "more" }
            )
        };
        excess("slip-law", value, limit, "", text)
    }

    pub(super) fn sound(&self) -> Option<ExceededLimit> {
        let gas = &self.gas.ideal;
        let wavelength = TAU * gas.speed_of_sound() / self.omega;
        let value = self.side / wavelength;
        let across = format!(
            "The {} is {} wavelengths of sound across ({} mm, {})",
            self.body,
            brief(value),
            brief(wavelength * 1e3),
            gas
        );
        let (limit, text) = if self.reynolds() > INERTIA {
            (WAVELENGTHS_IN_THE_FILM, format!("{across}: sound waves can stand in the film, and are left out."))
        } else {
            let pressure = 100.0 * gas.heat_ratio * TAU * self.amplitude / wavelength;
            let text = format!(
                "{across}: its edges are taken to be at ambient pressure, and the sound around it, up to {} % of that, is left out.",
                brief(pressure)
            );
            (WAVELENGTHS, text)
        };
        excess("sound", value, limit, "", text)
    }

    pub(super) fn thinness(&self) -> Option<ExceededLimit> {
        let value = self.gap / self.side;
        let text = format!(
            "A film {} µm thick is not thin under a {} {} mm across: the gas beyond the edges, which is left out, makes it act as if {} % \
             larger.",
            brief(self.gap * 1e6),
            self.body,
            brief(self.side * 1e3),
            brief(100.0 * ELONGATION * value)
        );
        excess("thinness", value, THINNESS, "", text)
    }
}

/// Sliding speed of a motor's faces over the speed of sound, at its greatest.
pub fn mach(motor: &Motor) -> f64 {
    (motor.rotor_speed.abs() + TAU * motor.frequency * motor.tangential_amplitude) / motor.gas.ideal.speed_of_sound()
}

pub(super) fn sliding(motor: &Motor) -> Option<ExceededLimit> {
    let (value, gas) = (mach(motor), &motor.gas.ideal);
    let text = format!(
        "The faces slide at up to {} m/s, {} times the speed of sound ({}): shear warms the gas by some {} %, and it is not \
         isothermal.",
        brief(value * gas.speed_of_sound()),
        brief(value),
        gas,
        brief(100.0 * gas.prandtl * (gas.heat_ratio - 1.0) * value * value / 8.0)
    );
    excess("sound", value, MACH, "", text)
}

/// `natural`: the lowest natural frequency of the rotor for each of the first harmonics \[Hz\].
pub(super) fn resonance(motor: &Motor, natural: &[f64]) -> Option<ExceededLimit> {
    let ratio = |(n, natural): &(u32, &f64)| f64::from(*n) * motor.frequency / **natural;
    let nearest = (1..).zip(natural).max_by(|a, b| ratio(a).total_cmp(&ratio(b)))?;
    let value = ratio(&nearest);
    let (n, natural) = nearest;
    let answer = if value < 0.99 {
        format!(
            "with its mass, which is left out, it would yield up to {} times as much",
            brief(1.0 / (1.0 - value * value))
        )
    } else {
        "its mass, which is left out, decides how it moves".to_owned()
    };
    let text = format!(
        "Harmonic {n} of the wave drives the rotor at {} kHz, and the lowest natural frequency of that shape, {} waves round the ring, is \
         {} kHz: {answer}.",
        brief(1e-3 * f64::from(n) * motor.frequency),
        n * motor.waves,
        brief(1e-3 * natural),
    );
    excess("rotor-resonance", value, RESONANCE, "", text)
}

/// `pressure`: the highest of the gas \[Pa\].
pub(super) fn dense(pressure: f64) -> Option<ExceededLimit> {
    let value = pressure * 1e-6;
    let text = format!(
        "At a pressure of {} MPa the gas is neither ideal nor as viscous as at ambient pressure, which the film equation assumes.",
        brief(value)
    );
    excess("dense-gas", value, DENSE_MPA, "MPa", text)
}

/// `pressure`: the greatest contact pressure \[Pa\].
pub(super) fn stress(motor: &Motor, pressure: f64) -> Option<ExceededLimit> {
    let value = pressure * 1e-6;
    // For a ring, the face is the underside of its lowest part.
    let lowest = match &motor.rotor {
        RotorCompliance::Ring(section) => section.parts().iter().min_by(|a, b| a.bottom.total_cmp(&b.bottom)),
        _ => None,
    };
    let (what, limit) = lowest.map_or(("a rotor of aluminium 6061-T6", YIELD_MPA), |part| {
        let name = if part.material.name == "peek" { "PEEK" } else { part.material.name };
        (name, part.material.yield_stress * 1e-6)
    });
    if let Some(asperities) = motor.surface.asperities.filter(|_| pressure > 0.0) {
        let summits = asperities.summits();
        let value = summits.modulus * 1e-6 / (HARDNESS * limit) * (summits.rms / summits.radius).sqrt();
        let text = format!(
            "The plasticity index of the faces, E*/H √(σ/R), is {} for the hardness of {what}: summits deform plastically, \
             which the elastic contact law neglects, and faces that have run in are smoother.",
            brief(value)
        );
        return excess("contact-stress", value, PLASTIC, "", text);
    }
    let text = format!(
        "The contact pressure reaches {} MPa; {what} yields at {limit} MPa, but the model is elastic.",
        brief(value)
    );
    excess("contact-stress", value, limit, "MPa", text)
}

/// `closed`: the least film thickness \[m\].
pub(super) fn roughness(motor: &Motor, closed: f64) -> Option<ExceededLimit> {
    let surface = &motor.surface;
    let rms = surface.asperities.map(|asperities| asperities.summits().rms).or(surface.flow.map(|flow| flow.rms))?;
    let separation =
        surface.asperities.map_or(closed, |asperities| asperities.separation(closed)).max(LEAST_TOLD * rms);
    let value = rms / separation;
    let text = format!(
        "The mean planes of the faces come within {} nm, for a roughness of {} nm rms: summits no longer give way one by one, and flow \
         factors are not known below half of it.",
        brief(separation * 1e9),
        brief(rms * 1e9)
    );
    excess("roughness", value, ROUGHNESS, "", text)
}

pub(super) fn curvature(motor: &Motor) -> Option<ExceededLimit> {
    let value = motor.contact_width / motor.contact_radius;
    let text = format!(
        "The contact is {} mm wide round a radius of {} mm: the teeth are not rectangles there, and at the edges of the contact the wave is \
         {} % faster and slower than in its middle.",
        brief(motor.contact_width * 1e3),
        brief(motor.contact_radius * 1e3),
        brief(50.0 * value)
    );
    excess("curvature", value, CURVATURE, "", text)
}

pub(super) fn nearness(plate: &Plate) -> Option<ExceededLimit> {
    let text = format!(
        "The plate comes within {} nm of the wall: the load holds only for faces smoother and more parallel than that, and 1 % of gap or \
         amplitude changes it by 7 % or more.",
        brief((plate.mean_gap - plate.amplitude) * 1e9)
    );
    excess("amplitude", plate.amplitude / plate.mean_gap, AMPLITUDE, "", text)
}

fn excess(name: &'static str, value: f64, limit: f64, unit: &'static str, text: String) -> Option<ExceededLimit> {
    (value > limit).then_some(ExceededLimit { name, value, limit, unit, text })
}
