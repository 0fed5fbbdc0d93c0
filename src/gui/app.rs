//! The application: between the frames of eframe it takes what has happened, carries out commands, and draws.

use super::command::Command;
use super::state::document::{Document, Next};
use super::state::lessons::LessonState;
use super::state::window::State;
use super::ui::context::DrawContext;
use super::ui::modals::glossary::is_searched;
use super::ui::{keys, layout, theme};
use super::update::platform::Platform;
use super::update::updater::Updater;
use crate::scene::Scene;
use eframe::egui;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Unsaved work is written away this often.
const SAVE_INTERVAL: Duration = Duration::from_secs(2);

/// The application.
pub struct App {
    updater: Updater,
    /// Text is being typed, other than what is looked for in the glossary.
    typing: bool,
    last_frame: Option<Instant>,
}

impl App {
    /// The application on `scene`, or where the last window was left, or on the fundamental case.
    ///
    /// # Errors
    /// If the solver's thread cannot be started.
    pub fn new(
        context: &eframe::CreationContext<'_>,
        opened: Option<(Scene, Option<PathBuf>)>,
    ) -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        Self::on_platform(context, opened, Platform::default())
    }

    /// As [`Self::new`], with a clock and file dialogs of the caller's.
    ///
    /// # Errors
    /// If the solver's thread cannot be started.
    pub fn on_platform(
        context: &eframe::CreationContext<'_>,
        opened: Option<(Scene, Option<PathBuf>)>,
        platform: Platform,
    ) -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        theme::install(&context.egui_ctx);
        let state = restored(context.storage, opened)?;
        let updater = Updater::start(&context.egui_ctx, state, platform)?;
        Ok(Self { updater, typing: false, last_frame: None })
    }

    /// All that the window knows.
    pub fn state(&self) -> &State {
        &self.updater.state
    }

    /// Adds the lessons of a folder; says what is wrong with those that cannot be read.
    pub fn load_lessons(&mut self, folder: &Path) {
        self.updater.load_lessons(folder);
    }

    /// Escape closes the tour, then the glossary: after whatever is over them, and after a text that is being typed.
    fn escape(&self, ctx: &egui::Context) -> Option<Command> {
        let state = self.state();
        let close = match (state.lessons.tour, &state.lessons.glossary) {
            (Some(_), _) => Command::Tour(None),
            (None, Some(_)) => Command::Glossary(false),
            (None, None) => return None,
        };
        let other = self.covered() || egui::Popup::is_any_open(ctx);
        let pressed = !other && ctx.input_mut(|input| input.consume_key(egui::Modifiers::NONE, egui::Key::Escape));
        pressed.then_some(close)
    }

    /// Whether plain keys belong to something that is in the way, or to a text.
    fn covered(&self) -> bool {
        self.state().modal.is_some() || self.state().shortcuts || self.typing
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.updater.drain();
        let now = self.updater.now();
        // A frame after a pause must not leap.
        let elapsed = self.last_frame.map_or(0.0, |last| (now - last).as_secs_f64().min(0.1));
        if self.updater.animate(elapsed) {
            ctx.request_repaint_after(Duration::from_millis(16));
        }
        self.last_frame = Some(now);
        self.updater.follow_torque();
        let mut commands: Vec<Command> = self.escape(ctx).into_iter().collect();
        keys::pressed(ctx, self.covered(), self.state().view.tab, &mut commands);
        let dropped = ctx.input(|input| input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect());
        let dropped: Vec<PathBuf> = dropped;
        let named = dropped.into_iter().filter(|path| !path.as_os_str().is_empty());
        commands.extend(named.map(|path| Command::Proceed(Next::File(path))));
        let State { lessons, document, quitting, .. } = self.state();
        if ctx.input(|input| input.viewport().close_requested())
            && !quitting
            && lessons.student_document(document).is_dirty()
        {
            ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            commands.push(Command::Proceed(Next::Quit));
        }
        commands.into_iter().for_each(|command| self.updater.carry_out(command));
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        if self.updater.state.observe() {
            ctx.request_repaint();
        }
        let cx = DrawContext::new(self.state(), self.updater.now());
        layout::show(ui, &cx);
        let commands = cx.into_commands();
        self.typing = ctx.text_edit_focused() && !is_searched(&ctx);
        if !commands.is_empty() {
            // What a command changes is drawn soon.
            ctx.request_repaint();
        }
        if commands.iter().any(|command| !matches!(command, Command::Hover(_))) {
            // And written away.
            ctx.request_repaint_after(SAVE_INTERVAL + Duration::from_millis(500));
        }
        commands.into_iter().for_each(|command| self.updater.carry_out(command));
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        // Seen between panels where their edges fall between pixels.
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        let state = self.state();
        // The next window begins with the student's own scene, not with that of a lesson.
        let document = state.lessons.student_document(&state.document);
        storage.set_string("scene", document.scene().to_toml());
        storage.set_string("saved", document.saved().to_toml());
        storage.set_string("path", document.path().map(|p| p.display().to_string()).unwrap_or_default());
        storage.set_string("lessons", state.lessons.progress_text());
        storage.set_string("pins", state.pins.stored());
        storage.set_string("tour", "seen".to_owned());
        let recent: Vec<String> = state.recent.iter().map(|path| path.display().to_string()).collect();
        storage.set_string("recent", recent.join("\n"));
        storage.set_string("fidelity", state.document.target().to_string());
        storage.set_string("theme", if state.dark { "dark" } else { "light" }.to_owned());
        storage.set_string("lecture", state.lecture.to_string());
    }

    fn auto_save_interval(&self) -> Duration {
        SAVE_INTERVAL
    }
}

/// The state that the last window was left in; with the scene that was `opened`, if one was.
fn restored(
    storage: Option<&dyn eframe::Storage>,
    opened: Option<(Scene, Option<PathBuf>)>,
) -> Result<State, Box<dyn std::error::Error + Send + Sync>> {
    let stored = |key: &str| storage.and_then(|storage| storage.get_string(key));
    // The tour is for whoever has never seen the window, and not over a file that was asked for.
    let first_start = opened.is_none() && storage.is_some() && stored("tour").is_none() && stored("scene").is_none();
    let document = match opened {
        Some((scene, path)) => Document::opened(scene, path),
        None => match last_document(&stored) {
            Some(document) => document,
            None => Document::fundamental()?,
        },
    };
    let target = stored("fidelity").and_then(|name| name.parse().ok());
    let mut state = State::new(target.into_iter().fold(document, Document::with_target));
    state.lessons = LessonState::new(stored("lessons"));
    state.recent = stored("recent").map(|text| text.lines().map(PathBuf::from).collect()).unwrap_or_default();
    state.dark = stored("theme").is_none_or(|theme| theme != "light");
    state.lecture = stored("lecture").is_some_and(|size| size == "true");
    state.lessons.tour = first_start.then_some(0);
    // What cannot be read is told, and the rest is there.
    if let Some(Err(fault)) = stored("pins").map(|text| state.pins.restore(&text)) {
        state.fail(format!("Not all pinned runs of the last window can be read.\n{fault}"));
    }
    Ok(state)
}

/// The scene that the last window was left with.
fn last_document(stored: &dyn Fn(&str) -> Option<String>) -> Option<Document> {
    let parse = |key: &str| Scene::from_toml(&stored(key)?, "the last window").ok();
    let scene = parse("scene")?;
    let saved = parse("saved").unwrap_or_else(|| scene.clone());
    let path = stored("path").filter(|path| !path.is_empty()).map(PathBuf::from);
    Some(Document::restored(scene, saved, path))
}
