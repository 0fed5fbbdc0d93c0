//! An incomplete sweep, or a part of a sweep, as a CSV file, which is saved while it is solved, continued, and joined to the whole.
//!
//! The first line is a comment: a JSON object that says which sweep, and which part of it, the rows belong to. The rest is the CSV of a
//! sweep with a checksum in each row. Numbers are written with the fewest digits that read back to the same bits, so that a sweep in parts
//! is the same, byte by byte, as a sweep that is solved at once.

use super::sweep::{BETWEEN, FIRST, STOPPED_BY, VALIDITY, header, record};
use crate::analysis::attempt::RunStatus;
use crate::analysis::error::AnalysisError;
use crate::analysis::quantity::{Numbers, Quantity};
use crate::analysis::sweep::{MOST_POINTS, Sweep, SweepPart, SweepRow, Vary, digest};
use crate::analysis::validity::NAMES;
use crate::input::csv_fault;
use crate::scene::Scene;
use crate::solution::StoppedBy;
use crate::solve::Settings;
use serde::{Deserialize, Serialize};
use std::fmt::Display;
use std::io::{self, Write};
use std::ops::Range;
use std::time::Duration;

/// Largest file of rows that is read \[MB\]: larger than a sweep with the greatest number of points.
pub const LARGEST: u64 = 512;

/// The last column.
const CHECK: &str = "check";
/// First character of a comment line.
const COMMENT: u8 = b'#';

/// Header in the first line: which sweep the rows belong to.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Head {
    sweep: String,
    /// Which part, as `3/64`; the whole is `1/1`.
    part: String,
    scene_toml: String,
    /// Keys that are varied and their values, as on the command line.
    vary: Vec<String>,
    settings: Settings,
    budget: Option<Duration>,
    /// The command line that solves the whole.
    command: Vec<String>,
}

/// Writes rows of a part of a sweep, to be continued or joined. `command` is the command line that solves the whole, if there is one.
pub fn write(
    sweep: &Sweep,
    part: SweepPart,
    rows: &[SweepRow],
    command: &[String],
    out: &mut dyn Write,
) -> io::Result<()> {
    let fingerprint = sweep.fingerprint();
    let head = Head {
        sweep: fingerprint.clone(),
        part: part.to_string(),
        scene_toml: sweep.scene().to_toml(),
        vary: sweep.vary().iter().map(ToString::to_string).collect(),
        settings: *sweep.settings(),
        budget: sweep.budget,
        command: command.to_vec(),
    };
    writeln!(out, "{} {}", char::from(COMMENT), serde_json::to_string(&head)?)?;
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(header(sweep).iter().map(String::as_str).chain([CHECK]))?;
    for row in rows {
        let mut cells = record(sweep, &fingerprint, row);
        cells.push(digest(cells.iter().map(String::as_str)));
        writer.write_record(cells)?;
    }
    writer.flush()
}

/// Message about a file of a different sweep.
const ANOTHER: &str = "it is of another sweep: another scene, range, setting, budget or version";

/// Message about a file that is not part of a sweep.
const NO_PART: &str = "it is no part of a sweep as sweep --part saves it";

/// Message about a damaged file; lines are counted from 1.
fn damaged(line: u64, fault: impl Display) -> String {
    format!("line {line}: {fault}")
}

fn head(text: &str) -> Result<Head, String> {
    let first = text.lines().next().unwrap_or_default();
    let object = first.strip_prefix(char::from(COMMENT)).map(str::trim_start);
    let object = object.filter(|object| object.starts_with('{')).ok_or(NO_PART)?;
    serde_json::from_str(object).map_err(|error| damaged(1, error))
}

/// Rows of a part of `sweep` from the text that [`write()`] made of them.
///
/// # Errors
/// Why these are not such rows. A row that is not expected, occurs twice, or was changed after it was written, counts as damage.
pub fn read(sweep: &Sweep, part: SweepPart, text: &str) -> Result<Vec<SweepRow>, String> {
    let (fingerprint, head) = (sweep.fingerprint(), head(text)?);
    if head.sweep != fingerprint {
        return Err(ANOTHER.to_owned());
    }
    if head.part != part.to_string() {
        return Err(format!("it is part {} of the sweep, not {part}", head.part));
    }
    rows(sweep, &fingerprint, sweep.points_of(part), text)
}

