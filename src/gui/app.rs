//! The application: in each frame of eframe it handles what has happened since the last one, carries out commands, and draws.

use super::command::Command;
use super::state::dialogs::Purpose;
use super::state::document::{Document, Next};
use super::state::window::State;
use super::ui::context::DrawContext;
use super::ui::keys::{self, Obstacles, Scope};
use super::ui::modals::glossary::is_searched;
use super::ui::parts::FOLLOWED;
use super::ui::taps::Taps;
use super::ui::{layout, theme};
use super::update::platform::Platform;
use super::update::storage::{Entries, NOT_KEPT, StoragePlace, UNSAVED, keep, read, write};
use super::update::updater::Updater;
use crate::digits::parse_duration;
use crate::platform::Instant;
use crate::platform::window::{Parent, dropped, fragment, mirror, prefers_dark};
use crate::scene::{Scene, show_text};
use eframe::egui;
use eframe::egui::accesskit::{Action, ActionRequest, TreeId};
use std::path::PathBuf;
use std::time::Duration;

/// Time between two frames of an animation: a little less than a sixtieth of a second, because waking up takes time as well.
const FRAME: Duration = Duration::from_millis(15);

/// Interval at which unsaved work is stored.
const SAVE_INTERVAL: Duration = Duration::from_secs(2);

/// The application.
pub struct App {
    /// Carries out commands and owns the state.
    pub updater: Updater,
    /// Whether text is being typed in any field except the search field of the glossary.
    typing: bool,
    /// Commands given while text was being typed, carried out once the text is committed.
    after_text: Vec<Command>,
    last_frame: Option<Instant>,
    /// Whether anything has happened since the last save to storage.
    unwritten: bool,
    /// Fragment of the page's address, after the `#`, when it was last read.
    address: String,
    /// Title that the window has.
    title: String,
    /// The widget that had the keyboard focus when the last frame began.
    focused: Option<egui::Id>,
    /// What the last save wrote into a file.
    kept: Option<Entries>,
    /// Why the last save failed; it is reported once.
    fault: Option<String>,
}

