//! The left panel: every parameter of the scene. It reads the scene and pushes commands.

use super::field::{self, Field};
use super::records;
use crate::digits::{capitalised, counted, significant};
use crate::gui::command::Command;
use crate::gui::derived::sliders::{inside, slider_range};
use crate::gui::derived::words::{self, field_name, label, label_in};
use crate::gui::state::dialogs::Purpose;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::form::choices;
use crate::gui::ui::highlight;
use crate::gui::ui::hint::{Hint, text_width};
use crate::gui::ui::parts::scrolled_anew;
use crate::gui::ui::theme::outline_fields;
use crate::scene::{Kind, PARAMETERS, Parameter, ParameterKind, Scene, SolvedPlate, Value};
use crate::solution::Status;
use eframe::egui::{self, RichText, TextStyle, Ui};

/// Keys of the main parameters, listed first.
const MAIN: &[&str] = &[
    "film.min_spacing_nm",
    "surface.rms_nm",
    "stator.tooth_width_mm",
    "stator.frequency_khz",
    "plate.mean_gap_um",
    "plate.amplitude_um",
    "plate.frequency_khz",
];

/// The groups: table, heading, whether it starts open.
pub const GROUPS: &[(&str, &str, bool)] = &[
    ("motor", "Motor", true),
    ("stator", "Stator", true),
    ("plate", "Plate", true),
    ("rotor", "Rotor", false),
    ("film", "Film", false),
    ("surface", "Surface", false),
    ("numerics", "Numerics", false),
];

/// Digits of a value that follows from other keys.
const FOLLOWING_DIGITS: usize = 4;
/// Narrowest slider.
const SHORTEST_SLIDER: f32 = 40.0;
/// Size of notes relative to the text.
const NOTE_SIZE: f32 = 0.88;
/// Margin between the frame of the main group and its contents.
const FRAME_MARGIN: i8 = 6;

/// Shows the parameters of the scene, each with the reason if its last edit was rejected.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let scene = cx.state.document.scene();
    scrolled_anew(ui, "parameters", cx.state.view.opened, 8.0, |ui| {
        let mut panel = Panel { scene, units: 0.0, cx };
        panel.all(ui);
    });
}

/// Data shared by all rows.
struct Panel<'a> {
    scene: &'a Scene,
    /// Width of the column of units of the present group.
    units: f32,
    cx: &'a DrawContext<'a>,
}

