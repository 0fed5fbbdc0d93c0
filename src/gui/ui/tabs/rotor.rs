//! The rotor by itself: compliance by harmonic and Green's function of several models, and the cross-section of a ring, to scale, with its
//! mesh and its deformation under the present load. The edges of its parts can be dragged. Below the rotor are the faces if they are rough
//! (`surface`), and a measured face (`face`).

use super::{face, surface};
use crate::analysis::rotor::{Bent, RotorCurves};
use crate::digits::{percent, significant};
use crate::export::figure::{Axis, Colour, Dash, Line, Marker, Panel, Style};
use crate::gui::command::Command;
use crate::gui::ui::cache::once;
use crate::gui::ui::chart::{Chart, legend, title};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::{Hint, describe};
use crate::gui::ui::paint::Axes;
use crate::gui::ui::parts::{BESIDE_CHARTS, scrolled};
use crate::problem::{Problem, Scenario};
use crate::scene::Value;
use crate::scene::edges::{self, lengths, reach, with_edge};
use eframe::egui::{self, CursorIcon, Rect, Sense, Stroke, TextStyle, Tooltip, Ui, vec2};

/// Heights of the charts and of the section: shares of the tab, and at least this many lines of text.
const SHARES: [f32; 3] = [0.3, 0.3, 0.5];
const LEAST_LINES: [f32; 3] = [10.0, 10.0, 14.0];
/// In a tab wider than this, in heights of the text, the charts stand beside each other.
const BESIDE: f32 = 36.0;
/// Harmonics that the chart of compliances shows.
const SHOWN: usize = 64;
/// The greatest displacement as drawn, as a share of the section's size.
const MAGNIFIED: f64 = 0.06;
/// The nodes round an element, from one corner back to the same corner.
const AROUND: [usize; 9] = [0, 1, 2, 5, 8, 7, 6, 3, 0];
/// Distance from an edge within which the pointer grabs it \[points\].
const REACH: f32 = 5.0;
/// Rounding of a dragged edge \[mm\].
const STEP: f64 = 0.01;
/// Lengths of a part, as in its table.
const LENGTHS: [&str; 4] = ["Inner radius", "Outer radius", "Bottom", "Top"];

/// Shows the tab.
pub fn show(ui: &mut Ui, cx: &DrawContext<'_>) {
    let height = ui.available_height();
    let scene = cx.state.document.scene();
    let Some(Problem { scenario: Scenario::Motor(motor), .. }) = &cx.state.problem else {
        return cx.note(ui, "A plate vibrates over a rigid wall: there is no rotor");
    };
    scrolled(ui, "rotor", BESIDE_CHARTS, |ui| {
        let known = cx.state.rotor.found();
        match known {
            None => drop(ui.label("Computing the rotor…")),
            Some(Err(why)) => {
                // If there are curves, the text with their numbers says so, and nothing moves while an edge is dragged.
                if !cx.state.rotor.is_of(motor) {
                    cx.note(ui, "Curves of the rotor before this edit");
                }
                cx.alarm(ui, [format!("There are no curves to show: {why}")]);
            }
            Some(Ok(_)) => {}
        }
        let found = known.and_then(|known| known.as_ref().ok());
        let em = ui.text_style_height(&TextStyle::Body);
        let tall = |i: usize| (SHARES[i] * height).max(LEAST_LINES[i] * em);
        if let Some(found) = found {
            curves(ui, found, [tall(0), tall(1)]);
            numbers(ui, found, cx.state.rotor.is_of(motor), cx);
        }
        if let Some(Value::Records(parts)) = scene.get("rotor.part") {
            ui.add_space(4.0);
            title(ui, "Cross-section of the rotor, mm: drag an edge", "Cross-section");
            let bent = found.and_then(|found| found.bent.as_ref()).filter(|_| cx.state.rotor.is_of(motor));
            section(ui, &parts, [motor.contact_radius, motor.contact_width], bent, tall(2), cx);
        }
        surface::show(ui, motor, tall(1), cx);
        face::show(ui, tall(1), cx);
    });
}

