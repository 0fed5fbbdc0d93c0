//! Columns that are scrolled.

use eframe::egui::{ScrollArea, Ui};

/// Shows what `add` draws over the whole height that there is, and scrolls it. At the right `bar` is left free: for the scroll bar, which
/// floats, and for half a number at the end of an axis.
pub fn scrolled<R>(
    ui: &mut Ui,
    id: impl std::hash::Hash + std::fmt::Debug,
    bar: f32,
    add: impl FnOnce(&mut Ui) -> R,
) -> R {
    let area = ScrollArea::vertical().id_salt(id).auto_shrink(false);
    let shown = area.show(ui, |ui| {
        ui.set_max_width(ui.available_width() - bar);
        add(ui)
    });
    shown.inner
}
