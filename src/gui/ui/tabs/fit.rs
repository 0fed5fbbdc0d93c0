//! Keys chosen to agree with measurements, or for the optimum of a number: the table, what is asked for, and what was found.

use crate::analysis::fit::{Bound, FLAT, Fitted, FittedUnknown, Measured, Optimum};
use crate::analysis::quantity::Quantity;
use crate::digits::{percent, signed, significant, with_error};
use crate::gui::command::FitCommand;
use crate::gui::derived::scales::span;
use crate::gui::derived::words::label;
use crate::gui::state::fit::{FitState, Found, Sought, chooses, quantities};
use crate::gui::state::sweep::AxisForm;
use crate::gui::ui::button;
use crate::gui::ui::chart::{SOLID, axes, chart, dots, framed, legend, level, line, place, title};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary;
use crate::gui::ui::hint::{Hint, beside};
use crate::gui::ui::panels::menu::{FIT, export_button};
use crate::problem::Problem;
use crate::scene::Parameter;
use eframe::egui::accesskit::Role;
use eframe::egui::{ComboBox, Grid, RichText, ScrollArea, TextEdit, TextStyle, Ui, Vec2b, WidgetInfo};

/// Height of a chart: its share of the tab, and at least this many lines of text.
const SHARE: f32 = 0.3;
const LEAST_LINES: f32 = 9.0;
/// Radius of a point.
const RADIUS: f32 = 3.5;
/// Rows that are listed: all are in the files of the command line.
const LISTED: usize = 200;

/// Shows the tab.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let height = ui.available_height();
    let state = &cx.state.fit;
    // Fields and boxes get an outline: in the light theme their fill is nearly that of the panel.
    let visuals = ui.visuals_mut();
    visuals.widgets.inactive.bg_stroke = visuals.widgets.noninteractive.bg_stroke;
    ScrollArea::vertical().id_salt("fit").auto_shrink(false).show(ui, |ui| {
        // Room for the scroll bar, which floats.
        ui.set_max_width(ui.available_width() - 8.0);
        sought(ui, state, cx);
        let agreement = state.sought().0 == Sought::Agreement;
        if agreement {
            table(ui, state, cx);
        }
        if state.measured().is_some() || !agreement {
            for (i, axis) in state.form().iter().enumerate() {
                ui.push_id(i, |ui| {
                    ui.horizontal_wrapped(|ui| key(ui, i, axis, cx));
                    if let Some(fault) = state.faults().get(i).and_then(Option::as_ref) {
                        cx.say(ui, fault, cx.colours.alarm);
                    }
                });
            }
            buttons(ui, state, cx);
        } else {
            introduction(ui, cx);
        }
        if let Some((scene, found)) = state.found() {
            ui.add_space(6.0);
            let height = (SHARE * height).max(LEAST_LINES * ui.text_style_height(&TextStyle::Body));
            if state.stale(cx.state.document.scene()) {
                let text = format!("Fitted to “{}” before the scene changed; fit again", scene.name);
                cx.say(ui, text, cx.colours.alarm);
            }
            match &**found {
                Found::Fit(measured, fitted) => result(ui, measured, fitted, height, cx),
                Found::Optimum(found) => optimum(ui, found, height, cx),
            }
        }
        ui.add_space(8.0);
    });
}

