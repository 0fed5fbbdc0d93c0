//! The question, the task and the explanation of a lesson's step, in tinted boxes.

use crate::gui::command::LessonCommand;
use crate::gui::derived::words::without_keys;
use crate::gui::state::lessons::NUMBER;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::parts::number_box;
use crate::gui::ui::rich::{self, Look};
use crate::lessons::text::{self, Block, Inline, filled};
use crate::lessons::work::{Stage, StepWork};
use crate::lessons::{Answer, Choice, Prediction, Question, QuestionKind, Step, Task};
use eframe::egui::{self, Color32, RichText, Ui, vec2};

/// Title of the box of a question.
fn title(kind: QuestionKind) -> &'static str {
    match kind {
        QuestionKind::Predict => "What do you expect?",
        QuestionKind::Calculate => "Calculate",
        QuestionKind::Observe => "What did you see?",
    }
}

/// Label of the button that commits an answer.
pub(super) fn commit_label(kind: QuestionKind) -> &'static str {
    if kind == QuestionKind::Calculate { "This is my result" } else { "This is my prediction" }
}

/// Blocks with the numbers of a run that they quote; `told`: of the run that fulfilled the task.
pub(super) fn blocks(ui: &mut Ui, blocks: &[Block], look: Look, told: bool, cx: &DrawContext<'_>) {
    let value = |reading: &_| cx.state.lessons.quoted(reading, cx.state.document.scene(), told);
    let fill = |block: &Block| match block {
        Block::Paragraph(parts) => Block::Paragraph(filled(parts, &value)),
        Block::Item(parts) => Block::Item(filled(parts, &value)),
        other => other.clone(),
    };
    rich::blocks(ui, &blocks.iter().map(fill).collect::<Vec<_>>(), look);
}

/// Everything of a step below its text, up to the present stage.
pub(super) fn show(ui: &mut Ui, step: &Step, work: &StepWork, cx: &DrawContext<'_>) {
    let stage = work.stage(step);
    let gap = 0.7 * Look::reading(ui).size;
    if let Some(question) = &step.question {
        ui.add_space(gap);
        ask(ui, question, step.task.is_some(), work, cx);
    }
    if let (Some(task), true) = (&step.task, stage != Stage::Question) {
        ui.add_space(gap);
        do_it(ui, task, work, cx);
    }
    if let (Some(observe), Stage::Observation | Stage::Told) = (&step.observe, stage) {
        ui.add_space(gap);
        look_at(ui, observe, work, step.highlight_parts.is_empty(), stage == Stage::Observation, cx);
    }
    if stage != Stage::Told {
        return;
    }
    let then = step.task.as_ref().map(|task| task.then.as_slice()).unwrap_or_default();
    if let Some(question) = &step.question {
        ui.add_space(gap);
        explain(ui, question, then, work, cx);
    } else if !then.is_empty() {
        ui.add_space(gap);
        let look = Look::reading(ui);
        boxed(ui, cx.colours.good, "What it shows", |ui| blocks(ui, then, look, true, cx));
    }
    if !cx.state.awaits_result() && cx.state.lessons.tells_of_another_run(cx.state.document.scene()) {
        cx.note(
            ui,
            "The numbers in this text are from the run with which you completed the task, not from the one on screen.",
        );
    }
}

/// A tinted box with a title.
fn boxed(ui: &mut Ui, colour: Color32, title: &str, add: impl FnOnce(&mut Ui)) {
    let ground = ui.visuals().panel_fill.lerp_to_gamma(colour, 0.13);
    let line = egui::Stroke::new(1.0, ui.visuals().panel_fill.lerp_to_gamma(colour, 0.45));
    let frame =
        egui::Frame::new().fill(ground).stroke(line).corner_radius(6).inner_margin(egui::Margin::symmetric(10, 8));
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 5.0;
        // Buttons keep an outline on the tinted background.
        ui.visuals_mut().widgets.inactive.bg_stroke = line;
        ui.add(egui::Label::new(RichText::new(title).strong().color(colour)).wrap());
        add(ui);
    });
}

