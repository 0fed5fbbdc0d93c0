//! Columns that are scrolled.

use eframe::egui::{Id, ScrollArea, Ui};

/// Shows what `add` draws over the whole height that there is, and scrolls it. At the right `bar` is left free: for the scroll bar, which
/// floats, and for half a number at the end of an axis.
pub fn scrolled<R>(
    ui: &mut Ui,
    id: impl std::hash::Hash + std::fmt::Debug,
    bar: f32,
    add: impl FnOnce(&mut Ui) -> R,
) -> R {
    scroll(ui, ScrollArea::vertical().id_salt(id), bar, add)
}

/// The same of what is shown from its beginning whenever `number` is another one.
pub fn scrolled_anew<R>(ui: &mut Ui, id: &'static str, number: u64, bar: f32, add: impl FnOnce(&mut Ui) -> R) -> R {
    let key = Id::unique((id, "scrolled"));
    let last = ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or(key, number), number));
    let area = ScrollArea::vertical().id_salt(id);
    scroll(ui, if last == number { area } else { area.vertical_scroll_offset(0.0) }, bar, add)
}

fn scroll<R>(ui: &mut Ui, area: ScrollArea, bar: f32, add: impl FnOnce(&mut Ui) -> R) -> R {
    let area = area.auto_shrink(false);
    let shown = area.show(ui, |ui| {
        ui.set_max_width(ui.available_width() - bar);
        add(ui)
    });
    shown.inner
}
