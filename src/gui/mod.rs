//! The window, an interactive explorer: it shows new results while a slider moves.
//!
//! `app` connects the window to eframe. `state` holds everything that the window knows, and `derived` computes from runs what is drawn.
//! `ui` reads the state, draws, and pushes commands; `update` carries them out, and never draws. The solver is reached only through
//! [`crate::job`]; the window's thread never solves.

pub mod app;
pub mod command;
pub mod derived;
pub mod state;
pub mod ui;
pub mod update;

use crate::fidelity::Fidelity;
use crate::platform::window;
use command::Command;
use state::document::Document;
use state::link::Link;
use std::path::PathBuf;
use std::time::Duration;
use update::platform::Platform;
use update::storage::{NOT_KEPT, StorageFile, StoragePlace, beside};

/// Opens the window with a scene, or with the state of the last window, and returns when it is closed. `lessons` is a folder of lessons to
/// add to the built-in ones, `link` the tab or lesson step to show. `fidelity` and `budget` set how exactly edits are solved, and how long
/// a solve may take.
///
/// # Errors
/// If there is no display, or no way to draw on it.
pub fn open(
    opened: Option<Document>,
    lessons: Option<PathBuf>,
    link: Option<Link>,
    (fidelity, budget): (Option<Fidelity>, Option<Duration>),
) -> Result<(), eframe::Error> {
    // Without a file of its own it keeps nothing: another window's is left alone.
    let claim = |folder: PathBuf| StorageFile::claim(&folder).map_err(|error| format!("{}: {error}", folder.display()));
    let (file, storage, fault) = match window::storage_folder().map(claim) {
        Some(Ok(file)) => {
            let place = StoragePlace::File(file.path.clone());
            (Some(file), place, None)
        }
        Some(Err(error)) => (None, StoragePlace::Nowhere, Some(error)),
        None => (None, StoragePlace::Browser, None),
    };
    let of_eframe = file.as_ref().map(|file| beside(&file.path));
    let start = move |context: &eframe::CreationContext<'_>| {
        let platform = Platform { storage, ..Platform::default() };
        let mut app = app::App::on_platform(context, opened, platform)?;
        if let Some(fault) = fault {
            app.updater.state.fail(format!("{NOT_KEPT}: {fault}"));
        }
        if let Some(folder) = lessons {
            app.updater.load_lessons(&folder);
        }
        if let Some(link) = link {
            app.updater.follow(link);
        }
        if let Some(target) = fidelity {
            app.carry_out(Command::Use(target, app.state().document.scene().numerics()));
        }
        if budget.is_some() {
            app.carry_out(Command::Budget(budget));
        }
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    window::run(of_eframe, Box::new(start))
}
