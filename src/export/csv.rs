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

use crate::problem::{Problem, Scenario};
use crate::recording::Recording;
use serde::Serialize;
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
        None => table.header(&["time_s", "phase", "x_m", "length_m", "film_thickness_nm", film])?,
    }
    for frame in 0..recording.frames {
        let (time, phase) = (recording.time(frame), frame as f64 / recording.frames as f64);
        for tooth in 0..recording.teeth {
            let line = recording.line_offset(tooth, frame);
            let middle = tooth as f64 * recording.pitch;
            for (i, (x, length)) in recording.x.iter().zip(&recording.node_length).enumerate() {
                let thickness = recording.film_thickness[line + i];
                table.number(time)?;
                table.number(phase)?;
                if let Some(motor) = motor {
                    let (stator, gap) = (recording.stator[line + i], thickness - motor.min_spacing);
                    table.whole(tooth)?;
                    table.number(middle + x)?;
                    table.number(*length)?;
                    table.number(stator * 1e9)?;
                    table.number(thickness * 1e9)?;
                    table.number(gap * 1e9)?;
                    table.number((stator + gap) * 1e9)?;
                    table.number(recording.contact[line + i])?;
                } else {
                    table.number(*x)?;
                    table.number(*length)?;
                    table.number(thickness * 1e9)?;
                }
                table.number(recording.film[line + i])?;
                table.end_row()?;
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
                for number in [time, *x, *y, pressure * 1e-3] {
                    table.number(number)?;
                }
                table.end_row()?;
            }
        }
    }
    table.finish()
}

/// Writes what the whole wavelength (or the plate) does, time by time.
pub fn series(problem: &Problem, recording: &Recording, out: &mut dyn Write) -> io::Result<()> {
    let mut table = Table::new(out);
    let motor = match &problem.scenario {
        Scenario::Motor(_) => {
            table.header(&[
                "time_s",
                "film_load_n",
                "contact_load_n",
                "teeth_in_contact",
                "min_film_thickness_nm",
                "max_pressure_kpa",
                "film_load_error_n",
                "min_film_thickness_error_nm",
                "max_pressure_error_kpa",
            ])?;
            true
        }
        Scenario::Plate(plate) => {
            let load = if plate.width.is_none() { "film_load_n_per_m" } else { "film_load_n" };
            let error = if plate.width.is_none() { "film_load_error_n_per_m" } else { "film_load_error_n" };
            table.header(&[
                "time_s",
                load,
                "min_film_thickness_nm",
                "max_pressure_kpa",
                error,
                "min_film_thickness_error_nm",
                "max_pressure_error_kpa",
            ])?;
            false
        }
    };
    for frame in 0..recording.frames {
        table.number(recording.time(frame))?;
        table.number(recording.film_load[frame])?;
        if motor {
            table.number(recording.contact_load[frame])?;
            table.whole(recording.teeth_in_contact[frame])?;
        }
        table.number(recording.min_film_thickness[frame] * 1e9)?;
        table.number(recording.max_pressure[frame] * 1e-3)?;
        for (errors, unit) in [
            (&recording.film_load_error, 1.0),
            (&recording.min_film_thickness_error, 1e9),
            (&recording.max_pressure_error, 1e-3),
        ] {
            match errors.get(frame) {
                Some(error) => table.number(error * unit)?,
                None => table.nothing()?,
            }
        }
        table.end_row()?;
    }
    table.finish()
}

/// Writes one row for each object, the header first; what is null is empty.
pub fn rows<T: Serialize>(rows: impl IntoIterator<Item = T>, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    rows.into_iter().try_for_each(|row| writer.serialize(row))?;
    writer.flush()
}

/// A text that is not ours, such as a scene's name, as a cell. What a spreadsheet would take for a formula begins with an
/// apostrophe, by which it knows it for text.
pub fn words(text: &str) -> Cow<'_, str> {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) { format!("'{text}").into() } else { text.into() }
}

/// A CSV file of numbers, field by field.
struct Table<'a> {
    writer: csv::Writer<&'a mut dyn Write>,
    text: String,
}

impl<'a> Table<'a> {
    fn new(out: &'a mut dyn Write) -> Self {
        Self { writer: csv::Writer::from_writer(out), text: String::new() }
    }

    fn header(&mut self, names: &[&str]) -> io::Result<()> {
        Ok(self.writer.write_record(names)?)
    }

    fn number(&mut self, value: f64) -> io::Result<()> {
        self.text.clear();
        // Writing to a String cannot fail.
        let _ = if value == 0.0 { write!(self.text, "0") } else { write!(self.text, "{value:.8e}") };
        Ok(self.writer.write_field(&self.text)?)
    }

    fn nothing(&mut self) -> io::Result<()> {
        Ok(self.writer.write_field("")?)
    }

    fn whole(&mut self, value: usize) -> io::Result<()> {
        Ok(self.writer.write_field(value.to_string())?)
    }

    fn end_row(&mut self) -> io::Result<()> {
        Ok(self.writer.write_record(None::<&[u8]>)?)
    }

    fn finish(mut self) -> io::Result<()> {
        self.writer.flush()
    }
}
