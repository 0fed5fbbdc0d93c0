//! The state of the reader of a lesson (its origin, the names it may use, the faults found so far), and how it reads the TOML of a block.

use crate::lessons::error::LessonError;
use crate::lessons::lesson::WindowNames;
use crate::lessons::text::{self, Block, Inline, Outside, Pictures};
use crate::scene::{Scene, SceneError};
use std::fmt::Display;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Access to the files beside the lesson.
#[derive(Clone, Copy)]
pub(in crate::lessons) struct Beside<'a> {
    /// Finds a preset by the name of its file.
    pub(in crate::lessons) preset: &'a dyn Fn(&str) -> Option<Result<Scene, SceneError>>,
    /// Finds a picture by the name of its file.
    pub(in crate::lessons) pictures: Pictures<'a>,
}

/// A part of the file with the line it begins at, from 1.
pub(super) struct Piece {
    pub(super) line: usize,
    pub(super) text: String,
}

/// A reader of one lesson.
pub(super) struct LessonReader<'a> {
    pub(super) origin: &'a Path,
    pub(super) names: WindowNames<'a>,
    pub(super) beside: Beside<'a>,
    pub(super) faults: Vec<LessonError>,
    /// The scene at this point of the lesson; `None` before the first step has chosen one.
    pub(super) scene: Option<Scene>,
}