/// What is looked for: agreement with measurements, or the optimum of a number, within limits on others.
fn sought(ui: &mut Ui, state: &FitState, cx: &DrawContext<'_>) {
    const KINDS: [(Sought, &str); 3] = [
        (Sought::Agreement, "agreement with measurements"),
        (Sought::Greatest, "the greatest value of"),
        (Sought::Least, "the least value of"),
    ];
    let em = ui.text_style_height(&TextStyle::Body);
    let (sought, name, limits) = state.sought();
    ui.horizontal_wrapped(|ui| {
        ui.label("Look for");
        let chosen = KINDS.iter().find(|(kind, _)| *kind == sought).map_or("", |(_, words)| *words);
        let combo = ComboBox::from_id_salt("sought").selected_text(chosen).width(13.0 * em).show_ui(ui, |ui| {
            for (kind, words) in KINDS {
                if ui.selectable_label(kind == sought, words).clicked() {
                    cx.push(FitCommand::Seek(kind));
                }
            }
        });
        combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "What is looked for"));
        combo.response.hint("Values that agree best with measurements, or at which a result is as large or as small as it can be");
        if sought == Sought::Agreement {
            return;
        }
        let known = quantities(cx.state.document.scene());
        let words = known.iter().find(|(other, _)| Some(*other) == name).map_or("", |(_, words)| words.as_str());
        let combo = ComboBox::from_id_salt("quantity").selected_text(words).width(13.0 * em).height(24.0 * em);
        let combo = combo.show_ui(ui, |ui| {
            for (other, words) in &known {
                if ui.selectable_label(Some(*other) == name, words).clicked() {
                    cx.push(FitCommand::Quantity(other));
                }
            }
        });
        combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Number that is sought"));
        combo.response.hint("The result whose optimum is sought");
        ui.label("with");
        let mut limits = limits.to_owned();
        let field = TextEdit::singleline(&mut limits).desired_width(13.0 * em).hint_text("no limits");
        let field = ui.add(field);
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "Limits on other results"));
        let about = "Limits on other results, divided by commas: alpha<0.3, stall_torque_nm>0.2. Their names are those of the columns that are exported";
        if field.hint(about).changed() {
            cx.push(FitCommand::Limits(limits));
        }
    });
    if let (Some(fault), true) = (state.goal_fault(), sought != Sought::Agreement) {
        cx.say(ui, fault, cx.colours.alarm);
    }
}

/// Which table.
fn table(ui: &mut Ui, state: &FitState, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        if ui.button("Open measurements…").hint("A CSV file; or drop one on the window").clicked() {
            cx.push(FitCommand::Choose);
        }
        if let Some(measured) = state.measured() {
            if ui.button("Forget them").hint("The table is no longer drawn, nor fitted").clicked() {
                cx.push(FitCommand::Forget);
            }
            let name = measured.name.rsplit(['/', '\\']).next().unwrap_or_default();
            let conditions = if measured.conditions.len() == 1 { "condition" } else { "conditions" };
            ui.label(format!(
                "{name}: {} measurements under {} {conditions}",
                measured.measurements.len(),
                measured.conditions.len()
            ));
        }
    });
}

fn introduction(ui: &mut Ui, cx: &DrawContext<'_>) {
    ui.add_space(8.0);
    for text in [
        "Which values of some parameters agree best with what was measured, and how sure are they?",
        "The first line of the table names its columns: keys of the scene, as film.min_spacing_nm, for the conditions of each line; \
         numbers of a solve, as film_load_n, or rotor_speed_rpm with torque_nm, for what was measured; and the same with _error behind \
         them for standard errors, if they are known.",
        "Nothing is solved before you ask.",
    ] {
        cx.note(ui, text);
        ui.add_space(4.0);
    }
}