/// The rows of a text, which all must belong to these `points`.
fn rows(sweep: &Sweep, fingerprint: &str, points: Range<usize>, text: &str) -> Result<Vec<SweepRow>, String> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(COMMENT)).from_reader(text.as_bytes());
    let found = reader.headers().map_err(|error| damaged(2, error))?;
    if !found.iter().eq(header(sweep).iter().map(String::as_str).chain([CHECK])) {
        return Err(ANOTHER.to_owned());
    }
    let (quantities, mut there) = (sweep.quantities(), vec![false; points.len()]);
    let mut rows: Vec<SweepRow> = Vec::new();
    for record in reader.records() {
        let record =
            record.map_err(|error| damaged(error.position().map_or(0, csv::Position::line), csv_fault(&error)))?;
        let line = record.position().map_or(0, csv::Position::line);
        // The reader refuses a record whose length differs from that of the header.
        let field = |column: usize| record.get(column).unwrap_or("");
        if field(0) != fingerprint {
            return Err(ANOTHER.to_owned());
        }
        if record.iter().next_back() != Some(&digest(record.iter().take(record.len() - 1))) {
            return Err(damaged(line, "the row was changed after it was saved"));
        }
        let point: usize = field(1).parse().map_err(|_| damaged(line, format!("point = {}", field(1))))?;
        if !points.contains(&point) || std::mem::replace(&mut there[point - points.start], true) {
            return Err(damaged(line, format!("point {point} is not expected here")));
        }
        let column = FIRST.len() + sweep.axes().len();
        let status = match field(column) {
            "converged" => RunStatus::Converged,
            "not converged" => RunStatus::NotConverged,
            "not resolved" => RunStatus::NotResolved,
            other => match other.strip_prefix("failed: ") {
                Some(reason) => RunStatus::Failed(reason.to_owned()),
                None => return Err(damaged(line, format!("status = {other}"))),
            },
        };
        let stopped_by = match field(column + 1) {
            "" => None,
            name => {
                let known = StoppedBy::ALL.into_iter().find(|known| known.name() == name);
                Some(known.ok_or_else(|| damaged(line, format!("{STOPPED_BY} = {name}")))?)
            }
        };
        let mut outside = Vec::new();
        for name in field(column + 2).split(BETWEEN).filter(|name| !name.is_empty()) {
            let known = NAMES.into_iter().find(|known| *known == name);
            outside.push(known.ok_or_else(|| damaged(line, format!("{VALIDITY} = {name}")))?);
        }
        let mut numbers = Numbers::default();
        for (i, quantity) in quantities.iter().enumerate() {
            let text = field(column + 3 + i);
            if !text.is_empty() {
                let value =
                    text.parse().map_err(|_| damaged(line, format!("{} = {text}", Quantity::name(*quantity))))?;
                numbers.set(*quantity, value);
            }
        }
        rows.push(SweepRow { point, values: sweep.values(point), status, stopped_by, numbers, outside });
    }
    Ok(rows)
}

/// A sweep whose parts were solved one by one.
#[derive(Clone, Debug)]
pub struct Joined {
    /// The sweep.
    pub sweep: Sweep,
    /// A row for each of its points, in order.
    pub rows: Vec<SweepRow>,
    /// The command line that solves it at once; empty if there is none.
    pub command: Vec<String>,
}

/// Greatest number of missing parts that are named.
const NAMED: usize = 8;

