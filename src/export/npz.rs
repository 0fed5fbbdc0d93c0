//! The fields of one cycle as a NumPy archive, `fields.npz`: arrays of float64 under names with their unit, axes as arrays of
//! their own, and where the numbers come from as text. `numpy.load` reads it in one line.
//!
//! An archive is a zip of files in NumPy's format, version 1.0: a magic string, a header that says type, order and shape, and
//! the numbers as they are in memory (<https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>). They
//! are stored, not compressed, which costs a few megabytes and saves seconds; entries carry no time, so that a run
//! gives the same bytes every time.
//!
//! | array | shape | what |
//! | --- | --- | --- |
//! | `time_s` | frames | the instants of one cycle |
//! | `x_m`, `node_length_m` | nodes | along a tooth from its middle (a plate: from its own), and the length each node stands for (a round plate: `radius_m`, `node_area_m2`) |
//! | `tooth_middle_m` | teeth | where the middles of the teeth are (motor) |
//! | `stator_nm`, `gap_nm`, `contact_n_per_m` | frames × teeth × nodes | fields on the lines of all teeth (motor) |
//! | `film_thickness_nm`, `film_n_per_m` | frames × teeth × nodes, of a plate frames × nodes | the same of both scenes (a strip or a round plate: `film_n_per_m2`) |
//! | `map_x_m`, `map_y_m` | | where the pressure is, of a symmetric film only the half that was solved |
//! | `pressure_kpa` | frames × map_x × map_y | absolute, under the first tooth |
//! | `film_load_n`, `contact_load_n`, `teeth_in_contact` | frames | on one wavelength (a strip: `film_load_n_per_m`) |
//! | `preset`, `version`, `fidelity`, `scene_toml` | | text |

use crate::problem::{Problem, Scenario};
use crate::recording::Recording;
use crate::scene::Scene;
use crate::solution::Solution;
use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};
use zip::write::{SimpleFileOptions, StreamWriter};
use zip::{CompressionMethod, ZipWriter};

/// Writes the archive of a solve of `scene`.
pub fn write(scene: &Scene, problem: &Problem, solution: &Solution, out: &mut dyn Write) -> io::Result<()> {
    let mut archive = Archive(ZipWriter::new_stream(out));
    let recording = &solution.recording;
    let (frames, nodes, teeth) = (recording.frames, recording.x.len(), recording.teeth);
    let times: Vec<f64> = (0..frames).map(|frame| recording.time(frame)).collect();
    archive.numbers("time_s", &[frames], times)?;
    let names = if recording.radial { ["radius_m", "node_area_m2"] } else { ["x_m", "node_length_m"] };
    archive.numbers(names[0], &[nodes], recording.x.iter().copied())?;
    archive.numbers(names[1], &[nodes], recording.node_length.iter().copied())?;
    let (film, load) = match &problem.scenario {
        Scenario::Motor(motor) => {
            let shape = [frames, teeth, nodes];
            archive.numbers("tooth_middle_m", &[teeth], (0..teeth).map(|tooth| tooth as f64 * recording.pitch))?;
            archive.numbers("stator_nm", &shape, lines(recording, &recording.stator, 1e9))?;
            let gap = lines(recording, &recording.film_thickness, 1e9).map(|h| h - motor.spacing() * 1e9);
            archive.numbers("gap_nm", &shape, gap)?;
            archive.numbers("contact_n_per_m", &shape, lines(recording, &recording.contact, 1.0))?;
            archive.numbers("contact_load_n", &[frames], recording.contact_load.iter().copied())?;
            archive.numbers("teeth_in_contact", &[frames], recording.teeth_in_contact.iter().map(|n| *n as f64))?;
            ("film_n_per_m", "film_load_n")
        }
        Scenario::Plate(plate) if plate.is_strip() => ("film_n_per_m2", "film_load_n_per_m"),
        Scenario::Plate(_) if recording.radial => ("film_n_per_m2", "film_load_n"),
        Scenario::Plate(_) => ("film_n_per_m", "film_load_n"),
    };
    let shape: &[usize] =
        if matches!(problem.scenario, Scenario::Motor(_)) { &[frames, teeth, nodes] } else { &[frames, nodes] };
    archive.numbers("film_thickness_nm", shape, lines(recording, &recording.film_thickness, 1e9))?;
    archive.numbers(film, shape, lines(recording, &recording.film, 1.0))?;
    archive.numbers(load, &[frames], recording.film_load.iter().copied())?;
    let loads = format!("{}_error{}", &load[..9], &load[9..]);
    for (name, errors, unit) in [
        (loads.as_str(), &recording.film_load_error, 1.0),
        ("max_pressure_error_kpa", &recording.max_pressure_error, 1e-3),
    ] {
        archive.numbers(name, &[errors.len()], errors.iter().map(|error| error * unit))?;
    }
    let (nx, ny) = (recording.map_x.len(), recording.map_y.len());
    archive.numbers("map_x_m", &[nx], recording.map_x.iter().copied())?;
    archive.numbers("map_y_m", &[ny], recording.map_y.iter().copied())?;
    archive.numbers("pressure_kpa", &[frames, nx, ny], recording.pressure.iter().map(|p| p * 1e-3))?;
    archive.text("preset", &problem.name)?;
    archive.text("version", env!("CARGO_PKG_VERSION"))?;
    archive.text("fidelity", &solution.model.fidelity)?;
    archive.text("scene_toml", &scene.to_toml())?;
    archive.0.finish().map_err(io::Error::from)?.flush()
}

