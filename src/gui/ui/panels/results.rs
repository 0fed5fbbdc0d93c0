//! The right panel: the numbers of a run. Every text can be selected and copied.

use super::model;
use crate::analysis::exact::units;
use crate::analysis::quantity::{Numbers, Quantity, Quantity::*, force_unit};
use crate::analysis::regime;
use crate::analysis::validity::{ExceededLimit, beside_headline};
use crate::digits::{capitalised, percent, raised, significant};
use crate::dimensionless::Dimensionless;
use crate::estimate::Estimate;
use crate::export::figures::convergence;
use crate::export::json::beside_limit;
use crate::gui::derived::format::uncertain;
use crate::gui::ui::chart::Chart;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary::Explained;
use crate::gui::ui::hint::text_width;
use crate::gui::ui::parts::{joined, scrolled_anew};
use crate::job::SolvedScene;
use crate::problem::{Motor, Plate, Problem, Scenario};
use crate::solution::{MotorResult, Outcome, PlateResult, Status, StoppedBy};
use eframe::egui::{self, Color32, RichText, TextStyle};

/// Significant digits of numbers without an error of their own.
const DIGITS: usize = 4;
/// Size of the headline number relative to the text.
const HEADLINE: f32 = 2.1;
/// Size of its error relative to the text.
const HEADLINE_ERROR: f32 = 1.35;
/// Height of the chart of the rounds, in lines of text.
const ROUNDS: f32 = 9.0;

/// Shows the results of `run`, and the switches of its model.
pub fn show(ui: &mut egui::Ui, run: &SolvedScene, cx: &DrawContext<'_>) {
    scrolled_anew(ui, "results", cx.state.view.opened, 8.0, |ui| {
        ui.spacing_mut().item_spacing.y = 4.0;
        ui.add_space(8.0);
        convergence_banner(ui, run, cx);
        if let Some(words) = beside_headline(&run.validity) {
            cx.say(ui, capitalised(&words), cx.colours.contact);
        }
        let shown = RunNumbers { problem: &run.problem, numbers: Numbers::of(&run.problem, &run.solution) };
        match (&run.problem.scenario, &run.solution.outcome) {
            (Scenario::Motor(motor), Outcome::Motor(result)) => motor_numbers(ui, &shown, motor, result, cx),
            (Scenario::Plate(plate), Outcome::Plate(result)) => plate_numbers(ui, &shown, plate, result, cx),
            // A solver returns the kind of result that belongs to the scene.
            _ => {}
        }
        cx.warn(ui, &run.solution.warnings);
        limits(ui, &run.validity, cx);
        section(ui, "Regime");
        regime_numbers(ui, run, cx);
        ui.add_space(8.0);
        ui.separator();
        if !run.solution.model.decisions.is_empty() {
            let part = egui::CollapsingHeader::new(RichText::new("Model").strong())
                .default_open(true)
                .show_unindented(ui, |ui| model::show(ui, run, cx));
            part.header_response.explained(ui, "Model");
        }
        let part = egui::CollapsingHeader::new(RichText::new("How it was solved").strong())
            .default_open(true)
            .show_unindented(ui, |ui| how(ui, run, cx));
        part.header_response.explained(ui, "How it was solved");
        ui.add_space(12.0);
    });
}