/// One key with its bounds.
fn key(ui: &mut Ui, i: usize, axis: &AxisForm, cx: &DrawContext<'_>) {
    let em = ui.text_style_height(&TextStyle::Body);
    let scene = cx.state.document.scene();
    ui.label(if i == 0 { "Choose" } else { "and" });
    let parameter = Parameter::find(axis.key);
    let chosen = parameter.map_or(axis.key, label);
    let combo =
        ComboBox::from_id_salt("key").selected_text(chosen).width(11.0 * em).height(24.0 * em).show_ui(ui, |ui| {
            for parameter in scene.parameters().filter(|parameter| chooses(scene, parameter)) {
                let entry = ui.selectable_label(parameter.key == axis.key, label(parameter));
                if beside(ui.clip_rect(), entry, parameter.about).clicked() {
                    cx.push(FitCommand::Key(i, parameter.key));
                }
            }
        });
    combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, format!("Parameter {}", i + 1)));
    combo.response.hint(format!("What is chosen. {}", parameter.map_or("", |parameter| parameter.about)));
    let field = |ui: &mut Ui, name: &str, text: &str, send: fn(usize, String) -> FitCommand| {
        let mut text = text.to_owned();
        let response = ui.add(TextEdit::singleline(&mut text).desired_width(4.0 * em));
        response
            .widget_info(|| WidgetInfo::labeled(Role::TextInput, true, format!("{name} bound of parameter {}", i + 1)));
        if response.hint(format!("{name} bound: it is not chosen beyond it")).changed() {
            cx.push(send(i, text));
        }
    };
    ui.label("from");
    field(ui, "Lower", &axis.from, FitCommand::From);
    ui.label("to");
    field(ui, "Upper", &axis.to, FitCommand::To);
    if let Some(unit) = parameter.map(|parameter| parameter.unit).filter(|unit| !unit.is_empty()) {
        ui.label(RichText::new(unit).color(cx.colours.quiet));
    }
    let mut log = axis.log;
    let checkbox = ui.checkbox(&mut log, "log").hint("Searched by equal ratios instead of equal steps");
    if checkbox.accessible_name(format!("Equal ratios of parameter {}", i + 1)).changed() {
        cx.push(FitCommand::Log(i, log));
    }
    if cx.state.fit.form().len() > 1 {
        let less = ui.small_button("✕").hint("Leaves it as it is in the scene");
        if less.accessible_name(format!("Do not choose parameter {}", i + 1)).clicked() {
            cx.push(FitCommand::Remove(i));
        }
    }
}

fn buttons(ui: &mut Ui, state: &FitState, cx: &DrawContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        if state.running() {
            if ui.button("Cancel the fit").hint("Ends it; nothing comes of it").clicked() {
                cx.push(FitCommand::Cancel);
            }
            ui.spinner();
            let told = state.told().map_or_else(
                || "Solving the starts…".to_owned(),
                |(points, best)| {
                    let what = if state.sought().0 == Sought::Agreement { "χ²" } else { "best" };
                    format!("{points} points tried, {what} {}", significant(best, 3))
                },
            );
            ui.label(told);
            return;
        }
        let agreement = state.sought().0 == Sought::Agreement;
        let good = state.faults().iter().all(Option::is_none) && !state.form().is_empty();
        let good = good && (agreement || state.goal_fault().is_none());
        let about = "Searches on all cores; the window stays usable, and the scene as it is";
        let text = if agreement { "Fit the scene" } else { "Find the optimum" };
        if button::first(ui, text, (state.found().is_none(), good), cx).hint(about).clicked() {
            cx.push(FitCommand::Start);
        }
        if state.has_room() && ui.button("Add a key…").hint("One more parameter to choose").clicked() {
            cx.push(FitCommand::Add);
        }
    });
    if let Some(failure) = state.failure() {
        cx.say(ui, failure, cx.colours.alarm);
    } else if state.cancelled() {
        cx.note(ui, if state.running() { "Ending…" } else { "Cancelled" });
    }
}

/// What was found.
fn result(ui: &mut Ui, measured: &Measured, found: &Fitted, height: f32, cx: &DrawContext<'_>) {
    for warning in &found.warnings {
        cx.say(ui, warning, cx.colours.alarm);
    }
    Grid::new("values").num_columns(3).striped(true).spacing([10.0, 4.0]).show(ui, |ui| {
        for one in &found.unknowns {
            value(ui, one, cx);
            ui.end_row();
        }
    });
    take(ui, cx);
    let how = match (found.errors_known, found.error_scale) {
        (true, _) => format!(
            "χ² = {} with {} degrees of freedom, from the errors in the table.",
            significant(found.chi_squared, 3),
            found.degrees_of_freedom
        ),
        (false, Some(_)) => "The table has no errors: they are taken from the residuals.".to_owned(),
        (false, None) => "The table has no errors, and no measurement is left to tell them from.".to_owned(),
    };
    cx.note(ui, how);
    ui.add_space(4.0);
    charts(ui, measured, found, height, cx);
    rows(ui, measured, found, cx);
}

/// What is done with the values that were found.
fn take(ui: &mut Ui, cx: &DrawContext<'_>) {
    ui.horizontal(|ui| {
        let about = "Gives the scene these values: one edit, which can be undone";
        if ui.button("Take these values").hint(about).clicked() {
            cx.push(FitCommand::Take);
        }
        export_button(ui, FIT, cx);
    });
}

