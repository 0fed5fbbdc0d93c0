//! Reads `lesson.md` into a [`Lesson`]: headings, text, and blocks of TOML in fences. All faults of a file are reported together.

mod step;
mod table;

use super::error::LessonError;
use super::lesson::{Lesson, WindowNames};
use std::path::Path;
use step::{BLOCKS, Raw};
pub(super) use table::Beside;
use table::{LessonReader, Piece};

/// Reads a lesson.
///
/// # Errors
/// All faults, with their lines.
pub(super) fn lesson(
    id: &str,
    source: &str,
    origin: &Path,
    names: WindowNames<'_>,
    beside: Beside<'_>,
) -> Result<Lesson, Vec<LessonError>> {
    let mut reader = LessonReader { origin, names, beside, faults: Vec::new(), scene: None };
    let lesson = reader.lesson(id, source);
    reader.faults.sort_by_key(|fault| fault.line);
    if reader.faults.is_empty() { Ok(lesson) } else { Err(reader.faults) }
}

impl LessonReader<'_> {
    /// The lesson, without the steps that have no scene; for each of them there is a fault.
    fn lesson(&mut self, id: &str, source: &str) -> Lesson {
        let mut title = String::new();
        let mut about = Vec::new();
        let mut steps: Vec<Raw> = Vec::new();
        let mut lines = source.lines().enumerate().map(|(i, line)| (i + 1, line));
        while let Some((number, line)) = lines.next() {
            if let Some(heading) = line.strip_prefix("## ").or_else(|| (line.trim() == "##").then_some("")) {
                if heading.trim().is_empty() {
                    self.fault(number, "the heading is empty");
                }
                let title = heading.trim().to_owned();
                steps.push(Raw { line: number, title, body: Vec::new(), blocks: Vec::new() });
            } else if let Some(heading) = line.strip_prefix("# ") {
                title = heading.trim().to_owned();
            } else if let Some(kind) = line.trim_end().strip_prefix("```") {
                let mut piece = Piece { line: number + 1, text: String::new() };
                let mut closed = false;
                for (_, inside) in lines.by_ref() {
                    if inside.trim_end() == "```" {
                        closed = true;
                        break;
                    }
                    piece.text.push_str(inside);
                    piece.text.push('\n');
                }
                if !closed {
                    let kind = kind.trim();
                    self.fault(number, format!("the block ```{kind} is never closed: expected a line ``` below it"));
                    continue;
                }
                let Some(kind) = BLOCKS.into_iter().find(|known| *known == kind.trim()) else {
                    let expected = "expected setup, question, task or observe";
                    self.fault(number, format!("a block ```{} is not known: {expected}", kind.trim()));
                    continue;
                };
                match steps.last_mut() {
                    None => self.fault(number, format!("a block ```{kind} comes before the first step")),
                    Some(step) if step.blocks.iter().any(|(other, _)| *other == kind) => {
                        self.fault(number, format!("this step has two blocks ```{kind}: keep one"));
                    }
                    Some(step) => step.blocks.push((kind, piece)),
                }
            } else {
                let body = steps.last_mut().map_or(&mut about, |step| &mut step.body);
                match body.last_mut() {
                    // Consecutive lines are one piece; a block between them begins a new one.
                    Some(piece) if piece.line + piece.text.lines().count() == number => {
                        piece.text.push_str(line);
                        piece.text.push('\n');
                    }
                    _ => body.push(Piece { line: number, text: format!("{line}\n") }),
                }
            }
        }
        if title.is_empty() {
            self.fault(1, "has no title: expected a line `# Title` before everything else");
        }
        if steps.is_empty() {
            self.fault(1, "has no steps: expected `## Step` below the title, once for each");
        }
        let about = self.text(&about);
        let steps = steps.iter().filter_map(|step| self.step(step)).collect();
        Lesson { id: id.to_owned(), title, about, steps }
    }
}
