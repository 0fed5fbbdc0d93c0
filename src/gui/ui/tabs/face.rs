//! A measured face, below the rotor: its heights as a map, the profile under the pointer, and its statistics.

use crate::digits::{signed, significant};
use crate::export::figure::{Axis, Colour, Line, Panel, Style};
use crate::export::surface::{lay, lengths};
use crate::gui::command::Command;
use crate::gui::derived::scales::span;
use crate::gui::derived::words::label;
use crate::gui::state::dialogs::Purpose;
use crate::gui::state::face::MeasuredFace;
use crate::gui::ui::cache::once;
use crate::gui::ui::chart::{Chart, title};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::glossary;
use crate::gui::ui::hint::Hint;
use crate::gui::ui::paint::{PlotStyle, colour_between};
use crate::gui::ui::parts::table;
use crate::scene::{Parameter, Value};
use crate::surface::height_map::HeightMap;
use eframe::egui::{self, Color32, ColorImage, Rect, RichText, Sense, Stroke, TextureOptions, Ui, pos2, vec2};
use std::sync::Arc;

/// Most points of the map that are drawn along a side.
const DRAWN: usize = 512;
/// Most points of a profile that are drawn.
const POINTS: usize = 2000;

/// Text shown when no face is open.
const INTRODUCTION: &[&str] = &[
    "How rough is a face that was measured, and what follows from it?",
    "The file has a grid of heights, after the lines # dx_um = 0.5, # dy_um = 0.5 and # height = nm, or a profile with the columns x_um and \
         z_nm.",
];

/// Shows the open face, or how to open one.
pub(super) fn show(ui: &mut Ui, height: f32, cx: &DrawContext<'_>) {
    ui.add_space(6.0);
    title(ui, "Measured face", "Measured face");
    let state = &cx.state.face;
    ui.horizontal_wrapped(|ui| {
        let about = "A CSV file, a grid of heights or a profile, as squeezefilm surface reads it; or drop one on the window";
        cx.button(ui, "Open heights…", about, Command::Ask(Purpose::Heights));
        if state.work.running() {
            ui.spinner();
        }
        let Some(face) = state.found.as_ref() else { return };
        let set = face.roughness(cx.state.document.scene()).into_iter().filter_map(|(key, value)| {
            let parameter = Parameter::find(key)?;
            Some(format!("{} to {}", label(parameter), parameter.with_unit(Value::Number(value))))
        });
        let about = format!(
            "Sets the keys of the present surface model for two faces like this one, as one edit:\n{}\nAfter a change of \
             the model, press this again",
            set.collect::<Vec<_>>().join("\n")
        );
        cx.button(ui, "Take roughness from it", about, Command::TakeRoughness);
        cx.button(ui, "Forget it", "The face is no longer shown", Command::ForgetFace);
        ui.label(&face.name);
    });
    if let Some(face) = state.found.as_ref() {
        let row = if face.map.ny > 1 { map(ui, face, height) } else { 0 };
        profile(ui, &face.map, row, height);
        numbers(ui, face, cx);
    } else if !state.work.running() {
        cx.introduce(ui, INTRODUCTION);
    }
}

/// The heights from above. Returns the row under the pointer, or the middle one.
fn map(ui: &mut Ui, face: &Arc<MeasuredFace>, height: f32) -> usize {
    let map = &face.map;
    let style = PlotStyle::new(ui);
    let [wide, tall] = [(map.nx, 0), (map.ny, 1)].map(|(points, axis)| (points as f64 * map.spacing[axis]) as f32);
    let scale = (ui.available_width() / wide).min(height / tall);
    let head = style.row + 6.0;
    let size = vec2((wide * scale).max(14.0 * style.row), tall * scale + head);
    let (area, _) = ui.allocate_exact_size(size, Sense::hover());
    let rect = Rect::from_min_size(area.min + vec2(0.0, head), vec2(wide * scale, tall * scale));
    let [low, high] = span(map.heights.iter().copied());
    let picture = once(ui, "measured face", Arc::as_ptr(face) as usize, || {
        ui.ctx().load_texture("measured face", picture(map, [low, high]), TextureOptions::LINEAR)
    });
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter().image(picture.id(), rect, whole, Color32::WHITE);
    let ends = [significant(low * 1e9, 3), format!("{} nm", significant(high * 1e9, 3))];
    let [length, width] = [wide, tall].map(|metres| significant(f64::from(metres) * 1e6, 3));
    let long = format!("Heights, {length} × {width} µm, x along the wave");
    let titled = Rect::from_min_max(rect.min, pos2(area.right(), rect.bottom()));
    style.title_with_ends(titled, "Measured face", &[&long, "Heights"], [&ends[0], &ends[1]]);
    let name = "Heights of the measured face: point to see the profile along x there";
    let response = ui.interact(rect, ui.scope_id().with("heights"), Sense::hover()).called(egui::Role::Image, name);
    let share = response.hover_pos().map_or(0.5, |at| (at.y - rect.top()) / rect.height());
    let row = ((1.0 - share) * map.ny as f32).clamp(0.0, (map.ny - 1) as f32) as usize;
    let y = rect.bottom() - (row as f32 + 0.5) / map.ny as f32 * rect.height();
    ui.painter().hline(rect.x_range(), y, Stroke::new(1.0, style.palette.accent));
    style.explain(ui);
    row
}

