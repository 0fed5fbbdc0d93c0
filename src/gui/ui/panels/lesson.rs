//! The panel of a lesson, in place of the results: the step's text, its question, its task, the numbers it is about.

use crate::digits::capitalised;
use crate::gui::command::{Command, LessonCommand};
use crate::gui::derived::format::digits;
use crate::gui::state::lessons::StepWork;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::rich::{self, Look};
use crate::gui::ui::{glossary, keys};
use crate::lessons::check::Name;
use crate::lessons::live::Live;
use crate::lessons::text::{self, Inline};
use crate::lessons::{Answer, Prediction, Question, Step, Task};
use crate::scene::Value;
use eframe::egui::{self, Align, Button, Color32, Id, Layout, RichText, TextStyle, Ui, vec2};

/// Digits of the numbers beside the text.
const DIGITS: usize = 4;
/// Widths of the columns of numbers, in heights of the text: the first two have room for a sign.
const NUMBER_WIDTHS: [f32; 3] = [4.5, 4.5, 3.7];
/// Changes smaller than this are none, relative.
const UNCHANGED: f64 = 5e-4;

/// Shows the lesson that is followed.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let lessons = &cx.state.lessons;
    let (Some(running), Some((lesson, step))) = (lessons.running(), lessons.step()) else { return };
    let work = running.work.get(running.step).cloned().unwrap_or_default();
    ui.add_space(6.0);
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let leave = ui.button("Leave").on_hover_text("Ends the lesson and brings your own scene back");
            if leave.clicked() {
                cx.push(LessonCommand::Leave);
            }
            let title = RichText::new(format!("Lesson · {}", lesson.title)).color(cx.colours.quiet);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| ui.add(egui::Label::new(title).truncate()));
        });
    });
    let progress = (running.step, lesson.steps.len());
    dots(ui, progress, cx);
    ui.add_space(2.0);
    egui::Panel::bottom("lesson, foot").show_separator_line(true).frame(egui::Frame::new()).show(ui, |ui| {
        ui.add_space(6.0);
        numbers(ui, step, cx);
        foot(ui, step, &work, cx);
        ui.add_space(6.0);
    });
    egui::CentralPanel::default().frame(egui::Frame::new()).show(ui, |ui| {
        let scroll = egui::ScrollArea::vertical().id_salt(("lesson", running.lesson, running.step)).auto_shrink(false);
        scroll.show(ui, |ui| {
            // Room for the scroll bar, which floats.
            ui.set_max_width(ui.available_width() - 10.0);
            let look = Look::reading(ui);
            ui.add(egui::Label::new(RichText::new(&step.title).heading().strong()).wrap());
            ui.add_space(0.4 * look.size);
            rich::blocks(ui, &step.body, look);
            if let Some(question) = &step.question {
                ui.add_space(0.7 * look.size);
                ask(ui, question, step.task.is_some(), &work, cx);
            }
            let asked = step.question.is_none() || work.committed;
            if let (Some(task), true) = (&step.task, asked) {
                ui.add_space(0.7 * look.size);
                do_it(ui, task, &work, cx);
            }
            if let (Some(question), true) = (&step.question, answered(step, &work)) {
                ui.add_space(0.7 * look.size);
                answer(ui, question, &work, cx);
            }
            // What has just appeared, below the fold of a small window, comes into view.
            let appeared = Id::unique(("lesson, appeared", running.lesson, running.step));
            let state = (work.committed, work.fulfilled);
            let before = ui.ctx().data(|data| data.get_temp::<(bool, bool)>(appeared));
            if before.is_some_and(|before| before != state) {
                ui.scroll_to_cursor(Some(Align::BOTTOM));
            }
            ui.ctx().data_mut(|data| data.insert_temp(appeared, state));
            ui.add_space(12.0);
        });
    });
}

/// Whether the answer may be seen: after the prediction, and after the student has tried.
fn answered(step: &Step, work: &StepWork) -> bool {
    work.committed && (step.task.is_none() || work.fulfilled)
}

