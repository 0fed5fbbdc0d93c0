//! Memoised results for drawing: computed once, drawn many times.

use eframe::egui::{Context, Id, Ui};
use std::sync::Arc;

const MADE: &str = "squeezefilm, made";

/// The result of `make`, cached under `name` until `key` changes.
pub fn once<K: PartialEq + Send + Sync + 'static, T: Send + Sync + 'static>(
    ui: &Ui,
    name: &str,
    key: K,
    make: impl FnOnce() -> T,
) -> Arc<T> {
    let id = Id::unique(("squeezefilm", name));
    let known = ui.data(|data| data.get_temp::<Arc<(K, Arc<T>)>>(id)).filter(|known| known.0 == key);
    if let Some(known) = known {
        return Arc::clone(&known.1);
    }
    let fresh = Arc::new(make());
    ui.data_mut(|data| {
        data.insert_temp(id, Arc::new((key, Arc::clone(&fresh))));
        *data.get_temp_mut_or_default::<usize>(Id::unique(MADE)) += 1;
    });
    fresh
}

/// Number of computations so far: tests check that a redraw without a change adds none.
pub fn made(ctx: &Context) -> usize {
    ctx.data(|data| data.get_temp(Id::unique(MADE))).unwrap_or_default()
}
