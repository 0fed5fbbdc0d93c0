//! What is computed once and drawn many times.

use eframe::egui::{Context, Id, Ui};
use std::sync::Arc;

/// What `make` returns for `key`, kept under `name` as long as the key stays the same.
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
        *data.get_temp_mut_or_default::<usize>(made_id()) += 1;
    });
    fresh
}

fn made_id() -> Id {
    Id::unique("squeezefilm, made")
}

/// How often something was computed: a redraw of what has not changed computes nothing, which a test asks for.
pub fn made(ctx: &Context) -> usize {
    ctx.data(|data| data.get_temp(made_id())).unwrap_or_default()
}
