//! The rotor as a table: of its compliance, with rows (wavenumber \[1/m\], compliance \[m²/N\]), or of its Green's function, with rows
//! (x \[mm\], deflection \[µm/N\]) that begin at x = 0. The first column ascends.
//!
//! A preset gives it inline,
//!
//! ```toml
//! [rotor]
//! model = "table"
//! compliance = [[241.4, 1.9e-9], [482.8, 1.2e-9]]   # [wavenumber_per_m, compliance_m2_per_n]
//! ```
//!
//! or as `compliance_csv = "file.csv"`, a path relative to the preset's folder. The CSV file has the header
//! `wavenumber_per_m,compliance_m2_per_n` or `harmonic,compliance_m2_per_n`; harmonics n = 1, 2, … become wavenumbers
//! k = 2πn/λ with the wavelength λ = 2πr/waves of the scene. With `model = "green"` the keys are `green` and `green_csv`, and the header
//! is `x_mm,deflection_um_per_n`: the deflection at x under a unit force at 0, which is the same on its other side. Lines that start with
//! `#` are comments. The scene keeps the rows, so that a saved preset needs no second file and a change of `motor.waves` leaves the rotor
//! as it is.

use super::error::{Fault, FaultKind, SceneError, check_count};
use super::parameter::{Belongs, Parameter, Scale, number, whole};
use super::value::{Value, show_number, show_text};
use crate::input::csv_line;
use std::path::Path;

/// Most rows of a table.
pub const MOST_ROWS: usize = 100_000;

/// The columns of a table of compliances. They are described like keys, so that messages about both are alike.
pub static COMPLIANCE: [Parameter; 2] = [
    column("wavenumber_per_m", "1/m", 1e-3, 1e9, "Wavenumber k"),
    column("compliance_m2_per_n", "m²/N", 1e-20, 1.0, "Displacement amplitude over line-load amplitude"),
];

/// The columns of a table of the Green's function.
pub static GREEN: [Parameter; 2] = [
    column("x_mm", "mm", 0.0, 1e4, "Distance x from the force, along the ring"),
    column("deflection_um_per_n", "µm/N", -1e6, 1e6, "Deflection at x under a unit force"),
];

/// The column that a CSV file may have in place of the wavenumber.
static HARMONIC: Parameter =
    whole("harmonic", Belongs::Motor, (1, 1_000_000_000), 1, "Harmonic n of the wavelength λ, k = 2πn/λ");

const fn column(key: &'static str, unit: &'static str, min: f64, max: f64, about: &'static str) -> Parameter {
    number(key, unit, Belongs::Motor, (min, max), (min, max), Scale::Log, max, about)
}

/// Checks one row against the ranges of its columns and the row `before`.
fn check_row(columns: &'static [Parameter; 2], row: (f64, f64), before: Option<f64>) -> Result<(), FaultKind> {
    for (column, value) in columns.iter().zip([row.0, row.1]) {
        column.accept(Value::Number(value))?;
    }
    let key = columns[0].key;
    let message = match before.map(|before| (before, row.0 <= before)) {
        Some((before, true)) => format!("is not above {}, the one before: sort the rows", show_number(before)),
        None if row.0 != 0.0 && key == GREEN[0].key => {
            "is not 0: the first row is the deflection under the force itself".to_owned()
        }
        _ => return Ok(()),
    };
    Err(FaultKind::Rule { key, message: format!("{key} = {} {message}", show_number(row.0)) })
}

/// The fault of a row that is not two numbers, as written.
pub(super) fn not_a_pair(found: &str, [first, second]: &[Parameter; 2]) -> FaultKind {
    let message = format!("{} is not a pair of numbers, {} and {}", show_text(found), first.key, second.key);
    FaultKind::Rule { key: first.key, message }
}

/// Checks how many rows there are.
pub(super) fn check_row_count(key: &'static str, rows: usize) -> Result<(), FaultKind> {
    check_count(key, "rows", rows, 1..=MOST_ROWS)
}

/// The valid rows of a table. `fault` is called for every other row, with its place.
pub(super) fn in_order<P>(
    key: &'static str,
    columns: &'static [Parameter; 2],
    rows: impl Iterator<Item = (P, Result<(f64, f64), FaultKind>)>,
    mut fault: impl FnMut(P, FaultKind),
) -> Vec<(f64, f64)> {
    let mut good: Vec<(f64, f64)> = Vec::new();
    for ((place, row), number) in rows.zip(1..) {
        let before = good.last().map(|row| row.0);
        match row.and_then(|row| check_row(columns, row, before).map(|()| row)) {
            Ok(row) => good.push(row),
            Err(wrong) => fault(place, FaultKind::Within { key, which: format!("row {number}"), fault: wrong.into() }),
        }
    }
    good
}

