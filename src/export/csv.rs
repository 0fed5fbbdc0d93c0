//! The fields of one cycle as CSV text: a header row with the unit in every name, then numbers of nine digits.
//!
//! | file | one row for | columns |
//! | --- | --- | --- |
//! | fields | time step, tooth, node | where it is, the surfaces, film thickness, line loads |
//! | pressure | time step, node of the map | absolute pressure under one tooth |
//! | series | time step | loads, teeth in contact, extremes |
//!
//! The sum of line load × `length_m` over the rows of one time is the load in the series. Fields of a plate have no teeth and no contact; a
//! strip's forces are per metre of width, and its columns have names to match.

use super::fields;
use crate::problem::Problem;
use crate::recording::Recording;
use serde::Serialize;
use serde_json::Value;
use std::borrow::Cow;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Writes the fields of every tooth, time by time. x is measured along the wavelength from the middle of the first tooth. For a plate, x is
/// measured from its middle, over the half that was solved.
pub fn fields(problem: &Problem, recording: &Recording, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new(out);
    let motor = problem.scenario.motor();
    let per_area = problem.scenario.plate().is_some_and(|plate| plate.width.is_none());
    let film = if per_area { "film_n_per_m2" } else { "film_n_per_m" };
    let [position, size] = if recording.radial { ["radius_m", "area_m2"] } else { ["x_m", "length_m"] };
    let of_teeth = ["stator_nm", "film_thickness_nm", "gap_nm", "rotor_nm", "contact_n_per_m", film];
    match motor {
        Some(_) => table.header(&[&["time_s", "phase", "tooth", position, size][..], &of_teeth].concat())?,
        None => table.header(&["time_s", "phase", position, size, "film_thickness_nm", film])?,
    }
    for frame in 0..recording.frames {
        let (time, phase) = (recording.time(frame), frame as f64 / recording.frames as f64);
        for tooth in 0..recording.teeth {
            let line = recording.line_offset(tooth, frame);
            let middle = tooth as f64 * recording.pitch;
            for (i, (x, length)) in recording.x.iter().zip(&recording.node_length).enumerate() {
                let (thickness, film) = (recording.film_thickness[line + i], recording.film[line + i]);
                let Some(motor) = motor else {
                    table.row([time, phase, *x, *length, thickness * 1e9, film])?;
                    continue;
                };
                let (stator, gap) = (recording.stator[line + i], thickness - motor.spacing());
                let surfaces = [stator, thickness, gap, stator + gap].map(|height| height * 1e9);
                let forces = [recording.contact[line + i], film];
                let before = [time, phase, tooth as f64, middle + x, *length];
                table.row(before.into_iter().chain(surfaces).chain(forces))?;
            }
        }
    }
    table.finish()
}

/// Writes the pressure under the first tooth (or the plate), time by time, over the part that was solved; if the width is mirrored, only y
/// ≥ 0.
pub fn pressure(recording: &Recording, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new(out);
    table.header(&["time_s", "x_m", "y_m", "pressure_kpa"])?;
    let mut values = recording.pressure.iter();
    for frame in 0..recording.frames {
        let time = recording.time(frame);
        for x in &recording.map_x {
            for (y, pressure) in recording.map_y.iter().zip(&mut values) {
                table.row([time, *x, *y, pressure * 1e-3])?;
            }
        }
    }
    table.finish()
}

/// Writes the series of the whole wavelength (or the plate), time by time: every field that has one value for each frame.
pub fn series(problem: &Problem, recording: &Recording, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new(out);
    let series = fields::fields(problem, recording).into_iter().filter(|field| field.axes == fields::FRAMES);
    let (names, mut columns): (Vec<_>, Vec<_>) = series.map(|field| (field.name, field.values)).unzip();
    table.header(&names)?;
    for _ in 0..recording.frames {
        table.row(columns.iter_mut().map(|values| values.next().unwrap_or(f64::NAN)))?;
    }
    table.finish()
}

/// Writes one row for each object, with the keys of the first as the header; null is an empty cell. Numbers are written as in JSON, texts
/// by [`words`].
pub fn rows<T: Serialize>(rows: impl IntoIterator<Item = T>, out: &mut dyn Write) -> io::Result<()> {
    rows_with(rows, words, out)
}

/// As [`rows`], for texts of the program itself, such as options, which are written unchanged.
pub fn rows_of_ours<T: Serialize>(rows: impl IntoIterator<Item = T>, out: &mut dyn Write) -> io::Result<()> {
    rows_with(rows, |text| text.into(), out)
}

fn rows_with<T: Serialize>(
    rows: impl IntoIterator<Item = T>,
    cell: fn(&str) -> Cow<'_, str>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    for (i, row) in rows.into_iter().enumerate() {
        let Value::Object(row) = serde_json::to_value(row)? else { return Err(io::Error::other("a row is no object")) };
        if i == 0 {
            writer.write_record(row.keys())?;
        }
        writer.write_record(row.values().map(|value| {
            match value {
                Value::Null => Cow::Borrowed(""),
                Value::String(text) => cell(text),
                other => Cow::Owned(other.to_string()),
            }
            .into_owned()
        }))?;
    }
    writer.flush()
}

/// The fewest digits that read back to the same bits.
pub fn number(value: f64) -> String {
    format!("{value:?}")
}

/// A text from outside, such as a scene's name, as a cell. If a spreadsheet would take it for a formula, it gets an apostrophe in front,
/// which marks it as text.
pub fn words(text: &str) -> Cow<'_, str> {
    if text.starts_with(['=', '+', '-', '−', '@', '＝', '＋', '－', '＠', '\t', '\r']) {
        format!("'{text}").into()
    } else {
        text.into()
    }
}

/// A CSV file of numbers, row by row.
pub(super) struct Table<'a> {
    writer: csv::Writer<&'a mut dyn Write>,
    text: String,
}

impl<'a> Table<'a> {
    pub(super) fn new(out: &'a mut dyn Write) -> Self {
        Self { writer: csv::Writer::from_writer(out), text: String::new() }
    }

    pub(super) fn header<S: AsRef<str>>(&mut self, names: &[S]) -> io::Result<()> {
        Ok(self.writer.write_record(names.iter().map(AsRef::as_ref))?)
    }

    /// Each number with nine digits, whole numbers unchanged; a value that is not finite is an empty cell.
    pub(super) fn row(&mut self, cells: impl IntoIterator<Item = f64>) -> io::Result<()> {
        for value in cells {
            self.text.clear();
            // Writing to a String cannot fail; a sum with zero removes a negative zero's sign.
            let _ = match value + 0.0 {
                whole if whole.fract() == 0.0 && whole.abs() < 1e9 => write!(self.text, "{whole}"),
                value if value.is_finite() => write!(self.text, "{value:.8e}"),
                _ => Ok(()),
            };
            self.writer.write_field(&self.text)?;
        }
        Ok(self.writer.write_record(None::<&[u8]>)?)
    }

    pub(super) fn finish(mut self) -> io::Result<()> {
        self.writer.flush()
    }
}