/// How far the lesson is.
fn dots(ui: &mut Ui, (step, steps): (usize, usize), cx: &DrawContext<'_>) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("Step {} of {steps}", step + 1)).color(cx.colours.quiet));
        let side = 0.62 * ui.text_style_height(&TextStyle::Body);
        ui.spacing_mut().item_spacing.x = 0.45 * side;
        for i in 0..steps {
            let (area, _) = ui.allocate_exact_size(vec2(side, side), egui::Sense::hover());
            let radius = if i == step { 0.5 * side } else { 0.32 * side };
            let colour = if i <= step { cx.colours.film } else { cx.colours.quiet.gamma_multiply(0.6) };
            ui.painter().circle_filled(area.center(), radius, colour);
        }
    });
}

/// A tinted box with a title.
fn boxed<R>(ui: &mut Ui, colour: Color32, title: &str, add: impl FnOnce(&mut Ui) -> R) -> R {
    let ground = ui.visuals().panel_fill.lerp_to_gamma(colour, 0.13);
    let line = egui::Stroke::new(1.0, ui.visuals().panel_fill.lerp_to_gamma(colour, 0.45));
    let frame =
        egui::Frame::new().fill(ground).stroke(line).corner_radius(6).inner_margin(egui::Margin::symmetric(10, 8));
    let shown = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 5.0;
        // Buttons keep an edge on the tinted ground.
        ui.visuals_mut().widgets.inactive.bg_stroke = line;
        ui.add(egui::Label::new(RichText::new(title).strong().color(colour)).wrap());
        add(ui)
    });
    shown.inner
}

fn ask(ui: &mut Ui, question: &Question, task: bool, work: &StepWork, cx: &DrawContext<'_>) {
    let look = Look::reading(ui);
    boxed(ui, cx.colours.film, "What do you expect?", |ui| {
        rich::blocks(ui, &question.ask, look);
        match &question.answer {
            Answer::Choice { choices, .. } => {
                for (i, choice) in choices.iter().enumerate() {
                    let chosen = work.prediction == Some(Prediction::Choice(i));
                    let row = ui.horizontal_top(|ui| choice_row(ui, choice, chosen, !work.committed, look, cx));
                    if row.inner && !work.committed {
                        cx.push(LessonCommand::Predict(Prediction::Choice(i)));
                    }
                }
            }
            Answer::Number { unit, .. } => {
                ui.horizontal(|ui| {
                    let mut number = match work.prediction {
                        Some(Prediction::Number(number)) => number,
                        _ => 0.0,
                    };
                    let name = ui.label("Your number");
                    let field =
                        ui.add_enabled(!work.committed, egui::DragValue::new(&mut number).speed(0.01).max_decimals(6));
                    if field.labelled_by(name.id).changed() {
                        cx.push(LessonCommand::Predict(Prediction::Number(number)));
                    }
                    if !unit.is_empty() {
                        ui.label(unit);
                    }
                });
            }
        }
        if work.committed {
            let text = if task { "Prediction made: now see what happens" } else { "Prediction made" };
            ui.label(RichText::new(text).color(cx.colours.quiet));
        } else {
            let ready = work.prediction.is_some();
            let button = ui.add_enabled(ready, Button::new("This is my prediction"));
            if button.on_disabled_hover_text("Answer first: guessing is welcome, and it is not kept").clicked() {
                cx.push(LessonCommand::Commit);
            }
        }
    });
}

/// A choice with its mark; whether it was clicked.
fn choice_row(ui: &mut Ui, choice: &[Inline], chosen: bool, open: bool, look: Look, cx: &DrawContext<'_>) -> bool {
    let side = 1.25 * look.size;
    let sense = if open { egui::Sense::click() } else { egui::Sense::hover() };
    let (area, radio) = ui.allocate_exact_size(vec2(side, side), sense);
    let text = text::plain(choice);
    radio.widget_info(|| egui::WidgetInfo::selected(egui::Role::RadioButton, open, chosen, text.as_str()));
    let words = ui.vertical(|ui| rich::paragraph(ui, choice, look)).inner;
    let words = words.interact(sense);
    let pointed = open && (radio.hovered() || words.hovered() || radio.has_focus());
    let colour = if chosen || pointed { cx.colours.film } else { cx.colours.quiet };
    let middle = area.center() + vec2(0.0, -0.06 * look.size);
    ui.painter().circle_stroke(middle, 0.38 * look.size, egui::Stroke::new(1.4, colour));
    if chosen {
        ui.painter().circle_filled(middle, 0.22 * look.size, cx.colours.film);
    }
    radio.clicked() || words.clicked()
}

