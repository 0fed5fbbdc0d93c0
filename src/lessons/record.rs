//! The record of a student's answers as a file, CSV or JSON lines with the verbs of xAPI, and a summary of the records of a class.

use super::lesson::{Lesson, Prediction, QuestionKind};
use super::work::{Stage, StepWork};
use crate::export::html::{CellKind as Cell, Page, Table};
use crate::input::{csv_fault, read_text};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::collections::BTreeMap;
use std::path::Path;

/// Largest record read \[MB\].
const LARGEST: u64 = 4;
/// Columns without which a table is no record.
const COLUMNS: [&str; 8] = ["lesson", "step", "title", "kind", "verb", "response", "success", "tries"];
/// Most wrong answers of a question that a summary names.
const NAMED: usize = 2;

/// An answer, a task or a step that a student did: a row of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The name of the lesson's folder.
    pub lesson: String,
    /// The step, from 1.
    pub step: usize,
    /// Its title.
    pub title: String,
    /// `prediction`, `calculation`, `observation`, `task` or `step`.
    pub kind: String,
    /// `answered`, `completed` or `skipped`.
    pub verb: String,
    /// The answer, in words.
    pub response: String,
    /// Whether the answer was right; of a task, whether the student did it without being shown how. `None` of a step.
    pub success: Option<bool>,
    /// Number of tries.
    pub tries: usize,
    /// When it was done, ISO 8601 in UTC; empty if that is not known.
    #[serde(default)]
    pub time: String,
}

/// The verbs, with their identifiers in the xAPI registry.
const VERBS: &[(&str, &str)] = &[
    ("answered", "http://adlnet.gov/expapi/verbs/answered"),
    ("completed", "http://adlnet.gov/expapi/verbs/completed"),
    ("skipped", "http://id.tincanapi.com/verb/skipped"),
];

/// The record of a student's work in a lesson.
pub fn of(lesson: &Lesson, work: &[StepWork]) -> Vec<Record> {
    let mut records = Vec::new();
    for (i, (step, work)) in lesson.steps.iter().zip(work).enumerate() {
        let times = work.times;
        let mut add = |kind: &str, verb: &str, response: String, success: Option<bool>, tries: usize, time| {
            let (lesson, title) = (lesson.id.clone(), step.title.clone());
            let (kind, verb) = (kind.to_owned(), verb.to_owned());
            let time = Option::map_or_else(time, String::new, iso_8601);
            records.push(Record { lesson, step: i + 1, title, kind, verb, response, success, tries, time });
        };
        if let (Some(question), Some(given), true) = (&step.question, work.prediction, work.committed) {
            let right = question.answer.is_right(given);
            let kind = if question.kind == QuestionKind::Calculate { "calculation" } else { "prediction" };
            let response = question.answer.words(given);
            add(kind, "answered", response, Some(right), work.wrong + usize::from(right), times.question);
        }
        if let (Some(_), true) = (&step.task, work.fulfilled) {
            let response = format!("{} hints", work.hints);
            add("task", "completed", response, Some(!work.shown), 1, times.task);
        }
        if let (Some(observe), Some(choice)) = (&step.observe, work.observed) {
            let right = work.misread == 0;
            let response = observe.answer.words(Prediction::Choice(choice));
            add("observation", "answered", response, Some(right), work.misread + 1, times.observation);
        }
        if work.left {
            let verb = if work.stage(step) == Stage::Told { "completed" } else { "skipped" };
            add("step", verb, String::new(), None, 1, times.step);
        }
    }
    records
}

/// The date and time in UTC, `seconds` after the beginning of 1970. The Gregorian calendar repeats every 400 years. Years are counted from
/// March here, so that a leap day is the last day of its year (H. Hinnant, "chrono-compatible low-level date algorithms", 2014).
fn iso_8601(seconds: u64) -> String {
    let (days, of_day) = (seconds / 86_400 + 719_468, seconds % 86_400);
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let of_year = day - (365 * year + year / 4 - year / 100);
    let since_march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * since_march + 2) / 5 + 1;
    let (month, next) = if since_march < 10 { (since_march + 3, 0) } else { (since_march - 9, 1) };
    let (hour, minute, second) = (of_day / 3600, of_day / 60 % 60, of_day % 60);
    format!("{:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z", 400 * era + year + next)
}