/// The optimum that was found.
fn optimum(ui: &mut Ui, found: &Optimum, height: f32, cx: &DrawContext<'_>) {
    for warning in &found.warnings {
        cx.say(ui, warning, cx.colours.alarm);
    }
    let Ok(problem) = Problem::try_from(&found.scene) else { return };
    let strong = ui.visuals().strong_text_color();
    let words = |quantity: Quantity| quantity.label(&problem);
    Grid::new("optimum").num_columns(3).striped(true).spacing([10.0, 4.0]).show(ui, |ui| {
        let row = |ui: &mut Ui, name: &str, about: &str, value: String, beside: String| {
            ui.label(RichText::new(name).color(cx.colours.quiet)).hint(about);
            ui.label(RichText::new(value).color(strong));
            ui.label(beside);
            ui.end_row();
        };
        let before = found.before.map_or_else(
            || "cannot be solved as the scene was".to_owned(),
            |before| format!("{} as the scene was", with_error(before.value, before.error)),
        );
        let value = with_error(found.value.value, found.value.error);
        row(ui, &words(found.goal.quantity), "The result that is sought, with its numerical error", value, before);
        for ((limit, quantity), reached) in found.goal.limits.iter().zip(&found.limited) {
            let value = with_error(reached.value, reached.error);
            row(ui, &words(*quantity), "A result that is limited", value, format!("allowed: {limit}"));
        }
        for scan in &found.lines {
            let parameter = scan.unknown.parameter;
            let at = match scan.at {
                Some(Bound::Lower) => "at its lower bound; ",
                Some(Bound::Upper) => "at its upper bound; ",
                None => "",
            };
            let (from, to) = scan.flat;
            let flat = format!("{at}within {} from {} to {}", percent(FLAT), significant(from, 3), significant(to, 3));
            let value = format!("{} {}", significant(scan.value, 4), parameter.unit);
            row(ui, label(parameter), parameter.about, value, flat);
        }
    });
    take(ui, cx);
    ui.add_space(4.0);
    let unit = words(found.goal.quantity);
    for scan in &found.lines {
        let parameter = scan.unknown.parameter;
        let name = format!("{unit} over {}", label(parameter));
        let points: Vec<[f64; 2]> = scan.points.iter().filter_map(|(x, y)| Some([*x, (*y)?])).collect();
        let [low, high] = span(points.iter().map(|point| point[1]).chain([found.value.value]));
        let [left, right] = span(points.iter().map(|point| point[0]));
        let margin = 0.08 * (high - low).max(1e-12);
        title(ui, &name, "Line through the optimum");
        let whole = place(ui, 0.7 * height);
        let below = format!("{}, {}", label(parameter), parameter.unit);
        let plot = chart(ui, &name, 0.7 * height).x_axis_label(below.trim_end_matches([',', ' ']).to_owned());
        let (film, contact, at) = (cx.colours.film, cx.colours.contact, vec![[scan.value, found.value.value]]);
        let bounds = [[left, right], [low - margin, high + margin]];
        let shown = framed(ui, (&name, plot), bounds, move |plot| {
            plot.line(line(&points, film, 2.0, SOLID));
            plot.points(dots(at, contact, RADIUS));
        });
        shown.response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
        axes(ui, whole, *shown.transform.frame(), None, "Line through the optimum");
    }
}

fn value(ui: &mut Ui, one: &FittedUnknown, cx: &DrawContext<'_>) {
    let parameter = one.unknown.parameter;
    let name = ui.label(RichText::new(label(parameter)).color(cx.colours.quiet));
    name.hint(parameter.about);
    let text = match one.error {
        Some(error) => with_error(one.value, error),
        None => significant(one.value, 5),
    };
    let text = ui.label(RichText::new(format!("{text} {}", parameter.unit)).color(ui.visuals().strong_text_color()));
    glossary::here(ui, text, "Standard error");
    ui.label(match one.at {
        Some(Bound::Lower) => "at its lower bound",
        Some(Bound::Upper) => "at its upper bound",
        None => "",
    });
}