/// The whole sweep from all its parts, each with a name for messages, in any order.
///
/// # Errors
/// Which text is not part of the first one's sweep, was given before or is not complete; which parts are missing; or that there are more
/// points than a sweep can have.
pub fn join(parts: &[(String, String)]) -> Result<Joined, String> {
    fn fault(name: &str, fault: impl Display) -> String {
        format!("{name}: {fault}")
    }
    let Some((first, text)) = parts.first() else { return Err("parts are missing: all".to_owned()) };
    let begun = head(text).map_err(|error| fault(first, error))?;
    let part_of =
        |name: &str, head: &Head| head.part.parse::<SweepPart>().map_err(|error| fault(name, damaged(1, error)));
    let part = part_of(first, &begun)?;
    let of = part.of();
    let sweep = begun.sweep(part).map_err(|error| fault(first, error))?;
    if sweep.len() > MOST_POINTS {
        return Err(format!(
            "{} points: joined are up to {MOST_POINTS}; of more, the file of each part is a table by itself, below its first line",
            sweep.len()
        ));
    }
    let fingerprint = sweep.fingerprint();
    let mut found: Vec<Option<Vec<SweepRow>>> = vec![None; of];
    for (name, text) in parts {
        let head = head(text).map_err(|error| fault(name, error))?;
        if head.sweep != fingerprint {
            return Err(fault(name, ANOTHER));
        }
        let part = part_of(name, &head)?;
        if part.of() != of {
            return Err(fault(name, format!("it is part {part}, and the parts before it are of {of}")));
        }
        let points = sweep.points_of(part);
        let mut rows = rows(&sweep, &fingerprint, points.clone(), text).map_err(|error| fault(name, error))?;
        if rows.len() < points.len() {
            let solved = format!("{} of the {} points of part {part} are solved", rows.len(), points.len());
            return Err(fault(name, format!("{solved}; to continue, repeat the command that began it")));
        }
        rows.sort_by_key(|row| row.point);
        if found[part.number() - 1].replace(rows).is_some() {
            return Err(fault(name, format!("part {part} was given before")));
        }
    }
    let missing: Vec<SweepPart> =
        SweepPart::all(of).zip(&found).filter(|(_, rows)| rows.is_none()).map(|(part, _)| part).collect();
    if !missing.is_empty() {
        let mut parts: Vec<String> = missing.iter().take(NAMED).map(ToString::to_string).collect();
        if missing.len() > NAMED {
            parts.push(format!("{} more", missing.len() - NAMED));
        }
        return Err(format!("parts are missing: {}", parts.join(", ")));
    }
    Ok(Joined { sweep, rows: found.into_iter().flatten().flatten().collect(), command: begun.command })
}

