//! The blocks of a step: its setup, its questions and its task.

use super::table::{LessonReader, Piece, Table};
use crate::lessons::check::{Check, Name, name, results};
use crate::lessons::lesson::{Act, Answer, Changes, Choice, Doing, Question, QuestionKind, Step, Task};
use crate::lessons::live::Live;
use crate::scene::{Parameter, Scene, presets};

pub(super) const BLOCKS: [&str; 4] = [SETUP, QUESTION, TASK, OBSERVE];
const SETUP: &str = "setup";
const QUESTION: &str = "question";
const TASK: &str = "task";
const OBSERVE: &str = "observe";
const SETUP_KEYS: &[&str] = &["preset", "set", "highlight_keys", "highlight_parts", "tab", "show"];
const QUESTION_KEYS: &[&str] = &["kind", "ask", "choices", "answer", "unit", "within", "replies", "hint", "why"];
const OBSERVE_KEYS: &[&str] = &["ask", "choices", "answer", "replies"];
const TASK_KEYS: &[&str] = &["ask", "check", "too_far", "too_far_says", "hints", "try", "wrong", "then"];
/// The entry of `try` and `wrong` that starts the start-up.
const START_UP: &str = "start-up";
/// Relative deviation up to which a number counts as right, unless the lesson gives another one.
const WITHIN: f64 = 0.2;
/// The kinds of questions, and their names in a lesson.
const KINDS: [(&str, QuestionKind); 2] = [("predict", QuestionKind::Predict), ("calculate", QuestionKind::Calculate)];

/// A step as it is in the file, before its text and its blocks are read.
pub(super) struct Raw {
    pub(super) line: usize,
    pub(super) title: String,
    pub(super) body: Vec<Piece>,
    pub(super) blocks: Vec<(&'static str, Piece)>,
}

impl LessonReader<'_> {
    pub(super) fn step(&mut self, raw: &Raw) -> Option<Step> {
        let block = |kind: &str| raw.blocks.iter().find(|(found, _)| *found == kind).map(|(_, piece)| piece);
        let setup = self.table(SETUP, SETUP_KEYS, block(SETUP), |reader, table| Some(reader.setup(&raw.title, table)));
        let setup = setup.unwrap_or_default();
        let Some(scene) = self.scene.clone() else {
            if !setup.faulty {
                let missing =
                    "setup.preset is missing: the first step has to name a preset, built in or a file beside lesson.md";
                self.fault(raw.line, missing);
            }
            return None;
        };
        let body = self.text(&raw.body);
        let question = self.table(QUESTION, QUESTION_KEYS, block(QUESTION), Self::question);
        let task = self.table(TASK, TASK_KEYS, block(TASK), |reader, table| reader.task(table, &scene));
        let observe = match block(OBSERVE) {
            Some(piece) if task.is_none() => {
                let fault = "a block ```observe asks what was seen after a task, and this step has no ```task";
                self.fault(piece.line - 1, fault);
                None
            }
            None => question.as_ref().filter(|_| task.is_some()).and_then(same_choices),
            piece => self.table(OBSERVE, OBSERVE_KEYS, piece, Self::question),
        };
        let Setup { sets, highlight_keys, highlight_parts, tab, show, .. } = setup;
        Some(Step {
            title: raw.title.clone(),
            body,
            scene,
            sets,
            highlight_keys,
            highlight_parts,
            tab,
            show,
            question,
            task,
            observe,
        })
    }

