//! The keyboard: one table feeds what keys do, the sheet that lists them, and the menus that name them.

use crate::gui::command::{Command, HoldCommand, LessonCommand, PinCommand};
use crate::gui::state::document::Next;
use crate::gui::state::view::Tab;
use eframe::egui::{Context, Key, KeyboardShortcut, ModifierNames, Modifiers, Popup};

/// When a shortcut acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Always: it changes only how the window looks.
    Always,
    /// Unless a question is in the way. Text that is being typed is taken first.
    Window,
    /// Neither behind a question nor in a text field, which has an undo of its own.
    History,
    /// Only while nothing else listens to the keyboard.
    Idle,
}

/// What is in the way of shortcuts.
#[derive(Clone, Copy, Debug)]
pub struct Obstacles {
    /// A question or the sheet of shortcuts is open.
    pub modal: bool,
    /// Text is being typed.
    pub typing: bool,
}

/// A shortcut, what it is called, and what it asks for.
#[derive(Clone, Copy, Debug)]
pub struct Shortcut {
    /// The keys.
    pub keys: KeyboardShortcut,
    /// Other keys for the same.
    pub also: Option<KeyboardShortcut>,
    /// What it does.
    pub about: &'static str,
    /// What it asks for.
    pub command: fn() -> Command,
    /// When it acts.
    pub scope: Scope,
}

const fn key(modifiers: Modifiers, key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(modifiers, key)
}

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

const fn shortcut(scope: Scope, keys: KeyboardShortcut, about: &'static str, command: fn() -> Command) -> Shortcut {
    Shortcut { keys, also: None, about, command, scope }
}

const fn always(keys: KeyboardShortcut, about: &'static str, command: fn() -> Command) -> Shortcut {
    shortcut(Scope::Always, keys, about, command)
}

const fn window(keys: KeyboardShortcut, about: &'static str, command: fn() -> Command) -> Shortcut {
    shortcut(Scope::Window, keys, about, command)
}

const fn history(keys: KeyboardShortcut, about: &'static str, command: fn() -> Command) -> Shortcut {
    shortcut(Scope::History, keys, about, command)
}

const fn idle(keys: KeyboardShortcut, about: &'static str, command: fn() -> Command) -> Shortcut {
    shortcut(Scope::Idle, keys, about, command)
}

/// The group of the keys that move the cycle.
const MOTION: &str = "Motion";

/// The group of the keys that move a held plate, and by how much of its mean gap.
const HOLDING: &str = "Held plate";
const HOLD_STEP: f64 = 0.05;

const GO_ON: Command = Command::Lesson(LessonCommand::GoOn);

fn choose(choice: usize) -> Command {
    Command::Lesson(LessonCommand::Choose(choice))
}

