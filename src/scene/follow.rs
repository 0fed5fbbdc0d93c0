//! Values that follow from other keys where they are not given: pressure from altitude, viscosity and mean free path from the gas.

use super::error::What;
use super::parameter::Parameter;
use super::values::Scene;
use crate::gas::species::Species;
use crate::gas::{self, atmosphere};

/// The value of a key that follows from others, in its unit; `None` if the scene gives what it would follow from otherwise.
type Following = fn(&Scene) -> Result<Option<f64>, What>;

static FOLLOWING: &[(&str, Following)] = &[
    ("film.ambient_pressure_kpa", pressure_at_altitude),
    ("film.viscosity_upa_s", viscosity),
    ("film.mean_free_path_nm", mean_free_path),
];

impl Scene {
    /// The value of a key that is not given in this scene, and that follows from others; in the unit of the key.
    pub fn following(&self, key: &str) -> Option<f64> {
        let (_, from) = FOLLOWING.iter().find(|(known, _)| *known == key)?;
        from(self).ok().flatten()
    }

    /// The keys whose values follow from others in this scene, and those values, in the units of the keys.
    pub fn all_following(&self) -> impl Iterator<Item = (&'static Parameter, f64)> + '_ {
        FOLLOWING.iter().filter_map(|(key, _)| Some((Parameter::find(key)?, self.following(key)?)))
    }

    /// The mean free path \[nm\] where it is given, and matters: it then stays as it is when pressure changes.
    pub fn given_mean_free_path(&self) -> Option<f64> {
        let slips = self.text("film.slip").is_ok_and(|law| law != "none");
        self.get("film.mean_free_path_nm").filter(|_| slips)?.as_number()
    }

    /// The gas of the film, if it has a name.
    pub(super) fn species(&self) -> Result<Option<&'static Species>, What> {
        Ok(gas::find(self.text("film.gas")?))
    }

    /// A number of this scene in SI.
    pub(super) fn si(&self, key: &str) -> Result<f64, What> {
        Ok(self.parameter(key)?.si(self.number(key)?))
    }
}

fn pressure_at_altitude(scene: &Scene) -> Result<Option<f64>, What> {
    let altitude = scene.optional_number(scene.parameter("film.altitude_m")?);
    Ok(altitude.map(|altitude| atmosphere::pressure(altitude) / 1e3))
}

fn viscosity(scene: &Scene) -> Result<Option<f64>, What> {
    let Some(gas) = scene.species()? else { return Ok(None) };
    Ok(Some((gas.viscosity)(scene.si("film.temperature_c")?) * 1e6))
}

fn mean_free_path(scene: &Scene) -> Result<Option<f64>, What> {
    let Some(gas) = scene.species()? else { return Ok(None) };
    let (pressure, temperature) = (scene.si("film.ambient_pressure_kpa")?, scene.si("film.temperature_c")?);
    Ok(Some(gas.mean_free_path(pressure, temperature) * 1e9))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_is_a_number_and_never_given_too() {
        for (key, _) in FOLLOWING {
            assert!(Parameter::find(key).is_some_and(|parameter| parameter.range().is_some()), "{key}");
        }
        let mut scene = Scene::motor();
        assert_eq!(scene.all_following().count(), 0);
        scene.set_all([("film.gas", "air"), ("film.altitude_m", "2000")]).unwrap();
        let following: Vec<_> = scene.all_following().map(|(parameter, _)| parameter.key).collect();
        assert_eq!(following, FOLLOWING.iter().map(|(key, _)| *key).collect::<Vec<_>>());
        assert!(following.iter().all(|key| scene.get(key).is_none()));
    }
}
