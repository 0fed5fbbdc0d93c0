//! A stop of the tour: a short text beside the part of the window that is highlighted.

use crate::gui::command::{Command, LessonCommand};
use crate::gui::state::tour::STOPS;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::{highlight, keys};
use eframe::egui::{self, Align, Id, Layout, Order, Rect, RichText, Vec2, pos2, vec2};

const WIDTH: f32 = 300.0;
/// Greatest height of the callout, used to place it before it is drawn.
const HEIGHT: f32 = 190.0;
/// Distance between the callout and the part.
const GAP: f32 = 14.0;

/// The place for a callout of `size` beside `part`: inside `room`, covering as little of the part as possible.
pub fn beside(part: Rect, size: Vec2, room: Rect) -> Rect {
    let room = room.shrink(6.0);
    let level = part.center().y - 0.5 * size.y;
    let middle = part.center().x - 0.5 * size.x;
    let corners = [
        pos2(middle, part.bottom() + GAP),
        pos2(part.right() + GAP, level),
        pos2(part.left() - GAP - size.x, level),
        pos2(middle, part.top() - GAP - size.y),
    ];
    let inside = |corner: egui::Pos2| {
        let most = (room.max - size).max(room.min);
        Rect::from_min_size(corner.clamp(room.min, most), size)
    };
    let covered = |rect: &Rect| {
        let common = rect.intersect(part);
        if common.is_positive() { common.area() } else { 0.0 }
    };
    corners.map(inside).into_iter().min_by(|a, b| covered(a).total_cmp(&covered(b))).unwrap_or(part)
}

/// Shows a stop of the tour.
pub fn show(ctx: &egui::Context, stop: usize, cx: &DrawContext<'_>) {
    let Some(shown) = STOPS.get(stop) else { return };
    let room = ctx.content_rect();
    let part = highlight::place(ctx, shown.place).unwrap_or(Rect::from_center_size(room.center(), Vec2::ZERO));
    let width = WIDTH.min(0.8 * room.width());
    let id = Id::unique("tour");
    // The height with which it was drawn, if it has been drawn.
    let last = ctx.data(|data| data.get_temp::<Vec2>(id.with(stop)));
    let place = beside(part, last.unwrap_or(vec2(width + 26.0, HEIGHT)), room);
    let area = egui::Area::new(id).order(Order::Foreground).fixed_pos(place.min).constrain(true).show(ctx, |ui| {
        let line = egui::Stroke::new(1.5, cx.colours.accent);
        egui::Frame::popup(ui.style()).stroke(line).inner_margin(12).show(ui, |ui| {
            ui.set_width(width);
            ui.horizontal(|ui| {
                ui.label(RichText::new(shown.title).heading().strong());
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.label(RichText::new(format!("{} of {}", stop + 1, STOPS.len())).color(cx.colours.quiet));
                });
            });
            ui.add_space(4.0);
            ui.add(egui::Label::new(keys::in_text(shown.text)).wrap());
            ui.add_space(8.0);
            ui.horizontal(|ui| {
                let last = stop + 1 == STOPS.len();
                if !last && ui.button("Skip the tour").clicked() {
                    cx.push(Command::Tour(None));
                }
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let text = if last { "Start lesson 1" } else { "Next" };
                    let lit = egui::Button::new(RichText::new(text).strong()).fill(ui.visuals().selection.bg_fill);
                    cx.on_click(&ui.add(lit).on_hover_text("Enter"), LessonCommand::GoOn);
                    if last && ui.button("Close").clicked() {
                        cx.push(Command::Tour(None));
                    }
                    if stop > 0 && ui.button("Back").clicked() {
                        cx.push(Command::Tour(Some(stop - 1)));
                    }
                });
            });
        });
    });
    let size = area.response.rect.size();
    if last != Some(size) {
        ctx.data_mut(|data| data.insert_temp(id.with(stop), size));
        ctx.request_repaint();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_callout_covers_nothing_of_what_it_is_about() {
        let size = vec2(326.0, 190.0);
        for room in [vec2(1400.0, 900.0), vec2(1024.0, 700.0), vec2(758.0, 518.0)] {
            let room = Rect::from_min_size(egui::Pos2::ZERO, room);
            let (w, h) = (room.width(), room.height());
            // The parameters, the headline, a menu; and the wave, which leaves room below it.
            for part in [
                Rect::from_min_max(pos2(0.0, 25.0), pos2(0.3 * w, h - 50.0)),
                Rect::from_min_max(pos2(0.72 * w, 30.0), pos2(w, 160.0)),
                Rect::from_min_max(pos2(150.0, 0.0), pos2(220.0, 24.0)),
                Rect::from_min_max(pos2(0.31 * w, 80.0), pos2(0.7 * w, 300.0)),
            ] {
                let place = beside(part, size, room);
                assert!(room.contains_rect(place), "{room:?} {part:?}");
                assert!(!place.intersect(part).is_positive(), "{room:?} {part:?}: {place:?}");
            }
        }
    }
}
