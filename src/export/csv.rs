//! The fields of one cycle as CSV text: a header row with the unit in every name, then numbers of nine digits.
//!
//! | file | one row for | columns |
//! | --- | --- | --- |
//! | fields | time step, tooth, node | where it is, the surfaces, film thickness, line loads |
//! | pressure | time step, node of the map | absolute pressure under one tooth |
//! | series | time step | loads, teeth in contact, extremes |
//!
//! The sum of line load × `length_m` over the rows of one time is the load in the series. Fields of a plate have no
//! teeth and no contact; a strip's forces are per metre of width, and its columns are named so.

use crate::analysis::quantity::force_unit;
use crate::problem::{Problem, Scenario};
use crate::recording::Recording;
use serde::Serialize;
use serde_json::Value;
use std::borrow::Cow;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Writes the fields of every tooth, time by time. x runs along the wavelength from the middle of the first tooth; of a
/// plate, from its middle, and only over the half that was solved.
pub fn fields(problem: &Problem, recording: &Recording, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new(out);
    let (motor, per_metre) = match &problem.scenario {
        Scenario::Motor(motor) => (Some(motor), false),
        Scenario::Plate(plate) => (None, plate.width.is_none()),
    };
    let film = if per_metre { "film_n_per_m2" } else { "film_n_per_m" };
    match motor {
        Some(_) => table.header(&[
            "time_s",
            "phase",
            "tooth",
            "x_m",
            "length_m",
            "stator_nm",
            "film_thickness_nm",
            "gap_nm",
            "rotor_nm",
            "contact_n_per_m",
            film,
        ])?,
        None if recording.radial => {
            table.header(&["time_s", "phase", "radius_m", "area_m2", "film_thickness_nm", film])?;
        }
        None => table.header(&["time_s", "phase", "x_m", "length_m", "film_thickness_nm", film])?,
    }
    for frame in 0..recording.frames {
        let (time, phase) = (recording.time(frame), frame as f64 / recording.frames as f64);
        for tooth in 0..recording.teeth {
            let line = recording.line_offset(tooth, frame);
            let middle = tooth as f64 * recording.pitch;
            for (i, (x, length)) in recording.x.iter().zip(&recording.node_length).enumerate() {
                let (thickness, film) = (recording.film_thickness[line + i], recording.film[line + i]);
                let Some(motor) = motor else {
                    table.row([time, phase, *x, *length, thickness * 1e9, film].map(Number))?;
                    continue;
                };
                let (stator, gap) = (recording.stator[line + i], thickness - motor.spacing());
                let surfaces = [stator, thickness, gap, stator + gap].map(|height| height * 1e9);
                let forces = [recording.contact[line + i], film];
                let before = [Number(time), Number(phase), Whole(tooth), Number(middle + x), Number(*length)];
                table.row(before.into_iter().chain(surfaces.into_iter().chain(forces).map(Number)))?;
            }
        }
    }
    table.finish()
}

/// Writes the pressure under the first tooth (or the plate), time by time, over the part that was solved: with a
/// mirrored half width y ≥ 0 only.
pub fn pressure(recording: &Recording, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new(out);
    table.header(&["time_s", "x_m", "y_m", "pressure_kpa"])?;
    let mut values = recording.pressure.iter();
    for frame in 0..recording.frames {
        let time = recording.time(frame);
        for x in &recording.map_x {
            for (y, pressure) in recording.map_y.iter().zip(&mut values) {
                table.row([time, *x, *y, pressure * 1e-3].map(Number))?;
            }
        }
    }
    table.finish()
}

/// Writes what the whole wavelength (or the plate) does, time by time.
pub fn series(problem: &Problem, recording: &Recording, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new(out);
    let motor = matches!(problem.scenario, Scenario::Motor(_));
    let force = |name: &str| format!("{name}_{}", force_unit(problem).to_lowercase().replace('/', "_per_"));
    let names = ["time_s", &force("film_load"), "contact_load_n", "teeth_in_contact", "min_film_thickness_nm"];
    let errors = [&force("film_load_error"), "min_film_thickness_error_nm", "max_pressure_error_kpa"];
    let names = names.into_iter().filter(|name| motor || !["contact_load_n", "teeth_in_contact"].contains(name));
    table.writer.write_record(names.chain(["max_pressure_kpa"]).chain(errors))?;
    for frame in 0..recording.frames {
        let loads = [recording.time(frame), recording.film_load[frame]].map(Number);
        let contact = || [Number(recording.contact_load[frame]), Whole(recording.teeth_in_contact[frame])];
        let extremes = [recording.min_film_thickness[frame] * 1e9, recording.max_pressure[frame] * 1e-3].map(Number);
        let errors = [
            (&recording.film_load_error, 1.0),
            (&recording.min_film_thickness_error, 1e9),
            (&recording.max_pressure_error, 1e-3),
        ]
        .map(|(errors, unit)| errors.get(frame).map_or(Nothing, |error| Number(error * unit)));
        let contact = motor.then(contact).into_iter().flatten();
        table.row(loads.into_iter().chain(contact).chain(extremes).chain(errors))?;
    }
    table.finish()
}

/// Writes one row for each object, with the keys of the first as the header; what is null is empty. Numbers are those of JSON.
pub fn rows<T: Serialize>(rows: impl IntoIterator<Item = T>, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    for (i, row) in rows.into_iter().enumerate() {
        let Value::Object(row) = serde_json::to_value(row)? else { return Err(io::Error::other("a row is no object")) };
        if i == 0 {
            writer.write_record(row.keys())?;
        }
        writer.write_record(row.values().map(|value| {
            match value {
                Value::Null => Cow::Borrowed(""),
                Value::String(text) => Cow::Borrowed(text.as_str()),
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

/// A text that is not ours, such as a scene's name, as a cell. What a spreadsheet would take for a formula begins with an
/// apostrophe, by which it knows it for text.
pub fn words(text: &str) -> Cow<'_, str> {
    if text.starts_with(['=', '+', '-', '−', '@', '＝', '＋', '－', '＠', '\t', '\r']) {
        format!("'{text}").into()
    } else {
        text.into()
    }
}

/// What a field holds.
pub(super) enum Cell {
    /// Nine digits.
    Number(f64),
    Whole(usize),
    Nothing,
}
use Cell::{Nothing, Number, Whole};

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

    pub(super) fn row(&mut self, cells: impl IntoIterator<Item = Cell>) -> io::Result<()> {
        for cell in cells {
            self.text.clear();
            // Writing to a String cannot fail.
            let _ = match cell {
                Number(0.0) => write!(self.text, "0"),
                Number(value) => write!(self.text, "{value:.8e}"),
                Whole(value) => write!(self.text, "{value}"),
                Nothing => Ok(()),
            };
            self.writer.write_field(&self.text)?;
        }
        Ok(self.writer.write_record(None::<&[u8]>)?)
    }

    pub(super) fn finish(mut self) -> io::Result<()> {
        self.writer.flush()
    }
}