impl App {
    /// The application with the scene `opened`, or else the scene of the last window, or else the fundamental case.
    pub fn on_platform(
        context: &eframe::CreationContext<'_>,
        opened: Option<Document>,
        mut platform: Platform,
    ) -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        theme::install(&context.egui_ctx);
        context.egui_ctx.add_plugin(Taps::default());
        mirror(&context.egui_ctx);
        let (state, next) = restored(context.storage, opened, &mut platform.storage)?;
        let mut updater = Updater::start(&context.egui_ctx, state, platform, Parent::of(context))?;
        next.into_iter().for_each(|document| updater.carry_out(Command::Proceed(Next::Given(Box::new(document)))));
        let (after_text, address, title) = (Vec::new(), String::new(), String::new());
        let (last_frame, focused, kept, fault) = (None, None, None, None);
        Ok(Self {
            updater,
            typing: false,
            after_text,
            last_frame,
            unwritten: false,
            address,
            title,
            focused,
            kept,
            fault,
        })
    }

    /// All that the window knows.
    pub fn state(&self) -> &State {
        &self.updater.state
    }

    /// Carries out a command as if a panel or a key had given it.
    pub fn carry_out(&mut self, command: Command) {
        self.unwritten |= !matches!(command, Command::Hover(_));
        self.updater.carry_out(command);
    }

    /// Escape closes the tour, then the glossary, but only when nothing is open over them and no text is being typed.
    fn escape(&self, ctx: &egui::Context) -> Option<Command> {
        let state = self.state();
        let close = match (state.lessons.tour, &state.lessons.glossary) {
            (Some(_), _) => Command::Tour(None),
            (None, Some(_)) => Command::Glossary(false),
            (None, None) => return None,
        };
        let Obstacles { modal, typing } = self.obstacles();
        let other = modal || typing || egui::Popup::is_any_open(ctx);
        let pressed = !other && ctx.input_mut(|input| input.consume_key(egui::Modifiers::NONE, egui::Key::Escape));
        pressed.then_some(close)
    }

    /// Scrolls to the widget that has got the keyboard focus since the last frame, if its middle is out of sight: egui moves the focus to
    /// widgets that are scrolled away, too.
    fn follow_focus(&mut self, ctx: &egui::Context) {
        let focused = ctx.memory(|memory| memory.focused());
        let noted = egui::Id::unique(FOLLOWED);
        if std::mem::replace(&mut self.focused, focused) == focused {
            return ctx.data_mut(|data| data.remove::<egui::Id>(noted));
        }
        let hidden = |found: &egui::Response| !found.interact_rect.contains(found.rect.center());
        if let Some(found) = focused.and_then(|id| ctx.read_response(id)).filter(hidden) {
            // The request is the one that a screen reader makes: the scroll areas around the widget follow it, except for tables, which get
            // a note.
            ctx.data_mut(|data| data.insert_temp(noted, found.id));
            let (action, target_node) = (Action::ScrollIntoView, found.id.accesskit_id());
            let request = ActionRequest { action, target_tree: TreeId::ROOT, target_node, data: None };
            ctx.input_mut(|input| input.events.push(egui::Event::AccessKitActionRequest(request)));
        }
    }

    fn obstacles(&self) -> Obstacles {
        Obstacles { modal: self.state().modal.is_some() || self.state().shortcuts, typing: self.typing }
    }

    /// Carries out `commands`: at once, or a frame or two later if text is being typed, because the text has to be committed first.
    fn after_text(&mut self, ctx: &egui::Context, commands: Vec<Command>) {
        if commands.is_empty() || !ctx.text_edit_focused() {
            commands.into_iter().for_each(|command| self.carry_out(command));
        } else {
            self.after_text.extend(commands);
            ctx.request_repaint();
        }
    }

    /// Carries out the commands that waited for typed text; drops them if the text was refused.
    fn text_taken(&mut self, ctx: &egui::Context, asked: &[&'static str]) {
        if self.after_text.is_empty() || ctx.text_edit_focused() {
            return;
        }
        let commands = std::mem::take(&mut self.after_text);
        if asked.iter().all(|key| self.state().rejected.of(key).is_none()) {
            commands.into_iter().for_each(|command| self.carry_out(command));
        }
        ctx.request_repaint();
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.updater.drain();
        let now = self.updater.now();
        // After a pause the animation must not jump.
        let elapsed = self.last_frame.map_or(0.0, |last| (now - last).as_secs_f64().min(0.1));
        if self.updater.animate(elapsed) {
            ctx.request_repaint_after(FRAME);
        }
        self.last_frame = Some(now);
        self.updater.follow_torque();
        self.updater.follow_rotor();
        if !self.after_text.is_empty() {
            // A field commits its text when it loses the focus.
            ctx.memory_mut(|memory| memory.focused().into_iter().for_each(|field| memory.surrender_focus(field)));
        }
        let address = fragment();
        if address != self.address {
            self.address = address;
            if !self.address.is_empty() {
                self.updater.visit(&self.address);
            }
        }
        let mut commands: Vec<Command> = self.escape(ctx).into_iter().collect();
        let pressed = keys::pressed(ctx, self.obstacles(), self.state().view.tab);
        let (waiting, at_once): (Vec<_>, Vec<_>) =
            pressed.into_iter().partition(|shortcut| shortcut.scope == Scope::Window);
        commands.extend(at_once.iter().map(|shortcut| (shortcut.command)()));
        commands.into_iter().for_each(|command| self.carry_out(command));
        let mut waiting: Vec<Command> = waiting.iter().map(|shortcut| (shortcut.command)()).collect();
        // A question is answered first.
        let dropped = dropped(ctx).into_iter().filter(|_| self.state().modal.is_none());
        waiting.extend(dropped.map(|path| Command::Chosen(Purpose::Open, path)));
        let closing = ctx.input(|input| input.viewport().close_requested()) && !self.state().quitting;
        if closing && (ctx.text_edit_focused() || self.updater.quitting_loses()) {
            ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            waiting.push(Command::Proceed(Next::Quit));
        }
        self.after_text(ctx, waiting);
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        if frame.gl().is_none() {
            // Only with OpenGL is the window certain to have been cleared with this colour.
            ui.painter().rect_filled(ctx.content_rect(), 0.0, ui.visuals().panel_fill);
        }
        if self.updater.observe() {
            ctx.request_repaint();
        }
        let title = format!("{} – squeezefilm", self.state().document.title());
        if title != self.title {
            ctx.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.title = title;
        }
        self.follow_focus(&ctx);
        let cx = DrawContext::new(self.state(), self.updater.now());
        // Scroll areas that fade at their edges need to know this background.
        let ground = egui::Frame::new().fill(ui.visuals().panel_fill);
        let stack = egui::UiStackInfo::new(egui::UiKind::GenericArea).with_frame(ground);
        ui.scope_builder(egui::UiBuilder::new().ui_stack_info(stack), |ui| layout::show(ui, &cx));
        let commands = cx.into_commands();
        self.typing = ctx.text_edit_focused() && !is_searched(&ctx);
        if !commands.is_empty() || ctx.memory(|memory| memory.focused()) != self.focused {
            // The effect of a command is drawn soon, and so is a change of the keyboard focus.
            ctx.request_repaint();
        }
        let asked: Vec<&'static str> = commands.iter().filter_map(Command::edited).collect();
        commands.into_iter().for_each(|command| self.carry_out(command));
        self.text_taken(&ctx, &asked);
        if self.unwritten {
            // This requests the frame in which the state is saved. It is requested in every frame until then, because an earlier request
            // replaces it.
            ctx.request_repaint_after(SAVE_INTERVAL + Duration::from_millis(500));
        }
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        // The background of all panels.
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        self.unwritten = false;
        let entries = to_keep(self.state());
        match &self.updater.platform.storage {
            StoragePlace::Nowhere => {}
            StoragePlace::Browser => entries.into_iter().for_each(|(name, text)| storage.set_string(&name, text)),
            // This is called again and again while a motion plays.
            StoragePlace::File(_) if self.kept.as_ref() == Some(&entries) => {}
            StoragePlace::File(path) => {
                let fault = write(path, &entries).err().map(|error| format!("{NOT_KEPT}: {error}"));
                // Earlier versions kept it there.
                if fault.is_none() && storage.get_string("scene").is_some() {
                    entries.keys().for_each(|name| storage.remove_string(name));
                }
                self.kept = fault.is_none().then_some(entries);
                if fault != self.fault {
                    fault.iter().for_each(|fault| self.updater.state.fail(fault.clone()));
                    self.fault = fault;
                }
            }
        }
    }

    fn persist_egui_memory(&self) -> bool {
        !matches!(self.updater.platform.storage, StoragePlace::Nowhere)
    }

    fn auto_save_interval(&self) -> Duration {
        SAVE_INTERVAL
    }
}