impl LessonReader<'_> {
    /// Something is wrong in this line of the file.
    pub(super) fn fault(&mut self, line: usize, what: impl ToString) {
        self.faults.push(LessonError { origin: self.origin.to_owned(), line: Some(line), what: what.to_string() });
    }

    /// Something is wrong with a key of a block. `fault`, the value as written and what is allowed, follows the key in the message.
    pub(super) fn key_fault(&mut self, table: &Table<'_>, key: &str, fault: impl Display) {
        self.line_fault(table, key, table.line_of(key), fault);
    }

    /// Likewise, in this line of its value.
    pub(super) fn line_fault(&mut self, table: &Table<'_>, key: &str, line: usize, fault: impl Display) {
        self.fault(line, format!("{}.{key}{fault}", table.block));
    }

    /// The value `found` of a key is none of those that are `allowed`.
    pub(super) fn not_one_of(&mut self, table: &Table<'_>, key: &str, line: usize, found: &str, allowed: &[&str]) {
        let fault = format!(" = \"{found}\" is not known: expected one of {}", allowed.join(", "));
        self.line_fault(table, key, line, fault);
    }

    /// Adds a fault if a block lacks a required key; `what` describes the key.
    pub(super) fn needs(&mut self, table: &Table<'_>, key: &str, what: &str) {
        if table.get(key).is_none() {
            self.key_fault(table, key, format!(" is missing: {what}"));
        }
    }

    /// Reads the TOML of a block and its keys; `None` if there is no such block, or it cannot be read.
    pub(super) fn table<T>(
        &mut self,
        block: &'static str,
        keys: &'static [&'static str],
        piece: Option<&Piece>,
        read: impl FnOnce(&mut Self, &Table<'_>) -> Option<T>,
    ) -> Option<T> {
        let piece = piece?;
        match DeTable::parse(&piece.text) {
            Ok(tree) => {
                let table = Table { block, tree: tree.get_ref(), piece };
                for key in tree.get_ref().keys() {
                    let name = key.get_ref().as_ref();
                    if !keys.contains(&name) {
                        let fault = format!(" is not known: expected one of {}", keys.join(", "));
                        self.line_fault(&table, name, table.line(key.span().start), fault);
                    }
                }
                read(self, &table)
            }
            Err(error) => {
                let line = piece.line + error.span().map_or(0, |span| newlines(&piece.text, span.start));
                let message = error.message().lines().next().unwrap_or_default();
                self.fault(line, format!("is not valid TOML: {message}"));
                None
            }
        }
    }

    /// The text of a step, or of what comes before the steps.
    pub(super) fn text(&mut self, pieces: &[Piece]) -> Vec<Block> {
        let mut blocks = Vec::new();
        for piece in pieces {
            match self.formatted(&piece.text) {
                Ok(read) => blocks.extend(read),
                Err((line, error)) => self.fault(piece.line + line, error),
            }
        }
        blocks
    }

    /// Text that may quote numbers of a run of the present scene; a fault comes with its line, from 0.
    fn formatted(&self, text: &str) -> Result<Vec<Block>, (usize, String)> {
        let pictures = self.beside.pictures;
        text::blocks(text, self.scene.as_ref().map(|scene| Outside { scene, pictures }))
    }

    /// The result of reading a key; `None`, with a fault added, if it could not be read.
    fn readable<T>(&mut self, table: &Table<'_>, key: &str, line: usize, read: Result<T, String>) -> Option<T> {
        read.map_err(|error| self.line_fault(table, key, line, format!(": {error}"))).ok()
    }

    /// A list of texts as lines; `None` if one cannot be read.
    pub(super) fn lines(&mut self, table: &Table<'_>, key: &'static str) -> Option<Vec<Vec<Inline>>> {
        let strings = self.strings(table, key).into_iter();
        let lines: Vec<_> =
            strings.map(|(text, line)| self.readable(table, key, line, text::inline(&text, None))).collect();
        lines.into_iter().collect()
    }

    /// A list of texts; those that cannot be read are left out.
    pub(super) fn texts(&mut self, table: &Table<'_>, key: &'static str) -> Vec<Vec<Block>> {
        let strings = self.strings(table, key).into_iter();
        strings.filter_map(|(text, line)| self.block(table, key, &text, line)).collect()
    }

    fn block(&mut self, table: &Table<'_>, key: &str, text: &str, line: usize) -> Option<Vec<Block>> {
        let read = self.formatted(text).map_err(|(_, error)| error);
        self.readable(table, key, line, read)
    }

    /// A text, empty if there is none; `needed` says what it is, if the block has to have it.
    pub(super) fn blocks(&mut self, table: &Table<'_>, key: &'static str, needed: Option<&'static str>) -> Vec<Block> {
        needed.into_iter().for_each(|what| self.needs(table, key, what));
        let text = self.string(table, key);
        text.and_then(|text| self.block(table, key, &text, table.line_of(key))).unwrap_or_default()
    }

    /// A text as it is written.
    pub(super) fn string(&mut self, table: &Table<'_>, key: &'static str) -> Option<String> {
        let value = table.get(key)?;
        let text = value.get_ref().as_str().map(str::to_owned);
        if text.is_none() {
            self.wrong_type(table, key, value, "text in quotes");
        }
        text
    }

    /// A finite number.
    pub(super) fn number(&mut self, table: &Table<'_>, key: &'static str) -> Option<f64> {
        let value = table.get(key)?;
        let written = table.piece.text[value.span()].replace('_', "");
        let number = written.parse().ok().filter(|number: &f64| number.is_finite());
        if number.is_none() {
            let is_number = matches!(value.get_ref(), DeValue::Integer(_) | DeValue::Float(_));
            self.wrong_type(table, key, value, if is_number { "a finite decimal number" } else { "a number" });
        }
        number
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

    fn wrong_type(
        &mut self,
        table: &Table<'_>,
        key: &'static str,
        value: &Spanned<DeValue<'_>>,
        expected: &'static str,
    ) {
        const LONGEST: usize = 60;
        let found: String = table.piece.text[value.span()].chars().take(LONGEST).collect();
        let fault = format!(" = {found} is of the wrong type: expected {expected}");
        self.line_fault(table, key, table.line(value.span().start), fault);
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
        self.tree.get(key)
    }

    /// Line in the file of a byte of the block.
    pub(super) fn line(&self, byte: usize) -> usize {
        self.piece.line + newlines(&self.piece.text, byte)
    }

    /// Line of the value of a key, or of the fence if there is no such key.
    pub(super) fn line_of(&self, key: &str) -> usize {
        self.get(key).map_or(self.piece.line - 1, |value| self.line(value.span().start))
    }
}

fn newlines(text: &str, byte: usize) -> usize {
    text.bytes().take(byte).filter(|byte| *byte == b'\n').count()
}
