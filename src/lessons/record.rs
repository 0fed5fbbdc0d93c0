//! A record of what a student answered, as a student saves it: CSV, or JSON lines with the verbs of xAPI; and what a class's records
//! come to.

use super::lesson::{Answer, Kind, Lesson, Prediction, Question};
use super::text::plain;
use super::work::{Stage, StepWork};
use crate::export::html::{Kind as Cell, Page, Table};
use crate::input::{ReadError, read_text};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Largest record read \[MB\].
const LARGEST: u64 = 4;
/// Wrong answers that a summary names.
const NAMED: usize = 2;

/// One thing that a student did: a row of the table.
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
    /// Whether it was right; of a task, whether it was done without being shown. Nothing where there is no right or wrong.
    pub success: Option<bool>,
    /// Tries that it took.
    pub tries: usize,
}

/// Names of verbs by the registry of xAPI.
const VERBS: &[(&str, &str)] = &[
    ("answered", "http://adlnet.gov/expapi/verbs/answered"),
    ("completed", "http://adlnet.gov/expapi/verbs/completed"),
    ("skipped", "http://id.tincanapi.com/verb/skipped"),
];

/// What a student did in a lesson.
pub fn of(lesson: &Lesson, work: &[StepWork]) -> Vec<Record> {
    let mut records = Vec::new();
    for (i, (step, work)) in lesson.steps.iter().zip(work).enumerate() {
        let mut add = |kind: &str, verb: &str, response: String, success: Option<bool>, tries: usize| {
            let (lesson, title) = (lesson.id.clone(), step.title.clone());
            let (kind, verb) = (kind.to_owned(), verb.to_owned());
            records.push(Record { lesson, step: i + 1, title, kind, verb, response, success, tries });
        };
        if let (Some(question), Some(given), true) = (&step.question, work.prediction, work.committed) {
            let right = question.answer.is_right(given);
            let kind = if question.kind == Kind::Calculate { "calculation" } else { "prediction" };
            add(kind, "answered", words(question, given), Some(right), work.wrong + usize::from(right));
        }
        if let (Some(_), true) = (&step.task, work.fulfilled) {
            let response = format!("{} hints", work.hints);
            add("task", "completed", response, Some(!work.shown), 1);
        }
        if let (Some(observe), Some(choice)) = (&step.observe, work.observed) {
            let right = work.misread == 0;
            let response = words(observe, Prediction::Choice(choice));
            add("observation", "answered", response, Some(right), work.misread + 1);
        }
        if work.left {
            let verb = if work.stage(step) == Stage::Told { "completed" } else { "skipped" };
            add("step", verb, String::new(), None, 1);
        }
    }
    records
}

fn words(question: &Question, given: Prediction) -> String {
    match (&question.answer, given) {
        (Answer::Choice { choices, .. }, Prediction::Choice(choice)) => {
            choices.get(choice).map(|choice| plain(&choice.text)).unwrap_or_default()
        }
        (Answer::Number { unit, .. }, Prediction::Number(number)) => format!("{number} {unit}").trim().to_owned(),
        _ => String::new(),
    }
}

/// Records as statements of xAPI, one on a line; `student`: whose.
pub fn statements(student: &str, records: &[Record]) -> String {
    let line = |record: &Record| {
        let id = VERBS.iter().find(|(verb, _)| *verb == record.verb).map_or("", |(_, id)| *id);
        let activity = format!("urn:squeezefilm:lesson:{}:step:{}:{}", record.lesson, record.step, record.kind);
        let mut result =
            json!({ "response": record.response, "extensions": { "urn:squeezefilm:tries": record.tries } });
        if let Some(success) = record.success {
            result["success"] = json!(success);
        }
        let statement = json!({
            "actor": { "objectType": "Agent", "account": { "homePage": "urn:squeezefilm", "name": student } },
            "verb": { "id": id, "display": { "en": record.verb } },
            "object": { "id": activity, "definition": { "name": { "en": record.title } } },
            "result": result,
        });
        format!("{statement}\n")
    };
    records.iter().map(line).collect()
}

/// A record that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The file.
    #[error("{}: {error}", path.display())]
    Unreadable {
        /// Its path.
        path: PathBuf,
        /// Why.
        error: ReadError,
    },
    /// What is in it.
    #[error("{}: is not a record of answers as the window saves it (CSV): {error}", path.display())]
    NoRecord {
        /// Its path.
        path: PathBuf,
        /// Why.
        error: csv::Error,
    },
}

/// Reads a record as CSV.
///
/// # Errors
/// [`RecordError`], with the line.
pub fn read(path: &Path) -> Result<Vec<Record>, RecordError> {
    let text = read_text(path, LARGEST).map_err(|error| RecordError::Unreadable { path: path.to_owned(), error })?;
    let rows: Result<Vec<Record>, csv::Error> = csv::Reader::from_reader(text.as_bytes()).deserialize().collect();
    rows.map_err(|error| RecordError::NoRecord { path: path.to_owned(), error })
}

/// A page on the records of a class.
pub fn summary(class: &[Vec<Record>]) -> String {
    let lead = format!("{} records. What few got right, or many skipped, is worth talking about.", class.len());
    let mut page = Page::new("squeezefilm, lessons", "What the class answered", &lead);
    let mut lessons: BTreeMap<&str, BTreeMap<(usize, &str), Vec<&Record>>> = BTreeMap::new();
    for record in class.iter().flatten() {
        lessons.entry(&record.lesson).or_default().entry((record.step, &record.kind)).or_default().push(record);
    }
    for (lesson, rows) in lessons {
        page.section(lesson);
        let heads = ["Step", "", "Answers", "Right", "Skipped", "Most frequent wrong answers"];
        let mut table = Table::new("").heads(heads.map(|head| (Cell::Words, head)));
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

/// The name of a student's file, without its extension: who it is from.
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
            work[0].observed = Some(2);
        }
        of(&lesson, &work)
    }

    #[test]
    fn what_was_done_is_told_and_read_again() {
        let records = answered(2, false);
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
        }
        std::fs::write(&path, "lesson,step\n1,x\n").unwrap();
        assert!(read(&path).unwrap_err().to_string().contains("is not a record of answers"));
    }

    #[test]
    fn a_class_is_counted() {
        let page = summary(&[answered(2, false), answered(0, true), answered(0, true)]);
        assert!(page.contains("3 records"));
        assert!(page.contains("33 %") && page.contains("It moves aside, like water: its pressure hardly changes (2)"));
        assert!(page.contains("1  Push on it"));
    }
}