fn do_it(ui: &mut Ui, task: &Task, work: &StepWork, cx: &DrawContext<'_>) {
    let look = Look::reading(ui);
    let (colour, title) = if work.fulfilled { (cx.colours.good, "✔ Done") } else { (cx.colours.accent, "Your turn") };
    boxed(ui, colour, title, |ui| {
        rich::blocks(ui, &task.ask, look);
        if work.fulfilled {
            if !task.then.is_empty() {
                ui.add_space(2.0);
                rich::blocks(ui, &task.then, look);
            }
            return;
        }
        let quiet = Look::usual(ui).coloured(cx.colours.quiet);
        ui.add_space(2.0);
        match (&work.unmet, cx.state.awaits_result()) {
            (_, true) => drop(ui.label(RichText::new("Solving…").color(cx.colours.quiet))),
            (Some(unmet), _) if work.tried => {
                cx.say(ui, format!("Not yet. {unmet}."), cx.colours.contact);
                rich::blocks(ui, &task.hint, quiet);
            }
            _ => rich::blocks(ui, &task.hint, quiet),
        }
        ui.horizontal_wrapped(|ui| {
            if !task.example.is_empty() && ui.small_button("Show me").on_hover_text("Does it for you").clicked() {
                cx.push(LessonCommand::ShowMe);
            }
            if ui.small_button("Start over").on_hover_text("Sets this step up again").clicked() {
                cx.push(LessonCommand::SetUp);
            }
        });
    });
}

fn answer(ui: &mut Ui, question: &Question, work: &StepWork, cx: &DrawContext<'_>) {
    let right = work.prediction.is_some_and(|prediction| question.answer.is_right(prediction));
    let (colour, title) =
        if right { (cx.colours.good, "✔ As you expected") } else { (cx.colours.contact, "Not what you predicted") };
    let look = Look::reading(ui);
    boxed(ui, colour, title, |ui| {
        match &question.answer {
            Answer::Choice { choices, right } => {
                if let Some(choice) = choices.get(*right) {
                    rich::paragraph(ui, choice, look.coloured(colour));
                }
            }
            Answer::Number { value, unit, .. } => {
                let text = format!("{value} {unit}").trim().to_owned();
                ui.label(RichText::new(text).size(look.size).color(colour));
            }
        }
        rich::blocks(ui, &question.why, look);
    });
}