fn motor_numbers(ui: &mut egui::Ui, shown: &RunNumbers<'_>, motor: &Motor, result: &MotorResult, cx: &DrawContext<'_>) {
    if result.levitated {
        banner(ui, cx.colours.film, "Levitated", "No tooth touches at any instant: the rotor floats on air");
    }
    let top = ui.next_widget_position();
    headline(ui, "α", "α", &shown.text(Alpha), "");
    let sucks = regime::sucks(result.alpha).then_some("the air sucks: contact carries more than the load");
    cx.note(ui, sucks.unwrap_or("share of the load carried by air"));
    shares(ui, result.alpha.value, cx);
    let headline = egui::Rect::from_min_max(top, ui.max_rect().right_bottom()).with_max_y(ui.min_rect().bottom());
    cx.name_part(ui, "headline", headline);
    ui.add_space(4.0);
    shown.row(ui, cx, "Film load", FilmLoad);
    shown.range(ui, cx, FilmLoadMin, FilmLoadMax);
    shown.row(ui, cx, "Contact load", ContactLoad);
    let teeth = format!("{} of {}", shown.text(TeethInContact), motor.teeth);
    number(ui, cx, "Teeth in contact, mean", &teeth, "");
    section(ui, "Torque of the ring");
    shown.row(ui, cx, "Stall torque", StallTorque);
    shown.row(ui, cx, "Maximum operating torque", MaxTorque);
    number(ui, cx, "Maximum without film", &significant(motor.friction_torque(motor.load), DIGITS), "N·m");
    shown.extremes(ui, cx, motor.gas.ambient_pressure);
}

fn plate_numbers(ui: &mut egui::Ui, shown: &RunNumbers<'_>, plate: &Plate, result: &PlateResult, cx: &DrawContext<'_>) {
    if let Some(floating) = result.floating {
        headline(ui, "", "Mean gap", &shown.text(MeanGap), "µm");
        cx.note(ui, "mean gap at which the film carries the load");
        ui.add_space(4.0);
        number(ui, cx, "Stiffness at this height", &uncertain(floating.stiffness), units(plate)[0]);
        number(ui, cx, "Natural frequency", &uncertain(floating.natural_frequency), "Hz");
        if let Some(slow) = floating.slow {
            let told = [
                ("Creep time constant", slow.creep_time.map(|time| time * 1e3), "ms"),
                ("Swing frequency", slow.swing_frequency, "Hz"),
                ("Swing time constant", slow.swing_decay.map(|time| time * 1e3), "ms"),
            ];
            for (name, found, unit) in told {
                if let Some(found) = found {
                    number(ui, cx, name, &uncertain(found), unit);
                }
            }
        }
        shown.row(ui, cx, "Film load, mean", FilmLoad);
    } else {
        headline(ui, "", "Film load", &shown.text(FilmLoad), force_unit(shown.problem));
        cx.note(ui, "mean load of the film over the cycle");
        ui.add_space(4.0);
    }
    shown.range(ui, cx, FilmLoadMin, FilmLoadMax);
    section(ui, if plate.is_strip() { "Load / (p_a · length)" } else { "Load / (p_a · area)" });
    shown.row(ui, cx, "Mean", LoadRatio);
    shown.range(ui, cx, LoadRatioMin, LoadRatioMax);
    shown.extremes(ui, cx, plate.gas.ambient_pressure);
}

/// The numbers of a run, each with its error.
struct RunNumbers<'a> {
    problem: &'a Problem,
    numbers: Numbers,
}

impl RunNumbers<'_> {
    fn text(&self, quantity: Quantity) -> String {
        self.numbers.estimate(quantity).map_or_else(String::new, uncertain)
    }

    /// A row, if the run has this number.
    fn row(&self, ui: &mut egui::Ui, cx: &DrawContext<'_>, name: &str, quantity: Quantity) {
        if let Some(found) = self.numbers.estimate(quantity) {
            number(ui, cx, name, &uncertain(found), quantity.unit(self.problem));
        }
    }

    fn range(&self, ui: &mut egui::Ui, cx: &DrawContext<'_>, least: Quantity, most: Quantity) {
        let ends = [least, most].map(|end| self.numbers.estimate(end).unwrap_or(Estimate::exact(f64::NAN)));
        number(ui, cx, "Over the cycle", &raised(&Estimate::range(ends)), least.unit(self.problem));
    }

    fn extremes(&self, ui: &mut egui::Ui, cx: &DrawContext<'_>, ambient: f64) {
        section(ui, "Extremes");
        self.row(ui, cx, "Least film thickness", MinGap);
        self.row(ui, cx, "Highest pressure", MaxPressure);
        let relative =
            self.numbers.get(MaxPressure).map_or_else(String::new, |kpa| significant(1e3 * kpa / ambient, 3));
        number(ui, cx, "Relative to ambient", &format!("{relative} ×"), "");
    }
}

