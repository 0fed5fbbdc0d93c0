//! Pinned runs beside each other: their names, their fields in phase, and their numbers with differences from the first.

use crate::analysis::compare::{ComparedRun, ParameterRow};
use crate::analysis::quantity::Quantity;
use crate::digits::{capitalised, raised};
use crate::export::compare::{difference_text, value_text};
use crate::gui::command::{Command, PinCommand};
use crate::gui::derived::words::{explanation, label, shown};
use crate::gui::state::pins::{Note, Page, Pin, fidelity};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::{Hint, text_width};
use crate::gui::ui::panels::menu::{COMPARISON, export_button, menu, presets_menu};
use crate::gui::ui::parts::first_button;
use crate::gui::ui::plot::stroked;
use crate::gui::ui::theme::{run_colour, run_dash};
use crate::gui::ui::views::overlay;
use crate::gui::ui::{glossary, keys};
use eframe::egui::{self, Color32, Id, Key, RichText, Sense, Stroke, TextStyle, Ui, vec2};
use egui_plot::LineStyle;

/// Widest field for a label, in heights of the text.
const WIDEST_LABEL: f32 = 16.0;
/// Margin and gaps between the parts of a pin \[points\].
const CHIP_MARGIN: i8 = 4;
const CHIP_GAP: f32 = 5.0;
/// With more runs than this, or in a tab narrower than their columns, the differences are shown below the values instead of beside them.
const BESIDE: usize = 3;
/// Widths of the columns of names, values and differences, and of a label above them that has room or has not, in heights of
/// the text.
const COLUMNS: [f32; 3] = [12.0, 9.0, 8.0];
const HEADS: [f32; 2] = [11.0, 7.5];

/// Shows the tab.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let pins = &cx.state.pins;
    if pins.runs.is_empty() && pins.waiting.is_empty() {
        restore_button(ui, cx);
        return introduction(ui, cx);
    }
    chips(ui, cx);
    note(ui, cx);
    if pins.runs.is_empty() {
        return;
    }
    ui.add_space(2.0);
    match pins.page {
        Page::Fields => overlay::show(ui, cx),
        Page::Numbers => numbers(ui, cx),
    }
}

fn introduction(ui: &mut Ui, cx: &DrawContext<'_>) {
    ui.add_space(8.0);
    let text = "Pin a run, change the scene, pin the next: their waves, pressures and loads are laid over each other in \
                phase, their maps share one scale of colours, and a table shows what differs.";
    cx.note(ui, text);
    ui.add_space(6.0);
    ui.horizontal_wrapped(|ui| add_buttons(ui, cx));
    note(ui, cx);
}

/// Outcome of the last request.
fn note(ui: &mut Ui, cx: &DrawContext<'_>) {
    let (text, colour) = match &cx.state.pins.note {
        Some(Note::Remark(text)) => (text, cx.colours.quiet),
        Some(Note::Failure(text)) => (text, cx.colours.alarm),
        None => return,
    };
    cx.say(ui, text, colour);
}

fn add_buttons(ui: &mut Ui, cx: &DrawContext<'_>) {
    let pin = Command::Pin(PinCommand::Shown);
    let empty = cx.state.pins.pins.is_empty();
    let button = first_button(ui, "Pin the run on screen", (empty, cx.state.run.is_some()), cx);
    cx.on_click(&button.hint(keys::about(&pin)), pin);
    let presets = menu(ui, "Pin a preset ▾", &mut |ui| presets_menu(ui, |name| PinCommand::Preset(name).into(), cx));
    presets.hint("Solves a built-in preset in the background and pins it; the scene on screen stays");
}

/// A button that restores the pins that were removed last, if there are any.
fn restore_button(ui: &mut Ui, cx: &DrawContext<'_>) {
    let (name, about) = match cx.state.pins.removed() {
        0 => return,
        1 => ("Bring the pin back", "The one that was removed last"),
        _ => ("Bring the pins back", "Those that were removed together"),
    };
    cx.button(ui, name, about, PinCommand::Restore);
}