/// The records of `student` as statements of xAPI, one on each line.
pub fn statements(student: &str, records: &[Record]) -> String {
    let line = |record: &Record| {
        let id = VERBS.iter().find(|(verb, _)| *verb == record.verb).map_or("", |(_, id)| *id);
        let activity = format!("urn:squeezefilm:lesson:{}:step:{}:{}", record.lesson, record.step, record.kind);
        let mut result =
            json!({ "response": record.response, "extensions": { "urn:squeezefilm:tries": record.tries } });
        if let Some(success) = record.success {
            result["success"] = json!(success);
        }
        let mut statement = json!({
            "actor": { "objectType": "Agent", "account": { "homePage": "urn:squeezefilm", "name": student } },
            "verb": { "id": id, "display": { "en": record.verb } },
            "object": { "id": activity, "definition": { "name": { "en": record.title } } },
            "result": result,
        });
        if !record.time.is_empty() {
            statement["timestamp"] = json!(record.time);
        }
        format!("{statement}\n")
    };
    records.iter().map(line).collect()
}

/// Reads a record as CSV.
///
/// # Errors
/// The path and why it cannot be read, with the line.
pub fn read(path: &Path) -> Result<Vec<Record>, String> {
    let fault = |why: String| format!("{}: {why}", path.display());
    // The reader miscounts lines that end in CRLF.
    let text = read_text(path, LARGEST).map_err(|error| fault(error.to_string()))?.replace("\r\n", "\n");
    let no_record = |why: String| fault(format!("is not a record of answers as the window saves it (CSV): {why}"));
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let head = reader.headers().map_err(|error| no_record(csv_fault(&error)))?.clone();
    if let Some(missing) = COLUMNS.into_iter().find(|name| !head.iter().any(|column| column == *name)) {
        return Err(no_record(format!("it has no column {missing}")));
    }
    let rows: Result<Vec<Record>, csv::Error> = reader.deserialize().collect();
    rows.map_err(|error| {
        let line = error.position().map_or_else(String::new, |at| format!("line {}: ", at.line()));
        let why = match error.kind() {
            csv::ErrorKind::Deserialize { err, .. } => {
                let column = err.field().and_then(|field| head.get(usize::try_from(field).ok()?)).unwrap_or("?");
                format!("column {column} holds something else")
            }
            _ => csv_fault(&error),
        };
        no_record(format!("{line}{why}"))
    })
}

/// A web page with the summary of the records of a class.
pub fn summary(class: &[Vec<Record>]) -> String {
    let lead = format!("{} records. Discuss in class what few got right or many skipped.", class.len());
    let mut page = Page::new("squeezefilm, lessons", "What the class answered", &lead);
    let mut lessons: BTreeMap<&str, BTreeMap<(usize, &str), Vec<&Record>>> = BTreeMap::new();
    for record in class.iter().flatten() {
        lessons.entry(&record.lesson).or_default().entry((record.step, &record.kind)).or_default().push(record);
    }
    for (lesson, rows) in lessons {
        page.section(lesson);
        let heads = ["Step", "", "Answers", "Right", "Skipped", "Most frequent wrong answers"];
        let mut table = Table::default().heads(heads.map(|head| (Cell::Words, head)));
        for ((step, kind), records) in rows {
            let count = |holds: &dyn Fn(&Record) -> bool| records.iter().filter(|record| holds(record)).count();
            let judged = count(&|record| record.success.is_some());
            let right = count(&|record| record.success == Some(true));
            let share = (100 * right).checked_div(judged).map(|share| format!("{share} %")).unwrap_or_default();
            let skipped = match kind {
                "step" => count(&|record| record.verb == "skipped").to_string(),
                _ => String::new(),
            };
            let title = records.first().map_or("", |record| record.title.as_str());
            let cells = [
                (Cell::Words, format!("{step}  {title}")),
                (Cell::Quiet, kind.to_owned()),
                (Cell::Number, records.len().to_string()),
                (Cell::Number, share),
                (Cell::Number, skipped),
                (Cell::Words, wrong(&records)),
            ];
            table.row(cells);
        }
        page.table(&table);
    }
    page.finish("Written by squeezefilm lessons summary")
}

/// The wrong answers that were given most often, in words.
fn wrong(records: &[&Record]) -> String {
    let mut counted: BTreeMap<&str, usize> = BTreeMap::new();
    let wrong = records.iter().filter(|record| record.success == Some(false) && !record.response.is_empty());
    wrong.for_each(|record| *counted.entry(&record.response).or_default() += 1);
    let mut counted: Vec<(&str, usize)> = counted.into_iter().collect();
    counted.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let named = counted.into_iter().take(NAMED).map(|(response, count)| format!("{response} ({count})"));
    named.collect::<Vec<_>>().join("; ")
}