/// Measured over computed, both as shares of the largest of their kind, and residuals row by row.
fn charts(ui: &mut Ui, measured: &Measured, found: &Fitted, height: f32, cx: &DrawContext<'_>) {
    let largest = |name: &str| {
        let alike = measured.measurements.iter().filter(|one| one.what.name() == name);
        alike.map(|one| one.value.abs()).fold(0.0, f64::max).max(f64::MIN_POSITIVE)
    };
    let points: Vec<[f64; 2]> = measured
        .measurements
        .iter()
        .zip(&found.rows)
        .filter_map(|(one, row)| {
            let unit = largest(one.what.name());
            Some([row.computed.as_ref().ok()?.value / unit, one.value / unit])
        })
        .collect();
    let ends =
        points.iter().flatten().fold([0.0_f64, 1.0_f64], |[low, high], end| [low.min(*end), high.max(1.05 * end)]);
    legend(ui, &[("measured", cx.colours.contact, SOLID), ("as computed", cx.colours.quiet, SOLID)]);
    title(ui, "Measured over computed", "Measured over computed");
    let (whole, name) = (place(ui, height), "Measured over computed");
    let plot = chart(ui, name, height).show_axes(Vec2b::TRUE).x_axis_label("computed, a share of the largest measured");
    let (contact, quiet) = (cx.colours.contact, cx.colours.quiet);
    let shown = framed(ui, (name, plot), [ends, ends], move |plot| {
        plot.line(line(&[[ends[0], ends[0]], [ends[1], ends[1]]], quiet, 1.0, SOLID));
        plot.points(dots(points, contact, RADIUS));
    });
    shown.response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
    axes(ui, whole, *shown.transform.frame(), Some(name), name);
    let residuals: Vec<[f64; 2]> =
        (1..).zip(&found.rows).filter_map(|(i, row): (u32, _)| Some([f64::from(i), row.residual?])).collect();
    let widest = residuals.iter().fold(2.0, |widest: f64, one| widest.max(1.1 * one[1].abs()));
    title(ui, "Residuals, in standard errors", "Residual");
    let (whole, name, last) = (place(ui, 0.7 * height), "Residuals", found.rows.len() as f64 + 0.5);
    let plot = chart(ui, name, 0.7 * height).show_axes(Vec2b::TRUE).x_axis_label("measurement");
    let shown = framed(ui, (name, plot), [[0.5, last], [-widest, widest]], move |plot| {
        for at in [-1.0, 0.0, 1.0] {
            plot.hline(level(at, quiet, 1.0));
        }
        plot.points(dots(residuals, contact, RADIUS));
    });
    shown.response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
    axes(ui, whole, *shown.transform.frame(), Some("Residual"), "Residual");
}

/// The measurements beside what is computed.
fn rows(ui: &mut Ui, measured: &Measured, found: &Fitted, cx: &DrawContext<'_>) {
    ui.add_space(4.0);
    ScrollArea::horizontal().id_salt("rows").auto_shrink(true).show(ui, |ui| {
        Grid::new("measurements").num_columns(4).striped(true).spacing([10.0, 4.0]).show(ui, |ui| {
            for head in ["", "Measured", "Computed", "Residual"] {
                let head = (ui.label(RichText::new(head).color(cx.colours.quiet)), head);
                if !head.1.is_empty() {
                    glossary::here(ui, head.0, head.1);
                }
            }
            ui.end_row();
            for (one, row) in measured.measurements.iter().zip(&found.rows).take(LISTED) {
                ui.label(RichText::new(format!("{}, {}", one.label, one.what.name())).color(cx.colours.quiet));
                ui.label(significant(one.value, 4));
                drop(match &row.computed {
                    Ok(computed) => ui.label(with_error(computed.value, computed.error)),
                    Err(why) => ui.label(RichText::new(why).color(cx.colours.alarm)),
                });
                ui.label(
                    row.residual.map_or_else(|| "left out".to_owned(), |residual| signed(format!("{residual:.2}"))),
                );
                ui.end_row();
            }
        });
    });
    if found.rows.len() > LISTED {
        cx.note(ui, format!("and {} more", found.rows.len() - LISTED));
    }
}
