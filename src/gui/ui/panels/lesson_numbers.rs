//! The numbers that a step of a lesson is about.

use crate::digits::{capitalised, significant};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary::Explained;
use crate::gui::ui::hint::text_width;
use crate::lessons::Step;
use crate::lessons::check::Name;
use crate::lessons::live::Live;
use crate::scene::Value;
use eframe::egui::{self, Align, Layout, RichText, TextStyle, Ui, vec2};

/// Digits of the numbers beside the text.
const DIGITS: usize = 4;
/// Widths of the columns of numbers, in heights of the text: the first two have room for a sign.
const NUMBER_WIDTHS: [f32; 3] = [4.5, 4.5, 3.7];
/// Relative changes smaller than this count as none.
const UNCHANGED: f64 = 5e-4;

/// The numbers that the step is about: at its beginning, now, and their ratio.
pub(super) fn show(ui: &mut Ui, step: &Step, cx: &DrawContext<'_>) {
    let scene = cx.state.document.scene();
    let Some(running) = cx.state.lessons.running.as_ref() else { return };
    if step.show.is_empty() {
        return;
    }
    let [ran, begun] = running.ran(scene);
    let shown = |name: Name, value: Option<f64>| match (name, value) {
        (_, None) => "…".to_owned(),
        // A parameter is shown as it was typed, a result with its digits.
        (Name::Key(_), Some(value)) => Value::Number(value).to_string().replace('-', "−"),
        (Name::Live(Live::Cycles), Some(value)) => format!("{value}"),
        (Name::Quantity(_) | Name::Live(_), Some(value)) => significant(value, DIGITS),
    };
    // Three columns of numbers; the names get the remaining width.
    let em = ui.text_style_height(&TextStyle::Body);
    let row = |ui: &mut Ui, name: Option<&dyn Fn(&mut Ui)>, cells: [RichText; 3]| {
        let height = ui.spacing().interact_size.y.min(1.3 * em);
        ui.allocate_ui_with_layout(vec2(ui.available_width(), height), Layout::right_to_left(Align::Center), |ui| {
            for (cell, width) in cells.into_iter().zip(NUMBER_WIDTHS).rev() {
                let width = vec2(width * em, height);
                ui.allocate_ui_with_layout(width, Layout::right_to_left(Align::Center), |ui| {
                    ui.set_min_width(width.x);
                    ui.add(egui::Label::new(cell).extend());
                });
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| name.into_iter().for_each(|name| name(ui)));
        });
    };
    let quiet = |text: &str| RichText::new(text).color(cx.colours.quiet);
    let table = ui.scope(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 2.0);
        let whose: &dyn Fn(&mut Ui) = &|ui| drop(ui.label(quiet("Your run")));
        row(ui, Some(whose), [quiet("at first"), quiet("now"), quiet("")]);
        for &shown_name in &step.show {
            let words = shown_name.words();
            let unit = match shown_name.unit(scene) {
                "" => String::new(),
                unit => format!(", {unit}"),
            };
            let (first, now) = (shown_name.number(begun), shown_name.number(ran));
            let ratio = match (first, now) {
                (Some(first), Some(now)) if first.abs() > 0.0 && (now / first - 1.0).abs() > UNCHANGED => {
                    format!("× {}", significant(now / first, 3))
                }
                _ => String::new(),
            };
            let text = format!("{}{unit}", capitalised(&words));
            let name = |ui: &mut Ui| {
                ui.add(egui::Label::new(&text).wrap()).explained(ui, &words);
            };
            // A name that does not fit has lines of its own, above its numbers.
            let beside = ui.available_width() - NUMBER_WIDTHS.map(|width| width * em + 4.0).iter().sum::<f32>();
            let fits = text_width(ui, &text) <= beside;
            if !fits {
                name(ui);
            }
            let present = RichText::new(shown(shown_name, now)).strong().color(ui.visuals().strong_text_color());
            let cells = [quiet(&shown(shown_name, first)), present, RichText::new(ratio).color(cx.colours.film)];
            row(ui, fits.then_some(&name as &dyn Fn(&mut Ui)), cells);
        }
    });
    // The ring lies outside of the clip rectangle of the panel.
    ui.scope(|ui| {
        ui.set_clip_rect(ui.clip_rect().expand(8.0));
        cx.name_part(ui, "numbers", table.response.rect);
    });
    ui.add_space(6.0);
}
