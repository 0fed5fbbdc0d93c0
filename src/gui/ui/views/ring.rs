//! The whole ring beside the unrolled wave, with the same exaggeration of heights and the colours of the pressure maps. All waves are
//! shown. It can be turned with the mouse or, when it has the keyboard focus, with the arrow keys. The geometry is in `derived::ring`.

use super::frame::Frame;
use super::pointer::named;
use super::wave::TOOTH;
use crate::gui::command::Command;
use crate::gui::derived::format::times;
use crate::gui::derived::ring::{DrawnFace, DrawnPart, Orbit, Ring};
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::hint::describe;
use crate::gui::ui::paint::{Axes, PlotStyle, pressure_colour};
use crate::gui::ui::theme;
use crate::problem::Motor;
use eframe::egui::epaint::{Mesh, Shape};
use eframe::egui::{self, CursorIcon, EventFilter, Key, Rect, Response, Sense, Stroke, StrokeKind, Ui, pos2};
use std::f32::consts::PI;

const NAME: &str = "The whole ring: drag to turn it, double-click to put it back";
/// Further description for screen readers.
const ABOUT: &str = "All waves of the ring, with teeth coloured by the pressure of the film. The rotor is lifted off, and the ring is drawn wider than it \
     is. Arrow keys turn it while it has the keyboard, Home puts it back.";
/// Angle by which a key turns the ring \[rad\].
const STEP: f64 = 0.1;

/// Draws the ring into `rect`, to match the unrolled wave on `axes`.
pub(super) fn draw(
    ui: &Ui,
    style: &PlotStyle,
    rect: Rect,
    (shown, underside, axes): (&Frame<'_, Motor>, &[[f64; 2]], &Axes),
    cx: &DrawContext<'_>,
) {
    let orbit = cx.state.view.orbit;
    let ring = Ring {
        motor: shown.of,
        recording: shown.recording,
        place: shown.place,
        cycles: shown.view.cycles,
        lines: &shown.lines,
        underside,
        heights: axes.y,
        tooth_height: f64::from(TOOTH) * (axes.y[1] - axes.y[0]),
        exaggeration: axes.exaggeration(),
        followed: shown.tooth,
    };
    let style = &style.within(rect.expand2(egui::vec2(0.0, 2.0 * style.row)));
    style.painter.rect_filled(rect, 2.0, style.palette.canvas);
    let title = format!("Ring, vertical {}", times(ring.exaggeration));
    style.title(rect, "Ring", &[&title, "Ring"], &[]);
    let scale = 0.48 * f64::from(rect.width().min(rect.height())) / ring.reach();
    let faces = ring.faces(orbit);
    style.painter.add(Shape::mesh(mesh(&faces, style, (rect, scale), shown.ranges.pressure)));

    let response = named(ui, rect, NAME, Sense::click_and_drag());
    describe(&response, || ABOUT.to_owned());
    if response.has_focus() {
        style.painter.rect_stroke(rect, 2.0, Stroke::new(1.0, style.palette.accent), StrokeKind::Inside);
    }
    if let Some(turned) = turned(ui, &response, orbit) {
        cx.push(Command::Orbit(turned));
    }
    response.on_hover_and_drag_cursor(CursorIcon::Grab);
}

/// Orbit after the input of mouse and keyboard in this frame; `None` if there was none.
fn turned(ui: &Ui, response: &Response, orbit: Orbit) -> Option<Orbit> {
    if response.double_clicked() {
        return Some(Orbit::default());
    }
    if response.dragged() {
        // Dragging from one side to the other is half a turn, so that the front follows the pointer.
        let part = response.drag_delta() * PI / response.rect.size();
        return Some(orbit.turned(-f64::from(part.x), f64::from(part.y)));
    }
    if !response.has_focus() {
        return None;
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    ui.input(|input| {
        let steps = |more: Key, less: Key| input.num_presses(more) as f64 - input.num_presses(less) as f64;
        let [along, up] = [steps(Key::ArrowLeft, Key::ArrowRight), steps(Key::ArrowUp, Key::ArrowDown)];
        let moved = (along != 0.0 || up != 0.0).then(|| orbit.turned(STEP * along, STEP * up));
        moved.or(input.key_pressed(Key::Home).then(Orbit::default))
    })
}

/// The faces, round the middle of `rect`, with `scale` points per contact radius. `range` is the pressures of the first and last colour.
fn mesh(faces: &[DrawnFace], style: &PlotStyle, (rect, scale): (Rect, f64), range: [f64; 2]) -> Mesh {
    let coloured = pressure_colour(range);
    let palette = &style.palette;
    let [stator, rotor] = [palette.stator, palette.rotor].map(|colour| style.solid(colour));
    let mut mesh = Mesh::default();
    mesh.reserve_vertices(4 * faces.len());
    mesh.reserve_triangles(2 * faces.len());
    for face in faces {
        let lit = |colour| [theme::lit(colour, face.light as f32); 2];
        let [from, to] = match face.part {
            DrawnPart::Film(ends) => ends.map(&coloured),
            DrawnPart::Stator => lit(stator),
            DrawnPart::Followed => lit(palette.accent),
            DrawnPart::Rotor => lit(rotor),
            DrawnPart::Mark => [palette.canvas; 2],
        };
        let first = mesh.vertices.len() as u32;
        for ([right, up], colour) in face.corners.into_iter().zip([from, to, to, from]) {
            let at = pos2((right * scale) as f32, (-up * scale) as f32);
            mesh.colored_vertex(rect.center() + at.to_vec2(), colour);
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    mesh
}