/// Reads the text of a CSV file for the `key` that names it. `wavelength` \[m\] turns harmonics into wavenumbers. Faults carry `path` and
/// the line.
pub(super) fn read_csv(
    key: &'static str,
    columns: &'static [Parameter; 2],
    text: &str,
    path: &Path,
    wavelength: f64,
) -> Result<Vec<(f64, f64)>, SceneError> {
    let fault = |line, what| Fault { line, ..Fault::of_file(path, what) };
    let text = text.trim_start_matches('\u{feff}');
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    // The reader returns no errors, because the input is text and lines may have any length.
    let mut records = reader.records().filter_map(Result::ok);

    // The header that was found is not shown, because the path may be that of any file on this machine.
    let other_header = || {
        let (what, other) = match columns[1].key {
            "compliance_m2_per_n" => ("compliance table", "harmonic,compliance_m2_per_n or "),
            _ => ("table of a deflection", ""),
        };
        let [first, second] = columns.each_ref().map(|column| column.key);
        FaultKind::Rule {
            key,
            message: format!("{key}: this is no {what}: expected the header {other}{first},{second}"),
        }
    };
    let Some(header) = records.next() else { return Err(fault(Some(1), other_header()).into()) };
    let line_of = |record: &csv::StringRecord| csv_line(text, record.position()).map(|line| line as usize);
    let harmonics = match header.iter().collect::<Vec<_>>()[..] {
        ["harmonic", second] if second == COMPLIANCE[1].key && columns[1].key == second => true,
        [first, second] if [first, second] == [columns[0].key, columns[1].key] => false,
        _ => return Err(fault(line_of(&header), other_header()).into()),
    };

    let mut count = 0;
    let records = records.take(MOST_ROWS + 1).inspect(|_| count += 1);
    let records = records.map(|record| (line_of(&record), row_of(&record, columns, harmonics, wavelength)));
    let mut faults = SceneError::none();
    let rows = in_order(key, columns, records, |line, wrong| faults.push(fault(line, wrong)));
    check_row_count(key, count).unwrap_or_else(|wrong| faults.push(fault(None, wrong)));
    faults.or(rows)
}

fn row_of(
    record: &csv::StringRecord,
    columns: &'static [Parameter; 2],
    harmonics: bool,
    wavelength: f64,
) -> Result<(f64, f64), FaultKind> {
    let [first, second] = record.iter().collect::<Vec<_>>()[..] else {
        return Err(not_a_pair(&record.iter().collect::<Vec<_>>().join(","), columns));
    };
    let number = |column: &'static Parameter, field| {
        let value = column.accept(column.read(field)?)?;
        Ok::<_, FaultKind>(value.as_number().unwrap_or(f64::NAN))
    };
    let wavenumber = if harmonics {
        std::f64::consts::TAU * number(&HARMONIC, first)? / wavelength
    } else {
        number(&columns[0], first)?
    };
    Ok((wavenumber, number(&columns[1], second)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEY: &str = "rotor.compliance_csv";

    fn lines(text: &str) -> Vec<(Option<usize>, String)> {
        let faults = read_csv(KEY, &COMPLIANCE, text, Path::new("r.csv"), 1.0).unwrap_err();
        faults.faults().iter().map(|fault| (fault.line, fault.to_string())).collect()
    }

    #[test]
    fn harmonics_become_wavenumbers() {
        let text = "# a comment\nharmonic, compliance_m2_per_n\n1, 2e-9\n\n3, 1e-9\n";
        let rows = read_csv(KEY, &COMPLIANCE, text, Path::new("r.csv"), 0.5).unwrap();
        assert_eq!(rows, [(2.0 * std::f64::consts::TAU, 2e-9), (6.0 * std::f64::consts::TAU, 1e-9)]);
    }

    #[test]
    fn faults_name_the_line_of_the_csv() {
        let text = "wavenumber_per_m,compliance_m2_per_n\n# note\n10,1e-9\n\n20,x\n30\n5,1e-9\n40,-1\n50,nan\n";
        let found = lines(text);
        let expected = [
            (
                5,
                "r.csv:5: rotor.compliance_csv, row 2: compliance_m2_per_n = x is not a number: expected a number from 1e-20",
            ),
            (6, "r.csv:6: rotor.compliance_csv, row 3: 30 is not a pair of numbers"),
            (7, "r.csv:7: rotor.compliance_csv, row 4: wavenumber_per_m = 5 is not above 10, the one before"),
            (
                8,
                "r.csv:8: rotor.compliance_csv, row 5: compliance_m2_per_n = -1 is out of range: allowed 1e-20 to 1 m²/N",
            ),
            (
                9,
                "r.csv:9: rotor.compliance_csv, row 6: compliance_m2_per_n = NaN is not finite: expected a number from 1e-20",
            ),
        ];
        assert_eq!(found.len(), expected.len());
        for ((line, message), (at, start)) in found.iter().zip(expected) {
            assert_eq!(*line, Some(at));
            assert!(message.starts_with(start), "{message}");
        }
    }

    #[test]
    fn another_header_and_an_empty_table_are_refused() {
        assert!(
            lines("\n\nk,c\n1,2\n")[0].1.starts_with("r.csv:3: rotor.compliance_csv: this is no compliance table: ")
        );
        assert!(!lines("root:x:0:0\n")[0].1.contains("root"));
        assert!(lines("")[0].1.contains("expected the header harmonic,compliance_m2_per_n"));
        assert!(lines("harmonic,compliance_m2_per_n\n")[0].1.contains("has 0 rows"));
        assert!(
            lines("harmonic,compliance_m2_per_n\n1.5,1e-9\n")[0]
                .1
                .contains("harmonic = 1.5 is of the wrong type: expected a whole number from 1 to")
        );
    }

    #[test]
    fn a_greens_function_begins_at_its_force() {
        let read = |text: &str| read_csv("rotor.green_csv", &GREEN, text, Path::new("g.csv"), 1.0);
        assert_eq!(read("x_mm,deflection_um_per_n\n0,0.6\n1,-0.1\n").unwrap(), [(0.0, 0.6), (1.0, -0.1)]);
        let told = |text: &str| read(text).unwrap_err().to_string();
        assert!(told("x_mm,deflection_um_per_n\n0.5,0.6\n").contains("row 1: x_mm = 0.5 is not 0"));
        assert!(told("x_mm,deflection_um_per_n\n0,0.6\n0,0.5\n").contains("x_mm = 0 is not above 0, the one before"));
        let told = told("harmonic,compliance_m2_per_n\n1,1e-9\n");
        assert!(told.contains("expected the header x_mm,deflection_um_per_n"), "{told}");
    }
}
