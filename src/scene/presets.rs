//! The presets built into the program, and how a PRESET argument is resolved.

use super::error::{FaultKind, SceneError};
use super::nearest::nearest;
use super::parameter::{Parameter, ParameterKind};
use super::value::show_text;
use super::values::Scene;
use std::path::Path;

/// A preset built into the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltIn {
    /// Its name, as a PRESET argument gives it.
    pub name: &'static str,
    /// The heading that it is listed under.
    pub group: &'static str,
    /// The text of its file.
    pub toml: &'static str,
}

impl BuiltIn {
    /// The preset of a name.
    pub fn find(name: &str) -> Option<&'static Self> {
        BUILT_IN.iter().find(|built_in| built_in.name == name)
    }

    /// The scene.
    ///
    /// # Errors
    /// A fault in the built-in file; a test reads them all.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        Scene::from_toml(self.toml, self.name)
    }
}

macro_rules! built_in {
    ($($group:literal: [$($name:literal),* $(,)?]),* $(,)?) => {
        &[$($(BuiltIn { name: $name, group: $group, toml: include_str!(concat!("../../presets/", $name, ".toml")) }),*),*]
    };
}

/// All built-in presets in the order of the lists, simple ones first. The rows of Table I are in the paper's order.
pub static BUILT_IN: &[BuiltIn] = built_in![
    "Plates: the film alone": [
        "plate-viscous",
        "plate-crossover",
        "plate-trapped",
        "plate-mems",
        "floating-disc",
        "floating-finger-pad",
    ],
    "The motor of Maeno and Bogy (1992): the first row of their Table I": ["fundamental"],
    "Motors beyond the table": [
        "levitating",
        "ring-rotor",
        "asperities",
        "rough-flow",
        "motor-60mm-helium",
    ],
    "The other rows of the table": [
        "doubled-mesh",
        "min-spacing-100nm",
        "rotor-width-0.6mm",
        "tooth-width-1.16mm",
        "tooth-width-2.31mm",
        "frequency-3khz",
        "frequency-20khz",
        "frequency-40khz",
        "frequency-60khz",
        "frequency-100khz",
        "tooth-radius-3m",
        "tooth-radius-6.5m",
        "tooth-radius-10m",
    ],
];

/// Keys whose defaults are usual values, so that they need not be mentioned.
const USUAL: [&str; 2] = ["film.temperature_c", "film.accommodation"];

/// Numbers and choices of `scene` that were not given, and so have the default values: those of the paper, or of the default strip.
/// They are not in the `text` of the preset, or `original`, the scene that it describes, has no such key. Built-in presets give all of
/// their keys.
pub fn assumed(text: Option<&str>, original: &Scene, scene: &Scene) -> Vec<&'static Parameter> {
    let file = text.and_then(|text| text.parse::<toml::Table>().ok());
    let given = |parameter: &'static Parameter| {
        let written =
            |file: &toml::Table| file.get(parameter.table()).is_some_and(|t| t.get(parameter.leaf()).is_some());
        file.as_ref().is_none_or(written) && original.has(parameter)
    };
    let makes = |parameter: &&'static Parameter| {
        // The gas follows from what is given of it.
        let chosen = ["rotor.model", "film.slip"].contains(&parameter.key);
        let number = matches!(parameter.kind, ParameterKind::Number { .. } | ParameterKind::Whole { .. });
        (chosen || number && parameter.table() != "numerics") && parameter.absent.is_none()
    };
    let default = |parameter: &&'static Parameter| {
        scene.heeds(parameter.key) && !scene.is_set(parameter.key) && !USUAL.contains(&parameter.key)
    };
    scene.parameters().filter(makes).filter(default).filter(|parameter| !given(parameter)).collect()
}

/// The scene, without the name and the description of a built-in preset whose values it does not have.
pub fn disclaimed(mut scene: Scene) -> Scene {
    let claimed = BUILT_IN.iter().filter_map(|one| one.scene().ok()).find(|one| one.about == scene.about);
    if let Some(original) = claimed.filter(|original| scene.changed(original).next().is_some()) {
        scene.made_from(&original);
    }
    scene
}

/// The scene of a PRESET argument: the name of a built-in preset, which wins, or else a path.
///
/// # Errors
/// The faults of the file; or, if there is no such file, [`FaultKind::UnknownPreset`] with the nearest built-in name.
pub fn find(name_or_path: &str) -> Result<Scene, SceneError> {
    Ok(read(name_or_path)?.0)
}

/// As [`find`], with the text of the file (`None` for a built-in preset).
pub fn read(name_or_path: &str) -> Result<(Scene, Option<String>), SceneError> {
    if let Some(built_in) = BuiltIn::find(name_or_path) {
        return Ok((built_in.scene()?, None));
    }
    let path = Path::new(name_or_path);
    // If the path exists but cannot be read, reading it gives the reason.
    if path.try_exists().unwrap_or(true) && !name_or_path.is_empty() {
        let text = Scene::text_of(path)?;
        return Ok((disclaimed(Scene::from_toml(&text, path)?), Some(text)));
    }
    let stem = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().to_lowercase());
    let stem = stem.strip_suffix(".toml").unwrap_or(&stem).replace(['_', ' '], "-");
    let nearest = nearest(&stem, BUILT_IN.iter().map(|built_in| built_in.name)).map(str::to_owned);
    Err(FaultKind::UnknownPreset { name: show_text(name_or_path), nearest }.into())
}
