//! Gases by name, and the pressure of the atmosphere, from which viscosity and mean free path follow.
//!
//! Each gas is a file of its own, with its viscosity over temperature and the source. All are treated as dilute, that is, viscosity does
//! not depend on pressure; up to 1 MPa at 20 °C, pressure raises the viscosity of every gas here by less than 0.8 %.

mod air;
mod argon;
pub mod atmosphere;
mod carbon_dioxide;
mod collision;
mod helium;
mod hydrogen;
mod nitrogen;
pub mod species;

use species::Species;

/// All gases that a scene can name.
pub static GASES: &[Species] =
    &[air::AIR, nitrogen::NITROGEN, helium::HELIUM, argon::ARGON, carbon_dioxide::CARBON_DIOXIDE, hydrogen::HYDROGEN];

/// The gas with this name; `None` for `custom`, whose viscosity and mean free path are given.
pub fn find(name: &str) -> Option<&'static Species> {
    GASES.iter().find(|gas| gas.name == name)
}

#[cfg(test)]
mod tests;
