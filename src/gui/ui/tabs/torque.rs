//! Torque, power and efficiency of a motor over the speed of its rotor, with the film and without it, and the numbers that a designer takes
//! from them.

use crate::analysis::torque::TorqueCurves;
use crate::digits::{as_given, significant};
use crate::estimate::Estimate;
use crate::export::figure::{Axis, Colour, Dash, Layer, Line, Mark, Marker, Panel, Points, Style};
use crate::gui::derived::format::uncertain;
use crate::gui::ui::chart::{Chart, legend, title};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary::{self, Explained};
use crate::gui::ui::parts::{self, BESIDE_CHARTS, scrolled};
use crate::gui::ui::theme::ACCENT;
use crate::job::SolvedScene;
use crate::problem::{Motor, Scenario};
use crate::solution::{OperatingPoint, Performance};
use eframe::egui::{self, RichText, TextStyle, Vec2b};

/// Heights of the charts: shares of the tab, and at least this many lines of text.
const SHARES: [f32; 3] = [0.29, 0.2, 0.2];
const LEAST_LINES: [f32; 3] = [9.0, 8.0, 6.0];
/// In a tab wider than this, in heights of the text, power and efficiency stand beside each other.
const BESIDE: f32 = 36.0;
/// In a tab narrower than this, in heights of the text, the columns of the table are closer, and the names are limited to the second width.
const NARROW: [f32; 2] = [30.0, 7.5];
/// Room between the columns of the table, in a narrow tab and in others \[points\].
const GAPS: [f32; 2] = [4.0, 10.0];
/// Top of the efficiency's axis, a little above 100 %.
const ALL: f64 = 104.0;
/// Room above the highest curve.
const HEADROOM: f64 = 1.08;
/// Significant digits of numbers without an error.
const DIGITS: usize = 4;
/// Titles of the charts, and their glossary terms.
const CHARTS: [(&str, &str); 3] =
    [("Torque of the ring, N·m", "Torque over speed"), ("Power, W", "Power"), ("Efficiency, %", "Efficiency")];

/// Shows the tab.
pub fn show(ui: &mut egui::Ui, run: &SolvedScene, cx: &DrawContext<'_>) {
    let of = cx.state.torque.found_of().map_or(run, AsRef::as_ref);
    let Scenario::Motor(motor) = &of.problem.scenario else { return };
    let height = ui.available_height();
    scrolled(ui, "torque", BESIDE_CHARTS, |ui| {
        cx.say_if_stale(ui, of);
        match cx.state.torque.found() {
            None => drop(ui.label("Solving the contact without film…")),
            Some(Err(why)) => cx.alarm(ui, [format!("There are no curves to show: {why}")]),
            Some(Ok(merit)) => found(ui, motor, merit, height, cx),
        }
    });
}

fn found(ui: &mut egui::Ui, motor: &Motor, merit: &TorqueCurves, height: f32, cx: &DrawContext<'_>) {
    if merit.stator_speed <= 0.0 {
        let text = "The stator does not move along the ring (its tangential amplitude is 0): it drives nothing.";
        return cx.note(ui, text);
    }
    let (measured, elsewhere) = cx.state.torques();
    let panels = panels(merit, measured);
    legend(ui, &[&panels[1], &panels[0]]);
    let em = ui.text_style_height(&TextStyle::Body);
    let mut pointed = None;
    let mut one = |ui: &mut egui::Ui, i: usize, bottom: bool| {
        let (name, word) = CHARTS[i];
        title(ui, name, word);
        let mut panel = panels[i].clone();
        if !bottom {
            (panel.x.label, panel.x.unit) = Default::default();
        }
        let height = (SHARES[i] * height).max(LEAST_LINES[i] * em);
        let chart = Chart { name, height, panel: &panel, words: (Some("Rotor speed"), word) };
        let linked = egui::Id::unique("torque charts");
        let at = chart.show_with(ui, |plot| plot.link_cursor(linked, Vec2b::new(true, false)).show_x(true));
        pointed = at.filter(|x| (0.0..=merit.rpm(merit.stator_speed)).contains(x)).or(pointed);
    };
    let side_by_side = ui.available_width() > BESIDE * em;
    let first = ui.scope(|ui| one(ui, 0, side_by_side));
    cx.name_part(ui, "torque", first.response.rect);
    if side_by_side {
        ui.columns(2, |columns| (1..3).for_each(|i| one(&mut columns[i - 1], i, true)));
    } else {
        (1..3).for_each(|i| one(ui, i, i == 2));
    }
    readout(ui, merit, pointed, cx);
    if elsewhere > 0 {
        cx.note(ui, format!("{elsewhere} measured torques are not drawn: they were measured on another scene."));
    }
    ui.add_space(6.0);
    table(ui, motor, merit, cx);
    ui.add_space(6.0);
    notes(ui, motor, merit, cx);
    ui.add_space(8.0);
}

