//! The motor: wave, pressures and maps on one x axis, which begins half a pitch before tooth 0 so that this tooth is not cut.

use super::frame::Frame;
use super::pointer::{named, read_out, readout_height};
use super::velocity::FilmPosition;
use super::{field, loads, ring, tooth, wave};
use crate::gui::command::Command;
use crate::gui::derived::format::number;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::paint::{DrawingStack, PlotStyle};
use crate::problem::Motor;
use crate::recording::sample::{self, Lines};
use eframe::egui::{self, CursorIcon, Pos2, Rangef, Rect, Sense, Stroke, StrokeKind, pos2};

/// Where the parts go.
#[derive(Clone, Copy, Debug)]
struct Layout {
    wave: Rect,
    loads: Rect,
    map: Rect,
    /// The whole ring, and below it the velocity across the film.
    side: Option<[Rect; 2]>,
    /// The followed tooth, titles and axes included.
    tooth: Option<Rect>,
    readout: Rect,
}

impl Layout {
    fn new(area: Rect, row: f32, gutter: f32, readout: f32) -> Self {
        let (title, axis) = (row + 7.0, row + 3.0);
        let body = area.height() - readout - 3.0 * title - axis;
        let least = 6.0 * row + title + axis;
        let with_tooth = body > 16.0 * row + least && area.width() > 3.0 * (gutter + 5.0 * row);
        let below = if with_tooth { (0.24 * body).max(least) } else { 0.0 };
        let rest = (body - below - 4.0).max(30.0);
        let end = area.right() - 0.5 * row;
        let with_side = area.width() > 44.0 * row && body - below > 20.0 * row;
        let beside = if with_side { (0.29 * area.width()).min(0.55 * rest) } else { 0.0 };
        let mut plots = DrawingStack { x: Rangef::new(area.left() + gutter, end - beside), bottom: area.top() };
        let [wave, loads, map] = [0.50, 0.31, 0.19].map(|part| plots.next(title, part * rest));
        let side = with_side.then(|| {
            let left = wave.right() + row;
            let ring = Rect::from_min_max(pos2(left, wave.top()), pos2(end, wave.bottom()));
            [ring, Rect::from_min_max(pos2(left + gutter, loads.top()), pos2(end, map.bottom()))]
        });
        let under = map.bottom() + axis + 2.0;
        let tooth = with_tooth.then(|| Rect::from_min_max(pos2(area.left(), under), pos2(end, under + below)));
        let readout = Rect::from_min_max(pos2(area.left(), area.bottom() - readout), area.right_bottom());
        Self { wave, loads, map, side, tooth, readout }
    }
}

pub(super) fn show(ui: &mut egui::Ui, area: Rect, shown: &Frame<'_, Motor>, cx: &DrawContext<'_>) {
    let recording = shown.recording;
    let underside = shown.lines.underside(recording);
    let style = PlotStyle::new(ui);
    let inside = style.within(area);
    let layout = Layout::new(area, style.row, style.gutter, readout_height(&LONGEST, &style, area.width()));

    let axes = wave::draw(&inside, layout.wave, shown, &underside);
    let charted = loads::draw(ui, &style, layout.loads, shown);
    let titles = ["Pressure map of the film, kPa absolute", "Film, absolute", "Film"];
    let mapped = field::of_run(ui, &inside, layout.map, shown, ("all teeth", &titles));
    mapped.x_labels(&inside, 1e-3, "x, mm");
    let [left, right] = shown.followed().map(|x| mapped.px(x));
    let followed = Rect::from_x_y_ranges(left..=right, layout.map.y_range());
    inside.painter.rect_stroke(followed, 0.0, Stroke::new(1.5, style.palette.accent), StrokeKind::Outside);
    if let Some([rect, profile]) = layout.side {
        ring::draw(ui, &style, rect, (shown, &underside, &axes), cx);
        velocity(ui, &style, profile, shown);
    }
    if let Some(rect) = layout.tooth {
        let charts = tooth::draw(ui, &style, rect, shown, cx);
        for (chart, place) in charts.into_iter().zip(["least gap", "loads"]) {
            cx.name_plot(ui, place, chart);
        }
        cx.name_part(ui, "tooth", rect);
    }
    wave::ellipse(&style.clipped(area.expand(0.6 * style.row)), &axes, shown);
    read_out(&readout(shown), &inside, layout.readout);

    let name = "Motor along one wavelength: point to read values, click a tooth to follow it";
    let wave = named(ui, layout.wave, name, Sense::click());
    let name = "Pressure maps of the teeth: point to read values, click a tooth to follow it";
    let map = named(ui, layout.map, name, Sense::click());
    let along = |at: Pos2| axes.x_at(at.x);
    let charted_along = |at: Pos2| Some(1e-3 * charted.transform.value_from_position(at).x);
    let charted_response = charted.response.clone();
    for (response, along) in [(wave, &along as &dyn Fn(Pos2) -> _), (charted_response, &charted_along), (map, &along)] {
        let response = response.on_hover_cursor(CursorIcon::Crosshair);
        if let Some(x) = response.hover_pos().and_then(along) {
            cx.point_at(x);
        }
        let clicked = response.interact_pointer_pos().filter(|_| response.clicked());
        if let Some(x) = clicked.and_then(along) {
            cx.push(Command::FollowTooth(sample::tooth_at(x, recording.pitch, recording.teeth).0));
        }
    }
    for (name, rect) in [("wave", layout.wave), ("pressure", layout.loads), ("map", layout.map)] {
        cx.name_plot(ui, name, rect);
    }
    style.explain(ui);
}