/// The pins, as the legend of all drawings.
fn chips(ui: &mut Ui, cx: &DrawContext<'_>) {
    let pins = &cx.state.pins;
    ui.horizontal_wrapped(|ui| {
        for (page, name, about) in [
            (Page::Fields, "Fields", "Waves, pressures, maps and loads of all pinned runs, in phase"),
            (Page::Numbers, "Numbers", "Results and parameters of all pinned runs, and what differs"),
        ] {
            cx.on_click(&ui.selectable_label(pins.page == page, name).hint(about), PinCommand::Look(page));
        }
        ui.separator();
        add_buttons(ui, cx);
        if pins.runs.len() > 1 {
            let about = "Takes all pins away; until there is another one they can be brought back";
            cx.button(ui, "Remove all", about, PinCommand::Clear);
            export_button(ui, COMPARISON, cx);
        }
        restore_button(ui, cx);
    });
    ui.add_space(2.0);
    ui.horizontal_wrapped(|ui| {
        for (pin, run) in pins.pins.iter().zip(&pins.runs) {
            chip(ui, pin, run, run.scene == *cx.state.document.scene(), cx);
        }
        for waiting in &pins.waiting {
            frame(ui, cx.colours.quiet).show(ui, |ui| {
                ui.spinner();
                ui.label(&waiting.name);
                let name = format!("Do not pin {}", waiting.name);
                cx.small_button(ui, ("✕", "Do not pin it"), &name, PinCommand::Remove(waiting.id));
            });
        }
    });
}

fn frame(ui: &Ui, colour: Color32) -> egui::Frame {
    let fill = ui.visuals().extreme_bg_color;
    egui::Frame::new().fill(fill).stroke((1.0, colour)).corner_radius(5).inner_margin(egui::Margin::same(CHIP_MARGIN))
}

fn chip(ui: &mut Ui, pin: &Pin, run: &ComparedRun, present: bool, cx: &DrawContext<'_>) {
    let (id, colour, dash) = (pin.id, run_colour(pin.slot, cx.state.dark), run_dash(pin.slot));
    let em = ui.text_style_height(&TextStyle::Body);
    let button = |text: &str| text_width(ui, text) + 2.0 * ui.spacing().button_padding.x + CHIP_GAP;
    // A square, or space for some dashes.
    let swatch = if dash == LineStyle::Solid { 0.8 } else { 2.0 } * em;
    // The width of everything except the label.
    let rest = 2.0 * f32::from(CHIP_MARGIN) + swatch + 0.2 * em + CHIP_GAP + button("✕");
    let rest = rest + if present { 0.0 } else { button("Open") };
    let label = text_width(ui, &run.label) + 4.0;
    let label = label.min(WIDEST_LABEL * em).min(ui.max_rect().width() - rest - 8.0).max(2.0 * em);
    // The parts of a pin are in one box, which moves to the next line as a whole.
    let size = vec2(rest + label, ui.spacing().interact_size.y + 2.0 * f32::from(CHIP_MARGIN));
    let parts = |ui: &mut Ui| {
        ui.spacing_mut().item_spacing.x = CHIP_GAP;
        let (swatch, _) = ui.allocate_exact_size(vec2(swatch, 0.8 * em), Sense::hover());
        if dash == LineStyle::Solid {
            ui.painter().rect_filled(swatch, 2.0, colour);
        } else {
            let ends = [swatch.left_center(), swatch.right_center()];
            ui.painter().extend(stroked(&ends, Stroke::new(2.0, colour), dash));
        }
        name_field(ui, id, run, label, cx);
        if !present {
            let open = ("Open", "Makes this the present scene; undo brings the previous one back");
            cx.small_button(ui, open, &format!("Open {}", run.label), PinCommand::Open(id));
        }
        cx.small_button(ui, ("✕", "Remove this pin"), &format!("Remove {}", run.label), PinCommand::Remove(id));
    };
    let row = egui::Layout::left_to_right(egui::Align::Center);
    ui.allocate_ui_with_layout(size, row, |ui| frame(ui, colour).show(ui, parts));
}

/// The label, which can be edited; Enter or leaving the field commits it, Escape does not.
fn name_field(ui: &mut Ui, pin: u64, run: &ComparedRun, width: f32, cx: &DrawContext<'_>) {
    let id = Id::unique(("label of a pin", pin));
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| run.label.clone());
    let focused = ui.memory(|memory| memory.has_focus(id));
    // A name that is longer than the field is shortened until it is edited.
    let mut layouter = |ui: &Ui, text: &dyn egui::TextBuffer, _: f32| {
        let (font, colour) = (TextStyle::Body.resolve(ui.style()), ui.visuals().text_color());
        let text = text.as_str();
        let text = if focused { text.to_owned() } else { cut(text, |text| text_width(ui, text) <= width) };
        let job = egui::text::LayoutJob::simple_singleline(text, font, colour);
        ui.fonts_mut(|fonts| fonts.layout_job(job))
    };
    let field = egui::TextEdit::singleline(&mut text)
        .id(id)
        .layouter(&mut layouter)
        .frame(egui::Frame::NONE)
        .clip_text(true)
        .margin(egui::Margin::ZERO)
        .align(egui::Align2::LEFT_CENTER)
        .min_size(vec2(width, ui.spacing().interact_size.y))
        .desired_width(width);
    let about = format!("{}, solved at {}. Type to rename it", run.label, fidelity(run));
    let response = ui.add(field).hint(about).called(egui::Role::TextInput, &format!("Label of {}", run.label));
    if response.lost_focus() {
        let escaped = ui.input(|input| input.key_pressed(Key::Escape));
        if !escaped && text != run.label {
            cx.push(PinCommand::Rename(pin, text));
        }
        ui.data_mut(|data| data.remove::<String>(id));
    } else if response.changed() {
        ui.data_mut(|data| data.insert_temp(id, text));
    }
}

