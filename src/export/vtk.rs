//! The fields of one cycle for ParaView and other programs that read VTK: faces on both sides of the film, one file for each instant.
//!
//! For a motor this is the whole ring: the tops of all teeth, and the rotor above them, as wide as the contact. For a plate it is the wall
//! and the plate; a strip is drawn as wide as it is long. All points lie in one plane \[mm\], because the heights are too small to be
//! visible: `height_mm` is a vector for the warp filter, with a factor of about a thousand. The points have `pressure_kpa` (absolute),
//! `film_thickness_nm` and `face`: 0 below the film, 1 above it.
//!
//! The format is VTK's own ("legacy", version 3.0, binary): a few lines of text, each followed by numbers of four bytes, the most significant first
//! (<https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html>).

use super::figures::mirrored;
use crate::problem::{Problem, Scenario};
use crate::recording::Recording;
use crate::recording::sample::column;
use std::f64::consts::TAU;
use std::io::{self, Write};

/// Number of points round a disc, or across a strip.
const ROUND: usize = 96;

/// A line of points across the film, all with the same film thickness.
struct Across {
    /// Their positions in the plane of the faces \[m\].
    places: Vec<[f64; 2]>,
    /// Absolute pressure \[Pa\] at each.
    pressure: Vec<f64>,
    /// Height of the lower face \[m\].
    bottom: f64,
    /// Height of the upper face \[m\].
    top: f64,
    /// Film thickness \[m\].
    thickness: f64,
}

/// Points and the faces between them.
#[derive(Default)]
struct Mesh {
    points: Vec<[f64; 3]>,
    quads: Vec<[usize; 4]>,
    /// Height of each point, and the values that [`SCALARS`] names.
    values: Vec<(f64, [f64; 3])>,
}

/// The numbers of a point beside its height.
const SCALARS: [&str; 3] = ["pressure_kpa", "film_thickness_nm", "face"];

impl Mesh {
    /// Adds both faces of a piece, from lines with equal numbers of points.
    fn add(&mut self, lines: &[Across]) {
        for face in [0.0, 1.0] {
            let first = self.points.len();
            for line in lines {
                let height = if face == 0.0 { line.bottom } else { line.top };
                for ([x, y], pressure) in line.places.iter().zip(&line.pressure) {
                    self.points.push([1e3 * x, 1e3 * y, 0.0]);
                    self.values.push((1e3 * height, [1e-3 * pressure, 1e9 * line.thickness, face]));
                }
            }
            let across = lines.first().map_or(0, |line| line.places.len());
            for i in 1..lines.len() {
                for j in 1..across {
                    let near = first + (i - 1) * across + j;
                    self.quads.push([near - 1, near, near + across, near + across - 1]);
                }
            }
        }
    }
}

/// Writes the faces at a frame of the cycle. If no map of the pressure was recorded, it writes no faces and returns `Ok`.
pub fn write(problem: &Problem, recording: &Recording, frame: usize, out: &mut dyn Write) -> io::Result<()> {
    let mut mesh = Mesh::default();
    match &problem.scenario {
        Scenario::Motor(motor) => {
            let turn = TAU / (f64::from(motor.waves) * motor.wavelength());
            for wave in 0..motor.waves {
                for tooth in 0..recording.teeth {
                    let middle = f64::from(wave) * motor.wavelength() + tooth as f64 * recording.pitch;
                    let place = |x: f64, y: f64| {
                        let (sin, cos) = (turn * (middle + x)).sin_cos();
                        [(motor.contact_radius + y) * cos, (motor.contact_radius + y) * sin]
                    };
                    let line = recording.line_offset(tooth, frame);
                    let heights = |i: usize| {
                        let bottom = recording.stator[line + i];
                        (bottom, bottom + recording.film_thickness[line + i] - motor.spacing())
                    };
                    mesh.add(&piece(recording, (tooth, frame), &place, &heights));
                }
            }
        }
        Scenario::Plate(plate) => {
            let line = recording.line_offset(0, frame);
            let heights = |i: usize| (0.0, recording.film_thickness[line + i]);
            let strip = plate.is_strip();
            let place = |x: f64, y: f64| match (recording.radial, strip) {
                // The position across is then an angle, or a share of the length.
                (true, _) => [x * y.cos(), x * y.sin()],
                (false, true) => [x, y * plate.length / TAU],
                (false, false) => [x, y],
            };
            mesh.add(&piece(recording, (0, frame), &place, &heights));
        }
    }
    Vtk(out).write(&format!("{}, t/T = {:.4}", problem.name, frame as f64 / recording.frames as f64), &mesh)
}

