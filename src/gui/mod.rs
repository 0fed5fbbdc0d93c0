//! The window: an explorer that answers while the slider moves.
//!
//! `app` is the glue to eframe. `state` is all that the window knows, and `derived` what is computed from runs to be drawn.
//! `ui` reads the state, draws, and pushes commands; `update` carries them out, and never draws. The solver is reached through
//! [`crate::job`] alone; the window's thread never solves.

pub mod app;
pub mod command;
pub mod derived;
pub mod state;
pub mod ui;
pub mod update;

use eframe::egui;
use state::document::Document;
use std::path::PathBuf;
use update::platform::Platform;
use update::storage::StorageFile;

/// Opens the window on a scene, or where the last one was left, and returns when it is closed. `lessons`: a folder of them,
/// beside the built-in ones. `place`: the lesson and the step that it opens at, from 0.
///
/// # Errors
/// If there is no display, or no way to draw on it.
pub fn open(
    opened: Option<Document>,
    lessons: Option<PathBuf>,
    place: Option<[usize; 2]>,
) -> Result<(), eframe::Error> {
    // Without a file of its own it keeps nothing: another window's is left alone.
    let file = eframe::storage_dir("squeezefilm").and_then(|folder| StorageFile::claim(&folder).ok());
    let storage = file.as_ref().map(|file| file.path().to_owned());
    let options = eframe::NativeOptions {
        renderer: eframe::Renderer::Glow,
        // Costs a software renderer more than it is worth: nothing in here is a gradient over many pixels.
        dithering: false,
        viewport: egui::ViewportBuilder::default()
            .with_title("squeezefilm")
            .with_app_id("squeezefilm")
            .with_inner_size([1400.0, 900.0])
            // Fits a screen of 1366 × 768 at 125 %, with its bars.
            .with_min_inner_size([800.0, 520.0])
            .with_drag_and_drop(true),
        persistence_path: storage.clone(),
        // The menu that winit makes on macOS ends the program at ⌘Q and asks nobody: without it ⌘Q is a shortcut of the window.
        #[cfg(target_os = "macos")]
        event_loop_builder: Some(Box::new(|builder| {
            use winit::platform::macos::EventLoopBuilderExtMacOS;
            builder.with_default_menu(false);
        })),
        ..Default::default()
    };
    let start = |context: &eframe::CreationContext<'_>| {
        let platform = Platform { storage, ..Platform::default() };
        let mut app = app::App::on_platform(context, opened, platform)?;
        if let Some(folder) = lessons {
            app.load_lessons(&folder);
        }
        if let Some([lesson, step]) = place {
            app.open_lesson(lesson, step);
        }
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    eframe::run_native("squeezefilm", options, Box::new(start))
}
