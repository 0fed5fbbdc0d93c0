//! `squeezefilm animate`: one cycle as moving pictures.

use super::exit::{CliError, Exit};
use super::options::{PRESET, SceneOptions, SolveOptions, named_path, whole, within};
use super::progress::Bar;
use super::terminal;
use crate::analysis::quantity::force_unit;
use crate::atomic::{check_file, check_writable};
use crate::digits::{counted, percent};
use crate::export::animation::{Format, Options, count, frame_name};
use crate::export::files::{self, Control, Solved};
use crate::export::json::TIME_UP;
use crate::problem::Problem;
use crate::solution::{Accuracy, Status, StoppedBy, settled};
use crate::solve::solve;
use clap::Args;
use std::path::PathBuf;

/// Solves a preset and writes one cycle as an animation: GIF, MP4, animated PNG, or a folder of PNG
///
/// An MP4 holds AV1 video and repeats the cycle to fill twelve seconds, as players do not loop by themselves. It takes some ten times as
/// long to write as a GIF. At twice the --width the file is about half as large again (MP4) or nearly three times as large (GIF), and takes
/// about three times as long.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  squeezefilm animate fundamental --out wave.gif
  squeezefilm animate fundamental --out wave.mp4 --width 1280
  squeezefilm animate levitating --out levitating.png --seconds 6
  squeezefilm animate plate-crossover --out frames --width 1920")]
pub(super) struct Arguments {
    #[arg(value_name = "PRESET", help = PRESET)]
    preset: String,

    /// The file, .gif, .mp4 or .png (animated), or a folder for the frames, one PNG each
    #[arg(long, value_name = "FILE", value_parser = named_path())]
    out: PathBuf,

    /// Width in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = Options::default().width, value_parser = whole::<u32>(100..=4000), allow_negative_numbers = true)]
    width: u32,

    /// How long the cycle takes on screen
    #[arg(long, value_name = "SECONDS", default_value_t = Options::default().seconds, value_parser = within(0.2..=120.0, "a number of seconds"), allow_negative_numbers = true)]
    seconds: f64,

    /// Maximum number of frames; the frames are evenly spaced time steps. An MP4 has at least 24 frames a second, interpolated between
    /// time steps if necessary, unless fewer than 60 frames are requested
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = whole::<u16>(2..=1000), allow_negative_numbers = true)]
    frames: u16,

    #[command(flatten)]
    scene: SceneOptions,

    #[command(flatten)]
    solve: SolveOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<Exit, CliError> {
    // A wrong extension or folder is reported before the work, not after it.
    let format = Format::of(&arguments.out)?;
    match format {
        Format::Folder => check_writable(&arguments.out)?,
        Format::Gif | Format::Apng | Format::Mp4 => check_file(&arguments.out)?,
    }
    let scene = arguments.scene.scene(&arguments.preset)?;
    let problem = Problem::try_from(&scene)?;
    let (settings, cancel) = arguments.solve.begin()?;

    let mut bar = Bar::solve(force_unit(&problem));
    let solved = solve(&problem, &settings, &mut bar, &cancel);
    let reached = bar.reached();
    drop(bar);
    let solution = solved?;
    if solution.status == Status::Cancelled {
        terminal::note(&format!("cancelled {reached}; no file was written"));
        return Ok(Exit::Other);
    }
    let problem = settled(&problem, &solution.outcome);
    solution.warnings.iter().for_each(|warning| terminal::warning(warning));

    let options = Options { width: arguments.width, seconds: arguments.seconds, frames: usize::from(arguments.frames) };
    let count = count(&solution.recording, &options, format);
    let bar = Bar::points(count, 0);
    let solved = Solved { scene: &scene, problem: &problem, solution: &solution, history: &[] };
    let control = Control { cancel: &cancel, drawn: &|_, _| bar.point_done("frames") };
    files::animation(&arguments.out, &solved, &options, &control)?;
    drop(bar);
    let Accuracy { stated, stopped_by, .. } = solution.accuracy;
    let late = if stopped_by == StoppedBy::Budget {
        format!("; {TIME_UP}, stated error {}", percent(stated))
    } else {
        String::new()
    };
    terminal::note(&format!("wrote {}: {count} frames{late}", arguments.out.display()));
    let is_there = |number: &usize| arguments.out.join(frame_name(*number)).is_file();
    let older = (count + 1..).take_while(is_there).count();
    if format == Format::Folder && older > 0 {
        let older = counted(older, "frame", "frames");
        terminal::warning(&format!("{older} of an earlier run there, from {} on", frame_name(count + 1)));
    }
    Ok(Exit::of(&solution.status))
}