/// Limits of the model that are exceeded; empty if none.
fn limits(ui: &mut egui::Ui, validity: &[ExceededLimit], cx: &DrawContext<'_>) {
    if validity.is_empty() {
        return;
    }
    section(ui, "Outside the limits of the model");
    for excess in validity {
        number(ui, cx, &capitalised(&excess.name.replace('-', " ")), &beside_limit(excess), "");
        ui.add(egui::Label::new(&excess.text).wrap());
        ui.add_space(2.0);
    }
}

fn regime_numbers(ui: &mut egui::Ui, run: &SolvedScene, cx: &DrawContext<'_>) {
    let numbers = &Dimensionless::of(&run.problem);
    let outcome = &run.solution.outcome;
    let weight = regime::weight(&run.problem, outcome);
    let rows = [
        ("Squeeze number σ", numbers.squeeze_number, vec![regime::squeeze(&run.problem, outcome), weight]),
        ("Bearing number Λ", numbers.bearing_number, vec![regime::bearing(numbers).to_owned()]),
        ("Knudsen number Kn", numbers.knudsen_number, vec![regime::knudsen(&run.problem, outcome)]),
    ];
    // A plate does not slide.
    for (name, value, phrases) in rows.into_iter().filter(|(_, value, _)| *value > 0.0) {
        number(ui, cx, name, &shown(value), "");
        phrases.iter().for_each(|phrase| cx.note(ui, phrase));
        ui.add_space(2.0);
    }
}

fn how(ui: &mut egui::Ui, run: &SolvedScene, cx: &DrawContext<'_>) {
    let stats = &run.solution.stats;
    number(ui, cx, "Fidelity", &run.fidelity.to_string(), "");
    match &run.solution.outcome {
        Outcome::Motor(result) => number(ui, cx, "Error of α", &significant(result.alpha.error, 2), ""),
        Outcome::Plate(result) => {
            number(ui, cx, "Error of the load", &significant(result.film_load.error, 2), force_unit(&run.problem));
        }
    }
    if run.solution.accuracy.stopped_by == StoppedBy::Budget {
        cx.note(ui, "The time allowed was up before the error was as small as asked for");
    }
    if stats.coupling_iterations > 0 {
        number(ui, cx, "Rounds of film and contact", &stats.coupling_iterations.to_string(), "");
        number(ui, cx, "Contact problems", &stats.contact_solves.to_string(), "");
    } else {
        number(ui, cx, "Rounds", &stats.cycles.to_string(), "");
    }
    number(ui, cx, "Film steps", &stats.film_steps.to_string(), "");
    number(ui, cx, "Film nodes, finest grid", &stats.film_nodes.to_string(), "");
    number(ui, cx, "Steps in a cycle", &stats.steps_per_cycle.to_string(), "");
    let (time, unit) = if run.wall_s < 1.0 { (run.wall_s * 1e3, "ms") } else { (run.wall_s, "s") };
    number(ui, cx, "Time", &significant(time, 3), unit);
    if stats.warm_start {
        cx.note(ui, "Warm start from the fields of the previous scene: the counts and the time depend on it, and the values do so within their errors");
    }
    if !run.history.is_empty() {
        ui.add_space(6.0);
        cx.note(ui, "Change that further rounds would make, one line for each grid; the dashed line is the limit below which the rounds end");
        let panel = &convergence(&run.history).panels[0];
        let height = ROUNDS * ui.text_style_height(&TextStyle::Body);
        let words = (Some("Rounds"), "Remaining change");
        Chart { name: "Remaining change by round", height, panel, words }.show(ui);
    }
    ui.add_space(4.0);
}