/// A field of all teeth, frame by frame, tooth by tooth.
fn lines<'a>(recording: &'a Recording, field: &'a [f64], scale: f64) -> impl Iterator<Item = f64> + 'a {
    let teeth = move |frame: usize| (0..recording.teeth).map(move |tooth| recording.line_offset(tooth, frame));
    let line = move |at: usize| field[at..at + recording.x.len()].iter().map(move |value| value * scale);
    (0..recording.frames).flat_map(teeth).flat_map(line)
}

/// A zip as a stream: sizes and sums follow each array, and the index is at the end.
struct Archive<'a>(ZipWriter<StreamWriter<&'a mut dyn Write>>);

impl Archive<'_> {
    fn begin(&mut self, name: &str, kind: &str, shape: &[usize]) -> io::Result<()> {
        // The format has to be told beforehand of an array beyond 4 GB.
        let large = shape.iter().product::<usize>() as u64 * 8 >= u64::from(u32::MAX) - 1024;
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored).large_file(large);
        self.0.start_file(format!("{name}.npy"), options).map_err(io::Error::from)?;
        self.0.write_all(&header(kind, shape))
    }

    /// Numbers, the last index fastest; as many as the shape says.
    fn numbers(&mut self, name: &str, shape: &[usize], values: impl IntoIterator<Item = f64>) -> io::Result<()> {
        self.begin(name, "<f8", shape)?;
        let mut buffered = BufWriter::new(&mut self.0);
        values.into_iter().try_for_each(|value| buffered.write_all(&value.to_le_bytes()))?;
        buffered.flush()
    }

    /// A text without shape: NumPy's own characters have four bytes.
    fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        let count = text.chars().count().max(1);
        self.begin(name, &format!("<U{count}"), &[])?;
        let mut bytes: Vec<u8> = text.chars().flat_map(|c| u32::from(c).to_le_bytes()).collect();
        bytes.resize(4 * count, 0);
        self.0.write_all(&bytes)
    }
}

/// Magic string, version, length, and a dictionary of Python, padded so that the numbers begin at a multiple of 64.
fn header(kind: &str, shape: &[usize]) -> Vec<u8> {
    const BEFORE: usize = 10;
    let mut words = String::new();
    // A tuple of one has a comma in Python. Writing to a String cannot fail.
    let shape: String = shape.iter().fold(String::new(), |mut all, length| {
        let _ = write!(all, "{length}, ");
        all
    });
    let _ = write!(words, "{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}), }}", shape.trim_end());
    let length = (BEFORE + words.len() + 1).next_multiple_of(64) - BEFORE;
    while words.len() + 1 < length {
        words.push(' ');
    }
    words.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes());
    bytes.extend(words.as_bytes());
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_those_of_numpy() {
        let bytes = header("<f8", &[3, 4]);
        assert!(bytes.len().is_multiple_of(64) && bytes.ends_with(b" \n"));
        assert!(bytes[10..].starts_with(b"{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4,), }"));
        assert_eq!(usize::from(u16::from_le_bytes([bytes[8], bytes[9]])) + 10, bytes.len());
        assert!(header("<U5", &[]).windows(13).any(|part| part == b"'shape': (), "));
    }
}