    fn setup(&mut self, title: &str, table: &Table<'_>) -> Setup {
        let faults = self.faults.len();
        let mut setup = Setup::default();
        let preset = self.string(table, "preset");
        let changes = self.changes(table, "set");
        setup.sets = preset.is_some() || !changes.is_empty();
        if let Some(name) = preset {
            self.scene = None;
            let built_in = || presets::BuiltIn::find(&name).map(|preset| preset.scene());
            match (self.beside.preset)(&name).or_else(built_in) {
                Some(Ok(scene)) => self.scene = Some(scene),
                Some(Err(error)) => self.key_fault(table, "preset", format!(": {error}")),
                None => {
                    let fault = "there is no such file beside lesson.md, and no such built-in preset";
                    let fault = format!(" = \"{name}\": {fault}; squeezefilm presets lists those");
                    self.key_fault(table, "preset", fault);
                }
            }
        }
        if let Some(mut scene) = self.scene.clone() {
            if let Err(error) = scene.set_all(&changes) {
                self.key_fault(table, "set", format!(": {error}"));
            }
            if !changes.is_empty() {
                // The preset's name and description do not describe the changed scene.
                (scene.name, scene.about) = (format!("Lesson: {title}"), String::new());
            }
            self.scene = Some(scene);
        }
        for (key, line) in self.strings(table, "highlight_keys") {
            match (Parameter::find(&key), &self.scene) {
                (Some(parameter), Some(scene)) if scene.parameters().any(|other| other.key == parameter.key) => {
                    setup.highlight_keys.push(parameter);
                }
                (_, Some(scene)) => {
                    let allowed: Vec<&str> = scene.parameters().map(|parameter| parameter.key).collect();
                    self.not_one_of(table, "highlight_keys", line, &key, &allowed);
                }
                (_, None) => {}
            }
        }
        for (place, line) in self.strings(table, "highlight_parts") {
            if self.names.places.contains(&place.as_str()) {
                setup.highlight_parts.push(place);
            } else {
                self.not_one_of(table, "highlight_parts", line, &place, self.names.places);
            }
        }
        if let Some(tab) = self.string(table, "tab") {
            let plate = self.scene.as_ref().is_some_and(|scene| scene.scene() == "plate");
            let tabs = self.names.tabs[usize::from(plate)];
            if tabs.iter().any(|known| known.eq_ignore_ascii_case(&tab)) {
                setup.tab = Some(tab);
            } else {
                self.not_one_of(table, "tab", table.line_of("tab"), &tab, tabs);
            }
        }
        for (shown, line) in self.strings(table, "show") {
            let found = name(&shown).ok().filter(|name| self.scene.as_ref().is_none_or(|scene| name.belongs(scene)));
            match found {
                Some(name) => setup.show.push(name),
                None => {
                    let allowed: Vec<&str> = results().map(Name::text).chain(["or a key of this scene"]).collect();
                    self.not_one_of(table, "show", line, &shown, &allowed);
                }
            }
        }
        setup.faulty = self.faults.len() > faults;
        setup
    }

    /// The question of a block ```question or ```observe. The latter always has choices, and no explanation of its own.
    fn question(&mut self, table: &Table<'_>) -> Option<Question> {
        let observes = table.block == OBSERVE;
        let kind = if observes { QuestionKind::Observe } else { self.kind(table) };
        let ask = self.blocks(table, "ask", (!observes).then_some("what is asked"));
        let why = self.blocks(table, "why", (!observes).then_some("what is said once the answer is given"));
        let hint = self.blocks(table, "hint", None);
        let answer = if table.get("choices").is_some() || observes {
            if kind == QuestionKind::Calculate {
                let fault = " does not go with kind = \"calculate\": a calculation ends in a number";
                self.key_fault(table, "choices", fault);
                return None;
            }
            self.choices(table)?
        } else {
            self.needs(table, "answer", "a number, or with choices the number of the right one");
            let value = self.number(table, "answer")?;
            let unit = self.string(table, "unit").unwrap_or_default();
            let within = self.number(table, "within").unwrap_or(WITHIN);
            if !(within > 0.0 && within <= 1.0) {
                let fault = format!(" = {within} is out of range: allowed above 0 to 1, relative to the answer");
                self.key_fault(table, "within", fault);
            }
            Answer::Number { value, unit, within }
        };
        Some(Question { kind, ask, answer, hint, why })
    }

