//! The application: drains events, carries out commands, lays out panels and views. It never solves.

mod exporting;
mod live;
mod measuring;
mod pinning;
mod sweeping;
mod teaching;

use super::command::Command;
use super::comparison::Comparison;
use super::dialogs::{Answer, Dialogs, Purpose};
use super::document::Document;
use super::edit::{Change, Refusals};
use super::exporting::{self as exports, Exports};
use super::holding::Holding;
use super::keys;
use super::lessons::{self, Teach, Teaching};
use super::measured::Measured;
use super::merits::Merits;
use super::modal::{self, Modal, PathPrompt};
use super::panels::model::Model;
use super::panels::{menu, parameters, results, sheet, timeline};
use super::pinned::{Page, Pins};
use super::spot;
use super::starting::Starting;
use super::state::{Tab, View};
use super::sweeping::Sweeps;
use super::tabs;
use super::theme;
use super::views;
use super::world::World;
use crate::analysis::tradeoff::Wish;
use crate::fidelity::Fidelity;
use crate::job::{Event, Request, Run, Solver};
use crate::problem::{Numerics, Problem, Scenario};
use crate::recording::Recording;
use crate::scene::{Kind, Parameter, ParameterKind, Scene, SceneError, presets};
use eframe::egui;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

/// Files remembered.
const RECENT: usize = 10;
/// Zoom of the lecture size.
const LECTURE_ZOOM: f32 = 1.35;
/// Width of a panel at the side of the views.
struct Side {
    default: f32,
    least: f32,
    /// The most of a narrow window that it takes.
    share: f32,
}

const PARAMETERS: Side = Side { default: 300.0, least: 210.0, share: 0.3 };
/// A lesson is read: wider than the results, whose place it takes.
const LESSON: Side = Side { default: 392.0, least: 240.0, share: 0.36 };
const RESULTS: Side = Side { default: 304.0, least: 190.0, share: 0.29 };

impl Side {
    /// Fits `panel` into a window of this width: what is in the middle stays the widest.
    fn fit(&self, panel: egui::Panel, window: f32) -> egui::Panel {
        let most = (self.share * window).max(self.least);
        panel.default_size(self.default.min(most)).size_range(self.least..=most).resizable(true)
    }
}

/// What a picture is called at first.
const PICTURE_NAME: &str = "squeezefilm.png";
/// Unsaved work is written away this often.
const SAVE_INTERVAL: Duration = Duration::from_secs(2);

/// What the solver is doing.
#[derive(Clone, Debug, Default)]
pub struct Activity {
    /// The newest request.
    pub number: u64,
    /// What is running.
    pub running: Option<Running>,
    /// Why there is no newer result.
    pub failure: Option<String>,
}

/// The fidelity being solved, and how far it is.
#[derive(Clone, Copy, Debug)]
pub struct Running {
    /// Which fidelity.
    pub fidelity: Fidelity,
    /// Grid, of how many, and round.
    pub level: (usize, usize, usize),
    /// ln residual at the start of this grid, now, and at the tolerance.
    pub decay: (f64, f64, f64),
}

impl Running {
    /// Progress between 0 and 1.
    pub fn fraction(&self) -> f32 {
        let (first, now, last) = self.decay;
        let here = if first > last { ((first - now) / (first - last)).clamp(0.0, 1.0) } else { 0.0 };
        ((self.level.0 as f64 + here) / self.level.1.max(1) as f64) as f32
    }

    /// In words.
    pub fn text(&self) -> String {
        format!("solving {}, grid {} of {}, round {}", self.fidelity, self.level.0 + 1, self.level.1, self.level.2)
    }
}

impl Activity {
    /// Whether `run` is of an earlier scene.
    pub fn stale(&self, run: &Run) -> bool {
        run.number < self.number
    }
}