/// The student of a record: the name of its file, without the extension.
pub fn student(path: &Path) -> String {
    path.file_stem().map_or_else(|| "student".to_owned(), |name| name.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lessons::{WindowNames, built_in};

    fn lesson() -> Lesson {
        const TABS: &[&str] = &["Motion", "Hold", "Exact", "Start-up", "Torque"];
        const PLACES: &[&str] =
            &["held plate", "gap", "pressure", "loop", "loads", "start", "wave", "least gap", "map"];
        let (lessons, _) = built_in(WindowNames { tabs: [TABS; 2], places: PLACES });
        lessons.into_iter().find(|lesson| lesson.id == "1-trapped-air").unwrap()
    }

    fn answered(prediction: usize, skipped: bool) -> Vec<Record> {
        let lesson = lesson();
        let mut work = vec![StepWork::default(); lesson.steps.len()];
        work[0] = StepWork {
            prediction: Some(Prediction::Choice(prediction)),
            committed: true,
            fulfilled: !skipped,
            shown: true,
            hints: 2,
            left: true,
            ..StepWork::default()
        };
        if !skipped {
            work[0].observed = Some(1);
        }
        work[0].note_times(1_795_383_744);
        // The first time counts.
        work[0].note_times(1_795_383_999);
        of(&lesson, &work)
    }

    #[test]
    fn what_was_done_is_told_and_read_again() {
        let mut records = answered(2, false);
        assert!(records.iter().all(|record| record.time == "2026-11-22T21:42:24Z"), "{records:?}");
        let kinds: Vec<(&str, &str, Option<bool>)> =
            records.iter().map(|record| (record.kind.as_str(), record.verb.as_str(), record.success)).collect();
        let all = [
            ("prediction", "answered", Some(true)),
            ("task", "completed", Some(false)),
            ("observation", "answered", Some(true)),
            ("step", "completed", None),
        ];
        assert_eq!(kinds, all);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("anna.csv");
        let mut file = std::fs::File::create(&path).unwrap();
        crate::export::csv::rows(&records, &mut file).unwrap();
        assert_eq!((read(&path).unwrap(), student(&path).as_str()), (records.clone(), "anna"));
        let statements = statements("anna", &records);
        for (line, record) in statements.lines().zip(&records) {
            let statement: serde_json::Value = serde_json::from_str(line).unwrap();
            let verb = statement["verb"]["id"].as_str().unwrap();
            assert!(verb.starts_with("http") && verb.ends_with(&record.verb));
            assert_eq!(statement["result"]["success"].as_bool(), record.success);
            assert_eq!(statement["timestamp"], record.time);
        }
        // A record of before times were noted.
        let table = std::fs::read_to_string(&path).unwrap().replace(",time", "").replace(",2026-11-22T21:42:24Z", "");
        std::fs::write(&path, table).unwrap();
        records.iter_mut().for_each(|record| record.time.clear());
        assert_eq!(read(&path).unwrap(), records);
        assert!(!super::statements("anna", &records).contains("timestamp"));
        let head = COLUMNS.join(",");
        for (table, told) in [
            ("lesson,step\n1,x\n".to_owned(), "as the window saves it (CSV): it has no column title"),
            (format!("{head}\r\na,1,,,,,,1\r\na,x,,,,,,1\r\n"), "(CSV): line 3: column step holds something else"),
            (format!("{head}\na,1\n"), "(CSV): line 2: 2 cells: expected 8, one for each column"),
        ] {
            std::fs::write(&path, table).unwrap();
            let error = read(&path).unwrap_err();
            assert!(error.ends_with(told), "{error}");
        }
    }

    #[test]
    fn dates_are_those_of_the_calendar() {
        let dates = [
            (0, "1970-01-01T00:00:00Z"),
            (951_868_799, "2000-02-29T23:59:59Z"),
            (951_868_800, "2000-03-01T00:00:00Z"),
            (1_798_761_599, "2026-12-31T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ];
        dates.iter().for_each(|(seconds, date)| assert_eq!(iso_8601(*seconds), *date));
    }

    #[test]
    fn a_class_is_counted() {
        let page = summary(&[answered(2, false), answered(0, true), answered(0, true)]);
        assert!(page.contains("3 records"));
        assert!(page.contains("33 %") && page.contains("It moves aside, like water: its pressure hardly changes (2)"));
        assert!(page.contains("1  Push on it"));
    }
}