/// Charts of torque, power and efficiency over the speed; the first one shows the `measured` torques, too.
fn panels(merit: &TorqueCurves, measured: Vec<[f64; 2]>) -> [Panel; 3] {
    type Value = fn(&OperatingPoint) -> f64;
    let (torque, output): (Value, Value) = (|point| point.torque.value, |point| point.output.value);
    let friction: Value = |point| point.friction.value;
    let efficiency: Value = |point| point.efficiency.map_or(f64::NAN, |share| 100.0 * share.value);
    let present = merit.rpm(merit.with_film.present.speed);
    let panel = |top: Option<f64>, values: &[Value], mut layers: Vec<Layer>| {
        let curve = |name: &str, of: &Performance, value: Value, style: Style| {
            let points = of.curve.iter().map(|point| [merit.rpm(point.speed), value(point)]);
            Layer::Line(Line::new(name, points, style))
        };
        let dashed = Style::solid(Colour::CONTACT).dash(Dash::Dashed);
        layers.extend([
            curve("without film", &merit.without_film, values[0], dashed),
            curve("with film", &merit.with_film, values[0], Style::solid(Colour::FILM)),
        ]);
        let heat = Style::solid(Colour::ROTOR).dash(Dash::DashDot);
        layers.extend(values.get(1).map(|value| curve("friction heat, with film", &merit.with_film, *value, heat)));
        let fastest = merit.rpm(merit.stator_speed);
        if (0.0..=fastest).contains(&present) {
            layers.push(
                Mark { style: Style::solid(ACCENT), ..Mark::vertical(present, "rotor speed of the scene") }.into(),
            );
        }
        let drawn = layers.iter().flat_map(|layer| match layer {
            Layer::Line(line) => line.points.as_slice(),
            Layer::Points(points) => points.points.as_slice(),
            _ => &[],
        });
        // Where the rotor is braked, values are below the axis.
        let greatest = drawn.map(|point| point[1]).fold(0.0, f64::max);
        let top = top.unwrap_or(if greatest > 0.0 { HEADROOM * greatest } else { 1.0 });
        let x = Axis::new("speed of the rotor", "rpm").fixed(0.0, fastest);
        Panel { layers, ..Panel::new("", x, Axis::new("", "").fixed(0.0, top)) }
    };
    let measured = (!measured.is_empty()).then(|| Points::new("measured", measured, Colour::STATOR, Marker::default()));
    [
        panel(None, &[torque], measured.into_iter().map(Layer::from).collect()),
        panel(None, &[output, friction], Vec::new()),
        panel(Some(ALL), &[efficiency], Vec::new()),
    ]
}

/// The values at the speed under the pointer.
fn readout(ui: &mut egui::Ui, merit: &TorqueCurves, pointed: Option<f64>, cx: &DrawContext<'_>) {
    let Some(speed) = pointed else { return cx.note(ui, "Point at a chart to read its values") };
    let at = |of: &Performance| {
        let next = of.curve.partition_point(|point| merit.rpm(point.speed) < speed).clamp(1, of.curve.len().max(2) - 1);
        let (a, b) = (of.curve.get(next - 1)?, of.curve.get(next)?);
        let [low, high] = [a, b].map(|point| merit.rpm(point.speed));
        let part = if high > low { (speed - low) / (high - low) } else { 0.0 };
        let mix = |a: f64, b: f64| a + part * (b - a);
        let percent = a.efficiency.zip(b.efficiency).map(|(a, b)| 100.0 * mix(a.value, b.value));
        let percent = percent.map_or_else(String::new, |share| format!(", {} %", significant(share, DIGITS)));
        let (torque, output) = (mix(a.torque.value, b.torque.value), mix(a.output.value, b.output.value));
        Some(format!("{} N·m, {} W{percent}", significant(torque, DIGITS), significant(output, DIGITS)))
    };
    let (Some(with), Some(without)) = (at(&merit.with_film), at(&merit.without_film)) else { return };
    let text = format!("{} rpm: with film {with}; without {without}", significant(speed, DIGITS));
    ui.add(egui::Label::new(text).wrap());
}