/// All shortcuts, in the groups and the order in which the sheet lists them.
pub const GROUPS: &[(&str, &[Shortcut])] = &[
    (
        MOTION,
        &[
            idle(key(NONE, Key::Space), "Play or pause", || Command::TogglePlay),
            idle(key(NONE, Key::ArrowLeft), "One frame back", || Command::StepFrames(-1)),
            idle(key(NONE, Key::ArrowRight), "One frame on", || Command::StepFrames(1)),
            idle(key(NONE, Key::Home), "To the start", || Command::Seek(0.0)),
            idle(key(NONE, Key::OpenBracket), "Follow the tooth before", || Command::NextTooth(-1)),
            idle(key(NONE, Key::CloseBracket), "Follow the next tooth", || Command::NextTooth(1)),
        ],
    ),
    (
        HOLDING,
        &[
            idle(key(NONE, Key::ArrowUp), "Held plate up", || Command::Hold(HoldCommand::By(HOLD_STEP))),
            idle(key(NONE, Key::ArrowDown), "Held plate down", || Command::Hold(HoldCommand::By(-HOLD_STEP))),
        ],
    ),
    (
        "Scene",
        &[
            history(key(CTRL, Key::Z), "Undo", || Command::Undo),
            Shortcut { also: Some(key(CTRL, Key::Y)), ..history(key(CTRL_SHIFT, Key::Z), "Redo", || Command::Redo) },
            window(key(CTRL, Key::D), "Pin the run on screen", || Command::Pin(PinCommand::Shown)),
            idle(key(NONE, Key::Escape), "Stop solving", || Command::CancelSolve),
        ],
    ),
    (
        "Lessons",
        &[
            idle(key(NONE, Key::PageDown), "Next step", || Command::Lesson(LessonCommand::Next)),
            idle(key(NONE, Key::PageUp), "Previous step", || Command::Lesson(LessonCommand::Back)),
            idle(key(NONE, Key::Enter), "Confirm the answer, go to the marked parameter, or go on", || GO_ON),
            idle(key(NONE, Key::Num1), "First answer", || choose(0)),
            idle(key(NONE, Key::Num2), "Second answer", || choose(1)),
            idle(key(NONE, Key::Num3), "Third answer", || choose(2)),
            idle(key(NONE, Key::Num4), "Fourth answer", || choose(3)),
            window(key(NONE, Key::F5), "Read the lessons of folders again", || Command::Lesson(LessonCommand::Reload)),
            idle(key(NONE, Key::H), "Hint", || Command::Lesson(LessonCommand::Hint)),
        ],
    ),
    (
        "File",
        &[
            window(key(CTRL, Key::O), "Open a preset", || Command::OpenDialog),
            window(key(CTRL, Key::S), "Save", || Command::Save(None)),
            window(key(CTRL_SHIFT, Key::S), "Save under another name", || Command::SaveAs),
            window(key(CTRL, Key::Q), "Quit", || Command::Proceed(Next::Quit)),
        ],
    ),
    (
        "Window",
        &[
            window(key(CTRL, Key::Num1), "Show the motion", || Command::Show(Tab::Motion)),
            window(key(CTRL, Key::Num2), "Compare pinned runs", || Command::Show(Tab::Compare)),
            window(key(CTRL, Key::Num3), "Sweep a parameter", || Command::Show(Tab::Sweep)),
            window(key(CTRL, Key::Num4), "Show the torque, of a plate exact results", || Command::Show(Tab::Torque)),
            window(key(CTRL, Key::Num5), "Show the trade-off", || Command::Show(Tab::Tradeoff)),
            window(key(CTRL, Key::Num6), "Show the start-up", || Command::Show(Tab::Startup)),
            window(key(CTRL, Key::Num7), "Hold a plate", || Command::Show(Tab::Hold)),
            window(key(CTRL, Key::Num8), "Show the rotor", || Command::Show(Tab::Rotor)),
            window(key(CTRL, Key::Num9), "Show what the results depend on", || Command::Show(Tab::Sensitivity)),
            window(key(CTRL_SHIFT, Key::F), "Fit to measurements", || Command::Show(Tab::Fit)),
            always(key(CTRL, Key::L), "Lecture size", || Command::ToggleLecture),
            always(key(CTRL, Key::T), "Light or dark", || Command::ToggleTheme),
            window(key(NONE, Key::F2), "Show or hide the parameters", || Command::ToggleParameters),
            window(key(NONE, Key::F3), "Show or hide the results", || Command::ToggleResults),
            window(key(CTRL, Key::P), "Picture of the window", || Command::Screenshot),
            always(key(NONE, Key::F1), "This sheet", || Command::ToggleShortcuts),
        ],
    ),
];

fn all() -> impl Iterator<Item = &'static Shortcut> {
    GROUPS.iter().flat_map(|(_, shortcuts)| *shortcuts)
}

/// The shortcut that asks for `command`.
fn asking_for(command: &Command) -> Option<&'static Shortcut> {
    all().find(|shortcut| (shortcut.command)() == *command)
}

