//! The window in a page, and the workers of that page: what `page/index.html` and `page/worker.js` call.
#![cfg(target_arch = "wasm32")]

use wasm_bindgen::prelude::wasm_bindgen;

/// Opens the window in the page's canvas.
#[wasm_bindgen]
pub fn open() -> Result<(), String> {
    squeezefilm::gui::open(None, None, None, (None, None)).map_err(|error| error.to_string())
}

/// What the window shows, as JSON.
#[wasm_bindgen]
pub fn told() -> String {
    squeezefilm::platform::window::told()
}

/// Makes this worker do what its page asks for.
#[wasm_bindgen]
pub fn serve() {
    squeezefilm::job::serve::start();
}
