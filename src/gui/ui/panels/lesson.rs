//! The panel of a lesson, in place of the results: text and questions of the step, the numbers that it is about, and a recap at the end.

use super::{lesson_numbers, lesson_parts};
use crate::gui::command::{Command, LessonCommand};
use crate::gui::state::running_lesson::RunningLesson;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::keys;
use crate::gui::ui::parts::{next_button, scrolled};
use crate::gui::ui::rich::Look;
use crate::lessons::text::readings;
use crate::lessons::work::{Score, Stage, StepWork};
use crate::lessons::{Answer, Lesson, Step};
use eframe::egui::{self, Align, Button, Color32, Id, Layout, RichText, Stroke, TextStyle, Ui, vec2};

/// Shows the running lesson.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let lessons = &cx.state.lessons;
    let Some(running) = lessons.running.as_ref() else { return };
    let Some(lesson) = lessons.lessons.get(running.lesson) else { return };
    ui.add_space(6.0);
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let about = "Ends the lesson and brings your own scene back";
            cx.button(ui, "Leave", about, LessonCommand::Leave);
            let title = RichText::new(format!("Lesson · {}", lesson.title)).color(cx.colours.quiet);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| ui.add(egui::Label::new(title).truncate()));
        });
    });
    dots(ui, running, lesson, cx);
    ui.add_space(2.0);
    let step = lesson.steps.get(running.step).zip(running.work.get(running.step));
    egui::Panel::bottom("lesson, foot").show_separator_line(true).frame(egui::Frame::new()).show(ui, |ui| {
        ui.add_space(6.0);
        match step {
            Some((step, work)) => {
                lesson_numbers::show(ui, step, cx);
                foot(ui, (running.step, lesson.steps.len()), step, work, cx);
            }
            None => foot_of_recap(ui, cx),
        }
        ui.add_space(6.0);
    });
    egui::CentralPanel::default().frame(egui::Frame::new()).show(ui, |ui| {
        scrolled(ui, ("lesson", running.lesson, running.step), 10.0, |ui| {
            let look = Look::reading(ui);
            let Some((step, work)) = step else { return recap(ui, lesson, &running.work, cx) };
            ui.add(egui::Label::new(RichText::new(&step.title).heading().strong()).wrap());
            ui.add_space(0.4 * look.size);
            lesson_parts::blocks(ui, &step.body, look, false, cx);
            lesson_parts::show(ui, step, work, cx);
            // A part that has just appeared below the visible area of a small window is scrolled into view.
            let appeared = Id::unique(("lesson, appeared", running.lesson, running.step));
            let state = (work.stage(step) as u8, work.wrong, work.hints, work.misread, work.too_far);
            let before = ui.ctx().data(|data| data.get_temp::<(u8, usize, usize, usize, bool)>(appeared));
            if before.is_some_and(|before| before != state) {
                ui.scroll_to_cursor(Some(Align::BOTTOM));
            }
            ui.ctx().data_mut(|data| data.insert_temp(appeared, state));
            ui.add_space(12.0);
        });
    });
}

/// Progress of the lesson: a dot for each step, a ring for one that was skipped.
fn dots(ui: &mut Ui, running: &RunningLesson, lesson: &Lesson, cx: &DrawContext<'_>) {
    let steps = lesson.steps.len();
    ui.horizontal(|ui| {
        let place =
            if running.step < steps { format!("Step {} of {steps}", running.step + 1) } else { "Recap".to_owned() };
        ui.label(RichText::new(place).color(cx.colours.quiet));
        let side = 0.62 * ui.text_style_height(&TextStyle::Body);
        ui.spacing_mut().item_spacing.x = 0.45 * side;
        for (i, (step, work)) in lesson.steps.iter().zip(&running.work).enumerate() {
            let (area, dot) = ui.allocate_exact_size(vec2(side, side), egui::Sense::hover());
            let radius = if i == running.step { 0.5 * side } else { 0.32 * side };
            let skipped = work.is_skipped(step);
            let reached = i == running.step || work.left;
            let colour = if reached { cx.colours.film } else { cx.colours.quiet.gamma_multiply(0.6) };
            if skipped {
                ui.painter().circle_stroke(area.center(), radius, Stroke::new(1.5, colour));
            } else {
                ui.painter().circle_filled(area.center(), radius, colour);
            }
            let word = match (i == running.step, skipped, work.left) {
                (true, ..) => "on screen",
                (_, true, _) => "skipped",
                (_, _, true) => "done",
                _ => "to come",
            };
            dot.on_hover_text(format!("{}: {word}", step.title));
        }
    });
}