/// Velocity across the film at the pointer, or else at the middle of the followed tooth.
fn velocity(ui: &mut egui::Ui, style: &PlotStyle, place: Rect, shown: &Frame<'_, Motor>) {
    let (recording, motor) = (shown.recording, shown.of);
    let reach = recording.x.last().copied().unwrap_or(0.0);
    let pointed = shown.view.cursor_x.map(|x| sample::tooth_at(x, recording.pitch, recording.teeth));
    let (tooth, xi) = pointed.filter(|(_, xi)| xi.abs() <= reach).unwrap_or((shown.tooth, 0.0));
    let x = tooth as f64 * recording.pitch + xi;
    let frames = recording.frames.max(1) as f64;
    let walls = |instant: f64| {
        let rotor = motor.rotor_speed;
        [rotor - motor.sliding_speed(x, instant / frames), rotor]
    };
    let thickness = |instant: f64| {
        let lines = Lines::at(recording, instant);
        Some(sample::between(&lines.film_thickness[lines.of(tooth)], sample::locate(&recording.x, xi)?))
    };
    let of = FilmPosition { shown, gas: &motor.gas, tooth, xi, walls: &walls, thickness: &thickness };
    of.draw(ui, style, place);
}

/// A row of values, with the width of the longest.
const LONGEST: [&str; 6] = [
    "x −00.00 mm",
    "tooth 00",
    "gap 0.0000 µm",
    "film thickness 0.0000 µm",
    "mean over y: contact 0000 kPa, film −0000 kPa gauge",
    "p(y = 0) = 0000 kPa absolute",
];

fn readout(shown: &Frame<'_, Motor>) -> Vec<String> {
    let recording = shown.recording;
    let [left, right] = shown.x_range();
    let Some(x) = shown.view.cursor_x.filter(|x| (left..=right).contains(x)) else {
        return vec!["Point at a view to read its values, click a tooth to follow it".to_owned()];
    };
    let (tooth, xi) = sample::tooth_at(x, recording.pitch, recording.teeth);
    let mut values = vec![format!("x {} mm", number(x * 1e3))];
    let Some(node) = sample::locate(&recording.x, xi) else {
        values.push("groove".to_owned());
        return values;
    };
    let lines = &shown.lines;
    let at = |field: &[f64]| sample::between(&field[lines.of(tooth)], node);
    let thickness = at(&lines.film_thickness);
    let width = shown.of.contact_width;
    values.push(format!("tooth {tooth}"));
    values.push(format!("gap {} µm", number((thickness - shown.of.spacing()).max(0.0) * 1e6)));
    values.push(format!("film thickness {} µm", number(thickness * 1e6)));
    let [contact, film] = [&lines.contact, &lines.film].map(|field| number(at(field) / width / 1e3));
    values.push(format!("mean over y: contact {contact} kPa, film {film} kPa gauge"));
    if let Some(pressure) = sample::middle_pressure(recording, tooth, xi, shown.place) {
        values.push(format!("p(y = 0) = {} kPa absolute", number(pressure / 1e3)));
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_neither_overlap_nor_leave_the_area() {
        for (width, height) in [(430.0, 560.0), (800.0, 800.0), (1000.0, 500.0), (360.0, 380.0)] {
            for row in [12.0, 15.0, 22.0] {
                let area = Rect::from_min_size(pos2(10.0, 20.0), egui::vec2(width, height));
                let layout = Layout::new(area, row, 3.2 * row, 2.0 * row);
                let mut parts = vec![layout.wave, layout.loads, layout.map];
                parts.extend(layout.tooth);
                parts.push(layout.readout);
                if let Some([ring, profile]) = layout.side {
                    assert!(ring.bottom() < profile.top() && ring.left() > layout.wave.right());
                    assert!(profile.left() > layout.loads.right() && profile.bottom() <= layout.map.bottom());
                    assert!(area.contains_rect(ring) && area.contains_rect(profile));
                }
                for pair in parts.windows(2) {
                    assert!(pair[0].bottom() <= pair[1].top() + 0.01, "{width}×{height}, {row}: {parts:?}");
                }
                assert!(parts.iter().all(|part| area.expand(0.01).contains_rect(*part) && part.height() > 5.0));
            }
        }
    }
}
