//! The keyboard: one table determines what the keys do, what the sheet of shortcuts lists, and which keys the menus show.

use crate::gui::command::{Command, HoldCommand, LessonCommand, PinCommand};
use crate::gui::state::dialogs::Purpose;
use crate::gui::state::document::Next;
use crate::gui::state::view::Tab;
use eframe::egui::{Context, Key, KeyboardShortcut, ModifierNames, Modifiers, Popup};

use Scope::{Always, History, Idle, Window};

/// When a shortcut acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Always: it changes only how the window looks.
    Always,
    /// Unless a dialog is open. Text that is being typed is committed first.
    Window,
    /// Only if neither a dialog is open nor a text field has the focus; a text field has its own undo.
    History,
    /// Only if no other widget uses the keyboard.
    Idle,
}

/// Conditions that block shortcuts.
#[derive(Clone, Copy, Debug)]
pub struct Obstacles {
    /// A question or the sheet of shortcuts is open.
    pub modal: bool,
    /// Text is being typed.
    pub typing: bool,
}

/// A shortcut: keys, description and command.
#[derive(Clone, Copy, Debug)]
pub struct Shortcut {
    /// The keys.
    pub keys: KeyboardShortcut,
    /// Alternative keys.
    pub also: Option<KeyboardShortcut>,
    /// Description, for the sheet of shortcuts and for hints.
    pub about: &'static str,
    /// The command.
    pub command: fn() -> Command,
    /// When it acts.
    pub scope: Scope,
}

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

impl Scope {
    const fn on(self, modifiers: Modifiers, key: Key, about: &'static str, command: fn() -> Command) -> Shortcut {
        Shortcut { keys: KeyboardShortcut::new(modifiers, key), also: None, about, command, scope: self }
    }
}

/// The group of the keys for the animation of the cycle.
const MOTION: &str = "Motion";

/// The group of the keys that move a held plate, and the step as a share of its mean gap.
const HOLDING: &str = "Held plate";
const HOLD_STEP: f64 = 0.05;

/// The group of the keys that change how the window looks.
pub const WINDOW: &str = "Window";

const MOVING: &[Shortcut] = &[
    Idle.on(NONE, Key::Space, "Play or pause", || Command::TogglePlay),
    Idle.on(NONE, Key::ArrowLeft, "One frame back", || Command::StepFrames(-1)),
    Idle.on(NONE, Key::ArrowRight, "One frame forward", || Command::StepFrames(1)),
    Idle.on(NONE, Key::Home, "To the start", || Command::Seek(0.0)),
    Idle.on(NONE, Key::OpenBracket, "Follow the previous tooth", || Command::NextTooth(-1)),
    Idle.on(NONE, Key::CloseBracket, "Follow the next tooth", || Command::NextTooth(1)),
];

const HELD: &[Shortcut] = &[
    Idle.on(NONE, Key::ArrowUp, "Held plate up", || Command::Hold(HoldCommand::By(HOLD_STEP))),
    Idle.on(NONE, Key::ArrowDown, "Held plate down", || Command::Hold(HoldCommand::By(-HOLD_STEP))),
];

const SCENE: &[Shortcut] = &[
    History.on(CTRL, Key::Z, "Undo", || Command::Undo),
    Shortcut {
        also: Some(KeyboardShortcut::new(CTRL, Key::Y)),
        ..History.on(CTRL_SHIFT, Key::Z, "Redo", || Command::Redo)
    },
    Window.on(CTRL, Key::D, "Pin the run on screen", || Command::Pin(PinCommand::Shown)),
    Idle.on(NONE, Key::Escape, "Cancel the solve, or the computation of the tab", || Command::CancelSolve),
];

const LESSONS: &[Shortcut] = &[
    Idle.on(NONE, Key::PageDown, "Next step", || LessonCommand::Next.into()),
    Idle.on(NONE, Key::PageUp, "Previous step", || LessonCommand::Back.into()),
    Idle.on(NONE, Key::Enter, "Confirm the answer, go to what is marked, or go on", || LessonCommand::GoOn.into()),
    Idle.on(NONE, Key::Num1, "First answer", || LessonCommand::Choose(0).into()),
    Idle.on(NONE, Key::Num2, "Second answer", || LessonCommand::Choose(1).into()),
    Idle.on(NONE, Key::Num3, "Third answer", || LessonCommand::Choose(2).into()),
    Idle.on(NONE, Key::Num4, "Fourth answer", || LessonCommand::Choose(3).into()),
    Window.on(NONE, Key::F5, "Reload the lessons of folders", || LessonCommand::Reload.into()),
    Idle.on(NONE, Key::H, "Hint", || LessonCommand::Hint.into()),
];

