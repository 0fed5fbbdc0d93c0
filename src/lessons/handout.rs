//! Lessons on paper: for each lesson a worksheet with space for predictions and axes for sketches, and a sheet with the answers.

use super::check::Reading;
use super::lesson::{Answer, Lesson, Question, QuestionKind, Step};
use super::text::{Block, Inline, filled, plain};
use super::trial::{Quoted, quoted};
use crate::control::Cancel;
use crate::export::figure::{Axis, Figure, Panel, Piece};
use crate::export::html::Page;
use std::collections::BTreeMap;

/// Blank lines for a reason.
const REASON: usize = 1;
/// Blank lines for a calculation.
const CALCULATION: usize = 3;
/// Height of axes on a web page \[mm\].
const AXES: f64 = 38.0;

/// The axes for a sketch, by the part of the window that a step highlights: names of the horizontal and of the vertical axis.
const SKETCHES: &[(&str, [&str; 2])] = &[
    ("loop", ["gap", "mean pressure"]),
    ("loads", ["time, one cycle", "force of the film"]),
    ("pressure", ["place", "pressure"]),
    ("history", ["cycles", "mean force"]),
    ("start", ["cycles", "mean force"]),
    ("torque", ["speed", "torque"]),
];

/// The worksheet of a lesson, or the sheet with the answers. The numbers that its texts quote are computed.
///
/// # Errors
/// Why a scene of the lesson was not solved.
pub fn sheet(lesson: &Lesson, answers: bool, cancel: &Cancel) -> Result<Vec<Piece>, String> {
    let kind = if answers { "Answers" } else { "Name ________________  Date _________" };
    let mut pieces = vec![Piece::Title(lesson.title.clone()), Piece::Text(kind.to_owned())];
    for (i, step) in lesson.steps.iter().enumerate() {
        let known = quoted(step, cancel).map_err(|error| format!("{}, {}: {error}", lesson.title, step.title))?;
        // Only the worksheet has the text of a step, so the sheet with answers leaves out a step that has no question and no task.
        if !answers || step.question.is_some() || step.task.is_some() {
            pieces.push(Piece::Heading(format!("{}  {}", i + 1, step.title)));
            let body = if answers { &[] } else { &step.body[..] };
            pieces.extend(lines(body, &known.before).map(Piece::Text));
            on_paper(&mut pieces, step, &known, answers);
        }
    }
    Ok(pieces)
}

fn on_paper(pieces: &mut Vec<Piece>, step: &Step, known: &Quoted, answers: bool) {
    if let Some(question) = &step.question {
        pieces.extend(lines(&question.ask, &known.before).map(Piece::Text));
        choices(pieces, question, answers);
        match (&question.answer, answers) {
            (Answer::Number { value, unit, .. }, true) => pieces.push(Piece::Answer(format!("{value} {unit}"))),
            (_, true) => {}
            (Answer::Number { .. }, false) => pieces.push(Piece::Room(CALCULATION)),
            (Answer::Choice { .. }, false) => {
                pieces.push(Piece::Text("Because".to_owned()));
                pieces.push(Piece::Room(REASON));
            }
        }
    }
    if let Some(task) = &step.task {
        pieces.extend(lines(&task.ask, &known.before).map(Piece::Text));
        let sketch = step.highlight_parts.iter().find_map(|place| SKETCHES.iter().find(|(known, _)| known == place));
        if let (Some((_, axes)), false) = (sketch, answers) {
            let kind = step.question.as_ref().map_or(QuestionKind::Predict, |question| question.kind);
            let before = if kind == QuestionKind::Predict { "dashed what you expect, " } else { "" };
            pieces.push(Piece::Text(format!("Sketch: {before}solid what you saw.")));
            pieces.push(Piece::Axes(axes.map(str::to_owned)));
        }
        if let Some(observe) = step.observe.as_ref().filter(|observe| !observe.ask.is_empty()) {
            pieces.extend(lines(&observe.ask, &known.after).map(Piece::Text));
            choices(pieces, observe, answers);
        }
    }
    if answers {
        let why = step.question.iter().flat_map(|question| &question.why);
        let explanation = why.chain(step.task.iter().flat_map(|task| &task.then));
        pieces.extend(lines(explanation, &known.after).map(Piece::Answer));
    }
}

fn choices(pieces: &mut Vec<Piece>, question: &Question, answers: bool) {
    if let Answer::Choice { choices, right } = &question.answer {
        let boxes = choices.iter().enumerate();
        pieces.extend(boxes.map(|(i, choice)| Piece::Choice(plain(&choice.text), answers && i == *right)));
    }
}

/// Blocks as lines of text. `known` has the numbers that they quote.
fn lines<'a>(
    blocks: impl IntoIterator<Item = &'a Block>,
    known: &BTreeMap<String, f64>,
) -> impl Iterator<Item = String> {
    blocks.into_iter().map(move |block| match block {
        Block::Paragraph(parts) => with_numbers(parts, known),
        Block::Item(parts) => format!("•  {}", with_numbers(parts, known)),
        Block::Formula(formula) => formula.plain(),
        Block::Picture(picture) => format!("({})", picture.alternative),
    })
}

fn with_numbers(parts: &[Inline], known: &BTreeMap<String, f64>) -> String {
    let value =
        |reading: &Reading| known.get(&reading.source).map_or_else(|| "…".to_owned(), |value| reading.text(*value));
    plain(&filled(parts, &value))
}

/// Sheets as one web page, which prints each sheet on a new page.
pub fn to_html(title: &str, sheets: &[Vec<Piece>]) -> String {
    let mut page = Page::new("squeezefilm, lessons", title, "");
    for piece in sheets.iter().flatten() {
        match piece {
            Piece::Title(text) => page.section(text),
            Piece::Heading(text) => page.heading(text),
            Piece::Text(text) => page.text(text),
            Piece::Answer(text) => page.note(text),
            Piece::Choice(text, ticked) => page.choices([(text.as_str(), *ticked)]),
            Piece::Room(lines) => page.room(*lines),
            Piece::Axes([along, up]) => {
                let [x, y] = [along, up].map(|name| Axis { names: vec![(-1.0, String::new())], ..Axis::new(name, "") });
                let panel = Panel::new("", x.fixed(0.0, 1.0), y.fixed(0.0, 1.0)).height(AXES);
                page.figures([("", &Figure::default().panel(panel))]);
            }
        }
    }
    page.finish("Printed by squeezefilm lessons print")
}
