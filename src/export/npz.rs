//! The fields of one cycle as a NumPy archive, `fields.npz`: arrays of float64 with the unit in their names, the axes as separate arrays,
//! and the provenance as text. `numpy.load` reads it in one line.
//!
//! An archive is a zip of files in NumPy's format, version 1.0: a magic string, a header with type, order and shape, and the numbers as
//! they are in memory (<https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>). They are stored without compression,
//! which costs a few megabytes and saves seconds. The entries have no time stamps, so that a run gives the same bytes every time.
//!
//! Beside the [`fields`] there are `preset`, `version`, `fidelity` and `scene_toml` as text.

use super::fields::{Field, fields};
use crate::problem::Problem;
use crate::scene::Scene;
use crate::solution::Solution;
use std::io::{self, BufWriter, Write};
use zip::write::{SimpleFileOptions, StreamWriter};
use zip::{CompressionMethod, ZipWriter};

/// Writes the archive of a solve of `scene`.
pub fn write(scene: &Scene, problem: &Problem, solution: &Solution, out: &mut dyn Write) -> io::Result<()> {
    let mut archive = Archive(ZipWriter::new_stream(out));
    for Field { name, shape, values, .. } in fields(problem, &solution.recording) {
        archive.numbers(name, &shape, values)?;
    }
    archive.text("preset", &problem.name)?;
    archive.text("version", env!("CARGO_PKG_VERSION"))?;
    archive.text("fidelity", &solution.model.fidelity)?;
    archive.text("scene_toml", &scene.to_toml())?;
    archive.0.finish().map_err(io::Error::from)?.flush()
}

/// A zip as a stream: sizes and checksums follow each array, and the index is at the end.
struct Archive<'a>(ZipWriter<StreamWriter<&'a mut dyn Write>>);

impl Archive<'_> {
    fn begin(&mut self, name: &str, kind: &str, shape: &[usize]) -> io::Result<()> {
        // The format has to know in advance about an array larger than 4 GB.
        let large = shape.iter().product::<usize>() as u64 * 8 >= u64::from(u32::MAX) - 1024;
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored).large_file(large);
        self.0.start_file(format!("{name}.npy"), options).map_err(io::Error::from)?;
        self.0.write_all(&header(kind, shape))
    }

    /// Numbers, the last index fastest; their count follows from the shape.
    fn numbers(&mut self, name: &str, shape: &[usize], values: impl IntoIterator<Item = f64>) -> io::Result<()> {
        self.begin(name, "<f8", shape)?;
        let mut buffered = BufWriter::new(&mut self.0);
        values.into_iter().try_for_each(|value| buffered.write_all(&value.to_le_bytes()))?;
        buffered.flush()
    }

    /// A text as an array without dimensions; NumPy's characters have four bytes.
    fn text(&mut self, name: &str, text: &str) -> io::Result<()> {
        let count = text.chars().count().max(1);
        self.begin(name, &format!("<U{count}"), &[])?;
        let mut bytes: Vec<u8> = text.chars().flat_map(|c| u32::from(c).to_le_bytes()).collect();
        bytes.resize(4 * count, 0);
        self.0.write_all(&bytes)
    }
}

/// Magic string, version, length, and a Python dictionary, padded so that the numbers begin at a multiple of 64.
fn header(kind: &str, shape: &[usize]) -> Vec<u8> {
    const BEFORE: usize = 10;
    // A Python tuple of one element has a comma.
    let shape: Vec<String> = shape.iter().map(|length| format!("{length},")).collect();
    let words = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}), }}", shape.join(" "));
    let length = (BEFORE + words.len() + 1).next_multiple_of(64) - BEFORE;
    let padded = length - 1;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes());
    bytes.extend(format!("{words:<padded$}\n").as_bytes());
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
