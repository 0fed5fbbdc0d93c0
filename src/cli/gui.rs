//! `squeezefilm gui`, and the program without a command: the window.

use super::exit::{CliError, Exit};
use super::options::{AccuracyOptions, MemoryOptions, STANDARD_INPUT, SceneOptions, named_path};
use crate::gui;
use crate::gui::state::document::Document;
use crate::gui::state::link::Link;
use crate::scene::presets::BuiltIn;
use clap::Args;
use std::path::{Path, PathBuf};

/// Opens the window (as with no command), on a preset or on the scene that was last open
#[derive(Debug, Default, Args)]
#[command(after_help = "Examples:
  squeezefilm
  squeezefilm gui levitating
  squeezefilm gui '#fundamental&film.min_spacing_nm=100&tab=torque'
  squeezefilm gui fundamental --accuracy 0.05% --budget 50ms
  squeezefilm gui --lesson 3 --step 4
  squeezefilm gui --lessons my-course")]
pub(super) struct Arguments {
    /// A built-in name, a path, or a link to a scene or a lesson; without it, the scene that was last open
    #[arg(value_name = "PRESET")]
    preset: Option<String>,

    /// A folder of lessons, shown beside the built-in ones; docs/lessons.md says how to write them
    #[arg(long, value_name = "DIR", value_parser = named_path())]
    lessons: Option<PathBuf>,

    /// Opens this lesson, by its number in the menu
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(1..))]
    lesson: Option<u16>,

    /// Opens the lesson at this step
    #[arg(long, value_name = "NUMBER", requires = "lesson", value_parser = clap::value_parser!(u16).range(1..))]
    step: Option<u16>,

    #[command(flatten)]
    scene: SceneOptions,

    #[command(flatten)]
    accuracy: AccuracyOptions,

    #[command(flatten)]
    memory: MemoryOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<Exit, CliError> {
    let linked = arguments.preset.as_deref().filter(|preset| Link::is_link(preset));
    let link = linked.map(Link::read).transpose().map_err(CliError::Input)?;
    let changes = !arguments.scene.changes.is_empty();
    let opened = match (&arguments.preset, &link) {
        (_, Some(_)) if changes => {
            return Err(CliError::usage("a link contains its own changes: leave --set out"));
        }
        (Some(preset), None) => {
            let built_in = BuiltIn::find(preset).is_some();
            // The changes of --set are not in the file.
            let (saved, scene) = arguments.scene.original_and_changed(preset)?;
            let is_file = !built_in && preset != STANDARD_INPUT;
            Some(Document::restored(scene, saved, is_file.then(|| PathBuf::from(preset)), false))
        }
        (None, _) if changes => {
            return Err(CliError::usage("--set needs a PRESET to change: squeezefilm gui fundamental --set …"));
        }
        _ => None,
    };
    arguments.memory.apply();
    if no_display() {
        return Err(no_window("neither DISPLAY nor WAYLAND_DISPLAY is set".to_owned()));
    }
    let step = arguments.step.map_or(1, usize::from);
    let lesson = arguments.lesson.map(|lesson| Link::Lesson { lesson: lesson.into(), step });
    let effort = (arguments.accuracy.fidelity(), arguments.accuracy.budget);
    gui::open(opened, arguments.lessons.clone(), link.or(lesson), effort)
        .map_err(|error| no_window(error.to_string()))?;
    Ok(Exit::Solved)
}

/// The error, with a hint at what may be missing on this system.
fn no_window(reason: String) -> CliError {
    let mut advice = String::new();
    if cfg!(windows) {
        advice.push_str("\n(the window needs OpenGL 2.0 or Direct3D 12)");
    } else if !cfg!(feature = "wgpu") && !no_display() {
        advice.push_str(
            "\n(the window needs OpenGL 2.0; built with --features wgpu it can be drawn by Vulkan or Metal as well)",
        );
    }
    if Path::new("/etc/debian_version").exists() {
        advice.push_str(
            "\n(on a bare Debian the window also needs: libx11-6 libxcursor1 libxi6 libxrandr2 libx11-xcb1 libxkbcommon-x11-0 libgl1)",
        );
    }
    CliError::System(format!(
        "no window can be opened: {reason}\nwithout a window, try squeezefilm solve fundamental or squeezefilm --help{advice}"
    ))
}

/// Whether it is known beforehand that no window can be opened.
fn no_display() -> bool {
    let unset = |name: &str| std::env::var_os(name).is_none_or(|value| value.is_empty());
    cfg!(all(unix, not(target_os = "macos"))) && unset("DISPLAY") && unset("WAYLAND_DISPLAY")
}