/// The application.
pub struct App {
    document: Document,
    refusals: Refusals,
    world: World,
    solver: Solver,
    shown: Option<Arc<Run>>,
    activity: Activity,
    view: View,
    dialogs: Dialogs,
    pictures: (Sender<Arc<egui::ColorImage>>, Receiver<Arc<egui::ColorImage>>),
    picture: Option<Arc<egui::ColorImage>>,
    comparison: Comparison,
    measured: Option<Measured>,
    exports: Exports,
    pins: Pins,
    sweeps: Sweeps,
    merits: Merits,
    teaching: Teaching,
    starting: Option<Starting>,
    holding: Option<Holding>,
    modal: Option<Modal>,
    /// What to do after a save that a question led to.
    after_save: Option<Command>,
    sheet: bool,
    recent: Vec<PathBuf>,
    dark: bool,
    lecture: bool,
    quitting: bool,
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
        Self::in_world(context, opened, World::default())
    }

    /// As [`Self::new`], with a clock and file dialogs of the caller's.
    ///
    /// # Errors
    /// If the solver's thread cannot be started.
    pub fn in_world(
        context: &eframe::CreationContext<'_>,
        opened: Option<(Scene, Option<PathBuf>)>,
        world: World,
    ) -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        theme::install(&context.egui_ctx);
        let wake = context.egui_ctx.clone();
        let solver = Solver::start_with_clock(world.now, move || wake.request_repaint())?;
        let stored = |key: &str| context.storage.and_then(|storage| storage.get_string(key));
        let aim = stored("fidelity").and_then(|name| name.parse().ok());
        // The tour is for whoever has never seen the window, and not over a file that was asked for.
        let first_start =
            opened.is_none() && context.storage.is_some() && stored("tour").is_none() && stored("scene").is_none();
        let document = match opened {
            Some((scene, path)) => Document::opened(scene, path),
            None => match restore(&stored) {
                Some(document) => document,
                None => Document::fundamental()?,
            },
        };
        let mut app = Self {
            document: aim.into_iter().fold(document, Document::aiming),
            refusals: Refusals::default(),
            world,
            solver,
            shown: None,
            activity: Activity::default(),
            view: View::default(),
            dialogs: Dialogs::new(world.ask),
            pictures: channel(),
            picture: None,
            comparison: Comparison::default(),
            measured: None,
            exports: Exports::default(),
            pins: Pins::default(),
            sweeps: Sweeps::default(),
            merits: Merits::default(),
            teaching: Teaching::new(stored("lessons")),
            starting: None,
            holding: None,
            modal: None,
            after_save: None,
            sheet: false,
            recent: stored("recent").map(|text| text.lines().map(PathBuf::from).collect()).unwrap_or_default(),
            dark: stored("theme").is_none_or(|theme| theme != "light"),
            lecture: stored("lecture").is_some_and(|size| size == "true"),
            quitting: false,
            typing: false,
            last_frame: None,
        };
        if first_start {
            app.teaching.tour = Some(0);
        }
        // What cannot be read is told, and the rest is there.
        if let Some(Err(fault)) = stored("pins").map(|text| app.pins.restore(&text)) {
            app.modal = Some(Modal::Error(format!("Not all pinned runs of the last window can be read.\n{fault}")));
        }
        app.apply_theme(&context.egui_ctx);
        app.refine();
        Ok(app)
    }

    /// The scene being edited.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The run on screen.
    pub fn shown(&self) -> Option<&Run> {
        self.shown.as_deref()
    }

    /// What the solver is doing.
    pub fn activity(&self) -> &Activity {
        &self.activity
    }

    /// How the run is looked at.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Error against time, if it was measured.
    pub fn measured(&self) -> Option<&Measured> {
        self.measured.as_ref()
    }

    /// Torque over speed, if its tab was shown.
    pub fn merits(&self) -> &Merits {
        &self.merits
    }

    /// The plate that is held, once its tab was shown.
    pub fn holding(&self) -> Option<&Holding> {
        self.holding.as_ref()
    }

    /// The start-up, if one was asked for.
    pub fn starting(&self) -> Option<&Starting> {
        self.starting.as_ref()
    }

    /// What the switches of the model changed.
    pub fn comparison(&self) -> &Comparison {
        &self.comparison
    }

    /// Lessons, tour and glossary.
    pub fn teaching(&self) -> &Teaching {
        &self.teaching
    }

    fn apply_theme(&self, ctx: &egui::Context) {
        ctx.set_theme(if self.dark { egui::Theme::Dark } else { egui::Theme::Light });
        ctx.set_zoom_factor(if self.lecture { LECTURE_ZOOM } else { 1.0 });
    }

    /// What moves in the middle: its frames are those of the timeline.
    fn on_timeline(&self) -> Option<&Recording> {
        let pinned = || self.pins.runs().iter().find_map(|run| run.solved.as_ref().ok()).map(|s| &s.recording);
        let recording = match self.view.tab {
            Tab::Motion => self.shown.as_ref().map(|run| &run.solution.recording),
            Tab::Startup => self.starting.as_ref().and_then(Starting::run).map(|run| &run.solution.recording),
            Tab::Compare if self.pins.page == Page::Fields => pinned(),
            _ => None,
        };
        recording.filter(|recording| recording.frames > 0)
    }

    /// The shortest and the longest period of what moves with `recording` \[s\]: pinned runs need not have the same.
    fn periods(&self, recording: &Recording) -> [f64; 2] {
        let pinned = self.pins.runs().iter().filter(|_| self.view.tab == Tab::Compare);
        let periods = pinned.filter_map(|run| Some(run.solved.as_ref().ok()?.recording.period));
        periods.fold([recording.period; 2], |[low, high], period| [low.min(period), high.max(period)])
    }

    /// Asks for the present scene, draft first, then refined up to what is aimed at.
    fn refine(&mut self) {
        let aim = self.document.aim();
        let fidelities: Vec<Fidelity> = Fidelity::ALL.into_iter().filter(|fidelity| *fidelity <= aim).collect();
        self.solve(&fidelities);
    }

    /// Asks for the present scene at these fidelities.
    fn solve(&mut self, fidelities: &[Fidelity]) {
        match Problem::new(self.document.scene()) {
            Ok(problem) => {
                let scene = self.document.scene().clone();
                self.activity.number = self.solver.submit(Request { scene, problem, fidelities: fidelities.to_vec() });
                self.activity.failure = None;
            }
            Err(error) => self.activity.failure = Some(error.to_string()),
        }
    }

    fn drain(&mut self, ctx: &egui::Context) {
        for event in self.solver.drain() {
            match event {
                Event::Progress { number, fidelity, progress } if number == self.activity.number => {
                    let now = progress.residual.max(f64::MIN_POSITIVE).ln();
                    let same = self.activity.running.filter(|r| r.fidelity == fidelity && r.level.0 == progress.level);
                    self.activity.running = Some(Running {
                        fidelity,
                        level: (progress.level, progress.levels, progress.iteration),
                        decay: (same.map_or(now, |r| r.decay.0), now, progress.tolerance.ln()),
                    });
                }
                // A result of an edit that is already history is still newer than what is shown.
                Event::Solved(run) if self.shown.as_ref().is_none_or(|shown| run.number >= shown.number) => {
                    if run.scene == *self.document.scene() {
                        self.comparison.solved(&run);
                    }
                    self.view.tooth = self.view.tooth.min(run.solution.recording.teeth.saturating_sub(1));
                    self.shown = Some(run);
                }
                Event::Failed { number, message } if number == self.activity.number => {
                    self.activity.failure = Some(message);
                }
                Event::Done { number, .. } if number == self.activity.number => self.activity.running = None,
                _ => {}
            }
        }
        if let Some(measured) = &mut self.measured {
            measured.drain();
        }
        if let Some(error) = self.exports.drain() {
            self.modal = Some(Modal::Error(error));
        }
        self.pins.drain();
        self.solve_pins(ctx);
        self.sweeps.drain();
        if self.view.tab == Tab::Sweep {
            self.sweeps.review(self.document.scene());
        }
        self.merits.drain();
        if let Some(starting) = &mut self.starting {
            starting.drain();
            if starting.stale(self.document.scene()) {
                starting.cancel();
            }
        }
        let answers: Vec<(Purpose, Answer)> = self.dialogs.drain().collect();
        for (purpose, answer) in answers {
            match (purpose, answer) {
                (Purpose::Open, Answer::Path(path)) => self.carry_out(ctx, Command::OpenPath(path)),
                (Purpose::Lessons, Answer::Path(path)) => {
                    self.carry_out(ctx, Command::Teach(Teach::LoadFolder(path)));
                }
                (Purpose::Save, Answer::Path(path)) => self.carry_out(ctx, Command::SavePath(path)),
                (Purpose::Screenshot, Answer::Path(path)) => self.carry_out(ctx, Command::WritePicture(path)),
                (Purpose::Export(export), Answer::Path(path)) => {
                    self.carry_out(ctx, Command::WriteExport(export, path));
                }
                (_, Answer::Cancelled) => self.carry_out(ctx, Command::Dismissed),
                (purpose, Answer::NoDialog) => {
                    let path = match purpose {
                        Purpose::Open | Purpose::Lessons => String::new(),
                        Purpose::Save => self.suggested_name(),
                        Purpose::Screenshot => PICTURE_NAME.to_owned(),
                        Purpose::Export(export) => export.file_name().to_owned(),
                    };
                    self.modal = Some(Modal::Path(PathPrompt::instead_of_dialog(purpose, path)));
                }
            }
        }
        while let Ok(picture) = self.pictures.1.try_recv() {
            self.picture = Some(picture);
            self.ask(ctx, Purpose::Screenshot, PICTURE_NAME);
        }
    }

    fn ask(&mut self, ctx: &egui::Context, purpose: Purpose, name: &str) {
        let wake = ctx.clone();
        if let Err(error) = self.dialogs.show(purpose, name, move || wake.request_repaint()) {
            self.modal = Some(Modal::Error(format!("The file dialog cannot be shown: {error}")));
        }
    }

    fn suggested_name(&self) -> String {
        self.document.path().map_or_else(
            || {
                let stem: String =
                    self.document.scene().name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
                format!("{}.toml", stem.to_lowercase())
            },
            |path| path.display().to_string(),
        )
    }

    fn write_picture(&mut self, path: &Path) {
        let Some(picture) = self.picture.take() else { return };
        if let Err(error) = write_png(&picture, path) {
            self.modal = Some(Modal::Error(format!("{}: the picture cannot be written: {error}", path.display())));
        }
    }

    /// An edit: the scene changes, everything depending on it is solved again.
    fn edit(&mut self, key: &'static str, dragging: bool, change: Change) {
        match change.applied(self.document.scene(), key) {
            Ok(next) => {
                self.refusals.accept(key);
                let changed = next != *self.document.scene();
                self.document.edit(next, key, dragging);
                if changed {
                    if is_switch(key) {
                        self.comparison.switched(key);
                    } else {
                        self.comparison.edited();
                    }
                    self.refusals.review(self.document.scene());
                    self.refine();
                }
            }
            Err(error) => self.refusals.refuse(key, change, error.to_string()),
        }
    }

    fn open(&mut self, loaded: Result<Scene, SceneError>, path: Option<PathBuf>) {
        match loaded {
            Ok(scene) => {
                if let Some(path) = &path {
                    self.recent.retain(|other| other != path);
                    self.recent.insert(0, path.clone());
                    self.recent.truncate(RECENT);
                }
                self.document = Document::opened(scene, path).aiming(self.document.aim());
                self.refusals.clear();
                self.comparison.edited();
                self.refine();
            }
            Err(error) => self.modal = Some(Modal::Error(error.to_string())),
        }
    }

    /// Whether `command` would lose unsaved changes; then the user is asked first.
    fn would_lose(&mut self, command: &Command) -> bool {
        let loses = match command {
            Command::OpenBuiltIn(_) | Command::Quit => true,
            // A file that cannot be opened takes nothing away, and a lesson goes on.
            Command::OpenPath(path) => Scene::load(path).is_ok(),
            _ => false,
        };
        if loses {
            self.leave_lesson();
        }
        if loses && self.document.is_dirty() && !self.quitting {
            let name = self.document.scene().name.clone();
            self.modal = Some(Modal::Unsaved { name, next: Box::new(command.clone()) });
            return true;
        }
        false
    }

    fn carry_out(&mut self, ctx: &egui::Context, command: Command) {
        if self.would_lose(&command) {
            return;
        }
        self.carry_out_now(ctx, command);
    }

    fn carry_out_now(&mut self, ctx: &egui::Context, command: Command) {
        match command {
            Command::Set { key, value, dragging } => self.edit(key, dragging, Change::Value(value)),
            Command::SetText { key, text } => self.edit(key, false, Change::Text(text)),
            Command::Reset { key } => self.reset(key),
            Command::Use { aim, numerics } => self.use_setting(aim, numerics),
            Command::Undo | Command::Redo => {
                let changed = if command == Command::Undo { self.document.undo() } else { self.document.redo() };
                if changed {
                    self.refusals.clear();
                    self.comparison.edited();
                    self.refine();
                }
            }
            Command::OpenBuiltIn(name) => self.open(presets::find(name), None),
            Command::OpenDialog => self.ask(ctx, Purpose::Open, ""),
            Command::OpenPathPrompt => {
                let prompt = PathPrompt::asked(&[Purpose::Open, Purpose::Save], self.suggested_name());
                self.modal = Some(Modal::Path(prompt));
            }
            Command::OpenPath(path) => self.open(Scene::load(&path), Some(path)),
            Command::Save => match self.document.path().map(Path::to_path_buf) {
                Some(path) => self.carry_out_now(ctx, Command::SavePath(path)),
                None => self.carry_out_now(ctx, Command::SaveAs),
            },
            Command::SaveAs => {
                let name = self.suggested_name();
                let name = Path::new(&name).file_name().map(|name| name.to_string_lossy().into_owned());
                self.ask(ctx, Purpose::Save, &name.unwrap_or_default());
            }
            Command::SavePath(path) => match self.document.save(&path) {
                Ok(()) => {
                    self.recent.retain(|other| *other != path);
                    self.recent.insert(0, path);
                    self.recent.truncate(RECENT);
                    if let Some(next) = self.after_save.take() {
                        self.carry_out_now(ctx, next);
                    }
                }
                Err(error) => {
                    self.after_save = None;
                    self.modal = Some(Modal::Error(error.to_string()));
                }
            },
            Command::SaveThen(next) => {
                self.after_save = Some(*next);
                self.carry_out_now(ctx, Command::Save);
            }
            Command::DiscardThen(next) => {
                self.after_save = None;
                if *next == Command::Quit {
                    // The next window begins with what is saved. A file that is opened replaces the scene only if it is good.
                    let (saved, path) = (self.document.saved().clone(), self.document.path().map(Path::to_path_buf));
                    self.document = Document::opened(saved, path).aiming(self.document.aim());
                }
                self.carry_out_now(ctx, *next);
            }
            Command::Dismissed => {
                self.after_save = None;
                self.picture = None;
            }
            Command::WritePicture(path) => self.write_picture(&path),
            Command::Refine(fidelity) => self.solve(&[fidelity]),
            Command::CancelSolve => {
                self.solver.cancel();
                self.activity.running = None;
            }
            Command::Show(tab) => self.view.tab = tab,
            Command::Pin(asked) => self.pin(ctx, asked),
            Command::Sweep(asked) => self.sweep(ctx, asked),
            Command::Hold(ask) => {
                if let Some(holding) = &mut self.holding {
                    holding.carry_out(ask);
                }
            }
            Command::Startup(ask) => self.start_up(ctx, ask),
            Command::Measure => self.measure(ctx),
            Command::CancelMeasure => {
                if let Some(measured) = &mut self.measured {
                    measured.cancel();
                }
            }
            Command::Wish(Wish::Accuracy(share)) => self.view.accuracy = share,
            Command::Wish(Wish::Budget(seconds)) => self.view.budget = seconds,
            Command::Export(export) => self.ask(ctx, Purpose::Export(export), export.file_name()),
            Command::WriteExport(export, path) => self.export(ctx, export, &path),
            Command::Exporting(asked) => self.exports.carry_out(asked),
            Command::TogglePlay => self.view.playing = !self.view.playing,
            Command::StepFrames(by) => {
                if let Some(phase) = self.on_timeline().map(|recording| self.view.stepped(recording, by)) {
                    self.view.playing = false;
                    self.view.phase = phase;
                }
            }
            Command::Seek(phase) => {
                self.view.playing = false;
                self.view.phase = phase.rem_euclid(1.0);
            }
            Command::SecondsPerCycle(seconds) => self.view.seconds_per_cycle = seconds,
            Command::FollowTooth(tooth) => self.view.tooth = tooth,
            Command::NextTooth(by) => {
                if let Some(teeth) = self.on_timeline().map(|recording| recording.teeth.max(1) as i64) {
                    self.view.tooth = (self.view.tooth as i64 + by).rem_euclid(teeth) as usize;
                }
            }
            Command::ToggleTheme => {
                self.dark = !self.dark;
                self.apply_theme(ctx);
            }
            Command::ToggleLecture => {
                self.lecture = !self.lecture;
                self.apply_theme(ctx);
            }
            Command::Screenshot => {
                let (sender, wake) = (self.pictures.0.clone(), ctx.clone());
                ctx.request_screenshot(move |image| {
                    // The window may be gone by now: then there is nobody to show it to.
                    let _ = sender.send(image);
                    wake.request_repaint();
                });
            }
            Command::ToggleParameters => self.view.parameters = !self.view.parameters,
            Command::ToggleResults => self.view.results = !self.view.results,
            Command::ToggleShortcuts => self.sheet = !self.sheet,
            Command::Teach(teach) => self.teach(ctx, teach),
            Command::Quit => {
                self.quitting = true;
                ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            }
        }
    }

    fn reset(&mut self, key: &'static str) {
        let Some(parameter) = Parameter::find(key) else { return };
        if parameter.absent.is_some() {
            self.edit(key, false, Change::Unset);
            return;
        }
        let default = match self.document.scene().kind {
            Kind::Motor { .. } => Scene::motor(),
            Kind::Plate { .. } => Scene::plate(),
        };
        if let Some(value) = default.get(key) {
            self.edit(key, false, Change::Value(value));
        }
    }

    /// Other numerics and another aim, as one edit.
    fn use_setting(&mut self, aim: Fidelity, numerics: Numerics) {
        let next = Scene { numerics, ..self.document.scene().clone() };
        match next.check() {
            Ok(()) => {
                if self.document.change(next, aim) {
                    self.comparison.edited();
                    self.refusals.review(self.document.scene());
                    self.refine();
                }
            }
            Err(error) => self.modal = Some(Modal::Error(error.to_string())),
        }
    }

    /// Escape closes the tour, then the glossary: after whatever is over them, and after a text that is being typed.
    fn escape(&self, ctx: &egui::Context, commands: &mut Vec<Command>) {
        let open = [
            self.teaching.tour.is_some().then_some(Teach::Tour(None)),
            self.teaching.glossary.is_some().then_some(Teach::Glossary(false)),
        ];
        let Some(close) = open.into_iter().flatten().next() else { return };
        let other = self.modal.is_some() || self.sheet || self.typing || egui::Popup::is_any_open(ctx);
        if !other && ctx.input_mut(|input| input.consume_key(egui::Modifiers::NONE, egui::Key::Escape)) {
            commands.push(Command::Teach(close));
        }
    }

    fn modals(&mut self, ctx: &egui::Context, commands: &mut Vec<Command>) {
        if let Some(query) = self.teaching.glossary.clone() {
            lessons::glossary::show(ctx, &query, commands);
        }
        if let Some(stop) = self.teaching.tour {
            lessons::tour::show(ctx, stop, commands);
        }
        if self.sheet {
            self.sheet = sheet::show(ctx);
        }
        let Some(mut modal) = self.modal.take() else { return };
        if modal::show(ctx, &mut modal, self.document.path(), &theme::palette(self.dark), commands) {
            self.modal = Some(modal);
        }
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.drain(ctx);
        self.hold(ctx);
        let now = (self.world.now)();
        if self.view.playing && self.on_timeline().is_some() {
            // A frame after a pause must not leap.
            let elapsed = self.last_frame.map_or(0.0, |last| (now - last).as_secs_f64().min(0.1));
            self.animate(elapsed);
            ctx.request_repaint_after(Duration::from_millis(16));
        }
        self.last_frame = Some(now);
        if let (Tab::Torque, Some(run)) = (self.view.tab, &self.shown) {
            self.merits.follow(run, ctx);
        }
        let mut commands = Vec::new();
        self.escape(ctx, &mut commands);
        keys::pressed(ctx, self.modal.is_some() || self.sheet || self.typing, self.view.tab, &mut commands);
        let dropped: Vec<PathBuf> = ctx.input(|input| {
            input
                .raw
                .dropped_files
                .iter()
                .map(|file| file.path().to_path_buf())
                .filter(|path| !path.as_os_str().is_empty())
                .collect()
        });
        commands.extend(dropped.into_iter().map(Command::OpenPath));
        if ctx.input(|input| input.viewport().close_requested())
            && !self.quitting
            && self.teaching.own(&self.document).is_dirty()
        {
            ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            commands.push(Command::Quit);
        }
        for command in commands {
            self.carry_out(ctx, command);
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        let palette = theme::palette(self.dark);
        let mut commands = Vec::new();
        let shown = self.shown.clone();
        self.view.cursor_x = self.view.hover_x.take();
        let (merits, starting, holding) = (&self.merits, self.starting.as_ref(), self.holding.as_ref());
        let seen = lessons::Seen { run: shown.as_deref(), merits, starting, holding };
        self.teaching.observe(&ctx, &self.document, seen);

        egui::Panel::top("menu").show(ui, |ui| {
            let available = |export| self.can_export(export);
            menu::show(ui, &self.document, &self.recent, &available, self.dark, &self.teaching, &mut commands);
        });
        egui::Panel::bottom("status").show(ui, |ui| {
            if let Some(recording) = self.on_timeline() {
                ui.add_space(2.0);
                timeline::show(ui, recording, self.periods(recording), &self.view, &mut commands);
            }
            exports::show(ui, &self.exports, (self.world.now)(), &palette, &mut commands);
            timeline::status(ui, shown.as_deref(), &self.activity, &palette, &mut commands);
        });
        let width = ui.available_width();
        // Each size of text remembers its own widths.
        let [left, right] =
            if self.lecture { ["parameters, lecture", "results, lecture"] } else { ["parameters", "results"] };
        if self.view.parameters {
            PARAMETERS.fit(egui::Panel::left(left), width).show(ui, |ui| {
                spot::mark(ui, "parameters", ui.max_rect().expand(2.0));
                let plan = shown.as_ref().map_or(&[][..], |run| &run.solution.model.decisions);
                parameters::show(ui, self.document.scene(), &self.refusals, plan, &mut commands);
            });
        }
        let lesson = self.teaching.running().is_some_and(|running| !running.all_results);
        if self.view.results && lesson {
            let [_, right] = if self.lecture { ["", "lesson, lecture"] } else { ["", "lesson"] };
            LESSON.fit(egui::Panel::right(right), width).show(ui, |ui| {
                let busy = shown.as_ref().is_none_or(|run| self.activity.stale(run)) && self.activity.failure.is_none();
                lessons::show(ui, &self.teaching, self.document.scene(), busy, &mut commands);
            });
        } else if self.view.results {
            RESULTS.fit(egui::Panel::right(right), width).show(ui, |ui| {
                // As wide before the first result as after it.
                ui.set_min_width(ui.available_width());
                if self.teaching.running().is_some() && ui.button("Back to the lesson").clicked() {
                    commands.push(Command::Teach(Teach::AllResults(false)));
                }
                if let Some(run) = &shown {
                    let (scene, aim) = (self.document.scene(), self.document.aim());
                    let model = Model { scene, aim, change: self.comparison.change() };
                    results::show(ui, run, &model, self.dark, &mut commands);
                }
            });
        }
        egui::CentralPanel::default().show(ui, |ui| {
            let plate = matches!(self.document.scene().kind, Kind::Plate { .. });
            let bar =
                tabs::Bar { present: self.view.tab, pinned: self.pins.runs().len(), solved: shown.is_some(), plate };
            tabs::labels(ui, &bar, &mut commands);
            match (self.view.tab, &shown) {
                (Tab::Motion, Some(run)) => views::show(ui, run, &mut self.view, &mut commands),
                (Tab::Torque, Some(run)) => match run.problem.scenario {
                    Scenario::Motor(_) => tabs::torque::show(ui, run, &self.merits, &palette),
                    Scenario::Plate(_) => tabs::exact::show(ui, run, &palette),
                },
                (Tab::Motion | Tab::Torque, None) => drop(ui.centered_and_justified(|ui| ui.label("Solving…"))),
                (Tab::Compare, _) => {
                    let (scene, solved, dark) = (self.document.scene(), shown.is_some(), self.dark);
                    let pins = tabs::compare::Shown { pins: &self.pins, scene, solved, dark };
                    tabs::compare::show(ui, &pins, &mut self.view, &palette, &mut commands);
                }
                (Tab::Sweep, _) => {
                    let (scene, now) = (self.document.scene(), (self.world.now)());
                    let shown = tabs::sweep::Shown { sweeps: &self.sweeps, scene, now };
                    tabs::sweep::show(ui, &shown, &palette, &mut commands);
                }
                (Tab::Startup, run) => {
                    let starting = self.starting.as_ref();
                    let shown = tabs::startup::Shown { scene: self.document.scene(), starting, run: run.as_deref() };
                    tabs::startup::show(ui, &shown, &palette, &mut self.view, &mut commands);
                }
                (Tab::Hold, _) => tabs::hold::show(ui, self.holding.as_ref(), &palette, &mut commands),
                (Tab::Tradeoff, _) => {
                    let shown = tabs::tradeoff::Shown {
                        scene: self.document.scene(),
                        aim: self.document.aim(),
                        measured: self.measured.as_ref(),
                        accuracy: self.view.accuracy,
                        budget: self.view.budget,
                        now: (self.world.now)(),
                    };
                    tabs::tradeoff::show(ui, &shown, &palette, &mut commands);
                }
            }
        });
        self.modals(&ctx, &mut commands);
        self.typing = ctx.text_edit_focused() && !lessons::glossary::is_searched(&ctx);
        if !commands.is_empty() {
            // What a command changes is drawn, and written away, soon.
            ctx.request_repaint();
            ctx.request_repaint_after(SAVE_INTERVAL + Duration::from_millis(500));
        }
        for command in commands {
            self.carry_out(&ctx, command);
        }
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        // Seen between panels where their edges fall between pixels.
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        // The next window begins with the student's own scene, not with that of a lesson.
        let own = self.teaching.own(&self.document);
        storage.set_string("scene", own.scene().to_toml());
        storage.set_string("saved", own.saved().to_toml());
        storage.set_string("path", own.path().map(|p| p.display().to_string()).unwrap_or_default());
        storage.set_string("lessons", self.teaching.progress_text());
        storage.set_string("pins", self.pins.stored());
        storage.set_string("tour", "seen".to_owned());
        let recent: Vec<String> = self.recent.iter().map(|path| path.display().to_string()).collect();
        storage.set_string("recent", recent.join("\n"));
        storage.set_string("fidelity", self.document.aim().name().to_owned());
        storage.set_string("theme", if self.dark { "dark" } else { "light" }.to_owned());
        storage.set_string("lecture", self.lecture.to_string());
    }

    fn auto_save_interval(&self) -> Duration {
        SAVE_INTERVAL
    }
}