fn foot(ui: &mut Ui, (step_number, steps): (usize, usize), step: &Step, work: &StepWork, cx: &DrawContext<'_>) {
    let stage = work.stage(step);
    // The button that commits an answer is always visible, however long the text is.
    if let (Some(question), Stage::Question) = (&step.question, stage) {
        // A number that is being typed is committed by the click on the button, and is known in the next frame.
        let typed = matches!(question.answer, Answer::Number { .. }) && ui.ctx().text_edit_focused();
        let given = work.prediction.is_some() && !work.refused;
        let ready = typed || given;
        let commit =
            ui.add_enabled_ui(ready, |ui| next_button(ui, lesson_parts::commit_label(question.kind), ready, cx)).inner;
        let commit = commit.on_hover_text("Enter").on_disabled_hover_text(match work.refused {
            true => "Another number first",
            false => "Answer first: guessing is welcome",
        });
        let clicked = ui.data_mut(|data| data.remove_temp::<()>(commit.id)).is_some();
        if commit.clicked() && typed {
            ui.data_mut(|data| data.insert_temp(commit.id, ()));
        } else if commit.clicked() || clicked && given {
            cx.push(LessonCommand::Commit);
        }
        ui.add_space(4.0);
    }
    ui.horizontal(|ui| {
        let back = ui.add_enabled(step_number > 0, Button::new("Back"));
        cx.on_click(&back.on_hover_text(keys::of(&Command::Lesson(LessonCommand::Back))), LessonCommand::Back);
        cx.button(ui, "All results", "Shows the usual panel; the lesson waits", LessonCommand::AllResults(true));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let complete = stage == Stage::Told;
            let text = match (complete, step_number + 1 == steps) {
                (false, _) => "Skip",
                (true, true) => "Finish",
                (true, false) => "Next",
            };
            let hover = if complete {
                format!("Enter, or {}", keys::of(&Command::Lesson(LessonCommand::Next)))
            } else {
                "Goes on; this step is then shown as skipped".to_owned()
            };
            cx.on_click(&next_button(ui, text, complete, cx).on_hover_text(hover), LessonCommand::Next);
        });
    });
}

fn foot_of_recap(ui: &mut Ui, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        cx.on_click(&ui.button("Back"), LessonCommand::Back);
        cx.button(ui, "Take it again", "From the first step, with nothing answered", LessonCommand::Again);
        let next = cx.state.lessons.following();
        let close = next_button(ui, "Close", next.is_none(), cx);
        cx.on_click(&close.on_hover_text("Brings your own scene back"), LessonCommand::Leave);
        if let Some(next) = next {
            let button = next_button(ui, "Next lesson", true, cx);
            cx.on_click(&button.on_hover_text("Enter"), LessonCommand::Open(next, None));
        }
    });
}

/// Recap of the lesson: the score, and each step with its answer.
fn recap(ui: &mut Ui, lesson: &Lesson, work: &[StepWork], cx: &DrawContext<'_>) {
    let score = Score::of(lesson.steps.iter().zip(work));
    let [points, all] = score.points();
    let look = Look::reading(ui);
    ui.add(egui::Label::new(RichText::new("What you found").heading().strong()).wrap());
    ui.add_space(0.4 * look.size);
    if all > 0 {
        ui.label(RichText::new(format!("{points} of {all} points")).size(1.4 * look.size).color(cx.colours.film));
    }
    let parts = [
        ("predictions came true", score.predictions),
        ("calculations right", score.calculations),
        ("observations right at the first look", score.observations),
        ("tasks done without being shown", score.tasks),
    ];
    for (words, [good, of]) in parts.into_iter().filter(|(_, [_, of])| *of > 0) {
        cx.note(ui, format!("{good} of {of} {words}"));
    }
    match score.skipped {
        [0, _] => {}
        [1, _] => cx.say(ui, "1 step was skipped: Back leads to it.", cx.colours.contact),
        [skipped, _] => cx.say(ui, format!("{skipped} steps were skipped: Back leads to them."), cx.colours.contact),
    }
    for (step, work) in lesson.steps.iter().zip(work) {
        ui.add_space(0.5 * look.size);
        let (mark, colour): (&str, Color32) = match (work.left, work.is_skipped(step)) {
            (true, true) => ("○", cx.colours.contact),
            (true, false) => ("✔", cx.colours.good),
            // This step was never opened.
            (false, _) => ("○", cx.colours.quiet),
        };
        ui.add(egui::Label::new(RichText::new(format!("{mark}  {}", step.title)).color(colour)).wrap());
        if let (Some(question), true) =
            (step.question.as_ref().or(step.observe.as_ref()), work.stage(step) == Stage::Told)
        {
            // Numbers quoted in a text are those of the run on screen, which is another run by now.
            if readings(&question.ask).next().is_none() {
                lesson_parts::blocks(ui, &question.ask, Look::usual(ui).coloured(cx.colours.quiet), true, cx);
            }
            let right = question.answer.words(question.answer.right());
            ui.add(egui::Label::new(RichText::new(right).size(look.size)).wrap());
        }
    }
    ui.add_space(12.0);
}
