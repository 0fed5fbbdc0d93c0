//! Taps on a touchpad: the button is pressed and released within one frame.

use eframe::egui::{Context, Event, Plugin, RawInput};

/// Defers the events after a press to the next frame if they include the release: a slider ignores a drag that ends in the frame that it
/// begins in (emilk/egui#5770).
#[derive(Default)]
pub struct Taps(Vec<Event>);

impl Plugin for Taps {
    fn debug_name(&self) -> &'static str {
        "taps"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        let is = |event: &Event, down: bool| matches!(event, Event::PointerButton { pressed, .. } if *pressed == down);
        input.events.splice(0..0, self.0.drain(..));
        let from = input.events.iter().position(|event| is(event, true)).unwrap_or(input.events.len());
        if let Some(after) = input.events[from..].iter().position(|event| is(event, false)) {
            self.0 = input.events.split_off(from + after);
            ctx.request_repaint();
        }
    }
}