fn ask(ui: &mut Ui, question: &Question, task: bool, work: &StepWork, cx: &DrawContext<'_>) {
    let look = Look::reading(ui);
    boxed(ui, cx.colours.film, title(question.kind), |ui| {
        blocks(ui, &question.ask, look, false, cx);
        match &question.answer {
            Answer::Choice { choices: all, .. } => {
                let chosen = match work.prediction {
                    Some(Prediction::Choice(choice)) => Some(choice),
                    _ => None,
                };
                if let Some(choice) = choices(ui, all, chosen, !work.committed, cx) {
                    cx.push(LessonCommand::Predict(Prediction::Choice(choice)));
                }
            }
            Answer::Number { unit, .. } => {
                ui.horizontal(|ui| {
                    let mut number = match work.prediction {
                        Some(Prediction::Number(number)) => number,
                        _ => 0.0,
                    };
                    let name = ui.label("Your number");
                    let field = egui::DragValue::new(&mut number).speed(0.01).max_decimals(6);
                    // This comes before the field is drawn, so that all of its text is selected.
                    cx.lead_to(ui, NUMBER, ui.next_auto_id());
                    if work.committed {
                        ui.disable();
                    }
                    let field = number_box(ui, field, (f64::NEG_INFINITY..=f64::INFINITY, unit), cx);
                    let predict = LessonCommand::Predict(Prediction::Number(number));
                    cx.on_change(&field.labelled_by(name.id), predict);
                    if !unit.is_empty() {
                        ui.label(unit);
                    }
                });
            }
        }
        match (work.committed, question.kind) {
            (true, QuestionKind::Predict) => {
                cx.note(ui, if task { "Prediction made: now see what happens" } else { "Prediction made" });
            }
            (true, QuestionKind::Calculate) if task => {
                let right = question.answer.words(question.answer.right());
                match work.prediction.is_some_and(|given| question.answer.is_right(given)) {
                    true => cx.say(ui, "✔ Right", cx.colours.good),
                    false => cx.say(ui, format!("The answer is {right}"), cx.colours.contact),
                }
            }
            _ => {}
        }
        if work.wrong > 0 && !work.committed {
            cx.say(ui, "Not quite. Try once more:", cx.colours.contact);
            let quiet = Look::usual(ui);
            if question.hint.is_empty() {
                ui.label("Check the units and the powers of ten.");
            }
            blocks(ui, &question.hint, quiet, false, cx);
        }
    });
}

/// Choices below each other, each with its mark; the one that was clicked.
fn choices(ui: &mut Ui, all: &[Choice], chosen: Option<usize>, open: bool, cx: &DrawContext<'_>) -> Option<usize> {
    let look = Look::reading(ui);
    let side = 1.25 * look.size;
    let sense = if open { egui::Sense::click() } else { egui::Sense::hover() };
    let row = |ui: &mut Ui, choice: &[Inline], chosen: bool| {
        let (area, radio) = ui.allocate_exact_size(vec2(side, side), sense);
        let text = text::plain(choice);
        radio.widget_info(|| egui::WidgetInfo::selected(egui::Role::RadioButton, open, chosen, text.as_str()));
        let words = ui.vertical(|ui| rich::paragraph(ui, choice, look)).inner.interact(sense);
        let pointed = open && (radio.hovered() || words.hovered() || radio.has_focus());
        let colour = if chosen || pointed { cx.colours.film } else { cx.colours.quiet };
        let middle = area.center() + vec2(0.0, -0.06 * look.size);
        ui.painter().circle_stroke(middle, 0.38 * look.size, egui::Stroke::new(1.4, colour));
        if chosen {
            ui.painter().circle_filled(middle, 0.22 * look.size, cx.colours.film);
        }
        open && (radio.clicked() || words.clicked())
    };
    let mut clicked = None;
    for (i, choice) in all.iter().enumerate() {
        if ui.horizontal_top(|ui| row(ui, &choice.text, chosen == Some(i))).inner {
            clicked = Some(i);
        }
    }
    clicked
}