fn curves(ui: &mut Ui, found: &RotorCurves, heights: [f32; 2]) {
    let colours = [Colour::FILM, Colour::CONTACT, Colour::ROTOR];
    let styles = colours.into_iter().zip([Dash::Solid, Dash::Dashed, Dash::DashDot]);
    let styles =
        styles.map(|(colour, dash)| Style { marker: Some(Marker::default()), ..Style::solid(colour).dash(dash) });
    let x = Axis::new("harmonic n of the wave", "").log();
    let mut compliance = Panel::new("", x, Axis::new("", "").log());
    let mut green = Panel::new("", Axis::new("x from the force", "mm"), Axis::new("", ""));
    for (curve, style) in found.curves.iter().zip(styles) {
        let points = (1..).zip(&curve.compliance).take(SHOWN).map(|(n, c)| [f64::from(n), *c]);
        compliance = compliance.layer(Line::new(&*curve.name, points, style));
        let half = curve.green.iter().map(|[x, g]| [1e3 * x, 1e6 * g]);
        let both = half.clone().rev().map(|[x, g]| [-x, g]).chain(half.skip(1));
        green = green.layer(Line::new(&*curve.name, both, Style { marker: None, ..style }));
    }
    legend(ui, &[&compliance]);
    let charts = [
        ("Compliance by harmonic, m²/N", &compliance, "Compliance", Some("Harmonic")),
        ("Deflection under a unit force, µm/N", &green, "Green's function", None),
    ];
    let show = |ui: &mut Ui, i: usize, height: f32| {
        let (name, panel, word, below) = charts[i];
        title(ui, name, word);
        Chart { name, height, panel, words: (below, word) }.show(ui);
    };
    if ui.available_width() > BESIDE * ui.text_style_height(&TextStyle::Body) {
        ui.columns(2, |columns| (0..2).for_each(|i| show(&mut columns[i], i, heights[0])));
    } else {
        (0..2).for_each(|i| show(ui, i, heights[i]));
    }
}

fn numbers(ui: &mut Ui, found: &RotorCurves, present: bool, cx: &DrawContext<'_>) {
    let deflection = found.curves[0].green[0][1] * 1e6;
    let known = match found.relative_error {
        0.0 => String::new(),
        error => format!(", known to {}", percent(error)),
    };
    let whose = if present { "Present rotor" } else { "Before this edit" };
    let mut text =
        format!("{whose}: {} µm/N under a unit force, local compliance included{known}", significant(deflection, 3));
    if let Some(resonances) = &found.resonances {
        let khz: Vec<_> = resonances.iter().map(|hertz| significant(1e-3 * hertz, 3)).collect();
        text += &format!("; lowest natural frequencies of harmonics 1 to {}: {} kHz", khz.len(), khz.join(", "));
    }
    cx.note(ui, text);
}

fn section(
    ui: &mut Ui,
    parts: &[Vec<Value>],
    [radius, width]: [f64; 2],
    bent: Option<&Bent>,
    height: f32,
    cx: &DrawContext<'_>,
) {
    let boxes: Vec<[f64; 4]> = parts.iter().filter_map(|part| lengths(part)).collect();
    let (rect, canvas) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let canvas = canvas.called(egui::Role::Image, "Cross-section of the rotor");
    let bound = |i: usize, pick: fn(f64, f64) -> f64| boxes.iter().map(|part| part[i]).reduce(pick).unwrap_or(0.0);
    let now = [bound(0, f64::min), bound(1, f64::max), bound(2, f64::min), bound(3, f64::max)];
    // The scale does not change while an edge is dragged.
    let kept = canvas.id.with("bounds");
    let dragged: Option<[f64; 4]> = ui.data(|data| data.get_temp(kept));
    let [left, right, bottom, top] = dragged.unwrap_or(now);
    let (wide, tall) = ((right - left).max(1e-3), (top - bottom).max(1e-3));
    let points = (f64::from(0.86 * rect.width()) / wide).min(f64::from(0.8 * rect.height()) / tall);
    let middle = (0.5 * (left + right), 0.5 * (bottom + top));
    let origin = rect.center() - vec2((points * middle.0) as f32, -(points * middle.1) as f32);
    let [x, y] = [(rect.width(), middle.0), (rect.height(), middle.1)].map(|(size, middle)| {
        let half = 0.5 * f64::from(size) / points;
        [middle - half, middle + half]
    });
    // Both axes are in millimetres and have one scale.
    let scale = Axes { rect, x, y };
    let painter = ui.painter().with_clip_rect(rect);
    let outline = Stroke::new(1.5, cx.colours.rotor);
    let fill = cx.colours.canvas.lerp_to_gamma(cx.colours.rotor, 0.35);
    for [inner, outer, low, high] in &boxes {
        let area = Rect::from_two_pos(scale.at(*inner, *low), scale.at(*outer, *high));
        painter.rect_filled(area, 0.0, fill);
        painter.rect_stroke(area, 0.0, outline, egui::StrokeKind::Middle);
    }
    if let Some(bent) = bent {
        elements(&painter, ui, bent, scale, [wide, tall], cx);
    }
    // The place where the stator touches.
    let touching = [-0.5, 0.5].map(|part| scale.at(1e3 * radius + part * (1e3 * width), now[2]));
    painter.line_segment(touching, Stroke::new(4.0, cx.colours.contact));
    supports(&painter, scale, cx);
    let mut dragging = false;
    for (number, (part, lengths)) in parts.iter().zip(&boxes).enumerate() {
        let [inner, outer, low, high] = *lengths;
        let name = edges::name(part).map_or_else(|| format!("part {}", number + 1), str::to_owned);
        let area = Rect::from_two_pos(scale.at(inner, low), scale.at(outer, high));
        let text = TextStyle::Small.resolve(ui.style());
        if area.width() > 4.0 * text.size && area.height() > 1.2 * text.size {
            painter.text(area.center(), egui::Align2::CENTER_CENTER, &name, text, ui.visuals().strong_text_color());
        }
        let [left, right] = [area.with_max_x(area.left()), area.with_min_x(area.right())];
        let [bottom, top] = [area.with_min_y(area.bottom()), area.with_max_y(area.top())];
        for (which, (edge, called)) in [left, right, bottom, top].into_iter().zip(LENGTHS).enumerate() {
            let id = canvas.id.with((number, which));
            let cursor = if which < 2 { CursorIcon::ResizeHorizontal } else { CursorIcon::ResizeVertical };
            let held = ui.interact(edge.expand(REACH).intersect(rect), id, Sense::drag()).on_hover_cursor(cursor);
            let held = held.called(egui::Role::Slider, &format!("{called} of {name}, to drag"));
            if held.hovered() || held.dragged() {
                painter.rect_stroke(edge, 0.0, Stroke::new(3.0, cx.colours.accent), egui::StrokeKind::Middle);
            }
            let told = format!("{called} of {name}: {} mm", significant(lengths[which], 5));
            let held = if held.dragged() {
                // A hint disappears during a drag.
                describe(&held, || told.clone());
                Tooltip::for_widget(&held).show(|ui| drop(ui.label(told.as_str())));
                held
            } else {
                held.hint(told)
            };
            dragging |= held.dragged();
            let (Some(at), true) = (held.interact_pointer_pos(), held.dragged() || held.drag_stopped()) else {
                continue;
            };
            let along =
                if which < 2 { f64::from(at.x - origin.x) / points } else { f64::from(origin.y - at.y) / points };
            let reach = reach(parts, (number, which), STEP);
            // The value has as few digits as the step.
            let to = ((along / STEP).round() * STEP).clamp(*reach.start(), *reach.end());
            let value = Value::Records(with_edge(parts, (number, which), (to * 1e4).round() / 1e4));
            cx.push(Command::Set { key: "rotor.part", value, dragging: held.dragged() });
        }
    }
    ui.data_mut(|data| match dragged {
        None if dragging => drop(data.insert_temp(kept, now)),
        Some(_) if !dragging => data.remove::<[f64; 4]>(kept),
        _ => {}
    });
}

