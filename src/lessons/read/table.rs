//! What the reader of a lesson goes by: where it is, what it may name, the faults found so far; and how it reads the TOML of a block.

use crate::lessons::check::Reading;
use crate::lessons::error::{KeyFault, LessonError, LessonErrorKind};
use crate::lessons::lesson::WindowNames;
use crate::lessons::text::{self, Block, Inline, Outside, Pictures, TextError};
use crate::scene::{Scene, SceneError};
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// What is beside the lesson.
#[derive(Clone, Copy)]
pub(in crate::lessons) struct Beside<'a> {
    /// Looks for a preset.
    pub(in crate::lessons) preset: &'a dyn Fn(&str) -> Option<Result<Scene, SceneError>>,
    /// Looks for a picture.
    pub(in crate::lessons) pictures: Pictures<'a>,
}

/// A part of the file with the line it begins at, from 1.
pub(super) struct Piece {
    pub(super) line: usize,
    pub(super) text: String,
}

/// A reader of one lesson.
pub(super) struct Reader<'a> {
    pub(super) origin: &'a Path,
    pub(super) names: WindowNames<'a>,
    pub(super) beside: Beside<'a>,
    pub(super) faults: Vec<LessonError>,
    /// The scene of a student who has come this far.
    pub(super) scene: Option<Scene>,
}