/// What the next window begins with.
fn to_keep(state: &State) -> Entries {
    // The next window begins with the student's own scene, not with that of a lesson.
    let document = state.lessons.student_document(&state.document);
    let recent: Vec<String> = state.recent.iter().map(|path| path.display().to_string()).collect();
    let entries = [
        ("scene", document.scene().to_toml()),
        ("saved", document.saved().to_toml()),
        ("new", document.is_new().to_string()),
        (UNSAVED, document.is_dirty().to_string()),
        ("path", document.path().map(|p| p.display().to_string()).unwrap_or_default()),
        ("lessons", state.lessons.progress_text()),
        ("pins", state.pins.stored()),
        ("tour", "seen".to_owned()),
        ("recent", recent.join("\n")),
        ("fidelity", state.document.target().to_string()),
        ("budget", state.budget.map_or_else(String::new, |budget| format!("{budget:?}"))),
        ("theme", if state.dark { "dark" } else { "light" }.to_owned()),
        ("lecture", state.lecture.to_string()),
    ];
    entries.map(|(name, text)| (name.to_owned(), text)).into()
}

/// The state that the last window was left in, with the scene `opened` if there is one. If the last window left unsaved changes, `opened`
/// is returned beside that state, to be opened after a question. A file at `place` that can neither be read nor kept is not written to.
fn restored(
    storage: Option<&dyn eframe::Storage>,
    opened: Option<Document>,
    place: &mut StoragePlace,
) -> Result<(State, Option<Document>), Box<dyn std::error::Error + Send + Sync>> {
    let mut faults = Vec::new();
    let file = if let StoragePlace::File(file) = place { Some(file.clone()) } else { None };
    let read = file
        .as_deref()
        .map_or(Ok(None), |file| read(file).map_err(|fault| faults.push(format!("{}: {fault}.", file.display()))));
    // A page keeps it in the browser, and so did earlier versions in a file of eframe.
    let stored = |key: &str| match &read {
        Ok(Some(entries)) => entries.get(key).cloned(),
        Ok(None) if matches!(place, StoragePlace::Nowhere) => None,
        Ok(None) => storage?.get_string(key),
        Err(()) => None,
    };
    // The tour is for users who have never seen the window, and is not shown over a file that was to be opened.
    let empty = stored("tour").is_none() && stored("scene").is_none();
    let first_start = opened.is_none() && storage.is_some() && empty && faults.is_empty();
    // Unsaved changes of the last window are shown first, and the user is asked about them.
    let (document, next) = match (opened, last_document(&stored, &mut faults)) {
        (Some(opened), Some(last)) if last.is_dirty() => (last, Some(opened)),
        (opened, last) => (opened.or(last).map_or_else(Document::fundamental, Ok)?, None),
    };
    let target = stored("fidelity").and_then(|name| name.parse().map_err(|fault| faults.push(fault)).ok());
    let mut state = State::new(target.into_iter().fold(document, Document::with_target));
    let budget = stored("budget").filter(|text| !text.is_empty());
    state.budget = budget.and_then(|text| parse_duration(&text).map_err(|fault| faults.push(fault)).ok());
    state.recent = stored("recent").map(|text| text.lines().map(PathBuf::from).collect()).unwrap_or_default();
    let mut one_of = |key: &str, [no, yes]: [&str; 2]| {
        let text = stored(key)?;
        let fault = (text != no && text != yes).then(|| format!("{key} = {text}: {no} or {yes} is allowed"));
        faults.extend(fault);
        Some(text != no)
    };
    state.dark = one_of("theme", ["light", "dark"]).unwrap_or(prefers_dark().unwrap_or(true));
    state.lecture = one_of("lecture", ["false", "true"]).unwrap_or_default();
    if let Some(Err(fault)) = stored("lessons").map(|text| state.lessons.restore(&text)) {
        faults.push(format!("The progress in lessons cannot be read: {fault}."));
    }
    state.lessons.tour = first_start.then_some(0);
    // What cannot be read is reported, and the rest is restored.
    if let Some(Err(fault)) = stored("pins").map(|text| state.pins.restore(&text)) {
        faults.push(format!("Not all pinned runs of the last window can be read.\n{fault}"));
    }
    let ours = to_keep(&state);
    let names = read.iter().flatten().flat_map(Entries::keys);
    let unknown: Vec<_> = names.filter(|name| !ours.contains_key(*name)).map(|name| show_text(name)).collect();
    if !unknown.is_empty() {
        faults.push(format!(
            "The state of the last window holds what this version does not know: {}.",
            unknown.join(", ")
        ));
    }
    if !faults.is_empty() {
        // The next save replaces the file, so a copy is kept.
        match file.as_deref().map_or(Ok(None), keep) {
            Ok(Some(copy)) => faults.push(format!("The state of the last window is kept in {}.", copy.display())),
            Ok(None) => {}
            Err(error) => {
                *place = StoragePlace::Nowhere;
                faults.push(format!(
                    "What the last window left stays as it is, because there can be no copy of it: {error}. {NOT_KEPT}."
                ));
            }
        }
        state.fail(faults.join("\n\n"));
    }
    Ok((state, next))
}

/// The scene that the last window was left with; what cannot be read of it is added to the faults.
fn last_document(stored: &dyn Fn(&str) -> Option<String>, faults: &mut Vec<String>) -> Option<Document> {
    let mut parse = |key: &str| {
        let read = Scene::from_toml(&stored(key)?, "the last window");
        read.map_err(|fault| faults.push(format!("The scene of the last window cannot be read.\n{fault}"))).ok()
    };
    let scene = parse("scene")?;
    let saved = parse("saved").unwrap_or_else(|| scene.clone());
    let path = stored("path").map(PathBuf::from).filter(|path| path.is_absolute());
    Some(Document::restored(scene, saved, path, stored("new").as_deref() == Some("true")))
}
