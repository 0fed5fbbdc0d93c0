//! The right panel for a held plate: the present numbers of its film.

use super::results::{headline, number, section, shown};
use crate::estimate::Estimate;
use crate::gui::derived::format::{time, uncertain};
use crate::gui::state::hold::HoldState;
use crate::gui::ui::context::DrawContext;
use crate::gui::ui::parts::scrolled;
use crate::hold::leak_time;
use eframe::egui;

/// Shows the readings of `hold`.
pub fn show(ui: &mut egui::Ui, hold: &HoldState, cx: &DrawContext<'_>) {
    let (plate, now) = (&hold.plate, hold.shown());
    let (reading, ambient) = (now.reading, plate.gas.ambient_pressure);
    let (unit, area) = if plate.is_strip() { ("N/m", "Load / (p_a · length)") } else { ("N", "Load / (p_a · area)") };
    scrolled(ui, "held", 8.0, |ui| {
        ui.spacing_mut().item_spacing.y = 4.0;
        ui.add_space(8.0);
        cx.note(
            ui,
            "The plate at this moment, held or let go. The results of the vibrating plate are beside the other tabs.",
        );
        ui.add_space(4.0);
        headline(ui, "", "Force", &uncertain(Estimate { value: reading.force, error: reading.error }), unit);
        let free = hold.free.is_some();
        let mean = if hold.free == Some(true) { "; mean over a cycle of the vibration" } else { "" };
        cx.note(ui, format!("force of the film on the plate, positive if it pushes{mean}"));
        ui.add_space(4.0);
        let [least, most] = hold.force_range;
        number(ui, cx, "Since it was at rest", &format!("{} … {}", shown(least), shown(most)), unit);
        number(ui, cx, area, &shown(reading.ratio), "");
        section(ui, "Gap");
        number(ui, cx, if free { "Gap, mean" } else { "Held gap" }, &shown(reading.gap * 1e6), "µm");
        number(ui, cx, "Mean gap", &shown(plate.mean_gap * 1e6), "µm");
        section(ui, "Film pressure");
        number(ui, cx, "Mean pressure", &shown(reading.mean_pressure * 1e-3), "kPa");
        let highest = now.pressure.iter().copied().fold(reading.mean_pressure, f64::max);
        number(ui, cx, "Highest pressure", &shown(highest * 1e-3), "kPa");
        number(ui, cx, "Boyle", &shown(ambient * plate.mean_gap / reading.gap * 1e-3), "kPa");
        cx.note(ui, "if no gas had flowed in or out since the mean gap");
        section(ui, "At this gap");
        number(ui, cx, "Leak time", &time(leak_time(plate, reading.gap)), "");
        number(ui, cx, "Knudsen number Kn", &shown(plate.gas.mean_free_path / reading.gap), "");
        ui.add_space(12.0);
    });
}