impl Head {
    /// The sweep that the header describes, of which this part is small enough.
    fn sweep(&self, part: SweepPart) -> Result<Sweep, AnalysisError> {
        let scene = Scene::from_toml(&self.scene_toml, "the scene of the part")?;
        let vary = self.vary.iter().map(|text| text.parse()).collect::<Result<Vec<Vary>, _>>()?;
        let mut sweep = Sweep::of_part(&scene, &vary, &self.settings, part)?;
        sweep.budget = self.budget;
        Ok(sweep)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::sweep::tests::{rows, sweep};

    fn saved(sweep: &Sweep, part: SweepPart, rows: &[SweepRow]) -> String {
        let mut text = Vec::new();
        write(sweep, part, rows, &["squeezefilm".to_owned()], &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn rows_read_back_to_the_same_bits() {
        let sweep = sweep("stator.frequency_khz=3:100:3:log");
        let text = saved(&sweep, SweepPart::WHOLE, &rows(&sweep));
        assert_eq!(read(&sweep, SweepPart::WHOLE, &text).unwrap(), rows(&sweep));
        let second = text.lines().nth(1).unwrap();
        assert!(
            second.starts_with(
                "sweep,point,stator.frequency_khz,status,stopped_by,validity,alpha,alpha_error,film_load_n,"
            ),
            "{text}"
        );
    }

    #[test]
    fn rows_of_another_sweep_and_damage_are_told() {
        let ours = sweep("stator.frequency_khz=3:100:3");
        let text = saved(&ours, SweepPart::WHOLE, &rows(&ours));
        let read = |sweep: &Sweep, text: &str| super::read(sweep, SweepPart::WHOLE, text);
        assert_eq!(read(&sweep("stator.frequency_khz=3:100:4"), &text), Err(ANOTHER.to_owned()));
        assert_eq!(read(&sweep("film.min_spacing_nm=50:100:3"), &text), Err(ANOTHER.to_owned()));
        assert_eq!(read(&ours, ""), Err(NO_PART.to_owned()));
        let other = SweepPart::all(2).last().unwrap();
        assert_eq!(super::read(&ours, other, &text), Err("it is part 1/1 of the sweep, not 2/2".to_owned()));
        let cut = &text[..text.len() - 20];
        assert!(read(&ours, cut).unwrap_err().starts_with("line 6: "), "{:?}", read(&ours, cut));
        let third = text.lines().nth(2).unwrap();
        let twice = read(&ours, &format!("{text}{third}\n")).unwrap_err();
        assert!(twice.ends_with("point 0 is not expected here"), "{twice}");
        // A row that was changed by hand is not a result.
        for (from, to) in [
            ("0.30000000000000004", "0.31"),
            ("0.30000000000000004", "nan"),
            ("converged", "failed: no"),
            (",1,", ",0,"),
        ] {
            let fault = read(&ours, &text.replacen(from, to, 1)).unwrap_err();
            assert!(fault.contains("the row was changed after it was saved"), "{from}: {fault}");
        }
    }

    #[test]
    fn all_parts_are_the_whole_and_what_is_no_whole_is_told() {
        // A range, a logarithmic range and words.
        for vary in [
            "stator.frequency_khz=3:100:3",
            "stator.frequency_khz=3.3:100:3:log",
            "film.slip=none,first-order,fukui-kaneko",
        ] {
            let ours = sweep(vary);
            let mut all = rows(&ours);
            all.sort_by_key(|row| row.point);
            let mut parts: Vec<(String, String)> = SweepPart::all(4)
                .map(|part| {
                    let rows: Vec<SweepRow> =
                        all.iter().filter(|row| ours.points_of(part).contains(&row.point)).cloned().collect();
                    (format!("{part}.csv"), saved(&ours, part, &rows))
                })
                .collect();
            parts.reverse();
            let joined = join(&parts).unwrap();
            assert_eq!((joined.rows, joined.command), (all, vec!["squeezefilm".to_owned()]));
            assert_eq!(joined.sweep.fingerprint(), ours.fingerprint());
            let told = |parts: &[(String, String)]| join(parts).unwrap_err();
            assert_eq!(told(&parts[..2]), "parts are missing: 1/4, 2/4");
            assert_eq!(told(&[&parts[..], &parts[1..2]].concat()), "3/4.csv: part 3/4 was given before");
            let none = ("x.csv".to_owned(), saved(&ours, SweepPart::all(4).last().unwrap(), &[]));
            let told_none =
                "x.csv: 0 of the 3 points of part 4/4 are solved; to continue, repeat the command that began it";
            assert_eq!(told(std::slice::from_ref(&none)), told_none);
            let third = ("y.csv".to_owned(), saved(&ours, SweepPart::all(3).next().unwrap(), &[]));
            assert_eq!(told(&[parts[3].clone(), third]), "y.csv: it is part 1/3, and the parts before it are of 4");
            let other = sweep("film.min_spacing_nm=100:200:3");
            let other = ("z.csv".to_owned(), saved(&other, SweepPart::WHOLE, &[]));
            assert!(told(&[parts[3].clone(), other]).starts_with("z.csv: it is of another sweep"));
        }
        assert_eq!(join(&[]).unwrap_err(), "parts are missing: all");
        for text in ["", "b", "# dx_um = 1\n", "sweep,point\n"] {
            let told = join(&[("a".to_owned(), text.to_owned())]).unwrap_err();
            assert!(told.starts_with("a: it is no part of a sweep"), "{text:?}: {told}");
        }
    }
}
