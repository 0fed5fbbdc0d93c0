//! The motor: wave, pressures and maps on one x axis, from half a pitch before tooth 0 so that it is whole.

use super::paint::{Axes, Ink, number};
use super::sample::{self, Lines, Touching};
use super::scales::{Ranges, Scales};
use super::{loads, map, tooth, wave};
use crate::fidelity::Fidelity;
use crate::gui::command::Command;
use crate::gui::spot;
use crate::gui::state::View;
use crate::job::Run;
use crate::problem::{Motor, Scenario};
use crate::recording::Recording;
use eframe::egui::{self, CursorIcon, Painter, Rect, Response, Sense, Ui, WidgetInfo, pos2};

/// Wavenumber beyond all that a rotor resolves \[rad/m\]: what is left of its compliance is local.
const LOCAL: f64 = 1e9;

/// One run at one instant.
pub(super) struct Shown<'a> {
    pub(super) run: (u64, Fidelity),
    pub(super) recording: &'a Recording,
    pub(super) motor: &'a Motor,
    pub(super) scales: &'a Scales,
    /// The instant, in frames.
    pub(super) place: f64,
    /// The lines at that instant.
    pub(super) lines: Lines,
    pub(super) tooth: usize,
    pub(super) cursor: Option<f64>,
}

impl Shown<'_> {
    pub(super) fn x_range(&self) -> [f64; 2] {
        let half = 0.5 * self.recording.pitch;
        [-half, self.recording.length - half]
    }

    /// Phase of the instant.
    pub(super) fn phase(&self) -> f64 {
        self.place / self.recording.frames.max(1) as f64
    }

    /// A faint column behind the followed tooth.
    pub(super) fn mark_followed(&self, painter: &Painter, ink: &Ink, axes: &Axes) {
        let middle = self.tooth as f64 * self.recording.pitch;
        let reach = self.recording.x.last().copied().unwrap_or(0.0);
        let column = Rect::from_x_y_ranges(axes.px(middle - reach)..=axes.px(middle + reach), axes.rect.y_range());
        painter.rect_filled(column, 0.0, ink.palette.accent.gamma_multiply(0.10));
    }
}

/// Where the parts go.
#[derive(Clone, Copy, Debug)]
struct Layout {
    wave: Rect,
    loads: Rect,
    map: Rect,
    /// The followed tooth, titles and axes included.
    tooth: Option<Rect>,
    readout: Rect,
    gutter: f32,
}

impl Layout {
    fn new(area: Rect, row: f32, gutter: f32, readout: f32) -> Self {
        let (title, axis) = (row + 7.0, row + 3.0);
        let body = area.height() - readout - 3.0 * title - axis;
        let least = 6.0 * row + title + axis;
        let with_tooth = body > 16.0 * row + least && area.width() > 3.0 * (gutter + 5.0 * row);
        let below = if with_tooth { (0.24 * body).max(least) } else { 0.0 };
        let rest = (body - below - 4.0).max(30.0);
        let plot = |top: f32, part: f32| {
            let low = pos2(area.right() - 0.5 * row, top + part * rest);
            Rect::from_min_max(pos2(area.left() + gutter, top), low)
        };
        let wave = plot(area.top() + title, 0.50);
        let loads = plot(wave.bottom() + title, 0.31);
        let map = plot(loads.bottom() + title, 0.19);
        let under = map.bottom() + axis;
        let tooth = with_tooth
            .then(|| Rect::from_min_max(pos2(area.left(), under + 2.0), pos2(wave.right(), under + 2.0 + below)));
        let readout = Rect::from_min_max(pos2(area.left(), area.bottom() - readout), area.right_bottom());
        Self { wave, loads, map, tooth, readout, gutter }
    }
}

/// Draws `run` at the view's phase.
pub(super) fn show(
    ui: &mut egui::Ui,
    run: &Run,
    within: Option<&Ranges>,
    view: &mut View,
    commands: &mut Vec<Command>,
) {
    let recording = &run.solution.recording;
    let Scenario::Motor(motor) = &run.problem.scenario else { return };
    let Some(area) = super::paint::area(ui, recording) else { return };
    let scales = Scales::of(ui, run, within);
    let place = view.place(recording);
    let touching = Touching { min_spacing: motor.min_spacing, compliance: motor.rotor.at(LOCAL) };
    let shown = Shown {
        run: (run.number, run.fidelity),
        recording,
        motor,
        scales: &scales,
        place,
        lines: Lines::at(recording, place, touching),
        tooth: view.tooth.min(recording.teeth.saturating_sub(1)),
        cursor: view.cursor_x,
    };
    let ink = Ink::new(ui);
    let painter = ui.painter_at(area);
    let gutter = ink.width(&painter, "−0.000") + 6.0;
    let longest = Readout { values: LONGEST.map(str::to_owned).to_vec() };
    let layout = Layout::new(area, ink.row, gutter, longest.height(&painter, &ink, area.width()));

    let axes = wave::draw(&painter, &ink, layout.wave, &shown);
    loads::draw(&painter, &ink, layout.loads, &shown);
    map::draw(ui, &painter, &ink, layout.map, &shown);
    if let Some(rect) = layout.tooth {
        let drawn = tooth::draw(ui, &painter, &ink, rect, layout.gutter, &shown);
        for (axes, place) in drawn.plots.iter().zip(["least gap", "loads"]) {
            spot::mark(ui, place, axes.rect);
        }
        spot::mark(ui, "tooth", rect);
        for (axes, name) in drawn.plots.iter().zip(["Least gap over the cycle", "Loads over the cycle"]) {
            seek(ui, axes, name, commands);
        }
    }
    Readout::new(&shown).draw(&painter, &ink, layout.readout);

    let pointed = layout.wave.union(layout.map);
    let name = "Motor along one wavelength: point to read values, click a tooth to follow it";
    let response = named(ui, pointed, name).on_hover_cursor(CursorIcon::Crosshair);
    if let Some(x) = response.hover_pos().and_then(|at| axes.x_at(at.x)) {
        view.hover_x = Some(x);
    }
    if response.clicked()
        && let Some(x) = response.interact_pointer_pos().and_then(|at| axes.x_at(at.x))
    {
        commands.push(Command::FollowTooth(sample::tooth_at(x, recording.pitch, recording.teeth).0));
    }
    for (name, rect) in [("wave", layout.wave), ("pressure", layout.loads), ("map", layout.map)] {
        spot::mark(ui, name, rect.shrink(2.0));
    }
    ink.explain(ui);
}