/// The undeformed mesh, and the mesh deformed by the load, magnified.
fn elements(painter: &egui::Painter, ui: &Ui, bent: &Bent, scale: Axes, [wide, tall]: [f64; 2], cx: &DrawContext<'_>) {
    let draw = |node: &dyn Fn(usize) -> [f64; 2], stroke: Stroke| {
        for element in &bent.mesh.elements {
            // The sides are drawn one by one, because a closed line has spikes where sides meet at a sharp angle.
            for pair in AROUND.windows(2) {
                let ends = [pair[0], pair[1]].map(|i| node(element.nodes[i])).map(|[r, z]| scale.at(1e3 * r, 1e3 * z));
                painter.line_segment(ends, stroke);
            }
        }
    };
    let nodes = &bent.mesh.nodes;
    draw(&|i| nodes[i], Stroke::new(0.5, cx.colours.quiet.gamma_multiply(0.6)));
    let Some(run) = cx.state.run.as_ref().filter(|run| !cx.state.stale(run)) else { return };
    if run.solution.recording.frames == 0 {
        return;
    }
    let key = (run.number, run.fidelity, nodes.len());
    let moved = once(ui, "bent rotor", key, || bent.under(&run.solution.recording.lines, 0));
    let most = moved.iter().flatten().fold(0.0, |top: f64, u| top.max(u.abs()));
    if moved.len() != nodes.len() || most == 0.0 {
        return;
    }
    let factor = MAGNIFIED * 1e-3 * wide.max(tall) / most;
    draw(&|i| [0, 1].map(|k| nodes[i][k] + factor * moved[i][k]), Stroke::new(0.8, cx.colours.film));
    let text = format!(
        "under the present load, where it presses most: up to {} µm, drawn {} times as large",
        significant(1e6 * most, 3),
        significant(factor, 2)
    );
    let at = painter.clip_rect().left_bottom() + vec2(4.0, -4.0);
    painter.text(at, egui::Align2::LEFT_BOTTOM, text, TextStyle::Small.resolve(ui.style()), cx.colours.film);
}

fn supports(painter: &egui::Painter, scale: Axes, cx: &DrawContext<'_>) {
    let Some(Value::Records(supports)) = cx.state.document.scene().get("rotor.support") else { return };
    for [inner, outer, low, high] in supports.iter().filter_map(|support| lengths(support)) {
        let area = Rect::from_two_pos(scale.at(inner, low), scale.at(outer, high)).expand(2.0);
        painter.rect_stroke(area, 0.0, Stroke::new(2.0, cx.colours.accent), egui::StrokeKind::Middle);
    }
}