fn convergence_banner(ui: &mut egui::Ui, run: &SolvedScene, cx: &DrawContext<'_>) {
    let stale = cx.say_if_stale(ui, run);
    match &run.solution.status {
        Status::Converged if stale => {}
        Status::Converged => {
            // If the time limit ends the solve on a grid, that grid has not converged and is dropped.
            let last = run.history.iter().rev().find(|round| round.residual <= round.tolerance);
            let text = last.map_or_else(String::new, |last| {
                let [changed, allowed] = [last.residual, last.tolerance].map(|share| joined(&percent(share)));
                format!(": further rounds would change {changed}, allowed {allowed}")
            });
            let mut job = egui::text::LayoutJob::default();
            let font = TextStyle::Body.resolve(ui.style());
            job.append("✔ Converged", 0.0, egui::TextFormat::simple(font.clone(), cx.colours.good));
            job.append(&text, 0.0, egui::TextFormat::simple(font, cx.colours.quiet));
            ui.add(egui::Label::new(job).wrap()).explained(ui, "Converged");
            ui.add_space(2.0);
        }
        Status::NotConverged { residual, tolerance } => {
            let [changed, allowed] = [*residual, *tolerance].map(|share| joined(&percent(share)));
            let text = format!("Further rounds would still change it by {changed}, allowed {allowed}");
            banner(ui, cx.colours.alarm, "Not converged", &text);
        }
        Status::NotResolved { .. } => {
            banner(ui, cx.colours.alarm, "Not resolved", "The stated error is as large as the result itself");
        }
        Status::Cancelled => banner(ui, cx.colours.alarm, "Cancelled", "These are intermediate values, not the result"),
    }
}

/// A title and a sentence on a tinted ground.
fn banner(ui: &mut egui::Ui, colour: Color32, title: &str, text: &str) {
    let ground = ui.visuals().panel_fill.lerp_to_gamma(colour, 0.16);
    egui::Frame::new().fill(ground).corner_radius(4).inner_margin(egui::Margin::symmetric(8, 6)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.add(egui::Label::new(RichText::new(title).strong().color(colour)).wrap()).explained(ui, title);
        ui.add(egui::Label::new(text).wrap());
    });
    ui.add_space(6.0);
}

/// The main number, with its error in smaller type; all of it is smaller where it would not fit. The glossary explains it under `word`.
pub(super) fn headline(ui: &mut egui::Ui, symbol: &str, word: &str, value: &str, unit: &str) {
    let body = TextStyle::Body.resolve(ui.style()).size;
    // A power of ten applies to both value and error, so both have one size.
    let parts = value.split_once(" ± ").filter(|_| !value.starts_with('('));
    let (number, error) = parts.map_or((value, None), |(number, error)| (number, Some(error)));
    let (strong, weak) = (ui.visuals().strong_text_color(), ui.visuals().text_color());
    let mut pieces = vec![(number, HEADLINE, strong)];
    if !symbol.is_empty() {
        pieces.splice(0..0, [(symbol, HEADLINE, weak), ("  ", HEADLINE_ERROR, weak)]);
    }
    let behind = error.into_iter().flat_map(|error| [" ± ", error]);
    let unit = [" ", unit].into_iter().filter(|_| !unit.is_empty());
    pieces.extend(behind.chain(unit).map(|text| (text, HEADLINE_ERROR, weak)));
    let job = |scale: f32| {
        let mut job = egui::text::LayoutJob::default();
        for (text, size, color) in &pieces {
            let font_id = egui::FontId::proportional(size * body * scale);
            let format = egui::TextFormat { font_id, color: *color, valign: egui::Align::BOTTOM, ..Default::default() };
            job.append(text, 0.0, format);
        }
        job.wrap.max_width = f32::INFINITY;
        ui.painter().layout_job(job)
    };
    let mut galley = job(1.0);
    let room = ui.available_width();
    if galley.size().x > room {
        galley = job(room / galley.size().x * 0.98);
    }
    ui.add(egui::Label::new(galley)).explained(ui, word);
}

