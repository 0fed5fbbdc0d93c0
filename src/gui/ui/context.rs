//! The context that every drawing function receives.

use super::highlight;
use super::hint::Hint;
use super::theme::{Palette, palette};
use crate::digits::{capitalised, raised};
use crate::gui::command::Command;
use crate::gui::derived::format::rough;
use crate::gui::state::window::State;
use crate::job::SolvedScene;
use crate::platform::Instant;
use eframe::egui::{self, Color32, Id, Rect, Response, RichText, Ui};
use std::cell::{Cell, RefCell};
use std::time::Duration;

/// The state to read, the colours, the present moment, and where commands go.
#[derive(Debug)]
pub struct DrawContext<'a> {
    /// All that the window knows.
    pub state: &'a State,
    /// Colours of the present theme.
    pub colours: Palette,
    /// The present moment.
    pub now: Instant,
    commands: RefCell<Vec<Command>>,
    pointed_x: Cell<Option<f64>>,
}

impl<'a> DrawContext<'a> {
    /// A context to draw `state` at the moment `now`.
    pub fn new(state: &'a State, now: Instant) -> Self {
        let commands = RefCell::default();
        Self { state, colours: palette(state.dark), now, commands, pointed_x: Cell::default() }
    }

    /// Requests `command`, which is carried out after drawing.
    pub fn push(&self, command: impl Into<Command>) {
        self.commands.borrow_mut().push(command.into());
    }

    /// Requests that the pointer is at this x of a view \[m\].
    pub fn point_at(&self, x: f64) {
        self.pointed_x.set(Some(x));
    }

    /// All commands, with one more if the pointer has moved to another x.
    pub fn into_commands(self) -> Vec<Command> {
        let mut commands = self.commands.into_inner();
        let pointed = self.pointed_x.get();
        if pointed != self.state.view.cursor_x {
            commands.push(Command::Hover(pointed));
        }
        commands
    }

    /// Text, wrapped.
    pub fn say(&self, ui: &mut Ui, text: impl Into<String>, colour: Color32) {
        ui.add(egui::Label::new(RichText::new(text).color(colour)).wrap());
    }

    /// Error messages, a paragraph each; nothing if there are none.
    pub fn alarm(&self, ui: &mut Ui, wrong: impl IntoIterator<Item = impl Into<String>>) {
        wrong.into_iter().for_each(|text| self.say(ui, text, self.colours.alarm));
    }

    /// The warnings of a computation, a paragraph each.
    pub fn warn(&self, ui: &mut Ui, warnings: &[String]) {
        // A warning that begins with a key keeps the key as it is written.
        let begins_with_key = |text: &str| text.split(' ').next().is_some_and(|word| word.contains('.'));
        let text = |text: &String| if begins_with_key(text) { text.clone() } else { capitalised(text) };
        self.alarm(ui, warnings.iter().map(|warning| raised(&text(warning))));
    }

    /// Secondary text, wrapped.
    pub fn note(&self, ui: &mut Ui, text: impl Into<String>) {
        self.say(ui, text, self.colours.quiet);
    }

    /// Placeholder text of an empty tab.
    pub fn introduce(&self, ui: &mut Ui, paragraphs: &[&str]) {
        ui.add_space(8.0);
        for paragraph in paragraphs {
            self.note(ui, *paragraph);
            ui.add_space(4.0);
        }
    }

    /// Requests `command` if `response` was clicked.
    pub fn on_click(&self, response: &Response, command: impl Into<Command>) {
        if response.clicked() {
            self.push(command);
        }
    }

    /// Requests `command` if the widget of `response` was changed.
    pub fn on_change(&self, response: &Response, command: impl Into<Command>) {
        if response.changed() {
            self.push(command);
        }
    }

    /// A button that requests `command`; `about` is shown on hover.
    pub fn button(&self, ui: &mut Ui, text: &str, about: impl Into<String>, command: impl Into<Command>) {
        self.on_click(&ui.button(text).hint(about), command);
    }

    /// As [`Self::button`], but small, and with the name `name` for screen readers.
    pub fn small_button(&self, ui: &mut Ui, (text, about): (&str, &str), name: &str, command: impl Into<Command>) {
        self.on_click(&ui.small_button(text).hint(about).accessible_name(name), command);
    }

    /// A progress bar: the share done, 0 to 1, with words, and the remaining time. It assumes that the work goes on as fast as it has gone
    /// `since` a moment and the share that was done then.
    pub fn progress(&self, ui: &mut Ui, width: f32, share: f64, words: &str, since: Option<(Instant, f64)>) {
        let since = since.filter(|(_, done)| *done > 0.0 && share < 1.0);
        let left = since.map_or_else(String::new, |(start, done)| {
            let spent = self.now.saturating_duration_since(start).as_secs_f64();
            format!(", {} left", rough(spent * (1.0 - share) / done))
        });
        ui.add(egui::ProgressBar::new(share as f32).desired_width(width).text(format!("{words}{left}")));
        // The remaining time counts down even while there is no new progress.
        ui.ctx().request_repaint_after(Duration::from_secs(1));
    }

    /// Shows a note if `run` belongs to another scene than the present one. Returns whether it does.
    pub fn say_if_stale(&self, ui: &mut Ui, run: &SolvedScene) -> bool {
        let stale = self.state.stale(run);
        if stale && self.state.activity.failure.is_some() {
            self.alarm(ui, ["Result of the scene before this edit; the present scene has none"]);
        } else if stale {
            self.note(ui, "Result of the scene before this edit");
        }
        stale
    }

    /// Records that the part of the window called `name` is at `rect`; draws a ring round it if it is highlighted.
    pub fn name_part(&self, ui: &Ui, name: &str, rect: Rect) {
        highlight::remember(ui, name, rect);
        if self.state.lessons.highlights(name) {
            highlight::ring(ui, rect);
        }
    }

    /// As [`Self::name_part`], for a plot: the ring stays within it, clear of the title above.
    pub fn name_plot(&self, ui: &Ui, name: &str, plot: Rect) {
        self.name_part(ui, name, plot.shrink(highlight::GAP + 0.5 * highlight::GLOW));
    }

    /// Gives the keyboard to the `widget` called `name`, if a lesson leads there.
    pub fn lead_to(&self, ui: &Ui, name: &str, widget: Id) {
        if self.state.lessons.enter.as_deref() == Some(name) {
            ui.memory_mut(|memory| memory.request_focus(widget));
        }
    }
}
