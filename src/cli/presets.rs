//! `squeezefilm presets`: lists the built-in presets, or prints one as a file to start from.

use super::columns::Columns;
use super::exit::{CliError, Exit};
use super::options::{SceneOptions, named_path};
use super::{new, terminal};
use crate::atomic::write_file;
use crate::digits::capitalised;
use crate::export::json;
use crate::scene::presets::{BUILT_IN, BuiltIn};
use crate::scene::{Scene, SceneError};
use clap::Args;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Lists the built-in presets, or prints one as a file to start your own from
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  squeezefilm presets
  squeezefilm presets fundamental --out my.toml
  squeezefilm presets fundamental --set film.min_spacing_nm=100 > smoother.toml")]
pub(super) struct Arguments {
    /// Prints this preset (a built-in name or a path) as a TOML file
    #[arg(value_name = "PRESET")]
    preset: Option<String>,

    /// Prints JSON to standard output
    #[arg(long)]
    json: bool,

    /// Writes the preset into this file instead
    #[arg(long, value_name = "FILE", requires = "preset", conflicts_with = "json", value_parser = named_path())]
    out: Option<PathBuf>,

    /// Replaces an existing file
    #[arg(long, requires = "out")]
    replace: bool,

    #[command(flatten)]
    scene: SceneOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<Exit, CliError> {
    match &arguments.preset {
        Some(preset) => print_one(preset, arguments)?,
        None if !arguments.scene.changes.is_empty() => {
            return Err(CliError::usage("--set needs a PRESET to change: squeezefilm presets fundamental --set …"));
        }
        None => print_all(arguments.json)?,
    }
    Ok(Exit::Solved)
}

fn object(preset: &str, scene: &Scene, toml: Option<&str>) -> Value {
    let mut object = json!({ "preset": preset, "name": scene.name, "about": scene.about, "scene": scene.scene() });
    if let Some(built_in) = BuiltIn::find(preset) {
        object["group"] = built_in.group.into();
    }
    toml.into_iter().for_each(|toml| object["toml"] = toml.into());
    object
}

fn print_one(preset: &str, arguments: &Arguments) -> Result<(), CliError> {
    let scene = arguments.scene.scene(preset)?;
    // An unchanged built-in preset keeps the comments in its file.
    let toml = match BuiltIn::find(preset) {
        Some(built_in) if arguments.scene.changes.is_empty() => built_in.toml.to_owned(),
        _ => scene.to_toml(),
    };
    if let Some(path) = &arguments.out {
        new::free(path, arguments.replace)?;
        write_file(path, |out| out.write_all(toml.as_bytes()))?;
        terminal::note(&format!("wrote {}", path.display()));
    } else if arguments.json {
        terminal::data(&json::text(&object(preset, &scene, Some(&toml))));
    } else {
        terminal::data(&toml);
    }
    Ok(())
}

fn print_all(as_json: bool) -> Result<(), CliError> {
    let read = |built_in: &'static BuiltIn| Ok((built_in, built_in.scene()?));
    let scenes = BUILT_IN.iter().map(read).collect::<Result<Vec<_>, SceneError>>()?;
    if as_json {
        let objects: Vec<_> = scenes.iter().map(|(preset, scene)| object(preset.name, scene, None)).collect();
        terminal::data(&json::text(&objects));
        return Ok(());
    }
    // One set of columns for all groups, so that they line up; the headings go in between.
    let mut columns = Columns::new();
    for (preset, scene) in &scenes {
        columns.row([preset.name, &about(scene)]);
    }
    let (lines, mut last, mut text) = (columns.text(&[]), "", String::new());
    for (line, (preset, _)) in lines.lines().zip(&scenes) {
        if preset.group != last {
            let gap = if last.is_empty() { "" } else { "\n" };
            text.push_str(&format!("{gap}{}\n", preset.group));
            last = preset.group;
        }
        text.push_str(line);
        text.push('\n');
    }
    terminal::text(&text);
    Ok(())
}

/// Description of a preset, without the part that the heading of its group repeats.
fn about(scene: &Scene) -> String {
    let rest = ["Maeno and Bogy 1992, Table I, ", "Maeno and Bogy 1992, Table I: ", "Beyond Table I: "];
    capitalised(rest.iter().find_map(|prefix| scene.about.strip_prefix(prefix)).unwrap_or(&scene.about))
}