/// Whether a key is one of the model's switches.
fn is_switch(key: &str) -> bool {
    Parameter::find(key)
        .is_some_and(|found| found.table() == "numerics" && matches!(found.kind, ParameterKind::Choice { .. }))
}

/// The scene that the last window was left with.
fn restore(stored: &dyn Fn(&str) -> Option<String>) -> Option<Document> {
    let parse = |key: &str| Scene::from_toml(&stored(key)?, "the last window").ok();
    let scene = parse("scene")?;
    let saved = parse("saved").unwrap_or_else(|| scene.clone());
    let path = stored("path").filter(|path| !path.is_empty()).map(PathBuf::from);
    Some(Document::restored(scene, saved, path))
}

/// Writes a picture under a temporary name, then renames it.
fn write_png(picture: &egui::ColorImage, path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    let [width, height] = picture.size;
    let bytes: Vec<u8> = picture.pixels.iter().flat_map(|pixel| pixel.to_array()).collect();
    let buffer = image::RgbaImage::from_raw(width as u32, height as u32, bytes).ok_or("the picture is incomplete")?;
    let mut encoded = std::io::Cursor::new(Vec::new());
    buffer.write_to(&mut encoded, image::ImageFormat::Png)?;
    std::io::Write::write_all(file.as_file_mut(), encoded.get_ref())?;
    file.persist(path)?;
    Ok(())
}