/// `text`, or as much of it as fits, with "…" in it. Names of pins begin alike, so more is kept of the end. A number and its unit are kept
/// or dropped together.
fn cut(text: &str, fits: impl Fn(&str) -> bool) -> String {
    if fits(text) {
        return text.to_owned();
    }
    let chars: Vec<char> = text.chars().collect();
    let numbers = numbers_with_units(&chars);
    let within = |place: usize| numbers.iter().find(|number| (number.start + 1..number.end).contains(&place));
    let kept = |count: usize| {
        let (head, tail) = (count / 3, chars.len() - (count - count / 3));
        let head = within(head).map_or(head, |number| number.start);
        let tail = within(tail).map_or(tail, |number| number.end);
        chars[..head].iter().chain(&['…']).chain(&chars[tail..]).collect::<String>()
    };
    (0..chars.len()).rev().map(kept).find(|text| fits(text)).unwrap_or_default()
}

/// The positions of the numbers in a text, each with the following word unless a comma separates them.
fn numbers_with_units(text: &[char]) -> Vec<std::ops::Range<usize>> {
    let mut found: Vec<std::ops::Range<usize>> = Vec::new();
    let mut start = 0;
    let mut has_unit = true;
    for word in text.split(|c| *c == ' ') {
        let end = start + word.len();
        let number = word.iter().find(|c| !['-', '−', '±'].contains(*c)).is_some_and(char::is_ascii_digit);
        if number {
            found.push(start..end);
            has_unit = word.ends_with(&[',']);
        } else if let Some(last) = found.last_mut().filter(|_| !has_unit) {
            (last.end, has_unit) = (end, true);
        }
        start = end + 1;
    }
    found
}

/// Results and parameters of all pins.
fn numbers(ui: &mut Ui, cx: &DrawContext<'_>) {
    let pins = &cx.state.pins;
    let quiet = |text: &str| RichText::new(text).color(cx.colours.quiet);
    // The scroll bars are always visible, so that columns beyond the edge are not overlooked.
    ui.spacing_mut().scroll = egui::style::ScrollStyle::solid();
    egui::ScrollArea::both().id_salt("numbers of pins").auto_shrink(false).show(ui, |ui| {
        let [motors, plates] = ["motor", "plate"].map(|kind| pins.runs.iter().any(|run| run.scene.scene() == kind));
        if pins.runs.len() < 2 {
            ui.label(quiet("Pin another run to see differences"));
        } else {
            let about = "Differences are from the first, in per cent of its value. The ± is the solver's estimate of its numerical error";
            ui.label(quiet(about));
        }
        if motors && plates {
            ui.label(quiet("Motors and plates have few numbers in common; a number that a run does not have is left empty"));
        }
        ui.add_space(4.0);
        ui.label(RichText::new("Results").strong());
        results(ui, cx);
        ui.add_space(10.0);
        ui.label(RichText::new("Parameters").strong());
        let mut differing = !pins.all_parameters;
        let about = "Leaves out the parameters in which all pinned runs are alike";
        let checkbox = ui.checkbox(&mut differing, "Only those that differ").hint(about);
        cx.on_change(&checkbox, PinCommand::AllParameters(!differing));
        let rows: Vec<&ParameterRow> =
            pins.parameters.iter().filter(|row| pins.all_parameters || row.differs()).collect();
        if rows.is_empty() {
            let text = if pins.runs.len() < 2 { "Pin a second run to see differences" } else { "No parameter differs" };
            ui.label(quiet(text));
        } else {
            parameters(ui, &rows, cx);
        }
        ui.add_space(8.0);
    });
}

/// The labels above the columns, in the colours of the curves.
fn heads(ui: &mut Ui, [beside, roomy]: [bool; 2], cx: &DrawContext<'_>) {
    let em = ui.text_style_height(&TextStyle::Body);
    ui.label("");
    for (i, (pin, run)) in cx.state.pins.pins.iter().zip(&cx.state.pins.runs).enumerate() {
        ui.scope(|ui| {
            ui.set_max_width(HEADS[usize::from(!roomy)] * em);
            let text = RichText::new(&run.label).color(run_colour(pin.slot, cx.state.dark)).strong();
            ui.add(egui::Label::new(text).wrap()).hint(&run.label);
        });
        if beside && i > 0 {
            glossary::term(ui, RichText::new("difference").color(cx.colours.quiet), "difference");
        }
    }
    ui.end_row();
}

