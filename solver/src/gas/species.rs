//! A gas by its molecular properties, and its ideal gas at one temperature.

use crate::digits::as_given;
use std::f64::consts::PI;

/// Molar gas constant \[J/(mol K)\], exact since 2019.
const MOLAR_GAS_CONSTANT: f64 = 8.314_462_618;

/// A gas. Ratio of specific heats and Prandtl number are those at 20 °C and 100 kPa (CoolProp 8.0, Bell et al. 2014). From −70 °C
/// to 500 °C they change by less than 4 % in all but carbon dioxide, whose ratio falls to 1.20.
#[derive(Clone, Copy, Debug)]
pub struct Species {
    /// Its name in presets.
    pub name: &'static str,
    /// Molar mass \[kg/mol\].
    pub molar_mass: f64,
    /// Viscosity \[Pa s\] at a temperature \[K\].
    pub viscosity: fn(f64) -> f64,
    /// Ratio of specific heats.
    pub heat_ratio: f64,
    /// Prandtl number.
    pub prandtl: f64,
}

impl Species {
    /// Mean free path \[m\] at a pressure \[Pa\] and temperature \[K\]: λ = (μ/p) √(πRT/2M).
    pub fn mean_free_path(&self, pressure: f64, temperature: f64) -> f64 {
        let speed = (PI * MOLAR_GAS_CONSTANT * temperature / (2.0 * self.molar_mass)).sqrt();
        (self.viscosity)(temperature) * speed / pressure
    }

    /// The ideal gas of this species at a temperature \[K\].
    pub fn at(&self, temperature: f64) -> IdealGas {
        IdealGas {
            name: self.name,
            temperature,
            gas_constant: MOLAR_GAS_CONSTANT / self.molar_mass,
            heat_ratio: self.heat_ratio,
            prandtl: self.prandtl,
        }
    }
}

/// An ideal gas at one temperature, from which its density, heat capacity and speed of sound follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IdealGas {
    /// Its name.
    pub name: &'static str,
    /// Temperature \[K\].
    pub temperature: f64,
    /// Specific gas constant \[J/(kg K)\].
    pub gas_constant: f64,
    /// Ratio of specific heats γ.
    pub heat_ratio: f64,
    /// Prandtl number.
    pub prandtl: f64,
}

/// `air at 20 °C`.
impl std::fmt::Display for IdealGas {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} at {} °C", self.name.replace('-', " "), as_given(self.temperature - 273.15))
    }
}

impl IdealGas {
    /// Assumed for a gas of which only viscosity and mean free path are given: air at 20 °C.
    pub const UNNAMED: Self =
        Self { name: "air", temperature: 293.15, gas_constant: 287.05, heat_ratio: 1.4, prandtl: 0.71 };

    /// Density \[kg/m³\] at a pressure \[Pa\].
    pub fn density(&self, pressure: f64) -> f64 {
        pressure / (self.gas_constant * self.temperature)
    }

    /// Speed of sound \[m/s\].
    pub fn speed_of_sound(&self) -> f64 {
        (self.heat_ratio * self.gas_constant * self.temperature).sqrt()
    }
}
