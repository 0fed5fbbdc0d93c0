//! The fields of one cycle by name, with the unit in the name, for other programs.
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
//! | `film_load_n`, `contact_load_n`, `teeth_in_contact` | frames | on one wavelength (a strip: `film_load_n_per_m`); the contact load's error is the film load's |
//! | `min_film_thickness_nm`, `max_pressure_kpa` | frames | the least film thickness and the highest pressure at every instant |
//! | `film_load_error_n`, `teeth_in_contact_error`, `min_film_thickness_error_nm`, `max_pressure_error_kpa` | frames | stated errors, absolute; NaN if there are none |

use crate::problem::{Problem, Scenario};
use crate::recording::Recording;

/// A field.
pub struct Field<'a> {
    /// Its name, with the unit.
    pub name: &'static str,
    /// The name of each of its axes, the last one fastest: `frame`, `tooth`, `node`, `map_x`, `map_y`.
    pub axes: &'static [&'static str],
    /// The length of each axis.
    pub shape: Vec<usize>,
    /// The values, as many as the shape says.
    pub values: Box<dyn Iterator<Item = f64> + 'a>,
}

/// The axes of a series.
pub const FRAMES: &[&str] = &["frame"];

/// All fields of a solve.
pub fn fields<'a>(problem: &'a Problem, recording: &'a Recording) -> Vec<Field<'a>> {
    const LINES: &[&str] = &["frame", "tooth", "node"];
    let length = |axis: &str| match axis {
        "frame" => recording.frames,
        "tooth" => recording.teeth,
        "node" => recording.x.len(),
        "map_x" => recording.map_x.len(),
        _ => recording.map_y.len(),
    };
    let field = |name, axes: &'static [&'static str], values| {
        let shape = axes.iter().map(|axis| length(axis)).collect();
        Field { name, axes, shape, values }
    };
    let of = |values: &'a [f64], unit: f64| -> Box<dyn Iterator<Item = f64> + 'a> {
        Box::new(values.iter().map(move |value| value * unit))
    };
    let [position, size] = if recording.radial { ["radius_m", "node_area_m2"] } else { ["x_m", "node_length_m"] };
    let mut all = vec![
        field("time_s", FRAMES, Box::new((0..recording.frames).map(|frame| recording.time(frame)))),
        field(position, &["node"], of(&recording.x, 1.0)),
        field(size, &["node"], of(&recording.node_length, 1.0)),
    ];
    let (mut contact, mut touching_error) = (Vec::new(), None);
    // A recording on one mesh has no errors.
    let of_errors = |name, errors: Vec<f64>| {
        let none = std::iter::repeat(f64::NAN);
        field(name, FRAMES, Box::new(errors.into_iter().chain(none).take(recording.frames)))
    };
    let (axes, film, load, error): (&'static [&'static str], _, _, _) = match &problem.scenario {
        Scenario::Motor(motor) => {
            let (spacing, pitch) = (motor.spacing() * 1e9, recording.pitch);
            let gap = lines(recording, &recording.film_thickness, 1e9).map(move |h| h - spacing);
            let middles = (0..recording.teeth).map(move |tooth| tooth as f64 * pitch);
            let touching = recording.teeth_in_contact.iter().map(|teeth| *teeth as f64);
            all.extend([
                field("tooth_middle_m", &["tooth"], Box::new(middles)),
                field("stator_nm", LINES, Box::new(lines(recording, &recording.stator, 1e9))),
                field("gap_nm", LINES, Box::new(gap)),
                field("contact_n_per_m", LINES, Box::new(lines(recording, &recording.contact, 1.0))),
            ]);
            contact = vec![
                field("contact_load_n", FRAMES, of(&recording.contact_load, 1.0)),
                field("teeth_in_contact", FRAMES, Box::new(touching)),
            ];
            let errors = recording.touching_errors(motor.touching_thickness());
            touching_error = Some(of_errors("teeth_in_contact_error", errors));
            (LINES, "film_n_per_m", "film_load_n", "film_load_error_n")
        }
        Scenario::Plate(plate) if plate.is_strip() => {
            (&["frame", "node"], "film_n_per_m2", "film_load_n_per_m", "film_load_error_n_per_m")
        }
        Scenario::Plate(_) if recording.radial => {
            (&["frame", "node"], "film_n_per_m2", "film_load_n", "film_load_error_n")
        }
        Scenario::Plate(_) => (&["frame", "node"], "film_n_per_m", "film_load_n", "film_load_error_n"),
    };
    all.extend([
        field("film_thickness_nm", axes, Box::new(lines(recording, &recording.film_thickness, 1e9))),
        field(film, axes, Box::new(lines(recording, &recording.film, 1.0))),
        field(load, FRAMES, of(&recording.film_load, 1.0)),
    ]);
    all.extend(contact);
    all.extend([
        field("min_film_thickness_nm", FRAMES, of(&recording.min_film_thickness, 1e9)),
        field("max_pressure_kpa", FRAMES, of(&recording.max_pressure, 1e-3)),
    ]);
    for (name, errors, unit) in [
        (error, &recording.film_load_error, 1.0),
        ("min_film_thickness_error_nm", &recording.min_film_thickness_error, 1e9),
        ("max_pressure_error_kpa", &recording.max_pressure_error, 1e-3),
    ] {
        all.push(of_errors(name, errors.iter().map(|error| error * unit).collect()));
    }
    all.extend(touching_error);
    all.extend([
        field("map_x_m", &["map_x"], of(&recording.map_x, 1.0)),
        field("map_y_m", &["map_y"], of(&recording.map_y, 1.0)),
        field("pressure_kpa", &["frame", "map_x", "map_y"], of(&recording.pressure, 1e-3)),
    ]);
    all
}

/// A field of all teeth, frame by frame, tooth by tooth.
fn lines<'a>(recording: &'a Recording, field: &'a [f64], scale: f64) -> impl Iterator<Item = f64> + 'a {
    let teeth = move |frame: usize| (0..recording.teeth).map(move |tooth| recording.line_offset(tooth, frame));
    let line = move |at: usize| field[at..at + recording.x.len()].iter().map(move |value| value * scale);
    (0..recording.frames).flat_map(teeth).flat_map(line)
}
