//! `lesson.md` to a [`Lesson`]: headings, text, and blocks of TOML in fences. All faults of a file are found at once.

use super::check::{Check, Name, name};
use super::error::{KeyFault, LessonError, LessonErrorKind};
use super::lesson::{Act, Answer, Changes, Doing, Lesson, Question, Step, Task, WindowNames};
use super::live::Live;
use super::text::{self, Block, Inline};
use crate::analysis::quantity::Quantity;
use crate::scene::{Parameter, Scene, SceneError, presets};
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

const SETUP: &str = "setup";
const QUESTION: &str = "question";
const TASK: &str = "task";
const SETUP_KEYS: &[&str] = &["preset", "set", "light", "look", "tab", "show"];
const QUESTION_KEYS: &[&str] = &["ask", "choices", "answer", "unit", "within", "why"];
const TASK_KEYS: &[&str] = &["ask", "check", "hint", "try", "wrong", "then"];
/// In `try` and `wrong`: the start-up is started.
const START_UP: &str = "start-up";
/// How far a good prediction of a number may be off, unless the lesson says.
const WITHIN: f64 = 0.2;

/// Looks for a preset beside the lesson.
type Beside<'a> = &'a dyn Fn(&str) -> Option<Result<Scene, SceneError>>;

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
    let mut reader = Reader { origin, names, beside, faults: Vec::new(), scene: None };
    let lesson = reader.lesson(id, source);
    match lesson {
        Some(lesson) if reader.faults.is_empty() => Ok(lesson),
        _ => {
            reader.faults.sort_by_key(|fault| fault.line);
            Err(reader.faults)
        }
    }
}

/// A part of the file with the line it begins at, from 1.
struct Piece {
    line: usize,
    text: String,
}

/// A step as it stands in the file.
struct Raw {
    line: usize,
    title: String,
    body: Vec<Piece>,
    blocks: Vec<(&'static str, Piece)>,
}

struct Reader<'a> {
    origin: &'a Path,
    names: WindowNames<'a>,
    beside: Beside<'a>,
    faults: Vec<LessonError>,
    /// The scene of a student who has come this far.
    scene: Option<Scene>,
}

