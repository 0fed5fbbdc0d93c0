//! `squeezefilm gui`, and the program without a command: the window.

use super::exit::{CliError, Exit};
use super::options::{MemoryOptions, STANDARD_INPUT, SceneOptions};
use crate::gui;
use crate::gui::state::document::Document;
use crate::gui::state::link::Link;
use crate::scene::presets::BUILT_IN;
use clap::Args;
use std::path::PathBuf;

/// Opens the window (as without any command), on a preset or where it was left
#[derive(Debug, Default, Args)]
#[command(after_help = "Examples:
  squeezefilm
  squeezefilm gui levitating
  squeezefilm gui '#fundamental&film.min_spacing_nm=100&tab=torque'
  squeezefilm gui --lessons my-course")]
pub(super) struct Arguments {
    /// A built-in name, a path, or a link to a scene or a lesson; without it, the scene that was last open
    #[arg(value_name = "PRESET")]
    preset: Option<String>,

    /// A folder of lessons, shown beside the built-in ones; docs/lessons.md says how to write them
    #[arg(long, value_name = "DIR")]
    lessons: Option<PathBuf>,

    #[command(flatten)]
    scene: SceneOptions,

    #[command(flatten)]
    memory: MemoryOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<Exit, CliError> {
    let linked = arguments.preset.as_deref().filter(|preset| Link::is_link(preset));
    let link = linked.map(Link::read).transpose().map_err(CliError::Link)?;
    let opened = match &arguments.preset {
        Some(_) if link.is_some() && !arguments.scene.changes.is_empty() => {
            return Err(CliError::Usage("a link says itself what is changed: leave --set away"));
        }
        Some(_) if link.is_some() => None,
        Some(preset) => {
            let built_in = BUILT_IN.iter().any(|built_in| built_in.name == preset);
            // What --set changed is not in the file.
            let (saved, scene) = arguments.scene.original_and_changed(preset)?;
            let is_file = !built_in && preset != STANDARD_INPUT;
            Some(Document::restored(scene, saved, is_file.then(|| PathBuf::from(preset))))
        }
        None if !arguments.scene.changes.is_empty() => {
            return Err(CliError::Usage("--set needs a PRESET to change: squeezefilm gui fundamental --set …"));
        }
        None => None,
    };
    arguments.memory.apply();
    if no_display() {
        return Err(CliError::Window("neither DISPLAY nor WAYLAND_DISPLAY is set".to_owned()));
    }
    gui::open(opened, arguments.lessons.clone(), link).map_err(|error| CliError::Window(error.to_string()))?;
    Ok(Exit::Solved)
}

/// Whether it is known beforehand that no window can be opened.
fn no_display() -> bool {
    let unset = |name: &str| std::env::var_os(name).is_none_or(|value| value.is_empty());
    cfg!(all(unix, not(target_os = "macos"))) && unset("DISPLAY") && unset("WAYLAND_DISPLAY")
}