/// The lines of a piece: over the length that was solved and its mirror image, and the same across, or round the disc.
fn piece(
    recording: &Recording,
    (tooth, frame): (usize, usize),
    place: &dyn Fn(f64, f64) -> [f64; 2],
    heights: &dyn Fn(usize) -> (f64, f64),
) -> Vec<Across> {
    let mut stored = vec![0.0; recording.map_y.len()];
    let nodes = &recording.x;
    let half = recording.half_length && !recording.radial && nodes.first().is_some_and(|x| *x >= 0.0);
    let line = recording.line_offset(tooth, frame);
    // Round a disc, or across a strip, all values are the same.
    let alone = recording.map_y.len() < 2;
    mirrored(nodes, half)
        .into_iter()
        .filter_map(|(x, i)| {
            if !column(recording, tooth, x, frame as f64, &mut stored) {
                return None;
            }
            let (ys, pressure): (Vec<f64>, Vec<f64>) = if alone {
                let pressure = stored.first().copied().unwrap_or(f64::NAN);
                (0..=ROUND).map(|i| (TAU * i as f64 / ROUND as f64, pressure)).unzip()
            } else {
                mirrored(&recording.map_y, recording.half_width).into_iter().map(|(y, j)| (y, stored[j])).unzip()
            };
            let (bottom, top) = heights(i);
            let places = ys.into_iter().map(|y| place(x, y)).collect();
            Some(Across { places, pressure, bottom, top, thickness: recording.film_thickness[line + i] })
        })
        .collect()
}

struct Vtk<'a>(&'a mut dyn Write);

impl Vtk<'_> {
    fn write(&mut self, title: &str, mesh: &Mesh) -> io::Result<()> {
        // The title is one line of at most 255 characters.
        let title: String = title.chars().map(|c| if c.is_control() { ' ' } else { c }).take(200).collect();
        let (points, quads) = (mesh.points.len(), mesh.quads.len());
        writeln!(
            self.0,
            "# vtk DataFile Version 3.0\n{title}\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS {points} float"
        )?;
        self.numbers(mesh.points.iter().flatten().copied())?;
        writeln!(self.0, "CELLS {quads} {}", 5 * quads)?;
        self.whole(mesh.quads.iter().flat_map(|quad| [&4].into_iter().chain(quad)))?;
        writeln!(self.0, "CELL_TYPES {quads}")?;
        // Type 9 is a quadrilateral.
        self.whole(std::iter::repeat_n(&9, quads))?;
        writeln!(self.0, "POINT_DATA {points}\nVECTORS height_mm float")?;
        self.numbers(mesh.values.iter().flat_map(|(height, _)| [0.0, 0.0, *height]))?;
        for (i, name) in SCALARS.into_iter().enumerate() {
            writeln!(self.0, "SCALARS {name} float 1\nLOOKUP_TABLE default")?;
            self.numbers(mesh.values.iter().map(|(_, scalars)| scalars[i]))?;
        }
        self.0.flush()
    }

    fn numbers(&mut self, values: impl Iterator<Item = f64>) -> io::Result<()> {
        self.bytes(values.map(|value| (value as f32).to_be_bytes()))
    }

    fn whole<'a>(&mut self, values: impl Iterator<Item = &'a usize>) -> io::Result<()> {
        self.bytes(values.map(|value| (*value as u32).to_be_bytes()))
    }

    fn bytes(&mut self, numbers: impl Iterator<Item = [u8; 4]>) -> io::Result<()> {
        let mut bytes: Vec<u8> = numbers.flatten().collect();
        bytes.push(b'\n');
        self.0.write_all(&bytes)
    }
}

/// The file names of a cycle, and the series file for ParaView: JSON with the time of each.
pub fn series(recording: &Recording) -> (Vec<String>, String) {
    let names: Vec<String> = (0..recording.frames).map(|frame| format!("film-{frame:04}.vtk")).collect();
    let files = names.iter().enumerate();
    let files: Vec<_> =
        files.map(|(frame, name)| serde_json::json!({ "name": name, "time": recording.time(frame) })).collect();
    (names, super::json::text(&serde_json::json!({ "file-series-version": "1.0", "files": files })))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_the_lengths_that_its_text_says() {
        let line = |x: f64, thickness| Across {
            places: vec![[x, 0.0], [x, 1e-3]],
            pressure: vec![1e5, 2e5],
            bottom: 1e-6,
            top: 2e-6,
            thickness,
        };
        let (mut mesh, mut file) = (Mesh::default(), Vec::new());
        mesh.add(&[line(0.0, 1e-6), line(1e-3, 2e-6)]);
        assert_eq!((mesh.points.len(), mesh.quads.len()), (8, 2));
        Vtk(&mut file).write("Name\nwith a line", &mesh).unwrap();
        let text = String::from_utf8_lossy(&file);
        assert!(text.starts_with("# vtk DataFile Version 3.0\nName with a line\nBINARY\n"), "{text}");
        let after =
            |words: &str| file.windows(words.len()).position(|part| part == words.as_bytes()).unwrap() + words.len();
        assert_eq!(file[after("POINTS 8 float\n")..][96..][..13], *b"\nCELLS 2 10\n\0");
        assert_eq!(file[after("CELLS 2 10\n")..][..8], [0, 0, 0, 4, 0, 0, 0, 0]);
        assert_eq!(file[after("SCALARS pressure_kpa float 1\nLOOKUP_TABLE default\n")..][..4], 100_f32.to_be_bytes());
    }
}