    fn kind(&mut self, table: &Table<'_>) -> QuestionKind {
        let Some(name) = self.string(table, "kind") else { return QuestionKind::Predict };
        let found = KINDS.iter().find(|(known, _)| *known == name);
        if found.is_none() {
            self.not_one_of(table, "kind", table.line_of("kind"), &name, &KINDS.map(|(known, _)| known));
        }
        found.map_or(QuestionKind::Predict, |(_, kind)| *kind)
    }

    /// Choices with their replies, and which of them is right.
    fn choices(&mut self, table: &Table<'_>) -> Option<Answer> {
        let choices = self.lines(table, "choices");
        self.needs(table, "choices", "a list of answers");
        self.needs(table, "answer", "the number of the right choice, from 1");
        let replies = self.texts(table, "replies");
        let answer = self.number(table, "answer")?;
        let choices = choices?;
        let right = answer.fract() == 0.0 && answer >= 1.0 && answer <= choices.len() as f64;
        if !right || choices.len() < 2 {
            let fault = format!(" = {answer} is out of range: allowed 1 to {}, of at least 2 choices", choices.len());
            self.key_fault(table, "answer", fault);
            return None;
        }
        if !replies.is_empty() && replies.len() != choices.len() {
            let (found, wanted) = (replies.len(), choices.len());
            let allowed = format!("allowed {wanted}, one for each choice, \"\" for the right one");
            let fault = format!(" = {found} texts is out of range: {allowed}");
            self.key_fault(table, "replies", fault);
        }
        let replies = replies.into_iter().chain(std::iter::repeat(Vec::new()));
        let choices = choices.into_iter().zip(replies).map(|(text, reply)| Choice { text, reply }).collect();
        Some(Answer::Choice { choices, right: answer as usize - 1 })
    }

    fn task(&mut self, table: &Table<'_>, scene: &Scene) -> Option<Task> {
        let ask = self.blocks(table, "ask", Some("what is to be done"));
        self.needs(table, "hints", "texts that help, given one after the other on request");
        let hints = self.texts(table, "hints");
        let then = self.blocks(table, "then", None);
        let example = self.doing(table, "try", scene);
        let wrong = self.doing(table, "wrong", scene);
        let limit = self.check(table, "too_far", scene);
        let says = limit.as_ref().map(|_| self.blocks(table, "too_far_says", Some("what is said beyond the aim")));
        self.needs(table, "check", "what the run is checked for, as alpha > 1.5 * start.alpha");
        let check = self.check(table, "check", scene)?;
        Some(Task { ask, check, too_far: limit.zip(says), hints, example, wrong, then })
    }

    fn check(&mut self, table: &Table<'_>, key: &'static str, scene: &Scene) -> Option<Check> {
        let source = self.string(table, key)?;
        let check = Check::parse(&source, scene);
        check.map_err(|error| self.key_fault(table, key, format!(" = \"{source}\": {error}"))).ok()
    }

    /// Changes of `scene`, which have to be allowed, and actions in a tab.
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
        if let Err(error) = scene.with(&doing.changes) {
            self.key_fault(table, key, format!(": {error}"));
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
            let expected = "expected \"key = value\", as in \"film.min_spacing_nm = 100\"";
            self.line_fault(table, key, line, format!(": \"{text}\" is no change: {expected}"));
            return None;
        };
        let value = value.trim();
        let bare = value.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(value);
        Some((name.trim().to_owned(), bare.to_owned()))
    }
}

/// The question about what was seen, if the lesson gives none: the choices of the prediction again.
fn same_choices(asked: &Question) -> Option<Question> {
    let Answer::Choice { choices, right } = &asked.answer else { return None };
    let choices = choices.iter().map(|choice| Choice { text: choice.text.clone(), reply: Vec::new() }).collect();
    let answer = Answer::Choice { choices, right: *right };
    Some(Question { kind: QuestionKind::Observe, ask: Vec::new(), hint: Vec::new(), why: Vec::new(), answer })
}

#[derive(Default)]
struct Setup {
    sets: bool,
    highlight_keys: Vec<&'static Parameter>,
    highlight_parts: Vec<String>,
    tab: Option<String>,
    show: Vec<Name>,
    faulty: bool,
}
