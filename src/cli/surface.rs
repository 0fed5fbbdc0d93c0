//! `squeezefilm surface`: statistics of measured faces, and the lines for a preset that follow from them.

use super::columns::{Columns, paragraph};
use super::exit::{CliError, Exit};
use super::options::{OutputOptions, STANDARD_INPUT, standard_input, whole};
use super::terminal;
use crate::digits::{signed, significant};
use crate::export::figures::surface::figure;
use crate::export::files::Files;
use crate::export::json;
use crate::export::surface::{RATIOS, lay, lengths, object, preset};
use crate::input::read_text;
use crate::scene::heights::LARGEST;
use crate::surface::height_map::HeightMap;
use crate::surface::texture::{Pair, Texture, measured};
use clap::Args;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  squeezefilm surface face.csv
  squeezefilm surface rotor.csv stator.csv --degree 2 --out results";

const FILES: &str = "\
A file is a grid of heights, with lines \"# dx_um = 0.5\", \"# dy_um = 0.5\" and \"# height = nm\" before them and a line of numbers for \
each y; or a profile: a line \"x_um,z_nm\", then a pair on each line. Units are m, mm, um and nm. x is along the wave. \
Instruments that write X3P or SUR export such tables too.

Files of --out:
  surface.json      what --json prints
  face-1.svg        heights and autocorrelation of the first file; and face-1.png, face-2.…
  surface.toml      lines for a preset";

/// Statistics of measured faces, and the spacing, asperities and flow factors from them
///
/// The heights are levelled first. Two files, the rotor's face and the stator's, or one file that represents both, give H_m as the paper
/// defines it (the mean of both peak-to-valley heights), the summits (McCool 1987) and the lay, as lines for a preset.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{FILES}\n\n{EXAMPLES}"))]
pub(super) struct Arguments {
    /// Measured heights: of the rotor's face and of the stator's, or one file that represents both; - for standard input
    #[arg(value_name = "FILE", num_args = 1..=2, required = true)]
    files: Vec<PathBuf>,

    /// Degree of the polynomial that is subtracted: 1 levels, 2 also removes curvature
    #[arg(long, value_name = "DEGREE", default_value_t = 1, value_parser = whole::<u8>(0..=2), allow_negative_numbers = true)]
    degree: u8,

    #[command(flatten)]
    output: OutputOptions,
}

pub(super) fn run(arguments: &Arguments, command: &[String]) -> Result<Exit, CliError> {
    let folder = arguments.output.folder(command)?;
    let faces = arguments.files.iter().map(|file| face(file, arguments.degree)).collect::<Result<Vec<_>, _>>()?;
    let (Some((_, (_, rotor))), Some((_, (_, stator)))) = (faces.first(), faces.last()) else {
        return Ok(Exit::BadInput);
    };
    let pair = Pair::of(rotor, stator);
    let object = object(faces.iter().map(|(name, (map, texture))| (name.as_str(), map, texture)), &pair);
    terminal::result(arguments.output.json, || json::document(&object, command), || text(&faces, &pair));
    if let Some(folder) = &folder {
        let mut files = Files::new(folder)?;
        files.json("surface.json", &object)?;
        files.text("surface.toml", &preset(&pair))?;
        for (number, (name, (map, texture))) in (1..).zip(&faces) {
            files.figure(&format!("face-{number}"), &figure(name, map, texture))?;
        }
        terminal::wrote(folder.path, &files.commit()?);
    }
    Ok(Exit::Solved)
}

/// A levelled face, with the name of its file.
type Face = (String, (HeightMap, Texture));

fn face(file: &Path, degree: u8) -> Result<Face, CliError> {
    let piped = file.as_os_str() == STANDARD_INPUT;
    let file = if piped { Path::new("standard input") } else { file };
    let text = if piped {
        standard_input(LARGEST)?
    } else {
        read_text(file, LARGEST).map_err(|fault| CliError::file(file, fault))?
    };
    let face = measured(&text, usize::from(degree)).map_err(|fault| CliError::file(file, fault))?;
    Ok((file.file_name().unwrap_or_default().to_string_lossy().into_owned(), face))
}

fn text(faces: &[Face], pair: &Pair) -> String {
    let mut columns = Columns::new();
    let mut of_faces = |name: &str, value: &dyn Fn(&Face) -> String, note: &str| {
        columns.row([name.to_owned()].into_iter().chain(faces.iter().map(value)).chain([note.to_owned()]));
    };
    of_faces("", &|(name, _)| name.clone(), "");
    of_faces("points", &|(_, (map, _))| format!("{} × {}", map.nx, map.ny), "along x, the wave, and y");
    let mut row = |name: &str, value: &dyn Fn(&Texture) -> String, note: &str| {
        of_faces(name, &|(_, (_, texture))| value(texture), note);
    };
    row("Sa", &|face| format!("{} nm", significant(face.mean * 1e9, 4)), "mean magnitude of the heights, level");
    row("Sq", &|face| format!("{} nm", significant(face.rms * 1e9, 4)), "their standard deviation");
    row("Sz", &|face| format!("{} nm", significant(face.peak_to_valley * 1e9, 4)), "peak to valley");
    row(
        "Ssk, Sku",
        &|face| format!("{}, {}", signed(format!("{:.2}", face.skewness)), signed(format!("{:.2}", face.kurtosis))),
        "skewness and kurtosis; 0 and 3 if normally distributed",
    );
    row(
        "correlation length",
        &|face| lengths(face, face.correlation),
        "along x and y, where the autocorrelation falls to ½",
    );
    row("", &|face| lengths(face, face.correlation_fifth), "where it falls to 0.2 (ISO 25178-2)");
    row("lay  γ", &|face| lay(face).unwrap_or_else(|| "unknown, taken to be 1".to_owned()), "along x over across");
    let mut text = columns.text(&[]);
    let (number, same) = (faces.len(), "Both faces are taken to be like it. ");
    text.push_str(&paragraph(
        &format!(
            "{}Summits follow from slopes and curvatures between neighbouring points, so they depend on the resolution. Bandwidth m₀m₄/m₂² = {}.",
            if number == 1 { same } else { "" },
            significant(pair.bandwidth, 3)
        ),
        "\n",
        "",
    ));
    let mut factors = Columns::new();
    let mut row = |name: &str, digits: usize, value: &dyn Fn(f64) -> f64| {
        let values = RATIOS.map(|ratio| significant(value(ratio), digits));
        factors.row([name.to_owned()].into_iter().chain(values));
    };
    row("h/σ", 2, &|ratio| ratio);
    row("φ along x", 3, &|ratio| pair.flow_factors(ratio)[0]);
    row("φ along y", 3, &|ratio| pair.flow_factors(ratio)[1]);
    text + &factors.text(&[1, 2, 3, 4]) + "\n" + &preset(pair)
}