/// A named region that is clicked.
pub(super) fn named(ui: &Ui, rect: Rect, name: &str) -> Response {
    let response = ui.interact(rect, ui.scope_id().with(name), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Image, true, name));
    response
}

/// Clicking a plot over the cycle jumps to that phase.
pub(super) fn seek(ui: &Ui, axes: &Axes, name: &str, commands: &mut Vec<Command>) {
    let response = named(ui, axes.rect, &format!("{name}: click to jump there"));
    if response.clicked()
        && let Some(phase) = response.interact_pointer_pos().and_then(|at| axes.x_at(at.x))
    {
        commands.push(Command::Seek(phase.clamp(0.0, 1.0 - 1e-9)));
    }
}

/// A row of values, as wide as it takes.
const LONGEST: [&str; 7] = [
    "x −00.00 mm",
    "tooth 00",
    "gap 0.0000 µm",
    "film thickness 0.0000 µm",
    "contact 0000 kPa",
    "film −0000 kPa gauge",
    "p at y = 0 0000 kPa absolute",
];

/// Values under the cursor.
pub(super) struct Readout {
    pub(super) values: Vec<String>,
}

impl Readout {
    fn new(shown: &Shown<'_>) -> Self {
        let recording = shown.recording;
        let [left, right] = shown.x_range();
        let Some(x) = shown.cursor.filter(|x| (left..=right).contains(x)) else {
            return Self { values: vec!["Point at a view to read its values, click a tooth to follow it".to_owned()] };
        };
        let (tooth, xi) = sample::tooth_at(x, recording.pitch, recording.teeth);
        let mut values = vec![format!("x {} mm", number(x * 1e3))];
        let Some(node) = sample::locate(&recording.x, xi) else {
            values.push("groove".to_owned());
            return Self { values };
        };
        let lines = &shown.lines;
        let at = |field: &[f64]| sample::between(&field[lines.of(tooth)], node);
        let thickness = at(&lines.film_thickness);
        let width = shown.motor.contact_width;
        values.push(format!("tooth {tooth}"));
        values.push(format!("gap {} µm", number((thickness - shown.motor.min_spacing).max(0.0) * 1e6)));
        values.push(format!("film thickness {} µm", number(thickness * 1e6)));
        values.push(format!("contact {} kPa", number(at(&lines.contact) / width / 1e3)));
        values.push(format!("film {} kPa gauge", number(at(&lines.film) / width / 1e3)));
        if let Some(pressure) = sample::middle_pressure(recording, tooth, xi, shown.place) {
            values.push(format!("p at y = 0 {} kPa absolute", number(pressure / 1e3)));
        }
        Self { values }
    }

    fn lines(&self, painter: &Painter, ink: &Ink, width: f32) -> Vec<String> {
        let mut lines = vec![String::new()];
        for value in &self.values {
            let Some(line) = lines.last_mut() else { break };
            let longer = if line.is_empty() { value.clone() } else { format!("{line}   {value}") };
            if line.is_empty() || ink.width(painter, &longer) <= width {
                *line = longer;
            } else {
                lines.push(value.clone());
            }
        }
        lines
    }

    pub(super) fn height(&self, painter: &Painter, ink: &Ink, width: f32) -> f32 {
        self.lines(painter, ink, width).len() as f32 * ink.row + 4.0
    }

    pub(super) fn draw(&self, painter: &Painter, ink: &Ink, rect: Rect) {
        let mut at = pos2(rect.left(), rect.top() + 4.0);
        let hint = self.values.len() == 1;
        for line in self.lines(painter, ink, rect.width()) {
            let colour = if hint { ink.palette.quiet } else { ink.text };
            ink.write(painter, at, egui::Align2::LEFT_TOP, &line, colour);
            at.y += ink.row;
        }
    }
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
                for pair in parts.windows(2) {
                    assert!(pair[0].bottom() <= pair[1].top() + 0.01, "{width}×{height}, {row}: {parts:?}");
                }
                assert!(parts.iter().all(|part| area.expand(0.01).contains_rect(*part) && part.height() > 5.0));
            }
        }
    }
}