/// The numbers that the step is about: at its beginning, now, and their ratio.
fn numbers(ui: &mut Ui, step: &Step, cx: &DrawContext<'_>) {
    let scene = cx.state.document.scene();
    let Some(running) = cx.state.lessons.running() else { return };
    if step.show.is_empty() {
        return;
    }
    let value = |name: Name, start: bool| match name {
        Name::Quantity(quantity) => {
            let numbers = if start { Some(&running.start.numbers) } else { running.newest.as_ref() };
            numbers.and_then(|numbers| numbers.get(quantity))
        }
        Name::Live(live) => if start { &running.start.live } else { &running.live }.get(live),
        Name::Key(parameter) => {
            let scene = if start { &running.start.scene } else { scene };
            scene.get(parameter.key).and_then(|value| value.as_number())
        }
    };
    let shown = |name: Name, value: Option<f64>| match (name, value) {
        (_, None) => "…".to_owned(),
        // A parameter as it was typed, a result with its digits.
        (Name::Key(_), Some(value)) => Value::Number(value).to_string().replace('-', "−"),
        (Name::Live(Live::Cycles), Some(value)) => format!("{value}"),
        (Name::Quantity(_) | Name::Live(_), Some(value)) => digits(value, DIGITS),
    };
    // Three columns of numbers; the names have what is left.
    let em = ui.text_style_height(&TextStyle::Body);
    let row = |ui: &mut Ui, name: &mut dyn FnMut(&mut Ui), cells: [RichText; 3]| {
        let height = ui.spacing().interact_size.y.min(1.3 * em);
        ui.allocate_ui_with_layout(vec2(ui.available_width(), height), Layout::right_to_left(Align::Center), |ui| {
            for (cell, width) in cells.into_iter().zip(NUMBER_WIDTHS).rev() {
                let width = vec2(width * em, height);
                ui.allocate_ui_with_layout(width, Layout::right_to_left(Align::Center), |ui| {
                    ui.set_min_width(width.x);
                    ui.add(egui::Label::new(cell).extend());
                });
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| name(ui));
        });
    };
    let quiet = |text: &str| RichText::new(text).color(cx.colours.quiet);
    let table = ui.scope(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 2.0);
        row(ui, &mut |ui| drop(ui.label(quiet("Your run"))), [quiet("at first"), quiet("now"), quiet("")]);
        for &shown_name in &step.show {
            let words = shown_name.words();
            let unit = match shown_name.unit(scene) {
                "" => String::new(),
                unit => format!(", {unit}"),
            };
            let (first, now) = (value(shown_name, true), value(shown_name, false));
            let ratio = match (first, now) {
                (Some(first), Some(now)) if first.abs() > 0.0 && (now / first - 1.0).abs() > UNCHANGED => {
                    format!("× {}", digits(now / first, 3))
                }
                _ => String::new(),
            };
            let mut name = |ui: &mut Ui| {
                let label = ui.add(egui::Label::new(format!("{}{unit}", capitalised(&words))).truncate());
                glossary::hover(ui, label, &words);
            };
            let present = RichText::new(shown(shown_name, now)).strong().color(ui.visuals().strong_text_color());
            row(
                ui,
                &mut name,
                [quiet(&shown(shown_name, first)), present, RichText::new(ratio).color(cx.colours.film)],
            );
        }
    });
    // The ring stands outside of what the panel clips.
    ui.scope(|ui| {
        ui.set_clip_rect(ui.clip_rect().expand(8.0));
        cx.mark(ui, "numbers", table.response.rect);
    });
    ui.add_space(6.0);
}

fn foot(ui: &mut Ui, step: &Step, work: &StepWork, cx: &DrawContext<'_>) {
    let lessons = &cx.state.lessons;
    let (Some(running), Some((lesson, _))) = (lessons.running(), lessons.step()) else { return };
    let last = running.step + 1 == lesson.steps.len();
    let complete = (step.question.is_none() || work.committed) && (step.task.is_none() || work.fulfilled);
    ui.horizontal(|ui| {
        let back = ui.add_enabled(running.step > 0, Button::new("Back"));
        if back.on_hover_text(keys::of(&Command::Lesson(LessonCommand::Back))).clicked() {
            cx.push(LessonCommand::Back);
        }
        if ui.button("All results").on_hover_text("Shows the usual panel; the lesson waits").clicked() {
            cx.push(LessonCommand::AllResults(true));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let text = if last { "Finish" } else { "Next" };
            let mut button = Button::new(RichText::new(text).strong());
            if complete {
                button = button.fill(ui.visuals().selection.bg_fill).stroke(egui::Stroke::new(1.0, cx.colours.film));
            }
            let hover = if complete {
                keys::of(&Command::Lesson(LessonCommand::Next))
            } else {
                "Goes on without this step's task".to_owned()
            };
            if ui.add(button).on_hover_text(hover).clicked() {
                cx.push(LessonCommand::Next);
            }
            let following = running.lesson + 1;
            if last
                && following < lessons.lessons().len()
                && ui.button("Next lesson").on_hover_text("Finishes this one and begins the next").clicked()
            {
                cx.push(LessonCommand::Next);
                cx.push(LessonCommand::Open(following));
            }
        });
    });
}
