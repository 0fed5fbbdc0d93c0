//! The questions about a new motor, with the assumptions for those without an answer.

use super::{Answer, heading};
use crate::gui::command::Command;
use crate::gui::derived::words::{choice, label};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::form::show_list;
use crate::gui::ui::theme::outline_fields;
use crate::scene::Parameter;
use crate::scene::new_motor::{Accepts, Answers, NewMotor, QUESTIONS, Question, asked};
use eframe::egui::{self, Key, Ui};

/// Shares of the window's height for the questions and for the assumptions.
const HEIGHTS: [f32; 2] = [0.5, 0.2];

/// Shows the questions; the answer is the motor. Enter in a field makes the motor, as the button does.
pub(super) fn show(ui: &mut Ui, answers: &Answers, cx: &DrawContext<'_>) -> Answer {
    let mut answers = answers.clone();
    let mut entered = false;
    heading(ui, "A motor from its data sheet");
    outline_fields(ui);
    let height = ui.ctx().content_rect().height();
    // The bar is beside the questions, and visible whenever there is more below: a bar that fades would hide that.
    ui.spacing_mut().scroll = egui::style::ScrollStyle::solid();
    egui::ScrollArea::vertical().id_salt("questions").max_height(HEIGHTS[0] * height).show(ui, |ui| {
        egui::Grid::new("questions").num_columns(2).show(ui, |ui| {
            for question in QUESTIONS {
                entered |= ask(ui, question, &mut answers, cx);
                ui.end_row();
            }
        });
    });
    ui.add_space(8.0);
    let motor = NewMotor::of(&answers);
    // The height does not depend on the text, so that the questions above do not move while they are answered.
    let said =
        egui::ScrollArea::vertical().id_salt("assumed").max_height(HEIGHTS[1] * height).auto_shrink([true, false]);
    said.show(ui, |ui| match &motor {
        Ok(motor) => {
            to_be_raised(&answers).into_iter().for_each(|text| cx.note(ui, text));
            for assumption in &motor.assumed {
                let words = Parameter::find(assumption.key).map_or(assumption.key, label);
                cx.note(ui, format!("Assumed: {words} {}: {}", assumption.value, assumption.why));
            }
        }
        Err(wrong) => {
            let told: Vec<String> = QUESTIONS.iter().filter_map(|question| complaint(question, &answers)).collect();
            let others = wrong.lines().filter(|_| told.is_empty()).map(str::to_owned);
            told.iter().cloned().chain(others).for_each(|line| cx.note(ui, line));
        }
    });
    ui.add_space(12.0);
    ui.horizontal_wrapped(|ui| {
        let make = ui.add_enabled(motor.is_ok(), egui::Button::new("Make this motor")).clicked();
        let cancelled = ui.button("Cancel").clicked();
        match motor {
            Ok(_) if make || entered => Some(vec![Command::MakeNewMotor(answers)]),
            _ => cancelled.then(Vec::new),
        }
    })
    .inner
}

/// What the motor will have more of than is assumed here, where nothing is solved yet, in order to agree with the data sheet.
fn to_be_raised(answers: &Answers) -> Option<String> {
    let follows = [
        ("stall-torque-nm", "friction", "stall torque"),
        ("no-load-speed-rpm", "tangential amplitude", "no-load speed"),
    ];
    let follows = follows.into_iter().filter(|(question, ..)| asked(answers, question).is_some());
    let (more, until): (Vec<&str>, Vec<&str>) = follows.map(|(_, more, until)| (more, until)).unzip();
    let [more, until] = [more, until].map(|words| words.join(" and "));
    (!more.is_empty()).then(|| {
        format!(
            "When the motor is made, it is solved with more {more} than assumed below until it reaches the {until} of the data sheet, if that is possible"
        )
    })
}

/// Why the answer to a question is refused or missing, with the question's words; `None` if it is valid.
fn complaint(question: &Question, answers: &Answers) -> Option<String> {
    let answer = answers.get(question.name).map_or("", |answer| answer.trim());
    match (answer, question.otherwise) {
        ("", Some(_)) => None,
        ("", None) => Some(format!("{}: needed, {}", question.words, question.allowed())),
        _ => {
            question.check(answer).err().map(|_| format!("{}: {answer} is not {}", question.words, question.allowed()))
        }
    }
}

/// Shows a question with its present answer, and takes a new one. Returns whether Enter was pressed in its field.
fn ask(ui: &mut Ui, question: &'static Question, answers: &mut Answers, cx: &DrawContext<'_>) -> bool {
    let mut entered = false;
    let label = ui.label(question.title());
    let present = answers.get(question.name).map_or("", String::as_str);
    let hint = question.otherwise.unwrap_or("needed");
    let mut answer = present.to_owned();
    if let Accepts::Choice(names) = question.accepts {
        // The names are those of gases: the labels are those of the panel.
        let shown = choice("film.gas", if present.is_empty() { hint } else { present });
        let combo = egui::ComboBox::from_id_salt(question.name).selected_text(shown);
        let combo = show_list(ui, combo, |ui| {
            for name in names {
                ui.selectable_value(&mut answer, (*name).to_owned(), choice("film.gas", name));
            }
        });
        combo.labelled_by(label.id);
    } else {
        let field = egui::TextEdit::singleline(&mut answer).hint_text(hint).desired_width(f32::INFINITY);
        let field = ui.add(field).labelled_by(label.id);
        entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        if ui.memory(|memory| memory.focused().is_none()) && question.otherwise.is_none() && answer.is_empty() {
            field.request_focus();
        }
    }
    if answer != present {
        answers.insert(question.name.to_owned(), answer.clone());
        cx.push(Command::AnswerNewMotor(question.name, answer));
    }
    entered
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_assumed_only_for_a_start_says_so() {
        let told =
            |given: &[&str]| to_be_raised(&given.iter().map(|name| ((*name).to_owned(), "1".to_owned())).collect());
        assert_eq!(told(&["diameter-mm", "load-n"]), None);
        let torque = told(&["stall-torque-nm"]).unwrap();
        assert!(
            torque.contains("more friction than") && torque.contains("the stall torque of the data sheet"),
            "{torque}"
        );
        let both = told(&["stall-torque-nm", "no-load-speed-rpm"]).unwrap();
        assert!(
            both.contains("friction and tangential amplitude") && both.contains("torque and no-load speed"),
            "{both}"
        );
    }
}