impl Panel<'_> {
    fn all(&mut self, ui: &mut Ui) {
        ui.spacing_mut().item_spacing.y = 4.0;
        outline_fields(ui);
        ui.add_space(6.0);
        for parameter in self.in_group("") {
            self.row(ui, parameter);
        }
        ui.add_space(4.0);
        let (scene, opened) = (self.scene, self.cx.state.document.saved());
        let changed = if scene.about == opened.about { scene.changed(opened).count() } else { 0 };
        let main = MAIN.iter().filter_map(|key| Parameter::find(key));
        let main: Vec<_> = main
            .filter(|p| is_main(scene, p) && (scene.get(p.key).is_some() || scene.following(p.key).is_some()))
            .collect();
        self.measure_units(ui, &main);
        let line = ui.visuals().widgets.noninteractive.bg_stroke;
        egui::Frame::new().stroke(line).corner_radius(6).inner_margin(FRAME_MARGIN).show(ui, |ui| {
            ui.set_width(ui.available_width());
            let heading = ui.add(egui::Label::new(RichText::new("Main").strong()).selectable(false)).rect;
            // The note is beside the heading, so that nothing moves under a slider that is dragged. Its area is always there, because
            // otherwise the widgets after it would change their ids.
            let area = heading.with_max_x(ui.max_rect().right());
            let layout = egui::Layout::right_to_left(egui::Align::Center);
            let mut beside = ui.new_child(egui::UiBuilder::new().max_rect(area).layout(layout));
            if changed > 0 {
                let values = counted(changed, "value", "values");
                let long = format!("{} from the description", counted(changed, "value differs", "values differ"));
                let fits = NOTE_SIZE * text_width(ui, &long) < area.width() - heading.width();
                let text = if fits { long } else { format!("{values} changed") };
                quiet(&mut beside, self.cx, &text);
            }
            ui.add_space(2.0);
            for parameter in main {
                self.row(ui, parameter);
            }
        });
        ui.add_space(4.0);
        for &(table, title, open) in GROUPS {
            let parameters = self.in_group(table);
            if parameters.is_empty() {
                continue;
            }
            self.measure_units(ui, &parameters);
            let lessons = &self.cx.state.lessons;
            let refused = parameters.iter().any(|parameter| {
                self.cx.state.rejected.of(parameter.key).is_some()
                    || (lessons.reveal && lessons.highlights(parameter.key))
            });
            egui::CollapsingHeader::new(RichText::new(title).strong())
                .id_salt(table)
                .default_open(open)
                .open(refused.then_some(true))
                .show_unindented(ui, |ui| {
                    for parameter in parameters {
                        self.row(ui, parameter);
                    }
                });
        }
        ui.add_space(12.0);
    }

    /// Makes the column of units as wide as the widest of `parameters`.
    fn measure_units(&mut self, ui: &Ui, parameters: &[&'static Parameter]) {
        self.units = parameters.iter().map(|parameter| text_width(ui, &self.scene.unit(parameter))).fold(0.0, f32::max);
    }

    fn in_group(&self, table: &str) -> Vec<&'static Parameter> {
        let shown = |p: &&'static Parameter| self.scene.has(p) || self.scene.following(p.key).is_some();
        let inside = |p: &&'static Parameter| p.table() == table && !is_main(self.scene, p);
        let mut parameters: Vec<_> = PARAMETERS.iter().filter(shown).filter(inside).collect();
        if table == "rotor" && self.scene.kind() == Kind::Motor {
            // For a beam, a given file replaces the beam.
            let file = |p: &&'static Parameter| p.table() == table && matches!(p.kind, ParameterKind::CsvPath { .. });
            let others: Vec<_> = PARAMETERS.iter().filter(|p| file(p) && !parameters.contains(p)).collect();
            parameters.extend(others);
        }
        parameters
    }

    fn row(&mut self, ui: &mut Ui, parameter: &'static Parameter) {
        let row = ui.push_id(parameter.key, |ui| {
            let value = self.scene.get(parameter.key);
            match (parameter.kind, &value) {
                (_, None) if self.scene.following(parameter.key).is_some() => self.following_row(ui, parameter),
                (ParameterKind::Number { .. } | ParameterKind::Whole { .. }, number) => {
                    if parameter.absent.is_some() || number.is_none() {
                        self.switch_row(ui, parameter, number.is_some());
                    }
                    number.iter().for_each(|number| self.number_row(ui, parameter, number));
                }
                (ParameterKind::Flag { .. }, Some(Value::Flag(on))) => self.flag_row(ui, parameter, *on),
                (ParameterKind::Choice { .. }, Some(_)) => self.choice_row(ui, parameter),
                (ParameterKind::Rows { .. }, Some(Value::Rows(rows))) => self.rows_row(ui, parameter, rows.len()),
                (ParameterKind::Records { columns, fewest, .. }, Some(Value::Records(of))) => {
                    self.label_row(ui, parameter);
                    records::show(ui, self.cx, parameter, columns, fewest, of);
                }
                (ParameterKind::Text { .. }, Some(value)) => self.text_row(ui, parameter, value),
                (ParameterKind::CsvPath { .. }, _) => self.path_row(ui, parameter),
                // The type of a value in a scene is always that of its key.
                _ => {}
            }
            self.footnotes(ui, parameter);
        });
        let lessons = &self.cx.state.lessons;
        if lessons.highlights(parameter.key) {
            highlight::ring(ui, row.response.rect);
            if lessons.reveal {
                ui.scroll_to_rect(row.response.rect.expand(ui.text_style_height(&TextStyle::Body)), None);
            }
            let typed = !matches!(parameter.kind, ParameterKind::Choice { .. });
            let enters = typed && lessons.enter.as_deref() == Some(parameter.key);
            if let Some(value) = self.scene.get(parameter.key).filter(|_| enters) {
                field::enter(ui, parameter.key, &value);
            }
        }
        ui.add_space(4.0);
    }

    /// A read-only row for a value that follows from other keys.
    fn following_row(&mut self, ui: &mut Ui, parameter: &'static Parameter) {
        let Some(value) = self.scene.following(parameter.key) else { return };
        let explanation = format!("{}\nFollows from the keys above\n{}", parameter.about, parameter.key);
        ui.horizontal_wrapped(|ui| {
            ui.add(egui::Label::new(label(parameter)).selectable(false)).hint_beside(ui, &explanation);
            let text = format!("{} {}", significant(value, FOLLOWING_DIGITS), parameter.unit).trim_end().to_owned();
            ui.label(RichText::new(text).color(self.cx.colours.quiet)).hint_beside(ui, &explanation);
        });
    }

    /// The name, and at its right the button that resets the value.
    fn label_row(&mut self, ui: &mut Ui, parameter: &'static Parameter) -> egui::Response {
        let explanation = self.explanation(parameter);
        let text = RichText::new(label_in(self.scene, parameter));
        let text = if is_main(self.scene, parameter) { text.strong() } else { text };
        self.beside_reset(ui, parameter, |ui| {
            ui.add(egui::Label::new(text).wrap().selectable(false)).hint_beside(ui, &explanation)
        })
    }

    /// `add` at the left, and at the right the reset button if the value differs from the one that was opened.
    fn beside_reset<R>(&mut self, ui: &mut Ui, parameter: &'static Parameter, add: impl FnOnce(&mut Ui) -> R) -> R {
        let original = self.original(parameter).filter(|value| Some(value) != self.scene.get(parameter.key).as_ref());
        let side = ui.text_style_height(&TextStyle::Body);
        let right = ui.max_rect().right();
        let row = ui.scope(|ui| {
            ui.set_max_width((ui.available_width() - side - ui.spacing().item_spacing.x).max(side));
            add(ui)
        });
        if let Some(value) = original {
            // It is placed over the row, whose height does not change when the button appears.
            let corner = egui::pos2(right - side, row.response.rect.top());
            let area = egui::Rect::from_min_size(corner, egui::vec2(side, side));
            let button = reset_button(ui, area, &format!("Reset {}", label(parameter).to_lowercase()))
                .hint(format!("Reset to {}", self.in_words(parameter, &value)));
            self.cx.on_click(&button, Command::Set { key: parameter.key, value, dragging: false });
        }
        row.inner
    }

    fn number_row(&mut self, ui: &mut Ui, parameter: &'static Parameter, value: &Value) {
        let explanation = self.explanation(parameter);
        // Usually the checkbox above says it already.
        let said =
            parameter.absent.is_some() && parameter.switch.to_lowercase().contains(&label(parameter).to_lowercase());
        let name = if said { None } else { Some(self.label_row(ui, parameter)) };
        ui.horizontal(|ui| {
            let others = field::number_width(ui) + self.units + 2.0 * ui.spacing().item_spacing.x;
            ui.spacing_mut().slider_width = (ui.available_width() - others).max(SHORTEST_SLIDER);
            // A parameter that has no effect here can be read, but not set.
            if !self.scene.heeds(parameter.key) {
                ui.disable();
            }
            let slider = self.slider(ui, parameter, value).hint_beside(ui, &explanation);
            match name {
                Some(name) => slider.labelled_by(name.id),
                None => slider.accessible_name(label(parameter)),
            };
            let field = Field { key: parameter.key, value: Some(value), name: &field_name(parameter), hint: "" };
            field.show(ui, self.cx).hint_beside(ui, &explanation);
            let unit = RichText::new(self.scene.unit(parameter)).color(self.cx.colours.quiet);
            ui.add(egui::Label::new(unit).selectable(false).extend());
        });
    }

    fn slider(&mut self, ui: &mut Ui, parameter: &'static Parameter, value: &Value) -> egui::Response {
        let present = value.as_number().unwrap_or_default();
        let (range, logarithmic) = slider_range(self.scene, parameter);
        let whole = matches!(parameter.kind, ParameterKind::Whole { .. });
        let mut moved = present;
        let slider = egui::Slider::new(&mut moved, range.min..=range.max)
            .logarithmic(logarithmic)
            .clamping(egui::SliderClamping::Never)
            .show_value(false)
            .trailing_fill(true);
        let slider = if whole { slider.integer() } else { slider };
        let response = ui.add(slider);
        let dragging = response.dragged();
        if response.changed() || response.drag_stopped() {
            let value = if moved == present {
                value.clone()
            } else if whole {
                // The ranges of whole numbers lie far inside those of i64.
                Value::Whole(moved.clamp(range.min, range.max).round() as i64)
            } else {
                Value::Number(inside(moved, range))
            };
            self.cx.push(Command::Set { key: parameter.key, value, dragging });
        }
        response
    }

    /// The checkbox that switches an optional parameter on and off.
    fn switch_row(&mut self, ui: &mut Ui, parameter: &'static Parameter, present: bool) {
        let mut on = present;
        let explanation = self.explanation(parameter);
        if ui.checkbox(&mut on, parameter.switch).hint_beside(ui, &explanation).changed() {
            self.cx.push(self.switched(parameter, on));
        }
        if let (false, Some(value)) = (present, self.scene.alternative(parameter)) {
            let now = format!("Now {} {}", significant(value, FOLLOWING_DIGITS), self.scene.unit(parameter));
            return quiet(ui, self.cx, now.trim_end());
        }
        // The note that unset numerics are left to the fidelity is not repeated for each of the four.
        if let (false, Some(meaning), true) = (present, parameter.absent, parameter.table() != "numerics") {
            quiet(ui, self.cx, &capitalised(meaning));
        }
    }

    /// The command of a checkbox. For a key that replaces another one, both values mean the same.
    fn switched(&self, parameter: &'static Parameter, on: bool) -> Command {
        let replaced = parameter.instead_of.and_then(Parameter::find);
        let Some(given) = Some(parameter).filter(|_| on).or(replaced) else { return Command::Reset(parameter.key) };
        let same = replaced.and_then(|_| self.scene.restated(given, self.solved_plate())).map(Value::Number);
        match same.or_else(|| given.usual()) {
            Some(value) => Command::Set { key: given.key, value, dragging: false },
            None => Command::Reset(parameter.key),
        }
    }

    /// Results for the plate, with the accuracy of the run on screen; `None` unless that is a converged run of the present scene.
    fn solved_plate(&self) -> Option<SolvedPlate> {
        let run = self.cx.state.run.as_ref().filter(|run| !self.cx.state.stale(run))?;
        if run.solution.status != Status::Converged {
            return None;
        }
        let plate = run.solution.outcome.plate()?;
        let mean_gap_um = plate.floating.map(|floating| floating.mean_gap.value * 1e6);
        Some(SolvedPlate { mean_gap_um, load_n: plate.film_load.value })
    }

    fn flag_row(&mut self, ui: &mut Ui, parameter: &'static Parameter, on: bool) {
        let explanation = self.explanation(parameter);
        self.beside_reset(ui, parameter, |ui| {
            let mut on = on;
            let heeded = self.scene.heeds(parameter.key);
            let checkbox = ui.add_enabled(heeded, egui::Checkbox::new(&mut on, label(parameter)));
            let set = Command::Set { key: parameter.key, value: Value::Flag(on), dragging: false };
            self.cx.on_change(&checkbox.hint_beside(ui, &explanation), set);
        });
    }

    fn choice_row(&mut self, ui: &mut Ui, parameter: &'static Parameter) {
        let named = self.label_row(ui, parameter);
        let width = ui.available_width();
        let list = choices(ui, parameter, width, self.cx).labelled_by(named.id);
        self.cx.lead_to(ui, parameter.key, list.id);
    }

    fn text_row(&mut self, ui: &mut Ui, parameter: &'static Parameter, value: &Value) {
        let name = label(parameter);
        let field = Field { key: parameter.key, value: Some(value), name, hint: name };
        field.show(ui, self.cx).hint_beside(ui, parameter.about);
    }

    fn path_row(&mut self, ui: &mut Ui, parameter: &'static Parameter) {
        let about = format!("{}\n{}", parameter.about, parameter.key);
        let name = ui.add(egui::Label::new(label(parameter)).wrap().selectable(false)).hint_beside(ui, &about);
        let field = Field { key: parameter.key, value: None, name: label(parameter), hint: "path, then Enter" };
        let columns = match parameter.key {
            "surface.heights_csv" => {
                "A grid of heights after lines # dx_um = …, # dy_um = … and # height = nm, or a profile with columns x_um and z_nm"
            }
            "rotor.green_csv" => "Columns x_mm and deflection_um_per_n",
            _ => "Columns wavenumber_per_m or harmonic, and compliance_m2_per_n",
        };
        ui.horizontal(|ui| {
            let (text, spacing) = ("Open…", ui.spacing());
            let button = text_width(ui, text) + 2.0 * spacing.button_padding.x + spacing.item_spacing.x;
            ui.scope(|ui| {
                ui.set_max_width((ui.available_width() - button).max(SHORTEST_SLIDER));
                field.show(ui, self.cx).labelled_by(name.id).hint_beside(ui, columns);
            });
            let open = ui.button(text).hint_beside(ui, columns).accessible_name(format!("Open: {}", label(parameter)));
            self.cx.on_click(&open, Command::Ask(Purpose::Csv(parameter.key)));
        });
    }

    fn rows_row(&mut self, ui: &mut Ui, parameter: &'static Parameter, rows: usize) {
        let explanation = self.explanation(parameter);
        ui.horizontal_wrapped(|ui| {
            ui.label(label(parameter)).hint_beside(ui, &explanation);
            ui.label(RichText::new(counted(rows, "row", "rows")).strong());
        });
        quiet(ui, self.cx, "To change the table, edit its file and open it again");
    }

    /// Notes below a parameter: why an edit is refused, and that it has no effect.
    fn footnotes(&self, ui: &mut Ui, parameter: &'static Parameter) {
        let rejected = self.cx.state.rejected.of(parameter.key);
        if let Some(message) = rejected.filter(|_| !records::tells(ui, parameter.key)) {
            let prefix = format!("{} = ", parameter.key);
            let text = message.strip_prefix(&prefix).unwrap_or(message);
            ui.add(egui::Label::new(RichText::new(text).color(self.cx.colours.alarm)).wrap());
            let kept = self.scene.get(parameter.key).map(|value| self.in_words(parameter, &value));
            if let (Some(kept), true) = (kept, parameter.range().is_some()) {
                let back =
                    if field::holds_text(ui, parameter.key) { "; Escape in the field brings it back" } else { "" };
                quiet(ui, self.cx, &format!("Still {kept}{back}"));
            }
        }
        if let Some(note) = words::unused(self.scene, parameter) {
            quiet(ui, self.cx, note);
        }
    }

    /// The default of a parameter that has one in this scene.
    fn default(&self, parameter: &Parameter) -> Option<Value> {
        let own = matches!(parameter.kind, ParameterKind::Text { .. } | ParameterKind::Rows { .. });
        if own { None } else { self.scene.default_of(parameter) }
    }

    /// Its value in the scene as it was opened or last saved; its default where it had none.
    fn original(&self, parameter: &Parameter) -> Option<Value> {
        let default = self.default(parameter)?;
        Some(self.cx.state.document.saved().get(parameter.key).unwrap_or(default))
    }

    fn explanation(&self, parameter: &Parameter) -> String {
        words::explanation(self.scene, parameter, self.default(parameter).as_ref())
    }

    fn in_words(&self, parameter: &Parameter, value: &Value) -> String {
        parameter.with_unit(words::shown(parameter.key, value))
    }
}

