//! The window: an explorer that answers while the slider moves.
//!
//! `app` drains the solver's events and carries out commands; panels and views only read state, draw, and push commands.
//! The solver is reached through [`crate::job`] alone; the window's thread never solves.

pub mod app;
pub mod command;
pub mod comparison;
pub mod dialogs;
pub mod document;
pub mod edit;
pub mod exporting;
pub mod holding;
pub mod keys;
pub mod lessons;
pub mod measured;
pub mod merits;
pub mod modal;
pub mod panels;
pub mod pinned;
pub mod spot;
pub mod starting;
pub mod state;
pub mod sweeping;
pub mod tabs;
pub mod theme;
pub mod views;
pub mod world;

use crate::scene::Scene;
use eframe::egui;
use std::path::PathBuf;

/// Opens the window on a scene, or where the last one was left, and returns when it is closed. `lessons`: a folder of them,
/// beside the built-in ones.
///
/// # Errors
/// If there is no display, or no way to draw on it.
pub fn open(opened: Option<(Scene, Option<PathBuf>)>, lessons: Option<PathBuf>) -> Result<(), eframe::Error> {
    let options = eframe::NativeOptions {
        renderer: eframe::Renderer::Glow,
        // Costs a software renderer more than it is worth: nothing in here is a gradient over many pixels.
        dithering: false,
        viewport: egui::ViewportBuilder::default()
            .with_title("squeezefilm")
            .with_app_id("squeezefilm")
            .with_inner_size([1400.0, 900.0])
            .with_min_inner_size([900.0, 600.0])
            .with_drag_and_drop(true),
        ..Default::default()
    };
    let start = |context: &eframe::CreationContext<'_>| {
        let mut app = app::App::new(context, opened)?;
        if let Some(folder) = lessons {
            app.load_lessons(&folder);
        }
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    eframe::run_native("squeezefilm", options, Box::new(start))
}
