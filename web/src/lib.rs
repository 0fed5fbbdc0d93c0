//! The functions that `page/index.html` and `page/worker.js` call: the window in a page, and the workers of that page.
#![cfg(target_arch = "wasm32")]

use wasm_bindgen::prelude::wasm_bindgen;

/// Opens the window in the page's canvas.
#[wasm_bindgen]
pub fn open() -> Result<(), String> {
    squeezefilm::gui::open(None, None, None, (None, None)).map_err(|error| error.to_string())
}

/// The content of the window, as JSON.
#[wasm_bindgen]
pub fn told() -> String {
    squeezefilm::platform::window::told()
}

/// Makes this worker do the work that its page sends.
#[wasm_bindgen]
pub fn serve() {
    squeezefilm::job::serve::start();
}