/// Whether the parameter is among the main ones. A plate has no minimum spacing.
fn is_main(scene: &Scene, parameter: &Parameter) -> bool {
    MAIN.contains(&parameter.key) && words::unused(scene, parameter).is_none()
}

/// A round arrow in `area`.
fn reset_button(ui: &Ui, area: egui::Rect, name: &str) -> egui::Response {
    let response = ui.interact(area, ui.scope_id().with("reset"), egui::Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, ui.is_enabled(), name));
    let visuals = ui.style().interact(&response);
    if response.has_focus() {
        ui.painter().rect_stroke(area, 3, visuals.fg_stroke, egui::StrokeKind::Inside);
    }
    let font = egui::FontId::proportional(TextStyle::Body.resolve(ui.style()).size);
    ui.painter().text(area.center(), egui::Align2::CENTER_CENTER, "↺", font, visuals.text_color());
    response
}

fn quiet(ui: &mut Ui, cx: &DrawContext<'_>, text: &str) {
    let size = NOTE_SIZE * TextStyle::Body.resolve(ui.style()).size;
    ui.add(egui::Label::new(RichText::new(text).size(size).color(cx.colours.quiet)).wrap().selectable(false));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_is_in_a_group() {
        for parameter in PARAMETERS {
            let grouped = GROUPS.iter().any(|(table, _, _)| *table == parameter.table());
            assert!(grouped || parameter.table().is_empty(), "{}", parameter.key);
        }
        assert!(MAIN.iter().all(|key| Parameter::find(key).is_some()));
    }
}