/// Air and contact as parts of one bar, and what the colours mean.
fn shares(ui: &mut egui::Ui, alpha: f64, cx: &DrawContext<'_>) {
    let height = 0.6 * ui.text_style_height(&TextStyle::Body);
    let (area, response) = ui.allocate_exact_size(egui::vec2(ui.available_width(), height), egui::Sense::hover());
    // Suction can make the share negative, and it can exceed 1 before the solve has converged; the bar shows 0 to 1.
    let share = if alpha.is_finite() { alpha.clamp(0.0, 1.0) as f32 } else { 0.0 };
    let painter = ui.painter().with_clip_rect(area.intersect(ui.clip_rect()));
    painter.rect_filled(area, 3, cx.colours.contact);
    let air = egui::Rect::from_min_max(area.min, egui::pos2(area.left() + share * area.width(), area.bottom()));
    let corners = if share < 1.0 { egui::CornerRadius { nw: 3, sw: 3, ne: 0, se: 0 } } else { 3.into() };
    painter.rect_filled(air, corners, cx.colours.film);
    response.explained(ui, "α");
    // Adding 0 turns −0 into 0.
    let percent = |share: f64| format!("{:.1} %", (1000.0 * share).round() / 10.0 + 0.0);
    let (air, contact) = (format!("air {}", percent(alpha)), format!("contact {}", percent(1.0 - alpha)));
    let both = text_width(ui, &air) + text_width(ui, &contact) + 2.0 * height + 5.0 * ui.spacing().item_spacing.x;
    let legends = |ui: &mut egui::Ui| {
        legend(ui, cx.colours.film, &air);
        legend(ui, cx.colours.contact, &contact);
    };
    if both < ui.available_width() {
        ui.horizontal(legends);
    } else {
        legends(ui);
    }
}

fn legend(ui: &mut egui::Ui, colour: Color32, text: &str) {
    let side = 0.6 * ui.text_style_height(&TextStyle::Body);
    // Swatch and text stay on one line.
    ui.horizontal(|ui| {
        let (area, _) = ui.allocate_exact_size(egui::vec2(side, side), egui::Sense::hover());
        ui.painter().rect_filled(area, 2, colour);
        ui.add(egui::Label::new(text).extend()).explained(ui, text.split(' ').next().unwrap_or_default());
    });
}

pub(super) fn section(ui: &mut egui::Ui, title: &str) {
    ui.add_space(8.0);
    ui.add(egui::Label::new(RichText::new(title).strong()).wrap()).explained(ui, title);
}

/// A name at the left, its value and unit at the right; below each other where they do not fit side by side.
pub(super) fn number(ui: &mut egui::Ui, cx: &DrawContext<'_>, name: &str, value: &str, unit: &str) {
    let value = if unit.is_empty() { value.to_owned() } else { format!("{value} {unit}") };
    let (term, gap) = (name, 2.0 * ui.spacing().item_spacing.x);
    let fits = text_width(ui, name) + text_width(ui, &value) + gap < ui.available_width();
    let name = egui::Label::new(RichText::new(name).color(cx.colours.quiet));
    // Two values are broken only between them: each stays with its error and unit.
    let value = if fits { value } else { joined(&value).replace("\u{a0}…\u{a0}", " … ") };
    let value = egui::Label::new(RichText::new(value).color(ui.visuals().strong_text_color()));
    let right = egui::Layout::right_to_left(egui::Align::Center);
    if fits {
        ui.horizontal(|ui| {
            ui.add(name.extend()).explained(ui, term);
            ui.with_layout(right, |ui| ui.add(value.extend()));
        });
    } else {
        ui.add(name.wrap()).explained(ui, term);
        ui.horizontal(|ui| ui.with_layout(right, |ui| ui.add(value.wrap())));
    }
}

pub(super) fn shown(value: f64) -> String {
    significant(value, DIGITS)
}
