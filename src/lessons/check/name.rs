//! Names in a check: results, numbers of tabs, keys of the scene.

use crate::analysis::quantity::{Numbers, Quantity};
use crate::lessons::live::{Live, Readings};
use crate::problem::Problem;
use crate::scene::{PARAMETERS, Parameter, Scene, nearest};

/// The meaning of a name in a check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Name {
    /// A result.
    Quantity(Quantity),
    /// A number of a tab.
    Live(Live),
    /// A key of the scene.
    Key(&'static Parameter),
}

/// A run to check: its scene and its numbers.
#[derive(Clone, Copy, Debug)]
pub struct Ran<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its results.
    pub numbers: &'a Numbers,
    /// The numbers of the tabs.
    pub live: &'a Readings,
}

/// All results and numbers of tabs.
pub fn results() -> impl Iterator<Item = Name> {
    Quantity::all().map(Name::Quantity).chain(Live::all().map(Name::Live))
}

/// Finds a name: a result, a number of a tab, or a key.
///
/// # Errors
/// There is none of this name; the message has the nearest one.
pub fn name(text: &str) -> Result<Name, String> {
    let found = results().find(|name| name.text() == text);
    if let Some(name) = found.or_else(|| Parameter::find(text).map(Name::Key)) {
        return Ok(name);
    }
    let known = results().map(Name::text).chain(PARAMETERS.iter().map(|parameter| parameter.key));
    let meant = match nearest(text, known) {
        Some(name) => format!(": did you mean {name}?"),
        None => {
            "; results are called as in --json (alpha, film_load_n, …), keys as in a preset (film.min_spacing_nm, …)"
                .to_owned()
        }
    };
    Err(format!("{text} is neither a result nor a key of the scene{meant}"))
}

impl Name {
    /// The name as it is written in a check.
    pub fn text(self) -> &'static str {
        match self {
            Self::Quantity(quantity) => quantity.name(),
            Self::Live(live) => live.name(),
            Self::Key(parameter) => parameter.key,
        }
    }

    /// Description of the number or key, in words.
    pub fn words(self) -> String {
        match self {
            Self::Quantity(quantity) => quantity.words().to_owned(),
            Self::Live(live) => live.words().to_owned(),
            Self::Key(parameter) => parameter.words(),
        }
    }

    /// Its unit in this scene.
    pub fn unit(self, scene: &Scene) -> &'static str {
        match self {
            Self::Quantity(quantity) => Problem::try_from(scene).map_or("", |problem| quantity.unit(&problem)),
            Self::Live(live) => live.unit(),
            Self::Key(parameter) => parameter.unit,
        }
    }

    /// Whether a scene has it.
    pub fn belongs(self, scene: &Scene) -> bool {
        let problem = || Problem::try_from(scene);
        match self {
            Self::Quantity(quantity) => problem().is_ok_and(|problem| Quantity::of(&problem).any(|q| q == quantity)),
            Self::Live(live) => problem().is_ok_and(|problem| live.belongs(&problem.scenario)),
            Self::Key(parameter) => scene.parameters().any(|other| other.key == parameter.key),
        }
    }

    /// Its value in a run; `None` if it has none there.
    pub fn number(self, ran: Ran<'_>) -> Option<f64> {
        match self {
            Self::Quantity(quantity) => ran.numbers.get(quantity),
            Self::Live(live) => ran.live.get(live),
            Self::Key(parameter) => ran.scene.get(parameter.key)?.as_number(),
        }
    }
}