const FILE: &[Shortcut] = &[
    Window.on(CTRL, Key::O, "Open a preset", || Command::Ask(Purpose::Open)),
    Window.on(CTRL, Key::S, "Save", || Command::Save(None)),
    Window.on(CTRL_SHIFT, Key::S, "Save under another name", || Command::Ask(Purpose::Save(None))),
    Window.on(CTRL, Key::Q, "Quit", || Command::Proceed(Next::Quit)),
];

const LOOK: &[Shortcut] = &[
    Window.on(CTRL, Key::Num1, "Show the motion", || Command::Show(Tab::Motion)),
    Window.on(CTRL, Key::Num2, "Compare pinned runs", || Command::Show(Tab::Compare)),
    Window.on(CTRL, Key::Num3, "Sweep a parameter", || Command::Show(Tab::Sweep)),
    Window.on(CTRL, Key::Num4, "Show the torque; of a plate, exact results", || Command::Show(Tab::Torque)),
    Window.on(CTRL, Key::Num5, "Show the trade-off", || Command::Show(Tab::Tradeoff)),
    Window.on(CTRL, Key::Num6, "Show the start-up", || Command::Show(Tab::Startup)),
    Window.on(CTRL, Key::Num7, "Hold a plate", || Command::Show(Tab::Hold)),
    Window.on(CTRL, Key::Num8, "Show the rotor", || Command::Show(Tab::Rotor)),
    Window.on(CTRL, Key::Num9, "Show what the results depend on", || Command::Show(Tab::Sensitivity)),
    Window.on(CTRL_SHIFT, Key::F, "Fit to measurements", || Command::Show(Tab::Fit)),
    Always.on(CTRL, Key::L, "Lecture size", || Command::ToggleLecture),
    Always.on(CTRL, Key::T, "Light or dark", || Command::ToggleTheme),
    Window.on(NONE, Key::F2, "Show or hide the parameters", || Command::ToggleParameters),
    Window.on(NONE, Key::F3, "Show or hide the results", || Command::ToggleResults),
    Window.on(CTRL, Key::P, "Picture of the window", || Command::Screenshot),
    Always.on(NONE, Key::F1, "This sheet", || Command::ToggleShortcuts),
];

/// All shortcuts, in the groups and the order in which the sheet lists them.
pub const GROUPS: &[(&str, &[Shortcut])] =
    &[(MOTION, MOVING), (HOLDING, HELD), ("Scene", SCENE), ("Lessons", LESSONS), ("File", FILE), (WINDOW, LOOK)];

fn all() -> impl Iterator<Item = &'static Shortcut> {
    GROUPS.iter().flat_map(|(_, shortcuts)| *shortcuts)
}

fn asking_for(command: &Command) -> Option<&'static Shortcut> {
    all().find(|shortcut| (shortcut.command)() == *command)
}

/// The shortcuts pressed in this frame. `tab` decides whether the keys for the animation or for a held plate apply.
pub fn pressed(ctx: &Context, obstacles: Obstacles, tab: Tab) -> Vec<Shortcut> {
    let (text, menu) = (ctx.text_edit_focused(), Popup::is_any_open(ctx));
    let idle = !obstacles.typing && !ctx.egui_wants_keyboard_input() && !menu;
    let acts = |scope: Scope| match scope {
        Always => true,
        Window => !obstacles.modal,
        History => !obstacles.modal && !text && !menu,
        Idle => !obstacles.modal && idle,
    };
    let mut found = Vec::new();
    ctx.input_mut(|input| {
        // Ctrl+Z also matches Ctrl+Shift+Z, so the longer shortcuts are tested first.
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

/// The keys as they are labelled on a keyboard.
pub fn name(keys: &KeyboardShortcut) -> String {
    name_on(MAC, keys)
}

/// `text` with its names of keys, which are those of most keyboards, adapted to the keyboard of this system.
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

/// Description and keys of the shortcut for `command`: "Undo (Ctrl+Z)"; empty if there is none.
pub fn about(command: &Command) -> String {
    asking_for(command).map(|found| format!("{} ({})", found.about, name(&found.keys))).unwrap_or_default()
}

/// The keys for `command`; empty if there are none.
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
        assert_eq!(names(KeyboardShortcut::new(CTRL, Key::Z)), ["Ctrl+Z", "⌘Z"]);
        assert_eq!(names(KeyboardShortcut::new(CTRL_SHIFT, Key::S)), ["Ctrl+Shift+S", "⇧⌘S"]);
        assert_eq!(names(KeyboardShortcut::new(NONE, Key::F1)), ["F1", "F1"]);
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