/// The shortcuts pressed in this frame. `tab`: the keys of the motion are its own, and so are those of a held plate.
pub fn pressed(ctx: &Context, obstacles: Obstacles, tab: Tab) -> Vec<Shortcut> {
    let text = ctx.text_edit_focused();
    let idle = !obstacles.typing && !ctx.egui_wants_keyboard_input() && !Popup::is_any_open(ctx);
    let acts = |scope: Scope| match scope {
        Scope::Always => true,
        Scope::Window => !obstacles.modal,
        Scope::History => !obstacles.modal && !text,
        Scope::Idle => !obstacles.modal && idle,
    };
    let mut found = Vec::new();
    ctx.input_mut(|input| {
        // Ctrl+Z answers to Ctrl+Shift+Z too: the longer ones first.
        for shift in [true, false] {
            let groups = GROUPS.iter().filter(|(group, _)| match *group {
                MOTION => tab.moves(),
                HOLDING => tab == Tab::Hold,
                _ => true,
            });
            for shortcut in groups.flat_map(|(_, shortcuts)| shortcuts.iter()).filter(|shortcut| acts(shortcut.scope)) {
                let keys = [Some(shortcut.keys), shortcut.also].into_iter().flatten();
                let mut of_turn = keys.filter(|keys| keys.modifiers.shift == shift);
                if of_turn.any(|keys| input.consume_shortcut(&keys)) {
                    found.push(*shortcut);
                }
            }
        }
    });
    found
}

/// The keys as they are printed on a keyboard.
pub fn name(keys: &KeyboardShortcut) -> String {
    name_on(MAC, keys)
}

/// `text`, which names keys as most keyboards have them, for the keyboard of this system.
pub fn in_text(text: &str) -> String {
    if MAC { text.replace("Ctrl+", ModifierNames::SYMBOLS.mac_cmd) } else { text.to_owned() }
}

const MAC: bool = cfg!(target_os = "macos");

fn name_on(mac: bool, keys: &KeyboardShortcut) -> String {
    let key = match keys.logical_key {
        Key::ArrowLeft => "←",
        Key::ArrowRight => "→",
        Key::ArrowUp => "↑",
        Key::ArrowDown => "↓",
        Key::Escape => "Esc",
        other => other.symbol_or_name(),
    };
    if mac {
        return format!("{}{key}", ModifierNames::SYMBOLS.format(&keys.modifiers, true));
    }
    let modifiers = ModifierNames::NAMES.format(&keys.modifiers, false);
    if modifiers.is_empty() { key.to_owned() } else { format!("{modifiers}+{key}") }
}

/// What the keys that ask for `command` do, and the keys: "Undo (Ctrl+Z)".
pub fn about(command: &Command) -> String {
    asking_for(command).map(|found| format!("{} ({})", found.about, name(&found.keys))).unwrap_or_default()
}

/// The keys that ask for `command`; empty if none do.
pub fn of(command: &Command) -> String {
    asking_for(command).map(|found| name(&found.keys)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_named_as_they_are_printed() {
        assert_eq!(of(&Command::StepFrames(1)), "→");
        assert_eq!(of(&Command::NextTooth(1)), "]");
        assert_eq!(of(&Command::CancelSolve), "Esc");
        assert_eq!(of(&Command::TogglePlay), "Space");
        let names = |keys| [false, true].map(|mac| name_on(mac, &keys));
        assert_eq!(names(key(CTRL, Key::Z)), ["Ctrl+Z", "⌘Z"]);
        assert_eq!(names(key(CTRL_SHIFT, Key::S)), ["Ctrl+Shift+S", "⇧⌘S"]);
        assert_eq!(names(key(NONE, Key::F1)), ["F1", "F1"]);
        assert_eq!(of(&Command::OpenPathPrompt), "");
    }

    #[test]
    fn every_tab_has_its_number_or_a_letter() {
        for (i, (tab, _)) in Tab::ALL.iter().enumerate() {
            let key = of(&Command::Show(*tab));
            assert!(key.ends_with(&(i + 1).to_string()) || i >= 9 && !key.is_empty(), "{tab:?}");
        }
    }

    #[test]
    fn no_two_shortcuts_share_keys_or_words() {
        for (i, a) in all().enumerate() {
            for b in all().skip(i + 1) {
                assert!(a.keys != b.keys && a.about != b.about, "{}", a.about);
                assert!(a.also != Some(b.keys) && b.also != Some(a.keys), "{}", a.about);
            }
        }
    }
}