/// The numbers, with the film and without it.
fn table(ui: &mut egui::Ui, motor: &Motor, merit: &TorqueCurves, cx: &DrawContext<'_>) {
    let (with, without) = (&merit.with_film, &merit.without_film);
    let speed = |found: Option<Estimate>| stated(found, merit.rpm(1.0), "rpm");
    let present = format!("Torque at {} rpm", as_given(merit.rpm(motor.rotor_speed)));
    let both = |value: &dyn Fn(&Performance) -> String| [with, without].map(value);
    // The name in this table, the values, and the glossary term.
    let rows = [
        ("Stall torque", both(&|of| stated(Some(of.stall_torque), 1.0, "N·m")), "Stall torque"),
        ("Maximum operating torque", both(&|of| stated(Some(of.max_torque), 1.0, "N·m")), "Maximum operating torque"),
        ("No-load speed", both(&|of| speed(of.no_load_speed)), "No-load speed"),
        ("Greatest power", both(&|of| stated(Some(of.max_power), 1.0, "W")), "Greatest power"),
        ("    at", both(&|of| speed(of.max_power_speed)), "Greatest power"),
        ("Greatest efficiency", both(&|of| stated(of.max_efficiency, 100.0, "%")), "Efficiency"),
        ("    at", both(&|of| speed(of.max_efficiency_speed)), "Efficiency"),
        (&present, both(&|of| stated(Some(of.present.torque), 1.0, "N·m")), "Torque over speed"),
        ("Friction heat there", both(&|of| stated(Some(of.present.friction), 1.0, "W")), "Friction heat"),
    ];
    let em = ui.text_style_height(&TextStyle::Body);
    let narrow = ui.available_width() < NARROW[0] * em;
    parts::table(ui, "figures of merit", 3, GAPS[usize::from(!narrow)], |ui| {
        ui.label("");
        for (head, colour) in [("With film", cx.colours.film), ("Without film", cx.colours.contact)] {
            glossary::term(ui, RichText::new(head).color(colour), head);
        }
        ui.end_row();
        for (name, values, word) in rows {
            ui.scope(|ui| {
                if narrow {
                    ui.set_max_width(NARROW[1] * em);
                }
                let name = egui::Label::new(RichText::new(name).color(cx.colours.quiet));
                ui.add(if narrow { name.wrap() } else { name }).explained_here(ui, word);
            });
            for value in values {
                glossary::term(ui, RichText::new(value).color(ui.visuals().strong_text_color()), word);
            }
            ui.end_row();
        }
    });
}

/// Further results, in sentences.
fn notes(ui: &mut egui::Ui, motor: &Motor, merit: &TorqueCurves, cx: &DrawContext<'_>) {
    let drag = significant(1e6 * merit.viscous_drag.abs(), 2);
    cx.note(ui, format!("Squeezing the film takes {} from the stator.", stated(Some(merit.film_power), 1.0, "W")));
    cx.note(ui, format!("The film's own viscous drag, not counted here, is at most {drag} µN·m."));
    if merit.with_film.no_load_speed.is_none() {
        return cx.note(ui, "No tooth touches the rotor: only that drag drives it.");
    }
    let dry = stated(Some(merit.dry_equivalent), 1.0, "");
    let text = format!(
        "A model without film needs the friction coefficient {} for the same maximum operating torque, instead of {}.",
        dry.trim_end(),
        as_given(motor.dry_friction)
    );
    cx.note(ui, &text);
    let text = format!(
        "Pressures are those of the scene's rotor speed; at another speed the film changes the torque by less than {} %.",
        significant(100.0 * merit.speed_effect, 2)
    );
    cx.note(ui, &text);
}

/// A number with its error and unit; "none" if there is none.
fn stated(found: Option<Estimate>, factor: f64, unit: &str) -> String {
    found.map_or_else(|| "none".to_owned(), |found| format!("{} {unit}", uncertain(found * factor)))
}