fn do_it(ui: &mut Ui, task: &Task, work: &StepWork, cx: &DrawContext<'_>) {
    let look = Look::reading(ui);
    let (colour, title) = match (work.fulfilled, work.shown) {
        (true, true) => (cx.colours.good, "✔ Shown"),
        (true, false) => (cx.colours.good, "✔ Done"),
        _ => (cx.colours.accent, "Your turn"),
    };
    boxed(ui, colour, title, |ui| {
        blocks(ui, &task.ask, look, false, cx);
        if work.fulfilled {
            return;
        }
        ui.add_space(2.0);
        cx.alarm(ui, cx.state.activity.failure.as_deref().map(without_keys));
        match (&work.unmet, &task.too_far, cx.state.awaits_result()) {
            (_, _, true) => cx.note(ui, "Solving…"),
            (Some(unmet), ..) if work.tried => cx.say(ui, format!("Not yet. {unmet}."), cx.colours.contact),
            (None, Some((_, says)), _) if work.too_far => {
                cx.say(ui, "Too far.", cx.colours.contact);
                blocks(ui, says, Look::usual(ui), false, cx);
            }
            _ => {}
        }
        for hint in task.hints.iter().take(work.hints) {
            let look = Look::usual(ui).coloured(cx.colours.quiet);
            blocks(ui, hint, look, false, cx);
        }
        ui.horizontal_wrapped(|ui| {
            if work.hints < task.hints.len() {
                let text = if work.hints == 0 { "Give me a hint" } else { "One more hint" };
                cx.on_click(&ui.small_button(text), LessonCommand::Hint);
            } else if !task.example.is_empty() && ui.small_button("Show me").on_hover_text("Does it for you").clicked()
            {
                cx.push(LessonCommand::ShowMe);
            }
            cx.on_click(&ui.small_button("Start over").on_hover_text("Sets this step up again"), LessonCommand::SetUp);
        });
    });
}

/// The question about what was observed.
fn look_at(ui: &mut Ui, observe: &Question, work: &StepWork, unmarked: bool, open: bool, cx: &DrawContext<'_>) {
    let look = Look::reading(ui);
    let Answer::Choice { choices: all, .. } = &observe.answer else { return };
    boxed(ui, cx.colours.film, title(observe.kind), |ui| {
        blocks(ui, &observe.ask, look, true, cx);
        if let Some(choice) = choices(ui, all, work.observed, open, cx) {
            cx.push(LessonCommand::Observe(choice));
        }
        if let (true, Some(choice)) = (open, work.observed) {
            let where_to = if unmarked { "" } else { " at the marked view, and" };
            let text = format!("That is not what your run shows. Look again{where_to} at the numbers below.");
            cx.say(ui, text, cx.colours.contact);
            blocks(ui, observe.answer.reply(Prediction::Choice(choice)), Look::usual(ui), true, cx);
        }
    });
}

/// The right answer, the reply to a wrong one, and the explanation.
fn explain(ui: &mut Ui, question: &Question, then: &[Block], work: &StepWork, cx: &DrawContext<'_>) {
    let given = work.prediction;
    let right = given.is_some_and(|given| question.answer.is_right(given));
    let (colour, title) = match (right, question.kind) {
        (true, QuestionKind::Calculate) => (cx.colours.good, "✔ Right"),
        (true, _) => (cx.colours.good, "✔ As you expected"),
        (false, QuestionKind::Calculate) => (cx.colours.contact, "The answer is"),
        (false, _) => (cx.colours.contact, "Not what you predicted"),
    };
    let look = Look::reading(ui);
    boxed(ui, colour, title, |ui| {
        if let Some(given) = given.filter(|_| !right) {
            blocks(ui, question.answer.reply(given), look, true, cx);
        }
        match &question.answer {
            Answer::Choice { choices, right } => {
                if let Some(choice) = choices.get(*right) {
                    rich::paragraph(ui, &choice.text, look.coloured(colour));
                }
            }
            Answer::Number { .. } => {
                ui.label(RichText::new(question.answer.words(question.answer.right())).size(look.size).color(colour));
            }
        }
        blocks(ui, &question.why, look, true, cx);
        if !then.is_empty() {
            ui.add_space(0.3 * look.size);
            blocks(ui, then, look, true, cx);
        }
    });
}