fn grid(id: &str, columns: usize) -> egui::Grid {
    egui::Grid::new(id).num_columns(columns).striped(true).spacing([18.0, 4.0])
}

/// Whether differences fit beside the values of this many runs.
fn fits_beside(ui: &Ui, count: usize) -> bool {
    let [name, value, difference] = COLUMNS;
    let (values, differences) = (count as f32, count.saturating_sub(1) as f32);
    let wide = (name + value * values + difference * differences) * ui.text_style_height(&TextStyle::Body);
    count <= BESIDE && wide < ui.available_width()
}

fn results(ui: &mut Ui, cx: &DrawContext<'_>) {
    let count = cx.state.pins.runs.len();
    let beside = fits_beside(ui, count);
    grid("results of pins", if beside { 2 * count } else { count + 1 }).show(ui, |ui| {
        heads(ui, [beside; 2], cx);
        for row in &cx.state.pins.results {
            let main = Quantity::HEADLINES.contains(&row.quantity);
            let strong = |text: String| if main { RichText::new(text).strong() } else { RichText::new(text) };
            glossary::term(ui, strong(capitalised(&row.label())), row.quantity.words());
            for (i, cell) in row.cells.iter().enumerate() {
                if beside {
                    ui.add(egui::Label::new(strong(raised(&value_text(row, cell)))).extend());
                    if i > 0 {
                        let difference = RichText::new(raised(&difference_text(row, cell))).color(cx.colours.quiet);
                        ui.add(egui::Label::new(difference).extend());
                    }
                    continue;
                }
                ui.vertical(|ui| {
                    ui.spacing_mut().item_spacing.y = 0.0;
                    ui.add(egui::Label::new(strong(raised(&value_text(row, cell)))).extend());
                    let difference = raised(&difference_text(row, cell));
                    if !difference.is_empty() {
                        ui.add(egui::Label::new(RichText::new(difference).color(cx.colours.quiet)).extend());
                    }
                });
            }
            ui.end_row();
        }
    });
}

fn parameters(ui: &mut Ui, rows: &[&ParameterRow], cx: &DrawContext<'_>) {
    let roomy = fits_beside(ui, cx.state.pins.runs.len());
    grid("parameters of pins", cx.state.pins.runs.len() + 1).show(ui, |ui| {
        heads(ui, [false, roomy], cx);
        for row in rows {
            let unit = if row.parameter.unit.is_empty() { String::new() } else { format!(", {}", row.parameter.unit) };
            let about = explanation(cx.state.document.scene(), row.parameter, None);
            let mut name = label(row.parameter).to_owned();
            if rows.iter().filter(|other| label(other.parameter) == name).count() > 1 {
                name += &format!(" of the {}", row.parameter.table());
            }
            ui.label(name + &unit).hint(about);
            for (place, value) in row.values.iter().enumerate() {
                let text = match value {
                    Some(value) => RichText::new(shown(row.parameter.key, value)),
                    None => RichText::new(row.missing(place)),
                };
                let strong = value.is_some() && row.differs();
                ui.label(if strong { text.strong() } else { text.color(cx.colours.quiet) });
            }
            ui.end_row();
        }
    });
}

#[cfg(test)]
mod tests {
    use super::cut;

    #[test]
    fn what_is_cut_keeps_its_end() {
        let shown = |text: &str, most: usize| cut(text, |text| text.chars().count() <= most);
        let pins = ["100", "150"].map(|spacing| format!("Fundamental case, minimum spacing H_m {spacing} nm"));
        assert_eq!(pins.each_ref().map(|pin| shown(pin, 16)), ["Funda…H_m 100 nm", "Funda…H_m 150 nm"]);
        assert_eq!(shown(&pins[0], 100), pins[0]);
        // A number is not shown without its unit, nor a part of a number.
        let name = "Case, frequency 45 kHz, minimum spacing H_m 100 nm";
        for most in 1..name.len() {
            let text = shown(name, most);
            let (head, tail) = text.split_once('…').unwrap();
            assert!(name.starts_with(head) && name.ends_with(tail), "{text}");
            assert_eq!(text.matches("nm").count(), text.matches("100 nm").count(), "{text}");
            assert_eq!(text.contains("kHz"), text.contains("45 kHz"), "{text}");
            assert_eq!(text.contains('4') || text.contains('5'), text.contains("45 kHz"), "{text}");
            assert_eq!(text.contains('0') || text.contains('1'), text.contains("100 nm"), "{text}");
        }
        assert_eq!((shown("µµµ", 1), shown("µµµ", 0)), ("…".to_owned(), String::new()));
    }
}