impl Reader<'_> {
    fn fault(&mut self, line: usize, kind: LessonErrorKind) {
        self.faults.push(LessonError { origin: self.origin.to_owned(), line: Some(line), kind });
    }

    fn key_fault(&mut self, line: usize, block: &'static str, key: &str, fault: KeyFault) {
        self.fault(line, LessonErrorKind::Key { block, key: key.to_owned(), fault });
    }

    fn lesson(&mut self, id: &str, source: &str) -> Option<Lesson> {
        let mut title = String::new();
        let mut about = Vec::new();
        let mut steps: Vec<Raw> = Vec::new();
        let mut lines = source.lines().enumerate().map(|(i, line)| (i + 1, line));
        while let Some((number, line)) = lines.next() {
            if let Some(heading) = line.strip_prefix("## ").or_else(|| (line.trim() == "##").then_some("")) {
                if heading.trim().is_empty() {
                    self.fault(number, LessonErrorKind::EmptyHeading);
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
                    self.fault(number, LessonErrorKind::OpenBlock(kind.trim().to_owned()));
                    continue;
                }
                let Some(kind) = [SETUP, QUESTION, TASK].into_iter().find(|known| *known == kind.trim()) else {
                    self.fault(number, LessonErrorKind::UnknownBlock { found: kind.trim().to_owned() });
                    continue;
                };
                match steps.last_mut() {
                    None => self.fault(number, LessonErrorKind::BlockOutside(kind)),
                    Some(step) if step.blocks.iter().any(|(other, _)| *other == kind) => {
                        self.fault(number, LessonErrorKind::BlockTwice(kind));
                    }
                    Some(step) => step.blocks.push((kind, piece)),
                }
            } else {
                let body = steps.last_mut().map_or(&mut about, |step| &mut step.body);
                match body.last_mut() {
                    // Lines that follow each other are one piece; a block between them splits it.
                    Some(piece) if piece.line + piece.text.lines().count() == number => {
                        piece.text.push_str(line);
                        piece.text.push('\n');
                    }
                    _ => body.push(Piece { line: number, text: format!("{line}\n") }),
                }
            }
        }
        if title.is_empty() {
            self.fault(1, LessonErrorKind::NoTitle);
        }
        if steps.is_empty() {
            self.fault(1, LessonErrorKind::NoSteps);
        }
        let about = self.text(&about);
        let steps: Vec<Option<Step>> = steps.iter().map(|step| self.step(step)).collect();
        let steps: Option<Vec<Step>> = steps.into_iter().collect();
        Some(Lesson { id: id.to_owned(), title, about, steps: steps? })
    }

    fn text(&mut self, pieces: &[Piece]) -> Vec<Block> {
        let mut blocks = Vec::new();
        for piece in pieces {
            match text::blocks(&piece.text) {
                Ok(read) => blocks.extend(read),
                Err((line, error)) => self.fault(piece.line + line, error.into()),
            }
        }
        blocks
    }

    fn step(&mut self, raw: &Raw) -> Option<Step> {
        let body = self.text(&raw.body);
        let block = |kind: &str| raw.blocks.iter().find(|(found, _)| *found == kind).map(|(_, piece)| piece);
        let mut setup = Setup::default();
        if let Some(piece) = block(SETUP) {
            self.table(SETUP, SETUP_KEYS, piece, |reader, table| setup = reader.setup(table));
        }
        if self.scene.is_none() {
            if setup.faulty {
                return None;
            }
            self.fault(raw.line, LessonErrorKind::NoScene);
            return None;
        }
        let scene = self.scene.clone()?;
        let (mut question, mut task) = (None, None);
        if let Some(piece) = block(QUESTION) {
            self.table(QUESTION, QUESTION_KEYS, piece, |reader, table| question = reader.question(table));
        }
        if let Some(piece) = block(TASK) {
            self.table(TASK, TASK_KEYS, piece, |reader, table| task = reader.task(table, &scene));
        }
        let Setup { sets, light, look, tab, show, .. } = setup;
        Some(Step { title: raw.title.clone(), body, scene, sets, light, look, tab, show, question, task })
    }

    /// Reads the TOML of a block and its keys.
    fn table(
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

    fn setup(&mut self, table: &Table<'_>) -> Setup {
        let faults = self.faults.len();
        let mut setup = Setup::default();
        let preset = self.string(table, "preset");
        let changes = self.changes(table, "set");
        setup.sets = preset.is_some() || !changes.is_empty();
        if let Some((name, line)) = preset {
            self.scene = None;
            let built_in = || presets::BUILT_IN.iter().find(|preset| preset.name == name).map(|preset| preset.scene());
            match (self.beside)(&name).or_else(built_in) {
                Some(Ok(scene)) => self.scene = Some(scene),
                Some(Err(error)) => self.key_fault(line, SETUP, "preset", KeyFault::Scene(error)),
                None => self.fault(line, LessonErrorKind::NoPreset { name }),
            }
        }
        if let Some(mut scene) = self.scene.clone() {
            if let Err(error) = scene.set_all(changes.iter().map(|(key, value)| (key.as_str(), value.as_str()))) {
                self.key_fault(table.line_of("set"), SETUP, "set", KeyFault::Scene(error));
            }
            self.scene = Some(scene);
        }
        for (key, line) in self.strings(table, "light") {
            match (Parameter::find(&key), &self.scene) {
                (Some(parameter), Some(scene)) if scene.parameters().any(|other| other.key == parameter.key) => {
                    setup.light.push(parameter);
                }
                (_, Some(scene)) => {
                    let allowed: Vec<&str> = scene.parameters().map(|parameter| parameter.key).collect();
                    let allowed = allowed.join(", ");
                    self.key_fault(line, SETUP, "light", KeyFault::NotOneOf(key, allowed));
                }
                (_, None) => {}
            }
        }
        for (place, line) in self.strings(table, "look") {
            if self.names.places.contains(&place.as_str()) {
                setup.look.push(place);
            } else {
                let allowed = self.names.places.join(", ");
                self.key_fault(line, SETUP, "look", KeyFault::NotOneOf(place, allowed));
            }
        }
        if let Some((tab, line)) = self.string(table, "tab") {
            let plate = self.scene.as_ref().is_some_and(|scene| scene.scene() == "plate");
            let tabs = self.names.tabs[usize::from(plate)];
            if tabs.iter().any(|known| known.eq_ignore_ascii_case(&tab)) {
                setup.tab = Some(tab);
            } else {
                let allowed = tabs.join(", ");
                self.key_fault(line, SETUP, "tab", KeyFault::NotOneOf(tab, allowed));
            }
        }
        for (shown, line) in self.strings(table, "show") {
            let found = name(&shown).ok().filter(|name| self.scene.as_ref().is_none_or(|scene| name.belongs(scene)));
            match found {
                Some(name) => setup.show.push(name),
                None => {
                    let results = Quantity::all().map(Quantity::name).chain(Live::all().map(Live::name));
                    let allowed: Vec<&str> = results.collect();
                    let allowed = format!("{}, or a key of this scene", allowed.join(", "));
                    self.key_fault(line, SETUP, "show", KeyFault::NotOneOf(shown, allowed));
                }
            }
        }
        setup.faulty = self.faults.len() > faults;
        setup
    }

    fn question(&mut self, table: &Table<'_>) -> Option<Question> {
        let ask = self.blocks(table, "ask", Some("what is asked"));
        let why = self.blocks(table, "why", Some("what is said once the prediction is made"));
        let choices = self.strings(table, "choices");
        let answer = if table.get("choices").is_some() {
            let read: Vec<Option<Vec<Inline>>> = choices
                .iter()
                .map(|(choice, line)| match text::inline(choice) {
                    Ok(inline) => Some(inline),
                    Err(error) => {
                        self.key_fault(*line, QUESTION, "choices", KeyFault::Text(error));
                        None
                    }
                })
                .collect();
            let choices: Option<Vec<Vec<Inline>>> = read.into_iter().collect();
            if table.get("answer").is_none() {
                let why = "the number of the right choice, from 1";
                self.key_fault(table.first_line(), QUESTION, "answer", KeyFault::Missing(why));
            }
            let (answer, line) = self.number(table, "answer")?;
            let choices = choices?;
            let right = answer.fract() == 0.0 && answer >= 1.0 && answer <= choices.len() as f64;
            if !right || choices.len() < 2 {
                let allowed = format!("1 to {}, of at least 2 choices", choices.len());
                let found = answer.to_string();
                self.key_fault(line, QUESTION, "answer", KeyFault::OutOfRange(found, allowed));
                return None;
            }
            Answer::Choice { choices, right: answer as usize - 1 }
        } else {
            if table.get("answer").is_none() {
                let why = "a number, or with choices the number of the right one";
                self.key_fault(table.first_line(), QUESTION, "answer", KeyFault::Missing(why));
            }
            let (value, _) = self.number(table, "answer")?;
            let unit = self.string(table, "unit").map_or_else(String::new, |(unit, _)| unit);
            let (within, line) = self.number(table, "within").unwrap_or((WITHIN, table.first_line()));
            if !(within > 0.0 && within <= 1.0) {
                let (found, allowed) = (within.to_string(), "above 0 to 1, relative to the answer".to_owned());
                self.key_fault(line, QUESTION, "within", KeyFault::OutOfRange(found, allowed));
            }
            Answer::Number { value, unit, within }
        };
        Some(Question { ask, answer, why })
    }

    fn task(&mut self, table: &Table<'_>, scene: &Scene) -> Option<Task> {
        let ask = self.blocks(table, "ask", Some("what is to be done"));
        let hint = self.blocks(table, "hint", Some("what helps while the check does not hold"));
        let then = self.blocks(table, "then", None);
        let example = self.doing(table, "try", scene);
        let wrong = self.doing(table, "wrong", scene);
        let Some((source, line)) = self.string(table, "check") else {
            if table.get("check").is_none() {
                let why = "what the run is checked for, as alpha > 1.5 * start.alpha";
                self.key_fault(table.first_line(), TASK, "check", KeyFault::Missing(why));
            }
            return None;
        };
        match Check::parse(&source, scene) {
            Ok(check) => Some(Task { ask, check, hint, example, wrong, then }),
            Err(error) => {
                self.key_fault(line, TASK, "check", KeyFault::Check(source, error));
                None
            }
        }
    }

    /// Changes that `scene` takes, and what is done in a tab.
    fn doing(&mut self, table: &Table<'_>, key: &'static str, scene: &Scene) -> Doing {
        let mut doing = Doing::default();
        for (text, line) in self.strings(table, key) {
            if text.trim() == START_UP {
                doing.acts.push(Act::StartUp);
                continue;
            }
            let Some((name, value)) = self.change(table, key, &text, line) else { continue };
            match value.parse::<f64>() {
                Ok(gap) if name == Live::HeldGap.name() && scene.scene() == "plate" && gap > 0.0 && gap.is_finite() => {
                    doing.acts.push(Act::Hold(gap));
                }
                _ => doing.changes.push((name, value)),
            }
        }
        let mut changed = scene.clone();
        if let Err(error) = changed.set_all(doing.changes.iter().map(|(key, value)| (key.as_str(), value.as_str()))) {
            self.key_fault(table.line_of(key), TASK, key, KeyFault::Scene(error));
        }
        doing
    }

    fn changes(&mut self, table: &Table<'_>, key: &'static str) -> Changes {
        let strings = self.strings(table, key);
        strings.into_iter().filter_map(|(text, line)| self.change(table, key, &text, line)).collect()
    }

    /// Reads `key = value`.
    fn change(&mut self, table: &Table<'_>, key: &'static str, text: &str, line: usize) -> Option<(String, String)> {
        let Some((name, value)) = text.split_once('=') else {
            self.key_fault(line, table.block, key, KeyFault::NoChange(text.to_owned()));
            return None;
        };
        let value = value.trim();
        let bare = value.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(value);
        Some((name.trim().to_owned(), bare.to_owned()))
    }

    fn blocks(&mut self, table: &Table<'_>, key: &'static str, needed: Option<&'static str>) -> Vec<Block> {
        let Some((text, line)) = self.string(table, key) else {
            if let (Some(why), None) = (needed, table.get(key)) {
                self.key_fault(table.first_line(), table.block, key, KeyFault::Missing(why));
            }
            return Vec::new();
        };
        match text::blocks(&text) {
            Ok(blocks) => blocks,
            Err((_, error)) => {
                self.key_fault(line, table.block, key, KeyFault::Text(error));
                Vec::new()
            }
        }
    }

    fn string(&mut self, table: &Table<'_>, key: &'static str) -> Option<(String, usize)> {
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

    fn number(&mut self, table: &Table<'_>, key: &'static str) -> Option<(f64, usize)> {
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
    fn strings(&mut self, table: &Table<'_>, key: &'static str) -> Vec<(String, usize)> {
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
        self.key_fault(table.line(value.span().start), table.block, key, KeyFault::WrongType(found, expected));
    }
}

#[derive(Default)]
struct Setup {
    sets: bool,
    light: Vec<&'static Parameter>,
    look: Vec<String>,
    tab: Option<String>,
    show: Vec<Name>,
    faulty: bool,
}

/// The table of a block.
struct Table<'a> {
    block: &'static str,
    tree: &'a DeTable<'a>,
    piece: &'a Piece,
}

impl<'a> Table<'a> {
    fn get(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.tree.iter().find(|(found, _)| found.get_ref().as_ref() == key).map(|(_, value)| value)
    }

    /// Line in the file of a byte of the block.
    fn line(&self, byte: usize) -> usize {
        self.piece.line + newlines(&self.piece.text, byte)
    }

    fn line_of(&self, key: &str) -> usize {
        self.get(key).map_or(self.first_line(), |value| self.line(value.span().start))
    }

    /// The line of the fence.
    fn first_line(&self) -> usize {
        self.piece.line - 1
    }
}

fn newlines(text: &str, byte: usize) -> usize {
    text.bytes().take(byte).filter(|byte| *byte == b'\n').count()
}