/// The heights in the colours of fields, y upwards.
fn picture(map: &HeightMap, range: [f64; 2]) -> ColorImage {
    let (size, colour) = ([map.nx.min(DRAWN), map.ny.min(DRAWN)], colour_between(range));
    let at = |pixel: usize, pixels: usize, points: usize| (2 * pixel + 1) * points / (2 * pixels);
    let height = |k: usize| {
        let (ix, iy) = (at(k % size[0], size[0], map.nx), at(k / size[0], size[1], map.ny));
        map.heights[(map.ny - 1 - iy) * map.nx + ix]
    };
    ColorImage::new(size, (0..size[0] * size[1]).map(|k| colour(height(k))).collect())
}

fn profile(ui: &mut Ui, map: &HeightMap, row: usize, height: f32) {
    let name = "Profile along x, nm";
    title(ui, name, "Measured face");
    let point = |i: usize| [i as f64 * map.spacing[0] * 1e6, map.heights[row * map.nx + i] * 1e9];
    let points = (0..map.nx).step_by(map.nx.div_ceil(POINTS)).map(point);
    let [low, high] = span(map.heights.iter().map(|height| height * 1e9));
    let panel = Panel::new("", Axis::new("x", "µm"), Axis::new("", "").fixed(low, high));
    let panel = panel.layer(Line::new("", points, Style::solid(Colour::FILM)));
    Chart { name, height: 0.6 * height, panel: &panel, words: (None, "Measured face") }.show(ui);
}

/// Its statistics, and the values for two faces like it.
fn numbers(ui: &mut Ui, face: &MeasuredFace, cx: &DrawContext<'_>) {
    let (own, both) = (&face.texture, &face.pair);
    let lengths = lengths(own, own.correlation);
    let lay = lay(own).unwrap_or_else(|| "unknown, taken to be 1".to_owned());
    let nm = |value: f64| format!("{} nm", significant(value * 1e9, 4));
    let rows = [
        ["Sa, Sq", &format!("{}, {}", nm(own.mean), nm(own.rms)), "Roughness, both faces", &nm(both.rms)],
        ["Sz", &nm(own.peak_to_valley), "Minimum spacing H_m", &nm(both.min_spacing)],
        [
            "Skewness, kurtosis",
            &format!("{}, {:.2}", signed(format!("{:.2}", own.skewness)), own.kurtosis),
            "Summit radius",
            &format!("{} µm", significant(both.summit_radius * 1e6, 4)),
        ],
        ["Correlation length", &lengths, "Summits", &format!("{} 1/mm²", significant(both.summit_density * 1e-6, 4))],
        ["Lay", &lay, "Lay, both faces", &significant(both.lay, 3)],
    ];
    table(ui, "face", 4, 12.0, |ui| {
        for [name, value, follows, of_both] in rows {
            for (name, value) in [(name, value), (follows, of_both)] {
                glossary::term(ui, RichText::new(name).color(cx.colours.quiet), "Measured face");
                ui.label(RichText::new(value).color(ui.visuals().strong_text_color()));
            }
            ui.end_row();
        }
    });
    cx.note(ui, "On the right: what follows if both faces are like this one. The summits depend on the resolution of the measurement");
}
