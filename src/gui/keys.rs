//! The keyboard: one table feeds both what keys do and the sheet that lists them.

use super::command::Command;
use eframe::egui::{Context, Key, KeyboardShortcut, Modifiers};

/// A shortcut, what it is called, and what it asks for.
pub struct Shortcut {
    /// The keys.
    pub keys: KeyboardShortcut,
    /// What it does.
    pub about: &'static str,
    /// What it asks for.
    pub command: fn() -> Command,
    /// Also while text is typed.
    pub while_typing: bool,
}

const fn key(modifiers: Modifiers, key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(modifiers, key)
}

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

const fn always(keys: KeyboardShortcut, about: &'static str, command: fn() -> Command) -> Shortcut {
    Shortcut { keys, about, command, while_typing: true }
}

const fn idle(keys: KeyboardShortcut, about: &'static str, command: fn() -> Command) -> Shortcut {
    Shortcut { keys, about, command, while_typing: false }
}

/// All shortcuts; the longer ones first where one contains another.
pub const SHORTCUTS: &[Shortcut] = &[
    idle(key(NONE, Key::Space), "Play or pause", || Command::TogglePlay),
    idle(key(NONE, Key::ArrowRight), "One frame on", || Command::StepFrames(1)),
    idle(key(NONE, Key::ArrowLeft), "One frame back", || Command::StepFrames(-1)),
    idle(key(NONE, Key::Home), "Start of the cycle", || Command::Seek(0.0)),
    idle(key(NONE, Key::CloseBracket), "Follow the next tooth", || Command::NextTooth(1)),
    idle(key(NONE, Key::OpenBracket), "Follow the tooth before", || Command::NextTooth(-1)),
    idle(key(NONE, Key::Escape), "Cancel the running solve", || Command::CancelSolve),
    always(key(CTRL_SHIFT, Key::Z), "Redo", || Command::Redo),
    always(key(CTRL, Key::Z), "Undo", || Command::Undo),
    always(key(CTRL, Key::O), "Open a preset", || Command::OpenDialog),
    always(key(CTRL_SHIFT, Key::S), "Save under another name", || Command::SaveAs),
    always(key(CTRL, Key::S), "Save", || Command::Save),
    always(key(CTRL, Key::P), "Picture of the window", || Command::Screenshot),
    always(key(CTRL, Key::T), "Light or dark", || Command::ToggleTheme),
    always(key(CTRL, Key::L), "Lecture size", || Command::ToggleLecture),
    always(key(NONE, Key::F1), "This sheet", || Command::ToggleShortcuts),
    always(key(CTRL, Key::Q), "Quit", || Command::Quit),
];

/// Commands of the shortcuts pressed in this frame. `modal`: a modal is open, and the plain keys are its own.
pub fn pressed(ctx: &Context, modal: bool, commands: &mut Vec<Command>) {
    let typing = modal || ctx.egui_wants_keyboard_input();
    ctx.input_mut(|input| {
        for shortcut in SHORTCUTS {
            if (shortcut.while_typing || !typing) && input.consume_shortcut(&shortcut.keys) {
                commands.push((shortcut.command)());
            }
        }
    });
}