impl Reader<'_> {
    pub(super) fn fault(&mut self, line: usize, kind: LessonErrorKind) {
        self.faults.push(LessonError { origin: self.origin.to_owned(), line: Some(line), kind });
    }

    pub(super) fn key_fault(&mut self, line: usize, block: &'static str, key: &str, fault: KeyFault) {
        self.fault(line, LessonErrorKind::Key { block, key: key.to_owned(), fault });
    }

    /// Reads the TOML of a block and its keys.
    pub(super) fn table(
        &mut self,
        block: &'static str,
        keys: &'static [&'static str],
        piece: &Piece,
        read: impl FnOnce(&mut Self, &Table<'_>),
    ) {
        match DeTable::parse(&piece.text) {
            Ok(tree) => {
                let table = Table { block, tree: tree.get_ref(), piece };
                for key in tree.get_ref().keys() {
                    let name = key.get_ref().as_ref();
                    if !keys.contains(&name) {
                        self.key_fault(table.line(key.span().start), block, name, KeyFault::Unknown(keys.join(", ")));
                    }
                }
                read(self, &table);
            }
            Err(error) => {
                let line = piece.line + error.span().map_or(0, |span| newlines(&piece.text, span.start));
                let message = error.message().lines().next().unwrap_or_default().to_owned();
                self.fault(line, LessonErrorKind::Syntax(message));
            }
        }
    }

    /// The text of a step, or of what comes before the steps.
    pub(super) fn text(&mut self, pieces: &[Piece]) -> Vec<Block> {
        let mut blocks = Vec::new();
        for piece in pieces {
            match self.formatted(&piece.text) {
                Ok(read) => blocks.extend(read),
                Err((line, error)) => self.fault(piece.line + line, error.into()),
            }
        }
        blocks
    }

    /// Text that may quote numbers of a run of the present scene; a fault comes with its line, from 0.
    fn formatted(&self, text: &str) -> Result<Vec<Block>, (usize, TextError)> {
        match &self.scene {
            Some(scene) => {
                let numbers = |number: &str| Reading::parse(number, scene);
                text::blocks(text, Some(Outside { numbers: &numbers, pictures: self.beside.pictures }))
            }
            None => text::blocks(text, None),
        }
    }

    /// A list of texts as lines; `None` if one cannot be read.
    pub(super) fn lines(&mut self, table: &Table<'_>, key: &'static str) -> Option<Vec<Vec<Inline>>> {
        let mut lines = Vec::new();
        for (text, line) in self.strings(table, key) {
            match text::inline(&text, None) {
                Ok(inline) => lines.push(Some(inline)),
                Err(error) => {
                    self.key_fault(line, table.block, key, KeyFault::Text(error));
                    lines.push(None);
                }
            }
        }
        lines.into_iter().collect()
    }

    /// A list of texts.
    pub(super) fn texts(&mut self, table: &Table<'_>, key: &'static str) -> Vec<Vec<Block>> {
        let mut texts = Vec::new();
        for (text, line) in self.strings(table, key) {
            match self.formatted(&text) {
                Ok(blocks) => texts.push(blocks),
                Err((_, error)) => self.key_fault(line, table.block, key, KeyFault::Text(error)),
            }
        }
        texts
    }

    pub(super) fn blocks(&mut self, table: &Table<'_>, key: &'static str, needed: Option<&'static str>) -> Vec<Block> {
        let Some((text, line)) = self.string(table, key) else {
            if let (Some(why), None) = (needed, table.get(key)) {
                self.key_fault(table.first_line(), table.block, key, KeyFault::Missing(why));
            }
            return Vec::new();
        };
        match self.formatted(&text) {
            Ok(blocks) => blocks,
            Err((_, error)) => {
                self.key_fault(line, table.block, key, KeyFault::Text(error));
                Vec::new()
            }
        }
    }

    pub(super) fn string(&mut self, table: &Table<'_>, key: &'static str) -> Option<(String, usize)> {
        let value = table.get(key)?;
        let line = table.line(value.span().start);
        match value.get_ref() {
            DeValue::String(text) => Some((text.to_string(), line)),
            _ => {
                self.wrong_type(table, key, value, "text in quotes");
                None
            }
        }
    }

    pub(super) fn number(&mut self, table: &Table<'_>, key: &'static str) -> Option<(f64, usize)> {
        let value = table.get(key)?;
        let line = table.line(value.span().start);
        let number = match value.get_ref() {
            DeValue::Integer(_) | DeValue::Float(_) => table.piece.text[value.span()].replace('_', "").parse::<f64>(),
            _ => {
                self.wrong_type(table, key, value, "a number");
                return None;
            }
        };
        match number {
            Ok(number) if number.is_finite() => Some((number, line)),
            _ => {
                self.wrong_type(table, key, value, "a finite decimal number");
                None
            }
        }
    }

    /// A list of texts with their lines.
    pub(super) fn strings(&mut self, table: &Table<'_>, key: &'static str) -> Vec<(String, usize)> {
        let Some(value) = table.get(key) else { return Vec::new() };
        let DeValue::Array(items) = value.get_ref() else {
            self.wrong_type(table, key, value, "a list of texts in quotes");
            return Vec::new();
        };
        let mut strings = Vec::new();
        for item in items {
            match item.get_ref() {
                DeValue::String(text) => strings.push((text.to_string(), table.line(item.span().start))),
                _ => self.wrong_type(table, key, item, "a list of texts in quotes"),
            }
        }
        strings
    }

    pub(super) fn wrong_type(
        &mut self,
        table: &Table<'_>,
        key: &'static str,
        value: &Spanned<DeValue<'_>>,
        expected: &'static str,
    ) {
        const LONGEST: usize = 60;
        let found: String = table.piece.text[value.span()].chars().take(LONGEST).collect();
        self.key_fault(table.line(value.span().start), table.block, key, KeyFault::WrongType(found, expected));
    }
}

/// The table of a block.
pub(super) struct Table<'a> {
    pub(super) block: &'static str,
    tree: &'a DeTable<'a>,
    piece: &'a Piece,
}

impl<'a> Table<'a> {
    pub(super) fn get(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.tree.iter().find(|(found, _)| found.get_ref().as_ref() == key).map(|(_, value)| value)
    }

    /// Line in the file of a byte of the block.
    pub(super) fn line(&self, byte: usize) -> usize {
        self.piece.line + newlines(&self.piece.text, byte)
    }

    pub(super) fn line_of(&self, key: &str) -> usize {
        self.get(key).map_or(self.first_line(), |value| self.line(value.span().start))
    }

    /// The line of the fence.
    pub(super) fn first_line(&self) -> usize {
        self.piece.line - 1
    }
}

fn newlines(text: &str, byte: usize) -> usize {
    text.bytes().take(byte).filter(|byte| *byte == b'\n').count()
}
